//! A design of five legs.

use super::{Violation, Warning};
use platform::pentapod::Pentapod;

/// The contents of a design file with five legs.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct FiveLegs {
    /// The name.
    pub name: String,
    /// The label of the length unit.
    pub units: String,
    /// The source of the numbers.
    pub source: Option<String>,
    /// Free text.
    pub description: Option<String>,
    /// Leg lengths in leg order.
    pub lengths: Option<[f64; 5]>,
    /// The ends of the legs.
    pub pentapod: Pentapod,
    /// The base joint and the platform joint of each leg.
    pub leg_names: [[String; 2]; 5],
    /// Whether a joint is not a fraction and was rounded to its nearest doubles.
    pub rounded: bool,
}

/// A design of five legs with its warnings, or all violations of its text.
pub type FiveLegsOrViolations = Result<(FiveLegs, Vec<Warning>), Vec<Violation>>;
