//! Predictor-corrector tracking of as many paths at a time as the vector unit has lanes.
//!
//! Predictor: the Taylor series of the [`predictor`](super::predictor) module. Corrector: Newton's method until it has
//! converged. Every lane has its own parameter, goal and step; a lane whose corrector does not contract repeats the
//! step at a fraction.

use num_complex::Complex64;

use pulp::{Scalar, Simd};

use super::lanes::{Lanes, MOST_LANES, PerLane, Vec8, load, norm_sqr, store};
use super::limits::{CORRECTION_RATIO, STEP_GROWTH, STEP_REDUCTION, TrackerLimits};
use super::lu::Lu;
use super::predictor::{choose_step, predicted};
use super::system::{SectionHomotopy, SectionPath, blank_series, derivative_matrix, taylor, values};

/// Paths under way, one per lane.
#[derive(Debug, Clone)]
pub(super) struct PathBatch<S: Simd> {
    pub(super) x: Vec8<S>,
    pub(super) t: Lanes<S>,
    pub(super) goal: Lanes<S>,
    /// Factor on the step that the predictor proposes, below one after a rejection.
    pub(super) step_factor: PerLane,
}

/// The result of one step in each lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct StepReport {
    pub(super) accepted: [bool; MOST_LANES],
    pub(super) arrived: [bool; MOST_LANES],
}

impl<S: Simd> PathBatch<S> {
    pub(super) fn new(simd: S) -> Self {
        let zero = Lanes::zero(simd);
        let mut x = [zero; 8];
        x[0] = Lanes::splat(simd, Complex64::ONE);
        Self { x, t: zero, goal: zero, step_factor: [1.0; MOST_LANES] }
    }

    pub(super) fn set_lane(&mut self, l: usize, x: &[Complex64; 8], t: Complex64, goal: Complex64) {
        let norm = x.iter().map(num_complex::Complex::norm_sqr).sum::<f64>().sqrt();
        for (lanes, z) in self.x.iter_mut().zip(x) {
            lanes.set_lane(l, z / norm);
        }
        self.t.set_lane(l, t);
        self.goal.set_lane(l, goal);
        self.step_factor[l] = 1.0;
    }

    /// The point in lane `l`, norm one.
    pub(super) fn lane(&self, l: usize) -> [Complex64; 8] {
        let x = self.x.map(|z| z.lane(l));
        let norm = x.iter().map(num_complex::Complex::norm_sqr).sum::<f64>().sqrt();
        x.map(|z| z / norm)
    }

    /// The patch that keeps `x` at norm one: `v = conj(x) / |x|^2`, after normalising `x`.
    #[inline(always)]
    fn normalise(&mut self) -> Vec8<S> {
        let s = self.t.simd;
        let inverse = s.div_f64s(s.splat_f64s(1.0), s.sqrt_f64s(norm_sqr(&self.x)));
        self.x = self.x.map(|z| z.scale(inverse));
        self.x.map(Lanes::conj)
    }

    /// One step of every lane towards its goal.
    #[inline(always)]
    pub(super) fn step(&mut self, homotopy: &SectionHomotopy, limits: &TrackerLimits) -> StepReport {
        let s = self.t.simd;
        let patch = self.normalise();
        let mut matrix = [patch; 8];
        homotopy.derivative_at(self.t, &self.x, &patch, &mut matrix);
        let lu = Lu::factorise(matrix);
        let mut series = blank_series(s);
        taylor(homotopy, self.t, &self.x, &mut series, |b| *b = lu.solve(*b));
        let ends = [self.t, self.goal];
        let step = choose_step(ends, &series, &limits.step, &self.step_factor, &[true; MOST_LANES]);
        let mut y = predicted(&self.x, &series, step.dt);
        let accepted = correct(homotopy, limits, step.t, &patch, &mut y);
        let mask = s.greater_than_f64s(load(s, &accepted.map(f64::from)), s.splat_f64s(0.5));
        for p in 0..8 {
            self.x[p] = self.x[p].select(mask, y[p]);
        }
        self.t = self.t.select(mask, step.t);
        for l in 0..S::F64_LANES {
            let grown = (STEP_GROWTH * self.step_factor[l]).min(1.0);
            self.step_factor[l] = if accepted[l] { grown } else { STEP_REDUCTION * self.step_factor[l] };
        }
        let arrived = std::array::from_fn(|l| accepted[l] && step.reaches[l]);
        StepReport { accepted, arrived }
    }
}

/// Newton's method at `t` on the patch; which lanes converged.
#[inline(always)]
fn correct<S: Simd>(
    homotopy: &SectionHomotopy,
    limits: &TrackerLimits,
    t: Lanes<S>,
    patch: &Vec8<S>,
    y: &mut Vec8<S>,
) -> [bool; MOST_LANES] {
    let rows = homotopy.rows_at(t);
    let mut good = [false; MOST_LANES];
    let mut bad = [false; MOST_LANES];
    let mut previous = [limits.step.first_correction; MOST_LANES];
    for _ in 0..limits.corrections {
        let j = derivative_matrix(&rows, y, patch);
        let f = values(&j, y);
        let delta = Lu::factorise(j).solve(f);
        for p in 0..8 {
            y[p] -= delta[p];
        }
        let size = store::<S>(norm_sqr(&delta)).map(f64::sqrt);
        for l in 0..S::F64_LANES {
            // NaN counts as bad
            bad[l] |= !good[l] && !(size[l] <= previous[l]);
            good[l] |= !bad[l] && size[l] <= limits.step.accuracy;
            previous[l] = CORRECTION_RATIO * size[l];
        }
        if (0..S::F64_LANES).all(|l| good[l] || bad[l]) {
            break;
        }
    }
    good
}

/// A path that was tracked towards its goal.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tracked {
    /// Homogeneous solution at `t`, norm one.
    pub x: [Complex64; 8],
    /// The parameter value that the path has reached.
    pub t: Complex64,
    /// Whether `t` is the goal.
    pub(crate) arrived: bool,
    /// Accepted steps.
    pub steps: u32,
    /// Rejected steps.
    pub rejections: u32,
}

/// Tracks every start from `t = 1` to 0, a lane each. A path that has not arrived when `|t|` falls below `endgame_at`
/// is left there for the endgame, as is one that runs out of steps.
#[inline(always)]
pub(super) fn track_lanes<S: Simd>(
    simd: S,
    homotopy: &SectionHomotopy,
    starts: &[[Complex64; 8]],
    limits: &TrackerLimits,
    endgame_at: f64,
) -> Vec<Tracked> {
    let blank =
        |x: &[Complex64; 8]| Tracked { x: *x, t: Complex64::ONE, arrived: false, steps: 0, rejections: 0 };
    let mut out: Vec<Tracked> = starts.iter().map(blank).collect();
    let mut batch = PathBatch::new(simd);
    let mut path_of_lane: [Option<usize>; MOST_LANES] = [None; MOST_LANES];
    let mut next = 0;
    for l in 0..S::F64_LANES {
        refill(&mut batch, &mut path_of_lane, l, &mut next, starts);
    }
    while path_of_lane.iter().any(Option::is_some) {
        let report = batch.step(homotopy, limits);
        for l in 0..S::F64_LANES {
            let Some(index) = path_of_lane[l] else { continue };
            let path = &mut out[index];
            if report.accepted[l] {
                path.steps += 1;
            } else {
                path.rejections += 1;
            }
            let t = batch.t.lane(l);
            let spent = path.steps + path.rejections >= limits.most_steps;
            if report.arrived[l] || t.norm() < endgame_at || spent {
                path.x = batch.lane(l);
                path.t = t;
                path.arrived = report.arrived[l];
                refill(&mut batch, &mut path_of_lane, l, &mut next, starts);
            }
        }
    }
    out
}

fn refill<S: Simd>(
    batch: &mut PathBatch<S>,
    path_of_lane: &mut [Option<usize>; MOST_LANES],
    l: usize,
    next: &mut usize,
    starts: &[[Complex64; 8]],
) {
    path_of_lane[l] = (*next < starts.len()).then_some(*next);
    if let Some(index) = path_of_lane[l] {
        batch.set_lane(l, &starts[index], Complex64::ONE, Complex64::ZERO);
        *next += 1;
    }
}

/// Tracks one solution from `t` to `goal` along the straight line; `None` when it takes more than
/// `most_steps` steps.
pub(crate) fn track_one(
    homotopy: &SectionHomotopy,
    x: &[Complex64; 8],
    t: Complex64,
    goal: Complex64,
    limits: &TrackerLimits,
) -> Option<[Complex64; 8]> {
    let mut batch = PathBatch::new(Scalar::new());
    batch.set_lane(0, x, t, goal);
    for _ in 0..limits.most_steps {
        if batch.step(homotopy, limits).arrived[0] {
            return Some(batch.lane(0));
        }
    }
    None
}
