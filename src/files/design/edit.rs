//! Edits of a design in its source text: comments, order and spelling of everything else stay.

use nalgebra::Point3;
use thiserror::Error;

use super::model::NotBuilt;
use super::tree::{Entry, Node, Span, Value, find};
use super::violation::Findings;
use super::{DesignModel, Format, Warning, parse_with_cranks, toml_text};
use platform::manipulator::{Body, InvalidManipulator, Manipulator};

/// The text a design was read from, with its warnings. Designs with equal content are equal regardless of their text.
#[derive(Clone, Default)]
pub struct Written {
    /// `None` for designs without TOML text.
    toml: Option<String>,
    warnings: Vec<Warning>,
}

impl PartialEq for Written {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// The text is left out, for the same reason.
impl std::fmt::Debug for Written {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Written")
    }
}

impl Written {
    pub(super) fn new(text: &str, format: Format, warnings: &[Warning]) -> Self {
        Self { toml: (format == Format::Toml).then(|| text.to_string()), warnings: warnings.to_vec() }
    }

    /// Warnings of the text, in its order.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// Replaces the coordinates of a joint in the text. The text is dropped if the joint is not found.
    fn set_joint(&mut self, body: &str, name: &str, point: [f64; 3]) {
        let edited = self.toml.take().and_then(|text| {
            let mut out = text;
            match given(&out, body, name)? {
                JointPlace::Coordinates(spans) => {
                    // from the last to the first, so that the places of the others stay
                    for (span, x) in spans.into_iter().zip(point).rev() {
                        out.replace_range(span, &format!("{x:?}"));
                    }
                }
                JointPlace::Construction(span) => out.replace_range(span, &format!("{point:?}")),
            }
            Some(out)
        });
        self.toml = edited;
    }
}

/// The place of a joint's definition in the text.
enum JointPlace {
    /// The three coordinates, in this order.
    Coordinates([Span; 3]),
    /// A table.
    Construction(Span),
}

fn given(text: &str, body: &str, name: &str) -> Option<JointPlace> {
    let root = toml_text::read(text, &mut Findings::new(text))?;
    let inside = |node: &Node, key: &str| -> Option<Node> {
        let Value::Table(entries) = &node.value else { return None };
        find(entries, key).map(|e: &Entry| e.node.clone())
    };
    let joint = inside(&inside(&root, body)?, name)?;
    match joint.value {
        Value::Array(list) => {
            <[_; 3]>::try_from(list).ok().map(|l| JointPlace::Coordinates(l.map(|node| node.span)))
        }
        Value::Table(_) => Some(JointPlace::Construction(joint.span)),
        _ => None,
    }
}

/// Reasons why a joint cannot be changed. The design then stays unchanged.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum JointError {
    /// There is no joint of this name.
    #[error("there is no joint `{name}`; joints are {}", known.join(", "))]
    Unknown {
        /// The name given.
        name: String,
        /// All names, with their bodies.
        known: Vec<String>,
    },
    /// Both bodies have a joint of this name.
    #[error("both bodies have a joint `{name}`: write `base.{name}` or `platform.{name}`")]
    Ambiguous {
        /// The name given.
        name: String,
    },
    /// The joints would form no manipulator.
    #[error(transparent)]
    Invalid(#[from] InvalidManipulator),
    /// The construction of another joint fails with this one, for instance a line through two equal points.
    #[error("{message}")]
    Construction {
        /// The fault.
        message: String,
    },
}

impl From<NotBuilt> for JointError {
    fn from(why: NotBuilt) -> Self {
        match why {
            NotBuilt::Construction(fault) => Self::Construction { message: fault.to_string() },
            NotBuilt::Manipulator(invalid) => Self::Invalid(invalid),
        }
    }
}

impl DesignModel {
    /// Moves a joint to new coordinates in the frame of its body. If both bodies have a joint of this name, the body
    /// comes before it (`"base.P1"`). Everything else stays, including lengths and the comments of the
    /// [`text`](Self::text). Three numbers replace a construction of this joint; joints constructed from it follow it.
    ///
    /// ```
    /// # mod equipod { pub mod methods { pub use equipod_files::design; } }
    /// use equipod::methods::design::{Format, parse};
    /// let (mut design, _) = parse(include_str!("../../../designs/rbt-octahedral.toml"), Format::Toml).expect("a design");
    /// design.set_joint("P4", [0.0, 0.0, 0.5])?;
    /// assert!(design.text().contains("P4 = [0.0, 0.0, 0.5]"));
    /// assert!(design.set_joint("P44", [0.0; 3]).is_err());
    /// # Ok::<(), equipod_files::design::JointError>(())
    /// ```
    ///
    /// # Errors
    /// [`JointError`]; the design then stays unchanged.
    pub fn set_joint(&mut self, name: &str, point: impl Into<Point3<f64>>) -> Result<(), JointError> {
        let point = point.into();
        let (body, index) = self.joint(name)?;
        let m = self.manipulator();
        let mut joints = [m.base_joints().to_vec(), m.platform_joints().to_vec()];
        joints[body][index] = point;
        let [base, platform] = joints;
        let moved = Manipulator::try_new(base, platform, m.pairs())?;
        let mut constructions = self.current_constructions();
        constructions.forget(Body::BOTH[body], index);
        let mut changed = self.clone();
        changed.manipulator = moved;
        let changed = changed.with_constructions(constructions)?;
        let names = [("base", self.base_names()), ("platform", self.platform_names())];
        let (body, name) = (names[body].0, names[body].1[index].clone());
        (self.manipulator, self.constructions) = (changed.manipulator, changed.constructions);
        self.written.set_joint(body, &name, point.coords.into());
        Ok(())
    }

    /// Body and index of a joint, by its name.
    fn joint(&self, name: &str) -> Result<(usize, usize), JointError> {
        let bodies = [("base", self.base_names()), ("platform", self.platform_names())];
        let found: Vec<(usize, usize)> = bodies
            .iter()
            .enumerate()
            .filter_map(|(k, (_, names))| Some((k, names.iter().position(|n| n == name)?)))
            .collect();
        match found[..] {
            [one] => return Ok(one),
            [] => {}
            _ => return Err(JointError::Ambiguous { name: name.to_string() }),
        }
        let qualified = bodies.iter().enumerate().find_map(|(k, (body, names))| {
            let own = name.strip_prefix(body)?.strip_prefix('.')?;
            Some((k, names.iter().position(|n| n == own)?))
        });
        qualified.ok_or_else(|| JointError::Unknown {
            name: name.to_string(),
            known: bodies
                .iter()
                .flat_map(|(body, names)| names.iter().map(move |n| format!("{body}.{n}")))
                .collect(),
        })
    }

    /// The TOML text the design was read from, with comments and with joints [moved](Self::set_joint) since. It is
    /// [`to_toml`](Self::to_toml) if there is no such text, or if other changes made it outdated.
    #[must_use]
    pub fn text(&self) -> String {
        let kept = self.written.toml.as_ref().filter(|text| {
            parse_with_cranks(text, Format::Toml).is_ok_and(|(mut read, _)| {
                // the table of a trajectory is a separate file
                if let (Some(own), Some(t)) = (&self.workspace.trajectory, &mut read.workspace.trajectory) {
                    t.poses.clone_from(&own.poses);
                }
                read == *self
            })
        });
        kept.cloned().unwrap_or_else(|| self.to_toml())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::parse;
    use platform::manipulator::LegLengths;

    const TEXT: &str = r#"# a design with words in it
name = "words" # its name
units = "mm"
lengths = [17.0, 18.0, 18.0, 17.0, 15.0, 17.8]
legs = [["A", "A"], ["B", "A"], ["B", "b"], ["C d", "b"], ["C d", "c"], ["A", "c"]]

[base] # on the floor
A = [0.0, 0.0, 0.0]
"C d" = [ 12, # across
  0.0,
  0 ]
B = [6.0, 1.0e1, 0.0]

[platform]
A = [0.0, 0.0, 0.0]
b = [3.0, 5.0, 0.0]
c = [6.0, 0.0, 0.0]
"#;

    fn design() -> DesignModel {
        parse(TEXT, Format::Toml).unwrap().0
    }

    #[test]
    fn a_moved_joint_changes_three_numbers_of_the_text_and_nothing_else() {
        let mut d = design();
        assert_eq!(d.text(), TEXT);
        d.set_joint("C d", [12.5, -1e-7, 0.1 + 0.2]).unwrap();
        let expected = TEXT
            .replace("[ 12, # across\n  0.0,\n  0 ]", "[ 12.5, # across\n  -1e-7,\n  0.30000000000000004 ]");
        assert_eq!(d.text(), expected);
        assert_eq!(d.lengths, Some(LegLengths::try_new([17.0, 18.0, 18.0, 17.0, 15.0, 17.8]).unwrap()));
        assert_eq!(parse(&d.text(), Format::Toml).unwrap().0, d);
        d.set_joint("platform.A", [0.0, 0.0, 1.0]).unwrap();
        d.set_joint("base.A", [0.0, 0.0, 2.0]).unwrap();
        assert_eq!(
            d.text(),
            expected.replacen("A = [0.0, 0.0, 0.0]", "A = [0.0, 0.0, 2.0]", 1).replacen(
                "A = [0.0, 0.0, 0.0]",
                "A = [0.0, 0.0, 1.0]",
                1
            )
        );
    }

    #[test]
    fn what_cannot_be_moved_leaves_the_design_as_it_was() {
        let mut d = design();
        assert!(matches!(d.set_joint("A", [1.0; 3]), Err(JointError::Ambiguous { .. })));
        let Err(JointError::Unknown { known, .. }) = d.set_joint("base.b", [1.0; 3]) else { panic!() };
        assert!(known.contains(&"platform.b".to_string()));
        for x in [f64::NAN, f64::INFINITY, 1e300] {
            assert!(matches!(d.set_joint("b", [x, 0.0, 0.0]), Err(JointError::Invalid(_))), "{x}");
        }
        assert_eq!((d.text().as_str(), d), (TEXT, design()));
    }

    #[test]
    fn a_text_that_no_longer_says_what_the_design_is_gives_way() {
        let mut d = design();
        d.name = "other".into();
        assert_eq!(d.text(), d.to_toml());
        d.name = "words".into();
        assert_eq!(d.text(), TEXT, "it says so again");
        let from_json = parse(&d.to_json(), Format::Json).unwrap().0;
        assert_eq!((from_json.text(), &from_json), (d.to_toml(), &d));
    }

    #[test]
    fn dotted_keys_and_inline_tables_are_edited_too() {
        let (head, _) = TEXT.split_once("[base]").unwrap();
        let text = format!(
            "{head}base = {{ A = [0, 0, 0], \"C d\" = [12, 0, 0], B = [6, 10, 0] }}\nplatform.A = [0, 0, 0]\nplatform.b = [3, 5, 0] # b\nplatform.c = [6, 0, 0]\n"
        );
        let mut d = parse(&text, Format::Toml).unwrap().0;
        d.set_joint("b", [3.5, 5.0, 0.25]).unwrap();
        d.set_joint("B", [6.0, 11.0, 0.0]).unwrap();
        let expected =
            text.replace("[3, 5, 0] # b", "[3.5, 5.0, 0.25] # b").replace("[6, 10, 0]", "[6.0, 11.0, 0.0]");
        assert_eq!(d.text(), expected);
    }
}
