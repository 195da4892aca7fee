//! Models of simulators (MJCF of `MuJoCo`, SDF of Gazebo, URDF of ROS): legs and home at the reference configuration,
//! from `export` or from people.

mod attributes;
mod graph;
mod legs;
mod links;
mod mujoco;
mod sdf;
#[cfg(test)]
mod tests;
mod urdf;

use roxmltree::{Document, Node};

use self::graph::Mechanism;
use self::legs::{ModelLegs, SAME_POINT};
use super::placed::{FileUnit, PlacedLegs, number_between};
use super::points::PointTable;
use crate::design::unit_of_millimetres;
use platform::geom::Pose;

/// The site that is the platform frame in models of this program.
const PLATFORM_SITE: &str = "platform_frame";
/// Greatest nesting depth of elements. `MuJoCo` itself accepts far fewer nested bodies.
const MAX_DEPTH: usize = 200;

/// Whether a text is XML of any kind.
pub(super) fn is_xml(text: &str) -> bool {
    text.trim_start_matches('\u{feff}').trim_start().starts_with('<')
}

num::words! {
    /// A format of models.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    enum ModelFormat as name {
        Mujoco = "MuJoCo",
        Sdf = "SDF",
        Urdf = "URDF",
    }
}

impl ModelFormat {
    /// The format of a root element.
    fn of_root(name: &str) -> Option<Self> {
        match name {
            "mujoco" => Some(Self::Mujoco),
            "sdf" => Some(Self::Sdf),
            "robot" => Some(Self::Urdf),
            _ => None,
        }
    }

    fn opening(self) -> &'static str {
        match self {
            Self::Mujoco => {
                "A model of MuJoCo, read at its reference configuration (qpos0); key frames are not used."
            }
            Self::Sdf => "An SDF model (Gazebo), read where its poses are.",
            Self::Urdf => "A URDF model (ROS), read with all joints at zero.",
        }
    }
}

/// Reads a model.
///
/// # Errors
/// A sentence: invalid XML, another kind of XML, unsupported elements, no six legs.
pub(super) fn read(text: &str) -> Result<PointTable, String> {
    few_attributes(text)?;
    let document = Document::parse(text).map_err(|why| format!("the XML is broken: {why}"))?;
    let root = document.root_element();
    let name = root.tag_name().name();
    let format = ModelFormat::of_root(name).ok_or_else(|| {
        format!("this is XML with the root element `{name}`; models are read as MJCF (MuJoCo), SDF and URDF")
    })?;
    bounded(&document)?;
    let model = match format {
        ModelFormat::Mujoco => Mechanism::of_mujoco(root)?,
        ModelFormat::Sdf => sdf::read(root)?.mechanism()?,
        ModelFormat::Urdf => {
            let mut model = urdf::read(root)?.mechanism()?;
            model.close_loops(format.name())?;
            model
        }
    };
    let found = ModelLegs::of(&model)?;
    let mut guesses = vec![format.opening().to_string()];
    guesses.extend(found.guesses);
    let home = home(&model, format, found.platform, &mut guesses)?;
    let unit = unit(&document, format, &mut guesses)?;
    guesses.extend(model.guesses);
    let placed =
        PlacedLegs { ends: found.ends, home: home.unwrap_or_else(Pose::identity), tolerance: SAME_POINT };
    let table = placed.table(&unit, guesses);
    let mut table = table.ok_or("the coordinates of the joints overflow")?;
    if home.is_none() {
        table.home = None;
        table.part_frames();
        if table.home.is_none() {
            return Err("no frame of the platform is said: name its link `platform`".into());
        }
    }
    Ok(table)
}

/// The platform frame at the reference configuration; `None` if the model has none.
fn home(
    model: &Mechanism,
    format: ModelFormat,
    platform: usize,
    guesses: &mut Vec<String>,
) -> Result<Option<Pose>, String> {
    if format != ModelFormat::Mujoco {
        return Ok(model.platform_frame(platform).map(|(name, pose)| {
            guesses.push(format!("The platform is the link `{name}`, and home is where its frame is."));
            *pose
        }));
    }
    let on_platform = model.site(PLATFORM_SITE).filter(|(group, _)| *group == platform);
    if let Some((_, pose)) = on_platform {
        guesses.push(format!("Home is where the site `{PLATFORM_SITE}` is."));
        return Ok(Some(pose));
    }
    let (name, pose) = model.first_body(platform).ok_or("the platform is between two joints of a body")?;
    guesses.push(format!("The platform is the body `{name}`, and home is where its frame is."));
    Ok(Some(*pose))
}

/// Greatest number of attributes of an element: the check for duplicate names takes quadratic time.
const MAX_ATTRIBUTES: usize = 200;

/// Refuses an element with too many attributes before the text is parsed.
fn few_attributes(text: &str) -> Result<(), String> {
    let mut rest = text;
    while let Some(begin) = rest.find('<') {
        rest = &rest[begin..];
        let other = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")];
        if let Some((_, end)) = other.iter().find(|(begin, _)| rest.starts_with(begin)) {
            rest = rest.find(end).map_or("", |at| &rest[at + end.len()..]);
            continue;
        }
        let (mut values, mut quote, mut length) = (0, None, rest.len());
        for (at, c) in rest.char_indices() {
            match (c, quote) {
                ('"' | '\'', None) => (values, quote) = (values + 1, Some(c)),
                ('>', None) => {
                    length = at;
                    break;
                }
                (_, Some(open)) if c == open => quote = None,
                _ => {}
            }
        }
        if values > MAX_ATTRIBUTES {
            let line = 1 + text[..text.len() - rest.len()].matches('\n').count();
            return Err(format!(
                "line {line}: an element has {values} attributes, more than {MAX_ATTRIBUTES}"
            ));
        }
        rest = &rest[length..];
    }
    Ok(())
}

/// Refuses elements nested too deeply for the recursive readers.
fn bounded(document: &Document<'_>) -> Result<(), String> {
    let mut depths: std::collections::HashMap<roxmltree::NodeId, usize> = std::collections::HashMap::new();
    for node in document.descendants().filter(Node::is_element) {
        let depth = node.parent().and_then(|p| depths.get(&p.id())).map_or(1, |d| d + 1);
        if depth > MAX_DEPTH {
            return Err(attributes::at(
                node,
                format!("more than {MAX_DEPTH} elements are nested in each other"),
            ));
        }
        depths.insert(node.id(), depth);
    }
    Ok(())
}

/// The unit of the design if this program wrote the model, otherwise metres.
fn unit(document: &Document<'_>, format: ModelFormat, guesses: &mut Vec<String>) -> Result<FileUnit, String> {
    let comments = document.descendants().filter(Node::is_comment).filter_map(|n| n.text());
    let said = comments
        .flat_map(str::lines)
        .find_map(|line| number_between(line, "Lengths in m; one unit of the design is ", " m"));
    let Some(metres) = said else {
        guesses.push(match format {
            ModelFormat::Mujoco => "The lengths are in metres, as is usual: MuJoCo has no units.".into(),
            ModelFormat::Sdf | ModelFormat::Urdf => {
                format!("The lengths are in metres, as {} has them.", format.name())
            }
        });
        return Ok(FileUnit { label: "m", per: 1.0 });
    };
    let (label, millimetres) = unit_of_millimetres(1000.0 * metres).ok_or_else(|| {
        format!(
            "the comment of the model says that a unit of the design is {metres} m, which is no known unit"
        )
    })?;
    guesses.push(format!("The lengths are converted from metres to {label}, the unit of the design that the comment of the model names."));
    Ok(FileUnit { label, per: millimetres / 1000.0 })
}
