//! The output of `build round`.

use ask::Design;
use ask::rounding::{RoundingChoices, RoundingWay};
use machine::manufacture::Rounding;
use records::{AssessAnswer, ExactRoundingOutcome, NearestRoundingOutcome, RoundAnswer};

/// The complete result.
#[derive(Debug)]
pub(in crate::app::cli::commands) struct RoundReport<'a> {
    pub(in crate::app::cli::commands) design: &'a Design,
    pub(in crate::app::cli::commands) choices: &'a RoundingChoices,
    pub(in crate::app::cli::commands) found: &'a Rounding,
    pub(in crate::app::cli::commands) rounded: Option<(RoundingWay, &'a Design)>,
    /// Whether the rounded design is the one of the rule or of the requested variant, rather than the one with the
    /// least violation.
    pub(in crate::app::cli::commands) is_taken: bool,
    pub(in crate::app::cli::commands) assessment: Option<AssessAnswer>,
    pub(in crate::app::cli::commands) written: Option<&'a str>,
}

impl RoundReport<'_> {
    pub(in crate::app::cli::commands) fn record(&self) -> RoundAnswer {
        RoundAnswer {
            name: self.design.name.clone(),
            units: self.design.units.clone(),
            grids: (&self.choices.grids).into(),
            free_grid: self.choices.free,
            given: self.found.given.clone(),
            exact: ExactRoundingOutcome::new(self.design, &self.found.exact),
            nearest: NearestRoundingOutcome::new(self.design, &self.found.nearest),
            assessment: self.assessment.clone(),
            chosen: self.rounded.map(|r| r.0).filter(|_| self.is_taken),
            least_missed: self.rounded.map(|r| r.0).filter(|_| !self.is_taken),
            design: self.rounded.map(|r| r.1.into()),
            output: self.written.map(str::to_owned),
        }
    }
}
