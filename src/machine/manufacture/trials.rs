//! Random joint errors with solved poses, compared with the first order.

use nalgebra::{Point3, Vector3};

use super::joint::{displaced, joints};
use super::sample::ErrorBound;
use super::sensitivity::{Sensitivity, pose_error};
use super::uncertainty::MachineUncertainty;
use crate::requirements::PoseSpace;
use fk::NearSolver;
use num::{Purpose, Rng};
use platform::geom::Pose;
use platform::manipulator::{LegLengths, Manipulator, SquaredLegLengths};

/// The source of the joint errors.
#[derive(Debug, Clone, PartialEq)]
pub enum JointErrors {
    /// Every joint error uniform in a ball of this radius, design units.
    Balls(f64),
    /// Every joint error uniform in a box with these half widths, in the order of [`joints`].
    Boxes(Vec<Vector3<f64>>),
    /// Joints and leg offsets normal with the covariance of a calibration.
    Calibrated(MachineUncertainty),
}

impl JointErrors {
    /// Joint errors, and the amounts by which the legs show more than their lengths.
    fn draw(&self, count: usize, rng: &mut Rng) -> (Vec<Vector3<f64>>, [f64; 6]) {
        match self {
            Self::Balls(radius) => ((0..count).map(|_| in_ball(rng) * *radius).collect(), [0.0; 6]),
            Self::Boxes(half) => {
                (half.iter().map(|h| h.map(|h| h * rng.uniform(-1.0, 1.0))).collect(), [0.0; 6])
            }
            Self::Calibrated(uncertainty) => uncertainty.draw(rng),
        }
    }
}

/// Uniform in the unit ball.
fn in_ball(rng: &mut Rng) -> Vector3<f64> {
    loop {
        let x = Vector3::from_fn(|_, _| rng.uniform(-1.0, 1.0));
        if x.norm_squared() <= 1.0 {
            return x;
        }
    }
}

/// Quantiles of values.
// by the nearest rank; all zero when there is none
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema), schemars(rename = "QuantilesRecord", transform = num::nullable))]
pub struct Quantiles {
    /// Half of the values are below.
    pub median: f64,
    /// 90 % of the values are below.
    pub p90: f64,
    /// 99 % of the values are below.
    pub p99: f64,
    /// The greatest value.
    pub max: f64,
}

impl Quantiles {
    fn of(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let at = |percent: usize| {
            let rank = (percent * values.len()).div_ceil(100);
            values.get(rank.saturating_sub(1)).copied().unwrap_or(0.0)
        };
        Self { median: at(50), p90: at(90), p99: at(99), max: at(100) }
    }
}

/// Quantiles of pose errors.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    schemars(rename = "PoseErrorsRecord")
)]
pub struct ErrorSpread {
    /// Errors of the tool point, design units.
    pub position: Quantiles,
    /// Errors of the orientation, degrees.
    pub rotation_deg: Quantiles,
}

impl ErrorSpread {
    pub(super) fn of(errors: &[(f64, f64)]) -> Self {
        let (position, rotation) = errors.iter().map(|(p, w)| (*p, w.to_degrees())).unzip();
        Self { position: Quantiles::of(position), rotation_deg: Quantiles::of(rotation) }
    }
}

/// Results of random errors.
#[derive(Debug, Clone, PartialEq)]
pub struct Trials {
    /// Errors and poses drawn.
    pub count: usize,
    /// Draws at which a pose could not be followed to the measured lengths.
    pub lost: usize,
    /// Draws with both errors within the bound.
    pub within: usize,
    /// Errors of the nominal formula.
    pub formula: ErrorSpread,
    /// First-order errors minus solved errors.
    pub discrepancy: ErrorSpread,
    /// Errors left after one and after two Newton steps on the true joints.
    pub corrected: [ErrorSpread; 2],
}

/// One draw.
struct Draw {
    formula: (f64, f64),
    discrepancy: (f64, f64),
    corrected: [(f64, f64); 2],
}

fn norms((p, w): (Vector3<f64>, Vector3<f64>)) -> (f64, f64) {
    (p.norm(), w.norm())
}

/// The error of the pose computed with nominal joints when the true joints are off by `errors`. It is the error of the
/// tool point (design units) and the rotation vector, base frame. `None` when the pose cannot be followed to the
/// measured lengths.
#[must_use]
pub fn solved_error(
    m: &Manipulator,
    errors: &[Vector3<f64>],
    truth: &Pose,
    tool: &Point3<f64>,
) -> Option<(Vector3<f64>, Vector3<f64>)> {
    let measured = truth.squared_lengths(&displaced(m, errors).ok()?)?;
    let found = NearSolver::new(m).solve(&measured, truth).tracked().copied()?;
    Some(pose_error(&found, truth, tool))
}

/// Squared lengths with each leg longer by its offset; offsets of zero keep the exact bits.
fn shown(measured: &SquaredLegLengths, offsets: &[f64; 6]) -> Option<SquaredLegLengths> {
    if offsets.iter().all(|x| *x == 0.0) {
        return Some(*measured);
    }
    let lengths = measured.lengths().get();
    Some(LegLengths::try_new(std::array::from_fn(|leg| lengths[leg] + offsets[leg])).ok()?.squared())
}

fn draw(
    m: &Manipulator,
    nominal: &NearSolver,
    (errors, offsets): (&[Vector3<f64>], &[f64; 6]),
    truth: &Pose,
    tool: &Point3<f64>,
) -> Option<Draw> {
    let built = displaced(m, errors).ok()?;
    let measured = truth.squared_lengths(&built)?;
    let shown = shown(&measured, offsets)?;
    let found = nominal.solve(&shown, truth).tracked().copied()?;
    let solved = pose_error(&found, truth, tool);
    let sensitivity = Sensitivity::at(m, truth, tool)?;
    let (joints, lengths) = (sensitivity.error(errors), sensitivity.error_of_lengths(offsets));
    let linear = (joints.0 + lengths.0, joints.1 + lengths.1);
    let calibrated = NearSolver::new(&built);
    let after = |steps| {
        let pose = calibrated.newton_steps(&measured, &found, steps)?;
        Some(norms(pose_error(&pose, truth, tool)))
    };
    Some(Draw {
        formula: norms(solved),
        discrepancy: norms((solved.0 - linear.0, solved.1 - linear.1)),
        corrected: [after(1)?, after(2)?],
    })
}

/// Draws joint errors and poses, measures the leg lengths with these errors, solves for the pose with the nominal
/// joints and compares. [`JointErrors::Calibrated`] draws errors of leg offsets too. `NearSolver` starts from the true
/// pose.
#[must_use]
pub fn trials(
    m: &Manipulator,
    space: &PoseSpace,
    tool: &Point3<f64>,
    bound: &ErrorBound,
    errors: &JointErrors,
    (count, seed): (usize, u64),
) -> Trials {
    let (nominal, joints) = (NearSolver::new(m), joints(m).len());
    let listed = space.listed(1);
    let found: Vec<Draw> = (0..count)
        .filter_map(|k| {
            let mut rng = Purpose::TRIALS.item(seed, k as u64);
            let truth = space.draw(&listed, &mut rng);
            let (errors, offsets) = errors.draw(joints, &mut rng);
            draw(m, &nominal, (&errors, &offsets), &truth, tool)
        })
        .collect();
    let spread =
        |of: &dyn Fn(&Draw) -> (f64, f64)| ErrorSpread::of(&found.iter().map(of).collect::<Vec<_>>());
    let kept = |d: &&Draw| d.formula.0 <= bound.position && d.formula.1.to_degrees() <= bound.rotation_deg;
    Trials {
        count,
        lost: count - found.len(),
        within: found.iter().filter(kept).count(),
        formula: spread(&|d| d.formula),
        discrepancy: spread(&|d| d.discrepancy),
        corrected: [spread(&|d| d.corrected[0]), spread(&|d| d.corrected[1])],
    }
}
