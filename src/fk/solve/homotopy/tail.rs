//! The last part of a path with 256 bits.
//!
//! A nearly special platform has paths that seem to go to infinity, to `e.e = 0` or to a double root. They turn off
//! only when `t` is as small as a power of the platform's distance from the special one. In doubles such a `t` cannot
//! be told from 0. Here points, sections and residuals have 256 bits. Directions (Taylor series, inverse of the
//! Jacobian) are computed in doubles as long as these lead on. The unit of length makes `|e| = |g|`, so that ends at
//! infinity are points like others: with `e = eps e'` an equation without `g.g` is divided by `eps`.

use num_complex::Complex64;
use pulp::Scalar;

use super::lanes::{Lanes, Vec8, norm_sqr};
use super::lu::Lu;
use super::paths::EndKind;
use super::system::{ORDER, SectionHomotopy, blank_series, derivative_matrix, taylor};
use crate::solve::octuple_sections::OctupleSections;
use crate::solve::sections::{FORMS, FormRow, Sections, forms};
use num::octuple::{ComplexOctuple, Octuple, OctupleLu};

/// Values of the forms.
type Forms17 = [ComplexOctuple; FORMS];

/// Powers of `e` in the forms, which are quadratic in `(e, g)`.
const DEGREE: [i32; FORMS] = [2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 1, 1, 1, 1, 1, 1, 0];
/// Size of the last Taylor term aimed at.
const PREDICTION: f64 = 1e-3;
/// Largest step as a fraction of the estimated radius of convergence.
const RADIUS_FRACTION: f64 = 0.5;
/// A first correction larger than this rejects the step.
const CAPTURE: f64 = 2e-2;
/// A correction below this lets the path go on.
const ACCURACY: f64 = 1e-8;
/// Most corrections a step.
const CORRECTIONS: u32 = 6;
/// Lengths tried of a step.
const TRIALS: u32 = 5;
/// Most steps of a path.
const MOST_STEPS: u32 = 500;
/// Corrections at the target end here.
const SETTLED: f64 = 1e-55;
/// A path that has not arrived at this `t` ends in a singular point: the sections are known to `1e-75`.
const SMALLEST: f64 = 1e-50;
/// The smallest `t` at which sizes are recorded that show, with those at the end, the power of `t` with which they
/// fall.
const LATE: f64 = 1e-40;
/// `e.e` or `e` below this, relative, at an end that is known to [`SETTLED`] counts as zero.
const ZERO: f64 = 1e-40;
/// Smallest power of `t` with which something is taken to go to zero: winding numbers are less than fifty.
const FALL: f64 = 0.02;

/// `C(t) = C_0 + t slope`, `C_0` and `slope` real, `t` on the line from the corner to 0.
pub(super) struct CornerTail {
    target: [[Octuple; FORMS]; 6],
    slope: [[Octuple; FORMS]; 6],
    corner: ComplexOctuple,
}

/// The end of a path, `(e, g)` with 256 bits.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TailEnd {
    pub x: [ComplexOctuple; 8],
    /// Newton's method converged at the target; otherwise the point stands at a `t` of [`SMALLEST`] or where the path
    /// broke off.
    pub(crate) arrived: bool,
    /// The remaining `t`.
    pub remaining: f64,
    pub steps: u32,
    pub rejections: u32,
    /// Smallest over largest pivot modulus of the Jacobian at the end, unit of length as above.
    pub pivot_ratio: f64,
    /// The remaining `t`, `|e| / |(e, g)|` and `|e.e| / |e|^2`, farther back on the path.
    earlier: (f64, Smallness),
}

/// `|e| / |(e, g)|` and `|e.e| / |e|^2`.
#[derive(Debug, Clone, Copy)]
struct Smallness {
    rotation: f64,
    isotropy: f64,
}

impl Smallness {
    fn of(x: &[ComplexOctuple; 8]) -> Self {
        let (e, g) = (size(&x[..4]), size(&x[4..]));
        let n = x[..4].iter().fold(ComplexOctuple::ZERO, |sum, z| sum + *z * *z);
        let ratio = |a: Octuple, b: Octuple| (a / b).rounded().sqrt();
        Self { rotation: ratio(e, e + g), isotropy: ratio(n.norm_sqr(), e * e) }
    }
}

impl TailEnd {
    /// The kind of the end, as far as 256 bits tell. At a point where the path arrives `e.e` and `e` are known to far
    /// more digits than [`ZERO`] asks for. Otherwise it decides by whether these quantities go to zero with a power of
    /// `t`.
    pub(crate) fn kind(&self) -> EndKind {
        let here = Smallness::of(&self.x);
        let vanishes: [bool; 2] = if self.arrived {
            [here.rotation < ZERO, here.isotropy < ZERO]
        } else if self.remaining < SMALLEST {
            let decades = (self.earlier.0 / self.remaining).log10();
            let falls = |then: f64, now: f64| !((then / now).log10() < FALL * decades);
            [falls(self.earlier.1.rotation, here.rotation), falls(self.earlier.1.isotropy, here.isotropy)]
        } else {
            return EndKind::Failed;
        };
        match vanishes {
            [true, _] => EndKind::Infinite,
            [_, true] => EndKind::Isotropic,
            _ if self.arrived => EndKind::Regular,
            _ => EndKind::Singular,
        }
    }

    /// The end in doubles, norm one.
    pub(crate) fn rounded(&self) -> [Complex64; 8] {
        let mut x = self.x;
        normalised(&mut x);
        let x = x.map(ComplexOctuple::rounded);
        let norm = x.iter().map(Complex64::norm_sqr).sum::<f64>().sqrt();
        x.map(|z| z / norm)
    }

    /// A path that did not come so far.
    pub(super) fn lost(x: &[Complex64; 8]) -> Self {
        let x = x.map(Into::into);
        let earlier = (1.0, Smallness { rotation: 1.0, isotropy: 1.0 });
        Self { x, arrived: false, remaining: 1.0, steps: 0, rejections: 0, pivot_ratio: 0.0, earlier }
    }
}

/// A point with its unit of length: `e = 2^exponent e'`, `y = (e', g)` of norm about one.
#[derive(Debug, Clone, Copy)]
struct Scaled {
    y: [Complex64; 8],
    exponent: i32,
}

fn size(x: &[ComplexOctuple]) -> Octuple {
    x.iter().fold(Octuple::ZERO, |sum, z| sum + z.norm_sqr())
}

/// Half the binary logarithm of a positive number.
fn half_log(x: Octuple) -> i32 {
    x.exponent().div_euclid(2)
}

/// The point scaled by a power of two to norm about one in its unit of length.
fn normalised(x: &mut [ComplexOctuple; 8]) -> Scaled {
    let (e, g) = (size(&x[..4]), size(&x[4..]));
    // e is small or large against g: the unit of length follows while e is the smaller one
    let (e_log, g_log) = (half_log(e), if g.is_zero() { i32::MIN / 4 } else { half_log(g) });
    let exponent = (e_log - g_log).min(0);
    let shift = -(e_log - exponent);
    for z in x.iter_mut() {
        *z = z.scaled(shift);
    }
    let y = std::array::from_fn(|k| if k < 4 { x[k].scaled(-exponent) } else { x[k] }.rounded());
    Scaled { y, exponent }
}

/// The gradient of a section by `(e, g)`.
fn gradient(row: &[ComplexOctuple; FORMS], x: &[ComplexOctuple; 8]) -> [ComplexOctuple; 8] {
    let r = row;
    let (e, g) = x.split_at(4);
    let (m, n) = ([r[10], r[11], r[12]], [r[13], r[14], r[15]]);
    let matrix = [
        [r[0], r[1], r[2], r[3]],
        [r[1], r[4], r[5], r[6]],
        [r[2], r[5], r[7], r[8]],
        [r[3], r[6], r[8], r[9]],
    ];
    let mut out = [ComplexOctuple::ZERO; 8];
    for k in 0..4 {
        out[k] = (0..4).fold(ComplexOctuple::ZERO, |sum, l| sum + matrix[k][l] * e[l]).scaled(1);
        out[4 + k] = (r[16] * g[k]).scaled(1);
    }
    for k in 0..3 {
        let (a, b) = ((k + 1) % 3, (k + 2) % 3);
        out[0] = out[0] + m[k] * g[1 + k];
        out[1 + k] = out[1 + k] - m[k] * g[0] + g[1 + a] * n[b] - g[1 + b] * n[a];
        out[4] = out[4] - m[k] * e[1 + k];
        out[5 + k] = out[5 + k] + m[k] * e[0] + n[a] * e[1 + b] - n[b] * e[1 + a];
    }
    out
}

impl CornerTail {
    /// The path from `start`, as in doubles, to `target`; its corner is that of the homotopy in doubles.
    pub(super) fn new(start: &Sections, target: &OctupleSections, corner: Complex64) -> Self {
        let mut slope = target.rows;
        for i in 0..6 {
            for k in 0..FORMS {
                slope[i][k] = Octuple::from(start.rows[i][k].re) - target.rows[i][k];
            }
        }
        Self { target: target.rows, slope, corner: corner.into() }
    }

    /// Values of the six sections and of `e.g` at `t = parameter corner`.
    fn residual(&self, x: &[ComplexOctuple; 8], parameter: ComplexOctuple) -> [ComplexOctuple; 7] {
        let forms = forms(*x);
        let t = parameter * self.corner;
        let mut out = [ComplexOctuple::ZERO; 7];
        for i in 0..6 {
            let (mut fixed, mut moving) = (ComplexOctuple::ZERO, ComplexOctuple::ZERO);
            for k in 0..FORMS {
                fixed = fixed + forms[k].times(self.target[i][k]);
                moving = moving + forms[k].times(self.slope[i][k]);
            }
            out[i] = fixed + t * moving;
        }
        for k in 0..4 {
            out[6] = out[6] + x[k] * x[4 + k];
        }
        out
    }

    /// The homotopy in doubles in the unit of length `2^-exponent`, its parameter counted in `at`: 1 is there, 0 the
    /// target.
    fn rounded(&self, exponent: i32, at: Octuple) -> SectionHomotopy {
        let factor = self.corner.times(at);
        let row = |i: usize| if i < 5 { exponent } else { 0 };
        let shift = |i: usize, k: usize| exponent * DEGREE[k] - row(i);
        let target: [FormRow; 6] = std::array::from_fn(|i| {
            std::array::from_fn(|k| {
                // the first five equations have no g.g
                if i < 5 && DEGREE[k] == 0 {
                    Complex64::ZERO
                } else {
                    self.target[i][k].scaled(shift(i, k)).rounded().into()
                }
            })
        });
        let slope: [FormRow; 6] = std::array::from_fn(|i| {
            std::array::from_fn(|k| {
                if i < 5 && DEGREE[k] == 0 {
                    Complex64::ZERO
                } else {
                    factor.times(self.slope[i][k]).scaled(shift(i, k)).rounded()
                }
            })
        });
        SectionHomotopy::line(&target, &slope)
    }

    /// The Jacobian at `parameter corner`, the patch of the present unit of length in the last row.
    fn jacobian(
        &self,
        x: &[ComplexOctuple; 8],
        exponent: i32,
        parameter: Octuple,
    ) -> [[ComplexOctuple; 8]; 8] {
        let t = self.corner.times(parameter);
        let mut j = [*x; 8];
        for i in 0..6 {
            let row = std::array::from_fn(|k| {
                let moved = t.times(self.slope[i][k]);
                ComplexOctuple { re: moved.re + self.target[i][k], im: moved.im }
            });
            j[i] = gradient(&row, x);
        }
        for k in 0..4 {
            (j[6][k], j[6][4 + k]) = (x[4 + k], x[k]);
            (j[7][k], j[7][4 + k]) = (x[k].conj().scaled(-2 * exponent), x[4 + k].conj());
        }
        j
    }

    /// Taylor coefficients as of [`taylor`], with all digits, in the parameter that is 1 at `at`.
    fn series(
        &self,
        x: &[ComplexOctuple; 8],
        lu: &OctupleLu<8>,
        at: Octuple,
    ) -> [[ComplexOctuple; 8]; ORDER] {
        let factor = self.corner.times(at);
        // F(x, y) of forms with the values `own` and `other` at x and y
        let polar =
            |x: &[ComplexOctuple; 8], own: &Forms17, y: &[ComplexOctuple; 8], other: &Forms17| -> Forms17 {
                let sum = forms(std::array::from_fn(|k| x[k] + y[k]));
                std::array::from_fn(|n| sum[n] - own[n] - other[n])
            };
        let study = |x: &[ComplexOctuple; 8], y: &[ComplexOctuple; 8]| {
            (0..4).fold(ComplexOctuple::ZERO, |sum, k| sum + x[k] * y[4 + k] + y[k] * x[4 + k])
        };
        let along = |rows: &[[Octuple; FORMS]; 6], i: usize, forms: &[ComplexOctuple; FORMS]| {
            (0..FORMS).fold(ComplexOctuple::ZERO, |sum, k| sum + forms[k].times(rows[i][k]))
        };
        let mut series = [[ComplexOctuple::ZERO; 8]; ORDER];
        let at_point = forms(*x);
        let mut at_terms = [at_point; ORDER];
        let mut full = at_point;
        for k in 1..=ORDER {
            let mut inner = [ComplexOctuple::ZERO; FORMS];
            let mut crossed = ComplexOctuple::ZERO;
            for i in 1..=k / 2 {
                let (a, b) = (&series[i - 1], &series[k - i - 1]);
                // half of F(a, a) is the form at a
                let (f, half) = if 2 * i == k {
                    (at_terms[i - 1], -1)
                } else {
                    (polar(a, &at_terms[i - 1], b, &at_terms[k - i - 1]), 0)
                };
                for n in 0..FORMS {
                    inner[n] = inner[n] + f[n];
                }
                crossed = crossed + study(a, b).scaled(half);
            }
            let moving: [ComplexOctuple; FORMS] = std::array::from_fn(|n| full[n] + inner[n]);
            let mut rhs = [ComplexOctuple::ZERO; 8];
            for i in 0..6 {
                rhs[i] = -(along(&self.target, i, &inner) + factor * along(&self.slope, i, &moving));
            }
            rhs[6] = -crossed;
            series[k - 1] = lu.solve(&rhs);
            at_terms[k - 1] = forms(series[k - 1]);
            let f = polar(x, &at_point, &series[k - 1], &at_terms[k - 1]);
            full = std::array::from_fn(|n| inner[n] + f[n]);
        }
        series
    }

    /// [`correct`](Self::correct) with all digits for the corrections as well.
    fn correct_precisely(
        &self,
        x: &mut [ComplexOctuple; 8],
        exponent: i32,
        parameter: Octuple,
        accuracy: f64,
    ) -> Option<f64> {
        let mut last = CAPTURE;
        for _ in 0..2 * CORRECTIONS {
            let lu = OctupleLu::factorise(self.jacobian(x, exponent, parameter))?;
            let residual = self.residual(x, ComplexOctuple { re: parameter, im: Octuple::ZERO });
            let b = std::array::from_fn(|i| if i < 7 { residual[i] } else { ComplexOctuple::ZERO });
            let delta = lu.solve(&b);
            let length = (size(&delta[..4]).scaled(-2 * exponent) + size(&delta[4..])).rounded().sqrt();
            if !(length <= last) {
                return None;
            }
            for k in 0..8 {
                x[k] = x[k] - delta[k];
            }
            if length <= accuracy {
                return Some(lu.pivot_ratio());
            }
            last = 0.3 * length;
        }
        None
    }

    /// Newton's method at `parameter` from `x` on the patch of `scaled`; the last correction and pivot ratio when the
    /// corrections go below `accuracy`. The Jacobian is that of the rounded point and computed once.
    fn correct(
        &self,
        x: &mut [ComplexOctuple; 8],
        exponent: i32,
        parameter: Octuple,
        capture: f64,
        accuracy: f64,
    ) -> Option<f64> {
        let simd = Scalar::new();
        let homotopy = self.rounded(exponent, parameter);
        let rows = homotopy.rows_at(Lanes::splat(simd, Complex64::ONE));
        let mut last = capture;
        let mut pivots = 0.0;
        let mut lu: Option<Lu<Scalar>> = None;
        let most = if accuracy < ACCURACY { 8 * CORRECTIONS } else { CORRECTIONS };
        for round in 0..most {
            if round < 3 || lu.is_none() {
                let y: Vec8<Scalar> = std::array::from_fn(|k| {
                    let z = if k < 4 { x[k].scaled(-exponent) } else { x[k] };
                    Lanes::splat(simd, z.rounded())
                });
                let patch = y.map(Lanes::conj);
                let factors = Lu::factorise(derivative_matrix(&rows, &y, &patch));
                pivots = factors.pivot_ratio()[0];
                lu = Some(factors);
            }
            let residual = self.residual(x, ComplexOctuple { re: parameter, im: Octuple::ZERO });
            // corrections far below the range of doubles are as good as those at its end
            let lift = residual.iter().map(ComplexOctuple::exponent).max().unwrap_or(0).max(-900);
            let value = |i: usize| {
                let row = if i < 5 || i == 6 { exponent } else { 0 };
                residual[i].scaled(-row - lift).rounded()
            };
            let b: Vec8<Scalar> =
                std::array::from_fn(|i| Lanes::splat(simd, if i < 7 { value(i) } else { Complex64::ZERO }));
            let delta = lu.as_ref()?.solve(b);
            let length = norm_sqr(&delta).sqrt() * 2f64.powi(lift);
            if !(length <= last) {
                return None;
            }
            for k in 0..8 {
                let step =
                    ComplexOctuple::from(delta[k].lane(0)).scaled(lift + if k < 4 { exponent } else { 0 });
                x[k] = x[k] - step;
            }
            if length <= accuracy {
                return Some(pivots);
            }
            last = 0.3 * length;
        }
        None
    }

    /// Taylor coefficients in the unit of length of the point, computed in doubles.
    fn rough_series(&self, scaled: &Scaled, at: Octuple) -> [[Complex64; 8]; ORDER] {
        let simd = Scalar::new();
        let homotopy = self.rounded(scaled.exponent, at);
        let one = Lanes::splat(simd, Complex64::ONE);
        let y: Vec8<Scalar> = scaled.y.map(|z| Lanes::splat(simd, z));
        let inverse = norm_sqr(&y).recip();
        let patch = y.map(|z| z.conj().times(inverse));
        let lu = Lu::factorise(derivative_matrix(&homotopy.rows_at(one), &y, &patch));
        let mut series = blank_series(simd);
        taylor(&homotopy, one, &y, &mut series, |b| *b = lu.solve(*b));
        series.map(|c| c.map(|z| z.lane(0)))
    }

    /// The Taylor series computed with all digits, then rounded.
    fn precise_series(
        &self,
        x: &[ComplexOctuple; 8],
        exponent: i32,
        at: Octuple,
    ) -> Option<[[Complex64; 8]; ORDER]> {
        let lu = OctupleLu::factorise(self.jacobian(x, exponent, at))?;
        let in_unit = |c: [ComplexOctuple; 8]| {
            std::array::from_fn(|k| if k < 4 { c[k].scaled(-exponent) } else { c[k] }.rounded())
        };
        Some(self.series(x, &lu, at).map(in_unit))
    }

    /// Follows the path that stands at `x`, `parameter` times the corner, to the target.
    pub(super) fn follow(&self, x: &[Complex64; 8], parameter: f64) -> TailEnd {
        let mut x: [ComplexOctuple; 8] = x.map(Into::into);
        let mut at = Octuple::from(parameter);
        let mut end = TailEnd { x, remaining: parameter, ..TailEnd::lost(&[Complex64::ZERO; 8]) };
        let scaled = normalised(&mut x);
        if self.correct(&mut x, scaled.exponent, at, CAPTURE, ACCURACY).is_none() {
            return end;
        }
        let (mut caution, mut precise) = (1.0_f64, false);
        while end.steps + end.rejections < MOST_STEPS {
            let scaled = normalised(&mut x);
            let exponent = scaled.exponent;
            let Some(series) = (if precise {
                self.precise_series(&x, exponent, at)
            } else {
                Some(self.rough_series(&scaled, at))
            }) else {
                break;
            };
            // back towards the target by `step`, in units of the present parameter
            let length = |c: &[Complex64; 8]| c.iter().map(Complex64::norm_sqr).sum::<f64>().sqrt();
            let (last, earlier) = (length(&series[ORDER - 1]), length(&series[ORDER - 2]));
            let by_error = (PREDICTION / last).powf(1.0 / ORDER as f64);
            let mut accepted = false;
            for _ in 0..TRIALS {
                let step = by_error.min(RADIUS_FRACTION * earlier / last) * caution;
                let step = if step >= 1.0 { 1.0 } else { step.min(0.9) };
                if !(step > 1e-9) {
                    break;
                }
                let mut guess = x;
                for k in 0..8 {
                    let mut sum = Complex64::ZERO;
                    for c in series.iter().rev() {
                        sum = (sum + c[k]) * -step;
                    }
                    guess[k] = guess[k] + ComplexOctuple::from(sum).scaled(if k < 4 { exponent } else { 0 });
                }
                let arrives = step >= 1.0;
                let next = if arrives { Octuple::ZERO } else { at * Octuple::from(1.0 - step) };
                let accuracy = if arrives { SETTLED } else { ACCURACY };
                let corrected = if precise {
                    self.correct_precisely(&mut guess, exponent, next, accuracy)
                } else {
                    self.correct(&mut guess, exponent, next, CAPTURE, accuracy)
                };
                if let Some(pivots) = corrected {
                    (x, at, end.pivot_ratio, accepted) = (guess, next, pivots, true);
                    end.steps += 1;
                    end.arrived = arrives;
                    caution = (2.0 * caution).min(1.0);
                    break;
                }
                end.rejections += 1;
                caution *= 0.4;
            }
            (end.x, end.remaining) = (x, at.rounded());
            if end.remaining > LATE {
                end.earlier = (end.remaining, Smallness::of(&x));
            }
            if end.arrived || end.remaining < SMALLEST || (!accepted && precise) {
                break;
            }
            if !accepted {
                // the Jacobian is too nearly singular for doubles, here and from here on
                (precise, caution) = (true, 1.0);
            }
        }
        end
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num::Rng;

    #[test]
    fn gradients_and_series_belong_to_the_residual() {
        let rng = &mut Rng::new(0x7a11);
        let row = |rng: &mut Rng| std::array::from_fn(|_| Complex64::new(rng.normal(), 0.0));
        let sections = |rng: &mut Rng| Sections { rows: std::array::from_fn(|_| row(rng)) }.graded().unwrap();
        let (start, aim) = (sections(rng), sections(rng));
        let target = OctupleSections { rows: aim.rows.map(|r| r.map(|z| Octuple::from(z.re))) };
        let tail = CornerTail::new(&start, &target, Complex64::new(0.5, 0.2));
        let x: [ComplexOctuple; 8] =
            std::array::from_fn(|_| ComplexOctuple::from(Complex64::new(rng.normal(), rng.normal())));
        let at = Octuple::from(0.01);
        let parameter = ComplexOctuple { re: at, im: Octuple::ZERO };
        let (j, f) = (tail.jacobian(&x, 0, at), tail.residual(&x, parameter));
        // Euler: x . grad q = 2 q
        for i in 0..7 {
            let product = (0..8).fold(ComplexOctuple::ZERO, |sum, k| sum + j[i][k] * x[k]);
            assert!((product - f[i].scaled(1)).norm_sqr().rounded() < 1e-140);
        }
        // the series keeps the residual to its order
        let lu = OctupleLu::factorise(j).unwrap();
        let series = tail.series(&x, &lu, at);
        let change = |h: f64| {
            let mut y = x;
            for (power, c) in (1..).zip(&series) {
                let power = Octuple::from(h.powi(power));
                for p in 0..8 {
                    y[p] = y[p] + c[p].times(power);
                }
            }
            let moved = ComplexOctuple { re: at * Octuple::from(1.0 + h), im: Octuple::ZERO };
            let there = tail.residual(&y, moved);
            (0..7).map(|i| (there[i] - f[i]).norm_sqr().rounded().sqrt()).fold(0.0, f64::max)
        };
        // powers of two: 1 + h is exact
        let order = (change(2f64.powi(-12)) / change(2f64.powi(-13))).log2();
        assert!((order - (ORDER as f64 + 1.0)).abs() < 0.3, "{order}");
    }
}
