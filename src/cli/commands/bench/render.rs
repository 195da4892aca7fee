//! The record and the table of a run.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use crate::bench::{Failure, LengthsFrom, Plan, ReferenceTimes, Report, problem};
use crate::cli::output::number;

/// Most failures listed for people; JSON has them all.
const LISTED: usize = 20;

fn histogram(counts: &BTreeMap<usize, u64>) -> Value {
    Value::Object(counts.iter().map(|(n, problems)| (n.to_string(), json!(problems))).collect())
}

/// A failure with the problem written out, so that it can be solved elsewhere.
fn failure(plan: &Plan, f: &Failure) -> Value {
    let mut out = json!({
        "k": f.k, "missed": f.missed, "spurious": f.spurious, "false_certificates": f.false_certificates,
        "found": f.found, "solver": f.solver,
    });
    if let Ok(drawn) = problem(plan.class, plan.lengths, plan.seed, f.k) {
        let point = |p: nalgebra::Point3<f64>| p.iter().map(|x| number(*x)).collect::<Value>();
        let legs = drawn.manipulator.legs();
        out["base"] = legs.iter().map(|l| point(l.base)).collect();
        out["platform"] = legs.iter().map(|l| point(l.platform)).collect();
        out["squared_lengths"] = drawn.squares.get().map(number).into_iter().collect();
    }
    out
}

/// The record of one class.
fn record(r: &Report, references: &ReferenceTimes) -> Map<String, Value> {
    let mut out = Map::new();
    let mut put = |key: &str, value: Value| out.insert(key.into(), value);
    put("class", json!(r.plan.class.name()));
    put("count", json!(r.plan.count));
    put("complete", json!(r.complete));
    put("certified", json!(r.certified));
    put("missed_roots", json!(r.missed_roots));
    put("spurious_roots", json!(r.spurious_roots));
    put("false_certificates", json!(r.false_certificates));
    put("median_us", number(r.median_us));
    put("p99_us", number(r.p99_us));
    put("worst_residual", number(r.worst_residual));
    put("reference_us", json!({ "qz69": number(references.qz69), "eig40": number(references.eig40) }));
    put(
        "ratio_to_reference",
        json!({
            "qz69": number(r.median_us / references.qz69), "eig40": number(r.median_us / references.eig40),
        }),
    );
    put("first", json!(r.plan.first));
    put("seed", json!(r.plan.seed));
    put("threads", json!(r.plan.threads));
    put(
        "lengths_from",
        json!(match r.plan.lengths {
            LengthsFrom::Pose => "pose",
            LengthsFrom::Uniform => "uniform",
        }),
    );
    put("expected_count", json!(r.expected));
    put("finite_counts", histogram(&r.finite_counts));
    put("real_counts", histogram(&r.real_counts));
    put("roots", json!(r.roots));
    put("certified_roots", json!(r.certified_roots));
    put("proved", json!(r.proved));
    put("doubted", json!(r.doubted));
    put("silent_failures", json!(r.silent_failures));
    put("rechecked", json!(r.rechecked));
    put("mean_us", number(r.mean_us));
    put(
        "split_us",
        json!({
            "solve": number(r.split.solve), "certify": number(r.split.certify), "validate": number(r.split.validate),
        }),
    );
    put("seconds", number(r.seconds));
    put(
        "epsilon",
        json!({
            "median": number(r.epsilon.median), "mean": number(r.epsilon.mean), "max": number(r.epsilon.max),
            "above_minus_5": number(r.epsilon.above_minus_5), "above_minus_6": number(r.epsilon.above_minus_6),
        }),
    );
    put("failures", r.failures.iter().map(|f| failure(&r.plan, f)).collect());
    out
}

/// Sums over several classes (times and residual: the worst), and `"rows"` with one record a class.
fn sums(asked: &str, reports: &[Report], references: &ReferenceTimes) -> Map<String, Value> {
    let sum = |of: fn(&Report) -> u64| json!(reports.iter().map(of).sum::<u64>());
    let worst = |of: fn(&Report) -> f64| number(reports.iter().map(of).fold(0.0, f64::max));
    let mut out = Map::new();
    let mut put = |key: &str, value: Value| out.insert(key.into(), value);
    put("class", json!(asked));
    put("count", sum(|r| r.plan.count));
    put("complete", sum(|r| r.complete));
    put("certified", sum(|r| r.certified));
    put("missed_roots", sum(|r| r.missed_roots));
    put("spurious_roots", sum(|r| r.spurious_roots));
    put("false_certificates", sum(|r| r.false_certificates));
    put("median_us", worst(|r| r.median_us));
    put("p99_us", worst(|r| r.p99_us));
    put("worst_residual", worst(|r| r.worst_residual));
    put("reference_us", json!({ "qz69": number(references.qz69), "eig40": number(references.eig40) }));
    put("rows", reports.iter().map(|r| Value::Object(record(r, references))).collect());
    out
}

/// The record of one class, or the sums over several.
pub(super) fn json(
    asked: &str,
    method: &str,
    reports: &[Report],
    references: &ReferenceTimes,
) -> Map<String, Value> {
    let mut out =
        if let [one] = reports { record(one, references) } else { sums(asked, reports, references) };
    out.insert("method".into(), json!(method));
    out
}

/// What people read.
pub(super) fn text(reports: &[Report], references: &ReferenceTimes) -> String {
    let mut out = format!(
        "{:<14} {:>7} {:>5} {:>8} {:>9} {:>7} {:>6} {:>8} {:>5} {:>10} {:>10} {:>8}\n",
        "class",
        "count",
        "poses",
        "complete",
        "certified",
        "proved",
        "missed",
        "spurious",
        "false",
        "median us",
        "p99 us",
        "residual"
    );
    for r in reports {
        let _ = writeln!(
            out,
            "{:<14} {:>7} {:>5} {:>8} {:>9} {:>7} {:>6} {:>8} {:>5} {:>10.1} {:>10.1} {:>8.1e}",
            r.plan.class.name(),
            r.plan.count,
            r.expected,
            r.complete,
            r.certified,
            r.proved,
            r.missed_roots,
            r.spurious_roots,
            r.false_certificates,
            r.median_us,
            r.p99_us,
            r.worst_residual
        );
    }
    let _ = writeln!(
        out,
        "references: QZ of a random 69 x 69 pair {:.0} us, eigenvalues of a random 40 x 40 matrix {:.0} us",
        references.qz69, references.eig40
    );
    for r in reports {
        let e = r.epsilon;
        let _ = writeln!(
            out,
            "{}: error metric median {:.2} mean {:.2} max {:.2}, above -5 {:.2} %, above -6 {:.2} %; \
             solve {:.0} us, certify {:.0} us, validate {:.0} us; {:.1} s",
            r.plan.class,
            e.median,
            e.mean,
            e.max,
            100.0 * e.above_minus_5,
            100.0 * e.above_minus_6,
            r.split.solve,
            r.split.certify,
            r.split.validate,
            r.seconds
        );
        let _ = writeln!(out, "  finite: {}  real: {}", line(&r.finite_counts), line(&r.real_counts));
        for f in r.failures.iter().take(LISTED) {
            let _ = writeln!(
                out,
                "  WRONG --class {} --seed {} --first {}: missed {}, spurious {}, false certificates {}, found {} of {}; {}",
                r.plan.class,
                r.plan.seed,
                f.k,
                f.missed,
                f.spurious,
                f.false_certificates,
                f.found,
                r.expected,
                f.solver
            );
        }
        if r.failures.len() > LISTED {
            let _ = writeln!(out, "  and {} more, see --json", r.failures.len() - LISTED);
        }
    }
    out
}

fn line(counts: &BTreeMap<usize, u64>) -> String {
    let parts: Vec<String> = counts.iter().map(|(n, problems)| format!("{n}: {problems}")).collect();
    parts.join(", ")
}
