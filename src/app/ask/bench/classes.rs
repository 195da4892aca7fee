//! The classes of problems the harness draws.

use std::borrow::Cow;

use platform::topology::{NamedTopology, catalogue};

/// The bodies that have their joints in a plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Planar {
    /// Neither.
    Neither,
    /// The base.
    Base,
    /// The platform.
    Platform,
    /// Both.
    Both,
}

impl Planar {
    /// The suffixes of the name of a topology.
    const SUFFIXES: [(Self, &'static str); 4] = [
        (Self::Neither, ""),
        (Self::Base, "-planar-base"),
        (Self::Platform, "-planar-platform"),
        (Self::Both, "-both-planar"),
    ];
}

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
    /// Both planar but for one joint of one body (Martyushev, sec. 5, remark 2).
    AlmostPlanar,
    /// Base and platform in planes that are not coordinate planes of their frames.
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
    /// A double root, exactly: joints and squared lengths are the doubles they should be.
    DoubleRoot,
    /// [`Class::Hexapod`] at its home pose.
    HexapodHome,
    /// A topology of the catalogue, with its shared joints.
    Topology {
        /// The topology.
        topology: NamedTopology,
        /// Bodies whose joints lie in a plane, beyond the planes that three joints span anyway.
        planar: Planar,
    },
}

impl Class {
    /// All classes except topologies, in the order of the tables.
    pub const ALL: [Self; 17] = [
        Self::General,
        Self::SharedPlatformJoint,
        Self::PlanarBase,
        Self::BothPlanar,
        Self::AlmostPlanar,
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
        Self::DoubleRoot,
        Self::HexapodHome,
    ];

    /// The classes `T01`, ... of joints in space.
    #[must_use]
    pub fn topologies() -> Vec<Self> {
        let class = |topology| Self::Topology { topology, planar: Planar::Neither };
        catalogue().into_iter().map(class).collect()
    }

    /// The name on the command line and in JSON.
    #[must_use]
    pub fn name(self) -> Cow<'static, str> {
        let fixed = match self {
            Self::Topology { topology, planar } => {
                let suffix = Planar::SUFFIXES.iter().find(|s| s.0 == planar).map_or("", |s| s.1);
                return (topology.id() + suffix).into();
            }
            Self::General => "6-6",
            Self::SharedPlatformJoint => "6-5",
            Self::PlanarBase => "6P-6",
            Self::BothPlanar => "6P-6P",
            Self::AlmostPlanar => "almost-planar",
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
            Self::DoubleRoot => "double-root",
            Self::HexapodHome => "hexapod-home",
        };
        fixed.into()
    }

    /// The class with a name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        let (id, suffix) = name.split_at_checked(3).unwrap_or((name, ""));
        let planar = Planar::SUFFIXES.into_iter().find(|s| s.1 == suffix);
        let topology = |planar| {
            let found = catalogue().into_iter().find(|t| t.id() == id)?;
            Some(Self::Topology { topology: found, planar })
        };
        let fixed = Self::ALL.into_iter().find(|c| c.name() == name);
        fixed.or_else(|| topology(planar?.0))
    }

    /// Whether the leg lengths may be drawn without a pose, as Martyushev does; the other classes need real poses.
    #[must_use]
    pub fn allows_uniform_lengths(self) -> bool {
        let by_martyushev = [
            Self::General,
            Self::SharedPlatformJoint,
            Self::PlanarBase,
            Self::BothPlanar,
            Self::AlmostPlanar,
            Self::TiltedPlanes,
        ];
        by_martyushev.contains(&self)
    }

    /// A number that separates the class's random streams; it does not depend on its place in [`Class::ALL`].
    pub(super) fn stream(self) -> u64 {
        // FNV-1a of the name
        self.name()
            .bytes()
            .fold(0xcbf2_9ce4_8422_2325, |h, b| (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3))
    }
}

impl std::fmt::Display for Class {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(&self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[ignore = "evidence"]
    fn names_read_back_and_streams_differ() {
        for (i, c) in Class::ALL.into_iter().enumerate() {
            assert_eq!(Class::from_name(&c.name()), Some(c));
            assert!(Class::ALL[..i].iter().all(|d| d.stream() != c.stream()));
        }
        let topologies = Class::topologies();
        assert_eq!(topologies.len(), 34);
        for (i, c) in topologies.iter().enumerate() {
            assert_eq!(Class::from_name(&c.name()), Some(*c));
            assert!(topologies[..i].iter().all(|d| d.stream() != c.stream()));
        }
        for suffix in ["-planar-base", "-planar-platform", "-both-planar"] {
            let name = format!("T04{suffix}");
            assert_eq!(Class::from_name(&name).unwrap().name(), name);
        }
        for none in ["7-7", "T35", "T00", "T4", "T04P", "", "T04-planar"] {
            assert_eq!(Class::from_name(none), None);
        }
    }
}
