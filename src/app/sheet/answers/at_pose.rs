//! Forces, small motions and stiffness at one pose.

use super::limits::named;
use super::poses::{without_rounding, words, written};
use crate::figure::figure;
use crate::{Sheet, Table, left, right};
use records::{
    AtPoseAnswer, HeldWrenchRecord, NearestSingularPoseRecord, Number, PoseInFrames, ResolutionRecord,
    SmallMotionRecord, StuckLegRecord,
};

/// The answer of `at`.
#[must_use]
pub fn at_pose(answer: &AtPoseAnswer) -> Sheet {
    let mut out = Sheet::new();
    say!(out, "{} at {} = {}", answer.name, words(&answer.frames), pose(&answer.in_frames));
    if let Some(missing) = &answer.out_of_reach {
        say!(out, "The rod of leg {} does not reach.", missing.leg);
        return out;
    }
    match (&answer.lengths, &answer.angles_deg) {
        (Some(lengths), _) => say!(out, "lengths ({}): {}", answer.length_unit, listed(*lengths)),
        (None, Some(angles)) => say!(out, "angles of the cranks (deg): {}", listed(*angles)),
        (None, None) => {}
    }
    for limit in &answer.violated {
        let unit = limit.unit.as_deref().unwrap_or("of det J at home");
        say!(out, "NOT ALLOWED: {} is missed by {} {unit}", named(limit), figure(-limit.margin.0));
    }
    match answer.singular {
        Some(evidence) => say!(out, "SINGULAR: {evidence}"),
        None => {
            if let Some(x) = answer.inverse_condition {
                say!(out, "conditioning {}", figure(x.0));
            }
        }
    }
    forces(&mut out, answer);
    if let Some(found) = &answer.stiffness {
        say!(
            out,
            "\nLeast stiffness at the point: {} {}/{} against a force, {} {} {}/rad against a torque.",
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
        "Vectors have the axes of the {}; wrenches, shifts and stiffness are about the platform point {}.",
        answer.axes,
        listed(answer.point.map(|x| x.0))
    );
    out
}

fn listed(numbers: impl IntoIterator<Item = f64>) -> String {
    numbers.into_iter().map(figure).collect::<Vec<_>>().join(", ")
}

fn pose(found: &PoseInFrames) -> String {
    let many = if found.angles_unique { "" } else { " (angles not unique)" };
    written(found).map(figure).join(",") + many
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
            if turns { "Torques of the cranks" } else { "Forces of the legs, positive where they push," };
        say!(out, "\n{what} that hold a wrench on the platform:");
        let mut table = columns("wrench", ["1", "2", "3", "4", "5", "6"]);
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
            "\nThe forces of --forces hold force {force} {} and torque {moment} {torque}.",
            answer.force_unit
        );
    }
}

fn resolution(out: &mut Sheet, found: &ResolutionRecord, length: &str) {
    say!(out, "\nMotion of the point for a step of {} {}:", figure(found.step), found.step_unit);
    let mut table = columns("step of", ["dx", "dy", "dz", "about x", "about y", "about z"]);
    let unit = format!("{length}, deg");
    let mut line = |name: &str, motion: &SmallMotionRecord| {
        let groups = [motion.shift, motion.turn_deg].map(|group| without_rounding(group.map(|x| x.0), 0.0));
        let numbers: Vec<Number> = groups.into_iter().flatten().map(Number).collect();
        table.row(row(name, &numbers, &unit));
    };
    for (leg, motion) in found.drives.iter().enumerate() {
        line(&format!("leg {}", leg + 1), motion);
    }
    line("all, at most +-", &found.all);
    out.table(table);
}

fn stuck(out: &mut Sheet, answer: &AtPoseAnswer, found: &StuckLegRecord) {
    say!(
        out,
        "\nLeg {}, stuck: five motions remain. Change of its length for one unit of each number of the pose alone:",
        found.leg
    );
    let words = ["x", "y", "z", "a", "b", "c"];
    let rates = words.iter().zip(&found.rates).map(|(word, rate)| format!("{word} {}", figure(rate.0)));
    out.line(rates.collect::<Vec<_>>().join(", "));
    if let Some(screw) = &found.screw {
        let [direction, point] = [screw.direction, screw.point].map(|v| listed(v.map(|x| x.0)));
        match screw.pitch {
            Some(pitch) => say!(
                out,
                "Leg {}, free with the others locked: the platform rotates about {direction} through {point} and shifts by {} {} per radian.",
                found.leg,
                figure(pitch.0),
                answer.length_unit
            ),
            None => say!(
                out,
                "Leg {}, free with the others locked: the platform shifts along {direction}.",
                found.leg
            ),
        }
    }
    for way in [&found.shorter, &found.longer] {
        if let Some(last) = way.last() {
            say!(
                out,
                "  with the leg {} {} long the pose is {}",
                figure(last.length),
                answer.length_unit,
                pose(&last.in_frames)
            );
        }
    }
}

fn nearest(out: &mut Sheet, answer: &AtPoseAnswer, found: &NearestSingularPoseRecord) {
    let which = if found.stationary {
        "The nearest singular pose, locally,"
    } else {
        "The nearest singular pose found"
    };
    let proof = match found.proved_within {
        Some(within) => format!("det J = 0 is proved within {} {} of it", figure(within), answer.length_unit),
        None => "det J = 0 is not proved near it".to_owned(),
    };
    say!(
        out,
        "\n{which} is {}, {} {} away (a radian counts as {} {}); {proof}.",
        pose(&found.in_frames),
        figure(found.distance),
        answer.length_unit,
        figure(found.characteristic_length),
        answer.length_unit
    );
}
