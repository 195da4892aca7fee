//! Answers about the families of replaceable legs of a design.

use nalgebra::Point3;
use schemars::JsonSchema;
use serde::Serialize;

use super::{Number, leg_number};
use ask::{ReplaceableFamily, ReplaceableLegs};
use platform::manipulator::{Leg, LegIndex};
use synthesis::components::{
    Component, CubicPencil, CurvePart, Decision, ExactCurve, ExactPart, ExactPoint, FlatPair, MovingPoint,
    NoExactCurve, Parametrisation, PlaneCurve, SampledLeg, flat_name,
};

/// The answer of `equivalents components`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ComponentsAnswer {
    /// The name of the design.
    pub name: String,
    /// The threshold for zero, relative to the size of the body.
    pub tolerance: f64,
    /// Rank of the leg vectors.
    pub leg_rank: usize,
    /// The decision about this rank.
    pub leg_rank_decision: DecisionRecord,
    /// Number of families.
    pub count: usize,
    /// Whether the list of families is complete.
    pub complete: bool,
    /// Doubts that the list is complete.
    pub doubts: Vec<String>,
    /// Pairs of flats spanned by legs.
    pub pairs: Vec<FlatPairRecord>,
    /// Pairs of planes with curves of replaceable joints.
    pub planes: Vec<PlanePairRecord>,
    /// The families.
    pub components: Vec<ComponentRecord>,
}

/// A dimension or rank, with the evidence for its value.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct DecisionRecord {
    /// The quantity decided.
    #[schemars(extend("enum" = [
        "base_dimension", "platform_dimension", "leg_rank", "rank_over_base", "rank_over_platform", "common_factor", "line_factor",
        "conic_rank", "singular_point"
    ]))]
    pub question: String,
    /// The value used.
    pub value: usize,
    /// The value by the tolerance.
    pub numerical: usize,
    /// The value in exact arithmetic; null: not computed.
    pub exact: Option<usize>,
    /// Whether exact arithmetic confirms the value; null: not computed.
    pub agrees: Option<bool>,
    /// Smallest number taken as nonzero.
    pub above: Option<Number>,
    /// Largest number taken as zero.
    pub below: Option<Number>,
    /// The threshold between these two numbers.
    pub tolerance: Number,
}

impl From<&Decision> for DecisionRecord {
    fn from(d: &Decision) -> Self {
        Self {
            question: d.question.name().into(),
            value: d.value,
            numerical: d.numerical,
            exact: d.exact,
            agrees: d.agrees(),
            above: d.above.map(Number),
            below: d.below.map(Number),
            tolerance: Number(d.tolerance),
        }
    }
}

fn decisions(list: &[Decision]) -> Vec<DecisionRecord> {
    list.iter().map(DecisionRecord::from).collect()
}

fn numbers<'a>(x: impl IntoIterator<Item = &'a f64>) -> Vec<Number> {
    x.into_iter().copied().map(Number).collect()
}

fn legs(list: &[LegIndex]) -> Vec<usize> {
    list.iter().copied().map(leg_number).collect()
}

fn point(p: &Point3<f64>) -> [Number; 3] {
    [p.x, p.y, p.z].map(Number)
}

/// A pair of flats spanned by its legs.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FlatPairRecord {
    /// The legs, from 1.
    pub legs: Vec<usize>,
    /// The flat of the base: point, line, plane or space.
    pub base: String,
    /// The flat of the platform: point, line, plane or space.
    pub platform: String,
    /// Rank of their leg vectors.
    pub rank: usize,
    /// Dimension expected by counting equations; may be negative.
    pub expected_dimension: isize,
    /// Dimension found.
    pub dimension: usize,
    /// Whether the flats fit the joints as written, or only within the tolerance.
    pub reading: String,
    /// Dimensions and ranks with evidence.
    pub decisions: Vec<DecisionRecord>,
}

impl From<&FlatPair> for FlatPairRecord {
    fn from(p: &FlatPair) -> Self {
        Self {
            legs: legs(&p.legs),
            base: flat_name(p.base).into(),
            platform: flat_name(p.platform).into(),
            rank: p.rank,
            expected_dimension: p.expected_dimension,
            dimension: p.dimension,
            reading: p.reading.name().into(),
            decisions: decisions(&p.decisions),
        }
    }
}

/// `sum equations[r][p][q] alpha_p beta_q = 0` with `alpha = (1, x, y)` on the base and `beta` on the platform.
pub type Bilinear = Vec<[[Number; 3]; 3]>;

/// A pair of planes with the curves of points that carry replaceable legs.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct PlanePairRecord {
    /// Number of the pair in `pairs`, from 1.
    pub pair: usize,
    /// The legs in the planes, from 1.
    pub legs: Vec<usize>,
    /// Whether the flats fit the joints as written, or only within the tolerance.
    pub reading: String,
    /// Whether both curves are smooth; null: not decided.
    pub smooth: Option<bool>,
    /// The curve of the base.
    pub base: PlaneCurveRecord,
    /// The curve of the platform.
    pub platform: PlaneCurveRecord,
    /// The correspondence of points: `sum equations[r][p][q] alpha_p beta_q = 0`, `alpha = (1, x, y)` on the base,
    /// `beta` on the platform.
    pub equations: Bilinear,
}

/// A plane curve of points that carry replaceable legs.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct PlaneCurveRecord {
    /// The origin of plane coordinates, body frame.
    pub origin: [Number; 3],
    /// Point `(x, y)` is `origin + x axes[0] + y axes[1]`.
    pub axes: [[Number; 3]; 2],
    /// The degree of the curve.
    pub degree: usize,
    /// Coefficients in monomial order.
    pub coefficients: Vec<Number>,
    /// Monomials.
    pub monomials: Vec<String>,
    /// Rank of the equations at a generic point.
    pub generic_rank: usize,
    /// Components of the curve.
    pub parts: Vec<CurvePart>,
    /// Singular points.
    pub singular_points: Vec<SingularPointRecord>,
    /// Dimensions and ranks with evidence.
    pub decisions: Vec<DecisionRecord>,
    /// Curve for the joints as rational numbers, or the reason why there is none.
    pub exact: ExactCurveOutcome,
}

impl From<&PlaneCurve> for PlaneCurveRecord {
    fn from(c: &PlaneCurve) -> Self {
        Self {
            origin: point(&c.origin),
            axes: c.axes.map(|a| [a.x, a.y, a.z].map(Number)),
            degree: c.degree,
            coefficients: numbers(&c.coefficients),
            monomials: monomials(c.degree),
            generic_rank: c.generic_rank,
            parts: c.parts.clone(),
            singular_points: c
                .singular_points
                .iter()
                .map(|s| SingularPointRecord {
                    point: s.point.as_ref().map(point),
                    coordinates: s.coordinates.map(Number),
                    kind: s.kind.name().into(),
                    gradient: Number(s.gradient),
                    line_of_partners: s.line_of_partners,
                })
                .collect(),
            decisions: decisions(&c.decisions),
            exact: (&c.exact).into(),
        }
    }
}

/// Names of the monomials of a plane curve in the order of its coefficients.
fn monomials(degree: usize) -> Vec<String> {
    let power = |x: &str, n: usize| match n {
        0 => String::new(),
        1 => x.to_string(),
        _ => format!("{x}^{n}"),
    };
    let term = |j: usize, k: usize| match (power("x", j), power("y", k)) {
        (x, y) if x.is_empty() && y.is_empty() => "1".to_string(),
        (x, y) if x.is_empty() || y.is_empty() => x + &y,
        (x, y) => format!("{x} {y}"),
    };
    (0..=degree).flat_map(|n| (0..=n).map(move |k| term(n - k, k))).collect()
}

/// A singular point of a plane curve.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SingularPointRecord {
    /// The point, body frame; null: at infinity.
    pub point: Option<[Number; 3]>,
    /// Homogeneous plane coordinates.
    pub coordinates: [Number; 3],
    /// Type.
    #[schemars(extend("enum" = ["crossing", "isolated", "cusp", "triple"]))]
    pub kind: String,
    /// Gradient of the equation at the point.
    pub gradient: Number,
    /// Whether it corresponds to a whole line of the other plane.
    pub line_of_partners: bool,
}

/// Curve for the joints as rational numbers, or the reason why there is none.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum ExactCurveOutcome {
    /// The curve.
    Curve(ExactCurveRecord),
    /// No exact curve.
    None {
        /// The reason.
        reason: String,
    },
}

/// A plane curve with integer coefficients.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ExactCurveRecord {
    /// Body coordinates used as plane coordinates.
    pub axes: [String; 2],
    /// Rank of the equations at a generic point.
    pub generic_rank: usize,
    /// The degree of the curve.
    pub degree: usize,
    /// Integers as text.
    pub coefficients: Vec<String>,
    /// Components over the complex numbers.
    pub parts: Vec<ExactPart>,
    /// Whether the curve is smooth; null: not decided.
    pub smooth: Option<bool>,
    /// Singular point; null: none is known.
    pub singular_point: Option<ExactPoint>,
}

impl From<&Result<ExactCurve, NoExactCurve>> for ExactCurveOutcome {
    fn from(c: &Result<ExactCurve, NoExactCurve>) -> Self {
        let curve = match c {
            Ok(curve) => curve,
            Err(reason) => return Self::None { reason: reason.to_string() },
        };
        Self::Curve(ExactCurveRecord {
            axes: curve.axes.map(|k| ["x", "y", "z"][k].to_owned()),
            generic_rank: curve.generic_rank,
            degree: curve.degree,
            coefficients: curve.coefficients.clone(),
            parts: curve.parts.clone(),
            smooth: curve.smooth,
            singular_point: curve.singular_point.clone(),
        })
    }
}

/// A family of replaceable legs.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ComponentRecord {
    /// The number of the family, from 1.
    pub component: usize,
    /// Type such as point-line.
    #[serde(rename = "type")]
    pub type_name: String,
    /// The set that its legs form.
    #[schemars(extend("enum" = ["all_pairs", "over_line", "over_conic", "over_plane", "over_cubic"]))]
    pub kind: String,
    /// Flat of its base ends.
    pub base: String,
    /// Flat of its platform ends.
    pub platform: String,
    /// The dimension of the family.
    pub dimension: usize,
    /// Legs of the design in it, from 1.
    pub legs: Vec<usize>,
    /// Legs of the design, from 1; every leg vector of the family is a combination of theirs.
    pub support: Vec<usize>,
    /// Whether it is exact. False: it exists only within the tolerance; null: not decided exactly.
    pub exact: Option<bool>,
    /// Larger families that contain it, from 1.
    pub contained_in: Vec<usize>,
    /// Formulas of its legs.
    pub parametrisation: ParametrisationRecord,
    /// Parameter values without finite leg.
    pub at_infinity: Vec<Number>,
    /// Dimensions and ranks with evidence.
    pub decisions: Vec<DecisionRecord>,
    /// Random legs.
    pub samples: Vec<SampledLegRecord>,
}

/// Formulas of the legs of a family.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum ParametrisationRecord {
    /// Rational functions of the parameters.
    Rational {
        /// Number of parameters.
        parameters: usize,
        /// Terms of the homogeneous coordinates (c0, c1, c2, c3) of the base end, the point (c1, c2, c3) / c0, base
        /// frame.
        base: Vec<MovingTermRecord>,
        /// Terms of the homogeneous coordinates of the platform end, platform frame.
        platform: Vec<MovingTermRecord>,
    },
    /// A plane cubic, parametrised by a pencil of lines through one of its points.
    Cubic {
        /// Number of parameters: 1.
        #[schemars(extend("const" = 1))]
        parameters: usize,
        /// Centre of the pencil on the cubic, homogeneous plane coordinates.
        centre: Vec<Number>,
        /// The coefficients of the cubic.
        cubic: Vec<Number>,
        /// Origin and axes of the base plane, base frame.
        base_frame: Vec<[Number; 3]>,
        /// Origin and axes of the platform plane, platform frame.
        platform_frame: Vec<[Number; 3]>,
        /// The correspondence of points: `sum equations[r][p][q] alpha_p beta_q = 0`, `alpha = (1, x, y)` on the base,
        /// `beta` on the platform.
        equations: Bilinear,
    },
}

/// A term of the homogeneous coordinates of a leg end.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct MovingTermRecord {
    /// The exponents of the parameters.
    pub exponents: [u8; 3],
    /// The coefficients of (c0, c1, c2, c3).
    pub coefficient: [Number; 4],
}

fn moving(p: &MovingPoint) -> Vec<MovingTermRecord> {
    let term = |(exponents, c): &([u8; 3], [f64; 4])| MovingTermRecord {
        exponents: *exponents,
        coefficient: c.map(Number),
    };
    p.terms.iter().map(term).collect()
}

fn bilinear(list: &[[[f64; 3]; 3]]) -> Bilinear {
    list.iter().map(|m| m.map(|row| row.map(Number))).collect()
}

impl From<&Parametrisation> for ParametrisationRecord {
    fn from(p: &Parametrisation) -> Self {
        match p {
            Parametrisation::Rational { parameters, base, platform } => {
                Self::Rational { parameters: *parameters, base: moving(base), platform: moving(platform) }
            }
            Parametrisation::Cubic(c) => c.as_ref().into(),
        }
    }
}

impl From<&CubicPencil> for ParametrisationRecord {
    fn from(c: &CubicPencil) -> Self {
        Self::Cubic {
            parameters: 1,
            centre: numbers(&c.centre),
            cubic: numbers(&c.cubic),
            base_frame: c.base_frame.iter().map(|v| [v.x, v.y, v.z].map(Number)).collect(),
            platform_frame: c.platform_frame.iter().map(|v| [v.x, v.y, v.z].map(Number)).collect(),
            equations: bilinear(&c.equations),
        }
    }
}

/// The ends of a leg.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct LegEndsRecord {
    /// The base end, base frame, design units.
    pub base: [Number; 3],
    /// The platform end, platform frame, design units.
    pub platform: [Number; 3],
}

impl From<&Leg> for LegEndsRecord {
    fn from(l: &Leg) -> Self {
        Self { base: point(&l.base), platform: point(&l.platform) }
    }
}

/// A leg drawn from a family.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SampledLegRecord {
    /// The parameters of the leg.
    pub parameters: Vec<Number>,
    /// Ends of the leg.
    #[serde(flatten)]
    pub ends: LegEndsRecord,
    /// Coefficients of the six squared leg lengths.
    pub coefficients: [Number; 6],
    /// Residual of the leg vector after subtracting this combination.
    pub residual: Number,
}

impl From<&SampledLeg> for SampledLegRecord {
    fn from(s: &SampledLeg) -> Self {
        Self {
            parameters: numbers(&s.parameters),
            ends: (&s.leg).into(),
            coefficients: s.coefficients.map(Number),
            residual: Number(s.residual),
        }
    }
}

impl ComponentRecord {
    /// The record of family `k` (from 0) with legs drawn from it.
    #[must_use]
    pub fn new(k: usize, c: &Component, samples: &[SampledLeg]) -> Self {
        Self {
            component: k + 1,
            type_name: c.type_name(),
            kind: c.kind.name().into(),
            base: flat_name(c.base_span).into(),
            platform: flat_name(c.platform_span).into(),
            dimension: c.dimension,
            legs: legs(&c.legs),
            support: legs(&c.support),
            exact: c.exact,
            contained_in: c.contained_in.iter().map(|l| l + 1).collect(),
            parametrisation: (&c.parametrisation).into(),
            at_infinity: numbers(&c.at_infinity),
            decisions: decisions(&c.decisions),
            samples: samples.iter().map(SampledLegRecord::from).collect(),
        }
    }
}

impl ComponentsAnswer {
    /// The answer about the design of this name: all results, and the requested families.
    #[must_use]
    pub fn new(name: &str, replaceable: &ReplaceableLegs) -> Self {
        let ReplaceableLegs { found, families, search } = replaceable;
        let component =
            |f: &ReplaceableFamily| ComponentRecord::new(f.index, &found.components[f.index], &f.samples);
        let planes = found.planes.iter().map(|p| PlanePairRecord {
            pair: p.pair + 1,
            legs: legs(&found.pairs[p.pair].legs),
            reading: found.pairs[p.pair].reading.name().into(),
            smooth: p.smooth,
            base: (&p.base).into(),
            platform: (&p.platform).into(),
            equations: bilinear(&p.equations),
        });
        Self {
            name: name.to_owned(),
            tolerance: search.tolerance,
            leg_rank: found.leg_rank.value,
            leg_rank_decision: (&found.leg_rank).into(),
            count: found.components.len(),
            complete: found.doubts.is_empty(),
            doubts: found.doubts.clone(),
            pairs: found.pairs.iter().map(FlatPairRecord::from).collect(),
            planes: planes.collect(),
            components: families.iter().map(component).collect(),
        }
    }
}
