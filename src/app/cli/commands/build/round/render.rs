//! What `build round` writes.

use std::fmt::Write as _;

use crate::app::cli::requirements;
use ask::Design;
use ask::rounding::{RoundingChoices, RoundingWay};
use machine::manufacture::{Judgement, Rounding};
use records::{
    AssessAnswer, ExactRoundingOutcome, GridRecord, GridsRecord, NearestRoundingOutcome, RoundAnswer,
    RoundedJointRecord,
};

/// Everything there is to tell.
#[derive(Debug)]
pub(in crate::app::cli::commands) struct RoundReport<'a> {
    pub(in crate::app::cli::commands) design: &'a Design,
    pub(in crate::app::cli::commands) choices: &'a RoundingChoices,
    pub(in crate::app::cli::commands) found: &'a Rounding,
    pub(in crate::app::cli::commands) rounded: Option<(RoundingWay, &'a Design)>,
    /// The rounded design is that of the rule or of the variant asked for, not the one that misses the requirements least.
    pub(in crate::app::cli::commands) is_taken: bool,
    pub(in crate::app::cli::commands) assessment: Option<AssessAnswer>,
    pub(in crate::app::cli::commands) written: Option<&'a str>,
}

impl RoundReport<'_> {
    pub(in crate::app::cli::commands) fn record(&self) -> RoundAnswer {
        RoundAnswer {
            name: self.design.name.clone(),
            units: self.design.units.clone(),
            grids: (&self.choices.grids).into(),
            free_grid: self.choices.free,
            wanted: self.found.wanted.clone(),
            exact: ExactRoundingOutcome::new(self.design, &self.found.exact),
            nearest: NearestRoundingOutcome::new(self.design, &self.found.nearest),
            assessment: self.assessment.clone(),
            chosen: self.rounded.map(|r| r.0).filter(|_| self.is_taken),
            least_missed: self.rounded.map(|r| r.0).filter(|_| !self.is_taken),
            design: self.rounded.map(|r| r.1.into()),
            output: self.written.map(str::to_owned),
        }
    }
}

/// A line about a design; `met`: what is known of its requirements over the whole workspace, where it was judged there.
fn judged(out: &mut String, what: &str, j: &Judgement, met: Option<bool>, units: &str) {
    let requirements = match (met, j.met) {
        (Some(true), true) => "met",
        (None, true) => "met at the sampled poses",
        _ => "violated",
    };
    let det = j.det.map_or(String::new(), |d| format!(", det A = {d:.6}"));
    let _ = writeln!(
        out,
        "{what:<8} worst inverse condition number {:.6}{det}; joints at least {:.4} and {:.4} {units} apart; requirements {requirements}",
        j.objective, j.least_distances[0], j.least_distances[1],
    );
}

fn grids(out: &mut String, grids: &GridsRecord) {
    for (body, grid) in [("base", &grids.base), ("platform", &grids.platform)] {
        let words = grid.as_ref().map_or_else(|| "none, its joints stay".into(), GridRecord::in_words);
        let _ = writeln!(out, "  grid of the {body}: {words}");
    }
}

fn table(out: &mut String, joints: &[RoundedJointRecord]) {
    let _ =
        writeln!(out, "  {:<8} {:<12} {:>7} {:>7}  {:>10}  off its line", "body", "joint", "i", "j", "moved");
    for j in joints {
        let [i, k] = j.cell.map_or_else(|| ["-".to_string(), "-".into()], |cell| cell.map(|x| x.to_string()));
        let off = j.off_line.map_or("corner".to_string(), |x| format!("{:.3e}", x.0));
        let _ = writeln!(
            out,
            "  {:<8} {:<12} {i:>7} {k:>7}  {:>10.6}  {off}",
            j.body.to_string(),
            j.joint,
            j.distance.0
        );
    }
}

pub(super) fn text(r: &RoundAnswer) -> String {
    let units = &r.units;
    let mut out = String::new();
    if let Some(design) = &r.design {
        out = requirements::lead(design.name(), r.assessment.as_ref()) + "\n";
    }
    // the design that is written was judged at every pose; a line of its own poses must not say more
    let written = r.chosen.or(r.least_missed);
    let known = |way: RoundingWay| r.assessment.as_ref().filter(|_| written == Some(way)).and_then(|a| a.met);
    let _ = writeln!(out, "{}", r.name);
    judged(&mut out, "wanted", &r.wanted, None, units);
    match &r.exact {
        ExactRoundingOutcome::Found(e) => {
            judged(&mut out, "exact", &e.judgement, known(RoundingWay::Exact), units);
            let proof = if e.proved { "proved in exact arithmetic" } else { "NOT proved" };
            let _ = writeln!(
                out,
                "  equivalent to its own octahedral platform: {proof}; leg map and forward kinematics: {}",
                e.verdict.as_str()
            );
            if r.free_grid {
                grids(&mut out, &e.grids);
            }
            table(&mut out, &e.joints);
        }
        ExactRoundingOutcome::None(why) => {
            let _ = writeln!(out, "exact    none: {}", why.error.message);
        }
    }
    match &r.nearest {
        NearestRoundingOutcome::Found(n) => {
            judged(&mut out, "nearest", &n.judgement, known(RoundingWay::Nearest), units);
            let e = &n.pose_error;
            let _ = writeln!(
                out,
                "  with the wanted design: {}; error of the pose by its formula: first order {:.4e} {units}, {:.4e} deg \
                 (every joint on the nearest point: {:.4e}, {:.4e}); solved at {} random poses at most {:.4e}, {:.4e}",
                n.verdict.as_str(),
                e.first_order.position.0,
                e.first_order.rotation_deg.0,
                e.first_order_nearest_points.position.0,
                e.first_order_nearest_points.rotation_deg.0,
                e.solved_poses,
                e.solved.position.max,
                e.solved.rotation_deg.max
            );
            if r.free_grid {
                grids(&mut out, &n.grids);
            }
            table(&mut out, &n.joints);
        }
        NearestRoundingOutcome::None(why) => {
            let _ = writeln!(out, "nearest  none: {}", why.error.message);
        }
    }
    let chosen = r.chosen.map_or("none meets the requirements", RoundingWay::as_str);
    let missed =
        r.least_missed.map_or_else(String::new, |way| format!("; {} misses them least", way.as_str()));
    let _ = writeln!(out, "chosen: {chosen}{missed}");
    if let Some(path) = &r.output {
        let _ = writeln!(out, "wrote {path}");
    }
    out
}
