//! The span of leg vectors as a subspace of `R^4 (x) R^4`, and the effect of translations of the two bodies.
//!
//! Each body has an origin that depends only on the span of leg vectors, in any frame.
//!
//! Three linear least-squares problems follow one another, each invariant under rotations of both bodies; each decides
//! the translations that the last one left open. Translations that remain open map the span to itself. See
//! `docs/theory/alignment.md`.
//!
//! A design in canonical form is a span about its own origins; two designs are compared by the distance of two such
//! spans.

use nalgebra::{Matrix3, SMatrix, Vector3};

use super::TOLERANCE;
use super::rotations::{Axes, Projector, RotationCandidates, candidates, turned};
use crate::components::spectrum::{Spectrum, unit, without};
use crate::leg_vector::{Normalisation, leg_vector};
use num::Purpose;
use num::linalg::{LinalgError, svd};
use platform::manipulator::{Leg, Manipulator};

/// Places of the entries `1, a, b` of an element.
const HEAD: [usize; 7] = [0, 4, 8, 12, 1, 2, 3];

/// Common coordinates for two designs: the units of the first, about the centroids of the legs of each.
pub(super) fn coordinates(of: &Manipulator, units: &Normalisation) -> Normalisation {
    let own = Normalisation::of(of);
    Normalisation { base_unit: units.base_unit, platform_unit: units.platform_unit, ..own }
}

/// A subspace `L` of `R^4 (x) R^4` with an orthonormal basis of 4 x 4 arrays (entry `4 i + j`).
#[derive(Debug, Clone)]
pub(super) struct LegSpace {
    pub(super) basis: Vec<Vec<f64>>,
    /// The singular values on both sides of the decision on the dimension: smallest kept, largest dropped.
    pub(super) gap: (f64, f64),
}

impl LegSpace {
    /// The span of legs written in normalised coordinates.
    pub(super) fn of(legs: &[Leg]) -> Result<Self, LinalgError> {
        let rows: Vec<Vec<f64>> = legs.iter().map(|leg| unit(&leg_vector(leg))).collect();
        let s = Spectrum::of(&rows, 16)?;
        let rank = s.rank(TOLERANCE * s.values[0]);
        let gap = (s.values[rank - 1] / s.values[0], s.values.get(rank).map_or(0.0, |x| x / s.values[0]));
        Ok(Self { basis: s.image(rank).to_vec(), gap })
    }

    pub(super) fn dimension(&self) -> usize {
        self.basis.len()
    }

    /// The same legs after the shift of the base by `s` and of the platform by `t`.
    pub(super) fn shifted(&self, s: &Vector3<f64>, t: &Vector3<f64>) -> Result<Self, LinalgError> {
        let s = [1.0, s.x, s.y, s.z];
        let t = [1.0, t.x, t.y, t.z];
        let move_one = |v: &Vec<f64>| {
            let mut w = v.clone();
            for i in 1..4 {
                for j in 0..4 {
                    w[4 * i + j] += s[i] * v[j];
                }
            }
            for i in 0..4 {
                let first = w[4 * i];
                for j in 1..4 {
                    w[4 * i + j] += t[j] * first;
                }
            }
            w
        };
        let moved: Vec<Vec<f64>> = self.basis.iter().map(move_one).collect();
        let image = Spectrum::of(&moved, 16)?.image(self.dimension()).to_vec();
        Ok(Self { basis: image, gap: self.gap })
    }

    /// The orthogonal projector on `L`.
    pub(super) fn projector(&self) -> SMatrix<f64, 16, 16> {
        SMatrix::from_fn(|i, j| self.basis.iter().map(|v| v[i] * v[j]).sum())
    }

    /// `L` over the entries `1, a, b`.
    fn head(&self) -> Result<HeadMap, LinalgError> {
        let rows: Vec<Vec<f64>> = self.basis.iter().map(|v| HEAD.map(|i| v[i]).to_vec()).collect();
        let d = svd(&rows)?;
        let rank = d.s.iter().filter(|s| **s > TOLERANCE).count();
        let gap = (d.s[rank - 1], d.s.get(rank).copied().unwrap_or(0.0));
        let tail = |k: usize, factor: f64| -> Vec<f64> {
            let entry =
                |i: usize| self.basis.iter().enumerate().map(|(l, v)| d.u[l][k] * v[i]).sum::<f64>() * factor;
            (0..9).map(|i| entry(4 * (i / 3 + 1) + i % 3 + 1)).collect()
        };
        let moments: Vec<Vec<f64>> = (rank..self.dimension()).map(|k| tail(k, 1.0)).collect();
        let image: Vec<Vec<f64>> = (0..rank).map(|k| (0..7).map(|i| d.v[i][k]).collect()).collect();
        let tails = (0..rank).map(|k| without(&tail(k, 1.0 / d.s[k]), &moments)).collect();
        Ok(HeadMap { image, tails, moments, gap })
    }
}

/// `L` as a linear map from its entries `(x_0, a, b)` to its 3 x 3 block `C`, modulo the elements `(0, 0, 0, C)`.
#[derive(Debug, Clone)]
pub(super) struct HeadMap {
    /// Orthonormal basis of the possible `(x_0, a, b)`.
    image: Vec<Vec<f64>>,
    /// `C` of each, orthogonal to `moments`.
    tails: Vec<Vec<f64>>,
    /// Orthonormal basis of the elements `(0, 0, 0, C)`.
    pub(super) moments: Vec<Vec<f64>>,
    /// Singular values on both sides of the decision on the dimension.
    pub(super) gap: (f64, f64),
}

impl HeadMap {
    pub(super) fn dimension(&self) -> usize {
        self.image.len()
    }

    /// `C` of the element with this head, orthogonal to the moments.
    fn tail(&self, head: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; 9];
        for (e, c) in self.image.iter().zip(&self.tails) {
            let along: f64 = e.iter().zip(head).map(|(x, y)| x * y).sum();
            out.iter_mut().zip(c).for_each(|(o, x)| *o += along * x);
        }
        out
    }

    /// `x y^T` without its part along the moments.
    fn product(&self, x: &Vector3<f64>, y: &Vector3<f64>) -> Vec<f64> {
        let m: Matrix3<f64> = x * y.transpose();
        let flat: Vec<f64> = (0..9).map(|i| m[(i / 3, i % 3)]).collect();
        without(&flat, &self.moments)
    }

    /// The head `(1, a, b)` orthogonal to all heads `(0, a, b)`, and an orthonormal basis of the latter.
    fn split(&self) -> Result<(Vec<f64>, Vec<Vec<f64>>), LinalgError> {
        let mut first = vec![0.0; 7];
        for e in &self.image {
            first.iter_mut().zip(e).for_each(|(f, x)| *f += e[0] * x);
        }
        let along = [unit(&first)];
        let rest: Vec<Vec<f64>> = self.image.iter().map(|e| without(e, &along)).collect();
        let mut level = Spectrum::of(&rest, 7)?.image(self.dimension() - 1).to_vec();
        for d in &mut level {
            d[0] = 0.0;
        }
        let scale = first[0];
        Ok((first.iter().map(|x| x / scale).collect(), level))
    }
}

/// The parts `a` and `b` of a head, or `s` and `t` of a pair of shifts.
pub(super) fn pair(v: &[f64]) -> (Vector3<f64>, Vector3<f64>) {
    (Vector3::new(v[0], v[1], v[2]), Vector3::new(v[3], v[4], v[5]))
}

/// A span about its own origins.
#[derive(Debug, Clone)]
pub(super) struct Centred {
    pub(super) space: LegSpace,
    /// Shifts added to base and platform coordinates.
    pub(super) shift: (Vector3<f64>, Vector3<f64>),
    /// Dimensions that distinguish spans: of `L`, of its heads, and of the open directions of each least-squares
    /// problem.
    pub(super) dimensions: [usize; 5],
    /// The singular values nearest to the decisions on these dimensions: smallest kept, largest dropped.
    pub(super) gap: (f64, f64),
}

/// Moves the span to its own origins.
pub(super) fn centred(space: &LegSpace) -> Result<Centred, LinalgError> {
    let mut open: Vec<Vec<f64>> =
        (0..6).map(|k| (0..6).map(|i| f64::from(u8::from(i == k))).collect()).collect();
    let mut space = space.clone();
    let mut total = (Vector3::zeros(), Vector3::zeros());
    let mut dimensions = [space.dimension(), space.head()?.dimension(), 0, 0, 0];
    let mut gap = narrower(space.gap, space.head()?.gap);
    for (k, problem) in [differences, heads, means].iter().enumerate() {
        let head = space.head()?;
        let (columns, target) = problem(&head, &open)?;
        let found = solve(&open, &columns, &target)?;
        let (s, t) = pair(&found.shift);
        space = space.shifted(&s, &t)?;
        total = (total.0 + s, total.1 + t);
        (open, gap) = (found.open, narrower(gap, found.gap));
        dimensions[k + 2] = open.len();
    }
    Ok(Centred { space, shift: total, dimensions, gap })
}

/// The effects of shifts along each open direction on a list of numbers, and the list to be cancelled.
type ShiftProblem = (Vec<Vec<f64>>, Vec<f64>);

/// The blocks `C` of the elements `(0, a, b, C)`: a shift adds `s b^T + a t^T`.
fn differences(head: &HeadMap, open: &[Vec<f64>]) -> Result<ShiftProblem, LinalgError> {
    let level = head.split()?.1;
    let column = |x: &Vec<f64>| {
        let (s, t) = pair(x);
        let added = |d: &Vec<f64>| {
            let (a, b) = pair(&d[1..]);
            sum(&head.product(&s, &b), &head.product(&a, &t), 1.0)
        };
        level.iter().flat_map(added).collect()
    };
    Ok((open.iter().map(column).collect(), level.iter().flat_map(|d| head.tail(d)).collect()))
}

/// The part of `(a, b)` of the elements `(1, a, b, C)` across those with first entry zero.
fn heads(head: &HeadMap, open: &[Vec<f64>]) -> Result<ShiftProblem, LinalgError> {
    let (first, level) = head.split()?;
    let level: Vec<Vec<f64>> = level.iter().map(|d| d[1..].to_vec()).collect();
    Ok((open.iter().map(|x| without(x, &level)).collect(), first[1..].to_vec()))
}

/// The block `C` of the element `(1, a, b, C)` with `(a, b)` across those with first entry zero.
///
/// An open shift `(s, t)` is itself the head of an element `(0, s, t, C')`, and `s t^T` is a moment. The block
/// therefore changes by `s b^T + a t^T - C'`.
fn means(head: &HeadMap, open: &[Vec<f64>]) -> Result<ShiftProblem, LinalgError> {
    let first = head.split()?.0;
    let (a, b) = pair(&first[1..]);
    let column = |x: &Vec<f64>| {
        let (s, t) = pair(x);
        let own: Vec<f64> = std::iter::once(0.0).chain(x.iter().copied()).collect();
        let moved = sum(&head.product(&s, &b), &head.product(&a, &t), 1.0);
        sum(&moved, &head.tail(&own), -1.0)
    };
    Ok((open.iter().map(column).collect(), head.tail(&first)))
}

fn sum(x: &[f64], y: &[f64], factor: f64) -> Vec<f64> {
    x.iter().zip(y).map(|(p, q)| p + factor * q).collect()
}

fn narrower(x: (f64, f64), y: (f64, f64)) -> (f64, f64) {
    (x.0.min(y.0), x.1.max(y.1))
}

/// Solution of one least-squares problem.
struct LeastSquares {
    shift: Vec<f64>,
    open: Vec<Vec<f64>>,
    gap: (f64, f64),
}

/// The shift within the open directions that minimises `target`, and the directions that do not change it.
fn solve(open: &[Vec<f64>], columns: &[Vec<f64>], target: &[f64]) -> Result<LeastSquares, LinalgError> {
    let mut shift = vec![0.0; 6];
    if open.is_empty() || target.is_empty() {
        return Ok(LeastSquares { shift, open: open.to_vec(), gap: (1.0, 0.0) });
    }
    let d = svd(columns)?;
    let rank = d.s.iter().filter(|s| **s > TOLERANCE).count();
    let kept = if rank > 0 { d.s[rank - 1] } else { 1.0 };
    let gap = (kept, d.s.get(rank).copied().unwrap_or(0.0));
    let direction = |k: usize| -> Vec<f64> {
        (0..6).map(|i| open.iter().enumerate().map(|(l, x)| d.u[l][k] * x[i]).sum()).collect()
    };
    for k in 0..rank {
        let along: f64 = target.iter().zip(&d.v).map(|(t, row)| t * row[k]).sum::<f64>() / d.s[k];
        shift.iter_mut().zip(direction(k)).for_each(|(x, y)| *x -= along * y);
    }
    let rest: Vec<Vec<f64>> = (rank..open.len()).map(direction).collect();
    Ok(LeastSquares { shift, open: rest, gap })
}

/// Size of the trial changes of joints that measure sensitivities, in units of the body; below the tolerance of every
/// rank.
const TRIAL: f64 = 1e-11;
/// Number of trial changes.
const TRIALS: u64 = 3;

/// A design in normalised coordinates, its span about its own origins, and its invariants under rigid motions.
#[derive(Debug, Clone)]
pub(super) struct Canonical {
    pub(super) normalisation: Normalisation,
    pub(super) legs: [Leg; 6],
    pub(super) span: Centred,
    pub(super) projector: Projector,
    /// Principal values of base and platform.
    pub(super) values: [f64; 6],
}

impl Canonical {
    pub(super) fn of(m: &Manipulator, units: &Normalisation) -> Result<Self, LinalgError> {
        let normalisation = coordinates(m, units);
        Self::from_legs(normalisation, &m.legs().map(|leg| normalisation.apply(&leg)))
    }

    fn from_legs(normalisation: Normalisation, legs: &[Leg; 6]) -> Result<Self, LinalgError> {
        let span = centred(&LegSpace::of(legs)?)?;
        let projector = span.space.projector();
        let (x, y) = (Axes::of_base(&projector, None).values, Axes::of_platform(&projector, None).values);
        let values = [x[0], x[1], x[2], y[0], y[1], y[2]];
        Ok(Self { normalisation, legs: *legs, span, projector, values })
    }

    /// The legs about the origins of the span.
    pub(super) fn centred_legs(&self) -> [Leg; 6] {
        let (s, t) = self.span.shift;
        self.legs.map(|leg| Leg { base: leg.base + s, platform: leg.platform + t })
    }

    /// First-order changes of the principal values and the canonical form when the joints move by one unit of their
    /// body.
    pub(super) fn sensitivity(&self, seed: u64) -> Result<ShiftSensitivity, LinalgError> {
        let mut most = ShiftSensitivity { values: [0.0; 6], distance: 0.0 };
        for trial in 0..TRIALS {
            let mut rng = Purpose::SHIFTS.item(seed, trial);
            let mut change = || Vector3::from_fn(|_, _| rng.normal() * TRIAL);
            let legs =
                self.legs.map(|leg| Leg { base: leg.base + change(), platform: leg.platform + change() });
            let near = Self::from_legs(self.normalisation, &legs)?;
            for (most, (x, y)) in most.values.iter_mut().zip(self.values.iter().zip(near.values)) {
                *most = most.max((x - y).abs() / TRIAL);
            }
            most.distance = most.distance.max(self.nearest(&near, seed).0 / TRIAL);
        }
        Ok(most)
    }

    /// The smallest distance of the projectors over all candidates, and the candidates.
    pub(super) fn nearest(&self, other: &Self, seed: u64) -> (f64, RotationCandidates) {
        let found = candidates(&self.projector, &other.projector, seed);
        let distances = found.turns.iter().map(|t| (self.projector - turned(&other.projector, t)).norm());
        (distances.fold(f64::INFINITY, f64::min), found)
    }
}

/// Largest observed changes, per unit.
#[derive(Debug, Clone, Copy)]
pub(super) struct ShiftSensitivity {
    pub(super) values: [f64; 6],
    pub(super) distance: f64,
}
