//! The choice of the trilateration sequence for a design.

use thiserror::Error;

use platform::manipulator::Manipulator;
use platform::topology::{JointIndex, Nesting, Sequence, sequences, triples};

/// Why a design has no trilateration sequence.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum NoPlan {
    /// More virtual legs would be needed than allowed.
    #[error("the design needs {needed} virtual legs, but at most {allowed} are possible here")]
    TooManyVirtualLegs {
        /// Virtual legs that this topology needs.
        needed: usize,
        /// Largest number of virtual legs that was allowed.
        allowed: usize,
    },
    /// Every sequence starts from collinear joints.
    #[error("every trilateration sequence needs a triangle whose three joints are collinear in this design")]
    Collinear,
}

/// The sequences with fewest virtual legs for this design, best first: least [`Nesting`], then the fattest triangles.
///
/// Joints are numbered as in the design; those without a leg are left out. The start triangle and the bases of rigid
/// steps are the fattest there are, and never collinear within rounding.
///
/// # Errors
/// [`NoPlan`] when more than `allowed` virtual legs are needed, or all triangles are collinear.
pub fn plans(m: &Manipulator, allowed: usize) -> Result<Vec<Sequence>, NoPlan> {
    let legs = m.pairs();
    let found = (0..=3).map(|count| (count, sequences(&legs, count))).find(|(_, list)| !list.is_empty());
    let (needed, list) = found.unwrap_or((4, Vec::new()));
    if needed > allowed {
        return Err(NoPlan::TooManyVirtualLegs { needed, allowed });
    }
    let fitted = list.into_iter().filter_map(|s| fitted(m, s));
    let mut ranked: Vec<(Nesting, f64, Sequence)> =
        fitted.map(|(fatness, s)| (Nesting::of(&legs, &s), fatness, s)).collect();
    if ranked.is_empty() {
        return Err(NoPlan::Collinear);
    }
    ranked.sort_by(|x, y| x.0.cmp(&y.0).then(y.1.total_cmp(&x.1)));
    Ok(ranked.into_iter().map(|r| r.2).collect())
}

/// A sequence of the legs of `m` with the fattest start triangle of this design, and the fatness of the leanest
/// triangle that it needs; `None` when that is collinear.
#[must_use]
pub fn fit(m: &Manipulator, s: &Sequence) -> Option<(f64, Sequence)> {
    fitted(m, s.clone())
}

/// Fatness up to which three joints count as collinear, far above rounding.
const COLLINEAR: f64 = 1.0 / (1_u64 << 40) as f64;

/// Sixteen times the squared area of three joints of one body, in squares of the longest squared side: 3 for an
/// equilateral triangle, zero for collinear joints.
fn fatness(m: &Manipulator, three: [JointIndex; 3]) -> f64 {
    let p = three.map(|j| j.point(m));
    let [ij, ik, jk] = [(0, 1), (0, 2), (1, 2)].map(|(i, j)| (p[i] - p[j]).norm_squared());
    let largest = ij.max(ik).max(jk);
    if !(largest > 0.0) {
        return 0.0;
    }
    let (x, y, z) = (ij / largest, ik / largest, jk / largest);
    let twice_uv = x + y - z;
    4.0 * x * y - twice_uv * twice_uv
}

/// The sequence with the fattest start triangle, and the fatness of the leanest triangle that it needs; `None` when
/// that is collinear.
fn fitted(m: &Manipulator, mut s: Sequence) -> Option<(f64, Sequence)> {
    let on_first = |j: &JointIndex| j.same_body(s.start[0]);
    let first: Vec<JointIndex> =
        s.start.iter().copied().chain(s.steps.iter().map(|t| t.place).filter(on_first)).collect();
    let three: Vec<JointIndex> = s.unoriented().map(|t| t.place).collect();
    let second = [three[0], three[1], three[2]];
    let (_, start) = best_triangle(m, &first)?;
    let bases = s.unoriented().map(|t| t.from).filter(|f| f[0].same_body(f[1]) && f[0].same_body(f[2]));
    let needed = bases.chain([start, second]);
    let leanest = needed.map(|t| fatness(m, t)).fold(f64::INFINITY, f64::min);
    if leanest <= COLLINEAR {
        return None;
    }
    let others: Vec<JointIndex> = first.iter().copied().filter(|j| !start.contains(j)).collect();
    let (mut others, old) = (others.into_iter(), s.start[0]);
    for step in s.steps.iter_mut().filter(|t| t.rigid && t.place.same_body(old)) {
        step.from = start;
        step.place = others.next()?;
    }
    s.start = start;
    Some((leanest, s))
}

/// The fattest triangle of joints of one body, the first of equal ones.
fn best_triangle(m: &Manipulator, joints: &[JointIndex]) -> Option<(f64, [JointIndex; 3])> {
    let all = triples(joints).into_iter().map(|t| (fatness(m, t), t));
    all.fold(None, |best: Option<(f64, [JointIndex; 3])>, t| match best {
        Some(b) if b.0 >= t.0 => Some(b),
        _ => Some(t),
    })
}

#[cfg(test)]
mod tests;
