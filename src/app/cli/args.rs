//! The command line as a whole.

use clap::Parser;
use clap::builder::{PossibleValuesParser, TypedValueParser};

use super::commands::Command;
use super::context::Global;

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
    /// Print the licences of all software in the program
    #[arg(long)]
    pub(crate) licences: bool,
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// Reads one of some choices by the words that the library gives them.
pub(crate) fn choice<T: Copy + Send + Sync + 'static>(
    all: &'static [T],
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    let found = move |word: String| all.iter().copied().find(|x| name(*x) == word).unwrap_or(all[0]);
    PossibleValuesParser::new(all.iter().map(|x| name(*x))).map(found)
}
