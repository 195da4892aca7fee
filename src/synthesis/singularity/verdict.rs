//! The single verdict on a platform, used by every command, page and table.

use super::nearest::rounded_singular;
use super::{Architecture, NearestSingular};
use num::linalg::LinalgError;
use platform::manipulator::{Level, Manipulator};

/// Whether a platform is architecturally singular.
///
/// | verdict | when |
/// |---|---|
/// | singular | the six leg lines are dependent at every pose: proved |
/// | regular | some pose holds the platform, proved, and plain numbers are rounded values of no singular design that was found |
/// | not decided | plain numbers may be rounded values of a singular design, or joints are known between bounds only |
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct SingularityVerdict {
    /// The decision on the joints as written, in exact arithmetic, with its proof.
    pub architecture: Architecture,
    /// The singular design that may be intended: within rounding, or to the given digits. It exists only for plain
    /// numbers that are regular as written.
    pub meant: Option<NearestSingular>,
}

impl SingularityVerdict {
    /// The verdict on a platform.
    ///
    /// # Errors
    /// When a singular value decomposition does not converge.
    pub fn of(m: &Manipulator) -> Result<Self, LinalgError> {
        let architecture = Architecture::of(m);
        let meant = match (architecture.is_singular(), architecture.level) {
            (Some(false), Some(Level::DoublesAsWritten)) => rounded_singular(m)?,
            _ => None,
        };
        Ok(Self { architecture, meant })
    }

    /// Proved either way, or `None`.
    #[must_use]
    pub fn is_singular(&self) -> Option<bool> {
        if self.meant.is_some() { None } else { self.architecture.is_singular() }
    }

    /// The joints of the proof; `None` if they are known only between bounds and nothing is decided.
    #[must_use]
    pub fn level(&self) -> Option<Level> {
        if self.meant.is_some() { Some(Level::WithinRounding) } else { self.architecture.level }
    }

    /// The reason in a short code, `None` for a regular design.
    #[must_use]
    pub fn reason(&self) -> Option<&'static str> {
        match (&self.meant, self.is_singular()) {
            (Some(near), _) if near.within_rounding => Some("singular_within_rounding"),
            (Some(_), _) => Some("singular_to_digits_given"),
            (None, None) => Some("joints_not_exact"),
            (None, Some(_)) => self.architecture.findings.first().map(|f| f.case.reason()),
        }
    }

    /// The undecided verdict in words; lengths in `units`.
    #[must_use]
    pub fn undecided_in_words(&self, units: &str) -> Option<String> {
        match (&self.meant, self.is_singular()) {
            (Some(near), _) => Some(near.words(units)),
            (None, None) => Some("not decided: joints are known between bounds only".to_owned()),
            (None, Some(_)) => None,
        }
    }
}
