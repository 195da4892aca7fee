//! Points at infinity that all legs have in common.

use super::DEGREE;
use super::quadrics::{COORDINATES, Cut, Linear, QuadricPart, cut};
use super::quotient::{Outcome, close};
use crate::manipulator::ExactEnds;
use crate::num::Rng;
use crate::num::split::SplitField;

/// How many there are modulo the prime, with multiplicity; `None` when they are not seen to be finitely many.
///
/// With `h = 0` the quadrics and leg equations are homogeneous and know no lengths. A random linear form is set to one: a set without curves is then finite,
/// and one with curves is not. The dimension of a projective scheme does not fall modulo a prime, so that finitely many points are finitely many for the joints as they are.
pub(crate) fn points_at_infinity(split: &SplitField, ends: &[ExactEnds; 6], rng: &mut Rng) -> Option<usize> {
    let field = split.field();
    let mut equations = Vec::with_capacity(7);
    for [a, b] in ends {
        let mut row: Linear = [0; COORDINATES + 1];
        for i in 0..3 {
            let doubled = field.mul(field.integer(-2), split.residue(&a[i])?);
            for j in 0..3 {
                row[3 * i + j] = field.mul(doubled, split.residue(&b[j])?);
            }
            row[9 + i] = doubled;
            row[12 + i] = field.mul(field.integer(-2), split.residue(&b[i])?);
        }
        row[15] = 1;
        equations.push(row);
    }
    equations.push(std::array::from_fn(|_| rng.next_u64() >> 4));
    let Cut::Quadrics { unknowns, polynomials } = cut(field, &equations, QuadricPart::AtInfinity) else {
        return Some(0);
    };
    match close(field, unknowns, polynomials, DEGREE) {
        Outcome::Closed { by_degree, .. } => Some(by_degree.iter().sum()),
        Outcome::Open { .. } => None,
    }
}
