//! Points of a plane over which the rank of `M` falls by two.

use super::form::{cross, exponents, power, random_minor};
use super::found::View;
use super::spectrum::{Spectrum, norm, unit};
use crate::num::Rng;
use crate::num::linalg::LinalgError;

/// How many independent conditions the points of rank `j - 1` or less put on forms: ten less the dimension of the span of
/// the minors of order `j`, cubics for a space over a plane. Zero shows that there is no such point.
pub(super) fn conditions(view: &View<'_>, rng: &mut Rng) -> Result<usize, LinalgError> {
    let m = view.product.forms();
    let order = view.product.platform.dimension();
    let all = (order + 1) * (order + 2) / 2;
    let mut rows = Vec::new();
    for _ in 0..2 * all {
        rows.push(unit(&random_minor(&m, order, rng).coefficients));
    }
    let s = Spectrum::of(&rows, all)?;
    Ok(all - s.rank(10.0 * view.tolerance * s.values[0]))
}

/// How many independent conditions it is for forms of a degree to vanish at these points.
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
            if norm(&line) > 1e-6 {
                lines.push(unit(&line));
            }
        }
    }
    let mut out: Vec<Vec<f64>> = joints.iter().map(|p| unit(p)).collect();
    for (k, l) in lines.iter().enumerate() {
        for m in &lines[..k] {
            let p = cross(l, m);
            if norm(&p) > 1e-6 {
                out.push(unit(&p));
            }
        }
    }
    out
}
