//! `equipod fk DESIGN --near POSE`: forms of the pose, trajectories, refusals, exit codes.

use std::fmt::Write as _;

use crate::cli_frame::{document, equipod};

const DESIGN: &str = "designs/rbt-octahedral.toml";

fn near(extra: &[&str]) -> std::process::Output {
    equipod(&[&["fk", DESIGN, "--json"], extra].concat())
}

fn numbers(value: &serde_json::Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

/// A real pose of the design with its rows of `R`, from the full solver.
fn known_pose() -> (Vec<f64>, String) {
    let all = document(&near(&[]));
    let solutions = all["solutions"].as_array().unwrap();
    let real = solutions.iter().find(|s| s["real"] == true).unwrap();
    let p = numbers(&real["p"]["re"]);
    let r: Vec<Vec<f64>> = real["R"]["re"].as_array().unwrap().iter().map(numbers).collect();
    let matrix = nalgebra::Matrix3::from_fn(|i, j| r[i][j]);
    let (roll, pitch, yaw) = nalgebra::Rotation3::from_matrix(&matrix).euler_angles();
    let mut text = String::new();
    for x in &p {
        write!(text, "{x},").unwrap();
    }
    write!(text, "{},{},{}", roll.to_degrees(), pitch.to_degrees(), yaw.to_degrees()).unwrap();
    (p, text)
}

#[test]
fn a_known_pose_is_found_again_and_certified() {
    let (p, pose) = known_pose();
    let out = near(&["--near", &pose]);
    assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stdout));
    let answer = document(&out);
    assert_eq!(
        (answer["method"].as_str(), answer["completeness"].as_str()),
        (Some("near"), Some("unproved"))
    );
    assert_eq!(answer["finite_count"], 1);
    let solution = &answer["solutions"][0];
    assert_eq!((&solution["real"], &solution["certified"]), (&true.into(), &true.into()));
    for (x, y) in numbers(&solution["p"]["re"]).iter().zip(&p) {
        assert!((x - y).abs() < 1e-9);
    }
    assert_eq!(answer["near"]["outcome"], "tracked");
    assert!(answer["near"]["residual"].as_f64().unwrap() < 1e-12);
}

#[test]
fn a_trajectory_starts_each_row_from_the_pose_before() {
    let (_, pose) = known_pose();
    let design = std::fs::read_to_string(DESIGN).unwrap();
    let line = design.lines().find(|l| l.starts_with("lengths")).unwrap();
    let base: Vec<f64> =
        line.split(['[', ']']).nth(1).unwrap().split(',').filter_map(|x| x.trim().parse().ok()).collect();
    let mut csv = String::from("l1,l2,l3,l4,l5,l6\n");
    for k in 0..=20 {
        let change = 0.02 * (std::f64::consts::TAU * f64::from(k) / 20.0).sin();
        let row: Vec<String> =
            base.iter().enumerate().map(|(i, l)| (l + change * [1.0, -1.0][i % 2]).to_string()).collect();
        writeln!(csv, "{}", row.join(",")).unwrap();
    }
    csv.push_str("1,1,1,1,1,1\n");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("way.csv");
    std::fs::write(&path, csv).unwrap();
    let out = near(&["--lengths", path.to_str().unwrap(), "--near", &pose]);
    assert_eq!(out.status.code(), Some(3), "lengths that cannot be assembled end the trajectory");
    let answer = document(&out);
    let rows = answer["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 22);
    for pair in rows[..21].windows(2) {
        assert_eq!(pair[1]["near"]["outcome"], "tracked", "{}", pair[1]["line"]);
        assert_eq!(pair[0]["near"]["reached"], pair[1]["near"]["start"]);
    }
    let ends = [&rows[0], &rows[20]].map(|r| numbers(&r["solutions"][0]["p"]["re"]));
    assert!(ends[0].iter().zip(&ends[1]).all(|(x, y)| (x - y).abs() < 1e-9));
    let last = &rows[21];
    assert_ne!(last["near"]["outcome"], "tracked");
    assert_eq!((&last["finite_count"], &last["all_paths_accounted"]), (&0.into(), &false.into()));
    assert!(last["near"]["fraction"].as_f64().unwrap() < 1.0);
}

#[test]
fn forms_of_the_pose() {
    for good in ["home", "1,2,10,0,0,0", "-1,2,10,1,0,0,0"] {
        assert_ne!(near(&["--near", good]).status.code(), Some(2), "{good}");
    }
    for bad in ["", "origin", "1,2,3", "1,2,3,4,5,x", "1,2,3,inf,0,0", "1,2,3,2,0,0,0", "1,2,3,4,5,6,7,8"] {
        let out = near(&["--near", bad]);
        assert_eq!(out.status.code(), Some(2), "{bad}");
        assert_eq!(document(&out)["error"]["code"], "fk::bad_pose", "{bad}");
    }
    let out = near(&["--near", "home", "--method", "octic"]);
    assert_eq!(document(&out)["error"]["code"], "usage");
}
