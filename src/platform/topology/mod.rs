//! The topology of shared joints: the graph of a platform, and the catalogue of all graphs that can hold one.
//!
//! Theory, conditions and list: `docs/theory/topologies.md`. The source is Porta, Thomas (34 topologies); here they are
//! enumerated.

mod catalogue;
mod graph;
mod layout;
mod nesting;
mod search;
mod sequence;

pub use catalogue::{NamedTopology, Recognised, catalogue, recognise};
pub use graph::{AlwaysSingular, Topology};
pub use layout::Layout;
pub use nesting::{Dependence, Nesting, StepDependence};
pub use search::{sequences, triples};
pub use sequence::{JointIndex, Sequence, Step};
