//! Answers about a machine calibrated from measurements.

use schemars::JsonSchema;
use serde::Serialize;

use super::{Number, PoseConventionRecord, PoseInFrames, PoseQuaternionRecord};
use ask::Design;
use ask::calibrating::{carried, unknown_names};
use machine::calibration::{
    Calibration, CalibrationStatus, CarriedFrames, ChiSquare, LegModel, Loss, LossUnit, MeasurementNoise,
    NoiseSource, Observability, Outlier, PoseDeviation, ResidualSpread, Starts, UnobservableChange,
    pose_deviation,
};
use num::shown::fixed;
use platform::geom::Pose;
use platform::manipulator::Body;

/// The answer of `calibrate`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CalibrateAnswer {
    /// The name of the design.
    pub name: String,
    /// The unit of lengths.
    pub units: String,
    /// The convention in which measured poses were read, and of `in_frames`.
    pub frames: PoseConventionRecord,
    /// How it ended.
    pub outcome: CalibrateOutcome,
    /// Why it ended so, in a sentence.
    pub reason: String,
    /// What was found; null: nothing was measured, and poses to measure were asked for.
    pub calibration: Option<CalibrationRecord>,
    /// The poses at which another measurement says most, the best first.
    pub next_poses: Vec<NextPoseRecord>,
    /// The design that was written; null: none.
    pub path: Option<String>,
}

/// How a calibration ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CalibrateOutcome {
    /// All unknowns are identified, and nothing speaks against the model.
    Calibrated,
    /// Some changes of the machine are not seen by the measurements.
    NotIdentifiable,
    /// The residuals are too large for the noise given: the model, the noise or a measurement is wrong.
    Refuted,
    /// The fit did not converge, or there are no more numbers than unknowns.
    Undecided,
    /// Nothing was measured yet.
    Planned,
}

impl From<CalibrationStatus> for CalibrateOutcome {
    fn from(status: CalibrationStatus) -> Self {
        match status {
            CalibrationStatus::Calibrated => Self::Calibrated,
            CalibrationStatus::NotIdentifiable => Self::NotIdentifiable,
            CalibrationStatus::Refuted => Self::Refuted,
            CalibrationStatus::Undecided => Self::Undecided,
        }
    }
}

/// What was found.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CalibrationRecord {
    /// Poses measured.
    pub poses: usize,
    /// Coordinates and offsets sought.
    pub unknowns: usize,
    /// The frames of joints, deviations and covariance.
    pub frames: CalibrationFrames,
    /// The motions from the frames of the measurements to those of the design; null: joints are in the frames of the
    /// measurements.
    pub motions: Option<CarriedFrames>,
    /// How uncertain measurements are.
    pub noise: NoiseRecord,
    /// How far measurements cost.
    pub loss: LossRecord,
    /// Where the fit began.
    pub start: Starts,
    /// Whether its steps ended where they must.
    pub converged: bool,
    /// Steps in all.
    pub steps: usize,
    /// The joints that carry legs.
    pub joints: Vec<CalibratedJointRecord>,
    /// Leg offsets in leg order: shown length less distance of the joints.
    pub offsets: Vec<CalibratedOffsetRecord>,
    /// Covariance of the unknowns, squared design units; directions that are not identified have none.
    pub covariance: CovarianceRecord,
    /// How uncertain poses are that are computed with the machine; null: not all unknowns are identified, or the design
    /// has no pose to look at.
    pub computed_poses: Option<ComputedPosesRecord>,
    /// Which changes of the machine the measurements see, and how well.
    pub observability: ObservabilityRecord,
    /// Residuals of the design as it is.
    pub before: ResidualsRecord,
    /// Residuals of the calibrated machine, without outliers.
    pub after: ResidualsRecord,
    /// Residuals of each pose for the machine that the other poses give, to first order, without outliers.
    pub left_out: ResidualsRecord,
    /// Residuals of the measurements of `--check`; null: there are none.
    pub check: Option<ResidualsRecord>,
    /// Lines of measurements without which the unknowns are not determined.
    pub indispensable: Vec<usize>,
    /// Agreement of the residuals with the noise.
    pub chi_square: ChiSquare,
    /// Measurements that do not belong to the others, the farthest first.
    pub outliers: Vec<OutlierRecord>,
    /// Two legs, from 1, whose measured lengths look exchanged: they are five times nearer to the design when they
    /// change places; null: none do.
    pub exchanged_legs: Option<[usize; 2]>,
}

/// The frames of calibrated joints.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CalibrationFrames {
    /// Those of the measured poses.
    Measured,
    /// Those of the design.
    Design,
}

/// Standard deviations of measurements.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct NoiseRecord {
    /// Where they come from.
    pub source: NoiseSource,
    /// Of a length, design units.
    pub length: Number,
    /// Of each coordinate of the platform origin, design units.
    pub position: Number,
    /// Of each component of the rotation vector, degrees.
    pub rotation_deg: Number,
}

impl NoiseRecord {
    fn new(noise: &MeasurementNoise, source: NoiseSource) -> Self {
        Self {
            source,
            length: Number(noise.length),
            position: Number(noise.position),
            rotation_deg: Number(noise.rotation.to_degrees()),
        }
    }
}

/// How much far measurements cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub struct LossRecord {
    /// The loss.
    pub loss: Loss,
    /// What is doubted together.
    pub of: LossUnit,
}

/// A joint.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CalibratedJointRecord {
    /// Its body.
    pub body: Body,
    /// Its name.
    pub joint: String,
    /// Where it is, frame of the body.
    pub position: [Number; 3],
    /// Standard deviations of the coordinates; null: it was held.
    pub deviations: Option<[Number; 3]>,
    /// From where the design has it.
    pub moved: [Number; 3],
}

/// The offset of a leg.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct CalibratedOffsetRecord {
    /// From 1.
    pub leg: usize,
    /// What the length shown is longer than the distance of the joints, design units.
    pub offset: Number,
    /// Its standard deviation; null: it was held.
    pub deviation: Option<Number>,
}

/// A covariance matrix.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CovarianceRecord {
    /// Names of rows and columns: `base.A1.x`, `offset.3`.
    pub unknowns: Vec<String>,
    /// Rows.
    pub matrix: Vec<Vec<Number>>,
}

/// Standard deviations of poses computed from lengths, by what the calibration does not know, with all correlations;
/// the noise of these lengths comes on top.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct ComputedPosesRecord {
    /// Poses looked at: those of the workspace at which the requirements of the design are met.
    pub poses: usize,
    /// Root mean square of the distance by which the platform origin of the measurements is off, design units: the
    /// median over the poses.
    pub position_median: Number,
    /// The greatest of them.
    pub position_greatest: Number,
    /// Root mean square of the angle by which the orientation is off, degrees: the median over the poses.
    pub rotation_deg_median: Number,
    /// The greatest of them.
    pub rotation_deg_greatest: Number,
    /// The pose with the greatest deviation of the position.
    pub pose: PoseQuaternionRecord,
}

impl ComputedPosesRecord {
    /// Of a machine at poses in the frames of its measurements; `None` without a pose that is not singular.
    #[must_use]
    pub fn new(found: &Calibration, poses: &[Pose]) -> Option<Self> {
        let at =
            |pose: &Pose| Some((*pose, pose_deviation(&found.model, &found.unknowns, &found.root, pose)?));
        let all: Vec<(Pose, PoseDeviation)> = poses.iter().filter_map(at).collect();
        let worst = all.iter().max_by(|a, b| a.1.position.total_cmp(&b.1.position))?;
        let sorted = |of: fn(&PoseDeviation) -> f64| {
            let mut values: Vec<f64> = all.iter().map(|(_, d)| of(d)).collect();
            values.sort_by(f64::total_cmp);
            (values[(values.len() - 1) / 2], values[values.len() - 1])
        };
        let (position, rotation) = (sorted(|d| d.position), sorted(|d| d.rotation.to_degrees()));
        Some(Self {
            poses: all.len(),
            position_median: Number(position.0),
            position_greatest: Number(position.1),
            rotation_deg_median: Number(rotation.0),
            rotation_deg_greatest: Number(rotation.1),
            pose: (&worst.0).into(),
        })
    }
}

/// Which changes of the machine the measurements see, and how well.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ObservabilityRecord {
    /// Directions identified.
    pub rank: usize,
    /// Of the identification matrix, whitened and multiplied by the deviation of a length; largest first, without unit.
    pub singular_values: Vec<Number>,
    /// Smaller values are directions that are not identified.
    pub tolerance: Number,
    /// `(s_1 .. s_m)^(1/m) / sqrt(n)` (Borm, Menq 1991).
    pub volume_index: Number,
    /// `s_m / s_1` (Driels, Pathre 1990).
    pub inverse_condition: Number,
    /// `s_m^2 / s_1` (Nahvi, Hollerbach 1996).
    pub noise_amplification: Number,
    /// `1 / (1/s_1 + .. + 1/s_m)` (Sun, Hollerbach 2008).
    pub harmonic_index: Number,
    /// Changes of the machine that are not identified, each of norm 1 over all unknowns.
    pub unobservable: Vec<UnobservableRecord>,
}

/// A change of joints and offsets that changes no measured length, or hardly.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct UnobservableRecord {
    /// Joints that move, the farthest first.
    pub joints: Vec<JointShiftRecord>,
    /// Offsets that change.
    pub offsets: Vec<OffsetShiftRecord>,
}

/// How a joint moves.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct JointShiftRecord {
    /// Its body.
    pub body: Body,
    /// Its name.
    pub joint: String,
    /// The shift, frame of the body in which the poses were measured.
    pub shift: [Number; 3],
}

/// How an offset changes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct OffsetShiftRecord {
    /// From 1.
    pub leg: usize,
    /// The change.
    pub change: Number,
}

impl UnobservableRecord {
    fn new(design: &Design, change: &UnobservableChange) -> Self {
        let joints = change.joints.iter().map(|(body, joint, shift)| JointShiftRecord {
            body: *body,
            joint: design.joint_names(*body)[*joint].clone(),
            shift: [shift.x, shift.y, shift.z].map(Number),
        });
        let offsets = change.offsets.iter();
        Self {
            joints: joints.collect(),
            offsets: offsets.map(|(leg, x)| OffsetShiftRecord { leg: leg + 1, change: Number(*x) }).collect(),
        }
    }

    /// The change in words: `base.A1 (0.71, 0, 0), platform.B1 (0.71, 0, 0)`.
    #[must_use]
    pub fn words(&self) -> String {
        let joint = |j: &JointShiftRecord| {
            let shift = j.shift.map(|x| fixed(x.0, 3));
            format!("{}.{} ({})", j.body, j.joint, shift.join(", "))
        };
        let offset = |o: &OffsetShiftRecord| format!("offset {} by {}", o.leg, fixed(o.change.0, 3));
        let all: Vec<String> = self.joints.iter().map(joint).chain(self.offsets.iter().map(offset)).collect();
        all.join(", ")
    }
}

/// Sizes of residuals, design units.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ResidualsRecord {
    /// Root mean square.
    pub rms: Number,
    /// Of each leg.
    pub legs: [Number; 6],
    /// The one of the largest size; null: none was counted.
    pub greatest: Option<GreatestResidualRecord>,
    /// Lengths counted.
    pub count: usize,
}

/// The largest residual.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct GreatestResidualRecord {
    /// Line of the table of measurements.
    pub line: usize,
    /// From 1.
    pub leg: usize,
    /// Length measured less that of the model.
    pub value: Number,
}

impl ResidualsRecord {
    /// Those of measurements that stand on these lines.
    #[must_use]
    pub fn new(spread: &ResidualSpread, lines: &[usize]) -> Self {
        Self {
            rms: Number(spread.rms),
            legs: spread.legs.map(Number),
            greatest: spread.greatest.map(|g| GreatestResidualRecord {
                line: line(lines, g.measurement),
                leg: g.leg + 1,
                value: Number(g.value),
            }),
            count: spread.count,
        }
    }
}

/// The line of a measurement; its number where lines are not known.
fn line(lines: &[usize], measurement: usize) -> usize {
    lines.get(measurement).copied().unwrap_or(measurement + 1)
}

/// A measurement that does not belong to the others.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct OutlierRecord {
    /// Line of the table of measurements.
    pub line: usize,
    /// From 1; null: the whole pose.
    pub leg: Option<usize>,
    /// How far it is from the model, standard deviations.
    pub distance: Number,
    /// Right measurements are all nearer with a probability of 99 %.
    pub threshold: Number,
    /// Its weight in the fit.
    pub weight: Number,
}

impl OutlierRecord {
    fn new(outlier: &Outlier, lines: &[usize]) -> Self {
        Self {
            line: line(lines, outlier.measurement),
            leg: outlier.leg.map(|leg| leg + 1),
            distance: Number(outlier.distance),
            threshold: Number(outlier.threshold),
            weight: Number(outlier.weight),
        }
    }
}

/// A pose to measure next.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct NextPoseRecord {
    /// The pose, in the frames of the design where joints are carried to them, else in those of the measurements.
    pub pose: PoseQuaternionRecord,
    /// Roll, pitch and yaw of it, degrees.
    pub rpy_deg: [Number; 3],
    /// The pose in the convention of `frames`.
    pub in_frames: PoseInFrames,
    /// By what factor the geometric mean of the deviations along the axes of the error ellipsoid becomes smaller with
    /// it.
    pub shrinks: Number,
    /// The greatest standard deviation of a coordinate or offset after it and those before it, design units.
    pub greatest_deviation: Number,
}

impl CalibrationRecord {
    /// What was found from measurements on these lines, carried to the frames of the design where `frames` say how.
    #[must_use]
    pub fn new(
        design: &Design,
        found: &Calibration,
        (loss, of): (Loss, LossUnit),
        frames: Option<&CarriedFrames>,
        lines: &[usize],
    ) -> Self {
        let (model, root) = carried(found, frames);
        let deviation = |column: usize| Number(root.row(column).norm());
        let covariance = &root * root.transpose();
        let residuals = |spread: &ResidualSpread| ResidualsRecord::new(spread, lines);
        Self {
            poses: found.weights.len(),
            unknowns: found.unknowns.count(),
            frames: if frames.is_some() { CalibrationFrames::Design } else { CalibrationFrames::Measured },
            motions: frames.cloned(),
            noise: NoiseRecord::new(&found.noise, found.noise_source),
            loss: LossRecord { loss, of },
            start: found.starts,
            converged: found.converged,
            steps: found.steps,
            joints: joints(design, found, &model, &deviation),
            offsets: (0..6)
                .map(|leg| CalibratedOffsetRecord {
                    leg: leg + 1,
                    offset: Number(model.offsets[leg]),
                    deviation: found.unknowns.offset(leg).map(&deviation),
                })
                .collect(),
            covariance: CovarianceRecord {
                unknowns: unknown_names(design, &found.unknowns),
                matrix: covariance.row_iter().map(|row| row.iter().map(|x| Number(*x)).collect()).collect(),
            },
            computed_poses: None,
            observability: ObservabilityRecord::new(design, &found.observability),
            before: residuals(&found.before),
            after: residuals(&found.after),
            left_out: residuals(&found.left_out),
            check: None,
            indispensable: found.indispensable.iter().map(|k| line(lines, *k)).collect(),
            chi_square: found.chi_square,
            outliers: found.outliers.iter().map(|o| OutlierRecord::new(o, lines)).collect(),
            exchanged_legs: found.exchanged.map(|legs| legs.map(|leg| leg + 1)),
        }
    }
}

fn joints(
    design: &Design,
    found: &Calibration,
    model: &LegModel,
    deviation: &dyn Fn(usize) -> Number,
) -> Vec<CalibratedJointRecord> {
    let mut out = Vec::new();
    for body in Body::BOTH {
        let nominal = design.manipulator().joints(body);
        let used = model.pairs.map(|pair| body.of(pair));
        let points = body.of((&model.base, &model.platform));
        for (joint, point) in points.iter().enumerate().filter(|(joint, _)| used.contains(joint)) {
            let column = found.unknowns.joint(body, joint);
            let moved = point - nominal[joint];
            out.push(CalibratedJointRecord {
                body,
                joint: design.joint_names(body)[joint].clone(),
                position: [point.x, point.y, point.z].map(Number),
                deviations: column.map(|c| [c, c + 1, c + 2].map(deviation)),
                moved: [moved.x, moved.y, moved.z].map(Number),
            });
        }
    }
    out
}

impl ObservabilityRecord {
    fn new(design: &Design, found: &Observability) -> Self {
        Self {
            rank: found.rank,
            singular_values: found.singular_values.iter().map(|s| Number(*s)).collect(),
            tolerance: Number(found.tolerance),
            volume_index: Number(found.volume_index()),
            inverse_condition: Number(found.inverse_condition()),
            noise_amplification: Number(found.noise_amplification()),
            harmonic_index: Number(found.harmonic_index()),
            unobservable: found.unobservable.iter().map(|c| UnobservableRecord::new(design, c)).collect(),
        }
    }
}
