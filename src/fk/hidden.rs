//! Two and three virtual legs: candidates by distances, certificates as for any other method.

use super::elimination::Candidates;
use super::{Completeness, FkOptions, FkSolutions, Method};
use crate::distance::HiddenLengths;
use crate::manipulator::{Manipulator, SquaredLegLengths};

/// Ways tried while the poses are not proved to be all, by number of virtual legs: with three each takes as long as a hundred with two.
const WAYS: [(usize, usize); 2] = [(2, 4), (3, 3)];

/// All poses of a design that needs two or three virtual legs, `None` for others.
///
/// Complete only when as many distinct poses are certified as the topology can have; of the poses that several ways find the certified are
/// kept, once each.
pub(super) fn solve(m: &Manipulator, s: &SquaredLegLengths, o: &FkOptions) -> Option<FkSolutions> {
    let hidden = HiddenLengths::of(m)?;
    let most = WAYS.iter().find(|w| w.0 == hidden.virtual_legs()).map_or(1, |w| w.1);
    let mut candidates = Candidates::default();
    let mut best: Option<FkSolutions> = None;
    let (mut tried, mut evaluations) = (0, 0);
    for way in 0..hidden.ways().min(most) {
        tried += 1;
        let Some(found) = hidden.poses(s, way) else { continue };
        evaluations += found.evaluations;
        candidates.add(found.poses);
        let solutions = candidates.solutions(Method::Trilateration, m, s, o);
        let proved = matches!(solutions.completeness, Completeness::Proved { .. });
        best = Some(solutions);
        if proved {
            break;
        }
    }
    let mut found = best.unwrap_or_else(|| candidates.solutions(Method::Trilateration, m, s, o));
    if let Completeness::Unproved { reason, .. } = &mut found.completeness {
        *reason = format!(
            "{tried} ways to hide a length, {evaluations} closure conditions: {} certified poses, fewer than the topology can \
             have, so that roots may be missing or the platform is a special one",
            found.roots.len()
        );
    }
    Some(found)
}
