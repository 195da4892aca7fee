//! `equipod fk DESIGN --angles`: poses for given angles of cranks.
//!
//! At given angles the crank tips act as base joints, and the rods as legs of known lengths. The platform on the tips,
//! rounded to doubles, is solved and certified.

use std::path::Path;

use super::near::{self, TrackedMachine};
use super::{FkArgs, PoseTable, answered, exit_of, failure_of, threads};
use crate::app::cli::numbers;
use crate::app::cli::poses;
use crate::app::cli::rows::{self, TableName};
use crate::app::cli::{Answer, Context, Exit, Failure};
use ask::{Design, PoseFrames};
use files::design::{SeriesKind, SeriesRow, TimeSeries};
use fk::{self, FkOptions, FkSolutions};
use machine::rotary::{RotaryFkError, RotaryPlatform, RotaryTracker};
use platform::geom::Pose;
use platform::manipulator::Manipulator;
use records::{FkAnswer, FkOneAnswer, FkRowOutcome, FkRowRecord, RowFailure, SolvedRecord};

/// Six angles in degrees.
type AnglesDeg = [f64; 6];

const BAD_ANGLES: &str = "fk::bad_angles";

/// Angles from one argument, or from a table.
fn given(option: Option<&str>, context: &Context) -> Result<TimeSeries<AnglesDeg>, Failure> {
    let Some(text) = option else {
        return Err(Failure::refused(
            "fk::no_angles",
            "the legs are rods on cranks, and --angles was not given",
        )
        .with_help("give --angles a1,a2,a3,a4,a5,a6 in degrees, or --angles FILE.csv"));
    };
    let six =
        |line: &str| numbers::parse::<6>(line).ok_or_else(|| format!("`{line}` is not six finite angles"));
    if text.contains(',') || text.parse::<f64>().is_ok() {
        let value = six(text).map_err(|message| {
            Failure::refused(BAD_ANGLES, format!("--angles: {message}"))
                .with_help("give six angles in degrees separated by commas, or a CSV file")
        })?;
        let rows = vec![SeriesRow { line: 0, time: None, value }];
        return Ok(TimeSeries::of_rows(rows));
    }
    let form = "six angles in degrees a line: a1,a2,a3,a4,a5,a6";
    let table = TableName { path: Path::new(text), code: BAD_ANGLES, form };
    // angles have no unit of length
    rows::read(SeriesKind::Angles, table, "", context, six)
}

/// Poses for the angles of the options.
pub(super) fn run(
    args: &FkArgs,
    (design, platform): (&Design, &RotaryPlatform),
    context: &Context,
) -> Result<Answer, Failure> {
    context.no_effect("lengths", "the rods of a design with cranks have constant lengths; give --angles")?;
    let series = given(args.angles.as_deref(), context)?;
    let frames = args.frames.of(design);
    let table = PoseTable {
        requested: args.csv,
        all: args.all,
        time_name: series.time_name.clone(),
        frames,
        limits: args.limits,
    };
    // one line of the command has no number; lines of a table count from 1
    let one = series.rows.len() == 1 && series.rows[0].line == 0;
    let machine = CrankMachine { design, platform, frames, seed: context.seed() };
    let (exits, outcomes) = if let Some(start) = &args.near {
        context.no_effect("threads", "each row is followed from the row before it")?;
        let start = poses::parse(start, &frames, ("--near", "fk::bad_pose"), context)?;
        machine.follow(&series.rows, &start)?
    } else {
        if one {
            context.no_effect(
                "threads",
                "one set of angles is solved on one thread, the rows of a CSV file on many",
            )?;
        }
        let method = args.method.parse().ok();
        let mut options = FkOptions::new().seed(machine.seed);
        options.method = method;
        let solve = |i: usize| machine.solve(&series.rows[i].value, &options);
        let solved = fk::in_order(series.rows.len(), threads(args.threads), &solve);
        if let (true, Some(Err(failure))) = (one, solved.first()) {
            return Err(failure.clone());
        }
        let exits = solved.iter().map(|s| s.as_ref().map_or_else(|f| f.exit, |(exit, _)| *exit)).collect();
        let outcome = |found: Result<(Exit, FkOneAnswer), Failure>| match found {
            Ok((_, answer)) => FkRowOutcome::Solved(Box::new(answer)),
            Err(failure) => FkRowOutcome::Failed(RowFailure { error: (&failure).into() }),
        };
        (exits, solved.into_iter().map(outcome).collect())
    };
    let exit = exits.into_iter().fold(Exit::Yes, Exit::max);
    let answer = machine.answer(one, &series.rows, outcomes);
    Ok(answered(exit, answer, design, &table))
}

/// A machine with cranks whose poses are requested.
struct CrankMachine<'a> {
    design: &'a Design,
    platform: &'a RotaryPlatform,
    frames: PoseFrames,
    seed: u64,
}

impl CrankMachine<'_> {
    fn solve(&self, degrees: &AnglesDeg, options: &FkOptions) -> Result<(Exit, FkOneAnswer), Failure> {
        let angles = degrees.map(f64::to_radians);
        let found: FkSolutions = self.platform.fk(&angles, options).map_err(|why| match why {
            RotaryFkError::Fk(why) => failure_of(&why),
            other @ RotaryFkError::Manipulator(_) => Failure::refused(BAD_ANGLES, other.to_string()),
        })?;
        let tips = self.tips(&angles)?;
        let solved = SolvedRecord::from(&found).with_real_poses(&tips, &self.frames);
        let solved = solved.with_elbows(self.platform, &angles);
        let symmetric_finite = self.platform.symmetric_pose_count(&angles);
        let answer = FkOneAnswer { symmetric_finite, ..solved.into() };
        Ok((exit_of(&found), answer.with_angles(self.platform, &angles, *degrees)))
    }

    fn tips(&self, angles: &[f64; 6]) -> Result<Manipulator, Failure> {
        self.platform.at(angles).map_err(|why| Failure::refused(BAD_ANGLES, why.to_string()))
    }

    /// Tracks one pose, starting from its crank angles. After a failed row, the next row starts from the last tracked
    /// pose.
    fn follow(
        &self,
        rows: &[SeriesRow<AnglesDeg>],
        start: &Pose,
    ) -> Result<(Vec<Exit>, Vec<FkRowOutcome>), Failure> {
        let angles = self.platform.ik(start).map_err(|why| {
            Failure::refused("fk::bad_pose", format!("--near: the cranks do not hold this pose: {why}"))
                .with_help("give a pose for which `equipod ik` finds angles")
        })?;
        let mut tracker = RotaryTracker::new(self.platform.clone(), *start, angles);
        let (mut exits, mut outcomes) = (Vec::new(), Vec::new());
        for row in rows {
            let from = tracker.pose();
            let angles = row.value.map(f64::to_radians);
            let found = tracker.step(&angles);
            let outcome = found.map_err(|why| Failure::refused(BAD_ANGLES, why.to_string()))?;
            let tips = self.tips(&angles)?;
            let machine = TrackedMachine {
                m: &tips,
                frames: self.frames,
                characteristic_length: self.design.characteristic_length(),
            };
            let mut record = near::record(&machine, self.platform.rods(), &from, &outcome, self.seed);
            record.solved = record.solved.with_elbows(self.platform, &angles);
            record = record.with_angles(self.platform, &angles, row.value);
            exits.push(near::exit_of(&outcome));
            outcomes.push(FkRowOutcome::Solved(Box::new(record)));
        }
        Ok((exits, outcomes))
    }

    fn answer(&self, one: bool, rows: &[SeriesRow<AnglesDeg>], outcomes: Vec<FkRowOutcome>) -> FkAnswer {
        let row = |(row, outcome): (&SeriesRow<AnglesDeg>, FkRowOutcome)| FkRowRecord {
            line: row.line,
            time: row.time,
            lengths: self.platform.rods().get(),
            angles_deg: Some(row.value),
            outcome,
        };
        let mut rows: Vec<FkRowRecord> = rows.iter().zip(outcomes).map(row).collect();
        match rows.pop() {
            Some(FkRowRecord { outcome: FkRowOutcome::Solved(answer), .. }) if one => FkAnswer::One(answer),
            last => {
                rows.extend(last);
                FkAnswer::rows(rows)
            }
        }
    }
}
