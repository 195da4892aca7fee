//! The effect of joint errors on the pose, to first order.

use nalgebra::{Matrix3, Point3, Vector3};

use super::joint::joints;
use platform::geom::{Pose, turn_between};
use platform::manipulator::{Body, Manipulator, inverse_condition, jacobian};

/// Below this inverse condition number (platform radius as characteristic length) a pose counts as singular.
const SINGULAR: f64 = 1e-10;

/// Error of the pose that a controller computes, per unit of error of each joint.
///
/// The controller measures the lengths of the true legs, at `a_i + da_i` and `b_i + db_i`, and solves with the nominal
/// joints. With `u_i` the leg directions and `J` the rows `[u_i, (R b_i) x u_i]`, the computed pose differs from the
/// true one by the twist
///
/// ```text
/// (v, w) = J^-1 e,     e_i = (R^T u_i) . db_i - u_i . da_i,
/// ```
///
/// and a tool point `q` of the platform by `v + w x (R q)`. Both are sums `sum_j G_j d_j` over the joints, with 3 x 3
/// matrices `G_j`. An equivalent platform has the same poses at corresponding lengths. The error is therefore the same
/// if the controller solves for the equivalent octahedral platform.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivity {
    /// `G_j` of the position of the tool point, base frame, in the order of [`joints`].
    pub position: Vec<Matrix3<f64>>,
    /// `G_j` of the rotation vector of the error, base frame, radians per design unit.
    pub rotation: Vec<Matrix3<f64>>,
    /// Columns of `J^-1`: shift of the tool point per unit by which a length is shown too long, base frame.
    pub leg_position: [Vector3<f64>; 6],
    /// The same columns for the rotation vector, radians per design unit.
    pub leg_rotation: [Vector3<f64>; 6],
}

impl Sensitivity {
    /// At a pose, for a tool point in the platform frame; `None` at a singular pose.
    #[must_use]
    pub fn at(m: &Manipulator, pose: &Pose, tool: &Point3<f64>) -> Option<Self> {
        if inverse_condition(&jacobian(m, pose, m.platform_rms_radius())) < SINGULAR {
            return None;
        }
        let inverse = jacobian(m, pose, 1.0).try_inverse()?;
        let turn: nalgebra::Matrix3x6<f64> = inverse.fixed_rows::<3>(3).into();
        let arm = (pose.rotation * tool.coords).cross_matrix();
        let shift: nalgebra::Matrix3x6<f64> = inverse.fixed_rows::<3>(0) - arm * turn;
        let list = joints(m);
        let zero = vec![Matrix3::zeros(); list.len()];
        let column = |m: &nalgebra::Matrix3x6<f64>, i: usize| -> Vector3<f64> { m.column(i).into() };
        let mut out = Self {
            position: zero.clone(),
            rotation: zero,
            leg_position: std::array::from_fn(|i| column(&shift, i)),
            leg_rotation: std::array::from_fn(|i| column(&turn, i)),
        };
        let back = pose.rotation.inverse();
        for (i, (leg, pair)) in m.legs().iter().zip(m.pairs()).enumerate() {
            let u = (pose.transform(&leg.platform) - leg.base).normalize();
            for (body, index, direction) in [(Body::Base, pair.0, -u), (Body::Platform, pair.1, back * u)] {
                let own = list.iter().position(|j| (j.body, j.index) == (body, index));
                let Some(j) = own else { continue };
                out.position[j] += shift.column(i) * direction.transpose();
                out.rotation[j] += turn.column(i) * direction.transpose();
            }
        }
        Some(out)
    }

    /// Error of position (base frame, design units) and rotation vector (base frame, radians) for errors in the order
    /// of [`joints`].
    #[must_use]
    pub fn error(&self, errors: &[Vector3<f64>]) -> (Vector3<f64>, Vector3<f64>) {
        let sum = |g: &[Matrix3<f64>]| g.iter().zip(errors).map(|(g, d)| g * d).sum();
        (sum(&self.position), sum(&self.rotation))
    }
}

impl Sensitivity {
    /// The same error for lengths shown too long by `errors`, in leg order.
    #[must_use]
    pub fn error_of_lengths(&self, errors: &[f64; 6]) -> (Vector3<f64>, Vector3<f64>) {
        let sum = |columns: &[Vector3<f64>; 6]| columns.iter().zip(errors).map(|(c, e)| c * *e).sum();
        (sum(&self.leg_position), sum(&self.leg_rotation))
    }
}

/// The difference between the poses `found` and `truth`: shift of the tool point and rotation vector, both in the base
/// frame.
pub(super) fn pose_error(found: &Pose, truth: &Pose, tool: &Point3<f64>) -> (Vector3<f64>, Vector3<f64>) {
    (found.transform(tool) - truth.transform(tool), turn_between(&truth.rotation, &found.rotation))
}
