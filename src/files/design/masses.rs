//! Moving bodies of a design: the platform with its payload, its plate, and the legs. Also their assumed values and the
//! resulting loads.

use nalgebra::{Matrix3, Point3, Vector3};

use super::DesignModel;
use super::scale::micrometres;
use machine::requirements::{
    ForceUnit, GRAVITY, LegsWeight, Load, MassUnit, MovingBodies, Payload, PlateBody, PlateMass, TermKind,
    VibratingMasses,
};
use platform::manipulator::Body;

/// The kinds of forces in an answer, which select its assumptions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AssessedForces {
    /// Leg forces or crank torques that hold loads.
    pub at_rest: bool,
    /// Forces along motions, or natural frequencies.
    pub in_motion: bool,
}

impl AssessedForces {
    /// Forces in requirements of these kinds.
    pub fn of(kinds: impl IntoIterator<Item = TermKind>) -> Self {
        let mut out = Self { at_rest: false, in_motion: false };
        for kind in kinds {
            out.at_rest |= matches!(kind, TermKind::LegForce | TermKind::CrankTorque);
            out.in_motion |= kind == TermKind::NaturalFrequency;
        }
        out
    }
}

impl DesignModel {
    /// The vibrating payload and legs. `None` if the file has no moving mass, no leg stiffness or no known unit of
    /// length.
    ///
    /// Without named units, forces are newtons and masses kilograms.
    #[must_use]
    pub fn vibrating(&self) -> Option<VibratingMasses> {
        let metres = micrometres(&self.units)? as f64 * 1e-6;
        let newtons = self.force_unit().newtons();
        let bodies = self.moving_bodies(metres)?;
        Some(VibratingMasses { bodies, leg: self.hardware.leg_stiffness? * newtons / metres })
    }

    /// The legs and the bodies that [move with the platform](Self::moving_payload), with the length of a design unit in
    /// metres. `motion`, natural frequencies and simulators use these masses. `None` if no mass moves with the
    /// platform. [`mass_assumptions`](Self::mass_assumptions) lists the assumptions.
    #[must_use]
    pub fn moving_bodies(&self, metres: f64) -> Option<MovingBodies> {
        Some(self.bodies_with(&self.moving_payload()?, metres))
    }

    /// The bodies of a file without moving mass. The platform gets this mass, with its centre in the middle of its
    /// joints and [the inertia of a ball](Self::moving_payload). The legs are those of the file.
    pub(crate) fn assumed_bodies(&self, kilograms: f64, metres: f64) -> MovingBodies {
        let mass = kilograms / self.mass_unit().kilograms();
        self.bodies_with(&self.unshaped(mass, self.platform_middle(), self.ball(mass)), metres)
    }

    /// The legs with the payload that moves with the platform.
    fn bodies_with(&self, payload: &Payload, metres: f64) -> MovingBodies {
        MovingBodies::new(payload, self.hardware.leg_masses.as_ref(), self.mass_unit(), metres)
    }

    /// The unit of all masses; kilograms if the file names none.
    pub fn mass_unit(&self) -> MassUnit {
        self.mass_units.unwrap_or(MassUnit::Kilogram)
    }

    /// The unit of all forces; newtons if the file names none.
    pub fn force_unit(&self) -> ForceUnit {
        self.force_units.unwrap_or(ForceUnit::Newton)
    }

    /// A body without a shape.
    fn unshaped(&self, mass: f64, center: Point3<f64>, inertia: Matrix3<f64>) -> Payload {
        let (inertia, gravity, plate) = (Some(inertia), self.gravity(), PlateMass::Included);
        Payload { mass, center, inertia, gravity, plate, shape: None }
    }

    /// Gravity, base frame, m/s^2: that of the payload, otherwise standard gravity along the negative third axis.
    pub(crate) fn gravity(&self) -> Vector3<f64> {
        self.payload.map_or_else(|| Vector3::new(0.0, 0.0, -GRAVITY), |payload| payload.gravity)
    }

    /// Inertia of a ball whose radius of gyration is the root mean square distance of the platform joints from their
    /// middle.
    fn ball(&self, mass: f64) -> Matrix3<f64> {
        let joints = self.manipulator.platform_joints();
        let middle = self.platform_middle();
        let squares: f64 = joints.iter().map(|b| (b - middle).norm_squared()).sum();
        Matrix3::identity() * (mass * squares / joints.len() as f64)
    }

    fn platform_middle(&self) -> Point3<f64> {
        let joints = self.manipulator.platform_joints();
        Point3::from(joints.iter().map(|b| b.coords).sum::<Vector3<f64>>() / joints.len() as f64)
    }

    /// The assumptions about masses and their units in motions, natural frequencies and models of simulators, one
    /// sentence each. They cover values that the file omits.
    #[must_use]
    pub fn mass_assumptions(&self) -> Vec<String> {
        if self.moving_payload().is_none() {
            return vec![
                "The design has no [payload]: forces and powers of motions are not computed.".to_owned(),
            ];
        }
        let mut out = Vec::new();
        if self.payload.is_some_and(|payload| payload.inertia.is_none()) {
            out.push("The payload has no inertia: a ball is assumed. Its radius of gyration is the RMS distance of the platform joints from their centroid.".to_owned());
        }
        out.extend(self.weight_assumptions());
        out
    }

    /// The assumptions about weights and their units in forces at rest, one sentence each.
    /// [`mass_assumptions`](Self::mass_assumptions) adds those of motions.
    #[must_use]
    pub fn weight_assumptions(&self) -> Vec<String> {
        let mut out = Vec::new();
        if self.moving_payload().is_none() {
            out.push("The design has no [payload]: the platform is assumed massless.".to_owned());
        }
        let weight = self.weight();
        if self.has_cranks() {
            out.push("Cranks and rods are assumed massless.".into());
        } else if self.hardware.leg_masses.is_none() {
            out.push("The legs have no masses in [hardware]: they are assumed massless.".into());
        } else if self.hardware.is_coupled() && weight.as_ref().is_some_and(|load| load.legs.is_some()) {
            let assumed = "The weight of a leg acts on the line between its joint centres; `offset` and `screw_lead` are neglected.";
            out.push(assumed.to_owned());
        }
        if self.force_units.is_none() {
            out.push("The design states no unit of force: newtons are assumed.".into());
        }
        if weight.is_some() && self.mass_units.is_none() {
            out.push("The design states no unit of mass: kilograms are assumed.".into());
        }
        out
    }

    /// The assumptions of forces at rest and in motion, each sentence once.
    pub fn assumptions_of(&self, forces: AssessedForces) -> Vec<String> {
        let mut out = if forces.in_motion { self.mass_assumptions() } else { Vec::new() };
        let at_rest = if forces.at_rest { self.weight_assumptions() } else { Vec::new() };
        let further = at_rest.into_iter().filter(|sentence| !out.contains(sentence)).collect::<Vec<_>>();
        out.extend(further);
        out
    }

    /// The plate of a body as a rigid body; `None` if its density or the unit of length is unknown.
    pub(crate) fn rigid_plate(&self, body: Body) -> Option<PlateBody> {
        let metres = micrometres(&self.units)? as f64 * 1e-6;
        self.plate(body)?.rigid(self.plates.of(body)?, metres)
    }

    /// Mass of the plate of a body without its holes, kilograms; `None` if its density or the unit of length is
    /// unknown.
    #[must_use]
    pub fn plate_mass(&self, body: Body) -> Option<f64> {
        self.rigid_plate(body).map(|plate| plate.mass)
    }

    /// The payload that moves with the platform, as stated in the file. It includes the plate of the platform if the
    /// file adds it. Without a payload it is the plate alone, if its mass is known.
    ///
    /// With masses `m` and `n`, centres `c` and `d`, inertias `I` and `J`: mass `m + n`, centre
    /// `(m c + n d) / (m + n)`, inertia `I + J` and `m n / (m + n) (e . e - e e^T)` with `e = c - d`. A payload without
    /// inertia gets that of a ball. Its radius of gyration is the root mean square distance of the platform joints from
    /// their middle.
    #[must_use]
    pub fn moving_payload(&self) -> Option<Payload> {
        let plate = || {
            let plate = self.rigid_plate(Body::Platform)?;
            let unit = self.mass_unit().kilograms();
            Some((plate.mass / unit, plate.center, plate.inertia / unit))
        };
        let Some(own) = self.payload else {
            let (mass, center, inertia) = plate()?;
            return Some(self.unshaped(mass, center, inertia));
        };
        let moments = own.inertia.unwrap_or_else(|| self.ball(own.mass));
        let Some((mass, center, inertia)) = plate().filter(|_| own.plate == PlateMass::Added) else {
            return Some(Payload { inertia: Some(moments), ..own });
        };
        let all = own.mass + mass;
        let apart = own.center - center;
        let spread = Matrix3::identity() * apart.norm_squared() - apart * apart.transpose();
        Some(Payload {
            mass: all,
            center: center + apart * (own.mass / all),
            inertia: Some(moments + inertia + spread * (own.mass * mass / all)),
            ..own
        })
    }

    /// The loads of the file, after the weight of all moving bodies if there are any.
    ///
    /// Without named units, forces are newtons and masses kilograms.
    #[must_use]
    pub fn all_loads(&self) -> Vec<Load> {
        self.weight().into_iter().chain(self.loads.iter().cloned()).collect()
    }

    /// The weight of [the moving payload](Self::moving_payload) and of the legs as one load, named after its first
    /// part: `payload`, `platform plate` or `legs`.
    fn weight(&self) -> Option<Load> {
        let units = (self.mass_unit(), self.force_unit());
        let legs = self.hardware.leg_masses.as_ref();
        let legs = legs.and_then(|masses| LegsWeight::new(masses, &self.gravity(), units.0, units.1));
        let moving = self.moving_payload();
        let name = match &moving {
            Some(_) if self.payload.is_some() => "payload",
            Some(_) => "platform plate",
            None => "legs",
        };
        // legs alone: the platform has no weight
        let payload =
            moving.or_else(|| legs.map(|_| self.unshaped(0.0, Point3::origin(), Matrix3::zeros())))?;
        Some(Load { name: name.to_owned(), legs, ..payload.weight(units.0, units.1) })
    }
}
