//! `equipod motion` as a process: tables in, forces out, limits, refusals.

use serde_json::Value;

use super::cli_frame::{document, equipod};

const SIMULATOR: &str = "designs/worked/simulator-octahedral.toml";

fn asked(args: &[&str]) -> (Option<i32>, Value) {
    let out = equipod(&[&["motion"], args, &["--json"]].concat());
    (out.status.code(), document(&out))
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn a_manoeuvre_has_forces_and_limits_for_every_leg() {
    let (code, doc) = asked(&[SIMULATOR, "--sine", "z:0.05:0.5", "--accelerate", "pitch:60"]);
    assert_eq!((code, &doc["met"]), (Some(0), &Value::from(true)), "{doc}");
    let [heave, pitch] = doc["motions"].as_array().unwrap().as_slice() else { panic!("{doc}") };
    assert_eq!((heave["instants"].as_u64(), pitch["instants"].as_u64()), (Some(361), Some(1)));
    assert!((number(&heave["duration_s"]) - 2.0).abs() < 1e-12 && number(&pitch["duration_s"]) == 0.0);
    // m (g + a) sum of the vertical parts: the mean of the squares of all forces is at least that at rest
    let legs = heave["legs"].as_array().unwrap();
    assert_eq!(legs.len(), 6);
    for leg in legs {
        let [low, high] = ["shortest", "longest"].map(|k| number(&leg[k]["value"]));
        assert!(low < high);
        assert!(number(&leg["push"]["value"]) > number(&leg["rms_force"]));
        assert!(number(&leg["pull"]["value"]) == 0.0, "a leg that only pushes: {leg}");
        assert!(number(&leg["power_w"]["value"]).abs() <= 9000.0 * 0.75);
    }
    let names: Vec<&str> = heave["requirements"]
        .as_array()
        .unwrap()
        .iter()
        .map(|r| r["margin"]["name"].as_str().unwrap())
        .collect();
    for name in ["max_leg_length", "leg_clearance", "leg_force", "leg_speed"] {
        assert!(names.contains(&name), "{names:?}");
    }
    assert_eq!(doc["assumptions"].as_array().unwrap().len(), 2, "{doc}");
    // seven times as fast: speed and force are too large
    let (code, doc) = asked(&[SIMULATOR, "--sine", "z:0.05:3.5"]);
    assert_eq!((code, &doc["met"]), (Some(1), &Value::from(false)));
    let text = String::from_utf8(equipod(&["motion", SIMULATOR, "--sine", "z:0.05:3.5"]).stdout).unwrap();
    assert!(text.contains("exceeds its limits: leg speed, maximum"), "{text}");
}

#[test]
fn a_table_of_times_and_poses_is_a_motion() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    let (seconds, milliseconds, out) = (path("s.csv"), path("ms.csv"), path("out.csv"));
    let rows = |unit: f64, name: &str| {
        let row = |k: i32| {
            let t = 0.05 * f64::from(k);
            format!(
                "{:?},{:?},0,{:?},0,0,0\n",
                t * unit,
                0.1 * (2.0 * t).sin(),
                1.05 + 0.05 * (3.0 * t).sin()
            )
        };
        format!("{name},x,y,z,roll,pitch,yaw\n{}", (0..41).map(row).collect::<String>())
    };
    std::fs::write(&seconds, rows(1.0, "t")).unwrap();
    std::fs::write(&milliseconds, rows(1000.0, "t_ms")).unwrap();
    let found = |file: &str, more: &[&str]| {
        let (code, doc) = asked(&[&[SIMULATOR, file], more].concat());
        assert!(code == Some(0) || code == Some(1), "{doc}");
        doc["motions"][0].clone()
    };
    let one = found(&seconds, &["--csv", &out]);
    assert_eq!(one["instants"], 401);
    let two = found(&milliseconds, &[]);
    let speed = |doc: &Value| number(&doc["legs"][2]["speed"]["value"]);
    assert!((speed(&one) - speed(&two)).abs() < 1e-9 * speed(&one).abs());
    // the table has the numbers of the answer
    let text = std::fs::read_to_string(&out).unwrap();
    let table: Vec<Vec<&str>> = text.lines().map(|l| l.split(',').collect()).collect();
    assert_eq!(table.len(), 402);
    let column = table[0].iter().position(|name| *name == "speed_3_m_per_s").unwrap();
    let greatest = table[1..].iter().map(|row| row[column].parse::<f64>().unwrap().abs()).fold(0.0, f64::max);
    assert!((greatest - speed(&one).abs()).abs() < 1e-12);
    // at rest at both ends
    let resting = found(&seconds, &["--at-rest", "--csv", &out]);
    assert_eq!(resting["instants"], 401);
    let text = std::fs::read_to_string(&out).unwrap();
    let first: Vec<&str> = text.lines().nth(1).unwrap().split(',').collect();
    assert!(first[column].parse::<f64>().unwrap().abs() < 1e-12);
    let finer = found(&seconds, &["--steps", "3"]);
    assert_eq!(finer["instants"], 121);
}

#[test]
fn without_a_payload_there_are_speeds_and_no_forces() {
    let (code, doc) = asked(&["designs/presets/bench-l16.toml", "--sine", "x:1:1"]);
    assert_eq!(code, Some(0), "{doc}");
    let leg = &doc["motions"][0]["legs"][0];
    assert!(leg["push"].is_null() && leg["power_w"].is_null() && number(&leg["speed"]["value"]) != 0.0);
    assert!(doc["assumptions"][0].as_str().unwrap().contains("[payload]"));
    assert!(doc["motions"][0]["singular_at_s"].is_null(), "nothing was to be determined");
}

#[test]
fn what_cannot_be_computed_is_refused_with_a_code() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_string()
    };
    let untimed = write("untimed.csv", "x,y,z,roll,pitch,yaw\n0,0,1,0,0,0\n0,0,1.1,0,0,0\n");
    let back = write("back.csv", "t,x,y,z,roll,pitch,yaw\n0,0,0,1,0,0,0\n0,0,0,1.1,0,0,0\n");
    let wide = write("wide.csv", "t,x,y,z,roll,pitch,yaw\n0,0,0,1,0,0,0\n1,0,0,1.1,0,0,120\n");
    for (args, code) in [
        (vec![SIMULATOR], "motion::no_motion"),
        (vec![SIMULATOR, "--sine", "up:1:1"], "motion::bad_manoeuvre"),
        (vec![SIMULATOR, "--accelerate", "x:1:1"], "motion::bad_manoeuvre"),
        (vec![SIMULATOR, "--sine", "x:1:1", "--about", "1,2"], "motion::bad_pose"),
        (vec![SIMULATOR, "--sine", "x:1:1", "--load", "wind"], "motion::no_such_load"),
        (vec![SIMULATOR, "--sine", "x:1:1", "--unit", "furlong"], "motion::unknown_unit"),
        (vec![SIMULATOR, &untimed], "motion::no_times"),
        (vec![SIMULATOR, &back], "motion::bad_trajectory"),
        (vec![SIMULATOR, &wide], "motion::bad_trajectory"),
        (vec![SIMULATOR, "--sine", "x:1:1", "--steps", "3"], "usage::no_effect"),
        (vec![SIMULATOR, "--accelerate", "x:1", "--samples", "30"], "usage::no_effect"),
        (vec![SIMULATOR, &wide, "--about", "home"], "usage::no_effect"),
        (vec!["designs/presets/bench-l16.toml", "--sine", "x:1:1", "--load", "a"], "usage::no_effect"),
    ] {
        let (exit, doc) = asked(&args);
        assert_eq!((exit, &doc["error"]["code"]), (Some(2), &Value::from(code)), "{args:?}: {doc}");
    }
    let (_, doc) = asked(&[SIMULATOR, &back]);
    assert!(doc["error"]["message"].as_str().unwrap().contains("line 3"), "{doc}");
}

#[test]
fn a_load_acts_beside_the_weight() {
    let (_, alone) = asked(&[SIMULATOR, "--accelerate", "z:0"]);
    let (code, loaded) = asked(&[SIMULATOR, "--accelerate", "z:0", "--load", "cabin, surge 0.6 g"]);
    assert!(code == Some(0) || code == Some(1));
    let force = |doc: &Value| number(&doc["motions"][0]["legs"][0]["push"]["value"]);
    assert!((force(&alone) - force(&loaded)).abs() > 100.0);
}
