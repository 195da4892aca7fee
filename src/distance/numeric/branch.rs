//! The closure condition along the circle on which one joint turns.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use num_complex::Complex64;

use super::chain::{Chain, Circle, Positions};
use super::number::{Number, Places};
use crate::num::batch::{Batch, LANES};

/// Relative displacement for differences in place of derivatives.
const NUDGE: f64 = 1e-7;
/// Most sweeps of the simultaneous iteration.
const SWEEPS: usize = 12;

/// How often the Gram determinants of the two steps after the turn divide the product of the closures over all orientations.
pub(super) type Exponents = [u32; 2];

/// A chain with lengths, the joints before the turn in place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Branch<'a> {
    pub(super) chain: &'a Chain,
    pub(super) lengths: &'a [Complex64],
    pub(super) fixed: Positions<Complex64>,
    circle: Circle,
    place: usize,
}

/// One choice of orientations at one point of the circle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leaf {
    pub(super) defect: Complex64,
    /// Signed heights of the steps after the turn.
    heights: [Complex64; 2],
    pub(super) at: Positions<Complex64>,
}

impl<'a> Branch<'a> {
    /// `None` when the circle is degenerate.
    pub(super) fn new(
        chain: &'a Chain,
        lengths: &'a [Complex64],
        fixed: &Positions<Complex64>,
    ) -> Option<Self> {
        let turn = chain.turn?;
        let s = turn.distances.map(|d| d.value(lengths));
        let circle = Circle::of(turn.axis.map(|k| &fixed[k]), s)?;
        Some(Self { chain, lengths, fixed: *fixed, circle, place: turn.place })
    }

    #[inline(always)]
    fn start<T: Number>(&self, u: T) -> Positions<T> {
        let mut at = self.fixed.map(|p| p.map(T::constant));
        at[self.place] = self.circle.point(u);
        at
    }

    /// The product of the closures over all orientations and of the powers of the Gram determinants.
    #[inline(always)]
    pub(super) fn product<T: Number>(&self, u: T, e: Exponents) -> T {
        let mut at = self.start(u);
        let one = T::constant(Complex64::ONE);
        let last = |at: &Positions<T>| self.chain.defect(at, self.lengths).unwrap_or(one);
        match self.chain.after[..] {
            [] => last(&at),
            [step] => {
                let places = Chain::places(&step, &at, self.lengths);
                let mut out = power(places.gram, e[0]);
                for q in places.both() {
                    at[step.place] = q;
                    out = out * last(&at);
                }
                out
            }
            [first, second, ..] => {
                let places = Chain::places(&first, &at, self.lengths);
                let mut out = power(places.gram, e[0]);
                for q in places.both() {
                    at[first.place] = q;
                    let next = Chain::places(&second, &at, self.lengths);
                    out = out * power(next.gram, e[1]);
                    for r in next.both() {
                        at[second.place] = r;
                        out = out * last(&at);
                    }
                }
                out
            }
        }
    }

    /// The Gram determinant of the first step after the turn, and the product of those of the second.
    pub(super) fn grams(&self, u: Complex64) -> [Complex64; 2] {
        let mut at = self.start(u);
        let mut out = [Complex64::ONE; 2];
        let Some(first) = self.chain.after.first() else { return out };
        let places = Chain::places(first, &at, self.lengths);
        out[0] = places.gram;
        let Some(second) = self.chain.after.get(1) else { return out };
        for q in places.both() {
            at[first.place] = q;
            out[1] *= Chain::places(second, &at, self.lengths).gram;
        }
        out
    }

    /// The product at many points, on vector units.
    pub(super) fn products(&self, points: &[Complex64], e: Exponents) -> Vec<Complex64> {
        let mut out = Vec::with_capacity(points.len());
        for chunk in points.chunks(LANES) {
            let at = |k: usize| chunk[k.min(chunk.len() - 1)];
            let u = Batch { re: std::array::from_fn(|k| at(k).re), im: std::array::from_fn(|k| at(k).im) };
            let values = pulp::Arch::new().dispatch(Product { branch: self, u, e });
            out.extend((0..chunk.len()).map(|k| values.lane(k)));
        }
        out
    }

    /// Ehrlich-Aberth sweeps on the product itself, of degree `2 degree` in `u` after multiplication by `u^degree`: coefficients lose what is
    /// small beside the largest value on the circle, the product does not.
    pub(super) fn separate(&self, zeros: &mut [Complex64], e: Exponents, degree: usize) {
        for _ in 0..SWEEPS {
            let nudged = zeros.iter().map(|u| u * (1.0 + NUDGE));
            let points: Vec<Complex64> = zeros.iter().copied().chain(nudged).collect();
            let values = self.products(&points, e);
            let mut largest = 0.0_f64;
            for k in 0..zeros.len() {
                let u = zeros[k];
                let growth = (values[zeros.len() + k] / values[k] - 1.0) / NUDGE + degree as f64;
                let others = zeros.iter().enumerate().filter(|(j, _)| *j != k);
                let repulsion: Complex64 = others.map(|(_, v)| (u - v).inv()).filter(|w| w.is_finite()).sum();
                let step = (growth / u - repulsion).inv();
                if step.is_finite() && step.norm_sqr() < 0.25 * u.norm_sqr() {
                    zeros[k] -= step;
                    largest = largest.max(step.norm_sqr() / u.norm_sqr());
                }
            }
            if largest < 1e-16 {
                break;
            }
        }
    }

    /// All choices of orientations at `u`.
    pub(super) fn leaves(&self, u: Complex64) -> Vec<Leaf> {
        let count = 1 << self.chain.after.len();
        (0..count).filter_map(|signs| self.leaf(u, |t, _| (signs >> t) & 1 == 0)).collect()
    }

    /// The choice at `u` that continues `near`.
    fn follow(&self, u: Complex64, near: &Leaf) -> Option<Leaf> {
        self.leaf(u, |t, h| (h - near.heights[t]).norm_sqr() <= (h + near.heights[t]).norm_sqr())
    }

    /// One choice: `upper` says whether a step's height is taken as it is or with the other sign.
    fn leaf(&self, u: Complex64, upper: impl Fn(usize, Complex64) -> bool) -> Option<Leaf> {
        let mut at = self.start(u);
        let mut heights = [Complex64::ZERO; 2];
        for (t, step) in self.chain.after.iter().enumerate() {
            let places: Places<Complex64> = Chain::places(step, &at, self.lengths);
            let up = upper(t, places.height);
            let [above, below] = places.both();
            at[step.place] = if up { above } else { below };
            heights[t] = if up { places.height } else { -places.height };
        }
        let defect = self.chain.defect(&at, self.lengths)?;
        defect.is_finite().then_some(Leaf { defect, heights, at })
    }

    /// Newton's method on the closure of one choice from near a zero; the point and the choice there, and the last relative step.
    pub(super) fn polished(&self, mut u: Complex64, mut leaf: Leaf) -> (Complex64, Leaf, f64) {
        let mut step = f64::INFINITY;
        for _ in 0..6 {
            let nudged = u * (1.0 + NUDGE);
            let Some(other) = self.follow(nudged, &leaf) else { break };
            let slope = (other.defect - leaf.defect) / (nudged - u);
            let change = leaf.defect / slope;
            let size = change.norm() / u.norm();
            // a step that does not shrink is rounding, or no convergence
            if !(size < 0.5 * step && size < 0.2) {
                break;
            }
            let Some(next) = self.follow(u - change, &leaf) else { break };
            (u, leaf, step) = (u - change, next, size);
            if size < 1e-10 {
                break;
            }
        }
        (u, leaf, step)
    }
}

struct Product<'a, 'b> {
    branch: &'b Branch<'a>,
    u: Batch,
    e: Exponents,
}

impl pulp::WithSimd for Product<'_, '_> {
    type Output = Batch;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Batch {
        self.branch.product(self.u, self.e)
    }
}

#[inline(always)]
fn power<T: Number>(z: T, n: u32) -> T {
    let mut out = T::constant(Complex64::ONE);
    for _ in 0..n {
        out = out * z;
    }
    out
}
