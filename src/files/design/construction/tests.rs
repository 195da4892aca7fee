use proptest::prelude::*;

use super::Exactness;
use crate::design::{Code, DesignModel, Format, JointError, Violation, parse};
use platform::manipulator::Body;

/// A design with these lines in `[parameters]` and `[base]`.
fn text(parameters: &str, base: &str) -> String {
    format!(
        r#"name = "constructed"
units = "mm"
legs = [["A", "D"], ["B", "D"], ["B", "E"], ["C", "E"], ["C", "F"], ["A", "F"]]
[parameters]
{parameters}
[base]
{base}
[platform]
D = [0.0, 0.0, 0.0]
E = [6.0, 0.0, 0.0]
F = [3.0, 5.0, 0.0]
"#
    )
}

const TRIANGLE: &str = "A = [0, 0, 0]\nB = [\"6\", \"6*sqrt(3)\", 0]\nC = [12, 0, 0]\n";

fn read(parameters: &str, base: &str) -> DesignModel {
    let text = text(parameters, base);
    parse(&text, Format::Toml).unwrap_or_else(|v| panic!("{text}\n{v:?}")).0
}

fn refused(parameters: &str, base: &str) -> Vec<Violation> {
    parse(&text(parameters, base), Format::Toml).unwrap_err()
}

fn base(design: &DesignModel, name: &str) -> ([String; 3], Exactness, [f64; 3]) {
    let i = design.base_names().iter().position(|n| n == name).unwrap();
    let exact = design.exact_joints(Body::Base).swap_remove(i);
    (exact.coordinates, exact.exactness, design.manipulator().base_joints()[i].coords.into())
}

fn bits(p: [f64; 3]) -> [u64; 3] {
    p.map(|x| (x + 0.0).to_bits())
}

#[test]
fn every_form_gives_the_exact_point_and_the_nearest_doubles() {
    let forms = "A = [0, 0, 0]
B = [\"6\", \"6*sqrt(3)\", 0]
C = [12, 0, 0]
tenth = [\"0.1\", 0.1, 1]
plain = [0.1, 0.1, 1]
polar = { radius = \"r\", angle_deg = 30 }
high = { radius = 2.0, angle_deg = \"90 + 45\", z = \"h/3\" }
turned = { turn = \"polar\", deg = 120 }
mirrored = { mirror = \"high\", plane = \"yz\" }
share = { on = [\"A\", \"B\"], t = \"1/5\" }
offset = { on = [\"B\", \"A\"], offset = 2.4 }
beyond = { on = [\"A\", \"C\"], offset = -1 }
odd = { radius = 1, angle_deg = 17, z = 0.5 }
five = { radius = 2, angle_deg = 36 }
";
    let d = read("h = \"r/2\"\nr = 6.0", forms);
    let exact = |name: &str| base(&d, name).0;
    let strings = |x: [&str; 3]| x.map(String::from);
    assert_eq!(exact("B"), strings(["6", "6*sqrt(3)", "0"]));
    assert_eq!(exact("tenth"), strings(["1/10", "1/10", "1"]));
    assert_eq!(exact("plain")[0], "3602879701896397/36028797018963968", "the double");
    assert_eq!(exact("polar"), strings(["3*sqrt(3)", "3", "0"]));
    assert_eq!(exact("high"), strings(["-sqrt(2)", "sqrt(2)", "1"]));
    assert_eq!(exact("turned"), strings(["-3*sqrt(3)", "3", "0"]));
    assert_eq!(exact("mirrored"), strings(["sqrt(2)", "sqrt(2)", "1"]));
    assert_eq!(exact("share"), strings(["6/5", "6*sqrt(3)/5", "0"]));
    assert_eq!(exact("offset"), strings(["24/5", "24*sqrt(3)/5", "0"]));
    assert_eq!(exact("beyond"), strings(["-1", "0", "0"]));
    let (coordinates, exactness, doubles) = base(&d, "odd");
    assert_eq!((exactness, coordinates[2].as_str()), (Exactness::Interval, "1/2"));
    assert!((doubles[0] - 17f64.to_radians().cos()).abs() < 1e-15 && coordinates[0].starts_with('['));
    assert_eq!(exact("five"), strings(["1/2 + sqrt(5)/2", "2*cos_deg(54)", "0"]));
    assert_eq!(base(&d, "share").1, Exactness::Field);
    assert_eq!(base(&d, "tenth").1, Exactness::Rational);
    let root = 3f64.sqrt();
    assert_eq!(bits(base(&d, "B").2), bits([6.0, 10.392304845413264, 0.0]));
    assert!((base(&d, "offset").2[1] - 4.8 * root).abs() < 2e-15);
    assert_eq!(bits(base(&d, "tenth").2), bits(base(&d, "plain").2));
}

#[test]
fn an_equilateral_triangle_is_equilateral() {
    let d = read(
        "r = \"1/3\"",
        "A = { radius = \"r\", angle_deg = 15 }\nB = { turn = \"A\", deg = 120 }\nC = { turn = \"B\", deg = 120 }",
    );
    let points = d.exact_points(Body::Base);
    let square = |i: usize, j: usize| {
        (0..3).fold(num::real::RealNumber::integer(0), |sum, k| {
            let x = points[i][k].minus(&points[j][k]).unwrap();
            sum.plus(&x.times(&x).unwrap()).unwrap()
        })
    };
    assert_eq!(square(0, 1), square(1, 2));
    assert_eq!(square(0, 1), square(2, 0));
    assert_eq!(square(0, 1).exact().unwrap().to_string(), "1/3");
}

#[test]
fn both_notations_and_the_saved_text_say_the_same() {
    let forms = format!(
        "{TRIANGLE}\"q q\" = {{ on = [\"A\", \"B\"], t = 0.30000000000000001 }}\nm = {{ mirror = \"q q\", plane = \"xz\" }}\nt = {{ turn = 'm', deg = \"-a\" }}\np = {{ radius = 1e3, angle_deg = +1_0.5, z = -2 }}\n"
    );
    let d = read("a = 7.25\nb = 'a^2 - \"'".replace("- \"", "- 1").as_str(), &forms);
    for saved in [parse(&d.to_toml(), Format::Toml), parse(&d.to_json(), Format::Json)] {
        let (saved, _) = saved.unwrap();
        assert_eq!(saved, d);
        assert_eq!(saved.to_toml(), d.to_toml());
    }
    let toml = d.to_toml();
    for line in [
        "[parameters]\na = 7.25\nb = \"a^2 - 1\"\n",
        "B = [\"6\", \"6*sqrt(3)\", 0.0]",
        "\"q q\" = { on = [\"A\", \"B\"], t = \"0.30000000000000001\" }",
        "m = { mirror = \"q q\", plane = \"xz\" }",
        "t = { turn = \"m\", deg = \"-a\" }",
        "p = { radius = 1000.0, angle_deg = 10.5, z = -2.0 }",
    ] {
        assert!(toml.contains(line), "{line}\n{toml}");
    }
    // the order of joints is kept, constructions among numbers
    assert_eq!(parse(&toml, Format::Toml).unwrap().0.base_names(), d.base_names());
}

#[test]
fn faults_are_named_at_their_places() {
    let one = |parameters: &str, line: &str| -> (Code, usize, usize, String) {
        let found = refused(parameters, &format!("{TRIANGLE}{line}"));
        assert_eq!(found.len(), 1, "{line}: {found:?}");
        let v = &found[0];
        (v.code, v.line, v.column, format!("{}; {}", v.message, v.help))
    };
    // `[parameters]` is line 4; the line after the triangle is line 10
    for (parameters, line, code, place, says) in [
        ("", "X = [\"1 +\", 0, 0]", Code::Expression, (10, 10), "missing before the end"),
        ("r = 1", "X = [0, \"2*s\", 0]", Code::UnknownName, (10, 12), "`s` is not one of [parameters]"),
        ("radius = 1", "X = [0, \"2*radus\", 0]", Code::UnknownName, (10, 12), "did you mean `radius`?"),
        ("r = 1", "X = [0, 0, \"1/(r - 1)\"]", Code::DivisionByZero, (10, 15), "division by zero"),
        ("r = 1", "X = [\"sqrt(r - 2)\", 0, 0]", Code::NegativeRoot, (10, 7), "negative"),
        ("", "X = { on = [\"A\", \"A\"], t = 1 }", Code::NoLine, (10, 12), "A and A are the same point"),
        (
            "",
            "X = { on = [\"A\", \"Q\"], t = 1 }",
            Code::UnknownName,
            (10, 18),
            "not a joint of the same body",
        ),
        ("", "X = { on = [\"A\"], t = 1 }", Code::CoordinateCount, (10, 12), "instead of two"),
        ("", "X = { on = [\"A\", \"B\"] }", Code::MissingKey, (10, 5), "neither"),
        ("", "X = { on = [\"A\", \"B\"], t = 1, offset = 1 }", Code::ConflictingKeys, (10, 5), "both"),
        ("", "X = { on = [\"A\", \"B\"], tt = 1, t = 1 }", Code::UnknownKey, (10, 24), "did you mean `t`?"),
        ("", "X = { mirror = \"A\", plane = \"xx\" }", Code::WrongType, (10, 29), "plane"),
        ("", "X = { turns = \"A\", deg = 2 }", Code::MissingKey, (10, 7), "did you mean `turn`?"),
        ("", "X = { turn = \"A\", deg = true }", Code::WrongType, (10, 25), "a boolean"),
        ("", "X = { turn = \"X\", deg = 2 }", Code::Cycle, (10, 5), "X -> X"),
        ("", "X = [\"1\", 2]", Code::CoordinateCount, (10, 5), "2 coordinates"),
        ("", "X = [\"10^70\", 2, 2]", Code::OutOfRange, (10, 5), "too far out"),
        ("", "X = { radius = 1, angle_deg = nan }", Code::NonFinite, (10, 31), "finite"),
    ] {
        let (found, l, c, message) = one(parameters, line);
        assert_eq!((found, (l, c)), (code, place), "{line}: {message}");
        assert!(message.contains(says), "{line}: {message}");
    }
    let (code, line, _, message) = one("a = \"b\"\nb = \"2*c\"\nc = \"a + 1\"", "");
    assert_eq!((code, line), (Code::Cycle, 5));
    assert!(message.contains("a -> b -> c -> a"), "{message}");
    let (code, line, ..) = one("sqrt = 2", "");
    assert_eq!((code, line), (Code::Expression, 5));
}

const HOME: &str = "[home]\nposition = [0, 0.1, \"2*h/3\"]\nrpy_deg = [\"tilt\", 0, -90]\n";

#[test]
fn home_follows_from_parameters() {
    let text = text("h = 600\ntilt = \"h/20\"", TRIANGLE) + HOME;
    let design = parse(&text, Format::Toml).unwrap().0;
    let home = design.home.unwrap();
    assert_eq!(bits(home.position.into()), bits([0.0, 0.1, 400.0]));
    let plain = text.replace("\"2*h/3\"", "400").replace("\"tilt\"", "30");
    assert_eq!(parse(&plain, Format::Toml).unwrap().0.home, Some(home));
    // it is saved as written, in both notations; a later pose is saved as numbers
    for saved in [parse(&design.to_toml(), Format::Toml), parse(&design.to_json(), Format::Json)] {
        assert_eq!(saved.unwrap().0, design);
    }
    assert!(design.to_toml().contains("position = [0.0, 0.1, \"2*h/3\"]"), "{}", design.to_toml());
    let mut raised = design.clone();
    raised.home.as_mut().unwrap().position.z = 450.0;
    let saved = parse(&raised.to_toml(), Format::Toml).unwrap().0;
    assert_eq!(saved.home, raised.home);
    assert!(!raised.to_toml().contains("2*h/3"));
    // another unit, or a moved joint, leaves home unchanged
    let metres = design.in_units("m").unwrap();
    assert!((metres.home.unwrap().position.z - 0.4).abs() < 1e-15);
    assert_eq!(metres.in_units("mm").unwrap().home, Some(home));
    raised.set_joint("D", [0.0, 0.0, 1.0]).unwrap();
    assert_eq!(raised.home.unwrap().position.z.to_bits(), 450f64.to_bits());
    // with a rotation that has no expressions
    let matrix = text.replace("rpy_deg = [\"tilt\", 0, -90]", "rotation = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]");
    let turned = parse(&matrix, Format::Toml).unwrap().0;
    assert_eq!(parse(&turned.to_toml(), Format::Toml).unwrap().0, turned);
    assert_eq!(turned.home.unwrap().position, home.position);
}

#[test]
fn faults_of_home_are_named_at_their_places() {
    let one = |from: &str, to: &str| -> (Code, String) {
        let text = text("h = 600\ntilt = 1", TRIANGLE) + &HOME.replace(from, to);
        let found = parse(&text, Format::Toml).unwrap_err();
        assert_eq!(found.len(), 1, "{text}: {found:?}");
        let line = text.lines().nth(found[0].line - 1).unwrap();
        assert!(line.contains(to), "{line}: {found:?}");
        (found[0].code, found[0].message.clone())
    };
    assert_eq!(one("2*h/3", "2*hh/3").0, Code::UnknownName);
    assert_eq!(one("2*h/3", "h/(h-600)").0, one("tilt", "1/0").0);
    assert_eq!(one("\"2*h/3\"", "\"h\", 1").0, Code::CoordinateCount);
    assert_eq!(one("2*h/3", "h+").0, Code::Expression);
    assert_eq!(one("-90", "[]").0, Code::WrongType);
    // too far out: the place is the whole table
    let far = text("h = 1e50", TRIANGLE) + &HOME.replace("2*h/3", "h^3").replace("\"tilt\"", "0");
    assert_eq!(parse(&far, Format::Toml).unwrap_err()[0].code, Code::OutOfRange);
}

#[test]
fn faults_are_the_same_in_json() {
    let text = |parameters: &str, joint: &str| {
        format!(
            r#"{{ "name": "constructed", "units": "mm",
"legs": [["A", "D"], ["B", "D"], ["B", "E"], ["C", "E"], ["C", "F"], ["A", "F"]],
"parameters": {{ {parameters} }},
"base": {{ "A": [0, 0, 0], "B": ["6", "6*sqrt(3)", 0], "C": [12, 0, 0], "O": ["0", 0, 0],
"X": {joint} }},
"platform": {{ "D": [0, 0, 0], "E": [6, 0, 0], "F": [3, 5, 0] }} }}"#
        )
    };
    assert!(parse(&text("\"r\": 2", "{ \"turn\": \"B\", \"deg\": \"15*r\" }"), Format::Json).is_ok());
    // the joint is on line 5, from column 6 on
    for (parameters, joint, code, column, says) in [
        ("", r#"["1 +", 0, 0]"#, Code::Expression, 11, "missing before the end"),
        ("", r#"[0, "2*s", 0]"#, Code::UnknownName, 13, "`s` is not one of [parameters]"),
        (r#""r": 1"#, r#"[0, 0, "1/(r - 1)"]"#, Code::DivisionByZero, 16, "division by zero"),
        (r#""r": 1"#, r#"["sqrt(r - 2)", 0, 0]"#, Code::NegativeRoot, 8, "negative"),
        ("", r#"{ "on": ["A", "A"], "t": 1 }"#, Code::NoLine, 14, "A and A are the same point"),
        ("", r#"{ "on": ["A", "O"], "t": 1 }"#, Code::NoLine, 14, "A and O are the same point"),
        ("", r#"{ "on": ["A", "Q"], "t": 1 }"#, Code::UnknownName, 20, "not a joint of the same body"),
        ("", r#"{ "turn": "X", "deg": 2 }"#, Code::Cycle, 6, "X -> X"),
        ("", r#"{ "turn": "A", "deg": true }"#, Code::WrongType, 28, "a boolean"),
        ("", r#"{ "radius": [1], "angle_deg": 2 }"#, Code::WrongType, 18, "an array"),
        ("", r#"{ "mirror": 1, "plane": "xz" }"#, Code::WrongType, 18, "a number"),
    ] {
        let found = parse(&text(parameters, joint), Format::Json).unwrap_err();
        assert_eq!(found.len(), 1, "{joint}: {found:?}");
        let v = &found[0];
        assert_eq!((v.code, v.line, v.column), (code, 5, column), "{joint}: {} {}", v.message, v.help);
        assert!(format!("{}; {}", v.message, v.help).contains(says), "{joint}: {} {}", v.message, v.help);
    }
    let found = parse(&text(r#""a": "b", "b": "2*a""#, "[1, 2, 3]"), Format::Json).unwrap_err();
    assert_eq!((found.len(), found[0].code, found[0].line), (1, Code::Cycle, 3));
}

#[test]
fn a_design_says_how_exactly_its_joints_are_known() {
    let known =
        |lines: &str| read("r = 2", &format!("{lines}\nC = [12, 1, 0]\nX = [0.1, 0.2, 0.3]")).exactness();
    let text = |lines: &str| known(lines).to_string();
    assert_eq!(text("A = [0, 0, 0]\nB = [6.0, 10.4, 0.0]"), "doubles as written");
    assert_eq!(text("A = [0, 0, 0]\nB = [\"6.1\", 10.4, 0.0]"), "exact fractions");
    assert_eq!(text("A = [0, 0, 0]\nB = { radius = \"r\", angle_deg = 60 }"), "exact numbers of Q(sqrt(3))");
    let two = known("A = { radius = 1, angle_deg = 45 }\nB = { radius = \"r\", angle_deg = 15 }");
    assert_eq!(
        (two.exactness, two.radicands.as_slice()),
        (Some(Exactness::Field), &[2, 3][..]),
        "sqrt(6) follows"
    );
    let between = known("A = { radius = \"sqrt(5)\", angle_deg = 0 }\nB = { radius = 1, angle_deg = 7 }");
    assert_eq!(
        (between.exactness, between.enclosed.as_slice()),
        (Some(Exactness::Interval), &["base.B".to_string()][..])
    );
    assert_eq!(between.to_string(), "between close bounds (base.B), the others exact numbers of Q(sqrt(5))");
    let cosines = known("A = { radius = \"sqrt(6)\", angle_deg = 22.5 }\nB = { turn = \"C\", deg = 18 }");
    assert_eq!((cosines.radicands.as_slice(), cosines.divisions.as_slice()), (&[3][..], &[16, 20][..]));
    assert_eq!(cosines.to_string(), "exact numbers of Q(sqrt(3), cos_deg(22.5), cos_deg(18))");
    let three = known("A = [\"sqrt(2)\", \"sqrt(3)\", \"sqrt(5)\"]\nB = [\"sqrt(30)\", \"sqrt(7)\", 0]");
    assert_eq!(three.radicands, [2, 3, 5, 7]);
}

#[test]
fn all_faults_are_shown_and_what_follows_from_them_is_not() {
    let found = refused(
        "a = \"1/0\"\nb = \"a + 1\"\nc = \"sqrt(-2)\"\nd = \"(\"\ne = \"d\"",
        "A = [0, 0, 0]\nB = [\"b\", 0, 0]\nC = { turn = \"B\", deg = 20 }\nX = [\"e\", \"x\", \"y\"]\nY = [0, true, 0]\nZ = { mirror = \"Y\", plane = \"xy\" }",
    );
    let codes: Vec<(Code, usize)> = found.iter().map(|v| (v.code, v.line)).collect();
    assert_eq!(
        codes,
        [
            (Code::DivisionByZero, 5),
            (Code::NegativeRoot, 7),
            (Code::Expression, 8),
            (Code::UnknownName, 14),
            (Code::UnknownName, 14),
            (Code::WrongType, 15),
        ]
    );
}

#[test]
fn hostile_constructions_end_quickly() {
    let many = (0..3000).map(|i| format!("p{i} = \"sqrt({i} + sqrt(2))\"\n")).collect::<Vec<_>>().concat();
    assert_eq!(refused(&many, TRIANGLE)[0].code, Code::TooComplex);
    let tower =
        (1..150).map(|i| format!("p{i} = \"p{}^100*p{}\"\n", i - 1, i - 1)).collect::<Vec<_>>().concat();
    assert_eq!(refused(&format!("p0 = \"sqrt(2) + sqrt(3)\"\n{tower}"), TRIANGLE)[0].code, Code::OutOfRange);
    let chain = (1..5000)
        .map(|i| format!("t{i} = {{ turn = \"t{}\", deg = 1 }}\n", i - 1))
        .collect::<Vec<_>>()
        .concat();
    assert_eq!(refused("", &format!("{TRIANGLE}t0 = [1, 0, 0]\n{chain}"))[0].code, Code::TooComplex);
    let circle = (0..150)
        .map(|i| format!("t{i} = {{ turn = \"t{}\", deg = 7 }}\n", (i + 1) % 150))
        .collect::<Vec<_>>()
        .concat();
    let found = refused("", &format!("{TRIANGLE}{circle}"));
    assert_eq!((found.len(), found[0].code), (1, Code::Cycle));
    let chain = (1..150)
        .map(|i| format!("t{i} = {{ turn = \"t{}\", deg = 7 }}\n", i - 1))
        .collect::<Vec<_>>()
        .concat();
    let d = read("", &format!("{TRIANGLE}t0 = [1, 0, 0]\n{chain}"));
    let turned = base(&d, "t149").2;
    let angle = (149.0 * 7.0f64).to_radians();
    assert!((turned[0] - angle.cos()).abs() + (turned[1] - angle.sin()).abs() < 1e-12);
}

#[test]
fn a_moved_joint_takes_along_what_is_constructed_from_it() {
    let source = text("", &format!("{TRIANGLE}X = {{ on = [\"A\", \"B\"], t = \"1/2\" }} # half way\n"));
    let mut d = parse(&source, Format::Toml).unwrap().0;
    d.set_joint("B", [8.0, 10.0, 0.0]).unwrap();
    assert_eq!(bits(base(&d, "X").2), bits([4.0, 5.0, 0.0]));
    assert_eq!(d.text(), source.replace("[\"6\", \"6*sqrt(3)\", 0]", "[8.0, 10.0, 0.0]"));
    assert_eq!(parse(&d.text(), Format::Toml).unwrap().0, d);
    let before = d.clone();
    assert!(matches!(d.set_joint("B", [0.0; 3]), Err(JointError::Construction { .. })));
    assert_eq!(d, before);
    d.set_joint("X", [1.0, 2.0, 3.0]).unwrap();
    assert!(d.text().contains("X = [1.0, 2.0, 3.0] # half way"), "{}", d.text());
    assert_eq!(parse(&d.text(), Format::Toml).unwrap().0, d);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn points_on_lines_are_where_doubles_put_them(
        a in prop::array::uniform3(-9i32..9), b in prop::array::uniform3(-9i32..9), t in -300i32..300,
    ) {
        prop_assume!(a != b);
        let line = format!("P = {a:?}\nQ = {b:?}\nX = {{ on = [\"P\", \"Q\"], t = {} }}\nY = {{ on = [\"P\", \"Q\"], offset = {} }}\n", f64::from(t) / 100.0, f64::from(t) / 100.0);
        let d = read("", &format!("{TRIANGLE}{line}"));
        let (a, b) = (a.map(f64::from), b.map(f64::from));
        let length = (0..3).map(|i| (b[i] - a[i]).powi(2)).sum::<f64>().sqrt();
        let (x, y) = (base(&d, "X"), base(&d, "Y"));
        for i in 0..3 {
            let t = f64::from(t) / 100.0;
            prop_assert!((x.2[i] - (a[i] + t * (b[i] - a[i]))).abs() < 1e-13);
            prop_assert!((y.2[i] - (a[i] + t * (b[i] - a[i]) / length)).abs() < 1e-13);
        }
        prop_assert_eq!(x.1, Exactness::Rational);
        prop_assert!(y.1 != Exactness::Interval);
    }
}
