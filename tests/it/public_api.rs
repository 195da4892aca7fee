//! The listing of the public API, `docs/public-api.txt`: what users of the front page count on, so that every change of it shows in a diff.
//!
//! The names are those of `equipod::prelude`, which are those of the root; below each type stand the public functions of its `impl` blocks, the fields and
//! variants, and the traits that are implemented for it by hand. Methods of modules behind the front page are not listed. Write it anew with
//! `EQUIPOD_WRITE_PUBLIC_API=1 cargo test --test it public_api`.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Public items of the front page may not be more.
const MOST: usize = 60;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Sources of the library without unit tests, comments and strings.
fn sources(folder: &Path, out: &mut Vec<String>) {
    let mut entries: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            if path.file_name().is_some_and(|n| n != "cli") {
                sources(&path, out);
            }
        } else if path.extension().is_some_and(|e| e == "rs")
            && path.file_name().is_some_and(|n| n != "tests.rs")
        {
            let text = super::architecture::without_comments(&std::fs::read_to_string(&path).unwrap());
            out.push(text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default().to_string());
        }
    }
}

/// The names that `pub use` of the prelude lists, and the module each is from.
fn prelude(lib: &str) -> BTreeMap<String, String> {
    let body = lib.split("pub mod prelude {").nth(1).unwrap().split("\n}\n").next().unwrap();
    let mut names = BTreeMap::new();
    for statement in body.split(';').filter_map(|s| s.split("pub use crate::").nth(1)) {
        let (module, list) = statement.split_once("::").unwrap();
        let list = list.trim().trim_start_matches('{').trim_end_matches('}');
        for name in list.split(',').map(str::trim).filter(|n| !n.is_empty()) {
            assert!(names.insert(name.to_string(), module.to_string()).is_none(), "{name} is listed twice");
        }
    }
    names
}

/// One blank for any number, and none beside brackets and before commas, so that line breaks of the formatter do not show.
fn squeezed(text: &str) -> String {
    let joined = text.split_whitespace().collect::<Vec<_>>().join(" ");
    joined.replace("( ", "(").replace(",)", ")").replace(", )", ")").replace(" )", ")").replace("< ", "<")
}

/// The text up to the end of the block that begins at the first `{`.
fn block(text: &str) -> &str {
    let mut depth = 0;
    for (i, c) in text.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => continue,
        }
        if depth == 0 {
            return &text[..=i];
        }
    }
    text
}

/// A signature: up to its body, the semicolon, or the value of a constant.
fn signature(text: &str) -> String {
    let mut depth = 0;
    let mut end = text.len();
    for (i, c) in text.char_indices() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            '{' | ';' | '=' if depth == 0 => {
                end = i;
                break;
            }
            _ => {}
        }
    }
    squeezed(&text[..end])
}

/// What can be said of a name by its definition: kind, fields or variants.
fn definition(sources: &[(String, String)], module: &str, name: &str) -> Option<(String, BTreeSet<String>)> {
    for (of, text) in sources {
        if of != module {
            continue;
        }
        for kind in ["struct", "enum", "fn", "const"] {
            let start = format!("pub {kind} {name}");
            let found = text.match_indices(&start).find(|(i, _)| {
                !text[i + start.len()..].starts_with(|c: char| c.is_alphanumeric() || c == '_')
            });
            let Some((i, _)) = found else { continue };
            let rest = &text[i..];
            if kind == "fn" || kind == "const" {
                return Some((signature(rest), BTreeSet::new()));
            }
            let attributes = &text[..i];
            let attributes = &attributes[attributes.rfind(['}', ';']).map_or(0, |k| k + 1)..];
            let mark = if attributes.contains("non_exhaustive") { "#[non_exhaustive] " } else { "" };
            let head = format!("{mark}{}", signature(rest));
            let mut inside = BTreeSet::new();
            if rest.find('{').is_some_and(|b| rest.find(';').is_none_or(|s| b < s)) {
                let whole = block(rest);
                let body = &whole[whole.find('{').unwrap() + 1..whole.len() - 1];
                let mut depth = 0;
                let mut item = String::new();
                for c in body.chars().chain([',']) {
                    match c {
                        '(' | '{' | '<' | '[' => depth += 1,
                        ')' | '}' | '>' | ']' => depth -= 1,
                        ',' if depth == 0 => {
                            let words = squeezed(&item);
                            let words = words.rsplit("] ").next().unwrap_or(&words).trim().to_string();
                            if !words.is_empty() && (kind == "enum" || words.starts_with("pub ")) {
                                inside.insert(words);
                            }
                            item.clear();
                            continue;
                        }
                        _ => {}
                    }
                    item.push(c);
                }
            }
            return Some((head, inside));
        }
    }
    None
}

/// Public functions and traits of the `impl` blocks of a type.
fn implemented(sources: &[(String, String)], module: &str, name: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for (of, text) in sources {
        // inherent methods of the front page stand in `entrance`, whatever module the type is from
        if of != module && of != "entrance" {
            continue;
        }
        for (i, _) in text.match_indices("\nimpl") {
            let whole = block(&text[i + 1..]);
            let head = signature(whole);
            let target = head.rsplit(" for ").next().unwrap_or(&head);
            let target = target.trim_start_matches("impl").trim_start_matches("<'a>").trim();
            let target: String = target.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
            if target != name {
                continue;
            }
            if head.contains(" for ") {
                found.insert(head.clone());
                continue;
            }
            for kind in ["pub fn ", "pub const "] {
                for (k, _) in whole.match_indices(kind) {
                    found.insert(signature(&whole[k..]));
                }
            }
        }
    }
    found
}

fn listing() -> (usize, String) {
    let src = root().join("src");
    let lib = std::fs::read_to_string(src.join("lib.rs")).unwrap();
    let names = prelude(&super::architecture::without_comments(&lib));
    let mut texts: Vec<(String, String)> = Vec::new();
    for entry in std::fs::read_dir(&src).unwrap() {
        let path = entry.unwrap().path();
        let module = path.file_stem().unwrap().to_string_lossy().into_owned();
        let mut found = Vec::new();
        if path.is_dir() && module != "cli" {
            sources(&path, &mut found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(super::architecture::without_comments(&std::fs::read_to_string(&path).unwrap()));
        }
        texts.extend(found.into_iter().map(|text| (module.clone(), text)));
    }
    texts.sort_by(|a, b| a.0.cmp(&b.0));
    let mut out =
        String::from("# The public API of the front page. Made by tests/it/public_api.rs, compared by it.\n");
    for (name, module) in &names {
        let (head, inside) =
            definition(&texts, module, name).unwrap_or_else(|| panic!("{name} is not in {module}"));
        writeln!(out, "\n{head}").unwrap();
        for line in inside.iter().chain(&implemented(&texts, module, name)) {
            writeln!(out, "    {line}").unwrap();
        }
    }
    (names.len(), out)
}

/// What else is public at the root: modules and crates, with the prelude's items.
fn others() -> BTreeSet<String> {
    let lib =
        super::architecture::without_comments(&std::fs::read_to_string(root().join("src/lib.rs")).unwrap());
    let lines = lib.lines().filter_map(|l| l.strip_prefix("pub mod ").or_else(|| l.strip_prefix("pub use ")));
    lines.map(|l| l.trim_end_matches([';', '{', ' ']).to_string()).collect()
}

#[test]
fn the_front_page_has_fewer_than_sixty_items() {
    let (count, _) = listing();
    let modules = others();
    let known = ["cli", "methods", "nalgebra", "num_complex", "prelude", "prelude::*", "records"];
    assert!(modules.iter().all(|m| known.contains(&m.as_str())), "{modules:?}");
    // `methods` is for those who develop methods, `cli` is the program
    let beside = modules.iter().filter(|m| !["cli", "methods", "prelude::*"].contains(&m.as_str())).count();
    assert!(count + beside < MOST, "{count} items and {beside} modules and crates");
}

#[test]
fn the_listing_of_the_public_api_is_the_one_checked_in() {
    let path = root().join("docs/public-api.txt");
    let (_, now) = listing();
    if std::env::var_os("EQUIPOD_WRITE_PUBLIC_API").is_some() {
        std::fs::write(&path, &now).unwrap();
    }
    let before = std::fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
    let (new, old): (Vec<&str>, Vec<&str>) = (now.lines().collect(), before.lines().collect());
    let added: Vec<&&str> = new.iter().filter(|l| !old.contains(l)).collect();
    let gone: Vec<&&str> = old.iter().filter(|l| !new.contains(l)).collect();
    assert!(
        now == before,
        "the public API changed; write docs/public-api.txt anew if that is meant (see tests/it/public_api.rs)\nadded: {added:#?}\ngone: {gone:#?}"
    );
}
