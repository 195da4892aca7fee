//! The algebra of polynomials modulo an ideal, degree by degree, closed under falls of degree.
//!
//! `V_d` is the space of polynomials of degree `d` or less that are known to lie in the ideal. `W_d` has all
//! polynomials of degree `d` or less modulo `V_d`. It has a basis of standard monomials, and only this basis is kept.
//! With `W_{d-1}`, `W_d` and the products `x_k w` that lead from one to the other the next space is
//!
//! ```text
//! W_{d+1} = (W_d + sum x_k W_d) / (x_j (x_k u) = x_k (x_j u), u in W_{d-1}),
//! ```
//!
//! because the kernel of the product of polynomials of degree `d` and linear ones is spanned by these relations. A
//! relation that involves `W_d` alone is a fall of degree: a polynomial of the ideal of degree `e <= d` that `V_e` did
//! not have. It is added there, and the spaces are built again from degree `e`.
//!
//! When degrees `d` and `d + 1` have no standard monomials and there is no fall, the products commute on all standard
//! monomials. These are then a basis of the whole algebra (Mourrain 1999). Their number is the number of zeros over the
//! algebraic closure, each with its multiplicity.

use std::collections::HashMap;

use num::echelon::Echelon;
use num::modular::Field;

/// A monomial: four bits for each exponent, the degree in the highest four. So larger numbers are larger in the graded
/// lexicographic order, and products are sums.
pub(super) type Monomial = u64;

/// The monomial 1.
pub(super) const UNIT: Monomial = 0;

/// The unknown `x_k`, `k < 15`.
pub(super) fn variable(k: usize) -> Monomial {
    1 << 60 | 1 << (4 * k)
}

fn degree(m: Monomial) -> usize {
    (m >> 60) as usize
}

/// Terms with coefficients that are not zero.
pub(super) type Polynomial = Vec<(Monomial, u64)>;

/// The result of the construction of the spaces.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum QuotientOutcome {
    /// The standard monomials are a basis of the algebra.
    Closed {
        /// Number of standard monomials of each degree, from 0 on; empty when the ideal holds 1.
        by_degree: Vec<usize>,
        /// All polynomials used are combinations of multiples of the given ones of at most this degree.
        depth: usize,
    },
    /// Standard monomials are left in the highest degree allowed.
    Open {
        /// Number of standard monomials of each degree.
        by_degree: Vec<usize>,
    },
}

/// `x_k` times a standard monomial.
#[derive(Debug, Clone)]
enum MonomialProduct {
    /// A standard monomial, by index.
    Standard(usize),
    /// A combination of the standard monomials before.
    Sum(Vec<u64>),
}

/// A polynomial of the ideal and the degree of the multiples it is made of.
#[derive(Debug, Clone)]
struct IdealRelation {
    polynomial: Polynomial,
    depth: usize,
}

struct Spaces {
    field: Field,
    unknowns: usize,
    /// Standard monomials by increasing degree.
    standard: Vec<Monomial>,
    /// Index of the first standard monomial of each degree built, and one more for the end.
    first: Vec<usize>,
    /// Products of the standard monomials of all degrees built but the last.
    products: Vec<Vec<MonomialProduct>>,
    /// Relations by degree.
    given: Vec<Vec<IdealRelation>>,
    /// Degree of the multiples used for each space.
    depth: Vec<usize>,
}

/// Builds the spaces up to degree `limit`.
pub(super) fn close(
    field: Field,
    unknowns: usize,
    polynomials: Vec<Polynomial>,
    limit: usize,
) -> QuotientOutcome {
    let mut given: Vec<Vec<IdealRelation>> = vec![Vec::new(); limit + 1];
    for polynomial in polynomials {
        let Some(d) = polynomial.iter().map(|t| degree(t.0)).max() else { continue };
        given[d].push(IdealRelation { polynomial, depth: d });
    }
    let mut s = Spaces {
        field,
        unknowns,
        standard: vec![UNIT],
        first: vec![0, 1],
        products: Vec::new(),
        given,
        depth: vec![0],
    };
    let mut built = 0;
    loop {
        // built spaces: W_0 .. W_built
        let next = built + 1;
        if next > limit {
            return QuotientOutcome::Open { by_degree: s.by_degree() };
        }
        match s.build(next) {
            Ok(()) => {
                built = next;
                if built >= 2 && s.count(built) == 0 && s.count(built - 1) == 0 {
                    let mut by_degree = s.by_degree();
                    while by_degree.last() == Some(&0) {
                        by_degree.pop();
                    }
                    return QuotientOutcome::Closed { by_degree, depth: s.depth[built] };
                }
            }
            Err(0) => return QuotientOutcome::Closed { by_degree: Vec::new(), depth: s.depth[next] },
            Err(e) => {
                s.truncate(e - 1);
                built = e - 1;
            }
        }
    }
}

impl Spaces {
    fn count(&self, d: usize) -> usize {
        self.first[d + 1] - self.first[d]
    }

    fn by_degree(&self) -> Vec<usize> {
        (0..self.first.len() - 1).map(|d| self.count(d)).collect()
    }

    /// Keeps `W_0 .. W_d`.
    fn truncate(&mut self, d: usize) {
        self.first.truncate(d + 2);
        self.standard.truncate(self.first[d + 1]);
        self.products.truncate(self.first[d]);
        self.depth.truncate(d + 1);
    }

    /// `W_next` from those before; `Err(e)` after a fall to degree `e`, which is then among the relations given.
    fn build(&mut self, next: usize) -> Result<(), usize> {
        let field = self.field;
        let before = self.standard.len();
        let top = self.first[next - 1]..before;
        let mut candidates: Vec<Monomial> = top
            .clone()
            .flat_map(|i| (0..self.unknowns).map(move |k| (i, k)))
            .map(|(i, k)| self.standard[i] + variable(k))
            .collect();
        candidates.sort_unstable_by(|a, b| b.cmp(a));
        candidates.dedup();
        let place: HashMap<Monomial, usize> = candidates.iter().enumerate().map(|(k, m)| (*m, k)).collect();
        let columns = Columns { place: &place, candidates: candidates.len(), before };
        let given = self.given[..=next].iter().flatten();
        let depth = given.map(|r| r.depth).fold(self.depth[next - 1] + 1, usize::max);
        self.depth.truncate(next);
        self.depth.push(depth);
        let mut echelon = Echelon::new(field, candidates.len() + before);
        let mut row = vec![0; candidates.len() + before];
        for k in 0..self.given[next].len() {
            row.fill(0);
            for (monomial, x) in &self.given[next][k].polynomial {
                self.add_monomial(&mut row, &columns, *monomial, *x);
            }
            echelon.insert(&row);
        }
        let below = if next >= 2 { self.first[next - 2]..self.first[next - 1] } else { 0..0 };
        for u in below {
            for j in 0..self.unknowns {
                for k in 0..j {
                    if matches!(
                        (&self.products[u][j], &self.products[u][k]),
                        (MonomialProduct::Standard(_), MonomialProduct::Standard(_))
                    ) {
                        continue;
                    }
                    row.fill(0);
                    self.add_product(&mut row, &columns, u, k, j, 1);
                    self.add_product(&mut row, &columns, u, j, k, field.prime() - 1);
                    echelon.insert(&row);
                }
            }
        }
        echelon.reduce_fully();
        let mut lowest = None;
        for i in (0..before).rev() {
            if let Some(row) = echelon.leading_in(columns.of_standard(i)) {
                let terms = (0..=i).map(|k| (self.standard[k], row[columns.of_standard(k)]));
                let polynomial = terms.filter(|t| t.1 != 0).collect();
                let d = degree(self.standard[i]);
                self.given[d].push(IdealRelation { polynomial, depth });
                lowest = Some(d);
            }
        }
        if let Some(d) = lowest {
            return Err(d);
        }
        self.extend(&candidates, &columns, &echelon, top);
        Ok(())
    }

    /// Takes the candidates that no relation reduces for standard, and files the products.
    fn extend(
        &mut self,
        candidates: &[Monomial],
        columns: &Columns<'_>,
        echelon: &Echelon,
        top: std::ops::Range<usize>,
    ) {
        let before = columns.before;
        let free: Vec<usize> =
            (0..candidates.len()).rev().filter(|c| echelon.leading_in(*c).is_none()).collect();
        for i in top {
            let products = (0..self.unknowns).map(|k| {
                let c = columns.place[&(self.standard[i] + variable(k))];
                let Some(row) = echelon.leading_in(c) else {
                    let at = free.iter().position(|f| *f == c).unwrap_or(0);
                    return MonomialProduct::Standard(before + at);
                };
                let old = (0..before).map(|i| row[columns.of_standard(i)]);
                let sum = old.chain(free.iter().map(|f| row[*f]));
                MonomialProduct::Sum(sum.map(|x| self.field.sub(0, x)).collect())
            });
            let products = products.collect();
            self.products.push(products);
        }
        self.standard.extend(free.iter().map(|c| candidates[*c]));
        self.first.push(self.standard.len());
    }

    /// Adds `factor x_j (x_k u)` to a row.
    fn add_product(&self, row: &mut [u64], columns: &Columns<'_>, u: usize, k: usize, j: usize, factor: u64) {
        match &self.products[u][k] {
            MonomialProduct::Standard(i) => self.add_multiple(row, columns, *i, j, factor),
            MonomialProduct::Sum(sum) => {
                for (i, x) in sum.iter().enumerate().filter(|t| *t.1 != 0) {
                    self.add_multiple(row, columns, i, j, self.field.mul(*x, factor));
                }
            }
        }
    }

    /// Adds `factor x_j` times a standard monomial.
    fn add_multiple(&self, row: &mut [u64], columns: &Columns<'_>, i: usize, j: usize, factor: u64) {
        let field = self.field;
        let add = |x: &mut u64, y: u64| *x = field.add(*x, y);
        match self.products.get(i).map(|p| &p[j]) {
            None => add(&mut row[columns.place[&(self.standard[i] + variable(j))]], factor),
            Some(MonomialProduct::Standard(k)) => add(&mut row[columns.of_standard(*k)], factor),
            Some(MonomialProduct::Sum(sum)) => {
                for (k, x) in sum.iter().enumerate().filter(|t| *t.1 != 0) {
                    add(&mut row[columns.of_standard(k)], field.mul(*x, factor));
                }
            }
        }
    }

    /// Adds `factor` times any monomial of at most the degree of the candidates.
    fn add_monomial(&self, row: &mut [u64], columns: &Columns<'_>, monomial: Monomial, factor: u64) {
        let mut factors: Vec<usize> = Vec::new();
        for k in 0..self.unknowns {
            factors.extend(std::iter::repeat_n(k, (monomial >> (4 * k) & 15) as usize));
        }
        let last = if degree(monomial) + 1 == self.first.len() { factors.pop() } else { None };
        let mut sum = vec![0; columns.before];
        sum[0] = factor;
        for k in factors {
            let mut product = vec![0; columns.before];
            for (i, x) in sum.iter().enumerate().filter(|t| *t.1 != 0) {
                match &self.products[i][k] {
                    MonomialProduct::Standard(at) => product[*at] = self.field.add(product[*at], *x),
                    MonomialProduct::Sum(terms) => {
                        for (p, y) in product.iter_mut().zip(terms) {
                            *p = self.field.add(*p, self.field.mul(*x, *y));
                        }
                    }
                }
            }
            sum = product;
        }
        for (i, x) in sum.into_iter().enumerate().filter(|t| t.1 != 0) {
            match last {
                Some(j) => self.add_multiple(row, columns, i, j, x),
                None => row[columns.of_standard(i)] = self.field.add(row[columns.of_standard(i)], x),
            }
        }
    }
}

/// Columns of a relation: candidates, largest first, then the standard monomials known, highest degree first.
struct Columns<'a> {
    place: &'a HashMap<Monomial, usize>,
    candidates: usize,
    before: usize,
}

impl Columns<'_> {
    fn of_standard(&self, i: usize) -> usize {
        self.candidates + self.before - 1 - i
    }
}
