//! Runs a plan in several threads: draws problems, solves and validates them, and certifies again to obtain the
//! enclosures.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use thiserror::Error;

use super::Class;
use super::error_metric::error_metric;
use super::expectation::expected_count;
use super::generator::{LengthsFrom, NotDrawn, Problem, problem};
use super::raw::{Elimination, RawOutcome};
use super::statistics::{BenchReport, summarise};
use super::validator::{Claim, Validation, validate};
use fk::solve::certify::Certifier;
use fk::{Completeness, FkOptions, FkRoot, FkSolutions, ForwardKinematics, PoseCounting, Reality};
use platform::geom::ComplexPose;

/// The plan of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plan {
    /// Class of the problems.
    pub class: Class,
    /// The source of the leg lengths.
    pub lengths: LengthsFrom,
    /// Digits behind the point that coordinates of joints are rounded to, as people type them; `None` for those drawn.
    pub decimals: Option<u32>,
    /// Number of problems.
    pub count: u64,
    /// Index of the first problem, to repeat a failed one.
    pub first: u64,
    /// Seed of the problems and of the solver's generic constants.
    pub seed: u64,
    /// Number of threads; each problem is solved on one.
    pub threads: usize,
    /// Whether poses are counted modulo random primes if completeness is not proved.
    pub count_poses: bool,
    /// The reference solver solves every n-th problem again from two other starts; 0: never.
    pub recheck_every: u64,
}

impl Plan {
    /// Problem `k` of the plan.
    ///
    /// # Errors
    /// As [`problem`].
    pub fn problem(&self, k: u64) -> Result<Problem, NotDrawn> {
        let drawn = problem(self.class, self.lengths, self.seed, k)?;
        self.decimals.map_or(Ok(drawn.clone()), |decimals| drawn.rounded(decimals))
    }
}

/// An answer without a proof of completeness.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenAnswer {
    /// Index of the problem: with class and seed it names the problem.
    pub k: u64,
    /// The solver's statement about its own answer.
    pub solver: String,
}

/// The reason why a run failed.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RunError {
    /// A problem could not be drawn.
    #[error("problem {k} could not be drawn: {why}")]
    NotDrawn {
        /// Index of the problem.
        k: u64,
        /// The reason.
        why: NotDrawn,
    },
    /// The reference solver could not solve a single member of the class.
    #[error("the number of poses of the class {0} could not be computed")]
    NoExpectation(Class),
}

/// A problem with a wrong answer.
#[derive(Debug, Clone, PartialEq)]
pub struct WrongAnswer {
    /// Index of the problem; class, seed and index name it.
    pub k: u64,
    /// Number of missing roots.
    pub missed: usize,
    /// Number of claims that are no roots.
    pub spurious: usize,
    /// Number of wrong certificates.
    pub false_certificates: usize,
    /// Number of distinct correct roots.
    pub found: usize,
    /// The solver's own statement about its answer.
    pub solver: String,
}

/// The result of one problem.
#[derive(Debug, Clone)]
#[expect(clippy::struct_excessive_bools, reason = "a row of measured yes or no")]
pub(super) struct ProblemOutcome {
    pub(super) k: u64,
    pub(super) verdict: Validation,
    pub(super) claimed: usize,
    pub(super) certified_roots: usize,
    pub(super) proved: bool,
    pub(super) proved_bounded: bool,
    pub(super) accounted: bool,
    pub(super) rechecked: bool,
    pub(super) metric: f64,
    pub(super) solve_us: f64,
    pub(super) certify_us: f64,
    pub(super) validate_us: f64,
    pub(super) solver: String,
    pub(super) raw: Option<RawOutcome>,
}

/// The claims of a set of solutions, with the enclosures of their certificates, and the time of certifying again.
pub(super) fn claims_of(problem: &Problem, found: &FkSolutions) -> (Vec<Claim>, f64) {
    let start = Instant::now();
    let certifier = Certifier::new(&problem.manipulator, &problem.squares).ok();
    let outcomes: Vec<_> =
        found.roots.iter().map(|root| certifier.as_ref().map(|c| c.certify(&root.pose))).collect();
    let time = start.elapsed().as_secs_f64() * 1e6;
    std::hint::black_box(outcomes);
    let claims = found.roots.iter().map(|root| Claim {
        pose: root.pose,
        dual_quaternion: root.dual_quaternion,
        certified: root.certified(),
        enclosure: root.certificate.map(|c| c.enclosure().discs().copied().collect()),
        reality: root.reality,
        multiplicity: root.multiplicity,
    });
    (claims.collect(), time)
}

fn starts(seed: u64) -> [FkOptions; 2] {
    [1, 2].map(|k: u64| FkOptions::new().seed(seed.wrapping_add(k * 7_919)).pose_count(PoseCounting::Never))
}

fn one(
    plan: &Plan,
    expected: usize,
    k: u64,
    solver: &dyn ForwardKinematics,
    reference: &dyn ForwardKinematics,
) -> Result<ProblemOutcome, NotDrawn> {
    let problem = plan.problem(k)?;
    let counting = if plan.count_poses { PoseCounting::WhenUnproved } else { PoseCounting::Never };
    let options = FkOptions::new().seed(plan.seed).pose_count(counting);
    let elimination = Elimination::of(solver.method());
    let start = Instant::now();
    let solved = solver.solve(&problem.manipulator, &problem.squares, &options);
    let solve_us = start.elapsed().as_secs_f64() * 1e6;
    let (found, solver) = match solved {
        Ok(found) => {
            let said = found.completeness.to_string();
            (Some(found), said)
        }
        Err(error) => (None, error.to_string()),
    };
    let (claims, certify_us) = found.as_ref().map_or((Vec::new(), 0.0), |f| claims_of(&problem, f));
    let mut others: Vec<ComplexPose> = problem.pose.map(ComplexPose::from).into_iter().collect();
    // a proof up to a distance says nothing of poses farther out, or of poses that are not real
    let is_within = |root: &FkRoot| match found.as_ref().map(|f| &f.completeness) {
        Some(Completeness::ProvedBounded { proof }) => proof.rotation.map_or_else(
            || root.reality == Reality::Real,
            |reach| root.pose.rotation.iter().all(|z| z.norm() < reach),
        ),
        _ => true,
    };
    let start = Instant::now();
    let mut verdict = validate(&problem, &claims, &others);
    let validate_us = start.elapsed().as_secs_f64() * 1e6;
    let due = plan.recheck_every > 0 && k.is_multiple_of(plan.recheck_every);
    let rechecked = due || verdict.counted != expected || verdict.missed > 0;
    if rechecked {
        for options in starts(plan.seed) {
            if let Ok(again) = reference.solve(&problem.manipulator, &problem.squares, &options) {
                others.extend(again.roots.iter().filter(|r| is_within(r)).map(|r| r.pose));
            }
        }
        verdict = validate(&problem, &claims, &others);
    }
    let proved = found.as_ref().is_some_and(|f| matches!(f.completeness, Completeness::Proved { .. }));
    let proved_bounded =
        found.as_ref().is_some_and(|f| matches!(f.completeness, Completeness::ProvedBounded { .. }));
    // poses beyond the bound of a proof may be left out
    if !proved_bounded {
        verdict.missed = verdict.missed.max(expected.saturating_sub(verdict.counted));
    }
    // a proof of completeness is a certificate too
    let claimed_complete = found.as_ref().is_some_and(|f| {
        matches!(
            f.completeness,
            Completeness::Proved { .. } | Completeness::ProvedBounded { .. } | Completeness::Modular { .. }
        )
    });
    verdict.false_certificates += usize::from(claimed_complete && verdict.missed > 0);
    let poses: Vec<ComplexPose> = claims.iter().map(|c| c.pose).collect();
    Ok(ProblemOutcome {
        k,
        raw: elimination.map(|e| e.measure(&problem, plan.seed, k)),
        verdict,
        claimed: claims.len(),
        certified_roots: claims.iter().filter(|c| c.certified).count(),
        proved,
        proved_bounded,
        accounted: found.as_ref().is_some_and(FkSolutions::all_accounted),
        rechecked,
        metric: error_metric(&problem.manipulator, &problem.squares, &poses),
        solve_us,
        certify_us,
        validate_us,
        solver,
    })
}

/// Runs `plan` with `solver`; `reference` computes the expected number of poses and searches for missed ones from other
/// starts.
///
/// # Errors
/// [`RunError`]; a problem that the solver fails on is a failure in the report.
pub fn run(
    plan: &Plan,
    solver: &dyn ForwardKinematics,
    reference: &dyn ForwardKinematics,
) -> Result<BenchReport, RunError> {
    let undrawn = |k: u64| move |why: NotDrawn| RunError::NotDrawn { k, why };
    plan.problem(plan.first).map_err(undrawn(plan.first))?;
    let expected = expected_count(plan.class, plan.lengths, plan.seed, reference)
        .ok_or(RunError::NoExpectation(plan.class))?;
    let (next, end) = (AtomicU64::new(plan.first), plan.first.saturating_add(plan.count));
    let work = || {
        let mut out = Vec::new();
        loop {
            let k = next.fetch_add(1, Ordering::Relaxed);
            if k >= end {
                return Ok(out);
            }
            out.push(one(plan, expected, k, solver, reference).map_err(undrawn(k))?);
        }
    };
    let start = Instant::now();
    let parts: Vec<Result<Vec<ProblemOutcome>, RunError>> = std::thread::scope(|scope| {
        let others: Vec<_> = (1..plan.threads.max(1)).map(|_| scope.spawn(work)).collect();
        let mut parts = vec![work()];
        for other in others {
            // a panic in a worker continues in the caller
            parts.push(other.join().unwrap_or_else(|payload| std::panic::resume_unwind(payload)));
        }
        parts
    });
    let seconds = start.elapsed().as_secs_f64();
    let mut outcomes: Vec<ProblemOutcome> =
        parts.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect();
    outcomes.sort_by_key(|o| o.k);
    Ok(summarise(plan, expected, seconds, Elimination::of(solver.method()), &outcomes))
}
