//! `equipod check` as a process.

use equipod::methods::design::Design;
use serde_json::Value;

use super::cli_frame::{document, equipod};
use super::instances::{griffis_duffy, instances};

fn check(path: &str) -> (Option<i32>, Value) {
    let out = equipod(&["check", path, "--json"]);
    (out.status.code(), document(&out))
}

#[test]
fn the_shipped_designs_are_regular_with_a_pose_that_proves_it_but_for_the_midline_platform() {
    for entry in std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/designs")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|e| e != "toml") || path.ends_with("rbt-midline.toml") {
            continue;
        }
        let path = path.to_str().unwrap();
        let (code, doc) = check(path);
        assert_eq!((code, doc["architecturally_singular"].as_bool()), (Some(0), Some(false)), "{path}");
        assert_eq!((doc["leg_rank"].as_u64(), doc["jacobian_rank"].as_u64()), (Some(6), Some(6)));
        assert_eq!(doc["proof"], "regular_pose");
        assert_eq!((&doc["dependency"], &doc["reason"]), (&Value::Null, &Value::Null));
        assert_eq!(doc["witness"]["quaternion"].as_array().unwrap().len(), 4);
        let near = &doc["nearest_singular"];
        let [low, high] = ["distance_at_least", "distance"].map(|k| near[k].as_f64().unwrap());
        assert!(low > 1e-3 && low < high && high > 0.1, "{path}: {low} {high}");
    }
}

#[test]
fn the_midline_platform_is_singular_with_its_dependency_and_condition() {
    let (code, doc) = check("designs/rbt-midline.toml");
    assert_eq!((code, doc["architecturally_singular"].as_bool()), (Some(1), Some(true)));
    assert_eq!((&doc["reason"], &doc["proof"]), (&"leg_vectors_dependent".into(), &"leg_vectors".into()));
    assert_eq!(
        (&doc["cases"][0]["case"], &doc["griffis_duffy"]["det"]),
        (&"griffis_duffy".into(), &0.0.into())
    );
    let d = &doc["dependency"];
    assert_eq!(d["coefficients"], serde_json::json!([1.0, -1.0, 1.0, -1.0, 1.0, -1.0]));
    // - 1/4 sum of (+-) squared sides: 3 (144 - 36) / 4
    assert!((d["constant"].as_f64().unwrap() + 81.0).abs() < 1e-9);
    assert!(d["lengths_defect"].as_f64().unwrap().abs() < 1e-14);
    let g = &doc["griffis_duffy"];
    assert!((g["constant"].as_f64().unwrap() + 81.0).abs() < 1e-9, "{g}");
    assert_eq!((&g["exactly_singular"], &g["assembly"]["verdict"]), (&true.into(), &"real".into()));
    assert!(g["assembly"]["residual"].as_f64().unwrap() < 1e-9);
    // longer by a thousandth: no pose
    let text = std::fs::read_to_string("designs/rbt-midline.toml").unwrap();
    let folder = tempfile::tempdir().unwrap();
    let longer = folder.path().join("longer.toml");
    std::fs::write(&longer, text.replace("17.944915714485816", "17.945915714485816")).unwrap();
    let (code, doc) = check(longer.to_str().unwrap());
    assert_eq!((code, &doc["griffis_duffy"]["assembly"]["verdict"]), (Some(1), &"incompatible".into()));
}

/// A hundred-millionth from the singular surface the lengths of a pose violate its condition, and it says nothing.
#[test]
fn lengths_of_a_nearly_singular_design_are_not_judged_by_the_condition_of_a_singular_one() {
    let text = |t: &str| {
        format!(
            r#"name = "near the surface"
units = "mm"
lengths = [6.4, 7.3, 12.2, 10.6, 17.5, 15.2]
legs = [["Q1", "P4"], ["P2", "Q2"], ["Q3", "P5"], ["P3", "Q4"], ["Q5", "P6"], ["P1", "Q6"]]
[base]
P1 = [0, 0, 0]
P2 = [6, 10, 0]
P3 = [12, 0, 0]
Q1 = {{ on = ["P1", "P2"], t = "{t}" }}
Q3 = {{ on = ["P2", "P3"], t = "1/2" }}
Q5 = {{ on = ["P3", "P1"], t = "1/2" }}
[platform]
P4 = [0, 0, 0]
P5 = [6, 0, 0]
P6 = [3, -5, 0]
Q2 = {{ on = ["P4", "P5"], t = "1/2" }}
Q4 = {{ on = ["P5", "P6"], t = "1/2" }}
Q6 = {{ on = ["P6", "P4"], t = "1/2" }}
"#
        )
    };
    let folder = tempfile::tempdir().unwrap();
    for (t, code, verdict) in [("1/2", 1, "incompatible".into()), ("1/2 + 1/100000000", 0, Value::Null)] {
        let path = folder.path().join("design.toml");
        std::fs::write(&path, text(t)).unwrap();
        let (found, doc) = check(path.to_str().unwrap());
        assert_eq!((found, &doc["griffis_duffy"]["assembly"]["verdict"]), (Some(code), &verdict), "{t}");
    }
}

#[test]
fn the_finite_poses_for_generic_lengths_are_counted() {
    for (path, by_degree) in [
        ("designs/rbt-octahedral.toml", &[1, 10, 5][..]),
        ("designs/general-6-6.toml", &[1, 10, 18, 10, 1][..]),
        // joints that are on the edges by construction: 16 as well
        ("designs/rbt-griffis-duffy.toml", &[1, 10, 5][..]),
        // generic lengths contradict the relation of the legs
        ("designs/rbt-midline.toml", &[][..]),
    ] {
        let (_, answer) = check(path);
        let count = &answer["pose_count"];
        let found: Vec<usize> = serde_json::from_value(count["by_degree"].clone()).unwrap();
        assert_eq!(found, by_degree, "{path}");
        assert_eq!(count["finite"], by_degree.iter().sum::<usize>());
        assert_eq!(count["evidence"], "modular");
        let error = count["error_probability"].as_f64().unwrap();
        assert!(error > 0.0 && error < 1e-9, "{path}: {error:e}");
    }
}

#[test]
fn people_are_told_the_verdict_and_the_algebra_where_they_ask_for_it() {
    let said = |args: &[&str]| String::from_utf8(equipod(args).stdout).unwrap();
    let short = said(&["check", "designs/rbt-midline.toml"]);
    let expected = "\
midline Griffis-Duffy 12-6 (singular): architecturally singular, the legs hold the platform at no pose
Proved about the exact joints: the joints lie on the sides of two triangles (Griffis-Duffy type) with prod t_i = prod (1 - t_i) (legs 1, 2, 3, 4, 5, 6).";
    assert!(short.starts_with(expected) && !short.contains("rank of the leg vectors"), "{short}");
    let long = said(&["check", "designs/rbt-midline.toml", "--details"]);
    for part in [
        "joints: exact numbers of Q(sqrt(3))",
        "rank of the leg vectors     5",
        "generic rank of the lines   5",
        "proof: the leg vectors have rank 5, proved about the exact joints",
        "  squared lengths of every pose: s1 - s2 + s3 - s4 + s5 - s6 = -81",
    ] {
        assert!(long.contains(part), "{part}: {long}");
    }
    let general = said(&["check", "designs/general-6-6.toml"]);
    let count = "Generic leg lengths have 40 poses, real and complex, counted modulo random primes.";
    assert!(general.contains(count), "{general}");
    // three digits, or as many as are asked for
    let digits = |n: &str| said(&["check", "designs/general-6-6.toml", "--digits", n]);
    assert!(
        digits("3").contains("none is nearer than 0.53.") && digits("7").contains("0.5297127"),
        "{}",
        digits("7")
    );
}

#[test]
fn every_case_is_exit_1_with_the_legs_to_blame() {
    let folder = tempfile::tempdir().unwrap();
    for (k, case) in instances().into_iter().enumerate() {
        let path = folder.path().join(format!("{k}.toml"));
        let design = Design::new(case.name, "mm", case.m);
        std::fs::write(&path, design.to_toml()).unwrap();
        let (code, doc) = check(path.to_str().unwrap());
        assert_eq!((code, doc["architecturally_singular"].as_bool()), (Some(1), Some(true)), "{}", case.name);
        assert_eq!(doc["reason"], case.reason, "{}", case.name);
        assert_eq!(doc["cases"][0]["case"], case.name);
        let legs: Vec<u64> =
            doc["cases"][0]["legs"].as_array().unwrap().iter().map(|i| i.as_u64().unwrap()).collect();
        assert_eq!(legs, case.guilty.iter().map(|i| *i as u64 + 1).collect::<Vec<_>>(), "{}", case.name);
        assert_eq!(doc["dependency"].is_null(), case.leg_rank == 6, "{}", case.name);
        assert_eq!(doc["proof"], if case.rank < case.leg_rank { "pose_lattice" } else { "leg_vectors" });
    }
}

#[test]
fn a_design_that_rounding_makes_regular_is_exit_3() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("thirds.toml");
    // offsets a third and two thirds: no joint is on its side exactly
    let t = 1.0 / 3.0;
    let design = Design::new("thirds", "mm", griffis_duffy([t, 1.0 - t, t, 1.0 - t, t, 1.0 - t]));
    std::fs::write(&path, design.to_toml()).unwrap();
    let (code, doc) = check(path.to_str().unwrap());
    assert_eq!((code, &doc["architecturally_singular"]), (Some(3), &Value::Null), "{doc}");
    assert_eq!(
        (doc["singular_as_written"].as_bool(), doc["reason"].as_str()),
        (Some(false), Some("singular_within_rounding"))
    );
    assert_eq!(doc["nearest_singular"]["kind"], "griffis_duffy");
    assert!(doc["griffis_duffy"]["det"].as_f64().unwrap().abs() < 1e-15);
}
