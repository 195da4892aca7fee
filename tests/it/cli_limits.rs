//! `equipod limits`: free ranges, ways, nearest allowed poses.

use serde_json::Value;

use super::cli_frame::{document, equipod};

const BENCH: &str = "designs/presets/bench-l16.toml";

fn asked(args: &[&str]) -> (Option<i32>, Value) {
    let out = equipod(&[&["limits"], args, &["--json"]].concat());
    (out.status.code(), document(&out))
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// The six numbers of a pose, and its exit code of `limits`.
fn allowed(pose: [f64; 6]) -> bool {
    let text = pose.map(|x| x.to_string()).join(",");
    let (code, doc) = asked(&[BENCH, "--at", &text]);
    assert_eq!(doc["allowed"], Value::from(code == Some(0)), "{doc}");
    code == Some(0)
}

#[test]
fn every_axis_has_its_range_and_what_ends_it() {
    let (code, doc) = asked(&[BENCH]);
    assert_eq!((code, &doc["allowed"]), (Some(0), &Value::from(true)), "{doc}");
    let axes = doc["axes"].as_array().unwrap();
    let names: Vec<&str> = axes.iter().map(|a| a["axis"].as_str().unwrap()).collect();
    assert_eq!(names, ["x", "y", "z", "roll", "pitch", "yaw"]);
    for (k, axis) in axes.iter().enumerate() {
        assert_eq!(axis["unit"], if k < 3 { "mm" } else { "deg" });
        for (way, sign) in [("back", -1.0), ("forth", 1.0)] {
            let travel = &axis[way];
            let free = number(&travel["free"]);
            assert!(free > 0.0 && !travel["binds"].is_null(), "{axis}");
            assert!((number(&axis["value"]) + sign * free - number(&travel["value"])).abs() < 1e-9);
            let legs = travel["binds"]["legs"].as_array().unwrap();
            assert!(travel["binds"]["name"].is_null() || !legs.is_empty(), "{travel}");
            // inside is allowed, beyond is not
            let mut pose = [0.0, 0.0, 210.0, 0.0, 0.0, 0.0];
            for (share, meant) in [(1.0 - 1e-6, true), (1.0 + 1e-6, false)] {
                pose[k] = number(&axis["value"]) + sign * free * share;
                assert_eq!(allowed(pose), meant, "{names:?} {k} {way}");
            }
        }
    }
    let text = String::from_utf8(equipod(&["limits", BENCH]).stdout).unwrap();
    assert!(text.contains("yaw") && text.contains("leg length, maximum (leg"), "{text}");
}

#[test]
fn a_pose_that_is_not_allowed_has_a_nearest_one_that_is() {
    let (code, doc) = asked(&[BENCH, "--at", "0,0,900,0,0,0"]);
    assert_eq!((code, &doc["allowed"]), (Some(1), &Value::from(false)));
    assert_eq!(doc["violated"][0]["name"], "max_leg_length");
    assert!(doc["axes"].as_array().unwrap().is_empty());
    let near = &doc["nearest_allowed"];
    assert_eq!(near["stationary"], true, "{near}");
    let numbers = |v: &Value| -> Vec<f64> { v.as_array().unwrap().iter().map(number).collect() };
    let pose: Vec<f64> = [numbers(&near["position"]), numbers(&near["rpy_deg"])].concat();
    let text: Vec<String> = pose.iter().map(f64::to_string).collect();
    let (code, again) = asked(&[BENCH, &format!("--at={}", text.join(","))]);
    // written as angles the pose is off by rounding, and violations are no larger than that
    let least =
        again["violated"].as_array().unwrap().iter().map(|v| number(&v["margin"])).fold(0.0, f64::min);
    assert!(code == Some(0) || least > -1e-9, "{again}");
    // straight up the height of the design ends the path
    let (_, home) = asked(&[BENCH]);
    let highest = number(&home["axes"][2]["forth"]["value"]);
    assert!(number(&near["distance"]) <= 900.0 - highest + 1e-6);
    let text = String::from_utf8(equipod(&["limits", BENCH, "--at", "0,0,900,0,0,0"]).stdout).unwrap();
    assert!(
        text.contains("is not allowed at") && text.contains("nearest allowed pose (local optimum)"),
        "{text}"
    );
}

#[test]
fn the_straight_way_to_another_pose_ends_where_something_binds() {
    let (code, doc) = asked(&[BENCH, "--at", "0,0,215,3,0,0", "--to", "10,0,212,0,0,0"]);
    assert_eq!((code, number(&doc["straight_path"]["free"])), (Some(0), 1.0), "{doc}");
    assert!(doc["straight_path"]["binds"].is_null() && doc["nearest_allowed"].is_null());
    let (code, doc) = asked(&[BENCH, "--to", "0,0,400,0,0,0"]);
    assert_eq!((code, &doc["allowed"]), (Some(1), &Value::from(true)));
    let (_, home) = asked(&[BENCH]);
    let up = number(&home["axes"][2]["forth"]["free"]);
    assert!((number(&doc["straight_path"]["free"]) - up / 190.0).abs() < 1e-8);
    assert_eq!(doc["straight_path"]["binds"]["name"], home["axes"][2]["forth"]["binds"]["name"]);
    let (code, doc) = asked(&[BENCH, "--at", "1,2"]);
    assert_eq!((code, &doc["error"]["code"]), (Some(2), &Value::from("limits::bad_pose")));
    let (code, doc) = asked(&[BENCH, "--starts", "3"]);
    assert_eq!((code, &doc["error"]["code"]), (Some(2), &Value::from("usage::no_effect")));
}

/// Home is three millimetres too high: the nearest allowed pose is below it, where all six legs are as long as they may
/// be.
#[test]
fn a_home_out_of_reach_is_led_back_to_an_allowed_pose() {
    let (code, doc) = asked(&["tests/fixtures/home-too-high.toml"]);
    assert_eq!((code, &doc["allowed"]), (Some(1), &false.into()));
    let found = &doc["nearest_allowed"];
    let height = number(&found["pose"]["p"][2]);
    assert!((height - 96.5926).abs() < 1e-3 && number(&found["distance"]) < 3.5, "{found}");
    assert_eq!(found["stationary"], true, "{found}");
}

/// A desk hexapod: every size is one that `assess` meets with the region asked for, and misses with a larger one.
#[test]
#[ignore = "evidence"]
fn the_workspace_has_its_sizes() {
    // with lengths and cone angles alone, which few cells decide
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(BENCH).unwrap();
    let text = text.split("[speed]").next().unwrap();
    let kept = text.lines().filter(|l| !l.contains("_diameter") && !l.starts_with("max_"));
    let text = kept.collect::<Vec<_>>().join("\n");
    let path = folder.path().join("design.toml");
    std::fs::write(&path, &text).unwrap();
    let design = path.to_str().unwrap();
    let (code, doc) = asked(&[design, "--workspace", "--rays", "100"]);
    assert_eq!(code, Some(0));
    let found = &doc["workspace"];
    let of = |name: &str| (number(&found[name]["proved"]), number(&found[name]["searched"]));
    // cells of many rotations prove less than those of positions
    for (name, share) in [("ball_radius", 0.9), ("tilt_deg", 0.7), ("turn_deg", 0.5)] {
        let (proved, searched) = of(name);
        assert!(proved > share * searched && proved <= searched, "{name}: {found}");
        assert!(!found[name]["binds"]["name"].is_null(), "{name}: {found}");
    }
    assert!(of("turn_deg").0 <= of("tilt_deg").1);
    let ball = of("ball_radius").0;
    let sphere = 4.0 / 3.0 * std::f64::consts::PI * ball.powi(3);
    assert!(number(&found["volume"]) > sphere && number(&found["volume_uncertainty"]) < 0.1, "{found}");
    let half: Vec<f64> = found["box_proved"].as_array().unwrap().iter().map(number).collect();
    assert!(half.iter().all(|h| *h > 0.0) && 8.0 * half.iter().product::<f64>() < number(&found["volume"]));
    let shares: f64 = found["ends"].as_array().unwrap().iter().map(|e| number(&e["share"])).sum();
    assert!((shares - 1.0).abs() < 1e-12);
    // the preset meets its requirements as it stands
    assert!(
        number(&found["required"]["factor"]["proved"]) > 0.5
            && number(&found["required"]["factor"]["searched"]) >= 1.0
    );
    let path = folder.path().join("ball.toml");
    let assess = |radius: f64| {
        let region = format!("translation = [{radius}, {radius}, {radius}]");
        let text = text.replace("translation = [30.0, 30.0, 25.0]", &region);
        std::fs::write(&path, text.replace("rotation_deg = [10.0, 10.0, 10.0]", "rotation_deg = [0, 0, 0]"))
            .unwrap();
        equipod(&["assess", path.to_str().unwrap(), "--points", "500", "--cells", "400"]).status.code()
    };
    assert_eq!((assess(ball), assess(of("ball_radius").1 * 1.01)), (Some(0), Some(1)));
    let text = String::from_utf8(equipod(&["limits", design, "--workspace", "--rays", "50"]).stdout).unwrap();
    assert!(text.contains("largest ball, radius") && text.contains("tilt, any level axis"), "{text}");
    // without a workspace asked for there is none, and directions have no effect
    assert!(asked(&[BENCH]).1["workspace"].is_null());
    assert_eq!(equipod(&["limits", BENCH, "--rays", "70"]).status.code(), Some(2));
}

/// Three legs stand along z at (50, 0), (-50, 0) and (0, 50), two lie along y at x = +-40, and one along x. All are 100 mm long at home.
const BY_HAND: &str = r#"
name = "three, two and one"
units = "mm"
force_units = "N"
legs = [["A1", "B1"], ["A2", "B2"], ["A3", "B3"], ["A4", "B4"], ["A5", "B5"], ["A6", "B6"]]
[base]
A1 = [50, 0, -100]
A2 = [-50, 0, -100]
A3 = [0, 50, -100]
A4 = [40, -100, 0]
A5 = [-40, -100, 0]
A6 = [-100, 0, 0]
[platform]
B1 = [50, 0, 0]
B2 = [-50, 0, 0]
B3 = [0, 50, 0]
B4 = [40, 0, 0]
B5 = [-40, 0, 0]
B6 = [0, 0, 0]
[home]
position = [0, 0, 0]
rpy_deg = [0, 0, 0]
[hardware]
leg_length = [90, 115]
max_leg_speed = 20
max_leg_force = 100
"#;

fn design(text: &str) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("design.toml");
    std::fs::write(&path, text).unwrap();
    let path = path.to_str().unwrap().to_owned();
    (folder, path)
}

#[test]
fn the_data_sheet_of_orthogonal_legs_is_that_of_a_sheet_of_paper() {
    let (_folder, path) = design(BY_HAND);
    let (code, doc) = asked(&[&path, "--table"]);
    assert_eq!(code, Some(0), "{doc}");
    let by_radius = |radius: f64| (20.0 / radius).to_degrees();
    // roll strains the leg at y = 50 alone, pitch those at x = +-50, yaw those at x = +-40
    let capacities = [
        (20.0, 100.0),
        (20.0, 200.0),
        (20.0, 200.0),
        (by_radius(50.0), 5_000.0),
        (by_radius(50.0), 10_000.0),
        (by_radius(40.0), 8_000.0),
    ];
    for (k, (axis, (speed, effort))) in doc["axes"].as_array().unwrap().iter().zip(capacities).enumerate() {
        assert!((number(&axis["greatest_speed"]) / speed - 1.0).abs() < 1e-12, "{axis}");
        assert!((number(&axis["greatest_effort"]) / effort - 1.0).abs() < 1e-12, "{axis}");
        assert_eq!(axis["effort_unit"], if k < 3 { "N" } else { "N mm" });
        let both = ["back", "forth"].map(|way| number(&axis[way]["free"]));
        assert!(
            both.contains(&number(&axis["symmetric"]))
                && both.iter().all(|x| number(&axis["symmetric"]) <= *x)
        );
    }
    let ends = |k: usize| ["back", "forth"].map(|way| number(&doc["axes"][k][way]["value"]));
    for (end, meant) in ends(0).into_iter().zip([-10.0, 15.0]) {
        assert!((end - meant).abs() < 1e-6, "{end}");
    }
    let text = String::from_utf8(equipod(&["limits", &path, "--table"]).stdout).unwrap();
    let rows: Vec<&str> = text.lines().filter(|line| line.starts_with('|')).collect();
    assert_eq!(rows[0], "| coordinate | minimum | maximum | symmetric | speed | force or torque |", "{text}");
    assert_eq!(rows[2], "| x | -10 mm | 15 mm | +-10 mm | 20 mm/s | 100 N |");
    assert!(rows[7].ends_with("| 28.6 deg/s | 8000 N mm |"), "{text}");
    let text = String::from_utf8(equipod(&["limits", &path, "--table", "--digits", "6"]).stdout).unwrap();
    assert!(text.contains("28.6479 deg/s"), "{text}");
    // without limits of the drives there are no columns for them
    let (_folder, path) = design(&BY_HAND.replace("max_leg_speed = 20\nmax_leg_force = 100\n", ""));
    let text = String::from_utf8(equipod(&["limits", &path, "--table"]).stdout).unwrap();
    assert!(text.contains("| coordinate | minimum | maximum | symmetric |\n"), "{text}");
    // without any requirement only singular poses end the travel, and the answer says where limits are stated
    let hint = "No requirement ends the travel";
    assert!(!String::from_utf8(equipod(&["limits", &path]).stdout).unwrap().contains(hint));
    let (_folder, path) = design(BY_HAND.split("[hardware]").next().unwrap());
    let text = String::from_utf8(equipod(&["limits", &path]).stdout).unwrap();
    assert!(text.contains(hint), "{text}");
}

/// At any pose, in any convention: the rates of `at --leg` and the forces of `at --wrench` reach the limits of the drives.
#[test]
fn speeds_and_forces_of_the_data_sheet_are_those_of_at() {
    let frames = ["--rotation-order", "moving-xyz", "--pivot", "5,-3,20", "--relative-to", "home"];
    let pose = ["--at", "3,-2,4,2,-3,5"];
    let (_, doc) = asked(&[&[BENCH][..], &pose, &frames].concat());
    let at = |more: &[&str]| {
        document(&equipod(&[&["at", BENCH, "--json", "--pose", pose[1]], &frames[..], more].concat()))
    };
    let rates: Vec<Value> =
        (1..=6).map(|leg| at(&["--leg", &leg.to_string()])["stuck"]["rates"].clone()).collect();
    for (k, axis) in doc["axes"].as_array().unwrap().iter().enumerate() {
        let fastest = rates.iter().map(|rates| number(&rates[k]).abs()).fold(0.0, f64::max);
        assert!((number(&axis["greatest_speed"]) * fastest / 10.0 - 1.0).abs() < 1e-9, "{axis} {fastest}");
    }
    for k in 0..3 {
        let mut wrench = [0.0; 6];
        wrench[k] = number(&doc["axes"][k]["greatest_effort"]);
        let held = at(&["--wrench", &wrench.map(|x| x.to_string()).join(",")]);
        let forces = held["held"].as_array().unwrap().last().unwrap()["forces"].as_array().unwrap().clone();
        let greatest = forces.iter().map(|f| number(f).abs()).fold(0.0, f64::max);
        assert!((greatest / 46.0 - 1.0).abs() < 1e-9, "{held}");
    }
    let (code, doc) = asked(&[BENCH, "--table", "--workspace"]);
    assert_eq!((code, &doc["error"]["code"]), (Some(2), &Value::from("usage")));
}
