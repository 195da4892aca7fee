//! `equipod shell`: completion scripts and manual pages, for shells and packagers.

mod completions;
mod man;

use clap::Subcommand;

use crate::app::cli::{Answer, Failure};

/// Commands about the shell.
#[derive(Debug, Subcommand)]
pub(crate) enum ShellCommand {
    /// Print the completion script for a shell
    Completions(completions::ShellCompletionsArgs),
    /// Write the manual pages of all commands
    Man(man::ShellManArgs),
}

impl ShellCommand {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<Answer, Failure> {
        match self {
            Self::Completions(args) => Ok(completions::run(args)),
            Self::Man(args) => man::run(args),
        }
    }
}
