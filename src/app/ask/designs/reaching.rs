//! The free travel of the platform from a pose, and the nearest allowed pose.

use super::Error;
use crate::Design;
use machine::reach::{FreeRange, NearestPose, NearestPoseOptions, Reach};
use platform::geom::Pose;

impl Design {
    /// The free travel of each of the six numbers of a pose (x, y, z, roll, pitch, yaw) while the others stay fixed. It
    /// ends at a violated requirement or a singular pose. `None` if the pose itself is not allowed. A control loop
    /// keeps a [`Reach`], which prepares the design once.
    ///
    /// ```
    /// use equipod::methods::reach::PoseAxis;
    /// use equipod::prelude::*;
    /// # std::env::set_current_dir("../../..").unwrap(); // the designs are at the top
    /// let design = Design::load("designs/presets/bench-l16.toml")?;
    /// let ranges = design.free_ranges(&design.home_or_default()).unwrap();
    /// let up = &ranges[2].forth;
    /// assert!(ranges[2].axis == PoseAxis::Z && up.amount > 0.0 && up.binding.is_some());
    /// # Ok::<(), Error>(())
    /// ```
    #[must_use]
    pub fn free_ranges(&self, pose: &Pose) -> Option<[FreeRange; 6]> {
        let required = self.requirements();
        self.reach(&required).free_ranges(pose)
    }

    /// A pose locally nearest to `asked` among the poses that meet every requirement; `asked` itself if it does. A
    /// radian counts as the characteristic length of the design.
    ///
    /// ```
    /// use equipod::methods::reach::NearestPoseOptions;
    /// use equipod::prelude::*;
    /// # std::env::set_current_dir("../../..").unwrap(); // the designs are at the top
    /// let design = Design::load("designs/presets/bench-l16.toml")?;
    /// let mut asked = design.home_or_default();
    /// asked.position.z += 1000.0;
    /// let found = design.nearest_allowed(&asked, &NearestPoseOptions::default())?;
    /// assert!(found.distance < 1000.0 && !found.binding.is_empty());
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NoAllowedPose`] if neither home nor a pose drawn on the way meets the requirements.
    pub fn nearest_allowed(&self, asked: &Pose, options: &NearestPoseOptions) -> Result<NearestPose, Error> {
        let required = self.requirements();
        self.reach(&required).nearest(asked, options).ok_or(Error::NoAllowedPose)
    }

    /// The limits of the design, prepared for many poses.
    pub fn reach<'a>(&'a self, required: &'a machine::requirements::Requirements) -> Reach<'a> {
        Reach::new(self.manipulator(), required, &self.home_or_default(), self.characteristic_length())
    }
}
