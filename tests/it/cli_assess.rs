//! `equipod assess` as a process: margins, exit codes, a trajectory in a file of its own.

use std::path::Path;

use serde_json::Value;

use super::cli_frame::{document, equipod};
use super::evidence::size;

/// The shipped octahedral design with more tables.
fn design(folder: &Path, tables: &str) -> String {
    let text = std::fs::read_to_string("designs/rbt-octahedral.toml").unwrap();
    let path = folder.join("design.toml");
    std::fs::write(&path, format!("{text}\n{tables}")).unwrap();
    path.to_str().unwrap().to_string()
}

fn assess(path: &str) -> (Option<i32>, Value) {
    let out = equipod(&["assess", path, "--points", "300", "--json"]);
    (out.status.code(), document(&out))
}

#[test]
fn margins_come_with_their_worst_poses_and_a_violation_is_a_no() {
    let folder = tempfile::tempdir().unwrap();
    let limits = "[hardware]\nleg_length = [10.0, 25.0]\nplatform_swing_deg = 40.0\n";
    let (code, doc) = assess(&design(folder.path(), limits));
    assert_eq!((code, doc["met"].as_bool()), (Some(0), Some(true)), "{doc}");
    let margins = doc["requirements"].as_array().unwrap();
    // the design asks for a least joint distance too, which needs no pose
    let codes: Vec<&str> = margins.iter().map(|m| m["name"].as_str().unwrap()).collect();
    assert_eq!(
        codes,
        ["leg_too_short", "leg_too_long", "platform_swing", "base_spacing", "platform_spacing"]
    );
    assert_eq!((&margins[3]["pose"], margins[2]["unit"].as_str()), (&Value::Null, Some("deg")));
    let spacing = margins[4]["margin"].as_f64().unwrap();
    assert!((spacing - 4.8).abs() < 1e-12, "edge 6, least distance 1.2: {spacing}");
    assert_eq!(margins[1]["pose"]["q"].as_array().unwrap().len(), 4);

    let (code, doc) = assess(&design(folder.path(), &limits.replace("25.0", "18.0")));
    assert_eq!((code, doc["met"].as_bool()), (Some(1), Some(false)));
    assert_eq!(
        (doc["requirements"][1]["met"].as_bool(), doc["requirements"][0]["met"].as_bool()),
        (Some(false), Some(true))
    );
}

/// The platform triangle has edges of 6, one of them to the last digit only.
#[test]
fn a_distance_equal_to_the_least_one_is_at_its_limit() {
    let folder = tempfile::tempdir().unwrap();
    let with = |least: &str| {
        let path = design(folder.path(), "");
        let text = std::fs::read_to_string(&path).unwrap();
        std::fs::write(
            &path,
            text.replace("min_joint_distance = 1.2", &format!("min_joint_distance = {least}")),
        )
        .unwrap();
        path
    };
    let platform = |doc: &Value| {
        let margin = doc["requirements"].as_array().unwrap().last().unwrap().clone();
        (margin["met"].as_bool(), margin["at_limit"].as_bool())
    };
    let (code, doc) = assess(&with("6.0"));
    assert_eq!((code, platform(&doc)), (Some(0), (Some(true), Some(true))), "{doc}");
    let text = String::from_utf8(equipod(&["assess", &with("6.0")]).stdout).unwrap();
    let row = text.lines().find(|l| l.starts_with("platform_spacing")).unwrap();
    assert!(row.starts_with("platform_spacing =") && !row.contains("-0.0"), "{text}");
    let (code, doc) = assess(&with("6.000000001"));
    assert_eq!((code, platform(&doc)), (Some(1), (Some(false), Some(false))), "{doc}");
    let (code, doc) = assess(&with("5.999999999"));
    assert_eq!((code, platform(&doc)), (Some(0), (Some(true), Some(false))), "{doc}");
}

#[test]
fn a_trajectory_stands_beside_the_design_and_its_bad_lines_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string("designs/rbt-octahedral.toml").unwrap();
    let text = text.replace(
        "translation = [2.0, 2.0, 2.0]\nrotation_deg = [10.0, 10.0, 10.0]",
        "trajectory = \"path.csv\"",
    );
    let path = folder.path().join("moved.toml");
    std::fs::write(&path, format!("{text}\n[hardware]\nleg_length = [10.0, 25.0]\n")).unwrap();
    let table = folder.path().join("path.csv");
    std::fs::write(&table, "x,y,z,roll,pitch,yaw\n3,5.2,15,0,0,0\n3,5.2,26,0,0,0\n").unwrap();
    let (code, doc) = assess(path.to_str().unwrap());
    assert_eq!(code, Some(1), "at z = 26 the legs are longer than 25: {doc}");
    std::fs::write(&table, "3,5.2,15,0,0,0\n3,5.2\n").unwrap();
    let (code, doc) = assess(path.to_str().unwrap());
    assert_eq!((code, doc["error"]["code"].as_str()), (Some(2), Some("design::bad_trajectory")));
    assert!(doc["error"]["message"].as_str().unwrap().contains("line 2"), "{doc}");
}

#[test]
fn a_design_that_requires_nothing_is_told_so() {
    let (code, doc) = assess("designs/dietmaier.toml");
    assert_eq!((code, doc["error"]["code"].as_str()), (Some(2), Some("assess::nothing_required")));
}

/// Version 0.1.0 said that the platform joints swing 0.2 degrees less than they may; a pose that its searches missed is 0.2 degrees beyond the limit.
#[test]
fn a_worst_pose_that_searches_miss_is_found_by_cells() {
    let path = "tests/fixtures/adversarial/REP_assess.toml";
    let cells = size("700", "1500");
    let out = equipod(&["assess", path, "--points", "0", "--searches", "0", "--cells", cells, "--json"]);
    let doc = document(&out);
    assert_eq!((out.status.code(), doc["met"].as_bool()), (Some(1), Some(false)), "{doc}");
    let margins = doc["requirements"].as_array().unwrap();
    let swing = margins.iter().find(|m| m["name"] == "platform_swing").unwrap();
    assert_eq!((swing["status"].as_str(), swing["met"].as_bool()), (Some("violated"), Some(false)));
    assert!(swing["margin"].as_f64().unwrap() < -0.15, "{swing}");
    if size(true, false) {
        return;
    }
    // six degrees more are enough, and these few cells prove it
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(path).unwrap();
    let wider = folder.path().join("wider.toml");
    std::fs::write(&wider, text.replace("platform_swing_deg = 16.926437", "platform_swing_deg = 22.926437"))
        .unwrap();
    let out = equipod(&["assess", wider.to_str().unwrap(), "--points", "50", "--json"]);
    let doc = document(&out);
    let margins = doc["requirements"].as_array().unwrap();
    let swing = margins.iter().find(|m| m["name"] == "platform_swing").unwrap();
    assert_eq!(swing["status"], "met", "{swing}");
    let bound = swing["proved_margin"].as_f64().unwrap();
    assert!(bound >= 0.0 && bound <= swing["margin"].as_f64().unwrap());
}

/// What is not proved is neither met nor violated.
#[test]
fn without_cells_the_design_is_not_called_met() {
    let folder = tempfile::tempdir().unwrap();
    let path = design(folder.path(), "[hardware]\nleg_length = [11.97, 20.64]\n");
    let out = equipod(&["assess", &path, "--points", "50", "--cells", "0", "--json"]);
    let doc = document(&out);
    assert_eq!((out.status.code(), doc["met"].is_null()), (Some(3), true), "{doc}");
    assert_eq!(doc["regular"]["status"], "undecided");
}

/// The same excursions listed from the base frame and from home are the same; when home is elsewhere only the latter move.
#[test]
fn poses_listed_from_home_move_with_it() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string("designs/rbt-octahedral.toml").unwrap();
    let margin = |home: &str, workspace: &str| {
        let start = text.find("[home]").unwrap();
        let path = folder.path().join("listed.toml");
        let tables = format!(
            "[home]\nposition = {home}\nrpy_deg = [0.0, 0.0, 0.0]\n[workspace]\n{workspace}\n[hardware]\nleg_length = [1.0, 40.0]\n"
        );
        std::fs::write(&path, format!("{}{tables}", &text[..start])).unwrap();
        let (code, doc) = assess(path.to_str().unwrap());
        assert_eq!(code, Some(0), "{doc}");
        doc["requirements"][1]["margin"].as_f64().unwrap()
    };
    let pose = |z: f64| format!("poses = [{{ position = [3.0, 5.0, {z:?}], rpy_deg = [0.0, 0.0, 0.0] }}]");
    let from_home =
        "relative_to = \"home\"\nposes = [{ position = [0.0, 0.0, 4.0], rpy_deg = [0.0, 0.0, 0.0] }]";
    let (low, high) = ("[3.0, 5.0, 15.0]", "[3.0, 5.0, 18.0]");
    assert!((margin(low, &pose(19.0)) - margin(low, from_home)).abs() < 1e-9);
    assert!((margin(high, &pose(22.0)) - margin(high, from_home)).abs() < 1e-9);
    assert!(
        (margin(high, &pose(19.0)) - margin(low, &pose(19.0))).abs() < 1e-9,
        "those of the base frame stay"
    );
    assert!((margin(high, from_home) - margin(low, from_home)).abs() > 1.0);
}

/// Over a wide workspace the cells do not decide the stiffness: the answer is undecided, with the least value found and a bound below it, and nothing is called met.
#[test]
fn a_stiffness_that_cells_do_not_decide_is_not_called_met() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string("designs/symmetric-hexapod.toml").unwrap();
    let path = folder.path().join("wide.toml");
    std::fs::write(&path, format!("{text}leg_stiffness = 1e4\n[stiffness]\nangular = 1e8\n")).unwrap();
    let words = ["assess", path.to_str().unwrap(), "--cells", "200"];
    let doc = document(&equipod(&[&words[..], &["--json"]].concat()));
    let rows = doc["requirements"].as_array().unwrap_or_else(|| panic!("{doc}"));
    let row = rows.iter().find(|r| r["name"] == "angular_stiffness").unwrap();
    assert_eq!((row["status"].as_str(), &doc["met"]), (Some("searched"), &Value::Null), "{doc}");
    let (found, proved) = (row["margin"].as_f64().unwrap(), row["proved_margin"].as_f64().unwrap());
    assert!(found > 0.0 && proved < 0.0, "{row}");
    let out = equipod(&words);
    let text = String::from_utf8(out.stdout).unwrap();
    assert_eq!(out.status.code(), Some(3), "{text}");
    assert!(text.lines().next().unwrap().contains("not all is proved: angular_stiffness"), "{text}");
    // on a single pose the same requirement is decided
    let home = text_of_home(&path);
    std::fs::write(&path, home).unwrap();
    let doc = document(&equipod(&[&words[..], &["--json"]].concat()));
    assert_eq!(doc["met"].as_bool(), Some(true), "{doc}");
}

/// A design without its workspace: home alone.
fn text_of_home(path: &std::path::Path) -> String {
    let text = std::fs::read_to_string(path).unwrap();
    let (before, after) = text.split_once("[workspace]").unwrap();
    format!("{before}{}", &after[after.find("[hardware]").unwrap()..])
}

/// The masses are a payload of 300 kg on legs of 1e5 N/mm; `motion` computes the same numbers at home by its own formulas.
#[test]
fn stiffness_and_frequency_have_rows_of_their_own() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string("designs/worked/positioner-octahedral.toml").unwrap();
    let path = folder.path().join("design.toml");
    let path = path.to_str().unwrap();
    // at home alone, where nothing has to be bounded between poses
    let (before, after) = text.split_once("[workspace]").unwrap();
    let hardware = &after[after.find("[hardware]").unwrap()..];
    let with = |linear: f64, hertz: f64| {
        let tables = format!(
            "\n[payload]\nmass = 300\ncenter = [0, 0, -150]\ninertia = [1.2e7, 1.2e7, 1.5e7]\n[stiffness]\nlinear = {linear}\nnatural_frequency = {hertz}\n"
        );
        std::fs::write(path, format!("{before}{hardware}{tables}")).unwrap();
        assess(path)
    };
    let (code, doc) = with(60000.0, 60.0);
    assert_eq!((code, doc["met"].as_bool()), (Some(0), Some(true)), "{doc}");
    let row = |doc: &Value, name: &str| {
        let rows = doc["requirements"].as_array().unwrap();
        rows.iter().find(|r| r["name"] == name).unwrap_or_else(|| panic!("{doc}")).clone()
    };
    let (linear, slow) = (row(&doc, "linear_stiffness"), row(&doc, "natural_frequency"));
    assert_eq!((linear["unit"].as_str(), slow["unit"].as_str()), (Some("force/mm"), Some("Hz")));
    assert_eq!(
        (&linear["between"][0], linear["legs"].as_array().unwrap().len()),
        (&Value::from("platform"), 6)
    );
    let moved = document(&equipod(&["motion", path, "--stiffness", "--json"]));
    let found = &moved["stiffness"];
    let near = |a: f64, b: &Value| (a / b.as_f64().unwrap() - 1.0).abs() < 1e-9;
    assert!(near(60000.0 + linear["margin"].as_f64().unwrap(), &found["linear"]), "{found}");
    assert!(near(60.0 + slow["margin"].as_f64().unwrap(), &found["natural"][0]["frequency_hz"]), "{found}");
    assert!(row(&doc, "natural_frequency")["proved_margin"].as_f64().unwrap() > 0.0);
    let (code, doc) = with(60000.0, 96.0);
    assert_eq!(
        (code, row(&doc, "natural_frequency")["status"].as_str()),
        (Some(1), Some("violated")),
        "{doc}"
    );
}
