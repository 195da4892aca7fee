//! The families of replaceable legs.

use super::moves::ends;
use crate::figure::figure;
use crate::{Sheet, Table, left, right};
use records::{ComponentRecord, ComponentsAnswer, ExactCurveOutcome, PlaneCurveRecord};

/// The answer of `equivalents components`.
#[must_use]
pub fn components(r: &ComponentsAnswer) -> Sheet {
    let mut out = Sheet::new();
    let families = if r.count == 1 { "1 family".to_owned() } else { format!("{} families", r.count) };
    match r.count {
        0 => {
            say!(
                out,
                "{}: no leg is replaceable, so no leg can move without changing the kinematics",
                r.name
            );
        }
        _ => say!(
            out,
            "{}: {families} of replaceable legs, which can move without changing the kinematics\n",
            r.name
        ),
    }
    out.table(table(&r.components));
    if r.leg_rank < 6 {
        let exact = r.leg_rank_decision.exact.map_or(String::new(), |e| format!(", exactly {e}"));
        say!(out, "\nThe leg vectors are dependent: rank {}{exact}.", r.leg_rank);
    }
    for planes in &r.planes {
        say!(out, "\nCurves of replaceable joints in the planes of legs {}", numbers(&planes.legs));
        curve(&mut out, "base", &planes.base);
        curve(&mut out, "platform", &planes.platform);
    }
    for family in r.components.iter().filter(|family| !family.samples.is_empty()) {
        say!(out, "\nSample legs of family {}", family.component);
        for s in &family.samples {
            say!(out, "  {}  residual {}", ends(&s.ends), figure(s.residual.0));
        }
    }
    for doubt in &r.doubts {
        say!(out, "\nThe list may be incomplete: {doubt}");
    }
    out
}

fn table(list: &[ComponentRecord]) -> Table {
    let mut table = Table::new([
        right("family", 6),
        left("type", 12).gap(2),
        left("base", 6),
        left("platform", 9),
        right("dimension", 3),
        left("legs", 12).gap(2),
        left("depends on legs", 12).gap(2),
        left("evidence", 10).gap(2),
        left("part of family", 0).gap(2),
    ]);
    for c in list {
        let holds = match c.exact {
            Some(true) => "exact",
            Some(false) => "tolerance",
            None => "numerical",
        };
        table.row([
            c.component.to_string(),
            c.type_name.clone(),
            c.base.clone(),
            c.platform.clone(),
            c.dimension.to_string(),
            numbers(&c.legs),
            numbers(&c.support),
            holds.to_owned(),
            numbers(&c.contained_in),
        ]);
    }
    table
}

fn numbers(list: &[usize]) -> String {
    list.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")
}

fn curve(out: &mut Sheet, body: &str, c: &PlaneCurveRecord) {
    let parts = c.parts.iter().map(|p| match p.multiplicity {
        0 | 1 => p.kind.name().to_owned(),
        times => format!("{} ({times} times)", p.kind.name()),
    });
    let what = if c.generic_rank < 3 {
        "every point of the plane carries a replaceable leg".to_owned()
    } else if c.degree == 0 {
        "no curve".to_owned()
    } else {
        format!("degree {}: {}", c.degree, parts.collect::<Vec<_>>().join(", "))
    };
    say!(out, "  {body:<9} {what}");
    match &c.exact {
        ExactCurveOutcome::Curve(e) if e.generic_rank == 3 && e.degree > 0 => {
            let parts: Vec<&str> = e.parts.iter().map(|p| p.kind.name()).collect();
            say!(out, "            as written, over the complex numbers: {}", parts.join(", "));
        }
        ExactCurveOutcome::Curve(_) => {}
        ExactCurveOutcome::None { reason } => say!(out, "            no exact factors: {reason}"),
    }
    for s in &c.singular_points {
        let at = s.point.map(|p| p.map(|x| x.0));
        let at = at.map_or("infinity".to_owned(), |at| {
            format!("({})", at.map(rounding_is_zero).map(figure).join(", "))
        });
        let line = if s.line_of_partners { ", paired with a whole line of the other body" } else { "" };
        say!(out, "            {} at {at}{line}", s.kind);
    }
}

/// A coordinate of a point in space; one that rounding has left of zero is zero.
fn rounding_is_zero(x: f64) -> f64 {
    if x.abs() < 1e-12 { 0.0 } else { x }
}
