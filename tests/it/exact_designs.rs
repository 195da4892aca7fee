//! Designs that say exactly where their joints are, through the program.

use std::path::Path;
use std::process::Command;

use equipod::methods::design::{Exactness, Format, parse};
use equipod::prelude::Body;
use serde_json::Value;

/// The paper's octahedral platform, as it is meant.
const OCTAHEDRAL: &str = r#"name = "octahedral, exact"
units = "mm"
legs = [["P1", "P4"], ["P2", "P4"], ["P2", "P5"], ["P3", "P5"], ["P3", "P6"], ["P1", "P6"]]

[parameters]
edge = 12
height = "edge*sqrt(3)/2"

[base]
P1 = [0, 0, 0]
P2 = ["edge/2", "height", 0]
P3 = ["edge", 0, 0]

[platform]
P4 = [0.0, 0.0, 0.0]
P5 = ["edge/2", 0, 0]
P6 = ["edge/4", "-height/2", 0]

[home]
position = [3.0, 5.196152422706632, 15.0]
rpy_deg = [0.0, 0.0, 0.0]

[workspace]
translation = [1.0, 1.0, 1.0]
rotation_deg = [5.0, 5.0, 5.0]
"#;

fn run(folder: &Path, args: &[&str]) -> (Option<i32>, Value) {
    let out =
        Command::new(env!("CARGO_BIN_EXE_equipod")).current_dir(folder).args(args).arg("--json").output();
    let out = out.unwrap();
    let document = serde_json::from_slice(&out.stdout);
    (out.status.code(), document.unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(&out.stderr))))
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("octahedral.toml"), OCTAHEDRAL).unwrap();
    folder
}

#[test]
fn the_joint_free_platform_of_an_exact_design_is_proved_equivalent() {
    let folder = folder();
    let args = [
        "equivalents",
        "family",
        "octahedral.toml",
        "--pattern",
        "S123456",
        "--offsets=0.2,0.4,0.6,0.2,0.4,0.8",
        "-o",
        "free.toml",
    ];
    let (code, _) = run(folder.path(), &args);
    assert_eq!(code, Some(0));
    let text = std::fs::read_to_string(folder.path().join("free.toml")).unwrap();
    for line in
        ["[parameters]", "P2 = [\"edge/2\", \"height\", 0.0]", "Q1 = { on = [\"P1\", \"P2\"], t = 0.2 }"]
    {
        assert!(text.contains(line), "{line}\n{text}");
    }
    let (free, _) = parse(&text, Format::Toml).unwrap();
    for body in [Body::Base, Body::Platform] {
        assert!(free.exact_joints(body).iter().all(|joint| joint.exactness != Exactness::Interval));
    }
    let (code, map) = run(folder.path(), &["equivalents", "map", "octahedral.toml", "free.toml"]);
    // (1 - t) of all less t of all: 0.8 0.6 0.4 0.8 0.6 0.2 - 0.2 0.4 0.6 0.2 0.4 0.8
    assert_eq!(
        (code, map["det_exact"].as_str(), map["relation"].as_str()),
        (Some(0), Some("48/3125"), Some("equivalent"))
    );
    assert_eq!(
        (&map["A_exact"][0], &map["c_exact"][0]),
        (&serde_json::json!(["4/5", "1/5", "0", "0", "0", "0"]), &"-576/25".into())
    );
    // (1 - x) 0.02304 = x 0.01536, the products over the other legs
    assert_eq!(map["singular_offsets"][0], "3/5");
    let all = "(1 - t1) (1 - t2) (1 - t3) (1 - t4) (1 - t5) (1 - t6) - t1 t2 t3 t4 t5 t6";
    assert_eq!(map["det_of_offsets"], all);
    let table = Command::new(env!("CARGO_BIN_EXE_equipod"))
        .args(["equivalents", "map", "octahedral.toml", "free.toml"])
        .current_dir(folder.path())
        .output()
        .unwrap();
    let row = "s1' = 4/5 s1 + 1/5 s2 - 576/25    (det A = 0 for offset t = 3/5)";
    let table = String::from_utf8(table.stdout).unwrap();
    assert!(
        table.contains(row)
            && table.contains(&format!("det A = {all}; the platform is singular if det A = 0")),
        "{table}"
    );
    let (code, verified) = run(folder.path(), &["verify", "octahedral.toml", "free.toml", "--samples", "2"]);
    assert_eq!((code, verified["proved"].as_bool()), (Some(0), Some(true)), "{verified}");
    assert_eq!(
        (&verified["map"]["det_exact"], &verified["map"]["det_of_offsets"]),
        (&"48/3125".into(), &all.into())
    );
    assert!(verified["deviation_bounds"].is_null(), "no difference");
    for sample in verified["samples"].as_array().unwrap() {
        for side in ["a", "b"] {
            assert_eq!(
                (&sample[side]["completeness"], &sample[side]["certified_count"]),
                (&"proved".into(), &16.into()),
                "{sample}"
            );
        }
    }
    // rounded joints are another platform
    let rounded: String = OCTAHEDRAL.replace("\"height\"", "10.3923").replace("\"-height/2\"", "-5.19615");
    std::fs::write(folder.path().join("rounded.toml"), rounded).unwrap();
    let (_, map) = run(folder.path(), &["equivalents", "map", "rounded.toml", "free.toml"]);
    assert_eq!((map["det_exact"].as_str(), map["relation"].as_str()), (None, Some("unrelated")));
    assert!(map["A_exact"].is_null() && map["singular_offsets"].is_null() && map["det_of_offsets"].is_null());
    let (code, verified) = run(folder.path(), &["verify", "rounded.toml", "free.toml", "--samples", "2"]);
    assert_eq!((code, verified["proved"].as_bool()), (Some(1), Some(true)), "proved not to be equivalent");
    // joints that differ by 5e-5 beside a platform of size 12
    let bounds: Vec<f64> =
        verified["deviation_bounds"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    assert!(bounds.iter().all(|x| *x < 2e-2) && bounds.iter().any(|x| *x > 1e-5), "{bounds:?}");
}

#[test]
fn conversion_keeps_what_a_design_says() {
    let folder = folder();
    let text = OCTAHEDRAL.replace("P6 = [\"edge/4\", \"-height/2\", 0]", "P6 = { mirror = \"M\", plane = \"xz\" }\nM = { on = [\"P4\", \"P7\"], offset = 6 }\nP7 = { turn = \"P5\", deg = 60 }");
    std::fs::write(folder.path().join("octahedral.toml"), &text).unwrap();
    let (code, _) = run(folder.path(), &["design", "convert", "octahedral.toml", "-o", "a.json"]);
    assert_eq!(code, Some(0));
    let (code, _) = run(folder.path(), &["design", "convert", "a.json", "-o", "b.toml"]);
    assert_eq!(code, Some(0));
    let read = |name: &str, format| {
        parse(&std::fs::read_to_string(folder.path().join(name)).unwrap(), format).unwrap().0
    };
    let (first, json, toml) =
        (read("octahedral.toml", Format::Toml), read("a.json", Format::Json), read("b.toml", Format::Toml));
    assert_eq!((&json, &toml), (&first, &first));
    assert!(toml.to_toml().contains("M = { on = [\"P4\", \"P7\"], offset = 6.0 }"));
    let m = first.exact_joints(Body::Platform);
    let place = first.platform_names().iter().position(|n| n == "P6").unwrap();
    assert_eq!(m[place].coordinates, ["3", "-3*sqrt(3)", "0"]);
}

#[test]
#[ignore = "evidence"]
fn the_optimised_platform_has_its_joints_on_the_edges() {
    let folder = folder();
    let (code, answer) = run(folder.path(), &["optimize", "octahedral.toml", "-o", "best.toml"]);
    assert!(matches!(code, Some(0 | 3)), "{answer}");
    let text = std::fs::read_to_string(folder.path().join("best.toml")).unwrap();
    assert_eq!(text.matches("{ on = [").count(), 6, "{text}");
    let (_, map) = run(folder.path(), &["equivalents", "map", "octahedral.toml", "best.toml"]);
    assert_eq!(map["relation"], "equivalent");
    assert!(map["det_exact"].is_string(), "{}", map["explanation"]);
}

const LENGTHS: &str = "15.8,16.1,15.5,15.9,15.7,16.4";

/// The answer of `fk`.
fn solved(folder: &Path, design: &str, lengths: &str) -> (Option<i32>, Value) {
    let (code, answer) = run(folder, &["fk", design, "--lengths", lengths, "--method", "homotopy"]);
    (code, answer)
}

#[test]
fn poses_of_exact_designs_are_certified_and_counted_and_rounded_joints_are_another_platform() {
    let folder = folder();
    let args = ["equivalents", "family", "octahedral.toml", "--pattern", "S123456"];
    let offsets = ["--offsets=0.2,0.4,0.6,0.2,0.4,0.8", "-o", "free.toml"];
    assert_eq!(run(folder.path(), &[&args[..], &offsets[..]].concat()).0, Some(0));
    for design in ["octahedral.toml", "free.toml"] {
        let (code, answer) = solved(folder.path(), design, LENGTHS);
        assert_eq!(code, Some(0), "{design}: {answer}");
        let certified = answer["solutions"].as_array().unwrap().iter().filter(|r| r["certified"] == true);
        assert_eq!(certified.count(), 16, "{design}");
        assert_eq!(answer["completeness"], "proved", "{design}");
        let (_, check) = run(folder.path(), &["check", design]);
        let (count, bound) = (&check["pose_count"], &check["pose_bound"]);
        assert_eq!((&count["finite"], &bound["poses"]), (&16.into(), &16.into()), "{design}");
    }
    // the joints of the same platform as the nearest doubles
    let (exact, _) =
        parse(&std::fs::read_to_string(folder.path().join("free.toml")).unwrap(), Format::Toml).unwrap();
    let m = exact.manipulator();
    let names = |body: &str| -> Vec<String> { (0..6).map(|i| format!("{body}{i}")).collect() };
    let list = |names: &[String], joints: &[nalgebra::Point3<f64>]| -> String {
        let line =
            |(n, p): (&String, &nalgebra::Point3<f64>)| format!("{n} = [{:?}, {:?}, {:?}]\n", p.x, p.y, p.z);
        names.iter().zip(joints).map(line).collect::<Vec<_>>().concat()
    };
    let pairs: Vec<String> = m.pairs().iter().map(|(a, b)| format!("[\"A{a}\", \"B{b}\"]")).collect();
    let text = format!(
        "name = \"rounded\"\nunits = \"mm\"\nlegs = [{}]\n[base]\n{}[platform]\n{}",
        pairs.join(", "),
        list(&names("A"), m.base_joints()),
        list(&names("B"), m.platform_joints())
    );
    std::fs::write(folder.path().join("rounded.toml"), text).unwrap();
    let (code, answer) = solved(folder.path(), "rounded.toml", LENGTHS);
    // the other 24 of 40 are far out, where the joints have moved by rounding
    let (completeness, far) = (answer["completeness"].as_str(), answer["bound"]["far"].as_u64());
    assert_eq!((code, answer["finite_count"].as_u64()), (Some(0), Some(16)));
    assert_eq!((completeness, far), (Some("proved_bounded"), Some(24)));
}

/// A corner at an angle whose cosine is no sum of square roots. Joints on its sides are known between bounds, poses are
/// certified for all of them, and none are counted.
#[test]
#[ignore = "evidence"]
fn joints_known_between_bounds_are_certified_and_not_complete_by_counting() {
    let folder = folder();
    let args = ["equivalents", "family", "octahedral.toml", "--pattern", "S123456"];
    let offsets = ["--offsets=0.2,0.4,0.6,0.2,0.4,0.8", "-o", "free.toml"];
    assert_eq!(run(folder.path(), &[&args[..], &offsets[..]].concat()).0, Some(0));
    let free = std::fs::read_to_string(folder.path().join("free.toml")).unwrap();
    let place = "P3 = [\"edge\", 0.0, 0.0]";
    assert!(free.contains(place), "{free}");
    let enclosed = free.replace(place, "P3 = { radius = 12, angle_deg = 7, z = 0 }");
    std::fs::write(folder.path().join("enclosed.toml"), enclosed).unwrap();
    let (code, answer) = solved(folder.path(), "enclosed.toml", LENGTHS);
    let certified = answer["solutions"].as_array().unwrap().iter().filter(|r| r["certified"] == true);
    assert_eq!((code, certified.count()), (Some(3), 16), "{answer}");
    assert_eq!(answer["completeness"], "unproved");
    assert_eq!(answer["pose_count"]["undecided"], "joints_not_exact");
}

/// The symmetric hexapod is symmetric when its joints are copies of one, turned and mirrored.
#[test]
fn an_exact_symmetric_hexapod_has_its_28_poses() {
    let folder = tempfile::tempdir().unwrap();
    let body = |name: &str, x: i32, y: i32| {
        let turned =
            |i: usize, of: usize, deg: i32| format!("{name}{i} = {{ turn = \"{name}{of}\", deg = {deg} }}\n");
        let copies = [turned(3, 1, 120), turned(4, 2, 120), turned(5, 1, 240), turned(6, 2, 240)].concat();
        format!("{name}1 = [{x}, {y}, 0]\n{name}2 = {{ mirror = \"{name}1\", plane = \"xz\" }}\n{copies}")
    };
    let legs: Vec<String> = (1..7).map(|i| format!("[\"A{i}\", \"B{i}\"]")).collect();
    let text = format!(
        "name = \"hexapod\"\nunits = \"mm\"\nlegs = [{}]\n[base]\n{}[platform]\n{}",
        legs.join(", "),
        body("A", 9, 2),
        body("B", 4, 3)
    );
    std::fs::write(folder.path().join("hexapod.toml"), text).unwrap();
    let (code, answer) = solved(folder.path(), "hexapod.toml", LENGTHS);
    let certified = answer["solutions"].as_array().unwrap().iter().filter(|r| r["certified"] == true);
    assert_eq!((code, certified.count()), (Some(0), 28), "{answer}");
    assert_eq!(answer["completeness"], "proved");
    let (_, check) = run(folder.path(), &["check", "hexapod.toml"]);
    let count = &check["pose_count"];
    assert_eq!((&count["finite"], &count["lengths"]), (&28.into(), &"generic".into()));
    assert!(count["error_probability"].as_f64() < Some(1e-11));
    assert_eq!(check["pose_bound"]["poses"], 28);
    assert!(check["pose_bound"]["theorem"].as_str().unwrap().contains("12 are at infinity"));
}

const DESIGNS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/designs");

fn shipped(name: &str) -> equipod::prelude::Design {
    equipod::prelude::Design::load(format!("{DESIGNS}/{name}.toml")).unwrap()
}

#[test]
fn shipped_designs_say_how_exactly_their_joints_are_known() {
    for (name, known) in [
        ("rbt-octahedral", "exact numbers of Q(sqrt(3))"),
        ("rbt-griffis-duffy", "exact numbers of Q(sqrt(3))"),
        ("rbt-midline", "exact numbers of Q(sqrt(3))"),
        ("symmetric-hexapod", "exact numbers of Q(sqrt(3))"),
        ("presets/bench-l16", "exact numbers of Q(sqrt(3))"),
        ("presets/motion-base-6dof2000e", "exact numbers of Q(sqrt(3))"),
        ("worked/bench-octahedral", "exact numbers of Q(sqrt(3))"),
        ("worked/simulator-octahedral", "exact numbers of Q(sqrt(3))"),
        ("worked/positioner-octahedral", "exact numbers of Q(sqrt(3))"),
        ("worked/isolator-octahedral", "exact numbers of Q(sqrt(2), sqrt(3))"),
        ("worked/linuxcnc-octahedral", "exact fractions"),
        // published numbers
        ("dietmaier", "doubles as written"),
        ("porta-thomas-1", "doubles as written"),
    ] {
        assert_eq!(shipped(name).exactness().to_string(), known, "{name}");
    }
    for folder in ["", "presets", "worked"] {
        for file in std::fs::read_dir(format!("{DESIGNS}/{folder}")).unwrap() {
            let path = file.unwrap().path();
            if path.extension().is_some_and(|e| e == "toml") {
                let text = std::fs::read_to_string(&path).unwrap();
                let read = equipod::methods::design::parse_with_cranks(&text, Format::Toml);
                let known = read.unwrap().0.exactness();
                assert!(known.enclosed.is_empty(), "{}: {known}", path.display());
            }
        }
    }
    let (code, answer) = run(Path::new(DESIGNS), &["check", "symmetric-hexapod.toml"]);
    let joints = &answer["joints"];
    assert_eq!(
        (code, &joints["exactness"], &joints["radicands"], &joints["enclosed"]),
        (Some(0), &"field".into(), &serde_json::json!([3]), &serde_json::json!([]))
    );
}

#[test]
fn shipped_equivalent_platforms_are_exactly_equivalent() {
    for (from, to, det) in [
        ("rbt-octahedral", "rbt-griffis-duffy", Some("819/3125")),
        ("worked/bench-octahedral", "worked/bench-joint-free", None),
        ("worked/linuxcnc-octahedral", "worked/linuxcnc-griffis-duffy", None),
        ("worked/positioner-octahedral", "worked/positioner-joint-free", None),
        ("worked/isolator-octahedral", "worked/isolator-1", None),
        ("worked/isolator-octahedral", "worked/isolator-3", None),
        ("worked/isolator-octahedral", "worked/isolator-6", None),
    ] {
        let files = [from, to].map(|name| format!("{name}.toml"));
        let (code, map) = run(Path::new(DESIGNS), &["equivalents", "map", &files[0], &files[1]]);
        assert_eq!((code, map["relation"].as_str()), (Some(0), Some("equivalent")), "{to}: {map}");
        let found = map["det_exact"].as_str();
        assert!(found.is_some() && det.is_none_or(|det| found == Some(det)), "{to}: {map}");
    }
    let (_, map) =
        run(Path::new(DESIGNS), &["equivalents", "map", "rbt-octahedral.toml", "rbt-midline.toml"]);
    assert_eq!((map["relation"].as_str(), map["det_exact"].as_str()), (Some("singular"), Some("0")), "{map}");
}

#[test]
fn the_symmetric_hexapod_is_symmetric() {
    let design = shipped("symmetric-hexapod");
    for body in [Body::Base, Body::Platform] {
        let joints = design.exact_joints(body);
        let mirrored = |text: &str| text.strip_prefix('-').map_or(format!("-{text}"), str::to_owned);
        let [first, second] = [&joints[0].coordinates, &joints[1].coordinates];
        assert_eq!((first[0].clone(), first[1].clone()), (second[0].clone(), mirrored(&second[1])));
        // images in the mirror of the planes that the turn by 120 degrees makes of the first
        let x = |i: usize| joints[i].coordinates[0].clone();
        assert_eq!((x(2), x(3)), (x(5), x(4)));
    }
    let lengths = design.home.unwrap().lengths(design.manipulator()).unwrap().get();
    assert!(lengths.iter().all(|l| (l - lengths[0]).abs() < 1e-12), "{lengths:?}");
}

/// Corners that an optimiser does not choose are those of the design, constructions and all.
#[test]
#[ignore = "evidence"]
fn a_platform_optimised_under_requirements_keeps_the_triangles_of_its_design() {
    let folder = folder();
    let asks = "[optimize]\nvariables = [\"offsets\", \"home_height\"]\nobjective = \"worst_conditioning\"\n\n[workspace]\ngrid = 1";
    let text = OCTAHEDRAL.replace("[workspace]", asks);
    std::fs::write(folder.path().join("asked.toml"), text).unwrap();
    let (code, answer) = run(folder.path(), &["optimize", "asked.toml", "-o", "best.toml"]);
    assert!(matches!(code, Some(0 | 3)), "{answer}");
    let best = std::fs::read_to_string(folder.path().join("best.toml")).unwrap();
    assert_eq!(best.matches("{ on = [").count(), 6, "{best}");
    let (code, map) = run(folder.path(), &["equivalents", "map", "asked.toml", "best.toml"]);
    assert_eq!((code, map["relation"].as_str()), (Some(0), Some("equivalent")));
    assert!(map["det_exact"].is_string(), "{}", map["explanation"]);
}

#[test]
#[ignore = "evidence"]
fn holes_of_a_grid_are_decimals() {
    let folder = folder();
    let free = format!("{DESIGNS}/worked/bench-joint-free.toml");
    let args = [
        "build",
        "round",
        &free,
        "--grid",
        "2.54",
        "--variant",
        "exact",
        "--trials",
        "0",
        "-o",
        "holes.toml",
    ];
    let (code, answer) = run(folder.path(), &args);
    // the grid uses up the safety margin of the hexapod
    assert_eq!(code, Some(0), "{answer}");
    let (holes, _) =
        parse(&std::fs::read_to_string(folder.path().join("holes.toml")).unwrap(), Format::Toml).unwrap();
    assert_eq!(holes.exactness().to_string(), "exact fractions");
    for (body, joints) in [(Body::Base, "base"), (Body::Platform, "platform")] {
        for (joint, cell) in holes.exact_joints(body).iter().zip(cells(&answer, joints)) {
            for axis in 0..2 {
                let pitches = fraction(&joint.coordinates[axis]) * 50.0 / 127.0;
                assert!((pitches - cell[axis]).abs() < 1e-9, "{joint:?} {cell:?}");
            }
        }
    }
    // a turned grid has no decimals
    let turned = [&args[..5], &["--angle", "10"], &args[5..]].concat();
    let (code, _) = run(folder.path(), &turned);
    assert_eq!(code, Some(0));
    let text = std::fs::read_to_string(folder.path().join("holes.toml")).unwrap();
    let (_, base) = text.split_once("[base]").unwrap();
    let (base, platform) = base.split_once("[platform]").unwrap();
    assert!(!base.contains('"') && platform.contains("[\""), "{text}");
}

/// The holes of a body in the order of its joints.
fn cells(answer: &Value, body: &str) -> Vec<[f64; 2]> {
    let joints = answer["exact"]["joints"].as_array().unwrap().iter().filter(|j| j["body"] == body);
    joints.map(|j| [0, 1].map(|axis| j["cell"][axis].as_f64().unwrap())).collect()
}

fn fraction(text: &str) -> f64 {
    let (n, d) = text.split_once('/').unwrap_or((text, "1"));
    n.parse::<f64>().unwrap() / d.parse::<f64>().unwrap()
}

#[test]
fn an_exchanged_design_keeps_its_constructions_and_a_moved_one_has_numbers() {
    let folder = folder();
    let args =
        ["verify", "octahedral.toml", "octahedral.toml", "--samples", "1", "--exchange", "-o", "other.toml"];
    run(folder.path(), &args);
    let text = std::fs::read_to_string(folder.path().join("other.toml")).unwrap();
    assert!(text.contains("P2 = [\"edge/2\", \"height\", 0.0]"), "{text}");
    let (exchanged, _) = parse(&text, Format::Toml).unwrap();
    let (given, _) = parse(OCTAHEDRAL, Format::Toml).unwrap();
    assert_eq!(exchanged.exact_joints(Body::Platform), given.exact_joints(Body::Base));
    assert_eq!(exchanged.exact_joints(Body::Base), given.exact_joints(Body::Platform));
    let args =
        ["verify", "octahedral.toml", "octahedral.toml", "--samples", "1", "--align", "-o", "moved.toml"];
    run(folder.path(), &args);
    let text = std::fs::read_to_string(folder.path().join("moved.toml")).unwrap();
    assert_eq!(parse(&text, Format::Toml).unwrap().0.exactness().exactness, None, "{text}");
}

#[test]
fn the_constructed_fixtures_say_the_same_in_both_notations() {
    let fixture = |name: &str, format| {
        let path = format!("{}/tests/fixtures/{name}", env!("CARGO_MANIFEST_DIR"));
        parse(&std::fs::read_to_string(path).unwrap(), format).unwrap().0
    };
    let (toml, json) = (fixture("constructed.toml", Format::Toml), fixture("constructed.json", Format::Json));
    for body in [Body::Base, Body::Platform] {
        assert_eq!(toml.exact_joints(body), json.exact_joints(body));
    }
    let known = toml.exactness();
    assert_eq!(known.exactness, Some(Exactness::Interval));
    assert_eq!(known.enclosed, ["platform.D", "platform.F"]);
}
