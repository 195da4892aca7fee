//! What `optimize` writes.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use super::PoseSet;
use crate::cli::output::number;
use crate::design::Design;
use crate::offsets::{
    BranchReport, BranchVerdict, OffsetOutcome, OffsetProblem, OffsetReport, OffsetSolution,
};

const RUNNERS_UP: usize = 5;

/// Everything there is to tell.
#[derive(Debug)]
pub(super) struct Found<'a> {
    pub(super) design: &'a Design,
    pub(super) problem: &'a OffsetProblem,
    pub(super) set: &'a PoseSet,
    pub(super) report: &'a OffsetReport,
}

impl Found<'_> {
    fn status(&self) -> &'static str {
        match self.report.outcome {
            _ if self.report.interrupted => "interrupted",
            OffsetOutcome::Optimal(_) => "optimal",
            OffsetOutcome::LocalOptimum(_) => "local optimum",
            OffsetOutcome::NotConverged(_) => "feasible",
            OffsetOutcome::Infeasible => "infeasible",
            _ => "undecided",
        }
    }

    fn runners_up(&self) -> impl Iterator<Item = &BranchReport> {
        self.report.runners_up.iter().take(RUNNERS_UP).map(|&k| &self.report.branches[k])
    }

    /// How many branches carry a first conflict of each kind, with one example.
    fn conflicts(&self) -> BTreeMap<&'static str, (usize, String)> {
        let mut groups = BTreeMap::new();
        let empty = self.report.branches.iter().filter(|b| b.verdict == BranchVerdict::Infeasible);
        for conflict in empty.filter_map(|b| b.conflicts.first()) {
            groups.entry(conflict.code()).or_insert_with(|| (0, conflict.to_string())).0 += 1;
        }
        groups
    }
}

fn numbers(values: &[f64]) -> Value {
    values.iter().map(|x| number(*x)).collect()
}

fn branch_json(b: &BranchReport) -> Value {
    let (verdict, value, offsets) = match &b.verdict {
        BranchVerdict::Best => ("best", Value::Null, Value::Null),
        BranchVerdict::Dominated { value, offsets, .. } => ("dominated", number(*value), numbers(offsets)),
        BranchVerdict::Bounded => ("bounded", Value::Null, Value::Null),
        BranchVerdict::Infeasible => ("infeasible", Value::Null, Value::Null),
        BranchVerdict::SolverFailure(_) => ("solver_failure", Value::Null, Value::Null),
        _ => ("unproved", Value::Null, Value::Null),
    };
    let reasons: Vec<Value> =
        b.conflicts.iter().map(|c| json!({ "code": c.code(), "message": c.to_string() })).collect();
    json!({
        "branch": b.branch.to_string(), "verdict": verdict, "objective": value, "offsets": offsets,
        "cells": b.cells, "conflicts": reasons,
    })
}

fn solution_json(fields: &mut Map<String, Value>, found: &Found<'_>, s: &OffsetSolution) {
    let (r, edges) = (&s.recheck, found.problem.edge_lengths());
    let rows: Vec<Value> = s.map.a.row_iter().map(|row| row.iter().map(|x| number(*x)).collect()).collect();
    let pose = &found.problem.poses[r.worst_pose];
    let rotation: Vec<Value> =
        pose.rotation.matrix().row_iter().map(|row| row.iter().map(|x| number(*x)).collect()).collect();
    let history = s.history.iter().map(|h| {
        json!({
            "objective": number(h.value), "violation": number(h.violation), "radius": number(h.radius),
            "predicted": number(h.predicted), "actual": number(h.actual), "accepted": h.accepted,
        })
    });
    let value = json!({
        "objective": number(r.objective),
        "branch": s.branch.to_string(),
        "offsets": numbers(&s.offsets),
        "shifts": numbers(&s.shifts),
        "edge_lengths": numbers(&edges),
        "cyclic_order": found.problem.octahedral.order().map(|i| i.get() + 1),
        "det": number(r.det),
        "det_of_matrix": number(r.det_of_matrix),
        "A": rows,
        "c": numbers(s.map.c.as_slice()),
        "constraint_margins": {
            "base_spacing": number(r.margins.base_spacing),
            "platform_spacing": number(r.margins.platform_spacing),
            "abs_det": number(r.margins.det),
            "bounds": number(r.margins.bounds),
        },
        "worst_pose": { "index": r.worst_pose, "R": rotation, "p": numbers(pose.position.as_slice()) },
        "local_optimality": {
            "converged": s.evidence.converged,
            "stationarity": number(s.evidence.stationarity),
            "pattern_gain": number(s.evidence.pattern_gain),
            "pattern_trials": s.evidence.pattern_trials,
        },
        "history": history.collect::<Vec<_>>(),
    });
    if let Value::Object(map) = value {
        fields.extend(map);
    }
}

/// The document without its frame.
pub(super) fn json(
    found: &Found<'_>,
    optimised: Option<&Design>,
    written: Option<&str>,
) -> Map<String, Value> {
    let (p, n) = (found.problem, found.report.counts());
    let mut fields = Map::new();
    fields.insert("status".into(), json!(found.status()));
    if let Some(s) = found.report.solution() {
        solution_json(&mut fields, found, s);
    }
    fields.insert(
        "requirements".into(),
        json!({
            "min_joint_distance": number(p.min_joint_distance), "min_abs_det": number(p.min_abs_det),
            "characteristic_length": number(p.characteristic_length), "bounds": p.bounds.map(|b| [b.0, b.1]),
            "units": found.design.units,
        }),
    );
    fields.insert(
        "poses".into(),
        json!({
            "count": p.poses.len(),
            "home": if found.set.home_given { "design" } else { "default" },
            "home_position": numbers(found.set.home.position.as_slice()),
            "workspace": if found.set.workspace_given { "design" } else { "default" },
        }),
    );
    fields.insert("branch_counts".into(), json!({
        "total": found.report.branches.len(), "feasible": n.feasible, "infeasible_bounds": n.outside_bounds,
        "infeasible_spacing": n.spacing, "infeasible_det": n.det, "bounded": n.bounded, "unproved": n.unproved,
        "solver_failure": n.failed,
    }));
    let bound = found
        .report
        .bound
        .map(|b| json!({ "upper": number(b.upper), "gap": number(b.gap), "boxes": b.boxes }));
    fields.insert("global_bound".into(), json!(bound));
    fields.insert("tolerance".into(), number(found.report.tolerance));
    fields.insert("runners_up".into(), found.runners_up().map(branch_json).collect());
    fields.insert("branches".into(), found.report.branches.iter().map(branch_json).collect());
    fields.insert("seed".into(), json!(found.report.seed));
    let design = optimised.and_then(|d| serde_json::from_str::<Value>(&d.to_json()).ok());
    fields.insert("design".into(), design.unwrap_or(Value::Null));
    fields.insert("output".into(), json!(written));
    fields
}

/// For people.
pub(super) fn text(found: &Found<'_>, written: Option<&str>) -> String {
    let (p, n, units) = (found.problem, found.report.counts(), &found.design.units);
    let mut out = format!("{}: {}\n", found.design.name, found.status());
    // writing to a string cannot fail
    let _ = writeln!(
        out,
        "{} poses ({} workspace, {} home); joints at least {} {units} apart; |det A| >= {}; L = {} {units}",
        p.poses.len(),
        if found.set.workspace_given { "given" } else { "default" },
        if found.set.home_given { "given" } else { "default" },
        p.min_joint_distance,
        p.min_abs_det,
        p.characteristic_length
    );
    if let Some(s) = found.report.solution() {
        solution_text(&mut out, found, s);
    }
    match found.report.outcome {
        OffsetOutcome::LocalOptimum(_) => {
            let _ = writeln!(
                out,
                "no better offsets are near; that none are anywhere is not proved to within the gap of {} asked for",
                found.report.tolerance
            );
        }
        OffsetOutcome::NotConverged(_) => out.push_str("the limits are met; better offsets may be near\n"),
        _ => {}
    }
    if let Some(b) = found.report.bound {
        let _ = writeln!(
            out,
            "proved: no offsets within the limits reach more than {:.9} ({:.2e} above the solution; {} boxes)",
            b.upper, b.gap, b.boxes
        );
    }
    let _ = writeln!(
        out,
        "branches: {} feasible, {} outside the bounds, {} without room, {} with |det A| too small, {} covered by the bound, {} unproved, {} failed",
        n.feasible, n.outside_bounds, n.spacing, n.det, n.bounded, n.unproved, n.failed
    );
    for (code, (count, example)) in found.conflicts() {
        let _ = writeln!(out, "  {count:>3} {code}, for example: {example}");
    }
    for (i, b) in found.runners_up().enumerate() {
        if let BranchVerdict::Dominated { value, offsets, .. } = &b.verdict {
            let t: Vec<String> = offsets.iter().map(|t| format!("{t:8.4}")).collect();
            let _ = writeln!(out, "  runner-up {}  {}  {value:.6}  t = {}", i + 1, b.branch, t.join(" "));
        }
    }
    if let Some(path) = written {
        let _ = writeln!(out, "wrote {path}");
    }
    out
}

fn solution_text(out: &mut String, found: &Found<'_>, s: &OffsetSolution) {
    let (r, units) = (&s.recheck, &found.design.units);
    let _ = writeln!(out, "worst inverse condition number {:.9} at pose {}", r.objective, r.worst_pose + 1);
    let _ = writeln!(out, "det A = {:.9} (margin {:.3e})", r.det, r.margins.det);
    let _ = writeln!(
        out,
        "spacing margins: base {:.3e} {units}, platform {:.3e} {units}; bounds {:.3e}",
        r.margins.base_spacing, r.margins.platform_spacing, r.margins.bounds
    );
    let _ = writeln!(
        out,
        "local optimality: gain still promised {:.1e} a unit of offset, pattern search gained {:.1e} in {} trials",
        s.evidence.stationarity, s.evidence.pattern_gain, s.evidence.pattern_trials
    );
    let _ = writeln!(out, "  leg  slides    zone              t_i      Delta_i [{units}]");
    let order = found.problem.octahedral.order();
    let bodies = found.problem.sliding_bodies();
    for i in 0..6 {
        let _ = writeln!(
            out,
            "  {:>3}  {:<8}  {:<15}  {:>9.6}  {:>12.6}",
            order[i].get() + 1,
            bodies[i].to_string(),
            s.branch.0[i].words(),
            s.offsets[i],
            s.shifts[i]
        );
    }
}
