use super::*;
use nalgebra::{Point3, Rotation3};
use platform::manipulator::{Leg, default_home};

fn p(x: f64, y: f64, z: f64) -> Point3<f64> {
    Point3::new(x, y, z)
}

/// All midpoints of two triangles: det A = 0.
fn midline() -> Manipulator {
    let (b, t) =
        ([p(0., 0., 0.), p(12., 0., 0.), p(5., 11., 0.)], [p(0., 0., 0.), p(6., 0., 0.), p(2., 5., 0.)]);
    let zigzag = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    let mid = |x: Point3<f64>, y: Point3<f64>| nalgebra::center(&x, &y);
    Manipulator::from_legs(std::array::from_fn(|i| {
        let ((i0, j0), (i1, j1)) = (zigzag[i], zigzag[(i + 1) % 6]);
        Leg { base: mid(b[i0], b[i1]), platform: mid(t[j0], t[j1]) }
    }))
    .unwrap()
}

fn some_pose() -> Pose {
    Pose { rotation: Rotation3::from_euler_angles(0.2, -0.1, 0.4), position: Vector3::new(3.0, 2.5, 8.0) }
}

#[test]
fn a_griffis_duffy_platform_moves_on_closed_curves_with_constant_lengths() {
    let m = midline();
    let pose = some_pose();
    let s = pose.squared_lengths(&m).unwrap();
    let found = self_motion(&m, &s, &[pose], &MotionOptions::default());
    assert_eq!(found.dimension(), Some(1), "{:?}", found.at_pose);
    assert!(!found.curves.is_empty() && found.worst_length_error < 1e-13, "{:?}", found.worst_length_error);
    for c in &found.curves {
        assert!(matches!(c.end, CurveEnd::Closed | CurveEnd::Joined), "{:?}", c.end);
        assert!(c.points.len() > 50);
    }
    assert!(found.curves.iter().any(|c| c.end == CurveEnd::Closed));
    // another pose of the curve gives the same curve
    let middle = found.curves[0].points[found.curves[0].points.len() / 3].pose;
    let again = self_motion(&m, &s, &[middle], &MotionOptions::default());
    let length = |f: &SelfMotion| f.curves[0].points.last().unwrap().arc;
    assert!((length(&again) - length(&found)).abs() < 0.05 * length(&found));
    assert_eq!(
        self_motion(&m, &s, &[pose, middle], &MotionOptions::default()).curves.len(),
        found.curves.len()
    );
}

#[test]
fn a_regular_platform_does_not_move() {
    let m = midline();
    let mut legs = m.legs();
    legs[2].base.x += 0.3;
    let m = Manipulator::from_legs(legs).unwrap();
    let pose = some_pose();
    let s = pose.squared_lengths(&m).unwrap();
    let found = self_motion(&m, &s, &[pose], &MotionOptions::default());
    assert!(found.dimension() == Some(0) && found.curves.is_empty());
    assert!(matches!(found.at_pose.unwrap().verdict, PoseVerdict::Isolated { order: 1, .. }));
    assert_eq!(curve_degree(&m, &s, &pose, 1), None);
}

#[test]
fn five_legs_at_one_joint_leave_two_freedoms() {
    let base = |i: usize| {
        let (s, c) = (1.1 * i as f64 + 0.1 * (i * i) as f64).sin_cos();
        p(2.0 * c + 0.3 * i as f64, s, 0.4 * c)
    };
    let tip = |i: usize| if i < 5 { p(0.4, 0.1, 0.2) } else { p(1.0, -0.5, 0.3) };
    let m = Manipulator::from_legs(std::array::from_fn(|i| Leg { base: base(i), platform: tip(i) })).unwrap();
    let s = some_pose().squared_lengths(&m).unwrap();
    let found = self_motion(&m, &s, &[some_pose()], &MotionOptions::default());
    assert!(found.dimension() == Some(2) && found.curves.is_empty(), "{:?}", found.at_pose);
}

#[test]
fn crossing_curves_are_all_followed() {
    // a planar pose of a symmetric platform is often on two curves, such as the home of the midline platform with equal
    // legs
    let m = midline();
    let home = default_home(&m);
    let s = home.squared_lengths(&m).unwrap();
    let found = self_motion(&m, &s, &[home], &MotionOptions::default());
    assert!(found.dimension() >= Some(1), "{:?}", found.at_pose);
    for c in &found.curves {
        assert!(c.end != CurveEnd::Unfinished);
    }
}

/// Singular poses between poses of opposite sign have one freedom of first order, which the legs stop; none of them is
/// classified as moving.
#[test]
fn singular_poses_of_random_designs_are_proved_to_be_isolated() {
    let mut rng = Rng::new(11);
    let (mut proved, mut all) = (0, 0);
    while all < 12 {
        let mut point = || Point3::new(rng.normal(), rng.normal(), rng.normal());
        let m = Manipulator::from_legs(std::array::from_fn(|_| Leg { base: point(), platform: point() }))
            .unwrap();
        let mut pose = || Pose {
            rotation: platform::geom::random_rotation(&mut rng),
            position: Vector3::from_fn(|_, _| rng.normal()),
        };
        let (from, to) = (pose(), pose());
        let signs = crate::singularity::signs_along(&m, &from, &to);
        let Some(change) = signs.changes().next() else { continue };
        let at = crate::singularity::between(&from, &to, 0.5 * (change.from + change.to));
        let found = motion_at(&m, &at, 1);
        all += 1;
        assert_eq!(found.tangent_dimension, 1, "{found:?}");
        proved += usize::from(matches!(found.verdict, PoseVerdict::Isolated { order: 2, .. }));
        assert!(!matches!(found.verdict, PoseVerdict::Moves { .. }), "{found:?}");
        // the random pose itself is held to first order
        assert!(matches!(motion_at(&m, &from, 1).verdict, PoseVerdict::Isolated { order: 1, .. }));
    }
    assert!(proved >= 11, "{proved} of {all}");
}

/// Six equal parallel legs: translations on a sphere, with an additional freedom of first order at each pose.
#[test]
fn the_freedoms_of_first_order_are_not_taken_for_the_motion() {
    let ends = [[0., 0., 0.], [1., 3., 0.], [2., -1., 1.], [3., 1., 2.], [5., 2., -1.], [-2., 4., 3.]];
    let m =
        Manipulator::from_legs(ends.map(|[x, y, z]| Leg { base: p(x, y, z), platform: p(x, y, z) })).unwrap();
    for position in [[0.0, 0.0, 2.0], [1.0, 1.0, 1.0]] {
        let pose = Pose { rotation: Rotation3::identity(), position: position.into() };
        let found = motion_at(&m, &pose, 1);
        let moves = PoseVerdict::Moves { dimension: 2, reach: 0.0, evidence: MotionEvidence::Traced };
        assert!(found.tangent_dimension == 3 && found.verdict.dimension() == moves.dimension(), "{found:?}");
    }
    // after a half turn the same legs hold it to second order
    let pose = Pose {
        rotation: Rotation3::from_euler_angles(0.0, 0.0, std::f64::consts::PI),
        position: Vector3::z() * 2.0,
    };
    assert_eq!(motion_at(&m, &pose, 1).verdict.dimension(), Some(0));
}

#[test]
#[ignore = "evidence"]
fn degree_of_the_motion_of_a_griffis_duffy_platform() {
    let m = midline();
    let pose = some_pose();
    let s = pose.squared_lengths(&m).unwrap();
    let (one, two) = (curve_degree(&m, &s, &pose, 1).unwrap(), curve_degree(&m, &s, &pose, 2).unwrap());
    assert!(one.complete && two.complete && one.degree == two.degree, "{one:?} {two:?}");
    assert_eq!(one.degree, 28);
}

/// Critical points find a real loop that is disjoint from the curve of the given pose.
#[test]
#[ignore = "evidence"]
fn every_real_component_is_found_from_one_complex_curve() {
    let m = midline();
    let pose = some_pose();
    let s = pose.squared_lengths(&m).unwrap();
    let found = critical_poses(&m, &s, &[pose.into()], 1);
    assert_eq!(found.components.iter().map(|c| c.degree).collect::<Vec<_>>(), [28]);
    assert_eq!(found.paths, 7 * 28);
    assert_eq!(found.regular + found.singular + found.no_pose + found.lost, found.paths);
    assert!(found.lost * 20 < found.paths && found.is_accounted() == (found.lost == 0), "{found:?}");
    // planar bodies: the mirror image of a motion in the base plane is another motion
    let curves = |poses: &[Pose]| self_motion(&m, &s, poses, &MotionOptions::default()).curves;
    let all = curves(&found.poses);
    assert!(all.len() >= 2 * curves(&[pose]).len(), "{}", all.len());
    assert!(all.iter().all(|c| c.end == CurveEnd::Closed || c.end == CurveEnd::Joined));
    // another linear function finds the same loops
    let other = critical_poses(&m, &s, &[pose.into()], 2);
    let lengths = |curves: &[MotionCurve]| {
        let mut l: Vec<f64> = curves.iter().map(|c| c.points.last().unwrap().arc).collect();
        l.sort_by(f64::total_cmp);
        l
    };
    let (one, two) = (lengths(&all), lengths(&curves(&other.poses)));
    assert_eq!(one.len(), two.len());
    assert!(one.iter().zip(&two).all(|(x, y)| (x - y).abs() < 0.1 * x), "{one:?} {two:?}");
}

#[test]
fn complex_poses_are_their_dual_quaternions() {
    let pose = some_pose();
    let y = critical::dual_quaternion(&pose.into(), 2.0);
    let expected = point(&pose, 2.0);
    let scale = expected[0] / y[0].re;
    let error = y.iter().zip(expected.iter()).map(|(z, x)| (z * scale - x).norm()).fold(0.0, f64::max);
    assert!(error < 1e-14, "{error}");
}
