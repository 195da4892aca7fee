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

/// Three designs at home: legs without masses, with masses, and without a payload. Forces at rest agree with motion.
#[test]
fn legs_weigh_the_same_in_compare_assess_and_motion() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string("designs/worked/positioner-octahedral.toml").unwrap();
    // at home alone and without further loads
    let (before, after) = text.split_once("[workspace]").unwrap();
    let hardware = &after[after.find("[hardware]").unwrap()..after.find("[[loads]]").unwrap()];
    let heavy = hardware.replacen(
        "[hardware]",
        "[hardware]\ncylinder_mass = 40\ncylinder_center = 120\nrod_mass = 15\nrod_center = 90",
        1,
    );
    let payload = "[payload]\nmass = 100\ncenter = [10, 0, -150]\ninertia = [1e6, 1e6, 1e6]\n";
    let units = "units = \"mm\"\nforce_units = \"N\"\nmass_units = \"kg\"";
    let written = |name: &str, tables: &str| {
        let path = folder.path().join(format!("{name}.toml")).to_str().unwrap().to_string();
        let head = before.replacen("units = \"mm\"", units, 1);
        let head = head.replacen("name = \"", &format!("name = \"{name} "), 1);
        std::fs::write(&path, format!("{head}{tables}")).unwrap();
        path
    };
    let light = written("light", &format!("{hardware}{payload}"));
    let whole = written("whole", &format!("{heavy}{payload}"));
    let legs = written("legs", &heavy);
    let (code, doc) = asked(&[&light, &whole, &legs, "--accelerate", "z:0"]);
    assert_eq!(code, Some(0), "{doc}");
    let figure = |k: usize, name: &str| doc["designs"][k][name].as_f64().unwrap();
    for k in 0..2 {
        let (rest, motion) = (figure(k, "force"), figure(k, "motion_force"));
        assert!((rest / motion - 1.0).abs() < 1e-9, "{k}: {rest} {motion}");
    }
    assert!(figure(1, "force") > 1.2 * figure(0, "force") && figure(2, "force") > 0.0);
    let list = |k: usize| -> Vec<&str> {
        doc["designs"][k]["assumptions"].as_array().unwrap().iter().map(|s| s.as_str().unwrap()).collect()
    };
    let massless = "The legs have no masses in [hardware]: they are assumed massless.";
    assert_eq!((list(0), list(1)), (vec![massless], vec![]));
    assert!(list(2).iter().any(|s| s.contains("platform is assumed massless")), "{:?}", list(2));
    assert!(doc["designs"][0]["assessment"]["assumptions"].is_null(), "the list stands once");
    let compared = ["compare", &light, &whole, "--points", "20"];
    let text = String::from_utf8(equipod(&compared).stdout).unwrap();
    assert_eq!(text.matches(massless).count(), 1, "{text}");
    assert!(text.contains(": The legs have no masses"), "with the name of the design: {text}");
    // assess says the same of each design
    let assessed = |path: &str| document(&equipod(&["assess", path, "--json"]));
    let row = |doc: &Value| {
        let rows = doc["requirements"].as_array().unwrap();
        rows.iter().find(|row| row["name"] == "leg_force").unwrap_or_else(|| panic!("{doc}")).clone()
    };
    for (k, path, between) in [(0, &light, "payload"), (1, &whole, "payload"), (2, &legs, "legs")] {
        let doc = assessed(path);
        let row = row(&doc);
        let force = 3000.0 - row["margin"].as_f64().unwrap();
        assert!((force / figure(k, "force") - 1.0).abs() < 1e-9, "{row}");
        assert_eq!(row["between"][1], between);
        let proved = row["proved_margin"].as_f64().unwrap();
        assert!(proved <= 3000.0 - figure(k, "force") + 1e-9 && proved > 0.0, "{row}");
    }
    assert_eq!(assessed(&light)["assumptions"], serde_json::json!([massless]));
    assert!(assessed(&whole)["assumptions"].is_null());
    let text = String::from_utf8(equipod(&["assess", &light]).stdout).unwrap();
    assert_eq!(text.matches(massless).count(), 1, "{text}");
}
