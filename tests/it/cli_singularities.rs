//! The processes `equipod singular motion` and `equipod singular poses`.

use super::cli_frame::{document, equipod};
use super::evidence::size;

#[test]
#[ignore = "evidence"]
fn the_midline_platform_moves_on_two_closed_curves() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (csv, svg) = (file("m.csv"), file("m.svg"));
    let out =
        equipod(&["singular", "motion", "designs/rbt-midline.toml", "--csv", &csv, "--svg", &svg, "--json"]);
    let doc = document(&out);
    assert_eq!(out.status.code(), Some(0), "{doc}");
    assert_eq!(doc["dimension"], 1);
    assert!(doc["worst_length_error"].as_f64().unwrap() < 1e-12);
    let curves = doc["curves"].as_array().unwrap();
    assert!(curves.iter().all(|c| c["end"] == "closed"));
    let degrees: Vec<u64> = curves.iter().map(|c| c["degree"]["degree"].as_u64().unwrap()).collect();
    assert_eq!(degrees, [4, 24]);
    let points: usize = curves.iter().map(|c| c["points"].as_array().unwrap().len()).sum();
    assert_eq!(std::fs::read_to_string(csv).unwrap().lines().count(), points + 1);
    assert!(std::fs::read_to_string(svg).unwrap().contains("<animate "));
    assert_eq!(
        (doc["components_accounted"].as_bool(), doc["completeness"].as_str()),
        (Some(true), Some("unproved"))
    );
    assert_eq!(doc["critical_points"]["paths"], 7 * 28);
}

#[test]
#[ignore = "evidence"]
fn lengths_alone_give_the_curves_that_the_pose_gives() {
    let start = equipod(&["singular", "motion", "designs/rbt-midline.toml", "--sections", "0", "--json"]);
    let start = document(&start);
    assert_eq!(
        (start["curves"].as_array().unwrap().len(), &start["components_accounted"]),
        (1, &serde_json::Value::Null)
    );
    let lengths: Vec<String> = start["lengths"].as_array().unwrap().iter().map(ToString::to_string).collect();
    let out = equipod(&[
        "singular",
        "motion",
        "designs/rbt-midline.toml",
        "--lengths",
        &lengths.join(","),
        "--json",
    ]);
    let doc = document(&out);
    assert_eq!((out.status.code(), doc["dimension"].as_u64()), (Some(0), Some(1)), "{doc}");
    assert_eq!(
        (&doc["start"], doc["components_accounted"].as_bool()),
        (&serde_json::Value::Null, Some(true))
    );
    let mut degrees: Vec<u64> =
        doc["curves"].as_array().unwrap().iter().map(|c| c["degree"]["degree"].as_u64().unwrap()).collect();
    degrees.sort_unstable();
    assert_eq!(degrees, [4, 24]);
    // lengths that contradict the relation of the legs: proved, no pose at all
    let out = equipod(&[
        "singular",
        "motion",
        "designs/rbt-midline.toml",
        "--lengths",
        "10,10,10,10,10,11",
        "--json",
    ]);
    let doc = document(&out);
    assert_eq!((out.status.code(), doc["dimension"].as_u64()), (Some(1), Some(0)));
    let out = equipod(&["singular", "motion", "designs/rbt-midline.toml", "--lengths", "1,2", "--json"]);
    assert_eq!(document(&out)["error"]["code"], "motion::bad_lengths");
}

#[test]
fn a_regular_platform_has_no_self_motion() {
    let out = equipod(&["singular", "motion", "designs/rbt-octahedral.toml", "--json"]);
    let doc = document(&out);
    assert_eq!((out.status.code(), doc["dimension"].as_u64()), (Some(1), Some(0)));
    let out = equipod(&["singular", "motion", "designs/rbt-octahedral.toml", "--pose", "1,2", "--json"]);
    assert_eq!(document(&out)["error"]["code"], "motion::bad_pose");
}

#[test]
fn equivalent_platforms_have_the_same_regular_box() {
    let cells = size("1000", "4000");
    let folder = tempfile::tempdir().unwrap();
    let svg = folder.path().join("s.svg");
    let run = |design: &str| {
        let pose = "0,0,9,0,0,25";
        let shape = "2,2,2,10,10,10";
        let args = ["singular", "poses", design, "--pose", pose, "--box", shape, "--cells", cells, "--json"];
        let out = equipod(&[&args[..], &["--svg", svg.to_str().unwrap()]].concat());
        let doc = document(&out);
        assert_eq!(out.status.code(), Some(0), "{doc}");
        let bounds = (
            doc["box"]["proved_scale"].as_f64().unwrap(),
            doc["box"]["singular_within"]["scale"].as_f64().unwrap(),
        );
        (doc, bounds)
    };
    let (octahedral, one) = run("designs/rbt-octahedral.toml");
    let (_, two) = run("designs/rbt-griffis-duffy.toml");
    assert!(one.0 > 0.0 && one.0 < one.1 && two.0 < two.1);
    // a proof for one holds for the other
    assert!(one.0 < two.1 && two.0 < one.1, "{one:?} {two:?}");
    let modes = octahedral["assembly_modes"].as_array().unwrap();
    assert!(!modes.is_empty());
    for mode in modes {
        let d = mode["determinant"].as_f64().unwrap();
        for p in mode["four_planes"].as_array().unwrap() {
            assert!((p.as_f64().unwrap().abs() - d.abs()).abs() < 1e-9 * d.abs().max(1e-3));
        }
    }
    assert!(std::fs::read_to_string(svg).unwrap().contains("<svg"));
}

#[test]
#[ignore = "evidence"]
fn assembly_modes_of_one_sign_are_joined_and_equivalent_platforms_agree() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (csv, svg) = (file("p.csv"), file("p.svg"));
    let pose = "0,0,9,0,0,25";
    let base = ["--pose", pose, "--cells", "1", "--box", "0.1,0.1,0.1,1,1,1", "--json"];
    let run = |design: &str, more: &[&str]| {
        let out = equipod(&[&["singular", "poses", design][..], &base, more].concat());
        document(&out)
    };
    let one = run("designs/rbt-octahedral.toml", &["--between", "--samples", "300"]);
    let signs: Vec<i64> =
        one["between"]["signs"].as_array().unwrap().iter().map(|s| s.as_i64().unwrap()).collect();
    let modes = one["assembly_modes"].as_array().unwrap();
    assert_eq!(signs.len(), modes.len());
    for (sign, mode) in signs.iter().zip(modes) {
        assert!(*sign as f64 * mode["determinant"].as_f64().unwrap() > 0.0);
    }
    let place = |k: &serde_json::Value| k.as_u64().unwrap() as usize - 1;
    for pair in one["between"]["pairs"].as_array().unwrap() {
        let (i, j) = (place(&pair["modes"][0]), place(&pair["modes"][1]));
        if signs[i] != signs[j] {
            assert_eq!((pair["straight"].as_str(), &pair["joined"]), (Some("crosses"), &false.into()));
            assert!(pair["changes"].as_u64().unwrap() % 2 == 1);
        } else if pair["straight"] == "keeps_sign" {
            assert_eq!(pair["joined"], true);
        }
    }
    // an equivalent platform: the same path has the same sign changes
    let (i, j) = (1, modes.len());
    let numbers = format!("{i},{j}");
    let end = |k: usize| {
        let v = |key: &str| {
            modes[k - 1][key].as_array().unwrap().iter().map(ToString::to_string).collect::<Vec<_>>()
        };
        [v("p"), v("q")].concat().join(",")
    };
    let path = run("designs/rbt-octahedral.toml", &["--path", &numbers, "--csv", &csv, "--path-svg", &svg]);
    let through = |design: &str| {
        run(design, &["--path", "0,0", "--via", &end(i), "--via", &end(j)])["path"]["parts"][1].clone()
    };
    let (here, there) = (through("designs/rbt-octahedral.toml"), through("designs/rbt-griffis-duffy.toml"));
    assert_eq!(path["path"]["parts"][0]["changes"], here["changes"]);
    for key in ["outcome", "changes", "doubtful"] {
        assert_eq!(here[key], there[key]);
    }
    assert_eq!(std::fs::read_to_string(csv).unwrap().lines().count(), 102);
    assert!(std::fs::read_to_string(svg).unwrap().contains("</svg>"));
    let bad = run("designs/rbt-octahedral.toml", &["--path", "1,99"]);
    assert_eq!(bad["error"]["code"], "poses::bad_path");
}

#[test]
fn the_forty_modes_of_dietmaiers_platform_are_two_groups_of_twenty() {
    let text = std::fs::read_to_string("designs/dietmaier.toml").unwrap();
    let line = text.lines().find(|l| l.starts_with("lengths = [")).unwrap();
    let lengths = line.trim_start_matches("lengths = [").trim_end_matches(']').replace(' ', "");
    let more = ["--cells", "1", "--box", "0.1,0.1,0.1,1,1,1", "--between", "--json"];
    let out = equipod(
        &[&["singular", "poses", "designs/dietmaier.toml", "--lengths", &lengths], &more[..]].concat(),
    );
    let between = &document(&out)["between"];
    let groups: Vec<usize> =
        between["groups"].as_array().unwrap().iter().map(|g| g.as_array().unwrap().len()).collect();
    assert_eq!(groups, [20, 20]);
    // 19 ways reach the others of a group from its first
    assert_eq!(between["paths"].as_array().unwrap().len(), 38);
    let crossing = between["pairs"].as_array().unwrap().iter().filter(|p| p["straight"] == "crosses").count();
    assert!(crossing > 600 && crossing < 780, "{crossing}");
}

/// Version 0.1.0 proved a box of Cayley parameters up to t = 1.0002 and called it the workspace. This pose of the
/// workspace, at t = 0.9995, has the other sign of det J.
#[test]
fn the_proved_box_is_one_of_rotation_vectors() {
    let design = "tests/fixtures/adversarial/REP_box.toml";
    let doc = document(&equipod(&["singular", "poses", design, "--cells", "3000", "--json"]));
    let largest = (47.0066_f64).max(47.6845).max(45.4840) / 47.71;
    let (proved, refuted) = (&doc["box"]["proved_scale"], &doc["box"]["singular_within"]["scale"]);
    assert!(
        proved.as_f64().unwrap() < refuted.as_f64().unwrap() && refuted.as_f64().unwrap() <= largest,
        "{doc}"
    );
    assert!(proved.as_f64().unwrap() > 0.5);
}

/// Equivalent platforms have one cubic; a singular one has zero; the axis of symmetry gives quarter turns.
#[test]
fn the_locus_is_one_polynomial_for_equivalent_platforms() {
    let locus = |design: &str, more: &[&str]| {
        let words = [&["singular", "locus", design, "--json"], more].concat();
        let out = equipod(&words);
        (out.status.code(), document(&out)["polynomial"].clone())
    };
    let pose = ["--pose", "0,0,1,1,1/2,1/3,0"];
    let (code, cubic) = locus("designs/rbt-octahedral.toml", &pose);
    assert_eq!((code, cubic["degree"].as_u64()), (Some(0), Some(3)));
    assert_eq!((code, cubic), locus("designs/rbt-griffis-duffy.toml", &pose));
    assert_eq!(locus("designs/rbt-midline.toml", &pose).0, Some(1));
    let above = ["--pose", "0,0,15,0,0,0", "--about", "0,0,1"];
    let (_, turned) = locus("designs/rbt-griffis-duffy.toml", &above);
    assert_eq!(turned["coefficients"], serde_json::json!(["-1", "0", "1"]));
    assert_eq!(turned["removed"], serde_json::json!([{ "factor": "1 + u^2", "degree": 2, "times": 5 }]));
    assert_eq!(turned["real_roots"], serde_json::json!([[-1.0, -1.0], [1.0, 1.0]]));
    let (_, general) = locus("designs/dietmaier.toml", &["--about", "1,2,3"]);
    assert_eq!((general["degree_before"].as_u64(), general["degree"].as_u64()), (Some(12), Some(6)));
    let found = general["real_roots"].as_array().unwrap().len();
    assert_eq!(general["real_roots_by_sturm"].as_u64(), Some(found as u64));
}
