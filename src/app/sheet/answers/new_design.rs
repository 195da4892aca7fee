//! A design that was made from a few numbers.

use super::poses::{POSE, pose, units};
use crate::Sheet;
use crate::figure::figure;
use records::{NewAnswer, PresetFile};

/// The answer of `new` with its file; the lengths are those of rods where the design has cranks.
#[must_use]
pub fn new_design(answer: &NewAnswer, has_cranks: bool) -> Sheet {
    let mut out = Sheet::new();
    if let PresetFile::Written { output } = &answer.file {
        say!(out, "wrote {output}");
    }
    say!(out, "home: {POSE} = {}{}", pose(&answer.home), units(&answer.units, "deg"));
    let lengths = answer.lengths.map(figure).join(", ");
    let what = if has_cranks { "rod lengths" } else { "leg lengths at home" };
    say!(out, "{what}: {lengths} {}", answer.units);
    if answer.architecturally_singular {
        out.line(
            "ARCHITECTURALLY SINGULAR: the legs hold the platform at no pose. `equipod check` explains why.",
        );
    }
    out
}
