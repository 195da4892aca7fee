//! Leg lengths and squared leg lengths are different types: leg maps are affine in the squares only.

use super::LegIndex;
use thiserror::Error;

/// Leg lengths `l_1..l_6`, design units, finite and not negative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LegLengths([f64; 6]);

/// Squared leg lengths `s_i = l_i^2`, design units squared, finite and not negative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SquaredLegLengths([f64; 6]);

/// A value that is no leg length.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum InvalidLengths {
    /// NaN or infinite.
    #[error("the length of {leg} is {value}, not a finite number")]
    NotFinite {
        /// The leg.
        leg: LegIndex,
        /// The value given.
        value: f64,
    },
    /// Below zero.
    #[error("the length of {leg} is {value}: lengths cannot be negative")]
    Negative {
        /// The leg.
        leg: LegIndex,
        /// The value given (a squared length where squares were given).
        value: f64,
    },
}

fn validated(values: [f64; 6]) -> Result<[f64; 6], InvalidLengths> {
    for (leg, value) in LegIndex::all().zip(values) {
        if !value.is_finite() {
            return Err(InvalidLengths::NotFinite { leg, value });
        }
        if value < 0.0 {
            return Err(InvalidLengths::Negative { leg, value });
        }
    }
    Ok(values)
}

impl LegLengths {
    /// Checks six lengths.
    ///
    /// # Errors
    /// The first value that is negative or not finite.
    pub fn try_new(lengths: [f64; 6]) -> Result<Self, InvalidLengths> {
        let valid = Self(validated(lengths)?);
        validated(lengths.map(|l| l * l))?; // a length whose square overflows cannot be worked with
        Ok(valid)
    }

    /// The six lengths.
    #[must_use]
    pub fn get(&self) -> [f64; 6] {
        self.0
    }

    /// `s_i = l_i^2`.
    #[must_use]
    pub fn squared(&self) -> SquaredLegLengths {
        SquaredLegLengths(self.0.map(|l| l * l))
    }
}

impl SquaredLegLengths {
    /// Checks six squared lengths.
    ///
    /// # Errors
    /// The first value that is negative or not finite: it is refused, never clamped to zero.
    pub fn try_new(squares: [f64; 6]) -> Result<Self, InvalidLengths> {
        Ok(Self(validated(squares)?))
    }

    /// The six squares.
    #[must_use]
    pub fn get(&self) -> [f64; 6] {
        self.0
    }

    /// `l_i = sqrt(s_i)`.
    #[must_use]
    pub fn lengths(&self) -> LegLengths {
        LegLengths(self.0.map(f64::sqrt))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refuses_negative_and_non_finite_values() {
        let mut l = [1.0; 6];
        l[2] = -0.5;
        assert!(matches!(LegLengths::try_new(l), Err(InvalidLengths::Negative { value, .. }) if value < 0.0));
        l[2] = f64::NAN;
        assert!(LegLengths::try_new(l).is_err());
        l[2] = 1e200;
        assert!(LegLengths::try_new(l).is_err(), "its square is infinite");
        assert!(SquaredLegLengths::try_new([-1e-300, 1.0, 1.0, 1.0, 1.0, 1.0]).is_err());
    }
}
