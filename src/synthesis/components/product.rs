//! The legs between two flats that are combinations of given legs: bilinear equations `N_r(a, b) = 0`.

use nalgebra::Vector3;

use super::decision::{Decision, Question};
use super::flat::Flat;
use super::form::Form;
use super::spectrum::{Spectrum, unit};
use crate::num::linalg::LinalgError;

/// The span of legs inside the product of two flats, and the equations that cut it out.
///
/// In local homogeneous coordinates `alpha` (base, `i + 1` entries) and `beta` (platform, `j + 1` entries) a leg is
/// `alpha (x) beta`. The span of the legs has rank `k'`; an orthonormal basis of its complement are the
/// `m = (i + 1)(j + 1) - k'` equations.
#[derive(Debug, Clone)]
pub(super) struct Product {
    pub(super) base: Flat,
    pub(super) platform: Flat,
    pub(super) rank: usize,
    /// `equations[r][p (j + 1) + q]`.
    pub(super) equations: Vec<Vec<f64>>,
    pub(super) decision: Decision,
}

impl Product {
    /// Of the legs with these ends (normalised coordinates); the rank is what the tolerance says, or prescribed.
    pub(super) fn new(
        base: Flat,
        platform: Flat,
        ends: &[(Vector3<f64>, Vector3<f64>)],
        prescribed: Option<usize>,
        tolerance: f64,
    ) -> Result<Self, LinalgError> {
        let rows: Vec<Vec<f64>> = ends
            .iter()
            .map(|(a, b)| {
                let (alpha, beta) = (base.local(a), platform.local(b));
                unit(&alpha.iter().flat_map(|x| beta.iter().map(move |y| x * y)).collect::<Vec<f64>>())
            })
            .collect();
        let width = (base.dimension() + 1) * (platform.dimension() + 1);
        let s = Spectrum::of(&rows, width)?;
        let top = s.values.first().copied().unwrap_or(0.0);
        let used = &s.values[..rows.len().min(width)];
        let mut decision = Decision::rank(Question::LegRank, used, top, tolerance);
        if let Some(rank) = prescribed {
            decision = decision.taken(rank);
        }
        let rank = decision.value;
        Ok(Self { base, platform, rank, equations: s.kernel(rank).to_vec(), decision })
    }

    /// The same with the two bodies exchanged.
    pub(super) fn exchanged(&self) -> Self {
        let (i, j) = (self.base.dimension() + 1, self.platform.dimension() + 1);
        let turn = |n: &Vec<f64>| (0..i * j).map(|k| n[(k % i) * j + k / i]).collect();
        Self {
            base: self.platform.clone(),
            platform: self.base.clone(),
            rank: self.rank,
            equations: self.equations.iter().map(turn).collect(),
            decision: self.decision,
        }
    }

    /// `M(alpha)`: `m` rows of `j + 1` entries with `M(alpha) beta = 0` for the legs of the span.
    pub(super) fn matrix(&self, alpha: &[f64]) -> Vec<Vec<f64>> {
        let j = self.platform.dimension() + 1;
        let row = |n: &Vec<f64>| {
            (0..j).map(|q| alpha.iter().enumerate().map(|(p, x)| x * n[p * j + q]).sum()).collect()
        };
        self.equations.iter().map(row).collect()
    }

    /// The spectrum of `M` at the direction of `alpha`.
    pub(super) fn spectrum(&self, alpha: &[f64]) -> Result<Spectrum, LinalgError> {
        Spectrum::of(&self.matrix(&unit(alpha)), self.platform.dimension() + 1)
    }

    /// `M` with linear forms as entries; for a base plane.
    pub(super) fn forms(&self) -> Vec<Vec<Form>> {
        let j = self.platform.dimension() + 1;
        let entry =
            |n: &Vec<f64>, q: usize| Form::linear(&(0..3).map(|p| n[p * j + q]).collect::<Vec<f64>>());
        self.equations.iter().map(|n| (0..j).map(|q| entry(n, q)).collect()).collect()
    }
}
