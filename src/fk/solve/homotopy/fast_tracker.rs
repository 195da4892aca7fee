//! The fast tracker for generic problems: real sections, complex path, one factorisation a step.
//!
//! Start and target are real, and the parameter runs from 1 over a random complex corner to 0. This is the usual gamma
//! trick, but with real coefficients in every product. A step is one Newton correction and the Taylor series from the
//! same factorised matrix. That matrix belongs to the predicted point, a correction away from the start of the series.
//! The predictor loses a relative error of the size of the correction, a per cent at most, and it aims at a per cent
//! anyway. The correction of the next step catches a step that does not fit. Everything is checked at the end: this
//! tracker may fail, it is not trusted.

use num_complex::Complex64;
use pulp::{Simd, WithSimd};

use super::lanes::{Lanes, MOST_LANES, Matrix8, PerLane, Vec8, load, norm_sqr, store};
use super::limits::{CORRECTION_RATIO, FastTrackerLimits, STEP_GROWTH, STEP_REDUCTION};
use super::lu::{eliminate, substitute};
use super::predictor::{choose_step, predicted};
use super::quadrics::{QuadraticForms, Quadrics};
use super::system::{SectionPath, Series, blank_series, taylor, values};
use num::vector_unit::on_vector_unit;

/// Ratio of corrections below which they are squared by every step, not shrunk by a constant factor: at a double root
/// that is a half.
const SQUARED: f64 = 1e-2;
/// Largest ratio of the next correction to its estimate.
const MARGIN: f64 = 100.0;

/// Most Newton corrections at the target.
const POLISHES: usize = 4;

/// The result of one path.
#[derive(Debug, Clone, Copy)]
pub(super) struct FastPath {
    /// Last good point, norm one.
    pub(super) x: [Complex64; 8],
    /// Place on the path: the remaining part of the second leg; `None` when the path broke off.
    pub(super) remaining: Option<f64>,
    /// The point at the corner.
    pub(super) corner: Option<[Complex64; 8]>,
    /// Accepted steps.
    pub(super) steps: u32,
    /// Rejected steps and repeated corrections.
    pub(super) rejections: u32,
    /// The next Newton correction at the end point, estimated from the last ones after [`FastTracker`] has polished it.
    /// A single correction is its own estimate.
    pub(super) correction: f64,
    /// Estimate of the condition number of the derivative matrix at the end point.
    pub(super) condition: f64,
}

/// One problem for the fast tracker.
pub(super) struct FastTracker<'a, L, const F: usize> {
    pub(super) homotopy: &'a L,
    pub(super) starts: &'a [[Complex64; 8]],
    /// The parameter at the start, at the corner (again that of the start where the way is straight) and at the end.
    pub(super) way: [Complex64; 3],
    pub(super) limits: FastTrackerLimits,
}

impl<L, const F: usize> FastTracker<'_, L, F> {
    /// The part of the second leg that is left at `t`.
    #[inline(always)]
    fn remaining(&self, t: Complex64) -> f64 {
        let [_, corner, end] = self.way;
        ((t - end).norm_sqr() / (corner - end).norm_sqr()).sqrt()
    }
}

impl<L: SectionPath<F>, const F: usize> FastTracker<'_, L, F>
where
    QuadraticForms<F>: Quadrics<F>,
{
    /// Runs on the widest vector unit of this machine.
    pub(super) fn run(self) -> Vec<FastPath> {
        on_vector_unit(self)
    }
}

impl<L: SectionPath<F>, const F: usize> WithSimd for FastTracker<'_, L, F>
where
    QuadraticForms<F>: Quadrics<F>,
{
    type Output = Vec<FastPath>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<FastPath> {
        let mut batch = FastBatch::new(simd, &self);
        let mut matrix = [[Lanes::zero(simd); 8]; 8];
        let mut series = blank_series(simd);
        while batch.path_of_lane.iter().any(Option::is_some) {
            batch.iterate(&self, &mut matrix, &mut series);
        }
        let mut out = batch.out;
        polish(simd, self.homotopy, self.way[2], self.limits.settled, &mut out);
        out
    }
}

/// The paths under way, one per lane, and the results of all.
struct FastBatch<S: Simd> {
    /// Present point, predicted and not yet corrected.
    x: Vec8<S>,
    t: Lanes<S>,
    goal: Lanes<S>,
    /// Last accepted point.
    accepted_x: Vec8<S>,
    accepted_t: Lanes<S>,
    /// Factor on the step that the predictor proposes, below one after a rejection.
    step_factor: PerLane,
    /// Size of the last correction of this point, infinite for a fresh prediction.
    last: PerLane,
    /// Index of the path in each lane.
    path_of_lane: [Option<usize>; MOST_LANES],
    /// Iterations of that path.
    iterations: [u32; MOST_LANES],
    /// Index of the first path that has not started.
    next: usize,
    out: Vec<FastPath>,
}

fn normalised(x: &[Complex64; 8]) -> [Complex64; 8] {
    let inverse = x.iter().map(num_complex::Complex::norm_sqr).sum::<f64>().sqrt().recip();
    x.map(|z| z * inverse)
}

#[inline(always)]
fn lane_of<S: Simd>(x: &Vec8<S>, l: usize) -> [Complex64; 8] {
    let mut out = [Complex64::ZERO; 8];
    for (z, lanes) in out.iter_mut().zip(x) {
        *z = lanes.lane(l);
    }
    normalised(&out)
}

impl<S: Simd> FastBatch<S> {
    #[inline(always)]
    fn new<L, const F: usize>(simd: S, tracker: &FastTracker<'_, L, F>) -> Self {
        let zero = Lanes::zero(simd);
        let mut x = [zero; 8];
        x[0] = Lanes::splat(simd, Complex64::ONE);
        let blank = |x: &[Complex64; 8]| FastPath {
            x: *x,
            remaining: None,
            corner: None,
            steps: 0,
            rejections: 0,
            correction: f64::INFINITY,
            condition: f64::INFINITY,
        };
        let mut batch = Self {
            x,
            t: zero,
            goal: zero,
            accepted_x: x,
            accepted_t: zero,
            step_factor: [1.0; MOST_LANES],
            last: [f64::INFINITY; MOST_LANES],
            path_of_lane: [None; MOST_LANES],
            iterations: [0; MOST_LANES],
            next: 0,
            out: tracker.starts.iter().map(blank).collect(),
        };
        for l in 0..S::F64_LANES {
            batch.refill(l, tracker);
        }
        batch
    }

    #[inline(always)]
    fn refill<L, const F: usize>(&mut self, l: usize, tracker: &FastTracker<'_, L, F>) {
        self.path_of_lane[l] = (self.next < tracker.starts.len()).then_some(self.next);
        self.next += 1;
        if let Some(index) = self.path_of_lane[l] {
            for (lanes, z) in self.x.iter_mut().zip(&tracker.starts[index]) {
                lanes.set_lane(l, *z);
            }
            self.t.set_lane(l, tracker.way[0]);
            self.goal.set_lane(l, tracker.way[1]);
            self.step_factor[l] = 1.0;
            self.last[l] = f64::INFINITY;
            self.iterations[l] = 0;
        }
    }

    /// One correction of every lane, then a step from those that are accurate enough.
    #[inline(always)]
    fn iterate<L: SectionPath<F>, const F: usize>(
        &mut self,
        tracker: &FastTracker<'_, L, F>,
        matrix: &mut Matrix8<S>,
        series: &mut Series<S>,
    ) where
        QuadraticForms<F>: Quadrics<F>,
    {
        let s = self.t.simd;
        let inverse_norm = s.div_f64s(s.splat_f64s(1.0), s.sqrt_f64s(norm_sqr(&self.x)));
        let mut patch = self.x;
        for p in 0..8 {
            self.x[p] = self.x[p].scale(inverse_norm);
            patch[p] = self.x[p].conj();
        }
        tracker.homotopy.derivative_at(self.t, &self.x, &patch, matrix);
        let mut delta = values(matrix, &self.x);
        let mut inverse = patch;
        eliminate(matrix, &mut inverse);
        substitute(matrix, &inverse, &mut delta);
        let size = store::<S>(s.sqrt_f64s(norm_sqr(&delta)));
        for p in 0..8 {
            self.x[p] -= delta[p];
        }
        taylor(tracker.homotopy, self.t, &self.x, series, |b| substitute(matrix, &inverse, b));
        // |x_2| / |x_1|^2 measures the curvature that Newton's method has to cope with: the correction after
        // one of size d will be about that times d^2
        let speed = norm_sqr(&series[0]);
        let curvature = store::<S>(s.div_f64s(s.sqrt_f64s(norm_sqr(&series[1])), speed));
        let advance = self.accept_or_reject(&size, &curvature, tracker);
        self.predict(series, advance, &tracker.limits);
    }

    /// Accepts, repeats or rejects every lane by its correction; which lanes go on.
    #[inline(always)]
    fn accept_or_reject<L: SectionPath<F>, const F: usize>(
        &mut self,
        size: &PerLane,
        curvature: &PerLane,
        tracker: &FastTracker<'_, L, F>,
    ) -> [bool; MOST_LANES] {
        let limits = &tracker.limits;
        let mut advance = [false; MOST_LANES];
        for l in 0..S::F64_LANES {
            let Some(index) = self.path_of_lane[l] else { continue };
            self.iterations[l] += 1;
            let limit = if self.last[l].is_finite() {
                CORRECTION_RATIO * self.last[l]
            } else {
                limits.step.first_correction
            };
            if !(size[l] <= limit.max(1e-12)) || self.iterations[l] > limits.most_iterations {
                self.out[index].rejections += 1;
                let stuck = self.step_factor[l] < 1e-6 || self.out[index].steps == 0;
                if stuck || self.iterations[l] > limits.most_iterations {
                    self.retire(l, index, tracker);
                    self.refill(l, tracker);
                } else {
                    for p in 0..8 {
                        let z = self.accepted_x[p].lane(l);
                        self.x[p].set_lane(l, z);
                    }
                    let t = self.accepted_t.lane(l);
                    self.t.set_lane(l, t);
                    self.step_factor[l] *= STEP_REDUCTION;
                    self.last[l] = f64::INFINITY;
                }
                continue;
            }
            self.last[l] = size[l];
            if size[l] > limits.step.accuracy
                || !(size[l] * curvature[l] <= limits.contraction || size[l] < 1e-9)
            {
                self.out[index].rejections += 1;
                continue;
            }
            self.out[index].steps += 1;
            self.step_factor[l] = (STEP_GROWTH * self.step_factor[l]).min(1.0);
            let (t, goal) = (self.t.lane(l), self.goal.lane(l));
            if t == goal && self.out[index].corner.is_none() {
                self.out[index].corner = Some(lane_of(&self.x, l));
                self.goal.set_lane(l, tracker.way[2]);
            }
            for p in 0..8 {
                let z = self.x[p].lane(l);
                self.accepted_x[p].set_lane(l, z);
            }
            self.accepted_t.set_lane(l, t);
            let remaining = tracker.remaining(t);
            let towards_infinity =
                remaining < limits.infinity_at && self.rotation_size(l) < limits.small_rotation;
            if self.out[index].corner.is_some() && (remaining < limits.endgame_at || towards_infinity) {
                self.retire(l, index, tracker);
                self.refill(l, tracker);
            } else {
                advance[l] = true;
            }
        }
        advance
    }

    /// `|e|^2` of the present point, which has norm one nearly.
    #[inline(always)]
    fn rotation_size(&self, l: usize) -> f64 {
        self.x[..4].iter().map(|z| z.lane(l).norm_sqr()).sum()
    }

    /// Records the last good point of a path that goes no further.
    #[inline(always)]
    fn retire<L, const F: usize>(&mut self, l: usize, index: usize, tracker: &FastTracker<'_, L, F>) {
        let path = &mut self.out[index];
        if path.steps > 0 {
            path.x = lane_of(&self.accepted_x, l);
            let t = self.accepted_t.lane(l);
            path.remaining = path.corner.map(|_| tracker.remaining(t));
        }
    }

    /// Moves the lanes that advance along their series.
    #[inline(always)]
    fn predict(&mut self, series: &Series<S>, advance: [bool; MOST_LANES], limits: &FastTrackerLimits) {
        let s = self.t.simd;
        let ends = [self.t, self.goal];
        let step = choose_step(ends, series, &limits.step, &self.step_factor, &advance);
        for l in 0..S::F64_LANES {
            if advance[l] {
                self.last[l] = f64::INFINITY;
            }
        }
        // lanes that stay may have meaningless series: 0 times infinity must not reach them
        let moved = predicted(&self.x, series, step.dt);
        let mask = s.greater_than_f64s(load(s, &step.fraction), s.splat_f64s(0.0));
        for p in 0..8 {
            self.x[p] = self.x[p].select(mask, moved[p]);
        }
        self.t = step.t;
    }
}

/// Size of the Newton correction after one of size `this`, which followed one of size `last`. Every step squares them,
/// times a constant that these two show: `d_2 = c d_1^2`, so that the next is `c d_2^2`. Corrections that shrink less
/// fast show rounding or a multiple root; then the next is as long as this one.
#[inline(always)]
fn next_correction(last: f64, this: f64) -> f64 {
    let ratio = this / last;
    if last.is_finite() && ratio < SQUARED { MARGIN * this * ratio * ratio } else { this }
}

/// Newton's method at the target for all paths that arrived there, and a condition estimate.
#[inline(always)]
fn polish<S: Simd, L: SectionPath<F>, const F: usize>(
    simd: S,
    homotopy: &L,
    end: Complex64,
    enough: f64,
    paths: &mut [FastPath],
) where
    QuadraticForms<F>: Quadrics<F>,
{
    let arrived: Vec<usize> = (0..paths.len()).filter(|&i| paths[i].remaining == Some(0.0)).collect();
    let end = Lanes::splat(simd, end);
    let mut matrix = [[Lanes::zero(simd); 8]; 8];
    for batch in arrived.chunks(S::F64_LANES) {
        let mut x = [Lanes::zero(simd); 8];
        for l in 0..S::F64_LANES {
            let point = &paths[batch[l.min(batch.len() - 1)]].x;
            for (lanes, z) in x.iter_mut().zip(point) {
                lanes.set_lane(l, *z);
            }
        }
        let mut patch = x;
        for z in &mut patch {
            *z = z.conj();
        }
        let (mut last, mut next) = ([f64::INFINITY; MOST_LANES], [f64::INFINITY; MOST_LANES]);
        let mut condition = [f64::INFINITY; MOST_LANES];
        for round in 0..POLISHES {
            homotopy.derivative_at(end, &x, &patch, &mut matrix);
            let mut delta = values(&matrix, &x);
            let mut frobenius = simd.splat_f64s(0.0);
            for row in &matrix {
                frobenius = simd.add_f64s(frobenius, norm_sqr(row));
            }
            let mut inverse = patch;
            eliminate(&mut matrix, &mut inverse);
            substitute(&matrix, &inverse, &mut delta);
            let sizes = store::<S>(simd.sqrt_f64s(norm_sqr(&delta)));
            for p in 0..8 {
                x[p] -= delta[p];
            }
            for l in 0..S::F64_LANES {
                next[l] = next_correction(last[l], sizes[l]);
            }
            last = sizes;
            let settled = next[..S::F64_LANES].iter().all(|size| *size < enough);
            if settled || round + 1 == POLISHES {
                let mut probe = [Lanes::splat(simd, Complex64::new(0.25, 0.25)); 8];
                substitute(&matrix, &inverse, &mut probe);
                condition = store::<S>(simd.sqrt_f64s(simd.mul_f64s(norm_sqr(&probe), frobenius)));
                break;
            }
        }
        for (l, &index) in batch.iter().enumerate() {
            paths[index].x = lane_of(&x, l);
            paths[index].correction = next[l];
            paths[index].condition = condition[l];
        }
    }
}
