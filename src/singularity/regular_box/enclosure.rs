//! The leg lines over a box of poses, and the test that they are independent at all of them.
//!
//! With `K` near the inverse of `J` at the centre and `J_k` an enclosure of `dJ / dq_k` over the box, the mean value theorem gives
//!
//! ```text
//! |I - K J(q)| <= W = |I - K J(centre)| + sum_k |K J_k| half_k      entry by entry, for every q of the box.
//! ```
//!
//! When `W u < u` for some positive vector `u` the spectral radius of `I - K J(q)` is below 1 and `J(q)` is regular (Neumaier, Interval methods for systems of equations, 1990,
//! sec. 4.1). Rows are `[n, a x n]`, `n = R b + p - a`, about the mean base joint, in units of the size.

use nalgebra::{Matrix6, UnitQuaternion, Vector3};

use crate::geom::Pose;
use crate::manipulator::Manipulator;
use crate::num::interval::Interval;
use crate::singularity::enclosed::{
    Matrix, Rotation, Vector, apply, cross, dot, exact_rotation, matrix, skew, times,
};

/// A box of `(d / size, c)`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Region {
    pub(super) centre: [f64; 6],
    half: [f64; 6],
}

impl Region {
    /// Home.
    pub(super) const POINT: Self = Self { centre: [0.0; 6], half: [0.0; 6] };

    /// A box that holds `[lo, hi]`.
    pub(super) fn between(lo: &[f64; 6], hi: &[f64; 6]) -> Self {
        let interval = |k: usize| Interval::new(lo[k], hi[k]).unwrap_or(Interval::WHOLE).centre_and_radius();
        Self { centre: std::array::from_fn(|k| interval(k).0), half: std::array::from_fn(|k| interval(k).1) }
    }

    fn side(&self, k: usize) -> Interval {
        let (c, h) = (self.centre[k], self.half[k]);
        Interval::new((c - h).next_down(), (c + h).next_up()).unwrap_or(Interval::WHOLE)
    }

    /// Cut in two across an axis; `None` when that side is too small for numbers.
    pub(super) fn halves(&self, axis: usize) -> Option<[Self; 2]> {
        let side = self.side(axis);
        let middle = self.centre[axis];
        if !(self.half[axis] > 1e-12) {
            return None;
        }
        let part = |lo: f64, hi: f64| {
            let (centre, half) = Interval::new(lo, hi).unwrap_or(Interval::WHOLE).centre_and_radius();
            let mut region = *self;
            (region.centre[axis], region.half[axis]) = (centre, half);
            region
        };
        Some([part(side.lo(), middle), part(middle, side.hi())])
    }
}

/// The legs of a manipulator about its home pose.
#[derive(Debug, Clone)]
pub(super) struct Lines {
    /// Base joints, from their mean.
    base: [Vector; 6],
    /// `R_0 b`.
    arm: [Vector; 6],
    /// `p_0` less the mean base joint.
    home: Vector,
    /// Rounded copies for steps that prove nothing.
    plain: Plain,
    /// Sign of `det J` at home.
    sign: f64,
}

#[derive(Debug, Clone)]
struct Plain {
    base: [Vector3<f64>; 6],
    arm: [Vector3<f64>; 6],
    home: Vector3<f64>,
}

fn middle(v: &Vector) -> Vector3<f64> {
    Vector3::from_fn(|k, _| v[k].centre_and_radius().0)
}

/// `[c]x + [c]x^2 = [c]x + c c^T - c.c I` and `2 / (1 + c.c)`.
fn cayley_parts(c: &Vector) -> (Rotation, Interval) {
    let square = c[0].square() + c[1].square() + c[2].square();
    let k = skew(c);
    let parts = matrix(|i, j| {
        // on the diagonal c_i^2 - c.c without the term that cancels
        let second = if i == j { -(c[(i + 1) % 3].square() + c[(i + 2) % 3].square()) } else { c[i] * c[j] };
        k[i][j] + second
    });
    let two = Interval::from(2.0);
    let factor = two.checked_div(Interval::from(1.0) + square).unwrap_or(Interval::WHOLE);
    (parts, factor)
}

fn cayley(c: &Vector) -> Rotation {
    let (parts, factor) = cayley_parts(c);
    let identity = |i, j| if i == j { Interval::from(1.0) } else { Interval::ZERO };
    matrix(|i, j| identity(i, j) + factor * parts[i][j])
}

/// `d Cay / d c_k = f ([e_k]x + e_k c^T + c e_k^T - 2 c_k I) - f^2 c_k ([c]x + [c]x^2)`, `f = 2 / (1 + c.c)`.
fn cayley_slope(c: &Vector, k: usize) -> Rotation {
    let (parts, factor) = cayley_parts(c);
    let unit: Vector = std::array::from_fn(|i| if i == k { Interval::from(1.0) } else { Interval::ZERO });
    let turn = skew(&unit);
    let weight = factor.square() * c[k];
    matrix(|i, j| {
        let diagonal = if i == j { Interval::from(2.0) * c[k] } else { Interval::ZERO };
        factor * (turn[i][j] + unit[i] * c[j] + c[i] * unit[j] - diagonal) - weight * parts[i][j]
    })
}

impl Lines {
    pub(super) fn new(m: &Manipulator, home: &Pose) -> Self {
        let legs = m.legs();
        let mean = legs.iter().map(|l| l.base.coords).sum::<Vector3<f64>>() / 6.0;
        let unit = Interval::from(m.size());
        // rounded away before anything is proved: the origin of moments is free
        let scaled = |x: f64, from: f64| {
            (Interval::from(x) - Interval::from(from)).checked_div(unit).unwrap_or(Interval::WHOLE)
        };
        let base = legs.map(|l| std::array::from_fn(|k| scaled(l.base[k], mean[k])));
        let rotation = exact_rotation(home);
        let arm = legs.map(|l| apply(&rotation, &std::array::from_fn(|k| scaled(l.platform[k], 0.0))));
        let place: Vector = std::array::from_fn(|k| scaled(home.position[k], mean[k]));
        let plain =
            Plain { base: base.map(|v| middle(&v)), arm: arm.map(|v| middle(&v)), home: middle(&place) };
        let mut lines = Self { base, arm, home: place, plain, sign: 0.0 };
        lines.sign = lines.sign_at(&[0.0; 6]).unwrap_or(0.0);
        lines
    }

    /// `det J` of rounded numbers.
    pub(super) fn determinant(&self, q: &[f64; 6]) -> f64 {
        self.plain_matrix(q).determinant()
    }

    fn plain_matrix(&self, q: &[f64; 6]) -> Matrix6<f64> {
        let c = Vector3::new(q[3], q[4], q[5]);
        let turn = UnitQuaternion::new_normalize(nalgebra::Quaternion::new(1.0, c.x, c.y, c.z));
        let place = self.plain.home + Vector3::new(q[0], q[1], q[2]);
        let mut j = Matrix6::zeros();
        for i in 0..6 {
            let n = turn * self.plain.arm[i] + place - self.plain.base[i];
            let moment = self.plain.base[i].cross(&n);
            j.fixed_view_mut::<1, 3>(i, 0).copy_from(&n.transpose());
            j.fixed_view_mut::<1, 3>(i, 3).copy_from(&moment.transpose());
        }
        j
    }

    /// Rows `[n_i, a_i x n_i]`.
    fn rows(&self, n: impl Fn(usize) -> Vector) -> Matrix {
        std::array::from_fn(|i| {
            let direction = n(i);
            let moment = cross(&self.base[i], &direction);
            std::array::from_fn(|k| if k < 3 { direction[k] } else { moment[k - 3] })
        })
    }

    fn at(&self, q: &[f64; 6]) -> Matrix {
        let point = q.map(Interval::from);
        let r = cayley(&[point[3], point[4], point[5]]);
        self.rows(|i| {
            let arm = apply(&r, &self.arm[i]);
            std::array::from_fn(|k| arm[k] + self.home[k] + point[k] - self.base[i][k])
        })
    }

    /// Enclosure of `dJ / dq_k` over the region.
    fn slope(&self, region: &Region, k: usize) -> Matrix {
        if k < 3 {
            let unit: Vector =
                std::array::from_fn(|i| if i == k { Interval::from(1.0) } else { Interval::ZERO });
            return self.rows(|_| unit);
        }
        let slope = cayley_slope(&[region.side(3), region.side(4), region.side(5)], k - 3);
        self.rows(|i| apply(&slope, &self.arm[i]))
    }

    /// Whether all poses of the region are proved regular.
    pub(super) fn is_regular(&self, region: &Region) -> bool {
        let Some(inverse) = self.plain_matrix(&region.centre).try_inverse() else { return false };
        let mut w = times(&inverse, &self.at(&region.centre));
        for (i, row) in w.iter_mut().enumerate() {
            row[i] = row[i] - Interval::from(1.0);
        }
        let mut w = w.map(|row| row.map(|x| Interval::from(x.magnitude())));
        for k in (0..6).filter(|k| region.half[*k] > 0.0) {
            let change = times(&inverse, &self.slope(region, k));
            let half = Interval::from(region.half[k]);
            for (row, extra) in w.iter_mut().zip(&change) {
                for (x, e) in row.iter_mut().zip(extra) {
                    *x = *x + Interval::from(e.magnitude()) * half;
                }
            }
        }
        contracts(&w)
    }

    /// The axis along which `J` changes most over the region.
    pub(super) fn steepest(&self, region: &Region) -> usize {
        let inverse = self.plain_matrix(&region.centre).try_inverse();
        let weight = |k: usize| {
            let slope = self.slope(region, k);
            let change = inverse.map_or(slope, |y| times(&y, &slope));
            let sum: f64 = change.iter().flatten().map(|x| x.magnitude()).sum();
            // a centre that is singular itself: any axis with width will do
            region.half[k] * if sum.is_finite() { sum } else { 1.0 }
        };
        let weights: [f64; 6] = std::array::from_fn(weight);
        (0..6).fold(0, |best, k| if weights[k] > weights[best] { k } else { best })
    }

    /// Whether `det J` is proved to have a sign at `q` and the opposite one at home.
    pub(super) fn has_other_sign(&self, q: &[f64; 6]) -> bool {
        self.sign_at(q).is_some_and(|s| s * self.sign < 0.0)
    }

    /// The proved sign of `det J` at a pose.
    fn sign_at(&self, q: &[f64; 6]) -> Option<f64> {
        let d = determinant(&self.at(q));
        if d.lo() > 0.0 { Some(1.0) } else { (d.hi() < 0.0).then_some(-1.0) }
    }
}

/// Whether `W u < u` for the positive vector that power iteration gives.
fn contracts(w: &Matrix) -> bool {
    let mut u = [1.0; 6];
    for _ in 0..6 {
        let next: [f64; 6] = std::array::from_fn(|i| (0..6).map(|k| w[i][k].hi() * u[k]).sum::<f64>());
        let largest = next.iter().copied().fold(0.0, f64::max);
        if !(largest < 4.0) {
            return false;
        }
        // a floor keeps it positive
        u = next.map(|x| (x / largest.max(f64::MIN_POSITIVE)).max(1e-3));
    }
    (0..6).all(|i| {
        let sum = (0..6).fold(Interval::ZERO, |s, k| s + w[i][k] * Interval::from(u[k]));
        sum.hi() < u[i]
    })
}

/// Encloses the determinant: Laplace expansion by complementary minors of the first three rows.
fn determinant(m: &Matrix) -> Interval {
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
