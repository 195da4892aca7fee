//! Existing files during a run: inputs stay as they are, whatever they are called.
//!
//! A test beside the code, over the list of commands, shows that every option with an output refuses an input among the
//! arguments. Here are the files that only a run finds out.

use std::path::{Path, PathBuf};

use super::cli_frame::{document, equipod};

const OCTAHEDRAL: &str = "designs/rbt-octahedral.toml";

/// Every file of a folder with its text.
fn contents(folder: &Path) -> Vec<(PathBuf, String)> {
    let entries = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path());
    let mut all: Vec<_> =
        entries.filter(|p| p.is_file()).map(|p| (p.clone(), std::fs::read_to_string(p).unwrap())).collect();
    all.sort();
    all
}

/// Runs a command that must be refused, and finds the folder unchanged.
fn refused(folder: &Path, args: &[&str], code: &str) {
    let before = contents(folder);
    let out = equipod(&[args, &["--json"]].concat());
    assert_eq!(out.status.code(), Some(2), "{args:?}: {}", String::from_utf8_lossy(&out.stderr));
    assert_eq!(document(&out)["error"]["code"], code, "{args:?}");
    assert_eq!(contents(folder), before, "{args:?}");
}

fn copy(folder: &Path, name: &str) -> String {
    let path = folder.join(name);
    std::fs::copy(OCTAHEDRAL, &path).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn a_folder_of_outputs_may_hold_the_input_but_not_in_the_place_of_one() {
    let temp = tempfile::tempdir().unwrap();
    let folder = temp.path().to_str().unwrap();
    let original = copy(temp.path(), "original.toml");
    refused(temp.path(), &["explore", &original, "-o", folder], "file::overwrites_input");
    // the same file by another name
    let mine = temp.path().join("mine.toml");
    std::fs::hard_link(&original, &mine).unwrap();
    refused(temp.path(), &["explore", mine.to_str().unwrap(), "-o", folder], "file::overwrites_input");
}

#[test]
fn a_report_is_not_written_over_what_it_reports() {
    let temp = tempfile::tempdir().unwrap();
    let folder = temp.path().to_str().unwrap();
    let design = copy(temp.path(), "d.toml");
    let table = temp.path().join("notes.txt");
    std::fs::write(&table, "mine").unwrap();
    refused(temp.path(), &["report", folder, "-o", &design], "file::overwrites_input");
    refused(temp.path(), &["report", folder, "-o", table.to_str().unwrap()], "file::overwrites_input");
    for _ in 0..2 {
        // the page of an earlier run gives way
        assert_eq!(equipod(&["report", folder]).status.code(), Some(0));
    }
}

#[test]
fn a_table_named_in_the_design_is_an_input_as_well() {
    let temp = tempfile::tempdir().unwrap();
    std::fs::write(temp.path().join("path.csv"), "3,5,15,0,0,0\n3,5,16,0,0,0\n").unwrap();
    let text = std::fs::read_to_string(OCTAHEDRAL).unwrap();
    let design = temp.path().join("d.toml");
    std::fs::write(&design, text.replace("[workspace]", "[workspace]\ntrajectory = \"path.csv\"")).unwrap();
    let (design, table) = (design.to_str().unwrap(), temp.path().join("path.csv"));
    refused(temp.path(), &["view", design, "-o", table.to_str().unwrap()], "file::overwrites_input");
}

#[test]
fn another_design_gives_way_to_a_design_only() {
    let temp = tempfile::tempdir().unwrap();
    let other = copy(temp.path(), "other.toml");
    refused(
        temp.path(),
        &["plot", "modes", "designs/dietmaier.toml", "-o", &other],
        "file::overwrites_design",
    );
    assert_eq!(
        equipod(&["design", "convert", "designs/dietmaier.toml", "-o", &other]).status.code(),
        Some(0)
    );
    assert!(
        std::fs::read_to_string(&other).unwrap().contains("dietmaier") || !temp.path().join("x").exists()
    );
    assert_eq!(contents(temp.path()).len(), 1, "no part is left");
}

/// Small files that once took gigabytes, or for ever.
#[test]
fn what_is_read_has_a_limit() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let step = write("assembly.step", "ISO-10303-21;\nDATA;\n#1=SPHERICAL_SURFACE('',#2,1.);\n");
    let attributes = " a=\"x\"".repeat(200_000);
    let xml = write("attributes.xml", &format!("<mujoco{attributes}/>"));
    let table = write("long.csv", &"1,2,3\n".repeat(1_000_000));
    for (path, code) in [(&step, "new::bad_step"), (&xml, "new::bad_mjcf"), (&table, "file::too_large")] {
        refused(folder.path(), &["new", "--points", path], code);
    }
    let picture = format!("<svg xmlns=\"http://www.w3.org/2000/svg\"><!--{}--></svg>", "x".repeat(13 << 20));
    for k in 0..6 {
        write(&format!("pictures/{k}.svg"), &picture);
    }
    refused(folder.path(), &["report", folder.path().join("pictures").to_str().unwrap()], "file::too_large");
    // a pipe that nobody writes into
    let sweep = folder.path().join("sweep");
    std::fs::create_dir(&sweep).unwrap();
    let made = std::process::Command::new("mkfifo").arg(sweep.join("sweep.json")).status();
    if made.is_ok_and(|status| status.success()) {
        let out = equipod(&["sweep", "status", sweep.to_str().unwrap(), "--json"]);
        assert_eq!(out.status.code(), Some(2), "{}", String::from_utf8_lossy(&out.stdout));
    }
}
