//! Points of a plane over which the rank of `M` falls by two.

use super::form::{cross, exponents, index, power, random_minor, random_vector};
use super::found::View;
use super::spectrum::{Spectrum, dot, least_squares, norm, unit};
use crate::num::Rng;
use crate::num::linalg::{LinalgError, eigenvalues};

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
    Ok(s.kernel(s.rank(10.0 * view.tolerance * s.values[0])).to_vec())
}

/// How many independent conditions the points of rank `j - 1` or less put on forms: ten less the dimension of the span of
/// the minors of order `j`, cubics for a space over a plane. Zero shows that there is no such point.
pub(super) fn conditions(view: &View<'_>, rng: &mut Rng) -> Result<usize, LinalgError> {
    Ok(functionals(view, rng)?.len())
}

/// The points of rank `j - 1` or less, as long as there are finitely many, none of them multiple and no more than forms of degree `j - 1` tell apart;
/// and the number of complex ones.
///
/// The functionals are combinations of the values at the points. So `d(x_k q)` for forms `q` of degree `j - 1` is `C P_k V` with diagonal `P_k`, the coordinates of
/// the points, and `(C P_k V) (C P_l V)^+ = C P_k / P_l C^-1`.
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

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::super::curves::same_point;
    use super::super::flat::Flat;
    use super::super::product::Product;
    use super::*;

    /// Legs between two base lines and two platform lines, three each: a line of partners stands over the crossing of the base lines.
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
            let product = Product::new(flats.0, flats.1, &ends, None, 1e-9).unwrap();
            let view =
                View { product: &product, over_platform: false, near: &near, far: &far, tolerance: 1e-9 };
            let (points, complex) = located(&view, &mut Rng::new(42)).unwrap();
            let found = points.iter().any(|x| same_point(x, &product.base.local(&o), 1e-8));
            assert_eq!((found, complex), (!general, 0), "{points:?}");
            assert_eq!(conditions(&view, &mut Rng::new(43)).unwrap(), points.len());
        }
    }
}
