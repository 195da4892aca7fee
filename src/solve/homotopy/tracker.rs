//! Predictor-corrector tracking of as many paths at a time as the vector unit has lanes.
//!
//! Predictor: Taylor series of order [`ORDER`] in the (complex) parameter. Its last term
//! sets the step, the ratio of its last two terms bounds it by the estimated radius of convergence
//! (Timme 2021 uses the same two limits with a Pade predictor). Corrector: Newton. Every lane has its own
//! parameter, goal and step; a lane whose corrector does not contract repeats the step at a fraction.

use num_complex::Complex64;

use pulp::{Scalar, Simd};

use super::lanes::{Lanes, MOST_LANES, PerLane, Vec8, load, norm_sqr, store};
use super::lu::Lu;
use super::system::{ORDER, SectionHomotopy, derivative_matrix, taylor, values};

/// Limits of the tracker; dimensionless, since solutions are kept at norm one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TrackerSettings {
    /// Size of the last Taylor term aimed at.
    pub(crate) prediction: f64,
    /// Largest step as a fraction of the estimated radius of convergence.
    pub(crate) radius_fraction: f64,
    /// A first Newton correction larger than this rejects the step.
    pub(crate) capture: f64,
    /// A Newton correction below this ends the corrector.
    pub(crate) accuracy: f64,
    /// Most Newton corrections a step.
    pub(crate) corrections: u32,
    /// Most steps (accepted and rejected) a path.
    pub(crate) most_steps: u32,
}

impl TrackerSettings {
    /// For paths that the fast tracker could not finish, and for making start systems.
    pub(crate) const CAREFUL: Self = Self {
        prediction: 2e-5,
        radius_fraction: 0.4,
        capture: 1e-3,
        accuracy: 1e-9,
        corrections: 3,
        most_steps: 4000,
    };
}

/// Paths under way, one per lane.
#[derive(Debug, Clone)]
pub(super) struct Front<S: Simd> {
    pub(super) x: Vec8<S>,
    pub(super) t: Lanes<S>,
    pub(super) goal: Lanes<S>,
    /// Factor on the next step, below one after a rejection.
    pub(super) caution: PerLane,
}

/// What one step did in each lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct StepReport {
    pub(super) accepted: [bool; MOST_LANES],
    pub(super) arrived: [bool; MOST_LANES],
}

impl<S: Simd> Front<S> {
    pub(super) fn new(simd: S) -> Self {
        let zero = Lanes::zero(simd);
        let mut x = [zero; 8];
        x[0] = Lanes::splat(simd, Complex64::ONE);
        Self { x, t: zero, goal: zero, caution: [1.0; MOST_LANES] }
    }

    pub(super) fn set_lane(&mut self, l: usize, x: &[Complex64; 8], t: Complex64, goal: Complex64) {
        let norm = x.iter().map(num_complex::Complex::norm_sqr).sum::<f64>().sqrt();
        for (lanes, z) in self.x.iter_mut().zip(x) {
            lanes.set_lane(l, z / norm);
        }
        self.t.set_lane(l, t);
        self.goal.set_lane(l, goal);
        self.caution[l] = 1.0;
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
    pub(super) fn step(&mut self, homotopy: &SectionHomotopy, settings: &TrackerSettings) -> StepReport {
        let s = self.t.simd;
        let patch = self.normalise();
        let lu = Lu::factorise(homotopy.derivative_at(self.t, &self.x, &patch));
        let series = taylor(homotopy, self.t, &self.x, |b| *b = lu.solve(*b));
        let (next_t, dt, reaches) = self.choose_step(&series, settings);
        let mut y = self.x;
        for p in 0..8 {
            let mut sum = series[ORDER - 1][p];
            for k in (0..ORDER - 1).rev() {
                sum = series[k][p].mul_add(sum, dt);
            }
            y[p] = y[p].mul_add(sum, dt);
        }
        let accepted = correct(homotopy, settings, next_t, &patch, &mut y);
        let mask = s.greater_than_f64s(load(s, &accepted.map(f64::from)), s.splat_f64s(0.5));
        for p in 0..8 {
            self.x[p] = self.x[p].select(mask, y[p]);
        }
        self.t = self.t.select(mask, next_t);
        for l in 0..S::F64_LANES {
            let grown = (2.0 * self.caution[l]).min(1.0);
            self.caution[l] = if accepted[l] { grown } else { 0.35 * self.caution[l] };
        }
        let arrived = std::array::from_fn(|l| accepted[l] && reaches[l]);
        StepReport { accepted, arrived }
    }

    /// Next parameter, its difference to the present one, and whether it is the goal.
    #[inline(always)]
    fn choose_step(
        &self,
        series: &[Vec8<S>; ORDER],
        settings: &TrackerSettings,
    ) -> (Lanes<S>, Lanes<S>, [bool; MOST_LANES]) {
        let s = self.t.simd;
        let last = store::<S>(norm_sqr(&series[ORDER - 1]));
        let earlier = store::<S>(norm_sqr(&series[ORDER - 2]));
        let way = self.goal - self.t;
        let distance = store::<S>(s.sqrt_f64s(way.norm_sqr()));
        let mut fraction = [1.0; MOST_LANES];
        let mut reaches = [false; MOST_LANES];
        for l in 0..S::F64_LANES {
            let radius = (earlier[l] / last[l]).sqrt();
            let by_error = rough_root(settings.prediction * settings.prediction / last[l]);
            let step = by_error.min(settings.radius_fraction * radius) * self.caution[l];
            reaches[l] = !(step < distance[l]);
            fraction[l] = if reaches[l] { 1.0 } else { step / distance[l] };
        }
        let dt = way.scale(load(s, &fraction));
        let mask = s.greater_than_f64s(load(s, &reaches.map(f64::from)), s.splat_f64s(0.5));
        let next = (self.t + dt).select(mask, self.goal);
        (next, dt, reaches)
    }
}

/// `x^(1 / (2 ORDER))` to six percent: the exponent field of a double is its logarithm, near enough for a
/// step size and far faster than `powf` in every lane.
#[inline(always)]
pub(super) fn rough_root(x: f64) -> f64 {
    const ONE: i64 = 0x3ff0_0000_0000_0000;
    const DEGREE: i64 = 2 * ORDER.cast_signed() as i64;
    let bits = x.to_bits().cast_signed() - ONE;
    f64::from_bits((bits / DEGREE + ONE).cast_unsigned())
}

/// Newton's method at `t` on the patch; which lanes converged.
#[inline(always)]
fn correct<S: Simd>(
    homotopy: &SectionHomotopy,
    settings: &TrackerSettings,
    t: Lanes<S>,
    patch: &Vec8<S>,
    y: &mut Vec8<S>,
) -> [bool; MOST_LANES] {
    let rows = homotopy.rows_at(t);
    let mut good = [false; MOST_LANES];
    let mut bad = [false; MOST_LANES];
    let mut previous = [settings.capture; MOST_LANES];
    for _ in 0..settings.corrections {
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
            good[l] |= !bad[l] && size[l] <= settings.accuracy;
            previous[l] = 0.3 * size[l];
        }
        if (0..S::F64_LANES).all(|l| good[l] || bad[l]) {
            break;
        }
    }
    good
}

/// A path that was tracked towards its goal.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tracked {
    /// Homogeneous solution at `t`, norm one.
    pub(crate) x: [Complex64; 8],
    /// Where it stands.
    pub(crate) t: Complex64,
    /// Whether `t` is the goal.
    pub(crate) arrived: bool,
    /// Accepted steps.
    pub(crate) steps: u32,
    /// Rejected steps.
    pub(crate) rejections: u32,
}

/// Tracks every start from `t = 1` to 0, a lane each; a path that has not arrived when `|t|` falls
/// below `endgame_at` is left there for the endgame, as is one that runs out of steps.
#[inline(always)]
pub(super) fn track_lanes<S: Simd>(
    simd: S,
    homotopy: &SectionHomotopy,
    starts: &[[Complex64; 8]],
    settings: &TrackerSettings,
    endgame_at: f64,
) -> Vec<Tracked> {
    let blank =
        |x: &[Complex64; 8]| Tracked { x: *x, t: Complex64::ONE, arrived: false, steps: 0, rejections: 0 };
    let mut out: Vec<Tracked> = starts.iter().map(blank).collect();
    let mut front = Front::new(simd);
    let mut occupant: [Option<usize>; MOST_LANES] = [None; MOST_LANES];
    let mut next = 0;
    for l in 0..S::F64_LANES {
        refill(&mut front, &mut occupant, l, &mut next, starts);
    }
    while occupant.iter().any(Option::is_some) {
        let report = front.step(homotopy, settings);
        for l in 0..S::F64_LANES {
            let Some(index) = occupant[l] else { continue };
            let path = &mut out[index];
            if report.accepted[l] {
                path.steps += 1;
            } else {
                path.rejections += 1;
            }
            let t = front.t.lane(l);
            let spent = path.steps + path.rejections >= settings.most_steps;
            if report.arrived[l] || t.norm() < endgame_at || spent {
                path.x = front.lane(l);
                path.t = t;
                path.arrived = report.arrived[l];
                refill(&mut front, &mut occupant, l, &mut next, starts);
            }
        }
    }
    out
}

fn refill<S: Simd>(
    front: &mut Front<S>,
    occupant: &mut [Option<usize>; MOST_LANES],
    l: usize,
    next: &mut usize,
    starts: &[[Complex64; 8]],
) {
    occupant[l] = (*next < starts.len()).then_some(*next);
    if let Some(index) = occupant[l] {
        front.set_lane(l, &starts[index], Complex64::ONE, Complex64::ZERO);
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
    settings: &TrackerSettings,
) -> Option<[Complex64; 8]> {
    let mut front = Front::new(Scalar::new());
    front.set_lane(0, x, t, goal);
    for _ in 0..settings.most_steps {
        if front.step(homotopy, settings).arrived[0] {
            return Some(front.lane(0));
        }
    }
    None
}
