//! Tests of the whole search on the 12-6 example.

use std::ops::ControlFlow;

use nalgebra::{Point3, Rotation3, Vector3};

use super::*;
use platform::geom::Pose;
use platform::manipulator::{Manipulator, Octahedral};

fn triangle(edge: f64) -> Vec<Point3<f64>> {
    let h = edge * 0.75f64.sqrt();
    vec![Point3::origin(), Point3::new(edge / 2.0, h, 0.0), Point3::new(edge, 0.0, 0.0)]
}

pub(super) fn example() -> Octahedral {
    let legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    let m = Manipulator::try_new(triangle(12.0), triangle(6.0), legs).unwrap();
    Octahedral::recognise(&m).unwrap()
}

/// Platform centroid above base centroid at height 15, rotated by `turn`, with small motions about it.
pub(super) fn poses_about(turn: f64, count: usize) -> Vec<Pose> {
    let centre = |edge: f64| Vector3::new(edge / 2.0, edge * 0.75f64.sqrt() / 3.0, 0.0);
    let grid = |k: usize| [0.0, 1.0, -1.0][k % 3];
    let pose = |k: usize| {
        let (a, b, c) = (grid(k), grid(k / 3), grid(k / 9));
        let tilt = 10f64.to_radians();
        let r = Rotation3::from_euler_angles(tilt * b, tilt * c, turn + tilt * a);
        Pose {
            rotation: r,
            position: centre(12.0) + Vector3::new(2.0 * a, 2.0 * b, 15.0 + 2.0 * c) - r * centre(6.0),
        }
    };
    (0..count).map(pose).collect()
}

pub(super) fn poses() -> Vec<Pose> {
    poses_about(0.7, 5)
}

/// Full size: 27 poses, 729 branches, 20,000 random feasible designs. `cargo test --release -- --ignored --nocapture
/// full_size`
#[test]
#[ignore = "takes a minute without optimisation"]
#[allow(clippy::print_stdout)]
fn full_size_search_is_not_beaten_by_twenty_thousand_random_designs() {
    for turn in [0.0, std::f64::consts::FRAC_PI_3, std::f64::consts::PI] {
        let p = OffsetProblem::with_defaults(example(), poses_about(turn, 27));
        let started = std::time::Instant::now();
        let r = optimize(&p, &OffsetSearchOptions::default(), &mut |_| ControlFlow::Continue(())).unwrap();
        println!("turn {turn:.3}: {:?}, {:?}", started.elapsed(), r.counts());
        let s = r.solution().unwrap();
        println!("{} {:?} {}", s.branch, s.offsets, s.recheck.objective);
        println!("{:?} {:?}, {} steps", s.recheck.margins, s.evidence, s.history.len());
        for &k in r.runners_up.iter().take(5) {
            println!("{} {:?}", r.branches[k].branch, r.branches[k].verdict);
        }
        assert!(matches!(r.outcome, OffsetOutcome::Optimal(_) | OffsetOutcome::LocalOptimum(_)));
        let mut rng = num::Rng::new(23);
        let (mut tried, mut greatest) = (0, 0.0f64);
        while tried < 20_000 {
            let t: [f64; 6] = std::array::from_fn(|_| rng.uniform(-1.0, 2.0));
            let near: [f64; 6] =
                std::array::from_fn(|i| (s.offsets[i] + 0.1 * rng.normal()).clamp(-1.0, 2.0));
            for t in [t, near] {
                let check = p.recheck(&t).unwrap();
                if check.margins.all_met() {
                    tried += 1;
                    greatest = greatest.max(check.objective);
                }
            }
        }
        println!("best of {tried} random feasible designs: {greatest}");
        assert!(greatest <= s.recheck.objective * (1.0 + 1e-6));
    }
}

/// Two zones of two offsets: four branches, small enough for an unoptimised build.
fn small_problem() -> OffsetProblem {
    let mut p = OffsetProblem::with_defaults(example(), poses());
    p.bounds = [(0.05, 0.95); 6];
    p.bounds[0] = (-0.6, 0.95);
    p.bounds[3] = (0.05, 1.6);
    p
}

fn quick() -> OffsetSearchOptions {
    OffsetSearchOptions {
        samples: 8,
        climbs: 2,
        polished: 3,
        starts: 3,
        boxes: 2000,
        ..OffsetSearchOptions::default()
    }
}

fn optimum(p: &OffsetProblem) -> OffsetSolution {
    let report = optimize(p, &quick(), &mut |_| ControlFlow::Continue(())).unwrap();
    match report.outcome {
        OffsetOutcome::Optimal(s) | OffsetOutcome::LocalOptimum(s) => *s,
        other => panic!("not optimal: {other:?}"),
    }
}

#[test]
fn random_feasible_designs_never_beat_the_optimum() {
    let p = small_problem();
    let best = optimum(&p);
    assert!(best.recheck.margins.all_met());
    let mut rng = num::Rng::new(17);
    let (mut tried, mut close) = (0, 0);
    while tried < 1500 {
        // half of them anywhere, half near the optimum
        let near = tried % 2 == 0;
        let t: [f64; 6] = std::array::from_fn(|i| {
            let (low, high) = p.bounds[i];
            if near {
                (best.offsets[i] + 0.02 * rng.normal()).clamp(low, high)
            } else {
                rng.uniform(low, high)
            }
        });
        let r = p.recheck(&t).unwrap();
        if !r.margins.all_met() {
            continue;
        }
        tried += 1;
        close += usize::from(r.objective > 0.9 * best.recheck.objective);
        assert!(r.objective <= best.recheck.objective * (1.0 + 1e-6), "{t:?} reaches {}", r.objective);
    }
    assert!(close > 100, "the sample comes close: {close}");
}

#[test]
fn same_answer_with_any_number_of_threads_and_other_seeds_find_the_same_optimum() {
    let p = small_problem();
    let run = |threads, seed| {
        optimize(&p, &OffsetSearchOptions { seed, threads, ..quick() }, &mut |_| ControlFlow::Continue(()))
            .unwrap()
    };
    let one = run(1, 1);
    assert_eq!(one, run(3, 1));
    let other = run(2, 99).solution().unwrap().recheck.objective;
    assert!((other / one.solution().unwrap().recheck.objective - 1.0).abs() < 1e-6);
}

#[test]
fn the_optimum_does_not_depend_on_units_or_frames() {
    let p = small_problem();
    let (k, shift) = (250.0, Vector3::new(3.0, -2.0, 1.0));
    let turn = Rotation3::from_euler_angles(0.4, 1.0, -0.3);
    let o = &p.octahedral;
    let base: Vec<_> = o.base().iter().map(|a| Point3::from(turn * a.coords * k + shift)).collect();
    let platform: Vec<_> = o.platform().iter().map(|b| Point3::from(b.coords * k)).collect();
    let legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    let m = Manipulator::try_new(base, platform, legs).unwrap();
    let moved = |q: &Pose| Pose { rotation: turn * q.rotation, position: turn * q.position * k + shift };
    let q = OffsetProblem {
        octahedral: Octahedral::recognise(&m).unwrap(),
        poses: p.poses.iter().map(moved).collect(),
        characteristic_length: p.characteristic_length * k,
        min_joint_distance: p.min_joint_distance * k,
        ..p.clone()
    };
    let (a, b) = (optimum(&p), optimum(&q));
    assert!((a.recheck.objective / b.recheck.objective - 1.0).abs() < 1e-6);
    assert!((a.shifts[2] * k - b.shifts[2]).abs() < 1e-3 * k);
}

#[test]
fn leg_order_of_the_design_is_kept() {
    let legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    let m = Manipulator::try_new(triangle(12.0), triangle(6.0), legs).unwrap();
    let mixed = m.reordered([4, 2, 0, 5, 1, 3]).unwrap();
    let o = Octahedral::recognise(&mixed).unwrap();
    let t = [0.2, 0.3, -0.4, 0.1, 1.2, 0.6];
    let (built, _) = synthesis::joint_free(&o, t).unwrap();
    // every new leg keeps one end of the design's leg with the same number
    for (new, old) in built.legs().iter().zip(mixed.legs()) {
        assert!(new.base == old.base || new.platform == old.platform);
    }
    assert_eq!((built.base_joints().len(), built.platform_joints().len()), (6, 6));
}

#[test]
fn impossible_requirements_are_proved_infeasible_with_the_reason() {
    let mut p = small_problem();
    p.min_joint_distance = 6.5; // platform edge 6
    let r = optimize(&p, &quick(), &mut |_| ControlFlow::Continue(())).unwrap();
    assert_eq!(r.outcome, OffsetOutcome::Infeasible);
    assert!(r.branches.iter().all(|b| matches!(b.conflicts[0], Conflict::VerticesTooClose { .. })));

    let mut p = small_problem();
    p.min_joint_distance = 3.01; // more than half a platform edge, and no extension of platform edge 1 or 5
    let r = optimize(&p, &quick(), &mut |_| ControlFlow::Continue(())).unwrap();
    assert_eq!(r.outcome, OffsetOutcome::Infeasible);
    assert_eq!(r.counts().spacing + r.counts().outside_bounds, 729);

    let mut p = small_problem();
    p.bounds = [(0.05, 0.95); 6];
    p.min_abs_det = 0.8; // at most 0.95^6 - 0.05^6 = 0.735
    let r = optimize(&p, &quick(), &mut |_| ControlFlow::Continue(())).unwrap();
    assert_eq!(r.outcome, OffsetOutcome::Infeasible);
    assert_eq!(r.counts().det, 1);
    let inside = r.branches.iter().find(|b| b.branch.to_string() == "000000").unwrap();
    assert!(inside.conflicts.iter().all(|c| matches!(c, Conflict::DetTooSmall { .. })), "{inside:?}");
}

#[test]
fn a_tight_determinant_is_reached_and_kept() {
    let mut p = small_problem();
    p.bounds = [(0.05, 0.95); 6];
    p.min_abs_det = 0.7;
    let s = optimum(&p);
    assert!(s.recheck.margins.all_met() && s.recheck.margins.det < 0.04);
    assert!((s.recheck.det - s.recheck.det_of_matrix).abs() < 1e-12);
}

/// An acute triangle splits cells by the order of two joints and makes the spacing constraint curved.
#[test]
fn spacing_at_an_acute_vertex_is_kept_as_a_curved_constraint() {
    let narrow = vec![Point3::origin(), Point3::new(10.0, 2.0, 0.0), Point3::new(10.0, -2.0, 0.0)];
    let legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    let m = Manipulator::try_new(narrow, triangle(6.0), legs).unwrap();
    let mut p = OffsetProblem::with_defaults(Octahedral::recognise(&m).unwrap(), poses());
    p.bounds = [(0.0, 1.0); 6];
    p.min_joint_distance = 1.9;
    let r = optimize(&p, &quick(), &mut |_| ControlFlow::Continue(())).unwrap();
    let inside = r.branches.iter().find(|b| b.branch.to_string() == "000000").unwrap();
    assert!(inside.cells > 2, "split by order: {}", inside.cells);
    let s = r.solution().unwrap();
    assert!(s.recheck.margins.all_met(), "{:?}", s.recheck.margins);
    // negative control: the same offsets with a wider requirement are refused
    p.min_joint_distance += s.recheck.margins.base_spacing.min(s.recheck.margins.platform_spacing) + 1e-6;
    assert!(!p.recheck(&s.offsets).unwrap().margins.all_met());
}
