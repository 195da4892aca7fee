//! Margins of the requirements of a design; this table leads every answer that assesses a design.

use crate::{Cell, Sheet, Table, Tone, left, right};
use machine::requirements::MarginVerdict;
use records::{AssessAnswer, MarginRecord, PoseQuaternionRecord};
use synthesis::singularity::RegularityWord;

/// The answer of `assess`.
#[must_use]
pub fn assess(found: &AssessAnswer) -> Sheet {
    let mut sheet = requirements(&found.name, Some(found));
    let at = place(found.regular.pose.as_ref());
    let said = &found.regular_explanation;
    sheet.space();
    sheet.line(match found.regular.status {
        RegularityWord::Proved => format!("{said}."),
        RegularityWord::ChangesSign => format!("{said}, {at}."),
        RegularityWord::Undecided => format!("{said}; undecided near {at}."),
    });
    if let Some(t) = &found.tightest {
        say!(sheet, "Least room: {}, {:.1} % of its limit.", t.name.code(), 100.0 * t.share.0);
    }
    if let Some(d) = &found.lightest_drive {
        say!(sheet, "{}.", d.message);
    }
    sheet.line("A margin below 0 is a violation (!); = at the limit, as far as rounding can tell, which is none. The proved margin is one that no pose judged falls below.");
    if found.met.is_none() {
        sheet.line(
            "What is only searched may be violated between the poses looked at; more --cells may prove it.",
        );
    }
    sheet
}

/// The verdict, the table and the assumptions about masses; for a design without requirements one line says so.
#[must_use]
pub fn requirements(name: &str, found: Option<&AssessAnswer>) -> Sheet {
    let Some(found) = found else {
        let mut sheet = Sheet::new();
        say!(sheet, "{name} requires nothing: it has no limits of lengths, swing, room, forces or speeds");
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

/// The assumptions about masses, a line for each sentence.
#[must_use]
pub fn assumptions(found: &AssessAnswer) -> Sheet {
    let mut sheet = Sheet::new();
    found.assumptions.iter().for_each(|line| sheet.line(line));
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
    let reserved = found.requirements.iter().any(|m| m.reserve.0 > 0.0);
    let mut table = Table::new(
        [left("requirement", 17), left("status", 9), right("least margin", COLUMN)]
            .into_iter()
            .chain(reserved.then(|| right("less reserve", COLUMN)))
            .chain([
                right("proved margin", COLUMN),
                left("unit", 8),
                left("of", 24),
                left("worst pose x,y,z,qw,qx,qy,qz", 0),
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
            x if m.status == MarginVerdict::AtLimit || x == 0.0 => decimals(0.0),
            x if x.is_finite() => decimals(x),
            _ => "none".into(),
        };
        let short = if m.reserve_kept == Some(false) { Tone::No } else { Tone::Plain };
        row(
            m.name.code(),
            Cell::toned(m.status.name(), tone),
            [&decimals(margin), &proved],
            Cell::toned(decimals(m.margin_with_reserve.0), short),
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
    row("singularity", Cell::toned(status, tone), ["-", "-"], "-".into(), ["", "sign of det J", &at]);
    let c = &found.conditioning;
    let value = format!("{:.6}", c.inverse_condition.0);
    let of = "least found, 1 at best";
    row("conditioning", "no limit".into(), [&value, "-"], "-".into(), ["", of, &c.pose.short()]);
    table
}

fn place(pose: Option<&PoseQuaternionRecord>) -> String {
    pose.map_or_else(|| "any".to_owned(), PoseQuaternionRecord::short)
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

/// Width of a column of numbers.
const COLUMN: usize = 14;

/// A number with six decimals, or fewer if the column is too narrow.
fn decimals(x: f64) -> String {
    let plain = format!("{x:.6}");
    if plain.len() <= COLUMN || !x.is_finite() {
        return plain;
    }
    let whole = format!("{x:.0}");
    match COLUMN.checked_sub(whole.len() + 1) {
        Some(digits) if digits > 0 => format!("{x:.digits$}"),
        _ if whole.len() <= COLUMN => whole,
        _ => format!("{x:.6e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_fit_their_column() {
        let shown =
            [0.5, -123_456.0, 11_578_664_355.117, 999_999_999_999_999.0, -0.000_000_1, f64::NEG_INFINITY];
        let texts = shown.map(decimals);
        assert_eq!(
            texts,
            ["0.500000", "-123456.000000", "11578664355.12", "1.000000e15", "-0.000000", "-inf"]
        );
    }
}
