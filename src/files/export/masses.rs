//! Distribution of the masses of the design over bodies that a simulator can move.
//!
//! Legs with little or no mass make a constraint solver unstable, since the drive of a leg acts on a body without mass.
//! But a point mass in the joint of a leg and the platform moves equally with the platform and with the rod. So each
//! rod carries a share `m` of the platform mass in that joint, `b`, and the platform has the rest:
//!
//! ```text
//! M' = M - 6 m,   M' c' = M c - m sum b,   S' = S - m sum b b^T,
//! ```
//!
//! with the second moments `S = tr(I) / 2 - I + M c c^T` about the platform origin. The model then has the motion and
//! drive forces of the platform, payload and legs of the design. `m` is as great as possible with positive `S'` about
//! `c'`, which `MuJoCo` requires.

use nalgebra::{Matrix3, SymmetricEigen, Vector3};

use super::Export;
use super::text::real;
use machine::requirements::{LegMasses, LegPart};

/// Share of the platform mass that moves along each rod, if the platform has enough mass.
const ROD_SHARE: f64 = 0.05;
/// Least share with the time step of the size; below it the step shrinks in proportion. `MuJoCo` simulated a bench with
/// this share, and failed with a quarter of it.
const ENOUGH: f64 = 0.02;
/// The least share of the search.
const LEAST: f64 = 5e-4;
/// Least remaining part of the smallest second moment of the platform.
const REMAINS: f64 = 0.25;
/// Mass of a body over that of the rods, and inertia over mass times squared size, if the design gives none. `MuJoCo`
/// refuses bodies without mass; these change forces by less than a millionth.
const NEARLY_NONE: f64 = 1e-9;
/// Least accepted value of `MuJoCo` (`mjMINVAL` is 1e-15).
const ACCEPTED: f64 = 2e-15;

/// A rigid body in SI units.
#[derive(Debug, Clone, Copy)]
pub(super) struct Solid {
    pub(super) mass: f64,
    /// The centre of mass in the frame of the body.
    pub(super) center: Vector3<f64>,
    /// Inertia about the centre of mass.
    pub(super) inertia: Matrix3<f64>,
}

impl Solid {
    /// The second moments about the centre of mass.
    fn second_moments(&self) -> Matrix3<f64> {
        Matrix3::identity() * (0.5 * self.inertia.trace()) - self.inertia
    }

    fn least_moment(&self) -> f64 {
        SymmetricEigen::new(self.second_moments()).eigenvalues.min()
    }

    /// The body without a point mass at each of six points; `None` if too little remains.
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
    /// The share of the platform mass that each rod carries in its joint.
    share: f64,
    /// Whether the platform is too light to give it, so that it is added.
    added: bool,
    /// The time step over that of the size.
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
        let missing = (ROD_SHARE * platform.mass - own).max(0.0);
        let shares = std::iter::successors(Some(missing), |share| Some(0.8 * share));
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

    /// Equivalent mass along the leg of the rotating parts of its drive.
    pub(super) fn armature(&self) -> f64 {
        self.leg.reflected
    }

    pub(super) fn platform(&self) -> Solid {
        self.platform
    }

    /// A body of nearly no mass: a yoke, a crank.
    pub(super) fn nothing(&self) -> Solid {
        self.thin(&LegPart::default(), 0.0)
    }

    pub(super) fn cylinder(&self) -> Solid {
        self.thin(&self.leg.cylinder, self.leg.cylinder.center)
    }

    /// The rod with its share, in a frame with the third axis along it. The joint of the platform is at the distance
    /// `tip`, metres, from the origin.
    pub(super) fn rod(&self, tip: f64) -> Solid {
        let (own, share) = (&self.leg.rod, self.share);
        let mass = own.mass + share;
        let center = if mass > 0.0 { own.mass * own.center / mass } else { 0.0 };
        let spread = if mass > 0.0 { own.mass * share / mass * own.center.powi(2) } else { 0.0 };
        let whole = LegPart { mass, center, inertia: own.inertia + spread };
        self.thin(&whole, tip - center)
    }

    /// A part of a leg, with its centre at the distance `center`, metres, from the origin of its body along the third
    /// axis.
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
            format!(". Each rod has {share} kg that the design does not have, because a simulator needs it")
        } else if self.share > 0.0 {
            format!(
                ".\n  Each rod carries {share} kg of the platform in their joint; this keeps the simulation stable and changes no motion"
            )
        } else {
            String::new()
        };
        format!("platform with payload {} kg{legs}{carried}", real(export.moving.mass))
    }
}

impl Export {
    /// Mass that each rod has only in the simulator's model, kilograms; `None` if the platform is heavy enough.
    #[must_use]
    pub fn added_rod_mass(&self) -> Option<f64> {
        let masses = ModelMasses::of(self);
        masses.added.then_some(masses.share)
    }
}
