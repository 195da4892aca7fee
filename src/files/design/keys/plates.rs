//! `[plates]`: the plates that carry the joints.

use serde_json::{Value as Json, json};

use super::found::{nearest_help, shown};
use super::kind::{KeyKind, any, not_negative, positive, table, unit, whole, word};
use super::stored::{StoredValue, Word};
use super::{Code, FoundKey, KeyTable, TEXT, key};
use crate::design::DesignModel;
use crate::design::scale::micrometres;
use crate::design::tree::{Entry, find};
use crate::design::violation::Findings;
use machine::requirements::{BoltPattern, BoltsFrom, Hardware, MATERIALS, PlateDesign, PlateMass, Plates};
use platform::manipulator::Body;

/// Most bolts of a joint.
const MOST_BOLTS: u32 = 64;

static BOLTS: KeyTable<BoltPattern> = KeyTable {
    definition: "bolts",
    keys: &[
        key!("count" { required = BOLTS_TAKE }: whole(1, MOST_BOLTS),
            |found, to| to.count = bolt_count(found), |of| Some(json!(of.count));
            "bolts of a joint"),
        key!("circle" { required = BOLTS_TAKE }: positive(unit::LENGTH), circle; "diameter of their circle"),
        key!("hole" { required = BOLTS_TAKE }: positive(unit::LENGTH), hole; "diameter of their holes"),
        key!("first_deg" { default = "0" }: any(unit::DEGREES), first_deg; "angle of the first one, degrees"),
        key!("from" { default = r#""axis""# }: word(BoltsFrom::words), from;
            "from where it counts: from the first axis of the plate, or from the direction from the origin of the plate to the joint"),
    ],
    ..KeyTable::EMPTY
};
const BOLTS_TAKE: &str = "bolts take count, circle (its diameter) and hole, and may take first_deg and from";

static PLATE: KeyTable<PlateDesign> = KeyTable {
    definition: "plate",
    keys: &[
        key!("thickness" { required = "add thickness = 20" }: positive(unit::LENGTH), thickness; "thickness"),
        key!("margin" { required = "add margin = 60, the distance of the outline from the hull of the joints" }: positive(unit::LENGTH), margin;
            "distance of the outline from the convex hull of the joints, more than half of `hole`"),
        key!("hole" { required = "add hole = 20, the diameter of the hole under each joint" }: positive(unit::LENGTH), hole;
            "diameter of the hole under each joint"),
        key!("height": positive(unit::LENGTH), height;
            "height of the lowest joint centre above the face of the plate; without it that of a ball as wide as the housing on the edge of the hole"),
        key!("material": TEXT, material;
            "`aluminium`, `steel`, `stainless_steel`, `cast_iron`, `titanium`, `brass`, `pom` or `plywood`, whose densities are known, or another name beside `density`"),
        key!("density": positive(unit::NONE), density;
            "kg/m^3; `units` is then a unit of length that is known"),
        key!("edge_distance" { default = "0" }: not_negative(unit::LENGTH), edge_distance;
            "least distance of the edge of a hole from the outline"),
        key!("hole_distance" { default = "0" }: not_negative(unit::LENGTH), hole_distance;
            "least distance of the edges of two holes"),
        key!("foot": positive(unit::LENGTH), foot; "diameter of the round foot of a joint; feet keep apart"),
        key!("bolts": table(&BOLTS), bolts; "the bolts of each joint, on a circle about its centre"),
    ],
    ..KeyTable::EMPTY
};

const PLATE_KIND: KeyKind = table(&PLATE);

pub(super) static PLATES: KeyTable<Plates> = KeyTable {
    keys: &[
        key!("base": PLATE_KIND, |_, _| (), |of| PLATE.put(of.base.as_ref()?); "plate of the base"),
        key!("platform": PLATE_KIND, |_, _| (), |of| PLATE.put(of.platform.as_ref()?); "plate of the platform"),
    ],
    rules: r#"{"minProperties": 1}"#,
    ..KeyTable::EMPTY
};

/// `[plates.base]` and `[plates.platform]`; `units` is the label of the unit of length.
pub(super) fn plates(
    report: &mut Findings<'_>,
    top: &[Entry],
    hardware: &Hardware,
    units: Option<&str>,
) -> Plates {
    let Some(entry) = find(top, "plates") else { return Plates::default() };
    let place = "[plates]";
    let entries = PLATES.read(report, &entry.node, place, &mut Plates::default()).unwrap_or_default();
    if entries.is_empty() {
        let help = "add [plates.base] or [plates.platform] with thickness, margin and hole";
        report.refuse(Code::MissingKey, &entry.key_span, format!("{place} has no plate"), help);
    }
    let [base, platform] =
        Body::BOTH.map(|body| plate(report, find(entries, body.name())?, (hardware, body), units));
    Plates { base, platform }
}

fn plate(
    report: &mut Findings<'_>,
    entry: &Entry,
    (hardware, body): (&Hardware, Body),
    units: Option<&str>,
) -> Option<PlateDesign> {
    let place = format!("`{}` of [plates]", entry.key);
    let mut plate = PlateDesign {
        thickness: f64::NAN,
        margin: f64::NAN,
        hole: f64::NAN,
        height: None,
        material: None,
        density: None,
        edge_distance: 0.0,
        hole_distance: 0.0,
        foot: None,
        bolts: None,
    };
    let entries = PLATE.read(report, &entry.node, &place, &mut plate)?;
    PLATE.require(report, entries, (&entry.key_span, &place), |_| true);
    let (margin, hole) = (plate.margin, plate.hole);
    let mut refuse = |key: &str, message: String, help: &str| {
        let span = find(entries, key).map_or(0..0, |e| e.node.span.clone());
        report.refuse(Code::OutOfRange, &span, message, help);
    };
    if 2.0 * margin <= hole {
        let help = "a hole has to end inside the outline: give a margin of more than half of it";
        refuse("margin", format!("a `margin` of {margin} with holes of {hole}"), help);
    }
    // the narrowest joint must sit on its hole too
    let housing = hardware.joint_widths(body).map(|[least, _]| least);
    match (find(entries, "height"), housing) {
        (None, None) => {
            let message = format!("{place} does not say how high the joints are above it");
            let help = "add `height`, that of the joint centres above the face, or a housing to [hardware]: a ball that sits on the hole";
            report.refuse(Code::MissingKey, &entry.key_span, message, help);
        }
        (None, Some(housing)) if hole >= housing => {
            let help = "a ball has to be wider than the hole below it: give a smaller hole, or the `height` of the joints";
            refuse("hole", format!("a `hole` of {hole} under housings of {housing}"), help);
        }
        _ => {}
    }
    check_material(report, entries, plate.material.as_deref(), units);
    let is_whole = [plate.thickness, margin, hole].iter().all(|x| !x.is_nan());
    is_whole.then_some(plate)
}

/// The density of the material must be known or given. A mass follows from it only in known units of length.
fn check_material(report: &mut Findings<'_>, entries: &[Entry], material: Option<&str>, units: Option<&str>) {
    let (named, density) = (find(entries, "material"), find(entries, "density"));
    let names = MATERIALS.map(|m| m.0);
    if let (Some(e), Some(name), None) = (named, material, density)
        && !names.contains(&name)
    {
        let message = format!("the density of `material` \"{}\" is not known", shown(name));
        let help = format!("add `density`, kg/m^3; {}", nearest_help("known materials", name, &names));
        report.refuse(Code::MissingKey, &e.node.span, message, help);
    }
    if let (Some(e), Some(units)) = (density.or(named), units)
        && micrometres(units).is_none()
    {
        let message = format!("the mass of a plate needs a known unit of length, not \"{}\"", shown(units));
        let help = "write units = \"mm\", \"m\" or \"in\", for instance";
        report.refuse(Code::WrongType, &e.key_span, message, help);
    }
}

impl StoredValue for BoltPattern {
    fn take(found: &mut FoundKey<'_, '_>) -> Option<Self> {
        let place = "`bolts`";
        let mut bolts =
            Self { count: 0, circle: f64::NAN, hole: f64::NAN, first_deg: 0.0, from: BoltsFrom::default() };
        let entries = found.table(&BOLTS, place, &mut bolts)?;
        for key in ["count", "circle", "hole"].into_iter().filter(|key| find(entries, key).is_none()) {
            found.refuse(Code::MissingKey, format!("`{key}` of {place} is missing"), BOLTS_TAKE);
        }
        (bolts.count > 0).then_some(bolts)
    }

    fn json(&self) -> Json {
        json!(BOLTS.write(self))
    }
}

/// A whole number; 0 where there is none.
fn bolt_count(found: &mut FoundKey<'_, '_>) -> u32 {
    found.kind = positive(unit::NONE);
    let Some(count) = found.number() else { return 0 };
    let whole = (1..=MOST_BOLTS).find(|n| (f64::from(*n) - count).abs() < f64::EPSILON);
    if whole.is_none() && count > 0.0 {
        let help = format!("give a whole number from 1 to {MOST_BOLTS}");
        found.refuse(Code::OutOfRange, format!("`count` is {count}"), help);
    }
    whole.unwrap_or_default()
}

/// A payload that includes the plate must weigh at least as much; for an added plate the mass must be known.
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
