//! Plane curves that split: lines, conics, what is left, and singular points.

use nalgebra::Matrix3;

use super::form::{Form, cross, line_basis, random_vector};
use super::spectrum::{least_squares, norm, real_roots, unit, without};
use crate::num::Rng;
use crate::num::linalg::LinalgError;
use crate::num::small::symmetric_eigen3;

/// A part of a plane curve that does not split further over the reals.
#[derive(Debug, Clone)]
pub(super) struct Part {
    pub(super) form: Form,
    pub(super) kind: PartKind,
    /// How often it divides the curve.
    pub(super) multiplicity: usize,
    /// Residual of the curve on the line, or the ratio of eigenvalues of the conic that was closest to a decision.
    pub(super) measure: f64,
}

/// Kinds of parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum PartKind {
    /// A real line.
    Line,
    /// A conic with real points.
    Conic,
    /// A conic without real points.
    EmptyConic,
    /// Two conjugate complex lines: one real point.
    ComplexLines,
    /// A cubic that contains no real line.
    Cubic,
    /// A curve of higher degree that contains no real line.
    Higher,
}

impl PartKind {
    /// The name used in JSON.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Line => "line",
            Self::Conic => "conic",
            Self::EmptyConic => "conic_without_real_points",
            Self::ComplexLines => "conjugate_lines",
            Self::Cubic => "cubic",
            Self::Higher => "higher",
        }
    }
}

/// A curve in parts.
#[derive(Debug, Clone, Default)]
pub(super) struct Split {
    pub(super) parts: Vec<Part>,
    /// The smallest residual of a line that was not accepted.
    pub(super) rejected: Option<f64>,
}

/// Splits a form into real lines, conics and the rest. `points` are points known to lie on it: the lines through two of
/// them are tried first, because they are known best.
pub(super) fn split(
    form: &Form,
    points: &[Vec<f64>],
    tolerance: f64,
    rng: &mut Rng,
) -> Result<Split, LinalgError> {
    let mut out = Split::default();
    let mut rest = form.normalised();
    while rest.degree > 0 {
        let (best, measure) = best_line(&rest, points, tolerance, rng)?;
        if rest.degree == 1 || measure <= tolerance {
            let line = if rest.degree == 1 { rest.clone() } else { Form::linear(&best) };
            push(&mut out, Part { form: line.normalised(), kind: PartKind::Line, multiplicity: 1, measure });
            rest = rest.divided(&line)?.0.normalised();
            continue;
        }
        out.rejected = Some(out.rejected.map_or(measure, |r: f64| r.min(measure)));
        let (kind, measure) = match rest.degree {
            2 => conic_kind(&rest, tolerance),
            3 => (PartKind::Cubic, measure),
            _ => (PartKind::Higher, measure),
        };
        out.parts.push(Part { form: rest.clone(), kind, multiplicity: 1, measure });
        break;
    }
    Ok(out)
}

fn push(out: &mut Split, part: Part) {
    let same = |p: &&mut Part| {
        p.kind == PartKind::Line
            && norm(&cross(&unit(&p.form.coefficients), &unit(&part.form.coefficients))) < 1e-6
    };
    match out.parts.iter_mut().find(same) {
        Some(old) => old.multiplicity += 1,
        None => out.parts.push(part),
    }
}

/// The line on which the form is smallest, out of those through two known points and those through intersections with
/// two random lines: a line of the curve meets these in two of them.
fn best_line(
    form: &Form,
    points: &[Vec<f64>],
    tolerance: f64,
    rng: &mut Rng,
) -> Result<(Vec<f64>, f64), LinalgError> {
    let mut best = (vec![1.0, 0.0, 0.0], f64::MAX);
    let consider = |best: &mut (Vec<f64>, f64), line: Vec<f64>| {
        if norm(&line) > 1e-9 {
            let residual = form.residual_on_line(&unit(&line));
            if residual < best.1 {
                *best = (unit(&line), residual);
            }
        }
    };
    for (k, p) in points.iter().enumerate() {
        for q in &points[..k] {
            consider(&mut best, cross(&unit(p), &unit(q)));
        }
    }
    // a line through two known points that fits is not replaced by a nearby one known less well
    if best.1 <= tolerance {
        return Ok(best);
    }
    let mut sections: Vec<Vec<Vec<f64>>> = Vec::new();
    for _ in 0..2 {
        let [p, q] = line_basis(&random_vector(rng, 3));
        let roots = real_roots(&form.on_line(&p, &q))?;
        sections.push(roots.iter().map(|s| p.iter().zip(&q).map(|(x, y)| x + s * y).collect()).collect());
    }
    for p in &sections[0] {
        for q in &sections[1] {
            consider(&mut best, cross(&unit(p), &unit(q)));
        }
    }
    Ok(best)
}

/// Eigenvalues, those of largest modulus first, and eigenvectors of the symmetric matrix of a conic.
fn eigen(form: &Form) -> Vec<(f64, Vec<f64>)> {
    let c = &form.coefficients;
    let (xy, xz, yz) = (c[1] / 2.0, c[2] / 2.0, c[4] / 2.0);
    let (values, vectors) = symmetric_eigen3(&Matrix3::new(c[0], xy, xz, xy, c[3], yz, xz, yz, c[5]));
    let vector = |k: usize| vectors.column(k).iter().copied().collect::<Vec<f64>>();
    let mut pairs: Vec<(f64, Vec<f64>)> = (0..3).map(|k| (values[k], vector(k))).collect();
    pairs.sort_by(|x, y| y.0.abs().total_cmp(&x.0.abs()));
    pairs
}

fn conic_kind(form: &Form, tolerance: f64) -> (PartKind, f64) {
    let e = eigen(form);
    let ratio = (e[2].0 / e[0].0).abs();
    if ratio <= tolerance {
        return (PartKind::ComplexLines, ratio);
    }
    let one_sign = e.iter().all(|x| x.0 > 0.0) || e.iter().all(|x| x.0 < 0.0);
    (if one_sign { PartKind::EmptyConic } else { PartKind::Conic }, ratio)
}

/// Columns `x, y, z` with the conic `{ (1 - t^2) x + 2 t y + (1 + t^2) z }`.
pub(super) fn conic_frame(form: &Form) -> [Vec<f64>; 3] {
    let e = eigen(form);
    let positive = e.iter().filter(|x| x.0 > 0.0).count();
    // the one eigenvalue of its sign belongs to z
    let alone = |x: &(f64, Vec<f64>)| if positive == 1 { x.0 > 0.0 } else { x.0 < 0.0 };
    let scale = |(value, v): &(f64, Vec<f64>)| v.iter().map(|c| c / value.abs().sqrt()).collect::<Vec<f64>>();
    let z = e.iter().find(|x| alone(x)).map(scale).unwrap_or_default();
    let mut others = e.iter().filter(|x| !alone(x)).map(scale);
    let x = others.next().unwrap_or_default();
    [x, others.next().unwrap_or_default(), z]
}

/// What a curve looks like at a singular point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum SingularKind {
    /// Two real branches cross.
    Crossing,
    /// An isolated real point: two complex branches.
    Isolated,
    /// The two branches have one tangent: a cusp, or parts that touch.
    Cusp,
    /// Three branches or a multiple part.
    Triple,
}

impl SingularKind {
    /// The name used in JSON.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Crossing => "crossing",
            Self::Isolated => "isolated",
            Self::Cusp => "cusp",
            Self::Triple => "triple",
        }
    }
}

/// Kind of the singular point `p` of `form`, from the second derivatives along the tangent plane at `p`.
pub(super) fn singular_kind(form: &Form, p: &[f64]) -> SingularKind {
    let p = unit(p);
    let [u, v] = line_basis(&p);
    let second = |x: &[f64], y: &[f64]| -> f64 {
        let mut sum = 0.0;
        for (i, d) in form.gradient().iter().enumerate() {
            for (j, dd) in d.gradient().iter().enumerate() {
                sum += x[i] * y[j] * dd.value(&p);
            }
        }
        sum / form.norm()
    };
    let (a, b, c) = (second(&u, &u), second(&u, &v), second(&v, &v));
    let size = a.abs() + 2.0 * b.abs() + c.abs();
    let discriminant = b * b - a * c;
    if size < 1e-6 {
        SingularKind::Triple
    } else if discriminant.abs() < 1e-6 * size * size {
        SingularKind::Cusp
    } else if discriminant > 0.0 {
        SingularKind::Crossing
    } else {
        SingularKind::Isolated
    }
}

/// The real singular point of a form without real lines that is found from many starts by Gauss-Newton steps on the
/// gradient, with the size of the gradient there: a cubic that does not split has one at most.
pub(super) fn singular_point(form: &Form, rng: &mut Rng) -> Result<(Vec<f64>, f64), LinalgError> {
    let f = form.normalised();
    let g = f.gradient();
    let hessian: Vec<[Form; 3]> = g.iter().map(Form::gradient).collect();
    let size = |x: &[f64]| g.iter().map(|d| d.value(x).powi(2)).sum::<f64>().sqrt();
    let mut best = (vec![1.0, 0.0, 0.0], f64::MAX);
    for _ in 0..24 {
        let mut x = random_vector(rng, 3);
        for _ in 0..60 {
            let rhs: Vec<f64> = g.iter().map(|d| -d.value(&x)).chain(std::iter::once(0.0)).collect();
            // three equations and one that keeps the step across x
            let columns: Vec<Vec<f64>> = (0..3)
                .map(|k| hessian.iter().map(|h| h[k].value(&x)).chain(std::iter::once(x[k])).collect())
                .collect();
            let (mut step, _) = least_squares(&columns, &rhs)?;
            let length = norm(&step);
            if length > 0.3 {
                for s in &mut step {
                    *s *= 0.3 / length;
                }
            }
            x = unit(&x.iter().zip(&step).map(|(a, b)| a + b).collect::<Vec<f64>>());
            if length < 1e-15 {
                break;
            }
        }
        let value = size(&x);
        if value < best.1 {
            best = (x, value);
        }
    }
    Ok(best)
}

/// Intersections of a line with another part, on the line.
pub(super) fn on_line(line: &Form, other: &Form) -> Result<Vec<Vec<f64>>, LinalgError> {
    let [p, q] = line_basis(&line.coefficients);
    // a root at the infinite end of the parameter is avoided by a turn of the two points
    let (sin, cos) = 0.7f64.sin_cos();
    let turned: Vec<f64> = p.iter().zip(&q).map(|(x, y)| cos * x + sin * y).collect();
    let across: Vec<f64> = p.iter().zip(&q).map(|(x, y)| cos * y - sin * x).collect();
    let roots = real_roots(&other.on_line(&turned, &across))?;
    Ok(roots
        .iter()
        .map(|s| unit(&turned.iter().zip(&across).map(|(x, y)| x + s * y).collect::<Vec<_>>()))
        .collect())
}

/// Whether two homogeneous points are the same up to `limit`.
pub(super) fn same_point(p: &[f64], q: &[f64], limit: f64) -> bool {
    norm(&without(&unit(p), &[unit(q)])) < limit
}
