//! Predictor-corrector tracking of `L` paths at a time.
//!
//! Predictor: Taylor series of order [`ORDER`](super::system::ORDER) in the (complex) parameter. Its last term
//! sets the step, the ratio of its last two terms bounds it by the estimated radius of convergence
//! (Timme 2021 uses the same two limits with a Pade predictor). Corrector: Newton. Every lane has its own
//! parameter, goal and step; a lane whose corrector does not contract repeats the step at a fraction.

use num_complex::Complex64;

use super::lanes::{Lanes, Lu, Real, Vec8, norm_sqr};
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
    /// For generic problems: long steps, checked afterwards.
    pub(crate) const FAST: Self = Self {
        prediction: 1e-2,
        radius_fraction: 0.8,
        capture: 5e-2,
        accuracy: 1e-5,
        corrections: 3,
        most_steps: 400,
    };
    /// For paths that have to be tracked again: an order of magnitude more careful.
    pub(crate) const CAREFUL: Self = Self {
        prediction: 2e-5,
        radius_fraction: 0.4,
        capture: 1e-3,
        accuracy: 1e-9,
        corrections: 3,
        most_steps: 4000,
    };
}

/// `L` paths under way.
#[derive(Debug, Clone)]
pub(super) struct Front<const L: usize> {
    pub(super) x: Vec8<L>,
    pub(super) t: Lanes<L>,
    pub(super) goal: Lanes<L>,
    /// Factor on the next step, below one after a rejection.
    pub(super) caution: Real<L>,
}

/// What one step did in each lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct StepReport<const L: usize> {
    pub(super) accepted: [bool; L],
    pub(super) arrived: [bool; L],
}

impl<const L: usize> Front<L> {
    pub(super) fn new() -> Self {
        let mut x = [Lanes::ZERO; 8];
        x[0] = Lanes::splat(Complex64::ONE);
        Self { x, t: Lanes::ZERO, goal: Lanes::ZERO, caution: [1.0; L] }
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
    fn normalise(&mut self) -> Vec8<L> {
        let inverse = norm_sqr(&self.x).map(|n| 1.0 / n.sqrt());
        self.x = self.x.map(|z| z.scale(inverse));
        self.x.map(Lanes::conj)
    }

    /// One step of every lane towards its goal.
    #[inline(always)]
    pub(super) fn step(&mut self, homotopy: &SectionHomotopy, settings: &TrackerSettings) -> StepReport<L> {
        let patch = self.normalise();
        let rows = homotopy.rows_at(self.t);
        let lu = Lu::factorise(derivative_matrix(&rows, &self.x, &patch));
        let series = taylor(homotopy, &rows, &lu, &self.x);
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
        for p in 0..8 {
            self.x[p] = self.x[p].select(accepted, y[p]);
        }
        self.t = self.t.select(accepted, next_t);
        for l in 0..L {
            self.caution[l] =
                if accepted[l] { (2.0 * self.caution[l]).min(1.0) } else { self.caution[l] * 0.35 };
        }
        let arrived = std::array::from_fn(|l| accepted[l] && reaches[l]);
        StepReport { accepted, arrived }
    }

    /// Next parameter, its difference to the present one, and whether it is the goal.
    #[inline(always)]
    fn choose_step(
        &self,
        series: &[Vec8<L>; ORDER],
        settings: &TrackerSettings,
    ) -> (Lanes<L>, Lanes<L>, [bool; L]) {
        let last = norm_sqr(&series[ORDER - 1]);
        let earlier = norm_sqr(&series[ORDER - 2]);
        let way = self.goal - self.t;
        let distance = way.norm_sqr().map(f64::sqrt);
        let mut fraction = [1.0; L];
        let mut reaches = [false; L];
        for l in 0..L {
            let radius = (earlier[l] / last[l]).sqrt();
            let by_error = (settings.prediction / last[l].sqrt()).powf(1.0 / ORDER as f64);
            let step = by_error.min(settings.radius_fraction * radius) * self.caution[l];
            reaches[l] = !(step < distance[l]);
            fraction[l] = if reaches[l] { 1.0 } else { step / distance[l] };
        }
        let dt = way.scale(fraction);
        let next = (self.t + dt).select(reaches, self.goal);
        (next, dt, reaches)
    }
}

/// Newton's method at `t` on the patch; which lanes converged.
#[inline(always)]
fn correct<const L: usize>(
    homotopy: &SectionHomotopy,
    settings: &TrackerSettings,
    t: Lanes<L>,
    patch: &Vec8<L>,
    y: &mut Vec8<L>,
) -> [bool; L] {
    let rows = homotopy.rows_at(t);
    let mut good = [false; L];
    let mut bad = [false; L];
    let mut previous = [settings.capture; L];
    for _ in 0..settings.corrections {
        let j = derivative_matrix(&rows, y, patch);
        let f = values(&j, y);
        let delta = Lu::factorise(j).solve(f);
        for p in 0..8 {
            y[p] -= delta[p];
        }
        let size = norm_sqr(&delta).map(f64::sqrt);
        for l in 0..L {
            // NaN counts as bad
            bad[l] |= !good[l] && !(size[l] <= previous[l]);
            good[l] |= !bad[l] && size[l] <= settings.accuracy;
            previous[l] = 0.3 * size[l];
        }
        if (0..L).all(|l| good[l] || bad[l]) {
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

/// Tracks every start from `t = 1` to 0, `L` at a time; a path that has not arrived when `|t|` falls
/// below `endgame_at` is left there for the endgame, as is one that runs out of steps.
pub(crate) fn track_all<const L: usize>(
    homotopy: &SectionHomotopy,
    starts: &[[Complex64; 8]],
    settings: &TrackerSettings,
    endgame_at: f64,
) -> Vec<Tracked> {
    let blank =
        |x: &[Complex64; 8]| Tracked { x: *x, t: Complex64::ONE, arrived: false, steps: 0, rejections: 0 };
    let mut out: Vec<Tracked> = starts.iter().map(blank).collect();
    let mut front = Front::<L>::new();
    let mut occupant: [Option<usize>; L] = [None; L];
    let mut next = 0;
    for l in 0..L {
        refill(&mut front, &mut occupant, l, &mut next, starts);
    }
    while occupant.iter().any(Option::is_some) {
        let report = front.step(homotopy, settings);
        for l in 0..L {
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

fn refill<const L: usize>(
    front: &mut Front<L>,
    occupant: &mut [Option<usize>; L],
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
    let mut front = Front::<1>::new();
    front.set_lane(0, x, t, goal);
    for _ in 0..settings.most_steps {
        if front.step(homotopy, settings).arrived[0] {
            return Some(front.lane(0));
        }
    }
    None
}
