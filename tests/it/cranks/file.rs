//! Cranks in a design file: values, copies, units, and slips that are refused.

use equipod::methods::design::{Code, Format, parse_with_cranks};
use equipod::methods::rotary::Elbow;
use nalgebra::{Matrix3, Vector3};

use super::{SERVOS, servos};
use crate::cli_frame::equipod;

#[test]
fn values_are_shared_copied_and_kept() {
    let design = servos();
    let platform = design.rotary().unwrap().unwrap();
    let legs = platform.legs();
    let bits = |x: f64| x.to_bits();
    assert!(legs.iter().all(|leg| bits(leg.crank.length) == bits(20.0) && leg.elbow == Elbow::Plus));
    assert_eq!(legs.map(|leg| bits(leg.rod)), [120.0, 120.0, 120.0, 120.0, 120.0, 120.5].map(bits));
    let limits = legs[3].limits.unwrap();
    assert!((limits.0.to_degrees() + 80.0).abs() < 1e-12 && (limits.1.to_degrees() - 75.0).abs() < 1e-12);
    assert_eq!(design.crank_limits().max_torque, Some(1500.0));
    // tips of a mirror image are mirror images at equal angles, and tips of turned cranks are turned
    let mirror = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, 1.0));
    let turn = nalgebra::Rotation3::from_axis_angle(&Vector3::z_axis(), 120f64.to_radians());
    for angle in [-1.0, 0.0, 0.3, 2.5] {
        let tip = |leg: usize| platform.tip(leg, angle).coords;
        assert!((mirror * tip(0) - tip(1)).norm() < 1e-12, "{angle}");
        assert!((turn * tip(0) - tip(2)).norm() < 1e-12 && (turn * tip(1) - tip(3)).norm() < 1e-12);
    }
    // a written file is read back, in both notations, with the same content
    for (text, format) in [(design.to_toml(), Format::Toml), (design.to_json(), Format::Json)] {
        let (again, warnings) = parse_with_cranks(&text, format).unwrap_or_else(|v| panic!("{v:?}\n{text}"));
        assert_eq!((&again, warnings.len()), (&design, 0));
        assert_eq!(again.rotary().unwrap().unwrap(), platform);
        for said in ["6*arm", "60 + half", "2*120", "mirror"] {
            assert!(text.contains(said), "{said}: {text}");
        }
    }
    assert_eq!(design.text(), SERVOS, "the text is the design's own");
}

#[test]
fn every_slip_in_a_crank_is_refused_at_its_place() {
    let line_of = |part: &str| SERVOS.lines().position(|l| l.contains(part)).unwrap() + 1;
    for (from, to, code, says) in [
        ("length = \"arm\"", "length = 0", Code::NotPositive, "length"),
        ("length = \"arm\"", "length = \"armm\"", Code::UnknownName, "armm"),
        ("rod_length = \"6*arm\"", "rod_length = \"6*\"", Code::Expression, "rod_length"),
        ("elbow = \"plus\"", "elbow = \"left\"", Code::WrongType, "elbow"),
        ("angle_deg = [-80, \"60 + half\"]", "angle_deg = [80, -75]", Code::OutOfRange, "80"),
        ("angle_deg = [-80, \"60 + half\"]", "angle_deg = [-80]", Code::CoordinateCount, "angle_deg"),
        ("axis = [1, 0, 0]", "axis = [0, 0, 0]", Code::NotPositive, "axis"),
        ("zero = [0, 1, 0]", "zero = [-2, 0, 0]", Code::OutOfRange, "along its axis"),
        ("max_torque = 1500", "max_torqe = 1500", Code::UnknownKey, "max_torqe"),
        (
            "max_torque = 1500",
            "min_transmission_angle_deg = 90",
            Code::OutOfRange,
            "`min_transmission_angle_deg` is 90 degrees",
        ),
        ("max_torque = 1500", "tip_angle_deg = 95", Code::OutOfRange, "tip_angle_deg"),
        ("max_torque = 1500", "platform_cone_angle_deg = -4", Code::NotPositive, "platform_cone_angle_deg"),
        ("[cranks.A6]", "[cranks.A7]", Code::UnknownKey, "A7"),
        (
            "mirror = \"A1\"\nplane = \"xz\"\n[cranks.A3]",
            "mirror = \"A9\"\nplane = \"xz\"\n[cranks.A3]",
            Code::UnknownName,
            "A9",
        ),
        ("plane = \"xz\"\n[cranks.A3]", "[cranks.A3]", Code::MissingKey, "plane"),
        (
            "mirror = \"A1\"\nplane = \"xz\"\n[cranks.A3]",
            "mirror = \"A4\"\nplane = \"xz\"\n[cranks.A3]",
            Code::Cycle,
            "circle",
        ),
        ("drive = \"rotary\"", "drive = \"rotative\"", Code::WrongType, "rotative"),
        ("drive = \"rotary\"\n", "", Code::ConflictingKeys, "[cranks]"),
        ("drive = \"rotary\"", "drive = \"prismatic\"", Code::ConflictingKeys, "[cranks]"),
        ("[home]", "[hardware]\nstroke = 5\ndead_length = 3\n[home]", Code::ConflictingKeys, "hardware"),
        (
            "drive = \"rotary\"",
            "drive = \"rotary\"\nlengths = [1, 1, 1, 1, 1, 1]",
            Code::ConflictingKeys,
            "lengths",
        ),
        ("[\"A6\", \"B6\"]]", "[\"A5\", \"B6\"]]", Code::IdenticalLegs, "A5"),
    ] {
        assert!(SERVOS.contains(from), "{from}");
        let text = SERVOS.replacen(from, to, 1);
        let found = parse_with_cranks(&text, Format::Toml).err().unwrap_or_else(|| panic!("{to} is taken"));
        let slip = found.iter().find(|v| v.code == code).unwrap_or_else(|| panic!("{to}: {found:?}"));
        assert!(slip.message.contains(says), "{to}: {slip}");
        assert!(found.len() <= 2 || code == Code::UnknownKey, "{to}: {found:?}");
    }
    // a missing value is reported with its crank and its place
    let text = SERVOS.replacen("elbow = \"plus\"\n", "", 1);
    let found = parse_with_cranks(&text, Format::Toml).unwrap_err();
    assert_eq!((found.len(), found[0].code), (6, Code::MissingKey));
    assert!(found[0].message.contains("`elbow`") && found[0].line == line_of("[cranks.A1]") - 1, "{found:?}");
    let bare = SERVOS.split("[cranks]").next().unwrap().to_string();
    let found = parse_with_cranks(&bare, Format::Toml).unwrap_err();
    assert!(found[0].message.contains("[cranks] is missing"), "{found:?}");
}

#[test]
fn lengths_change_their_unit_and_angles_do_not() {
    let folder = tempfile::tempdir().unwrap();
    let [from, to] = ["servos.toml", "inches.json"].map(|name| folder.path().join(name));
    std::fs::write(&from, SERVOS).unwrap();
    let [from, to] = [&from, &to].map(|p| p.to_str().unwrap());
    let out = equipod(&["design", "convert", from, "--units", "in", "-o", to]);
    assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stderr));
    let (inches, _) = parse_with_cranks(&std::fs::read_to_string(to).unwrap(), Format::Json).unwrap();
    let [own, other] = [servos(), inches].map(|d| (d.rotary().unwrap().unwrap(), d.home.unwrap(), d));
    let [a, b] = [own.0.ik(&own.1).unwrap(), other.0.ik(&other.1).unwrap()];
    assert!((0..6).all(|i| (a[i] - b[i]).abs() < 1e-12), "{a:?} {b:?}");
    assert!((other.0.legs()[5].rod * 25.4 - 120.5).abs() < 1e-12);
    assert!((other.2.crank_limits().max_torque.unwrap() * 25.4 - 1500.0).abs() < 1e-9);
}
