//! The user's files are kept, tested for every command with an output as listed by the command line itself.

use std::any::TypeId;

use clap::{Command, CommandFactory};

use super::*;
use crate::app::cli::args::Cli;

const DESIGN: &str = include_str!("../../../../designs/rbt-octahedral.toml");

/// A folder of its own for a test.
fn folder(name: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("equipod-files-{name}-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    path
}

/// Every command and figure with the words that lead to it.
fn commands() -> Vec<(Vec<String>, Command)> {
    fn below(words: &[String], command: &Command, out: &mut Vec<(Vec<String>, Command)>) {
        for sub in command.get_subcommands().filter(|c| c.get_name() != "help") {
            let words: Vec<String> = words.iter().cloned().chain([sub.get_name().to_owned()]).collect();
            below(&words, sub, out);
            out.push((words, sub.clone()));
        }
    }
    let mut all = Cli::command();
    all.build();
    let mut out = Vec::new();
    below(&[], &all, &mut out);
    out.retain(|(_, command)| !command.has_subcommands());
    out
}

/// The arguments that a command needs beside its files.
fn needed(words: &[String], output: &str) -> Vec<&'static str> {
    match (words.iter().map(String::as_str).collect::<Vec<_>>().as_slice(), output) {
        (["equivalents", "family"], "output") => {
            vec!["--pattern", "S123456", "--offsets", "0.1,0.1,0.1,0.1,0.1,0.1"]
        }
        (["singular", "poses"], "csv" | "path_svg") => vec!["--path", "home"],
        (["export"], _) => vec!["--to", "csv"],
        (["build", "tolerances"], "map") => vec!["--bound", "0.1,0.1"],
        (["build", "round"], _) => vec!["--grid", "0.5"],
        (["equivalents", "map"] | ["verify"], "output") => vec!["--align"],
        (["sweep", "best"], _) => vec!["--by", "conditioning"],
        (["sweep", "design"], _) => vec!["--candidate", "0"],
        (["sweep", "script"], "output") => vec!["--folder", "parts"],
        (["plot", "sweep"], _) => vec!["--columns", "conditioning,det_a"],
        (["plot", "locus"], _) => vec!["--leg", "1", "--from", "1", "--to", "2"],
        _ => vec![],
    }
}

/// Outputs of commands that read no file.
const WITHOUT_INPUT: [&str; 4] = ["bench", "shell man", "design presets", "new"];
/// Options with the path of an input.
const READ: [&str; 7] = ["check", "core", "drives", "points", "poses", "sheet", "trajectory"];

#[test]
fn no_command_writes_over_its_input() {
    let folder = folder("inputs");
    let design = folder.join("d.toml");
    std::fs::write(&design, DESIGN).unwrap();
    std::fs::create_dir(folder.join("below")).unwrap();
    let mut aliases = vec![design.clone(), folder.join("below/../d.toml"), folder.join("./d.toml")];
    if std::fs::hard_link(&design, folder.join("hard.toml")).is_ok() {
        aliases.push(folder.join("hard.toml"));
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("d.toml", folder.join("soft.toml")).unwrap();
        std::os::unix::fs::symlink(".", folder.join("loop")).unwrap();
        aliases.extend([folder.join("soft.toml"), folder.join("loop/d.toml")]);
    }
    if folder.join("D.TOML").exists() {
        aliases.push(folder.join("D.TOML")); // a file system that takes both for one
    }
    let mut checked = 0;
    for (words, command) in commands() {
        let is = |arg: &clap::Arg, id: TypeId| arg.get_value_parser().type_id() == id;
        for arg in command.get_arguments() {
            let name = arg.get_id().as_str();
            let path = is(arg, TypeId::of::<PathBuf>()) && !arg.is_positional();
            assert!(!path || READ.contains(&name), "{words:?} --{name}: an OutputPath, or read?");
        }
        for output in command.get_arguments().filter(|a| is(a, TypeId::of::<OutputPath>())) {
            let name = output.get_id().as_str();
            if WITHOUT_INPUT.contains(&words.join(" ").as_str()) {
                continue;
            }
            let positional = command.get_positionals().filter(|a| is(a, TypeId::of::<PathBuf>()));
            let inputs: Vec<PathBuf> = positional.map(|_| design.clone()).collect();
            assert!(!inputs.is_empty(), "{words:?} has no input: belongs to WITHOUT_INPUT");
            for alias in &aliases {
                let flag = format!("--{}", output.get_long().unwrap());
                let line = ["equipod".to_owned()].into_iter().chain(words.iter().cloned());
                let line = line.map(OsString::from).chain(inputs.iter().map(|p| p.clone().into_os_string()));
                let line = line.chain(needed(&words, name).into_iter().map(OsString::from));
                let line: Vec<OsString> = line.chain([flag.into(), alias.clone().into_os_string()]).collect();
                let matches =
                    Cli::command().try_get_matches_from(line).unwrap_or_else(|e| panic!("{words:?}: {e}"));
                let refused = check_arguments(&matches, false).unwrap_err();
                assert_eq!(refused.code, "file::overwrites_input", "{words:?} --{name} {}", alias.display());
                checked += 1;
            }
        }
    }
    assert!(checked > 100, "{checked} refusals: the list of commands is not read");
    assert_eq!(std::fs::read_to_string(&design).unwrap(), DESIGN);
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn what_was_read_is_not_written_whatever_it_is_called() {
    let folder = folder("read");
    let (table, hard, other) = (folder.join("table.csv"), folder.join("hard.csv"), folder.join("other.csv"));
    std::fs::write(&table, "1,2,3").unwrap();
    std::fs::write(&other, "old").unwrap();
    std::fs::hard_link(&table, &hard).unwrap();
    begin();
    read_text(&table).unwrap();
    for path in [&table, &hard] {
        assert_eq!(write_text(path, "new").unwrap_err().code, "file::overwrites_input");
    }
    // another file is replaced, once
    write_text(&other, "new").unwrap();
    assert_eq!(write_text(&other, "newer").unwrap_err().code, "file::written_twice");
    assert_eq!(std::fs::read_to_string(&other).unwrap(), "new");
    begin();
    write_text(&table, "new").unwrap();
    // only the name was replaced: the other link still holds the old text
    assert_eq!(std::fs::read_to_string(&hard).unwrap(), "1,2,3");
    let left: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert_eq!(left.len(), 3, "parts are left: {left:?}");
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_design_gives_way_to_a_design_only() {
    let folder = folder("kinds");
    let design = folder.join("mine.toml");
    std::fs::write(&design, DESIGN).unwrap();
    begin();
    for text in ["<svg/>", "a,b\n", "{\"schema_version\":1}", ""] {
        assert_eq!(write_text(&design, text).unwrap_err().code, "file::overwrites_design", "{text}");
    }
    write_text(&design, &DESIGN.replace("octahedral 12-6", "another")).unwrap();
    begin();
    let protected = folder.join("protected.svg");
    std::fs::write(&protected, "<svg/>").unwrap();
    let mut permissions = protected.metadata().unwrap().permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(&protected, permissions).unwrap();
    assert_eq!(write_text(&protected, "x").unwrap_err().code, "file::not_writable");
    assert_eq!(write_text(&folder, "x").unwrap_err().code, "file::not_writable");
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn two_outputs_are_two_files() {
    let line = [
        "equipod", "plot", "locus", "d.toml", "--leg", "1", "--from", "1", "--to", "2", "-o", "x", "--csv",
        "./x",
    ];
    let matches = Cli::command().try_get_matches_from(line).unwrap();
    assert_eq!(check_arguments(&matches, false).unwrap_err().code, "file::written_twice");
}
