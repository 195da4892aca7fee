//! Designs at the boundary of the conditions of theorems, and answers that contradicted each other.

use std::fmt::Write as _;

use std::path::Path;

use serde_json::Value;

use crate::cli_frame::{asked, equipod};

fn verdict(name: &str) -> String {
    format!("{}/tests/fixtures/verdicts/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

fn written(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

/// Two regular hexagons, the platform rotated by `turn`; every joint is polar, a copy rotated or a mirror image. The
/// last joint has its own radius.
fn hexagons(turn: &str, last: &str) -> String {
    let mut text = String::from("name = \"hexagons\"\nunits = \"mm\"\nlegs = [");
    for i in 1..=6 {
        write!(text, "[\"A{i}\", \"B{i}\"], ").unwrap();
    }
    text += "]\n[base]\nA1 = { radius = 100, angle_deg = 0 }\nA2 = { radius = 100, angle_deg = 60 }\nA3 = { turn = \"A1\", deg = 120 }\n";
    text += "A4 = { radius = 100, angle_deg = 180 }\nA5 = { mirror = \"A3\", plane = \"xz\" }\nA6 = { mirror = \"A2\", plane = \"xz\" }\n[platform]\n";
    write!(
        text,
        "B1 = {{ radius = 60, angle_deg = \"{turn}\" }}\nB2 = {{ turn = \"B1\", deg = 60 }}\nB3 = {{ turn = \"B1\", deg = 120 }}\n"
    )
    .unwrap();
    text += "B4 = { turn = \"B1\", deg = 180 }\nB5 = { turn = \"B1\", deg = 240 }\n";
    writeln!(text, "B6 = {{ radius = \"{last}\", angle_deg = \"{turn} + 300\" }}").unwrap();
    text + "[home]\nposition = [0, 0, 90]\nrpy_deg = [0, 0, 0]\n"
}

#[test]
fn joints_at_usual_angles_are_exact_and_singular_designs_of_them_have_no_generic_pose() {
    let folder = tempfile::tempdir().unwrap();
    for turn in ["15", "18", "36", "22.5", "11.25", "10", "5", "3"] {
        let path = written(folder.path(), "turned.toml", &hexagons(turn, "60"));
        let (_, check) = asked(&["check", &path]);
        assert_eq!(check["joints"]["exactness"], "field", "{turn}: {}", check["joints"]);
        assert_eq!(check["pose_count"]["finite"], 0, "{turn}: {}", check["pose_count"]);
        let path = written(folder.path(), "regular.toml", &hexagons(turn, "61"));
        let (_, check) = asked(&["check", &path]);
        assert_ne!(check["pose_count"]["finite"], 0, "{turn}: {}", check["pose_count"]);
    }
    // an angle whose field is too large: nothing is counted
    let path = written(folder.path(), "enclosed.toml", &hexagons("7", "60"));
    let (_, check) = asked(&["check", &path]);
    assert_eq!(check["joints"]["exactness"], "interval");
    assert_eq!(check["pose_count"]["undecided"], "joints_not_exact");
}

#[test]
fn no_design_is_made_of_the_primes_by_which_it_is_judged() {
    let path = verdict("primes_seed1");
    let counts = ["1", "2", "3"].map(|seed| asked(&["check", &path, "--seed", seed]).1["pose_count"].clone());
    for count in &counts {
        assert_eq!(count["finite"], 24, "{count}");
    }
    assert_ne!(counts[0]["primes"], counts[1]["primes"]);
    // the same seed and another design
    let (_, other) = asked(&["check", "designs/rbt-octahedral.toml", "--seed", "1"]);
    assert_eq!(other["pose_count"]["finite"], 16);
    assert_ne!(counts[0]["primes"], other["pose_count"]["primes"]);
    assert_eq!(counts[0], asked(&["check", &path, "--seed", "1"]).1["pose_count"], "nothing else is random");
}

#[test]
fn the_chance_of_special_sections_is_in_the_probability_of_error() {
    let (_, moving) = asked(&["fk", &verdict("congruent")]);
    assert_eq!(moving["solution_set"], "positive_dimensional", "{moving}");
    let error = |answer: &Value| answer["pose_count"]["error_probability"].as_f64().unwrap_or(1.0);
    assert!(error(&moving) > 2f64.powi(-60) && error(&moving) < 1e-9, "{}", moving["pose_count"]);
    // without sections the primes alone decide
    let far = "3e16,3.1e16,3.2e16,3.3e16,3.4e16,3.5e16";
    let (_, isolated) = asked(&["fk", "designs/dietmaier.toml", "--lengths", far]);
    assert!(error(&isolated) < 1e-17, "{}", isolated["pose_count"]);
}

#[test]
fn expressions_are_long_or_wrong_and_that_is_what_is_said() {
    let (code, check) = asked(&["check", &verdict("long-expression")]);
    assert_ne!(code, Some(2), "{check}");
    assert_eq!(check["joints"]["exactness"], "field", "{}", check["joints"]);
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(verdict("primes_seed1")).unwrap();
    let long = format!("0{}", "+0".repeat(1001));
    for (wrong, says) in [("6*sqrt(3", "a parenthesis is not closed"), (long.as_str(), "2000 characters")] {
        let path = written(folder.path(), "wrong.toml", &text.replacen("\"6\"", &format!("\"{wrong}\""), 1));
        let (code, answer) = asked(&["check", &path]);
        let errors = answer["error"].to_string();
        assert_eq!(code, Some(2), "{answer}");
        assert!(errors.contains(says) && !errors.contains("too far out"), "{errors}");
    }
}

#[test]
fn joints_are_called_coincident_when_they_are_exactly_at_one_place() {
    let folder = tempfile::tempdir().unwrap();
    let warned = |p7: &str| {
        let text = format!(
            "name = \"x\"\nunits = \"m\"\n\
             legs = [[\"P1\",\"P4\"],[\"P2\",\"P4\"],[\"P2\",\"P5\"],[\"P3\",\"P5\"],[\"P3\",\"P6\"],[\"P7\",\"P6\"]]\n\
             [base]\nP1 = [0, 0, 0]\nP7 = {p7}\nP2 = [6, 10, 0]\nP3 = [12, 0, 0]\n\
             [platform]\nP4 = [0, 0, 0]\nP5 = [6, 0, 0]\nP6 = [3, -5, 0]\n"
        );
        let out = equipod(&["check", &written(folder.path(), "joints.toml", &text)]);
        assert_ne!(out.status.code(), Some(2), "{p7}");
        String::from_utf8_lossy(&out.stderr).contains("P1 and P7 have the same coordinates")
    };
    assert!(warned("[0, 0, -0.0]"));
    assert!(warned("[\"sqrt(2) + sqrt(3) - sqrt(5 + 2*sqrt(6))\", 0, 0]"));
    assert!(!warned("[\"1/10^40\", 0, 0]"), "near by, by less than doubles tell");
    assert!(!warned("[0, \"sqrt(2) - 14142135623730950488/10^19\", 0]"));
}

#[test]
fn a_motion_within_rounding_is_not_established_beside_a_finite_count() {
    let folder = tempfile::tempdir().unwrap();
    // two equal legs to one place, by the lengths of a pose and one of them a unit in the last place longer
    let text = |second: f64| {
        format!(
            "name = \"x\"\nunits = \"m\"\nlengths = [5.0, 5.0, 5.0, {second:?}, 7.0, 6.0]\n\
             legs = [[\"A\", \"P\"], [\"B\", \"Q\"], [\"C\", \"Q\"], [\"D\", \"Q\"], [\"B\", \"R\"], [\"C\", \"P\"]]\n\
             [base]\nA = [0, 0, 0]\nB = [-3, 0, 0]\nC = [3, 0, 0]\nD = [0, 0, 0]\n[platform]\nP = [1, 2, 0]\nQ = [0, 0, 0]\nR = [2, 0, 1]\n"
        )
    };
    for (second, established) in [(4.0, true), (4f64.next_up(), false)] {
        let path = written(folder.path(), "line.toml", &text(second));
        let (_, answer) = asked(&["fk", &path]);
        assert_eq!(answer["solution_set"], "positive_dimensional", "{answer}");
        assert_eq!(answer["dimension_established"], established, "{answer}");
        assert_eq!(answer["pose_count"]["finite"].is_u64(), !established, "{}", answer["pose_count"]);
    }
}

#[test]
fn lengths_far_beyond_the_design_are_no_self_motion() {
    let lengths = "3e16,3.1e16,3.2e16,3.3e16,3.4e16,3.5e16";
    let (code, answer) = asked(&["fk", "designs/dietmaier.toml", "--lengths", lengths]);
    assert_eq!((code, &answer["solution_set"]), (Some(3), &"isolated".into()), "{answer}");
    assert_eq!(answer["completeness"], "unproved");
    assert!(answer["pose_count"]["finite"].as_u64() > Some(0), "{}", answer["pose_count"]);
}

#[test]
fn bodies_of_very_different_size_are_undecided_at_once() {
    let start = std::time::Instant::now();
    let (code, answer) = asked(&["fk", &verdict("ratio-2e40")]);
    assert_eq!((code, &answer["solution_set"]), (Some(3), &"isolated".into()), "{answer}");
    assert_eq!(answer["pose_count"]["finite"], 40, "{}", answer["pose_count"]);
    assert!(start.elapsed().as_secs() < 20, "thirty seconds of paths before");
}
