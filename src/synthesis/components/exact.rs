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
}
