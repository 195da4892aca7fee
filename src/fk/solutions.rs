//! Records of forward-kinematics results, with their evidence.

use num_complex::Complex64;

use super::Completeness;
use crate::solve::certify::RootCertificate;
use crate::solve::pose_count::{CountedLengths, PoseCount};
use num::names::{UnknownName, named};
use platform::geom::{ComplexPose, Pose};

/// A forward-kinematics method.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum Method {
    /// Octic in one unknown squared distance; octahedral platforms only (Rojas, Borras, Thomas).
    Octic,
    /// Parameter homotopy in dual quaternions; any six legs.
    Homotopy,
    /// Continuation of one real pose from a known one ([`NearSolver`](super::NearSolver)); not complete.
    Near,
    #[cfg(feature = "lab")]
    /// Sylvester matrix, polynomial of degree 40 (Lee, Shim); general six legs.
    Sylvester,
    #[cfg(feature = "lab")]
    /// Elimination template and generalised eigenvectors (Martyushev); general six legs.
    Template,
    /// Trilateration with virtual legs (Porta, Thomas).
    Trilateration,
}

impl Method {
    /// Every method that this build has.
    pub const ALL: &'static [Self] = &[
        Self::Octic,
        Self::Homotopy,
        Self::Near,
        #[cfg(feature = "lab")]
        Self::Sylvester,
        #[cfg(feature = "lab")]
        Self::Template,
        Self::Trilateration,
    ];

    /// The name on the command line and in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Octic => "octic",
            Self::Homotopy => "homotopy",
            Self::Near => "near",
            #[cfg(feature = "lab")]
            Self::Sylvester => "sylvester",
            #[cfg(feature = "lab")]
            Self::Template => "template",
            Self::Trilateration => "trilateration",
        }
    }
}

num::displayed!(Method by name);

impl std::str::FromStr for Method {
    type Err = UnknownName;

    fn from_str(text: &str) -> Result<Self, UnknownName> {
        named("method", text, Self::ALL, Self::name)
    }
}

num::words! {
    /// Whether a root is a real pose (an assembly mode).
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Reality as words, Display {
        /// Imaginary parts vanish to rounding.
        Real = "real",
        /// Imaginary parts are far above rounding.
        NonReal = "not real",
        /// Between: not decided.
        Undecided = "real or not: undecided",
    }
}

/// The kind of set that the finite complex poses form.
#[derive(Debug, Clone, PartialEq)]
pub enum SolutionSet {
    /// Nothing speaks against isolated poses: those of [`FkSolutions::roots`].
    Isolated,
    /// Proved: there is no finite pose, real or complex.
    Empty,
    /// Poses form curves or surfaces (self-motions).
    PositiveDimensional {
        /// Dimension, at least.
        dimension: usize,
        /// One pose for each intersection of the set with general linear sections, so at least one on each component of
        /// that dimension. The sections are linear in the seventeen quadratic forms of the dual quaternion, as many as
        /// the dimension. Real points of a search follow when no section has one.
        witnesses: Vec<FkRoot>,
        /// Degree of the set in that embedding, if the sections have all its points. Either the set is `established`,
        /// or the sections have as many distinct points as the degree counted modulo random primes.
        degree: Option<usize>,
        /// `true` when a relation between the legs is proved on the joints as given, the lengths satisfy it within
        /// rounding and all witnesses are regular; `false` when the motion was only seen numerically.
        established: bool,
    },
}

num::displayed!(SolutionSet by name);

impl SolutionSet {
    /// A set of positive dimension that was seen with some of its poses.
    pub(super) fn seen(dimension: usize, witnesses: Vec<FkRoot>) -> Self {
        Self::PositiveDimensional { dimension, witnesses, degree: None, established: false }
    }

    /// The name used in JSON.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Isolated => "isolated",
            Self::Empty => "empty",
            Self::PositiveDimensional { .. } => "positive_dimensional",
        }
    }

    /// Poses on the components of positive dimension.
    #[must_use]
    pub fn witnesses(&self) -> &[FkRoot] {
        match self {
            Self::PositiveDimensional { witnesses, .. } => witnesses,
            _ => &[],
        }
    }
}

/// One root with its evidence.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct FkRoot {
    /// The pose.
    pub pose: ComplexPose,
    /// Whether it is real.
    pub reality: Reality,
    /// Proof of existence and uniqueness with all its numbers, for checks by other programs; `None` where there is
    /// none.
    pub certificate: Option<RootCertificate>,
    /// 1 for certified and for regular roots, however many candidates ended there. For singular roots the number of
    /// start paths (or polynomial roots) that end here, mirror images of paths included.
    pub multiplicity: u32,
    /// Largest error of the leg equations over size squared and of `R^T R = I`.
    pub residual: f64,
    /// Estimate of the condition number of the root (dimensionless, Newton matrix of the method).
    pub condition: f64,
    /// The pose as a dual quaternion `(e_0..e_3, g_0..g_3)`, `g = p e`, `max |e_k| = 1`, `g` in design units. It keeps
    /// the digits that `R` and `p` lose when `e.e` is small. `None` for methods that do not work in dual quaternions
    /// and for poses without certificate.
    pub dual_quaternion: Option<[Complex64; 8]>,
}

impl FkRoot {
    /// A simple root without certificate.
    #[must_use]
    pub fn new(pose: ComplexPose, reality: Reality, residual: f64, condition: f64) -> Self {
        Self { pose, reality, certificate: None, multiplicity: 1, residual, condition, dual_quaternion: None }
    }

    /// Whether the root is proved.
    #[must_use]
    pub fn certified(&self) -> bool {
        self.certificate.is_some()
    }

    /// The pose as a real one, `None` unless it [is real](Reality::Real).
    #[must_use]
    pub fn real_pose(&self) -> Option<Pose> {
        (self.reality == Reality::Real).then(|| self.pose.real_part())
    }
}

num::answer_words! {
    /// The end of a homotopy path.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum PathEnd as name {
        /// A finite pose.
        Finite = "finite",
        /// `e -> 0`: the position grows without bound.
        AtInfinity = "at_infinity",
        /// `e.e -> 0` with `e != 0`: no rotation.
        IsotropicRotation = "isotropic",
        /// Not tracked to an end; roots may be missing.
        Failed = "failed",
    }
}

/// The report of a path of the homotopy.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, schemars::JsonSchema), schemars(rename = "PathRecord", transform = num::nullable))]
#[non_exhaustive]
pub struct PathReport {
    /// Start index.
    pub start: usize,
    /// Path end.
    pub end: PathEnd,
    /// Index into `solutions`, from 0.
    pub root: Option<usize>,
    /// Mirror image index, where one path stands for two.
    // Base and platform are planar, and one path of each pair of mirror images was tracked, 20 of 40. The index equals
    // `root` when the pose is its own image.
    pub mirror_root: Option<usize>,
    /// Accepted steps.
    pub steps: u32,
    /// Rejected steps.
    pub rejections: u32,
    /// Winding number, 1 for a regular end, 0 where it is not determined.
    pub winding: u32,
    /// |e.e| / |e|^2 at the end.
    pub isotropy: f64,
    /// Number of repetitions with smaller steps.
    pub retracked: u32,
}

impl PathReport {
    /// A path without steps that leads to no root.
    #[must_use]
    pub fn new(start: usize, end: PathEnd) -> Self {
        Self {
            start,
            end,
            root: None,
            mirror_root: None,
            steps: 0,
            rejections: 0,
            winding: 0,
            isotropy: 0.0,
            retracked: 0,
        }
    }
}

/// Why a candidate is not a root.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum RejectionReason {
    /// It does not satisfy all leg equations.
    ResidualTooLarge,
    /// It is a root found already.
    Duplicate,
    /// It is near a solution to rounding but no proof of one succeeded (a multiple root, a pose near infinity). It is
    /// no real pose if all real poses are proved to be listed.
    NotCertified,
    /// The position is at infinity or the rotation does not exist.
    NotFinite,
}

/// A candidate that is no root.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, schemars::JsonSchema), schemars(rename = "RejectedRecord", transform = num::nullable))]
pub struct Rejected {
    /// The reason of the rejection.
    pub reason: RejectionReason,
    /// Leg equation error of the candidate, over the squared size.
    pub residual: f64,
}

/// A library of linear algebra computed this for an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, schemars::JsonSchema),
    schemars(rename = "LibraryCallsRecord")
)]
pub struct LibraryCalls {
    /// The library.
    pub library: &'static str,
    /// The kind of computation: `plu`, a triangular factor with partial pivoting, or `qz`, generalised eigenvectors.
    pub computation: &'static str,
    /// Rows and columns.
    pub size: [usize; 2],
    /// Number of calls.
    pub calls: usize,
}

/// All roots of one problem.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct FkSolutions {
    /// The method that found them.
    pub method: Method,
    /// Distinct finite roots, real ones first, in a reproducible order.
    pub roots: Vec<FkRoot>,
    /// Whether the poses are isolated at all.
    pub solution_set: SolutionSet,
    /// Whether these are all.
    pub completeness: Completeness,
    /// The reports of the homotopy paths: 40, or 20 when each stands for itself and its mirror image. Empty for other
    /// methods.
    pub paths: Vec<PathReport>,
    /// Candidates that are not roots.
    pub rejected: Vec<Rejected>,
    /// The finite poses counted without finding them; `None` when that was not asked, or not needed for a proof.
    pub pose_count: Option<PoseCount>,
    /// Ends of paths without a proof: there may be a root of this multiplicity near the pose, several, or none. They
    /// are not among the roots, and as long as there are any the answer is undecided.
    pub unproved: Vec<FkRoot>,
    /// The computations of linear-algebra libraries; empty when equipod computed all itself.
    pub library_calls: Vec<LibraryCalls>,
    /// Seed of the generic constants.
    pub seed: u64,
}

impl FkSolutions {
    /// Isolated roots without further evidence.
    #[must_use]
    pub fn new(method: Method, roots: Vec<FkRoot>, completeness: Completeness, seed: u64) -> Self {
        Self {
            method,
            roots,
            solution_set: SolutionSet::Isolated,
            completeness,
            paths: Vec::new(),
            rejected: Vec::new(),
            pose_count: None,
            unproved: Vec::new(),
            library_calls: Vec::new(),
            seed,
        }
    }
}

/// One sentence: how many poses, how many are real, how many are proved, whether these are all.
impl std::fmt::Display for FkSolutions {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (poses, real) = (self.roots.len(), self.assembly_modes().count());
        let certified = self.roots.iter().filter(|r| r.certified()).count();
        write!(
            f,
            "{poses} finite poses by the {} method, {real} real, {certified} certified; {}: {}",
            self.method,
            self.completeness.name(),
            self.completeness
        )
    }
}

impl FkSolutions {
    /// The poses of the roots that are real.
    pub fn real_poses(&self) -> impl Iterator<Item = Pose> + '_ {
        self.roots.iter().filter_map(FkRoot::real_pose)
    }

    /// Roots that are real.
    pub fn assembly_modes(&self) -> impl Iterator<Item = &FkRoot> {
        self.roots.iter().filter(|r| r.reality == Reality::Real)
    }

    /// Finite roots counted with multiplicity.
    #[must_use]
    pub fn count_with_multiplicity(&self) -> u32 {
        self.roots.iter().map(|r| r.multiplicity).sum()
    }

    /// `false` when something failed and roots may be missing.
    #[must_use]
    pub fn all_accounted(&self) -> bool {
        self.completeness.all_accounted()
    }

    /// Roots with a certificate, by multiplicity.
    #[must_use]
    pub fn certified_count(&self) -> usize {
        self.roots.iter().filter(|r| r.certified()).map(|r| r.multiplicity as usize).sum()
    }

    /// Finite poses that exist, multiplicity included, and are not among the certified roots, where their number is
    /// known.
    #[must_use]
    pub fn missing(&self) -> Option<usize> {
        if matches!(self.completeness, Completeness::ProvedBounded { .. }) {
            return None;
        }
        let count = self.pose_count.as_ref().filter(|c| c.lengths == CountedLengths::Given)?;
        count.finite()?.checked_sub(self.certified_count())
    }

    /// The answer is whole: all poses, or all real ones, are listed, by proof or modulo random primes, or a motion is
    /// established of which they are points.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        match &self.solution_set {
            SolutionSet::PositiveDimensional { established, .. } => *established && self.all_accounted(),
            _ => !matches!(self.completeness, Completeness::Unproved { .. }),
        }
    }
}
