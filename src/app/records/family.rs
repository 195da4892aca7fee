//! Answers about every platform equivalent to an octahedral design.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::map::matrix;
use super::{DerivationRecord, Number, leg_number};
use ask::Design;
use ask::equivalents::Original;
use platform::manipulator::Body;
use synthesis::{
    AffineLegMap, Family, FamilyCounts, FamilyMember, HexagonPoint, InstantiateError, JointLabel, Pattern,
    edge_lengths,
};

view! {
    /// The answer of `equivalents family`.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct FamilyAnswer {
        /// The name of the design.
        pub name: String = name.into(),
        /// Legs along the hexagon, from 1.
        pub cyclic_order: Vec<usize> = o.order().map(leg_number).to_vec(),
        /// Edges of the hexagon, design units.
        pub edge_lengths: Vec<Number> = edge_lengths(o).map(Number).to_vec(),
        /// Numbers of patterns and topologies.
        pub counts: FamilyCounts = family.counts(),
        /// Patterns, or the requested one.
        pub patterns: Vec<PatternRecord> = members.iter().map(|m| PatternRecord::new(m, original)).collect(),
        /// Ways to share joints.
        pub topologies: Vec<FamilyTopologyRecord> =
            family.topologies().iter().enumerate().map(FamilyTopologyRecord::from).collect(),
        /// Platform at the offsets given, with `--offsets`.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub instance: Option<InstanceRecord> = None,
        /// Derivation of the leg map from coplanar joints, with `--explain`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub derivation: Option<DerivationRecord> = None,
    }
    /// The answer about a design, its original octahedral platform and these members of the class.
    pub fn new(name: &str, original: &Original, family: &Family, members: &[&FamilyMember]) {
        let o = &original.octahedral;
    }
}

view! {
    /// A pattern: the kept legs, and the moved legs with their edges.
    #[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
    pub struct PatternRecord {
        /// Name of the pattern: V and the vertices kept, S and the sides of the moved ones.
        pub id: String = p.to_string(),
        /// Class up to symmetry, from 1.
        pub class: usize = member.class + 1,
        /// Class up to all symmetries, from 1.
        pub class_exchange: usize = member.class_exchange + 1,
        /// Topology of the pattern, from 1.
        pub topology: usize = member.topology + 1,
        /// Whether offsets one at a time lead to it.
        pub sequential: bool = member.sequential,
        /// Legs of the design in order.
        pub legs: Vec<PatternLegRecord> = legs.into_iter().map(|(_, leg)| leg).collect(),
        /// Offset names.
        pub offsets: Vec<String> = p.offsets().iter().map(ToString::to_string).collect(),
        /// Joints of several legs.
        pub shared_joints: Vec<SharedJointRecord> = shared.collect(),
        /// Collinear joints.
        pub alignments: Vec<Vec<String>> =
            p.alignments().iter().map(|l| l.iter().map(|j| name(*j)).collect()).collect(),
        /// Formulas of A, with legs in the order of the design.
        #[serde(rename = "A")]
        pub matrix: [[String; 6]; 6] = p.matrix_formulas(o),
        /// Formula of det A.
        #[serde(rename = "det")]
        pub determinant: String = p.determinant_formula(),
        /// Equations of the zeros of det A.
        #[serde(rename = "det_zero")]
        pub zeros: Vec<String> = p.factors().iter().map(|f| f.zero()).collect(),
    }
    fn new(member: &FamilyMember, original: &Original) {
        let (p, o) = (&member.pattern, &original.octahedral);
        let order = o.order();
        let name = |j: JointLabel| original.joint_name(j);
        let mut legs: Vec<(usize, PatternLegRecord)> = Vec::with_capacity(6);
        for (slot, point) in order.iter().zip(p.legs()) {
            let [base, platform] = point.joints().map(name);
            let place = match point {
                HexagonPoint::Vertex(_) => PatternPlace::Vertex {},
                HexagonPoint::Inner(t) => PatternPlace::Inner {
                    side: t.side + 1,
                    offset: t.to_string(),
                    between: [order[t.side], order[(t.side + 1) % 6]].map(leg_number),
                },
            };
            legs.push((slot.get(), PatternLegRecord { base, platform, place }));
        }
        legs.sort_by_key(|(slot, _)| *slot);
        let shared = p.shared_joints().into_iter().map(|(body, joint, legs)| {
            let mut legs: Vec<usize> = legs.iter().map(|i| leg_number(order[*i])).collect();
            legs.sort_unstable();
            SharedJointRecord { body, joint: name(joint), legs }
        });
    }
}

/// One leg of a pattern.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct PatternLegRecord {
    /// Base joint.
    pub base: String,
    /// Platform joint.
    pub platform: String,
    /// The place of the leg on the hexagon.
    #[serde(flatten)]
    pub place: PatternPlace,
}

/// The place of a leg on the hexagon.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum PatternPlace {
    /// At a vertex: the leg is kept.
    Vertex {},
    /// On a side: the leg is moved along an edge.
    Inner {
        /// The side, from 1.
        side: usize,
        /// Name of its offset.
        offset: String,
        /// Legs at the ends of the side, from 1.
        between: [usize; 2],
    },
}

/// A joint that holds more than one leg.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct SharedJointRecord {
    /// The body it is on.
    pub body: Body,
    /// The name of the joint.
    pub joint: String,
    /// The legs, from 1.
    pub legs: Vec<usize>,
}

/// A way in which the legs of equivalent platforms share joints.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct FamilyTopologyRecord {
    /// Topology number, from 1.
    pub topology: usize,
    /// Joints of the base.
    pub base_joints: usize,
    /// Joints of the platform.
    pub platform_joints: usize,
    /// Joints of several legs.
    pub shared_joints: usize,
    /// Whether offsets one at a time lead to it.
    pub sequential: bool,
    /// Pattern with this topology.
    pub example: String,
    /// Topologies one offset further, from 1.
    pub next: Vec<usize>,
}

impl From<(usize, &synthesis::FamilyTopology)> for FamilyTopologyRecord {
    fn from((k, t): (usize, &synthesis::FamilyTopology)) -> Self {
        Self {
            topology: k + 1,
            base_joints: t.topology.base_joints(),
            platform_joints: t.topology.platform_joints(),
            shared_joints: t.topology.shared_joints(),
            sequential: t.sequential,
            example: t.example.to_string(),
            next: t.next.iter().map(|n| n + 1).collect(),
        }
    }
}

/// The platform of a pattern at given offsets.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct InstanceRecord {
    /// The pattern.
    pub pattern: String,
    /// Offsets as fractions of the edges.
    pub offsets: Vec<Number>,
    /// Rows of A: s' = A s + c of squared leg lengths.
    #[serde(rename = "A")]
    pub matrix: [[Number; 6]; 6],
    /// The constant terms, design units squared.
    #[serde(rename = "c")]
    pub constants: [Number; 6],
    /// The determinant of A.
    #[serde(rename = "det")]
    pub determinant: Number,
    /// Joints of the base.
    pub base_joints: usize,
    /// Joints of the platform.
    pub platform_joints: usize,
}

impl InstanceRecord {
    /// The record of the platform `built` with the map to it.
    ///
    /// # Errors
    /// When the offsets do not fit the pattern.
    pub fn new(
        pattern: &Pattern,
        offsets: &[f64],
        built: &Design,
        map: &AffineLegMap,
    ) -> Result<Self, InstantiateError> {
        let m = built.manipulator();
        let c: [f64; 6] = map.c.into();
        Ok(Self {
            pattern: pattern.to_string(),
            offsets: offsets.iter().copied().map(Number).collect(),
            matrix: matrix(map),
            constants: c.map(Number),
            determinant: Number(pattern.determinant(offsets)?),
            base_joints: m.base_joints().len(),
            platform_joints: m.platform_joints().len(),
        })
    }
}
