//! What `optimize` writes about a dimensional problem, for people.

use std::fmt::Write as _;

use crate::cli::numbers::significant as short;
use crate::cli::requirements;
use crate::dimensional::DimensionalOutcome;
use crate::records::{
    ConflictRecord, DesignRecord, DimensionalAnswer, DimensionalSolutionRecord, DimensionalStatus,
    DriveSearchRecord, MarginRecord, NearestPlatformRecord, Number, OptimalityWord, OptimumRecord,
    VariableRecord,
};

/// For people.
pub(super) fn text(name: &str, a: &DimensionalAnswer, outcome: &DimensionalOutcome) -> String {
    let mut out = format!("{name}: {}\n", a.status.as_str());
    let r = &a.search;
    // writing to a string cannot fail
    let _ = writeln!(out, "{} starts, {} of them feasible in the first pass", r.starts, r.feasible);
    if let Some(s) = &a.symmetry {
        let _ = writeln!(out, "{}", s.message);
    }
    if let Some(d) = &a.drive_search {
        drives_text(&mut out, d);
    }
    if let Some(s) = a.solution.as_option() {
        let found = a.design.as_ref().map_or(name, DesignRecord::name);
        let _ = writeln!(out, "\n{}", requirements::lead(found, s.assessment.as_ref()));
        solution_text(&mut out, s);
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
    if a.optimality == Some(OptimalityWord::BestOfStarts) {
        out.push_str(
            "a local optimum, the best of all starts; that there is no better platform is not proved\n",
        );
    }
    if a.status == DimensionalStatus::Violated {
        out.push_str("the platform misses requirements and is not called optimal\n");
    }
    if let DimensionalOutcome::Undecided(why) = outcome {
        let reason = why.map_or_else(String::new, |w| format!(": {w}"));
        let _ = writeln!(out, "no platform that meets the requirements was found, and no conflict{reason}");
    }
    if let Some(path) = &a.output {
        let _ = writeln!(out, "wrote {path}");
    }
    out
}

/// A line for each drive of the table.
pub(in crate::cli::commands) fn drives_text(out: &mut String, d: &DriveSearchRecord) {
    let _ = writeln!(out, "\n{}:", d.message);
    let width = d.drives.iter().map(|d| d.name.chars().count()).fold(5, usize::max);
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

fn variables_text(out: &mut String, variables: &[VariableRecord]) {
    for v in variables {
        let _ = writeln!(out, "  {:<20} {:>12.6}", v.name, v.value.0);
    }
}

fn solution_text(out: &mut String, s: &DimensionalSolutionRecord) {
    for o in &s.objectives {
        let _ = writeln!(
            out,
            "{} {:.9} {} ({:.9} over the {} held poses)",
            o.name.code(),
            o.value.0,
            o.unit,
            o.at_held_poses.0,
            s.poses.held
        );
    }
    variables_text(out, &s.variables);
    let _ = writeln!(
        out,
        "gain still promised {:.1e} a unit of the variables",
        s.local_optimality.stationarity.0
    );
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
    for m in s.constraint_margins.iter().filter(listed) {
        let mark = if m.margin.0 >= 0.0 { ' ' } else { '!' };
        let of = m.between.join(", ");
        let _ = writeln!(out, "  {:<17}{mark}{:>14.6} {:<8} {of}", m.name.code(), m.margin.0, m.unit);
    }
}

pub(super) fn conflict_text(out: &mut String, c: &ConflictRecord) {
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
    use crate::design::{Format, parse};
    use crate::dimensional::{ConstraintConflict, Demand, Give};
    use crate::requirements::TermKind;

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
        insta::assert_snapshot!(out, @r"
        within the bounds of the variables these requirements could not, from any start, be met together:
          the least leg length would have to give by 1.564700 in
          the room between base joints would have to give by 3.250e-8 in
          the greatest leg force would have to give by no more than the spare of the search
          the greatest leg speed cannot make room alone, whatever it gives
        the sum of the violations, each in its scale, is least where these give, and the others hold:
          leg_too_short           1.564700 in
          leg_force               4.500e-7 force
        ");
        assert!(!out.contains("0.000000"));
    }
}
