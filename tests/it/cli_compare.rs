//! `equipod compare` as a process: figures side by side, the table and the page, refusals.

use serde_json::Value;

use super::cli_frame::{document, equipod};

const ONE: &str = "designs/rbt-octahedral.toml";
const OTHER: &str = "designs/rbt-griffis-duffy.toml";

fn asked(args: &[&str]) -> (Option<i32>, Value) {
    let out = equipod(&[&["compare"], args, &["--points", "20", "--json"]].concat());
    (out.status.code(), document(&out))
}

#[test]
fn designs_have_the_same_figures_in_answer_text_table_and_page() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    let (csv, html) = (path("compare.csv"), path("compare.html"));
    let (code, doc) = asked(&[ONE, OTHER, "--accuracy", "0.1,0.05", "--csv", &csv, "-o", &html]);
    assert_eq!((code, doc["designs"].as_array().unwrap().len()), (Some(0), 2), "{doc}");
    let figure = |k: usize, name: &str| doc["designs"][k][name].as_f64().unwrap();
    // shared joints have no distance of their own: the octahedral one has three joints a body
    assert!(figure(0, "base_spacing") > figure(1, "base_spacing"));
    assert!(figure(0, "joint_tolerance") > 0.0 && figure(0, "stroke") > 0.0);
    assert!(doc["designs"][0]["force"].is_null(), "no load, no force");
    let table = std::fs::read_to_string(&csv).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().map(|l| l.split(',').collect()).collect();
    let column = rows[0].iter().position(|c| *c == "stroke used [mm]").unwrap();
    assert_eq!(rows.len(), 3);
    assert_eq!(rows[1][column].parse::<f64>().unwrap().to_bits(), figure(0, "stroke").to_bits());
    let page = std::fs::read_to_string(&html).unwrap();
    assert_eq!(page.matches("data:image/svg+xml").count(), 2);
    assert_eq!(page.matches("<tr>").count(), 3);
    assert!(page.contains("script-src 'sha256-") && !page.contains("unsafe-inline"));
    assert!(page.contains(&format!("data-value=\"{}\"", figure(1, "stroke"))));
    let text = String::from_utf8(equipod(&["compare", ONE, OTHER, "--points", "20"]).stdout).unwrap();
    assert!(text.contains("conditioning") && !text.contains("greatest force"), "{text}");
}

#[test]
fn motions_and_units_are_taken_as_they_are_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("inches.toml").to_str().unwrap().to_string();
    let convert = ["design", "convert", ONE, "--units", "in", "-o", &path];
    assert_eq!(equipod(&convert).status.code(), Some(0));
    for (args, code) in [
        (vec![ONE, path.as_str()], "compare::units_differ"),
        (vec![ONE, "--sine", "up:1:1"], "compare::bad_manoeuvre"),
        (vec![ONE, "--accelerate", "x"], "compare::bad_manoeuvre"),
        (vec![ONE, "--accuracy", "0.1"], "compare::bad_accuracy"),
        (vec![ONE, "--accuracy", "0.1,-1"], "compare::bad_accuracy"),
    ] {
        let (exit, doc) = asked(&args);
        assert_eq!((exit, &doc["error"]["code"]), (Some(2), &Value::from(code)), "{args:?}: {doc}");
    }
    let (code, doc) = asked(&[ONE, "--sine", "z:0.5:1"]);
    assert_eq!(code, Some(0));
    assert!(doc["designs"][0]["motion_speed"].as_f64().unwrap() > 1.0);
    assert!(doc["designs"][0]["motion_force"].is_null(), "no payload, no force");
}
