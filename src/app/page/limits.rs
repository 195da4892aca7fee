//! The requirements of a platform over its whole workspace: the answer of `assess`.

use super::request::Refusal;
use ask::Design;
use ask::Error;
use machine::requirements::AssessOptions;
use records::AssessAnswer;

/// The result of [`Design::assess`] with these numbers; like there, a design without requirements is refused.
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
