//! The octahedral platform nearest to a design.

use super::poses::{POSE, pose, units as pose_units};
use crate::figure::{figure, length};
use crate::{Sheet, Table, right};
use records::{NearestAnswer, SourceWord};

/// The answer of `equivalents nearest`.
#[must_use]
pub fn nearest(r: &NearestAnswer) -> Sheet {
    let mut out = Sheet::new();
    say!(out, "{}: {}", r.name, r.explanation);
    let Some(n) = &r.nearest else { return out };
    let units = n.beside.units();
    let bracket = if units == "1" { String::new() } else { format!(" [{units}]") };
    let moves = ["base", "platform"].map(|body| right(format!("{body} joint moves{bracket}"), 0).gap(2));
    let columns = [right("leg", 3), right("side", 4).gap(2), right("offset", 11).gap(2)];
    let mut table = Table::new(columns.into_iter().chain(moves));
    for (leg, displacements) in n.displacements.iter().enumerate() {
        let side = n.order.iter().position(|l| *l == leg + 1).unwrap_or(0);
        let numbers = [n.offsets[side], displacements[0], displacements[1]].map(|x| figure(x.0));
        table.row([leg + 1, side + 1].map(|k| k.to_string()).into_iter().chain(numbers));
    }
    out.space();
    out.table(table);
    say!(
        out,
        "\nLargest displacement {}, RMS {}; det A = {}\n\
         Largest change of length: leg {}, {} at {POSE} = {}{} ({} poses of the {} workspace)",
        length(n.error.largest_displacement.0, units),
        length(n.rms_displacement.0, units),
        figure(n.error.det.0),
        n.deviating_leg,
        length(n.error.largest_length_deviation.0, units),
        pose(&n.deviating_pose),
        pose_units(units, "deg"),
        n.poses,
        if n.workspace_from == SourceWord::Design { "design's" } else { "default" }
    );
    if !n.converged {
        out.line("The fit has not converged: nearer platforms exist.");
    }
    if n.set_aside > 0 {
        say!(out, "Nearer fits left out because their platform is singular: {}", n.set_aside);
    }
    for path in &r.paths {
        say!(out, "wrote {path}");
    }
    out
}
