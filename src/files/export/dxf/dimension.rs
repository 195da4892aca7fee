//! Dimensions: from the datum to every hole along both axes, and the edges of the plate.

use nalgebra::{Point2, Vector2};

use super::page::Page;

/// Distance of the first dimension line from the plate and between lines, in text heights.
const FIRST: f64 = 3.0;
const NEXT: f64 = 2.5;

/// A measured direction, with the side of its dimension lines.
#[derive(Debug, Clone, Copy)]
struct DimensionAxis {
    along: Vector2<f64>,
    out: Vector2<f64>,
    /// Degrees from x.
    angle: f64,
}

const AXES: [DimensionAxis; 2] = [
    DimensionAxis { along: Vector2::new(1.0, 0.0), out: Vector2::new(0.0, -1.0), angle: 0.0 },
    DimensionAxis { along: Vector2::new(0.0, 1.0), out: Vector2::new(-1.0, 0.0), angle: 90.0 },
];

/// The dimension from `from` to `to` along an axis, as a DIMENSION and the block for R12 readers. The dimension line is
/// at `level` from the origin.
fn dimension(page: &mut Page, number: usize, axis: &DimensionAxis, level: f64, [from, to]: [Point2<f64>; 2]) {
    let h = page.text_height;
    let foot = |p: &Point2<f64>| Point2::from(axis.along * axis.along.dot(&p.coords) + axis.out * level);
    let (start, end) = (foot(&from), foot(&to));
    // above the line in the reading direction
    let up = Vector2::new(-axis.along.y, axis.along.x);
    let middle = nalgebra::center(&start, &end) + up * (0.4 * h);
    let measured = axis.along.dot(&(to - from));
    let name = format!("*D{number}");
    page.block(&name, |block| {
        for (at, foot) in [(&from, &start), (&to, &end)] {
            block.line("DIMENSIONS", at + axis.out * (0.5 * h), foot + axis.out * (0.5 * h));
            let tick = (axis.along - axis.out) * (0.4 * h);
            block.line("DIMENSIONS", foot - tick, foot + tick);
        }
        block.line("DIMENSIONS", start, end);
        block.text("DIMENSIONS", middle, h, &format!("{measured:.3}"), Some(axis.angle));
    });
    page.entities.pairs(&[(0, "DIMENSION"), (8, "DIMENSIONS"), (2, &name)]);
    page.entities.point(10, end);
    page.entities.point(11, middle);
    // rotated: measured along the angle, not between the points
    page.entities.pair(70, "0");
    page.entities.point(13, from);
    page.entities.point(14, to);
    page.entities.reals(&[(50, axis.angle)]);
    page.entities.pair(3, "STANDARD");
    page.reaches(start + axis.out * h);
    page.reaches(end + axis.out * h);
}

/// All dimensions of a plate: `holes` and the corners of its extent. They start at the datum, or at the lowest hole
/// without a datum.
pub(super) fn dimensions(
    page: &mut Page,
    holes: &[Point2<f64>],
    extent: [Point2<f64>; 2],
    datum: Option<Point2<f64>>,
) {
    let tolerance = 1e-9 * (extent[1] - extent[0]).norm();
    let mut number = 0;
    for axis in &AXES {
        let place = |p: &Point2<f64>| axis.along.dot(&p.coords);
        let mut rest = holes.to_vec();
        rest.sort_by(|p, q| place(p).total_cmp(&place(q)));
        rest.dedup_by(|p, q| place(p) - place(q) <= tolerance);
        let edge = extent.iter().map(|p| axis.out.dot(&p.coords)).fold(f64::NEG_INFINITY, f64::max);
        let Some(first) = datum.or(rest.first().copied()) else { continue };
        let from_first = |p: &Point2<f64>| if place(p) < place(&first) { [*p, first] } else { [first, *p] };
        let apart = |p: &&Point2<f64>| (place(p) - place(&first)).abs() > tolerance;
        let spans = rest.iter().filter(apart).map(from_first).chain([extent]);
        for (row, span) in spans.enumerate() {
            number += 1;
            let level = edge + (FIRST + NEXT * row as f64) * page.text_height;
            dimension(page, number, axis, level, span);
        }
    }
}
