//! Families over a plane: the curve on which `M(a)` loses rank, and its parts.

use super::curves::{Part, PartKind, Split, split};
use super::decision::{Decision, Question};
use super::exact_curve::{ExactCurve, NoExactCurve};
use super::form::{Form, common_factor, determinant, incidence, line_basis, random_minor, random_vector};
use super::found::{Found, View};
use super::spectrum::{norm, unit};
use crate::num::Rng;
use crate::num::linalg::LinalgError;

/// What was found over the plane of one body.
#[derive(Debug, Clone)]
pub(super) struct PlaneSide {
    /// Rank of `M` at a generic point of the plane.
    pub(super) rank: usize,
    /// The curve on which the rank falls, of degree 0 where there is none.
    pub(super) form: Form,
    pub(super) split: Split,
    pub(super) decisions: Vec<Decision>,
    /// Families with the index of their part; `None` for one over the whole plane.
    pub(super) families: Vec<(Option<usize>, Found)>,
    /// Whether every part was understood.
    pub(super) complete: bool,
    /// The curve of the exact data.
    pub(super) exact: Result<ExactCurve, NoExactCurve>,
}

/// Random minors of order `rank`: their common divisor is that of all minors of this order.
fn minors(view: &View<'_>, rank: usize, rng: &mut Rng) -> Vec<Form> {
    let m = view.product.forms();
    let (height, width) = (m.len(), m.first().map_or(0, Vec::len));
    if height == rank && width == rank {
        return vec![determinant(&m)];
    }
    let mut one = || random_minor(&m, rank, rng);
    vec![one(), one()]
}

/// A common factor of all minors of order `rank` of a matrix of linear forms over a plane.
pub(super) fn plane_side(
    view: &View<'_>,
    exact: Result<ExactCurve, NoExactCurve>,
    rng: &mut Rng,
) -> Result<PlaneSide, LinalgError> {
    let generic = view.generic_rank(|rng| random_vector(rng, 3), rng)?;
    let rank = generic.value;
    let width = view.product.platform.dimension() + 1;
    let mut decisions = vec![generic];
    let mut families = Vec::new();
    let mut complete = true;
    if rank + 1 == width {
        match view.over_plane(generic)? {
            Some(found) => families.push((None, found)),
            None => complete = false,
        }
    } else if rank < width {
        complete = false;
    }
    let tolerance = view.tolerance;
    let list = minors(view, rank, rng);
    let form = match list.as_slice() {
        [only] => only.normalised(),
        [f, g] => {
            let (form, above, below) = common_factor(f, g, 10.0 * tolerance)?;
            decisions.push(Decision {
                question: Question::CommonFactor,
                value: form.degree,
                numerical: form.degree,
                exact: None,
                above,
                below,
                tolerance: 10.0 * tolerance,
            });
            form
        }
        _ => Form::constant(1.0),
    };
    let joints: Vec<Vec<f64>> = view.near.iter().map(|p| view.product.base.local(p)).collect();
    let split = split(&form, &joints, tolerance, rng)?;
    for (index, part) in split.parts.iter().enumerate() {
        let found = match part.kind {
            PartKind::Line => {
                let Some([p, q]) = line_points(&part.form, &joints, tolerance) else { continue };
                view.over_line(&p, &q, Some(rank - 1), rng)?
            }
            PartKind::Conic => view.over_conic(&part.form, rank - 1, rng)?,
            PartKind::Higher => {
                complete = false;
                None
            }
            // cubics are looked at with both bodies in view; the rest has no real curve
            PartKind::Cubic | PartKind::EmptyConic | PartKind::ComplexLines => None,
        };
        if let Some(mut found) = found {
            found.decisions.push(part_decision(part, &split, tolerance));
            families.push((Some(index), found));
        }
    }
    Ok(PlaneSide { rank, form, split, decisions, families, complete, exact })
}

/// The decision that made a part a part.
pub(super) fn part_decision(part: &Part, split: &Split, tolerance: f64) -> Decision {
    let line = part.kind == PartKind::Line;
    Decision {
        question: if line { Question::LineFactor } else { Question::ConicRank },
        value: if line { 1 } else { 3 },
        numerical: if line { 1 } else { 3 },
        exact: None,
        above: if line { split.rejected } else { Some(part.measure) },
        below: if line { Some(part.measure) } else { None },
        tolerance,
    }
}

/// Joints on a line of the plane.
pub(super) fn on_line(line: &Form, joints: &[Vec<f64>], tolerance: f64) -> Vec<usize> {
    let limit = (10.0 * tolerance).max(1e-8);
    (0..joints.len()).filter(|k| incidence(&line.coefficients, &joints[*k]).abs() <= limit).collect()
}

/// Two finite points of a line, first coordinate 1: two joints on it where there are two. `None` for the line at infinity.
pub(super) fn line_points(line: &Form, joints: &[Vec<f64>], tolerance: f64) -> Option<[Vec<f64>; 2]> {
    let on = on_line(line, joints, tolerance);
    if let Some(first) = on.first() {
        let apart = |k: &&usize| {
            let d: Vec<f64> = joints[**k].iter().zip(&joints[*first]).map(|(x, y)| x - y).collect();
            norm(&d) > 1e-3
        };
        if let Some(second) = on.iter().find(apart) {
            return Some([joints[*first].clone(), joints[*second].clone()]);
        }
    }
    let c = &line.coefficients;
    let normal = c[1].hypot(c[2]);
    if normal <= 1e-9 * c[0].abs() {
        return None;
    }
    let foot = [1.0, -c[0] * c[1] / (normal * normal), -c[0] * c[2] / (normal * normal)];
    Some([foot.to_vec(), vec![1.0, foot[1] - c[2] / normal, foot[2] + c[1] / normal]])
}

/// Random points of a part, first those with real coordinates found on random lines.
pub(super) fn points_of(form: &Form, count: usize, rng: &mut Rng) -> Result<Vec<Vec<f64>>, LinalgError> {
    let mut out = Vec::new();
    for _ in 0..40 {
        let [p, q] = line_basis(&random_vector(rng, 3));
        for s in super::spectrum::real_roots(&form.on_line(&p, &q))? {
            out.push(unit(&p.iter().zip(&q).map(|(x, y)| x + s * y).collect::<Vec<f64>>()));
        }
        if out.len() >= count {
            break;
        }
    }
    Ok(out)
}
