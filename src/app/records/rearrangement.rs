//! The best equivalent rearrangement of the legs of a topology, with its proof.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::topologies::joint_pairs;
use platform::manipulator::Body;
use synthesis::rearrangement::{
    Argument, Arrangement, Obstruction, Piece, PieceKind, Rearrangement, Reduction,
};

view! {
    /// One line of the table of rearrangements.
    #[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
    pub struct RearrangementRecord {
        /// The identifier of the topology, T01 to T34.
        pub id: String = r.topology.id(),
        /// Name of the topology: numbers of base and platform joints.
        pub name: String = r.topology.name(),
        /// The arrangement of the base joints: in space or in a plane.
        #[schemars(extend("enum" = ["space", "plane"]))]
        pub base: String = base,
        /// The arrangement of the platform joints: in space or in a plane.
        #[schemars(extend("enum" = ["space", "plane"]))]
        pub platform: String = platform,
        /// Argument for all families of replaceable legs.
        pub argument: ArgumentWord = match r.argument {
            Argument::Stars(Body::Base) => ArgumentWord::StarsBase,
            Argument::Stars(Body::Platform) => ArgumentWord::StarsPlatform,
            Argument::Supports => ArgumentWord::Supports,
            Argument::Curves => ArgumentWord::Curves,
        },
        /// The families of replaceable legs.
        pub families: Vec<FamilyRecord> = r.families.iter().map(FamilyRecord::from).collect(),
        /// The names of the families.
        pub family_names: String = r.family_names(),
        /// Dimensions of the span's summands.
        pub summands: Vec<usize> = r.summands.clone(),
        /// Number of joints of several legs.
        pub shared_joints: usize = r.topology.topology().shared_joints(),
        /// Number of shared joints of the equivalent with the fewest.
        pub fewest_shared_joints: usize = r.fewest_shared,
        /// Number of leg ends in shared joints, minus one for each joint.
        pub merged_ends: usize = r.member.merged_ends(),
        /// Merged ends of the equivalent with the fewest.
        pub fewest_merged_ends: usize = r.fewest_merged,
        /// Reasons against fewer.
        pub obstructions: Vec<Obstruction> = r.obstructions.clone(),
        /// Whether it is equivalent to an octahedral design.
        pub octahedral: bool = octahedral,
        /// Reason why it is not; null: it is.
        pub octahedral_reason: Option<String> = octahedral_reason,
        /// An equivalent octahedral design; null: there is none.
        pub octahedral_design: Option<ExactDesignRecord> = octahedral_design,
        /// Design for which the line was computed.
        pub member: ExactDesignRecord = (&r.member).into(),
        /// Equivalent with the fewest shared joints.
        pub fewest: ExactDesignRecord = (&r.fewest).into(),
    }
    impl From(r: &Rearrangement) {
        let (octahedral, octahedral_reason, octahedral_design) = match &r.octahedral {
            Reduction::Octahedral(design) => (true, None, Some(design.into())),
            Reduction::Not(why) => (false, Some(why.name().to_owned()), None),
        };
        let [base, platform] = r.planar.names().map(str::to_owned);
    }
}

/// Argument for all families of replaceable legs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ArgumentWord {
    /// Joints of the base hold all legs.
    StarsBase,
    /// Joints of the platform hold all legs.
    StarsPlatform,
    /// The supports of the legs.
    Supports,
    /// The curves of two planes.
    Curves,
}

view! {
    /// A family of replaceable legs.
    #[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
    pub struct FamilyRecord {
        /// Kind.
        pub kind: PieceKind = p.kind,
        /// Dimension of the base flat.
        pub base_dimension: usize = p.base_dimension(),
        /// Dimension of the platform flat.
        pub platform_dimension: usize = p.platform_dimension(),
        /// Dimension of the family.
        pub dimension: usize = p.dimension(),
        /// Rank of its leg vectors.
        pub rank: usize = p.rank(),
        /// Whether all its legs share a joint.
        pub common_joint: bool = p.has_common_joint(),
        /// Points that span the base flat, homogeneous coordinates, fractions as text.
        pub base: Vec<[String; 4]> = base,
        /// Points that span the platform flat, homogeneous coordinates, fractions as text.
        pub platform: Vec<[String; 4]> = platform,
        /// Parts of the family.
        pub parts: Vec<usize> = p.parts().to_vec(),
        /// Greatest number of legs.
        pub weight: usize = p.weight(),
    }
    impl From(p: &Piece) {
        let [base, platform] = p.points();
    }
}

view! {
    /// A design with rational joints.
    #[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
    pub struct ExactDesignRecord {
        /// Base joints: [x, y, z], fractions as text.
        pub base: BTreeMap<String, [String; 3]> = joints('A', a.base()),
        /// Platform joints: [x, y, z], fractions as text.
        pub platform: BTreeMap<String, [String; 3]> = joints('B', a.platform()),
        /// Base joint and platform joint by leg.
        pub legs: Vec<[String; 2]> = joint_pairs(&a.legs()),
    }
    impl From(a: &Arrangement) {
        let joints = |letter: char, list: Vec<[String; 3]>| {
            list.into_iter().enumerate().map(|(k, p)| (format!("{letter}{}", k + 1), p)).collect()
        };
    }
}
