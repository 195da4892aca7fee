//! What a platform has to satisfy over its whole workspace: the answer of `assess`.

use super::request::Refusal;
use ask::Design;
use ask::Error;
use machine::requirements::AssessOptions;
use records::AssessAnswer;

/// What [`Design::assess`] finds with these numbers; a design that requires nothing is refused as there.
pub(super) fn record(
    design: &Design,
    options: &AssessOptions,
    cells: Option<usize>,
) -> Result<AssessAnswer, Refusal> {
    match design.assess_by(options, cells, &mut |_| {}) {
        Ok(found) => Ok(AssessAnswer::new(design, &found)),
        Err(Error::NothingRequired) => {
            Err(Refusal::new("nothing_required", "the design has no requirements"))
        }
        Err(other) => Err(Refusal::new("assess", other)),
    }
}
