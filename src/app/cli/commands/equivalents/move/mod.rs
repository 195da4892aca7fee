//! `equipod equivalents move`: moves legs along families of replaceable legs, or searches for an equivalent platform.

pub(in crate::app::cli::commands) mod found;
mod naming;
mod render;
mod request;
mod wishes;

use std::path::PathBuf;

use crate::app::cli::context::Context;
use crate::app::cli::exit::Exit;
use crate::app::cli::failure::Failure;
use crate::app::cli::files::{self, OutputPath};
use crate::app::cli::output::Answer;
use ::files::design::Share;
use ask::{Design, NoReplaceableLegs, ReplaceableOptions};
use naming::{Meant, internal, list_families, resolve};
use platform::manipulator::Body;
use records::MoveAnswer;
use request::{MoveRequest, requests};
use synthesis::components::{ComponentOptions, Components, ComponentsError};
use synthesis::relocate::{Chain, LegMove, RelocateError, Relocation, relocate};
use synthesis::{LegMapOutcome, LegMapTolerances, Relation};
use verify::judge;

/// Arguments of `equivalents move`.
#[derive(Debug, clap::Args)]
pub(crate) struct EquivalentsMoveArgs {
    /// Design file (.toml or .json)
    design: PathBuf,
    /// Number of the leg to move, 1 to 6
    #[arg(long, value_name = "LEG", requires_all = ["along", "to"])]
    leg: Option<String>,
    /// Family of the leg: its number in `equipod equivalents components`, or its joints; P1:P4-P5 means the legs from
    /// P1 to the line P4 P5
    #[arg(long, value_name = "FAMILY", requires = "leg")]
    along: Option<String>,
    /// Parameters of the new leg in the family
    #[arg(long, value_name = "T[,U,..]", allow_hyphen_values = true, requires = "leg")]
    to: Option<String>,
    /// Leg, family and parameters in one word, for instance 1:3:0.25 or 1:P1:P4-P5:1/4; repeat the option for several
    /// moves
    #[arg(long = "move", value_name = "LEG:FAMILY:T[,U,..]", conflicts_with = "leg")]
    moves: Vec<String>,
    /// Make all moves at once, along families of the given design, instead of one after another
    #[arg(long)]
    together: bool,
    /// Write the new design to this file; with --search, write the designs found into this folder
    #[arg(short, long, value_name = "PATH")]
    output: Option<OutputPath>,
    /// Threshold for zero in the search for families, relative to the size of the body
    #[arg(long, value_name = "X", default_value_t = 1e-9)]
    tolerance: f64,
    /// Search for equivalent platforms with the properties below
    #[arg(long, conflicts_with_all = ["leg", "moves", "together"])]
    search: bool,
    #[command(flatten)]
    wishes: wishes::WishArgs,
}

/// Moves legs, or searches for a platform.
pub(crate) fn run(args: &EquivalentsMoveArgs, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    let options = ComponentOptions { tolerance: args.tolerance, seed: context.seed() };
    if args.search {
        refuse_fixed(&design, "move::fixed", "the search moves legs to places of its own")?;
        if design.workspace.is_empty() {
            context.no_effect("workspace", "the design has no workspace")?;
        }
        return found::run(args.output.as_deref(), &args.wishes, &design, options);
    }
    if let Some(option) = args.wishes.first_given() {
        let message = format!("{option} is a wish for --search");
        return Err(Failure::refused("move::wish_without_search", message).with_help("add --search"));
    }
    let wanted = requests(args.leg.as_deref(), args.along.as_deref(), args.to.as_deref(), &args.moves)?;
    if wanted.is_empty() {
        let families = families(&design, options)?;
        let failure = Failure::refused("move::nothing_asked", "no move is asked for");
        return Err(failure.with_help(list_families(&design, &families)?));
    }
    if wanted.len() < 2 {
        context.no_effect("together", "a single leg is moved")?;
    }
    let done = if args.together {
        vec![one_step(&design, &design, &wanted, options)?]
    } else {
        sequence(&design, &wanted, options)?
    };
    let steps: Vec<Relocation> = done.iter().map(|s| s.relocation.clone()).collect();
    let mut chain = Chain::of(design.manipulator(), &steps, LegMapTolerances::default())
        .map_err(|e| Failure::internal(e.to_string()))?;
    let regular = steps.iter().all(Relocation::is_regular);
    let last = done.last().and_then(|s| s.design.clone());
    if let Some(new) = &last {
        keeps_fixed(&design, new)?;
        chain.direct = judged(&design, new)?;
    }
    let built = last.map(|d| finished(d, &design, &chain, regular, args.together));
    let mut written = None;
    if let (Some(path), Some(d), true) = (&args.output, &built, regular) {
        files::write_design(path, d)?;
        written = Some(path.display().to_string());
    }
    let record = render::Record {
        design: &design,
        done: &done,
        chain: &chain,
        wanted: wanted.len(),
        together: args.together,
    };
    let answer = record.record(built.as_ref(), written.as_deref());
    let text = sheet::answers::moves(&answer);
    let singular = steps.iter().any(|s| s.map.relation == Relation::Singular);
    let exit = match (regular, singular) {
        (true, _) => Exit::Yes,
        (false, true) => Exit::No,
        (false, false) => Exit::Inconclusive,
    };
    Ok(Answer::new(exit, MoveAnswer::Moves(Box::new(answer)), text))
}

/// Refuses a design with fixed joints.
pub(in crate::app::cli::commands) fn refuse_fixed(
    design: &Design,
    code: &'static str,
    reason: &str,
) -> Result<(), Failure> {
    if !design.has_fixed_joints() {
        return Ok(());
    }
    let message = format!("[optimize] has `fixed` joints, and {reason}");
    Err(Failure::refused(code, message)
        .with_help("remove `fixed`, or move legs by name: --move LEG:FAMILY:T"))
}

/// Checks that every fixed joint is still the end of a leg.
fn keeps_fixed(given: &Design, new: &Design) -> Result<(), Failure> {
    let size = given.manipulator().size();
    for body in Body::BOTH {
        let joints = given.manipulator().joints(body);
        let ends = new.manipulator().legs().map(|leg| body.of((leg.base, leg.platform)));
        for (k, fixed) in given.fixed_joints(body).into_iter().enumerate() {
            let in_use = given.manipulator().pairs().iter().any(|(a, b)| body.of((*a, *b)) == k);
            if fixed && in_use && ends.iter().all(|end| (end - joints[k]).norm() > STAYS * size) {
                let name = &given.joint_names(body)[k];
                let message =
                    format!("the joint {name} is `fixed` in [optimize], and no leg would end there");
                return Err(Failure::refused("move::fixed", message)
                    .with_help("move another leg, or remove the joint from `fixed`"));
            }
        }
    }
    Ok(())
}

/// An end within this share of the size of the design is at the joint.
const STAYS: f64 = 1e-9;

/// The families of a design.
fn families(design: &Design, options: ComponentOptions) -> Result<Components, Failure> {
    let legs = design.replaceable_legs(&ReplaceableOptions::all(options));
    legs.map(|l| l.found).map_err(|why| match why {
        NoReplaceableLegs::Search(ComponentsError::Tolerance(_)) => {
            Failure::refused("move::bad_tolerance", why.to_string())
        }
        _ => Failure::internal(why.to_string()),
    })
}

/// Moves made at once, with the names of the families used.
#[derive(Debug)]
struct MovedAtOnce {
    relocation: Relocation,
    /// For each move, the type of its family and the joints that span it.
    families: Vec<(String, Option<String>)>,
    /// For each move, its parameters as written.
    written: Vec<Vec<String>>,
    /// The new design, if the legs make a platform.
    design: Option<Design>,
}

/// The moves one after another, up to the first singular one.
fn sequence(
    design: &Design,
    wanted: &[MoveRequest],
    options: ComponentOptions,
) -> Result<Vec<MovedAtOnce>, Failure> {
    let mut done: Vec<MovedAtOnce> = Vec::new();
    for request in wanted {
        let current = done.last().and_then(|s| s.design.as_ref()).unwrap_or(design);
        let step = one_step(design, current, std::slice::from_ref(request), options)?;
        let regular = step.relocation.is_regular();
        done.push(step);
        if !regular {
            break;
        }
    }
    Ok(done)
}

/// Moves of legs of `current` made at once; names of joints refer to `given` if it has them.
fn one_step(
    given: &Design,
    current: &Design,
    wanted: &[MoveRequest],
    options: ComponentOptions,
) -> Result<MovedAtOnce, Failure> {
    let found = families(current, options)?;
    let mut moves: Vec<LegMove> = Vec::new();
    for r in wanted {
        let Meant { index, formulas } = resolve(&r.along, given, current, &found)?;
        let parameters = r.parameters.iter().map(Share::nearest).collect();
        moves.push(LegMove { leg: r.leg, family: index, parameters, formulas });
    }
    let mut relocation = relocate(current.manipulator(), &found, &moves, LegMapTolerances::default())
        .map_err(|e| refusal(&e, current, &found))?;
    let mut names = Vec::new();
    for step in &moves {
        let type_name = found.components[step.family].type_name();
        let name = current.family_name(&found, step.family).map_err(|e| internal(&e))?;
        names.push((type_name, name));
    }
    let shares: Vec<Share> = wanted.iter().flat_map(|r| r.parameters.clone()).collect();
    let design = current.with_legs_of(&relocation.assembled, &shares);
    if let Some(new) = &design {
        relocation.map = judged(current, new)?;
    }
    let written = wanted.iter().map(|r| r.parameters.iter().map(Share::to_string).collect()).collect();
    Ok(MovedAtOnce { relocation, families: names, written, design })
}

/// The relation of two designs, decided on their joints.
fn judged(from: &Design, to: &Design) -> Result<LegMapOutcome, Failure> {
    judge(from.manipulator(), to.manipulator()).map_err(|e| Failure::internal(e.to_string()))
}

/// The refusal of an impossible move, with the possible ones.
fn refusal(e: &RelocateError, design: &Design, found: &Components) -> Failure {
    let code = match e {
        RelocateError::NoSuchFamily { .. } => "move::no_such_family",
        RelocateError::ParameterCount { .. } => "move::parameter_count",
        RelocateError::NoLeg { .. } => "move::no_leg",
        RelocateError::NotCarried { .. } => "move::not_carried",
        RelocateError::Twice(_) => "move::leg_twice",
        _ => return Failure::internal(e.to_string()),
    };
    match list_families(design, found) {
        Ok(list) => Failure::refused(code, e.to_string()).with_help(list),
        Err(failure) => failure,
    }
}

/// The last design with the results of the whole chain.
fn finished(built: Design, given: &Design, chain: &Chain, regular: bool, together: bool) -> Design {
    let mut out = built;
    out.name = format!("{}, legs moved", given.name);
    out.description = Some(format!(
        "Equivalent to \"{}\" by equipod {} (legs moved {}): det A = {}",
        given.name,
        env!("CARGO_PKG_VERSION"),
        if together { "together" } else { "one after another" },
        chain.direct.determinant
    ));
    if !regular {
        out.description = Some(format!("Singular: made from \"{}\" by moves with det A = 0", given.name));
    }
    // the lengths of the new legs at the same pose
    let lengths = given.lengths.and_then(|l| chain.direct.closest.apply(&l.squared()).ok());
    out.lengths = lengths.map(|s| s.lengths());
    out
}
