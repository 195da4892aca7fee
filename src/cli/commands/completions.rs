//! `equipod completions`: completion scripts for shells.

use clap::CommandFactory;
use clap_complete::Shell;

use crate::cli::args::Cli;
use crate::cli::exit::Exit;
use crate::cli::output::Answer;
use crate::records::CompletionsAnswer;

/// Arguments of `completions`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Shell the script is for
    shell: Shell,
}

/// The script on standard output.
pub(crate) fn run(args: &Args) -> Answer {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "equipod", &mut script);
    let text = String::from_utf8_lossy(&script).into_owned();
    let record = CompletionsAnswer { shell: args.shell.to_string(), script: text.clone() };
    Answer::new(Exit::Yes, record, text)
}
