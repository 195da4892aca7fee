//! The result of a search.

use super::assess::{assumptions, requirements, sentence, verdict};
use super::document::words;
use crate::figure::figure;
use crate::{Cell, Sheet, Table, Tone, left, right};
use ask::OptimizeStatus;
use optimize::dimensional::ChosenVariable;
use optimize::offsets::Zone;
use records::{
    ConflictReasonRecord, ConflictRecord, DesignRecord, DriveSearchRecord, FoundPlatformRecord,
    FrontMemberRecord, MarginRecord, NearestPlatformRecord, Number, OptimalityWord, OptimizeAnswer,
    OptimumRecord, SearchesBesideRecord,
};
use synthesis::sliding_body;

/// The answer of `optimize` about a design of this name.
#[must_use]
pub fn optimize(name: &str, a: &OptimizeAnswer) -> Sheet {
    sheet_of(name, a, true)
}

/// The same answer for a report that shows the requirements of the platform elsewhere.
#[must_use]
pub fn search(name: &str, a: &OptimizeAnswer) -> Sheet {
    sheet_of(name, a, false)
}

fn sheet_of(name: &str, a: &OptimizeAnswer, with_requirements: bool) -> Sheet {
    let mut out = Sheet::new();
    say!(out, "{name}: {}", a.status.name().replace('_', " "));
    meaning(&mut out, a);
    if let Some(choice) = &a.choice {
        say!(out, "{choice}");
    }
    if let Some(list) = &a.front {
        front_in_words(&mut out, a, list.len());
    }
    out.add(symmetry_and_drives(&a.beside));
    if a.platform.objective.is_some() {
        let found = a.design.as_ref().map_or(name, DesignRecord::name);
        if with_requirements {
            out.add(match &a.output {
                Some(path) => {
                    verdict(found, a.platform.assessment.as_ref(), &format!("equipod assess {path}"))
                }
                None => requirements(found, a.platform.assessment.as_ref()),
            });
            out.space();
        }
        platform(&mut out, &a.platform, &a.limits.units);
    }
    if let Some(list) = &a.front {
        front(&mut out, list);
    }
    if let Some(c) = &a.conflict {
        conflict(&mut out, c);
    }
    for f in a.beside.freedoms.iter().flatten() {
        let written = f.output.as_ref().map_or_else(String::new, |path| format!(" ({path})"));
        say!(out, "{}{written}", f.message);
    }
    if let Some(n) = &a.nearest {
        nearest(&mut out, n);
    }
    if let Some(list) = &a.candidates {
        candidates(&mut out, list);
    }
    if let Some(r) = &a.platform.active_bounds {
        say!(out, "{}", r.message);
    }
    branches(&mut out, a);
    search_facts(&mut out, a);
    if let Some(path) = &a.output {
        say!(out, "wrote {path}");
    }
    out
}

/// The assumptions about poses, the further constraints, and the length of the search.
fn search_facts(out: &mut Sheet, a: &OptimizeAnswer) {
    let (l, units) = (&a.limits, &a.limits.units);
    let spacing = l
        .min_joint_distance
        .map_or_else(String::new, |d| format!("joint distance >= {} {units}; ", figure(d)));
    say!(
        out,
        "Search: {} workspace, {} home; {spacing}|det A| >= {}; characteristic length {} {units}.",
        a.region.workspace.words(),
        a.region.home.words(),
        figure(l.min_abs_det),
        figure(l.characteristic_length)
    );
    let r = &a.search;
    if let (Some(starts), Some(feasible)) = (r.starts, r.feasible) {
        say!(out, "{starts} starts, {feasible} of them feasible in the first pass.");
    }
    say!(out, "{} conic programs, solved by clarabel.", r.conic_programs);
}

fn front_in_words(out: &mut Sheet, a: &OptimizeAnswer, count: usize) {
    if a.status == OptimizeStatus::Interrupted {
        out.line(
            "The front is incomplete, because the search was interrupted; its platforms may still improve.",
        );
    }
    if let (Some(dominated), Some(unmet)) = (a.search.dominated, a.search.unmet) {
        say!(
            out,
            "{count} platforms, none better than another in every objective. Left out: {dominated} dominated or equal platforms, {unmet} bounds that no platform met."
        );
    }
}

/// The meaning of the status for this answer.
fn meaning(out: &mut Sheet, a: &OptimizeAnswer) {
    match (a.status, a.optimality) {
        (OptimizeStatus::Feasible, Some(OptimalityWord::BestOfStarts)) => {
            let gap = a.tolerance.map_or_else(String::new, |t| format!(" within the requested gap of {t}"));
            say!(out, "A local optimum{gap}; a better platform elsewhere is not excluded.");
        }
        (_, Some(OptimalityWord::BestOfStarts)) => {
            out.line("A local optimum, the best of all starts; a better platform elsewhere is not excluded.");
        }
        (OptimizeStatus::Violated, _) => {
            out.line("The platform violates requirements, so it is no optimum.");
        }
        (OptimizeStatus::Feasible, _) => out.line("The limits are met; better platforms may exist nearby."),
        (OptimizeStatus::Undecided, _) if a.platform.objective.is_none() && a.front.is_none() => {
            let reason = a.failure.as_ref().map_or_else(String::new, |w| format!(": {w}"));
            say!(
                out,
                "No platform that meets the requirements was found, and no conflict of requirements either{reason}."
            );
        }
        _ => {}
    }
    if let Some(b) = &a.global_bound {
        say!(
            out,
            "Proved: offsets within the limits reach at most {} ({} above the solution; {} boxes).",
            figure(b.upper),
            figure(b.gap),
            b.boxes
        );
    }
}

/// The outcomes of the branches, if the search has any.
fn branches(out: &mut Sheet, a: &OptimizeAnswer) {
    let Some(n) = &a.branch_counts else { return };
    say!(
        out,
        "Branches: {} feasible, {} outside the bounds, {} with joints too close, {} with |det A| too small, {} excluded by the upper bound, {} undecided, {} failed.",
        n.feasible,
        n.outside_bounds,
        n.spacing,
        n.det,
        n.bounded,
        n.unproved,
        n.failed
    );
    for r in ConflictReasonRecord::all(a.branches.as_deref().unwrap_or_default()) {
        say!(out, "  {:>3} {}, for example: {}", r.branches, words(&r.code), r.message);
    }
    for (i, b) in a.runners_up.iter().flatten().enumerate() {
        if let (Some(value), Some(offsets)) = (b.objective, b.offsets) {
            let t: Vec<String> = offsets.iter().map(|t| figure(t.0)).collect();
            say!(out, "  runner-up {}  {}  {}  t = {}", i + 1, b.branch, figure(value.0), t.join(", "));
        }
    }
}

/// The members of a front, one line each, followed by the requirements of each.
fn front(out: &mut Sheet, list: &[FrontMemberRecord]) {
    for (k, member) in list.iter().enumerate() {
        let s = &member.platform;
        let objectives = s.objectives.iter().flatten();
        let values = objectives.map(|o| format!("{} {} {}", words(o.name.code()), figure(o.value.0), o.unit));
        let met = match s.requirements_met {
            Some(true) => "",
            Some(false) => "  (violates requirements)",
            None => "  (not all requirements proved)",
        };
        let path = member.output.as_ref().map_or_else(String::new, |p| format!("  {p}"));
        say!(out, "  {:>3}  {}{met}{path}", k + 1, values.collect::<Vec<_>>().join("  "));
    }
    out.space();
    for (k, member) in list.iter().enumerate() {
        match (&member.platform.assessment, &member.output) {
            (Some(found), Some(path)) => say!(out, "{}. {}: equipod assess {path}", k + 1, sentence(found)),
            (Some(found), None) => say!(out, "{}. {}", k + 1, sentence(found)),
            (None, _) => {}
        }
    }
    // the assumptions are the same for all members
    if let Some(found) = list.first().and_then(|member| member.platform.assessment.as_ref()) {
        out.add(assumptions(found));
    }
}

/// The result for the symmetry of the design, and the drives of the table, one line each.
#[must_use]
pub fn symmetry_and_drives(beside: &SearchesBesideRecord) -> Sheet {
    let mut out = Sheet::new();
    if let Some(s) = &beside.symmetry {
        say!(out, "{}", s.message);
    }
    if let Some(d) = &beside.drive_search {
        out.space();
        tried_drives(&mut out, d);
    }
    out
}

fn tried_drives(out: &mut Sheet, d: &DriveSearchRecord) {
    let price = d.currency.as_ref().map_or("price".to_owned(), |c| format!("price {c}"));
    let columns = [left("drive", 5).gap(3), left("outcome", 11), right(price, 12), right("objective", 14)];
    let mut table = Table::new(columns.into_iter().chain([left("", 0).gap(2)]));
    for drive in &d.drives {
        let number = |x: Option<Number>| x.map_or_else(|| "-".to_owned(), |x| figure(x.0));
        let left = |m: &MarginRecord| format!("{}: {} {}", m.name.label(), figure(m.margin.0), m.unit);
        let margins = || drive.margins.iter().map(left).collect::<Vec<String>>().join("; ");
        table.row([
            drive.name.clone(),
            drive.outcome.name().to_owned(),
            number(drive.price),
            number(drive.objective),
            drive.reason.clone().unwrap_or_else(margins),
        ]);
    }
    say!(out, "{}:", d.message);
    out.table(table);
}

/// The platform with the least violation, with the table of its requirements.
fn nearest(out: &mut Sheet, n: &NearestPlatformRecord) {
    out.line(
        "\nThe platform with the least violation found; it is not a solution, but shows which requirements fail:",
    );
    out.add(requirements(n.design.name(), n.assessment.as_ref()));
    out.space();
    variables(out, &n.variables);
}

/// The other local optima, one line each.
fn candidates(out: &mut Sheet, list: &[OptimumRecord]) {
    if list.is_empty() {
        out.line("\nNo other local optimum that meets the requirements was found.");
        return;
    }
    out.line("\nOther local optima that meet the requirements at the poses of the search:");
    for c in list {
        let met = match c.requirements_met {
            Some(true) => "requirements met",
            Some(false) => "requirements violated between those poses",
            None => "requirements not all proved",
        };
        let values: Vec<String> =
            c.objectives.iter().map(|o| format!("{} {}", words(o.name.code()), figure(o.value.0))).collect();
        say!(out, "  {}: {}; {met}", c.output.as_deref().unwrap_or_default(), values.join(", "));
    }
}

/// The chosen variables with their values before and after.
fn variables(out: &mut Sheet, list: &[ChosenVariable]) {
    let columns = [left("", 20).gap(3), right("", 9), left("", 0).gap(2)];
    let rows = list.iter().map(|v| [v.name.clone(), figure(v.value), format!("from {}", figure(v.start))]);
    out.table(Table::new(columns).with_rows(rows));
}

fn platform(out: &mut Sheet, s: &FoundPlatformRecord, units: &str) {
    let held = s.poses.map_or(0, |p| p.held);
    for o in s.objectives.iter().flatten() {
        say!(
            out,
            "{}: {} {} ({} at the {held} poses of the search)",
            words(o.name.code()),
            figure(o.value.0),
            o.unit,
            figure(o.at_held_poses.0)
        );
    }
    if let (Some(det), Some(margin)) = (s.det, s.search_margins.and_then(|m| m.abs_det)) {
        say!(out, "det A = {} (margin {})", figure(det.0), figure(margin.0));
    }
    variables(out, s.variables.as_deref().unwrap_or_default());
    offsets(out, s, units);
    if let Some(e) = s.local_optimality {
        let pattern = e.pattern_gain.zip(e.pattern_trials).map_or_else(String::new, |(gain, trials)| {
            format!("; a pattern search of {trials} trials gained {}", figure(gain.0))
        });
        say!(
            out,
            "Converged: remaining first-order gain {} per unit of the variables{pattern}.",
            figure(e.stationarity.0)
        );
    }
    if let Some(v) = &s.verify {
        say!(
            out,
            "Compared with the design: {} (poses at {} samples differ by at most {}, relative).",
            v.verdict.name(),
            v.sample_count,
            figure(v.worst_distance.0)
        );
    }
    // requirements outside the assessment: the search alone demands the spacing that offsets need
    let listed = |m: &&MarginRecord| {
        !s.assessment.iter().flat_map(|a| &a.requirements).any(|known| known.name == m.name)
    };
    let mut table = Table::new([left("", 17).gap(3), right("", 14), left("", 8), left("", 0)]);
    for m in s.constraint_margins.iter().flatten().filter(listed) {
        let tone = if m.margin.0 >= 0.0 { Tone::Plain } else { Tone::No };
        let margin = Cell::toned(figure(m.margin.0), tone);
        table.row([m.name.label().into(), margin, m.unit.as_str().into(), m.between.join(", ").into()]);
    }
    out.table(table);
}

/// A line for each leg with a joint that slides on an edge.
fn offsets(out: &mut Sheet, s: &FoundPlatformRecord, units: &str) {
    let (Some(order), Some(offsets), Some(branch)) = (s.cyclic_order, s.offsets, &s.branch) else { return };
    let text = |title: &str, width| left(title, width).gap(2);
    let number = |title: &str, width| right(title, width).gap(2);
    let mut table = Table::new([
        number("leg", 3).gap(3),
        text("slides", 8),
        text("zone", 15),
        number("t_i", 9),
        number(&format!("Delta_i [{units}]"), 12),
    ]);
    for (i, zone) in branch.chars().enumerate().take(6) {
        table.row([
            order[i].to_string(),
            sliding_body(i).to_string(),
            Zone::of_symbol(zone).map_or("", Zone::words).to_owned(),
            figure(offsets[i].0),
            s.shifts.map_or_else(String::new, |d| figure(d[i].0)),
        ]);
    }
    out.table(table);
}

fn conflict(out: &mut Sheet, c: &ConflictRecord) {
    if c.requirements.is_empty() {
        out.line("Every branch of the offsets violates the limits: proved.");
        return;
    }
    out.line(if c.proved {
        "Within the bounds of the variables, these requirements cannot be met together (proved):"
    } else {
        "Within the bounds of the variables, no start met these requirements together:"
    });
    for g in &c.requirements {
        say!(out, "  {}", g.message);
    }
    out.line("The least total relaxation changes these requirements and meets all others:");
    let mut table = Table::new([left("", 17).gap(3), right("", 9), left("", 0)]);
    for g in c.requirements.iter().filter(|g| g.together.0 > 0.0) {
        table.row([g.name.label(), figure(g.together.0), g.unit.clone()]);
    }
    out.table(table);
}

#[cfg(test)]
mod tests {
    use super::*;
    use ask::OptimizeOptions;
    use ask::design::parse;
    use files::design::Format;
    use machine::requirements::{Objective, TermKind};
    use optimize::dimensional::{ConstraintConflict, Demand, Give};
    use records::OptimizeFiles;

    #[test]
    fn no_requirement_is_relaxed_by_zero() {
        let text = std::fs::read_to_string("../../../designs/worked/linuxcnc-octahedral.toml").unwrap();
        let (design, _) = parse(&text, Format::Toml).unwrap();
        let give = |kind, alone, together| Give { demand: Demand::Requirement(kind), alone, together };
        let demands = vec![
            give(TermKind::MinLegLength, Some(1.5647), 1.5647),
            give(TermKind::BaseSpacing, Some(3.25e-8), 0.0),
            give(TermKind::LegForce, Some(0.0), 4.5e-7),
            give(TermKind::LegSpeed, None, 0.0),
        ];
        let mut out = Sheet::new();
        conflict(&mut out, &ConflictRecord::new(&design, &ConstraintConflict { demands, proved: false }));
        let out = out.to_string();
        assert_eq!(
            out,
            r"Within the bounds of the variables, no start met these requirements together:
  leg length, minimum: relax it by 1.56 in
  distance of base joints: relax it by 3.25e-8 in
  leg force, maximum: relax it by less than the tolerance of the search
  leg speed, maximum: relaxing it alone does not resolve the conflict
The least total relaxation changes these requirements and meets all others:
  leg length, minimum      1.56 in
  leg force, maximum     4.5e-7 lbf
"
        );
        assert!(!out.contains("0.000000"));
    }

    #[test]
    fn an_interrupted_front_is_called_incomplete() {
        let file = std::fs::read_to_string("../../../designs/worked/isolator-octahedral.toml").unwrap();
        let (mut design, _) = parse(&file, Format::Toml).unwrap();
        design.search.mode = Some(files::design::Combination::Pareto { points: 2 });
        design.search.objectives = vec![(Objective::Stroke, 1.0), (Objective::WorstConditioning, 1.0)];
        let ended = OptimizeOptions::new().on_progress(|_| std::ops::ControlFlow::Break(()));
        let answer = OptimizeAnswer::new(&design.optimize_with(ended).unwrap(), &OptimizeFiles::default());
        assert_eq!(answer.status, OptimizeStatus::Interrupted);
        assert!(optimize(&design.name, &answer).to_string().contains("The front is incomplete"));
    }
}
