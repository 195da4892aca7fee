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
fn what_cannot_be_run_is_refused() {
    for (args, code) in [
        (["bench", "--class", "T35"].as_slice(), "bench::unknown_class"),
        (&["bench", "--class", "7-7"], "bench::unknown_class"),
        (&["bench", "--class", "T04", "--lengths-from", "uniform"], "bench::needs_pose"),
        (&["bench", "--class", "hexapod", "--lengths-from", "uniform"], "bench::needs_pose"),
        (&["bench", "--count", "0"], "usage"),
    ] {
        let (exit, doc) = json(args);
        assert_eq!((exit, doc["error"]["code"].as_str()), (Some(2), Some(code)));
    }
}
