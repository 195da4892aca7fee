use super::*;
use crate::Homotopy;
use nalgebra::Point3;
use num::Rng;
use platform::geom::{Pose, random_rotation};
use platform::manipulator::LegLengths;

/// Rojas, Borras, Thomas, sec. 6.
fn published() -> (Manipulator, SquaredLegLengths) {
    let base = vec![Point3::origin(), Point3::new(6.0, 108f64.sqrt(), 0.0), Point3::new(12.0, 0.0, 0.0)];
    let platform = vec![Point3::origin(), Point3::new(3.0, 27f64.sqrt(), 0.0), Point3::new(6.0, 0.0, 0.0)];
    let legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    let lengths = LegLengths::try_new([19.8, 18.0, 18.0, 17.0, 14.9, 17.8]).unwrap();
    (Manipulator::try_new(base, platform, legs).unwrap(), lengths.squared())
}

#[test]
fn the_published_octic_roots() {
    let (m, s) = published();
    let c = octic(&m, &s).unwrap().map(Complex64::from);
    let found = roots(&c).unwrap();
    let expected = [269.2450856, 328.7364309, 359.5275017, 463.5657697, 497.902151, 513.0332445];
    for x in expected.map(Complex64::from).into_iter().chain([Complex64::new(284.616753, 116.2085133)]) {
        let near = found.iter().map(|z| (z - x).norm()).fold(f64::MAX, f64::min);
        assert!(near < 1e-5, "{x}: {near}");
    }
}

#[test]
fn sixteen_published_poses_of_which_twelve_are_real() {
    let (m, s) = published();
    let found = Octic.solve(&m, &s, &FkOptions::default()).unwrap();
    assert_eq!(found.roots.len(), 16);
    assert_eq!(found.assembly_modes().count(), 12);
    assert!(found.all_accounted());
    assert!(found.roots.iter().all(|r| r.residual < 1e-12));
}

#[test]
fn random_octahedral_platforms_agree_with_the_general_solver() {
    for k in 0..15 {
        let mut rng = Rng::stream(21, k);
        let mut triangle =
            || (0..3).map(|_| Point3::from(Vector3::from_fn(|_, _| rng.uniform(-1.0, 1.0)))).collect();
        let (base, platform) = (triangle(), triangle());
        let m =
            Manipulator::try_new(base, platform, [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)]).unwrap();
        let m = m.reordered([3, 5, 0, 1, 4, 2]).unwrap();
        let position = Vector3::from_fn(|_, _| rng.normal());
        let pose = Pose { rotation: random_rotation(&mut rng), position };
        let s = pose.squared_lengths(&m).unwrap();
        let a = Octic.solve(&m, &s, &FkOptions::default()).unwrap();
        let b = Homotopy.solve(&m, &s, &FkOptions::default()).unwrap();
        assert_eq!((a.roots.len(), b.roots.len()), (16, 16), "case {k}: {:?}", a.completeness);
        for r in &a.roots {
            let near = b.roots.iter().map(|q| q.pose.distance(&r.pose, m.size())).fold(f64::MAX, f64::min);
            assert!(near < 1e-8, "case {k}: {near}");
        }
        let truth = ComplexPose::from(pose);
        assert!(a.roots.iter().any(|r| r.pose.distance(&truth, m.size()) < 1e-9));
    }
}

/// Random octahedral design in another leg order, with the lengths of a random pose.
fn random(k: u64) -> (Manipulator, Pose, SquaredLegLengths) {
    let mut rng = Rng::stream(22, k);
    let mut triangle =
        || (0..3).map(|_| Point3::from(Vector3::from_fn(|_, _| rng.uniform(-1.0, 1.0)))).collect();
    let legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    let m = Manipulator::try_new(triangle(), triangle(), legs).unwrap();
    let m = m.reordered([3, 5, 0, 1, 4, 2]).unwrap();
    let position = Vector3::from_fn(|_, _| rng.normal());
    let pose = Pose { rotation: random_rotation(&mut rng), position };
    let s = pose.squared_lengths(&m).unwrap();
    (m, pose, s)
}

#[test]
fn the_fast_solver_finds_the_pose_the_lengths_came_from_and_agrees_with_the_general_treatment() {
    let mut regular = 0;
    for k in 0..200 {
        let (m, pose, s) = random(k);
        let solver = OcticSolver::new(&m).unwrap();
        let Some(found) = solver.solve(&s) else { continue };
        regular += 1;
        let truth = ComplexPose::from(pose);
        assert!(found.poses.iter().any(|p| p.distance(&truth, m.size()) < 1e-8), "case {k}");
        assert!(found.residual <= 1e-12);
        for p in &found.poses {
            let scale = p.rotation.iter().chain(&p.position).map(|z| z.norm()).fold(1.0, f64::max);
            assert!(p.residual(&m, &s) < 1e-11 * scale * scale, "case {k}: {}", p.residual(&m, &s));
        }
        for (pair, [x, y]) in found.pairs.iter().enumerate() {
            let legs = Octahedral::recognise(&m).unwrap();
            let (base, platform) = (legs.base(), legs.platform());
            let square = |pose: &ComplexPose, i: usize, j: usize| {
                pose.squared_length(&Leg { base: base[i], platform: platform[j] })
            };
            for pose in &found.poses[2 * pair..2 * pair + 2] {
                assert!((square(pose, 0, 1) - x).norm() < 1e-6 * (1.0 + x.norm() + y.norm()), "case {k}");
                assert!((square(pose, 2, 0) - y).norm() < 1e-6 * (1.0 + x.norm() + y.norm()), "case {k}");
            }
        }
        let (slow, count, unplaced) = solver.problem(&s).candidates().unwrap();
        assert_eq!((count, unplaced), (8, 0), "case {k}");
        for c in &slow {
            let near = |p: &ComplexPose| p.distance(&c.pose, m.size());
            let scale = c.pose.rotation.iter().chain(&c.pose.position).map(|z| z.norm()).fold(1.0, f64::max);
            assert!(found.poses.iter().map(near).fold(f64::MAX, f64::min) < 1e-5 * scale, "case {k}");
        }
    }
    assert!(regular >= 190, "{regular} of 200 without the general treatment");
}

/// Negative control: the mirror images are not the pose itself, and a corrupted length is noticed by the residual.
#[test]
fn mirror_images_differ_and_other_lengths_do_not_fit() {
    let (m, s) = published();
    let found = OcticSolver::new(&m).unwrap().solve(&s).unwrap();
    for pair in found.poses.chunks(2) {
        assert!(pair[0].distance(&pair[1], m.size()) > 1e-3);
    }
    let mut other = s.get();
    other[2] *= 1.0 + 1e-6;
    let other = SquaredLegLengths::try_new(other).unwrap();
    assert!(found.poses.iter().all(|p| p.residual(&m, &other) > 1e-8));
}

#[test]
fn coinciding_roots_are_left_to_the_general_treatment() {
    // flat: all corners in one plane, so that both mirror images coincide
    let legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    let t = |r: f64| vec![Point3::new(r, 0.0, 0.0), Point3::new(-r, r, 0.0), Point3::new(-r, -r, 0.0)];
    let m = Manipulator::try_new(t(2.0), t(1.0), legs).unwrap();
    let flat = Pose { rotation: nalgebra::Rotation3::identity(), position: Vector3::new(0.1, 0.2, 0.0) };
    let s = flat.squared_lengths(&m).unwrap();
    assert!(OcticSolver::new(&m).unwrap().solve(&s).is_none());
    assert!(!Octic.solve(&m, &s, &FkOptions::default()).unwrap().all_accounted());
}

#[test]
fn refuses_platforms_that_are_not_octahedral() {
    let mut rng = Rng::new(4);
    let legs = std::array::from_fn(|_| {
        let mut p = || Point3::from(Vector3::from_fn(|_, _| rng.normal()));
        Leg { base: p(), platform: p() }
    });
    let m = Manipulator::from_legs(legs).unwrap();
    let s = SquaredLegLengths::try_new([1.0; 6]).unwrap();
    let error = Octic.solve(&m, &s, &FkOptions::default()).unwrap_err();
    assert!(matches!(error, FkError::NotApplicable { method: Method::Octic, .. }));
}

/// Base triangle, and as platform the triangle of the midpoints of its sides times `ratio`. Sides are parallel, and
/// legs lead from the ends of a side to the corner at its middle.
fn parallel(triangle: [Point3<f64>; 3], ratio: f64) -> Manipulator {
    let middle = |i: usize, j: usize| Point3::from((triangle[i].coords + triangle[j].coords) * (0.5 * ratio));
    let platform = vec![middle(0, 1), middle(1, 2), middle(2, 0)];
    Manipulator::try_new(triangle.to_vec(), platform, [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)])
        .unwrap()
}

/// Sixteen proved poses by the octic, the same as those of the general solver; `pose` is one of them.
fn proved_by_the_octic(m: &Manipulator, pose: &Pose, compare: bool) {
    let s = pose.squared_lengths(m).unwrap();
    let o = FkOptions::default();
    let found = Octic.solve(m, &s, &o).unwrap();
    assert!(OcticSolver::new(m).unwrap().solve(&s).is_some(), "without the general treatment");
    assert!(found.completeness.is_proved() && found.roots.len() == 16, "{}", found.completeness);
    let distance = |p: &ComplexPose, q: &ComplexPose| p.distance(q, m.size()) / pose_scale(p, m.size());
    let near = |p: &ComplexPose| found.roots.iter().map(|r| distance(&r.pose, p)).fold(f64::MAX, f64::min);
    assert!(near(&ComplexPose::from(*pose)) < 1e-9);
    if compare {
        let general = Homotopy.solve(m, &s, &o).unwrap();
        assert_eq!(general.roots.len(), 16);
        assert!(general.roots.iter().all(|r| near(&r.pose) < 1e-6));
    }
}

#[test]
fn at_home_and_at_pure_translations_the_octic_finds_all_sixteen() {
    let h = 108f64.sqrt();
    let equilateral = [Point3::origin(), Point3::new(6.0, h, 0.0), Point3::new(12.0, 0.0, 0.0)];
    let scalene = [Point3::new(0.3, -1.0, 0.0), Point3::new(4.0, 5.5, 0.0), Point3::new(9.0, -2.0, 0.0)];
    let tilted = scalene.map(|p| random_rotation(&mut Rng::new(3)) * p + Vector3::new(1.0, 2.0, -3.0));
    let mut rng = Rng::new(26);
    for (triangle, ratio) in
        [(equilateral, 1.0), (equilateral, 0.7), (scalene, 1.0), (scalene, 1.3), (tilted, 0.8)]
    {
        let m = parallel(triangle, ratio);
        let normal = (triangle[1] - triangle[0]).cross(&(triangle[2] - triangle[0])).normalize();
        let centre = triangle.iter().map(|p| p.coords).sum::<Vector3<f64>>() * ((1.0 - ratio) / 3.0);
        for k in 0..12 {
            let off = if k == 0 { Vector3::zeros() } else { Vector3::from_fn(|_, _| rng.uniform(-2.0, 2.0)) };
            let rotation = nalgebra::Rotation3::identity();
            let position = centre + normal * 13.0 + off;
            proved_by_the_octic(&m, &Pose { rotation, position }, k < 2);
            // nearly so, too
            let rotation = nalgebra::Rotation3::new(Vector3::new(0.3, -0.5, 0.4) * 10f64.powi(-k));
            proved_by_the_octic(&m, &Pose { rotation, position }, false);
        }
    }
}
