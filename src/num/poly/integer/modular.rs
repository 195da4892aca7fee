//! Polynomials modulo a prime below `2^61`.

use num_bigint::{BigInt, Sign};

use super::IntPoly;
use crate::modular::{Field, all_fields};

/// A prime modulus below `2^61`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Modulus(Field);

const MERSENNE: Modulus = Modulus(Field::MERSENNE);

impl Modulus {
    /// Primes below `2^61`, the largest first, practically without end.
    pub(super) fn primes() -> impl Iterator<Item = Self> {
        all_fields().map(Self)
    }

    pub(super) fn value(self) -> u64 {
        self.0.prime()
    }

    fn mul(self, a: u64, b: u64) -> u64 {
        self.0.mul(a, b)
    }

    fn sub(self, a: u64, b: u64) -> u64 {
        self.0.sub(a, b)
    }

    /// The inverse of a nonzero element.
    pub(super) fn inverse(self, a: u64) -> u64 {
        self.0.inverse(a)
    }

    /// The residue of an integer, between `0` and `p - 1`.
    pub(super) fn residue(self, x: &BigInt) -> u64 {
        let p = u128::from(self.value());
        let digits = x.magnitude().iter_u64_digits().rev();
        let r = digits.fold(0u128, |r, d| ((r << 64) | u128::from(d)) % p) as u64;
        if x.sign() == Sign::Minus { self.sub(0, r) } else { r }
    }

    /// Residues of the coefficients, zeros at the end dropped.
    pub(super) fn reduce(self, p: &IntPoly) -> Vec<u64> {
        let mut c: Vec<u64> = p.coefficients().iter().map(|c| self.residue(c)).collect();
        trim(&mut c);
        c
    }

    /// The remainder of `a` by the nonzero `b`.
    fn remainder(self, mut a: Vec<u64>, b: &[u64]) -> Vec<u64> {
        let inverse = self.inverse(b[b.len() - 1]);
        while a.len() >= b.len() {
            let q = self.mul(a[a.len() - 1], inverse);
            let place = a.len() - b.len();
            for (x, y) in a[place..].iter_mut().zip(b) {
                *x = self.sub(*x, self.mul(q, *y));
            }
            a.pop();
            trim(&mut a);
        }
        a
    }

    /// The greatest common divisor with leading coefficient one.
    pub(super) fn gcd(self, mut a: Vec<u64>, mut b: Vec<u64>) -> Vec<u64> {
        while !b.is_empty() {
            let r = self.remainder(a, &b);
            (a, b) = (b, r);
        }
        let inverse = a.last().map_or(0, |l| self.inverse(*l));
        a.into_iter().map(|c| self.mul(c, inverse)).collect()
    }

    pub(super) fn scale(self, a: &[u64], factor: u64) -> Vec<u64> {
        a.iter().map(|c| self.mul(*c, factor)).collect()
    }

    /// `(a - b) c`.
    pub(super) fn difference_times(self, a: u64, b: u64, c: u64) -> u64 {
        self.mul(self.sub(a, b), c)
    }
}

fn trim(c: &mut Vec<u64>) {
    while c.last() == Some(&0) {
        c.pop();
    }
}

/// `false` proves that `divisor` does not divide `p` over the integers.
pub(super) fn may_divide(divisor: &IntPoly, p: &IntPoly) -> bool {
    let d = MERSENNE.reduce(divisor);
    // a leading coefficient that vanishes modulo p gives no information
    d.len() != divisor.coefficients().len() || MERSENNE.remainder(MERSENNE.reduce(p), &d).is_empty()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modular::is_prime;

    #[test]
    fn primes_and_residues() {
        let primes: Vec<u64> = Modulus::primes().take(3).map(Modulus::value).collect();
        // 2^61 - 1, 2^61 - 31, 2^61 - 45
        assert_eq!(primes, [1, 31, 45].map(|k| (1u64 << 61) - k));
        let m = Modulus(Field::of_prime(97));
        assert_eq!(m.mul(m.inverse(35), 35), 1);
        assert_eq!(m.residue(&BigInt::from(-1)), 96);
        assert!(!is_prime(91) && !is_prime(3_215_031_751));
    }
}
