//! The words of proof: every place that uses one stands in `docs/claims.md`, with a test that exists.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

const WORDS: [&str; 15] = [
    "proved",
    "proves",
    "prove",
    "proof",
    "proofs",
    "certified",
    "certificate",
    "certificates",
    "certify",
    "certifies",
    "impossible",
    "never",
    "guarantee",
    "guaranteed",
    "guarantees",
];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|e| panic!("{path}: {e}"))
}

fn claims(text: &str) -> bool {
    text.split(|c: char| !c.is_alphabetic()).any(|word| WORDS.contains(&word.to_lowercase().as_str()))
}

/// Documentation comments and texts of a source file, unit tests left out.
fn said(source: &str) -> String {
    let source = source.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    let mut out = String::new();
    let mut rest = source;
    while let Some(first) = rest.chars().next() {
        let line = rest.find('\n').unwrap_or(rest.len());
        let length = if rest.starts_with("///") || rest.starts_with("//!") {
            out.push_str(&rest[3..line.max(3)]);
            out.push('\n');
            line
        } else if rest.starts_with("//") {
            line
        } else if rest.starts_with("'\"'") || rest.starts_with("'\\\"'") {
            rest[1..].find('\'').map_or(1, |end| end + 2)
        } else if let Some(raw) = rest.strip_prefix("r#\"") {
            let end = raw.find("\"#").unwrap_or(raw.len());
            out.push_str(&raw[..end]);
            out.push('\n');
            (end + 5).min(rest.len())
        } else if first == '"' {
            let mut end = 1;
            let bytes = rest.as_bytes();
            while end < bytes.len() && bytes[end] != b'"' {
                end += if bytes[end] == b'\\' { 2 } else { 1 };
            }
            out.push_str(&rest[1..end.min(rest.len())]);
            out.push('\n');
            (end + 1).min(rest.len())
        } else {
            first.len_utf8()
        };
        rest = &rest[length..];
    }
    out
}

fn sources(folder: &Path, out: &mut Vec<String>) {
    let mut entries: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            if path.file_name().is_some_and(|n| n != "tests") {
                sources(&path, out);
            }
        } else if path.extension().is_some_and(|e| e == "rs")
            && path.file_name().is_some_and(|n| n != "tests.rs")
        {
            out.push(path.strip_prefix(root()).unwrap().to_str().unwrap().replace('\\', "/"));
        }
    }
}

/// The rows of the tables with this number of columns, without their heads.
fn rows(page: &str, columns: usize) -> Vec<Vec<String>> {
    let lines = page.lines().filter(|l| l.starts_with('|') && !l.starts_with("|---"));
    let cells =
        lines.map(|l| l.trim_matches('|').split(" | ").map(|c| c.trim().to_owned()).collect::<Vec<_>>());
    cells.filter(|c| c.len() == columns && c[0] != "claim" && c[0] != "where").collect()
}

fn quoted(cell: &str) -> Vec<String> {
    cell.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

fn covers(place: &str, file: &str) -> bool {
    let stem = place.strip_suffix(".rs").unwrap_or(place);
    file == place || file.strip_prefix(stem).is_some_and(|rest| rest.starts_with('/') || rest == ".rs")
}

/// Places of both tables.
fn places(page: &str) -> BTreeSet<String> {
    let first = rows(page, 5).into_iter().flat_map(|r| quoted(&r[1]));
    first.chain(rows(page, 2).into_iter().flat_map(|r| quoted(&r[0]))).collect()
}

#[test]
fn every_word_of_proof_in_the_source_stands_in_the_table() {
    let page = read("docs/claims.md");
    let places = places(&page);
    let mut files = Vec::new();
    sources(&root().join("src"), &mut files);
    let claiming: Vec<String> = files.into_iter().filter(|f| claims(&said(&read(f)))).collect();
    assert!(claiming.len() > 80, "{} files: the reader is blind", claiming.len());
    let missing: Vec<&String> = claiming.iter().filter(|f| !places.iter().any(|p| covers(p, f))).collect();
    assert!(missing.is_empty(), "not in docs/claims.md: {missing:#?}");
    for place in &places {
        let used = claiming.iter().any(|f| covers(place, f))
            || (Path::new(place).extension().is_some_and(|e| e == "md") && claims(&read(place)));
        assert!(used, "`{place}` is listed in docs/claims.md and claims nothing");
    }
    // a new file with a claim would be missed by none of this
    assert!(!places.iter().any(|p| covers(p, "src/new/claims.rs")));
    assert!(claims(&said("/// This is proved.\nfn f() {}")) && claims(&said("f(\"a \\\" proof\")")));
    assert!(!claims(&said("// proved in a comment for developers\nlet certified = 1;")));
}

#[test]
fn every_claim_has_its_reason_its_preconditions_and_a_test_that_exists() {
    let page = read("docs/claims.md");
    let table = rows(&page, 5);
    assert!(table.len() > 15, "{} rows", table.len());
    for row in &table {
        assert!(row.iter().all(|c| !c.is_empty()), "{row:?}");
        let tests = quoted(&row[4]);
        assert!(!tests.is_empty(), "{row:?}");
        for test in tests {
            assert!(has_test(&test), "no test {test}");
        }
    }
    for row in rows(&page, 2) {
        assert!(!row[1].is_empty() && !quoted(&row[0]).is_empty(), "{row:?}");
    }
    assert!(!has_test("tests/it/claims.rs::no_such_test") && !has_test("tests/it/nowhere.rs::x"));
    assert!(!has_test("tests/it/claims.rs::has_test"), "a function that is not a test");
}

/// `path::name` of a function under `#[test]`.
fn has_test(test: &str) -> bool {
    let Some((file, name)) = test.split_once("::") else { return false };
    let text = std::fs::read_to_string(root().join(file)).unwrap_or_default();
    let head = format!("fn {name}(");
    text.match_indices(&head).any(|(at, _)| {
        let before = text[..at].trim_end_matches("pub(crate) ").trim_end();
        before.lines().next_back().is_some_and(|l| l.trim().starts_with("#["))
            && before.lines().rev().take_while(|l| l.trim().starts_with("#[")).any(|l| l.contains("test"))
    })
}

#[test]
fn what_the_readme_calls_proved_is_in_the_table() {
    let readme = read("README.md");
    let part = readme.split("## What is proved").nth(1).and_then(|p| p.split("\n## ").next()).unwrap();
    assert!(part.contains("docs/claims.md"), "the section names the table");
}
