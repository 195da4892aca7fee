//! Symmetry of a body: mirror planes and turns that carry its joints into one another.

use nalgebra::{Matrix3, Point3, Vector3};
use serde_json::{Value as Json, json};

use super::number::ShortNumber;

/// Names of the axes.
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];
/// Planes of two axes, by the axis perpendicular to them.
pub(super) const PLANES: [&str; 3] = ["yz", "xz", "xy"];

/// The scale of comparisons within a body.
#[derive(Debug, Clone, Copy)]
pub(super) struct Closeness {
    /// Distances up to it count as rounding.
    pub(super) distance: f64,
    /// The size of the design.
    pub(super) size: f64,
}

impl Closeness {
    /// A length with few digits; it moves joints by less than the distance.
    pub(super) fn length(&self, x: f64) -> ShortNumber {
        ShortNumber::near(x, self.distance / 4.0)
    }

    /// A ratio with few digits.
    pub(super) fn ratio(&self, x: f64) -> ShortNumber {
        ShortNumber::near(x, self.distance / self.size / 4.0)
    }
}

/// A map of space onto itself as a construction writes it.
#[derive(Debug, Clone)]
pub(super) struct SymmetryMap {
    linear: Matrix3<f64>,
    centre: Vector3<f64>,
    /// The key of the joint it starts from.
    key: &'static str,
    /// The other keys.
    rest: Json,
    /// A phrase for messages.
    pub(super) words: String,
}

impl SymmetryMap {
    pub(super) fn image(&self, p: &Point3<f64>) -> Point3<f64> {
        Point3::from(self.linear * (p.coords - self.centre) + self.centre)
    }

    pub(super) fn written(&self, of: &str) -> Json {
        let mut written = self.rest.clone();
        written[self.key] = json!(of);
        written
    }

    /// Whether it carries every joint to a joint.
    fn keeps(&self, joints: &[Point3<f64>], distance: f64) -> bool {
        joints.iter().all(|p| joints.iter().any(|q| (self.image(p) - q).norm() <= distance))
    }

    /// Turned about an axis of the frame, or a parallel to it.
    fn turn(axis: usize, degrees: u16, centre: Option<&[ShortNumber; 3]>) -> Self {
        let mut rest = json!({ "deg": degrees });
        if axis != 2 {
            rest["about"] = json!(AXES[axis]);
        }
        let centre = with_point(&mut rest, centre);
        let linear =
            nalgebra::Rotation3::new(Vector3::ith(axis, f64::from(degrees).to_radians())).into_inner();
        let part = match degrees {
            120 | 240 => "a third",
            _ => "a half",
        };
        let words = format!("turned by {part} about {}{}", AXES[axis], point_words(&rest));
        Self { linear, centre, key: "turn", rest, words }
    }

    fn mirror(plane: &BodyPlane) -> Self {
        let (normal, words) = if let Some(axis) = plane.axis() {
            (json!({ "plane": PLANES[axis] }), format!("mirrored in {}", PLANES[axis]))
        } else {
            let list: Vec<Json> = plane.normal.iter().map(ShortNumber::json).collect();
            let shown: Vec<&str> = plane.normal.iter().map(|n| n.text.as_str()).collect();
            (json!({ "normal": list }), format!("mirrored in the plane with normal {}", shown.join(", ")))
        };
        let mut rest = normal;
        let centre = with_point(&mut rest, plane.through.as_ref());
        let n = plane.vector();
        let linear = Matrix3::identity() - n * n.transpose() * (2.0 / n.norm_squared());
        let words = format!("{words}{}", point_words(&rest));
        Self { linear, centre, key: "mirror", rest, words }
    }
}

fn with_point(rest: &mut Json, point: Option<&[ShortNumber; 3]>) -> Vector3<f64> {
    let Some(point) = point else { return Vector3::zeros() };
    rest["through"] = point.iter().map(ShortNumber::json).collect();
    Vector3::from(point.each_ref().map(|x| x.value))
}

fn point_words(rest: &Json) -> String {
    let Some(point) = rest.get("through").and_then(Json::as_array) else { return String::new() };
    let shown: Vec<String> = point.iter().map(|x| x.to_string().replace('"', "")).collect();
    format!(" through {}", shown.join(", "))
}

/// A mirror plane of a body. The largest coordinate of its normal is 1.
#[derive(Debug, Clone)]
pub(super) struct BodyPlane {
    normal: [ShortNumber; 3],
    through: Option<[ShortNumber; 3]>,
}

impl BodyPlane {
    fn coordinate(axis: usize) -> Self {
        let normal = [0, 1, 2].map(|i| ShortNumber::whole(i32::from(i == axis)));
        Self { normal, through: None }
    }

    fn vector(&self) -> Vector3<f64> {
        Vector3::from(self.normal.each_ref().map(|n| n.value))
    }

    /// The axis perpendicular to it, if there is one.
    fn axis(&self) -> Option<usize> {
        let zero = |i: usize| self.normal[i].value.abs() <= 0.0;
        (0..3).find(|i| zero((i + 1) % 3) && zero((i + 2) % 3))
    }

    /// Whether its normal is at 30 or 60 degrees to an axis, exactly.
    fn is_at_sixty(&self) -> bool {
        self.normal.iter().any(|n| n.text.contains("sqrt(3)") && !n.text.contains('2'))
    }

    pub(super) fn distance(&self, p: &Point3<f64>) -> f64 {
        let n = self.vector();
        let through = self
            .through
            .as_ref()
            .map_or_else(Vector3::zeros, |point| Vector3::from(point.each_ref().map(|x| x.value)));
        n.dot(&(p.coords - through)) / n.norm()
    }

    /// The point of the plane next to one in it up to rounding, and its coordinates: one follows from the others.
    pub(super) fn point(&self, p: &Point3<f64>) -> (Point3<f64>, Json) {
        let solved = (0..3).find(|i| (self.normal[*i].value - 1.0).abs() <= 0.0).unwrap_or(0);
        let mut terms = vec![];
        let mut at = *p;
        let through = |i: usize| self.through.as_ref().map(|point| &point[i]).filter(|x| x.value.abs() > 0.0);
        at[solved] = through(solved).map_or(0.0, |x| x.value);
        terms.extend(through(solved).map(|x| x.text.clone()));
        for i in (0..3).filter(|i| *i != solved && self.normal[*i].value.abs() > 0.0) {
            let (n, from) = (&self.normal[i], through(i));
            at[solved] -= n.value * (p[i] - from.map_or(0.0, |x| x.value));
            let own = match from {
                None => format!("({:?})", p[i]),
                Some(from) => format!("({:?} - ({}))", p[i], from.text),
            };
            terms.push(format!("- ({})*{own}", n.text));
        }
        let text = if terms.is_empty() { "0".to_owned() } else { terms.join(" ") };
        let mut written = json!(p.coords.as_slice());
        written[solved] = if self.axis().is_some() { json!(at[solved]) } else { json!(text) };
        (at, written)
    }
}

/// The symmetry of a body.
#[derive(Debug, Clone)]
pub(super) struct BodySymmetry {
    /// The axis along which all joints have one height, up to rounding, and that height.
    pub(super) level: Option<(usize, f64)>,
    /// The mirror planes: of two axes, which hold for single pairs of joints, or one of the whole body.
    pub(super) planes: Vec<BodyPlane>,
    /// Mirrors, then turns.
    pub(super) maps: [Vec<SymmetryMap>; 2],
    /// The axis is a symmetry axis of the whole body, by thirds.
    pub(super) is_three_fold: bool,
}

impl BodySymmetry {
    /// The axis perpendicular to the body; z for a body in space.
    pub(super) fn up(&self) -> usize {
        self.level.map_or(2, |(axis, _)| axis)
    }

    /// Whether all its planes and axes pass through the origin along axes of the frame.
    pub(super) fn is_about_axes(&self) -> bool {
        self.planes.len() == 2 && self.maps[1].iter().all(|turn| turn.centre.norm() <= 0.0)
    }

    /// The symmetry with each choice of a mirror plane of the whole body, the shortest in digits first.
    pub(super) fn choices(joints: &[Point3<f64>], near: &Closeness) -> Vec<Self> {
        let level = [2, 1, 0].into_iter().find_map(|axis| {
            let height = joints.first().map_or(0.0, |p| p[axis]);
            let height = if height.abs() <= near.distance { 0.0 } else { height };
            let is_level = joints.iter().all(|p| (p[axis] - height).abs() <= near.distance);
            is_level.then_some((axis, height))
        });
        let up = level.map_or(2, |(axis, _)| axis);
        let joints = distinct(joints, near.distance);
        let (turns, centre) = turns(&joints, up, near);
        let is_three_fold = turns.first().is_some_and(|turn| turn.keeps(&joints, near.distance));
        let planes: Vec<BodyPlane> = [(up + 2) % 3, (up + 1) % 3].map(BodyPlane::coordinate).into();
        let of_body = |plane: &BodyPlane| SymmetryMap::mirror(plane).keeps(&joints, near.distance);
        let is_about_axes = planes.iter().any(of_body);
        let mut others = general_planes(&joints, level.map(|(axis, _)| axis), centre.as_ref(), near);
        // beside a plane of the axes only the planes that thirds of a turn make of it are exact
        others.retain(|plane| !is_about_axes || (is_three_fold && plane.is_at_sixty()));
        let with = |more: Option<BodyPlane>| {
            let planes: Vec<BodyPlane> = planes.iter().cloned().chain(more).collect();
            let mirrors = planes.iter().map(SymmetryMap::mirror).collect();
            Self { level, planes, maps: [mirrors, turns.clone()], is_three_fold }
        };
        let plain = (is_about_axes || others.is_empty()).then(|| with(None));
        plain.into_iter().chain(others.into_iter().map(|plane| with(Some(plane)))).collect()
    }
}

fn distinct(joints: &[Point3<f64>], distance: f64) -> Vec<Point3<f64>> {
    let mut out: Vec<Point3<f64>> = Vec::new();
    for p in joints {
        if out.iter().all(|q| (p - q).norm() > distance) {
            out.push(*p);
        }
    }
    out
}

/// Thirds of a turn about the axis of the frame, which hold for single pairs of joints; or turns of the whole body
/// about a parallel axis through its centre, with that centre. A half turn is one of the whole body.
fn turns(
    joints: &[Point3<f64>],
    up: usize,
    near: &Closeness,
) -> (Vec<SymmetryMap>, Option<[ShortNumber; 3]>) {
    let mean = joints.iter().map(|p| p.coords).sum::<Vector3<f64>>() / joints.len().max(1) as f64;
    let centre = [0, 1, 2].map(|i| if i == up { ShortNumber::whole(0) } else { near.length(mean[i]) });
    let is_origin = centre.iter().all(|x| x.value.abs() <= 0.0);
    let keeps = |turn: &SymmetryMap| turn.keeps(joints, near.distance);
    let thirds = |centre| [120, 240].map(|degrees| SymmetryMap::turn(up, degrees, centre)).to_vec();
    let mut out = thirds(None);
    let origin = [0, 1, 2].map(|_| ShortNumber::whole(0));
    if keeps(&out[0]) || joints.len() < 3 {
        return (out, Some(origin));
    }
    if !is_origin {
        let own = thirds(Some(&centre));
        if keeps(&own[0]) {
            return (own, Some(centre));
        }
    }
    for (at, centre) in [(None, &origin), (Some(&centre), &centre)] {
        let half = SymmetryMap::turn(up, 180, at);
        if keeps(&half) {
            out.push(half);
            return (out, Some(centre.clone()));
        }
    }
    (out, None)
}

/// The mirror planes of the whole body, through the centre of its turns, the shortest normal in digits first.
fn general_planes(
    joints: &[Point3<f64>],
    level: Option<usize>,
    centre: Option<&[ShortNumber; 3]>,
    near: &Closeness,
) -> Vec<BodyPlane> {
    if joints.len() < 3 {
        return Vec::new();
    }
    let pairs = (0..joints.len()).flat_map(|i| (0..i).map(move |j| (j, i)));
    let plane = |(i, j): (usize, usize)| {
        let fitted = fitted_normal(joints, joints[i] - joints[j], near)?;
        let mut n = fitted.0;
        if let Some(axis) = level {
            n[axis] = 0.0;
        }
        let largest = (0..3).max_by(|a, b| n[*a].abs().total_cmp(&n[*b].abs()))?;
        n /= n[largest];
        let normal = [0, 1, 2].map(|k| if k == largest { ShortNumber::whole(1) } else { near.ratio(n[k]) });
        let through = if let Some(centre) = centre {
            centre.clone()
        } else {
            let offset: f64 = normal.iter().zip(fitted.1.iter()).map(|(n, x)| n.value * x).sum();
            let offset = near.length(offset);
            [0, 1, 2].map(|k| if k == largest { offset.clone() } else { ShortNumber::whole(0) })
        };
        let is_origin = through.iter().all(|x| x.value.abs() <= 0.0);
        let plane = BodyPlane { normal, through: (!is_origin).then_some(through) };
        SymmetryMap::mirror(&plane).keeps(joints, near.distance).then_some(plane)
    };
    let digits = |plane: &BodyPlane| plane.normal.iter().map(|n| n.text.len()).sum::<usize>();
    let mut found: Vec<BodyPlane> = pairs
        .filter_map(plane)
        .filter(|plane| plane.axis().is_none_or(|_| plane.through.is_some()))
        .collect();
    found.sort_by_key(digits);
    found.dedup_by(|a, b| (a.vector() - b.vector()).norm() <= near.distance / near.size);
    found
}

/// The normal and a point of the mirror plane near the bisector of two joints: the mean of all pairs of joints.
fn fitted_normal(
    joints: &[Point3<f64>],
    between: Vector3<f64>,
    near: &Closeness,
) -> Option<(Vector3<f64>, Vector3<f64>)> {
    let n = between.normalize();
    let middle = joints.iter().map(|p| p.coords).sum::<Vector3<f64>>() / joints.len() as f64;
    let (mut normal, mut point) = (Vector3::zeros(), Vector3::zeros());
    for p in joints {
        let image = p.coords - n * (2.0 * n.dot(&(p.coords - middle)));
        // the bisector of two joints is less precise than the mean of all
        let partner = joints.iter().find(|q| (q.coords - image).norm() <= 100.0 * near.distance)?;
        let way = p - partner;
        normal += way * n.dot(&way).signum();
        point += (p.coords + partner.coords) / (2.0 * joints.len() as f64);
    }
    let all_in_plane = joints.iter().all(|p| n.dot(&(p.coords - middle)).abs() <= near.distance);
    (!all_in_plane && normal.norm() > near.distance).then(|| (normal.normalize(), point))
}
