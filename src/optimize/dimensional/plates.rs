//! Holes in the plates, and plates that the legs keep clear of, as functions of the joints with gradients.
//!
//! The plate of a body is the set of all points within its margin of the hull of the joints, between two faces. Its
//! normal is taken as constant where gradients are formed: it is, unless joints leave their common plane.

use nalgebra::{Matrix3, Point2, Point3, Vector2, Vector3};

use super::leg_lines::LegLines;
use super::pull::Gradient;
use super::shape::{JointEnds, JointId};
use super::terms::PoseTerm;
use machine::requirements::{
    BoltsFrom, Hardware, LegBody, LegSegment, PlateDesign, TermKind, frame_of, plate_normal,
};
use platform::geom::convex_hull;
use platform::manipulator::Body;

/// Joints nearer than this share of the size are one corner of an outline.
const SAME: f64 = 1e-9;
/// A leg whose line is nearer to a plate than this share of the size runs into it.
const TOUCHING: f64 = 1e-12;
/// Halvings that enclose the point of a leg nearest to a plate.
const HALVINGS: usize = 60;

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

/// A joint on its plate.
#[derive(Debug, Clone, Copy)]
struct Seat {
    /// The leg whose end moves it; none for a joint without a leg.
    leg: Option<usize>,
    /// Plate coordinates.
    at: Point2<f64>,
}

/// A hole: its seat, where its middle is from that of the seat, its radius, and whether it turns with the direction to
/// the seat.
#[derive(Debug, Clone, Copy)]
struct PatternHole {
    seat: usize,
    from_seat: Vector2<f64>,
    radius: f64,
    turns: bool,
}

/// The plate where its joints are.
#[derive(Debug, Clone)]
pub(crate) struct PlacedPlate<'a> {
    model: &'a PlateModel<'a>,
    /// Axes of the plate in the frame of the body, as columns; the third is the normal.
    axes: Matrix3<f64>,
    legs_above: bool,
    /// Where the face is along the normal that the joints stand on.
    face: f64,
    /// The leg of the lowest joint.
    lowest: Option<usize>,
    seats: Vec<Seat>,
    /// Seats at the corners of the hull, counter-clockwise.
    hull: Vec<usize>,
}

/// A value with its gradient, before reserve and clearance.
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

    /// The plate under joints; `towards` leads from it to the legs, in the frame of the body.
    pub(super) fn place(&'a self, ends: &JointEnds, towards: &Vector3<f64>) -> PlacedPlate<'a> {
        let at = self.body.of((&ends.base, &ends.platform));
        let own = self.legs.iter().map(|&leg| (Some(leg), at[leg]));
        let joints: Vec<(Option<usize>, Vector3<f64>)> =
            own.chain(self.others.iter().map(|p| (None, *p))).collect();
        let points: Vec<Point3<f64>> = joints.iter().map(|(_, p)| Point3::from(*p)).collect();
        let normal = plate_normal(&points, towards, self.size);
        let axes = frame_of(&normal);
        let legs_above = normal.dot(towards) >= 0.0;
        let side = if legs_above { 1.0 } else { -1.0 };
        let (mut lowest, mut height) = (None, f64::INFINITY);
        for (leg, p) in &joints {
            let here = side * normal.dot(p);
            if here < height {
                (lowest, height) = (*leg, here);
            }
        }
        let seat = |(leg, p): &(Option<usize>, Vector3<f64>)| {
            let local = axes.transpose() * p;
            Seat { leg: *leg, at: Point2::new(local.x, local.y) }
        };
        let seats: Vec<Seat> = joints.iter().map(seat).collect();
        let centres: Vec<Point2<f64>> = seats.iter().map(|s| s.at).collect();
        let corners = convex_hull(&centres, SAME * self.size);
        let hull = corners.iter().filter_map(|c| centres.iter().position(|p| p == c)).collect();
        PlacedPlate {
            model: self,
            axes,
            legs_above,
            face: side * (height - self.height),
            lowest,
            seats,
            hull,
        }
    }
}

impl PlacedPlate<'_> {
    /// Adds a gradient with respect to a joint in plate coordinates.
    fn pull<P: Gradient>(&self, pull: &mut P, leg: Option<usize>, l: Option<&LegLines>, g: &Vector3<f64>) {
        let Some(leg) = leg.filter(|_| P::KEPT) else { return };
        let g = self.axes * g;
        match (self.model.body, l) {
            (Body::Base, _) => pull.at_base(leg, &g),
            (Body::Platform, Some(l)) => pull.at_arm(leg, &(l.rotation * g)),
            (Body::Platform, None) => pull.at_arm(leg, &g),
        }
    }

    fn pull_seat<P: Gradient>(&self, pull: &mut P, seat: usize, l: Option<&LegLines>, g: &Vector2<f64>) {
        self.pull(pull, self.seats[seat].leg, l, &Vector3::new(g.x, g.y, 0.0));
    }

    /// Adds a gradient with respect to the middle of a hole.
    fn pull_hole<P: Gradient>(&self, pull: &mut P, hole: &PatternHole, g: &Vector2<f64>) {
        let at = self.seats[hole.seat].at.coords;
        let turned = if hole.turns && at.norm_squared() > 0.0 {
            let moved = Vector2::new(-hole.from_seat.y, hole.from_seat.x).dot(g);
            Vector2::new(-at.y, at.x) * (moved / at.norm_squared())
        } else {
            Vector2::zeros()
        };
        self.pull_seat(pull, hole.seat, None, &(g + turned));
    }

    fn holes(&self, seat: usize) -> Vec<PatternHole> {
        let plate = self.model.plate;
        let at = self.seats[seat].at;
        let middle =
            PatternHole { seat, from_seat: Vector2::zeros(), radius: 0.5 * plate.hole, turns: false };
        let mut out = vec![middle];
        if let Some(bolts) = &plate.bolts {
            let turns = bolts.from == BoltsFrom::Centre;
            let bolt =
                |p: Point2<f64>| PatternHole { seat, from_seat: p - at, radius: 0.5 * bolts.hole, turns };
            out.extend(bolts.places(&at).into_iter().map(bolt));
        }
        out
    }

    fn middle(&self, hole: &PatternHole) -> Point2<f64> {
        self.seats[hole.seat].at + hole.from_seat
    }

    /// Edges of the hull: both seats, the way between them, and the unit vector to the inside, the left.
    fn edge(&self, k: usize) -> ([usize; 2], Vector2<f64>, Vector2<f64>) {
        let ends = [self.hull[k], self.hull[(k + 1) % self.hull.len()]];
        let e = self.seats[ends[1]].at - self.seats[ends[0]].at;
        (ends, e, Vector2::new(-e.y, e.x) / e.norm())
    }

    /// Height of a point above the line of an edge, towards the inside.
    fn above_edge(&self, k: usize, p: &Point2<f64>) -> f64 {
        let ([a, _], _, inwards) = self.edge(k);
        inwards.dot(&(p - self.seats[a].at))
    }

    /// Adds `factor` times the gradient of [`PlacedPlate::above_edge`] with respect to the joints of the edge.
    fn pull_edge<P: Gradient>(
        &self,
        pull: &mut P,
        k: usize,
        p: &Point2<f64>,
        factor: f64,
        l: Option<&LegLines>,
    ) {
        let ([a, b], e, inwards) = self.edge(k);
        let t = (p - self.seats[a].at).dot(&e) / e.norm_squared();
        self.pull_seat(pull, a, l, &(inwards * (-factor * (1.0 - t))));
        self.pull_seat(pull, b, l, &(inwards * (-factor * t)));
    }

    fn is_inside(&self, p: &Point2<f64>) -> bool {
        // joints on the line of an edge are inside, whatever rounding says
        let least = -SAME * self.model.size;
        self.hull.len() > 2 && (0..self.hull.len()).all(|k| self.above_edge(k, p) >= least)
    }

    /// The point of the border of the hull nearest to `p`: seats with their weights.
    fn nearest_of_hull(&self, p: &Point2<f64>) -> (Point2<f64>, [(usize, f64); 2]) {
        let on = |k: usize| {
            let ([a, b], e, _) = self.edge(k);
            let square = e.norm_squared();
            let from = self.seats[a].at;
            let t = if square > 0.0 { ((p - from).dot(&e) / square).clamp(0.0, 1.0) } else { 0.0 };
            (from + e * t, [(a, 1.0 - t), (b, t)])
        };
        let all = (0..self.hull.len()).map(on);
        let near = all.min_by(|x, y| (x.0 - p).norm().total_cmp(&(y.0 - p).norm()));
        near.unwrap_or((*p, [(0, 0.0); 2]))
    }

    /// How much farther the holes are from the outline than they have to be, for each hole and each edge of the outline
    /// that bounds its depth.
    pub(super) fn edges<P: Gradient>(&self, reserve: f64, see: &mut impl FnMut(PoseTerm<P>)) {
        let model = self.model;
        let kind = model.body.of((TermKind::BaseHoleEdge, TermKind::PlatformHoleEdge));
        let mut tell = |(seat, part): (usize, usize), (value, pull): Seen<P>| {
            let value = (value - model.plate.edge_distance - reserve) / model.size;
            see(PoseTerm {
                id: (kind, seat, seat, part),
                value,
                pull: pull.scaled(1.0 / model.size),
                exact: None,
            });
        };
        for seat in 0..self.seats.len() {
            for (n, hole) in self.holes(seat).iter().enumerate() {
                let p = self.middle(hole);
                let spare = model.plate.margin - hole.radius;
                if n == 0 && self.hull.contains(&seat) {
                    // the middle of a hole at a corner of the hull: its depth is the margin wherever the corner goes
                    tell((seat, 0), (spare, P::none()));
                    continue;
                }
                if self.is_inside(&p) {
                    for k in 0..self.hull.len() {
                        let (ends, _, inwards) = self.edge(k);
                        let mut pull = P::none();
                        self.pull_hole(&mut pull, hole, &inwards);
                        self.pull_edge(&mut pull, k, &p, 1.0, None);
                        let part = (n * PARTS + ends[0]) * PARTS + ends[1];
                        tell((seat, part), (spare + self.above_edge(k, &p), pull));
                    }
                    continue;
                }
                let (near, weights) = self.nearest_of_hull(&p);
                let away = (p - near).try_normalize(TOUCHING * model.size).unwrap_or_default();
                let mut pull = P::none();
                self.pull_hole(&mut pull, hole, &-away);
                for (corner, weight) in weights {
                    self.pull_seat(&mut pull, corner, None, &(away * weight));
                }
                tell((seat, n * PARTS * PARTS), (spare - (p - near).norm(), pull));
            }
        }
    }

    /// How much farther the holes and feet of two joints are apart than they have to be, and the holes of one.
    ///
    /// Of two joints those holes that are no farther apart than the nearest ones and the width of their pattern: others
    /// are not the nearest ones of a platform nearby.
    pub(super) fn gaps<P: Gradient>(&self, reserve: f64, see: &mut impl FnMut(PoseTerm<P>)) {
        let model = self.model;
        let plate = model.plate;
        let kind = model.body.of((TermKind::BaseHoleGap, TermKind::PlatformHoleGap));
        let mut tell = |[i, j]: [usize; 2], part: usize, (value, pull): Seen<P>| {
            let value = (value - reserve) / model.size;
            see(PoseTerm { id: (kind, i, j, part), value, pull: pull.scaled(1.0 / model.size), exact: None });
        };
        let holes: Vec<Vec<PatternHole>> = (0..self.seats.len()).map(|seat| self.holes(seat)).collect();
        // what the holes of one joint leave between them is the same for all joints, and no place changes it
        let own = holes.first().map_or(&[][..], |h| &h[..]);
        let among = own.iter().enumerate().flat_map(|(k, p)| own[k + 1..].iter().map(move |q| (p, q)));
        let least = among.map(|(p, q)| (p.from_seat - q.from_seat).norm() - p.radius - q.radius);
        if let Some(least) = least.reduce(f64::min) {
            tell([0, 0], 0, (least - plate.hole_distance, P::none()));
        }
        let pattern = plate.bolts.map_or(0.0, |b| b.circle);
        for i in 0..self.seats.len() {
            for j in i + 1..self.seats.len() {
                let gap = |p: &PatternHole, q: &PatternHole| {
                    (self.middle(p) - self.middle(q)).norm() - p.radius - q.radius - plate.hole_distance
                };
                let pairs = || {
                    holes[i]
                        .iter()
                        .enumerate()
                        .flat_map(|(m, p)| holes[j].iter().enumerate().map(move |(n, q)| ((m, n), (p, q))))
                };
                let nearest = pairs().map(|(_, (p, q))| gap(p, q)).fold(f64::INFINITY, f64::min);
                for ((m, n), (p, q)) in pairs() {
                    let value = gap(p, q);
                    if value <= nearest + pattern {
                        tell([i, j], m * PARTS + n, (value, self.apart(p, q)));
                    }
                }
                let Some(foot) = plate.foot else { continue };
                // feet, and the bolts of each joint under the foot of the other
                let middles = [holes[i][0], holes[j][0]];
                let value = (self.middle(&middles[0]) - self.middle(&middles[1])).norm() - foot;
                tell([i, j], PARTS * PARTS, (value, self.apart(&middles[0], &middles[1])));
                for (side, (bolts, other)) in [(i, middles[1]), (j, middles[0])].into_iter().enumerate() {
                    for (n, bolt) in holes[bolts].iter().enumerate().skip(1) {
                        let away = (self.middle(bolt) - self.middle(&other)).norm();
                        let value = away - bolt.radius - 0.5 * foot;
                        let part = (PARTS + 1 + side) * PARTS + n;
                        tell([i, j], part, (value, self.apart(bolt, &other)));
                    }
                }
            }
        }
    }

    /// Gradient of the distance of the middles of two holes.
    fn apart<P: Gradient>(&self, p: &PatternHole, q: &PatternHole) -> P {
        let mut pull = P::none();
        let d = (self.middle(p) - self.middle(q)).try_normalize(0.0).unwrap_or_else(Vector2::x);
        self.pull_hole(&mut pull, p, &d);
        self.pull_hole(&mut pull, q, &-d);
        pull
    }

    /// From where to where the plate is along its normal.
    fn faces(&self) -> [f64; 2] {
        let thickness = self.model.plate.thickness;
        if self.legs_above { [self.face - thickness, self.face] } else { [self.face, self.face + thickness] }
    }

    /// A point of the base frame in plate coordinates.
    fn local(&self, l: &LegLines, p: &Vector3<f64>) -> Vector3<f64> {
        let in_body = match self.model.body {
            Body::Base => *p,
            Body::Platform => l.rotation.inverse() * (p - l.position),
        };
        self.axes.transpose() * in_body
    }

    /// A direction of plate coordinates in the base frame.
    fn world(&self, l: &LegLines, n: &Vector3<f64>) -> Vector3<f64> {
        let in_body = self.axes * n;
        match self.model.body {
            Body::Base => in_body,
            Body::Platform => l.rotation * in_body,
        }
    }

    /// The point of the plate nearest to a point, plate coordinates.
    fn nearest(&self, p: &Vector3<f64>) -> Vector3<f64> {
        let [low, high] = self.faces();
        let at = Point2::new(p.x, p.y);
        let margin = self.model.plate.margin;
        let at = if self.is_inside(&at) {
            at
        } else {
            let (hull, _) = self.nearest_of_hull(&at);
            let away = at - hull;
            let distance = away.norm();
            if distance <= margin { at } else { hull + away * (margin / distance) }
        };
        Vector3::new(at.x, at.y, p.z.clamp(low, high))
    }

    /// Gaps between a leg and the plate, signed: of a leg that runs into it, by how much it would have to be moved out
    /// of it.
    pub(super) fn clearances<P: Gradient>(
        &self,
        l: &LegLines,
        (body, leg, reach): (&LegBody, usize, f64),
        see: &mut impl FnMut(usize, f64, P),
    ) {
        let cut = (reach / l.length[leg]).min(1.0);
        let all: Vec<LegSegment> = body.parts(l.length[leg]).collect();
        for (number, part) in all.iter().enumerate() {
            // at its own plate a leg begins where the housing of its joint ends; the far end of what is cut off stays
            let (from, to, is_last) = match self.model.body {
                Body::Base => (part.from.max(cut), part.to, number + 1 == all.len()),
                Body::Platform => (part.from, part.to.min(1.0 - cut), number == 0),
            };
            let (from, to) = match (from < to, is_last, self.model.body) {
                (true, ..) => (from, to),
                (false, false, _) => continue,
                (false, true, Body::Base) => (part.to, part.to),
                (false, true, Body::Platform) => (part.from, part.from),
            };
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

    /// The share of a segment that is nearest to the plate, the signed distance there, what moves the plate, and the
    /// direction away from it, plate coordinates.
    fn gap_of_segment<P: Gradient>(
        &self,
        l: &LegLines,
        x: &Vector3<f64>,
        y: &Vector3<f64>,
    ) -> (f64, f64, (P, Vector3<f64>)) {
        let d = y - x;
        let slope = |t: f64| {
            let p = x + d * t;
            (p - self.nearest(&p)).dot(&d)
        };
        let share = if slope(0.0) >= 0.0 {
            0.0
        } else if slope(1.0) <= 0.0 {
            1.0
        } else {
            let (mut low, mut high) = (0.0, 1.0);
            for _ in 0..HALVINGS {
                let t = f64::midpoint(low, high);
                if slope(t) < 0.0 { low = t } else { high = t }
            }
            f64::midpoint(low, high)
        };
        let p = x + d * share;
        let near = self.nearest(&p);
        let apart = p - near;
        let distance = apart.norm();
        if distance <= TOUCHING * self.model.size {
            return self.depth_of_segment(l, x, y);
        }
        let n = apart / distance;
        let mut pull = P::none();
        if P::KEPT {
            let aside = Vector2::new(n.x, n.y);
            if aside.norm() > 0.0 {
                let (_, weights) = self.nearest_of_hull(&Point2::new(near.x, near.y));
                for (corner, weight) in weights {
                    self.pull_seat(&mut pull, corner, Some(l), &(aside * -weight));
                }
            }
            self.pull(&mut pull, self.lowest, Some(l), &Vector3::new(0.0, 0.0, -n.z));
        }
        (share, distance, (pull, n))
    }

    /// For a segment that runs into the plate: out of the face that the joints stand on or over an edge, whichever is
    /// less.
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
        let side = if self.legs_above { 1.0 } else { -1.0 };
        let (mut share, mut value) = lower(&|p| side * (p.z - self.face));
        let mut over = None;
        if self.hull.len() > 1 {
            for k in 0..self.hull.len() {
                let outside =
                    |p: &Vector3<f64>| -self.above_edge(k, &Point2::new(p.x, p.y)) - self.model.plate.margin;
                let (at, depth) = lower(&outside);
                if depth > value {
                    (share, value, over) = (at, depth, Some(k));
                }
            }
        }
        let mut pull = P::none();
        let n = match over {
            None => {
                self.pull(&mut pull, self.lowest, Some(l), &Vector3::new(0.0, 0.0, -side));
                Vector3::new(0.0, 0.0, side)
            }
            Some(k) => {
                let p = if share > 0.5 { y } else { x };
                self.pull_edge(&mut pull, k, &Point2::new(p.x, p.y), -1.0, Some(l));
                let inwards = self.edge(k).2;
                Vector3::new(-inwards.x, -inwards.y, 0.0)
            }
        };
        (share, value, (pull, n))
    }
}

/// More holes of a joint, and more joints of a body, than there are.
const PARTS: usize = 128;

/// What stays as a leg changes: the share of its line at which a point is, its distance from the base joint, or from
/// the platform joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum PlateSlide {
    Share,
    FromBase,
    FromPlatform,
}

impl LegLines {
    /// Adds the gradient of `g . (a + s d)` for a point that slides or does not.
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
        // b - c u: all of a motion along the line, the share of one across it
        let u = &self.direction[leg];
        let along = u * u.dot(g);
        pull.at_base(leg, g);
        pull.line(leg, along + (g - along) * share);
    }
}
