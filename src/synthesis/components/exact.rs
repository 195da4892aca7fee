//! Ranks of the joints and legs as the rational numbers that their doubles are.

use nalgebra::Point3;

use crate::manipulator::Leg;
use crate::num::exact::{Rational, rational, relations};

/// A vector of rational numbers.
pub(in crate::synthesis) type Exact = Vec<Rational>;

/// The six legs in exact homogeneous coordinates.
#[derive(Debug, Clone)]
pub(super) struct ExactLegs {
    /// `(1, a_i)`.
    pub(super) base: Vec<Exact>,
    /// `(1, b_i)`.
    pub(super) platform: Vec<Exact>,
    /// `(1, a_i) (x) (1, b_i)`.
    vectors: Vec<Exact>,
}

/// Rank of a list of rows, exactly.
pub(in crate::synthesis) fn rank(rows: &[Exact]) -> usize {
    rows.len() - relations(rows).len()
}

/// `sum_k c_k rows_k`, the coefficients being small integers.
pub(super) fn combination(rows: &[&Exact], c: &[i32]) -> Exact {
    let zero = || Rational::from_integer(0.into());
    let mut out: Exact = vec![zero(); rows.first().map_or(0, |r| r.len())];
    for (row, c) in rows.iter().zip(c) {
        let c = Rational::from_integer((*c).into());
        out.iter_mut().zip(row.iter()).for_each(|(o, x)| *o += &c * x);
    }
    out
}

/// `a (x) b`.
pub(in crate::synthesis) fn product(a: &Exact, b: &Exact) -> Exact {
    a.iter().flat_map(|x| b.iter().map(move |y| x * y)).collect()
}

/// `(1, x)`; `None` when a coordinate is not finite.
pub(in crate::synthesis) fn homogeneous(p: &Point3<f64>) -> Option<Exact> {
    [1.0, p.x, p.y, p.z].iter().map(|x| rational(*x)).collect()
}

impl ExactLegs {
    /// `None` when a coordinate is not finite, which no manipulator has.
    pub(super) fn of(legs: &[Leg; 6]) -> Option<Self> {
        let base: Option<Vec<Exact>> = legs.iter().map(|l| homogeneous(&l.base)).collect();
        let platform: Option<Vec<Exact>> = legs.iter().map(|l| homogeneous(&l.platform)).collect();
        let (base, platform) = (base?, platform?);
        let vectors = base.iter().zip(&platform).map(|(a, b)| product(a, b)).collect();
        Some(Self { base, platform, vectors })
    }

    /// Dimension of the flat of the base (or platform) ends of some legs.
    pub(super) fn dimension(&self, platform: bool, legs: &[usize]) -> usize {
        let ends = if platform { &self.platform } else { &self.base };
        let rows: Vec<Exact> = legs.iter().map(|i| ends[*i].clone()).collect();
        rank(&rows).saturating_sub(1)
    }

    /// Rank of the vectors of some legs.
    pub(super) fn leg_rank(&self, legs: &[usize]) -> usize {
        let rows: Vec<Exact> = legs.iter().map(|i| self.vectors[*i].clone()).collect();
        rank(&rows)
    }

    /// Whether a leg's vector is a combination of those of the six, as rational numbers.
    pub(super) fn contains(&self, leg: &Leg) -> bool {
        let Some(vector) =
            homogeneous(&leg.base).zip(homogeneous(&leg.platform)).map(|(a, b)| product(&a, &b))
        else {
            return false;
        };
        let mut rows = self.vectors.clone();
        rows.push(vector);
        let zero = Rational::from_integer(0.into());
        relations(&rows).iter().any(|c| c[self.vectors.len()] != zero)
    }

    /// Dimension of the space of `y` in the span of the other ends of `legs` for which `x (x) y` lies in the span of
    /// the vectors of `legs`; `x` is a base point, a platform point with `over_platform`.
    pub(super) fn fibre(&self, over_platform: bool, x: &Exact, legs: &[usize]) -> usize {
        self.partners(over_platform, x, legs, independent(&self.other_ends(over_platform, legs)))
    }

    /// The part of [`fibre`](Self::fibre) at infinity: with first entry 0.
    pub(super) fn fibre_at_infinity(&self, over_platform: bool, x: &Exact, legs: &[usize]) -> usize {
        let ends = independent(&self.other_ends(over_platform, legs));
        // all ends have first entry 1: the vectors of their span with first entry 0 are spanned by differences
        let differences = ends.iter().skip(1).map(|e| e.iter().zip(&ends[0]).map(|(x, y)| x - y).collect());
        let differences = differences.collect();
        self.partners(over_platform, x, legs, differences)
    }

    fn other_ends(&self, over_platform: bool, legs: &[usize]) -> Vec<Exact> {
        let others = if over_platform { &self.base } else { &self.platform };
        legs.iter().map(|i| others[*i].clone()).collect()
    }

    /// Dimension of the `y` in the span of independent `directions` for which `x (x) y` lies in the span of the vectors of `legs`.
    fn partners(&self, over_platform: bool, x: &Exact, legs: &[usize], directions: Vec<Exact>) -> usize {
        let mut rows: Vec<Exact> = legs.iter().map(|i| self.vectors[*i].clone()).collect();
        let leg_rank = rank(&rows);
        let count = directions.len();
        rows.extend(
            directions.into_iter().map(|y| if over_platform { product(&y, x) } else { product(x, &y) }),
        );
        leg_rank + count - rank(&rows)
    }
}

/// A maximal independent part of the rows, the first ones preferred.
fn independent(rows: &[Exact]) -> Vec<Exact> {
    let mut kept: Vec<Exact> = Vec::new();
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

    #[test]
    fn three_decimal_points_on_a_line_are_not_collinear_as_doubles_unless_they_are() {
        let leg = |x: f64, y: f64| Leg { base: Point3::new(x, y, 0.0), platform: Point3::new(0.0, 0.0, 1.0) };
        let legs = [leg(0.1, 0.1), leg(0.2, 0.2), leg(0.3, 0.3), leg(0.1, 0.3), leg(0.2, 0.6), leg(0.3, 0.9)];
        let e = ExactLegs::of(&legs).unwrap();
        assert_eq!(e.dimension(false, &[0, 1, 2]), 1);
        // 3 * 0.2 is not 0.6 as doubles
        assert_eq!(e.dimension(false, &[3, 4, 5]), 2);
        assert_eq!(e.dimension(true, &[0, 1, 2]), 0);
        // all legs meet the one platform point: every base point of the plane is replaceable
        assert_eq!(e.leg_rank(&[0, 1, 2, 3, 4, 5]), 3);
        assert_eq!(e.fibre(true, &e.platform[0], &[0, 1, 2, 3, 4, 5]), 3);
        assert_eq!(e.fibre(false, &e.base[0], &[0, 1, 2, 3, 4, 5]), 1);
    }
}
