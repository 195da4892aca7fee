//! The fit of the drives of a table.

use super::assess::assumed;
use super::verdict;
use crate::figure::figure;
use crate::{Cell, Sheet, Table, left, right};
use machine::requirements::TermKind;
use records::{DriveRecord, DrivesAnswer, MarginRecord, Number};

/// The answer of `build drives`: the verdict, a line for each drive, and the requirements with the chosen drive.
#[must_use]
pub fn drives(answer: &DrivesAnswer) -> Sheet {
    let mut out = Sheet::new();
    say!(out, "{}: {}", answer.name, sentence(answer));
    out.space();
    out.table(table(answer));
    out.space();
    if let Some(drive) = answer.drives.first().filter(|d| d.fits == Some(true)) {
        let file = answer.output.as_deref().unwrap_or("FILE, written with -o FILE");
        say!(out, "With {}:", drive.name);
        out.add(verdict(&answer.name, Some(&drive.assessment), &format!("equipod assess {file}")));
    }
    if let Some(path) = &answer.output {
        say!(out, "wrote {path}");
    }
    out.add(assumed(&answer.assumptions));
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

fn table(answer: &DrivesAnswer) -> Table {
    let (length, force, mass) = (&answer.length_unit, &answer.force_unit, &answer.mass_unit);
    let price = answer.currency.as_ref().map_or("price".to_owned(), |c| format!("price {c}"));
    let titles = [
        price,
        format!("mass {mass}"),
        format!("shortest {length}"),
        format!("longest {length}"),
        format!("force {force}"),
        format!("speed {length}/s"),
    ];
    let columns =
        [left("drive", 5), left("fits", 9)].into_iter().chain(titles.map(|title| right(title, 0).gap(2)));
    let mut table = Table::new(columns.chain([left("margins that decide", 0).gap(2)]));
    for drive in &answer.drives {
        let fits = match drive.fits {
            Some(true) => "yes",
            Some(false) => "no",
            None => "undecided",
        };
        let number = |x: Option<Number>| Cell::from(x.map_or_else(|| "-".to_owned(), |x| figure(x.0)));
        let [least, greatest] = drive.leg_length.map(Some);
        let numbers = [drive.price, drive.mass, least, greatest, drive.force, drive.speed].map(number);
        let cells = [drive.name.as_str().into(), fits.into()].into_iter().chain(numbers);
        table.row(cells.chain([binding(drive).join("; ").into()]));
    }
    table
}

/// The requirements that a drive violates or that are unproved. For a drive that fits, its margins of length, force and
/// speed.
fn binding(drive: &DriveRecord) -> Vec<String> {
    let with = |m: &MarginRecord| format!("{}: {} {}", m.name.label(), figure(m.margin.0), m.unit);
    let mut out = Vec::new();
    for m in &drive.assessment.requirements {
        let own = matches!(
            m.name,
            TermKind::MinLegLength | TermKind::MaxLegLength | TermKind::LegForce | TermKind::LegSpeed
        );
        let tells = if drive.fits == Some(true) { own } else { m.met != Some(true) };
        if tells {
            out.push(with(m));
        }
    }
    if drive.fits != Some(true) && drive.assessment.regular.met != Some(true) {
        out.push("singular pose".into());
    }
    for motion in &drive.motions {
        for m in motion.requirements.iter().filter(|m| m.margin.violates()) {
            out.push(format!("{} ({}, {} s)", with(&m.margin), motion.motion, figure(m.time_s)));
        }
        out.extend(
            motion.singular_at_s.map(|t| format!("singular pose ({}, {} s)", motion.motion, figure(t))),
        );
    }
    out
}
