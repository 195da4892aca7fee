//! Branch and bound over the cells of a workspace (Moore 1966): choice of the next cell, searches from it, decision of
//! the bound.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap};

use super::CellEvaluator;
use super::cone::Sector;
use super::function::BoundedFunction;
use super::verdict::{MarginBound, verdict};
use crate::requirements::TermKind;
use crate::requirements::assess::Margin;
use num::parallel::parallel;
use num::{Purpose, Rng};
use platform::geom::{Chart, ChartCell, Covered};

/// A cell that waits.
struct WaitingCell {
    below: f64,
    /// Order of arrival, which makes the order of equal bounds deterministic.
    number: usize,
    function: usize,
    chart: usize,
    cell: ChartCell,
    /// For joint angles: directions in which the leg leans.
    sector: Sector,
    /// The part to halve: a coordinate, or the sector (6).
    axis: usize,
}

/// In place of a coordinate: the sector is halved.
const SECTOR: usize = 6;

impl PartialEq for WaitingCell {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for WaitingCell {}

impl PartialOrd for WaitingCell {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for WaitingCell {
    /// The least bound is the greatest, for the heap.
    fn cmp(&self, other: &Self) -> Ordering {
        other.below.total_cmp(&self.below).then(other.number.cmp(&self.number))
    }
}
/// Greatest number of local searches from cells, by function.
const SEARCHES: usize = 3;

/// Number of cells searched for worse violations after the first one.
const WORSE: usize = 300;

/// Rounds of random steps of a local search.
const ROUNDS: usize = 60;

/// Bounds may stay below the least margin by up to this share.
const CLOSE: f64 = 0.8;

/// Number of cells halved before the next choice, for any number of threads.
const BATCH: usize = 16;

/// A function, by its number, on a chart.
type Place = (usize, usize);

/// Progress of one kind.
struct BranchProgress {
    heap: BinaryHeap<WaitingCell>,
    cells: usize,
    upper: f64,
    /// Chart and point of the upper bound.
    worst: Option<(usize, [f64; 6])>,
    /// Worst point of each function on each chart.
    points: BTreeMap<Place, ([f64; 6], f64)>,
    /// Number of local searches by function and chart, and the bound that the last one started from.
    searches: BTreeMap<Place, (usize, f64)>,
    /// Local searches begun.
    searched: u64,
}

impl BranchProgress {
    /// Records a point with its upper bound.
    fn see(&mut self, place: Place, z: [f64; 6], upper: f64) {
        if upper < self.upper {
            (self.upper, self.worst) = (upper, Some((place.1, z)));
        }
        let point = self.points.entry(place).or_insert((z, f64::INFINITY));
        if upper < point.1 {
            *point = (z, upper);
        }
    }
}

/// A cell that is to be bounded.
struct CellJob {
    place: Place,
    cell: ChartCell,
    sector: Sector,
    /// The known lower bound.
    below: f64,
}

/// The result of bounding a cell.
struct BoundedCell {
    cells: usize,
    /// The point with the least upper bound.
    worst: ([f64; 6], f64),
    below: f64,
    /// The rest of the cell, and the axis to halve.
    rest: Option<(ChartCell, usize)>,
}

/// A local search in doubles from the worst known point of a function.
struct CellSearch {
    place: Place,
    from: [f64; 6],
    number: u64,
}

impl CellEvaluator<'_> {
    /// The least margin of a function of a kind in doubles.
    fn plain(&self, kind: TermKind, function: BoundedFunction, chart: usize, x: &[f64; 6]) -> f64 {
        let pose = self.charts[chart].pose(x);
        let all = self.terms.of_kind(&pose, kind);
        all.filter(|(t, _)| function.has(t)).map(|(_, v)| v).fold(f64::INFINITY, f64::min)
    }

    /// The least margin of a kind over all charts, decided against `safety_margin`; the lower bound is that of the
    /// margin minus the safety margin.
    pub(super) fn bound(
        &self,
        mut found: Margin,
        cells: usize,
        seed: u64,
        safety_margin: f64,
    ) -> MarginBound {
        let kind = found.term.kind;
        let functions = self.functions(kind);
        // the worst pose found so far, for a proof that it is one
        let pose =
            found.pose.map(|p| CellEvaluator { charts: vec![Chart::of_pose(&p)], axes: self.axes, ..*self });
        let upper = pose.map_or(f64::INFINITY, |evaluator| {
            let point = |f: &BoundedFunction| {
                evaluator.evaluate(*f, 0, &ChartCell::point([0.0; 6]), &Sector::ALL, None).upper
            };
            functions.iter().map(point).fold(f64::INFINITY, f64::min)
        });
        let mut state = BranchProgress {
            heap: BinaryHeap::new(),
            cells: 0,
            upper,
            worst: None,
            points: BTreeMap::new(),
            searches: BTreeMap::new(),
            searched: 0,
        };
        self.look_at(&mut state, &functions, self.roots(&functions));
        let rounding = |s: &BranchProgress| {
            let pose = s.worst.map(|(c, z)| self.charts[c].pose(&z)).or(found.pose);
            self.terms.rounding(kind, pose.as_ref())
        };
        let mut slack = rounding(&state);
        let (most, enough) = (state.cells + cells, state.cells + cells.min(WORSE));
        let mut below = f64::INFINITY;
        while let Some(first) = state.heap.pop() {
            below = first.below - safety_margin;
            let upper = state.upper - safety_margin;
            // whether a cell with this bound is settled without halving
            let settles = |below: f64| {
                let close = !self.close || below >= CLOSE * upper.abs() || below >= upper - slack;
                close && below >= -slack
            };
            let decided = (upper < -slack && state.cells >= enough) || settles(below);
            // a cell that cannot be halved keeps its bound
            let over = state.cells >= most || self.options.is_late();
            let Some(mut jobs) = halves_of(&first).filter(|_| !decided && !over) else { break };
            let mut places = vec![(first.function, first.chart)];
            for _ in 1..BATCH {
                let next = state.heap.peek().filter(|next| !settles(next.below - safety_margin));
                let Some(halves) = next.and_then(halves_of) else { break };
                jobs.extend(halves);
                places.extend(state.heap.pop().map(|next| (next.function, next.chart)));
            }
            self.search(&mut state, (kind, &functions), &places, seed);
            slack = rounding(&state);
            self.look_at(&mut state, &functions, jobs);
        }
        if let Some((chart, z)) = state.worst {
            let pose = self.charts[chart].pose(&z);
            let there = self.terms.of_kind(&pose, kind);
            let least = there.reduce(|a, b| if b.1 < a.1 { b } else { a });
            if let Some(least) = least.filter(|l| l.1 < found.value) {
                found = self.terms.margin(least, Some(pose));
            }
        }
        let verdict = verdict(below, state.upper - safety_margin, slack);
        MarginBound { found, below, verdict, cells: state.cells, safety_margin: None }
    }

    /// The whole charts, for every function.
    fn roots(&self, functions: &[BoundedFunction]) -> Vec<CellJob> {
        let mut out = Vec::new();
        for (chart, own) in self.charts.iter().enumerate() {
            for (f, function) in functions.iter().enumerate() {
                let job =
                    |sector| CellJob { place: (f, chart), cell: own.root, sector, below: f64::NEG_INFINITY };
                out.extend(self.sectors(*function, own).into_iter().map(job));
            }
        }
        out
    }

    /// Bounds cells and keeps those that can contain a least margin.
    fn look_at(&self, state: &mut BranchProgress, functions: &[BoundedFunction], jobs: Vec<CellJob>) {
        let known = &state.points;
        let bounded = |k: usize| {
            let job = &jobs[k];
            self.bounded(functions[job.place.0], job, known.get(&job.place).copied())
        };
        let found = parallel(jobs.len(), self.threads, bounded, &mut |_, _| ());
        for (job, done) in jobs.into_iter().zip(found) {
            state.cells += done.cells;
            if done.cells > 0 {
                state.see(job.place, done.worst.0, done.worst.1);
            }
            if let Some((cell, axis)) = done.rest {
                let (function, chart) = job.place;
                let (below, number) = (done.below, state.cells);
                state.heap.push(WaitingCell {
                    below,
                    number,
                    function,
                    chart,
                    cell,
                    sector: job.sector,
                    axis,
                });
            }
        }
    }

    /// Bounds a cell and then its rest, as long as the rest shrinks. `known` is the worst known point of the function
    /// with its upper bound.
    fn bounded(
        &self,
        function: BoundedFunction,
        job: &CellJob,
        known: Option<([f64; 6], f64)>,
    ) -> BoundedCell {
        let chart = job.place.1;
        let mut worst = known.unwrap_or(([0.0; 6], f64::INFINITY));
        let mut done = BoundedCell { cells: 0, worst, below: job.below, rest: None };
        if self.charts[chart].covers(&job.cell, 1.0) == Covered::Outside {
            return done;
        }
        let mut cell = job.cell;
        loop {
            let near = (done.cells > 0 || known.is_some()).then_some(worst.0);
            let found = self.evaluate(function, chart, &cell, &job.sector, near);
            if found.upper < worst.1 || near.is_none() {
                worst = (found.z, found.upper);
            }
            done.cells += 1;
            (done.worst, done.below) = (worst, done.below.max(found.bounded.below));
            let Some(rest) = found.rest else { return done };
            if rest != cell {
                // the rest is smaller, so its bound is better
                cell = rest;
                continue;
            }
            let loose = found.bounded.loose;
            let wide = |k: usize| cell.hi[k] > cell.lo[k];
            let better = |k: usize, best: usize| wide(k) && (!wide(best) || loose[k] > loose[best]);
            let mut axis = (0..6).fold(0, |best, k| if better(k, best) { k } else { best });
            if found.loose_sector > if wide(axis) { loose[axis] } else { 0.0 } {
                axis = SECTOR;
            }
            done.rest = Some((cell, axis));
            return done;
        }
    }

    /// Local searches from the worst known points of some functions, if these are worse than the starts of the last
    /// searches.
    fn search(
        &self,
        state: &mut BranchProgress,
        (kind, functions): (TermKind, &[BoundedFunction]),
        places: &[Place],
        seed: u64,
    ) {
        let mut all: Vec<CellSearch> = Vec::new();
        for place in places {
            let Some((from, start)) = state.points.get(place).copied() else { continue };
            let (tried, last) = state.searches.entry(*place).or_insert((0, f64::INFINITY));
            let waits = all.iter().any(|s| s.place == *place) || self.charts[place.1].coordinates() == 0;
            if waits || *tried >= SEARCHES || (*tried > 0 && start >= *last) {
                continue;
            }
            *tried += 1;
            all.push(CellSearch { place: *place, from, number: state.searched });
            state.searched += 1;
        }
        let searched = |k: usize| {
            let s = &all[k];
            let function = functions[s.place.0];
            let x = self.searched(kind, function, s, &mut Purpose::CELL_SEARCHES.item(seed, s.number));
            (x, self.evaluate(function, s.place.1, &ChartCell::point(x), &Sector::ALL, None).upper)
        };
        let found = parallel(all.len(), self.threads, searched, &mut |_, _| ());
        for (search, (x, upper)) in all.into_iter().zip(found) {
            let start = state.points.get(&search.place).map_or(f64::INFINITY, |p| p.1);
            state.see(search.place, x, upper);
            if let Some(last) = state.searches.get_mut(&search.place) {
                last.1 = upper.min(start);
            }
        }
    }

    /// The result of a local search.
    fn searched(
        &self,
        kind: TermKind,
        function: BoundedFunction,
        search: &CellSearch,
        rng: &mut Rng,
    ) -> [f64; 6] {
        let (c, mut x) = (search.place.1, search.from);
        let chart = &self.charts[c];
        let value = |x: &[f64; 6]| self.plain(kind, function, c, x);
        let inside = |x: [f64; 6]| {
            let held = std::array::from_fn(|k| x[k].clamp(chart.root.lo[k], chart.root.hi[k]));
            chart.pulled_inside(held)
        };
        let (mut least, mut step) = (value(&x), 0.2);
        for _ in 0..ROUNDS {
            let mut better = false;
            for trial in 0..2 * chart.coordinates() {
                let mut y = x;
                for k in 0..chart.coordinates() {
                    if trial % 2 == 0 || k == trial / 2 {
                        y[k] += step * rng.uniform(-1.0, 1.0);
                    }
                }
                let y = inside(y);
                let there = value(&y);
                if there < least {
                    (least, x, better) = (there, y, true);
                }
            }
            if !better {
                step /= 3.0;
            }
        }
        x
    }
}

/// The halves of a cell; `None` where it cannot be halved.
fn halves_of(open: &WaitingCell) -> Option<Vec<CellJob>> {
    let place = (open.function, open.chart);
    let job = |cell, sector| CellJob { place, cell, sector, below: open.below };
    if open.axis == SECTOR {
        return Some(open.sector.halves().into_iter().map(|sector| job(open.cell, sector)).collect());
    }
    Some(open.cell.halves(open.axis)?.into_iter().map(|part| job(part, open.sector)).collect())
}
