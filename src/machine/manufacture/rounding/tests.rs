//! Roundings: on the grid, on the lines, better than their neighbours, and distinguished from inexact ones.

#![allow(clippy::large_types_passed_by_value, reason = "tests make their grids on the spot")]

use nalgebra::{Point3, Rotation3, Vector3};

use super::exact::{proved, rank};
use super::grid::{BodyGrid, TargetPlaces, pool};
use super::*;
use crate::manufacture::tests::{free, octahedral, space};
use crate::requirements::{HoleCircle, HoleCircles, SafetyMargins, TermKind};
use platform::manipulator::{Leg, Octahedral, inverse_condition, jacobian};
use synthesis::joint_free;
use verify::{InconclusiveReason, Verdict};

const GRID: Grid = Grid::square(0.25);

fn with<R>(
    m: &Manipulator,
    grids: [Grid; 2],
    required: &Requirements,
    work: impl Fn(&RoundingProblem<'_>) -> R,
) -> R {
    let space = space();
    let poses: Vec<Pose> = [-1.0, 1.0]
        .iter()
        .flat_map(|s| (0..6).map(move |k| nalgebra::Vector6::ith(k, *s)))
        .map(|x| space.pose(&x))
        .collect();
    work(&RoundingProblem {
        manipulator: m,
        grids: grids.map(Some),
        free: false,
        fixed: [&[], &[]],
        requirements: required,
        space: &space,
        poses: &poses,
        characteristic_length: 2.5,
        min_abs_det: None,
        tool: Point3::origin(),
        candidates: 30,
        keep: 0.9,
        trials: 40,
        seed: 1,
    })
}

fn round(m: &Manipulator, grids: [Grid; 2]) -> Result<Rounding, NoRounding> {
    with(m, grids, &Requirements::default(), round_to_grid)
}

#[test]
fn the_exact_rounding_is_on_the_grid_on_its_lines_and_proved_equivalent() {
    let found = round(&free(), [GRID; 2]).unwrap();
    let e = found.exact.unwrap();
    assert!(e.proved);
    assert!(equivalent_to_rounding(&e.verification.unwrap().verdict));
    for p in e.manipulator.base_joints().iter().chain(e.manipulator.platform_joints()) {
        for x in p.iter() {
            assert!((x / GRID.pitch).fract().abs() <= 0.0, "{x} is not a multiple of the pitch");
        }
    }
    for j in &e.joints {
        assert!(j.moved.norm() < 6.0 * GRID.pitch, "{j:?}");
        assert!(j.off_line.is_none_or(|x| x < 1e-13));
    }
    assert_eq!(e.joints.iter().filter(|j| j.off_line.is_some()).count(), 6);
    // det A from the fractions
    let t = e.fractions.unwrap().map(|(k, n)| k as f64 / n as f64);
    let det = synthesis::offset_determinant(&t);
    assert!((det - e.evaluation.det.unwrap()).abs() < 1e-12 * det.abs().max(1.0));
}

#[test]
fn no_other_triangle_of_one_body_is_better() {
    let required = Requirements::default();
    with(&free(), [GRID; 2], &required, |problem| {
        let found = round_to_grid(problem).unwrap().exact.unwrap();
        let value = |m: &Manipulator| {
            let at = |pose| inverse_condition(&jacobian(m, pose, problem.characteristic_length));
            problem.poses.iter().map(at).fold(f64::INFINITY, f64::min)
        };
        assert!((value(&found.manipulator) - found.evaluation.objective).abs() < 1e-15);
        let m = problem.manipulator;
        let roles = TrianglesOfBodies::of(m).unwrap();
        let list = joints(m);
        let mut tried = 0;
        for body in 0..2 {
            let own = if body == 0 { Body::Base } else { Body::Platform };
            let points: Vec<_> = list.iter().filter(|j| j.body == own).map(|j| place(m, *j)).collect();
            let grid = BodyGrid::new(&points, &GRID, m.size()).unwrap();
            let at = |j: Joint| grid.coordinates(&place(m, j));
            let target = TargetPlaces {
                corners: roles.corners[body].map(at),
                inner: roles.inner.map(|i| i[body].map(at)),
                skew: 0.0,
            };
            for t in pool(&target, 30, 16.0).triangles {
                let mut joints =
                    [found.manipulator.base_joints().to_vec(), found.manipulator.platform_joints().to_vec()];
                for k in 0..3 {
                    joints[body][roles.corners[body][k].index] = grid.point(t.corners[k]);
                    joints[body][roles.inner.unwrap()[body][k].index] = grid.point(t.joint(k));
                }
                let [a, b] = joints;
                let other = Manipulator::try_new(a, b, m.pairs()).unwrap();
                assert!(value(&other) <= found.evaluation.objective * (1.0 + 1e-12));
                tried += 1;
            }
        }
        assert!(tried > 60, "{tried}");
    });
}

#[test]
fn a_joint_one_hole_off_its_line_is_not_proved() {
    let corners = [[[0, 0], [12, 0], [0, 9]], [[0, 0], [6, 3], [-3, 6]]];
    // legs of the hexagon with t = 1/3 on all sides
    let third = |p: [i64; 2], q: [i64; 2]| [0, 1].map(|k| p[k] + (q[k] - p[k]) / 3);
    let mut legs = Vec::new();
    for k in 0..3 {
        let [a, b] = corners;
        legs.push((third(a[k], a[(k + 1) % 3]), b[k]));
        legs.push((a[(k + 1) % 3], third(b[k], b[(k + 1) % 3])));
    }
    assert_eq!(rank(&legs), Some(6));
    let cells: Vec<[i64; 2]> = legs.iter().map(|l| l.0).chain(legs.iter().map(|l| l.1)).collect();
    let point = |c: &[i64; 2]| Point3::new(c[0] as f64, c[1] as f64, 0.0);
    let build = |cells: &[[i64; 2]]| {
        let (a, b) = (cells[..6].iter().map(point).collect(), cells[6..].iter().map(point).collect());
        Manipulator::try_new(a, b, std::array::from_fn(|i| (i, i))).unwrap()
    };
    let m = build(&cells);
    let list = joints(&m);
    assert!(proved(&m, &list, &cells, &corners));
    let mut off = cells.clone();
    off[0][1] += 1;
    assert!(!proved(&build(&off), &list, &off, &corners));
}

#[test]
fn a_design_that_is_on_the_grid_stays_where_it_is() {
    let fine = Grid { pitch: 1.0 / 64.0, ..GRID };
    let m = round(&free(), [GRID; 2]).unwrap().exact.unwrap().manipulator;
    let again = round(&m, [fine; 2]).unwrap();
    let n = again.nearest.as_ref().unwrap();
    assert!(n.joints.iter().all(|j| j.moved.norm() < 1e-12) && n.not_nearest == 0);
    assert_eq!(n.verification.as_ref().unwrap().verdict, Verdict::Equivalent);
    assert!(n.first_order.0 < 1e-12 && n.solved.0.position.max < 1e-9);
    assert!(again.choice(0.9).is_some());
}

#[test]
fn the_nearest_rounding_errs_as_the_first_order_says_and_in_proportion_to_the_pitch() {
    let at = |pitch: f64| round(&free(), [Grid { pitch, ..GRID }; 2]).unwrap().nearest.unwrap();
    let (coarse, fine) = (at(0.023), at(0.00023));
    for n in [&coarse, &fine] {
        assert!(matches!(n.verification.as_ref().unwrap().verdict, Verdict::NotEquivalent(_)));
        // the lowered cost includes both errors
        let cost = |(p, w): (f64, f64)| p.max(2.5 * w.to_radians());
        assert!(cost(n.first_order) <= cost(n.first_order_nearest) * (1.0 + 1e-12));
        let (solved, count) = n.solved;
        assert_eq!(count, 40);
        // the first order is that of twelve poses on the faces of the workspace
        assert!(solved.position.max < 2.0 * n.first_order.0 && solved.position.max > 0.2 * n.first_order.0);
    }
    let ratio = coarse.first_order_nearest.0 / fine.first_order_nearest.0;
    assert!((20.0..500.0).contains(&ratio), "{ratio}");
}

#[test]
fn requirements_are_respected_or_the_violation_is_told() {
    let distance = |d: f64| Requirements { min_joint_distance: Some(d), ..Requirements::default() };
    let plain = round(&free(), [GRID; 2]).unwrap().exact.unwrap().evaluation.least_distances;
    let apart = plain[0].min(plain[1]) + 0.05;
    let found = with(&free(), [GRID; 2], &distance(apart), round_to_grid).unwrap();
    let j = found.exact.unwrap().evaluation;
    assert!(j.met && j.least_distances.iter().all(|d| *d >= apart), "{j:?}");
    // more than any triangle near the given one allows
    let found = with(&free(), [GRID; 2], &distance(30.0), round_to_grid).unwrap();
    assert!(found.choice(0.9).is_none());
    let j = &found.exact.as_ref().unwrap().evaluation;
    assert!(!j.met && j.requirements.iter().any(|m| m.kind == TermKind::BaseSpacing && m.value < 0.0));
    // the search names the rounding with the smaller miss of the distance
    let missed = |j: &Evaluation| j.requirements.iter().map(|m| -m.value / 30.0).fold(0.0, f64::max);
    let of_exact = found.exact.as_ref().map(|e| (&e.manipulator, missed(&e.evaluation))).unwrap();
    let of_nearest = found.nearest.as_ref().map(|n| (&n.manipulator, missed(&n.evaluation))).unwrap();
    let less = if of_nearest.1 < of_exact.1 { of_nearest.0 } else { of_exact.0 };
    let named = found.least_missed(&distance(30.0), free().size()).unwrap();
    assert!(std::ptr::eq(named, less), "{} {}", of_exact.1, of_nearest.1);
}

/// Holes of a rotated grid are doubles, so the map holds within rounding.
fn equivalent_to_rounding(verdict: &Verdict) -> bool {
    matches!(verdict, Verdict::Equivalent | Verdict::Inconclusive(InconclusiveReason::WithinRounding))
}

#[test]
fn grids_may_be_turned_shifted_and_of_two_pitches() {
    let base = Grid { pitch: 0.3, origin: [0.11, -0.07], angle_deg: 30.0, ..GRID };
    let platform = Grid { pitch: 0.2, origin: [0.0, 0.05], angle_deg: -12.0, ..GRID };
    let e = round(&free(), [base, platform]).unwrap().exact.unwrap();
    assert!(e.proved);
    assert!(equivalent_to_rounding(&e.verification.unwrap().verdict));
    let back = Rotation3::from_axis_angle(&Vector3::z_axis(), -30f64.to_radians());
    for p in e.manipulator.base_joints() {
        // the origin is given before the rotation of the grid
        let x = back * (p.coords - Vector3::new(0.11, -0.07, 0.0)) / 0.3;
        assert!((x.x - x.x.round()).abs() < 1e-9 && (x.y - x.y.round()).abs() < 1e-9);
    }
}

#[test]
fn an_octahedral_design_is_rounded_corner_by_corner() {
    let e = round(&octahedral(), [GRID; 2]).unwrap().exact.unwrap();
    assert!(e.proved && e.fractions.is_none() && e.joints.len() == 6);
    assert!(e.joints.iter().all(|j| j.off_line.is_none() && j.moved.norm() < 4.0 * GRID.pitch));
}

#[test]
fn bodies_in_space_are_refused_and_designs_without_triangles_have_no_exact_rounding() {
    let mut legs = free().legs();
    legs[1].platform.z += 0.5;
    let bent = Manipulator::from_legs(legs).unwrap();
    assert_eq!(round(&bent, [GRID; 2]).unwrap_err(), NoRounding::NotPlanar(Body::Platform));
    let found = round(&hexapod(), [GRID; 2]).unwrap();
    assert_eq!(found.exact.unwrap_err(), NoRounding::NoTriangles);
    assert!(found.nearest.is_ok());
    let bad = Grid { pitch: 0.0, ..GRID };
    assert_eq!(round(&free(), [GRID, bad]).unwrap_err(), NoRounding::BadGrid(Body::Platform));
    let coarse = Grid { pitch: 50.0, ..GRID };
    let found = round(&free(), [coarse; 2]).unwrap();
    assert!(matches!(found.exact, Err(NoRounding::NoTriangleNear(_))));
    assert!(matches!(found.nearest, Err(NoRounding::JointsCoincide(_))));
}

fn round_freely(m: &Manipulator, grids: [Grid; 2]) -> Rounding {
    with(m, grids, &Requirements::default(), |p| round_to_grid(&RoundingProblem { free: true, ..*p }))
        .unwrap()
}

/// Six legs on planar bodies, neither octahedral nor with joints on the sides of triangles.
fn hexapod() -> Manipulator {
    Manipulator::from_legs(std::array::from_fn(|i| {
        let t = i as f64 + 0.2 * (i % 2) as f64;
        Leg {
            base: Point3::new(4.0 * t.cos(), 3.0 * t.sin(), 0.0),
            platform: Point3::new((1.4 * t).sin(), 2.0 * t.cos(), 0.0),
        }
    }))
    .unwrap()
}

#[test]
fn free_grids_are_never_worse_than_the_given_ones() {
    let cost = |n: &NearestRounding| n.first_order.0.max(2.5 * n.first_order.1.to_radians());
    let grids =
        [Grid { pitch: 0.4, ..GRID }, Grid { pitch: 0.3, origin: [0.1, 0.05], angle_deg: 20.0, ..GRID }];
    for m in [free(), octahedral(), hexapod()] {
        let (fixed, chosen) = (round(&m, grids).unwrap(), round_freely(&m, grids));
        let (a, b) = (fixed.nearest.unwrap(), chosen.nearest.unwrap());
        assert!(cost(&b) <= cost(&a), "{:?}", b.grids);
        assert!(
            b.grids
                .iter()
                .zip(&grids)
                .all(|(found, given)| (found.unwrap().pitch - given.pitch).abs() <= 0.0)
        );
        if let (Ok(a), Ok(b)) = (fixed.exact, chosen.exact) {
            assert!(b.evaluation.objective >= a.evaluation.objective && b.proved, "{:?}", b.grids);
            assert!(equivalent_to_rounding(&b.verification.unwrap().verdict));
        }
    }
    // and better where the choice is free
    let (fixed, chosen) = (round(&hexapod(), grids).unwrap(), round_freely(&hexapod(), grids));
    assert!(cost(&chosen.nearest.unwrap()) < 0.9 * cost(&fixed.nearest.unwrap()));
}

#[test]
fn joints_that_are_on_some_grid_are_found_to_be_on_it() {
    let grids = [
        Grid { pitch: 0.4, origin: [0.13, -0.08], angle_deg: 31.0, ..GRID },
        Grid { pitch: 0.3, origin: [0.1, 0.05], angle_deg: -17.0, ..GRID },
    ];
    let on = round(&hexapod(), grids).unwrap().nearest.unwrap().manipulator;
    let plain = grids.map(|g| Grid { origin: [0.0; 2], angle_deg: 0.0, ..g });
    let n = round_freely(&on, plain).nearest.unwrap();
    assert!(n.joints.iter().all(|j| j.moved.norm() < 1e-6), "{:?}", n.joints);
    assert!(
        n.grids.iter().zip(&grids).all(|(a, b)| (a.unwrap().angle_deg - b.angle_deg).abs() < 1e-4),
        "{:?}",
        n.grids
    );
    // negative control: the grid that is given does not have them
    let n = round(&on, plain).unwrap().nearest.unwrap();
    assert!(n.joints.iter().any(|j| j.moved.norm() > 0.01));
}

#[test]
fn same_input_same_rounding() {
    let one = || {
        let e = round(&free(), [GRID; 2]).unwrap();
        (e.exact.unwrap().joints, e.nearest.unwrap().joints)
    };
    assert_eq!(one(), one());
}

/// A platform with three-fold symmetry, joints on the sides of its triangles.
fn three_fold() -> Manipulator {
    let corner = |radius: f64, deg: f64, z: f64| {
        move |k: usize| {
            let (s, c) = (deg + 120.0 * k as f64).to_radians().sin_cos();
            Point3::new(radius * c, radius * s, z)
        }
    };
    let legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    let (base, platform) = (corner(6.1, 85.0, 0.0), corner(4.2, 150.0, 0.0));
    let m = Manipulator::try_new((0..3).map(base).collect(), (0..3).map(platform).collect(), legs).unwrap();
    let octahedral = Octahedral::recognise(&m).unwrap();
    joint_free(&octahedral, [0.2, 0.27, 0.2, 0.27, 0.2, 0.27]).unwrap().0
}

#[test]
fn three_fold_platforms_keep_their_symmetry_on_triangular_grids() {
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 120f64.to_radians());
    let turns_into_itself =
        |joints: &[Point3<f64>]| joints.iter().all(|p| joints.iter().any(|q| (turn * p - q).norm() < 1e-9));
    let symmetric = |m: &Manipulator| Body::BOTH.iter().all(|body| turns_into_itself(m.joints(*body)));
    // a hole in the middle of the base, three around that of the platform
    let pitch = 0.25;
    let triangular = Grid { pattern: HolePattern::Triangular, pitch, ..GRID };
    let grids = [triangular, Grid { origin: [0.5 * pitch, pitch / 12f64.sqrt()], ..triangular }];
    assert!(symmetric(&three_fold()));
    let e = round(&three_fold(), grids).unwrap().exact.unwrap();
    assert!(e.three_fold && e.proved && symmetric(&e.manipulator), "{:?}", e.joints);
    assert!(equivalent_to_rounding(&e.verification.unwrap().verdict));
    assert!(e.joints.iter().all(|j| j.off_line.is_none_or(|off| off < 1e-12)));
    // negative controls: square grids, a grid without this symmetry about the middle, a platform without it
    let off = Grid { origin: [0.3 * pitch, 0.0], ..triangular };
    for (m, grids) in [(three_fold(), [GRID; 2]), (three_fold(), [off; 2]), (free(), [triangular; 2])] {
        let e = round(&m, grids).unwrap().exact.unwrap();
        assert!(!e.three_fold && e.proved && !symmetric(&e.manipulator));
    }
}

fn turns_into_itself(joints: &[Point3<f64>]) -> bool {
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 120f64.to_radians());
    joints.iter().all(|p| joints.iter().any(|q| (turn * p - q).norm() < 1e-9))
}

#[test]
fn three_fold_platforms_keep_their_symmetry_on_circles_and_joints_stand_on_their_holes() {
    let symmetric = |m: &Manipulator| Body::BOTH.iter().all(|body| turns_into_itself(m.joints(*body)));
    let polar = Grid { angle_deg: 3.0, ..Grid::polar(HoleCircle { radius: 1.0, holes: 48 }, 0.5) };
    let list = [4.2, 2.9, 3.3].map(|radius| HoleCircle { radius, holes: 36 });
    let bolts = Grid::bolt_circles(HoleCircles::new(&list).unwrap());
    let found = round(&three_fold(), [polar, bolts]).unwrap();
    assert!(matches!(found.exact, Err(NoRounding::NoLines(Body::Base))));
    let n = found.nearest.unwrap();
    assert!(n.three_fold && symmetric(&n.manipulator), "{:?}", n.joints);
    for (joint, at) in
        n.joints.iter().zip(joints(&n.manipulator).into_iter().map(|j| place(&n.manipulator, j)))
    {
        let [circle, number] = joint.cell.unwrap();
        let (radius, step, first) = match joint.joint.body {
            Body::Base => (1.0 + 0.5 * circle as f64, 7.5, 3.0),
            Body::Platform => (list[usize::try_from(circle).unwrap()].radius, 10.0, 0.0),
        };
        let (s, c) = (first + step * number as f64).to_radians().sin_cos();
        assert!((at.x - radius * c).hypot(at.y - radius * s) < 1e-12, "{joint:?}");
        // the circles of the platform are up to 0.9 apart
        assert!(joint.moved.norm() < 1.0, "{joint:?}");
    }
    // negative controls: a number of holes that 3 does not divide, circles about another place, a platform without the
    // symmetry
    let uneven = Grid::polar(HoleCircle { radius: 1.0, holes: 47 }, 0.5);
    let off = Grid { origin: [0.1, 0.0], ..polar };
    for (m, grids) in [(three_fold(), [uneven, bolts]), (three_fold(), [off, bolts]), (free(), [polar; 2])] {
        let n = round(&m, grids).unwrap().nearest.unwrap();
        assert!(!n.three_fold && !symmetric(&n.manipulator));
    }
}

#[test]
fn the_nearest_rounding_keeps_symmetry_on_triangular_grids_too() {
    let triangular = Grid::triangular(0.25);
    let n = round(&three_fold(), [triangular; 2]).unwrap().nearest.unwrap();
    assert!(n.three_fold && Body::BOTH.iter().all(|b| turns_into_itself(n.manipulator.joints(*b))));
    let n = round(&three_fold(), [GRID; 2]).unwrap().nearest.unwrap();
    assert!(!n.three_fold);
}

#[test]
fn a_plate_without_a_grid_keeps_its_joints() {
    let required = Requirements::default();
    for grid in [GRID, Grid::polar(HoleCircle { radius: 0.5, holes: 72 }, 0.25)] {
        let found = with(&free(), [GRID; 2], &required, |problem| {
            round_to_grid(&RoundingProblem { grids: [Some(grid), None], ..*problem })
        })
        .unwrap();
        assert!(matches!(found.exact, Err(NoRounding::NoLines(_))));
        let n = found.nearest.unwrap();
        assert_eq!(n.manipulator.platform_joints(), free().platform_joints());
        for j in &n.joints {
            let on_platform = j.joint.body == Body::Platform;
            assert_eq!(j.cell.is_none(), on_platform);
            assert_eq!(j.moved.norm() <= 0.0, on_platform, "{j:?}");
        }
    }
    // a body in space may stay as it is
    let mut legs = free().legs();
    legs[1].platform.z += 0.5;
    let bent = Manipulator::from_legs(legs).unwrap();
    let found = with(&bent, [GRID; 2], &required, |problem| {
        round_to_grid(&RoundingProblem { grids: [Some(GRID), None], ..*problem })
    });
    assert!(found.unwrap().nearest.is_ok());
}

#[test]
fn joints_that_are_fixed_stay_and_the_others_are_rounded() {
    let required = Requirements::default();
    let with_fixed = |m: &Manipulator, grid: Grid, fixed: [&[bool]; 2]| {
        with(m, [grid; 2], &required, |p| round_to_grid(&RoundingProblem { fixed, ..*p })).unwrap()
    };
    let first = [true, false, false, false, false, false];
    // off the holes: no triangle of holes has the joint, and the nearest rounding leaves it alone
    let found = with_fixed(&free(), GRID, [&first, &[]]);
    assert!(matches!(found.exact, Err(NoRounding::NoTriangleNear(Body::Base))));
    let n = found.nearest.unwrap();
    for j in &n.joints {
        let fixed = j.joint.body == Body::Base && j.joint.index == 0;
        assert_eq!(j.moved.norm() <= 0.0, fixed, "{j:?}");
        assert_eq!(j.cell.is_none(), fixed, "{j:?}");
    }
    assert_eq!(n.manipulator.base_joints()[0], free().base_joints()[0]);
    // on a hole: the exact rounding goes through it, with other holes for other joints
    let on = round(&free(), [GRID; 2]).unwrap().exact.unwrap().manipulator;
    let (mut base, platform) = (on.base_joints().to_vec(), on.platform_joints().to_vec());
    base[1].x += 0.03;
    let near = Manipulator::try_new(base, platform, on.pairs()).unwrap();
    if let Ok(e) = with_fixed(&near, GRID, [&first, &[]]).exact {
        assert!(e.proved && (e.manipulator.base_joints()[0] - near.base_joints()[0]).norm() < 1e-12);
    }
    let e = with_fixed(&on, GRID, [&[true; 6], &[]]).exact.unwrap();
    assert!(e.proved && e.manipulator.base_joints() == on.base_joints());
}

#[test]
fn a_safety_margin_is_kept_where_a_rounding_keeps_it() {
    let safety_margin = |percent: f64| Requirements {
        min_joint_distance: Some(0.9),
        safety_margins: SafetyMargins { all: Some(percent), ..SafetyMargins::default() },
        ..Requirements::default()
    };
    let least = |percent: f64| {
        let e = with(&free(), [GRID; 2], &safety_margin(percent), round_to_grid).unwrap().exact.unwrap();
        let least = e.evaluation.least_distances;
        (e.evaluation.met, e.evaluation.safety_margin_kept, least[0].min(least[1]))
    };
    let (met, kept, spacing) = least(30.0);
    assert!(met && kept && spacing >= 0.9 * 1.3, "{spacing}");
    // a safety margin above that of any rounding: the limit itself still holds
    let (met, kept, spacing) = least(99.0);
    assert!(met && spacing >= 0.9, "{spacing}");
    assert_eq!(kept, spacing >= 0.9 * 1.99);
}

#[test]
fn grids_that_are_not_square_are_not_chosen_freely() {
    let triangular = Grid::triangular(0.25);
    let refused = with(&free(), [GRID, triangular], &Requirements::default(), |problem| {
        round_to_grid(&RoundingProblem { free: true, ..*problem }).err()
    });
    assert_eq!(refused, Some(NoRounding::FreePattern(Body::Platform)));
}
