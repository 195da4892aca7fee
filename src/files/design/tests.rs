//! Every violation has its line and help; written designs are read back; no input panics.
#![allow(clippy::format_collect, clippy::float_cmp, reason = "short texts; exact values are read")]

use super::fixtures::PLAIN as GOOD;
use super::*;

/// One line per violation.
fn refusals(text: &str, format: Format) -> String {
    match parse(text, format) {
        Ok((_, warnings)) => {
            warnings.iter().map(|w| format!("{} {}: {w} | {}\n", w.line(), w.code(), w.advice())).collect()
        }
        Err(violations) => violations
            .iter()
            .map(|v| format!("{}:{} {}: {} | {}\n", v.line, v.column, v.code, v.message, v.help))
            .collect(),
    }
}

/// Refusals of the good design after one replacement.
fn after(from: &str, to: &str) -> String {
    assert!(GOOD.contains(from), "{from}");
    refusals(&GOOD.replacen(from, to, 1), Format::Toml)
}

#[test]
fn a_good_design_is_read_whole() {
    let (design, warnings) = parse(GOOD, Format::Toml).unwrap();
    assert_eq!(warnings, []);
    assert_eq!((design.name.as_str(), design.units.as_str()), ("octahedral", "mm"));
    assert_eq!(design.base_names(), ["P1", "P2", "P3"]);
    assert_eq!(design.leg_names()[3], ("P3", "P5"));
    assert_eq!(design.lengths.unwrap().get(), [9.0; 6]);
    let home = design.home.unwrap();
    assert!((home.rotation * nalgebra::Vector3::x() - nalgebra::Vector3::y()).norm() < 1e-15);
    assert_eq!(design.workspace.sample(&home).len(), 9);
    assert_eq!(design.optimize.min_abs_det, Some(0.1));
    assert_eq!(design.hardware.joint_diameter, Some(0.5));
}

#[test]
fn keys_texts_and_numbers() {
    let mut all = String::new();
    for (from, to) in [
        ("units = \"mm\"", "unit = \"mm\""),
        ("name = \"octahedral\"", "name = 5"),
        ("name = \"octahedral\"", "name = \" \""),
        ("P1 = [0, 0, 0]", "P1 = [0, nan, -inf]"),
        ("P1 = [0, 0, 0]", "P1 = [0, 0]"),
        ("P1 = [0, 0, 0]", "P1 = [0, 0, 0, 1]"),
        ("P1 = [0, 0, 0]", "P1 = [0, \"1\", true]"),
        ("P1 = [0, 0, 0]", "P1 = [0, 1e300, 1e999]"),
        ("P1 = [0, 0, 0]", "P1 = 7"),
        ("P1 = [0, 0, 0]", "\"\" = [0, 0, 1]\nP1 = [0, 0, 0]"),
        ("P1 = [0, 0, 0]", "P1 = [0, 0, 0]\nP1 = [0, 0, 1]"),
        ("9.0, 9, 9, 9]", "-9.0, 9, 9, nan]"),
        ("9.0, 9, 9, 9]", "-9.0, 9, 9, 9]"),
        ("9.0, 9, 9, 9]", "9.0, 9, 9, 9, 9]"),
    ] {
        all.push_str(&after(from, to));
    }
    assert_eq!(
        all,
        r#"1:1 design::missing_key: `units` is missing | add `units = "mm"` (a label; all lengths are in it) at the top
2:1 design::unknown_key: `unit` is not a key of a design | did you mean `units`?
1:8 design::wrong_type: `name` is a number, not a string | write `name = "..."`
1:8 design::empty_name: `name` is empty | write something between the quotes of `name`
6:10 design::non_finite: number 2 of base joint P1 is NaN, not a finite number | write a finite number
6:15 design::non_finite: number 3 of base joint P1 is -inf, not a finite number | write a finite number
6:6 design::coordinate_count: base joint P1 has 2 numbers instead of 3 | give 3 coordinates x, y, z
6:6 design::coordinate_count: base joint P1 has 4 numbers instead of 3 | give 3 coordinates x, y, z
6:15 design::wrong_type: coordinate 3 of base joint P1 is a boolean, not a number | write a number, or an expression in quotes such as "6*sqrt(3)"
6:10 design::out_of_range: number 2 of base joint P1 is 1e300, which is too large to compute with | stay below 1e60; use a larger unit
6:17 design::non_finite: number 3 of base joint P1 is inf, not a finite number | write a finite number
6:6 design::wrong_type: base joint P1 is a number, not an array | write an array of 3 coordinates x, y, z
6:1 design::empty_name: a joint of the base has an empty name | give the joint a name
7:1 design::duplicate_key: this key is defined twice | keep one of the two
3:18 design::negative_length: the length of leg 3 is -9 | leg lengths are not negative
3:30 design::non_finite: number 6 of `lengths` is NaN, not a finite number | write a finite number
3:18 design::negative_length: the length of leg 3 is -9 | leg lengths are not negative
3:11 design::length_count: `lengths` has 7 numbers instead of 6 | give 6 leg lengths, one for each leg
"#
    );
}

#[test]
fn legs_and_triangles() {
    let mut all = String::new();
    for (from, to) in [
        (", [\"P1\", \"P6\"]]", "]"),
        ("[\"P1\", \"P6\"]]", "[\"P1\", \"P4\"]]"),
        ("[\"P1\", \"P6\"]]", "[\"P9\", \"X\"]]"),
        ("[\"P1\", \"P6\"]]", "[\"P6\", \"P1\"]]"),
        ("[\"P1\", \"P6\"]]", "[\"P1\"]]"),
        ("[\"P1\", \"P6\"]]", "5]"),
        ("P3 = [12.0, 0.0, 0.0]", "P3 = [12.0, 20.784609690826528, 0.0]"),
        ("P3 = [12.0, 0.0, 0.0]", "P3 = [12.0, 0.0, 0.0]\nP7 = [-0.0, 0.0, 0.0]"),
        ("[base]", "[bse]"),
        ("legs = [", "leg = ["),
    ] {
        all.push_str(&after(from, to));
    }
    let one_point: String = (1..=6).map(|i| format!("J{i} = [1, 1, 1]\n")).collect();
    let pairs: Vec<String> = (1..=6).map(|i| format!("[\"J{i}\", \"J{i}\"]")).collect();
    let pairs = pairs.join(", ");
    let text =
        format!("name = 'a'\nunits = 'm'\nlegs = [{pairs}]\n[base]\n{one_point}[platform]\n{one_point}");
    all.push_str(&refusals(&text, Format::Toml));
    assert_eq!(
        all,
        r#"4:1 design::leg_count: there are 5 legs instead of six | write six pairs: legs = [["A1", "B1"], ["A2", "B2"], ...]; `equipod check` and `equipod fk` take designs of five legs
4 design::coincident_legs: legs 1 and 6 join the same two points | give each leg its own pair of joints: two legs on one line hold the platform like one leg
4:80 design::missing_joint: leg 6 names `P9`, which is not a joint of the base | add `P9 = [x, y, z]` to [base]
4:86 design::missing_joint: leg 6 names `X`, which is not a joint of the platform | add `X = [x, y, z]` to [platform]
4:80 design::missing_joint: leg 6 names `P6`, which is not a joint of the base | `P6` is a joint of the platform; a leg names the base joint first
4:86 design::missing_joint: leg 6 names `P1`, which is not a joint of the platform | `P1` is a joint of the base; a leg names the base joint first
4:79 design::leg_shape: leg 6 is not a pair of joint names | write ["base joint", "platform joint"]
4:79 design::leg_shape: leg 6 is not a pair of joint names | write ["base joint", "platform joint"]
5:2 design::collinear_triangle: the base joints P1, P2, P3 are on one line | move one of them: a body held in three points on a line can turn about it
9 design::coincident_joints: base joints P1 and P7 have the same coordinates | if the legs share one joint, name P1 in all of them: P1 and P7 count as two joints
9 design::unused_joint: base joint P7 carries no leg | attach a leg to P7 or remove it
1:1 design::missing_key: `base` is missing | add [base] with joints such as `A1 = [0.0, 0.0, 0.0]`
5:2 design::unknown_key: `bse` is not a key of a design | did you mean `base`?
1:1 design::missing_key: `legs` is missing | add `legs = [["A1", "B1"], ...]` with six pairs base-platform above the first [table]
4:1 design::unknown_key: `leg` is not a key of a design | did you mean `legs`?
1:1 design::no_size: all joints in use of the base coincide, and so do those of the platform | give the joints different coordinates
"#
    );
}

#[test]
fn optional_tables() {
    let mut all = String::new();
    for (from, to) in [
        ("rpy_deg = [0.0, 0.0, 90.0]", "quat_wxyz = [1, 0, 0, 1]"),
        ("rpy_deg = [0.0, 0.0, 90.0]", "rpy_deg = [0, 0, 0]\nquat_wxyz = [1, 0, 0, 0]"),
        ("rpy_deg = [0.0, 0.0, 90.0]", "rotation = [[1, 0, 0], [0, 1, 0], [0, 0, -1]]"),
        ("rpy_deg = [0.0, 0.0, 90.0]", "rpy = [0, 0, 0]"),
        ("position = [3.0, 5.0, 8.0]\n", ""),
        ("[home]\nposition = [3.0, 5.0, 8.0]\nrpy_deg = [0.0, 0.0, 90.0]\n", ""),
        ("translation = [1, 1, 1]", "translation = [1, -1, 1]\nrotation_deg = [0, 0, 200]\ngrid = 2.5"),
        ("translation = [1, 1, 1]", "poses = [{ position = [0, 0, 1] }, 3]"),
        ("min_abs_det = 0.1", "min_abs_det = 0\nmin_joint_distnce = 1"),
        ("joint_diameter = 0.5", "joint_diameter = -0.5"),
        ("[hardware]\njoint_diameter = 0.5", "hardware = 3"),
        ("[optimize]", "[optimise]"),
    ] {
        all.push_str(&after(from, to));
    }
    assert_eq!(
        all,
        r"15:13 design::rotation: `quat_wxyz` of [home] has norm 1.4142135623730951, not 1 | divide the quaternion by its norm
16:1 design::rotation: [home] gives its rotation more than once | give one of rpy_deg = [roll, pitch, yaw], quat_wxyz = [w, x, y, z], rotation = [[..], [..], [..]]
15:12 design::rotation: `rotation` of [home] is not a rotation: R^T R differs from I by 0e0, det R = -1 | give all digits and a right-handed frame, or use quat_wxyz, which is normalised
13:1 design::rotation: [home] has no rotation | give one of rpy_deg = [roll, pitch, yaw], quat_wxyz = [w, x, y, z], rotation = [[..], [..], [..]]
15:1 design::unknown_key: `rpy` is not a key of [home] | did you mean `rpy_deg`?
13:1 design::missing_key: `position` of [home] is missing | add position = [x, y, z]
13:2 design::missing_home: the box lies around [home], which is missing | add [home] with position and rpy_deg, or list single poses
17:19 design::not_positive: a half width of -1 | half widths are not negative
18:23 design::out_of_range: a half width of `rotation_deg` is 200 degrees | give at most 180 degrees
19:8 design::grid: `grid` is 2.5 | give 1 (centre), 2 (centre and corners), 3, 4 or 5 points per axis
17:10 design::rotation: pose 1 of [workspace] has no rotation | give one of rpy_deg = [roll, pitch, yaw], quat_wxyz = [w, x, y, z], rotation = [[..], [..], [..]]
17:36 design::wrong_type: pose 2 of [workspace] is a number, not a table | write pose 2 of [workspace] as a table
19:15 design::not_positive: `min_abs_det` is 0 | give a positive number
20:1 design::unknown_key: `min_joint_distnce` is not a key of [optimize] | did you mean `min_joint_distance`?
21:18 design::not_positive: `joint_diameter` is -0.5 | give a positive number
20:1 design::unknown_key: `hardware` is not a key of [optimize] | known keys: min_joint_distance, min_abs_det, characteristic_length, variables, symmetry, objective, objectives, mode, slack, points, offset_bounds, stretch_bounds, height_bounds, fixed
18:2 design::unknown_key: `optimise` is not a key of a design | did you mean `optimize`?
"
    );
}

#[test]
fn texts_that_are_no_design() {
    let mut all = String::new();
    for (text, format) in [
        ("", Format::Toml),
        (" \n", Format::Json),
        ("name = ", Format::Toml),
        ("[1, 2]", Format::Json),
        ("{\"name\": \"a\", // note\n}", Format::Json),
        ("{\"name\": \"a\", \"name\": \"b\", \"units\": NaN}", Format::Json),
        ("{\"name\": \"a\", \"name\": \"b\", \"units\": null}", Format::Json),
        ("{\"lengths\": [1,]}", Format::Json),
    ] {
        all.push_str(&refusals(text, format));
        all.push('\n');
    }
    assert_eq!(
        all,
        r#"1:1 design::empty: the file is empty | a design needs name, units, legs, [base] and [platform]; `designs/` has examples

1:1 design::empty: the file is empty | a design needs name, units, legs, [base] and [platform]; `designs/` has examples

1:8 design::syntax: string values must be quoted, expected literal string | correct the TOML (https://toml.io): strings need quotes, tables [brackets]; `equipod new --points FILE` reads tables of joints

1:1 design::wrong_type: a design is a table, not an array | write { "name": ..., "units": ..., "base": { ... }, "platform": { ... }, "legs": [ ... ] }

1:15 design::syntax: Comments are not allowed | correct the JSON: double quotes, no comments, no trailing commas, no NaN or Infinity

1:37 design::syntax: Unexpected token | correct the JSON: double quotes, no comments, no trailing commas, no NaN or Infinity

1:1 design::missing_key: `legs` is missing | add `legs = [["A1", "B1"], ...]` with six pairs base-platform above the first [table]
1:1 design::missing_key: `base` is missing | add [base] with joints such as `A1 = [0.0, 0.0, 0.0]`
1:1 design::missing_key: `platform` is missing | add [platform] with joints such as `B1 = [0.0, 0.0, 0.0]`
1:15 design::duplicate_key: this key is defined twice | keep one of the two
1:37 design::wrong_type: `units` is null, not a string | write `units = "..."`

1:15 design::syntax: Trailing commas are not allowed | correct the JSON: double quotes, no comments, no trailing commas, no NaN or Infinity

"#
    );
}

#[test]
fn legs_below_a_table_header_are_taken_with_a_warning() {
    let legs = GOOD.lines().find(|l| l.starts_with("legs")).unwrap();
    let moved = GOOD.replace(&format!("{legs}\n"), "").replace("[home]", &format!("{legs}\n[home]"));
    let (design, warnings) = parse(&moved, Format::Toml).unwrap();
    assert_eq!(design.platform_names(), ["P4", "P5", "P6"]);
    assert_eq!(warnings, [Warning::LegsInsideTable { table: "platform", line: 12 }]);
    // a joint may be named "legs", and is then a joint
    let joint = GOOD.replace("P6", "legs");
    let (design, warnings) = parse(&joint, Format::Toml).unwrap();
    assert_eq!((design.platform_names()[2].as_str(), warnings.len()), ("legs", 0));
}

#[test]
fn deep_nesting_and_floods_end_soon() {
    let n = 1 << 20;
    for (text, format) in [
        (format!("a = {}", "[".repeat(n)), Format::Toml),
        (format!("a = {}1{}", "[".repeat(60), "]".repeat(60)), Format::Toml),
        (format!("a = {}", "{a=".repeat(n)), Format::Toml),
        (format!("{} = 1", vec!["a"; n].join(".")), Format::Toml),
        ("[".repeat(n), Format::Json),
        (format!("{}1{}", "[".repeat(400), "]".repeat(400)), Format::Json),
        ("{\"a\":".repeat(n), Format::Json),
    ] {
        let violations = parse(&text, format).unwrap_err();
        assert!(!violations.is_empty() && violations.len() <= 101);
    }
    let flood: String = (0..50_000).map(|i| format!("k{i} = 1\n")).collect();
    let violations = parse(&flood, Format::Toml).unwrap_err();
    assert_eq!(violations.last().unwrap().code, Code::TooMany);
}

#[test]
fn one_open_bracket_is_one_fault_and_a_second_fault_is_told() {
    let faults = |text: &str| parse(text, Format::Toml).unwrap_err();
    for (at, _) in GOOD.match_indices('\n') {
        let found = faults(&format!("{}=[{}", &GOOD[..at], &GOOD[at..]));
        assert!(found.len() <= 4, "{at}: {found:?}");
        let line = GOOD[..at].lines().count();
        assert!(found[0].code == Code::Syntax && found[0].line.abs_diff(line) <= 1, "{at}: {found:?}");
    }
    let found = faults(&GOOD.replacen("units =", "units", 1).replacen("translation =", "translation", 1));
    let places: Vec<_> = found.iter().map(|v| (v.line, v.column)).collect();
    let second = GOOD.lines().position(|l| l.starts_with("translation")).unwrap() + 1;
    assert_eq!(places, [(2, 7), (second, 13)]);
}

#[test]
fn bom_and_windows_line_ends_are_read() {
    let text = format!("\u{feff}{}", GOOD.replace('\n', "\r\n"));
    assert!(parse(&text, Format::Toml).is_ok());
    let slip = parse(&text.replace("units", "unit"), Format::Toml).unwrap_err();
    assert!(slip.iter().any(|v| v.code == Code::UnknownKey && (v.line, v.column) == (2, 1)));
}

/// Names that display differently from their text, plainly and by an escape.
#[test]
fn text_that_changes_its_direction_is_refused_where_it_stands() {
    for (text, format, place) in [
        (GOOD.replace("name = \"octahedral\"", "name = \"\u{202e}lardehatco\""), Format::Toml, (1, 8)),
        (GOOD.replace("P1 = ", "\"P1\u{2066}\" = "), Format::Toml, (6, 1)),
        ("{\"name\": \"\\u202e\"}".to_owned(), Format::Json, (1, 10)),
    ] {
        let violations = parse(&text, format).unwrap_err();
        let found = violations
            .iter()
            .find(|v| v.code == Code::TextDirection)
            .unwrap_or_else(|| panic!("{violations:?}"));
        assert_eq!((found.line, found.column), place, "{found}");
        assert!(found.message.contains("\\u{20"), "{found}");
    }
}
