//! The process: exit codes, one JSON document on standard output, everything else on standard error.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use serde_json::Value;

pub(crate) fn equipod(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_equipod"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(args)
        .output()
        .unwrap()
}

/// The one document on standard output, with the schema version in front.
pub(crate) fn document(out: &Output) -> Value {
    let text = std::str::from_utf8(&out.stdout).unwrap();
    assert!(text.starts_with("{\"schema_version\":1,"), "{text}");
    assert!(text.ends_with("}\n"));
    serde_json::from_str(text).unwrap()
}

/// The exit code and the document of a command with `--json`.
pub(crate) fn asked(args: &[&str]) -> (Option<i32>, Value) {
    let out = equipod(&[args, &["--json"]].concat());
    (out.status.code(), document(&out))
}

/// Runs `fk FILE --json` on a file that must be refused and returns the error record.
fn refused(path: &Path) -> Value {
    let out = equipod(&["fk", path.to_str().unwrap(), "--json"]);
    assert_eq!(out.status.code(), Some(2), "{}", String::from_utf8_lossy(&out.stderr));
    assert!(!out.stderr.is_empty(), "people are told too");
    document(&out)["error"].clone()
}

fn file(folder: &tempfile::TempDir, name: &str, bytes: &[u8]) -> std::path::PathBuf {
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    path
}

#[test]
fn a_bad_design_is_exit_2_with_all_violations_in_both_forms() {
    let folder = tempfile::tempdir().unwrap();
    let good = std::fs::read_to_string("designs/rbt-octahedral.toml").unwrap();
    let bad = good
        .replace("units =", "unit =")
        .replace("P3 = [12.0", "P3 = [nan")
        .replace("\"P6\"], [\"P1\"", "\"P6\"], [\"P9\"");
    let path = file(&folder, "bad.toml", bad.as_bytes());
    let error = refused(&path);
    assert_eq!(error["code"], "design::invalid");
    let codes: Vec<&str> =
        error["violations"].as_array().unwrap().iter().map(|v| v["code"].as_str().unwrap()).collect();
    assert_eq!(
        codes,
        ["design::missing_key", "design::unknown_key", "design::missing_joint", "design::non_finite"]
    );
    for key in ["line", "column", "message", "help"] {
        assert!(!error["violations"][1][key].is_null(), "{key}");
    }
    let out = equipod(&["fk", path.to_str().unwrap()]);
    let text = String::from_utf8(out.stderr).unwrap();
    assert_eq!((out.status.code(), out.stdout.len()), (Some(2), 0));
    assert!(text.contains("error[design::unknown_key]") && text.contains("bad.toml:3:1"), "{text}");
    assert!(text.contains("^^^^") && text.contains("did you mean `units`?"), "{text}");
    assert!(!text.contains('\u{1b}'), "no colours in a pipe");
}

#[test]
fn files_that_cannot_be_designs_are_refused_with_a_code() {
    let folder = tempfile::tempdir().unwrap();
    let huge = folder.path().join("huge.toml");
    std::fs::File::create(&huge).unwrap().set_len(1 << 30).unwrap();
    for (path, code) in [
        (folder.path().join("absent.toml"), "file::not_readable"),
        (folder.path().to_path_buf(), "file::is_directory"),
        (huge, "file::too_large"),
        (file(&folder, "latin1.toml", b"name = \"a\"\nunits = \"\xb5m\"\n"), "file::not_utf8"),
        (file(&folder, "empty.toml", b""), "design::invalid"),
        (file(&folder, "empty.json", b"\n"), "design::invalid"),
        (file(&folder, "deep.json", "[".repeat(1 << 21).as_bytes()), "design::invalid"),
        (file(&folder, "deep.toml", format!("a = {}", "[".repeat(1 << 21)).as_bytes()), "design::invalid"),
    ] {
        let error = refused(&path);
        assert_eq!(error["code"], code, "{}", path.display());
    }
    let latin = refused(&folder.path().join("latin1.toml"));
    assert!(latin["message"].as_str().unwrap().contains("line 2"));
}

#[cfg(unix)]
#[test]
fn an_endless_device_is_refused_after_the_limit() {
    assert_eq!(refused(Path::new("/dev/zero"))["code"], "file::too_large");
}

#[test]
fn usage_errors_obey_json_and_help_is_exit_0() {
    for args in
        [&["--json"][..], &["fk", "--json"], &["fk", "a.toml", "--metod", "x", "--json"], &["fly", "--json"]]
    {
        let out = equipod(args);
        assert_eq!(out.status.code(), Some(2), "{args:?}");
        assert_eq!(document(&out)["error"]["code"], "usage", "{args:?}");
    }
    let missing = document(&equipod(&["fk", "--json"]));
    assert!(missing["error"]["message"].as_str().unwrap().contains("<DESIGN>"), "{missing}");
    let out = equipod(&["fk", "--metod"]);
    assert_eq!((out.status.code(), out.stdout.len()), (Some(2), 0));
    let help = equipod(&["--help"]);
    assert_eq!(help.status.code(), Some(0));
    let help = String::from_utf8(help.stdout).unwrap();
    assert!(help.contains("Exit codes:") && help.contains("3  inconclusive"), "{help}");
    assert!(document(&equipod(&["--help", "--json"]))["help"].is_string());
}

#[test]
fn warnings_go_to_standard_error_and_into_the_document() {
    let folder = tempfile::tempdir().unwrap();
    let good = std::fs::read_to_string("designs/rbt-octahedral.toml").unwrap();
    let path =
        file(&folder, "spare.toml", good.replace("[platform]", "P8 = [1, 1, 1]\n[platform]").as_bytes());
    let path = path.to_str().unwrap();
    let json = folder.path().join("out.json");
    let json = json.to_str().unwrap();
    let out = equipod(&["design", "convert", path, "-o", json, "--json"]);
    assert_eq!(out.status.code(), Some(0));
    let answer = document(&out);
    assert_eq!(answer["warnings"][0]["code"], "design::unused_joint");
    assert!(String::from_utf8(out.stderr).unwrap().contains("warning[design::unused_joint]"));
    assert!(equipod(&["-q", "design", "convert", path, "-o", json]).stderr.is_empty());
}

#[test]
fn convert_there_and_back_keeps_the_design() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    assert_eq!(
        equipod(&["design", "convert", "designs/symmetric-hexapod.toml", "-o", &at("a.json")]).status.code(),
        Some(0)
    );
    assert_eq!(equipod(&["design", "convert", &at("a.json"), "-o", &at("b.toml")]).status.code(), Some(0));
    assert_eq!(equipod(&["design", "convert", &at("b.toml"), "-o", &at("c.json")]).status.code(), Some(0));
    let read = |name: &str| std::fs::read_to_string(at(name)).unwrap();
    assert_eq!(read("a.json"), read("c.json"));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 3, "no temporary file is left");
    let out = equipod(&["design", "convert", "designs/dietmaier.toml", "-o", &at("d.txt"), "--json"]);
    assert_eq!(document(&out)["error"]["code"], "convert::unknown_format");
    let out =
        equipod(&["design", "convert", "designs/dietmaier.toml", "-o", &at("no/such/d.toml"), "--json"]);
    assert_eq!(
        (out.status.code(), &document(&out)["error"]["code"]),
        (Some(2), &Value::from("file::not_writable"))
    );
}

#[cfg(unix)]
#[test]
fn a_closed_pipe_ends_quietly_and_a_full_disk_is_exit_4() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_equipod"))
        .args(["fk", "no-such.toml", "--json"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take()); // nobody reads
    let out = child.wait_with_output().unwrap();
    assert_eq!(out.status.code(), Some(2));
    assert!(!String::from_utf8(out.stderr).unwrap().contains("panicked"));
    if let Ok(full) = std::fs::OpenOptions::new().write(true).open("/dev/full") {
        let status = Command::new(env!("CARGO_BIN_EXE_equipod"))
            .args(["--version"])
            .args(["--json"])
            .stdout(full)
            .stderr(Stdio::null())
            .status()
            .unwrap();
        assert_eq!(status.code(), Some(4));
    }
}

#[cfg(unix)]
#[test]
fn a_design_may_come_through_a_pipe() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_equipod"))
        .args(["fk", "/dev/stdin", "--json"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(b"name = 3").unwrap();
    let out = child.wait_with_output().unwrap();
    assert_eq!(document(&out)["error"]["code"], "design::invalid");
}
