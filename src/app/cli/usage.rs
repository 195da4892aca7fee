//! Misunderstood arguments, with suggestions.

use clap::Command;
use clap::error::{ContextKind, ContextValue, ErrorKind};

use super::failure::Failure;
use super::guide::{self, GuideEntry};
use files::design::{likeness, nearest_word};
use files::export::ExportFormat;

/// Words more similar than this to a name are taken for it (similarity of Jaro and Winkler).
const NEAR: f64 = 0.9;

/// Options of other programs and commands, with their names in a command that has only the second one.
const OPTIONS: [(&str, &str); 10] = [
    ("--out", "--output"),
    ("--file", "--output"),
    ("--jobs", "--threads"),
    ("--cores", "--threads"),
    ("--random-seed", "--seed"),
    ("--silent", "--quiet"),
    ("--format", "--to"),
    ("--length", "--lengths"),
    ("--pose", "--at"),
    ("--at", "--pose"),
];

/// The refusal of arguments, with suggestions.
pub(crate) fn refusal(error: &clap::Error, args: &[String]) -> Failure {
    let text = error.to_string();
    let lines = text.lines().take_while(|l| !l.starts_with("Usage:")).map(str::trim);
    let (tips, lines): (Vec<&str>, Vec<&str>) =
        lines.filter(|l| !l.is_empty() && !l.starts_with("For more")).partition(|l| l.starts_with("tip:"));
    let message = lines.join(" ");
    let message = message.trim_start_matches("error: ");
    let mut program = guide::program();
    program.build();
    let place = UnderstoodUpTo::of(&program, args);
    let tip = || tips.first().map(|t| t.trim_start_matches("tip:").trim().to_string());
    let see = format!("see `{} --help`", place.name());
    let (message, help) = match error.kind() {
        ErrorKind::InvalidSubcommand => {
            let word = said(error, ContextKind::InvalidSubcommand).unwrap_or_default();
            place.unknown_command(&word)
        }
        ErrorKind::MissingSubcommand | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            (format!("`{}` needs one of its commands", place.name()), place.commands())
        }
        ErrorKind::UnknownArgument => {
            let word = said(error, ContextKind::InvalidArg).unwrap_or_default();
            (message.to_string(), place.meant_option(&word).or_else(tip).unwrap_or(see))
        }
        ErrorKind::ValueValidation => (in_words(message), tip().unwrap_or(see)),
        ErrorKind::InvalidValue if place.path == ["export"] => {
            let word = said(error, ContextKind::InvalidValue).unwrap_or_default();
            (message.to_string(), formats_for(&word).or_else(tip).unwrap_or(see))
        }
        _ => (message.to_string(), tip().unwrap_or(see)),
    };
    Failure::refused("usage", message).with_help(help)
}

/// The formats for a program: those whose purpose names it.
fn formats_for(program: &str) -> Option<String> {
    let program = program.to_lowercase();
    let names = |format: &ExportFormat| {
        let purpose = format.writer().purpose.to_lowercase();
        purpose.split(|c: char| !c.is_alphanumeric()).any(|word| word == program)
    };
    let all = ExportFormat::ALL.into_iter().filter(names);
    let all: Vec<String> =
        all.map(|format| format!("`--to {format}` ({})", format.writer().purpose)).collect();
    (!all.is_empty()).then(|| format!("for {program}: {}", all.join(" or ")))
}

/// A message about a value, without the words of Rust for numbers and ranges.
fn in_words(message: &str) -> String {
    let message = message.replace("invalid digit found in string", "give a whole number");
    match message
        .split_once(" is not in ")
        .and_then(|(before, range)| Some((before, range.split_once("..=")?)))
    {
        Some((before, (least, greatest))) => format!("{before} is not from {least} to {greatest}"),
        None => message,
    }
}

fn said(error: &clap::Error, kind: ContextKind) -> Option<String> {
    match error.get(kind)? {
        ContextValue::String(word) => Some(word.clone()),
        ContextValue::Strings(words) => words.first().cloned(),
        _ => None,
    }
}

/// The part of the arguments that was understood.
struct UnderstoodUpTo<'a> {
    program: &'a Command,
    command: &'a Command,
    path: Vec<&'a str>,
}

impl<'a> UnderstoodUpTo<'a> {
    fn of(program: &'a Command, args: &[String]) -> Self {
        let mut place = Self { program, command: program, path: Vec::new() };
        let mut words = args.iter().skip(1).filter(|a| a.as_str() != "help");
        while let Some(word) = words.next() {
            if word == "--seed" {
                words.next();
            } else if let Some(command) = place.command.find_subcommand(word) {
                place.command = command;
                place.path.push(command.get_name());
            } else if !word.starts_with('-') {
                break;
            }
        }
        place
    }

    /// The command as typed.
    fn name(&self) -> String {
        std::iter::once("equipod").chain(self.path.iter().copied()).collect::<Vec<_>>().join(" ")
    }

    /// The commands that can follow.
    fn commands(&self) -> String {
        if self.path.is_empty() {
            return "`equipod --help` lists the commands by job".into();
        }
        let names = self.command.get_subcommands().map(Command::get_name);
        let names: Vec<&str> = names.filter(|n| *n != "help").collect();
        format!("one of: {}", names.join(", "))
    }

    /// Message and help for a word in the place of a command.
    fn unknown_command(&self, word: &str) -> (String, String) {
        if !self.path.is_empty() && (word.contains(['.', '/', '\\'])) {
            return (format!("`{}` needs one of its commands before `{word}`", self.name()), self.commands());
        }
        let message = format!("`{} {word}` is not a command", self.name());
        let group = self.path.first().copied().unwrap_or_default();
        let meant: Vec<String> =
            nearest(word, group).iter().map(|path| format!("`equipod {path}`")).collect();
        let help = match meant.as_slice() {
            [] => self.commands(),
            some => format!("did you mean {}?", some.join(" or ")),
        };
        (message, help)
    }

    /// The suggestions for an unknown option: an option of this command, or of another command.
    fn meant_option(&self, word: &str) -> Option<String> {
        let options = |c: &Command| -> Vec<String> {
            c.get_arguments().filter_map(|a| a.get_long().map(|l| format!("--{l}"))).collect()
        };
        let own = options(self.command);
        let known = OPTIONS.iter().find(|(other, name)| *other == word && own.iter().any(|o| o == name));
        let near = || {
            let names: Vec<&str> = own.iter().map(|o| o.trim_start_matches('-')).collect();
            nearest_word(word.trim_start_matches('-'), &names, NEAR).map(|name| format!("--{name}"))
        };
        if let Some(option) = known.map(|(_, name)| (*name).to_string()).or_else(near) {
            return Some(format!("did you mean `{option}`?"));
        }
        let others = guide::entries()
            .filter(|e| find(self.program, e.path).is_some_and(|c| options(c).iter().any(|o| o == word)));
        let others: Vec<String> = others.map(|e| format!("`equipod {}`", e.path)).collect();
        let first = others.first()?;
        Some(match others.len() {
            1..=3 => format!("{word} is an option of {}", others.join(", ")),
            n => format!("{word} is an option of {first} and {} other commands", n - 1),
        })
    }
}

fn find<'a>(program: &'a Command, path: &str) -> Option<&'a Command> {
    path.split(' ').try_fold(program, |c, word| c.find_subcommand(word))
}

/// The suggested commands for a word: by the last word of their name, by other words for them, or by similarity.
/// Commands of `group` come before others.
fn nearest(word: &str, group: &str) -> Vec<&'static str> {
    let meant = |e: &GuideEntry| {
        let leaf = e.path.rsplit(' ').next().unwrap_or(e.path);
        let joined = e.path.replace(' ', "-");
        let named = [leaf, &joined].map(|n| likeness(word, n)).into_iter().fold(0.0, f64::max);
        // another word for a command counts less than its name
        let other = e.words.iter().map(|n| 0.999 * likeness(word, n)).fold(0.0, f64::max);
        let nearby = if !group.is_empty() && e.path.starts_with(group) { 1e-3 } else { 0.0 };
        named.max(other) + nearby
    };
    let best = guide::entries().map(meant).fold(0.0, f64::max);
    if best < NEAR {
        return Vec::new();
    }
    guide::entries().filter(|e| best - meant(e) < 1e-9).map(|e| e.path).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_leads_to_its_command_in_whatever_group() {
        for (word, group, meant) in [
            ("family", "", &["equivalents family"][..]),
            ("familly", "", &["equivalents family"]),
            ("map", "", &["equivalents map"]),
            ("move", "", &["equivalents move"]),
            ("components", "", &["equivalents components", "plot components"]),
            ("topologies", "", &["equivalents topologies", "plot topologies"]),
            ("singularities", "", &["singular poses"]),
            ("selfmotion", "", &["singular motion"]),
            ("round", "", &["build round"]),
            ("tolerances", "", &["build tolerances"]),
            ("convert", "", &["design convert"]),
            ("presets", "", &["design presets"]),
            ("schema", "", &["design schema"]),
            ("locus", "", &["singular locus", "plot locus"]),
            ("completions", "", &["shell completions"]),
            ("man", "", &["shell man"]),
            ("optimise", "", &["optimize"]),
            ("family", "singular", &["equivalents family"]),
            ("topologies", "plot", &["plot topologies"]),
            ("singularities", "plot", &["singular poses"]),
            ("frobnicate", "", &[]),
        ] {
            assert_eq!(nearest(word, group), meant, "{word}");
        }
    }
}
