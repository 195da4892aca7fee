//! All complex roots of one polynomial by simultaneous iteration.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use num_complex::Complex64;
use thiserror::Error;

use crate::batch::{ComplexBatch, LANES};
use crate::vector_unit::on_vector_unit;

/// Roots that could not be computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum RootsError {
    /// A coefficient is not finite, or all of them are zero.
    #[error("the polynomial has no finite nonzero coefficients")]
    NoPolynomial,
}

/// Number of sweeps after which the current iterates are returned.
const SWEEPS: usize = 120;

/// The roots of `c[0] + c[1] x + .. + c[n] x^n`, with multiplicity, in no particular order.
///
/// The method is that of Ehrlich (1967) and Aberth (1973): Newton corrections with the repulsion of every other
/// iterate. Starting points are on circles with radii from the Newton polygon of the moduli (Bini 1996). Leading
/// coefficients that are exactly zero lower the degree. Simple roots are accurate to a few units of rounding times
/// their condition, an `m`-fold root to about the `m`-th root of rounding.
///
/// # Errors
/// [`RootsError::NoPolynomial`] for non-finite or all-zero coefficients.
///
/// ```
/// # mod equipod { pub use equipod_num::Cancel; pub mod methods { pub use equipod_num::poly; } }
/// use equipod::methods::poly::roots;
/// use num_complex::Complex64;
/// // (x - 1)(x - 2)(x + 3) = 6 - 7x + x^3
/// let c = [6.0, -7.0, 0.0, 1.0].map(|r| Complex64::new(r, 0.0));
/// let mut x: Vec<f64> = roots(&c)?.iter().map(|z| z.re).collect();
/// x.sort_by(f64::total_cmp);
/// assert!((x[0] + 3.0).abs() + (x[1] - 1.0).abs() + (x[2] - 2.0).abs() < 1e-12);
/// # Ok::<(), equipod::methods::poly::RootsError>(())
/// ```
pub fn roots(coefficients: &[Complex64]) -> Result<Vec<Complex64>, RootsError> {
    if coefficients.iter().any(|c| !c.re.is_finite() || !c.im.is_finite()) {
        return Err(RootsError::NoPolynomial);
    }
    let zero = |c: &Complex64| *c == Complex64::ZERO;
    let top = coefficients.iter().rposition(|c| !zero(c)).ok_or(RootsError::NoPolynomial)?;
    let low = coefficients.iter().position(|c| !zero(c)).ok_or(RootsError::NoPolynomial)?;
    let c = &coefficients[low..=top];
    let mut z = starting_points(c);
    for _ in 0..SWEEPS {
        let mut largest = 0.0f64;
        for k in 0..z.len() {
            let newton = newton_correction(c, z[k]);
            let others = (0..z.len()).filter(|&j| j != k);
            let repulsion: Complex64 = others.map(|j| (z[k] - z[j]).inv()).filter(|w| w.is_finite()).sum();
            let step = newton / (1.0 - newton * repulsion);
            if step.is_finite() {
                z[k] -= step;
                largest = largest.max(step.norm() / z[k].norm().max(f64::MIN_POSITIVE));
            }
        }
        if largest < 4.0 * f64::EPSILON {
            break;
        }
    }
    z.extend(std::iter::repeat_n(Complex64::ZERO, low));
    Ok(z)
}

/// [`roots`] up to relative steps of `tolerance`, with at most `sweeps` sweeps, as start values for methods with a
/// better function than the coefficients. Each root rests once its step is small enough.
///
/// # Errors
/// [`RootsError`]: no polynomial, or an iteration that does not end.
pub fn approximate_roots(
    coefficients: &[Complex64],
    tolerance: f64,
    sweeps: usize,
) -> Result<Vec<Complex64>, RootsError> {
    let finite = coefficients.iter().all(|c| c.is_finite());
    let ends = coefficients.first().zip(coefficients.last());
    if !finite || ends.is_none_or(|(a, b)| *a == Complex64::ZERO || *b == Complex64::ZERO) {
        return Err(RootsError::NoPolynomial);
    }
    let mut z = starting_points(coefficients);
    on_vector_unit(Sweeps { c: coefficients, z: &mut z, tolerance, most: sweeps });
    Ok(z)
}

/// The sweeps of [`approximate_roots`], eight roots in parallel.
struct Sweeps<'a> {
    c: &'a [Complex64],
    z: &'a mut [Complex64],
    tolerance: f64,
    most: usize,
}

impl pulp::WithSimd for Sweeps<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { c, z, tolerance, most } = self;
        let mut moving = vec![true; z.len()];
        for _ in 0..most {
            for start in (0..z.len()).step_by(LANES) {
                let end = (start + LANES).min(z.len());
                if !moving[start..end].contains(&true) {
                    continue;
                }
                let mut batch = ComplexBatch::ZERO;
                for k in 0..LANES {
                    let at = z[(start + k).min(end - 1)];
                    (batch.re[k], batch.im[k]) = (at.re, at.im);
                }
                let step = corrections(c, &batch, z);
                let next = batch - step;
                let (moved, size) = (step.norm_sqr(), next.norm_sqr());
                for k in start..end {
                    let lane = k - start;
                    // coincident iterates stay together
                    if moving[k] && moved[lane].is_finite() {
                        z[k] = next.lane(lane);
                        moving[k] = !(moved[lane] <= tolerance * tolerance * size[lane]);
                    }
                }
            }
            if !moving.contains(&true) {
                break;
            }
        }
    }
}

/// Numerator and denominator of `p / p'` at eight points; for `|x| > 1` from the reversed polynomial `q`:
/// `p / p' = x q / (n q - q' / x)` with `q`, `q'` at `1 / x`.
#[inline(always)]
pub fn newton_quotients(c: &[Complex64], x: &ComplexBatch) -> [ComplexBatch; 2] {
    let n = c.len() - 1;
    let size = x.norm_sqr();
    let mut outside = [false; LANES];
    for k in 0..LANES {
        outside[k] = size[k] > 1.0;
    }
    let inverse = x.reciprocal();
    let y = inverse.select(*x, outside);
    let coefficient = |k: usize| ComplexBatch::all(c[n - k]).select(ComplexBatch::all(c[k]), outside);
    let (mut p, mut d) = (coefficient(n), ComplexBatch::ZERO);
    for k in (0..n).rev() {
        d = d * y + p;
        p = p * y + coefficient(k);
    }
    let reversed = p.times(n as f64) - d * inverse;
    [(p * *x).select(p, outside), reversed.select(d, outside)]
}

/// `N / (1 - N sum 1 / (x_k - z_j))` for `x` among the `z`, `N = p / p'`.
#[inline(always)]
fn corrections(c: &[Complex64], x: &ComplexBatch, z: &[Complex64]) -> ComplexBatch {
    let [top, bottom] = newton_quotients(c, x);
    let mut repulsion = ComplexBatch::ZERO;
    for other in z {
        for k in 0..LANES {
            let (re, im) = (x.re[k] - other.re, x.im[k] - other.im);
            let square = re * re + im * im;
            let inverse = if square > 0.0 { 1.0 / square } else { 0.0 };
            repulsion.re[k] += re * inverse;
            repulsion.im[k] -= im * inverse;
        }
    }
    top * (bottom - top * repulsion).reciprocal()
}

/// `p(x) / p'(x)`; for `|x| > 1` from the reversed polynomial, so that powers do not overflow.
fn newton_correction(c: &[Complex64], x: Complex64) -> Complex64 {
    let n = c.len() - 1;
    let horner = |coefficient: &dyn Fn(usize) -> Complex64, y: Complex64| {
        let (mut p, mut d) = (coefficient(n), Complex64::ZERO);
        for k in (0..n).rev() {
            d = d * y + p;
            p = p * y + coefficient(k);
        }
        (p, d)
    };
    if x.norm_sqr() <= 1.0 {
        let (p, d) = horner(&|k| c[k], x);
        if p == Complex64::ZERO { Complex64::ZERO } else { p / d }
    } else {
        // p(x) = x^n q(1/x):  p/p' = x q / (n q - q'/x)
        let y = x.inv();
        let (q, d) = horner(&|k| c[n - k], y);
        if q == Complex64::ZERO { Complex64::ZERO } else { x * q / (q * n as f64 - d * y) }
    }
}

/// Points on circles whose radii are the slopes of the upper convex hull of `(k, ln |c_k|)`.
fn starting_points(c: &[Complex64]) -> Vec<Complex64> {
    let logs: Vec<f64> = c.iter().map(|z| z.norm().ln()).collect();
    let mut hull: Vec<usize> = Vec::new();
    for k in (0..c.len()).filter(|&k| logs[k].is_finite()) {
        while let [.., a, b] = hull[..] {
            let cross = (logs[b] - logs[a]) * (k - a) as f64 - (logs[k] - logs[a]) * (b - a) as f64;
            if cross > 0.0 {
                break;
            }
            hull.pop();
        }
        hull.push(k);
    }
    let mut points = Vec::with_capacity(c.len() - 1);
    for (edge, pair) in hull.windows(2).enumerate() {
        let count = pair[1] - pair[0];
        let radius = ((logs[pair[0]] - logs[pair[1]]) / count as f64).exp();
        for k in 0..count {
            let angle = std::f64::consts::TAU * (k as f64 + 0.37) / count as f64 + 0.7 * (edge as f64 + 1.0);
            points.push(Complex64::from_polar(radius, angle));
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;

    fn expand(roots: &[Complex64]) -> Vec<Complex64> {
        let mut c = vec![Complex64::ONE];
        for r in roots {
            let mut next = vec![Complex64::ZERO; c.len() + 1];
            for (k, a) in c.iter().enumerate() {
                next[k + 1] += a;
                next[k] -= a * r;
            }
            c = next;
        }
        c
    }

    #[test]
    fn finds_random_roots_of_very_different_size() {
        let mut rng = Rng::new(9);
        for _ in 0..200 {
            let size = |rng: &mut Rng| 10f64.powf(rng.uniform(-3.0, 3.0));
            let known: Vec<Complex64> =
                (0..8).map(|_| Complex64::from_polar(size(&mut rng), rng.uniform(0.0, 6.3))).collect();
            let found = roots(&expand(&known)).unwrap();
            assert_eq!(found.len(), 8);
            for r in &known {
                let gap = known.iter().filter(|q| *q != r).map(|q| (q - r).norm()).fold(f64::MAX, f64::min);
                let near = found.iter().map(|z| (z - r).norm()).fold(f64::MAX, f64::min);
                assert!(near / r.norm() < 1e-8 || gap / r.norm() < 1e-2, "{r} missed by {near}");
            }
        }
    }

    #[test]
    fn multiple_roots_zero_roots_and_lower_degree() {
        let one = Complex64::ONE;
        let found = roots(&expand(&[one, one, one * 3.0])).unwrap();
        assert_eq!(found.iter().filter(|z| (*z - one).norm() < 1e-6).count(), 2);
        let zero = Complex64::ZERO;
        let found = roots(&[zero, zero, one, one, zero]).unwrap();
        assert_eq!(found.iter().filter(|z| **z == zero).count(), 2);
        assert_eq!(found.len(), 3);
        assert_eq!(roots(&[zero; 3]), Err(RootsError::NoPolynomial));
        assert_eq!(roots(&[one, Complex64::new(f64::NAN, 0.0)]), Err(RootsError::NoPolynomial));
    }
}
