//! `equipod build tolerances` as a process: the budget, its trial, refusals.

use serde_json::Value;

use super::cli_frame::{document, equipod};

fn run(design: &str, more: &[&str]) -> (Option<i32>, Value) {
    let mut args = vec!["build", "tolerances", design, "--json", "--points", "40", "--trials", "200"];
    args.extend(more);
    let out = equipod(&args);
    (out.status.code(), document(&out))
}

#[test]
fn the_budget_holds_for_random_errors_and_breaks_beyond() {
    let design = "designs/rbt-octahedral.toml";
    let (code, doc) = run(design, &["--bound", "0.01,0.1", "--tool", "3,-1.7,2"]);
    assert_eq!(code, Some(0), "{doc}");
    let number = |v: &Value| v.as_f64().unwrap();
    let radius = number(&doc["all_joints_radius"]["value"]);
    assert!(radius > 0.0 && radius < 0.01, "{radius}");
    let joints = doc["joints"].as_array().unwrap();
    assert_eq!(joints.len(), 6, "shared joints are one joint each");
    assert!(joints.windows(2).all(|w| number(&w[0]["alone"]["value"]) <= number(&w[1]["alone"]["value"])));
    for j in joints {
        assert!(number(&j["alone"]["value"]) > radius);
        assert_eq!(
            (j["along_axes"].as_array().unwrap().len(), j["largest_product"].as_array().unwrap().len()),
            (3, 3)
        );
    }
    assert_eq!(doc["trials"]["within_bound"], 200);
    let share = |e: &Value| (number(&e["position"]) / 0.01).max(number(&e["rotation_deg"]) / 0.1);
    assert!((share(&doc["worst_errors"]["in_budget"]) - 1.0).abs() < 0.02, "{doc}");
    assert!((share(&doc["worst_errors"]["times_1_5"]) - 1.5).abs() < 0.05);
    // one Newton step squares the error
    assert!(number(&doc["trials"]["after_one_step"]["position"]["max"]) < 1e-4);
    assert!(number(&doc["trials"]["after_two_steps"]["position"]["max"]) < 1e-8);
}

#[test]
fn the_text_names_the_most_critical_joint_first() {
    let args = [
        "build",
        "tolerances",
        "designs/rbt-octahedral.toml",
        "--bound",
        "0.01,0.1",
        "--points",
        "20",
        "--trials",
        "20",
    ];
    let out = equipod(&args);
    let text = String::from_utf8(out.stdout).unwrap();
    assert!(text.contains("position mm/mm") && text.contains("20 within the required accuracy"), "{text}");
    assert!(text.contains("after one Newton step"), "{text}");
}

#[test]
fn bad_bounds_and_singular_workspaces_are_refused_with_a_reason() {
    for bound in ["0.01", "0.01,0", "0.01,nan", "a,b", "-1,1"] {
        let (code, doc) = run("designs/rbt-octahedral.toml", &["--bound", bound]);
        assert_eq!(code, Some(2), "{bound}: {doc}");
    }
    let (code, doc) = run("designs/rbt-midline.toml", &["--bound", "0.01,0.1"]);
    assert_eq!((code, doc["error"]["code"].as_str()), (Some(1), Some("tolerances::singular_workspace")));
}

#[test]
#[ignore = "evidence"]
fn the_map_of_errors_has_every_cause_at_every_pose() {
    let design = "designs/rbt-octahedral.toml";
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("map.csv").to_str().unwrap().to_owned();
    let more = ["--bound", "0.01,0.1", "--joint-error", "0.001", "--length-error", "0.002"];
    let (code, doc) = run(design, &[&more[..], &["--growth", "1e-5,1e-5,1e-5", "--map", &path]].concat());
    assert_eq!(code, Some(0), "{doc}");
    let (map, number) = (&doc["map"], |v: &Value| v.as_f64().unwrap());
    let position = &map["position"];
    let parts: Vec<f64> = ["joints", "lengths", "growth"].iter().map(|k| number(&position[*k])).collect();
    assert!(number(&position["greatest"]) <= parts.iter().sum::<f64>() * (1.0 + 1e-12));
    assert!(parts.iter().all(|p| *p > 0.0 && *p <= number(&position["greatest"])));
    assert!(number(&map["rotation_deg"]["growth"]) < 1e-9, "growth as a whole turns nothing");
    let text = std::fs::read_to_string(&path).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 1 + map["poses"].as_u64().unwrap() as usize);
    assert!(
        lines[0].contains(",position_by_lengths_") && lines[0].ends_with("rotation_by_growth_deg"),
        "{}",
        lines[0]
    );
    // without errors of its own the map is that of the budget
    let (_, doc) = run(design, &["--bound", "0.01,0.1", "--length-error", "0"]);
    assert_eq!(doc["map"]["joint_error"], doc["all_joints_radius"]["value"]);
    assert!(number(&doc["map"]["position"]["greatest"]) <= 0.01 * (1.0 + 1e-9));
    let (code, doc) = run(design, &["--bound", "0.01,0.1", "--length-error", "-1"]);
    assert_eq!((code, doc["error"]["code"].as_str()), (Some(2), Some("tolerances::bad_error")));
}
