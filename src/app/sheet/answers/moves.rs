//! The result of moving legs.

use super::map::leg_map;
use crate::figure::figure;
use crate::{Sheet, Table, left, right};
use ask::targets_in_words;
use records::{AssessAnswer, CandidateRecord, LegEndsRecord, LegMoveRecord, MoveSearchAnswer, MovesAnswer};
use synthesis::Relation;
use synthesis::relocate::SingularParameters;

/// The answer of `equivalents move`.
#[must_use]
pub fn moves(r: &MovesAnswer) -> Sheet {
    let mut out = Sheet::new();
    let regular = r.steps.iter().all(|s| s.outcome == Some(Relation::Equivalent));
    let undecided = r.steps.iter().any(|s| s.outcome.is_none());
    match (undecided, regular) {
        (true, _) => say!(out, "{}: undecided whether the moved legs make an equivalent platform", r.name),
        (false, true) => say!(out, "{}: the moved legs make an equivalent platform", r.name),
        (false, false) => say!(out, "{}: the moved legs make an architecturally singular platform", r.name),
    }
    if let Some(path) = &r.output {
        say!(out, "wrote {path}");
    } else if !regular {
        out.line("No design is written.");
    }
    out.space();
    for (k, s) in r.steps.iter().enumerate() {
        for moved in &s.moves {
            let number = if r.steps.len() > 1 { format!("{}. ", k + 1) } else { String::new() };
            describe(&mut out, &number, moved);
        }
        if s.moves.len() > 1 || s.outcome != Some(Relation::Equivalent) {
            say!(out, "   det A = {}", figure(s.det.0));
        }
    }
    if r.moves_left_out > 0 {
        say!(
            out,
            "{}; {} further moves were not made.",
            if undecided { "This move is not proved to be regular" } else { "This move is singular" },
            r.moves_left_out
        );
    }
    if !r.exact {
        out.line(
            "The new coordinates are rounded: the leg vectors lie in the span only to the residuals below.",
        );
    }
    out.space();
    out.add(leg_map(&r.map, &r.name, "legs moved"));
    if r.steps.len() > 1 {
        let difference = r.composition_difference.0;
        say!(out, "The composition of the steps differs from A and c by {}.", figure(difference));
    }
    out
}

fn describe(out: &mut Sheet, number: &str, m: &LegMoveRecord) {
    let name = m.along.as_ref().map_or(String::new(), |n| format!(" {n}"));
    say!(
        out,
        "{number}leg {} along family {} ({}{name}) to {}",
        m.leg,
        m.component,
        m.type_name,
        m.parameters_written.join(", ")
    );
    say!(out, "   from {}\n   to   {}", ends(&m.from), ends(&m.to));
    let singular = match &m.singular_parameters {
        SingularParameters::Everywhere => "det A = 0 on the whole family".to_string(),
        SingularParameters::At(list) if list.is_empty() => "no singular point on the family".to_string(),
        SingularParameters::At(list) => {
            let list: Vec<String> = list.iter().map(|t| figure(*t)).collect();
            format!("singular at t = {}", list.join(", "))
        }
    };
    say!(out, "   coefficient of leg {} before the move: {}; {singular}", m.leg, figure(m.coefficient.0));
}

/// The ends of a leg, each in the frame of its body.
pub(super) fn ends(leg: &LegEndsRecord) -> String {
    let [a, b] = [&leg.base, &leg.platform].map(|end| end.map(|x| figure(x.0)).join(", "));
    format!("base ({a}), platform ({b})")
}

/// The answer of `equivalents move --search`.
#[must_use]
pub fn move_search(r: &MoveSearchAnswer) -> Sheet {
    let mut out = Sheet::new();
    out.line(&r.explanation);
    say!(
        out,
        "{} patterns of six independent legs, {} searched; fewest shared joints {}{}",
        r.patterns,
        r.patterns_searched,
        r.least_shared_joints.map_or("unknown".to_string(), |n| n.to_string()),
        if r.complete { "" } else { " (the list of replaceable legs is not proved to be complete)" }
    );
    for (k, c) in r.designs.iter().enumerate() {
        say!(
            out,
            "\n{}. {}; det A = {}, conditioning of A {}, shared joints {}",
            k + 1,
            met_and_missed(c),
            figure(c.map.determinant.0),
            figure(c.map.inverse_condition.0),
            c.shared_joints
        );
        let columns = [left("target", 13).gap(4), right("value", 9), right("required", 9).gap(2)];
        let rows = c.margins.iter().map(|m| {
            let [value, required] = [m.value, m.required].map(figure);
            [m.target.name().to_string(), value, required, figure(m.slack)]
        });
        out.table(Table::new(columns.into_iter().chain([right("slack", 9).gap(2)])).with_rows(rows));
        for p in &c.moves {
            say!(out, "   leg {}  {}  {}", p.leg, p.from, ends(&p.to));
        }
    }
    for path in &r.paths {
        say!(out, "wrote {path}");
    }
    out
}

/// The targets and requirements that a platform meets and misses.
fn met_and_missed(c: &CandidateRecord) -> String {
    let names = |a: &AssessAnswer| {
        let met = a.met_at_assessed_poses();
        let kinds = a.requirements.iter().filter(|m| m.met == met).map(|m| m.name.label());
        kinds.chain((a.regular.met == met).then_some("no singular pose")).collect::<Vec<_>>().join("; ")
    };
    targets_in_words(c.targets_met, c.assessment.as_ref().map(|a| (a.met_at_assessed_poses(), names(a))))
}
