//! A design that was made from a few numbers.

use super::poses::{POSE, pose};
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
    let units = &answer.units;
    say!(out, "home: {POSE} = {} ({units}, deg)", pose(&answer.home));
    let lengths = answer.lengths.map(figure).join(", ");
    say!(out, "{}: {lengths} {units}", if has_cranks { "rods" } else { "leg lengths at home" });
    if answer.architecturally_singular {
        out.line("ARCHITECTURALLY SINGULAR: no pose holds the platform; `equipod check` explains why");
    }
    out
}
