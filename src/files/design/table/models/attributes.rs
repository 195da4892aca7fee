//! Attributes with their defaults by class, and numbers in them.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Quaternion, Rotation3, Unit, UnitQuaternion, Vector3};
use roxmltree::Node;

use platform::geom::Pose;

/// The elements whose attributes may come from a class.
const WITH_DEFAULTS: [&str; 3] = ["joint", "site", "equality"];
/// The class of elements without a class name.
const MAIN: &str = "main";

/// Attributes of a class by element and name.
#[derive(Debug, Default)]
struct DefaultClass {
    parent: Option<String>,
    attributes: BTreeMap<(String, String), String>,
}

/// Settings for reading the attributes of a model.
#[derive(Debug)]
pub(super) struct Settings {
    /// Factor from an angle of the model to radians.
    angle: f64,
    /// Axes of Euler angles; lower case: axes of the rotated frame.
    sequence: [char; 3],
    classes: BTreeMap<String, DefaultClass>,
}

/// A sentence with the line of an element.
pub(super) fn at(node: Node<'_, '_>, message: impl std::fmt::Display) -> String {
    let line = node.document().text_pos_at(node.range().start).row;
    format!("line {line}: {message}")
}

/// The elements below an element.
pub(super) fn elements<'a, 'i>(node: Node<'a, 'i>) -> impl Iterator<Item = Node<'a, 'i>> {
    node.children().filter(Node::is_element)
}

/// `N` numbers separated by spaces.
pub(super) fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let list: Vec<f64> = text.split_whitespace().map(str::parse).collect::<Result<_, _>>().ok()?;
    list.iter().all(|x| x.is_finite()).then_some(())?;
    list.try_into().ok()
}

impl Settings {
    /// The settings of a model.
    ///
    /// # Errors
    /// An unknown value of `compiler`; a class that is defined twice.
    pub(super) fn of(root: Node<'_, '_>) -> Result<Self, String> {
        let mut settings =
            Self { angle: 1.0_f64.to_radians(), sequence: ['x', 'y', 'z'], classes: BTreeMap::new() };
        settings.classes.insert(MAIN.into(), DefaultClass::default());
        for node in elements(root) {
            match node.tag_name().name() {
                "compiler" => settings.compiler(node)?,
                "default" => settings.default_class(node, None)?,
                _ => {}
            }
        }
        Ok(settings)
    }

    fn compiler(&mut self, node: Node<'_, '_>) -> Result<(), String> {
        match node.attribute("angle") {
            None => {}
            Some("degree") => self.angle = 1.0_f64.to_radians(),
            Some("radian") => self.angle = 1.0,
            Some(other) => return Err(at(node, format!("angle=\"{other}\" is neither degree nor radian"))),
        }
        if let Some(text) = node.attribute("eulerseq") {
            let letters: Vec<char> = text.chars().filter(|c| "xyzXYZ".contains(*c)).collect();
            let sequence = <[char; 3]>::try_from(letters).ok().filter(|_| text.chars().count() == 3);
            self.sequence = sequence
                .ok_or_else(|| at(node, format!("`eulerseq` is \"{text}\", which is not three axes")))?;
        }
        match node.attribute("coordinate") {
            None | Some("local") => Ok(()),
            Some(other) => {
                Err(at(node, format!("coordinate=\"{other}\" is not read, only local coordinates")))
            }
        }
    }

    /// Nested classes inherit missing values from the enclosing one. The depth of the document is bounded.
    fn default_class(&mut self, node: Node<'_, '_>, parent: Option<&str>) -> Result<(), String> {
        let name = match (node.attribute("class"), parent) {
            // the outermost class is always named main
            (Some(name), None) if name != MAIN => {
                self.classes.entry(name.into()).or_default().parent = Some(MAIN.into());
                MAIN
            }
            (_, None) => MAIN,
            (Some(name), Some(parent)) => {
                let class = DefaultClass { parent: Some(parent.into()), ..DefaultClass::default() };
                if self.classes.insert(name.into(), class).is_some() {
                    return Err(at(node, format!("class `{name}` is defined a second time")));
                }
                name
            }
            (None, Some(_)) => return Err(at(node, "a default class below another needs a name")),
        };
        for element in elements(node) {
            let tag = element.tag_name().name();
            if tag == "default" {
                self.default_class(element, Some(name))?;
            } else if WITH_DEFAULTS.contains(&tag) {
                let attributes = &mut self.classes.entry(name.into()).or_default().attributes;
                for attribute in element.attributes() {
                    attributes.insert((tag.into(), attribute.name().into()), attribute.value().into());
                }
            }
        }
        Ok(())
    }

    /// The value of an attribute: that of the element, then of its class (or that of the enclosing bodies), then of the
    /// classes above.
    ///
    /// # Errors
    /// A class that is not defined.
    pub(super) fn value<'s>(
        &'s self,
        node: Node<'s, '_>,
        around: Option<&str>,
        attribute: &str,
    ) -> Result<Option<&'s str>, String> {
        if let Some(own) = node.attribute(attribute) {
            return Ok(Some(own));
        }
        let tag = match node.tag_name().name() {
            "connect" | "weld" => "equality",
            tag => tag,
        };
        let mut name = node.attribute("class").or(around).unwrap_or(MAIN).to_string();
        let key = (tag.to_string(), attribute.to_string());
        // parents are defined before their children, so the loop ends
        loop {
            let class = self
                .classes
                .get(&name)
                .ok_or_else(|| at(node, format!("class `{name}` has no definition in `default`")))?;
            match (class.attributes.get(&key), &class.parent) {
                (Some(value), _) => return Ok(Some(value)),
                (None, Some(parent)) => name.clone_from(parent),
                (None, None) => return Ok(None),
            }
        }
    }

    /// Numbers of an attribute.
    ///
    /// # Errors
    /// Another count, or words that are not numbers.
    pub(super) fn numbers<const N: usize>(
        &self,
        node: Node<'_, '_>,
        around: Option<&str>,
        attribute: &str,
    ) -> Result<Option<[f64; N]>, String> {
        let Some(text) = self.value(node, around, attribute)? else { return Ok(None) };
        let parsed = numbers(text);
        parsed.map(Some).ok_or_else(|| {
            let counted = if N == 1 { "a number".to_string() } else { format!("{N} numbers") };
            at(node, format!("{attribute}=\"{text}\" is not {counted}"))
        })
    }

    /// `pos`, zero if absent.
    pub(super) fn position(&self, node: Node<'_, '_>, around: Option<&str>) -> Result<Vector3<f64>, String> {
        Ok(self.numbers::<3>(node, around, "pos")?.map_or_else(Vector3::zeros, Vector3::from))
    }

    /// Position and orientation of a body, a frame or a site in its parent.
    ///
    /// # Errors
    /// Invalid numbers, axes of length zero, more than one orientation.
    pub(super) fn pose(&self, node: Node<'_, '_>, around: Option<&str>) -> Result<Pose, String> {
        let unfit = |attribute: &str| at(node, format!("{attribute} has no direction"));
        let given =
            ["quat", "axisangle", "euler", "xyaxes", "zaxis"].map(|name| node.attribute(name).is_some());
        if given.iter().filter(|g| **g).count() > 1 {
            return Err(at(node, "more than one orientation is given"));
        }
        // the element's own orientation overrides that of its class, whatever their kinds
        let own = given.iter().any(|g| *g);
        let asked = |k: usize| !own || given[k];
        let mut rotation = Rotation3::identity();
        if let (true, Some([w, x, y, z])) = (asked(0), self.numbers::<4>(node, around, "quat")?) {
            let q = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 0.0).ok_or_else(|| unfit("quat"))?;
            rotation = q.to_rotation_matrix();
        } else if let (true, Some([x, y, z, angle])) =
            (asked(1), self.numbers::<4>(node, around, "axisangle")?)
        {
            let axis = Unit::try_new(Vector3::new(x, y, z), 0.0).ok_or_else(|| unfit("axisangle"))?;
            rotation = Rotation3::from_axis_angle(&axis, angle * self.angle);
        } else if let (true, Some(angles)) = (asked(2), self.numbers::<3>(node, around, "euler")?) {
            for (axis, angle) in self.sequence.into_iter().zip(angles) {
                let unit = match axis.to_ascii_lowercase() {
                    'x' => Vector3::x_axis(),
                    'y' => Vector3::y_axis(),
                    _ => Vector3::z_axis(),
                };
                let turn = Rotation3::from_axis_angle(&unit, angle * self.angle);
                rotation = if axis.is_ascii_lowercase() { rotation * turn } else { turn * rotation };
            }
        } else if let (true, Some([a, b, c, d, e, f])) =
            (asked(3), self.numbers::<6>(node, around, "xyaxes")?)
        {
            let axes = Vector3::new(a, b, c).try_normalize(0.0).and_then(|x| {
                let y = Vector3::new(d, e, f);
                let y = (y - x * x.dot(&y)).try_normalize(0.0)?;
                Some(Matrix3::from_columns(&[x, y, x.cross(&y)]))
            });
            rotation = Rotation3::from_matrix_unchecked(axes.ok_or_else(|| unfit("xyaxes"))?);
        } else if let (true, Some(z)) = (asked(4), self.numbers::<3>(node, around, "zaxis")?) {
            let z = Vector3::from(z).try_normalize(0.0).ok_or_else(|| unfit("zaxis"))?;
            // the shortest rotation; half a turn about x if the axis points down
            rotation = Rotation3::rotation_between(&Vector3::z(), &z)
                .unwrap_or_else(|| Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI));
        }
        let mut position = self.position(node, around)?;
        if node.tag_name().name() == "site"
            && let Some([a, b, c, d, e, f]) = self.numbers::<6>(node, around, "fromto")?
        {
            position = 0.5 * (Vector3::new(a, b, c) + Vector3::new(d, e, f));
        }
        Ok(Pose { rotation, position })
    }
}
