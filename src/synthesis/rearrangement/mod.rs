//! Whether equivalent rearrangement frees each of the topologies of shared joints or makes it octahedral.
//!
//! The replaceable legs of a design are the points of its leg span `L` on the Segre variety. An equivalent
//! rearrangement is a choice of six of them that span `L`. For general members of a topology, with bodies in space or
//! in a plane, exact arithmetic finds the families of replaceable legs. Ranks of unions of families give the least
//! number of shared joints of six legs (Rado's theorem on independent transversals). Theorems and proofs:
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
