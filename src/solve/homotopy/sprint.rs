//! The fast tracker for generic problems: real sections, complex path, one factorisation a step.
//!
//! Start and target are real, the parameter runs from 1 over a random complex corner to 0: the usual gamma trick, but
//! with real coefficients in every product. A step is one Newton correction and the Taylor series from the
//! same factorised matrix: the matrix belongs to the predicted point, a correction away from the point the
//! series starts in, which costs the predictor a relative error of the size of the correction, a per cent at
//! most, where it aims at a per cent anyway. What does not fit is caught by the correction of the
//! next step, and everything is checked at the end: this tracker may fail, it is not trusted.

use num_complex::Complex64;
use pulp::{Arch, Simd, WithSimd};

use super::lanes::{Lanes, MOST_LANES, Matrix8, PerLane, Vec8, load, norm_sqr, store};
use super::lu::{eliminate, substitute};
use super::quadrics::{Forms, Quadrics};
use super::system::{ORDER, SectionHomotopy, derivative_matrix, taylor, values};
use super::tracker::rough_root;

/// Limits of the fast tracker.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pace {
    /// Size of the last Taylor term aimed at.
    pub(super) prediction: f64,
    /// Largest step as a fraction of the estimated radius of convergence.
    pub(super) radius_fraction: f64,
    /// A first correction larger than this rejects the step.
    pub(super) capture: f64,
    /// A correction below this lets the path go on.
    pub(super) accuracy: f64,
    /// Largest ratio of the next correction to this one, estimated from the curvature of the path.
    pub(super) contraction: f64,
    /// Most ticks of a path.
    pub(super) most_ticks: u32,
    /// Below this `|t|` relative to the corner a path is left to the endgame.
    pub(super) endgame_at: f64,
    /// Below this relative `|t|` a path whose `|e|^2` is less than `small_rotation` is left to the endgame, too: the
    /// condition of the equations grows with `|e|^-2`.
    pub(super) infinity_at: f64,
    /// See `infinity_at`.
    pub(super) small_rotation: f64,
}

impl Pace {
    pub(super) const DEFAULT: Self = Self {
        prediction: 3e-3,
        radius_fraction: 0.8,
        capture: 8e-2,
        accuracy: 1e-2,
        contraction: 0.02,
        most_ticks: 200,
        endgame_at: 1e-4,
        infinity_at: 3e-2,
        small_rotation: 1e-5,
    };
}

/// What became of one path.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sprinted {
    /// Last good point, norm one.
    pub(super) x: [Complex64; 8],
    /// Where it stands: `t / corner` on the second leg, `None` when the path broke off.
    pub(super) remaining: Option<f64>,
    /// The point at the corner.
    pub(super) corner: Option<[Complex64; 8]>,
    /// Accepted steps.
    pub(super) steps: u32,
    /// Rejected steps and repeated corrections.
    pub(super) rejections: u32,
    /// Last Newton correction at the end point, after [`Sprint`] has polished it.
    pub(super) correction: f64,
    /// Estimate of the condition number of the derivative matrix at the end point.
    pub(super) condition: f64,
}

/// One problem for the fast tracker.
pub(super) struct Sprint<'a, const F: usize> {
    pub(super) homotopy: &'a SectionHomotopy<f64, F>,
    pub(super) starts: &'a [[Complex64; 8]],
    pub(super) corner: Complex64,
    pub(super) pace: Pace,
}

impl<const F: usize> Sprint<'_, F>
where
    Forms<F>: Quadrics<F>,
{
    /// Runs on the widest vector unit of this machine.
    pub(super) fn run(self) -> Vec<Sprinted> {
        Arch::new().dispatch(self)
    }
}

impl<const F: usize> WithSimd for Sprint<'_, F>
where
    Forms<F>: Quadrics<F>,
{
    type Output = Vec<Sprinted>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<Sprinted> {
        let mut field = Field::new(simd, &self);
        while field.occupant.iter().any(Option::is_some) {
            field.tick(&self);
        }
        let mut out = field.out;
        polish(simd, self.homotopy, &mut out);
        out
    }
}

/// The paths under way.
struct Field<S: Simd> {
    /// Present point, predicted and not yet corrected.
    x: Vec8<S>,
    t: Lanes<S>,
    goal: Lanes<S>,
    /// Last accepted point.
    safe_x: Vec8<S>,
    safe_t: Lanes<S>,
    caution: PerLane,
    /// Size of the last correction of this point, infinite for a fresh prediction.
    last: PerLane,
    occupant: [Option<usize>; MOST_LANES],
    ticks: [u32; MOST_LANES],
    next: usize,
    out: Vec<Sprinted>,
}

fn normalised(x: &[Complex64; 8]) -> [Complex64; 8] {
    let norm = x.iter().map(num_complex::Complex::norm_sqr).sum::<f64>().sqrt();
    x.map(|z| z / norm)
}

#[inline(always)]
fn lane_of<S: Simd>(x: &Vec8<S>, l: usize) -> [Complex64; 8] {
    let mut out = [Complex64::ZERO; 8];
    for (z, lanes) in out.iter_mut().zip(x) {
        *z = lanes.lane(l);
    }
    normalised(&out)
}

impl<S: Simd> Field<S> {
    #[inline(always)]
    fn new<const F: usize>(simd: S, sprint: &Sprint<'_, F>) -> Self {
        let zero = Lanes::zero(simd);
        let mut x = [zero; 8];
        x[0] = Lanes::splat(simd, Complex64::ONE);
        let blank = |x: &[Complex64; 8]| Sprinted {
            x: *x,
            remaining: None,
            corner: None,
            steps: 0,
            rejections: 0,
            correction: f64::INFINITY,
            condition: f64::INFINITY,
        };
        let mut field = Self {
            x,
            t: zero,
            goal: zero,
            safe_x: x,
            safe_t: zero,
            caution: [1.0; MOST_LANES],
            last: [f64::INFINITY; MOST_LANES],
            occupant: [None; MOST_LANES],
            ticks: [0; MOST_LANES],
            next: 0,
            out: sprint.starts.iter().map(blank).collect(),
        };
        for l in 0..S::F64_LANES {
            field.refill(l, sprint);
        }
        field
    }

    #[inline(always)]
    fn refill<const F: usize>(&mut self, l: usize, sprint: &Sprint<'_, F>) {
        self.occupant[l] = (self.next < sprint.starts.len()).then_some(self.next);
        self.next += 1;
        if let Some(index) = self.occupant[l] {
            for (lanes, z) in self.x.iter_mut().zip(&sprint.starts[index]) {
                lanes.set_lane(l, *z);
            }
            self.t.set_lane(l, Complex64::ONE);
            self.goal.set_lane(l, sprint.corner);
            self.caution[l] = 1.0;
            self.last[l] = f64::INFINITY;
            self.ticks[l] = 0;
        }
    }

    /// One correction of every lane, then a step from those that are accurate enough.
    #[inline(always)]
    fn tick<const F: usize>(&mut self, sprint: &Sprint<'_, F>)
    where
        Forms<F>: Quadrics<F>,
    {
        let s = self.t.simd;
        let inverse_norm = s.div_f64s(s.splat_f64s(1.0), s.sqrt_f64s(norm_sqr(&self.x)));
        let mut patch = self.x;
        for p in 0..8 {
            self.x[p] = self.x[p].scale(inverse_norm);
            patch[p] = self.x[p].conj();
        }
        let mut matrix: Matrix8<S> = sprint.homotopy.derivative_at(self.t, &self.x, &patch);
        let mut delta = values(&matrix, &self.x);
        let mut inverse = patch;
        eliminate(&mut matrix, &mut inverse);
        substitute(&matrix, &inverse, &mut delta);
        let size = store::<S>(s.sqrt_f64s(norm_sqr(&delta)));
        for p in 0..8 {
            self.x[p] -= delta[p];
        }
        let series = taylor(sprint.homotopy, self.t, &self.x, |b| substitute(&matrix, &inverse, b));
        // |x_2| / |x_1|^2 measures the curvature that Newton's method has to cope with: the correction after
        // one of size d will be about that times d^2
        let speed = norm_sqr(&series[0]);
        let curvature = store::<S>(s.div_f64s(s.sqrt_f64s(norm_sqr(&series[1])), speed));
        let advance = self.judge(&size, &curvature, sprint);
        self.predict(&series, advance, &sprint.pace);
    }

    /// Accepts, repeats or rejects every lane by its correction; which lanes go on.
    #[inline(always)]
    fn judge<const F: usize>(
        &mut self,
        size: &PerLane,
        curvature: &PerLane,
        sprint: &Sprint<'_, F>,
    ) -> [bool; MOST_LANES] {
        let pace = &sprint.pace;
        let mut advance = [false; MOST_LANES];
        for l in 0..S::F64_LANES {
            let Some(index) = self.occupant[l] else { continue };
            self.ticks[l] += 1;
            let limit = if self.last[l].is_finite() { 0.3 * self.last[l] } else { pace.capture };
            if !(size[l] <= limit.max(1e-12)) || self.ticks[l] > pace.most_ticks {
                self.out[index].rejections += 1;
                let stuck = self.caution[l] < 1e-6 || self.out[index].steps == 0;
                if stuck || self.ticks[l] > pace.most_ticks {
                    self.leave(l, index, sprint);
                    self.refill(l, sprint);
                } else {
                    for p in 0..8 {
                        let z = self.safe_x[p].lane(l);
                        self.x[p].set_lane(l, z);
                    }
                    let t = self.safe_t.lane(l);
                    self.t.set_lane(l, t);
                    self.caution[l] *= 0.35;
                    self.last[l] = f64::INFINITY;
                }
                continue;
            }
            self.last[l] = size[l];
            if size[l] > pace.accuracy || !(size[l] * curvature[l] <= pace.contraction || size[l] < 1e-9) {
                self.out[index].rejections += 1;
                continue;
            }
            self.out[index].steps += 1;
            self.caution[l] = (2.0 * self.caution[l]).min(1.0);
            let (t, goal) = (self.t.lane(l), self.goal.lane(l));
            if t == goal && goal != Complex64::ZERO {
                self.out[index].corner = Some(lane_of(&self.x, l));
                self.goal.set_lane(l, Complex64::ZERO);
            }
            for p in 0..8 {
                let z = self.x[p].lane(l);
                self.safe_x[p].set_lane(l, z);
            }
            self.safe_t.set_lane(l, t);
            let remaining = t.norm() / sprint.corner.norm();
            let towards_infinity =
                remaining < pace.infinity_at && self.rotation_size(l) < pace.small_rotation;
            if self.out[index].corner.is_some() && (remaining < pace.endgame_at || towards_infinity) {
                self.leave(l, index, sprint);
                self.refill(l, sprint);
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
    fn leave<const F: usize>(&mut self, l: usize, index: usize, sprint: &Sprint<'_, F>) {
        let path = &mut self.out[index];
        if path.steps > 0 {
            path.x = lane_of(&self.safe_x, l);
            let t = self.safe_t.lane(l);
            path.remaining = path.corner.map(|_| t.norm() / sprint.corner.norm());
        }
    }

    /// Moves the lanes that advance along their series.
    #[inline(always)]
    fn predict(&mut self, series: &[Vec8<S>; ORDER], advance: [bool; MOST_LANES], pace: &Pace) {
        let s = self.t.simd;
        let last = store::<S>(norm_sqr(&series[ORDER - 1]));
        let earlier = store::<S>(norm_sqr(&series[ORDER - 2]));
        let way = self.goal - self.t;
        let distance = store::<S>(s.sqrt_f64s(way.norm_sqr()));
        let mut fraction = [0.0; MOST_LANES];
        let mut reaches = [0.0; MOST_LANES];
        for l in 0..S::F64_LANES {
            if !advance[l] {
                continue;
            }
            let radius = (earlier[l] / last[l]).sqrt();
            let by_error = rough_root(pace.prediction * pace.prediction / last[l]);
            let step = by_error.min(pace.radius_fraction * radius) * self.caution[l];
            let arrives = !(step < distance[l]);
            fraction[l] = if arrives { 1.0 } else { step / distance[l] };
            reaches[l] = f64::from(arrives);
            self.last[l] = f64::INFINITY;
        }
        let dt = way.scale(load(s, &fraction));
        for p in 0..8 {
            let mut sum = series[ORDER - 1][p];
            for k in (0..ORDER - 1).rev() {
                sum = series[k][p].mul_add(sum, dt);
            }
            // lanes that stay may have meaningless series: 0 times infinity must not reach them
            let moved = self.x[p].mul_add(sum, dt);
            let mask = s.greater_than_f64s(load(s, &fraction), s.splat_f64s(0.0));
            self.x[p] = self.x[p].select(mask, moved);
        }
        let mask = s.greater_than_f64s(load(s, &reaches), s.splat_f64s(0.5));
        self.t = (self.t + dt).select(mask, self.goal);
    }
}

/// Newton's method at the target for all paths that arrived there, and a condition estimate.
#[inline(always)]
fn polish<S: Simd, const F: usize>(simd: S, homotopy: &SectionHomotopy<f64, F>, paths: &mut [Sprinted])
where
    Forms<F>: Quadrics<F>,
{
    let arrived: Vec<usize> = (0..paths.len()).filter(|&i| paths[i].remaining == Some(0.0)).collect();
    let rows = homotopy.rows_at(Lanes::zero(simd));
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
        let mut sizes = [f64::INFINITY; MOST_LANES];
        let mut condition = [f64::INFINITY; MOST_LANES];
        for round in 0..4 {
            let mut matrix = derivative_matrix(&rows, &x, &patch);
            let mut delta = values(&matrix, &x);
            let mut frobenius = simd.splat_f64s(0.0);
            for row in &matrix {
                frobenius = simd.add_f64s(frobenius, norm_sqr(row));
            }
            let mut inverse = patch;
            eliminate(&mut matrix, &mut inverse);
            substitute(&matrix, &inverse, &mut delta);
            sizes = store::<S>(simd.sqrt_f64s(norm_sqr(&delta)));
            for p in 0..8 {
                x[p] -= delta[p];
            }
            if round == 3 {
                let mut probe = [Lanes::splat(simd, Complex64::new(0.25, 0.25)); 8];
                substitute(&matrix, &inverse, &mut probe);
                condition = store::<S>(simd.sqrt_f64s(simd.mul_f64s(norm_sqr(&probe), frobenius)));
            }
        }
        for (l, &index) in batch.iter().enumerate() {
            paths[index].x = lane_of(&x, l);
            paths[index].correction = sizes[l];
            paths[index].condition = condition[l];
        }
    }
}
