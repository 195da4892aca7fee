//! Gough-Stewart platforms that can be built.
//!
//! For a platform whose legs share joints, the library finds an equivalent one without shared joints. It also finds all
//! poses of either platform for given leg lengths, with certificates.
//!
//! The best known of these platforms are the octahedral ones, whose six legs meet in three joints of the base and three
//! of the platform. A joint that two legs share is hard to build: it has play and a small cone angle. Every
//! octahedral platform is *kinematically equivalent* to platforms without shared joints: they have the same poses, the
//! same singularities and the same forward kinematics.
//!
//! Leg `i` joins the base joint `a_i` to the platform joint `b_i`. At the pose `(R, p)` its squared length is
//!
//! ```text
//! s_i = |R b_i + p - a_i|^2,
//! ```
//!
//! and two platforms are equivalent when `s' = A s + c` holds at every pose, with a constant matrix `A` and
//! `det A != 0`.
//!
//! Everything on this page is in [`prelude`]. A [`Design`] is a platform with names, units, home pose and requirements,
//! read from a file or a text:
//!
//! ```
//! use equipod::prelude::*;
//!
//! let design = Design::load("designs/rbt-octahedral.toml")?;
//! let home = design.home_or_default();
//! let lengths = design.ik(&home)?; // from a pose to lengths: one answer
//!
//! let found = design.fk(&lengths)?; // and back: all poses, real and complex, each with its certificate
//! assert_eq!(found.roots.len(), 16);
//! assert!(found.roots.iter().all(|root| root.certified()));
//! assert_eq!(found.completeness.name(), "proved");
//! assert!(found.real_poses().any(|pose| (pose.position - home.position).norm() < 1e-9));
//! # Ok::<(), Error>(())
//! ```
//!
//! # An equivalent platform without shared joints
//!
//! [`Design::equivalents`] has all platforms of the class, [`Design::optimize`] the best one under the requirements of
//! the design. [`verify()`] compares any two designs: by the leg map, and by forward kinematics that knows nothing of
//! it.
//!
//! ```
//! use equipod::prelude::*;
//!
//! let design = Design::load("designs/rbt-octahedral.toml")?;
//! let class = design.equivalents()?;
//! assert_eq!(class.family().counts().patterns, 728);
//!
//! let (free, map) = class.joint_free([0.2, 0.21, 0.22, 0.2, 0.2, 0.23])?;
//! assert!(map.determinant().abs() > 0.1);
//! let found = verify_with(&design, &free, VerifyOptions::new().samples(3))?;
//! assert_eq!(found.verdict, Verdict::Equivalent);
//! assert_eq!(leg_map(&design, &free)?.relation, Relation::Equivalent);
//! # Ok::<(), Error>(())
//! ```
//!
//! # A design changed, assessed and passed on
//!
//! ```
//! use equipod::prelude::*;
//!
//! let mut design = Design::load("designs/presets/bench-l16.toml")?;
//! assert_eq!(design.check()?.is_singular(), Some(false));
//!
//! let joint = design.manipulator().platform_joints()[0];
//! let name = format!("platform.{}", design.platform_names()[0]);
//! design.set_joint(&name, joint + nalgebra::Vector3::new(0.0, 0.0, 0.5))?;
//! let text = design.text(); // with the comments of the file; `design.save(path)` writes it
//! assert!(text.parse::<Design>()? == design && text.contains('#'));
//!
//! let files = design.export("step".parse()?)?; // names and texts
//! assert_eq!(files.len(), 1);
//! # Ok::<(), Error>(())
//! ```
//!
//! # Many lengths, one pose after the other
//!
//! [`Design::solver`] prepares a design once; [`Solver::solve_all`] takes rows of lengths from any iterator and gives
//! results in their order, from all cores, as they are done. [`Design::tracker`] follows the one pose that a machine is
//! at. [`Cancel`] ends long computations.
//!
//! ```
//! use equipod::prelude::*;
//!
//! let design = Design::load("designs/rbt-octahedral.toml")?;
//! let mut pose = design.home_or_default();
//! let mut tracker = design.tracker(pose);
//! let solver = design.solver(FkOptions::new().seed(7));
//! let rows: Vec<LegLengths> = (0..3)
//!     .map(|k| design.ik(&Pose::new([0.1 * f64::from(k), 0.0, pose.position.z], pose.rotation)))
//!     .collect::<Result<_, _>>()?;
//! for found in solver.solve_all(rows) {
//!     assert!(found?.real_poses().count() > 0);
//! }
//! pose.position.y += 0.1;
//! assert!(matches!(tracker.step(&design.ik(&pose)?)?, NearOutcome::Tracked { .. }));
//! # Ok::<(), Error>(())
//! ```
//!
//! # Poses
//!
//! A [`Pose`] is made from a position and a rotation ([`Angles`], a unit quaternion or a rotation matrix). It is also
//! made from a 4 x 4 matrix or nalgebra's `Isometry3`, and converts into each of these. `nalgebra` and `num_complex`
//! are re-exported in the versions of the signatures.
//!
//! # Without files
//!
//! With `default-features = false` the library has poses and certificates alone: [`Manipulator`] has `fk`, `ik`,
//! `solver` and `tracker` as a design has. The features `synthesis`, `optimize`, `files`, `page` and `cli` add
//! the rest; `docs/architecture.md` gives the cost of each. The modules behind this page are in [`methods`], for those
//! who develop methods.

#![cfg_attr(
    not(feature = "cli"),
    allow(
        dead_code,
        unused_imports,
        reason = "the layers below serve every capability, also those left out"
    )
)]

mod app;

#[cfg(feature = "page")]
pub use ::records;
#[cfg(feature = "cli")]
pub use app::cli;
pub use nalgebra;
pub use num_complex;

#[doc(inline)]
pub use prelude::*;

/// Everything on the front page, for `use equipod::prelude::*`: the design, its questions with their options, and every
/// type that an option takes or an answer is matched with.
pub mod prelude {
    #[doc(inline)]
    pub use ::ask::{Batch, Error, Kinematics, Solver, Tracker};
    #[doc(inline)]
    pub use ::fk::solve::{
        certify::{ProvedReality, RootCertificate},
        pose_count::CountedLengths,
    };
    #[doc(inline)]
    pub use ::fk::{
        Completeness, FkError, FkOptions, FkRoot, FkSolutions, FkTolerances, Method, NearOutcome, PathEnd,
        PoseCounting, Reality, Rejected, RejectionReason, SolutionSet, Threads, WhyLost,
    };
    #[doc(inline)]
    pub use ::num::{Cancel, linalg::LinalgError};
    #[doc(inline)]
    pub use ::platform::geom::{Angles, ComplexPose, InvalidPose, Pose};
    #[doc(inline)]
    pub use ::platform::manipulator::{
        Body, InvalidLengths, InvalidManipulator, Leg, LegIndex, LegLengths, Level, Manipulator,
        NotOctahedral, Octahedral, SquaredLegLengths,
    };
    #[cfg(feature = "synthesis")]
    #[doc(inline)]
    pub use ::synthesis::{
        AffineLegMap, Factor, Family, HexagonPoint, InstantiateError, JointLabel, LegMapOutcome, Offset,
        ParsePatternError, Pattern, Relation,
    };

    // the design
    #[cfg(feature = "files")]
    #[doc(inline)]
    pub use crate::app::presets::PRESETS;
    #[cfg(feature = "files")]
    #[doc(inline)]
    pub use ::ask::{Design, PoseFrames};
    #[cfg(feature = "files")]
    #[doc(inline)]
    pub use ::files::design::{
        CalibratedNumber, CalibrationTable, Code, Combination, Correlations, Format, HexapodSizes,
        JointError, OptimizeTable, SearchTable, Share, Trajectory, Violation, Warning, Workspace,
    };
    #[cfg(feature = "files")]
    #[doc(inline)]
    pub use ::files::export::{
        ExportFormat, ExportOptions, ExportedFile, LengthUnit, NoExport, UnknownUnit, Unsupported,
    };
    #[cfg(feature = "files")]
    #[doc(inline)]
    pub use ::platform::geom::{
        AngleUnit, CoordinateRange, FrameAxis, ListedFrom, PoseConvention, QuaternionOrder, Region,
        RotationOrder, TurnAxes, UpAxis,
    };

    // the tables of the design
    #[cfg(feature = "files")]
    #[doc(inline)]
    pub use ::machine::requirements::{
        BoltPattern, BoltsFrom, ConeLimits, Envelope, Envelopes, ForceUnit, Grid, Hardware, HoleCircle,
        HoleCircles, HolePattern, Housing, JointAxes, JointType, KeepOut, KeepOutShape, KeptSymmetry,
        LegBody, LegMasses, LegPart, LegsWeight, LengthLimits, Load, MassUnit, Objective, Payload,
        PlateDesign, PlateMass, Plates, PlatformSpeed, PlatformStiffness, Requirements, SafetyMargin,
        SafetyMargins, UniversalJoint, VariableKind,
    };

    // the questions
    #[cfg(feature = "files")]
    #[doc(inline)]
    pub use ::ask::{
        AssessReport, AssessedPoses, AtPoseOptions, AtPoseReport, CheckReport, DrivesAt, FigureOptions,
        InvalidMove, LegMoveRequest, LocusOptions, LocusReport, MotionMasses, MotionOrigin, MotionReport,
        MotionStart, MoveOptions, MoveSearchReport, MoveTargets, MovesReport, NamedFamily, NoAtPose, NoLocus,
        NoMoves, NoReplaceableLegs, NoSelfMotion, NoSingularPoses, PlatformMotion, ReplaceableLegs,
        ReplaceableOptions, SearchWord, SelfMotionOptions, SelfMotionReport, SingularHome,
        SingularPosesOptions, SingularPosesReport, VerifyOptions, leg_map, verify, verify_with,
    };
    #[cfg(feature = "files")]
    #[doc(inline)]
    pub use ::ask::{
        equivalents::Equivalents,
        rounding::{RoundingChoices, RoundingWay},
    };
    #[cfg(feature = "files")]
    #[doc(inline)]
    pub use ::machine::{
        calibration::{
            CalibrateOptions, CalibrationError, CalibrationStatus, HeldParts, Loss, LossUnit, Measurement,
            MeasurementNoise, StartChoice,
        },
        dynamics::{Manoeuvre, PlatformFreedom},
        manufacture::{ErrorBound, NoRounding},
        reach::NearestPoseOptions,
        requirements::{
            AssessOptions, AssessStage, Limit, MarginVerdict, Quantity, Standing, Term, TermKind,
        },
    };
    #[cfg(feature = "files")]
    #[doc(inline)]
    pub use ::synthesis::{
        components::{ComponentOptions, ComponentsError},
        relocate::search::{MoveSearchOptions, SearchError},
        singularity::{Assembly, MotionOptions, Regularity, SingularEvidence, SingularityVerdict},
    };
    #[cfg(feature = "files")]
    #[doc(inline)]
    pub use ::verify::{Counterexample, InconclusiveReason, Sample, Verdict, Verification, VerifyError};

    // the searches
    #[cfg(all(feature = "files", feature = "optimize"))]
    #[doc(inline)]
    pub use ::ask::{
        Checked, ConflictFreedom, DriveOutcome, DriveRanking, DriveSearch, DrivenPlatform, ExploreOptions,
        ExploreProgress, ExploreReport, ExploreVerdict, FoundFront, FoundOffsets, FoundPlatform,
        FreedomOutcome, FreedomWord, NoExploration, OpenedFreedom, OptimizeEvidence, OptimizeOptions,
        OptimizeProgress, OptimizeReport, OptimizeStatus, RelaxedRequirement, SearchedDrive,
    };
    #[cfg(all(feature = "files", feature = "optimize"))]
    #[doc(inline)]
    pub use ::files::design::{Drive, DriveTable, InvalidDriveTable};
    #[cfg(all(feature = "files", feature = "optimize"))]
    #[doc(inline)]
    pub use ::optimize::{
        dimensional::{Demand, DimensionalOutcome, InvalidProblem},
        offsets::{InvalidOffsetProblem, OffsetOutcome, OffsetProgress},
    };
}

/// The modules behind the entrance, for those who develop methods: a new solver, a new way to prove a root, another
/// search. Users of the library need none of them.
///
/// Each holds the code of its layer (`docs/architecture.md`). Names and signatures in here change from version to
/// version.
pub mod methods {
    /// Problems drawn from a class, solved, validated with arithmetic of their own, counted and timed.
    #[cfg(feature = "cli")]
    pub mod bench {
        pub use ::ask::bench::*;
    }
    /// Joint centres and leg offsets of a machine from measured poses and lengths.
    #[cfg(feature = "synthesis")]
    pub mod calibration {
        pub use ::machine::calibration::*;
    }
    /// Design files: text in, values out, and back to text.
    #[cfg(feature = "files")]
    pub mod design {
        pub use crate::app::presets::PRESETS;
        pub use ::ask::Design;
        pub use ::ask::design::{parse, parse_ideal, parse_with_cranks};
        pub use ::ask::presets::{Preset, PresetClass};
        pub use ::files::design::*;
    }
    /// The best platform that meets its requirements: offsets, triangles, height, joint axes.
    #[cfg(feature = "optimize")]
    pub mod dimensional {
        pub use ::optimize::dimensional::*;
    }
    /// Machines whose joints are not ideal: universal joints whose axes do not meet, screws that couple the turn of a
    /// leg to its length.
    #[cfg(feature = "synthesis")]
    pub mod coupled {
        pub use ::machine::coupled::*;
    }
    /// Poses from distances alone: Cayley-Menger determinants, trilateration, closure conditions.
    pub mod distance {
        pub use ::fk::distance::*;
    }
    /// Motion of the legs and forces of their drives while the platform moves: inverse dynamics, stiffness, natural
    /// frequencies.
    #[cfg(feature = "synthesis")]
    pub mod dynamics {
        pub use ::machine::dynamics::*;
    }
    /// Whether two platforms are equivalent: the leg map and forward kinematics, compared.
    #[cfg(feature = "synthesis")]
    pub mod equivalence {
        pub use ::verify::*;
    }
    /// Files for other programs: a design in, texts out.
    #[cfg(feature = "files")]
    pub mod export {
        pub use ::files::export::*;
    }
    /// Forward kinematics: all finite complex poses for given leg lengths, by every method.
    pub mod fk {
        pub use ::fk::*;
    }
    /// Poses, quaternions, distances.
    pub mod geom {
        pub use ::platform::geom::*;
    }
    /// Joints, legs, lengths, inverse kinematics, Jacobian.
    pub mod manipulator {
        pub use ::platform::manipulator::*;
    }
    /// Tolerances of the joints, the correction a controller runs, joints on a grid of holes.
    #[cfg(feature = "synthesis")]
    pub mod manufacture {
        pub use ::machine::manufacture::*;
    }
    /// Seeded random numbers, double-double, interval and exact arithmetic, dense linear algebra, conic programs.
    pub mod num {
        pub use ::num::*;
    }
    /// The best platform without shared joints in the class of an octahedral one.
    #[cfg(feature = "optimize")]
    pub mod offsets {
        pub use ::optimize::offsets::*;
    }
    /// One HTML page of a design, and the answers it gets from the core.
    #[cfg(feature = "page")]
    pub mod page {
        pub use crate::app::page::*;
    }
    /// Five legs between two bodies, and the line that they hold.
    pub mod pentapod {
        #[cfg(feature = "files")]
        pub use ::ask::{HeldLine, PentapodReport, about_five_legs};
        pub use ::platform::pentapod::*;
    }
    /// Pictures: values in, SVG text out.
    #[cfg(feature = "files")]
    pub mod plot {
        pub use ::files::plot::*;
    }
    /// Polynomials in one unknown.
    pub mod poly {
        pub use ::num::poly::*;
    }
    /// The questions that a design answers, with their options and answers: one function each, which all doors call.
    #[cfg(feature = "files")]
    pub mod questions {
        pub use ::ask::*;
    }
    /// The distance that the platform may move from a pose before a requirement binds, and the allowed pose nearest to
    /// a given one.
    #[cfg(feature = "synthesis")]
    pub mod reach {
        pub use ::machine::reach::*;
    }
    /// A folder of results as one HTML page: files in, HTML text out.
    #[cfg(feature = "page")]
    pub mod report {
        pub use crate::app::report::*;
    }
    /// The requirements on a platform, evaluated from their definitions.
    #[cfg(feature = "synthesis")]
    pub mod requirements {
        pub use ::machine::requirements::*;
    }
    /// Platforms on rods of constant length whose cranks turn: angles of poses, poses of angles, speeds, torques.
    #[cfg(feature = "synthesis")]
    pub mod rotary {
        pub use ::machine::rotary::*;
    }
    /// Designs that no pose can hold, singular poses, self-motions.
    #[cfg(feature = "synthesis")]
    pub mod singularity {
        pub use ::synthesis::singularity::*;
    }
    /// The leg equations over the complex numbers, and certificates of their roots.
    pub mod solve {
        pub use ::fk::solve::*;
    }
    /// Leg maps, and the class of equivalent platforms.
    #[cfg(feature = "synthesis")]
    pub mod synthesis {
        pub use ::synthesis::*;
    }
    /// The pattern of shared joints of a design, and the catalogue of all patterns.
    pub mod topology {
        pub use ::platform::topology::*;
    }
}

/// The code of the guide for controllers is compiled as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../docs/guides/controller.md")]
struct GuideExamples;
