//! Plates against values by hand and by separate methods: polygons with many corners, dense points, laws of motions and
//! scales.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix2, Point2, Point3, Rotation3, Vector2, Vector3};

use super::moments::AreaMoments;
use super::*;
use crate::requirements::{
    AssessOptions, Hardware, KeepOutShape, LegBody, MarginVerdict, Requirements, Standing, TermKind, Terms,
    assess, prove,
};
use num::Rng;
use platform::geom::{Pose, PoseSpace};
use platform::manipulator::Manipulator;

fn stated() -> PlateDesign {
    PlateDesign {
        thickness: 0.5,
        margin: 2.0,
        hole: 0.6,
        height: Some(0.6),
        material: None,
        density: None,
        edge_distance: 0.4,
        hole_distance: 0.3,
        foot: Some(1.8),
        bolts: Some(BoltPattern {
            count: 4,
            circle: 1.4,
            hole: 0.2,
            first_deg: 45.0,
            from: BoltsFrom::Centre,
        }),
    }
}

/// Six upright legs of length 10 over a hexagon of radius 4.
fn upright() -> (Manipulator, Pose) {
    let ring = || -> Vec<Point3<f64>> {
        let at = |i: usize| (i as f64 * PI / 3.0).sin_cos();
        (0..6).map(|i| Point3::new(4.0 * at(i).1, 4.0 * at(i).0, 0.0)).collect()
    };
    let m = Manipulator::try_new(ring(), ring(), std::array::from_fn(|i| (i, i))).unwrap();
    (m, Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, 10.0) })
}

/// No symmetry, joints out of a plane.
fn crooked() -> (Manipulator, Pose) {
    let joints = |r: f64, rng: &mut Rng| -> Vec<Point3<f64>> {
        (0..6)
            .map(|i| {
                let angle = TAU * f64::from(i) / 6.0 + rng.uniform(-0.3, 0.3);
                let r = r * rng.uniform(0.8, 1.2);
                Point3::new(r * angle.cos(), r * angle.sin(), rng.uniform(-0.1, 0.1))
            })
            .collect()
    };
    let mut rng = Rng::new(8);
    let (base, platform) = (joints(10.0, &mut rng), joints(6.0, &mut rng));
    let m = Manipulator::try_new(base, platform, std::array::from_fn(|i| (i, i))).unwrap();
    (m, Pose { rotation: Rotation3::new(Vector3::new(0.1, 0.2, 0.0)), position: Vector3::new(0.5, 0.2, 9.0) })
}

fn required(plate: &PlateDesign) -> Requirements {
    let plates = Plates { base: Some(plate.clone()), platform: Some(plate.clone()) };
    let mut r = Requirements { plates, ..Requirements::default() };
    r.hardware.joint_diameter = Some(1.0);
    r.hardware.leg_body = Some(LegBody { diameter: 1.0, rod: None });
    r
}

fn outlines() -> Vec<Outline> {
    let p = Point2::new;
    [
        vec![p(0.0, 0.0), p(5.0, 1.0), p(4.0, 6.0), p(1.0, 7.0), p(2.0, 3.0)],
        vec![p(-1.0, 2.0), p(3.0, 5.0)],
        vec![p(0.5, -0.25)],
    ]
    .iter()
    .map(|points| Outline::around(points, 1.5, 1e-9))
    .collect()
}

/// Even-odd rule on the corners of a polygon.
fn holds(ring: &[Point2<f64>], p: &Point2<f64>) -> bool {
    let crossing = |i: usize| {
        let (a, b) = (ring[i], ring[(i + 1) % ring.len()]);
        (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
    };
    (0..ring.len()).filter(|i| crossing(*i)).count() % 2 == 1
}

/// Least distance from the edges of a polygon.
fn from_edges(ring: &[Point2<f64>], p: &Point2<f64>) -> f64 {
    let near = |i: usize| {
        let (a, d) = (ring[i], ring[(i + 1) % ring.len()] - ring[i]);
        a + d * ((p - a).dot(&d) / d.norm_squared().max(1e-300)).clamp(0.0, 1.0)
    };
    (0..ring.len()).map(near).map(|q| (p - q).norm()).fold(f64::INFINITY, f64::min)
}

#[test]
fn depths_and_nearest_points_are_those_of_a_polygon_with_many_corners() {
    let mut rng = Rng::new(3);
    for outline in outlines() {
        let ring = outline.polygon(3000);
        for _ in 0..200 {
            let p = Point2::new(rng.uniform(-4.0, 8.0), rng.uniform(-4.0, 10.0));
            let (depth, away) = (outline.depth(&p), from_edges(&ring, &p));
            let other = if holds(&ring, &p) { away } else { -away };
            assert!((depth - other).abs() < 1e-5, "{p}: {depth} {other}");
            let near = (outline.nearest(&p) - p).norm();
            assert!((near - (-depth).max(0.0)).abs() < 1e-12, "{p}");
        }
    }
}

/// By Green's theorem over the edges of a polygon with many corners, by Simpson's rule, which is exact for these
/// integrands on straight edges.
fn green(ring: &[Point2<f64>]) -> AreaMoments {
    let mut out = AreaMoments::default();
    for (i, a) in ring.iter().enumerate() {
        let b = ring[(i + 1) % ring.len()];
        let dy = b.y - a.y;
        for (weight, t) in [(1.0 / 6.0, 0.0), (4.0 / 6.0, 0.5), (1.0 / 6.0, 1.0)] {
            let (x, y) = (a.x + t * (b.x - a.x), a.y + t * dy);
            let w = weight * dy;
            out.area += w * x;
            out.first += Vector2::new(x * x / 2.0, x * y) * w;
            let mixed = x * x * y / 2.0;
            out.second += Matrix2::new(x.powi(3) / 3.0, mixed, mixed, x * y * y) * w;
        }
    }
    out
}

#[test]
fn areas_and_moments_are_those_of_a_polygon_with_many_corners() {
    for outline in outlines() {
        let mut found = AreaMoments::of(&outline);
        assert!((found.area - outline.area()).abs() < 1e-12 * found.area);
        let mut other = green(&outline.polygon(6000));
        // a hole, as a polygon too
        let (at, diameter) = (Point2::new(0.7, -0.1), 0.8);
        found.without_hole(&at, diameter);
        let hole: Vec<Point2<f64>> =
            (0..6000).map(|k| on_circle(&at, 0.5 * diameter, TAU * f64::from(k) / 6000.0)).collect();
        let hole = green(&hole);
        other.area -= hole.area;
        other.first -= hole.first;
        other.second -= hole.second;
        assert!((found.area - other.area).abs() < 1e-5 * found.area);
        assert!((found.first - other.first).norm() < 1e-5 * found.area * 10.0);
        assert!((found.second - other.second).norm() < 1e-5 * found.second.norm());
    }
}

#[test]
fn a_round_plate_has_the_mass_and_inertia_of_a_disc() {
    let centre = || vec![Point3::origin(); 6];
    let ring =
        || (0..6).map(|i| f64::from(i) * PI / 3.0).map(|a| Point3::new(a.cos(), a.sin(), 0.0)).collect();
    let m = Manipulator::try_new(centre(), ring(), std::array::from_fn(|i| (i, i))).unwrap();
    let home = Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, 10.0) };
    let plate = PlateDesign { bolts: None, hole: 1.0, density: Some(2000.0), ..stated() };
    let solid = PlateSolid::of(&plate, &m, Body::Base, &Hardware::default(), &home);
    let body = solid.rigid(&plate, 0.01).unwrap();
    // a ring from radius 0.5 to 2, thickness 0.5, in centimetres
    let mass = 2000.0 * 1e-6 * PI * (4.0 - 0.25) * 0.5;
    assert!((body.mass - mass).abs() < 1e-14);
    assert!((body.center.coords - Vector3::new(0.0, 0.0, -0.85)).norm() < 1e-14, "{}", body.center);
    let about = mass * (4.0 + 0.25) / 2.0;
    let across = about / 2.0 + mass * 0.25 / 12.0;
    let expected = nalgebra::Matrix3::from_diagonal(&Vector3::new(across, across, about));
    assert!((body.inertia - expected).norm() < 1e-13, "{}", body.inertia);
    assert!(solid.rigid(&PlateDesign { density: None, ..plate }, 0.01).is_none(), "nothing is made up");
}

#[test]
fn no_point_of_a_plate_is_nearer_to_a_segment() {
    let (m, home) = crooked();
    let solid = PlateSolid::of(&stated(), &m, Body::Base, &Hardware::default(), &home);
    let ring = solid.outline.polygon(400);
    let mut rng = Rng::new(9);
    let mut positive = 0;
    for _ in 0..40 {
        let mut point = || Point3::from(Vector3::from_fn(|_, _| rng.uniform(-16.0, 16.0)));
        let (x, y) = (point(), point());
        let (share, near) = solid.nearest_to_segment([&x, &y]);
        let distance = solid.distance(&x, &y);
        assert!(((x + (y - x) * share - near).norm() - distance).abs() < 1e-12);
        // the nearest of dense points of the segment, each with the nearest of dense points of the plate
        let mut least = f64::INFINITY;
        for k in 0..=300 {
            let p = solid.axes.transpose() * (x + (y - x) * (f64::from(k) / 300.0)).coords;
            let flat = Point2::new(p.x, p.y);
            let across = if holds(&ring, &flat) { 0.0 } else { from_edges(&ring, &flat) };
            let low = solid.lower();
            let along = (low - p.z).max(p.z - low - solid.thickness).max(0.0);
            least = least.min(across.hypot(along));
        }
        assert!(distance <= least + 1e-9 && distance > least - 0.12, "{distance} {least}");
        positive += u32::from(distance > 0.5);
    }
    assert!(positive > 5, "{positive}");
}

fn margins(terms: &Terms<'_>, pose: &Pose) -> Vec<(usize, f64)> {
    let all = terms.fixed().into_iter().chain(terms.at(pose));
    let of = |kind: TermKind| kind.plate().is_some() || kind == TermKind::PlateClearance;
    all.filter(|(t, _)| of(t.kind)).map(|(t, x)| (t.kind as usize, x)).collect()
}

#[test]
fn holes_of_a_hexagon_by_hand() {
    let (m, home) = upright();
    let found = |plate: &PlateDesign, kind: TermKind| {
        let r = required(plate);
        let terms = Terms::new(&m, &r, &home);
        let all = terms.fixed();
        all.into_iter().filter(|t| t.0.kind == kind).map(|t| t.1).fold(f64::INFINITY, f64::min)
    };
    let near = |x: f64, y: f64| assert!((x - y).abs() < 1e-12, "{x} {y}");
    // bolts at 45 degrees from the ray: outside the hull, in the fan of the corner within 30 degrees of each side only
    let away = 0.7 * (45.0f64 - 30.0).to_radians().cos();
    near(found(&stated(), TermKind::BaseHoleEdge), 2.0 - away - 0.1 - 0.4);
    // straight outwards
    let mut plate = stated();
    plate.bolts.as_mut().unwrap().first_deg = 0.0;
    near(found(&plate, TermKind::PlatformHoleEdge), 2.0 - 0.7 - 0.1 - 0.4);
    // own holes: 0.7 minus both radii; neighbours are 4 apart, feet 1.8 wide
    near(found(&plate, TermKind::BaseHoleGap), 0.7 - 0.3 - 0.1 - 0.3);
    plate.foot = Some(4.5);
    near(found(&plate, TermKind::BaseHoleGap), -0.5);
    // two bolts towards each other along the side: 4 - 1.4 - 0.2 - 0.3
    plate.foot = None;
    plate.bolts =
        Some(BoltPattern { count: 1, circle: 3.0, hole: 0.2, first_deg: 120.0, from: BoltsFrom::Centre });
    let pair = |k: f64| (Vector2::new(4.0, 0.0) + Vector2::new(k.cos(), k.sin()) * 1.5, k);
    let (a, _) = pair(120f64.to_radians());
    let next = Rotation3::from_axis_angle(&Vector3::z_axis(), PI / 3.0) * a.push(0.0);
    let expected = (next.xy() - a).norm() - 0.2 - 0.3;
    let seat = (Vector2::new(4.0 * (PI / 3.0).cos(), 4.0 * (PI / 3.0).sin()) - a).norm() - 0.4 - 0.3;
    near(found(&plate, TermKind::BaseHoleGap), expected.min(seat).min(1.5 - 0.4 - 0.3));
    // exactly at the limit, and slightly beyond
    let mut plate = PlateDesign { bolts: None, edge_distance: 1.7, ..stated() };
    let standing = |plate: &PlateDesign| {
        let r = required(plate);
        let space = PoseSpace::at(home);
        let found = assess(&m, &r, &space, &AssessOptions::new().points(4));
        found.margins.iter().find(|x| x.term.kind == TermKind::BaseHoleEdge).unwrap().standing
    };
    assert_eq!(standing(&plate), Standing::AtLimit);
    plate.edge_distance = 1.7 + 1e-9;
    assert_eq!(standing(&plate), Standing::Violated);
}

#[test]
fn margins_follow_motions_turns_and_scales() {
    let (m, home) = crooked();
    // bolts counted from the axis of a frame follow no motion of it
    let plate = PlateDesign { bolts: None, ..stated() };
    let of = |m: &Manipulator, home: &Pose, plate: &PlateDesign, unit: f64| {
        let mut r = required(plate);
        r.hardware.joint_diameter = Some(unit);
        r.hardware.leg_body = Some(LegBody { diameter: unit, rod: Some((3.0 * unit, 0.4 * unit)) });
        let pose = Pose { position: home.position + Vector3::new(2.0, 1.0, 0.5) * unit, ..*home };
        margins(&Terms::new(m, &r, home), &pose)
    };
    let same = |a: &[(usize, f64)], b: &[(usize, f64)], factor: f64| {
        assert_eq!(a.len(), b.len());
        assert!(a.len() > 30);
        for (x, y) in a.iter().zip(b) {
            assert!(x.0 == y.0 && (factor * x.1 - y.1).abs() < 1e-10 * factor, "{x:?} {y:?}");
        }
    };
    let plain = of(&m, &home, &plate, 1.0);
    // the base in another frame: the side of the legs stays the same relative to the plate
    let (turn, shift) = (Rotation3::new(Vector3::new(0.4, -0.7, 1.1)), Vector3::new(3.0, -2.0, 5.0));
    let base = m.base_joints().iter().map(|p| turn * p + shift).collect();
    let moved = Manipulator::try_new(base, m.platform_joints().to_vec(), m.pairs()).unwrap();
    let there = Pose { rotation: turn * home.rotation, position: turn * home.position + shift };
    let pose = |home: &Pose, d: Vector3<f64>| Pose { position: home.position + d, ..*home };
    let r = required(&plate);
    let d = Vector3::new(2.0, 1.0, 0.5);
    let a = margins(&Terms::new(&m, &r, &home), &pose(&home, d));
    let b = margins(&Terms::new(&moved, &r, &there), &pose(&there, turn * d));
    same(&a, &b, 1.0);
    // a rotation of both bodies about z permutes patterns that count from the centre
    let about = Rotation3::from_axis_angle(&Vector3::z_axis(), 0.8);
    let turned = |list: &[Point3<f64>]| list.iter().map(|p| about * p).collect::<Vec<_>>();
    let spun =
        Manipulator::try_new(turned(m.base_joints()), m.platform_joints().to_vec(), m.pairs()).unwrap();
    let spun_home = Pose { rotation: about * home.rotation, position: about * home.position };
    let flat = |m: &Manipulator| -> Manipulator {
        let flat = |list: &[Point3<f64>]| list.iter().map(|p| Point3::new(p.x, p.y, 0.0)).collect();
        Manipulator::try_new(flat(m.base_joints()), flat(m.platform_joints()), m.pairs()).unwrap()
    };
    let r = required(&stated());
    let a = margins(&Terms::new(&flat(&m), &r, &home), &home);
    let b = margins(&Terms::new(&flat(&spun), &r, &spun_home), &spun_home);
    same(&a, &b, 1.0);
    // all lengths in another unit
    let unit = 25.4;
    let scaled = |list: &[Point3<f64>]| list.iter().map(|p| p * unit).collect();
    let other =
        Manipulator::try_new(scaled(m.base_joints()), scaled(m.platform_joints()), m.pairs()).unwrap();
    let other_home = Pose { position: home.position * unit, ..home };
    let large = PlateDesign {
        thickness: plate.thickness * unit,
        margin: plate.margin * unit,
        hole: plate.hole * unit,
        height: plate.height.map(|h| h * unit),
        edge_distance: plate.edge_distance * unit,
        hole_distance: plate.hole_distance * unit,
        foot: plate.foot.map(|f| f * unit),
        ..plate.clone()
    };
    same(&plain, &of(&other, &other_home, &large, unit), unit);
}

#[test]
fn legs_that_lean_come_near_their_own_plates_by_what_trigonometry_says_and_it_is_proved() {
    let (m, home) = upright();
    let plate = PlateDesign { bolts: None, foot: None, ..stated() };
    let mut r = required(&plate);
    // legs lean up to 45 degrees; half a unit along them, beyond the housing, begins a cylinder of radius 0.5; the face
    // is 0.6 below
    let space = PoseSpace { translation: Vector3::new(10.0, 0.0, 0.0), ..PoseSpace::at(home) };
    let quick = AssessOptions::new().points(60).searches(1);
    let of = |r: &Requirements| {
        let proof = prove(&m, r, &space, &quick, 3000);
        proof.bounds.into_iter().find(|b| b.found.term.kind == TermKind::PlateClearance).unwrap()
    };
    let expected = 0.6 + 0.5 * 0.5f64.sqrt() - 0.5;
    let found = of(&r);
    assert!((found.found.value - expected).abs() < 1e-12, "{found:?}");
    assert_eq!(found.verdict, MarginVerdict::Met);
    assert!(found.below <= expected + 1e-12 && found.below > 0.0, "{found:?}");
    r.hardware.leg_clearance = Some(expected + 1e-3);
    assert_eq!(of(&r).verdict, MarginVerdict::Violated);
    r.hardware.leg_clearance = Some(expected - 1e-3);
    assert_eq!(of(&r).verdict, MarginVerdict::Met);
    // the payload between the legs: 4 - 1.5 - 0.5 from the axes
    r.hardware.leg_clearance = None;
    r.payload_shape = Some(KeepOutShape::Sphere { center: Point3::new(0.0, 0.0, -4.0), diameter: 3.0 });
    let still = PoseSpace { rotation_deg: Vector3::new(0.0, 0.0, 10.0), ..PoseSpace::at(home) };
    let proof = prove(&m, &r, &still, &quick, 3000);
    let payload = proof.bounds.iter().find(|b| b.found.term.kind == TermKind::PayloadClearance).unwrap();
    assert!(payload.verdict == MarginVerdict::Met && payload.found.value <= 2.0 && payload.below > 1.5);
}

#[test]
#[ignore = "evidence"]
fn no_sampled_pose_is_below_a_proved_clearance() {
    let mut rng = Rng::new(12);
    let (m, home) = crooked();
    let mut r = required(&stated());
    r.hardware.leg_body = Some(LegBody { diameter: 0.8, rod: Some((5.0, 0.3)) });
    let half = Vector3::new(3.0, 2.0, 1.5);
    let space = PoseSpace { translation: half, rotation_deg: Vector3::repeat(15.0), ..PoseSpace::at(home) };
    let quick = AssessOptions::new().points(40).searches(1);
    let proof = prove(&m, &r, &space, &quick, 600);
    let bound = proof.bounds.iter().find(|b| b.found.term.kind == TermKind::PlateClearance).unwrap();
    assert!(bound.below.is_finite() && bound.below <= bound.found.value, "{bound:?}");
    let terms = Terms::new(&m, &r, &home);
    for _ in 0..1500 {
        let mut draw = |h: f64| rng.uniform(-1.0, 1.0) * h;
        let d = Vector3::new(draw(half.x), draw(half.y), draw(half.z));
        let w = Vector3::new(draw(15.0), draw(15.0), draw(15.0)).map(f64::to_radians);
        let pose = Pose { rotation: Rotation3::new(w) * home.rotation, position: home.position + d };
        for (term, value) in terms.at(&pose) {
            if term.kind == TermKind::PlateClearance {
                assert!(value >= bound.below - 1e-12, "{value} {bound:?}");
            }
        }
    }
}
