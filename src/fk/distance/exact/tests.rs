use nalgebra::{Matrix3, Point3, Rotation3, Vector3};

use super::super::plans;
use super::strip::literal;
use super::*;
use num::poly::complex_roots;
use platform::topology::{catalogue, sequences};

/// Poses of generic members, found and certified by the homotopy (`docs/theory/topologies.md`).
const POSES: [usize; 34] = [
    40, 40, 16, 32, 40, 24, 8, 16, 16, 32, 24, 8, 16, 8, 8, 16, 8, 8, 16, 8, 16, 24, 16, 16, 8, 16, 8, 8, 8,
    8, 16, 8, 8, 16,
];

fn solvable() -> impl Iterator<Item = (usize, [(usize, usize); 6], Vec<Sequence>)> {
    catalogue().into_iter().filter_map(|n| {
        let legs = n.topology().legs();
        let found = (0..2).map(|count| sequences(&legs, count)).find(|s| !s.is_empty())?;
        Some((n.number(), legs, found))
    })
}

#[test]
fn degrees_of_all_thirty_topologies_are_their_numbers_of_poses() {
    assert_eq!(solvable().count(), 30);
    for (number, legs, found) in solvable() {
        let d = generic_degrees(&legs, &found[0], 1).unwrap();
        // two triangles: every pose has a mirror image with the same distances
        let mirrored = number >= 32;
        assert_eq!(d.after, POSES[number - 1], "T{number:02}");
        assert_eq!(d.distinct * if mirrored { 2 } else { 1 }, d.after, "T{number:02}");
        assert_eq!(d, ClosureDegrees { ..generic_degrees(&legs, &found[0], 2).unwrap() }, "T{number:02}");
    }
}

#[test]
fn the_short_way_gives_the_polynomial_of_the_long_one() {
    for (number, legs, found) in solvable() {
        // the first sequences, and some that are ranked low
        for s in found.iter().take(2).chain(found.iter().rev().take(2)) {
            let data = ExactData::random(&legs, &mut Rng::new(number as u64));
            let closure = best_closure(&data, s).unwrap();
            let short = reduced::<ResiduePoly>(&data, s, closure).unwrap().polynomial;
            let long = remove_factors(&literal::<ResiduePoly>(&data, s, closure).unwrap()).polynomial;
            let degrees = (short.degree().unwrap(), long.degree().unwrap());
            // a closure that the last root does not enter is squared on the long way
            let power = degrees.1 / degrees.0;
            let product = (0..power).fold(ResiduePoly::constant(&1.into()), |p, _| p.times(&short));
            assert!(
                long.exact_div(&product).is_some_and(|q| q.degree() == Some(0)),
                "T{number:02} {degrees:?}"
            );
        }
    }
}

fn innocenti() -> Manipulator {
    let base = [[0, 0, 0], [5, 0, 1], [-2, 4, -1], [3, -1, 1], [6, -2, 2], [-3, 5, -1]];
    let platform = [[4, 1, 4], [0, 3, 3], [4, 1, 5], [-4, 3, 3]];
    let points = |list: &[[i32; 3]]| list.iter().map(|p| Point3::from(p.map(f64::from))).collect();
    Manipulator::try_new(points(&base), points(&platform), [(0, 0), (1, 0), (2, 1), (3, 1), (4, 2), (5, 3)])
        .unwrap()
}

#[test]
#[ignore = "evidence"]
fn every_virtual_leg_of_the_coupled_example_tells_eight_real_poses() {
    let m = innocenti();
    let s = SquaredLegLengths::try_new([33.0, 11.0, 21.0, 29.0, 22.0, 21.0]).unwrap();
    let mut seen = Vec::new();
    for plan in plans(&m, 1).unwrap() {
        let Some(leg) = plan.virtual_legs.first().copied().filter(|l| !seen.contains(l)) else { continue };
        seen.push(leg);
        let p = closure_polynomial(&m, &s, &plan).unwrap();
        assert_eq!((p.polynomial.degree(), p.distinct, p.real_roots.len()), (Some(32), 32, 8), "{leg:?}");
        assert_eq!(p.real_poses(32), Some(vec![1; 8]));
        assert_eq!(p.real_poses(31), None);
        // the pose R = I, p = 0 the lengths come from
        let home = (m.base_joints()[leg.0] - m.platform_joints()[leg.1]).norm_squared();
        assert!(p.polynomial.exact_div(&IntPoly::from_i64(&[-(home as i64), 1])).is_some());
        let all = complex_roots(&p.polynomial, 60).unwrap();
        assert_eq!((all.len(), all.iter().filter(|z| z.is_real()).count()), (32, 8));
    }
    assert!(seen.len() > 3);
}

#[test]
fn a_rigid_motion_or_another_unit_changes_nothing_but_the_scale() {
    let m = innocenti();
    let squares = [33.0, 11.0, 21.0, 29.0, 22.0, 21.0];
    let polynomial = |m: &Manipulator, s: [f64; 6]| {
        let s = SquaredLegLengths::try_new(s).unwrap();
        closure_polynomial(m, &s, &plans(m, 1).unwrap()[0]).unwrap().polynomial
    };
    let before = polynomial(&m, squares);
    // a rotation with integer entries, so that nothing is rounded
    let turn = Rotation3::from_matrix_unchecked(Matrix3::new(0.0, -1.0, 0.0, 0.0, 0.0, 1.0, -1.0, 0.0, 0.0));
    let moved =
        |list: &[Point3<f64>]| list.iter().map(|p| turn * p + Vector3::new(3.0, -2.0, 0.25)).collect();
    let turned =
        Manipulator::try_new(moved(m.base_joints()), m.platform_joints().to_vec(), m.pairs()).unwrap();
    assert_eq!(polynomial(&turned, squares), before);
    let quarter = |list: &[Point3<f64>]| list.iter().map(|p| p * 0.25).collect();
    let small =
        Manipulator::try_new(quarter(m.base_joints()), quarter(m.platform_joints()), m.pairs()).unwrap();
    assert_eq!(polynomial(&small, squares.map(|s| s / 16.0)), before.stretched(-4).primitive());
    // one unit in the last place of one length is another polynomial
    let mut other = squares;
    other[3] = 29f64.next_up();
    assert_ne!(polynomial(&m, other), before);
}

#[test]
fn planar_octahedral_poses_come_in_mirror_pairs_told_by_the_height() {
    let p = |x: f64, y: f64| Point3::new(x, y, 0.0);
    let legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    let h = 10.392304845413264;
    let m = Manipulator::try_new(
        vec![p(0.0, 0.0), p(6.0, h), p(12.0, 0.0)],
        vec![p(0.0, 0.0), p(6.0, 0.0), p(3.0, -h / 2.0)],
        legs,
    )
    .unwrap();
    let s = SquaredLegLengths::try_new([19.8, 18.0, 18.0, 17.0, 14.9, 17.8].map(|l: f64| l * l)).unwrap();
    let c = closure_polynomial(&m, &s, &plans(&m, 1).unwrap()[0]).unwrap();
    // Rojas, Borras, Thomas, sec. 6: sixteen poses, twelve of them real
    assert_eq!((c.distinct, c.real_poses(16).map(|n| n.iter().sum())), (8, Some(12)));
}

#[test]
fn root_sum_of_the_decoupled_example() {
    let points = |list: &[[f64; 3]]| list.iter().map(|p| Point3::from(*p)).collect();
    let base = [
        [0.0, 0.0, 5.0],
        [5.1962, -3.0, -1.0],
        [10.3923, 0.0, 1.0],
        [10.3923, 6.0, -1.0],
        [5.1962, 9.0, 1.0],
        [0.0, 6.0, -1.0],
    ];
    let platform = [[0.0, 0.0, 1.0], [10.3923, 6.0, -1.0], [5.1962, 9.0, 1.0], [0.0, 6.0, -1.0]];
    let legs = [(0, 0), (1, 0), (2, 0), (3, 1), (4, 2), (5, 3)];
    let m = Manipulator::try_new(points(&base), points(&platform), legs).unwrap();
    let l = [12.80624847, 19.57589575, 18.50488312, 16.61324773, 16.61324773, 16.61324773];
    let s = SquaredLegLengths::try_new(l.map(|l: f64| l * l)).unwrap();
    // the virtual leg of the paper joins b and g
    let plan = plans(&m, 1).unwrap().into_iter().find(|s| s.virtual_legs == [(0, 1)]).unwrap();
    let c = closure_polynomial(&m, &s, &plan).unwrap();
    assert_eq!(
        (c.polynomial.degree(), c.real_roots.len(), c.real_poses(16)),
        (Some(16), 10, Some(vec![1; 10]))
    );
    let roots = complex_roots(&c.polynomial, 60).unwrap();
    let sum: f64 = roots.iter().map(|z| z.to_complex64().re).sum();
    assert!((sum - 1827.466).abs() < 5e-4, "{sum}");
    let d = closure_degrees(&m, &s, &plan).unwrap();
    assert_eq!((d.before, d.after), (40, 16));
}

#[test]
fn degenerate_data_are_reported() {
    let m = innocenti();
    let s = SquaredLegLengths::try_new([33.0, 11.0, 21.0, 29.0, 22.0, 21.0]).unwrap();
    let plan = plans(&m, 1).unwrap().swap_remove(0);
    let mut two = plan.clone();
    two.virtual_legs.push((5, 0));
    assert_eq!(closure_polynomial(&m, &s, &two).unwrap_err(), ClosureError::Unsupported);
    // the base of the first step on a line
    let mut base = m.base_joints().to_vec();
    let first = plan.unoriented().next().unwrap().from;
    let on_base = first.map(|j| if let JointIndex::Base(k) = j { k } else { panic!("{j:?}") });
    base[on_base[2]] = base[on_base[0]] + (base[on_base[1]] - base[on_base[0]]) * 2.0;
    let lean = Manipulator::try_new(base, m.platform_joints().to_vec(), m.pairs()).unwrap();
    assert_eq!(closure_polynomial(&lean, &s, &plan).unwrap_err(), ClosureError::Collinear { step: 0 });
    let tiny = SquaredLegLengths::try_new([33.0, 11.0, 21.0, 29.0, 22.0, f64::MIN_POSITIVE * 0.5]).unwrap();
    assert!(closure_polynomial(&m, &tiny, &plan).is_ok());
    let mut far = m.base_joints().to_vec();
    far[5].x = 5e-324;
    let far = Manipulator::try_new(far, m.platform_joints().to_vec(), m.pairs()).unwrap();
    assert_eq!(closure_polynomial(&far, &s, &plan).unwrap_err(), ClosureError::OutOfRange);
}
