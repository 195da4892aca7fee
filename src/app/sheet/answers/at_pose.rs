//! Forces, small motions and stiffness at one pose.

use super::poses::{units, without_rounding, words, written};
use crate::figure::figure;
use crate::{Cell, Sheet, Table, Tone, left, right};
use records::{
    AtPoseAnswer, HeldWrenchRecord, LimitRecord, NearestSingularPoseRecord, Number, PoseInFrames,
    ResolutionRecord, SmallMotionRecord, StuckLegRecord,
};

/// The answer of `at`.
#[must_use]
pub fn at_pose(answer: &AtPoseAnswer) -> Sheet {
    let mut out = Sheet::new();
    let at = format!("{} = {}", words(&answer.frames), pose(answer, &answer.in_frames));
    let name = &answer.name;
    if let Some(missing) = &answer.out_of_reach {
        say!(out, "{name} does not reach {at}: the rod of leg {} is too short or too long.", missing.leg);
        return out;
    }
    match (answer.singular, answer.violated.len()) {
        (Some(evidence), _) => say!(out, "{name} is SINGULAR at {at}: {evidence}."),
        (None, 0) => say!(out, "{name} violates no requirement at {at}."),
        (None, 1) => say!(out, "{name} VIOLATES 1 limit at {at}."),
        (None, n) => say!(out, "{name} VIOLATES {n} limits at {at}."),
    }
    if let (None, Some(x)) = (answer.singular, answer.inverse_condition) {
        say!(out, "Conditioning {} (1 at best, 0 at a singular pose).", figure(x.0));
    }
    match (&answer.lengths, &answer.angles_deg) {
        (Some(lengths), _) => say!(out, "Leg lengths: {} {}", listed(*lengths), answer.length_unit),
        (None, Some(angles)) => say!(out, "Crank angles: {} deg", listed(*angles)),
        (None, None) => {}
    }
    violations(&mut out, &answer.violated);
    forces(&mut out, answer);
    if let Some(found) = &answer.stiffness {
        say!(
            out,
            "\nMinimum stiffness at the point: {} {}/{} against a force, {} {} {}/rad against a torque.",
            figure(found.linear.0),
            answer.force_unit,
            answer.length_unit,
            figure(found.angular.0),
            answer.force_unit,
            answer.length_unit
        );
    }
    if let Some(found) = &answer.resolution {
        resolution(&mut out, found, &answer.length_unit);
    }
    if let Some(found) = &answer.stuck {
        stuck(&mut out, answer, found);
    }
    if let Some(found) = &answer.nearest_singular {
        nearest(&mut out, answer, found);
    }
    out.space();
    if !answer.frames.is_usual() {
        out.line(&answer.frames.sentence);
    }
    say!(
        out,
        "Vectors have the axes of the {}. Wrenches, motions and stiffness are about the platform point {} {}.",
        answer.axes,
        listed(answer.point.map(|x| x.0)),
        answer.length_unit
    );
    out
}

fn listed(numbers: impl IntoIterator<Item = f64>) -> String {
    numbers.into_iter().map(figure).collect::<Vec<_>>().join(", ")
}

/// A row for each violated limit, the worst first.
pub(super) fn violations(out: &mut Sheet, violated: &[LimitRecord]) {
    let columns = [left("violated limit", 0), left("binds at", 0).gap(2), right("margin", 9).gap(2)];
    let mut table = Table::new(columns.into_iter().chain([left("unit", 0)]));
    for limit in violated {
        let unit = limit.unit.as_deref().unwrap_or("of det J at home");
        let margin = Cell::toned(figure(limit.margin.0), Tone::No);
        table.row([limit.label().into(), limit.between.join(", ").into(), margin, unit.into()]);
    }
    if !violated.is_empty() {
        out.space();
    }
    out.table(table);
}

fn pose(answer: &AtPoseAnswer, found: &PoseInFrames) -> String {
    let many = if found.angles_unique { "" } else { ", angles not unique" };
    written(found).map(figure).join(",") + &units(&answer.length_unit, &answer.frames.angles) + many
}

fn row(name: &str, numbers: &[Number], unit: &str) -> Vec<String> {
    let numbers = numbers.iter().map(|x| figure(x.0));
    [name.to_owned()].into_iter().chain(numbers).chain([unit.to_owned()]).collect()
}

fn columns(first: &str, names: [&str; 6]) -> Table {
    let six = names.into_iter().map(|name| right(name, 11));
    Table::new([left(first, 20)].into_iter().chain(six).chain([left("unit", 0).gap(2)]))
}

fn forces(out: &mut Sheet, answer: &AtPoseAnswer) {
    let turns = answer.angles_deg.is_some();
    let torque = format!("{} {}", answer.force_unit, answer.length_unit);
    if !answer.held.is_empty() {
        let what =
            if turns { "Torques of the cranks" } else { "Forces of the legs, positive in compression," };
        say!(out, "\n{what} that balance each load:");
        let mut table = columns("load", ["1", "2", "3", "4", "5", "6"]);
        for HeldWrenchRecord { load, forces, .. } in &answer.held {
            let name = load.as_deref().unwrap_or("--wrench");
            let unit = if turns { &torque } else { &answer.force_unit };
            match forces {
                Some(forces) => table.row(row(name, forces, unit)),
                None => table.row([name, "-", "-", "-", "-", "-", "-", ""]),
            }
        }
        out.table(table);
    }
    if let Some(wrench) = &answer.wrench {
        let [force, moment] = [wrench.force, wrench.torque].map(|v| listed(v.map(|x| x.0)));
        say!(
            out,
            "\nThe forces of --forces balance the force {force} {} and the torque {moment} {torque}.",
            answer.force_unit
        );
    }
}

fn resolution(out: &mut Sheet, found: &ResolutionRecord, length: &str) {
    say!(out, "\nMotion of the point for one step of {} {}:", figure(found.step), found.step_unit);
    let mut table = columns("drive", ["dx", "dy", "dz", "about x", "about y", "about z"]);
    let unit = format!("{length}, deg");
    let mut line = |name: &str, motion: &SmallMotionRecord| {
        let groups = [motion.shift, motion.turn_deg].map(|group| without_rounding(group.map(|x| x.0), 0.0));
        let numbers: Vec<Number> = groups.into_iter().flatten().map(Number).collect();
        table.row(row(name, &numbers, &unit));
    };
    for (leg, motion) in found.drives.iter().enumerate() {
        line(&format!("leg {}", leg + 1), motion);
    }
    line("all together, up to +-", &found.all);
    out.table(table);
}

fn stuck(out: &mut Sheet, answer: &AtPoseAnswer, found: &StuckLegRecord) {
    say!(
        out,
        "\nIf leg {} is stuck, five motions remain. Travel of its drive for one unit of each coordinate alone:",
        found.leg
    );
    let angles = if answer.frames.is_usual() { ["roll", "pitch", "yaw"] } else { ["a", "b", "c"] };
    let words = ["x", "y", "z"].into_iter().chain(angles);
    let (length, angle) = (&answer.length_unit, &answer.frames.angles);
    let travel = if answer.angles_deg.is_some() { "deg" } else { length };
    let rates = words.zip(&found.rates).enumerate().map(|(k, (word, rate))| {
        let per = if k < 3 { length } else { angle };
        format!("{word} {} {travel}/{per}", figure(rate.0))
    });
    out.line(rates.collect::<Vec<_>>().join(", "));
    if let Some(screw) = &found.screw {
        let [direction, point] = [screw.direction, screw.point].map(|v| listed(v.map(|x| x.0)));
        match screw.pitch {
            Some(pitch) => say!(
                out,
                "If leg {} is free and the others are locked, the platform turns about the axis {direction} through {point} {length} and advances by {} {length}/rad.",
                found.leg,
                figure(pitch.0)
            ),
            None => say!(
                out,
                "If leg {} is free and the others are locked, the platform moves along {direction}.",
                found.leg
            ),
        }
    }
    for path in [&found.shorter, &found.longer] {
        if let Some(last) = path.last() {
            say!(
                out,
                "  With the drive at {} {travel} the pose is {}",
                figure(last.length),
                pose(answer, &last.in_frames)
            );
        }
    }
}

fn nearest(out: &mut Sheet, answer: &AtPoseAnswer, found: &NearestSingularPoseRecord) {
    let which = if found.stationary {
        "The nearest singular pose (local optimum)"
    } else {
        "The nearest singular pose found"
    };
    let proof = match found.proved_within {
        Some(within) => format!("det J = 0 is proved within {} {} of it", figure(within), answer.length_unit),
        None => "det J = 0 is not proved near it".to_owned(),
    };
    say!(
        out,
        "\n{which} is {}, {} {} away (1 rad counts as {} {}); {proof}.",
        pose(answer, &found.in_frames),
        figure(found.distance),
        answer.length_unit,
        figure(found.characteristic_length),
        answer.length_unit
    );
}
