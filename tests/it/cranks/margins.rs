//! Requirements of cranks: margins at a pose, less their safety margins, and proved over the workspace.

use std::f64::consts::TAU;

use equipod::methods::design::{Format, parse_with_cranks};
use equipod::methods::geom::Pose;
use equipod::methods::requirements::{AssessOptions, MarginVerdict, TermKind, Terms};
use nalgebra::Vector3;

use super::{HEAD, LIMITS, SERVOS, asked, drawn, limited};
use crate::cli_frame::{document, equipod};

/// Margins of cranks less their safety margins, as rows of the answer.
#[test]
fn safety_margins_of_cranks_are_taken_off_their_margins() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("r.toml");
    let text = SERVOS.replace("max_torque = 1500", LIMITS).replace(
        "[speed]\nlinear = 50",
        "[workspace]\ntranslation = [3, 3, 3]\nrotation_deg = [2, 2, 2]\n[limits.safety_margin]\nmin_rod_length = 0.5\ncrank_transmission = \"10%\"\ncrank_angle = 4\ncrank_torque = \"50%\"\ntip_angle = \"25%\"\ncrank_speed = 400\n[speed]\nlinear = 50\nangular_deg = 30",
    );
    // angles about those at home, which are 150 degrees
    let text = text.replace("angle_deg = [-80, \"60 + half\"]", "angle_deg = [100, 190]");
    let text = text.replace("max_speed_deg = 300", "max_speed_deg = 500");
    std::fs::write(&path, text).unwrap();
    let args = ["assess", path.to_str().unwrap(), "--cells", "250", "--points", "50", "--searches", "1"];
    let (code, doc) = asked(&args);
    let row = |name: &str| {
        let rows = doc["requirements"].as_array().unwrap_or_else(|| panic!("{doc}"));
        rows.iter().find(|r| r["name"] == name).unwrap_or_else(|| panic!("{name}: {doc}"))
    };
    // shares are relative to the limit: 20 degrees, 1500 force mm, 40 degrees
    for (name, safety_margin) in [
        ("min_rod_length", 0.5),
        ("crank_transmission", 2.0),
        ("crank_angle", 4.0),
        ("crank_torque", 750.0),
        ("tip_angle", 10.0),
        ("crank_speed", 400.0),
        ("max_rod_length", 0.0),
    ] {
        let row = row(name);
        let of = |key: &str| row[key].as_f64().unwrap_or_else(|| panic!("{key}: {row}"));
        assert!((of("reserve") - safety_margin).abs() < 1e-12, "{row}");
        assert!((of("net_margin") - (of("margin") - safety_margin)).abs() < 1e-9, "{row}");
        // kept where that is proved, not kept where the margin found is less; the limits themselves are met
        assert_eq!(row["safety_margin_kept"] == false, of("margin") < safety_margin, "{row}");
        assert!(row["status"] != "violated", "{row}");
    }
    // the margin of a speed is positive, and less than the required safety margin
    assert!(row("crank_speed")["margin"].as_f64().unwrap() > 0.0, "{doc}");
    assert_eq!(
        (&row("crank_speed")["safety_margin_kept"], &doc["safety_margin_kept"]),
        (&false.into(), &false.into())
    );
    assert_eq!(row("min_rod_length")["safety_margin_kept"], true, "{doc}");
    assert!(matches!(code, Some(0 | 3)), "{doc}");
}

/// The rows at a pose against the kinematics of the cranks, which is other code.
#[test]
fn margins_of_cranks_are_those_of_their_kinematics() {
    let design = limited();
    let platform = design.rotary().unwrap().unwrap();
    let required = design.requirements();
    let home = design.home.unwrap();
    let terms = Terms::new(design.manipulator(), &required, &home);
    let rods = |pose: &Pose, angles: &[f64; 6]| -> [Vector3<f64>; 6] {
        std::array::from_fn(|i| {
            let line = pose.transform(&platform.legs()[i].platform) - platform.tip(i, angles[i]);
            pose.rotation.inverse() * line.normalize()
        })
    };
    let at_home = rods(&home, &platform.ik(&home).unwrap());
    for pose in drawn(&design, 40, 2.0) {
        let angles = platform.ik(&pose).unwrap();
        let transmissions = platform.transmissions(&pose, &angles);
        let speeds = platform.greatest_speeds(&pose, &angles, 50.0, 30f64.to_radians()).unwrap();
        let load = &design.all_loads()[0];
        let torques = platform.torques(&pose, &angles, &load.wrench(design.manipulator(), &pose)).unwrap();
        let lines = rods(&pose, &angles);
        let left = platform.limit_margins(&angles);
        let found = terms.at(&pose);
        let margin = |kind: TermKind, i: usize| {
            found.iter().find(|(t, _)| t.kind == kind && t.first == i).unwrap_or_else(|| panic!("{kind:?}")).1
        };
        for i in 0..6 {
            let leg = &platform.legs()[i];
            let out = leg.crank.axis.dot(&(pose.rotation * lines[i])).abs().asin().to_degrees();
            let swung = lines[i].dot(&at_home[i]).clamp(-1.0, 1.0).acos().to_degrees();
            for (kind, meant) in [
                (TermKind::CrankTransmission, transmissions[i].abs().asin().to_degrees() - 20.0),
                (TermKind::CrankAngle, left[i].to_degrees()),
                (TermKind::TipAngle, 40.0 - out),
                (TermKind::PlatformConeAngle, 25.0 - swung),
                (TermKind::CrankSpeed, 300.0 - speeds[i].to_degrees()),
                (TermKind::CrankTorque, 1500.0 - torques[i].abs()),
            ] {
                let own = margin(kind, i);
                assert!((own - meant).abs() < 1e-6, "{kind:?} of {i}: {own} {meant}");
            }
            // the circle of the tip, point by point
            let joint = pose.transform(&leg.platform);
            let away = (0..7200).map(|k| (joint - platform.tip(i, f64::from(k) * TAU / 7200.0)).norm());
            let (least, most) = away.fold((f64::INFINITY, 0.0_f64), |(a, b), x| (a.min(x), b.max(x)));
            assert!((margin(TermKind::MinRodLength, i) - (leg.rod - least)).abs() < 1e-4);
            assert!((margin(TermKind::MaxRodLength, i) - (most - leg.rod)).abs() < 1e-4);
        }
    }
    // beyond reach the rows of reach and of the transmission are violated, and nothing breaks down
    let far = Pose { position: home.position + Vector3::z() * 80.0, ..home };
    let least = |kind: TermKind| {
        let own = terms.at(&far).into_iter().filter(|t| t.0.kind == kind).map(|t| t.1);
        own.fold(f64::INFINITY, f64::min)
    };
    assert!(platform.ik(&far).is_err() && least(TermKind::MinRodLength) < -30.0);
    assert!(least(TermKind::CrankTransmission) < -20.0 && least(TermKind::CrankTorque) == f64::NEG_INFINITY);
}

/// Proved margins of a workspace hold at poses that the proof did not examine, and each violation is shown by its pose.
#[test]
fn proved_margins_of_cranks_hold_over_the_workspace() {
    let design = limited();
    let required = design.requirements();
    let home = design.home.unwrap();
    let terms = Terms::new(design.manipulator(), &required, &home);
    let options = AssessOptions::new().points(50).searches(1);
    let found = design.assess_with(&options, 250).unwrap();
    let kinds: Vec<TermKind> = found.proof.bounds.iter().map(|b| b.found.term.kind).collect();
    for kind in [
        TermKind::PlatformConeAngle,
        TermKind::MinRodLength,
        TermKind::MaxRodLength,
        TermKind::CrankTransmission,
        TermKind::CrankAngle,
        TermKind::TipAngle,
        TermKind::CrankTorque,
        TermKind::CrankSpeed,
    ] {
        assert!(kinds.contains(&kind), "{kind:?}");
    }
    let all: Vec<_> = drawn(&design, 400, 1.0).iter().flat_map(|pose| terms.at(pose)).collect();
    for bound in &found.proof.bounds {
        let kind = bound.found.term.kind;
        let least = all.iter().filter(|t| t.0.kind == kind).map(|t| t.1).fold(f64::INFINITY, f64::min);
        assert!(
            bound.below <= least && bound.below <= bound.found.value + 1e-9,
            "{kind:?}: {bound:?} {least}"
        );
    }
    let reach = found.proof.bounds.iter().find(|b| b.found.term.kind == TermKind::MinRodLength).unwrap();
    assert_eq!(reach.verdict, MarginVerdict::Met, "{reach:?}");
    // one limit moved beyond the least margin found is violated, and is told so
    let expected =
        found.proof.bounds.iter().find(|b| b.found.term.kind == TermKind::CrankTransmission).unwrap();
    let more = expected.found.value + 20.0 + 0.5;
    let text = design
        .text()
        .replace("min_transmission_angle_deg = 20", &format!("min_transmission_angle_deg = {more}"));
    let strict = parse_with_cranks(&text, Format::Toml).unwrap().0;
    let found = strict.assess_with(&options, 250).unwrap();
    let row = found.proof.bounds.iter().find(|b| b.found.term.kind == TermKind::CrankTransmission).unwrap();
    assert_eq!((row.verdict, found.met()), (MarginVerdict::Violated, Some(false)), "{row:?}");
}

#[test]
fn the_head_is_assessed_and_keys_of_cranks_are_written() {
    let done = equipod(&["assess", HEAD, "--json", "--cells", "250", "--points", "50", "--searches", "1"]);
    let doc = document(&done);
    assert!(matches!(done.status.code(), Some(0 | 3)), "{doc}");
    let rows = doc["requirements"].as_array().unwrap();
    let names: Vec<&str> = rows.iter().map(|row| row["name"].as_str().unwrap()).collect();
    assert_eq!(
        names,
        ["min_rod_length", "max_rod_length", "crank_transmission", "crank_angle", "crank_torque"],
        "{doc}"
    );
    assert_eq!((&rows[0]["status"], &rows[2]["status"]), (&"met".into(), &"met".into()), "{doc}");
    assert!(rows[0]["proved_margin"].as_f64().unwrap() > 8.0 && rows[4]["unit"] == "N mm");
    assert!(rows.iter().all(|row| row["margin"].as_f64().unwrap() > 0.0), "{doc}");
    let design = limited();
    let (again, _) = parse_with_cranks(&design.to_toml(), Format::Toml).unwrap();
    assert_eq!((again.crank_limits(), &again), (design.crank_limits(), &design));
    assert_eq!(design.crank_limits().tip_angle_deg, Some(40.0));
}
