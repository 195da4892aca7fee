//! Margins against values that are known from the definitions.
#![allow(clippy::float_cmp, reason = "exact values are read")]

use nalgebra::{Point3, Rotation3, Unit, Vector3};

use super::*;
use num::Rng;
use platform::geom::Pose;
use platform::manipulator::Body;
use platform::manipulator::{Manipulator, jacobian};

/// Six vertical legs of length 10 over a hexagon of radius 4 (singular at home, without effect on lengths and
/// clearances).
fn upright() -> (Manipulator, Pose) {
    let ring = || -> Vec<Point3<f64>> {
        let at = |i: usize| (i as f64 * std::f64::consts::FRAC_PI_3).sin_cos();
        (0..6).map(|i| Point3::new(4.0 * at(i).1, 4.0 * at(i).0, 0.0)).collect()
    };
    let legs = std::array::from_fn(|i| (i, i));
    let m = Manipulator::try_new(ring(), ring(), legs).unwrap();
    (m, Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, 10.0) })
}

/// Legs in pairs, regular.
fn slanted() -> (Manipulator, Pose) {
    let ring = |r: f64, half: f64, turn: f64| -> Vec<Point3<f64>> {
        let angle = |i: usize| {
            (120.0 * (i / 2) as f64 + turn + if i.is_multiple_of(2) { -half } else { half }).to_radians()
        };
        (0..6).map(|i| Point3::new(r * angle(i).cos(), r * angle(i).sin(), 0.0)).collect()
    };
    // base joints 0..5 at 0-, 0+, 120-, ..; platform joints turned by 60 degrees
    let legs = [(0, 5), (1, 0), (2, 1), (3, 2), (4, 3), (5, 4)];
    let m = Manipulator::try_new(ring(10.0, 10.0, 0.0), ring(6.0, 12.0, 60.0), legs).unwrap();
    (m, Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, 12.0) })
}

fn margin(found: &Assessment, kind: TermKind) -> &Margin {
    found.margins.iter().find(|m| m.term.kind == kind).unwrap()
}

fn quick() -> AssessOptions {
    AssessOptions::new().points(60)
}

#[test]
fn nothing_required_gives_no_margins() {
    let (m, home) = upright();
    let found = assess(&m, &Requirements::default(), &PoseSpace::at(home), &quick());
    assert!(found.margins.is_empty() && found.all_met());
}

#[test]
fn lengths_cone_angles_and_clearances_of_upright_legs() {
    let (m, home) = upright();
    let mut r = Requirements::default();
    r.hardware.leg_length = Some(LengthLimits::Range(9.0, 10.5));
    r.hardware.leg_body = Some(LegBody { diameter: 1.0, rod: Some((6.0, 0.5)) });
    r.hardware.leg_clearance = Some(0.25);
    r.hardware.base_cone_angle = Some(ConeLimits::of_all(30.0, JointAxes::Home));
    let tilted = Unit::new_normalize(Vector3::new(1.0, 0.0, 1.0));
    r.hardware.platform_cone_angle = Some(ConeLimits::of_all(50.0, JointAxes::Given([tilted; 6])));
    r.hardware.joint_diameter = Some(1.5);
    r.min_joint_distance = Some(3.0);
    let post = KeepOutShape::Capsule {
        from: Point3::new(0.0, 0.0, -1.0),
        to: Point3::new(0.0, 0.0, 9.0),
        diameter: 2.0,
    };
    let tool = KeepOutShape::Box { center: Point3::new(0.0, 0.0, -5.0), size: Vector3::new(2.0, 6.0, 4.0) };
    for (name, fixed_to, shape) in [("post", Body::Base, post), ("tool", Body::Platform, tool)] {
        r.keep_outs.push(KeepOut { name: name.into(), fixed_to, shape });
    }
    let at = |x: f64| Pose { position: home.position + Vector3::new(x, 0.0, 0.0), ..home };
    let terms = Terms::new(&m, &r, &home);
    let values = |pose: &Pose, kind: TermKind| -> Vec<f64> {
        terms.at(pose).into_iter().filter(|t| t.0.kind == kind).map(|t| t.1).collect()
    };
    let near = |x: &[f64], y: f64| assert!(x.iter().all(|x| (x - y).abs() < 1e-12), "{x:?} {y}");
    near(&values(&home, TermKind::MinLegLength), 1.0);
    near(&values(&home, TermKind::MaxLegLength), 0.5);
    near(&values(&home, TermKind::BaseConeAngle), 30.0);
    near(&values(&home, TermKind::PlatformConeAngle), 5.0);
    near(&values(&at(10.0), TermKind::BaseConeAngle), -15.0);
    near(&values(&at(10.0), TermKind::PlatformConeAngle), 50.0);
    // neighbours are 4 apart: cylinder to cylinder 4 - 1 - 0.25
    let gaps = values(&home, TermKind::LegClearance);
    assert_eq!(gaps.len(), 15);
    assert!((gaps.iter().copied().fold(f64::INFINITY, f64::min) - 2.75).abs() < 1e-12);
    // the post: 4 - 1 - 0.5 - 0.25 from cylinders; the tool reaches y = 3, x = 1, legs stand at (2, 3.46)
    let keep: Vec<(Term, f64)> =
        terms.at(&home).into_iter().filter(|t| t.0.kind == TermKind::KeepOut).collect();
    let of = |k: usize| keep.iter().filter(|t| t.0.second == k).map(|t| t.1).fold(f64::INFINITY, f64::min);
    assert!((of(0) - 2.25).abs() < 1e-12);
    let corner = (1.0f64 + (12.0f64.sqrt() - 3.0).powi(2)).sqrt();
    assert!((of(1) - (corner - 0.5 - 0.25)).abs() < 1e-12, "{}", of(1));
    // joints 4 apart: housings leave 2.5, centres 1
    let fixed = terms.fixed();
    assert_eq!(fixed.len(), 30);
    assert!((fixed.iter().map(|t| t.1).fold(f64::INFINITY, f64::min) - 1.0).abs() < 1e-12);
}

#[test]
fn legs_at_a_shared_joint_are_not_compared() {
    let joints = |r: f64| {
        (0..3).map(|i| Rotation3::new(Vector3::z() * 2.1 * f64::from(i)) * Point3::new(r, 0.0, 0.0)).collect()
    };
    let m = Manipulator::try_new(joints(9.0), joints(5.0), [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)])
        .unwrap();
    let home = Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, 8.0) };
    let mut r = Requirements::default();
    r.hardware.leg_body = Some(LegBody { diameter: 0.1, rod: None });
    // 15 pairs, 6 of which share a joint
    assert_eq!(Terms::new(&m, &r, &home).at(&home).len(), 9);
}

#[test]
fn the_worst_length_of_a_box_is_at_its_corner_and_is_found() {
    let (m, home) = upright();
    let mut r = Requirements::default();
    r.hardware.leg_length = Some(LengthLimits::Stroke { dead: 4.0, stroke: 4.0 });
    let space = PoseSpace { translation: Vector3::new(3.0, 4.0, 2.0), ..PoseSpace::at(home) };
    let found = assess(&m, &r, &space, &quick());
    let longest = (25.0f64 + 144.0).sqrt();
    assert!((margin(&found, TermKind::MaxLegLength).value - (12.0 - longest)).abs() < 1e-12);
    assert!(!found.all_met());
    // the least length, 8, is an inner pose of the face z = 8: only the search comes near
    assert!((0.0..1e-6).contains(&margin(&found, TermKind::MinLegLength).value));
    let again = assess(&m, &r, &space, &quick());
    assert_eq!(found, again, "same seed, same answer");
    // an ellipsoid with these half axes does not reach the corner
    let round = PoseSpace { region: Region::Ellipsoid, ..space };
    let inside = assess(&m, &r, &round, &quick());
    assert!(margin(&inside, TermKind::MaxLegLength).value > 12.0 - longest + 0.3);
}

#[test]
fn a_violation_between_two_poses_of_a_trajectory_is_found() {
    let (m, home) = upright();
    let mut r = Requirements::default();
    r.hardware.leg_length = Some(LengthLimits::Range(10.0, 20.0));
    let at = |x: f64| Pose { position: home.position + Vector3::new(x, 0.0, -1.0), ..home };
    let mut space = PoseSpace::at(home);
    space.trajectory = vec![at(-6.0), at(6.0)];
    let found = assess(&m, &r, &space, &quick());
    assert!(margin(&found, TermKind::MinLegLength).value < -0.99);
    space.trajectory.truncate(1);
    assert!(assess(&m, &r, &space, &quick()).all_met());
}

#[test]
fn speeds_are_reached_by_some_motion_and_passed_by_none() {
    let (m, home) = slanted();
    let mut r = Requirements::default();
    r.hardware.max_leg_speed = Some(100.0);
    r.platform_speed = Some(PlatformSpeed { linear: 3.0, angular_deg: 40.0 });
    let pose = Pose { rotation: Rotation3::from_euler_angles(0.1, 0.2, -0.1), ..home };
    let bound = Terms::new(&m, &r, &home).at(&pose);
    let rows = jacobian(&m, &pose, 1.0);
    let mut rng = Rng::new(8);
    let mut greatest = [0.0f64; 6];
    for _ in 0..20_000 {
        let mut direction = || Vector3::from_fn(|_, _| rng.normal()).normalize();
        let (v, w) = (direction() * 3.0, direction() * 40f64.to_radians());
        for (i, g) in greatest.iter_mut().enumerate() {
            let speed = rows.fixed_view::<1, 3>(i, 0).transpose().dot(&v)
                + rows.fixed_view::<1, 3>(i, 3).transpose().dot(&w);
            *g = g.max(speed);
        }
    }
    for (i, (_, margin)) in bound.iter().enumerate() {
        let fastest = 100.0 - margin;
        assert!(greatest[i] <= fastest + 1e-12 && greatest[i] > 0.97 * fastest, "{} {fastest}", greatest[i]);
    }
}

#[test]
fn weight_is_shared_by_the_legs_and_forces_at_a_singular_pose_are_violations() {
    let (m, home) = slanted();
    let mut r = Requirements::default();
    r.hardware.max_leg_force = Some(200.0);
    r.loads.push(Load {
        name: "weight".into(),
        force: Vector3::new(0.0, 0.0, -600.0),
        torque: Vector3::zeros(),
        at: Point3::origin(),
        fixed_to: Body::Base,
        legs: None,
    });
    let rise = jacobian(&m, &home, 1.0)[(0, 2)];
    for (_, margin) in Terms::new(&m, &r, &home).at(&home) {
        assert!((margin - (200.0 - 100.0 / rise)).abs() < 1e-9, "six equal legs carry 100 each along z");
    }
    let (singular, home) = upright();
    let values = Terms::new(&singular, &r, &home).at(&home);
    assert!(values.iter().all(|(_, x)| *x < -1e6), "{values:?}");
}

/// Two base joints 0.3 - 0.2 apart with 0.1 required: another double, but the same distance.
#[test]
fn a_margin_that_rounding_makes_is_at_the_limit_and_the_next_one_is_not() {
    let standing = |shift: f64, scale: f64, least: f64| {
        let at = |x: f64, y: f64| Point3::new(scale * (x + shift), scale * y, 0.0);
        let base = vec![at(0.2, 0.0), at(0.3, 0.0), at(0.0, 1.0), at(1.0, 1.0), at(1.0, -1.0), at(0.0, -1.0)];
        let m = Manipulator::try_new(base.clone(), base, std::array::from_fn(|i| (i, (i + 1) % 6))).unwrap();
        let required = Requirements { min_joint_distance: Some(scale * least), ..Requirements::default() };
        let home = Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, scale) };
        let found = assess(&m, &required, &PoseSpace::at(home), &quick());
        let margin = margin(&found, TermKind::BaseSpacing);
        (margin.value, margin.standing, found.all_met())
    };
    for scale in [1.0, 1e-3, 1e6] {
        let (value, ..) = standing(0.0, scale, 0.1);
        assert!(value.abs() < 1e-15 * scale, "{value}");
        assert!(matches!(standing(0.0, scale, 0.1), (_, Standing::AtLimit, true)));
        assert!(matches!(standing(0.0, scale, 0.1 + 1e-12), (_, Standing::Violated, false)));
        assert!(matches!(standing(0.0, scale, 0.1 - 1e-12), (_, Standing::Met, true)));
    }
    // far from the origin coordinates have fewer digits for the same distance
    assert!(standing(1e4, 1.0, 0.1).0 < -1e-13);
    assert!(matches!(standing(1e4, 1.0, 0.1), (_, Standing::AtLimit, true)));
    assert!(matches!(standing(1e4, 1.0, 0.1 + 1e-6), (_, Standing::Violated, false)));
}

/// Each kind of limit set to its value at home is reached there within rounding; a little more is a violation.
#[test]
fn limits_set_to_the_values_at_home_are_reached_and_not_violated() {
    let (m, home) = slanted();
    let base_axes = JointAxes::Given([Unit::new_normalize(Vector3::new(0.3, 0.1, 1.0)); 6]);
    let weight = Load {
        name: "weight".into(),
        force: Vector3::new(0.0, 20.0, -100.0),
        torque: Vector3::zeros(),
        at: Point3::new(1.0, 2.0, 3.0),
        fixed_to: Body::Base,
        legs: None,
    };
    let with = |length: f64, cone_angle: f64, force: f64, speed: f64| {
        let mut r = Requirements {
            loads: vec![weight.clone()],
            platform_speed: Some(PlatformSpeed { linear: 1.0, angular_deg: 10.0 }),
            ..Requirements::default()
        };
        r.hardware.leg_length = Some(LengthLimits::Range(0.1, length));
        r.hardware.base_cone_angle = Some(ConeLimits::of_all(cone_angle, base_axes));
        r.hardware.max_leg_force = Some(force);
        r.hardware.max_leg_speed = Some(speed);
        r
    };
    let least = |r: &Requirements| {
        let found = assess(&m, r, &PoseSpace::at(home), &quick());
        [TermKind::MaxLegLength, TermKind::BaseConeAngle, TermKind::LegForce, TermKind::LegSpeed]
            .map(|kind| (margin(&found, kind).value, margin(&found, kind).standing))
    };
    let wide = [100.0, 90.0, 1e4, 100.0];
    let margins = least(&with(wide[0], wide[1], wide[2], wide[3]));
    let [a, b, c, d]: [f64; 4] = std::array::from_fn(|k| wide[k] - margins[k].0);
    for share in [1.0 - 1e-16, 1.0, 1.0 + 2e-16] {
        for (_, standing) in least(&with(a * share, b * share, c * share, d * share)) {
            assert_eq!(standing, Standing::AtLimit);
        }
    }
    let (low, high) = (1.0 - 1e-10, 1.0 + 1e-10);
    for (_, standing) in least(&with(a * low, b * low, c * low, d * low)) {
        assert_eq!(standing, Standing::Violated);
    }
    for (_, standing) in least(&with(a * high, b * high, c * high, d * high)) {
        assert_eq!(standing, Standing::Met);
    }
}

/// Requirements of `slanted` of several kinds, with a small workspace.
fn several() -> (Manipulator, Requirements, PoseSpace) {
    let (m, home) = slanted();
    let mut r = Requirements::default();
    r.hardware.leg_length = Some(LengthLimits::Range(8.0, 18.0));
    r.hardware.leg_body = Some(LegBody { diameter: 0.4, rod: Some((6.0, 0.3)) });
    r.hardware.leg_clearance = Some(0.05);
    r.hardware.base_cone_angle = Some(ConeLimits::of_all(30.0, JointAxes::Home));
    r.hardware.max_leg_speed = Some(3.0);
    r.platform_speed = Some(PlatformSpeed { linear: 1.0, angular_deg: 2.0 });
    let sphere = KeepOutShape::Sphere { center: Point3::new(0.0, 0.0, 3.0), diameter: 2.0 };
    r.keep_outs.push(KeepOut { name: "post".into(), fixed_to: Body::Base, shape: sphere });
    let space = PoseSpace {
        translation: Vector3::new(0.5, 0.4, 0.3),
        rotation_deg: Vector3::new(2.0, 3.0, 4.0),
        ..PoseSpace::at(home)
    };
    (m, r, space)
}

#[test]
fn a_kind_alone_has_the_margins_it_has_among_all() {
    let (m, r, space) = several();
    let terms = Terms::new(&m, &r, &space.home);
    let pose = space.pose(&nalgebra::Vector6::new(0.3, -0.9, 0.5, 0.2, -0.7, 1.0));
    let all = terms.at(&pose);
    let kinds: std::collections::BTreeSet<TermKind> = all.iter().map(|t| t.0.kind).collect();
    assert!(kinds.len() >= 6, "{kinds:?}");
    for kind in kinds {
        let among: Vec<(Term, f64)> = all.iter().copied().filter(|t| t.0.kind == kind).collect();
        assert_eq!(terms.of_kind(&pose, kind).collect::<Vec<_>>(), among);
    }
}

/// Cells are bounded in batches whose size is independent of the threads.
#[test]
fn proofs_do_not_depend_on_the_number_of_threads() {
    let (m, mut r, space) = several();
    r.safety_margins.all = Some(0.02);
    let of = |threads: usize, close: bool| {
        let options = quick().threads(std::num::NonZeroUsize::new(threads).unwrap()).close(close);
        prove(&m, &r, &space, &options, 400)
    };
    for close in [true, false] {
        let one = of(1, close);
        assert_eq!(one, of(3, close));
        // more than a batch of one requirement, where bounds come close
        assert!(!close || one.bounds.iter().map(|b| b.cells).max() > Some(40), "{one:?}");
        assert_eq!((one.all_met(), one.all_keep_safety_margin()), (Some(true), Some(true)), "{one:?}");
    }
    // a bound that only decides gives the same safety margins as a close one
    let safety_margins =
        |p: &MarginProof| p.bounds.iter().map(MarginBound::keeps_safety_margin).collect::<Vec<_>>();
    assert_eq!(safety_margins(&of(1, false)), safety_margins(&of(1, true)));
}
