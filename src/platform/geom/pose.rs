//! Real and complex poses `(R, p)`: `x_base = R x_platform + p`.

use nalgebra::{Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};
use num_complex::Complex64;

use crate::manipulator::{Leg, LegLengths, Manipulator, SquaredLegLengths};

/// A real pose of the platform in the base frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Rotation `R`, platform frame to base frame.
    pub rotation: Rotation3<f64>,
    /// Position `p` of the platform origin, base frame, design units.
    pub position: Vector3<f64>,
}

impl Pose {
    /// The pose of a frame that coincides with the one it is given in.
    #[must_use]
    pub fn identity() -> Self {
        Self::shifted(Vector3::zeros())
    }

    /// The pose of a frame that is shifted by `position` and not rotated.
    #[must_use]
    pub fn shifted(position: Vector3<f64>) -> Self {
        Self { rotation: Rotation3::identity(), position }
    }

    /// The pose `inner`, given in the frame of this one, in the frame that this one is given in.
    #[must_use]
    pub fn compose(&self, inner: &Self) -> Self {
        let position = self.transform(&Point3::from(inner.position)).coords;
        Self { rotation: self.rotation * inner.rotation, position }
    }

    /// The pose of the outer frame in this one.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.inverse();
        Self { rotation, position: -(rotation * self.position) }
    }

    /// The base-frame position of a point given in the platform frame.
    // written by entries, and inlined across the crates, which takes a third off the time of loops over many poses
    #[must_use]
    #[inline]
    pub fn transform(&self, point: &Point3<f64>) -> Point3<f64> {
        let (r, p, b) = (self.rotation.matrix(), &self.position, point);
        let row = |k: usize| r[(k, 0)] * b.x + r[(k, 1)] * b.y + r[(k, 2)] * b.z + p[k];
        Point3::new(row(0), row(1), row(2))
    }

    /// The unit quaternion of the rotation, scalar first and non-negative.
    #[must_use]
    pub fn quaternion(&self) -> [f64; 4] {
        let q = UnitQuaternion::from_rotation_matrix(&self.rotation);
        let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
        // + 0.0: no -0.0
        [q.w, q.i, q.j, q.k].map(|x| sign * x + 0.0)
    }

    /// `s = |R b + p - a|^2` of one leg.
    #[must_use]
    #[inline]
    pub fn squared_length(&self, leg: &Leg) -> f64 {
        (self.transform(&leg.platform) - leg.base).norm_squared()
    }

    /// Inverse kinematics: the six squared leg lengths of `m` at this pose; `None` on overflow.
    #[must_use]
    pub fn squared_lengths(&self, m: &Manipulator) -> Option<SquaredLegLengths> {
        SquaredLegLengths::try_new(m.legs().map(|leg| self.squared_length(&leg))).ok()
    }

    /// Inverse kinematics: the six leg lengths of `m` at this pose; `None` on overflow.
    #[must_use]
    pub fn lengths(&self, m: &Manipulator) -> Option<LegLengths> {
        self.lengths_of(&m.legs())
    }

    /// [`lengths`](Self::lengths) for legs extracted from a manipulator once, for many poses.
    #[must_use]
    #[inline]
    pub fn lengths_of(&self, legs: &[Leg; 6]) -> Option<LegLengths> {
        let mut lengths = [0.0; 6];
        for (length, leg) in lengths.iter_mut().zip(legs) {
            *length = self.squared_length(leg).sqrt();
        }
        LegLengths::try_new(lengths).ok()
    }
}

/// A complex pose: `R^T R = I`, `det R = 1` over the complex numbers, `p` in `C^3`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ComplexPose {
    /// Complex rotation matrix.
    pub rotation: Matrix3<Complex64>,
    /// Complex position, design units.
    pub position: Vector3<Complex64>,
}

impl ComplexPose {
    /// Left side of the leg equation, `(R b + p - a)^T (R b + p - a)` (no conjugation).
    #[must_use]
    #[inline]
    pub fn squared_length(&self, leg: &Leg) -> Complex64 {
        let (r, p, b, a) = (&self.rotation, &self.position, &leg.platform, &leg.base);
        let mut sum = Complex64::ZERO;
        for k in 0..3 {
            let d = r[(k, 0)] * b.x + r[(k, 1)] * b.y + r[(k, 2)] * b.z + p[k] - a[k];
            sum += d * d;
        }
        sum
    }

    /// The largest error of the leg equations and of `R^T R = I`, the former relative to the squared
    /// size of the design.
    #[must_use]
    pub fn residual(&self, m: &Manipulator, s: &SquaredLegLengths) -> f64 {
        self.residual_of(&m.legs(), m.size(), s)
    }

    /// [`residual`](Self::residual) for legs extracted from a manipulator of this size once, for many poses.
    pub fn residual_of(&self, legs: &[Leg; 6], size: f64, s: &SquaredLegLengths) -> f64 {
        let scale = size * size;
        let mut largest = 0.0_f64;
        for (leg, s) in legs.iter().zip(s.get()) {
            largest = larger(largest, ((self.squared_length(leg) - s) / scale).norm_sqr());
        }
        let r = &self.rotation;
        for i in 0..3 {
            for j in 0..=i {
                let one = if i == j { 1.0 } else { 0.0 };
                let dot = r[(0, i)] * r[(0, j)] + r[(1, i)] * r[(1, j)] + r[(2, i)] * r[(2, j)];
                largest = larger(largest, (dot - one).norm_sqr());
            }
        }
        largest.sqrt()
    }

    /// Largest modulus of an imaginary part: of `R` as it is, of `p` relative to `size`.
    #[must_use]
    pub fn imaginary_size(&self, size: f64) -> f64 {
        let r = self.rotation.iter().map(|z| z.im.abs());
        r.chain(self.position.iter().map(|z| z.im.abs() / size)).fold(0.0, f64::max)
    }

    /// The real part as a real pose (rotation re-orthonormalised).
    #[must_use]
    pub fn real_part(&self) -> Pose {
        let r = self.rotation.map(|z| z.re);
        Pose { rotation: nearest_rotation(&r), position: self.position.map(|z| z.re) }
    }

    /// The pose minus a step of Newton's method. The rotation vector `turn` enters by its Cayley transform, exactly
    /// orthogonal over `C`, and `shift` is subtracted. `None` if the rotation is too large for that.
    pub fn less_step(&self, turn: &Vector3<Complex64>, shift: &Vector3<Complex64>) -> Option<Self> {
        let w = turn * Complex64::new(-0.5, 0.0);
        let n = Complex64::ONE + w.dot(&w);
        if !(n.norm() > 0.1) {
            return None;
        }
        let (two, one) = (Complex64::new(2.0, 0.0), Complex64::ONE);
        let cross = w.cross_matrix();
        let turn = (Matrix3::identity() * (one - w.dot(&w)) + (w * w.transpose()) * two + cross * two) / n;
        Some(Self { rotation: reorthogonalised(&(turn * self.rotation)), position: self.position - shift })
    }

    /// Whether [`distance`](Self::distance) is below `limit`; distant poses are rejected after an entry or two.
    pub fn is_within(&self, other: &Self, size: f64, limit: f64) -> bool {
        let limits = (limit * limit, limit * limit * size * size);
        let entries = self.rotation.iter().zip(&other.rotation).all(|(x, y)| (x - y).norm_sqr() < limits.0);
        entries && self.position.iter().zip(&other.position).all(|(x, y)| (x - y).norm_sqr() < limits.1)
    }

    /// Distance of two poses: the largest entry difference, positions divided by `size`.
    #[must_use]
    pub fn distance(&self, other: &Self, size: f64) -> f64 {
        let r =
            (self.rotation - other.rotation).iter().map(num_complex::Complex::norm_sqr).fold(0.0, f64::max);
        let p =
            (self.position - other.position).iter().map(num_complex::Complex::norm_sqr).fold(0.0, f64::max);
        r.max(p / (size * size)).sqrt()
    }
}

/// The rotation nearest to a near-rotation matrix. It is the orthogonal factor of the polar decomposition by
/// `X <- (X + X^-T) / 2` (Higham 1986), which converges for every regular matrix. A matrix without positive determinant
/// is not near a rotation; it gives the rotation of its quaternion.
///
/// The number of steps is bounded. `nalgebra`'s own iteration has no bound by default, and its angle can stay above the
/// rounding of doubles forever.
pub fn nearest_rotation(m: &Matrix3<f64>) -> Rotation3<f64> {
    let of_quaternion =
        || UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*m)).to_rotation_matrix();
    if !(m.determinant() > 0.0) {
        return of_quaternion();
    }
    let mut x = *m;
    for _ in 0..POLAR_STEPS {
        // a rotation up to rounding keeps all its digits
        if (x.transpose() * x - Matrix3::identity()).amax() <= ROUNDED {
            break;
        }
        let Some(inverse) = x.try_inverse() else { return of_quaternion() };
        x = (x + inverse.transpose()) * 0.5;
    }
    Rotation3::from_matrix_unchecked(x)
}

/// Greatest difference between `R^T R` and the identity for a rotation rounded to doubles.
pub(super) const ROUNDED: f64 = 8.0 * f64::EPSILON;

/// Number of steps of the polar decomposition: each halves the logarithm of the singular values far from one, and
/// squares the error near it.
const POLAR_STEPS: usize = 60;

/// One step of `R <- R (3 I - R^T R) / 2`, which squares the defect of `R^T R = I` (over `C` as well).
pub fn reorthogonalised(r: &Matrix3<Complex64>) -> Matrix3<Complex64> {
    let gram = r.transpose() * r;
    let three = Matrix3::identity() * Complex64::new(3.0, 0.0);
    r * (three - gram) * Complex64::new(0.5, 0.0)
}

/// The larger number; NaN if one is NaN, so that no comparison with it succeeds.
fn larger(x: f64, y: f64) -> f64 {
    if y <= x || x.is_nan() { x } else { y }
}

impl From<Pose> for ComplexPose {
    fn from(pose: Pose) -> Self {
        Self {
            rotation: pose.rotation.matrix().map(|x| Complex64::new(x, 0.0)),
            position: pose.position.map(|x| Complex64::new(x, 0.0)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::random_rotation;
    use num::Rng;

    #[test]
    fn poses_compose_and_invert() {
        let x = Pose {
            rotation: Rotation3::new(Vector3::new(0.1, 0.7, -0.3)),
            position: Vector3::new(1.0, 2.0, 3.0),
        };
        let y = Pose::shifted(Vector3::new(0.0, 0.0, 5.0));
        let none = x.compose(&x.inverse());
        assert!(none.position.norm() < 1e-14 && none.rotation.angle() < 1e-7);
        let point = Point3::new(0.3, -0.2, 0.7);
        assert!((x.compose(&y).transform(&point) - x.transform(&y.transform(&point))).norm() < 1e-14);
        assert_eq!(Pose::identity().compose(&x), x);
    }

    #[test]
    fn the_nearest_rotation_is_found_from_every_matrix_near_one() {
        let mut rng = Rng::new(3);
        for k in 0..2000 {
            let rotation = random_rotation(&mut rng);
            let noise = Matrix3::from_fn(|_, _| rng.normal()) * 10f64.powi(-(k % 17));
            // R (I + S) with a symmetric S has R as its polar factor
            let s = (noise + noise.transpose()) * (0.05 / noise.amax().max(1.0));
            let found = nearest_rotation(&(rotation.matrix() * (Matrix3::identity() + s)));
            assert!((found.matrix() - rotation.matrix()).amax() < 1e-14, "{k}");
            assert!((found.matrix() * found.matrix().transpose() - Matrix3::identity()).amax() < 1e-14);
        }
    }

    #[test]
    fn half_turns_are_their_own_nearest_rotations() {
        for d in [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]] {
            for noise in [0.0, 1e-13] {
                let mut m = Matrix3::from_diagonal(&Vector3::from(d));
                m[(0, 1)] += noise;
                assert!((nearest_rotation(&m).matrix() - m).amax() < 1e-12, "{d:?}");
            }
        }
    }
}
