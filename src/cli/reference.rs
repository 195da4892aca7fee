//! `equipod reference`, hidden: what each command is for, its options and its examples written into the manual, from the definitions they are read by.

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::{Arg, Command};

use super::exit::Exit;
use super::failure::Failure;
use super::files;
use super::guide;
use super::output::Answer;
use crate::records::ReferenceAnswer;

/// Arguments of `reference`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Page with marks `<!-- options of NAME -->` and `<!-- end of options -->`; what is between them is replaced
    page: PathBuf,
}

const BEGIN: &str = "<!-- options of ";
const END: &str = "<!-- end of options -->";

/// Text of a table: on one line, bars escaped.
fn cell(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace('|', "\\|")
}

/// How an argument is written: `-o`, `--output <DIR>` or `<DESIGN>`.
fn spelling(arg: &Arg) -> String {
    let names = arg.get_value_names().unwrap_or_default();
    let mut value = names.iter().map(|n| format!("<{n}>")).collect::<Vec<_>>().join(" ");
    if arg.is_positional() {
        return if arg.is_required_set() { value } else { format!("[{}]", value.trim_matches(['<', '>'])) };
    }
    if !arg.get_action().takes_values() {
        value.clear();
    }
    let short = arg.get_short().map(|c| format!("-{c}"));
    let long = arg.get_long().map(|l| format!("--{l}"));
    let name = short.into_iter().chain(long).collect::<Vec<_>>().join(", ");
    if value.is_empty() { name } else { format!("{name} {value}") }
}

fn meaning(arg: &Arg) -> String {
    let mut out = cell(&arg.get_help().map(ToString::to_string).unwrap_or_default());
    if arg.get_action().takes_values() {
        let possible: Vec<String> =
            arg.get_possible_values().iter().map(|v| format!("`{}`", v.get_name())).collect();
        if !possible.is_empty() {
            let _ = write!(out, "; one of {}", possible.join(", "));
        }
        let default: Vec<_> = arg.get_default_values().iter().map(|v| v.to_string_lossy()).collect();
        if !default.is_empty() {
            let _ = write!(out, "; default `{}`", default.join(","));
        }
    }
    if arg.is_required_set() && !arg.is_positional() {
        out.push_str("; required");
    }
    out
}

/// The examples of a command as its `--help` has them; none for groups.
fn examples(command: &Command) -> String {
    let name = command.get_bin_name().unwrap_or_default();
    let path = name.strip_prefix("equipod ").unwrap_or_default();
    let Some(entry) = guide::entries().find(|e| e.path == path) else { return String::new() };
    let heading = if entry.examples.len() == 1 { "Example" } else { "Examples" };
    let lines: Vec<String> = entry.examples.iter().map(|e| format!("    equipod {e}\n")).collect();
    format!("{heading}:\n\n{}\n", lines.concat())
}

/// What one command and its own commands are for, usage, table and examples; the options all commands take stand at the program alone.
fn block(command: &Command, global: bool) -> String {
    let usage = command.clone().render_usage().to_string();
    let mut out = String::from("\n");
    if let (Some(about), false) = (command.get_about(), global) {
        let _ = writeln!(out, "{}.\n", cell(&about.to_string()));
    }
    let _ = writeln!(out, "    {}\n", cell(usage.trim_start_matches("Usage:")));
    let shown = |a: &&Arg| {
        let own = global || !a.is_global_set();
        !a.is_hide_set() && own && !["help", "version"].contains(&a.get_id().as_str())
    };
    let (first, rest): (Vec<&Arg>, Vec<&Arg>) =
        command.get_arguments().filter(shown).partition(|a| a.is_positional());
    if !(first.is_empty() && rest.is_empty()) {
        out.push_str("| argument | meaning |\n|---|---|\n");
    }
    for arg in first.into_iter().chain(rest) {
        let _ = writeln!(out, "| `{}` | {} |", cell(&spelling(arg)), meaning(arg));
    }
    out.push('\n');
    if !global {
        out.push_str(&examples(command));
        let parts = command.get_subcommands().filter(|c| !c.is_hide_set());
        out.extend(parts.map(|c| block(c, false).trim_start_matches('\n').to_string()));
    }
    out
}

/// The page with the blocks of this program. Every command of the guide has to have its mark, or its group has one for all, and every mark a command.
fn written(page: &str) -> Result<String, Failure> {
    let bad = |message: String| Failure::refused("reference::bad_page", message);
    let mut program = guide::program().disable_help_subcommand(true);
    program.build();
    let mut open: Vec<&str> = guide::entries().map(|e| e.path).collect();
    let mut program_open = true;
    let mut out = String::new();
    let mut skipping = false;
    for line in page.lines() {
        if line == END {
            skipping = false;
        }
        if skipping {
            continue;
        }
        let _ = writeln!(out, "{line}");
        let Some(name) = line.strip_prefix(BEGIN).and_then(|l| l.strip_suffix(" -->")) else { continue };
        skipping = true;
        if name == "equipod" && program_open {
            program_open = false;
            out.push_str(&block(&program, true));
            continue;
        }
        let before = open.len();
        open.retain(|path| *path != name && !path.starts_with(&format!("{name} ")));
        let command = name.split(' ').try_fold(&program, |c, word| c.find_subcommand(word));
        match command.filter(|_| open.len() < before) {
            Some(command) => out.push_str(&block(command, false)),
            None => return Err(bad(format!("`{name}` is not a command, or is there twice"))),
        }
    }
    if skipping {
        return Err(bad(format!("a mark without `{END}`")));
    }
    if program_open || !open.is_empty() {
        return Err(bad(format!("the page lacks marks: {}", open.join(", "))));
    }
    Ok(out)
}

/// The page on standard output.
pub(crate) fn run(args: &Args) -> Result<Answer, Failure> {
    let text = written(&files::read_text(&args.page)?)?;
    Ok(Answer::new(Exit::Yes, ReferenceAnswer { page: text.clone() }, text))
}
