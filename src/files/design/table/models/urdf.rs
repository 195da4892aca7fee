//! URDF, the format of ROS: a tree of links without closed loops.

use std::collections::BTreeMap;

use nalgebra::{Point3, Unit, Vector3};
use roxmltree::Node;

use super::attributes::{at, elements, numbers};
use super::links::{LinkJoint, LinkJointKind, LinkedModel, ModelLink};
use platform::geom::{Angles, Pose};

/// A joint in the frame of its parent.
struct TreeJoint<'a, 'i> {
    node: Node<'a, 'i>,
    parent: &'a str,
    child: &'a str,
    origin: Pose,
}

/// `xyz` and `rpy` of an element `origin` below a node: rotations about the fixed axes x, y, z.
fn origin(node: Node<'_, '_>) -> Result<Pose, String> {
    let Some(origin) = elements(node).find(|n| n.tag_name().name() == "origin") else {
        return Ok(Pose::identity());
    };
    let read = |name: &str| match origin.attribute(name) {
        None => Ok([0.0; 3]),
        Some(text) => {
            numbers::<3>(text).ok_or_else(|| at(origin, format!("{name}=\"{text}\" is not 3 numbers")))
        }
    };
    Ok(Pose::new(read("xyz")?, Angles::from_radians(read("rpy")?)))
}

/// The link in an element `parent` or `child` of a joint.
fn link_of<'a>(node: Node<'a, '_>, tag: &str) -> Result<&'a str, String> {
    let element = elements(node).find(|n| n.tag_name().name() == tag);
    element
        .and_then(|n| n.attribute("link"))
        .ok_or_else(|| at(node, format!("the joint names no {tag} link")))
}

/// Reads the tree.
///
/// # Errors
/// A sentence with the line.
pub(super) fn read(root: Node<'_, '_>) -> Result<LinkedModel, String> {
    if let Some(node) = root.descendants().find(|n| n.tag_name().namespace().is_some()) {
        let name = node.tag_name().name();
        return Err(at(node, format!("`{name}` is a macro: expand the file with `xacro FILE` first")));
    }
    let named = |tag: &'static str| elements(root).filter(move |n| n.tag_name().name() == tag);
    let name_of = |node: Node<'_, '_>| node.attribute("name").unwrap_or_default().to_string();
    let mut joints = Vec::new();
    for node in named("joint") {
        joints.push(TreeJoint {
            node,
            parent: link_of(node, "parent")?,
            child: link_of(node, "child")?,
            origin: origin(node)?,
        });
    }
    // other programs fix models to a link called world
    let is_world = |name: &str| name == "world";
    let mut frames: BTreeMap<&str, Pose> = BTreeMap::new();
    for node in named("link") {
        let name = node.attribute("name").unwrap_or_default();
        if joints.iter().filter(|j| j.child == name).count() > 1 {
            return Err(at(
                node,
                format!("link `{name}` is the child of two joints, which URDF does not allow"),
            ));
        }
        if !joints.iter().any(|j| j.child == name) {
            frames.insert(name, Pose::identity());
        }
    }
    let roots: Vec<&str> = frames.keys().copied().collect();
    // each round places the children of the links placed in the last one
    loop {
        let before = frames.len();
        for joint in &joints {
            if let Some(parent) = frames.get(joint.parent).copied() {
                frames.entry(joint.child).or_insert_with(|| parent.compose(&joint.origin));
            }
        }
        if frames.len() == before {
            break;
        }
    }
    let mut model = LinkedModel::default();
    let mut number: BTreeMap<String, usize> = BTreeMap::new();
    for node in named("link").filter(|n| !n.attribute("name").is_some_and(is_world)) {
        let name = name_of(node);
        let Some(frame) = frames.get(name.as_str()).copied() else {
            return Err(at(node, format!("link `{name}` is in a circle of joints")));
        };
        if number.insert(name.clone(), model.links.len()).is_some() {
            return Err(at(node, format!("link `{name}` is defined a second time")));
        }
        model.links.push(ModelLink { name, at: frame });
    }
    let mut floating = false;
    for TreeJoint { node, parent, child, origin } in &joints {
        let find = |name: &str| match number.get(name) {
            Some(link) => Ok(Some(*link)),
            None if is_world(name) => Ok(None),
            None => Err(at(*node, format!("`{name}` names no link"))),
        };
        let links = [find(parent)?, find(child)?];
        let frame = frames.get(parent).unwrap_or(&Pose::identity()).compose(origin);
        let kind = match node.attribute("type").unwrap_or_default() {
            "fixed" => LinkJointKind::Fixed,
            "prismatic" => LinkJointKind::Slide,
            "floating" => {
                floating = true;
                LinkJointKind::Ball
            }
            "revolute" | "continuous" => {
                let axis = elements(*node).find(|n| n.tag_name().name() == "axis");
                let axis = match axis.and_then(|n| n.attribute("xyz")) {
                    None => [1.0, 0.0, 0.0],
                    Some(text) => numbers::<3>(text)
                        .ok_or_else(|| at(*node, format!("xyz=\"{text}\" is not 3 numbers")))?,
                };
                let axis = Unit::try_new(frame.rotation * Vector3::from(axis), 0.0);
                LinkJointKind::Hinges(vec![axis.ok_or_else(|| at(*node, "axis has no direction"))?])
            }
            other => return Err(at(*node, format!("joints of type `{other}` are not read"))),
        };
        model.joints.push(LinkJoint { kind, name: name_of(*node), links, at: Point3::from(frame.position) });
    }
    if floating {
        model.guesses.push("Joints of type `floating` are taken as ball joints.".into());
    }
    // the tree hangs on its root, whatever its name
    let with_children: Vec<&&str> =
        roots.iter().filter(|root| joints.iter().any(|j| j.parent == **root) && !is_world(root)).collect();
    if let [root] = with_children[..] {
        let fixed = LinkJointKind::Fixed;
        let links = [None, number.get(*root).copied()];
        model.joints.push(LinkJoint { kind: fixed, name: String::new(), links, at: Point3::origin() });
    }
    Ok(model)
}
