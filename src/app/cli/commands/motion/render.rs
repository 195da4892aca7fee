//! The legs along motions as text and as a table of all instants.

use std::fmt::Write as _;

use crate::app::cli::numbers::significant as short;
use crate::app::cli::poses;
use crate::app::cli::table::{column_unit, csv_line, number};
use ask::Design;
use ask::MotionReport;
use machine::dynamics::Extreme;
use records::{
    CrankMotionRecord, MotionAnswer, MotionRegularity, MotionRunRecord, StiffnessRecord, TimedMarginRecord,
};

/// The sentence, and for each motion a table of legs and one of requirements.
pub(super) fn text(answer: &MotionAnswer) -> String {
    let mut out = format!("{} {}\n", answer.name, sentence(answer));
    for line in &answer.assumptions {
        let _ = writeln!(out, "{line}");
    }
    for motion in &answer.motions {
        let _ = writeln!(
            out,
            "\n{}: {} {} in {} s",
            motion.motion,
            motion.instants,
            if motion.instants == 1 { "instant" } else { "instants" },
            short(motion.duration_s)
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
        let _ = writeln!(out, "wrote {path}");
    }
    out
}

fn sentence(answer: &MotionAnswer) -> String {
    let missed = |m: &MotionRunRecord| {
        let of = m.requirements.iter().filter(|r| r.margin.violates()).map(|r| r.margin.name.code());
        of.chain(m.singular_at_s.map(|_| "singularity"))
            .chain(m.unreached_at_s.map(|_| "reach"))
            .collect::<Vec<_>>()
    };
    let mut all: Vec<&str> = answer.motions.iter().flat_map(missed).collect();
    all.sort_unstable();
    all.dedup();
    if all == ["singularity"] {
        return "passes a singular pose".into();
    }
    if !all.is_empty() {
        return format!("exceeds its limits: {}", all.join(", "));
    }
    if answer.motions.is_empty() {
        return "at a pose".into();
    }
    let limited = answer.motions.iter().any(|m| !m.requirements.is_empty());
    if limited {
        "stays within its limits at the instants looked at"
    } else {
        "has no limits along its motions"
    }
    .to_string()
}

fn legs(out: &mut String, answer: &MotionAnswer, motion: &MotionRunRecord) {
    let (length, force) = (&answer.length_unit, &answer.force_unit);
    let titles = [
        format!("least {length}"),
        format!("greatest {length}"),
        format!("speed {length}/s"),
        format!("acc. {length}/s^2"),
        format!("push {force}"),
        format!("pull {force}"),
        format!("rms {force}"),
        "power W".to_string(),
    ];
    let rows = motion.legs.iter().map(|leg| {
        let cells = [
            short(leg.shortest.value),
            short(leg.longest.value),
            short(leg.speed.value),
            short(leg.acceleration.value),
            extreme(leg.push),
            extreme(leg.pull),
            leg.rms_force.map_or("-".to_string(), |x| short(x.0)),
            extreme(leg.power_w),
        ];
        (leg.leg, cells)
    });
    table(out, "leg", &titles, rows);
    singular(out, motion);
}

/// The singular pose of a motion, or what is known of its absence.
fn singular(out: &mut String, motion: &MotionRunRecord) {
    let parts = (motion.singular_at_s, &motion.singular_pose, motion.singular_evidence);
    if let (Some(time), Some(pose), Some(evidence)) = parts {
        let what = if motion.cranks.is_some() { "pose or a crank" } else { "pose" };
        let _ = writeln!(
            out,
            "At {} s the {what} is singular: {}. The drives cannot hold the platform at {}.",
            short(time),
            evidence,
            pose.short()
        );
    } else if motion.regularity == MotionRegularity::Proved {
        out.push_str("No pose of the motion is singular: proved, between the instants too.\n");
    }
}

/// A row for each leg or crank, with its number under `what`.
fn table<const N: usize>(
    out: &mut String,
    what: &str,
    titles: &[String; N],
    rows: impl Iterator<Item = (usize, [String; N])>,
) {
    let width = what.len();
    let _ = write!(out, "{what}");
    for title in titles {
        let _ = write!(out, " {title:>14}");
    }
    out.push('\n');
    for (number, cells) in rows {
        let _ = write!(out, "{number:<width$}");
        for cell in cells {
            let _ = write!(out, " {cell:>14}");
        }
        out.push('\n');
    }
}

fn extreme(found: Option<Extreme>) -> String {
    found.map_or("-".to_string(), |x| short(x.value))
}

fn cranks(out: &mut String, answer: &MotionAnswer, motion: &MotionRunRecord, list: &[CrankMotionRecord]) {
    let torque = format!("{} {}", answer.force_unit, answer.length_unit);
    let titles = [
        "least deg".to_string(),
        "greatest deg".to_string(),
        "speed deg/s".to_string(),
        "acc. deg/s^2".to_string(),
        format!("torque {torque}"),
        format!("rms {torque}"),
        "power W".to_string(),
    ];
    let rows = list.iter().map(|crank| {
        let cells = [
            short(crank.least_deg.value),
            short(crank.greatest_deg.value),
            short(crank.speed_deg.value),
            short(crank.acceleration_deg.value),
            extreme(crank.torque),
            crank.rms_torque.map_or("-".to_string(), |x| short(x.0)),
            extreme(crank.power_w),
        ];
        (crank.leg, cells)
    });
    if !list.is_empty() {
        table(out, "crank", &titles, rows);
    }
    if let Some(time) = motion.unreached_at_s {
        let _ = writeln!(out, "At {} s a rod does not reach from its crank to the platform.", short(time));
    }
    singular(out, motion);
}

fn stiffness(out: &mut String, answer: &MotionAnswer, found: &StiffnessRecord) {
    let (length, force) = (&answer.length_unit, &answer.force_unit);
    let _ = writeln!(out, "\nstiffness at {}", found.pose.short());
    let _ = writeln!(
        out,
        "least: {} {force}/{length} against a force through the platform origin, {} {force} {length}/rad against a torque",
        short(found.linear.0),
        short(found.angular.0)
    );
    let _ = writeln!(out, "K (rows: force, torque; columns: shift, turn in radians)");
    for row in &found.matrix {
        for x in row {
            let _ = write!(out, " {:>14}", short(x.0));
        }
        out.push('\n');
    }
    match &found.natural {
        None => out.push_str(
            "No natural frequencies: the payload has no mass, or no inertia that is held against turns.\n",
        ),
        Some(all) => {
            let _ = writeln!(out, "{:>14}  shape: shift of the platform origin, turn", "frequency Hz");
            for one in all {
                let _ = write!(out, "{:>14} ", short(one.frequency_hz.0));
                let most = one.shape.iter().map(|x| x.0.abs()).fold(f64::MIN_POSITIVE, f64::max);
                for x in &one.shape {
                    let _ = write!(out, " {:>8.4}", x.0 / most);
                }
                out.push('\n');
            }
        }
    }
}

fn requirements(out: &mut String, motion: &MotionRunRecord) {
    if motion.requirements.is_empty() {
        return;
    }
    let reserved = motion.requirements.iter().any(|r| r.margin.reserve.0 > 0.0);
    let column = if reserved { format!(" {:>14}", "less reserve") } else { String::new() };
    let _ =
        writeln!(out, "{:<18} {:>14}{column} {:<8} {:<24} at s", "requirement", "least margin", "unit", "of");
    for row in &motion.requirements {
        let TimedMarginRecord { time_s, margin } = row;
        let mark = if margin.at_limit {
            '='
        } else if margin.violates() {
            '!'
        } else {
            ' '
        };
        let left = if reserved { format!(" {:>14.6}", margin.margin_with_reserve.0) } else { String::new() };
        let _ = writeln!(
            out,
            "{:<17}{mark} {:>14.6}{left} {:<8} {:<24} {}",
            margin.name.code(),
            margin.margin.0,
            margin.unit,
            margin.between.join(", "),
            short(*time_s)
        );
    }
}

/// Every instant of every motion.
pub(super) fn csv(design: &Design, motions: &[(String, MotionReport)]) -> String {
    let unit = column_unit(&design.units);
    let force = design.force_unit().label();
    let mut header: Vec<String> = ["motion", "t_s"].map(String::from).to_vec();
    header.extend(["x", "y", "z"].map(|axis| format!("{axis}_{unit}")));
    header.extend(["qw", "qx", "qy", "qz"].map(String::from));
    let columns = if design.has_cranks() {
        [
            ("crank", "deg".to_string()),
            ("speed", "deg_per_s".to_string()),
            ("acceleration", "deg_per_s2".to_string()),
            ("torque", format!("{force}_{unit}")),
            ("power", "W".to_string()),
        ]
    } else {
        [
            ("length", unit.clone()),
            ("speed", format!("{unit}_per_s")),
            ("acceleration", format!("{unit}_per_s2")),
            ("force", force.to_string()),
            ("power", "W".to_string()),
        ]
    };
    for (name, unit) in columns {
        header.extend((1..=6).map(|leg| format!("{name}_{leg}_{unit}")));
    }
    let mut out = csv_line(&header);
    for (name, found) in motions {
        for at in &found.instants {
            let mut cells = vec![name.clone(), number(at.time)];
            cells.extend(poses::csv_fields(&at.state.pose).split(',').map(str::to_string));
            // of a crank whose rod does not reach nothing is known
            let cell = |x: f64| if x.is_nan() { String::new() } else { number(x) };
            cells.extend(at.legs.iter().map(|leg| cell(leg.length)));
            cells.extend(at.legs.iter().map(|leg| cell(leg.speed)));
            cells.extend(at.legs.iter().map(|leg| cell(leg.acceleration)));
            match &at.drives {
                Some((forces, powers)) => cells.extend(forces.iter().chain(powers).map(|x| number(*x))),
                None => cells.extend(std::iter::repeat_n(String::new(), 12)),
            }
            out.push_str(&csv_line(&cells));
        }
    }
    out
}
