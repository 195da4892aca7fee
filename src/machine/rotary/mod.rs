//! Rotary hexapods: platforms on rods of constant length with cranks, as driven by servo motors.
//!
//! Crank `i` turns about the axis `n` (unit) through its centre `c`; at the angle `q` its tip is
//!
//! ```text
//! a(q) = c + r (e cos q + (n x e) sin q),      e across n, the direction of angle 0,
//! ```
//!
//! and a rod of length `l` joins the tip to the platform joint `b`. For given angles the tips are joints of the base,
//! so all theory of six legs with lengths applies to the rods. Forward kinematics is that of the platform on the tips,
//! with the same certificates. Leg maps are affine between *squared lengths* of legs and do not apply to angles. A
//! platform with other joints needs other cranks.
//!
//! `docs/theory/rotary.md` has the derivations.

mod symmetric;
#[cfg(test)]
mod tests;
mod tracker;

use nalgebra::{Matrix6, Point3, Unit, Vector3, Vector6};
use thiserror::Error;

use fk::{FkError, FkOptions, FkSolutions, solver};
use platform::geom::Pose;
use platform::manipulator::{InvalidManipulator, Leg, LegLengths, Manipulator, jacobian_of_legs};

pub use tracker::RotaryTracker;

num::answer_words! {
    /// A side of a crank.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[cfg_attr(feature = "serde", schemars(rename = "ElbowWord"))]
    pub enum Elbow as name {
        // between crank and the plane of axis and platform joint
        /// The greater of the two angles.
        // `q_0 + w`
        Plus = "plus",
        /// The smaller one.
        // `q_0 - w`
        Minus = "minus",
    }
}

impl Elbow {
    /// The other side.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::Plus => Self::Minus,
            Self::Minus => Self::Plus,
        }
    }
}

/// A crank, in the base frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crank {
    /// A point of its axis, in the plane in which the tip moves.
    pub centre: Point3<f64>,
    /// Its axis; angles follow the right-hand rule.
    pub axis: Unit<Vector3<f64>>,
    /// Direction of the tip at the angle zero; its part along the axis is ignored.
    pub zero: Vector3<f64>,
    /// Distance of the tip from the axis, design units.
    pub length: f64,
}

/// A leg: a crank, a rod, and the joint of the platform.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RotaryLeg {
    /// The crank.
    pub crank: Crank,
    /// Length of the rod, design units.
    pub rod: f64,
    /// The joint of the platform, platform frame.
    pub platform: Point3<f64>,
    /// The side that the crank stays on.
    pub elbow: Elbow,
    /// Least and greatest angle, radians; `None`: no limits.
    pub limits: Option<(f64, f64)>,
}

/// Reasons why cranks and rods define no platform.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum InvalidRotary {
    /// A length is not positive, or a number is not finite; the leg from 0.
    #[error("leg {}: crank and rod have positive finite lengths, and joints finite coordinates", .0 + 1)]
    BadNumber(usize),
    /// The direction of the angle zero is along the axis; the leg from 0.
    #[error("leg {}: the direction of the angle zero is along the axis of the crank", .0 + 1)]
    ZeroAlongAxis(usize),
    /// Tips and joints define no platform, at the angles zero.
    #[error(transparent)]
    Manipulator(#[from] InvalidManipulator),
}

/// The angle of a crank and its derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrankMotion {
    /// Radians.
    pub angle: f64,
    /// Radians per second.
    pub speed: f64,
    /// Radians per second squared.
    pub acceleration: f64,
}

/// Both angles at which a crank can hold a platform joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrankAngles {
    /// The middle `q_0`: the angle of the tip nearest to the platform joint, from `-pi` to `pi`.
    pub middle: f64,
    /// Half the difference of both angles, from 0 (crank and rod in line, one angle) to `pi`.
    pub half: f64,
}

impl CrankAngles {
    /// The angle of a side, from `-pi` to `pi`.
    #[must_use]
    pub fn of(&self, elbow: Elbow) -> f64 {
        let angle = match elbow {
            Elbow::Plus => self.middle + self.half,
            Elbow::Minus => self.middle - self.half,
        };
        wrapped(angle)
    }
}

/// The same angle from `-pi` to `pi`.
fn wrapped(angle: f64) -> f64 {
    angle - std::f64::consts::TAU * (angle / std::f64::consts::TAU).round()
}

/// The same angle within half a turn of another one.
#[must_use]
pub fn angle_near(middle: f64, angle: f64) -> f64 {
    if middle == 0.0 { wrapped(angle) } else { middle + wrapped(angle - middle) }
}

/// The place of a platform joint relative to a crank, which decides the rods that reach it.
///
/// In the plane of the crank the joint is at the distance `across` from the axis, in the direction of the angle
/// `middle`. The rod at the angle `q` has the length `l` with `l^2 = |d|^2 + r^2 - 2 r across cos(q - middle)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrankReach {
    crank: f64,
    square: f64,
    across: f64,
    /// The angle of the tip nearest to the platform joint, from `-pi` to `pi`.
    pub middle: f64,
}

impl CrankReach {
    /// A crank of this length. `square` is `|d|^2` for the way `d` from its centre to the platform joint; `x` and `y`
    /// are its components at the angle 0 and at a quarter turn.
    #[must_use]
    pub fn new(crank: f64, square: f64, [x, y]: [f64; 2]) -> Self {
        Self { crank, square, across: x.hypot(y), middle: y.atan2(x) }
    }

    /// The length of the rod at an angle.
    #[must_use]
    pub fn rod(&self, angle: f64) -> f64 {
        self.rod_at((angle - self.middle).cos())
    }

    fn rod_at(&self, cosine: f64) -> f64 {
        let along = (self.square - self.across * self.across).max(0.0);
        // (across - r)^2 has no cancellation when crank and rod are in line
        let turned = 2.0 * self.crank * self.across * (1.0 - cosine);
        (along + (self.across - self.crank).powi(2) + turned).sqrt()
    }

    /// The shortest and the longest rod that reaches; crank and rod are then in one plane with the axis.
    #[must_use]
    pub fn rods(&self) -> [f64; 2] {
        [1.0, -1.0].map(|cosine| self.rod_at(cosine))
    }

    /// Both angles for a rod.
    ///
    /// ```text
    /// x cos q + y sin q = k = (|d|^2 + r^2 - l^2) / (2 r),      q = middle +- acos(k / across)
    /// ```
    ///
    /// # Errors
    /// The missing length of a rod that does not reach; negative if the rod is too long.
    pub fn angles(&self, rod: f64) -> Result<CrankAngles, f64> {
        let k = (self.square + self.crank * self.crank - rod * rod) / (2.0 * self.crank);
        let cosine = k / self.across;
        // a few units in the last place are rounding
        if !(cosine.abs() <= 1.0 + 1e-14) {
            let [shortest, longest] = self.rods();
            return Err(if k > 0.0 { shortest - rod } else { longest - rod });
        }
        Ok(CrankAngles { middle: self.middle, half: cosine.clamp(-1.0, 1.0).acos() })
    }
}

/// A pose that cranks and rods cannot hold.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("leg {}: the rod does not reach from the circle of the crank to the platform joint; it is {by} too short, or too long where this is negative", .leg + 1)]
pub struct OutOfReach {
    /// The leg, from 0.
    pub leg: usize,
    /// Missing length of the rod, design units; negative if the rod is too long.
    pub by: f64,
}

/// Six legs with cranks.
#[derive(Debug, Clone, PartialEq)]
pub struct RotaryPlatform {
    legs: [RotaryLeg; 6],
    /// The lengths of the rods.
    rods: LegLengths,
    /// Directions of angle 0 and of a quarter turn.
    directions: [[Vector3<f64>; 2]; 6],
}

impl RotaryPlatform {
    /// Checks cranks and rods.
    ///
    /// # Errors
    /// [`InvalidRotary`].
    pub fn try_new(legs: [RotaryLeg; 6]) -> Result<Self, InvalidRotary> {
        let mut directions = [[Vector3::zeros(); 2]; 6];
        for (i, leg) in legs.iter().enumerate() {
            let crank = &leg.crank;
            let finite = |v: &Vector3<f64>| v.iter().all(|x| x.is_finite());
            let lengths = [crank.length, leg.rod].iter().all(|x| *x > 0.0 && x.is_finite());
            if !lengths
                || ![&crank.centre.coords, &leg.platform.coords, &crank.zero, &crank.axis.into_inner()]
                    .into_iter()
                    .all(finite)
            {
                return Err(InvalidRotary::BadNumber(i));
            }
            let n = crank.axis.into_inner();
            let across = crank.zero - n * n.dot(&crank.zero);
            let e = across.try_normalize(1e-9 * crank.zero.norm()).ok_or(InvalidRotary::ZeroAlongAxis(i))?;
            directions[i] = [e, n.cross(&e)];
        }
        let rods = LegLengths::try_new(legs.map(|leg| leg.rod)).map_err(|_| InvalidRotary::BadNumber(0))?;
        let made = Self { legs, rods, directions };
        made.at(&[0.0; 6])?;
        Ok(made)
    }

    /// The legs.
    #[must_use]
    pub fn legs(&self) -> &[RotaryLeg; 6] {
        &self.legs
    }

    /// Unit vectors along each crank at the angle 0 and at a quarter turn, base frame.
    #[must_use]
    pub fn directions(&self) -> &[[Vector3<f64>; 2]; 6] {
        &self.directions
    }

    /// Position of the tip of a crank at an angle, base frame.
    #[must_use]
    pub fn tip(&self, leg: usize, angle: f64) -> Point3<f64> {
        let [e, f] = self.directions[leg];
        let (sin, cos) = angle.sin_cos();
        self.legs[leg].crank.centre + (e * cos + f * sin) * self.legs[leg].crank.length
    }

    /// The tips as base joints, and the platform joints.
    fn ends(&self, angles: &[f64; 6]) -> [Leg; 6] {
        std::array::from_fn(|i| Leg { base: self.tip(i, angles[i]), platform: self.legs[i].platform })
    }

    /// The platform on the tips of the cranks at these angles: its legs are the rods, with the lengths [`Self::rods`].
    ///
    /// # Errors
    /// Tips and joints that make no platform.
    pub fn at(&self, angles: &[f64; 6]) -> Result<Manipulator, InvalidManipulator> {
        Manipulator::from_legs(self.ends(angles))
    }

    /// The lengths of the rods.
    #[must_use]
    pub fn rods(&self) -> &LegLengths {
        &self.rods
    }

    /// The place of the platform joint of a leg relative to its crank, at a pose.
    #[must_use]
    pub fn reach(&self, leg: usize, pose: &Pose) -> CrankReach {
        let RotaryLeg { crank, platform, .. } = &self.legs[leg];
        let d = pose.transform(platform) - crank.centre;
        CrankReach::new(
            crank.length,
            d.norm_squared(),
            self.directions[leg].map(|direction| d.dot(&direction)),
        )
    }

    /// Both angles of each crank for a pose of the platform, regardless of their limits. A joint on the axis of the
    /// crank determines no angle.
    ///
    /// # Errors
    /// The first leg whose rod does not reach.
    pub fn both_angles(&self, pose: &Pose) -> Result<[CrankAngles; 6], OutOfReach> {
        let mut out = [CrankAngles { middle: 0.0, half: 0.0 }; 6];
        for (leg, angles) in out.iter_mut().enumerate() {
            let found = self.reach(leg, pose).angles(self.legs[leg].rod);
            *angles = found.map_err(|by| OutOfReach { leg, by })?;
        }
        Ok(out)
    }

    /// Inverse kinematics: the angle of each crank on its side. It is from `-pi` to `pi` for a crank without limits,
    /// otherwise within half a turn of the middle of its limits. [`Self::within_limits`] checks the limits.
    ///
    /// # Errors
    /// The first leg whose rod does not reach.
    pub fn ik(&self, pose: &Pose) -> Result<[f64; 6], OutOfReach> {
        let both = self.both_angles(pose)?;
        Ok(std::array::from_fn(|i| self.counted(i, both[i].of(self.legs[i].elbow))))
    }

    /// The same angle, within half a turn of the middle of the crank's limits.
    #[must_use]
    pub fn counted(&self, leg: usize, angle: f64) -> f64 {
        angle_near(self.legs[leg].limits.map_or(0.0, |(least, most)| 0.5 * (least + most)), angle)
    }

    /// Margins of each crank to its limits, radians: negative beyond them, infinite without limits.
    #[must_use]
    pub fn limit_margins(&self, angles: &[f64; 6]) -> [f64; 6] {
        std::array::from_fn(|i| {
            let limits = self.legs[i].limits;
            limits.map_or(f64::INFINITY, |(least, most)| (angles[i] - least).min(most - angles[i]))
        })
    }

    /// Whether all angles are within their limits, the ends included.
    #[must_use]
    pub fn within_limits(&self, angles: &[f64; 6]) -> bool {
        self.beyond_limits(angles).is_empty()
    }

    /// The legs whose cranks are beyond their limits at these angles, from 1.
    #[must_use]
    pub fn beyond_limits(&self, angles: &[f64; 6]) -> Vec<usize> {
        let margins = self.limit_margins(angles);
        (1..=6).filter(|leg| !(margins[leg - 1] >= 0.0)).collect()
    }

    /// All finite poses, real and complex, with the cranks at these angles. Certificates hold for the computed tips,
    /// rounded to doubles.
    ///
    /// # Errors
    /// A computation that broke down; angles that are not finite.
    pub fn fk(&self, angles: &[f64; 6], options: &FkOptions) -> Result<FkSolutions, RotaryFkError> {
        Ok(solver(options.method).solve(&self.at(angles)?, &self.rods.squared(), options)?)
    }

    /// Transmission of each crank: `u . (n x t)` with the unit vectors `u` along the rod and `t` along the crank, from
    /// -1 to 1. At 0 crank, rod and axis are in one plane. The crank is singular there: both its angles coincide, and
    /// it cannot push the platform.
    #[must_use]
    pub fn transmissions(&self, pose: &Pose, angles: &[f64; 6]) -> [f64; 6] {
        let ends = self.ends(angles);
        std::array::from_fn(|i| {
            let crank = &self.legs[i].crank;
            let rod = (pose.transform(&ends[i].platform) - ends[i].base).normalize();
            let arm = (ends[i].base - crank.centre) / crank.length;
            rod.dot(&crank.axis.cross(&arm))
        })
    }

    /// Rows that map velocity of the platform origin and angular velocity (base frame) to the speeds of the cranks: `q'
    /// = (u . v + (R b x u) . w) / (r u.(n x t))`. `None` where a crank is singular.
    #[must_use]
    pub fn crank_jacobian(&self, pose: &Pose, angles: &[f64; 6]) -> Option<Matrix6<f64>> {
        let mut rows = jacobian_of_legs(&self.ends(angles), pose, 1.0);
        for (i, transmission) in self.transmissions(pose, angles).into_iter().enumerate() {
            let scaled = rows.row(i) / (self.legs[i].crank.length * transmission);
            rows.set_row(i, &scaled);
        }
        rows.iter().all(|x| x.is_finite()).then_some(rows)
    }

    /// Motions of the cranks for given velocities and accelerations of the platform joints, in leg order, base frame.
    /// Not finite where a crank is singular.
    ///
    /// With the line `m` of the rod, `m . (B' - a') = 0` for the tip `a' = r q' (n x t)`. A further derivative gives
    /// `r q'' m.(n x t) = |B' - a'|^2 + m . B'' + r q'^2 m.t`.
    #[must_use]
    pub fn motions(
        &self,
        pose: &Pose,
        angles: &[f64; 6],
        joints: &[(Vector3<f64>, Vector3<f64>); 6],
    ) -> [CrankMotion; 6] {
        let ends = self.ends(angles);
        std::array::from_fn(|i| {
            let crank = &self.legs[i].crank;
            let (velocity, acceleration) = &joints[i];
            let rod = pose.transform(&ends[i].platform) - ends[i].base;
            let arm = (ends[i].base - crank.centre) / crank.length;
            let ahead = crank.axis.cross(&arm);
            let pushed = crank.length * rod.dot(&ahead);
            let speed = rod.dot(velocity) / pushed;
            let apart = velocity - ahead * (crank.length * speed);
            let turned =
                apart.norm_squared() + rod.dot(acceleration) + crank.length * speed * speed * rod.dot(&arm);
            CrankMotion { angle: angles[i], speed, acceleration: turned / pushed }
        })
    }

    /// The greatest speed of each crank, radians per second, over all motions up to the given speeds of the platform.
    /// The angular speed is in radians per second. The result is `v |row_v| + w |row_w|` of the
    /// [Jacobian](Self::crank_jacobian). `None` where a crank is singular.
    #[must_use]
    pub fn greatest_speeds(
        &self,
        pose: &Pose,
        angles: &[f64; 6],
        linear: f64,
        angular: f64,
    ) -> Option<[f64; 6]> {
        let rows = self.crank_jacobian(pose, angles)?;
        Some(std::array::from_fn(|i| {
            linear * rows.fixed_view::<1, 3>(i, 0).norm() + angular * rows.fixed_view::<1, 3>(i, 3).norm()
        }))
    }

    /// Whether each crank is on its side at a pose, by the sign of its [transmission](Self::transmissions). A crank in
    /// line with its rod counts as on the side of the machine.
    #[must_use]
    pub fn elbows_kept(&self, pose: &Pose, angles: &[f64; 6]) -> [bool; 6] {
        let transmissions = self.transmissions(pose, angles);
        std::array::from_fn(|i| match self.legs[i].elbow {
            Elbow::Plus => transmissions[i] <= 0.0,
            Elbow::Minus => transmissions[i] >= 0.0,
        })
    }

    /// Torques of the cranks about their axes in equilibrium with a wrench (force and torque about the platform origin,
    /// base frame): `J_q^T t = -wrench`. `None` at singular poses and where a crank is singular.
    #[must_use]
    pub fn torques(&self, pose: &Pose, angles: &[f64; 6], wrench: &Vector6<f64>) -> Option<[f64; 6]> {
        let rows = jacobian_of_legs(&self.ends(angles), pose, 1.0);
        let forces = rows.transpose().lu().solve(&-wrench)?;
        let transmissions = self.transmissions(pose, angles);
        let torques: [f64; 6] =
            std::array::from_fn(|i| forces[i] * self.legs[i].crank.length * transmissions[i]);
        torques.iter().all(|x| x.is_finite()).then_some(torques)
    }
}

/// Reasons why poses for given angles were not computed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RotaryFkError {
    /// Tips and joints define no platform.
    #[error(transparent)]
    Manipulator(#[from] InvalidManipulator),
    /// The computation broke down.
    #[error(transparent)]
    Fk(#[from] FkError),
}
