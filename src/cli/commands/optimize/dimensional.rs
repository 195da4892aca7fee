//! `equipod optimize` for designs that ask for more than the offsets with the best conditioning.

use crate::cli::context::Context;
use crate::cli::exit::Exit;
use crate::cli::failure::Failure;
use crate::cli::poses;
use crate::cli::progress::{Interrupt, Progress};
use crate::design::{Combination, Design};
use crate::dimensional::{
    DimensionalProblem, DimensionalReport, DimensionalSolution, InvalidProblem, Mode, SearchOptions, Stage,
    Variables, evaluate, optimize,
};
use crate::equivalence::verify;
use crate::fk::FkOptions;
use crate::manipulator::Octahedral;
use crate::offsets::OffsetProblem;
use crate::records::{CheckedSolution, DimensionalAnswer, DimensionalStatus};
use crate::requirements::{AssessOptions, JointAxes, Objective, Requirements, VariableKind, assess};

/// Points of the dense evaluation, and as many random ones.
const POINTS: usize = 5000;
/// Samples of the comparison with the design.
const SAMPLES: usize = 3;

/// Whether a design asks for anything besides offsets with the best worst-case conditioning.
pub(super) fn asks_for_more(design: &Design) -> bool {
    let plain =
        Requirements { min_joint_distance: design.optimize.min_joint_distance, ..Requirements::default() };
    design.search != crate::design::SearchTable::default() || design.requirements() != plain
}

/// What was asked and what came out.
#[derive(Debug)]
pub(super) struct Done {
    pub(super) report: DimensionalReport,
    pub(super) checked: Option<CheckedSolution>,
}

impl Done {
    /// The answer about it.
    pub(super) fn record(&self, design: &Design, written: Option<&str>) -> DimensionalAnswer {
        DimensionalAnswer::new(design, &self.report, self.checked.as_ref(), written)
    }
}

/// What the status means for the exit code.
pub(super) fn exit_of(status: DimensionalStatus) -> Exit {
    match status {
        DimensionalStatus::Optimal => Exit::Yes,
        DimensionalStatus::Infeasible => Exit::No,
        DimensionalStatus::Feasible | DimensionalStatus::Undecided | DimensionalStatus::Interrupted => {
            Exit::Inconclusive
        }
    }
}

/// The problem of a design.
pub(super) fn problem(design: &Design, extension: f64) -> DimensionalProblem {
    let (m, table, search) = (design.manipulator(), &design.optimize, &design.search);
    let home = poses::home(design);
    let space = poses::workspace(design).0.space(&home);
    let kinds = if search.variables.is_empty() { &[VariableKind::Offsets] } else { &search.variables[..] };
    let mut variables = Variables::of(kinds);
    variables.offset_bounds = [search.offset_bounds.unwrap_or((-extension, 1.0 + extension)); 6];
    variables.stretch_bounds = search.stretch_bounds.unwrap_or(variables.stretch_bounds);
    variables.height_bounds = search.height_bounds.unwrap_or(variables.height_bounds);
    let mut requirements = design.requirements();
    let octahedral = Octahedral::recognise(m).ok().map(|o| OffsetProblem::with_defaults(o, Vec::new()));
    if let (true, Some(default)) = (variables.offsets, &octahedral) {
        // joints that offsets separate need room, also where the design says nothing
        requirements.min_joint_distance.get_or_insert(default.min_joint_distance);
    }
    let objectives = if search.objectives.is_empty() {
        vec![(Objective::WorstConditioning, 1.0)]
    } else {
        search.objectives.clone()
    };
    let mode = match search.mode {
        Some(Combination::Lexicographic { slack }) => Mode::Lexicographic { slack },
        _ => Mode::Weighted,
    };
    DimensionalProblem {
        characteristic_length: table.characteristic_length.unwrap_or_else(|| m.platform_rms_radius()),
        min_abs_det: table.min_abs_det.unwrap_or(crate::offsets::DEFAULT_MIN_ABS_DET),
        manipulator: m.clone(),
        requirements,
        space,
        variables,
        objectives,
        mode,
    }
}

/// A problem that cannot be asked, with what could be asked instead.
pub(super) fn refusal(why: &InvalidProblem) -> Failure {
    let failure = Failure::refused("optimize::invalid_problem", why.to_string());
    match why {
        InvalidProblem::NotOctahedral(_) => failure.with_help(
            "for other designs set variables = [\"components\"] in [optimize] (legs move in their families of replaceable legs), \
             or \"home_height\", \"joint_axes\"",
        ),
        _ => failure,
    }
}

/// Threads and seed of the command line.
pub(super) fn options(args: &super::Args, context: &Context) -> SearchOptions {
    let processors = || std::thread::available_parallelism().map_or(1, usize::from);
    let threads = args.threads.unwrap_or_else(processors).clamp(1, 256);
    SearchOptions { seed: context.seed(), threads, ..SearchOptions::default() }
}

/// How far the search is, for people.
pub(super) fn words(p: &crate::dimensional::Progress) -> String {
    let stage = match p.stage {
        Stage::Populations => "population",
        Stage::Climbs => "climb",
        _ => "polish",
    };
    let best = p.best.map_or_else(String::new, |b| format!("best {b:.6}; "));
    format!("{best}{stage} {} of {}", p.done, p.total)
}

/// Optimises and checks.
pub(super) fn run(design: &Design, args: &super::Args, context: &Context) -> Result<Done, Failure> {
    let problem = problem(design, args.extension);
    let options = options(args, context);
    let (mut progress, interrupt) = (Progress::new(context.quiet()), Interrupt::watch());
    let report = optimize(&problem, &[], &options, &mut |p| {
        progress.note(&words(&p));
        interrupt.flow()
    })
    .map_err(|why| refusal(&why))?;
    progress.end();
    let checked = match report.solution() {
        Some(s) => Some(checked(design, &problem, s, context.seed())?),
        None => None,
    };
    Ok(Done { report, checked })
}

/// The platform as a design, evaluated by code that the optimiser does not use.
pub(super) fn checked(
    design: &Design,
    problem: &DimensionalProblem,
    s: &DimensionalSolution,
    seed: u64,
) -> Result<CheckedSolution, Failure> {
    let out = optimised(design, problem, s, seed);
    let space = crate::requirements::PoseSpace { home: s.home, ..problem.space.clone() };
    let requirements = Requirements { hardware: out.hardware, ..problem.requirements.clone() };
    let options = AssessOptions { points: POINTS, seed, ..AssessOptions::default() };
    let assessment = assess(&s.manipulator, &requirements, &space, &options);
    let values = evaluate(problem, &s.manipulator, &space, &s.poses, POINTS, seed);
    let objectives = problem.objectives.iter().map(|o| o.0).zip(values).collect();
    let v = &problem.variables;
    let keeps_class =
        (v.offsets || v.components) && problem.variables.triangles == crate::dimensional::Triangles::Fixed;
    let verification = if keeps_class {
        let plan = crate::cli::commands::verify::sample_plan(design, SAMPLES, seed);
        let options = FkOptions { seed, ..FkOptions::default() };
        let found = verify(design.manipulator(), &s.manipulator, &plan, &options);
        Some(found.map_err(|e| crate::cli::commands::verify::failure_of(&e))?)
    } else {
        None
    };
    Ok(CheckedSolution { design: out, assessment, objectives, verification })
}

/// The platform with the tables of the design, its axes and its home.
fn optimised(design: &Design, problem: &DimensionalProblem, s: &DimensionalSolution, seed: u64) -> Design {
    let octahedral = Octahedral::recognise(design.manipulator()).ok().filter(|_| s.offsets.is_some());
    let mut out = if let Some(o) = octahedral {
        super::joint_free_design(design, &o, &s.manipulator)
    } else {
        let name = format!("{}, optimised", design.name);
        let plain = Design::new(name, design.units.clone(), s.manipulator.clone());
        let (base, platform) = (design.base_names().to_vec(), design.platform_names().to_vec());
        plain.clone().with_joint_names(base, platform).unwrap_or(plain)
    };
    out.source.clone_from(&design.source);
    let best: Vec<String> = s.objectives.iter().map(|(o, v)| format!("{} {v}", o.code())).collect();
    out.description = Some(format!(
        "Optimised by equipod {} (seed {seed}) from the design \"{}\": {}",
        env!("CARGO_PKG_VERSION"),
        design.name,
        best.join(", ")
    ));
    let mut out = out.with_tables_of(design);
    if design.home.is_some() || problem.variables.home_height {
        out.home = Some(s.home);
    }
    for (swing, axes) in
        [(&mut out.hardware.base_swing, s.axes[0]), (&mut out.hardware.platform_swing, s.axes[1])]
    {
        if let (Some(swing), Some(axes)) = (swing, axes) {
            swing.axes = JointAxes::Given(axes);
        }
    }
    out
}
