//! `equipod plot locus`: the squared length of a virtual leg at all poses while one leg length varies.

mod render;

use std::path::{Path, PathBuf};

use num_complex::Complex64;

use crate::app::cli::commands::fk::{MethodArg, failure_of, lengths, pair};
use crate::app::cli::context::Context;
use crate::app::cli::exit::Exit;
use crate::app::cli::failure::Failure;
use crate::app::cli::files::{self, OutputPath};
use crate::app::cli::output::Answer;
use ::files::plot::{LocusStep, LocusValue};
use ask::Design;
use fk::{self, FkOptions, FkSolutions, PoseCounting, Reality, SolutionSet, Threads};
use platform::manipulator::{Leg, LegLengths, Manipulator};
use platform::topology::Topology;
use records::LocusWord;

/// Arguments of `plot locus`.
#[derive(Debug, clap::Args)]
pub(crate) struct PlotLocusArgs {
    /// Design file (.toml or .json)
    design: PathBuf,
    /// Six lengths, those of the design when absent; that of the leg that varies is not used
    #[arg(long, value_name = "L1,..,L6")]
    lengths: Option<String>,
    /// Number of the leg whose length varies, 1 to 6
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u8).range(1..=6))]
    leg: u8,
    /// First length of that leg
    #[arg(long, value_name = "L")]
    from: f64,
    /// Last length of that leg
    #[arg(long, value_name = "L")]
    to: f64,
    /// Number of lengths, both ends included
    #[arg(long, value_name = "N", default_value_t = 201, value_parser = clap::value_parser!(u32).range(2..=100_000))]
    steps: u32,
    /// Virtual leg, named by its joints; the first that trilateration needs when absent, else the first pair that no
    /// leg joins
    #[arg(long, value_name = "BASE,PLATFORM")]
    between: Option<String>,
    /// Method of solution; auto takes the best one for the design
    #[arg(long, value_enum, default_value_t = MethodArg::Auto)]
    method: MethodArg,
    /// Write the values as a table
    #[arg(long, value_name = "FILE")]
    csv: Option<OutputPath>,
}

/// The virtual leg with its name.
struct VirtualLeg {
    leg: Leg,
    base: String,
    platform: String,
}

/// What was found at one length.
struct Row {
    length: f64,
    /// `None` where the problem could not be solved.
    found: Option<RowPoses>,
}

/// The poses of one row.
struct RowPoses {
    solutions: FkSolutions,
    /// One for each root.
    values: Vec<Complex64>,
}

impl Row {
    fn status(&self) -> LocusWord {
        match self.found.as_ref().map(|f| &f.solutions.solution_set) {
            None => LocusWord::Failed,
            Some(SolutionSet::Isolated) => LocusWord::Isolated,
            Some(SolutionSet::Empty) => LocusWord::Empty,
            Some(SolutionSet::PositiveDimensional { .. }) => LocusWord::PositiveDimensional,
        }
    }

    /// Nothing failed and no pose is missing.
    fn complete(&self) -> bool {
        self.found.as_ref().is_some_and(|f| f.solutions.all_accounted())
    }
}

/// The answers at all lengths.
struct Locus {
    name: String,
    leg: u8,
    between: VirtualLeg,
    rows: Vec<Row>,
    steps: Vec<LocusStep>,
}

impl Locus {
    fn picture(&self) -> String {
        render::picture(&self.name, self.leg, &self.between, &self.rows, &self.steps)
    }
}

/// Solves at each length and evaluates the distance. Without `output` the text of the answer is the picture.
pub(super) fn run(
    args: &PlotLocusArgs,
    output: Option<&Path>,
    context: &mut Context,
) -> Result<Answer, Failure> {
    let found = solve(args, context)?;
    if let Some(path) = output {
        files::write_text(path, &found.picture())?;
    }
    let Locus { name, leg, between, rows, steps } = &found;
    let record = render::record(*leg, between, rows, steps);
    if let Some(path) = &args.csv {
        files::write_text(path, &render::csv(&record))?;
    }
    let exit = if rows.iter().all(Row::complete) { Exit::Yes } else { Exit::Inconclusive };
    let text = match output {
        Some(path) => format!("{}\n{}", path.display(), sheet::answers::locus(name, &record)),
        None => found.picture(),
    };
    Ok(Answer::new(exit, record, text))
}

fn solve(args: &PlotLocusArgs, context: &mut Context) -> Result<Locus, Failure> {
    let method = args.method.method();
    let design = context.load(&args.design)?;
    let lengths::GivenLengths::One(given) = lengths::given(args.lengths.as_deref(), &design, context)? else {
        return Err(Failure::refused(
            "locus::one_row",
            "--lengths names a table, but one set of lengths is wanted",
        )
        .with_help("give six lengths separated by commas"));
    };
    let m = design.manipulator();
    let between = match &args.between {
        Some(text) => named(text, &design)?,
        None => between(&design, default_pair(m)?),
    };
    let lengths = varied(args, &given.distances)?;
    let squares: Vec<_> = lengths.iter().map(LegLengths::squared).collect();
    let options = FkOptions::new().seed(context.seed()).pose_count(PoseCounting::Never);
    let solver = fk::solver(method);
    let results = fk::solve_batch(solver.as_ref(), m, &squares, &options, Threads::All);
    let mut rows = Vec::with_capacity(results.len());
    for (l, result) in lengths.iter().zip(results) {
        let found = match result {
            Ok(solutions) => {
                let values = solutions.roots.iter().map(|r| r.pose.squared_length(&between.leg)).collect();
                Some(RowPoses { solutions, values })
            }
            // no method for this design at any length
            Err(e @ fk::FkError::NotApplicable { .. }) => return Err(failure_of(&e)),
            Err(_) => None,
        };
        rows.push(Row { length: l.get()[usize::from(args.leg - 1)], found });
    }
    let steps = rows.iter().map(step).collect();
    Ok(Locus { name: design.name.clone(), leg: args.leg, between, rows, steps })
}

fn step(row: &Row) -> LocusStep {
    let isolated = row.found.iter().filter(|f| f.solutions.solution_set == SolutionSet::Isolated);
    let values = isolated.flat_map(|f| f.solutions.roots.iter().zip(&f.values));
    let value = |(root, v): (&fk::FkRoot, &Complex64)| LocusValue {
        re: v.re,
        im: v.im,
        real: root.reality == Reality::Real,
    };
    LocusStep { length: row.length, values: values.map(value).collect() }
}

/// The lengths asked for, ends exactly.
fn varied(args: &PlotLocusArgs, given: &LegLengths) -> Result<Vec<LegLengths>, Failure> {
    let last = args.steps - 1;
    let at = |k: u32| {
        let t = f64::from(k) / f64::from(last);
        let mut l = given.get();
        l[usize::from(args.leg - 1)] =
            if k == last { args.to } else { args.from + t * (args.to - args.from) };
        LegLengths::try_new(l).map_err(|e| {
            Failure::refused("locus::bad_lengths", format!("--from, --to: {e}"))
                .with_help("give lengths that are not negative")
        })
    };
    (0..args.steps).map(at).collect()
}

fn between(design: &Design, (a, b): (usize, usize)) -> VirtualLeg {
    let m = design.manipulator();
    VirtualLeg {
        leg: Leg { base: m.base_joints()[a], platform: m.platform_joints()[b] },
        base: design.base_names()[a].clone(),
        platform: design.platform_names()[b].clone(),
    }
}

/// `--between`, which names two joints that no leg joins.
fn named(text: &str, design: &Design) -> Result<VirtualLeg, Failure> {
    let pair = pair(text, design, "locus::unknown_joint")?;
    let leg = design.manipulator().pairs().iter().position(|p| *p == pair);
    if let Some(leg) = leg {
        let message = format!("--between: leg {} joins {text}", leg + 1);
        return Err(
            Failure::refused("locus::is_a_leg", message).with_help("take two joints that no leg joins")
        );
    }
    Ok(between(design, pair))
}

/// The first virtual leg of the shortest trilateration sequence; for a design that needs none the first pair that no
/// leg joins.
fn default_pair(m: &Manipulator) -> Result<(usize, usize), Failure> {
    let pairs = m.pairs();
    let topology = Topology::unordered(pairs.map(|p| p.0), pairs.map(|p| p.1));
    let numbered = topology.legs();
    // joints of the topology are numbered as they appear in the legs
    let joint = |a: usize, b: usize| {
        let base = numbered.iter().position(|l| l.0 == a).map(|leg| pairs[leg].0);
        base.zip(numbered.iter().position(|l| l.1 == b).map(|leg| pairs[leg].1))
    };
    let wanted = topology.trilateration().virtual_legs.first().copied();
    let free = || {
        let all =
            (0..topology.base_joints()).flat_map(|a| (0..topology.platform_joints()).map(move |b| (a, b)));
        all.into_iter().find(|p| !numbered.contains(p))
    };
    wanted.or_else(free).and_then(|(a, b)| joint(a, b)).ok_or_else(|| {
        Failure::refused("locus::no_virtual_leg", "legs join all pairs of joints").with_help("give --between")
    })
}
