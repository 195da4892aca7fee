//! The validator's Newton method for distant roots.
//!
//! At `|R|` of `10^7` doubles hold `R`, `p` too coarsely for Newton's method to converge. In dual quaternions `(e, g)`,
//! `g = p e`, the same root is an ordinary point. The claimed pose is carried there, improved on
//! `|g + e b_i - a_i e|^2 = s_i e.e`, `e.g = 0`, `e_k = 1`, and carried back, all in double-double.

use num_complex::Complex64;

use super::newton::{Point, ValidationEquations, solve};
use num::double_double::{ComplexDoubleDouble as Z, DoubleDouble};

/// Corrections that stop shrinking below this value, relative to the largest of `e`, `g`, are rounding.
const SETTLED: f64 = 1e-17;

type Quaternion = [Z; 4];

fn product(p: &Quaternion, q: &Quaternion) -> Quaternion {
    let [a, x, y, z] = *p;
    let [b, u, v, w] = *q;
    [
        a * b - x * u - y * v - z * w,
        a * u + x * b + y * w - z * v,
        a * v + y * b + z * u - x * w,
        a * w + z * b + x * v - y * u,
    ]
}

fn dot(p: &Quaternion, q: &Quaternion) -> Z {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3]
}

fn sum(p: &Quaternion, q: &Quaternion, sign: f64) -> Quaternion {
    std::array::from_fn(|k| p[k] + q[k].scaled(sign))
}

fn pure(v: [Z; 3]) -> Quaternion {
    [Z::ZERO, v[0], v[1], v[2]]
}

fn real(x: f64) -> Z {
    Z { re: DoubleDouble::from(x), im: DoubleDouble::ZERO }
}

fn pure_real(v: &[DoubleDouble; 3]) -> Quaternion {
    pure(v.map(|re| Z { re, im: DoubleDouble::ZERO }))
}

fn unit(k: usize) -> Quaternion {
    std::array::from_fn(|j| if j == k { real(1.0) } else { Z::ZERO })
}

/// The largest of the four columns `4 e_k e` of the rotation's quaternion, divided by its own entry `k`.
fn quaternion(x: &Point) -> (Quaternion, usize) {
    let r = |i: usize, j: usize| x.0[3 * i + j];
    let one = real(1.0);
    let columns = [
        [one + r(0, 0) + r(1, 1) + r(2, 2), r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1)],
        [r(2, 1) - r(1, 2), one + r(0, 0) - r(1, 1) - r(2, 2), r(0, 1) + r(1, 0), r(0, 2) + r(2, 0)],
        [r(0, 2) - r(2, 0), r(0, 1) + r(1, 0), one - r(0, 0) + r(1, 1) - r(2, 2), r(1, 2) + r(2, 1)],
        [r(1, 0) - r(0, 1), r(0, 2) + r(2, 0), r(1, 2) + r(2, 1), one - r(0, 0) - r(1, 1) + r(2, 2)],
    ];
    let size = |k: usize| columns[k][k].hi().norm();
    let k = (1..4).fold(0, |best, k| if size(k) > size(best) { k } else { best });
    (columns[k].map(|z| z / columns[k][k]), k)
}

/// The root in dual quaternions near `start`, as a pose with its relative error; `None` if Newton's method fails. The
/// error is the last correction, increased by the loss of the division by `e.e`.
///
/// It starts at the claimed dual quaternion, or else at the dual quaternion of the pose.
pub(super) fn refine_dual(
    legs: &ValidationEquations,
    start: &Point,
    claimed: Option<&[Complex64; 8]>,
) -> Option<(Point, f64)> {
    let (mut e, patch) = quaternion(start);
    let mut g = product(&pure([start.0[9], start.0[10], start.0[11]]), &e);
    if let Some(x) = claimed {
        let one = Z::from(x[patch]);
        e = std::array::from_fn(|k| Z::from(x[k]) / one);
        g = std::array::from_fn(|k| Z::from(x[4 + k] / legs.unit()) / one);
    }
    let (mut last, mut slow) = (f64::INFINITY, 0);
    for _ in 0..20 {
        let (jacobian, values) = linearised(legs, &e, &g, patch);
        let step = solve(jacobian, values)?;
        for k in 0..4 {
            e[k] = e[k] - step[k];
            g[k] = g[k] - step[4 + k];
        }
        let scale = g.iter().map(|z| z.hi().norm()).fold(1.0, f64::max);
        let length = step.iter().map(|z| z.hi().norm()).fold(0.0, f64::max) / scale;
        // near a multiple root the steps halve instead of converging quadratically
        slow += u32::from(length >= 0.1 * last && (SETTLED..1e-6).contains(&length));
        if !(length < 1.0) || slow > 3 {
            return None;
        }
        // quadratic convergence down to the rounding of the equations times their condition
        if length < 1e-27 || (length < SETTLED && length >= 0.1 * last) {
            let size: f64 = e.iter().map(|z| z.hi().norm_sqr()).sum();
            let loss = size / dot(&e, &e).hi().norm();
            return Some((pose(&e, &g), (length + 1e-31) * loss));
        }
        last = length;
    }
    None
}

/// Eight equations in `(e, g)`: leg 1, the differences of the others to it, `e.g = 0`, and `e_patch` fixed.
///
/// With `v = g + e b - a e` of leg 1 and `u = v_i - v = e (b_i - b) - (a_i - a) e`, the difference of two legs is
/// `u.(2 v + u) - (s_i - s) e.e`. It avoids the square of a large `g`.
fn linearised(
    legs: &ValidationEquations,
    e: &Quaternion,
    g: &Quaternion,
    patch: usize,
) -> ([[Z; 8]; 8], [Z; 8]) {
    let (mut jacobian, mut values) = ([[Z::ZERO; 8]; 8], [Z::ZERO; 8]);
    let turned = |a: &Quaternion, b: &Quaternion, q: &Quaternion| sum(&product(q, b), &product(a, q), -1.0);
    let joints = |i: usize| (pure_real(&legs.base[i]), pure_real(&legs.platform[i]));
    let (a0, b0) = joints(0);
    let v = sum(g, &turned(&a0, &b0, e), 1.0);
    let norm = dot(e, e);
    for i in 0..6 {
        let (a, b) = joints(i);
        let (a, b) = if i == 0 { (a, b) } else { (sum(&a, &a0, -1.0), sum(&b, &b0, -1.0)) };
        let s = real(legs.squares[i]) - if i == 0 { Z::ZERO } else { real(legs.squares[0]) };
        let u = turned(&a, &b, e);
        let w = sum(&v, &u, 1.0); // v_i
        values[i] = if i == 0 { dot(&v, &v) } else { dot(&u, &sum(&v, &w, 1.0)) } - s * norm;
        for k in 0..4 {
            let x = unit(k);
            let (by_e, by_g) = if i == 0 {
                (dot(&v, &turned(&a, &b, &x)), v[k])
            } else {
                // u.(2 v + u): derivatives of u against v_i, of v against u
                (dot(&turned(&a, &b, &x), &w) + dot(&u, &turned(&a0, &b0, &x)), u[k])
            };
            jacobian[i][k] = (by_e - s * e[k]).scaled(2.0);
            jacobian[i][4 + k] = by_g.scaled(2.0);
        }
    }
    values[6] = dot(e, g);
    for k in 0..4 {
        (jacobian[6][k], jacobian[6][4 + k]) = (g[k], e[k]);
    }
    jacobian[7][patch] = real(1.0);
    (jacobian, values)
}

/// `R v = e v e~ / (e.e)` on the unit vectors, `p = g e~ / (e.e)`.
fn pose(e: &Quaternion, g: &Quaternion) -> Point {
    let conjugate = [e[0], -e[1], -e[2], -e[3]];
    let norm = dot(e, e);
    let mut out = Point([Z::ZERO; 12]);
    for j in 0..3 {
        let image = product(&product(e, &unit(j + 1)), &conjugate);
        for i in 0..3 {
            out.0[3 * i + j] = image[i + 1] / norm;
        }
    }
    let p = product(g, &conjugate);
    for i in 0..3 {
        out.0[9 + i] = p[i + 1] / norm;
    }
    out
}
