//! Limits of cranks with rods of constant length, evaluated from the definitions.
//!
//! Let `d = R b + p - c` be the vector from the centre of a crank to its platform joint. The tip at the angles 0 and 90
//! degrees has the directions `e` and `f = n x e`; `x = d.e`, `y = d.f`, `rho^2 = x^2 + y^2`. The lengths of crank and
//! rod are `r` and `l`; `sigma` is 1 for the greater of the two angles, -1 for the smaller one:
//!
//! ```text
//! k = (|d|^2 + r^2 - l^2) / (2 r),
//! s^2 = rho^2 - k^2 = l^2 - ((|d|^2 - r^2 - l^2) / (2 r))^2 - (d.n)^2,
//! cos q = (x k - sigma y s) / rho^2,   sin q = (y k + sigma x s) / rho^2,   u . (n x t) = -sigma s / l,   u . n = d.n / l.
//! ```
//!
//! The rod closes where `s^2 >= 0`. `docs/theory/rotary.md` has the derivation.

use nalgebra::{Matrix6, Point3, Vector3};

use super::load::HeldLines;
use super::term::{Term, TermKind, Terms, angle_deg};
use super::{LeastConditioning, Requirements};
use platform::geom::{Pose, PoseSpace};
use platform::manipulator::{Leg, inverse_condition, jacobian_of_legs, leg_determinant};

/// A crank and its rod; the base joint of the leg is the centre of the crank.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrankedLeg {
    /// Direction of the axis; its length does not matter.
    pub axis: Vector3<f64>,
    /// Direction of the tip at the angle 0; its part along the axis is ignored.
    pub zero: Vector3<f64>,
    /// From the axis to the tip, design units.
    pub length: f64,
    /// Length of the rod, design units.
    pub rod: f64,
    /// Whether the crank takes the greater of its two angles.
    pub greater: bool,
    /// Least and greatest angle, degrees.
    pub limits_deg: Option<[f64; 2]>,
}

impl CrankedLeg {
    /// 1 for the greater angle, -1 for the smaller one.
    pub(super) fn sign(&self) -> f64 {
        if self.greater { 1.0 } else { -1.0 }
    }

    /// Unit vectors along the axis, and along the tip at the angles 0 and 90 degrees.
    fn directions(&self) -> [Vector3<f64>; 3] {
        let n = self.axis.normalize();
        let e = (self.zero - n * n.dot(&self.zero)).normalize();
        [n, e, n.cross(&e)]
    }

    /// The crank at a pose, for the platform joint of its leg.
    fn at(&self, leg: &Leg, pose: &Pose) -> CrankAt {
        let [n, e, f] = self.directions();
        let d = pose.transform(&leg.platform) - leg.base;
        let (r, l) = (self.length, self.rod);
        let (x, y) = (d.dot(&e), d.dot(&f));
        let (square, k) = (x * x + y * y, (d.norm_squared() + r * r - l * l) / (2.0 * r));
        let along = d.dot(&n);
        let left = l * l - ((d.norm_squared() - r * r - l * l) / (2.0 * r)).powi(2) - along * along;
        // beyond reach the tip takes the place nearest to closing
        let held = k.clamp(-square.sqrt(), square.sqrt());
        let s = self.sign() * left.max(0.0).sqrt();
        let (cos, sin) = ((x * held - y * s) / square, (y * held + x * s) / square);
        CrankAt { d, along, square, left, cos, sin, tip: leg.base + (e * cos + f * sin) * r }
    }
}

/// A crank at a pose.
struct CrankAt {
    d: Vector3<f64>,
    along: f64,
    /// `rho^2`.
    square: f64,
    /// `s^2`, negative where the rod does not close.
    left: f64,
    cos: f64,
    sin: f64,
    tip: Point3<f64>,
}

/// The remaining ranges of a crank, as bounds for short ways.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CrankClearances {
    /// Length of the crank, design units.
    pub length: f64,
    /// Length of the rod, design units.
    pub rod: f64,
    /// `s^2`, negative where the rod does not close.
    pub square: f64,
    /// `s^2` minus its value at the least transmission angle.
    pub(crate) above_least: f64,
    /// Remaining lean of the rod out of the plane of its crank; infinite without a limit.
    pub lean: f64,
}

/// The cranks of a design, and the limits of cranks and rod joints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cranks {
    /// In leg order.
    pub legs: [CrankedLeg; 6],
    /// Greatest torque about the axis of a crank, force units times design units.
    pub max_torque: Option<f64>,
    /// Greatest speed of a crank, degrees per second.
    pub max_speed_deg: Option<f64>,
    /// Least transmission angle, degrees; 0 where the design gives none.
    pub min_transmission_angle_deg: f64,
    /// Cone angle of the joint at the tip, out of the plane in which the crank turns, degrees.
    pub tip_angle_deg: Option<f64>,
    /// Cone angle of the joint at the platform, from the direction of the rod at home, degrees.
    pub platform_cone_angle_deg: Option<f64>,
}

impl Cranks {
    /// The whole that percentages of a kind refer to; 0 without a limit.
    pub(super) fn whole(&self, kind: TermKind) -> f64 {
        let least = |of: &dyn Fn(&CrankedLeg) -> f64| self.legs.iter().map(of).fold(f64::INFINITY, f64::min);
        match kind {
            TermKind::MinRodLength | TermKind::MaxRodLength => least(&|leg| leg.rod),
            TermKind::CrankTransmission => self.min_transmission_angle_deg,
            TermKind::CrankAngle => {
                let range = |leg: &CrankedLeg| leg.limits_deg.map_or(f64::INFINITY, |[a, b]| 0.5 * (b - a));
                Some(least(&range)).filter(|x| x.is_finite()).unwrap_or(0.0)
            }
            TermKind::TipAngle => self.tip_angle_deg.unwrap_or(0.0),
            TermKind::CrankTorque => self.max_torque.unwrap_or(0.0),
            TermKind::CrankSpeed => self.max_speed_deg.unwrap_or(0.0),
            _ => 0.0,
        }
    }
}

/// The angle whose sine has this square, degrees, odd in its argument.
pub(super) fn arc_sine_of_root_deg(square: f64) -> f64 {
    square.abs().sqrt().min(1.0).asin().copysign(square).to_degrees()
}

impl Requirements {
    /// The rods as legs on the tips of the cranks at a pose; `None` where the design has no cranks. A rod that does not
    /// close has its tip in the place nearest to closing.
    pub(super) fn rods(&self, legs: &[Leg; 6], pose: &Pose) -> Option<[Leg; 6]> {
        let cranks = self.cranks.as_ref()?;
        Some(std::array::from_fn(|i| {
            let at = cranks.legs[i].at(&legs[i], pose);
            Leg { base: at.tip, platform: legs[i].platform }
        }))
    }

    /// The legs that push the platform: the rods, or the legs themselves.
    pub(super) fn pushing_legs(&self, legs: &[Leg; 6], pose: &Pose) -> [Leg; 6] {
        self.rods(legs, pose).unwrap_or(*legs)
    }
}

impl Terms<'_> {
    /// Lines of the rods by rows, moments over a length, with a row for every rod; `None` where one does not close.
    fn rod_rows(&self, cranks: &Cranks, pose: &Pose, length: f64) -> Option<Matrix6<f64>> {
        let legs = self.manipulator.legs();
        let closes = (0..6).all(|i| cranks.legs[i].at(&legs[i], pose).left >= 0.0);
        let rods = self.required.rods(&legs, pose).filter(|_| closes)?;
        Some(jacobian_of_legs(&rods, pose, length))
    }

    /// Margins of cranks and rods at a pose.
    pub(super) fn cranks(&self, cranks: &Cranks, pose: &Pose, out: &mut Vec<(Term, f64)>) {
        let legs = self.manipulator.legs();
        let at: [CrankAt; 6] = std::array::from_fn(|i| cranks.legs[i].at(&legs[i], pose));
        let back = pose.rotation.inverse();
        for (i, (crank, here)) in cranks.legs.iter().zip(&at).enumerate() {
            let (r, l) = (crank.length, crank.rod);
            let mut keep = |kind, margin| out.push((Term { kind, first: i, second: i }, margin));
            let across = here.square.sqrt();
            keep(TermKind::MinRodLength, l - here.along.hypot(across - r));
            keep(TermKind::MaxRodLength, here.along.hypot(across + r) - l);
            let transmission = arc_sine_of_root_deg(here.left / (l * l));
            keep(TermKind::CrankTransmission, transmission - cranks.min_transmission_angle_deg);
            if let Some([least, most]) = crank.limits_deg {
                let middle = (0.5 * (least + most)).to_radians();
                let off = (here.sin * middle.cos() - here.cos * middle.sin())
                    .atan2(here.cos * middle.cos() + here.sin * middle.sin());
                keep(TermKind::CrankAngle, 0.5 * (most - least) - off.abs().to_degrees());
            }
            if let Some(limit) = cranks.tip_angle_deg {
                keep(TermKind::TipAngle, limit - arc_sine_of_root_deg((here.along / l).powi(2)));
            }
            if let Some(limit) = cranks.platform_cone_angle_deg {
                let rod = pose.transform(&legs[i].platform) - here.tip;
                keep(TermKind::PlatformConeAngle, limit - angle_deg(&(back * rod), &self.axes()[1][i]));
            }
        }
        let size = self.manipulator.size();
        if let Some(greatest) = cranks.max_torque {
            let rows = self.rod_rows(cranks, pose, size);
            let lines = rows.map(|rows| HeldLines::new(&rows, size));
            for (k, load) in self.required.loads.iter().enumerate() {
                let wrench = load.wrench(self.manipulator, pose);
                let forces = lines.as_ref().and_then(|lines| lines.forces(&wrench));
                for (i, (crank, here)) in cranks.legs.iter().zip(&at).enumerate() {
                    let arm = crank.length * here.left.max(0.0).sqrt() / crank.rod;
                    let margin = forces.map_or(f64::NEG_INFINITY, |f| greatest - f[i].abs() * arm);
                    out.push((Term { kind: TermKind::CrankTorque, first: i, second: k }, margin));
                }
            }
        }
        if let (Some(greatest), Some(speed)) = (cranks.max_speed_deg, self.required.platform_speed) {
            for (i, (crank, here)) in cranks.legs.iter().zip(&at).enumerate() {
                let arm = pose.rotation * legs[i].platform.coords;
                let rod = here.d - (here.tip - legs[i].base);
                // over all |v| <= linear, |w| <= angular
                let fastest = speed.fastest(crank.rod, arm.cross(&rod).norm())
                    / (crank.length * here.left.max(0.0).sqrt());
                let own = Term { kind: TermKind::CrankSpeed, first: i, second: i };
                out.push((own, greatest - fastest.to_degrees()));
            }
        }
    }

    /// Rounding bound of a crank angle relative to one radian. It is that of lengths over the shortest of crank and
    /// rod, over the sine of the least transmission angle.
    pub(super) fn crank_rounding(&self, cranks: &Cranks, pose: &Pose, length: f64) -> f64 {
        let legs = self.manipulator.legs();
        let of = |i: usize| {
            let crank = &cranks.legs[i];
            let sine = crank.at(&legs[i], pose).left.max(0.0).sqrt() / crank.rod;
            length / (crank.length.min(crank.rod) * sine)
        };
        (0..6).map(of).fold(0.0, f64::max)
    }

    /// `det J` of the pushing lines, without unit. Legs have lengths over the size; rods have unit vectors and moments
    /// over the size. `None` where a rod does not close.
    #[must_use]
    pub fn determinant(&self, pose: &Pose) -> Option<f64> {
        match &self.required.cranks {
            None => Some(leg_determinant(self.manipulator, pose)),
            Some(cranks) => {
                self.rod_rows(cranks, pose, self.manipulator.size()).map(|rows| rows.determinant())
            }
        }
    }

    /// The remaining reach, transmission and lean of a crank; `None` for legs of variable length.
    pub(crate) fn crank_clearances(&self, i: usize, pose: &Pose) -> Option<CrankClearances> {
        let cranks = self.required.cranks.as_ref()?;
        let crank = &cranks.legs[i];
        let here = crank.at(&self.manipulator.legs()[i], pose);
        let least = crank.rod * cranks.min_transmission_angle_deg.to_radians().sin();
        let most = cranks.tip_angle_deg.map_or(f64::INFINITY, |limit| crank.rod * limit.to_radians().sin());
        Some(CrankClearances {
            length: crank.length,
            rod: crank.rod,
            square: here.left,
            above_least: here.left - least * least,
            lean: most - here.along.abs(),
        })
    }

    /// The inverse condition number of the lines of the rods with moments over a length; 0 where a rod does not close.
    pub(super) fn rod_conditioning(&self, cranks: &Cranks, pose: &Pose, length: f64) -> f64 {
        self.rod_rows(cranks, pose, length).map_or(0.0, |rows| inverse_condition(&rows))
    }
}

/// [`least_conditioning`](super::least_conditioning) for the rods of a design with cranks and for drives with joint
/// offsets; `None` for other designs.
#[must_use]
pub fn least_rod_conditioning(
    terms: &Terms<'_>,
    space: &PoseSpace,
    o: &super::AssessOptions,
    characteristic_length: f64,
) -> Option<LeastConditioning> {
    let of_drives = |pose: &Pose| {
        terms.drive_rows(pose, characteristic_length).map_or(0.0, |rows| inverse_condition(&rows))
    };
    match &terms.required.cranks {
        Some(cranks) => Some(super::conditioning::least_over(space, o, |pose| {
            terms.rod_conditioning(cranks, pose, characteristic_length)
        })),
        None => terms.are_coupled().then(|| super::conditioning::least_over(space, o, of_drives)),
    }
}
