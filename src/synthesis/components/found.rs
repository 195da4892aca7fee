//! The families of one closed pair over points, lines and conics.

use nalgebra::Vector3;

use super::component::FamilyKind;
use super::curves::conic_frame;
use super::decision::{Decision, Question};
use super::flat::Flat;
use super::form::Form;
use super::kernel::{Polynomial, minimal_kernel, planar_kernel};
use super::product::Product;
use super::shape::{Curve, Shape};
use super::spectrum::{Spectrum, orthonormal, unit};
use crate::num::Rng;
use crate::num::linalg::LinalgError;

/// A family before it is compared with the others.
#[derive(Debug, Clone)]
pub(super) struct Found {
    pub(super) shape: Shape,
    pub(super) kind: FamilyKind,
    pub(super) base_span: usize,
    pub(super) platform_span: usize,
    pub(super) exact: Option<bool>,
    pub(super) decisions: Vec<Decision>,
}

/// A product of flats seen from one body: `product.base` belongs to the platform when `over_platform`.
#[derive(Debug, Clone)]
pub(super) struct View<'a> {
    pub(super) product: &'a Product,
    pub(super) over_platform: bool,
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
        if self.over_platform { Question::RankOverPlatform } else { Question::RankOverBase }
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
        shape: Shape,
        kind: FamilyKind,
        spans: (usize, usize),
        decisions: Vec<Decision>,
    ) -> Found {
        let (base_span, platform_span) = if self.over_platform { (spans.1, spans.0) } else { spans };
        Found { shape, kind, base_span, platform_span, exact: None, decisions }
    }

    /// All legs between a flat of the carrying body and a flat of the other.
    pub(super) fn all_pairs(&self, carrier: Flat, other: Flat, decisions: Vec<Decision>) -> Found {
        let spans = (carrier.dimension(), other.dimension());
        let near = spanning_points(&carrier, self.near, self.tolerance);
        let far = spanning_points(&other, self.far, self.tolerance);
        let shape = if self.over_platform {
            Shape::Product { base: other, platform: carrier, base_points: far, platform_points: near }
        } else {
            Shape::Product { base: carrier, platform: other, base_points: near, platform_points: far }
        };
        self.found(shape, FamilyKind::AllPairs, spans, decisions)
    }

    /// The partners of one point: a flat, if there is one of dimension 1 or more in the finite part.
    pub(super) fn over_point(
        &self,
        point: &Vector3<f64>,
        rank: Option<usize>,
    ) -> Result<Option<Found>, LinalgError> {
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
    ) -> Result<Option<Found>, LinalgError> {
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
    ) -> Result<Option<Found>, LinalgError> {
        let curve = Curve::Conic { frame: conic_frame(form), form: form.clone() };
        let polynomial = curve.polynomial();
        let along = |rng: &mut Rng| super::kernel::value(&polynomial, rng.uniform(-1.0, 1.0), 1.0);
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
    ) -> Result<Option<Found>, LinalgError> {
        let dimension = self.width() - decision.value;
        if dimension == 0 {
            return Ok(None);
        }
        let polynomial = curve.polynomial();
        let matrices: Vec<Vec<Vec<f64>>> = polynomial.iter().map(|a| self.product.matrix(a)).collect();
        let fibre = if self.product.equations.is_empty() {
            Spectrum::of(&[], self.width())?.vectors.into_iter().map(|v| vec![v]).collect()
        } else {
            minimal_kernel(&matrices, self.width(), dimension, 10.0 * self.tolerance)?
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
        let other_span = orthonormal(&all, 1e-7).len() - 1;
        let shape = Shape::Over {
            over_platform: self.over_platform,
            curve,
            carrier: carrier.clone(),
            other: self.product.platform.clone(),
            fibre: finite_first(fibre),
        };
        Ok(Some(self.found(shape, kind, (span, other_span), vec![decision])))
    }

    /// One partner for every point of the carrying plane, when `M` has rank one less than its columns there.
    pub(super) fn over_plane(&self, decision: Decision) -> Result<Option<Found>, LinalgError> {
        let tolerance = 10.0 * self.tolerance;
        let Some((degree, map)) = planar_kernel(&self.product.equations, self.width(), tolerance)? else {
            return Ok(None);
        };
        if degree == 0 {
            let other = flat_of(&self.product.platform, &map, self.tolerance);
            let carrier = self.product.base.clone();
            return Ok(other.map(|other| self.all_pairs(carrier, other, vec![decision])));
        }
        let other_span = orthonormal(&map, 1e-7).len() - 1;
        let shape = Shape::Graph {
            over_platform: self.over_platform,
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

/// The flat of all points whose homogeneous local coordinates lie in the span of `vectors`; `None` when it has no
/// finite point.
pub(super) fn flat_of(within: &Flat, vectors: &[Vec<f64>], tolerance: f64) -> Option<Flat> {
    let basis = orthonormal(vectors, 1e-9);
    // the vector of the span with the largest first coordinate; what is orthogonal to it is at infinity
    let mut centre = vec![0.0; within.dimension() + 1];
    for v in &basis {
        centre.iter_mut().zip(v).for_each(|(c, x)| *c += v[0] * x);
    }
    if centre[0] <= tolerance {
        return None;
    }
    let mut all = vec![unit(&centre)];
    all.extend(basis.iter().cloned());
    let directions: Vec<Vector3<f64>> = orthonormal(&all, 1e-7)[1..]
        .iter()
        .take(basis.len() - 1)
        .map(|v| {
            let h = within.place(v);
            Vector3::new(h[1], h[2], h[3]) - point(within, &centre) * h[0]
        })
        .collect();
    Some(Flat::spanned(point(within, &centre), &directions))
}

/// Points of a list that span the flat, the first ones preferred; where they do not, points of the flat itself.
pub(super) fn spanning_points(flat: &Flat, points: &[Vector3<f64>], tolerance: f64) -> Vec<Vector3<f64>> {
    let limit = (10.0 * tolerance).max(1e-8);
    let mut out: Vec<Vector3<f64>> = Vec::new();
    for p in points.iter().filter(|p| flat.distance(p) <= limit) {
        let directions: Vec<Vec<f64>> =
            out.iter().skip(1).map(|q| (q - out[0]).iter().copied().collect()).collect();
        let fresh = match out.first() {
            None => true,
            Some(first) => {
                let d: Vec<f64> = (p - first).iter().copied().collect();
                let rest = super::spectrum::without(&d, &orthonormal(&directions, 1e-9));
                super::spectrum::norm(&rest) > 1e-3
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

/// The vector with the largest first coordinate first among those of least degree: `u = 0` then gives finite legs.
fn finite_first(mut fibre: Vec<Polynomial>) -> Vec<Polynomial> {
    let finite = |p: &Polynomial| p.iter().map(|c| c[0].abs()).fold(0.0, f64::max);
    if let Some(k) = (0..fibre.len()).find(|k| finite(&fibre[*k]) > 1e-6) {
        fibre.swap(0, k);
    }
    fibre
}
