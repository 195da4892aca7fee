//! Which replaceable legs end at a given point.

use nalgebra::{Point3, Vector3};

use super::{Hole, Impossibility};
use crate::manipulator::Manipulator;
use crate::num::linalg::LinalgError;
use crate::synthesis::components::spectrum::Spectrum;
use crate::synthesis::components::{Components, MovingPoint, Parametrisation, exact_partners};
use crate::synthesis::hexagon::Body;
use crate::synthesis::leg_vector::LegSpan;

/// What can end at a hole.
#[derive(Debug, Clone, PartialEq)]
pub enum HoleAnswer {
    /// Replaceable legs with the other end in a flat of this dimension.
    Legs {
        /// Dimension of the flat of partners, 0 for a single leg.
        dimension: usize,
        /// The legs.
        formulas: Parametrisation,
    },
    /// All partners are at infinity.
    AtInfinity,
    /// None.
    None,
}

/// A hole and what was decided about it.
#[derive(Debug, Clone, PartialEq)]
pub struct HoleRecord {
    /// The hole.
    pub hole: Hole,
    /// The answer within the tolerance.
    pub answer: HoleAnswer,
    /// The smallest singular value of the equations of the partners (unit equations, unit point); zero when there are partners.
    pub singular_value: f64,
    /// Dimension of the space of homogeneous partners of the hole as written, by exact arithmetic.
    pub exact: Option<usize>,
    /// Whether all of these are at infinity.
    pub(super) exactly_at_infinity: bool,
    /// Whether they are the partners in combinations of the legs that were not named for the hole: a leg there then replaces none of those named. `false` where there
    /// are no exact partners.
    pub(super) exactly_by_others: bool,
    /// What counted as zero.
    pub tolerance: f64,
}

impl HoleRecord {
    /// The proof that the wish cannot be fulfilled, if there is one.
    pub(super) fn impossible(&self, index: usize) -> Option<Impossibility> {
        match self.answer {
            HoleAnswer::None if self.exact == Some(0) => Some(Impossibility::NoLegAtHole(index)),
            HoleAnswer::AtInfinity if self.exactly_at_infinity => {
                Some(Impossibility::PartnersAtInfinity(index))
            }
            _ => None,
        }
    }
}

/// Decides every hole.
pub(super) fn records(
    m: &Manipulator,
    found: &Components,
    holes: &[Hole],
) -> Result<Vec<HoleRecord>, LinalgError> {
    let legs = m.legs();
    let mut out = Vec::new();
    for hole in holes {
        let (answer, singular_value) = partners(&found.span, hole, found.options.tolerance)?;
        let among = |chosen: &dyn Fn(usize) -> bool| {
            let list: Vec<usize> = (0..6).filter(|i| chosen(*i)).collect();
            exact_partners(&legs, hole.body, &hole.point, &list)
        };
        let named = |i: usize| hole.legs.iter().any(|l| l.get() == i);
        let (all, others) = (among(&|_| true), among(&|i| !named(i)));
        out.push(HoleRecord {
            hole: hole.clone(),
            answer,
            singular_value,
            exact: all.map(|e| e.dimension),
            exactly_at_infinity: all.is_some_and(|e| e.dimension == e.at_infinity),
            exactly_by_others: !hole.legs.is_empty() && all.is_some_and(|e| e.dimension > 0) && all == others,
            tolerance: found.options.tolerance,
        });
    }
    Ok(out)
}

/// The kernel of the equations `<n_r, alpha (x) beta> = 0`, `n_r` an orthonormal basis of the complement of the span, `alpha` the hole.
fn partners(span: &LegSpan, hole: &Hole, tolerance: f64) -> Result<(HoleAnswer, f64), LinalgError> {
    let n = span.normalisation();
    let on_base = hole.body == Body::Base;
    // the leg with the hole at both ends: only the end on its own body is used
    let place = n.apply(&crate::manipulator::Leg { base: hole.point, platform: hole.point });
    let x = if on_base { place.base } else { place.platform };
    let alpha = nalgebra::Vector4::new(1.0, x.x, x.y, x.z).normalize();
    let rows: Vec<Vec<f64>> = span
        .complement()
        .iter()
        .map(|e| {
            let entry = |p: usize, q: usize| if on_base { e[4 * p + q] } else { e[4 * q + p] };
            (0..4).map(|q| (0..4).map(|p| alpha[p] * entry(p, q)).sum()).collect()
        })
        .collect();
    let s = Spectrum::of(&rows, 4)?;
    let kernel = s.kernel(s.rank(tolerance.max(1e-12)));
    let smallest = s.values[3];
    if kernel.is_empty() {
        return Ok((HoleAnswer::None, smallest));
    }
    // the kernel vector that is farthest from infinity, and an orthonormal basis of what is orthogonal to it: its vectors are directions
    let first: Vec<f64> = (0..4).map(|q| kernel.iter().map(|k| k[0] * k[q]).sum()).collect();
    if first[0] <= 1e-12 {
        return Ok((HoleAnswer::AtInfinity, smallest));
    }
    let point: [f64; 3] = [1, 2, 3].map(|q| first[q] / first[0]);
    let directions = directions(kernel, &first);
    let (centre, unit) =
        if on_base { (n.platform_centre, n.platform_unit) } else { (n.base_centre, n.base_unit) };
    let mut terms = vec![([0, 0, 0], homogeneous(&(centre + Vector3::from(point) * unit)))];
    for (k, d) in directions.iter().enumerate() {
        let mut exponent = [0; 3];
        exponent[k] = 1;
        terms.push((exponent, [0.0, d.x * unit, d.y * unit, d.z * unit]));
    }
    let dimension = directions.len();
    let here = MovingPoint { terms: vec![([0, 0, 0], homogeneous(&hole.point))] };
    let there = MovingPoint { terms };
    let (base, platform) = if on_base { (here, there) } else { (there, here) };
    let formulas = Parametrisation::Rational { parameters: dimension, base, platform };
    Ok((HoleAnswer::Legs { dimension, formulas }, smallest))
}

fn homogeneous(p: &Point3<f64>) -> [f64; 4] {
    [1.0, p.x, p.y, p.z]
}

/// Orthonormal directions of the kernel vectors with first entry 0.
fn directions(kernel: &[Vec<f64>], first: &[f64]) -> Vec<Vector3<f64>> {
    let length = first.iter().map(|x| x * x).sum::<f64>();
    let mut out: Vec<Vector3<f64>> = Vec::new();
    for k in kernel {
        let along = k.iter().zip(first).map(|(x, y)| x * y).sum::<f64>() / length;
        let mut d = Vector3::new(k[1] - along * first[1], k[2] - along * first[2], k[3] - along * first[3]);
        for e in &out {
            d -= e * e.dot(&d);
        }
        if d.norm() > 1e-6 && out.len() + 1 < kernel.len() {
            out.push(d.normalize());
        }
    }
    out
}
