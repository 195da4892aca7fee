//! Models of `MuJoCo` (MJCF): legs and home at the reference configuration, as `export --to mjcf` writes them and
//! people do.

mod attributes;
mod legs;
#[cfg(test)]
mod tests;
mod tree;

use roxmltree::{Document, Node};

use self::legs::{ModelLegs, SAME_POINT};
use self::tree::MujocoModel;
use super::placed::{FileUnit, PlacedLegs, number_between};
use super::points::PointTable;
use crate::design::unit_of_millimetres;

/// The site that is the platform frame in models of this program.
const PLATFORM_SITE: &str = "platform_frame";
/// Elements in elements. `MuJoCo` itself reads far fewer bodies in bodies.
const MAX_DEPTH: usize = 200;

/// Whether a text is XML, of whatever kind.
pub(super) fn is_xml(text: &str) -> bool {
    text.trim_start_matches('\u{feff}').trim_start().starts_with('<')
}

/// Reads a model.
///
/// # Errors
/// A sentence: broken XML, another kind of XML, elements that are not read, no six legs.
pub(super) fn read(text: &str) -> Result<PointTable, String> {
    few_attributes(text)?;
    let document = Document::parse(text).map_err(|why| format!("the XML is broken: {why}"))?;
    let root = document.root_element();
    if root.tag_name().name() != "mujoco" {
        let name = root.tag_name().name();
        return Err(format!(
            "this is XML with the root element `{name}`; of XML, only models of MuJoCo are read"
        ));
    }
    bounded(&document)?;
    let model = MujocoModel::read(root)?;
    let found = ModelLegs::of(&model)?;
    let mut guesses = vec![
        "A model of MuJoCo, read at its reference configuration (qpos0); key frames are not used."
            .to_string(),
    ];
    guesses.extend(found.guesses);
    let on_platform = model.site(PLATFORM_SITE).filter(|(group, _)| *group == found.platform);
    let home = if let Some((_, pose)) = on_platform {
        guesses.push(format!("Home is where the site `{PLATFORM_SITE}` is."));
        pose
    } else {
        let (name, pose) =
            model.first_body(found.platform).ok_or("the platform is between two joints of a body")?;
        guesses.push(format!("The platform is the body `{name}`, and home is where its frame is."));
        *pose
    };
    let unit = unit(&document, &mut guesses)?;
    guesses.extend(model.guesses);
    let placed = PlacedLegs { ends: found.ends, home, tolerance: SAME_POINT };
    placed.table(&unit, guesses).ok_or_else(|| "the coordinates of the joints overflow".to_string())
}

/// Attributes of an element: whether two have one name is looked up in a time that grows with the square of their
/// number.
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

/// Refuses elements too deep in each other: what reads them goes down with them.
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

/// The unit of the design of which this program wrote the model; metres else.
fn unit(document: &Document<'_>, guesses: &mut Vec<String>) -> Result<FileUnit, String> {
    let comments = document.descendants().filter(Node::is_comment).filter_map(|n| n.text());
    let said = comments
        .flat_map(str::lines)
        .find_map(|line| number_between(line, "Lengths in m; one unit of the design is ", " m"));
    let Some(metres) = said else {
        guesses.push("The lengths are in metres, as is usual: MuJoCo has no units.".into());
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
