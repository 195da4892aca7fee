//! Holes in the plates and clearances of the legs from plates, as functions of the joints with gradients.
//!
//! The plate of a body is the set of all points within its margin of the hull of the joints, between two faces.
//! Gradients take its normal as constant, which is exact unless joints leave their common plane.

use nalgebra::{Point2, Point3, Vector2, Vector3};

use super::leg_lines::LegLines;
use super::pull::Gradient;
use super::shape::{JointEnds, JointId};
use super::terms::PoseTerm;
use machine::requirements::{
    BoltsFrom, Hardware, HoleGap, HolePair, LegBody, LegSegment, OutlineSide, PlateDesign, PlateHole,
    PlateSolid, TermKind,
};
use platform::manipulator::Body;

/// Joints nearer than this share of the size are one corner of an outline.
const SAME: f64 = 1e-9;
/// A leg whose line is within this share of the size of a plate runs into it.
const TOUCHING: f64 = 1e-12;
/// The plate of a body before its joints are known.
#[derive(Debug, Clone)]
pub(crate) struct PlateModel<'a> {
    pub body: Body,
    plate: &'a PlateDesign,
    /// Height of the lowest joint above the face.
    height: f64,
    /// The first leg of each joint.
    legs: Vec<usize>,
    /// Joints without a leg.
    others: Vec<Vector3<f64>>,
    size: f64,
}

/// The plate with placed joints.
#[derive(Debug, Clone)]
pub(crate) struct PlacedPlate<'a> {
    model: &'a PlateModel<'a>,
    solid: PlateSolid,
    /// The leg of the lowest joint.
    lowest: Option<usize>,
    /// Seats at the corners of the hull.
    hull: Vec<usize>,
}

/// A value with its gradient, before safety margin and clearance.
type Seen<P> = (f64, P);

impl<'a> PlateModel<'a> {
    pub(super) fn new(
        plate: &'a PlateDesign,
        body: Body,
        hardware: &Hardware,
        joints: [JointId; 6],
        others: Vec<Vector3<f64>>,
        size: f64,
    ) -> Self {
        let legs = (0..6).filter(|&i| !joints[..i].contains(&joints[i])).collect();
        Self { body, plate, height: plate.joint_height(hardware, body), legs, others, size }
    }

    /// The plate under joints; `towards` points from it to the legs, frame of the body.
    pub(super) fn place(&'a self, ends: &JointEnds, towards: &Vector3<f64>) -> PlacedPlate<'a> {
        let at = self.body.of((&ends.base, &ends.platform));
        let own = self.legs.iter().map(|&leg| at[leg]);
        let points: Vec<Point3<f64>> = own.chain(self.others.iter().copied()).map(Point3::from).collect();
        let solid = PlateSolid::under((self.plate, self.height), &points, towards, self.size);
        let up = solid.axes.column(2) * if solid.legs_above { 1.0 } else { -1.0 };
        let heights = points.iter().map(|p| up.dot(&p.coords)).enumerate();
        let lowest = heights.min_by(|a, b| a.1.total_cmp(&b.1)).and_then(|(seat, _)| self.leg(seat));
        let corners = solid.outline.hull.iter();
        let hull = corners.filter_map(|c| solid.seats.iter().position(|s| s.at == *c)).collect();
        PlacedPlate { model: self, solid, lowest, hull }
    }

    /// The leg whose end moves a seat; none for a joint without a leg.
    fn leg(&self, seat: usize) -> Option<usize> {
        self.legs.get(seat).copied()
    }
}

impl PlacedPlate<'_> {
    /// Adds a gradient with respect to a joint in plate coordinates.
    fn pull<P: Gradient>(&self, pull: &mut P, leg: Option<usize>, l: Option<&LegLines>, g: &Vector3<f64>) {
        let Some(leg) = leg.filter(|_| P::KEPT) else { return };
        let g = self.solid.axes * g;
        match (self.model.body, l) {
            (Body::Base, _) => pull.at_base(leg, &g),
            (Body::Platform, Some(l)) => pull.at_arm(leg, &(l.rotation * g)),
            (Body::Platform, None) => pull.at_arm(leg, &g),
        }
    }

    fn pull_seat<P: Gradient>(&self, pull: &mut P, seat: usize, l: Option<&LegLines>, g: &Vector2<f64>) {
        self.pull(pull, self.model.leg(seat), l, &Vector3::new(g.x, g.y, 0.0));
    }

    /// Adds a gradient with respect to the middle of a hole. Bolts may rotate with the direction to their seat.
    fn pull_hole<P: Gradient>(&self, pull: &mut P, hole: &PlateHole, g: &Vector2<f64>) {
        let at = self.solid.seats[hole.seat].at;
        let bolts = self.model.plate.bolts.filter(|_| hole.number > 0);
        let turns = bolts.is_some_and(|b| b.from == BoltsFrom::Centre);
        let turned = if turns && at.coords.norm_squared() > 0.0 {
            let from_seat = hole.at - at;
            let moved = Vector2::new(-from_seat.y, from_seat.x).dot(g);
            Vector2::new(-at.y, at.x) * (moved / at.coords.norm_squared())
        } else {
            Vector2::zeros()
        };
        self.pull_seat(pull, hole.seat, None, &(g + turned));
    }

    /// Adds `factor` times the gradient of the depth by a side, with respect to the joints that the side moves with.
    fn pull_side<P: Gradient>(&self, pull: &mut P, side: &OutlineSide, factor: f64, l: Option<&LegLines>) {
        for (corner, share) in side.corners {
            self.pull_seat(pull, self.hull[corner], l, &(side.inwards * (-factor * share)));
        }
    }

    /// Distances of the holes from the outline minus the required ones, for each hole and each edge of the outline that
    /// bounds its depth.
    pub(super) fn edges<P: Gradient>(&self, safety_margin: f64, see: &mut impl FnMut(PoseTerm<P>)) {
        let model = self.model;
        let kind = model.body.of((TermKind::BaseHoleEdge, TermKind::PlatformHoleEdge));
        let mut tell = |(seat, part): (usize, usize), (value, pull): Seen<P>| {
            let value = (value - model.plate.edge_distance - safety_margin) / model.size;
            see(PoseTerm {
                id: (kind, seat, seat, part),
                value,
                pull: pull.scaled(1.0 / model.size),
                exact: None,
            });
        };
        for seat in 0..self.solid.seats.len() {
            for hole in self.solid.holes_of(model.plate, seat) {
                if hole.number == 0 && self.hull.contains(&seat) {
                    // the middle of a hole at a corner of the hull: its depth is always the margin
                    tell((seat, 0), (model.plate.margin - hole.radius, P::none()));
                    continue;
                }
                // joints on the line of an edge count as inside despite rounding
                self.solid.outline.sides(&hole.at, SAME * model.size, &mut |side| {
                    let mut pull = P::none();
                    self.pull_hole(&mut pull, &hole, &side.inwards);
                    self.pull_side(&mut pull, &side, 1.0, None);
                    let ends = side.corners.map(|(corner, _)| self.hull[corner]);
                    let of_edge = if side.is_edge { ends[0] * PARTS + ends[1] } else { 0 };
                    tell((seat, hole.number * PARTS * PARTS + of_edge), (side.depth - hole.radius, pull));
                });
            }
        }
    }

    /// Distances between the holes and feet of two joints minus the required ones, and between the holes of one joint.
    ///
    /// Only near holes of two joints are used: they are within the least distance plus the width of their pattern.
    /// Others are never the nearest ones of a similar platform.
    pub(super) fn gaps<P: Gradient>(&self, safety_margin: f64, see: &mut impl FnMut(PoseTerm<P>)) {
        let model = self.model;
        let plate = model.plate;
        let kind = model.body.of((TermKind::BaseHoleGap, TermKind::PlatformHoleGap));
        let mut tell = |[i, j]: [usize; 2], part: usize, (value, pull): Seen<P>| {
            let value = (value - safety_margin) / model.size;
            see(PoseTerm { id: (kind, i, j, part), value, pull: pull.scaled(1.0 / model.size), exact: None });
        };
        let pattern = plate.bolts.map_or(0.0, |b| b.circle);
        for gaps in self.solid.gaps(plate).chunk_by(|a, b| a.seats() == b.seats()) {
            let [i, j] = gaps[0].seats();
            let holes = gaps.iter().filter(|gap| gap.pair == HolePair::Holes);
            let nearest = holes.map(|gap| gap.margin).fold(f64::INFINITY, f64::min);
            if i == j {
                // all joints have the same distances between their own holes, independent of the variables
                if i == 0 {
                    tell([0, 0], 0, (nearest, P::none()));
                }
                continue;
            }
            for HoleGap { holes: [p, q], pair, margin } in gaps {
                let part = match pair {
                    HolePair::Holes if *margin > nearest + pattern => continue,
                    HolePair::Holes => p.number * PARTS + q.number,
                    HolePair::Feet => PARTS * PARTS,
                    HolePair::BoltAndFoot(0) => (PARTS + 2) * PARTS + q.number,
                    HolePair::BoltAndFoot(_) => (PARTS + 1) * PARTS + p.number,
                };
                tell([i, j], part, (*margin, self.apart(p, q)));
            }
        }
    }

    /// Gradient of the distance of the middles of two holes.
    fn apart<P: Gradient>(&self, p: &PlateHole, q: &PlateHole) -> P {
        let mut pull = P::none();
        let d = (p.at - q.at).try_normalize(0.0).unwrap_or_else(Vector2::x);
        self.pull_hole(&mut pull, p, &d);
        self.pull_hole(&mut pull, q, &-d);
        pull
    }

    /// A point of the base frame in plate coordinates.
    fn local(&self, l: &LegLines, p: &Vector3<f64>) -> Vector3<f64> {
        let in_body = match self.model.body {
            Body::Base => *p,
            Body::Platform => l.rotation.inverse() * (p - l.position),
        };
        self.solid.axes.transpose() * in_body
    }

    /// A direction of plate coordinates in the base frame.
    fn world(&self, l: &LegLines, n: &Vector3<f64>) -> Vector3<f64> {
        let in_body = self.solid.axes * n;
        match self.model.body {
            Body::Base => in_body,
            Body::Platform => l.rotation * in_body,
        }
    }

    /// Signed gaps between a leg and the plate; for a leg that runs into the plate, minus the way out of it.
    pub(super) fn clearances<P: Gradient>(
        &self,
        l: &LegLines,
        (body, leg, reach): (&LegBody, usize, f64),
        see: &mut impl FnMut(usize, f64, P),
    ) {
        let cut = (reach / l.length[leg]).min(1.0);
        // at its own plate a leg begins at the end of the housing of its joint
        for (number, part) in body.parts_beyond(l.length[leg], self.model.body, reach) {
            let LegSegment { from, to, .. } = part;
            let [x, y] = [from, to].map(|s| self.local(l, &l.at(leg, s)));
            let slides = |s: f64| {
                let near = |t: f64| (s - t).abs() < TOUCHING;
                if self.model.body == Body::Base && near(cut) || part.joint.is_some_and(near) {
                    PlateSlide::FromBase
                } else if self.model.body == Body::Platform && near(1.0 - cut) {
                    PlateSlide::FromPlatform
                } else {
                    PlateSlide::Share
                }
            };
            let (share, value, pull) = self.gap_of_segment::<P>(l, &x, &y);
            let s = from + share * (to - from);
            let (mut pull, n) = pull;
            if P::KEPT {
                let n = self.world(l, &n);
                l.pull_sliding(&mut pull, leg, (s, slides(s)), &n);
                if self.model.body == Body::Platform {
                    pull.at_position(&-n);
                }
            }
            see(number, value - part.radius, pull);
        }
    }

    /// The nearest point of a segment to the plate: its share, the signed distance, the moving parts of the plate, and
    /// the outward direction in plate coordinates.
    fn gap_of_segment<P: Gradient>(
        &self,
        l: &LegLines,
        x: &Vector3<f64>,
        y: &Vector3<f64>,
    ) -> (f64, f64, (P, Vector3<f64>)) {
        let (share, apart) = self.solid.nearest_to_local([x, y]);
        let distance = apart.norm();
        if distance <= TOUCHING * self.model.size {
            return self.depth_of_segment(l, x, y);
        }
        let n = apart / distance;
        let mut pull = P::none();
        if P::KEPT {
            let aside = Vector2::new(n.x, n.y);
            if aside.norm() > 0.0 {
                let near = x + (y - x) * share - apart;
                let (_, corners) = self.solid.outline.nearest_of_border(&Point2::new(near.x, near.y));
                for (corner, share) in corners {
                    self.pull_seat(&mut pull, self.hull[corner], Some(l), &(aside * -share));
                }
            }
            self.pull(&mut pull, self.lowest, Some(l), &Vector3::new(0.0, 0.0, -n.z));
        }
        (share, distance, (pull, n))
    }

    /// For a segment that runs into the plate: the shorter way, out of the joint face or over an edge.
    fn depth_of_segment<P: Gradient>(
        &self,
        l: &LegLines,
        x: &Vector3<f64>,
        y: &Vector3<f64>,
    ) -> (f64, f64, (P, Vector3<f64>)) {
        let ends = [x, y];
        let lower = |of: &dyn Fn(&Vector3<f64>) -> f64| {
            let [a, b] = ends.map(of);
            if a <= b { (0.0, a) } else { (1.0, b) }
        };
        let (solid, outline) = (&self.solid, &self.solid.outline);
        let side = if solid.legs_above { 1.0 } else { -1.0 };
        let (mut share, mut value) = lower(&|p| side * (p.z - solid.face));
        let mut over = None;
        if self.hull.len() > 1 {
            for k in 0..self.hull.len() {
                let edge = |p: &Vector3<f64>| outline.edge(k, &Point2::new(p.x, p.y));
                let (at, depth) = lower(&|p| -edge(p).depth);
                if depth > value {
                    (share, value, over) = (at, depth, Some(edge(if at > 0.5 { y } else { x })));
                }
            }
        }
        let mut pull = P::none();
        let n = match over {
            None => {
                self.pull(&mut pull, self.lowest, Some(l), &Vector3::new(0.0, 0.0, -side));
                Vector3::new(0.0, 0.0, side)
            }
            Some(edge) => {
                self.pull_side(&mut pull, &edge, -1.0, Some(l));
                Vector3::new(-edge.inwards.x, -edge.inwards.y, 0.0)
            }
        };
        (share, value, (pull, n))
    }
}

/// Upper bound of the holes of a joint, and of the joints of a body.
const PARTS: usize = 128;

/// The invariant of a point as a leg changes: the share of its line, its distance from the base joint, or from the
/// platform joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum PlateSlide {
    Share,
    FromBase,
    FromPlatform,
}

impl LegLines {
    /// Adds the gradient of `g . (a + s d)` for a point with or without sliding.
    fn pull_sliding<P: Gradient>(
        &self,
        pull: &mut P,
        leg: usize,
        (share, slides): (f64, PlateSlide),
        g: &Vector3<f64>,
    ) {
        if slides != PlateSlide::FromPlatform {
            self.pull_point(pull, leg, (share, slides == PlateSlide::FromBase), g);
            return;
        }
        // b - c u: the whole of a motion along the line, the share of one across it
        let u = &self.direction[leg];
        let along = u * u.dot(g);
        pull.at_base(leg, g);
        pull.line(leg, along + (g - along) * share);
    }
}
