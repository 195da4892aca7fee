//! Points at infinity that all legs have in common.

use super::joints::EndResidues;
use super::quadrics::{COORDINATES, Cut, Linear, QuadricPart, cut};
use super::quotient::{Outcome, close};
use super::{DEGREE, leg_equation};
use crate::num::Rng;
use crate::num::modular::Field;

/// How many there are modulo the prime, with multiplicity; `None` when they are not seen to be finitely many.
///
/// With `h = 0` the quadrics and leg equations are homogeneous and know no lengths. A random linear form is set to one: a set without curves is then finite,
/// and one with curves is not. The dimension of a projective scheme does not fall modulo a prime, so that finitely many points are finitely many for the joints as they are.
pub(crate) fn points_at_infinity(field: Field, ends: &EndResidues, rng: &mut Rng) -> Option<usize> {
    let homogeneous = |end: &[[u64; 3]; 2]| {
        let mut row = leg_equation(field, end, 0);
        row[COORDINATES] = 0;
        row
    };
    let mut equations: Vec<Linear> = ends.iter().map(homogeneous).collect();
    equations.push(std::array::from_fn(|_| rng.next_u64() >> 4));
    let Cut::Quadrics { unknowns, polynomials } = cut(field, &equations, QuadricPart::AtInfinity) else {
        return Some(0);
    };
    match close(field, unknowns, polynomials, DEGREE) {
        Outcome::Closed { by_degree, .. } => Some(by_degree.iter().sum()),
        Outcome::Open { .. } => None,
    }
}
