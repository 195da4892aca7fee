//! Answers of forward kinematics: all poses with given leg lengths, each with its proof.

mod certificate;
mod closure;
mod pose_count;

use num_complex::Complex64;
use schemars::JsonSchema;
use serde::Serialize;

pub use self::certificate::{CertificateRecord, DiscsRecord, EnclosureRecord};
pub use self::closure::{ClosurePolynomialRecord, ClosureRecord, TrilaterationStepRecord};
pub use self::pose_count::{EvidenceWord, PoseCountRecord};
use super::{
    ComplexRecord, DriveSolutionRecord, FailureRecord, NearRecord, Number, PoseConventionRecord,
    PoseInFrames, RotationPolynomialRecord,
};
use ask::PoseFrames;
use fk::solve::pose_count::{CountedLengths, PoseSet};
use fk::{
    BoundedProof, Completeness, CompletenessWord, FkRoot, FkSolutions, LibraryCalls, Method, PathReport,
    Reality, Rejected, SolutionSet,
};
use machine::reach::Reach;
use machine::rotary::RotaryPlatform;
use platform::geom::ComplexPose;
use platform::manipulator::{Manipulator, height_above_base};

/// The answer of `fk`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum FkAnswer {
    /// The lengths come from a CSV file: one record a row.
    Rows(FkRowsAnswer),
    /// One set of lengths.
    One(Box<FkOneAnswer>),
}

impl FkAnswer {
    /// With the convention of its poses.
    #[must_use]
    pub fn with_frames(mut self, frames: &PoseFrames) -> Self {
        let record = PoseConventionRecord::from(&frames.convention);
        match &mut self {
            Self::Rows(answer) => answer.frames = record,
            Self::One(one) => one.frames = Some(record),
        }
        self
    }
}

/// The poses with the lengths of each row of a file.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FkRowsAnswer {
    /// The convention of `in_frames`.
    pub frames: PoseConventionRecord,
    /// In the order of the file.
    pub rows: Vec<FkRowRecord>,
}

/// One row of a file of lengths.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FkRowRecord {
    /// The line of the CSV file, from 1.
    pub line: usize,
    /// The time of the row, where the file has a column of times.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
    /// The six lengths, design units; those of the rods where angles of cranks were given.
    pub lengths: [f64; 6],
    /// The angles of the cranks, where these were given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angles_deg: Option<[f64; 6]>,
    /// The poses, or why there are none.
    #[serde(flatten)]
    pub outcome: FkRowOutcome,
}

/// What came of a row.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum FkRowOutcome {
    /// It was solved.
    Solved(Box<FkOneAnswer>),
    /// It could not be solved.
    Failed(RowFailure),
}

/// Why a row has no poses.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RowFailure {
    /// The failure, as the command would have reported it for this row alone.
    pub error: FailureRecord,
}

/// The poses with one set of lengths, and what was asked for besides.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FkOneAnswer {
    /// The convention of `in_frames`; of a row of a table that of the whole answer.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frames: Option<PoseConventionRecord>,
    /// The poses.
    #[serde(flatten)]
    pub solved: SolvedRecord,
    /// The angles of the cranks, where these were given; the legs are then the rods from the tips of the cranks, as
    /// doubles, to the platform, and certificates hold for these tips.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angles_deg: Option<[f64; 6]>,
    /// Whether all angles given are within their limits, the ends included; null: no angles, or no limits.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub within_limits: Option<bool>,
    /// The legs whose cranks are beyond their limits at these angles, from 1.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub outside: Vec<usize>,
    /// Where tips and platform joints have the symmetry of three turns, to rounding, and rods are equally long: how
    /// many finite poses the exactly symmetric platform has, by a theorem. Further poses of the tips as doubles are so
    /// far out that their rounding decides whether there are any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub symmetric_finite: Option<usize>,
    /// How the pose was followed, with `--near`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub near: Option<NearRecord>,
    /// What the corrections of joints that are not ideal came to; the lengths are then those of drives, and no
    /// certificate is given of a root.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drives: Option<DriveSolutionRecord>,
    /// The exact closure polynomial, with `--method trilateration`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub closure: Option<ClosureRecord>,
    /// The polynomial in the Cayley parameter c3 of all poses, with `--polynomial`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub polynomial: Option<RotationPolynomialRecord>,
}

impl FkAnswer {
    /// With what the requirements say of each real pose.
    #[must_use]
    pub fn with_limits(mut self, reach: &Reach<'_>) -> Self {
        match &mut self {
            Self::One(one) => one.solved.judge(reach),
            Self::Rows(answer) => {
                for row in &mut answer.rows {
                    if let FkRowOutcome::Solved(one) = &mut row.outcome {
                        one.solved.judge(reach);
                    }
                }
            }
        }
        self
    }
}

impl From<SolvedRecord> for FkOneAnswer {
    fn from(solved: SolvedRecord) -> Self {
        Self {
            frames: None,
            solved,
            angles_deg: None,
            within_limits: None,
            outside: Vec::new(),
            symmetric_finite: None,
            near: None,
            drives: None,
            closure: None,
            polynomial: None,
        }
    }
}

impl FkOneAnswer {
    /// With the angles of cranks that were given, in radians and in degrees, and the limits that they violate.
    #[must_use]
    pub fn with_angles(self, platform: &RotaryPlatform, angles: &[f64; 6], degrees: [f64; 6]) -> Self {
        let outside = platform.beyond_limits(angles);
        let limited = platform.legs().iter().any(|leg| leg.limits.is_some());
        let within_limits = limited.then_some(outside.is_empty());
        Self { angles_deg: Some(degrees), within_limits, outside, ..self }
    }
}

/// All finite complex poses with given leg lengths, and whether these are all.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SolvedRecord {
    /// The method that found them.
    pub method: Method,
    /// Whether these are known to be all.
    pub completeness: CompletenessWord,
    /// One sentence on what is known.
    pub completeness_reason: String,
    /// The numbers of the proof that all poses up to a distance are listed, where it is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bounded: Option<BoundedProof>,
    /// False: roots may be missing.
    pub all_paths_accounted: bool,
    /// The number of `solutions`.
    pub finite_count: usize,
    /// The same, each pose counted as often as it stands for.
    pub finite_count_with_multiplicity: u32,
    /// Real poses among them.
    pub real_count: usize,
    /// Poses of which it is not decided whether they are real.
    pub undecided_count: usize,
    /// Finite poses, multiplicity included, that are not among the certified ones; null: not counted.
    pub missing_count: Option<usize>,
    /// The number of poses, by theorem or counted without finding them; null: not known.
    pub pose_count: Option<PoseCountRecord>,
    /// Real ones first.
    pub solutions: Vec<SolutionRecord>,
    /// Whether the poses are isolated.
    #[serde(flatten)]
    pub solution_set: SolutionSetRecord,
    /// The paths of the homotopy.
    pub paths: Vec<PathReport>,
    /// Candidates that are no roots.
    pub rejected: Vec<Rejected>,
    /// Ends of paths without a certificate, near which there may be one pose, several or none: they are not among the
    /// solutions.
    pub unproved: Vec<SolutionRecord>,
    /// What libraries of linear algebra computed for `--method template`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub library_calls: Vec<LibraryCalls>,
    /// What null stands for, where a number is not finite.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

impl From<&FkSolutions> for SolvedRecord {
    fn from(s: &FkSolutions) -> Self {
        let mut record = Self {
            method: s.method,
            completeness: s.completeness.word(),
            completeness_reason: s.completeness.to_string(),
            bounded: match s.completeness {
                Completeness::ProvedBounded { proof } => Some(proof),
                _ => None,
            },
            all_paths_accounted: s.all_accounted(),
            finite_count: s.roots.len(),
            finite_count_with_multiplicity: s.count_with_multiplicity(),
            real_count: s.assembly_modes().count(),
            undecided_count: s.roots.iter().filter(|r| r.reality == Reality::Undecided).count(),
            missing_count: s.missing(),
            pose_count: PoseCountRecord::of(s),
            solutions: s.roots.iter().map(SolutionRecord::from).collect(),
            solution_set: s.into(),
            paths: s.paths.clone(),
            rejected: s.rejected.clone(),
            unproved: s.unproved.iter().map(SolutionRecord::from).collect(),
            library_calls: s.library_calls.clone(),
            notes: Vec::new(),
        };
        if !record.is_finite() {
            record.notes.push("null stands for a number that is infinite or not a number".into());
        }
        record
    }
}

impl SolvedRecord {
    /// Adds to the real poses what they are in real numbers, and how they stand to home.
    #[must_use]
    pub fn with_real_poses(mut self, m: &Manipulator, frames: &PoseFrames) -> Self {
        let home = &frames.home;
        let of_home = height_above_base(m, home);
        let place = ComplexPose::from(*home);
        for solution in self.solutions.iter_mut().filter(|s| s.real == Some(true)) {
            let pose = ComplexPose::from(&solution.pose).real_part();
            let height = height_above_base(m, &pose);
            // in the plane of the base to rounding there are no sides
            let level = [height, of_home].iter().any(|h| !(h.abs() > 1e-12 * m.size()));
            let side = if height * of_home > 0.0 { SideWord::Above } else { SideWord::Below };
            solution.real_pose = Some(RealPoseRecord {
                position: pose.position.into(),
                rotation: [0, 1, 2].map(|i| [0, 1, 2].map(|j| pose.rotation.matrix()[(i, j)])),
                rpy_deg: pose.angles().degrees(),
                quat_wxyz: pose.quaternion(),
                in_frames: (&frames.write(&pose)).into(),
                mode: if level { None } else { Some(side) },
                distance_from_home: ComplexPose::from(pose).distance(&place, m.size()),
                nearest_home: false,
                allowed: None,
                elbow_kept: None,
            });
        }
        let real = self.solutions.iter_mut().filter_map(|s| s.real_pose.as_mut());
        if let Some(nearest) = real.min_by(|a, b| a.distance_from_home.total_cmp(&b.distance_from_home)) {
            nearest.nearest_home = true;
        }
        self
    }

    /// Adds to the real poses whether they are allowed.
    fn judge(&mut self, reach: &Reach<'_>) {
        for solution in &mut self.solutions {
            let pose = ComplexPose::from(&solution.pose).real_part();
            if let Some(real) = &mut solution.real_pose {
                real.allowed = Some(reach.allows(&pose));
            }
        }
    }

    /// Adds to the real poses on which side each crank is.
    #[must_use]
    pub fn with_elbows(mut self, platform: &RotaryPlatform, angles: &[f64; 6]) -> Self {
        for solution in &mut self.solutions {
            let pose = ComplexPose::from(&solution.pose).real_part();
            if let Some(real) = &mut solution.real_pose {
                real.elbow_kept = Some(platform.elbows_kept(&pose, angles));
            }
        }
        self
    }

    fn is_finite(&self) -> bool {
        self.solutions.iter().chain(&self.unproved).all(SolutionRecord::is_finite)
            && self.paths.iter().all(|p| p.isotropy.is_finite())
            && self.rejected.iter().all(|r| r.residual.is_finite())
    }
}

/// What the finite poses form.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(tag = "solution_set", rename_all = "snake_case")]
pub enum SolutionSetRecord {
    /// Nothing speaks against isolated poses.
    Isolated {},
    /// There is no finite pose, real or complex: proved.
    Empty {},
    /// Poses form curves or surfaces: self-motions.
    PositiveDimensional {
        /// Counted modulo random primes; null: not counted.
        dimension: Option<usize>,
        /// What was seen numerically.
        dimension_at_least: usize,
        /// Whether a relation between the legs proves it for the lengths as written; false where they satisfy the
        /// relation within rounding only and have finitely many poses.
        dimension_established: bool,
        /// Null: not established.
        degree: Option<usize>,
        /// Points of a general section, and real points found by a search.
        witness_points: Vec<SolutionRecord>,
    },
}

impl SolutionSetRecord {
    /// Points of a set of positive dimension.
    #[must_use]
    pub fn witness_points(&self) -> &[SolutionRecord] {
        match self {
            Self::PositiveDimensional { witness_points, .. } => witness_points,
            _ => &[],
        }
    }
}

impl From<&FkSolutions> for SolutionSetRecord {
    fn from(s: &FkSolutions) -> Self {
        match &s.solution_set {
            SolutionSet::Isolated => Self::Isolated {},
            SolutionSet::Empty => Self::Empty {},
            SolutionSet::PositiveDimensional { dimension, witnesses, established } => {
                let given = s.pose_count.as_ref().filter(|c| c.lengths == CountedLengths::Given);
                let counted = given.map(|c| &c.set);
                Self::PositiveDimensional {
                    dimension: match counted {
                        Some(PoseSet::PositiveDimensional { dimension, .. }) => Some(*dimension),
                        _ => None,
                    },
                    dimension_at_least: *dimension,
                    dimension_established: *established && !matches!(counted, Some(PoseSet::Finite { .. })),
                    degree: established.then_some(witnesses.len()),
                    witness_points: witnesses.iter().map(SolutionRecord::from).collect(),
                }
            }
        }
    }
}

/// A pose over the complex numbers.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ComplexPoseRecord {
    /// Rotation matrix, rows.
    #[serde(rename = "R")]
    pub rotation: ComplexRecord<[[Number; 3]; 3]>,
    /// Position, base frame, design units.
    #[serde(rename = "p")]
    pub position: ComplexRecord<[Number; 3]>,
}

impl From<&ComplexPose> for ComplexPoseRecord {
    fn from(pose: &ComplexPose) -> Self {
        let row = |i: usize| [0, 1, 2].map(|j| pose.rotation[(i, j)]);
        let position: [Complex64; 3] = pose.position.into();
        Self { rotation: [0, 1, 2].map(row).into(), position: position.into() }
    }
}

impl From<&ComplexPoseRecord> for ComplexPose {
    fn from(record: &ComplexPoseRecord) -> Self {
        let (r, p) = (&record.rotation, &record.position);
        Self {
            rotation: nalgebra::Matrix3::from_fn(|i, j| Complex64::new(r.re[i][j].0, r.im[i][j].0)),
            position: nalgebra::Vector3::from_fn(|i, _| Complex64::new(p.re[i].0, p.im[i].0)),
        }
    }
}

/// A real pose in real numbers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct RealPoseRecord {
    /// Position of the platform origin, base frame, design units.
    pub position: [f64; 3],
    /// Rows of the rotation matrix.
    pub rotation: [[f64; 3]; 3],
    /// Roll, pitch and yaw in degrees, R = Rz(yaw) Ry(pitch) Rx(roll).
    pub rpy_deg: [f64; 3],
    /// Unit quaternion, scalar part first.
    pub quat_wxyz: [f64; 4],
    /// The pose in the convention of `frames`.
    pub in_frames: PoseInFrames,
    /// On which side of the base the platform is; null: its centre is in the plane of the base, there or at home.
    pub mode: Option<SideWord>,
    /// Largest difference from home of an entry of the rotation matrix, or of a coordinate of the position over the
    /// size of the design.
    pub distance_from_home: f64,
    /// Whether none of the other real poses listed is nearer to home.
    pub nearest_home: bool,
    /// Whether the pose meets every requirement and det J has the sign that it has at home, with `--limits`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub allowed: Option<bool>,
    /// Whether each crank is on the side (elbow) that the design names, where the legs are rods on cranks: a machine
    /// gets to another side only through a pose with crank and rod in one plane with the axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elbow_kept: Option<[bool; 6]>,
}

/// A side of the plane of the base.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SideWord {
    /// The side where the platform is at home.
    Above,
    /// The other side.
    Below,
}

/// One pose with its evidence.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SolutionRecord {
    /// The pose.
    #[serde(flatten)]
    pub pose: ComplexPoseRecord,
    /// Null: undecided.
    pub real: Option<bool>,
    /// The pose in real numbers, where it is real.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub real_pose: Option<RealPoseRecord>,
    /// Whether there is a certificate.
    pub certified: bool,
    /// The proof; null where there is none.
    pub certificate: Option<CertificateRecord>,
    /// Paths, or roots of a polynomial, that end here.
    pub multiplicity: u32,
    /// Largest error of the leg equations over the squared size.
    pub residual: Number,
    /// Estimate of the condition number.
    pub condition: Number,
    /// (e, g), scalar part of e first, g = p e in design units, `max |e_k| = 1`.
    pub dual_quaternion: Option<ComplexRecord<[Number; 8]>>,
}

impl From<&FkRoot> for SolutionRecord {
    fn from(r: &FkRoot) -> Self {
        Self {
            pose: (&r.pose).into(),
            real: match r.reality {
                Reality::Real => Some(true),
                Reality::NonReal => Some(false),
                Reality::Undecided => None,
            },
            real_pose: None,
            certified: r.certified(),
            certificate: r.certificate.as_ref().map(CertificateRecord::from),
            multiplicity: r.multiplicity,
            residual: Number(r.residual),
            condition: Number(r.condition),
            dual_quaternion: r.dual_quaternion.map(ComplexRecord::from),
        }
    }
}

impl SolutionRecord {
    fn is_finite(&self) -> bool {
        let (r, p) = (&self.pose.rotation, &self.pose.position);
        let pose = r.re.iter().chain(&r.im).flatten().chain(&p.re).chain(&p.im);
        pose.chain([&self.residual, &self.condition]).all(|x| x.0.is_finite())
    }
}
