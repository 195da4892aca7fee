//! What equivalent rearrangement of the legs can do for a topology, with its proof.

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
    /// T01 to T34.
    pub id: String,
    /// Numbers of base and platform joints.
    pub name: String,
    /// Whether the base joints lie in space or in a plane.
    #[schemars(extend("enum" = ["space", "plane"]))]
    pub base: String,
    /// Whether the platform joints do.
    #[schemars(extend("enum" = ["space", "plane"]))]
    pub platform: String,
    /// The argument that finds all families of replaceable legs.
    pub argument: ArgumentWord,
    /// The families of replaceable legs.
    pub families: Vec<FamilyRecord>,
    /// Their names.
    pub family_names: String,
    /// Dimensions of the summands of the span of the legs.
    pub summands: Vec<usize>,
    /// Joints that hold more than one leg.
    pub shared_joints: usize,
    /// The same of the equivalent design that has fewest.
    pub fewest_shared_joints: usize,
    /// Leg ends in shared joints, less one a joint.
    pub merged_ends: usize,
    /// The same of the equivalent design that has fewest.
    pub fewest_merged_ends: usize,
    /// Why there are not fewer.
    pub obstructions: Vec<Obstruction>,
    /// The design is equivalent to an octahedral one.
    pub octahedral: bool,
    /// Why it is not.
    pub octahedral_reason: Option<String>,
    /// An equivalent octahedral design.
    pub octahedral_design: Option<ExactDesignRecord>,
    /// The design the line was computed for.
    pub member: ExactDesignRecord,
    /// The equivalent design with fewest shared joints.
    pub fewest: ExactDesignRecord,
}

/// The argument that finds all families of replaceable legs.
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
    /// Its kind.
    pub kind: PieceKind,
    /// Dimension of its flat of the base.
    pub base_dimension: usize,
    /// Dimension of its flat of the platform.
    pub platform_dimension: usize,
    /// Its dimension.
    pub dimension: usize,
    /// Rank of its legs.
    pub rank: usize,
    /// All its legs have a joint in common.
    pub common_joint: bool,
    /// Points that span its flat of the base, homogeneous, fractions as text.
    pub base: Vec<[String; 4]>,
    /// Points that span its flat of the platform.
    pub platform: Vec<[String; 4]>,
    /// Its parts.
    pub parts: Vec<usize>,
    /// How many legs it can hold.
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
    /// Platform joints.
    pub platform: BTreeMap<String, [String; 3]>,
    /// Base joint and platform joint of each leg.
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
