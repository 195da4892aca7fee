//! A plate as a solid in the frame of its body, and the margins of its holes.

use nalgebra::{Matrix3, Point2, Point3, Vector3};

use super::super::hardware::Hardware;
use super::PlateDesign;
use super::outline::Outline;
use platform::geom::{Pose, any_across};
use platform::manipulator::{Body, Manipulator};

/// Joints nearer than this share of the size are one seat.
const SAME: f64 = 1e-9;

/// Normal of the greatest triangle of the joints, towards positive z (then y, then x). For collinear joints it is the
/// direction across their line nearest to `along`.
pub fn plate_normal(points: &[Point3<f64>], along: &Vector3<f64>, size: f64) -> Vector3<f64> {
    let mut best = Vector3::zeros();
    let mut line = Vector3::zeros();
    for (i, p) in points.iter().enumerate() {
        for (j, q) in points.iter().enumerate().skip(i + 1) {
            if (q - p).norm() > line.norm() {
                line = q - p;
            }
            for r in &points[j + 1..] {
                let cross = (q - p).cross(&(r - p));
                // only rounding distinguishes equal triangles: the first one stays
                if cross.norm() > best.norm() * (1.0 + 1e-9) {
                    best = cross;
                }
            }
        }
    }
    if best.norm() <= 1e-9 * size * size {
        let across = match line.try_normalize(1e-9 * size) {
            Some(d) => along - d * d.dot(along),
            None => *along,
        };
        best = across.try_normalize(1e-6).unwrap_or_else(|| any_across(&line));
    }
    let n = best.normalize();
    let leading = [n.z, n.y, n.x].into_iter().find(|x| x.abs() > 1e-9);
    if leading.is_some_and(|x| x < 0.0) { -n } else { n }
}

/// The axes `(u, v, n)`: `u` the body's x-axis in the plane, or its y-axis where x is along `n`.
pub fn frame_of(n: &Vector3<f64>) -> Matrix3<f64> {
    let first = if n.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
    let u = (first - n * n.dot(&first)).normalize();
    Matrix3::from_columns(&[u, n.cross(&u), *n])
}

/// The foot of one joint, or of several joints with the same centre, on a plate.
#[derive(Debug, Clone, PartialEq)]
pub struct PlateSeat {
    /// The joints, counted from 0.
    pub joints: Vec<usize>,
    /// The middle of its hole, plate coordinates.
    pub at: Point2<f64>,
    /// The middles of its bolt holes, plate coordinates.
    pub bolts: Vec<Point2<f64>>,
}

/// A plate with parallel faces, on the side of its joints away from the legs. It consists of the points
/// `axes (u, v, w)` with `(u, v)` within the outline and `w` from [`lower`](Self::lower) to `lower + thickness`.
#[derive(Debug, Clone, PartialEq)]
pub struct PlateSolid {
    /// Axes of the plate in the frame of the body, as columns; the third is the normal.
    pub axes: Matrix3<f64>,
    /// `true` when the legs are on the side the normal points to.
    pub legs_above: bool,
    /// Position of the joint face along the normal, design units.
    pub face: f64,
    /// Thickness, design units.
    pub thickness: f64,
    /// The outline, plate coordinates.
    pub outline: Outline,
    /// The feet of all joints of the body, including joints without a leg, as the exports draw them.
    pub seats: Vec<PlateSeat>,
}

/// The joints of the nearest pair of two holes, or of a hole and the outline, and the margin.
pub(crate) type HoleMargin = ([usize; 2], f64);

/// A hole of a plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlateHole {
    /// The number of its seat.
    pub seat: usize,
    /// 0 for the hole under the joint, from 1 on for bolts.
    pub number: usize,
    /// Its middle, plate coordinates.
    pub at: Point2<f64>,
    /// Its radius.
    pub radius: f64,
}

/// Two parts of a plate with a required distance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HolePair {
    /// Two holes.
    Holes,
    /// The feet around two holes under joints.
    Feet,
    /// A bolt and the foot of another joint, with the number of the hole under the foot: the first or the second one.
    BoltAndFoot(usize),
}

/// Distance of two holes or feet minus the required one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HoleGap {
    /// The holes, or those in the middles of feet.
    pub holes: [PlateHole; 2],
    /// The kind of the pair.
    pub pair: HolePair,
    /// The margin.
    pub margin: f64,
}

impl HoleGap {
    /// The seats of both.
    #[must_use]
    pub fn seats(&self) -> [usize; 2] {
        self.holes.map(|hole| hole.seat)
    }
}

impl PlateSolid {
    /// The plate of a body; `home` determines the side of the legs.
    #[must_use]
    pub fn of(plate: &PlateDesign, m: &Manipulator, body: Body, hardware: &Hardware, home: &Pose) -> Self {
        let towards: Vector3<f64> = m.legs().iter().map(|l| home.transform(&l.platform) - l.base).sum();
        let towards = if body == Body::Base { towards } else { -(home.rotation.inverse() * towards) };
        let (joints, size) = (m.joints(body), m.size());
        let mut out = Self::under((plate, plate.joint_height(hardware, body)), joints, &towards, size);
        let mut seats: Vec<PlateSeat> = Vec::new();
        for mut seat in std::mem::take(&mut out.seats) {
            match seats.iter_mut().find(|s| (s.at - seat.at).norm() <= SAME * size) {
                Some(same) => same.joints.append(&mut seat.joints),
                None => seats.push(seat),
            }
        }
        Self { seats, ..out }
    }

    /// The plate under joints, with the height of the lowest joint above it and a seat for each; `towards` points to
    /// the legs.
    #[must_use]
    pub fn under(
        (plate, height): (&PlateDesign, f64),
        joints: &[Point3<f64>],
        towards: &Vector3<f64>,
        size: f64,
    ) -> Self {
        let normal = plate_normal(joints, towards, size);
        let axes = frame_of(&normal);
        let legs_above = normal.dot(towards) >= 0.0;
        let side = if legs_above { 1.0 } else { -1.0 };
        let lowest = joints.iter().map(|p| side * normal.dot(&p.coords)).fold(f64::INFINITY, f64::min);
        let seat = |(k, joint): (usize, &Point3<f64>)| {
            let local = axes.transpose() * joint.coords;
            let at = Point2::new(local.x, local.y);
            let bolts = plate.bolts.map_or_else(Vec::new, |b| b.places(&at));
            PlateSeat { joints: vec![k], at, bolts }
        };
        let seats: Vec<PlateSeat> = joints.iter().enumerate().map(seat).collect();
        let centres: Vec<Point2<f64>> = seats.iter().map(|s| s.at).collect();
        Self {
            axes,
            legs_above,
            face: side * (lowest - height),
            thickness: plate.thickness,
            outline: Outline::around(&centres, plate.margin, SAME * size),
            seats,
        }
    }

    /// Position of the lower face along the normal, design units.
    #[must_use]
    pub fn lower(&self) -> f64 {
        if self.legs_above { self.face - self.thickness } else { self.face }
    }

    /// The point of the plate, its holes filled, nearest to a point, both in plate coordinates; that point itself
    /// inside.
    fn nearest(&self, p: &Vector3<f64>) -> Vector3<f64> {
        let at = self.outline.nearest(&Point2::new(p.x, p.y));
        Vector3::new(at.x, at.y, p.z.clamp(self.lower(), self.lower() + self.thickness))
    }

    /// The share of the segment `x y` at which it is nearest to the plate, its holes filled, and the nearest point
    /// there.
    ///
    /// The distance from a convex body is convex along the segment. Unless its minimum is at an end, bisection encloses
    /// the zero of its slope.
    #[must_use]
    pub fn nearest_to_segment(&self, ends: [&Point3<f64>; 2]) -> (f64, Point3<f64>) {
        let [x, y] = ends.map(|p| self.axes.transpose() * p.coords);
        let (t, way) = self.nearest_to_local([&x, &y]);
        (t, ends[0] + (ends[1] - ends[0]) * t - self.axes * way)
    }

    /// The same in plate coordinates, with the vector from the nearest point of the plate to that of the segment.
    #[must_use]
    pub fn nearest_to_local(&self, [x, y]: [&Vector3<f64>; 2]) -> (f64, Vector3<f64>) {
        let d = y - x;
        let way = |t: f64| {
            let p = x + d * t;
            p - self.nearest(&p)
        };
        let (start, end) = (way(0.0), way(1.0));
        if start.dot(&d) >= 0.0 {
            return (0.0, start);
        }
        if end.dot(&d) <= 0.0 {
            return (1.0, end);
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let t = f64::midpoint(low, high);
            let slope = way(t).dot(&d);
            if slope == 0.0 {
                return (t, way(t));
            }
            if slope < 0.0 { low = t } else { high = t }
        }
        let t = f64::midpoint(low, high);
        (t, way(t))
    }

    /// Distance of the segment `x y` from the plate, its holes filled; 0 where they meet.
    #[must_use]
    pub fn distance(&self, x: &Point3<f64>, y: &Point3<f64>) -> f64 {
        let [x, y] = [x, y].map(|p| self.axes.transpose() * p.coords);
        self.nearest_to_local([&x, &y]).1.norm()
    }

    /// The holes of a seat.
    #[must_use]
    pub fn holes_of(&self, plate: &PlateDesign, seat: usize) -> Vec<PlateHole> {
        let PlateSeat { at, bolts, .. } = &self.seats[seat];
        let bolt = plate.bolts.map_or(0.0, |b| 0.5 * b.hole);
        let all = std::iter::once((*at, 0.5 * plate.hole)).chain(bolts.iter().map(|p| (*p, bolt)));
        all.enumerate().map(|(number, (at, radius))| PlateHole { seat, number, at, radius }).collect()
    }

    /// For each seat the least distance of its holes from the outline minus the required one:
    /// `depth - radius - edge_distance`.
    pub(crate) fn edge_margins(&self, plate: &PlateDesign) -> Vec<HoleMargin> {
        let of = |(k, seat): (usize, &PlateSeat)| {
            let holes = self.holes_of(plate, k);
            let margins = holes.iter().map(|hole| self.outline.depth(&hole.at) - hole.radius);
            let least = margins.fold(f64::INFINITY, f64::min) - plate.edge_distance;
            ([seat.joints[0]; 2], least)
        };
        self.seats.iter().enumerate().map(of).collect()
    }

    /// For each pair of seats the distance of their holes and feet minus the required one, bolts beside the other foot
    /// included. For each seat alone the same of its own holes.
    pub(crate) fn gap_margins(&self, plate: &PlateDesign) -> Vec<HoleMargin> {
        let least = |gaps: &[HoleGap]| {
            let joints = gaps[0].seats().map(|seat| self.seats[seat].joints[0]);
            (joints, gaps.iter().map(|gap| gap.margin).fold(f64::INFINITY, f64::min))
        };
        self.gaps(plate).chunk_by(|a, b| a.seats() == b.seats()).map(least).collect()
    }

    /// All gaps of holes and feet: those of a seat, then those of this seat and each later one.
    #[must_use]
    pub fn gaps(&self, plate: &PlateDesign) -> Vec<HoleGap> {
        let apart = |p: &PlateHole, q: &PlateHole| (p.at - q.at).norm();
        let between = |p: &PlateHole, q: &PlateHole| {
            let margin = apart(p, q) - p.radius - q.radius - plate.hole_distance;
            HoleGap { holes: [*p, *q], pair: HolePair::Holes, margin }
        };
        let holes: Vec<Vec<PlateHole>> = (0..self.seats.len()).map(|k| self.holes_of(plate, k)).collect();
        let mut out = Vec::new();
        for (i, own) in holes.iter().enumerate() {
            let pairs = own.iter().enumerate();
            out.extend(pairs.flat_map(|(k, p)| own[k + 1..].iter().map(move |q| between(p, q))));
            for others in &holes[i + 1..] {
                out.extend(own.iter().flat_map(|p| others.iter().map(move |q| between(p, q))));
                let Some(foot) = plate.foot else { continue };
                let [a, b] = [own[0], others[0]];
                out.push(HoleGap { holes: [a, b], pair: HolePair::Feet, margin: apart(&a, &b) - foot });
                let of_foot = |p: &PlateHole, q: &PlateHole, bolt: f64, side| {
                    let margin = apart(p, q) - bolt - 0.5 * foot;
                    HoleGap { holes: [*p, *q], pair: HolePair::BoltAndFoot(side), margin }
                };
                out.extend(own[1..].iter().map(|bolt| of_foot(bolt, &b, bolt.radius, 1)));
                out.extend(others[1..].iter().map(|bolt| of_foot(&a, bolt, bolt.radius, 0)));
            }
        }
        out
    }

    /// The greatest length in the computation of coordinates of its points.
    pub fn extent(&self) -> f64 {
        let far = self.seats.iter().flat_map(|s| s.bolts.iter().chain([&s.at]));
        let far = far.map(|p| p.coords.norm()).fold(0.0, f64::max);
        far + self.outline.margin + self.face.abs() + self.thickness
    }
}
