//! Links, paths and tests that the documents name exist, and a newcomer finds the answers to first questions.

use std::collections::BTreeMap;
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

/// Links of a page to other pages of the project, as paths from its root.
fn linked(page: &Path, text: &str) -> Vec<PathBuf> {
    let targets = text.split("](").skip(1).filter_map(|rest| rest.split([')', '#']).next());
    let pages = targets
        .filter(|target| Path::new(target).extension().is_some_and(|e| e == "md") && !target.contains("://"));
    pages.filter_map(|target| page.parent()?.join(target).canonicalize().ok()).collect()
}

/// Pages by the number of links that lead to them from the first page.
fn clicks() -> BTreeMap<PathBuf, usize> {
    let first = root().join("README.md").canonicalize().unwrap();
    let mut found = BTreeMap::from([(first.clone(), 0)]);
    let mut open = vec![first];
    for click in 1.. {
        let texts = open.iter().map(|page| (page, std::fs::read_to_string(page).unwrap()));
        let next: Vec<PathBuf> = texts.flat_map(|(page, text)| linked(page, &text)).collect();
        open = next.into_iter().filter(|page| !found.contains_key(page)).collect();
        open.sort();
        open.dedup();
        if open.is_empty() {
            break;
        }
        found.extend(open.iter().map(|page| (page.clone(), click)));
    }
    found
}

/// The anchor that a heading has on the usual hosts.
fn anchor(heading: &str) -> String {
    let kept = heading.trim().to_lowercase().replace(' ', "-");
    kept.chars().filter(|c| c.is_alphanumeric() || "-_".contains(*c)).collect()
}

fn has_heading(text: &str, expected: &str) -> bool {
    text.lines()
        .filter(|line| line.starts_with('#'))
        .any(|line| anchor(line.trim_start_matches('#')) == expected)
}

/// Links of a page to headings that are not there.
fn without_heading(page: &Path, text: &str) -> Vec<String> {
    let links = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let headings = links.filter(|link| !link.contains("://")).filter_map(|link| link.split_once('#'));
    let missing = headings.filter(|(name, heading)| {
        let target = if name.is_empty() { page.to_owned() } else { page.parent().unwrap().join(name) };
        target.extension().is_some_and(|e| e == "md")
            && std::fs::read_to_string(target).is_ok_and(|text| !has_heading(&text, heading))
    });
    missing.map(|(name, heading)| format!("{}: {name}#{heading}", page.display())).collect()
}

#[test]
fn links_to_headings_lead_to_them() {
    let found: Vec<String> = pages().iter().flat_map(|(page, text)| without_heading(page, text)).collect();
    assert_eq!(found, [""; 0]);
    let planted = "[a](docs/README.md#start) [b](docs/README.md#no-such-heading) [c](#nowhere)";
    assert_eq!(without_heading(&root().join("README.md"), planted).len(), 2);
}

/// Why a newcomer does not find the answer at `PAGE.md#HEADING` in two clicks.
fn out_of_reach(clicks: &BTreeMap<PathBuf, usize>, place: &str) -> Option<String> {
    let (name, heading) = place.split_once('#').map_or((place, None), |(name, h)| (name, Some(h)));
    let Ok(page) = root().join(name).canonicalize() else { return Some(format!("{name} does not exist")) };
    let text = std::fs::read_to_string(&page).unwrap();
    if heading.is_some_and(|expected| !has_heading(&text, expected)) {
        return Some(format!("{place}: no such heading"));
    }
    match clicks.get(&page) {
        Some(0..=2) => None,
        far => Some(format!("{name} is {far:?} clicks away")),
    }
}

#[test]
fn twelve_questions_of_a_newcomer_are_answered_within_two_clicks() {
    let list = std::fs::read_to_string(root().join("tests/prose/questions.md")).unwrap();
    let rows = list.lines().filter(|line| line.starts_with("| ") && line.contains("? | "));
    let places: Vec<&str> = rows.map(|row| row.split('|').nth(2).unwrap().trim()).collect();
    assert_eq!(places.len(), 12);
    let clicks = clicks();
    let faults: Vec<String> = places.iter().filter_map(|place| out_of_reach(&clicks, place)).collect();
    assert_eq!(faults, [""; 0]);
    for wrong in ["docs/no.md", "docs/faq.md#no-such-heading", "tests/prose/questions.md"] {
        assert!(out_of_reach(&clicks, wrong).is_some(), "{wrong}");
    }
}

#[test]
fn every_page_of_the_documentation_is_reached_from_the_first_one_within_two_clicks() {
    let clicks = clicks();
    for (page, _) in
        pages().into_iter().filter(|(page, _)| page.components().any(|c| c.as_os_str() == "docs"))
    {
        let found = clicks.get(&page.canonicalize().unwrap());
        assert!(found.is_some_and(|n| *n <= 2), "{}: {found:?} clicks", page.display());
    }
}
