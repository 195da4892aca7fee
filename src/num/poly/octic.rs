//! All roots of a real polynomial of degree eight, or of a lower one, at once, without allocation.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use crate::batch::{ComplexBatch, LANES};

/// Greatest number of sweeps; well-separated roots take about ten.
const SWEEPS: usize = 40;

/// Approximate roots of `c[0] + .. + c[8] x^8`, by [`roots_in_lanes`].
#[inline(always)]
pub fn octic_roots(c: &[f64; LANES + 1], accuracy: f64) -> Option<ComplexBatch> {
    roots_in_lanes::<LANES>(c, accuracy)
}

/// Approximate roots of `c[0] + .. + c[N] x^N` in the first `N` of eight lanes, relative corrections below `accuracy`
/// in the last sweep.
///
/// Ehrlich-Aberth iteration on all roots in parallel, from circles whose radii are the slopes of the Newton polygon.
/// `None` if an end coefficient is zero or not finite, or if some root does not converge (multiple roots converge
/// linearly).
#[inline(always)]
pub fn roots_in_lanes<const N: usize>(c: &[f64], accuracy: f64) -> Option<ComplexBatch> {
    let usable = c.len() == N + 1 && c.iter().all(|x| x.is_finite()) && c[0].abs() > 0.0 && c[N].abs() > 0.0;
    if !usable {
        return None;
    }
    let mut z = starting_points::<N>(c);
    for _ in 0..SWEEPS {
        let step = corrections::<N>(c, &z);
        let (moved, size) = (step.norm_sqr(), z.norm_sqr());
        z = z - step;
        let mut settled = true;
        let mut finite = true;
        for k in 0..N {
            settled &= moved[k] <= accuracy * accuracy * size[k];
            finite &= moved[k].is_finite();
        }
        if !finite {
            return None;
        }
        if settled {
            return Some(z);
        }
    }
    None
}

/// `N / (1 - N sum 1 / (z_k - z_j))`, `N = p / p'`.
#[inline(always)]
fn corrections<const N: usize>(c: &[f64], z: &ComplexBatch) -> ComplexBatch {
    let (mut p, mut d) = (ComplexBatch::real(c[N]), ComplexBatch::ZERO);
    for k in (0..N).rev() {
        d = d * *z + p;
        p = (p * *z).plus(c[k]);
    }
    p * (d - p * repulsion_among::<N>(z)).reciprocal()
}

/// `sum 1 / (z_k - z_j)` over the other lanes `j`, for every lane `k`.
#[inline(always)]
pub fn repulsion(z: &ComplexBatch) -> ComplexBatch {
    repulsion_among::<LANES>(z)
}

/// The same for the first `N` lanes.
#[inline(always)]
fn repulsion_among<const N: usize>(z: &ComplexBatch) -> ComplexBatch {
    let mut sum = ComplexBatch::ZERO;
    // lane k against lane k + shift, every pair from both sides
    for shift in 1..N {
        let mut other = ComplexBatch::ZERO;
        for k in 0..LANES {
            (other.re[k], other.im[k]) = (z.re[(k + shift) % N], z.im[(k + shift) % N]);
        }
        sum = sum + (*z - other).reciprocal();
    }
    sum
}

/// Points on circles whose radii are the slopes of the upper convex hull of `(k, ln |c_k|)`.
#[inline(always)]
fn starting_points<const N: usize>(c: &[f64]) -> ComplexBatch {
    // unit vectors at 2 pi k / 8 + 0.4, not symmetric to the real axis
    const COSINE: [f64; LANES] = [
        0.921_060_994_002_885_1,
        0.375_928_124_180_991_1,
        -0.389_418_342_308_650_5,
        -0.926_648_825_310_733,
        -0.921_060_994_002_885_1,
        -0.375_928_124_180_991_1,
        0.389_418_342_308_650_5,
        0.926_648_825_310_733,
    ];
    let mut logs = [0.0; LANES + 1];
    for k in 0..=N {
        logs[k] = c[k].abs().ln();
    }
    let mut hull = [0usize; LANES + 1];
    let mut count = 0;
    for k in 0..=N {
        if !logs[k].is_finite() {
            continue;
        }
        while count >= 2 {
            let (a, b) = (hull[count - 2], hull[count - 1]);
            let cross = (logs[b] - logs[a]) * (k - a) as f64 - (logs[k] - logs[a]) * (b - a) as f64;
            if cross > 0.0 {
                break;
            }
            count -= 1;
        }
        hull[count] = k;
        count += 1;
    }
    let mut z = ComplexBatch::ZERO;
    for edge in hull[..count].windows(2) {
        let length = edge[1] - edge[0];
        let radius = ((logs[edge[0]] - logs[edge[1]]) / length as f64).exp();
        for k in edge[0]..edge[1] {
            // spread the points of an edge over the circle
            let place = (k * LANES / length + edge[0]) % LANES;
            // slightly apart for two edges of nearly equal radius
            let radius = radius * (1.0 + 0.01 * k as f64);
            z.re[k] = radius * COSINE[place];
            z.im[k] = -radius * COSINE[(place + 2) % LANES];
        }
    }
    z
}

#[cfg(test)]
mod tests {
    use super::super::roots;
    use super::*;
    use crate::Rng;
    use num_complex::Complex64;

    #[test]
    fn agrees_with_the_general_iteration() {
        let mut rng = Rng::new(3);
        for case in 0..300 {
            let spread = if case % 2 == 0 { 0.0 } else { 4.0 };
            let c: [f64; 9] =
                std::array::from_fn(|_| rng.normal() * 10f64.powf(rng.uniform(-spread, spread)));
            let all = octic_roots(&c, 1e-12).unwrap_or_else(|| panic!("case {case}"));
            let known = roots(&c.map(Complex64::from)).unwrap();
            for r in known {
                let near = (0..8).map(|k| (all.lane(k) - r).norm()).fold(f64::MAX, f64::min);
                assert!(near <= 1e-7 * r.norm(), "case {case}: {near}");
            }
        }
    }

    #[test]
    fn lower_degrees_have_their_roots_in_the_first_lanes() {
        let mut rng = Rng::new(8);
        for _ in 0..100 {
            let c: [f64; 7] = std::array::from_fn(|_| rng.normal());
            let (quartic, sextic) = (roots_in_lanes::<4>(&c[..5], 1e-12), roots_in_lanes::<6>(&c, 1e-12));
            for (n, all) in [(4, quartic.unwrap()), (6, sextic.unwrap())] {
                for r in roots(&c[..=n].iter().map(|x| Complex64::from(*x)).collect::<Vec<_>>()).unwrap() {
                    let near = (0..n).map(|k| (all.lane(k) - r).norm()).fold(f64::MAX, f64::min);
                    assert!(near <= 1e-7 * r.norm(), "{n}: {near}");
                }
            }
        }
        // the number of coefficients must match the degree
        assert!(roots_in_lanes::<4>(&[1.0; 9], 1e-8).is_none());
    }

    #[test]
    fn refuses_lower_degrees_zero_roots_and_multiple_roots() {
        assert!(octic_roots(&[1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0], 1e-8).is_none());
        assert!(octic_roots(&[0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], 1e-8).is_none());
        assert!(octic_roots(&[f64::NAN; 9], 1e-8).is_none());
        // (x - 1)^8
        assert!(octic_roots(&[1.0, -8.0, 28.0, -56.0, 70.0, -56.0, 28.0, -8.0, 1.0], 1e-8).is_none());
    }
}
