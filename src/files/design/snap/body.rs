//! The joints of a body, each as a copy of an earlier one where it is one.

use nalgebra::Point3;
use serde_json::{Value as Json, json};

use super::JointRelation;
use super::maps::{BodySymmetry, Closeness};
use super::number::ShortNumber;
use num::surd::Surd;

/// Two joints through which a line is laid are apart by this share of the size.
const LINE_BASE: f64 = 0.05;

/// The new definition of a joint.
#[derive(Debug, Clone)]
pub(super) enum Seed {
    /// It is another joint, by its index.
    Same(usize),
    /// Its own numbers.
    Own(Json),
    /// A construction from other joints.
    Derived(Json),
}

/// A joint with its relations.
#[derive(Debug, Clone)]
pub(super) struct SnappedJoint {
    pub(super) seed: Seed,
    pub(super) at: Point3<f64>,
    /// The relations, each with the distance that the joint moves.
    pub(super) relations: Vec<(JointRelation, f64)>,
}

/// The joints of a body.
#[derive(Debug, Clone)]
pub(super) struct SnappedBody {
    pub(super) joints: Vec<SnappedJoint>,
    pub(super) symmetry: BodySymmetry,
}

impl SnappedBody {
    /// The body with the symmetry that leaves the fewest joints with their own numbers.
    pub(super) fn of(joints: &[Point3<f64>], names: &[String], near: &Closeness) -> Self {
        let choices = BodySymmetry::choices(joints, near);
        let bodies = choices.into_iter().map(|symmetry| Self::with(joints, names, symmetry, near));
        let own = |body: &Self| body.joints.iter().filter(|joint| matches!(joint.seed, Seed::Own(_))).count();
        bodies.min_by_key(own).unwrap_or(Self {
            joints: Vec::new(),
            symmetry: BodySymmetry {
                level: None,
                planes: Vec::new(),
                maps: [Vec::new(), Vec::new()],
                is_three_fold: false,
            },
        })
    }

    fn with(joints: &[Point3<f64>], names: &[String], symmetry: BodySymmetry, near: &Closeness) -> Self {
        let mut body = Self { joints: Vec::new(), symmetry };
        for p in joints {
            let own = body.copy(p, names, near).unwrap_or_else(|| body.seed(p, names, near));
            body.joints.push(own);
        }
        body
    }

    /// The joints with places of their own, by index.
    pub(super) fn distinct(&self) -> impl Iterator<Item = (usize, &SnappedJoint)> {
        self.joints.iter().enumerate().filter(|(_, joint)| !matches!(joint.seed, Seed::Same(_)))
    }

    /// A copy of an earlier joint: the simplest kind, and of one kind the nearest.
    fn copy(&self, p: &Point3<f64>, names: &[String], near: &Closeness) -> Option<SnappedJoint> {
        let at_distance = |image: Point3<f64>| (image - p).norm();
        let same = self.distinct().map(|(i, joint)| (at_distance(joint.at), i));
        let same = same.min_by(|x, y| x.0.total_cmp(&y.0)).filter(|(off, _)| *off <= near.distance);
        if let Some((off, i)) = same {
            let relations = vec![(JointRelation::Same(names[i].clone()), off)];
            return Some(SnappedJoint { seed: Seed::Same(i), at: self.joints[i].at, relations });
        }
        self.symmetry.maps.iter().find_map(|maps| {
            let images = self
                .distinct()
                .flat_map(|(i, joint)| maps.iter().map(move |map| (i, map, map.image(&joint.at))));
            let (i, map, at) = images.min_by(|x, y| at_distance(x.2).total_cmp(&at_distance(y.2)))?;
            let off = at_distance(at);
            let relation = JointRelation::Image(names[i].clone(), map.words.clone());
            (off <= near.distance).then(|| SnappedJoint {
                seed: Seed::Derived(map.written(&names[i])),
                at,
                relations: vec![(relation, off)],
            })
        })
    }

    /// A joint with its own numbers, or on a line of two others.
    fn seed(&self, p: &Point3<f64>, names: &[String], near: &Closeness) -> SnappedJoint {
        let mut at = *p;
        let mut relations = Vec::new();
        let mut written = None;
        for plane in &self.symmetry.planes {
            let off = plane.distance(&at).abs();
            if off <= near.distance {
                let (point, own) = plane.point(&at);
                at = point;
                written = Some(own);
                relations.push((JointRelation::InPlane, off));
            }
        }
        if let Some((axis, height)) = self.symmetry.level {
            relations.push((JointRelation::Level, (at[axis] - height).abs()));
            at[axis] = height;
            if let Some(written) = &mut written {
                written[axis] = json!(height);
            }
        }
        if written.is_none()
            && let Some(joint) = self.on_line(&at, names, near, &relations)
        {
            return joint;
        }
        let written = written.unwrap_or_else(|| json!(at.coords.as_slice()));
        SnappedJoint { seed: Seed::Own(written), at, relations }
    }

    /// The joint on the line of two earlier ones, if it is near one; coordinates that both share need no construction.
    fn on_line(
        &self,
        p: &Point3<f64>,
        names: &[String],
        near: &Closeness,
        before: &[(JointRelation, f64)],
    ) -> Option<SnappedJoint> {
        let pairs = self
            .distinct()
            .flat_map(|(i, a)| self.distinct().take_while(move |(j, _)| *j < i).map(move |b| (b, (i, a))));
        let mut best: Option<SnappedJoint> = None;
        for ((i, a), (j, b)) in pairs {
            let way = b.at - a.at;
            if way.norm() < LINE_BASE * near.size {
                continue;
            }
            let share = near.ratio((p - a.at).dot(&way) / way.norm_squared());
            let mut at = a.at + way * share.value;
            let shared = |k: &usize| way[*k].abs() <= 0.0;
            let parallel = (0..3).filter(shared).count() == 2;
            if parallel {
                at = *p;
                (0..3).filter(shared).for_each(|k| at[k] = a.at[k]);
            }
            let off = (at - p).norm();
            let before_off =
                best.as_ref().map_or(f64::INFINITY, |own| own.relations.last().map_or(0.0, |r| r.1));
            if off > near.distance || off >= before_off {
                continue;
            }
            let seed = if parallel {
                Seed::Own(json!(at.coords.as_slice()))
            } else {
                Seed::Derived(json!({ "on": [names[i], names[j]], "t": share.json() }))
            };
            let relation = JointRelation::OnLine([names[i].clone(), names[j].clone()]);
            let relations = before.iter().cloned().chain([(relation, off)]).collect();
            best = Some(SnappedJoint { seed, at, relations });
        }
        best
    }

    /// Coordinates as texts, so that decimals are exact and not the nearest doubles.
    pub(super) fn write_as_text(&mut self) {
        for joint in &mut self.joints {
            if let Seed::Own(Json::Array(list)) = &mut joint.seed
                && let Some(first) = list.first_mut().filter(|first| first.is_number())
            {
                *first = json!(ShortNumber::decimal(joint.at.x).text);
            }
        }
    }

    /// The radius of the circle of all its joints about the axis, and whether any of them has numbers of its own.
    fn radius(&self, near: &Closeness) -> Option<(f64, usize)> {
        self.symmetry.level?;
        let list: Vec<f64> = self.distinct().map(|(_, joint)| self.polar(&joint.at).0).collect();
        let mean = list.iter().sum::<f64>() / list.len().max(1) as f64;
        let own = self.distinct().filter(|(_, joint)| matches!(joint.seed, Seed::Own(_))).count();
        (list.len() > 3 && list.iter().all(|r| (r - mean).abs() <= near.distance)).then_some((mean, own))
    }

    fn polar(&self, p: &Point3<f64>) -> (f64, f64) {
        let up = self.symmetry.up();
        let (u, v) = (p[(up + 1) % 3], p[(up + 2) % 3]);
        (u.hypot(v), v.atan2(u))
    }

    /// Joints with their own numbers, on the circle.
    fn put_on_circle(&mut self, radius: &ShortNumber, shared: bool, near: &Closeness) {
        let Some((up, height)) = self.symmetry.level else { return };
        let angles: Vec<f64> = self.joints.iter().map(|joint| self.polar(&joint.at).1).collect();
        for (joint, angle) in self.joints.iter_mut().zip(angles) {
            if !matches!(joint.seed, Seed::Own(_)) {
                continue;
            }
            let (written, [u, v]) = on_circle(radius, angle, up, height, near);
            let mut at = joint.at;
            (at[(up + 1) % 3], at[(up + 2) % 3]) = (u, v);
            let off = (at - joint.at).norm();
            joint.relations.push((JointRelation::OnCircle { radius: radius.value, shared }, off));
            (joint.seed, joint.at) = (Seed::Own(written), at);
        }
    }
}

/// A point of a circle: by its angle where the cosine is exact, otherwise by the tangent of half its angle, so that its
/// coordinates are fractions.
fn on_circle(radius: &ShortNumber, angle: f64, up: usize, height: f64, near: &Closeness) -> (Json, [f64; 2]) {
    let r = radius.value;
    let degrees = ShortNumber::near(angle.to_degrees(), (near.distance / r / 4.0).to_degrees());
    let is_exact = degrees.text.len() < 8
        && num::exact::rational(degrees.value).is_some_and(|d| Surd::turn(&d).is_some());
    if is_exact && up == 2 {
        let (s, c) = degrees.value.to_radians().sin_cos();
        return (json!({ "radius": r, "angle_deg": degrees.value, "z": height }), [r * c, r * s]);
    }
    // about the nearer end of the diameter the tangent is at most 1
    let (sign, t) =
        if angle.cos() >= 0.0 { ("", (angle / 2.0).tan()) } else { ("-", (angle / 2.0).tan().recip()) };
    let t = ShortNumber::near(if sign.is_empty() { t } else { -t }, near.distance / r / 8.0);
    let cosine = format!("(1 - ({t})^2)/(1 + ({t})^2)", t = t.text);
    let sine = format!("2*({t})/(1 + ({t})^2)", t = t.text);
    let mut written = json!([height, height, height]);
    written[(up + 1) % 3] = json!(format!("{sign}{}*{cosine}", radius.text));
    written[(up + 2) % 3] = json!(format!("{sign}{}*{sine}", radius.text));
    let (w, side) = (1.0 + t.value * t.value, if sign.is_empty() { r } else { -r });
    (written, [side * (1.0 - t.value * t.value) / w, side * 2.0 * t.value / w])
}

/// Bodies whose joints are on circles about their axes: with equal radii, or with several joints that no symmetry
/// relates.
pub(super) fn on_circles(mut bodies: [SnappedBody; 2], near: &Closeness) -> [SnappedBody; 2] {
    let radii = bodies.each_ref().map(|body| body.radius(near));
    let shared = matches!(radii, [Some((a, _)), Some((b, _))] if (a - b).abs() <= near.distance);
    for (body, radius) in bodies.iter_mut().zip(radii) {
        // joints in a plane of their own have one coordinate from another already
        let Some((radius, own)) = radius.filter(|_| body.symmetry.planes.len() <= 2) else { continue };
        if own > 1 || shared {
            let own = if shared { radii[0].map_or(radius, |(first, _)| first) } else { radius };
            body.put_on_circle(&near.length(own), shared, near);
        }
    }
    bodies
}
