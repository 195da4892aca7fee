//! Polynomials modulo a prime below `2^61`.

use super::IntPoly;
use crate::modular::Field;

/// Residues of the coefficients, zeros at the end dropped.
pub(super) fn reduce(field: Field, p: &IntPoly) -> Vec<u64> {
    let mut c: Vec<u64> = p.coefficients().iter().map(|c| field.residue(c)).collect();
    trim(&mut c);
    c
}

/// The remainder of `a` by the nonzero `b`.
fn remainder(field: Field, mut a: Vec<u64>, b: &[u64]) -> Vec<u64> {
    let inverse = field.inverse(b[b.len() - 1]);
    while a.len() >= b.len() {
        let q = field.mul(a[a.len() - 1], inverse);
        let place = a.len() - b.len();
        for (x, y) in a[place..].iter_mut().zip(b) {
            *x = field.sub(*x, field.mul(q, *y));
        }
        a.pop();
        trim(&mut a);
    }
    a
}

/// The greatest common divisor with leading coefficient one.
pub(super) fn gcd(field: Field, mut a: Vec<u64>, mut b: Vec<u64>) -> Vec<u64> {
    while !b.is_empty() {
        let r = remainder(field, a, &b);
        (a, b) = (b, r);
    }
    let inverse = a.last().map_or(0, |l| field.inverse(*l));
    a.into_iter().map(|c| field.mul(c, inverse)).collect()
}

fn trim(c: &mut Vec<u64>) {
    while c.last() == Some(&0) {
        c.pop();
    }
}

/// `false` proves that `divisor` does not divide `p` over the integers.
pub(super) fn may_divide(divisor: &IntPoly, p: &IntPoly) -> bool {
    let field = Field::MERSENNE;
    let d = reduce(field, divisor);
    // a leading coefficient that vanishes modulo p gives no information
    d.len() != divisor.coefficients().len() || remainder(field, reduce(field, p), &d).is_empty()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modular::{all_fields, is_prime};
    use num_bigint::BigInt;

    #[test]
    fn primes_and_residues() {
        let primes: Vec<u64> = all_fields().take(3).map(Field::prime).collect();
        // 2^61 - 1, 2^61 - 31, 2^61 - 45
        assert_eq!(primes, [1, 31, 45].map(|k| (1u64 << 61) - k));
        let m = Field::modulo(97);
        assert_eq!(m.mul(m.inverse(35), 35), 1);
        assert_eq!(m.residue(&BigInt::from(-1)), 96);
        assert!(!is_prime(91) && !is_prime(3_215_031_751));
    }
}
