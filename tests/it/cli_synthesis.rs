//! The processes `equipod equivalents map` and `equipod equivalents family`.

use std::process::{Command, Output};

use serde_json::Value;

fn equipod(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_equipod"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(args)
        .output()
        .unwrap()
}

fn json(args: &[&str]) -> (Option<i32>, Value) {
    let out = equipod(&[args, &["--json"]].concat());
    (out.status.code(), serde_json::from_slice(&out.stdout).unwrap())
}

const OCTAHEDRAL: &str = "designs/rbt-octahedral.toml";

#[test]
fn map_tells_equivalent_singular_and_unrelated_apart() {
    let (code, doc) = json(&["equivalents", "map", OCTAHEDRAL, "designs/rbt-griffis-duffy.toml"]);
    assert_eq!((code, doc["relation"].as_str()), (Some(0), Some("equivalent")));
    assert!((doc["det"].as_f64().unwrap() - 0.26208).abs() < 1e-12);
    assert!((doc["A"][5][0].as_f64().unwrap() - 0.2).abs() < 1e-12);
    assert!((doc["c"][0].as_f64().unwrap() + 23.04).abs() < 1e-11);
    assert!(doc["residual"].as_f64().unwrap() < 1e-14);
    let (code, doc) = json(&["equivalents", "map", OCTAHEDRAL, "designs/rbt-midline.toml"]);
    assert_eq!((code, doc["relation"].as_str()), (Some(1), Some("singular")));
    let (code, doc) = json(&["equivalents", "map", "designs/rbt-midline.toml", OCTAHEDRAL]);
    assert_eq!((code, doc["relation"].as_str()), (Some(1), Some("singular")));
    assert_eq!((doc["leg_rank"].as_u64(), doc["level"].as_str()), (Some(5), Some("exact_joints")));
}

#[test]
fn the_published_designs_carry_lengths_of_one_pose() {
    // s(TO) = A s(FROM) + c holds between the lengths written in the two files
    let read = |path: &str| -> Vec<f64> {
        let text = std::fs::read_to_string(path).unwrap();
        let line = text.lines().find_map(|l| l.strip_prefix("lengths = [")).unwrap().trim_end_matches(']');
        line.split(", ").map(|x| x.parse().unwrap()).collect()
    };
    for to in ["designs/rbt-griffis-duffy.toml", "designs/rbt-midline.toml"] {
        let (_, doc) = json(&["equivalents", "map", OCTAHEDRAL, to]);
        let (l, m) = (read(OCTAHEDRAL), read(to));
        for i in 0..6 {
            let a = |j: usize| doc["A"][i][j].as_f64().unwrap();
            let s: f64 = (0..6).map(|j| a(j) * l[j] * l[j]).sum::<f64>() + doc["c"][i].as_f64().unwrap();
            assert!((s.sqrt() - m[i]).abs() < 1e-12 * m[i], "{to} leg {}", i + 1);
        }
    }
}

#[test]
fn offsets_as_fractions_and_roots_stay_exact() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("moved.toml");
    let file = path.to_str().unwrap();
    let family = |offsets: &str, more: &[&str]| {
        let words = ["equivalents", "family", OCTAHEDRAL, "--pattern", "S123456", offsets];
        json(&[&words, more].concat())
    };
    let (code, doc) = family("--offsets=1/3,1/5,2-sqrt(3),1/7,0.25,3/7", &["-o", file]);
    assert_eq!((code, &doc["instance"]["offsets"][0]), (Some(0), &(1.0 / 3.0).into()));
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.contains("t = \"1/3\"") && text.contains("t = \"2-sqrt(3)\"") && text.contains("t = 0.25"));
    let (_, map) = json(&["equivalents", "map", OCTAHEDRAL, file]);
    assert_eq!(
        (&map["level"], &map["det_exact"]),
        (&"exact_joints".into(), &"-97/490 + 193*sqrt(3)/980".into())
    );
    for bad in ["1/0", "1/x", "nan", ""] {
        let (code, doc) = family(&format!("--offsets={bad},0.1,0.1,0.1,0.1,0.1"), &[]);
        assert_eq!((code, doc["error"]["code"].as_str()), (Some(2), Some("usage")), "{bad}");
    }
    // the same for a leg that moves along a family
    let path = folder.path().join("leg.toml");
    let file = path.to_str().unwrap();
    let (code, _) = json(&["equivalents", "move", OCTAHEDRAL, "--move", "1:P1-P2:P4:1/3", "-o", file]);
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(code == Some(0) && text.contains("t = \"1/3\""), "{text}");
}

/// The lengths of the paper's platform without shared joints (Rojas, Borras, Thomas, sec. 6).
#[test]
fn lengths_of_one_design_are_taken_to_those_of_the_other() {
    let published = [
        18.851843411189265,
        17.839282496782207,
        17.145261736118233,
        16.426868234694037,
        14.762655587664439,
        18.05879287217172,
    ];
    let map = |to: &str, lengths: &str| json(&["equivalents", "map", OCTAHEDRAL, to, "--lengths", lengths]).1;
    let doc = map("designs/rbt-griffis-duffy.toml", "19.8,18,18,17,14.9,17.8");
    for (i, length) in published.iter().enumerate() {
        assert!((doc["lengths"]["to"][i].as_f64().unwrap() - length).abs() < 1e-12);
    }
    let none = map("designs/rbt-midline.toml", "19.8,18,18,17,14.9,17.8");
    assert_eq!(
        (&none["lengths"]["to"], none["lengths"]["reason"].as_str()),
        (&serde_json::Value::Null, Some("the designs have no regular map"))
    );
    // too short for the offsets: a squared length would be negative
    let none = map("designs/rbt-griffis-duffy.toml", "1,1,1,1,1,1");
    assert!(none["lengths"]["to"].is_null() && none["lengths"]["reason"].is_string());
    assert_eq!(map("designs/rbt-griffis-duffy.toml", "1,2")["error"]["code"], "map::bad_lengths");
}

#[test]
fn different_units_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("metres.toml");
    let text = std::fs::read_to_string(OCTAHEDRAL).unwrap().replace("\"mm\"", "\"m\"");
    std::fs::write(&path, text).unwrap();
    let (code, doc) = json(&["equivalents", "map", OCTAHEDRAL, path.to_str().unwrap()]);
    assert_eq!((code, doc["error"]["code"].as_str()), (Some(2), Some("map::different_units")));
}

#[test]
fn family_lists_every_pattern_with_its_counts() {
    let (code, doc) = json(&["equivalents", "family", OCTAHEDRAL]);
    assert_eq!(code, Some(0));
    let count = |key: &str| doc["counts"][key].as_u64().unwrap();
    assert_eq!(doc["patterns"].as_array().unwrap().len() as u64, count("patterns"));
    assert_eq!(doc["topologies"].as_array().unwrap().len() as u64, count("topologies"));
    for (key, topology) in
        [("class", "classes"), ("class_exchange", "classes_exchange"), ("topology", "topologies")]
    {
        let most = doc["patterns"].as_array().unwrap().iter().map(|p| p[key].as_u64().unwrap()).max();
        assert_eq!(most, Some(count(topology)));
    }
    let free = doc["patterns"].as_array().unwrap().iter().find(|p| p["id"] == "S123456").unwrap();
    assert_eq!(free["shared_joints"], serde_json::json!([]));
    assert_eq!(free["A"][5], serde_json::json!(["t6", "0", "0", "0", "0", "1 - t6"]));
    assert_eq!(
        (free["sequential"].as_bool(), free["alignments"].as_array().unwrap().len()),
        (Some(false), 6)
    );
}

#[test]
fn a_pattern_is_written_as_a_design_that_maps_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("moved.toml");
    let file = path.to_str().unwrap();
    let offsets = "--offsets=0.25,-0.1,0.4";
    let (code, doc) =
        json(&["equivalents", "family", OCTAHEDRAL, "--pattern", "V456S112", offsets, "-o", file]);
    assert_eq!(code, Some(0), "{doc}");
    let (code, map) = json(&["equivalents", "map", OCTAHEDRAL, file]);
    assert_eq!(code, Some(0));
    let (x, y) = (map["det"].as_f64().unwrap(), doc["instance"]["det"].as_f64().unwrap());
    assert!((x - y).abs() < 1e-12, "{x} {y}");
    for (args, error) in [
        (["--pattern", "V346S112", "--offsets", "0.1,0.2,0.3"], "family::bad_pattern"),
        (["--pattern", "V456S112", "--offsets", "0.1,0.2"], "family::bad_offsets"),
    ] {
        let (code, doc) = json(&[&["equivalents", "family", OCTAHEDRAL], args.as_slice()].concat());
        assert_eq!((code, doc["error"]["code"].as_str()), (Some(2), Some(error)));
    }
}

/// The paper's example (Rojas, Borras, Thomas, sec. 6): offsets of 12/5 on the base and 6/5 on the platform.
#[test]
fn the_derivation_is_exact_and_ends_with_forward_kinematics() {
    let explain = |pattern: &str, offsets: &str| {
        let words = ["equivalents", "family", OCTAHEDRAL, "--pattern", pattern, offsets, "--explain"];
        let (code, doc) = json(&words);
        (code, doc["derivation"].clone())
    };
    let (code, d) = explain("S123456", "--offsets=0.2,0.2,0.2,0.2,0.2,0.2");
    assert_eq!((code, &d["exact"], &d["sequence"]), (Some(0), &true.into(), &serde_json::Value::Null));
    let of = |step: &serde_json::Value, key: &str| step[key]["exact"].as_str().unwrap().to_owned();
    let first = &d["moves"][0];
    let numbers = ["offset", "rest", "square", "constant"].map(|key| of(first, key));
    assert_eq!(numbers, ["1/5", "4/5", "144", "-576/25"]);
    assert_eq!(of(&d["products"], "rest"), "4096/15625");
    assert_eq!(of(&d["factors"][0], "value"), "819/3125");
    assert_eq!(
        (&d["verification"]["verdict"], &d["verification"]["proved"]),
        (&"equivalent".into(), &true.into())
    );
    // two legs on one side, one after the other: 3/4 * 7/15 = 7/20
    let (code, d) = explain("V3456S11", "--offsets=0.25,0.6");
    let steps: Vec<String> = d["sequence"].as_array().unwrap().iter().map(|s| of(s, "rest")).collect();
    assert_eq!((code, steps), (Some(0), vec!["3/4".to_owned(), "7/15".to_owned()]));
    assert_eq!(
        (of(&d["factors"][0], "value").as_str(), &d["factors"][0]["zero"]),
        ("7/20", &"u1 = t1".into())
    );
    // all midpoints: the determinant is zero, and verification says singular
    let (code, d) = explain("S123456", "--offsets=0.5,0.5,0.5,0.5,0.5,0.5");
    assert_eq!((code, of(&d["factors"][0], "value").as_str()), (Some(1), "0"));
    assert_eq!(d["verification"]["verdict"], "singular");
    // leg 1 first would lie on leg 2
    let (code, d) = explain("V3456S11", "--offsets=1,0.5");
    assert_eq!(
        (code, &d["sequence"][0]["leg"], of(&d["sequence"][1], "rest").as_str()),
        (Some(0), &2.into(), "-1")
    );
}

#[test]
fn a_design_made_from_an_octahedral_platform_has_its_class() {
    let made = "designs/rbt-griffis-duffy.toml";
    let (code, doc) = json(&["equivalents", "family", made]);
    assert_eq!((code, doc["counts"]["patterns"].as_u64()), (Some(0), Some(728)));
    // its own offsets give itself back
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("same.toml");
    let offsets = ["--pattern", "S123456", "--offsets=0.2,0.2,0.2,0.2,0.2,0.2", "-o", path.to_str().unwrap()];
    let (code, _) = json(&[&["equivalents", "family", made][..], &offsets].concat());
    assert_eq!(code, Some(0));
    let (code, map) = json(&["equivalents", "map", made, path.to_str().unwrap()]);
    let det = map["det"].as_f64().unwrap();
    assert!(code == Some(0) && (det - 1.0).abs() < 1e-9, "{det}");
    // one that is singular is equivalent to no octahedral platform
    let (code, doc) = json(&["equivalents", "family", "designs/rbt-midline.toml"]);
    assert_eq!((code, doc["error"]["code"].as_str()), (Some(1), Some("family::singular")));
}

#[test]
fn the_nearest_octahedral_platform_is_written_with_its_error() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let (octahedral, beside) = (path("octahedral.toml"), path("beside.toml"));
    let design = "designs/symmetric-hexapod.toml";
    let (code, doc) = json(&["equivalents", "nearest", design, "-o", &octahedral, "--beside", &beside]);
    let near = &doc["nearest"];
    let number = |key: &str| near[key].as_f64().unwrap();
    assert_eq!((code, near["converged"].as_bool()), (Some(0), Some(true)));
    // joining the joints of each pair half-way moves them by half of their distance, 62.4 and 41.6 mm
    let joined = (0.5 * (62.374_f64.powi(2) + 41.6_f64.powi(2))).sqrt();
    assert!(number("rms_displacement") < joined, "{}", number("rms_displacement"));
    assert!(number("largest_length_deviation") <= 2.0 * number("largest_displacement"));
    // every command for octahedral designs takes the one, which is exactly equivalent to the other
    let (code, map) = json(&["equivalents", "map", &octahedral, &beside]);
    assert_eq!((code, map["relation"].as_str()), (Some(0), Some("equivalent")));
    assert!(map["det_exact"].is_string(), "its joints are constructed");
    assert!((map["det"].as_f64().unwrap() - number("det")).abs() < 1e-9);
    assert_eq!(json(&["equivalents", "family", &octahedral]).0, Some(0));
    // a design that is octahedral is its own nearest
    let (_, own) = json(&["equivalents", "nearest", OCTAHEDRAL]);
    assert!(own["nearest"]["largest_displacement"].as_f64().unwrap() < 1e-9);
    // no way is regular enough
    let text = std::fs::read_to_string("designs/general-6-6.toml").unwrap();
    std::fs::write(path("never.toml"), format!("{text}\n[optimize]\nmin_abs_det = 1e9\n")).unwrap();
    let (code, doc) = json(&["equivalents", "nearest", &path("never.toml")]);
    assert_eq!((code, &doc["nearest"]), (Some(3), &serde_json::Value::Null));
}

#[test]
fn other_designs_are_refused_with_the_reason() {
    let (code, doc) = json(&["equivalents", "family", "designs/general-6-6.toml"]);
    assert_eq!((code, doc["error"]["code"].as_str()), (Some(2), Some("family::not_octahedral")));
    assert!(doc["error"]["message"].as_str().unwrap().contains("6 joints in use"));
}

#[test]
fn graph_and_drawing_hold_every_topology() {
    let folder = tempfile::tempdir().unwrap();
    let (dot, svg) = (folder.path().join("a.dot"), folder.path().join("a.svg"));
    let out = equipod(&[
        "equivalents",
        "family",
        OCTAHEDRAL,
        "--dot",
        dot.to_str().unwrap(),
        "--svg",
        svg.to_str().unwrap(),
    ]);
    assert_eq!(out.status.code(), Some(0));
    let dot = std::fs::read_to_string(dot).unwrap();
    assert_eq!((dot.matches("[label=\"").count(), dot.matches("style=dashed").count()), (20, 1));
    let svg = std::fs::read_to_string(svg).unwrap();
    assert_eq!((svg.matches("class=\"card\"").count(), svg.matches("class=\"leg\"").count()), (20, 120));
    assert!(svg.ends_with("</svg>\n") && !svg.contains("NaN"));
}
