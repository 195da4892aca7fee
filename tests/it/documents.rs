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

/// Tests of a page that are not there: `path::name`, or `::name` for one more in the file named before.
fn missing(page: &str) -> Vec<String> {
    let (mut file, mut out) = (String::new(), Vec::new());
    for (path, name) in quoted(page).filter_map(|q| q.split_once("::")) {
        if path.strip_suffix(".rs").is_some() {
            file = if path.starts_with("it/") { format!("tests/{path}") } else { path.to_owned() };
        } else if !path.is_empty() {
            continue;
        }
        let text = std::fs::read_to_string(root().join(&file)).unwrap_or_default();
        let test = text.split(&format!("fn {name}(")).next().filter(|before| before.len() < text.len());
        if !test.is_some_and(|before| before.trim_end().rsplit("\n\n").next().unwrap().contains("#[test]")) {
            out.push(format!("{file}::{name}"));
        }
    }
    out
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
