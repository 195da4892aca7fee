//! Flats that contain leg ends, and the pairs of flats to search for families.
//!
//! A flat has local coordinates, normalised to its joints. The legs between two flats that are combinations of given
//! legs satisfy bilinear equations `N_r(a, b) = 0`. Closed pairs contain all legs between the flats that these legs
//! span. They are found exactly and within a tolerance.

use std::collections::BTreeMap;

use nalgebra::{Point3, Vector3};

use super::form::Form;
use super::spectrum::{Decision, Question, Spectrum, dot, unit};
use crate::leg_vector::{Normalisation, keeps_digits};
use num::algebraic::{Algebraic, RoundedBasis};
use num::exact::{product as tensor, rational};
use num::linalg::LinalgError;
use platform::manipulator::{AlgebraicVector, Body, ExactLegs, Leg};

/// Below this ratio of the spreads of the joints the axes follow the joints, with a unit for each.
const NARROW: f64 = 1e-2;

/// A flat `origin + sum_k xi_k axes_k` with orthogonal axes that reach as far as the joints. Local coordinates are thus
/// of order one, also for joints nearly on a line or in a plane.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Flat {
    pub(super) origin: Vector3<f64>,
    pub(super) axes: Vec<Vector3<f64>>,
}

fn rows(points: &[Vector3<f64>]) -> (Vector3<f64>, Vec<Vec<f64>>) {
    let mean = points.iter().sum::<Vector3<f64>>() / points.len() as f64;
    (mean, points.iter().map(|p| (p - mean).iter().copied().collect()).collect())
}

/// Singular values of the centred points; the number of nonzero ones is the dimension of their flat.
fn spread(points: &[Vector3<f64>]) -> Result<[f64; 3], LinalgError> {
    let s = Spectrum::of(&rows(points).1, 3)?;
    Ok(std::array::from_fn(|k| s.values[k]))
}

impl Flat {
    /// The flat of dimension `dimension` nearest to the points (least squares, total).
    pub(super) fn nearest(points: &[Vector3<f64>], dimension: usize) -> Result<Self, LinalgError> {
        let (origin, centred) = rows(points);
        let s = Spectrum::of(&centred, 3)?;
        let axis = |v: &Vec<f64>| Vector3::new(v[0], v[1], v[2]);
        let narrow = dimension > 0 && s.values[dimension - 1] < NARROW * s.values[0];
        let mut axes = match dimension {
            2 if !narrow => plane_axes(forward(axis(&s.vectors[2]))),
            3 if !narrow => vec![Vector3::x(), Vector3::y(), Vector3::z()],
            _ => s.vectors[..dimension].iter().map(|v| forward(axis(v))).collect(),
        };
        let reach = points.iter().map(|p| (p - origin).norm()).fold(0.0, f64::max);
        for e in &mut axes {
            let along = points.iter().map(|p| e.dot(&(p - origin)).abs()).fold(0.0, f64::max);
            let length = if narrow { along } else { reach };
            if length > 0.0 {
                *e *= length;
            }
        }
        Ok(Self { origin, axes })
    }

    /// A point and directions, made orthonormal.
    pub(super) fn spanned(origin: Vector3<f64>, directions: &[Vector3<f64>]) -> Self {
        let mut axes: Vec<Vector3<f64>> = Vec::new();
        for d in directions {
            let mut rest = d.normalize();
            for _ in 0..2 {
                for e in &axes {
                    rest -= e * e.dot(&rest);
                }
            }
            axes.push(rest.normalize());
        }
        Self { origin, axes }
    }

    pub(super) fn dimension(&self) -> usize {
        self.axes.len()
    }

    /// Homogeneous local coordinates `(1, xi)` of a point's nearest point in the flat.
    pub(super) fn local(&self, p: &Vector3<f64>) -> Vec<f64> {
        let d = p - self.origin;
        std::iter::once(1.0).chain(self.axes.iter().map(|e| e.dot(&d) / e.norm_squared())).collect()
    }

    /// The rows of the map from homogeneous coordinates `(w, w x)` in the body to local ones.
    fn rows(&self) -> Vec<[f64; 4]> {
        let along = |e: &Vector3<f64>| {
            let n = e / e.norm_squared();
            [-n.dot(&self.origin), n.x, n.y, n.z]
        };
        std::iter::once([1.0, 0.0, 0.0, 0.0]).chain(self.axes.iter().map(along)).collect()
    }

    /// Distance of a point from the flat.
    pub(super) fn distance(&self, p: &Vector3<f64>) -> f64 {
        let mut d = p - self.origin;
        for e in &self.axes {
            d -= e * (e.dot(&d) / e.norm_squared());
        }
        d.norm()
    }

    /// Homogeneous coordinates `(w, w x)` in the body of homogeneous local ones.
    pub(super) fn place(&self, local: &[f64]) -> [f64; 4] {
        let mut x = self.origin * local[0];
        for (e, c) in self.axes.iter().zip(&local[1..]) {
            x += e * *c;
        }
        [local[0], x.x, x.y, x.z]
    }
}

/// The direction with a positive largest component: the same for both signs of a singular vector.
fn forward(v: Vector3<f64>) -> Vector3<f64> {
    if v[v.iamax()] < 0.0 { -v } else { v }
}

/// Two axes of the plane with the given normal: the first as near to the `x` axis of the body as possible.
fn plane_axes(normal: Vector3<f64>) -> Vec<Vector3<f64>> {
    let start = if normal.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
    let first = (start - normal * normal.dot(&start)).normalize();
    vec![first, normal.cross(&first)]
}

/// The span of legs in the product of two flats, and its equations.
///
/// In local homogeneous coordinates `alpha` (base, `i + 1` entries) and `beta` (platform, `j + 1` entries) a leg is
/// `alpha (x) beta`. The span of the legs has rank `k'`; an orthonormal basis of its complement are the
/// `m = (i + 1)(j + 1) - k'` equations.
#[derive(Debug, Clone)]
pub(super) struct FlatProduct {
    pub(super) base: Flat,
    pub(super) platform: Flat,
    pub(super) rank: usize,
    /// `equations[r][p (j + 1) + q]`.
    pub(super) equations: Vec<Vec<f64>>,
    pub(super) decision: Decision,
    /// Whether the rounded ends keep the digits of the span.
    well_conditioned: bool,
}

impl FlatProduct {
    /// The product for legs with these ends (normalised coordinates); the rank is prescribed or follows from the
    /// tolerance.
    pub(super) fn new(
        base: Flat,
        platform: Flat,
        ends: &[(Vector3<f64>, Vector3<f64>)],
        prescribed: Option<usize>,
        tolerance: f64,
    ) -> Result<Self, LinalgError> {
        let rows: Vec<Vec<f64>> = ends
            .iter()
            .map(|(a, b)| {
                let (alpha, beta) = (base.local(a), platform.local(b));
                unit(&alpha.iter().flat_map(|x| beta.iter().map(move |y| x * y)).collect::<Vec<f64>>())
            })
            .collect();
        let width = (base.dimension() + 1) * (platform.dimension() + 1);
        let s = Spectrum::of(&rows, width)?;
        let top = s.values.first().copied().unwrap_or(0.0);
        let used = &s.values[..rows.len().min(width)];
        let mut decision = Decision::rank(Question::LegRank, used, top, tolerance);
        if let Some(rank) = prescribed {
            decision = decision.taken(rank);
        }
        let rank = decision.value;
        let well_conditioned = rank == 0 || keeps_digits(s.values[rank - 1], top);
        Ok(Self { base, platform, rank, equations: s.kernel(rank).to_vec(), decision, well_conditioned })
    }

    /// The same with the equations of the span of these vectors, in normalised coordinates of both bodies.
    fn of_span(self, vectors: &[Vec<f64>]) -> Result<Self, LinalgError> {
        let (left, right) = (self.base.rows(), self.platform.rows());
        let local = |v: &Vec<f64>| -> Vec<f64> {
            let entry = |l: &[f64; 4], r: &[f64; 4]| {
                l.iter().zip(v.chunks(4)).map(|(x, part)| x * dot(r, part)).sum::<f64>()
            };
            left.iter().flat_map(|l| right.iter().map(move |r| entry(l, r))).collect()
        };
        let rows: Vec<Vec<f64>> = vectors.iter().map(|v| unit(&local(v))).collect();
        let s = Spectrum::of(&rows, left.len() * right.len())?;
        Ok(Self { equations: s.kernel(self.rank).to_vec(), ..self })
    }

    /// The same with the two bodies exchanged.
    pub(super) fn exchanged(&self) -> Self {
        let (i, j) = (self.base.dimension() + 1, self.platform.dimension() + 1);
        let turn = |n: &Vec<f64>| (0..i * j).map(|k| n[(k % i) * j + k / i]).collect();
        Self {
            base: self.platform.clone(),
            platform: self.base.clone(),
            rank: self.rank,
            equations: self.equations.iter().map(turn).collect(),
            decision: self.decision,
            well_conditioned: self.well_conditioned,
        }
    }

    /// `M(alpha)`: `m` rows of `j + 1` entries with `M(alpha) beta = 0` for the legs of the span.
    pub(super) fn matrix(&self, alpha: &[f64]) -> Vec<Vec<f64>> {
        let j = self.platform.dimension() + 1;
        let row = |n: &Vec<f64>| {
            (0..j).map(|q| alpha.iter().enumerate().map(|(p, x)| x * n[p * j + q]).sum()).collect()
        };
        self.equations.iter().map(row).collect()
    }

    /// The spectrum of `M` at the direction of `alpha`.
    pub(super) fn spectrum(&self, alpha: &[f64]) -> Result<Spectrum, LinalgError> {
        Spectrum::of(&self.matrix(&unit(alpha)), self.platform.dimension() + 1)
    }

    /// `M` with linear forms as entries; for a base plane.
    pub(super) fn forms(&self) -> Vec<Vec<Form>> {
        let j = self.platform.dimension() + 1;
        let entry =
            |n: &Vec<f64>, q: usize| Form::linear(&(0..3).map(|p| n[p * j + q]).collect::<Vec<f64>>());
        self.equations.iter().map(|n| (0..j).map(|q| entry(n, q)).collect()).collect()
    }
}

num::words! {
    /// The interpretation of the joints in which a pair of flats exists.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[non_exhaustive]
    pub enum Reading as name {
        /// The doubles as rational numbers, and the tolerance as well.
        Both = "exact",
        /// The doubles as rational numbers only: within the tolerance the joints have other dimensions.
        ExactOnly = "exact_only",
        /// Within the tolerance only.
        ToleranceOnly = "within_tolerance",
    }
}

/// A closed pair: the legs between two flats that these legs span, and the reading in which it exists.
#[derive(Debug, Clone)]
pub(super) struct ClosedPair {
    pub(super) legs: Vec<usize>,
    pub(super) base: usize,
    pub(super) platform: usize,
    pub(super) rank: usize,
    pub(super) reading: Reading,
    pub(super) product: FlatProduct,
    pub(super) decisions: Vec<Decision>,
}

/// The joints in both readings.
#[derive(Debug)]
pub(super) struct BothReadings {
    pub(super) base: [Vector3<f64>; 6],
    pub(super) platform: [Vector3<f64>; 6],
    pub(super) exact: ExactLegs,
    /// Whether these are the joints as meant, not doubles that may be rounded: then only they decide.
    pub(super) constructed: bool,
    /// The legs in design units.
    pub(super) design: [Leg; 6],
    pub(super) normalisation: Normalisation,
    pub(super) tolerance: f64,
}

impl BothReadings {
    /// Ends of some legs.
    pub(super) fn of(&self, legs: &[usize]) -> Vec<(Vector3<f64>, Vector3<f64>)> {
        legs.iter().map(|i| (self.base[*i], self.platform[*i])).collect()
    }

    /// Design coordinates of a point; those of the joint if it is one.
    pub(super) fn design_point(&self, body: Body, p: &Vector3<f64>, n: &Normalisation) -> Vector3<f64> {
        let joint = self.side(body).iter().position(|q| q == p);
        match (joint, body) {
            (Some(k), Body::Base) => self.design[k].base.coords,
            (Some(k), Body::Platform) => self.design[k].platform.coords,
            (None, Body::Base) => n.base_centre.coords + p * n.base_unit,
            (None, Body::Platform) => n.platform_centre.coords + p * n.platform_unit,
        }
    }

    pub(super) fn side(&self, body: Body) -> &[Vector3<f64>; 6] {
        body.of((&self.base, &self.platform))
    }

    /// A basis of the span of the exact vectors of some legs, in normalised coordinates. `None` if these are not
    /// finite.
    pub(super) fn basis(&self, legs: &[usize]) -> Option<RoundedBasis> {
        let n = &self.normalisation;
        let number = |x: f64| rational(x).map(Algebraic::from);
        let frame = |centre: &Point3<f64>, size: f64| -> Option<(Vec<Algebraic>, Algebraic)> {
            let size = number(size).filter(|size| !size.is_zero())?;
            Some((centre.iter().map(|x| number(*x)).collect::<Option<_>>()?, size))
        };
        let base = frame(&n.base_centre, n.base_unit)?;
        let platform = frame(&n.platform_centre, n.platform_unit)?;
        let normalised = |point: &AlgebraicVector, (centre, size): &(Vec<Algebraic>, Algebraic)| {
            let rest = point[1..].iter().zip(centre).map(|(x, c)| &(x - c) / size);
            std::iter::once(Algebraic::integer(1)).chain(rest).collect::<AlgebraicVector>()
        };
        let vector = |i: &usize| {
            tensor(&normalised(&self.exact.base[*i], &base), &normalised(&self.exact.platform[*i], &platform))
        };
        Some(RoundedBasis::of(&legs.iter().map(vector).collect::<Vec<_>>()))
    }
}

fn members(mask: usize) -> Vec<usize> {
    (0..6).filter(|i| mask >> i & 1 == 1).collect()
}

/// Dimensions of the flats of the ends of every subset of legs.
struct Dimensions {
    base: [usize; 64],
    platform: [usize; 64],
}

impl Dimensions {
    fn of(dimension: impl Fn(Body, &[usize]) -> Result<usize, LinalgError>) -> Result<Self, LinalgError> {
        let mut out = Self { base: [0; 64], platform: [0; 64] };
        for mask in 1..64 {
            out.base[mask] = dimension(Body::Base, &members(mask))?;
            out.platform[mask] = dimension(Body::Platform, &members(mask))?;
        }
        Ok(out)
    }

    /// All legs between the flats of the legs of `mask`.
    fn closure(&self, mask: usize) -> usize {
        let inside = |i: &usize| {
            let more = mask | 1 << i;
            self.base[more] == self.base[mask] && self.platform[more] == self.platform[mask]
        };
        let next = (0..6).filter(inside).fold(mask, |m, i| m | 1 << i);
        // within a tolerance the union may span more than each leg alone
        let same = self.base[next] == self.base[mask] && self.platform[next] == self.platform[mask];
        if next == mask || !same { mask } else { self.closure(next) }
    }

    fn closed(&self) -> impl Iterator<Item = usize> + '_ {
        (1..64usize).filter(|m| m.count_ones() > 1 && self.closure(*m) == *m)
    }
}

/// All closed pairs that can hold a family, see `docs/theory/components.md`: `k' >= i + j + 1`, not both points.
pub(super) fn closed_pairs(ends: &BothReadings) -> Result<Vec<ClosedPair>, LinalgError> {
    let exact = Dimensions::of(|body, legs| Ok(ends.exact.dimension(body, legs)))?;
    let numerical = Dimensions::of(|body, legs| {
        let points: Vec<Vector3<f64>> = legs.iter().map(|i| ends.side(body)[*i]).collect();
        Ok(spread(&points)?.iter().filter(|s| **s > ends.tolerance).count())
    })?;
    // legs, i, j, rank -> (exact, within the tolerance)
    let mut found: BTreeMap<(usize, usize, usize, usize), (bool, bool)> = BTreeMap::new();
    for mask in exact.closed() {
        let rank = ends.exact.rank(&members(mask));
        found.entry((mask, exact.base[mask], exact.platform[mask], rank)).or_default().0 = true;
    }
    for mask in numerical.closed() {
        let (i, j) = (numerical.base[mask], numerical.platform[mask]);
        let key = (mask, i, j, product(ends, &members(mask), i, j, None)?.rank);
        // a tolerance is for joints that may be rounded
        if !ends.constructed || found.contains_key(&key) {
            found.entry(key).or_default().1 = true;
        }
    }
    let mut out = Vec::new();
    for ((mask, i, j, rank), (is_exact, is_numerical)) in found {
        if i + j == 0 || rank < i + j + 1 {
            continue;
        }
        let reading = match (is_exact, is_numerical) {
            (true, true) => Reading::Both,
            (true, false) => Reading::ExactOnly,
            _ => Reading::ToleranceOnly,
        };
        let legs = members(mask);
        let mut product = product(ends, &legs, i, j, Some(rank))?;
        if is_exact && !product.well_conditioned {
            product = exactly(ends, &legs, product)?;
        }
        let mut decisions = Vec::new();
        for (body, question, used, by_exact) in [
            (Body::Base, Question::BaseDimension, i, exact.base[mask]),
            (Body::Platform, Question::PlatformDimension, j, exact.platform[mask]),
        ] {
            let points: Vec<Vector3<f64>> = legs.iter().map(|k| ends.side(body)[*k]).collect();
            let decision = Decision::rank(question, &spread(&points)?, 1.0, ends.tolerance);
            decisions.push(decision.taken(used).beside(Some(by_exact)));
        }
        decisions.push(product.decision.beside(Some(ends.exact.rank(&legs))));
        out.push(ClosedPair { legs, base: i, platform: j, rank, reading, product, decisions });
    }
    Ok(out)
}

fn product(
    ends: &BothReadings,
    legs: &[usize],
    i: usize,
    j: usize,
    rank: Option<usize>,
) -> Result<FlatProduct, LinalgError> {
    let pairs = ends.of(legs);
    let base = Flat::nearest(&pairs.iter().map(|p| p.0).collect::<Vec<_>>(), i)?;
    let platform = Flat::nearest(&pairs.iter().map(|p| p.1).collect::<Vec<_>>(), j)?;
    FlatProduct::new(base, platform, &pairs, rank, ends.tolerance)
}

/// The product with the equations of the exact joints.
fn exactly(ends: &BothReadings, legs: &[usize], product: FlatProduct) -> Result<FlatProduct, LinalgError> {
    match ends.basis(legs) {
        Some(basis) => product.of_span(&basis.vectors),
        None => Ok(product),
    }
}

/// All six legs between the flats that they span: in both readings if these agree or the joints are exact, otherwise
/// once in each.
pub(super) fn whole(ends: &BothReadings) -> Result<Vec<ClosedPair>, LinalgError> {
    let legs: Vec<usize> = (0..6).collect();
    let numerical = |body: Body| -> Result<usize, LinalgError> {
        Ok(spread(ends.side(body))?.iter().filter(|s| **s > ends.tolerance).count())
    };
    let exact = Body::BOTH.map(|body| ends.exact.dimension(body, &legs));
    let rank = ends.exact.rank(&legs);
    let near = [numerical(Body::Base)?, numerical(Body::Platform)?];
    let rounded = product(ends, &legs, near[0], near[1], None)?;
    let same = exact == near && rank == rounded.rank;
    let pair = |product: FlatProduct, reading: Reading| ClosedPair {
        legs: legs.clone(),
        base: product.base.dimension(),
        platform: product.platform.dimension(),
        rank: product.rank,
        reading,
        decisions: vec![product.decision.beside(Some(rank))],
        product,
    };
    if same {
        let product = if rounded.well_conditioned { rounded } else { exactly(ends, &legs, rounded)? };
        return Ok(vec![pair(product, Reading::Both)]);
    }
    let mut all = Vec::new();
    if !ends.constructed {
        all.push(pair(rounded, Reading::ToleranceOnly));
    }
    let product = product(ends, &legs, exact[0], exact[1], Some(rank))?;
    all.push(pair(exactly(ends, &legs, product)?, Reading::ExactOnly));
    Ok(all)
}
