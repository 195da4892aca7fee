use super::super::FkRoot;
use super::*;
use nalgebra::{Matrix3, Point3, Rotation3, Vector3};
use num::Rng;
use platform::geom::{Pose, random_rotation};
use platform::manipulator::Leg;

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

/// With the platform in the plane of the base a pose is its own mirror image. The leg equations are even in the three
/// directions out of that plane. All numbers are dyadic, so that the root is exactly eightfold.
#[test]
#[ignore = "evidence"]
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

/// The same certified poses, however they were found.
fn same_roots(m: &Manipulator, a: &FkSolutions, b: &FkSolutions) -> bool {
    let partner = |r: &FkRoot| {
        let spread = r.pose.rotation.iter().map(|z| z.norm()).fold(1.0, f64::max);
        let near = |q: &&FkRoot| q.pose.distance(&r.pose, m.size()) < 1e-6 * spread;
        b.roots.iter().filter(near).map(|q| (q.reality, q.certified())).collect::<Vec<_>>()
    };
    a.roots.len() == b.roots.len() && a.roots.iter().all(|r| partner(r) == [(r.reality, r.certified())])
}

/// Prepared and unprepared answers for lengths of random poses; how many were paths in the lengths alone.
fn compared(m: &Manipulator, rng: &mut Rng, rows: usize) -> usize {
    let o = FkOptions::default();
    let prepared = PreparedHomotopy::new(m, &o).unwrap();
    let mut followed = 0;
    for row in 0..rows {
        let s = lengths(m, rng);
        let (one, other) = (prepared.solve(&s, &o).unwrap(), Homotopy.solve(m, &s, &o).unwrap());
        assert!(one.is_complete() && same_roots(m, &one, &other), "row {row}: {}", one.completeness);
        followed += usize::from(prepared.whole(&s, &o).unwrap().is_some());
    }
    followed
}

#[test]
fn prepared_designs_have_the_poses_of_unprepared_ones() {
    let mut rng = Rng::new(80);
    let mut followed = 0;
    for k in 0..3 {
        let mut point = || Point3::from(Vector3::from_fn(|_, _| rng.uniform(-2.0, 2.0)));
        let mut legs = std::array::from_fn(|_| Leg { base: point(), platform: point() });
        // general, 32 poses, 16 poses of a joint with three legs
        if k > 0 {
            legs[1].platform = legs[0].platform;
            legs[3].platform = legs[2].platform;
        }
        if k > 1 {
            legs[5].platform = legs[4].platform;
        }
        followed += compared(&Manipulator::from_legs(legs).unwrap(), &mut rng, 4);
    }
    for tilt in [false, true] {
        let m = planar(&mut rng, tilt);
        followed += compared(&m, &mut rng, 4);
        assert_eq!(PreparedHomotopy::new(&m, &FkOptions::default()).unwrap().start.paths(), 20);
    }
    assert!(followed >= 18, "{followed} of 20 without the general treatment");
}

/// A Griffis-Duffy platform whose joints are doubles exactly: zigzag between two triangles, joints moved along the
/// edges.
fn griffis_duffy(rng: &mut Rng) -> Manipulator {
    let mut triangle = || {
        [(); 3]
            .map(|()| Point3::from(Vector3::from_fn(|_, _| (rng.uniform(-2.0, 2.0) * 256.0).round() / 256.0)))
    };
    let (b, p) = (triangle(), triangle());
    let pairs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    let legs = std::array::from_fn(|i| {
        let ((a, c), (a2, c2)) = (pairs[i], pairs[(i + 1) % 6]);
        let t = [0.25, 0.125, 0.375, 0.1875, 0.3125, 0.4375][i];
        Leg { base: b[a] + (b[a2] - b[a]) * t, platform: p[c] + (p[c2] - p[c]) * t }
    });
    Manipulator::from_legs(legs).unwrap()
}

#[test]
fn a_griffis_duffy_platform_takes_eight_paths_once_it_is_prepared() {
    let mut rng = Rng::new(81);
    let m = griffis_duffy(&mut rng);
    assert_eq!(compared(&m, &mut rng, 3), 3);
    let o = FkOptions::default();
    let found = PreparedHomotopy::new(&m, &o).unwrap().solve(&lengths(&m, &mut rng), &o).unwrap();
    // one for each pair of mirror images
    assert_eq!((found.paths.len(), found.roots.len()), (8, 16));
    assert!(
        found.paths.iter().all(|p| p.end == PathEnd::Finite && p.root.is_some() && p.mirror_root.is_some())
    );
    assert!(found.completeness.is_proved(), "{}", found.completeness);
}

/// With its joints rounded it is another platform, with poses far out that doubles do not see.
#[test]
fn a_start_that_is_not_known_to_be_whole_is_none() {
    let mut rng = Rng::new(82);
    let third = 1.0 / 3.0;
    let legs =
        griffis_duffy(&mut rng).legs().map(|l| Leg { base: l.base * third, platform: l.platform * third });
    let m = Manipulator::from_legs(legs).unwrap();
    assert!(Homotopy.prepare(&m, &FkOptions::default()).is_none());
    assert!(Homotopy.prepare(&m, &FkOptions::default().pose_count(PoseCounting::Never)).is_none());
    // four legs from one joint are dependent: generic lengths have no pose, special ones a curve
    let mut legs = m.legs();
    for k in 1..4 {
        legs[k].base = legs[0].base;
    }
    let again = Manipulator::from_legs(legs).unwrap();
    assert!(Homotopy.prepare(&again, &FkOptions::default()).is_none());
}

/// The answer is that of an unprepared solve when paths in the lengths lead to coinciding or missing poses.
#[test]
#[ignore = "evidence"]
fn special_lengths_get_the_general_treatment() {
    let mut rng = Rng::new(83);
    let m = planar(&mut rng, false);
    let flat = Pose {
        rotation: Rotation3::from_axis_angle(&Vector3::z_axis(), 0.3),
        position: Vector3::new(0.2, 0.1, 0.0),
    };
    let s = flat.squared_lengths(&m).unwrap();
    let o = FkOptions::default().pose_count(PoseCounting::Never);
    let prepared = PreparedHomotopy::new(&m, &o).unwrap();
    assert!(prepared.whole(&s, &o).unwrap().is_none());
    assert_eq!(prepared.solve(&s, &o).unwrap(), Homotopy.solve(&m, &s, &o).unwrap());
}

/// Legs with joints in whole numbers that are perpendicular to the velocities of one twist at the identity: the pose is
/// singular exactly.
fn exactly_singular(
    rng: &mut Rng,
    base: [usize; 6],
    platform: [usize; 6],
) -> Option<(Manipulator, SquaredLegLengths)> {
    let mut vector = |most: f64| Vector3::from_fn(|_, _| rng.uniform(-most, most).round());
    let (velocity, turn, position) = (vector(4.0), vector(4.0), vector(3.0) + Vector3::z() * 8.0);
    let joints: [Vector3<f64>; 6] = std::array::from_fn(|_| vector(6.0));
    let legs: [Vector3<f64>; 6] =
        std::array::from_fn(|i| (velocity + turn.cross(&joints[platform[i]])).cross(&vector(3.0)));
    let six = |i: usize| Leg {
        base: Point3::from(joints[platform[i]] + position - legs[base[i]]),
        platform: Point3::from(joints[platform[i]]),
    };
    let m = Manipulator::from_legs(std::array::from_fn(six)).ok()?;
    let s = Pose { rotation: Rotation3::identity(), position }.squared_lengths(&m)?;
    Some((m, s))
}

#[test]
fn simple_poses_and_a_proved_double_one_are_a_complete_answer() {
    let mut rng = Rng::new(0xdd);
    let own = [0, 1, 2, 3, 4, 5];
    let mut whole = 0;
    for k in 0..10 {
        let Some((m, s)) = exactly_singular(&mut rng, own, own) else { continue };
        let found = Homotopy.solve(&m, &s, &FkOptions::default()).unwrap();
        let double: Vec<&FkRoot> = found.roots.iter().filter(|r| r.multiplicity == 2).collect();
        if !found.completeness.is_proved() {
            continue;
        }
        whole += 1;
        assert_eq!((found.roots.len(), double.len(), found.certified_count()), (39, 1, 40), "{k}");
        assert!(double[0].certified() && double[0].reality == crate::Reality::Undecided);
        let identity = double[0].pose.rotation - Matrix3::identity();
        assert!(identity.iter().all(|z| z.norm() < 1e-9), "{k}");
    }
    assert!(whole >= 8, "{whole}");
}

/// Platforms with a mirror plane at symmetric poses, in whole numbers. An odd twist changes no length to first order.
/// So the equations along it are an odd function of its parameter, and the pose counts three times.
#[test]
#[ignore = "evidence"]
fn exact_triple_roots_are_proved_and_counted_three_times() {
    let mut rng = Rng::new(0x3001);
    let mut proved = 0;
    for round in 0..8 {
        let mut whole = |most: f64| rng.uniform(-most, most).round();
        let (velocity, turn) = (Vector3::x() * whole(4.0), Vector3::new(0.0, whole(4.0), whole(4.0)));
        let position = Vector3::new(0.0, whole(4.0), whole(4.0) + 9.0);
        let mut pair = || {
            let tip = Vector3::new(whole(6.0), whole(6.0), whole(6.0));
            let across = Vector3::new(whole(3.0), whole(3.0), whole(3.0));
            let leg = (velocity + turn.cross(&tip)).cross(&across);
            let mirrored = |v: Vector3<f64>| Vector3::new(-v.x, v.y, v.z);
            [(tip, leg), (mirrored(tip), mirrored(leg))]
        };
        let legs = [pair(), pair(), pair()].concat();
        if legs.iter().any(|(tip, leg)| leg.norm() < 0.5 || tip.x.abs() < 0.5) {
            continue;
        }
        let base: [Point3<f64>; 6] = std::array::from_fn(|i| Point3::from(legs[i].0 + position - legs[i].1));
        let legs_of = std::array::from_fn(|i| Leg { base: base[i], platform: Point3::from(legs[i].0) });
        let m = Manipulator::from_legs(legs_of).unwrap();
        let s = SquaredLegLengths::try_new(std::array::from_fn(|i| legs[i].1.norm_squared())).unwrap();
        let found = Homotopy.solve(&m, &s, &FkOptions::default()).unwrap();
        let triple: Vec<_> = found.roots.iter().filter(|r| r.multiplicity == 3).collect();
        for root in &triple {
            assert!(root.certified(), "{round}");
            let off =
                root.pose.position.iter().zip(&position).map(|(z, p)| (z - p).norm()).fold(0.0, f64::max);
            assert!(off < 1e-6 * m.size(), "{round}: {off:e}");
        }
        // 33 simple ones and the triple one; the number is that of the algebra, which shares nothing with certificates
        let whole = found.is_complete() && triple.len() == 1;
        assert!(!whole || found.certified_count() == found.roots.len() + 2, "{round}");
        proved += usize::from(whole);
    }
    assert!(proved >= 6, "{proved}");
}

/// Three pairs of legs that exchange their ends have equal lengths at half-turns, so the platform moves about almost
/// every line (Borel, Bricard). Rounded lengths leave isolated poses, which only more bits than doubles certify.
fn line_symmetric() -> (Manipulator, SquaredLegLengths) {
    let joints = [
        [1., 45., -36.],
        [45., -19., -8.],
        [33., -9., 5.],
        [-47., 25., 4.],
        [-17., 29., -20.],
        [-5., -37., -10.],
    ]
    .map(Point3::from);
    let legs = std::array::from_fn(|i| Leg { base: joints[i], platform: joints[(i + 3) % 6] });
    let m = Manipulator::from_legs(legs).unwrap();
    let lengths = [
        140.8432331584681,
        85.08627074556597,
        52.88204046821219,
        140.8432331584681,
        85.08627074556597,
        52.8820404682122,
    ];
    let s = platform::manipulator::LegLengths::try_new(lengths).unwrap().squared();
    (m, s)
}

#[test]
#[ignore = "evidence"]
fn rounded_lengths_of_a_line_symmetric_motion_are_said_to_move() {
    let (m, s) = line_symmetric();
    let found = Homotopy.solve(&m, &s, &FkOptions::default()).unwrap();
    assert!(
        matches!(found.solution_set, SolutionSet::PositiveDimensional { .. }),
        "{:?}",
        found.completeness
    );
    assert!(!found.is_complete());
}

/// Ends that doubles cannot certify tell rounded lengths of a motion from those of a general pose.
#[test]
fn uncertified_ends_on_a_curve_are_a_motion_within_rounding() {
    let (m, s) = line_symmetric();
    let o = FkOptions { pose_count: PoseCounting::Never, ..FkOptions::default() };
    let general = lengths(&m, &mut Rng::new(3));
    for (s, moves) in [(s, true), (general, false)] {
        let found = generic(&m, &s);
        let moving = moving_within_rounding(Some(found), &m, &s, None, &o);
        assert_eq!(moving.is_some(), moves);
    }
    assert!(moving_within_rounding(None, &m, &s, None, &o).is_none());
}
