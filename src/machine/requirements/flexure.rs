//! The wrench of bent flexures on the platform.
//!
//! A flexure with the bending stiffness `k` about its centre, whose leg stands at the angle `t` from its axis `n`,
//! holds the energy `k t^2 / 2`. The wrench on the platform is minus the derivative of the energies of all flexures by
//! the motion of the platform. The unit vector `e` is across the leg, away from the axis. The leg has the direction `u`
//! and the length `l`, its platform joint the arm `c`:
//!
//! ```text
//! base:      force -k t e / l,   torque -k t c x e / l
//! platform:  force -k t e / l,   torque -k t (c x e / l - u x e)
//! ```

use nalgebra::Vector3;

use super::term::Terms;
use platform::geom::Pose;
use platform::manipulator::Body;

/// A force and a torque about the platform origin, base frame.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Wrench {
    /// Force units.
    pub force: Vector3<f64>,
    /// Force units times design units.
    pub torque: Vector3<f64>,
}

/// `t e` of a leg with the direction `u` and the axis `n`, unit vectors: zero if they are equal.
fn bent(u: &Vector3<f64>, n: &Vector3<f64>) -> Vector3<f64> {
    // (n x u) x u is n minus its part along u, reversed
    let across = u * n.dot(u) - n;
    let sine = n.cross(u).norm();
    if sine > 0.0 { across * (sine.atan2(n.dot(u)) / sine) } else { Vector3::zeros() }
}

impl Terms<'_> {
    /// The wrench of the flexures on the platform at a pose; `None` where the design has none. They do not resist the
    /// rotation of a leg about itself.
    #[must_use]
    pub fn flexure_wrench(&self, pose: &Pose) -> Option<Wrench> {
        let hardware = &self.required.hardware;
        let stiffness = [hardware.base_bending, hardware.platform_bending];
        if stiffness.iter().flatten().all(Option::is_none) {
            return None;
        }
        let mut out = Wrench::default();
        for (i, leg) in self.manipulator.legs().iter().enumerate() {
            let arm = pose.rotation * leg.platform.coords;
            let line = pose.transform(&leg.platform) - leg.base;
            let length = line.norm();
            let u = line / length;
            for body in Body::BOTH {
                let Some(k) = stiffness[body.index()][i] else { continue };
                let own = self.axes()[body.index()][i];
                let axis = if body == Body::Base { own } else { pose.rotation * own };
                let pull = bent(&u, &axis) * -k;
                out.force += pull / length;
                out.torque += arm.cross(&pull) / length;
                if body == Body::Platform {
                    out.torque -= u.cross(&pull);
                }
            }
        }
        Some(out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::requirements::{Hardware, Requirements};
    use nalgebra::Rotation3;

    #[test]
    fn the_wrench_is_minus_the_slope_of_the_energy() {
        let m = crate::fixtures::symmetric_hexapod(2.0, 1.0);
        let home = platform::manipulator::default_home(&m);
        let hardware = Hardware {
            base_bending: [Some(3.0); 6],
            platform_bending: [Some(2.0); 6],
            ..Hardware::default()
        };
        let required = Requirements { hardware, ..Requirements::default() };
        let terms = Terms::new(&m, &required, &home);
        assert!(terms.flexure_wrench(&home).unwrap().force.norm() < 1e-12, "at rest at home");
        let moved = |v: &Vector3<f64>, w: &Vector3<f64>, from: &Pose| Pose {
            rotation: Rotation3::new(*w) * from.rotation,
            position: from.position + v,
        };
        let pose = moved(&Vector3::new(0.2, -0.1, 0.3), &Vector3::new(0.1, 0.2, -0.3), &home);
        let energy = |pose: &Pose| -> f64 {
            let legs = m.legs();
            let cone_angle = |body: usize, i: usize| {
                let line = pose.transform(&legs[i].platform) - legs[i].base;
                let line = if body == 0 { line } else { pose.rotation.inverse() * line };
                line.angle(&terms.axes()[body][i])
            };
            (0..6).map(|i| 1.5 * cone_angle(0, i).powi(2) + cone_angle(1, i).powi(2)).sum()
        };
        let found = terms.flexure_wrench(&pose).unwrap();
        let h = 1e-6;
        for k in 0..3 {
            let unit = Vector3::ith(k, h);
            let none = Vector3::zeros();
            let slope = |v: &Vector3<f64>, w: &Vector3<f64>| {
                (energy(&moved(v, w, &pose)) - energy(&moved(&-v, &-w, &pose))) / (2.0 * h)
            };
            assert!((slope(&unit, &none) + found.force[k]).abs() < 1e-8);
            assert!((slope(&none, &unit) + found.torque[k]).abs() < 1e-8);
        }
        let none = Requirements::default();
        assert_eq!(Terms::new(&m, &none, &home).flexure_wrench(&pose), None);
    }
}
