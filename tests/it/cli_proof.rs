//! `--proof` of `verify`, `fk`, `check` and `assess`, checked by `equipod-check` as somebody without this program would.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use tempfile::TempDir;

/// Whether there is Python; without it a test says that it did not run.
fn python() -> bool {
    let there = Command::new("python3").arg("--version").output().is_ok_and(|out| out.status.success());
    #[allow(clippy::print_stderr, reason = "a test that does not run says so")]
    if !there {
        eprintln!("NOT RUN: there is no `python3`, and proof files are not checked");
    }
    there
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A proof file and the folder that holds it.
struct Proof {
    folder: TempDir,
    document: Value,
}

/// Exit code and text of `equipod-check`: the single file, away from the package.
fn checked(path: &Path) -> (Option<i32>, String) {
    let program = root().join("src/app/python/equipod_check/check.py");
    let out = Command::new("python3").arg("-I").arg(program).arg(path).output().unwrap();
    (out.status.code(), String::from_utf8(out.stdout).unwrap())
}

impl Proof {
    /// The proof that a command writes; designs by their path in `designs`.
    fn of(command: &str, designs: &[&str], more: &[&str]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("proof.json");
        let mut program = Command::new(env!("CARGO_BIN_EXE_equipod"));
        program.arg(command).args(designs.iter().map(|d| root().join("designs").join(d))).args(more);
        let out = program.arg("--proof").arg(&path).output().unwrap();
        assert!(path.exists(), "{out:?}");
        let document = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
        Self { folder, document }
    }

    fn write(&self, document: &Value) -> PathBuf {
        let path = self.folder.path().join("proof.json");
        std::fs::write(&path, document.to_string()).unwrap();
        path
    }

    fn kinds(&self) -> Vec<&str> {
        self.document["claims"].as_array().unwrap().iter().map(|c| c["claim"].as_str().unwrap()).collect()
    }

    /// Every claim holds, and these kinds are among them.
    fn holds(&self, kinds: &[&str]) {
        let (code, text) = checked(&self.write(&self.document));
        assert_eq!(code, Some(0), "{text}");
        for kind in kinds {
            assert!(self.kinds().contains(kind), "no {kind} in {text}");
        }
    }

    /// Keeps only these claims, by name.
    fn only(mut self, ids: &[&str]) -> Self {
        let claims = self.document["claims"].as_array_mut().unwrap();
        claims.retain(|claim| ids.contains(&claim["id"].as_str().unwrap()));
        assert_eq!(claims.len(), ids.len());
        self
    }

    /// A fault planted in the file makes the claim `id` fail by name.
    fn refutes(&self, id: &str, plant: impl FnOnce(&mut Value)) {
        let mut faulty = self.document.clone();
        plant(&mut faulty);
        assert_ne!(faulty, self.document, "no fault was planted");
        let (code, text) = checked(&self.write(&faulty));
        assert_eq!(code, Some(1), "{text}");
        assert!(text.contains(&format!("DOES NOT HOLD: {id} (")), "{text}");
    }
}

/// The claim of a name.
fn claim<'a>(document: &'a mut Value, id: &str) -> &'a mut Value {
    let claims = document["claims"].as_array_mut().unwrap();
    claims.iter_mut().find(|claim| claim["id"] == id).unwrap()
}

/// Changes the last digit of the numerator of an exact number.
fn change(number: &mut Value) {
    let text = number.as_str().unwrap();
    let numerator = text.split('/').next().unwrap().len();
    let at = text[..numerator].rfind(|c: char| c.is_ascii_digit()).unwrap();
    let digit = if text.as_bytes()[at] == b'7' { "5" } else { "7" };
    *number = format!("{}{digit}{}", &text[..at], &text[at + 1..]).into();
}

/// Changes the third digit of an exact number, or its last one.
fn change_high(number: &mut Value) {
    let text = number.as_str().unwrap();
    let at = text.match_indices(|c: char| c.is_ascii_digit()).map(|(at, _)| at).take(3).last().unwrap();
    let digit = if text.as_bytes()[at] == b'7' { "5" } else { "7" };
    *number = format!("{}{digit}{}", &text[..at], &text[at + 1..]).into();
}

#[test]
fn an_equivalence_is_checked_and_its_faults_are_named() {
    if !python() {
        return;
    }
    let pair = ["rbt-octahedral.toml", "rbt-griffis-duffy.toml"];
    let proof = Proof::of("verify", &pair, &["--samples", "1"]);
    proof.holds(&["leg_map", "regular_pose"]);
    assert_eq!(proof.document["claims"][0]["det"], "819/3125");
    proof.refutes("leg-map", |d| change(&mut claim(d, "leg-map")["A"][2][2]));
    proof.refutes("leg-map", |d| change(&mut claim(d, "leg-map")["c"][4]));
    proof.refutes("leg-map", |d| change(&mut claim(d, "leg-map")["det"]));
    proof.refutes("leg-map", |d| change(&mut d["designs"][1]["legs"][3]["platform"][0]));
    proof.refutes("leg-map", |d| {
        claim(d, "leg-map").as_object_mut().unwrap().remove("A");
    });
    proof.refutes("regular-1", |d| change(&mut claim(d, "regular-1")["det"]));
    let bench = ["worked/bench-octahedral.toml", "worked/bench-joint-free.toml"];
    Proof::of("verify", &bench, &["--samples", "1"]).holds(&["leg_map", "regular_pose"]);
}

#[test]
fn singular_and_unrelated_pairs_are_checked() {
    if !python() {
        return;
    }
    let singular = Proof::of("verify", &["rbt-octahedral.toml", "rbt-midline.toml"], &[]);
    singular.holds(&["leg_map", "dependency"]);
    assert_eq!(singular.document["claims"][0]["det"], "0");
    singular.refutes("dependency-2-1", |d| change(&mut claim(d, "dependency-2-1")["coefficients"][1]));
    let unrelated =
        Proof::of("verify", &["rbt-octahedral.toml", "symmetric-hexapod.toml"], &["--samples", "1"]);
    unrelated.holds(&["no_leg_map"]);
    let to_itself = |d: &mut Value| claim(d, "no-leg-map")["to"] = 0.into();
    unrelated.refutes("no-leg-map", to_itself);
}

#[test]
fn architectures_are_checked_and_their_faults_are_named() {
    if !python() {
        return;
    }
    let singular = Proof::of("check", &["rbt-midline.toml"], &[]);
    singular.holds(&["dependency", "leg_rank", "generic_rank"]);
    singular.refutes("leg-rank", |d| claim(d, "leg-rank")["rank"] = 6.into());
    singular.refutes("generic-rank", |d| claim(d, "generic-rank")["rank"] = 4.into());
    singular.refutes("dependency-1-1", |d| change(&mut d["designs"][0]["legs"][0]["base"][0]));
    singular.refutes("dependency-1-1", |d| change(&mut claim(d, "dependency-1-1")["constant"]));
    let hexapod = Proof::of("check", &["symmetric-hexapod.toml"], &[]);
    hexapod.holds(&["leg_rank", "regular_pose"]);
    hexapod.refutes("regular", |d| claim(d, "regular")["sign"] = 0.into());
    hexapod.refutes("regular", |d| change(&mut claim(d, "regular")["pose"]["position"][2]));
    hexapod.refutes("regular", |d| change(&mut d["designs"][0]["legs"][5]["base"][1]));
    let free = Proof::of("check", &["worked/bench-joint-free.toml"], &[]);
    free.holds(&["regular_pose", "leg_map", "equivalent_bound"]);
    free.refutes("bound-1", |d| {
        d["claims"].as_array_mut().unwrap().retain(|claim| claim["id"] != "leg-map-2");
    });
}

#[test]
fn complete_lists_of_poses_are_checked() {
    if !python() {
        return;
    }
    let lengths = ["--lengths", "245,250,240,255,248,252"];
    for (design, more) in [
        ("rbt-octahedral.toml", &[][..]),
        ("rbt-griffis-duffy.toml", &[]),
        ("worked/bench-joint-free.toml", &lengths),
    ] {
        let proof = Proof::of("fk", &[design], more);
        proof.holds(&["root", "complete"]);
        assert_eq!(proof.kinds().iter().filter(|k| **k == "root").count(), 16);
    }
}

#[test]
fn faults_in_lists_of_poses_are_named() {
    if !python() {
        return;
    }
    let proof = Proof::of("fk", &["rbt-octahedral.toml"], &[]);
    proof.refutes("complete", |d| {
        claim(d, "complete")["roots"].as_array_mut().unwrap().pop();
    });
    proof.refutes("complete", |d| {
        let mut again = claim(d, "pose-1").clone();
        again["id"] = "pose-2".into();
        *claim(d, "pose-2") = again;
    });
    let one = proof.only(&["pose-1"]);
    one.refutes("pose-1", |d| change_high(&mut claim(d, "pose-1")["centre"]["re"][5]));
    one.refutes("pose-1", |d| claim(d, "pose-1")["radius"] = "1/10000000000000000000000".into());
    one.refutes("pose-1", |d| claim(d, "pose-1")["uniqueness_radius"] = "10".into());
    one.refutes("pose-1", |d| change_high(&mut claim(d, "pose-1")["pose"]["R"]["re"][0]));
    one.refutes("pose-1", |d| change(&mut d["designs"][0]["legs"][4]["base"][0]));
    one.refutes("pose-1", |d| change_high(&mut d["lengths"][0][1]));
    one.refutes("pose-1", |d| {
        let reality = if claim(d, "pose-1")["reality"] == "real" { "non_real" } else { "real" };
        claim(d, "pose-1")["reality"] = reality.into();
    });
}

#[test]
fn lengths_that_contradict_a_relation_have_no_pose() {
    if !python() {
        return;
    }
    let proof = Proof::of("fk", &["rbt-midline.toml"], &["--lengths", "18,18,17,16,15,18"]);
    proof.holds(&["no_pose"]);
    proof.refutes("no-pose", |d| change(&mut claim(d, "no-pose")["coefficients"][0]));
}

#[test]
fn margins_at_poses_and_over_a_region_are_checked_and_their_faults_are_named() {
    if !python() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("small.toml");
    let text = std::fs::read_to_string(root().join("designs/worked/bench-joint-free.toml")).unwrap();
    let text = text.replace("translation = [25.0, 25.0, 20.0]", "translation = [6.0, 6.0, 0.0]");
    std::fs::write(&path, text.replace("rotation_deg = [8.0, 8.0, 8.0]", "rotation_deg = [3.0, 0.0, 3.0]"))
        .unwrap();
    let proof = Proof::of("assess", &[path.to_str().unwrap()], &["--points", "200"]);
    let kinds = ["margin", "margin_over_region", "regular_pose", "regular_region"];
    proof.holds(&kinds);
    let cone = proof.only(&[
        "base_cone_angle",
        "max_leg_length",
        "regular-home",
        "max_leg_length-region",
        "regular-region",
    ]);
    cone.refutes("base_cone_angle", |d| claim(d, "base_cone_angle")["at_least"] = "359/10".into());
    cone.refutes("base_cone_angle", |d| {
        let axis = &mut claim(d, "base_cone_angle")["axes"][0];
        *axis = serde_json::json!(["1", "0", "0"]);
    });
    cone.refutes("max_leg_length", |d| claim(d, "max_leg_length")["limits"][2] = "200".into());
    cone.refutes("regular-home", |d| claim(d, "regular-home")["sign"] = 0.into());
    cone.refutes("max_leg_length-region", |d| claim(d, "max_leg_length-region")["at_least"] = "90".into());
    cone.refutes("max_leg_length-region", |d| claim(d, "max_leg_length-region")["trees"][3] = "".into());
    cone.refutes("regular-region", |d| {
        claim(d, "regular-region")["region"]["translation"] = serde_json::json!(["200", "200", "200"]);
    });
}

/// The checker has no regions to one side of home, about a pivot or along ranges: the file says so.
#[test]
fn regions_that_the_checker_does_not_know_are_left_out() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("design.toml");
    let text = std::fs::read_to_string(root().join("designs/worked/bench-joint-free.toml")).unwrap();
    let old = "translation = [25.0, 25.0, 20.0]";
    assert!(text.contains(old));
    for new in [
        "translation = [[-2.0, 6.0], 6.0, 0.0]",
        "pivot = [0, 0, 9]\ntranslation = [6.0, 6.0, 0.0]",
        "ranges = { x = 3 }\ntranslation = [0.0, 0.0, 0.0]",
    ] {
        let text = text
            .replace(old, new)
            .replace("rotation_deg = [8.0, 8.0, 8.0]", "rotation_deg = [0.0, 0.0, 0.0]");
        std::fs::write(&path, text).unwrap();
        let proof = Proof::of("assess", &[path.to_str().unwrap()], &["--points", "200"]);
        let claims = proof.document["claims"].as_array().unwrap();
        assert!(claims.iter().all(|c| c.get("region").is_none()), "{new}");
        let left = proof.document["not_included"].as_array().unwrap();
        let says = |words: &str| left.iter().any(|l| l["statement"].as_str().unwrap().ends_with(words));
        assert!(
            says(if new.starts_with("ranges") { "ranges of single coordinates" } else { "over the region" }),
            "{new}"
        );
    }
}

#[test]
fn a_file_without_claims_or_of_another_kind_is_no_proof() {
    if !python() {
        return;
    }
    let proof = Proof::of("check", &["rbt-octahedral.toml"], &[]);
    let mut empty = proof.document.clone();
    empty["claims"] = serde_json::json!([]);
    let (code, text) = checked(&proof.write(&empty));
    assert_eq!(code, Some(3), "{text}");
    assert!(text.contains("nothing is proved"), "{text}");
    for other in [
        serde_json::json!({}),
        serde_json::json!([1]),
        serde_json::json!({"equipod_proof": "check", "schema_version": 2}),
    ] {
        assert_eq!(checked(&proof.write(&other)).0, Some(2));
    }
    assert_eq!(checked(Path::new("no-such-file.json")).0, Some(2));
    let mut unknown = proof.document.clone();
    unknown["claims"][0]["claim"] = "everything_is_fine".into();
    assert_eq!(checked(&proof.write(&unknown)).0, Some(1));
}

#[test]
fn a_proof_overwrites_no_design() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("design.toml");
    std::fs::copy(root().join("designs/rbt-octahedral.toml"), &path).unwrap();
    for (design, target) in [(path.clone(), &path), (root().join("designs/rbt-midline.toml"), &path)] {
        let out = Command::new(env!("CARGO_BIN_EXE_equipod"))
            .arg("check")
            .arg(design)
            .arg("--proof")
            .arg(target)
            .output()
            .unwrap();
        assert_eq!(out.status.code(), Some(2), "{out:?}");
    }
    assert_eq!(
        std::fs::read(&path).unwrap(),
        std::fs::read(root().join("designs/rbt-octahedral.toml")).unwrap()
    );
}
