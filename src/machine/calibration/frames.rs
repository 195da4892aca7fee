//! From the frames in which poses were measured to those of a design.

use nalgebra::{DMatrix, Matrix3, Point3, Vector3};

use super::model::{LegModel, Unknowns};
use num::small::bounded_svd;
use platform::geom::Pose;
use platform::manipulator::Body;

/// Points whose spread across a line is below this share of the spread along it do not determine a rotation.
const ON_A_LINE: f64 = 1e-6;

/// The rigid motion with which measured joints are nearest to those of the design: a point x of the measurements is at
/// R x + p.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, schemars::JsonSchema), schemars(rename = "FrameMotionRecord", transform = num::nullable))]
pub struct FrameMotion {
    /// The motion.
    pub motion: Pose,
    /// RMS of the remaining distances, design units.
    pub rms: f64,
}

/// Two rigid motions.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, schemars::JsonSchema),
    schemars(rename = "FrameMotionsRecord")
)]
pub struct CarriedFrames {
    /// Motion of the base frame.
    pub base: FrameMotion,
    /// Motion of the platform frame.
    pub platform: FrameMotion,
}

/// The rotation and translation with the least sum of squared distances between `R from + p` and `to` (Umeyama 1991,
/// without scale). Reflections are excluded, so points in a plane also get a rotation.
///
/// `None` for collinear points, since the rotation about their line is undetermined.
#[must_use]
pub fn rigid_motion(from: &[Point3<f64>], to: &[Point3<f64>]) -> Option<FrameMotion> {
    let count = from.len().min(to.len());
    if count < 3 {
        return None;
    }
    let mean = |points: &[Point3<f64>]| {
        points[..count].iter().map(|p| p.coords).sum::<Vector3<f64>>() / count as f64
    };
    let (a, b) = (mean(from), mean(to));
    let pairs = from.iter().zip(to);
    let cross = pairs.map(|(x, y)| (y.coords - b) * (x.coords - a).transpose()).sum::<Matrix3<f64>>();
    let svd = bounded_svd(&cross)?;
    let (u, v_t) = (svd.u?, svd.v_t?);
    if !(svd.singular_values[1] > ON_A_LINE * svd.singular_values[0]) {
        return None;
    }
    let sign = if (u * v_t).determinant() < 0.0 { -1.0 } else { 1.0 };
    let rotation = u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, sign)) * v_t;
    let rotation = platform::geom::nearest_rotation(&rotation);
    let motion = Pose { rotation, position: b - rotation * a };
    let squares = from.iter().zip(to).map(|(x, y)| (motion.transform(x) - y).norm_squared());
    Some(FrameMotion { motion, rms: (squares.sum::<f64>() / count as f64).sqrt() })
}

impl CarriedFrames {
    /// The motions that take the joints of a model nearest to those of another with the same legs. Joints count once,
    /// those without legs not at all.
    #[must_use]
    pub fn between(measured: &LegModel, nominal: &LegModel) -> Option<Self> {
        let of = |body: Body| {
            let points = |m: &LegModel| -> Vec<Point3<f64>> {
                let joints = body.of((&m.base, &m.platform));
                let used = |j: &usize| m.pairs.iter().any(|pair| body.of(*pair) == *j);
                (0..joints.len()).filter(used).map(|j| joints[j]).collect()
            };
            rigid_motion(&points(measured), &points(nominal))
        };
        Some(Self { base: of(Body::Base)?, platform: of(Body::Platform)? })
    }

    /// The model in the frames of the design.
    #[must_use]
    pub fn carry(&self, measured: &LegModel) -> LegModel {
        let moved = |points: &[Point3<f64>], frame: &FrameMotion| {
            points.iter().map(|p| frame.motion.transform(p)).collect()
        };
        LegModel {
            base: moved(&measured.base, &self.base),
            platform: moved(&measured.platform, &self.platform),
            ..measured.clone()
        }
    }

    /// A root of the covariance of the unknowns, rotated with the joints. The motions count as exact: their uncertainty
    /// is already part of that of the joints.
    #[must_use]
    pub fn carry_root(&self, unknowns: &Unknowns, root: &DMatrix<f64>) -> DMatrix<f64> {
        let mut out = root.clone();
        let joints = [(Body::Base, &self.base), (Body::Platform, &self.platform)];
        for (body, frame) in joints {
            for column in unknowns.joint_columns(body) {
                let turned = frame.motion.rotation.matrix() * root.rows(column, 3);
                out.rows_mut(column, 3).copy_from(&turned);
            }
        }
        out
    }

    /// The pose that is measured where the design means `pose`.
    #[must_use]
    pub fn measured_pose(&self, pose: &Pose) -> Pose {
        let back = self.base.motion.rotation.inverse();
        let at = pose.rotation * self.platform.motion.position + pose.position;
        Pose {
            rotation: back * pose.rotation * self.platform.motion.rotation,
            position: back * (at - self.base.motion.position),
        }
    }
}
