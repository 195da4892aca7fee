//! Forward kinematics: finds all finite complex poses that a platform can have with given leg lengths.
//!
//! The crate knows `num` and `platform`, and nothing in it knows leg maps. `fk` and `synthesis` never import each
//! other, so that agreement of the root sets of two platforms is evidence for the map between them. `solve::certify`,
//! which proves roots, names nothing that finds them.
//!
//! * [`FkOptions`]: the method, the seed and what is counted.
//! * [`FkSolutions`]: the poses, each with its certificate, and whether they are all.
//! * [`NearSolver`]: one real pose followed from lengths to lengths.
//!
//! Squared lengths become leg equations. A method finds roots, Newton's method sharpens them, certificates prove them,
//! and a theorem or a count decides whether they are all.

mod batch;
mod bounded;
mod bounds;
mod choose;
mod closure;
mod closure_poses;
mod cluster;
mod collect;
mod completeness;
mod counted;
mod dependent;
pub mod distance;
#[cfg(feature = "lab")]
mod elimination;
mod evidence;
mod harvest;
mod hidden;
mod homotopy;
mod near;
mod newton;
mod octic;
mod pentapod;
mod pose_polynomial;
mod real_points;
mod solutions;
mod solvability;
pub mod solve;
#[cfg(feature = "lab")]
mod sylvester;
#[cfg(feature = "lab")]
mod template;
mod trilateration;

pub use batch::in_order;
pub use batch::{BatchResult, Threads, solve_batch};
pub use bounds::pose_bound;
pub use choose::{Automatic, solver};
pub use closure::{Closure, NoClosure, closure, closure_between};
pub use closure_poses::closure_candidates;
pub use completeness::{
    BoundedProof, Completeness, CompletenessWord, FarPoses, PathsEnded, Reason, Reasons, Theorem, Tried,
};
pub use homotopy::Homotopy;
pub use near::NearNumbers;
use near::NeedsStart;
pub use near::{NearEvidence, NearOptions, NearOutcome, NearSolver, NearWord, WhyLost};
pub use octic::{Octic, OcticPoses, OcticSolver, octic};
pub use pentapod::{LineClass, LinePose, LinePoses, NoLinePoses, count_line_poses, line_class, line_poses};
pub use pose_polynomial::{NoPosePolynomial, PosePolynomial, distance_polynomial, rotation_polynomial};
pub use solutions::{
    FkRoot, FkSolutions, LibraryCalls, Method, PathEnd, PathReport, Reality, Rejected, RejectionReason,
    SolutionSet,
};
pub use solvability::{PlacedFirst, Solvability, solvability};
#[cfg(feature = "lab")]
pub use sylvester::Sylvester;
#[cfg(feature = "lab")]
pub use template::Template;
pub use trilateration::Trilateration;

use platform::manipulator::{Manipulator, SquaredLegLengths};
use thiserror::Error;

/// Options of forward kinematics.
///
/// ```
/// # mod equipod {
/// #     pub use equipod_fk::*;
/// #     pub mod methods {
/// #         pub use equipod_fk as fk; pub use equipod_fk::solve;
/// #         pub use platform::{geom, manipulator};
/// #     }
/// # }
/// use equipod::{FkOptions, Method};
/// let options = FkOptions::new().method(Method::Homotopy).seed(7);
/// assert_eq!((options.seed, options.method), (7, Some(Method::Homotopy)));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct FkOptions {
    /// The method that [`solver`] is to choose; `None` for the fastest that applies. A method that is called
    /// directly ignores it.
    pub method: Option<Method>,
    /// Seed of the generic constants (gamma, patches). Same seed, same output.
    pub seed: u64,
    /// Whether poses are counted modulo random primes when completeness is not proved otherwise: some milliseconds a
    /// problem.
    pub pose_count: PoseCounting,
    /// Limits relative to the design that decide what counts as one root, a real root, a root at all.
    pub tolerances: FkTolerances,
}

/// When the finite poses are counted (see [`crate::solve::pose_count`]).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PoseCounting {
    /// When no theorem says that the poses found are all.
    #[default]
    WhenUnproved,
    /// Not at all: then completeness is proved by a theorem or not known, and sets of positive dimension are recognised
    /// numerically only.
    Never,
}

/// Dimensionless limits; positions are divided by the size of the design before they are compared.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct FkTolerances {
    /// Largest accepted residual of a root (leg equations over size squared, `R^T R = I`), relative to the square of
    /// the pose's own numbers. For singular ends of paths its root is accepted.
    pub residual: f64,
    /// Two regular poses without certificate that are closer than this, relative to their own numbers, are one root.
    /// Certificates tell closer ones apart.
    pub distinct: f64,
    /// Relative size of imaginary parts up to which a regular pose without certificate is taken for real, times the
    /// root of its condition number. A pose with a thousand times more is non-real (ten thousand times for points on
    /// curves of poses); between these limits it is undecided. Certificates decide reality by proof.
    pub reality: f64,
}

impl Default for FkTolerances {
    fn default() -> Self {
        Self { residual: 1e-9, distinct: 1e-7, reality: 1e-10 }
    }
}

impl Default for FkOptions {
    fn default() -> Self {
        Self {
            method: None,
            seed: 1,
            pose_count: PoseCounting::default(),
            tolerances: FkTolerances::default(),
        }
    }
}

impl FkOptions {
    /// The defaults: the fastest method that applies, seed 1.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Another method.
    #[must_use]
    pub fn method(mut self, method: Method) -> Self {
        self.method = Some(method);
        self
    }

    /// Another seed. Same seed, same output.
    #[must_use]
    pub fn seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// When the finite poses are counted modulo random primes.
    #[must_use]
    pub fn pose_count(mut self, when: PoseCounting) -> Self {
        self.pose_count = when;
        self
    }

    /// Other limits.
    #[must_use]
    pub fn tolerances(mut self, tolerances: FkTolerances) -> Self {
        self.tolerances = tolerances;
        self
    }
}

/// A question a method could not take or an answer it could not compute.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum FkError {
    /// The method does not apply to this manipulator.
    #[error("the {method} method does not apply: {reason}")]
    NotApplicable {
        /// The method asked for.
        method: Method,
        /// Why it does not apply.
        reason: String,
    },
    /// Two computations contradict each other: at least one of them is wrong.
    #[error("two results contradict each other: {what}")]
    Contradiction {
        /// The contradiction.
        what: String,
    },
    /// The numbers left the range in which the computation makes sense.
    #[error("the computation broke down: {what}")]
    Breakdown {
        /// The step that failed.
        what: String,
    },
}

/// A forward-kinematics method.
pub trait ForwardKinematics: Send + Sync {
    /// The name of this method.
    fn method(&self) -> Method;

    /// All finite complex poses of `m` with the squared leg lengths `s`.
    ///
    /// # Errors
    /// [`FkError`] when the method does not apply or breaks down; "no pose" is a value, not an error.
    fn solve(&self, m: &Manipulator, s: &SquaredLegLengths, o: &FkOptions) -> Result<FkSolutions, FkError>;

    /// The method, with the work that depends on the design alone done, for many lengths of one design. Results are
    /// those of [`solve`](Self::solve). `None` when there is nothing to prepare, or when the method does not apply:
    /// then [`solve`](Self::solve) says so. Preparation takes the seed and the way of counting from the options.
    fn prepare(&self, m: &Manipulator, o: &FkOptions) -> Option<Box<dyn PreparedDesign>> {
        let _ = (m, o);
        None
    }
}

/// A method prepared for one design, which it owns: many lengths, from any number of threads.
pub trait PreparedDesign: Send + Sync {
    /// As [`ForwardKinematics::solve`].
    ///
    /// # Errors
    /// As [`ForwardKinematics::solve`].
    fn solve(&self, s: &SquaredLegLengths, o: &FkOptions) -> Result<FkSolutions, FkError>;
}
