//! Whether two designs are kinematically equivalent.

use super::frames::frames;
use super::poses::full_sentence;
use crate::figure::figure;
use crate::{Sheet, Table, left, right};
use records::{SampleRecord, VerifyAnswer};

/// The answer of `verify` about designs of these names.
#[must_use]
pub fn verify(v: &VerifyAnswer, a: &str, b: &str) -> Sheet {
    let mut out = Sheet::new();
    if v.sampling.is_none() {
        // no motion was found: the explanation of the alignment is the answer
        say!(out, "{a} ~ {b}: {}", v.verdict.name().replace('_', " "));
        out.add(frames(&v.frames));
        return out;
    }
    out.add(frames(&v.frames));
    say!(out, "{a} ~ {b}: {}\n{}", v.verdict.name().replace('_', " "), full_sentence(&v.explanation));
    if let Some(polynomial) = &v.map.det_of_offsets {
        say!(
            out,
            "For offsets t of the leg ends of B along their edges, det A = {polynomial}; B is singular if det A = 0."
        );
    }
    if v.samples.is_empty() {
        return out;
    }
    let numbers = ["poses A", "poses B", "matched", "real", "certified", "worst relative distance"];
    let columns = [right("sample", 0)].into_iter().chain(numbers.map(|title| right(title, 0).gap(2)));
    let mut table = Table::new(columns.chain([left("", 0).gap(2)]));
    for (k, s) in v.samples.iter().enumerate() {
        table.row([
            (k + 1).to_string(),
            s.a.finite_count.to_string(),
            s.b.finite_count.to_string(),
            s.matched.to_string(),
            s.b.real_count.to_string(),
            format!("{}+{}", s.a.certified_count, s.b.certified_count),
            figure(s.worst_distance.0),
            remark(s),
        ]);
    }
    out.space();
    out.table(table);
    out
}

/// The open points of a sample.
fn remark(s: &SampleRecord) -> String {
    let beyond =
        [("A", s.beyond_precision_a), ("B", s.beyond_precision_b)].into_iter().filter(|(_, n)| *n > 0);
    let mut all: Vec<String> =
        beyond.map(|(platform, n)| format!("{n} of {platform} beyond double precision")).collect();
    if !(s.a.all_paths_accounted && s.b.all_paths_accounted) {
        all.push("poses may be missing".into());
    }
    all.join("  ")
}
