//! Rigid groups of bodies at the reference configuration of a model, and the joints between them.

use std::collections::BTreeMap;

use nalgebra::{Point3, Unit, Vector3};

use platform::geom::Pose;

/// The group of the world.
pub(super) const WORLD: usize = 0;

/// The motion that a joint allows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum JointKind {
    Hinge,
    Ball,
    Slide,
}

impl JointKind {
    /// The number of rotations.
    pub(super) fn rotations(self) -> usize {
        match self {
            Self::Hinge => 1,
            Self::Ball => 3,
            Self::Slide => 0,
        }
    }
}

/// A joint between two groups.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ModelJoint {
    pub(super) kind: JointKind,
    pub(super) name: String,
    pub(super) groups: [usize; 2],
    /// Its point in each group, base frame; the two sites of a `connect` may differ.
    pub(super) points: [Point3<f64>; 2],
    /// The axis of a hinge, base frame.
    pub(super) axis: Option<Unit<Vector3<f64>>>,
}

/// A tendon from site to site.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tendon {
    pub(super) name: String,
    pub(super) groups: [usize; 2],
    pub(super) points: [Point3<f64>; 2],
}

/// A body with its group and its frame, base frame.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PlacedBody {
    pub(super) group: usize,
    pub(super) at: Pose,
}

/// Rigid groups of bodies and the joints between them.
#[derive(Debug, Default)]
pub(super) struct Mechanism {
    groups: usize,
    /// For each group the lowest of those that `weld` joins to it.
    joined: Vec<usize>,
    pub(super) joints: Vec<ModelJoint>,
    pub(super) tendons: Vec<Tendon>,
    /// Number of spatial tendons with other than two sites.
    pub(super) other_tendons: usize,
    /// The first body of each group, its name and its frame.
    pub(super) first: BTreeMap<usize, (String, Pose)>,
    pub(super) bodies: BTreeMap<String, PlacedBody>,
    pub(super) sites: BTreeMap<String, PlacedBody>,
    /// Number of hinges with an actuator.
    pub(super) driven_hinges: usize,
    pub(super) guesses: Vec<String>,
}

impl Mechanism {
    /// The world alone.
    pub(super) fn new() -> Self {
        let mut mechanism = Self { groups: 1, joined: vec![WORLD], ..Self::default() };
        mechanism.first.insert(WORLD, ("world".into(), Pose::identity()));
        mechanism.bodies.insert("world".into(), PlacedBody { group: WORLD, at: Pose::identity() });
        mechanism
    }

    /// Joins two groups.
    pub(super) fn join(&mut self, a: usize, b: usize) {
        let [a, b] = [a, b].map(|g| self.group(g));
        self.joined[a.max(b)] = a.min(b);
    }

    pub(super) fn new_group(&mut self) -> usize {
        self.joined.push(self.groups);
        self.groups += 1;
        self.groups - 1
    }

    /// The group after all joins.
    pub(super) fn group(&self, mut group: usize) -> usize {
        while self.joined[group] != group {
            group = self.joined[group];
        }
        group
    }

    /// Name and frame of the first body of a group; a group between two joints of a body has none.
    pub(super) fn first_body(&self, group: usize) -> Option<&(String, Pose)> {
        self.first.iter().find(|(g, _)| self.group(**g) == group).map(|(_, first)| first)
    }

    /// The group and the frame of a site.
    pub(super) fn site(&self, name: &str) -> Option<(usize, Pose)> {
        self.sites.get(name).map(|placed| (self.group(placed.group), placed.at))
    }
}
