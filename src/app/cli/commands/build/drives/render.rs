//! What `build drives` writes.

use std::fmt::Write as _;

use crate::app::cli::numbers::{significant as short, width_of};
use crate::app::cli::requirements;
use records::{DriveRecord, DrivesAnswer, MarginRecord, Number};

/// The sentence, a line for each drive, and the requirements with the drive chosen.
pub(super) fn text(answer: &DrivesAnswer) -> String {
    let mut out = format!("{}: {}\n", answer.name, sentence(answer));
    for line in &answer.assumptions {
        let _ = writeln!(out, "{line}");
    }
    out.push('\n');
    table(&mut out, answer);
    if let Some(drive) = answer.drives.first().filter(|d| d.fits == Some(true)) {
        let _ = write!(
            out,
            "\nwith {}: {}",
            drive.name,
            requirements::lead(&answer.name, Some(&drive.assessment))
        );
    }
    if let Some(path) = &answer.output {
        let _ = writeln!(out, "wrote {path}");
    }
    out
}

fn sentence(answer: &DrivesAnswer) -> String {
    let count = |fits: Option<bool>| answer.drives.iter().filter(|d| d.fits == fits).count();
    let (all, fit, open) = (answer.drives.len(), count(Some(true)), count(None));
    let undecided = if open == 0 { String::new() } else { format!(", {open} are undecided") };
    match &answer.chosen {
        Some(name) => format!("{fit} of {all} drives fit{undecided}; the first choice is {name}"),
        None if open == 0 => format!("none of {all} drives fits"),
        None => format!("none of {all} drives is proved to fit{undecided}"),
    }
}

fn table(out: &mut String, answer: &DrivesAnswer) {
    let (length, force, mass) = (&answer.length_unit, &answer.force_unit, &answer.mass_unit);
    let price = answer.currency.as_ref().map_or("price".to_owned(), |c| format!("price {c}"));
    let titles = [
        price,
        format!("mass {mass}"),
        format!("least {length}"),
        format!("greatest {length}"),
        format!("force {force}"),
        format!("speed {length}/s"),
    ];
    let width = width_of(answer.drives.iter().map(|d| d.name.as_str()));
    let _ = write!(out, "{:<width$} {:<9}", "drive", "fits");
    for title in &titles {
        let _ = write!(out, " {title:>13}");
    }
    out.push_str("  what binds\n");
    for drive in &answer.drives {
        let fits = match drive.fits {
            Some(true) => "yes",
            Some(false) => "no",
            None => "undecided",
        };
        let _ = write!(out, "{:<width$} {fits:<9}", drive.name);
        let number = |x: Option<Number>| x.map_or_else(|| "-".to_owned(), |x| short(x.0));
        let [least, greatest] = drive.leg_length.map(Some);
        for x in [drive.price, drive.mass, least, greatest, drive.force, drive.speed] {
            let _ = write!(out, " {:>13}", number(x));
        }
        let _ = writeln!(out, "  {}", binding(drive).join(", "));
    }
}

/// The requirements that a drive misses or that are not proved; of one that fits what the drive leaves: length, force and speed.
fn binding(drive: &DriveRecord) -> Vec<String> {
    let with = |m: &MarginRecord| format!("{} {} {}", m.name.code(), short(m.margin.0), m.unit);
    let mut out = Vec::new();
    for m in &drive.assessment.requirements {
        let own = matches!(m.name.code(), "leg_too_short" | "leg_too_long" | "leg_force" | "leg_speed");
        let tells = if drive.fits == Some(true) { own } else { m.met != Some(true) };
        if tells {
            out.push(with(m));
        }
    }
    if drive.fits != Some(true) && drive.assessment.regular.met != Some(true) {
        out.push("singularity".into());
    }
    for motion in &drive.motions {
        for m in motion.requirements.iter().filter(|m| m.margin.violates()) {
            out.push(format!("{} ({}, {} s)", with(&m.margin), motion.motion, short(m.time_s)));
        }
        out.extend(motion.singular_at_s.map(|t| format!("singularity ({}, {} s)", motion.motion, short(t))));
    }
    out
}
