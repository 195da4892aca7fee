//! Which legs of a pattern share which joints.

use super::pattern::Pattern;
use crate::platform::topology::Topology;

impl Topology {
    /// The topology of a pattern; base and platform are kept apart.
    ///
    /// Two legs share a joint when their ends coincide by construction, for all offsets.
    #[must_use]
    pub fn of(pattern: &Pattern) -> Self {
        let joints = pattern.joints();
        let ends = |body: usize| {
            pattern.legs().map(|p| joints[body].iter().position(|j| *j == p.joints()[body]).unwrap_or(0))
        };
        Self::of_legs(ends(0), ends(1))
    }
}
