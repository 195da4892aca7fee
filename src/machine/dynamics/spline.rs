//! A motion through poses at given times, with continuous accelerations.
//!
//! The coordinates of the position are cubic splines of time. The four coordinates of the quaternion are cubic splines
//! too, divided by the norm afterwards. The rotation is thus twice continuously differentiable. The motion is the same
//! in every frame of base and platform, since rotations are orthogonal maps of quaternions. With `q = s / |s|`, angular
//! velocity and acceleration are twice the vector parts of `q' q*` and `q'' q*`.
//!
//! At each end the speed is zero, or the third derivative is continuous across the neighbouring time. The latter is
//! "not a knot" (de Boor, *A Practical Guide to Splines*, 1978, chapter IV). Errors of a smooth motion sampled every
//! `h` are of the order `h^4` in position, `h^3` in velocity and `h^2` in acceleration.

use nalgebra::{Quaternion, SVector, UnitQuaternion, Vector3};
use thiserror::Error;

use super::MotionState;
use platform::geom::Pose;

/// Position, then quaternion with the scalar part first.
type Row = SVector<f64, 7>;

/// End conditions of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PathEnds {
    /// No condition: the poses determine the ends.
    #[default]
    Free,
    /// The platform rests at the first pose and at the last.
    AtRest,
}

/// A smooth motion through poses.
#[derive(Debug, Clone, PartialEq)]
pub struct PosePath {
    times: Vec<f64>,
    rows: Vec<Row>,
    /// Second derivatives at the times.
    bends: Vec<Row>,
}

/// Reasons why poses and times define no motion. Rows are counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum InvalidPath {
    /// Fewer than two poses.
    #[error("a motion has two poses at least")]
    TooShort,
    /// Times that do not increase.
    #[error("time {time} does not come after {before}")]
    NotLater {
        /// The row.
        row: usize,
        /// Its time, seconds.
        time: f64,
        /// Time of the row before, seconds.
        before: f64,
    },
    /// The rotation between successive poses is too large to determine the path between them.
    #[error(
        "the platform turns by {degrees:.1} degrees from the pose before; a quarter turn is the most that a motion is followed over"
    )]
    TurnsTooFar {
        /// The row.
        row: usize,
        /// The angle of the rotation between the two poses, degrees.
        degrees: f64,
    },
}

impl InvalidPath {
    /// The row at fault.
    #[must_use]
    pub fn row(&self) -> Option<usize> {
        match self {
            Self::TooShort => None,
            Self::NotLater { row, .. } | Self::TurnsTooFar { row, .. } => Some(*row),
        }
    }
}

/// Quaternions of poses a quarter turn apart have this product.
const QUARTER_TURN: f64 = std::f64::consts::FRAC_1_SQRT_2;

impl PosePath {
    /// The motion through the poses at the times, in seconds.
    ///
    /// # Errors
    /// [`InvalidPath`].
    pub fn through(times: &[f64], poses: &[Pose], ends: PathEnds) -> Result<Self, InvalidPath> {
        if poses.len() < 2 || times.len() != poses.len() {
            return Err(InvalidPath::TooShort);
        }
        let mut rows: Vec<Row> = Vec::with_capacity(poses.len());
        for (row, (pose, time)) in poses.iter().zip(times).enumerate() {
            let mut q = pose.quaternion();
            if let Some(last) = rows.last() {
                let before = times[row - 1];
                if !(*time > before) {
                    return Err(InvalidPath::NotLater { row, time: *time, before });
                }
                let product: f64 = (0..4).map(|k| last[3 + k] * q[k]).sum();
                if product.abs() < QUARTER_TURN {
                    let degrees = 2.0 * product.abs().acos().to_degrees();
                    return Err(InvalidPath::TurnsTooFar { row, degrees });
                }
                // q and -q are the same rotation; take the sign that continues the curve
                q = q.map(|x| x * product.signum());
            }
            let p = pose.position;
            rows.push(Row::from([p.x, p.y, p.z, q[0], q[1], q[2], q[3]]));
        }
        let bends = bends(times, &rows, ends);
        Ok(Self { times: times.to_vec(), rows, bends })
    }

    /// The times of the poses, seconds.
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The state at a time; before the first and after the last pose the outer pieces continue.
    #[must_use]
    pub fn at(&self, time: f64) -> MotionState {
        let last = self.times.len() - 2;
        let k = self.times.partition_point(|t| *t <= time).saturating_sub(1).min(last);
        let h = self.times[k + 1] - self.times[k];
        let (right, left) = ((time - self.times[k]) / h, (self.times[k + 1] - time) / h);
        let (y0, y1, m0, m1) = (self.rows[k], self.rows[k + 1], self.bends[k], self.bends[k + 1]);
        let cubic = |x: f64| (x.powi(3) - x) * h * h / 6.0;
        let slope = |x: f64| (3.0 * x * x - 1.0) * h / 6.0;
        let value = y0 * left + y1 * right + m0 * cubic(left) + m1 * cubic(right);
        let first = (y1 - y0) / h - m0 * slope(left) + m1 * slope(right);
        let second = m0 * left + m1 * right;
        state(&value, &first, &second)
    }
}

impl PosePath {
    /// The piece between two successive times, by the control points of its Bezier curve: position, then quaternion of
    /// any norm.
    ///
    /// Pieces meet exactly; inside a piece the control points round the spline.
    pub fn control_points(&self, piece: usize) -> [[f64; 7]; 4] {
        let h = self.times[piece + 1] - self.times[piece];
        let (y0, y1) = (self.rows[piece], self.rows[piece + 1]);
        let (m0, m1) = (self.bends[piece] * (h * h), self.bends[piece + 1] * (h * h));
        // slopes at both ends times the length of the piece, a third of each
        let first = (y1 - y0 - (m0 * 2.0 + m1) / 6.0) / 3.0;
        let last = (y1 - y0 + (m0 + m1 * 2.0) / 6.0) / 3.0;
        [y0, y0 + first, y1 - last, y1].map(Into::into)
    }
}

/// The motion state for a point of the curve and its derivatives.
fn state(value: &Row, first: &Row, second: &Row) -> MotionState {
    let position = |row: &Row| Vector3::new(row[0], row[1], row[2]);
    let quaternion = |row: &Row| Quaternion::new(row[3], row[4], row[5], row[6]);
    let (s, ds, dds) = (quaternion(value), quaternion(first), quaternion(second));
    let norm = s.norm();
    let q = s / norm;
    // |s|' = q . s', |s|'' = q' . s' + q . s''
    let rate = q.coords.dot(&ds.coords);
    let dq = (ds - q * rate) / norm;
    let rate_of_rate = dq.coords.dot(&ds.coords) + q.coords.dot(&dds.coords);
    let ddq = (dds - dq * (2.0 * rate) - q * rate_of_rate) / norm;
    let turning = |derivative: Quaternion<f64>| (derivative * q.conjugate()).imag() * 2.0;
    MotionState {
        pose: Pose {
            rotation: UnitQuaternion::new_unchecked(q).to_rotation_matrix(),
            position: position(value),
        },
        velocity: position(first),
        angular_velocity: turning(dq),
        acceleration: position(second),
        angular_acceleration: turning(ddq),
    }
}

/// Second derivatives of the cubic spline at its knots.
fn bends(times: &[f64], rows: &[Row], ends: PathEnds) -> Vec<Row> {
    let n = rows.len();
    let h: Vec<f64> = times.windows(2).map(|t| t[1] - t[0]).collect();
    let slope: Vec<Row> = (0..n - 1).map(|k| (rows[k + 1] - rows[k]) / h[k]).collect();
    // h_(k-1) M_(k-1) + 2 (h_(k-1) + h_k) M_k + h_k M_(k+1) = 6 (slope_k - slope_(k-1))
    let inner = |k: usize| ([h[k - 1], 2.0 * (h[k - 1] + h[k]), h[k]], 6.0 * (slope[k] - slope[k - 1]));
    match ends {
        PathEnds::AtRest => {
            let mut lines = vec![([0.0, 2.0 * h[0], h[0]], 6.0 * slope[0])];
            lines.extend((1..n - 1).map(inner));
            lines.push(([h[n - 2], 2.0 * h[n - 2], 0.0], -6.0 * slope[n - 2]));
            tridiagonal(lines)
        }
        PathEnds::Free if n == 2 => vec![Row::zeros(); 2],
        PathEnds::Free if n == 3 => vec![2.0 * (slope[1] - slope[0]) / (h[0] + h[1]); 3],
        PathEnds::Free => {
            let mut lines: Vec<([f64; 3], Row)> = (1..n - 1).map(inner).collect();
            // M_0 = M_1 - h_0 (M_2 - M_1) / h_1 put into the first line, and the same at the end
            let begin = h[0] / h[1];
            lines[0].0[1] += h[0] * (1.0 + begin);
            lines[0].0[2] -= h[0] * begin;
            let end = h[n - 2] / h[n - 3];
            let last = lines.len() - 1;
            lines[last].0[1] += h[n - 2] * (1.0 + end);
            lines[last].0[0] -= h[n - 2] * end;
            let found = tridiagonal(lines);
            let before = found[0] * (1.0 + begin) - found[1] * begin;
            let after = found[last] * (1.0 + end) - found[last - 1] * end;
            std::iter::once(before).chain(found.iter().copied()).chain([after]).collect()
        }
    }
}

/// Solves a system with three diagonals; its lines are dominated by their middle entries, so that the elimination needs
/// no exchange of lines.
fn tridiagonal(mut lines: Vec<([f64; 3], Row)>) -> Vec<Row> {
    for k in 1..lines.len() {
        let (above, right) = lines[k - 1];
        let factor = lines[k].0[0] / above[1];
        lines[k].0[1] -= factor * above[2];
        lines[k].1 -= right * factor;
    }
    let mut out = vec![Row::zeros(); lines.len()];
    let mut next = Row::zeros();
    for (k, ([_, middle, beyond], right)) in lines.iter().enumerate().rev() {
        next = (right - next * *beyond) / *middle;
        out[k] = next;
    }
    out
}
