//! `equipod ik`: the leg lengths at given poses, or the angles of cranks.

mod cranks;

use std::path::PathBuf;

use crate::app::cli::frames::{FrameArgs, note_frames};
use crate::app::cli::table::{column_unit, csv_line, number};
use crate::app::cli::{Answer, Context, Exit, Failure};
use crate::app::cli::{poses, rows};
use ask::{Design, PoseFrames};
use files::design::{SeriesRow, TimeSeries};
use machine::requirements::Terms;
use platform::geom::Pose;
use platform::manipulator::LegLengths;
use records::{IkAnswer, IkRecord, IkRowsAnswer, Number};

/// Arguments of `ik`.
#[derive(Debug, clap::Args)]
pub(crate) struct IkArgs {
    /// Design file (.toml or .json), or `-` for standard input
    design: PathBuf,
    /// Table of poses, with optional times (`-` for standard input)
    #[arg(conflicts_with = "pose")]
    poses: Option<PathBuf>,
    /// Pose: `home`, `x,y,z,roll_deg,pitch_deg,yaw_deg` or `x,y,z,qw,qx,qy,qz`; repeat for several; default: home
    #[arg(long, value_name = "POSE", allow_hyphen_values = true)]
    pose: Vec<String>,
    /// Add columns for joint angles (cranks: transmissions and torques), conditioning and margins; --json has them
    #[arg(long)]
    details: bool,
    #[command(flatten)]
    frames: FrameArgs,
}

const BAD_POSE: &str = "ik::bad_pose";

/// Gives every pose its lengths: joint distances plus the offsets of a calibration. For joints that are not ideal,
/// drive lengths beside the distances.
pub(crate) fn run(args: &IkArgs, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load_with_cranks(&args.design)?;
    let frames = args.frames.of(&design);
    let (mut series, one) = match &args.poses {
        Some(path) => (rows::poses(path, BAD_POSE, (&frames, &design.units), context)?, false),
        None => (named(&args.pose, &frames, context)?, args.pose.len() < 2),
    };
    if args.poses.is_none() {
        series.frames = frames.convention;
    }
    let frames = PoseFrames { convention: series.frames, ..frames };
    note_frames(&frames, context);
    let from_table = args.poses.is_some();
    if let Some(platform) = Context::cranks_of(&design)? {
        return Ok(cranks::run((&design, &platform), &frames, &series, (one, from_table), args.details));
    }
    let required = design.requirements();
    let terms = Terms::new(design.manipulator(), &required, &poses::home(&design));
    let coupled = Context::coupled_of(&design)?;
    let known = design.machine_uncertainty();
    let record = |row: &SeriesRow<Pose>| {
        let distances = distances(&design, row)?.get();
        let record = IkRecord {
            line: from_table.then_some(row.line),
            time: row.time,
            ..IkRecord::new(&design, &terms, (&row.value, &frames), distances)
        };
        let Some(legs) = &coupled else {
            return Ok(match &known {
                Some(known) => record.with_uncertainty(&design, known, &row.value),
                None => record,
            });
        };
        let states = legs.states(&row.value).map_err(|why| {
            let message = format!("pose {}: the drives have no lengths: {why}", row.line);
            Failure::refused("ik::no_drive_length", message)
        })?;
        Ok(record.with_drives(&design, &terms, &row.value, (&distances, &states)))
    };
    let mut records = series.rows.iter().map(record).collect::<Result<Vec<_>, _>>()?;
    let text = table(&design, series.time_name.as_deref(), &records, args.details);
    let answer = match records.pop() {
        Some(last) if one => IkAnswer::One(Box::new(last)),
        last => IkAnswer::Rows(IkRowsAnswer {
            frames: (&frames.convention).into(),
            rows: records.into_iter().chain(last).collect(),
        }),
    };
    let answer = answer.with_frames(&frames.convention);
    Ok(Answer::new(Exit::Yes, answer, text))
}

/// The poses of the options; home if there are none.
fn named(texts: &[String], frames: &PoseFrames, context: &Context) -> Result<TimeSeries<Pose>, Failure> {
    let pose = |text: &String| poses::parse(text, frames, ("--pose", BAD_POSE), context);
    let mut all = texts.iter().map(pose).collect::<Result<Vec<_>, _>>()?;
    if all.is_empty() {
        all.push(frames.home);
    }
    let row = |(k, value): (usize, Pose)| SeriesRow { line: k + 1, time: None, value };
    Ok(TimeSeries::of_rows(all.into_iter().enumerate().map(row).collect()))
}

/// Distances of the joints at a pose.
fn distances(design: &Design, row: &SeriesRow<Pose>) -> Result<LegLengths, Failure> {
    row.value.lengths(design.manipulator()).ok_or_else(|| {
        let message = format!("pose {} is so far away that lengths overflow double precision", row.line);
        Failure::refused(BAD_POSE, message)
    })
}

/// The additional columns of `--details`: names and values, the same columns for every pose.
fn details(record: &IkRecord, units: &str) -> Vec<(String, f64)> {
    let mut out = Vec::new();
    let joints = &record.joints;
    let mut list = |name: &str, values: &[Number; 6]| {
        out.extend(values.iter().enumerate().map(|(i, x)| (format!("{name}_{}_deg", i + 1), x.0)));
    };
    list("base_cone_angle", &joints.base_cone_angle_deg);
    list("platform_cone_angle", &joints.platform_cone_angle_deg);
    for (name, pairs) in [
        ("base_universal", &joints.base_universal_deg),
        ("platform_universal", &joints.platform_universal_deg),
    ] {
        list(&format!("{name}_x"), &pairs.map(|p| p[0]));
        list(&format!("{name}_y"), &pairs.map(|p| p[1]));
    }
    if let Some(drives) = &record.drives {
        list("twist", &drives.twists_deg.map(Number));
    }
    out.push(("inverse_condition".into(), record.inverse_condition.0));
    if let Some(wrench) = &record.flexures {
        for (name, values) in [("flexure_force", &wrench.force), ("flexure_torque", &wrench.torque)] {
            out.extend(["x", "y", "z"].iter().zip(values).map(|(axis, x)| (format!("{name}_{axis}"), x.0)));
        }
    }
    if let Some(found) = &record.uncertainty {
        out.push((format!("deviation_position_{}", column_unit(units)), found.position.0));
        out.push(("deviation_rotation_deg".into(), found.rotation_deg.0));
    }
    for m in &record.margins {
        out.push((format!("margin_{}_{}", m.name.code(), column_unit(&m.unit)), m.margin.0));
    }
    out
}

/// The lengths, one pose on each line, in the order given.
fn table(design: &Design, time_name: Option<&str>, records: &[IkRecord], with_details: bool) -> String {
    let unit = column_unit(&design.units);
    let limited = records.first().is_some_and(|record| record.within_limits.is_some());
    let mut header: Vec<String> = time_name.map(str::to_string).into_iter().collect();
    // the controller's lengths come first; `fk --near` reads these columns
    if records.first().is_some_and(|r| r.drives.is_some()) {
        header.extend((1..=6).map(|leg| format!("drive_length_{leg}_{unit}")));
    }
    header.extend((1..=6).map(|leg| format!("leg_{leg}_{unit}")));
    header.extend(limited.then(|| "within_limits".to_string()));
    if let Some(first) = records.first().filter(|_| with_details) {
        header.extend(details(first, &design.units).into_iter().map(|(name, _)| name));
    }
    let mut out = csv_line(&header);
    for record in records {
        let mut cells: Vec<String> = Vec::new();
        if time_name.is_some() {
            cells.push(record.time.map(number).unwrap_or_default());
        }
        cells.extend(record.drives.iter().flat_map(|drives| drives.lengths).map(number));
        cells.extend(record.lengths.map(number));
        cells.extend(record.within_limits.map(|within| within.to_string()));
        if with_details {
            cells.extend(details(record, &design.units).into_iter().map(|(_, value)| number(value)));
        }
        out.push_str(&csv_line(&cells));
    }
    out
}
