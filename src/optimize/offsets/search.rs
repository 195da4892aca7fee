//! The search over all branches: divide, sample, rank every cell, polish the best ones.
//!
//! Two pieces of evidence follow. A derivative-free search around the solution uses neither the conic solver nor
//! derivatives. The bound over all offsets of the problem is compared with the best run.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use super::bound::{BoundOptions, Bounding, GlobalBound};
use super::branch::{
    Branch, BranchCell, Division, best_sample, divide, feasible_points, hopeful_point, in_order, is_feasible,
    tight_point,
};
use super::climb::{LocalResult, RANK, RESTORE, climb, violation};
use super::conditioning::{worst_case, worst_case_above};
use super::limits::{OffsetLimits, proved_empty};
use super::outcome::OffsetReport;
use super::problem::{InvalidOffsetProblem, OffsetModel, OffsetProblem};
use super::verdict::{Conflict, SearchedOffsets, assemble, nothing_fits, vertices_too_close};
use crate::climb::Effort;
use num::conic::SolverFailure;
use num::parallel::parallel;
use num::{Purpose, Rng};
use synthesis::offset_determinant;

/// Options of the search; none of them changes the requirements of a feasible design.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OffsetSearchOptions {
    /// Seed of starting points. The same seed gives the same answer for any number of threads.
    pub seed: u64,
    /// Worker threads (0 counts as 1).
    pub threads: usize,
    /// Number of feasible samples before each climb of the first pass; the best of them is its start.
    pub samples: usize,
    /// Number of climbs in each cell in the first pass.
    pub climbs: usize,
    /// Number of cells polished to full accuracy.
    pub polished: usize,
    /// Number of further starts in each polished cell.
    pub starts: usize,
    /// Whether to search every branch for its own best, beyond the needs of the whole problem.
    pub survey: bool,
    /// Greatest relative gap between the proved upper bound and the solution at which the solution counts as optimal. A
    /// proof that needs too many boxes ends with a wider gap.
    pub gap: f64,
    /// Number of boxes of offsets after which the gap is widened.
    pub boxes: usize,
}

impl Default for OffsetSearchOptions {
    fn default() -> Self {
        Self {
            seed: 1,
            threads: 1,
            samples: 12,
            climbs: 3,
            polished: 16,
            starts: 6,
            survey: false,
            gap: 1e-2,
            boxes: 40_000,
        }
    }
}

/// The progress in words.
impl std::fmt::Display for OffsetProgress {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Ranking { done, total, best } => write!(f, "best {best:.6}; cell {done} of {total}"),
            Self::Polishing { done, total, best } => write!(f, "best {best:.6}; climb {done} of {total}"),
            Self::Bounding { boxes, open, best } => {
                write!(f, "best {best:.6}; {boxes} boxes compared, {open} waiting")
            }
        }
    }
}

/// Progress of the search.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum OffsetProgress {
    /// Cells ranked so far.
    Ranking {
        /// Number done.
        done: usize,
        /// Total number.
        total: usize,
        /// Best worst-case inverse condition number of feasible offsets so far, 0 before the first.
        best: f64,
    },
    /// Boxes of offsets compared with the best value.
    Bounding {
        /// Number of searched boxes.
        boxes: usize,
        /// Number of waiting boxes.
        open: usize,
        /// Best worst-case inverse condition number so far.
        best: f64,
    },
    /// Starts of the best cells polished so far.
    Polishing {
        /// Number done.
        done: usize,
        /// Total number.
        total: usize,
        /// Best worst-case inverse condition number of feasible offsets so far, 0 before the first.
        best: f64,
    },
}

/// The best value of all threads, for progress reports.
struct Best(AtomicU64);

impl Best {
    fn new() -> Self {
        Self(AtomicU64::new(0))
    }

    fn offer(&self, run: &LocalResult) {
        if run.is_feasible() && run.value > 0.0 {
            // non-negative doubles have the order of their bits
            self.0.fetch_max(run.value.to_bits(), Ordering::Relaxed);
        }
    }

    fn value(&self) -> f64 {
        f64::from_bits(self.0.load(Ordering::Relaxed))
    }
}

/// The result of the first pass in a cell.
#[derive(Debug)]
pub(crate) enum CellResult {
    Feasible(LocalResult),
    /// No feasible point was drawn or searched: the bound over all offsets covers it.
    Passed,
    Empty(Conflict),
    Unknown(Option<SolverFailure>),
}

/// Number of draws per wanted feasible sample.
const DRAWS_PER_SAMPLE: usize = 30;
/// Above this number of poses the first pass uses only the most critical ones; reported values are always true ones.
const RANKING_POSES: usize = 80;
/// Number of feasible samples whose worst poses form that selection.
const CRITICAL_SAMPLES: usize = 160;
/// Number of poses of the first sample if not every branch is searched.
const SAMPLED_POSES: usize = 24;
/// Up to this number of cells every cell is searched.
const FEW_CELLS: usize = 64;
/// Number of cells climbed after that sample, and polished.
const CONTENDERS: usize = 12;
const FINALISTS: usize = 3;

/// The problem in three forms: as given, for the search, and for proofs.
#[derive(Debug, Clone, Copy)]
struct OffsetQuestion<'a> {
    problem: &'a OffsetProblem,
    m: &'a OffsetModel,
    limits: &'a OffsetLimits,
}

/// Best feasible run of a few short climbs from sampled starts, with the poses of `few`. Without one, it tries
/// restoration, then a proof, then offsets that meet the limits without any margin.
fn rank_cell(
    asked: OffsetQuestion<'_>,
    few: &OffsetModel,
    cell: &BranchCell,
    index: usize,
    o: &OffsetSearchOptions,
) -> CellResult {
    let m = few;
    let mut rng = Purpose::OFFSETS_OF_CELL.item(o.seed, index as u64);
    let samples = o.samples.max(1);
    let mut best: Option<LocalResult> = None;
    for _ in 0..o.climbs.max(1) {
        let Some(start) = best_sample(m, cell, &mut rng, samples, DRAWS_PER_SAMPLE * samples) else { break };
        let run = climb(m, cell, start.t, RANK);
        if best.as_ref().is_none_or(|b| better(&run, b)) {
            best = Some(run);
        }
    }
    if let Some(run) = best.filter(LocalResult::is_feasible) {
        return CellResult::Feasible(run);
    }
    // restoration: such a climb first removes the violation
    let restored = climb(m, cell, hopeful_point(cell), RESTORE);
    if restored.is_feasible() {
        return CellResult::Feasible(restored);
    }
    if let Some(conflict) = proved_empty(cell, asked.limits, &asked.m.conic) {
        return CellResult::Empty(conflict);
    }
    match tight_point(asked.problem, cell, &restored.t) {
        Some(t) => CellResult::Feasible(LocalResult::drawn(t, worst_case(&m.poses, &t).0)),
        None => CellResult::Unknown(restored.failure),
    }
}

pub(super) fn better(a: &LocalResult, b: &LocalResult) -> bool {
    a.is_feasible() && (!b.is_feasible() || a.value > b.value)
}

/// Finds the best platform without shared joints; see [`OffsetProblem`] for the problem and the theory page for the
/// method.
///
/// Branch and bound compares the best of several climbs with all offsets ([`OffsetReport::bound`]), and also finds
/// better starts if there are any. `progress` may interrupt the search; the best result so far is returned. With
/// [`OffsetSearchOptions::survey`], with few cells, or if no feasible point is drawn, every branch is searched.
///
/// # Errors
/// [`InvalidOffsetProblem`]. An infeasible problem is a regular outcome.
pub fn optimize(
    problem: &OffsetProblem,
    options: &OffsetSearchOptions,
    progress: &mut dyn FnMut(OffsetProgress) -> ControlFlow<()>,
) -> Result<OffsetReport, InvalidOffsetProblem> {
    problem.validate()?;
    let (m, limits) = (OffsetModel::new(problem), OffsetLimits::new(problem));
    let divisions = divide(&m, &limits);
    if let Some(conflict) = vertices_too_close(&limits) {
        return Ok(nothing_fits(divisions, &conflict, options));
    }
    let cells: Vec<&BranchCell> = divisions.iter().flat_map(|d| &d.cells).collect();
    // after an interruption the remaining work is skipped
    let stopped = AtomicBool::new(false);
    let progress = &mut |p| {
        if progress(p).is_break() {
            stopped.store(true, Ordering::Relaxed);
        }
    };
    let stopped = &|| stopped.load(Ordering::Relaxed);
    let best = &Best::new();
    let sampled = if options.survey || cells.len() <= FEW_CELLS {
        None
    } else {
        sample_cells(&m, &cells, options, best, progress)
    };
    let surveyed = sampled.is_none();
    let asked = OffsetQuestion { problem, m: &m, limits: &limits };
    let ranked = sampled.unwrap_or_else(|| survey(asked, &cells, options, best, stopped, progress));
    let chosen = if surveyed { options.polished } else { FINALISTS };
    let starts = if surveyed { options.starts } else { 0 };
    let tasks = polish_starts(&m, &cells, &ranked, &best_cells(&ranked, chosen), starts, options.seed);
    let mut polished = polish(&m, &cells, &tasks, options, best, stopped, progress);
    keep_ranked(&m, &ranked, &mut polished);
    let area = Area { problem, m: &m, limits: &limits, divisions: &divisions, cells: &cells };
    let bound = area.bound(&mut polished, options, stopped, progress);
    let searched = SearchedOffsets { ranked, polished, bound, interrupted: stopped() };
    Ok(assemble(problem, &m, &divisions, &cells, searched, options))
}

/// Cells in the order of their values, best first.
fn best_cells(ranked: &[CellResult], count: usize) -> Vec<usize> {
    let value = |(k, r): (usize, &CellResult)| match r {
        CellResult::Feasible(r) => Some((r.value, k)),
        _ => None,
    };
    let mut order: Vec<(f64, usize)> = ranked.iter().enumerate().filter_map(value).collect();
    order.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    order.into_iter().take(count.max(1)).map(|x| x.1).collect()
}

/// A search of every cell for its own best.
fn survey(
    asked: OffsetQuestion<'_>,
    cells: &[&BranchCell],
    o: &OffsetSearchOptions,
    best: &Best,
    stopped: &(dyn Fn() -> bool + Sync),
    progress: &mut dyn FnMut(OffsetProgress),
) -> Vec<CellResult> {
    let (m, total) = (asked.m, cells.len());
    let few = critical_poses(m, cells, o.seed, RANKING_POSES, CRITICAL_SAMPLES);
    let rank = |k: usize| {
        if stopped() {
            return CellResult::Passed;
        }
        match rank_cell(asked, few.as_ref().unwrap_or(m), cells[k], k, o) {
            CellResult::Feasible(mut run) => {
                run.value = worst_case(&m.poses, &run.t).0;
                best.offer(&run);
                CellResult::Feasible(run)
            }
            other => other,
        }
    };
    let tick = &mut |done, _: &_| progress(OffsetProgress::Ranking { done, total, best: best.value() });
    parallel(total, o.threads, rank, tick)
}

/// One feasible sample of every cell, and short climbs from the best; `None` without a sample.
fn sample_cells(
    m: &OffsetModel,
    cells: &[&BranchCell],
    o: &OffsetSearchOptions,
    best: &Best,
    progress: &mut dyn FnMut(OffsetProgress),
) -> Option<Vec<CellResult>> {
    let few = critical_poses(m, cells, o.seed, SAMPLED_POSES, SAMPLED_POSES);
    let few = few.as_ref().unwrap_or(m);
    let draw = |k: usize| {
        let mut rng = Purpose::OFFSETS_OF_CELL.item(o.seed, k as u64);
        match best_sample(few, cells[k], &mut rng, 1, DRAWS_PER_SAMPLE) {
            Some(s) => CellResult::Feasible(LocalResult::drawn(s.t, s.value)),
            None => CellResult::Passed,
        }
    };
    let mut ranked = parallel(cells.len(), o.threads, draw, &mut |_, _| ());
    let start = |k: usize| match &ranked[k] {
        CellResult::Feasible(r) => Some(r.t),
        _ => None,
    };
    let starts: Vec<ClimbStart> =
        best_cells(&ranked, CONTENDERS).into_iter().filter_map(|k| Some((k, start(k)?))).collect();
    if starts.is_empty() {
        return None;
    }
    let total = starts.len();
    let run = |i: usize| {
        let mut run = climb(few, cells[starts[i].0], starts[i].1, RANK);
        run.value = worst_case(&m.poses, &run.t).0;
        best.offer(&run);
        run
    };
    let tick = &mut |done, _: &_| progress(OffsetProgress::Ranking { done, total, best: best.value() });
    for ((k, _), run) in starts.iter().zip(parallel(total, o.threads, run, tick)) {
        if run.is_feasible() {
            ranked[*k] = CellResult::Feasible(run);
        }
    }
    Some(ranked)
}

/// The model with the poses that are worst at feasible samples of many cells, most frequent first, then evenly strided
/// ones. `None` if there are few poses anyway.
fn critical_poses(
    m: &OffsetModel,
    cells: &[&BranchCell],
    seed: u64,
    wanted: usize,
    samples: usize,
) -> Option<OffsetModel> {
    let count = m.poses.len();
    if count <= wanted || cells.is_empty() {
        return None;
    }
    let mut rng = Purpose::CRITICAL_POSES.rng(seed);
    let mut hits = vec![0usize; count];
    for k in 0..samples {
        let cell = cells[k * cells.len() / samples];
        for t in feasible_points(m, cell, &mut rng, 1, DRAWS_PER_SAMPLE) {
            hits[worst_case(&m.poses, &t).1] += 2;
        }
    }
    for k in 0..wanted / 2 {
        hits[k * count / (wanted / 2)] += 1;
    }
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|&i, &j| hits[j].cmp(&hits[i]).then(i.cmp(&j)));
    order.truncate(wanted);
    order.sort_unstable();
    Some(OffsetModel { poses: order.into_iter().map(|k| m.poses[k].clone()).collect(), ..m.clone() })
}

/// A cell and the offsets at the start of a climb.
type ClimbStart = (usize, [f64; 6]);

/// The ranked points and `more` further ones of each chosen cell.
fn polish_starts(
    m: &OffsetModel,
    cells: &[&BranchCell],
    ranked: &[CellResult],
    chosen: &[usize],
    more: usize,
    seed: u64,
) -> Vec<ClimbStart> {
    let mut tasks: Vec<ClimbStart> = Vec::new();
    for &k in chosen {
        if let CellResult::Feasible(r) = &ranked[k] {
            tasks.push((k, r.t));
        }
        let mut rng = Purpose::FURTHER_OFFSETS.item(seed, k as u64);
        let further = feasible_points(m, cells[k], &mut rng, more, DRAWS_PER_SAMPLE * more);
        tasks.extend(further.into_iter().map(|t| (k, t)));
    }
    tasks
}

/// Climbs from every start; the best feasible run of each cell, best first.
fn polish(
    m: &OffsetModel,
    cells: &[&BranchCell],
    tasks: &[ClimbStart],
    o: &OffsetSearchOptions,
    best: &Best,
    stopped: &(dyn Fn() -> bool + Sync),
    progress: &mut dyn FnMut(OffsetProgress),
) -> Vec<(usize, LocalResult)> {
    let total = tasks.len();
    let run = |i: usize| {
        let (k, start) = tasks[i];
        // the first start is always polished, as the answer of an interrupted search
        let effort = if i > 0 && stopped() { RANK } else { Effort::POLISH };
        let run = climb(m, cells[k], start, effort);
        best.offer(&run);
        run
    };
    let tick = &mut |done, _: &_| progress(OffsetProgress::Polishing { done, total, best: best.value() });
    let runs = parallel(total, o.threads, run, tick);
    let mut kept: Vec<(usize, LocalResult)> = Vec::new();
    for ((k, _), run) in tasks.iter().zip(runs) {
        match kept.iter_mut().find(|b| b.0 == *k) {
            Some(b) if better(&run, &b.1) => b.1 = run,
            Some(_) => {}
            None => kept.push((*k, run)),
        }
    }
    best_first(&mut kept);
    kept
}

fn best_first(runs: &mut [(usize, LocalResult)]) {
    runs.sort_by(|a, b| {
        b.1.is_feasible().cmp(&a.1.is_feasible()).then(b.1.value.total_cmp(&a.1.value)).then(a.0.cmp(&b.0))
    });
}

/// Keeps the start of a climb if no climb ended at a better feasible point: climbs leave a feasible set thinner than
/// the back-off.
fn keep_ranked(m: &OffsetModel, ranked: &[CellResult], polished: &mut [(usize, LocalResult)]) {
    for (k, run) in polished.iter_mut() {
        if let CellResult::Feasible(own) = &ranked[*k] {
            let own = LocalResult { value: worst_case(&m.poses, &own.t).0, ..own.clone() };
            if better(&own, run) {
                *run = own;
            }
        }
    }
    best_first(polished);
}

/// Result of the search.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PolishedOffsets {
    pub t: [f64; 6],
    pub value: f64,
    pub trials: usize,
}

/// Tries steps along the axes, along pairs of axes and in random directions, at radii from 1e-2 down to 1e-6 (offset
/// units). Steps are cut off at the box; points that violate a constraint are dropped.
pub(crate) fn pattern_search(
    m: &OffsetModel,
    cell: &BranchCell,
    start: [f64; 6],
    value: f64,
    rng: &mut Rng,
) -> PolishedOffsets {
    let mut best = PolishedOffsets { t: start, value, trials: 0 };
    let mut hint = 0;
    for step in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
        for k in 0..132 {
            let direction = direction(k, rng);
            let t: [f64; 6] = std::array::from_fn(|i| {
                let (low, high) = cell.bounds[i];
                (best.t[i] + step * direction[i]).clamp(low, high)
            });
            best.trials += 1;
            if violation(m, cell, &t) > 0.0 {
                continue;
            }
            match worst_case_above(&m.poses, &t, best.value, hint) {
                Ok((value, _)) => (best.t, best.value) = (t, value),
                Err((_, pose)) => hint = pose,
            }
        }
    }
    best
}

/// 12 axis directions, 60 along two axes, then random ones.
fn direction(k: usize, rng: &mut Rng) -> [f64; 6] {
    let sign = |bit: bool| if bit { 1.0 } else { -1.0 };
    let mut d = [0.0; 6];
    if k < 12 {
        d[k / 2] = sign(k.is_multiple_of(2));
    } else if k < 72 {
        let (pair, signs) = ((k - 12) / 4, (k - 12) % 4);
        let (i, j) = (1..6).flat_map(|i| (0..i).map(move |j| (i, j))).nth(pair).unwrap_or((1, 0));
        (d[i], d[j]) = (sign(signs & 1 == 0), sign(signs & 2 == 0));
    } else {
        d = std::array::from_fn(|_| rng.normal());
    }
    d
}

/// The whole problem, for the comparison with the bound.
pub(super) struct Area<'a> {
    pub problem: &'a OffsetProblem,
    pub m: &'a OffsetModel,
    pub limits: &'a OffsetLimits,
    pub divisions: &'a [Division],
    pub cells: &'a [&'a BranchCell],
}

impl Area<'_> {
    /// A run from offsets that are better than all so far; `None` if they violate the limits.
    fn run_from(&self, t: &[f64; 6], value: f64) -> Option<(usize, LocalResult)> {
        let d = Branch::of(t).index();
        let first: usize = self.divisions[..d].iter().map(|d| d.cells.len()).sum();
        let mut own = first..first + self.divisions[d].cells.len();
        if let Some(k) = own.clone().find(|&k| is_feasible(self.m, self.cells[k], t)) {
            let run = climb(self.m, self.cells[k], *t, Effort::POLISH);
            if run.is_feasible() && run.value > value {
                return Some((k, run));
            }
        }
        // no margin, or nothing to climb
        let k = own.find(|&k| {
            let cell = self.cells[k];
            cell.sign * offset_determinant(t) > 0.0 && in_order(cell, t)
        })?;
        let met = self.problem.margins(t).is_some_and(|m| m.all_met());
        met.then(|| (k, LocalResult::drawn(*t, value)))
    }

    /// Compares the best run with all offsets; climbs start from better ones found on the way, and their results come
    /// first.
    pub(super) fn bound(
        &self,
        polished: &mut Vec<(usize, LocalResult)>,
        o: &OffsetSearchOptions,
        stopped: &dyn Fn() -> bool,
        progress: &mut dyn FnMut(OffsetProgress),
    ) -> Option<GlobalBound> {
        let start = polished.first().filter(|p| p.1.is_feasible() && p.1.value > 0.0)?.1.value;
        let (mut hint, mut value) = (0, start);
        let mut improve = |points: &[[f64; 6]]| {
            for t in points {
                match worst_case_above(&self.m.poses, t, value, hint) {
                    Err((_, pose)) => hint = pose,
                    Ok((reached, _)) => {
                        if let Some((k, run)) = self.run_from(t, reached) {
                            value = run.value;
                            polished.insert(0, (k, run));
                        }
                    }
                }
            }
            value
        };
        let options = BoundOptions { gap: o.gap, boxes: o.boxes, threads: o.threads };
        let tick = &mut |boxes, open, best| {
            progress(OffsetProgress::Bounding { boxes, open, best });
            if stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let boxes = self.divisions.iter().flat_map(|d| d.boxes.iter().copied()).collect();
        Bounding::new(self.problem, self.m, self.limits)?.prove(boxes, start, options, &mut improve, tick)
    }
}
