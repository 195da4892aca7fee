//! `[workspace]`: the poses to reach.

use serde_json::{Value as Json, json};

use super::found::{number, shown};
use super::kind::{KeyKind, list, list_of, own, table, unit, vector, word};
use super::poses::{POSE, poses};
use super::stored::{StoredValue, Word};
use super::{Code, FoundKey, KeyTable, TEXT, key};
use crate::design::tree::{Entry, Node, Value, find};
use crate::design::violation::Findings;
use crate::design::{Trajectory, Workspace};
use machine::requirements::{CoordinateRange, ListedFrom, Region};
use nalgebra::Vector3;

const INTERVAL: KeyKind =
    own(r##"{"oneOf": [{"$ref": "#/$defs/not_negative"}, {"$ref": "#/$defs/around_home"}]}"##, unit::LENGTH);
const ANGLE_INTERVAL: KeyKind = own(
    r##"{"oneOf": [{"type": "number", "minimum": 0, "maximum": 180}, {"$ref": "#/$defs/degrees_around_home"}]}"##,
    unit::DEGREES,
);

/// Greatest end of an interval of angles, degrees.
const HALF_TURN: f64 = 180.0;

/// A range of a single coordinate.
macro_rules! range {
    ($name:literal, $kind:expr, $k:literal, $most:expr; $says:literal) => {
        key!($name: $kind,
            |found, to| {
                let entry = found.entry;
                to[$k] = interval(found.report, &entry.node, &entry.key, $most).unwrap_or_default();
            },
            |of: &[CoordinateRange; 6]| (!of[$k].is_still()).then(|| written(of[$k]));
            $says)
    };
}

/// `ranges` of `[workspace]`.
static RANGES: KeyTable<[CoordinateRange; 6]> = KeyTable {
    keys: &[
        range!("x", INTERVAL, 0, f64::INFINITY; "along x of the base frame"),
        range!("y", INTERVAL, 1, f64::INFINITY; "along y of the base frame"),
        range!("z", INTERVAL, 2, f64::INFINITY; "along z of the base frame"),
        range!("roll_deg", ANGLE_INTERVAL, 3, HALF_TURN; "about x of the base frame, degrees"),
        range!("pitch_deg", ANGLE_INTERVAL, 4, HALF_TURN; "about y of the base frame, degrees"),
        range!("yaw_deg", ANGLE_INTERVAL, 5, HALF_TURN; "about z of the base frame, degrees"),
    ],
    ..KeyTable::EMPTY
};

pub(super) static WORKSPACE: KeyTable<Workspace> = KeyTable {
    keys: &[
        key!("translation" { default = "[0, 0, 0]" }: list_of(3, &INTERVAL),
            |found, to| to.translation = intervals(found, f64::INFINITY).unwrap_or(to.translation),
            |of| Some(json!(of.translation.map(written)));
            "intervals along x, y, z of the base frame, measured from home: half widths, or pairs `[min, max]`"),
        key!("rotation_deg" { default = "[0, 0, 0]" }: list_of(3, &ANGLE_INTERVAL),
            |found, to| to.rotation_deg = intervals(found, HALF_TURN).unwrap_or(to.rotation_deg),
            |of| Some(json!(of.rotation_deg.map(written)));
            "intervals of the components of the rotation vector from home, degrees: half widths, or pairs `[min, max]`"),
        key!("pivot": vector(unit::LENGTH),
            |found, to| to.pivot = found.numbers::<3>().map(Vector3::from),
            |of| of.pivot.map(|pivot| pivot.json());
            "the point of the platform about which region and ranges rotate, platform frame; default: `pivot` of `[frames]`, or the origin"),
        key!("ranges": table(&RANGES),
            |found, to| {
                found.table(&RANGES, "`ranges` of [workspace]", &mut to.ranges);
            },
            |of| RANGES.put(&of.ranges);
            "travel of single coordinates, each moved alone from home: `x`, `y`, `z`, `roll_deg`, `pitch_deg`, `yaw_deg`, each a half width or a pair `[min, max]`"),
        key!("grid" { default = "2" }: own(r#"{"enum": [1, 2, 3, 4, 5]}"#, unit::NONE),
            |found, to| to.grid = grid(found).unwrap_or(to.grid), |of| Some(json!(of.grid));
            "points for each axis, evenly over its interval"),
        key!("region" { default = r#""box""# }: word(Region::words),
            |found, to| to.region = region(found),
            |of| Some(of.region.json()).filter(|_| of.region != Region::default());
            "a box, or translations in an ellipsoid that touches the box and rotation vectors in another"),
        key!("poses": list(&table(&POSE)),
            |found, to| to.poses = poses(found),
            |of| {
                let poses = of.poses.iter().map(|pose| json!(POSE.write(pose)));
                (!of.poses.is_empty()).then(|| poses.collect())
            };
            "single poses, measured from `relative_to`"),
        key!("trajectory": TEXT,
            |found, to| to.trajectory = found.text().map(|file| Trajectory { file, poses: Vec::new() }),
            |of| Some(json!(of.trajectory.as_ref()?.file));
            "CSV file beside the design, one pose a line: `x,y,z,roll_deg,pitch_deg,yaw_deg` or `x,y,z,qw,qx,qy,qz`; passed in this order, measured from `relative_to`"),
        key!("relative_to" { default = r#""base""# }: word(ListedFrom::words),
            |found, to| found.fill(&mut to.listed_from),
            |of| Some(of.listed_from.json()).filter(|_| of.listed_from != ListedFrom::default());
            "reference of poses and trajectory: `home`, so that (R, p) means (R R_home, p_home + p), or the base frame"),
    ],
    ..KeyTable::EMPTY
};

/// `[workspace]`.
pub(super) fn workspace(report: &mut Findings<'_>, top: &[Entry]) -> Workspace {
    let mut result = Workspace::default();
    let Some(entry) = find(top, "workspace") else { return result };
    let entries = WORKSPACE.read(report, &entry.node, "[workspace]", &mut result).unwrap_or_default();
    if let Some(pivot) = find(entries, "pivot")
        && !result.has_box()
        && result.ranged_coordinates() == 0
    {
        let help = "give `translation`, `rotation_deg` or `ranges`, or remove `pivot`";
        let message = "`pivot` has no effect: the table states neither a region nor ranges";
        report.refuse(Code::MissingKey, &pivot.key_span, message, help);
    }
    // a path from home to every pose of the region stays in it
    if let Some(found) = find(entries, "region").filter(|_| is_home_outside(&result)) {
        let help = "write region = \"box\", or intervals with home nearer to their middle";
        let message = "home lies outside the ellipsoid of these intervals";
        report.refuse(Code::OutOfRange, &found.node.span, message, help);
    }
    if let Some(relative) = find(entries, "relative_to") {
        if result.poses.is_empty() && result.trajectory.is_none() {
            let help =
                "list `poses` or name a `trajectory`, or remove `relative_to`: the box is always around home";
            let message = "`relative_to` has no effect, because no poses are listed";
            report.refuse(Code::MissingKey, &relative.key_span, message, help);
        }
        if result.listed_from == ListedFrom::Home && find(top, "home").is_none() {
            let help = "add [home] with position and rpy_deg, or write relative_to = \"base\"";
            let message = "the poses are measured from [home], which is missing";
            report.refuse(Code::MissingHome, &relative.key_span, message, help);
        }
    }
    let from_home = match () {
        () if result.has_box() => "the box lies around [home], which is missing",
        () if result.ranged_coordinates() > 0 => "the ranges are measured from [home], which is missing",
        () => return result,
    };
    if find(top, "home").is_none() {
        let help = "add [home] with position and rpy_deg, or list single poses";
        report.refuse(Code::MissingHome, &entry.key_span, from_home, help);
    }
    result
}

/// Whether the ellipsoids of some intervals leave out home.
fn is_home_outside(workspace: &Workspace) -> bool {
    let share = |travel: &CoordinateRange| {
        if travel.is_still() { 0.0 } else { travel.middle() / travel.half_width() }
    };
    let outside =
        |list: &[CoordinateRange; 3]| list.iter().map(|t| share(t).powi(2)).sum::<f64>() > 1.0 + f64::EPSILON;
    workspace.region == Region::Ellipsoid
        && (outside(&workspace.translation) || outside(&workspace.rotation_deg))
}

/// The intervals of three coordinates.
fn intervals(found: &mut FoundKey<'_, '_>, most: f64) -> Option<[CoordinateRange; 3]> {
    let entry = found.entry;
    let Value::Array(nodes) = &entry.node.value else {
        let help = "write an array of 3 half widths or pairs [min, max]";
        return found.report.not_a(&entry.node, &format!("`{}`", entry.key), "an array", help);
    };
    if nodes.len() != 3 {
        let message = format!("`{}` has {} entries instead of 3", entry.key, nodes.len());
        found.refuse(Code::CoordinateCount, message, "give 3 half widths or pairs [min, max]");
    }
    let read = nodes.iter().map(|node| interval(found.report, node, &entry.key, most));
    let read: Vec<Option<CoordinateRange>> = read.collect();
    read.into_iter().collect::<Option<Vec<_>>>()?.try_into().ok()
}

/// The interval of a coordinate: a half width, or its two ends with home between them.
fn interval(report: &mut Findings<'_>, node: &Node, key: &str, most: f64) -> Option<CoordinateRange> {
    let key = format!("`{}`", shown(key));
    let found = if let Value::Array(ends) = &node.value {
        if ends.len() != 2 {
            let message = format!("an interval of {key} has {} numbers instead of 2", ends.len());
            return report.refused(Code::CoordinateCount, &node.span, message, "give a pair [min, max]");
        }
        let mut end = |k: usize| number(report, &ends[k], &format!("an end of {key}"));
        let (min, max) = (end(0), end(1));
        CoordinateRange { min: min?, max: max? }
    } else {
        let half = number(report, node, &format!("a half width of {key}"))?;
        if half < 0.0 {
            let message = format!("a half width of {half}");
            return report.refused(Code::NotPositive, &node.span, message, "half widths are not negative");
        }
        CoordinateRange::within(half)
    };
    let CoordinateRange { min, max } = found;
    if min > max {
        let message = format!("an interval of {key} begins at {min} and ends at {max}");
        return report.refused(Code::OutOfRange, &node.span, message, "write the smaller number first");
    }
    if min > 0.0 || max < 0.0 {
        let message = format!("home lies outside the interval from {min} to {max} of {key}");
        let help = "intervals are measured from home: give min <= 0 <= max, or move [home]";
        return report.refused(Code::OutOfRange, &node.span, message, help);
    }
    if found.reach() > most {
        let what = if found.is_about_home() { "a half width" } else { "an end" };
        let message = format!("{what} of {key} is {} degrees", found.reach());
        return report.refused(Code::OutOfRange, &node.span, message, "give at most 180 degrees");
    }
    Some(found)
}

/// An interval as it stands in a file.
fn written(range: CoordinateRange) -> Json {
    if range.is_about_home() { json!(range.max) } else { json!([range.min, range.max]) }
}

fn region(found: &mut FoundKey<'_, '_>) -> Region {
    let region = found.text().map(|word| Region::of(&word));
    if region == Some(None) {
        let help = "write \"box\" or \"ellipsoid\"";
        found.refuse(Code::WrongType, "`region` is neither \"box\" nor \"ellipsoid\"", help);
    }
    region.flatten().unwrap_or_default()
}

fn grid(found: &mut FoundKey<'_, '_>) -> Option<usize> {
    let x = found.number()?;
    let points = (1..=5_u8).find(|n| (f64::from(*n) - x).abs() < f64::EPSILON);
    if points.is_none() {
        let help = "give 1 (centre), 2 (centre and corners), 3, 4 or 5 points per axis";
        found.refuse(Code::Grid, format!("`grid` is {x}"), help);
    }
    points.map(usize::from)
}
