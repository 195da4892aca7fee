//! The process `equipod fk`: exit codes, one JSON document, the separation of the streams.

use std::process::{Command, Output};

fn equipod(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_equipod"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(args)
        .output()
        .unwrap()
}

#[test]
fn a_missing_design_is_one_json_document_and_exit_2() {
    let out = equipod(&["fk", "no-such.toml", "--json"]);
    assert_eq!(out.status.code(), Some(2));
    let document: serde_json::Value = serde_json::from_slice(&out.stdout).unwrap();
    assert_eq!(document["schema_version"], 1);
    assert_eq!(document["error"]["code"], "file::not_readable");
}
