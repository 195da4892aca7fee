//! Farkas certificates checked in intervals.
//!
//! Let the rows `rhs - coefficients . x` be in a cone `K`, and `y` a vector of the dual cone. Every `x` that meets the
//! rows satisfies `0 <= y . (rhs - A x)`. If the right side is negative for all data in their intervals and all `x` of
//! a box, no such `x` meets the rows. (Farkas 1902; for cones Boyd, Vandenberghe 2004, sec. 5.8.) The proof is valid
//! for any `y`, whatever its origin.

use super::conic::Cone;
use super::interval::Interval;

/// `rhs - sum coefficients x` with data in intervals.
#[derive(Debug, Clone)]
pub struct EnclosedRow {
    /// Pairs of variable and coefficient.
    pub coefficients: Vec<(usize, Interval)>,
    /// The constant.
    pub rhs: Interval,
}

/// Distance of the combination of the rows below 0 on the box, for `|y|_1 = 1`; `None` if it is not below, so that
/// nothing is proved.
pub fn refuted(rows: &[EnclosedRow], cones: &[Cone], ray: &[f64], ranges: &[Interval]) -> Option<f64> {
    let weights = in_dual_cone(cones, ray)?;
    if rows.len() != weights.len() {
        return None;
    }
    let mut pull = vec![Interval::ZERO; ranges.len()];
    let mut total = Interval::ZERO;
    for (row, y) in rows.iter().zip(&weights) {
        let y = Interval::point(*y)?;
        total = total + y * row.rhs;
        for &(j, a) in &row.coefficients {
            let sum = pull.get_mut(j)?;
            *sum = *sum + y * a;
        }
    }
    for (pull, x) in pull.into_iter().zip(ranges) {
        total = total - pull * *x;
    }
    let norm: f64 = weights.iter().map(|y| y.abs()).sum();
    (total.hi() < 0.0 && norm > 0.0).then(|| -total.hi() / norm)
}

/// A ray near the given one that is certainly in the dual cone; the cones are their own duals.
fn in_dual_cone(cones: &[Cone], ray: &[f64]) -> Option<Vec<f64>> {
    let mut out = ray.to_vec();
    let mut rest = out.as_mut_slice();
    for cone in cones {
        let (Cone::NonNegative(n) | Cone::SecondOrder(n)) = *cone;
        let (block, others) = rest.split_at_mut_checked(n)?;
        match cone {
            Cone::NonNegative(_) => block.iter_mut().for_each(|y| *y = y.max(0.0)),
            Cone::SecondOrder(_) => {
                let (head, tail) = block.split_first_mut()?;
                let norm =
                    tail.iter().map(|y| Interval::from(*y).square()).fold(Interval::ZERO, |s, x| s + x);
                *head = head.max(norm.sqrt()?.hi());
            }
        }
        rest = others;
    }
    (rest.is_empty() && out.iter().all(|y| y.is_finite())).then_some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(coefficients: &[(usize, f64)], rhs: f64) -> EnclosedRow {
        EnclosedRow {
            coefficients: coefficients.iter().map(|&(j, a)| (j, a.into())).collect(),
            rhs: rhs.into(),
        }
    }

    #[test]
    fn a_gap_of_one_double_is_seen_and_equality_refutes_nothing() {
        let cones = [Cone::NonNegative(2)];
        let ranges = [Interval::new(-10.0, 10.0).unwrap()];
        // x <= 1 and x >= limit
        let rows = |limit: f64| [row(&[(0, 1.0)], 1.0), row(&[(0, -1.0)], -limit)];
        assert!(refuted(&rows(1.0 + 1e-12), &cones, &[1.0, 1.0], &ranges).is_none_or(|s| s < 1e-12));
        assert!(refuted(&rows(1.0), &cones, &[1.0, 1.0], &ranges).is_none());
        assert!(refuted(&rows(1.1), &cones, &[1.0, 1.0], &ranges).is_some_and(|s| s > 0.04));
        // weights that do not cancel prove nothing over a wide box, but do over a narrow one
        assert!(refuted(&rows(1.1), &cones, &[1.0, 1.1], &ranges).is_none());
        let narrow = [Interval::new(0.9, 1.2).unwrap()];
        assert!(refuted(&rows(1.1), &cones, &[1.0, 1.01], &narrow).is_some());
        // a negative weight counts as zero
        assert!(refuted(&rows(1.1), &cones, &[-1.0, 1.0], &ranges).is_none());
    }

    #[test]
    fn a_cone_and_a_half_plane_outside_of_it() {
        // |(x, y)| <= 1 and x >= 1.5, weights (1, -1, 0) and 1; a head that is short of the norm is raised
        let rows = [row(&[], 1.0), row(&[(0, -1.0)], 0.0), row(&[(1, -1.0)], 0.0), row(&[(0, -1.0)], -1.5)];
        let cones = [Cone::SecondOrder(3), Cone::NonNegative(1)];
        let ranges = [Interval::new(-9.0, 9.0).unwrap(); 2];
        assert!(refuted(&rows, &cones, &[1.0, -1.0, 0.0, 1.0], &ranges).is_some());
        assert!(refuted(&rows, &cones, &[0.5, -1.0, 0.0, 1.0], &ranges).is_some());
        assert!(refuted(&rows, &cones, &[1.0, 1.0, 0.0, 1.0], &ranges).is_none());
        assert!(refuted(&rows, &cones, &[1.0, -1.0, 0.0], &ranges).is_none());
        assert!(refuted(&rows, &cones, &[1.0, f64::NAN, 0.0, 1.0], &ranges).is_none());
    }
}
