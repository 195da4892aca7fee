//! The licence notices name every crate that is compiled in.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

const NOTICES: &str = include_str!("../../THIRD-PARTY-LICENCES.txt");

/// Crates in the list at the head of the notices, each with its version and whether it is in the pages too.
fn listed() -> BTreeMap<(String, String), bool> {
    let head = NOTICES.split("\n====").next().unwrap();
    let lines = head.lines().filter(|l| l.starts_with("  ") || l.starts_with("* "));
    let entry = |line: &str| {
        let (name, version) = line[2..].split_once(':').unwrap().0.split_once(' ').unwrap();
        ((name.to_string(), version.to_string()), line.starts_with('*'))
    };
    lines.map(entry).collect()
}

/// Names of the crates that Cargo compiles into the program, by its own account: what runs at build time or in tests is not among them.
/// Other systems and features are left to `.ci/licences --check`, because their crates need not be on this machine.
fn compiled() -> BTreeSet<String> {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.current_dir(env!("CARGO_MANIFEST_DIR"));
    cargo.args([
        "tree",
        "--offline",
        "--edges",
        "normal,no-proc-macro",
        "--prefix",
        "none",
        "--format",
        "{p}",
    ]);
    let out = cargo.output().unwrap();
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    let text = String::from_utf8(out.stdout).unwrap();
    let code = text.lines().filter(|l| !l.is_empty() && !l.contains("(proc-macro)"));
    let mut names: BTreeSet<String> = code.map(|l| l.split(' ').next().unwrap().to_string()).collect();
    assert!(names.remove("equipod") && names.len() > 20, "{names:?}");
    names
}

#[test]
fn the_program_prints_the_notices() {
    let equipod = |words: &[&str]| Command::new(env!("CARGO_BIN_EXE_equipod")).args(words).output().unwrap();
    let out = equipod(&["--licences"]);
    assert_eq!((out.status.code(), String::from_utf8(out.stdout).unwrap()), (Some(0), NOTICES.to_string()));
    // like --version it is asked without a command
    let refused = equipod(&["--licences", "design", "presets"]);
    assert_eq!((refused.status.code(), refused.stdout.len()), (Some(2), 0));
}

#[test]
fn every_crate_that_is_compiled_in_has_its_licence_in_the_notices() {
    let listed = listed();
    let names = |page: bool| -> BTreeSet<String> {
        listed.iter().filter(|(_, in_page)| **in_page || !page).map(|((name, _), _)| name.clone()).collect()
    };
    let lacking: Vec<String> = compiled().difference(&names(false)).cloned().collect();
    assert!(lacking.is_empty(), "run .ci/licences: {lacking:?}");
    let in_pages = names(true);
    for direct in ["nalgebra", "clarabel", "num-bigint", "serde_json", "sha2", "toml"] {
        assert!(in_pages.contains(direct), "{direct} is in the core of the page");
    }
    assert!(!in_pages.contains("clap"), "the page has no command line");
    // what runs in tests only is not shipped
    assert!(!names(false).contains("proptest") && !names(false).contains("divan"));

    // every one of them stands over a text
    let rule = "=".repeat(100);
    let parts: Vec<&str> = NOTICES.split(&rule).collect();
    let mut covered = BTreeSet::new();
    for part in parts[1..].chunks(2) {
        let [heads, text] = part else { panic!("a head without a text") };
        assert!(text.trim().len() > 300, "{heads}: {text}");
        covered.extend(heads.trim().split(", ").map(str::to_string));
    }
    for (name, version) in listed.keys() {
        assert!(covered.contains(&format!("{name} {version}")), "{name} {version} has no text");
    }
    assert!(covered.contains("the Rust standard library"));
}
