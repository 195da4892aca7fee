//! Inverse dynamics by the equations of Newton and Euler: from the motion of the platform to the forces of the drives.
//!
//! For a leg with `n = R b + p - a`, `l = |n|`, `u = n / l` and a head that moves with `v_b`, `a_b`,
//!
//! ```text
//! l' = u . v_b,   w = u x v_b / l,   l'' = u . a_b + l |w|^2,   w' = (u x a_b - 2 l' w) / l.
//! ```
//!
//! The leg turns about its base joint with `w`, without spin about its own line. The cylinder has the moment of inertia
//! `J_1 = I_1 + m_1 s_1^2` about the joint; the rod, its centre at `r = l - s_2`, has `J_2 = I_2 + m_2 r^2`. With the
//! force `h` of the platform on the head, moments about the base joint and forces along the rod give
//!
//! ```text
//! l u x h = (J_1 + J_2) w' + 2 m_2 r l' w - (m_1 s_1 + m_2 r) u x g,
//! F = m_2 (l'' - r |w|^2 - u . g) + m_d l'' + N,   N = -u . h,
//! ```
//!
//! and the platform with its payload, about the platform origin with `c' = R c`,
//!
//! ```text
//! sum N_i (u_i, R b_i x u_i) = (m (a_c - g), c' x m (a_c - g) + I w' + w x I w) - load + sum (h_i', R b_i x h_i'),
//! ```
//!
//! where `h'` is the part of `h` across the leg. Source: Dasgupta and Mruthyunjaya (1998), with the spin of the legs
//! and friction left out; Merlet, *Parallel Robots* (2006), sec. 9.

use nalgebra::{Matrix3, Vector3, Vector6};

use super::{MotionState, MovingBodies};
use platform::manipulator::{Leg, Manipulator, jacobian};

/// Length of a leg and its derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LegMotion {
    /// Design units.
    pub length: f64,
    /// Design units per second, positive where the leg becomes longer.
    pub speed: f64,
    /// Design units per second squared.
    pub acceleration: f64,
}

/// A leg in motion: the quantities that all its equations need.
pub(super) struct MovingLeg {
    /// Arm of the head from the platform origin, base frame.
    arm: Vector3<f64>,
    /// Unit vector from base joint to platform joint.
    pub(super) along: Vector3<f64>,
    pub(super) motion: LegMotion,
    /// Angular velocity and acceleration without spin.
    pub(super) turning: Vector3<f64>,
    turning_acceleration: Vector3<f64>,
}

impl MovingLeg {
    /// A leg of length zero has no direction: its numbers are NaN.
    pub(super) fn new(leg: &Leg, state: &MotionState) -> Self {
        let arm = state.pose.rotation * leg.platform.coords;
        let line = arm + state.pose.position - leg.base.coords;
        let length = line.norm();
        let along = line / length;
        let (velocity, acceleration) = state.of_arm(&arm);
        let speed = along.dot(&velocity);
        let turning = along.cross(&velocity) / length;
        let motion = LegMotion {
            length,
            speed,
            acceleration: along.dot(&acceleration) + length * turning.norm_squared(),
        };
        let turning_acceleration = (along.cross(&acceleration) - 2.0 * speed * turning) / length;
        Self { arm, along, motion, turning, turning_acceleration }
    }

    /// Distance of the centre of the rod from the base joint.
    pub(super) fn rod_at(&self, bodies: &MovingBodies) -> f64 {
        self.motion.length - bodies.leg.rod.center
    }

    /// `J_1 + J_2`.
    pub(super) fn inertia(&self, bodies: &MovingBodies) -> f64 {
        let (cylinder, rod) = (&bodies.leg.cylinder, &bodies.leg.rod);
        cylinder.inertia
            + cylinder.mass * cylinder.center.powi(2)
            + rod.inertia
            + rod.mass * self.rod_at(bodies).powi(2)
    }

    /// The part of the force of the platform on the head that is across the leg.
    fn across(&self, bodies: &MovingBodies) -> Vector3<f64> {
        let (cylinder, rod) = (&bodies.leg.cylinder, &bodies.leg.rod);
        let at = self.rod_at(bodies);
        let moment = self.inertia(bodies) * self.turning_acceleration
            + 2.0 * rod.mass * at * self.motion.speed * self.turning
            - (cylinder.mass * cylinder.center + rod.mass * at) * self.along.cross(&bodies.gravity);
        moment.cross(&self.along) / self.motion.length
    }

    /// Force of the drive minus the push on the platform.
    fn own(&self, bodies: &MovingBodies) -> f64 {
        let rod = &bodies.leg.rod;
        let centripetal = self.rod_at(bodies) * self.turning.norm_squared();
        rod.mass * (self.motion.acceleration - centripetal - self.along.dot(&bodies.gravity))
            + bodies.leg.reflected * self.motion.acceleration
    }
}

/// Lengths, speeds and accelerations of the legs: inverse kinematics with two derivatives. They are NaN for a leg of
/// length zero.
#[must_use]
pub fn leg_motions(m: &Manipulator, state: &MotionState) -> [LegMotion; 6] {
    m.legs().map(|leg| MovingLeg::new(&leg, state).motion)
}

/// Inertia of platform and payload in the base frame.
pub(super) fn turned_inertia(bodies: &MovingBodies, state: &MotionState) -> Matrix3<f64> {
    let r = state.pose.rotation.matrix();
    r * bodies.inertia * r.transpose()
}

/// The forces of the drives, positive where they push the platform. `load` is a force and a torque about the platform
/// origin on the platform besides the weight, base frame.
///
/// `None` at a singular pose, where the forces do not exist or are not unique, and for a leg of length zero.
#[must_use]
pub fn drive_forces(
    m: &Manipulator,
    bodies: &MovingBodies,
    state: &MotionState,
    load: &Vector6<f64>,
) -> Option<[f64; 6]> {
    let legs = m.legs().map(|leg| MovingLeg::new(&leg, state));
    let center = state.pose.rotation * bodies.center.coords;
    let (_, acceleration) = state.of_arm(&center);
    let inertia = turned_inertia(bodies, state);
    let turning = state.angular_velocity;
    let mut force = bodies.mass * (acceleration - bodies.gravity);
    let mut torque =
        center.cross(&force) + inertia * state.angular_acceleration + turning.cross(&(inertia * turning));
    for leg in &legs {
        let across = leg.across(bodies);
        force += across;
        torque += leg.arm.cross(&across);
    }
    force -= load.fixed_rows::<3>(0);
    torque -= load.fixed_rows::<3>(3);
    // moments are divided by the size, so all rows of the system have the same unit
    let size = m.size();
    let torque = torque / size;
    let right = Vector6::new(force.x, force.y, force.z, torque.x, torque.y, torque.z);
    let pushes = jacobian(m, &state.pose, size).transpose().lu().solve(&right)?;
    let forces: [f64; 6] = std::array::from_fn(|i| pushes[i] + legs[i].own(bodies));
    forces.iter().all(|x| x.is_finite()).then_some(forces)
}
