//! The terms: the requirements of a manipulator at a pose, with their margins.

use nalgebra::{Matrix6, Point3, Unit, Vector3};

use super::Requirements;
use super::coupled::{CoupledLegs, DriveState, NoDriveLength};
use super::envelope::{ball, extent};
use super::hardware::{Housing, JointAxes, LegBody, LegSegment};
use super::keep_out::KeepOutShape;
use super::load::HeldLines;
use super::plate::PlateSolid;
use super::universal::{Hinge, HingeAngle};
use super::vibration::{lowest_of, mass_matrix, softest_of};
use platform::geom::{Pose, segment_distance};
use platform::manipulator::{Body, Manipulator, jacobian};

num::answer_words! {
    /// The kinds of requirements.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
    #[non_exhaustive]
    pub enum TermKind as code | label {
        /// Leg length minus minimum.
        MinLegLength = "min_leg_length" | "leg length, minimum",
        /// Maximum minus leg length.
        MaxLegLength = "max_leg_length" | "leg length, maximum",
        /// Limit minus joint angle at the base.
        BaseConeAngle = "base_cone_angle" | "joint angle at base, maximum",
        /// Limit minus joint angle at the platform.
        PlatformConeAngle = "platform_cone_angle" | "joint angle at platform, maximum",
        /// Limit minus first universal joint angle at the base.
        BaseFirstAngle = "base_first_angle" | "first joint angle at base, maximum",
        /// Limit minus second angle.
        BaseSecondAngle = "base_second_angle" | "second joint angle at base, maximum",
        /// Limit minus first universal joint angle at the platform.
        PlatformFirstAngle = "platform_first_angle" | "first joint angle at platform, maximum",
        /// Limit minus second angle.
        PlatformSecondAngle = "platform_second_angle" | "second joint angle at platform, maximum",
        /// Gap of two legs minus clearance.
        LegClearance = "leg_clearance" | "clearance between legs",
        /// Gap of leg and keep-out minus clearance.
        KeepOut = "keep_out" | "clearance to keep-out",
        /// Limit minus leg force under a load.
        LegForce = "leg_force" | "leg force, maximum",
        /// Limit minus leg speed in the worst direction.
        LegSpeed = "leg_speed" | "leg speed, maximum",
        /// Gap of two base housings, or distance of joint centres minus the least one.
        BaseSpacing = "base_spacing" | "distance of base joints",
        /// Gap of two platform housings, or distance of joint centres minus the least one.
        PlatformSpacing = "platform_spacing" | "distance of platform joints",
        /// Distance of base housings inside their envelope.
        BaseEnvelope = "base_envelope" | "envelope of base",
        /// Distance of platform housings inside their envelope.
        PlatformEnvelope = "platform_envelope" | "envelope of platform",
        /// Distance of housings inside the machine envelope.
        MachineEnvelope = "machine_envelope" | "envelope of machine",
        /// Distance of holes from the base outline, minus the required one.
        BaseHoleEdge = "base_hole_edge" | "holes to edge of base plate",
        /// Distance of holes from the platform outline, minus the required one.
        PlatformHoleEdge = "platform_hole_edge" | "holes to edge of platform plate",
        /// Gap of base holes and feet, or between the holes of one, minus the required one.
        BaseHoleGap = "base_hole_gap" | "gap of holes in base plate",
        /// Gap of platform holes and feet, or between the holes of one, minus the required one.
        PlatformHoleGap = "platform_hole_gap" | "gap of holes in platform plate",
        /// Gap of leg and plate minus clearance.
        PlateClearance = "plate_clearance" | "clearance of legs to plate",
        /// Gap of leg and payload minus clearance.
        PayloadClearance = "payload_clearance" | "clearance of legs to payload",
        /// Softest stiffness against a force minus minimum.
        LinearStiffness = "linear_stiffness" | "stiffness against force, minimum",
        /// Softest stiffness against a torque minus minimum.
        AngularStiffness = "angular_stiffness" | "stiffness against torque, minimum",
        /// Lowest natural frequency minus minimum.
        NaturalFrequency = "natural_frequency" | "natural frequency, minimum",
        /// Rod length minus nearest distance of platform joint and crank circle.
        MinRodLength = "min_rod_length" | "rod length to near side, minimum",
        /// Farthest distance of platform joint and crank circle minus rod length.
        MaxRodLength = "max_rod_length" | "rod length to far side, maximum",
        /// Transmission angle minus minimum. Its sine is the share of a push along the rod that turns the crank. At 0
        /// degrees crank and rod are in a plane with the axis.
        CrankTransmission = "crank_transmission" | "transmission angle, minimum",
        /// Distance of the crank angle from its limits.
        CrankAngle = "crank_angle" | "crank angle, range",
        /// Limit minus angle of rod and crank plane.
        TipAngle = "tip_angle" | "joint angle at crank tip, maximum",
        /// Limit minus crank torque under a load.
        CrankTorque = "crank_torque" | "crank torque, maximum",
        /// Limit minus crank speed in the worst direction.
        CrankSpeed = "crank_speed" | "crank speed, maximum",
    }
}

/// The physical quantity of a margin, with its unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Design units.
    Length,
    /// Degrees.
    Angle,
    /// Force units.
    Force,
    /// Design units per second.
    Speed,
    /// Force units per design unit.
    LinearStiffness,
    /// Force units times design units per radian.
    AngularStiffness,
    /// Hertz.
    Frequency,
    /// Force units times design units.
    Torque,
    /// Degrees per second.
    AngularSpeed,
}

impl TermKind {
    /// The quantity of its margin.
    #[must_use]
    pub fn quantity(self) -> Quantity {
        match self {
            Self::BaseConeAngle
            | Self::PlatformConeAngle
            | Self::CrankTransmission
            | Self::CrankAngle
            | Self::TipAngle => Quantity::Angle,
            Self::CrankTorque => Quantity::Torque,
            Self::CrankSpeed => Quantity::AngularSpeed,
            kind if kind.hinge().is_some() => Quantity::Angle,
            Self::LegForce => Quantity::Force,
            Self::LegSpeed => Quantity::Speed,
            Self::LinearStiffness => Quantity::LinearStiffness,
            Self::AngularStiffness => Quantity::AngularStiffness,
            Self::NaturalFrequency => Quantity::Frequency,
            _ => Quantity::Length,
        }
    }

    /// `true` for requirements of the platform as a whole, without a leg or joint.
    #[must_use]
    pub fn is_of_platform(self) -> bool {
        Self::OF_PLATFORM.contains(&self)
    }

    /// For angles of universal joints: the body and the axis.
    pub fn hinge(self) -> Option<(Body, HingeAngle)> {
        Some(match self {
            Self::BaseFirstAngle => (Body::Base, HingeAngle::First),
            Self::BaseSecondAngle => (Body::Base, HingeAngle::Second),
            Self::PlatformFirstAngle => (Body::Platform, HingeAngle::First),
            Self::PlatformSecondAngle => (Body::Platform, HingeAngle::Second),
            _ => return None,
        })
    }

    /// The kinds of the angles of universal joints.
    pub const HINGES: [Self; 4] =
        [Self::BaseFirstAngle, Self::BaseSecondAngle, Self::PlatformFirstAngle, Self::PlatformSecondAngle];

    /// The kinds that single leg lines decide, besides [`HINGES`](Self::HINGES).
    const OF_LEG_LINES: [Self; 4] =
        [Self::MinLegLength, Self::MaxLegLength, Self::BaseConeAngle, Self::PlatformConeAngle];

    /// The kinds of gaps between legs and other bodies.
    const CLEARANCES: [Self; 4] =
        [Self::LegClearance, Self::KeepOut, Self::PlateClearance, Self::PayloadClearance];

    /// The kinds of stiffness and frequency.
    const OF_PLATFORM: [Self; 3] = [Self::LinearStiffness, Self::AngularStiffness, Self::NaturalFrequency];

    /// `true` if it does not depend on the pose.
    #[must_use]
    pub fn is_fixed(self) -> bool {
        matches!(
            self,
            Self::BaseSpacing | Self::PlatformSpacing | Self::BaseEnvelope | Self::PlatformEnvelope
        ) || self.plate().is_some()
    }

    /// For the margins of holes: the body of the plate.
    pub fn plate(self) -> Option<Body> {
        Some(match self {
            Self::BaseHoleEdge | Self::BaseHoleGap => Body::Base,
            Self::PlatformHoleEdge | Self::PlatformHoleGap => Body::Platform,
            _ => return None,
        })
    }
}

/// One requirement: a kind and its leg, joint or pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Term {
    /// The kind.
    pub kind: TermKind,
    /// The leg, or the joint of the body, counted from 0.
    pub first: usize,
    /// The other leg, joint, keep-out or load, counted from 0; equal to `first` if there is no other. Both are 0 for
    /// requirements of the platform as a whole. For the envelope of the machine it is 0 for the base joint of the leg
    /// and 1 for its platform joint. For plates it is 0 for the base and 1 for the platform.
    pub second: usize,
}

/// The requirements prepared for one manipulator.
#[derive(Debug)]
pub struct Terms<'a> {
    pub(super) manipulator: &'a Manipulator,
    pub(super) required: &'a Requirements,
    /// Axes at the base, base frame, and at the platform, platform frame, in leg order.
    axes: [[Vector3<f64>; 6]; 2],
    /// Universal joints at the base and at the platform, in leg order.
    hinges: [[Option<Hinge>; 6]; 2],
    /// The plates of the base and of the platform.
    plates: [Option<PlateSolid>; 2],
    /// Legs with joint offsets, or the reason why they have no lengths.
    coupled: Option<Result<CoupledLegs, NoDriveLength>>,
}

/// The legs at a pose.
struct LegsAt {
    /// Ends of the leg bodies: the joints, or their second axes if offset from the first ones.
    ends: [(Point3<f64>, Point3<f64>); 6],
    /// Lengths of the drives; minus infinity marks a leg to ignore.
    lengths: [f64; 6],
    /// Undetermined legs: all their requirements are violated.
    missing: [bool; 6],
    /// Rates of the drives, if there are joint offsets and all legs are determined.
    states: Option<[DriveState; 6]>,
}

/// A part of a leg: a segment and its radius.
type Part = (Point3<f64>, Point3<f64>, f64);

/// Parts of a leg from `a` to `b`.
fn parts(all: impl Iterator<Item = LegSegment>, (a, b): (Point3<f64>, Point3<f64>)) -> Vec<Part> {
    let line = b - a;
    // the end of the line is the joint itself
    let at = |share: f64| if share < 1.0 { a + line * share } else { b };
    all.map(|part| (at(part.from), at(part.to), part.radius)).collect()
}

/// Angle between two vectors, degrees, accurate for small angles too.
pub(super) fn angle_deg(u: &Vector3<f64>, v: &Vector3<f64>) -> f64 {
    u.cross(v).norm().atan2(u.dot(v)).to_degrees()
}

impl<'a> Terms<'a> {
    /// Prepares the requirements; axes that follow the legs at home are computed here.
    #[must_use]
    pub fn new(manipulator: &'a Manipulator, required: &'a Requirements, home: &Pose) -> Self {
        let legs = required.pushing_legs(&manipulator.legs(), home);
        let mut at_home = legs.map(|l| (home.transform(&l.platform) - l.base).normalize());
        let coupled =
            required.hardware.is_coupled().then(|| CoupledLegs::new(manipulator, &required.hardware, home));
        if let Some(Ok(coupled)) = &coupled {
            for (i, u) in at_home.iter_mut().enumerate() {
                // an axis without direction violates its limits
                let line = coupled.state_of(i, home).map(|state| state.line);
                *u = line.map_or(Vector3::repeat(f64::NAN), |line| line.normalize());
            }
        }
        let axes =
            |body: Body, turn: &dyn Fn(&Vector3<f64>) -> Vector3<f64>| match required.hardware.axes(body) {
                Some(JointAxes::Given(axes)) => axes.map(Unit::into_inner),
                _ => std::array::from_fn(|i| turn(&at_home[i])),
            };
        let base = axes(Body::Base, &|u| *u);
        let platform = axes(Body::Platform, &|u| home.rotation.inverse() * u);
        let hinges = |body: Body, axes: &[Vector3<f64>; 6]| {
            let firsts = required.hardware.universal(body).map_or([None; 6], |joint| joint.first_axes);
            std::array::from_fn(|i| firsts[i].map(|first| Hinge::new(first.into_inner(), &axes[i])))
        };
        let hinges = [hinges(Body::Base, &base), hinges(Body::Platform, &platform)];
        let plates = Body::BOTH.map(|body| {
            let hardware = &required.hardware;
            required.plates.of(body).map(|plate| PlateSolid::of(plate, manipulator, body, hardware, home))
        });
        Self { manipulator, required, axes: [base, platform], hinges, plates, coupled }
    }

    /// The universal joint at an end (0 base, 1 platform) of a leg.
    pub fn hinge(&self, end: usize, leg: usize) -> Option<&Hinge> {
        self.hinges[end][leg].as_ref()
    }

    /// The plate of a body, if the design describes it.
    #[must_use]
    pub fn plate(&self, body: Body) -> Option<&PlateSolid> {
        self.plates[body.index()].as_ref()
    }

    /// The axes of joint angles, unit vectors in leg order from base to platform, in the frame of their body.
    #[must_use]
    pub fn axes(&self) -> &[[Vector3<f64>; 6]; 2] {
        &self.axes
    }

    /// The least gap at the pose between two legs without a shared joint: the margin of the clearance plus the
    /// clearance itself. `None` for legs without diameter, or if every two share a joint.
    #[must_use]
    pub fn least_leg_gap(&self, pose: &Pose) -> Option<f64> {
        let clearance = self.required.hardware.leg_clearance.unwrap_or(0.0);
        let gaps = self.of_kind(pose, TermKind::LegClearance);
        gaps.map(|(_, margin)| margin + clearance).reduce(f64::min)
    }

    /// Margins of the requirements that do not depend on the pose: positive if met.
    #[must_use]
    pub fn fixed(&self) -> Vec<(Term, f64)> {
        let m = self.manipulator;
        let bodies = [
            (TermKind::BaseSpacing, Body::Base, m.base_joints(), m.pairs().map(|p| p.0)),
            (TermKind::PlatformSpacing, Body::Platform, m.platform_joints(), m.pairs().map(|p| p.1)),
        ];
        let mut out = self.joints_in_envelopes();
        self.holes(&mut out);
        for (kind, body, joints, used) in bodies {
            let is_used = |i: &usize| used.contains(i);
            let housings: Vec<Vec<Option<Housing>>> =
                (0..joints.len()).map(|k| self.required.hardware.housings_at(body, &used, k)).collect();
            for i in (0..joints.len()).filter(is_used) {
                for j in (i + 1..joints.len()).filter(is_used) {
                    let d = joints[j] - joints[i];
                    let pairs = housings[i]
                        .iter()
                        .flat_map(|a| housings[j].iter().filter_map(|b| Housing::pair(*a, *b)));
                    let gaps = pairs.map(|[a, b]| a.gap(&b, d.into()));
                    let centres = self.required.min_joint_distance.map(|least| d.norm() - least);
                    if let Some(margin) = gaps.chain(centres).reduce(f64::min) {
                        out.push((Term { kind, first: i, second: j }, margin));
                    }
                }
            }
        }
        out
    }

    /// Distances of the joints of a body inside its envelope.
    fn joints_in_envelopes(&self) -> Vec<(Term, f64)> {
        let envelopes = &self.required.envelopes;
        let bodies = [
            (TermKind::BaseEnvelope, Body::Base, envelopes.base),
            (TermKind::PlatformEnvelope, Body::Platform, envelopes.platform),
        ];
        let mut out = Vec::new();
        for (kind, body, envelope) in bodies {
            let Some(envelope) = envelope else { continue };
            let used = self.manipulator.pairs().map(|p| body.of(p));
            for (i, joint) in
                self.manipulator.joints(body).iter().enumerate().filter(|(i, _)| used.contains(i))
            {
                let housings = self.required.hardware.housings_at(body, &used, i);
                let inside = housings.into_iter().map(|housing| {
                    let (half, radius) = extent(housing);
                    envelope.margin(joint.coords.into(), &half, radius)
                });
                let margin = inside.fold(f64::INFINITY, f64::min);
                out.push((Term { kind, first: i, second: i }, margin));
            }
        }
        out
    }

    /// Distances of the holes of the plates from outlines and from each other.
    fn holes(&self, out: &mut Vec<(Term, f64)>) {
        for body in Body::BOTH {
            let (Some(plate), Some(solid)) = (self.required.plates.of(body), self.plate(body)) else {
                continue;
            };
            let edge = body.of((TermKind::BaseHoleEdge, TermKind::PlatformHoleEdge));
            let gap = body.of((TermKind::BaseHoleGap, TermKind::PlatformHoleGap));
            for (kind, margins) in [(edge, solid.edge_margins(plate)), (gap, solid.gap_margins(plate))] {
                out.extend(margins.iter().map(|([first, second], margin)| {
                    (Term { kind, first: *first, second: *second }, *margin)
                }));
            }
        }
    }

    /// Distances of the joints of both ends of each leg inside the envelope of the machine.
    fn machine(&self, ends: &[(Point3<f64>, Point3<f64>); 6], out: &mut Vec<(Term, f64)>) {
        let Some(envelope) = self.required.envelopes.machine else { return };
        for (i, (a, b)) in ends.iter().enumerate() {
            for (second, (body, at)) in [(Body::Base, a), (Body::Platform, b)].into_iter().enumerate() {
                let ball = ball(self.required.hardware.housing(body, i));
                let margin = envelope.margin(at.coords.into(), &Vector3::zeros(), ball);
                out.push((Term { kind: TermKind::MachineEnvelope, first: i, second }, margin));
            }
        }
    }

    /// Margins of all requirements at a pose: positive if met. Forces at a singular pose have the margin minus
    /// infinity, and the platform has no stiffness there.
    #[must_use]
    pub fn at(&self, pose: &Pose) -> Vec<(Term, f64)> {
        self.some_at(pose, |_| true)
    }

    /// The margins of one kind at a pose, as [`at`](Self::at) gives them.
    pub(super) fn of_kind(&self, pose: &Pose, kind: TermKind) -> impl Iterator<Item = (Term, f64)> + use<> {
        self.some_at(pose, |kinds| kinds.contains(&kind)).into_iter().filter(move |(t, _)| t.kind == kind)
    }

    /// The margins at a pose of the groups of kinds that `accepts` allows.
    fn some_at(&self, pose: &Pose, accepts: impl Fn(&[TermKind]) -> bool) -> Vec<(Term, f64)> {
        let mut out = Vec::new();
        if let Some(cranks) = &self.required.cranks {
            self.cranks(cranks, pose, &mut out);
            return out;
        }
        let joints: [(Point3<f64>, Point3<f64>); 6] =
            self.manipulator.legs().map(|l| (l.base, pose.transform(&l.platform)));
        let legs = self.legs_at(&joints, pose);
        if accepts(&TermKind::OF_LEG_LINES) || accepts(&TermKind::HINGES) {
            self.lengths_and_cone_angles(&legs, pose, &mut out);
        }
        if accepts(&TermKind::CLEARANCES) {
            self.clearances(&legs.ends, pose, &mut out);
        }
        for (term, margin) in &mut out {
            let two = term.kind == TermKind::LegClearance && legs.missing[term.second];
            if legs.missing[term.first] || two {
                *margin = f64::NEG_INFINITY;
            }
        }
        if accepts(&[TermKind::LegForce, TermKind::LegSpeed]) {
            self.drives(&legs, pose, &mut out);
        }
        if accepts(&[TermKind::MachineEnvelope]) {
            self.machine(&joints, &mut out);
        }
        if accepts(&TermKind::OF_PLATFORM) {
            self.stiffness(pose, &mut out);
        }
        out
    }

    /// The legs at a pose, for any kind of joints.
    fn legs_at(&self, joints: &[(Point3<f64>, Point3<f64>); 6], pose: &Pose) -> LegsAt {
        let mut out = LegsAt {
            ends: *joints,
            lengths: joints.map(|(a, b)| (b - a).norm()),
            missing: [false; 6],
            states: None,
        };
        let Some(coupled) = &self.coupled else { return out };
        let found: [Option<DriveState>; 6] =
            std::array::from_fn(|i| coupled.as_ref().ok().and_then(|legs| legs.state_of(i, pose).ok()));
        for (i, state) in found.iter().enumerate() {
            let Some(state) = state else {
                out.missing[i] = true;
                continue;
            };
            let start = joints[i].0 + state.start;
            out.ends[i] = (start, start + state.line);
            out.lengths[i] += state.correction;
        }
        let all: Option<Vec<DriveState>> = found.into_iter().collect();
        out.states = all.and_then(|all| all.try_into().ok());
        out
    }

    /// Rates of the drives by rows, moments over a length; `None` if joints have offsets and a leg is undetermined.
    pub(super) fn drive_rows(&self, pose: &Pose, length: f64) -> Option<Matrix6<f64>> {
        match &self.coupled {
            None => Some(jacobian(self.manipulator, pose, length)),
            Some(Ok(coupled)) => Some(CoupledLegs::jacobian(&coupled.states(pose).ok()?, length)),
            Some(Err(_)) => None,
        }
    }

    /// `true` if joints have offsets or legs have a lead.
    pub(super) fn are_coupled(&self) -> bool {
        self.coupled.is_some()
    }

    /// Stiffness of the platform on its legs, and its natural frequency.
    fn stiffness(&self, pose: &Pose, out: &mut Vec<(Term, f64)>) {
        let Some(required) = self.required.platform_stiffness else { return };
        let rows = self.drive_rows(pose, self.manipulator.size());
        let mut keep = |kind, value: f64, least: f64| {
            out.push((Term { kind, first: 0, second: 0 }, value - least));
        };
        if required.linear.is_some() || required.angular.is_some() {
            let leg = self.required.hardware.leg_stiffness.unwrap_or(0.0);
            let found = softest_of(rows.as_ref(), self.manipulator.size(), leg);
            let _ = required.linear.map(|least| keep(TermKind::LinearStiffness, found.linear, least));
            let _ = required.angular.map(|least| keep(TermKind::AngularStiffness, found.angular, least));
        }
        if let (Some(least), Some(masses), false) =
            (required.natural_frequency, &self.required.vibrating, self.required.leaves_out_moving_legs())
        {
            let mass = mass_matrix(self.manipulator, &masses.bodies, pose);
            let lowest = lowest_of(rows.as_ref(), self.manipulator.size(), &mass, masses.leg);
            keep(TermKind::NaturalFrequency, lowest, least);
        }
    }

    fn lengths_and_cone_angles(&self, legs: &LegsAt, pose: &Pose, out: &mut Vec<(Term, f64)>) {
        let hardware = &self.required.hardware;
        let back = pose.rotation.inverse();
        for (i, (a, b)) in legs.ends.iter().enumerate() {
            let line = b - a;
            let own = |kind| Term { kind, first: i, second: i };
            if let Some(limits) = hardware.leg_length {
                let (least, greatest) = limits.range();
                out.push((own(TermKind::MinLegLength), legs.lengths[i] - least));
                out.push((own(TermKind::MaxLegLength), greatest - legs.lengths[i]));
            }
            if let Some(cone_angle) = hardware.base_cone_angle {
                out.push((
                    own(TermKind::BaseConeAngle),
                    cone_angle.limits_deg[i] - angle_deg(&line, &self.axes[0][i]),
                ));
            }
            if let Some(cone_angle) = hardware.platform_cone_angle {
                let angle = angle_deg(&(back * line), &self.axes[1][i]);
                out.push((own(TermKind::PlatformConeAngle), cone_angle.limits_deg[i] - angle));
            }
            for kind in TermKind::HINGES {
                let Some((body, angle)) = kind.hinge() else { continue };
                let Some(limit) = hardware.angle_limit_deg(kind, i) else { continue };
                let end = body.index();
                let line = if body == Body::Base { line } else { back * line };
                if let Some(hinge) = self.hinge(end, i) {
                    out.push((own(kind), hinge.margin_deg(&line, angle, limit)));
                }
            }
        }
    }

    fn clearances(&self, ends: &[(Point3<f64>, Point3<f64>); 6], pose: &Pose, out: &mut Vec<(Term, f64)>) {
        let hardware = &self.required.hardware;
        let Some(body) = hardware.leg_body else { return };
        let clearance = hardware.leg_clearance.unwrap_or(0.0);
        let legs = ends.map(|(a, b)| parts(body.parts((b - a).norm()), (a, b)));
        let pairs = self.manipulator.pairs();
        for i in 0..6 {
            // legs at a shared joint meet there by design
            for j in (i + 1..6).filter(|&j| pairs[i].0 != pairs[j].0 && pairs[i].1 != pairs[j].1) {
                let gap = |(p, q): (&Part, &Part)| segment_distance([p.0, p.1], [q.0, q.1]) - p.2 - q.2;
                let all = legs[i].iter().flat_map(|p| legs[j].iter().map(move |q| (p, q)));
                let least = all.map(gap).fold(f64::INFINITY, f64::min);
                out.push((Term { kind: TermKind::LegClearance, first: i, second: j }, least - clearance));
            }
            for (k, keep_out) in self.required.keep_outs.iter().enumerate() {
                let least = shape_gap(&keep_out.shape, keep_out.fixed_to, &legs[i], pose);
                out.push((Term { kind: TermKind::KeepOut, first: i, second: k }, least - clearance));
            }
            self.plate_clearances(i, (&body, &ends[i]), pose, clearance, out);
            if let Some(shape) = &self.required.payload_shape {
                let least = shape_gap(shape, Body::Platform, &legs[i], pose);
                let kind = TermKind::PayloadClearance;
                out.push((Term { kind, first: i, second: i }, least - clearance));
            }
        }
    }

    /// Gaps between a leg and the plates.
    ///
    /// Each leg is next to both plates: at the plate of an end it counts from the housing of its joint.
    fn plate_clearances(
        &self,
        i: usize,
        (leg, (a, b)): (&LegBody, &(Point3<f64>, Point3<f64>)),
        pose: &Pose,
        clearance: f64,
        out: &mut Vec<(Term, f64)>,
    ) {
        let back = |q: &Point3<f64>| pose.rotation.inverse() * (q - pose.position);
        for body in Body::BOTH {
            let Some(plate) = self.plate(body) else { continue };
            let reach = self.required.hardware.joint_reach(body, i);
            let free = leg.parts_beyond((b - a).norm(), body, reach).map(|(_, part)| part);
            let free = parts(free, (*a, *b));
            let gap = |(p, q, radius): &Part| match body {
                Body::Base => plate.distance(p, q) - radius,
                Body::Platform => plate.distance(&back(p), &back(q)) - radius,
            };
            let least = free.iter().map(gap).fold(f64::INFINITY, f64::min);
            let kind = TermKind::PlateClearance;
            out.push((Term { kind, first: i, second: body.index() }, least - clearance));
        }
    }

    fn drives(&self, legs: &LegsAt, pose: &Pose, out: &mut Vec<(Term, f64)>) {
        let (hardware, m) = (&self.required.hardware, self.manipulator);
        if let Some(greatest) = hardware.drive_limit(TermKind::LegForce) {
            let rows = self.drive_rows(pose, m.size());
            let lines = rows.map(|rows| HeldLines::new(&rows, m.size()));
            for (k, load) in self.required.loads.iter().enumerate() {
                let forces = lines.as_ref().and_then(|lines| lines.forces(&load.wrench(m, pose)));
                for i in 0..6 {
                    let margin = forces.map_or(f64::NEG_INFINITY, |f| greatest - f[i].abs());
                    out.push((Term { kind: TermKind::LegForce, first: i, second: k }, margin));
                }
            }
        }
        if let (Some(greatest), Some(speed)) =
            (hardware.drive_limit(TermKind::LegSpeed), self.required.platform_speed)
        {
            // u.v + (R b x u).w over all |v| <= linear, |w| <= angular
            let rows = if self.are_coupled() { None } else { Some(jacobian(m, pose, 1.0)) };
            let rows = rows.or_else(|| legs.states.as_ref().map(|states| CoupledLegs::jacobian(states, 1.0)));
            for i in 0..6 {
                let fastest = rows.map_or(f64::INFINITY, |rows| {
                    let moment = rows.fixed_view::<1, 3>(i, 3).norm();
                    // leg lines are unit vectors; the rates of screws that rotate with them are longer
                    let line = if self.are_coupled() { rows.fixed_view::<1, 3>(i, 0).norm() } else { 1.0 };
                    speed.fastest(line, moment)
                });
                let own = Term { kind: TermKind::LegSpeed, first: i, second: i };
                out.push((own, greatest - fastest));
            }
        }
    }
}

/// The least gap of the parts of a leg and a shape that moves with a body.
fn shape_gap(shape: &KeepOutShape, fixed_to: Body, leg: &[Part], pose: &Pose) -> f64 {
    let local = |q: &Point3<f64>| match fixed_to {
        Body::Base => *q,
        Body::Platform => pose.rotation.inverse() * (q - pose.position),
    };
    let gap = |(p, q, radius): &Part| shape.distance(&local(p), &local(q)) - radius;
    leg.iter().map(gap).fold(f64::INFINITY, f64::min)
}
