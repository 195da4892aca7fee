//! Poses in the conventions of others: options, tables, `[frames]` of a design, and answers in the same convention.

use std::path::{Path, PathBuf};

use serde_json::Value;

use super::cli_frame::{document, equipod};

/// The angles of its six joints on circles of 700 and 600 mm.
const MACHINE: [&str; 2] = ["-10,10,110,130,230,250", "-50,50,70,170,190,290"];
/// The lengths for 0,0,650 with U, V, W of 5, 3, 10 degrees in the convention of Physik Instrumente. They are computed
/// by hand from `R = Rx(U) Ry(V) Rz(W)`.
const PI_LENGTHS: [f64; 6] = [686.967, 878.529, 779.224, 881.419, 747.514, 810.898];

/// A folder with the machine, and more tables at the end of its file.
fn machine(tables: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("machine.toml");
    let ring = |radius: f64, angles: &str, letter: char| -> String {
        let joint = |(k, angle): (usize, &str)| {
            let t = angle.parse::<f64>().unwrap().to_radians();
            format!("{letter}{} = [{:?}, {:?}, 0.0]\n", k + 1, radius * t.cos(), radius * t.sin())
        };
        angles.split(',').enumerate().map(joint).collect()
    };
    let legs: Vec<String> = (1..=6).map(|k| format!("[\"A{k}\", \"B{k}\"]")).collect();
    let text = format!(
        "name = \"sim\"\nunits = \"mm\"\nlegs = [{}]\n[base]\n{}[platform]\n{}[home]\nposition = [0.0, 0.0, 650.0]\nrpy_deg = [0.0, 0.0, 0.0]\n{tables}",
        legs.join(", "),
        ring(700.0, MACHINE[0], 'A'),
        ring(600.0, MACHINE[1], 'B'),
    );
    std::fs::write(&path, text).unwrap();
    (folder, path)
}

fn asked(words: &[&str]) -> Value {
    document(&equipod(&[words, &["--json"]].concat()))
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap_or_else(|| panic!("{value}")).iter().map(|x| x.as_f64().unwrap()).collect()
}

fn lengths(design: &Path, more: &[&str]) -> Vec<f64> {
    let doc = asked(&[&["ik", design.to_str().unwrap()], more].concat());
    numbers(if doc["rows"].is_null() { &doc["lengths"] } else { &doc["rows"][0]["lengths"] })
}

fn differ(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

#[test]
fn lengths_of_controllers_come_from_options_columns_and_the_design() {
    let (folder, plain) = machine("");
    let (_kept, own) = machine("[frames]\nrotation_order = \"pi\"\n");
    let table = folder.path().join("uvw.csv");
    std::fs::write(&table, "X,Y,Z,U,V,W\n0,0,650,5,3,10\n").unwrap();
    let unclear = folder.path().join("rxyz.csv");
    std::fs::write(&unclear, "x,y,z,rx,ry,rz\n0,0,650,5,3,10\n").unwrap();
    let pose = "0,0,650,5,3,10";
    for (design, words) in [
        (&plain, vec!["--pose", pose, "--rotation-order", "pi"]),
        (&plain, vec!["--pose", pose, "--rotation-order", "moving-xyz"]),
        (&plain, vec!["--pose", "0,0,650,10,3,5", "--rotation-order", "fixed-zyx"]),
        (&plain, vec![table.to_str().unwrap()]),
        (&plain, vec![unclear.to_str().unwrap(), "--rotation-order", "rubin"]),
        (&own, vec!["--pose", pose]),
        (&own, vec![unclear.to_str().unwrap()]),
    ] {
        let found = lengths(design, &words);
        assert!(differ(&found, &PI_LENGTHS) < 6e-4, "{words:?}: {found:?}");
    }
    // without an order the columns are refused, and the help names the option
    let refused = asked(&["ik", plain.to_str().unwrap(), unclear.to_str().unwrap()]);
    assert!(refused["error"]["help"].as_str().unwrap().contains("--rotation-order"), "{refused}");
    // the usual order is another pose
    let usual = lengths(&plain, &["--pose", pose]);
    assert!((usual[0] - 686.356).abs() < 1e-3, "{usual:?}");
    // an option counts more than the design
    let over = lengths(&own, &["--pose", pose, "--rotation-order", "rpy"]);
    assert_eq!(over, usual);
    let doc = asked(&["ik", own.to_str().unwrap(), "--pose", pose]);
    assert_eq!(doc["frames"]["formula"], "Rx(a) Ry(b) Rz(c)", "{doc}");
    assert!(differ(&numbers(&doc["in_frames"]["angles"]), &[5.0, 3.0, 10.0]) < 1e-12);
    let spoken = equipod(&["ik", own.to_str().unwrap(), "--pose", pose]);
    let said = String::from_utf8_lossy(&spoken.stderr).into_owned();
    assert!(said.contains("moving-xyz"), "{said}");
}

#[test]
fn tables_in_another_unit_of_length_give_the_same_answers() {
    let (folder, design) = machine("");
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let metres = file(
        "m.csv",
        "t [s];x [m];y [m];z [m];roll [rad];pitch [rad];yaw [rad]\n0;0,01;-0,02;0,66;0;0;0,1\n",
    );
    let turn = 0.1f64.to_degrees();
    let meant = lengths(&design, &["--pose", &format!("10,-20,660,0,0,{turn}")]);
    assert!(differ(&lengths(&design, &[&metres]), &meant) < 1e-9);
    let said = equipod(&["ik", design.to_str().unwrap(), &metres]);
    let said = String::from_utf8_lossy(&said.stderr).into_owned();
    assert!(said.contains("Lengths in m, as the table says, are converted to mm."), "{said}");
    let row: Vec<String> = meant.iter().rev().map(|l| (l / 1000.0).to_string()).collect();
    let legs = file("l.csv", &format!("l5_m,l4_m,l3_m,l2_m,l1_m,l0_m\n{}\n", row.join(",")));
    let near = asked(&["fk", design.to_str().unwrap(), "--lengths", &legs, "--near", "home"]);
    let position = numbers(&near["rows"][0]["near"]["reached"]["p"]);
    assert!(differ(&position, &[10.0, -20.0, 660.0]) < 1e-6, "{near}");
    let short = equipod(&["fk", design.to_str().unwrap(), "--lengths", "0.7,0.8,0.7,0.8,0.7,0.8"]);
    let said = String::from_utf8_lossy(&short.stderr).into_owned();
    assert!(said.contains("in another unit, or travels?"), "{said}");
    let travel = file("t.csv", "ext1,ext2,ext3,ext4,ext5,ext6\n1,2,3,4,5,6\n");
    let refused = asked(&["fk", design.to_str().unwrap(), "--lengths", &travel]);
    assert!(refused["error"]["help"].as_str().unwrap().contains("least length"), "{refused}");
}

#[test]
fn worst_poses_of_a_design_with_frames_name_their_prefix() {
    let (_folder, design) = machine(
        "[frames]\npivot = [0, 0, 50]\n[workspace]\nranges = { x = 5 }\n[hardware]\nleg_length = [500, 1000]\n",
    );
    let said = equipod(&["assess", design.to_str().unwrap()]);
    let said = String::from_utf8_lossy(&said.stderr).into_owned();
    assert!(said.contains("write `base:` before them"), "{said}");
}

#[test]
fn pivot_home_up_and_units_mean_what_they_say() {
    let (_folder, design) = machine("");
    let home = lengths(&design, &[]);
    // nothing moves from home by zeros, about any point
    let still = ["--relative-to", "home", "--pivot", "10,20,300", "--pose", "0,0,0,0,0,0"];
    assert!(differ(&lengths(&design, &still), &home) < 1e-9);
    // a turn about a point of the platform 100 mm above its origin: the origin moves on a circle
    let pivot = ["--relative-to", "home", "--pivot", "0,0,100", "--pose", "0,0,0,0,30,0"];
    let (sin, cos) = 30f64.to_radians().sin_cos();
    let by_hand = format!("{},0,{},0,30,0", -100.0 * sin, 750.0 - 100.0 * cos);
    assert!(differ(&lengths(&design, &pivot), &lengths(&design, &["--pose", &by_hand])) < 1e-9);
    // y up: the height is the second number, and yaw the second angle
    let up = lengths(&design, &["--up", "y", "--pose", "30,700,20,0,15,0"]);
    assert!(differ(&up, &lengths(&design, &["--pose", "30,-20,700,0,0,15"])) < 1e-9);
    let radians = lengths(&design, &["--angle-unit", "rad", "--pose", "0,0,650,0,0,0.5"]);
    let degrees = format!("0,0,650,0,0,{}", 0.5f64.to_degrees());
    assert!(differ(&radians, &lengths(&design, &["--pose", &degrees])) < 1e-9);
    let last = lengths(&design, &["--quaternion", "xyzw", "--pose", "0,0,650,0.6,0,0,0.8"]);
    assert_eq!(last, lengths(&design, &["--pose", "0,0,650,0.8,0.6,0,0"]));
    // a pose in the usual convention, whatever is stated
    let plain = lengths(&design, &["--relative-to", "home", "--up", "y", "--pose", "base:0,0,650,0,0,0"]);
    assert_eq!(plain, home);
}

#[test]
fn poses_that_fk_finds_give_their_lengths_back_in_every_convention() {
    let conventions: [&[&str]; 6] = [
        &[],
        &["--rotation-order", "moving-zxz", "--angle-unit", "rad"],
        &["--rotation-order", "fixed-yxz", "--relative-to", "home", "--pivot", "0,0,120"],
        &["--up", "y", "--rotation-order", "pi", "--quaternion", "xyzw"],
        &["--rotation-order", "vector", "--up", "y", "--relative-to", "home"],
        &["--rotation-order", "moving-xyz", "--pivot", "5,-6,7", "--up", "y", "--angle-unit", "rad"],
    ];
    let design = "designs/rbt-octahedral.toml";
    for words in conventions {
        let doc = asked(&[&["fk", design], words].concat());
        let asked_for = lengths(Path::new(design), &[]);
        let given = asked(&["fk", design]);
        let all = doc["solutions"].as_array().unwrap();
        let real: Vec<&Value> = all.iter().filter(|s| s["real"] == true).collect();
        assert_eq!(doc["real_count"], given["real_count"]);
        assert!(!real.is_empty() && asked_for.len() == 6);
        for solution in real {
            let written = &solution["real_pose"]["in_frames"];
            let text = |rotation: &Value| {
                let all = [numbers(&written["position"]), numbers(rotation)].concat();
                format!("--pose={}", all.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(","))
            };
            for rotation in [&written["angles"], &written["quaternion"]] {
                let pose = text(rotation);
                let found = lengths(Path::new(design), &[&[pose.as_str()], words].concat());
                let p = numbers(&solution["p"]["re"]);
                let back = asked(&[&["ik", design, &pose], words].concat());
                assert!(differ(&numbers(&back["pose"]["p"]), &p) < 1e-9, "{words:?} {pose}");
                assert!(found.iter().all(|l| l.is_finite()));
            }
        }
    }
}

#[test]
fn tables_that_commands_write_are_read_in_the_same_convention() {
    let (folder, design) = machine(
        "[frames]\nrotation_order = \"moving-xyz\"\npivot = [0.0, 0.0, 80.0]\nrelative_to = \"home\"\nangles = \"rad\"\nquaternion = \"xyzw\"\n",
    );
    let name = design.to_str().unwrap();
    let out = equipod(&["fk", name, "--lengths", &PI_LENGTHS.map(|l| l.to_string()).join(","), "--csv"]);
    let text = String::from_utf8(out.stdout).unwrap();
    assert!(
        text.starts_with("pose,nearest_home,mode,x_mm,y_mm,z_mm,rx_rad,ry_rad,rz_rad,qx,qy,qz,qw,"),
        "{text}"
    );
    let table = folder.path().join("poses.csv");
    std::fs::write(&table, &text).unwrap();
    let rows = asked(&["ik", name, table.to_str().unwrap()]);
    let rows = rows["rows"].as_array().unwrap();
    assert!(rows.len() >= 2);
    for row in rows {
        assert!(differ(&numbers(&row["lengths"]), &PI_LENGTHS) < 1e-6, "{row}");
    }
    // the first row is the pose of the machine
    assert_eq!(text.lines().nth(1).unwrap().split(',').nth(1), Some("true"), "{text}");
}

#[test]
fn frames_of_a_design_are_read_saved_scaled_and_checked() {
    let (folder, design) =
        machine("[frames]\nrotation_order = \"moving-xyz\"\npivot = [0.0, 0.0, 80.0]\nup = \"y\"\n");
    let inches = folder.path().join("inches.toml");
    let words =
        ["design", "convert", design.to_str().unwrap(), "--units", "in", "-o", inches.to_str().unwrap()];
    assert_eq!(equipod(&words).status.code(), Some(0));
    let text = std::fs::read_to_string(&inches).unwrap();
    assert!(text.contains("[frames]") && text.contains("rotation_order = \"moving-xyz\""), "{text}");
    let doc = asked(&["ik", inches.to_str().unwrap()]);
    let pivot = numbers(&doc["frames"]["pivot"]);
    assert!((pivot[2] - 80.0 / 25.4).abs() < 1e-12, "{doc}");
    for (line, code) in [
        ("rotation_order = \"xyz\"", "design::wrong_type"),
        ("up = \"x\"", "design::wrong_type"),
        ("rotation_orders = \"pi\"", "design::unknown_key"),
        ("pivot = [0, 0]", "design::coordinate_count"),
    ] {
        let (_kept, bad) = machine(&format!("[frames]\n{line}\n"));
        let refused = asked(&["ik", bad.to_str().unwrap()]);
        let found = &refused["error"]["violations"][0]["code"];
        assert!(code.ends_with(found.as_str().unwrap()) || found == code, "{line}: {refused}");
    }
}

#[test]
fn a_half_angle_at_its_end_is_called_one_of_many() {
    let (_folder, design) = machine("");
    let doc = asked(&["ik", design.to_str().unwrap(), "--pose", "0,0,650,20,90,0"]);
    assert_eq!(doc["in_frames"]["angles_unique"], false, "{doc}");
    let doc = asked(&["ik", design.to_str().unwrap(), "--pose", "0,0,650,20,60,0"]);
    assert_eq!(doc["in_frames"]["angles_unique"], true);
}

#[test]
fn ranges_are_those_of_the_numbers_of_the_convention() {
    let bench = "designs/presets/bench-l16.toml";
    let words = ["--rotation-order", "pi", "--relative-to", "home", "--pivot", "0,0,40"];
    let doc = asked(&[&["limits", bench], &words[..]].concat());
    let axes = doc["axes"].as_array().unwrap();
    let names: Vec<&str> = axes.iter().map(|a| a["axis"].as_str().unwrap()).collect();
    assert_eq!(names, ["x", "y", "z", "rx", "ry", "rz"]);
    for (k, axis) in axes.iter().enumerate() {
        for (way, sign) in [("back", -1.0), ("forth", 1.0)] {
            let free = axis[way]["free"].as_f64().unwrap();
            assert!(free > 0.0 && !axis[way]["binds"].is_null(), "{axis}");
            // inside is allowed, beyond is not
            for (share, meant) in [(1.0 - 1e-6, true), (1.0 + 1e-6, false)] {
                let mut pose = [0.0; 6];
                pose[k] = sign * free * share;
                let text = format!("--at={}", pose.map(|x| x.to_string()).join(","));
                let there = asked(&[&["limits", bench, &text], &words[..]].concat());
                assert_eq!(there["allowed"], meant, "{axis} {way}");
            }
        }
    }
    // about the platform origin the turns are others
    let origin = asked(&["limits", bench]);
    assert_ne!(origin["axes"][3]["forth"]["free"], axes[3]["forth"]["free"]);
}

#[test]
fn calibrations_read_measurements_in_the_convention_of_the_table() {
    let design = "designs/symmetric-hexapod.toml";
    let text = std::fs::read_to_string("designs/tables/calibration.csv").unwrap();
    let folder = tempfile::tempdir().unwrap();
    let copied = folder.path().join("measured.csv");
    std::fs::write(&copied, &text).unwrap();
    let usual = asked(&["calibrate", design, copied.to_str().unwrap()]);
    // the same rotations as angles about moving axes, in their order and without names of columns
    let row = |line: &str| {
        let mut cells: Vec<&str> = line.split(',').collect();
        cells[3..6].reverse();
        cells.join(",") + "\n"
    };
    let moved: String = text.lines().skip(1).map(row).collect();
    let table = folder.path().join("moved.csv");
    std::fs::write(&table, &moved).unwrap();
    let words = ["calibrate", design, table.to_str().unwrap(), "--rotation-order", "moving-zyx"];
    let other = asked(&words);
    assert_eq!(other["outcome"], usual["outcome"], "{other}");
    assert_eq!(other["calibration"]["residuals"], usual["calibration"]["residuals"]);
    assert_eq!(other["frames"]["rotation_order"], "moving-zyx");
    // poses to measure next are told in the same convention
    let next = &other["next_poses"][0];
    let (mut own, usual) = (numbers(&next["in_frames"]["angles"]), numbers(&next["rpy_deg"]));
    own.reverse();
    assert!(differ(&own, &usual) < 1e-9, "{next}");
}

/// Programs write the scalar of a quaternion first or last, so an answer states which order was read.
#[test]
fn the_order_of_seven_numbers_is_stated_once() {
    let design = "designs/symmetric-hexapod.toml";
    let notes = |more: &[&str]| {
        let out = equipod(&[&["ik", design, "--quiet"], more].concat());
        assert_eq!(out.status.code(), Some(0), "{more:?}");
        String::from_utf8(out.stderr).unwrap()
    };
    let first = "The seven numbers of --pose were read as x, y, z, qw, qx, qy, qz.\n";
    let last = "The seven numbers of --pose were read as x, y, z, qx, qy, qz, qw.\n";
    let turned = ["--pose", "0,0,350,0.8,0,0,0.6"];
    assert_eq!(notes(&turned), first);
    assert_eq!(notes(&[turned, ["--pose", "0,0,360,1,0,0,0"]].concat()), first);
    assert!(notes(&[turned, ["--quaternion", "xyzw"]].concat()).contains(last));
    let own = ["--pose", "base:0,0,350,0.8,0,0,0.6", "--quaternion", "xyzw"];
    assert!(notes(&own).contains(first));
    assert_eq!(notes(&["--pose", "0,0,350,0,0,10"]), "");
    let locus = equipod(&["singular", "locus", design, "--pose", "0,0,350,1,0,0,1/2"]);
    assert_eq!(String::from_utf8(locus.stderr).unwrap(), first);
    let asked = |order: &str| asked(&["ik", design, "--pose", turned[1], "--quaternion", order]);
    for order in ["wxyz", "xyzw"] {
        assert_eq!(asked(order)["frames"]["quaternion"], order);
    }
}
