//! The affine map between squared leg lengths.

use super::frames::frames;
use super::poses::full_sentence;
use crate::figure::figure;
use crate::{Cell, Sheet, Table, left, right};
use records::{CorrespondenceRecord, MapAnswer, MapRecord, MappedLengthsRecord};
use synthesis::Relation;

/// The answer of `equivalents map`, between designs of these names.
#[must_use]
pub fn map(answer: &MapAnswer, from: &str, to: &str) -> Sheet {
    let mut sheet = frames(&answer.frames);
    sheet.add(leg_map(&answer.map, from, to));
    if let Some(line) = same_legs(&answer.correspondence) {
        sheet.line(line);
    }
    if let Some(lengths) = &answer.lengths {
        mapped(&mut sheet, lengths);
    }
    sheet
}

fn mapped(out: &mut Sheet, lengths: &MappedLengthsRecord) {
    out.space();
    let Some(to) = &lengths.to else {
        say!(out, "No lengths of TO: {}", lengths.reason.as_deref().unwrap_or_default());
        return;
    };
    let mut table = Table::new([left("", 6), right("FROM", 9), right("TO", 9).gap(2)]);
    for (k, (from, to)) in lengths.from.iter().zip(to).enumerate() {
        table.row([format!("leg {}", k + 1), figure(from.0), figure(to.0)]);
    }
    out.table(table);
}

fn same_legs(c: &CorrespondenceRecord) -> Option<String> {
    let named: Vec<(usize, usize)> =
        c.legs.iter().enumerate().filter_map(|(i, leg)| leg.map(|old| (i + 1, old))).collect();
    let worst = named.iter().map(|(i, _)| c.distances[i - 1].0).fold(0.0, f64::max);
    let nearly = if c.exact { String::new() } else { format!(", up to {} of the size", figure(worst)) };
    if c.permutation {
        let order: Vec<String> = named.iter().map(|(_, old)| old.to_string()).collect();
        return Some(format!("the legs of TO are legs {} of FROM{nearly}", order.join(", ")));
    }
    let list: Vec<String> =
        named.iter().map(|(i, old)| format!("leg {i} of TO is leg {old} of FROM")).collect();
    (!list.is_empty()).then(|| format!("{}{nearly}", list.join(", ")))
}

/// A map with its evidence, in words.
#[must_use]
pub fn leg_map(r: &MapRecord, from: &str, to: &str) -> Sheet {
    let mut out = Sheet::new();
    say!(out, "{from} -> {to}: {}", r.relation.unwrap_or(Relation::Undecided).name());
    let short = r.det_exact.as_ref().filter(|exact| exact.len() <= WRITTEN);
    let exactly = match short {
        Some(exact) if *exact == figure(r.determinant.0) => ", exactly".to_owned(),
        Some(exact) => format!(" = {exact} exactly"),
        None => String::new(),
    };
    say!(out, "det A = {}{exactly}\n{}\n", figure(r.determinant.0), full_sentence(&r.explanation));
    out.line("Squared leg lengths: s(TO) = A s(FROM) + c, with c in square units and residuals relative to the size");
    let entries = (1..=6).map(|k| right(format!("A{k}"), 7));
    let columns = [left("", 6)].into_iter().chain(entries);
    let mut table = Table::new(columns.chain([right("c", 8).gap(2), right("residual", 0).gap(2)]));
    for (i, row) in r.matrix.iter().enumerate() {
        let (constant, residual) = (r.constants[i].0, r.residuals[i].0);
        let cells = [format!("leg {}", i + 1)].into_iter().chain(row.iter().map(|x| figure(x.0)));
        table.row(cells.chain([figure(constant), figure(residual)]).map(Cell::from));
    }
    out.table(table);
    exact_rows(&mut out, r);
    out
}

/// The greatest length of a number in an exact row, characters: the decimals of an optimised offset would fill a line
/// each.
pub(super) const WRITTEN: usize = 24;

/// Numbers times symbols and a constant, with signs and without ones and zeros.
pub(super) fn combination(terms: impl IntoIterator<Item = (String, String)>, constant: &str) -> String {
    let term = |(number, symbol): (String, String)| match number.as_str() {
        "0" => None,
        "1" => Some(symbol),
        "-1" => Some(format!("-{symbol}")),
        sum if sum.contains(' ') && !sum.starts_with('(') => Some(format!("({sum}) {symbol}")),
        one => Some(format!("{one} {symbol}")),
    };
    let constant = (constant != "0").then(|| constant.to_owned());
    let all: Vec<String> = terms.into_iter().filter_map(term).chain(constant).collect();
    all.join(" + ").replace("+ -", "- ")
}

/// The map in exact numbers, one formula for each leg.
fn exact_rows(out: &mut Sheet, r: &MapRecord) {
    let (Some(a), Some(c), Some(shares)) = (&r.matrix_exact, &r.constants_exact, &r.singular_offsets) else {
        return;
    };
    out.line("\nThe same map in exact numbers:");
    if a.iter().flatten().chain(c).any(|x| x.len() > WRITTEN) {
        out.line("  The numbers are too long for a table; --json has them as A_exact and c_exact.");
        return;
    }
    for i in 0..6 {
        let terms = (0..6).filter(|k| a[i][*k] != "0").map(|k| (a[i][k].clone(), format!("s{}", k + 1)));
        let row = combination(terms, &c[i]);
        let singular = shares[i].as_ref().filter(|share| share.len() <= WRITTEN);
        let singular = singular.map_or_else(String::new, |t| format!("    (det A = 0 for offset t = {t})"));
        say!(out, "  s{}' = {row}{singular}", i + 1);
    }
    if let Some(polynomial) = &r.det_of_offsets {
        say!(
            out,
            "  For any offsets t on these edges, det A = {polynomial}; the platform is singular if det A = 0."
        );
    }
}
