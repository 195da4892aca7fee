//! SDF, the format of Gazebo: links and joints with poses, with loops allowed.

use std::collections::BTreeMap;

use nalgebra::{Point3, Quaternion, Unit, UnitQuaternion, Vector3};
use roxmltree::Node;

use super::attributes::{at, elements, numbers};
use super::links::{LinkJoint, LinkJointKind, LinkedModel, ModelLink};
use platform::geom::{Angles, Pose};

/// The frame of the model itself.
const MODEL: [&str; 2] = ["__model__", ""];
/// From this version on axes are in the frame of the joint, earlier in that of the model.
const AXES_IN_JOINTS: f64 = 1.5;

/// A link, a joint or a frame with its pose as in the file.
struct PosedElement<'a, 'i> {
    node: Node<'a, 'i>,
    /// The frame of the pose; the empty name is that of the model.
    relative_to: &'a str,
    pose: Pose,
}

/// The model of a file.
struct ModelFrames<'a, 'i> {
    elements: BTreeMap<&'a str, PosedElement<'a, 'i>>,
}

fn child<'a, 'i>(node: Node<'a, 'i>, tag: &str) -> Option<Node<'a, 'i>> {
    elements(node).find(|n| n.tag_name().name() == tag)
}

fn text_of<'a>(node: Node<'a, '_>, tag: &str) -> Option<&'a str> {
    child(node, tag).and_then(|n| n.text()).map(str::trim)
}

/// The pose of an element `pose`: position and rotations about the fixed axes x, y, z, or a quaternion with the scalar
/// last.
fn pose(node: Node<'_, '_>) -> Result<Pose, String> {
    let text = node.text().unwrap_or_default();
    if text.trim().is_empty() {
        return Ok(Pose::identity());
    }
    let bad = || at(node, format!("`{}` is no pose", text.trim()));
    if node.attribute("rotation_format") == Some("quat_xyzw") {
        let [x, y, z, a, b, c, d] = numbers::<7>(text).ok_or_else(bad)?;
        let q = UnitQuaternion::try_new(Quaternion::new(d, a, b, c), 0.0).ok_or_else(bad)?;
        return Ok(Pose { rotation: q.to_rotation_matrix(), position: Vector3::new(x, y, z) });
    }
    let [x, y, z, roll, pitch, yaw] = numbers::<6>(text).ok_or_else(bad)?;
    let degrees = node.attribute("degrees").is_some_and(|d| d == "true" || d == "1");
    let read = if degrees { Angles::from_degrees } else { Angles::from_radians };
    Ok(Pose::new([x, y, z], read([roll, pitch, yaw])))
}

impl<'a, 'i> ModelFrames<'a, 'i> {
    fn of(model: Node<'a, 'i>) -> Result<Self, String> {
        let mut all = BTreeMap::new();
        for node in elements(model) {
            let default = match node.tag_name().name() {
                "link" => "",
                "joint" => text_of(node, "child").unwrap_or_default(),
                "frame" => node.attribute("attached_to").unwrap_or_default(),
                _ => continue,
            };
            let own = child(node, "pose");
            let said = own.and_then(|n| n.attribute("relative_to")).filter(|name| !name.is_empty());
            let posed = PosedElement {
                node,
                relative_to: said.unwrap_or(default),
                pose: own.map_or_else(|| Ok(Pose::identity()), pose)?,
            };
            let name = node.attribute("name").unwrap_or_default();
            if all.insert(name, posed).is_some() {
                return Err(at(node, format!("`{name}` is defined a second time")));
            }
        }
        Ok(Self { elements: all })
    }

    /// The pose of an element in the frame of the model.
    fn pose(&self, name: &str) -> Result<Pose, String> {
        let mut pose = Pose::identity();
        let mut name = name;
        for _ in 0..=self.elements.len() {
            if MODEL.contains(&name) {
                return Ok(pose);
            }
            let element =
                self.elements.get(name).ok_or_else(|| format!("`{name}` names nothing in the model"))?;
            pose = element.pose.compose(&pose);
            name = element.relative_to;
        }
        Err(format!("the pose of `{name}` is given by itself"))
    }

    /// The direction of an axis of a joint, model frame.
    fn axis(&self, joint: Node<'_, '_>, tag: &str, version: f64) -> Result<Unit<Vector3<f64>>, String> {
        let axis = child(joint, tag).ok_or_else(|| at(joint, format!("the joint has no `{tag}`")))?;
        let xyz = child(axis, "xyz");
        let direction = match xyz.and_then(|n| n.text()) {
            None => [0.0, 0.0, 1.0],
            Some(text) => {
                numbers::<3>(text).ok_or_else(|| at(axis, format!("`{}` is no axis", text.trim())))?
            }
        };
        let of_model = matches!(text_of(axis, "use_parent_model_frame"), Some("1" | "true"));
        let expressed = xyz.and_then(|n| n.attribute("expressed_in")).filter(|name| !name.is_empty());
        let frame = match expressed {
            Some(name) => self.pose(name)?,
            None if of_model || version < AXES_IN_JOINTS => Pose::identity(),
            None => self.pose(joint.attribute("name").unwrap_or_default())?,
        };
        Unit::try_new(frame.rotation * Vector3::from(direction), 0.0)
            .ok_or_else(|| at(axis, "axis has no direction"))
    }
}

/// The model with slides, among those in the file and in its worlds.
fn model_with_slides<'a, 'i>(root: Node<'a, 'i>) -> Result<Node<'a, 'i>, String> {
    let slides = |model: &Node<'_, '_>| {
        elements(*model).any(|n| n.tag_name().name() == "joint" && n.attribute("type") == Some("prismatic"))
    };
    let models: Vec<Node<'_, '_>> = root.descendants().filter(|n| n.tag_name().name() == "model").collect();
    let with: Vec<&Node<'_, '_>> = models.iter().filter(|model| slides(model)).collect();
    match with[..] {
        [model] => Ok(*model),
        [] => Err("no model of this file has prismatic joints, which legs are".into()),
        _ => Err(format!(
            "{} models of this file have prismatic joints: write one into a file of its own",
            with.len()
        )),
    }
}

/// Reads a model.
///
/// # Errors
/// A sentence with the line.
pub(super) fn read(root: Node<'_, '_>) -> Result<LinkedModel, String> {
    let version = root.attribute("version").and_then(|v| v.trim().parse().ok()).unwrap_or(AXES_IN_JOINTS);
    let model = model_with_slides(root)?;
    if let Some(node) = elements(model).find(|n| matches!(n.tag_name().name(), "include" | "model")) {
        let message =
            "models in models and included files are not read: write one model with all links and joints";
        return Err(at(node, message));
    }
    let frames = ModelFrames::of(model)?;
    let mut out = LinkedModel::default();
    let mut number = BTreeMap::new();
    for (name, element) in &frames.elements {
        if element.node.tag_name().name() == "link" {
            number.insert(*name, out.links.len());
            out.links.push(ModelLink { name: (*name).to_string(), at: frames.pose(name)? });
        }
    }
    let joints = elements(model).filter(|n| n.tag_name().name() == "joint");
    for node in joints {
        let name = node.attribute("name").unwrap_or_default();
        let link = |tag: &str| match text_of(node, tag) {
            Some("world") => Ok(None),
            Some(link) => match number.get(link) {
                Some(link) => Ok(Some(*link)),
                None => Err(at(node, format!("`{link}` names no link"))),
            },
            None => Err(at(node, format!("the joint names no {tag} link"))),
        };
        let links = [link("parent")?, link("child")?];
        let axis = |tag: &str| frames.axis(node, tag, version);
        let kind = match node.attribute("type").unwrap_or_default() {
            "fixed" => LinkJointKind::Fixed,
            "prismatic" => LinkJointKind::Slide,
            "ball" => LinkJointKind::Ball,
            "revolute" | "continuous" => LinkJointKind::Hinges(vec![axis("axis")?]),
            "universal" | "revolute2" => LinkJointKind::Hinges(vec![axis("axis")?, axis("axis2")?]),
            other => return Err(at(node, format!("joints of type `{other}` are not read"))),
        };
        let at = Point3::from(frames.pose(name)?.position);
        out.joints.push(LinkJoint { kind, name: name.to_string(), links, at });
    }
    Ok(out)
}
