//! The meaning of a margin within the rounding of its own evaluation.

use super::assess::Margin;
use super::term::{Quantity, Term, TermKind, Terms};
use super::universal::HingeAngle;
use platform::geom::Pose;
use platform::manipulator::{Body, inverse_condition};

/// Rounding of a length over the sum of the lengths in its computation. Some ten operations on rounded coordinates have
/// an error of half of `eps` each; the rest is a safety factor.
const SHARE: f64 = 64.0 * f64::EPSILON;

/// Greatest share that counts as rounding. Near singular poses and for legs of nearly zero length the arithmetic is
/// inaccurate; a margin below zero is then a violation.
const MOST: f64 = 1e-9;

/// The meaning of a margin.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Standing {
    /// Below zero by more than rounding: the requirement is violated.
    Violated,
    /// Equal to zero within rounding: the design is at its limit, for example if a distance was chosen equal to the
    /// least one. It counts as met.
    AtLimit,
    /// Above zero by more than rounding.
    Met,
}

impl Standing {
    /// `true` unless the requirement is violated.
    #[must_use]
    pub fn is_met(self) -> bool {
        self != Self::Violated
    }
}

impl Terms<'_> {
    /// The meaning of a margin of this kind at its pose (`None` for kinds that do not depend on the pose).
    #[must_use]
    pub fn standing(&self, kind: TermKind, margin: f64, pose: Option<&Pose>) -> Standing {
        if margin.is_finite() && margin.abs() <= self.rounding(kind, pose) {
            Standing::AtLimit
        } else if margin > 0.0 {
            Standing::Met
        } else {
            Standing::Violated
        }
    }

    /// A margin with its meaning; without a pose for requirements that do not depend on it.
    #[must_use]
    pub fn margin(&self, (term, value): (Term, f64), pose: Option<Pose>) -> Margin {
        Margin { term, value, pose, standing: self.standing(term.kind, value, pose.as_ref()) }
    }

    /// Amplification of a direction error of a leg in an angle: above 1 for first angles of universal joints near their
    /// first axes.
    fn amplification(&self, kind: TermKind, pose: Option<&Pose>) -> f64 {
        let (Some((body, HingeAngle::First)), Some(pose)) = (kind.hinge(), pose) else { return 1.0 };
        let end = body.index();
        let legs = self.manipulator.legs();
        let of = |i: usize| {
            let line = pose.transform(&legs[i].platform) - legs[i].base;
            let line = if end == 0 { line } else { pose.rotation.inverse() * line };
            self.hinge(end, i).map_or(1.0, |hinge| hinge.amplification(&line, &self.axes()[end][i]))
        };
        (0..6).map(of).fold(1.0, f64::max)
    }

    /// The sum of lengths in the computation of a length. For a plate it grows by the extent of the plate. It also
    /// grows with the ratio of this extent to the shortest edge of the hull, whose direction is less accurate.
    fn plate_reach(&self, kind: TermKind, reach: f64) -> f64 {
        let of = |body: Body| {
            self.plate(body).map_or(0.0, |solid| {
                let extent = solid.extent();
                extent * (1.0 + extent / solid.outline.shortest_edge())
            })
        };
        reach
            + match kind.plate() {
                Some(body) => of(body),
                None if kind == TermKind::PlateClearance => of(Body::Base) + of(Body::Platform),
                None => 0.0,
            }
    }

    /// Bound of the rounding of a margin, in its unit.
    ///
    /// Let `r` be the sum of these lengths:
    ///
    /// * the greatest distance of a joint from the origin of its body, for both bodies,
    /// * the distance of the platform from the base origin,
    /// * the offsets of the universal joints.
    ///
    /// The bounds by quantity:
    ///
    /// * Lengths: `64 eps` (1.4e-14) times `r`. For holes and plates `r` also includes the extent `e` of the plate, and
    ///   `e` times `e` over the shortest edge of its hull.
    /// * Angles: the bound of lengths over the shortest leg. For first angles of universal joints it is multiplied by
    ///   `1 / sin(u, a) + 1 / sin(k, a)` of leg, axis and first axis.
    /// * Speeds: `64 eps` times the greatest speed times `r` over the shortest leg.
    /// * Forces: `64 eps` times the greatest force over the inverse condition number of the Jacobian.
    /// * Cranks: angles over the shorter of crank and rod and over the sine of the transmission angle; speeds and
    ///   torques accordingly.
    /// * Stiffness and frequency: the bounds of angles and of forces together, times twice the required least value.
    ///
    /// The bound is at most `1e-9` radians, or `1e-9` of the greatest speed or force, or of twice the least stiffness
    /// or frequency.
    #[must_use]
    pub fn rounding(&self, kind: TermKind, pose: Option<&Pose>) -> f64 {
        let m = self.manipulator;
        let farthest =
            |joints: &[nalgebra::Point3<f64>]| joints.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
        let away = pose.map_or(0.0, |p| p.position.norm());
        let aside = Body::BOTH.map(|body| self.required.hardware.universal(body).map_or(0.0, |j| j.offset));
        let reach = farthest(m.base_joints()) + farthest(m.platform_joints()) + away + aside[0] + aside[1];
        let turn = || {
            if let (Some(cranks), Some(pose)) = (&self.required.cranks, pose) {
                return self.crank_rounding(cranks, pose, SHARE * reach).min(MOST);
            }
            let lengths = pose.map(|p| m.legs().map(|l| (p.transform(&l.platform) - l.base).norm()));
            (SHARE * reach / lengths.into_iter().flatten().fold(f64::INFINITY, f64::min)).min(MOST)
        };
        let conditioning = || {
            let Some(pose) = pose else { return 1.0 };
            let length = m.platform_rms_radius();
            match &self.required.cranks {
                Some(cranks) => self.rod_conditioning(cranks, pose, length),
                None => self.drive_rows(pose, length).map_or(0.0, |rows| inverse_condition(&rows)),
            }
        };
        let most = |of: fn(&super::Cranks) -> Option<f64>| {
            self.required.cranks.as_ref().and_then(|cranks| of(cranks)).unwrap_or(0.0)
        };
        let greatest = || self.required.hardware.drive_limit(kind).unwrap_or(0.0);
        match kind.quantity() {
            Quantity::Length => SHARE * self.plate_reach(kind, reach),
            Quantity::Angle => (turn() * self.amplification(kind, pose)).min(MOST).to_degrees(),
            Quantity::Speed => turn() * greatest(),
            Quantity::Force => (SHARE / conditioning()).min(MOST) * greatest(),
            Quantity::Torque => ((SHARE + turn()) / conditioning()).min(MOST) * most(|c| c.max_torque),
            Quantity::AngularSpeed => turn() * most(|c| c.max_speed_deg),
            Quantity::LinearStiffness | Quantity::AngularStiffness | Quantity::Frequency => {
                let least = self.required.least_stiffness_of(kind).unwrap_or(0.0);
                ((SHARE + turn()) / conditioning()).min(MOST) * 2.0 * least
            }
        }
    }
}
