//! The files that the program writes about itself: completions, manual pages, schemas, colours and closed pipes.

use std::collections::BTreeSet;
use std::process::{Command, Stdio};

use serde_json::Value;

use super::cli_frame::{document, equipod};

/// Commands that are shown in the help, `equivalents family` for one of a group; the figures of `plot` are one of them.
fn commands() -> Vec<String> {
    let help = String::from_utf8(equipod(&["--help"]).stdout).unwrap();
    let list = help.split("Options:").next().unwrap();
    let names = list.lines().filter_map(|l| l.strip_prefix("  ")).filter(|l| !l.starts_with(' '));
    let names: Vec<String> = names.map(|l| l.split("  ").next().unwrap().replace(" FIGURE", "")).collect();
    let has = |name: &str| names.iter().any(|n| n == name);
    assert!(names.len() > 20 && has("fk") && has("plot") && has("equivalents family"));
    names
}

/// As files and schemas call it.
fn in_one_word(command: &str) -> String {
    command.replace(' ', "-")
}

#[test]
fn completions_know_every_command() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let out = equipod(&["shell", "completions", shell]);
        assert_eq!(out.status.code(), Some(0));
        let script = String::from_utf8(out.stdout).unwrap();
        for command in commands() {
            for word in command.split(' ') {
                assert!(script.contains(word), "{shell} lacks {command}");
            }
        }
        assert!(script.contains("free-grid") || script.contains("grid-platform"), "{shell}: options too");
        assert_eq!(document(&equipod(&["shell", "completions", shell, "--json"]))["script"], script);
    }
    assert_eq!(equipod(&["shell", "completions", "cobol"]).status.code(), Some(2));
    // a shell reads it
    let script = equipod(&["shell", "completions", "bash"]).stdout;
    let check = |text: &[u8]| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("equipod.bash");
        std::fs::write(&path, text).unwrap();
        Command::new("bash").arg("-n").arg(&path).stderr(Stdio::null()).status().map(|s| s.success())
    };
    if let Ok(good) = check(&script) {
        assert!(good);
        assert!(!check(&script[..script.len() / 2]).unwrap(), "half a script is none");
    }
}

#[test]
fn there_is_a_manual_page_for_every_command() {
    let folder = tempfile::tempdir().unwrap();
    let read = |to: &str| {
        let to = folder.path().join(to);
        let doc = document(&equipod(&["shell", "man", "-o", to.to_str().unwrap(), "--json"]));
        let paths = doc["paths"].as_array().unwrap();
        paths.iter().map(|p| std::fs::read_to_string(p.as_str().unwrap()).unwrap()).collect::<Vec<_>>()
    };
    let pages = read("one/deep");
    assert_eq!(pages, read("two"), "no date, no path");
    assert!(pages.iter().any(|p| p.contains(".TH equipod-plot-modes 1")), "commands of commands too");
    for command in commands() {
        let title = format!(".TH equipod-{} 1", in_one_word(&command));
        assert!(pages.iter().any(|p| p.contains(&title)), "no page for {command}: {}", &pages[1][..200]);
    }
    let file = folder.path().join("file");
    std::fs::write(&file, "").unwrap();
    let refused = equipod(&["shell", "man", "-o", file.join("under").to_str().unwrap(), "--json"]);
    assert_eq!(document(&refused)["error"]["code"], "file::not_writable");
}

/// `equipod design schema OF`.
fn schema(of: &str) -> Value {
    let out = equipod(&["design", "schema", of]).stdout;
    serde_json::from_slice(&out)
        .unwrap_or_else(|_| panic!("{of} lacks its schema: src/app/records/schema.rs"))
}

#[test]
fn schemas_are_json_and_every_answer_has_one() {
    assert_eq!(document(&equipod(&["design", "schema", "--json"]))["schema"], schema("design"));
    for command in
        commands().iter().map(|c| in_one_word(c)).chain(["plot-locus", "error", "help"].map(String::from))
    {
        let command = command.as_str();
        let schema = schema(command);
        assert_eq!(schema["$ref"], format!("#/$defs/{command}"));
        assert!(
            schema["$defs"][command].is_object(),
            "{command} lacks its answer in src/app/records/schema.rs"
        );
    }
    assert_eq!(equipod(&["design", "schema", "nothing"]).status.code(), Some(2));
}

/// Every key of a design file is described.
#[test]
fn every_key_in_the_tables_has_a_meaning() {
    let page = std::fs::read_to_string("docs/design-files.md").unwrap();
    for line in page.lines().filter(|l| l.starts_with("| `") && l.matches(" | ").count() > 1) {
        assert!(!line.ends_with("|  |") && !line.contains("anything"), "{line}");
    }
}

/// Fields of a definition and of its alternatives that have no description and refer to no definition that has one.
fn undescribed<'a>(definitions: &'a Value, schema: &'a Value, out: &mut Vec<&'a str>) {
    let described = |field: &Value| {
        let found = field["$ref"].as_str().and_then(|r| definitions.get(r.trim_start_matches("#/$defs/")));
        let texts = [Some(field), found].into_iter().flatten().filter_map(|s| s["description"].as_str());
        field.get("const").is_some() || texts.into_iter().any(|text| !text.trim().is_empty())
    };
    for (name, field) in schema["properties"].as_object().into_iter().flatten() {
        if !described(field) {
            out.push(name);
        }
    }
    for alternative in ["anyOf", "oneOf"].iter().filter_map(|k| schema[k].as_array()).flatten() {
        undescribed(definitions, alternative, out);
    }
}

/// Every answer has a section with its fields, every field stands on the page, and every one is described.
#[test]
fn every_answer_and_every_field_is_on_the_page() {
    let page = std::fs::read_to_string("docs/answers.md").unwrap();
    // behind a name stand the marks of lists and of null
    let listed: BTreeSet<&str> =
        page.split('`').skip(1).step_by(2).filter_map(|code| code.split(['[', '?']).next()).collect();
    let manual = std::fs::read_to_string("docs/cli.md").unwrap();
    for command in commands() {
        let name = in_one_word(&command);
        assert!(page.contains(&format!("\n## `equipod {command}`\n")), "{command}");
        assert!(manual.contains(&format!("](answers.md#equipod-{name})")), "{command}");
        let schema = schema(&name);
        let definitions = &schema["$defs"];
        for (record, found) in definitions.as_object().unwrap() {
            if record == "design" || record.starts_with("design_") {
                continue;
            }
            let mut bare = Vec::new();
            undescribed(definitions, found, &mut bare);
            assert_eq!(bare, [""; 0], "{record}");
            for field in found["properties"].as_object().into_iter().flatten().map(|(field, _)| field) {
                let in_all = ["schema_version", "provenance", "warnings"].contains(&field.as_str());
                assert!(in_all || listed.contains(field.as_str()), "{record}: {field}");
            }
        }
    }
}

#[test]
fn colours_only_where_they_are_wanted() {
    let coloured = |args: &[&str], set: &[(&str, &str)]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_equipod"));
        command.args(args).env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE").envs(set.iter().copied());
        let out = command.output().unwrap();
        assert_eq!(out.status.code(), Some(2));
        out.stderr.contains(&0x1b)
    };
    // a refusal of the program, and one of its arguments
    for args in [&["fk", "no-such.toml"][..], &["fk", "--no-such"]] {
        assert!(!coloured(args, &[]), "not into a pipe");
        assert!(coloured(args, &[("CLICOLOR_FORCE", "1")]), "unless forced");
        assert!(!coloured(args, &[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "1")]), "NO_COLOR comes first");
    }
}

#[cfg(unix)]
#[test]
fn long_texts_end_quietly_when_nobody_reads() {
    let design = "designs/rbt-octahedral.toml";
    for args in [
        &["shell", "completions", "bash"][..],
        &["design", "schema", "fk"],
        &["--help"],
        &["fk", design],
        &["fk", design, "--json"],
    ] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_equipod"));
        command.current_dir(env!("CARGO_MANIFEST_DIR")).args(args);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let out = child.wait_with_output().unwrap();
        assert_eq!(out.status.code(), Some(0), "{args:?}: the answer is what it is");
        assert!(out.stderr.is_empty(), "{args:?}: {}", String::from_utf8_lossy(&out.stderr));
    }
}
