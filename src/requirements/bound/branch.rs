//! Branch and bound over the cells of a workspace (Moore 1966): which cell is halved next, what is searched from it, and when the bound decides.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap};

use super::CellJudge;
use super::cone::Sector;
use super::function::Function;
use super::verdict::{MarginBound, verdict};
use crate::geom::{Chart, ChartCell, Covered};
use crate::num::{Purpose, Rng};
use crate::requirements::TermKind;
use crate::requirements::assess::Margin;

/// A cell that waits.
struct Open {
    below: f64,
    /// Order of arrival, which makes the order of equal bounds certain.
    number: usize,
    function: usize,
    chart: usize,
    cell: ChartCell,
    /// For swing: directions in which the leg leans.
    sector: Sector,
    /// What to halve: a coordinate, or the sector (6).
    axis: usize,
}

/// In place of a coordinate: the sector is halved.
const SECTOR: usize = 6;

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Open {}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Open {
    /// The least bound is the greatest, for the heap.
    fn cmp(&self, other: &Self) -> Ordering {
        other.below.total_cmp(&self.below).then(other.number.cmp(&self.number))
    }
}
/// Local searches that go on from a cell, by function.
const SEARCHES: usize = 3;

/// Cells in which worse violations than the first one are looked for.
const WORSE: usize = 300;

/// Rounds of random steps of a local search.
const ROUNDS: usize = 60;

/// Bounds need not come closer to the least margin than this part of it.
const CLOSE: f64 = 0.8;

/// Progress of one kind.
struct State {
    heap: BinaryHeap<Open>,
    cells: usize,
    upper: f64,
    /// Chart and point of the upper bound.
    worst: Option<(usize, [f64; 6])>,
    /// Worst point by function and chart.
    points: BTreeMap<(usize, usize), ([f64; 6], f64)>,
    /// Number of local searches by function and chart, and the bound that the last one started from.
    searches: BTreeMap<(usize, usize), (usize, f64)>,
}

impl CellJudge<'_> {
    /// The least margin of a function in doubles.
    fn plain(&self, (kind, function): (TermKind, Function), chart: usize, x: &[f64; 6]) -> f64 {
        let all = self.terms.of_kind(&self.charts[chart].pose(x), kind);
        all.filter(|(t, _)| function.has(t)).map(|(_, v)| v).fold(f64::INFINITY, f64::min)
    }

    /// The least margin of a kind over all charts, decided against `reserve`; the bound below is that of the margin less the reserve.
    pub(super) fn bound(&self, mut found: Margin, cells: usize, seed: u64, reserve: f64) -> MarginBound {
        let kind = found.term.kind;
        let functions = self.functions(kind);
        // the worst pose found so far, for a proof that it is one
        let pose =
            found.pose.map(|p| CellJudge { charts: vec![Chart::of_pose(&p)], axes: self.axes, ..*self });
        let upper = pose.map_or(f64::INFINITY, |judge| {
            let point =
                |f: &Function| judge.evaluate(*f, 0, &ChartCell::point([0.0; 6]), &Sector::ALL, None).upper;
            functions.iter().map(point).fold(f64::INFINITY, f64::min)
        });
        let mut state = State {
            heap: BinaryHeap::new(),
            cells: 0,
            upper,
            worst: None,
            points: BTreeMap::new(),
            searches: BTreeMap::new(),
        };
        let mut rng = Purpose::BOUNDED_POSES.rng(seed);
        for chart in 0..self.charts.len() {
            for f in 0..functions.len() {
                for sector in self.sectors(functions[f], &self.charts[chart]) {
                    let root = self.charts[chart].root;
                    self.push(&mut state, &functions, (f, chart), root, sector, f64::NEG_INFINITY);
                }
            }
        }
        let rounding = |s: &State| {
            let pose = s.worst.map(|(c, z)| self.charts[c].pose(&z)).or(found.pose);
            self.terms.rounding(kind, pose.as_ref())
        };
        let mut slack = rounding(&state);
        let (most, enough) = (state.cells + cells, state.cells + cells.min(WORSE));
        let mut below = f64::INFINITY;
        while let Some(open) = state.heap.pop() {
            below = open.below - reserve;
            let upper = state.upper - reserve;
            let close = !self.close || below >= CLOSE * upper.abs() || below >= upper - slack;
            let decided = (upper < -slack && state.cells >= enough) || (close && below >= -slack);
            if decided || state.cells >= most {
                break;
            }
            let key = (open.function, open.chart);
            self.search(&mut state, (kind, functions[open.function]), key, &mut rng);
            slack = rounding(&state);
            if open.axis == SECTOR {
                for sector in open.sector.halves() {
                    self.push(&mut state, &functions, key, open.cell, sector, open.below);
                }
                continue;
            }
            let Some(parts) = open.cell.halves(open.axis) else { break };
            for part in parts {
                self.push(&mut state, &functions, key, part, open.sector, open.below);
            }
        }
        if let Some((chart, z)) = state.worst {
            let pose = self.charts[chart].pose(&z);
            let there = self.terms.of_kind(&pose, kind);
            let least = there.reduce(|a, b| if b.1 < a.1 { b } else { a });
            if let Some((term, value)) = least.filter(|l| l.1 < found.value) {
                let standing = self.terms.standing(kind, value, Some(&pose));
                found = Margin { term, value, pose: Some(pose), standing };
            }
        }
        let verdict = verdict(below, state.upper - reserve, slack);
        MarginBound { found, below, verdict, cells: state.cells, reserve: None }
    }

    /// Bounds a cell and keeps it, unless it cannot hold a least margin.
    fn push(
        &self,
        state: &mut State,
        functions: &[Function],
        (f, c): (usize, usize),
        cell: ChartCell,
        sector: Sector,
        parent: f64,
    ) {
        let chart = &self.charts[c];
        if chart.covers(&cell, 1.0) == Covered::Outside {
            return;
        }
        let (mut cell, mut below) = (cell, parent);
        loop {
            state.cells += 1;
            let known = state.points.get(&(f, c)).map(|p| p.0);
            let found = self.evaluate(functions[f], c, &cell, &sector, known);
            if found.upper < state.upper {
                (state.upper, state.worst) = (found.upper, Some((c, found.z)));
            }
            let point = state.points.entry((f, c)).or_insert((found.z, f64::INFINITY));
            if found.upper < point.1 {
                *point = (found.z, found.upper);
            }
            below = below.max(found.bounded.below);
            let Some(rest) = found.rest else { return };
            if rest != cell {
                // what is left is smaller: its bound is better
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
            let number = state.cells;
            state.heap.push(Open { below, number, function: f, chart: c, cell, sector, axis });
            return;
        }
    }

    /// A local search in doubles from the worst point known of a function.
    fn search(
        &self,
        state: &mut State,
        function: (TermKind, Function),
        key: (usize, usize),
        rng: &mut Rng,
    ) {
        let c = key.1;
        let chart = &self.charts[c];
        let (tried, last): &mut (usize, f64) = state.searches.entry(key).or_insert((0, f64::INFINITY));
        let Some((mut x, start)) = state.points.get(&key).copied() else { return };
        if *tried >= SEARCHES || chart.len() == 0 || (*tried > 0 && start >= *last) {
            return;
        }
        *tried += 1;
        let value = |x: &[f64; 6]| self.plain(function, c, x);
        let inside = |x: [f64; 6]| {
            let held = std::array::from_fn(|k| x[k].clamp(chart.root.lo[k], chart.root.hi[k]));
            chart.pulled_inside(held)
        };
        let (mut least, mut step) = (value(&x), 0.2);
        for _ in 0..ROUNDS {
            let mut better = false;
            for trial in 0..2 * chart.len() {
                let mut y = x;
                for k in 0..chart.len() {
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
        let found = self.evaluate(function.1, c, &ChartCell::point(x), &Sector::ALL, None);
        if found.upper < state.upper {
            (state.upper, state.worst) = (found.upper, Some((c, x)));
        }
        if state.points.get(&key).is_none_or(|p| found.upper < p.1) {
            state.points.insert(key, (x, found.upper));
        }
        if let Some(search) = state.searches.get_mut(&key) {
            search.1 = found.upper.min(start);
        }
    }
}
