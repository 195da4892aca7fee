//! Designs that say exactly where their joints are, through the program.

use std::path::Path;
use std::process::Command;

use equipod::methods::design::{Exactness, Format, parse};
use equipod::prelude::Body;
use serde_json::Value;

/// The paper's octahedral platform, as it is meant.
const OCTAHEDRAL: &str = r#"name = "octahedral, exact"
units = "mm"
legs = [["P1", "P4"], ["P2", "P4"], ["P2", "P5"], ["P3", "P5"], ["P3", "P6"], ["P1", "P6"]]

[parameters]
edge = 12
height = "edge*sqrt(3)/2"

[base]
P1 = [0, 0, 0]
P2 = ["edge/2", "height", 0]
P3 = ["edge", 0, 0]

[platform]
P4 = [0.0, 0.0, 0.0]
P5 = ["edge/2", 0, 0]
P6 = ["edge/4", "-height/2", 0]

[home]
position = [3.0, 5.196152422706632, 15.0]
rpy_deg = [0.0, 0.0, 0.0]

[workspace]
translation = [1.0, 1.0, 1.0]
rotation_deg = [5.0, 5.0, 5.0]
"#;

fn run(folder: &Path, args: &[&str]) -> (Option<i32>, Value) {
    let out =
        Command::new(env!("CARGO_BIN_EXE_equipod")).current_dir(folder).args(args).arg("--json").output();
    let out = out.unwrap();
    let document = serde_json::from_slice(&out.stdout);
    (out.status.code(), document.unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(&out.stderr))))
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("octahedral.toml"), OCTAHEDRAL).unwrap();
    folder
}

#[test]
fn the_joint_free_platform_of_an_exact_design_is_proved_equivalent() {
    let folder = folder();
    let args = [
        "equivalents",
        "family",
        "octahedral.toml",
        "--pattern",
        "S123456",
        "--offsets=0.2,0.4,0.6,0.2,0.4,0.8",
        "-o",
        "free.toml",
    ];
    let (code, _) = run(folder.path(), &args);
    assert_eq!(code, Some(0));
    let text = std::fs::read_to_string(folder.path().join("free.toml")).unwrap();
    for line in
        ["[parameters]", "P2 = [\"edge/2\", \"height\", 0.0]", "Q1 = { on = [\"P1\", \"P2\"], t = 0.2 }"]
    {
        assert!(text.contains(line), "{line}\n{text}");
    }
    let (free, _) = parse(&text, Format::Toml).unwrap();
    for body in [Body::Base, Body::Platform] {
        assert!(free.exact_joints(body).iter().all(|joint| joint.exactness != Exactness::Interval));
    }
    let (code, map) = run(folder.path(), &["equivalents", "map", "octahedral.toml", "free.toml"]);
    // (1 - t) of all less t of all: 0.8 0.6 0.4 0.8 0.6 0.2 - 0.2 0.4 0.6 0.2 0.4 0.8
    assert_eq!(
        (code, map["det_exact"].as_str(), map["relation"].as_str()),
        (Some(0), Some("48/3125"), Some("equivalent"))
    );
    let (code, verified) = run(folder.path(), &["verify", "octahedral.toml", "free.toml", "--samples", "2"]);
    assert_eq!((code, verified["proved"].as_bool()), (Some(0), Some(true)), "{verified}");
    assert_eq!(verified["map"]["det_exact"], "48/3125");
    // rounded joints are another platform
    let rounded: String = OCTAHEDRAL.replace("\"height\"", "10.3923").replace("\"-height/2\"", "-5.19615");
    std::fs::write(folder.path().join("rounded.toml"), rounded).unwrap();
    let (_, map) = run(folder.path(), &["equivalents", "map", "rounded.toml", "free.toml"]);
    assert_eq!((map["det_exact"].as_str(), map["relation"].as_str()), (None, Some("unrelated")));
}

#[test]
fn conversion_keeps_what_a_design_says() {
    let folder = folder();
    let text = OCTAHEDRAL.replace("P6 = [\"edge/4\", \"-height/2\", 0]", "P6 = { mirror = \"M\", plane = \"xz\" }\nM = { on = [\"P4\", \"P7\"], offset = 6 }\nP7 = { turn = \"P5\", deg = 60 }");
    std::fs::write(folder.path().join("octahedral.toml"), &text).unwrap();
    let (code, _) = run(folder.path(), &["design", "convert", "octahedral.toml", "-o", "a.json"]);
    assert_eq!(code, Some(0));
    let (code, _) = run(folder.path(), &["design", "convert", "a.json", "-o", "b.toml"]);
    assert_eq!(code, Some(0));
    let read = |name: &str, format| {
        parse(&std::fs::read_to_string(folder.path().join(name)).unwrap(), format).unwrap().0
    };
    let (first, json, toml) =
        (read("octahedral.toml", Format::Toml), read("a.json", Format::Json), read("b.toml", Format::Toml));
    assert_eq!((&json, &toml), (&first, &first));
    assert!(toml.to_toml().contains("M = { on = [\"P4\", \"P7\"], offset = 6.0 }"));
    let m = first.exact_joints(Body::Platform);
    let place = first.platform_names().iter().position(|n| n == "P6").unwrap();
    assert_eq!(m[place].coordinates, ["3", "-3*sqrt(3)", "0"]);
}

#[test]
fn the_optimised_platform_has_its_joints_on_the_edges() {
    let folder = folder();
    let (code, answer) = run(folder.path(), &["optimize", "octahedral.toml", "-o", "best.toml"]);
    assert!(matches!(code, Some(0 | 3)), "{answer}");
    let text = std::fs::read_to_string(folder.path().join("best.toml")).unwrap();
    assert_eq!(text.matches("{ on = [").count(), 6, "{text}");
    let (_, map) = run(folder.path(), &["equivalents", "map", "octahedral.toml", "best.toml"]);
    assert_eq!(map["relation"], "equivalent");
    assert!(map["det_exact"].is_string(), "{}", map["explanation"]);
}

const LENGTHS: &str = "15.8,16.1,15.5,15.9,15.7,16.4";

/// The answer of `fk`.
fn solved(folder: &Path, design: &str, lengths: &str) -> (Option<i32>, Value) {
    let (code, answer) = run(folder, &["fk", design, "--lengths", lengths, "--method", "homotopy"]);
    (code, answer)
}

#[test]
fn poses_of_exact_designs_are_certified_and_counted_and_rounded_joints_are_another_platform() {
    let folder = folder();
    let args = ["equivalents", "family", "octahedral.toml", "--pattern", "S123456"];
    let offsets = ["--offsets=0.2,0.4,0.6,0.2,0.4,0.8", "-o", "free.toml"];
    assert_eq!(run(folder.path(), &[&args[..], &offsets[..]].concat()).0, Some(0));
    for design in ["octahedral.toml", "free.toml"] {
        let (code, answer) = solved(folder.path(), design, LENGTHS);
        assert_eq!(code, Some(0), "{design}: {answer}");
        let certified = answer["solutions"].as_array().unwrap().iter().filter(|r| r["certified"] == true);
        assert_eq!(certified.count(), 16, "{design}");
        assert!(["proved", "modular"].contains(&answer["completeness"].as_str().unwrap()), "{design}");
        if answer["completeness"] == "modular" {
            assert_eq!(
                (&answer["pose_count"]["finite"], &answer["pose_count"]["lengths"]),
                (&16.into(), &"given".into())
            );
        }
    }
    // the joints of the same platform as the nearest doubles
    let (exact, _) =
        parse(&std::fs::read_to_string(folder.path().join("free.toml")).unwrap(), Format::Toml).unwrap();
    let m = exact.manipulator();
    let names = |body: &str| -> Vec<String> { (0..6).map(|i| format!("{body}{i}")).collect() };
    let list = |names: &[String], joints: &[nalgebra::Point3<f64>]| -> String {
        names.iter().zip(joints).map(|(n, p)| format!("{n} = [{:?}, {:?}, {:?}]\n", p.x, p.y, p.z)).collect()
    };
    let pairs: Vec<String> = m.pairs().iter().map(|(a, b)| format!("[\"A{a}\", \"B{b}\"]")).collect();
    let text = format!(
        "name = \"rounded\"\nunits = \"mm\"\nlegs = [{}]\n[base]\n{}[platform]\n{}",
        pairs.join(", "),
        list(&names("A"), m.base_joints()),
        list(&names("B"), m.platform_joints())
    );
    std::fs::write(folder.path().join("rounded.toml"), text).unwrap();
    let (code, answer) = solved(folder.path(), "rounded.toml", LENGTHS);
    assert_eq!((code, answer["completeness"].as_str()), (Some(3), Some("unproved")), "{answer}");
    assert!(answer["pose_count"]["finite"].as_u64() > Some(16));
}

/// A corner at an angle whose cosine is no sum of square roots: joints on its sides are known between bounds, poses are certified for all of them, and none are counted.
#[test]
fn joints_known_between_bounds_are_certified_and_not_complete_by_counting() {
    let folder = folder();
    let args = ["equivalents", "family", "octahedral.toml", "--pattern", "S123456"];
    let offsets = ["--offsets=0.2,0.4,0.6,0.2,0.4,0.8", "-o", "free.toml"];
    assert_eq!(run(folder.path(), &[&args[..], &offsets[..]].concat()).0, Some(0));
    let free = std::fs::read_to_string(folder.path().join("free.toml")).unwrap();
    let place = "P3 = [\"edge\", 0.0, 0.0]";
    assert!(free.contains(place), "{free}");
    let enclosed = free.replace(place, "P3 = { radius = 12, angle_deg = 7, z = 0 }");
    std::fs::write(folder.path().join("enclosed.toml"), enclosed).unwrap();
    let (code, answer) = solved(folder.path(), "enclosed.toml", LENGTHS);
    let certified = answer["solutions"].as_array().unwrap().iter().filter(|r| r["certified"] == true);
    assert_eq!((code, certified.count()), (Some(3), 16), "{answer}");
    assert_eq!(answer["completeness"], "unproved");
    assert_eq!(answer["pose_count"]["undecided"], "joints_not_exact");
}

/// The symmetric hexapod is symmetric when its joints are copies of one, turned and mirrored.
#[test]
fn an_exact_symmetric_hexapod_has_its_28_poses() {
    let folder = tempfile::tempdir().unwrap();
    let body = |name: &str, x: i32, y: i32| {
        let turned =
            |i: usize, of: usize, deg: i32| format!("{name}{i} = {{ turn = \"{name}{of}\", deg = {deg} }}\n");
        let copies = [turned(3, 1, 120), turned(4, 2, 120), turned(5, 1, 240), turned(6, 2, 240)].concat();
        format!("{name}1 = [{x}, {y}, 0]\n{name}2 = {{ mirror = \"{name}1\", plane = \"xz\" }}\n{copies}")
    };
    let legs: Vec<String> = (1..7).map(|i| format!("[\"A{i}\", \"B{i}\"]")).collect();
    let text = format!(
        "name = \"hexapod\"\nunits = \"mm\"\nlegs = [{}]\n[base]\n{}[platform]\n{}",
        legs.join(", "),
        body("A", 9, 2),
        body("B", 4, 3)
    );
    std::fs::write(folder.path().join("hexapod.toml"), text).unwrap();
    let (code, answer) = solved(folder.path(), "hexapod.toml", LENGTHS);
    let certified = answer["solutions"].as_array().unwrap().iter().filter(|r| r["certified"] == true);
    assert_eq!((code, certified.count()), (Some(0), 28), "{answer}");
    assert!(["proved", "modular"].contains(&answer["completeness"].as_str().unwrap()));
    let (_, check) = run(folder.path(), &["check", "hexapod.toml"]);
    let count = &check["pose_count"];
    assert_eq!((&count["finite"], &count["lengths"]), (&28.into(), &"generic".into()));
    assert!(count["error_probability"].as_f64() < Some(1e-11));
}
