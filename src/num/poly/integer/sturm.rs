//! Sturm's theorem.

use num_bigint::Sign;

use super::{Dyadic, IntPoly};

/// The number of distinct real roots `x` with `low < x <= high` (Sturm 1829), for any `low <= high`.
///
/// The chain of signed pseudo-remainders is slow compared with [`real_roots`](super::real_roots); it serves as an
/// independent check.
#[must_use]
pub fn sturm_count(p: &IntPoly, low: &Dyadic, high: &Dyadic) -> usize {
    let chain = chain(p);
    changes(&chain, low).saturating_sub(changes(&chain, high))
}

/// The number of distinct real roots, from the signs of the chain at both ends of the line.
#[must_use]
pub fn sturm_count_of_line(p: &IntPoly) -> usize {
    let chain = chain(p);
    let changes = |side: i32| {
        let far = |q: &IntPoly| {
            let lead = q.leading().sign();
            if side < 0 && q.degree().is_some_and(|n| n % 2 == 1) { -lead } else { lead }
        };
        chain.windows(2).filter(|w| far(&w[0]) != far(&w[1])).count()
    };
    changes(-1).saturating_sub(changes(1))
}

/// `p_0 = p`, `p_1 = p'`, `p_(k+1) = -rem(p_(k-1), p_k)` up to positive factors.
fn chain(p: &IntPoly) -> Vec<IntPoly> {
    let mut chain = vec![signed_primitive(p), signed_primitive(&p.derivative())];
    while let [.., a, b] = chain.as_slice() {
        if b.is_zero() {
            chain.pop();
            break;
        }
        let next = signed_primitive(&-&positive_remainder(a, b));
        chain.push(next);
    }
    chain
}

fn signed_primitive(p: &IntPoly) -> IntPoly {
    let q = p.primitive();
    if p.leading().sign() == Sign::Minus { -&q } else { q }
}

/// A remainder of `c a` by `b` for some `c > 0`.
fn positive_remainder(a: &IntPoly, b: &IntPoly) -> IntPoly {
    let lead = b.leading();
    let factor = if lead.sign() == Sign::Minus { -&lead } else { lead.clone() };
    let mut rest = a.clone();
    while let (Some(n), Some(m)) = (rest.degree(), b.degree()) {
        if n < m {
            break;
        }
        let top = if lead.sign() == Sign::Minus { -rest.leading() } else { rest.leading() };
        let mut shifted = vec![num_bigint::BigInt::default(); n - m];
        shifted.extend(b.coefficients().iter().map(|c| c * &top));
        rest = &rest.scaled(&factor) - &IntPoly::new(shifted);
    }
    rest
}

fn changes(chain: &[IntPoly], x: &Dyadic) -> usize {
    let signs = chain.iter().map(|p| p.sign_at(x)).filter(|s| *s != Sign::NoSign);
    let signs: Vec<Sign> = signs.collect();
    signs.windows(2).filter(|w| w[0] != w[1]).count()
}
