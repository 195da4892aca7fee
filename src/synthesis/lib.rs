//! The platforms equivalent to a given one with the leg maps between them, and the designs that are singular at every
//! pose.
//!
//! The crate uses `num` and `platform`. It does not solve forward kinematics: `synthesis` and `fk` never import each
//! other. Equal root sets of two platforms are therefore independent evidence for the map between them.
//!
//! * [`Family`]: all platforms that are equivalent to an octahedral one.
//! * [`AffineLegMap`]: `s' = A s + c` between the squared lengths of two platforms.
//! * [`Architecture`](singularity::Architecture): whether a design is singular at every pose, and its proof.
//!
//! Legs become vectors with linear relations: equal spans give the map, dependent vectors a singular design.

pub mod alignment;
pub mod components;
mod correspondence;
mod derivation;
mod determinant;
mod dot;
mod drawing;
mod enumerate;
pub(crate) mod exact_map;
mod family;
#[cfg(test)]
#[path = "../platform/manipulator/fixtures.rs"]
mod fixtures;
mod hexagon;
mod leg_map;
mod leg_vector;
mod map_deviation;
mod moves;
mod nearest;
mod pattern;
mod pentapod;
pub mod rearrangement;
pub mod relocate;
pub mod singularity;

pub use correspondence::LegCorrespondence;
pub use derivation::{Derivation, LegSlide};
pub use determinant::{Factor, offset_determinant};
pub use determinant::{determinant_gradient, offset_products};
pub use enumerate::{Symmetry, enumerate, representative};
pub use exact_map::{ExactMap, ExactRelation};
pub use family::{Family, FamilyCounts, FamilyMember, FamilyTopology};
pub use hexagon::{HexagonPoint, JointLabel, Offset, edge_lengths, sliding_body};
pub use hexagon::{HexagonSide, corner, edge, sides};
pub use leg_map::{
    AffineLegMap, ExactNumbers, LegMapOutcome, LegMapTolerances, NotRealizable, Relation, SingularMap,
    leg_map,
};
pub use leg_vector::{LegSpan, Normalisation, leg_vector};
pub use moves::{Move, moves, reachable};
pub(crate) use nearest::hexagon_orders;
pub use nearest::{
    LegEnd, LengthDeviation, NearestOctahedral, NearestOptions, length_deviation, nearest_octahedral,
};
pub use pattern::{InstantiateError, ParsePatternError, Pattern, joint_free};
pub use pentapod::{DecouplingLeg, LineLocus, LinePolynomial, independent_somewhere};
pub use platform::topology::Topology;
