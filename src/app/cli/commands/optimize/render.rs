//! What `optimize` writes, for people: one text for every answer.

use std::fmt::Write as _;

use crate::app::cli::numbers::{significant as short, width_of};
use crate::app::cli::requirements;
use ask::OptimizeStatus;
use optimize::dimensional::ChosenVariable;
use optimize::offsets::Zone;
use records::{
    ConflictReasonRecord, ConflictRecord, DesignRecord, DriveSearchRecord, FoundPlatformRecord,
    FrontMemberRecord, MarginRecord, NearestPlatformRecord, Number, OptimalityWord, OptimizeAnswer,
    OptimumRecord,
};
use synthesis::sliding_body;

/// For people. Writing to a string cannot fail, so the results of `write!` are dropped.
pub(super) fn text(name: &str, a: &OptimizeAnswer) -> String {
    let mut out = format!("{name}: {}\n", a.status.name().replace('_', " "));
    if let Some(choice) = &a.choice {
        let _ = writeln!(out, "{choice}");
    }
    search_text(&mut out, a);
    if let Some(s) = &a.symmetry {
        let _ = writeln!(out, "{}", s.message);
    }
    if let Some(d) = &a.drive_search {
        drives_text(&mut out, d);
    }
    if a.platform.objective.is_some() {
        let found = a.design.as_ref().map_or(name, DesignRecord::name);
        let _ = writeln!(out, "\n{}", requirements::lead(found, a.platform.assessment.as_ref()));
        platform_text(&mut out, &a.platform, &a.limits.units);
    }
    if let Some(list) = &a.front {
        front_text(&mut out, list);
    }
    if let Some(c) = &a.conflict {
        conflict_text(&mut out, c);
    }
    for f in a.freedoms.iter().flatten() {
        let written = f.output.as_ref().map_or_else(String::new, |path| format!(" ({path})"));
        let _ = writeln!(out, "{}{written}", f.message);
    }
    if let Some(n) = &a.nearest {
        nearest_text(&mut out, n);
    }
    if let Some(list) = &a.candidates {
        candidates_text(&mut out, list);
    }
    if let Some(r) = &a.platform.riding {
        let _ = writeln!(out, "{}", r.message);
    }
    meaning_text(&mut out, a);
    branches_text(&mut out, a);
    if let Some(path) = &a.output {
        let _ = writeln!(out, "wrote {path}");
    }
    out
}

/// What was asked, and how the search went.
fn search_text(out: &mut String, a: &OptimizeAnswer) {
    let (l, units) = (&a.limits, &a.limits.units);
    let room =
        l.min_joint_distance.map_or_else(String::new, |d| format!("joints at least {d} {units} apart; "));
    let _ = writeln!(
        out,
        "{} workspace, {} home; {room}|det A| >= {}; L = {} {units}",
        a.region.workspace.words(),
        a.region.home.words(),
        l.min_abs_det,
        l.characteristic_length
    );
    let r = &a.search;
    if let (Some(starts), Some(feasible)) = (r.starts, r.feasible) {
        let _ = writeln!(out, "{starts} starts, {feasible} of them feasible in the first pass");
    }
    if let (Some(list), Some(dominated), Some(unmet)) = (&a.front, r.dominated, r.unmet) {
        if a.status == OptimizeStatus::Interrupted {
            out.push_str("the front as far as it was found; runs that were not finished may be improved\n");
        }
        let _ = writeln!(
            out,
            "{} platforms of which none is better in every objective; {dominated} dominated or equal ones left out, {unmet} bounds not met",
            list.len()
        );
    }
}

/// What the word of the status means here.
fn meaning_text(out: &mut String, a: &OptimizeAnswer) {
    match (a.status, a.optimality) {
        (OptimizeStatus::Feasible, Some(OptimalityWord::BestOfStarts)) => {
            let gap =
                a.tolerance.map_or_else(String::new, |t| format!(" to within the gap of {t} asked for"));
            let _ =
                writeln!(out, "no better platform is near; that there is none anywhere is not proved{gap}");
        }
        (_, Some(OptimalityWord::BestOfStarts)) => out.push_str(
            "a local optimum, the best of all starts; that there is no better platform is not proved\n",
        ),
        (OptimizeStatus::Violated, _) => {
            out.push_str("the platform misses requirements and is not called optimal\n");
        }
        (OptimizeStatus::Feasible, _) => out.push_str("the limits are met; better platforms may be near\n"),
        (OptimizeStatus::Undecided, _) if a.platform.objective.is_none() && a.front.is_none() => {
            let reason = a.failure.as_ref().map_or_else(String::new, |w| format!(": {w}"));
            let _ =
                writeln!(out, "no platform that meets the requirements was found, and no conflict{reason}");
        }
        _ => {}
    }
    if let Some(b) = &a.global_bound {
        let _ = writeln!(
            out,
            "proved: no offsets within the limits reach more than {:.9} ({:.2e} above the solution; {} boxes)",
            b.upper, b.gap, b.boxes
        );
    }
}

/// What became of the branches, where the search has some.
fn branches_text(out: &mut String, a: &OptimizeAnswer) {
    let Some(n) = &a.branch_counts else { return };
    let _ = writeln!(
        out,
        "branches: {} feasible, {} outside the bounds, {} without room, {} with |det A| too small, {} covered by the bound, {} unproved, {} failed",
        n.feasible, n.outside_bounds, n.spacing, n.det, n.bounded, n.unproved, n.failed
    );
    for r in ConflictReasonRecord::all(a.branches.as_deref().unwrap_or_default()) {
        let _ = writeln!(out, "  {:>3} {}, for example: {}", r.branches, r.code, r.message);
    }
    for (i, b) in a.runners_up.iter().flatten().enumerate() {
        if let (Some(value), Some(offsets)) = (b.objective, b.offsets) {
            let t: Vec<String> = offsets.iter().map(|t| format!("{:8.4}", t.0)).collect();
            let _ = writeln!(out, "  runner-up {}  {}  {:.6}  t = {}", i + 1, b.branch, value.0, t.join(" "));
        }
    }
}

/// The members of a front: a line for each, and then the requirements of each.
fn front_text(out: &mut String, list: &[FrontMemberRecord]) {
    for (k, member) in list.iter().enumerate() {
        let s = &member.platform;
        let objectives = s.objectives.iter().flatten();
        let values = objectives.map(|o| format!("{} {:.6} {}", o.name.code(), o.value.0, o.unit));
        let met = match s.requirements_met {
            Some(true) => "",
            Some(false) => "  (violates requirements)",
            None => "  (not all requirements proved)",
        };
        let path = member.output.as_ref().map_or_else(String::new, |p| format!("  {p}"));
        let _ = writeln!(out, "  {:>3}  {}{met}{path}", k + 1, values.collect::<Vec<_>>().join("  "));
    }
    for (k, member) in list.iter().enumerate() {
        let found = member.platform.assessment.as_ref();
        let name = member.design.name();
        let lead = found.map_or_else(
            || requirements::lead(name, None),
            |found| requirements::without_assumptions(name, found),
        );
        let _ = writeln!(out, "\n{}. {lead}", k + 1);
    }
    // one file says what is assumed of all members
    if let Some(found) = list.first().and_then(|member| member.platform.assessment.as_ref()) {
        out.push_str(&requirements::assumptions(found));
    }
}

/// A line for each drive of the table.
pub(in crate::app::cli::commands) fn drives_text(out: &mut String, d: &DriveSearchRecord) {
    let _ = writeln!(out, "\n{}:", d.message);
    let width = width_of(d.drives.iter().map(|d| d.name.as_str()));
    let price = d.currency.as_ref().map_or("price".to_owned(), |c| format!("price {c}"));
    let _ = writeln!(out, "  {:<width$} {:<11} {price:>12} {:>14}", "drive", "outcome", "objective");
    for drive in &d.drives {
        let number = |x: Option<Number>| x.map_or_else(|| "-".to_owned(), |x| short(x.0));
        let (price, objective) = (number(drive.price), number(drive.objective));
        let _ = write!(
            out,
            "  {:<width$} {:<11} {price:>12} {objective:>14}",
            drive.name,
            drive.outcome.as_str()
        );
        let left = |m: &MarginRecord| format!("{} {} {}", m.name.code(), short(m.margin.0), m.unit);
        let margins = || drive.margins.iter().map(left).collect::<Vec<String>>().join(", ");
        let _ = writeln!(out, "  {}", drive.reason.clone().unwrap_or_else(margins));
    }
}

/// What comes nearest misses something: the table of its requirements says what.
fn nearest_text(out: &mut String, n: &NearestPlatformRecord) {
    let _ = writeln!(
        out,
        "\nthe platform with the least violation that was found; it is no answer, and shows what is missed:"
    );
    let _ = writeln!(out, "{}", requirements::lead(n.design.name(), n.assessment.as_ref()));
    variables_text(out, &n.variables);
}

/// A line for each local optimum beside the answer.
fn candidates_text(out: &mut String, list: &[OptimumRecord]) {
    if list.is_empty() {
        out.push_str("\nno other local optimum that meets the requirements was found\n");
        return;
    }
    out.push_str("\nother local optima that meet the requirements at the poses that were held:\n");
    for c in list {
        let met = match c.requirements_met {
            Some(true) => "requirements met",
            Some(false) => "requirements missed between those poses",
            None => "requirements not all proved",
        };
        let values: Vec<String> =
            c.objectives.iter().map(|o| format!("{} {:.6}", o.name.code(), o.value.0)).collect();
        let _ = writeln!(out, "  {}: {}; {met}", c.output.as_deref().unwrap_or_default(), values.join(", "));
    }
}

/// What was chosen: from what, to what.
fn variables_text(out: &mut String, variables: &[ChosenVariable]) {
    for v in variables {
        let _ = writeln!(out, "  {:<20} {:>12.6}  from {:.6}", v.name, v.value, v.start);
    }
}

fn platform_text(out: &mut String, s: &FoundPlatformRecord, units: &str) {
    let held = s.poses.map_or(0, |p| p.held);
    for o in s.objectives.iter().flatten() {
        let _ = writeln!(
            out,
            "{} {:.9} {} ({:.9} over the {held} held poses)",
            o.name.code(),
            o.value.0,
            o.unit,
            o.at_held_poses.0
        );
    }
    if let Some(worst) = &s.worst_pose {
        let _ = writeln!(out, "worst at held pose {}", worst.index + 1);
    }
    if let (Some(det), Some(margin)) = (s.det, s.search_margins.and_then(|m| m.abs_det)) {
        let _ = writeln!(out, "det A = {:.9} (margin {:.3e})", det.0, margin.0);
    }
    variables_text(out, s.variables.as_deref().unwrap_or_default());
    offsets_text(out, s, units);
    if let Some(e) = s.local_optimality {
        let pattern = e.pattern_gain.zip(e.pattern_trials).map_or_else(String::new, |(gain, trials)| {
            format!(", pattern search gained {:.1e} in {trials} trials", gain.0)
        });
        let _ =
            writeln!(out, "gain still promised {:.1e} a unit of the variables{pattern}", e.stationarity.0);
    }
    if let Some(v) = &s.verify {
        let _ = writeln!(
            out,
            "{} to the design (poses of {} samples differ by at most {:.1e})",
            v.verdict.as_str(),
            v.sample_count,
            v.worst_distance.0
        );
    }
    // the room that offsets need where the design says nothing is required of the search alone
    let listed = |m: &&MarginRecord| {
        !s.assessment.iter().flat_map(|a| &a.requirements).any(|known| known.name == m.name)
    };
    for m in s.constraint_margins.iter().flatten().filter(listed) {
        let mark = if m.margin.0 >= 0.0 { ' ' } else { '!' };
        let of = m.between.join(", ");
        let _ = writeln!(out, "  {:<17}{mark}{:>14.6} {:<8} {of}", m.name.code(), m.margin.0, m.unit);
    }
}

/// A line for each leg whose joint slides on an edge.
fn offsets_text(out: &mut String, s: &FoundPlatformRecord, units: &str) {
    let (Some(order), Some(offsets), Some(branch)) = (s.cyclic_order, s.offsets, &s.branch) else { return };
    let _ = writeln!(out, "  leg  slides    zone              t_i      Delta_i [{units}]");
    for (i, zone) in branch.chars().enumerate().take(6) {
        let shift = s.shifts.map_or_else(String::new, |d| format!("{:>12.6}", d[i].0));
        let line = format!(
            "  {:>3}  {:<8}  {:<15}  {:>9.6}  {shift}",
            order[i],
            sliding_body(i).to_string(),
            Zone::of_symbol(zone).map_or("", Zone::words),
            offsets[i].0
        );
        let _ = writeln!(out, "{}", line.trim_end());
    }
}

fn conflict_text(out: &mut String, c: &ConflictRecord) {
    if c.requirements.is_empty() {
        out.push_str("every branch of the offsets is proved to violate the limits\n");
        return;
    }
    let how = if c.proved { "cannot" } else { "could not, from any start," };
    let _ = writeln!(out, "within the bounds of the variables these requirements {how} be met together:");
    for g in &c.requirements {
        let _ = writeln!(out, "  {}", g.message);
    }
    let _ = writeln!(
        out,
        "the sum of the violations, each in its scale, is least where these give, and the others hold:"
    );
    for g in c.requirements.iter().filter(|g| g.together.0 > 0.0) {
        let _ = writeln!(out, "  {:<17} {:>14} {}", g.name.code(), g.amount(), g.unit);
    }
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
    fn nobody_has_to_give_by_zero() {
        let text = std::fs::read_to_string("designs/worked/linuxcnc-octahedral.toml").unwrap();
        let (design, _) = parse(&text, Format::Toml).unwrap();
        let give = |kind, alone, together| Give { demand: Demand::Requirement(kind), alone, together };
        let demands = vec![
            give(TermKind::LegTooShort, Some(1.5647), 1.5647),
            give(TermKind::BaseSpacing, Some(3.25e-8), 0.0),
            give(TermKind::LegForce, Some(0.0), 4.5e-7),
            give(TermKind::LegSpeed, None, 0.0),
        ];
        let mut out = String::new();
        conflict_text(
            &mut out,
            &ConflictRecord::new(&design, &ConstraintConflict { demands, proved: false }),
        );
        assert_eq!(
            out,
            r"within the bounds of the variables these requirements could not, from any start, be met together:
  the least leg length would have to give by 1.564700 in
  the room between base joints would have to give by 3.250e-8 in
  the greatest leg force would have to give by no more than the spare of the search
  the greatest leg speed cannot make room alone, whatever it gives
the sum of the violations, each in its scale, is least where these give, and the others hold:
  leg_too_short           1.564700 in
  leg_force               4.500e-7 force
"
        );
        assert!(!out.contains("0.000000"));
    }

    #[test]
    fn an_interrupted_front_is_said_to_be_so_far() {
        let file = std::fs::read_to_string("designs/worked/isolator-octahedral.toml").unwrap();
        let (mut design, _) = parse(&file, Format::Toml).unwrap();
        design.search.mode = Some(files::design::Combination::Pareto { points: 2 });
        design.search.objectives = vec![(Objective::Stroke, 1.0), (Objective::WorstConditioning, 1.0)];
        let ended = OptimizeOptions::new().on_progress(|_| std::ops::ControlFlow::Break(()));
        let answer = OptimizeAnswer::new(&design.optimize_with(ended).unwrap(), &OptimizeFiles::default());
        assert_eq!(answer.status, OptimizeStatus::Interrupted);
        assert!(text(&design.name, &answer).contains("as far as it was found"));
    }
}
