//! Functions of one leg or of a joint at its end, and their margins: lengths, joint angles, universal joints, speed,
//! space in the envelope.

use super::CellEvaluator;
use super::cone::{AllowedCone, Sector};
use super::frame::CellFrame;
use super::function::{BoundedFunction, Side};
use super::hinge::{HingeFrame, HingeLimit};
use super::joint_offsets::JointOffsets;
use crate::requirements::envelope::{self, Envelope};
use crate::requirements::{ConeLimits, LengthLimits, PlatformSpeed, TermKind};
use num::interval::Interval;
use num::jet::{Jet, JetVector, norm_squared};
use platform::geom::enclosed::IntervalVector;
use platform::geom::{Chart, arc_cosine, degrees};
use platform::manipulator::Body;

impl CellEvaluator<'_> {
    /// The angle of a universal joint, for the kinds that are one.
    pub(super) fn hinge(&self, kind: TermKind, leg: usize) -> Option<HingeLimit<'_>> {
        let (body, angle) = kind.hinge()?;
        let limit_deg = self.required.hardware.angle_limit_deg(kind, leg)?;
        let first = self.required.hardware.universal(body)?.first_axes[leg]?;
        let (axis, _) = &self.axes[body.index()][leg];
        let first: IntervalVector = std::array::from_fn(|k| Interval::from(first[k]));
        let frame = HingeFrame::new(&first, axis)?;
        Some(HingeLimit { m: self.m, leg, platform: body == Body::Platform, frame, angle, limit_deg })
    }

    /// The sectors over which a function is bounded separately: directions in which a leg leans, or sides of an angle.
    pub(super) fn sectors(&self, function: BoundedFunction, chart: &Chart) -> Vec<Sector> {
        if let BoundedFunction::Leg(kind, leg) = function
            && self.hinge(kind, leg).is_some_and(|h| chart.coordinates() > 1 && h.has_sides())
        {
            return Sector::sides();
        }
        Sector::all(self.cone(function, chart).is_some())
    }

    /// The allowed cone of a leg, for limits below 90 degrees and regions; for single poses and steps the cosine is as
    /// good.
    pub(super) fn cone(&self, function: BoundedFunction, chart: &Chart) -> Option<AllowedCone<'_>> {
        let BoundedFunction::Leg(kind, leg) = function else { return None };
        if chart.coordinates() < 2 {
            return None;
        }
        let (body, cone_angle) = match kind {
            TermKind::BaseConeAngle => (0, self.required.hardware.base_cone_angle?),
            TermKind::PlatformConeAngle => (1, self.required.hardware.platform_cone_angle?),
            _ => return None,
        };
        let (axis, length) = &self.axes[body][leg];
        AllowedCone::new(self.m, leg, body == 1, axis, *length, cone_angle.limits_deg[leg])
    }

    /// A function of a joint that increases with its distance inside a side of the envelope. For a cylinder it is the
    /// negative square of the distance from the axis, for a box the distance from the side.
    pub(super) fn joint_value(
        &self,
        leg: usize,
        end: usize,
        side: Side,
        frame: &CellFrame<'_>,
    ) -> Option<Jet> {
        let leg = frame.bare_leg(self.m, leg);
        let at = |k: usize| if end == 0 { leg.base[k] } else { leg.line[k] + leg.base[k] };
        let constant = |x: f64| frame.constant(Interval::from(x));
        Some(match (self.required.envelopes.machine?, side) {
            (Envelope::Cylinder { center, .. }, Side::Round) => {
                let (x, y) = (at(0) - constant(center[0]), at(1) - constant(center[1]));
                -(x * x + y * y)
            }
            (Envelope::Box { min, .. }, Side::Least(k)) => at(k) - constant(min[k]),
            (Envelope::Box { max, .. }, Side::Greatest(k)) => constant(max[k]) - at(k),
            _ => return None,
        })
    }

    /// The margin for a value of the function of a joint, increasing with it.
    pub(super) fn envelope_margin(&self, leg: usize, end: usize, side: Side, value: Interval) -> Interval {
        let housing = self.required.hardware.housing(Body::BOTH[end], leg);
        // the same double as in the evaluation of a pose; its rounding belongs to the definition of the housing
        let ball = Interval::from(envelope::ball(housing));
        match (self.required.envelopes.machine, side) {
            (Some(Envelope::Cylinder { radius, .. }), Side::Round) => {
                let square = -value;
                let positive =
                    Interval::new(square.lo().max(0.0), square.hi().max(0.0)).unwrap_or(Interval::WHOLE);
                Interval::from(radius) - ball - positive.sqrt().unwrap_or(Interval::WHOLE)
            }
            _ => value - ball,
        }
    }

    /// The function of a leg whose least value gives the least margin ([`CellEvaluator::margin`]).
    pub(super) fn leg_value(&self, kind: TermKind, i: usize, frame: &CellFrame<'_>) -> Option<Jet> {
        if self.required.cranks.is_some() {
            let speed = self.required.platform_speed.unwrap_or_default();
            return self.cranks?.value((kind, i), self.m, speed, &self.axes[1][i], frame);
        }
        if let Some(joints) = self.joints.filter(|joints| joints.have_lead()) {
            match kind {
                TermKind::MinLegLength => return joints.drive(frame, self.m, i),
                TermKind::MaxLegLength => return Some(-joints.drive(frame, self.m, i)?),
                TermKind::LegSpeed => return self.screw_speed(joints, i, frame),
                _ => {}
            }
        }
        let leg = frame.leg(self.m, i);
        Some(match kind {
            TermKind::MinLegLength => leg.square,
            TermKind::MaxLegLength => -leg.square,
            TermKind::BaseConeAngle => {
                let (axis, length) = &self.axes[0][i];
                leg.cosine(&frame.fixed(axis), *length)?
            }
            TermKind::PlatformConeAngle => {
                let (axis, length) = &self.axes[1][i];
                leg.cosine(&frame.turned(axis), *length)?
            }
            TermKind::LegSpeed => -leg.lever_squared()?,
            kind => return self.hinge(kind, i)?.plain(frame),
        })
    }

    /// Minus the greatest speed of a drive whose screw rotates with its leg, over all velocities and angular velocities
    /// up to the greatest.
    fn screw_speed(&self, joints: &JointOffsets, i: usize, frame: &CellFrame<'_>) -> Option<Jet> {
        let speed = self.required.platform_speed.unwrap_or_default();
        let [x, y, z, a, b, c] = joints.rates(frame, self.m, i)?;
        Some(-fastest(&speed, &[x, y, z], &[a, b, c])?)
    }

    /// The margin for a value of the function of a leg, increasing with it.
    pub(super) fn margin(&self, (kind, leg): (TermKind, usize), value: Interval) -> Interval {
        let hardware = &self.required.hardware;
        if let Some(cranks) = self.cranks {
            return cranks.margin((kind, leg), value);
        }
        if let Some(hinge) = self.hinge(kind, leg) {
            return hinge.margin(value);
        }
        let root = |x: Interval| {
            let positive = Interval::new(x.lo().max(0.0), x.hi().max(0.0)).unwrap_or(Interval::WHOLE);
            positive.sqrt().unwrap_or(Interval::WHOLE)
        };
        let limits = hardware.leg_length.map_or((Interval::WHOLE, Interval::WHOLE), |l| match l {
            LengthLimits::Range(a, b) => (Interval::from(a), Interval::from(b)),
            LengthLimits::Stroke { dead, stroke } => {
                let once = Interval::from(dead) + Interval::from(stroke);
                (once, once + Interval::from(stroke))
            }
        });
        let cone_angle =
            |s: Option<ConeLimits>| Interval::from(s.map_or(f64::INFINITY, |s| s.limits_deg[leg]));
        let greatest = Interval::from(hardware.drive_limit(TermKind::LegSpeed).unwrap_or(f64::INFINITY));
        if self.joints.is_some_and(JointOffsets::have_lead) {
            match kind {
                TermKind::MinLegLength => return value - limits.0,
                TermKind::MaxLegLength => return limits.1 + value,
                TermKind::LegSpeed => return greatest + value,
                _ => {}
            }
        }
        match kind {
            TermKind::MinLegLength => root(value) - limits.0,
            TermKind::MaxLegLength => limits.1 - root(-value),
            TermKind::BaseConeAngle => cone_angle(hardware.base_cone_angle) - degrees(arc_cosine(value)),
            TermKind::PlatformConeAngle => {
                cone_angle(hardware.platform_cone_angle) - degrees(arc_cosine(value))
            }
            TermKind::LegSpeed => {
                let speed = self.required.platform_speed.unwrap_or_default();
                greatest - speed.fastest(Interval::from(1.0), root(-value))
            }
            _ => Interval::WHOLE,
        }
    }
}

/// [`PlatformSpeed::fastest`] for a drive with the rate `f . v + m . w`; the root is skipped for a speed of 0.
pub(super) fn fastest(speed: &PlatformSpeed, force: &JetVector, moment: &JetVector) -> Option<Jet> {
    let length = |v: &JetVector, greatest: f64| {
        if greatest == 0.0 { Some(v[0].alike(Interval::ZERO)) } else { norm_squared(v).root() }
    };
    Some(speed.fastest(length(force, speed.linear)?, length(moment, speed.angular_deg)?))
}
