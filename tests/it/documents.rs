//! Documents name files, tests and designs: those must exist.

use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

fn names_in(folder: &str, ending: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(root().join(folder)).unwrap().map(|e| e.unwrap().path());
    let mut out: Vec<PathBuf> = entries.filter(|p| p.to_string_lossy().ends_with(ending)).collect();
    out.sort();
    out
}

fn pages() -> Vec<PathBuf> {
    [".", "docs", "docs/guides", "docs/theory", "designs"].iter().flat_map(|f| names_in(f, ".md")).collect()
}

/// `[file, function]` of every test a conformance page names; `::name` alone is in the file named before.
fn named_tests(page: &str) -> Vec<(String, String)> {
    let mut file = String::new();
    let mut out = Vec::new();
    for quoted in page.split('`').skip(1).step_by(2) {
        let Some((path, name)) = quoted.split_once("::") else { continue };
        if Path::new(path).extension().is_some_and(|e| e == "rs") {
            file = path.strip_prefix("it/").map_or(path.to_string(), |rest| format!("tests/it/{rest}"));
        } else if !path.is_empty() {
            continue;
        }
        out.push((file.clone(), name.to_string()));
    }
    out
}

fn has_test(file: &str, name: &str) -> bool {
    let text = std::fs::read_to_string(root().join(file)).unwrap_or_default();
    text.contains(&format!("fn {name}("))
}

#[test]
fn every_test_named_in_the_conformance_page_exists() {
    let named = named_tests(&read(&root().join("docs/conformance.md")));
    assert!(named.len() > 15, "{named:?}");
    for (file, name) in named {
        assert!(has_test(&file, &name), "{file}::{name}");
    }
    assert!(!has_test("tests/it/documents.rs", "no_such_test"));
}

#[test]
fn links_between_pages_lead_somewhere() {
    let mut followed = 0;
    for page in pages() {
        let text = read(&page);
        for target in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let file = target.split('#').next().unwrap_or_default();
            if file.is_empty() || file.contains("://") {
                continue;
            }
            followed += 1;
            assert!(page.parent().unwrap().join(file).exists(), "{}: {target}", page.display());
        }
    }
    assert!(followed > 10);
}

#[test]
fn source_files_named_in_the_documents_exist() {
    for page in pages() {
        for quoted in read(&page).split('`').skip(1).step_by(2) {
            let is_path =
                ["src/", "tests/", "docs/", "designs/", "examples/"].iter().any(|p| quoted.starts_with(p));
            let plain = quoted.chars().all(|c| c.is_alphanumeric() || "/._-".contains(c));
            if is_path && plain && !page.ends_with("CONTRIBUTING.md") {
                assert!(root().join(quoted).exists(), "{}: {quoted}", page.display());
            }
        }
    }
}

#[test]
fn every_design_is_in_the_table_of_its_folder_and_of_the_readme() {
    for table in ["designs/README.md", "README.md"] {
        let text = read(&root().join(table));
        for design in names_in("designs", ".toml") {
            let name = format!("`{}`", design.file_name().unwrap().to_string_lossy());
            assert!(text.contains(&name), "{table} lacks {name}");
        }
    }
}

/// The commands as the folders say: `fk`, and `equivalents family` for a file in the folder of a group.
fn commands() -> Vec<String> {
    let stem = |path: &PathBuf| path.file_stem().unwrap().to_string_lossy().into_owned();
    let mut out = Vec::new();
    for path in names_in("src/cli/commands", "") {
        let group = path.is_dir() && read(&path.join("mod.rs")).contains("pub(crate) enum Command");
        if group {
            let below = names_in(&format!("src/cli/commands/{}", stem(&path)), "");
            out.extend(below.iter().map(|p| format!("{} {}", stem(&path), stem(p))));
        } else {
            out.push(stem(&path));
        }
    }
    out.retain(|c| c.rsplit(' ').next() != Some("mod"));
    out
}

#[test]
fn every_command_is_in_the_readme_and_in_its_manual() {
    let all = commands();
    assert!(all.len() > 20 && all.contains(&"equivalents family".to_string()), "{all:?}");
    for command in all {
        for page in ["README.md", "docs/cli.md"] {
            assert!(
                read(&root().join(page)).contains(&format!("`equipod {command}")),
                "{page} lacks {command}"
            );
        }
    }
}
