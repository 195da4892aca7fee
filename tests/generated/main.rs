//! Writes purpose, options and examples of each command, the fields of its answer and the keys of design files into the
//! manual, from their definitions. The program does not contain this code.
//!
//! `cargo test --test generated` compares the pages; with `WRITE_PAGES=1`, as in `.ci/generate`, it writes stale ones.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a failure ends the test")]

mod answers;
mod fields;

use std::fmt::Write as _;

use clap::{Arg, Command};
use equipod::cli::guide;
use records::schema_names;

/// The beginnings and ends of blocks; the subject follows the beginning.
const MARKS: [(&str, &str); 3] = [
    ("<!-- options of ", "<!-- end of options -->"),
    ("<!-- keys of ", "<!-- end of keys -->"),
    ("<!-- all ", "<!-- end of records -->"),
];

/// A text on one line.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Text of a table cell: on one line, bars escaped.
fn cell(text: &str) -> String {
    one_line(text).replace('|', "\\|")
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

/// The beginning of the text of an argument that the manual describes once for all commands.
const DESIGN: &str = "Design file (.toml or .json)";

/// The notations of a pose, which the manual describes once too.
const POSE: &str = ": `home`, `x,y,z,roll_deg,pitch_deg,yaw_deg` or `x,y,z,qw,qx,qy,qz`";
/// The name of the block with the options that many commands share, and the place of that block in the manual.
const SHARED: (&str, &str) = ("poses", "[Convention of poses](#convention-of-poses)");
/// A longer list of words is left to the page that describes them.
const MOST_WORDS: usize = 20;

/// Whether an argument is one of the options that many commands share.
fn is_shared(arg: &Arg) -> bool {
    arg.get_help_heading().is_some_and(|heading| heading.starts_with("Convention of poses"))
}

/// The link to the fields of the answer of a command; empty for groups.
fn answer(command: &Command) -> String {
    let name = path(command).replace(' ', "-");
    let known = schema_names().any(|schema| schema == name);
    if known { format!(" [Answer](answers.md#equipod-{name}).") } else { String::new() }
}

fn meaning(arg: &Arg) -> String {
    let mut out = one_line(&arg.get_help().map(ToString::to_string).unwrap_or_default()).replace(POSE, "");
    if arg.get_action().takes_values() {
        let possible: Vec<String> =
            arg.get_possible_values().iter().map(|v| format!("`{}`", v.get_name())).collect();
        if (1..=MOST_WORDS).contains(&possible.len()) {
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

/// A command as it is typed behind the name of the program.
fn path(command: &Command) -> &str {
    command.get_bin_name().and_then(|name| name.strip_prefix("equipod ")).unwrap_or_default()
}

/// The examples of a command as in its `--help`; none for groups.
fn examples(command: &Command) -> String {
    let Some(entry) = guide::entries().find(|e| e.path == path(command)) else { return String::new() };
    let lines: Vec<String> = entry.examples.iter().map(|e| format!("    equipod {e}\n")).collect();
    format!("{}\n", lines.concat())
}

/// A line for each argument, those without a dash first.
fn lines<'a>(arguments: impl Iterator<Item = &'a Arg>) -> String {
    let (first, rest): (Vec<&Arg>, Vec<&Arg>) = arguments.partition(|a| a.is_positional());
    let said = |a: &&Arg| {
        let rest = meaning(a);
        rest.strip_prefix(DESIGN).is_none_or(|rest| !(rest.is_empty() || rest.starts_with(", or `-`")))
    };
    let mut out = String::new();
    for arg in first.into_iter().chain(rest).filter(said) {
        let _ = writeln!(out, "- `{}`: {}", spelling(arg), meaning(arg));
    }
    out
}

/// Purpose, examples and options of one command and its own commands; options of all commands are listed only for the
/// program, and those that many commands share by a link. A figure of `plot` has no heading: its purpose names it.
fn block(command: &Command, global: bool) -> String {
    let mut out = String::from("\n");
    let shown = |a: &&Arg| {
        let own = global || !a.is_global_set();
        own && !["help", "version"].contains(&a.get_id().as_str())
    };
    let arguments = || command.get_arguments().filter(shown);
    if let (Some(about), false) = (command.get_about(), global) {
        let name =
            path(command).strip_prefix("plot ").map(|name| format!("`plot {name}`: ")).unwrap_or_default();
        let _ = writeln!(out, "{name}{}.{}\n", one_line(&about.to_string()), answer(command));
        out.push_str(&examples(command));
    }
    let mut listed = lines(arguments().filter(|a| !is_shared(a)));
    if arguments().any(is_shared) {
        let _ = writeln!(listed, "- {}", SHARED.1);
    }
    if !listed.is_empty() {
        let _ = writeln!(out, "{listed}");
    }
    if !global {
        let parts = command.get_subcommands();
        out.extend(parts.map(|c| block(c, false).trim_start_matches('\n').to_string()));
    }
    out
}

/// The options that many commands share, from the first command that has them.
fn shared_options(program: &Command) -> Option<String> {
    let command = program.get_subcommands().find(|c| c.get_arguments().any(is_shared))?;
    Some(format!("\n{}\n", lines(command.get_arguments().filter(|a| is_shared(a)))))
}

/// The commands and answers that the manual still has to describe.
struct OpenEntries {
    program: Command,
    whole: bool,
    commands: Vec<&'static str>,
}

impl OpenEntries {
    fn new() -> Self {
        let mut program = guide::program().disable_help_subcommand(true);
        program.build();
        Self { program, whole: true, commands: guide::entries().map(|e| e.path).chain([SHARED.0]).collect() }
    }

    /// The options of a command, each command once; `None` if it is unknown or already described.
    fn options(&mut self, name: &str) -> Option<String> {
        if name == "equipod" {
            return std::mem::take(&mut self.whole).then(|| block(&self.program, true));
        }
        let before = self.commands.len();
        self.commands.retain(|path| *path != name && !path.starts_with(&format!("{name} ")));
        if name == SHARED.0 {
            return (self.commands.len() < before).then(|| shared_options(&self.program)).flatten();
        }
        let command = name.split(' ').try_fold(&self.program, |c, word| c.find_subcommand(word))?;
        (self.commands.len() < before).then(|| block(command, false))
    }
}

/// The page with the blocks of this program. In the manual every command of the guide has a mark, or its group has one
/// for all, and so has every answer.
fn written(page: &str) -> Result<String, String> {
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
            "<!-- keys of " => fields::of_design(name),
            _ => (name == "records").then(answers::all),
        };
        out.push_str(&text.ok_or_else(|| format!("`{line}` names nothing, or is there twice"))?);
    }
    if let Some(end) = until {
        return Err(format!("a mark without `{end}`"));
    }
    // the manual is the page with the options of the program
    if !(open.whole || open.commands.is_empty()) {
        return Err(format!("the page lacks marks: {}", open.commands.join(", ")));
    }
    Ok(out)
}

#[test]
fn the_options_and_fields_in_the_documents_are_fresh() {
    for path in ["docs/cli.md", "docs/answers.md", "docs/design-files.md"] {
        let page = std::fs::read_to_string(path).unwrap();
        let fresh = written(&page).unwrap();
        if std::env::var_os("WRITE_PAGES").is_some() {
            std::fs::write(path, fresh).unwrap();
        } else {
            assert!(fresh == page, "{path} is stale: run .ci/generate");
        }
    }
}

#[test]
fn stale_lines_and_bad_marks_are_found() {
    let page = std::fs::read_to_string("docs/cli.md").unwrap();
    let fields = std::fs::read_to_string("docs/answers.md").unwrap();
    for (page, good, bad) in [(&page, "- `--lengths", "- `--length"), (&fields, "- `lengths`", "- `length`")]
    {
        let stale = page.replacen(good, bad, 1);
        assert_ne!(stale, *page);
        assert!(written(&stale).as_ref() == Ok(page));
    }
    for (what, changed) in [
        ("a command", page.replacen("<!-- options of fk -->", "", 1)),
        ("another command", page.replacen("options of fk", "options of verify", 1)),
        ("an end", page.replace("<!-- end of options -->", "")),
        ("records of something else", fields.replacen("<!-- all records -->", "<!-- all answers -->", 1)),
        ("a table of design files", format!("{page}<!-- keys of design nothing -->\n<!-- end of keys -->\n")),
    ] {
        assert!(written(&changed).is_err(), "{what}");
    }
}
