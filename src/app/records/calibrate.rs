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
    /// Convention in which poses were read, and of `in_frames`.
    pub frames: PoseConventionRecord,
    /// The outcome of the calibration.
    pub outcome: CalibrateOutcome,
    /// Reason of the outcome, one sentence.
    pub reason: String,
    /// The calibration; null: nothing was measured, and poses to measure were asked for.
    pub calibration: Option<CalibrationRecord>,
    /// The poses to measure next, the most informative first.
    pub next_poses: Vec<NextPoseRecord>,
    /// The design file written; null: none.
    pub path: Option<String>,
}

/// The outcome of a calibration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CalibrateOutcome {
    /// All unknowns are identified, and the residuals agree with the model.
    Calibrated,
    /// Some changes of the machine do not affect the measurements.
    NotIdentifiable,
    /// The residuals are too large for the given noise: the model, the noise or a measurement is wrong.
    Refuted,
    /// The fit did not converge, or there are no more readings than unknowns.
    Undecided,
    /// No measurement exists yet.
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

view! {
    /// The calibrated machine with its residuals and deviations.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct CalibrationRecord {
        /// Number of measured poses.
        pub poses: usize = found.weights.len(),
        /// Number of unknowns.
        pub unknowns: usize = found.unknowns.count(),
        /// The frames of joints, deviations and covariance.
        pub frames: CalibrationFrames =
            if frames.is_some() { CalibrationFrames::Design } else { CalibrationFrames::Measured },
        /// Motions from measurement frames to design frames; null: joints are given in the frames of the measurements.
        pub motions: Option<CarriedFrames> = frames.cloned(),
        /// Standard deviations of measurements.
        pub noise: NoiseRecord = NoiseRecord::new(&found.noise, found.noise_source),
        /// Loss function.
        pub loss: LossRecord = LossRecord { loss, of },
        /// Start of the fit.
        pub start: Starts = found.starts,
        /// Whether the fit converged.
        pub converged: bool = found.converged,
        /// Number of steps in all.
        pub steps: usize = found.steps,
        /// The calibrated joints: all joints that carry legs.
        pub joints: Vec<CalibratedJointRecord> = joints(design, found, &model, &deviation),
        /// Offsets of the legs: shown length minus distance of the joints, design units.
        pub offsets: Vec<CalibratedOffsetRecord> = (0..6)
            .map(|leg| CalibratedOffsetRecord {
                leg: leg + 1,
                offset: Number(model.offsets[leg]),
                deviation: found.unknowns.offset(leg).map(&deviation),
            })
            .collect(),
        /// Covariance of the unknowns, squared design units; directions that are not identified contribute no variance.
        pub covariance: CovarianceRecord = CovarianceRecord {
            unknowns: unknown_names(design, &found.unknowns),
            matrix: covariance.row_iter().map(|row| row.iter().map(|x| Number(*x)).collect()).collect(),
        },
        /// Uncertainty of computed poses; null: not all unknowns are identified, or the design has no pose to evaluate.
        pub computed_poses: Option<ComputedPosesRecord> = None,
        /// Observability of the machine's parameters.
        pub observability: ObservabilityRecord = ObservabilityRecord::new(design, &found.observability),
        /// Residuals before calibration.
        pub before: ResidualsRecord = residuals(&found.before),
        /// Residuals after calibration, without outliers.
        pub after: ResidualsRecord = residuals(&found.after),
        /// First-order leave-one-out residuals, without outliers: each pose against the machine fitted to the other
        /// poses.
        pub leave_one_out: ResidualsRecord = residuals(&found.left_out),
        /// Residuals of `--check`; null: there are none.
        pub check: Option<ResidualsRecord> = None,
        /// Indispensable measurements, by line: without one of them, the unknowns are not determined.
        pub indispensable: Vec<usize> = found.indispensable.iter().map(|k| line(lines, *k)).collect(),
        /// Test of residuals against noise.
        pub chi_square: ChiSquare = found.chi_square,
        /// Contradicting measurements, the farthest first.
        pub outliers: Vec<OutlierRecord> =
            found.outliers.iter().map(|o| OutlierRecord::new(o, lines)).collect(),
        /// Legs with lengths probably exchanged, from 1: swapped, they are five times nearer to the design. Null: none.
        pub exchanged_legs: Option<[usize; 2]> = found.exchanged.map(|legs| legs.map(|leg| leg + 1)),
    }
    /// The record of a calibration from measurements on these lines, carried to the design frames if `frames` holds the
    /// motions.
    pub fn new(
        design: &Design,
        found: &Calibration,
        (loss, of): (Loss, LossUnit),
        frames: Option<&CarriedFrames>,
        lines: &[usize],
    ) {
        let (model, root) = carried(found, frames);
        let deviation = |column: usize| Number(root.row(column).norm());
        let covariance = &root * root.transpose();
        let residuals = |spread: &ResidualSpread| ResidualsRecord::new(spread, lines);
    }
}

/// The frames of calibrated joints.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CalibrationFrames {
    /// The frames of the measured poses.
    Measured,
    /// The frames of the design.
    Design,
}

view! {
    /// Standard deviations of measurements.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
    pub struct NoiseRecord {
        /// Source of values.
        pub source: NoiseSource = source,
        /// Standard deviation of a length, design units.
        pub length: Number = Number(noise.length),
        /// Standard deviation of a platform origin coordinate, design units.
        pub position: Number = Number(noise.position),
        /// Standard deviation of a rotation vector component, degrees.
        pub rotation_deg: Number = Number(noise.rotation.to_degrees()),
    }
    fn new(noise: &MeasurementNoise, source: NoiseSource) {}
}

/// The loss function of the fit, which limits the weight of outliers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub struct LossRecord {
    /// The kind of loss.
    pub loss: Loss,
    /// Unit that is rejected together: a pose or a single leg length.
    pub of: LossUnit,
}

/// A calibrated joint.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CalibratedJointRecord {
    /// The body of the joint.
    pub body: Body,
    /// The name of the joint.
    pub joint: String,
    /// The position, design units, body frame.
    pub position: [Number; 3],
    /// Standard deviations, design units; null: the joint was held.
    pub deviations: Option<[Number; 3]>,
    /// Displacement from the design, design units.
    pub moved: [Number; 3],
}

/// The offset of a leg.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct CalibratedOffsetRecord {
    /// The leg, from 1.
    pub leg: usize,
    /// Shown length minus joint distance, design units.
    pub offset: Number,
    /// Standard deviation, design units; null: the offset was held.
    pub deviation: Option<Number>,
}

/// The covariance matrix of the unknowns.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CovarianceRecord {
    /// Names of rows and columns: `base.A1.x`, `offset.3`.
    pub unknowns: Vec<String>,
    /// The rows of the matrix.
    pub matrix: Vec<Vec<Number>>,
}

view! {
    /// Standard deviations of poses computed from lengths, caused by the errors of the calibration with all
    /// correlations. The noise of the lengths adds to them.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
    pub struct ComputedPosesRecord {
        /// Number of poses evaluated: the poses of the workspace at which the requirements of the design are met.
        pub poses: usize = all.len(),
        /// Median RMS error of the measured platform origin, design units.
        pub position_median: Number = Number(position.0),
        /// Greatest RMS error of the measured platform origin, design units.
        pub position_greatest: Number = Number(position.1),
        /// Median RMS error of the orientation.
        pub rotation_deg_median: Number = Number(rotation.0),
        /// Greatest RMS error of the orientation.
        pub rotation_deg_greatest: Number = Number(rotation.1),
        /// Pose with the greatest position error.
        pub pose: PoseQuaternionRecord = (&worst.0).into(),
    }
    /// The deviations of a machine at poses in the frames of its measurements; `None` if all poses are singular.
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
    }
}

view! {
    /// Observability of the machine's parameters by the measurements.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct ObservabilityRecord {
        /// Number of identified directions.
        pub rank: usize = found.rank,
        /// Singular values of the identification matrix, whitened and multiplied by the deviation of a length, largest
        /// first; no unit.
        pub singular_values: Vec<Number> = found.singular_values.iter().map(|s| Number(*s)).collect(),
        /// Singular values below are not identified.
        pub tolerance: Number = Number(found.tolerance),
        /// `(s_1 .. s_m)^(1/m) / sqrt(n)` (Borm, Menq 1991).
        pub volume_index: Number = Number(found.volume_index()),
        /// `s_m / s_1` (Driels, Pathre 1990).
        pub inverse_condition: Number = Number(found.inverse_condition()),
        /// `s_m^2 / s_1` (Nahvi, Hollerbach 1996).
        pub noise_amplification: Number = Number(found.noise_amplification()),
        /// `1 / (1/s_1 + .. + 1/s_m)` (Sun, Hollerbach 2008).
        pub harmonic_index: Number = Number(found.harmonic_index()),
        /// Unidentified changes of the machine, each normalised to 1 over all unknowns.
        pub unobservable: Vec<UnobservableRecord> =
            found.unobservable.iter().map(|c| UnobservableRecord::new(design, c)).collect(),
    }
    fn new(design: &Design, found: &Observability) {}
}

/// A change of joints and offsets that leaves all measured lengths almost unchanged.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct UnobservableRecord {
    /// The displaced joints, the farthest first.
    pub joints: Vec<JointShiftRecord>,
    /// The changed offsets.
    pub offsets: Vec<OffsetShiftRecord>,
}

/// The displacement of a joint.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct JointShiftRecord {
    /// The body of the joint.
    pub body: Body,
    /// The name of the joint.
    pub joint: String,
    /// Displacement, body frame of the measurement; relative, the whole change has norm 1.
    pub shift: [Number; 3],
}

/// The change of an offset.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct OffsetShiftRecord {
    /// The leg, from 1.
    pub leg: usize,
    /// The change of the offset; relative, the whole change has norm 1.
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

view! {
    /// Statistics of residuals, design units.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct ResidualsRecord {
        /// RMS residual.
        pub rms: Number = Number(spread.rms),
        /// RMS residual by leg.
        pub legs: [Number; 6] = spread.legs.map(Number),
        /// Greatest residual; null: none was counted.
        pub greatest: Option<GreatestResidualRecord> = spread.greatest.map(|g| GreatestResidualRecord {
            line: line(lines, g.measurement),
            leg: g.leg + 1,
            value: Number(g.value),
        }),
        /// Number of lengths counted.
        pub count: usize = spread.count,
    }
    /// The statistics of measurements that stand on these lines.
    pub fn new(spread: &ResidualSpread, lines: &[usize]) {}
}

/// The residual of greatest size.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct GreatestResidualRecord {
    /// Line of the table.
    pub line: usize,
    /// The leg, from 1.
    pub leg: usize,
    /// Measured length minus model length, design units.
    pub value: Number,
}

/// The line of a measurement, or its index if the lines are unknown.
fn line(lines: &[usize], measurement: usize) -> usize {
    lines.get(measurement).copied().unwrap_or(measurement + 1)
}

view! {
    /// A measurement that contradicts the others.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
    pub struct OutlierRecord {
        /// Line of the table.
        pub line: usize = line(lines, outlier.measurement),
        /// The leg, from 1; null: the whole pose.
        pub leg: Option<usize> = outlier.leg.map(|leg| leg + 1),
        /// Distance from the model, standard deviations.
        pub distance: Number = Number(outlier.distance),
        /// The rejection threshold, standard deviations: correct measurements all stay below it with a probability of
        /// 99 %.
        pub threshold: Number = Number(outlier.threshold),
        /// Weight in the fit.
        pub weight: Number = Number(outlier.weight),
    }
    fn new(outlier: &Outlier, lines: &[usize]) {}
}

/// A pose to measure next.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct NextPoseRecord {
    /// Pose, in design frames if joints are, else in the frames of the measurements.
    pub pose: PoseQuaternionRecord,
    /// Roll, pitch and yaw, degrees.
    pub rpy_deg: [Number; 3],
    /// Pose in the convention of `frames`.
    pub in_frames: PoseInFrames,
    /// Factor by which this measurement shrinks the error ellipsoid: the geometric mean of the deviations along its
    /// axes.
    pub shrinks: Number,
    /// Greatest standard deviation after all poses up to this one, design units.
    pub greatest_deviation: Number,
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
