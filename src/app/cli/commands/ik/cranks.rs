//! Crank angles at given poses, for rods on cranks.

use crate::app::cli::table::{column_unit, csv_line, number};
use crate::app::cli::{Answer, Exit};
use ask::{Design, PoseFrames};
use files::design::TimeSeries;
use machine::rotary::RotaryPlatform;
use platform::geom::Pose;
use records::{IkAnswer, RotaryIkRecord, RotaryIkRowsAnswer};

/// Exit 1 if a rod does not reach at one of the poses.
pub(super) fn run(
    (design, platform): (&Design, &RotaryPlatform),
    frames: &PoseFrames,
    series: &TimeSeries<Pose>,
    (one, from_table): (bool, bool),
    with_details: bool,
) -> Answer {
    let records = series.rows.iter().map(|row| RotaryIkRecord {
        line: from_table.then_some(row.line),
        time: row.time,
        ..RotaryIkRecord::new(design, platform, &row.value, frames)
    });
    let mut records: Vec<RotaryIkRecord> = records.collect();
    let reached = records.iter().all(|r| r.out_of_reach.is_none());
    let text = table(design, series.time_name.as_deref(), &records, with_details);
    let answer = match records.pop() {
        Some(last) if one => IkAnswer::Cranks(Box::new(last)),
        last => {
            let rows = records.into_iter().chain(last).collect();
            IkAnswer::CrankRows(RotaryIkRowsAnswer { frames: (&frames.convention).into(), rows })
        }
    };
    let answer = answer.with_frames(&frames.convention);
    Answer::new(if reached { Exit::Yes } else { Exit::No }, answer, text)
}

/// The additional columns of `--details`: names and values, empty if a rod does not reach.
fn details(design: &Design, record: &RotaryIkRecord) -> Vec<(String, Option<f64>)> {
    let mut out = Vec::new();
    for i in 0..6 {
        let crank = record.cranks.get(i);
        out.push((format!("transmission_{}", i + 1), crank.map(|c| c.transmission)));
        out.push((format!("to_singular_{}_deg", i + 1), crank.map(|c| c.to_singular_deg)));
    }
    out.push(("inverse_condition".into(), record.inverse_condition.map(|x| x.0)));
    for load in design.all_loads() {
        let torques = record.torques.iter().find(|t| t.load == load.name).and_then(|t| t.torques);
        for i in 0..6 {
            out.push((format!("torque_{}_{}", i + 1, column_unit(&load.name)), torques.map(|t| t[i])));
        }
    }
    for margin in &record.margins {
        out.push((format!("margin_{}", margin.name.code()), Some(margin.margin.0)));
    }
    out
}

/// Table with one pose on each line, in the order given: kept angles, angles on the other sides, and whether all rods
/// reach.
fn table(design: &Design, time_name: Option<&str>, records: &[RotaryIkRecord], with_details: bool) -> String {
    let mut header: Vec<String> = time_name.map(str::to_string).into_iter().collect();
    for name in ["crank", "other"] {
        header.extend((1..=6).map(|leg| format!("{name}_{leg}_deg")));
    }
    header.extend(["within_limits", "out_of_reach_leg"].map(String::from));
    if let Some(first) = records.first().filter(|_| with_details) {
        header.extend(details(design, first).into_iter().map(|(name, _)| name));
    }
    let mut out = csv_line(&header);
    let cell = |x: Option<f64>| x.map(number).unwrap_or_default();
    for record in records {
        let mut cells: Vec<String> = Vec::new();
        if time_name.is_some() {
            cells.push(cell(record.time));
        }
        cells.extend((0..6).map(|i| cell(record.cranks.get(i).map(|c| c.angle_deg))));
        cells.extend((0..6).map(|i| cell(record.cranks.get(i).map(|c| c.other_angle_deg))));
        cells.push(record.within_limits.map(|within| within.to_string()).unwrap_or_default());
        cells.push(record.out_of_reach.map(|missing| missing.leg.to_string()).unwrap_or_default());
        if with_details {
            cells.extend(details(design, record).into_iter().map(|(_, value)| cell(value)));
        }
        out.push_str(&csv_line(&cells));
    }
    out
}
