//! `equipod assess` as a process: margins, exit codes, a trajectory in a file of its own.

use std::path::Path;

use equipod::prelude::*;
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
    let limits = "[hardware]\nleg_length = [10.0, 25.0]\nplatform_cone_angle_deg = 40.0\n";
    let (code, doc) = assess(&design(folder.path(), limits));
    assert_eq!((code, doc["met"].as_bool()), (Some(0), Some(true)), "{doc}");
    let margins = doc["requirements"].as_array().unwrap();
    // the design asks for a least joint distance too, which needs no pose
    let codes: Vec<&str> = margins.iter().map(|m| m["name"].as_str().unwrap()).collect();
    assert_eq!(
        codes,
        ["min_leg_length", "max_leg_length", "platform_cone_angle", "base_spacing", "platform_spacing"]
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
    let row = text.lines().find(|l| l.starts_with("distance of platform joints")).unwrap();
    assert!(row.starts_with("distance of platform joints =at limit") && !row.contains("-0.0"), "{text}");
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

/// Version 0.1.0 gave an angle of the platform joints that was 0.2 degrees too small. A pose that its searches missed
/// is 0.2 degrees beyond the limit.
#[test]
fn a_worst_pose_that_searches_miss_is_found_by_cells() {
    let path = "tests/fixtures/adversarial/REP_assess.toml";
    let cells = size("700", "1500");
    let out = equipod(&["assess", path, "--points", "0", "--searches", "0", "--cells", cells, "--json"]);
    let doc = document(&out);
    assert_eq!((out.status.code(), doc["met"].as_bool()), (Some(1), Some(false)), "{doc}");
    let margins = doc["requirements"].as_array().unwrap();
    let cone_angle = margins.iter().find(|m| m["name"] == "platform_cone_angle").unwrap();
    assert_eq!((cone_angle["status"].as_str(), cone_angle["met"].as_bool()), (Some("violated"), Some(false)));
    assert!(cone_angle["margin"].as_f64().unwrap() < -0.15, "{cone_angle}");
    if size(true, false) {
        return;
    }
    // six degrees more are enough, and these few cells prove it
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(path).unwrap();
    let wider = folder.path().join("wider.toml");
    std::fs::write(
        &wider,
        text.replace("platform_cone_angle_deg = 16.926437", "platform_cone_angle_deg = 22.926437"),
    )
    .unwrap();
    let out = equipod(&["assess", wider.to_str().unwrap(), "--points", "50", "--json"]);
    let doc = document(&out);
    let margins = doc["requirements"].as_array().unwrap();
    let cone_angle = margins.iter().find(|m| m["name"] == "platform_cone_angle").unwrap();
    assert_eq!(cone_angle["status"], "met", "{cone_angle}");
    let bound = cone_angle["proved_margin"].as_f64().unwrap();
    assert!(bound >= 0.0 && bound <= cone_angle["margin"].as_f64().unwrap());
}

/// A requirement without a proof is neither met nor violated.
#[test]
fn without_cells_the_design_is_not_called_met() {
    let folder = tempfile::tempdir().unwrap();
    let path = design(folder.path(), "[hardware]\nleg_length = [11.97, 20.64]\n");
    let out = equipod(&["assess", &path, "--points", "50", "--cells", "0", "--json"]);
    let doc = document(&out);
    assert_eq!((out.status.code(), doc["met"].is_null()), (Some(3), true), "{doc}");
    assert_eq!(doc["regular"]["status"], "undecided");
}

/// The same excursions listed from the base frame and from home are the same; when home is elsewhere only the latter
/// move.
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

/// Over a wide workspace the cells do not decide the stiffness. The answer is undecided, with the least value found and
/// a bound below it, and nothing is called met.
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
    assert!(
        text.lines().next().unwrap().contains("not all is proved: stiffness against torque, minimum"),
        "{text}"
    );
    // on a single pose the same requirement is decided
    let home = text_of_home(path.to_str().unwrap());
    std::fs::write(&path, home).unwrap();
    let doc = document(&equipod(&[&words[..], &["--json"]].concat()));
    assert_eq!(doc["met"].as_bool(), Some(true), "{doc}");
}

/// A design with home as the only pose of its workspace.
fn text_of_home(path: &str) -> String {
    let text = std::fs::read_to_string(path).unwrap();
    let (before, after) = text.split_once("[workspace]").unwrap();
    let home = "relative_to = \"home\"\nposes = [{ position = [0, 0, 0], rpy_deg = [0, 0, 0] }]\n";
    format!("{before}[workspace]\n{home}{}", &after[after.find("[hardware]").unwrap()..])
}

/// The masses are a payload of 300 kg on legs of 1e5 N/mm; `motion` computes the same numbers at home by its own
/// formulas.
#[test]
fn stiffness_and_frequency_have_rows_of_their_own() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("design.toml");
    let path = path.to_str().unwrap();
    // at home alone, where nothing has to be bounded between poses
    let text = text_of_home("designs/worked/positioner-octahedral.toml");
    let with = |linear: f64, hertz: f64| {
        let tables = format!(
            "\n[payload]\nmass = 300\ncenter = [0, 0, -150]\ninertia = [1.2e7, 1.2e7, 1.5e7]\n[stiffness]\nlinear = {linear}\nnatural_frequency = {hertz}\n"
        );
        std::fs::write(path, format!("{text}{tables}")).unwrap();
        assess(path)
    };
    let (code, doc) = with(60000.0, 60.0);
    assert_eq!((code, doc["met"].as_bool()), (Some(0), Some(true)), "{doc}");
    let row = |doc: &Value, name: &str| {
        let rows = doc["requirements"].as_array().unwrap();
        rows.iter().find(|r| r["name"] == name).unwrap_or_else(|| panic!("{doc}")).clone()
    };
    let (linear, slow) = (row(&doc, "linear_stiffness"), row(&doc, "natural_frequency"));
    assert_eq!((linear["unit"].as_str(), slow["unit"].as_str()), (Some("N/mm"), Some("Hz")));
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

/// A fixture changed by `edit`, beside a copy of the original.
fn fixture(folder: &Path, name: &str, edit: impl Fn(String) -> String) -> String {
    let text = std::fs::read_to_string(format!("tests/fixtures/verdicts/{name}.toml")).unwrap();
    let path = folder.join(format!("{name}.toml"));
    std::fs::write(&path, edit(text)).unwrap();
    path.to_str().unwrap().to_owned()
}

/// Limits without a workspace were once called met, proved for every pose of the workspace.
#[test]
fn limits_without_a_workspace_are_assessed_at_home_by_every_command() {
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("page.html").to_str().unwrap().to_owned();
    let said_with = |code: i32, words: &[&str]| {
        let out = equipod(words);
        assert_eq!(out.status.code(), Some(code), "{words:?}: {}", String::from_utf8_lossy(&out.stderr));
        String::from_utf8(out.stdout).unwrap()
    };
    let said = |words: &[&str]| said_with(0, words);
    for name in ["no-workspace", "servo-no-workspace"] {
        let path = fixture(folder.path(), name, |text| text);
        // the page of cranks has a test of its own
        let view = vec!["view", &path, "-o", &page];
        let view = (name == "no-workspace").then_some(view);
        for words in [vec!["assess", &path], vec!["compare", &path]].into_iter().chain(view) {
            // of one pose nothing follows about the machine
            let text = said_with(if words[0] == "assess" { 3 } else { 0 }, &words);
            assert!(text.contains("at home; no workspace stated"), "{words:?}: {text}");
            assert!(!text.contains("pose of its workspace") && !text.contains("in the workspace"), "{text}");
            assert!(words[0] != "compare" || text.contains("met at home only"), "{text}");
        }
        let (_, doc) = assess(&path);
        assert_eq!((&doc["met"], &doc["workspace"]), (&Value::Null, &"none".into()), "{name}");
        assert!(doc["requirements"].as_array().unwrap().iter().all(|m| m["met"] == true), "{doc}");
        assert_eq!(
            (&doc["assessed_poses"]["stated"], &doc["assessed_poses"]["region"]),
            (&false.into(), &false.into())
        );
        assert!(doc["regular_explanation"].as_str().unwrap().starts_with("Home is not a singular pose"));
    }
    // with a workspace the same design says so, and one that is too wide is refused
    let with = |x: f64| {
        let workspace = format!("\n[workspace]\ntranslation = [{x:?}, {x:?}, {x:?}]\n");
        fixture(folder.path(), "no-workspace", |text| text + &workspace)
    };
    let text = said(&["assess", &with(1.0), "--points", "100"]);
    assert!(text.contains("proved for every pose of its workspace") && !text.contains("stated"), "{text}");
    let wide = equipod(&["assess", &with(40.0), "--points", "100", "--cells", "500"]);
    assert_eq!(wide.status.code(), Some(1));
}

/// It records both tips of every crank at many poses, which takes its time.
#[test]
fn the_page_of_cranks_without_a_workspace_says_that_none_is_stated() {
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("page.html").to_str().unwrap().to_owned();
    let path = fixture(folder.path(), "servo-no-workspace", |text| text);
    let out = equipod(&["view", &path, "-o", &page]);
    let text = String::from_utf8(out.stdout).unwrap();
    assert_eq!(out.status.code(), Some(0), "{text}");
    assert!(text.contains("at home; no workspace stated"), "{text}");
    assert!(!text.contains("pose of its workspace") && !text.contains("in the workspace"), "{text}");
}

#[test]
fn a_list_of_poses_is_assessed_at_these_poses_and_not_between_them() {
    let folder = tempfile::tempdir().unwrap();
    let listed = |poses: &str, more: &str| {
        let edit = |text: String| {
            format!("{text}\n[workspace]\nrelative_to = \"home\"\nposes = [{poses}]\n{more}\n")
        };
        let path = fixture(folder.path(), "no-workspace", edit);
        let out = equipod(&["assess", &path]);
        (String::from_utf8(out.stdout).unwrap(), assess(&path).1)
    };
    let poses =
        "{ position = [2, 0, 0], rpy_deg = [0, 0, 0] }, { position = [0, 2, 0], rpy_deg = [0, 0, 0] }";
    let (text, doc) = listed(poses, "");
    assert!(text.contains("at the 2 poses listed; poses between them are not assessed"), "{text}");
    assert!(
        text.contains(
            "No singular pose among the 2 poses listed: proved; poses between them are not assessed."
        )
    );
    assert!(!text.contains("every pose") && !text.contains("in the workspace"), "{text}");
    assert_eq!((&doc["met"], &doc["assessed_poses"]["listed"]), (&true.into(), &2.into()));
    assert_eq!(doc["workspace"], "listed_poses");
    assert_eq!(doc["assessed_poses"]["met_in_words"], "met at 2 poses");
    // beside a region both are named
    let (text, doc) = listed(poses, "translation = [1, 1, 1]");
    assert!(text.contains("for every pose of its workspace, with the 2 poses listed"), "{text}");
    assert_eq!((&doc["met"], &doc["workspace"]), (&true.into(), &"stated".into()));
    assert_eq!(doc["assessed_poses"]["met_in_words"], "met");
}

/// The nearest octahedral platform of two triangles had another characteristic length than the design it was made from,
/// and so another conditioning.
#[test]
fn what_is_made_from_a_design_keeps_its_characteristic_length() {
    let folder = tempfile::tempdir().unwrap();
    let start = "designs/rbt-octahedral.toml";
    let made = folder.path().join("made.toml").to_str().unwrap().to_owned();
    let offsets = "--offsets=0.2,0.8,0.3,0.7,0.1,0.8";
    let out = equipod(&["equivalents", "family", start, "--pattern", "S123456", offsets, "-o", &made]);
    assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stderr));
    let length = |path: &str| Design::load(path).unwrap().characteristic_length();
    assert!((length(&made) - length(start)).abs() < 1e-12);
    // joints inside the sides alone would give a shorter one
    let own = Design::load(&made).unwrap().manipulator().platform_rms_radius();
    assert!(own < 0.9 * length(start), "{own}");
    let (_, assessed) = assess(&made);
    let found = document(&equipod(&["compare", start, &made, "--points", "10", "--json"]));
    let compared = &found["designs"][1];
    assert_eq!(found["characteristic_length"].as_f64(), Some(length(start)));
    let value = |v: &Value| v.as_f64().unwrap();
    assert_eq!(compared["conditioning"], compared["assessment"]["conditioning"]["inverse_condition"]);
    // `assess` examined fewer poses here
    assert!(
        value(&compared["conditioning"]) <= value(&assessed["conditioning"]["inverse_condition"]) + 1e-12
    );
}

/// One length in one comparison: alone this design has another.
#[test]
fn designs_that_are_compared_have_one_characteristic_length() {
    let made = "tests/fixtures/verdicts/no-workspace.toml";
    let other = "designs/rbt-griffis-duffy.toml";
    let conditioning = |designs: &[&str]| {
        let doc = document(&equipod(&[&["compare", "--points", "5", "--json"], designs].concat()));
        let of = |d: &Value| d["conditioning"].as_f64().unwrap();
        let list: Vec<f64> = doc["designs"].as_array().unwrap().iter().map(of).collect();
        (list, doc["characteristic_length"].as_f64().unwrap())
    };
    let (alone, own) = conditioning(&[made]);
    let (first, again) = conditioning(&[made, other]);
    let (second, length) = conditioning(&[other, made]);
    assert_eq!((alone[0].to_bits(), own.to_bits()), (first[0].to_bits(), again.to_bits()));
    assert!((own - length).abs() > 1.0 && (second[1] - alone[0]).abs() > 1e-6, "{first:?} {second:?}");
    let text = String::from_utf8(equipod(&["compare", made, other, "--points", "5"]).stdout).unwrap();
    assert!(text.contains("Every conditioning uses one characteristic length"), "{text}");
}
