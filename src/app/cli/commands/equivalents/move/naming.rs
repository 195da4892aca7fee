//! Names: of families by the joints that span them, of joints that come apart.

use nalgebra::Point3;

use super::request::NamedFamily;
use crate::app::cli::failure::Failure;
use ::files::design::{DesignModel, Origin, Share};
use ask::Design;
use num::linalg::LinalgError;
use platform::manipulator::Body;
use synthesis::components::{Components, Parametrisation};
use synthesis::relocate::{Assembled, JointOrigin, counted_from, family_between, spanning_joints};

fn internal(e: &LinalgError) -> Failure {
    Failure::internal(e.to_string())
}

/// A family with the parameters that are meant.
pub(super) struct Meant {
    /// Its index.
    pub(super) index: usize,
    /// Formulas with parameters counted from the joints that were named; `None`: its own ones.
    pub(super) formulas: Option<Parametrisation>,
}

/// The family that is meant. Joint names are those of `given`, at the places they have there, which families keep;
/// joints that only `current` has can be named too.
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

/// The places of joints joined by hyphens; names may contain hyphens themselves.
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

/// `P1:P4-P5`, when joints of the platform span the family.
pub(super) fn family_names(
    design: &Design,
    found: &Components,
    family: usize,
) -> Result<Option<String>, Failure> {
    let joints = spanning_joints(design.manipulator(), found, family).map_err(|e| internal(&e))?;
    let join = |list: &[usize], names: &[String]| {
        list.iter().map(|k| names[*k].as_str()).collect::<Vec<_>>().join("-")
    };
    Ok(joints
        .map(|[a, b]| format!("{}:{}", join(&a, design.base_names()), join(&b, design.platform_names()))))
}

/// What can be asked for, in one line.
pub(super) fn list_families(design: &Design, found: &Components) -> Result<String, Failure> {
    if found.components.is_empty() {
        return Ok("no leg of this platform can be moved".to_string());
    }
    let mut entries = Vec::new();
    for (k, c) in found.components.iter().enumerate() {
        let legs: Vec<String> = c.support.iter().map(|l| (l.get() + 1).to_string()).collect();
        let name = family_names(design, found, k)?.map_or(String::new(), |n| format!(" {n}"));
        let (dimension, legs) = (c.dimension, legs.join(" "));
        entries.push(format!("{}{name} ({}, {dimension} parameter(s), legs {legs})", k + 1, c.type_name()));
    }
    Ok(format!("families, with the legs they can replace: {}", entries.join("; ")))
}

/// The design with the joints of the new platform: one that all legs left keeps its name where the first of them goes,
/// the ends of others that left get the name with a letter. `None` when the legs make no platform.
///
/// A new joint that is at one of the `shares` of the way between two joints that stay is constructed there: then it is
/// exact.
pub(super) fn moved_design(design: &Design, new: &Assembled, shares: &[Share]) -> Option<Design> {
    let platform = new.platform.clone().ok()?;
    let points = [platform.base_joints().to_vec(), platform.platform_joints().to_vec()];
    let mut taken: Vec<String> = design.base_names().iter().chain(design.platform_names()).cloned().collect();
    let mut names = |origins: &[JointOrigin], old: &[String]| -> Vec<String> {
        origins
            .iter()
            .map(|o| match o {
                JointOrigin::Kept(k) | JointOrigin::Displaced(k) => old[*k].clone(),
                JointOrigin::Split(k) => fresh(&old[*k], &mut taken),
            })
            .collect()
    };
    let base = names(&new.base, design.base_names());
    let on_platform = names(&new.platform_joints, design.platform_names());
    let built = DesignModel::new(design.name.clone(), design.units.clone(), platform)
        .with_joint_names(base, on_platform);
    let limit = ON_LINE * design.manipulator().size();
    let origins = |body: Body, of: &[JointOrigin]| -> Vec<Origin> {
        let old = design.manipulator().joints(body);
        let kept: Vec<usize> = of.iter().filter_map(JointOrigin::kept).collect();
        // on a line of joints that are still there, else of joints that were
        let all: Vec<usize> = (0..old.len()).collect();
        let within = |list: &[usize]| -> Vec<[usize; 2]> {
            list.iter().flat_map(|i| list.iter().filter(move |j| *j != i).map(move |j| [*i, *j])).collect()
        };
        let lines = [within(&kept), within(&all)].concat();
        let between = |x: &Point3<f64>| {
            let at = |[i, j]: [usize; 2], t: f64| old[i] + (old[j] - old[i]) * t;
            let places = lines.iter().flat_map(|ends| shares.iter().map(move |t| (*ends, t)));
            places.into_iter().find(|(ends, t)| (at(*ends, t.nearest()) - x).norm() <= limit)
        };
        let origin = |(k, o): (usize, &JointOrigin)| match o {
            JointOrigin::Kept(k) => Origin::Kept(*k),
            JointOrigin::Displaced(_) | JointOrigin::Split(_) => between(&points[body.index()][k])
                .map_or(Origin::New, |(ends, t)| Origin::Between(ends, Box::new(t.clone()))),
        };
        of.iter().enumerate().map(origin).collect()
    };
    let kept = [origins(Body::Base, &new.base), origins(Body::Platform, &new.platform_joints)];
    built.ok().map(|d| d.with_tables_of(design).constructed_from(design, [&kept[0], &kept[1]]).into())
}

/// A joint is on a line of others within this share of the size.
const ON_LINE: f64 = 1e-12;

fn fresh(name: &str, taken: &mut Vec<String>) -> String {
    let letters = ('a'..='z').map(|c| format!("{name}{c}"));
    let numbers = (1..).map(|k| format!("{name}_{k}"));
    let new = letters.chain(numbers).find(|n| !taken.contains(n)).unwrap_or_default();
    taken.push(new.clone());
    new
}
