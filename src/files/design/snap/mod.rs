//! Symmetry of joints typed as rounded decimals: found, measured, and written as constructions.
//!
//! A hexapod with rounded cosines differs from the intended machine: it has additional poses far away. Joints are
//! compared with earlier ones of their body: equal place, mirror image, third of a turn, line of two joints. Bodies are
//! compared with circles and with each other. Agreement within a few millionths of the size counts as intended.

mod body;
mod maps;
mod number;
mod similar;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use serde_json::{Value as Json, json};

use self::body::{Seed, SnappedBody};
use self::maps::Closeness;
use self::similar::Similarity;
use super::{DesignModel, Format, parse_with_cranks};
use platform::manipulator::Body;

/// Differences below this, over the size of the design, count as rounding: machine coordinates are written to a
/// thousandth of a millimetre or better.
const TOLERANCE: f64 = 5e-6;
/// The same over the radius of the smaller body: bodies of very different sizes keep the shape of both.
const BODY_TOLERANCE: f64 = 1e-3;

/// The relation of a joint to earlier ones, to the axes, or to the other body.
#[derive(Debug, Clone, PartialEq)]
pub enum JointRelation {
    /// At the place of this joint.
    Same(String),
    /// The image of this joint under a map, which is described.
    Image(String, String),
    /// On the line of two joints.
    OnLine([String; 2]),
    /// On a circle about the centre of its body, with this radius, which the other body may share.
    OnCircle {
        /// The radius.
        radius: f64,
        /// Whether the circle of the other body has it too.
        shared: bool,
    },
    /// In a mirror plane of its body.
    InPlane,
    /// At the height of the first joint of the body.
    Level,
    /// The place of this joint of the base in a similar figure, which is described.
    Similar(String, String),
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

impl SnappedDesign {
    /// The greatest distance of a joint from its place in the symmetric design.
    #[must_use]
    pub fn off(&self) -> f64 {
        self.found.iter().map(|found| found.off).fold(0.0, f64::max)
    }

    /// A sentence for each kind of relation and each body, with the distance from it.
    #[must_use]
    pub fn sentences(&self, units: &str) -> Vec<String> {
        let mut out = Vec::new();
        for body in Body::BOTH {
            for kind in 0..JointRelation::KINDS {
                let of_kind = |found: &&FoundRelation| found.body == body && found.relation.kind() == kind;
                let list: Vec<&FoundRelation> = self.found.iter().filter(of_kind).collect();
                let off = list.iter().map(|found| found.off).fold(0.0, f64::max);
                let Some(first) = list.first().filter(|_| off > 0.0) else { continue };
                let others = if list.len() == 1 { "a joint" } else { "joints" };
                let mut joints: Vec<&str> = list.iter().map(|found| found.joint.as_str()).collect();
                joints.dedup();
                let mut images: Vec<&str> = list.iter().filter_map(|found| found.relation.words()).collect();
                images.sort_unstable();
                images.dedup();
                let place = match &first.relation {
                    JointRelation::Same(_) => {
                        format!("at the place{} of other joints", if list.len() == 1 { "" } else { "s" })
                    }
                    JointRelation::Image(..) => format!("other joints {}", images.join(" or ")),
                    JointRelation::OnLine(_) => "on lines of other joints".to_owned(),
                    JointRelation::OnCircle { radius, shared } => {
                        let shared = if *shared { ", as in the other body" } else { "" };
                        format!("on a circle of radius {radius}{shared}")
                    }
                    JointRelation::InPlane | JointRelation::Level => {
                        "in a mirror plane or at one height".to_owned()
                    }
                    JointRelation::Similar(..) => format!("{others} of the base {}", images.join(" or ")),
                };
                let verb = if joints.len() == 1 { "is" } else { "are" };
                out.push(format!(
                    "{body}: {} {verb} {place}, off by {off:.1e} {units} at most",
                    joints.join(", ")
                ));
            }
        }
        out
    }
}

impl JointRelation {
    const KINDS: u8 = 6;

    /// The place of its kind in the sentences.
    fn kind(&self) -> u8 {
        match self {
            Self::Same(_) => 0,
            Self::Image(..) => 1,
            Self::OnLine(_) => 2,
            Self::OnCircle { .. } => 3,
            Self::InPlane | Self::Level => 4,
            Self::Similar(..) => 5,
        }
    }

    /// The map, if it is an image.
    fn words(&self) -> Option<&str> {
        match self {
            Self::Image(_, words) | Self::Similar(_, words) => Some(words),
            _ => None,
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
        let size = self.manipulator().size();
        let radius = Body::BOTH.map(|body| self.manipulator().joints_radius(body));
        let distance = (TOLERANCE * size).min(BODY_TOLERANCE * radius[0].min(radius[1]));
        if distance <= 0.0 {
            return None;
        }
        let near = Closeness { distance, size };
        let mut bodies = Body::BOTH.map(|body| {
            let (joints, names) = (self.manipulator().joints(body), self.joint_names(body));
            SnappedBody::of(joints, names, &near)
        });
        let names = Body::BOTH.map(|body| self.joint_names(body));
        let similar = Similarity::between(&bodies, &near);
        let similar_off = similar.as_ref().map_or(0.0, |similar| similar.off);
        if similar_off <= 0.0 {
            bodies = body::on_circles(bodies, &near);
        }
        if let Some(similar) = similar.filter(|similar| similar.off > 0.0) {
            bodies[0].write_as_text();
            let base = self.with_bodies([Some(&bodies[0]), None])?;
            similar.apply(&mut bodies, &base.exact_joints(Body::Base), names[0]);
        }
        let mut found = Vec::new();
        for (body, snapped) in Body::BOTH.into_iter().zip(&bodies) {
            for (joint, name) in snapped.joints.iter().zip(names[body.index()]) {
                let relations = joint.relations.iter().cloned();
                found.extend(relations.map(|(relation, off)| FoundRelation {
                    body,
                    joint: name.clone(),
                    relation,
                    off,
                }));
            }
        }
        // a joint exactly in a plane, on a line or on a circle has not moved
        found.retain(|relation: &FoundRelation| {
            relation.off > 0.0
                || matches!(relation.relation, JointRelation::Same(_) | JointRelation::Image(..))
        });
        if found.iter().all(|relation| relation.off <= 0.0) {
            return None;
        }
        let mut design = self.with_bodies([Some(&bodies[0]), Some(&bodies[1])])?;
        design.workspace = self.workspace.clone();
        Some(SnappedDesign { found, design })
    }

    /// The design with other definitions of joints.
    fn with_bodies(&self, bodies: [Option<&SnappedBody>; 2]) -> Option<Self> {
        let mut keys = self.document();
        for (body, snapped) in Body::BOTH.into_iter().zip(bodies) {
            let Some(snapped) = snapped else { continue };
            let names = self.joint_names(body);
            let mut joints = serde_json::Map::new();
            let mut same = BTreeMap::new();
            for (name, joint) in names.iter().zip(&snapped.joints) {
                match &joint.seed {
                    Seed::Same(of) => {
                        same.insert(name.as_str(), names[*of].clone());
                    }
                    Seed::Own(written) | Seed::Derived(written) => {
                        joints.insert(name.clone(), written.clone());
                    }
                }
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
        let text = Json::Object(keys).to_string();
        parse_with_cranks(&text, Format::Json).ok().map(|(design, _)| design)
    }
}
