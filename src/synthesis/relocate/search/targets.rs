//! Requirements of an equivalent platform, and the replaceable legs at a requested hole.

use nalgebra::{Point3, Vector3};

use super::{Impossibility, SearchError};
use crate::components::spectrum::Spectrum;
use crate::components::{Components, MovingPoint, Parametrisation, exact_partners};
use crate::leg_vector::LegSpan;
use num::linalg::LinalgError;
use platform::geom::Pose;
use platform::manipulator::{Body, LegIndex, Manipulator};

/// A required place of a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Hole {
    /// The body it is drilled into.
    pub body: Body,
    /// Its place, frame of the body, design units.
    pub point: Point3<f64>,
    /// The new leg there must be able to replace one of these legs, and gets its number; empty: any leg.
    pub legs: Vec<LegIndex>,
}

/// The requirements of the search. Lengths are in design units.
#[derive(Debug, Clone, PartialEq)]
pub struct Targets {
    /// Every joint carries one leg.
    pub no_shared_joints: bool,
    /// Smallest distance of two joints of one body.
    pub spacing: f64,
    /// `Some(d)`: legs without a shared joint keep the distance `d` at all poses, as straight segments.
    pub clearance: Option<f64>,
    /// Places for joints.
    pub holes: Vec<Hole>,
    /// Least `sigma_min / sigma_max` of the length-normalised Jacobian at the poses.
    pub conditioning: f64,
    /// Greatest distance of a joint from the centroid of the leg ends of its body.
    pub reach: f64,
    /// The poses, at least one.
    pub poses: Vec<Pose>,
    /// Length that turns angles into lengths in the Jacobian.
    pub characteristic_length: f64,
}

impl Targets {
    pub(super) fn validate(&self) -> Result<(), SearchError> {
        let limits = [
            ("spacing", self.spacing),
            ("clearance", self.clearance.unwrap_or(0.0)),
            ("conditioning", self.conditioning),
            ("reach", self.reach),
            ("characteristic_length", self.characteristic_length),
        ];
        if let Some((what, value)) = limits.into_iter().find(|(_, x)| !(*x >= 0.0 && x.is_finite())) {
            return Err(SearchError::Limit { what, value });
        }
        if self.poses.is_empty() { Err(SearchError::NoPoses) } else { Ok(()) }
    }
}

num::words! {
    /// A requirement of the search.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Target as name {
        /// Distance of joints; joints shared in the pattern count only if sharing is forbidden.
        Spacing = "spacing",
        /// Distance of legs.
        Clearance = "clearance",
        /// Condition of the Jacobian.
        Conditioning = "conditioning",
        /// Greatest distance of the joints from the centre.
        Reach = "reach",
    }
}

#[cfg(feature = "serde")]
num::written_as_word!(Target);

/// The margin of a requirement.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema), schemars(rename = "TargetMarginRecord", transform = num::nullable))]
pub struct TargetMargin {
    /// The requirement.
    #[cfg_attr(feature = "serde", schemars(extend("enum" = ["spacing", "clearance", "conditioning", "reach"])))]
    pub target: Target,
    /// The value of the platform.
    // design units, a ratio for the conditioning
    pub value: f64,
    /// The required value.
    // the greatest value for the reach, the least one for the others
    pub required: f64,
    /// Difference over the size.
    // for the conditioning the difference itself; negative for a miss
    pub slack: f64,
}

/// The possible legs at a hole.
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
    /// There is no replaceable leg.
    None,
}

num::answer_words! {
    /// The legs of equivalent platforms at a hole.
    pub enum HoleWord as name of HoleAnswer {
        /// There are replaceable legs.
        Legs = "legs",
        /// The other ends are all at infinity.
        AtInfinity = "at_infinity",
        /// There is no replaceable leg.
        None = "none",
    }
}

/// A hole with the decision about it.
#[derive(Debug, Clone, PartialEq)]
pub struct CheckedHole {
    /// The hole.
    pub hole: Hole,
    /// The answer within the tolerance.
    pub answer: HoleAnswer,
    /// The smallest singular value of the equations of the partners (unit equations, unit point); zero if there are
    /// partners.
    pub singular_value: f64,
    /// Dimension of the space of homogeneous partners of the hole as written, by exact arithmetic.
    pub exact: Option<usize>,
    /// Whether all of these partners are at infinity.
    exactly_at_infinity: bool,
    /// Whether they are the partners in combinations of the legs that were not named for the hole. A leg there then
    /// replaces none of the named ones. `false` without exact partners.
    pub(super) exactly_by_others: bool,
    /// Threshold for zero.
    pub tolerance: f64,
}

impl CheckedHole {
    /// The proof that the requirement cannot be met, if there is one.
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
) -> Result<Vec<CheckedHole>, LinalgError> {
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
        out.push(CheckedHole {
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

/// The kernel of the equations `<n_r, alpha (x) beta> = 0`, with an orthonormal basis `n_r` of the complement of the
/// span and the hole `alpha`.
fn partners(span: &LegSpan, hole: &Hole, tolerance: f64) -> Result<(HoleAnswer, f64), LinalgError> {
    let n = span.normalisation();
    let on_base = hole.body == Body::Base;
    // the leg with the hole at both ends: only the end on its own body is used
    let place = n.apply(&platform::manipulator::Leg { base: hole.point, platform: hole.point });
    let x = place.end(hole.body);
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
    // the kernel vector farthest from infinity, and an orthonormal basis of its complement, whose vectors are
    // directions
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
