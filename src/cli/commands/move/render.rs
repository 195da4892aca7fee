//! What moves came to, as JSON and as text.

use std::fmt::Write as _;

use nalgebra::Point3;
use serde_json::{Map, Value, json};

use super::Done;
use crate::cli::commands::map;
use crate::cli::output::{number, relation};
use crate::design::Design;
use crate::manipulator::Leg;
use crate::synthesis::Relation;
use crate::synthesis::relocate::{Chain, MovedLeg, Relocation, SingularParameters};

/// Moves of one run.
pub(super) struct Record<'a> {
    pub(super) design: &'a Design,
    pub(super) done: &'a [Done],
    pub(super) chain: &'a Chain,
    pub(super) wanted: usize,
    pub(super) together: bool,
}

pub(super) fn numbers(x: impl IntoIterator<Item = f64>) -> Value {
    x.into_iter().map(number).collect()
}

fn point(p: &Point3<f64>) -> Value {
    numbers(p.iter().copied())
}

pub(super) fn leg(l: &Leg) -> Value {
    json!({ "base": point(&l.base), "platform": point(&l.platform) })
}

/// The design as the document it would be as a file.
pub(super) fn design_value(d: &Design) -> Value {
    serde_json::from_str(&d.to_json()).unwrap_or(Value::Null)
}

fn singular(s: &SingularParameters) -> Value {
    match s {
        SingularParameters::Everywhere => json!("everywhere"),
        SingularParameters::At(list) => numbers(list.iter().copied()),
    }
}

impl Record<'_> {
    fn regular(&self) -> bool {
        self.done.iter().all(|s| s.relocation.is_regular())
    }

    /// That of the last step: the moves before it were regular. Moves that a leg does not follow at all are refused earlier.
    fn outcome(&self) -> Value {
        self.done.last().map_or(Value::Null, |s| relation(s.relocation.map.relation))
    }

    fn undecided(&self) -> bool {
        self.done.iter().any(|s| s.relocation.map.relation == Relation::Undecided)
    }

    pub(super) fn json(&self, built: Option<&Design>, written: Option<&str>) -> Map<String, Value> {
        let mut json = Map::new();
        json.insert("name".into(), json!(self.design.name));
        json.insert("outcome".into(), self.outcome());
        json.insert("mode".into(), json!(if self.together { "together" } else { "sequence" }));
        json.insert("steps".into(), self.done.iter().map(step).collect());
        json.insert("moves_left_out".into(), json!(self.wanted - self.made()));
        let exact = self.moved().all(|m| m.exact);
        json.insert("exact".into(), json!(exact));
        for (key, value) in crate::cli::output::fields(crate::records::MapRecord::from(&self.chain.direct)) {
            json.insert(key, value);
        }
        json.insert("composition_difference".into(), number(self.chain.disagreement));
        json.insert("design".into(), built.map_or(Value::Null, design_value));
        json.insert("output".into(), json!(written));
        json
    }

    fn moved(&self) -> impl Iterator<Item = &MovedLeg> {
        self.done.iter().flat_map(|s| &s.relocation.moved)
    }

    fn made(&self) -> usize {
        self.moved().count()
    }

    pub(super) fn text(&self, written: Option<&str>) -> String {
        let mut text = String::new();
        for (k, s) in self.done.iter().enumerate() {
            for (moved, (type_name, name)) in s.relocation.moved.iter().zip(&s.families) {
                if self.done.len() > 1 {
                    let _ = write!(text, "{}. ", k + 1);
                }
                describe(&mut text, moved, type_name, name.as_deref());
            }
            if s.relocation.moved.len() > 1 || !s.relocation.is_regular() {
                let _ = writeln!(text, "   det A = {}", s.relocation.map.determinant);
            }
        }
        if self.made() < self.wanted {
            let _ = writeln!(
                text,
                "this move is {}; {} further moves were not made",
                if self.undecided() { "not decided to be regular" } else { "singular" },
                self.wanted - self.made()
            );
        }
        if self.moved().any(|m| !m.exact) {
            text.push_str(
                "the new coordinates are rounded: the span condition holds to the residuals given\n",
            );
        }
        text.push('\n');
        text.push_str(&map::table(&self.chain.direct, &self.design.name, "legs moved"));
        if self.done.len() > 1 {
            let _ =
                writeln!(text, "composed from the steps, A and c differ by {:.1e}", self.chain.disagreement);
        }
        if let Some(path) = written {
            let _ = writeln!(text, "wrote {path}");
        } else if !self.regular() {
            text.push_str(if self.undecided() {
                "no design is written: the platform may be architecturally singular\n"
            } else {
                "no design is written: the platform is architecturally singular\n"
            });
        }
        text
    }
}

fn step(s: &Done) -> Value {
    let r: &Relocation = &s.relocation;
    let moves = r.moved.iter().zip(&s.families).map(|(m, (type_name, name))| {
        let k = m.request.leg.get();
        json!({
            "leg": k + 1, "component": m.request.family + 1, "type": type_name, "along": name,
            "parameters": numbers(m.request.parameters.iter().copied()), "from": leg(&m.from), "to": leg(&m.to),
            "coefficients": numbers(m.coefficients), "coefficient": number(m.coefficients[k]),
            "residual": number(m.residual), "exact": m.exact, "singular_parameters": singular(&m.singular),
        })
    });
    json!({ "outcome": relation(r.map.relation), "det": number(r.map.determinant), "moves": moves.collect::<Value>() })
}

fn describe(text: &mut String, m: &MovedLeg, type_name: &str, name: Option<&str>) {
    let k = m.request.leg.get();
    let parameters: Vec<String> = m.request.parameters.iter().map(f64::to_string).collect();
    let name = name.map_or(String::new(), |n| format!(" {n}"));
    let _ = writeln!(
        text,
        "{} along family {} ({type_name}{name}) to {}",
        m.request.leg,
        m.request.family + 1,
        parameters.join(", ")
    );
    let place = |l: &Leg| {
        let (a, b) = (l.base, l.platform);
        format!("[{}, {}, {}] - [{}, {}, {}]", a.x, a.y, a.z, b.x, b.y, b.z)
    };
    let _ = writeln!(text, "   from {}\n   to   {}", place(&m.from), place(&m.to));
    let singular = match &m.singular {
        SingularParameters::Everywhere => "det A = 0 all along the family".to_string(),
        SingularParameters::At(list) if list.is_empty() => "nowhere singular on the family".to_string(),
        SingularParameters::At(list) => {
            // nine decimals: the parameters are roots, their last digits are rounding
            let list: Vec<String> =
                list.iter().map(|t| ((t * 1e9).round() / 1e9 + 0.0).to_string()).collect();
            format!("singular at t = {}", list.join(", "))
        }
    };
    let _ = writeln!(
        text,
        "   coefficient of the old {} {}, residual {:.1e}; {singular}",
        m.request.leg, m.coefficients[k], m.residual
    );
}
