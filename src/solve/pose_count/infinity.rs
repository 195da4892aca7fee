//! Points at infinity that all legs have in common.

use super::joints::EndResidues;
use super::quadrics::{Cut, H, Linear, cut};
use super::quotient::{Outcome, close};
use super::{DEGREE, leg_equation};
use crate::num::Rng;
use crate::num::modular::Field;

/// Whether they are seen to be finitely many, whatever the lengths.
///
/// With `h = 0` the quadrics and leg equations are homogeneous and know no lengths. A set without curves misses a random hyperplane, and one with curves meets
/// every hyperplane: no zeros are left but zero itself when the algebra has finite dimension. The dimension of a projective scheme does not fall modulo a prime, so that
/// finitely many points are finitely many for the joints as they are.
pub(crate) fn are_points_at_infinity_finite(field: Field, ends: &EndResidues, rng: &mut Rng) -> bool {
    let mut equations: Vec<Linear> = ends.iter().map(|end| leg_equation(field, end, 0)).collect();
    equations.push(std::array::from_fn(|k| u64::from(k == H)));
    let mut hyperplane: Linear = std::array::from_fn(|_| rng.next_u64() >> 4);
    hyperplane[H] = 0;
    equations.push(hyperplane);
    match cut(field, &equations) {
        Cut::Empty => true,
        Cut::Quadrics { unknowns, polynomials } => {
            matches!(close(field, unknowns, polynomials, DEGREE), Outcome::Closed { .. })
        }
    }
}
