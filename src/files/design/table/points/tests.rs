use nalgebra::Point3;

use super::*;

pub(super) const BASE: [[f64; 3]; 6] = [
    [293.444, -62.374, 0.0],
    [293.444, 62.374, 0.0],
    [-92.704, 285.317, 0.0],
    [-200.74, 222.943, 0.0],
    [-200.74, -222.943, 0.0],
    [-92.704, -285.317, 0.0],
];
pub(super) const PLATFORM: [[f64; 3]; 6] = [
    [133.826, -148.629, 0.0],
    [133.826, 148.629, 0.0],
    [61.804, 190.211, 0.0],
    [-195.63, 41.582, 0.0],
    [-195.63, -41.582, 0.0],
    [61.804, -190.211, 0.0],
];

/// The design of the two lists, in a table of six rows with these separators.
fn six(separator: &str, header: &str, number: fn(f64) -> String) -> String {
    let mut text = header.to_string();
    for (a, b) in BASE.iter().zip(PLATFORM) {
        let cells: Vec<String> = a.iter().chain(&b).map(|x| number(*x)).collect();
        text.push_str(&cells.join(separator));
        text.push('\n');
    }
    text
}

fn twelve(row: impl Fn(Body, usize, [String; 3]) -> String) -> String {
    let of = |body: Body, list: [[f64; 3]; 6]| -> String {
        list.iter().enumerate().map(|(i, p)| row(body, i, p.map(|x| x.to_string())) + "\n").collect()
    };
    of(Body::Base, BASE) + &of(Body::Platform, PLATFORM)
}

pub(super) fn read(text: &str) -> PointTable {
    PointTable::read(text.as_bytes()).unwrap_or_else(|why| panic!("{why}\n{text}"))
}

pub(super) fn refusal(text: &str) -> String {
    PointTable::read(text.as_bytes()).unwrap_err().to_string()
}

pub(super) fn is_meant(table: &PointTable) -> bool {
    let legs: Vec<[[f64; 3]; 2]> =
        table.legs.iter().map(|l| [l.base.coords.into(), l.platform.coords.into()]).collect();
    let meant: Vec<[[f64; 3]; 2]> = BASE.iter().zip(PLATFORM).map(|(a, b)| [*a, b]).collect();
    legs == meant
}

#[test]
fn six_rows_of_two_points_are_read_under_all_usual_names() {
    let plain = |x: f64| x.to_string();
    let comma = |x: f64| x.to_string().replace('.', ",");
    for header in [
        "",
        "bx,by,bz,px,py,pz\n",
        "Ax,Ay,Az,Bx,By,Bz\n",
        "base_x,base_y,base_z,platform_x,platform_y,platform_z\n",
        "x_base,y_base,z_base,x_platform,y_platform,z_platform\n",
        "x1 (mm),y1 (mm),z1 (mm),x2 (mm),y2 (mm),z2 (mm)\n",
        "x,y,z,x,y,z\n",
        "Lower X,Lower Y,Lower Z,Upper X,Upper Y,Upper Z\n",
        "# exported\nfirst,second,third,fourth,fifth,sixth\n",
    ] {
        assert!(is_meant(&read(&six(",", header, plain))), "{header}");
    }
    assert!(is_meant(&read(&six(";", "bx;by;bz;px;py;pz\n", comma))));
    assert!(is_meant(&read(&six("\t", "", comma))));
    assert!(is_meant(&read(&six(" ", "", plain))));
    let utf16: Vec<u8> =
        [0xfeff].into_iter().chain(six("\t", "", comma).encode_utf16()).flat_map(u16::to_le_bytes).collect();
    assert!(is_meant(&PointTable::read(&utf16).unwrap()));
}

#[test]
fn the_platform_may_come_first_and_the_legs_in_any_order() {
    let mut rows: Vec<String> = BASE
        .iter()
        .zip(PLATFORM)
        .enumerate()
        .map(|(i, (a, b))| format!("{},{},{},{},{},{},{}", i + 1, b[0], b[1], b[2], a[0], a[1], a[2]))
        .collect();
    rows.reverse();
    let table = read(&format!("leg,top x,top y,top z,bottom x,bottom y,bottom z\n{}", rows.join("\n")));
    assert!(is_meant(&table), "{:?}", table.guesses);
    assert!(table.guesses.iter().any(|g| g.contains("order of their numbers")));
}

#[test]
fn twelve_rows_of_one_point_find_their_bodies() {
    let joined = |p: [String; 3]| p.join(",");
    let letter = |body: Body, i: usize| format!("{}{}", body.of(("A", "B")), i + 1);
    for text in [
        twelve(|_, _, p| joined(p)),
        twelve(|_, i, p| format!("{},{}", i + 1, joined(p))),
        twelve(|body, i, p| format!("{},{}", letter(body, i), joined(p))),
        twelve(|body, _, p| format!("{},{body}", joined(p))),
        format!("name,x,y,z\n{}", twelve(|body, i, p| format!("{},{}", letter(body, i), joined(p)))),
        format!(
            "No;Body;X [mm];Y [mm];Z [mm]\n{}",
            twelve(|body, i, p| format!("{};{body};{}", i + 1, p.join(";")))
        ),
        twelve(|body, i, p| if i == 0 { format!("{body}\nx,y,z\n{}", joined(p)) } else { joined(p) }),
        twelve(|_, _, p| format!("[{}],", joined(p))),
        twelve(|body, i, p| {
            if i == 0 {
                format!("{body} = [\n[{}],", joined(p))
            } else {
                format!("[{}],{}", joined(p), if i == 5 { "]" } else { "" })
            }
        }),
        twelve(|_, _, p| format!("{},{}", p[0], p[1])),
    ] {
        let table = read(&text);
        assert!(is_meant(&table), "{text}\n{:?}", table.guesses);
        assert!(table.home.is_none());
    }
    let (base, platform) = (0..6, 0..6);
    let swapped: String = platform
        .map(|i| format!("platform,{},{},0\n", PLATFORM[i][0], PLATFORM[i][1]))
        .chain(base.map(|i| format!("base,{},{},0\n", BASE[i][0], BASE[i][1])))
        .collect();
    assert!(is_meant(&read(&swapped)));
}

#[test]
fn nothing_is_taken_for_a_coordinate_that_is_none() {
    let radians = "base_radius = 1\nbase_angles = [0.1, 1, 2, 3, 4, 5]\ntop_radius = 2\ntop_angles = [0, 1, 2, 3, 4, 5]\n";
    assert!(refusal(radians).contains("degrees or radians"));
    assert!(refusal(&radians.replace("top_radius = 2\n", "")).contains("two radii are needed"));
    let alone = "leg,base_radius,base_z\n".to_owned() + &"1,2,3\n".repeat(6);
    assert!(refusal(&alone).contains("those of angles none"));
    let rows = |list: [[f64; 3]; 6]| list.map(|p| format!("{p:?}")).join(",");
    let three = format!("u = [{}]\nv = [{}]\nw = [{}]\n", rows(BASE), rows(PLATFORM), rows(BASE));
    assert!(refusal(&three).contains("3 lists of six points"));
    // arithmetic is not evaluated
    assert!(PointTable::read(b"a = [[1*2, 3, 0], [1, 2, 3]]\nb = [[1, 2, 3]]").is_err());
    assert!(refusal("<?xml version=\"1.0\"?><COLLADA version=\"1.4\"/>").contains("COLLADA"));
    assert!(refusal("<sdf version=\"1.7\"/>").contains("prismatic"));
}

#[test]
fn an_assembly_with_y_up_has_its_home_along_y() {
    let lifted = twelve(|body, _, p| format!("{},{},{}", p[0], body.of(("-12.5", "412.5")), p[1]));
    let table = read(&lifted);
    assert_eq!(table.home.unwrap().position.y.to_bits(), 412.5_f64.to_bits());
    assert!(table.guesses.iter().any(|g| g.ends_with("y is up.")), "{:?}", table.guesses);
}

#[test]
fn names_and_units_of_the_table_are_those_of_the_design() {
    let text = twelve(|body, i, p| format!("{}{};{}", body.of(("A", "B")), i + 1, p.join(";")));
    let mut table = read(&format!("joint;x [in];y [in];z [in]\n{text}"));
    assert_eq!(table.units.as_deref(), Some("in"));
    let design = table.design("mine", "in").unwrap();
    assert_eq!(design.base_names(), ["A1", "A2", "A3", "A4", "A5", "A6"]);
    assert_eq!(design.leg_names()[5], ("A6", "B6"));
    assert_eq!(design.manipulator().base_joints()[1], Point3::from(BASE[1]));
}

#[test]
fn points_of_one_drawing_have_their_home_where_they_stand() {
    let lifted = twelve(|body, _, p| format!("{},{},{}", p[0], p[1], body.of(("12.5", "412.5"))));
    let table = read(&lifted);
    let home = table.home.unwrap();
    assert_eq!((home.position.z, table.legs[3].platform.z, table.legs[3].base.z), (412.5, 0.0, 12.5));
    assert!(table.guesses.iter().any(|g| g.contains("above those of the base")), "{:?}", table.guesses);
}

#[test]
fn ends_at_one_place_are_one_joint() {
    let corners = [[0.0, 0.0], [6.0, 10.0], [12.0, 0.0]];
    let text: String = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)]
        .map(|(a, b)| {
            format!("{},{},0,{},{},0\n", corners[a][0], corners[a][1], corners[b][0], -corners[b][1])
        })
        .concat();
    let mut table = read(&text);
    let design = table.design("octahedral", "mm").unwrap();
    assert_eq!((design.base_names().len(), design.platform_names().len()), (3, 3));
    assert_eq!(
        table.guesses.iter().filter(|g| g.contains("share a joint")).count(),
        2,
        "{:?}",
        table.guesses
    );
}

#[test]
fn what_is_not_twelve_points_is_refused_with_its_reason() {
    let points = twelve(|_, _, p| p.join(","));
    let first = |n: usize| points.lines().take(n).collect::<Vec<_>>().join("\n");
    for (text, part) in [
        (first(9), "9 rows of one point instead of twelve"),
        ("1,2,3,4,5,6\n2,3,4,5,6,7\n".into(), "2 rows with both ends of a leg"),
        (first(11) + "\n1,x,3\n", "line 12, column 2: `x` is not a number"),
        (format!("x,y,z\n{}\n1,x,3\n", first(11)), "line 13, column 2: `x` is not a number"),
        (format!("x,y,z\n{}\n1,?,-\n", first(11)), "fewer than two numbers"),
        (String::new(), "no line has 2 numbers"),
        (
            twelve(|_, i, p| format!("{},{}", if i < 4 { "base" } else { "platform" }, p.join(","))),
            "8 rows are joints of the base",
        ),
    ] {
        let why = refusal(&text);
        assert!(why.contains(part), "{why}");
    }
}

#[cfg(feature = "workbook")]
#[test]
fn a_spreadsheet_is_read_as_its_table_would_be() {
    let bytes = include_bytes!("../../../../../tests/fixtures/models/six-legs.xlsx");
    let table = PointTable::read(bytes).unwrap();
    assert!(is_meant(&table));
    assert_eq!(table.units.as_deref(), Some("mm"));
    let said = table.guesses.join("\n");
    assert!(said.contains("sheet `Joints`") && said.contains("`Masses`"), "{said}");
    assert!(!said.contains("separated"), "{said}");
    let broken = &bytes[..bytes.len() / 2];
    let why = PointTable::read(broken).unwrap_err().to_string();
    assert!(why.contains("packed file"), "{why}");
}

/// Twelve rows in an order of joints, with a word at their left.
fn in_order(order: [usize; 12], word: impl Fn(Body, usize) -> String) -> String {
    order
        .map(|k| {
            let (body, i) = (Body::BOTH[k / 6], k % 6);
            let p = body.of((BASE[i], PLATFORM[i]));
            format!("{},{},{},{}\n", word(body, i), p[0], p[1], p[2])
        })
        .concat()
}

#[test]
fn joints_with_the_same_number_are_one_leg_wherever_they_stand() {
    let mixed = [9, 2, 0, 7, 11, 1, 5, 6, 3, 10, 4, 8];
    let letter = |body: Body| body.of(("B", "P"));
    for text in [
        "name,x,y,z\n".to_owned() + &in_order(mixed, |body, i| format!("{}{}", letter(body), i + 1)),
        "name,x,y,z\n".to_owned() + &in_order(mixed, |body, i| format!("{body}_{i}")),
        "leg,end,x,y,z\n".to_owned() + &in_order(mixed, |body, i| format!("{},{body}", i + 1)),
        "Bein,Ende,x,y,z\n".to_owned()
            + &in_order(mixed, |body, i| format!("{i}.0,{}", body.of(("unten", "oben")))),
        "x,y,z,name\n".to_owned()
            + &in_order(mixed, |body, i| format!("leg{}_{body}", i + 1))
                .lines()
                .map(|line| {
                    let (name, rest) = line.split_once(',').unwrap();
                    format!("{rest},{name}\n")
                })
                .collect::<Vec<_>>()
                .concat(),
    ] {
        let table = read(&text);
        assert!(is_meant(&table), "{text}\n{:?}", table.guesses);
        assert!(table.guesses.iter().any(|g| g.contains("same number")), "{:?}", table.guesses);
    }
    let twice = "leg,end,x,y,z\n".to_owned()
        + &in_order([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11], |body, i| format!("{},{body}", i.max(1)));
    assert!(refusal(&twice).contains("line 3: leg 1 has two joints of the base"), "{}", refusal(&twice));
    let comma = |x: f64| x.to_string();
    let rows = six(",", "", comma);
    let rows: String = rows
        .lines()
        .enumerate()
        .map(|(i, line)| format!("{},{line}\n", i.max(1)))
        .collect::<Vec<_>>()
        .concat();
    let why = refusal(&format!("leg,bx,by,bz,px,py,pz\n{rows}"));
    assert!(why.contains("line 3: leg 1 is there twice"), "{why}");
}

#[test]
fn rows_in_turn_are_told_by_their_heights() {
    let turns: String = (0..12)
        .map(|k| {
            let p = if k % 2 == 0 { BASE[k / 2] } else { PLATFORM[k / 2] };
            format!("{},{},{}\n", p[0], p[1], if k % 2 == 0 { 0 } else { 400 })
        })
        .collect::<Vec<_>>()
        .concat();
    let table = read(&turns);
    assert!(is_meant(&table), "{:?}", table.guesses);
    assert_eq!(table.home.unwrap().position.z.to_bits(), 400.0_f64.to_bits());
    assert!(table.guesses.iter().any(|g| g.contains("in turn")));
}

#[test]
fn legs_along_the_columns_are_turned() {
    let row = |list: [[f64; 3]; 6], axis: usize| list.map(|p| p[axis].to_string()).join(",");
    let rows = |word: &dyn Fn(Body, usize) -> String| -> String {
        (0..6)
            .map(|k| {
                let body = Body::BOTH[k / 3];
                let list = body.of((BASE, PLATFORM));
                format!("{}{}\n", word(body, k % 3), row(list, k % 3))
            })
            .collect::<Vec<_>>()
            .concat()
    };
    let axis = |k: usize| ["x", "y", "z"][k];
    let both = |k: usize| format!("{},{},{}\n", axis(k), row(BASE, k), row(PLATFORM, k));
    for text in [
        "coord,leg1,leg2,leg3,leg4,leg5,leg6\n".to_owned()
            + &rows(&|body, k| format!("{}{},", body.of(("B", "P")), axis(k))),
        rows(&|body, k| format!("{body} {},", axis(k))),
        rows(&|body, k| {
            let title = if k == 0 { format!("{body} joints\n") } else { String::new() };
            format!("{title}{},", axis(k))
        }),
        // the print of a program
        rows(&|body, k| if k == 0 { format!("\n{} =\n\n", body.of(("B", "P"))) } else { String::new() }),
        // only so both bodies are flat
        rows(&|_, _| String::new()),
        "joint,B1,B2,B3,B4,B5,B6,P1,P2,P3,P4,P5,P6\n".to_owned()
            + &(0..3).map(both).collect::<Vec<_>>().concat(),
    ] {
        let table = read(&text);
        assert!(is_meant(&table), "{text}\n{:?}", table.guesses);
    }
}

#[test]
fn units_of_a_table_are_taken_from_every_place_or_refused() {
    let plain = |x: f64| x.to_string();
    let marked = |x: f64| format!("{x} cm");
    for text in [
        six(",", "bx [cm],by [cm],bz [cm],px [cm],py [cm],pz [cm]\n", plain),
        six(",", "bx,by,bz,px,py,pz\ncm,cm,cm,cm,cm,cm\n", plain),
        six(";", "Joint centres; all sizes in cm\nbx;by;bz;px;py;pz\n", plain),
        six(",", "bx,by,bz,px,py,pz\n", marked),
        six("\t", "", marked),
    ] {
        let table = read(&text);
        assert!(is_meant(&table), "{text}\n{:?}", table.guesses);
        assert_eq!(table.units.as_deref(), Some("cm"), "{text}");
    }
    let mixed = six(",", "bx_mm,by_mm,bz_mm,px_cm,py_cm,pz_cm\n", plain);
    assert!(refusal(&mixed).contains("`bx_mm` is in mm and `px_cm` in cm"), "{}", refusal(&mixed));
    let other = six(",", "# all in mm\nbx_cm,by_cm,bz_cm,px_cm,py_cm,pz_cm\n", plain);
    assert!(refusal(&other).contains("a line above them says mm"), "{}", refusal(&other));
}

#[test]
fn bodies_in_different_units_are_refused() {
    let rows = |list: [[f64; 3]; 6]| list.map(|p| p.map(|x| x.to_string()).join(",")).join("\n");
    let blocks =
        |base: &str, platform: &str| format!("{base}\n{}\n{platform}\n{}\n", rows(BASE), rows(PLATFORM));
    let same = read(&blocks("Base [cm]", "Platform [cm]"));
    assert!(is_meant(&same) && same.units.as_deref() == Some("cm"), "{:?}", same.guesses);
    for (base, platform, part) in [
        ("Base [mm]", "Platform [m]", "line 8, `Platform [m]`, says m, and the numbers above it are in mm"),
        ("Base", "Platform, in m", "says m, and the numbers above it have no unit"),
        ("x [mm],y [mm],z [mm]", "x [m],y [m],z [m]", "says m, and the numbers above it are in mm"),
    ] {
        let why = refusal(&blocks(base, platform));
        assert!(why.contains(part), "{why}");
    }
}

#[test]
fn misspelt_bodies_are_recognised_and_named() {
    let header = "platfrom_x,platfrom_y,platfrom_z,bsae_x,bsae_y,bsae_z\n";
    let rows: String = (0..6)
        .map(|i| {
            [PLATFORM[i], BASE[i]].concat().iter().map(f64::to_string).collect::<Vec<_>>().join(",") + "\n"
        })
        .collect::<Vec<_>>()
        .concat();
    let table = read(&format!("{header}{rows}"));
    assert!(is_meant(&table), "{:?}", table.guesses);
    assert!(table.guesses.iter().any(|g| g == "`bsae_x` is read as base x."), "{:?}", table.guesses);
}

#[test]
fn titles_of_bodies_and_brackets_are_no_numbers() {
    let rows = |list: [[f64; 3]; 6]| list.map(|p| p.map(|x| x.to_string()).join(" ")).join("\n");
    let titled = format!(
        "PLATFORM JOINTS (platform frame, in cm)\n{}\nBASE JOINTS (base frame, in cm)\n{}\n",
        rows(PLATFORM),
        rows(BASE)
    );
    let table = read(&titled);
    assert!(is_meant(&table), "{:?}", table.guesses);
    assert_eq!(table.units.as_deref(), Some("cm"));
    let name = |body: Body, i: usize| format!("{}{}", body.of(("B", "P")), i + 1);
    for text in [
        twelve(|body, i, p| format!("{} ({})", name(body, i), p.join(", "))),
        twelve(|body, i, p| format!("{}: x={} y={} z={}", name(body, i), p[0], p[1], p[2])),
    ] {
        let table = read(&text);
        assert!(is_meant(&table), "{text}\n{:?}", table.guesses);
    }
    let section = |body: Body| {
        let list = body.of((BASE, PLATFORM));
        let joints =
            (0..6).map(|i| format!("joint{} = {}, {}, {}\n", i + 1, list[i][0], list[i][1], list[i][2]));
        format!("[{body}]\n") + &joints.collect::<Vec<_>>().concat()
    };
    assert!(is_meant(&read(&(section(Body::Platform) + &section(Body::Base)))));
}

#[test]
fn joints_on_posts_are_in_the_frame_of_their_body() {
    let raised = six(",", "bx,by,bz,px,py,pz\n", |x| x.to_string()).replace(",0\n", ",12\n");
    let table = read(&raised);
    assert_eq!((table.home, table.legs[0].platform.z), (None, 12.0), "{:?}", table.guesses);
}

#[test]
fn comments_behind_numbers_and_exponents_of_fortran_are_no_faults() {
    let rows = six(" ", "bx by bz px py pz\n", |x| format!("{x:e}").replace('e', "D"));
    let noted = rows.replace("D0\n", "D0  # leg of May 3\n");
    assert!(is_meant(&read(&noted)));
}

#[test]
fn columns_that_are_not_used_are_named_and_heights_are_z() {
    let with = |header: &str, more: &str| {
        let lines = six(",", "", |x| x.to_string());
        let lines: String = lines.lines().map(|line| format!("{line},{more}\n")).collect::<Vec<_>>().concat();
        read(&format!("{header}\n{lines}"))
    };
    let table = with("bx,by,bz,px,py,pz,length,n", "450,1");
    assert!(
        table.guesses.iter().any(|g| g == "These columns are not used: `length`."),
        "{:?}",
        table.guesses
    );
    let flat = |p: [f64; 3]| format!("{},{}", p[0], p[1]);
    let lines: String = (0..6)
        .map(|i| format!("{},25,{},-18\n", flat(BASE[i]), flat(PLATFORM[i])))
        .collect::<Vec<_>>()
        .concat();
    let header = "base_x,base_y,base_pin_height,plat_x,plat_y,plat_pin_height";
    let table = read(&format!("{header}\n{lines}"));
    assert_eq!((table.legs[2].base.z, table.legs[2].platform.z), (25.0, -18.0));
}

#[test]
fn polar_columns_have_their_own_units_of_angles_and_may_be_diameters() {
    let turns =
        [(15.0_f64, 45.0_f64), (105.0, 75.0), (135.0, 165.0), (225.0, 195.0), (255.0, 285.0), (345.0, 315.0)];
    let rows = |row: &dyn Fn(f64, f64) -> String| turns.map(|(a, b)| row(a, b) + "\n").concat();
    for text in [
        "Rb (mm),thetab (deg),Rp (mm),thetap (rad)\n".to_owned()
            + &rows(&|a, b| format!("100,{a},80,{}", b.to_radians())),
        "Rp (mm),thetap (rad),Rb (mm),thetab (deg)\n".to_owned()
            + &rows(&|a, b| format!("80,{},100,{a}", b.to_radians())),
        "base_diameter_mm,base_angle_deg,platform_diameter_mm,platform_angle_deg\n".to_owned()
            + &rows(&|a, b| format!("200,{a},160,{b}")),
        "unten Winkel [Grad];unten Radius [mm];oben Winkel [Grad];oben Radius [mm]\n".to_owned()
            + &rows(&|a, b| format!("{a};100;{b};80")),
    ] {
        let table = read(&text);
        let (a, b) = (table.legs[1].base, table.legs[3].platform);
        assert!((a.coords.norm() - 100.0).abs() < 1e-9 && (b.coords.norm() - 80.0).abs() < 1e-9, "{text}");
        assert!((a.y.atan2(a.x).to_degrees() - 105.0).abs() < 1e-9, "{text}");
        assert!((b.y.atan2(b.x).to_degrees() + 165.0).abs() < 1e-9, "{text}");
        assert_eq!(table.units.as_deref(), Some("mm"), "{text}");
    }
}

#[test]
fn faults_name_their_place() {
    let footer = six(";", "bx;by;bz;px;py;pz\n", |x| x.to_string()) + "mean;1;2;3;4;5;6\n";
    assert!(refusal(&footer).contains("the last is line 8, `mean 1 2 3"), "{}", refusal(&footer));
    let far =
        six(",", "", |x| if x.to_bits() == 62.374_f64.to_bits() { "1e61".into() } else { x.to_string() });
    assert!(refusal(&far).contains("line 2, column 2: `1e61` is too far out"), "{}", refusal(&far));
    // the names of the columns may stand above both bodies
    let blocks = "Base\nleg,x,y,z\n".to_owned()
        + &in_order([0, 1, 2, 3, 4, 5, 0, 0, 0, 0, 0, 0], |_, i| (i + 1).to_string())
            .lines()
            .take(6)
            .map(|line| format!("{line}\n"))
            .collect::<Vec<_>>()
            .concat()
        + "Platform\nleg,x,y,z\n"
        + &in_order([11, 10, 9, 8, 7, 6, 0, 0, 0, 0, 0, 0], |_, i| (i + 1).to_string())
            .lines()
            .take(6)
            .map(|line| format!("{line}\n"))
            .collect::<Vec<_>>()
            .concat();
    assert!(is_meant(&read(&blocks)));
}
