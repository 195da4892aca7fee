//! `[holes]`: grids for the joints of the plates.

use serde::Serialize;
use serde_json::{Map, Value as Json, json};

use super::found::{check_keys, nearest_help, number, shown, table};
use super::kind::{KeyKind, KeyShape, Numbers, any, numbers, own, positive, table as table_of, unit, word};
use super::stored::{Stored, Word};
use super::{Code, FoundKey, KeyTable, key};
use crate::design::tree::{Entry, Node, Span, Value, find};
use crate::design::violation::Findings;
use machine::requirements::{Grid, HoleCircle, HoleCircles, HolePattern};
use platform::manipulator::Body;

/// Greatest number of holes on a circle.
const MOST_HOLES: f64 = 1e6;
/// Greatest relative deviation of a step from a whole number of holes.
const WHOLE: f64 = 1e-9;

static ORIGIN: Numbers = Numbers::coordinates(2, "coordinates x, y of a hole");
const LENGTHS: KeyKind = own(
    r##"{"oneOf": [{"$ref": "#/$defs/positive"}, {"type": "array", "minItems": 1, "maxItems": 16, "items": {"$ref": "#/$defs/positive"}}]}"##,
    unit::LENGTH,
);

const COUNTS: KeyKind = own(
    r#"{"oneOf": [
        {"type": "integer", "minimum": 1, "maximum": 1000000},
        {"type": "array", "minItems": 1, "maxItems": 16, "items": {"type": "integer", "minimum": 1, "maximum": 1000000}}
    ]}"#,
    unit::NONE,
);

/// A grid, as it is written.
#[derive(Default)]
struct GridKeys {
    pattern: Option<HolePattern>,
    pitch: Option<f64>,
    first_radius: Option<f64>,
    radii: Option<Vec<f64>>,
    counts: Vec<u32>,
    origin: Option<[f64; 2]>,
    angle_deg: Option<f64>,
}

static GRID: KeyTable<GridKeys> = KeyTable {
    definition: "hole_grid",
    keys: &[
        key!("pattern" { default = r#""square""# }: word(HolePattern::words),
            |found, to| to.pattern = pattern(found), |of| of.pattern.unwrap_or_default().written();
            ""),
        key!("pitch": positive(unit::LENGTH), pitch;
            "distance of neighbouring holes, or of the rings of a polar grid"),
        key!("first_radius": positive(unit::LENGTH), first_radius;
            "radius of the innermost ring of a polar grid"),
        key!("radii": LENGTHS,
            |found, to| to.radii = radii(found.report, found.entry), |of| list(of.radii.as_ref()?);
            "radii of bolt circles"),
        key!("step_deg": KeyKind { unit: unit::DEGREES, ..LENGTHS };
            "angle between neighbouring holes of a ring or of each bolt circle; a whole number of them makes 360"),
        key!("count": COUNTS,
            |_, _| (),
            |of| match of.pattern? {
                HolePattern::Polar => Some(json!(of.counts.first()?)),
                _ => list(&of.counts),
            };
            "number of holes of a ring or of each bolt circle, instead of step_deg"),
        key!("origin" { default = "[0, 0]" }: numbers(&ORIGIN, unit::LENGTH).placed(), origin;
            "a hole, or the centre of the circles"),
        key!("angle_deg" { default = "0" }: any(unit::DEGREES).placed(), angle_deg; "turn of the grid"),
    ],
    ..KeyTable::EMPTY
};

/// The keys of `[holes]` beside those of a grid for both plates.
pub(super) static HOLES: KeyTable<[Option<Grid>; 2]> = KeyTable {
    keys: &[
        key!("base": table_of(&GRID),
            |_, _| (), |of| GRID.put(&GridKeys::from(of[0].as_ref()?));
            "of the base alone: keys instead of the common ones, or with pattern instead of all of them"),
        key!("platform": table_of(&GRID),
            |_, _| (),
            |of| GRID
            .put(&GridKeys::from(of[1].as_ref()?));
            "of the platform alone, likewise"),
    ],
    rules: r#"{"minProperties": 1}"#,
    ..KeyTable::EMPTY
};

/// `[holes]`: the keys of a grid for both plates, and grids of single plates.
pub(super) struct HolesShape;

pub(super) static HOLES_SHAPE: HolesShape = HolesShape;

impl KeyShape for HolesShape {
    fn kind(&self, key: &str) -> Option<KeyKind> {
        HOLES.kind(key).or_else(|| GRID.kind(key))
    }

    fn renamed(&self, old: &str) -> Option<&'static str> {
        HOLES.renamed(old).or_else(|| GRID.renamed(old))
    }

    fn schema(&self, definitions: &mut Map<String, Json>) -> Json {
        let mut out = HOLES.schema(definitions);
        for key in GRID.names() {
            out["properties"][key] = json!({"$ref": format!("#/$defs/hole_grid/properties/{key}")});
        }
        out
    }
}

/// The keys that a grid of a pattern can have.
fn keys_of(pattern: HolePattern) -> &'static [&'static str] {
    match pattern {
        HolePattern::Square | HolePattern::Triangular => &["pattern", "pitch", "origin", "angle_deg"],
        HolePattern::Polar => {
            &["pattern", "first_radius", "pitch", "step_deg", "count", "origin", "angle_deg"]
        }
        HolePattern::BoltCircle => &["pattern", "radii", "step_deg", "count", "origin", "angle_deg"],
    }
}

/// `[holes]`: keys for both plates, and tables for each.
pub(super) fn holes(report: &mut Findings<'_>, top: &[Entry]) -> Option<[Option<Grid>; 2]> {
    let place = "[holes]";
    let entry = find(top, "holes")?;
    let entries = table(report, &entry.node, place)?;
    let known: Vec<&str> = HOLES.names().into_iter().chain(GRID.names()).collect();
    check_keys(report, entries, &known, place);
    let is_common = |e: &&Entry| GRID.kind(&e.key).is_some();
    let common: Vec<&Entry> = entries.iter().filter(is_common).collect();
    let plates = Body::BOTH.map(|body| find(entries, body.name()));
    if common.is_empty() && plates.iter().all(Option::is_none) {
        let help = "add pitch = 25 for both plates, or [holes.base] for one";
        return report.refused(Code::MissingKey, &entry.key_span, format!("{place} has no grid"), help);
    }
    // keys of both plates are read once, so their faults are reported once
    let shared = if plates.iter().any(Option::is_none) && !common.is_empty() {
        Some(grid(report, &common, &entry.key_span, place)?)
    } else {
        None
    };
    let [base, platform] = plates.map(|plate| match plate {
        None => Some(shared),
        Some(plate) => {
            let place = format!("`{}` of {place}", plate.key);
            let own = table(report, &plate.node, &place)?;
            check_keys(report, own, &GRID.names(), &place);
            let own: Vec<&Entry> = own.iter().filter(is_common).collect();
            let stated = |key: &str| own.iter().any(|e| e.key == key);
            // another pattern has other keys, so it takes none of the common ones
            let kept = common.iter().copied().filter(|e| !stated("pattern") && !is_stated(&stated, &e.key));
            let all: Vec<&Entry> = own.iter().copied().chain(kept).collect();
            grid(report, &all, &plate.key_span, &place).map(Some)
        }
    });
    Some([base?, platform?])
}

/// Whether a table has the key, or its alternative.
fn is_stated(stated: &impl Fn(&str) -> bool, key: &str) -> bool {
    stated(key) || (key == "count" && stated("step_deg")) || (key == "step_deg" && stated("count"))
}

fn grid(report: &mut Findings<'_>, list: &[&Entry], span: &Span, place: &str) -> Option<Grid> {
    let entries: Vec<Entry> = list.iter().map(|e| (*e).clone()).collect();
    let mut grid = GridKeys::default();
    GRID.fill(report, &entries, place, &mut grid, |key| key == "pattern");
    let pattern = match find(&entries, "pattern") {
        None => HolePattern::default(),
        Some(_) => grid.pattern?,
    };
    let keys = keys_of(pattern);
    let whose = format!("a {} grid", pattern.name());
    for e in entries.iter().filter(|e| !keys.contains(&e.key.as_str())) {
        let message = format!("`{}` is not a key of {whose}", shown(&e.key));
        report.refuse(Code::UnknownKey, &e.key_span, message, nearest_help("its keys", &e.key, keys));
    }
    for (key, help) in [
        ("pitch", "add pitch = 25, the distance of neighbouring holes or rings"),
        ("first_radius", "add first_radius = 100, the radius of the innermost ring"),
        ("radii", "add radii = [100, 150], the radii of the bolt circles"),
    ] {
        if keys.contains(&key) && find(&entries, key).is_none() {
            report.refuse(Code::MissingKey, span, format!("{place} has no `{key}`"), help);
        }
    }
    GRID.fill(report, &entries, place, &mut grid, |key| key != "pattern" && keys.contains(&key));
    let first = || Some(vec![grid.first_radius?]);
    let (radii, count) = match pattern {
        HolePattern::Square | HolePattern::Triangular => (None, None),
        HolePattern::Polar => (first(), Some(1)),
        HolePattern::BoltCircle => (grid.radii.clone(), grid.radii.as_ref().map(Vec::len)),
    };
    let counts = count.and_then(|count| counts(report, &entries, count, (span, place)));
    let circles = match pattern {
        HolePattern::Square | HolePattern::Triangular => Some(HoleCircles::NONE),
        HolePattern::Polar | HolePattern::BoltCircle => radii.zip(counts).and_then(|(radii, counts)| {
            let circle = |(radius, holes)| HoleCircle { radius, holes };
            HoleCircles::new(&radii.into_iter().zip(counts).map(circle).collect::<Vec<_>>())
        }),
    };
    let known = |key: &str, value: Option<f64>| value.or(Some(0.0).filter(|_| find(&entries, key).is_none()));
    Some(Grid {
        pattern,
        pitch: known("pitch", grid.pitch)?,
        circles: circles?,
        origin: grid.origin.or(Some([0.0; 2]).filter(|_| find(&entries, "origin").is_none()))?,
        angle_deg: known("angle_deg", grid.angle_deg)?,
    })
}

impl From<&Grid> for GridKeys {
    fn from(g: &Grid) -> Self {
        let circles = g.circles.as_slice();
        let is_bolts = g.pattern == HolePattern::BoltCircle;
        let first = circles.first().filter(|_| g.pattern == HolePattern::Polar);
        Self {
            pattern: Some(g.pattern),
            pitch: Some(g.pitch).filter(|_| !is_bolts),
            first_radius: first.map(|circle| circle.radius),
            radii: is_bolts.then(|| circles.iter().map(|circle| circle.radius).collect()),
            counts: circles.iter().map(|circle| circle.holes).collect(),
            origin: Some(g.origin),
            angle_deg: Some(g.angle_deg),
        }
    }
}

/// The numbers of a value that is a number or a list of them, with their nodes.
fn one_or_more<'a>(report: &mut Findings<'_>, entry: &'a Entry) -> Option<Vec<(f64, &'a Node)>> {
    let list = match &entry.node.value {
        Value::Array(list) => list.iter().collect(),
        _ => vec![&entry.node],
    };
    let what = format!("`{}`", entry.key);
    let all: Vec<Option<f64>> = list.iter().map(|node| number(report, node, &what)).collect();
    Some(all.into_iter().collect::<Option<Vec<f64>>>()?.into_iter().zip(list).collect())
}

/// `radii`.
fn radii(report: &mut Findings<'_>, entry: &Entry) -> Option<Vec<f64>> {
    let all = one_or_more(report, entry)?;
    if all.is_empty() || all.len() > HoleCircles::MOST {
        let message = format!("`radii` has {} numbers", all.len());
        let help = format!("give 1 to {} radii", HoleCircles::MOST);
        return report.refused(Code::Grid, &entry.node.span, message, help);
    }
    for (radius, node) in all.iter().filter(|(radius, _)| *radius <= 0.0) {
        let message = format!("a radius of `radii` is {radius}");
        report.refuse(Code::NotPositive, &node.span, message, "give positive numbers");
    }
    Some(all.into_iter().map(|(radius, _)| radius).collect())
}

/// The numbers of holes of `circles`, from `count` or `step_deg`: one number for all, or one for each.
fn counts(
    report: &mut Findings<'_>,
    entries: &[Entry],
    circles: usize,
    (span, place): (&Span, &str),
) -> Option<Vec<u32>> {
    let entry = match (find(entries, "count"), find(entries, "step_deg")) {
        (Some(_), Some(step)) => {
            let message = format!("{place} gives the holes of a circle by `count` and by `step_deg`");
            return report.refused(Code::ConflictingKeys, &step.key_span, message, "keep one of them");
        }
        (None, None) => {
            let message = format!("{place} has neither `count` nor `step_deg`");
            let help = "add count = 24, the number of holes on each circle, or step_deg = 15, the angle between neighbours";
            return report.refused(Code::MissingKey, span, message, help);
        }
        (Some(e), None) | (None, Some(e)) => e,
    };
    let all = one_or_more(report, entry)?;
    if all.len() != 1 && all.len() != circles {
        let message = format!("`{}` has {} numbers for circles that are {circles}", entry.key, all.len());
        return report.refused(
            Code::Grid,
            &entry.node.span,
            message,
            "give one number for all circles, or one for each",
        );
    }
    let mut found = Vec::new();
    for (x, node) in &all {
        let count = if entry.key == "step_deg" { 360.0 / x } else { *x };
        let whole = count.round();
        if !(1.0..=MOST_HOLES).contains(&whole) || (count - whole).abs() > WHOLE * whole {
            let (message, help) = (
                format!("`{}` is {x}", entry.key),
                match entry.key.as_str() {
                    "step_deg" => "give an angle that goes into 360 degrees a whole number of times",
                    _ => "give a whole number of holes, at least 1",
                },
            );
            return report.refused(Code::Grid, &node.span, message, help);
        }
        found.extend(u32::try_from(whole as i64));
    }
    Some((0..circles).map(|k| found[if found.len() == 1 { 0 } else { k }]).collect())
}

fn pattern(found: &mut FoundKey<'_, '_>) -> Option<HolePattern> {
    let word = found.text()?;
    let pattern = HolePattern::of(&word);
    if pattern.is_none() {
        let help = nearest_help("patterns", &word, &HolePattern::words());
        found.refuse(Code::UnknownKey, format!("`{}` is no pattern of holes", shown(&word)), help);
    }
    pattern
}

fn list<T: Serialize>(list: &[T]) -> Option<Json> {
    (!list.is_empty()).then(|| json!(list))
}
