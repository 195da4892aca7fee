//! What moves came to, as JSON and as text.

use std::fmt::Write as _;

use super::Done;
use crate::cli::commands::equivalents::map;
use crate::design::Design;
use crate::manipulator::Leg;
use crate::records::{DesignRecord, LegMoveRecord, MoveMode, MoveStepRecord, MovesAnswer, Number};
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

impl Record<'_> {
    fn regular(&self) -> bool {
        self.done.iter().all(|s| s.relocation.is_regular())
    }

    fn undecided(&self) -> bool {
        self.done.iter().any(|s| s.relocation.map.relation == Relation::Undecided)
    }

    pub(super) fn record(&self, built: Option<&Design>, written: Option<&str>) -> MovesAnswer {
        MovesAnswer {
            name: self.design.name.clone(),
            // that of the last step: the moves before it were regular, and those that a leg does not follow at all are refused earlier
            outcome: self.done.last().and_then(|s| s.relocation.map.relation.decided()),
            mode: if self.together { MoveMode::Together } else { MoveMode::Sequence },
            steps: self.done.iter().map(step).collect(),
            moves_left_out: self.wanted - self.made(),
            exact: self.moved().all(|m| m.exact),
            map: (&self.chain.direct).into(),
            composition_difference: Number(self.chain.disagreement),
            design: built.map(DesignRecord::from),
            output: written.map(str::to_owned),
        }
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

fn step(s: &Done) -> MoveStepRecord {
    let r: &Relocation = &s.relocation;
    let one = |(m, (type_name, name)): (&MovedLeg, &(String, Option<String>))| LegMoveRecord {
        leg: m.request.leg.get() + 1,
        component: m.request.family + 1,
        type_name: type_name.clone(),
        along: name.clone(),
        parameters: m.request.parameters.iter().copied().map(Number).collect(),
        from: (&m.from).into(),
        to: (&m.to).into(),
        coefficients: m.coefficients.map(Number),
        coefficient: Number(m.coefficients[m.request.leg.get()]),
        residual: Number(m.residual),
        exact: m.exact,
        singular_parameters: (&m.singular).into(),
    };
    MoveStepRecord {
        outcome: r.map.relation.decided(),
        det: Number(r.map.determinant),
        moves: r.moved.iter().zip(&s.families).map(one).collect(),
    }
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
