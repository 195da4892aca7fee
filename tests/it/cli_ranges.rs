//! Travel as data sheets state it: intervals to one side of home, a pivot, ranges of single coordinates.

use std::path::Path;

use equipod::methods::manipulator::Body;
use equipod::prelude::*;
use serde_json::Value;

use super::cli_frame::{document, equipod};

const ON_THE_WAY: &str = include_str!("../fixtures/ranges/keep-out-on-the-way.toml");
const SIMULATOR: &str = include_str!("../../designs/worked/simulator-300kg.toml");
const HALF_WIDTHS: &str = "translation = [100, 100, 100]";

/// The file of a text.
fn file(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(format!("{name}.toml"));
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

/// A text with one replaced part, which it contains.
fn with(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from}");
    text.replacen(from, to, 1)
}

/// The simulator with another region, without listed poses.
fn simulator(workspace: &str) -> String {
    let poses = SIMULATOR.find("poses = [").unwrap();
    let end = SIMULATOR.find("[hardware]").unwrap();
    let text = format!("{}{}", &SIMULATOR[..poses], &SIMULATOR[end..]);
    let text = with(&text, "relative_to = \"home\"\n", "");
    with(&text, HALF_WIDTHS, workspace)
}

/// The same with lengths and joint angles as its only requirements over the poses: they are proved fast.
fn quick(workspace: &str) -> String {
    let text = simulator(workspace);
    let costly = ["leg_diameter", "rod_diameter", "cylinder_length", "leg_clearance", "max_leg_force"];
    let kept = |line: &&str| !costly.iter().any(|key| line.starts_with(key));
    text.split_inclusive('\n').filter(kept).collect()
}

fn assess(path: &str) -> (Option<i32>, Value) {
    let out = equipod(&["assess", path, "--points", "50", "--searches", "1", "--cells", "300", "--json"]);
    (out.status.code(), document(&out))
}

/// The margins of an answer: found, and proved.
fn margins(doc: &Value) -> Vec<(String, f64, Option<f64>)> {
    let margin = |m: &Value| {
        let name = m["name"].as_str().unwrap().to_owned();
        (name, m["margin"].as_f64().unwrap(), m["proved_margin"].as_f64())
    };
    doc["requirements"].as_array().unwrap().iter().map(margin).collect()
}

/// The poses of `[workspace]` written as the ranges they stand for.
fn ranges_on_the_way(ranges: &str) -> String {
    let from = ON_THE_WAY.find("relative_to").unwrap();
    let end = ON_THE_WAY.find("[hardware]").unwrap();
    format!("{}ranges = {ranges}\n{}", &ON_THE_WAY[..from], &ON_THE_WAY[end..])
}

#[test]
fn a_keep_out_between_the_ends_of_a_range_is_found_and_the_free_part_is_named() {
    let folder = tempfile::tempdir().unwrap();
    // the ends alone are allowed
    let (code, doc) = assess(&file(folder.path(), "ends", ON_THE_WAY));
    assert_eq!((code, &doc["met"], &doc["workspace"]), (Some(0), &true.into(), &"listed_poses".into()));
    assert!(doc["ranges"].is_null());
    let path = file(folder.path(), "ranges", &ranges_on_the_way("{ x = [-17, 17], yaw_deg = 21 }"));
    let (code, doc) = assess(&path);
    assert_eq!((code, &doc["met"], &doc["workspace"]), (Some(1), &false.into(), &"stated".into()));
    assert_eq!(doc["assessed_poses"]["ranges"], 2);
    let keep_out = &doc["requirements"].as_array().unwrap()[3];
    assert_eq!((&keep_out["name"], &keep_out["status"]), (&"keep_out".into(), &"violated".into()));
    let (x, yaw) = (&doc["ranges"][0], &doc["ranges"][1]);
    assert_eq!((&x["coordinate"], &x["unit"], &x["max"]), (&"x".into(), &"mm".into(), &17.0.into()));
    // the same end as in `limits`
    let limits = document(&equipod(&["limits", &path, "--json"]));
    let end = x["forth"]["value"].as_f64().unwrap();
    assert!((end - 1.39).abs() < 0.005, "{end}");
    assert!((end - limits["axes"][0]["forth"]["value"].as_f64().unwrap()).abs() < 1e-6);
    assert_eq!(x["forth"]["binds"]["name"], "keep_out");
    assert_eq!((&x["back"]["value"], &x["back"]["binds"]), (&(-17.0).into(), &Value::Null));
    assert_eq!((&yaw["coordinate"], &yaw["forth"]["binds"]), (&"yaw_deg".into(), &Value::Null));
    assert!((yaw["back"]["value"].as_f64().unwrap() + 3.64).abs() < 0.005);
    let text = String::from_utf8(equipod(&["assess", &path]).stdout).unwrap();
    let row = text.lines().find(|l| l.starts_with("x ")).unwrap();
    assert!(row.contains("1.39") && row.contains("leg 2, stop in mid travel"), "{text}");
    // the negative control: up to that end every pose of the ranges is proved
    let path = file(folder.path(), "short", &ranges_on_the_way("{ x = [-17, 1.38], yaw_deg = [-3.6, 21] }"));
    let (code, doc) = assess(&path);
    assert_eq!((code, &doc["met"], &doc["workspace"]), (Some(0), &true.into(), &"stated".into()));
    let said = doc["explanation"].as_str().unwrap();
    assert!(
        said.contains("proved along the ranges of single coordinates; combined motions are not assessed"),
        "{said}"
    );
    assert_eq!(doc["assessed_poses"]["met_in_words"], "met along its ranges");
    assert_eq!(
        doc["regular_explanation"],
        "No singular pose along the ranges of single coordinates: proved; combined motions are not assessed"
    );
}

/// No digit depends on the way in which a symmetric interval is written.
#[test]
fn a_symmetric_pair_is_its_half_width() {
    let folder = tempfile::tempdir().unwrap();
    let answer = |workspace: &str| {
        let (_, mut doc) = assess(&file(folder.path(), "simulator", &quick(workspace)));
        doc.as_object_mut().unwrap().remove("provenance");
        doc.to_string()
    };
    let half = answer("translation = [50, 40, 30]\nranges = { x = 60, yaw_deg = 5 }");
    let pairs = "translation = [[-50, 50], 40, [-30.0, 30]]\nranges = { x = [-60, 60], yaw_deg = [-5, 5] }";
    assert_eq!(half, answer(pairs));
    assert_ne!(half, answer("translation = [[-50, 51], 40, 30]\nranges = { x = 60, yaw_deg = 5 }"));
}

/// The file of a maker with `[[-241, 259], [-259, 259], [-178, 178]]`.
#[test]
fn intervals_to_one_side_are_those_about_a_moved_home() {
    let folder = tempfile::tempdir().unwrap();
    let text = quick("translation = [[-241, 259], [-259, 259], [-178, 178]]");
    let (code, doc) = assess(&file(folder.path(), "one-sided", &text));
    assert!(matches!(code, Some(0 | 1 | 3)) && doc["assessed_poses"]["region"] == true, "{doc}");
    // without rotations, home may be moved to the middle; cone angles and forces are measured from home itself
    let plain = |text: String| with(&text, "rotation_deg = [10, 10, 10]\n", "");
    let moved = with(
        &plain(quick("translation = [250, 259, 178]")),
        "position = [0, 0, 950]",
        "position = [9, 0, 950]",
    );
    let found = |name: &str, text: &str| margins(&assess(&file(folder.path(), name, text)).1);
    let (own, other) = (found("own", &plain(text)), found("moved", &moved));
    let mut compared = 0;
    for (a, b) in own.iter().zip(&other).filter(|(a, _)| !a.0.contains("angle")) {
        assert_eq!(a.0, b.0);
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-6 * (1.0 + a.abs());
        assert!(close(a.1, b.1), "{a:?} {b:?}");
        assert!(a.2.zip(b.2).is_none_or(|(a, b)| close(a, b)), "{a:?} {b:?}");
        compared += 1;
    }
    assert!(compared >= 2, "{own:?}");
}

/// `pivot = [0, 0, 400]` in `[workspace]` is the design with its platform frame moved there; the answer has the poses
/// of the stated frame.
#[test]
fn a_pivot_is_a_moved_platform_frame() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(folder.path(), "pivot", &quick(&format!("{HALF_WIDTHS}\npivot = [0, 0, 400]")));
    let design = Design::load(&path).unwrap();
    let q = nalgebra::Vector3::new(0.0, 0.0, 400.0);
    assert_eq!(design.workspace.pivot, Some(q));
    let (code, doc) = assess(&path);
    assert_eq!((code, &doc["workspace"]), (Some(0), &"stated".into()), "{doc}");
    let text = quick(HALF_WIDTHS);
    let text = with(&text, "[0, 0, 950]", "[0, 0, 1350]");
    let text = with(
        &text,
        "B1 = { radius = \"platform_radius\", angle_deg = 150 }",
        "B1 = { radius = \"platform_radius\", angle_deg = 150, z = -400 }",
    );
    let text = with(&text, "center = [0, 0, 400]", "center = [0, 0, 0]");
    let moved = file(folder.path(), "moved", &text);
    let (_, other) = assess(&moved);
    let at_origin = assess(&file(folder.path(), "origin", &quick(HALF_WIDTHS))).1;
    for (a, b) in margins(&doc).iter().zip(&margins(&other)) {
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-6 * (1.0 + a.abs());
        assert!(a.0 == b.0 && close(a.1, b.1), "{a:?} {b:?}");
        assert!(a.2.zip(b.2).is_none_or(|(a, b)| close(a, b)), "{a:?} {b:?}");
    }
    let length = |doc: &Value| margins(doc)[0].1;
    assert!((length(&doc) - length(&at_origin)).abs() > 1.0);
    // the least length is that of the leg at the stated pose
    let row = &doc["requirements"][0];
    let numbers = |key: &str| -> Vec<f64> {
        row["pose"][key].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
    };
    let (p, e) = (numbers("p"), numbers("q"));
    let quaternion = nalgebra::Quaternion::new(e[0], e[1], e[2], e[3]);
    let rotation = nalgebra::UnitQuaternion::from_quaternion(quaternion).to_rotation_matrix();
    let leg = design.manipulator().legs()[row["legs"][0].as_u64().unwrap() as usize - 1];
    let end = rotation * leg.platform.coords + nalgebra::Vector3::new(p[0], p[1], p[2]);
    let length = (end - leg.base.coords).norm();
    assert!((length - 850.0 - row["margin"].as_f64().unwrap()).abs() < 1e-6, "{length} {row}");
    assert_eq!(design.manipulator().joints(Body::Platform).len(), 3);
}

/// The pivot of `[frames]` is the default, since travel is stated in the poses of the machine.
#[test]
fn the_pivot_of_the_frames_is_the_default() {
    let folder = tempfile::tempdir().unwrap();
    let found = |workspace: &str, frames: &str| {
        let text = format!("{}\n{frames}", quick(workspace));
        margins(&assess(&file(folder.path(), "frames", &text)).1)
    };
    let stated = format!("{HALF_WIDTHS}\npivot = [0, 0, 400]");
    let frames = "[frames]\npivot = [0, 0, 400]\n";
    assert_eq!(found(&stated, ""), found(HALF_WIDTHS, frames));
    assert_eq!(found(HALF_WIDTHS, ""), found(&format!("{HALF_WIDTHS}\npivot = [0, 0, 0]"), frames));
}

/// Proved margins are at or below the margins of many poses, computed from the joints alone.
#[test]
fn the_proved_least_length_is_below_dense_sampling_about_the_pivot() {
    let folder = tempfile::tempdir().unwrap();
    let workspace = "translation = [[-80, 40], [-20, 60], 50]\npivot = [100, 0, 400]\nranges = { z = [-120, 0], pitch_deg = [-3, 16] }";
    let path = file(folder.path(), "sampled", &quick(workspace));
    let (doc, design) = (assess(&path).1, Design::load(&path).unwrap());
    let home = design.home.unwrap();
    let q = nalgebra::Vector3::new(100.0, 0.0, 400.0);
    let shortest = |d: [f64; 3], w_deg: [f64; 3]| {
        let turn = nalgebra::Rotation3::new(nalgebra::Vector3::from(w_deg).map(f64::to_radians));
        let rotation = turn * home.rotation;
        let position = home.position + nalgebra::Vector3::from(d) + home.rotation * q - rotation * q;
        let length = |leg: &equipod::methods::manipulator::Leg| {
            (rotation * leg.platform.coords + position - leg.base.coords).norm()
        };
        design.manipulator().legs().iter().map(length).fold(f64::INFINITY, f64::min)
    };
    // a lattice of the two ellipsoids, and the two ranges
    let mut least = f64::INFINITY;
    let steps: Vec<f64> = (0..7).map(|k| f64::from(k) / 3.0 - 1.0).collect();
    let ball: Vec<[f64; 3]> = steps
        .iter()
        .flat_map(|x| steps.iter().flat_map(|y| steps.iter().map(|z| [*x, *y, *z])))
        .filter(|x| x.iter().map(|x| x * x).sum::<f64>() <= 1.0)
        .collect();
    for x in &ball {
        let d = [-20.0 + 60.0 * x[0], 20.0 + 40.0 * x[1], 50.0 * x[2]];
        for w in &ball {
            least = least.min(shortest(d, w.map(|w| 10.0 * w)));
        }
    }
    for k in 0..=100 {
        let t = f64::from(k) / 100.0;
        least = least.min(shortest([0.0, 0.0, -120.0 * t], [0.0; 3]));
        least = least.min(shortest([0.0; 3], [0.0, -3.0 + 19.0 * t, 0.0]));
    }
    let (name, margin, proved) = margins(&doc).swap_remove(0);
    assert_eq!(name, "min_leg_length");
    let sampled = least - 850.0;
    assert!(proved.unwrap() <= sampled + 1e-9 && proved.unwrap() > sampled - 40.0, "{proved:?} {sampled}");
    assert!(margin <= sampled + 1.0 && margin >= proved.unwrap() - 1e-9, "{margin} {sampled}");
}

#[test]
fn intervals_that_leave_out_home_are_refused_where_they_stand() {
    let refused = |workspace: &str| {
        let folder = tempfile::tempdir().unwrap();
        let path = file(folder.path(), "refused", &quick(workspace));
        let out = equipod(&["assess", &path]);
        assert_eq!(out.status.code(), Some(2), "{workspace}");
        String::from_utf8(out.stderr).unwrap()
    };
    for (workspace, said) in [
        ("translation = [[10, 20], 1, 1]", "home lies outside the interval from 10 to 20 of `translation`"),
        ("translation = [[20, -10], 1, 1]", "begins at 20 and ends at -10"),
        ("translation = [[-1, 2, 3], 1, 1]", "an interval of `translation` has 3 numbers instead of 2"),
        ("translation = [-241, 259]", "`translation` has 2 entries instead of 3"),
        ("translation = [-1, 2, 3]", "a half width of -1"),
        ("translation = [[-1, 99], [-1, 99], [-1, 99]]", "home lies outside the ellipsoid"),
        (
            "translation = [1, 1, 1]\nranges = { x = [1, 2] }",
            "home lies outside the interval from 1 to 2 of `x`",
        ),
        ("translation = [1, 1, 1]\nranges = { yaw = 10 }", "did you mean `yaw_deg`?"),
        ("translation = [1, 1, 1]\nranges = { yaw_deg = [-190, 10] }", "an end of `yaw_deg` is 190 degrees"),
    ] {
        let text = refused(workspace);
        assert!(text.contains(said), "{workspace}: {text}");
    }
}

/// Every length of the table changes with the unit, and angles stay.
#[test]
fn intervals_pivot_and_ranges_are_converted_and_saved() {
    let folder = tempfile::tempdir().unwrap();
    let workspace = "translation = [[-241, 259], 100, 0]\npivot = [0, 0, 400]\nranges = { x = [-17, 0], yaw_deg = [-21, 10] }";
    let path = file(folder.path(), "mm", &with(&quick(workspace), "region = \"ellipsoid\"\n", ""));
    let metres = folder.path().join("m.toml").to_str().unwrap().to_owned();
    let out = equipod(&["design", "convert", &path, "--units", "m", "-o", &metres]);
    assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stderr));
    let (mm, m) =
        (Design::load(&path).unwrap().workspace.clone(), Design::load(&metres).unwrap().workspace.clone());
    let near = |a: f64, b: f64| (a - 1000.0 * b).abs() < 1e-9;
    assert!(
        near(mm.translation[0].min, m.translation[0].min)
            && near(mm.translation[0].max, m.translation[0].max)
    );
    assert!(near(mm.translation[1].max, m.translation[1].max) && near(mm.ranges[0].min, m.ranges[0].min));
    assert!((m.pivot.unwrap().z - 0.4).abs() < 1e-15);
    assert_eq!((mm.rotation_deg, mm.ranges[5]), (m.rotation_deg, m.ranges[5]));
    let text = std::fs::read_to_string(&metres).unwrap();
    assert!(text.contains("[-0.241, 0.259]") && text.contains("yaw_deg"), "{text}");
}

/// A search under such a workspace runs, and its platform is assessed over all of it.
#[test]
fn searches_run_under_intervals_a_pivot_and_ranges() {
    let folder = tempfile::tempdir().unwrap();
    let workspace = "translation = [[-60, 80], 60, 50]\npivot = [0, 0, 100]\nranges = { x = [-150, 150], yaw_deg = [0, 20] }";
    let path = file(folder.path(), "searched", &simulator(workspace));
    let out = equipod(&["optimize", &path, "--time-limit", "3", "--json"]);
    let doc = document(&out);
    assert!(matches!(out.status.code(), Some(0 | 1 | 3)), "{}", String::from_utf8_lossy(&out.stderr));
    assert_eq!(doc["assessment"]["assessed_poses"]["ranges"], 2, "{doc}");
}
