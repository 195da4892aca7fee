//! The Cauchy endgame: the limit of a path as `t -> 0` when Newton's method cannot tell it.
//!
//! Near `t = 0` a path is a convergent power series in `t^(1/w)`, `w` its winding number. Going round the circle
//! `|t| = r` until the path closes gives `w`. The mean over the `w` turns is the end point (Morgan, Sommese, Wampler
//! 1991). It is exponentially accurate in the number of sample points once no other branch point is inside the circle.
//! The circle is shrunk until two means agree.

use num_complex::Complex64;

use super::limits::{ARC, TrackerLimits};
use super::polish::{PolishedRoot, polish};
use super::system::SectionHomotopy;
use super::tracker::track_one;

/// Samples a turn.
const SAMPLES: usize = 16;
/// Most turns tried.
const MOST_TURNS: u32 = 12;
/// Two means closer than this have converged.
const AGREEMENT: f64 = 1e-7;
/// Two means closer than this are accepted when rounding stops them from getting closer.
const LOOSE_AGREEMENT: f64 = 1e-4;

/// Smallest circle: rounding in `C(t)` is `1e-16`.
const SMALLEST: f64 = 1e-14;

/// The end of a path.
#[derive(Debug, Clone, Copy)]
pub(crate) struct EndPoint {
    /// Homogeneous solution at `t = 0`, norm one.
    pub x: [Complex64; 8],
    /// Winding number.
    pub winding: u32,
    /// Distance of the last two means: the accuracy of `x`.
    pub accuracy: f64,
    /// Half the difference of two roots that a loop of two turns cannot tell from a double one. The roots are at `x`
    /// plus and minus this. It is lost in rounding for a true double root.
    pub split: Option<[Complex64; 8]>,
    /// Newton's method at the target, where the path was followed to it along the real line.
    pub regular: Option<PolishedRoot>,
}

/// Ends the path that stands at `x`, real `t > 0` small. `None` when nothing converges.
pub(crate) fn end_path(homotopy: &SectionHomotopy, x: &[Complex64; 8], t: f64) -> Option<EndPoint> {
    let mut x = *x;
    let mut t = t;
    let mut best: Option<EndPoint> = None;
    let mut previous: Option<[Complex64; 8]> = None;
    for _ in 0..28 {
        let straight = TrackerLimits { most_steps: 12, ..ARC };
        if let Some(end) = track_one(homotopy, &x, t.into(), Complex64::ZERO, &straight) {
            // arriving at a singular end is easy with a loose corrector: only Newton's convergence counts
            let end = polish(homotopy, &end);
            if end.converged {
                return Some(EndPoint {
                    x: end.x,
                    winding: 1,
                    accuracy: 0.0,
                    split: None,
                    regular: Some(end),
                });
            }
        }
        if let Some(Loop { mean, winding, split }) = go_round(homotopy, &x, t) {
            if let Some(earlier) = previous {
                let accuracy = projective_distance(&earlier, &mean);
                if best.is_none_or(|b| accuracy < b.accuracy) {
                    best = Some(EndPoint { x: mean, winding, accuracy, split, regular: None });
                }
                // The mean of two roots still apart converges as that of a double root does, while the branch point
                // between them is inside the circle. So finite ends go on to the smallest circle, where Newton's method
                // from t tells two roots from one; for other ends the split does.
                if accuracy < AGREEMENT && (winding == 1 || !looks_finite(&mean) || t < SMALLEST * 8.0) {
                    return best;
                }
            }
            previous = Some(mean);
        } else {
            previous = None;
        }
        let closer = if nearly_infinite(&x) { t / 2.0 } else { t / 8.0 };
        let Some(y) = track_one(homotopy, &x, t.into(), closer.into(), &ARC) else { break };
        x = y;
        t = closer;
        if t < SMALLEST {
            break;
        }
    }
    best.filter(|b| b.accuracy < LOOSE_AGREEMENT)
}

/// The results of a closed loop about `t = 0`.
struct Loop {
    /// Mean, norm one.
    mean: [Complex64; 8],
    winding: u32,
    split: Option<[Complex64; 8]>,
}

/// Follows the path at radius `t` until it closes.
fn go_round(homotopy: &SectionHomotopy, x: &[Complex64; 8], t: f64) -> Option<Loop> {
    let patch = x.map(|z| z.conj());
    let mut samples: Vec<[Complex64; 8]> = Vec::with_capacity(SAMPLES);
    let mut here = *x;
    let mut spread = 0.0f64;
    let mut parameter = Complex64::new(t, 0.0);
    for turn in 1..=MOST_TURNS {
        for k in 1..=SAMPLES {
            samples.push(patched(&here, &patch)?);
            let angle = std::f64::consts::TAU * (k as f64) / (SAMPLES as f64);
            let goal = if k == SAMPLES { t.into() } else { Complex64::from_polar(t, angle) };
            here = track_one(homotopy, &here, parameter, goal, &ARC)?;
            spread = spread.max(projective_distance(&here, x));
            parameter = goal;
        }
        // a closed loop returns to rounding, another sheet is about as far away as the loop is wide
        if projective_distance(&here, x) < 1e-3 * spread {
            let sum: [Complex64; 8] = std::array::from_fn(|p| samples.iter().map(|y| y[p]).sum());
            let norm = sum.iter().map(num_complex::Complex::norm_sqr).sum::<f64>().sqrt();
            let split = (turn == 2).then(|| split(&samples)).flatten();
            let scale = samples.len() as f64 / norm; // from points on the patch to norm one
            return (scale < 1e3).then(|| Loop {
                mean: sum.map(|z| z / norm),
                winding: turn,
                split: split.map(|h| h.map(|z| z * scale)),
            });
        }
    }
    None
}

/// Whether `e` is so small that circles an eighth as wide may be out of reach: the condition of the Newton matrix grows
/// with `|e|^-2`.
fn nearly_infinite(x: &[Complex64; 8]) -> bool {
    x[..4].iter().map(num_complex::Complex::norm_sqr).sum::<f64>() < 1e-6
}

/// Whether neither `e` nor `e.e` vanishes to the accuracy of a mean.
fn looks_finite(x: &[Complex64; 8]) -> bool {
    let e = &x[..4];
    let size: f64 = e.iter().map(num_complex::Complex::norm_sqr).sum();
    let n: Complex64 = e.iter().map(|z| z * z).sum();
    size > 1e-8 && n.norm() > 1e-4 * size
}

/// Half the difference `h` of two sheets changes its sign at branch points only, so that `h h^T` is analytic in `t`.
/// Its mean over the circle is its value at `t = 0`, whether or not the sheets meet there.
fn split(samples: &[[Complex64; 8]]) -> Option<[Complex64; 8]> {
    let half: Vec<[Complex64; 8]> = (0..SAMPLES)
        .map(|k| std::array::from_fn(|p| (samples[k][p] - samples[k + SAMPLES][p]) * 0.5))
        .collect();
    let lead = (1..8).fold(0, |best, p| if half[0][p].norm() > half[0][best].norm() { p } else { best });
    let product = |p: usize| half.iter().map(|h| h[lead] * h[p]).sum::<Complex64>() / SAMPLES as f64;
    let root = product(lead).sqrt();
    (root.norm_sqr() > 0.0).then(|| std::array::from_fn(|p| product(p) / root))
}

fn patched(x: &[Complex64; 8], patch: &[Complex64; 8]) -> Option<[Complex64; 8]> {
    let scale: Complex64 = x.iter().zip(patch).map(|(a, b)| a * b).sum();
    (scale.norm() > 1e-6).then(|| x.map(|z| z / scale))
}

/// Sine of the angle between two complex lines (vectors of norm one).
pub(crate) fn projective_distance(x: &[Complex64; 8], y: &[Complex64; 8]) -> f64 {
    let overlap: Complex64 = x.iter().zip(y).map(|(a, b)| a.conj() * b).sum();
    let rest = x.iter().zip(y).map(|(a, b)| (b - a * overlap).norm_sqr()).sum::<f64>();
    rest.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two sheets `x = m(t) +- sqrt(t - b) v(t)` that meet at `b` inside the circle.
    #[test]
    fn the_split_of_two_sheets_is_found_from_a_circle_round_their_branch_point() {
        let circle = |turn: usize, k: usize| {
            let angle = std::f64::consts::TAU * (k as f64 / SAMPLES as f64 + turn as f64);
            (Complex64::from_polar(1e-3, angle), angle)
        };
        let branch = Complex64::new(-2e-7, 1e-7);
        let mut samples = Vec::new();
        for turn in 0..2 {
            for k in 0..SAMPLES {
                let (t, angle) = circle(turn, k);
                // the root that is continuous round the circle: sqrt t times the near one of 1 - b/t
                let root = Complex64::from_polar(1e-3f64.sqrt(), angle / 2.0) * (1.0 - branch / t).sqrt();
                samples.push(std::array::from_fn(|p| {
                    let p = p as f64;
                    Complex64::new(1.0, p) + t * p + root * (Complex64::new(1.0 + p, -0.5) + t * (2.0 - p))
                }));
            }
        }
        let found = split(&samples).unwrap();
        let expected = (-branch).sqrt();
        let sign = (found[0] / (expected * Complex64::new(1.0, -0.5))).re.signum();
        for (p, z) in found.iter().enumerate() {
            let truth = expected * Complex64::new(1.0 + p as f64, -0.5) * sign;
            assert!((z - truth).norm() < 1e-3 * truth.norm(), "{z} {truth}");
        }
        // one sheet, followed twice
        let single: Vec<[Complex64; 8]> = (0..2 * SAMPLES).map(|_| [Complex64::ONE; 8]).collect();
        assert!(split(&single).is_none());
    }
}
