//! `equipod export` as a process: files, refusals, limits of a format. Programs that are not ours read the files in
//! `tests/exports`.

use std::path::Path;

use serde_json::Value;

use super::cli_frame::{document, equipod};

const FORMATS: [&str; 12] =
    ["c", "csv", "dxf", "hal", "json", "matlab", "mjcf", "sdf", "step", "stl", "svg", "urdf"];

fn run(args: &[&str]) -> (Option<i32>, Value) {
    let mut all = vec!["export"];
    all.extend(args);
    all.push("--json");
    let out = equipod(&all);
    (out.status.code(), document(&out))
}

fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap()
}

#[test]
#[ignore = "evidence"]
fn all_formats_of_shared_joints_and_of_a_joint_free_design() {
    let folder = tempfile::tempdir().unwrap();
    let free = folder.path().join("free.toml");
    let free = free.to_str().unwrap();
    let offsets = "--offsets=-0.2,0.21,-0.22,0.2,-0.2,0.23";
    let original = "designs/rbt-octahedral.toml";
    let made = equipod(&["equivalents", "family", original, "--pattern", "S123456", offsets, "-o", free]);
    assert_eq!(made.status.code(), Some(0));
    for (design, joints) in [(original, 3), (free, 6)] {
        let out = folder.path().join(joints.to_string());
        let (code, doc) = run(&[design, "--to", "all", "-o", out.to_str().unwrap()]);
        assert_eq!(code, Some(0), "{doc}");
        let formats = doc["formats"].as_array().unwrap();
        let names: Vec<&str> = formats.iter().map(|f| f["format"].as_str().unwrap()).collect();
        assert_eq!(names, FORMATS);
        for file in formats.iter().flat_map(|f| f["files"].as_array().unwrap()) {
            let text = std::fs::read_to_string(file.as_str().unwrap()).unwrap();
            assert!(text.len() > 200 || text.starts_with("#include \"linuxcnc/"), "{file}");
        }
        // the document read by a parser: joints are where the design has them
        let platform: Value = serde_json::from_str(&read(&out, "platform.json")).unwrap();
        assert_eq!(platform["units"], "mm");
        for body in ["base", "platform"] {
            let list = platform[body]["joints"].as_array().unwrap();
            assert_eq!(
                (list.len(), platform[body]["plate"]["holes"].as_array().unwrap().len()),
                (joints, joints)
            );
        }
        assert_eq!(platform["workspace"].as_array().unwrap().len(), 65, "home and the corners of the box");
        assert!(platform["trajectory"].as_array().unwrap().is_empty());
        assert_eq!(read(&out, "base-plate.dxf").matches("CIRCLE").count(), joints);
    }
    let platform: Value = serde_json::from_str(&read(&folder.path().join("3"), "platform.json")).unwrap();
    assert_eq!(platform["base"]["joints"][1]["at"][1].as_f64(), Some(10.392304845413264));
}

#[test]
fn what_is_written_and_left_out_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let out = equipod(&[
        "export",
        "designs/rbt-octahedral.toml",
        "--to",
        "hal,dxf",
        "-o",
        folder.path().to_str().unwrap(),
    ]);
    assert_eq!(out.status.code(), Some(0));
    let text = String::from_utf8(out.stdout).unwrap().replace(folder.path().to_str().unwrap(), "DIR");
    // whether the design meets its requirements stands first
    let (assessed, text) = text.split_once("\n\nwrote").map(|(a, b)| (a, format!("wrote{b}"))).unwrap();
    assert!(assessed.starts_with("octahedral 12-6 meets all its requirements, proved"), "{assessed}");
    let written = r"wrote DIR/base-plate.dxf
wrote DIR/platform-plate.dxf
  dxf leaves out legs; heights of joints above the plate are text only
wrote DIR/genhexkins.hal
  hal leaves out joint axes and lead of the screws (genhexkins corrects for both): base-n, platform-n and screw-lead stay as they are; correlations of a calibration, which the formats csv, json and c have
";
    let sizes = text.strip_prefix(written).unwrap_or_else(|| panic!("{text}"));
    for (what, value, from) in [
        (
            "ball diameter, base",
            "0.346 mm",
            "rule: minimum of 0.05 of the size, 0.4 of the least distance of joints, 0.1 of the shortest leg at home",
        ),
        ("hole diameter, platform", "0.173 mm", "rule: half a ball"),
        ("cylinder length from the base joint", "8.08 mm", "rule: half the shortest leg at home"),
        (
            "mass of the platform with payload",
            "6.65e-6 kg",
            "rule: 20 kg times the cube of the size in metres",
        ),
    ] {
        let row = sizes.lines().find(|line| line.starts_with(what)).unwrap_or_else(|| panic!("{sizes}"));
        assert!(row.contains(value) && row.ends_with(from), "{row}");
    }
    // files of controllers have no parts whose sizes could be chosen
    let path = folder.path().join("controller");
    let out = equipod(&[
        "export",
        "designs/rbt-octahedral.toml",
        "--to",
        "hal,matlab",
        "-o",
        path.to_str().unwrap(),
    ]);
    let text = String::from_utf8(out.stdout).unwrap();
    assert!(text.contains("genhexkins.hal") && !text.contains("diameter"), "{text}");
}

#[test]
fn a_trajectory_gets_a_table_of_its_own_between_its_poses() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string("designs/rbt-octahedral.toml").unwrap();
    let text = text.replace("grid = 2\n", "grid = 1\ntrajectory = \"path.csv\"\n");
    let design = folder.path().join("moving.toml");
    std::fs::write(&design, text).unwrap();
    std::fs::write(folder.path().join("path.csv"), "3,5,15,0,0,0\n3,5,16,0,0,10\n4,5,16,0,0,0\n").unwrap();
    let out = folder.path().join("out");
    let (code, doc) = run(&[design.to_str().unwrap(), "--to", "csv", "-o", out.to_str().unwrap()]);
    assert_eq!(code, Some(0), "{doc}");
    let rows = |name: &str| read(&out, name).lines().filter(|l| !l.starts_with('#')).count() - 1;
    assert_eq!((rows("lengths-trajectory.csv"), rows("lengths-workspace.csv")), (41, 1));
}

#[test]
fn refusals() {
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().to_str().unwrap();
    let general = "designs/general-6-6.toml";
    let (code, doc) = run(&[general, "--to", "csv", "-o", to]);
    assert_eq!((code, doc["error"]["code"].as_str()), (Some(2), Some("export::unknown_unit")));
    assert!(doc["error"]["message"].as_str().unwrap().contains("um, mm, cm, m, in, ft"));
    assert_eq!(run(&[general, "--to", "csv", "-o", to, "--unit", "m"]).0, Some(0));
    let (code, doc) = run(&[general, "--to", "csv", "-o", to, "--unit", "ell"]);
    assert_eq!((code, doc["error"]["code"].as_str()), (Some(2), Some("export::unknown_unit")));
    let octahedral = "designs/rbt-octahedral.toml";
    let (code, doc) = run(&[octahedral, "--to", "csv", "-o", to, "--thickness", "0"]);
    assert_eq!((code, doc["error"]["code"].as_str()), (Some(2), Some("export::bad_size")));
    assert_eq!(run(&[octahedral, "--to", "iges", "-o", to]).0, Some(2));
    // one format is impossible, the other is possible: the answer is no, and the possible file is written
    let wide = ["--hole-diameter", "4", "--ball-diameter", "5", "--margin", "5"];
    let (code, doc) = run(&[&["designs/rbt-midline.toml", "--to", "dxf,csv", "-o", to], &wide[..]].concat());
    assert_eq!(code, Some(1));
    assert!(doc["formats"][0]["files"].as_array().unwrap().len() == 4, "{doc}");
    assert!(doc["formats"][1]["refused"].as_str().unwrap().contains("overlap"), "{doc}");
    // a design that one of the files would replace stays
    let own = folder.path().join("platform.json");
    assert_eq!(
        equipod(&["design", "convert", octahedral, "-o", own.to_str().unwrap()]).status.code(),
        Some(0)
    );
    let before = read(folder.path(), "platform.json");
    let (code, doc) = run(&[own.to_str().unwrap(), "--to", "json", "-o", to]);
    assert_eq!((code, doc["error"]["code"].as_str()), (Some(2), Some("file::overwrites_input")));
    assert_eq!(read(folder.path(), "platform.json"), before);
}

/// Hole plans and tables have the tolerance that `build tolerances` gives for the same bound.
#[test]
fn drawings_carry_the_tolerance_of_the_places_of_holes() {
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().to_str().unwrap();
    let design = "designs/rbt-octahedral.toml";
    let asked = ["--bound", "0.1,0.5", "--tool", "0,0,1"];
    let (code, doc) = run(&[&[design, "--to", "dxf,csv", "-o", to], &asked[..]].concat());
    assert_eq!(code, Some(0), "{doc}");
    let budget =
        equipod(&[&["build", "tolerances", design, "--trials", "10", "--json"], &asked[..]].concat());
    let radius = document(&budget)["solved"]["radius"].as_f64().unwrap();
    let shown = |text: &str, before: &str| -> f64 {
        text.split_once(before).unwrap().1.split_whitespace().next().unwrap().parse().unwrap()
    };
    for (name, before) in
        [("base-plate.dxf", "within circles of diameter "), ("joints.csv", "a ball of diameter ")]
    {
        let diameter = shown(&read(folder.path(), name), before);
        assert!(diameter <= 2.0 * radius && diameter > 1.98 * radius, "{name}: {diameter}, {radius}");
    }
    let refused = |more: &[&str]| {
        let (code, doc) = run(&[&[design, "-o", to], more].concat());
        assert_eq!(code, Some(2), "{doc}");
        doc["error"]["code"].as_str().unwrap().to_owned()
    };
    assert_eq!(refused(&["--to", "step", "--bound", "0.1,0.5"]), "usage::no_effect");
    assert_eq!(refused(&["--to", "dxf", "--tool", "0,0,1"]), "usage::no_effect");
    assert_eq!(refused(&["--to", "dxf", "--bound", "0,0.5"]), "tolerances::bad_bound");
}

/// Files of the format `c`, in the order in which they are told.
const C_FILES: [&str; 11] = [
    "equipod.h",
    "equipod.c",
    "equipod_design.h",
    "equipod_design.c",
    "equipod_vectors.h",
    "equipod_selftest.c",
    "CMakeLists.txt",
    "equipodkins.h",
    "linuxcnc/equipodkins.h",
    "linuxcnc/equipodkins.c",
    "linuxcnc/equipodkins_ops.c",
];

/// The program's own folder of C for a design, as texts.
fn c_files(design: &str, options: &[&str], folder: &Path) -> Vec<String> {
    let to = folder.to_str().unwrap();
    let (code, doc) = run(&[&[design, "--to", "c", "-o", to], options].concat());
    assert_eq!(code, Some(0), "{doc}");
    let told: Vec<&str> =
        doc["formats"][0]["files"].as_array().unwrap().iter().map(|f| f.as_str().unwrap()).collect();
    let names: Vec<&Path> = told.iter().map(|f| Path::new(f).strip_prefix(folder).unwrap()).collect();
    assert_eq!(names, C_FILES.map(Path::new));
    C_FILES.map(|name| read(folder, name)).to_vec()
}

#[test]
fn the_folder_for_linuxcnc_keeps_the_rules_of_writing() {
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().join("c");
    std::fs::create_dir_all(&to).unwrap();
    // a file in place of the folder is refused and stays
    let in_the_way = to.join("linuxcnc");
    std::fs::write(&in_the_way, "mine").unwrap();
    let design = "designs/rbt-octahedral.toml";
    let (code, doc) = run(&[design, "--to", "c", "-o", to.to_str().unwrap()]);
    assert_eq!((code, doc["error"]["code"].as_str()), (Some(2), Some("file::not_writable")));
    assert_eq!(std::fs::read_to_string(&in_the_way).unwrap(), "mine");
    std::fs::remove_file(&in_the_way).unwrap();
    // in that folder as elsewhere a design is never replaced by something else, and an older file of an export is
    std::fs::create_dir(&in_the_way).unwrap();
    let own = in_the_way.join("equipodkins.h");
    std::fs::copy(design, &own).unwrap();
    let (code, doc) = run(&[design, "--to", "c", "-o", to.to_str().unwrap()]);
    assert_eq!((code, doc["error"]["code"].as_str()), (Some(2), Some("file::overwrites_design")));
    assert_eq!(std::fs::read(&own).unwrap(), std::fs::read(design).unwrap());
    std::fs::write(&own, "old").unwrap();
    assert_eq!(run(&[design, "--to", "c", "-o", to.to_str().unwrap()]).0, Some(0));
    assert!(std::fs::read_to_string(&own).unwrap().contains("../equipod.c"));
}

#[test]
fn c_for_controllers_is_the_same_every_time_and_only_its_numbers_are_those_of_the_design() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let design = "designs/rbt-griffis-duffy.toml";
    let first = c_files(design, &[], &at("first"));
    assert_eq!(first, c_files(design, &[], &at("second")));
    let other = c_files("designs/general-6-6.toml", &["--unit", "m"], &at("other"));
    // the algorithm does not depend on the design, its numbers do
    for (i, name) in C_FILES.into_iter().enumerate() {
        let of_design = ["equipod_design.h", "equipod_design.c", "equipod_vectors.h"].contains(&name);
        assert_eq!(first[i] != other[i], of_design, "{name}");
    }
    // the octahedral platform behind it, only where there is one
    assert!(first[2].contains("EQUIPOD_HAS_OCTAHEDRAL") && first[4].contains("map_vectors"));
    assert!(!other[2].contains("EQUIPOD_HAS_OCTAHEDRAL") && !other[4].contains("map_vectors"));
    // one comment at most begins and ends in the heading, and no other bytes than ASCII stand in the texts
    for (text, name) in first.iter().zip(C_FILES) {
        assert!(text.is_ascii(), "{name}");
        assert_eq!(text.matches("/*").count(), text.matches("*/").count(), "{name}");
    }
    // constructs that controllers must not have
    for forbidden in ["malloc", "alloca", "setjmp", "static double", "goto"] {
        assert!(!first[1].contains(forbidden), "{forbidden}");
    }
    let includes: Vec<&str> = first[1].lines().filter(|l| l.starts_with("#include <")).collect();
    assert_eq!(includes, ["#include <float.h>", "#include <math.h>"]);
}

#[test]
fn names_of_designs_cannot_end_comments_of_c() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string("designs/symmetric-hexapod.toml").unwrap();
    let named = text.replacen("name = \"", "name = \"a */ int x; /* b \\\\ ", 1);
    assert_ne!(text, named);
    let design = folder.path().join("named.toml");
    std::fs::write(&design, named).unwrap();
    let files = c_files(design.to_str().unwrap(), &[], &folder.path().join("out"));
    assert!(files[3].contains("a * / int x; / * b"), "{}", &files[3][..200]);
}
