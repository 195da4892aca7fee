//! The joints and offsets that fit measurements best: damped Gauss-Newton steps in rounds of fixed weights.

use nalgebra::{DMatrix, DVector, Matrix6};

use super::chi_square::chi_square_quantile;
use super::model::{LegModel, Measurement, Unknowns};
use super::noise::{MeasurementNoise, NoiseSource};
use super::robust::{Distances, Loss, LossUnit, PoseWeight, ScaledLoss};
use super::spectrum::FitSpectrum;

/// Rounds of weights at most; five are usual.
const ROUNDS: usize = 100;
/// Rounds with a convex loss before one that is not.
const CONVEX_ROUNDS: usize = 8;
/// Above this ratio of the median distance to that of the noise, the model is still wrong.
const FAR: f64 = 2.0;
/// Steps in a round at most.
const STEPS: usize = 100;
/// Steps below this share of the size of the machine count as zero.
const SMALLEST_STEP: f64 = 1e-13;
/// Rounds end when the unknowns change by less than this share of the deviation of a length.
const SETTLED: f64 = 1e-6;
/// Residuals below this share of the size of the machine are rounding.
const NOISE_OF_ROUNDING: f64 = 1e-13;

/// The fitting problem.
#[derive(Debug)]
pub(super) struct FitProblem<'a> {
    pub(super) measurements: &'a [Measurement],
    pub(super) unknowns: &'a Unknowns,
    /// Size of the machine, design units.
    pub(super) size: f64,
    /// Noise of the measurements; `None`: the fit estimates it.
    pub(super) noise: Option<MeasurementNoise>,
    pub(super) loss: Loss,
    pub(super) unit: LossUnit,
    /// Greatest accepted standard deviation of a direction, design units; directions above it are unknown.
    pub(super) widest: f64,
}

/// The result of a fit.
#[derive(Debug, Clone)]
pub(super) struct CalibrationFit {
    pub(super) model: LegModel,
    pub(super) noise: MeasurementNoise,
    pub(super) source: NoiseSource,
    pub(super) weights: Vec<PoseWeight>,
    pub(super) converged: bool,
    pub(super) rounds: usize,
    pub(super) steps: usize,
    /// Sum of the losses, or the estimated noise: the less, the better the fit.
    pub(super) merit: f64,
}

impl FitProblem<'_> {
    /// Lower factors of the covariances of all poses.
    pub(super) fn whitening(
        &self,
        model: &LegModel,
        noise: &MeasurementNoise,
        weights: &[PoseWeight],
    ) -> Vec<Matrix6<f64>> {
        let of = |(m, weight): (&Measurement, &PoseWeight)| {
            noise.whitening(&model.pose_sensitivity(&m.pose), weight)
        };
        self.measurements.iter().zip(weights).map(of).collect()
    }

    /// Whitened equations of all poses for a change of the unknowns.
    fn equations(&self, model: &LegModel, lower: &[Matrix6<f64>]) -> (DMatrix<f64>, DVector<f64>) {
        let n = 6 * self.measurements.len();
        let (mut rows, mut right) = (DMatrix::zeros(n, self.unknowns.count()), DVector::zeros(n));
        for (k, (m, lower)) in self.measurements.iter().zip(lower).enumerate() {
            let block = self.block(model, m, lower);
            rows.rows_mut(6 * k, 6).copy_from(&block);
            let whitened = lower.solve_lower_triangular(&model.residual(m)).unwrap_or_default();
            right.fixed_rows_mut::<6>(6 * k).copy_from(&whitened);
        }
        (rows, right)
    }

    /// Whitened equations of one pose.
    pub(super) fn block(&self, model: &LegModel, m: &Measurement, lower: &Matrix6<f64>) -> DMatrix<f64> {
        let sensitivity = model.sensitivity(self.unknowns, &m.pose);
        lower.solve_lower_triangular(&sensitivity).unwrap_or_else(|| DMatrix::zeros(6, self.unknowns.count()))
    }

    /// Spectrum of the whitened equations.
    pub(super) fn spectrum(&self, model: &LegModel, lower: &[Matrix6<f64>]) -> Option<FitSpectrum> {
        let (rows, right) = self.equations(model, lower);
        FitSpectrum::of(rows, right, self.widest)
    }

    /// Sum of squares of whitened residuals.
    fn cost(&self, model: &LegModel, lower: &[Matrix6<f64>]) -> f64 {
        let of = |(m, lower): (&Measurement, &Matrix6<f64>)| {
            lower.solve_lower_triangular(&model.residual(m)).map_or(f64::INFINITY, |r| r.norm_squared())
        };
        self.measurements.iter().zip(lower).map(of).sum()
    }

    /// The least sum of squares with fixed weights near `start` (Levenberg 1944, Marquardt 1963). The damping grows
    /// when the last step gained less than predicted. Unknown directions keep their values. Returns the model, the
    /// number of steps, and whether they converged.
    fn minimise(&self, start: &LegModel, lower: &[Matrix6<f64>], most: usize) -> (LegModel, usize, bool) {
        let (mut model, mut cost) = (start.clone(), self.cost(start, lower));
        let mut damping = 0.0;
        for steps in 1..=most {
            let Some(spectrum) = self.spectrum(&model, lower) else { return (model, steps, false) };
            let top = spectrum.values.iter().copied().fold(0.0, f64::max);
            let full = spectrum.step(0.0).amax();
            if full <= SMALLEST_STEP * self.size {
                return (model, steps, true);
            }
            let mut taken = None;
            while taken.is_none() {
                let step = spectrum.step(damping);
                let next = model.stepped(self.unknowns, &step);
                let (promised, after) = (spectrum.reduction(damping), self.cost(&next, lower));
                let kept = (cost - after) / promised;
                if kept > 1e-4 && after.is_finite() {
                    damping = match kept {
                        kept if kept > 0.75 => damping * 0.1,
                        kept if kept < 0.25 => (damping * 4.0).max(1e-6 * top * top),
                        _ => damping,
                    };
                    damping = if damping < 1e-14 * top * top { 0.0 } else { damping };
                    taken = Some((next, after));
                } else if promised <= 1e-12 * cost || step.amax() <= 10.0 * SMALLEST_STEP * self.size {
                    // the predicted gain is below rounding
                    return (model, steps, true);
                } else if damping > 1e12 * top * top {
                    return (model, steps, false);
                } else {
                    damping = (damping * 4.0).max(1e-6 * top * top);
                }
            }
            if let Some((next, after)) = taken {
                (model, cost) = (next, after);
            }
        }
        (model, most, false)
    }

    /// Rounds of [`minimise`](Self::minimise), each with the covariances, the noise and the weights of the end of the
    /// last one.
    pub(super) fn fit(&self, start: &LegModel) -> CalibrationFit {
        let mut out = CalibrationFit {
            model: start.clone(),
            noise: self.noise.unwrap_or_else(|| MeasurementNoise::assumed(self.size)),
            source: if self.noise.is_some() { NoiseSource::Given } else { NoiseSource::Estimated },
            weights: vec![PoseWeight::FULL; self.measurements.len()],
            converged: false,
            rounds: 0,
            steps: 0,
            merit: f64::INFINITY,
        };
        // gross errors must not lead the first steps to a point from which later steps cannot recover
        if self.loss != Loss::Squares {
            out.weights = self.weights(&out, &out.noise, 1);
        }
        for round in 1..=ROUNDS {
            out.rounds = round;
            let lower = self.whitening(&out.model, &out.noise, &out.weights);
            let before = out.model.values(self.unknowns);
            // weights of a wrong model hold for one step
            let far = self.far(&self.distances(&out.model, &out.noise)).is_some();
            let (model, steps, ended) = self.minimise(&out.model, &lower, if far { 1 } else { STEPS });
            out.steps += steps;
            out.model = model;
            let moved = (out.model.values(self.unknowns) - before).amax();
            let (noise, source) = self.noise_of(&out);
            let weights = self.weights(&out, &noise, round);
            let change = |a: f64, b: f64| (a - b).abs();
            let same_noise = change(noise.length, out.noise.length) <= SETTLED * noise.length
                || noise.length.max(out.noise.length) <= 10.0 * NOISE_OF_ROUNDING * self.size;
            let reweighted = weights.iter().zip(&out.weights).fold(0.0, |most: f64, (a, b)| {
                let legs = a.legs.iter().zip(b.legs).map(|(x, y)| change(*x, y));
                legs.fold(most.max(change(a.pose, b.pose)), f64::max)
            });
            (out.noise, out.source, out.weights) = (noise, source, weights);
            let still = moved <= (SETTLED * noise.length).max(10.0 * SMALLEST_STEP * self.size);
            let final_loss = self.loss != Loss::Tukey || round > CONVEX_ROUNDS;
            if ended && still && same_noise && reweighted <= 1e-5 && final_loss {
                out.converged = true;
                break;
            }
        }
        out.merit = self.merit(&out);
        out
    }

    /// Distances of all measurements with full weights.
    pub(super) fn distances(&self, model: &LegModel, noise: &MeasurementNoise) -> Vec<Distances> {
        let lower = self.whitening(model, noise, &vec![PoseWeight::FULL; self.measurements.len()]);
        self.measurements.iter().zip(&lower).map(|(m, l)| Distances::new(&model.residual(m), l)).collect()
    }

    /// The noise estimated from the residuals where none is given. Robust losses use the median distance; the square
    /// loss uses the sum of squares.
    fn noise_of(&self, fit: &CalibrationFit) -> (MeasurementNoise, NoiseSource) {
        if let Some(noise) = self.noise {
            return (noise, NoiseSource::Given);
        }
        let numbers = 6 * self.measurements.len();
        let lower = self.whitening(&fit.model, &fit.noise, &vec![PoseWeight::FULL; self.measurements.len()]);
        let rank = self.spectrum(&fit.model, &lower).map_or(0, |s| s.rank);
        if numbers <= rank {
            return (fit.noise, NoiseSource::Assumed);
        }
        let freedoms = (numbers - rank) as f64;
        let distances = self.distances(&fit.model, &fit.noise);
        let scale = if self.loss == Loss::Squares {
            (distances.iter().map(|d| d.pose * d.pose).sum::<f64>() / freedoms).sqrt()
        } else {
            self.usual(&distances) * (numbers as f64 / freedoms).sqrt()
        };
        let noise = fit.noise.scaled(scale);
        let least = NOISE_OF_ROUNDING * self.size;
        (MeasurementNoise { length: noise.length.max(least), ..noise }, NoiseSource::Estimated)
    }

    /// The typical distance if it shows that the model is still wrong; `None` also for the square loss, which ignores
    /// gross errors.
    fn far(&self, distances: &[Distances]) -> Option<f64> {
        Some(self.usual(distances)).filter(|usual| self.loss != Loss::Squares && *usual > FAR)
    }

    /// The median distance divided by that of normal errors, over whole poses or single lengths according to the loss
    /// unit. Gross errors of less than half of them hardly change it.
    fn usual(&self, distances: &[Distances]) -> f64 {
        let (mut squares, count): (Vec<f64>, usize) = match self.unit {
            LossUnit::Pose => (distances.iter().map(|d| d.pose * d.pose).collect(), 6),
            LossUnit::Leg => (distances.iter().flat_map(|d| d.legs.map(|x| x * x)).collect(), 1),
        };
        squares.sort_by(f64::total_cmp);
        (squares[squares.len() / 2] / chi_square_quantile(0.5, count)).sqrt()
    }

    /// The weights of the loss, graduated: a convex loss counts distances in the usual one until the model is about
    /// right.
    fn weights(&self, fit: &CalibrationFit, noise: &MeasurementNoise, round: usize) -> Vec<PoseWeight> {
        let distances = self.distances(&fit.model, noise);
        let far = self.far(&distances);
        let loss = match self.loss {
            Loss::Tukey if round <= CONVEX_ROUNDS => Loss::Huber,
            Loss::Cauchy | Loss::Tukey if far.is_some() => Loss::Huber,
            loss => loss,
        };
        let scaled = ScaledLoss::new(loss, self.unit);
        let of = |d: &Distances| PoseWeight::new(&scaled, self.unit, &d.over(far.unwrap_or(1.0)));
        distances.iter().map(of).collect()
    }

    fn merit(&self, fit: &CalibrationFit) -> f64 {
        if self.noise.is_none() {
            return fit.noise.length;
        }
        let scaled = ScaledLoss::new(self.loss, self.unit);
        let of = |d: &Distances| match self.unit {
            LossUnit::Pose => scaled.cost(d.pose),
            LossUnit::Leg => d.legs.iter().map(|x| scaled.cost(*x)).sum(),
        };
        self.distances(&fit.model, &fit.noise).iter().map(of).sum()
    }
}
