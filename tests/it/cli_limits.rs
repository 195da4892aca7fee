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
