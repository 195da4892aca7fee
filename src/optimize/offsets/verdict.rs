//! Converts the results of the cells to the verdicts on the branches and the answer. If no offsets are feasible, it
//! gives the reason in values and in words.

use super::bound::GlobalBound;
use super::branch::{BranchCell, Division, Zone};
use super::climb::LocalResult;
use super::limits::OffsetLimits;
use super::outcome::{
    BranchReport, BranchVerdict, LocalEvidence, OffsetOutcome, OffsetReport, OffsetSolution,
};
use super::problem::{OffsetModel, OffsetProblem};
use super::search::{CellResult, OffsetSearchOptions, better, pattern_search};
use num::Purpose;
use num::shown::rounded;
use synthesis::joint_free;

/// Relative gain of a pattern search above which the solution counts as not converged.
const PATTERN_LIMIT: f64 = 1e-6;

pub(crate) fn vertices_too_close(limits: &OffsetLimits) -> Option<Conflict> {
    limits.vertices_too_close().map(|(side, distance)| Conflict::VerticesTooClose { distance, side })
}

pub(crate) fn nothing_fits(
    divisions: Vec<Division>,
    conflict: &Conflict,
    o: &OffsetSearchOptions,
) -> OffsetReport {
    let report = |d: Division| BranchReport {
        branch: d.branch,
        cells: 0,
        conflicts: std::iter::once(conflict.clone()).chain(d.conflicts).collect(),
        verdict: BranchVerdict::Infeasible,
    };
    let branches = divisions.into_iter().map(report).collect();
    OffsetReport {
        outcome: OffsetOutcome::Infeasible,
        branches,
        runners_up: Vec::new(),
        bound: None,
        tolerance: o.gap,
        interrupted: false,
        seed: o.seed,
        conic_programs: 0,
    }
}

/// The verdict on one branch from the results of its cells.
fn judge(d: &Division, results: Vec<(CellResult, Option<&LocalResult>)>, bounded: bool) -> BranchReport {
    let mut report = BranchReport {
        branch: d.branch,
        cells: results.len(),
        conflicts: d.conflicts.clone(),
        verdict: BranchVerdict::Infeasible,
    };
    let mut best: Option<LocalResult> = None;
    let (mut unknown, mut failure, mut passed) = (false, None, false);
    for (result, polished) in results {
        let mut consider = |r: &LocalResult| {
            if best.as_ref().is_none_or(|b| better(r, b)) {
                best = Some(r.clone());
            }
        };
        match result {
            CellResult::Feasible(r) => {
                consider(&r);
                polished.into_iter().for_each(consider);
            }
            CellResult::Passed => passed = true,
            CellResult::Empty(conflict) => report.conflicts.push(conflict),
            CellResult::Unknown(why) => {
                unknown = true;
                failure = failure.or(why);
            }
        }
    }
    report.verdict = match (best, unknown, failure) {
        (Some(r), ..) => BranchVerdict::Dominated { value: r.value, offsets: r.t, settled: r.converged },
        // the bound covers all offsets of branches that are not proved empty
        (None, unknown, None) if bounded && (unknown || passed) => BranchVerdict::Bounded,
        (None, true, Some(why)) => BranchVerdict::SolverFailure(why),
        (None, true, None) => BranchVerdict::Unproved,
        (None, false, _) if passed => BranchVerdict::Unproved,
        (None, false, _) => BranchVerdict::Infeasible,
    };
    report
}

/// The results of the search.
pub(crate) struct SearchedOffsets {
    /// One result for each cell.
    pub ranked: Vec<CellResult>,
    /// The best runs with their cells, best first.
    pub polished: Vec<(usize, LocalResult)>,
    pub bound: Option<GlobalBound>,
    pub interrupted: bool,
}

pub(super) fn assemble(
    problem: &OffsetProblem,
    m: &OffsetModel,
    divisions: &[Division],
    cells: &[&BranchCell],
    searched: SearchedOffsets,
    o: &OffsetSearchOptions,
) -> OffsetReport {
    let SearchedOffsets { ranked, polished, bound, interrupted } = searched;
    let mut results = ranked.into_iter().enumerate();
    let mut branches = Vec::with_capacity(divisions.len());
    for d in divisions {
        let own = results.by_ref().take(d.cells.len());
        let with_polish = own.map(|(k, r)| (r, polished.iter().find(|p| p.0 == k).map(|p| &p.1))).collect();
        branches.push(judge(d, with_polish, bound.is_some()));
    }
    let value = |b: &BranchReport| match b.verdict {
        BranchVerdict::Dominated { value, .. } => Some(value),
        _ => None,
    };
    let mut order: Vec<(f64, usize)> =
        branches.iter().enumerate().filter_map(|(k, b)| Some((value(b)?, k))).collect();
    order.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let solution = polished
        .into_iter()
        .filter(|p| p.1.is_feasible())
        .find_map(|(k, run)| solution(problem, m, cells[k], divisions, run, o).map(|s| (cells[k].branch, s)));
    let bound = bound.map(|b| b.above(solution.as_ref().map(|s| s.1.0.recheck.objective)));
    let unproved = branches.iter().filter(|b| !matches!(b.verdict, BranchVerdict::Infeasible)).count();
    let outcome = match solution {
        None if unproved == 0 => OffsetOutcome::Infeasible,
        None => OffsetOutcome::Undecided { unproved },
        Some((branch, (solution, sound))) => {
            branches[branch].verdict = BranchVerdict::Best;
            order.retain(|x| x.1 != branch);
            let boxed = Box::new(solution);
            // a feasible point within the proved gap is optimal, regardless of the climb
            match bound {
                Some(b) if b.gap <= o.gap => OffsetOutcome::Optimal(boxed),
                _ if sound => OffsetOutcome::LocalOptimum(boxed),
                _ => OffsetOutcome::NotConverged(boxed),
            }
        }
    };
    OffsetReport {
        outcome,
        branches,
        runners_up: order.into_iter().map(|x| x.1).collect(),
        bound,
        tolerance: o.gap,
        interrupted,
        seed: o.seed,
        conic_programs: m.conic.count(),
    }
}

/// Pattern search, then the re-check on the original problem; after a violation, the point before the pattern search.
/// `None` if both violate a limit.
fn solution(
    problem: &OffsetProblem,
    m: &OffsetModel,
    cell: &BranchCell,
    divisions: &[Division],
    run: LocalResult,
    o: &OffsetSearchOptions,
) -> Option<(OffsetSolution, bool)> {
    let mut rng = Purpose::LAST_DIRECTIONS.rng(o.seed);
    let mut found = pattern_search(m, cell, run.t, run.value, &mut rng);
    let checked = |t: &[f64; 6]| problem.recheck(t).filter(|r| r.margins.all_met());
    let recheck = checked(&found.t).or_else(|| {
        (found.t, found.value) = (run.t, run.value);
        checked(&run.t)
    })?;
    let pattern_gain = if run.value > 0.0 { found.value / run.value - 1.0 } else { 0.0 };
    let evidence = LocalEvidence {
        converged: run.converged,
        stationarity: run.stationarity,
        pattern_gain,
        pattern_trials: found.trials,
    };
    let edges = problem.edge_lengths();
    let (manipulator, map) = joint_free(&problem.octahedral, found.t).ok()?;
    let solution = OffsetSolution {
        offsets: found.t,
        shifts: std::array::from_fn(|i| found.t[i] * edges[i]),
        branch: divisions[cell.branch].branch,
        recheck,
        evidence,
        history: run.history,
        manipulator,
        map,
    };
    Some((solution, run.converged && pattern_gain <= PATTERN_LIMIT))
}

/// Two requirements that conflict; each conflict is a proof that no offset of its set is feasible.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Conflict {
    /// Two vertices of a body are closer than the spacing, for all offsets.
    VerticesTooClose {
        /// Upper bound of the length of the edge, design units.
        distance: f64,
        /// Side of the hexagon that slides on the edge.
        side: usize,
    },
    /// No part of the zone is within the bounds.
    OutsideBounds {
        /// Side of the hexagon.
        side: usize,
        /// The zone.
        zone: Zone,
    },
    /// No part of the zone within the bounds has the spacing from the three vertices.
    NoSpace {
        /// Side of the hexagon.
        side: usize,
        /// The zone.
        zone: Zone,
        /// Length of the zone within the bounds, design units.
        available: f64,
    },
    /// Two edge joints of a body stay closer than the spacing.
    PairTooClose {
        /// The two sides.
        sides: (usize, usize),
        /// Upper bound of their distance, design units.
        greatest: f64,
    },
    /// `|det A|` stays too small: `sign det A` reaches this value at most.
    DetTooSmall {
        /// Sign of `det A`.
        sign: i8,
        /// Upper bound of `sign det A` over the box (the greatest value is at a vertex: it is affine in every offset).
        greatest: f64,
    },
    /// The linear relaxation of all spacings together is infeasible, by a Farkas certificate judged in intervals.
    Combination {
        /// Distance of the combination of the rows below 0 (`|y|_1 = 1`, the largest row about 1), dimensionless.
        strength: f64,
    },
}

impl Conflict {
    /// All codes.
    pub const CODES: [&'static str; 6] = [
        "vertices_too_close",
        "outside_bounds",
        "no_space",
        "pair_too_close",
        "det_too_small",
        "combination",
    ];

    /// A short stable code, one of [`CODES`](Self::CODES).
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::VerticesTooClose { .. } => Self::CODES[0],
            Self::OutsideBounds { .. } => Self::CODES[1],
            Self::NoSpace { .. } => Self::CODES[2],
            Self::PairTooClose { .. } => Self::CODES[3],
            Self::DetTooSmall { .. } => Self::CODES[4],
            Self::Combination { .. } => Self::CODES[5],
        }
    }
}

impl std::fmt::Display for Conflict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::VerticesTooClose { distance, side } => {
                write!(
                    f,
                    "the vertices of the edge of offset {} are only {} apart",
                    side + 1,
                    rounded(*distance, 3)
                )
            }
            Self::OutsideBounds { side, zone } => {
                write!(f, "the bounds of offset {} leave nothing {}", side + 1, zone.words())
            }
            Self::NoSpace { side, zone, available } => write!(
                f,
                "offset {}: {} {} is too short for the joint distance",
                side + 1,
                rounded(*available, 3),
                zone.words()
            ),
            Self::PairTooClose { sides: (i, j), greatest } => {
                let greatest = rounded(*greatest, 3);
                write!(f, "the joints of offsets {} and {} are at most {greatest} apart", i + 1, j + 1)
            }
            Self::DetTooSmall { sign, greatest } => {
                let greatest = rounded(*greatest, 3);
                write!(f, "{} det A is at most {greatest}", if *sign > 0 { "+" } else { "-" })
            }
            Self::Combination { strength } => {
                write!(
                    f,
                    "the joint distances exclude each other (Farkas certificate of strength {strength:.2e})"
                )
            }
        }
    }
}
