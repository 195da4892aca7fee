//! Designs of five legs, for `equipod check` and `equipod fk`.

use crate::app::cli::numbers;
use crate::app::cli::{Answer, Context, Exit, Failure};
use ::files::design::FiveLegs;
use ask::{PentapodReport, about_five_legs};
use records::PentapodAnswer;

fn answered(exit: Exit, report: &PentapodReport) -> Answer {
    let answer = PentapodAnswer::from(report);
    let sheet = sheet::answers::pentapod(&answer, &report.design.units);
    Answer::new(exit, answer, sheet)
}

/// Whether the legs are dependent at every pose, the line that they hold, and its singular poses.
pub(super) fn check(design: &FiveLegs, context: &Context) -> Answer {
    let report = about_five_legs(design, None, context.seed());
    let exit = match report.architecturally_singular {
        Some(false) => Exit::Yes,
        Some(true) => Exit::No,
        None => Exit::Inconclusive,
    };
    answered(exit, &report)
}

/// All poses of the line that the legs hold.
///
/// # Errors
/// No lengths; legs that hold no line.
pub(super) fn fk(design: &FiveLegs, lengths: Option<&str>, context: &Context) -> Result<Answer, Failure> {
    let lengths = match lengths {
        None => design.lengths,
        Some(text) => Some(numbers::lengths(text, "five", &design.units).map_err(|why| {
            Failure::refused("fk::bad_lengths", format!("--lengths: {why}"))
                .with_help("give five lengths separated by commas")
        })?),
    };
    let Some(lengths) = lengths else {
        return Err(Failure::refused(
            "fk::no_lengths",
            "the design has no `lengths` and --lengths was not given",
        )
        .with_help("give --lengths l1,l2,l3,l4,l5"));
    };
    let report = about_five_legs(design, Some(lengths), context.seed());
    if let Some(message) = report.without_line() {
        return Err(Failure::refused("fk::five_legs", message)
            .with_help("add a sixth leg; `equipod check` lists legs that decouple the platform"));
    }
    let exit = if matches!(report.poses, Some(Ok(_))) { Exit::Yes } else { Exit::Inconclusive };
    Ok(answered(exit, &report))
}
