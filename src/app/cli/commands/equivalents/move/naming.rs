//! Families by the names of the joints that span them.

use nalgebra::Point3;

use super::request::NamedFamily;
use crate::app::cli::failure::Failure;
use ask::Design;
use num::linalg::LinalgError;
use synthesis::components::{Components, Parametrisation};
use synthesis::relocate::{counted_from, family_between};

pub(super) fn internal(e: &LinalgError) -> Failure {
    Failure::internal(e.to_string())
}

/// A named family with its parameters.
pub(super) struct Meant {
    /// Its index.
    pub(super) index: usize,
    /// Formulas with parameters counted from the named joints; `None`: the family's own formulas.
    pub(super) formulas: Option<Parametrisation>,
}

/// The named family. Joint names refer to `given`, at places that its families keep; joints that only `current` has can
/// be named too.
pub(super) fn resolve(
    along: &NamedFamily,
    given: &Design,
    current: &Design,
    found: &Components,
) -> Result<Meant, Failure> {
    let text = match along {
        NamedFamily::Number(n) if (1..=found.components.len()).contains(n) => {
            return Ok(Meant { index: n - 1, formulas: None });
        }
        NamedFamily::Number(n) => {
            let message = format!("there is no family {n}, the platform has {}", found.components.len());
            return Err(
                Failure::refused("move::no_such_family", message).with_help(list_families(current, found)?)
            );
        }
        NamedFamily::Between(text) => text,
    };
    let (base, platform) = (joints(given, current, false), joints(given, current, true));
    let flats = text
        .match_indices(':')
        .find_map(|(k, _)| Some((points(&text[..k], &base)?, points(&text[k + 1..], &platform)?)));
    let Some((a, b)) = flats else {
        let message = format!(
            "`{text}` is neither the number of a family nor base joints, a colon and platform joints"
        );
        return Err(Failure::refused("move::no_such_family", message).with_help(
            "name the joints that span it: P1:P4-P5 is the legs from P1 to the line through P4 and P5",
        ));
    };
    let m = current.manipulator();
    match family_between(m, found, &a, &b).map_err(|e| internal(&e))?[..] {
        [index] => {
            let formulas = counted_from(&found.components[index].parametrisation, &a, &b);
            Ok(Meant { index, formulas })
        }
        [] => Err(Failure::refused("move::no_such_family", format!("there is no family of legs `{text}`"))
            .with_help(list_families(current, found)?)),
        ref several => {
            let numbers: Vec<String> = several.iter().map(|k| (k + 1).to_string()).collect();
            let message = format!("`{text}` fits the families {}", numbers.join(", "));
            Err(Failure::refused("move::ambiguous_family", message)
                .with_help("give the number of one of them"))
        }
    }
}

/// Names and places of the joints of one body, those of the given design first.
fn joints<'a>(given: &'a Design, current: &'a Design, platform: bool) -> Vec<(&'a str, Point3<f64>)> {
    let of = |d: &'a Design| {
        let m = d.manipulator();
        let (names, points) = if platform {
            (d.platform_names(), m.platform_joints())
        } else {
            (d.base_names(), m.base_joints())
        };
        names.iter().map(String::as_str).zip(points.iter().copied())
    };
    of(given).chain(of(current)).collect()
}

/// The places of joints joined by hyphens; names may themselves contain hyphens.
fn points(text: &str, joints: &[(&str, Point3<f64>)]) -> Option<Vec<Point3<f64>>> {
    for (name, place) in joints {
        let Some(rest) = text.strip_prefix(name) else { continue };
        if rest.is_empty() {
            return Some(vec![*place]);
        }
        if let Some(mut more) = rest.strip_prefix('-').and_then(|r| points(r, joints)) {
            more.insert(0, *place);
            return Some(more);
        }
    }
    None
}

/// The names that are accepted, in one line.
pub(super) fn list_families(design: &Design, found: &Components) -> Result<String, Failure> {
    if found.components.is_empty() {
        return Ok("no leg of this platform can be moved".to_string());
    }
    let mut entries = Vec::new();
    for (k, c) in found.components.iter().enumerate() {
        let legs: Vec<String> = c.support.iter().map(|l| (l.get() + 1).to_string()).collect();
        let name = design
            .family_name(found, k)
            .map_err(|e| internal(&e))?
            .map_or(String::new(), |n| format!(" {n}"));
        let (dimension, legs) = (c.dimension, legs.join(" "));
        entries.push(format!("{}{name} ({}, {dimension} parameter(s), legs {legs})", k + 1, c.type_name()));
    }
    Ok(format!("families, with the legs they can replace: {}", entries.join("; ")))
}
