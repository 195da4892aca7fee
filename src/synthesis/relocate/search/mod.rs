//! Equivalent platforms that meet requirements.
//!
//! A platform equivalent to `m` is six independent replaceable legs. Each is a kept leg of `m`, a leg of a family, or a
//! leg through a hole. A *pattern* states the number of legs from each origin. Generic parameters decide once which
//! patterns are independent. In these the parameters maximise the worst margin of all requirements, from several
//! starts.
//!
//! Proofs use ranks of rational numbers and counts of legs whose vectors span a family. They show that no replaceable
//! leg ends at a hole, all its partners are at infinity, or legs there replace none of the named ones. If every
//! replaceable leg and every pattern is known exactly, they also show the least number of shared joints. Floating point
//! chooses the search; if it alone excludes something, the verdict is `Undecided`. A search without a result for a
//! spacing or clearance proves nothing.

mod candidate;
mod pool;
mod targets;
#[cfg(test)]
mod tests;

use thiserror::Error;

pub use self::targets::{CheckedHole, HoleAnswer, HoleWord};
pub use candidate::{Candidate, LegSource, Placement};
pub use targets::{Hole, Target, TargetMargin, Targets};

use self::candidate::Scorer;
use self::pool::{JointPattern, patterns};
use super::super::components::{Components, PartKind, Reading, SingularKind};
use num::Rng;
use num::linalg::LinalgError;
use platform::manipulator::Manipulator;
use pool::LegPool;

/// Effort of the search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MoveSearchOptions {
    /// Seed of all random numbers.
    pub seed: u64,
    /// Random parameters tried in every pattern.
    pub samples: usize,
    /// Starts of ascents of the worst margin.
    pub starts: usize,
    /// Evaluations of the margins in every ascent.
    pub evaluations: usize,
    /// Number of listed platforms.
    pub count: usize,
}

impl Default for MoveSearchOptions {
    /// Seed 1, 40 samples, 40 starts of 1500 evaluations, 5 platforms.
    fn default() -> Self {
        Self { seed: 1, samples: 40, starts: 40, evaluations: 1500, count: 5 }
    }
}

/// Reasons why there is nothing to search.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SearchError {
    /// The leg vectors are dependent.
    #[error(
        "the leg vectors have rank {0}: the platform is architecturally singular, and so is every one made of its legs"
    )]
    Dependent(usize),
    /// The exact leg vectors are independent, but dependent within the tolerance of the search.
    #[error(
        "the platform is regular, but its leg vectors have rank {0} within the tolerance: the search does not tell it from a singular one"
    )]
    NearlyDependent(usize),
    /// There is no pose.
    #[error("no pose is given at which the legs are checked")]
    NoPoses,
    /// A limit is negative or not finite.
    #[error("{what} is {value}, not a number of 0 or more")]
    Limit {
        /// The name, for instance `"spacing"`.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A decomposition failed.
    #[error(transparent)]
    Linalg(#[from] LinalgError),
}

/// The reason why no equivalent platform meets the requirements.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Impossibility {
    /// No replaceable leg ends at the hole (index): exactly, and not within the tolerance either.
    NoLegAtHole(usize),
    /// The partners of the hole are all at infinity.
    PartnersAtInfinity(usize),
    /// The squared length of a leg at the hole (index) does not depend on any of the legs named for it.
    NotByThoseLegs(usize),
    /// Six independent replaceable legs have at least this many shared joints.
    SharedJoints(usize),
    /// No six independent replaceable legs have ends at all the holes.
    HolesTogether,
}

impl Impossibility {
    /// The name in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::NoLegAtHole(_) => "no_leg_at_hole",
            Self::PartnersAtInfinity(_) => "partners_at_infinity",
            Self::NotByThoseLegs(_) => "not_by_those_legs",
            Self::SharedJoints(_) => "shared_joints",
            Self::HolesTogether => "holes_together",
        }
    }
}

/// The verdict of the search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SearchVerdict {
    /// At least one platform meets every requirement.
    Found,
    /// Proved: no platform does.
    Impossible(Impossibility),
    /// None was found.
    Undecided,
}

/// The answer of [`search`].
#[derive(Debug, Clone)]
pub struct SearchOutcome {
    /// The verdict.
    pub verdict: SearchVerdict,
    /// The best platforms, best first; without the verdict `Found` they miss a requirement.
    pub candidates: Vec<Candidate>,
    /// The possible legs at each hole.
    pub holes: Vec<CheckedHole>,
    /// Patterns that are independent at generic parameters and reach all holes.
    pub patterns: usize,
    /// The searched patterns among them.
    pub searched: usize,
    /// The fewest shared joints of a pattern; `None` without a pattern.
    pub least_shared: Option<usize>,
    /// Whether every replaceable leg is known, so that counts over the patterns are proofs.
    pub complete: bool,
    /// The requirements with the limits used.
    pub targets: Targets,
}

/// Searches for platforms equivalent to `m` that meet the requirements; `found` are its families.
///
/// # Errors
/// [`SearchError`].
pub fn search(
    m: &Manipulator,
    found: &Components,
    targets: &Targets,
    options: &MoveSearchOptions,
) -> Result<SearchOutcome, SearchError> {
    if found.leg_rank.value < 6 {
        return Err(SearchError::Dependent(found.leg_rank.value));
    }
    if found.span.rank() < 6 {
        return Err(SearchError::NearlyDependent(found.span.rank()));
    }
    targets.validate()?;
    let mut outcome = SearchOutcome {
        verdict: SearchVerdict::Undecided,
        candidates: Vec::new(),
        holes: targets::records(m, found, &targets.holes)?,
        patterns: 0,
        searched: 0,
        least_shared: None,
        complete: all_legs_known(found),
        targets: targets.clone(),
    };
    if let Some(reason) = outcome.holes.iter().enumerate().find_map(|(k, h)| h.impossible(k)) {
        outcome.verdict = SearchVerdict::Impossible(reason);
        return Ok(outcome);
    }
    let mut rng = Rng::stream(options.seed, 0x5ea);
    let pool = LegPool::new(m, found, targets, &outcome.holes, &mut rng)?;
    if let Some(k) = pool.not_by_those_legs(&targets.holes) {
        if outcome.holes[k].exactly_by_others {
            outcome.verdict = SearchVerdict::Impossible(Impossibility::NotByThoseLegs(k));
        }
        return Ok(outcome);
    }
    // if no leg of a family could be drawn, for instance of a distant one, the patterns lack it
    outcome.complete &= pool.drawn;
    let pool::Patterns { mut list, exhaustive } = patterns(&pool, targets, m.size());
    outcome.complete &= exhaustive;
    outcome.patterns = list.len();
    outcome.least_shared = list.iter().map(|p| p.shared).min();
    let Some(least) = outcome.least_shared else {
        if outcome.complete && !targets.holes.is_empty() {
            outcome.verdict = SearchVerdict::Impossible(Impossibility::HolesTogether);
        }
        return Ok(outcome);
    };
    if targets.no_shared_joints {
        list.retain(|p| p.shared == least);
    }
    outcome.searched = list.len();
    outcome.candidates = climb_all(&pool, found, m, targets, options, &list, &mut rng)?;
    if targets.no_shared_joints && least > 0 {
        if outcome.complete {
            outcome.verdict = SearchVerdict::Impossible(Impossibility::SharedJoints(least));
        }
    } else if outcome.candidates.iter().any(|c| c.fulfilled) {
        outcome.verdict = SearchVerdict::Found;
    }
    Ok(outcome)
}

/// Samples every pattern, starts ascents from the best samples, and ranks the results.
fn climb_all(
    pool: &LegPool,
    found: &Components,
    m: &Manipulator,
    targets: &Targets,
    options: &MoveSearchOptions,
    list: &[JointPattern],
    rng: &mut Rng,
) -> Result<Vec<Candidate>, SearchError> {
    let mut starts: Vec<(f64, usize, Vec<f64>)> = Vec::new();
    for (k, pattern) in list.iter().enumerate() {
        let scorer = Scorer { pool, found, m, targets, pattern };
        let mut best: Vec<(f64, usize, Vec<f64>)> = Vec::new();
        for _ in 0..options.samples.max(1) {
            let x = pool.draw(pattern, rng)?;
            let score = scorer.worst(&x)?;
            best.push((score, k, x));
            if pool.parameters(pattern) == 0 {
                break;
            }
        }
        best.sort_by(|a, b| b.0.total_cmp(&a.0));
        // two starts per pattern, since one of them may be poor
        starts.extend(best.into_iter().take(2));
    }
    starts.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    starts.truncate(options.starts.max(1));
    let mut out: Vec<Candidate> = Vec::new();
    for (_, k, x) in starts {
        let scorer = Scorer { pool, found, m, targets, pattern: &list[k] };
        let (_, x) = candidate::climb(&scorer, x, options.evaluations, rng)?;
        if let Some(candidate) = candidate::candidate(&scorer, &x)? {
            out.push(candidate);
        }
    }
    out.sort_by(|a, b| {
        let key = |c: &Candidate| (!c.fulfilled, c.shared_joints * usize::from(targets.no_shared_joints));
        key(a)
            .cmp(&key(b))
            .then(b.worst.total_cmp(&a.worst))
            .then(a.placements.len().cmp(&b.placements.len()))
    });
    let size = m.size();
    let mut kept: Vec<Candidate> = Vec::new();
    for c in out {
        if kept.len() < options.count && !kept.iter().any(|k| k.repeats(&c, targets, size)) {
            kept.push(c);
        }
    }
    Ok(kept)
}

/// Whether the families and the six legs include every replaceable leg.
///
/// Between a point or a line and any flat, every partner is a leg of `m` or in a listed family. The same holds for two
/// planes with six legs, unless the curve has an isolated real point. Five legs between planes and six between a plane
/// and space can have further single ones.
fn all_legs_known(found: &Components) -> bool {
    let pairs = found.pairs.iter().enumerate().all(|(k, p)| {
        let low = p.base.min(p.platform);
        let planes = || {
            found.planes.iter().find(|x| x.pair == k).is_some_and(|x| {
                p.rank == 6
                    && p.base == 2
                    && p.platform == 2
                    && [&x.base, &x.platform].iter().all(|c| {
                        c.parts.iter().all(|part| part.kind != PartKind::ComplexLines)
                            && c.singular_points.iter().all(|s| s.kind != SingularKind::Isolated)
                    })
            })
        };
        p.reading == Reading::Both && (low <= 1 || planes())
    });
    let exact = found.leg_rank.exact == Some(6) && found.components.iter().all(|c| c.exact == Some(true));
    found.doubts.is_empty() && exact && pairs
}
