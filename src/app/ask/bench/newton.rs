//! Newton's method in double-double on the twelve numbers `R`, `p`: the validator's own definition of a root.
//!
//! The twelve equations are the six leg equations and the six of `R^T R = I`, on the data as given. They are divided by
//! a power of two, which is exact. The method shares no parametrisation and no elimination with the solvers.

use std::ops::{Div, Mul, Sub};

use num_complex::Complex64;

use super::dual::refine_dual;
use num::double_double::{ComplexDoubleDouble as Z, DoubleDouble};
use platform::geom::ComplexPose;
use platform::manipulator::{Body, Manipulator, SquaredLegLengths};

const N: usize = 12;

/// A pose in double-double: rows of `R`, then `p` in the unit of [`ValidationEquations`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Point(pub(super) [Z; N]);

impl Point {
    pub(super) fn conjugate(&self) -> Self {
        Self(self.0.map(|z| Z { re: z.re, im: -z.im }))
    }

    /// Largest modulus of an entry, at least one.
    pub(super) fn scale(&self) -> f64 {
        self.0.iter().map(|z| z.hi().norm()).fold(1.0, f64::max)
    }

    pub(super) fn distance(&self, other: &Self) -> f64 {
        self.0.iter().zip(&other.0).map(|(a, b)| (*a - *b).hi().norm()).fold(0.0, f64::max)
    }

    pub(super) fn imaginary(&self) -> f64 {
        self.0.iter().map(|z| z.im.hi().abs()).fold(0.0, f64::max)
    }

    /// Whether `det R` is 1 rather than -1. In double-double, since for distant roots the products exceed `10^16`.
    pub(super) fn is_rotation(&self) -> bool {
        let r = &self.0;
        let minor = |i: usize, j: usize| r[3 + i] * r[6 + j] - r[3 + j] * r[6 + i];
        let determinant = (r[0] * minor(1, 2) - r[1] * minor(0, 2) + r[2] * minor(0, 1)).hi().re;
        (determinant - 1.0).abs() < 0.1
    }
}

/// The equations of one problem.
#[derive(Debug, Clone)]
pub(super) struct ValidationEquations {
    /// Joints in double-double, since exact joints are not always doubles.
    pub(super) base: [[DoubleDouble; 3]; 6],
    pub(super) platform: [[DoubleDouble; 3]; 6],
    pub(super) squares: [f64; 6],
    unit: f64,
}

/// The result of an iteration.
#[derive(Debug, Clone, Copy)]
pub(super) struct NewtonEnd {
    pub(super) point: Point,
    /// Largest entry of the first point's residual, divided by the squared scale of the point.
    pub(super) residual: f64,
    /// Length of the last correction divided by the scale: the error, if the iteration converged.
    pub(super) error: f64,
    /// Whether corrections fell to rounding level and stopped there.
    pub(super) converged: bool,
    /// Whether `R` is a rotation rather than a reflection.
    pub(super) proper: bool,
}

impl ValidationEquations {
    pub(super) fn new(m: &Manipulator, s: &SquaredLegLengths) -> Self {
        let unit = 2f64.powi(m.size().log2().floor() as i32);
        let legs = m.legs();
        let ends = |body: Body| {
            std::array::from_fn(|i| {
                let (double, low) = (legs[i].end(body), m.end_low(i, body).0);
                std::array::from_fn(|k| DoubleDouble::from_sum(double[k] / unit, low[k] / unit))
            })
        };
        Self {
            base: ends(Body::Base),
            platform: ends(Body::Platform),
            squares: s.get().map(|s| s / (unit * unit)),
            unit,
        }
    }

    /// The unit of positions: the power of two that they are divided by.
    pub(super) fn unit(&self) -> f64 {
        self.unit
    }

    pub(super) fn point(&self, pose: &ComplexPose) -> Point {
        Point(std::array::from_fn(|k| {
            let z = if k < 9 { pose.rotation[(k / 3, k % 3)] } else { pose.position[k - 9] / self.unit };
            Z::from(z)
        }))
    }

    /// `R b_i + p - a_i`.
    fn difference(&self, x: &Point, i: usize) -> [Z; 3] {
        let (a, b) = (self.base[i], self.platform[i]);
        std::array::from_fn(|k| {
            let turned = (0..3).map(|j| times(x.0[3 * k + j], b[j])).fold(x.0[9 + k], |s, z| s + z);
            Z { re: turned.re - a[k], im: turned.im }
        })
    }

    fn values(&self, x: &Point) -> [Z; N] {
        let mut out = [Z::ZERO; N];
        for i in 0..6 {
            let d = self.difference(x, i);
            let square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
            out[i] = Z { re: square.re - DoubleDouble::from(self.squares[i]), im: square.im };
        }
        for (row, (i, j)) in PAIRS.into_iter().enumerate() {
            let dot = (0..3).map(|k| x.0[3 * k + i] * x.0[3 * k + j]).fold(Z::ZERO, |s, z| s + z);
            let target = if i == j { DoubleDouble::ONE } else { DoubleDouble::ZERO };
            out[6 + row] = Z { re: dot.re - target, im: dot.im };
        }
        out
    }

    fn jacobian(&self, x: &Point) -> [[Z; N]; N] {
        let mut out = [[Z::ZERO; N]; N];
        for i in 0..6 {
            let d = self.difference(x, i).map(|z| z.scaled(2.0));
            for k in 0..3 {
                for j in 0..3 {
                    out[i][3 * k + j] = times(d[k], self.platform[i][j]);
                }
                out[i][9 + k] = d[k];
            }
        }
        for (row, (i, j)) in PAIRS.into_iter().enumerate() {
            for k in 0..3 {
                out[6 + row][3 * k + i] = out[6 + row][3 * k + i] + x.0[3 * k + j];
                out[6 + row][3 * k + j] = out[6 + row][3 * k + j] + x.0[3 * k + i];
            }
        }
        out
    }

    /// Largest equation error divided by the square of the point's scale.
    pub(super) fn residual(&self, x: &Point) -> f64 {
        let reach = self.base.iter().flatten().fold(1.0f64, |m, v| m.max(v.hi().abs()));
        let scale = x.scale().max(reach).powi(2);
        self.values(x).iter().map(|z| z.hi().norm() / scale).fold(0.0, f64::max)
    }

    /// Runs Newton's method from `start` until corrections stop shrinking. Corrections are computed in double first.
    /// For distant roots near `e.e = 0` this may fail, since the condition of the Jacobian grows with a power of the
    /// pose. It then uses double-double, and finally dual quaternions.
    pub(super) fn refine(&self, start: &Point) -> NewtonEnd {
        self.refine_from(start, None)
    }

    /// Lengths of the first Newton steps from a point at this relative distance, relative to its scale, in
    /// double-double. Near a double root the steps halve (Reddien 1978), near a threefold one they shrink to two
    /// thirds, near a simple one quadratically.
    pub(super) fn steps_from_beside(&self, point: &Point, distance: f64) -> Vec<f64> {
        let scale = point.scale();
        let mut x = *point;
        for (k, entry) in x.0.iter_mut().enumerate() {
            *entry = *entry + Z::from(Complex64::new(distance * scale * (1.0 + 0.3 * (k as f64).sin()), 0.0));
        }
        let mut out = Vec::new();
        for _ in 0..STEPS_BESIDE {
            let Some(step) = solve(self.jacobian(&x), self.values(&x)) else { break };
            x = Point(std::array::from_fn(|k| x.0[k] - step[k]));
            out.push(step.iter().map(|z| z.hi().norm()).fold(0.0, f64::max) / scale);
        }
        out
    }

    /// [`refine`](Self::refine), with the additional digits of a dual quaternion.
    pub(super) fn refine_from(&self, start: &Point, dual: Option<&[Complex64; 8]>) -> NewtonEnd {
        let residual = self.residual(start);
        let (point, error) = iterate(start, |x| {
            solve(self.jacobian(x).map(|row| row.map(Z::hi)), self.values(x).map(Z::hi))
                .map(|s| s.map(Z::from))
        });
        if error < CLOSE {
            return NewtonEnd { point, residual, error, converged: true, proper: point.is_rotation() };
        }
        let (point, error) = iterate(start, |x| solve(self.jacobian(x), self.values(x)));
        if !(error < CLOSE) {
            // a dual quaternion always gives a rotation
            if let Some((point, error)) = refine_dual(self, start, dual) {
                return NewtonEnd { point, residual, error, converged: true, proper: true };
            }
        }
        let converged = error < converged_below(point.scale());
        NewtonEnd { point, residual, error, converged, proper: point.is_rotation() }
    }
}

/// Number of steps of [`ValidationEquations::steps_from_beside`].
const STEPS_BESIDE: usize = 9;

/// Corrections of this relative length are the best that `R`, `p` allow.
const CLOSE: f64 = 1e-20;

/// Bound on the relative length of the last correction of a converged iteration.
///
/// The condition of the Jacobian, and with it the rounding of a correction, grows like the power 2.5 of the pose
/// (measured: `1e-19` at `1e5`). For small poses the bound must be small: from close to a double root even halving
/// steps fall below `1e-17`.
fn converged_below(scale: f64) -> f64 {
    (1e-30 * scale * scale * scale.sqrt()).max(1e-20)
}

/// The end of the iteration and the relative length of its last correction.
fn iterate(start: &Point, step: impl Fn(&Point) -> Option<[Z; N]>) -> (Point, f64) {
    let (mut x, mut error) = (*start, f64::INFINITY);
    for _ in 0..20 {
        let Some(step) = step(&x) else { break };
        let next = Point(std::array::from_fn(|k| x.0[k] - step[k]));
        let length = step.iter().map(|z| z.hi().norm()).fold(0.0, f64::max) / next.scale();
        if !(length < 0.5) || (error < converged_below(x.scale()) && length >= error) {
            break;
        }
        (x, error) = (next, length);
        if error < 1e-29 {
            break;
        }
    }
    (x, error)
}

const PAIRS: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

fn times(z: Z, x: DoubleDouble) -> Z {
    Z { re: z.re * x, im: z.im * x }
}

/// The operations on numbers that Gaussian elimination uses.
pub(super) trait EliminationNumber:
    Copy + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    const ZERO: Self;
    fn modulus(self) -> f64;
    fn reduced(self, power_of_two: f64) -> Self;
}

impl EliminationNumber for Complex64 {
    const ZERO: Self = Self::ZERO;
    fn modulus(self) -> f64 {
        self.norm()
    }
    fn reduced(self, power_of_two: f64) -> Self {
        self / power_of_two
    }
}

impl EliminationNumber for Z {
    const ZERO: Self = Z::ZERO;
    fn modulus(self) -> f64 {
        self.hi().norm()
    }
    fn reduced(self, power_of_two: f64) -> Self {
        self.scaled(power_of_two.recip())
    }
}

/// Gaussian elimination with partial pivoting; rows are scaled to a largest entry of about one.
pub(super) fn solve<T: EliminationNumber, const K: usize>(
    mut m: [[T; K]; K],
    mut y: [T; K],
) -> Option<[T; K]> {
    for i in 0..K {
        let largest = m[i].iter().map(|z| z.modulus()).fold(0.0, f64::max);
        if !(largest > 0.0 && largest.is_finite()) {
            return None;
        }
        let unit = 2f64.powi(largest.log2().floor() as i32);
        m[i] = m[i].map(|z| z.reduced(unit));
        y[i] = y[i].reduced(unit);
    }
    for c in 0..K {
        let pivot = (c..K).max_by(|&i, &j| m[i][c].modulus().total_cmp(&m[j][c].modulus()))?;
        m.swap(c, pivot);
        y.swap(c, pivot);
        if !(m[c][c].modulus() > 0.0) {
            return None;
        }
        let (row, value) = (m[c], y[c]);
        for i in c + 1..K {
            let factor = m[i][c] / row[c];
            for j in c..K {
                m[i][j] = m[i][j] - factor * row[j];
            }
            y[i] = y[i] - factor * value;
        }
    }
    let mut x = [T::ZERO; K];
    for i in (0..K).rev() {
        let rest = (i + 1..K).fold(y[i], |rest, j| rest - m[i][j] * x[j]);
        x[i] = rest / m[i][i];
    }
    Some(x)
}
