//! Verdicts as JSON and as text.

use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use crate::cli::commands::map;
use crate::cli::output::number;
use crate::equivalence::{Counterexample, Sample, SamplePlan, Verdict, Verification};
use crate::fk::FkSolutions;
use crate::synthesis::LegMapOutcome;

/// The fields of the document.
pub(crate) fn record(v: &Verification, plan: &SamplePlan) -> Map<String, Value> {
    let mut fields = Map::new();
    let mut put = |key: &str, value: Value| fields.insert(key.into(), value);
    put("verdict", json!(v.verdict.as_str()));
    put("explanation", json!(explanation(v)));
    put("map", Value::Object(map::record(&v.map)));
    put("worst_distance", number(v.worst_distance()));
    let [a, b] = v.beyond_precision();
    put("beyond_precision", json!({ "a": a, "b": b }));
    put("samples", v.samples.iter().map(sample).collect());
    if let Verdict::NotEquivalent(c) = &v.verdict {
        put("counterexample", counterexample(c));
    }
    put(
        "sampling",
        json!({
            "count": plan.count,
            "seed": plan.seed,
            "home_position": plan.home.position.as_slice(),
            "translation_half_widths": plan.translation.as_slice(),
            "rotation_half_widths_rad": plan.rotation.as_slice(),
        }),
    );
    fields
}

/// The word for designs that no rigid motions, or none that were found, make equivalent.
pub(super) fn unaligned_verdict(none: bool) -> &'static str {
    if none { "not_equivalent" } else { "inconclusive" }
}

/// The fields of the document where an alignment was asked for and not found; `map` is that of the designs as they are given.
pub(super) fn unaligned(map: &LegMapOutcome, none: bool, explanation: &str) -> Map<String, Value> {
    let mut fields = Map::new();
    fields.insert("verdict".into(), json!(unaligned_verdict(none)));
    fields.insert("explanation".into(), json!(explanation));
    fields.insert("map".into(), Value::Object(map::record(map)));
    fields.insert("worst_distance".into(), Value::Null);
    fields.insert("samples".into(), json!([]));
    fields
}

fn solutions(s: &FkSolutions) -> Value {
    json!({
        "method": s.method.name(),
        "completeness": s.completeness.name(),
        "completeness_reason": s.completeness_reason(),
        "all_paths_accounted": s.all_accounted(),
        "finite_count": s.roots.len(),
        "real_count": s.assembly_modes().count(),
        "certified_count": s.roots.iter().filter(|r| r.certified()).count(),
    })
}

fn sample(s: &Sample) -> Value {
    json!({
        "lengths_a": s.squares_a.lengths().get(),
        "lengths_b": s.squares_b.lengths().get(),
        "a": solutions(&s.solutions_a),
        "b": solutions(&s.solutions_b),
        "matched": s.matching.pairs.len(),
        "only_a": s.matching.only_a.len(),
        "only_b": s.matching.only_b.len(),
        "beyond_precision_a": s.matching.beyond_a.len(),
        "beyond_precision_b": s.matching.beyond_b.len(),
        "worst_distance": number(s.matching.worst_distance()),
        "agrees": s.agrees(),
    })
}

fn counterexample(c: &Counterexample) -> Value {
    let part = |pick: fn(&num_complex::Complex64) -> f64| {
        json!({
            "R": (0..3).map(|i| (0..3).map(|j| number(pick(&c.pose.rotation[(i, j)]))).collect::<Value>()).collect::<Value>(),
            "p": c.pose.position.iter().map(|z| number(pick(z))).collect::<Value>(),
        })
    };
    json!({
        "sample": c.sample,
        "solves": c.solves,
        "pose": { "re": part(|z| z.re), "im": part(|z| z.im) },
        "certified": c.certified,
        "leg": c.leg.get() + 1,
        "miss": number(c.miss),
        "rounding": number(c.rounding),
    })
}

/// One sentence with the numbers that decided.
fn explanation(v: &Verification) -> String {
    let n = v.samples.len();
    match &v.verdict {
        Verdict::Equivalent => format!(
            "the leg map is regular (det A = {:.6}), and forward kinematics of both, solved independently, agrees \
             at {n} of {n} sets of lengths; worst distance of matched poses {:.1e}{}",
            v.map.determinant,
            v.worst_distance(),
            set_aside(v)
        ),
        Verdict::Singular => map::explanation(&v.map),
        Verdict::NotEquivalent(c) => {
            let other = if c.solves == "A" { "B" } else { "A" };
            format!(
                "no leg map exists (residual {:.1e}); at sample {} a {}pose of {} misses the squared length of {} of {other} \
                 by {:.1e} of the squared size (rounding {:.1e})",
                v.map.residual,
                c.sample + 1,
                if c.certified { "certified " } else { "" },
                c.solves,
                c.leg,
                c.miss,
                c.rounding
            )
        }
        Verdict::Inconclusive(reason) => reason.sentence().to_owned(),
    }
}

/// What is said about poses beyond precision, after the sentence.
fn set_aside(v: &Verification) -> String {
    let [a, b] = v.beyond_precision();
    match a + b {
        0 => String::new(),
        count => format!(
            "; {count} further pose{} so far out that the rounding of the joints decides whether they exist, left out",
            if count == 1 { "" } else { "s" }
        ),
    }
}

/// The remark behind the row of a sample.
fn remark(s: &Sample) -> String {
    let mut out = String::new();
    for (platform, beyond) in [("A", &s.matching.beyond_a), ("B", &s.matching.beyond_b)] {
        if !beyond.is_empty() {
            let _ = write!(out, "  {} of {platform} beyond double precision", beyond.len());
        }
    }
    if !s.is_conclusive() {
        out.push_str("  poses may be missing");
    }
    out
}

/// What people read.
pub(super) fn text(v: &Verification, a: &str, b: &str) -> String {
    let mut out = format!("{a} ~ {b}: {}\n{}\n", v.verdict.as_str(), explanation(v));
    if !v.samples.is_empty() {
        out.push_str("\nsample  poses A  poses B  matched  real  certified  worst distance\n");
    }
    for (k, s) in v.samples.iter().enumerate() {
        let certified = |f: &FkSolutions| f.roots.iter().filter(|r| r.certified()).count();
        let _ = writeln!(
            out,
            "{:>6}  {:>7}  {:>7}  {:>7}  {:>4}  {:>4}+{:<4}  {:>14.1e}{}",
            k + 1,
            s.solutions_a.roots.len(),
            s.solutions_b.roots.len(),
            s.matching.pairs.len(),
            s.solutions_b.assembly_modes().count(),
            certified(&s.solutions_a),
            certified(&s.solutions_b),
            s.matching.worst_distance(),
            remark(s),
        );
    }
    out
}
