//! Verdicts that a script can ask for. Is the workspace safe? How well is a pose conditioned? Is a platform singular?
//! Are all poses of a path found?

use std::fmt::Write as _;
use std::path::Path;

use equipod::prelude::*;
use serde_json::Value;

use super::cli_frame::{document, equipod};
use super::evidence::size;

/// The octahedral example with a workspace of its own.
fn with_workspace(folder: &Path, name: &str, widths: [f64; 6]) -> String {
    let text = std::fs::read_to_string("designs/rbt-octahedral.toml").unwrap();
    let (head, tail) = text.split_once("[workspace]").unwrap();
    let rest = tail.split_once("[optimize]").unwrap().1;
    let [x, y, z, rx, ry, rz] = widths;
    let workspace = format!(
        "[workspace]\ntranslation = [{x:?}, {y:?}, {z:?}]\nrotation_deg = [{rx:?}, {ry:?}, {rz:?}]\n"
    );
    let path = folder.join(name);
    std::fs::write(&path, format!("{head}{workspace}\n[optimize]{rest}")).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
#[ignore = "evidence"]
fn singular_poses_says_whether_the_workspace_is_safe() {
    let folder = tempfile::tempdir().unwrap();
    let cases = [
        ("small.toml", [1.0, 1.0, 1.0, 5.0, 5.0, 5.0], 0),
        ("large.toml", [10.0, 10.0, 10.0, 60.0, 60.0, 100.0], 1),
    ];
    for (name, widths, code) in cases {
        let path = with_workspace(folder.path(), name, widths);
        let out = equipod(&["singular", "poses", &path, "--json"]);
        assert_eq!(
            (out.status.code(), &document(&out)["regular"]["met"]),
            (Some(code), &Value::Bool(code == 0))
        );
        // assess has a row for it and agrees
        let out = equipod(&["assess", &path, "--points", "50", "--json"]);
        let answer = document(&out);
        assert_eq!((out.status.code(), &answer["regular"]["met"]), (Some(code), &Value::Bool(code == 0)));
        assert_eq!(answer["met"], code == 0);
    }
    // the region asked about goes before the workspace of the file
    let small = with_workspace(folder.path(), "again.toml", [1.0, 1.0, 1.0, 5.0, 5.0, 5.0]);
    let out = equipod(&["singular", "poses", &small, "--box", "10,10,10,60,60,100", "--json"]);
    assert_eq!((out.status.code(), &document(&out)["regular"]["met"]), (Some(1), &Value::Bool(false)));
}

#[test]
fn a_pose_has_one_conditioning_whatever_command_is_asked() {
    let folder = tempfile::tempdir().unwrap();
    let path = with_workspace(folder.path(), "home.toml", [0.0; 6]);
    let design = Design::load(&path).unwrap();
    let m = design.manipulator();
    let home = design.home_or_default();
    let j = equipod::methods::manipulator::jacobian(m, &home, design.characteristic_length());
    let expected = equipod::methods::manipulator::inverse_condition(&j);
    let assess = document(&equipod(&["assess", &path, "--points", "0", "--json"]));
    let poses = document(&equipod(&["singular", "poses", &path, "--cells", "10", "--json"]));
    let lengths = home.lengths(m).unwrap().get().map(|l| l.to_string()).join(",");
    let near = document(&equipod(&["fk", &path, "--near", "home", "--lengths", &lengths, "--json"]));
    for found in [
        &assess["conditioning"]["inverse_condition"],
        &poses["pose"]["inverse_condition"],
        &near["near"]["inverse_condition"],
    ] {
        let found = found.as_f64().unwrap();
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
    }
}

#[test]
fn a_singular_member_of_the_family_is_refused_as_by_move() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("member.toml");
    let path = file.to_str().unwrap();
    let member = |offsets: &str| {
        let design = "designs/rbt-octahedral.toml";
        let offsets = format!("--offsets={offsets}");
        equipod(&["equivalents", "family", design, "--pattern", "S123456", &offsets, "-o", path])
    };
    // all midpoints, and a zero of det A that doubles do not show
    for offsets in ["0.5,0.5,0.5,0.5,0.5,0.5", "0.2,0.8,0.3,0.7,0.1,0.9"] {
        let out = member(offsets);
        let text = String::from_utf8(out.stdout).unwrap();
        assert_eq!(out.status.code(), Some(1), "{text}");
        assert!(text.contains("No design is written: the platform is architecturally singular."));
        assert!(!file.exists());
    }
    assert_eq!(member("0.2,0.8,0.3,0.7,0.1,0.8").status.code(), Some(0));
    assert!(file.exists());
}

#[test]
fn rows_of_a_smooth_path_of_the_symmetric_hexapod_are_proved() {
    // every tenth of the thousand rows, or all of them
    let step = size(10, 1);
    let design = Design::load("designs/symmetric-hexapod.toml").unwrap();
    let mut table = String::from("l1,l2,l3,l4,l5,l6\n");
    for k in (0..1000).step_by(step) {
        let t = std::f64::consts::TAU * f64::from(k) / 1000.0;
        let position = [60.0 * t.sin(), 60.0 * (2.0 * t + 0.3).sin(), 350.0 + 50.0 * t.cos()];
        let angle = |x: f64| 10f64.to_radians() * x.sin();
        let pose = Pose {
            rotation: nalgebra::Rotation3::from_euler_angles(angle(t), angle(t + 1.0), angle(3.0 * t)),
            position: position.into(),
        };
        let lengths = pose.lengths(design.manipulator()).unwrap().get().map(|l| l.to_string());
        writeln!(table, "{}", lengths.join(",")).unwrap();
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("path.csv");
    std::fs::write(&path, table).unwrap();
    let out =
        equipod(&["fk", "designs/symmetric-hexapod.toml", "--lengths", path.to_str().unwrap(), "--json"]);
    assert_eq!(out.status.code(), Some(0));
    let rows = document(&out)["rows"].as_array().unwrap().clone();
    assert_eq!(rows.len(), 1000 / step);
    for row in rows {
        assert_eq!(
            (&row["completeness"], &row["finite_count_with_multiplicity"]),
            (&"proved".into(), &28.into()),
            "line {}",
            row["line"]
        );
    }
}

/// One contract: a design that `assess` refuses is refused in the answer of every command that shows or writes it.
#[test]
#[ignore = "evidence"]
fn no_command_calls_a_design_good_that_assess_refuses() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string("designs/symmetric-hexapod.toml").unwrap();
    let narrow = text
        .replacen("translation = [60.0, 60.0, 60.0]", "translation = [5.0, 5.0, 5.0]", 1)
        .replacen("rotation_deg = [10.0, 10.0, 10.0]", "rotation_deg = [1.0, 1.0, 1.0]", 1);
    assert_ne!(narrow, text);
    let out = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    // legs are between 386 and 402 long: the second design is met, the first is not
    let [bad, good] = [("bad.toml", 395.0), ("good.toml", 380.0)].map(|(name, least)| {
        let path = out(name);
        std::fs::write(&path, format!("{narrow}leg_length = [{least}, 600.0]\n")).unwrap();
        path
    });
    let commands = |design: &str, run: &str| -> Vec<Vec<String>> {
        let own = |name: &str| out(&format!("{run}-{name}"));
        let all = [
            format!("assess {design}"),
            format!("build tolerances {design} --bound 0.1,0.1"),
            format!("build round {design} --grid 0.01 -o {}", own("rounded.toml")),
            format!("export {design} --to csv -o {}", own("files")),
            format!("view {design} -o {}", own("page.html")),
            format!("equivalents move {design} --search --no-shared-joints -o {}", own("moved")),
        ];
        all.iter().map(|line| line.split(' ').map(str::to_owned).collect()).collect()
    };
    for (design, run, refused) in [(&bad, "bad", true), (&good, "good", false)] {
        for words in commands(design, run) {
            let words: Vec<&str> = words.iter().map(String::as_str).chain(["--json"]).collect();
            let (answer, line) = (document(&equipod(&words)), words.join(" "));
            let candidates = answer["designs"].as_array().into_iter().flatten();
            let assessments = match words[0] {
                "assess" => vec![&answer],
                "equivalents" => candidates.map(|c| &c["assessment"]).collect(),
                _ => vec![&answer["assessment"]],
            };
            // a search lists platforms that miss something after the others
            let assessed = if refused { &assessments[..] } else { &assessments[..1] };
            assert!(!assessed.is_empty(), "{line}: {answer}");
            for found in assessed {
                assert_eq!(found["met"], !refused, "{line}: {found}");
                let rows = found["requirements"].as_array().unwrap();
                let row = rows.iter().find(|r| r["name"] == "min_leg_length").unwrap();
                assert_eq!(row["status"] == "violated", refused, "{line}: {row}");
            }
        }
        let compared = equipod(&["compare", design, design, "--json"]);
        let answer = document(&compared);
        assert_eq!(answer.to_string().contains("\"violated\""), refused, "{answer}");
    }
}
