//! Standard input and output in the place of files, full disks, and names that would steer a terminal.

use std::io::Write;
use std::process::{Command, Output, Stdio};

use super::cli_frame::{document, equipod};

const DESIGN: &str = "designs/symmetric-hexapod.toml";

/// Runs with a text on standard input.
fn fed(args: &[&str], text: &[u8]) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_equipod"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(args)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // a command that refuses its input before reading it leaves the pipe closed
    let _ = child.stdin.take().unwrap().write_all(text);
    child.wait_with_output().unwrap()
}

#[test]
fn designs_and_tables_come_from_standard_input() {
    let toml = std::fs::read(DESIGN).unwrap();
    let lengths = |out: &Output| document(out)["lengths"].clone();
    let meant = lengths(&equipod(&["ik", DESIGN, "--json"]));
    assert_eq!(lengths(&fed(&["ik", "-", "--json"], &toml)), meant);
    let json = equipod(&["design", "convert", DESIGN, "-o", "-"]);
    assert_eq!(json.status.code(), Some(0));
    assert_eq!(lengths(&fed(&["ik", "-", "--json"], &json.stdout)), meant, "TOML");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("d.json");
    equipod(&["design", "convert", DESIGN, "-o", path.to_str().unwrap()]);
    assert_eq!(lengths(&fed(&["ik", "-", "--json"], &std::fs::read(&path).unwrap())), meant, "JSON");
    let rows = document(&fed(&["ik", DESIGN, "-", "--json"], b"0,0,350,0,0,0\n0,0,360,0,0,0\n"));
    assert_eq!(rows["rows"][0]["lengths"], meant);
    let out = fed(&["fk", DESIGN, "--lengths", "-", "--csv"], b"395,395,395,395,395,395\n");
    assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stderr));
    let points = std::fs::read("designs/tables/hexapod.csv").unwrap();
    assert_eq!(document(&fed(&["new", "--points", "-", "--json"], &points))["home"]["p"][2], 350.0);
    let both = document(&fed(&["ik", "-", "-", "--json"], &toml));
    assert_eq!(both["error"]["code"], "file::read_twice");
}

#[test]
fn files_go_to_standard_output() {
    let out =
        equipod(&["plot", "workspace", "designs/worked/bench-octahedral.toml", "--slice", "x,z", "-o", "-"]);
    assert!(
        out.stdout.starts_with(b"<svg") && out.stdout.ends_with(b"</svg>\n"),
        "the picture and nothing else"
    );
    let design = equipod(&["design", "presets", "bench-l16", "-o", "-"]);
    assert_eq!(design.status.code(), Some(0), "{}", String::from_utf8_lossy(&design.stderr));
    assert_eq!(
        String::from_utf8(design.stdout).unwrap(),
        std::fs::read_to_string("designs/presets/bench-l16.toml").unwrap()
    );
    let page = equipod(&["view", DESIGN, "-o", "-"]);
    assert!(page.stdout.starts_with(b"<!"), "{}", String::from_utf8_lossy(&page.stderr));
    let refused = |args: &[&str]| document(&equipod(args))["error"]["code"].clone();
    assert_eq!(refused(&["design", "convert", DESIGN, "-o", "-", "--json"]), "file::standard_output");
    let folder = equipod(&["export", DESIGN, "--to", "csv", "-o", "-"]);
    assert_eq!(folder.status.code(), Some(2), "several files are no one file");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_exit_4_and_a_closed_pipe_the_exit_of_the_answer() {
    let run = |args: &[&str], out: Stdio| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_equipod"));
        command.current_dir(env!("CARGO_MANIFEST_DIR")).args(args);
        command.stdout(out).stderr(Stdio::null()).status().unwrap().code()
    };
    let full = || Stdio::from(std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap());
    for args in [
        &["ik", DESIGN][..],
        &["ik", DESIGN, "--json"],
        &["--help"],
        &["--version"],
        &["fk", "--help"],
        &[],
        &["design", "presets"],
        &["design", "convert", DESIGN, "-o", "-"],
        &["design", "convert", DESIGN, "--json", "-o", "no-such-folder/x.toml"],
    ] {
        assert_eq!(run(args, full()), Some(4), "{args:?}");
    }
    assert_eq!(
        run(&["plot", "modes", "designs/rbt-octahedral.toml", "-o", "/dev/full"], Stdio::null()),
        Some(4)
    );
    for (args, code) in [
        (&["ik", DESIGN][..], 0),
        (&["--help"], 0),
        (&["check", "designs/rbt-midline.toml"], 1),
        (&["design", "convert", DESIGN, "-o", "-"], 0),
        (&["plot", "modes", "designs/rbt-octahedral.toml", "-o", "/dev/stdout"], 0),
    ] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_equipod"));
        command.current_dir(env!("CARGO_MANIFEST_DIR")).args(args);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
        drop(child.stdout.take());
        assert_eq!(child.wait().unwrap().code(), Some(code), "{args:?}");
    }
}

#[test]
fn names_do_not_steer_the_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("odd.toml");
    let text = std::fs::read_to_string("designs/rbt-octahedral.toml").unwrap();
    let odd = text.replacen("octahedral 12-6", "a\\u001b[31mb\\u202Ec\\u009b1m", 1);
    assert_ne!(odd, text);
    std::fs::write(&path, odd).unwrap();
    let file = path.to_str().unwrap();
    for args in [
        &["fk", file][..],
        &["fk", file, "--json"],
        &["check", file],
        &["check", file, "--json"],
        &["equivalents", "family", file],
        &["fk", file, "--lengths", "1"],
        &["explore", file, "--samples", "x\u{1b}[31m\u{202e}"],
        &["fk", "\u{1b}[31m\u{202e}.toml"],
    ] {
        let out = equipod(args);
        for stream in [out.stdout, out.stderr] {
            let text = String::from_utf8(stream).unwrap();
            let steering =
                |c: char| (c.is_control() && !"\n\t".contains(c)) || ('\u{202a}'..='\u{202e}').contains(&c);
            assert!(!text.contains(steering), "{args:?}: {text:?}");
        }
    }
}

#[test]
fn the_program_alone_says_what_it_does() {
    let alone = equipod(&[]);
    assert_eq!((alone.status.code(), alone.stdout), (Some(0), equipod(&["--help"]).stdout));
    let help = String::from_utf8(equipod(&["ik", "--help"]).stdout).unwrap();
    assert!(help.contains("equipod design presets"), "where designs come from: {help}");
}
