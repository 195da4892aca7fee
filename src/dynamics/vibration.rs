//! Stiffness of a platform on legs that give way along their lines, and its natural frequencies.
//!
//! Legs of stiffness `k` hold the platform at a pose with `K = J^T diag(k) J`, where row `i` of `J` is `(u_i, R b_i x u_i)`: a small motion `x = (d, w)` (shift of the platform origin, rotation vector) needs
//! the force and torque `K x`. With the mass matrix `M` of platform, payload and legs at the pose, small free motions are sums of `v sin(omega t)` with `K v = omega^2 M v`. Joints, plates and the
//! stiffness that preloaded legs add are left out. Sources: Gosselin (1990) for `K`; Merlet, *Parallel Robots* (2006), sec. 8.

use nalgebra::{Matrix3, Matrix6, Vector6};

use super::MovingBodies;
use crate::geom::Pose;
use crate::manipulator::{Manipulator, jacobian};
use crate::num::small::{bounded_svd, symmetric_eigen3};

/// `K = k J^T J`: force units per design unit, times design units for each index of rotation.
#[must_use]
pub fn stiffness_matrix(m: &Manipulator, pose: &Pose, leg: f64) -> Matrix6<f64> {
    let j = jacobian(m, pose, 1.0);
    j.transpose() * j * leg
}

/// The mass matrix about the platform origin, base frame: kilograms, times design units for each index of rotation. The kinetic energy is half of `x'^T M x'` with the twist
/// `x' = (v, w)`.
#[must_use]
pub fn mass_matrix(m: &Manipulator, bodies: &MovingBodies, pose: &Pose) -> Matrix6<f64> {
    let r = pose.rotation.matrix();
    let cross = (r * bodies.center.coords).cross_matrix();
    let mut out = Matrix6::zeros();
    let mut add = |mass: &Matrix3<f64>, cross: &Matrix3<f64>| {
        // v + w x c = v - [c] w
        let coupled = mass * cross;
        let corner = |out: &mut Matrix6<f64>, i: usize, j: usize, part: &Matrix3<f64>| {
            let mut view = out.fixed_view_mut::<3, 3>(i, j);
            view += part;
        };
        corner(&mut out, 0, 0, mass);
        corner(&mut out, 0, 3, &-coupled);
        corner(&mut out, 3, 0, &-coupled.transpose());
        corner(&mut out, 3, 3, &(cross.transpose() * coupled));
    };
    add(&(Matrix3::identity() * bodies.mass), &cross);
    let (cylinder, rod) = (&bodies.leg.cylinder, &bodies.leg.rod);
    for leg in m.legs() {
        let arm = pose.rotation * leg.platform.coords;
        let line = arm + pose.position - leg.base.coords;
        let length = line.norm();
        let along = line / length;
        let turning = cylinder.inertia
            + cylinder.mass * cylinder.center.powi(2)
            + rod.inertia
            + rod.mass * (length - rod.center).powi(2);
        let lengthwise = along * along.transpose();
        let at_head = lengthwise * (rod.mass + bodies.leg.reflected)
            + (Matrix3::identity() - lengthwise) * (turning / (length * length));
        add(&at_head, &arm.cross_matrix());
    }
    let inertia = r * bodies.inertia * r.transpose();
    let mut view = out.fixed_view_mut::<3, 3>(3, 3);
    view += inertia;
    out
}

/// Least stiffness against forces and against torques.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeastStiffness {
    /// Against a force through the platform origin in the softest direction, the platform free to turn: force units per design unit.
    pub linear: f64,
    /// Against a torque about the softest axis, the platform origin free to move: force units times design units per radian.
    pub angular: f64,
}

/// The least stiffness of a stiffness matrix: the inverses of the greatest compliances, which are eigenvalues of the two blocks of `K^-1`. `None` for a singular one.
#[must_use]
pub fn least_stiffness(stiffness: &Matrix6<f64>) -> Option<LeastStiffness> {
    let compliance = stiffness.try_inverse()?;
    let softest = |at: usize| {
        let block: Matrix3<f64> = compliance.fixed_view::<3, 3>(at, at).into();
        1.0 / symmetric_eigen3(&(0.5 * (block + block.transpose()))).0.max()
    };
    let found = LeastStiffness { linear: softest(0), angular: softest(3) };
    [found.linear, found.angular].iter().all(|x| x.is_finite() && *x > 0.0).then_some(found)
}

/// A natural motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vibration {
    /// Hertz.
    pub frequency: f64,
    /// Its shape: shift of the platform origin (design units) and rotation vector (radians), with `v^T M v = 1`.
    pub shape: Vector6<f64>,
}

/// The six natural motions, the slowest first: `K v = omega^2 M v`.
///
/// `omega` are the singular values of `sqrt(k) J L^-T` with `M = L L^T`, which no rounding makes imaginary. The stiffness of a leg is in kilograms per second squared, which is newtons per metre
/// whatever the design unit. `None` where `M` is not positive definite (a point mass has no inertia about axes through itself), or for a leg of length zero.
#[must_use]
pub fn vibration(m: &Manipulator, pose: &Pose, leg: f64, mass: &Matrix6<f64>) -> Option<[Vibration; 6]> {
    // in units in which the diagonal of M is one
    let scale = Vector6::from_fn(|k, _| mass[(k, k)].sqrt());
    let lower = Matrix6::from_fn(|i, j| mass[(i, j)] / (scale[i] * scale[j])).cholesky()?.l();
    let back = lower.try_inverse()?.transpose();
    let lines = jacobian(m, pose, 1.0) * leg.sqrt();
    let lines = Matrix6::from_fn(|i, j| lines[(i, j)] / scale[j]) * back;
    if !lines.iter().all(|x| x.is_finite()) {
        return None;
    }
    let found = bounded_svd(&lines)?;
    let shapes = found.v_t?;
    let mut order: [usize; 6] = std::array::from_fn(|k| k);
    order.sort_by(|a, b| found.singular_values[*a].total_cmp(&found.singular_values[*b]));
    Some(order.map(|k| Vibration {
        frequency: found.singular_values[k] / std::f64::consts::TAU,
        shape: (back * shapes.row(k).transpose()).component_div(&scale),
    }))
}
