//! What moves came to, as JSON and as text.

use std::fmt::Write as _;

use super::Done;
use crate::app::cli::commands::equivalents::map;
use ask::Design;
use records::{
    DesignRecord, LegEndsRecord, LegMoveRecord, MoveMode, MoveStepRecord, MovesAnswer, Number,
    SingularParametersRecord,
};
use synthesis::Relation;
use synthesis::relocate::{Chain, MovedLeg, Relocation};

/// Moves of one run.
pub(super) struct Record<'a> {
    pub(super) design: &'a Design,
    pub(super) done: &'a [Done],
    pub(super) chain: &'a Chain,
    pub(super) wanted: usize,
    pub(super) together: bool,
}

impl Record<'_> {
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
}

/// What the moves came to, in words.
pub(super) fn text(r: &MovesAnswer) -> String {
    let mut text = String::new();
    let regular = r.steps.iter().all(|s| s.outcome == Some(Relation::Equivalent));
    let undecided = r.steps.iter().any(|s| s.outcome.is_none());
    for (k, s) in r.steps.iter().enumerate() {
        for moved in &s.moves {
            if r.steps.len() > 1 {
                let _ = write!(text, "{}. ", k + 1);
            }
            describe(&mut text, moved);
        }
        if s.moves.len() > 1 || s.outcome != Some(Relation::Equivalent) {
            let _ = writeln!(text, "   det A = {}", s.det.0);
        }
    }
    if r.moves_left_out > 0 {
        let _ = writeln!(
            text,
            "this move is {}; {} further moves were not made",
            if undecided { "not decided to be regular" } else { "singular" },
            r.moves_left_out
        );
    }
    if !r.exact {
        text.push_str("the new coordinates are rounded: the span condition holds to the residuals given\n");
    }
    text.push('\n');
    text.push_str(&map::table(&r.map, &r.name, "legs moved"));
    if r.steps.len() > 1 {
        let difference = r.composition_difference.0;
        let _ = writeln!(text, "composed from the steps, A and c differ by {difference:.1e}");
    }
    if let Some(path) = &r.output {
        let _ = writeln!(text, "wrote {path}");
    } else if !regular {
        text.push_str(if undecided {
            "no design is written: the platform may be architecturally singular\n"
        } else {
            "no design is written: the platform is architecturally singular\n"
        });
    }
    text
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

fn describe(text: &mut String, m: &LegMoveRecord) {
    let parameters: Vec<String> = m.parameters.iter().map(|t| t.0.to_string()).collect();
    let name = m.along.as_ref().map_or(String::new(), |n| format!(" {n}"));
    let _ = writeln!(
        text,
        "leg {} along family {} ({}{name}) to {}",
        m.leg,
        m.component,
        m.type_name,
        parameters.join(", ")
    );
    let place = |l: &LegEndsRecord| {
        let (a, b) = (l.base.map(|x| x.0), l.platform.map(|x| x.0));
        format!("[{}, {}, {}] - [{}, {}, {}]", a[0], a[1], a[2], b[0], b[1], b[2])
    };
    let _ = writeln!(text, "   from {}\n   to   {}", place(&m.from), place(&m.to));
    let singular = match &m.singular_parameters {
        SingularParametersRecord::Everywhere(_) => "det A = 0 all along the family".to_string(),
        SingularParametersRecord::At(list) if list.is_empty() => "nowhere singular on the family".to_string(),
        SingularParametersRecord::At(list) => {
            // nine decimals: the parameters are roots, their last digits are rounding
            let list: Vec<String> =
                list.iter().map(|t| ((t.0 * 1e9).round() / 1e9 + 0.0).to_string()).collect();
            format!("singular at t = {}", list.join(", "))
        }
    };
    let _ = writeln!(
        text,
        "   coefficient of the old leg {} {}, residual {:.1e}; {singular}",
        m.leg, m.coefficient.0, m.residual.0
    );
}
