//! The predictor of both trackers: the Taylor series of order [`ORDER`] of the path in the (complex) parameter.
//!
//! Its last term sets the step. The ratio of its last two terms bounds the step by the estimated radius of convergence.
//! Timme 2021 uses the same two limits with a Padé predictor.

use pulp::Simd;

use super::lanes::{Lanes, MOST_LANES, PerLane, Vec8, load, norm_sqr, store};
use super::limits::StepLimits;
use super::system::ORDER;

/// The step of every lane towards its goal.
pub(super) struct PredictorStep<S: Simd> {
    /// Difference of the parameters.
    pub(super) dt: Lanes<S>,
    /// Parameter after the step, exactly the goal where it is reached.
    pub(super) t: Lanes<S>,
    /// Part of the way to the goal; 0 in lanes that stay.
    pub(super) fraction: PerLane,
    /// Whether the goal is reached.
    pub(super) reaches: [bool; MOST_LANES],
}

/// The step sizes that the limits allow, times `factor`, for the lanes that are `moving`.
#[inline(always)]
pub(super) fn choose_step<S: Simd>(
    [t, goal]: [Lanes<S>; 2],
    series: &[Vec8<S>; ORDER],
    limits: &StepLimits,
    factor: &PerLane,
    moving: &[bool; MOST_LANES],
) -> PredictorStep<S> {
    let s = t.simd;
    let last = store::<S>(norm_sqr(&series[ORDER - 1]));
    let earlier = store::<S>(norm_sqr(&series[ORDER - 2]));
    let way = goal - t;
    let distance = store::<S>(s.sqrt_f64s(way.norm_sqr()));
    let mut fraction = [0.0; MOST_LANES];
    let mut reaches = [false; MOST_LANES];
    for l in 0..S::F64_LANES {
        if !moving[l] {
            continue;
        }
        let radius = (earlier[l] / last[l]).sqrt();
        let by_error = rough_root(limits.truncation * limits.truncation / last[l]);
        let step = by_error.min(limits.radius_fraction * radius) * factor[l];
        reaches[l] = !(step < distance[l]);
        fraction[l] = if reaches[l] { 1.0 } else { step / distance[l] };
    }
    let dt = way.scale(load(s, &fraction));
    let mask = s.greater_than_f64s(load(s, &reaches.map(f64::from)), s.splat_f64s(0.5));
    PredictorStep { dt, t: (t + dt).select(mask, goal), fraction, reaches }
}

/// The series about `x` at `dt`.
#[inline(always)]
pub(super) fn predicted<S: Simd>(x: &Vec8<S>, series: &[Vec8<S>; ORDER], dt: Lanes<S>) -> Vec8<S> {
    let mut y = *x;
    for p in 0..8 {
        let mut sum = series[ORDER - 1][p];
        for k in (0..ORDER - 1).rev() {
            sum = series[k][p].mul_add(sum, dt);
        }
        y[p] = y[p].mul_add(sum, dt);
    }
    y
}

/// `x^(1 / (2 ORDER))` to six percent. The exponent field of a double is its logarithm, accurate enough for a step size
/// and far faster than `powf` in every lane.
#[inline(always)]
fn rough_root(x: f64) -> f64 {
    const ONE: i64 = 0x3ff0_0000_0000_0000;
    const DEGREE: i64 = 2 * ORDER.cast_signed() as i64;
    let bits = x.to_bits().cast_signed() - ONE;
    f64::from_bits((bits / DEGREE + ONE).cast_unsigned())
}
