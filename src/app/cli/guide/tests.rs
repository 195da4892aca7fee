//! Checks the guide against the definitions, and every command line in any text against both.

use std::path::{Path, PathBuf};

use super::*;

fn leaves(command: &Command, path: &str, out: &mut Vec<String>) {
    for c in command.get_subcommands() {
        let path = format!("{path} {}", c.get_name());
        if c.has_subcommands() {
            leaves(c, &path, out);
        } else {
            out.push(path.trim().to_string());
        }
    }
}

#[test]
fn every_command_has_its_place_once() {
    let mut defined = Vec::new();
    leaves(&Cli::command(), "", &mut defined);
    let mut listed: Vec<String> = entries().map(|e| e.path.to_string()).collect();
    defined.sort();
    listed.sort();
    assert_eq!(defined, listed);
    for e in entries() {
        assert!(!e.examples.is_empty(), "{}", e.path);
        let own = format!("{} ", e.path);
        assert!(e.examples.iter().all(|x| format!("{x} ").starts_with(&own)), "{}", e.path);
        for x in e.examples {
            assert_eq!(fault(&words(x)), None, "{x}");
        }
    }
}

/// The words of a command line after `equipod`, up to a pipe or a comment.
fn words(line: &str) -> Vec<String> {
    let end = |w: &&str| !["|", "#", ">", "&&"].contains(w);
    line.split_whitespace()
        .take_while(end)
        .map(|w| w.trim_matches(['[', ']', ',', ';']).to_string())
        .collect()
}

/// The fault of a command line in a text: a command that does not exist, or an option that it does not have. A line
/// without placeholders in capitals must parse as a whole.
fn fault(words: &[String]) -> Option<String> {
    let mut command = program().disable_help_subcommand(true);
    command.build();
    let mut open = &command;
    let mut rest = words.iter();
    while let Some(word) = rest.clone().find(|w| !w.starts_with('-')) {
        let Some(next) = open.find_subcommand(word) else { break };
        open = next;
        rest.by_ref().find(|w| *w == word);
    }
    let placeholder = |w: &String| {
        w.contains("..") || w.chars().any(char::is_uppercase) || w.contains(['<', '(', '\u{2026}'])
    };
    if open.has_subcommands() {
        let next = rest.find(|w| !w.starts_with('-'));
        return match next {
            None => None,
            Some(w) if placeholder(w) => None,
            Some(w) => Some(format!("`{w}` is not a command of {}", open.get_name())),
        };
    }
    let known = |flag: &str| {
        ["help", "version"].contains(&flag) || open.get_arguments().any(|a| a.get_long() == Some(flag))
    };
    for flag in words.iter().filter_map(|w| w.strip_prefix("--")) {
        let flag = flag.split('=').next().unwrap_or_default();
        if !flag.is_empty() && !known(flag) {
            return Some(format!("`--{flag}` is not an option of {}", open.get_name()));
        }
    }
    let whole = rest.clone().next().is_some() && !words.iter().any(placeholder);
    if !whole || words.iter().any(|w| ["--help", "--version"].contains(&w.as_str())) {
        return None;
    }
    let line = std::iter::once("equipod").chain(words.iter().map(String::as_str));
    program().try_get_matches_from(line).err().map(|e| e.to_string())
}

/// Command lines in a text: pieces of code in a sentence, and in Markdown the lines of code. Lines put together by a
/// program (`{path}`) are left out.
fn command_lines(text: &str, markdown: bool) -> Vec<String> {
    let mut out: Vec<String> = Vec::new();
    let mut fenced = false;
    for line in text.lines() {
        fenced ^= line.starts_with("```");
        let pieces = line.split('`').skip(1).step_by(2);
        let code = line.trim_start_matches([' ', '$']);
        let code = code.strip_prefix("cargo run -- ").map(|c| format!("equipod {c}")).unwrap_or(code.into());
        let whole = (markdown && (fenced || line.starts_with("    "))).then_some(code.as_str());
        let found = pieces.chain(whole).filter_map(|c| c.strip_prefix("equipod "));
        out.extend(found.filter(|c| !c.contains('{')).map(str::to_string));
    }
    out
}

fn files(folder: &Path, out: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files(&path, out);
        } else if path
            .extension()
            .is_some_and(|e| ["md", "rs", "toml", "py", "js", "html", "yml"].iter().any(|x| e == *x))
        {
            out.push(path);
        }
    }
}

#[test]
fn every_command_line_in_the_texts_is_one_that_exists() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut read: Vec<PathBuf> = ["README.md", "CONTRIBUTING.md"].map(|f| root.join(f)).into();
    for folder in ["docs", "designs", "examples", "src", "tests"] {
        files(&root.join(folder), &mut read);
    }
    // these have wrong lines on purpose
    read.retain(|p| !p.ends_with("src/app/cli/guide/tests.rs") && !p.ends_with("tests/it/cli_guide.rs"));
    read.retain(|p| !p.components().any(|c| c.as_os_str() == "target"));
    let (mut checked, mut faults) = (0, Vec::new());
    for path in read {
        let markdown = path.extension().is_some_and(|e| e == "md");
        for line in command_lines(&std::fs::read_to_string(&path).unwrap_or_default(), markdown) {
            checked += 1;
            if let Some(why) = fault(&words(&line)) {
                faults.push(format!("{}: equipod {line}: {why}", path.strip_prefix(root).unwrap().display()));
            }
        }
    }
    assert!(faults.is_empty(), "{} of {checked}:\n{}", faults.len(), faults.join("\n"));
    assert!(checked > 150, "{checked}: the texts are not read");
    // it finds commands and options that do not exist
    for wrong in [
        "family DESIGN",
        "equivalents familly DESIGN",
        "fk DESIGN --gap 1",
        "fk a.toml b.toml",
        "plot --help nothing",
    ] {
        assert!(fault(&words(wrong)).is_some(), "{wrong}");
    }
    for right in [
        "",
        "fk DESIGN --lengths L1,..,L6",
        "plot FIGURE ..",
        "--json optimize DESIGN",
        "equivalents",
        "COMMAND --help",
    ] {
        assert!(fault(&words(right)).is_none(), "{right}: {:?}", fault(&words(right)));
    }
}
