//! Frames for the eliminations: first leg in both origins, both bodies turned at random, lengths scaled.
//!
//! Cayley coordinates `e = (1, c)` miss the half-turns and single out coordinate axes. After random rotations of both
//! frames the finitely many roots avoid the exceptions with probability one.

use nalgebra::{Matrix3, Rotation3, Vector3};
use num_complex::Complex64;

use num::Rng;
use platform::geom::{ComplexPose, random_rotation, rotation_from_quaternion};
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// The products `e_i e_j`, `i <= j`, in the order in which forms in `e` are stored.
pub(crate) const PRODUCTS: [(usize, usize); 10] =
    [(0, 0), (0, 1), (0, 2), (0, 3), (1, 1), (1, 2), (1, 3), (2, 2), (2, 3), (3, 3)];

/// A problem in its own frames: legs 2..6 of a platform whose leg 1 joins the two origins.
#[derive(Debug, Clone)]
pub struct GenericProblem {
    /// Base ends of legs 2..6.
    pub base: [Vector3<f64>; 5],
    /// Platform ends of legs 2..6.
    pub platform: [Vector3<f64>; 5],
    /// Squared length of leg 1.
    pub first: f64,
    /// Squared lengths of legs 2..6.
    pub others: [f64; 5],
    frame: GenericFrame,
}

/// A root as an elimination gives it, in the frames of its problem: neither refined nor checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RawCandidate {
    /// The quaternion `(1, c)`, `c` the Cayley vector, up to a factor.
    pub quaternion: [Complex64; 4],
    /// The position.
    pub position: Vector3<Complex64>,
}

/// `x' = turn (x - origin) / scale` in each body.
#[derive(Debug, Clone)]
struct GenericFrame {
    base_origin: Vector3<f64>,
    platform_origin: Vector3<f64>,
    base_turn: Rotation3<f64>,
    platform_turn: Rotation3<f64>,
    scale: f64,
}

impl GenericProblem {
    /// The problem `(m, s)` in frames drawn from `rng`; lengths are divided by the larger of the design's size
    /// and the RMS leg length.
    #[must_use]
    pub fn draw(m: &Manipulator, s: &SquaredLegLengths, rng: &mut Rng) -> Self {
        let turns = [random_rotation(rng), random_rotation(rng)];
        Self::in_frames(m, s, turns, m.size().max((s.get().iter().sum::<f64>() / 6.0).sqrt()))
    }

    /// The problem in the axes and units of the design: only the origins are moved to the joints of leg 1.
    #[must_use]
    pub fn as_given(m: &Manipulator, s: &SquaredLegLengths) -> Self {
        Self::in_frames(m, s, [Rotation3::identity(); 2], 1.0)
    }

    /// The problem with the bodies turned and all lengths divided by `scale`.
    fn in_frames(m: &Manipulator, s: &SquaredLegLengths, turns: [Rotation3<f64>; 2], scale: f64) -> Self {
        let legs = m.legs();
        let s = s.get();
        let frame = GenericFrame {
            base_origin: legs[0].base.coords,
            platform_origin: legs[0].platform.coords,
            base_turn: turns[0],
            platform_turn: turns[1],
            scale,
        };
        let area = frame.scale * frame.scale;
        Self {
            base: std::array::from_fn(|i| {
                frame.base_turn * (legs[i + 1].base.coords - frame.base_origin) / frame.scale
            }),
            platform: std::array::from_fn(|i| {
                frame.platform_turn * (legs[i + 1].platform.coords - frame.platform_origin) / frame.scale
            }),
            first: s[0] / area,
            others: std::array::from_fn(|i| s[i + 1] / area),
            frame,
        }
    }

    /// A candidate of the problem as one of the [`unscaled`](Self::unscaled) problem.
    #[must_use]
    pub fn in_units(&self, candidate: &RawCandidate) -> RawCandidate {
        RawCandidate { position: candidate.position * Complex64::from(self.frame.scale), ..*candidate }
    }

    /// The problem in the same axes with lengths in the units of the design.
    #[must_use]
    pub fn unscaled(&self) -> Self {
        let (scale, area) = (self.frame.scale, self.frame.scale * self.frame.scale);
        Self {
            base: self.base.map(|v| v * scale),
            platform: self.platform.map(|v| v * scale),
            first: self.first * area,
            others: self.others.map(|s| s * area),
            frame: GenericFrame { scale: 1.0, ..self.frame.clone() },
        }
    }

    /// The pose in the design's frames of a candidate; `None` when it is at infinity or `e.e = 0`.
    #[must_use]
    pub fn pose(&self, candidate: &RawCandidate) -> Option<ComplexPose> {
        let pose = self.to_design(candidate.quaternion, candidate.position);
        pose.rotation.iter().chain(pose.position.iter()).all(|z| z.is_finite()).then_some(pose)
    }

    /// The pose in the design's frames of the quaternion `e` (any scale, `e.e != 0`) and position `t` in these.
    fn to_design(&self, e: [Complex64; 4], t: Vector3<Complex64>) -> ComplexPose {
        let f = &self.frame;
        let lift = |m: &Matrix3<f64>| m.map(Complex64::from);
        let back = lift(&f.base_turn.matrix().transpose());
        let rotation = back * rotation_from_quaternion(e) * lift(f.platform_turn.matrix());
        let position = back * t * Complex64::from(f.scale) + f.base_origin.map(Complex64::from)
            - rotation * f.platform_origin.map(Complex64::from);
        ComplexPose { rotation, position }
    }
}

/// `N R(e)` as a quadratic form: the matrices `K` with `N R = sum_k K_k e_i e_j` over [`PRODUCTS`].
pub(crate) fn rotation_forms() -> [Matrix3<f64>; 10] {
    // a homogeneous quadratic map from its values at unit vectors and their sums; all entries 0, 1, 2
    let at = |i: usize, j: usize| {
        let mut e = [0.0; 4];
        e[i] = 1.0;
        e[j] = 1.0;
        let [w, x, y, z]: [f64; 4] = e;
        Matrix3::new(
            w * w + x * x - y * y - z * z,
            2.0 * (x * y - w * z),
            2.0 * (x * z + w * y),
            2.0 * (x * y + w * z),
            w * w - x * x + y * y - z * z,
            2.0 * (y * z - w * x),
            2.0 * (x * z - w * y),
            2.0 * (y * z + w * x),
            w * w - x * x - y * y + z * z,
        )
    };
    PRODUCTS.map(|(i, j)| if i == j { at(i, i) } else { at(i, j) - at(i, i) - at(j, j) })
}

/// `N` in the same basis.
pub(crate) fn norm_form() -> [f64; 10] {
    PRODUCTS.map(|(i, j)| if i == j { 1.0 } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;
    use platform::geom::Pose;
    use platform::manipulator::Leg;

    #[test]
    fn a_pose_found_in_the_frames_is_a_pose_of_the_design() {
        let mut rng = Rng::new(3);
        let legs = std::array::from_fn(|_| {
            let mut p = || Point3::from(Vector3::from_fn(|_, _| 5.0 * rng.normal()));
            Leg { base: p(), platform: p() }
        });
        let m = Manipulator::from_legs(legs).unwrap();
        let pose = Pose { rotation: random_rotation(&mut rng), position: Vector3::new(1.0, -7.0, 3.0) };
        let s = pose.squared_lengths(&m).unwrap();
        let g = GenericProblem::draw(&m, &s, &mut rng);
        let f = &g.frame;
        let turned = f.base_turn * pose.rotation * f.platform_turn.inverse();
        let q = nalgebra::UnitQuaternion::from_rotation_matrix(&turned);
        let t = f.base_turn * (pose.rotation * f.platform_origin + pose.position - f.base_origin) / f.scale;
        let back = g.to_design([q.w, q.i, q.j, q.k].map(Complex64::from), t.map(Complex64::from));
        assert!(back.distance(&pose.into(), m.size()) < 1e-13);
        let e = [q.w, q.i, q.j, q.k];
        let sum: Matrix3<f64> =
            rotation_forms().iter().zip(PRODUCTS).map(|(k, (i, j))| k * (e[i] * e[j])).sum();
        assert!((sum - turned.matrix()).norm() < 1e-14);
        for i in 0..5 {
            let d = turned * g.platform[i] + t - g.base[i];
            assert!((d.norm_squared() - g.others[i]).abs() < 1e-13);
        }
        assert!((t.norm_squared() - g.first).abs() < 1e-13);
    }
}
