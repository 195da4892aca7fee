//! The exact algebra of the common zeros of polynomials in three unknowns: its basis of monomials, and multiplication
//! of them by an unknown.
//!
//! The span of the polynomials is closed under multiplication by an unknown up to a degree `D`. So a combination whose
//! leading form cancels is multiplied again. When no monomial of degree `D` remains, the remaining monomials are a
//! basis of the algebra (Mourrain 1999). `docs/theory/pose-count.md` uses the same for poses of six legs.

use num::exact::{ExactVector, Rational, relations};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Zero};

/// Exponents of the three unknowns.
type Exponents = [u8; 3];

/// The degrees that are tried.
const DEGREES: std::ops::RangeInclusive<u8> = 3..=6;

/// Monomials up to a degree, those of higher degree first.
#[derive(Debug, Clone)]
struct Monomials(Vec<Exponents>);

impl Monomials {
    fn up_to(degree: u8) -> Self {
        let of = |d: u8| (0..=d).rev().flat_map(move |i| (0..=d - i).rev().map(move |j| [i, j, d - i - j]));
        Self((0..=degree).rev().flat_map(of).collect())
    }

    fn index(&self, exponents: Exponents) -> usize {
        self.0.iter().position(|e| *e == exponents).unwrap_or(self.0.len())
    }

    fn degree(&self, index: usize) -> u8 {
        self.0[index].iter().sum()
    }
}

/// A polynomial of degree two: coefficient of each pair of exponents.
pub(super) type Quadric = Vec<(Exponents, Rational)>;

/// Polynomials reduced against each other: each has a leading monomial of its own.
#[derive(Debug)]
struct Span {
    monomials: Monomials,
    /// The polynomial with this leading monomial, its coefficients integers without a common factor.
    led_by: Vec<Option<Vec<BigInt>>>,
}

impl Span {
    /// All multiples up to the degree.
    fn of(quadrics: &[Quadric], degree: u8) -> Self {
        let monomials = Monomials::up_to(degree);
        let mut span = Self { led_by: vec![None; monomials.0.len()], monomials };
        let mut waiting: Vec<Vec<BigInt>> = quadrics.iter().map(|q| span.integers(q)).collect();
        while let Some(row) = waiting.pop() {
            let Some((lead, row)) = span.reduced(row) else { continue };
            if span.monomials.degree(lead) < degree {
                waiting.extend((0..3).map(|k| span.times(&row, k)));
            }
            span.led_by[lead] = Some(row);
        }
        span
    }

    fn integers(&self, quadric: &Quadric) -> Vec<BigInt> {
        let common = quadric.iter().fold(BigInt::one(), |l, (_, x)| l.lcm(x.denom()));
        let mut row = vec![BigInt::zero(); self.monomials.0.len()];
        for (exponents, x) in quadric {
            row[self.monomials.index(*exponents)] += x.numer() * (&common / x.denom());
        }
        row
    }

    /// The product with an unknown; the degree is below the greatest.
    fn times(&self, row: &[BigInt], unknown: usize) -> Vec<BigInt> {
        let mut out = vec![BigInt::zero(); row.len()];
        for (i, x) in row.iter().enumerate().filter(|(_, x)| !x.is_zero()) {
            let mut exponents = self.monomials.0[i];
            exponents[unknown] += 1;
            out[self.monomials.index(exponents)].clone_from(x);
        }
        out
    }

    /// The rest of a row, with the place of its leading monomial; `None` where nothing is left.
    fn reduced(&self, mut row: Vec<BigInt>) -> Option<(usize, Vec<BigInt>)> {
        for lead in 0..row.len() {
            if row[lead].is_zero() {
                continue;
            }
            let Some(head) = &self.led_by[lead] else {
                return Some((lead, primitive(row)));
            };
            row = combined(&row, head, lead);
        }
        None
    }

    /// The places of the monomials that lead no polynomial.
    fn left_over(&self) -> Vec<usize> {
        (0..self.led_by.len()).filter(|i| self.led_by[*i].is_none()).collect()
    }

    /// The combination of monomials left over that a polynomial is equal to.
    fn normal_form(&self, row: &[Rational], basis: &[usize]) -> ExactVector {
        let common = row.iter().fold(BigInt::one(), |l, x| l.lcm(x.denom()));
        let mut factor = Rational::from_integer(common.clone());
        let mut row: Vec<BigInt> = row.iter().map(|x| x.numer() * (&common / x.denom())).collect();
        for lead in 0..row.len() {
            if row[lead].is_zero() {
                continue;
            }
            if let Some(head) = &self.led_by[lead] {
                factor *= Rational::from_integer(head[lead].clone());
                let x = std::mem::take(&mut row[lead]);
                for (k, r) in row.iter_mut().enumerate().skip(lead + 1) {
                    *r = &*r * &head[lead] - &x * &head[k];
                }
                // the monomials before the leading one are in the basis and were not touched
                for r in &mut row[..lead] {
                    *r *= &head[lead];
                }
                let divisor = row.iter().fold(factor.numer().clone(), |g, x| g.gcd(x));
                if !divisor.is_one() {
                    for x in &mut row {
                        *x /= &divisor;
                    }
                    factor /= Rational::from_integer(divisor);
                }
            }
        }
        basis.iter().map(|i| Rational::from_integer(row[*i].clone()) / &factor).collect()
    }
}

/// `row` without its entry at `lead`.
fn combined(row: &[BigInt], head: &[BigInt], lead: usize) -> Vec<BigInt> {
    let common = row[lead].gcd(&head[lead]);
    let (f, g) = (&head[lead] / &common, &row[lead] / &common);
    row.iter().zip(head).map(|(r, h)| r * &f - h * &g).collect()
}

fn primitive(row: Vec<BigInt>) -> Vec<BigInt> {
    let divisor = row.iter().fold(BigInt::zero(), |g, x| g.gcd(x));
    row.into_iter().map(|x| x / &divisor).collect()
}

/// Polynomials are taken modulo the ideal of some quadrics with finitely many common zeros.
#[derive(Debug)]
pub(super) struct Quotient {
    span: Span,
    basis: Vec<usize>,
}

/// All common zeros by the values of one linear form (rational univariate representation).
#[derive(Debug)]
pub(super) struct ByOneForm {
    /// The polynomial whose roots are the values of the form, the constant coefficient first, the last one 1.
    pub(super) polynomial: ExactVector,
    /// Each unknown as a polynomial in that value.
    pub(super) unknowns: [ExactVector; 3],
}

impl Quotient {
    /// `None` where the zeros were not seen to be finitely many.
    pub(super) fn of(quadrics: &[Quadric]) -> Option<Self> {
        DEGREES.into_iter().find_map(|degree| {
            let span = Span::of(quadrics, degree);
            let basis = span.left_over();
            let closed = basis.iter().all(|i| span.monomials.degree(*i) < degree);
            closed.then_some(Self { span, basis })
        })
    }

    /// The number of zeros, counted with multiplicity.
    pub(super) fn zeros(&self) -> usize {
        self.basis.len()
    }

    /// A combination of monomials left over, times `c . t`.
    fn times(&self, x: &ExactVector, form: &[i64; 3]) -> ExactVector {
        let mut row = vec![Rational::zero(); self.span.led_by.len()];
        for (i, x) in self.basis.iter().zip(x) {
            for (k, c) in form.iter().enumerate().filter(|(_, c)| **c != 0) {
                let mut exponents = self.span.monomials.0[*i];
                exponents[k] += 1;
                row[self.span.monomials.index(exponents)] += x * Rational::from_integer((*c).into());
            }
        }
        self.span.normal_form(&row, &self.basis)
    }

    fn one(&self) -> ExactVector {
        let mut row = vec![Rational::zero(); self.span.led_by.len()];
        if let Some(last) = row.last_mut() {
            *last = Rational::one();
        }
        self.span.normal_form(&row, &self.basis)
    }

    /// The zeros by the values of `c . t`; `None` where these do not tell them apart.
    pub(super) fn by(&self, form: &[i64; 3]) -> Option<ByOneForm> {
        let mut powers = vec![self.one()];
        for _ in 0..self.zeros() {
            let next = self.times(powers.last()?, form);
            powers.push(next);
        }
        // the first `n` powers are independent where the form tells all zeros apart
        let [relation] = <[ExactVector; 1]>::try_from(relations(&powers)).ok()?;
        let monic = |relation: &ExactVector| -> Option<ExactVector> {
            let last = relation.last().filter(|x| !x.is_zero())?;
            Some(relation.iter().map(|x| x / last).collect())
        };
        let polynomial = monic(&relation)?;
        powers.pop();
        let unknown = |k: usize| -> Option<ExactVector> {
            let mut alone = [0; 3];
            alone[k] = 1;
            let mut rows = powers.clone();
            rows.push(self.times(&self.one(), &alone));
            let [relation] = <[ExactVector; 1]>::try_from(relations(&rows)).ok()?;
            let mut out = monic(&relation)?;
            out.pop();
            Some(out.into_iter().map(|x| -x).collect())
        };
        Some(ByOneForm { polynomial, unknowns: [unknown(0)?, unknown(1)?, unknown(2)?] })
    }
}
