//! The process `equipod optimize`: exit codes, the JSON record, the design it writes.

use std::collections::BTreeSet;
use std::process::{Command, Output};

use serde_json::Value;

use crate::octahedral::{DESIGN, at_home, required};

fn optimize(design: &str, more: &[&str]) -> (Output, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("in.toml"), design).unwrap();
    let out = Command::new(env!("CARGO_BIN_EXE_equipod"))
        .current_dir(folder.path())
        .args(["optimize", "in.toml", "--json"])
        .args(more)
        .output()
        .unwrap();
    (out, folder)
}

fn document(out: &Output) -> Value {
    serde_json::from_slice(&out.stdout).unwrap()
}

#[test]
fn inside_the_edges_the_optimum_is_written_as_a_design_that_reads_back() {
    let (out, folder) = optimize(DESIGN, &["--extension", "0", "-o", "out.toml"]);
    assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stderr));
    let d = document(&out);
    assert_eq!(d["status"], "optimal");
    assert_eq!(d["branch_counts"]["total"], 729);
    assert_eq!(d["branch_counts"]["feasible"], 1);
    assert_eq!(d["branches"].as_array().unwrap().len(), 729);
    assert!(d["search"]["conic_programs"].as_u64().unwrap() > 10);
    let (upper, value) = (d["global_bound"]["upper"].as_f64().unwrap(), d["objective"].as_f64().unwrap());
    let held = d["objectives"][0]["at_held_poses"].as_f64().unwrap();
    assert!(value <= held && held <= upper && upper < 1.03 * held, "{upper} {held} {value}");
    for margin in ["abs_det", "bounds"] {
        assert!(d["search_margins"][margin].as_f64().unwrap() >= 0.0, "{margin}");
    }
    let margins = d["constraint_margins"].as_array().unwrap();
    for name in ["base_spacing", "platform_spacing"] {
        let m = margins.iter().find(|m| m["name"] == name).unwrap();
        assert!(m["met"] == true && m["margin"].as_f64().unwrap() > -1e-12, "{m}");
    }
    let text = std::fs::read_to_string(folder.path().join("out.toml")).unwrap();
    let (design, warnings) =
        equipod::methods::design::parse(&text, equipod::methods::design::Format::Toml).unwrap();
    assert!(warnings.is_empty());
    assert_eq!(design.manipulator().base_joints().len(), 6);
    // s' = A s + c at a pose, on the design as written
    let (source, _) =
        equipod::methods::design::parse(DESIGN, equipod::methods::design::Format::Toml).unwrap();
    let pose = equipod::methods::manipulator::default_home(source.manipulator());
    let (s, new) = (pose.squared_lengths(source.manipulator()), pose.squared_lengths(design.manipulator()));
    let (s, new) = (s.unwrap().get(), new.unwrap().get());
    for i in 0..6 {
        let row = d["A"][i].as_array().unwrap();
        let mapped: f64 = (0..6).map(|j| row[j].as_f64().unwrap() * s[j]).sum();
        assert!((mapped + d["c"][i].as_f64().unwrap() - new[i]).abs() < 1e-9, "leg {i}");
    }
}

#[test]
fn an_impossible_joint_distance_is_infeasible_with_the_reason() {
    let design = format!("{DESIGN}\n[optimize]\nmin_joint_distance = 6.5\n");
    let (out, folder) = optimize(&design, &["-o", "out.toml"]);
    assert_eq!(out.status.code(), Some(1));
    let d = document(&out);
    assert_eq!(d["status"], "infeasible");
    assert_eq!(d["branch_counts"]["infeasible_spacing"], 729);
    assert_eq!(d["search"]["conic_programs"], 0, "vertices are too close: nothing to solve");
    let conflict = &d["conflict"];
    assert_eq!((&conflict["proved"], &conflict["reasons"][0]["branches"]), (&true.into(), &729.into()));
    assert_eq!(d["branches"][0]["conflicts"][0]["code"], "vertices_too_close");
    assert!(!folder.path().join("out.toml").exists());
}

#[test]
fn offsets_of_a_design_that_is_not_octahedral_are_refused() {
    let design = DESIGN.replace(r#"["P1","P6"]"#, r#"["P2","P6"]"#);
    let (out, _folder) = optimize(&format!("{design}\n[optimize]\nvariables = [\"offsets\"]\n"), &[]);
    assert_eq!(out.status.code(), Some(2));
    assert_eq!(document(&out)["error"]["code"], "optimize::not_octahedral");
}

#[test]
#[ignore = "evidence"]
fn requirements_are_met_by_the_optimised_design_and_assess_agrees() {
    let more = "[hardware]
leg_length = [9.0, 18.0]
base_cone_angle_deg = 60.0
[optimize]
variables = [\"symmetric_offsets\", \"home_height\"]
";
    let (out, folder) = optimize(&required(more), &["-o", "out.toml"]);
    assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stdout));
    let d = document(&out);
    assert_eq!((d["status"].as_str(), d["requirements_met"].as_bool()), (Some("best_found"), Some(true)));
    assert_eq!(d["verify"]["verdict"], "equivalent");
    assert!(d["objective"].as_f64().unwrap() > 0.0);
    let margins = d["constraint_margins"].as_array().unwrap();
    assert!(margins.iter().any(|m| m["name"] == "max_leg_length"));
    assert!(margins.iter().all(|m| m["margin"].as_f64().unwrap() >= 0.0));
    let checked = Command::new(env!("CARGO_BIN_EXE_equipod"))
        .current_dir(folder.path())
        .args(["assess", "out.toml", "--points", "200"])
        .output()
        .unwrap();
    assert_eq!(checked.status.code(), Some(0));
}

#[test]
#[ignore = "evidence"]
fn a_conflict_ends_with_exit_1_and_says_who_would_have_to_give() {
    let more = "[hardware]
leg_length = [14.0, 14.1]
[optimize]
variables = [\"home_height\"]
";
    let (out, folder) = optimize(&required(more), &["-o", "out.toml", "--candidates", "opened"]);
    assert_eq!(out.status.code(), Some(1), "{}", String::from_utf8_lossy(&out.stdout));
    let d = document(&out);
    assert_eq!(d["status"], "infeasible");
    // which freedom resolves it was tried: other sizes do not, a longer stroke does, as its design shows
    let freedoms = d["freedoms"].as_array().unwrap();
    let came =
        |k: usize| (freedoms[k]["freedom"].as_str().unwrap(), freedoms[k]["outcome"].as_str().unwrap());
    assert_eq!((came(0), came(1)), (("triangle_sizes", "unresolved"), ("stroke", "resolved")));
    assert!(freedoms[0]["design"].is_null() && freedoms[1]["assessment"]["met"] == true);
    let amount = freedoms[1]["amount"].as_f64().unwrap();
    assert!(freedoms[1]["message"].as_str().unwrap().starts_with("with a stroke longer by "));
    let opened = std::fs::read_to_string(folder.path().join("opened/with-stroke.toml")).unwrap();
    let range = opened.lines().find(|l| l.starts_with("leg_length")).unwrap();
    let ends: Vec<f64> = range[14..range.len() - 1].split(',').map(|x| x.trim().parse().unwrap()).collect();
    assert!((ends[1] - ends[0] - 0.1 - amount).abs() < 1e-9, "{range} {amount}");
    let assessed = |file: &str| {
        let mut assess = Command::new(env!("CARGO_BIN_EXE_equipod"));
        assess.current_dir(folder.path()).args(["assess", file]).output().unwrap().status.code()
    };
    assert_eq!(assessed("opened/with-stroke.toml"), Some(0));
    // the nearest design is shown with its violations, and written
    let nearest = &d["nearest"];
    assert_eq!(nearest["variables"][0]["name"], "home height");
    assert_eq!(nearest["assessment"]["met"], false);
    assert!(d["design"].is_null() && d["output"] == "out.toml");
    assert_eq!(assessed("out.toml"), Some(1));
    let codes: Vec<&str> = d["conflict"]["requirements"]
        .as_array()
        .unwrap()
        .iter()
        .map(|r| r["name"].as_str().unwrap())
        .collect();
    assert_eq!(codes, ["min_leg_length", "max_leg_length"]);
    assert!(d["conflict"]["requirements"][1]["alone"].as_f64().unwrap() > 0.0);
}

/// Conflicts are about requirements of the design: a least `|det A|` without a requirement would add 4.85 mm to the
/// longest leg.
#[test]
#[ignore = "evidence"]
fn a_conflict_is_about_what_was_asked_for() {
    let design = std::fs::read_to_string("tests/fixtures/verdicts/unasked-determinant.toml").unwrap();
    let (out, _folder) = optimize(&design, &[]);
    assert_eq!(out.status.code(), Some(1), "{}", String::from_utf8_lossy(&out.stdout));
    let d = document(&out);
    let requirements = d["conflict"]["requirements"].as_array().unwrap();
    let names: Vec<&str> = requirements.iter().map(|r| r["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["min_leg_length", "max_leg_length"]);
    let alone = requirements[1]["alone"].as_f64().unwrap();
    assert!((alone - 28.194).abs() < 0.01, "{alone}");
}

/// Each candidate is a file that `assess` assesses as the answer says; with other values than the answer, and without the
/// option there are none.
#[test]
#[ignore = "evidence"]
fn other_local_optima_are_assessed_and_written_when_they_are_asked_for() {
    let more = "[hardware]
leg_length = [9.0, 18.0]
base_cone_angle_deg = 60.0
[optimize]
variables = [\"offsets\"]
";
    let (out, folder) = optimize(&required(more), &["-o", "out.toml", "--candidates", "all"]);
    let d = document(&out);
    let candidates = d["candidates"].as_array().unwrap();
    assert!(!candidates.is_empty(), "a platform with six offsets has more than one optimum");
    let first = std::fs::read_to_string(folder.path().join("all/candidate-1.toml")).unwrap();
    assert_eq!(first, std::fs::read_to_string(folder.path().join("out.toml")).unwrap());
    let mut values = vec![d["objectives"][0]["at_held_poses"].as_f64().unwrap()];
    for (k, c) in candidates.iter().enumerate() {
        let path = c["output"].as_str().unwrap();
        assert_eq!(path, format!("all/candidate-{}.toml", k + 2));
        values.push(c["objectives"][0]["at_held_poses"].as_f64().unwrap());
        let assessed = Command::new(env!("CARGO_BIN_EXE_equipod"))
            .current_dir(folder.path())
            .args(["assess", path, "--json"])
            .output()
            .unwrap();
        assert_eq!(document(&assessed)["met"], c["assessment"]["met"], "{path}");
    }
    assert!(values.windows(2).all(|v| v[0] > v[1]), "{values:?}");
    let (out, _) = optimize(&required(more), &[]);
    assert!(document(&out)["candidates"].is_null());
}

/// A search of many seconds: offsets, triangles and height under many requirements.
fn long_search() -> String {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/designs/worked/simulator-octahedral.toml");
    std::fs::read_to_string(file).unwrap()
}

#[test]
#[ignore = "evidence"]
fn a_limit_of_time_ends_a_search_with_what_it_has() {
    let (out, _folder) = optimize(&long_search(), &["--time-limit", "0.2"]);
    assert_eq!(out.status.code(), Some(3), "{}", String::from_utf8_lossy(&out.stderr));
    assert_eq!(document(&out)["status"], "interrupted");
    for wrong in ["0", "-1", "soon", "nan", "inf"] {
        let (out, _folder) = optimize(DESIGN, &[&format!("--time-limit={wrong}")]);
        assert_eq!(out.status.code(), Some(2), "{wrong}");
    }
}

#[cfg(target_os = "linux")]
#[test]
#[ignore = "evidence"]
fn a_request_to_terminate_ends_a_search_with_what_it_has() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("in.toml"), long_search()).unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_equipod"))
        .current_dir(folder.path())
        .args(["optimize", "in.toml", "--json", "--history", "steps.csv"])
        .stdout(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    // the kernel says when the process has a handler for the signal
    let status = format!("/proc/{}/status", child.id());
    let is_caught = |text: &str| {
        let mask = text.lines().find_map(|l| l.strip_prefix("SigCgt:")).map(str::trim);
        mask.and_then(|m| u64::from_str_radix(m, 16).ok()).is_some_and(|m| m >> 14 & 1 == 1)
    };
    while std::fs::read_to_string(&status).is_ok_and(|text| !is_caught(&text)) {
        assert!(child.try_wait().unwrap().is_none(), "it ended before it could be asked to");
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    Command::new("kill").arg(child.id().to_string()).status().unwrap();
    let out = child.wait_with_output().unwrap();
    assert_eq!(out.status.code(), Some(3));
    assert_eq!(document(&out)["status"], "interrupted");
}

/// Both triangles equilateral, one above the other.
const EQUILATERAL: &str = r#"
name = "equilateral"
units = "mm"
legs = [["P1","P4"], ["P2","P4"], ["P2","P5"], ["P3","P5"], ["P3","P6"], ["P1","P6"]]
[base]
P1 = { radius = 10, angle_deg = 0 }
P2 = { radius = 10, angle_deg = 120 }
P3 = { radius = 10, angle_deg = 240 }
[platform]
P4 = { radius = 6, angle_deg = 60 }
P5 = { radius = 6, angle_deg = 180 }
P6 = { radius = 6, angle_deg = 300 }
[home]
position = [0.0, 0.0, 9.0]
rpy_deg = [0.0, 0.0, 0.0]
[workspace]
translation = [0.5, 0.5, 0.5]
[hardware]
leg_length = [4.0, 30.0]
[optimize]
variables = ["offsets", "triangles"]
"#;

#[test]
#[ignore = "evidence"]
fn three_fold_symmetry_is_kept_or_refused() {
    let equilateral = EQUILATERAL;
    let (out, _folder) = optimize(&format!("{equilateral}symmetry = \"three_fold\"\n"), &[]);
    assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stdout));
    let d = document(&out);
    let t: Vec<f64> = (0..6).map(|k| d["offsets"][k].as_f64().unwrap()).collect();
    assert!((0..4).all(|k| t[k].total_cmp(&t[k + 2]).is_eq()), "{t:?}");
    let names: Vec<&str> =
        d["variables"].as_array().unwrap().iter().map(|v| v["name"].as_str().unwrap()).collect();
    assert!(names.contains(&"base size") && names.contains(&"platform size"), "{names:?}");

    // a requested symmetry is no default, and needs no word
    assert!(d["symmetry"].is_null());
    let refused = |text: &str, words: &str| {
        let (out, _folder) = optimize(text, &[]);
        assert_eq!(out.status.code(), Some(2), "{words}");
        let message = document(&out)["error"]["message"].as_str().unwrap().to_owned();
        assert!(message.contains(words), "{message}");
    };
    refused(&format!("{equilateral}symmetry = \"mirror\"\n"), "architecturally singular");
    let aside = equilateral.replace("position = [0.0, 0.0, 9.0]", "position = [0.5, 0.0, 9.0]");
    refused(&format!("{aside}symmetry = \"three_fold\"\n"), "no common axis");
    let uneven = equilateral.replace("radius = 6, angle_deg = 60", "radius = 5, angle_deg = 60");
    refused(&format!("{uneven}symmetry = \"three_fold\"\n"), "not equilateral");
}

/// Offsets in cyclic order.
fn offsets_of(d: &Value) -> Vec<f64> {
    (0..6).map(|k| d["offsets"][k].as_f64().unwrap()).collect()
}

/// The largest difference among the three offsets of a body, over both bodies.
fn unevenness(t: &[f64]) -> f64 {
    (0..4).map(|k| (t[k] - t[k + 2]).abs()).fold(0.0, f64::max)
}

#[test]
#[ignore = "evidence"]
fn three_fold_symmetry_is_the_default_of_a_design_that_has_it_at_home() {
    let design = EQUILATERAL.replace(r#"["offsets", "triangles"]"#, r#"["offsets"]"#);
    let (out, folder) = optimize(&design, &["-o", "out.toml"]);
    assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stdout));
    let d = document(&out);
    assert_eq!((&d["status"], &d["symmetry"]["three_fold"]), (&"best_found".into(), &"kept".into()));
    assert!(d["symmetry"]["message"].as_str().unwrap().contains("symmetry = \"none\" in [optimize]"));
    assert_eq!(d["variables"].as_array().unwrap().len(), 2, "{}", d["variables"]);
    assert!(unevenness(&offsets_of(&d)) < 1e-15);
    // the answer of a person says it too
    let text = Command::new(env!("CARGO_BIN_EXE_equipod"))
        .current_dir(folder.path())
        .args(["optimize", "in.toml", "--time-limit", "0.2"])
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&text.stdout).into_owned();
    assert!(text.contains("three-fold symmetry was kept, because the design has it"), "{text}");
    // the default is no key of the design that is written
    assert!(!std::fs::read_to_string(folder.path().join("out.toml")).unwrap().contains("symmetry"));
}

/// The default is left where the design is not symmetric, names a symmetry, or states holes that do not turn.
#[test]
#[ignore = "evidence"]
fn three_fold_symmetry_is_no_default_where_the_search_cannot_hold_it() {
    let design = EQUILATERAL.replace(r#"["offsets", "triangles"]"#, r#"["offsets"]"#);
    let silent = |text: &str, variables: usize| {
        let (out, _folder) = optimize(text, &[]);
        let d = document(&out);
        assert!(d["symmetry"].is_null(), "{}", d["symmetry"]);
        assert_eq!(d["variables"].as_array().unwrap().len(), variables);
    };
    silent(&format!("{design}symmetry = \"none\"\n"), 6);
    silent(&design.replace("position = [0.0, 0.0, 9.0]", "position = [0.5, 0.0, 9.0]"), 6);
    silent(&design.replace("radius = 6, angle_deg = 60", "radius = 5, angle_deg = 60"), 6);
    silent(&format!("{design}[holes]\npitch = 0.5\n"), 6);
    silent(
        &format!("{design}[holes.base]\npattern = \"polar\"\nfirst_radius = 1\npitch = 1\ncount = 20\n"),
        6,
    );
    // offsets that are equal on each body anyway
    silent(&design.replace(r#"["offsets"]"#, r#"["symmetric_offsets"]"#), 2);
    let turning = format!("{design}[holes]\npattern = \"triangular\"\npitch = 0.5\n");
    let (out, _folder) = optimize(&turning, &[]);
    assert_eq!(document(&out)["symmetry"]["three_fold"], "kept");
}

/// Balls on two sides of the base that leave their joints disjoint ranges: platforms with one offset for both do not
/// exist, others do.
#[test]
#[ignore = "evidence"]
fn the_default_symmetry_is_given_up_where_only_platforms_without_it_meet_the_requirements() {
    let side = 10.0 * 3_f64.sqrt();
    let corner = |k: usize| {
        let a = 120_f64.to_radians() * k as f64;
        [10.0 * a.cos(), 10.0 * a.sin()]
    };
    // on the side from corner k to the next at the share t, so small that the legs at the corners do not touch it
    let ball = |k: usize, t: f64, share: f64| {
        let (a, b) = (corner(k % 3), corner((k + 1) % 3));
        let [x, y] = [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
        format!("[[keep_out]]\nsphere = {{ center = [{x}, {y}, 0.0], diameter = {} }}\n", 2.0 * share * side)
    };
    let design = EQUILATERAL
        .replace(r#"["offsets", "triangles"]"#, "[\"offsets\"]\noffset_bounds = [0.1, 0.4]")
        .replace("leg_length = [4.0, 30.0]", "leg_length = [4.0, 30.0]\nleg_diameter = 0.2");
    // joints of the first side stay above 0.28, those of the second below 0.22
    let design = format!("{design}{}{}", ball(0, 0.18, 0.1), ball(1, 0.32, 0.1));
    let (out, _folder) = optimize(&design, &[]);
    assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stdout));
    let d = document(&out);
    assert_eq!((&d["status"], &d["symmetry"]["three_fold"]), (&"best_found".into(), &"given_up".into()));
    let t = offsets_of(&d);
    assert!(unevenness(&t) > 0.05, "{t:?}");
    let (out, _folder) =
        optimize(&design.replace("[optimize]", "[optimize]\nsymmetry = \"three_fold\""), &[]);
    assert_eq!(out.status.code(), Some(1), "the key is obeyed");
    assert_eq!(document(&out)["status"], "infeasible");
}

const STRUTS: &str = "name,stroke,retracted_length,price_EUR
long,12,8,40
tiny,0.1,14,10
tinier,0.05,14.02,20
good,9,9,30
";

fn drive<'d>(d: &'d Value, name: &str) -> &'d Value {
    let list = d["drive_search"]["drives"].as_array().unwrap();
    list.iter().find(|drive| drive["name"] == name).unwrap()
}

#[test]
#[ignore = "evidence"]
fn the_platform_is_sought_with_the_cheapest_drive_that_meets_the_requirements() {
    let more = "[optimize]\nvariables = [\"symmetric_offsets\", \"home_height\"]\n";
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("in.toml"), required(more)).unwrap();
    std::fs::write(folder.path().join("struts.csv"), STRUTS).unwrap();
    let run = |args: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_equipod"));
        command.current_dir(folder.path()).args(args).output().unwrap()
    };
    let out = run(&["optimize", "in.toml", "--drives", "struts.csv", "--json", "-o", "out.toml"]);
    assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stdout));
    let d = document(&out);
    let search = &d["drive_search"];
    assert_eq!((&search["chosen"], &search["ranked_by"]), (&"good".into(), &"price".into()));
    assert_eq!((&search["currency"], &search["interrupted"]), (&"EUR".into(), &false.into()));
    let came = |name: &str| drive(&d, name)["outcome"].as_str().unwrap().to_owned();
    assert_eq!(
        ["good", "tiny", "tinier", "long"].map(came),
        ["met", "infeasible", "weaker", "dearer"],
        "{search}"
    );
    assert_eq!(search["drives"][0]["name"], "good");
    assert_eq!((&d["status"], &d["requirements_met"]), (&"best_found".into(), &true.into()));
    assert_eq!(drive(&d, "good")["objective"], d["objective"]);
    let why = |name: &str| drive(&d, name)["reason"].as_str().unwrap().to_owned();
    assert!(why("tiny").contains("relax it by"), "{}", why("tiny"));
    assert!(why("tinier").contains("nothing that tiny cannot") && why("long").contains("more than good"));
    assert!(drive(&d, "good")["reason"].is_null());
    // the design written has the drive, and assess accepts it
    let written = std::fs::read_to_string(folder.path().join("out.toml")).unwrap();
    assert!(written.contains("leg_length = [9.0, 18.0]"), "{written}");
    assert_eq!(run(&["assess", "out.toml"]).status.code(), Some(0));
    let ended = run(&["optimize", "in.toml", "--drives", "struts.csv", "--time-limit", "0.2"]);
    let text = String::from_utf8(ended.stdout).unwrap();
    assert_eq!(ended.status.code(), Some(3), "{text}");
    assert!(text.contains("as far as the search came") && text.contains("not_tried"), "{text}");
    // a front is many platforms
    let front =
        required("[optimize]\nobjectives = [\"stroke\", \"worst_conditioning\"]\nmode = \"pareto\"\n");
    std::fs::write(folder.path().join("front.toml"), front).unwrap();
    let out = run(&["optimize", "front.toml", "--drives", "struts.csv", "--json"]);
    assert_eq!((out.status.code(), &document(&out)["error"]["code"]), (Some(2), &"usage::no_effect".into()));
}

#[test]
#[ignore = "evidence"]
fn without_prices_the_objective_decides_between_drives_and_a_limit_of_time_keeps_the_best_so_far() {
    let more = "[optimize]\nvariables = [\"symmetric_offsets\", \"home_height\"]\n";
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("in.toml"), required(more)).unwrap();
    let table = "name,stroke,retracted_length\nshort,4,11\ngood,9,9\nlong,12,8\n";
    std::fs::write(folder.path().join("struts.csv"), table).unwrap();
    let run = |more: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_equipod"));
        command.current_dir(folder.path()).args(["optimize", "in.toml", "--drives", "struts.csv", "--json"]);
        command.args(more).output().unwrap()
    };
    let out = run(&[]);
    let d = document(&out);
    assert_eq!(d["drive_search"]["ranked_by"], "objective");
    let values: Vec<f64> =
        ["long", "good", "short"].iter().filter_map(|n| drive(&d, n)["objective"].as_f64()).collect();
    assert!(values.len() >= 2 && values.iter().all(|v| *v <= d["objective"].as_f64().unwrap()), "{values:?}");
    // a longer drive allows no smaller value
    assert!(values[0] >= values[1] - 1e-6, "{values:?}");
    let out = run(&["--time-limit", "0.05"]);
    let d = document(&out);
    assert_eq!((out.status.code(), &d["status"]), (Some(3), &"interrupted".into()));
    assert_eq!(d["drive_search"]["interrupted"], true);
    assert_eq!(drive(&d, "short")["outcome"], "not_tried");
}

/// The freedoms are tried as for a single platform when no design meets the requirements, so that there is no front.
#[test]
#[ignore = "evidence"]
fn a_front_that_does_not_exist_names_the_freedom_that_resolves_it() {
    let more = "[hardware]
leg_length = [14.0, 14.1]
[optimize]
variables = [\"symmetric_offsets\", \"home_height\"]
objectives = [\"worst_conditioning\", \"joint_spacing\"]
mode = \"pareto\"
points = 2
";
    let (out, _folder) = optimize(&required(more), &[]);
    assert_eq!(out.status.code(), Some(1), "{}", String::from_utf8_lossy(&out.stdout));
    let d = document(&out);
    assert_eq!(d["status"], "infeasible");
    let freedoms = d["freedoms"].as_array().unwrap();
    let stroke = freedoms.iter().find(|f| f["freedom"] == "stroke").unwrap();
    assert_eq!((&stroke["outcome"], &stroke["assessment"]["met"]), (&"resolved".into(), &true.into()));
}

#[test]
fn a_slip_in_the_name_of_a_variable_is_refused_with_the_nearest_one() {
    let (out, _folder) = optimize(&required("[optimize]\nvariables = [\"ofsets\"]\n"), &[]);
    assert_eq!(out.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&out.stdout).contains("offsets"));
}

#[test]
fn a_design_whose_legs_cannot_move_has_its_sizes_chosen() {
    // without variables its legs are to move along families, and it has none that is rational
    let design = concat!(env!("CARGO_MANIFEST_DIR"), "/designs/symmetric-hexapod.toml");
    let few = ["optimize", design, "--time-limit", "3"];
    let out = Command::new(env!("CARGO_BIN_EXE_equipod")).args(few).output().unwrap();
    // found, or interrupted by the limit
    assert!(matches!(out.status.code(), Some(0 | 3)), "{}", out.status);
    let text = String::from_utf8_lossy(&out.stdout);
    assert!(text.contains("no leg of the design can be replaced") && text.contains("home height"), "{text}");
}

/// The worst-case inverse condition number of a 6-4 platform with legs 1 to 4 moved along their point-line families.
/// Both platform joints that two legs share stay shared: the families of this platform keep them.
#[test]
#[ignore = "evidence"]
fn a_shipped_6_4_platform_is_improved_within_its_replaceable_legs() {
    let file = format!("{}/designs/innocenti-6-4.toml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(file).unwrap();
    let asked = "[workspace]\ntranslation = [0.05, 0.05, 0.05]\nrotation_deg = [1.0, 1.0, 1.0]\n";
    let search = "[optimize]\nvariables = [\"components\"]\nmin_joint_distance = 0.8\n";
    let (out, folder) = optimize(&format!("{text}\n{asked}{search}"), &["-o", "out.toml"]);
    assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stderr));
    let d = document(&out);
    // joints on curves are doubles, equivalent to within rounding, which no map proves
    assert_eq!((&d["status"], &d["verify"]["verdict"]), (&"best_found".into(), &"inconclusive".into()));
    assert!(d["verify"]["worst_distance"].as_f64().unwrap() < 1e-12, "{}", d["verify"]);
    assert_eq!(d["variables"].as_array().unwrap().len(), 4);
    let read =
        |text: &str| equipod::methods::design::parse(text, equipod::methods::design::Format::Toml).unwrap().0;
    let (old, new) = (read(&text), read(&std::fs::read_to_string(folder.path().join("out.toml")).unwrap()));
    // worst over the corners of the region, from the public Jacobian
    let worst = |design: &equipod::methods::design::Design| {
        let m = design.manipulator();
        let scale = old.manipulator().platform_rms_radius();
        let at = |c: usize| {
            let side = |k: usize| if c >> k & 1 == 0 { -1.0 } else { 1.0 };
            let turn = nalgebra::Vector3::from_fn(|k, _| side(k) * 1f64.to_radians());
            let position = nalgebra::Vector3::from_fn(|k, _| side(k + 3) * 0.05);
            let pose = equipod::methods::geom::Pose { rotation: nalgebra::Rotation3::new(turn), position };
            equipod::methods::manipulator::inverse_condition(&equipod::methods::manipulator::jacobian(
                m, &pose, scale,
            ))
        };
        (0..64).map(at).fold(f64::INFINITY, f64::min)
    };
    let objective = d["objective"].as_f64().unwrap();
    assert!(worst(&new) >= objective - 1e-9, "{} {objective}", worst(&new));
    assert!(worst(&old) < 0.95 * objective, "{} {objective}", worst(&old));
}

/// Version 0.1.0 called the first three infeasible, though each has offsets that meet all limits in exact arithmetic.
/// It "proved" a bound of 0.22362 for the last, where offsets reach 0.24124.
#[test]
#[ignore = "evidence"]
fn problems_that_leave_next_to_nothing_are_never_infeasible_and_bounds_hold() {
    let cases =
        [("inf-ordinary", "0", 0.0), ("inf-small", "1", 0.0), ("inf-tie", "1", 0.0), ("bound", "0", 0.24124)];
    for (name, extension, reached) in cases {
        let file = format!("{}/tests/fixtures/adversarial/optimize-{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let (out, _folder) =
            optimize(&std::fs::read_to_string(file).unwrap(), &["--extension", extension, "--gap", "0.1"]);
        let d = document(&out);
        assert!(matches!(out.status.code(), Some(0 | 3)), "{name}: {:?} {}", out.status.code(), d["status"]);
        assert_ne!(d["status"], "infeasible", "{name}");
        if let Some(upper) = d["global_bound"]["upper"].as_f64() {
            assert!(upper >= reached, "{name}: {upper}");
        }
        if d["status"] == "optimal" {
            assert!(d["global_bound"]["gap"].as_f64().unwrap() <= 0.1, "{name}");
        }
    }
}

/// The fields of an answer, without those that every document has.
fn fields(d: &Value) -> BTreeSet<String> {
    let all = d.as_object().unwrap().keys().cloned();
    all.filter(|key| !["schema_version", "provenance", "warnings"].contains(&key.as_str())).collect()
}

/// Both searches, a front, and answers without a platform: the same fields, those that the schema requires, null where
/// they do not apply.
#[test]
#[ignore = "evidence"]
fn the_answers_of_both_searches_have_the_fields_of_one_schema() {
    let schema =
        Command::new(env!("CARGO_BIN_EXE_equipod")).args(["design", "schema", "optimize"]).output().unwrap();
    let schema: serde_json::Map<String, Value> = serde_json::from_slice(&schema.stdout).unwrap();
    // one object with one list of required fields, and no choice between shapes
    let own = &schema["$defs"]["optimize"];
    assert!(own["anyOf"].is_null() && own["oneOf"].is_null(), "{own}");
    let required_fields: BTreeSet<String> =
        own["required"].as_array().unwrap().iter().map(|f| f.as_str().unwrap().to_owned()).collect();
    let checked = |design: &str, more: &[&str]| {
        let d = document(&optimize(design, more).0);
        let known = ["schema_version", "provenance", "warnings"].map(str::to_owned);
        let found: BTreeSet<String> = fields(&d).into_iter().chain(known).collect();
        assert_eq!(found, required_fields);
        d
    };
    let offsets = "[hardware]\nleg_length = [9.0, 18.0]\n[optimize]\nvariables = [\"symmetric_offsets\"]\n";
    let alone = checked(&at_home(), &["--extension", "0"]);
    let under = checked(&required(offsets), &["--extension", "0"]);
    // a result without a proof is not called optimal
    for (d, method, word) in [(&alone, "offsets", "optimal"), (&under, "dimensional", "best_found")] {
        assert_eq!((&d["status"], &d["search"]["method"]), (&word.into(), &method.into()), "{d}");
        let (value, held) = (d["objective"].as_f64().unwrap(), d["objectives"][0]["at_held_poses"].as_f64());
        assert!(value > 0.0 && value <= held.unwrap(), "{value} {held:?}");
        assert_eq!(d["objectives"][0]["name"], "worst_conditioning");
        // the chosen variables and their starts: joints at the corners slide to t
        let chosen = d["variables"].as_array().unwrap();
        for v in chosen {
            let of = |key: &str| v[key].as_f64().unwrap();
            assert!(of("start") == 0.0 && of("value") > 0.0 && of("value") < 1.0, "{v}");
            assert_eq!(v["bounds"], serde_json::json!([0.0, 1.0]), "{v}");
        }
        assert_eq!((&chosen[0]["name"], &chosen[0]["value"]), (&"t1".into(), &d["offsets"][0]));
        // shifts are offsets times edges, and the leg map takes the lengths of the design to those of the platform
        for i in 0..6 {
            let of = |key: &str| d[key][i].as_f64().unwrap();
            assert!((of("shifts") - of("offsets") * of("edge_lengths")).abs() < 1e-12);
        }
        assert_eq!(d["branch"], "000000");
        let a = |i: usize, j: usize| d["A"][i][j].as_f64().unwrap();
        let determinant = nalgebra::Matrix6::from_fn(a).determinant();
        assert!((determinant - d["det"].as_f64().unwrap()).abs() < 1e-9 * determinant.abs());
        assert_eq!((&d["verify"]["verdict"], &d["requirements_met"]), (&"equivalent".into(), &true.into()));
        for margin in ["abs_det", "bounds"] {
            assert!(d["search_margins"][margin].as_f64().unwrap() > -1e-9, "{margin}");
        }
        let margins = d["constraint_margins"].as_array().unwrap();
        assert!(margins.iter().all(|m| m["met"] == true) && !margins.is_empty());
        assert!(d["worst_pose"]["index"].as_u64().unwrap() < d["poses"]["held"].as_u64().unwrap());
        let step = &d["history"][0];
        assert!(step["objective"].is_number() && step["poses"].is_u64() && step["accepted"].is_boolean());
        assert!(d["conflict"].is_null() && d["nearest"].is_null() && d["front"].is_null());
    }
    assert_eq!(
        (&alone["optimality"], &under["optimality"]),
        (&"proved_within_gap".into(), &"best_of_starts".into())
    );
    assert!(
        alone["global_bound"].is_object() && under["global_bound"].is_null() && under["tolerance"].is_null()
    );
    assert!(alone["assessment"].is_null() && under["assessment"]["met"] == true);
    // the platform of the search for offsets has no other judge than that under requirements
    assert!(alone["search"]["starts"].is_null() && under["search"]["starts"].as_u64().unwrap() > 0);
    // answers without a platform, of both, and a front
    let nowhere = checked(&format!("{DESIGN}\n[optimize]\nmin_joint_distance = 6.5\n"), &[]);
    let short = checked(&required(&offsets.replace("9.0, 18.0", "14.0, 14.1")), &["--extension", "0"]);
    for d in [&nowhere, &short] {
        assert_eq!((&d["status"], d["conflict"].is_object()), (&"infeasible".into(), true), "{d}");
        for field in ["objective", "variables", "offsets", "constraint_margins", "assessment", "optimality"] {
            assert!(d[field].is_null(), "{field}");
        }
    }
    assert!(nowhere["nearest"].is_null() && short["nearest"]["assessment"]["met"] == false);
    let front = "[optimize]\nvariables = [\"symmetric_offsets\"]\nobjectives = [\"stroke\", \"worst_conditioning\"]\nmode = \"pareto\"\npoints = 2\n";
    let front = checked(&required(front), &["--extension", "0"]);
    let members = front["front"].as_array().unwrap();
    assert!(front["objective"].is_null() && members.len() >= 2, "{front}");
    // a member has the fields of a platform
    for key in
        ["objective", "objectives", "variables", "constraint_margins", "assessment", "verify", "history"]
    {
        assert!(members[0].as_object().unwrap().contains_key(key), "{key}");
    }
}

/// A symmetric design whose joints stand on plates.
fn on_plates(tables: &str, variables: &str) -> String {
    format!(
        r#"name = "on plates"
units = "mm"
legs = [["A1", "B1"], ["A2", "B1"], ["A2", "B2"], ["A3", "B2"], ["A3", "B3"], ["A1", "B3"]]
[base]
A1 = {{ radius = 150, angle_deg = 90 }}
A2 = {{ turn = "A1", deg = 120 }}
A3 = {{ turn = "A1", deg = 240 }}
[platform]
B1 = {{ radius = 90, angle_deg = 150 }}
B2 = {{ turn = "B1", deg = 120 }}
B3 = {{ turn = "B1", deg = 240 }}
[home]
position = [0.0, 0.0, 210.0]
rpy_deg = [0.0, 0.0, 0.0]
[workspace]
translation = [15.0, 15.0, 10.0]
rotation_deg = [0.0, 0.0, 8.0]
{tables}[optimize]
variables = {variables}
"#
    )
}

/// Legs that would run into the plate of the platform. The best platform without the plate has such legs, and the one
/// found with it does not. `assess` says so of both.
#[test]
#[ignore = "evidence"]
fn legs_keep_clear_of_the_plates_where_the_best_platform_would_not() {
    let hardware = "[hardware]\nleg_length = [60.0, 330.0]\nleg_diameter = 20.0\njoint_diameter = 24.0\nleg_clearance = 2.0\n";
    let plate = "[plates.platform]\nthickness = 10.0\nmargin = 20.0\nhole = 8.0\nheight = 3.5\n";
    let variables = "[\"symmetric_offsets\", \"home_height\"]";
    let assess = |folder: &std::path::Path, file: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_equipod"));
        command.current_dir(folder).args(["assess", file, "--json"]).output().unwrap()
    };
    let (out, folder) = optimize(&on_plates(hardware, variables), &["-o", "out.toml"]);
    assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stdout));
    let text = std::fs::read_to_string(folder.path().join("out.toml")).unwrap();
    std::fs::write(folder.path().join("plated.toml"), format!("{text}\n{plate}")).unwrap();
    let assessed = document(&assess(folder.path(), "plated.toml"));
    let of = |d: &Value| {
        let list = d["requirements"].as_array().unwrap();
        list.iter().find(|m| m["name"] == "plate_clearance").unwrap()["margin"].as_f64().unwrap()
    };
    assert!(
        assessed["met"] == false && of(&assessed) < 0.0,
        "without the plate the legs are where it would be"
    );
    let plated = on_plates(&format!("{hardware}{plate}"), variables);
    let (out, folder) = optimize(&plated, &["-o", "out.toml"]);
    assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stdout));
    let assessed = assess(folder.path(), "out.toml");
    assert_eq!(assessed.status.code(), Some(0));
    assert!(of(&document(&assessed)) >= 0.0);
    // and in the folder of `explore`
    let mut command = Command::new(env!("CARGO_BIN_EXE_equipod"));
    command.current_dir(folder.path()).args(["explore", "in.toml", "-o", "all", "--samples", "1"]);
    let explored = command.output().unwrap();
    assert_eq!(explored.status.code(), Some(0), "{}", String::from_utf8_lossy(&explored.stdout));
    assert_eq!(assess(folder.path(), "all/optimised.toml").status.code(), Some(0));
}

/// Bolts at a right angle to the corners of the plate end too near to its outline wherever the joints are. A wider
/// plate resolves it, by the missing amount.
#[test]
#[ignore = "evidence"]
fn a_wider_plate_is_a_freedom_that_is_tried() {
    let tables = "[hardware]\nleg_length = [150.0, 330.0]\n[plates.base]\nthickness = 10.0\nmargin = 24.0\nhole = 8.0\nheight = 20.0\nedge_distance = 4.0\nbolts = { count = 1, circle = 40.0, hole = 6.0, first_deg = 90.0, from = \"centre\" }\n";
    let design = on_plates(tables, "[\"symmetric_offsets\"]");
    let (out, folder) = optimize(&design, &["--candidates", "opened"]);
    assert_eq!(out.status.code(), Some(1), "{}", String::from_utf8_lossy(&out.stdout));
    let d = document(&out);
    let demands = d["conflict"]["requirements"].as_array().unwrap();
    assert!(demands.iter().any(|r| r["name"] == "base_hole_edge"), "{demands:?}");
    let freedoms = d["freedoms"].as_array().unwrap();
    let wider = freedoms.iter().find(|f| f["freedom"] == "base_margin").unwrap();
    assert_eq!(wider["outcome"], "resolved");
    // 4 + 3 + 20 cos 30 deg - 24
    let missing = 7.0 + 10.0 * 3f64.sqrt() - 24.0;
    let amount = wider["amount"].as_f64().unwrap();
    assert!(amount >= missing && amount < 1.4 * missing, "{amount} {missing}");
    assert!(wider["message"].as_str().unwrap().starts_with("with a plate of the base wider by "));
    let mut assess = Command::new(env!("CARGO_BIN_EXE_equipod"));
    let assessed =
        assess.current_dir(folder.path()).args(["assess", "opened/with-base_margin.toml"]).output();
    assert_eq!(assessed.unwrap().status.code(), Some(0));
}

/// `drives` of `[hardware]` is `--drives`, and `assess` names the lightest drive that suffices.
#[test]
#[ignore = "evidence"]
fn a_design_names_its_table_of_drives() {
    let more = "[hardware]\ndrives = \"struts.csv\"\n[optimize]\nvariables = [\"symmetric_offsets\", \"home_height\"]\n";
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("named.toml"), required(more)).unwrap();
    let plain = required(more).replace("drives = \"struts.csv\"\n", "");
    std::fs::write(folder.path().join("plain.toml"), plain).unwrap();
    std::fs::write(folder.path().join("struts.csv"), STRUTS).unwrap();
    let run = |args: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_equipod"));
        command.current_dir(folder.path()).args(args).output().unwrap()
    };
    let named = run(&["optimize", "named.toml", "--json", "-o", "out.toml"]);
    assert_eq!(named.status.code(), Some(0), "{}", String::from_utf8_lossy(&named.stdout));
    let optioned = document(&run(&["optimize", "plain.toml", "--drives", "struts.csv", "--json"]));
    let named = document(&named);
    assert_eq!(
        (&named["drive_search"], &named["objective"]),
        (&optioned["drive_search"], &optioned["objective"])
    );
    // the drive is chosen: the design written has its limits and names no table
    let written = std::fs::read_to_string(folder.path().join("out.toml")).unwrap();
    assert!(written.contains("leg_length = [9.0, 18.0]") && !written.contains("struts.csv"), "{written}");
    // the lightest of those that suffice, which is not the cheapest
    let table =
        "name,stroke_mm,retracted_length_mm,mass_kg,price_EUR\nheavy,9,9,3,1\nshort,1,9,1,1\nlight,9,9,2,9\n";
    std::fs::write(folder.path().join("struts.csv"), table).unwrap();
    let with_table = written.replacen("[hardware]\n", "[hardware]\ndrives = \"struts.csv\"\n", 1);
    std::fs::write(folder.path().join("table.toml"), with_table).unwrap();
    let d = document(&run(&["assess", "table.toml", "--json"]));
    let lightest = &d["lightest_drive"];
    assert_eq!((&lightest["name"], &lightest["mass"]), (&"light".into(), &2.0.into()), "{lightest}");
    let compared = run(&["compare", "table.toml", "out.toml"]);
    let text = String::from_utf8(compared.stdout).unwrap();
    assert!(text.lines().any(|l| l.starts_with("lightest drive") && l.contains("light")), "{text}");
    // no table is read for a front
    let front = required(
        "[hardware]\ndrives = \"struts.csv\"\n[optimize]\nobjectives = [\"stroke\", \"worst_conditioning\"]\nmode = \"pareto\"\n",
    );
    std::fs::write(folder.path().join("front.toml"), front).unwrap();
    let out = run(&["optimize", "front.toml", "--json"]);
    assert_eq!(
        (out.status.code(), &document(&out)["error"]["code"]),
        (Some(2), &"drives::not_chosen".into())
    );
}

/// Bolts of a base plate at a right angle to the corners: sharp corners leave them too little space. A workspace and an
/// envelope that are wider than deep ask for a base with sharp corners. The best platform without the plate has them,
/// and `assess` finds the holes too near to the outline. The one found with the plate has blunter corners, just within
/// the limit, and `assess` proves it.
#[test]
#[ignore = "evidence"]
fn holes_keep_their_distance_from_the_outline_where_the_best_platform_would_not() {
    let plate = "[plates.base]\nthickness = 10.0\nmargin = 24.5\nhole = 8.0\nheight = 20.0\nedge_distance = 4.0\nbolts = { count = 1, circle = 40.0, hole = 6.0, first_deg = 90.0, from = \"centre\" }\n";
    let design = |plate: &str| {
        let tables = format!(
            "[hardware]\nleg_length = [100.0, 330.0]\n[envelope]\nbase = {{ min = [-260.0, -85.0, -50.0], max = [260.0, 160.0, 50.0] }}\n{plate}"
        );
        let search = "[\"symmetric_offsets\", \"triangles\"]\nsymmetry = \"none\"\noffset_bounds = [0.1, 0.4]\nstretch_bounds = [-0.5, 0.5]";
        on_plates(&tables, search)
            .replace("translation = [15.0, 15.0, 10.0]", "translation = [40.0, 5.0, 5.0]")
            .replace("rotation_deg = [0.0, 0.0, 8.0]", "rotation_deg = [0.0, 0.0, 4.0]")
    };
    let searched = |plate: &str| {
        let (out, folder) = optimize(&design(plate), &["-o", "out.toml"]);
        assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stdout));
        (document(&out)["objective"].as_f64().unwrap(), folder)
    };
    let edge_of = |folder: &tempfile::TempDir, text: &str| {
        std::fs::write(folder.path().join("assessed.toml"), text).unwrap();
        let mut assess = Command::new(env!("CARGO_BIN_EXE_equipod"));
        let assessed =
            assess.current_dir(folder.path()).args(["assess", "assessed.toml", "--json"]).output().unwrap();
        let d = document(&assessed);
        let rows = d["requirements"].as_array().unwrap();
        let row = rows.iter().find(|m| m["name"] == "base_hole_edge").unwrap();
        (assessed.status.code(), row["margin"].as_f64().unwrap(), row["status"].clone())
    };
    let read = |folder: &tempfile::TempDir| std::fs::read_to_string(folder.path().join("out.toml")).unwrap();
    let (free, folder) = searched("");
    let (code, margin, status) = edge_of(&folder, &format!("{}\n{plate}", read(&folder)));
    assert_eq!((code, status), (Some(1), "violated".into()));
    assert!(margin < -1.0, "without the plate the holes are too near to the outline: {margin}");
    let (held, folder) = searched(plate);
    let (code, margin, status) = edge_of(&folder, &read(&folder));
    assert_eq!((code, status), (Some(0), "met".into()));
    // the limit binds, and costs something
    assert!((0.0..0.05).contains(&margin), "{margin}");
    assert!(held < free, "{held} {free}");
}

/// The answer names active ranges and limits; a platform without active ones has none named.
#[test]
fn what_a_platform_rides_on_is_named_with_what_would_keep_it_away() {
    let active_bounds = |tables: &str, more: &[&str]| {
        let (out, folder) = optimize(&format!("{DESIGN}{tables}"), more);
        assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stderr));
        (document(&out)["active_bounds"].clone(), folder)
    };
    let (r, folder) = active_bounds("", &["--extension", "0"]);
    let text = Command::new(env!("CARGO_BIN_EXE_equipod"))
        .current_dir(folder.path())
        .args(["optimize", "in.toml", "--quiet", "--extension", "0"])
        .output()
        .unwrap();
    let text = String::from_utf8(text.stdout).unwrap();
    let message = r["message"].as_str().unwrap();
    assert!(text.contains(message), "{text}");
    for word in ["distance of base joints", "no safety margin", "`safety_margin` in [limits]", "[envelope]"] {
        assert!(message.contains(word), "{message}");
    }
    let limit = |r: &Value| {
        let bounds = r["bounds"].as_array().unwrap().clone();
        bounds.into_iter().find(|b| b["name"] == "base_spacing").unwrap()
    };
    assert_eq!(limit(&r)["kind"], "limit");
    assert!(limit(&r)["value"].as_f64().unwrap().abs() < 1e-6, "{r}");
    // with a safety margin neither limit is active
    let (r, _) = active_bounds("\n[limits]\nsafety_margin = \"10%\"\n", &["--extension", "0"]);
    let named = r["bounds"].as_array().into_iter().flatten().any(|b| b["kind"] == "limit");
    assert!(!named, "{r}");
}

/// A usual hexapod whose legs are too short for its workspace: none of them can be replaced, and other sizes with
/// another height cure it.
#[test]
#[ignore = "evidence"]
fn a_hexapod_without_families_is_cured_by_its_sizes_and_its_height() {
    let text = std::fs::read_to_string("tests/fixtures/verdicts/usual-hexapod-too-small.toml").unwrap();
    let (out, folder) = optimize(&text, &["-o", "out.toml"]);
    let d = document(&out);
    assert_eq!((out.status.code(), &d["status"]), (Some(0), &"best_found".into()), "{d}");
    assert!(d["choice"].as_str().unwrap().contains("the height of home"), "{d}");
    assert_eq!(d["variables"].as_array().unwrap().len(), 3, "{}", d["variables"]);
    assert_eq!(d["requirements_met"], true);
    let assess = |path: &str| {
        let out = Command::new(env!("CARGO_BIN_EXE_equipod"))
            .current_dir(folder.path())
            .args(["assess", path])
            .output()
            .unwrap();
        out.status.code()
    };
    assert_eq!((assess("in.toml"), assess("out.toml")), (Some(1), Some(0)));
    // variables that are named stay those that are chosen
    let named = format!("{text}\n[optimize]\nvariables = [\"triangle_sizes\"]\n");
    let (out, _folder) = optimize(&named, &["--time-limit", "1"]);
    assert_eq!(document(&out)["choice"], Value::Null);
}
