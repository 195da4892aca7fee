//! The best equivalent rearrangement of the legs of a topology, with its proof.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Serialize;

use super::topologies::joint_pairs;
use platform::manipulator::Body;
use synthesis::rearrangement::{
    Argument, Arrangement, Obstruction, Piece, PieceKind, Rearrangement, Reduction,
};

/// One line of the table of rearrangements.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct RearrangementRecord {
    /// The identifier of the topology, T01 to T34.
    pub id: String,
    /// Name of the topology: numbers of base and platform joints.
    pub name: String,
    /// The arrangement of the base joints: in space or in a plane.
    #[schemars(extend("enum" = ["space", "plane"]))]
    pub base: String,
    /// The arrangement of the platform joints: in space or in a plane.
    #[schemars(extend("enum" = ["space", "plane"]))]
    pub platform: String,
    /// Argument for all families of replaceable legs.
    pub argument: ArgumentWord,
    /// The families of replaceable legs.
    pub families: Vec<FamilyRecord>,
    /// The names of the families.
    pub family_names: String,
    /// Dimensions of the span's summands.
    pub summands: Vec<usize>,
    /// Number of joints of several legs.
    pub shared_joints: usize,
    /// Number of shared joints of the equivalent with the fewest.
    pub fewest_shared_joints: usize,
    /// Number of leg ends in shared joints, minus one for each joint.
    pub merged_ends: usize,
    /// Merged ends of the equivalent with the fewest.
    pub fewest_merged_ends: usize,
    /// Reasons against fewer.
    pub obstructions: Vec<Obstruction>,
    /// Whether it is equivalent to an octahedral design.
    pub octahedral: bool,
    /// Reason why it is not; null: it is.
    pub octahedral_reason: Option<String>,
    /// An equivalent octahedral design; null: there is none.
    pub octahedral_design: Option<ExactDesignRecord>,
    /// Design for which the line was computed.
    pub member: ExactDesignRecord,
    /// Equivalent with the fewest shared joints.
    pub fewest: ExactDesignRecord,
}

/// Argument for all families of replaceable legs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
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

impl From<&Rearrangement> for RearrangementRecord {
    fn from(r: &Rearrangement) -> Self {
        let (octahedral, octahedral_reason, octahedral_design) = match &r.octahedral {
            Reduction::Octahedral(design) => (true, None, Some(design.into())),
            Reduction::Not(why) => (false, Some(why.name().to_owned()), None),
        };
        let [base, platform] = r.planar.names().map(str::to_owned);
        Self {
            id: r.topology.id(),
            name: r.topology.name(),
            base,
            platform,
            argument: match r.argument {
                Argument::Stars(Body::Base) => ArgumentWord::StarsBase,
                Argument::Stars(Body::Platform) => ArgumentWord::StarsPlatform,
                Argument::Supports => ArgumentWord::Supports,
                Argument::Curves => ArgumentWord::Curves,
            },
            families: r.families.iter().map(FamilyRecord::from).collect(),
            family_names: r.family_names(),
            summands: r.summands.clone(),
            shared_joints: r.topology.topology().shared_joints(),
            fewest_shared_joints: r.fewest_shared,
            merged_ends: r.member.merged_ends(),
            fewest_merged_ends: r.fewest_merged,
            obstructions: r.obstructions.clone(),
            octahedral,
            octahedral_reason,
            octahedral_design,
            member: (&r.member).into(),
            fewest: (&r.fewest).into(),
        }
    }
}

/// A family of replaceable legs.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct FamilyRecord {
    /// Kind.
    pub kind: PieceKind,
    /// Dimension of the base flat.
    pub base_dimension: usize,
    /// Dimension of the platform flat.
    pub platform_dimension: usize,
    /// Dimension of the family.
    pub dimension: usize,
    /// Rank of its leg vectors.
    pub rank: usize,
    /// Whether all its legs share a joint.
    pub common_joint: bool,
    /// Points that span the base flat, homogeneous coordinates, fractions as text.
    pub base: Vec<[String; 4]>,
    /// Points that span the platform flat, homogeneous coordinates, fractions as text.
    pub platform: Vec<[String; 4]>,
    /// Parts of the family.
    pub parts: Vec<usize>,
    /// Greatest number of legs.
    pub weight: usize,
}

impl From<&Piece> for FamilyRecord {
    fn from(p: &Piece) -> Self {
        let [base, platform] = p.points();
        Self {
            kind: p.kind,
            base_dimension: p.base_dimension(),
            platform_dimension: p.platform_dimension(),
            dimension: p.dimension(),
            rank: p.rank(),
            common_joint: p.has_common_joint(),
            base,
            platform,
            parts: p.parts().to_vec(),
            weight: p.weight(),
        }
    }
}

/// A design with rational joints.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct ExactDesignRecord {
    /// Base joints: [x, y, z], fractions as text.
    pub base: BTreeMap<String, [String; 3]>,
    /// Platform joints: [x, y, z], fractions as text.
    pub platform: BTreeMap<String, [String; 3]>,
    /// Base joint and platform joint by leg.
    pub legs: Vec<[String; 2]>,
}

impl From<&Arrangement> for ExactDesignRecord {
    fn from(a: &Arrangement) -> Self {
        let joints = |letter: char, list: Vec<[String; 3]>| {
            list.into_iter().enumerate().map(|(k, p)| (format!("{letter}{}", k + 1), p)).collect()
        };
        Self {
            base: joints('A', a.base()),
            platform: joints('B', a.platform()),
            legs: joint_pairs(&a.legs()),
        }
    }
}
