//! Two and three virtual legs: candidates by distances, certificates as for any other method.

use super::bounds::class_bound;
use super::harvest::HarvestEnd;
use super::trilateration::{ends_at, with_evidence};
use super::{FkError, FkOptions, FkSolutions, Theorem, Tried};
use crate::distance::HiddenLengths;
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// Ways tried while the poses are not proved to be all, by number of virtual legs. A way with three virtual legs takes
/// as long as a hundred with two.
const WAYS: [(usize, usize); 2] = [(2, 6), (3, 6)];

/// Values of closure conditions after which no further way is tried: the poses are fewer than usual.
const BUDGET: usize = 150_000;

/// All poses of a design that needs two or three virtual legs, `None` for others.
///
/// Complete only when as many distinct poses are certified as the topology can have; those that several ways find count
/// together. Joints in one place are one joint.
pub(super) fn solve(
    m: &Manipulator,
    s: &SquaredLegLengths,
    o: &FkOptions,
) -> Option<Result<FkSolutions, FkError>> {
    let m = &m.with_merged_joints();
    let hidden = HiddenLengths::of(m)?;
    let most = WAYS.iter().find(|w| w.0 == hidden.virtual_legs()).map_or(1, |w| w.1);
    let theorem = class_bound(m).unwrap_or(Theorem::SixLegs);
    let mut ends: Vec<HarvestEnd> = Vec::new();
    let mut evaluations = 0;
    let mut answer = None;
    for way in 0..hidden.ways().min(most) {
        if let Some(found) = hidden.poses(s, way) {
            evaluations += found.evaluations;
            ends.extend(ends_at(found.poses.into_iter().flatten()));
        }
        let tried = Tried::HiddenLengths { ways: way + 1, values: evaluations };
        let found = with_evidence(m, s, o, &ends, theorem.bound(), tried, theorem);
        let settled = found.as_ref().ok().is_none_or(|f| f.completeness.is_proved());
        answer = Some(found);
        if settled || evaluations > BUDGET {
            break;
        }
    }
    answer
}
