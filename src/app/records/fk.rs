//! Answers of forward kinematics: all poses with given leg lengths, each with its proof.

mod certificate;
mod closure;
mod pose_count;

use num_complex::Complex64;
use schemars::JsonSchema;
use serde::Serialize;

pub use self::certificate::{CertificateRecord, DiscsRecord, EnclosureRecord};
pub use self::closure::{
    ClosurePolynomialRecord, ClosureRecord, DistancePolynomialRecord, TrilaterationStepRecord,
};
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
    /// Table of lengths, with an answer for each row.
    Rows(Box<FkRowsAnswer>),
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
    /// Rows of the file.
    pub rows: Vec<FkRowRecord>,
}

/// One row of a file of lengths.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FkRowRecord {
    /// Line of the table, from 1.
    pub line: usize,
    /// The time of the row, if the file has a column of times.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
    /// The six lengths, design units; for given crank angles, the rod lengths.
    pub lengths: [f64; 6],
    /// Crank angles, if given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angles_deg: Option<[f64; 6]>,
    /// The poses, or the reason why there are none.
    #[serde(flatten)]
    pub outcome: FkRowOutcome,
}

/// The outcome of a row.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum FkRowOutcome {
    /// The row was solved.
    Solved(Box<FkOneAnswer>),
    /// Failed row.
    Failed(RowFailure),
}

/// The reason why a row has no poses.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RowFailure {
    /// Failure of this row.
    pub error: FailureRecord,
}

view! {
    /// The poses with one set of lengths, and further results on request.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct FkOneAnswer {
        /// The convention of `in_frames`; of a row of a table that of the whole answer.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub frames: Option<PoseConventionRecord> = None,
        /// The poses.
        #[serde(flatten)]
        pub solved: SolvedRecord = solved,
        /// Crank angles, if given. The legs are then the rods from the crank tips, rounded to doubles, and certificates
        /// hold for these tips.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub angles_deg: Option<[f64; 6]> = None,
        /// Whether all angles are within their limits, ends included; null: no angles, or no limits.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub within_limits: Option<bool> = None,
        /// Legs with cranks beyond their limits, from 1.
        #[serde(skip_serializing_if = "Vec::is_empty")]
        pub outside: Vec<usize> = Vec::new(),
        /// Number of finite poses of the exactly symmetric platform, by a theorem. It is present if tips and platform
        /// joints have three-fold symmetry to rounding and the rods are equally long. Rounding of the tips alone
        /// decides on further poses, which are far away.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub symmetric_finite: Option<usize> = None,
        /// Tracking, with `--near`.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub near: Option<NearRecord> = None,
        /// Iteration for non-ideal joints. The given lengths are then drive lengths, and no root gets a certificate.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub drives: Option<DriveSolutionRecord> = None,
        /// The closure polynomial, with `--method trilateration` or `--between`.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub closure: Option<ClosureRecord> = None,
        /// Polynomial in the Cayley parameter c3, with `--polynomial`.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub polynomial: Option<RotationPolynomialRecord> = None,
    }
    impl From(solved: SolvedRecord) {}
}

impl FkAnswer {
    /// With what the requirements say of each real pose.
    #[must_use]
    pub fn with_limits(mut self, reach: &Reach<'_>) -> Self {
        match &mut self {
            Self::One(one) => one.solved.check_limits(reach),
            Self::Rows(answer) => {
                for row in &mut answer.rows {
                    if let FkRowOutcome::Solved(one) = &mut row.outcome {
                        one.solved.check_limits(reach);
                    }
                }
            }
        }
        self
    }
}

impl FkOneAnswer {
    /// Adds the given crank angles, in radians and in degrees, and the violated limits.
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
    /// Completeness of the list.
    pub completeness: CompletenessWord,
    /// Evidence for completeness.
    pub completeness_reason: String,
    /// Proof that all poses up to a distance are listed; null: another proof, or none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bound: Option<BoundedProof>,
    /// Whether every path is accounted for; false: poses may be missing.
    pub all_paths_accounted: bool,
    /// Number of `solutions`.
    pub finite_count: usize,
    /// Number of `solutions` with multiplicity.
    pub finite_count_with_multiplicity: u32,
    /// Number of real poses.
    pub real_count: usize,
    /// Number of poses that may be real.
    pub undecided_count: usize,
    /// Number of finite poses without certificate, counted with multiplicity; null: not counted.
    pub missing_count: Option<usize>,
    /// The number of poses by theorem, or counted without finding them; null: not known.
    pub pose_count: Option<PoseCountRecord>,
    /// The poses, real ones first; the text and `--csv` number them from 1 in this order.
    pub solutions: Vec<SolutionRecord>,
    /// Whether the poses are isolated.
    #[serde(flatten)]
    pub solution_set: SolutionSetRecord,
    /// Homotopy paths.
    pub paths: Vec<PathReport>,
    /// Rejected candidates.
    pub rejected: Vec<Rejected>,
    /// Uncertified path ends: there may be one pose, several or none near each. They are not among the solutions.
    pub unproved: Vec<SolutionRecord>,
    /// Library computations of `--method template`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub library_calls: Vec<LibraryCalls>,
    /// Meaning of null for non-finite numbers.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

impl From<&FkSolutions> for SolvedRecord {
    fn from(s: &FkSolutions) -> Self {
        let mut record = Self {
            method: s.method,
            completeness: s.completeness.word(),
            completeness_reason: s.completeness.to_string(),
            bound: match &s.completeness {
                Completeness::ProvedBounded { proof } => Some(proof.clone()),
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
    /// Adds to the real poses their representation in real numbers and their relation to home.
    #[must_use]
    pub fn with_real_poses(mut self, m: &Manipulator, frames: &PoseFrames) -> Self {
        let home = &frames.home;
        let of_home = height_above_base(m, home);
        let place = ComplexPose::from(*home);
        for solution in self.solutions.iter_mut().filter(|s| s.real == Some(true)) {
            let pose = ComplexPose::from(&solution.pose).real_part();
            let height = height_above_base(m, &pose);
            // the side is undefined for a centre in the plane of the base, to rounding
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
    fn check_limits(&mut self, reach: &Reach<'_>) {
        for solution in &mut self.solutions {
            let pose = ComplexPose::from(&solution.pose).real_part();
            if let Some(real) = &mut solution.real_pose {
                real.allowed = Some(reach.allows(&pose));
            }
        }
    }

    /// Adds to the real poses the side of each crank.
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

    /// All poses with their numbers, counted from 1: the solutions, then the points of a self-motion. The text, the
    /// table of `--csv` and the order in JSON agree on them.
    pub fn numbered(&self) -> impl Iterator<Item = (usize, &SolutionRecord)> {
        (1..).zip(self.solutions.iter().chain(self.solution_set.witness_points()))
    }

    fn is_finite(&self) -> bool {
        self.solutions.iter().chain(&self.unproved).all(SolutionRecord::is_finite)
            && self.paths.iter().all(|p| p.isotropy.is_finite())
            && self.rejected.iter().all(|r| r.residual.is_finite())
    }
}

/// The structure of the set of finite poses.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(tag = "solution_set", rename_all = "snake_case")]
pub enum SolutionSetRecord {
    /// The poses are isolated, as far as known.
    Isolated {},
    /// Proved: no finite pose, real or complex.
    Empty {},
    /// Curves or surfaces: self-motions.
    PositiveDimensional {
        /// The dimension, counted modulo random primes; null: not counted.
        dimension: Option<usize>,
        /// The dimension found numerically, a lower bound.
        dimension_at_least: usize,
        /// Whether the dimension is proved for the lengths as written. False: the lengths satisfy it only within
        /// rounding, and have finitely many poses.
        dimension_established: bool,
        /// Degree of the set, with as many points of a general section; null: points may be missing.
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
            SolutionSet::PositiveDimensional { dimension, witnesses, degree, established } => {
                let given = s.pose_count.as_ref().filter(|c| c.lengths == CountedLengths::Given);
                let counted = given.map(|c| &c.set);
                Self::PositiveDimensional {
                    dimension: match counted {
                        Some(PoseSet::PositiveDimensional { dimension, .. }) => Some(*dimension),
                        _ => None,
                    },
                    dimension_at_least: *dimension,
                    dimension_established: *established && !matches!(counted, Some(PoseSet::Finite { .. })),
                    degree: *degree,
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

/// A real pose as real numbers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct RealPoseRecord {
    /// Platform origin, base frame, design units.
    pub position: [f64; 3],
    /// Rows of the rotation matrix.
    pub rotation: [[f64; 3]; 3],
    /// Roll, pitch and yaw in degrees, R = Rz(yaw) Ry(pitch) Rx(roll).
    pub rpy_deg: [f64; 3],
    /// Unit quaternion, scalar part first.
    pub quat_wxyz: [f64; 4],
    /// Pose in the convention of `frames`.
    pub in_frames: PoseInFrames,
    /// Side of the base; null: its centre is in the plane of the base, here or at home.
    pub mode: Option<SideWord>,
    /// Largest difference of a rotation entry from home, or of a coordinate of the position divided by the size of the
    /// design.
    pub distance_from_home: f64,
    /// Whether it is the real pose nearest to home.
    pub nearest_home: bool,
    /// Whether all requirements are met and det J has the sign of home, with `--limits`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub allowed: Option<bool>,
    /// Whether each crank is on the named side; null: no cranks. A crank changes its side only through a singular pose,
    /// with crank, rod and axis in one plane.
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

view! {
    /// One pose with its evidence.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct SolutionRecord {
        /// The pose.
        #[serde(flatten)]
        pub pose: ComplexPoseRecord = (&r.pose).into(),
        /// Whether the pose is real; null: undecided.
        pub real: Option<bool> = match r.reality {
            Reality::Real => Some(true),
            Reality::NonReal => Some(false),
            Reality::Undecided => None,
        },
        /// Real pose; null: it is not real.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub real_pose: Option<RealPoseRecord> = None,
        /// Whether it has a certificate.
        pub certified: bool = r.certified(),
        /// The proof; null: there is none.
        pub certificate: Option<CertificateRecord> = r.certificate.as_ref().map(CertificateRecord::from),
        /// Number of paths, or roots of a polynomial, that end here.
        pub multiplicity: u32 = r.multiplicity,
        /// Largest leg equation error over squared size.
        pub residual: Number = Number(r.residual),
        /// Estimated condition number.
        pub condition: Number = Number(r.condition),
        /// The dual quaternion (e, g): scalar part of e first, g = p e in design units, `max |e_k| = 1`.
        pub dual_quaternion: Option<ComplexRecord<[Number; 8]>> = r.dual_quaternion.map(ComplexRecord::from),
    }
    impl From(r: &FkRoot) {}
}

impl SolutionRecord {
    fn is_finite(&self) -> bool {
        let (r, p) = (&self.pose.rotation, &self.pose.position);
        let pose = r.re.iter().chain(&r.im).flatten().chain(&p.re).chain(&p.im);
        pose.chain([&self.residual, &self.condition]).all(|x| x.0.is_finite())
    }
}
