//! The value of a set of variables, by code that the optimiser does not use.

use equipod::methods::design::Design;
use equipod::methods::geom::Pose;
use equipod::methods::manipulator::{
    Leg, Manipulator, Octahedral, default_home, inverse_condition, jacobian,
};
use equipod::methods::offsets::OffsetProblem;
use equipod::methods::requirements::CoordinateRange;
use nalgebra::Point3;

use super::verdict::Judged;

/// Values and violations at points of a box of variables; larger values are better.
pub(crate) trait Judge: Sync {
    /// Least and greatest value of every variable.
    fn bounds(&self) -> &[(f64, f64)];
    /// Violation of the worst requirement, without unit; 0 when all are met.
    fn violation(&self, x: &[f64]) -> f64;
    /// The objective.
    fn value(&self, x: &[f64]) -> f64;
    /// Whether nothing is violated.
    fn is_feasible(&self, x: &[f64]) -> bool {
        self.violation(x) <= 0.0
    }
    /// The value of a feasible point that may be the best so far, examined more closely; `None` when that finds a
    /// violation.
    fn confirm(&self, x: &[f64]) -> Option<f64> {
        Some(self.value(x))
    }
    /// The last judgement of an answer.
    fn last_word(&self, x: &[f64]) -> Judged {
        Judged { value: self.value(x), violation: self.violation(x) }
    }
}

/// Offsets of an octahedral platform, from its two triangles and the public Jacobian.
#[derive(Debug)]
pub(crate) struct OffsetJudge {
    base: [Point3<f64>; 3],
    platform: [Point3<f64>; 3],
    poses: Vec<Pose>,
    length: f64,
    min_distance: f64,
    min_abs_det: f64,
    bounds: [(f64, f64); 6],
}

impl OffsetJudge {
    pub(crate) fn new(p: &OffsetProblem) -> Self {
        Self {
            base: p.octahedral.base(),
            platform: p.octahedral.platform(),
            poses: p.poses.clone(),
            length: p.characteristic_length,
            min_distance: p.min_joint_distance,
            min_abs_det: p.min_abs_det,
            bounds: p.bounds,
        }
    }

    /// The legs at offsets `t`: on the side from leg `i` to leg `i + 1` of the cycle
    /// `P1P4, P2P4, P2P5, P3P5, P3P6, P1P6`.
    pub(crate) fn legs(&self, t: &[f64]) -> [Leg; 6] {
        std::array::from_fn(|i| {
            let (k, next) = (i / 2, (i / 2 + 1) % 3);
            let between = |v: &[Point3<f64>; 3]| Point3::from(v[k].coords.lerp(&v[next].coords, t[i]));
            if i % 2 == 0 {
                Leg { base: between(&self.base), platform: self.platform[k] }
            } else {
                Leg { base: self.base[next], platform: between(&self.platform) }
            }
        })
    }
}

fn least_distance(points: &[Point3<f64>; 6]) -> f64 {
    let pairs = (0..6).flat_map(|i| (0..i).map(move |j| (i, j)));
    pairs.map(|(i, j)| (points[i] - points[j]).norm()).fold(f64::INFINITY, f64::min)
}

impl Judge for OffsetJudge {
    fn bounds(&self) -> &[(f64, f64)] {
        &self.bounds
    }

    fn violation(&self, x: &[f64]) -> f64 {
        let legs = self.legs(x);
        let apart = least_distance(&legs.map(|l| l.base)).min(least_distance(&legs.map(|l| l.platform)));
        // the determinant of the cyclic bidiagonal matrix of the leg map
        let det = x.iter().map(|t| 1.0 - t).product::<f64>() - x.iter().product::<f64>();
        let outside = x.iter().zip(&self.bounds).map(|(x, b)| (b.0 - x).max(x - b.1));
        let missed = [(self.min_distance - apart) / self.length, self.min_abs_det - det.abs()];
        missed.into_iter().chain(outside).fold(0.0, f64::max)
    }

    fn value(&self, x: &[f64]) -> f64 {
        let Ok(m) = Manipulator::from_legs(self.legs(x)) else { return 0.0 };
        let at = |pose: &Pose| inverse_condition(&jacobian(&m, pose, self.length));
        self.poses.iter().map(at).fold(f64::INFINITY, f64::min)
    }
}

/// The problem that `equipod optimize DESIGN --extension X` solves; `None` when the design is not octahedral.
pub(crate) fn offset_problem(design: &Design, extension: f64) -> Option<OffsetProblem> {
    let octahedral = Octahedral::recognise(design.manipulator()).ok()?;
    let home = design.home.unwrap_or_else(|| default_home(design.manipulator()));
    let mut workspace = design.workspace.clone();
    if workspace.is_empty() {
        // the documented default: 15 % of the size, 10 degrees
        workspace.translation = [CoordinateRange::within(0.15 * design.manipulator().size()); 3];
        workspace.rotation_deg = [CoordinateRange::within(10.0); 3];
    }
    let default = OffsetProblem::with_defaults(octahedral, workspace.sample(&home));
    let table = &design.optimize;
    Some(OffsetProblem {
        characteristic_length: table.characteristic_length.unwrap_or(default.characteristic_length),
        min_joint_distance: table.min_joint_distance.unwrap_or(default.min_joint_distance),
        min_abs_det: table.min_abs_det.unwrap_or(default.min_abs_det),
        bounds: [(-extension, 1.0 + extension); 6],
        ..default
    })
}
