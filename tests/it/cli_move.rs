//! The process `equipod equivalents move`.

use serde_json::Value;

use super::cli_frame::{document, equipod};

fn of(design: &str, more: &[&str], code: i32) -> Value {
    let path = format!("designs/{design}.toml");
    let mut args = vec!["equivalents", "move", path.as_str(), "--json"];
    args.extend(more);
    let out = equipod(&args);
    assert_eq!(out.status.code(), Some(code), "{more:?}: {}", String::from_utf8_lossy(&out.stderr));
    document(&out)
}

fn number(v: &Value) -> f64 {
    v.as_f64().unwrap()
}

/// The six sides of the hexagon of the published design, in cyclic order of its legs, at `t`.
fn six(t: f64) -> Vec<String> {
    let sides = ["P1-P2:P4", "P2:P4-P5", "P2-P3:P5", "P3:P5-P6", "P3-P1:P6", "P1:P6-P4"];
    (0..6).map(|k| format!("{}:{}:{t}", k + 1, sides[k])).collect()
}

fn with_moves<'a>(list: &'a [String], more: &[&'a str]) -> Vec<&'a str> {
    list.iter().flat_map(|m| ["--move", m.as_str()]).chain(more.iter().copied()).collect()
}

#[test]
fn one_leg_by_number_or_by_the_joints_of_its_family_and_verify_agrees() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("moved.toml");
    let to = path.to_str().unwrap();
    let doc = of("rbt-octahedral", &["--leg", "1", "--along", "P1-P2:P4", "--to", "0.2", "-o", to], 0);
    assert_eq!((doc["outcome"].as_str(), doc["output"].as_str()), (Some("equivalent"), Some(to)));
    assert!((number(&doc["det"]) - 0.8).abs() < 1e-12);
    let made = &doc["steps"][0]["moves"][0];
    assert_eq!(
        (made["leg"].as_u64(), made["type"].as_str(), made["along"].as_str()),
        (Some(1), Some("point-line"), Some("P1-P2:P4"))
    );
    assert!((number(&made["coefficient"]) - 0.8).abs() < 1e-12 && number(&made["residual"]) < 1e-14);
    assert!((number(&made["singular_parameters"][0]) - 1.0).abs() < 1e-9);
    let same =
        of("rbt-octahedral", &["--leg", "1", "--along", &made["component"].to_string(), "--to", "0.2"], 0);
    assert_eq!(same["design"]["base"], doc["design"]["base"]);
    // the joint that came apart has a letter, the other leg keeps the old one; lengths are those of the same pose
    let names: Vec<&String> = doc["design"]["base"].as_object().unwrap().keys().collect();
    assert_eq!(names, ["P1", "P2", "P3", "P1a"]);
    assert_eq!(doc["design"]["legs"][0], serde_json::json!(["P1a", "P4"]));
    let map = equipod(&["equivalents", "map", "designs/rbt-octahedral.toml", to, "--json"]);
    assert_eq!(document(&map)["A"], doc["A"]);
    let verify = equipod(&["verify", "designs/rbt-octahedral.toml", to, "--samples", "1", "--json"]);
    assert_eq!(document(&verify)["verdict"], "equivalent");
}

#[test]
fn together_and_one_after_another_come_to_the_platform_of_the_paper() {
    let list = six(0.2);
    let at_once = of("rbt-octahedral", &with_moves(&list, &["--together"]), 0);
    let in_turn = of("rbt-octahedral", &with_moves(&list, &[]), 0);
    for doc in [&at_once, &in_turn] {
        assert!((number(&doc["det"]) - 0.26208).abs() < 1e-12);
        assert!(number(&doc["composition_difference"]) < 1e-12);
        let l = doc["design"]["lengths"].as_array().unwrap();
        let published = [
            18.851843411189265,
            17.839282496782207,
            17.145261736118233,
            16.426868234694037,
            14.762655587664439,
            18.05879287217172,
        ];
        assert!(l.iter().zip(published).all(|(x, y)| (number(x) - y).abs() < 1e-9), "{l:?}");
    }
    assert_eq!(
        (at_once["steps"].as_array().unwrap().len(), in_turn["steps"].as_array().unwrap().len()),
        (1, 6)
    );
    // every joint is alone in the end
    for body in ["base", "platform"] {
        assert_eq!(in_turn["design"][body].as_object().unwrap().len(), 6);
    }
}

#[test]
fn all_midpoints_are_singular_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("singular.toml");
    let list = six(0.5);
    let doc = of("rbt-octahedral", &with_moves(&list, &["--together", "-o", path.to_str().unwrap()]), 1);
    assert_eq!((doc["outcome"].as_str(), doc["relation"].as_str()), (Some("singular"), Some("singular")));
    assert!(doc["output"].is_null() && !path.exists());
    for made in doc["steps"][0]["moves"].as_array().unwrap() {
        assert!((number(&made["singular_parameters"][0]) - 0.5).abs() < 1e-9);
    }
    // in turn the sixth is the singular one; later moves are not made
    let mut list = six(0.5);
    list.push("1:P1-P2:P4:0.1".into());
    let doc = of("rbt-octahedral", &with_moves(&list, &[]), 1);
    assert_eq!((doc["steps"].as_array().unwrap().len(), doc["moves_left_out"].as_u64()), (6, Some(1)));
    assert_eq!(doc["steps"][4]["outcome"], "equivalent");
}

#[test]
fn what_is_refused() {
    let code = |more: &[&str]| of("rbt-octahedral", more, 2)["error"]["code"].as_str().unwrap().to_string();
    assert_eq!(code(&[]), "move::nothing_asked");
    assert_eq!(code(&["--leg", "4", "--along", "P1-P2:P4", "--to", "0.2"]), "move::not_carried");
    assert_eq!(code(&["--leg", "7", "--along", "1", "--to", "0.2"]), "move::no_such_leg");
    assert_eq!(code(&["--leg", "1", "--along", "9", "--to", "0.2"]), "move::no_such_family");
    assert_eq!(code(&["--leg", "1", "--along", "P1:P4-P5", "--to", "0.2"]), "move::no_such_family");
    assert_eq!(code(&["--leg", "1", "--along", "P1:P9", "--to", "0.2"]), "move::no_such_family");
    assert_eq!(code(&["--leg", "1", "--along", "4", "--to", "0.2,0.3"]), "move::parameter_count");
    assert_eq!(code(&["--move", "1:4"]), "move::bad_move");
    assert_eq!(code(&["--move", "1:4:0.2", "--move", "1:1:0.2", "--together"]), "move::leg_twice");
    assert_eq!(code(&["--no-shared-joints"]), "move::target_without_search");
    assert_eq!(code(&["--search"]), "move::no_target");
    assert_eq!(code(&["--search", "--hole", "P1:1,2,3"]), "move::bad_hole");
    assert_eq!(code(&["--search", "--joint", "P9=1,2,3"]), "move::no_such_joint");
    assert_eq!(code(&["--search", "--spacing=-1"]), "move::bad_target");
    // nothing can be moved
    let doc = of("general-6-6", &["--leg", "1", "--along", "1", "--to", "0.2"], 2);
    assert!(doc["error"]["help"].as_str().unwrap().contains("no leg of this platform"));
}

#[test]
fn the_search_finds_proves_and_leaves_open() {
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().join("found");
    let more =
        ["--search", "--no-shared-joints", "--no-crossing", "--count", "2", "-o", to.to_str().unwrap()];
    let doc = of("rbt-octahedral", &more, 0);
    assert_eq!(
        (doc["outcome"].as_str(), doc["patterns"].as_u64(), doc["least_shared_joints"].as_u64()),
        (Some("found"), Some(728), Some(0))
    );
    let first = &doc["designs"][0];
    assert_eq!(
        (first["fulfilled"].as_bool(), first["shared_joints"].as_u64(), first["relation"].as_str()),
        (Some(true), Some(0), Some("equivalent"))
    );
    assert!(first["margins"].as_array().unwrap().iter().all(|m| number(&m["slack"]) >= 0.0));
    let file = doc["paths"][0].as_str().unwrap();
    let map = equipod(&["equivalents", "map", "designs/rbt-octahedral.toml", file, "--json"]);
    assert_eq!(document(&map)["relation"], "equivalent");
    // a joint 3 along the first edge, by name
    let doc = of("rbt-octahedral", &["--search", "--joint", "P1=1.5,2.598076211353316,0", "--count", "1"], 0);
    let legs = doc["designs"][0]["design"]["legs"].as_array().unwrap().clone();
    let base = &doc["designs"][0]["design"]["base"];
    let at_hole =
        |l: &Value| base[l[0].as_str().unwrap()] == serde_json::json!([1.5, 2.598076211353316, 0.0]);
    assert!(legs.iter().any(at_hole));
    // no leg there, proved; shared joints, proved
    let doc = of("rbt-octahedral", &["--search", "--hole", "base:3,3,0"], 1);
    assert_eq!(
        (doc["reason"].as_str(), doc["holes"][0]["exact_rank_defect"].as_u64()),
        (Some("no_leg_at_hole"), Some(0))
    );
    let doc = of("innocenti-6-4", &["--search", "--no-shared-joints"], 1);
    assert_eq!(
        (doc["reason"].as_str(), doc["least_shared_joints"].as_u64()),
        (Some("shared_joints"), Some(2))
    );
}

#[test]
#[ignore = "evidence"]
fn a_search_for_more_room_than_there_is_is_left_open() {
    let doc = of("rbt-octahedral", &["--search", "--spacing", "1000"], 3);
    assert_eq!(
        (doc["outcome"].as_str(), doc["designs"][0]["fulfilled"].as_bool()),
        (Some("undecided"), Some(false))
    );
}

/// Targets are not all: a platform that meets them and is too long for the file is not called fulfilled.
#[test]
fn a_platform_that_misses_a_requirement_is_not_called_fulfilled() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string("designs/rbt-octahedral.toml").unwrap();
    let search = |greatest: f64| {
        let path = folder.path().join("limited.toml");
        std::fs::write(&path, format!("{text}\n[hardware]\nleg_length = [1.0, {greatest}]\n")).unwrap();
        let out = equipod(&[
            "equivalents",
            "move",
            path.to_str().unwrap(),
            "--search",
            "--no-shared-joints",
            "--count",
            "2",
            "--json",
        ]);
        (out.status.code(), document(&out))
    };
    let (code, doc) = search(1000.0);
    assert_eq!((code, doc["outcome"].as_str()), (Some(0), Some("found")), "{doc}");
    let first = &doc["designs"][0];
    assert_eq!((&first["fulfilled"], &first["assessment"]["met"]), (&true.into(), &true.into()));
    // no platform of this size has legs so short
    let (code, doc) = search(10.0);
    assert_eq!((code, doc["outcome"].as_str()), (Some(1), Some("violated")), "{doc}");
    for found in doc["designs"].as_array().unwrap() {
        assert_eq!((&found["fulfilled"], &found["targets_met"]), (&false.into(), &true.into()));
        let rows = found["assessment"]["requirements"].as_array().unwrap();
        let long = rows.iter().find(|m| m["name"] == "max_leg_length").unwrap();
        assert_eq!((&long["met"], long["legs"].as_array().unwrap().len()), (&false.into(), 1));
        assert!(found["design"]["description"].as_str().unwrap().contains("requirements violated"));
    }
    assert!(doc["explanation"].as_str().unwrap().contains("violates requirements"));
}

#[test]
fn the_last_leg_of_a_fixed_joint_is_not_moved() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fixed.toml");
    let text = std::fs::read_to_string("designs/rbt-octahedral.toml").unwrap();
    let fixed = text.replacen("[optimize]\n", "[optimize]\nfixed = [\"base\"]\n", 1);
    assert!(fixed != text, "the design has the table");
    std::fs::write(&path, fixed).unwrap();
    let path = path.to_str().unwrap();
    let asked = |args: &[&str]| {
        let out = equipod(&[&["equivalents", "move", path, "--json"], args].concat());
        (out.status.code(), document(&out)["error"]["code"].as_str().map(str::to_owned))
    };
    // one of the two legs at P1 leaves it, then the other one
    let (first, second) = ("1:P1-P2:P4:0.3", "6:P1-P3:P6:0.3");
    assert_eq!(asked(&["--move", first]), (Some(0), None));
    assert_eq!(asked(&["--move", first, "--move", second]), (Some(2), Some("move::fixed".into())));
    assert_eq!(asked(&["--search"]), (Some(2), Some("move::fixed".into())));
}

/// Joints on lines of joints that the search has moved, too, are exact: the leg map is an identity.
#[test]
fn a_platform_of_the_search_follows_exactly_though_ends_of_its_lines_have_moved() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (start, found) = (file("3-3b.toml"), file("found"));
    let text = r#"name = "3-3b"
units = "mm"
legs = [["A1", "B1"], ["A1", "B2"], ["A1", "B3"], ["A2", "B1"], ["A2", "B2"], ["A3", "B3"]]
[base]
A1 = [0, 0, 0]
A2 = [12, 0, 0]
A3 = [3, 9, 0]
[platform]
B1 = [0, 0, 0]
B2 = [6, 0, 0]
B3 = [2, 5, 0]
"#;
    std::fs::write(&start, text).unwrap();
    let options = ["--search", "--no-shared-joints", "--count", "2", "-o", &found];
    super::cli_frame::asked(&[&["equivalents", "move", start.as_str()], options.as_slice()].concat());
    for k in [1, 2] {
        let other = format!("{found}/{k}.toml");
        let map = super::cli_frame::asked(&["equivalents", "map", &start, &other]).1;
        assert!(map["A_exact"].is_array(), "{map}");
    }
}

#[test]
fn parameters_holes_and_lengths_may_be_expressions() {
    let design = "designs/rbt-octahedral.toml";
    let moved = of("rbt-octahedral", &["--move", "1:P1-P2:P4:1/5"], 0);
    assert_eq!(moved["steps"][0]["moves"][0]["parameters_written"], serde_json::json!(["1/5"]));
    let lengths =
        |text: &str| super::cli_frame::asked(&["fk", design, "--lengths", text]).1["solutions"].clone();
    let decimals = lengths("19.8,18,18,17,14.9,17.8");
    assert!(decimals.as_array().is_some_and(|list| list.len() == 16));
    assert_eq!(lengths("99/5,18,36/2,17,149/10,89/5"), decimals);
}

#[test]
fn lengths_on_the_command_line_are_converted_exactly_to_the_unit_of_the_design() {
    let design = "designs/rbt-octahedral.toml";
    let asked = |words: &[&str]| super::cli_frame::asked(words);
    let lengths = |design: &str, text: &str| asked(&["fk", design, "--lengths", text]);
    let own = lengths(design, "19.8,18,18,17,14.9,17.8").1["solutions"].clone();
    let mixed = lengths(design, "99/5 mm,1.8 cm,18,17/1000 m,745/1270 in,8 mm + 0.98 cm");
    assert_eq!(mixed.1["solutions"], own);
    // an edge of the base is 12 long, one of the platform 6
    let family = |design: &str, offsets: &str| {
        let words =
            ["equivalents", "family", design, "--pattern", "S123456", "--offsets", offsets, "--explain"];
        asked(&words)
    };
    let (code, shares) = family(design, "1/5,1/5,1/5,1/5,1/5,1/5");
    assert_eq!(code, Some(0));
    let (code, ways) = family(design, "12/5 mm,6/5mm,6/25 cm,6/5 mm,12/5 mm,6/127 in");
    assert_eq!((code, &ways["derivation"]), (Some(0), &shares["derivation"]));
    // a label that names no length has no conversion
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("plain.toml");
    let text = std::fs::read_to_string(design).unwrap().replace("units = \"mm\"", "units = \"edges\"");
    std::fs::write(&path, text).unwrap();
    let plain = path.to_str().unwrap();
    for (code, answer) in
        [lengths(plain, "19.8 mm,18,18,17,14.9,17.8"), family(plain, "12/5 mm,0.2,0.2,0.2,0.2,0.2")]
    {
        let message = answer["error"]["message"].as_str().unwrap();
        assert_eq!(code, Some(2));
        assert!(message.contains("no known length"), "{message}");
    }
    let out = ["build", "round", plain, "--grid", "1/2 in"];
    let (code, answer) = asked(&out);
    assert_eq!((code, answer["error"]["code"].as_str()), (Some(2), Some("length::unit")));
}

/// Two triangles with square roots, joined as in the topologies with three joints on each body.
fn triangles(base: [usize; 6], platform: [usize; 6]) -> String {
    let legs: Vec<String> =
        base.iter().zip(platform).map(|(a, b)| format!("[\"A{}\", \"B{}\"]", a + 1, b + 1)).collect();
    format!(
        "name = \"triangles\"\nunits = \"mm\"\nlegs = [{}]\n[base]\nA1 = [0, 0, 0]\nA2 = [12, 0, 0]\nA3 = [6, \"6*sqrt(3)\", 1]\n[platform]\nB1 = [0, 0, 0]\nB2 = [6, 0, 0]\nB3 = [2, \"3*sqrt(3)\", 0.5]\n[home]\nposition = [3, 1.5, 11]\nrpy_deg = [3, 5, 40]\n",
        legs.join(", ")
    )
}

/// T32, T33 and T34: moved joints stay on lines and planes of the others exactly, so that equivalence is proved about
/// exact joints.
#[test]
fn platforms_of_every_3_3_topology_that_are_found_are_exact() {
    let topologies = [
        ([0, 0, 0, 1, 1, 2], [0, 1, 2, 0, 1, 0]),
        ([0, 0, 0, 1, 1, 2], [0, 1, 2, 0, 1, 2]),
        ([0, 0, 1, 1, 2, 2], [0, 1, 0, 2, 1, 2]),
    ];
    let folder = tempfile::tempdir().unwrap();
    let mut on_lines = 0;
    for (k, (base, platform)) in topologies.into_iter().enumerate() {
        let given = folder.path().join(format!("{k}.toml"));
        std::fs::write(&given, triangles(base, platform)).unwrap();
        let (given, out) = (given.to_str().unwrap(), folder.path().join(format!("found-{k}")));
        let asked = ["--search", "--no-shared-joints", "--spacing", "12/25 mm", "-o", out.to_str().unwrap()];
        let found = equipod(&[&["equivalents", "move", given, "--json"], &asked[..]].concat());
        assert_eq!(found.status.code(), Some(0), "{}", String::from_utf8_lossy(&found.stderr));
        let found = document(&found);
        let designs = found["designs"].as_array().unwrap();
        assert!(!designs.is_empty());
        for (design, path) in designs.iter().zip(found["paths"].as_array().unwrap()) {
            let text = std::fs::read_to_string(path.as_str().unwrap()).unwrap();
            on_lines += text.matches("{ on = ").count();
            assert_eq!(design["level"], "exact_joints", "{text}");
        }
    }
    assert!(on_lines >= 12, "{on_lines}");
}

/// Legs that slide on families of T32 and T33 are written at their parameters.
#[test]
fn an_optimised_t32_is_exact() {
    an_optimised_platform_with_families_of_legs_is_exact([0, 0, 0, 1, 1, 2], [0, 1, 2, 0, 1, 0]);
}

#[test]
fn an_optimised_t33_is_exact() {
    an_optimised_platform_with_families_of_legs_is_exact([0, 0, 0, 1, 1, 2], [0, 1, 2, 0, 1, 2]);
}

fn an_optimised_platform_with_families_of_legs_is_exact(base: [usize; 6], platform: [usize; 6]) {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (given, found) = (file("given.toml"), file("found.toml"));
    let search = "[optimize]\nmin_joint_distance = 1\nfixed = [\"A1\", \"A2\", \"B1\", \"B2\"]\n";
    std::fs::write(&given, triangles(base, platform) + search).unwrap();
    let out = super::cli_frame::asked(&["optimize", &given, "-o", &found]);
    assert_eq!(out.1["status"], "best_found", "{}", out.1);
    assert_eq!(out.1["verify"]["verdict"], "equivalent", "{}", out.1["verify"]);
    let map = super::cli_frame::asked(&["equivalents", "map", &given, &found]).1;
    assert_eq!((&map["relation"], &map["level"]), (&"equivalent".into(), &"exact_joints".into()), "{map}");
    let text = std::fs::read_to_string(&found).unwrap();
    assert!(text.contains("{ on = [") || text.contains("sqrt(3)"), "{text}");
}
