//! The result of moves, as JSON and as text.

use super::MovedAtOnce;
use ask::Design;
use records::{DesignRecord, LegMoveRecord, MoveMode, MoveStepRecord, MovesAnswer, Number};
use synthesis::relocate::{Chain, MovedLeg, Relocation};

/// Moves of one run.
pub(super) struct Record<'a> {
    pub(super) design: &'a Design,
    pub(super) done: &'a [MovedAtOnce],
    pub(super) chain: &'a Chain,
    pub(super) wanted: usize,
    pub(super) together: bool,
}

impl Record<'_> {
    pub(super) fn record(&self, built: Option<&Design>, written: Option<&str>) -> MovesAnswer {
        MovesAnswer {
            name: self.design.name.clone(),
            // the outcome of the last step: all moves before it are regular, and impossible moves are refused earlier
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

fn step(s: &MovedAtOnce) -> MoveStepRecord {
    let r: &Relocation = &s.relocation;
    let one = |(k, m): (usize, &MovedLeg)| {
        let (type_name, name) = &s.families[k];
        LegMoveRecord {
            leg: m.request.leg.get() + 1,
            component: m.request.family + 1,
            type_name: type_name.clone(),
            along: name.clone(),
            parameters_written: s.written[k].clone(),
            parameters: m.request.parameters.iter().copied().map(Number).collect(),
            from: (&m.from).into(),
            to: (&m.to).into(),
            coefficients: m.coefficients.map(Number),
            coefficient: Number(m.coefficients[m.request.leg.get()]),
            residual: Number(m.residual),
            exact: m.exact,
            singular_parameters: (&m.singular).into(),
        }
    };
    MoveStepRecord {
        outcome: r.map.relation.decided(),
        det: Number(r.map.determinant),
        moves: r.moved.iter().enumerate().map(one).collect(),
    }
}
