//! The optimiser against 100,000 random feasible designs and against CMA-ES with 100 times its processor time.
//!
//! ```text
//! tests/optimizer/run [--random 100000] [--factor 100] [--threads 2] [--seed 1] [--seconds 600]
//!     [--walk-seconds 1800] [--only offsets|requirements] [--out FOLDER] [DESIGN ...]
//! tests/optimizer/run --timing
//! tests/optimizer/run --gaps 100 [--threads 2] [--seed 1]
//! ```
//!
//! Default: all designs of `designs/`, `designs/worked/` and `designs/presets/`. The problem of a design is that of
//! `equipod optimize`. Octahedral ones are taken without their requirements too. Then the offsets alone vary, once with
//! joints up to one edge length out and once inside the edges.
//!
//! Random search draws from the box of the variables for `--seconds` of processor time. When it finds fewer than
//! `--random` feasible designs, walks inside the feasible set go on. They start from the feasible designs that either
//! rival found, and end at that number or after `--walk-seconds`.
//!
//! Prints a Markdown table. With `--out` writes it, the rows as CSV and a picture of the convergence for each problem.
//! Rows of other problems that are there already are kept. Exit 1 when the optimiser loses. `--timing`: the time of
//! problems with 200 poses instead. `--gaps`: the gaps proved on so many random pairs of triangles.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a program that prints tables")]

mod cap;
mod dimensional;
mod evolution;
mod gaps;
mod judge;
mod question;
mod random;
mod record;
mod region;
mod report;
mod timing;
mod verdict;

use std::error::Error;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use equipod::methods::design::{Design, Format, parse};
use equipod::methods::dimensional::DimensionalProblem;
use equipod::methods::offsets::{OffsetProblem, OffsetProgress, OffsetSearchOptions, optimize};

use dimensional::{Built, DimensionalJudge};
use evolution::evolution;
use judge::{Judge, OffsetJudge, offset_problem};
use random::{random_search, walks};
use record::{Clock, Point, Rival, Spent};
use report::{Report, Row};
use verdict::{Judged, Verdict};

type Failure = Box<dyn Error>;

/// The folder of the project, seen from that of the package `tests/optimizer`.
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

/// The arguments of the command line.
#[derive(Debug)]
struct Arguments {
    random: usize,
    factor: f64,
    seconds: f64,
    walk_seconds: f64,
    threads: usize,
    seed: u64,
    out: Option<PathBuf>,
    designs: Vec<PathBuf>,
    only: Only,
    timing: bool,
    gaps: Option<u64>,
}

/// The problems to take of a design.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Only {
    All,
    Offsets,
    Requirements,
}

fn arguments() -> Result<Option<Arguments>, Failure> {
    let mut a = Arguments {
        random: 100_000,
        factor: 100.0,
        seconds: 600.0,
        walk_seconds: 1800.0,
        threads: 2,
        seed: 1,
        out: None,
        designs: Vec::new(),
        only: Only::All,
        timing: false,
        gaps: None,
    };
    let mut measured = false;
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        let mut next = || words.next().ok_or(format!("{word} needs a value"));
        match word.as_str() {
            // the argument that cargo gives to programs that measure, and not to those it only tests
            "--bench" => measured = true,
            "--random" => a.random = next()?.parse()?,
            "--factor" => a.factor = next()?.parse()?,
            "--seconds" => a.seconds = next()?.parse()?,
            "--walk-seconds" => a.walk_seconds = next()?.parse()?,
            "--threads" => a.threads = next()?.parse()?,
            "--seed" => a.seed = next()?.parse()?,
            "--out" => a.out = Some(next()?.into()),
            "--only" => {
                a.only = match next()?.as_str() {
                    "offsets" => Only::Offsets,
                    "requirements" => Only::Requirements,
                    other => return Err(format!("--only offsets or requirements, not {other}").into()),
                }
            }
            "--timing" => a.timing = true,
            "--gaps" => a.gaps = Some(next()?.parse()?),
            other if other.starts_with('-') => return Err(format!("unknown option {other}").into()),
            file => a.designs.push(file.into()),
        }
    }
    if a.designs.is_empty() {
        a.designs = shipped()?;
    }
    Ok(measured.then_some(a))
}

/// All designs of the repository.
fn shipped() -> Result<Vec<PathBuf>, Failure> {
    let root = Path::new(ROOT).join("designs");
    let mut out = Vec::new();
    for folder in [root.clone(), root.join("worked"), root.join("presets")] {
        let Ok(entries) = std::fs::read_dir(folder) else { continue };
        for entry in entries {
            let path = entry?.path();
            if path.extension().is_some_and(|e| e == "toml") {
                out.push(path);
            }
        }
    }
    out.sort();
    Ok(out)
}

fn load(path: &Path) -> Result<Design, Failure> {
    let text = std::fs::read_to_string(path)?;
    let (design, _) = parse(&text, Format::of_path(path))
        .map_err(|v| format!("{}: {}", path.display(), v.first().map_or("", |v| v.message.as_str())))?;
    Ok(design)
}

/// The optimiser's own answer, with its cost.
#[derive(Debug)]
struct Answer {
    judged: Option<Judged>,
    curve: Vec<Point>,
    spent: Spent,
    /// Proved upper bound of the objective.
    bound: Option<f64>,
}

fn optimise(p: &OffsetProblem, judge: &OffsetJudge, a: &Arguments) -> Result<Answer, Failure> {
    let options = OffsetSearchOptions { seed: a.seed, threads: a.threads, ..OffsetSearchOptions::default() };
    let clock = Clock::start();
    let mut curve: Vec<Point> = Vec::new();
    let report = optimize(p, &options, &mut |progress| {
        let value = match progress {
            OffsetProgress::Ranking { best, .. }
            | OffsetProgress::Polishing { best, .. }
            | OffsetProgress::Bounding { best, .. } => best,
            _ => 0.0,
        };
        if curve.last().map_or(0.0, |p| p.value) < value {
            curve.push(Point { elapsed: clock.spent().elapsed, value });
        }
        ControlFlow::Continue(())
    })?;
    let spent = clock.spent();
    let judged = report
        .solution()
        .map(|s| Judged { value: judge.value(&s.offsets), violation: judge.violation(&s.offsets) });
    Ok(Answer { judged, curve, spent, bound: report.bound.map(|b| b.upper) })
}

/// The optimiser on a problem with requirements, and its answer as the judge sees it.
fn optimise_dimensional(
    p: &DimensionalProblem,
    judge: &mut DimensionalJudge,
    a: &Arguments,
) -> Result<(Answer, Option<Built>), Failure> {
    let options = equipod::methods::dimensional::ShapeSearchOptions {
        seed: a.seed,
        threads: a.threads,
        ..equipod::methods::dimensional::ShapeSearchOptions::default()
    };
    let clock = Clock::start();
    let mut curve: Vec<Point> = Vec::new();
    let is_cost = p.objectives.first().is_some_and(|o| o.0.is_cost());
    let report = equipod::methods::dimensional::optimize(p, &[], &options, &mut |progress| {
        if let Some(best) = progress.best {
            let value = if is_cost { -best } else { best };
            if curve.last().is_none_or(|p| p.value < value) {
                curve.push(Point { elapsed: clock.spent().elapsed, value });
            }
        }
        ControlFlow::Continue(())
    })?;
    let spent = clock.spent();
    let built = report.solution().map(|s| judge.built_of(s)).transpose()?;
    let judged = built.as_ref().map(|built| judge.judge(built));
    if let Some(built) = &built {
        judge.hold_earlier(built);
    }
    Ok((Answer { judged, curve, spent, bound: None }, built))
}

/// One problem with all three answers.
fn compare(
    name: String,
    (quantity, poses): (String, String),
    judge: &dyn Judge,
    (mut ours, last_word): (Answer, &dyn Fn() -> Option<Judged>),
    a: &Arguments,
) -> Row {
    eprintln!("{name}: {quantity}, {poses}");
    eprintln!("  optimiser {:?} in {:.2} s ({:.2} s)", ours.judged, ours.spent.elapsed, ours.spent.cpu);
    let mut random = random_search(judge, a.random, a.seconds, a.threads, a.seed);
    eprintln!(
        "  random {:?} in {:.1} s, {} feasible",
        random.judged, random.spent.elapsed, random.evaluations
    );
    let rival = evolution(judge, &random.path, a.factor * ours.spent.cpu, a.threads, a.seed);
    eprintln!("  CMA-ES {:?} in {:.1} s", rival.judged, rival.spent.elapsed);
    if random.evaluations < a.random {
        // worst first: walks begin with the last
        let starts: Vec<Vec<f64>> = random.path.iter().chain(&rival.path).cloned().collect();
        let missing = a.random - random.evaluations;
        random = random.then(walks(judge, &starts, missing, a.walk_seconds, a.threads, a.seed));
        eprintln!(
            "  walks {:?} in {:.1} s, {} feasible",
            random.judged, random.spent.elapsed, random.evaluations
        );
    }
    // with the worst poses that came to light meanwhile
    ours.judged = last_word();
    let against = |r: &Rival| Verdict::of(ours.judged, r.judged);
    let verdicts = [against(&random), against(&rival)];
    let row = Row { name, quantity, poses, factor: a.factor, ours, random, rival, verdicts };
    println!("{}", row.markdown());
    row
}

/// The problems of a design.
fn rows(path: &Path, a: &Arguments) -> Result<Vec<Row>, Failure> {
    let design = load(path)?;
    let stem = path.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
    let mut out = Vec::new();
    let question = question::problem(&design).filter(|_| a.only != Only::Offsets);
    if let Some(p) = question {
        let mut judge = DimensionalJudge::new(&p);
        let (ours, built) = optimise_dimensional(&p, &mut judge, a)?;
        let last_word = || built.as_ref().map(|built| judge.judge(built));
        let objective = p.objectives.last().map_or("", |o| o.0.code());
        let quantity = objective.replace('_', " ");
        let about = (quantity, "region".into());
        out.push(compare(format!("{stem}, requirements"), about, &judge, (ours, &last_word), a));
    }
    let extensions: &[f64] = if a.only == Only::Requirements { &[] } else { &[1.0, 0.0] };
    for &extension in extensions {
        let Some(p) = offset_problem(&design, extension) else { continue };
        let judge = OffsetJudge::new(&p);
        let ours = optimise(&p, &judge, a)?;
        let about = ("worst conditioning".into(), p.poses.len().to_string());
        let judged = ours.judged;
        out.push(compare(format!("{stem}, extension {extension}"), about, &judge, (ours, &|| judged), a));
    }
    Ok(out)
}

fn run(a: &Arguments) -> Result<bool, Failure> {
    let mut report = Report::default();
    for path in &a.designs {
        report.rows.extend(rows(path, a)?);
        if let Some(folder) = &a.out {
            // after every design: runs are long
            report.write(folder)?;
        }
    }
    println!("\n{}", report.markdown());
    Ok(report.rows.iter().any(Row::has_loss))
}

fn main() -> ExitCode {
    let done = arguments().and_then(|a| match a {
        None => Ok(false),
        Some(Arguments { gaps: Some(count), threads, seed, .. }) => {
            gaps::run(count, threads, seed).map(|()| false)
        }
        Some(a) if a.timing => timing::run(a.threads).map(|()| false),
        Some(a) => run(&a),
    });
    match done {
        Ok(false) => ExitCode::SUCCESS,
        Ok(true) => ExitCode::FAILURE,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::from(2)
        }
    }
}
