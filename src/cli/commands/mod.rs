//! One file per command.
//!
//! To add the command `foo`:
//! 1. write `commands/foo.rs` with `#[derive(Debug, clap::Args)] pub(crate) struct Args` (doc comments are
//!    the help texts) and `pub(crate) fn run(args: &Args, context: &mut Context) -> Result<Answer, Failure>`;
//!    `convert.rs` is the smallest example;
//! 2. add `mod foo;`, one line to [`Command`] and one to [`Command::run`] below;
//! 3. describe it in `docs/cli.md` and test the process in `tests/it/cli_foo.rs`.
//!
//! Load designs with [`Context::load`], take the seed from [`Context::seed`], write files with
//! `files::write_text`. What the command found is a record (`src/records`), from which its text is made; numbers
//! that may be infinite or not a number are `records::Number`. Print nothing: the record and its text are the [`Answer`],
//! why there is none is the [`Failure`].

mod assess;
mod bench;
mod check;
mod completions;
mod components;
mod convert;
mod explore;
mod export;
mod family;
mod fk;
mod locus;
mod man;
mod map;
mod r#move;
mod optimize;
mod plot;
mod presets;
mod report;
mod round;
mod schema;
mod selfmotion;
mod singularities;
mod tolerances;
mod topologies;
mod verify;
mod view;

use clap::Subcommand;

use super::context::Context;
use super::failure::Failure;
use super::output::Answer;
use super::reference;

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Whether a design meets its requirements: lengths, swing, clearances, forces, speeds over all its poses
    Assess(assess::Args),
    /// Random problems of a class: solved, validated by independent code, counted, timed
    Bench(bench::Args),
    /// Whether a design is architecturally singular: decided exactly, explained, how far away
    Check(check::Args),
    /// Completion script for a shell
    Completions(completions::Args),
    /// The families of legs that can be moved without changing the platform, of any design
    Components(components::Args),
    /// Write a design in the other notation (TOML or JSON)
    Convert(convert::Args),
    /// Everything about an octahedral design: class, best joint-free platform, verdict, poses, pictures, report
    Explore(explore::Args),
    /// Files for CAD, simulators, machine controls, tables and drawings
    Export(export::Args),
    /// Every platform equivalent to an octahedral design
    Family(family::Args),
    /// All poses, real and complex, for given leg lengths
    Fk(fk::Args),
    /// The squared length of a virtual leg at all poses, in the complex plane, while one leg length varies
    Locus(locus::Args),
    /// Manual pages of all commands
    Man(man::Args),
    /// The affine map between the squared leg lengths of two designs
    Map(map::Args),
    /// Move legs without changing the platform, or search an equivalent one that fulfils wishes
    Move(r#move::Args),
    /// The best joint-free platform equivalent to an octahedral design
    Optimize(optimize::Args),
    /// One picture as SVG: assembly modes, det A, replaceable joints, workspace, fronts, singular poses
    Plot(plot::Args),
    /// Designs of real hardware with sources, as a start for one's own
    Presets(presets::Args),
    /// The options of all commands written into the manual
    #[command(hide = true)]
    Reference(reference::Args),
    /// A folder of results as one HTML page: designs, verdicts with their evidence, pictures, hashes
    Report(report::Args),
    /// The joints of a design on a grid of holes: exactly equivalent to an octahedral platform, or as near as the grid allows
    Round(round::Args),
    /// JSON Schema of design files, or of the answers with --json
    Schema(schema::Args),
    /// The curves of poses with constant leg lengths through a pose
    Selfmotion(selfmotion::Args),
    /// Sign of det J at a pose, at all assembly modes and over a slice of positions; the largest box of poses without singularity
    Singularities(singularities::Args),
    /// How far joints may be off for the pose by the nominal formula to stay within a bound
    Tolerances(tolerances::Args),
    /// The ways to share joints that can hold a platform, and which one a design has
    Topologies(topologies::Args),
    /// Whether two designs are kinematically equivalent, with evidence
    Verify(verify::Args),
    /// A design as one HTML page: 3D, assembly modes, equivalents side by side, live offsets
    View(view::Args),
}

impl Command {
    /// Runs the command.
    pub(crate) fn run(&self, context: &mut Context) -> Result<Answer, Failure> {
        match self {
            Self::Assess(args) => assess::run(args, context),
            Self::Bench(args) => bench::run(args, context),
            Self::Check(args) => check::run(args, context),
            Self::Completions(args) => Ok(completions::run(args)),
            Self::Components(args) => components::run(args, context),
            Self::Convert(args) => convert::run(args, context),
            Self::Explore(args) => explore::run(args, context),
            Self::Export(args) => export::run(args, context),
            Self::Family(args) => family::run(args, context),
            Self::Fk(args) => fk::run(args, context),
            Self::Locus(args) => locus::run(args, context),
            Self::Man(args) => man::run(args),
            Self::Map(args) => map::run(args, context),
            Self::Move(args) => r#move::run(args, context),
            Self::Optimize(args) => optimize::run(args, context),
            Self::Plot(args) => plot::run(args, context),
            Self::Presets(args) => presets::run(args, context),
            Self::Reference(args) => reference::run(args),
            Self::Report(args) => report::run(args, context),
            Self::Round(args) => round::run(args, context),
            Self::Schema(args) => schema::run(args),
            Self::Selfmotion(args) => selfmotion::run(args, context),
            Self::Singularities(args) => singularities::run(args, context),
            Self::Tolerances(args) => tolerances::run(args, context),
            Self::Topologies(args) => topologies::run(args, context),
            Self::Verify(args) => verify::run(args, context),
            Self::View(args) => view::run(args, context),
        }
    }
}
