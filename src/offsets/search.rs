//! The search over all branches: divide, sample, rank every cell, polish the best ones.

use super::branch::{Cell, Conflict, divide};
use super::conditioning::worst_case;
use super::outcome::OffsetReport;
use super::problem::{InvalidProblem, Model, OffsetProblem};
use super::relaxation::proved_empty;
use super::sampling::{best_sample, feasible_points, hopeful_point};
use super::scp::{Effort, LocalResult, climb};
use super::verdict::{assemble, nothing_fits, vertices_too_close};
use crate::num::Rng;
use crate::num::conic::SolverFailure;
use crate::num::parallel::parallel;

/// Options of the search; none of them changes what is feasible.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OptimizeOptions {
    /// Seed of starting points. Same seed, same answer, whatever the number of threads.
    pub seed: u64,
    /// Worker threads (0 counts as 1).
    pub threads: usize,
    /// Feasible samples before each climb of the first pass; the best of them is its start.
    pub samples: usize,
    /// Climbs in each cell in the first pass.
    pub climbs: usize,
    /// Cells polished to full accuracy.
    pub polished: usize,
    /// Further starts in each polished cell.
    pub starts: usize,
}

impl Default for OptimizeOptions {
    fn default() -> Self {
        Self { seed: 1, threads: 1, samples: 12, climbs: 3, polished: 16, starts: 6 }
    }
}

/// How far the search is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Progress {
    /// Cells ranked so far.
    Ranking {
        /// Done.
        done: usize,
        /// Of how many.
        total: usize,
    },
    /// Starts of the best cells polished so far.
    Polishing {
        /// Done.
        done: usize,
        /// Of how many.
        total: usize,
    },
}

/// What the first pass found in a cell.
#[derive(Debug)]
pub(crate) enum CellResult {
    Feasible(LocalResult),
    Empty(Conflict),
    Unknown(Option<SolverFailure>),
}

/// Draws tried for one wanted feasible sample.
const DRAWS_PER_SAMPLE: usize = 30;
/// With more poses than this the first pass sees the most critical ones only; values are always true ones.
const RANKING_POSES: usize = 80;
/// Feasible samples whose worst poses make up that selection.
const CRITICAL_SAMPLES: usize = 160;

/// Best feasible run of a few short climbs from sampled starts; without one, restoration, then a proof.
fn rank_cell(m: &Model, cell: &Cell, index: usize, o: &OptimizeOptions) -> CellResult {
    let mut rng = Rng::stream(o.seed, index as u64);
    let samples = o.samples.max(1);
    let mut best: Option<LocalResult> = None;
    for _ in 0..o.climbs.max(1) {
        let Some(start) = best_sample(m, cell, &mut rng, samples, DRAWS_PER_SAMPLE * samples) else { break };
        let run = climb(m, cell, start.t, Effort::RANK);
        if best.as_ref().is_none_or(|b| better(&run, b)) {
            best = Some(run);
        }
    }
    if let Some(run) = best.filter(LocalResult::is_feasible) {
        return CellResult::Feasible(run);
    }
    // restoration: such a climb first removes the violation
    let restored = climb(m, cell, hopeful_point(cell), Effort::RESTORE);
    if restored.is_feasible() {
        return CellResult::Feasible(restored);
    }
    proved_empty(cell, m).map_or(CellResult::Unknown(restored.failure), CellResult::Empty)
}

pub(crate) fn better(a: &LocalResult, b: &LocalResult) -> bool {
    a.is_feasible() && (!b.is_feasible() || a.value > b.value)
}

/// Finds the best joint-free platform; see [`OffsetProblem`] for the problem, the theory page for the method.
///
/// All 729 branches are searched and reported. The result is a local optimum of its branch with evidence, and the
/// best of all local optima found; a proof of global optimality is not claimed.
///
/// # Errors
/// [`InvalidProblem`] when the problem cannot be asked. An infeasible problem is a value.
pub fn optimize(
    problem: &OffsetProblem,
    options: &OptimizeOptions,
    progress: &mut dyn FnMut(Progress),
) -> Result<OffsetReport, InvalidProblem> {
    problem.validate()?;
    let (m, scale) = (Model::new(problem), problem.size());
    let divisions = divide(&m, scale);
    if let Some(conflict) = vertices_too_close(&m, scale) {
        return Ok(nothing_fits(divisions, &conflict, options.seed));
    }
    let cells: Vec<&Cell> = divisions.iter().flat_map(|d| &d.cells).collect();
    let total = cells.len();
    let few = critical_poses(&m, &cells, options.seed);
    let rank = |k: usize| match rank_cell(few.as_ref().unwrap_or(&m), cells[k], k, options) {
        CellResult::Feasible(mut run) => {
            run.value = worst_case(&m.poses, &run.t).0;
            CellResult::Feasible(run)
        }
        other => other,
    };
    let tick = &mut |done| progress(Progress::Ranking { done, total });
    let ranked = parallel(total, options.threads, rank, tick);
    let mut best_first: Vec<(f64, usize)> = ranked
        .iter()
        .enumerate()
        .filter_map(|(k, r)| if let CellResult::Feasible(r) = r { Some((r.value, k)) } else { None })
        .collect();
    best_first.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    best_first.truncate(options.polished.max(1));
    let polished = polish(&m, &cells, &ranked, &best_first, options, progress);
    Ok(assemble(problem, &m, &divisions, &cells, ranked, polished, options))
}

/// The model with the poses that are worst at feasible samples of many cells, most frequent first, then evenly
/// strided ones; `None` when there are few poses anyway.
fn critical_poses(m: &Model, cells: &[&Cell], seed: u64) -> Option<Model> {
    let count = m.poses.len();
    if count <= RANKING_POSES || cells.is_empty() {
        return None;
    }
    let mut rng = Rng::stream(seed, 1 << 40);
    let mut hits = vec![0usize; count];
    for k in 0..CRITICAL_SAMPLES {
        let cell = cells[k * cells.len() / CRITICAL_SAMPLES];
        for t in feasible_points(m, cell, &mut rng, 1, DRAWS_PER_SAMPLE) {
            hits[worst_case(&m.poses, &t).1] += 2;
        }
    }
    for k in 0..RANKING_POSES / 2 {
        hits[k * count / (RANKING_POSES / 2)] += 1;
    }
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|&i, &j| hits[j].cmp(&hits[i]).then(i.cmp(&j)));
    order.truncate(RANKING_POSES);
    order.sort_unstable();
    Some(Model { poses: order.into_iter().map(|k| m.poses[k].clone()).collect(), ..m.clone() })
}

/// Climbs again from the ranked point and from further starts; the best feasible run of each cell.
fn polish(
    m: &Model,
    cells: &[&Cell],
    ranked: &[CellResult],
    chosen: &[(f64, usize)],
    o: &OptimizeOptions,
    progress: &mut dyn FnMut(Progress),
) -> Vec<(usize, LocalResult)> {
    let mut tasks: Vec<(usize, [f64; 6])> = Vec::new();
    for &(_, k) in chosen {
        if let CellResult::Feasible(r) = &ranked[k] {
            tasks.push((k, r.t));
        }
        let mut rng = Rng::stream(o.seed ^ 0x5eed, k as u64);
        let starts = feasible_points(m, cells[k], &mut rng, o.starts, DRAWS_PER_SAMPLE * o.starts);
        tasks.extend(starts.into_iter().map(|t| (k, t)));
    }
    let total = tasks.len();
    let run = |i: usize| climb(m, cells[tasks[i].0], tasks[i].1, Effort::POLISH);
    let runs = parallel(total, o.threads, run, &mut |done| progress(Progress::Polishing { done, total }));
    let mut best: Vec<(usize, LocalResult)> = Vec::new();
    for ((k, _), run) in tasks.iter().zip(runs) {
        match best.iter_mut().find(|b| b.0 == *k) {
            Some(b) if better(&run, &b.1) => b.1 = run,
            Some(_) => {}
            None => best.push((*k, run)),
        }
    }
    best.sort_by(|a, b| {
        b.1.is_feasible().cmp(&a.1.is_feasible()).then(b.1.value.total_cmp(&a.1.value)).then(a.0.cmp(&b.0))
    });
    best
}
