//! Coefficients of the tower: polynomials over the integers, and over a prime field.

use num_bigint::{BigInt, Sign};

use crate::num::modular::Field;
use crate::poly::IntPoly;

/// `Z[x]` or a quotient of it.
pub(super) trait Ring: Clone + PartialEq {
    fn constant(value: &BigInt) -> Self;
    fn unknown() -> Self;
    fn plus(&self, other: &Self) -> Self;
    fn minus(&self, other: &Self) -> Self;
    fn times(&self, other: &Self) -> Self;
    fn is_zero(&self) -> bool;
    /// The quotient when there is one.
    fn exact_div(&self, divisor: &Self) -> Option<Self>;
    /// `None` for zero.
    fn degree(&self) -> Option<usize>;
    /// The part without repeated factors.
    fn squarefree_degree(&self) -> usize;
}

impl Ring for IntPoly {
    fn constant(value: &BigInt) -> Self {
        Self::constant(value.clone())
    }

    fn unknown() -> Self {
        Self::x()
    }

    fn plus(&self, other: &Self) -> Self {
        self + other
    }

    fn minus(&self, other: &Self) -> Self {
        self - other
    }

    fn times(&self, other: &Self) -> Self {
        self * other
    }

    fn is_zero(&self) -> bool {
        self.is_zero()
    }

    fn exact_div(&self, divisor: &Self) -> Option<Self> {
        self.exact_div(divisor)
    }

    fn degree(&self) -> Option<usize> {
        self.degree()
    }

    fn squarefree_degree(&self) -> usize {
        crate::poly::squarefree_factors(self).iter().filter_map(|f| f.factor.degree()).sum()
    }
}

/// The modulus `2^61 - 1`.
const P: u64 = (1 << 61) - 1;

const FIELD: Field = Field::MERSENNE;

/// A polynomial over the field with `2^61 - 1` elements, the constant coefficient first, the last one not zero.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct FieldPoly(Vec<u64>);

/// The residue by folding, quicker than the division that serves every prime.
fn reduced(x: u128) -> u64 {
    let folded = (x & u128::from(P)) as u64 + (x >> 61) as u64;
    if folded >= P { folded - P } else { folded }
}

fn product(a: u64, b: u64) -> u64 {
    reduced(u128::from(a) * u128::from(b))
}

impl FieldPoly {
    fn new(mut c: Vec<u64>) -> Self {
        while c.last() == Some(&0) {
            c.pop();
        }
        Self(c)
    }

    fn entry(&self, k: usize) -> u64 {
        self.0.get(k).copied().unwrap_or(0)
    }

    /// Quotient and remainder by a divisor that is not zero.
    fn divided(&self, divisor: &Self) -> (Self, Self) {
        let n = divisor.0.len();
        let scale = FIELD.inverse(divisor.0[n - 1]);
        let mut rest = self.0.clone();
        let count = (rest.len() + 1).saturating_sub(n);
        let mut quotient = vec![0; count];
        for k in (0..count).rev() {
            quotient[k] = product(rest[k + n - 1], scale);
            for (r, d) in rest[k..].iter_mut().zip(&divisor.0) {
                *r = FIELD.sub(*r, product(quotient[k], *d));
            }
        }
        (Self::new(quotient), Self::new(rest))
    }
}

impl Ring for FieldPoly {
    fn constant(value: &BigInt) -> Self {
        let residue = value.magnitude() % P;
        let r = residue.iter_u64_digits().next().unwrap_or(0);
        Self::new(vec![if value.sign() == Sign::Minus { FIELD.sub(0, r) } else { r }])
    }

    fn unknown() -> Self {
        Self(vec![0, 1])
    }

    fn plus(&self, other: &Self) -> Self {
        let n = self.0.len().max(other.0.len());
        Self::new((0..n).map(|k| reduced(u128::from(self.entry(k) + other.entry(k)))).collect())
    }

    fn minus(&self, other: &Self) -> Self {
        let n = self.0.len().max(other.0.len());
        Self::new((0..n).map(|k| FIELD.sub(self.entry(k), other.entry(k))).collect())
    }

    fn times(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self(Vec::new());
        }
        let mut out = vec![0; self.0.len() + other.0.len() - 1];
        for (k, o) in out.iter_mut().enumerate() {
            let first = k.saturating_sub(other.0.len() - 1);
            let last = k.min(self.0.len() - 1);
            // each product is below 2^122: thirty-two of them fit with room
            for block in (first..=last).step_by(32) {
                let end = (block + 31).min(last);
                let sum: u128 =
                    (block..=end).map(|i| u128::from(self.0[i]) * u128::from(other.0[k - i])).sum();
                let high = reduced(u128::from(reduced(sum >> 61)));
                *o = reduced(u128::from(*o) + u128::from(high) + (sum & u128::from(P)));
            }
        }
        Self::new(out)
    }

    fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    fn exact_div(&self, divisor: &Self) -> Option<Self> {
        if divisor.is_zero() {
            return None;
        }
        let (quotient, rest) = self.divided(divisor);
        rest.is_zero().then_some(quotient)
    }

    fn degree(&self) -> Option<usize> {
        self.0.len().checked_sub(1)
    }

    fn squarefree_degree(&self) -> usize {
        let derivative = self.0.iter().enumerate().skip(1).map(|(k, c)| product(*c, k as u64)).collect();
        let (mut a, mut b) = (self.clone(), Self::new(derivative));
        while !b.is_zero() {
            let (_, rest) = a.divided(&b);
            (a, b) = (b, rest);
        }
        self.0.len() - a.0.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::Rng;

    #[test]
    fn the_prime_field_is_an_image_of_the_integers() {
        let mut rng = Rng::new(4);
        for case in 0..40 {
            let mut draw =
                |n: usize| IntPoly::new((0..n).map(|_| BigInt::from(rng.next_u64().cast_signed())).collect());
            let (p, q) = (draw(1 + case * 3), draw(2 + case));
            let image = |p: &IntPoly| {
                let c = p.coefficients().iter().map(|c| FieldPoly::constant(c).entry(0));
                FieldPoly::new(c.collect())
            };
            assert_eq!(image(&p).times(&image(&q)), image(&(&p * &q)));
            assert_eq!(image(&p).plus(&image(&q)), image(&(&p + &q)));
            assert_eq!(image(&p).minus(&image(&q)), image(&(&p - &q)));
            assert_eq!(image(&(&p * &q)).exact_div(&image(&q)), Some(image(&p)));
            assert_eq!(image(&(&(&p * &q) * &q)).squarefree_degree(), (&p * &q).degree().unwrap());
        }
        assert!(FieldPoly::constant(&BigInt::from(P)).is_zero());
    }
}
