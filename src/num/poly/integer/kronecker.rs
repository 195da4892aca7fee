//! Products of polynomials as one product of integers (Kronecker substitution).

use num_bigint::{BigInt, BigUint, Sign};
use num_traits::Zero;

/// Below this length of the shorter factor the direct sum of products is faster.
const SHORT: usize = 4;

/// The coefficients of the product.
pub(super) fn product(a: &[BigInt], b: &[BigInt]) -> Vec<BigInt> {
    let short = a.len().min(b.len());
    match short {
        0 => Vec::new(),
        1..SHORT => plain(a, b),
        _ => substituted(a, b),
    }
}

fn plain(a: &[BigInt], b: &[BigInt]) -> Vec<BigInt> {
    let mut out = vec![BigInt::zero(); a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate().filter(|(_, x)| !x.is_zero()) {
        for (j, y) in b.iter().enumerate() {
            out[i + j] += x * y;
        }
    }
    out
}

/// `a(B) b(B)` for a power `B = 2^(32 width)` more than twice every coefficient of the product.
fn substituted(a: &[BigInt], b: &[BigInt]) -> Vec<BigInt> {
    let bits = |c: &[BigInt]| c.iter().map(BigInt::bits).max().unwrap_or(0);
    let terms = a.len().min(b.len()) as u64;
    let needed = bits(a) + bits(b) + u64::from(64 - terms.leading_zeros()) + 2;
    let width = needed.div_ceil(32) as usize;
    unpack(&(pack(a, width) * pack(b, width)), width, a.len() + b.len() - 1)
}

fn pack(c: &[BigInt], width: usize) -> BigInt {
    let mut parts = [vec![0u32; c.len() * width], vec![0u32; c.len() * width]];
    for (k, c) in c.iter().enumerate() {
        let part = &mut parts[usize::from(c.sign() == Sign::Minus)];
        for (place, digit) in part[k * width..].iter_mut().zip(c.magnitude().iter_u32_digits()) {
            *place = digit;
        }
    }
    let [plus, minus] = parts.map(|p| BigInt::from_biguint(Sign::Plus, BigUint::new(p)));
    plus - minus
}

/// Digits in base `B` between `-B/2` and `B/2`.
fn unpack(value: &BigInt, width: usize, count: usize) -> Vec<BigInt> {
    let negative = value.sign() == Sign::Minus;
    let mut digits = value.magnitude().to_u32_digits();
    digits.resize(width * count, 0);
    let base = BigInt::from(1) << (32 * width);
    let mut carry = false;
    digits
        .chunks(width)
        .map(|slot| {
            let mut c = BigInt::from_biguint(Sign::Plus, BigUint::from_slice(slot));
            if carry {
                c += 1;
            }
            carry = c.bits() >= 32 * width as u64;
            if carry {
                c -= &base;
            }
            if negative { -c } else { c }
        })
        .collect()
}
