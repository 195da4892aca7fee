//! `equipod fk`: where the lengths come from, what is refused, and the fields of the document.

use crate::cli_frame::{document, equipod};

const DESIGN: &str = "designs/rbt-octahedral.toml";

fn refusal(args: &[&str]) -> String {
    let out = equipod(&[&["fk", DESIGN, "--json"], args].concat());
    assert_eq!(out.status.code(), Some(2), "{args:?}");
    document(&out)["error"]["code"].as_str().unwrap().to_string()
}

#[test]
fn lengths_that_are_none_are_refused() {
    for lengths in
        ["1,2,3", "1,2,3,4,5,6,7", "1,2,3,4,5,x", "1,2,3,4,5,inf", "1,2,3,4,5,-6", "7", "1,2,3,4,5,1e200"]
    {
        assert_eq!(refusal(&["--lengths", lengths]), "fk::bad_lengths", "{lengths}");
    }
    assert_eq!(refusal(&["--lengths=-1,2,3,4,5,6"]), "fk::bad_lengths");
    assert_eq!(refusal(&["--lengths", "no-such.csv"]), "file::not_readable");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lengths.csv");
    std::fs::write(&path, "l1,l2,l3,l4,l5,l6\n1,2,3,4,5,6\n1,2,3,4,5\n").unwrap();
    let out = equipod(&["fk", DESIGN, "--lengths", path.to_str().unwrap(), "--json"]);
    assert!(document(&out)["error"]["message"].as_str().unwrap().contains("line 3: 5 values instead of six"));
}

#[test]
fn a_design_without_lengths_needs_the_option() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bare.toml");
    let text = std::fs::read_to_string(DESIGN).unwrap();
    let bare: Vec<&str> = text.lines().filter(|l| !l.starts_with("lengths")).collect();
    std::fs::write(&path, bare.join("\n")).unwrap();
    let out = equipod(&["fk", path.to_str().unwrap(), "--json"]);
    assert_eq!(document(&out)["error"]["code"], "fk::no_lengths");
}

#[test]
fn unknown_methods_are_usage_errors() {
    assert_eq!(refusal(&["--method", "guess"]), "usage");
}
