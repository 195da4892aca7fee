//! What `build round` writes.

use ask::Design;
use ask::rounding::{RoundingChoices, RoundingWay};
use machine::manufacture::Rounding;
use records::{AssessAnswer, ExactRoundingOutcome, NearestRoundingOutcome, RoundAnswer};

/// Everything there is to tell.
#[derive(Debug)]
pub(in crate::app::cli::commands) struct RoundReport<'a> {
    pub(in crate::app::cli::commands) design: &'a Design,
    pub(in crate::app::cli::commands) choices: &'a RoundingChoices,
    pub(in crate::app::cli::commands) found: &'a Rounding,
    pub(in crate::app::cli::commands) rounded: Option<(RoundingWay, &'a Design)>,
    /// The rounded design is that of the rule or of the variant asked for, not the one that misses the requirements
    /// least.
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
            wanted: self.found.wanted.clone(),
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
