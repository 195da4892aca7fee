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
    /// Several classes.
    Several(BenchSumsAnswer),
    /// The answer with `--noise`.
    Noise(NoiseAnswer),
}

/// The run of one class.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct BenchOneAnswer {
    /// The class.
    #[serde(flatten)]
    pub class: BenchClassRecord,
    /// Requested method.
    #[schemars(extend("enum" = METHODS))]
    pub method: String,
}

/// The words of `--method`. `auto` names no method, so that the library chooses one.
pub const METHODS: [&str; 6] = ["auto", "octic", "homotopy", "sylvester", "template", "trilateration"];

/// The runs of several classes.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct BenchSumsAnswer {
    /// Sums over the classes; of times and residual the greatest value.
    #[serde(flatten)]
    pub sums: BenchCountsRecord,
    /// The classes.
    pub rows: Vec<BenchClassRecord>,
    /// Requested method.
    #[schemars(extend("enum" = METHODS))]
    pub method: String,
}

impl BenchAnswer {
    /// The answer of runs: the record of the only run, or the sums over several.
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

view! {
    /// Problems counted and timed.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct BenchCountsRecord {
        /// Class, or argument for several.
        pub class: String = r.plan.class.name().into_owned(),
        /// Number of problems.
        pub count: u64 = r.plan.count,
        /// Number of problems with all roots correct.
        pub complete: u64 = r.complete,
        /// Number of problems with every root certified.
        pub certified: u64 = r.certified,
        /// Number of true roots not found.
        pub missed_roots: u64 = r.missed_roots,
        /// Number of claimed roots that are wrong or repeated.
        pub spurious_roots: u64 = r.spurious_roots,
        /// Number of wrong certificates, of roots or of completeness.
        pub false_certificates: u64 = r.false_certificates,
        /// Median time of a solver call, microseconds.
        pub median_us: Number = Number(r.median_us),
        /// 99th percentile of the time of a solver call, microseconds.
        pub p99_us: Number = Number(r.p99_us),
        /// Largest residual of a claimed root, evaluated in twice the precision.
        pub worst_residual: Number = Number(r.worst_residual),
        /// Two reference timings on this machine, microseconds.
        pub reference_us: ReferenceTimes = *references,
    }
    fn new(r: &BenchReport, references: &ReferenceTimes) {}
}

impl BenchCountsRecord {
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

view! {
    /// Random problems of a class, solved and validated.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct BenchClassRecord {
        /// Counts and times.
        #[serde(flatten)]
        pub counts: BenchCountsRecord = BenchCountsRecord::new(r, references),
        /// Median time over each reference time.
        pub ratio_to_reference: ReferenceTimes = ReferenceTimes {
            qz69: r.median_us / references.qz69,
            eig40: r.median_us / references.eig40,
        },
        /// Index of the first problem, from 0.
        pub first: u64 = r.plan.first,
        /// Number of threads; each problem is solved on one thread.
        pub threads: usize = r.plan.threads,
        /// The source of the leg lengths: a random pose or random numbers.
        pub lengths_from: LengthsFrom = r.plan.lengths,
        /// The decimals of the rounded joints, with `--decimals`.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub decimals: Option<u32> = r.plan.decimals,
        /// Poses of the class, without rounding.
        pub expected_count: usize = r.expected,
        /// Problems by number of correct finite roots.
        pub finite_counts: Histogram = Histogram(r.finite_counts.clone()),
        /// Problems by number of correct real roots.
        pub real_counts: Histogram = Histogram(r.real_counts.clone()),
        /// Number of claimed roots.
        pub roots: u64 = r.roots,
        /// Number of certified roots.
        pub certified_roots: u64 = r.certified_roots,
        /// Number of problems with proved completeness.
        pub proved: u64 = r.proved,
        /// Problems with all real poses proved to be listed.
        pub proved_bounded: u64 = r.proved_bounded,
        /// Number of problems with a warning of the solver about missing roots.
        pub doubted: u64 = r.doubted,
        /// Number of problems with missing roots and no warning.
        pub silent_failures: u64 = r.silent_failures,
        /// Number of problems solved again from two other starts.
        pub rechecked: u64 = r.rechecked,
        /// Mean time of a solver call, microseconds.
        pub mean_us: Number = Number(r.mean_us),
        /// Median times of parts of a call, microseconds.
        pub split_us: TimeSplit = r.split,
        /// Time of the whole run, seconds.
        pub total_s: Number = Number(r.seconds),
        /// Error of the listed roots, decimal logarithm (Martyushev, eq. 19).
        pub epsilon: ErrorStatistics = r.epsilon,
        /// Candidates before refinement, with the methods `sylvester` and `template`.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub raw: Option<RawReport> = r.raw.clone(),
        /// Wrong answers.
        pub failures: Vec<BenchFailureRecord> =
            r.failures.iter().map(|f| BenchFailureRecord::new(&r.plan, f)).collect(),
        /// Problems without proved completeness.
        pub open: Vec<BenchOpenRecord> = r.open.iter().map(BenchOpenRecord::new).collect(),
    }
    /// The record of a run, with the times of the references on the same machine.
    pub fn new(r: &BenchReport, references: &ReferenceTimes) {}
}

/// Number of problems for each number of poses.
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

view! {
    /// A problem with a wrong answer, written out so that another program can solve it.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct BenchFailureRecord {
        /// Problem index.
        pub problem: u64 = f.k,
        /// Number of missing roots.
        pub missed: usize = f.missed,
        /// Number of claims without root.
        pub spurious: usize = f.spurious,
        /// Number of wrong certificates.
        pub false_certificates: usize = f.false_certificates,
        /// Number of distinct correct roots.
        pub found: usize = f.found,
        /// Statement of the solver.
        pub solver: String = f.solver.clone(),
        /// Base ends in leg order, base frame.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub base: Option<[[Number; 3]; 6]> =
            drawn.as_ref().map(|d| d.manipulator.legs().map(|l| point(l.base))),
        /// Platform ends in leg order, platform frame.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub platform: Option<[[Number; 3]; 6]> =
            drawn.as_ref().map(|d| d.manipulator.legs().map(|l| point(l.platform))),
        /// Squared leg lengths.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub squared_lengths: Option<[Number; 6]> = drawn.map(|d| d.squares.get().map(Number)),
    }
    fn new(plan: &Plan, f: &WrongAnswer) {
        let drawn = plan.problem(f.k).ok();
        let point = |p: nalgebra::Point3<f64>| [p.x, p.y, p.z].map(Number);
    }
}

/// A problem without a proof that its poses are all.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct BenchOpenRecord {
    /// Problem index.
    pub problem: u64,
    /// Statement of the solver.
    pub solver: String,
}

impl BenchOpenRecord {
    fn new(open: &OpenAnswer) -> Self {
        Self { problem: open.k, solver: open.solver.clone() }
    }
}

/// Displacements of poses caused by noise in the leg lengths.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct NoiseAnswer {
    /// Class, or argument for several.
    pub class: String,
    /// Number of problems of each class.
    pub count: u64,
    /// Number of threads.
    pub threads: u64,
    /// The classes.
    pub rows: Vec<NoiseRowRecord>,
}

view! {
    /// The effect of noise on one class.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct NoiseRowRecord {
        /// The class.
        pub class: String = class.name().into_owned(),
        /// The levels of noise, the smallest first.
        pub levels: Vec<NoiseLevel> = levels.to_vec(),
    }
    /// The record of a class.
    pub fn new(class: Class, levels: &[NoiseLevel]) {}
}
