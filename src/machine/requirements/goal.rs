//! Variables and objectives of the search for the best platform, by their names in design files.

use super::Quantity;

/// A kind of variable, by its name in design files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum VariableKind {
    /// The six offsets of an octahedral design.
    Offsets,
    /// One offset for the three edges of the base and one for those of the platform.
    SymmetricOffsets,
    /// A factor for each triangle, or for base and platform of a design that is not octahedral.
    TriangleSizes,
    /// Shapes and sizes of the triangles.
    Triangles,
    /// Height of home.
    HomeHeight,
    /// Axes of all joints with a limit of the joint angle.
    JointAxes,
    /// Parameters of the rational families of replaceable legs of any design.
    Components,
}

impl VariableKind {
    /// Every kind.
    pub const ALL: [Self; 7] = [
        Self::Offsets,
        Self::SymmetricOffsets,
        Self::TriangleSizes,
        Self::Triangles,
        Self::HomeHeight,
        Self::JointAxes,
        Self::Components,
    ];

    /// The name in design files.
    #[must_use]
    pub fn code(self) -> &'static str {
        match self {
            Self::Offsets => "offsets",
            Self::SymmetricOffsets => "symmetric_offsets",
            Self::TriangleSizes => "triangle_sizes",
            Self::Triangles => "triangles",
            Self::HomeHeight => "home_height",
            Self::JointAxes => "joint_axes",
            Self::Components => "components",
        }
    }
}

/// The result of keeping a symmetry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case"),
    schemars(rename = "SymmetryWord")
)]
pub enum StartSymmetry {
    // the three-fold symmetry of a design that names no symmetry
    /// The answer has it.
    Kept,
    /// The symmetric search found no design that is proved to meet the requirements; the answer comes from a search
    /// without symmetry.
    GivenUp,
}

impl StartSymmetry {
    /// One sentence: the choice made, and the option that turns it off.
    #[must_use]
    pub fn message(self) -> &'static str {
        match self {
            Self::Kept => {
                "three-fold symmetry was kept, because the design has it at home and names none: symmetry = \"none\" in [optimize] searches without it"
            }
            Self::GivenUp => {
                "no platform with the three-fold symmetry of the design was found that is proved to meet the requirements: the search went on without it, as symmetry = \"none\" in [optimize] does at once"
            }
        }
    }
}

/// The symmetry that a search keeps, by its name in design files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum KeptSymmetry {
    /// Every leg may differ.
    #[default]
    None,
    /// Three-fold rotations about the common axis of base and platform at home: at most two kinds of leg.
    ThreeFold,
    /// A mirror plane through a vertex of each triangle.
    Mirror,
}

impl KeptSymmetry {
    /// Every symmetry.
    pub const ALL: [Self; 3] = [Self::None, Self::ThreeFold, Self::Mirror];

    /// The name in design files.
    #[must_use]
    pub fn code(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::ThreeFold => "three_fold",
            Self::Mirror => "mirror",
        }
    }
}

/// A figure of merit; `docs/theory/dimensional-synthesis.md` has the formulas.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum Objective {
    /// Least `sigma_6 / sigma_1` over the poses; maximised.
    WorstConditioning,
    /// Mean of `sigma_6 / sigma_1` over the sample; maximised.
    MeanConditioning,
    /// Least `sigma_6` over the poses; maximised.
    SmallestSingularValue,
    /// Greatest push or pull of a leg over poses and loads; minimised.
    LegForce,
    /// Least distance of two joint centres of a body; maximised.
    JointSpacing,
    /// Least gap of two legs over the poses; maximised.
    LegClearance,
    /// Greatest minus least leg length over all legs and poses; minimised.
    Stroke,
    /// Least eigenvalue of `k J^T J` over the poses; maximised.
    Stiffness,
    /// Lowest natural frequency over the poses; maximised.
    NaturalFrequency,
    /// Distance from architectural singularity, the smallest singular value of the leg vectors; maximised.
    SingularityDistance,
}

impl Objective {
    /// Every objective.
    pub const ALL: [Self; 10] = [
        Self::WorstConditioning,
        Self::MeanConditioning,
        Self::SmallestSingularValue,
        Self::LegForce,
        Self::JointSpacing,
        Self::LegClearance,
        Self::Stroke,
        Self::Stiffness,
        Self::NaturalFrequency,
        Self::SingularityDistance,
    ];

    /// The name in design files.
    #[must_use]
    pub fn code(self) -> &'static str {
        match self {
            Self::WorstConditioning => "worst_conditioning",
            Self::MeanConditioning => "mean_conditioning",
            Self::SmallestSingularValue => "smallest_singular_value",
            Self::LegForce => "leg_force",
            Self::JointSpacing => "joint_spacing",
            Self::LegClearance => "leg_clearance",
            Self::Stroke => "stroke",
            Self::Stiffness => "stiffness",
            Self::NaturalFrequency => "natural_frequency",
            Self::SingularityDistance => "singularity_distance",
        }
    }

    /// The unit of the value; `None` for a pure number.
    #[must_use]
    pub fn quantity(self) -> Option<Quantity> {
        match self {
            Self::LegForce => Some(Quantity::Force),
            Self::JointSpacing | Self::LegClearance | Self::Stroke => Some(Quantity::Length),
            Self::NaturalFrequency => Some(Quantity::Frequency),
            _ => None,
        }
    }

    /// `true` if the objective is minimised.
    #[must_use]
    pub fn is_cost(self) -> bool {
        matches!(self, Self::LegForce | Self::Stroke)
    }
}
