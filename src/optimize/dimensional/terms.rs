//! The requirements as functions of the legs, positive if met, with gradients.
//!
//! Lengths are in sizes of the design, forces and speeds relative to their limits. A joint angle is
//! `(d . c - cos(limit) |d|) / size`, which is smooth. For a given axis and a limit below 90 degrees it is concave in
//! `d`. Gaps, distances in envelopes, plates, parts of legs, loads, forces and speeds are those of
//! `machine::requirements`.

use nalgebra::{Vector3, Vector6};

use super::leg_gaps::Gap;
use super::leg_lines::{HeldLegs, LegLines};
use super::plates::{PlacedPlate, PlateModel};
use super::pull::Gradient;
use super::shape::{JointEnds, LegJoints, Shape};
use super::stiffness::{self, RayleighQuotient};
use crate::climb::TermId;
use machine::requirements;
use machine::requirements::{
    ConeLimits, HingeAngle, Housing, JointAxes, KeepOutShape, Requirements, TermKind,
};
use num::ordered::{OrderedNumber, Sloped};
use platform::geom::Pose;
use platform::manipulator::Body;

/// A convex form of `value >= 0`: the head is at least the norm of the line of the leg, both divided by the size.
#[derive(Debug, Clone, Copy)]
pub(crate) enum ConvexForm {
    /// `greatest >= |d|`.
    Length { leg: usize, greatest: f64 },
    /// `d . c / cos(limit) >= |d|` for a given axis (base frame).
    ConeAngle { leg: usize, axis: Vector3<f64>, cos: f64 },
}

/// A requirement at a pose.
#[derive(Debug, Clone, Copy)]
pub(super) struct PoseTerm<P> {
    pub id: TermId,
    pub value: f64,
    pub pull: P,
    pub exact: Option<ConvexForm>,
}

/// The data for the evaluation of the requirements besides the legs.
#[derive(Debug, Clone)]
pub(crate) struct RequirementTerms<'a> {
    pub required: &'a Requirements,
    pub size: f64,
    pub home: Pose,
    /// Base and platform joint of each leg.
    pub joints: LegJoints,
    /// First variables of chosen axes.
    pub axes: [Option<usize>; 2],
    plates: Vec<PlateModel<'a>>,
}

/// Value of a singular pose in the limits of forces, in limits.
const SINGULAR_FORCE: f64 = -10.0;

impl<'a> RequirementTerms<'a> {
    pub(super) fn new(required: &'a Requirements, size: f64, home: Pose, shape: &Shape) -> Self {
        let plate = |body: Body| {
            let joints = shape.joints.map(|p| body.of(p));
            let plate = required.plates.of(body)?;
            let others = shape.joints_without_legs(body);
            Some(PlateModel::new(plate, body, &required.hardware, joints, others, size))
        };
        let plates = Body::BOTH.into_iter().filter_map(plate).collect();
        Self { required, size, home, joints: shape.joints, axes: shape.axes, plates }
    }

    /// The line of a leg at home.
    fn line_at_home(&self, ends: &JointEnds, leg: usize) -> Vector3<f64> {
        self.home.rotation * ends.platform[leg] + self.home.position + ends.lift - ends.base[leg]
    }

    /// The plates under the joints, on the side away from the legs at home.
    fn placed_plates(&self, ends: &JointEnds) -> impl Iterator<Item = PlacedPlate<'_>> {
        let towards: Vector3<f64> = (0..6).map(|i| self.line_at_home(ends, i)).sum();
        let (ends, home) = (*ends, self.home.rotation);
        self.plates.iter().map(move |plate| match plate.body {
            Body::Base => plate.place(&ends, &towards),
            Body::Platform => plate.place(&ends, &-(home.inverse() * towards)),
        })
    }

    /// Every requirement at a pose.
    pub(super) fn visit<P: Gradient>(
        &self,
        l: &LegLines,
        ends: &JointEnds,
        x: &[f64],
        see: &mut impl FnMut(PoseTerm<P>),
    ) {
        self.lengths(l, see);
        self.cone_angle(l, ends, x, see);
        self.hinges(l, ends, see);
        self.leg_clearances(l, see);
        self.keep_outs(l, see);
        self.payload_clearances(l, see);
        self.plate_clearances(l, ends, see);
        self.forces(l, see);
        self.speeds(l, see);
        self.machine(l, see);
        self.stiffness(l, see);
    }

    /// Visits the requirements at a pose for a kind, a leg and another leg (keep-out, load), at a fraction of the cost
    /// of [`visit`](Self::visit). Requirements that are computed together with them are visited too.
    pub(crate) fn visit_some<P: Gradient>(
        &self,
        l: &LegLines,
        (ends, x): (&JointEnds, &[f64]),
        (kind, first, second): (TermKind, usize, usize),
        see: &mut impl FnMut(PoseTerm<P>),
    ) {
        match kind {
            TermKind::MinLegLength | TermKind::MaxLegLength => self.lengths(l, see),
            TermKind::BaseConeAngle | TermKind::PlatformConeAngle => self.cone_angle(l, ends, x, see),
            kind if kind.hinge().is_some() => self.hinges(l, ends, see),
            TermKind::LegClearance => self.leg_clearance(l, (first, second), see),
            TermKind::LegForce => self.forces(l, see),
            TermKind::LegSpeed => self.speeds(l, see),
            TermKind::MachineEnvelope => self.machine(l, see),
            kind if kind.is_of_platform() => self.stiffness(l, see),
            _ => self.visit(l, ends, x, see),
        }
    }

    /// Stiffness over the required one, and half of the square of the natural frequency over its required value, each
    /// minus its required value.
    fn stiffness<P: Gradient>(&self, l: &LegLines, see: &mut impl FnMut(PoseTerm<P>)) {
        let Some(wanted) = self.required.platform_stiffness else { return };
        let leg = self.required.hardware.leg_stiffness.unwrap_or(0.0);
        let of = |kind, least: f64| 1.0 + self.required.safety_margin(kind) / least;
        for (kind, least, about_torques) in [
            (TermKind::LinearStiffness, wanted.linear, false),
            (TermKind::AngularStiffness, wanted.angular, true),
        ] {
            let Some(least) = least else { continue };
            let found = stiffness::stiffness(l, self.size, about_torques);
            quotients(kind, found, leg / least, of(kind, least), see);
        }
        if let (Some(least), Some(masses)) = (wanted.natural_frequency, &self.required.vibrating) {
            let kind = TermKind::NaturalFrequency;
            let found = stiffness::frequencies(l, self.size, masses);
            let (omega, kept) = (least * std::f64::consts::TAU, of(kind, least));
            quotients(kind, found, 0.5 / (omega * omega), 0.5 * kept * kept, see);
        }
    }

    fn lengths<P: Gradient>(&self, l: &LegLines, see: &mut impl FnMut(PoseTerm<P>)) {
        let Some(limits) = self.required.hardware.leg_length else { return };
        let (least, greatest) = limits.range();
        let least = least + self.required.safety_margin(TermKind::MinLegLength);
        let greatest = greatest - self.required.safety_margin(TermKind::MaxLegLength);
        for i in 0..6 {
            let mut pull = P::none();
            pull.line(i, l.direction[i] / self.size);
            let short = (l.length[i] - least) / self.size;
            see(PoseTerm { id: (TermKind::MinLegLength, i, i, 0), value: short, pull, exact: None });
            let exact = Some(ConvexForm::Length { leg: i, greatest });
            let long = (greatest - l.length[i]) / self.size;
            see(PoseTerm {
                id: (TermKind::MaxLegLength, i, i, 0),
                value: long,
                pull: pull.scaled(-1.0),
                exact,
            });
        }
    }

    fn cone_angle<P: Gradient>(
        &self,
        l: &LegLines,
        ends: &JointEnds,
        x: &[f64],
        see: &mut impl FnMut(PoseTerm<P>),
    ) {
        let h = &self.required.hardware;
        let bodies = [
            (TermKind::BaseConeAngle, h.base_cone_angle),
            (TermKind::PlatformConeAngle, h.platform_cone_angle),
        ];
        for (body, (kind, cone_angle)) in bodies.into_iter().enumerate() {
            let Some(cone_angle) = cone_angle else { continue };
            for i in 0..6 {
                see(self.cone_angle_of(l, ends, x, (body, kind, i), &cone_angle));
            }
        }
    }

    fn cone_angle_of<P: Gradient>(
        &self,
        l: &LegLines,
        ends: &JointEnds,
        x: &[f64],
        (body, kind, i): (usize, TermKind, usize),
        cone_angle: &ConeLimits,
    ) -> PoseTerm<P> {
        let cos = (cone_angle.limits_deg[i] - self.required.safety_margin(kind)).to_radians().cos();
        let here = |c: &Vector3<f64>| if body == 0 { *c } else { l.rotation * c };
        let back = |g: &Vector3<f64>| if body == 0 { *g } else { l.rotation.inverse() * g };
        let mut pull = P::none();
        let d = &l.line[i];
        let (axis, exact) = match (self.axes[body], cone_angle.axes) {
            (Some(first), _) => {
                let c = Vector3::from_fn(|k, _| x[first + 3 * i + k]);
                pull.set_axis(body, i, back(d) / self.size);
                (here(&c), None)
            }
            (None, JointAxes::Given(axes)) => {
                let c = here(&axes[i]);
                (c, (cos > 0.0).then_some(ConvexForm::ConeAngle { leg: i, axis: c, cos }))
            }
            (None, _) => {
                // along the leg at home, which moves with the joints
                let line = self.line_at_home(ends, i);
                let turn =
                    |v: &Vector3<f64>| here(&if body == 0 { *v } else { self.home.rotation.inverse() * v });
                let unturn = |g: &Vector3<f64>| {
                    let g = back(g);
                    if body == 0 { g } else { self.home.rotation * g }
                };
                let u = line.normalize();
                let g = unturn(d);
                pull.set_home(i, (g - u * u.dot(&g)) / (line.norm() * self.size));
                (turn(&u), None)
            }
        };
        pull.line(i, (axis - l.direction[i] * cos) / self.size);
        PoseTerm { id: (kind, i, i, 0), value: (d.dot(&axis) - cos * l.length[i]) / self.size, pull, exact }
    }

    /// Angles of universal joints. The first is `(d.n - cos(limit) |d'|) / size`, with the part `d'` of the line across
    /// the first axis. The second is `(sin(limit) |d| -+ d.a) / size` for both sides.
    fn hinges<P: Gradient>(&self, l: &LegLines, ends: &JointEnds, see: &mut impl FnMut(PoseTerm<P>)) {
        let hardware = &self.required.hardware;
        for kind in TermKind::HINGES {
            let Some((body, angle)) = kind.hinge() else { continue };
            let Some(joint) = hardware.universal(body) else { continue };
            for i in 0..6 {
                let (Some(limit), Some(first)) = (hardware.angle_limit_deg(kind, i), joint.first_axes[i])
                else {
                    continue;
                };
                let limit = (limit - self.required.safety_margin(kind)).to_radians();
                let first = first.into_inner();
                match angle {
                    HingeAngle::First => {
                        see(self.first_angle_of(l, ends, (body, kind, i), (first, joint.axes), limit));
                    }
                    HingeAngle::Second => {
                        let first = if body == Body::Base { first } else { l.rotation * first };
                        for (part, side) in [1.0, -1.0].into_iter().enumerate() {
                            let value = limit.sin() * l.length[i] - side * l.line[i].dot(&first);
                            let mut pull = P::none();
                            pull.line(i, (l.direction[i] * limit.sin() - first * side) / self.size);
                            see(PoseTerm {
                                id: (kind, i, i, part),
                                value: value / self.size,
                                pull,
                                exact: None,
                            });
                        }
                    }
                }
            }
        }
    }

    fn first_angle_of<P: Gradient>(
        &self,
        l: &LegLines,
        ends: &JointEnds,
        (body, kind, i): (Body, TermKind, usize),
        (first, rest_axes): (Vector3<f64>, JointAxes),
        limit: f64,
    ) -> PoseTerm<P> {
        let (turn, home) = if body == Body::Base {
            (nalgebra::Rotation3::identity(), nalgebra::Rotation3::identity())
        } else {
            (l.rotation, self.home.rotation)
        };
        // all in the frame of the body
        let across = |v: &Vector3<f64>| first.cross(&v.cross(&first));
        let d = turn.inverse() * l.line[i];
        let aside = across(&d);
        let at_home = self.line_at_home(ends, i);
        let axis = match rest_axes {
            JointAxes::Given(axes) => axes[i].into_inner(),
            JointAxes::Home | JointAxes::Optimize => home.inverse() * at_home.normalize(),
        };
        let spread = across(&axis);
        let id = (kind, i, i, 0);
        let Some(rest) = spread.try_normalize(0.0) else {
            // no rest direction: the greatest possible angle from it
            let value = -(1.0 + limit.cos()) * aside.norm() / self.size;
            return PoseTerm { id, value, pull: P::none(), exact: None };
        };
        let mut pull = P::none();
        if !matches!(rest_axes, JointAxes::Given(_)) {
            let g = home * ((aside - rest * rest.dot(&aside)) / spread.norm());
            let u = at_home.normalize();
            pull.set_home(i, (g - u * u.dot(&g)) / (at_home.norm() * self.size));
        }
        let away = aside.try_normalize(0.0).unwrap_or_default();
        pull.line(i, turn * (rest - away * limit.cos()) / self.size);
        let value = d.dot(&rest) - limit.cos() * aside.norm();
        PoseTerm { id, value: value / self.size, pull, exact: None }
    }

    /// The length of the part of a leg across the first axis of its universal joint.
    pub(crate) fn across_first_axis(&self, l: &LegLines, body: Body, leg: usize) -> f64 {
        let joint = self.required.hardware.universal(body);
        let Some(first) = joint.and_then(|joint| joint.first_axes[leg]) else { return l.length[leg] };
        let first = first.into_inner();
        let first = if body == Body::Base { first } else { l.rotation * first };
        first.cross(&l.line[leg]).norm()
    }

    fn leg_clearances<P: Gradient>(&self, l: &LegLines, see: &mut impl FnMut(PoseTerm<P>)) {
        for (i, j) in self.separate_legs() {
            self.leg_clearance(l, (i, j), see);
        }
    }

    /// The least allowed gap of a kind of clearance.
    fn least_clearance(&self, kind: TermKind) -> f64 {
        self.required.hardware.leg_clearance.unwrap_or(0.0) + self.required.safety_margin(kind)
    }

    /// The requirement that a gap is at least the allowed one.
    fn clearance<P: Gradient>(&self, id: TermId, (gap, least): (f64, f64), pull: P) -> PoseTerm<P> {
        PoseTerm { id, value: (gap - least) / self.size, pull: pull.scaled(1.0 / self.size), exact: None }
    }

    fn leg_clearance<P: Gradient>(
        &self,
        l: &LegLines,
        (i, j): (usize, usize),
        see: &mut impl FnMut(PoseTerm<P>),
    ) {
        let Some(body) = self.required.hardware.leg_body else { return };
        let least = self.least_clearance(TermKind::LegClearance);
        l.leg_gaps(&body, i, j, &mut |gap: Gap<P>| {
            see(self.clearance((TermKind::LegClearance, i, j, gap.part), (gap.value, least), gap.pull));
        });
    }

    fn keep_outs<P: Gradient>(&self, l: &LegLines, see: &mut impl FnMut(PoseTerm<P>)) {
        for (k, keep_out) in self.required.keep_outs.iter().enumerate() {
            for i in 0..6 {
                self.shape_clearance(l, (TermKind::KeepOut, i, k), (&keep_out.shape, keep_out.fixed_to), see);
            }
        }
    }

    fn payload_clearances<P: Gradient>(&self, l: &LegLines, see: &mut impl FnMut(PoseTerm<P>)) {
        let Some(shape) = &self.required.payload_shape else { return };
        for i in 0..6 {
            self.shape_clearance(l, (TermKind::PayloadClearance, i, i), (shape, Body::Platform), see);
        }
    }

    fn shape_clearance<P: Gradient>(
        &self,
        l: &LegLines,
        (kind, i, k): (TermKind, usize, usize),
        shape: (&KeepOutShape, Body),
        see: &mut impl FnMut(PoseTerm<P>),
    ) {
        let Some(body) = self.required.hardware.leg_body else { return };
        let least = self.least_clearance(kind);
        l.keep_out_gaps(&body, i, shape, &mut |gap: Gap<P>| {
            see(self.clearance((kind, i, k, gap.part), (gap.value, least), gap.pull));
        });
    }

    /// Clearance of the legs from both plates: at the plate of an end a leg begins at the housing of its joint.
    fn plate_clearances<P: Gradient>(
        &self,
        l: &LegLines,
        ends: &JointEnds,
        see: &mut impl FnMut(PoseTerm<P>),
    ) {
        let h = &self.required.hardware;
        let Some(leg_body) = h.leg_body else { return };
        let kind = TermKind::PlateClearance;
        let least = self.least_clearance(kind);
        for (plate, model) in self.placed_plates(ends).zip(&self.plates) {
            for i in 0..6 {
                let reach = h.joint_reach(model.body, i);
                plate.clearances(l, (&leg_body, i, reach), &mut |part, gap, pull: P| {
                    see(self.clearance((kind, i, model.body.index(), part), (gap, least), pull));
                });
            }
        }
    }

    /// Pairs of legs without a common joint.
    pub(crate) fn separate_legs(&self) -> impl Iterator<Item = (usize, usize)> {
        let joints = self.joints;
        (0..6)
            .flat_map(|i| (i + 1..6).map(move |j| (i, j)))
            .filter(move |&(i, j)| joints[i].0 != joints[j].0 && joints[i].1 != joints[j].1)
    }

    fn forces<P: Gradient>(&self, l: &LegLines, see: &mut impl FnMut(PoseTerm<P>)) {
        let Some(greatest) = self.required.hardware.drive_limit(TermKind::LegForce) else { return };
        let kept = 1.0 - self.required.safety_margin(TermKind::LegForce) / greatest;
        let lines = HeldLegs::new::<P>(l, self.size);
        for (k, load) in self.required.loads.iter().enumerate() {
            let forces = lines.hold(load);
            for i in 0..6 {
                let id = (TermKind::LegForce, i, k, 0);
                let item = match &forces {
                    Some(f) => {
                        let (value, pull): (f64, P) = f.of(i);
                        let factor = -value.signum() / greatest;
                        PoseTerm {
                            id,
                            value: kept - value.abs() / greatest,
                            pull: pull.scaled(factor),
                            exact: None,
                        }
                    }
                    None => PoseTerm { id, value: SINGULAR_FORCE, pull: P::none(), exact: None },
                };
                see(item);
            }
        }
    }

    fn speeds<P: Gradient>(&self, l: &LegLines, see: &mut impl FnMut(PoseTerm<P>)) {
        let (Some(greatest), Some(speed)) =
            (self.required.hardware.drive_limit(TermKind::LegSpeed), self.required.platform_speed)
        else {
            return;
        };
        let kept = 1.0 - self.required.safety_margin(TermKind::LegSpeed) / greatest;
        for i in 0..6 {
            let moment = Sloped::norm(Sloped::point(&l.arm[i].cross(&l.direction[i])));
            let fastest = speed.fastest(Sloped::from(1.0), moment);
            let mut pull = P::none();
            let g = Vector6::from_fn(|k, _| if k < 3 { 0.0 } else { -fastest.slope[k - 3] / greatest });
            l.pull_row(&mut pull, i, 1.0, &g);
            let value = kept - fastest.value / greatest;
            see(PoseTerm { id: (TermKind::LegSpeed, i, i, 0), value, pull, exact: None });
        }
    }

    /// Requirements without a pose: gaps of housings and distances of joint centres.
    pub(super) fn fixed<P: Gradient>(&self, ends: &JointEnds, see: &mut impl FnMut(PoseTerm<P>)) {
        for (kind, body) in [(TermKind::BaseSpacing, Body::Base), (TermKind::PlatformSpacing, Body::Platform)]
        {
            let safety_margin = self.required.safety_margin(kind);
            for (i, j) in self.separate_housings(body) {
                let at = body.of((&ends.base, &ends.platform));
                let d = Sloped::point(&(at[j] - at[i]));
                let gaps = [
                    self.required.min_joint_distance.map(|least| Sloped::norm(d) - Sloped::from(least)),
                    self.housings(body, i, j).map(|[a, b]| a.gap(&b, d)),
                ];
                for (part, gap) in gaps.into_iter().enumerate().filter_map(|(k, gap)| Some((k, gap?))) {
                    let pull = joint_pull(body, i, j, &(gap.slope / self.size));
                    let value = (gap.value - safety_margin) / self.size;
                    see(PoseTerm { id: (kind, i, j, part), value, pull, exact: None });
                }
            }
        }
        self.patterns(ends, see);
        self.plates(ends, see);
    }

    /// Distances of the holes of the plates from outlines and from each other.
    fn patterns<P: Gradient>(&self, ends: &JointEnds, see: &mut impl FnMut(PoseTerm<P>)) {
        for (plate, model) in self.placed_plates(ends).zip(&self.plates) {
            let edge = model.body.of((TermKind::BaseHoleEdge, TermKind::PlatformHoleEdge));
            let gap = model.body.of((TermKind::BaseHoleGap, TermKind::PlatformHoleGap));
            plate.edges(self.required.safety_margin(edge), see);
            plate.gaps(self.required.safety_margin(gap), see);
        }
    }

    /// Distances of joints inside the envelope of their body.
    fn plates<P: Gradient>(&self, ends: &JointEnds, see: &mut impl FnMut(PoseTerm<P>)) {
        let envelopes = &self.required.envelopes;
        let bodies = [
            (TermKind::BaseEnvelope, Body::Base, envelopes.base),
            (TermKind::PlatformEnvelope, Body::Platform, envelopes.platform),
        ];
        for (kind, body, envelope) in bodies {
            let Some(envelope) = envelope else { continue };
            let safety_margin = self.required.safety_margin(kind);
            let at = body.of((&ends.base, &ends.platform));
            for i in self.different_housings(body) {
                let (half, ball) = requirements::extent(self.required.hardware.housing(body, i));
                envelope.sides(Sloped::point(&at[i]), (&half, ball), &mut |part, margin| {
                    let (mut pull, g) = (P::none(), margin.slope / self.size);
                    match body {
                        Body::Base => pull.at_base(i, &g),
                        Body::Platform => pull.at_arm(i, &g),
                    }
                    let value = (margin.value - safety_margin) / self.size;
                    see(PoseTerm { id: (kind, i, i, part), value, pull, exact: None });
                });
            }
        }
    }

    /// Distances of both ends of each leg inside the envelope of the machine.
    fn machine<P: Gradient>(&self, l: &LegLines, see: &mut impl FnMut(PoseTerm<P>)) {
        let Some(envelope) = self.required.envelopes.machine else { return };
        let kind = TermKind::MachineEnvelope;
        let safety_margin = self.required.safety_margin(kind);
        for i in 0..6 {
            for body in Body::BOTH {
                let ball = requirements::ball(self.required.hardware.housing(body, i));
                let at = body.of((l.base[i], l.base[i] + l.line[i]));
                envelope.sides(Sloped::point(&at), (&Vector3::zeros(), ball), &mut |part, margin| {
                    let (mut pull, g) = (P::none(), margin.slope / self.size);
                    match body {
                        Body::Base => pull.at_base(i, &g),
                        Body::Platform => {
                            pull.at_arm(i, &g);
                            pull.at_position(&g);
                        }
                    }
                    let value = (margin.value - safety_margin) / self.size;
                    see(PoseTerm { id: (kind, i, body.index(), part), value, pull, exact: None });
                });
            }
        }
    }

    /// Pairs of legs that represent pairs of different joints of a body, each pair of joints once.
    pub(crate) fn separate_joints(&self, body: Body) -> Vec<(usize, usize)> {
        let joint = self.joints.map(|p| body.of(p));
        let firsts: Vec<usize> = (0..6).filter(|&i| !joint[..i].contains(&joint[i])).collect();
        let pairs = firsts.iter().enumerate();
        pairs.flat_map(|(n, &i)| firsts[n + 1..].iter().map(move |&j| (i, j))).collect()
    }

    /// Legs that represent the housings of a body, each housing about a joint once.
    fn different_housings(&self, body: Body) -> Vec<usize> {
        let of = |i: usize| (body.of(self.joints[i]), self.required.hardware.housing(body, i));
        (0..6).filter(|&i| (0..i).all(|k| of(k) != of(i))).collect()
    }

    /// Pairs of legs that represent pairs of housings about different joints of a body, each pair once.
    fn separate_housings(&self, body: Body) -> Vec<(usize, usize)> {
        let legs = self.different_housings(body);
        let pairs = legs.iter().enumerate();
        let pairs = pairs.flat_map(|(n, &i)| legs[n + 1..].iter().map(move |&j| (i, j)));
        pairs.filter(|&(i, j)| body.of(self.joints[i]) != body.of(self.joints[j])).collect()
    }

    /// The housings of the joints of two legs, if at least one has a housing.
    fn housings(&self, body: Body, i: usize, j: usize) -> Option<[Housing; 2]> {
        let hardware = &self.required.hardware;
        Housing::pair(hardware.housing(body, i), hardware.housing(body, j))
    }
}

/// `factor` times each quotient, minus its required value; without quotients the pose is singular and has no stiffness.
fn quotients<P: Gradient>(
    kind: TermKind,
    found: Option<Vec<RayleighQuotient<P>>>,
    factor: f64,
    wanted: f64,
    see: &mut impl FnMut(PoseTerm<P>),
) {
    let none = vec![RayleighQuotient { value: 0.0, pull: P::none() }];
    for (part, q) in found.unwrap_or(none).into_iter().enumerate() {
        let value = q.value * factor - wanted;
        see(PoseTerm { id: (kind, 0, 0, part), value, pull: q.pull.scaled(factor), exact: None });
    }
}

/// Gradient of the difference of joints `j - i` of a body at the identity rotation.
pub(crate) fn joint_pull<P: Gradient>(body: Body, i: usize, j: usize, g: &Vector3<f64>) -> P {
    let mut pull = P::none();
    for (leg, g) in [(i, -g), (j, *g)] {
        match body {
            Body::Base => pull.at_base(leg, &g),
            Body::Platform => pull.at_arm(leg, &g),
        }
    }
    pull
}
