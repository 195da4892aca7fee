//! `[workspace]`: the poses to reach.

use serde_json::json;

use super::found::element_span;
use super::kind::{HALF_WIDTHS, KeyKind, list, numbers, own, table, unit, word};
use super::poses::{POSE, poses};
use super::stored::{Stored, StoredValue, Word};
use super::{Code, FoundKey, KeyTable, TEXT, key};
use crate::design::tree::{Entry, find};
use crate::design::violation::Findings;
use crate::design::{Trajectory, Workspace};
use machine::requirements::{ListedFrom, Region};

const HALF_ANGLES: KeyKind = own(
    r#"{"type": "array", "minItems": 3, "maxItems": 3, "items": {"type": "number", "minimum": 0, "maximum": 180}}"#,
    unit::DEGREES,
);

pub(super) static WORKSPACE: KeyTable<Workspace> = KeyTable {
    keys: &[
        key!("translation" { default = "[0, 0, 0]" }: numbers(&HALF_WIDTHS, unit::LENGTH), translation;
            "half widths around home, base frame"),
        key!("rotation_deg" { default = "[0, 0, 0]" }: HALF_ANGLES,
            |found, to| {
                found.kind = numbers(&HALF_WIDTHS, unit::DEGREES);
                found.fill(&mut to.rotation_deg);
            },
            |of| of.rotation_deg.written();
            "half widths of the components of the rotation vector, degrees"),
        key!("grid" { default = "2" }: own(r#"{"enum": [1, 2, 3, 4, 5]}"#, unit::NONE),
            |found, to| to.grid = grid(found).unwrap_or(to.grid), |of| Some(json!(of.grid));
            "points for each axis, evenly from minus to plus the half width"),
        key!("region" { default = r#""box""# }: word(Region::words),
            |found, to| to.region = region(found),
            |of| Some(of.region.json()).filter(|_| of.region != Region::default());
            "a box, or translations in an ellipsoid with the half widths as half axes and rotation vectors in another"),
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
    for (k, half) in result.rotation_deg.iter().enumerate().filter(|(_, half)| **half > 180.0) {
        let span = find(entries, "rotation_deg").map_or(0..0, |e| element_span(&e.node, k));
        report.refuse(
            Code::OutOfRange,
            &span,
            format!("a half width of `rotation_deg` is {half} degrees"),
            "give at most 180 degrees",
        );
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
    if result.has_box() && find(top, "home").is_none() {
        let help = "add [home] with position and rpy_deg, or list single poses";
        report.refuse(
            Code::MissingHome,
            &entry.key_span,
            "the box lies around [home], which is missing",
            help,
        );
    }
    result
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
