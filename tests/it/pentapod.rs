//! Designs of five legs on the command line: `check` and `fk` take them, all other commands say so.

use serde_json::Value;

use super::cli_frame::{document, equipod};

const LINE_PLANE: &str = "designs/pentapods/line-plane.toml";

fn answer(arguments: &[&str]) -> (Option<i32>, Value) {
    let out = equipod(&[arguments, &["--json"]].concat());
    (out.status.code(), document(&out))
}

/// The file with its two bodies exchanged, so that the base has the line.
fn exchanged(folder: &tempfile::TempDir) -> String {
    let text = std::fs::read_to_string(LINE_PLANE).unwrap();
    let text =
        text.replace("[base]", "[swap]").replace("[platform]", "[base]").replace("[swap]", "[platform]");
    let legs = (1..6).map(|i| format!("[\"B{i}\", \"A{i}\"]")).collect::<Vec<_>>().join(", ");
    let lines = text
        .lines()
        .map(|line| if line.starts_with("legs") { format!("legs = [{legs}]") } else { line.into() });
    let path = folder.path().join("exchanged.toml");
    std::fs::write(&path, lines.collect::<Vec<_>>().join("\n")).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn five_legs_hold_a_line_and_its_poses_have_the_lengths() {
    let (code, doc) = answer(&["fk", LINE_PLANE]);
    assert_eq!((code, &doc["poses"]["counted"], &doc["poses"]["real"]), (Some(0), &8.into(), &4.into()));
    assert_eq!((&doc["line"]["class"], &doc["line"]["body"]), (&"quartic".into(), &"platform".into()));
    let base = [[0.0, 0.0], [80.0, 0.0], [120.0, 60.0], [60.0, 120.0], [-20.0, 100.0]];
    let number = |x: &Value| x.as_f64().unwrap();
    for pose in doc["poses"]["poses"].as_array().unwrap().iter().filter(|pose| pose["real"] == true) {
        for i in 0..5 {
            let mark = number(&doc["line"]["marks"][i]) * number(&doc["line"]["length"]);
            let end =
                |k: usize| number(&pose["position"]["re"][k]) + mark * number(&pose["direction"]["re"][k]);
            let length =
                ((end(0) - base[i][0]).powi(2) + (end(1) - base[i][1]).powi(2) + end(2).powi(2)).sqrt();
            assert!((length - number(&doc["lengths"][i])).abs() < 1e-11, "{length}");
        }
    }
    // the same machine upside down has the same poses of the line
    let folder = tempfile::tempdir().unwrap();
    let (code, other) = answer(&["fk", &exchanged(&folder)]);
    assert_eq!((code, &other["line"]["body"]), (Some(0), &"base".into()));
    assert_eq!(other["poses"], doc["poses"]);
}

#[test]
fn check_names_the_class_the_locus_and_the_sixth_legs() {
    let (code, doc) = answer(&["check", LINE_PLANE]);
    assert_eq!((code, &doc["architecturally_singular"]), (Some(0), &false.into()));
    let locus = &doc["line"]["singular_poses"];
    assert_eq!(
        (&locus["degree"], &locus["degree_in_position"], &locus["family"]),
        (&3.into(), &2.into(), &"cubic".into())
    );
    assert_eq!(doc["sixth_legs"], serde_json::json!([{ "case": "off_the_line", "body": "platform" }]));
    // five joints of the base on a line as well: two lines hold nothing
    let text = std::fs::read_to_string(LINE_PLANE).unwrap();
    let flat = text
        .replace("60.0, 0.0]\nA4 = [60.0, 120.0", "0.0, 0.0]\nA4 = [60.0, 0.0")
        .replace("-20.0, 100.0", "-20.0, 0.0");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("flat.toml");
    std::fs::write(&path, flat).unwrap();
    let path = path.to_str().unwrap();
    let (code, doc) = answer(&["check", path]);
    assert_eq!((code, &doc["architecturally_singular"]), (Some(1), &true.into()));
    let (code, doc) = answer(&["fk", path]);
    assert!(code == Some(3) && doc["no_poses"].as_str().unwrap().contains("dependent"), "{doc}");
}

#[test]
fn five_legs_without_a_line_have_a_curve_of_poses_and_other_commands_want_six_legs() {
    let text = std::fs::read_to_string(LINE_PLANE).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bent.toml");
    std::fs::write(&path, text.replace("B5 = [120.0, 0.0", "B5 = [120.0, \"7/3\"")).unwrap();
    let path = path.to_str().unwrap();
    let (code, doc) = answer(&["check", path]);
    assert_eq!(
        (code, &doc["line"], &doc["architecturally_singular"]),
        (Some(0), &Value::Null, &false.into())
    );
    let to_the_line =
        serde_json::json!([{ "case": "to_the_line", "body": "platform", "legs": [1, 2, 3, 4] }]);
    assert_eq!(doc["sixth_legs"], to_the_line);
    let (code, doc) = answer(&["fk", path]);
    assert_eq!((code, &doc["error"]["code"]), (Some(2), &"fk::five_legs".into()));
    let (code, doc) = answer(&["assess", LINE_PLANE]);
    let violations = doc["error"]["violations"].to_string();
    assert!(code == Some(2) && violations.contains("take designs of five legs"), "{doc}");
    let (code, doc) = answer(&["fk", LINE_PLANE, "--lengths", "1,2,3"]);
    assert_eq!((code, &doc["error"]["code"]), (Some(2), &"fk::bad_lengths".into()));
    let (code, doc) = answer(&["fk", LINE_PLANE, "--method", "octic"]);
    assert_eq!((code, &doc["error"]["code"]), (Some(2), &"usage::no_effect".into()));
}

#[test]
fn six_legs_say_in_which_steps_they_are_solved() {
    let (_, doc) = answer(&["check", "designs/rbt-octahedral.toml"]);
    assert_eq!(doc["solvability"], serde_json::json!({ "quadratic": false, "placed_first": [] }));
    let text = std::fs::read_to_string(LINE_PLANE).unwrap();
    let six = text
        .replace("[\"A5\", \"B5\"]]", "[\"A5\", \"B5\"], [\"A6\", \"B6\"]]")
        .replace("lengths = [120.0, 110.0, 125.0, 130.0, 140.0]\n", "")
        .replace("\n[platform]", "A6 = [40.0, -40.0, 20.0]\n\n[platform]")
        + "B6 = [30.0, 30.0, 10.0]\n";
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("six.toml");
    std::fs::write(&path, six).unwrap();
    let (_, doc) = answer(&["check", path.to_str().unwrap()]);
    let part = &doc["solvability"]["placed_first"][0];
    assert_eq!(
        (&part["part"], &part["class"], &part["other_ends_in_plane"]),
        (&"line".into(), &"quartic".into(), &true.into())
    );
    // each pose of the line has two turns
    assert_eq!(doc["pose_count"]["finite"], 16);
}
