use super::super::FkRoot;
use super::*;
use crate::geom::{Pose, random_rotation};
use crate::manipulator::Leg;
use crate::num::Rng;
use nalgebra::{Matrix3, Point3, Rotation3, Vector3};

/// Doubly planar joints in `z = 0`, or in two planes somewhere.
fn planar(rng: &mut Rng, tilt: bool) -> Manipulator {
    let mut body = || {
        let motion = (random_rotation(rng), Vector3::from_fn(|_, _| rng.normal()));
        let points: [Point3<f64>; 6] =
            std::array::from_fn(|_| Point3::new(rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0), 0.0));
        if tilt { points.map(|p| motion.0 * p + motion.1) } else { points }
    };
    let (base, platform) = (body(), body());
    Manipulator::from_legs(std::array::from_fn(|i| Leg { base: base[i], platform: platform[i] })).unwrap()
}

fn lengths(m: &Manipulator, rng: &mut Rng) -> SquaredLegLengths {
    let pose = Pose { rotation: random_rotation(rng), position: Vector3::from_fn(|_, _| rng.normal()) };
    pose.squared_lengths(m).unwrap()
}

fn generic(m: &Manipulator, s: &SquaredLegLengths) -> FkSolutions {
    let frame = ScaledFrames::of(m, s);
    let sections = frame.sections(m, s).unwrap();
    let problem = SectionProblem { sections, frame, kind: StartKind::Generic, fine: false };
    problem.solve(m, s, &FkOptions::default(), 5).unwrap().0
}

#[test]
fn twenty_paths_and_their_mirror_images_are_the_forty_poses() {
    let mut rng = Rng::new(77);
    for k in 0..12 {
        let m = planar(&mut rng, k % 2 == 0);
        let s = lengths(&m, &mut rng);
        let (twenty, forty) = (Homotopy.solve(&m, &s, &FkOptions::default()).unwrap(), generic(&m, &s));
        assert_eq!((twenty.paths.len(), forty.paths.len()), (20, 40));
        assert_eq!((twenty.roots.len(), forty.roots.len()), (40, 40), "problem {k}");
        assert!(twenty.all_accounted(), "problem {k}");
        for r in &twenty.roots {
            // far out poses have few digits
            let spread = r.pose.rotation.iter().map(|z| z.norm()).fold(1.0, f64::max);
            let near = |q: &&FkRoot| q.pose.distance(&r.pose, m.size()) < 1e-6 * spread;
            assert_eq!(forty.roots.iter().filter(near).count(), 1, "problem {k}");
        }
        let mut named: Vec<usize> =
            twenty.paths.iter().flat_map(|p| [p.root.unwrap(), p.mirror_root.unwrap()]).collect();
        named.sort_unstable();
        assert_eq!(named, (0..40).collect::<Vec<_>>());
        assert!(forty.paths.iter().all(|p| p.mirror_root.is_none()));
    }
}

/// Negative control: with one joint off the plane the mirror images are not poses.
#[test]
fn a_joint_off_the_plane_by_a_millionth_takes_forty_paths() {
    let mut rng = Rng::new(78);
    for tilt in [false, true] {
        let m = planar(&mut rng, tilt);
        let mut legs = m.legs();
        let normal = (legs[1].platform - legs[0].platform).cross(&(legs[2].platform - legs[0].platform));
        legs[3].platform += normal.normalize() * (1e-6 * m.size());
        let m = Manipulator::from_legs(legs).unwrap();
        let found = Homotopy.solve(&m, &lengths(&m, &mut rng), &FkOptions::default()).unwrap();
        assert_eq!((found.paths.len(), found.roots.len()), (40, 40));
        assert!(found.paths.iter().all(|p| p.mirror_root.is_none()));
        assert!(found.roots.iter().all(FkRoot::certified));
    }
}

/// With the platform in the plane of the base a pose is its own mirror image, and the leg equations are even in
/// the three directions out of that plane. All numbers are dyadic, so that the root is exactly eightfold.
#[test]
fn a_flat_pose_is_named_as_eightfold_and_not_listed() {
    let mut rng = Rng::new(79);
    for _ in 0..3 {
        let mut point = || {
            let mut x = || (64.0 * rng.uniform(-2.0, 2.0)).round() / 64.0;
            Point3::new(x(), x(), 0.0)
        };
        let m = Manipulator::from_legs(std::array::from_fn(|_| Leg { base: point(), platform: point() }));
        let m = m.unwrap();
        let quarter = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
        let rotation = Rotation3::from_matrix_unchecked(quarter);
        let pose = Pose { rotation, position: Vector3::new(0.5, -0.25, 0.0) };
        let found = Homotopy.solve(&m, &pose.squared_lengths(&m).unwrap(), &FkOptions::default()).unwrap();
        let here = |r: &&FkRoot| r.pose.distance(&pose.into(), m.size()) < 1e-4;
        let flat: Vec<&FkRoot> = found.unproved.iter().filter(here).collect();
        assert_eq!((flat.len(), found.unproved.len()), (1, 1));
        assert_eq!((flat[0].multiplicity, flat[0].certified()), (8, false));
        assert_eq!((found.roots.len(), found.count_with_multiplicity()), (32, 32));
        assert!(found.roots.iter().all(FkRoot::certified) && !found.all_accounted());
        assert_eq!(found.paths.iter().filter(|p| p.root == p.mirror_root).count(), 4);
    }
}
