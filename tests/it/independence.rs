//! Agreement is evidence only between computations that share no code: poses stay apart from leg maps, and certificates
//! from solvers.

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

/// The packages whose packages the package of a package sees, directly or through another one.
fn seen(package: &str) -> BTreeSet<String> {
    let manifest = std::fs::read_to_string(file(package).join("Cargo.toml")).unwrap();
    let (_, dependencies) = manifest.split_once("[dependencies]").unwrap();
    let (dependencies, _) = dependencies.split_once("\n[").unwrap();
    let names = dependencies.lines().filter_map(|line| line.split(['.', ' ']).next());
    let packages = names.filter(|name| !name.is_empty() && file(name).is_dir());
    packages.flat_map(|name| seen(name).into_iter().chain([name.to_owned()])).collect()
}

/// The compiler refuses names that a package does not list, so that its manifest decides.
#[test]
fn poses_and_leg_maps_do_not_reach_each_other() {
    let below = BTreeSet::from(["num", "platform"].map(str::to_owned));
    assert_eq!(seen("fk"), below);
    assert_eq!(seen("synthesis"), below);
    assert!(seen("verify").is_superset(&["fk", "synthesis"].map(str::to_owned).into()));
}

/// The order of `docs/architecture.md`. Kernels know no design files.
#[test]
fn rooms_see_only_rooms_above_them() {
    let packages = ["num", "platform", "fk", "synthesis", "verify", "machine", "files", "optimize"];
    for (k, package) in packages.into_iter().enumerate() {
        let seen = seen(package);
        assert!(seen.iter().all(|name| packages[..k].contains(&name.as_str())), "{package}: {seen:?}");
        assert!(!seen.contains("files"), "{package} is a kernel");
    }
}

#[test]
fn certificates_name_nothing_that_finds_roots() {
    let (all, certify) = (source("fk/solve/mod").replace("mod ", "use "), source("fk/solve/certify"));
    let mut solvers = names(&all);
    for other in ["", "use", "certify", "pub", "crate", "feature", "lab", "cfg"] {
        solvers.remove(other);
    }
    // nothing beside its own folder, nor elsewhere in its package
    let apart = |code: &str| {
        let code = code.replace("crate::solve::certify", "certify");
        !code.contains("crate::") && names(&code).is_disjoint(&solvers)
    };
    assert!(solvers.contains("homotopy") && apart(&certify));
    for planted in ["use super::super::homotopy::paths;", "use super::split;", "crate::solver(None)"] {
        assert!(!apart(&format!("{certify}{planted}")), "{planted}");
    }
}
