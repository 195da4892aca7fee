//! The best run compared with all offsets of the problem.

use std::ops::ControlFlow;

use super::bound::{BoundOptions, Bounding, GlobalBound};
use super::branch::{Branch, Cell, Division};
use super::conditioning::worst_case_above;
use super::problem::{Model, OffsetProblem};
use super::sampling::is_feasible;
use super::scp::{Effort, LocalResult, climb};
use super::search::{OptimizeOptions, Progress};

/// Boxes for the bound are this much wider than the limits, offset units: more than the search keeps away from them.
const OUTWARD: f64 = 1e-6;

/// Boxes that hold all offsets of the branches that are not proved empty, a little wider than the limits say.
fn open_boxes(m: &Model, divisions: &[Division]) -> Vec<[(f64, f64); 6]> {
    let mut boxes: Vec<[(f64, f64); 6]> = Vec::new();
    for d in divisions {
        let whole = || {
            std::array::from_fn(|i| {
                let (low, high) = d.branch.0[i].range();
                (low.max(m.bounds[i].0), high.min(m.bounds[i].1))
            })
        };
        let own: Vec<[(f64, f64); 6]> =
            if d.unproved > 0 { vec![whole()] } else { d.cells.iter().map(|c| c.bounds).collect() };
        for bounds in own {
            let wider = bounds.map(|(low, high)| (low - OUTWARD, high + OUTWARD));
            if boxes.last() != Some(&wider) {
                boxes.push(wider); // cells that differ in sign or order share their box
            }
        }
    }
    boxes
}

/// The whole problem: everything the bound compares with.
pub(crate) struct Area<'a> {
    pub(crate) problem: &'a OffsetProblem,
    pub(crate) m: &'a Model,
    pub(crate) divisions: &'a [Division],
    pub(crate) cells: &'a [&'a Cell],
}

impl Area<'_> {
    /// The cell that holds feasible offsets.
    fn cell_of(&self, t: &[f64; 6]) -> Option<usize> {
        let d = Branch::of(t).index();
        let first: usize = self.divisions[..d].iter().map(|d| d.cells.len()).sum();
        (first..first + self.divisions[d].cells.len()).find(|&k| is_feasible(self.m, self.cells[k], t))
    }

    /// Compares the best run with all offsets; better ones that turn up on the way are climbed from and put in front.
    pub(crate) fn bound(
        &self,
        polished: &mut Vec<(usize, LocalResult)>,
        o: &OptimizeOptions,
        stopped: &dyn Fn() -> bool,
        progress: &mut dyn FnMut(Progress),
    ) -> Option<GlobalBound> {
        let start = polished.first().filter(|p| p.1.is_feasible() && p.1.value > 0.0)?.1.value;
        let (mut hint, mut value) = (0, start);
        let mut improve = |points: &[[f64; 6]]| {
            for t in points {
                if let Err((_, pose)) = worst_case_above(&self.m.poses, t, value, hint) {
                    hint = pose;
                    continue;
                }
                let Some(k) = self.cell_of(t) else { continue };
                let run = climb(self.m, self.cells[k], *t, Effort::POLISH);
                if run.is_feasible() && run.value > value {
                    value = run.value;
                    polished.insert(0, (k, run));
                }
            }
            value
        };
        let options = BoundOptions { gap: o.gap, boxes: o.boxes, threads: o.threads };
        let tick = &mut |boxes, open, best| {
            progress(Progress::Bounding { boxes, open, best });
            if stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let boxes = open_boxes(self.m, self.divisions);
        Bounding::new(self.problem, self.m)?.prove(boxes, start, options, &mut improve, tick)
    }
}
