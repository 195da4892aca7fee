//! The families of one closed pair over points, lines, conics and planes.
//!
//! The platform points of a base point that moves along a line or conic are the kernel of a matrix of polynomials.

use nalgebra::Vector3;

use super::component::FamilyKind;
use super::flats::{Flat, FlatProduct};
use super::form::{Form, conic_frame, exponents, index, power};
use super::shape::{Curve, FamilyShape};
use super::spectrum::{
    APART, COMPUTED, Decision, NO_DIMENSION, Question, Spectrum, nearness, norm, orthonormal, unit, without,
};
use num::Rng;
use num::linalg::LinalgError;
use platform::manipulator::Body;

/// `sum_e t^e vectors[e]`.
pub(super) type Polynomial = Vec<Vec<f64>>;

/// The value of a polynomial at `num / den`, times `den^degree`.
pub(super) fn value(p: &Polynomial, num: f64, den: f64) -> Vec<f64> {
    let degree = p.len() - 1;
    let mut out = vec![0.0; p[0].len()];
    for (e, c) in p.iter().enumerate() {
        let factor = power(num, e) * power(den, degree - e);
        out.iter_mut().zip(c).for_each(|(o, x)| *o += factor * x);
    }
    out
}

/// Coefficients of degree `degree` of `t^s v` for all shifts `s` that fit.
fn shifted(v: &Polynomial, degree: usize) -> Vec<Vec<f64>> {
    let width = v[0].len();
    let at = |s: usize| {
        let mut out = vec![0.0; width * (degree + 1)];
        for (e, c) in v.iter().enumerate() {
            out[(e + s) * width..(e + s + 1) * width].copy_from_slice(c);
        }
        out
    };
    (0..(degree + 2).saturating_sub(v.len())).map(at).collect()
}

/// A minimal polynomial basis of the kernel of `M(t) = sum_e t^e matrices[e]`, with `dimension` vectors.
///
/// `M(t) b(t) = 0` with `deg b = d` is a linear system for the coefficients of `b`. The search goes through
/// `d = 0, 1, ..` and leaves out `t^s b_l(t)` of the vectors already found. This gives a basis of least degrees (Forney
/// 1975). The degrees are bounded by the sum of the row degrees.
fn minimal_kernel(
    matrices: &[Vec<Vec<f64>>],
    width: usize,
    dimension: usize,
    tolerance: f64,
) -> Result<Vec<Polynomial>, LinalgError> {
    let (order, height) = (matrices.len() - 1, matrices[0].len());
    let mut found: Vec<Polynomial> = Vec::new();
    let last = (order * height).min(8);
    for degree in 0..=last {
        let rows = stacked(matrices, width, degree);
        let s = Spectrum::of(&rows, width * (degree + 1))?;
        let top = s.values.first().copied().unwrap_or(0.0);
        let null = s.kernel(s.rank(tolerance * top));
        let mut known: Vec<Vec<f64>> = Vec::new();
        for v in found.iter().flat_map(|v| shifted(v, degree)) {
            known.push(unit(&without(&v, &known)));
        }
        let fresh: Vec<Vec<f64>> = null.iter().map(|v| without(v, &known)).collect();
        let fresh = Spectrum::of(&fresh, width * (degree + 1))?;
        let count = null.len().saturating_sub(known.len()).min(dimension - found.len());
        for v in fresh.image(count) {
            found.push(scaled(v).chunks(width).map(<[f64]>::to_vec).collect());
        }
        if found.len() == dimension {
            break;
        }
    }
    Ok(found)
}

/// The linear system for the coefficients of degree `degree`: block `k` of the rows belongs to `t^k`.
fn stacked(matrices: &[Vec<Vec<f64>>], width: usize, degree: usize) -> Vec<Vec<f64>> {
    let mut rows = Vec::new();
    for power in 0..degree + matrices.len() {
        for i in 0..matrices[0].len() {
            let mut row = vec![0.0; width * (degree + 1)];
            for e in 0..=degree {
                if let Some(m) = power.checked_sub(e).and_then(|k| matrices.get(k)) {
                    row[e * width..(e + 1) * width].copy_from_slice(&m[i]);
                }
            }
            rows.push(row);
        }
    }
    rows
}

/// Divided by the entry of largest modulus, which makes sign and size independent of the decomposition.
pub(super) fn scaled(v: &[f64]) -> Vec<f64> {
    let largest = v.iter().fold(0.0f64, |m, x| if x.abs() > 1.000_001 * m.abs() { *x } else { m });
    let tiny = 1e-14 * largest.abs();
    v.iter().map(|x| if x.abs() <= tiny { 0.0 } else { x / largest }).collect()
}

/// A vector of forms of least degree (at most 2) in three variables in the kernel of `M(alpha)`, whose entries are
/// linear forms. It is given by coefficient vectors in the order of [`exponents`].
fn planar_kernel(
    equations: &[Vec<f64>],
    width: usize,
    tolerance: f64,
) -> Result<Option<(usize, Polynomial)>, LinalgError> {
    for degree in 0..=2 {
        let count = (degree + 1) * (degree + 2) / 2;
        let mut rows = Vec::new();
        for n in equations {
            let mut block = vec![vec![0.0; width * count]; (degree + 2) * (degree + 3) / 2];
            for e in exponents(degree) {
                for p in 0..3 {
                    let mut up = e;
                    up[p] += 1;
                    let at = index(e) * width;
                    block[index(up)][at..at + width]
                        .iter_mut()
                        .zip(&n[p * width..])
                        .for_each(|(x, y)| *x += y);
                }
            }
            rows.append(&mut block);
        }
        let s = Spectrum::of(&rows, width * count)?;
        let top = s.values.first().copied().unwrap_or(0.0);
        if let Some(v) = s.kernel(s.rank(tolerance * top)).last().filter(|v| norm(v) > 0.0) {
            return Ok(Some((degree, scaled(v).chunks(width).map(<[f64]>::to_vec).collect())));
        }
    }
    Ok(None)
}

/// A family before the comparison with the others.
#[derive(Debug, Clone)]
pub(super) struct FoundComponents {
    pub(super) shape: FamilyShape,
    pub(super) kind: FamilyKind,
    pub(super) base_span: usize,
    pub(super) platform_span: usize,
    pub(super) exact: Option<bool>,
    pub(super) decisions: Vec<Decision>,
}

/// A product of flats from the viewpoint of the body whose points have partners: `product.base` belongs to `carrying`.
#[derive(Debug, Clone)]
pub(super) struct View<'a> {
    pub(super) product: &'a FlatProduct,
    pub(super) carrying: Body,
    /// Ends of the legs of the pair on the carrying body and on the other one, normalised.
    pub(super) near: &'a [Vector3<f64>],
    pub(super) far: &'a [Vector3<f64>],
    pub(super) tolerance: f64,
}

impl View<'_> {
    fn width(&self) -> usize {
        self.product.platform.dimension() + 1
    }

    fn question(&self) -> Question {
        self.carrying.of((Question::RankOverBase, Question::RankOverPlatform))
    }

    /// Rank of `M` at the best of four random points of a family of points.
    pub(super) fn generic_rank(
        &self,
        point: impl Fn(&mut Rng) -> Vec<f64>,
        rng: &mut Rng,
    ) -> Result<Decision, LinalgError> {
        let mut best: Option<Decision> = None;
        for _ in 0..4 {
            let s = self.product.spectrum(&point(rng))?;
            let d = Decision::rank(self.question(), &s.values, 1.0, self.tolerance);
            let better = best.is_none_or(|b| (d.value, d.above) > (b.value, b.above));
            if better {
                best = Some(d);
            }
        }
        Ok(best.unwrap_or(Decision::rank(self.question(), &[], 1.0, self.tolerance)))
    }

    fn found(
        &self,
        shape: FamilyShape,
        kind: FamilyKind,
        spans: (usize, usize),
        decisions: Vec<Decision>,
    ) -> FoundComponents {
        let (base_span, platform_span) = self.carrying.of((spans, (spans.1, spans.0)));
        FoundComponents { shape, kind, base_span, platform_span, exact: None, decisions }
    }

    /// All legs between a flat of the carrying body and a flat of the other.
    pub(super) fn all_pairs(&self, carrier: Flat, other: Flat, decisions: Vec<Decision>) -> FoundComponents {
        let spans = (carrier.dimension(), other.dimension());
        let near = spanning_points(&carrier, self.near, self.tolerance);
        let far = spanning_points(&other, self.far, self.tolerance);
        let shape = match self.carrying {
            Body::Base => FamilyShape::Product {
                base: carrier,
                platform: other,
                base_points: near,
                platform_points: far,
            },
            Body::Platform => FamilyShape::Product {
                base: other,
                platform: carrier,
                base_points: far,
                platform_points: near,
            },
        };
        self.found(shape, FamilyKind::AllPairs, spans, decisions)
    }

    /// The partners of one point: a flat, if its finite part has dimension 1 or more.
    pub(super) fn over_point(
        &self,
        point: &Vector3<f64>,
        rank: Option<usize>,
    ) -> Result<Option<FoundComponents>, LinalgError> {
        let s = self.product.spectrum(&self.product.base.local(point))?;
        let mut decision = Decision::rank(self.question(), &s.values, 1.0, self.tolerance);
        if let Some(rank) = rank {
            decision = decision.taken(rank);
        }
        if decision.value + 2 > self.width() {
            return Ok(None);
        }
        let other = flat_of(&self.product.platform, s.kernel(decision.value), self.tolerance);
        let carrier = Flat { origin: *point, axes: Vec::new() };
        Ok(other.map(|other| self.all_pairs(carrier, other, vec![decision])))
    }

    /// The partners of the points of a line (`p`, `q` with first coordinate 1); `most` bounds the rank of `M` on it.
    pub(super) fn over_line(
        &self,
        p: &[f64],
        q: &[f64],
        most: Option<usize>,
        rng: &mut Rng,
    ) -> Result<Option<FoundComponents>, LinalgError> {
        let along = |rng: &mut Rng| {
            let t = rng.uniform(-1.0, 2.0);
            p.iter().zip(q).map(|(x, y)| x + t * (y - x)).collect()
        };
        let mut decision = self.generic_rank(along, rng)?;
        if let Some(most) = most {
            decision = decision.taken(decision.value.min(most));
        }
        let curve = Curve::Line { p: p.to_vec(), q: q.to_vec() };
        self.over_curve(curve, decision, FamilyKind::OverLine, 1)
    }

    /// The partners of the points of a conic of the carrying plane.
    pub(super) fn over_conic(
        &self,
        form: &Form,
        most: usize,
        rng: &mut Rng,
    ) -> Result<Option<FoundComponents>, LinalgError> {
        let curve = Curve::Conic { frame: conic_frame(form), form: form.clone() };
        let polynomial = curve.polynomial();
        let along = |rng: &mut Rng| value(&polynomial, rng.uniform(-1.0, 1.0), 1.0);
        let decision = self.generic_rank(along, rng)?;
        let decision = decision.taken(decision.value.min(most));
        self.over_curve(curve, decision, FamilyKind::OverConic, 2)
    }

    fn over_curve(
        &self,
        curve: Curve,
        decision: Decision,
        kind: FamilyKind,
        span: usize,
    ) -> Result<Option<FoundComponents>, LinalgError> {
        let dimension = self.width() - decision.value;
        if dimension == 0 {
            return Ok(None);
        }
        let polynomial = curve.polynomial();
        let matrices: Vec<Vec<Vec<f64>>> = polynomial.iter().map(|a| self.product.matrix(a)).collect();
        let fibre = if self.product.equations.is_empty() {
            Spectrum::of(&[], self.width())?.vectors.into_iter().map(|v| vec![v]).collect()
        } else {
            minimal_kernel(&matrices, self.width(), dimension, COMPUTED * self.tolerance)?
        };
        if fibre.len() < dimension {
            return Ok(None);
        }
        let carrier = &self.product.base;
        if let (Curve::Line { p, q }, true) = (&curve, fibre.iter().all(|v| v.len() == 1)) {
            let constant: Vec<Vec<f64>> = fibre.iter().map(|v| v[0].clone()).collect();
            let Some(other) = flat_of(&self.product.platform, &constant, self.tolerance) else {
                return Ok(None);
            };
            let [start, end] = [p, q].map(|x| point(carrier, x));
            let line = Flat::spanned(start, &[end - start]);
            return Ok(Some(self.all_pairs(line, other, vec![decision])));
        }
        let all: Vec<Vec<f64>> = fibre.iter().flatten().cloned().collect();
        let other_span = orthonormal(&all, NO_DIMENSION).len() - 1;
        let shape = FamilyShape::Over {
            carrying: self.carrying,
            curve,
            carrier: carrier.clone(),
            other: self.product.platform.clone(),
            fibre: finite_first(fibre),
        };
        Ok(Some(self.found(shape, kind, (span, other_span), vec![decision])))
    }

    /// One partner for every point of the carrying plane, if the rank of `M` there is one less than its columns.
    pub(super) fn over_plane(&self, decision: Decision) -> Result<Option<FoundComponents>, LinalgError> {
        let tolerance = COMPUTED * self.tolerance;
        let Some((degree, map)) = planar_kernel(&self.product.equations, self.width(), tolerance)? else {
            return Ok(None);
        };
        if degree == 0 {
            let other = flat_of(&self.product.platform, &map, self.tolerance);
            let carrier = self.product.base.clone();
            return Ok(other.map(|other| self.all_pairs(carrier, other, vec![decision])));
        }
        let other_span = orthonormal(&map, NO_DIMENSION).len() - 1;
        let shape = FamilyShape::Graph {
            carrying: self.carrying,
            carrier: self.product.base.clone(),
            other: self.product.platform.clone(),
            degree,
            map,
        };
        Ok(Some(self.found(shape, FamilyKind::OverPlane, (2, other_span), vec![decision])))
    }
}

/// A finite point of a flat from its homogeneous local coordinates.
pub(super) fn point(flat: &Flat, local: &[f64]) -> Vector3<f64> {
    let h = flat.place(local);
    Vector3::new(h[1], h[2], h[3]) / h[0]
}

/// The flat of all points with homogeneous local coordinates in the span of `vectors`; `None` if it has no finite
/// point.
fn flat_of(within: &Flat, vectors: &[Vec<f64>], tolerance: f64) -> Option<Flat> {
    let basis = orthonormal(vectors, 1e-9);
    // the vector of the span with the largest first coordinate; vectors orthogonal to it are at infinity
    let mut centre = vec![0.0; within.dimension() + 1];
    for v in &basis {
        centre.iter_mut().zip(v).for_each(|(c, x)| *c += v[0] * x);
    }
    if centre[0] <= tolerance {
        return None;
    }
    let mut all = vec![unit(&centre)];
    all.extend(basis.iter().cloned());
    let directions: Vec<Vector3<f64>> = orthonormal(&all, NO_DIMENSION)[1..]
        .iter()
        .take(basis.len() - 1)
        .map(|v| {
            let h = within.place(v);
            Vector3::new(h[1], h[2], h[3]) - point(within, &centre) * h[0]
        })
        .collect();
    Some(Flat::spanned(point(within, &centre), &directions))
}

/// Points that span the flat: those of a list if they do, the first ones preferred; otherwise points of the flat
/// itself.
fn spanning_points(flat: &Flat, points: &[Vector3<f64>], tolerance: f64) -> Vec<Vector3<f64>> {
    let limit = nearness(tolerance);
    let mut out: Vec<Vector3<f64>> = Vec::new();
    for p in points.iter().filter(|p| flat.distance(p) <= limit) {
        let directions: Vec<Vec<f64>> =
            out.iter().skip(1).map(|q| (q - out[0]).iter().copied().collect()).collect();
        let fresh = match out.first() {
            None => true,
            Some(first) => {
                let d: Vec<f64> = (p - first).iter().copied().collect();
                let rest = without(&d, &orthonormal(&directions, 1e-9));
                norm(&rest) > APART
            }
        };
        if fresh && out.len() <= flat.dimension() {
            out.push(*p);
        }
    }
    if out.len() == flat.dimension() + 1 {
        return out;
    }
    std::iter::once(flat.origin).chain(flat.axes.iter().map(|e| flat.origin + e)).collect()
}

/// Orders the vectors of least degree by falling first coordinate: `u = 0` then gives finite legs.
fn finite_first(mut fibre: Vec<Polynomial>) -> Vec<Polynomial> {
    let finite = |p: &Polynomial| p.iter().map(|c| c[0].abs()).fold(0.0, f64::max);
    if let Some(k) = (0..fibre.len()).find(|k| finite(&fibre[*k]) > 1e-6) {
        fibre.swap(0, k);
    }
    fibre
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kernels_of_known_degrees() {
        // rows (1, -t, 0), (0, 1, -t): kernel (t^2, t, 1)
        let m0 = vec![vec![1.0, 0.0, 0.0], vec![0.0, 1.0, 0.0]];
        let m1 = vec![vec![0.0, -1.0, 0.0], vec![0.0, 0.0, -1.0]];
        let k = minimal_kernel(&[m0, m1], 3, 1, 1e-9).unwrap();
        assert_eq!((k.len(), k[0].len()), (1, 3));
        let b = value(&k[0], 2.0, 1.0);
        assert!((b[0] / b[2] - 4.0).abs() < 1e-12 && (b[1] / b[2] - 2.0).abs() < 1e-12);
        // one row (1, -t, 0): kernel (t, 1, 0) and (0, 0, 1)
        let k = minimal_kernel(&[vec![vec![1.0, 0.0, 0.0]], vec![vec![0.0, -1.0, 0.0]]], 3, 2, 1e-9).unwrap();
        assert_eq!(k.iter().map(Vec::len).collect::<Vec<_>>(), [1, 2]);
        let b = value(&k[1], 3.0, 1.0);
        assert!((b[0] / b[1] - 3.0).abs() < 1e-12 && b[2].abs() < 1e-12);
    }

    #[test]
    fn the_kernel_of_a_skew_matrix_is_the_point_itself() {
        // M(alpha) beta = alpha x beta
        let mut equations = vec![vec![0.0; 9]; 3];
        for (r, p, q) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
            equations[r][p * 3 + q] = 1.0;
            equations[r][q * 3 + p] = -1.0;
        }
        let (degree, k) = planar_kernel(&equations, 3, 1e-9).unwrap().unwrap();
        assert_eq!(degree, 1);
        for (e, c) in exponents(1).zip(&k) {
            let p = e.iter().position(|x| *x == 1).unwrap();
            assert!(c.iter().enumerate().all(|(q, x)| (x.abs() > 0.5) == (p == q)));
        }
    }
}
