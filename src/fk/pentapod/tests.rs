use nalgebra::Vector3;

use super::*;
use num::Rng;
use platform::pentapod::Pentapod;

/// Five legs from base points to marks on the x axis of the platform.
fn five(base: &[[f64; 3]; 5], marks: [f64; 5]) -> LinearPentapod {
    Pentapod::from_doubles(base, &marks.map(|x| [x, 0.0, 0.0])).unwrap().linear().unwrap()
}

/// The lengths at a place of the joint of leg 1 and a direction of unit length.
fn lengths_at(p: &LinearPentapod, position: Vector3<f64>, direction: Vector3<f64>) -> [f64; 5] {
    let length = nearest(&p.square()).sqrt();
    std::array::from_fn(|i| {
        let a = Vector3::from(p.others[i].each_ref().map(nearest));
        (position + direction * (length * nearest(&p.marks[i])) - a).norm()
    })
}

/// The place of the joint of leg 1 and the direction of a real pose.
fn real_parts(pose: &LinePose) -> [Vector3<f64>; 2] {
    [pose.position, pose.direction].map(|x| Vector3::from(x.map(|z| z.re)))
}

const PLANE: [[f64; 3]; 5] =
    [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 3.0, 0.0], [-1.0, 2.0, 0.0], [3.0, 2.0, 0.0]];

#[test]
fn classes_of_planes_are_those_of_the_closed_form_and_of_the_count() {
    let turned = PLANE.map(|[x, y, _]| [x + 1.0, 2.0 * y - x, 3.0 + x - y]); // another plane, not through the origin
    for (marks, class) in [
        ([0.0, 3.0, 1.0, 4.0, -2.0], LineClass::Quartic),
        // 1 + 2 x - y
        ([1.0, 5.0, 0.0, -3.0, 5.0], LineClass::Quadratic),
    ] {
        for base in [PLANE, turned] {
            let p = five(&base, marks);
            assert_eq!(line_class(&p), Some(class));
            for seed in 1..4 {
                assert_eq!(count_line_poses(&p, seed), Ok(class.poses()), "{class:?}");
            }
        }
    }
    // marks that are a linear fractional function of a, whose lines of equal mark are parallel
    let cubic = five(&PLANE, [0.5, 1.0 / 6.0, 0.2, 0.5, 1.0 / 8.0]);
    assert_ne!(line_class(&cubic), None);
    let exact = PLANE.map(|[x, _, _]| (1.0 + x) / (4.0 + x));
    let mut p = five(&PLANE, exact);
    for (mark, a) in p.marks.iter_mut().zip(&p.others) {
        *mark = (integer(1) + &a[0]) / (integer(4) + &a[0]);
    }
    // equal x, equal mark: joints 2 and 3 stay apart
    assert_eq!(line_class(&p), Some(LineClass::Cubic));
    assert_eq!(count_line_poses(&p, 1), Ok(6));
    let space = five(
        &[[0.0, 0.0, 1.0], [2.0, 0.5, 0.0], [1.0, 3.0, -1.0], [-1.0, 2.0, 2.0], [3.0, 2.0, 0.5]],
        [0.0, 3.0, 1.0, 4.0, -2.0],
    );
    assert_eq!(line_class(&space), Some(LineClass::Octic));
    assert_eq!(count_line_poses(&space, 1), Ok(8));
}

/// Lengths taken at a random pose give eight poses, that one among them, and every real one has the lengths.
fn taken_pose_is_found(seed: u64, planar: bool) {
    let mut rng = Rng::new(seed);
    let base = PLANE.map(|[x, y, _]| [x, y, if planar { 0.0 } else { rng.uniform(-1.0, 1.0) }]);
    let p = five(&base, [0.0, 3.0, 1.0, 4.0, -2.0]);
    let position = Vector3::from_fn(|_, _| rng.uniform(-3.0, 3.0));
    let direction = Vector3::from_fn(|_, _| rng.normal()).normalize();
    let l = lengths_at(&p, position, direction);
    let found = line_poses(&p, &l).unwrap();
    assert_eq!((found.counted, found.poses.len()), (8, 8));
    let real: Vec<_> = found.poses.iter().filter(|pose| pose.real).collect();
    assert_eq!(real.len() % 2, 0);
    for pose in &real {
        let [q, d] = real_parts(pose);
        assert!((d.norm() - 1.0).abs() < 1e-13);
        assert!(pose.error[0] < 1e-13 && pose.error[1] < 1e-13, "{:?}", pose.error);
        let again = lengths_at(&p, q, d);
        assert!(l.iter().zip(again).all(|(x, y)| (x - y).abs() < 1e-12), "{l:?} {again:?}");
    }
    let near = |pose: &&LinePose| {
        let [q, d] = real_parts(pose);
        (q - position).norm() + (d - direction).norm() < 1e-9
    };
    assert_eq!(real.into_iter().filter(near).count(), 1);
}

#[test]
fn the_pose_that_the_lengths_were_taken_at_is_among_those_of_a_planar_base() {
    (3..5).for_each(|seed| taken_pose_is_found(seed, true));
}

#[test]
fn the_pose_that_the_lengths_were_taken_at_is_among_those_of_a_base_in_space() {
    taken_pose_is_found(5, false);
}

#[test]
fn dependent_legs_hold_no_line() {
    // marks and joints on two lines; five legs from one joint
    let line = five(&[0.0, 1.0, 2.0, 4.0, 7.0].map(|x| [x, x, 0.0]), [0.0, 3.0, 1.0, 4.0, -2.0]);
    assert_eq!(line_class(&line), None);
    assert_eq!(line_poses(&line, &[3.0; 5]), Err(NoLinePoses::Dependent));
}
