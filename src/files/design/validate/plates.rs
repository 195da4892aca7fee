//! `[plates]`: the plates that carry the joints.

use super::tables::{not_negative, positive};
use super::{check_keys, nearest_help, number, shown, table, text};
use crate::design::scale::micrometres;
use crate::design::tree::{Entry, find};
use crate::design::violation::Findings;
use crate::design::{Code, DesignModel};
use machine::requirements::{BoltPattern, BoltsFrom, Hardware, MATERIALS, PlateDesign, PlateMass, Plates};
use platform::manipulator::Body;

/// The plates, base first.
pub(super) const PLATES_KEYS: [&str; 2] = ["base", "platform"];
pub(super) const PLATE_TABLE_KEYS: [&str; 10] = [
    "thickness",
    "margin",
    "hole",
    "height",
    "material",
    "density",
    "edge_distance",
    "hole_distance",
    "foot",
    "bolts",
];
pub(super) const BOLT_KEYS: [&str; 5] = ["count", "circle", "hole", "first_deg", "from"];
/// Most bolts of a joint.
const MOST_BOLTS: f64 = 64.0;

/// `[plates.base]` and `[plates.platform]`; `units` is the label of the unit of length.
pub(super) fn plates(
    report: &mut Findings<'_>,
    top: &[Entry],
    hardware: &Hardware,
    units: Option<&str>,
) -> Plates {
    let Some(entry) = find(top, "plates") else { return Plates::default() };
    let place = "[plates]";
    let entries = table(report, &entry.node, place).unwrap_or_default();
    check_keys(report, entries, &PLATES_KEYS, place);
    if entries.is_empty() {
        let help = "add [plates.base] or [plates.platform] with thickness, margin and hole";
        report.refuse(Code::MissingKey, &entry.key_span, format!("{place} has no plate"), help);
    }
    let [base, platform] = Body::BOTH.map(|body| {
        let entry = find(entries, PLATES_KEYS[body.index()])?;
        plate(report, entry, hardware, body, units)
    });
    Plates { base, platform }
}

fn plate(
    report: &mut Findings<'_>,
    entry: &Entry,
    hardware: &Hardware,
    body: Body,
    units: Option<&str>,
) -> Option<PlateDesign> {
    let place = format!("`{}` of [plates]", entry.key);
    let entries = table(report, &entry.node, &place)?;
    check_keys(report, entries, &PLATE_TABLE_KEYS, &place);
    for (key, help) in [
        ("thickness", "add thickness = 20"),
        ("margin", "add margin = 60, the distance of the outline from the hull of the joints"),
        ("hole", "add hole = 20, the diameter of the hole under each joint"),
    ] {
        if find(entries, key).is_none() {
            report.refuse(Code::MissingKey, &entry.key_span, format!("{place} has no `{key}`"), help);
        }
    }
    let [thickness, margin, hole] = ["thickness", "margin", "hole"].map(|key| positive(report, entries, key));
    if let (Some(margin), Some(hole), Some(e)) = (margin, hole, find(entries, "margin"))
        && 2.0 * margin <= hole
    {
        let message = format!("a `margin` of {margin} with holes of {hole}");
        let help = "a hole has to end inside the outline: give a margin of more than half of it";
        report.refuse(Code::OutOfRange, &e.node.span, message, help);
    }
    let height = positive(report, entries, "height");
    // the narrowest joint sits on its hole too
    let housing = hardware.joint_widths(body).map(|[least, _]| least);
    match (find(entries, "height"), housing, hole) {
        (None, None, _) => {
            let message = format!("{place} does not say how high the joints are above it");
            let help = "add `height`, that of the joint centres above the face, or a housing to [hardware]: a ball that sits on the hole";
            report.refuse(Code::MissingKey, &entry.key_span, message, help);
        }
        (None, Some(housing), Some(hole)) if hole >= housing => {
            let message = format!("a `hole` of {hole} under housings of {housing}");
            let help = "a ball has to be wider than the hole it sits on: give a smaller hole, or the `height` of the joints";
            let span = find(entries, "hole").map_or(0..0, |e| e.node.span.clone());
            report.refuse(Code::OutOfRange, &span, message, help);
        }
        _ => {}
    }
    let (material, density) = material(report, entries, units);
    let foot = positive(report, entries, "foot");
    let edge_distance = not_negative(report, entries, "edge_distance").unwrap_or_default();
    let hole_distance = not_negative(report, entries, "hole_distance").unwrap_or_default();
    let bolts = find(entries, "bolts").map(|e| bolts(report, e));
    Some(PlateDesign {
        thickness: thickness?,
        margin: margin?,
        hole: hole?,
        height,
        material,
        density,
        edge_distance,
        hole_distance,
        foot,
        bolts: bolts.flatten(),
    })
}

/// Name and density. A density makes a mass in known units of length alone.
fn material(
    report: &mut Findings<'_>,
    entries: &[Entry],
    units: Option<&str>,
) -> (Option<String>, Option<f64>) {
    let density = positive(report, entries, "density");
    let named = find(entries, "material");
    let material = named.and_then(|e| text(report, e));
    let names = MATERIALS.map(|m| m.0);
    if let (Some(e), Some(name), None) = (named, &material, find(entries, "density"))
        && !names.contains(&name.as_str())
    {
        let message = format!("the density of `material` \"{}\" is not known", shown(name));
        let help = format!("add `density`, kg/m^3; {}", nearest_help("known materials", name, &names));
        report.refuse(Code::MissingKey, &e.node.span, message, help);
    }
    if let (Some(e), Some(units)) = (find(entries, "density").or(named), units)
        && micrometres(units).is_none()
    {
        let message = format!("the mass of a plate needs a known unit of length, not \"{}\"", shown(units));
        let help = "write units = \"mm\", \"m\" or \"in\", for instance";
        report.refuse(Code::WrongType, &e.key_span, message, help);
    }
    (material, density)
}

fn bolts(report: &mut Findings<'_>, entry: &Entry) -> Option<BoltPattern> {
    let place = "`bolts`";
    let entries = table(report, &entry.node, place)?;
    check_keys(report, entries, &BOLT_KEYS, place);
    for key in BOLT_KEYS[..3].iter().filter(|key| find(entries, key).is_none()) {
        let message = format!("`{key}` of {place} is missing");
        let help = "bolts take count, circle (its diameter) and hole, and may take first_deg and from";
        report.refuse(Code::MissingKey, &entry.node.span, message, help);
    }
    let count = positive(report, entries, "count");
    if let (Some(count), Some(e)) = (count, find(entries, "count"))
        && count > 0.0
        && !(count.fract() == 0.0 && count <= MOST_BOLTS)
    {
        let help = format!("give a whole number from 1 to {MOST_BOLTS}");
        report.refuse(Code::OutOfRange, &e.node.span, format!("`count` is {count}"), help);
    }
    let [circle, hole] = ["circle", "hole"].map(|key| positive(report, entries, key));
    let first_deg = find(entries, "first_deg").and_then(|e| number(report, &e.node, "`first_deg`"));
    let from = find(entries, "from").and_then(|e| {
        let word = text(report, e)?;
        let known = BoltsFrom::ALL.into_iter().find(|from| from.name() == word);
        if known.is_none() {
            let message = format!("`from` is \"{}\"", shown(&word));
            report.refuse(Code::WrongType, &e.node.span, message, "write \"axis\" or \"centre\"");
        }
        known
    });
    let count = count.filter(|c| (1.0..=MOST_BOLTS).contains(c) && c.fract() == 0.0)?;
    Some(BoltPattern {
        count: (1..=64).find(|n| (f64::from(*n) - count).abs() < f64::EPSILON)?,
        circle: circle?,
        hole: hole?,
        first_deg: first_deg.unwrap_or_default(),
        from: from.unwrap_or_default(),
    })
}

/// A payload that has the plate in its mass weighs no less than the plate, and one that has it added knows its mass.
pub(super) fn check_masses(report: &mut Findings<'_>, top: &[Entry], design: &DesignModel) {
    let (Some(payload), Some(entry)) = (design.payload, find(top, "payload")) else { return };
    let plate = design.plate_mass(Body::Platform);
    let unit = design.mass_unit();
    match (payload.plate, plate) {
        (PlateMass::Included, Some(plate)) if plate > payload.mass * unit.kilograms() => {
            let message = format!(
                "the payload with the platform weighs {} {}, and the plate of the platform alone {}",
                payload.mass,
                unit.label(),
                plate / unit.kilograms()
            );
            let help = "give `mass` with the plate, or write plate = \"added\" for a mass without it";
            report.refuse(Code::OutOfRange, &entry.key_span, message, help);
        }
        (PlateMass::Added, None) => {
            let message = "the plate is to be added to the payload, and its mass is not known";
            let help = "add [plates.platform] with `material` or `density`, or remove `plate`";
            report.refuse(Code::MissingKey, &entry.key_span, message, help);
        }
        _ => {}
    }
}
