//! Symmetry of joints typed as rounded decimals: found, measured, and written as constructions.
//!
//! A hexapod with rounded cosines differs from the intended machine: it has additional poses far away. Joints are
//! compared with earlier ones: equal place, mirrored in a plane of two axes, or rotated by a third of a turn about z.
//! They are also compared with planes of the axes. Agreement within a few millionths of the size counts as intended.

use std::collections::BTreeMap;

use nalgebra::{Point3, Vector3};
use serde_json::{Value as Json, json};

use super::{DesignModel, Format, parse_with_cranks};
use platform::manipulator::Body;

/// Differences below this, over the size of the design, count as rounding: machine coordinates are written to a
/// thousandth of a millimetre or better.
const TOLERANCE: f64 = 2e-6;

/// The relation of a joint to an earlier one, or to the axes.
#[derive(Debug, Clone, PartialEq)]
pub enum JointRelation {
    /// At the place of this joint.
    Same(String),
    /// This joint rotated about z, degrees.
    Turned(String, u16),
    /// This joint mirrored in a plane of two axes.
    Mirrored(String, &'static str),
    /// In a plane of two axes.
    InPlane(&'static str),
    /// At the height of the first joint of the body.
    Level,
}

/// A relation that joints of a body have up to rounding.
#[derive(Debug, Clone, PartialEq)]
pub struct FoundRelation {
    /// The body.
    pub body: Body,
    /// The joint.
    pub joint: String,
    /// The relation.
    pub relation: JointRelation,
    /// Distance of the joint from the related place, design units.
    pub off: f64,
}

/// A design with the symmetry that its joints have up to rounding.
#[derive(Debug, Clone, PartialEq)]
pub struct SnappedDesign {
    /// The relations, base first.
    pub found: Vec<FoundRelation>,
    /// The design with constructions for them.
    pub design: DesignModel,
}

/// A joint with its new definition.
struct Snapped {
    relation: Option<JointRelation>,
    /// Its place if it is written as numbers.
    at: Point3<f64>,
}

impl SnappedDesign {
    /// Up to three sentences for each body: coincident joints, joints related to others, joints in planes.
    #[must_use]
    pub fn sentences(&self, units: &str) -> Vec<String> {
        let mut out = Vec::new();
        for body in Body::BOTH {
            for kind in 0..3 {
                let of_kind = |found: &&FoundRelation| found.body == body && found.relation.kind() == kind;
                let list: Vec<&FoundRelation> = self.found.iter().filter(of_kind).collect();
                let off = list.iter().map(|found| found.off).fold(0.0, f64::max);
                if list.is_empty() || off.to_bits() == 0 {
                    continue;
                }
                let mut joints: Vec<&str> = list.iter().map(|found| found.joint.as_str()).collect();
                joints.dedup();
                let what = match kind {
                    0 => "at the places of others",
                    1 => "others mirrored in a plane of the axes or turned by a third about z",
                    _ => "in a plane of the axes or at one height",
                };
                let verb = if joints.len() == 1 { "is" } else { "are" };
                out.push(format!(
                    "{body}: {} {verb} {what}, off by {off:.1e} {units} at most",
                    joints.join(", ")
                ));
            }
        }
        out
    }
}

impl JointRelation {
    /// 0: equal places; 1: joints rotated or mirrored from another; 2: joints in a plane.
    fn kind(&self) -> u8 {
        match self {
            Self::Same(_) => 0,
            Self::Turned(..) | Self::Mirrored(..) => 1,
            Self::InPlane(_) | Self::Level => 2,
        }
    }
}

impl DesignModel {
    /// The design with the symmetry that its joints have up to rounding. `None` if only exact relations were found, or
    /// if joints are constructed already.
    ///
    /// ```
    /// # mod equipod { pub mod methods { pub use equipod_files::design; } }
    /// use equipod::methods::design::{HexapodSizes, PointTable};
    /// let (c, s) = (0.984_807_753_012, 0.173_648_177_667); // 10 degrees, to 12 digits
    /// let at = |r: f64, k: f64, sign: f64| {
    ///     let (turn, half) = ((120.0 * k).to_radians().sin_cos(), sign * s);
    ///     format!("{:.12},{:.12},0", r * (c * turn.1 - half * turn.0), r * (c * turn.0 + half * turn.1))
    /// };
    /// let rows: Vec<String> = (0..6).map(|i| {
    ///     let (a, b) = (f64::from(i / 2), (f64::from((i + 1) / 2) + 1.5) % 3.0);
    ///     let sign = if i % 2 == 0 { -1.0 } else { 1.0 };
    ///     format!("{},{}", at(500.0, a, sign), at(300.0, b, -sign))
    /// }).collect();
    /// let design = PointTable::read(rows.join("\n").as_bytes())?.design("typed", "mm")?;
    /// let snapped = design.snapped().ok_or("nothing found")?;
    /// assert!(snapped.found.iter().all(|f| f.off < 1e-8));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn snapped(&self) -> Option<SnappedDesign> {
        if self.constructions.any_joint() {
            return None;
        }
        let tolerance = TOLERANCE * self.manipulator().size();
        let mut found = Vec::new();
        let mut keys = self.document();
        for body in Body::BOTH {
            let names = self.joint_names(body).to_vec();
            let snapped = snapped_body(body, self.manipulator().joints(body), &names, tolerance, &mut found);
            let mut joints = serde_json::Map::new();
            let mut same = BTreeMap::new();
            for (name, joint) in names.iter().zip(&snapped) {
                let value = match &joint.relation {
                    Some(JointRelation::Same(of)) => {
                        same.insert(name.clone(), of.clone());
                        continue;
                    }
                    Some(JointRelation::Turned(of, degrees)) => json!({ "turn": of, "deg": degrees }),
                    Some(JointRelation::Mirrored(of, plane)) => json!({ "mirror": of, "plane": plane }),
                    _ => json!(joint.at.coords.as_slice()),
                };
                joints.insert(name.clone(), value);
            }
            keys.insert(body.to_string(), Json::Object(joints));
            if let Some(Json::Array(legs)) = keys.get_mut("legs") {
                for end in legs.iter_mut().filter_map(|leg| leg.get_mut(body.index())) {
                    if let Some(of) = end.as_str().and_then(|name| same.get(name)) {
                        *end = json!(of);
                    }
                }
            }
        }
        // a joint exactly in a plane has not moved
        found.retain(|relation: &FoundRelation| {
            relation.off > 0.0
                || !matches!(relation.relation, JointRelation::Level | JointRelation::InPlane(_))
        });
        if found.iter().all(|relation| relation.off.to_bits() == 0) {
            return None;
        }
        let text = Json::Object(keys).to_string();
        let (mut design, _) = parse_with_cranks(&text, Format::Json).ok()?;
        design.workspace = self.workspace.clone();
        Some(SnappedDesign { found, design })
    }
}

/// The new definitions of the joints of a body, in order.
fn snapped_body(
    body: Body,
    joints: &[Point3<f64>],
    names: &[String],
    tolerance: f64,
    found: &mut Vec<FoundRelation>,
) -> Vec<Snapped> {
    let mut out: Vec<Snapped> = Vec::new();
    let height = joints.first().map_or(0.0, |p| if p.z.abs() <= tolerance { 0.0 } else { p.z });
    let level = joints.iter().all(|p| (p.z - height).abs() <= tolerance);
    for (j, p) in joints.iter().enumerate() {
        // relations to earlier joints, the simplest first; of one kind the nearest
        let mut relation: Option<(JointRelation, f64, Point3<f64>)> = None;
        for kind in 0..3 {
            let candidates = (0..j).filter(|i| !matches!(out[*i].relation, Some(JointRelation::Same(_))));
            let related = candidates.flat_map(|i| images(kind, &out[i].at, &names[i]));
            let near = related
                .map(|(relation, image)| (relation, (image - p).norm(), image))
                .filter(|(_, off, _)| *off <= tolerance)
                .min_by(|x, y| x.1.total_cmp(&y.1));
            if near.is_some() {
                relation = near;
                break;
            }
        }
        let mut note = |relation: JointRelation, off: f64| {
            found.push(FoundRelation { body, joint: names[j].clone(), relation, off });
        };
        if let Some((relation, off, image)) = relation {
            note(relation.clone(), off);
            out.push(Snapped { relation: Some(relation), at: image });
            continue;
        }
        let mut at = *p;
        for (axis, plane) in [(0, "yz"), (1, "xz")] {
            if at[axis].abs() <= tolerance {
                note(JointRelation::InPlane(plane), at[axis].abs());
                at[axis] = 0.0;
            }
        }
        if level {
            note(JointRelation::Level, (at.z - height).abs());
            at.z = height;
        }
        out.push(Snapped { relation: None, at });
    }
    out
}

/// Places of a joint that has a relation of this kind to a joint at `p`.
fn images(kind: u8, p: &Point3<f64>, of: &str) -> Vec<(JointRelation, Point3<f64>)> {
    let mirrored = |x: f64, y: f64, plane| {
        (
            JointRelation::Mirrored(of.to_owned(), plane),
            Point3::from(p.coords.component_mul(&Vector3::new(x, y, 1.0))),
        )
    };
    let turned = |degrees: u16| {
        let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
        let image = Point3::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y, p.z);
        (JointRelation::Turned(of.to_owned(), degrees), image)
    };
    match kind {
        0 => vec![(JointRelation::Same(of.to_owned()), *p)],
        1 => vec![mirrored(1.0, -1.0, "xz"), mirrored(-1.0, 1.0, "yz")],
        _ => vec![turned(120), turned(240)],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::PointTable;

    fn design(text: &str) -> DesignModel {
        PointTable::read(text.as_bytes()).unwrap().design("typed", "mm").unwrap()
    }

    /// Rows of two rings with these decimals.
    fn rings(decimals: usize, turn: f64) -> String {
        let at = |r: f64, degrees: f64| {
            let (s, c) = (degrees + turn).to_radians().sin_cos();
            format!("{:.decimals$},{:.decimals$},0", r * c, r * s)
        };
        let (base, platform) = ([-10., 10., 110., 130., 230., 250.], [-50., 50., 70., 170., 190., 290.]);
        let rows = base.iter().zip(platform).map(|(a, b)| format!("{},{}", at(500.0, *a), at(300.0, b)));
        rows.collect::<Vec<_>>().join("\n")
    }

    #[test]
    fn rings_typed_as_decimals_become_one_pair_and_its_turns() {
        for (decimals, off) in [(12, 1e-11), (6, 2e-6), (3, 2e-3)] {
            let snapped = design(&rings(decimals, 0.0)).snapped().unwrap();
            assert!(snapped.found.iter().all(|f| f.off <= off), "{:?}", snapped.found);
            // one joint of each body keeps its numbers
            let text = snapped.design.to_toml();
            assert_eq!(text.matches("mirror").count() + text.matches("turn").count(), 10, "{text}");
            assert_eq!(
                snapped.design.manipulator().joint_knowledge(),
                platform::manipulator::JointKnowledge::Exact,
                "{text}"
            );
        }
        // without a mirror plane through the axes only the rotations are found
        let turned = design(&rings(12, 7.0)).snapped().unwrap();
        let text = turned.design.to_toml();
        assert_eq!((text.matches("mirror").count(), text.matches("turn").count()), (0, 8), "{text}");
    }

    #[test]
    fn ends_that_are_apart_by_noise_are_one_joint() {
        let noise = "-0.000001,150,-0.000001,77.942286,45,0.000001\n0.000001,150,0.000001,-77.942286,45,0.000001\n-129.903810,-75,-0.000001,-77.942286,44.999999,-0.000001\n-129.903812,-75,-0.000001,0,-89.999999,0\n129.903812,-75,0,0.000001,-90,0\n129.903810,-75.000001,0,77.942285,45,0\n";
        let snapped = design(noise).snapped().unwrap();
        let m = snapped.design.manipulator();
        assert_eq!((m.base_joints().len(), m.platform_joints().len()), (3, 3));
        assert!(
            snapped.sentences("mm").iter().any(|s| s.starts_with("base: ")),
            "{:?}",
            snapped.sentences("mm")
        );
    }

    #[test]
    fn nothing_is_found_where_nothing_is() {
        let mut rng = num::Rng::new(4);
        let rows: Vec<String> = (0..6)
            .map(|_| (0..6).map(|_| rng.uniform(-1.0, 1.0).to_string()).collect::<Vec<_>>().join(","))
            .collect();
        assert_eq!(design(&rows.join("\n")).snapped(), None);
        // a thousandth off is another machine
        let off = rings(12, 0.0).replacen("492.403876506104", "492.9", 1);
        let snapped = design(&off).snapped().unwrap();
        assert!(snapped.design.to_toml().contains("492.9"));
        // exact relations are left unchanged
        let exact = snapped.design.snapped();
        assert_eq!(exact, None);
    }
}
