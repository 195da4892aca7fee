//! A platform that is a similar figure of its base: enlarged, turned about the axis, mirrored or shifted.

use nalgebra::{Complex, Point3};
use serde_json::{Value as Json, json};

use super::JointRelation;
use super::body::{Seed, SnappedBody};
use super::maps::Closeness;
use super::number::ShortNumber;
use crate::design::ExactJoint;

/// The similarity from the base to the platform.
pub(super) struct Similarity {
    up: usize,
    is_mirrored: bool,
    /// The factor and turn of the plane perpendicular to the axis.
    factor: PlaneFactor,
    shift: [ShortNumber; 3],
    /// The base joint of each platform joint with a place of its own.
    partners: Vec<(usize, usize)>,
    /// The greatest distance of a platform joint from its place.
    pub(super) off: f64,
}

/// A factor of complex numbers as it is written.
enum PlaneFactor {
    /// A scale and whole degrees, a multiple of 15.
    Turned(ShortNumber, i32),
    /// Scale times cosine and sine.
    Any(ShortNumber, ShortNumber),
}

impl PlaneFactor {
    /// Factors near a measured one, the simplest first: joints tell whether one is near enough.
    fn near(m: Complex<f64>, near: &Closeness) -> Vec<Self> {
        let (scale, angle) = m.to_polar();
        let fifteen = (angle.to_degrees() / 15.0).round() * 15.0;
        let degrees = (fifteen as i32).rem_euclid(360);
        let ratio = near.distance / near.size;
        let turned = [4.0, 1.0, 0.25].into_iter().filter_map(|share| {
            let scale = ShortNumber::near(scale, ratio * share);
            let own = Complex::from_polar(scale.value, fifteen.to_radians());
            ((own - m).norm() <= 8.0 * ratio).then_some(Self::Turned(scale, degrees))
        });
        turned.chain([Self::Any(near.ratio(m.re), near.ratio(m.im))]).collect()
    }

    fn value(&self) -> Complex<f64> {
        match self {
            Self::Turned(scale, degrees) => {
                Complex::from_polar(scale.value, f64::from(*degrees).to_radians())
            }
            Self::Any(c, s) => Complex::new(c.value, s.value),
        }
    }

    /// Fewer characters are simpler.
    fn length(&self) -> (usize, u64) {
        match self {
            Self::Turned(scale, degrees) => (scale.text.len(), degrees.unsigned_abs().into()),
            Self::Any(c, s) => (c.text.len() + s.text.len(), 0),
        }
    }

    /// The two coordinates of the product with texts of a point.
    fn times(&self, u: &str, v: &str) -> [String; 2] {
        match self {
            Self::Turned(scale, degrees) => {
                let sum = |(a, x): (String, &str), (b, y): (String, &str)| match (x, y) {
                    ("0", _) => format!("{}*({b}*({y}))", scale.text),
                    (_, "0") => format!("{}*({a}*({x}))", scale.text),
                    _ => format!("{}*({a}*({x}) + {b}*({y}))", scale.text),
                };
                match degrees {
                    0 => [format!("{}*({u})", scale.text), format!("{}*({v})", scale.text)],
                    90 => [format!("-{}*({v})", scale.text), format!("{}*({u})", scale.text)],
                    180 => [format!("-{}*({u})", scale.text), format!("-{}*({v})", scale.text)],
                    270 => [format!("{}*({v})", scale.text), format!("-{}*({u})", scale.text)],
                    _ => {
                        let (c, s) = (format!("cos_deg({degrees})"), format!("sin_deg({degrees})"));
                        [sum((c.clone(), u), (format!("-{s}"), v)), sum((s, u), (c, v))]
                    }
                }
            }
            Self::Any(c, s) => {
                let (c, s) = (&c.text, &s.text);
                [format!("({c})*({u}) - ({s})*({v})"), format!("({s})*({u}) + ({c})*({v})")]
            }
        }
    }

    fn scale(&self) -> String {
        match self {
            Self::Turned(scale, _) => scale.text.clone(),
            Self::Any(c, s) => format!("sqrt(({})^2 + ({})^2)", c.text, s.text),
        }
    }
}

impl Similarity {
    /// The simplest similarity that carries the joints of the base into those of the platform.
    ///
    /// Bodies that one joint and thirds of a turn give are always similar, and triangles too; this says nothing then.
    pub(super) fn between(bodies: &[SnappedBody; 2], near: &Closeness) -> Option<Self> {
        let up = bodies[0].symmetry.up();
        let [base, platform] =
            bodies.each_ref().map(|body| body.distinct().map(|(i, joint)| (i, joint.at)).collect::<Vec<_>>());
        if base.len() != platform.len() || base.len() < 4 || bodies[1].symmetry.up() != up {
            return None;
        }
        let plane = |p: &Point3<f64>| Complex::new(p[(up + 1) % 3], p[(up + 2) % 3]);
        let first = base.first()?;
        let last = base.iter().max_by(|x, y| {
            let from = |p: &Point3<f64>| (plane(p) - plane(&first.1)).norm();
            from(&x.1).total_cmp(&from(&y.1))
        })?;
        let is_level = bodies.iter().all(|body| body.symmetry.level.is_some());
        let mut best: Option<Self> = None;
        for is_mirrored in [false, true] {
            let own = |p: &Point3<f64>| if is_mirrored { plane(p).conj() } else { plane(p) };
            let way = own(&last.1) - own(&first.1);
            if way.norm() <= near.distance {
                return None;
            }
            for (p, q) in platform.iter().flat_map(|p| platform.iter().map(move |q| (p, q))) {
                let factor = (plane(&q.1) - plane(&p.1)) / way;
                if factor.norm() <= near.distance / near.size {
                    continue;
                }
                for factor in PlaneFactor::near(factor, near) {
                    // the scale of heights has to be exact too
                    if !is_level && matches!(factor, PlaneFactor::Any(..)) {
                        continue;
                    }
                    let m = factor.value();
                    let shift = plane(&p.1) - m * own(&first.1);
                    let along = if is_level { 0.0 } else { p.1[up] - m.norm() * first.1[up] };
                    let mut shifts = [0, 1, 2].map(|_| ShortNumber::whole(0));
                    for (k, x) in [((up + 1) % 3, shift.re), ((up + 2) % 3, shift.im), (up, along)] {
                        shifts[k] = near.length(x);
                    }
                    let image = |b: &Point3<f64>| {
                        let planar = m * own(b);
                        let mut at = *b;
                        at[(up + 1) % 3] = planar.re + shifts[(up + 1) % 3].value;
                        at[(up + 2) % 3] = planar.im + shifts[(up + 2) % 3].value;
                        at[up] = if is_level { p.1[up] } else { m.norm() * b[up] + shifts[up].value };
                        at
                    };
                    let images: Vec<(usize, Point3<f64>)> =
                        base.iter().map(|(i, b)| (*i, image(b))).collect();
                    let partner = |q: &Point3<f64>| {
                        let near_to = |(i, at): &(usize, Point3<f64>)| ((at - q).norm(), *i);
                        images.iter().map(near_to).min_by(|x, y| x.0.total_cmp(&y.0))
                    };
                    let partners: Vec<(usize, f64, usize)> = platform
                        .iter()
                        .filter_map(|(j, q)| partner(q).map(|(off, i)| (*j, off, i)))
                        .collect();
                    let off = partners.iter().map(|partner| partner.1).fold(0.0, f64::max);
                    if off > near.distance {
                        continue;
                    }
                    let found = Self {
                        up,
                        is_mirrored,
                        factor,
                        shift: shifts,
                        partners: partners.into_iter().map(|(j, _, i)| (j, i)).collect(),
                        off,
                    };
                    if best.as_ref().is_none_or(|best| found.effort(bodies) < best.effort(bodies)) {
                        best = Some(found);
                    }
                    break;
                }
            }
        }
        best
    }

    /// The length of its text: joints with their own numbers come from such joints where they can.
    fn effort(&self, bodies: &[SnappedBody; 2]) -> (bool, usize, bool, (usize, u64)) {
        let has_numbers = |k: usize, joint: usize| matches!(bodies[k].joints[joint].seed, Seed::Own(_));
        let foreign = self.partners.iter().filter(|(j, i)| has_numbers(1, *j) && !has_numbers(0, *i));
        let is_any = matches!(self.factor, PlaneFactor::Any(..));
        (is_any, foreign.count(), self.is_mirrored, self.factor.length())
    }

    fn words(&self) -> String {
        let mut words = match &self.factor {
            PlaneFactor::Turned(scale, 0) => format!("times {}", scale.text),
            PlaneFactor::Turned(scale, degrees) => {
                format!("times {}, turned by {degrees} degrees", scale.text)
            }
            PlaneFactor::Any(c, s) => {
                let (scale, angle) = Complex::new(c.value, s.value).to_polar();
                format!("times {scale:.6}, turned by {:.4} degrees", angle.to_degrees())
            }
        };
        if self.is_mirrored {
            words.push_str(" and mirrored");
        }
        if self.shift.iter().any(|x| x.value.abs() > 0.0) {
            words.push_str(" and shifted");
        }
        words
    }

    /// Whether mirrors in planes of the axes and turns about them are the same for both bodies.
    fn keeps_maps(&self, base: &SnappedBody) -> bool {
        let PlaneFactor::Turned(_, degrees) = self.factor else { return false };
        let step = if base.symmetry.is_three_fold { 60 } else { 180 };
        let is_central = self.shift.iter().all(|x| x.value.abs() <= 0.0);
        degrees % step == 0 && is_central && base.symmetry.is_about_axes()
    }

    /// Writes the platform joints from those of the base. Symmetry maps of the platform stay if the similarity keeps
    /// them exactly.
    pub(super) fn apply(&self, bodies: &mut [SnappedBody; 2], exact: &[ExactJoint], names: &[String]) {
        let up = self.up;
        let (i, j) = ((up + 1) % 3, (up + 2) % 3);
        let m = self.factor.value();
        let keeps_maps = self.keeps_maps(&bodies[0]);
        // exact joints are those with places of their own
        let mut place = 0;
        let texts: Vec<[String; 3]> = bodies[0]
            .joints
            .iter()
            .map(|joint| match (&joint.seed, exact.get(place)) {
                (Seed::Same(_), _) | (_, None) => Default::default(),
                (seed, Some(own)) => {
                    place += 1;
                    match seed {
                        Seed::Own(Json::Array(list)) => [0, 1, 2].map(|k| text(&list[k])),
                        _ => own.coordinates.clone(),
                    }
                }
            })
            .collect();
        let [base, platform] = bodies;
        for (joint, partner) in &self.partners {
            let own = &mut platform.joints[*joint];
            let is_image =
                own.relations.iter().any(|(relation, _)| matches!(relation, JointRelation::Image(..)));
            if keeps_maps && is_image {
                continue;
            }
            let from = &base.joints[*partner].at;
            let written = &texts[*partner];
            let v = if !self.is_mirrored || written[j] == "0" {
                written[j].clone()
            } else {
                format!("-({})", written[j])
            };
            let [u_text, v_text] = self.factor.times(&written[i], &v);
            let planar = m * Complex::new(from[i], if self.is_mirrored { -from[j] } else { from[j] });
            let mut at = own.at;
            (at[i], at[j]) = (planar.re + self.shift[i].value, planar.im + self.shift[j].value);
            let mut list = [const { Json::Null }; 3];
            list[i] = json!(shifted(u_text, &self.shift[i]));
            list[j] = json!(shifted(v_text, &self.shift[j]));
            list[up] = if let Some((_, height)) = platform.symmetry.level {
                json!(height)
            } else {
                at[up] = m.norm() * from[up] + self.shift[up].value;
                json!(shifted(format!("{}*({})", self.factor.scale(), written[up]), &self.shift[up]))
            };
            let off = (at - own.at).norm();
            own.relations.push((JointRelation::Similar(names[*partner].clone(), self.words()), off));
            (own.seed, own.at) = (Seed::Own(Json::Array(list.into())), at);
        }
    }
}

fn shifted(text: String, by: &ShortNumber) -> String {
    if by.value.abs() <= 0.0 { text } else { format!("{text} + ({})", by.text) }
}

fn text(coordinate: &Json) -> String {
    match coordinate {
        Json::String(text) => text.clone(),
        number => ShortNumber::decimal(number.as_f64().unwrap_or(0.0)).text,
    }
}
