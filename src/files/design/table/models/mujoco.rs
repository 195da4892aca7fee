//! Models of `MuJoCo`: nested bodies, sites, and loops closed by `equality`.

use std::collections::BTreeMap;

use nalgebra::{Point3, Unit, Vector3};
use roxmltree::Node;

use super::attributes::{Settings, at, elements};
use super::graph::{JointKind, Mechanism, ModelJoint, PlacedBody, Tendon, WORLD};
use platform::geom::Pose;

/// A joint of a body in its frame.
struct OwnJoint {
    /// `None`: a free joint.
    kind: Option<JointKind>,
    name: String,
    point: Point3<f64>,
    axis: Option<Unit<Vector3<f64>>>,
}

/// Elements that stand for other files or many elements, and are not read.
const NOT_READ: [&str; 5] = ["include", "replicate", "composite", "flexcomp", "attach"];

impl Mechanism {
    /// Reads a model of `MuJoCo`.
    ///
    /// # Errors
    /// A sentence with the line.
    pub(super) fn of_mujoco(root: Node<'_, '_>) -> Result<Self, String> {
        if let Some(node) =
            root.descendants().find(|n| n.is_element() && NOT_READ.contains(&n.tag_name().name()))
        {
            let name = node.tag_name().name();
            let message = format!(
                "`{name}` is not read: save the model as MuJoCo has compiled it (`mj_saveLastXML`), with everything in one file"
            );
            return Err(at(node, message));
        }
        let settings = Settings::of(root)?;
        let mut model = Self::new();
        let of = |tag: &'static str| elements(root).filter(move |n| n.tag_name().name() == tag);
        for world in of("worldbody") {
            let around = world.attribute("childclass");
            model.contents(&settings, world, &Pose::identity(), WORLD, around)?;
        }
        for constraint in of("equality").flat_map(elements) {
            model.constraint(&settings, constraint)?;
        }
        for tendon in of("tendon").flat_map(elements).filter(|n| n.tag_name().name() == "spatial") {
            model.tendon(tendon)?;
        }
        let driven: Vec<&str> =
            of("actuator").flat_map(elements).filter_map(|n| n.attribute("joint")).collect();
        let is_driven = |j: &&ModelJoint| j.kind == JointKind::Hinge && driven.contains(&j.name.as_str());
        model.driven_hinges = model.joints.iter().filter(is_driven).count();
        Ok(model)
    }

    /// Joints of a body, including those in `frame` elements.
    fn joints_of(
        settings: &Settings,
        node: Node<'_, '_>,
        frame: &Pose,
        around: Option<&str>,
        out: &mut Vec<OwnJoint>,
    ) -> Result<(), String> {
        for element in elements(node) {
            match element.tag_name().name() {
                "freejoint" => {
                    out.push(OwnJoint {
                        kind: None,
                        name: String::new(),
                        point: Point3::origin(),
                        axis: None,
                    });
                }
                "joint" => {
                    let kind = match settings.value(element, around, "type")?.unwrap_or("hinge") {
                        "free" => None,
                        "hinge" => Some(JointKind::Hinge),
                        "ball" => Some(JointKind::Ball),
                        "slide" => Some(JointKind::Slide),
                        other => return Err(at(element, format!("`{other}` is no type of joint"))),
                    };
                    let name = element.attribute("name").unwrap_or_default().to_string();
                    let point = frame.transform(&Point3::from(settings.position(element, around)?));
                    let axis = if kind == Some(JointKind::Hinge) {
                        let axis = settings.numbers::<3>(element, around, "axis")?;
                        let axis = frame.rotation * axis.map_or_else(Vector3::z, Vector3::from);
                        let axis = Unit::try_new(axis, 0.0);
                        Some(axis.ok_or_else(|| at(element, "axis has no direction"))?)
                    } else {
                        None
                    };
                    out.push(OwnJoint { kind, name, point, axis });
                }
                "frame" => {
                    let inner = frame.compose(&settings.pose(element, None)?);
                    let around = element.attribute("childclass").or(around);
                    Self::joints_of(settings, element, &inner, around, out)?;
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn body(
        &mut self,
        settings: &Settings,
        node: Node<'_, '_>,
        outer: &Pose,
        parent: usize,
        around: Option<&str>,
    ) -> Result<(), String> {
        let around = node.attribute("childclass").or(around);
        let pose = outer.compose(&settings.pose(node, None)?);
        let mut joints = Vec::new();
        Self::joints_of(settings, node, &Pose::identity(), around, &mut joints)?;
        let mut group = parent;
        for OwnJoint { kind, name, point, axis } in joints {
            let next = self.new_group();
            if let Some(kind) = kind {
                let name = if name.is_empty() { format!("joint {}", self.joints.len() + 1) } else { name };
                let points = [pose.transform(&point); 2];
                let axis = axis.map(|a| pose.rotation * a);
                self.joints.push(ModelJoint { kind, name, groups: [group, next], points, axis });
            }
            group = next;
        }
        let name = node.attribute("name").unwrap_or_default();
        if !name.is_empty() {
            let placed = PlacedBody { group, at: pose };
            if self.bodies.insert(name.into(), placed).is_some() {
                return Err(at(node, format!("body `{name}` is defined a second time")));
            }
        }
        let shown = if name.is_empty() { "without a name" } else { name };
        self.first.entry(group).or_insert_with(|| (shown.to_string(), pose));
        self.contents(settings, node, &pose, group, around)
    }

    /// Sites and bodies in a body, in the world or in a `frame`. The depth of the document is bounded.
    fn contents(
        &mut self,
        settings: &Settings,
        node: Node<'_, '_>,
        outer: &Pose,
        group: usize,
        around: Option<&str>,
    ) -> Result<(), String> {
        for element in elements(node) {
            match element.tag_name().name() {
                "body" => self.body(settings, element, outer, group, around)?,
                "frame" => {
                    let inner = outer.compose(&settings.pose(element, None)?);
                    let around = element.attribute("childclass").or(around);
                    self.contents(settings, element, &inner, group, around)?;
                }
                "site" => {
                    let placed = PlacedBody { group, at: outer.compose(&settings.pose(element, around)?) };
                    if let Some(name) = element.attribute("name") {
                        self.sites.insert(name.into(), placed);
                    }
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// The body or site that an attribute of an element names.
    fn named<'a>(
        list: &'a BTreeMap<String, PlacedBody>,
        node: Node<'_, '_>,
        attribute: &str,
    ) -> Result<&'a PlacedBody, String> {
        let name = node.attribute(attribute);
        let name = name.ok_or_else(|| at(node, format!("{attribute} is missing")))?;
        list.get(name).ok_or_else(|| at(node, format!("{attribute}=\"{name}\" names nothing in this model")))
    }

    fn constraint(&mut self, settings: &Settings, node: Node<'_, '_>) -> Result<(), String> {
        let (tag, name) = (node.tag_name().name(), node.attribute("name").unwrap_or_default());
        if settings.value(node, None, "active")? == Some("false") {
            self.guesses.push(format!("The constraint `{name}` ({tag}) is not active and is passed over."));
            return Ok(());
        }
        let sites = node.attribute("site1").is_some() || node.attribute("site2").is_some();
        let world = PlacedBody { group: WORLD, at: Pose::identity() };
        let (first, second) = if sites {
            let of = |attribute: &str| Self::named(&self.sites, node, attribute);
            (of("site1")?.clone(), of("site2")?.clone())
        } else if matches!(tag, "connect" | "weld") {
            let second = node.attribute("body2").map(|_| Self::named(&self.bodies, node, "body2"));
            (Self::named(&self.bodies, node, "body1")?.clone(), second.transpose()?.cloned().unwrap_or(world))
        } else {
            self.guesses
                .push(format!("The constraint `{name}` ({tag}) is passed over: it moves no joint centre."));
            return Ok(());
        };
        match tag {
            "connect" => {
                let points = if sites {
                    [first.at, second.at].map(|pose| Point3::from(pose.position))
                } else {
                    let anchor = settings.numbers::<3>(node, None, "anchor")?;
                    let anchor = anchor.ok_or_else(|| at(node, "anchor is missing"))?;
                    [first.at.transform(&Point3::from(anchor)); 2]
                };
                let name =
                    if name.is_empty() { format!("connect {}", self.joints.len() + 1) } else { name.into() };
                let groups = [first.group, second.group];
                self.joints.push(ModelJoint { kind: JointKind::Ball, name, groups, points, axis: None });
            }
            "weld" => {
                let given = settings.numbers::<7>(node, None, "relpose")?;
                if sites || given.is_some_and(|p| p[3..].iter().any(|x| *x != 0.0)) {
                    let message = "`weld` of sites or with `relpose` is not read: it may hold bodies where they are not at qpos0";
                    return Err(at(node, message));
                }
                self.join(first.group, second.group);
            }
            _ => {}
        }
        Ok(())
    }

    fn tendon(&mut self, node: Node<'_, '_>) -> Result<(), String> {
        let path: Vec<Node<'_, '_>> = elements(node).collect();
        let [a, b] = path[..] else {
            self.other_tendons += 1;
            return Ok(());
        };
        if [a, b].iter().any(|n| n.tag_name().name() != "site") {
            self.other_tendons += 1;
            return Ok(());
        }
        let ends = [Self::named(&self.sites, a, "site")?, Self::named(&self.sites, b, "site")?];
        let name =
            node.attribute("name").map_or_else(|| format!("tendon {}", self.tendons.len() + 1), Into::into);
        let tendon =
            Tendon { name, groups: ends.map(|e| e.group), points: ends.map(|e| Point3::from(e.at.position)) };
        self.tendons.push(tendon);
        Ok(())
    }
}
