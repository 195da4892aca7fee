//! The rotations about a known joint that give three more legs their lengths.
//!
//! With the joint at `a` a leg from `A` to the platform point at `b` from the joint has `u . R b = c`, `u = A - a`,
//! `c = (|b|^2 + |u|^2 - s) / 2`. The first of three legs fixes the angle of `R b_1` and `u_1`, a trilateration. Then
//! `R = E Rz(phi) Ry(theta) Rz(psi) K^T` with frames `E`, `K` that have `u_1` and `b_1` for third axes. The other two
//! legs are forms of bidegree (2, 2) in `z = exp(i phi)` and `y = exp(i psi)`, whose resultant has degree 8. All of it
//! holds over the complex numbers. The roots are found from those of a neighbour when there are some.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use nalgebra::{Matrix3, Vector3};
use num_complex::Complex64;

use super::legs::{complex, perpendicular};
use num::batch::{ComplexBatch, LANES};
use num::poly::{newton_quotients, repulsion};

/// A leg whose platform end is at `b` from the known joint.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arm {
    pub(super) base: Vector3<f64>,
    pub(super) b: Vector3<f64>,
    pub(super) s: Complex64,
}

/// Three legs; the frame of the platform has its third axis along the first arm.
#[derive(Debug, Clone)]
pub(super) struct Three {
    arms: [Arm; 3],
    frame: Matrix3<f64>,
    /// First and second leg have one base joint: four rotations, in closed form.
    common: bool,
}

/// Coefficients of `z^m y^n`, `m` and `n` in -1..=1, shifted by one.
type Form = [[Complex64; 3]; 3];

/// `z` and `y` of a rotation.
pub(super) type ComplexAngles = (Complex64, Complex64);

/// Three legs with the joint in place.
#[derive(Debug, Clone)]
pub(super) struct Setting {
    frame: Matrix3<Complex64>,
    cosine: Complex64,
    sine: Complex64,
    forms: [Form; 2],
}

impl Three {
    /// `None` when the first joint coincides with the known one.
    pub(super) fn new(arms: [Arm; 3]) -> Option<Self> {
        let k = arms[0].b / arms[0].b.norm();
        if !k.iter().all(|x| x.is_finite()) {
            return None;
        }
        let e1 = perpendicular(&k);
        let frame = Matrix3::from_columns(&[e1, k.cross(&e1), k]);
        let common = arms[0].base == arms[1].base;
        Some(Self { arms, frame, common })
    }

    pub(super) fn arms(&self) -> &[Arm; 3] {
        &self.arms
    }

    pub(super) fn common(&self) -> bool {
        self.common
    }

    /// Number of rotations.
    pub(super) fn count(&self) -> usize {
        if self.common { 4 } else { LANES }
    }

    /// `None` where the trilateration of the first arm fails: `u_1 . u_1 = 0`.
    pub(super) fn at(&self, a: &Vector3<Complex64>) -> Option<Setting> {
        let u = complex(&self.arms[0].base) - a;
        let square = u.dot(&u);
        let root = square.sqrt();
        let cosine = angle_term(&self.arms[0], square) / (root * self.arms[0].b.norm());
        let sine = (Complex64::ONE - cosine * cosine).sqrt();
        let frame = frame_of(&(u / root))?;
        let mut setting = Setting { frame, cosine, sine, forms: [[[Complex64::ZERO; 3]; 3]; 2] };
        setting.forms = [1, 2].map(|j| self.form(&setting, &self.arms[j], a));
        Some(setting)
    }

    /// `u . R b - c` of a leg as a form in `z` and `y`.
    pub(super) fn form(&self, setting: &Setting, arm: &Arm, a: &Vector3<Complex64>) -> Form {
        let u = complex(&arm.base) - a;
        let c = angle_term(arm, u.dot(&u));
        let x = setting.frame.tr_mul(&u);
        equation(&x, &(self.frame.tr_mul(&arm.b)), (setting.cosine, setting.sine), c)
    }

    /// All rotations; those of a neighbour in `warm` make it faster, and are replaced.
    pub(super) fn angles(
        &self,
        setting: &Setting,
        warm: &mut Option<ComplexBatch>,
        out: &mut Vec<ComplexAngles>,
    ) {
        out.clear();
        let [f, g] = &setting.forms;
        if self.common {
            common_roots(f, g, out);
        } else {
            *warm = roots_of(f, g, warm.take(), out);
        }
    }

    pub(super) fn rotation(&self, setting: &Setting, (z, y): ComplexAngles) -> Matrix3<Complex64> {
        let (o, l) = (Complex64::ZERO, Complex64::ONE);
        let (c, s) = (setting.cosine, setting.sine);
        let tilt = Matrix3::new(c, o, s, o, l, o, -s, o, c);
        setting.frame * turn(z) * tilt * turn(y) * self.frame.transpose().map(Complex64::from)
    }
}

/// `c` of a leg with `|u|^2` given.
fn angle_term(arm: &Arm, square: Complex64) -> Complex64 {
    (square + arm.b.norm_squared() - arm.s) * 0.5
}

/// Value of a form.
pub(super) fn evaluate(form: &Form, (z, y): ComplexAngles) -> Complex64 {
    let inverse = y.inv();
    let row = |r: &[Complex64; 3]| r[0] * inverse + r[1] + r[2] * y;
    row(&form[0]) / z + row(&form[1]) + row(&form[2]) * z
}

/// Rotation about the third axis by the angle of which `z` is the exponential.
fn turn(z: Complex64) -> Matrix3<Complex64> {
    let inverse = z.inv();
    let (c, s) = ((z + inverse) * 0.5, (z - inverse) * Complex64::new(0.0, -0.5));
    let (o, l) = (Complex64::ZERO, Complex64::ONE);
    Matrix3::new(c, -s, o, s, c, o, o, o, l)
}

/// A complex orthonormal frame with the third axis given.
fn frame_of(axis: &Vector3<Complex64>) -> Option<Matrix3<Complex64>> {
    // the coordinate axis whose cross product is farthest from isotropic: |axis x e_k|^2 = 1 - axis_k^2
    let squares = axis.map(|x| (Complex64::ONE - x * x).norm());
    let mut unit = Vector3::zeros();
    unit[squares.imax()] = Complex64::ONE;
    let v = axis.cross(&unit);
    let e1 = v / v.dot(&v).sqrt();
    let ok = e1.iter().all(|z| z.is_finite());
    ok.then(|| Matrix3::from_columns(&[e1, axis.cross(&e1), *axis]))
}

/// `x^T Rz(phi) Ry(theta) Rz(psi) y - c`.
fn equation(
    x: &Vector3<Complex64>,
    y: &Vector3<f64>,
    (cosine, sine): (Complex64, Complex64),
    c: Complex64,
) -> Form {
    let i = Complex64::I;
    let (right, left) = (x.x + i * x.y, x.x - i * x.y);
    let (up, down) = (Complex64::new(y.x, y.y), Complex64::new(y.x, -y.y));
    let (sum, gap) = ((cosine + 1.0) * 0.25, (cosine - 1.0) * 0.25);
    let half = sine * 0.5;
    [
        [sum * right * down, half * right * y.z, gap * right * up],
        [-half * x.z * down, cosine * x.z * y.z - c, -half * x.z * up],
        [gap * left * down, half * left * y.z, sum * left * up],
    ]
}

fn product<const A: usize, const B: usize, const C: usize>(
    p: &[Complex64; A],
    q: &[Complex64; B],
) -> [Complex64; C] {
    let mut out = [Complex64::ZERO; C];
    for (i, x) in p.iter().enumerate() {
        for (j, y) in q.iter().enumerate() {
            out[i + j] += x * y;
        }
    }
    out
}

fn minus<const N: usize>(p: [Complex64; N], q: [Complex64; N]) -> [Complex64; N] {
    std::array::from_fn(|k| p[k] - q[k])
}

fn value(p: &[Complex64], z: Complex64) -> Complex64 {
    p.iter().rev().fold(Complex64::ZERO, |v, c| v * z + c)
}

/// Common roots of two forms; with `f = f0 / y + f1 + f2 y` and brackets `[ij] = f_i g_j - f_j g_i` the resultant is
/// `[20]^2 - [21] [10]` and the root `y = -[20] / [21] = -[10] / [20]`.
fn roots_of(
    f: &Form,
    g: &Form,
    start: Option<ComplexBatch>,
    out: &mut Vec<ComplexAngles>,
) -> Option<ComplexBatch> {
    let column = |h: &Form, n: usize| -> [Complex64; 3] { [h[0][n], h[1][n], h[2][n]] };
    let a = [0, 1, 2].map(|n| column(f, n));
    let b = [0, 1, 2].map(|n| column(g, n));
    let bracket = |i: usize, j: usize| -> [Complex64; 5] {
        minus(product::<3, 3, 5>(&a[i], &b[j]), product::<3, 3, 5>(&a[j], &b[i]))
    };
    let (outer, upper, lower) = (bracket(2, 0), bracket(2, 1), bracket(1, 0));
    let resultant: [Complex64; LANES + 1] = minus(product(&outer, &outer), product(&upper, &lower));
    let roots = octic_roots(&resultant, start)?;
    out.extend((0..LANES).map(|k| {
        let z = roots.lane(k);
        let (outer, upper, lower) = (value(&outer, z), value(&upper, z), value(&lower, z));
        (z, if upper.norm_sqr() >= lower.norm_sqr() { -outer / upper } else { -lower / outer })
    }));
    Some(roots)
}

/// The first form is free of `z`: two `y`, two `z` for each, in this order.
fn common_roots(f: &Form, g: &Form, out: &mut Vec<ComplexAngles>) {
    for y in quadratic(f[1]) {
        let row = |m: usize| value(&g[m], y);
        out.extend(quadratic([row(0), row(1), row(2)]).map(|z| (z, y)));
    }
}

/// Roots of `c0 + c1 z + c2 z^2`.
fn quadratic(c: [Complex64; 3]) -> [Complex64; 2] {
    let root = (c[1] * c[1] - c[0] * c[2] * 4.0).sqrt();
    let sign = if (c[1].conj() * root).re >= 0.0 { 1.0 } else { -1.0 };
    let q = (c[1] + root * sign) * -0.5;
    [q / c[2], c[0] / q]
}

/// Sweeps before giving up; from the roots of a neighbour three or four do.
const SWEEPS: usize = 40;
/// Relative correction below which a root has settled; the next one would be of the order of its cube.
const ACCURACY: f64 = 1e-6;

/// Roots of `c[0] + .. + c[8] x^8`, `None` when an end coefficient is zero or not finite.
///
/// Ehrlich-Aberth iteration on all roots side by side; multiple roots are left after [`SWEEPS`] as near as they came.
/// `start` must be eight different numbers; without it points of a circle are taken.
fn octic_roots(c: &[Complex64; LANES + 1], start: Option<ComplexBatch>) -> Option<ComplexBatch> {
    let usable = c.iter().all(|z| z.is_finite()) && c[0].norm() > 0.0 && c[LANES].norm() > 0.0;
    if !usable {
        return None;
    }
    let mut z = start.unwrap_or_else(|| circle((c[0].norm() / c[LANES].norm()).powf(1.0 / LANES as f64)));
    for _ in 0..SWEEPS {
        // N / (1 - N sum 1 / (z_k - z_j)), N = p / p'
        let [top, bottom] = newton_quotients(c, &z);
        let step = top * (bottom - top * repulsion(&z)).reciprocal();
        let (moved, size) = (step.norm_sqr(), z.norm_sqr());
        let finite = moved.map(f64::is_finite);
        // two roots in one place repel each other infinitely: they stay
        z = z - step.select(ComplexBatch::ZERO, finite);
        if (0..LANES).all(|k| !finite[k] || moved[k] <= ACCURACY * ACCURACY * size[k]) {
            break;
        }
    }
    z.norm_sqr().iter().all(|n| n.is_finite()).then_some(z)
}

/// Eight points of a circle, not symmetric to the real axis.
fn circle(radius: f64) -> ComplexBatch {
    let mut z = ComplexBatch::ZERO;
    for k in 0..LANES {
        let point = Complex64::from_polar(radius * (1.0 + 0.01 * k as f64), 0.4 + 0.785 * k as f64);
        (z.re[k], z.im[k]) = (point.re, point.im);
    }
    z
}

#[cfg(test)]
mod tests {
    use super::*;
    use num::Rng;

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
