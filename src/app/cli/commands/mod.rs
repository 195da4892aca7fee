//! One file or folder for each command, in folders by group.
//!
//! To add the command `foo`:
//! 1. write `commands/foo.rs` with `#[derive(Debug, clap::Args)] pub(crate) struct Args` (doc comments are
//!    the help texts) and `pub(crate) fn run(args: &Args, context: &mut Context) -> Result<Answer, Failure>`;
//!    `design/convert.rs` is the smallest example. A command of a group is a file of its folder;
//! 2. add `mod foo;`, one line to [`Command`] and one to [`Command::run`] below, or to those of the group;
//! 3. give it a place and an example in `cli/guide.rs`, from which `--help` is made;
//! 4. describe it in `docs/cli.md` and test the process in `tests/it/cli_foo.rs`.
//!
//! Load designs with [`Context::load`], take the seed from [`Context::seed`], write files with `files::write_text`. The
//! answer is a record (`src/app/records`) and its text is made from the record. Numbers that may be infinite or not a
//! number are `records::Number`. Print nothing: return the record and its text as [`Answer`], or the reason for having
//! none as [`Failure`].

mod assess;
mod at;
mod bench;
mod build;
mod calibrate;
mod check;
mod compare;
mod design;
mod equivalents;
mod explore;
mod export;
mod fk;
mod ik;
mod limits;
mod motion;
mod new;
mod optimize;
mod pentapod;
mod plot;
mod report;
mod shell;
mod singular;
mod sweep;
mod verify;
mod view;

use clap::Subcommand;

use super::context::Context;
use super::failure::Failure;
use super::output::Answer;

/// The way from another design to commands for octahedral designs.
const NEAREST: &str =
    "`equipod equivalents nearest DESIGN -o FILE` writes the nearest octahedral platform, with its error;";

/// The commands for a design that is not octahedral.
const GENERAL: &str = "`equipod equivalents components` and `equipod equivalents move DESIGN --search --spacing MIN` find replaceable legs and equivalents of every design";

/// The commands, in the order of the guide.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Write a design from a few sizes, from corners, from a table of points or from a model
    New(new::NewArgs),
    /// Find all poses, real and complex, for given leg lengths
    Fk(fk::FkArgs),
    /// Compute the leg lengths at given poses
    Ik(ik::IkArgs),
    /// Compute forces, stiffness and resolution at a pose, what a stuck leg leaves, and the nearest singular pose
    At(at::AtArgs),
    /// Compute the free travel of the platform from a pose, and the nearest allowed pose
    Limits(limits::LimitsArgs),
    /// Compute and change the platforms equivalent to a design
    #[command(subcommand)]
    Equivalents(equivalents::EquivalentsCommand),
    /// Decide whether two designs are kinematically equivalent
    Verify(verify::VerifyArgs),
    /// Run the whole analysis of a design and write it into a folder
    Explore(explore::ExploreArgs),
    /// Decide whether a design meets its requirements at all poses of its workspace
    Assess(assess::AssessArgs),
    /// Compare designs in one table: margins, forces, stiffness, sizes, tolerances
    Compare(compare::CompareArgs),
    /// Compute forces, speeds and powers of the legs along a trajectory or standard manoeuvres
    Motion(motion::MotionArgs),
    /// Find the best platform under the requirements of a design
    Optimize(optimize::OptimizeArgs),
    /// Decide whether a design is architecturally singular, and explain why
    Check(check::CheckArgs),
    /// Find singular poses and self-motions
    #[command(subcommand)]
    Singular(singular::SingularCommand),
    /// Round joints to a grid of holes and budget their tolerances
    #[command(subcommand)]
    Build(build::BuildCommand),
    /// Compute many designs from a plan, in shards that may be interrupted
    #[command(subcommand)]
    Sweep(sweep::SweepCommand),
    /// Find the joints and leg offsets of a machine from measured poses and lengths
    Calibrate(calibrate::CalibrateArgs),
    /// Write files for CAD, simulators, machine controls, tables and drawings
    Export(export::ExportArgs),
    /// Convert design files, start from designs of real hardware, print schemas
    #[command(subcommand)]
    Design(design::DesignCommand),
    /// Draw one picture as SVG; `equipod plot --help` lists the figures
    Plot(plot::PlotArgs),
    /// Write a design as one live HTML page
    View(view::ViewArgs),
    /// Write a folder of results as one HTML page
    Report(report::ReportArgs),
    /// Solve random problems, validate the answers independently, count and time them
    Bench(bench::BenchArgs),
    /// Print completion scripts and write manual pages
    #[command(subcommand)]
    Shell(shell::ShellCommand),
}

impl Command {
    /// Runs the command.
    pub(crate) fn run(&self, context: &mut Context) -> Result<Answer, Failure> {
        match self {
            Self::New(args) => new::run(args, context),
            Self::Fk(args) => fk::run(args, context),
            Self::Ik(args) => ik::run(args, context),
            Self::At(args) => at::run(args, context),
            Self::Limits(args) => limits::run(args, context),
            Self::Equivalents(command) => command.run(context),
            Self::Verify(args) => verify::run(args, context),
            Self::Explore(args) => explore::run(args, context),
            Self::Assess(args) => assess::run(args, context),
            Self::Compare(args) => compare::run(args, context),
            Self::Motion(args) => motion::run(args, context),
            Self::Optimize(args) => optimize::run(args, context),
            Self::Check(args) => check::run(args, context),
            Self::Singular(command) => command.run(context),
            Self::Build(command) => command.run(context),
            Self::Sweep(command) => command.run(context),
            Self::Calibrate(args) => calibrate::run(args, context),
            Self::Export(args) => export::run(args, context),
            Self::Design(command) => command.run(context),
            Self::Plot(args) => plot::run(args, context),
            Self::View(args) => view::run(args, context),
            Self::Report(args) => report::run(args, context),
            Self::Bench(args) => bench::run(args, context),
            Self::Shell(command) => command.run(),
        }
    }
}
