//! The error of the front page.

#[cfg(feature = "files")]
use std::path::PathBuf;

use thiserror::Error;

#[cfg(all(feature = "files", feature = "optimize"))]
use super::SingularHome;
#[cfg(feature = "files")]
use files::design::{InvalidShare, JointError, Violation};
#[cfg(feature = "files")]
use files::export::{NoExport, Unsupported};
use fk::FkError;
#[cfg(feature = "synthesis")]
use machine::calibration::CalibrationError;
#[cfg(feature = "synthesis")]
use num::linalg::LinalgError;
use num::names::UnknownName;
use platform::geom::InvalidPose;
use platform::manipulator::{InvalidLengths, InvalidManipulator, NotOctahedral};
#[cfg(feature = "synthesis")]
use synthesis::{InstantiateError, ParsePatternError};
#[cfg(feature = "synthesis")]
use verify::VerifyError;

/// The reason why a question could not be asked or answered. The answers "no" and "not known" are values, not errors.
///
/// ```
/// use equipod::prelude::*;
/// let text = "name = 'slip'\nunit = 'mm'\n";
/// let error = text.parse::<Design>().unwrap_err();
/// assert!(error.violations().len() > 1, "all of them, not the first");
/// assert!(error.to_string().contains("did you mean `units`?"));
/// ```
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A file cannot be read or written.
    #[cfg(feature = "files")]
    #[error("{}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// The message of the system.
        source: std::io::Error,
    },
    /// A design file with all its violations.
    #[cfg(feature = "files")]
    #[error("{}{}", file.as_ref().map(|f| format!("{}: ", f.display())).unwrap_or_default(), listed(violations))]
    Design {
        /// The file, if the text comes from one.
        file: Option<PathBuf>,
        /// All violations, in the order of the text.
        violations: Vec<Violation>,
    },
    /// A table of poses that cannot be read.
    #[cfg(feature = "files")]
    #[error("{}: {}", file.display(), bad.join("; "))]
    Trajectory {
        /// The table.
        file: PathBuf,
        /// Its faults, line by line.
        bad: Vec<String>,
    },
    /// A joint cannot be changed.
    #[cfg(feature = "files")]
    #[error(transparent)]
    Joint(#[from] JointError),
    /// An unknown name.
    #[error(transparent)]
    Name(#[from] UnknownName),
    /// Joints and legs that make no manipulator.
    #[error(transparent)]
    Manipulator(#[from] InvalidManipulator),
    /// Values that are no leg lengths.
    #[error(transparent)]
    Lengths(#[from] InvalidLengths),
    /// A matrix, quaternion or text that is no pose.
    #[error(transparent)]
    Pose(#[from] InvalidPose),
    /// A pose so far away that the leg lengths overflow.
    #[error("the leg lengths at this pose overflow")]
    Overflow,
    /// Neither home nor a pose drawn on the way from it meets the requirements.
    #[cfg(feature = "files")]
    #[error("no pose was found that meets the requirements")]
    NoAllowedPose,
    /// A question about the class of octahedral platforms, put to another design.
    #[error("not an octahedral platform: {0}")]
    NotOctahedral(#[from] NotOctahedral),
    /// A method does not apply, or forward kinematics failed.
    #[error(transparent)]
    Fk(#[from] FkError),
    /// A search for equivalent platforms at a singular home pose, which none of them holds.
    #[cfg(all(feature = "files", feature = "optimize"))]
    #[error("{0}, and no equivalent platform holds it")]
    SingularHome(SingularHome),
    /// Two designs in different units.
    #[cfg(feature = "files")]
    #[error("{} has the unit `{}`, and {} has the unit `{}`: convert one of them", .0[0].0, .0[0].1, .0[1].0, .0[1].1)]
    Units(Box<[(String, String); 2]>),
    /// Singular values could not be computed.
    #[cfg(feature = "synthesis")]
    #[error(transparent)]
    Linalg(#[from] LinalgError),
    /// The calibration could not be computed.
    #[cfg(feature = "synthesis")]
    #[error(transparent)]
    Calibration(#[from] CalibrationError),
    /// Two designs could not be compared.
    #[cfg(feature = "synthesis")]
    #[error(transparent)]
    Verify(#[from] VerifyError),
    /// Two results about one design contradict each other.
    #[cfg(feature = "synthesis")]
    #[error(
        "the design is proved to be {}, and {poses} poses are counted for generic leg lengths: one of the two is wrong, please report the design",
        if *singular { "architecturally singular" } else { "regular" }
    )]
    Contradiction {
        /// The verdict of the leg lines.
        singular: bool,
        /// The number of poses counted.
        poses: usize,
    },
    /// A text that names no pattern of the class.
    #[cfg(feature = "synthesis")]
    #[error(transparent)]
    Pattern(#[from] ParsePatternError),
    /// Offsets that make no platform.
    #[cfg(feature = "synthesis")]
    #[error(transparent)]
    Offsets(#[from] InstantiateError),
    /// A text that is no offset.
    #[cfg(feature = "files")]
    #[error(transparent)]
    OffsetText(#[from] InvalidShare),
    /// The design has no requirement to assess.
    #[cfg(feature = "files")]
    #[error(
        "the design has no requirements: add [hardware] with leg lengths, joint angles, diameters or greatest forces"
    )]
    NothingRequired,
    /// There is nothing to export.
    #[cfg(feature = "files")]
    #[error(transparent)]
    Export(#[from] NoExport),
    /// A format that cannot hold the design.
    #[cfg(feature = "files")]
    #[error(transparent)]
    Format(#[from] Unsupported),
    /// The offsets cannot be optimised as the design requires.
    #[cfg(feature = "optimize")]
    #[error(transparent)]
    OffsetProblem(#[from] optimize::offsets::InvalidOffsetProblem),
    /// The platform cannot be optimised as the design requires.
    #[cfg(feature = "optimize")]
    #[error(transparent)]
    DimensionalProblem(#[from] optimize::dimensional::InvalidProblem),
    /// A Pareto front requested together with a table of drives.
    #[cfg(feature = "optimize")]
    #[error("a front has many platforms, but a drive is chosen for one")]
    FrontWithDrives,
    /// A table of drives that is empty.
    #[cfg(feature = "optimize")]
    #[error("the table has no drive")]
    NoDrive,
    /// The design names a table of drives to choose from, and the table itself was not given.
    #[cfg(feature = "optimize")]
    #[error(
        "the design names a table of drives ({0}): give the table too, remove `drives` from [hardware], or give the limits of one drive"
    )]
    DriveTable(String),
    /// The computation was cancelled before there was an answer.
    #[error("cancelled")]
    Cancelled,
}

impl Error {
    /// All violations of a design file; empty for other errors.
    #[cfg(feature = "files")]
    #[must_use]
    pub fn violations(&self) -> &[Violation] {
        match self {
            Self::Design { violations, .. } => violations,
            _ => &[],
        }
    }
}

#[cfg(feature = "files")]
fn listed(violations: &[Violation]) -> String {
    violations.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

/// Converts an error of cranks to the error of its part.
#[cfg(feature = "files")]
impl From<machine::rotary::RotaryFkError> for Error {
    fn from(error: machine::rotary::RotaryFkError) -> Self {
        match error {
            machine::rotary::RotaryFkError::Manipulator(why) => Self::Manipulator(why),
            machine::rotary::RotaryFkError::Fk(why) => Self::Fk(why),
        }
    }
}

/// The conversion of valid lengths cannot fail.
impl From<std::convert::Infallible> for Error {
    fn from(never: std::convert::Infallible) -> Self {
        match never {}
    }
}
