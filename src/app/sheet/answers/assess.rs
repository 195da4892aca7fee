//! Margins of the requirements of a design; this table leads every answer that assesses a design.

use super::poses::{POSE, place, pose};
use crate::figure::figure;
use crate::{Cell, Sheet, Table, Tone, left, right};
use machine::requirements::{MarginVerdict, TermKind};
use records::{AssessAnswer, MarginRecord};
use synthesis::singularity::RegularityWord;

/// The answer of `assess`: the verdict, the numbers that decide, the table, and what is assumed.
#[must_use]
pub fn assess(found: &AssessAnswer) -> Sheet {
    let mut sheet = Sheet::new();
    sheet.line(sentence(found));
    key_numbers(&mut sheet, found);
    sheet.space();
    sheet.table(table(found));
    sheet.space();
    sheet.line("A margin below 0 is a violation (!); = marks a margin of 0 to rounding, which is met.");
    sheet.line("The proved margin is a lower bound over the poses assessed; the least margin was found at the worst pose.");
    if found.met.is_none() {
        sheet.line(
            "Poses between the sampled ones may violate what is not proved; more --cells may prove it.",
        );
    }
    sheet.add(assumptions(found));
    sheet
}

/// The tightest requirement, singular poses, conditioning and the lightest drive, a line each.
fn key_numbers(sheet: &mut Sheet, found: &AssessAnswer) {
    if let Some(t) = &found.tightest {
        let margin = found.requirements.iter().find(|m| m.name == t.name);
        let margin = margin.map_or_else(String::new, |m| format!("{} {}, ", figure(m.margin.0), m.unit));
        let share = figure(100.0 * t.share.0);
        let whole = match t.name {
            TermKind::MinLegLength | TermKind::MaxLegLength => "the travel",
            TermKind::MinRodLength | TermKind::MaxRodLength => "the rod's length",
            TermKind::CrankAngle => "half the range",
            _ => "its limit",
        };
        say!(sheet, "Tightest requirement: {} (margin {margin}{share} % of {whole}).", t.name.label());
    }
    let said = &found.regular_explanation;
    let at = place(found.regular.pose.as_ref());
    sheet.line(match found.regular.status {
        RegularityWord::Proved => format!("{said}."),
        RegularityWord::ChangesSign => format!("{said}, {POSE} = {at}."),
        RegularityWord::Undecided => format!("{said}; undecided near {POSE} = {at}."),
    });
    if let Some(d) = &found.lightest_drive {
        say!(sheet, "{}.", d.message);
    }
}

/// The verdict in a line, and the place with all margins: a command, or a page.
#[must_use]
pub fn verdict(name: &str, found: Option<&AssessAnswer>, place: &str) -> Sheet {
    let mut sheet = Sheet::new();
    match found {
        Some(found) => {
            sheet.line(sentence(found));
            say!(sheet, "Margins and worst poses: {place}");
        }
        None => nothing_required(&mut sheet, name),
    }
    sheet
}

fn nothing_required(sheet: &mut Sheet, name: &str) {
    say!(
        sheet,
        "{name} requires nothing: it has no limits of lengths, joint angles, clearances, forces or speeds"
    );
}

/// The sentence, the table and what is assumed; a design that requires nothing is told so in a line.
#[must_use]
pub fn requirements(name: &str, found: Option<&AssessAnswer>) -> Sheet {
    let Some(found) = found else {
        let mut sheet = Sheet::new();
        nothing_required(&mut sheet, name);
        return sheet;
    };
    let mut sheet = requirements_without_assumptions(found);
    sheet.add(assumptions(found));
    sheet
}

/// The verdict and the table.
#[must_use]
pub fn requirements_without_assumptions(found: &AssessAnswer) -> Sheet {
    let mut sheet = Sheet::new();
    sheet.line(sentence(found));
    sheet.space();
    sheet.table(table(found));
    sheet
}

/// The assumptions of the answer.
#[must_use]
pub fn assumptions(found: &AssessAnswer) -> Sheet {
    assumed(&found.assumptions)
}

/// The assumptions of an answer, a line for each sentence at its end.
pub(super) fn assumed(sentences: &[String]) -> Sheet {
    let mut sheet = Sheet::new();
    if !sentences.is_empty() {
        sheet.line("Assumed:");
        for sentence in sentences {
            say!(sheet, "  {sentence}");
        }
    }
    sheet
}

/// The verdict in a sentence that names the violated requirements.
#[must_use]
pub fn sentence(found: &AssessAnswer) -> String {
    format!("{} {}", found.name, found.explanation)
}

/// The table: a row for each kind of requirement with the critical pose and legs, then singularity and conditioning.
#[must_use]
pub fn table(found: &AssessAnswer) -> Table {
    // a column for the safety margin, if the design requires one on any limit
    let reserved = found.requirements.iter().any(|m| m.safety_margin.0 > 0.0);
    let mut table = Table::new(
        [left("requirement", 17), left("status", 9).gap(2), right("least margin", 0).gap(2)]
            .into_iter()
            .chain(reserved.then(|| right("after safety margin", 0).gap(2)))
            .chain([
                right("proved margin", 0).gap(2),
                left("unit", 0),
                left("binds at", 0).gap(2),
                left(format!("worst pose {POSE} [deg]"), 0).gap(2),
            ]),
    );
    // `left`: the margin minus the safety margin
    let mut row =
        |name: &str, status: Cell, [margin, proved]: [&str; 2], left: Cell, [unit, of, pose]: [&str; 3]| {
            let left = reserved.then_some(left);
            table.row(
                [name.into(), status, margin.into()]
                    .into_iter()
                    .chain(left)
                    .chain([proved, unit, of, pose].map(Cell::from)),
            );
        };
    for m in &found.requirements {
        let (tone, margin) = match () {
            () if m.at_limit => (Tone::AtLimit, 0.0),
            () if m.violates() => (Tone::No, m.margin.0),
            () => (Tone::of(m.met), m.margin.0),
        };
        let proved = match m.proved_margin.0 {
            x if m.status == MarginVerdict::AtLimit || x == 0.0 => figure(0.0),
            x if x.is_finite() => figure(x),
            _ => "none".into(),
        };
        let short = if m.safety_margin_kept == Some(false) { Tone::No } else { Tone::Plain };
        row(
            m.name.label(),
            Cell::toned(m.status.name().replace('_', " "), tone),
            [&figure(margin), &proved],
            Cell::toned(figure(m.net_margin.0), short),
            [&m.unit, &m.between.join(", "), &place(m.pose.as_ref())],
        );
    }
    // rows without a margin: the sign of det J, and the conditioning, which has no limit
    let (tone, status) = match found.regular.status {
        RegularityWord::Proved => (Tone::Yes, "met"),
        RegularityWord::ChangesSign => (Tone::No, "violated"),
        RegularityWord::Undecided => (Tone::Open, "undecided"),
    };
    let at = place(found.regular.pose.as_ref());
    row("no singular pose", Cell::toned(status, tone), ["-", "-"], "-".into(), ["", "sign of det J", &at]);
    let c = &found.conditioning;
    let value = figure(c.inverse_condition.0);
    let of = "1 at best, 0 at a singular pose";
    row("conditioning", "no limit".into(), [&value, "-"], "-".into(), ["", of, &pose(&c.pose)]);
    table
}

/// Whether a margin is kept, in a cell.
pub(super) fn judged(margin: &MarginRecord, text: impl Into<String>) -> Cell {
    let tone = match () {
        () if margin.at_limit => Tone::AtLimit,
        () if margin.violates() => Tone::No,
        () => Tone::Plain,
    };
    Cell::toned(text, tone)
}
