use nalgebra::Point3;

use crate::design::table::points::tests::{BASE, PLATFORM, is_meant, read, refusal};
use platform::manipulator::Body;

/// The two lists in a notation: `point` writes each point, `body` the text around the points of a body.
fn lists(point: impl Fn([f64; 3]) -> String, body: impl Fn(Body, &[String]) -> String) -> String {
    let of = |b: Body, list: [[f64; 3]; 6]| body(b, &list.map(&point));
    format!("{}\n{}", of(Body::Base, BASE), of(Body::Platform, PLATFORM))
}

#[test]
fn lists_of_programs_are_read() {
    let comma = |p: [f64; 3]| format!("{}, {}, {}", p[0], p[1], p[2]);
    let blank = |p: [f64; 3]| format!("{} {} {}", p[0], p[1], p[2]);
    let name = |b: Body| b.of(("base", "plat"));
    let columns = |b: Body, rows: &[String]| {
        let cell = |row: &String, k: usize| row.split(' ').nth(k).unwrap().to_owned();
        let column = |k: usize| rows.iter().map(|row| cell(row, k)).collect::<Vec<_>>().join(" ");
        format!("{} = [{}; {}; {}];", b.of(("A", "B")), column(0), column(1), column(2))
    };
    let array = |b: Body, rows: &[String]| {
        format!("{} = np.array([[{}]], dtype=float)  # joints", name(b), rows.join("],\n    ["))
    };
    for text in [
        format!("import numpy as np\n{}", lists(comma, array)),
        lists(comma, |b, rows| {
            format!("static const float {}_pts[6][3] = {{\n{{{}}}\n}};", name(b), rows.join("},\n{"))
        }),
        lists(comma, |b, rows| {
            let points = rows.join("), Eigen::Vector3d(");
            format!("std::vector<Eigen::Vector3d> {} = {{Eigen::Vector3d({points})}};", name(b))
        }),
        lists(
            |p| format!(".x = {}, .y = {}, .z = {}", p[0], p[1], p[2]),
            |b, rows| format!("const Joint {}[6] = {{{{{}}}}};", name(b), rows.join("}, {")),
        ),
        lists(comma, |b, rows| format!("{} = [Vec3({})]", name(b), rows.join("),\nVec3("))),
        lists(blank, |b, rows| format!("{} = [{}];", name(b), rows.join(";\n  "))),
        lists(blank, |b, rows| format!("{} = [{}];", name(b), rows.join("\n  "))),
        lists(blank, columns),
        lists(comma, |b, rows| format!("{}_anchors:\n  - [{}]", name(b), rows.join("]\n  - ["))),
        lists(
            |p| format!("x: {}\n    y: {}\n    z: {}", p[0], p[1], p[2]),
            |b, rows| format!("{}:\n  - {}", name(b), rows.join("\n  - ")),
        ),
        format!(
            "{{{}}}",
            lists(comma, |b, rows| {
                format!("\"{}\": [\n[{}]]{}", name(b), rows.join("],\n["), b.of((",", "")))
            })
        ),
        format!(
            "{{\"robot\": {{{}}}}}",
            lists(
                |p| format!("{{\"x\": {}, \"y\": {}, \"z\": {}}}", p[0], p[1], p[2]),
                |b, rows| { format!("\"{}\": [{}]{}", name(b), rows.join(", "), b.of((",", ""))) }
            )
        ),
    ] {
        let table = read(&text);
        assert!(is_meant(&table), "{text}\n{:?}", table.guesses);
        assert!(table.home.is_none(), "{text}");
    }
}

#[test]
fn lists_come_with_units_and_height_and_angles_with_radii() {
    let rows = |list: [[f64; 3]; 6]| list.map(|p| format!("{p:?}")).join(",");
    let text = format!(
        "{{\"top\": [{}], \"bottom\": [{}], \"units\": \"cm\", \"height\": 140, \"rod\": 7}}",
        rows(PLATFORM),
        rows(BASE)
    );
    let table = read(&text);
    assert!(is_meant(&table));
    assert_eq!((table.units.as_deref(), table.home.unwrap().position.z), (Some("cm"), 140.0));
    assert!(table.guesses.iter().any(|g| g == "Not read: `rod`."), "{:?}", table.guesses);
    let angles = "# anchors in mm\nbase_radius = 100\nbase_angles = [15, 105, 135, 225, 255, 345]\ntop_radius = 80\ntop_angles = [45, 75, 165, 195, 285, 315]\n";
    let header = "leg,base_radius,base_angle_deg,platform_radius,platform_angle_deg\n1,100,15,80,45\n2,100,105,80,75\n3,100,135,80,165\n4,100,225,80,195\n5,100,255,80,285\n6,100,345,80,315\n";
    let points = "body,radius [mm],theta,z\n".to_string()
        + &[15, 105, 135, 225, 255, 345].map(|a| format!("base,100,{a},0\n")).concat()
        + &[45, 75, 165, 195, 285, 315].map(|a| format!("platform,80,{a},0\n")).concat();
    for text in [angles, header, &points] {
        let table = read(text);
        let (a, b) = (table.legs[0].base, table.legs[3].platform);
        assert!((a.coords.norm() - 100.0).abs() < 1e-12 && (b.coords.norm() - 80.0).abs() < 1e-12, "{text}");
        assert!((a.y.atan2(a.x).to_degrees() - 15.0).abs() < 1e-12);
        assert!((b.y.atan2(b.x).to_degrees() + 165.0).abs() < 1e-12);
    }
}

#[test]
fn what_programs_print_and_write_is_read() {
    let name = |b: Body| b.of(("B", "P"));
    let matrix = |factor: f64, head: &str| -> String {
        [Body::Base, Body::Platform]
            .map(|b| {
                let list = b.of((BASE, PLATFORM));
                let rows = list.map(|p| p.map(|x| format!("{:.6}", x / factor)).join("  "));
                format!("{} =\n\n{head}  {}\n\n", name(b), rows.join("\n  "))
            })
            .concat()
    };
    let named = |b: Body, open: &str, is: &str| {
        let list = b.of((BASE, PLATFORM));
        (0..6)
            .rev()
            .map(|i| format!("{open}{}{}{open}{is} {:?}", name(b), i + 1, list[i]))
            .collect::<Vec<_>>()
    };
    let points = |list: [[f64; 3]; 6]| list.map(|p| format!("{p:?}")).join(", ");
    let flat = |list: [[f64; 3]; 6]| list.map(|p| p.map(|x| x.to_string()).join(", ")).join(",\n");
    let leg = |i: usize| (BASE[i], PLATFORM[i]);
    let texts = [
        matrix(1.0, ""),
        matrix(1000.0, "   1.0e+03 *\n\n"),
        format!(
            "{{\"base\": {{{}}}, \"platform\": {{{}}}}}",
            named(Body::Base, "\"", ":").join(", "),
            named(Body::Platform, "\"", ":").join(", ")
        ),
        format!(
            "base:\n  {}\nplatform:\n  {}\n",
            named(Body::Base, "", ":").join("\n  "),
            named(Body::Platform, "", ":").join("\n  ")
        ),
        format!(
            "{{\"machine\": {{\"legs\": [{}]}}}}",
            [3, 1, 2, 5, 0, 4]
                .map(|i| {
                    let (a, b) = leg(i);
                    format!("{{\"id\": {i}, \"platformAttachment\": {b:?}, \"baseAttachment\": {a:?}}}")
                })
                .join(", ")
        ),
        "legs:\n".to_owned()
            + &[0, 1, 2, 3, 4, 5]
                .map(|i| format!("  - base: {:?}\n    platform: {:?}\n", leg(i).0, leg(i).1))
                .concat(),
        format!(
            "struct leg legs[6] = {{\n{}\n}};",
            [0, 1, 2, 3, 4, 5]
                .map(|i| format!("{{{:?}, {:?}}}", leg(i).0, leg(i).1).replace('[', "{").replace(']', "}"))
                .join(",\n")
        ),
        format!("double base[18] = {{{}}};\ndouble platform[18] = {{{}}};", flat(BASE), flat(PLATFORM)),
        format!("B := Matrix([{}]):\nP := Matrix([{}]):\n", points(BASE), points(PLATFORM)),
        format!("B = np.array([{}]).T\nP = 1.0 * np.array([{}])\n", points(BASE), points(PLATFORM)),
        format!(
            "B = [ ...\n{} ]';\nP = [{}];\n",
            points(BASE).replace("], ", "]; ...\n").replace(['[', ']'], ""),
            points(PLATFORM)
        ),
    ];
    for text in texts {
        let table = read(&text);
        assert!(is_meant(&table), "{text}\n{:?}", table.guesses);
    }
    // the legs are stated, in another order than that of the numbers
    let joints = [Body::Base, Body::Platform].map(|b| named(b, "\"", ":").join(", "));
    let order = [(2, 5), (1, 4), (3, 3), (6, 2), (5, 1), (4, 6)];
    let stated = order.map(|(a, b)| format!("[\"B{a}\", \"P{b}\"]")).join(", ");
    let text =
        format!("{{\"legs\": [{stated}], \"base\": {{{}}}, \"platform\": {{{}}}}}", joints[0], joints[1]);
    let table = read(&text);
    for (leg, (a, b)) in table.legs.iter().zip(order) {
        let meant = [BASE[a - 1], PLATFORM[b - 1]].map(Point3::from);
        assert_eq!([leg.base, leg.platform], meant, "{:?}", table.guesses);
    }
    let why = refusal(&text.replace("\"P6\"]", "\"P7\"]"));
    assert!(why.contains("the joint `P7`, which has no list of coordinates"), "{why}");
    let scaled = read(&format!("B = 0.5 * [{}];\nP = [{}] * 2;\n", points(BASE), points(PLATFORM)));
    assert_eq!((scaled.legs[3].base.x, scaled.legs[3].platform.x), (-200.74 / 2.0, -195.63 * 2.0));
    assert!(scaled.guesses.iter().any(|g| g.contains("multiplied by 0.5")), "{:?}", scaled.guesses);
    let computed = "r = 300;\nB = r*[cos(a); sin(a)];\nP = [cos(b); sin(b)];\n";
    assert!(refusal(computed).contains("programs are not run"), "{}", refusal(computed));
}

#[test]
fn brackets_without_end_are_refused() {
    for open in ["[", "{\"a\": [", "(", "\n- ", "- b:\n - "] {
        let why = refusal(&format!("a = {}", open.repeat(100_000)));
        assert!(!why.is_empty());
    }
}

#[test]
fn values_of_programs_beside_the_joints_are_told_apart() {
    let matrix = |list: [[f64; 3]; 6]| list.map(|p| p.map(|x| x.to_string()).join(" ")).join("; ");
    let (base, platform) = (matrix(BASE), matrix(PLATFORM));
    let limits = "[350 450; 350 450; 350 450; 350 450; 350 450; 350 450]";
    for text in [
        format!("B = [{base}];\nP = [{platform}];\nlim = {limits};\n"),
        format!("robot.plat = [{platform}];\nrobot.base = [{base}];\nrobot.limits = {limits};\n"),
        format!(
            "clear; clc\nB = [{base}]';\nP = [{platform}]';\nplot3(B(1,:), B(2,:), B(3,:), 'o'); hold on\nL = sqrt(sum((B - P).^2));\n"
        ),
        format!(
            "s.b = [{platform}];\ns.a = [{base}];\ns.lengths = @(R, p) sqrt(sum((R * s.b + p - s.a).^2, 1))';\n"
        ),
    ] {
        let table = read(&text);
        assert!(is_meant(&table), "{text}\n{:?}", table.guesses);
    }
    let home =
        read(&format!("B = [{base}];\nP = [{platform}];\nR = [0 -1 0; 1 0 0; 0 0 1];\np = [1; 2; 300];\n"))
            .home
            .unwrap();
    assert_eq!(home.position.as_slice(), [1.0, 2.0, 300.0]);
    assert!((home.angles().degrees()[2] - 90.0).abs() < 1e-12);
    // the base is computed, and other lists are not taken for it
    let computed = format!("B = r * [cos(t); sin(t)];\nP = [{platform}];\nlim = {limits};\n");
    assert!(refusal(&computed).contains("programs are not run"), "{}", refusal(&computed));
    let shifted = format!("B = np.array({BASE:?}) + np.array([0, 0, 10])\nP = np.array({PLATFORM:?})\n");
    assert!(refusal(&shifted).contains("programs are not run"), "{}", refusal(&shifted));
    let far = refusal(&format!("B = 1e60*[{base}];\nP = [{platform}];\n"));
    assert!(far.contains("is too far out"), "{far}");
    let halves = read(&format!("B = [{base}]/2;\nP = 2*[{platform}];\n"));
    assert_eq!((halves.legs[3].base.x, halves.legs[3].platform.x), (-200.74 / 2.0, -195.63 * 2.0));
    assert!(!refusal(&format!("B = [{base}] + 5;\nP = [{platform}];\n")).is_empty());
}

#[test]
fn joints_of_objects_are_read() {
    let name = |body: Body, i: usize| format!("{}{}", body.of(("A", "B")), i + 1);
    let of = |body: Body| body.of((BASE, PLATFORM));
    let objects = |body: Body| {
        (0..6)
            .map(|i| format!("{{\"name\": \"{}\", \"at\": {:?}}}", name(body, i), of(body)[i]))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let legs = (1..=6).map(|i| format!("{{\"base_joint\": \"A{i}\", \"platform_joint\": \"B{i}\"}}"));
    let legs = legs.collect::<Vec<_>>().join(", ");
    let flat = (0..6).map(|i| {
        let (a, b) = (BASE[i], PLATFORM[i]);
        format!(
            "{{\"leg\": {i}, \"bx\": {}, \"by\": {}, \"bz\": {}, \"px\": {}, \"py\": {}, \"pz\": {}}}",
            a[0], a[1], a[2], b[0], b[1], b[2]
        )
    });
    let joints = Body::BOTH.into_iter().flat_map(|body| {
        (0..6).map(move |i| format!("{{\"body\": \"{body}\", \"position\": {:?}}}", of(body)[i]))
    });
    for text in [
        format!(
            "{{\"legs\": [{legs}], \"base\": {{\"joints\": [{}]}}, \"platform\": {{\"joints\": [{}]}}}}",
            objects(Body::Base),
            objects(Body::Platform)
        ),
        format!("[{}]", flat.collect::<Vec<_>>().join(",\n ")),
        format!("{{\"joints\": [{}]}}", joints.collect::<Vec<_>>().join(", ")),
        format!("[{BASE:?}, {PLATFORM:?}]"),
        format!("joints = np.array([{BASE:?},\n{PLATFORM:?}])"),
    ] {
        let table = read(&text);
        assert!(is_meant(&table), "{text}\n{:?}", table.guesses);
    }
}
