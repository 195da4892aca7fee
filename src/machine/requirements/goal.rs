//! Variables and objectives of the search for the best platform, by their names in design files.

use super::Quantity;

num::words! {
    /// A kind of variable, by its name in design files.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
    #[non_exhaustive]
    pub enum VariableKind: word(code), ALL {
        /// The six offsets of an octahedral design.
        Offsets = "offsets",
        /// One offset for the three edges of the base and one for those of the platform.
        SymmetricOffsets = "symmetric_offsets",
        /// A factor for each triangle, or for base and platform of a design that is not octahedral.
        TriangleSizes = "triangle_sizes",
        /// Shapes and sizes of the triangles.
        Triangles = "triangles",
        /// Height of home.
        HomeHeight = "home_height",
        /// Axes of all joints with a limit of the joint angle.
        JointAxes = "joint_axes",
        /// Parameters of the rational families of replaceable legs of any design.
        Components = "components",
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

num::words! {
    /// The symmetry that a search keeps, by its name in design files.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum KeptSymmetry: word(code), ALL {
        /// Every leg may differ.
        #[default]
        None = "none",
        /// Three-fold rotations about the common axis of base and platform at home: at most two kinds of leg.
        ThreeFold = "three_fold",
        /// A mirror plane through a vertex of each triangle.
        Mirror = "mirror",
    }
}

num::words! {
    /// A figure of merit; `docs/theory/dimensional-synthesis.md` has the formulas.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
    #[cfg_attr(
        feature = "serde",
        derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
        serde(rename_all = "snake_case")
    )]
    pub enum Objective: word(code), ALL {
        /// Least `sigma_6 / sigma_1` over the poses; maximised.
        WorstConditioning = "worst_conditioning",
        /// Mean of `sigma_6 / sigma_1` over the sample; maximised.
        MeanConditioning = "mean_conditioning",
        /// Least `sigma_6` over the poses; maximised.
        SmallestSingularValue = "smallest_singular_value",
        /// Greatest push or pull of a leg over poses and loads; minimised.
        LegForce = "leg_force",
        /// Least distance of two joint centres of a body; maximised.
        JointSpacing = "joint_spacing",
        /// Least gap of two legs over the poses; maximised.
        LegClearance = "leg_clearance",
        /// Greatest minus least leg length over all legs and poses; minimised.
        Stroke = "stroke",
        /// Least eigenvalue of `k J^T J` over the poses; maximised.
        Stiffness = "stiffness",
        /// Lowest natural frequency over the poses; maximised.
        NaturalFrequency = "natural_frequency",
        /// Distance from architectural singularity, the smallest singular value of the leg vectors; maximised.
        SingularityDistance = "singularity_distance",
    }
}

impl Objective {
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
