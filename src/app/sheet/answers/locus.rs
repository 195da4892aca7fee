//! The squared length of a virtual leg at all poses while one leg length varies.

use crate::figure::figure;
use crate::{Sheet, Table, left, right};
use records::{LocusAnswer, LocusRowRecord};

/// The answer of `plot locus` for a design of this name.
#[must_use]
pub fn locus(name: &str, r: &LocusAnswer) -> Sheet {
    let [base, platform] = &r.between;
    let mut out = Sheet::new();
    say!(out, "{name}: squared distance of {base} and {platform} while the length of leg {} varies\n", r.leg);
    // consecutive lengths with the same numbers share one line
    let key = |r: &LocusRowRecord| {
        let real = r.values.iter().filter(|v| v.real == Some(true)).count();
        (r.values.len(), real, r.status, r.all_paths_accounted)
    };
    let counts = [right("poses", 5).gap(2), right("real", 4).gap(2), left("status", 0).gap(2)];
    let mut table = Table::new([right("length from", 9), right("to", 9)].into_iter().chain(counts));
    for group in r.rows.chunk_by(|a, b| key(a) == key(b)) {
        let (poses, real, status, complete) = key(&group[0]);
        let ends = [&group[0], &group[group.len() - 1]].map(|row| figure(row.length.0));
        let doubt = if complete { "" } else { " (poses may be missing)" };
        let counts = [poses, real].map(|n| n.to_string());
        table.row(ends.into_iter().chain(counts).chain([format!("{}{doubt}", status.name())]));
    }
    out.table(table);
    if !r.meetings.is_empty() {
        out.line("\nDouble values on the real axis, approximately:");
        let mut table = Table::new([right("length", 9), right("value", 9).gap(2)]);
        r.meetings.iter().for_each(|m| table.row([m.length, m.value].map(figure)));
        out.table(table);
    }
    out
}
