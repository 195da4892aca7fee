//! Answers about the ways in which six legs can share joints.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{RearrangementRecord, TrilaterationStepRecord};
use fk::distance::ClosureDegrees;
use platform::topology::{JointIndex, NamedTopology, Sequence};

/// The answer of `equivalents topologies`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TopologiesAnswer {
    /// Topologies that can hold a platform.
    #[schemars(extend("const" = 34))]
    pub count: usize,
    /// The topology of the given design, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub design: Option<RecognisedRecord>,
    /// Numbers of topologies by virtual legs; absent: a design is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub by_virtual_legs: Option<VirtualLegsRecord>,
    /// Number of random members solved by topology.
    pub members: u64,
    /// The topologies.
    pub topologies: Vec<TopologyRecord>,
    /// Fewest shared joints by equivalent rearrangement, with `--rearrangements`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rearrangements: Option<Vec<RearrangementRecord>>,
}

/// The topology of a design.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct RecognisedRecord {
    /// The name of the design.
    pub name: String,
    /// The identifier of the topology, T01 to T34.
    pub id: String,
    /// Name of the topology: numbers of base and platform joints.
    pub topology: String,
    /// Whether base and platform are exchanged.
    pub exchanged: bool,
}

view! {
    /// Numbers of topologies by the virtual legs that trilateration needs.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
    pub struct VirtualLegsRecord {
        /// Number of topologies without a virtual leg.
        #[serde(rename = "0")]
        pub none: usize = count(0, false),
        /// Number of decoupled topologies with one virtual leg: the position of some joint is found before the others.
        #[serde(rename = "1_decoupled")]
        pub one_decoupled: usize = count(1, true),
        /// Number of coupled topologies with one virtual leg.
        #[serde(rename = "1_coupled")]
        pub one_coupled: usize = count(1, false),
        /// Number of topologies with two virtual legs.
        #[serde(rename = "2")]
        pub two: usize = count(2, false),
        /// Number of topologies with three virtual legs.
        #[serde(rename = "3")]
        pub three: usize = count(3, false),
    }
    /// The numbers for a list of topologies.
    pub fn of(list: &[NamedTopology]) {
        let count = |legs: usize, decoupled: bool| {
            let of = |t: &&NamedTopology| {
                let t = t.topology();
                t.trilateration().virtual_legs.len() == legs && t.is_decoupled() == decoupled
            };
            list.iter().filter(of).count()
        };
    }
}

view! {
    /// One topology.
    #[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
    pub struct TopologyRecord {
        /// The identifier of the topology, T01 to T34.
        #[schemars(regex(pattern = r"^T(0[1-9]|[12][0-9]|3[0-4])$"))]
        pub id: String = f.named.id(),
        /// Name of the topology: numbers of base and platform joints.
        pub name: String = f.named.name(),
        /// Number of joints of the base.
        pub base_joints: usize = t.base_joints(),
        /// Number of joints of the platform.
        pub platform_joints: usize = t.platform_joints(),
        /// Number of joints of several legs.
        pub shared_joints: usize = t.shared_joints(),
        /// Base joint and platform joint by leg.
        pub legs: Vec<[String; 2]> = joint_pairs(&t.legs()),
        /// Number of virtual legs for trilateration.
        pub virtual_legs: usize = f.sequence.virtual_legs.len(),
        /// The joints of the virtual legs.
        pub virtual_leg_joints: Vec<[String; 2]> = joint_pairs(&f.sequence.virtual_legs),
        /// Whether some joint is placed before the others.
        pub decoupled: bool = f.decoupled,
        /// The joints of the first triangle.
        pub start: [String; 3] = f.sequence.start.map(joint_name),
        /// The trilaterations after the first triangle.
        pub sequence: Vec<TrilaterationStepRecord> =
            f.sequence.steps.iter().map(|s| TrilaterationStepRecord::new(s, joint_name)).collect(),
        /// Number of finite poses of a random member, counted with multiplicity.
        pub finite_roots: u32 = f.poses,
        /// Whether this number is proved.
        pub finite_roots_proved: bool = f.proved,
        /// Closure polynomial degree; null with two or more virtual legs.
        pub closure_degree: Option<usize> = f.closure.as_ref().map(|c| c.after),
        /// Closure degree with singular factors.
        pub closure_degree_before: Option<usize> = f.closure.as_ref().map(|c| c.before),
        /// Number of distinct roots of the closure polynomial.
        pub closure_distinct_roots: Option<usize> = f.closure.as_ref().map(|c| c.distinct),
    }
    impl From(f: &TopologyFindings) {
        let t = f.named.topology();
    }
}

/// The computed properties of a topology.
#[derive(Debug)]
pub struct TopologyFindings {
    /// The topology.
    pub named: NamedTopology,
    /// The sequence of trilaterations that gives its poses.
    pub sequence: Sequence,
    /// Whether the position of some joint is found before the others.
    pub decoupled: bool,
    /// Number of finite poses of random members.
    pub poses: u32,
    /// Whether this number is proved.
    pub proved: bool,
    /// The closure degrees of a random member, for at most one virtual leg.
    pub closure: Option<ClosureDegrees>,
}

fn joint_name(joint: JointIndex) -> String {
    match joint {
        JointIndex::Base(k) => format!("A{}", k + 1),
        JointIndex::Platform(k) => format!("B{}", k + 1),
    }
}

/// Names of the joints of legs.
pub(super) fn joint_pairs(legs: &[(usize, usize)]) -> Vec<[String; 2]> {
    legs.iter()
        .map(|(a, b)| [joint_name(JointIndex::Base(*a)), joint_name(JointIndex::Platform(*b))])
        .collect()
}
