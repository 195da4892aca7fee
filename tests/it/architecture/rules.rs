//! The rules a source file is held to.

use std::collections::BTreeSet;

use super::scan::Scan;
use super::table::{Row, row_for};

const PRINTING: [&str; 5] = ["println", "eprintln", "print", "eprint", "dbg"];
const WORLD: [&str; 7] = [
    "std::fs",
    "std::env",
    "std::process",
    "std::net",
    "std::io::stdout",
    "std::io::stderr",
    "std::io::stdin",
];

/// The file of the library that reads and writes designs; all others take and give texts.
const FILES: &str = "entrance/files.rs";

/// The module path of a file: `solve/certify/mod.rs` is `solve::certify`.
pub(crate) fn module_of(file: &str) -> Vec<&str> {
    let mut parts: Vec<&str> = file.trim_end_matches(".rs").split('/').collect();
    if matches!(parts.last(), Some(&("mod" | "lib"))) {
        parts.pop();
    }
    parts
}

fn is_or_below(path: &str, what: &str) -> bool {
    path == what || path.strip_prefix(what).is_some_and(|p| p.starts_with("::"))
}

/// Everything `file` (relative to `src`) does that it may not.
pub(crate) fn violations(
    table: &[Row<'_>],
    crates: &BTreeSet<String>,
    file: &str,
    source: &str,
) -> Vec<String> {
    let module = module_of(file);
    let is_tests = module.last().is_some_and(|m| *m == "tests");
    let all = Scan::of(source, &module, true);
    let shipped = if is_tests { Scan::default() } else { Scan::of(source, &module, false) };
    let mut out = Vec::new();
    if !module.is_empty() {
        let Some(row) = row_for(table, &module.join("::")) else {
            return vec![format!("{file}: no row for this module in the table of docs/architecture.md")];
        };
        edges(table, row, file, &all, &mut out);
        externals(row, crates, file, &shipped, &mut out);
    }
    if module.first().is_none_or(|m| !matches!(*m, "cli" | "main")) && file != FILES {
        let printed = shipped.macros.iter().filter(|m| PRINTING.contains(&m.as_str()));
        out.extend(printed.map(|m| format!("{file}: {m}! below the command line")));
        let touched = shipped.paths.iter().filter(|p| WORLD.iter().any(|w| is_or_below(p, w)));
        out.extend(touched.map(|p| format!("{file}: {p} below the command line")));
    }
    if all.static_mut {
        out.push(format!("{file}: static mut"));
    }
    out
}

fn edges(table: &[Row<'_>], row: &Row<'_>, file: &str, scan: &Scan, out: &mut Vec<String>) {
    for path in &scan.paths {
        let Some(inner) = path.strip_prefix("crate::").or_else(|| path.strip_prefix("equipod::")) else {
            continue;
        };
        let target = row_for(table, inner).map_or(inner, |r| r.module);
        // a module may name what lies below it: that is how it re-exports
        let own = target == row.module || is_or_below(target, row.module);
        if !own && !row.imports.contains(&target) {
            out.push(format!("{file}: {} may not name {target} ({path})", row.module));
        }
    }
}

fn externals(row: &Row<'_>, crates: &BTreeSet<String>, file: &str, scan: &Scan, out: &mut Vec<String>) {
    for path in &scan.paths {
        let first = path.split("::").next().unwrap_or_default();
        if !crates.contains(first) || scan.declared.iter().any(|d| d == first) {
            continue;
        }
        match row.external.iter().find(|e| e.0 == first) {
            None => out.push(format!("{file}: {} may not name the crate {first}", row.module)),
            Some((_, Some(only))) if !file.ends_with(&format!("/{only}")) => {
                out.push(format!("{file}: only {only} may name the crate {first}"));
            }
            Some(_) => {}
        }
    }
}
