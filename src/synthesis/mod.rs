//! Leg maps, and the class of platforms equivalent to the octahedral one.
//!
//! Nothing in here solves forward kinematics: `synthesis` and `fk` never import each other, so that
//! agreement of the root sets of two platforms is evidence for the map between them.

mod leg_map;
mod leg_vector;

pub use leg_map::{
    AffineLegMap, LegMapOutcome, LegMapTolerances, NotRealizable, Relation, SingularMap, leg_map,
};
pub use leg_vector::{LegSpan, Normalisation, leg_vector};
