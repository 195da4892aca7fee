//! Joints on holes.

use super::verdict;
use crate::figure::figure;
use crate::{Sheet, Table, left, right};
use ask::rounding::RoundingWay;
use machine::manufacture::Evaluation;
use records::{
    AssessAnswer, ExactRoundingOutcome, GridRecord, GridsRecord, NearestRoundingOutcome, RoundAnswer,
    RoundedJointRecord,
};

/// A line about a design; `met`: the verdict over the whole workspace, if there is one.
fn line(out: &mut Sheet, what: &str, j: &Evaluation, met: Option<bool>, units: &str) {
    let requirements = match (met, j.met) {
        (Some(true), true) => "met",
        (None, true) => "met at the sampled poses",
        _ => "violated",
    };
    let det = j.det.map_or(String::new(), |d| format!(", det A = {}", figure(d)));
    say!(
        out,
        "{what:<8} worst conditioning {}{det}; least joint distance {} {units} on the base, {} {units} on the platform; requirements {requirements}",
        figure(j.objective),
        figure(j.least_distances[0]),
        figure(j.least_distances[1])
    );
}

fn grids(out: &mut Sheet, grids: &GridsRecord) {
    for (body, grid) in [("base", &grids.base), ("platform", &grids.platform)] {
        let words = grid.as_ref().map_or_else(|| "none, its joints stay".into(), GridRecord::in_words);
        say!(out, "  grid of the {body}: {words}");
    }
}

fn table(joints: &[RoundedJointRecord], units: &str) -> Table {
    let columns = [left("body", 8).gap(3), left("joint", 12), right("i", 7), right("j", 7)].into_iter();
    let mut table = Table::new(columns.chain([
        right(format!("moved {units}"), 10).gap(2),
        left(format!("off its line {units}"), 0).gap(2),
    ]));
    for j in joints {
        let [i, k] = j.cell.map_or_else(|| ["-".to_string(), "-".into()], |cell| cell.map(|x| x.to_string()));
        let off = j.off_line.map_or("corner".to_string(), |x| figure(x.0));
        table.row([j.body.to_string(), j.joint.clone(), i, k, figure(j.distance.0), off]);
    }
    table
}

/// The answer of `build round`.
#[must_use]
pub fn round(r: &RoundAnswer) -> Sheet {
    let units = &r.units;
    let mut out = Sheet::new();
    let chosen = r.chosen.map_or_else(
        || "no rounding meets the requirements".to_owned(),
        |way| format!("the {} rounding is chosen", way.name()),
    );
    let missed = r
        .least_missed
        .map_or_else(String::new, |way| format!("; the {} rounding has the least violation", way.name()));
    say!(out, "{}: {chosen}{missed}", r.name);
    if let Some(design) = &r.design {
        let file = r.output.as_deref().unwrap_or("FILE, written with -o FILE");
        out.add(verdict(design.name(), r.assessment.as_ref(), &format!("equipod assess {file}")));
    }
    out.space();
    // the written design was assessed over the whole workspace; the line about its sampled poses must not claim more
    let written = r.chosen.or(r.least_missed);
    let known = |way: RoundingWay| {
        r.assessment.as_ref().filter(|_| written == Some(way)).and_then(AssessAnswer::met_at_assessed_poses)
    };
    line(&mut out, "given", &r.given, None, units);
    match &r.exact {
        ExactRoundingOutcome::Found(e) => {
            line(&mut out, "exact", &e.evaluation, known(RoundingWay::Exact), units);
            let proof = if e.proved { "proved in exact arithmetic" } else { "NOT proved" };
            say!(
                out,
                "  equivalent to its own octahedral platform: {proof}; leg map and forward kinematics: {}",
                e.verdict.name().replace('_', " ")
            );
            if r.free_grid {
                grids(&mut out, &e.grids);
            }
            out.table(table(&e.joints, units));
        }
        ExactRoundingOutcome::None(why) => {
            say!(out, "exact    none: {}", why.error.message);
        }
    }
    match &r.nearest {
        NearestRoundingOutcome::Found(n) => {
            line(&mut out, "nearest", &n.evaluation, known(RoundingWay::Nearest), units);
            let e = &n.pose_error;
            say!(
                out,
                "  compared with the given design: {}\n  pose error of a controller with the given joints: to first order {} {units}, {} deg \
                 (every joint in its nearest hole: {} {units}, {} deg); solved at {} random poses at most {} {units}, {} deg",
                n.verdict.name().replace('_', " "),
                figure(e.first_order.position.0),
                figure(e.first_order.rotation_deg.0),
                figure(e.first_order_nearest_points.position.0),
                figure(e.first_order_nearest_points.rotation_deg.0),
                e.solved_poses,
                figure(e.solved.position.max),
                figure(e.solved.rotation_deg.max)
            );
            if r.free_grid {
                grids(&mut out, &n.grids);
            }
            out.table(table(&n.joints, units));
        }
        NearestRoundingOutcome::None(why) => {
            say!(out, "nearest  none: {}", why.error.message);
        }
    }
    if let Some(path) = &r.output {
        say!(out, "wrote {path}");
    }
    out
}
