//! The closure carried out as the paper does: squared distances from coordinates, denominators cleared, roots squared out, nothing cancelled.

use super::ClosureError;
use super::data::{ExactData, cross, dot, minus};
use super::fraction::{Fraction, STEPS};
use super::ring::Ring;
use super::strip::{Closure, Strip};
use super::tower::Divisor;
use crate::topology::Sequence;

/// The polynomial without roots, and what belongs to it.
pub(super) struct Literal<R> {
    /// The norm of the numerator of the closure.
    pub(super) polynomial: R,
    /// Powers of the singular factors in the denominator of the closure.
    pub(super) exponents: [i32; STEPS],
    /// Number of roots in the closure.
    pub(super) levels: usize,
    /// The singular factors of the steps used, as numerators with the powers of earlier ones in their denominators.
    pub(super) factors: Vec<(Divisor<R>, [i32; STEPS])>,
}

pub(super) fn literal<R: Ring>(
    data: &ExactData,
    s: &Sequence,
    closure: Closure,
) -> Result<Literal<R>, ClosureError> {
    let mut strip = Strip::<R>::new(data, s, closure, true)?;
    for _ in 0..strip.closure.steps.min(STEPS) {
        strip.place()?;
    }
    let closure = condition(&strip)?;
    let f = &strip.fractions;
    let factors = f.factors.iter().cloned().zip(strip.singular.iter().map(|a| a.exponents)).collect();
    Ok(Literal {
        polynomial: f.tower.norm(&closure.numerator),
        exponents: closure.exponents,
        levels: closure.numerator.len().trailing_zeros() as usize,
        factors,
    })
}

/// Computed squared distance less the known one, times a positive integer.
fn condition<R: Ring>(strip: &Strip<'_, R>) -> Result<Fraction<R>, ClosureError> {
    let f = &strip.fractions;
    let (last, other) = (strip.closure.last, strip.closure.other);
    let places = strip.steps.map(|s| s.place);
    if places.contains(&last) {
        let d = strip.difference(&strip.coordinates(last), &strip.coordinates(other));
        return Ok(f.minus(&strip.product(&d, &d), &strip.closing()));
    }
    let [p1, p2, p3] = places;
    let point = |joint| strip.data.point(joint);
    let (y, z, k) = (minus(point(p2), point(p1)), minus(point(p3), point(p1)), minus(point(last), point(p1)));
    let normal = cross(&y, &z);
    let size = dot(&normal, &normal);
    let (n1, n2, n3) = (dot(&cross(&k, &z), &normal), dot(&cross(&y, &k), &normal), dot(&k, &normal));
    if size == 0.into() {
        return Err(ClosureError::Collinear { step: STEPS });
    }
    let origin = strip.coordinates(p1);
    let (y, z) = (
        strip.difference(&strip.coordinates(p2), &origin),
        strip.difference(&strip.coordinates(p3), &origin),
    );
    let w = strip.cross(&y, &z);
    let t = strip.difference(&origin, &strip.coordinates(other));
    let d: [Fraction<R>; 3] = std::array::from_fn(|i| {
        let terms =
            [f.scaled(&t[i], &size), f.scaled(&y[i], &n1), f.scaled(&z[i], &n2), f.scaled(&w[i], &n3)];
        f.sum(&terms)
    });
    Ok(f.minus(&strip.product(&d, &d), &f.scaled(&strip.closing(), &(&size * &size))))
}
