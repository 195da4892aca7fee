//! Platforms in oblique projection: the horizontal plane runs to the right and, foreshortened by one half, into the
//! depth.

use nalgebra::{Point3, Vector3};

use super::style::Svg;
use platform::geom::Pose;
use platform::manipulator::{Manipulator, Octahedral};

/// Depth is drawn along this direction (right, up): half size at about 35 degrees.
const DEPTH: (f64, f64) = (0.41, 0.29);

/// Coordinates to the right and up, design units.
pub(super) fn oblique(c: &Vector3<f64>) -> (f64, f64) {
    (c.x + DEPTH.0 * c.y, c.z + DEPTH.1 * c.y)
}

/// Least and greatest coordinates of points on the page.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extent {
    pub(super) across: (f64, f64),
    pub(super) up: (f64, f64),
}

impl Extent {
    pub(super) fn of(points: impl Iterator<Item = (f64, f64)>) -> Self {
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        let wider = |r: (f64, f64), v: f64| (r.0.min(v), r.1.max(v));
        points.fold(Self { across: none, up: none }, |e, p| Self {
            across: wider(e.across, p.0),
            up: wider(e.up, p.1),
        })
    }

    /// Pixels per design unit that fit the points into a width and a height.
    pub(super) fn scale(&self, (width, height): (f64, f64)) -> f64 {
        let scale = |r: (f64, f64), pixels: f64| pixels / (r.1 - r.0).max(f64::MIN_POSITIVE);
        scale(self.across, width).min(scale(self.up, height))
    }
}

/// The frame of a triangle of the base: origin in its centroid, `w` its normal.
#[derive(Debug)]
pub(super) struct BaseFrame {
    centre: Vector3<f64>,
    u: Vector3<f64>,
    v: Vector3<f64>,
    w: Vector3<f64>,
}

impl BaseFrame {
    /// The frame of the base triangle of an octahedral platform, otherwise of the largest triangle of base joints.
    pub(super) fn of(m: &Manipulator) -> Self {
        Self::new(&base_triangle(m))
    }

    /// `w` on the side of positive z (then y, then x) of the design, `u` along the edge `P1 P3`.
    fn new(base: &[Point3<f64>; 3]) -> Self {
        let centre = (base[0].coords + base[1].coords + base[2].coords) / 3.0;
        let u = (base[2] - base[0]).normalize();
        let normal = (base[1] - base[0]).cross(&(base[2] - base[0])).normalize();
        let leading = [normal.z, normal.y, normal.x].into_iter().find(|x| x.abs() > 1e-9);
        let w = if leading.is_some_and(|x| x < 0.0) { -normal } else { normal };
        Self { centre, u, v: w.cross(&u), w }
    }

    pub(super) fn coordinates(&self, p: &Point3<f64>) -> Vector3<f64> {
        let d = p.coords - self.centre;
        Vector3::new(self.u.dot(&d), self.v.dot(&d), self.w.dot(&d))
    }

    /// Coordinates to the right and up, design units.
    pub(super) fn on_page(&self, p: &Point3<f64>) -> (f64, f64) {
        oblique(&self.coordinates(p))
    }
}

fn base_triangle(m: &Manipulator) -> [Point3<f64>; 3] {
    if let Ok(octahedral) = Octahedral::recognise(m) {
        return octahedral.base();
    }
    let p = m.legs().map(|l| l.base);
    let triples = (0..6).flat_map(|i| (i + 1..6).flat_map(move |j| (j + 1..6).map(move |k| [i, j, k])));
    let area = |t: &[usize; 3]| (p[t[1]] - p[t[0]]).cross(&(p[t[2]] - p[t[0]])).norm();
    triples.max_by(|a, b| area(a).total_cmp(&area(b))).unwrap_or([0, 1, 2]).map(|k| p[k])
}

/// Joints of base and platform that carry legs, each in the order of their angle about the axis of least spread.
pub(super) fn outlines(m: &Manipulator) -> [Vec<usize>; 2] {
    let pairs = m.pairs();
    [
        outline(m.base_joints(), pairs.iter().map(|p| p.0)),
        outline(m.platform_joints(), pairs.iter().map(|p| p.1)),
    ]
}

fn outline(joints: &[Point3<f64>], used: impl Iterator<Item = usize>) -> Vec<usize> {
    let mut list: Vec<usize> = used.collect();
    list.sort_unstable();
    list.dedup();
    let centre = list.iter().map(|i| joints[*i].coords).sum::<Vector3<f64>>() / list.len() as f64;
    let normal = list
        .windows(2)
        .map(|w| (joints[w[0]].coords - centre).cross(&(joints[w[1]].coords - centre)))
        .max_by(|x, y| x.norm().total_cmp(&y.norm()))
        .and_then(|n| n.try_normalize(0.0))
        .unwrap_or_else(Vector3::z);
    let u = list.first().and_then(|i| (joints[*i].coords - centre).try_normalize(0.0));
    let u = u.unwrap_or_else(Vector3::x);
    let v = normal.cross(&u);
    let angle = |i: &usize| {
        let d = joints[*i].coords - centre;
        d.dot(&v).atan2(d.dot(&u))
    };
    list.sort_by(|i, j| angle(i).total_cmp(&angle(j)));
    list
}

/// A platform at a pose on the page: outlines of the bodies, and the legs in their order.
#[derive(Debug, Clone)]
pub(super) struct Bodies {
    base: Vec<(f64, f64)>,
    platform: Vec<(f64, f64)>,
    legs: [[(f64, f64); 2]; 6],
}

impl Bodies {
    pub(super) fn new(m: &Manipulator, pose: &Pose, frame: &BaseFrame) -> Self {
        let [base, platform] = outlines(m);
        let tip = |p: &Point3<f64>| frame.on_page(&pose.transform(p));
        Self {
            base: base.iter().map(|k| frame.on_page(&m.base_joints()[*k])).collect(),
            platform: platform.iter().map(|k| tip(&m.platform_joints()[*k])).collect(),
            legs: m.legs().map(|l| [frame.on_page(&l.base), tip(&l.platform)]),
        }
    }

    /// The corners of both bodies, base first.
    pub(super) fn corners(&self) -> impl Iterator<Item = (f64, f64)> {
        self.base.iter().chain(&self.platform).copied()
    }

    /// The base is drawn first, then parts farther below it; the platform is last, so that no leg hides it. `first` is
    /// the class of the first leg.
    pub(super) fn draw(&self, svg: &mut Svg, first: &str, at: impl Fn((f64, f64)) -> (f64, f64)) {
        let place = |points: &[(f64, f64)]| points.iter().map(|p| at(*p)).collect::<Vec<_>>();
        svg.polygon("base", &place(&self.base));
        for (k, [a, b]) in self.legs.iter().enumerate() {
            svg.line(if k == 0 { first } else { "leg" }, at(*a), at(*b));
        }
        svg.polygon("platform", &place(&self.platform));
    }
}
