//! The payload of the platform, and its weight.

use nalgebra::{Matrix3, Point3, Vector3};

use super::keep_out::KeepOutShape;
use super::load::Load;
use platform::manipulator::Body;

/// Standard gravity, m/s^2.
pub const GRAVITY: f64 = 9.806_65;

num::words! {
    /// A unit of force.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum ForceUnit: word(label), ALL {
        /// Newton.
        Newton = "N",
        /// Thousand newtons.
        Kilonewton = "kN",
        /// Kilogram-force.
        KilogramForce = "kgf",
        /// Pound-force.
        PoundForce = "lbf",
    }
}

impl ForceUnit {
    /// The unit in newtons.
    #[must_use]
    pub fn newtons(self) -> f64 {
        match self {
            Self::Newton => 1.0,
            Self::Kilonewton => 1000.0,
            Self::KilogramForce => GRAVITY,
            Self::PoundForce => 4.448_221_615_260_5,
        }
    }
}

num::words! {
    /// A unit of mass.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum MassUnit: word(label), ALL {
        /// Gram.
        Gram = "g",
        /// Kilogram.
        Kilogram = "kg",
        /// Tonne.
        Tonne = "t",
        /// Pound.
        Pound = "lb",
    }
}

impl MassUnit {
    /// The unit in kilograms.
    #[must_use]
    pub fn kilograms(self) -> f64 {
        match self {
            Self::Gram => 1e-3,
            Self::Kilogram => 1.0,
            Self::Tonne => 1000.0,
            Self::Pound => 0.453_592_37,
        }
    }
}

num::words! {
    /// Whether the mass of the payload includes that of the platform plate.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum PlateMass: name, ALL {
        /// The mass includes the plate.
        #[default]
        Included = "included",
        /// The plate is added.
        Added = "added",
    }
}

/// The mass on the platform; [`plate`](Self::plate) tells whether it includes the platform plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Payload {
    /// Mass, mass units.
    pub mass: f64,
    /// Centre of mass, platform frame, design units.
    pub center: Point3<f64>,
    /// Inertia about the centre of mass along the axes of the platform frame, mass units times design units squared;
    /// symmetric.
    pub inertia: Option<Matrix3<f64>>,
    /// Gravity, base frame, m/s^2.
    pub gravity: Vector3<f64>,
    /// Whether the mass of the platform plate is part of the mass.
    pub plate: PlateMass,
    /// The space that it occupies, platform frame, which the legs keep clear of.
    pub shape: Option<KeepOutShape>,
}

impl Payload {
    /// The weight as a load: `m g` in force units, at the centre of mass, of fixed direction in the base frame.
    #[must_use]
    pub fn weight(&self, mass: MassUnit, force: ForceUnit) -> Load {
        Load {
            name: "payload".to_owned(),
            force: self.gravity * (self.mass * mass.kilograms() / force.newtons()),
            torque: Vector3::zeros(),
            at: self.center,
            fixed_to: Body::Base,
            legs: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weight_is_mass_times_gravity_in_the_units_of_the_design() {
        let payload = Payload {
            mass: 100.0,
            center: Point3::new(0.0, 0.0, 400.0),
            inertia: None,
            gravity: Vector3::new(0.0, 0.0, -GRAVITY),
            plate: PlateMass::Included,
            shape: None,
        };
        let down = |mass, force| payload.weight(mass, force).force.z;
        assert!((down(MassUnit::Kilogram, ForceUnit::Newton) + 980.665).abs() < 1e-12);
        assert!((down(MassUnit::Kilogram, ForceUnit::KilogramForce) + 100.0).abs() < 1e-12);
        assert!(
            (down(MassUnit::Pound, ForceUnit::PoundForce) + 100.0).abs() < 1e-9,
            "a pound weighs a pound"
        );
        assert!((down(MassUnit::Tonne, ForceUnit::Kilonewton) + 980.665).abs() < 1e-12);
        assert_eq!(payload.weight(MassUnit::Gram, ForceUnit::Newton).at, payload.center);
    }
}
