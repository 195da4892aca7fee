//! Proof that a cell is empty: a linear relaxation with a Farkas certificate that is judged in intervals.

use super::branch::Cell;
use super::conflict::Conflict;
use super::enclosure::point;
use super::limits::Limits;
use crate::num::conic::{Cone, ConicAnswer, ConicProgram};
use crate::num::farkas::{EnclosedRow, refuted};
use crate::num::interval::Interval;

/// The linear relaxation of order and spacing on a cell: every squared distance is replaced by affine
/// functions that are nowhere below it on the box, so that an infeasible relaxation proves the cell empty.
/// `det A` is not part of it; its range on the box is tested before.
fn relaxation(cell: &Cell, limits: &Limits) -> Vec<EnclosedRow> {
    let order = cell.order_rows().into_iter().map(|(i, j, [c, x, y])| EnclosedRow {
        coefficients: vec![(i, point(-x)), (j, point(-y))],
        rhs: point(c),
    });
    let spacing = (0..6).flat_map(|first| {
        limits
            .overestimates(first, &cell.outer)
            .map(|[c, x, y]| EnclosedRow { coefficients: vec![(first, -x), ((first + 2) % 6, -y)], rhs: c })
    });
    order.chain(spacing).collect()
}

/// A proved conflict of the cell, or `None` when the relaxation is feasible or nothing could be shown.
pub(crate) fn proved_empty(cell: &Cell, limits: &Limits) -> Option<Conflict> {
    let rows = relaxation(cell, limits);
    let centre = |x: &Interval| x.centre_and_radius().0;
    // the solver scales its rows itself, but not by the size of the design: squared distances are made of order one
    let largest = rows.iter().map(|r| centre(&r.rhs).abs()).fold(f64::MIN_POSITIVE, f64::max);
    let mut p = ConicProgram { variables: 6, linear: vec![0.0; 6], ..Default::default() };
    for r in &rows {
        let coefficients = r.coefficients.iter().map(|(j, a)| (*j, centre(a) / largest)).collect();
        p.at_least_zero(coefficients, centre(&r.rhs) / largest);
    }
    for (i, (low, high)) in cell.outer.into_iter().enumerate() {
        p.at_least_zero(vec![(i, 1.0)], high);
        p.at_least_zero(vec![(i, -1.0)], -low);
    }
    let ConicAnswer::Infeasible(ray) = p.solve() else { return None };
    // the ranges of the offsets take part as they are, without multipliers
    let ray = ray.get(..rows.len())?;
    let ranges: Option<Vec<Interval>> = cell.outer.iter().map(|b| Interval::new(b.0, b.1)).collect();
    let strength = refuted(&rows, &[Cone::NonNegative(rows.len())], ray, &ranges?)?;
    Some(Conflict::Combination { strength: strength / largest })
}

#[cfg(test)]
mod tests {
    use super::super::problem::OffsetProblem;
    use super::super::tests::{example, poses};
    use super::*;

    /// Two joints on platform edges, both near the common vertex, angle 60 degrees: with arms in `[m, 1.2 m]`
    /// the distance is at most `1.2 m`; with a wider requirement the box is empty, and so says the certificate.
    #[test]
    fn a_cell_without_room_is_proved_empty_and_one_with_room_is_not() {
        let mut p = OffsetProblem::with_defaults(example(), poses());
        p.min_joint_distance = 1.5;
        let mut bounds = [(0.3, 0.7); 6];
        (bounds[1], bounds[3]) = ((0.7, 0.75), (0.25, 0.3)); // arms 1.5 to 1.8 of edge 6
        let cell = Cell { branch: 364, bounds, outer: bounds, pairs: Vec::new(), sign: 1.0 };
        assert_eq!(proved_empty(&cell, &Limits::new(&p)), None);
        p.min_joint_distance *= 1.3;
        let proof = proved_empty(&cell, &Limits::new(&p));
        assert!(matches!(proof, Some(Conflict::Combination { strength }) if strength > 1e-6), "{proof:?}");
    }
}
