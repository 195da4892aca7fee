//! `equipod shell man`: manual pages.

use std::fmt::Write as _;

use clap_mangen::Man;

use crate::app::cli::guide;
use crate::app::cli::{Answer, Exit, Failure, OutputPath, files};
use records::ManAnswer;

/// Arguments of `shell man`.
#[derive(Debug, clap::Args)]
pub(crate) struct ShellManArgs {
    /// Folder for the pages
    #[arg(short, long, value_name = "DIR")]
    output: OutputPath,
}

/// File names and texts: `equipod.1` and one page for each command, `equipod-plot-modes.1` for the figures of `plot`.
fn pages() -> std::io::Result<Vec<(String, String)>> {
    let mut program = guide::program().disable_help_subcommand(true);
    program.build();
    let mut out = Vec::new();
    add(&program, &mut out)?;
    Ok(out)
}

fn add(command: &clap::Command, out: &mut Vec<(String, String)>) -> std::io::Result<()> {
    let version = concat!("equipod ", env!("CARGO_PKG_VERSION"));
    let page = Man::new(command.clone()).source(version).manual("equipod manual");
    let mut text = Vec::new();
    page.render(&mut text)?;
    out.push((page.get_filename(), String::from_utf8_lossy(&text).into_owned()));
    command.get_subcommands().try_for_each(|c| add(c, out))
}

/// Writes the pages.
pub(crate) fn run(args: &ShellManArgs) -> Result<Answer, Failure> {
    files::make_folder(&args.output)?;
    let pages = pages().map_err(|e| Failure::internal(format!("a manual page cannot be made: {e}")))?;
    let (mut paths, mut text) = (Vec::new(), String::new());
    for (name, page) in pages {
        let path = args.output.join(name);
        files::write_text(&path, &page)?;
        let _ = writeln!(text, "wrote {}", path.display());
        paths.push(path.display().to_string());
    }
    Ok(Answer::new(Exit::Yes, ManAnswer { paths }, text))
}
