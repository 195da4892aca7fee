//! Roots of a complex polynomial of degree eight, from roots of a neighbour when there are some.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use num_complex::Complex64;

use crate::num::batch::{Batch, LANES};
use crate::poly::repulsion;

/// Sweeps before giving up; from the roots of a neighbour three or four do.
const SWEEPS: usize = 40;
/// Relative correction below which a root has settled; the next one would be of the order of its cube.
const ACCURACY: f64 = 1e-6;

/// Roots of `c[0] + .. + c[8] x^8`, `None` when an end coefficient is zero or not finite.
///
/// Ehrlich-Aberth iteration on all roots side by side; multiple roots are left after [`SWEEPS`] as near as they came. `start` must be eight
/// different numbers; without it points of a circle are taken.
pub(super) fn octic_roots(c: &[Complex64; LANES + 1], start: Option<Batch>) -> Option<Batch> {
    let usable = c.iter().all(|z| z.is_finite()) && c[0].norm() > 0.0 && c[LANES].norm() > 0.0;
    if !usable {
        return None;
    }
    let mut z = start.unwrap_or_else(|| circle((c[0].norm() / c[LANES].norm()).powf(1.0 / LANES as f64)));
    for _ in 0..SWEEPS {
        let step = corrections(c, &z);
        let (moved, size) = (step.norm_sqr(), z.norm_sqr());
        let finite = moved.map(f64::is_finite);
        // two roots in one place repel each other infinitely: they stay
        z = z - step.select(Batch::ZERO, finite);
        if (0..LANES).all(|k| !finite[k] || moved[k] <= ACCURACY * ACCURACY * size[k]) {
            break;
        }
    }
    z.norm_sqr().iter().all(|n| n.is_finite()).then_some(z)
}

/// Eight points of a circle, not symmetric to the real axis.
fn circle(radius: f64) -> Batch {
    let mut z = Batch::ZERO;
    for k in 0..LANES {
        let point = Complex64::from_polar(radius * (1.0 + 0.01 * k as f64), 0.4 + 0.785 * k as f64);
        (z.re[k], z.im[k]) = (point.re, point.im);
    }
    z
}

/// `N / (1 - N sum 1 / (z_k - z_j))`, `N = p / p'`; where `|z| > 1` from the reversed polynomial.
#[inline(always)]
fn corrections(c: &[Complex64; LANES + 1], z: &Batch) -> Batch {
    let outside = z.norm_sqr().map(|n| n > 1.0);
    let inverse = z.reciprocal();
    let y = inverse.select(*z, outside);
    let coefficient = |k: usize| all(c[LANES - k]).select(all(c[k]), outside);
    let (mut p, mut d) = (coefficient(LANES), Batch::ZERO);
    for k in (0..LANES).rev() {
        d = d * y + p;
        p = p * y + coefficient(k);
    }
    // p/p' = z q / (8 q - q'/z) for the reversed polynomial q at 1/z
    let reversed = p.times(LANES as f64) - d * inverse;
    let (top, bottom) = ((p * *z).select(p, outside), reversed.select(d, outside));
    top * (bottom - top * repulsion(z)).reciprocal()
}

#[inline(always)]
fn all(c: Complex64) -> Batch {
    Batch { re: [c.re; LANES], im: [c.im; LANES] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::Rng;

    #[test]
    fn finds_the_roots_from_nothing_and_from_a_neighbour() {
        let mut rng = Rng::new(4);
        for _ in 0..100 {
            let known: Vec<Complex64> = (0..LANES)
                .map(|_| Complex64::from_polar(10f64.powf(rng.uniform(-1.0, 1.0)), rng.uniform(0.0, 6.3)))
                .collect();
            let mut exact = vec![Complex64::ONE];
            for r in &known {
                let mut next = vec![Complex64::ZERO; exact.len() + 1];
                for (k, a) in exact.iter().enumerate() {
                    next[k + 1] += a;
                    next[k] -= a * r;
                }
                exact = next;
            }
            let exact: [Complex64; LANES + 1] = exact.try_into().unwrap();
            let first = octic_roots(&exact, None).unwrap();
            let again = octic_roots(&exact, Some(first)).unwrap();
            for found in [first, again] {
                for r in &known {
                    let gap =
                        known.iter().filter(|q| *q != r).map(|q| (q - r).norm()).fold(f64::MAX, f64::min);
                    let near = (0..LANES).map(|k| (found.lane(k) - r).norm()).fold(f64::MAX, f64::min);
                    assert!(near / r.norm() < 1e-7 || gap / r.norm() < 3e-2, "{r} missed by {near}");
                }
            }
        }
        assert!(octic_roots(&[Complex64::ZERO; LANES + 1], None).is_none());
    }
}
