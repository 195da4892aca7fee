//! Statistics of single outcomes: the row of a table.

use std::collections::BTreeMap;

use super::raw::{Elimination, RawReport};
use super::run::{OpenAnswer, Plan, ProblemOutcome, WrongAnswer};

/// The error measure of Martyushev over the problems.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, schemars::JsonSchema), schemars(rename = "ErrorStatisticsRecord", transform = num::nullable))]
pub struct ErrorStatistics {
    // as in Table 1 of the paper
    /// The median.
    pub median: f64,
    /// The mean.
    pub mean: f64,
    /// The largest.
    pub max: f64,
    /// Share of problems above -5.
    pub above_minus_5: f64,
    /// Share of problems above -6.
    pub above_minus_6: f64,
}

/// Median times of the parts of a solver call and of its validation, microseconds.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, schemars::JsonSchema), schemars(rename = "TimeSplitRecord", transform = num::nullable))]
pub struct TimeSplit {
    /// Call without certification.
    pub solve: f64,
    /// Certification, measured separately.
    pub certify: f64,
    /// Validation; not part of the solver's time.
    pub validate: f64,
}

/// The result of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct BenchReport {
    /// The plan of the run.
    pub plan: Plan,
    /// Computed number of finite poses of a member of the class.
    pub expected: usize,
    /// Number of problems with a correct and complete set of roots.
    pub complete: u64,
    /// Number of problems in which every root has a certificate.
    pub certified: u64,
    /// Number of problems with a proof of completeness.
    pub proved: u64,
    /// Problems with a proof that all real poses are listed.
    pub proved_bounded: u64,
    /// Number of problems for which the solver itself warns that roots may be missing.
    pub doubted: u64,
    /// Number of problems that look complete to the solver but lack roots: the worst kind.
    pub silent_failures: u64,
    /// Number of problems solved again from two other starts.
    pub rechecked: u64,
    /// Number of claimed roots.
    pub roots: u64,
    /// Number of claimed roots with a certificate.
    pub certified_roots: u64,
    /// Number of true roots that the solver missed.
    pub missed_roots: u64,
    /// Number of claimed roots that are wrong or listed twice.
    pub spurious_roots: u64,
    /// Number of wrong certificates, of roots or of completeness.
    pub false_certificates: u64,
    /// Median time of a solver call, microseconds.
    pub median_us: f64,
    /// 99th percentile of the time of a solver call, microseconds.
    pub p99_us: f64,
    /// Mean time of a solver call, microseconds.
    pub mean_us: f64,
    /// Largest residual of a claimed root in double-double, relative to the square of the pose's own numbers.
    pub worst_residual: f64,
    /// Median times of the parts of a solver call.
    pub split: TimeSplit,
    /// Wall-clock seconds of the whole run.
    pub seconds: f64,
    /// Number of problems by their number of correct finite roots.
    pub finite_counts: BTreeMap<usize, u64>,
    /// Number of problems by their number of correct real roots.
    pub real_counts: BTreeMap<usize, u64>,
    /// Accuracy in Martyushev's measure.
    pub epsilon: ErrorStatistics,
    /// The candidates before refinement, for a published elimination.
    pub raw: Option<RawReport>,
    /// Problems with a wrong answer.
    pub failures: Vec<WrongAnswer>,
    /// Problems without a proof.
    pub open: Vec<OpenAnswer>,
}

impl BenchReport {
    /// Whether nothing is missed, nothing spurious, and no certificate false.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.missed_roots == 0 && self.spurious_roots == 0 && self.false_certificates == 0
    }
}

/// The value at the share `q` of the sorted values (nearest rank); 0 for an empty list.
pub(super) fn quantile(values: impl Iterator<Item = f64>, q: f64) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    let n = values.len() as f64;
    // the first value with at least the share q of the values up to and including it
    values.iter().enumerate().find(|(i, _)| (*i + 1) as f64 >= q * n).map_or(0.0, |(_, value)| *value)
}

/// Statistics of the finite errors.
pub(super) fn error_statistics(values: &[f64]) -> ErrorStatistics {
    // without values: not a number
    let n = values.len() as f64;
    let above = |limit: f64| values.iter().filter(|e| **e > limit).count() as f64 / n;
    ErrorStatistics {
        median: if values.is_empty() { f64::NAN } else { quantile(values.iter().copied(), 0.5) },
        mean: values.iter().sum::<f64>() / n,
        max: values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        above_minus_5: above(-5.0),
        above_minus_6: above(-6.0),
    }
}

fn is_wrong(o: &ProblemOutcome) -> bool {
    o.verdict.missed + o.verdict.spurious + o.verdict.false_certificates > 0
}

pub(super) fn summarise(
    plan: &Plan,
    expected: usize,
    seconds: f64,
    elimination: Option<Elimination>,
    outcomes: &[ProblemOutcome],
) -> BenchReport {
    let count = |test: &dyn Fn(&ProblemOutcome) -> bool| outcomes.iter().filter(|o| test(o)).count() as u64;
    let sum = |of: &dyn Fn(&ProblemOutcome) -> usize| outcomes.iter().map(|o| of(o) as u64).sum();
    let median = |of: &dyn Fn(&ProblemOutcome) -> f64| quantile(outcomes.iter().map(of), 0.5);
    let histogram = |of: &dyn Fn(&ProblemOutcome) -> usize| {
        let mut counts = BTreeMap::new();
        for outcome in outcomes {
            *counts.entry(of(outcome)).or_default() += 1;
        }
        counts
    };
    let failures = outcomes.iter().filter(|o| is_wrong(o)).map(|o| WrongAnswer {
        k: o.k,
        missed: o.verdict.missed,
        spurious: o.verdict.spurious,
        false_certificates: o.verdict.false_certificates,
        found: o.verdict.distinct,
        solver: o.solver.clone(),
    });
    let open = outcomes.iter().filter(|o| !o.proved && !o.proved_bounded);
    let open = open.map(|o| OpenAnswer { k: o.k, solver: o.solver.clone() });
    // without roots or with zero residuals there is no logarithm
    let errors: Vec<f64> = outcomes.iter().map(|o| o.metric).filter(|e| e.is_finite()).collect();
    let raw: Vec<_> = outcomes.iter().filter_map(|o| o.raw.clone()).collect();
    BenchReport {
        plan: *plan,
        expected,
        complete: count(&|o| o.verdict.missed + o.verdict.spurious == 0),
        certified: count(&|o| o.claimed > 0 && o.certified_roots == o.claimed),
        proved: count(&|o| o.proved),
        proved_bounded: count(&|o| o.proved_bounded),
        doubted: count(&|o| !o.accounted),
        silent_failures: count(&|o| o.accounted && is_wrong(o)),
        rechecked: count(&|o| o.rechecked),
        roots: sum(&|o| o.claimed),
        certified_roots: sum(&|o| o.certified_roots),
        missed_roots: sum(&|o| o.verdict.missed),
        spurious_roots: sum(&|o| o.verdict.spurious),
        false_certificates: sum(&|o| o.verdict.false_certificates),
        median_us: median(&|o| o.solve_us),
        p99_us: quantile(outcomes.iter().map(|o| o.solve_us), 0.99),
        mean_us: outcomes.iter().map(|o| o.solve_us).sum::<f64>() / (outcomes.len() as f64).max(1.0),
        worst_residual: outcomes.iter().map(|o| o.verdict.worst_residual).fold(0.0, f64::max),
        split: TimeSplit {
            solve: median(&|o| (o.solve_us - o.certify_us).max(0.0)),
            certify: median(&|o| o.certify_us),
            validate: median(&|o| o.validate_us),
        },
        seconds,
        finite_counts: histogram(&|o| o.verdict.distinct),
        real_counts: histogram(&|o| o.verdict.real),
        epsilon: error_statistics(&errors),
        raw: elimination.map(|e| e.report(&raw)),
        failures: failures.collect(),
        open: open.collect(),
    }
}
