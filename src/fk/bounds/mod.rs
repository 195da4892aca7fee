//! Proved upper bounds on the number of isolated finite poses of special designs, for all lengths.
//!
//! Statements and proofs: `docs/theory/completeness.md`. The conditions of a theorem are decided exactly, on joints of
//! a field of square roots or on the doubles as they are.

mod shared;

pub(super) use shared::class_bound;

use super::Theorem;
use crate::solve::special::special_position;
use platform::manipulator::Manipulator;

/// The smallest proved bound on the number of isolated finite poses of a design, for all lengths.
pub fn pose_bound(m: &Manipulator) -> Theorem {
    let special = [class_bound(m), special_bound(m)];
    special.into_iter().flatten().min_by_key(|theorem| theorem.bound()).unwrap_or(Theorem::SixLegs)
}

/// The smallest bound below 40 that the position of the joints gives beside those that legs share ([`class_bound`]), if
/// any.
///
/// The work of some milliseconds where there is one, of a fraction of one where there is none.
pub(super) fn special_bound(m: &Manipulator) -> Option<Theorem> {
    let position = special_position(m, 1)?;
    let line = match position.on_a_line {
        0..4 => None,
        4 => Some(Theorem::FourOnALine),
        _ => Some(Theorem::FiveOnALine),
    };
    let affine = position.affine_hexagons.then_some(Theorem::AffineHexagons);
    let infinity = position.at_infinity.map(|found| Theorem::PointsAtInfinity {
        butterflies: found.butterflies,
        inversions: found.inversions,
    });
    [line, affine, infinity].into_iter().flatten().min_by_key(|theorem| theorem.bound())
}
