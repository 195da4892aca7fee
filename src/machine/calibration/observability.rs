//! Observability: the changes of a machine that the measurements determine, and their accuracy.

use nalgebra::{DVector, Vector3};

use super::model::{Unknown, Unknowns};
use super::spectrum::FitSpectrum;
use platform::manipulator::Body;

/// Parts of a direction that are smaller than this are left out when it is described; the whole has norm 1.
const NAMED: f64 = 1e-3;

/// Shifts that differ by less than this are equal.
const ROUNDED: f64 = 1e-6;

/// The singular values of the identification matrix and the indices derived from them.
///
/// The matrix is that of the whitened residuals, multiplied by the standard deviation of a length. Without noise of the
/// poses it is the derivative of the lengths by the unknowns, without unit. Small values belong to badly determined
/// directions.
#[derive(Debug, Clone, PartialEq)]
pub struct Observability {
    /// Largest first.
    pub singular_values: Vec<f64>,
    /// Directions with a value below this are unknown: their standard deviation exceeds the greatest accepted one, or
    /// rounding hides them.
    pub tolerance: f64,
    /// Values at or above it.
    pub rank: usize,
    /// Poses measured.
    pub poses: usize,
    /// Changes that the measurements do not determine.
    pub unobservable: Vec<UnobservableChange>,
}

impl Observability {
    pub(super) fn new(spectrum: &FitSpectrum, unknowns: &Unknowns, poses: usize, length_noise: f64) -> Self {
        Self {
            singular_values: spectrum.values.iter().map(|s| s * length_noise).collect(),
            tolerance: spectrum.least * length_noise,
            rank: spectrum.rank,
            poses,
            unobservable: spectrum
                .unknown_directions()
                .iter()
                .map(|v| UnobservableChange::new(v, unknowns))
                .collect(),
        }
    }

    fn greatest(&self) -> f64 {
        self.singular_values.first().copied().unwrap_or(0.0)
    }

    fn least(&self) -> f64 {
        self.singular_values.last().copied().unwrap_or(0.0)
    }

    /// `(s_1 .. s_m)^(1/m) / sqrt(n)`, the observability index of `n` poses (Borm, Menq 1991): greatest where the
    /// determinant of the covariance is least.
    #[must_use]
    pub fn volume_index(&self) -> f64 {
        let logs = self.singular_values.iter().map(|s| s.ln()).sum::<f64>();
        (logs / self.singular_values.len() as f64).exp() / (self.poses as f64).sqrt()
    }

    /// `s_m / s_1`, the inverse condition number (Driels, Pathre 1990).
    #[must_use]
    pub fn inverse_condition(&self) -> f64 {
        if self.greatest() > 0.0 { self.least() / self.greatest() } else { 0.0 }
    }

    /// `s_m^2 / s_1`, the noise amplification index (Nahvi, Hollerbach 1996).
    #[must_use]
    pub fn noise_amplification(&self) -> f64 {
        self.least() * self.inverse_condition()
    }

    /// `1 / (1/s_1 + .. + 1/s_m)`, the harmonic index (Sun, Hollerbach 2008).
    #[must_use]
    pub fn harmonic_index(&self) -> f64 {
        1.0 / self.singular_values.iter().map(|s| 1.0 / s).sum::<f64>()
    }
}

/// A change of joints and offsets that changes the measured lengths hardly or not at all: a vector of norm 1 over all
/// unknowns.
#[derive(Debug, Clone, PartialEq)]
pub struct UnobservableChange {
    /// Joints that move, with their shifts in the frame of their body, the farthest first.
    pub joints: Vec<(Body, usize, Vector3<f64>)>,
    /// Legs whose offsets change, each with its change.
    pub offsets: Vec<(usize, f64)>,
}

impl UnobservableChange {
    fn new(direction: &DVector<f64>, unknowns: &Unknowns) -> Self {
        let mut joints: Vec<(Body, usize, Vector3<f64>)> = Vec::new();
        let mut offsets = Vec::new();
        for (value, unknown) in direction.iter().zip(unknowns.list()) {
            match *unknown {
                Unknown::Joint { body, joint, axis } => {
                    if axis == 0 {
                        joints.push((body, joint, Vector3::zeros()));
                    }
                    if let Some((_, _, shift)) = joints.last_mut() {
                        shift[axis] = *value;
                    }
                }
                Unknown::Offset { leg } => offsets.push((leg, *value)),
            }
        }
        joints.retain(|(_, _, shift)| shift.norm() > NAMED);
        offsets.retain(|(_, change)| change.abs() > NAMED);
        // shifts that are equal up to rounding stay in the order of the design
        let size = |shift: &Vector3<f64>| (shift.norm() / ROUNDED).round();
        joints.sort_by(|a, b| size(&b.2).total_cmp(&size(&a.2)));
        Self { joints, offsets }
    }
}
