//! Loads on the platform and the leg forces in equilibrium with them.

use nalgebra::{LU, Matrix6, Point3, Rotation3, U6, Vector3, Vector6};

use super::hardware::LegMasses;
use super::payload::{ForceUnit, MassUnit};
use num::smooth::{SmoothNumber, cross, dot, norm_squared};
use platform::geom::Pose;
use platform::manipulator::{Body, Manipulator, jacobian};

/// A force and a torque that act on the platform.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    /// The name in reports.
    pub name: String,
    /// Force, force units.
    pub force: Vector3<f64>,
    /// Torque besides that of the force, force units times design units.
    pub torque: Vector3<f64>,
    /// Point of application of the force, platform frame.
    pub at: Point3<f64>,
    /// The frame in which force and torque keep their direction: the base for weight, the platform for a cutting force.
    pub fixed_to: Body,
    /// The weight of the legs, if it is part of the load.
    pub legs: Option<LegsWeight>,
}

/// The weight of six equal legs at rest, as forces on the platform joints.
///
/// The cylinder of a leg has the mass `m_1`, with its centre `s_1` from the base joint. The rod has the mass `m_2`,
/// with its centre `s_2` from the platform joint. With the length `q`, the direction `u` and gravity `g`, the force on
/// the platform joint is
///
/// ```text
/// w = m_2 g + (m_1 s_1 - m_2 s_2) (g - u (u . g)) / q
/// ```
///
/// Drive forces in equilibrium with the six `w` hold the legs (statics; `docs/theory/requirements.md`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LegsWeight {
    /// `m_2 g`, force units, base frame.
    pub rod: Vector3<f64>,
    /// `(m_1 s_1 - m_2 s_2) g`, force units times design units, base frame.
    pub moment: Vector3<f64>,
}

impl LegsWeight {
    /// The weight of legs under gravity in m/s^2; `None` for massless legs.
    #[must_use]
    pub fn new(legs: &LegMasses, gravity: &Vector3<f64>, mass: MassUnit, force: ForceUnit) -> Option<Self> {
        let (cylinder, rod) = (&legs.cylinder, &legs.rod);
        let in_unit = gravity * (mass.kilograms() / force.newtons());
        let moment = cylinder.mass * cylinder.center - rod.mass * rod.center;
        (cylinder.mass > 0.0 || rod.mass > 0.0)
            .then(|| Self { rod: in_unit * rod.mass, moment: in_unit * moment })
    }

    /// The force `w` on the platform joint of a leg, by the line from its base joint to its platform joint. `None`
    /// where the leg may have length zero.
    pub fn at_joint<N: SmoothNumber>(&self, line: &[N; 3]) -> Option<[N; 3]> {
        let over = norm_squared(line).inverse_root()?;
        let fixed = |v: &Vector3<f64>| [0, 1, 2].map(|k| over.alike(v[k]));
        let (rod, moment, along) = (fixed(&self.rod), fixed(&self.moment), line.map(|x| x * over));
        let lengthwise = dot(&along, &moment);
        Some(std::array::from_fn(|k| rod[k] + (moment[k] - along[k] * lengthwise) * over))
    }
}

impl Load {
    /// Force and torque about the platform origin, both in the base frame; `m` gives the legs that weigh.
    #[must_use]
    pub fn wrench(&self, m: &Manipulator, pose: &Pose) -> Vector6<f64> {
        let legs = m.legs().map(|leg| {
            let arm = pose.rotation * leg.platform.coords;
            (arm, arm + pose.position - leg.base.coords)
        });
        self.wrench_on(&pose.rotation, &legs)
    }

    /// The same wrench for legs given by their arms `R b` and their lines `R b + p - a`; NaN if a leg with weight has
    /// length zero.
    #[must_use]
    pub fn wrench_on(
        &self,
        rotation: &Rotation3<f64>,
        legs: &[(Vector3<f64>, Vector3<f64>); 6],
    ) -> Vector6<f64> {
        let (fixed, turned) = (|v: &Vector3<f64>| (*v).into(), |v: &Vector3<f64>| (rotation * v).into());
        let wrench = self.wrench_of(fixed, turned, |i| (legs[i].0.into(), legs[i].1.into()));
        wrench.map_or(Vector6::repeat(f64::NAN), Vector6::from)
    }

    /// The same wrench in other number types, from vectors of the base frame, vectors of the platform frame, and legs.
    /// `None` where a leg with weight may have length zero.
    pub(super) fn wrench_of<N: SmoothNumber>(
        &self,
        fixed: impl Fn(&Vector3<f64>) -> [N; 3],
        turned: impl Fn(&Vector3<f64>) -> [N; 3],
        leg: impl Fn(usize) -> ([N; 3], [N; 3]),
    ) -> Option<[N; 6]> {
        let own = |v: &Vector3<f64>| match self.fixed_to {
            Body::Base => fixed(v),
            Body::Platform => turned(v),
        };
        let sum = |a: [N; 3], b: [N; 3]| [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
        let mut force = own(&self.force);
        let mut torque = sum(own(&self.torque), cross(&turned(&self.at.coords), &force));
        if let Some(weight) = &self.legs {
            for (arm, line) in (0..6).map(leg) {
                let at_joint = weight.at_joint(&line)?;
                torque = sum(torque, cross(&arm, &at_joint));
                force = sum(force, at_joint);
            }
        }
        let ([a, b, c], [d, e, f]) = (force, torque);
        Some([a, b, c, d, e, f])
    }
}

/// Leg forces in equilibrium with a wrench `(f, t)` (about the platform origin, base frame):
/// `sum F_i (u_i, R b_i x u_i) = -(f, t)`.
///
/// Positive forces push the platform (compression). `scale` is a length that makes moments comparable with forces in
/// the linear system, for instance the size of the design. The answer does not depend on it. `None` at a singular pose,
/// where the forces do not exist or are not unique. `None` at a singular pose, where no forces or many hold the load.
#[must_use]
pub fn leg_forces(m: &Manipulator, pose: &Pose, wrench: &Vector6<f64>, scale: f64) -> Option<Vector6<f64>> {
    HeldLines::new(&jacobian(m, pose, scale), scale).forces(wrench)
}

/// Lines of legs at a pose, factorised for loads.
#[derive(Debug, Clone)]
pub struct HeldLines {
    columns: LU<f64, U6, U6>,
    scale: f64,
}

impl HeldLines {
    /// The solver for lines given by rows, with their moments over a length.
    #[must_use]
    pub fn new(rows: &Matrix6<f64>, scale: f64) -> Self {
        Self { columns: rows.transpose().lu(), scale }
    }

    /// Forces in equilibrium with a wrench, as in [`leg_forces`].
    #[must_use]
    pub fn forces(&self, wrench: &Vector6<f64>) -> Option<Vector6<f64>> {
        let mut right = -wrench;
        right.fixed_rows_mut::<3>(3).scale_mut(1.0 / self.scale);
        let forces = self.columns.solve(&right)?;
        forces.iter().all(|x| x.is_finite()).then_some(forces)
    }

    /// The matrix that maps minus a wrench with its torque over the length to forces; `None` at a singular pose.
    #[must_use]
    pub fn inverse(&self) -> Option<Matrix6<f64>> {
        self.columns.try_inverse()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use platform::manipulator::Leg;

    #[test]
    fn forces_balance_the_load_about_every_point() {
        let m = Manipulator::from_legs(std::array::from_fn(|i| {
            let t = i as f64;
            Leg {
                base: Point3::new(20.0 * (1.1 * t).cos(), 20.0 * (1.1 * t).sin(), 0.3 * t),
                platform: Point3::new(9.0 * (1.0 + t).cos(), 9.0 * (1.0 + t).sin(), 0.2),
            }
        }))
        .unwrap();
        let pose = Pose {
            rotation: Rotation3::from_euler_angles(0.1, -0.2, 0.3),
            position: Vector3::new(1.0, 2.0, 25.0),
        };
        let load = Load {
            name: "cut".into(),
            force: Vector3::new(3.0, -1.0, -40.0),
            torque: Vector3::new(0.5, 7.0, -2.0),
            at: Point3::new(1.0, 2.0, 6.0),
            fixed_to: Body::Platform,
            legs: None,
        };
        let forces = leg_forces(&m, &pose, &load.wrench(&m, &pose), 20.0).unwrap();
        // balance about the base origin, from the definitions
        let (mut f, mut t) = (pose.rotation * load.force, pose.rotation * load.torque);
        t += pose.transform(&load.at).coords.cross(&f);
        for (leg, x) in m.legs().iter().zip(forces.iter()) {
            let end = pose.transform(&leg.platform);
            let push = (end - leg.base).normalize() * *x;
            f += push;
            t += end.coords.cross(&push);
        }
        assert!(f.norm() < 1e-12 * 40.0 && t.norm() < 1e-11 * 400.0, "{f} {t}");
        assert_eq!(
            leg_forces(&m, &pose, &load.wrench(&m, &pose), 0.5).map(|g| (g - forces).norm() < 1e-9),
            Some(true)
        );
    }
}
