//! Which ends of the first pass are worth refining.

use super::kinematics::HeldPose;
use super::model::{Model, Task};
use super::population::{Judge, Worth};
use super::scp::{PENALTY, Run};

/// Ends whose values differ by less, relatively, count as one.
const DISTINCT: f64 = 1e-4;

/// An end of the first pass.
pub(crate) struct End {
    /// In all variables.
    pub(crate) x: Vec<f64>,
    pub(crate) run: Run,
}

impl End {
    pub(crate) fn new(model: &Model<'_>, without_axes: bool, run: Run) -> Self {
        let mut x = run.x.clone();
        x.resize(model.shape.start.len(), 0.0);
        if without_axes {
            model.aim(&mut x);
        }
        Self { x, run }
    }
}

/// The ends of the first pass, and what refining some of them taught.
pub(crate) struct Ends {
    pub(crate) points: Vec<End>,
    pub(crate) tried: Vec<usize>,
    /// Poses that refine starts with.
    pub(crate) poses: Vec<HeldPose>,
}

impl Ends {
    /// The most promising ends with different values that were not tried yet and promise more than `best`, by their worth over the poses known.
    pub(crate) fn choose(&self, model: &Model<'_>, task: &Task, best: f64, count: usize) -> Vec<usize> {
        let mut judge = Judge::over(model, task, self.poses.clone());
        let worths: Vec<Option<Worth>> =
            self.points.iter().map(|e| judge.worth(&e.run.x, usize::MAX, None)).collect();
        let mut order: Vec<(usize, Worth)> =
            worths.into_iter().enumerate().filter_map(|(k, w)| Some((k, w?))).collect();
        // the merit of the climbs: an end that misses little at poses it did not know is worth more than a poor one that misses nothing
        order.sort_by(|a, b| b.1.merit(PENALTY).total_cmp(&a.1.merit(PENALTY)).then(a.0.cmp(&b.0)));
        let mut chosen: Vec<(usize, Worth)> = Vec::new();
        for (k, worth) in order {
            // symmetric platforms have the same optimum many times
            let known = chosen.iter().any(|(_, w)| w.is_close(&worth, DISTINCT));
            let promises_more = worth.merit(PENALTY) > best;
            if chosen.len() < count && promises_more && !known && !self.tried.contains(&k) {
                chosen.push((k, worth));
            }
        }
        chosen.into_iter().map(|c| c.0).collect()
    }

    /// Poses that mattered to refined ends matter to the others.
    pub(crate) fn learn(&mut self, poses: Vec<HeldPose>) {
        for at in poses {
            if !self.poses.contains(&at) {
                self.poses.push(at);
            }
        }
    }
}
