//! The zero set of a determinant over two variables.

use super::contour::ValueGrid;
use super::style::{PixelAxis, Svg, frame};

/// One axis of the slice.
#[derive(Debug, Clone, PartialEq)]
pub struct SliceAxis {
    /// Label, with the unit.
    pub label: String,
    /// Lowest value.
    pub low: f64,
    /// Highest value.
    pub high: f64,
}

/// The contents of the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct SliceFigure {
    /// Title.
    pub title: String,
    /// The quantity, for instance `det J`.
    pub quantity: String,
    /// A line of text below the plot.
    pub note: String,
    /// The axis to the right.
    pub across: SliceAxis,
    /// The axis upwards.
    pub up: SliceAxis,
    /// Points of the grid per side, two or more.
    pub side: usize,
    /// The quantity at the grid points, row by row from the lowest, any positive scale.
    pub values: Vec<f64>,
    /// A marked pose and its label.
    pub mark: Option<((f64, f64), String)>,
}

// the layout in pixels: sizes, and positions from the left and the top
const WIDTH: f64 = 700.0;
const HEIGHT: f64 = 660.0;
const LEFT: f64 = 84.0;
const RIGHT: f64 = 664.0;
const TOP: f64 = 66.0;
const BOTTOM: f64 = 566.0;

/// The zero line of a determinant with the regions of either sign tinted.
#[must_use]
pub fn singular_slice(figure: &SliceFigure) -> String {
    let x = PixelAxis { low: figure.across.low, high: figure.across.high, from: LEFT, to: RIGHT };
    let y = PixelAxis { low: figure.up.low, high: figure.up.high, from: BOTTOM, to: TOP };
    let description = format!(
        "Zero line of {} over {} and {}, between regions of either sign. {}",
        figure.quantity, figure.across.label, figure.up.label, figure.note
    );
    let mut svg = Svg::new(WIDTH, HEIGHT, &figure.title, &description);
    svg.text("title", (LEFT, 30.0), &figure.title);
    let name = &figure.quantity;
    svg.text("note", (LEFT, 50.0), &format!("blue: {name} > 0, orange: {name} < 0, heavy line: singular"));
    svg.rect("positive", (LEFT, TOP), (RIGHT - LEFT, BOTTOM - TOP));
    let last = figure.side.saturating_sub(1).max(1) as f64;
    let place = |axis: &PixelAxis, k: f64| axis.at(axis.low + k / last * (axis.high - axis.low));
    negative_cells(&mut svg, figure, &|k| place(&x, k), &|k| place(&y, k));
    let grid = ValueGrid { columns: figure.side, rows: figure.side, values: figure.values.clone() };
    for line in grid.contour(0.0) {
        let points: Vec<(f64, f64)> = line.into_iter().map(|(i, j)| (place(&x, i), place(&y, j))).collect();
        svg.polyline("singular", &points);
    }
    if let Some((at, label)) = &figure.mark {
        let at = (x.at(at.0), y.at(at.1));
        svg.circle("mark", at, 5.0);
        svg.text("halo", (at.0 + 9.0, at.1 + 4.0), label);
    }
    frame(&mut svg, &x, &y, (8, 8));
    svg.text("mid", (f64::midpoint(LEFT, RIGHT), BOTTOM + 44.0), &figure.across.label);
    svg.turned_text("mid", (24.0, f64::midpoint(TOP, BOTTOM)), -90.0, &figure.up.label);
    svg.text("note", (LEFT, HEIGHT - 18.0), &figure.note);
    svg.finish()
}

/// Rows of grid points with a negative value as strips half a cell to either side.
fn negative_cells(svg: &mut Svg, figure: &SliceFigure, x: &impl Fn(f64) -> f64, y: &impl Fn(f64) -> f64) {
    let n = figure.side;
    let inside = |k: f64| k.clamp(0.0, n.saturating_sub(1) as f64);
    for j in 0..n {
        let row = &figure.values[j * n..(j + 1) * n];
        let mut i = 0;
        while i < n {
            let run = row[i..].iter().take_while(|v| **v < 0.0).count();
            if run > 0 {
                // a strip ends where the sign changes, linearly between grid points
                let cut = |inner: usize, outer: Option<usize>| {
                    outer.map_or(inner as f64, |o| {
                        let t = row[inner] / (row[inner] - row[o]);
                        inner as f64 + t * (o as f64 - inner as f64)
                    })
                };
                let from = cut(i, i.checked_sub(1));
                let to = cut(i + run - 1, (i + run < n).then_some(i + run));
                let (low, high) = (y(inside(j as f64 - 0.5)), y(inside(j as f64 + 0.5)));
                svg.rect("negative", (x(from), high), (x(to) - x(from), low - high));
            }
            i += run.max(1);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_zero_line_and_the_negative_region_are_drawn() {
        let side = 21;
        let values = (0..side * side).map(|k| (k % side) as f64 - 8.5).collect();
        let axis = |label: &str| SliceAxis { label: label.into(), low: -1.0, high: 1.0 };
        let figure = SliceFigure {
            title: "t".into(),
            quantity: "det J".into(),
            note: "n".into(),
            across: axis("x [mm]"),
            up: axis("y [mm]"),
            side,
            values,
            mark: Some(((0.0, 0.0), "home".into())),
        };
        let text = singular_slice(&figure);
        assert_eq!(text.matches("<polyline class=\"singular\"").count(), 1);
        assert_eq!(text.matches("class=\"negative\"").count(), side);
        let clear = SliceFigure { values: vec![1.0; side * side], ..figure };
        assert!(!singular_slice(&clear).contains("<polyline class=\"singular\""));
    }
}
