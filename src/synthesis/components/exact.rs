//! Exact tests: the legs in the span of given legs, and the partners of a point.

use num::algebraic::Algebraic;
use num::exact::{product, rank, relations};
use platform::manipulator::{AlgebraicVector, Body, ExactLeg, ExactLegs, Leg};

/// `sum_k c_k rows_k` with small integer coefficients.
pub(super) fn combination(rows: &[&AlgebraicVector], c: &[i32]) -> AlgebraicVector {
    let mut out: AlgebraicVector = vec![Algebraic::integer(0); rows.first().map_or(0, |r| r.len())];
    for (row, c) in rows.iter().zip(c) {
        let c = Algebraic::integer((*c).into());
        out.iter_mut().zip(row.iter()).for_each(|(o, x)| *o = &*o + &(&c * x));
    }
    out
}

/// Whether a leg's vector is a combination of those of the six, as rational numbers.
pub(super) fn contains(six: &ExactLegs, leg: &Leg) -> bool {
    let Some(leg) = ExactLeg::of(leg) else { return false };
    let mut rows = six.vectors.clone();
    rows.push(leg.vector().into_iter().map(Algebraic::Rational).collect());
    relations(&rows).iter().any(|c| !c[six.vectors.len()].is_zero())
}

/// Dimension of the partners of the point `x` of `body`. Partners are the `y` in the span of the other ends of `legs`
/// with `x (x) y` in the span of the vectors of `legs`.
pub(super) fn fibre(six: &ExactLegs, body: Body, x: &AlgebraicVector, legs: &[usize]) -> usize {
    partners(six, body, x, legs, independent(&other_ends(six, body, legs)))
}

/// The part of [`fibre`] at infinity: `y` with first entry 0.
pub(super) fn fibre_at_infinity(six: &ExactLegs, body: Body, x: &AlgebraicVector, legs: &[usize]) -> usize {
    let ends = independent(&other_ends(six, body, legs));
    // all ends have first entry 1, so differences span the vectors with first entry 0
    let differences = ends.iter().skip(1).map(|e| e.iter().zip(&ends[0]).map(|(x, y)| x - y).collect());
    let differences = differences.collect();
    partners(six, body, x, legs, differences)
}

fn other_ends(six: &ExactLegs, body: Body, legs: &[usize]) -> Vec<AlgebraicVector> {
    let others = body.other().of((&six.base, &six.platform));
    legs.iter().map(|i| others[*i].clone()).collect()
}

/// Dimension of the `y` in the span of independent `directions` for which `x (x) y` lies in the span of the vectors of
/// `legs`.
fn partners(
    six: &ExactLegs,
    body: Body,
    x: &AlgebraicVector,
    legs: &[usize],
    directions: Vec<AlgebraicVector>,
) -> usize {
    let mut rows = six.vectors_of(legs);
    let leg_rank = rank(&rows);
    let count = directions.len();
    rows.extend(directions.into_iter().map(|y| match body {
        Body::Base => product(x, &y),
        Body::Platform => product(&y, x),
    }));
    leg_rank + count - rank(&rows)
}

/// Whether all points of the plane of the ends on `body` with a line of partners or more are joints, or crossings of
/// two lines through joints. `false` decides nothing.
///
/// Joints without a doubtful line have no such point around them. See the lemma in `docs/theory/components.md`.
pub(super) fn only_crossings(six: &ExactLegs, body: Body, legs: &[usize]) -> bool {
    let ends = six.ends(body);
    let around: Vec<(usize, Vec<usize>)> =
        legs.iter().filter_map(|joint| Some((*joint, doubtful_lines(six, body, legs, *joint)?))).collect();
    around.iter().any(|(joint, lines)| {
        let misses =
            |line: &usize| around.iter().any(|(q, _)| !collinear([*joint, *line, *q].map(|k| &ends[k])));
        lines.iter().all(misses)
    })
}

/// The lines through a joint and another one, named by a leg of that, whose points may have a line of partners. `None`
/// if all points of the plane may.
fn doubtful_lines(six: &ExactLegs, body: Body, legs: &[usize], joint: usize) -> Option<Vec<usize>> {
    let (ends, others) = (six.ends(body), six.ends(body.other()));
    let unit = |k: usize| (0..4).map(|i| Algebraic::integer(i64::from(i == k))).collect::<AlgebraicVector>();
    let mut rows = six.vectors_of(legs);
    rows.extend((0..4).map(|k| match body {
        Body::Base => product(&ends[joint], &unit(k)),
        Body::Platform => product(&unit(k), &ends[joint]),
    }));
    let apart = rank(&rows) - 4;
    let at_most = |on: &dyn Fn(usize) -> bool| {
        let off: Vec<AlgebraicVector> =
            legs.iter().filter(|k| !on(**k)).map(|k| others[*k].clone()).collect();
        apart - if off.is_empty() { 0 } else { rank(&off) }
    };
    let here = |k: usize| ends[k] == ends[joint];
    if at_most(&here) >= 2 {
        return None;
    }
    let through = |leg: usize, k: usize| collinear([&ends[joint], &ends[leg], &ends[k]]);
    Some(legs.iter().copied().filter(|leg| !here(*leg) && at_most(&|k| through(*leg, k)) >= 2).collect())
}

fn collinear(points: [&AlgebraicVector; 3]) -> bool {
    rank(&points.map(Clone::clone)) <= 2
}

/// A maximal independent part of the rows, the first ones preferred.
fn independent(rows: &[AlgebraicVector]) -> Vec<AlgebraicVector> {
    let mut kept: Vec<AlgebraicVector> = Vec::new();
    for row in rows {
        kept.push(row.clone());
        if rank(&kept) < kept.len() {
            kept.pop();
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;

    #[test]
    fn three_decimal_points_on_a_line_are_not_collinear_as_doubles_unless_they_are() {
        let leg = |x: f64, y: f64| Leg { base: Point3::new(x, y, 0.0), platform: Point3::new(0.0, 0.0, 1.0) };
        let legs = [leg(0.1, 0.1), leg(0.2, 0.2), leg(0.3, 0.3), leg(0.1, 0.3), leg(0.2, 0.6), leg(0.3, 0.9)];
        let e = ExactLegs::of_doubles(&legs).unwrap();
        assert_eq!(e.dimension(Body::Base, &[0, 1, 2]), 1);
        // 3 * 0.2 is not 0.6 as doubles
        assert_eq!(e.dimension(Body::Base, &[3, 4, 5]), 2);
        assert_eq!(e.dimension(Body::Platform, &[0, 1, 2]), 0);
        // all legs share the platform point: every base point of the plane is replaceable
        assert_eq!(e.rank(&[0, 1, 2, 3, 4, 5]), 3);
        assert_eq!(fibre(&e, Body::Platform, &e.platform[0], &[0, 1, 2, 3, 4, 5]), 3);
        assert_eq!(fibre(&e, Body::Base, &e.base[0], &[0, 1, 2, 3, 4, 5]), 1);
    }

    /// Two lines of the base with three joints each, and platform joints in general.
    fn two_lines(platform: [[f64; 3]; 6]) -> ExactLegs {
        let base = [[1., 0., 0.], [2., 0., 0.], [5., 0., 0.], [0., 1., 0.], [0., 3., 0.], [0., 4., 0.]];
        let leg = |k: usize| Leg { base: Point3::from(base[k]), platform: Point3::from(platform[k]) };
        ExactLegs::of_doubles(&[0, 1, 2, 3, 4, 5].map(leg)).unwrap()
    }

    #[test]
    fn lines_of_partners_are_bounded_around_each_joint() {
        let all = [0, 1, 2, 3, 4, 5];
        let general = [[0., 0., 0.], [1., 0., 2.], [3., 5., 1.], [2., 7., 4.], [9., 1., 3.], [4., 4., 9.]];
        let six = two_lines(general);
        // off the line of the first three joints three platform joints remain, of rank 3
        assert_eq!(doubtful_lines(&six, Body::Base, &all, 0), Some(vec![1, 2]));
        assert_eq!(doubtful_lines(&six, Body::Base, &all, 4), Some(vec![3, 5]));
        assert!(only_crossings(&six, Body::Base, &all));
        // without the joints of the second line nothing is known off the first one
        assert!(!only_crossings(&six, Body::Base, &[0, 1, 2]) || six.rank(&[0, 1, 2]) < 3);
        // without the first platform joint the others span a plane only
        let flat =
            general.map(|v| if v.iter().all(|x| x.abs() == 0.) { [1., 1., 1.] } else { [v[0], v[1], 0.] });
        let six = two_lines(flat);
        assert_eq!(doubtful_lines(&six, Body::Base, &all, 0), None);
    }
}
