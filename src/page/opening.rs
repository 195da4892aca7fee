//! What there is to show of a design.

use serde_json::{Value, json};

use super::original::Original;
use super::session::{Equivalent, Session};
use super::wire::{number, numbers, pose};
use crate::singularity::Architecture;
use crate::synthesis::{
    Factor, Family, HexagonPoint, JointLabel, Pattern, corner, edge_lengths, sliding_body,
};

/// The design, the original's hexagon, and the patterns to choose from.
pub(super) fn record(session: &Session) -> Value {
    let design = &session.design;
    let architecture = Architecture::of(design.manipulator());
    let finding = architecture.findings.first();
    let (centre, radius) = session.reach();
    let kind = match &session.original {
        Some(o) if o.seen.is_none() => "octahedral",
        Some(_) => "equivalent",
        None => "general",
    };
    json!({
        "name": design.name, "units": design.units, "source": design.source, "description": design.description,
        "kind": kind, "size": number(design.manipulator().size()),
        "singular": architecture.is_singular(), "reason": finding.map(|f| f.case.sentence()),
        "home": pose(&session.home), "centre": numbers(centre.iter().copied()), "radius": number(radius),
        "trajectory": design.workspace.trajectory.is_some(), "workspace": !design.workspace.is_empty(),
        "lengths": session.first().lengths.map(|l| numbers(l.get())),
        "limits": {"spacing": number(session.limits.0), "det": number(session.limits.1)},
        "characteristic_length": number(session.characteristic_length),
        "hexagon": session.original.as_ref().map(hexagon),
        "patterns": session.start.as_ref().zip(session.original.as_ref()).map(|(s, o)| patterns(s, o)),
        "start": session.start.as_ref().map(|s| json!({"pattern": s.pattern.to_string(), "offsets": numbers(s.offsets.iter().copied())})),
    })
}

/// Legs (vertices) and what slides on the sides between them.
fn hexagon(o: &Original) -> Value {
    let lengths = edge_lengths(&o.octahedral);
    let vertices = (0..6).map(|k| {
        let leg = o.octahedral.order()[k];
        json!({"leg": leg.get() + 1, "joints": o.leg_names(HexagonPoint::Vertex(k))})
    });
    let sides = (0..6).map(|k| {
        let body = sliding_body(k);
        let fixed = body.other();
        let name = |i: usize| o.joint_name(JointLabel::Corner(i));
        json!({
            "body": body.to_string(), "fixed": name(corner(fixed, k)), "length": number(lengths[k]),
            "from": name(corner(body, k)), "to": name(corner(body, (k + 1) % 6)),
        })
    });
    json!({"vertices": vertices.collect::<Value>(), "sides": sides.collect::<Value>()})
}

/// One pattern of every topology, the platform without shared joints first, and the one the page starts with.
fn patterns(start: &Equivalent, o: &Original) -> Value {
    let mut list: Vec<Pattern> = vec![start.pattern.clone()];
    list.extend(Pattern::new([false; 6], [1; 6]));
    let mut others: Vec<Pattern> =
        Family::octahedral().topologies().iter().map(|t| t.example.clone()).collect();
    others.sort_by(|a, b| b.cmp(a));
    list.extend(others);
    let mut seen = Vec::new();
    list.retain(|p| {
        let new = !seen.contains(p) && !p.offsets().is_empty();
        seen.push(p.clone());
        new
    });
    list.iter().map(|p| pattern(p, o)).collect()
}

fn pattern(p: &Pattern, o: &Original) -> Value {
    let [base, platform] = p.joints();
    let legs = p.legs().into_iter().enumerate().map(|(k, point)| {
        let (side, offset) = match point {
            HexagonPoint::Vertex(_) => (None, None),
            HexagonPoint::Inner(t) => (Some(t.side), p.offsets().iter().position(|x| *x == t)),
        };
        json!({
            "leg": o.octahedral.order()[k].get() + 1, "joints": o.leg_names(point), "side": side, "offset": offset,
            "vertex": if let HexagonPoint::Vertex(v) = point { Some(v) } else { None },
        })
    });
    let shared: usize = p.shared_joints().len();
    json!({
        "id": p.to_string(), "base_joints": base.len(), "platform_joints": platform.len(), "shared_joints": shared,
        "offsets": p.offsets().iter().map(|t| json!({"name": t.to_string(), "side": t.side, "joint": o.joint_name(JointLabel::OnEdge(*t))})).collect::<Value>(),
        "legs": legs.collect::<Value>(),
        "det": p.determinant_formula(), "zero": p.factors().iter().map(|f| Factor::zero(*f)).collect::<Vec<_>>(),
    })
}
