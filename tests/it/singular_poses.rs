//! Singular poses as the commands see them: self-motions at a pose, a singular home pose, and motions through singular
//! poses.

use serde_json::Value;

use super::cli_frame::{document, equipod};

const FOLDER: &str = "tests/fixtures/verdicts";

fn file(name: &str) -> String {
    format!("{FOLDER}/{name}")
}

/// `singular motion` at a pose, without the search for other components.
fn at_pose(design: &str, pose: &str) -> (Option<i32>, Value) {
    let out = equipod(&["singular", "motion", design, "--pose", pose, "--sections", "0", "--json"]);
    (out.status.code(), document(&out))
}

/// Bifurcations, freedoms of first order that no motion has, turns about a line, translations on a sphere.
#[test]
fn platforms_that_move_at_a_singular_pose_are_seen_to_move() {
    for (name, pose, dimension, tangent, evidence, exit) in [
        ("borel-bricard.toml", "0,0,0,0,0,180", 1, 2, "traced", 3),
        ("similar-circle-doubles.toml", "home", 1, 3, "traced", 3),
        ("similar-circle-doubles.toml", "0,0,10,0,0,1", 1, 3, "traced", 3),
        ("collinear-platform.toml", "0,0,64,0,0,0", 1, 2, "common_line", 0),
        ("congruent.toml", "1,1,1,0,0,0", 2, 3, "traced", 0),
    ] {
        let (code, doc) = at_pose(&file(name), pose);
        let found = [&doc["dimension"], &doc["tangent_dimension"]].map(Value::as_u64);
        assert_eq!((code, found), (Some(exit), [Some(dimension), Some(tangent)]), "{name} {pose}: {doc}");
        assert_eq!(doc["evidence"], evidence, "{name}");
        assert!(doc["worst_length_error"].as_f64().unwrap() < 1e-13, "{name}");
        let curves = doc["curves"].as_array().unwrap();
        assert!((dimension == 1) != curves.is_empty(), "{name}");
        assert!(curves.iter().all(|c| c["end"] == "closed"), "{name}");
    }
}

#[test]
fn poses_that_hold_are_proved_to_be_isolated() {
    for (design, pose, evidence, tangent) in [
        ("designs/rbt-octahedral.toml", "home", "first_order", 0),
        ("borel-bricard.toml", "1,2,34.641016151377546,0,0,0", "first_order", 0),
        ("singular-home-octahedral.toml", "home", "second_order", 1),
        ("congruent.toml", "0,0,2,0,0,180", "second_order", 1),
    ] {
        let design = if design.contains('/') { design.to_owned() } else { file(design) };
        let (code, doc) = at_pose(&design, pose);
        assert_eq!((code, doc["dimension"].as_u64()), (Some(1), Some(0)), "{design}: {doc}");
        assert_eq!((&doc["evidence"], doc["tangent_dimension"].as_u64()), (&evidence.into(), Some(tangent)));
        let ball = |field: &str| doc["isolated"][field].as_f64().unwrap();
        assert!(ball("radius") > 1e-5 && ball("within") < 1e-9, "{doc}");
    }
}

/// The question is whether the platform moves at the pose, which the search for other components does not change.
#[test]
fn the_exit_code_is_about_the_pose_however_many_components_are_found() {
    same_with_sections("congruent.toml", "0,0,2,0,0,0", 0);
    same_with_sections("collinear-platform.toml", "0,0,64,0,0,0", 0);
}

/// Curves with joints as doubles have fewer points than the degree asks for, and stay traced.
#[test]
#[ignore = "evidence"]
fn a_motion_traced_alone_is_undecided_with_and_without_sections() {
    same_with_sections("similar-circle-doubles.toml", "home", 3);
}

/// The Borel-Bricard motion from a crossing of its curve: its sections have as many points as its degree counted modulo
/// random primes.
#[test]
fn components_are_accounted_for_by_the_counted_degree() {
    let file = file("borel-bricard.toml");
    let out = equipod(&["singular", "motion", &file, "--pose", "0,0,0,0,0,180", "--json"]);
    let doc = document(&out);
    assert_eq!((out.status.code(), &doc["components_accounted"]), (Some(0), &true.into()), "{doc}");
    let degrees = doc["complex_components"].as_array().unwrap().iter();
    assert_eq!(degrees.map(|c| c["degree"].as_u64().unwrap()).sum::<u64>(), 4);
}

/// One exit code with and without sections.
fn same_with_sections(name: &str, pose: &str, exit: i32) {
    for sections in ["0", "1"] {
        let args = ["singular", "motion", &file(name), "--pose", pose, "--sections", sections];
        let out = equipod(&args);
        let text = String::from_utf8(out.stdout).unwrap();
        assert!(text.contains("the platform moves at this pose"), "{text}");
        assert_eq!(out.status.code(), Some(exit), "{name}, {sections}: {text}");
    }
}

#[test]
fn a_motion_through_a_singular_pose_is_refused_with_the_pose() {
    let design = file("h22_through_singular.toml");
    let table = file("h22_yaw_to_110.csv");
    let out = equipod(&["motion", &design, &table, "--json"]);
    let doc = document(&out);
    let run = &doc["motions"][0];
    assert_eq!((out.status.code(), doc["met"].as_bool()), (Some(1), Some(false)));
    assert!((run["singular_at_s"].as_f64().unwrap() - 1.8).abs() < 1e-9, "{run}");
    assert_eq!((&run["regularity"], &run["singular_evidence"]), (&"singular".into(), &"sign_change".into()));
    let half = std::f64::consts::FRAC_1_SQRT_2;
    assert!((run["singular_pose"]["q"][3].as_f64().unwrap() - half).abs() < 1e-9, "{run}");
    let text = String::from_utf8(equipod(&["motion", &design, &table]).stdout).unwrap();
    assert!(
        text.contains("passes a singular pose") && text.contains("At 1.8 s the pose is singular"),
        "{text}"
    );
    // between instants too: one step over the singular pose
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let over = path("over.csv");
    std::fs::write(&over, "t,x,y,z,roll,pitch,yaw\n0,0,0,650,0,0,60\n1,0,0,650,0,0,101\n").unwrap();
    let out = equipod(&["motion", &design, &over, "--steps", "1", "--json"]);
    let doc = document(&out);
    assert_eq!(
        (out.status.code(), &doc["motions"][0]["singular_evidence"]),
        (Some(1), &"sign_change".into())
    );
    // the path that stops before is proved to be regular
    let before = path("before.csv");
    let lines: Vec<String> =
        std::fs::read_to_string(&table).unwrap().lines().take(19).map(str::to_owned).collect();
    std::fs::write(&before, lines.join("\n")).unwrap();
    let out = equipod(&["motion", &design, &before, "--json"]);
    let doc = document(&out);
    assert_eq!((out.status.code(), &doc["motions"][0]["regularity"]), (Some(0), &"proved".into()), "{doc}");
    // sines and accelerations are assessed by the same test
    let sine =
        |text: &str| document(&equipod(&["motion", &design, "--sine", text, "--json"]))["motions"][0].clone();
    let far = sine("yaw:100:1");
    let expected = (0.9_f64).asin() / std::f64::consts::TAU;
    assert!((far["singular_at_s"].as_f64().unwrap() - expected).abs() < 1e-9, "{far}");
    assert_eq!(sine("yaw:80:1")["regularity"], "proved");
    let start = ["motion", &design, "--accelerate", "z:100", "--about", "0,0,650,0,0,90", "--json"];
    assert_eq!(equipod(&start).status.code(), Some(1));
}

#[test]
fn a_singular_home_pose_is_said_at_once() {
    let design = file("singular-home-octahedral.toml");
    let out = equipod(&["check", &design, "--json"]);
    let doc = document(&out);
    assert_eq!((out.status.code(), &doc["architecturally_singular"]), (Some(1), &false.into()));
    assert_eq!(doc["singular_home"], "zero", "exact joints and an exact pose are decided");
    for command in ["explore", "optimize"] {
        let folder = tempfile::tempdir().unwrap();
        let output = folder.path().join("out.toml").to_str().unwrap().to_owned();
        let out = equipod(&[command, &design, "-o", &output, "--json"]);
        let doc = document(&out);
        assert_eq!(out.status.code(), Some(1), "{command}: {doc}");
        assert_eq!(doc["error"]["code"], format!("{command}::singular_home"));
        assert!(doc["error"]["message"].as_str().unwrap().contains("det J = 0"), "{doc}");
    }
    let new = |platform: &str| {
        equipod(&["new", "--corners", "0,0/12,0/6,10.4", platform, "--height", "9", "--json"])
    };
    let out = new("0,0/6,0/3,-5.2");
    assert_eq!((out.status.code(), document(&out)["singular_home"].is_null()), (Some(1), false));
    // a regular home is no news
    let out = new("3,0/9,5.2/3,5.2");
    assert_eq!((out.status.code(), document(&out)["singular_home"].is_null()), (Some(0), true));
    let doc = document(&equipod(&["check", "designs/rbt-octahedral.toml", "--json"]));
    assert!(doc["singular_home"].is_null());
}

/// Limits are about the sign of det J at home, which a singular home pose does not have.
#[test]
fn limits_of_a_singular_home_pose_are_refused() {
    let out = equipod(&["limits", &file("singular-home-octahedral.toml"), "--json"]);
    assert_eq!(
        (out.status.code(), &document(&out)["error"]["code"]),
        (Some(1), &"limits::singular_home".into())
    );
    let out = equipod(&["limits", "designs/rbt-octahedral.toml", "--json"]);
    assert_eq!(out.status.code(), Some(0));
}
