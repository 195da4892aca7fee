//! What `optimize` writes about offsets, for people.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::cli::requirements;
use crate::design::Design;
use crate::offsets::{OffsetProblem, OffsetSolution};
use crate::records::{BranchRecord, BranchWord, OffsetSolutionRecord, OffsetsAnswer, OffsetsStatus};

/// How many branches carry a first conflict of each kind, with one example.
fn conflicts(branches: &[BranchRecord]) -> BTreeMap<&str, (usize, &str)> {
    let mut groups = BTreeMap::new();
    let empty = branches.iter().filter(|b| b.verdict == BranchWord::Infeasible);
    for conflict in empty.filter_map(|b| b.conflicts.first()) {
        groups.entry(conflict.code.as_str()).or_insert_with(|| (0, conflict.message.as_str())).0 += 1;
    }
    groups
}

/// For people.
pub(super) fn text(
    design: &Design,
    a: &OffsetsAnswer,
    problem: &OffsetProblem,
    solution: Option<&OffsetSolution>,
) -> String {
    let (p, n, units) = (&a.requirements, &a.branch_counts, &design.units);
    let mut out = format!("{}: {}\n", design.name, a.status.as_str());
    // writing to a string cannot fail
    let _ = writeln!(
        out,
        "{} poses ({} workspace, {} home); joints at least {} {units} apart; |det A| >= {}; L = {} {units}",
        a.poses.count,
        a.poses.workspace.words(),
        a.poses.home.words(),
        p.min_joint_distance,
        p.min_abs_det,
        p.characteristic_length
    );
    if let (Some(found), Some(assessment)) = (&a.design, &a.assessment) {
        let _ = writeln!(out, "\n{}", requirements::lead(found.name(), Some(assessment)));
    }
    if let (Some(r), Some(s)) = (a.solution.as_option(), solution) {
        solution_text(&mut out, r, problem, s, units);
    }
    match a.status {
        OffsetsStatus::LocalOptimum => {
            let _ = writeln!(
                out,
                "no better offsets are near; that none are anywhere is not proved to within the gap of {} asked for",
                a.tolerance
            );
        }
        OffsetsStatus::Violated => {
            out.push_str("the platform misses requirements and is not called optimal\n");
        }
        OffsetsStatus::Feasible => out.push_str("the limits are met; better offsets may be near\n"),
        _ => {}
    }
    if let Some(b) = &a.global_bound {
        let _ = writeln!(
            out,
            "proved: no offsets within the limits reach more than {:.9} ({:.2e} above the solution; {} boxes)",
            b.upper.0, b.gap.0, b.boxes
        );
    }
    let _ = writeln!(
        out,
        "branches: {} feasible, {} outside the bounds, {} without room, {} with |det A| too small, {} covered by the bound, {} unproved, {} failed",
        n.feasible,
        n.infeasible_bounds,
        n.infeasible_spacing,
        n.infeasible_det,
        n.bounded,
        n.unproved,
        n.solver_failure
    );
    for (code, (count, example)) in conflicts(&a.branches) {
        let _ = writeln!(out, "  {count:>3} {code}, for example: {example}");
    }
    for (i, b) in a.runners_up.iter().enumerate() {
        if let (Some(value), Some(offsets)) = (b.objective, b.offsets) {
            let t: Vec<String> = offsets.iter().map(|t| format!("{:8.4}", t.0)).collect();
            let _ = writeln!(out, "  runner-up {}  {}  {:.6}  t = {}", i + 1, b.branch, value.0, t.join(" "));
        }
    }
    if let Some(path) = &a.output {
        let _ = writeln!(out, "wrote {path}");
    }
    out
}

fn solution_text(
    out: &mut String,
    r: &OffsetSolutionRecord,
    problem: &OffsetProblem,
    s: &OffsetSolution,
    units: &str,
) {
    let (margins, evidence) = (&r.constraint_margins, &r.local_optimality);
    let _ = writeln!(
        out,
        "worst inverse condition number {:.9} at pose {}",
        r.objective.0,
        r.worst_pose.index + 1
    );
    let _ = writeln!(out, "det A = {:.9} (margin {:.3e})", r.det.0, margins.abs_det.0);
    let _ = writeln!(
        out,
        "spacing margins: base {:.3e} {units}, platform {:.3e} {units}; bounds {:.3e}",
        margins.base_spacing.0, margins.platform_spacing.0, margins.bounds.0
    );
    let _ = writeln!(
        out,
        "local optimality: gain still promised {:.1e} a unit of offset, pattern search gained {:.1e} in {} trials",
        evidence.stationarity.0, evidence.pattern_gain.0, evidence.pattern_trials
    );
    let _ = writeln!(out, "  leg  slides    zone              t_i      Delta_i [{units}]");
    let bodies = problem.sliding_bodies();
    for i in 0..6 {
        let _ = writeln!(
            out,
            "  {:>3}  {:<8}  {:<15}  {:>9.6}  {:>12.6}",
            r.cyclic_order[i],
            bodies[i].to_string(),
            s.branch.0[i].words(),
            r.offsets[i].0,
            r.shifts[i].0
        );
    }
}
