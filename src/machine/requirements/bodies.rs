//! The bodies that move: the platform with its payload, and cylinder and rod of each leg.

use nalgebra::{Matrix3, Point3, Vector3};

use super::{LegMasses, MassUnit, Payload};

/// Masses, centres and inertias in kilograms and design units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovingBodies {
    /// Mass of the platform with its payload, kilograms.
    pub mass: f64,
    /// Its centre of mass, platform frame.
    pub center: Point3<f64>,
    /// Its inertia about the centre of mass, axes of the platform frame; zero for a point mass.
    pub inertia: Matrix3<f64>,
    /// Masses of each leg; all zero for legs without masses.
    pub leg: LegMasses,
    /// Gravity, base frame, design units per second squared.
    pub gravity: Vector3<f64>,
    /// Metres per design unit.
    pub metres: f64,
}

impl MovingBodies {
    /// The bodies that a design file describes; `metres` is the length of its unit. A payload without inertia counts as
    /// a point mass; legs without masses have none. `Design::moving_payload` states an inertia.
    #[must_use]
    pub fn new(payload: &Payload, leg: Option<&LegMasses>, unit: MassUnit, metres: f64) -> Self {
        let kilograms = unit.kilograms();
        Self {
            mass: payload.mass * kilograms,
            center: payload.center,
            inertia: payload.inertia.unwrap_or_else(Matrix3::zeros) * kilograms,
            leg: leg.copied().unwrap_or_default().scaled(kilograms),
            gravity: payload.gravity / metres,
            metres,
        }
    }

    /// A force of this module in newtons.
    #[must_use]
    pub fn newtons(&self, force: f64) -> f64 {
        force * self.metres
    }
}
