//! The families as JSON.

use nalgebra::Point3;
use serde_json::{Map, Value, json};

use crate::cli::output::number;
use crate::manipulator::LegIndex;
use crate::synthesis::components::{
    Component, Components, Decision, ExactCurve, MovingPoint, NoExactCurve, Parametrisation, PlaneCurve,
    SampledLeg, flat_name,
};

fn numbers<'a>(x: impl IntoIterator<Item = &'a f64>) -> Value {
    x.into_iter().copied().map(number).collect()
}

fn legs(list: &[LegIndex]) -> Value {
    list.iter().map(|l| json!(l.get() + 1)).collect()
}

fn point(p: &Point3<f64>) -> Value {
    numbers(p.iter())
}

fn decision(d: &Decision) -> Value {
    json!({
        "question": d.question.as_str(), "value": d.value, "numerical": d.numerical, "exact": d.exact, "agrees": d.agrees(),
        "above": d.above.map(number), "below": d.below.map(number), "tolerance": number(d.tolerance),
    })
}

fn decisions(list: &[Decision]) -> Value {
    list.iter().map(decision).collect()
}

/// Everything but the families.
pub(super) fn summary(json: &mut Map<String, Value>, found: &Components) {
    json.insert("leg_rank".into(), json!(found.leg_rank.value));
    json.insert("leg_rank_decision".into(), decision(&found.leg_rank));
    json.insert("count".into(), json!(found.components.len()));
    json.insert("complete".into(), json!(found.doubts.is_empty()));
    json.insert("doubts".into(), json!(found.doubts));
    let pairs = found.pairs.iter().map(|p| {
        json!({
            "legs": legs(&p.legs), "base": flat_name(p.base), "platform": flat_name(p.platform), "rank": p.rank,
            "expected_dimension": p.expected_dimension, "dimension": p.dimension, "reading": p.reading.as_str(),
            "decisions": decisions(&p.decisions),
        })
    });
    json.insert("pairs".into(), pairs.collect());
    let planes = found.planes.iter().map(|p| {
        json!({
            "pair": p.pair + 1, "legs": legs(&found.pairs[p.pair].legs),
            "reading": found.pairs[p.pair].reading.as_str(), "smooth": p.smooth,
            "base": curve(&p.base), "platform": curve(&p.platform),
            "equations": p.equations.iter().map(|n| n.iter().map(numbers).collect()).collect::<Vec<Value>>(),
        })
    });
    json.insert("planes".into(), planes.collect());
}

/// The exact curve, or why there is none.
fn exact(c: &Result<ExactCurve, NoExactCurve>) -> Value {
    let curve = match c {
        Ok(curve) => curve,
        Err(reason) => return json!({ "reason": reason.to_string() }),
    };
    let parts = curve.parts.iter().map(|p| {
        json!({
            "kind": p.kind.as_str(), "degree": p.degree, "coefficients": p.coefficients, "multiplicity": p.multiplicity,
        })
    });
    json!({
        "axes": curve.axes.map(|k| ["x", "y", "z"][k]), "generic_rank": curve.generic_rank, "degree": curve.degree,
        "coefficients": curve.coefficients, "parts": parts.collect::<Value>(), "smooth": curve.smooth,
        "singular_point": curve.singular_point.as_ref().map(|p| {
            json!({ "coordinates": p.coordinates, "kind": p.kind.as_str() })
        }),
    })
}

fn curve(c: &PlaneCurve) -> Value {
    let parts = c.parts.iter().map(|p| {
        json!({
            "kind": p.kind.as_str(), "coefficients": numbers(&p.coefficients), "multiplicity": p.multiplicity,
            "measure": number(p.measure),
        })
    });
    let singular = c.singular_points.iter().map(|s| {
        json!({
            "point": s.point.as_ref().map(point), "coordinates": numbers(&s.coordinates), "kind": s.kind.as_str(),
            "gradient": number(s.gradient), "line_of_partners": s.line_of_partners,
        })
    });
    json!({
        "origin": point(&c.origin), "axes": c.axes.iter().map(|a| numbers(a.iter())).collect::<Vec<Value>>(),
        "degree": c.degree, "coefficients": numbers(&c.coefficients), "monomials": monomials(c.degree),
        "generic_rank": c.generic_rank, "parts": parts.collect::<Value>(),
        "singular_points": singular.collect::<Value>(), "decisions": decisions(&c.decisions), "exact": exact(&c.exact),
    })
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

fn moving(p: &MovingPoint) -> Value {
    let terms = p.terms.iter().map(|(e, c)| json!({ "exponents": e, "coefficient": numbers(c) }));
    terms.collect()
}

fn formulas(p: &Parametrisation) -> Value {
    match p {
        Parametrisation::Rational { parameters, base, platform } => json!({
            "type": "rational", "parameters": parameters, "base": moving(base), "platform": moving(platform),
        }),
        Parametrisation::Cubic(c) => json!({
            "type": "cubic", "parameters": 1, "centre": numbers(&c.centre), "cubic": numbers(&c.cubic),
            "base_frame": c.base_frame.iter().map(|v| numbers(v.iter())).collect::<Vec<Value>>(),
            "platform_frame": c.platform_frame.iter().map(|v| numbers(v.iter())).collect::<Vec<Value>>(),
            "equations": c.equations.iter().map(|n| n.iter().map(numbers).collect()).collect::<Vec<Value>>(),
        }),
    }
}

fn sample(s: &SampledLeg) -> Value {
    json!({
        "parameters": numbers(&s.parameters), "base": point(&s.leg.base), "platform": point(&s.leg.platform),
        "coefficients": numbers(&s.coefficients), "residual": number(s.residual),
    })
}

/// One family.
pub(super) fn component(k: usize, c: &Component, samples: &[SampledLeg]) -> Value {
    json!({
        "component": k + 1, "type": c.type_name(), "kind": c.kind.as_str(),
        "base": flat_name(c.base_span), "platform": flat_name(c.platform_span), "dimension": c.dimension,
        "legs": legs(&c.legs), "support": legs(&c.support), "exact": c.exact,
        "contained_in": c.contained_in.iter().map(|l| json!(l + 1)).collect::<Vec<Value>>(),
        "parametrisation": formulas(&c.parametrisation), "at_infinity": numbers(&c.at_infinity),
        "decisions": decisions(&c.decisions), "samples": samples.iter().map(sample).collect::<Vec<Value>>(),
    })
}
