//! Answers of `bench`.

use std::collections::BTreeMap;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Serialize;

use super::Number;
use ask::bench::{
    BenchReport, Class, ErrorStatistics, LengthsFrom, NoiseLevel, OpenAnswer, Plan, RawReport,
    ReferenceTimes, TimeSplit, WrongAnswer,
};

/// The answer of `bench`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum BenchAnswer {
    /// One class.
    One(Box<BenchOneAnswer>),
    /// Several.
    Several(BenchSumsAnswer),
    /// With --noise.
    Noise(NoiseAnswer),
}

/// The run of one class.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct BenchOneAnswer {
    /// The class.
    #[serde(flatten)]
    pub class: BenchClassRecord,
    /// The method asked for.
    #[schemars(extend("enum" = METHODS))]
    pub method: String,
}

/// What `--method` takes.
const METHODS: [&str; 6] = ["auto", "octic", "homotopy", "sylvester", "template", "trilateration"];

/// The runs of several classes.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct BenchSumsAnswer {
    /// Sums; times and residual: the worst.
    #[serde(flatten)]
    pub sums: BenchCountsRecord,
    /// The classes.
    pub rows: Vec<BenchClassRecord>,
    /// The method asked for.
    #[schemars(extend("enum" = METHODS))]
    pub method: String,
}

impl BenchAnswer {
    /// The answer of runs: that of the only one, or sums over several.
    #[must_use]
    pub fn new(asked: &str, method: &str, rows: Vec<BenchClassRecord>, references: &ReferenceTimes) -> Self {
        let method = method.to_owned();
        match <[BenchClassRecord; 1]>::try_from(rows) {
            Ok([class]) => Self::One(Box::new(BenchOneAnswer { class, method })),
            Err(rows) => {
                let sums = BenchCountsRecord::sums(asked, &rows, references);
                Self::Several(BenchSumsAnswer { sums, rows, method })
            }
        }
    }
}

/// Problems counted and timed.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct BenchCountsRecord {
    /// The class, or what was asked for.
    pub class: String,
    /// Problems.
    pub count: u64,
    /// Problems whose set of roots is right and complete.
    pub complete: u64,
    /// Problems in which every root has a certificate.
    pub certified: u64,
    /// True roots not found.
    pub missed_roots: u64,
    /// Claims that are no root, or a second time the same.
    pub spurious_roots: u64,
    /// Certificates, of roots or of completeness, that are wrong.
    pub false_certificates: u64,
    /// Median time of a solver call.
    pub median_us: Number,
    /// 99th percentile of the same.
    pub p99_us: Number,
    /// Largest residual of a claim, in twice the precision.
    pub worst_residual: Number,
    /// Times of known computations on this machine.
    pub reference_us: ReferenceTimes,
}

impl BenchCountsRecord {
    fn new(r: &BenchReport, references: &ReferenceTimes) -> Self {
        Self {
            class: r.plan.class.name().into_owned(),
            count: r.plan.count,
            complete: r.complete,
            certified: r.certified,
            missed_roots: r.missed_roots,
            spurious_roots: r.spurious_roots,
            false_certificates: r.false_certificates,
            median_us: Number(r.median_us),
            p99_us: Number(r.p99_us),
            worst_residual: Number(r.worst_residual),
            reference_us: *references,
        }
    }

    fn sums(asked: &str, rows: &[BenchClassRecord], references: &ReferenceTimes) -> Self {
        let sum = |of: fn(&Self) -> u64| rows.iter().map(|r| of(&r.counts)).sum();
        let worst =
            |of: fn(&Self) -> Number| Number(rows.iter().map(|r| of(&r.counts).0).fold(0.0, f64::max));
        Self {
            class: asked.into(),
            count: sum(|c| c.count),
            complete: sum(|c| c.complete),
            certified: sum(|c| c.certified),
            missed_roots: sum(|c| c.missed_roots),
            spurious_roots: sum(|c| c.spurious_roots),
            false_certificates: sum(|c| c.false_certificates),
            median_us: worst(|c| c.median_us),
            p99_us: worst(|c| c.p99_us),
            worst_residual: worst(|c| c.worst_residual),
            reference_us: *references,
        }
    }
}

/// Random problems of a class, solved and validated.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct BenchClassRecord {
    /// Counts and times.
    #[serde(flatten)]
    pub counts: BenchCountsRecord,
    /// The median over the references.
    pub ratio_to_reference: ReferenceTimes,
    /// Index of the first problem.
    pub first: u64,
    /// Threads; each problem was solved on one.
    pub threads: usize,
    /// Where lengths come from.
    pub lengths_from: LengthsFrom,
    /// Digits behind the point that joints are rounded to, with `--digits`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub digits: Option<u32>,
    /// Poses of the class, without rounding.
    pub expected_count: usize,
    /// Right finite roots.
    pub finite_counts: Histogram,
    /// Real ones among them.
    pub real_counts: Histogram,
    /// Claimed roots.
    pub roots: u64,
    /// Claimed roots with a certificate.
    pub certified_roots: u64,
    /// Problems with a proof of completeness.
    pub proved: u64,
    /// Problems with a proof for all poses up to a distance, so for all real ones.
    pub proved_bounded: u64,
    /// Problems for which the solver itself says that roots may be missing.
    pub doubted: u64,
    /// Problems that look complete to the solver but are not.
    pub silent_failures: u64,
    /// Problems solved again from two other starts.
    pub rechecked: u64,
    /// Mean time of a solver call.
    pub mean_us: Number,
    /// Medians of its parts.
    pub split_us: TimeSplit,
    /// Of the whole run.
    pub total_s: Number,
    /// Error measure of the roots as listed (Martyushev, eq. 19), decimal logarithm.
    pub epsilon: ErrorStatistics,
    /// Candidates before refinement, with the methods `sylvester` and `template`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub raw: Option<RawReport>,
    /// Problems whose answer is not right.
    pub failures: Vec<BenchFailureRecord>,
    /// Problems without a proof of completeness.
    pub open: Vec<BenchOpenRecord>,
}

impl BenchClassRecord {
    /// The record of a run, with the times of the references on the same machine.
    #[must_use]
    pub fn new(r: &BenchReport, references: &ReferenceTimes) -> Self {
        Self {
            counts: BenchCountsRecord::new(r, references),
            ratio_to_reference: ReferenceTimes {
                qz69: r.median_us / references.qz69,
                eig40: r.median_us / references.eig40,
            },
            first: r.plan.first,
            threads: r.plan.threads,
            lengths_from: r.plan.lengths,
            digits: r.plan.digits,
            expected_count: r.expected,
            finite_counts: Histogram(r.finite_counts.clone()),
            real_counts: Histogram(r.real_counts.clone()),
            roots: r.roots,
            certified_roots: r.certified_roots,
            proved: r.proved,
            proved_bounded: r.proved_bounded,
            doubted: r.doubted,
            silent_failures: r.silent_failures,
            rechecked: r.rechecked,
            mean_us: Number(r.mean_us),
            split_us: r.split,
            total_s: Number(r.seconds),
            epsilon: r.epsilon,
            raw: r.raw.clone(),
            failures: r.failures.iter().map(|f| BenchFailureRecord::new(&r.plan, f)).collect(),
            open: r.open.iter().map(BenchOpenRecord::new).collect(),
        }
    }
}

/// Number of poses = how many problems.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
#[serde(transparent)]
pub struct Histogram(pub BTreeMap<usize, u64>);

impl JsonSchema for Histogram {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Histogram".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let count = generator.subschema_for::<u64>();
        json_schema!({
            "type": "object",
            "description": "Number of poses = how many problems.",
            "propertyNames": {"pattern": "^[0-9]+$"},
            "additionalProperties": count,
        })
    }
}

/// A problem whose answer is not right, written out so that it can be solved elsewhere.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct BenchFailureRecord {
    /// Index of the problem.
    pub problem: u64,
    /// Roots that are missing.
    pub missed: usize,
    /// Claims that are no roots.
    pub spurious: usize,
    /// Certificates that are wrong.
    pub false_certificates: usize,
    /// Distinct right roots.
    pub found: usize,
    /// What the solver said of its own answer.
    pub solver: String,
    /// Base ends of the legs, in their order.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub base: Option<[[Number; 3]; 6]>,
    /// Platform ends of the legs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub platform: Option<[[Number; 3]; 6]>,
    /// Their squared lengths.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub squared_lengths: Option<[Number; 6]>,
}

impl BenchFailureRecord {
    fn new(plan: &Plan, f: &WrongAnswer) -> Self {
        let drawn = plan.problem(f.k).ok();
        let point = |p: nalgebra::Point3<f64>| [p.x, p.y, p.z].map(Number);
        Self {
            problem: f.k,
            missed: f.missed,
            spurious: f.spurious,
            false_certificates: f.false_certificates,
            found: f.found,
            solver: f.solver.clone(),
            base: drawn.as_ref().map(|d| d.manipulator.legs().map(|l| point(l.base))),
            platform: drawn.as_ref().map(|d| d.manipulator.legs().map(|l| point(l.platform))),
            squared_lengths: drawn.map(|d| d.squares.get().map(Number)),
        }
    }
}

/// A problem without a proof that its poses are all.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct BenchOpenRecord {
    /// Index of the problem.
    pub problem: u64,
    /// Statement of the solver about its own answer.
    pub solver: String,
}

impl BenchOpenRecord {
    fn new(open: &OpenAnswer) -> Self {
        Self { problem: open.k, solver: open.solver.clone() }
    }
}

/// How far poses move when leg lengths are disturbed.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct NoiseAnswer {
    /// What was asked for.
    pub class: String,
    /// Problems of each class.
    pub count: u64,
    /// Threads.
    pub threads: u64,
    /// The classes.
    pub rows: Vec<NoiseRowRecord>,
}

/// What noise does to a class.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct NoiseRowRecord {
    /// The class.
    pub class: String,
    /// From little noise to much.
    pub levels: Vec<NoiseLevel>,
}

impl NoiseRowRecord {
    /// The record of a class.
    #[must_use]
    pub fn new(class: Class, levels: &[NoiseLevel]) -> Self {
        Self { class: class.name().into_owned(), levels: levels.to_vec() }
    }
}
