//! Says for each of the topologies whether equivalent rearrangement frees it of shared joints or makes it octahedral.
//!
//! The replaceable legs of a design are the points of its leg span `L` on the Segre variety; an equivalent
//! rearrangement is a choice of six of them that span `L`. For general members of a topology, bodies in space or in a
//! plane, the families of replaceable legs are found in exact arithmetic; how few joints six legs can share follows
//! from ranks of unions of families (Rado's theorem on independent transversals). Theorems and proofs:
//! `docs/theory/rearrangements.md`.

mod octahedral;
mod pieces;
mod sample;
mod table;
#[cfg(test)]
mod tests;

pub use self::pieces::{Piece, PieceKind};
pub use self::sample::Arrangement;
pub use self::table::Obstruction;
pub use octahedral::{NoOctahedralEquivalent, Reduction};
pub use table::{Argument, NotDecided, PlanarBodies, Rearrangement, rearrangement, rearrangements};
