//! Arguments common to all commands.

use clap::{Args, Parser};

use super::commands::Command;

const AFTER_HELP: &str = "\
The files in designs/ come with the sources; `equipod new` and `equipod design presets` write designs without them.
A design or a table named - comes from standard input, an output named - goes to standard output.

Exit codes:
  0  yes, solved, done
  1  it ran and the answer is no (not equivalent, singular, infeasible)
  2  bad usage or bad design
  3  inconclusive: not proved either way, roots may be missing
  4  internal failure";

/// Design synthesis and kinematic equivalence of Gough-Stewart platforms.
#[derive(Debug, Parser)]
#[command(name = "equipod", version, about, after_help = AFTER_HELP, arg_required_else_help = false)]
pub(crate) struct Cli {
    #[command(flatten)]
    pub(crate) global: Global,
    /// Print the licence notices of the software that is compiled into the program
    #[arg(long)]
    pub(crate) licences: bool,
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// Options every command takes, before or after its name.
#[derive(Debug, Args)]
pub(crate) struct Global {
    /// Write exactly one JSON document to standard output, errors included
    #[arg(long, global = true)]
    pub(crate) json: bool,
    /// Seed of all random numbers; the same input and seed give the same output
    #[arg(long, global = true, value_name = "N", default_value_t = 1)]
    pub(crate) seed: u64,
    /// Write no warnings and no progress to standard error
    #[arg(short, long, global = true)]
    pub(crate) quiet: bool,
}
