use std::collections::BTreeSet;

use nalgebra::{Point3, Rotation3, Unit, Vector3, Vector6};

use super::{NearestPoseOptions, PoseAxis, Reach, StraightPath};
use crate::fixtures::symmetric_hexapod;
use crate::requirements::{
    ConeLimits, Hardware, JointAxes, KeepOut, KeepOutShape, LegBody, LengthLimits, Limit, Load,
    PlatformSpeed, Requirements, TermKind, UniversalJoint,
};
use num::Rng;
use platform::geom::Pose;
use platform::manipulator::{Body, Manipulator, default_home};

/// All requirements that a pose can violate.
fn required(m: &Manipulator, home: &Pose) -> Requirements {
    let length = home.lengths(m).unwrap().get()[0];
    let hardware = Hardware {
        leg_length: Some(LengthLimits::Range(0.75 * length, 1.25 * length)),
        base_cone_angle: Some(ConeLimits::of_all(25.0, JointAxes::Home)),
        platform_cone_angle: Some(ConeLimits::of_all(40.0, JointAxes::Home)),
        leg_body: Some(LegBody { diameter: 0.12, rod: Some((0.6 * length, 0.06)) }),
        leg_clearance: Some(0.02),
        max_leg_force: Some(60.0),
        max_leg_speed: Some(1.9),
        ..Hardware::default()
    };
    let ball = |center: Point3<f64>, fixed_to| KeepOut {
        name: "ball".into(),
        fixed_to,
        shape: KeepOutShape::Sphere { center, diameter: 0.4 },
    };
    let load = Load {
        name: "weight".into(),
        force: Vector3::new(3.0, 0.0, -100.0),
        torque: Vector3::zeros(),
        at: Point3::new(0.1, 0.0, 0.2),
        fixed_to: Body::Base,
        legs: None,
    };
    Requirements {
        hardware,
        keep_outs: vec![
            ball(Point3::new(0.0, 0.0, 0.8), Body::Base),
            ball(Point3::new(0.3, 0.0, -0.6), Body::Platform),
        ],
        loads: vec![load],
        platform_speed: Some(PlatformSpeed { linear: 1.0, angular_deg: 40.0 }),
        ..Requirements::default()
    }
}

fn only_lengths(m: &Manipulator, home: &Pose, share: f64) -> Requirements {
    let length = home.lengths(m).unwrap().get()[0];
    let limits = LengthLimits::Range((1.0 - share) * length, (1.0 + share) * length);
    Requirements {
        hardware: Hardware { leg_length: Some(limits), ..Hardware::default() },
        ..Requirements::default()
    }
}

/// A path of mixed velocities from a pose about home.
fn drawn(home: &Pose, rng: &mut Rng) -> StraightPath {
    let mut vector = |x: f64| Vector3::from_fn(|_, _| rng.uniform(-x, x));
    let start =
        Pose { rotation: Rotation3::new(vector(0.1)) * home.rotation, position: home.position + vector(0.1) };
    StraightPath { start, velocity: vector(1.0), turn: vector(1.0), pivot: vector(0.3) }
}

#[test]
fn one_number_of_a_pose_moves_and_the_others_stay() {
    let pose = Pose::new([1.0, 2.0, 3.0], platform::geom::Angles::from_degrees([20.0, -35.0, 130.0]));
    for (k, axis) in PoseAxis::ALL.into_iter().enumerate() {
        let moved = StraightPath::axis(&pose, axis).at(0.25);
        let numbers = |p: &Pose| {
            let angles = p.angles().radians();
            [p.position.x, p.position.y, p.position.z, angles[0], angles[1], angles[2]]
        };
        let (before, after) = (numbers(&pose), numbers(&moved));
        for i in 0..6 {
            let meant = if i == k { before[i] + 0.25 } else { before[i] };
            assert!((after[i] - meant).abs() < 1e-14, "{} {i}", axis.name());
        }
    }
}

/// The requirements that end random paths about home, each compared with a search in small steps.
fn ends_of_paths(m: &Manipulator, required: &Requirements, home: &Pose, paths: usize) -> BTreeSet<TermKind> {
    let reach = Reach::new(m, required, home, 1.0);
    assert!(reach.allows(home), "{:?}", reach.violated(home));
    let mut rng = Rng::new(4);
    let mut kinds = BTreeSet::new();
    let mut checked = 0;
    while checked < paths {
        let path = drawn(home, &mut rng);
        if !reach.allows(&path.start) {
            continue;
        }
        checked += 1;
        let found = reach.along(&path, 3.0);
        let step = 1e-3;
        let first = (1..=3000).find(|k| !reach.allows(&path.at(f64::from(*k) * step)));
        assert!(reach.allows(&found.pose));
        // the end agrees with the search within one of its steps
        let last = (found.amount / step).floor();
        assert!(first.is_none_or(|k| f64::from(k) > last), "{first:?} {}", found.amount);
        assert!(
            first.is_none_or(|k| found.amount < f64::from(k) * step + 1e-9),
            "{first:?} {}",
            found.amount
        );
        let Some(limit) = found.binding else { continue };
        assert!(!reach.allows(&path.at(found.amount + 1e-9)), "what binds is violated beyond");
        if let Limit::Term(term) = limit {
            kinds.insert(term.kind);
        }
    }
    kinds
}

#[test]
#[ignore = "evidence"]
fn the_free_part_of_a_way_is_that_of_a_fine_search() {
    let m = symmetric_hexapod(2.0, 1.0);
    let home = default_home(&m);
    let mut required = required(&m, &home);
    let mut kinds = ends_of_paths(&m, &required, &home, 60);
    // without limits of lengths and joint angles the others bind
    required.hardware =
        Hardware { leg_length: None, base_cone_angle: None, platform_cone_angle: None, ..required.hardware };
    kinds.extend(ends_of_paths(&m, &required, &home, 60));
    required.hardware.max_leg_force = None;
    kinds.extend(ends_of_paths(&m, &required, &home, 60));
    required.hardware.max_leg_speed = None;
    kinds.extend(ends_of_paths(&m, &required, &home, 60));
    required.keep_outs.clear();
    kinds.extend(ends_of_paths(&m, &required, &home, 60));
    assert!(kinds.len() >= 6, "{kinds:?}");
}

#[test]
fn ranges_of_lengths_alone_are_the_roots_of_the_quadratics() {
    let m = symmetric_hexapod(2.0, 1.0);
    let home = default_home(&m);
    let required = only_lengths(&m, &home, 0.2);
    let reach = Reach::new(&m, &required, &home, 1.0);
    let ranges = reach.free_ranges(&home).unwrap();
    let length = home.lengths(&m).unwrap().get()[0];
    for (k, range) in ranges.iter().take(3).enumerate() {
        for (sign, travel) in [(-1.0, &range.back), (1.0, &range.forth)] {
            let mut least = f64::INFINITY;
            for leg in m.legs() {
                let d = home.transform(&leg.platform) - leg.base;
                for limit in [0.8 * length, 1.2 * length] {
                    // |d|^2 + 2 t sign d_k + t^2 = limit^2
                    let (b, c) = (sign * d[k], d.norm_squared() - limit * limit);
                    let root = (b * b - c).max(0.0).sqrt();
                    for t in [-b - root, -b + root] {
                        if b * b >= c && t > 1e-12 {
                            least = least.min(t);
                        }
                    }
                }
            }
            assert!((travel.amount - least).abs() < 1e-9, "{k}: {} {least}", travel.amount);
            assert!(travel.poses < 200, "{}", travel.poses);
        }
    }
    // half a turn about z passes a singular pose at a quarter
    let yaw = &ranges[5];
    assert_eq!(yaw.axis, PoseAxis::Yaw);
    let limits = [yaw.back.binding, yaw.forth.binding];
    assert!(limits.iter().all(Option::is_some), "{limits:?}");
}

#[test]
fn a_singular_pose_ends_a_way_where_nothing_else_does() {
    let m = symmetric_hexapod(2.0, 1.0);
    let home = default_home(&m);
    let nothing = Requirements::default();
    let reach = Reach::new(&m, &nothing, &home, 1.0);
    let yaw = reach.along(&StraightPath::axis(&home, PoseAxis::Yaw), 3.0);
    assert_eq!(yaw.binding, Some(Limit::Singular));
    assert!((yaw.amount - std::f64::consts::FRAC_PI_2).abs() < 1e-9, "{}", yaw.amount);
    let up = reach.along(&StraightPath::axis(&home, PoseAxis::Z), 50.0);
    assert!(up.binding.is_none() && up.amount.to_bits() == 50.0_f64.to_bits());
}

#[test]
fn a_way_from_a_limit_goes_inwards_and_not_outwards() {
    let m = symmetric_hexapod(2.0, 1.0);
    let home = default_home(&m);
    let required = required(&m, &home);
    let reach = Reach::new(&m, &required, &home, 1.0);
    for axis in PoseAxis::ALL {
        let path = StraightPath::axis(&home, axis);
        let end = reach.along(&path, 3.0);
        let out = reach.along(&StraightPath { start: end.pose, ..path }, 3.0);
        assert!(out.amount < 1e-8, "{}: {}", axis.name(), out.amount);
        let back = reach.along(&StraightPath { start: end.pose, ..path.reversed() }, end.amount);
        assert!((back.amount - end.amount).abs() < 1e-12, "{}: {:?}", axis.name(), back);
    }
    let beyond = Pose { position: home.position + Vector3::z() * 5.0, ..home };
    assert!(reach.free_ranges(&beyond).is_none());
    let stuck = reach.along(&StraightPath::axis(&beyond, PoseAxis::X), 1.0);
    assert!(stuck.amount == 0.0 && stuck.binding.is_some());
}

/// No random pose about the result is allowed and nearer by more than its step can gain.
fn is_locally_nearest(reach: &Reach<'_>, asked: &Pose, found: &Pose, rng: &mut Rng) -> bool {
    let distance = reach.distance(found, asked);
    (0..4000).all(|k| {
        let far = [1e-2, 1e-3][k % 2];
        let step = Vector6::from_fn(|_, _| rng.uniform(-far, far));
        let pose = reach.stepped(found, &step);
        reach.distance(&pose, asked) > distance - 1e-6 || !reach.ends_at(&pose)
    })
}

#[test]
#[ignore = "evidence"]
fn the_nearest_pose_meets_the_limits_and_nothing_allowed_beside_it_is_nearer() {
    let m = symmetric_hexapod(2.0, 1.0);
    let home = default_home(&m);
    let mut rng = Rng::new(9);
    for required in [only_lengths(&m, &home, 0.2), required(&m, &home)] {
        let reach = Reach::new(&m, &required, &home, 0.8);
        let mut stationary = 0;
        for k in 0..20 {
            let mut vector = |x: f64| Vector3::from_fn(|_, _| rng.uniform(-x, x));
            let asked = Pose {
                rotation: Rotation3::new(vector(1.0)) * home.rotation,
                position: home.position + vector(1.5),
            };
            let found = reach.nearest(&asked, &NearestPoseOptions::default()).unwrap();
            assert!(reach.allows(&found.pose), "{k}");
            assert!((reach.distance(&found.pose, &asked) - found.distance).abs() < 1e-12);
            let first = reach.along(&StraightPath::between(&home, &asked), 1.0);
            assert!(
                found.distance <= reach.distance(&first.pose, &asked) + 1e-12,
                "{k}: not farther than the straight path"
            );
            assert!(found.distance <= reach.distance(&home, &asked), "{k}: nearer than home");
            if found.distance == 0.0 {
                continue;
            }
            assert!(!found.binding.is_empty(), "{k}");
            stationary += u32::from(found.stationary);
            if found.stationary {
                assert!(is_locally_nearest(&reach, &asked, &found.pose, &mut rng), "{k}: {found:?}");
            }
        }
        assert!(stationary >= 12, "{stationary}");
    }
}

#[test]
fn along_the_axis_of_symmetry_the_nearest_pose_is_the_highest() {
    let m = symmetric_hexapod(2.0, 1.0);
    let home = default_home(&m);
    let required = only_lengths(&m, &home, 0.1);
    let reach = Reach::new(&m, &required, &home, 1.0);
    let asked = Pose { position: home.position + Vector3::z() * 3.0, ..home };
    let found = reach.nearest(&asked, &NearestPoseOptions::default()).unwrap();
    let highest = reach.along(&StraightPath::axis(&home, PoseAxis::Z), 3.0);
    assert!(
        (found.distance - (3.0 - highest.amount)).abs() < 1e-6,
        "{} {}",
        found.distance,
        3.0 - highest.amount
    );
    assert!(found.stationary && found.straight_from_home);
    assert_eq!(found.binding.len(), 6, "{:?}", found.binding);
    let tooth = |l: &Limit| matches!(l, Limit::Term(t) if t.kind == TermKind::MaxLegLength);
    assert!(found.binding.iter().all(tooth));
    assert!(reach.nearest(&home, &NearestPoseOptions::default()).unwrap().distance < f64::MIN_POSITIVE);
}

#[test]
fn without_an_allowed_pose_there_is_none_nearest() {
    let m = symmetric_hexapod(2.0, 1.0);
    let home = default_home(&m);
    // a leg can have no length between these
    let hardware = Hardware { leg_length: Some(LengthLimits::Range(1e-9, 2e-9)), ..Hardware::default() };
    let required = Requirements { hardware, ..Requirements::default() };
    let reach = Reach::new(&m, &required, &home, 1.0);
    let axis = Unit::new_normalize(Vector3::x());
    let asked = Pose { rotation: Rotation3::from_axis_angle(&axis, 0.1), ..home };
    assert!(reach.nearest(&asked, &NearestPoseOptions::default()).is_none());
}

/// Paths end where an angle of a universal joint reaches its limit, and not before.
#[test]
fn universal_joints_end_ways_where_a_fine_search_finds_it() {
    let m = symmetric_hexapod(2.0, 1.0);
    let home = default_home(&m);
    let first_axes = std::array::from_fn(|i| {
        let (s, c) = (i as f64).sin_cos();
        Some(nalgebra::Unit::new_normalize(Vector3::new(c, s, 0.1)))
    });
    let joint = |limits| UniversalJoint {
        first_axes,
        limits_deg: [Some(limits); 6],
        axes: JointAxes::Home,
        offset: 0.0,
    };
    let hardware = Hardware {
        base_universal: Some(joint([25.0, 50.0])),
        platform_universal: Some(joint([45.0, 75.0])),
        ..Hardware::default()
    };
    let kinds = ends_of_paths(&m, &Requirements { hardware, ..Requirements::default() }, &home, 12);
    assert!(kinds.len() >= 2, "{kinds:?}");
}
