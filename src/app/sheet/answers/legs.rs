//! The legs of a design.

use crate::{Table, left};
use ask::Design;
use num::shown::significant;

/// The joints of each leg in body frames, and its length from the file, or else at home.
#[must_use]
pub fn legs(design: &Design) -> Table {
    let m = design.manipulator();
    let at_home = || design.home.as_ref().and_then(|home| home.lengths(m));
    let (title, lengths) = match design.lengths {
        Some(lengths) => ("length", Some(lengths)),
        None => ("length at home", at_home()),
    };
    let titles = ["leg", "base joint", "x, y, z", "platform joint", "x, y, z"].into_iter();
    let titles = titles.chain(lengths.map(|_| title));
    let mut table = Table::new(titles.map(|title| left(title, 0)));
    let at = |p: &nalgebra::Point3<f64>| [p.x, p.y, p.z].map(significant).join(", ");
    for (k, (a, b)) in m.pairs().into_iter().enumerate() {
        let cells = [
            (k + 1).to_string(),
            design.base_names()[a].clone(),
            at(&m.base_joints()[a]),
            design.platform_names()[b].clone(),
            at(&m.platform_joints()[b]),
        ];
        table.row(cells.into_iter().chain(lengths.map(|l| significant(l.get()[k]))));
    }
    table
}
