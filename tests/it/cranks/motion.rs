//! The free motion of platforms with cranks, and the work of their drives on the way.

use equipod::methods::design::{Format, parse_with_cranks};
use equipod::methods::geom::Pose;
use equipod::methods::requirements::Terms;
use nalgebra::Rotation3;

use super::{HEAD, asked, limited};
use crate::cli_frame::equipod;

/// The free motion of the head, against a walk in small steps by other code.
#[test]
fn free_paths_of_cranks_end_where_a_limit_of_theirs_does() {
    let (code, doc) = asked(&["limits", HEAD, "--at", "2,-3,180,4,-2,5"]);
    assert_eq!((code, &doc["allowed"]), (Some(0), &true.into()), "{doc}");
    let preset = std::fs::read_to_string(HEAD).unwrap();
    let (design, _) = parse_with_cranks(&preset, Format::Toml).unwrap();
    let platform = design.rotary().unwrap().unwrap();
    let (required, home) = (design.requirements(), design.home.unwrap());
    let terms = Terms::new(design.manipulator(), &required, &home);
    let start: Pose = "2,-3,180,4,-2,5".parse().unwrap();
    let met = |pose: &Pose| {
        let reached = platform.ik(pose).is_ok_and(|angles| platform.within_limits(&angles));
        reached && terms.at(pose).iter().all(|(_, margin)| *margin > 0.0)
    };
    for (k, name) in ["x", "y", "z"].into_iter().enumerate() {
        let row = doc["axes"].as_array().unwrap().iter().find(|row| row["axis"] == name).unwrap();
        for (way, sign) in [("back", -1.0), ("forth", 1.0)] {
            let end = row[way]["value"].as_f64().unwrap();
            let at = |value: f64| {
                let mut pose = start;
                pose.position[k] = value;
                pose
            };
            // allowed up to the end, and not beyond it
            let step = (end - start.position[k]) / 200.0;
            assert!((0..200).all(|j| met(&at(start.position[k] + step * f64::from(j)))), "{name} {way}");
            assert!(!met(&at(end + sign * 1e-4)), "{name} {way}: {row}");
            let binds = row[way]["binds"]["name"].as_str().unwrap();
            assert!(
                ["min_rod_length", "max_rod_length", "crank_angle", "crank_torque"].contains(&binds),
                "{row}"
            );
        }
    }
    // beyond reach: the nearest allowed pose, and the violations
    let (code, doc) = asked(&["limits", HEAD, "--to", "0,0,260,0,0,0"]);
    assert_eq!(code, Some(1), "{doc}");
    assert!(
        doc["straight_path"]["binds"]["name"].is_string() && doc["nearest_allowed"]["distance"].is_number(),
        "{doc}"
    );
    let (code, doc) = asked(&["limits", HEAD, "--at", "0,0,260,0,0,0"]);
    let violated: Vec<&str> = doc["violated"]
        .as_array()
        .unwrap()
        .iter()
        .map(|v| v["name"].as_str().unwrap_or("singular"))
        .collect();
    assert_eq!((code, violated.contains(&"min_rod_length")), (Some(1), true), "{doc}");
    assert!(!violated.contains(&"singular"), "where no rod reaches there is no sign to lose: {doc}");
}

/// Every limit of cranks binds on some way, and no pose of the way before its end violates one.
#[test]
fn ways_of_cranks_keep_every_limit_between_their_steps() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("servos.toml");
    // angles about those at home, which are 150 degrees
    let text = limited().text().replace("angle_deg = [-80, \"60 + half\"]", "angle_deg = [100, 190]");
    // a speed that binds late, so that the binding limit has steps of its own
    let text = text.replace("max_speed_deg = 300", "max_speed_deg = 3000");
    let (design, _) = parse_with_cranks(&text, Format::Toml).unwrap_or_else(|v| panic!("{v:?}"));
    std::fs::write(&path, &text).unwrap();
    let (required, home) = (design.requirements(), design.home.unwrap());
    let terms = Terms::new(design.manipulator(), &required, &home);
    let mut bound = std::collections::BTreeSet::new();
    for to in ["30,10,110,0,0,0", "0,0,80,0,0,0", "0,0,125,0,0,0", "0,0,105,0,0,60", "5,-30,100,20,5,0"] {
        let (_, doc) = asked(&["limits", path.to_str().unwrap(), "--to", to]);
        let way = &doc["straight_path"];
        let free = way["free"].as_f64().unwrap_or_else(|| panic!("{doc}"));
        bound.insert(way["binds"]["name"].as_str().unwrap_or_else(|| panic!("{to}: {doc}")).to_string());
        let target: Pose = to.parse().unwrap();
        let turn = (target.rotation * home.rotation.inverse()).scaled_axis();
        for k in 0..400 {
            let t = free * f64::from(k) / 400.0;
            let pose = Pose {
                rotation: Rotation3::new(turn * t) * home.rotation,
                position: home.position + (target.position - home.position) * t,
            };
            let worst = terms.at(&pose).into_iter().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
            assert!(worst.1 > -1e-9, "{to} at {t}: {worst:?}");
        }
    }
    assert!(bound.len() >= 2, "{bound:?}");
}

/// Speeds, accelerations, torques and powers along a motion against differences of angles and the work of the weight.
#[test]
fn a_motion_of_cranks_has_speeds_torques_and_powers() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("m.csv");
    let (code, doc) = asked(&["motion", HEAD, "--sine", "z:6:2", "--csv", table.to_str().unwrap()]);
    assert_eq!((code, &doc["met"]), (Some(0), &true.into()), "{doc}");
    let run = &doc["motions"][0];
    assert!(run["legs"].as_array().unwrap().is_empty() && run.get("unreached_at_s").is_none());
    let names: Vec<&str> = run["requirements"]
        .as_array()
        .unwrap()
        .iter()
        .map(|r| r["margin"]["name"].as_str().unwrap())
        .collect();
    for name in ["crank_torque", "crank_speed", "crank_angle", "min_rod_length"] {
        assert!(names.contains(&name), "{names:?}");
    }
    let text = std::fs::read_to_string(&table).unwrap();
    let header: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let rows: Vec<Vec<f64>> = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').skip(1).map(|x| x.parse().unwrap()).collect())
        .collect();
    let column =
        |name: &str| header.iter().position(|h| *h == name).unwrap_or_else(|| panic!("{header:?}")) - 1;
    let (preset, _) = parse_with_cranks(&std::fs::read_to_string(HEAD).unwrap(), Format::Toml).unwrap();
    let payload = preset.payload.unwrap();
    for k in 1..rows.len() - 1 {
        let dt = rows[k + 1][0] - rows[k][0];
        let mut power = 0.0;
        for leg in 1..=6 {
            let at = |name: &str, k: usize| {
                rows[k][column(&format!(
                    "{name}_{leg}_{}",
                    match name {
                        "crank" => "deg",
                        "speed" => "deg_per_s",
                        "acceleration" => "deg_per_s2",
                        "torque" => "N_mm",
                        _ => "W",
                    }
                ))]
            };
            let first = (at("crank", k + 1) - at("crank", k - 1)) / (2.0 * dt);
            let second = (at("crank", k + 1) - 2.0 * at("crank", k) + at("crank", k - 1)) / (dt * dt);
            assert!((first - at("speed", k)).abs() < 2e-3 * 400.0, "{leg}: {first} {}", at("speed", k));
            assert!((second - at("acceleration", k)).abs() < 2e-3 * 9000.0, "{leg}: {second}");
            // N mm times rad/s in W
            let own = at("torque", k) * 1e-3 * at("speed", k).to_radians();
            assert!((own - at("power", k)).abs() < 1e-9 * (1.0 + own.abs()));
            power += at("power", k);
        }
        // the drives lift and accelerate the head: m (g + a) v
        let [z, before, after] = [k, k - 1, k + 1].map(|j| rows[j][column("z_mm")]);
        let (speed, acceleration) = ((after - before) / (2.0 * dt), (after - 2.0 * z + before) / (dt * dt));
        let meant = payload.mass * (9806.65 + acceleration) * speed * 1e-6;
        assert!((power - meant).abs() < 2e-3 * 0.3, "{power} {meant}");
    }
    // a way beyond reach is told with its time, and no speed is made up for it
    let (code, doc) = asked(&["motion", HEAD, "--sine", "z:60:1"]);
    let run = &doc["motions"][0];
    assert_eq!((code, &doc["met"]), (Some(1), &false.into()));
    assert!(run["unreached_at_s"].as_f64().unwrap() > 0.0 && run["cranks"].as_array().unwrap().is_empty());
    let text = String::from_utf8(equipod(&["motion", HEAD, "--sine", "z:60:1"]).stdout).unwrap();
    assert!(text.contains("a rod does not reach") && text.contains("exceeds its limits"), "{text}");
    let (code, doc) = asked(&["motion", HEAD, "--stiffness"]);
    assert_eq!((code, &doc["error"]["code"]), (Some(2), &"motion::no_stiffness".into()));
}
