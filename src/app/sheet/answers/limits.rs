//! The free travel of the platform.

use super::at_pose::violations;
use super::poses::{pose, units, words, written};
use crate::figure::figure;
use crate::{Sheet, Table, left, right};
use records::{
    FreeRangeRecord, FreeSizeRecord, LimitRecord, LimitsAnswer, NearestAllowedRecord, PoseInFrames,
    PoseQuaternionRecord, RayEndRecord, StraightPathRecord, WorkspaceSizeRecord,
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

fn axis(row: &FreeRangeRecord) -> [String; 7] {
    let finite = [row.value, row.back.value, row.forth.value].into_iter().filter(|x| x.is_finite());
    let scale = finite.fold(0.0, |most: f64, x| most.max(x.abs()));
    let end = |x: f64| figure(if x.abs() <= ROUNDING * scale { 0.0 } else { x });
    [
        row.axis.clone(),
        figure(row.value),
        end(row.back.value),
        bound(row.back.binds.as_ref()),
        end(row.forth.value),
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
