//! Every option of `optimize` and `explore` changes the result or is refused with a reason, for both searches.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

use crate::octahedral::at_home;

/// The lines that turn a problem into a search under requirements.
const REQUIRED: &str = "[hardware]
leg_length = [9.0, 18.0]
[optimize]
variables = [\"symmetric_offsets\", \"home_height\"]
";
const DRIVES: &str = "name,stroke_mm,retracted_length_mm\ngood,9,9\n";

fn run(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_equipod")).current_dir(folder).args(args).output().unwrap()
}

/// The options in the help of a command, without those that every command has for the way it speaks.
fn options(command: &str) -> BTreeSet<String> {
    let help = String::from_utf8(run(Path::new("."), &[command, "--help"]).stdout).unwrap();
    let lines = help.lines().map(str::trim_start).filter(|l| l.starts_with('-'));
    let long = lines.filter_map(|l| l.split_whitespace().find_map(|w| w.strip_prefix("--")));
    let speech = ["help", "version", "json", "quiet"];
    // a line of a sentence may begin with an option too
    let option = |w: &str| w.trim_end_matches([',', '`', '.']).to_owned();
    long.map(option).filter(|w| !speech.contains(&w.as_str())).collect()
}

/// The answer without the times and files that differ from run to run.
fn answer(out: &Output) -> Value {
    serde_json::from_slice(&out.stdout).unwrap_or_else(|e| {
        panic!("{e}: {} {}", String::from_utf8_lossy(&out.stdout), String::from_utf8_lossy(&out.stderr))
    })
}

fn refused(d: &Value) -> bool {
    let error = &d["error"];
    error["code"] == "usage::no_effect"
        && error["message"].as_str().is_some_and(|m| m.contains("has no effect"))
}

/// The required effect of an option.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Effect {
    /// The answer is another one.
    Answer,
    /// A file or a folder of this name is written.
    File(&'static str),
    /// The answer is the same, as the help says.
    Same,
    /// It is refused with a reason.
    Refused,
}
use Effect::{Answer, File, Refused, Same};

/// An option with its value, and its effects on the search for offsets and on the search under requirements.
type Row = (&'static str, &'static [&'static str], [Effect; 2]);

const OPTIMIZE: [Row; 11] = [
    ("output", &["-o", "out.toml"], [File("out.toml"); 2]),
    ("extension", &["--extension", "0.1"], [Answer; 2]),
    ("survey", &["--survey"], [Answer, Refused]),
    ("gap", &["--gap", "0.2"], [Answer, Refused]),
    ("history", &["--history", "steps.csv"], [File("steps.csv"); 2]),
    ("candidates", &["--candidates", "list"], [Refused, File("list")]),
    ("drives", &["--drives", "drives.csv"], [Answer; 2]),
    ("threads", &["--threads", "1"], [Same; 2]),
    ("time-limit", &["--time-limit", "0.01"], [Answer; 2]),
    ("seed", &["--seed", "5"], [Answer; 2]),
    // no other row is about a design whose offsets are not chosen
    ("extension", &["--extension", "0.1"], [Answer, Refused]),
];

#[test]
#[ignore = "evidence"]
fn every_option_of_optimize_changes_the_answer_or_is_refused() {
    let named: BTreeSet<String> = OPTIMIZE.iter().map(|row| row.0.to_owned()).collect();
    assert_eq!(options("optimize"), named, "an option without a row, or a row without an option");
    let last = OPTIMIZE.len() - 1;
    for kind in 0..2 {
        let design = if kind == 0 { at_home() } else { at_home() + REQUIRED };
        let heights = design.replace("\"symmetric_offsets\", ", "");
        let base = {
            let folder = tempfile::tempdir().unwrap();
            std::fs::write(folder.path().join("in.toml"), &design).unwrap();
            answer(&run(folder.path(), &["optimize", "in.toml", "--json", "--extension", "0"]))
        };
        for (k, (name, typed, effects)) in OPTIMIZE.iter().enumerate() {
            let folder = tempfile::tempdir().unwrap();
            let text = if k == last { &heights } else { &design };
            std::fs::write(folder.path().join("in.toml"), text).unwrap();
            std::fs::write(folder.path().join("drives.csv"), DRIVES).unwrap();
            let mut args = vec!["optimize", "in.toml", "--json"];
            // one zone in place of 729, but where the option is about more than one
            if !["extension", "survey"].contains(name) {
                args.extend(["--extension", "0"]);
            }
            if *name == "survey" {
                args.extend(["--extension", "0.1"]);
            }
            args.extend(typed.iter().copied());
            let found = answer(&run(folder.path(), &args));
            let place = format!("{name} {kind}: {}", found["error"]);
            match effects[kind] {
                Answer => assert!(found != base && found["error"].is_null(), "{place}"),
                File(file) => {
                    assert!(found["error"].is_null() && folder.path().join(file).exists(), "{place}");
                }
                Same => assert_eq!(found, base, "{place}"),
                Refused => assert!(refused(&found), "{place}"),
            }
        }
    }
}

#[test]
#[ignore = "evidence"]
fn every_option_of_explore_changes_the_answer_or_is_refused() {
    let named: BTreeSet<String> =
        ["output", "samples", "extension", "drives", "seed", "time-limit"].map(str::to_owned).into();
    assert_eq!(options("explore"), named, "an option without a case, or a case without an option");
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("drives.csv"), DRIVES).unwrap();
    let explored = |design: &str, more: &[&str]| {
        std::fs::write(folder.path().join("in.toml"), design).unwrap();
        let args = [&["explore", "in.toml", "-o", "out", "--json"], more].concat();
        answer(&run(folder.path(), &args))
    };
    // refusals come before the search
    let required =
        |variables: &str| (at_home() + REQUIRED).replace("\"symmetric_offsets\", \"home_height\"", variables);
    let heights = required("\"home_height\"");
    assert!(refused(&explored(&heights, &["--extension", "0.1"])));
    let bounded = format!("{}offset_bounds = [0, 1]\n", required("\"symmetric_offsets\""));
    assert!(refused(&explored(&bounded, &["--extension", "0.1"])));
    assert!(refused(&explored(&required("\"triangle_sizes\""), &["--samples", "2"])));
    let general = std::fs::read_to_string("designs/general-6-6.toml").unwrap();
    assert!(refused(&explored(&general, &["--drives", "drives.csv"])));
    let with_table = general + "[hardware]\ndrives = \"drives.csv\"\n";
    assert_eq!(explored(&with_table, &[])["error"]["code"], "drives::not_chosen");
    // a requested option changes the answer
    let few = ["--extension", "0", "--samples", "1"];
    let base = explored(&at_home(), &few);
    assert_eq!(base["verify"]["sample_count"], 1);
    for more in [
        &["--extension", "0", "--samples", "2"][..],
        &["--extension", "0", "--samples", "1", "--seed", "5"],
        &["--extension", "0", "--samples", "1", "--drives", "drives.csv"],
        &["--extension", "0", "--samples", "1", "--time-limit", "0.01"],
    ] {
        let found = explored(&at_home(), more);
        assert!(found["error"].is_null() && found != base, "{more:?}: {}", found["error"]);
    }
}
