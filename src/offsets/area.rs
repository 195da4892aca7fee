//! The best run compared with all offsets of the problem.

use std::ops::ControlFlow;

use super::bound::{BoundOptions, Bounding, GlobalBound};
use super::branch::{Branch, Cell, Division};
use super::conditioning::worst_case_above;
use super::hexagon::offset_determinant;
use super::limits::Limits;
use super::problem::{Model, OffsetProblem};
use super::sampling::{in_order, is_feasible};
use super::scp::{Effort, LocalResult, climb};
use super::search::{OptimizeOptions, Progress};

/// The whole problem: everything the bound compares with.
pub(crate) struct Area<'a> {
    pub(crate) problem: &'a OffsetProblem,
    pub(crate) m: &'a Model,
    pub(crate) limits: &'a Limits,
    pub(crate) divisions: &'a [Division],
    pub(crate) cells: &'a [&'a Cell],
}

impl Area<'_> {
    /// A run from offsets that are better than all so far; `None` when they do not meet the limits.
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
        // nothing to spare, or nothing to climb
        let k = own.find(|&k| {
            let cell = self.cells[k];
            cell.sign * offset_determinant(t) > 0.0 && in_order(cell, t)
        })?;
        let met = self.problem.margins(t).is_some_and(|m| m.all_met());
        met.then(|| (k, LocalResult::drawn(*t, value)))
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
            progress(Progress::Bounding { boxes, open, best });
            if stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let boxes = self.divisions.iter().flat_map(|d| d.boxes.iter().copied()).collect();
        Bounding::new(self.problem, self.m, self.limits)?.prove(boxes, start, options, &mut improve, tick)
    }
}
