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

/// Why a question could not be asked or answered. An answer of "no", or "not known", is a value and no error.
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
        /// What the system said.
        source: std::io::Error,
    },
    /// A design file with everything that is wrong with it.
    #[cfg(feature = "files")]
    #[error("{}{}", file.as_ref().map(|f| format!("{}: ", f.display())).unwrap_or_default(), listed(violations))]
    Design {
        /// The file, where the text is from one.
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
        /// What is wrong with it, line by line.
        bad: Vec<String>,
    },
    /// A joint cannot be changed.
    #[cfg(feature = "files")]
    #[error(transparent)]
    Joint(#[from] JointError),
    /// A name that is none of those known.
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
    /// A pose so far away that leg lengths overflow.
    #[error("the leg lengths at this pose overflow")]
    Overflow,
    /// Neither home nor a pose drawn on the way from it meets the requirements.
    #[cfg(feature = "files")]
    #[error("no pose was found that meets the requirements")]
    NoAllowedPose,
    /// A question about the class of octahedral platforms, asked of another design.
    #[error("not an octahedral platform: {0}")]
    NotOctahedral(#[from] NotOctahedral),
    /// A method does not apply, or forward kinematics broke down.
    #[error(transparent)]
    Fk(#[from] FkError),
    /// A search for equivalent platforms from a home pose that none of them holds.
    #[cfg(all(feature = "files", feature = "optimize"))]
    #[error("{0}, and no equivalent platform holds it")]
    SingularHome(SingularHome),
    /// Two designs in different units.
    #[cfg(feature = "files")]
    #[error("{} is in {} and {} is in {}: write both in the same unit", .0[0].0, .0[0].1, .0[1].0, .0[1].1)]
    Units(Box<[(String, String); 2]>),
    /// Singular values could not be computed.
    #[cfg(feature = "synthesis")]
    #[error(transparent)]
    Linalg(#[from] LinalgError),
    /// Nothing could be calibrated.
    #[cfg(feature = "synthesis")]
    #[error(transparent)]
    Calibration(#[from] CalibrationError),
    /// Two designs could not be compared.
    #[cfg(feature = "synthesis")]
    #[error(transparent)]
    Verify(#[from] VerifyError),
    /// Two judgements of one design contradict each other.
    #[cfg(feature = "synthesis")]
    #[error(
        "the design is proved to be {}, and {poses} poses are counted for generic leg lengths: one of the two is wrong, please report the design",
        if *singular { "architecturally singular" } else { "regular" }
    )]
    Contradiction {
        /// What the leg lines say.
        singular: bool,
        /// What the count says.
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
    /// The design requires nothing that could be assessed.
    #[cfg(feature = "files")]
    #[error("the design requires nothing: add [hardware] with lengths, swing, diameters or greatest forces")]
    NothingRequired,
    /// Nothing to export.
    #[cfg(feature = "files")]
    #[error(transparent)]
    Export(#[from] NoExport),
    /// A format that cannot hold the design.
    #[cfg(feature = "files")]
    #[error(transparent)]
    Format(#[from] Unsupported),
    /// The offsets cannot be optimised as the design asks.
    #[cfg(feature = "optimize")]
    #[error(transparent)]
    OffsetProblem(#[from] optimize::offsets::InvalidOffsetProblem),
    /// The platform cannot be optimised as the design asks.
    #[cfg(feature = "optimize")]
    #[error(transparent)]
    DimensionalProblem(#[from] optimize::dimensional::InvalidProblem),
    /// A front asked for with a table of drives.
    #[cfg(feature = "optimize")]
    #[error("a front is many platforms, and a drive is chosen for one")]
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
    /// It was cancelled before there was an answer.
    #[error("cancelled")]
    Cancelled,
}

impl Error {
    /// Everything that is wrong with a design file; empty for other errors.
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

/// The parts of an error of cranks are errors of their own.
#[cfg(feature = "files")]
impl From<machine::rotary::RotaryFkError> for Error {
    fn from(error: machine::rotary::RotaryFkError) -> Self {
        match error {
            machine::rotary::RotaryFkError::Manipulator(why) => Self::Manipulator(why),
            machine::rotary::RotaryFkError::Fk(why) => Self::Fk(why),
        }
    }
}

/// Lengths that are valid already cannot fail to be.
impl From<std::convert::Infallible> for Error {
    fn from(never: std::convert::Infallible) -> Self {
        match never {}
    }
}
