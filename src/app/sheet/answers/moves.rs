//! The result of moving legs.

use super::assess;
use super::map::leg_map;
use crate::{Sheet, Table, left, right};
use ask::wishes_in_words;
use records::{
    AssessAnswer, CandidateRecord, LegEndsRecord, LegMoveRecord, MoveSearchAnswer, MovesAnswer,
    SingularParametersRecord,
};
use synthesis::Relation;

/// The answer of `equivalents move`.
#[must_use]
pub fn moves(r: &MovesAnswer) -> Sheet {
    let mut out = Sheet::new();
    let regular = r.steps.iter().all(|s| s.outcome == Some(Relation::Equivalent));
    let undecided = r.steps.iter().any(|s| s.outcome.is_none());
    for (k, s) in r.steps.iter().enumerate() {
        for moved in &s.moves {
            let number = if r.steps.len() > 1 { format!("{}. ", k + 1) } else { String::new() };
            describe(&mut out, &number, moved);
        }
        if s.moves.len() > 1 || s.outcome != Some(Relation::Equivalent) {
            say!(out, "   det A = {}", s.det.0);
        }
    }
    if r.moves_left_out > 0 {
        say!(
            out,
            "this move is {}; {} further moves were not made",
            if undecided { "not decided to be regular" } else { "singular" },
            r.moves_left_out
        );
    }
    if !r.exact {
        out.line("the new coordinates are rounded: the span condition holds to the residuals given");
    }
    out.space();
    out.add(leg_map(&r.map, &r.name, "legs moved"));
    if r.steps.len() > 1 {
        let difference = r.composition_difference.0;
        say!(out, "composed from the steps, A and c differ by {difference:.1e}");
    }
    if let Some(path) = &r.output {
        say!(out, "wrote {path}");
    } else if !regular {
        out.line(if undecided {
            "no design is written: the platform may be architecturally singular"
        } else {
            "no design is written: the platform is architecturally singular"
        });
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
    let place = |l: &LegEndsRecord| {
        let (a, b) = (l.base.map(|x| x.0), l.platform.map(|x| x.0));
        format!("[{}, {}, {}] - [{}, {}, {}]", a[0], a[1], a[2], b[0], b[1], b[2])
    };
    say!(out, "   from {}\n   to   {}", place(&m.from), place(&m.to));
    let singular = match &m.singular_parameters {
        SingularParametersRecord::Everywhere(_) => "det A = 0 all along the family".to_string(),
        SingularParametersRecord::At(list) if list.is_empty() => "nowhere singular on the family".to_string(),
        SingularParametersRecord::At(list) => {
            // nine decimals: the parameters are roots, so further digits are rounding
            let list: Vec<String> =
                list.iter().map(|t| ((t.0 * 1e9).round() / 1e9 + 0.0).to_string()).collect();
            format!("singular at t = {}", list.join(", "))
        }
    };
    say!(
        out,
        "   coefficient of the old leg {} {}, residual {:.1e}; {singular}",
        m.leg,
        m.coefficient.0,
        m.residual.0
    );
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
        if r.complete { "" } else { " (the list of replaceable legs is not proved complete)" }
    );
    for (k, c) in r.designs.iter().enumerate() {
        say!(
            out,
            "\n{}. {}, det A = {:.6}, sigma_min/sigma_max of A {:.3e}, shared joints {}",
            k + 1,
            fulfilled(c),
            c.map.determinant.0,
            c.map.inverse_condition.0,
            c.shared_joints
        );
        if let Some(found) = &c.assessment {
            out.table(assess::table(found));
        }
        let columns = [left("wish", 13).gap(4), right("value", 12), right("required", 12).gap(2)];
        let rows = c.margins.iter().map(|m| {
            let [value, required] = [m.value, m.required].map(|x| format!("{x:.6}"));
            [m.wish.name().to_string(), value, required, format!("{:.5}", m.slack)]
        });
        out.table(Table::new(columns.into_iter().chain([right("slack", 9).gap(2)])).with_rows(rows));
        for p in &c.moves {
            let (a, b) = (p.to.base.map(|x| x.0), p.to.platform.map(|x| x.0));
            say!(
                out,
                "   leg {}  {}  [{:.6}, {:.6}, {:.6}] - [{:.6}, {:.6}, {:.6}]",
                p.leg,
                p.from,
                a[0],
                a[1],
                a[2],
                b[0],
                b[1],
                b[2]
            );
        }
    }
    for path in &r.paths {
        say!(out, "wrote {path}");
    }
    out
}

/// The requested properties and requirements that a platform has and misses.
fn fulfilled(c: &CandidateRecord) -> String {
    let names = |a: &AssessAnswer| {
        let kinds = a.requirements.iter().filter(|m| m.met == a.met).map(|m| m.name.code());
        kinds.chain((a.regular.met == a.met).then_some("singularity")).collect::<Vec<_>>().join(", ")
    };
    wishes_in_words(c.wishes_fulfilled, c.assessment.as_ref().map(|a| (a.met, names(a))))
}
