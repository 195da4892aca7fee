//! Decides whether the legs or rods hold the platform at home.

use crate::Design;
use num::shown::rounded;
use platform::geom::Pose;
use synthesis::singularity::{Architecture, PoseHold, SingularEvidence, hold_at};

/// A home pose at which the legs or rods do not hold the platform.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct SingularHome {
    /// The pose.
    pub pose: Pose,
    /// The evidence.
    pub evidence: SingularEvidence,
}

/// The finding in a few words.
impl std::fmt::Display for SingularHome {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [x, y, z]: [f64; 3] = self.pose.position.into();
        let [roll, pitch, yaw] = self.pose.angles().degrees().map(|angle| angle + 0.0);
        let [x, y, z, roll, pitch, yaw] = [x, y, z, roll, pitch, yaw].map(|number| rounded(number, 3));
        write!(
            f,
            "the home pose ({x}, {y}, {z}; {roll}, {pitch}, {yaw} degrees) is singular: {}",
            self.evidence
        )
    }
}

impl Design {
    /// The home pose that the design states, if it is singular; `None` if it is proved regular, or no home is stated.
    #[must_use]
    pub fn singular_home(&self) -> Option<SingularHome> {
        self.singular_at(&self.home?)
    }

    /// The same for any pose.
    pub fn singular_at(&self, pose: &Pose) -> Option<SingularHome> {
        let hold = match self.rotary().ok().flatten() {
            None => hold_at(self.manipulator(), pose),
            // a pose beyond the reach of the rods is reported elsewhere
            Some(platform) => {
                let angles = platform.ik(pose).ok()?;
                hold_at(&platform.at(&angles).ok()?, pose)
            }
        };
        match hold {
            PoseHold::Held(_) => None,
            PoseHold::Singular(evidence) => Some(SingularHome { pose: *pose, evidence }),
        }
    }

    /// The home pose, stated or default, if it is singular and the design is not: no equivalent platform holds this
    /// pose. Architecturally singular designs are handled elsewhere.
    pub fn home_that_no_equivalent_holds(&self) -> Option<SingularHome> {
        let home = self.singular_at(&self.home_or_default())?;
        (Architecture::of(self.manipulator()).is_singular() == Some(false)).then_some(home)
    }
}
