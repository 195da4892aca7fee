//! `equipod reference`, hidden: writes the purpose of each command, its options, its examples and the fields of its
//! answer into the manual, from their definitions.

mod fields;

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::PathBuf;

use clap::{Arg, Command};

use super::exit::Exit;
use super::failure::Failure;
use super::files;
use super::guide;
use super::output::Answer;
use records::{ReferenceAnswer, schema_names};

/// Arguments of `reference`.
#[derive(Debug, clap::Args)]
pub(crate) struct ReferenceArgs {
    /// Page with marks `<!-- options of COMMAND -->`, `<!-- fields of ANSWER -->`, `<!-- keys of design -->` or
    /// `<!-- all records -->`; the text up to `<!-- end of options -->` and so on is replaced
    page: PathBuf,
}

/// The beginnings and ends of blocks; the subject follows the beginning.
const MARKS: [(&str, &str); 4] = [
    ("<!-- options of ", "<!-- end of options -->"),
    ("<!-- fields of ", "<!-- end of fields -->"),
    ("<!-- keys of ", "<!-- end of keys -->"),
    ("<!-- all ", "<!-- end of records -->"),
];

/// Text of a table cell: on one line, bars escaped.
fn cell(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace('|', "\\|")
}

/// The notation of an argument: `-o`, `--output <DIR>` or `<DESIGN>`.
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

/// The examples of a command as in its `--help`; none for groups.
fn examples(command: &Command) -> String {
    let name = command.get_bin_name().unwrap_or_default();
    let path = name.strip_prefix("equipod ").unwrap_or_default();
    let Some(entry) = guide::entries().find(|e| e.path == path) else { return String::new() };
    let heading = if entry.examples.len() == 1 { "Example" } else { "Examples" };
    let lines: Vec<String> = entry.examples.iter().map(|e| format!("    equipod {e}\n")).collect();
    format!("{heading}:\n\n{}\n", lines.concat())
}

/// Purpose, usage, options and examples of one command and its own commands; options of all commands are listed only
/// for the program.
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

/// The commands and answers that the manual still has to describe.
struct OpenEntries {
    program: Command,
    whole: bool,
    commands: Vec<&'static str>,
    answers: Vec<&'static str>,
    /// Marks of fields so far.
    seen: BTreeSet<String>,
}

impl OpenEntries {
    fn new() -> Self {
        let mut program = guide::program().disable_help_subcommand(true);
        program.build();
        let commands = guide::entries().map(|e| e.path).collect();
        Self { program, whole: true, commands, answers: schema_names().collect(), seen: BTreeSet::new() }
    }

    /// The options of a command, each command once; `None` if it is unknown or already described.
    fn options(&mut self, name: &str) -> Option<String> {
        if name == "equipod" {
            return std::mem::take(&mut self.whole).then(|| block(&self.program, true));
        }
        let before = self.commands.len();
        self.commands.retain(|path| *path != name && !path.starts_with(&format!("{name} ")));
        let command = name.split(' ').try_fold(&self.program, |c, word| c.find_subcommand(word))?;
        (self.commands.len() < before).then(|| block(command, false))
    }

    /// The fields of an answer or of one of its records, each once; `None` if it is unknown or already described.
    fn fields(&mut self, name: &str) -> Option<String> {
        let answer = name.split(' ').next()?;
        self.answers.retain(|a| *a != answer);
        if self.seen.insert(name.to_string()) { fields::of_mark(name) } else { None }
    }
}

/// The page with the blocks of this program. In the manual every command of the guide has a mark, or its group has one
/// for all, and so has every answer.
fn written(page: &str) -> Result<String, Failure> {
    let bad = |message: String| Failure::refused("reference::bad_page", message);
    let mut open = OpenEntries::new();
    let mut out = String::new();
    let mut until: Option<&str> = None;
    for line in page.lines() {
        if until == Some(line) {
            until = None;
        }
        if until.is_some() {
            continue;
        }
        let _ = writeln!(out, "{line}");
        let mark = MARKS.iter().find_map(|(begin, end)| {
            let name = line.strip_prefix(begin)?.strip_suffix(" -->")?;
            Some((*begin, name, *end))
        });
        let Some((begin, name, end)) = mark else { continue };
        until = Some(end);
        let text = match begin {
            "<!-- options of " => open.options(name),
            "<!-- fields of " => open.fields(name),
            "<!-- keys of " => fields::of_design(name),
            _ => (name == "records").then(fields::all_records),
        };
        out.push_str(&text.ok_or_else(|| bad(format!("`{line}` names nothing, or is there twice")))?);
    }
    if let Some(end) = until {
        return Err(bad(format!("a mark without `{end}`")));
    }
    // the manual is the page with the options of the program
    let described = open.commands.is_empty() && open.answers.is_empty();
    if !(open.whole || described) {
        let lacking = [open.commands, open.answers].concat().join(", ");
        return Err(bad(format!("the page lacks marks: {lacking}")));
    }
    Ok(out)
}

/// The page on standard output.
pub(crate) fn run(args: &ReferenceArgs) -> Result<Answer, Failure> {
    let text = written(&files::read_text(&args.page)?)?;
    Ok(Answer::new(Exit::Yes, ReferenceAnswer { page: text.clone() }, text))
}
