//! Homogeneous polynomials in three variables with integer coefficients of any length.

use num_bigint::BigInt;

use super::exact::Exact;
use super::form::{exponents, index};
use crate::num::exact::{Rational, approximate, primitive, relations};
use crate::num::modular::Field;

/// As [`Form`](super::form::Form), in the same order of the monomials.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct ExactForm {
    pub(super) degree: usize,
    pub(super) coefficients: Vec<BigInt>,
}

/// Homogeneous coordinates in a plane.
pub(super) type Place = [BigInt; 3];

/// Coprime integers with the same ratios, the first that is not zero positive.
pub(super) fn integers(list: &[Rational]) -> Vec<BigInt> {
    primitive(list).iter().map(|x| x.numer().clone()).collect()
}

pub(super) fn rationals(list: &[BigInt]) -> Exact {
    list.iter().map(|x| Rational::from_integer(x.clone())).collect()
}

/// Bits of the longest number.
pub(super) fn bits(list: &[BigInt]) -> u64 {
    list.iter().map(BigInt::bits).max().unwrap_or(0)
}

pub(super) fn cross(p: &[BigInt], q: &[BigInt]) -> Place {
    [0, 1, 2].map(|i| &p[(i + 1) % 3] * &q[(i + 2) % 3] - &p[(i + 2) % 3] * &q[(i + 1) % 3])
}

impl ExactForm {
    pub(super) fn zero(degree: usize) -> Self {
        Self { degree, coefficients: vec![BigInt::ZERO; (degree + 1) * (degree + 2) / 2] }
    }

    pub(super) fn one() -> Self {
        Self { degree: 0, coefficients: vec![1.into()] }
    }

    fn monomial(e: [usize; 3]) -> Self {
        let mut out = Self::zero(e.iter().sum());
        out.coefficients[index(e)] = 1.into();
        out
    }

    /// The multiple with coprime coefficients.
    pub(super) fn primitive(&self) -> Self {
        Self { degree: self.degree, coefficients: integers(&rationals(&self.coefficients)) }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.coefficients.iter().all(|c| *c == BigInt::ZERO)
    }

    fn terms(&self) -> impl Iterator<Item = ([usize; 3], &BigInt)> {
        exponents(self.degree).zip(&self.coefficients).filter(|(_, c)| **c != BigInt::ZERO)
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        let mut out = Self::zero(self.degree + other.degree);
        for (e, a) in self.terms() {
            for (f, b) in other.terms() {
                out.coefficients[index([e[0] + f[0], e[1] + f[1], e[2] + f[2]])] += a * b;
            }
        }
        out
    }

    /// Adds a multiple.
    pub(super) fn add(&mut self, other: &Self, factor: i32) {
        self.coefficients.iter_mut().zip(&other.coefficients).for_each(|(a, b)| *a += b * factor);
    }

    pub(super) fn gradient(&self) -> [Self; 3] {
        [0, 1, 2].map(|variable| {
            let mut out = Self::zero(self.degree.saturating_sub(1));
            for (mut e, c) in self.terms().filter(|(e, _)| e[variable] > 0) {
                let factor = e[variable];
                e[variable] -= 1;
                out.coefficients[index(e)] += c * factor;
            }
            out
        })
    }

    /// Coefficients in `s` of the form at `p + s q`.
    pub(super) fn on_line(&self, p: &Place, q: &Place) -> Vec<BigInt> {
        let mut out = vec![BigInt::ZERO; self.degree + 1];
        for (e, c) in self.terms() {
            let mut term = vec![c.clone()];
            for (k, n) in e.iter().enumerate() {
                for _ in 0..*n {
                    let mut next = vec![BigInt::ZERO; term.len() + 1];
                    for (i, t) in term.iter().enumerate() {
                        next[i] += t * &p[k];
                        next[i + 1] += t * &q[k];
                    }
                    term = next;
                }
            }
            out.iter_mut().zip(term).for_each(|(o, t)| *o += t);
        }
        out
    }

    pub(super) fn value(&self, p: &Place) -> BigInt {
        self.on_line(p, &[BigInt::ZERO; 3]).swap_remove(0)
    }

    /// Whether the form vanishes on a line, given by its linear form.
    pub(super) fn contains(&self, line: &Self) -> bool {
        let units: [Place; 3] = [0, 1, 2].map(|k| [0, 1, 2].map(|i| BigInt::from(i32::from(i == k))));
        let points: Vec<Place> = units.iter().map(|u| cross(&line.coefficients, u)).collect();
        // two of the three points of the line on the axes of the coordinates differ
        let differ =
            |(i, j): &(usize, usize)| cross(&points[*i], &points[*j]).iter().any(|x| *x != BigInt::ZERO);
        let pair = [(0, 1), (0, 2), (1, 2)].into_iter().find(differ);
        pair.is_some_and(|(i, j)| self.on_line(&points[i], &points[j]).iter().all(|c| *c == BigInt::ZERO))
    }

    /// Products with all monomials of a degree.
    fn shifts(&self, degree: usize) -> Vec<Exact> {
        exponents(degree).map(|e| rationals(&self.times(&Self::monomial(e)).coefficients)).collect()
    }

    /// The quotient with coprime coefficients, where the divisor divides.
    pub(super) fn divided(&self, divisor: &Self) -> Option<Self> {
        let degree = self.degree.checked_sub(divisor.degree)?;
        let mut rows = divisor.shifts(degree);
        rows.push(rationals(&self.coefficients));
        // products of a form with the monomials are independent: one relation at most
        let mut relation = relations(&rows).pop()?;
        relation.pop()?;
        Some(Self { degree, coefficients: integers(&relation) })
    }

    /// The greatest common divisor of two forms that are not zero; `None` where it takes eliminations with numbers of more than `longest` bits.
    ///
    /// `g self = h other` has a solution with `deg h = deg self - k` exactly when the divisor has at least degree `k`. Where the products have full rank modulo a
    /// prime there is none, and no long numbers are needed.
    pub(super) fn common_factor(&self, other: &Self, longest: u64) -> Option<Self> {
        for k in (1..=self.degree.min(other.degree)).rev() {
            let (g, h) = (other.degree - k, self.degree - k);
            let mut rows = self.shifts(g);
            let first = rows.len();
            rows.extend(other.shifts(h));
            if rank_modulo(&rows) == rows.len() {
                continue;
            }
            if bits(&self.coefficients).max(bits(&other.coefficients)) > longest {
                return None;
            }
            let Some(relation) = relations(&rows).pop() else { continue };
            let cofactor = Self { degree: h, coefficients: integers(&relation[first..]) };
            if let Some(divisor) = self.divided(&cofactor) {
                return Some(divisor);
            }
        }
        Some(Self::one())
    }

    /// The coefficients as doubles, the largest of modulus 1.
    pub(super) fn approximate(&self) -> Vec<f64> {
        let Some(most) =
            self.coefficients.iter().max_by_key(|c| c.magnitude()).filter(|c| **c != BigInt::ZERO)
        else {
            return vec![0.0; self.coefficients.len()];
        };
        self.coefficients.iter().map(|c| approximate(&Rational::new(c.clone(), most.clone()))).collect()
    }
}

/// A lower bound of the rank of rows of integers: that modulo `2^61 - 1`.
pub(super) fn rank_modulo(rows: &[Exact]) -> usize {
    let field = Field::MERSENNE;
    let residue = |x: &Rational| {
        let r = x.numer() % field.prime();
        let size = r.iter_u64_digits().next().unwrap_or(0);
        if r < BigInt::ZERO { field.sub(0, size) } else { size }
    };
    let mut rows: Vec<Vec<u64>> = rows.iter().map(|r| r.iter().map(residue).collect()).collect();
    let width = rows.first().map_or(0, Vec::len);
    let mut rank = 0;
    for column in 0..width {
        let Some(found) = (rank..rows.len()).find(|i| rows[*i][column] != 0) else { continue };
        rows.swap(rank, found);
        let scale = field.inverse(rows[rank][column]);
        let (top, below) = rows.split_at_mut(rank + 1);
        let head = &top[rank];
        for row in below.iter_mut().filter(|r| r[column] != 0) {
            let factor = field.mul(row[column], scale);
            row.iter_mut().zip(head).for_each(|(x, h)| *x = field.sub(*x, field.mul(factor, *h)));
        }
        rank += 1;
    }
    rank
}

/// The products of the partial derivatives with the monomials of degree `2 deg - 4` (for a cubic: 18 quartics).
pub(super) fn jacobian_products(form: &ExactForm) -> Vec<Exact> {
    form.gradient().iter().flat_map(|d| d.shifts((2 * form.degree).saturating_sub(4))).collect()
}

/// Whether two lists are proportional (the zero list is, to every other one).
pub(super) fn proportional(a: &[BigInt], b: &[BigInt]) -> bool {
    let Some(k) = a.iter().position(|x| *x != BigInt::ZERO) else { return true };
    a.iter().zip(b).all(|(x, y)| x * &b[k] == y * &a[k])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn form(degree: usize, c: &[i64]) -> ExactForm {
        ExactForm { degree, coefficients: c.iter().map(|x| BigInt::from(*x)).collect() }
    }

    #[test]
    fn products_divide_and_share_their_factors() {
        let (line, conic) = (form(1, &[3, -2, 5]), form(2, &[1, 0, -4, 2, 7, -1]));
        let other = form(2, &[0, 1, 1, -3, 0, 2]);
        let (f, g) = (line.times(&conic), line.times(&other));
        assert_eq!(f.divided(&line), Some(conic.clone()));
        assert_eq!(f.divided(&other), None);
        assert!(f.contains(&line) && !conic.contains(&line) && !f.contains(&form(1, &[3, -2, 6])));
        assert!(form(1, &[0, 0, 2]).contains(&form(1, &[0, 0, 1])));
        assert_eq!(f.common_factor(&g, 100).as_ref(), Some(&line));
        assert_eq!(f.common_factor(&g, 1), None);
        assert_eq!(f.common_factor(&conic.times(&conic), 100).as_ref(), Some(&conic));
        assert_eq!(conic.common_factor(&other, 1).map(|c| c.degree), Some(0));
        let at = [2, 1, -1].map(BigInt::from);
        assert_eq!(f.value(&at), line.value(&at) * conic.value(&at));
        // Euler: sum x_k df/dx_k = 3 f
        let euler: BigInt = f.gradient().iter().zip(&at).map(|(d, x)| d.value(&at) * x).sum();
        assert_eq!(euler, f.value(&at) * 3);
        assert!(proportional(&f.coefficients, &f.times(&form(0, &[-7])).coefficients));
        assert!(!proportional(&f.coefficients, &g.coefficients));
    }

    #[test]
    fn the_rank_modulo_a_prime_is_that_of_integer_rows() {
        let rows = [[1, 2, 3], [4, 5, 6], [7, 8, -9]].map(|r| rationals(&r.map(BigInt::from)));
        assert_eq!((rank_modulo(&rows), rank_modulo(&rows[..2])), (3, 2));
        let dependent = [[1, 2, -3], [-2, -4, 6]].map(|r| rationals(&r.map(BigInt::from)));
        assert_eq!(rank_modulo(&dependent), 1);
    }
}
