//! Families over a plane: the curve on which `M(a)` loses rank, its parts, and the points at which the rank falls by
//! two. Two planes also have a correspondence between their curves.

use nalgebra::{Point3, Vector3};

use super::exact_curve::{ExactCurve, NoExactCurve};
use super::flats::{ClosedPair, FlatProduct};
use super::form::{
    Form, PartKind, RealPart, SingularKind, SplitCurve, common_factor, cross, exponents, incidence, index,
    line_basis, on_line, power, random_minor, random_vector, same_point, singular_kind, singular_point,
    split,
};
use super::found::{FoundComponents, View};
use super::shape::frame;
use super::spectrum::{
    APART, AT_INFINITY, COMPUTED, Decision, NO_DIMENSION, Question, SAME, Spectrum, dot, least_squares,
    nearness, norm, unit,
};
use crate::leg_vector::Normalisation;
use num::Rng;
use num::linalg::{LinalgError, eigenvalues};
use platform::manipulator::Body;

/// Results for the plane of one body.
#[derive(Debug, Clone)]
pub(super) struct PlaneSide {
    /// Rank of `M` at a generic point of the plane.
    pub(super) rank: usize,
    /// The curve on which the rank falls, of degree 0 if there is none.
    pub(super) form: Form,
    pub(super) split: SplitCurve,
    pub(super) decisions: Vec<Decision>,
    /// Families with the index of their part; `None` for one over the whole plane.
    pub(super) families: Vec<(Option<usize>, FoundComponents)>,
    /// Whether every part was classified.
    pub(super) complete: bool,
    /// The curve of the exact data.
    pub(super) exact: Result<ExactCurve, NoExactCurve>,
}

/// Random minors of order `rank`: their common divisor is that of all minors of this order.
fn minors(view: &View<'_>, rank: usize, rng: &mut Rng) -> Vec<Form> {
    let m = view.product.forms();
    let (height, width) = (m.len(), m.first().map_or(0, Vec::len));
    if height == rank && width == rank {
        return vec![Form::determinant(&m)];
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
            let (form, above, below) = common_factor(f, g, COMPUTED * tolerance)?;
            decisions.push(Decision {
                question: Question::CommonFactor,
                value: form.degree,
                numerical: form.degree,
                exact: None,
                above,
                below,
                tolerance: COMPUTED * tolerance,
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
            // cubics need both bodies; the other kinds have no real curve
            PartKind::Cubic | PartKind::EmptyConic | PartKind::ComplexLines => None,
        };
        if let Some(mut found) = found {
            found.decisions.push(part_decision(part, &split, tolerance));
            families.push((Some(index), found));
        }
    }
    Ok(PlaneSide { rank, form, split, decisions, families, complete, exact })
}

/// The decision that established a part.
fn part_decision(part: &RealPart, split: &SplitCurve, tolerance: f64) -> Decision {
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
pub(super) fn joints_on_line(line: &Form, joints: &[Vec<f64>], tolerance: f64) -> Vec<usize> {
    let limit = nearness(tolerance);
    (0..joints.len()).filter(|k| incidence(&line.coefficients, &joints[*k]).abs() <= limit).collect()
}

/// Two finite points of a line, first coordinate 1: two joints on it if it has two. `None` for the line at infinity.
pub(super) fn line_points(line: &Form, joints: &[Vec<f64>], tolerance: f64) -> Option<[Vec<f64>; 2]> {
    let on = joints_on_line(line, joints, tolerance);
    if let Some(first) = on.first() {
        let apart = |k: &&usize| {
            let d: Vec<f64> = joints[**k].iter().zip(&joints[*first]).map(|(x, y)| x - y).collect();
            norm(&d) > APART
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

/// Random points of a part, starting with real ones on random lines.
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

/// Functionals on the forms of degree `j` (cubics for a space over a plane) that vanish on the minors of order `j`.
fn functionals(view: &View<'_>, rng: &mut Rng) -> Result<Vec<Vec<f64>>, LinalgError> {
    let m = view.product.forms();
    let order = view.product.platform.dimension();
    let all = (order + 1) * (order + 2) / 2;
    let mut rows = Vec::new();
    for _ in 0..2 * all {
        rows.push(unit(&random_minor(&m, order, rng).coefficients));
    }
    let s = Spectrum::of(&rows, all)?;
    Ok(s.kernel(s.rank(COMPUTED * view.tolerance * s.values[0])).to_vec())
}

/// Number of independent conditions on forms from the points of rank `j - 1` or less. It is ten minus the dimension of
/// the span of the minors of order `j`, cubics for a space over a plane. Zero shows that there is no such point.
pub(super) fn conditions(view: &View<'_>, rng: &mut Rng) -> Result<usize, LinalgError> {
    Ok(functionals(view, rng)?.len())
}

/// The points of rank `j - 1` or less, and the number of complex ones. They must be finitely many, simple, and no more
/// than forms of degree `j - 1` can separate.
///
/// The functionals are combinations of the values at the points. So `d(x_k q)` for forms `q` of degree `j - 1` is
/// `C P_k V` with diagonal `P_k`, the coordinates of the points, and `(C P_k V) (C P_l V)^+ = C P_k / P_l C^-1`.
pub(super) fn located(view: &View<'_>, rng: &mut Rng) -> Result<(Vec<Vec<f64>>, usize), LinalgError> {
    let dual = functionals(view, rng)?;
    let degree = view.product.platform.dimension();
    if dual.is_empty() || dual.len() > degree * (degree + 1) / 2 {
        return Ok((Vec::new(), 0));
    }
    let times = |d: &Vec<f64>, l: &[f64]| -> Vec<f64> {
        let at = |e: [usize; 3], k: usize| {
            let mut up = e;
            up[k] += 1;
            l[k] * d[index(up)]
        };
        exponents(degree - 1).map(|e| (0..3).map(|k| at(e, k)).sum()).collect()
    };
    let base = random_vector(rng, 3);
    let columns: Vec<Vec<f64>> = dual.iter().map(|d| times(d, &base)).collect();
    // the matrix of multiplication by l / base
    let multiplication = |l: &[f64]| -> Result<Vec<Vec<f64>>, LinalgError> {
        dual.iter().map(|d| Ok(least_squares(&columns, &times(d, l))?.0)).collect()
    };
    let general = multiplication(&random_vector(rng, 3))?;
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let parts = [multiplication(&axes[0])?, multiplication(&axes[1])?, multiplication(&axes[2])?];
    let (mut points, mut complex) = (Vec::new(), 0);
    for value in eigenvalues(&general)? {
        if value.im.abs() > 1e-7 * value.norm() {
            complex += 1;
            continue;
        }
        let mut shifted = general.clone();
        for (k, row) in shifted.iter_mut().enumerate() {
            row[k] -= value.re;
        }
        let Some(v) = Spectrum::of(&shifted, dual.len())?.vectors.pop() else { continue };
        let applied = |m: &Vec<Vec<f64>>| m.iter().zip(&v).map(|(row, x)| x * dot(row, &v)).sum::<f64>();
        points.push(unit(&parts.each_ref().map(applied)));
    }
    Ok((points, complex))
}

/// Number of independent conditions for forms of a degree to vanish at these points.
pub(super) fn conditions_of(points: &[Vec<f64>], degree: usize) -> Result<usize, LinalgError> {
    let monomials = |p: &Vec<f64>| {
        exponents(degree).map(|e| (0..3).map(|k| power(p[k], e[k])).product()).collect::<Vec<f64>>()
    };
    let rows: Vec<Vec<f64>> = points.iter().map(|p| unit(&monomials(p))).collect();
    Ok(Spectrum::of(&rows, (degree + 1) * (degree + 2) / 2)?.rank(1e-7))
}

/// Joints and intersections of lines through joints, homogeneous.
pub(super) fn candidates(joints: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut lines: Vec<Vec<f64>> = Vec::new();
    for (k, p) in joints.iter().enumerate() {
        for q in &joints[..k] {
            let line = cross(&unit(p), &unit(q));
            if norm(&line) > SAME {
                lines.push(unit(&line));
            }
        }
    }
    let mut out: Vec<Vec<f64>> = joints.iter().map(|p| unit(p)).collect();
    for (k, l) in lines.iter().enumerate() {
        for m in &lines[..k] {
            let p = cross(l, m);
            if norm(&p) > SAME {
                out.push(unit(&p));
            }
        }
    }
    out
}

/// A part of a plane curve.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema), schemars(rename = "CurvePartRecord", transform = num::nullable))]
pub struct CurvePart {
    /// Kind.
    #[cfg_attr(feature = "serde", schemars(extend("enum" = ["line", "conic", "conic_without_real_points", "conjugate_lines", "cubic", "higher"])))]
    pub kind: PartKind,
    /// Coefficients in monomial order.
    pub coefficients: Vec<f64>,
    /// Its multiplicity.
    pub multiplicity: usize,
    /// Measure for the kind.
    // the residual of the curve on a line, or the ratio of eigenvalues of a conic
    pub measure: f64,
}

/// A singular point of the curve in a plane.
#[derive(Debug, Clone, PartialEq)]
pub struct SingularPoint {
    /// Homogeneous plane coordinates, of norm 1.
    pub coordinates: [f64; 3],
    /// The point, `None` at infinity.
    pub point: Option<Point3<f64>>,
    /// The kind of the singular point.
    pub kind: SingularKind,
    /// Norm of the gradient there over the norm of the form.
    pub gradient: f64,
    /// Whether a whole line of the other plane corresponds to it: `M` has rank 1 there.
    pub line_of_partners: bool,
}

/// The points of one plane that carry replaceable legs.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneCurve {
    /// The body.
    pub body: Body,
    /// Origin of the plane coordinates, design units, frame of the body.
    pub origin: Point3<f64>,
    /// Axes: the point `(x, y)` is `origin + x axes_0 + y axes_1`. They are orthogonal and as long as the reach of the
    /// joints.
    pub axes: [Vector3<f64>; 2],
    /// Degree of the curve; 0 without a curve, or if the whole plane has replaceable legs.
    pub degree: usize,
    /// Coefficients of `1, x, y, x^2, x y, y^2, ..` (norm of Bombieri 1, the largest positive).
    pub coefficients: Vec<f64>,
    /// Rank of `M` at a generic point of the plane: below 3 every point carries a replaceable leg.
    pub generic_rank: usize,
    /// Lines, conics and the rest.
    pub parts: Vec<CurvePart>,
    /// Singular points found.
    pub singular_points: Vec<SingularPoint>,
    /// The numbers of the decisions.
    pub decisions: Vec<Decision>,
    /// The same curve with the joints as rational numbers, and its factors over the complex numbers.
    pub exact: Result<ExactCurve, NoExactCurve>,
}

/// Two planes, with the correspondence of their points.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanePair {
    /// Index of the pair of flats.
    pub pair: usize,
    /// Base plane.
    pub base: PlaneCurve,
    /// Platform plane.
    pub platform: PlaneCurve,
    /// `sum_pq equations[r][p][q] alpha_p beta_q = 0` for the legs, `alpha = (1, x, y)` on the base and `beta` on the
    /// platform.
    pub equations: Vec<[[f64; 3]; 3]>,
    /// `Some(true)`: the exact cubic of the base plane is proved to be smooth, so it is irreducible. `Some(false)`: it
    /// has a singular point. `None`: there is no exact cubic, or its numbers are too long.
    pub smooth: Option<bool>,
}

/// The partners of a point.
#[derive(Debug, Clone, PartialEq)]
pub enum Partners {
    /// None: the point is not on the curve.
    None,
    /// One point, homogeneous plane coordinates.
    Point([f64; 3]),
    /// A line, spanned by two points.
    Line([[f64; 3]; 2]),
    /// The whole plane.
    Plane,
}

impl PlanePair {
    /// The points of the other plane that form a replaceable leg with a point of the plane of `body`. Singular values
    /// of `M` up to `limit` (unit equations, unit point) count as zero.
    ///
    /// # Errors
    /// When the decomposition does not converge.
    pub fn partners(&self, body: Body, point: [f64; 3], limit: f64) -> Result<Partners, LinalgError> {
        let x = unit(&point);
        let entry = |n: &[[f64; 3]; 3], k: usize| -> f64 {
            (0..3).map(|p| x[p] * if body == Body::Base { n[p][k] } else { n[k][p] }).sum()
        };
        let rows: Vec<Vec<f64>> =
            self.equations.iter().map(|n| (0..3).map(|k| entry(n, k)).collect()).collect();
        let s = Spectrum::of(&rows, 3)?;
        let vector = |k: usize| [0, 1, 2].map(|i| s.vectors[k][i]);
        Ok(match s.rank(limit) {
            3 => Partners::None,
            2 => Partners::Point(vector(2)),
            1 => Partners::Line([vector(1), vector(2)]),
            _ => Partners::Plane,
        })
    }
}

/// The record of a closed pair of planes.
pub(super) fn plane_pair(
    index: usize,
    pair: &ClosedPair,
    sides: (&PlaneSide, &PlaneSide),
    n: &Normalisation,
    tolerance: f64,
    rng: &mut Rng,
) -> Result<PlanePair, LinalgError> {
    let frames = [
        frame(&pair.product.base, n.base_centre.coords, n.base_unit),
        frame(&pair.product.platform, n.platform_centre.coords, n.platform_unit),
    ];
    let turned = pair.product.exchanged();
    let matrix = |e: &Vec<f64>| [0, 1, 2].map(|p| [0, 1, 2].map(|q| e[p * 3 + q]));
    Ok(PlanePair {
        pair: index,
        base: curve(Body::Base, frames[0], sides.0, &pair.product, tolerance, rng)?,
        platform: curve(Body::Platform, frames[1], sides.1, &turned, tolerance, rng)?,
        equations: pair.product.equations.iter().map(matrix).collect(),
        smooth: sides.0.exact.as_ref().ok().and_then(|c| c.smooth),
    })
}

fn curve(
    body: Body,
    frame: [Vector3<f64>; 3],
    side: &PlaneSide,
    product: &FlatProduct,
    tolerance: f64,
    rng: &mut Rng,
) -> Result<PlaneCurve, LinalgError> {
    let (points, gap) = singular_points(side, tolerance, rng)?;
    let mut singular = Vec::new();
    for p in points {
        let s = product.spectrum(&p)?;
        let affine = frame[0] + frame[1] * (p[1] / p[0]) + frame[2] * (p[2] / p[0]);
        let gradient: Vec<f64> = side.form.gradient().iter().map(|d| d.value(&p)).collect();
        singular.push(SingularPoint {
            coordinates: [p[0], p[1], p[2]],
            point: (p[0].abs() > AT_INFINITY).then(|| Point3::from(affine)),
            kind: singular_kind(&side.form, &p),
            gradient: norm(&gradient) / side.form.norm(),
            line_of_partners: s.rank((COMPUTED * tolerance).max(NO_DIMENSION)) < 2,
        });
    }
    let mut decisions = side.decisions.clone();
    decisions.extend(gap);
    let part = |p: &super::form::RealPart| CurvePart {
        kind: p.kind,
        coefficients: p.form.coefficients.clone(),
        multiplicity: p.multiplicity,
        measure: p.measure,
    };
    Ok(PlaneCurve {
        body,
        origin: Point3::from(frame[0]),
        axes: [frame[1], frame[2]],
        degree: side.form.degree,
        coefficients: side.form.coefficients.clone(),
        generic_rank: side.rank,
        parts: side.split.parts.iter().map(part).collect(),
        singular_points: singular,
        decisions,
        exact: side.exact.clone(),
    })
}

/// Real singular points: intersections of parts, and those of an irreducible part.
fn singular_points(
    side: &PlaneSide,
    tolerance: f64,
    rng: &mut Rng,
) -> Result<(Vec<Vec<f64>>, Option<Decision>), LinalgError> {
    let mut out: Vec<Vec<f64>> = Vec::new();
    let mut add = |p: Vec<f64>| {
        // a tangent line of a conic meets it in a double root, accurate to the square root of rounding
        if !out.iter().any(|q| same_point(q, &p, SAME)) {
            out.push(p);
        }
    };
    let parts = &side.split.parts;
    for (k, line) in parts.iter().enumerate().filter(|(_, p)| p.kind == PartKind::Line) {
        for other in parts.iter().enumerate().filter(|(l, p)| *l > k || p.kind != PartKind::Line) {
            for p in on_line(&line.form, &other.1.form)? {
                add(p);
            }
        }
    }
    let mut decision = None;
    for part in parts.iter().filter(|p| matches!(p.kind, PartKind::Cubic | PartKind::ComplexLines)) {
        let (p, size) = singular_point(&part.form, rng)?;
        let limit = (COMPUTED * tolerance).max(1e-12);
        if part.kind == PartKind::Cubic {
            let is = usize::from(size <= limit);
            decision = Some(Decision {
                question: Question::SingularPoint,
                value: is,
                numerical: is,
                exact: None,
                above: (size > limit).then_some(size),
                below: (size <= limit).then_some(size),
                tolerance: limit,
            });
        }
        if size <= limit {
            add(p);
        }
    }
    Ok((out, decision))
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::super::flats::{Flat, FlatProduct};
    use super::super::form::same_point;
    use super::*;

    /// Legs between two base lines and two platform lines, three each: the intersection of the base lines has a line of
    /// partners.
    #[test]
    fn the_crossing_of_two_pairings_is_located_and_nothing_in_a_general_design() {
        let mut rng = Rng::new(41);
        let mut p = || Vector3::new(rng.normal(), rng.normal(), rng.normal());
        let (o, d, e, q) = (p(), p(), p(), [p(), p(), p(), p()]);
        let t = [0.5, 1.2, -0.7, 0.9, -1.1, 0.4];
        let ends: Vec<(Vector3<f64>, Vector3<f64>)> = (0..6)
            .map(|k| {
                let (direction, line) = if k < 3 { (d, [q[0], q[1]]) } else { (e, [q[2], q[3]]) };
                (o + direction * (1.0 + 0.3 * t[k]), line[0] + line[1] * t[(k * k + 1) % 6])
            })
            .collect();
        for general in [false, true] {
            let mut ends = ends.clone();
            if general {
                // still in the plane
                ends[0].0 += e * 0.4;
                ends[4].1 += d;
            }
            let (near, far): (Vec<_>, Vec<_>) = ends.iter().copied().unzip();
            let flats = (Flat::nearest(&near, 2).unwrap(), Flat::nearest(&far, 3).unwrap());
            let product = FlatProduct::new(flats.0, flats.1, &ends, None, 1e-9).unwrap();
            let view =
                View { product: &product, carrying: Body::Base, near: &near, far: &far, tolerance: 1e-9 };
            let (points, complex) = located(&view, &mut Rng::new(42)).unwrap();
            let found = points.iter().any(|x| same_point(x, &product.base.local(&o), 1e-8));
            assert_eq!((found, complex), (!general, 0), "{points:?}");
            assert_eq!(conditions(&view, &mut Rng::new(43)).unwrap(), points.len());
        }
    }
}
