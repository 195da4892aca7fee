//! How the masses of the design are shared out among bodies that a simulator can move.
//!
//! Legs without masses, or with little, are more than a solver of constraints can hold: the drive of a leg acts on a
//! body that weighs nothing. But a point mass in the joint of a leg and the platform moves as well with the platform as
//! with the rod. So each rod carries a share `m` of the mass of the platform in that joint, `b`, and the platform the
//! rest:
//!
//! ```text
//! M' = M - 6 m,   M' c' = M c - m sum b,   S' = S - m sum b b^T,
//! ```
//!
//! with the second moments `S = tr(I) / 2 - I + M c c^T` about the platform origin. The model then moves as the
//! platform, payload and legs of the design do, and its drives push as much. `m` is as great as leaves `S'` about `c'`
//! positive, since `MuJoCo` takes no other bodies.

use nalgebra::{Matrix3, SymmetricEigen, Vector3};

use super::Export;
use super::text::real;
use machine::requirements::{LegMasses, LegPart};

/// Each rod has this share of the mass of the platform moving along it where the platform can spare it.
const WANTED: f64 = 0.05;
/// The same at which the time step is that of the size; with less it is shorter in proportion. `MuJoCo` followed a
/// bench with this share, and lost it with a quarter of it.
const ENOUGH: f64 = 0.02;
/// The least share that is looked for.
const LEAST: f64 = 5e-4;
/// How much of the least second moment of the platform remains.
const REMAINS: f64 = 0.25;
/// Mass of a body over that of the rods, and moment of inertia over mass times squared size, where the design says
/// none: bodies without any are refused, and these change no force by a millionth.
const NEARLY_NONE: f64 = 1e-9;
/// `MuJoCo` refuses less (`mjMINVAL` is 1e-15).
const ACCEPTED: f64 = 2e-15;

/// A rigid body in SI units.
#[derive(Debug, Clone, Copy)]
pub(super) struct Solid {
    pub(super) mass: f64,
    /// The centre of mass in the frame of the body.
    pub(super) center: Vector3<f64>,
    /// About the centre of mass.
    pub(super) inertia: Matrix3<f64>,
}

impl Solid {
    /// About the centre of mass.
    fn second_moments(&self) -> Matrix3<f64> {
        Matrix3::identity() * (0.5 * self.inertia.trace()) - self.inertia
    }

    fn least_moment(&self) -> f64 {
        SymmetricEigen::new(self.second_moments()).eigenvalues.min()
    }

    /// Without a point mass at each of six points; `None` where that leaves too little.
    fn without(&self, share: f64, points: &[Vector3<f64>; 6]) -> Option<Self> {
        let mass = self.mass - 6.0 * share;
        let center = (self.center * self.mass - points.iter().sum::<Vector3<f64>>() * share) / mass;
        let taken: Matrix3<f64> = points.iter().map(|b| b * b.transpose() * share).sum();
        let about_origin = |at: &Vector3<f64>, mass: f64| at * at.transpose() * mass;
        let moments = self.second_moments() + about_origin(&self.center, self.mass)
            - taken
            - about_origin(&center, mass);
        let inertia = Matrix3::identity() * moments.trace() - moments;
        let rest = Self { mass, center, inertia };
        let enough = REMAINS * self.least_moment();
        (mass > 0.0 && enough > 0.0 && rest.least_moment() >= enough).then_some(rest)
    }
}

/// The masses of the model, SI units.
#[derive(Debug)]
pub(super) struct ModelMasses {
    platform: Solid,
    leg: LegMasses,
    /// What each rod carries of the mass of the platform in its joint.
    share: f64,
    /// Whether the platform cannot spare it, so that it comes on top.
    added: bool,
    /// The time step over that which the size allows.
    pub(super) step: f64,
    size: f64,
}

impl ModelMasses {
    pub(super) fn of(export: &Export) -> Self {
        let (moving, metres) = (&export.moving, export.unit.metres);
        let platform = Solid {
            mass: moving.mass,
            center: moving.center.coords * metres,
            inertia: moving.inertia * (metres * metres),
        };
        let mut leg = moving.leg;
        for part in [&mut leg.cylinder, &mut leg.rod] {
            part.center *= metres;
            part.inertia *= metres * metres;
        }
        let joints = &export.bodies[1].joints;
        let points = export.legs.map(|l| joints[l.platform].at.coords * metres);
        let own = leg.lengthwise();
        let wanted = (WANTED * platform.mass - own).max(0.0);
        let shares = std::iter::successors(Some(wanted), |share| Some(0.8 * share));
        let spared = shares
            .take_while(|share| *share >= LEAST * platform.mass)
            .find_map(|share| platform.without(share, &points).map(|rest| (share, rest)));
        let size = export.size * metres;
        let enough = ENOUGH * platform.mass;
        let added = spared.is_none() && own < enough;
        let (share, rest) = spared.unwrap_or(((enough - own).max(0.0), platform));
        let step = ((share + own) / enough).min(1.0);
        Self { platform: rest, leg, share, added, step, size }
    }

    /// Mass that moves along the leg in place of what turns in its drive.
    pub(super) fn armature(&self) -> f64 {
        self.leg.reflected
    }

    pub(super) fn platform(&self) -> Solid {
        self.platform
    }

    /// A body that has next to no mass: a yoke, a crank.
    pub(super) fn nothing(&self) -> Solid {
        self.thin(&LegPart::default(), 0.0)
    }

    pub(super) fn cylinder(&self) -> Solid {
        self.thin(&self.leg.cylinder, self.leg.cylinder.center)
    }

    /// The rod with its share, in a frame whose third axis leads along it and in which the joint of the platform is so
    /// many metres from the origin.
    pub(super) fn rod(&self, tip: f64) -> Solid {
        let (own, share) = (&self.leg.rod, self.share);
        let mass = own.mass + share;
        let center = if mass > 0.0 { own.mass * own.center / mass } else { 0.0 };
        let spread = if mass > 0.0 { own.mass * share / mass * own.center.powi(2) } else { 0.0 };
        let whole = LegPart { mass, center, inertia: own.inertia + spread };
        self.thin(&whole, tip - center)
    }

    /// A part of a leg, its centre so many metres from the origin of its body along the third axis.
    fn thin(&self, part: &LegPart, center: f64) -> Solid {
        let mass = part.mass.max(NEARLY_NONE * (self.leg.lengthwise() + self.share)).max(ACCEPTED);
        let least = (NEARLY_NONE * mass * self.size * self.size).max(ACCEPTED);
        let across = part.inertia.max(least);
        let along = (NEARLY_NONE * across).max(ACCEPTED);
        let inertia = Matrix3::from_diagonal(&Vector3::new(across, across, along));
        Solid { mass, center: Vector3::new(0.0, 0.0, center), inertia }
    }

    /// The masses in sentences, for the comment of the file.
    pub(super) fn words(&self, export: &Export) -> String {
        let LegMasses { cylinder, rod, reflected } = &self.leg;
        let legs = if self.leg == LegMasses::default() {
            ", legs without mass".to_owned()
        } else {
            let [cylinder, rod, reflected] = [cylinder.mass, rod.mass, *reflected].map(real);
            format!("; each cylinder {cylinder} kg, rod {rod} kg, armature of the slide {reflected} kg")
        };
        let share = real(self.share);
        let carried = if self.added {
            format!(". Each rod has {share} kg more, which the design doesn't have: a simulator needs it")
        } else if self.share > 0.0 {
            format!(
                ".\n  Each rod carries {share} kg of the platform in their joint, which moves nothing differently and keeps the simulation stable"
            )
        } else {
            String::new()
        };
        format!("platform with payload {} kg{legs}{carried}", real(export.moving.mass))
    }
}

impl Export {
    /// What each rod of the simulator's model weighs that the design doesn't have, kilograms; `None` where the platform
    /// can spare it.
    #[must_use]
    pub fn added_rod_mass(&self) -> Option<f64> {
        let masses = ModelMasses::of(self);
        masses.added.then_some(masses.share)
    }
}
