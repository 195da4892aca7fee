//! Answers about the families of replaceable legs of a design.

use nalgebra::Point3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Number, leg_number};
use ask::{ReplaceableFamily, ReplaceableLegs};
use platform::manipulator::{Leg, LegIndex};
use synthesis::components::{
    Component, Components, CubicPencil, CurvePart, Decision, ExactCurve, ExactPart, ExactPoint, FlatPair,
    MovingPoint, NoExactCurve, Parametrisation, PlaneCurve, PlanePair, SampledLeg, SingularPoint, flat_name,
};

view! {
    /// The answer of `equivalents components`.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct ComponentsAnswer {
        /// The name of the design.
        pub name: String = name.to_owned(),
        /// The threshold for zero, relative to the size of the body.
        pub tolerance: f64 = search.tolerance,
        /// Rank of the leg vectors.
        pub leg_rank: usize = found.leg_rank.value,
        /// The decision about this rank.
        pub leg_rank_decision: DecisionRecord = (&found.leg_rank).into(),
        /// Number of families.
        pub count: usize = found.components.len(),
        /// Whether the list of families is complete.
        pub complete: bool = found.doubts.is_empty(),
        /// Doubts that the list is complete.
        pub doubts: Vec<String> = found.doubts.clone(),
        /// Pairs of flats spanned by legs.
        pub pairs: Vec<FlatPairRecord> = found.pairs.iter().map(FlatPairRecord::from).collect(),
        /// Pairs of planes with curves of replaceable joints.
        pub planes: Vec<PlanePairRecord> = planes.collect(),
        /// The families.
        pub components: Vec<ComponentRecord> = families.iter().map(component).collect(),
    }
    /// The answer about the design of this name: all results, and the requested families.
    pub fn new(name: &str, replaceable: &ReplaceableLegs) {
        let ReplaceableLegs { found, families, search, .. } = replaceable;
        let component =
            |f: &ReplaceableFamily| ComponentRecord::new(f.index, &found.components[f.index], &f.samples);
        let planes = found.planes.iter().map(|p| PlanePairRecord::of(found, p));
    }
}

view! {
    /// A dimension or rank, with the evidence for its value.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct DecisionRecord {
        /// The quantity decided.
        #[schemars(extend("enum" = [
            "base_dimension", "platform_dimension", "leg_rank", "rank_over_base", "rank_over_platform", "common_factor", "line_factor",
            "conic_rank", "singular_point"
        ]))]
        pub question: String = d.question.name().into(),
        /// The value used.
        pub value: usize = d.value,
        /// The value by the tolerance.
        pub numerical: usize = d.numerical,
        /// The value in exact arithmetic; null: not computed.
        pub exact: Option<usize> = d.exact,
        /// Whether exact arithmetic confirms the value; null: not computed.
        pub agrees: Option<bool> = d.agrees(),
        /// Smallest number taken as nonzero.
        pub above: Option<Number> = d.above.map(Number),
        /// Largest number taken as zero.
        pub below: Option<Number> = d.below.map(Number),
        /// The threshold between these two numbers.
        pub tolerance: Number = Number(d.tolerance),
    }
    impl From(d: &Decision) {}
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

view! {
    /// A pair of flats spanned by its legs.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct FlatPairRecord {
        /// The legs, from 1.
        pub legs: Vec<usize> = legs(&p.legs),
        /// The flat of the base: point, line, plane or space.
        pub base: String = flat_name(p.base).into(),
        /// The flat of the platform: point, line, plane or space.
        pub platform: String = flat_name(p.platform).into(),
        /// Rank of their leg vectors.
        pub rank: usize = p.rank,
        /// Dimension expected by counting equations; may be negative.
        pub expected_dimension: isize = p.expected_dimension,
        /// Dimension found.
        pub dimension: usize = p.dimension,
        /// Whether the flats fit the joints as written, or only within the tolerance.
        pub reading: String = p.reading.name().into(),
        /// Dimensions and ranks with evidence.
        pub decisions: Vec<DecisionRecord> = decisions(&p.decisions),
    }
    impl From(p: &FlatPair) {}
}

/// `sum equations[r][p][q] alpha_p beta_q = 0` with `alpha = (1, x, y)` on the base and `beta` on the platform.
pub type Bilinear = Vec<[[Number; 3]; 3]>;

view! {
    /// A pair of planes with the curves of points that carry replaceable legs.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct PlanePairRecord {
        /// Number of the pair in `pairs`, from 1.
        pub pair: usize = p.pair + 1,
        /// The legs in the planes, from 1.
        pub legs: Vec<usize> = legs(&found.pairs[p.pair].legs),
        /// Whether the flats fit the joints as written, or only within the tolerance.
        pub reading: String = found.pairs[p.pair].reading.name().into(),
        /// Whether both curves are smooth; null: not decided.
        pub smooth: Option<bool> = p.smooth,
        /// The curve of the base.
        pub base: PlaneCurveRecord = (&p.base).into(),
        /// The curve of the platform.
        pub platform: PlaneCurveRecord = (&p.platform).into(),
        /// The correspondence of points: `sum equations[r][p][q] alpha_p beta_q = 0`, `alpha = (1, x, y)` on the base,
        /// `beta` on the platform.
        pub equations: Bilinear = bilinear(&p.equations),
    }
    fn of(found: &Components, p: &PlanePair) {}
}

view! {
    /// A plane curve of points that carry replaceable legs.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct PlaneCurveRecord {
        /// The origin of plane coordinates, body frame.
        pub origin: [Number; 3] = point(&c.origin),
        /// Point `(x, y)` is `origin + x axes[0] + y axes[1]`.
        pub axes: [[Number; 3]; 2] = c.axes.map(|a| [a.x, a.y, a.z].map(Number)),
        /// The degree of the curve.
        pub degree: usize = c.degree,
        /// Coefficients in monomial order.
        pub coefficients: Vec<Number> = numbers(&c.coefficients),
        /// Monomials.
        pub monomials: Vec<String> = monomials(c.degree),
        /// Rank of the equations at a generic point.
        pub generic_rank: usize = c.generic_rank,
        /// Components of the curve.
        pub parts: Vec<CurvePart> = c.parts.clone(),
        /// Singular points.
        pub singular_points: Vec<SingularPointRecord> = c
            .singular_points
            .iter()
            .map(SingularPointRecord::of)
            .collect(),
        /// Dimensions and ranks with evidence.
        pub decisions: Vec<DecisionRecord> = decisions(&c.decisions),
        /// Curve for the joints as rational numbers, or the reason why there is none.
        pub exact: ExactCurveOutcome = (&c.exact).into(),
    }
    impl From(c: &PlaneCurve) {}
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

view! {
    /// A singular point of a plane curve.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct SingularPointRecord {
        /// The point, body frame; null: at infinity.
        pub point: Option<[Number; 3]> = s.point.as_ref().map(point),
        /// Homogeneous plane coordinates.
        pub coordinates: [Number; 3] = s.coordinates.map(Number),
        /// Type.
        #[schemars(extend("enum" = ["crossing", "isolated", "cusp", "triple"]))]
        pub kind: String = s.kind.name().into(),
        /// Gradient of the equation at the point.
        pub gradient: Number = Number(s.gradient),
        /// Whether it corresponds to a whole line of the other plane.
        pub line_of_partners: bool = s.line_of_partners,
    }
    fn of(s: &SingularPoint) {}
}

/// Curve for the joints as rational numbers, or the reason why there is none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
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

view! {
    /// A plane curve with integer coefficients.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct ExactCurveRecord {
        /// Body coordinates used as plane coordinates.
        pub axes: [String; 2] = curve.axes.map(|k| ["x", "y", "z"][k].to_owned()),
        /// Rank of the equations at a generic point.
        pub generic_rank: usize = curve.generic_rank,
        /// The degree of the curve.
        pub degree: usize = curve.degree,
        /// Integers as text.
        pub coefficients: Vec<String> = curve.coefficients.clone(),
        /// Components over the complex numbers.
        pub parts: Vec<ExactPart> = curve.parts.clone(),
        /// Whether the curve is smooth; null: not decided.
        pub smooth: Option<bool> = curve.smooth,
        /// Singular point; null: none is known.
        pub singular_point: Option<ExactPoint> = curve.singular_point.clone(),
    }
    fn of(curve: &ExactCurve) {}
}

impl From<&Result<ExactCurve, NoExactCurve>> for ExactCurveOutcome {
    fn from(c: &Result<ExactCurve, NoExactCurve>) -> Self {
        let curve = match c {
            Ok(curve) => curve,
            Err(reason) => return Self::None { reason: reason.to_string() },
        };
        Self::Curve(ExactCurveRecord::of(curve))
    }
}

view! {
    /// A family of replaceable legs.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct ComponentRecord {
        /// The number of the family, from 1.
        pub component: usize = k + 1,
        /// Type such as point-line.
        #[serde(rename = "type")]
        pub type_name: String = c.type_name(),
        /// The set that its legs form.
        #[schemars(extend("enum" = ["all_pairs", "over_line", "over_conic", "over_plane", "over_cubic"]))]
        pub kind: String = c.kind.name().into(),
        /// Flat of its base ends.
        pub base: String = flat_name(c.base_span).into(),
        /// Flat of its platform ends.
        pub platform: String = flat_name(c.platform_span).into(),
        /// The dimension of the family.
        pub dimension: usize = c.dimension,
        /// Legs of the design in it, from 1.
        pub legs: Vec<usize> = legs(&c.legs),
        /// Legs of the design, from 1; every leg vector of the family is a combination of theirs.
        pub support: Vec<usize> = legs(&c.support),
        /// Whether it is exact. False: it exists only within the tolerance; null: not decided exactly.
        pub exact: Option<bool> = c.exact,
        /// Larger families that contain it, from 1.
        pub contained_in: Vec<usize> = c.contained_in.iter().map(|l| l + 1).collect(),
        /// Formulas of its legs.
        pub parametrisation: ParametrisationRecord = (&c.parametrisation).into(),
        /// Parameter values without finite leg.
        pub at_infinity: Vec<Number> = numbers(&c.at_infinity),
        /// Dimensions and ranks with evidence.
        pub decisions: Vec<DecisionRecord> = decisions(&c.decisions),
        /// Random legs.
        pub samples: Vec<SampledLegRecord> = samples.iter().map(SampledLegRecord::from).collect(),
    }
    /// The record of family `k` (from 0) with legs drawn from it.
    pub fn new(k: usize, c: &Component, samples: &[SampledLeg]) {}
}

/// Formulas of the legs of a family.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
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
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
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

view! {
    /// The ends of a leg.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct LegEndsRecord {
        /// The base end, base frame, design units.
        pub base: [Number; 3] = point(&l.base),
        /// The platform end, platform frame, design units.
        pub platform: [Number; 3] = point(&l.platform),
    }
    impl From(l: &Leg) {}
}

view! {
    /// A leg drawn from a family.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct SampledLegRecord {
        /// The parameters of the leg.
        pub parameters: Vec<Number> = numbers(&s.parameters),
        /// Ends of the leg.
        #[serde(flatten)]
        pub ends: LegEndsRecord = (&s.leg).into(),
        /// Coefficients of the six squared leg lengths.
        pub coefficients: [Number; 6] = s.coefficients.map(Number),
        /// Residual of the leg vector after subtracting this combination.
        pub residual: Number = Number(s.residual),
    }
    impl From(s: &SampledLeg) {}
}
