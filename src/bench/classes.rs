//! The classes of problems the harness draws.

/// A class of platforms; see [`problem`](super::problem) for how each is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Class {
    /// Six base joints, six platform joints, nothing special (Martyushev, sec. 5).
    General,
    /// Two platform joints coincide (Martyushev, sec. 5).
    SharedPlatformJoint,
    /// Base in a plane (Martyushev, sec. 5).
    PlanarBase,
    /// Base and platform in a plane each.
    BothPlanar,
    /// Base and platform in planes that are no coordinate planes of their frames.
    TiltedPlanes,
    /// Zigzag between two triangles.
    Octahedral,
    /// Octahedral with all six joints moved along the edges by different parts: no shared joint.
    GriffisDuffy,
    /// Semi-regular hexagons with threefold symmetry, near the home pose.
    Hexapod,
    /// Platform hexagon similar to the base hexagon, both planar.
    Similar,
    /// Platform hexagon an affine image of the base hexagon, both planar.
    Affine,
    /// Platform hexagon congruent to the base hexagon, both planar.
    Congruent,
    /// Three base joints of legs 1-3 on a line, three platform joints of legs 4-6 on a line.
    Collinear,
    /// Two poses separated by about `1e-6` of the size.
    ClosePair,
    /// Leg lengths spread over `1e3`.
    Spread,
}

impl Class {
    /// All classes, in the order of the tables.
    pub const ALL: [Self; 14] = [
        Self::General,
        Self::SharedPlatformJoint,
        Self::PlanarBase,
        Self::BothPlanar,
        Self::TiltedPlanes,
        Self::Octahedral,
        Self::GriffisDuffy,
        Self::Hexapod,
        Self::Similar,
        Self::Affine,
        Self::Congruent,
        Self::Collinear,
        Self::ClosePair,
        Self::Spread,
    ];

    /// The name on the command line and in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::General => "6-6",
            Self::SharedPlatformJoint => "6-5",
            Self::PlanarBase => "6P-6",
            Self::BothPlanar => "6P-6P",
            Self::TiltedPlanes => "tilted-planes",
            Self::Octahedral => "octahedral",
            Self::GriffisDuffy => "griffis-duffy",
            Self::Hexapod => "hexapod",
            Self::Similar => "similar",
            Self::Affine => "affine",
            Self::Congruent => "congruent",
            Self::Collinear => "collinear",
            Self::ClosePair => "close-pair",
            Self::Spread => "spread",
        }
    }

    /// The class with a name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|c| c.name() == name)
    }

    /// Whether the leg lengths may be drawn without a pose, as Martyushev does; the others are about real poses.
    #[must_use]
    pub fn allows_uniform_lengths(self) -> bool {
        let by_martyushev = [
            Self::General,
            Self::SharedPlatformJoint,
            Self::PlanarBase,
            Self::BothPlanar,
            Self::TiltedPlanes,
        ];
        by_martyushev.contains(&self)
    }

    /// A number that sets the class's random streams apart: its place in [`Class::ALL`] never enters.
    pub(super) fn stream(self) -> u64 {
        // FNV-1a of the name
        self.name()
            .bytes()
            .fold(0xcbf2_9ce4_8422_2325, |h, b| (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3))
    }
}

impl std::fmt::Display for Class {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_read_back_and_streams_differ() {
        for (i, c) in Class::ALL.into_iter().enumerate() {
            assert_eq!(Class::from_name(c.name()), Some(c));
            assert!(Class::ALL[..i].iter().all(|d| d.stream() != c.stream()));
        }
        assert_eq!(Class::from_name("7-7"), None);
    }
}
