//! The table of requirements, which leads every answer that judges a design.

use std::fmt::Write as _;

use machine::requirements::MarginVerdict;
use records::{AssessAnswer, MarginRecord, PoseQuaternionRecord, RegularityWord};

/// Width of a column of numbers in the table.
const COLUMN: usize = 14;

/// The sentence, the table and what was assumed of masses; a design that requires nothing is told so in a line.
pub(crate) fn lead(name: &str, found: Option<&AssessAnswer>) -> String {
    found.map_or_else(
        || format!("{name} requires nothing: it has no limits of lengths, swing, room, forces or speeds\n"),
        |found| format!("{}{}", without_assumptions(name, found), assumptions(found)),
    )
}

/// The sentence and the table.
pub(crate) fn without_assumptions(name: &str, found: &AssessAnswer) -> String {
    format!("{}\n{}", sentence(name, found), table(found))
}

/// The assumptions about masses, a line for each sentence.
pub(crate) fn assumptions(found: &AssessAnswer) -> String {
    found.assumptions.iter().flat_map(|line| [line.as_str(), "\n"]).collect()
}

/// The answer in a sentence that names what is missed.
pub(crate) fn sentence(name: &str, found: &AssessAnswer) -> String {
    format!("{name} {}\n", found.explanation)
}

/// Whether the design asks for a reserve on any limit.
fn has_reserve(found: &AssessAnswer) -> bool {
    found.requirements.iter().any(|m| m.reserve.0 > 0.0)
}

/// A row for each kind of requirement with the pose and the legs where it binds, then singularity and conditioning.
pub(crate) fn table(found: &AssessAnswer) -> String {
    let mut out = String::new();
    let with_reserve = has_reserve(found);
    let width = widest(found);
    let column = if with_reserve { format!(" {:>14}", "less reserve") } else { String::new() };
    // writing to a string cannot fail
    let _ = writeln!(
        out,
        "{:<width$} {:<9} {:>14}{column} {:>14} {:<8} {:<24} worst pose x,y,z,qw,qx,qy,qz",
        "requirement", "status", "least margin", "proved margin", "unit", "of"
    );
    for m in &found.requirements {
        row(&mut out, m, with_reserve, width);
    }
    let blank = if with_reserve { format!(" {:>14}", "-") } else { String::new() };
    // rows without a margin: the sign of det J, and a number that has no limit
    let mut plain = |name: &str, mark: char, status: &str, [value, unit, of]: [&str; 3], pose: &str| {
        let _ = writeln!(
            out,
            "{name:<width$}{mark}{status:<9} {value:>14}{blank} {:>14} {unit:<8} {of:<24} {pose}",
            "-"
        );
    };
    let at = found.regular.pose.as_ref().map_or_else(|| "any".to_owned(), PoseQuaternionRecord::short);
    let (mark, status) = match found.regular.status {
        RegularityWord::Proved => (' ', "met"),
        RegularityWord::ChangesSign => ('!', "violated"),
        RegularityWord::Undecided => (' ', "undecided"),
    };
    plain("singularity", mark, status, ["-", "", "sign of det J"], &at);
    let c = &found.conditioning;
    let value = format!("{:.6}", c.inverse_condition.0);
    plain("conditioning", ' ', "no limit", [&value, "", "least found, 1 at best"], &c.pose.short());
    out
}

/// Room for the names of the rows.
fn widest(found: &AssessAnswer) -> usize {
    found.requirements.iter().map(|m| m.name.code().len()).fold(17, usize::max)
}

fn row(out: &mut String, m: &MarginRecord, with_reserve: bool, width: usize) {
    let pose = m.pose.as_ref().map_or_else(|| "any".to_string(), PoseQuaternionRecord::short);
    let (mark, value) = match () {
        () if m.at_limit => ('=', 0.0),
        () if m.violates() => ('!', m.margin.0),
        () => (' ', m.margin.0),
    };
    let below = match m.proved_margin.0 {
        x if m.status == MarginVerdict::AtLimit || x == 0.0 => format!("{:.6}", 0.0),
        x if x.is_finite() => decimals(x),
        _ => "none".into(),
    };
    let mut left = String::new();
    if with_reserve {
        let short = if m.reserve_kept == Some(false) { '!' } else { ' ' };
        left = format!("{short}{:>14}", decimals(m.margin_with_reserve.0));
    }
    let _ = writeln!(
        out,
        "{:<width$}{mark}{:<9} {:>14}{left} {below:>14} {:<8} {:<24} {pose}",
        m.name.code(),
        m.status.name(),
        decimals(value),
        m.unit,
        m.between.join(", ")
    );
}

/// A number with six decimals, or with as many as the column has room for.
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
