//! A plate as a solid in the frame of its body, and the margins of its holes.

use nalgebra::{Matrix3, Point2, Point3, Vector3};

use super::super::hardware::Hardware;
use super::PlateDesign;
use super::outline::Outline;
use platform::geom::{Pose, any_across};
use platform::manipulator::{Body, Manipulator};

/// Joints nearer than this share of the size are one seat.
const SAME: f64 = 1e-9;

/// Normal of the greatest triangle of the joints, towards positive z (then y, then x); the direction across their line
/// nearest to `along` where they lie on one.
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
                // equal triangles are told apart by rounding only: the first one stays
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

/// A plate with parallel faces on the far side of its joints from the legs: all points `axes (u, v, w)` with `(u, v)`
/// within the outline and `w` from [`lower`](Self::lower) to `lower + thickness`.
#[derive(Debug, Clone, PartialEq)]
pub struct PlateSolid {
    /// Axes of the plate in the frame of the body, as columns; the third is the normal.
    pub axes: Matrix3<f64>,
    /// `true` when the legs are on the side the normal points to.
    pub legs_above: bool,
    /// Where the face that the joints stand on is along the normal, design units.
    pub face: f64,
    /// Thickness, design units.
    pub thickness: f64,
    /// The outline, plate coordinates.
    pub outline: Outline,
    /// The feet of all joints of the body, those without a leg included, as the exports draw them.
    pub seats: Vec<PlateSeat>,
}

/// Two holes, or one and the outline, that stand nearest: the joints, and the margin.
pub(crate) type HoleMargin = ([usize; 2], f64);

impl PlateSolid {
    /// The plate of a body; `home` says on which side the legs are.
    #[must_use]
    pub fn of(plate: &PlateDesign, m: &Manipulator, body: Body, hardware: &Hardware, home: &Pose) -> Self {
        let towards: Vector3<f64> = m.legs().iter().map(|l| home.transform(&l.platform) - l.base).sum();
        let towards = if body == Body::Base { towards } else { -(home.rotation.inverse() * towards) };
        let (joints, size) = (m.joints(body), m.size());
        let normal = plate_normal(joints, &towards, size);
        let axes = frame_of(&normal);
        let legs_above = normal.dot(&towards) >= 0.0;
        let side = if legs_above { 1.0 } else { -1.0 };
        let lowest = joints.iter().map(|p| side * normal.dot(&p.coords)).fold(f64::INFINITY, f64::min);
        let mut seats: Vec<PlateSeat> = Vec::new();
        for (k, joint) in joints.iter().enumerate() {
            let local = axes.transpose() * joint.coords;
            let at = Point2::new(local.x, local.y);
            if let Some(seat) = seats.iter_mut().find(|s| (s.at - at).norm() <= SAME * size) {
                seat.joints.push(k);
            } else {
                let bolts = plate.bolts.map_or_else(Vec::new, |b| b.places(&at));
                seats.push(PlateSeat { joints: vec![k], at, bolts });
            }
        }
        let centres: Vec<Point2<f64>> = seats.iter().map(|s| s.at).collect();
        Self {
            axes,
            legs_above,
            face: side * (lowest - plate.joint_height(hardware, body)),
            thickness: plate.thickness,
            outline: Outline::around(&centres, plate.margin, SAME * size),
            seats,
        }
    }

    /// Where the lower face is along the normal.
    #[must_use]
    pub fn lower(&self) -> f64 {
        if self.legs_above { self.face - self.thickness } else { self.face }
    }

    /// The point of the plate, its holes filled, nearest to a point of the frame of the body; that point itself inside.
    #[must_use]
    pub fn nearest(&self, p: &Point3<f64>) -> Point3<f64> {
        let local = self.axes.transpose() * p.coords;
        let at = self.outline.nearest(&Point2::new(local.x, local.y));
        let w = local.z.clamp(self.lower(), self.lower() + self.thickness);
        p + self.axes * Vector3::new(at.x - local.x, at.y - local.y, w - local.z)
    }

    /// The share of the segment `x y` at which it is nearest to the plate, its holes filled, and the nearest point
    /// there.
    ///
    /// The distance from a convex body is convex along the segment: where it falls neither at the beginning nor at the
    /// end, the zero of its slope is enclosed by halving.
    #[must_use]
    pub fn nearest_to_segment(&self, [x, y]: [&Point3<f64>; 2]) -> (f64, Point3<f64>) {
        let d = y - x;
        let at = |t: f64| {
            let p = x + d * t;
            let near = self.nearest(&p);
            ((p - near).dot(&d), near)
        };
        let (start, end) = (at(0.0), at(1.0));
        if start.0 >= 0.0 {
            return (0.0, start.1);
        }
        if end.0 <= 0.0 {
            return (1.0, end.1);
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let t = f64::midpoint(low, high);
            let (slope, near) = at(t);
            if slope == 0.0 {
                return (t, near);
            }
            if slope < 0.0 { low = t } else { high = t }
        }
        let t = f64::midpoint(low, high);
        (t, at(t).1)
    }

    /// Distance of the segment `x y` from the plate, its holes filled; 0 where they meet.
    #[must_use]
    pub fn distance(&self, x: &Point3<f64>, y: &Point3<f64>) -> f64 {
        let (t, near) = self.nearest_to_segment([x, y]);
        (x + (y - x) * t - near).norm()
    }

    /// Middles and radii of the holes of a seat.
    fn holes_of<'a>(
        plate: &'a PlateDesign,
        seat: &'a PlateSeat,
    ) -> impl Iterator<Item = (Point2<f64>, f64)> + 'a {
        let bolt = plate.bolts.map_or(0.0, |b| 0.5 * b.hole);
        [(seat.at, 0.5 * plate.hole)].into_iter().chain(seat.bolts.iter().map(move |p| (*p, bolt)))
    }

    /// For each seat by how much its holes are farther from the outline than they have to be:
    /// `depth - radius - edge_distance`, the least over the holes.
    pub(crate) fn edge_margins(&self, plate: &PlateDesign) -> Vec<HoleMargin> {
        let of = |seat: &PlateSeat| {
            let margins = Self::holes_of(plate, seat).map(|(p, r)| self.outline.depth(&p) - r);
            let least = margins.fold(f64::INFINITY, f64::min) - plate.edge_distance;
            ([seat.joints[0]; 2], least)
        };
        self.seats.iter().map(of).collect()
    }

    /// For each two seats by how much their holes and feet are farther apart than they have to be, the bolts of one
    /// from the foot of the other too, and for each seat alone the same of its own holes.
    pub(crate) fn gap_margins(&self, plate: &PlateDesign) -> Vec<HoleMargin> {
        let gap = |(p, r): &(Point2<f64>, f64), (q, s): &(Point2<f64>, f64)| {
            (p - q).norm() - r - s - plate.hole_distance
        };
        let holes: Vec<Vec<_>> = self.seats.iter().map(|s| Self::holes_of(plate, s).collect()).collect();
        let mut out = Vec::new();
        for (i, (a, own)) in self.seats.iter().zip(&holes).enumerate() {
            let pairs = own.iter().enumerate();
            let among = pairs.flat_map(|(k, p)| own[k + 1..].iter().map(move |q| (p, q)));
            if let Some(least) = among.map(|(p, q)| gap(p, q)).reduce(f64::min) {
                out.push(([a.joints[0]; 2], least));
            }
            for (b, others) in self.seats.iter().zip(&holes).skip(i + 1) {
                let all = own.iter().flat_map(|p| others.iter().map(move |q| gap(p, q)));
                let feet = plate.foot.map_or(f64::INFINITY, |foot| (a.at - b.at).norm() - foot);
                let feet =
                    feet.min(Self::bolts_from_foot(plate, a, b)).min(Self::bolts_from_foot(plate, b, a));
                out.push(([a.joints[0], b.joints[0]], all.fold(feet, f64::min)));
            }
        }
        out
    }

    /// How far the bolt holes of one seat are from the foot of another; infinite without bolts or feet.
    fn bolts_from_foot(plate: &PlateDesign, bolted: &PlateSeat, standing: &PlateSeat) -> f64 {
        let (Some(foot), Some(bolts)) = (plate.foot, plate.bolts) else { return f64::INFINITY };
        let away = |p: &Point2<f64>| (p - standing.at).norm() - 0.5 * (foot + bolts.hole);
        bolted.bolts.iter().map(away).fold(f64::INFINITY, f64::min)
    }

    /// The greatest length that coordinates of its points are computed from.
    pub fn extent(&self) -> f64 {
        let far = self.seats.iter().flat_map(|s| s.bolts.iter().chain([&s.at]));
        let far = far.map(|p| p.coords.norm()).fold(0.0, f64::max);
        far + self.outline.margin + self.face.abs() + self.thickness
    }
}
