//! `equipod bench`: solves random problems of a class, validates them independently, counts and times them.

mod noise;

use clap::builder::PossibleValuesParser;

use crate::app::cli::args::choice;
use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath};
use ask::bench::{BenchReport, Class, LengthsFrom, Plan, reference_times, run as run_plan};
use fk::{self, Homotopy};
use records::{BenchAnswer, BenchClassRecord, METHODS};

/// Arguments of `bench`.
#[derive(Debug, clap::Args)]
pub(crate) struct BenchArgs {
    /// Classes, with commas between: 6-6, 6-5, 6P-6, 6P-6P, almost-planar, tilted-planes, octahedral, griffis-duffy,
    /// hexapod, similar, affine, congruent, collinear, close-pair, spread, double-root, hexapod-home; `all` for these.
    /// T01 to T34 (also T04-planar-base, -planar-platform, -both-planar), or `topologies` for all 34
    #[arg(long, value_name = "CLASS", default_value = "6-6")]
    class: String,
    /// Number of problems of each class
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u64).range(1..=10_000_000))]
    count: u64,
    /// Index of the first problem
    #[arg(long, value_name = "K", default_value_t = 0)]
    first: u64,
    /// Worker threads, each for one problem at a time
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..=1024))]
    threads: u64,
    /// Method of solution; auto takes the best one for the design. sylvester and template also measure the candidates
    /// before refinement
    #[arg(long, default_value = "auto", value_parser = PossibleValuesParser::new(METHODS))]
    method: String,
    /// Source of the lengths: uniform squares in [0.5, 3] (default where possible), or a random real pose
    #[arg(long, value_name = "SOURCE", value_parser = choice(&LengthsFrom::ALL, LengthsFrom::name))]
    lengths_from: Option<LengthsFrom>,
    /// Round the joints to this number of decimals
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=17))]
    decimals: Option<u32>,
    /// Search for missed roots from two other starts in every N-th problem; 0: never
    #[arg(long, value_name = "N", default_value_t = 10)]
    recheck_every: u64,
    /// Count the poses modulo random primes if completeness is not proved
    #[arg(long)]
    count_poses: bool,
    /// Measure the effect of relative errors of leg lengths from 1e-12 to 1e-1 instead
    #[arg(long, conflicts_with_all = ["first", "lengths_from", "decimals", "recheck_every", "count_poses"])]
    noise: bool,
    /// Write a picture of the pose errors by noise
    #[arg(long, value_name = "FILE", requires = "noise")]
    svg: Option<OutputPath>,
}

/// Runs one class or several.
pub(crate) fn run(args: &BenchArgs, context: &mut Context) -> Result<Answer, Failure> {
    let classes = classes(&args.class)?;
    let solver = fk::solver(args.method.parse().ok());
    if args.noise {
        return noise::run(args, &classes, solver.as_ref(), context.seed());
    }
    let references = reference_times(context.seed()).map_err(|e| Failure::internal(e.to_string()))?;
    let mut reports: Vec<BenchReport> = Vec::new();
    for class in classes {
        let lengths = lengths(args.lengths_from, class)?;
        let plan = Plan {
            class,
            lengths,
            decimals: args.decimals,
            count: args.count,
            first: args.first,
            seed: context.seed(),
            threads: usize::try_from(args.threads).unwrap_or(1),
            count_poses: args.count_poses,
            recheck_every: args.recheck_every,
        };
        let report = run_plan(&plan, solver.as_ref(), &Homotopy);
        reports.push(report.map_err(|e| Failure::new(Exit::Inconclusive, "bench::not_run", e.to_string()))?);
    }
    let exit = if reports.iter().all(BenchReport::passed) { Exit::Yes } else { Exit::No };
    let rows = reports.iter().map(|r| BenchClassRecord::new(r, &references)).collect();
    let answer = BenchAnswer::new(&args.class, &args.method, rows, &references);
    let sheet = sheet::answers::bench(&answer, context.seed());
    Ok(Answer::new(exit, answer, sheet))
}

fn classes(names: &str) -> Result<Vec<Class>, Failure> {
    let parts: Result<Vec<_>, Failure> = names.split(',').map(|name| classes_named(name.trim())).collect();
    Ok(parts?.concat())
}

fn classes_named(name: &str) -> Result<Vec<Class>, Failure> {
    if name == "all" {
        return Ok(Class::ALL.to_vec());
    }
    if name == "topologies" {
        return Ok(Class::topologies());
    }
    if let Some(class) = Class::from_name(name) {
        return Ok(vec![class]);
    }
    let known: Vec<_> = Class::ALL.iter().map(|c| c.name()).collect();
    Err(Failure::refused("bench::unknown_class", format!("`{name}` is not a class of problems"))
        .with_help(format!("the classes are {}, all, T01 to T34, topologies", known.join(", "))))
}

fn lengths(asked: Option<LengthsFrom>, class: Class) -> Result<LengthsFrom, Failure> {
    match asked {
        Some(LengthsFrom::Uniform) if !class.allows_uniform_lengths() => {
            let message = format!("the class {class} takes its lengths from real poses");
            Err(Failure::refused("bench::needs_pose", message).with_help("take --lengths-from pose"))
        }
        None if !class.allows_uniform_lengths() => Ok(LengthsFrom::Pose),
        asked => Ok(asked.unwrap_or(LengthsFrom::Uniform)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unknown_classes_are_refused_with_the_list() {
        for name in ["T35", "x", "6-6,", "6-6,x"] {
            let failure = classes(name).unwrap_err();
            assert_eq!((failure.exit, failure.code.as_str()), (Exit::Refused, "bench::unknown_class"));
            assert!(failure.help.unwrap().contains("griffis-duffy"));
        }
        assert_eq!(classes("all").unwrap().len(), Class::ALL.len());
        assert_eq!(classes("topologies").unwrap().len(), 34);
        assert_eq!(classes("T07").unwrap().len(), 1);
        assert_eq!(classes("6-5, 6-6").unwrap(), [Class::SharedPlatformJoint, Class::General]);
    }

    #[test]
    fn uniform_lengths_are_for_the_classes_of_martyushev() {
        assert_eq!(lengths(None, Class::General).unwrap(), LengthsFrom::Uniform);
        assert_eq!(lengths(None, Class::Octahedral).unwrap(), LengthsFrom::Pose);
        assert_eq!(
            lengths(Some(LengthsFrom::Uniform), Class::Hexapod).unwrap_err().code,
            "bench::needs_pose"
        );
    }
}
