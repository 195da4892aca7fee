use super::*;
use crate::{Homotopy, Reality};
use nalgebra::{Matrix6, Point3};
use num::Rng;
use platform::geom::{ComplexPose, random_rotation};
use platform::manipulator::{Leg, default_home};

fn hexapod(rng: &mut Rng) -> Manipulator {
    let mut point = |r: f64| Point3::new(r * rng.normal(), r * rng.normal(), 0.3 * rng.normal());
    Manipulator::from_legs(std::array::from_fn(|_| Leg { base: point(2.0), platform: point(1.0) })).unwrap()
}

fn moved(pose: &Pose, rng: &mut Rng, size: f64) -> Pose {
    let turn = Vector3::from_fn(|_, _| size * rng.normal());
    let shift = Vector3::from_fn(|_, _| size * rng.normal());
    Pose { rotation: Rotation3::new(turn) * pose.rotation, position: pose.position + shift }
}

fn gap(m: &Manipulator, a: &Pose, b: &Pose) -> f64 {
    ComplexPose::from(*a).distance(&ComplexPose::from(*b), m.size())
}

fn determinant(m: &Manipulator, pose: &Pose) -> f64 {
    let j: Matrix6<f64> = platform::manipulator::plucker_matrix(m, pose, m.platform_rms_radius());
    j.determinant()
}

/// A start far from singular poses: small moves from it pass none.
fn regular_start(m: &Manipulator, rng: &mut Rng) -> Pose {
    loop {
        let pose = moved(&default_home(m), rng, 0.3);
        let s = pose.squared_lengths(m).unwrap();
        if NearSolver::new(m).solve(&s, &pose).evidence().frobenius_ratio > 0.02 {
            return pose;
        }
    }
}

#[test]
fn small_moves_are_recovered_in_one_segment() {
    let mut rng = Rng::new(1);
    let mut single = 0;
    for case in 0..200 {
        let m = hexapod(&mut rng);
        let start = regular_start(&m, &mut rng);
        let goal = moved(&start, &mut rng, 2e-4);
        let outcome = NearSolver::new(&m).solve(&goal.squared_lengths(&m).unwrap(), &start);
        let pose = outcome.tracked().unwrap_or_else(|| panic!("case {case}: {outcome:?}"));
        assert!(gap(&m, pose, &goal) < 1e-11, "case {case}: {}", gap(&m, pose, &goal));
        let e = outcome.evidence();
        assert!(e.residual < 1e-13 && e.kantorovich < 1.0 && e.newton_steps <= 4, "case {case}: {e:?}");
        assert!(e.distance > 0.0 && e.angle > 0.0 && e.angle < 0.01);
        single += u32::from(e.segments == 1);
    }
    assert!(single > 150, "{single} of 200 in one segment");
}

#[test]
fn the_start_itself_takes_no_step() {
    let mut rng = Rng::new(2);
    let m = hexapod(&mut rng);
    let start = regular_start(&m, &mut rng);
    let outcome = NearSolver::new(&m).solve(&start.squared_lengths(&m).unwrap(), &start);
    let NearOutcome::Tracked { pose, evidence } = outcome else { panic!("{outcome:?}") };
    assert!(gap(&m, &pose, &start) < 1e-13 && evidence.newton_steps <= 1 && evidence.segments == 1);
}

#[test]
fn the_pose_is_one_of_those_the_general_solver_finds() {
    for k in 0..4 {
        let mut rng = Rng::stream(3, k);
        let m = hexapod(&mut rng);
        let start = regular_start(&m, &mut rng);
        let s = moved(&start, &mut rng, 1e-3).squared_lengths(&m).unwrap();
        let outcome = NearSolver::new(&m).solve(&s, &start);
        let pose = ComplexPose::from(*outcome.tracked().unwrap());
        let all = Homotopy.solve(&m, &s, &FkOptions::default()).unwrap();
        let real = all.roots.iter().filter(|r| r.reality == Reality::Real);
        let near = real.map(|r| r.pose.distance(&pose, m.size())).fold(f64::MAX, f64::min);
        assert!(near < 1e-9, "{near}");
    }
}

#[test]
fn rigid_motions_scale_and_leg_order_change_nothing() {
    let mut rng = Rng::new(4);
    for _ in 0..20 {
        let m = hexapod(&mut rng);
        let start = regular_start(&m, &mut rng);
        let goal = moved(&start, &mut rng, 0.02);
        let plain = NearSolver::new(&m).solve(&goal.squared_lengths(&m).unwrap(), &start);
        let (r, q) = (random_rotation(&mut rng), random_rotation(&mut rng));
        let (t, u) = (Vector3::from_fn(|_, _| rng.normal()), Vector3::from_fn(|_, _| rng.normal()));
        let scale = 1000.0;
        let there =
            |p: &Point3<f64>, r: &Rotation3<f64>, t: &Vector3<f64>| Point3::from((r * p.coords + t) * scale);
        let legs =
            m.legs().map(|l| Leg { base: there(&l.base, &r, &t), platform: there(&l.platform, &q, &u) });
        let m2 = Manipulator::from_legs(legs).unwrap().reordered([3, 1, 5, 0, 2, 4]).unwrap();
        let carry = |p: &Pose| {
            let rotation = r * p.rotation * q.inverse();
            Pose { rotation, position: (r * p.position + t - rotation * u) * scale }
        };
        let s = carry(&goal).squared_lengths(&m2).unwrap();
        let other = NearSolver::new(&m2).solve(&s, &carry(&start));
        assert_eq!(plain.name(), other.name());
        let (a, b) = (plain.evidence(), other.evidence());
        assert_eq!((a.segments, a.newton_steps), (b.segments, b.newton_steps));
        assert!((a.frobenius_ratio / b.frobenius_ratio - 1.0).abs() < 1e-8);
        assert!((a.distance * scale - b.distance).abs() < 1e-8 * scale && (a.angle - b.angle).abs() < 1e-8);
        assert!(gap(&m2, &carry(plain.pose()), other.pose()) < 1e-9);
    }
}

#[test]
fn a_closed_trajectory_of_a_thousand_steps_returns_to_its_start() {
    let mut rng = Rng::new(5);
    let m = hexapod(&mut rng);
    let start = regular_start(&m, &mut rng);
    let solver = NearSolver::new(&m);
    let (mut pose, mut worst) = (start, 0.0_f64);
    for k in 1..=1000 {
        let (sine, cosine) = (std::f64::consts::TAU * f64::from(k) / 1000.0).sin_cos();
        let turn = Vector3::new(0.03 * sine, 0.02 * (1.0 - cosine), 0.0);
        let shift = Vector3::new(0.03 * (1.0 - cosine), 0.04 * sine, 0.02 * sine * cosine);
        let goal = Pose { rotation: Rotation3::new(turn) * start.rotation, position: start.position + shift };
        let outcome = solver.solve(&goal.squared_lengths(&m).unwrap(), &pose);
        pose = *outcome.tracked().unwrap_or_else(|| panic!("step {k}: {outcome:?}"));
        worst = worst.max(gap(&m, &pose, &goal));
    }
    assert!(worst < 1e-11, "{worst}");
    assert!(gap(&m, &pose, &start) < 1e-12);
}

/// A fold: lengths move until two real poses meet and part as complex ones. The outcome must say so.
#[test]
fn a_way_through_a_singularity_ends_before_it() {
    let mut rng = Rng::new(6);
    let mut stopped = 0;
    for _ in 0..60 {
        let m = hexapod(&mut rng);
        let start = regular_start(&m, &mut rng);
        let goal = moved(&start, &mut rng, 1.0);
        let crossed = determinant(&m, &start) * determinant(&m, &goal) < 0.0;
        let outcome = NearSolver::new(&m).solve(&goal.squared_lengths(&m).unwrap(), &start);
        assert!(determinant(&m, &start) * determinant(&m, outcome.pose()) > 0.0, "the sheet was left");
        if crossed {
            let same = outcome.tracked().is_some_and(|p| gap(&m, p, &goal) < 1e-6);
            assert!(!same, "arrived on the other side of a singularity: {outcome:?}");
        }
        if let NearOutcome::NearSingularity { pose, fraction, evidence } = outcome {
            stopped += 1;
            assert!((0.0..1.0).contains(&fraction) && evidence.frobenius_ratio < 1e-5, "{evidence:?}");
            // the pose stopped at lies on the straight line of squared lengths
            let (from, to) =
                (start.squared_lengths(&m).unwrap().get(), goal.squared_lengths(&m).unwrap().get());
            for (i, s) in pose.squared_lengths(&m).unwrap().get().iter().enumerate() {
                let line = from[i] + fraction * (to[i] - from[i]);
                assert!((s - line).abs() < 1e-9 * m.size().powi(2), "leg {i}: {s} {line}");
            }
        }
    }
    assert!(stopped >= 8, "only {stopped} singular paths were met");
}

/// Negative control: Newton's method from the same starts does change its sheet.
#[test]
fn plain_newton_jumps_where_this_does_not() {
    let mut rng = Rng::new(7);
    let (mut newton_jumps, mut near_jumps, mut tracked) = (0, 0, 0);
    for _ in 0..150 {
        let m = hexapod(&mut rng);
        let start = regular_start(&m, &mut rng);
        let s = moved(&start, &mut rng, 0.7).squared_lengths(&m).unwrap();
        let solver = NearSolver::new(&m);
        let jumped = |p: &Pose| determinant(&m, p) * determinant(&m, &start) < 0.0;
        if let Some(p) = solver.solve(&s, &start).tracked() {
            tracked += 1;
            near_jumps += u32::from(jumped(p));
        }
        let target = s.get().map(|s| s / (solver.unit * solver.unit));
        let mut place = solver.place_of(&start);
        for _ in 0..50 {
            if let Some(newton) = LegDefects::at(&solver, &place, &target).newton() {
                place = newton.applied_to(&place);
            }
        }
        let converged = LegDefects::at(&solver, &place, &target).largest_defect() < 1e-12;
        newton_jumps += u32::from(converged && jumped(&solver.pose_of(&place)));
    }
    assert_eq!(near_jumps, 0);
    assert!(newton_jumps >= 5 && tracked >= 30, "{newton_jumps} {tracked}");
}

#[test]
fn few_segments_allowed_is_lost_and_says_where() {
    let mut rng = Rng::new(8);
    let m = hexapod(&mut rng);
    let start = regular_start(&m, &mut rng);
    let s = moved(&start, &mut rng, 0.1).squared_lengths(&m).unwrap();
    let free = NearSolver::new(&m).solve(&s, &start);
    assert!(free.tracked().is_some() && free.evidence().segments > 2, "{free:?}");
    let options = NearOptions { segments: 2, ..NearOptions::default() };
    let outcome = NearSolver::with_options(&m, options).solve(&s, &start);
    let NearOutcome::Lost { reason: WhyLost::SegmentsExhausted, fraction, evidence, .. } = outcome else {
        panic!("{outcome:?}")
    };
    assert!(fraction > 0.0 && fraction < 1.0 && evidence.segments == 2 && evidence.residual > 0.0);
}

#[test]
fn singular_starts_and_starts_that_are_no_poses() {
    // equal parallel planar hexagons at zero turn: singular, whatever the lengths
    let hexagon = |k: usize, r: f64| {
        let t = std::f64::consts::FRAC_PI_3 * k as f64;
        Point3::new(r * t.cos(), r * t.sin(), 0.0)
    };
    let m = Manipulator::from_legs(std::array::from_fn(|k| Leg {
        base: hexagon(k, 1.0),
        platform: hexagon(k, 1.0),
    }))
    .unwrap();
    let start = Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, 1.0) };
    let s = start.squared_lengths(&m).unwrap();
    let outcome = NearSolver::new(&m).solve(&s, &start);
    assert!(matches!(outcome, NearOutcome::NearSingularity { .. }), "{outcome:?}");
    let nan = Pose { position: Vector3::new(f64::NAN, 0.0, 0.0), ..start };
    let outcome = NearSolver::new(&m).solve(&s, &nan);
    assert!(matches!(outcome, NearOutcome::Lost { reason: WhyLost::StartIsNoPose, .. }));
}

#[test]
fn squares_of_which_nothing_is_known_are_not_reached() {
    let mut rng = Rng::new(11);
    let m = hexapod(&mut rng);
    let start = regular_start(&m, &mut rng);
    let squares = start.squared_lengths(&m).unwrap();
    let unknown = SquaredLegLengths::try_within(squares.middle(), [f64::INFINITY; 6]).unwrap();
    assert!(NearSolver::new(&m).solve(&unknown, &start).tracked().is_none());
    assert!(NearSolver::new(&m).solve(&squares, &start).tracked().is_some());
}

#[test]
fn as_a_general_method_it_does_not_apply() {
    let mut rng = Rng::new(9);
    let m = hexapod(&mut rng);
    let s = SquaredLegLengths::try_new([1.0; 6]).unwrap();
    let error = crate::solver(Some(Method::Near)).solve(&m, &s, &FkOptions::default()).unwrap_err();
    assert!(matches!(error, FkError::NotApplicable { method: Method::Near, .. }));
}
