//! `equipod ik`: the leg lengths at given poses.

use std::path::PathBuf;

use crate::cli::context::Context;
use crate::cli::exit::Exit;
use crate::cli::failure::Failure;
use crate::cli::output::Answer;
use crate::cli::table::{column_unit, csv_line, number};
use crate::cli::{poses, rows};
use crate::design::{Design, SeriesRow, TimeSeries};
use crate::geom::Pose;
use crate::records::{IkAnswer, IkRecord, IkRowsAnswer};

/// Arguments of `ik`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Design file (.toml or .json), or `-` for standard input
    design: PathBuf,
    /// A pose, as often as there are poses: `home`, `x,y,z,roll_deg,pitch_deg,yaw_deg` or `x,y,z,qw,qx,qy,qz`; home when absent
    #[arg(long, value_name = "POSE", allow_hyphen_values = true)]
    pose: Vec<String>,
    /// A table with a pose a line (`-` for standard input), and times where it has them
    #[arg(long, value_name = "FILE", conflicts_with = "pose")]
    poses: Option<PathBuf>,
}

const BAD_POSE: &str = "ik::bad_pose";

/// Lengths are distances of joints: every pose has them.
pub(crate) fn run(args: &Args, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    let (series, one) = match &args.poses {
        Some(path) => (rows::poses(path, BAD_POSE, context)?, false),
        None => (named(&args.pose, &design)?, args.pose.len() < 2),
    };
    let from_table = args.poses.is_some();
    let record = |row: &SeriesRow<Pose>| record(&design, row, from_table);
    let mut records = series.rows.iter().map(record).collect::<Result<Vec<_>, _>>()?;
    let text = table(&design, series.time_name.as_deref(), &records);
    let answer = match records.pop() {
        Some(last) if one => IkAnswer::One(Box::new(last)),
        last => IkAnswer::Rows(IkRowsAnswer { rows: records.into_iter().chain(last).collect() }),
    };
    Ok(Answer::new(Exit::Yes, answer, text))
}

/// The poses of the options, home when there are none.
fn named(texts: &[String], design: &Design) -> Result<TimeSeries<Pose>, Failure> {
    let pose = |text: &String| poses::parse(text, design, "--pose", BAD_POSE);
    let mut all = texts.iter().map(pose).collect::<Result<Vec<_>, _>>()?;
    if all.is_empty() {
        all.push(poses::home(design));
    }
    let row = |(k, value): (usize, Pose)| SeriesRow { line: k + 1, time: None, value };
    Ok(TimeSeries {
        time_name: None,
        rows: all.into_iter().enumerate().map(row).collect(),
        guesses: Vec::new(),
    })
}

fn record(design: &Design, row: &SeriesRow<Pose>, from_table: bool) -> Result<IkRecord, Failure> {
    let Some(lengths) = row.value.lengths(design.manipulator()) else {
        let message = format!("pose {} is so far away that lengths overflow double precision", row.line);
        return Err(Failure::refused(BAD_POSE, message));
    };
    let lengths = lengths.get();
    let limits = design.hardware.leg_length.map(|limits| limits.range());
    let outside: Vec<usize> = match limits {
        Some((least, greatest)) => {
            (1..=6).filter(|leg| !(least..=greatest).contains(&lengths[leg - 1])).collect()
        }
        None => Vec::new(),
    };
    Ok(IkRecord {
        line: from_table.then_some(row.line),
        time: row.time,
        pose: (&row.value).into(),
        lengths,
        within_limits: limits.map(|_| outside.is_empty()),
        outside,
    })
}

/// The lengths, a pose a line, in the order given.
fn table(design: &Design, time_name: Option<&str>, records: &[IkRecord]) -> String {
    let unit = column_unit(&design.units);
    let limited = design.hardware.leg_length.is_some();
    let mut header: Vec<String> = time_name.map(str::to_string).into_iter().collect();
    header.extend((1..=6).map(|leg| format!("leg_{leg}_{unit}")));
    header.extend(limited.then(|| "within_limits".to_string()));
    let mut out = csv_line(&header);
    for record in records {
        let mut cells: Vec<String> = Vec::new();
        if time_name.is_some() {
            cells.push(record.time.map(number).unwrap_or_default());
        }
        cells.extend(record.lengths.map(number));
        cells.extend(record.within_limits.map(|within| within.to_string()));
        out.push_str(&csv_line(&cells));
    }
    out
}
