//! All zeros of the closure condition of a shared joint, by Ehrlich-Aberth iteration on the function itself, which is
//! known through values and logarithmic derivatives.

use std::f64::consts::TAU;

use num_complex::Complex64;

use super::legs::{HiddenClosure, PosesOfJoint, Scratch};
use num::poly::approximate_roots;

/// Sweeps after which a zero that still moves is left where it is.
const SWEEPS: usize = 30;
/// A step below this, relative to the size of the zero, is the last. The next one would be of the order of its cube.
const SETTLED: f64 = 1e-6;

/// A function with as many zeros as start values are given for: a polynomial, not necessarily by its coefficients.
pub(super) trait RootCondition {
    /// Further results of an evaluation.
    type Evidence;

    /// `p'(z) / p(z)`, infinite or not a number at a zero; `None` where it cannot be computed.
    fn rate(&mut self, z: Complex64) -> Option<(Complex64, Self::Evidence)>;

    /// The size that small zeros are measured by.
    fn floor(&self) -> f64;
}

/// One zero.
#[derive(Debug, Clone)]
pub(super) struct Zero<E> {
    pub(super) at: Complex64,
    /// Evidence of the last evaluation, at the place of the zero before its last step; `None` when that evaluation
    /// failed.
    pub(super) evidence: Option<E>,
    pub(super) settled: bool,
}

/// The zeros, and the number of evaluations.
pub(super) fn zeros<C: RootCondition>(
    condition: &mut C,
    start: &[Complex64],
) -> (Vec<Zero<C::Evidence>>, usize) {
    let new = |z: &Complex64| Zero { at: *z, evidence: None, settled: false };
    let mut zeros: Vec<Zero<C::Evidence>> = start.iter().map(new).collect();
    let mut evaluations = 0;
    for _ in 0..SWEEPS {
        for k in 0..zeros.len() {
            if !zeros[k].settled {
                evaluations += 1;
                step(condition, &mut zeros, k);
            }
        }
        if zeros.iter().all(|z| z.settled) {
            break;
        }
    }
    (zeros, evaluations)
}

fn step<C: RootCondition>(condition: &mut C, zeros: &mut [Zero<C::Evidence>], k: usize) {
    let z = zeros[k].at;
    let size = z.norm().max(condition.floor());
    let Some((rate, evidence)) = condition.rate(z) else {
        // nothing is known here; a little further something may be
        zeros[k].at = z + Complex64::new(1e-3, 7e-4) * size;
        return;
    };
    let others = zeros.iter().enumerate().filter(|(j, _)| *j != k);
    let repulsion: Complex64 = others.map(|(_, o)| (z - o.at).inv()).filter(|q| q.is_finite()).sum();
    let step = (rate - repulsion).inv();
    let zero = &mut zeros[k];
    zero.evidence = Some(evidence);
    if step.is_finite() && step.norm() < 1e3 * size {
        zero.at = z - step;
        zero.settled = step.norm() < SETTLED * size;
    } else {
        // not finite: a zero to the last digit
        zero.settled = !rate.is_finite();
    }
}

/// Further circles on either side.
const CIRCLES: usize = 4;
/// Terms below this part of the largest on their circle say little about the zeros beyond.
const TRUSTED: f64 = 1e-10;
/// Accuracy of start values.
const ROUGH: f64 = 1e-4;
/// Sweeps for them.
const ROUGH_SWEEPS: usize = 60;
/// More points on the circle than coefficients: those beyond the degree are rounding.
const EXTRA: usize = 7;
/// The first point on the circle, so that none is at a symmetry of the design.
const PHASE: f64 = 0.1;

/// Zeros and the cost of finding them.
#[derive(Debug, Clone)]
pub(super) struct FoundZeros {
    pub(super) found: Vec<Zero<PosesOfJoint>>,
    /// Evaluations of the condition.
    pub(super) evaluations: usize,
    /// Largest coefficient beyond the degree over the largest of all: rounding, unless a zero or pole is near the
    /// circle.
    pub(super) excess: f64,
}

/// All zeros, with start values from the interpolated polynomial; `None` when it cannot be interpolated.
pub(super) fn closure_zeros(closure: &HiddenClosure) -> Option<FoundZeros> {
    let half = closure.degree() / 2;
    let mut scratch = Scratch::default();
    let mut on_circle = |radius: f64| Laurent::on_circle(closure, half, radius, &mut scratch);
    let mut laurent = on_circle(1.0)?;
    let excess = laurent.excess;
    let mut circles = 1;
    for outward in [true, false] {
        for _ in 0..CIRCLES {
            let Some(radius) = laurent.doubtful(outward) else { break };
            let Some(further) = on_circle(radius) else { break };
            circles += 1;
            laurent.improve(&further);
        }
    }
    let mut start = approximate_roots(&laurent.coefficients, ROUGH, ROUGH_SWEEPS).ok()?;
    // neighbours on the circle have neighbouring poses
    start.sort_by(|a, b| a.arg().total_cmp(&b.arg()));
    let (found, evaluations) = zeros(&mut OnCircle { closure, half, scratch }, &start);
    Some(FoundZeros { found, evaluations: evaluations + circles * points(half), excess })
}

/// Points on a circle.
fn points(half: usize) -> usize {
    2 * half + 1 + EXTRA
}

/// Coefficients of `w^-half .. w^half`.
#[derive(Debug, Clone)]
struct Laurent {
    coefficients: Vec<Complex64>,
    /// The term of each coefficient over the largest, on the circle it was found on. It is about rounding over the
    /// relative error of the coefficient.
    weight: Vec<f64>,
    excess: f64,
}

impl Laurent {
    /// Interpolates values at equidistant points of a circle.
    fn on_circle(closure: &HiddenClosure, half: usize, radius: f64, scratch: &mut Scratch) -> Option<Self> {
        let count = points(half);
        let turn = |k: usize| TAU * k as f64 / count as f64;
        let value = |k: usize| closure.value(Complex64::from_polar(radius, PHASE + turn(k)), scratch);
        let values: Vec<Complex64> = (0..count).map(value).collect::<Option<_>>()?;
        let roots: Vec<Complex64> = (0..count).map(|k| Complex64::from_polar(1.0, -turn(k))).collect();
        // the term of w^(m - half) at radius, phase 0
        let term = |m: usize| -> Complex64 {
            let shift = (m + count - half) % count;
            let terms = values.iter().enumerate().map(|(k, v)| v * roots[k * shift % count]);
            terms.sum::<Complex64>() / count as f64
        };
        let all: Vec<Complex64> = (0..2 * half + 1 + EXTRA / 2).map(term).collect();
        let (terms, beyond) = all.split_at(2 * half + 1);
        let largest = |list: &[Complex64]| list.iter().map(|z| z.norm()).fold(0.0, f64::max);
        let scale = largest(terms);
        let power = |m: usize| {
            let exponent = half as f64 - m as f64;
            Complex64::from_polar(radius.powf(exponent), PHASE * exponent)
        };
        Some(Self {
            coefficients: terms.iter().enumerate().map(|(m, t)| t * power(m)).collect(),
            weight: terms.iter().map(|t| t.norm() / scale).collect(),
            excess: largest(beyond) / scale,
        })
    }

    /// The modulus of the outermost (innermost) zeros that the coefficients know of, when there are others beyond.
    fn doubtful(&self, outward: bool) -> Option<f64> {
        let count = self.weight.len();
        let at = |k: usize| if outward { count - 1 - k } else { k };
        let known = (0..count).find(|k| self.weight[at(*k)] > TRUSTED)?;
        // a few further in, for the slope
        let inner = (known + 3).min(count - 1);
        if known == 0 || known == inner {
            return None;
        }
        let ratio = self.coefficients[at(inner)].norm() / self.coefficients[at(known)].norm();
        let radius = ratio.powf(1.0 / (inner - known) as f64);
        let radius = if outward { radius } else { radius.recip() };
        (radius.is_finite() && radius > 0.0).then_some(radius)
    }

    /// Takes the coefficients that stand out more in another.
    fn improve(&mut self, other: &Self) {
        for m in 0..self.weight.len() {
            if other.weight[m] > self.weight[m] {
                self.weight[m] = other.weight[m];
                self.coefficients[m] = other.coefficients[m];
            }
        }
    }
}

/// `w^half` times the condition.
struct OnCircle<'a> {
    closure: &'a HiddenClosure,
    half: usize,
    scratch: Scratch,
}

impl RootCondition for OnCircle<'_> {
    type Evidence = PosesOfJoint;

    fn rate(&mut self, w: Complex64) -> Option<(Complex64, PosesOfJoint)> {
        let poses = self.closure.poses(w, &mut self.scratch)?;
        // the angle is -i ln w
        Some(((poses.slope * -Complex64::I + self.half as f64) / w, poses))
    }

    fn floor(&self) -> f64 {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A polynomial by its zeros.
    struct Known(Vec<Complex64>);

    impl RootCondition for Known {
        type Evidence = ();
        fn rate(&mut self, z: Complex64) -> Option<(Complex64, ())> {
            Some((self.0.iter().map(|r| (z - r).inv()).sum(), ()))
        }
        fn floor(&self) -> f64 {
            1.0
        }
    }

    #[test]
    fn all_zeros_are_found_from_anywhere() {
        let known: Vec<Complex64> =
            (-3..=3).map(|k| Complex64::new(f64::from(k), 0.1 * f64::from(k * k))).collect();
        let start: Vec<Complex64> = (0..7).map(|k| Complex64::from_polar(9.0, f64::from(k) + 0.3)).collect();
        let (found, evaluations) = zeros(&mut Known(known.clone()), &start);
        assert!(found.iter().all(|z| z.settled) && evaluations < 7 * SWEEPS);
        for r in known {
            assert_eq!(found.iter().filter(|z| (z.at - r).norm() < 1e-9).count(), 1);
        }
    }
}
