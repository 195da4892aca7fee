//! Picture and table of a locus.

use std::fmt::Write as _;

use ask::{LocusReport, LocusWord};
use files::plot::{LocusFigure, locus_chart};
use records::{LocusAnswer, leg_number};

pub(super) fn picture(name: &str, found: &LocusReport) -> String {
    let (points, [base, platform]) = (&found.points, &found.between.names);
    let without = points.iter().filter(|p| p.word() != LocusWord::Isolated).count();
    let mut note = format!("{} lengths", points.len());
    if without > 0 {
        let _ = write!(note, ", {without} of them without isolated poses");
    }
    let incomplete = points.iter().filter(|p| !p.is_complete()).count();
    if incomplete > 0 {
        let _ = write!(note, ", {incomplete} of them perhaps with poses missing");
    }
    locus_chart(&LocusFigure {
        title: format!("{name}: squared distance of {base} and {platform} at all poses"),
        note,
        quantity: format!("|{base} {platform}|\u{b2}"),
        parameter: format!("length of leg {}", leg_number(found.leg)),
        steps: found.steps(),
    })
}

/// One line for each pose; lengths without isolated poses have one line with their status and no value.
pub(super) fn csv(answer: &LocusAnswer) -> String {
    let mut out = String::from("step,length,status,re,im,real,certified\n");
    for row in &answer.rows {
        let (k, length, status) = (row.step, row.length.0, row.status.name());
        for v in &row.values {
            let real = v.real.map_or_else(|| "undecided".to_string(), |real| real.to_string());
            let _ = writeln!(out, "{k},{length},{status},{},{},{real},{}", v.re.0, v.im.0, v.certified);
        }
        if row.values.is_empty() {
            let _ = writeln!(out, "{k},{length},{status},,,,");
        }
    }
    out
}
