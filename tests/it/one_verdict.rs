//! One verdict for each question. All commands that ask whether a design is singular, or two are equivalent, give the
//! same word, with the same level and exit code.

use equipod::methods::manipulator::Level;
use equipod::methods::num::Rng;
use equipod::methods::singularity::{MotionEvidence, PoseVerdict, motion_at};
use equipod::prelude::*;
use serde_json::Value;

use super::cli_frame::{asked, equipod};

fn fixture(name: &str) -> String {
    format!("tests/fixtures/verdicts/{name}.toml")
}

/// The answer of `check` about a design: the exit code, whether it is singular, the level.
fn checked(name: &str) -> (Option<i32>, Value, Value, Value) {
    let (code, mut doc) = asked(&["check", &fixture(name)]);
    (code, doc["architecturally_singular"].take(), doc["level"].take(), doc)
}

/// The common answer of `equivalents map` and `verify` about two designs: exit code, word and level.
fn compared(a: &str, b: &str) -> (Option<i32>, String, Value) {
    let (a, b) = (fixture(a), fixture(b));
    let (code, map) = asked(&["equivalents", "map", &a, &b]);
    let (verify_code, verify) = asked(&["verify", &a, &b, "--samples", "1"]);
    assert_eq!(verify_code, code, "{a} {b}: {map} {verify}");
    assert_eq!((&verify["map"]["relation"], &verify["map"]["level"]), (&map["relation"], &map["level"]));
    let word = map["relation"].as_str().unwrap_or("undecided").to_owned();
    let of_verify = match word.as_str() {
        "unrelated" => "not_equivalent",
        "undecided" => "inconclusive",
        word => word,
    };
    assert_eq!(verify["verdict"], of_verify, "{a} {b}");
    (code, word, map["level"].clone())
}

#[test]
fn exactly_singular_designs_are_singular_in_every_command() {
    for (singular, octahedral) in [
        ("exact-midline-sqrt3", Some("oct-sqrt3")),
        ("gd-exact-singular", Some("gd-oct-exact")),
        ("shares-30-70", None),
        ("cyclic-hexagons", None),
    ] {
        let (code, is_singular, level, doc) = checked(singular);
        assert_eq!((code, is_singular, level), (Some(1), true.into(), "exact_joints".into()), "{singular}");
        assert_eq!((&doc["leg_rank"], &doc["proof"]), (&5.into(), &"leg_vectors".into()), "{singular}");
        assert_eq!(doc["pose_count"]["finite"], 0, "{singular}");
        let expected = (Some(1), "singular".to_owned(), Value::from("exact_joints"));
        assert_eq!(compared(singular, singular), expected);
        if let Some(octahedral) = octahedral {
            assert_eq!(compared(octahedral, singular), expected);
            assert_eq!(compared(singular, octahedral), expected);
            assert_eq!(checked(octahedral).0, Some(0));
            let (code, doc) = asked(&["equivalents", "family", &fixture(singular)]);
            assert_eq!((code, &doc["error"]["code"]), (Some(1), &"family::singular".into()));
        }
        let (_, doc) = asked(&["equivalents", "components", &fixture(singular)]);
        assert_eq!(doc["leg_rank"], 5, "{singular}");
    }
}

#[test]
fn a_design_that_rounds_to_a_singular_one_is_as_regular_as_its_exact_joints() {
    let (it, octahedral) = ("exact-regular-rounds-to-singular", "octahedral-of-it");
    let (code, is_singular, level, doc) = checked(it);
    assert_eq!((code, is_singular, level), (Some(0), false.into(), "exact_joints".into()));
    assert_eq!((&doc["leg_rank"], &doc["griffis_duffy"]["exactly_singular"]), (&6.into(), &false.into()));
    assert_eq!(doc["pose_count"]["finite"], 16);
    let expected = (Some(0), "equivalent".to_owned(), Value::from("exact_joints"));
    assert_eq!(compared(octahedral, it), expected);
    assert_eq!(compared(it, octahedral), expected);
    // forward kinematics has no say about joints that doubles cannot tell apart
    for (a, b) in [(octahedral, it), (it, octahedral)] {
        let (_, doc) = asked(&["verify", &fixture(a), &fixture(b)]);
        let said = doc["explanation"].as_str().unwrap();
        assert!(said.contains("do not determine the poses") && !said.contains("worst"), "{said}");
    }
    let (_, map) = asked(&["equivalents", "map", &fixture(octahedral), &fixture(it)]);
    assert_eq!(map["det_exact"], "-1/16000000000000000000000000000000");
    let (code, _) = asked(&["equivalents", "family", &fixture(it)]);
    assert_eq!(code, Some(0));
}

#[test]
fn a_joint_off_its_edge_is_refuted_by_all_commands_alike() {
    for (off, octahedral) in [("edge-off-1e-9", "octahedral-of-it"), ("free-off", "oct-exact")] {
        let (a, b) = (compared(octahedral, off), compared(off, octahedral));
        assert_eq!((a.0, a.1.as_str()), (Some(1), "unrelated"), "{off}");
        assert_eq!(a, b, "{off}");
        assert!(a.2 == "exact_joints" || a.2 == "doubles_as_written");
        let (code, doc) = asked(&["equivalents", "family", &fixture(off)]);
        assert_eq!((code, &doc["error"]["code"]), (Some(1), &"family::not_equivalent".into()), "{off}");
    }
    // on its edge
    let (code, word, _) = compared("oct-exact", "free-exact");
    assert_eq!((code, word.as_str()), (Some(0), "equivalent"));
}

/// Two legs between the same two points are a platform that can be asked about, whether the points have one name or
/// two.
#[test]
fn coincident_legs_are_singular_under_one_name_and_under_two() {
    let folder = tempfile::tempdir().unwrap();
    let octahedral = std::fs::read_to_string("designs/rbt-octahedral.toml").unwrap();
    let legs = octahedral.lines().find(|l| l.starts_with("legs")).unwrap();
    let one = octahedral.replace(legs, "legs = [[\"P1\",\"P4\"],[\"P1\",\"P4\"],[\"P2\",\"P5\"],[\"P3\",\"P5\"],[\"P3\",\"P6\"],[\"P2\",\"P6\"]]");
    let at = octahedral.lines().find(|l| l.starts_with("P1 = ")).unwrap();
    let two = one
        .replacen("[\"P1\",\"P4\"],[\"P1\"", "[\"P1\",\"P4\"],[\"P0\"", 1)
        .replace(at, &format!("{at}\n{}", at.replace("P1 = ", "P0 = ")));
    for (name, text) in [("one", one), ("two", two)] {
        let path = folder.path().join(format!("{name}.toml"));
        std::fs::write(&path, &text).unwrap();
        let path = path.to_str().unwrap();
        let (code, check) = asked(&["check", path]);
        assert_eq!(
            (code, &check["reason"], &check["leg_rank"]),
            (Some(1), &"coincident_legs".into(), &5.into()),
            "{name}: {check}"
        );
        let codes: Vec<&Value> = check["warnings"].as_array().unwrap().iter().map(|w| &w["code"]).collect();
        assert!(codes.contains(&&"design::coincident_legs".into()), "{name}: {codes:?}");
        let (code, map) = asked(&["equivalents", "map", path, path]);
        assert_eq!((code, &map["relation"]), (Some(1), &"singular".into()), "{name}");
        let (code, fk) = asked(&["fk", path, "--lengths", "18,18,17,16,18,17"]);
        assert!(code == Some(0) || code == Some(3), "{name}: {fk}");
    }
}

/// Singular with square roots in its joints: that it moves is proved about these, and not found by tracing their
/// doubles.
#[test]
fn exact_joints_prove_that_a_singular_platform_moves() {
    for name in ["exact-midline-sqrt3", "gd-exact-singular"] {
        let design = Design::load(fixture(name)).unwrap();
        let found = motion_at(design.manipulator(), &design.home_or_default(), 1);
        let PoseVerdict::Moves { dimension, evidence, .. } = found.verdict else {
            panic!("{name}: {found:?}")
        };
        assert_eq!((dimension, evidence), (1, MotionEvidence::ConstantRank), "{name}");
    }
}

#[test]
fn joints_1e_40_apart_are_four() {
    let (code, is_singular, level, doc) = checked("four-apart");
    assert_eq!((code, is_singular, level), (Some(0), false.into(), "exact_joints".into()));
    assert_eq!((&doc["pose_count"]["finite"], &doc["proof"]), (&40.into(), &"regular_pose".into()));
    let (code, word, _) = compared("four-apart", "four-apart");
    assert_eq!((code, word.as_str()), (Some(0), "equivalent"));
}

#[test]
fn a_singular_design_typed_with_three_decimals_is_headlined_as_one() {
    let path = fixture("griffis-duffy-rounded");
    let out = equipod(&["check", &path]);
    let text = String::from_utf8(out.stdout).unwrap();
    assert_eq!(out.status.code(), Some(3), "{text}");
    let first = text.lines().next().unwrap();
    assert!(first.ends_with("singular to the digits given (0.0005 mm)"), "{first}");
    let (_, is_singular, level, doc) = checked("griffis-duffy-rounded");
    assert_eq!((is_singular, level), (Value::Null, "within_rounding".into()));
    assert_eq!(doc["reason"], "singular_to_digits_given");
    assert_eq!(doc["nearest_singular"]["within_digits"], 0.0005);
    assert_eq!(
        (&doc["singular_within_rounding"], &doc["nearest_singular"]["unit"]),
        (&true.into(), &"mm".into())
    );
    assert!(text.contains("A singular design (planar bodies) is only 5.5e-4 mm away"), "{text}");
    let (_, doc) = asked(&["check", &fixture("edge-off-1e-9")]);
    assert_eq!(doc["singular_within_rounding"], false);
    let (code, word, level) = compared("griffis-duffy-rounded", "griffis-duffy-rounded");
    assert_eq!((code, word.as_str(), level), (Some(3), "undecided", "within_rounding".into()));
    // a joint four hundredths off is no rounding; one hundredth is, spread over all coordinates
    let text = std::fs::read_to_string(&path).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let moved = folder.path().join("moved.toml");
    std::fs::write(&moved, text.replace("33.333, 0, 0]\nD2", "33.373, 0, 0]\nD2")).unwrap();
    let (code, doc) = asked(&["check", moved.to_str().unwrap()]);
    assert_eq!((code, &doc["level"]), (Some(0), &"doubles_as_written".into()), "{doc}");
}

#[test]
fn exact_joints_have_the_families_of_their_construction() {
    let (_, doc) = asked(&["equivalents", "components", &fixture("free-exact")]);
    let list = doc["components"].as_array().unwrap();
    assert_eq!((list.len(), doc["complete"].as_bool()), (6, Some(true)));
    assert!(list.iter().all(|c| c["exact"] == true && c["type"] == "point-line"), "{doc}");
    // the curve of either plane is exactly three lines, with whole coefficients
    for body in ["base", "platform"] {
        let exact = &doc["planes"][0][body]["exact"];
        let kinds: Vec<&Value> = exact["parts"].as_array().unwrap().iter().map(|p| &p["kind"]).collect();
        assert_eq!(kinds, ["line"; 3], "{exact}");
    }
}

/// Equivalent platforms rounded to doubles: one verdict, with the distance, and no claim.
#[test]
fn platforms_that_are_equivalent_within_rounding_are_not_called_equivalent() {
    let folder = tempfile::tempdir().unwrap();
    let design = Design::load("designs/rbt-octahedral.toml").unwrap();
    let (free, _) = design.equivalents().unwrap().joint_free([0.15, 0.35, 0.2, 0.45, 0.3, 0.6]).unwrap();
    let legs = free.manipulator().legs();
    let rounded = Design::new("rounded", &design.units, Manipulator::from_legs(legs).unwrap());
    let path = folder.path().join("rounded.toml");
    std::fs::write(&path, rounded.to_toml()).unwrap();
    let rounded = path.to_str().unwrap();
    let octahedral = "designs/rbt-octahedral.toml";
    for (a, b) in [(octahedral, rounded), (rounded, octahedral)] {
        let (code, map) = asked(&["equivalents", "map", a, b]);
        let (of_verify, verify) = asked(&["verify", a, b, "--samples", "1"]);
        assert_eq!((code, of_verify), (Some(3), Some(3)), "{map}");
        assert_eq!((&map["relation"], &map["level"]), (&Value::Null, &"within_rounding".into()));
        assert_eq!(
            (&map["holds_within_rounding"], &verify["verdict"]),
            (&true.into(), &"inconclusive".into())
        );
        assert!(verify["explanation"].as_str().unwrap().contains("within rounding"), "{verify}");
    }
    let (code, _) = asked(&["equivalents", "family", rounded]);
    assert_eq!(code, Some(3));
}

/// Octahedral platforms with exact corners: fractions, and square roots.
const OCTAHEDRAL: [&str; 2] = [
    r#"name = "fractions"
units = "mm"
legs = [["P1","P4"],["P2","P4"],["P2","P5"],["P3","P5"],["P3","P6"],["P1","P6"]]
[base]
P1 = ["1/7", 0, 0]
P2 = ["31/3", "2/11", 0]
P3 = [4, "29/3", 0]
[platform]
P4 = ["1/5", "1/3", 0]
P5 = ["6", "-7/13", 0]
P6 = ["5/2", "16/3", 0]
"#,
    r#"name = "square roots"
units = "mm"
legs = [["P1","P4"],["P2","P4"],["P2","P5"],["P3","P5"],["P3","P6"],["P1","P6"]]
[base]
P1 = { radius = 10, angle_deg = 0 }
P2 = { radius = 10, angle_deg = 120 }
P3 = { radius = 10, angle_deg = 240 }
[platform]
P4 = { radius = 6, angle_deg = 30 }
P5 = { radius = 6, angle_deg = 150 }
P6 = { radius = "4*sqrt(2)", angle_deg = 270 }
"#,
];

/// Offsets in twentieths for the points of a pattern. On request `det A = 0`, when the pattern can be singular without
/// two joints in one place.
fn offsets(pattern: &Pattern, singular: bool, rng: &mut Rng) -> Vec<f64> {
    let mut draw = || 1 + (rng.next_u64() % 18).cast_signed();
    let list = pattern.offsets();
    let mut twentieths: Vec<i64> = list.iter().map(|_| draw()).collect();
    for k in 0..list.len() {
        // the second point of a side is apart from the first one
        let first = list[..k].iter().position(|o| o.side == list[k].side);
        if first.is_some_and(|first| twentieths[first] == twentieths[k]) {
            twentieths[k] += 1;
        }
    }
    if singular && list.len() == 6 && (0..6).all(|side| list.iter().any(|o| o.side == side && !o.second)) {
        for k in [1, 3, 5] {
            twentieths[k] = 20 - twentieths[k - 1];
        }
    }
    twentieths.into_iter().map(|n| n as f64 / 20.0).collect()
}

/// `check`, `leg_map` and `verify`, both ways, agree with the formula of `det A` on a platform made exactly from an
/// octahedral one.
///
/// `EVIDENCE=full` goes through all 728 patterns of the class, every other one on each of the platforms.
#[test]
fn check_map_and_verify_agree_on_exact_designs() {
    let full = std::env::var("EVIDENCE").is_ok_and(|v| v == "full");
    let family = Family::octahedral();
    let members = family.members();
    let mut rng = Rng::new(40);
    let (mut regular, mut singular) = (0, 0);
    for (k, text) in OCTAHEDRAL.iter().enumerate() {
        let original: Design = text.parse().unwrap();
        let class = original.equivalents().unwrap();
        let picked = members.iter().enumerate().filter(|(n, m)| {
            (full && n % 2 == k) || *n == 300 * k + 100 || m.pattern.to_string() == "S123456"
        });
        for (n, member) in picked {
            let can_be_singular = full || member.pattern.to_string() == "S123456";
            for zero in [false, true].into_iter().filter(|zero| !zero || can_be_singular) {
                let t = offsets(&member.pattern, zero, &mut rng);
                let Ok((design, _)) = class.build(&member.pattern, &t) else { continue };
                // multiples of 1/20: the determinant is zero or at least 20^-6
                let expected = member.pattern.determinant(&t).unwrap().abs() < 1e-10;
                let name = format!("{n} {} {t:?} of {}", member.pattern, original.name);
                let check = design.check().unwrap();
                assert_eq!(
                    (check.is_singular(), check.verdict.level()),
                    (Some(expected), Some(Level::ExactJoints)),
                    "{name}"
                );
                for (a, b) in [(&original, &design), (&design, &original), (&design, &design)] {
                    let map = leg_map(a, b).unwrap();
                    let relation = if expected { Relation::Singular } else { Relation::Equivalent };
                    assert_eq!((map.relation, map.level), (relation, Level::ExactJoints), "{name}");
                    let verified = verify_with(a, b, VerifyOptions::new().samples(0)).unwrap();
                    assert_eq!(verified.verdict.name(), relation.name(), "{name}");
                }
                *(if expected { &mut singular } else { &mut regular }) += 1;
            }
        }
    }
    assert!(regular >= 4 && singular >= 2, "{regular} {singular}");
}
