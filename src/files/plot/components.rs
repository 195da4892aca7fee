//! Two planes with the curves of replaceable joints, side by side.

use super::contour::ValueGrid;
use super::style::Svg;

/// A marked point of a panel.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveMark {
    /// Plane coordinates, design units.
    pub at: [f64; 2],
    /// The label beside it.
    pub label: String,
    /// A joint of the design (filled) or a corresponding point (hollow).
    pub joint: bool,
}

/// One plane.
#[derive(Debug, Clone, PartialEq)]
pub struct CurvePanel {
    /// Title.
    pub title: String,
    /// Degree of the curve, 0 for none.
    pub degree: usize,
    /// Coefficients of `1, x, y, x^2, x y, y^2, ..` in the coordinates of the marks divided by `units`.
    pub coefficients: Vec<f64>,
    /// Units of the two coordinates of the coefficients, design units.
    pub units: [f64; 2],
    /// Joints and corresponding points.
    pub marks: Vec<CurveMark>,
    /// A line of text below.
    pub note: String,
}

/// Pairs of planes.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveFigure {
    /// Title.
    pub title: String,
    /// Base and platform of each pair.
    pub panels: Vec<[CurvePanel; 2]>,
}

// the layout in pixels: sizes, and positions from the left and the top
const SIDE: f64 = 400.0;
const MARGIN: f64 = 30.0;
const TOP: f64 = 84.0;
/// Distance from one pair to the next below it.
const ROW: f64 = SIDE + 64.0;
/// Grid points per side for the curves.
const GRID: usize = 181;

/// The curves of replaceable joints in two planes, one pair below the other.
///
/// Points with the same letter on the left curve (base) and the right curve (platform) are the ends of a possible
/// replacement leg. Joints are filled and carry their leg numbers, corresponding points are hollow. The view is from
/// the positive side of each plane's axes, with one scale for both directions of a panel.
#[must_use]
pub fn component_curves(figure: &CurveFigure) -> String {
    let width = 2.0 * SIDE + 3.0 * MARGIN;
    let notes = figure
        .panels
        .iter()
        .map(|[base, platform]| format!("Left: {}. Right: {}. ", base.note, platform.note));
    let description = notes.collect::<String>() + "Equal letters belong to one leg.";
    let height = TOP + ROW * figure.panels.len() as f64 - 6.0;
    let mut svg = Svg::new(width, height, &figure.title, &description);
    svg.text("title", (MARGIN, 30.0), &figure.title);
    svg.text(
        "note",
        (MARGIN, 50.0),
        "filled: joints of the design; hollow: ends of replaceable legs, equal letters one leg",
    );
    for (row, pair) in figure.panels.iter().enumerate() {
        for (k, panel) in pair.iter().enumerate() {
            draw(&mut svg, panel, (MARGIN + k as f64 * (SIDE + MARGIN), TOP + row as f64 * ROW));
        }
    }
    svg.finish()
}

/// The visible part of the plane: a square around all marks.
struct Window {
    left: f64,
    low: f64,
    size: f64,
}

impl Window {
    fn around(marks: &[CurveMark]) -> Self {
        let range = |axis: usize| {
            let values = marks.iter().map(|m| m.at[axis]);
            let low = values.clone().fold(f64::MAX, f64::min);
            (low, values.fold(f64::MIN, f64::max))
        };
        let ((x0, x1), (y0, y1)) = (range(0), range(1));
        let size = 1.35 * (x1 - x0).max(y1 - y0);
        if !(size > 0.0) || !size.is_finite() {
            return Self { left: -1.0, low: -1.0, size: 2.0 };
        }
        Self { left: (x0 + x1 - size) / 2.0, low: (y0 + y1 - size) / 2.0, size }
    }

    /// Fractions of the panel to page coordinates.
    fn page(corner: (f64, f64), u: f64, v: f64) -> (f64, f64) {
        (corner.0 + SIDE * u, corner.1 + SIDE * (1.0 - v))
    }

    fn at(&self, corner: (f64, f64), p: [f64; 2]) -> (f64, f64) {
        Self::page(corner, (p[0] - self.left) / self.size, (p[1] - self.low) / self.size)
    }
}

fn value(panel: &CurvePanel, x: f64, y: f64) -> f64 {
    let mut sum = 0.0;
    let mut coefficients = panel.coefficients.iter();
    for n in 0..=panel.degree {
        for k in 0..=n {
            let c = coefficients.next().copied().unwrap_or(0.0);
            let powers = std::iter::repeat_n(x, n - k).chain(std::iter::repeat_n(y, k));
            sum += c * powers.product::<f64>();
        }
    }
    sum
}

/// One plane with its upper left corner.
fn draw(svg: &mut Svg, panel: &CurvePanel, corner: (f64, f64)) {
    let window = Window::around(&panel.marks);
    svg.text("mid", (corner.0 + SIDE / 2.0, corner.1 - 10.0), &panel.title);
    if panel.degree > 0 {
        let step = window.size / (GRID - 1) as f64;
        let at = |k: usize| {
            let (x, y) = (window.left + step * (k % GRID) as f64, window.low + step * (k / GRID) as f64);
            value(panel, x / panel.units[0], y / panel.units[1])
        };
        let grid = ValueGrid { columns: GRID, rows: GRID, values: (0..GRID * GRID).map(at).collect() };
        for line in grid.contour(0.0) {
            let scale = (GRID - 1) as f64;
            let points: Vec<(f64, f64)> =
                line.iter().map(|(i, j)| Window::page(corner, i / scale, j / scale)).collect();
            svg.polyline("level", &points);
        }
    }
    svg.rect("frame", corner, (SIDE, SIDE));
    // joints last, since a replaceable leg often ends in one
    let (joints, others): (Vec<&CurveMark>, Vec<&CurveMark>) = panel.marks.iter().partition(|m| m.joint);
    for mark in others.into_iter().chain(joints) {
        let at = window.at(corner, mark.at);
        if mark.joint {
            svg.circle("mark", at, 4.5);
            svg.text("halo mid", (at.0, at.1 - 9.0), &mark.label);
        } else {
            svg.circle("hollow", at, 6.0);
            svg.text("note halo mid", (at.0, at.1 + 16.0), &mark.label);
        }
    }
    svg.text("note", (corner.0, corner.1 + SIDE + 20.0), &panel.note);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_is_drawn_with_its_marks() {
        let mark = |x: f64, y: f64, label: &str, joint| CurveMark { at: [x, y], label: label.into(), joint };
        let panel = CurvePanel {
            title: "base".into(),
            degree: 2,
            coefficients: vec![-1.0, 0.0, 0.0, 1.0, 0.0, 1.0],
            units: [10.0, 10.0],
            marks: vec![
                mark(10.0, 0.0, "1", true),
                mark(0.0, 10.0, "2", true),
                mark(-10.0, 0.0, "a<b", false),
            ],
            note: "a circle".into(),
        };
        let empty = CurvePanel { degree: 0, coefficients: Vec::new(), marks: Vec::new(), ..panel.clone() };
        let pair = [panel, empty];
        let figure = CurveFigure { title: "t".into(), panels: vec![pair.clone(), pair.clone()] };
        assert_eq!(component_curves(&figure).matches("class=\"level\"").count(), 2);
        let figure = CurveFigure { title: "t".into(), panels: vec![pair] };
        let svg = component_curves(&figure);
        assert_eq!(svg.matches("class=\"level\"").count(), 1);
        assert_eq!((svg.matches("class=\"mark\"").count(), svg.matches("class=\"hollow\"").count()), (2, 1));
        assert!(svg.contains("a&lt;b") && svg == component_curves(&figure));
    }
}
