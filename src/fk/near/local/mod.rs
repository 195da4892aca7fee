//! The leg equations about a pose, exactly quadratic, with their Newton step and second-order bound.
//!
//! With the pose as frame (`B = R b`, `A = a - q`, `D = B - A`; `q` the platform centroid) a nearby pose is a dual
//! quaternion `(1, w; g0, h)`, and
//!
//! ```text
//! f_i = D.D - s  over 2,          f_i(w, h, g0) = f_i + D.h + 2 (B x D).w + Q_i,
//! Q_i = g0^2/2 - g0 D.w + h.h/2 + w.((A + B) x h) + w.W_i w + f_i w.w,   W_i = 2 A.B I - (A B^T + B A^T),
//! f_7 = g0 + w.h.
//! ```

use super::{NearSolver, ScaledPose};
use num::vector::{cross, dot};

type Vector = [f64; 3];
type Matrix6 = [[f64; 6]; 6];

#[inline]
fn norm(a: &Vector) -> f64 {
    dot(a, a).sqrt()
}

/// The legs at a pose, and the defects `f_i` against target squares.
pub(super) struct LegDefects {
    a: [Vector; 6],
    b: [Vector; 6],
    d: [Vector; 6],
    f: [f64; 6],
    squares: [f64; 6],
}

impl LegDefects {
    #[inline]
    pub(super) fn at(solver: &NearSolver, place: &ScaledPose, target: &[f64; 6]) -> Self {
        let r = &place.rotation;
        let mut out =
            Self { a: [[0.0; 3]; 6], b: [[0.0; 3]; 6], d: [[0.0; 3]; 6], f: [0.0; 6], squares: [0.0; 6] };
        for i in 0..6 {
            for k in 0..3 {
                out.b[i][k] = dot(&r[k], &solver.platform[i]);
                out.a[i][k] = solver.base[i][k] - place.position[k];
                out.d[i][k] = out.b[i][k] - out.a[i][k];
            }
            out.squares[i] = dot(&out.d[i], &out.d[i]);
            out.f[i] = 0.5 * (out.squares[i] - target[i]);
        }
        out
    }

    /// Rows `[D, 2 B x D]`, columns `(h, w)`.
    #[inline]
    fn jacobian(&self) -> Matrix6 {
        let mut j = [[0.0; 6]; 6];
        for i in 0..6 {
            let m = cross(&self.b[i], &self.d[i]);
            let d = self.d[i];
            j[i] = [d[0], d[1], d[2], 2.0 * m[0], 2.0 * m[1], 2.0 * m[2]];
        }
        j
    }

    /// Squared lengths when `part` of the defect has been made up for.
    pub(super) fn squares_after(&self, part: f64) -> [f64; 6] {
        std::array::from_fn(|i| self.squares[i] - 2.0 * part * self.f[i])
    }

    /// Largest `|D.D - s|`, NaN when one is.
    pub(super) fn largest_defect(&self) -> f64 {
        self.f.iter().fold(0.0, |m: f64, f| if f.is_nan() { f64::NAN } else { m.max(2.0 * f.abs()) })
    }

    /// The Newton step; `None` when the Jacobian is singular.
    #[inline]
    pub(super) fn newton(&self) -> Option<Newton> {
        let mut j = self.jacobian();
        let mut x = self.f.map(|f| -f);
        eliminate(&mut j, &mut x)?;
        Some(Newton { step: x })
    }
}

/// A step `(h, w)`.
pub(super) struct Newton {
    pub(super) step: [f64; 6],
}

impl Newton {
    fn parts(&self) -> (Vector, Vector) {
        let [h0, h1, h2, w0, w1, w2] = self.step;
        ([h0, h1, h2], [w0, w1, w2])
    }

    /// `max(|h|, |w|)`.
    pub(super) fn size(&self) -> f64 {
        let (h, w) = self.parts();
        let (h, w) = (norm(&h), norm(&w));
        if h.is_nan() || w.is_nan() { f64::NAN } else { h.max(w) }
    }

    /// `R <- Cay(w) R`, `q <- q + (h + w x h + (w.h) w) / (1 + w.w)`: the dual quaternion `(1, w; -w.h, h)`.
    #[inline]
    pub(super) fn applied_to(&self, place: &ScaledPose) -> ScaledPose {
        let (h, w) = self.parts();
        let (ww, wh, turn) = (dot(&w, &w), dot(&w, &h), cross(&w, &h));
        let scale = 1.0 / (1.0 + ww);
        let mut out = *place;
        for k in 0..3 {
            out.position[k] += (h[k] + turn[k] + wh * w[k]) * scale;
        }
        let [x, y, z] = w;
        let cay = [
            [1.0 - ww + 2.0 * x * x, 2.0 * (x * y - z), 2.0 * (x * z + y)],
            [2.0 * (x * y + z), 1.0 - ww + 2.0 * y * y, 2.0 * (y * z - x)],
            [2.0 * (x * z - y), 2.0 * (y * z + x), 1.0 - ww + 2.0 * z * z],
        ];
        let r = &place.rotation;
        for (row, c) in out.rotation.iter_mut().zip(&cay) {
            *row = [0, 1, 2].map(|j| (c[0] * r[0][j] + c[1] * r[1][j] + c[2] * r[2][j]) * scale);
        }
        out.rotation = reorthogonalised(&out.rotation);
        out
    }
}

/// `R (3 I - R^T R) / 2`: squares the defect of `R^T R = I`.
#[inline]
fn reorthogonalised(r: &[Vector; 3]) -> [Vector; 3] {
    let column = |j: usize| [r[0][j], r[1][j], r[2][j]];
    let c = [column(0), column(1), column(2)];
    let half = |i: usize, j: usize| 0.5 * dot(&c[i], &c[j]);
    let (xy, xz, yz) = (half(0, 1), half(0, 2), half(1, 2));
    let (xx, yy, zz) = (1.5 - half(0, 0), 1.5 - half(1, 1), 1.5 - half(2, 2));
    [0, 1, 2].map(|i| {
        let [x, y, z] = r[i];
        [x * xx - y * xy - z * xz, y * yy - x * xy - z * yz, z * zz - x * xz - y * yz]
    })
}

/// The place with its matrix made a rotation; `None` if it is off a rotation by more than `1e-6`, mirror images
/// included.
pub(super) fn orthonormal(place: &ScaledPose) -> Option<ScaledPose> {
    let r = &place.rotation;
    let mut worst = 0.0_f64;
    for i in 0..3 {
        for j in 0..3 {
            let error = (dot(&r[i], &r[j]) - if i == j { 1.0 } else { 0.0 }).abs();
            worst = if error.is_nan() { f64::NAN } else { worst.max(error) };
        }
    }
    let proper = dot(&cross(&r[0], &r[1]), &r[2]) > 0.0;
    let finite = place.position.iter().all(|x| x.is_finite());
    let valid = worst <= 1e-6 && proper && finite;
    valid.then(|| ScaledPose { rotation: reorthogonalised(&reorthogonalised(r)), ..*place })
}

/// `max(|w|, |h|, |g0| / epsilon)` of the second place seen from the first; infinite for half a turn.
pub(super) fn distance(from: &ScaledPose, to: &ScaledPose, epsilon: f64) -> f64 {
    let (r, t) = (&from.rotation, &to.rotation);
    let entry = |i: usize, j: usize| dot(&t[i], &r[j]); // of t r^T
    let trace = 1.0 + entry(0, 0) + entry(1, 1) + entry(2, 2);
    let w = [
        (entry(2, 1) - entry(1, 2)) / trace,
        (entry(0, 2) - entry(2, 0)) / trace,
        (entry(1, 0) - entry(0, 1)) / trace,
    ];
    let p: Vector = std::array::from_fn(|k| to.position[k] - from.position[k]);
    let turn = cross(&p, &w);
    let h: Vector = std::array::from_fn(|k| p[k] + turn[k]);
    let all = [norm(&w), norm(&h), dot(&p, &w).abs() / epsilon];
    if trace > 0.0 && all.iter().all(|x| x.is_finite()) {
        all.into_iter().fold(0.0, f64::max)
    } else {
        f64::INFINITY
    }
}

/// Angle and length of the motion from one place to another.
pub(super) fn motion(from: &ScaledPose, to: &ScaledPose) -> (f64, f64) {
    let (r, t) = (&from.rotation, &to.rotation);
    // |t - r|_F = 2 sqrt 2 sin(angle / 2)
    let chord: f64 = (0..9).map(|k| (t[k / 3][k % 3] - r[k / 3][k % 3]).powi(2)).sum();
    let sine = (chord / 8.0).sqrt();
    let angle = if sine < 1.0 { 2.0 * sine.asin() } else { std::f64::consts::PI };
    let p: Vector = std::array::from_fn(|k| to.position[k] - from.position[k]);
    (angle, norm(&p))
}

/// Takes up the rounding of fewer than a thousand operations on numbers that are not negative.
const UP: f64 = 1.0 + 1.0 / (1u64 << 40) as f64;
const U: f64 = f64::EPSILON / 2.0;

/// Largest distances of the numbers of a [`LegDefects`] from those of the exact problem, leg by leg, Euclidean norms.
///
/// The exact problem has the joints of the design, any within their radii. They are moved by the doubles `origin` and
/// `centre` and divided by the double `unit`. Its rotation is the one nearest to the matrix of the place, and its
/// target squares are within `target_error` of the numbers given. With `u = 2^-53`, to first order, and constants
/// rounded up:
///
/// * joints: a difference and a quotient, `2 u |a|`, `2 u |b|`, and how far the joints may be from their doubles;
/// * rotation: the singular values of `R` differ from 1 by at most `|R^T R - I|`. The nearest rotation is that near to
///   `R`. The entries of `R^T R` are computed to `3 u`;
/// * `B = R b`: `(|R^T R - I| + 9 u) |b|`; `A = a - q`: `2 u |a| + u |A|`; `D = B - A`: both and `u |D|`;
/// * `f = (D.D - s) / 2`: `|D| d + d^2 / 2`, six roundings of `|D|^2`, one of `f`, half of `target_error`.
pub(super) struct Blur {
    a: [f64; 6],
    b: [f64; 6],
    d: [f64; 6],
    f: [f64; 6],
}

impl Blur {
    pub(super) fn of(
        solver: &NearSolver,
        place: &ScaledPose,
        here: &LegDefects,
        target_error: &[f64; 6],
    ) -> Self {
        let r = &place.rotation;
        let mut square = 0.0;
        for j in 0..3 {
            for k in 0..3 {
                let product: f64 = (0..3).map(|i| r[i][j] * r[i][k]).sum();
                let defect = (product - if j == k { 1.0 } else { 0.0 }).abs() + 4.0 * U;
                square += defect * defect;
            }
        }
        let turn = square.sqrt() * UP;
        let mut out = Self { a: [0.0; 6], b: [0.0; 6], d: [0.0; 6], f: [0.0; 6] };
        for i in 0..6 {
            let length = norm(&here.d[i]);
            let [loose_a, loose_b] = [solver.loose[0][i], solver.loose[1][i]];
            let b = ((turn + 10.0 * U) * norm(&solver.platform[i]) + loose_b) * UP;
            let a = (2.5 * U * norm(&solver.base[i]) + 1.5 * U * norm(&here.a[i]) + loose_a) * UP;
            let d = (a + b + 1.5 * U * length) * UP;
            let own = 6.0 * U * here.squares[i] + 2.0 * U * here.f[i].abs();
            let f = (length * d + 0.5 * d * d + own + 0.5 * target_error[i]) * UP;
            (out.a[i], out.b[i], out.d[i], out.f[i]) = (a, b, d, f);
        }
        out
    }

    /// Bound for a row of the Jacobian. It adds `d` for `D`, the change of the product `2 B x D` with its own rounding,
    /// and seven roundings of a sum over six such rows.
    fn row(&self, here: &LegDefects, i: usize) -> f64 {
        let (b, d) = (norm(&here.b[i]), norm(&here.d[i]));
        let turned = 2.0 * (self.b[i] * d + b * self.d[i] + self.b[i] * self.d[i]);
        (self.d[i] + turned + 10.0 * U * b * d + 8.0 * U * (d + 2.0 * b * d)) * UP
    }

    /// Bounds for the coefficients of `Q_i`: first of the terms without `g0 D.w`, then of `g0 D.w`. The first are
    /// `A + B` and `W` with `|W| <= 6 |A| |B|`. Both include the roundings of their sums.
    fn second_order(&self, here: &LegDefects, i: usize) -> (f64, f64) {
        let (a, b) = (norm(&here.a[i]), norm(&here.b[i]));
        let own = 10.0 * U * (1.0 + a + b + 6.0 * a * b);
        let change = self.a[i] + self.b[i] + 6.0 * (self.a[i] * b + a * self.b[i] + self.a[i] * self.b[i]);
        ((change + own) * UP, (self.d[i] + 10.0 * U * norm(&here.d[i])) * UP)
    }
}

/// The numbers of the Kantorovich test at the start of a segment: bounds for the exact problem, see [`Blur`].
///
/// With `kappa >= |I - Y J|` the conditions of the theorem are `4 (beta + eta) eta <= (1 - kappa)^2` and, for a ball of
/// radius `r`, `2 (beta + eta) r <= 1 - kappa`. Both numbers are given divided by `(1 - kappa)^2`, so that the
/// conditions with `kappa = 0` imply them.
pub(super) struct SegmentStart {
    /// The Newton step to the end of the path.
    pub(super) step: [f64; 6],
    /// Bound of its size.
    pub(super) eta: f64,
    /// The part of `eta` that is there at the beginning of the path too.
    pub(super) slack: f64,
    /// Bound of `|Y Q|` without the part of `f`, which is at most `eta`. At least 1.
    pub(super) beta: f64,
    /// Weight of `g0` in the norm.
    pub(super) epsilon: f64,
    pub(super) frobenius_ratio: f64,
}

impl SegmentStart {
    pub(super) fn of(here: &LegDefects, blur: &Blur) -> Option<Self> {
        let j = here.jacobian();
        let mut work = j;
        let mut y = [[0.0; 6]; 6];
        for (i, row) in y.iter_mut().enumerate() {
            row[i] = 1.0;
        }
        invert(&mut work, &mut y)?;
        let step: [f64; 6] = std::array::from_fn(|k| -(0..6).map(|i| y[k][i] * here.f[i]).sum::<f64>());
        let frobenius = |m: &Matrix6| m.iter().flatten().map(|x| x * x).sum::<f64>().sqrt();
        let frobenius_ratio = 6.0 / (frobenius(&j) * frobenius(&y));
        let rows: [f64; 6] = std::array::from_fn(|i| blur.row(here, i));
        let (mut steps, mut defects) = ([0.0; 6], [0.0; 6]);
        for k in 0..6 {
            let mut left = [0.0; 6];
            left[k] = 1.0;
            for i in 0..6 {
                (0..6).for_each(|l| left[l] -= y[k][i] * j[i][l]);
                steps[k] += y[k][i].abs() * (blur.f[i] + 8.0 * U * here.f[i].abs());
                defects[k] += y[k][i].abs() * rows[i];
            }
            defects[k] += left.iter().map(|x| x * x).sum::<f64>().sqrt() + 2.0 * U;
        }
        // in the norm max(|h|, |w|) a row acts by at most sqrt 2 times its Euclidean norm
        let kappa = std::f64::consts::SQRT_2 * Newton { step: defects }.size() * UP;
        let denominator = (1.0 - kappa) * (1.0 - kappa) * (2.0 - UP);
        let slack = Newton { step: steps }.size() * UP / denominator;
        let eta = Newton { step }.size() * UP / denominator + slack;
        let (beta, epsilon) = second_order(here, &y, blur);
        let beta = beta * UP / denominator;
        let sound = eta.is_finite() && beta.is_finite() && frobenius_ratio.is_finite() && kappa < 0.5;
        sound.then_some(Self { step, eta, slack, beta, epsilon, frobenius_ratio })
    }
}

/// `(beta, epsilon)`: rows of `Y Q` are combined over the legs first, then bounded, in blocks of three by the Euclidean
/// norm.
fn second_order(here: &LegDefects, y: &Matrix6, blur: &Blur) -> (f64, f64) {
    // per leg: 1, D, A + B, and the upper triangle of W
    let mut terms = [[0.0; 13]; 6];
    for (t, (a, (b, d))) in terms.iter_mut().zip(here.a.iter().zip(here.b.iter().zip(&here.d))) {
        let two_ab = 2.0 * dot(a, b);
        *t = [
            1.0,
            d[0],
            d[1],
            d[2],
            a[0] + b[0],
            a[1] + b[1],
            a[2] + b[2],
            two_ab - 2.0 * a[0] * b[0],
            two_ab - 2.0 * a[1] * b[1],
            two_ab - 2.0 * a[2] * b[2],
            a[0] * b[1] + a[1] * b[0],
            a[0] * b[2] + a[2] * b[0],
            a[1] * b[2] + a[2] * b[1],
        ];
    }
    let extra: [(f64, f64); 6] = std::array::from_fn(|i| blur.second_order(here, i));
    let (mut free, mut unit, mut linear) = ([0.0; 6], [0.0; 6], [0.0; 6]);
    for k in 0..6 {
        let mut c = [0.0; 13];
        for (weight, t) in y[k].iter().zip(&terms) {
            for (c, t) in c.iter_mut().zip(t) {
                *c += weight * t;
            }
        }
        let square = |r: std::ops::Range<usize>| c[r].iter().map(|x| x * x).sum::<f64>();
        unit[k] = 0.5 * c[0].abs();
        linear[k] = square(1..4).sqrt();
        free[k] = unit[k] + square(4..7).sqrt() + (square(7..10) + 2.0 * square(10..13)).sqrt();
        for (weight, (of_free, of_linear)) in y[k].iter().zip(&extra) {
            free[k] += weight.abs() * of_free;
            linear[k] += weight.abs() * of_linear;
            unit[k] += weight.abs() * 8.0 * U;
        }
    }
    let bound = |epsilon: f64| {
        let row = |k: usize| free[k] + epsilon * (linear[k] + epsilon * unit[k]);
        let block = |r: std::ops::Range<usize>| r.map(|k| row(k) * row(k)).sum::<f64>().sqrt();
        let (h, w) = (block(0..3), block(3..6));
        if h.is_nan() || w.is_nan() { f64::NAN } else { h.max(w) }
    };
    // |w.h| / epsilon bounds the seventh equation: any epsilon will do, this one makes it no larger than the others
    let epsilon = 1.0 / bound(0.0).max(1.0);
    let beta = bound(epsilon);
    (if beta.is_nan() { beta } else { beta.max(1.0 / epsilon) }, epsilon)
}

/// Index of the largest entry of a column at or below the diagonal, `None` when it is zero or not a number.
#[inline]
fn pivot(j: &Matrix6, k: usize) -> Option<usize> {
    let mut best = k;
    for i in k + 1..6 {
        if j[i][k].abs() > j[best][k].abs() {
            best = i;
        }
    }
    (j[best][k].abs() > 0.0).then_some(best)
}

/// Solves `j x = x` by Gaussian elimination with partial pivoting.
#[inline]
fn eliminate(j: &mut Matrix6, x: &mut [f64; 6]) -> Option<()> {
    for k in 0..6 {
        let p = pivot(j, k)?;
        j.swap(k, p);
        x.swap(k, p);
        let inverse = 1.0 / j[k][k];
        let row = j[k];
        for i in k + 1..6 {
            let factor = j[i][k] * inverse;
            for l in k + 1..6 {
                j[i][l] -= factor * row[l];
            }
            x[i] -= factor * x[k];
        }
    }
    for k in (0..6).rev() {
        for l in k + 1..6 {
            x[k] -= j[k][l] * x[l];
        }
        x[k] /= j[k][k];
    }
    Some(())
}

/// Gauss-Jordan with partial pivoting: `y <- j^-1 y`.
#[inline]
fn invert(j: &mut Matrix6, y: &mut Matrix6) -> Option<()> {
    for k in 0..6 {
        let p = pivot(j, k)?;
        j.swap(k, p);
        y.swap(k, p);
        let inverse = 1.0 / j[k][k];
        for l in 0..6 {
            j[k][l] *= inverse;
            y[k][l] *= inverse;
        }
        let (row, right) = (j[k], y[k]);
        for i in 0..6 {
            if i == k {
                continue;
            }
            let factor = j[i][k];
            for l in 0..6 {
                j[i][l] -= factor * row[l];
                y[i][l] -= factor * right[l];
            }
        }
    }
    Some(())
}

#[cfg(test)]
mod tests;
