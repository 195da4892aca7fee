//! The free travel of the platform from a pose, and the nearest allowed pose.

use super::Error;
use crate::Design;
use machine::reach::{FreeRange, NearestPose, NearestPoseOptions, Reach, StraightPath};
use machine::requirements::{CoordinateRange, Limit};
use platform::geom::Pose;

/// A range of a single coordinate that the design states, with its free part; computed in doubles, without proof.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StatedRange {
    /// The coordinate, from 0: `x`, `y`, `z`, and rotations about these axes.
    pub coordinate: usize,
    /// Its ends, design units or degrees.
    pub range: CoordinateRange,
    /// Free part towards smaller values.
    pub back: FreePart,
    /// Free part towards greater values.
    pub forth: FreePart,
}

/// The free part of a range to one side of home.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreePart {
    /// Its length, design units or degrees.
    pub free: f64,
    /// The requirement violated beyond its end, with its margin there; `None` if the whole range is free.
    pub binding: Option<(Limit, f64)>,
}

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

    /// The ranges of the workspace with their free parts.
    #[must_use]
    pub fn stated_ranges(&self) -> Vec<StatedRange> {
        if self.workspace.ranged_coordinates() == 0 {
            return Vec::new();
        }
        let (required, space) = (self.requirements(), self.workspace.space(&self.home_or_default()));
        let reach = self.reach(&required);
        let stated = space.ranges.iter().enumerate().filter(|(_, range)| !range.is_still());
        let with_free_parts = |(k, range): (usize, &CoordinateRange)| {
            let way = StraightPath::coordinate(&space, k);
            let part = |way: &StraightPath, most: f64| {
                let found = reach.along(way, if k < 3 { most } else { most.to_radians() });
                let amount = if k < 3 { found.amount } else { found.amount.to_degrees() };
                // a whole part ends at the stated number
                let free = found.binding.map_or(most, |_| amount);
                let margin_of = |limit| (limit, reach.margin_of(limit, &found.pose));
                FreePart { free, binding: found.binding.map(margin_of) }
            };
            let (back, forth) = (part(&way.reversed(), -range.min), part(&way, range.max));
            StatedRange { coordinate: k, range: *range, back, forth }
        };
        stated.map(with_free_parts).collect()
    }

    /// The limits of the design, prepared for many poses.
    pub fn reach<'a>(&'a self, required: &'a machine::requirements::Requirements) -> Reach<'a> {
        Reach::new(self.manipulator(), required, &self.home_or_default(), self.characteristic_length())
    }
}
