//! Picture, table, JSON and text of a locus.

use std::fmt::Write as _;

use num_complex::Complex64;

use super::{Between, Found, Row};
use crate::fk::{FkRoot, Reality};
use crate::plot::{LocusFigure, LocusStep, locus_chart, locus_meetings};
use crate::records::{LocusAnswer, LocusMeetingRecord, LocusRowRecord, LocusValueRecord, LocusWord, Number};

pub(super) fn picture(name: &str, leg: u8, between: &Between, rows: &[Row], steps: &[LocusStep]) -> String {
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

fn reality(r: Reality) -> &'static str {
    match r {
        Reality::Real => "true",
        Reality::NonReal => "false",
        Reality::Undecided => "undecided",
    }
}

/// One line a pose; lengths without isolated poses have one line with their status and no value.
pub(super) fn csv(rows: &[Row]) -> String {
    let mut out = String::from("step,length,status,re,im,real,certified\n");
    for (k, row) in rows.iter().enumerate() {
        let poses = row.found.iter().flat_map(|f| f.solutions.roots.iter().zip(&f.values));
        let mut any = false;
        for (root, v) in poses {
            any = true;
            let _ = writeln!(
                out,
                "{k},{},{},{},{},{},{}",
                row.length,
                row.status().as_str(),
                v.re,
                v.im,
                reality(root.reality),
                root.certified()
            );
        }
        if !any {
            let _ = writeln!(out, "{k},{},{},,,,", row.length, row.status().as_str());
        }
    }
    out
}

fn values(found: &Found) -> Vec<LocusValueRecord> {
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

pub(super) fn record(leg: u8, between: &Between, rows: &[Row], steps: &[LocusStep]) -> LocusAnswer {
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
        meetings: locus_meetings(steps).iter().map(LocusMeetingRecord::from).collect(),
    }
}

pub(super) fn text(name: &str, leg: u8, between: &Between, rows: &[Row], steps: &[LocusStep]) -> String {
    let mut out = format!(
        "{name}: squared distance of {} and {} while the length of leg {leg} varies\n\nlengths              poses  real  status\n",
        between.base, between.platform
    );
    // lengths in a row with the same numbers are one line
    let key = |r: &Row| {
        let roots = r.found.as_ref().map_or(&[][..], |f| &f.solutions.roots);
        let real = roots.iter().filter(|x| x.reality == Reality::Real).count();
        (roots.len(), real, r.status(), r.complete())
    };
    for group in rows.chunk_by(|a, b| key(a) == key(b)) {
        let (poses, real, status, complete) = key(&group[0]);
        let ends = (group[0].length, group[group.len() - 1].length);
        let doubt = if complete { "" } else { " (poses may be missing)" };
        let _ = writeln!(
            out,
            "{:>9.5} {:>9.5}  {poses:>5}  {real:>4}  {}{doubt}",
            ends.0,
            ends.1,
            status.as_str()
        );
    }
    let meetings = locus_meetings(steps);
    if !meetings.is_empty() {
        out.push_str("\ndouble values on the real axis, about:\n   length      value\n");
        for m in meetings {
            let _ = writeln!(out, "{:>9.5}  {:>9.5}", m.length, m.value);
        }
    }
    out
}
