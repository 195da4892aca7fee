//! Newton's method at the target: tells regular ends from singular ones.

use num_complex::Complex64;
use pulp::Scalar;

use super::lanes::{Lanes, Vec8, norm_sqr};
use super::lu::Lu;
use super::system::{SectionHomotopy, derivative_matrix, values};

/// Newton's method at the target.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PolishedRoot {
    pub x: [Complex64; 8],
    pub converged: bool,
    /// Smallest over largest pivot modulus of the last Newton matrix.
    pub pivot_ratio: f64,
}

/// Newton's method at `t = 0` on the patch of `x`, until it stops contracting.
pub(super) fn polish(homotopy: &SectionHomotopy, x: &[Complex64; 8]) -> PolishedRoot {
    let norm = x.iter().map(num_complex::Complex::norm_sqr).sum::<f64>().sqrt();
    let simd = Scalar::new();
    let mut y: Vec8<Scalar> = x.map(|z| Lanes::splat(simd, z / norm));
    let patch = y.map(Lanes::conj);
    let rows = homotopy.rows_at(Lanes::zero(simd));
    let mut last = f64::INFINITY;
    let mut pivot_ratio = 0.0;
    for _ in 0..8 {
        let j = derivative_matrix(&rows, &y, &patch);
        let f = values(&j, &y);
        let lu = Lu::factorise(j);
        pivot_ratio = lu.pivot_ratio()[0];
        let delta = lu.solve(f);
        let size = norm_sqr(&delta).sqrt();
        if !(size < 0.1 * last) {
            // no longer contracting: at rounding level that is the end of it, above it is failure
            let x = y.map(|z| z.lane(0));
            return PolishedRoot { x, converged: last < 1e-8 && size < 1e-8, pivot_ratio };
        }
        for p in 0..8 {
            y[p] -= delta[p];
        }
        last = size;
        if size < 1e-15 {
            break;
        }
    }
    PolishedRoot { x: y.map(|z| z.lane(0)), converged: last < 1e-8, pivot_ratio }
}
