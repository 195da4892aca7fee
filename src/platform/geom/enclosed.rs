//! Vectors, rotations and 6 x 6 matrices of intervals.

use nalgebra::{Matrix6, UnitQuaternion};

use super::Pose;
use num::interval::Interval;
pub use num::vector::{cross, dot};

/// Three coordinates.
pub type IntervalVector = [Interval; 3];
/// A 3 x 3 matrix by rows.
pub type Rotation = [IntervalVector; 3];
/// A 6 x 6 matrix by rows.
pub type IntervalMatrix = [[Interval; 6]; 6];

/// `f(0..3, 0..3)`.
pub fn matrix(f: impl Fn(usize, usize) -> Interval) -> Rotation {
    std::array::from_fn(|i| std::array::from_fn(|j| f(i, j)))
}

/// `v / |v|`; `None` where the norm may vanish.
pub fn unit(v: &IntervalVector) -> Option<IntervalVector> {
    let length = (v[0].square() + v[1].square() + v[2].square()).sqrt()?;
    Some([v[0].checked_div(length)?, v[1].checked_div(length)?, v[2].checked_div(length)?])
}

/// `[c]x`.
pub fn skew(c: &IntervalVector) -> Rotation {
    let z = Interval::ZERO;
    [[z, -c[2], c[1]], [c[2], z, -c[0]], [-c[1], c[0], z]]
}

/// `R v`.
pub fn apply(r: &Rotation, v: &IntervalVector) -> IntervalVector {
    std::array::from_fn(|i| dot(&r[i], v))
}

/// The rotation of the pose's quaternion, which is an exact rotation for any norm.
pub fn exact_rotation(home: &Pose) -> Rotation {
    let q = UnitQuaternion::from_rotation_matrix(&home.rotation);
    let w = Interval::from(q.w);
    let v: IntervalVector = [q.i, q.j, q.k].map(Interval::from);
    let norm = w.square() + v[0].square() + v[1].square() + v[2].square();
    let factor = Interval::from(2.0).checked_div(norm).unwrap_or(Interval::WHOLE);
    let k = skew(&v);
    matrix(|i, j| {
        let identity = if i == j { Interval::from(1.0) } else { Interval::ZERO };
        let second = if i == j { -(v[(i + 1) % 3].square() + v[(i + 2) % 3].square()) } else { v[i] * v[j] };
        identity + factor * (w * k[i][j] + second)
    })
}

/// `Y J`.
pub fn times(y: &Matrix6<f64>, j: &IntervalMatrix) -> IntervalMatrix {
    std::array::from_fn(|r| {
        std::array::from_fn(|c| (0..6).fold(Interval::ZERO, |sum, k| sum + j[k][c].scaled(y[(r, k)])))
    })
}

/// Encloses the determinant: Laplace expansion by complementary minors of the first three rows.
pub fn determinant(m: &IntervalMatrix) -> Interval {
    let minor = |rows: [usize; 3], c: [usize; 3]| {
        let r = rows.map(|r| c.map(|k| m[r][k]));
        dot(&r[0], &cross(&r[1], &r[2]))
    };
    let mut sum = Interval::ZERO;
    for i in 0..6 {
        for j in i + 1..6 {
            for k in j + 1..6 {
                let mut others = (0..6).filter(|x| ![i, j, k].contains(x));
                let rest: [usize; 3] = std::array::from_fn(|_| others.next().unwrap_or(0));
                let term = minor([0, 1, 2], [i, j, k]) * minor([3, 4, 5], rest);
                // sign of moving columns i, j, k to the front: i + j + k - (0 + 1 + 2)
                sum = if (i + j + k) % 2 == 1 { sum + term } else { sum - term };
            }
        }
    }
    sum
}

/// A positive vector `u`, found by power iteration, and a bound of `max (W u)_i / u_i` if that is below 1. It then
/// bounds the spectral radius of every matrix whose entries have moduli of at most those of `W`.
pub fn contraction(w: &IntervalMatrix) -> Option<([f64; 6], f64)> {
    let mut u = [1.0; 6];
    for _ in 0..6 {
        let next: [f64; 6] = std::array::from_fn(|i| (0..6).map(|k| w[i][k].hi() * u[k]).sum::<f64>());
        let largest = next.iter().copied().fold(0.0, f64::max);
        if !(largest < 4.0) {
            return None;
        }
        // a floor keeps it positive
        u = next.map(|x| (x / largest.max(f64::MIN_POSITIVE)).max(1e-3));
    }
    let mut factor = 0.0_f64;
    for i in 0..6 {
        let sum = (0..6).fold(Interval::ZERO, |s, k| s + w[i][k] * Interval::from(u[k]));
        factor = factor.max(sum.checked_div(Interval::from(u[i]))?.hi());
    }
    (factor < 1.0).then_some((u, factor))
}
