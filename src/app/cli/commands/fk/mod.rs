//! `equipod fk`: all poses for given leg lengths, or for given angles of cranks.

mod cranks;
mod csv;
mod drives;
pub(super) mod lengths;
mod near;
#[cfg(test)]
mod tests;

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::builder::PossibleValuesParser;

use super::pentapod;
use crate::app::cli::frames::FrameArgs;
use crate::app::cli::poses;
use crate::app::cli::proof::ProofArgs;
use crate::app::cli::{Answer, Context, Exit, Failure};
use ::files::design::{Accepts, SixOrFive};
use ask::{Design, PoseFrames};
use fk::{self, BatchResult, FkError, FkOptions, FkSolutions, Method, Threads};
use platform::manipulator::{LegLengths, Manipulator};
use records::{
    ClosureRecord, FkAnswer, FkOneAnswer, FkRowOutcome, FkRowRecord, METHODS, ProofFile, RowFailure,
    SolvedRecord,
};

use self::csv::PoseTable;
use self::lengths::GivenLengths;

/// Arguments of `fk`.
#[derive(Debug, clap::Args)]
#[expect(clippy::struct_excessive_bools, reason = "flags of the command line")]
pub(crate) struct FkArgs {
    /// Design file (.toml or .json), or `-` for standard input
    design: PathBuf,
    /// Six lengths (five for five legs), design units, or a table of lengths with optional times (`-` for standard
    /// input); default: from the design
    #[arg(long, value_name = "L1,..,L6|FILE")]
    lengths: Option<String>,
    /// Six crank angles, degrees, or a table of angles (`-` for standard input), for rods on cranks
    #[arg(long, value_name = "A1,..,A6|FILE", allow_hyphen_values = true, conflicts_with = "lengths")]
    angles: Option<String>,
    /// Method of solution; auto takes the best one for the design
    #[arg(long, default_value = "auto", value_parser = PossibleValuesParser::new(METHODS))]
    method: String,
    /// Show the closure polynomial in the squared distance of a base and a platform joint
    #[arg(long, value_name = "JOINT,JOINT", conflicts_with_all = ["near", "csv", "angles"])]
    between: Option<String>,
    /// Show the polynomial of all poses in the Cayley parameter c3 = z / w of the quaternion (w, x, y, z)
    #[arg(long, conflicts_with_all = ["near", "csv", "angles"])]
    polynomial: bool,
    /// Worker threads for the rows of a table; default: one for each processor
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Track one real pose from this one, row by row for a CSV file: `home`, `x,y,z,roll_deg,pitch_deg,yaw_deg` or
    /// `x,y,z,qw,qx,qy,qz`
    #[arg(long, value_name = "POSE", allow_hyphen_values = true, conflicts_with = "method")]
    near: Option<String>,
    /// Write a CSV table of the real poses, the nearest to home first
    #[arg(long, conflicts_with = "json")]
    csv: bool,
    /// Add the complex poses to --csv
    #[arg(long, requires = "csv")]
    all: bool,
    /// List only poses that meet the requirements; --json marks all
    #[arg(long)]
    limits: bool,
    #[command(flatten)]
    proof: ProofArgs,
    #[command(flatten)]
    frames: FrameArgs,
}

/// Solves one problem, or one for each row.
pub(crate) fn run(args: &FkArgs, context: &mut Context) -> Result<Answer, Failure> {
    let method: Option<Method> = args.method.parse().ok();
    let design = match context.load_six_or_five(&args.design, Accepts::CranksAndOffsets)? {
        SixOrFive::Six(design) => *design,
        SixOrFive::Five(five) => {
            let only = "it is for designs of six legs";
            for option in ["angles", "method", "between", "threads", "near", "csv", "limits", "proof"] {
                context.no_effect(option, only)?;
            }
            return pentapod::fk(&five, args.lengths.as_deref(), context);
        }
    };
    if let Some(platform) = Context::cranks_of(&design)? {
        context.no_effect("proof", "a proof is for legs of given lengths, not for cranks")?;
        return cranks::run(args, (&design, &platform), context);
    }
    context.no_effect("angles", "the legs change their lengths, and the design has no cranks")?;
    if args.near.is_none() {
        drives::refuse_without_start(&design)?;
    }
    let given = lengths::given(args.lengths.as_deref(), &design, context)?;
    let frames = args.frames.of(&design);
    let table =
        PoseTable { requested: args.csv, all: args.all, time_name: None, frames, limits: args.limits };
    if let Some(text) = &args.near {
        context.no_effect("threads", "each row is followed from the row before it")?;
        context.no_effect("proof", "a proof is for the whole list of poses")?;
        let start = poses::parse(text, &frames, ("--near", "fk::bad_pose"), context)?;
        if let Some(legs) = Context::coupled_of(&design)? {
            return Ok(drives::run(&design, legs, &given, start, context.seed(), &table));
        }
        return Ok(near::run(&design, &given, start, context.seed(), &table));
    }
    let m = design.manipulator();
    let between = args.between.as_deref().map(|text| pair(text, &design, "fk::unknown_joint")).transpose()?;
    let options = FkOptions::new().seed(context.seed());
    match given {
        GivenLengths::One(l) => {
            context.no_effect(
                "threads",
                "one set of lengths is solved on one thread, the rows of a CSV file on many",
            )?;
            let solutions = solve(method, m, &l.distances, &options)?;
            args.proof.write(context, || ProofFile::fk(&design, &l.distances, &solutions))?;
            let exit = exit_of(&solutions);
            if exit == Exit::Inconclusive {
                let lengths = l.distances.squared();
                context.offer_symmetry(design.snapped_to_prove(&lengths, &options), &design.units);
            }
            let mut answer = FkOneAnswer::from(SolvedRecord::from(&solutions).with_real_poses(m, &frames));
            let squares = l.distances.squared();
            answer.closure = match between {
                Some(pair) => Some(ClosureRecord::between(&design, &squares, &solutions, pair)),
                None if method == Some(Method::Trilateration) => {
                    Some(ClosureRecord::of_sequence(&design, &squares, &solutions))
                }
                None => None,
            };
            answer.polynomial = args.polynomial.then(|| fk::rotation_polynomial(&solutions).into());
            Ok(answered(exit, FkAnswer::One(Box::new(answer)), &design, &table))
        }
        GivenLengths::Rows(series) => {
            context.no_effect("between", "a polynomial belongs to one set of lengths")?;
            context.no_effect("polynomial", "a polynomial belongs to one set of lengths")?;
            context.no_effect("proof", "a proof belongs to one set of lengths")?;
            let table = PoseTable { time_name: series.time_name, ..table };
            let (exit, answer) = many(method, (m, &frames), &series.rows, &options, threads(args.threads));
            if exit == Exit::Inconclusive
                && let Some(row) = series.rows.first()
            {
                let lengths = row.value.distances.squared();
                context.offer_symmetry(design.snapped_to_prove(&lengths, &options), &design.units);
            }
            Ok(answered(exit, answer, &design, &table))
        }
    }
}

/// `--between`: a joint of the base and one of the platform by their names, in any order.
pub(super) fn pair(text: &str, design: &Design, code: &'static str) -> Result<(usize, usize), Failure> {
    let find = |names: &[String], name: &str| names.iter().position(|own| own == name.trim());
    let pair = text.split_once(',').and_then(|(x, y)| {
        let both = |a, b| Some((find(design.base_names(), a)?, find(design.platform_names(), b)?));
        both(x, y).or_else(|| both(y, x))
    });
    pair.ok_or_else(|| {
        let [base, platform] = [design.base_names(), design.platform_names()].map(|list| list.join(", "));
        let message = format!("--between: `{text}` is not a joint of the base and one of the platform");
        Failure::refused(code, message).with_help(format!("base joints: {base}; platform joints: {platform}"))
    })
}

/// The answer with its table if requested, or else with its sheet.
fn answered(exit: Exit, answer: FkAnswer, design: &Design, table: &PoseTable) -> Answer {
    let mut answer = answer.with_frames(&table.frames, &design.units);
    if table.limits {
        let required = design.requirements();
        answer = answer.with_limits(&design.reach(&required));
    }
    if let Some(text) = table.text(design, &answer) {
        Answer::new(exit, answer, text)
    } else {
        let sheet = sheet::answers::fk(&design.name, &design.units, &answer);
        Answer::new(exit, answer, sheet)
    }
}

/// The number of worker threads.
pub(super) fn threads(asked: Option<u16>) -> Threads {
    asked.and_then(|n| NonZeroUsize::new(n.into())).map_or(Threads::All, Threads::Count)
}

/// Solves every row independently: a failed row carries an `"error"` and does not stop the others.
fn many(
    method: Option<Method>,
    (m, frames): (&Manipulator, &PoseFrames),
    rows: &[lengths::Row],
    options: &FkOptions,
    threads: Threads,
) -> (Exit, FkAnswer) {
    let squares: Vec<_> = rows.iter().map(|row| row.value.distances.squared()).collect();
    let solver = fk::solver(method);
    let results = fk::solve_batch(solver.as_ref(), m, &squares, options, threads);
    // writing forty poses with all their numbers takes as long as finding them
    let solved = fk::in_order(rows.len(), threads, &|i| solved_row(&rows[i], &results[i], (m, frames)));
    let exit = solved.iter().map(|(exit, _)| *exit).fold(Exit::Yes, Exit::max);
    let rows = solved.into_iter().map(|(_, record)| record).collect();
    (exit, FkAnswer::rows(rows))
}

/// Exit code and record of one row.
fn solved_row(
    row: &lengths::Row,
    result: &BatchResult,
    (m, frames): (&Manipulator, &PoseFrames),
) -> (Exit, FkRowRecord) {
    let (exit, outcome) = match result {
        Ok(s) => {
            let solved = SolvedRecord::from(s).with_real_poses(m, frames);
            (exit_of(s), FkRowOutcome::Solved(Box::new(solved.into())))
        }
        Err(error) => {
            let failure = failure_of(error);
            (failure.exit, FkRowOutcome::Failed(RowFailure { error: (&failure).into() }))
        }
    };
    (
        exit,
        FkRowRecord { line: row.line, time: row.time, lengths: row.value.shown, angles_deg: None, outcome },
    )
}

fn solve(
    method: Option<Method>,
    m: &Manipulator,
    lengths: &LegLengths,
    options: &FkOptions,
) -> Result<FkSolutions, Failure> {
    let solver = fk::solver(method);
    solver.solve(m, &lengths.squared(), options).map_err(|e| failure_of(&e))
}

pub(super) fn failure_of(error: &FkError) -> Failure {
    match error {
        FkError::NotApplicable { .. } => {
            Failure::refused("fk::not_applicable", error.to_string()).with_help("take --method auto")
        }
        FkError::Contradiction { .. } => Failure::internal(error.to_string()),
        _ => Failure::new(Exit::Inconclusive, "fk::breakdown", error.to_string())
            .with_help("try another --method or --seed"),
    }
}

/// Exit code 0 if the answer is complete, 3 if poses may be missing.
fn exit_of(solutions: &FkSolutions) -> Exit {
    if solutions.is_complete() { Exit::Yes } else { Exit::Inconclusive }
}
