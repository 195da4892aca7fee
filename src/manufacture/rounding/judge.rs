//! What a rounded design is worth: conditioning, requirements, distances of joints.

use std::collections::BTreeMap;

use nalgebra::Point3;

use super::RoundingProblem;
use crate::geom::Pose;
use crate::manipulator::{Manipulator, inverse_condition, jacobian};
use crate::requirements::{TermKind, Terms};

/// The numbers by which roundings are compared.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgement {
    /// Worst inverse condition number over the poses.
    pub objective: f64,
    /// Where.
    pub worst_pose: Pose,
    /// Least distance of two joints of the base and of the platform, design units.
    pub least_distances: [f64; 2],
    /// `det A` of the leg map from the octahedral platform, where there is one.
    pub det: Option<f64>,
    /// Least margin of each kind of requirement at the poses.
    pub margins: Vec<(TermKind, f64)>,
    /// No margin is below 0 by more than rounding and `|det A|` is as large as required.
    pub met: bool,
}

fn least_distance(joints: &[Point3<f64>], used: &[usize; 6]) -> f64 {
    let mut least = f64::INFINITY;
    for i in 0..joints.len() {
        for j in (0..i).filter(|j| used.contains(&i) && used.contains(j)) {
            least = least.min((joints[i] - joints[j]).norm());
        }
    }
    least
}

/// The worst inverse condition number when it is above `floor`, poses from number `hint` on first; `hint` becomes the number of the worst.
pub(super) fn objective_above(
    m: &Manipulator,
    problem: &RoundingProblem<'_>,
    floor: f64,
    hint: &mut usize,
) -> Option<f64> {
    let count = problem.poses.len();
    let (mut worst, start) = (f64::INFINITY, *hint);
    for k in (0..count).map(|k| (start + k) % count) {
        let value = inverse_condition(&jacobian(m, &problem.poses[k], problem.characteristic_length));
        if value < worst {
            (worst, *hint) = (value, k);
        }
        if !(worst > floor) {
            return None;
        }
    }
    Some(worst)
}

/// Least margins at the poses, and whether none is violated.
fn margins(m: &Manipulator, problem: &RoundingProblem<'_>) -> (Vec<(TermKind, f64)>, bool) {
    let terms = Terms::new(m, problem.requirements, &problem.space.home);
    let mut least: BTreeMap<TermKind, (f64, Option<&Pose>)> = BTreeMap::new();
    let at = |pose| terms.at(pose).into_iter().map(move |(term, margin)| (term, margin, Some(pose)));
    let fixed = terms.fixed().into_iter().map(|(term, margin)| (term, margin, None));
    for (term, margin, pose) in fixed.chain(problem.poses.iter().flat_map(at)) {
        let entry = least.entry(term.kind).or_insert((margin, pose));
        if margin < entry.0 {
            *entry = (margin, pose);
        }
    }
    let met = least.iter().all(|(kind, (margin, pose))| terms.standing(*kind, *margin, *pose).is_met());
    (least.into_iter().map(|(kind, (margin, _))| (kind, margin)).collect(), met)
}

/// Everything about a design.
pub(super) fn judge(m: &Manipulator, problem: &RoundingProblem<'_>, det: Option<f64>) -> Judgement {
    let mut hint = 0;
    let objective = objective_above(m, problem, -1.0, &mut hint).unwrap_or(0.0);
    let ((margins, requirements_met), pairs) = (margins(m, problem), m.pairs());
    let det_met = problem.min_abs_det.is_none_or(|least| det.is_none_or(|det| det.abs() >= least));
    Judgement {
        objective,
        worst_pose: problem.poses[hint],
        least_distances: [
            least_distance(m.base_joints(), &pairs.map(|p| p.0)),
            least_distance(m.platform_joints(), &pairs.map(|p| p.1)),
        ],
        det,
        met: det_met && requirements_met,
        margins,
    }
}
