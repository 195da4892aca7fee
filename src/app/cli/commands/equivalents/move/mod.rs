//! `equipod equivalents move`: moves legs along families of replaceable legs, or searches for an equivalent platform.

pub(in crate::app::cli::commands) mod found;
mod targets;

use std::path::PathBuf;

use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath, files};
use ask::{Design, InvalidMove, LegMoveRequest, MoveOptions, NoMoves, NoReplaceableLegs, ReplaceableOptions};
use records::{MoveAnswer, MovesAnswer};
use synthesis::components::{ComponentOptions, Components, ComponentsError};
use synthesis::relocate::RelocateError;

/// Arguments of `equivalents move`.
#[derive(Debug, clap::Args)]
pub(crate) struct EquivalentsMoveArgs {
    /// Design file (.toml or .json)
    design: PathBuf,
    /// Number of the leg to move, 1 to 6
    #[arg(long, value_name = "LEG", requires_all = ["along", "to"])]
    leg: Option<String>,
    /// Family of the leg: number in `equivalents components`, or joints: P1:P4-P5 has the legs from P1 to the line P4
    /// P5
    #[arg(long, value_name = "FAMILY", requires = "leg")]
    along: Option<String>,
    /// Parameters of the new leg in the family
    #[arg(long, value_name = "T[,U,..]", allow_hyphen_values = true, requires = "leg")]
    to: Option<String>,
    /// Leg, family and parameters, for instance 1:3:0.25 or 1:P1:P4-P5:1/4; repeat for several
    #[arg(long = "move", value_name = "LEG:FAMILY:T[,U,..]", conflicts_with = "leg")]
    moves: Vec<String>,
    /// Make all moves at once, along families of the given design
    #[arg(long)]
    together: bool,
    /// Write the new design; with --search, the designs found into this folder
    #[arg(short, long, value_name = "PATH")]
    output: Option<OutputPath>,
    /// Threshold for zero, relative to the size of the body
    #[arg(long, value_name = "X", default_value_t = 1e-9)]
    tolerance: f64,
    /// Search for equivalent platforms with the properties below
    #[arg(long, conflicts_with_all = ["leg", "moves", "together"])]
    search: bool,
    #[command(flatten)]
    targets: targets::TargetArgs,
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
        return found::run(args.output.as_deref(), &args.targets, &design, options);
    }
    if let Some(option) = args.targets.first_given() {
        let message = format!("{option} is a target of --search");
        return Err(Failure::refused("move::target_without_search", message).with_help("add --search"));
    }
    let moves = args.moves()?;
    if moves.is_empty() {
        let families = design.families_in_words(&families(&design, options)?);
        let failure = Failure::refused("move::nothing_asked", "no move is given");
        return Err(failure.with_help(families.map_err(|e| Failure::internal(e.to_string()))?));
    }
    if moves.len() < 2 {
        context.no_effect("together", "a single leg is moved")?;
    }
    let asked = MoveOptions::default().together(args.together).search(options);
    let found = design.move_legs(&moves, asked).map_err(|why| refusal(&why))?;
    let mut answer = MovesAnswer::new(&design, &found);
    if let (Some(path), Some(new), true) = (&args.output, &found.design, found.is_regular()) {
        files::write_design(path, new)?;
        answer.output = Some(path.display().to_string());
    }
    let text = sheet::answers::moves(&answer);
    let exit = match (found.is_regular(), found.is_singular()) {
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

/// The families of a design.
fn families(design: &Design, options: ComponentOptions) -> Result<Components, Failure> {
    let legs = design.replaceable_legs(&ReplaceableOptions::all(options));
    legs.map(|l| l.found).map_err(|why| no_families(&why))
}

fn no_families(why: &NoReplaceableLegs) -> Failure {
    match why {
        NoReplaceableLegs::Search(ComponentsError::Tolerance(_)) => {
            Failure::refused("move::bad_tolerance", why.to_string())
        }
        _ => Failure::internal(why.to_string()),
    }
}

impl EquivalentsMoveArgs {
    /// All requested moves in order.
    fn moves(&self) -> Result<Vec<LegMoveRequest>, Failure> {
        let parts = self.leg.as_deref().zip(self.along.as_deref()).zip(self.to.as_deref());
        let in_parts = parts.map(|((leg, along), to)| LegMoveRequest::of(leg, along, to));
        let in_words = self.moves.iter().map(|text| text.parse());
        in_parts.into_iter().chain(in_words).collect::<Result<_, _>>().map_err(|why| match why {
            InvalidMove::Leg(_) => {
                Failure::refused("move::no_such_leg", why.to_string()).with_help("give a leg from 1 to 6")
            }
            _ => Failure::refused("move::bad_move", why.to_string()).with_help(FORM),
        })
    }
}

const FORM: &str = "a move is LEG:FAMILY:T[,U,..], for instance 1:3:0.25 or 1:P1:P4-P5:1/4";

/// The refusal of moves, with the families that there are.
fn refusal(why: &NoMoves) -> Failure {
    let refused = |code: &'static str, help: &str| Failure::refused(code, why.to_string()).with_help(help);
    match why {
        NoMoves::Families(why) => no_families(why),
        NoMoves::NotAFamily(_) => refused(
            "move::no_such_family",
            "name the joints that span it: P1:P4-P5 is the legs from P1 to the line through P4 and P5",
        ),
        NoMoves::NoSuchFamily { families, .. } => refused("move::no_such_family", families),
        NoMoves::Ambiguous { .. } => refused("move::ambiguous_family", "give the number of one of them"),
        NoMoves::Fixed(_) => refused("move::fixed", "move another leg, or remove the joint from `fixed`"),
        NoMoves::Move { why, families } => {
            let code = match why {
                RelocateError::NoSuchFamily { .. } => "move::no_such_family",
                RelocateError::ParameterCount { .. } => "move::parameter_count",
                RelocateError::NoLeg { .. } => "move::no_leg",
                RelocateError::NotCarried { .. } => "move::not_carried",
                RelocateError::Twice(_) => "move::leg_twice",
                _ => return Failure::internal(why.to_string()),
            };
            refused(code, families)
        }
        _ => Failure::internal(why.to_string()),
    }
}
