//! Agreement is evidence only between computations that share no code: poses stay apart from leg maps, and certificates from solvers.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The sources of a module without lines of comments.
fn code(module: &Path) -> String {
    let text = if module.is_dir() {
        std::fs::read_dir(module).unwrap().map(|e| code(&e.unwrap().path())).collect()
    } else {
        std::fs::read_to_string(module.with_extension("rs")).unwrap_or_default()
    };
    let lines: Vec<&str> = text.lines().filter(|l| !l.trim_start().starts_with("//")).collect();
    lines.join("\n")
}

fn file(module: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(module)
}

fn source(module: &str) -> String {
    code(&file(module))
}

/// The words of paths and of `use` statements.
fn names(code: &str) -> BTreeSet<&str> {
    let word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let uses = code.split(';').filter_map(|statement| statement.rfind("use ").map(|at| &statement[at..]));
    let paths = code.split(|c| !word(c) && c != ':').filter(|path| path.contains("::"));
    uses.chain(paths).flat_map(|text| text.split(move |c| !word(c))).collect()
}

/// The modules of the crate that a source names, as far as a room and a part of it: `fk`, `machine/reach`.
fn named(code: &str) -> impl Iterator<Item = String> {
    code.split("crate::").skip(1).map(|rest| {
        let mut path = rest.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
        let (room, part) = (path.next().unwrap_or_default(), path.nth(1).unwrap_or_default());
        let within = format!("{room}/{part}");
        if !part.is_empty() && (file(&within).is_dir() || file(&within).with_extension("rs").is_file()) {
            within
        } else {
            room.to_owned()
        }
    })
}

/// Whether a source names none of the rooms, and no module of the crate that names one of them, however indirectly.
fn apart(code: &str, rooms: &[&str]) -> bool {
    let (mut open, mut known) = (vec![code.to_owned()], BTreeSet::new());
    while let Some(code) = open.pop() {
        open.extend(named(&code).filter(|m| known.insert(m.clone())).map(|m| source(&m)).collect::<Vec<_>>());
    }
    let (own, of_rooms) =
        (names(code), |m: &String| rooms.contains(&m.split('/').next().unwrap_or_default()));
    !known.iter().any(of_rooms) && !rooms.iter().any(|m| own.contains(m))
}

#[test]
fn poses_and_leg_maps_do_not_reach_each_other() {
    let (poses, maps) = (["fk", "verify"], ["synthesis", "optimize", "verify"]);
    assert!(apart(&source("fk"), &maps));
    assert!(["synthesis", "optimize"].iter().all(|room| apart(&source(room), &poses)));
    assert!(!apart(&source("fk"), &["platform"]) && !apart(&source("optimize"), &["machine"]));
    let through_another = "let found = crate::machine::manufacture::trials();";
    assert!(!apart(through_another, &maps) && !apart(through_another, &poses));
    assert!(!apart("use super::super::synthesis::leg_map;", &maps));
    assert!(!apart("use super::{num, optimize};", &maps));
}

#[test]
fn certificates_name_nothing_that_finds_roots() {
    let (all, certify) = (source("fk/solve/mod").replace("mod ", "use "), source("fk/solve/certify"));
    let mut solvers = names(&all);
    solvers.extend(["solve", "fk"]);
    for other in ["", "use", "certify", "pub", "crate", "feature", "lab", "cfg"] {
        solvers.remove(other);
    }
    let apart =
        |code: &str| names(&code.replace("crate::fk::solve::certify", "certify")).is_disjoint(&solvers);
    assert!(solvers.contains("homotopy") && apart(&certify));
    for planted in ["use super::super::homotopy::paths;", "use super::split;", "crate::fk::solver(None)"] {
        assert!(!apart(&format!("{certify}{planted}")), "{planted}");
    }
}
