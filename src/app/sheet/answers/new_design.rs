//! A design that was made from a few numbers.

use super::poses::{POSE, pose, units};
use crate::Sheet;
use crate::figure::figure;
use records::{NewAnswer, PresetFile};

/// The answer of `new` with its file.
#[must_use]
pub fn new_design(answer: &NewAnswer) -> Sheet {
    let mut out = Sheet::new();
    if let PresetFile::Written { output } = &answer.file {
        say!(out, "wrote {output}");
    }
    say!(out, "home: {POSE} = {}{}", pose(&answer.home), units(&answer.units, "deg"));
    let lengths = answer.lengths.map(figure).join(", ");
    let what = if answer.crank_angles_deg.is_some() { "rod lengths" } else { "leg lengths at home" };
    say!(out, "{what}: {lengths} {}", answer.units);
    if let Some(angles) = answer.crank_angles_deg {
        // a level crank is at 0 up to rounding
        let angles = angles.map(|angle| figure((angle * 1e9).round() / 1e9));
        say!(out, "crank angles at home: {} deg", angles.join(", "));
    }
    if answer.architecturally_singular {
        out.line(
            "ARCHITECTURALLY SINGULAR: the legs hold the platform at no pose. `equipod check` explains why.",
        );
    }
    out
}
