//! Every document names the inputs that it was made from.

use equipod::records::sha256;
use serde_json::{Value, json};

use super::cli_frame::{document, equipod};

const OCTAHEDRAL: &str = "designs/rbt-octahedral.toml";
const MIDLINE: &str = "designs/rbt-midline.toml";

fn answer(args: &[&str]) -> Value {
    document(&equipod(&[args, &["--json"]].concat()))
}

fn hash(path: &str) -> String {
    sha256(&std::fs::read(path).unwrap())
}

#[test]
fn designs_have_name_path_and_the_hash_of_their_bytes_in_the_order_given() {
    let of = |args: &[&str]| answer(args)["provenance"].clone();
    let design = |name: &str, path: &str| json!({"name": name, "path": path, "sha256": hash(path)});
    let made = of(&["equivalents", "map", MIDLINE, OCTAHEDRAL]);
    let both = json!([
        design("midline Griffis-Duffy 12-6 (singular)", MIDLINE),
        design("octahedral 12-6", OCTAHEDRAL)
    ]);
    assert_eq!((&made["designs"], &made["files"]), (&both, &json!([])));
    assert_eq!(made["version"], env!("CARGO_PKG_VERSION"));
    // the same file in another notation is another text
    let folder = tempfile::tempdir().unwrap();
    let other = folder.path().join("other.json");
    let other = other.to_str().unwrap();
    assert_eq!(equipod(&["design", "convert", OCTAHEDRAL, "-o", other]).status.code(), Some(0));
    assert_eq!(of(&["check", other])["designs"], json!([design("octahedral 12-6", other)]));
}

#[test]
fn the_seed_is_there_where_a_computation_was_given_one() {
    let seed = |args: &[&str]| answer(args)["provenance"]["seed"].clone();
    assert_eq!(seed(&["fk", OCTAHEDRAL, "--seed", "9"]), 9);
    assert_eq!(seed(&["design", "presets", "--seed", "9"]), Value::Null);
}

#[test]
fn other_texts_that_were_read_are_listed_apart_and_refusals_say_what_they_read() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("lengths.csv");
    let path = table.to_str().unwrap();
    std::fs::write(&table, "l1,l2,l3,l4,l5,l6\n18,18,17,16,15,19\n").unwrap();
    let made = answer(&["fk", OCTAHEDRAL, "--lengths", path])["provenance"].clone();
    assert_eq!(made["files"], json!([{"path": path, "sha256": hash(path)}]));
    assert_eq!(made["designs"].as_array().unwrap().len(), 1);
    // a table is no design
    let refused = answer(&["check", path]);
    assert_eq!(refused["error"]["code"], "design::invalid");
    assert_eq!(
        (&refused["provenance"]["designs"], &refused["provenance"]["files"]),
        (&json!([]), &made["files"])
    );
    assert_eq!(answer(&["fk"])["provenance"]["version"], env!("CARGO_PKG_VERSION"));
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let args = ["check", OCTAHEDRAL, "--seed", "3", "--json"];
    assert_eq!(equipod(&args).stdout, equipod(&args).stdout);
}
