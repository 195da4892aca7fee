//! All complex roots, enclosed in disjoint discs, in fixed-point arithmetic of growing precision.

use num_bigint::{BigInt, Sign};
use num_complex::Complex64;
use num_traits::{ToPrimitive, Zero};
use thiserror::Error;

use super::{Dyadic, IntPoly, squarefree_factors};
use crate::poly::roots;

/// A disc with exactly one distinct root.
#[derive(Debug, Clone, PartialEq)]
pub struct ComplexRoot {
    /// Real part of the centre.
    pub re: Dyadic,
    /// Imaginary part of the centre, exactly zero for a root that is proved to be real.
    pub im: Dyadic,
    /// The base-2 logarithm of an upper bound of the radius.
    pub radius_log2: f64,
    /// Multiplicity.
    pub multiplicity: usize,
}

impl ComplexRoot {
    /// The centre in doubles.
    #[must_use]
    pub fn to_complex64(&self) -> Complex64 {
        Complex64::new(self.re.to_f64(), self.im.to_f64())
    }

    /// Whether the root is real; decided for every root.
    #[must_use]
    pub fn is_real(&self) -> bool {
        self.im.sign() == Sign::NoSign
    }
}

/// The largest precision did not suffice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("the roots are not separated with {bits} bits")]
pub struct NotSeparated {
    /// Bits after the point in the last attempt, for lengths relative to the largest root.
    pub bits: u64,
}

/// Greatest precision of an attempt.
const LAST: u64 = 1 << 15;
/// Greatest number of sweeps at one precision; each gains some fifty bits once the roots are separated.
const SWEEPS: usize = 60;
/// Margin far above the rounding of logarithms in doubles.
const MARGIN: f64 = 0.01;

/// The roots of `p` with radii at most `2^-bits` times the largest modulus, in order of real and imaginary part.
///
/// Ehrlich-Aberth iteration on each square-free factor. Let `z_1, .., z_n` be the iterates and `c` the leading
/// coefficient. The discs of radius `n |p(z_i) / (c prod (z_i - z_j))|` about `z_i` contain all roots, and a disc that
/// is disjoint from the others contains exactly one (Smith 1970). The values are computed with error bounds. The
/// precision is doubled until the discs are disjoint and small enough. A root whose disc meets the real axis is real if
/// its mirror image is disjoint from the other discs.
///
/// # Errors
/// [`NotSeparated`] beyond 32768 bits.
pub fn complex_roots(p: &IntPoly, bits: u64) -> Result<Vec<ComplexRoot>, NotSeparated> {
    let mut out = Vec::new();
    for f in squarefree_factors(p) {
        let mut q = f.factor;
        if q.0[0].is_zero() {
            let zero = Dyadic::new(BigInt::zero(), 0);
            out.push(ComplexRoot {
                re: zero.clone(),
                im: zero,
                radius_log2: f64::NEG_INFINITY,
                multiplicity: f.multiplicity,
            });
            q.0.remove(0);
        }
        if q.degree() != Some(0) {
            out.extend(of_squarefree(&q, bits, f.multiplicity)?);
        }
    }
    out.sort_by(|a, b| (&a.re, &a.im).cmp(&(&b.re, &b.im)));
    Ok(out)
}

fn of_squarefree(q: &IntPoly, bits: u64, multiplicity: usize) -> Result<Vec<ComplexRoot>, NotSeparated> {
    let bound = q.root_bound();
    let q = q.stretched(-bound);
    let mut precision = (bits + 64).next_power_of_two();
    let mut z: Vec<FixedPoint> = start(&q).into_iter().map(|z| FixedPoint::from_f64(z, precision)).collect();
    loop {
        let work = FixedPoly::new(&q, precision);
        for _ in 0..SWEEPS {
            if work.sweep(&mut z) {
                break;
            }
        }
        if let Some(found) = work.enclose(&z, bits) {
            return Ok(found
                .into_iter()
                .map(|(re, im, radius_log2)| {
                    let place = |m: BigInt| Dyadic::new(m, bound - precision.cast_signed());
                    ComplexRoot {
                        re: place(re),
                        im: place(im),
                        radius_log2: radius_log2 + bound as f64,
                        multiplicity,
                    }
                })
                .collect());
        }
        if precision >= LAST {
            return Err(NotSeparated { bits: precision });
        }
        z = z.into_iter().map(|z| FixedPoint { re: z.re << precision, im: z.im << precision }).collect();
        precision *= 2;
    }
}

/// Starting points in floating point, all different and none exactly real.
fn start(q: &IntPoly) -> Vec<Complex64> {
    let top = q.bits().cast_signed();
    let scaled = |c: &BigInt| Complex64::from(Dyadic::new(c.clone(), -top).to_f64());
    let c: Vec<Complex64> = q.0.iter().map(scaled).collect();
    let n = q.0.len() - 1;
    let mut z = roots(&c).unwrap_or_default();
    z.retain(|z| z.is_finite() && z.norm() < 2.0);
    z.resize_with(n, || Complex64::ZERO);
    // roots that coincide in doubles, or that underflowed, are slightly spread
    for (k, z) in z.iter_mut().enumerate() {
        let spread = (z.norm() + 1e-3) * 1e-9 * (k + 1) as f64;
        *z += Complex64::from_polar(spread, 2.4 * k as f64 + 0.3);
    }
    z
}

/// A complex number `(re + i im) 2^-precision`.
#[derive(Debug, Clone, PartialEq)]
struct FixedPoint {
    re: BigInt,
    im: BigInt,
}

impl FixedPoint {
    fn from_f64(z: Complex64, precision: u64) -> Self {
        let part = |x: f64| {
            let d = Dyadic::from_f64(x).unwrap_or_else(|| Dyadic::new(BigInt::zero(), 0));
            shifted(d.mantissa(), d.exponent() + precision.cast_signed())
        };
        Self { re: part(z.re), im: part(z.im) }
    }

    fn times(&self, other: &Self, precision: u64) -> Self {
        Self {
            re: (&self.re * &other.re - &self.im * &other.im) >> precision,
            im: (&self.re * &other.im + &self.im * &other.re) >> precision,
        }
    }

    fn minus(&self, other: &Self) -> Self {
        Self { re: &self.re - &other.re, im: &self.im - &other.im }
    }

    fn is_zero(&self) -> bool {
        self.re.is_zero() && self.im.is_zero()
    }

    /// `self / other`, both at one precision; `other` must be nonzero.
    fn over(&self, other: &Self, precision: u64) -> Self {
        let norm = &other.re * &other.re + &other.im * &other.im;
        let re = &self.re * &other.re + &self.im * &other.im;
        let im = &self.im * &other.re - &self.re * &other.im;
        Self { re: (re << precision) / &norm, im: (im << precision) / &norm }
    }

    /// `log2 |z|` of the integers: a lower bound within half a bit, or an upper one if `up`.
    fn log2(&self, up: bool) -> f64 {
        let larger = self.re.magnitude().max(self.im.magnitude());
        let base = log2(larger);
        if up { base + 0.5 + MARGIN } else { base - MARGIN }
    }

    /// The number times `2^-places`, in doubles.
    fn scaled(&self, places: u64) -> Complex64 {
        // numbers far below the smallest double squared are negligible
        let (drop, rest) = if places > 600 { (places - 600, 600) } else { (0, places) };
        let unit = 2f64.powi(-(rest as i32));
        let part =
            |x: &BigInt| if drop == 0 { x.to_f64() } else { (x >> drop).to_f64() }.unwrap_or(0.0) * unit;
        Complex64::new(part(&self.re), part(&self.im))
    }
}

fn shifted(m: &BigInt, places: i64) -> BigInt {
    if places >= 0 { m << places.unsigned_abs() } else { m >> places.unsigned_abs() }
}

/// `log2` to about fifteen digits; minus infinity for zero.
fn log2(x: &num_bigint::BigUint) -> f64 {
    let bits = x.bits();
    let drop = bits.saturating_sub(60);
    (x >> drop).to_f64().unwrap_or(0.0).log2() + drop as f64
}

/// `q / 2^scale`, coefficients with `precision` bits after the point and rounded down; roots of modulus below one.
struct FixedPoly {
    c: Vec<BigInt>,
    d: Vec<BigInt>,
    precision: u64,
}

impl FixedPoly {
    fn new(q: &IntPoly, precision: u64) -> Self {
        let fixed = |p: &IntPoly, bits: u64| -> Vec<BigInt> {
            let drop = bits.cast_signed() - precision.cast_signed();
            p.0.iter().map(|c| shifted(c, -drop)).collect()
        };
        let bits = q.bits();
        Self { c: fixed(q, bits), d: fixed(&q.derivative(), bits), precision }
    }

    fn horner(&self, c: &[BigInt], z: &FixedPoint) -> FixedPoint {
        let mut value = FixedPoint { re: BigInt::zero(), im: BigInt::zero() };
        for c in c.iter().rev() {
            value = value.times(z, self.precision);
            value.re += c;
        }
        value
    }

    /// One sweep; `true` if every step was at the size of rounding or no further gain is possible.
    fn sweep(&self, z: &mut [FixedPoint]) -> bool {
        let mut settled = true;
        for k in 0..z.len() {
            let value = self.horner(&self.c, &z[k]);
            let slope = self.horner(&self.d, &z[k]);
            if slope.is_zero() {
                settled = false;
                z[k].re += BigInt::from(1) << (self.precision / 2);
                continue;
            }
            let newton = value.over(&slope, self.precision);
            let log = self.precision;
            // the repulsion need not be accurate: its error only slows the convergence
            let repulsion: Complex64 = (0..z.len())
                .filter(|j| *j != k)
                .map(|j| z[k].minus(&z[j]).scaled(log).inv())
                .filter(|w| w.is_finite())
                .sum();
            let factor = (1.0 - newton.scaled(log) * repulsion).inv();
            let factor = if factor.is_finite() && factor.norm() < 1e6 { factor } else { Complex64::ONE };
            let mut step = newton.times(&FixedPoint::from_f64(factor, self.precision), self.precision);
            let length = step.log2(true) - self.precision as f64;
            if length > 0.0 {
                // no step exceeds the disc of the roots
                let places = length.ceil() as i64;
                step = FixedPoint { re: shifted(&step.re, -places), im: shifted(&step.im, -places) };
            }
            settled &= length < -(self.precision as f64) * 0.75;
            z[k] = z[k].minus(&step);
        }
        settled
    }

    /// Discs about the iterates, `None` unless they are disjoint and of radius below `2^-bits`; real roots get real
    /// centres.
    fn enclose(&self, z: &[FixedPoint], bits: u64) -> Option<Vec<(BigInt, BigInt, f64)>> {
        let n = z.len();
        let units = self.precision as f64;
        let lead = log2(self.c[n].magnitude());
        // the leading coefficient itself has a rounding error below one unit
        if lead < 8.0 || z.iter().any(|z| z.log2(true) > units + 1.0) {
            return None;
        }
        let radius: Vec<f64> = (0..n)
            .map(|i| {
                let value = self.horner(&self.c, &z[i]);
                // |z| < 2 and each of n steps is wrong by at most two units in each part: below 2^(n+1) 4 units in all
                let error = (n as f64 + 3.0).exp2();
                let size = log2_sum(value.log2(true), error.log2());
                let others = (0..n).filter(|j| *j != i);
                let product: f64 = others.map(|j| z[i].minus(&z[j]).log2(false) - units).sum();
                (n as f64).log2() + size - (lead - MARGIN - 0.01) - product + 2.0 * MARGIN
            })
            .collect();
        let small = radius.iter().all(|r| *r < -(bits as f64));
        // distances in units of one; the sum of the two radii is at most twice the larger one
        let apart = |a: &FixedPoint, b: &FixedPoint, r: f64, s: f64| {
            a.minus(b).log2(false) - units > r.max(s) + 1.0 + MARGIN
        };
        let disjoint = (0..n).all(|i| (0..i).all(|j| apart(&z[i], &z[j], radius[i], radius[j])));
        if !(small && disjoint) {
            return None;
        }
        (0..n).map(|i| self.decided(z, &radius, i, &apart)).collect()
    }

    fn decided(
        &self,
        z: &[FixedPoint],
        radius: &[f64],
        i: usize,
        apart: &impl Fn(&FixedPoint, &FixedPoint, f64, f64) -> bool,
    ) -> Option<(BigInt, BigInt, f64)> {
        let height = log2(z[i].im.magnitude()) - self.precision as f64;
        if height > radius[i] + MARGIN {
            return Some((z[i].re.clone(), z[i].im.clone(), radius[i]));
        }
        let mirror = FixedPoint { re: z[i].re.clone(), im: -&z[i].im };
        let alone = (0..z.len()).all(|j| j == i || apart(&mirror, &z[j], radius[i], radius[j]));
        // the root of the mirrored disc is the conjugate root, which is in no other disc
        alone.then(|| (z[i].re.clone(), BigInt::zero(), radius[i]))
    }
}

/// `log2 (2^a + 2^b)`.
fn log2_sum(a: f64, b: f64) -> f64 {
    let (high, low) = (a.max(b), a.min(b));
    high + (low - high).exp2().ln_1p() / std::f64::consts::LN_2
}
