//! What `optimize` writes about a dimensional problem.

use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use super::dimensional::{Checked, Done};
use crate::cli::commands::assess;
use crate::cli::output::number;
use crate::cli::poses;
use crate::design::Design;
use crate::dimensional::{Conflict, Demand, DimensionalOutcome, DimensionalSolution, Give};
use crate::requirements::Objective;
use crate::requirements::TermKind;

fn numbers(values: &[f64]) -> Value {
    values.iter().map(|x| number(*x)).collect()
}

pub(super) fn unit(design: &Design, o: Objective) -> String {
    o.quantity().map_or_else(String::new, |q| design.unit_of(q))
}

/// A constraint in words, and the unit in which it gives.
fn words(design: &Design, d: Demand) -> (&'static str, String, String) {
    let unit = |q| design.unit_of(q);
    match d {
        Demand::Requirement(kind) => {
            let sentence = match kind {
                TermKind::LegTooShort => "the least leg length",
                TermKind::LegTooLong => "the greatest leg length",
                TermKind::BaseSwing => "the swing limit of the base joints",
                TermKind::PlatformSwing => "the swing limit of the platform joints",
                TermKind::LegClearance => "the clearance between legs",
                TermKind::KeepOut => "the clearance from the keep-outs",
                TermKind::LegForce => "the greatest leg force",
                TermKind::LegSpeed => "the greatest leg speed",
                TermKind::BaseSpacing => "the room between base joints",
                _ => "the room between platform joints",
            };
            (kind.code(), sentence.to_string(), unit(kind.quantity()))
        }
        Demand::Determinant => ("abs_det", "the least |det A|".to_string(), String::new()),
        Demand::Reach => ("reach", "the reach of sliding joints".to_string(), "reaches".to_string()),
        Demand::Level(o) => (o.code(), format!("the level of {}", o.code()), String::new()),
    }
}

/// A positive amount with at least four significant digits.
fn amount(x: f64) -> String {
    if x < 1e-3 { format!("{x:.3e}") } else { format!("{x:.6}") }
}

fn sentence(design: &Design, g: &Give) -> String {
    let (_, what, unit) = words(design, g.demand);
    match g.alone {
        Some(x) if x > 0.0 => {
            format!("{what} would have to give by {} {unit}", amount(x)).trim_end().to_string()
        }
        Some(_) => format!("{what} would have to give by no more than the spare of the search"),
        None => format!("{what} cannot make room alone, whatever it gives"),
    }
}

pub(super) fn conflict_json(design: &Design, c: &Conflict) -> Value {
    let give = |g: &Give| {
        let (code, _, unit) = words(design, g.demand);
        json!({
            "requirement": code, "unit": unit, "alone": g.alone.map(number), "together": number(g.together),
            "message": sentence(design, g),
        })
    };
    json!({ "proved": c.proved, "requirements": c.demands.iter().map(give).collect::<Vec<_>>() })
}

pub(super) fn solution_json(
    fields: &mut Map<String, Value>,
    design: &Design,
    s: &DimensionalSolution,
    c: &Checked,
) {
    let objective = |((o, held), (_, dense)): (&(Objective, f64), &(Objective, f64))| {
        json!({
            "name": o.code(), "value": number(*dense), "at_held_poses": number(*held), "unit": unit(design, *o),
        })
    };
    let objectives: Vec<Value> = s.objectives.iter().zip(&c.objectives).map(objective).collect();
    fields.insert("objective".into(), number(c.objectives[0].1));
    fields.insert("objectives".into(), json!(objectives));
    let variables: Vec<Value> =
        s.variables.iter().map(|(name, x)| json!({ "name": name, "value": number(*x) })).collect();
    fields.insert("variables".into(), json!(variables));
    fields.insert("offsets".into(), s.offsets.map_or(Value::Null, |t| numbers(&t)));
    fields.insert("home".into(), poses::record(&s.home));
    let axes = |body: usize| s.axes[body].map(|list| list.map(|a| [number(a.x), number(a.y), number(a.z)]));
    fields.insert("joint_axes".into(), json!({ "base": axes(0), "platform": axes(1) }));
    fields.insert("constraint_margins".into(), assess::margins(&c.design, &c.assessment));
    fields.insert("requirements_met".into(), json!(c.assessment.all_met()));
    fields.insert(
        "verify".into(),
        json!(c.verification.as_ref().map(|v| json!({
            "verdict": v.verdict.as_str(), "worst_distance": number(v.worst_distance()), "samples": v.samples.len(),
        }))),
    );
    let step = |h: &crate::dimensional::HistoryStep| {
        json!({
            "objective": number(h.gain), "violation": number(h.violation), "radius": number(h.radius),
            "poses": h.poses, "accepted": h.accepted,
        })
    };
    fields.insert("history".into(), s.history.iter().map(step).collect());
    fields.insert("local_optimality".into(), json!({ "stationarity": number(s.stationarity) }));
    fields.insert("poses".into(), json!({ "held": s.poses.len(), "checked": c.assessment.poses }));
}

/// The document without its frame.
pub(super) fn record(design: &Design, done: &Done, written: Option<&str>) -> Map<String, Value> {
    let mut fields = Map::new();
    fields.insert("status".into(), json!(done.status()));
    if let (Some(s), Some(c)) = (done.report.solution(), &done.checked) {
        solution_json(&mut fields, design, s, c);
    }
    if let DimensionalOutcome::Infeasible(c) = &done.report.outcome {
        fields.insert("conflict".into(), conflict_json(design, c));
    }
    fields.insert(
        "search".into(),
        json!({
            "starts": done.report.starts, "feasible": done.report.feasible,
            "polished": done.report.polished.iter().map(|g| g.map(number)).collect::<Vec<_>>(),
        }),
    );
    fields.insert("seed".into(), json!(done.report.seed));
    let own = done.checked.as_ref().and_then(|c| serde_json::from_str::<Value>(&c.design.to_json()).ok());
    fields.insert("design".into(), own.unwrap_or(Value::Null));
    fields.insert("output".into(), json!(written));
    fields
}

/// For people.
pub(super) fn text(design: &Design, done: &Done, written: Option<&str>) -> String {
    let mut out = format!("{}: {}\n", design.name, done.status());
    let r = &done.report;
    // writing to a string cannot fail
    let _ = writeln!(out, "{} starts, {} of them feasible in the first pass", r.starts, r.feasible);
    if let (Some(s), Some(c)) = (r.solution(), &done.checked) {
        solution_text(&mut out, design, s, c);
    }
    match &r.outcome {
        DimensionalOutcome::Infeasible(c) => conflict_text(&mut out, design, c),
        DimensionalOutcome::Undecided(why) => {
            let reason = why.map_or_else(String::new, |w| format!(": {w}"));
            let _ =
                writeln!(out, "no platform that meets the requirements was found, and no conflict{reason}");
        }
        _ => {}
    }
    if let Some(path) = written {
        let _ = writeln!(out, "wrote {path}");
    }
    out
}

fn solution_text(out: &mut String, design: &Design, s: &DimensionalSolution, c: &Checked) {
    for ((o, held), (_, dense)) in s.objectives.iter().zip(&c.objectives) {
        let unit = unit(design, *o);
        let _ =
            writeln!(out, "{} {dense:.9} {unit} ({held:.9} over the {} held poses)", o.code(), s.poses.len());
    }
    for (name, x) in &s.variables {
        let _ = writeln!(out, "  {name:<20} {x:>12.6}");
    }
    let _ = writeln!(out, "gain still promised {:.1e} a unit of the variables", s.stationarity);
    if let Some(v) = &c.verification {
        let _ = writeln!(
            out,
            "{} to the design (poses of {} samples differ by at most {:.1e})",
            v.verdict.as_str(),
            v.samples.len(),
            v.worst_distance()
        );
    }
    let _ = writeln!(out, "margins over {} poses, by other code:", c.assessment.poses);
    for m in &c.assessment.margins {
        let mark = if m.value >= 0.0 { ' ' } else { '!' };
        let (of, unit) = (c.design.names_of(m.term).join(", "), design.unit_of(m.term.kind.quantity()));
        let _ = writeln!(out, "  {:<17}{mark}{:>14.6} {unit:<8} {of}", m.term.kind.code(), m.value);
    }
}

pub(super) fn conflict_text(out: &mut String, design: &Design, c: &Conflict) {
    let how = if c.proved { "cannot" } else { "could not, from any start," };
    let _ = writeln!(out, "within the bounds of the variables these requirements {how} be met together:");
    for g in &c.demands {
        let _ = writeln!(out, "  {}", sentence(design, g));
    }
    let _ = writeln!(
        out,
        "the sum of the violations, each in its scale, is least where these give, and the others hold:"
    );
    for g in c.demands.iter().filter(|g| g.together > 0.0) {
        let (code, _, unit) = words(design, g.demand);
        let _ = writeln!(out, "  {code:<17} {:>14} {unit}", amount(g.together));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{Format, parse};

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
        conflict_text(&mut out, &design, &Conflict { demands, proved: false });
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
