//! Links, paths and tests that the documents name exist.

use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn pages() -> Vec<(PathBuf, String)> {
    let folders = [".", "docs", "docs/guides", "docs/theory", "docs/evidence", "designs"];
    let entries = folders.iter().flat_map(|f| std::fs::read_dir(root().join(f)).unwrap());
    let pages = entries.map(|e| e.unwrap().path()).filter(|p| p.extension().is_some_and(|e| e == "md"));
    pages.map(|page| (page.clone(), std::fs::read_to_string(page).unwrap())).collect()
}

fn quoted(page: &str) -> impl Iterator<Item = &str> {
    page.split('`').skip(1).step_by(2)
}

/// Targets of links and quoted paths of a page that are not there.
fn dead(page: &Path, text: &str) -> Vec<String> {
    let links = text.split("](").skip(1).filter_map(|rest| rest.split([')', '#']).next());
    let links =
        links.filter(|target| !target.contains("://")).map(|target| page.parent().unwrap().join(target));
    let own = |path: &&str| {
        let folders = ["src/", "tests/", "docs/", "designs/", "examples/"];
        folders.iter().any(|f| path.starts_with(f))
            && path.chars().all(|c| c.is_alphanumeric() || "/._-".contains(c))
    };
    let paths = quoted(text).filter(own).map(|path| root().join(path));
    links.chain(paths).filter(|path| !path.exists()).map(|path| path.display().to_string()).collect()
}

/// Tests that a page names: `path::name`, or `::name` for one more in the file named before. With each are its
/// attributes, and the text of the page after it.
fn named_tests(page: &str) -> Vec<(String, String, &str)> {
    let (mut file, mut out) = (String::new(), Vec::new());
    let parts: Vec<&str> = page.split('`').collect();
    for pair in parts[1..].chunks(2) {
        let Some((path, name)) = pair[0].split_once("::") else { continue };
        if path.strip_suffix(".rs").is_some() {
            file = if path.starts_with("it/") { format!("tests/{path}") } else { path.to_owned() };
        } else if !path.is_empty() {
            continue;
        }
        let text = std::fs::read_to_string(root().join(&file)).unwrap_or_default();
        let before = text.split(&format!("fn {name}(")).next().filter(|before| before.len() < text.len());
        let attributes = before.and_then(|before| before.trim_end().rsplit("\n\n").next());
        let after = pair.get(1).copied().unwrap_or_default();
        out.push((format!("{file}::{name}"), attributes.unwrap_or_default().to_owned(), after));
    }
    out
}

/// Tests of a page that are not there.
fn missing(page: &str) -> Vec<String> {
    let named = named_tests(page).into_iter();
    named.filter(|(_, attributes, _)| !attributes.contains("#[test]")).map(|(name, ..)| name).collect()
}

#[test]
fn links_and_paths_of_the_pages_lead_somewhere() {
    let pages = pages();
    assert!(pages.len() > 30, "{}", pages.len());
    for (page, text) in &pages {
        // paths in the one are patterns for new files, in the other files of the past
        if !page.ends_with("CONTRIBUTING.md") && !page.ends_with("CHANGELOG.md") {
            assert_eq!(dead(page, text), [""; 0], "{}", page.display());
        }
    }
    assert_eq!(
        dead(&root().join("README.md"), "[a](docs/no.md) `src/no.rs` [b](docs/cli.md#x) `src/fk`").len(),
        2
    );
}

#[test]
fn every_test_that_stands_for_a_claim_exists() {
    for name in ["claims.md", "conformance.md"] {
        let page = std::fs::read_to_string(root().join("docs").join(name)).unwrap();
        assert!(quoted(&page).filter(|q| q.contains("::")).count() > 15, "{name}");
        assert_eq!(missing(&page), [""; 0], "{name}");
    }
    let planted = "`it/documents.rs::no_such_test` `::missing` `tests/it/nowhere.rs::x` `it/documents.rs::every_test_that_stands_for_a_claim_exists`";
    assert_eq!(missing(planted).len(), 3);
}

/// Every claim has a command, and tests that do not run with every change are marked, others not.
#[test]
fn conformance_has_commands_and_marks_tests_of_the_evidence() {
    let page = std::fs::read_to_string(root().join("docs/conformance.md")).unwrap();
    for (name, attributes, after) in named_tests(&page) {
        assert_eq!(attributes.contains("#[ignore"), after.starts_with(" (*evidence*)"), "{name}");
    }
    let tables = page.split("\n| claim | command | test |\n").skip(1);
    let rows = tables.flat_map(|table| table.lines().skip(1).take_while(|line| line.starts_with("| ")));
    let commands: Vec<&str> = rows.map(|row| row.split(" | ").nth(1).unwrap()).collect();
    assert!(commands.len() > 90, "{}", commands.len());
    let without: Vec<&&str> = commands.iter().filter(|cell| !cell.starts_with("`equipod ")).collect();
    assert_eq!(without, [&""; 0]);
    assert!(!page.contains("methods::"), "functions of users only");
}
