//! The optimiser against 100,000 random feasible designs and against CMA-ES with 100 times its processor time.
//!
//! ```text
//! cargo bench --bench optimizer -- [--random 100000] [--factor 100] [--threads 2] [--seed 1] [--out FOLDER] [DESIGN ...]
//! cargo bench --bench optimizer -- --timing
//! ```
//!
//! Every design is an octahedral design file (default: all of `designs/`); its problem is that of `equipod optimize`, once with the joints up to one edge length out and
//! once inside the edges. Prints a Markdown table; with `--out` writes it, the rows as CSV and a picture of the convergence for each problem. Exit 1 when
//! the optimiser loses. `--timing`: the time of problems with 200 poses instead.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a program that prints tables")]

mod evolution;
mod judge;
mod random;
mod record;
mod report;
mod timing;
mod verdict;

use std::error::Error;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use equipod::design::{Design, Format, parse};
use equipod::offsets::{OffsetProblem, OptimizeOptions, Progress, optimize};

use evolution::evolution;
use judge::{Judge, OffsetJudge, offset_problem};
use random::random_search;
use record::{Clock, Point, Rival, Spent};
use report::{Report, Row};
use verdict::{Judged, Verdict};

type Failure = Box<dyn Error>;

/// What the command line says.
#[derive(Debug)]
struct Arguments {
    random: usize,
    factor: f64,
    threads: usize,
    seed: u64,
    out: Option<PathBuf>,
    designs: Vec<PathBuf>,
    timing: bool,
}

fn arguments() -> Result<Option<Arguments>, Failure> {
    let mut a = Arguments {
        random: 100_000,
        factor: 100.0,
        threads: 2,
        seed: 1,
        out: None,
        designs: Vec::new(),
        timing: false,
    };
    let mut measured = false;
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        let mut next = || words.next().ok_or(format!("{word} needs a value"));
        match word.as_str() {
            // what cargo says to programs that measure, and not to those it only tests
            "--bench" => measured = true,
            "--random" => a.random = next()?.parse()?,
            "--factor" => a.factor = next()?.parse()?,
            "--threads" => a.threads = next()?.parse()?,
            "--seed" => a.seed = next()?.parse()?,
            "--out" => a.out = Some(next()?.into()),
            "--timing" => a.timing = true,
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
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("designs");
    let mut out = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|e| e == "toml") {
            out.push(path);
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

/// The optimiser's own answer, with what it cost.
#[derive(Debug)]
struct Answer {
    judged: Option<Judged>,
    curve: Vec<Point>,
    spent: Spent,
    /// Proved upper bound of the objective.
    bound: Option<f64>,
}

fn optimise(p: &OffsetProblem, judge: &OffsetJudge, a: &Arguments) -> Result<Answer, Failure> {
    let options = OptimizeOptions { seed: a.seed, threads: a.threads, ..OptimizeOptions::default() };
    let clock = Clock::start();
    let mut curve: Vec<Point> = Vec::new();
    let report = optimize(p, &options, &mut |progress| {
        let value = match progress {
            Progress::Ranking { best, .. }
            | Progress::Polishing { best, .. }
            | Progress::Bounding { best, .. } => best,
            _ => 0.0,
        };
        if curve.last().map_or(0.0, |p| p.value) < value {
            curve.push(Point { elapsed: clock.spent().elapsed, evaluations: 0, value });
        }
        ControlFlow::Continue(())
    })?;
    let spent = clock.spent();
    let judged = report
        .solution()
        .map(|s| Judged { value: judge.value(&s.offsets), violation: judge.violation(&s.offsets) });
    Ok(Answer { judged, curve, spent, bound: report.bound.map(|b| b.upper) })
}

/// One problem with all three answers.
fn compare(name: &str, p: &OffsetProblem, a: &Arguments) -> Result<Row, Failure> {
    let judge = OffsetJudge::new(p);
    eprintln!("{name}: {} poses", p.poses.len());
    let ours = optimise(p, &judge, a)?;
    eprintln!("  optimiser {:?} in {:.2} s", ours.judged.map(|j| j.value), ours.spent.elapsed);
    let random = random_search(&judge, a.random, a.threads, a.seed);
    eprintln!("  random {:?} in {:.1} s", random.judged.map(|j| j.value), random.spent.elapsed);
    let rival = evolution(&judge, a.factor * ours.spent.cpu, a.threads, a.seed);
    eprintln!("  CMA-ES {:?} in {:.1} s", rival.judged.map(|j| j.value), rival.spent.elapsed);
    let against = |r: &Rival| Verdict::of(ours.judged, r.judged);
    let verdicts = [against(&random), against(&rival)];
    Ok(Row { name: name.into(), poses: p.poses.len(), factor: a.factor, ours, random, rival, verdicts })
}

fn run(a: &Arguments) -> Result<bool, Failure> {
    let mut report = Report::default();
    for path in &a.designs {
        let design = load(path)?;
        let stem = path.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
        for extension in [1.0, 0.0] {
            let Some(p) = offset_problem(&design, extension) else { continue };
            let name = format!("{stem}, extension {extension}");
            let row = compare(&name, &p, a)?;
            println!("{}", row.markdown());
            report.rows.push(row);
        }
    }
    println!("\n{}", report.markdown());
    if let Some(folder) = &a.out {
        report.write(folder)?;
    }
    Ok(report.rows.iter().any(Row::has_loss))
}

fn main() -> ExitCode {
    let done = arguments().and_then(|a| match a {
        None => Ok(false),
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
