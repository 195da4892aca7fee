//! Inputs of public questions: tables, lists, models and designs, with numbers of our own.
//!
//! Each test names the cases of the collection (`h01` to `h23`) whose kind it has. Others stand with their commands:
//! `cli_limits` (`h15`, home beyond the legs), `cli_motion` (`h16`, legs that only push), `cli_conventions` (`h18`,
//! `h19`, columns of controllers) and `singular_poses` (`h22`, a motion through a singular pose).

use std::fmt::Write as _;
use std::path::PathBuf;

use serde_json::Value;

use super::cli_frame::{document, equipod};

/// Angles of the joints, degrees: pairs of neighbours 40 degrees apart on the base, 30 on the platform.
const ANGLES: [[f64; 6]; 2] = [[-20., 20., 100., 140., 220., 260.], [-45., 45., 75., 165., 195., 285.]];
const RADII: [f64; 2] = [120.0, 70.0];
const HEIGHT: f64 = 110.0;

fn joint(body: usize, leg: usize) -> [f64; 3] {
    let (s, c) = ANGLES[body][leg].to_radians().sin_cos();
    [RADII[body] * c, RADII[body] * s, 0.0]
}

/// A folder with a file in it.
fn file(name: &str, text: &str) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let path: PathBuf = folder.path().join(name);
    std::fs::write(&path, text).unwrap();
    let path = path.to_str().unwrap().to_owned();
    (folder, path)
}

/// The answer of `new --points` for a text.
fn made(name: &str, text: &str, more: &[&str]) -> Value {
    let (_folder, path) = file(name, text);
    let out = equipod(&[&["new", "--points", &path, "--json"], more].concat());
    assert_eq!(out.status.code(), Some(0), "{name}: {}", String::from_utf8_lossy(&out.stdout));
    document(&out)
}

fn answer(words: &[&str]) -> (Option<i32>, Value) {
    let out = equipod(&[words, &["--json"]].concat());
    (out.status.code(), document(&out))
}

fn lengths(doc: &Value) -> Vec<f64> {
    doc["lengths"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

/// Every leg has the length from ring to ring at this height.
fn is_meant(name: &str, doc: &Value, scale: f64) {
    for (leg, length) in lengths(doc).into_iter().enumerate() {
        let [a, b] = [joint(0, leg), joint(1, leg)];
        let meant = ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2) + HEIGHT * HEIGHT).sqrt() * scale;
        assert!((length - meant).abs() < 1e-3 * scale, "{name}, leg {}: {length} {meant}", leg + 1);
    }
}

#[test]
fn radii_and_angles_are_no_coordinates_h01_h02_h11() {
    let mut columns = "leg,base_radius,base_angle_deg,platform_radius,platform_angle_deg\n".to_owned();
    let mut rows = "body,name,radius_mm,angle_deg,z_mm\n".to_owned();
    for body in 0..2 {
        for leg in 0..6 {
            let (r, angle) = (RADII[body], ANGLES[body][leg]);
            let _ = writeln!(
                rows,
                "{},{}{},{r},{angle},0",
                ["base", "platform"][body],
                ["b", "p"][body],
                leg + 1
            );
        }
    }
    for leg in 0..6 {
        let _ =
            writeln!(columns, "{},{},{},{},{}", leg + 1, RADII[0], ANGLES[0][leg], RADII[1], ANGLES[1][leg]);
    }
    let lists = format!(
        "# lengths in mm\nbase_radius = {}\nbase_angles = {:?}\ntop_radius = {}\ntop_angles = {:?}\nheight = {HEIGHT}\n",
        RADII[0], ANGLES[0], RADII[1], ANGLES[1]
    );
    for (name, text) in [("columns.csv", columns), ("rows.csv", rows), ("lists.py", lists)] {
        is_meant(name, &made(name, &text, &["--height", "110"]), 1.0);
    }
}

#[test]
fn lists_of_every_language_are_twelve_joints_h03_to_h08() {
    let body = |k: usize, open: &str, close: &str, scale: f64| {
        let rows = (0..6).map(|leg| {
            let [x, y, z] = joint(k, leg).map(|x| x * scale);
            format!("{open}{x:.7}, {y:.7}, {z}{close}")
        });
        rows.collect::<Vec<_>>()
    };
    let [base, platform] = [0, 1].map(|k| body(k, "[", "]", 1.0).join(",\n  "));
    let [c_base, c_platform] = [0, 1].map(|k| body(k, "{", "}", 1.0).join(",\n  "));
    let columns = |k: usize| {
        let row = |axis: usize| {
            (0..6).map(|leg| format!("{:.7}", joint(k, leg)[axis] / 1000.0)).collect::<Vec<_>>()
        };
        [0, 1, 2].map(|axis| row(axis).join(" ")).join(";\n")
    };
    let yaml = |k: usize| body(k, "  - [", "]", 1.0).join("\n");
    for (name, text, scale) in [
        (
            "arrays.py",
            format!("import numpy as np\nbase = np.array([{base}])\nplat = np.array([{platform}])\n"),
            1.0,
        ),
        (
            "units.json",
            format!(
                "{{\"base\": [{base}], \"platform\": [{platform}], \"units\": \"mm\", \"height\": {HEIGHT}}}"
            ),
            1.0,
        ),
        (
            "indented.json",
            format!("{{\n  \"base\": [{base}],\n  \"platform\": [{platform}]\n}}").replace(", ", ",\n      "),
            1.0,
        ),
        (
            "list.yaml",
            format!("base_anchors:\n{}\nplatform_anchors:\n{}\nheight: {HEIGHT}\n", yaml(0), yaml(1)),
            1.0,
        ),
        (
            "header.h",
            format!(
                "#define ROD 147.4\nfloat base_pts[6][3] = {{{c_base}}};\nfloat plat_pts[6][3] = {{{c_platform}}};\n"
            ),
            1.0,
        ),
        (
            "columns.m",
            format!(
                "% columns are legs, in m\nFa = [{}];\nMb = [{}];\nFO_M = [0; 0; 0.11];\n",
                columns(0),
                columns(1)
            ),
            1e-3,
        ),
    ] {
        let height = if scale < 1.0 { "0.11" } else { "110" };
        let doc = made(name, &text, &["--height", height]);
        is_meant(name, &doc, scale);
        assert_eq!(doc["units"], if scale < 1.0 { "m" } else { "mm" }, "{name}");
    }
}

#[test]
fn models_of_gazebo_and_ros_are_read_back_h09_h10() {
    let folder = tempfile::tempdir().unwrap();
    let own = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let design = "designs/symmetric-hexapod.toml";
    let meant = lengths(&answer(&["ik", design]).1);
    for format in ["sdf", "urdf"] {
        let out = equipod(&["export", design, "--to", format, "-o", &own("")]);
        assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stderr));
        let found = std::fs::read_dir(folder.path()).unwrap().filter_map(|entry| {
            let path = entry.unwrap().path();
            (path.extension()? == format).then_some(path)
        });
        let model = found.last().unwrap();
        let (_, doc) = answer(&["new", "--points", model.to_str().unwrap()]);
        let read = lengths(&doc);
        let scale = if doc["units"] == "m" { 1e-3 } else { 1.0 };
        for (a, b) in meant.iter().zip(&read) {
            assert!((a * scale - b).abs() < 1e-6 * b, "{format}: {meant:?} {read:?}");
        }
    }
}

/// The joints of a design in polar coordinates.
fn polar(angles: [[f64; 6]; 2], radii: [f64; 2]) -> String {
    let mut out =
        "name = \"polar\"\nunits = \"mm\"\nlegs = [[\"A1\",\"B1\"], [\"A2\",\"B2\"], [\"A3\",\"B3\"], [\"A4\",\"B4\"], [\"A5\",\"B5\"], [\"A6\",\"B6\"]]\n".to_owned();
    for (k, body) in ["base", "platform"].into_iter().enumerate() {
        let _ = writeln!(out, "[{body}]");
        for (leg, angle) in angles[k].into_iter().enumerate() {
            let name = ["A", "B"][k];
            let _ = writeln!(out, "{name}{} = {{ radius = {}, angle_deg = {angle} }}", leg + 1, radii[k]);
        }
    }
    out + "[home]\nposition = [0, 0, 80]\nrpy_deg = [0, 0, 0]\n"
}

#[test]
fn exact_joints_that_no_pose_holds_are_proved_singular_h12_h13_h14() {
    let midline = "name = \"midline\"\nunits = \"mm\"\nlegs = [[\"A1\",\"M1\"],[\"A2\",\"M2\"],[\"A3\",\"M3\"],[\"N1\",\"B2\"],[\"N2\",\"B3\"],[\"N3\",\"B1\"]]\n[base]\nA1 = { radius = 90, angle_deg = 0 }\nA2 = { radius = 90, angle_deg = 120 }\nA3 = { radius = 90, angle_deg = 240 }\nN1 = { on = [\"A1\", \"A2\"], t = 0.25 }\nN2 = { on = [\"A2\", \"A3\"], t = 0.25 }\nN3 = { on = [\"A3\", \"A1\"], t = 0.25 }\n[platform]\nB1 = { radius = 50, angle_deg = 60 }\nB2 = { radius = 50, angle_deg = 180 }\nB3 = { radius = 50, angle_deg = 300 }\nM1 = { on = [\"B1\", \"B2\"], t = 0.75 }\nM2 = { on = [\"B2\", \"B3\"], t = 0.75 }\nM3 = { on = [\"B3\", \"B1\"], t = 0.75 }\n[home]\nposition = [0, 0, 80]\nrpy_deg = [0, 0, 0]\n";
    let cyclic = [[0., 45., 90., 150., 225., 300.], [60., 105., 150., 210., 285., 0.]];
    let regular = [[0., 60., 120., 180., 240., 300.], [30., 90., 150., 210., 270., 330.]];
    for (name, text) in [
        ("h12", midline.to_owned()),
        ("h13", polar(cyclic, [90.0, 50.0])),
        ("h14", polar(regular, [90.0, 50.0])),
    ] {
        let (_folder, path) = file("design.toml", &text);
        let (code, doc) = answer(&["check", &path]);
        assert_eq!((code, &doc["architecturally_singular"]), (Some(1), &true.into()), "{name}: {doc}");
        assert!(!doc["joints"]["exactness"].is_null(), "{name}: {doc}");
    }
}

#[test]
fn twelve_digits_of_the_usual_hexapod_have_all_real_poses_proved_h17() {
    let mut table = "bx,by,bz,px,py,pz\n".to_owned();
    for leg in 0..6 {
        let words: Vec<String> =
            [joint(0, leg), joint(1, leg)].concat().iter().map(|x| format!("{x:.12}")).collect();
        let _ = writeln!(table, "{}", words.join(","));
    }
    let (folder, path) = file("usual.csv", &table);
    let design = folder.path().join("usual.toml").to_str().unwrap().to_owned();
    let snapped = folder.path().join("snapped.toml").to_str().unwrap().to_owned();
    answer(&["new", "--points", &path, "--height", "110", "-o", &design]);
    answer(&["new", "--points", &path, "--height", "110", "--snap", "-o", &snapped]);
    let (code, typed) = answer(&["fk", &design]);
    assert_eq!((code, &typed["completeness"]), (Some(0), &"proved_bounded".into()), "{typed}");
    let (code, exact) = answer(&["fk", &snapped]);
    assert_eq!((code, &exact["completeness"]), (Some(0), &"proved".into()), "{exact}");
    assert_eq!(typed["real_count"], exact["real_count"]);
    assert_eq!(typed["finite_count"], exact["finite_count"]);
}

#[test]
fn an_assembly_with_y_up_keeps_its_lengths_h20() {
    // the same machine with (x, y, z) written as (x, z, -y)
    let mut table = "leg,top_x,top_y,top_z,bottom_x,bottom_y,bottom_z\n".to_owned();
    for leg in 0..6 {
        let ([x, y, _], [u, v, _]) = (joint(0, leg), joint(1, leg));
        let _ = writeln!(table, "{},{u:.4},0,{:.4},{x:.4},{},{:.4}", leg + 1, -v, -HEIGHT, -y);
    }
    let doc = made("assembly.csv", &table, &[]);
    is_meant("assembly.csv", &doc, 1.0);
    assert!(doc["guesses"].to_string().contains("y is up"), "{doc}");
}

#[test]
fn servos_in_mirror_pairs_have_equal_angles_at_home_h21() {
    let copies = |body: &str, first: &str| {
        format!(
            "[{body}]\n{first}{p}6 = {{ mirror = \"{p}1\", plane = \"xz\" }}\n{p}2 = {{ turn = \"{p}6\", deg = 120 }}\n{p}3 = {{ turn = \"{p}1\", deg = 120 }}\n{p}4 = {{ turn = \"{p}6\", deg = 240 }}\n{p}5 = {{ turn = \"{p}1\", deg = 240 }}\n",
            p = if body == "base" { "A" } else { "B" }
        )
    };
    let mut text = "name = \"servos\"\nunits = \"mm\"\ndrive = \"rotary\"\nlegs = [[\"A1\",\"B1\"],[\"A2\",\"B2\"],[\"A3\",\"B3\"],[\"A4\",\"B4\"],[\"A5\",\"B5\"],[\"A6\",\"B6\"]]\n".to_owned();
    text += &copies("base", "A1 = [88, 34, 0]\n");
    text += &copies("platform", "B1 = [52, 58, 0]\n");
    text += "[cranks]\nlength = 25\nrod_length = 150\naxis = [1, 0, 0]\nzero = [0, 1, 0]\nelbow = \"minus\"\nangle_deg = [-90, 90]\n[cranks.A1]\n[cranks.A6]\nmirror = \"A1\"\nplane = \"xz\"\n";
    for (crank, turn, degrees) in [("A2", "A6", 120), ("A3", "A1", 120), ("A4", "A6", 240), ("A5", "A1", 240)]
    {
        let _ = writeln!(text, "[cranks.{crank}]\nturn = \"{turn}\"\ndeg = {degrees}");
    }
    text += "[home]\nposition = [0, 0, 140]\nrpy_deg = [0, 0, 0]\n";
    let (_folder, path) = file("servos.toml", &text);
    let (code, doc) = answer(&["ik", &path]);
    assert_eq!(code, Some(0), "{doc}");
    let angles: Vec<f64> = (0..6).map(|leg| doc["angles_deg"][leg].as_f64().unwrap()).collect();
    assert!(angles.iter().all(|angle| (angle - angles[0]).abs() < 1e-9), "{angles:?}");
    let (_, limits) = answer(&["limits", &path]);
    let yaw = limits["axes"].as_array().unwrap().iter().find(|range| range["axis"] == "yaw").unwrap();
    let free = |side: &str| yaw[side]["free"].as_f64().unwrap_or_else(|| panic!("{yaw}"));
    assert!((free("back") - free("forth")).abs() < 1e-6 * free("forth"), "{yaw}");
}

#[test]
fn ends_apart_by_noise_of_cad_are_shared_joints_h23() {
    let corner = |k: usize, n: usize| {
        let (s, c) = ([90.0, 30.0][k] + 120.0 * n as f64).to_radians().sin_cos();
        [RADII[k] * c, RADII[k] * s, 0.0]
    };
    let mut table = "bx,by,bz,px,py,pz\n".to_owned();
    for leg in 0..6_usize {
        let (base, platform) = (corner(0, leg / 2), corner(1, leg.div_ceil(2) % 3));
        let noise = |k: usize| [1e-6, -1e-6, 0.0][(leg + k) % 3];
        let words: Vec<String> =
            base.iter().chain(&platform).enumerate().map(|(k, x)| format!("{:.6}", x + noise(k))).collect();
        let _ = writeln!(table, "{}", words.join(","));
    }
    let (folder, path) = file("noise.csv", &table);
    let design = folder.path().join("noise.toml").to_str().unwrap().to_owned();
    let snapped = folder.path().join("snapped.toml").to_str().unwrap().to_owned();
    answer(&["new", "--points", &path, "--height", "110", "-o", &design]);
    let (_, doc) = answer(&["new", "--points", &path, "--height", "110", "--snap", "-o", &snapped]);
    assert!(doc["guesses"].to_string().contains("at the places of other joints"), "{doc}");
    for path in [&design, &snapped] {
        let (code, doc) = answer(&["fk", path]);
        assert_eq!((code, &doc["finite_count"]), (Some(0), &16.into()), "{path}: {doc}");
    }
}
