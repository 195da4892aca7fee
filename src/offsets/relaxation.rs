//! Proof that a cell is empty: a linear relaxation with a re-checked Farkas certificate.

use super::branch::Cell;
use super::conflict::Conflict;
use super::problem::Model;
use super::spacing::Pair;
use crate::num::conic::{ConicAnswer, ConicProgram};

/// The linear relaxation of box, order and spacing on a cell: every spacing quadratic is replaced by affine
/// functions that are nowhere below it on the box, so that an infeasible relaxation proves the cell empty.
/// `det A` is not part of it; its range on the box is exact and tested before.
fn relaxation(cell: &Cell, m: &Model) -> ConicProgram {
    let mut p = ConicProgram { variables: 6, linear: vec![0.0; 6], ..Default::default() };
    for (i, (low, high)) in cell.bounds.into_iter().enumerate() {
        p.at_least_zero(vec![(i, 1.0)], high);
        p.at_least_zero(vec![(i, -1.0)], -low);
    }
    for (i, j, [c, x, y]) in cell.order_rows() {
        p.at_least_zero(vec![(i, -x), (j, -y)], c);
    }
    let required = m.spacing * m.spacing;
    for pair in Pair::all(&m.sides) {
        for [c, x, y] in pair.overestimates(pair.box_of(&cell.bounds)) {
            p.at_least_zero(vec![(pair.first, -x), (pair.second, -y)], c - required);
        }
    }
    p
}

/// A proved conflict of the cell, or `None` when the relaxation is feasible or nothing could be shown.
pub(crate) fn proved_empty(cell: &Cell, m: &Model) -> Option<Conflict> {
    let p = relaxation(cell, m);
    let radius = cell.bounds.iter().map(|b| b.0.abs().max(b.1.abs())).fold(0.0, f64::max);
    match p.solve() {
        ConicAnswer::Infeasible(ray) => {
            p.farkas_strength(&ray, radius).map(|strength| Conflict::Combination { strength })
        }
        ConicAnswer::Point(_) | ConicAnswer::Failed(_) => None,
    }
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
        let m = Model::new(&p);
        let mut bounds = [(0.3, 0.7); 6];
        (bounds[1], bounds[3]) = ((0.7, 0.75), (0.25, 0.3)); // arms 1.5 to 1.8 of edge 6
        let cell = |bounds| Cell { branch: 364, bounds, pairs: Vec::new(), sign: 1.0 };
        assert_eq!(proved_empty(&cell(bounds), &m), None);
        let wide = Model { spacing: m.spacing * 1.3, ..m.clone() };
        let proof = proved_empty(&cell(bounds), &wide);
        assert!(matches!(proof, Some(Conflict::Combination { strength }) if strength > 1e-6), "{proof:?}");
    }
}
