//! Agreement is evidence only between computations that share no code: poses stay apart from leg maps, and certificates from solvers.

use std::collections::BTreeSet;
use std::path::Path;

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

fn source(module: &str) -> String {
    code(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(module))
}

/// The words of paths and of `use` statements.
fn names(code: &str) -> BTreeSet<&str> {
    let word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let uses = code.split(';').filter_map(|statement| statement.rfind("use ").map(|at| &statement[at..]));
    let paths = code.split(|c| !word(c) && c != ':').filter(|path| path.contains("::"));
    uses.chain(paths).flat_map(|text| text.split(move |c| !word(c))).collect()
}

/// Whether a source names none of the modules, and no module of the crate that names one of them, however indirectly.
fn apart(code: &str, modules: &[&str]) -> bool {
    let (mut open, mut known) = (vec![code.to_owned()], BTreeSet::new());
    while let Some(code) = open.pop() {
        let named = code.split("crate::").skip(1).filter_map(|rest| rest.split("::").next());
        open.extend(named.filter(|m| known.insert((*m).to_owned())).map(source).collect::<Vec<_>>());
    }
    let own = names(code);
    modules.iter().all(|m| !known.contains(*m) && !own.contains(m))
}

#[test]
fn poses_and_leg_maps_do_not_reach_each_other() {
    let (poses, maps) = (["fk", "solve"], ["synthesis", "singularity", "offsets", "dimensional"]);
    assert!(poses.iter().all(|module| apart(&source(module), &maps)));
    assert!(maps.iter().all(|module| apart(&source(module), &poses)));
    assert!(!apart(&source("fk"), &["distance"]) && !apart(&source("offsets"), &["manipulator"]));
    let through_another = "let found = crate::equivalence::verify();";
    assert!(!apart(through_another, &maps) && !apart(through_another, &poses));
    assert!(!apart("use super::super::synthesis::leg_map;", &maps));
    assert!(!apart("use super::{geom, offsets};", &maps));
}

#[test]
fn certificates_name_nothing_that_finds_roots() {
    let (all, certify) = (source("solve/mod").replace("mod ", "use "), source("solve/certify"));
    let mut solvers = names(&all);
    solvers.extend(["solve", "fk"]);
    for other in ["", "use", "certify", "pub", "crate", "feature", "lab", "cfg"] {
        solvers.remove(other);
    }
    let apart = |code: &str| names(&code.replace("crate::solve::certify", "certify")).is_disjoint(&solvers);
    assert!(solvers.contains("homotopy") && apart(&certify));
    for planted in ["use super::super::homotopy::paths;", "use super::split;", "crate::fk::solver(None)"] {
        assert!(!apart(&format!("{certify}{planted}")), "{planted}");
    }
}
