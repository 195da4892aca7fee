//! The process `equipod bench`.

use std::process::{Command, Output};

use serde_json::Value;

fn equipod(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_equipod")).args(args).output().unwrap()
}

fn json(args: &[&str]) -> (Option<i32>, Value) {
    let out = equipod(&[args, &["--json"]].concat());
    (out.status.code(), serde_json::from_slice(&out.stdout).unwrap())
}

#[test]
fn the_document_has_the_fields_of_the_contract() {
    let (code, doc) =
        json(&["bench", "--class", "octahedral", "--count", "5", "--seed", "3", "--threads", "2"]);
    assert_eq!(code, Some(0), "{doc}");
    for key in
        ["class", "count", "complete", "certified", "missed_roots", "spurious_roots", "false_certificates"]
    {
        assert!(!doc[key].is_null(), "{key}");
    }
    for key in ["median_us", "p99_us", "worst_residual"] {
        assert!(doc[key].as_f64().unwrap() > 0.0, "{key}");
    }
    assert!(doc["reference_us"]["qz69"].as_f64() > doc["reference_us"]["eig40"].as_f64());
    assert_eq!((doc["complete"].as_u64(), doc["expected_count"].as_u64()), (Some(5), Some(16)));
    assert_eq!(doc["finite_counts"]["16"], 5);
}

#[test]
fn eliminations_are_measured_before_refinement() {
    let run = |method: &str| json(&["bench", "--class", "6-6", "--count", "3", "--method", method]).1;
    for (method, matrix, candidates, library) in
        [("template", (293, 362), 69, Some("faer")), ("sylvester", (15, 15), 40, None)]
    {
        let doc = run(method);
        let raw = &doc["raw"];
        let size = ["rows", "columns"].map(|key| raw["matrix"][key].as_u64().unwrap());
        assert_eq!((size[0], size[1], raw["candidates"].as_u64()), (matrix.0, matrix.1, Some(candidates)));
        assert_eq!((raw["refused"].as_u64(), raw["infinite"].as_u64()), (Some(0), Some(0)));
        let median = |of: &Value| of["epsilon"]["median"].as_f64().unwrap();
        assert!(median(raw) > median(&doc), "refinement sharpens: {doc}");
        let bins = raw["bins"].as_array().unwrap();
        assert_eq!(bins.iter().map(|bin| bin["count"].as_u64().unwrap()).sum::<u64>(), 3);
        assert_eq!(raw["steps"].as_array().unwrap().len(), 3);
        assert_eq!(raw["steps"][2]["library"].as_str(), library);
        assert_eq!(raw["gap"].is_null(), method == "sylvester");
    }
    assert!(run("homotopy")["raw"].is_null());
}

#[test]
fn noise_gives_a_table_and_a_picture() {
    let folder = tempfile::tempdir().unwrap();
    let svg = folder.path().join("noise.svg");
    let run =
        || json(&["bench", "--noise", "--class", "6-6,6P-6", "--count", "3", "--svg", svg.to_str().unwrap()]);
    let (code, doc) = run();
    assert_eq!((code, doc["rows"].as_array().unwrap().len()), (Some(0), 2), "{doc}");
    assert_eq!((doc["count"].as_u64(), doc["rows"][1]["class"].as_str()), (Some(3), Some("6P-6")));
    let levels = doc["rows"][0]["levels"].as_array().unwrap();
    assert!(levels.len() > 10 && levels[0]["sigma"] == 0.0);
    for key in ["lower_quartile", "median", "upper_quartile", "p99", "max"] {
        assert!(levels[3]["rotation_rad"][key].as_f64().unwrap() > 0.0, "{key}");
        assert!(levels[3]["position_rad"][key].as_f64().unwrap() > 0.0, "{key}");
    }
    let picture = std::fs::read_to_string(&svg).unwrap();
    assert!(picture.contains("6P-6") && !picture.contains("NaN"));
    assert_eq!((run().1, std::fs::read_to_string(&svg).unwrap()), (doc, picture));
}

#[test]
fn what_cannot_be_run_is_refused() {
    for (args, code) in [
        (["bench", "--class", "T35"].as_slice(), "bench::unknown_class"),
        (&["bench", "--class", "7-7"], "bench::unknown_class"),
        (&["bench", "--class", "T04", "--lengths-from", "uniform"], "bench::needs_pose"),
        (&["bench", "--class", "hexapod", "--lengths-from", "uniform"], "bench::needs_pose"),
        (&["bench", "--count", "0"], "usage"),
        (&["bench", "--svg", "x.svg"], "usage"),
        (&["bench", "--noise", "--first", "3"], "usage"),
        (&["bench", "--noise", "--class", "all", "--svg", "x.svg"], "bench::too_many_classes"),
    ] {
        let (exit, doc) = json(args);
        assert_eq!((exit, doc["error"]["code"].as_str()), (Some(2), Some(code)));
    }
}
