//! `equipod calibrate` as a process: a table in, joints and offsets out, outcomes, refusals.

use equipod::prelude::*;
use serde_json::Value;

use super::cli_frame::{document, equipod};

const DESIGN: &str = "designs/symmetric-hexapod.toml";
const TABLE: &str = "designs/tables/calibration.csv";
const SIGMAS: [&str; 6] =
    ["--sigma-length", "0.005", "--sigma-position", "0.01", "--sigma-rotation-deg", "0.002"];

fn asked(args: &[&str]) -> (Option<i32>, Value) {
    let out = equipod(&[&["calibrate"], args, &["--json"]].concat());
    (out.status.code(), document(&out))
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// The measurements as fields; the first row has the names.
fn table() -> Vec<Vec<String>> {
    let text = std::fs::read_to_string(TABLE).unwrap();
    text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

fn write(folder: &tempfile::TempDir, name: &str, rows: &[Vec<String>]) -> String {
    let path = folder.path().join(name);
    std::fs::write(&path, rows.iter().map(|r| r.join(",") + "\n").collect::<String>()).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn measurements_give_joints_offsets_and_a_design_with_their_uncertainty() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let out = path("calibrated.toml");
    let (code, doc) = asked(&[&[DESIGN, TABLE, "-o", &out], SIGMAS.as_slice()].concat());
    assert_eq!((code, &doc["outcome"]), (Some(0), &Value::from("calibrated")), "{}", doc["reason"]);
    let found = &doc["calibration"];
    assert_eq!((found["unknowns"].as_u64(), found["observability"]["rank"].as_u64()), (Some(42), Some(42)));
    assert_eq!(
        (found["start"]["agree"].as_bool(), found["noise"]["source"].as_str()),
        (Some(true), Some("given"))
    );
    assert!(number(&found["before"]["rms"]) > 20.0 * number(&found["after"]["rms"]));
    assert!(number(&found["leave_one_out"]["rms"]) > number(&found["after"]["rms"]));
    assert!(number(&found["chi_square"]["probability"]) > 1e-3);
    let computed = &found["computed_poses"];
    let off = number(&computed["position_greatest"]);
    // of the size of the residuals, where single joints are off by ten times as much
    assert!(off < 2.0 * number(&found["after"]["rms"]), "{computed}");
    assert!(off > number(&computed["position_median"]), "{computed}");
    let next = doc["next_poses"].as_array().unwrap();
    assert!(next.len() == 5 && next.iter().all(|n| number(&n["shrinks"]) < 1.0));
    // deviations are the roots of the diagonal of the covariance
    let names = found["covariance"]["unknowns"].as_array().unwrap();
    let k = names.iter().position(|n| n == "platform.B2.y").unwrap();
    let joint = found["joints"].as_array().unwrap().iter().find(|j| j["joint"] == "B2").unwrap();
    let deviation = number(&joint["deviations"][1]);
    assert!((deviation.powi(2) / number(&found["covariance"]["matrix"][k][k]) - 1.0).abs() < 1e-12);

    // the design has the joints, and the table stays when it is converted
    let text = std::fs::read_to_string(&out).unwrap();
    assert!(
        text.contains("[calibration]\noffsets = [") && text.contains("[calibration.base_deviations]"),
        "{text}"
    );
    let json = path("calibrated.json");
    assert!(equipod(&["design", "convert", &out, "-o", &json]).status.success());
    let design: Value = serde_json::from_str(&std::fs::read_to_string(&json).unwrap()).unwrap();
    assert_eq!(design["platform"]["B2"], joint["position"]);
    assert_eq!(design["calibration"]["platform_deviations"]["B2"], joint["deviations"]);
    let micrometres = path("um.json");
    assert!(equipod(&["design", "convert", &out, "--units", "um", "-o", &micrometres]).status.success());
    let scaled: Value = serde_json::from_str(&std::fs::read_to_string(&micrometres).unwrap()).unwrap();
    let offset = |d: &Value| number(&d["calibration"]["offsets"][0]);
    assert!((offset(&scaled) / offset(&design) - 1000.0).abs() < 1e-6);

    // a second calibration begins at the first one
    let (code, again) = asked(&[&[&out, TABLE], SIGMAS.as_slice()].concat());
    assert_eq!(code, Some(0));
    assert!(number(&again["calibration"]["before"]["rms"]) < 1.01 * number(&found["after"]["rms"]));

    // tolerances by the deviations found, and exports with the offsets
    let tolerances = |design: &str| {
        let words =
            ["build", "tolerances", design, "--bound", "0.1,0.05", "--points", "10", "--searches", "0"];
        let out = equipod(&[words.as_slice(), &["--trials", "100", "--calibrated", "--json"]].concat());
        (out.status.code(), document(&out))
    };
    let (code, doc) = tolerances(&out);
    assert_eq!((code, doc["calibrated"]["count"].as_u64()), (Some(0), Some(100)), "{doc}");
    assert!(number(&doc["calibrated"]["formula"]["position"]["median"]) > 0.0);
    let (code, doc) = tolerances(DESIGN);
    assert_eq!((code, doc["error"]["code"].as_str()), (Some(2), Some("tolerances::not_calibrated")));
    let files = path("files");
    assert!(equipod(&["export", &out, "--to", "hal,c,json", "-o", &files]).status.success());
    let read = |name: &str| {
        let mut found = ["", "hal/", "c/", "json/"].iter().map(|f| format!("{files}/{f}{name}"));
        found.find_map(|path| std::fs::read_to_string(path).ok()).unwrap_or_else(|| panic!("{name}"))
    };
    assert!(read("genhexkins.hal").contains("# Leg offsets of the calibration: "));
    assert!(read("equipod_design.h").contains("EQUIPOD_HAS_LEG_OFFSETS 1"));
    assert!(read("equipod_design.c").contains("const real_t equipod_leg_offsets[6] = {R("));
    assert!(read("platform.json").contains("\"offset\":"));
}

/// A pose of a calibrated machine has the same covariance in the answers of `ik` and `fk --near`, and from the exported
/// files. A design without a calibration has none.
#[test]
fn poses_and_exports_of_a_calibrated_machine_say_how_uncertain_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let out = path("calibrated.toml");
    assert_eq!(asked(&[&[DESIGN, TABLE, "-o", &out], SIGMAS.as_slice()].concat()).0, Some(0));
    let answer = |args: &[&str]| {
        let out = equipod(&[args, &["--json"]].concat());
        assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stderr));
        document(&out)
    };
    let pose = "--pose=3,-4,205,2,-3,4";
    let ik = answer(&["ik", &out, pose]);
    let uncertainty = &ik["uncertainty"];
    assert_eq!(uncertainty["correlations"], "design");
    let entry = |i: usize, j: usize| number(&uncertainty["covariance"][i][j]);
    let trace = |from: usize| (from..from + 3).map(|k| entry(k, k)).sum::<f64>().sqrt();
    assert!((trace(0) / number(&uncertainty["position"]) - 1.0).abs() < 1e-12);
    assert!((trace(3) / number(&uncertainty["rotation_deg"]) - 1.0).abs() < 1e-12);
    let lengths: Vec<String> =
        ik["lengths"].as_array().unwrap().iter().map(|l| number(l).to_string()).collect();
    let fk = answer(&["fk", &out, "--lengths", &lengths.join(","), "--near", "home"]);
    let near = &fk["near"]["uncertainty"];
    for (i, j) in (0..6).flat_map(|i| (0..6).map(move |j| (i, j))) {
        let unit = (entry(i, i) * entry(j, j)).sqrt();
        assert!((number(&near["covariance"][i][j]) - entry(i, j)).abs() < 1e-6 * unit, "{i} {j}");
    }
    assert!(answer(&["ik", DESIGN, pose]).get("uncertainty").is_none());

    // The numbers of the exported document are compared with the definition. Derivatives of the pose by differences of
    // Newton's method are those of J^-1 and the directions of the legs.
    let files = path("files");
    assert!(equipod(&["export", &out, "--to", "c,csv,json,hal,matlab,mjcf", "-o", &files]).status.success());
    let read = |name: &str| {
        let mut found = ["", "c/", "csv/", "json/", "hal/", "matlab/", "mjcf/"]
            .iter()
            .map(|f| format!("{files}/{f}{name}"));
        found.find_map(|path| std::fs::read_to_string(path).ok()).unwrap_or_else(|| panic!("{name}"))
    };
    let doc: Value = serde_json::from_str(&read("platform.json")).unwrap();
    let exported = &doc["calibration"];
    let names: Vec<&str> =
        exported["unknowns"].as_array().unwrap().iter().map(|n| n.as_str().unwrap()).collect();
    let place = |name: String| names.iter().position(|n| *n == name).unwrap();
    let covariance = |p: usize, q: usize| {
        let deviation = |k: usize| number(&exported["deviations"][k]);
        number(&exported["correlations"][p.max(q)][p.min(q)]) * deviation(p) * deviation(q)
    };
    let j = nalgebra::Matrix6::from_fn(|i, k| number(&ik["J"][i][k]));
    let r = nalgebra::Matrix3::from_fn(|i, k| number(&ik["pose"]["R"][i][k]));
    let mut errors = nalgebra::DMatrix::zeros(6, names.len());
    for (i, leg) in doc["legs"].as_array().unwrap().iter().enumerate() {
        let u = nalgebra::Vector3::new(j[(i, 0)], j[(i, 1)], j[(i, 2)]);
        let back = r.transpose() * u;
        for (k, axis) in ["x", "y", "z"].iter().enumerate() {
            let [base, platform] = ["base", "platform"]
                .map(|body| format!("{body}.{}.{axis}", leg[&format!("{body}_joint")].as_str().unwrap()));
            errors[(i, place(base))] = -u[k];
            errors[(i, place(platform))] = back[k];
        }
        errors[(i, place(format!("offset.{}", i + 1)))] = 1.0;
    }
    let all = nalgebra::DMatrix::from_fn(names.len(), names.len(), covariance);
    let inverse = j.try_inverse().unwrap();
    let found = inverse * (&errors * all * errors.transpose()) * inverse.transpose();
    let unit = |k: usize| if k < 3 { 1.0 } else { 1_f64.to_degrees() };
    for (i, k) in (0..6).flat_map(|i| (0..6).map(move |k| (i, k))) {
        let off = (found[(i, k)] * unit(i) * unit(k) - entry(i, k)).abs();
        assert!(off < 1e-8 * (entry(i, i) * entry(k, k)).sqrt(), "{i} {k}: {off}");
    }
    let table = read("calibration.csv");
    let rows: Vec<&str> = table.lines().filter(|line| !line.starts_with('#')).collect();
    assert_eq!((rows.len(), rows[0].split(',').count()), (43, 45), "{table}");
    let cells: Vec<&str> = rows[1 + 5].split(',').collect();
    assert_eq!((cells[0], cells[3 + 5]), (names[5], "1.0"));
    assert!(read("equipod_design.h").contains("EQUIPOD_HAS_CALIBRATION 1"));
    assert!(read("equipod_design.c").contains("const real_t equipod_calibration[42][42] = {"));

    // the others have the same numbers in metres, or say what they leave out
    let metres = |k: usize| number(&exported["deviations"][k]) / 1e3;
    let near =
        |found: f64, expected: f64| assert!((found - expected).abs() <= 1e-12 * expected.abs().max(1e-9));
    let script = read("platform.m");
    let block = |name: &str| -> Vec<Vec<f64>> {
        let from = script.find(&format!("stewart.{name} = [")).unwrap_or_else(|| panic!("{name}"));
        let rows = script[from..].lines().skip(1).take_while(|line| *line != "];");
        let row =
            |line: &str| line.trim().trim_end_matches(';').split(", ").map(|x| x.parse().unwrap()).collect();
        rows.map(row).collect()
    };
    let (deviations, correlations) = (block("deviations"), block("correlations"));
    assert_eq!((deviations.len(), correlations.len(), block("offsets").len()), (42, 42, 6));
    assert!(script.contains(&format!("stewart.unknowns = {{'{}'; ", names[0])));
    let model = read("platform.xml");
    let numeric = |name: &str| -> Vec<f64> {
        let from = format!("<numeric name=\"{name}\" data=\"");
        let rest = &model[model.find(&from).unwrap_or_else(|| panic!("{name}")) + from.len()..];
        rest[..rest.find('"').unwrap()].split(' ').map(|x| x.parse().unwrap()).collect()
    };
    let custom = numeric("calibration_deviations");
    assert_eq!((custom.len(), numeric("leg_offsets").len()), (42, 6));
    for i in 0..42 {
        near(deviations[i][0], metres(i));
        near(custom[i], metres(i));
        let row = numeric(&format!("calibration_correlations_{}", i + 1));
        for (j, value) in row.iter().enumerate() {
            near(*value, number(&exported["correlations"][i.max(j)][i.min(j)]));
            near(correlations[i][j], *value);
        }
    }
    let pins = read("genhexkins.hal");
    let said = |k: usize| {
        let line = pins.lines().find_map(|l| l.strip_prefix(&format!("#   {} ", names[k])));
        line.unwrap_or_else(|| panic!("{pins}")).parse::<f64>().unwrap()
    };
    near(said(0), number(&exported["deviations"][0]));
    assert!(pins.contains("their correlations are not written here"), "{pins}");
}

#[test]
fn the_noise_is_estimated_and_frames_are_carried() {
    let (code, doc) = asked(&[DESIGN, TABLE, "--frames", "design", "--next", "0"]);
    assert_eq!(code, Some(0), "{}", doc["reason"]);
    let found = &doc["calibration"];
    assert_eq!(found["noise"]["source"], "estimated");
    let length = number(&found["noise"]["length"]);
    assert!(length > 0.005 && length < 0.03, "lengths and poses together: {length}");
    assert!(found["chi_square"]["probability"].is_null());
    let motion = &found["motions"]["base"];
    assert!(number(&motion["rms"]) < 1.0 && number(&motion["motion"]["R"][0][0]) > 0.99);
    // carried joints are nearer to the design
    let moved = |doc: &Value| {
        let joints = doc["calibration"]["joints"].as_array().unwrap().clone();
        let square = |x: &Value| number(x).powi(2);
        joints
            .iter()
            .flat_map(|j| j["moved"].as_array().unwrap().iter().map(square).collect::<Vec<_>>())
            .sum::<f64>()
    };
    let (_, measured) = asked(&[DESIGN, TABLE, "--next", "0"]);
    assert!(moved(&doc) < moved(&measured));
}

#[test]
#[ignore = "evidence"]
fn what_cannot_be_said_is_an_outcome_and_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let rows = table();
    let out = folder.path().join("out.toml").to_str().unwrap().to_owned();
    // one orientation, and the lengths that belong to it
    let design = Design::load(DESIGN).unwrap();
    let level: Vec<Vec<String>> = rows
        .iter()
        .enumerate()
        .map(|(k, row)| {
            if k == 0 {
                return row.clone();
            }
            let turned = [&row[..3], &["1.0", "1.0", "1.0"].map(str::to_owned)].concat();
            let pose: Pose = turned.join(",").parse().unwrap();
            let lengths = pose.lengths(design.manipulator()).unwrap().get();
            turned.into_iter().chain(lengths.map(|l| l.to_string())).collect()
        })
        .collect();
    let file = write(&folder, "level.csv", &level);
    let (code, doc) = asked(&[&[DESIGN, &file, "-o", &out], SIGMAS.as_slice()].concat());
    assert_eq!((code, &doc["outcome"]), (Some(1), &Value::from("not_identifiable")), "{}", doc["reason"]);
    assert!(doc["path"].is_null() && !std::path::Path::new(&out).exists());
    let unseen = doc["calibration"]["observability"]["unobservable"].as_array().unwrap();
    assert!(unseen.len() >= 18, "three a leg, and what such short ways do not tell apart: {unseen:?}");
    let names = |change: &Value| -> Vec<String> {
        let joints = change["joints"].as_array().unwrap().iter();
        joints.map(|j| j["joint"].as_str().unwrap().to_owned()).collect()
    };
    let together = |change: &&Value| matches!(&names(change)[..], [a, b] if a[1..] == b[1..] && a != b);
    assert!(unseen.iter().filter(together).count() >= 12, "{unseen:?}");

    // a wrong measurement refutes the model, unless the loss takes it for possible
    let mut wrong = rows.clone();
    wrong[12][0] = format!("{}", wrong[12][0].parse::<f64>().unwrap() + 0.7);
    let file = write(&folder, "wrong.csv", &wrong);
    let (code, doc) = asked(&[&[DESIGN, &file], SIGMAS.as_slice()].concat());
    assert_eq!((code, &doc["outcome"]), (Some(1), &Value::from("refuted")));
    let (code, doc) = asked(&[&[DESIGN, &file, "--loss", "tukey"], SIGMAS.as_slice()].concat());
    assert_eq!((code, &doc["outcome"]), (Some(0), &Value::from("calibrated")), "{}", doc["reason"]);
    let outliers = doc["calibration"]["outliers"].as_array().unwrap();
    assert_eq!((outliers.len(), outliers[0]["line"].as_u64()), (1, Some(13)));

    // as many numbers as unknowns: nothing speaks for or against
    let seven = write(&folder, "seven.csv", &rows[..8]);
    let (code, doc) = asked(&[DESIGN, &seven, "--identified", "10"]);
    assert_eq!((code, &doc["outcome"]), (Some(3), &Value::from("undecided")), "{}", doc["reason"]);
    assert_eq!(doc["calibration"]["noise"]["source"], "assumed");

    // a part of the measurements checks the rest
    let (first, rest) = (write(&folder, "first.csv", &rows[..46]), [&rows[..1], &rows[46..]].concat());
    let rest = write(&folder, "rest.csv", &rest);
    let (code, doc) = asked(&[&[DESIGN, &first, "--check", &rest], SIGMAS.as_slice()].concat());
    assert_eq!(code, Some(0));
    let check = &doc["calibration"]["check"];
    assert_eq!(check["count"], 90);
    assert!(number(&check["rms"]) < 0.06, "{check}");
}

#[test]
fn poses_are_planned_before_anything_is_measured() {
    let (code, doc) = asked(&[DESIGN, "--sigma-length", "0.005", "--next", "12", "--candidates", "60"]);
    assert_eq!((code, &doc["outcome"]), (Some(0), &Value::from("planned")));
    let deviations: Vec<f64> =
        doc["next_poses"].as_array().unwrap().iter().map(|n| number(&n["greatest_deviation"])).collect();
    assert!(deviations.len() == 12 && deviations[11] < 0.2 * deviations[0], "{deviations:?}");
    let out = equipod(&["calibrate", DESIGN, "--next", "3"]);
    let text = String::from_utf8(out.stdout).unwrap();
    assert!(text.contains("poses to measure first") && text.lines().count() == 7, "{text}");
}

#[test]
fn what_is_no_question_is_refused_with_a_code() {
    let folder = tempfile::tempdir().unwrap();
    let short =
        write(&folder, "short.csv", &[vec!["1,2,3,4,5,6,7".into()], vec!["1,2,3,0,0,0,1,2,3,4,5,x".into()]]);
    for (args, code) in [
        (vec![DESIGN, &short], "calibrate::bad_measurements"),
        (vec![DESIGN, "no-such.csv"], "file::not_readable"),
        (vec![DESIGN, TABLE, "--sigma-length", "-1"], "calibrate::bad_noise"),
        (vec![DESIGN, "--sigma-length", "0"], "calibrate::bad_noise"),
        (vec![DESIGN, TABLE, "--identified", "0"], "calibrate::bad_share"),
        (vec![DESIGN, TABLE, "--hold", "base,platform,offsets"], "calibrate::nothing_unknown"),
        (vec![DESIGN, TABLE, "--loss-of", "leg"], "usage::no_effect"),
        (vec![DESIGN, "--loss", "huber"], "usage::no_effect"),
        (vec![DESIGN, TABLE, "-o", TABLE], "file::overwrites_input"),
        (vec![DESIGN, TABLE, "-o", DESIGN], "file::overwrites_input"),
    ] {
        let (exit, doc) = asked(&args);
        assert_eq!((exit, &doc["error"]["code"]), (Some(2), &Value::from(code)), "{args:?}: {doc}");
    }
    let (_, doc) = asked(&[DESIGN, &short]);
    assert!(doc["error"]["message"].as_str().unwrap().contains("line 2: length 6, `x`"), "{doc}");
}

#[test]
fn the_text_says_what_was_found() {
    let out = equipod(&[&["calibrate", DESIGN, TABLE, "--loss", "huber"], SIGMAS.as_slice()].concat());
    let text = String::from_utf8(out.stdout).unwrap();
    for part in [
        "symmetric hexapod: calibrated: all 42 unknowns are identified",
        "noise (given): length 0.005 mm, position 0.01 mm, rotation 0.002 deg",
        "the other start gives the same machine",
        "leave-one-out",
        "chi-square",
        "platform.B6",
        "leg offset [mm]",
        "observability: volume",
        "poses to measure next",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

/// Joints of the hexapod machine tool of Nategh and Agheli (2009) as measured: x, y, z of base and platform.
const REAL: [[[f64; 3]; 6]; 2] = [
    [
        [305.2599, 115.0695, 2.6210],
        [-55.2814, 322.9819, 4.2181],
        [-244.7954, 208.0087, 3.9365],
        [-252.5755, -211.8783, -3.0128],
        [-53.9678, -320.6115, 4.3181],
        [302.4266, -109.4351, 3.3812],
    ],
    [
        [96.6610, 81.7602, 1.0684],
        [22.2476, 125.2511, -0.5530],
        [-122.4519, 36.6453, 4.3547],
        [-120.6859, -34.4565, -4.9014],
        [24.7769, -125.0489, -4.8473],
        [91.3462, -80.9866, 0.2515],
    ],
];

/// Simulated measurements of that machine from its nominal design, with six or three of 240 lengths wrong by 5 mm.
/// Every robust loss names the wrong poses, and finds the machine as far as the other poses see it. Without the six
/// poses one change in 42 is less certain than a hundredth of the size. The losses that give them no weight say so.
#[test]
fn gross_lengths_are_named_and_the_machine_is_found_all_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("calibrated.toml");
    let out = out.to_str().unwrap();
    for (table, gross) in [("six", 6), ("three", 3)] {
        let table = format!("tests/fixtures/gross-lengths/{table}.csv");
        for loss in ["huber", "cauchy", "tukey"] {
            let nominal = "tests/fixtures/gross-lengths/nominal.toml";
            let sigmas =
                ["--sigma-length", "0.01", "--sigma-position", "0.02", "--sigma-rotation-deg", "0.005"];
            let (code, doc) = asked(&[&[nominal, &table, "--loss", loss, "-o", out][..], &sigmas].concat());
            let place = format!("{table} {loss}");
            let outliers = doc["calibration"]["outliers"].as_array().unwrap();
            let mut lines: Vec<u64> = outliers.iter().map(|o| o["line"].as_u64().unwrap()).collect();
            lines.sort_unstable();
            assert_eq!(lines, (2..2 + gross).collect::<Vec<_>>(), "{place}: {outliers:?}");
            if gross == 6 && loss != "huber" {
                assert_eq!((code, &doc["outcome"]), (Some(1), &"not_identifiable".into()), "{place}");
                assert_eq!(doc["calibration"]["observability"]["rank"], 41, "{place}");
                continue;
            }
            assert_eq!(
                (code, &doc["outcome"]),
                (Some(0), &"calibrated".into()),
                "{place}: {}",
                doc["reason"]
            );
            let found = equipod::prelude::Design::load(out).unwrap();
            for (k, leg) in found.manipulator().legs().iter().enumerate() {
                for (body, point) in [leg.base, leg.platform].iter().enumerate() {
                    let real = nalgebra::Point3::from(REAL[body][k]);
                    // by 70 to 134 mm where gross errors drew the fit elsewhere
                    assert!((point - real).norm() < 4.0, "{place}: leg {k} {point} {real}");
                }
            }
            std::fs::remove_file(out).unwrap();
        }
    }
}

/// A calibrated design speaks of the lengths that its legs show: from `ik` through `fk` back to the pose, and in the
/// tables of `export`.
#[test]
fn lengths_of_a_calibrated_machine_are_those_that_its_legs_show() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let out = path("calibrated.toml");
    assert_eq!(asked(&[&[DESIGN, TABLE, "-o", &out], SIGMAS.as_slice()].concat()).0, Some(0));
    let design = equipod::Design::load(&out).unwrap();
    let offsets = design.leg_offsets();
    assert!(offsets.iter().all(|d| d.abs() > 0.01), "{offsets:?}");
    let pose = equipod::Pose::new(
        nalgebra::Vector3::new(3.0, -4.0, 205.0),
        equipod::Angles::from_degrees([2.0, -3.0, 4.0]),
    );
    let distances = pose.lengths(design.manipulator()).unwrap().get();
    let shown: [f64; 6] = std::array::from_fn(|i| distances[i] + offsets[i]);
    let answer = |args: &[&str]| {
        let out = equipod(&[args, &["--json"]].concat());
        assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stderr));
        document(&out)
    };
    let text = "3,-4,205,2,-3,4";
    let ik = answer(&["ik", &out, "--pose", text]);
    let near = |x: &Value, y: f64| assert!((number(x) - y).abs() < 1e-9, "{x} {y}");
    (0..6).for_each(|i| near(&ik["lengths"][i], shown[i]));
    let lengths = shown.map(|l| l.to_string()).join(",");
    let at = |solution: &Value| (0..3).map(|k| number(&solution["p"]["re"][k])).collect::<Vec<_>>();
    let fk = answer(&["fk", &out, "--lengths", &lengths]);
    let all: Vec<_> = fk["solutions"].as_array().unwrap().iter().map(at).collect();
    let expected = [3.0, -4.0, 205.0];
    let off = |p: &Vec<f64>| (0..3).map(|k| (p[k] - expected[k]).abs()).fold(0.0, f64::max);
    assert!(all.iter().any(|p| off(p) < 1e-6), "{all:?}");
    let followed = answer(&["fk", &out, "--near", "home", "--lengths", &lengths]);
    assert!(off(&at(&followed["solutions"][0])) < 1e-6, "{followed}");
    // the library: the same question, the same answer
    let own = design.ik(&pose).unwrap().get();
    assert!((0..6).all(|i| (own[i] - shown[i]).abs() < 1e-12), "{own:?}");
    let mut tracker = design.tracker(design.home_or_default());
    let _ = tracker.step(shown).unwrap();
    assert!((tracker.pose().position - pose.position).norm() < 1e-6);
    let found = design.solver(equipod::FkOptions::new()).solve(shown).unwrap();
    let nearest =
        found.real_poses().map(|p| (p.position - pose.position).norm()).fold(f64::INFINITY, f64::min);
    assert!(nearest < 1e-6);
    // and the tables of a machine as it stands at home
    let files = path("files");
    assert!(equipod(&["export", &out, "--to", "csv", "-o", &files]).status.success());
    let table = std::fs::read_to_string(format!("{files}/lengths-workspace.csv")).unwrap();
    let first = table.lines().find(|line| line.starts_with("1,")).unwrap();
    let cells: Vec<f64> = first.split(',').map(|x| x.parse().unwrap()).collect();
    let home = design.ik(&design.home_or_default()).unwrap().get();
    assert!((0..6).all(|i| (cells[8 + i] - home[i]).abs() < 1e-9), "{table}");
}

/// Two columns of the table in each other's place are named, on the terminal too.
#[test]
fn columns_of_two_legs_in_each_others_place_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let mut rows = table();
    rows[1..].iter_mut().for_each(|row| row.swap(7, 10));
    let wired = &write(&folder, "wired.csv", &rows);
    let (_, doc) = asked(&[&[DESIGN, wired.as_str()], SIGMAS.as_slice()].concat());
    assert_eq!(doc["calibration"]["exchanged_legs"], serde_json::json!([2, 5]));
    let said = equipod(&[&["calibrate", DESIGN, wired.as_str()], SIGMAS.as_slice()].concat());
    let text = String::from_utf8_lossy(&said.stdout).into_owned();
    assert!(text.contains("lengths of legs 2 and 5 are five times nearer"), "{text}");
    let (_, doc) = asked(&[&[DESIGN, TABLE], SIGMAS.as_slice()].concat());
    assert!(doc["calibration"]["exchanged_legs"].is_null());
}
