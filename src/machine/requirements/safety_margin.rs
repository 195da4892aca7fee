//! Safety margins of limits, which leave space for later steps (rounding, tolerances, a heavier payload).

use std::collections::BTreeMap;

use super::Requirements;
use super::envelope::Envelope;
use super::term::TermKind;
use platform::manipulator::Body;

/// The required safety margin of a limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SafetyMargin {
    /// An amount in the unit of the margin.
    Amount(f64),
    /// A share of a reference value, percent ([`Requirements::safety_margin`] lists the reference values).
    Percent(f64),
}

/// The safety margins on all limits.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SafetyMargins {
    /// Percentage for every limit without its own safety margin.
    pub all: Option<f64>,
    /// Safety margins of single kinds.
    pub kinds: BTreeMap<TermKind, SafetyMargin>,
}

impl SafetyMargins {
    /// `true` when no limit has a safety margin.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.all.is_none() && self.kinds.is_empty()
    }
}

impl Requirements {
    /// The safety margin on a kind of requirement, in the unit of its margin: 0 without a safety margin.
    ///
    /// The reference value of a percentage depends on the kind. For lengths it is the travel (greatest minus least).
    /// For angles, forces and speeds it is the greatest value, or the least of these if legs differ. For stiffness and
    /// frequency it is the least value. For clearances it is the leg diameter. For the distance between joints it is
    /// the greater of the widest housing and the least distance of centres. For the holes of plates it is the greater
    /// of the required distance and the greatest hole diameter. For envelopes it is the radius or half the shortest
    /// edge. For cranks it is the shortest rod, half the narrowest range of angles, the least transmission angle, or
    /// the greatest joint angle, torque or speed.
    #[must_use]
    pub fn safety_margin(&self, kind: TermKind) -> f64 {
        let own = self.safety_margins.kinds.get(&kind).copied();
        match own.or(self.safety_margins.all.map(SafetyMargin::Percent)) {
            None => 0.0,
            Some(SafetyMargin::Amount(amount)) => amount,
            Some(SafetyMargin::Percent(percent)) => percent / 100.0 * self.whole(kind),
        }
    }

    /// The plate of a kind.
    fn plate_of(&self, kind: TermKind) -> Option<&super::PlateDesign> {
        self.plates.of(kind.plate()?)
    }

    /// The reference value of percentages of a kind; 0 without a limit.
    pub fn whole(&self, kind: TermKind) -> f64 {
        let h = &self.hardware;
        let spacing = |body: Body| {
            let widths = (0..6).filter_map(|leg| h.housing(body, leg)).map(|h| h.greatest_width());
            widths.fold(self.min_joint_distance.unwrap_or(0.0), f64::max)
        };
        let envelope = |e: Option<Envelope>| e.map_or(0.0, |e| e.half_width());
        match kind {
            TermKind::MinLegLength | TermKind::MaxLegLength => h.leg_length.map_or(0.0, |l| {
                let (least, greatest) = l.range();
                greatest - least
            }),
            TermKind::BaseConeAngle => h.base_cone_angle.map_or(0.0, |s| s.least_deg()),
            TermKind::PlatformConeAngle => {
                let of_rods = self.cranks.as_ref().and_then(|cranks| cranks.platform_cone_angle_deg);
                h.platform_cone_angle.map(|s| s.least_deg()).or(of_rods).unwrap_or(0.0)
            }
            TermKind::BaseFirstAngle
            | TermKind::BaseSecondAngle
            | TermKind::PlatformFirstAngle
            | TermKind::PlatformSecondAngle => h.least_angle_limit_deg(kind).unwrap_or(0.0),
            TermKind::LegClearance
            | TermKind::KeepOut
            | TermKind::PlateClearance
            | TermKind::PayloadClearance => h.leg_body.map_or(0.0, |b| b.diameter),
            TermKind::LegForce => h.max_leg_force.unwrap_or(0.0),
            TermKind::LegSpeed => h.max_leg_speed.unwrap_or(0.0),
            TermKind::BaseSpacing => spacing(Body::Base),
            TermKind::PlatformSpacing => spacing(Body::Platform),
            TermKind::BaseEnvelope => envelope(self.envelopes.base),
            TermKind::PlatformEnvelope => envelope(self.envelopes.platform),
            TermKind::MachineEnvelope => envelope(self.envelopes.machine),
            TermKind::BaseHoleEdge | TermKind::PlatformHoleEdge => {
                self.plate_of(kind).map_or(0.0, |p| p.edge_distance.max(p.greatest_hole()))
            }
            TermKind::BaseHoleGap | TermKind::PlatformHoleGap => {
                self.plate_of(kind).map_or(0.0, |p| p.hole_distance.max(p.greatest_hole()))
            }
            TermKind::LinearStiffness | TermKind::AngularStiffness | TermKind::NaturalFrequency => {
                self.least_stiffness_of(kind).unwrap_or(0.0)
            }
            _ => self.cranks.as_ref().map_or(0.0, |cranks| cranks.whole(kind)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::requirements::{Hardware, LengthLimits};

    #[test]
    fn amounts_stand_and_percentages_are_parts_of_the_limit() {
        let hardware = Hardware {
            leg_length: Some(LengthLimits::Stroke { dead: 250.0, stroke: 600.0 }),
            max_leg_force: Some(4000.0),
            joint_diameter: Some(40.0),
            ..Hardware::default()
        };
        let mut required = Requirements { hardware, ..Requirements::default() };
        assert!(TermKind::ALL.iter().all(|kind| required.safety_margin(*kind) == 0.0));
        required.safety_margins.all = Some(5.0);
        let near = |kind, x: f64| (required.safety_margin(kind) - x).abs() < 1e-12;
        assert!(near(TermKind::MaxLegLength, 30.0) && near(TermKind::MinLegLength, 30.0));
        assert!(near(TermKind::LegForce, 200.0) && near(TermKind::BaseSpacing, 2.0));
        assert!(
            near(TermKind::LegSpeed, 0.0) && near(TermKind::MachineEnvelope, 0.0),
            "no limit, no safety margin"
        );
        required.safety_margins.kinds.insert(TermKind::LegForce, SafetyMargin::Amount(350.0));
        assert_eq!(required.safety_margin(TermKind::LegForce).to_bits(), 350.0_f64.to_bits());
    }
}
