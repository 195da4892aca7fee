//! Leg lengths and squared leg lengths are different types, since leg maps are affine only in the squares.

use super::LegIndex;
use num::double_double::DoubleDouble;
use num::interval::Interval;
use thiserror::Error;

/// Leg lengths `l_1..l_6`, design units, finite and non-negative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LegLengths([f64; 6]);

/// Squared leg lengths `s_i = l_i^2`, design units squared: each within a radius of a centre of two doubles.
///
/// Squares of lengths are exact (the square of a double is the sum of two), and so are squares given as doubles. Images
/// under leg maps have the radius of their rounding. Proofs hold for every choice within the radii. Solvers use the
/// nearest doubles, [`get`](Self::get).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SquaredLegLengths {
    middle: [DoubleDouble; 6],
    radius: [f64; 6],
}

/// A value that is not a leg length.
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
        /// The given value (a squared length if squares were given).
        value: f64,
    },
}

#[inline]
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
    #[inline]
    pub fn try_new(lengths: [f64; 6]) -> Result<Self, InvalidLengths> {
        let valid = Self(validated(lengths)?);
        validated(lengths.map(|l| l * l))?; // a length whose square overflows is unusable
        Ok(valid)
    }

    /// The six lengths.
    #[must_use]
    #[inline]
    pub fn get(&self) -> [f64; 6] {
        self.0
    }

    /// The lengths that legs with these offsets show at these joint distances.
    ///
    /// # Errors
    /// The first sum that is not a length.
    pub fn shown_with(&self, offsets: &[f64; 6]) -> Result<Self, InvalidLengths> {
        Self::try_new(std::array::from_fn(|i| self.0[i] + offsets[i]))
    }

    /// Distances of the joints of legs with these offsets at these shown lengths.
    ///
    /// # Errors
    /// The first difference that is not a length.
    pub fn without(&self, offsets: &[f64; 6]) -> Result<Self, InvalidLengths> {
        Self::try_new(std::array::from_fn(|i| self.0[i] - offsets[i]))
    }

    /// `s_i = l_i^2`, exactly unless a square leaves the range of two doubles.
    #[must_use]
    pub fn squared(&self) -> SquaredLegLengths {
        let mut out = SquaredLegLengths { middle: [DoubleDouble::ZERO; 6], radius: [0.0; 6] };
        for (i, l) in self.0.into_iter().enumerate() {
            let square = l * l;
            // the limits of `two_product`
            if l > 0.0 && !(square >= 2f64.powi(-960) && square <= 2f64.powi(1020)) {
                (out.middle[i], out.radius[i]) = (square.into(), square * f64::EPSILON + f64::MIN_POSITIVE);
            } else {
                out.middle[i] = DoubleDouble::from_product(l, l);
            }
        }
        out
    }
}

impl TryFrom<[f64; 6]> for LegLengths {
    type Error = InvalidLengths;

    fn try_from(lengths: [f64; 6]) -> Result<Self, InvalidLengths> {
        Self::try_new(lengths)
    }
}

impl TryFrom<&[f64; 6]> for LegLengths {
    type Error = InvalidLengths;

    fn try_from(lengths: &[f64; 6]) -> Result<Self, InvalidLengths> {
        Self::try_new(*lengths)
    }
}

impl From<&LegLengths> for LegLengths {
    fn from(lengths: &LegLengths) -> Self {
        *lengths
    }
}

impl SquaredLegLengths {
    /// Checks six squared lengths.
    ///
    /// # Errors
    /// The first value that is negative or not finite; it is never clamped to zero.
    pub fn try_new(squares: [f64; 6]) -> Result<Self, InvalidLengths> {
        Self::try_within(validated(squares)?.map(DoubleDouble::from), [0.0; 6])
    }

    /// Squares within `radius` of `middle`, leg by leg.
    ///
    /// # Errors
    /// The first centre that is negative or not finite, or radius that is negative or NaN. An infinite radius means no
    /// information.
    pub fn try_within(middle: [DoubleDouble; 6], radius: [f64; 6]) -> Result<Self, InvalidLengths> {
        validated(middle.map(DoubleDouble::hi))?;
        for (leg, value) in LegIndex::all().zip(radius) {
            if value.is_nan() {
                return Err(InvalidLengths::NotFinite { leg, value });
            }
            if value < 0.0 {
                return Err(InvalidLengths::Negative { leg, value });
            }
        }
        Ok(Self { middle, radius })
    }

    /// The doubles nearest to the centres.
    #[must_use]
    pub fn get(&self) -> [f64; 6] {
        self.middle.map(DoubleDouble::hi)
    }

    /// The centres, with all their digits.
    #[must_use]
    pub fn middle(&self) -> [DoubleDouble; 6] {
        self.middle
    }

    /// Greatest distance of the squares from the centres; zero for exact ones.
    #[must_use]
    pub fn radius(&self) -> [f64; 6] {
        self.radius
    }

    /// Whether the centres are the squares, without error.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.radius.iter().all(|r| *r <= 0.0)
    }

    /// Small intervals of doubles that contain the squares.
    #[must_use]
    pub fn intervals(&self) -> [Interval; 6] {
        std::array::from_fn(|i| {
            let (hi, blur) = (self.middle[i].hi(), (self.middle[i].lo().abs() + self.radius[i]).next_up());
            if self.radius[i] > 0.0 || self.middle[i].lo().abs() > 0.0 {
                Interval::new((hi - blur).next_down(), (hi + blur).next_up()).unwrap_or(Interval::WHOLE)
            } else {
                Interval::from(hi)
            }
        })
    }

    /// `l_i = sqrt(s_i)`, rounded.
    #[must_use]
    pub fn lengths(&self) -> LegLengths {
        LegLengths(self.get().map(f64::sqrt))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_rational::BigRational;

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
        let middle = [DoubleDouble::ONE; 6];
        assert!(SquaredLegLengths::try_within(middle, [0.0, 0.0, f64::NAN, 0.0, 0.0, 0.0]).is_err());
        assert!(SquaredLegLengths::try_within(middle, [0.0, 0.0, -1.0, 0.0, 0.0, 0.0]).is_err());
    }

    #[test]
    fn squares_of_lengths_are_exact() {
        let exact = |x: f64| BigRational::from_float(x).unwrap();
        let lengths = [0.1, 1.0 / 3.0, 0.0, 1e150, 1e-140, 17.3];
        let s = LegLengths::try_new(lengths).unwrap().squared();
        for (i, l) in lengths.into_iter().enumerate() {
            let middle = s.middle()[i];
            assert_eq!(exact(middle.hi()) + exact(middle.lo()), exact(l) * exact(l));
            assert_eq!(s.radius()[i].to_bits(), 0, "{l}");
            let interval = s.intervals()[i];
            assert!(
                exact(interval.lo()) <= exact(l) * exact(l) && exact(interval.hi()) >= exact(l) * exact(l)
            );
        }
        // beyond the range of two doubles the radius includes the loss
        let s = LegLengths::try_new([1e-170, 1e-160, 1.2e154, 1.0, 1.0, 1.0]).unwrap().squared();
        for (i, l) in [1e-170, 1e-160, 1.2e154].into_iter().enumerate() {
            let gap = exact(s.get()[i]) - exact(l) * exact(l);
            let radius = exact(s.radius()[i]);
            assert!(gap <= radius && -gap <= radius && s.radius()[i] > 0.0);
        }
    }
}
