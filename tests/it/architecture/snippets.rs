//! The scanner on small sources: it must see what is there, and nothing in comments or strings.

use super::dependencies;
use super::rules::violations;
use super::scan::{Scan, blank};
use super::table::table;

fn paths(source: &str, module: &[&str]) -> Vec<String> {
    Scan::of(source, module, true).paths
}

fn judged(file: &str, source: &str) -> Vec<String> {
    violations(&table(), &dependencies(), file, source)
}

#[test]
fn groups_renamings_and_relative_paths_are_resolved() {
    let source =
        "use crate::{fk::{Octic as O, solver}, geom::*};\nuse super::super::synthesis::leg_map;\nuse faer;";
    assert_eq!(
        paths(source, &["solve", "certify"]),
        ["crate::fk::Octic", "crate::fk::solver", "crate::geom::*", "crate::synthesis::leg_map", "faer"]
    );
    let inline = "mod inner { fn f() { super::g(); } mod deep { use super::super::h; } } use self::k::l;";
    assert_eq!(paths(inline, &["fk"]), ["crate::fk::g", "crate::fk::h", "crate::fk::k::l"]);
    assert_eq!(paths("let x = crate::fk::solver(None)?.y::<crate::poly::P>();", &[]).len(), 2);
}

#[test]
fn comments_strings_and_characters_hide_nothing_and_show_nothing() {
    let source = r##"
        // use crate::synthesis::a;
        /* use crate::synthesis::b; /* nested */ use crate::synthesis::c; */
        /// crate::synthesis::d
        let s = "crate::synthesis::e \" crate::synthesis::f";
        let r = r#"crate::synthesis::g " crate::synthesis::h"#;
        let (q, l): (char, &'static str) = ('"', "x"); use crate::synthesis::seen; let c = '\''; crate::geom::too();
    "##;
    assert_eq!(paths(source, &["fk"]), ["crate::synthesis::seen", "crate::geom::too"]);
    assert_eq!(blank("a/*b*/c'd'e"), "a c e");
}

#[test]
fn forbidden_edges_are_found() {
    for (file, source) in [
        ("fk/octic.rs", "use crate::synthesis::leg_map;"),
        ("fk/octic.rs", "use crate::{geom::Pose, offsets::optimize};"),
        ("fk/deep/er.rs", "use super::super::super::synthesis::leg_map;"),
        ("synthesis/leg_map.rs", "fn f() { crate::fk::solver(None); }"),
        ("offsets/scp.rs", "#[cfg(test)] mod tests { use crate::solve::certify::certify; }"),
        ("solve/certify/mod.rs", "use crate::solve::homotopy::GENERIC_COUNT;"),
        ("solve/certify/mod.rs", "use super::Frame;"),
        ("solve/certify/a/b.rs", "use super::super::super::sections::split;"),
        ("solve/homotopy/paths.rs", "use crate::solve::certify::Certifier;"),
        ("num/ball.rs", "use crate::geom::Pose;"),
        ("brand_new.rs", ""),
    ] {
        assert_eq!(judged(file, source).len(), 1, "{file}: {source}");
    }
}

#[test]
fn crates_printing_and_files_are_found_where_they_do_not_belong() {
    for (file, source) in [
        ("num/interval.rs", "use faer::Mat;"),
        ("offsets/scp.rs", "let x = clarabel::solver::Solver::new();"),
        ("synthesis/family.rs", "#[derive(serde::Serialize)] struct A;"),
        ("design/save.rs", "use clap::Args;"),
        ("fk/mod.rs", "fn f() { println!(\"\"); }"),
        ("fk/mod.rs", "use std::{fmt, fs};"),
        ("offsets/search.rs", "let t = std::env::var(\"X\");"),
        ("entrance/solving.rs", "fn f() { let _ = std::fs::read_to_string(\"a\"); }"),
        ("cli/mod.rs", "static mut COUNT: u32 = 0;"),
    ] {
        assert_eq!(judged(file, source).len(), 1, "{file}: {source}");
    }
}

#[test]
fn what_is_allowed_passes() {
    for (file, source) in [
        ("num/dense.rs", "use faer::Mat;"),
        ("offsets/mod.rs", "pub use crate::num::conic::SolverFailure;"),
        ("num/conic.rs", "use clarabel::solver::DefaultSolver;"),
        ("fk/octic.rs", "use super::collect::collect; use crate::solve::{certify::certify, Frame};"),
        ("solve/mod.rs", "pub mod certify; pub use self::certify::certify;"),
        ("entrance/files.rs", "fn f() { let _ = std::fs::read_to_string(\"a\"); }"),
        ("cli/files.rs", "use std::fs; fn f() { eprintln!(); std::process::exit(1) }"),
        (
            "fk/octic.rs",
            "#[cfg(test)] mod tests { fn f() { println!(); } } fn g(x: bool) -> bool { x != true }",
        ),
        ("main.rs", "fn main() -> std::process::ExitCode { equipod::cli::main(std::env::args_os()) }"),
    ] {
        assert!(judged(file, source).is_empty(), "{file}: {:?}", judged(file, source));
    }
}
