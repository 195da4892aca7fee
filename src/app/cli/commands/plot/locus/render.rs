//! Picture, table and JSON of a locus.

use std::fmt::Write as _;

use num_complex::Complex64;

use super::{Row, RowPoses, VirtualLeg};
use files::plot::{LocusFigure, LocusStep, locus_chart, locus_meetings};
use fk::{FkRoot, Reality};
use records::{LocusAnswer, LocusRowRecord, LocusValueRecord, LocusWord, Number};

pub(super) fn picture(
    name: &str,
    leg: u8,
    between: &VirtualLeg,
    rows: &[Row],
    steps: &[LocusStep],
) -> String {
    let without = rows.iter().filter(|r| r.status() != LocusWord::Isolated).count();
    let mut note = format!("{} lengths", rows.len());
    if without > 0 {
        let _ = write!(note, ", {without} of them without isolated poses");
    }
    let incomplete = rows.iter().filter(|r| !r.complete()).count();
    if incomplete > 0 {
        let _ = write!(note, ", {incomplete} of them perhaps with poses missing");
    }
    locus_chart(&LocusFigure {
        title: format!("{name}: squared distance of {} and {} at all poses", between.base, between.platform),
        note,
        quantity: format!("|{} {}|\u{b2}", between.base, between.platform),
        parameter: format!("length of leg {leg}"),
        steps: steps.to_vec(),
    })
}

/// One line a pose; lengths without isolated poses have one line with their status and no value.
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

fn values(found: &RowPoses) -> Vec<LocusValueRecord> {
    let value = |(root, v): (&FkRoot, &Complex64)| LocusValueRecord {
        re: Number(v.re),
        im: Number(v.im),
        real: match root.reality {
            Reality::Real => Some(true),
            Reality::NonReal => Some(false),
            Reality::Undecided => None,
        },
        certified: root.certified(),
        multiplicity: root.multiplicity,
    };
    found.solutions.roots.iter().zip(&found.values).map(value).collect()
}

pub(super) fn record(leg: u8, between: &VirtualLeg, rows: &[Row], steps: &[LocusStep]) -> LocusAnswer {
    let row = |(step, row): (usize, &Row)| LocusRowRecord {
        step,
        length: Number(row.length),
        status: row.status(),
        all_paths_accounted: row.complete(),
        method: row.found.as_ref().map(|f| f.solutions.method),
        values: row.found.as_ref().map_or_else(Vec::new, values),
    };
    LocusAnswer {
        leg,
        between: [between.base.clone(), between.platform.clone()],
        rows: rows.iter().enumerate().map(row).collect(),
        meetings: locus_meetings(steps),
    }
}
