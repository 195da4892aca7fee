//! The legs along motions.

use super::assess::{assumed, toned};
use super::poses::{POSE, pose as at_pose, units};
use crate::figure::figure;
use crate::{Cell, Sheet, Table, left, right};
use machine::dynamics::Extreme;
use records::{
    CrankMotionRecord, MotionAnswer, MotionRegularity, MotionRunRecord, StiffnessRecord, TimedMarginRecord,
};

/// The answer of `motion`: the verdict, and for each motion a table of legs and a table of requirements.
#[must_use]
pub fn motion(answer: &MotionAnswer) -> Sheet {
    let mut out = Sheet::new();
    say!(out, "{} {}", answer.name, sentence(answer));
    for motion in &answer.motions {
        say!(
            out,
            "\n{}: {} {} in {} s",
            motion.motion,
            motion.instants,
            if motion.instants == 1 { "instant" } else { "instants" },
            figure(motion.duration_s)
        );
        match &motion.cranks {
            Some(list) => cranks(&mut out, answer, motion, list),
            None => legs(&mut out, answer, motion),
        }
        requirements(&mut out, motion);
    }
    if let Some(found) = &answer.stiffness {
        stiffness(&mut out, answer, found);
    }
    if let Some(path) = &answer.csv {
        say!(out, "wrote {path}");
    }
    if !answer.assumptions.is_empty() {
        out.space();
    }
    out.add(assumed(&answer.assumptions));
    out
}

fn sentence(answer: &MotionAnswer) -> String {
    let missed = |m: &MotionRunRecord| {
        let of = m.requirements.iter().filter(|r| r.margin.violates()).map(|r| r.margin.name.label());
        of.chain(m.singular_at_s.map(|_| "singular pose"))
            .chain(m.unreached_at_s.map(|_| "reach"))
            .collect::<Vec<_>>()
    };
    let mut all: Vec<&str> = answer.motions.iter().flat_map(missed).collect();
    all.sort_unstable();
    all.dedup();
    if all == ["singular pose"] {
        return "passes a singular pose".into();
    }
    if !all.is_empty() {
        return format!("exceeds its limits: {}", all.join("; "));
    }
    if answer.motions.is_empty() {
        return "at a pose".into();
    }
    let limited = answer.motions.iter().any(|m| !m.requirements.is_empty());
    if limited {
        "stays within its limits at the sampled instants"
    } else {
        "has no limits along its motions"
    }
    .to_string()
}

fn legs(out: &mut Sheet, answer: &MotionAnswer, motion: &MotionRunRecord) {
    let (length, force) = (&answer.length_unit, &answer.force_unit);
    let titles = [
        format!("shortest {length}"),
        format!("longest {length}"),
        format!("speed {length}/s"),
        format!("acc. {length}/s^2"),
        format!("push {force}"),
        format!("pull {force}"),
        format!("rms {force}"),
        "power W".to_string(),
    ];
    let rows = motion.legs.iter().map(|leg| {
        let cells = [
            figure(leg.shortest.value),
            figure(leg.longest.value),
            figure(leg.speed.value),
            figure(leg.acceleration.value),
            extreme(leg.push),
            extreme(leg.pull),
            leg.rms_force.map_or("-".to_string(), |x| figure(x.0)),
            extreme(leg.power_w),
        ];
        (leg.leg, cells)
    });
    out.table(table("leg", titles, rows));
    singular(out, answer, motion);
}

/// The singular pose of a motion, or the evidence for its absence.
fn singular(out: &mut Sheet, answer: &MotionAnswer, motion: &MotionRunRecord) {
    let parts = (motion.singular_at_s, &motion.singular_pose, motion.singular_evidence);
    if let (Some(time), Some(pose), Some(evidence)) = parts {
        let what = if motion.cranks.is_some() { "pose or a crank" } else { "pose" };
        say!(
            out,
            "At {} s the {what} is singular: {}. The drives cannot hold the platform at {POSE} = {}{}.",
            figure(time),
            evidence,
            at_pose(pose),
            units(&answer.length_unit, "deg")
        );
    } else if motion.regularity == MotionRegularity::Proved {
        out.line("No pose of the motion is singular: proved, also between the instants.");
    }
}

/// A row for each leg or crank, with its number in the column `what`.
fn table<const N: usize>(
    what: &str,
    titles: [String; N],
    rows: impl Iterator<Item = (usize, [String; N])>,
) -> Table {
    let columns = [left(what, 0)].into_iter().chain(titles.map(|title| right(title, 9).gap(2)));
    Table::new(columns).with_rows(rows.map(|(number, cells)| [number.to_string()].into_iter().chain(cells)))
}

fn extreme(found: Option<Extreme>) -> String {
    found.map_or("-".to_string(), |x| figure(x.value))
}

fn cranks(out: &mut Sheet, answer: &MotionAnswer, motion: &MotionRunRecord, list: &[CrankMotionRecord]) {
    let torque = format!("{} {}", answer.force_unit, answer.length_unit);
    let titles = [
        "min. deg".to_string(),
        "max. deg".to_string(),
        "speed deg/s".to_string(),
        "acc. deg/s^2".to_string(),
        format!("torque {torque}"),
        format!("rms {torque}"),
        "power W".to_string(),
    ];
    let rows = list.iter().map(|crank| {
        let cells = [
            figure(crank.least_deg.value),
            figure(crank.greatest_deg.value),
            figure(crank.speed_deg.value),
            figure(crank.acceleration_deg.value),
            extreme(crank.torque),
            crank.rms_torque.map_or("-".to_string(), |x| figure(x.0)),
            extreme(crank.power_w),
        ];
        (crank.leg, cells)
    });
    out.table(table("crank", titles, rows));
    if let Some(time) = motion.unreached_at_s {
        say!(out, "At {} s a rod does not reach from its crank to the platform.", figure(time));
    }
    singular(out, answer, motion);
}

fn stiffness(out: &mut Sheet, answer: &MotionAnswer, found: &StiffnessRecord) {
    let (length, force) = (&answer.length_unit, &answer.force_unit);
    say!(out, "\nStiffness at {POSE} = {}{}", at_pose(&found.pose), units(length, "deg"));
    say!(
        out,
        "Least: {} {force}/{length} against a force through the platform origin, {} {force} {length}/rad against a torque.",
        figure(found.linear.0),
        figure(found.angular.0)
    );
    say!(
        out,
        "Stiffness matrix K (rows: force {force}, torque {force} {length}; columns: translation {length}, rotation rad):"
    );
    let rows = found.matrix.iter().map(|row| row.iter().map(|x| figure(x.0)));
    out.table(Table::new((0..6).map(|_| right("", 9).gap(2))).with_rows(rows));
    match &found.natural {
        None => {
            out.line("No natural frequencies: the payload has no mass, or no inertia against some rotation.");
        }
        Some(all) => {
            let shape = ["x", "y", "z", "rx", "ry", "rz"].map(|title| right(title, 8));
            let mut table = Table::new([right("frequency Hz", 14)].into_iter().chain(shape));
            for one in all {
                let most = one.shape.iter().map(|x| x.0.abs()).fold(f64::MIN_POSITIVE, f64::max);
                let shape = one.shape.iter().map(|x| figure(x.0 / most));
                table.row([figure(one.frequency_hz.0)].into_iter().chain(shape));
            }
            out.table(table);
        }
    }
}

fn requirements(out: &mut Sheet, motion: &MotionRunRecord) {
    let with_margin = motion.requirements.iter().any(|r| r.margin.safety_margin.0 > 0.0);
    let net = with_margin.then(|| right("after safety margin", 0).gap(2));
    let columns = [left("requirement", 17), right("least margin", 0).gap(2)].into_iter().chain(net);
    let mut table =
        Table::new(columns.chain([left("unit", 0), left("binds at", 0).gap(2), left("time s", 0).gap(2)]));
    for TimedMarginRecord { time_s, margin } in &motion.requirements {
        let net = with_margin.then(|| Cell::from(figure(margin.net_margin.0)));
        let found = toned(margin, figure(margin.margin.0));
        let (of, at) = (margin.between.join(", "), figure(*time_s));
        let cells = [margin.name.label().into(), found].into_iter().chain(net);
        table.row(cells.chain([margin.unit.clone(), of, at].map(Cell::from)));
    }
    out.table(table);
}
