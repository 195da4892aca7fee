//! What `build round` writes.

use std::fmt::Write as _;

use super::in_words;
use crate::design::Design;
use crate::manufacture::{Grid, Judgement, Rounding, RoundingProblem};
use crate::records::{
    ExactRoundingOutcome, NearestRoundingOutcome, RoundAnswer, RoundedJointRecord, RoundingVerdict,
    VariantWord,
};

/// Everything there is to tell.
#[derive(Debug)]
pub(super) struct RoundReport<'a> {
    pub(super) design: &'a Design,
    pub(super) problem: &'a RoundingProblem<'a>,
    pub(super) found: &'a Rounding,
    pub(super) rounded: Option<(VariantWord, &'a Design)>,
    pub(super) written: Option<&'a str>,
}

impl RoundReport<'_> {
    pub(super) fn record(&self) -> RoundAnswer {
        RoundAnswer {
            grids: (&self.problem.grids).into(),
            free_grid: self.problem.free,
            wanted: (&self.found.wanted).into(),
            exact: ExactRoundingOutcome::new(self.design, &self.found.exact),
            nearest: NearestRoundingOutcome::new(self.design, &self.found.nearest),
            chosen: self.rounded.map(|r| r.0),
            design: self.rounded.map(|r| r.1.into()),
            output: self.written.map(str::to_owned),
        }
    }

    fn judged(&self, out: &mut String, what: &str, j: &Judgement) {
        let det = j.det.map_or(String::new(), |d| format!(", det A = {d:.6}"));
        let _ = writeln!(
            out,
            "{what:<8} worst inverse condition number {:.6}{det}; joints at least {:.4} and {:.4} {} apart; requirements {}",
            j.objective,
            j.least_distances[0],
            j.least_distances[1],
            self.design.units,
            if j.met { "met" } else { "violated" }
        );
    }

    fn grids(&self, out: &mut String, grids: &[Grid; 2]) {
        if self.problem.free {
            for (body, grid) in ["base", "platform"].iter().zip(grids) {
                let _ = writeln!(out, "  grid of the {body}: {}", in_words(grid));
            }
        }
    }

    fn table(out: &mut String, joints: &[RoundedJointRecord]) {
        let _ = writeln!(
            out,
            "  {:<8} {:<12} {:>7} {:>7}  {:>10}  off its line",
            "body", "joint", "i", "j", "moved"
        );
        for j in joints {
            let off = j.off_line.map_or("corner".to_string(), |x| format!("{:.3e}", x.0));
            let _ = writeln!(
                out,
                "  {:<8} {:<12} {:>7} {:>7}  {:>10.6}  {off}",
                j.body.to_string(),
                j.joint,
                j.cell[0],
                j.cell[1],
                j.distance.0
            );
        }
    }

    pub(super) fn text(&self, record: &RoundAnswer) -> String {
        let units = &self.design.units;
        let mut out = format!("{}\n", self.design.name);
        self.judged(&mut out, "wanted", &self.found.wanted);
        match &self.found.exact {
            Ok(e) => {
                self.judged(&mut out, "exact", &e.judgement);
                let proof = if e.proved { "proved in exact arithmetic" } else { "NOT proved" };
                let _ = writeln!(
                    out,
                    "  equivalent to its own octahedral platform: {proof}; leg map and forward kinematics: {}",
                    RoundingVerdict::from(&e.verification).as_str()
                );
                self.grids(&mut out, &e.grids);
                if let ExactRoundingOutcome::Found(r) = &record.exact {
                    Self::table(&mut out, &r.joints);
                }
            }
            Err(why) => {
                let _ = writeln!(out, "exact    none: {why}");
            }
        }
        match &self.found.nearest {
            Ok(n) => {
                self.judged(&mut out, "nearest", &n.judgement);
                let _ = writeln!(
                    out,
                    "  with the wanted design: {}; error of the pose by its formula: first order {:.4e} {units}, {:.4e} deg \
                     (every joint on the nearest point: {:.4e}, {:.4e}); solved at {} random poses at most {:.4e}, {:.4e}",
                    RoundingVerdict::from(&n.verification).as_str(),
                    n.first_order.0,
                    n.first_order.1,
                    n.first_order_nearest.0,
                    n.first_order_nearest.1,
                    n.solved.1,
                    n.solved.0.position.max,
                    n.solved.0.rotation_deg.max
                );
                self.grids(&mut out, &n.grids);
                if let NearestRoundingOutcome::Found(r) = &record.nearest {
                    Self::table(&mut out, &r.joints);
                }
            }
            Err(why) => {
                let _ = writeln!(out, "nearest  none: {why}");
            }
        }
        let chosen = self.rounded.map_or("none meets the requirements", |r| r.0.as_str());
        let _ = writeln!(out, "chosen: {chosen}");
        if let Some(path) = self.written {
            let _ = writeln!(out, "wrote {path}");
        }
        out
    }
}
