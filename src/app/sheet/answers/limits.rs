//! The free travel of the platform.

use super::at_pose::violations;
use super::poses::{pose, units, words, written};
use crate::figure::figure;
use crate::{Sheet, Table, left, right};
use records::{
    FreeRangeRecord, FreeSizeRecord, LimitRecord, LimitsAnswer, NearestAllowedRecord, Number, PoseInFrames,
    PoseQuaternionRecord, RayEndRecord, StraightPathRecord, TravelRecord, WorkspaceSizeRecord,
};

/// An end of a range below this share of the largest number of its row is rounding.
const ROUNDING: f64 = 1e-12;

/// The answer of `limits` about a design of this name.
#[must_use]
pub fn limits(name: &str, answer: &LimitsAnswer) -> Sheet {
    let mut out = Sheet::new();
    let (numbers, at) = (words(&answer.frames), shown(answer, &answer.pose, &answer.in_frames));
    if answer.allowed {
        say!(out, "{name} is allowed at {numbers} = {at}.");
        out.line("Free travel from there, one coordinate at a time:\n");
        let columns = [left("axis", 6), right("value", 9), right("minimum", 9), left("limited by", 0).gap(2)];
        let more = [right("maximum", 9), left("limited by", 0).gap(2), left("unit", 0)];
        out.table(Table::new(columns.into_iter().chain(more)).with_rows(answer.axes.iter().map(axis)));
        let is_limit =
            |travel: &TravelRecord| travel.binds.as_ref().is_some_and(|limit| limit.name.is_some());
        if !answer.axes.iter().any(|row| is_limit(&row.back) || is_limit(&row.forth)) {
            out.line("No requirement ends the travel: state leg lengths and joint angles in [hardware].");
        }
    } else {
        say!(out, "{name} is not allowed at {numbers} = {at}.");
        violations(&mut out, &answer.violated);
    }
    if !answer.frames.is_usual() {
        say!(out, "{}", answer.frames.sentence);
    }
    if let Some(found) = &answer.straight_path {
        straight(&mut out, answer, found);
    }
    if let Some(found) = &answer.nearest_allowed {
        nearest(&mut out, answer, found);
    } else if !answer.allowed {
        out.line("\nNo allowed pose was found, not even at home.");
    }
    if let Some(path) = &answer.surface {
        say!(out, "\nwrote {path}");
    }
    if let Some(found) = &answer.workspace {
        workspace(&mut out, found, &answer.length_unit);
    }
    out
}

/// The free travel as the table of a data sheet, with speeds and forces if the drives have such limits.
#[must_use]
pub fn data_sheet(name: &str, answer: &LimitsAnswer) -> Sheet {
    let mut out = Sheet::new();
    let (numbers, at) = (words(&answer.frames), shown(answer, &answer.pose, &answer.in_frames));
    say!(out, "Travel of {name} from {numbers} = {at}, one coordinate at a time:");
    let has_speed = answer.axes.iter().any(|row| row.greatest_speed.is_some());
    let has_effort = answer.axes.iter().any(|row| row.greatest_effort.is_some());
    let travel = [left("coordinate", 0), right("minimum", 0), right("maximum", 0), right("symmetric", 0)];
    let capacity = [has_speed.then(|| right("speed", 0)), has_effort.then(|| right("force or torque", 0))];
    let with = |value: Option<Number>, unit: &str| {
        value.map_or_else(|| "-".to_owned(), |x| format!("{} {unit}", figure(x.0)))
    };
    let row = |row: &FreeRangeRecord| {
        let [least, most] = ends(row);
        let (unit, axis) = (&row.unit, row.axis.clone());
        let travel = [axis, format!("{least} {unit}"), format!("{most} {unit}")];
        let capacity = [
            has_speed.then(|| with(row.greatest_speed, &format!("{unit}/s"))),
            has_effort.then(|| with(row.greatest_effort, &row.effort_unit)),
        ];
        let symmetric = format!("+-{} {unit}", figure(row.symmetric));
        travel.into_iter().chain([symmetric]).chain(capacity.into_iter().flatten()).collect::<Vec<_>>()
    };
    let columns = travel.into_iter().chain(capacity.into_iter().flatten());
    out.table(Table::new(columns).with_rows(answer.axes.iter().map(row)));
    if answer.frames.is_usual() {
        out.line("Rotations: R = Rz(yaw) Ry(pitch) Rx(roll).");
    } else {
        out.line(&answer.frames.sentence);
    }
    if has_speed || has_effort {
        out.line("Speeds, forces and torques hold at this pose: one acts alone, and weights are left out.");
    }
    out
}

/// The requirement with the legs, joints or load concerned.
pub(super) fn named(limit: &LimitRecord) -> String {
    if limit.between.is_empty() {
        limit.label().to_owned()
    } else {
        format!("{} ({})", limit.label(), limit.between.join(", "))
    }
}

fn bound(limit: Option<&LimitRecord>) -> String {
    limit.map_or_else(|| "nothing".to_owned(), named)
}

/// The least and the greatest value of a range, without rounding about zero.
fn ends(row: &FreeRangeRecord) -> [String; 2] {
    let finite = [row.value, row.back.value, row.forth.value].into_iter().filter(|x| x.is_finite());
    let scale = finite.fold(0.0, |most: f64, x| most.max(x.abs()));
    [row.back.value, row.forth.value].map(|x| figure(if x.abs() <= ROUNDING * scale { 0.0 } else { x }))
}

fn axis(row: &FreeRangeRecord) -> [String; 7] {
    let [least, most] = ends(row);
    [
        row.axis.clone(),
        figure(row.value),
        least,
        bound(row.back.binds.as_ref()),
        most,
        bound(row.forth.binds.as_ref()),
        row.unit.clone(),
    ]
}

/// A pose as position, roll, pitch and yaw, or in another convention as position and its angles.
fn shown(answer: &LimitsAnswer, record: &PoseQuaternionRecord, in_frames: &PoseInFrames) -> String {
    let numbers =
        if answer.frames.is_usual() { pose(record) } else { written(in_frames).map(figure).join(",") };
    numbers + &units(&answer.length_unit, &answer.frames.angles)
}

fn straight(out: &mut Sheet, answer: &LimitsAnswer, found: &StraightPathRecord) {
    let to = pose(&found.to) + &units(&answer.length_unit, "deg");
    match &found.binds {
        None => say!(out, "\nThe straight path to {to} is free."),
        Some(limit) => say!(
            out,
            "\nThe straight path to {to} is free for {} % of its length, up to {}. The limit there is {}.",
            figure(100.0 * found.free),
            shown(answer, &found.pose, &found.in_frames),
            named(limit)
        ),
    }
}

fn nearest(out: &mut Sheet, answer: &LimitsAnswer, found: &NearestAllowedRecord) {
    let same = |a: &LimitRecord, b: &LimitRecord| a.label() == b.label();
    let binds = found.binds.chunk_by(same).map(|limits| {
        let between: Vec<String> = limits.iter().map(|limit| limit.between.join(", ")).collect();
        match between.join("; ") {
            nothing if nothing.is_empty() => limits[0].label().to_owned(),
            legs => format!("{} ({legs})", limits[0].label()),
        }
    });
    let binds = binds.collect::<Vec<_>>().join(", ");
    let numbers = words(&answer.frames);
    say!(
        out,
        "\n{} is {numbers} = {}, {} {} away (1 rad counts as {} {}).\nLimits there: {binds}.",
        if found.stationary {
            "The nearest allowed pose (local optimum)"
        } else {
            "The nearest allowed pose found"
        },
        shown(answer, &found.pose, &found.in_frames),
        figure(found.distance),
        answer.length_unit,
        figure(found.characteristic_length),
        answer.length_unit
    );
    if answer.allowed && !found.straight_from_home {
        out.line("The straight path from home to it violates a limit.");
    }
}

fn size(found: &FreeSizeRecord, unit: &str) -> String {
    let proved = if found.proved > 0.0 {
        format!("{} {unit} proved", figure(found.proved))
    } else {
        "nothing proved".to_owned()
    };
    let beyond = bound(found.binds.as_ref());
    format!("{proved}, {} {unit} without a violation found; limited by {beyond}", figure(found.searched))
}

fn workspace(out: &mut Sheet, found: &WorkspaceSizeRecord, unit: &str) {
    let label = |e: &RayEndRecord| e.name.map_or_else(|| e.end.clone(), |kind| kind.label().to_owned());
    let ends = found.ends.iter().map(|e| format!("{} {:.0} %", label(e), 100.0 * e.share));
    let ends = ends.collect::<Vec<_>>().join("; ");
    let half = |h: &[f64; 3]| h.iter().map(|x| format!("+-{}", figure(*x))).collect::<Vec<_>>().join(" x ");
    out.line("\nAround home:");
    let mut table = Table::new([left("", 22), left("", 0)]);
    let mut line = |name: &str, text: &str| table.row([name, text]);
    line(
        "volume of positions",
        &format!(
            "{} {unit}^3 in the orientation of home, from {} straight paths (two halves of them differ by {} %)",
            figure(found.volume),
            found.rays,
            figure(100.0 * found.volume_uncertainty)
        ),
    );
    line("", &format!("limits of these paths: {ends}"));
    line("largest ball, radius", &size(&found.ball_radius, unit));
    line(
        "largest box found",
        &format!(
            "{} {unit} proved, {} {unit} without a violation found; limited by {}",
            half(&found.box_proved),
            half(&found.box_searched),
            bound(found.box_binds.as_ref())
        ),
    );
    for turn in &found.turns {
        line(
            &format!("rotation about {}", turn.axis),
            &format!(
                "-{} deg ({}) to {} deg ({})",
                figure(turn.back_deg),
                bound(turn.back_binds.as_ref()),
                figure(turn.forth_deg),
                bound(turn.forth_binds.as_ref())
            ),
        );
    }
    line("tilt, any level axis", &size(&found.tilt_deg, "deg"));
    line("rotation, any axis", &size(&found.turn_deg, "deg"));
    if let Some(required) = &found.required {
        let share = format!("its positions fill {} % of the volume above", figure(100.0 * required.share.0));
        line("required region", &format!("scale factor {}", size(&required.factor, "").replace("  ", " ")));
        line("", &share);
    }
    out.table(table);
}
