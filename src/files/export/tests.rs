use std::collections::BTreeMap;
use std::f64::consts::PI;

use nalgebra::{Matrix3, Point2, Rotation3, Vector3};

use super::text::real;
use super::triangulate::triangulate;
use super::*;
use crate::design::{DesignModel, Format, parse};
use machine::requirements::{ConeLimits, Housing, JointAxes, LegBody, LengthLimits};
use platform::geom::Pose;
use platform::manipulator::Body;

const SYMMETRIC: &str = include_str!("../../../designs/symmetric-hexapod.toml");
const OCTAHEDRAL: &str = include_str!("../../../designs/rbt-octahedral.toml");
const GENERAL: &str = include_str!("../../../designs/general-6-6.toml");
const MIDLINE: &str = include_str!("../../../designs/rbt-midline.toml");

fn design(text: &str) -> DesignModel {
    parse(text, Format::Toml).unwrap().0
}

fn export_with(design: &DesignModel, options: &ExportOptions) -> Export {
    let home = design.home.unwrap_or_else(above);
    let poses = vec![home, Pose { position: home.position + Vector3::new(0.5, -0.25, 1.0), ..home }];
    let unit = LengthUnit::of(&design.units).or_else(|_| LengthUnit::of("m")).unwrap();
    Export::new(design, home, (poses, Vec::new()), &ExportOptions { unit: Some(unit), ..*options }).unwrap()
}

fn above() -> Pose {
    Pose { rotation: Rotation3::identity(), position: Vector3::new(0.1, 0.2, 30.0) }
}

fn export(text: &str) -> Export {
    export_with(&design(text), &ExportOptions::default())
}

fn text_of(export: &Export, format: &str, file: &str) -> String {
    let files = format.parse::<ExportFormat>().unwrap().writer().files(export).unwrap();
    files.into_iter().find(|f| f.name == file).unwrap().text
}

fn polygon_area(points: &[Point2<f64>]) -> f64 {
    let n = points.len();
    0.5 * (0..n).map(|i| points[i].coords.perp(&points[(i + 1) % n].coords)).sum::<f64>()
}

#[test]
fn outlines_of_a_point_a_line_and_a_square() {
    let p = Point2::new;
    let cases = [
        (vec![p(1.0, 2.0)], 2, PI),
        (vec![p(0.0, 0.0), p(3.0, 4.0), p(1.5, 2.0)], 4, PI + 10.0),
        (vec![p(0.0, 0.0), p(2.0, 2.0), p(2.0, 0.0), p(1.0, 1.0), p(0.0, 2.0), p(1.0, 0.0)], 8, PI + 12.0),
    ];
    for (points, parts, area) in cases {
        let outline = Outline::around(&points, 1.0, 1e-9);
        assert_eq!(outline.parts().len(), parts);
        assert!((outline.area() - area).abs() < 1e-12, "{}", outline.area());
        // the area by a separate method, from a polygon
        let polygon = polygon_area(&outline.polygon(720));
        assert!(polygon < area && polygon > area * (1.0 - 1e-4), "{polygon} {area}");
        let turned: f64 = outline
            .parts()
            .into_iter()
            .map(|part| if let OutlinePart::Arc { turn, .. } = part { turn } else { 0.0 })
            .sum();
        assert!((turned - 2.0 * PI).abs() < 1e-12);
    }
}

#[test]
fn triangles_fill_a_polygon_with_holes() {
    let ring = |x: f64, y: f64, r: f64, n: i32, sign: f64| -> Vec<Point2<f64>> {
        (0..n)
            .map(|k| {
                let (s, c) = (sign * 2.0 * PI * f64::from(k) / f64::from(n)).sin_cos();
                Point2::new(x + r * c, y + r * s)
            })
            .collect()
    };
    let outer = ring(0.0, 0.0, 10.0, 40, 1.0);
    let holes: Vec<_> = [(-5.0, 0.0), (5.0, 0.0), (0.0, 5.0), (0.0, -5.0), (0.0, 0.0)]
        .map(|(x, y)| ring(x, y, 1.5, 24, -1.0))
        .into();
    let points: Vec<Point2<f64>> = outer.iter().chain(holes.iter().flatten()).copied().collect();
    let triangles = triangulate(&outer, &holes);
    // a polygon with n corners and h holes has n + 2h - 2 triangles
    assert_eq!(triangles.len(), points.len() + 2 * holes.len() - 2);
    let area: f64 = triangles.iter().map(|t| polygon_area(&t.map(|k| points[k]))).sum();
    let expected = polygon_area(&outer) + holes.iter().map(|h| polygon_area(h)).sum::<f64>();
    assert!((area - expected).abs() < 1e-10);
    assert!(triangles.iter().all(|t| polygon_area(&t.map(|k| points[k])) > 0.0), "none is turned over");
}

#[test]
fn a_unit_that_is_none_is_refused_with_those_that_are() {
    assert_eq!(real(LengthUnit::of("in").unwrap().millimetres), "25.4");
    let home = above();
    let refused = Export::new(&design(GENERAL), home, (vec![], vec![]), &ExportOptions::default());
    let text = refused.unwrap_err().to_string();
    assert!(text.contains("`1`") && text.contains("um, mm, cm, m, in, ft"), "{text}");
}

#[test]
fn balls_sit_on_the_edges_of_their_holes_and_plates_on_the_far_side_of_the_legs() {
    for text in [OCTAHEDRAL, GENERAL, MIDLINE] {
        let export = export(text);
        for (body, sign) in export.bodies.iter().zip([-1.0, 1.0]) {
            let plate = body.plate().unwrap();
            assert_eq!(plate.legs_above, sign < 0.0, "{}", body.body);
            let face = if plate.legs_above { plate.thickness } else { 0.0 };
            assert_eq!(plate.holes.iter().map(|h| h.joints.len()).sum::<usize>(), body.joints.len());
            for hole in &plate.holes {
                let joint = body.joints.iter().find(|j| hole.joints.contains(&j.name)).unwrap();
                let local = plate.axes.transpose() * (joint.at - plate.origin);
                assert!((local.xy() - hole.at.coords).norm() < 1e-12 * export.size);
                let above = -sign * (local.z - face);
                let edge = above.hypot(0.5 * plate.hole_diameter);
                if hole.post > 0.0 {
                    assert!((above - hole.post - 0.5 * body.ball_diameter).abs() < 1e-12 * export.size);
                } else {
                    assert!((edge - 0.5 * body.ball_diameter).abs() < 1e-12 * export.size, "{edge}");
                }
            }
        }
    }
    let flat = export(OCTAHEDRAL);
    assert!(flat.bodies.iter().all(|b| b.plate().unwrap().holes.iter().all(|h| h.post <= 0.0)));
    assert!(export(GENERAL).bodies[0].plate().unwrap().holes.iter().any(|h| h.post > 0.0), "not flat");
}

#[test]
fn tables_read_back_to_the_same_numbers() {
    let export = export(GENERAL);
    let csv = text_of(&export, "csv", "joints.csv");
    let rows: Vec<Vec<&str>> =
        csv.lines().filter(|l| !l.starts_with('#')).skip(1).map(|l| l.split(',').collect()).collect();
    let joints: Vec<(Body, &ExportedJoint)> =
        export.bodies.iter().flat_map(|b| b.joints.iter().map(move |j| (b.body, j))).collect();
    assert_eq!(rows.len(), joints.len());
    for (row, (body, joint)) in rows.iter().zip(joints) {
        assert_eq!((row[0], row[1]), (body.name(), joint.name.as_str()));
        for k in 0..3 {
            assert_eq!(row[2 + k], real(joint.at[k] * 1000.0));
        }
    }
    let lengths = text_of(&export, "csv", "lengths-workspace.csv");
    let last: Vec<f64> = lengths.lines().last().unwrap().split(',').map(|x| x.parse().unwrap()).collect();
    let own = export.lengths_at(&export.workspace[1]);
    assert_eq!(last[8..14], own.map(|l| l * 1000.0), "metres to millimetres");
    // the JSON document is read back by a parser in tests/it/cli_export.rs
    assert!(text_of(&export, "json", "platform.json").contains("\"units\":\"mm\""));
}

#[test]
fn the_pins_of_genhexkins_are_the_joints_in_millimetres() {
    let export = export(OCTAHEDRAL);
    let text = text_of(&export, "hal", "genhexkins.hal");
    let pins: BTreeMap<&str, f64> = text
        .lines()
        .filter_map(|l| l.strip_prefix("setp genhexkins."))
        .map(|l| l.split_once(' ').unwrap())
        .map(|(pin, value)| (pin, value.parse().unwrap()))
        .collect();
    assert_eq!(pins.len(), 36);
    assert_eq!((pins["base.1.y"], pins["platform.2.x"]), (10.392304845413264, 6.0), "shared joints by leg");
}

#[test]
fn a_script_holds_the_arrays_in_metres() {
    let export = export(OCTAHEDRAL);
    let text = text_of(&export, "matlab", "platform.m");
    let matrix = |name: &str| -> Vec<Vec<f64>> {
        let body = text.split(&format!("stewart.{name} = [\n")).nth(1).unwrap().split("];").next().unwrap();
        let row = |l: &str| l.trim().trim_end_matches(';').split(", ").map(|x| x.parse().unwrap()).collect();
        body.lines().map(row).collect()
    };
    let (a, b, l) = (matrix("a"), matrix("b"), matrix("l"));
    assert_eq!((a.len(), a[0].len(), b[0].len(), l.len()), (3, 6, 6, 6));
    for (i, leg) in export.legs.iter().enumerate() {
        assert_eq!((a[1][i], l[i][0]), (leg.foot.y * 1e-3, leg.length() * 1e-3));
    }
}

/// Group codes and values of a DXF file.
fn groups(text: &str) -> Vec<(u32, &str)> {
    let lines: Vec<&str> = text.lines().collect();
    lines.chunks(2).map(|c| (c[0].trim().parse().unwrap(), c[1])).collect()
}

#[test]
fn hole_plans_have_a_circle_at_every_joint() {
    let export = export(MIDLINE);
    let text = text_of(&export, "dxf", "base-plate.dxf");
    let groups = groups(&text);
    assert_eq!(groups.last(), Some(&(0, "EOF")));
    let starts = groups.iter().enumerate().filter(|(_, g)| **g == (0, "CIRCLE")).map(|(i, _)| i);
    let value = |from: usize, code: u32| -> f64 {
        groups[from..].iter().find(|g| g.0 == code).unwrap().1.parse().unwrap()
    };
    let circles: Vec<[f64; 3]> = starts.map(|i| [10, 20, 40].map(|code| value(i, code))).collect();
    let body = &export.bodies[0];
    assert_eq!(circles.len(), body.joints.len());
    for (circle, joint) in circles.iter().zip(&body.joints) {
        assert_eq!(circle[..2], [joint.at.x, joint.at.y], "the plate lies in the x-y plane");
        assert_eq!(circle[2..], [0.5 * body.plate().unwrap().hole_diameter]);
    }
    let block = ["base plate", "material not stated", "ISO 2768-m for sizes", "datum: the cross"];
    assert!(block.iter().all(|part| text.contains(part)), "{text}");
    assert!(text.contains("no tolerance given"), "{text}");
}

#[test]
fn meshes_are_closed_and_hold_the_volume_of_the_plate() {
    for text in [OCTAHEDRAL, GENERAL] {
        let export = export(text);
        let mesh = text_of(&export, "stl", "platform-plate.stl");
        let corners: Vec<Vector3<f64>> = mesh
            .lines()
            .filter_map(|l| l.trim().strip_prefix("vertex "))
            .map(|l| Vector3::from_iterator(l.split(' ').map(|x| x.parse::<f64>().unwrap())))
            .collect();
        let key = |p: &Vector3<f64>| [p.x.to_bits(), p.y.to_bits(), p.z.to_bits()];
        let mut edges: BTreeMap<_, i32> = BTreeMap::new();
        for t in corners.chunks(3) {
            for (p, q) in [(0, 1), (1, 2), (2, 0)] {
                *edges.entry((key(&t[p]), key(&t[q]))).or_default() += 1;
            }
        }
        assert!(
            edges.iter().all(|((p, q), n)| edges.get(&(*q, *p)) == Some(n)),
            "every edge has its other side"
        );
        let volume: f64 = corners.chunks(3).map(|t| t[0].dot(&t[1].cross(&t[2])) / 6.0).sum();
        let plate = export.bodies[1].plate().unwrap();
        let posts: f64 = plate.holes.iter().map(|h| 0.25 * PI * plate.post_diameter.powi(2) * h.post).sum();
        let expected = (plate.volume() + posts) * export.unit.millimetres.powi(3);
        assert!((volume / expected - 1.0).abs() < 2e-3, "{volume} {expected}");
    }
}

/// Numbers of an attribute of the inertia of a body.
fn inertial(text: &str, body: &str, attribute: &str) -> Vec<f64> {
    let from = text.split(&format!("<body name=\"{body}\"")).nth(1).unwrap();
    let own = from.split("<inertial ").nth(1).unwrap().split("/>").next().unwrap();
    let value = own.split(&format!("{attribute}=\"")).nth(1).unwrap().split('"').next().unwrap();
    value.split(' ').map(|x| x.parse().unwrap()).collect()
}

#[test]
fn rods_carry_a_part_of_the_platform_and_nothing_moves_otherwise() {
    let payload = "[payload]\nmass = 40\ncenter = [5, -8, 60]\ninertia = [9.0e5, 8.0e5, 7.0e5]\n";
    let carrying = |payload: &str| {
        Export::of(&design(&format!("{SYMMETRIC}{payload}")), &ExportOptions::default()).unwrap()
    };
    let export = carrying(payload);
    assert_eq!(export.added_rod_mass(), None);
    let text = text_of(&export, "mjcf", "platform.xml");
    let moments = |mass: f64, c: Vector3<f64>, i: Matrix3<f64>| {
        Matrix3::identity() * (0.5 * i.trace()) - i + c * c.transpose() * mass
    };
    let i = inertial(&text, "platform", "fullinertia");
    let own = Matrix3::new(i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2]);
    let (mass, at) = (inertial(&text, "platform", "mass")[0], inertial(&text, "platform", "pos"));
    let at = Vector3::new(at[0], at[1], at[2]);
    let (mut all, mut first, mut second) = (mass, at * mass, moments(mass, at, own));
    for leg in &export.legs {
        let rod = format!("rod{}", leg.number);
        let share = inertial(&text, &rod, "mass")[0];
        assert!(share > 0.2 && inertial(&text, &rod, "pos") == [0.0; 3], "in the joint: {share}");
        let joint = export.bodies[1].joints[leg.platform].at.coords * 1e-3;
        (all, first, second) =
            (all + share, first + joint * share, second + joint * joint.transpose() * share);
    }
    let centre = Vector3::new(5e-3, -8e-3, 60e-3);
    let stated = Matrix3::from_diagonal(&Vector3::new(0.9, 0.8, 0.7));
    assert!((all - 40.0).abs() < 1e-12 && (first - centre * 40.0).norm() < 1e-12);
    assert!((second - moments(40.0, centre, stated)).norm() < 1e-12);
    // a lamina above the joints has too little mass
    let export = carrying(&payload.replace("[9.0e5, 8.0e5, 7.0e5]", "[4.0e5, 3.0e5, 7.0e5]"));
    let text = text_of(&export, "mjcf", "platform.xml");
    assert_eq!(export.added_rod_mass(), Some(inertial(&text, "rod1", "mass")[0]));
    assert!((inertial(&text, "platform", "mass")[0] - 40.0).abs() < 1e-12);
}

#[test]
fn a_simulation_has_six_actuators_and_five_loops() {
    let text = text_of(&export(OCTAHEDRAL), "mjcf", "platform.xml");
    let count = |what: &str| text.matches(what).count();
    assert_eq!((count("<connect "), count("<position "), count("type=\"slide\"")), (5, 6, 6));
    assert_eq!((count("type=\"hinge\""), count("type=\"ball\""), count("gravcomp")), (12, 1, 0));
    let options = ExportOptions { gravity_compensation: true, mass: Some(3.0), ..ExportOptions::default() };
    let carried = text_of(&export_with(&design(OCTAHEDRAL), &options), "mjcf", "platform.xml");
    assert_eq!(carried.matches("gravcomp=\"1\"").count(), 19);
    // the rods carry a part of the platform
    let masses = carried.split("<inertial ").skip(1).map(|rest| rest.split("mass=\"").nth(1).unwrap());
    let all: f64 = masses.map(|rest| rest.split('"').next().unwrap().parse::<f64>().unwrap()).sum();
    assert!((all - 3.0).abs() < 1e-7, "{all}");
    assert_eq!(
        (count("range="), carried.matches("ctrlrange").count()),
        (0, 0),
        "Drake takes a ctrlrange for a limit of force"
    );
    let limited = design(include_str!("../../../designs/worked/bench-octahedral.toml"));
    let limited = export_with(&limited, &ExportOptions::default());
    let text = text_of(&limited, "mjcf", "platform.xml");
    let home = limited.legs[0].length();
    let range = format!(" range=\"{} {}\"/>", real((198.0 - home) * 1e-3), real((298.0 - home) * 1e-3));
    // six slides, and the twelve hinges of the base joints with this range relative to home; six tendons for the angle
    // at the platform
    assert_eq!((text.matches(" range=").count(), text.contains(&range)), (24, true));
    assert_eq!(text.matches("<spatial name=\"swing").count(), 6);
    // visible and measured elements: a camera on the platform, ground below it, three sensors for each drive and the
    // pose
    assert_eq!(
        ["<camera ", "type=\"plane\"", "<jointpos ", "<jointvel ", "<actuatorfrc "]
            .map(|s| text.matches(s).count()),
        [1, 1, 6, 6, 6]
    );
    assert_eq!(text.matches("objname=\"platform_frame\"").count(), 2);
    let geoms = text.lines().filter(|l| l.contains("<geom ") && !l.contains("contype"));
    assert!(geoms.clone().count() > 24 && geoms.clone().all(|l| l.contains("rgba=")), "{text}");
    let height = text.split("type=\"plane\"").nth(1).and_then(|l| l.split("pos=\"0 0 ").nth(1)).unwrap();
    let height: f64 = height.split('"').next().unwrap().parse().unwrap();
    assert!(height < -0.5 * limited.bodies[0].ball_diameter * 1e-3 && height > -0.1, "{height}");
    let cone_angle = real(limited.hardware.base_cone_angle.unwrap().limits_deg[0].to_radians());
    assert_eq!(text.matches(&format!(" range=\"-{cone_angle} {cone_angle}\"")).count(), 12);
}

#[test]
fn exchange_files_name_only_entities_they_hold() {
    let text = text_of(&export(GENERAL), "step", "platform.step");
    let data = text.split("DATA;\n").nth(1).unwrap();
    let mut defined = 0;
    for line in data.lines().filter(|l| l.starts_with('#')) {
        let (id, entity) = line[1..].split_once('=').unwrap();
        defined += 1;
        assert_eq!(id.parse::<usize>().unwrap(), defined, "in order");
        for reference in entity.split('#').skip(1) {
            let number: String = reference.chars().take_while(char::is_ascii_digit).collect();
            assert!(number.parse::<usize>().unwrap() < defined, "{line}");
        }
    }
    let export = export(GENERAL);
    let posts: usize =
        export.bodies.iter().map(|b| b.plate().unwrap().holes.iter().filter(|h| h.post > 0.0).count()).sum();
    let kinds = export.leg_kinds().len();
    // base, platform and six legs in the whole; two plates, six joints on each, posts; cylinder and rod of each kind of
    // leg
    assert_eq!(text.matches("NEXT_ASSEMBLY_USAGE_OCCURRENCE").count(), 2 + 6 + 2 + 12 + posts + 2 * kinds);
    assert!(text.contains("AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF"));
}

#[test]
fn legs_that_are_equal_are_places_of_one_part_and_joints_say_what_they_are() {
    let export = export(include_str!("../../../designs/worked/simulator-300kg-built.toml"));
    let text = text_of(&export, "step", "platform.step");
    let occurrences = |name: &str| text.matches(&format!(",'{name}','',#")).count();
    let kinds = export.leg_kinds();
    assert_eq!(kinds.iter().map(|kind| kind.legs.len()).sum::<usize>(), 6);
    // joints on a grid of 25 mm: no two legs have the same length
    assert_eq!(kinds.len(), 6, "{kinds:?}");
    for number in 1..=6 {
        assert_eq!(occurrences(&format!("leg {number}")), 1, "leg {number}");
    }
    assert_eq!((occurrences("cylinder"), occurrences("rod")), (kinds.len(), kinds.len()));
    let mut parts: Vec<&str> =
        text.split("PRODUCT('").skip(1).map(|rest| rest.split('\'').next().unwrap()).collect();
    let count = parts.len();
    parts.sort_unstable();
    parts.dedup();
    assert_eq!(parts.len(), count, "two parts of one name: {parts:?}");
    assert!(text.contains("PRODUCT('ball joint of the base','ball joint of the base','housing: ball of 40.0 mm; cone angle 30.0 deg',"), "{text}");
    // the legs of an octahedral platform above the middle of its base have one length
    let equal = self::export(include_str!("../../../designs/worked/simulator-300kg.toml"));
    assert_eq!(equal.leg_kinds().len(), 1, "{:?}", equal.leg_kinds());
    let step = text_of(&equal, "step", "platform.step");
    assert_eq!((step.matches("PRODUCT('leg'").count(), step.matches("PRODUCT('rod'").count()), (1, 1));
    // common limits give all legs the same rod, and cylinder sizes are those of the machine
    let products = |text: &str, name: &str| text.matches(&format!("PRODUCT('{name}")).count();
    assert_eq!(
        (products(&text, "leg, kind"), products(&text, "cylinder"), products(&text, "rod")),
        (6, 1, 1)
    );
    // without limits the rods are as long as the legs allow
    let free = self::export(GENERAL);
    let (kinds, text) = (free.leg_kinds().len(), text_of(&free, "step", "platform.step"));
    assert!(kinds > 1);
    assert_eq!((products(&text, "cylinder"), products(&text, "rod, kind")), (1, kinds));
    // other joints at one leg: that body has two parts
    let mut mixed = design(SYMMETRIC);
    mixed.hardware.base_cone_angle = Some(ConeLimits::of_all(20.0, JointAxes::Home));
    if let Some(cone_angle) = &mut mixed.hardware.base_cone_angle {
        cone_angle.limits_deg[2] = 25.0;
    }
    let text = text_of(&export_with(&mixed, &ExportOptions::default()), "step", "platform.step");
    assert!(text.contains("'ball joint of the base, kind 2'") && text.contains("'leg, kind 2'"), "{text}");
    assert!(!text.contains("'ball joint of the platform, kind"));
}

#[test]
fn housings_that_are_boxes_are_drawn_around_their_balls() {
    let mut boxed = design(SYMMETRIC);
    boxed.hardware.base_housing = Some(Housing::Box(nalgebra::Vector3::new(30.0, 40.0, 50.0)));
    let export = export_with(&boxed, &ExportOptions::default());
    let text = text_of(&export, "step", "platform.step");
    let joints = export.bodies[0].joints.len();
    // one part, a place beside each ball, and a box of six faces with all corners at half the edges
    assert_eq!(text.matches("PRODUCT('housing of the").count(), 1);
    assert_eq!(
        text.matches(",'housing of ").count(),
        joints + 1,
        "a place at each joint, and the second name of the part"
    );
    for sign in 0..8 {
        let side = |k: usize, half: f64| if sign >> k & 1 == 0 { -half } else { half };
        let corner = [side(0, 15.0), side(1, 20.0), side(2, 25.0)].map(super::text::step_real).join(",");
        assert!(text.contains(&format!("CARTESIAN_POINT('',({corner}))")), "{corner}");
    }
    assert_eq!(text.matches("SPHERICAL_SURFACE").count(), 2, "a ball for each body");
    let plain = text_of(&self::export(SYMMETRIC), "step", "platform.step");
    assert_eq!(text.matches("PLANE(").count() - plain.matches("PLANE(").count(), 6);
    assert!(!plain.contains("housing of"));
    // each edge belongs to two faces, once forwards and once backwards
    let oriented = |sense: &str| -> Vec<String> {
        let end = format!(",.{sense}.);");
        let lines = text.lines().filter_map(|l| l.split("=ORIENTED_EDGE('',*,*,").nth(1));
        let mut found: Vec<String> = lines.filter_map(|l| l.strip_suffix(&end)).map(str::to_owned).collect();
        found.sort();
        found
    };
    assert_eq!(oriented("T"), oriented("F"));
}

#[test]
fn rods_stay_in_their_cylinders_over_the_stroke() {
    let files = [
        "bench-joint-free",
        "simulator-300kg-built",
        "chair-hung",
        "isolator-3",
        "linuxcnc-griffis-duffy",
        "positioner-joint-free",
    ];
    for file in files {
        let text = std::fs::read_to_string(format!("../../designs/worked/{file}.toml")).unwrap();
        let export = Export::of(&design(&text), &ExportOptions::default()).unwrap();
        let (least, greatest) = export.leg_range.unwrap();
        for kind in export.leg_kinds() {
            let t = export.telescope(&kind).unwrap();
            let near = 1e-12 * export.size;
            assert!(t.range[0] <= least && t.range[1] >= greatest, "{file}: {t:?}");
            assert!(t.foot < t.floor && t.floor < t.mouth && t.rod > 0.0, "{file}: {t:?}");
            for k in 0..=20 {
                let length = least + (greatest - least) * f64::from(k) / 20.0;
                let tail = t.tail(length);
                assert!(tail >= t.floor - near, "{file}: through the floor at {length}: {t:?}");
                assert!(tail < t.mouth, "{file}: out of the cylinder at {length}: {t:?}");
                // the visible part of the rod, and the whole leg
                assert!((tail + t.rod + t.tip - length).abs() < near);
            }
            assert!(t.clearance() >= -near, "{file}: {t:?}");
        }
    }
    // retracted at home, hardly longer than that at the least, and with joints nearly as long as the least length
    let at_home = self::export(SYMMETRIC).legs.iter().map(ExportLeg::length).fold(f64::INFINITY, f64::min);
    for least in [at_home, 1.06 * at_home, 28.0, 20.0, 10.0] {
        let mut near = design(SYMMETRIC);
        near.hardware.leg_length = Some(LengthLimits::Range(least, 900.0));
        let export = export_with(&near, &ExportOptions::default());
        for kind in export.leg_kinds() {
            let t = export.telescope(&kind).unwrap();
            assert!(t.foot < t.mouth && t.rod > 0.0, "{least}: {t:?}");
        }
        assert!(text_of(&export, "step", "platform.step").contains("'rod'"));
    }
    // a stroke too long for a rod in one piece, and a rod as wide as its cylinder: both are reported and exported
    let mut long = design(SYMMETRIC);
    long.hardware.leg_length = Some(LengthLimits::Range(200.0, 900.0));
    let export = export_with(&long, &ExportOptions::default());
    let t = export.telescope(&export.leg_kinds()[0]).unwrap();
    assert!(t.held() < 0.0);
    assert!(text_of(&export, "step", "platform.step").contains("out of its cylinder by up to"));
    // a rod that ends at the mouth is not reported as leaving it
    let mut just = design(SYMMETRIC);
    just.hardware.leg_body = Some(LegBody { diameter: 10.0, rod: Some((200.0, 6.0)) });
    let mut up_to = |greatest: f64| {
        just.hardware.leg_length = Some(LengthLimits::Range(380.0, greatest));
        let export = export_with(&just, &ExportOptions::default());
        (export.telescope(&export.leg_kinds()[0]).unwrap(), text_of(&export, "step", "platform.step"))
    };
    let t = up_to(900.0).0;
    for more in [1.0, 1.0 + 1e-15] {
        let (t, text) = up_to((t.mouth + t.tip + t.rod) * more);
        assert!(t.held() == 0.0 && text.contains("is just in its cylinder at the greatest length"), "{t:?}");
    }
    assert!(up_to(t.mouth + t.tip + t.rod + 0.01).1.contains("out of its cylinder by up to 0.01"));
    let mut wide = design(SYMMETRIC);
    wide.hardware.leg_body = Some(LegBody { diameter: 10.0, rod: Some((200.0, 10.0)) });
    let export = export_with(&wide, &ExportOptions::default());
    let kind = &export.leg_kinds()[0];
    let t = export.telescope(kind).unwrap();
    assert!((t.tail(kind.length) - t.mouth).abs() < 1e-9 && t.floor >= t.mouth, "{t:?}");
    assert!(text_of(&export, "step", "platform.step").contains("'rod'"));
}

/// The main texts of a drawing (without their outlines) and their places, for classes that contain `class`.
fn labels(svg: &str, class: &str) -> Vec<(f64, f64, String)> {
    let field = |line: &str, name: &str| -> String {
        line.split(&format!(" {name}=\"")).nth(1).unwrap().split('"').next().unwrap().to_string()
    };
    let texts = svg.lines().filter(|l| l.starts_with("<text") && !l.contains("aria-hidden"));
    texts
        .filter(|l| field(l, "class").split(' ').any(|c| c == class))
        .map(|l| {
            let text = l.split('>').nth(1).unwrap().split('<').next().unwrap().to_string();
            (field(l, "x").parse().unwrap(), field(l, "y").parse().unwrap(), text)
        })
        .collect()
}

/// Two overlapping labels. Letters have a mean width of 0.6 of the font size of nine pixels, from 0.72 of it above the
/// line to 0.22 below.
fn meeting(labels: &[(f64, f64, String)]) -> Option<(String, String)> {
    let span = |l: &(f64, f64, String)| {
        [l.0, l.0 + 0.6 * 9.0 * l.2.chars().count() as f64, l.1 - 0.72 * 9.0, l.1 + 0.22 * 9.0]
    };
    let pairs = labels.iter().enumerate().flat_map(|(i, a)| labels[i + 1..].iter().map(move |b| (a, b)));
    pairs
        .filter(|(a, b)| {
            let (a, b) = (span(a), span(b));
            a[0] < b[1] && b[0] < a[1] && a[2] < b[3] && b[2] < a[3]
        })
        .map(|(a, b)| (a.2.clone(), b.2.clone()))
        .next()
}

#[test]
fn no_label_of_a_drawing_covers_another() {
    let mut drawn = 0;
    let mut paths = Vec::new();
    for folder in ["", "presets", "worked"] {
        paths
            .extend(std::fs::read_dir(format!("../../designs/{folder}")).unwrap().map(|e| e.unwrap().path()));
    }
    paths.sort();
    for path in paths.iter().filter(|p| p.extension().is_some_and(|e| e == "toml")) {
        let text = std::fs::read_to_string(path).unwrap();
        let Ok((design, _)) = crate::design::parse_with_cranks(&text, Format::Toml) else { continue };
        let unit = LengthUnit::of(&design.units).or_else(|_| LengthUnit::of("mm")).unwrap();
        let options = ExportOptions::new().unit(unit);
        let Ok(export) = Export::new(&design, design.home_or_default(), (vec![], vec![]), &options) else {
            continue;
        };
        let Ok(files) = export.files(ExportFormat::Drawing) else { continue };
        let mut labels = labels(&files[0].text, "small");
        let joints: usize = export.bodies.iter().map(|b| b.joints.len()).sum();
        // joints, two origins and six legs in each of three views
        assert_eq!(labels.len(), 3 * (joints + 2 + 6), "{}", path.display());
        assert_eq!(meeting(&labels), None, "{}", path.display());
        drawn += 1;
        // a label on another is found
        (labels[0].0, labels[0].1) = (labels[7].0 + 3.0, labels[7].1 - 2.0);
        assert!(meeting(&labels).is_some());
    }
    assert!(drawn > 24, "{drawn}");
}

#[test]
fn what_a_format_cannot_hold_is_said() {
    let wide =
        ExportOptions { hole: Some(4.0), ball: Some(5.0), margin: Some(5.0), ..ExportOptions::default() };
    let tight = export_with(&design(MIDLINE), &wide);
    for format in ["dxf", "step", "stl", "svg"] {
        let why = format.parse::<ExportFormat>().unwrap().writer().files(&tight).unwrap_err();
        assert!(matches!(why, Unsupported::SeatsOverlap { parts: "holes", .. }), "{why}");
    }
    for format in ["csv", "hal", "json", "matlab", "mjcf"] {
        assert!(
            format.parse::<ExportFormat>().unwrap().writer().files(&tight).is_ok(),
            "{format} has no plates"
        );
    }
    // coincident joints in a view, and a post beside a joint
    for x in [20.0, 21.0] {
        let text = format!(
            "name = 'seats'\nunits = 'mm'\n\
             legs = [['A', 'G'], ['B', 'G'], ['C', 'H'], ['D', 'H'], ['E', 'I'], ['F', 'I']]\n\
             [base]\nA = [0, 0, 0]\nB = [50, 0, 0]\nC = [0, 50, 0]\nD = [50, 50, 0]\nE = [20, 20, 4]\nF = [{x}, 20, 0]\n\
             [platform]\nG = [0, 0, 0]\nH = [30, 0, 0]\nI = [0, 30, 0]\n"
        );
        let options = ExportOptions { ball: Some(2.0), hole: Some(0.4), ..ExportOptions::default() };
        let why = ExportFormat::Stl.writer().files(&export_with(&design(&text), &options)).unwrap_err();
        assert!(matches!(why, Unsupported::SeatsOverlap { parts: "posts", .. }), "{why}");
    }
    let fat = ExportOptions { hole: Some(0.1), ball: Some(17.0), ..ExportOptions::default() };
    let why = ExportFormat::Step.writer().files(&export_with(&design(OCTAHEDRAL), &fat)).unwrap_err();
    assert!(matches!(why, Unsupported::LegTooShort { leg: 1, .. }), "{why}");
    let home = above();
    let bad = |options| Export::new(&design(OCTAHEDRAL), home, (vec![], vec![]), &options).unwrap_err();
    for options in [
        ExportOptions { hole: Some(9.0), ball: Some(5.0), ..ExportOptions::default() },
        ExportOptions { thickness: Some(0.0), ..ExportOptions::default() },
        ExportOptions { margin: Some(f64::NAN), ..ExportOptions::default() },
        ExportOptions { mass: Some(-1.0), ..ExportOptions::default() },
        ExportOptions { hole: Some(1.0), ball: Some(2.0), margin: Some(0.4), ..ExportOptions::default() },
    ] {
        assert!(matches!(bad(options), NoExport::BadSize { .. }));
    }
}

#[test]
fn names_cannot_break_out_of_a_file() {
    use super::text::{csv_field, step_real, xml_comment};
    assert_eq!(csv_field("a,\"b\"\n"), "\"a,\"\"b\"\" \"");
    assert_eq!(xml_comment("a--->\u{1}<b>"), "a- - -> <b>");
    assert_eq!([1e-7, 1.5e300, -0.0, 2.0].map(step_real), ["1.0E-7", "1.5E300", "0.0", "2.0"]);
    let mut odd = design(OCTAHEDRAL);
    odd.name = "a'b*/\n-->%\"é".to_string();
    let odd = export_with(&odd, &ExportOptions::default());
    assert!(text_of(&odd, "step", "platform.step").contains("'a''b*/ -->%\"\\X2\\00E9\\X0\\'"));
    let script = text_of(&odd, "matlab", "platform.m");
    assert!(script.contains("stewart.name = 'a''b*/ -->%\"é';"));
    let model = text_of(&odd, "mjcf", "platform.xml");
    assert_eq!(model.matches("-->").count(), 1, "the comment ends where it should");
}

#[test]
#[ignore = "evidence"]
fn the_same_design_gives_the_same_bytes_and_every_file_says_its_unit() {
    for format in ExportFormat::ALL {
        let (one, two) = (export(OCTAHEDRAL), export(OCTAHEDRAL));
        assert_eq!(one.files(format), two.files(format), "{format}");
        // one file of the C code for controllers states the unit; the others have no numbers of the design
        let says_it = |name: &str| format != ExportFormat::C || name == "equipod_design.h";
        for file in one.files(format).unwrap().iter().filter(|file| says_it(&file.name)) {
            assert!(file.text.contains("mm") || file.text.contains(" m;"), "{}", file.name);
            assert!(file.text.contains("frame"), "{}", file.name);
        }
    }
}

/// The symmetric hexapod with bolted joints.
const PLATES: &str = r#"
[plates.base]
thickness = 12
margin = 40
hole = 10
height = 30
material = "aluminium"
bolts = { count = 4, circle = 32, hole = 5.5, first_deg = 45, from = "centre" }
[plates.platform]
thickness = 8
margin = 30
hole = 8
material = "steel"
[payload]
mass = 60
plate = "added"
"#;

#[test]
fn stated_plates_are_what_is_drawn_weighed_and_listed() {
    let text = format!("{}{PLATES}", include_str!("../../../designs/symmetric-hexapod.toml"));
    let design = design(&text);
    let export = Export::of(&design, &ExportOptions::default()).unwrap();
    let [base, platform] = &export.bodies;
    let plate = base.plate().unwrap();
    assert!((plate.thickness - 12.0).abs() < 1e-12 && (plate.outline.margin - 40.0).abs() < 1e-12);
    assert_eq!((plate.bolt_count(), plate.all_holes().count()), (24, 30));
    // the assessed plate is the drawn one
    let solid = design.plate(Body::Base).unwrap();
    assert_eq!(solid.outline, plate.outline);
    for (hole, seat) in plate.holes.iter().zip(&solid.seats) {
        assert_eq!((hole.at, &hole.bolts), (seat.at, &seat.bolts));
    }
    let face = plate.origin.coords.dot(&plate.axes.column(2)) + if plate.legs_above { 12.0 } else { 0.0 };
    assert!((face - solid.face).abs() < 1e-12 && (face + 30.0).abs() < 1e-9, "{face}");
    for (body, drawn) in [(Body::Base, plate), (Body::Platform, platform.plate().unwrap())] {
        let mass = drawn.mass(1e-3).unwrap();
        assert!((mass / design.plate_mass(body).unwrap() - 1.0).abs() < 1e-12);
    }
    let steel = design.plate_mass(Body::Platform).unwrap();
    assert!((export.moving.mass - 60.0 - steel).abs() < 1e-12, "the model weighs what moves");
    assert_eq!(Some(export.moving), design.moving_bodies(1e-3));
    // DXF: a circle for each hole, none for the others
    let dxf = text_of(&export, "dxf", "base-plate.dxf");
    assert_eq!(dxf.matches("CIRCLE").count(), 30);
    assert!(
        dxf.contains("24 bolt holes, diameter 5.5000 (M5, ISO 273 medium)")
            && !dxf.contains("-0.0000")
            && dxf.contains("material aluminium")
    );
    assert_eq!(text_of(&export, "dxf", "platform-plate.dxf").matches("CIRCLE").count(), 6);
    // STEP: each hole is a separate cylinder
    let step = text_of(&export, "step", "platform.step");
    let cylinders = step.lines().filter(|l| l.contains("CYLINDRICAL_SURFACE") && l.contains(",2.75)"));
    assert_eq!(cylinders.count(), 24, "cylinders of bolt holes");
    // parts
    let parts = export.parts();
    let find = |name: &str| parts.iter().find(|p| p.part == name).unwrap();
    assert_eq!((find("bolt of a base joint").count, find("bolt of a base joint").thickness), (24, Some(5.0)));
    assert!(parts.iter().all(|p| p.part != "bolt of a platform joint"));
    assert!((find("platform plate").mass.unwrap() - steel).abs() < 1e-12);
    assert!((find("payload").mass.unwrap() - 60.0).abs() < 1e-9, "the plate is not counted twice");
    let total: f64 = parts.iter().filter_map(|p| p.mass.map(|m| m * p.count as f64)).sum();
    let aluminium = design.plate_mass(Body::Base).unwrap();
    assert!((total - 60.0 - steel - aluminium).abs() < 1e-9);
}

#[test]
fn bolt_holes_that_run_into_others_or_out_of_the_plate_are_no_plate() {
    let text = format!("{}{PLATES}", include_str!("../../../designs/symmetric-hexapod.toml"));
    for (from, to, what) in [
        ("circle = 32", "circle = 12", "the hole of"),
        ("circle = 32", "circle = 90", "the outline"),
        ("count = 4", "count = 64", "a bolt hole of"),
    ] {
        let export = Export::of(&design(&text.replacen(from, to, 1)), &ExportOptions::default()).unwrap();
        let why = export.bodies[0].plate().unwrap_err();
        assert!(
            matches!(&why, Unsupported::HolesMeet { .. }) && why.to_string().contains(what),
            "{to}: {why}"
        );
    }
}
