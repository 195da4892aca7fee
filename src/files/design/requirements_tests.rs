//! Tables of requirements: read whole, written back to the bit, refused with line and help.
#![allow(clippy::float_cmp, reason = "exact values are read")]

use std::fmt::Write as _;

use super::fixtures::REQUIRED as GOOD;
use super::*;
use machine::requirements::{
    Envelope, GRAVITY, Grid, HoleCircle, HoleCircles, Housing, JointAxes, KeepOutShape, LengthLimits,
    Quantity, Region, TermKind,
};
use platform::manipulator::Body;

#[test]
fn every_key_is_read_and_written_back_to_the_bit() {
    let (design, warnings) = parse(GOOD, Format::Toml).unwrap();
    assert_eq!(warnings, []);
    let h = design.hardware;
    assert_eq!(h.housing(Body::Base, 0), Some(Housing::Box(nalgebra::Vector3::new(1.0, 2.0, 3.0))));
    assert_eq!(h.housing(Body::Platform, 5), Some(Housing::Sphere(0.5)));
    assert_eq!(h.leg_body.unwrap().rod, Some((5.0, 0.2)));
    assert_eq!(h.leg_length, Some(LengthLimits::Stroke { dead: 4.0, stroke: 3.0 }));
    assert_eq!(h.platform_cone_angle.unwrap().axes, JointAxes::Optimize);
    let JointAxes::Given(axes) = h.base_cone_angle.unwrap().axes else { panic!("six axes") };
    assert!((axes[3].into_inner() - nalgebra::Vector3::new(0.0, 0.6, 0.8)).norm() < 1e-15);
    assert_eq!(design.workspace.region, Region::Ellipsoid);
    assert_eq!(design.workspace.trajectory.as_ref().unwrap().file, "path.csv");
    assert_eq!((design.loads[1].name.as_str(), design.loads[1].fixed_to), ("load 2", Body::Platform));
    assert!(matches!(design.keep_outs[2].shape, KeepOutShape::Capsule { diameter: 3.0, .. }));
    let table = design.calibration.as_ref().unwrap();
    assert_eq!(table.distances([1.0; 6])[1], 1.2);
    let of = |body, joint| table.deviation(body, joint).map(|v| v.z);
    assert_eq!((of(Body::Base, 0), of(Body::Base, 1), of(Body::Base, 2)), (Some(0.3), None, Some(0.3)));
    assert_eq!((of(Body::Platform, 0), of(Body::Platform, 2)), (Some(0.03), None));
    let correlations = table.correlations.as_ref().unwrap();
    let (p4z, sixth) = (correlations.unknowns[1], CalibratedNumber::Offset(5));
    assert_eq!(
        (p4z, table.deviation_of(p4z)),
        (CalibratedNumber::Coordinate { body: Body::Platform, joint: 0, axis: 2 }, Some(0.03))
    );
    assert_eq!((correlations.unknowns[2], table.deviation_of(sixth)), (sixth, Some(0.03)));
    assert_eq!((correlations.matrix()[(1, 2)], correlations.matrix()[(2, 0)]), (0.75, 0.25));
    let required = design.requirements();
    assert_eq!(
        (required.loads.len(), required.keep_outs.len(), required.platform_speed.unwrap().linear),
        (3, 3, 20.0)
    );
    assert_eq!(required.loads[0].name, "legs", "the file has masses of legs and no payload");
    let expected = required.platform_stiffness.unwrap();
    assert_eq!((expected.linear, expected.angular, expected.natural_frequency), (Some(2e4), Some(3e5), None));
    assert_eq!(design.unit_of(Quantity::AngularStiffness), "N mm/rad");
    for format in [Format::Toml, Format::Json] {
        let text = match format {
            Format::Toml => design.to_toml(),
            Format::Json => design.to_json(),
        };
        assert_eq!(parse(&text, format).unwrap().0, design, "{text}");
    }
}

#[test]
fn what_contradicts_itself_is_refused() {
    let mut all = String::new();
    for (from, to) in [
        ("stroke = 3", "strok = 3"),
        ("stroke = 3", "stroke = 3\nleg_length = [4, 9]"),
        ("dead_length = 4\nstroke = 3", "leg_length = [9, 4]"),
        ("dead_length = 4\nstroke = 3", "leg_length = 9"),
        ("rod_diameter = 0.2\n", ""),
        ("leg_diameter = 0.4\n", ""),
        ("base_cone_angle_deg = 45\n", ""),
        ("base_cone_angle_deg = 45", "base_cone_angle_deg = 200"),
        ("platform_axes = \"optimize\"", "platform_axes = \"up\""),
        ("[0.1, 0.2, 0.3], [7, 1, 2]]", "[0, 0, 0], [7, 1]]"),
        ("[0.1, 0.2, 0.3], [7, 1, 2]]", "[7, 1, 2]]"),
        ("base_housing = [1, 2, 3]", "base_housing = [1, -2, 3]"),
        ("leg_clearance = 0", "leg_clearance = -1"),
        ("linear = 20", "linear = -20\nturn = 3"),
        ("[[loads]]\nname = \"weight\"", "[[loads]]\nname = \"\"\nforces = [1, 2, 3]"),
        ("fixed_to = \"platform\"\nsphere", "fixed_to = \"tool\"\nsphere"),
        ("sphere = { center = [0, 0, 2], diameter = 3 }", "sphere = { centre = [0, 0, 2], diameter = -3 }"),
        ("box = { center = [0, 0, -5], size = [40, 40, 1] }", "fixed_to = \"base\""),
        ("region = \"ellipsoid\"", "region = \"ball\""),
        ("trajectory = \"path.csv\"", "trajectory = 3"),
        ("trajectory = \"path.csv\"", "trajectory = \"path.csv\"\nrelative_to = \"tool\""),
        ("trajectory = \"path.csv\"", "relative_to = \"home\""),
        ("[speed]", "[[speed]]"),
        ("leg_stiffness = 1e5", "cylinder_inertia = 1"),
        ("angular = 3e5", "angular = 0\nnatural_frequency = 30"),
        ("offsets = [0.1, -0.2", "offset = [0.1, -0.2"),
        ("offsets = [0.1, -0.2, 0,", "offsets = [0.1,"),
        ("offset_deviations = [0.01", "offset_deviations = [-0.01"),
        ("P1 = [0.1, 0.2, 0.3]", "P1 = [0.1, 0.2]"),
        ("P4 = [0.01, 0.02, 0.03]\n[cal", "P1 = [0.01, 0.02, 0.03]\nP4 = [0.01, 0.02, 0.03]\n[cal"),
        ("unknowns = [", "unknown = ["),
        ("\"base.P1.x\", \"platform.P4.z\", \"offset.6\"", "\"base.P1.w\", \"platform.P5.z\", \"offset.7\""),
        ("\"platform.P4.z\", \"offset.6\"", "\"offset.6\", \"offset.6\""),
        ("[[1], [0.5, 1], [0.25, 0.75, 1]]", "[[1], [0.5, 1]]"),
        ("[[1], [0.5, 1], [0.25, 0.75, 1]]", "[[1, 0.5, 0], [0.4, 1, 0], [0, 0, 0.9]]"),
        ("[[1], [0.5, 1], [0.25, 0.75, 1]]", "[[1], [1.5, 1], [0, \"a\", 1]]"),
        ("[[1], [0.5, 1], [0.25, 0.75, 1]]", "[[1], [0.9, 1], [-0.9, 0.9, 1]]"),
    ] {
        assert!(GOOD.contains(from), "{from}");
        match parse(&GOOD.replacen(from, to, 1), Format::Toml) {
            Ok(_) => panic!("accepted: {to}"),
            Err(violations) => {
                for v in violations {
                    let _ = writeln!(all, "{}:{} {}: {} | {}", v.line, v.column, v.code, v.message, v.help);
                }
            }
        }
    }
    assert_eq!(
        all,
        r#"26:1 design::missing_key: `dead_length` without `stroke` | add `stroke`, or remove `dead_length`
27:1 design::unknown_key: `strok` is not a key of [hardware] | did you mean `stroke`?
28:1 design::conflicting_keys: leg lengths are limited twice | keep `leg_length`, or `dead_length` with `stroke`
26:14 design::out_of_range: `leg_length` is [9, 4] | give [least, greatest] with 0 <= least < greatest
26:14 design::wrong_type: `leg_length` is a number, not an array | write an array of 2 lengths, least and greatest
23:1 design::missing_key: `cylinder_length` without `rod_diameter` | add `rod_diameter`, or remove `cylinder_length`
22:1 design::missing_key: `rod_diameter` without `leg_diameter` | add `leg_diameter`, or remove `rod_diameter`
24:1 design::missing_key: `leg_clearance` without `leg_diameter` | add `leg_diameter`, or remove `leg_clearance`
28:1 design::missing_key: `base_axes` without `base_cone_angle_deg` | add `base_cone_angle_deg` or universal joints, or remove `base_axes`
28:23 design::out_of_range: `base_cone_angle_deg` is 200 | stay within 180 degrees
31:17 design::wrong_type: `platform_axes` is not a choice of axes | write "home", "normal", "optimize", one vector for all joints, or six in leg order, each a vector or "normal"
29:58 design::not_positive: an axis of `base_axes` is zero | give a direction
29:69 design::coordinate_count: an axis of `base_axes` has 2 numbers instead of 3 | give 3 components
29:13 design::wrong_type: `base_axes` is not a choice of axes | write "home", "normal", "optimize", one vector for all joints, or six in leg order, each a vector or "normal"
21:20 design::not_positive: an edge length of -2 | give positive edge lengths
25:17 design::not_positive: `leg_clearance` is -1 | give 0 or more
42:10 design::not_positive: `linear` is -20 | give 0 or more
43:1 design::unknown_key: `turn` is not a key of [speed] | known keys: linear, angular_deg
45:8 design::empty_name: `name` is empty | write something between the quotes of `name`
46:1 design::unknown_key: `forces` is not a key of [[loads]] | did you mean `force`?
55:12 design::wrong_type: `fixed_to` is "tool" | write "base" or "platform"
56:10 design::missing_key: `center` of `sphere` is missing | `sphere` takes center, diameter
56:12 design::unknown_key: `centre` is not a key of `sphere` | did you mean `center`?
51:3 design::missing_key: table has 0 shapes | give one of box = { center, size }, sphere = { center, diameter }, capsule = { from, to, diameter }
17:10 design::wrong_type: `region` is neither "box" nor "ellipsoid" | write "box" or "ellipsoid"
18:14 design::wrong_type: `trajectory` is a number, not a string | write `trajectory = "..."`
19:15 design::wrong_type: `relative_to` is "tool" | write "home" or "base"
18:1 design::missing_key: `relative_to` has no effect, because no poses are listed | list `poses` or name a `trajectory`, or remove `relative_to`: the box is always around home
41:1 design::wrong_type: [speed] is an array, not a table | write [speed] as a table
70:2 design::missing_key: [stiffness] needs the stiffness of a leg | add `leg_stiffness` to [hardware], force units per design unit
72:11 design::not_positive: `angular` is 0 | give a positive number
73:1 design::missing_key: `natural_frequency` of [stiffness] needs the mass and the inertia that vibrate | add [payload] with `mass`, `center` and `inertia`
60:1 design::unknown_key: `offset` is not a key of [calibration] | did you mean `offsets`?
60:11 design::length_count: `offsets` has 4 numbers instead of 6 | give 6 offsets, one for each leg
61:22 design::not_positive: a standard deviation of -0.01 | standard deviations are not negative
63:6 design::coordinate_count: the deviation of `P1` has 2 numbers instead of 3 | give 3 standard deviations
68:13 design::missing_key: `base.P1.x` has no standard deviation | give its deviation in [calibration]
66:1 design::missing_joint: `platform_deviations` of [calibration] names `P1`, which is no joint of the body | its joints are: P4, P5, P6
67:14 design::missing_key: [calibration.correlations] has no `unknowns` | give `unknowns`, a list of names, and `matrix`, the lower triangle of their correlations
68:1 design::unknown_key: `unknown` is not a key of [calibration.correlations] | did you mean `unknowns`?
68:13 design::unknown_name: `base.P1.w` is no unknown of a calibration | write `base.JOINT.x`, `platform.JOINT.z` or `offset.3`
68:26 design::missing_key: `platform.P5.z` has no standard deviation | give its deviation in [calibration]
68:43 design::unknown_name: `offset.7` is no unknown of a calibration | write `base.JOINT.x`, `platform.JOINT.z` or `offset.3`
68:38 design::conflicting_keys: `offset.6` stands in `unknowns` twice | name each unknown once
69:10 design::out_of_range: `matrix` has 2 rows for 3 unknowns | give a row for each of `unknowns`
69:11 design::out_of_range: row 1 of `matrix` has 3 numbers instead of 1 | the matrix is symmetric: give its lower triangle with the diagonal, one number more in each row
69:24 design::out_of_range: row 2 of `matrix` has 3 numbers instead of 2 | the matrix is symmetric: give its lower triangle with the diagonal, one number more in each row
69:44 design::out_of_range: row 3 of `matrix` ends with 0.9, not with 1 | the diagonal is 1: every quantity is wholly correlated with itself
69:17 design::out_of_range: a correlation of 1.5 | correlations are from -1 to 1
69:30 design::wrong_type: number 2 of row 3 of `matrix` is a string, not a number | write a number without quotes
69:10 design::out_of_range: no quantities have these correlations: the least eigenvalue is -8.000e-1 | a matrix of correlations is positive semidefinite; give six decimals or more
"#
    );
}

/// Required tables besides limits.
const WANTED: &str = r#"
[payload]
mass = 300
center = [0, 0, 40]
inertia = [[3, 0.1, 0], [0.1, 4, 0], [0, 0, 5]]
[envelope]
base = { radius = 90 }
platform = { radius = 50, center = [1, 2] }
machine = { min = [-90, -90, -5], max = [90, 90, 180] }
[limits.safety_margin]
all = "5%"
leg_force = "10%"
max_leg_length = 0.5
"#;

#[test]
fn payload_envelopes_and_safety_margins_are_read_and_written_back_to_the_bit() {
    let named =
        GOOD.replacen("units = \"mm\"", "units = \"mm\"\nforce_units = \"kN\"\nmass_units = \"t\"", 1);
    let (design, _) = parse(&format!("{named}{WANTED}"), Format::Toml).unwrap();
    let required = design.requirements();
    assert_eq!((required.loads.len(), required.loads[0].name.as_str()), (3, "payload"));
    assert!((required.loads[0].force.z + 300.0 * GRAVITY).abs() < 1e-9, "tonnes weigh kilonewtons");
    assert_eq!(design.unit_of(Quantity::Force), "kN");
    assert_eq!(required.safety_margin(TermKind::MaxLegLength), 0.5);
    assert!((required.safety_margin(TermKind::LegForce) - 50.0).abs() < 1e-12);
    assert!((required.safety_margin(TermKind::MinLegLength) - 0.15).abs() < 1e-12, "5 percent of the travel");
    assert!((required.safety_margin(TermKind::BaseEnvelope) - 4.5).abs() < 1e-12);
    assert!(matches!(required.envelopes.machine, Some(Envelope::Box { .. })));
    for (text, format) in [(design.to_toml(), Format::Toml), (design.to_json(), Format::Json)] {
        assert_eq!(parse(&text, format).unwrap().0, design, "{text}");
    }
    // one percentage for everything
    let all = format!("{GOOD}[limits]\nsafety_margin = \"2.5%\"\n");
    let (design, _) = parse(&all, Format::Toml).unwrap();
    assert_eq!((design.safety_margins.all, design.safety_margins.kinds.len()), (Some(2.5), 0));
    assert_eq!(parse(&design.to_toml(), Format::Toml).unwrap().0, design);
    // lengths follow the unit; percentages and newtons do not
    let (design, _) =
        parse(&format!("{}{WANTED}", GOOD.replacen("trajectory = \"path.csv\"\n", "", 1)), Format::Toml)
            .unwrap();
    let metres = design.in_units("m").unwrap();
    assert_eq!(metres.requirements().safety_margin(TermKind::MaxLegLength), 0.0005);
    assert_eq!(
        metres.requirements().safety_margin(TermKind::LegForce),
        design.requirements().safety_margin(TermKind::LegForce)
    );
    let Some(Envelope::Cylinder { radius, center }) = metres.envelopes.platform else { panic!("a cylinder") };
    assert_eq!((radius, center), (0.05, [0.001, 0.002]));
    let payload = metres.payload.unwrap();
    assert!(
        (payload.center.z - 0.04).abs() < 1e-15 && (payload.inertia.unwrap()[(2, 2)] - 5e-6).abs() < 1e-18
    );
}

#[test]
fn payloads_envelopes_and_safety_margins_that_are_none_are_refused() {
    let mut all = String::new();
    for (from, to) in [
        ("mass = 300", "weight = 300"),
        ("mass = 300", "mass = 0"),
        ("inertia = [[3, 0.1, 0], [0.1, 4, 0], [0, 0, 5]]", "inertia = [1, 1, 9]"),
        (
            "inertia = [[3, 0.1, 0], [0.1, 4, 0], [0, 0, 5]]",
            "inertia = [[3, 0.2, 0], [0.1, 4, 0], [0, 0, 5]]",
        ),
        ("base = { radius = 90 }", "base = { diameter = 90 }"),
        ("base = { radius = 90 }", "base = { radius = 90, min = [0, 0, 0] }"),
        ("max = [90, 90, 180]", "max = [90, -90, 180]"),
        ("all = \"5%\"", "all = 5"),
        ("leg_force = \"10%\"", "leg_force = \"110%\""),
        ("max_leg_length = 0.5", "leg_long = 0.5"),
        ("max_leg_length = 0.5", "max_leg_length = -0.5"),
    ] {
        assert!(WANTED.contains(from), "{from}");
        match parse(&format!("{GOOD}{}", WANTED.replacen(from, to, 1)), Format::Toml) {
            Ok(_) => panic!("accepted: {to}"),
            Err(violations) => {
                let _ = writeln!(all, "{to}: {}", violations[0].code);
            }
        }
    }
    assert_eq!(
        all,
        r#"weight = 300: design::missing_key
mass = 0: design::not_positive
inertia = [1, 1, 9]: design::out_of_range
inertia = [[3, 0.2, 0], [0.1, 4, 0], [0, 0, 5]]: design::out_of_range
base = { diameter = 90 }: design::missing_key
base = { radius = 90, min = [0, 0, 0] }: design::missing_key
max = [90, -90, 180]: design::out_of_range
all = 5: design::wrong_type
leg_force = "110%": design::out_of_range
leg_long = 0.5: design::unknown_key
max_leg_length = -0.5: design::not_positive
"#
    );
    let units = GOOD.replacen("units = \"mm\"", "units = \"mm\"\nforce_units = \"newton\"", 1);
    assert!(parse(&units, Format::Toml).is_err());
}

#[test]
fn masses_and_units_give_what_vibrates() {
    let text = GOOD
        .replace("angular = 3e5", "natural_frequency = 30")
        .replace("[speed]", "[payload]\nmass = 200\ncenter = [0, 0, 3]\ninertia = [9e2, 8e2, 1e3]\n[speed]");
    let design = |text: &str| parse(text, Format::Toml).unwrap().0;
    let plain = design(&text).vibrating().unwrap();
    assert_eq!((plain.leg, plain.bodies.mass, plain.bodies.metres), (1e8, 200.0, 1e-3));
    let named = text.replace("units = \"mm\"", "units = \"mm\"\nforce_units = \"kN\"\nmass_units = \"g\"");
    let named = design(&named).vibrating().unwrap();
    assert_eq!((named.leg, named.bodies.mass), (1e11, 0.2));
    let palms = parse(&text.replace("units = \"mm\"", "units = \"palm\""), Format::Toml).unwrap_err();
    assert!(palms[0].message.contains("needs a known unit of length, not \"palm\""), "{palms:?}");
    // in another unit of length the frequency is the same
    let mut design = design(&text);
    design.workspace = Workspace::default();
    let metres = design.in_units("m").unwrap();
    let lowest = |d: &DesignModel, unit: f64| {
        let pose = platform::geom::Pose {
            rotation: nalgebra::Rotation3::from_euler_angles(0.1, -0.2, 0.3),
            position: nalgebra::Vector3::new(3.0, -2.0, 14.0) * unit,
        };
        machine::requirements::lowest_frequency(d.manipulator(), &pose, &d.vibrating().unwrap())
    };
    let (one, other) = (lowest(&design, 1.0), lowest(&metres, 1e-3));
    assert!(one > 0.0 && (one / other - 1.0).abs() < 1e-9, "{one} {other}");
    assert!((metres.stiffness.unwrap().linear.unwrap() / 2e7 - 1.0).abs() < 1e-12);
}

#[test]
fn holes_are_read_and_written_back_and_follow_the_unit() {
    let text = GOOD.replacen("trajectory = \"path.csv\"\n", "", 1)
        + "[holes]\nbase = { pitch = 25 }\nplatform = { pattern = \"triangular\", pitch = 10, origin = [5, 2], angle_deg = -30 }\n";
    let (design, _) = parse(&text, Format::Toml).unwrap();
    let platform = Grid { origin: [5.0, 2.0], angle_deg: -30.0, ..Grid::triangular(10.0) };
    assert_eq!(design.holes, Some([Some(Grid::square(25.0)), Some(platform)]));
    for (text, format) in [(design.to_toml(), Format::Toml), (design.to_json(), Format::Json)] {
        assert_eq!(parse(&text, format).unwrap().0, design, "{text}");
    }
    let metres = design.in_units("m").unwrap();
    let scaled = Grid { pitch: 0.01, origin: [0.005, 0.002], ..platform };
    assert_eq!(metres.holes, Some([Some(Grid::square(0.025)), Some(scaled)]));
    for (from, to, code) in [
        ("pitch = 25", "pattern = \"square\"", Code::MissingKey),
        ("pitch = 25", "pitch = 0", Code::NotPositive),
        ("pitch = 25", "pitch = 25, radii = [20]", Code::UnknownKey),
        ("\"triangular\"", "\"hexagonal\"", Code::UnknownKey),
        ("origin = [5, 2]", "origin = [5]", Code::CoordinateCount),
        ("angle_deg = -30", "angle = -30", Code::UnknownKey),
    ] {
        let bad = text.replacen(from, to, 1);
        assert!(bad != text, "{from}");
        let violations = parse(&bad, Format::Toml).unwrap_err();
        assert_eq!(violations[0].code, code, "{to}");
    }
}

#[test]
fn holes_on_circles_and_of_one_plate_are_read_and_written_back() {
    let text = |holes: &str| GOOD.replacen("trajectory = \"path.csv\"\n", "", 1) + "[holes]\n" + holes;
    let read = |holes: &str| parse(&text(holes), Format::Toml).unwrap().0;
    let polar = Grid::polar(HoleCircle { radius: 100.0, holes: 24 }, 25.0);
    let bolts = |list: &[(f64, u32)]| {
        let list: Vec<HoleCircle> =
            list.iter().map(|(radius, holes)| HoleCircle { radius: *radius, holes: *holes }).collect();
        Some(Grid::bolt_circles(HoleCircles::new(&list).unwrap()))
    };
    let common = "pattern = \"polar\"\nfirst_radius = 100\npitch = 25\nstep_deg = 15\n";
    for (holes, expected) in [
        (common.into(), [Some(polar); 2]),
        (
            format!("{common}platform = {{ count = 36 }}"),
            [Some(polar), Some(Grid::polar(HoleCircle { radius: 100.0, holes: 36 }, 25.0))],
        ),
        (
            format!(
                "{common}platform = {{ pattern = \"bolt_circle\", radii = [80, 120], step_deg = [30, 20] }}"
            ),
            [Some(polar), bolts(&[(80.0, 12), (120.0, 18)])],
        ),
        (
            "base = { pattern = \"bolt_circle\", radii = 80, count = 6, angle_deg = 5 }".into(),
            [bolts(&[(80.0, 6)]).map(|g| Grid { angle_deg: 5.0, ..g }), None],
        ),
        ("[holes.platform]\npitch = 10\n".into(), [None, Some(Grid::square(10.0))]),
    ] {
        let design = read(&holes);
        assert_eq!(design.holes, Some(expected), "{holes}");
        for (text, format) in [(design.to_toml(), Format::Toml), (design.to_json(), Format::Json)] {
            assert_eq!(parse(&text, format).unwrap().0, design, "{text}");
        }
    }
    let metres = read(common).in_units("m").unwrap().holes.unwrap()[0].unwrap();
    let third = metres.circle(2).unwrap();
    assert!((third.radius - 0.15).abs() < 1e-15 && third.holes == 24);
    for (holes, code) in [
        ("", Code::MissingKey),
        ("pattern = \"polar\"\nfirst_radius = 100\npitch = 25\n", Code::MissingKey),
        ("pattern = \"polar\"\npitch = 25\ncount = 4\n", Code::MissingKey),
        ("pattern = \"polar\"\nfirst_radius = 100\npitch = 25\nstep_deg = 7\n", Code::Grid),
        ("pattern = \"polar\"\nfirst_radius = 100\npitch = 25\ncount = 2.5\n", Code::Grid),
        (
            "pattern = \"polar\"\nfirst_radius = 100\npitch = 25\ncount = 4\nstep_deg = 90\n",
            Code::ConflictingKeys,
        ),
        ("pattern = \"bolt_circle\"\ncount = 4\n", Code::MissingKey),
        ("pattern = \"bolt_circle\"\nradii = [1, 2, 3]\ncount = [4, 5]\n", Code::Grid),
        ("pattern = \"bolt_circle\"\nradii = [1, -2]\ncount = 4\n", Code::NotPositive),
        ("pattern = \"bolt_circle\"\nradii = []\ncount = 4\n", Code::Grid),
        ("pattern = \"bolt_circle\"\nradii = [1]\ncount = 4\npitch = 3\n", Code::UnknownKey),
    ] {
        let violations = parse(&text(holes), Format::Toml).unwrap_err();
        assert_eq!(violations[0].code, code, "{holes}: {violations:?}");
    }
}

/// Kinds of joints, which stand in tables of `[hardware]`.
const JOINTS: &str = "platform_axes = \"optimize\"\n";

#[test]
fn kinds_of_joints_are_read_scaled_and_written_back_to_the_bit() {
    let tables = "screw_lead = -4.5
base_joint = { model = \"universal\", first_axis = [3, 0, 4], angle_deg = [120, 40.5], offset = 2 }
platform_joint = { model = \"universal\", first_axis = [[1, 0, 0], [0, 1, 0], [1, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]] }
";
    let text = GOOD.replacen(JOINTS, tables, 1);
    let refused = parse(&text, Format::Toml).unwrap_err();
    assert_eq!(
        (refused.len(), refused[0].code),
        (1, Code::NotIdeal),
        "distances of joints are no lengths of drives"
    );
    let design = parse_with_cranks(&text, Format::Toml).unwrap().0;
    let base = design.hardware.base_universal.unwrap();
    assert_eq!(
        (base.limits_deg, base.offset, design.hardware.screw_lead),
        ([Some([120.0, 40.5]); 6], 2.0, Some(-4.5))
    );
    assert!(
        base.first_axes
            .iter()
            .all(|a| (a.unwrap().into_inner() - nalgebra::Vector3::new(0.6, 0.0, 0.8)).norm() < 1e-15)
    );
    assert!(matches!(base.axes, JointAxes::Given(_)), "the axes of the cone angles");
    let platform = design.hardware.platform_universal.unwrap();
    assert_eq!((platform.limits_deg, platform.axes), ([None; 6], JointAxes::Home));
    assert!((platform.first_axes[2].unwrap().x - 0.5f64.sqrt()).abs() < 1e-15);
    for format in [Format::Toml, Format::Json] {
        let text = match format {
            Format::Toml => design.to_toml(),
            Format::Json => design.to_json(),
        };
        assert_eq!(parse_with_cranks(&text, format).unwrap().0, design, "{text}");
    }
    // flexures bend within the cone angle and are ideal joints
    let flexure = format!("{JOINTS}platform_joint = {{ model = \"flexure\", bending_stiffness = 7e3 }}\n");
    let design = parse(&GOOD.replacen(JOINTS, &flexure, 1), Format::Toml).unwrap().0;
    assert_eq!((design.hardware.platform_bending, design.hardware.base_bending), ([Some(7e3); 6], [None; 6]));
    assert_eq!(parse(&design.to_toml(), Format::Toml).unwrap().0, design);
    let ideal = GOOD.replacen(JOINTS, "base_joint = { model = \"universal\", first_axis = [1, 0, 0] }\n", 1);
    let ideal = parse(&ideal, Format::Toml).unwrap().0;
    assert!(!ideal.hardware.is_coupled() && ideal.to_toml().contains("first_axis = [1.0, 0.0, 0.0]"));
}

/// Three universal joints, one of them without limits, two balls and a flexure.
const PER_LEG: &str = "base_joint = [
  { model = \"universal\", first_axis = [3, 0, 4], angle_deg = [120, 40.5] },
  { model = \"ball\" },
  { model = \"universal\", first_axis = [1, 0, 0], angle_deg = [50, 60], cone_angle_deg = 170 },
  { model = \"ball\", cone_angle_deg = 12, housing = 0.375 },
  { model = \"universal\", first_axis = [0, 1, 0] },
  { model = \"flexure\", bending_stiffness = 7e3, cone_angle_deg = 3.5, housing = [0.25, 0.5, 0.75] },
]
";

#[test]
fn kinds_of_joints_per_leg_are_read_scaled_and_written_back_to_the_bit() {
    use machine::requirements::JointType::{Ball, Flexure, Universal};
    let design = parse(&GOOD.replacen(JOINTS, PER_LEG, 1), Format::Toml).unwrap().0;
    let h = &design.hardware;
    let kinds: [_; 6] = std::array::from_fn(|leg| h.joint_kind(Body::Base, leg));
    assert_eq!(kinds, [Universal, Ball, Universal, Ball, Universal, Flexure]);
    assert!((0..6).all(|leg| h.joint_kind(Body::Platform, leg) == Ball));
    let joints = h.base_universal.unwrap();
    assert_eq!(joints.limits_deg[..3], [Some([120.0, 40.5]), None, Some([50.0, 60.0])]);
    assert!((joints.first_axes[0].unwrap().z - 0.8).abs() < 1e-15 && joints.first_axes[1].is_none());
    assert_eq!(h.base_bending, [None, None, None, None, None, Some(7e3)]);
    let block = Housing::Box(nalgebra::Vector3::new(0.25, 0.5, 0.75));
    assert_eq!(h.base_joint_housing, [None, None, None, Some(Housing::Sphere(0.375)), None, Some(block)]);
    assert_eq!(h.platform_joint_housing, [None; 6]);
    // the limit of the body applies to legs without their own
    assert_eq!(h.base_cone_angle.unwrap().limits_deg, [45.0, 45.0, 170.0, 12.0, 45.0, 3.5]);
    assert_eq!(h.platform_cone_angle.unwrap().limits_deg, [60.0; 6]);
    for format in [Format::Toml, Format::Json] {
        let text = match format {
            Format::Toml => design.to_toml(),
            Format::Json => design.to_json(),
        };
        assert_eq!(parse(&text, format).unwrap().0, design, "{text}");
    }
    // without a limit of the body the others have none
    let free = GOOD.replacen(JOINTS, PER_LEG, 1).replacen("base_cone_angle_deg = 45\n", "", 1);
    let free = parse(&free, Format::Toml).unwrap().0;
    assert_eq!(free.hardware.base_cone_angle.unwrap().limits_deg, [180.0, 180.0, 170.0, 12.0, 180.0, 3.5]);
    assert_eq!(parse(&free.to_toml(), Format::Toml).unwrap().0, free, "{}", free.to_toml());
    // six equal tables are one
    let ball = "{ model = \"ball\", cone_angle_deg = 45 }, ".repeat(6);
    let same = parse(&GOOD.replacen(JOINTS, &format!("base_joint = [{ball}]\n"), 1), Format::Toml).unwrap().0;
    let plain = parse(&GOOD.replacen(JOINTS, "", 1), Format::Toml).unwrap().0;
    assert_eq!(same.hardware, plain.hardware);
}

#[test]
fn faults_of_kinds_of_joints_per_leg_are_refused_at_their_place() {
    let (first, last) = (
        "{ model = \"universal\", first_axis = [3, 0, 4], angle_deg = [120, 40.5] }",
        "{ model = \"ball\" }",
    );
    let line_of = |old: &str, new: &str| -> Vec<String> {
        assert!(PER_LEG.contains(old), "{old}");
        let text = GOOD.replacen(JOINTS, &PER_LEG.replacen(old, new, 1), 1);
        let begin = text.lines().position(|l| l.starts_with("base_joint")).unwrap() + 1;
        let found = parse(&text, Format::Toml).unwrap_err();
        found.iter().map(|v| format!("+{} {} {}", v.line.wrapping_sub(begin), v.code, v.message)).collect()
    };
    let model = |new: &str| line_of(last, new);
    assert_eq!(model("{ model = \"cardan\" }"), ["+2 design::wrong_type `model` is \"cardan\""]);
    assert_eq!(
        model("{ cone_angle_deg = 3 }"),
        ["+2 design::missing_key `model` of `base_joint` of leg 2 in [hardware] is missing"]
    );
    assert_eq!(model("{ model = \"ball\", offset = 1 }").len(), 1);
    assert!(model("{ model = \"ball\", cone_angle_deg = 200 }")[0].starts_with("+2 design::out_of_range"));
    assert!(model("{ model = \"ball\", cone_angles = 20 }")[0].starts_with("+2 design::unknown_key"));
    assert!(model("\"ball\"")[0].starts_with("+2 design::wrong_type"));
    // five tables, six directions for one joint, an axis along the first axis
    assert!(
        model("{ model = \"ball\" }, { model = \"ball\" }")[0]
            .starts_with("+0 design::wrong_type `base_joint` is a list of 7")
    );
    let six = "{ model = \"universal\", first_axis = [[1, 0, 0], [0, 1, 0], [1, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]] }";
    assert!(line_of(first, six)[0].starts_with("+1 design::"));
    let along = line_of(first, "{ model = \"universal\", first_axis = [0, 0, 1] }");
    assert!(along[0].contains("the axis of leg 1 is the first axis"), "{along:?}");
    // an offset applies to all six joints
    let offset = line_of("angle_deg = [120, 40.5]", "angle_deg = [120, 40.5], offset = 2");
    assert!(
        offset
            .iter()
            .any(|v| v.starts_with("+2 design::conflicting_keys leg 2 has a joint without the `offset`")),
        "{offset:?}"
    );
    // a flexure without any greatest angle, and a lead of legs that turn freely
    let text = GOOD.replacen(JOINTS, &PER_LEG.replacen(", cone_angle_deg = 3.5", "", 1), 1).replacen(
        "base_cone_angle_deg = 45\n",
        "",
        1,
    );
    assert_eq!(parse(&text, Format::Toml).unwrap_err()[0].code, Code::MissingKey);
    let lead = GOOD.replacen(JOINTS, &format!("screw_lead = 5\n{PER_LEG}"), 1);
    assert_eq!(parse_with_cranks(&lead, Format::Toml).unwrap_err()[0].code, Code::MissingKey);
}

#[test]
fn kinds_of_joints_that_say_too_little_or_too_much_are_refused() {
    let universal = "base_joint = { model = \"universal\", first_axis = [1, 0, 0] }\n";
    for (line, code) in [
        ("base_joint = { first_axis = [1, 0, 0] }\n", Code::MissingKey),
        ("base_joint = { model = \"cardan\" }\n", Code::WrongType),
        ("base_joint = { model = \"universal\" }\n", Code::MissingKey),
        ("base_joint = { model = \"ball\", offset = 1 }\n", Code::ConflictingKeys),
        ("base_joint = { model = \"universal\", first_axis = [0, 0, 0] }\n", Code::NotPositive),
        ("base_joint = { model = \"universal\", first_axis = [0, 0] }\n", Code::WrongType),
        (
            "base_joint = { model = \"universal\", first_axis = [1, 0, 0], angle_deg = [50, 90] }\n",
            Code::OutOfRange,
        ),
        ("base_joint = { model = \"universal\", first_axis = [1, 0, 0], angle_deg = 40 }\n", Code::WrongType),
        ("base_joint = { model = \"universal\", first_axis = [1, 0, 0], offset = -1 }\n", Code::NotPositive),
        // the first two axes of the file
        ("base_joint = { model = \"universal\", first_axis = [0, 0, 1] }\n", Code::OutOfRange),
        ("base_joint = { model = \"flexure\" }\n", Code::MissingKey),
        ("base_joint = { model = \"flexure\", bending_stiffness = 0 }\n", Code::NotPositive),
        ("screw_lead = 5\n", Code::MissingKey),
        (
            "platform_axes = \"optimize\"\nplatform_joint = { model = \"universal\", first_axis = [1, 0, 0] }\n",
            Code::ConflictingKeys,
        ),
    ] {
        let violations = parse_with_cranks(&GOOD.replacen(JOINTS, line, 1), Format::Toml).unwrap_err();
        assert!(violations.iter().all(|v| v.code == code) && violations.len() < 3, "{line} {violations:?}");
    }
    let without = GOOD.replacen("platform_cone_angle_deg = 60\n", "", 1);
    let flexure = "platform_joint = { model = \"flexure\", bending_stiffness = 2 }\n";
    let violations = parse(&without.replacen(JOINTS, flexure, 1), Format::Toml).unwrap_err();
    assert_eq!(violations[0].code, Code::MissingKey, "a flexure without a greatest angle");
    assert!(parse(&without.replacen(JOINTS, universal, 1), Format::Toml).is_ok());
}

#[test]
fn fixed_joints_are_read_by_name_or_body_and_written_back() {
    let plain = GOOD.replacen("trajectory = \"path.csv\"\n", "", 1);
    let (head, tail) = plain.split_once("[optimize]\n").map_or((plain.as_str(), ""), |parts| parts);
    let text = |fixed: &str| format!("{head}[optimize]\nfixed = {fixed}\n{tail}");
    let read = |fixed: &str| parse(&text(fixed), Format::Toml).unwrap().0;
    let names = |list: &[&str]| list.iter().map(|n| (*n).to_owned()).collect::<Vec<_>>();
    for (fixed, base, platform) in [
        ("[\"P2\", \"P4\"]", names(&["P2"]), names(&["P4"])),
        ("[\"base\", \"P5\", \"P5\"]", names(&["P1", "P2", "P3"]), names(&["P5"])),
        ("[]", Vec::new(), Vec::new()),
    ] {
        let design = read(fixed);
        assert_eq!(design.search.fixed, [base, platform], "{fixed}");
        for (text, format) in [(design.to_toml(), Format::Toml), (design.to_json(), Format::Json)] {
            assert_eq!(parse(&text, format).unwrap().0, design, "{text}");
        }
    }
    let design = read("[\"P2\"]");
    assert_eq!(design.fixed_joints(Body::Base), [false, true, false]);
    assert!(design.has_fixed_joints() && !read("[]").has_fixed_joints());
    for (fixed, code) in
        [("[\"P9\"]", Code::UnknownName), ("[3]", Code::WrongType), ("\"P1\"", Code::WrongType)]
    {
        assert_eq!(parse(&text(fixed), Format::Toml).unwrap_err()[0].code, code, "{fixed}");
    }
}

/// Plates of both bodies, with all keys on the base.
const PLATES: &str = r#"
[plates.base]
thickness = 12
margin = 9
hole = 0.4
height = 2.5
material = "EN AW-5083"
density = 2660
edge_distance = 3
hole_distance = 0.2
foot = 3
bolts = { count = 4, circle = 2, hole = 0.25, first_deg = 30, from = "centre" }
[plates.platform]
thickness = 8
margin = 5
hole = 0.3
material = "steel"
[payload]
mass = 40
center = [1, 2, 30]
plate = "added"
box = { center = [0, 0, 30], size = [10, 12, 20] }
"#;

fn with_plates() -> String {
    format!("{}{PLATES}", GOOD.replacen("trajectory = \"path.csv\"\n", "", 1))
}

#[test]
fn plates_are_read_and_written_back_to_the_bit_and_follow_the_unit() {
    let (design, _) = parse(&with_plates(), Format::Toml).unwrap();
    let base = design.plates.base.as_ref().unwrap();
    assert_eq!((base.height, base.bolts.map(|b| b.count)), (Some(2.5), Some(4)));
    assert_eq!(base.kilograms_per_cubic_metre(), Some(2660.0));
    let platform = design.plates.platform.as_ref().unwrap();
    assert_eq!(platform.kilograms_per_cubic_metre(), Some(7850.0));
    // housings of 0.5 on holes of 0.3
    let height = platform.joint_height(&design.hardware, Body::Platform);
    assert!((height - 0.2).abs() < 1e-15);
    assert!(matches!(design.requirements().payload_shape, Some(KeepOutShape::Box { .. })));
    for (text, format) in [(design.to_toml(), Format::Toml), (design.to_json(), Format::Json)] {
        assert_eq!(parse(&text, format).unwrap().0, design, "{text}");
    }
    let metres = design.in_units("m").unwrap();
    let base = metres.plates.base.as_ref().unwrap();
    assert_eq!((base.thickness, base.height, base.bolts.unwrap().circle), (0.012, Some(0.0025), 0.002));
    assert_eq!(base.density, Some(2660.0), "a density keeps its unit");
    for body in Body::BOTH {
        let (one, other) = (design.plate_mass(body).unwrap(), metres.plate_mass(body).unwrap());
        assert!((one / other - 1.0).abs() < 1e-12, "{one} {other}");
    }
    // margins of holes are the same length in the other unit
    let least = |d: &DesignModel, kind: TermKind| {
        let required = d.requirements();
        let terms = machine::requirements::Terms::new(d.manipulator(), &required, &d.home_or_default());
        terms.fixed().into_iter().filter(|t| t.0.kind == kind).map(|t| t.1).fold(f64::INFINITY, f64::min)
    };
    for kind in [TermKind::BaseHoleEdge, TermKind::BaseHoleGap, TermKind::PlatformHoleEdge] {
        let (one, other) = (least(&design, kind), least(&metres, kind));
        assert!((one - 1000.0 * other).abs() < 1e-11, "{kind:?}: {one} {other}");
    }
}

#[test]
fn the_mass_of_a_plate_is_counted_once() {
    let design = |text: &str| parse(text, Format::Toml).unwrap().0;
    let added = design(&with_plates());
    let plate = added.plate_mass(Body::Platform).unwrap();
    // by a separate method: area of a polygon with many corners, minus the holes
    let solid = added.plate(Body::Platform).unwrap();
    let ring = solid.outline.polygon(20_000);
    let twice: f64 = (0..ring.len()).map(|i| ring[i].coords.perp(&ring[(i + 1) % ring.len()].coords)).sum();
    let area = 0.5 * twice - solid.seats.len() as f64 * std::f64::consts::PI * 0.15 * 0.15;
    assert!((plate / (7850e-9 * 8.0 * area) - 1.0).abs() < 1e-7);
    let moving = added.moving_payload().unwrap();
    assert!((moving.mass - 40.0 - plate).abs() < 1e-12);
    let rigid = added.rigid_plate(Body::Platform).unwrap();
    let first = nalgebra::Vector3::new(1.0, 2.0, 30.0) * 40.0 + rigid.center.coords * plate;
    assert!((moving.center.coords - first / (40.0 + plate)).norm() < 1e-12);
    // the inertia about any point is the sum of both: here about the origin
    let about = |mass: f64, c: nalgebra::Vector3<f64>| {
        (nalgebra::Matrix3::identity() * c.norm_squared() - c * c.transpose()) * mass
    };
    let all = moving.inertia.unwrap() + about(moving.mass, moving.center.coords);
    // a payload without inertia is a ball with the spread of the platform joints
    let joints = added.manipulator().platform_joints();
    let middle = joints.iter().map(|b| b.coords).sum::<nalgebra::Vector3<f64>>() / joints.len() as f64;
    let gyration =
        joints.iter().map(|b| (b.coords - middle).norm_squared()).sum::<f64>() / joints.len() as f64;
    let ball = nalgebra::Matrix3::identity() * (40.0 * gyration);
    assert!(added.mass_assumptions()[0].contains("a ball is assumed"));
    let parts = ball
        + about(40.0, nalgebra::Vector3::new(1.0, 2.0, 30.0))
        + rigid.inertia
        + about(plate, rigid.center.coords);
    assert!((all - parts).norm() < 1e-9 * parts.norm());
    assert!((added.all_loads()[0].force.z + (40.0 + plate) * GRAVITY).abs() < 1e-9);
    let included = design(&with_plates().replacen("plate = \"added\"\n", "", 1));
    let moving = included.moving_payload().unwrap();
    assert!((moving.inertia.unwrap() - ball).norm() < 1e-12 * ball.norm());
    let stated = machine::requirements::Payload { inertia: None, ..moving };
    assert_eq!(Some(stated), included.payload, "the mass has the plate in it");
    // without a payload only the plate moves
    let (text, _) = PLATES.split_once("[payload]").unwrap();
    let alone = design(&format!("{}{text}", GOOD.replacen("trajectory = \"path.csv\"\n", "", 1)));
    assert!((alone.moving_payload().unwrap().mass - plate).abs() < 1e-12);
    assert_eq!(alone.all_loads()[0].name, "platform plate");
    let unknown = design(&format!("{}{text}", GOOD.replacen("trajectory = \"path.csv\"\n", "", 1)).replacen(
        "material = \"steel\"\n",
        "",
        1,
    ));
    assert_eq!((unknown.moving_payload(), unknown.plate_mass(Body::Platform)), (None, None));
}

#[test]
fn plates_that_cannot_be_are_refused_at_their_place() {
    let mut all = String::new();
    let lines = GOOD.replacen("trajectory = \"path.csv\"\n", "", 1).lines().count();
    for (from, to) in [
        ("thickness = 12\n", ""),
        ("margin = 9", "margin = 0.2"),
        ("hole = 0.3", "hole = 0.6"),
        ("hole = 0.4", "hole = 0"),
        ("material = \"steel\"", "material = \"steal\""),
        ("density = 2660", "density = -1"),
        ("count = 4, ", ""),
        ("count = 4", "count = 2.5"),
        ("circle = 2", "circle = \"2\""),
        ("from = \"centre\"", "from = \"corner\""),
        ("first_deg = 30", "first = 30"),
        ("[plates.platform]", "[plates.top]"),
        ("plate = \"added\"", "plate = \"twice\""),
        ("mass = 40", "mass = 1e-9"),
        (
            "box = { center = [0, 0, 30]",
            "sphere = { center = [0, 0, 1], diameter = 2 }\nbox = { center = [0, 0, 30]",
        ),
        ("material = \"steel\"\n", ""),
    ] {
        assert!(PLATES.contains(from), "{from}");
        let mut text = with_plates().replacen(from, to, 1);
        if to == "mass = 1e-9" {
            text = text.replacen("plate = \"added\"\n", "", 1);
        }
        match parse(&text, Format::Toml) {
            Ok(_) => panic!("accepted: {to}"),
            Err(violations) => {
                for v in violations {
                    assert!(v.line > lines, "{to}: {v:?}");
                    let line = v.line - lines;
                    let _ = writeln!(all, "{line}:{} {}: {} | {}", v.column, v.code, v.message, v.help);
                }
            }
        }
    }
    assert_eq!(
        all,
        r#"2:9 design::missing_key: `base` of [plates] has no `thickness` | add thickness = 20
4:10 design::out_of_range: a `margin` of 0.2 with holes of 0.4 | a hole has to end inside the outline: give a margin of more than half of it
16:8 design::out_of_range: a `hole` of 0.6 under housings of 0.5 | a ball has to be wider than the hole below it: give a smaller hole, or the `height` of the joints
5:8 design::not_positive: `hole` is 0 | give a positive number
17:12 design::missing_key: the density of `material` "steal" is not known | add `density`, kg/m^3; did you mean `steel`?
8:11 design::not_positive: `density` is -1 | give a positive number
12:9 design::missing_key: `count` of `bolts` is missing | bolts take count, circle (its diameter) and hole, and may take first_deg and from
12:19 design::out_of_range: `count` is 2.5 | give a whole number from 1 to 64
12:31 design::wrong_type: `circle` is a string, not a number | write a number without quotes
12:70 design::wrong_type: `from` is "corner" | write "axis" or "centre"
12:47 design::unknown_key: `first` is not a key of `bolts` | did you mean `first_deg`?
13:9 design::unknown_key: `top` is not a key of [plates] | known keys: base, platform
21:9 design::wrong_type: `plate` of [payload] is "twice" | write "included" or "added"
18:2 design::out_of_range: the payload with the platform weighs 0.000000001 kg, and the plate of the platform alone 0.011549938371315342 | give `mass` with the plate, or write plate = "added" for a mass without it
22:1 design::conflicting_keys: [payload] has two shapes | keep `box` or `sphere`
17:2 design::missing_key: the plate is to be added to the payload, and its mass is not known | add [plates.platform] with `material` or `density`, or remove `plate`
"#
    );
    let palms = with_plates().replace("units = \"mm\"", "units = \"palm\"");
    let found = parse(&palms, Format::Toml).unwrap_err();
    assert!(found.iter().any(|v| v.message.contains("mass of a plate needs a known unit")), "{found:?}");
}

/// The axes of joints are the normal of their plane, one vector, or a list that may contain normals. Normals are
/// written back as vectors.
#[test]
fn axes_are_normals_vectors_or_both() {
    let with = |base: &str, platform: &str| {
        let text = GOOD
            .replacen(
                "base_axes = [[0, 0, 1], [0, 0, 2], [1, 1, 1], [0, 3, 4], [0.1, 0.2, 0.3], [7, 1, 2]]",
                base,
                1,
            )
            .replacen("platform_axes = \"optimize\"", platform, 1);
        parse(&text, Format::Toml).unwrap().0
    };
    let given = |cone_angle: Option<machine::requirements::ConeLimits>| {
        let JointAxes::Given(axes) = cone_angle.unwrap().axes else { panic!("axes are known") };
        axes.map(nalgebra::Unit::into_inner)
    };
    let design = with("base_axes = \"normal\"", "platform_axes = [0, 3, 4]");
    let h = design.hardware;
    let home = design.home_or_default();
    for (leg, normal) in design.manipulator().legs().iter().zip(given(h.base_cone_angle)) {
        let joints = design.manipulator().base_joints();
        assert!(joints.iter().all(|p| (p - joints[0]).dot(&normal).abs() < 1e-12), "{normal}");
        assert!((home.transform(&leg.platform) - leg.base).dot(&normal) > 0.0, "towards the platform");
    }
    let tilted = nalgebra::Vector3::new(0.0, 0.6, 0.8);
    assert!(given(h.platform_cone_angle).iter().all(|axis| (axis - tilted).norm() < 1e-15));
    // joint angles count from them, in `assess` and `ik` alike
    let required = design.requirements();
    let terms = machine::requirements::Terms::new(design.manipulator(), &required, &home);
    let margins = terms.at(&home);
    for (i, leg) in design.manipulator().legs().iter().enumerate() {
        let line = home.transform(&leg.platform) - leg.base;
        let cone_angle = line.angle(&given(h.base_cone_angle)[i]).to_degrees();
        let margin =
            margins.iter().find(|(t, _)| t.kind == TermKind::BaseConeAngle && t.first == i).unwrap().1;
        assert!((margin - (45.0 - cone_angle)).abs() < 1e-9, "{margin} {cone_angle}");
    }
    let mixed = with(
        "base_axes = [\"normal\", [1, 0, 0], \"normal\", [0, 1, 0], [0, 0, 1], \"normal\"]",
        "platform_axes = \"normal\"",
    );
    let axes = given(mixed.hardware.base_cone_angle);
    assert_eq!((axes[0], axes[1]), (given(h.base_cone_angle)[0], nalgebra::Vector3::x()));
    assert_eq!(axes[2], axes[5]);
    for design in [design, mixed] {
        assert_eq!(parse(&design.to_toml(), Format::Toml).unwrap().0, design);
        assert_eq!(parse(&design.to_json(), Format::Json).unwrap().0, design);
    }
    let wrong = GOOD.replacen("platform_axes = \"optimize\"", "platform_axes = \"normals\"", 1);
    assert_eq!(parse(&wrong, Format::Toml).unwrap_err()[0].code, Code::WrongType);
    // a normal along the first axis of a universal joint is refused as any other axis
    let universal = GOOD.replacen(
        "platform_axes = \"optimize\"",
        "platform_axes = \"normal\"\nplatform_joint = { model = \"universal\", first_axis = [0, 0, 1] }",
        1,
    );
    assert!(parse(&universal, Format::Toml).is_err());
}

/// The name of a table of drives is kept; a design with a chosen drive names none.
#[test]
fn a_table_of_drives_is_named() {
    let text = GOOD.replacen("max_leg_force = 500", "max_leg_force = 500\ndrives = \"struts.csv\"", 1);
    let design = parse(&text, Format::Toml).unwrap().0;
    assert_eq!(design.drive_table.as_deref(), Some("struts.csv"));
    assert_eq!(parse(&design.to_toml(), Format::Toml).unwrap().0, design);
    assert_eq!(parse(&design.to_json(), Format::Json).unwrap().0, design);
    let wrong = GOOD.replacen("max_leg_force = 500", "max_leg_force = 500\ndrives = 3", 1);
    assert_eq!(parse(&wrong, Format::Toml).unwrap_err()[0].code, Code::WrongType);
}

/// `assess` and `motion` have the same forces at rest, in all units. The designs have heavy legs, with a payload, with
/// a plate alone and with neither.
#[test]
fn the_weight_of_all_that_moves_is_one_load() {
    let design = |text: &str| parse(text, Format::Toml).unwrap().0;
    let plain = GOOD.replacen("trajectory = \"path.csv\"\n", "", 1);
    let payload = "[payload]\nmass = 30\ncenter = [0.1, 0.2, 1.0]\ngravity = [1.5, -0.5, -9.0]\n";
    let (plates, _) = PLATES.split_once("[payload]").unwrap();
    let kinds = [
        ("payload", format!("{plain}{payload}")),
        ("platform plate", format!("{plain}{plates}")),
        ("legs", plain.clone()),
    ];
    let mut rng = num::Rng::new(41);
    for (name, text) in &kinds {
        for (force, mass) in [("N", "kg"), ("kN", "t"), ("lbf", "lb"), ("kgf", "g")] {
            let units = format!("units = \"mm\"\nforce_units = \"{force}\"\nmass_units = \"{mass}\"");
            let design = design(&text.replacen("units = \"mm\"", &units, 1));
            let loads = design.all_loads();
            assert_eq!((loads.len(), loads[0].name.as_str()), (3, *name));
            assert!(loads[0].legs.is_some() && loads[1..].iter().all(|load| load.legs.is_none()));
            // legs alone: the platform has no mass
            let nothing = || design.assumed_bodies(0.0, 1e-3);
            let bodies = design.moving_bodies(1e-3).unwrap_or_else(nothing);
            let in_unit = design.force_unit().newtons() / bodies.metres;
            let (m, home) = (design.manipulator(), design.home.unwrap());
            for _ in 0..20 {
                let turn = nalgebra::Vector3::from_fn(|_, _| 0.1 * rng.normal());
                let shift = nalgebra::Vector3::from_fn(|_, _| 0.5 * rng.normal());
                let pose = platform::geom::Pose {
                    rotation: nalgebra::Rotation3::new(turn) * home.rotation,
                    position: home.position + shift,
                };
                let state = machine::dynamics::MotionState::at_rest(pose);
                let none = nalgebra::Vector6::zeros();
                let moving = machine::dynamics::drive_forces(m, &bodies, &state, &none).unwrap();
                let moving = nalgebra::Vector6::from(moving) / in_unit;
                let held = machine::requirements::leg_forces(m, &pose, &loads[0].wrench(m, &pose), m.size())
                    .unwrap();
                assert!((moving - held).amax() <= 1e-9 * moving.amax(), "{name} {force}: {moving} {held}");
            }
        }
    }
}

/// Each answer lists the assumptions behind its forces once.
#[test]
fn assumptions_name_what_has_no_mass() {
    let design = |text: &str| parse(text, Format::Toml).unwrap().0;
    let plain = GOOD.replacen("trajectory = \"path.csv\"\n", "", 1);
    let without = |text: &str| {
        let lines = text.lines().filter(|line| {
            !["cylinder_mass", "cylinder_center", "rod_mass", "rod_center", "rod_inertia", "reflected_mass"]
                .iter()
                .any(|key| line.starts_with(key))
        });
        lines.fold(String::new(), |text, line| text + line + "\n")
    };
    let payload = "[payload]\nmass = 30\n";
    let said = |text: &str, at_rest, in_motion| {
        design(text).assumptions_of(super::AssessedForces { at_rest, in_motion })
    };
    assert_eq!(said(&plain, false, false), Vec::<String>::new());
    let of_legs = said(&plain, true, false);
    assert!(of_legs[0].contains("platform is assumed massless"), "{of_legs:?}");
    assert!(of_legs.len() == 3 && of_legs.iter().all(|s| !s.contains("legs have no masses")), "{of_legs:?}");
    // nothing has weight, so no unit of mass is needed
    let nothing = said(&without(&plain), true, false);
    assert!(nothing.len() == 3 && nothing[1].contains("legs have no masses"), "{nothing:?}");
    let whole = format!("{}{payload}", without(&plain));
    let (rest, both) = (said(&whole, true, false), said(&whole, true, true));
    assert_eq!(both[1..], rest, "the inertia matters in motion alone");
    assert!(both[0].contains("no inertia") && rest.len() == 3, "{both:?}");
    assert_eq!(said(&whole, false, true), both, "no sentence stands twice");
}
