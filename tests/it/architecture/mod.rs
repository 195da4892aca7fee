//! The layering: who may name whom, which crates are named where, nothing prints or reads below `cli`.

mod rules;
mod scan;
mod snippets;
mod table;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use rules::violations;
use table::{APART, in_page, reach, table};

/// A source with comments, strings and characters replaced by blanks.
pub(crate) fn without_comments(source: &str) -> String {
    scan::blank(source)
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// The Rust files below a folder, as paths relative to it with `/`.
fn rust_files(folder: &Path) -> Vec<String> {
    let mut out = Vec::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(next) = open.pop() {
        for entry in std::fs::read_dir(&next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") {
                let parts = path.strip_prefix(folder).unwrap().iter();
                out.push(parts.map(|p| p.to_string_lossy()).collect::<Vec<_>>().join("/"));
            }
        }
    }
    out.sort();
    out
}

/// Packages that no source names: they are there for their features (Cargo.toml says why, `.ci/shared-features` checks it).
const FOR_FEATURES: [&str; 1] = ["once_cell"];

/// Names of the dependencies as they are written in code.
fn dependencies() -> BTreeSet<String> {
    let manifest: toml::Table = read(&root().join("Cargo.toml")).parse().unwrap();
    manifest["dependencies"].as_table().unwrap().keys().map(|k| k.replace('-', "_")).collect()
}

#[test]
fn no_source_file_breaks_the_layering() {
    let (table, crates) = (table(), dependencies());
    let src = root().join("src");
    let files = rust_files(&src);
    assert!(files.len() > 50, "only {} files were looked at", files.len());
    let found: Vec<String> =
        files.iter().flat_map(|f| violations(&table, &crates, f, &read(&src.join(f)))).collect();
    assert!(found.is_empty(), "\n{}", found.join("\n"));
}

#[test]
fn the_table_in_the_documentation_is_the_one_tested() {
    let page = read(&root().join("docs/architecture.md"));
    let (documented, tested) = (in_page(&page), table());
    for (d, t) in documented.iter().zip(&tested) {
        assert_eq!(d, t);
    }
    assert_eq!(documented.len(), tested.len());
}

#[test]
fn modules_that_check_each_other_do_not_reach_each_other() {
    let table = table();
    let mut through = 0;
    for (left, right) in APART {
        for (from, to) in left.iter().map(|l| (l, right)).chain(right.iter().map(|r| (r, left))) {
            let known = reach(&table, from);
            through += known.len();
            // the part below a module it may use is not what keeps the groups apart
            assert!(to.iter().all(|t| !known.contains(t)) || from_may_use(from, to), "{from} reaches {to:?}");
        }
    }
    assert!(through > 20);
    assert!(reach(&table, "cli").contains(&"num") && reach(&table, "offsets").contains(&"geom"));
}

/// Names of types that stand at the beginning of a line of code, each with whether others than its own module can see it.
fn types(source: &str) -> Vec<(String, bool)> {
    let mut out = Vec::new();
    for line in source.lines() {
        let inner = line.starts_with(char::is_whitespace);
        let mut words = line.split_whitespace().peekable();
        let visibility = words.next_if(|w| w.starts_with("pub"));
        let Some(kind) = words.next().filter(|w| ["struct", "enum", "trait", "type"].contains(w)) else {
            continue;
        };
        // an associated type has the name that its trait gives it
        if kind == "type" && inner {
            continue;
        }
        let name: String = words.next().unwrap_or("").chars().take_while(|c| c.is_alphanumeric()).collect();
        if name.starts_with(char::is_uppercase) {
            out.push((name, matches!(visibility, Some("pub" | "pub(crate)"))));
        }
    }
    out
}

/// What clap wants of every command has the same name in all of them.
const OF_COMMANDS: [&str; 2] = ["Args", "Command"];

#[test]
fn the_name_of_a_type_that_is_seen_outside_of_its_module_stands_for_one_thing() {
    assert_eq!(
        types("pub struct A<T>;\n    type Output = A;\npub(super) enum B {\nstructure\n"),
        [("A".to_owned(), true), ("B".to_owned(), false)]
    );
    let src = root().join("src");
    let mut places: std::collections::BTreeMap<String, (bool, Vec<String>)> =
        std::collections::BTreeMap::new();
    for file in rust_files(&src) {
        for (name, seen) in types(&without_comments(&read(&src.join(&file)))) {
            if file.starts_with("cli/") && OF_COMMANDS.contains(&name.as_str()) {
                continue;
            }
            let place = places.entry(name).or_default();
            place.0 |= seen;
            place.1.push(file.clone());
        }
    }
    assert!(places.len() > 500, "only {} types were found", places.len());
    let twice: Vec<_> = places.iter().filter(|(_, (seen, files))| *seen && files.len() > 1).collect();
    assert!(twice.is_empty(), "{twice:#?}");
}

/// `fk` attaches certificates: that direction alone is allowed.
fn from_may_use(from: &str, to: &[&str]) -> bool {
    from == "fk" && to == ["solve::certify"]
}

#[test]
fn every_dependency_is_used_and_every_crate_of_the_table_is_one() {
    let named: BTreeSet<String> =
        table().iter().flat_map(|r| r.external.clone()).map(|e| e.0.to_string()).collect();
    let mut all = dependencies();
    assert!(FOR_FEATURES.iter().all(|name| all.remove(*name)), "{all:?}");
    assert_eq!(named, all);
    let src = root().join("src");
    let sources: Vec<String> = rust_files(&src).iter().map(|f| read(&src.join(f))).collect();
    for name in named {
        let path = format!("{name}::");
        assert!(sources.iter().any(|s| scan::blank(s).contains(&path)), "{name} is not used");
    }
}
