//! What the proofs are about: squared lengths, each any number within a radius of a middle of two doubles.

use crate::manipulator::SquaredLegLengths;
use crate::num::double_double::DoubleDouble;
use crate::num::interval::Interval;

/// Squared leg lengths for a proof, design units squared. Negative numbers and unbounded intervals may be asked about; the latter have no certificates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SquareData {
    pub(super) middle: [DoubleDouble; 6],
    pub(super) radius: [f64; 6],
}

impl From<&SquaredLegLengths> for SquareData {
    fn from(s: &SquaredLegLengths) -> Self {
        Self { middle: s.middle(), radius: s.radius() }
    }
}

impl From<&[Interval; 6]> for SquareData {
    fn from(s: &[Interval; 6]) -> Self {
        let both = s.map(Interval::centre_and_radius);
        Self { middle: both.map(|b| b.0.into()), radius: both.map(|b| b.1) }
    }
}
