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

/// Changes the first digit of an exact number to 9.
fn change_first(number: &mut Value) {
    let text = number.as_str().unwrap();
    let at = text.find(|c: char| c.is_ascii_digit()).unwrap();
    *number = format!("{}9{}", &text[..at], &text[at + 1..]).into();
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
        ("symmetric-hexapod.toml", &[]),
    ] {
        let proof = Proof::of("fk", &[design], more);
        proof.holds(&["root", "complete"]);
        let poses = if design == "symmetric-hexapod.toml" { 28 } else { 16 };
        assert_eq!(proof.kinds().iter().filter(|k| **k == "root").count(), poses);
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

/// Planar bodies: three inversions of a symmetric hexapod leave 28 poses, an affine map leaves 16.
#[test]
fn bounds_of_planar_bodies_are_checked_and_their_faults_are_named() {
    if !python() {
        return;
    }
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("affine.toml");
    let base = [(0, 0), (40, 0), (60, 20), (50, 50), (10, 60), (-20, 30)];
    let joint =
        |k: usize, (x, y): (i32, i32)| format!("{}{} = [{x}, {y}, 0]\n", ["A", "B"][k / 6], k % 6 + 1);
    let bases: String = (0..6).map(|i| joint(i, base[i])).collect();
    let images: String =
        (0..6).map(|i| joint(i + 6, (2 * base[i].0 + base[i].1, base[i].1 - base[i].0))).collect();
    let legs: Vec<[String; 2]> = (1..7).map(|i| [format!("A{i}"), format!("B{i}")]).collect();
    let head = format!("name = \"affine hexagons\"\nunits = \"mm\"\nlegs = {legs:?}");
    let text = format!("{head}\n[base]\n{bases}[platform]\n{images}");
    std::fs::write(&path, text).unwrap();
    for (design, theorem, poses) in [
        ("symmetric-hexapod.toml", "points_at_infinity", 28),
        (path.to_str().unwrap(), "affine_hexagons", 16),
    ] {
        let proof = Proof::of("check", &[design], &[]);
        proof.holds(&["pose_bound"]);
        let bound = claim(&mut proof.document.clone(), "bound-1").clone();
        assert_eq!((bound["by"].as_str(), bound["poses"].as_u64()), (Some(theorem), Some(poses)));
        let proof = proof.only(&["bound-1"]);
        proof.refutes("bound-1", |d| claim(d, "bound-1")["poses"] = (poses - 4).into());
        // off the plane, and off the position in the plane
        for k in [2, 0] {
            proof.refutes("bound-1", |d| change(&mut d["designs"][0]["legs"][1]["platform"][k]));
        }
    }
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

/// The bench hexapod with another workspace, in a folder.
fn bench_with_workspace(translation: &str, rotation_deg: &str) -> (TempDir, String) {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("design.toml");
    let text = std::fs::read_to_string(root().join("designs/worked/bench-joint-free.toml")).unwrap();
    let replaced = text
        .replace("translation = [25.0, 25.0, 20.0]", translation)
        .replace("rotation_deg = [8.0, 8.0, 8.0]", rotation_deg);
    assert!(!replaced.contains("25.0, 25.0") && !replaced.contains("8.0, 8.0"));
    std::fs::write(&path, replaced).unwrap();
    let path = path.to_str().unwrap().to_owned();
    (folder, path)
}

#[test]
fn regions_aside_of_home_about_a_pivot_are_checked_and_their_faults_are_named() {
    if !python() {
        return;
    }
    let (_folder, design) = bench_with_workspace(
        "translation = [[-2.0, 10.0], 0.0, [-3.0, 1.0]]\npivot = [0, 0, 100]",
        "rotation_deg = [[-1.0, 3.0], 0.0, 0.0]",
    );
    let proof = Proof::of("assess", &[&design], &["--points", "200"]);
    let id = "max_leg_length-region";
    proof.holds(&["margin_over_region", "regular_region"]);
    let region = claim(&mut proof.document.clone(), id)["region"].clone();
    assert_eq!(region["translation"], serde_json::json!([["-2", "10"], ["0", "0"], ["-3", "1"]]));
    assert_eq!(region["pivot"], serde_json::json!(["0", "0", "100"]));
    let proof = proof.only(&[id, "base_cone_angle-region", "regular-region"]);
    proof.refutes(id, |d| change_first(&mut claim(d, id)["region"]["pivot"][2]));
    proof.refutes(id, |d| change_first(&mut claim(d, id)["region"]["translation"][0][1]));
    proof.refutes(id, |d| change_first(&mut claim(d, id)["region"]["home"]["position"][2]));
    proof.refutes(id, |d| claim(d, id)["limits"][4] = "208".into());
    proof.refutes(id, |d| change_first(&mut d["designs"][0]["legs"][1]["platform"][0]));
    // a cell of the ellipsoid called outside, and a cell left out
    for (tree, changed) in [(0, "x"), (5, "")] {
        proof.refutes(id, |d| {
            let tree = &mut claim(d, id)["trees"][tree];
            *tree = tree.as_str().unwrap().replacen('.', changed, 1).into();
        });
    }
    let cone = "base_cone_angle-region";
    proof.refutes(cone, |d| claim(d, cone)["axes"][3] = serde_json::json!(["1", "0", "0"]));
    proof.refutes(cone, |d| claim(d, cone)["axes"][3] = serde_json::json!(["0", "0", "0"]));
    proof.refutes("regular-region", |d| {
        claim(d, "regular-region")["region"]["translation"][2] = serde_json::json!(["-3", "-4"]);
    });
    proof.refutes("regular-region", |d| {
        let region = &mut claim(d, "regular-region")["region"];
        region["rotation_deg"][0] = serde_json::json!(["-1", "93"]);
    });
}

#[test]
fn ranges_of_single_coordinates_are_checked_and_their_faults_are_named() {
    if !python() {
        return;
    }
    let (_folder, design) = bench_with_workspace(
        "ranges = { z = [-2, 10], roll_deg = 5 }\npivot = [0, 0, 100]",
        "rotation_deg = [0.0, 0.0, 0.0]",
    );
    let proof = Proof::of("assess", &[&design], &["--points", "200"]);
    proof.holds(&["margin_over_region", "regular_region"]);
    let text = checked(&proof.write(&proof.document)).1;
    assert!(
        text.contains("at every pose of the box z -2 to 10 from home about the pivot (0, 0, 100)"),
        "{text}"
    );
    assert!(!text.contains("along the range"), "{text}");
    let ids = ["max_leg_length-z", "platform_cone_angle-roll_deg", "regular-z"];
    let proof = proof.only(&ids);
    proof.refutes(ids[0], |d| change_first(&mut claim(d, ids[0])["region"]["translation"][2][1]));
    proof.refutes(ids[0], |d| claim(d, ids[0])["at_least"] = "36".into());
    proof.refutes(ids[1], |d| change_first(&mut claim(d, ids[1])["region"]["pivot"][2]));
    proof.refutes(ids[2], |d| claim(d, ids[2])["tree"] = "2.".into());
}

#[test]
fn gaps_between_legs_are_checked_and_their_faults_are_named() {
    if !python() {
        return;
    }
    let (_folder, design) = bench_with_workspace(
        "translation = [[-2.0, 5.0], 3.0, 0.0]\npivot = [0, 0, 40]",
        "rotation_deg = [1.0, 0.0, 0.0]",
    );
    let proof = Proof::of("assess", &[&design], &["--points", "200"]);
    proof.holds(&["leg_clearance"]);
    let (id, home) = ("leg_clearance-region", "leg_clearance-home");
    let proof = proof.only(&[id, home]);
    for id in [id, home] {
        proof.refutes(id, |d| claim(d, id)["at_least"] = "90".into());
        proof.refutes(id, |d| change_first(&mut claim(d, id)["clearance"]));
        proof.refutes(id, |d| change_first(&mut claim(d, id)["body"]["diameter"]));
        proof.refutes(id, |d| claim(d, id)["body"]["rod_diameter"] = "90".into());
        proof.refutes(id, |d| claim(d, id)["pairs"][2]["directions"] = "".into());
        proof.refutes(id, |d| claim(d, id)["pairs"][7]["tree"] = "".into());
        proof.refutes(id, |d| {
            claim(d, id)["pairs"].as_array_mut().unwrap().remove(4);
        });
        proof.refutes(id, |d| change_first(&mut d["designs"][0]["legs"][0]["platform"][1]));
    }
    proof.refutes(id, |d| claim(d, id)["region"]["translation"][0][1] = "90".into());
    proof.refutes(id, |d| claim(d, id)["region"]["pivot"][2] = "900".into());
}

#[test]
fn leg_forces_are_checked_and_their_faults_are_named() {
    if !python() {
        return;
    }
    let (_folder, design) = bench_with_workspace(
        "translation = [[-2.0, 5.0], 3.0, 0.0]\npivot = [0, 0, 40]",
        "rotation_deg = [1.0, 0.0, 0.0]",
    );
    let proof = Proof::of("assess", &[&design], &["--points", "200"]);
    proof.holds(&["leg_force"]);
    let (id, home) = ("leg_force-region", "leg_force-home");
    let proof = proof.only(&[id, home]);
    for id in [id, home] {
        proof.refutes(id, |d| change_first(&mut claim(d, id)["at_least"]));
        proof.refutes(id, |d| claim(d, id)["limit"] = "20".into());
        proof.refutes(id, |d| claim(d, id)["loads"][0]["force"][2] = "-900".into());
        proof.refutes(id, |d| claim(d, id)["loads"][0]["at"][0] = "900".into());
        proof.refutes(id, |d| claim(d, id)["loads"][0]["torque"][1] = "9000".into());
        proof.refutes(id, |d| claim(d, id)["loads"][0]["tree"] = "".into());
    }
    proof.refutes(id, |d| claim(d, id)["region"]["translation"][0][1] = "90".into());
    proof.refutes(id, |d| claim(d, id)["region"]["pivot"][2] = "900".into());
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
    let twice = proof.document.to_string().replacen('{', "{\"equipod_proof\": \"fk\", ", 1);
    let path = proof.write(&proof.document);
    std::fs::write(&path, twice).unwrap();
    assert_eq!(checked(&path).0, Some(2));
    // a name forges no line of the answer
    let mut forged = proof.document.clone();
    forged["designs"][0]["name"] = "design\nholds: forged".into();
    let (code, text) = checked(&proof.write(&forged));
    assert!(code == Some(0) && text.contains("design holds: forged"), "{text}");
    assert!(!text.lines().any(|line| line.starts_with("holds: forged")), "{text}");
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
