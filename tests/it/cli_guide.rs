//! The help by jobs as a process: every example of it runs, and a wrong word gets a suggestion.

use std::path::Path;
use std::process::{Command, Output};

use super::cli_frame::{document, equipod};
use super::tasks::copy_folder;

fn text(args: &[&str]) -> String {
    String::from_utf8(equipod(args).stdout).unwrap()
}

/// The commands that stand in the help of the program, and the figures of `plot`.
fn commands() -> Vec<String> {
    let named = |help: &str| -> Vec<String> {
        let lines = help.split("Options:").next().unwrap().lines().filter_map(|l| l.strip_prefix("  "));
        let lines = lines.filter(|l| !l.starts_with([' ', '-']));
        lines.map(|l| l.split("  ").next().unwrap().to_string()).collect()
    };
    let mut all = named(&text(&["--help"]));
    all.retain(|c| c != "plot FIGURE");
    all.extend(named(&text(&["plot", "--help"])));
    all
}

/// Command lines under "Example" or "Examples" of a help text.
fn examples(help: &str) -> Vec<String> {
    let below = help.split("Example").nth(1).unwrap_or_default();
    below.lines().filter_map(|l| l.trim().strip_prefix("equipod ")).map(str::to_string).collect()
}

/// A front as `optimize` writes it: finding one takes minutes.
const FRONT: &str = r#"{"front":[{"objectives":[{"name":"worst_conditioning","value":0.2,"unit":""},{"name":"stroke","value":30,"unit":"mm"}],"design":{"name":"D"}},
    {"objectives":[{"name":"worst_conditioning","value":0.3,"unit":""},{"name":"stroke","value":50,"unit":"mm"}],"design":{"name":"D"}}],"seed":7}"#;
/// Examples that take long without optimisation; only the report needs their files.
const LONG: [&str; 2] = ["explore", "optimize"];

#[test]
#[ignore = "evidence"]
fn every_example_of_the_help_runs() {
    let folder = tempfile::tempdir().unwrap();
    copy_folder(Path::new("designs"), &folder.path().join("designs"));
    std::fs::write(folder.path().join("front.json"), FRONT).unwrap();
    copy_folder(Path::new("designs/worked"), &folder.path().join("out"));
    let run = |line: &str| -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_equipod"));
        command.current_dir(folder.path()).args(line.split(' ')).output().unwrap()
    };
    let commands = commands();
    assert!(commands.len() > 30, "{commands:?}");
    for command in commands {
        let words: Vec<&str> = command.split(' ').chain(["--help"]).collect();
        let found = examples(&text(&words));
        assert!(!found.is_empty(), "{command} has no example");
        for line in found.iter().filter(|_| !LONG.contains(&command.as_str())) {
            let out = run(line);
            let code = out.status.code().unwrap();
            // 1 and 3 are answers
            assert!([0, 1, 3].contains(&code), "{line}: {}", String::from_utf8_lossy(&out.stderr));
            if let Some(file) = line.split(" -o ").nth(1) {
                assert!(folder.path().join(file).exists(), "{line} wrote nothing");
            }
        }
    }
}

#[test]
fn a_wrong_word_is_told_what_was_meant() {
    for (line, message, help) in [
        (
            "family designs/rbt-octahedral.toml",
            "`equipod family` is not a command",
            "did you mean `equipod equivalents family`?",
        ),
        (
            "singularities x.toml",
            "`equipod singularities` is not a command",
            "did you mean `equipod singular poses`?",
        ),
        (
            "equivalents singularities",
            "`equipod equivalents singularities` is not a command",
            "`equipod singular poses`",
        ),
        (
            "topologies",
            "`equipod topologies`",
            "`equipod equivalents topologies` or `equipod plot topologies`",
        ),
        (
            "singular x.toml",
            "`equipod singular` needs one of its commands before `x.toml`",
            "poses, locus, motion",
        ),
        ("frobnicate", "`equipod frobnicate` is not a command", "`equipod --help` lists the commands by job"),
        (
            "equivalents",
            "`equipod equivalents` needs one of its commands",
            "family, components, topologies, move, nearest, map",
        ),
        ("fk x.toml --length 1,2", "unexpected argument '--length'", "did you mean `--lengths`?"),
        ("fk x.toml --gap 1", "unexpected argument '--gap'", "--gap is an option of `equipod optimize`"),
        ("optimize x.toml --out y", "unexpected argument '--out'", "did you mean `--output`?"),
        ("limits x.toml --pose home", "unexpected argument '--pose'", "did you mean `--at`?"),
        ("ik x.toml --at home", "unexpected argument '--at'", "did you mean `--pose`?"),
        ("export x.toml -o y --to linuxcnc", "invalid value 'linuxcnc'", "for linuxcnc: `--to c` ("),
        ("export x.toml -o y --to LinuxCNC", "invalid value 'LinuxCNC'", ") or `--to hal` ("),
        ("export x.toml -o y --to gazebo", "invalid value 'gazebo'", "for gazebo: `--to sdf` ("),
        ("export x.toml -o y --to stp", "invalid value 'stp'", "a similar value exists: 'step'"),
        ("export x.toml -o y --to word", "invalid value 'word'", "see `equipod export --help`"),
        ("fk", "required arguments were not provided", "see `equipod fk --help`"),
    ] {
        let words: Vec<&str> = line.split(' ').collect();
        let plain = equipod(&words);
        assert_eq!(plain.status.code(), Some(2), "{line}");
        let shown = String::from_utf8(plain.stderr).unwrap();
        assert!(shown.contains(message) && shown.contains(help), "{line}: {shown}");
        let error = document(&equipod(&[&["--json"], words.as_slice()].concat()))["error"].clone();
        assert_eq!(error["code"], "usage", "{line}");
        assert!(error["message"].as_str().unwrap().contains(message), "{line}: {error}");
        assert!(error["help"].as_str().unwrap().contains(help), "{line}: {error}");
    }
}

#[test]
fn an_option_without_effect_is_refused() {
    let octahedral = "designs/rbt-octahedral.toml";
    let free = "designs/rbt-griffis-duffy.toml";
    let more = "designs/worked/isolator-octahedral.toml";
    for (line, option) in [
        (format!("fk {octahedral} --threads 2"), "--threads"),
        (format!("fk {octahedral} --near home --threads 2"), "--threads"),
        (format!("optimize {more} --gap 0.1"), "--gap"),
        (format!("optimize {more} --survey"), "--survey"),
        (format!("optimize {more} --history x.csv"), "--history"),
        (format!("assess {more} --steps 3"), "--steps"),
        (format!("verify {octahedral} {octahedral} -o x.toml"), "--output"),
        (format!("equivalents map {octahedral} {octahedral} -o x.toml"), "--output"),
        (format!("equivalents move {octahedral} --move 1:1:0.1 --together"), "--together"),
        (format!("equivalents move {free} --search --no-crossing --workspace"), "--workspace"),
        (format!("build round {octahedral} --grid 1 --variant exact --keep 0.5"), "--keep"),
        (format!("export {octahedral} --to csv --mass 3 -o x"), "--mass"),
    ] {
        let error =
            document(&equipod(&line.split(' ').chain(["--json"]).collect::<Vec<_>>()))["error"].clone();
        assert_eq!(error["code"], "usage::no_effect", "{line}: {error}");
        assert!(
            error["message"].as_str().unwrap().starts_with(&format!("{option} has no effect here: ")),
            "{line}: {error}"
        );
        assert_eq!(error["help"], format!("leave out {option}"), "{line}");
    }
    assert!(!Path::new("x.toml").exists() && !Path::new("x.csv").exists() && !Path::new("x").exists());
}
