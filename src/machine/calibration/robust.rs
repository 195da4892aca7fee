//! Losses that grow less than squares, so that gross errors weigh little, and the weights that go with them.

use nalgebra::{Matrix6, Vector6};

use super::chi_square::{chi_square_exceeds, chi_square_quantile};

num::words! {
    /// The loss of a distance.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    #[cfg_attr(
        feature = "serde",
        derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
        serde(rename_all = "snake_case")
    )]
    pub enum Loss as name, FromStr("loss") {
        /// The square of the distance.
        #[default]
        Squares = "squares",
        /// The square up to a threshold, linear beyond (Huber 1964).
        Huber = "huber",
        /// Logarithmic far out.
        Cauchy = "cauchy",
        /// Constant beyond a threshold, so that points there have no weight.
        Tukey = "tukey",
    }
}

impl Loss {
    /// The threshold of a standard normal number that keeps 95 % of the efficiency of least squares (Holland, Welsch
    /// 1977).
    fn threshold(self) -> f64 {
        match self {
            Self::Squares => f64::INFINITY,
            Self::Huber => 1.345,
            Self::Cauchy => 2.385,
            Self::Tukey => 4.685,
        }
    }
}

num::words! {
    /// The unit that a gross error spoils: the whole pose, or a single length.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    #[cfg_attr(
        feature = "serde",
        derive(serde::Serialize, schemars::JsonSchema),
        serde(rename_all = "snake_case")
    )]
    pub enum LossUnit as name {
        /// The Mahalanobis norm of the six residuals of a pose.
        #[default]
        Pose = "pose",
        /// The difference between the residual of a leg and its prediction from the other five, over its standard
        /// deviation.
        Leg = "leg",
    }
}

/// A loss of distances with a given number of degrees of freedom.
#[derive(Debug, Clone, Copy)]
pub(super) struct ScaledLoss {
    loss: Loss,
    threshold: f64,
}

impl ScaledLoss {
    /// Normal errors exceed the threshold as often as that of a single number.
    pub(super) fn new(loss: Loss, unit: LossUnit) -> Self {
        let one = loss.threshold();
        let threshold = match unit {
            _ if one.is_infinite() => one,
            LossUnit::Leg => one,
            LossUnit::Pose => chi_square_quantile(chi_square_exceeds(one * one, 1), 6).sqrt(),
        };
        Self { loss, threshold }
    }

    /// `rho'(x) / 2 x`: 1 for small distances.
    pub(super) fn weight(&self, distance: f64) -> f64 {
        let x = distance / self.threshold;
        let weight = match self.loss {
            Loss::Squares => 1.0,
            Loss::Huber => 1.0 / x.max(1.0),
            Loss::Cauchy => 1.0 / (1.0 + x * x),
            Loss::Tukey => (1.0 - x * x).max(0.0).powi(2),
        };
        weight.max(LEAST_WEIGHT)
    }

    /// `rho(x)`: the square for small distances.
    pub(super) fn cost(&self, distance: f64) -> f64 {
        let (c, x) = (self.threshold, distance / self.threshold);
        match self.loss {
            Loss::Squares => distance * distance,
            Loss::Huber if x <= 1.0 => distance * distance,
            Loss::Huber => c * c * (2.0 * x - 1.0),
            Loss::Cauchy => c * c * (x * x).ln_1p(),
            Loss::Tukey => c * c / 3.0 * (1.0 - (1.0 - x * x).max(0.0).powi(3)),
        }
    }
}

/// Lower limit of weights, which keeps covariances finite.
const LEAST_WEIGHT: f64 = 1e-12;

/// The weights of a pose and of its legs, each from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseWeight {
    /// Weight of the pose.
    pub pose: f64,
    /// Weights of the lengths of its legs.
    pub legs: [f64; 6],
}

impl PoseWeight {
    /// Full weights.
    pub(super) const FULL: Self = Self { pose: 1.0, legs: [1.0; 6] };

    /// The weights for the distances of a measurement.
    pub(super) fn new(loss: &ScaledLoss, unit: LossUnit, distances: &Distances) -> Self {
        match unit {
            LossUnit::Pose => Self { pose: loss.weight(distances.pose), ..Self::FULL },
            LossUnit::Leg => Self { legs: distances.legs.map(|x| loss.weight(x)), ..Self::FULL },
        }
    }
}

/// Distances of a measurement from the model, in standard deviations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Distances {
    /// `sqrt(r^T S^-1 r)`.
    pub(super) pose: f64,
    /// `|S^-1 r|_i / sqrt((S^-1)_ii)`: a normal number of variance 1 for each leg.
    pub(super) legs: [f64; 6],
}

impl Distances {
    /// The distances divided by `unit`.
    pub(super) fn over(&self, unit: f64) -> Self {
        Self { pose: self.pose / unit, legs: self.legs.map(|x| x / unit) }
    }

    /// The distances of residuals whose covariance has this lower factor.
    pub(super) fn new(residual: &Vector6<f64>, lower: &Matrix6<f64>) -> Self {
        let inverse = lower.solve_lower_triangular(&Matrix6::identity()).unwrap_or_else(Matrix6::zeros);
        let whitened = inverse * residual;
        let (back, information) = (inverse.tr_mul(&whitened), inverse.tr_mul(&inverse));
        let leg = |i: usize| back[i].abs() / information[(i, i)].sqrt();
        Self { pose: whitened.norm(), legs: std::array::from_fn(leg) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_the_slopes_of_the_losses() {
        for loss in Loss::ALL {
            for unit in [LossUnit::Pose, LossUnit::Leg] {
                let scaled = ScaledLoss::new(loss, unit);
                for x in [0.1, 0.9, 2.0, 4.0, 7.5, 30.0] {
                    let h = 1e-5;
                    let slope = (scaled.cost(x + h) - scaled.cost(x - h)) / (4.0 * h * x);
                    assert!((slope - scaled.weight(x)).abs() < 1e-6, "{loss:?} {unit:?} {x}");
                }
                assert!((scaled.cost(1e-3) - 1e-6).abs() < 1e-11);
            }
            assert_eq!(loss.name().parse(), Ok(loss));
        }
        assert!("l2".parse::<Loss>().is_err());
    }

    #[test]
    fn a_wrong_leg_is_the_farthest_one_of_its_pose() {
        let sensitivity = Matrix6::from_fn(|i, j| ((3 * i + 5 * j) % 7) as f64 - 3.0);
        let noise = super::super::MeasurementNoise { length: 0.1, position: 1.0, rotation: 0.5 };
        let lower = noise.whitening(&sensitivity, &PoseWeight::FULL);
        let found = Distances::new(&Vector6::ith(3, 2.0), &lower);
        assert!((0..6).all(|i| i == 3 || found.legs[i] < found.legs[3]), "{found:?}");
    }
}
