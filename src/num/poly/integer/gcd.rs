//! Greatest common divisors modulo primes, and square-free factors.

use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_traits::One;

use super::IntPoly;
use super::modular;
use crate::modular::{Field, all_fields};

/// A square-free factor with its multiplicity.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SquarefreeFactor {
    /// Primitive, without multiple roots.
    pub factor: IntPoly,
    /// All its roots have this multiplicity.
    pub multiplicity: usize,
}

/// The greatest common divisor, primitive with positive leading coefficient (contents are ignored); zero if both are
/// zero.
///
/// It is computed modulo primes, combined by the Chinese remainder theorem until the candidate divides both, which
/// proves it (Brown 1971). Its degree cannot be too small, since it comes from a prime that divides neither leading
/// coefficient.
#[must_use]
pub fn gcd(a: &IntPoly, b: &IntPoly) -> IntPoly {
    let (a, b) = (a.primitive(), b.primitive());
    if a.is_zero() {
        return b;
    }
    if b.is_zero() {
        return a;
    }
    let lead = a.leading().gcd(&b.leading());
    let mut found = Combined::default();
    for field in all_fields() {
        let (ra, rb, l) = (modular::reduce(field, &a), modular::reduce(field, &b), field.residue(&lead));
        if ra.len() != a.coefficients().len() || rb.len() != b.coefficients().len() {
            continue;
        }
        let image = modular::gcd(field, ra, rb);
        if image.len() == 1 {
            break;
        }
        if found.add(field, image.iter().map(|c| field.mul(*c, l)).collect()) {
            let candidate = found.candidate();
            if a.exact_div(&candidate).is_some() && b.exact_div(&candidate).is_some() {
                return candidate;
            }
        }
    }
    IntPoly::constant(BigInt::one())
}

/// Coefficients modulo the product of the primes so far, between minus half of it and half of it.
#[derive(Default)]
struct Combined {
    product: BigInt,
    coefficients: Vec<BigInt>,
}

impl Combined {
    /// Adds one more image; `true` if it changed nothing.
    fn add(&mut self, field: Field, image: Vec<u64>) -> bool {
        let p = BigInt::from(field.prime());
        if self.coefficients.is_empty() || image.len() < self.coefficients.len() {
            // earlier primes had additional common roots
            self.coefficients = image.into_iter().map(|c| centred(&BigInt::from(c), &p)).collect();
            self.product = p;
            return false;
        }
        if image.len() > self.coefficients.len() {
            return false;
        }
        let inverse = field.inverse(field.residue(&self.product));
        let (mut same, product) = (true, &self.product * p);
        for (c, r) in self.coefficients.iter_mut().zip(image) {
            let step = field.mul(field.sub(r, field.residue(c)), inverse);
            if step != 0 {
                same = false;
                *c = centred(&(&*c + &self.product * step), &product);
            }
        }
        self.product = product;
        same
    }

    fn candidate(&self) -> IntPoly {
        IntPoly::new(self.coefficients.clone()).primitive()
    }
}

fn centred(c: &BigInt, modulus: &BigInt) -> BigInt {
    let c = c.mod_floor(modulus);
    if &c + &c > *modulus { c - modulus } else { c }
}

/// `p = c prod factor^multiplicity`, multiplicities ascending, factors without common roots (Yun 1976). Empty for
/// constants and zero.
#[must_use]
pub fn squarefree_factors(p: &IntPoly) -> Vec<SquarefreeFactor> {
    let p = p.primitive();
    let mut out = Vec::new();
    if p.degree().is_none_or(|n| n == 0) {
        return out;
    }
    let derivative = p.derivative();
    let g = gcd(&p, &derivative);
    // v = product of the distinct factors, w is its companion
    let (mut v, mut w) = (quotient(&p, &g), quotient(&derivative, &g));
    let mut multiplicity = 1;
    while v.degree() != Some(0) {
        let rest = &w - &v.derivative();
        let factor = if rest.is_zero() { v.primitive() } else { gcd(&v, &rest) };
        (v, w) = (quotient(&v, &factor), quotient(&rest, &factor));
        if factor.degree() != Some(0) {
            out.push(SquarefreeFactor { factor, multiplicity });
        }
        multiplicity += 1;
    }
    out
}

/// Division by a primitive divisor.
fn quotient(p: &IntPoly, divisor: &IntPoly) -> IntPoly {
    assert!(divisor.leading().sign() == Sign::Plus);
    p.exact_div(divisor).unwrap_or_else(|| unreachable!("a common divisor divides"))
}
