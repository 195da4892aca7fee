//! `equipod verify` as a process.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

fn design(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("designs").join(name)
}

fn verify(a: &Path, b: &Path, more: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_equipod")).arg("verify").args([a, b]).args(more).output().unwrap()
}

fn document(out: &Output) -> Value {
    serde_json::from_slice(&out.stdout).unwrap()
}

#[test]
fn the_published_pair_is_equivalent_at_ten_samples() {
    let out = verify(&design("rbt-octahedral.toml"), &design("rbt-griffis-duffy.toml"), &["--json"]);
    assert_eq!(out.status.code(), Some(0), "{out:?}");
    let v = document(&out);
    assert_eq!((&v["schema_version"], &v["verdict"]), (&1.into(), &"equivalent".into()));
    let samples = v["samples"].as_array().unwrap();
    assert_eq!(samples.len(), 10);
    for s in samples {
        assert_eq!((s["matched"].as_u64(), s["agrees"].as_bool()), (Some(16), Some(true)));
        assert_eq!((s["a"]["method"].as_str(), s["b"]["method"].as_str()), (Some("octic"), Some("homotopy")));
        assert_eq!(s["a"]["completeness"], "proved");
    }
    assert!(v["worst_distance"].as_f64().unwrap() < 1e-9);
    assert!((v["map"]["det"].as_f64().unwrap() - 0.26208).abs() < 1e-9);
}

#[test]
fn poses_that_rounding_of_the_joints_makes_do_not_spoil_the_verdict() {
    // Rounded joints make the 6-6 a platform with 24 more poses, at |R| of about 1e13. `verify` does not search for them,
    // and those that it meets do not speak against the pair.
    let (a, b) = (design("worked/isolator-octahedral.toml"), design("worked/isolator-1.toml"));
    let out = verify(&a, &b, &["--json"]);
    assert_eq!(out.status.code(), Some(0), "{out:?}");
    let v = document(&out);
    assert_eq!((v["verdict"].as_str(), &v["beyond_precision"]["a"]), (Some("equivalent"), &0.into()));
    let samples = v["samples"].as_array().unwrap();
    let beyond: u64 = samples.iter().map(|s| s["beyond_precision_b"].as_u64().unwrap()).sum();
    assert_eq!(v["beyond_precision"]["b"], beyond);
    for s in samples {
        let counts = ["matched", "only_a", "only_b"].map(|k| s[k].as_u64());
        assert_eq!((counts, s["agrees"].as_bool()), ([Some(16), Some(0), Some(0)], Some(true)));
    }
    let text = String::from_utf8(verify(&a, &b, &[]).stdout).unwrap();
    let rows = text.lines().filter(|l| l.ends_with("of B beyond double precision")).count();
    let said = text.contains(&format!("; {beyond} further poses so far out"));
    assert_eq!((rows > 0, said), (beyond > 0, beyond > 0), "{text}");
    let more = verify(&a, &b, &["--seed", "3", "--samples", "30"]);
    assert_eq!(more.status.code(), Some(0), "{more:?}");
}

#[test]
fn a_joint_moved_by_a_millionth_is_refuted_with_a_certified_pose() {
    let text = std::fs::read_to_string(design("rbt-griffis-duffy.toml")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let moved = folder.path().join("moved.toml");
    // the first base joint, lifted out of the plane of the base by a millionth of the size
    let line = text.lines().skip_while(|l| *l != "[base]").find(|l| l.contains("= [")).unwrap();
    let cut = line.rfind(',').unwrap();
    let lifted = format!("{}, 6.9e-6]", &line[..cut]);
    std::fs::write(&moved, text.replace(line, &lifted)).unwrap();
    let out = verify(&design("rbt-octahedral.toml"), &moved, &["--json", "--samples", "2"]);
    assert_eq!(out.status.code(), Some(1), "{out:?}");
    let v = document(&out);
    assert_eq!(v["verdict"], "not_equivalent");
    assert_eq!(v["counterexample"]["certified"], true);
    assert!(v["counterexample"]["miss"].as_f64().unwrap() > 1e-8);
}

#[test]
fn the_midline_platform_is_singular_and_an_unrelated_one_is_not_equivalent() {
    let octahedral = design("rbt-octahedral.toml");
    let out = verify(&octahedral, &design("rbt-midline.toml"), &["--json"]);
    assert_eq!((out.status.code(), document(&out)["verdict"].as_str()), (Some(1), Some("singular")));
    let text = std::fs::read_to_string(design("symmetric-hexapod.toml")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let other = folder.path().join("other.toml");
    let units = text.lines().find(|l| l.starts_with("units")).unwrap();
    let expected = std::fs::read_to_string(&octahedral).unwrap();
    let expected = expected.lines().find(|l| l.starts_with("units")).unwrap();
    std::fs::write(&other, text.replace(units, expected)).unwrap();
    let out = verify(&octahedral, &other, &["--samples", "1"]);
    assert_eq!(out.status.code(), Some(1), "{out:?}");
    let text = String::from_utf8(out.stdout).unwrap();
    assert!(text.contains("not equivalent") && text.contains("misses the squared length"), "{text}");
}

#[test]
fn samples_must_be_a_positive_number() {
    let d = design("rbt-octahedral.toml");
    assert_eq!(verify(&d, &d, &["--samples", "0"]).status.code(), Some(2));
}
