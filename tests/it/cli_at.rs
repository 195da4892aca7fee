//! `equipod at`: forces, small motions, stiffness, a stuck leg, the nearest singular pose.

use serde_json::Value;

use super::cli_frame::{document, equipod};

const HEXAPOD: &str = "designs/symmetric-hexapod.toml";
const BENCH: &str = "designs/presets/bench-l16.toml";
const CRANKS: &str = "designs/presets/reachy-mini.toml";

fn asked(words: &[&str]) -> (Option<i32>, Value) {
    let out = equipod(&[words, &["--json"]].concat());
    (out.status.code(), document(&out))
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap_or_else(|| panic!("{value}")).iter().map(|x| x.as_f64().unwrap()).collect()
}

fn lengths(design: &str, pose: &[f64; 6]) -> Vec<f64> {
    let text = format!("--pose={}", pose.map(|x| format!("{x:?}")).join(","));
    let (_, doc) = asked(&["ik", design, &text]);
    let drives = if doc["angles_deg"].is_null() { &doc["lengths"] } else { &doc["angles_deg"] };
    numbers(drives)
}

/// The change of lengths or angles by a small shift of the platform origin along an axis.
fn rates(design: &str, pose: [f64; 6], axis: usize) -> Vec<f64> {
    let h = 1e-4;
    let at = |sign: f64| {
        let mut moved = pose;
        moved[axis] += sign * h;
        lengths(design, &moved)
    };
    let (after, before) = (at(1.0), at(-1.0));
    after.iter().zip(before).map(|(x, y)| (x - y) / (2.0 * h)).collect()
}

#[test]
fn forces_and_torques_do_the_work_of_the_load_they_hold() {
    for (design, pose) in
        [(HEXAPOD, [5.0, -3.0, 360.0, 0.0, 0.0, 0.0]), (CRANKS, [2.0, 1.0, 181.0, 0.0, 0.0, 0.0])]
    {
        let text = format!("--pose={}", pose.map(|x| x.to_string()).join(","));
        let wrench = [3.0, -2.0, -40.0];
        let (code, doc) = asked(&["at", design, &text, "--wrench", "3,-2,-40,0,0,0"]);
        assert_eq!(code, Some(0), "{doc}");
        let held = doc["held"].as_array().unwrap().iter().find(|h| h["load"].is_null()).unwrap();
        let forces = numbers(&held["forces"]);
        for axis in 0..3 {
            // angles are in degrees, torques work over radians
            let rates = rates(design, pose, axis);
            let unit = if doc["lengths"].is_null() { 1f64.to_radians() } else { 1.0 };
            let work: f64 = forces.iter().zip(&rates).map(|(f, r)| f * r * unit).sum();
            assert!((work + wrench[axis]).abs() < 1e-5, "{design} {axis}: {work}");
        }
        // the load cell gives the wrench back
        let given = forces.iter().map(|f| format!("{f:?}")).collect::<Vec<_>>().join(",");
        let (_, back) = asked(&["at", design, &text, &format!("--forces={given}")]);
        let force = numbers(&back["wrench"]["force"]);
        let torque = numbers(&back["wrench"]["torque"]);
        assert!((0..3).all(|k| (force[k] - wrench[k]).abs() < 1e-9 && torque[k].abs() < 1e-6), "{back}");
    }
}

#[test]
fn wrenches_move_to_other_points_and_axes() {
    let pose = ["--pose", "0,0,360,0,20,0"];
    let held = |words: &[&str]| {
        let (_, doc) = asked(&[&["at", HEXAPOD], &pose[..], words].concat());
        numbers(&doc["held"].as_array().unwrap().last().unwrap()["forces"])
    };
    // a force at a point is the same force at the origin with its moment: the point is 50 along z of the platform
    let (sin, cos) = 20f64.to_radians().sin_cos();
    let at_point = held(&["--wrench", "0,0,-10,0,0,0", "--point", "0,0,50"]);
    let moment = format!("0,0,-10,0,{:?},0", 10.0 * 50.0 * sin);
    let at_origin = held(&["--wrench", &moment]);
    assert!(at_point.iter().zip(&at_origin).all(|(x, y)| (x - y).abs() < 1e-9), "{at_point:?} {at_origin:?}");
    // axes of the platform: its z axis is (sin, 0, cos) of the base
    let own = held(&["--wrench", "0,0,-10,0,0,0", "--axes", "platform"]);
    let base = held(&["--wrench", &format!("{:?},0,{:?},0,0,0", -10.0 * sin, -10.0 * cos)]);
    assert!(own.iter().zip(&base).all(|(x, y)| (x - y).abs() < 1e-9), "{own:?} {base:?}");
}

#[test]
fn a_step_of_a_leg_is_followed_by_the_platform() {
    let (_, doc) = asked(&["at", HEXAPOD, "--step", "0.001", "--point", "0,0,30"]);
    let drives = doc["resolution"]["drives"].as_array().unwrap();
    let home = numbers(&doc["lengths"]);
    for (leg, motion) in drives.iter().enumerate() {
        let mut longer = home.clone();
        longer[leg] += 0.001;
        let text = longer.iter().map(|l| format!("{l:?}")).collect::<Vec<_>>().join(",");
        let (_, found) = asked(&[
            "fk",
            HEXAPOD,
            "--near",
            "home",
            "--lengths",
            &text,
            "--pivot",
            "0,0,30",
            "--relative-to",
            "home",
            "--rotation-order",
            "vector",
        ]);
        let moved = &found["solutions"][0]["real_pose"]["in_frames"];
        let shift = numbers(&moved["position"]);
        let turn = numbers(&moved["angles"]);
        let (meant, about) = (numbers(&motion["shift"]), numbers(&motion["turn_deg"]));
        assert!((0..3).all(|k| (shift[k] - meant[k]).abs() < 1e-6), "{shift:?} {meant:?}");
        assert!((0..3).all(|k| (turn[k] - about[k]).abs() < 1e-6), "{turn:?} {about:?}");
    }
    // all steps together are no more than the sum
    let all = numbers(&doc["resolution"]["all"]["shift"]);
    let most = drives.iter().map(|m| numbers(&m["shift"])[2].abs()).sum::<f64>();
    assert!((all[2] - most).abs() < 1e-12);
}

#[test]
fn stiffness_at_a_point_is_that_of_motion_at_the_origin() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("stiff.toml");
    let text = std::fs::read_to_string(HEXAPOD).unwrap();
    std::fs::write(&path, text.replace("[hardware]\n", "[hardware]\nleg_stiffness = 1000.0\n")).unwrap();
    let design = path.to_str().unwrap();
    let (_, motion) = asked(&["motion", design, "--stiffness"]);
    let (_, at) = asked(&["at", design]);
    for k in 0..6 {
        let [own, known] = [&at, &motion].map(|doc| numbers(&doc["stiffness"]["K"][k]));
        let most = known.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        assert!(own.iter().zip(&known).all(|(x, y)| (x - y).abs() < 1e-12 * most), "{own:?} {known:?}");
    }
    // a lever makes the point softer
    let (_, far) = asked(&["at", design, "--point", "0,0,300"]);
    let linear = |doc: &Value| doc["stiffness"]["linear"].as_f64().unwrap();
    assert!((linear(&at) / linear(&motion) - 1.0).abs() < 1e-12);
    assert!(linear(&far) < linear(&at), "{far}");
    // against a torque every point is as stiff
    let angular = |doc: &Value| doc["stiffness"]["angular"].as_f64().unwrap();
    assert!((angular(&far) / angular(&at) - 1.0).abs() < 1e-9);
}

#[test]
fn a_leg_that_is_free_leaves_one_motion_of_the_others() {
    let (_, doc) = asked(&["at", HEXAPOD, "--leg", "3"]);
    let stuck = &doc["stuck"];
    assert_eq!(stuck["leg"], 3);
    let home = numbers(&doc["lengths"]);
    for way in ["shorter", "longer"] {
        let poses = stuck[way].as_array().unwrap();
        assert!(!poses.is_empty(), "{stuck}");
        for there in poses {
            let written = &there["in_frames"];
            let pose = [numbers(&written["position"]), numbers(&written["angles"])].concat();
            let found = lengths(HEXAPOD, &pose.try_into().unwrap());
            for leg in 0..6 {
                let meant = if leg == 2 { there["length"].as_f64().unwrap() } else { home[leg] };
                assert!((found[leg] - meant).abs() < 1e-8, "{way} leg {leg}: {} {meant}", found[leg]);
            }
        }
    }
    // the rates are those of the leg
    let rate = numbers(&stuck["rates"]);
    for axis in 0..3 {
        let found = rates(HEXAPOD, home_pose(), axis)[2];
        assert!((found - rate[axis]).abs() < 1e-6, "{found} {rate:?}");
    }
}

fn home_pose() -> [f64; 6] {
    let (_, doc) = asked(&["ik", HEXAPOD]);
    let p = numbers(&doc["pose"]["p"]);
    [p[0], p[1], p[2], 0.0, 0.0, 0.0]
}

#[test]
fn the_nearest_singular_pose_is_one_and_others_are_farther() {
    let (code, doc) = asked(&["at", HEXAPOD, "--nearest-singular"]);
    assert_eq!(code, Some(0));
    let near = &doc["nearest_singular"];
    assert!(near["proved_within"].as_f64().unwrap() < 1e-3 && near["stationary"] == true, "{near}");
    let written = &near["in_frames"];
    let pose = [numbers(&written["position"]), numbers(&written["angles"])].concat();
    let text = format!("--pose={}", pose.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(","));
    let (_, there) = asked(&["at", HEXAPOD, &text]);
    let home = doc["inverse_condition"].as_f64().unwrap();
    assert!(there["inverse_condition"].as_f64().unwrap() < 1e-5 * home, "{there}");
    // a turn about z by 90 degrees is singular too, and not nearer
    let quarter = near["characteristic_length"].as_f64().unwrap() * std::f64::consts::FRAC_PI_2;
    assert!(near["distance"].as_f64().unwrap() <= quarter * (1.0 + 1e-9), "{near}");
}

#[test]
fn a_singular_pose_is_an_answer_of_no() {
    let (code, doc) = asked(&["at", "no/such.toml"]);
    assert_eq!(code, Some(2), "{doc}");
    let mut home = home_pose();
    home[5] = 90.0;
    let text = format!("--pose={}", home.map(|x| x.to_string()).join(","));
    let (code, doc) = asked(&["at", HEXAPOD, &text]);
    assert_eq!(code, Some(1), "{doc}");
    assert!(!doc["singular"].is_null());
    for words in [&["--point", "1,2"][..], &["--wrench", "1,2,3"], &["--step", "0"], &["--leg", "7"]] {
        let (code, _) = asked(&[&["at", HEXAPOD], words].concat());
        assert_eq!(code, Some(2), "{words:?}");
    }
}

#[test]
fn cranks_have_a_stiffness_and_a_nearest_singular_pose() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("stiff.toml");
    let text = std::fs::read_to_string(CRANKS).unwrap();
    let spring = 900.0;
    std::fs::write(&path, text.replacen("max_torque", &format!("stiffness = {spring}\nmax_torque"), 1))
        .unwrap();
    let design = path.to_str().unwrap();
    let (_, doc) = asked(&["at", CRANKS]);
    assert!(doc["stiffness"].is_null(), "{doc}");
    let (code, doc) = asked(&["at", design, "--nearest-singular"]);
    assert_eq!(code, Some(0), "{doc}");
    let home = [numbers(&doc["pose"]["p"]), vec![0.0; 3]].concat();
    let turns = [0, 1, 2].map(|axis| rates(design, home.clone().try_into().unwrap(), axis));
    for i in 0..3 {
        let row = numbers(&doc["stiffness"]["K"][i]);
        for j in 0..3 {
            let product: f64 =
                turns[i].iter().zip(&turns[j]).map(|(a, b)| a.to_radians() * b.to_radians()).sum();
            assert!(
                (row[j] - spring * product).abs() < 1e-5 * row[i],
                "{i} {j}: {row:?} {}",
                spring * product
            );
        }
    }
    // longer rods reach a singular pose
    std::fs::write(&path, text.replacen("rod_length = 85.0", "rod_length = 110.0", 1)).unwrap();
    let (_, doc) = asked(&["at", design, "--nearest-singular"]);
    let near = &doc["nearest_singular"];
    assert_eq!(near["stationary"], true, "{near}");
    let pose = [numbers(&near["in_frames"]["position"]), numbers(&near["in_frames"]["angles"])].concat();
    let text = format!("--pose={}", pose.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(","));
    let (_, there) = asked(&["at", design, &text]);
    let condition = |doc: &Value| doc["inverse_condition"].as_f64().unwrap();
    assert!(condition(&there) < 1e-9 * condition(&doc), "{near} {there}");
}

#[test]
fn the_surface_of_the_workspace_is_written_as_mesh_and_table() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    for name in ["reach.csv", "reach.ply", "reach.stl"] {
        let (code, doc) = asked(&["limits", BENCH, "--surface", &file(name), "--level", "2"]);
        assert_eq!((code, doc["surface"].as_str()), (Some(0), Some(file(name).as_str())));
    }
    let table = std::fs::read_to_string(file("reach.csv")).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().skip(1).map(|line| line.split(',').collect()).collect();
    assert_eq!((rows.len(), table.lines().next()), (162, Some("x_mm,y_mm,z_mm,ends_at")));
    // a little inside is allowed, a little outside is not
    let (_, home) = asked(&["ik", BENCH]);
    let middle = numbers(&home["pose"]["p"]);
    for row in rows.iter().step_by(20) {
        let end: Vec<f64> = row[..3].iter().map(|x| x.parse().unwrap()).collect();
        for (share, meant) in [(0.9999, true), (1.0001, false)] {
            let at: Vec<String> =
                (0..3).map(|k| (middle[k] + share * (end[k] - middle[k])).to_string()).collect();
            let (_, doc) = asked(&["limits", BENCH, &format!("--at={},0,0,0", at.join(","))]);
            assert_eq!(doc["allowed"], meant, "{row:?}");
        }
    }
    let ply = std::fs::read_to_string(file("reach.ply")).unwrap();
    assert!(ply.contains("element vertex 162\n") && ply.contains("element face 320\n"));
    let (code, _) = asked(&["limits", BENCH, "--surface", &file("reach.obj")]);
    assert_eq!(code, Some(2));
}

#[test]
fn poses_beyond_the_limits_are_left_out_of_the_list() {
    let (_, doc) = asked(&["fk", BENCH, "--lengths", &lengths_text(), "--limits"]);
    let all = doc["solutions"].as_array().unwrap();
    let allowed = all.iter().filter(|s| s["real_pose"]["allowed"] == true).count();
    let real = all.iter().filter(|s| s["real"] == true).count();
    assert!(allowed >= 1 && allowed < real, "{allowed} of {real}");
    let shown = equipod(&["fk", BENCH, "--lengths", &lengths_text(), "--limits"]);
    let text = String::from_utf8(shown.stdout).unwrap();
    let is_pose = |line: &&str| {
        line.trim_start().starts_with(|c: char| c.is_ascii_digit()) && line.contains("  certified")
    };
    assert_eq!(text.lines().filter(is_pose).count(), allowed, "{text}");
    assert!(text.contains("violate requirements"), "{text}");
    // the pose of the machine is the first of the list, and marked
    let everything = String::from_utf8(equipod(&["fk", BENCH, "--lengths", &lengths_text()]).stdout).unwrap();
    let first = everything.lines().find(is_pose).unwrap();
    assert!(first.contains("nearest to home"), "{everything}");
}

fn lengths_text() -> String {
    let (_, doc) = asked(&["ik", BENCH]);
    numbers(&doc["lengths"]).iter().map(|l| format!("{l:?}")).collect::<Vec<_>>().join(",")
}
