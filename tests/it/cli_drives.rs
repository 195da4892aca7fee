//! `equipod build drives` as a process: which drives of a table fit, in which order, the design that it writes,
//! refusals.

use std::path::Path;

use serde_json::Value;

use super::cli_frame::{document, equipod};

/// The bench hexapod with a workspace so small that its proofs are quick.
pub(super) fn bench(folder: &Path) -> String {
    let mut text = std::fs::read_to_string("designs/presets/bench-l16.toml").unwrap();
    for (from, to) in [
        ("translation = [30.0, 30.0, 25.0]", "translation = [8.0, 8.0, 8.0]"),
        ("rotation_deg = [10.0, 10.0, 10.0]", "rotation_deg = [2.0, 2.0, 2.0]"),
    ] {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    let path = folder.join("bench.toml");
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_string()
}

pub(super) fn table(folder: &Path, text: &str) -> String {
    let path = folder.join("drives.csv");
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_string()
}

fn asked(args: &[&str]) -> (Option<i32>, Value) {
    let out = equipod(&[&["build", "drives"], args, &["--json"]].concat());
    (out.status.code(), document(&out))
}

fn of<'a>(doc: &'a Value, name: &str) -> &'a Value {
    doc["drives"].as_array().unwrap().iter().find(|d| d["name"] == name).unwrap()
}

fn margin(drive: &Value, of: &str) -> f64 {
    let list = drive["assessment"]["requirements"].as_array().unwrap();
    list.iter().find(|m| m["name"] == of).unwrap()["margin"].as_f64().unwrap()
}

#[test]
fn the_cheapest_drive_that_fits_comes_first_and_its_design_is_accepted_by_assess() {
    let folder = tempfile::tempdir().unwrap();
    let bench = &bench(folder.path());
    let drives = table(
        folder.path(),
        "name,stroke_cm,retracted_length_mm,force_N,speed_mm/s,mass_kg,price_EUR\n\
         dear,10,198,60,12,2,300\n\
         cheap heavy,10,198,50,11,3,200\n\
         cheap,10,198,50,11,2,200\n\
         short,3,198,50,11,1,10\n\
         slow,10,198,50,0.5,1,20\n\
         weak,10,198,5,11,1,30\n",
    );
    let written = folder.path().join("driven.toml");
    let written = written.to_str().unwrap();
    let (code, doc) = asked(&[bench, &drives, "-o", written]);
    assert_eq!((code, &doc["met"]), (Some(0), &Value::from(true)), "{doc}");
    let names: Vec<&str> =
        doc["drives"].as_array().unwrap().iter().map(|d| d["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["cheap", "cheap heavy", "dear", "short", "slow", "weak"]);
    assert_eq!((doc["chosen"].as_str(), doc["currency"].as_str()), (Some("cheap"), Some("EUR")));
    for (name, fault) in [("short", "max_leg_length"), ("slow", "leg_speed"), ("weak", "leg_force")] {
        let drive = of(&doc, name);
        assert_eq!(drive["fits"], false);
        assert!(margin(drive, fault) < 0.0, "{name}");
    }
    // a limit that is larger by 10 N leaves 10 N more
    let (a, b) = (of(&doc, "cheap"), of(&doc, "dear"));
    assert!((margin(b, "leg_force") - margin(a, "leg_force") - 10.0).abs() < 1e-9);
    let text = std::fs::read_to_string(written).unwrap();
    let read =
        |text: &str| equipod::methods::design::parse(text, equipod::methods::design::Format::Toml).unwrap().0;
    let (before, after) = (read(&std::fs::read_to_string(bench).unwrap()), read(&text));
    assert_eq!(after.hardware.leg_length.unwrap().range(), (198.0, 298.0));
    assert_eq!((after.hardware.max_leg_force, after.hardware.max_leg_speed), (Some(50.0), Some(11.0)));
    assert_eq!((after.home, after.manipulator()), (before.home, before.manipulator()));
    assert_eq!(equipod(&["assess", written]).status.code(), Some(0));
}

#[test]
#[ignore = "evidence"]
fn a_motion_asks_more_of_the_drives_than_the_workspace() {
    let folder = tempfile::tempdir().unwrap();
    let bench = &bench(folder.path());
    let drives = table(
        folder.path(),
        "name,stroke,retracted_length,force,speed,price\nslow,100,198,60,11,1\nfast,100,198,60,200,2\n",
    );
    let (code, doc) = asked(&[bench, &drives]);
    assert_eq!((code, doc["chosen"].as_str()), (Some(0), Some("slow")));
    let (code, doc) = asked(&[bench, &drives, "--sine", "z:5:1"]);
    assert_eq!((code, doc["chosen"].as_str()), (Some(0), Some("fast")), "{doc}");
    let motion = &of(&doc, "slow")["motions"][0];
    assert_eq!(motion["met"], false);
    let (code, doc) = asked(&[bench, &drives, "--sine", "z:5:20"]);
    assert_eq!((code, &doc["chosen"], &doc["design"]), (Some(1), &Value::Null, &Value::Null));
}

#[test]
fn tables_that_cannot_be_used_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let bench = &bench(folder.path());
    for text in [
        "stroke,force\n100,5\n",
        "name,stroke_N,dead_length\na,100,98\n",
        "name,stroke,dead_length\na,100,-1\n",
    ] {
        let drives = table(folder.path(), text);
        let (code, doc) = asked(&[bench, &drives]);
        assert_eq!((code, doc["error"]["code"].as_str()), (Some(2), Some("drives::bad_table")), "{doc}");
    }
    let drives = table(folder.path(), "name,stroke,dead_length\na,100,98\n");
    let (code, doc) = asked(&[bench, &drives, "--unit", "mm"]);
    assert_eq!((code, doc["error"]["code"].as_str()), (Some(2), Some("usage::no_effect")), "{doc}");
}
