//! `equipod shell completions`: completion scripts for shells.

use clap_complete::Shell;

use crate::app::cli::guide;
use crate::app::cli::{Answer, Exit};
use records::CompletionsAnswer;

/// Arguments of `shell completions`.
#[derive(Debug, clap::Args)]
pub(crate) struct ShellCompletionsArgs {
    /// Shell the script is for
    shell: Shell,
}

/// The script on standard output.
pub(crate) fn run(args: &ShellCompletionsArgs) -> Answer {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut guide::program(), "equipod", &mut script);
    let text = String::from_utf8_lossy(&script).into_owned();
    let record = CompletionsAnswer { shell: args.shell.to_string(), script: text.clone() };
    Answer::new(Exit::Yes, record, text)
}
