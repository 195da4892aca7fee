//! `[holes]`: grids on which the joints of the plates can be put.

use super::tables::positive;
use super::{check_keys, nearest_help, number, numbers, shown, table, text};
use crate::design::Code;
use crate::design::tree::{Entry, Node, Span, Value, find};
use crate::design::violation::Findings;
use machine::requirements::{Grid, HoleCircle, HoleCircles, HolePattern};

/// The plates, base first.
pub(super) const PLATE_KEYS: [&str; 2] = ["base", "platform"];
/// The keys of a grid.
pub(super) const GRID_KEYS: [&str; 8] =
    ["pattern", "pitch", "first_radius", "radii", "step_deg", "count", "origin", "angle_deg"];
/// Most holes on a circle.
const MOST_HOLES: f64 = 1e6;
/// Share by which a step may miss a whole number of holes.
const WHOLE: f64 = 1e-9;

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
    let known: Vec<&str> = PLATE_KEYS.into_iter().chain(GRID_KEYS).collect();
    check_keys(report, entries, &known, place);
    let is_common = |e: &&Entry| GRID_KEYS.contains(&e.key.as_str());
    let common: Vec<&Entry> = entries.iter().filter(is_common).collect();
    let plates = PLATE_KEYS.map(|key| find(entries, key));
    if common.is_empty() && plates.iter().all(Option::is_none) {
        let help = "add pitch = 25 for both plates, or [holes.base] for one";
        report.refuse(Code::MissingKey, &entry.key_span, format!("{place} has no grid"), help);
        return None;
    }
    // what both plates share is read once, so that its faults are told once
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
            check_keys(report, own, &GRID_KEYS, &place);
            let own: Vec<&Entry> = own.iter().filter(is_common).collect();
            let stated = |key: &str| own.iter().any(|e| e.key == key);
            // another pattern has other keys: none of the common ones is meant for it
            let kept = common.iter().copied().filter(|e| !stated("pattern") && !is_stated(&stated, &e.key));
            let all: Vec<&Entry> = own.iter().copied().chain(kept).collect();
            grid(report, &all, &plate.key_span, &place).map(Some)
        }
    });
    Some([base?, platform?])
}

/// Whether a table has the key, or the other one that says the same thing.
fn is_stated(stated: &impl Fn(&str) -> bool, key: &str) -> bool {
    stated(key) || (key == "count" && stated("step_deg")) || (key == "step_deg" && stated("count"))
}

fn grid(report: &mut Findings<'_>, list: &[&Entry], span: &Span, place: &str) -> Option<Grid> {
    let entries: Vec<Entry> = list.iter().map(|e| (*e).clone()).collect();
    let pattern = match find(&entries, "pattern") {
        None => HolePattern::default(),
        Some(e) => pattern(report, e)?,
    };
    let keys = keys_of(pattern);
    let whose = format!("a {} grid", pattern.name());
    for e in entries.iter().filter(|e| !keys.contains(&e.key.as_str())) {
        let message = format!("`{}` is not a key of {whose}", shown(&e.key));
        report.refuse(Code::UnknownKey, &e.key_span, message, nearest_help("its keys", &e.key, keys));
    }
    let mut needed = |key: &str, help: &str| {
        if keys.contains(&key) && find(&entries, key).is_none() {
            let message = format!("{place} has no `{key}`");
            report.refuse(Code::MissingKey, span, message, help);
        }
    };
    needed("pitch", "add pitch = 25, the distance of neighbouring holes or rings");
    needed("first_radius", "add first_radius = 100, the radius of the innermost ring");
    needed("radii", "add radii = [100, 150], the radii of the bolt circles");
    let origin = match find(&entries, "origin") {
        None => Some([0.0; 2]),
        Some(e) => {
            let what = format!("`origin` of {place}");
            numbers::<2>(report, &e.node, &what, Code::CoordinateCount, "coordinates x, y of a hole")
        }
    };
    let angle_deg = match find(&entries, "angle_deg") {
        None => Some(0.0),
        Some(e) => number(report, &e.node, &format!("`angle_deg` of {place}")),
    };
    let circles = match pattern {
        HolePattern::Square | HolePattern::Triangular => Some(HoleCircles::NONE),
        HolePattern::Polar => {
            let counts = counts(report, &entries, 1, (span, place));
            let radius = positive(report, &entries, "first_radius");
            radius.zip(counts).and_then(|(radius, counts)| {
                HoleCircles::new(&[HoleCircle { radius, holes: *counts.first()? }])
            })
        }
        HolePattern::BoltCircle => radii(report, &entries).and_then(|radii| {
            let counts = counts(report, &entries, radii.len(), (span, place))?;
            let list: Vec<HoleCircle> = radii
                .iter()
                .zip(counts)
                .map(|(radius, holes)| HoleCircle { radius: *radius, holes })
                .collect();
            HoleCircles::new(&list)
        }),
    };
    let pitch = if keys.contains(&"pitch") { positive(report, &entries, "pitch") } else { Some(0.0) };
    Some(Grid { pattern, pitch: pitch?, circles: circles?, origin: origin?, angle_deg: angle_deg? })
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
fn radii(report: &mut Findings<'_>, entries: &[Entry]) -> Option<Vec<f64>> {
    let entry = find(entries, "radii")?;
    let all = one_or_more(report, entry)?;
    if all.is_empty() || all.len() > HoleCircles::MOST {
        let message = format!("`radii` has {} numbers", all.len());
        let help = format!("give 1 to {} radii", HoleCircles::MOST);
        report.refuse(Code::Grid, &entry.node.span, message, help);
        return None;
    }
    for (radius, node) in all.iter().filter(|(radius, _)| *radius <= 0.0) {
        let message = format!("a radius of `radii` is {radius}");
        report.refuse(Code::NotPositive, &node.span, message, "give positive numbers");
    }
    Some(all.into_iter().map(|(radius, _)| radius).collect())
}

/// The numbers of holes of so many circles, from `count` or `step_deg`: one number for all, or one for each.
fn counts(
    report: &mut Findings<'_>,
    entries: &[Entry],
    circles: usize,
    (span, place): (&Span, &str),
) -> Option<Vec<u32>> {
    let entry = match (find(entries, "count"), find(entries, "step_deg")) {
        (Some(_), Some(step)) => {
            let message = format!("{place} gives the holes of a circle by `count` and by `step_deg`");
            report.refuse(Code::ConflictingKeys, &step.key_span, message, "keep one of them");
            return None;
        }
        (None, None) => {
            let message = format!("{place} has neither `count` nor `step_deg`");
            let help = "add count = 24, the number of holes on each circle, or step_deg = 15, the angle between neighbours";
            report.refuse(Code::MissingKey, span, message, help);
            return None;
        }
        (Some(e), None) | (None, Some(e)) => e,
    };
    let all = one_or_more(report, entry)?;
    if all.len() != 1 && all.len() != circles {
        let message = format!("`{}` has {} numbers for circles that are {circles}", entry.key, all.len());
        report.refuse(
            Code::Grid,
            &entry.node.span,
            message,
            "give one number for all circles, or one for each",
        );
        return None;
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
            report.refuse(Code::Grid, &node.span, message, help);
            return None;
        }
        found.extend(u32::try_from(whole as i64));
    }
    Some((0..circles).map(|k| found[if found.len() == 1 { 0 } else { k }]).collect())
}

fn pattern(report: &mut Findings<'_>, entry: &Entry) -> Option<HolePattern> {
    let word = text(report, entry)?;
    let found = HolePattern::ALL.into_iter().find(|p| p.name() == word);
    if found.is_none() {
        let message = format!("`{}` is no pattern of holes", shown(&word));
        let help = nearest_help("patterns", &word, &HolePattern::ALL.map(HolePattern::name));
        report.refuse(Code::UnknownKey, &entry.node.span, message, help);
    }
    found
}
