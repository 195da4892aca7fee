//! The convention in which poses of a design come in and go out.

use crate::Design;
use machine::reach::StraightPath;
use platform::geom::{InvalidPose, Pose, PoseConvention, WrittenPose};

/// A convention for poses with the home that they may count from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseFrames {
    /// The convention.
    pub convention: PoseConvention,
    /// The home pose.
    pub home: Pose,
}

/// The prefix of a pose in the usual convention, whatever else is stated.
const USUAL: &str = "base:";

impl PoseFrames {
    /// The pose of a text: `home`, six or seven numbers of the convention, or such numbers in the usual one after
    /// `base:`.
    ///
    /// # Errors
    /// As of [`PoseConvention::read_text`].
    pub fn read(&self, text: &str) -> Result<Pose, InvalidPose> {
        if text == "home" {
            return Ok(self.home);
        }
        let (convention, numbers) = self.convention_of(text);
        convention.read_text(numbers, &self.home)
    }

    /// The convention of a text, and the text without the prefix that names the usual one.
    #[must_use]
    pub fn convention_of<'t>(&self, text: &'t str) -> (PoseConvention, &'t str) {
        match text.strip_prefix(USUAL) {
            Some(numbers) => (PoseConvention::default(), numbers),
            None => (self.convention, text),
        }
    }

    /// A pose in the numbers of the convention.
    #[must_use]
    pub fn write(&self, pose: &Pose) -> WrittenPose {
        self.convention.write(pose, &self.home)
    }

    /// The ways on which one of the six numbers of a pose grows and the others stay; for a rotation vector turns about
    /// x, y and z in place of its components.
    #[must_use]
    pub fn ways(&self, pose: &Pose) -> [StraightPath; 6] {
        let pivot = self.convention.pivot_on_platform();
        self.convention.ways(pose, &self.home).map(|[velocity, turn]| StraightPath {
            start: *pose,
            velocity,
            turn,
            pivot,
        })
    }
}

impl Design {
    /// The stated convention, filled by the design's own one, with the design's home.
    #[must_use]
    pub fn pose_frames(&self, stated: PoseConvention) -> PoseFrames {
        PoseFrames { convention: stated.over(&self.frames), home: self.home_or_default() }
    }
}
