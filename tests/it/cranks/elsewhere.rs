//! Other commands on platforms with cranks: files for other programs, comparisons, and refusals when legs have to
//! change their lengths.

use equipod::methods::design::{Code, Design, Format, PRESETS, parse, parse_with_cranks};
use nalgebra::Vector3;

use super::{HEAD, asked};
use crate::cli_frame::{document, equipod};

#[test]
fn simulators_and_controllers_get_cranks_and_every_other_format_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let done = equipod(&["export", HEAD, "--to", "all", "-o", out, "--json"]);
    assert_eq!(done.status.code(), Some(1), "{}", String::from_utf8_lossy(&done.stderr));
    let doc = document(&done);
    for format in doc["formats"].as_array().unwrap() {
        let files = match format["format"].as_str().unwrap() {
            "mjcf" => 1,
            "c" => 9,
            _ => 0,
        };
        assert_eq!(format["files"].as_array().unwrap().len(), files, "{format}");
        assert_eq!(format.get("refused").is_some(), files == 0, "{format}");
    }
    assert_eq!(std::fs::read_dir(out).unwrap().count(), 10);
    let model = std::fs::read_to_string(folder.path().join("platform.xml")).unwrap();
    for (part, times) in
        [("<connect ", 5), ("type=\"ball\"", 1), ("type=\"hinge\"", 18), ("<position ", 6), ("\"slide\"", 0)]
    {
        assert_eq!(model.matches(part).count(), times, "{part}");
    }
    assert!(model.contains("forcerange=\"-0.52 0.52\""), "newton metres");
    let far = std::fs::read_to_string(HEAD).unwrap().replace("0.0, 177.0]", "0.0, 300.0]");
    let path = folder.path().join("far.toml");
    std::fs::write(&path, far).unwrap();
    let done = equipod(&["export", path.to_str().unwrap(), "--to", "mjcf", "-o", out, "--json"]);
    assert_eq!(
        (done.status.code(), &document(&done)["error"]["code"]),
        (Some(2), &"export::bad_size".into())
    );
}

/// The numbers of an attribute of the element with this name.
fn attribute(model: &str, element: &str, name: &str) -> Vec<f64> {
    let line = model.lines().find(|line| line.contains(&format!("name=\"{element}\""))).unwrap();
    let text = line.split(&format!(" {name}=\"")).nth(1).unwrap().split('"').next().unwrap();
    text.split(' ').map(|x| x.parse().unwrap()).collect()
}

#[test]
fn simulators_limit_the_swing_of_rods_at_both_ends() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let path = folder.path().join("limited.toml");
    let text = std::fs::read_to_string(HEAD).unwrap();
    let limits = "max_torque = 520.0\ntip_angle_deg = 25.0\nplatform_cone_angle_deg = 35.0";
    std::fs::write(&path, text.replace("max_torque = 520.0", limits)).unwrap();
    let path = path.to_str().unwrap();
    let done = equipod(&["export", path, "--to", "mjcf", "-o", out, "--json"]);
    assert_eq!(done.status.code(), Some(0), "{}", String::from_utf8_lossy(&done.stderr));
    let model = std::fs::read_to_string(folder.path().join("platform.xml")).unwrap();
    let home = document(&equipod(&["ik", path, "--pose=home", "--json"]));
    let margin = |name: &str| {
        let all = home["margins"].as_array().unwrap();
        all.iter().find(|m| m["name"] == name).unwrap()["margin"].as_f64().unwrap().to_radians()
    };
    // at home the hinge is at zero, and its distance from the nearer end is the margin of `ik`
    let mut left = f64::INFINITY;
    for i in 1..=6 {
        let range = attribute(&model, &format!("swing{i}y"), "range");
        assert!((range[1] - range[0] - 50_f64.to_radians()).abs() < 1e-12, "{range:?}");
        left = left.min(range[1].min(-range[0]));
        let [rod, seat] = [format!("rod{i}_swing"), format!("platform{i}_swing")]
            .map(|site| Vector3::from_vec(attribute(&model, &site, "pos")));
        // a tenth of the rod of 85 mm before its end, in metres
        assert!((rod - Vector3::new(0.0, 0.0, 0.9 * 0.085)).norm() < 1e-12, "{rod}");
        let range = attribute(&model, &format!("swing{i}"), "range");
        assert!((range[1] - 2.0 * 0.0085 * 17.5_f64.to_radians().sin()).abs() < 1e-12, "{range:?}");
        let design = parse_with_cranks(&std::fs::read_to_string(path).unwrap(), Format::Toml).unwrap().0;
        let joint = design.manipulator().legs()[i - 1].platform.coords * 1e-3;
        assert!(((joint - seat).norm() - 0.0085).abs() < 1e-12, "{seat}");
    }
    assert!((left - margin("tip_angle")).abs() < 1e-9, "{left} {}", margin("tip_angle"));
    // at home no rod swings at the platform
    assert!((margin("platform_cone_angle") - 35_f64.to_radians()).abs() < 1e-9);
    // without limits there are none
    let done = equipod(&["export", HEAD, "--to", "mjcf", "-o", out, "--json"]);
    assert_eq!(done.status.code(), Some(0));
    let free = std::fs::read_to_string(folder.path().join("platform.xml")).unwrap();
    assert!(!free.contains("<tendon>") && !free.contains("_swing"), "{free}");
    assert_eq!(free.matches(" range=").count() + 6, model.matches(" range=").count() - 6);
}

#[test]
fn nothing_takes_cranks_for_legs_that_change_their_lengths() {
    let preset = PRESETS.iter().find(|p| p.name == "reachy-mini").unwrap();
    let found = parse(preset.text, Format::Toml).unwrap_err();
    assert_eq!((found.len(), found[0].code), (1, Code::Rotary));
    assert!(Design::load(HEAD).is_err() && preset.text.parse::<Design>().is_err());
    let octahedral = "designs/rbt-octahedral.toml";
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let file = format!("{out}/o.svg");
    for args in [
        vec!["check", HEAD],
        vec!["explore", HEAD, "-o", out],
        vec!["optimize", HEAD],
        vec!["verify", HEAD, octahedral],
        vec!["verify", octahedral, HEAD],
        vec!["equivalents", "map", octahedral, HEAD],
        vec!["equivalents", "family", HEAD],
        vec!["equivalents", "components", HEAD],
        vec!["equivalents", "move", HEAD, "--search", "--spacing", "1"],
        vec!["equivalents", "nearest", HEAD],
        vec!["singular", "poses", HEAD],
        vec!["singular", "motion", HEAD],
        vec!["build", "round", HEAD, "--grid", "5"],
        vec!["build", "tolerances", HEAD, "--bound", "1,1"],
        vec!["plot", "modes", HEAD, "-o", &file],
    ] {
        let done = equipod(&[args.as_slice(), &["--json"]].concat());
        let text = String::from_utf8_lossy(&done.stdout).into_owned();
        assert_eq!(done.status.code(), Some(2), "{args:?}: {text}");
        let error = &document(&done)["error"];
        // a usage error would hide whether the design is refused
        assert_eq!(error["violations"][0]["code"], "design::rotary", "{args:?}: {error}");
    }
    assert_eq!(std::fs::read_dir(out).unwrap().count(), 0, "nothing is written");
    for (args, code) in [
        (vec!["fk", HEAD], "fk::no_angles"),
        (vec!["fk", HEAD, "--lengths", "85,85,85,85,85,85"], "usage::no_effect"),
        (vec!["fk", HEAD, "--angles", "1,2,3"], "fk::bad_angles"),
        (vec!["fk", octahedral, "--angles", "1,2,3,4,5,6"], "usage::no_effect"),
        (vec!["fk", HEAD, "--angles", "1,2,3,4,5,6", "--near", "0,0,300,0,0,0"], "fk::bad_pose"),
    ] {
        let done = equipod(&[args.as_slice(), &["--json"]].concat());
        assert_eq!(done.status.code(), Some(2), "{args:?}");
        assert_eq!(document(&done)["error"]["code"], code, "{args:?}");
    }
}

#[test]
#[ignore = "evidence"]
fn cranks_and_legs_stand_side_by_side() {
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("c.html");
    let args = ["compare", HEAD, "designs/presets/bench-l16.toml", "--points", "30", "--sine", "z:2:1"];
    let (code, doc) = asked(&[&args[..], &["--accuracy", "0.1,0.1", "-o", page.to_str().unwrap()]].concat());
    assert_eq!(code, Some(0), "{doc}");
    let [head, bench] = doc["designs"].as_array().unwrap().as_slice() else { panic!("{doc}") };
    assert!(head["stroke"].is_null() && head["force"].is_null() && bench["stroke"].is_number());
    assert!(
        bench.get("cranks").is_none() && head["no_tolerance"].as_str().unwrap().contains("cranks"),
        "{head}"
    );
    let cranks = &head["cranks"];
    let of = |key: &str| cranks[key].as_f64().unwrap_or_else(|| panic!("{key}: {cranks}"));
    assert!(of("least_deg") < -35.0 && of("greatest_deg") > 35.0 && of("transmission_deg") > 10.0);
    assert!(
        of("torque") > 0.0
            && of("torque") < 520.0
            && of("motion_torque") > 0.0
            && of("motion_speed_deg") > 0.0
    );
    assert!(head["conditioning"].as_f64().unwrap() > 0.0 && head["different_legs"] == 1);
    assert!(std::fs::read_to_string(&page).unwrap().contains("least transmission angle"));
}
