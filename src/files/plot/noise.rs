//! Errors of poses over errors of leg lengths, both on logarithmic axes.

use super::style::{LINES, PixelAxis, Svg, legend, mark, ticked_frame};

/// One point of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoisePoint {
    /// Relative error of the leg lengths.
    pub sigma: f64,
    /// Lower quartile, median, upper quartile of the error of each panel.
    pub quartiles: [[f64; 3]; 2],
}

/// One class of platforms.
#[derive(Debug, Clone, PartialEq)]
pub struct NoiseCurve {
    /// Name.
    pub label: String,
    /// Points by increasing `sigma`; values that are not positive are left out of the logarithmic axes.
    pub points: Vec<NoisePoint>,
}

/// The contents of the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct NoiseFigure {
    /// Title.
    pub title: String,
    /// A line of text below.
    pub note: String,
    /// Titles of the two panels.
    pub panels: [String; 2],
    /// Highlighted range of `sigma`, with its label.
    pub marked: (f64, f64, String),
    /// The curves, at most [`NoiseFigure::MOST_CURVES`]; the rest are not drawn.
    pub curves: Vec<NoiseCurve>,
}

impl NoiseFigure {
    /// Greatest number of curves that are distinguishable without colour.
    pub const MOST_CURVES: usize = 4;
}

// the layout in pixels: sizes, and positions from the left and the top
const PANEL: (f64, f64) = (360.0, 400.0);
const LEFT: f64 = 74.0;
const TOP: f64 = 92.0;
const BETWEEN: f64 = 76.0;
const HEIGHT: f64 = 596.0;
/// Sizes of the marks of curves: disc, ring, square.
const MARKS: [f64; 3] = [3.6, 3.0, 2.8];
/// Sideways shift between overlapping curves, pixels.
const APART: f64 = 4.0;

/// Two panels: medians as marks on a line, quartiles as bars.
#[must_use]
pub fn noise_chart(figure: &NoiseFigure) -> String {
    let width = LEFT + 2.0 * PANEL.0 + BETWEEN + 24.0;
    let names: Vec<&str> = figure.curves.iter().map(|c| c.label.as_str()).collect();
    let description = format!(
        "Logarithmic axes. Horizontal: relative error of the leg lengths. Vertical: {}; {}. Classes: {}.",
        figure.panels[0],
        figure.panels[1],
        names.join(", ")
    );
    let mut svg = Svg::new(width, HEIGHT, &figure.title, &description);
    svg.text("title", (LEFT, 30.0), &figure.title);
    let end = legend(&mut svg, LEFT, figure.curves.iter().map(|c| &c.label), MARKS);
    svg.text("note", (end, 54.0), "marks: medians; bars: from the lower to the upper quartile");
    for (panel, title) in figure.panels.iter().enumerate() {
        let left = LEFT + panel as f64 * (PANEL.0 + BETWEEN);
        let (x, y) = axes(figure, panel, left);
        band(&mut svg, figure, &x);
        for (k, curve) in figure.curves.iter().take(LINES.len()).enumerate() {
            let shift = (k as f64 - (figure.curves.len().min(LINES.len()) as f64 - 1.0) / 2.0) * APART;
            draw(&mut svg, k, &places(curve, panel, &x, &y, shift));
        }
        frame(&mut svg, &x, &y, title);
    }
    svg.text("note", (LEFT, HEIGHT - 16.0), &figure.note);
    svg.finish()
}

fn drawable(p: &NoisePoint, panel: usize) -> bool {
    p.sigma > 0.0 && p.quartiles[panel].iter().all(|v| *v > 0.0 && v.is_finite())
}

/// Axes in decades, whole ones on the vertical axis; the horizontal one ends half a decade beyond the points.
fn axes(figure: &NoiseFigure, panel: usize, left: f64) -> (PixelAxis, PixelAxis) {
    let points = || figure.curves.iter().flat_map(|c| &c.points).filter(|p| drawable(p, panel));
    let range = |values: &mut dyn Iterator<Item = f64>| {
        let ends = values.fold((f64::INFINITY, f64::NEG_INFINITY), |r, v| (r.0.min(v), r.1.max(v)));
        if ends.0 <= ends.1 { ends } else { (-1.0, 0.0) }
    };
    let across = range(&mut points().map(|p| p.sigma.log10()));
    let up = range(&mut points().flat_map(|p| p.quartiles[panel]).map(f64::log10));
    (
        PixelAxis { low: across.0 - 0.5, high: across.1 + 0.5, from: left, to: left + PANEL.0 },
        PixelAxis {
            low: up.0.floor(),
            high: (up.1.floor() + 1.0).max(up.0 + 1.0),
            from: TOP + PANEL.1,
            to: TOP,
        },
    )
}

/// The highlighted range, with its label at the foot.
fn band(svg: &mut Svg, figure: &NoiseFigure, x: &PixelAxis) {
    let (from, to, label) = &figure.marked;
    if !(*from > 0.0 && x.low < from.log10() && to.log10() < x.high && from < to) {
        return;
    }
    let (a, b) = (x.at(from.log10()), x.at(to.log10()));
    svg.rect("positive", (a - 8.0, TOP), (b - a + 16.0, PANEL.1));
    svg.text("end note", (a - 12.0, TOP + PANEL.1 - 10.0), label);
}

/// Lower quartile, median, upper quartile of each point on the page.
fn places(
    curve: &NoiseCurve,
    panel: usize,
    x: &PixelAxis,
    y: &PixelAxis,
    shift: f64,
) -> Vec<[(f64, f64); 3]> {
    let place = |p: &NoisePoint| {
        let across = x.at(p.sigma.log10()) + shift;
        p.quartiles[panel].map(|v| (across, y.at(v.log10())))
    };
    curve.points.iter().filter(|p| drawable(p, panel)).map(place).collect()
}

fn draw(svg: &mut Svg, kind: usize, places: &[[(f64, f64); 3]]) {
    let medians: Vec<(f64, f64)> = places.iter().map(|p| p[1]).collect();
    // not one polyline: the style of some of these classes would fill it
    for pair in medians.windows(2) {
        svg.line(LINES[kind], pair[0], pair[1]);
    }
    for [lower, _, upper] in places {
        svg.line("tick", *lower, *upper);
    }
    for at in medians {
        mark(svg, kind, at, MARKS);
    }
}

fn frame(svg: &mut Svg, x: &PixelAxis, y: &PixelAxis, title: &str) {
    let bottom = TOP + PANEL.1;
    ticked_frame(svg, (x, y), (x.decades(7), y.decades(9)), 20.0);
    svg.text("", (x.from, TOP - 10.0), title);
    svg.text(
        "mid",
        (f64::midpoint(x.from, x.to), bottom + 44.0),
        "relative error of the leg lengths, \u{3c3}",
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(values: &[(f64, f64)]) -> NoiseFigure {
        let point =
            |(sigma, v): &(f64, f64)| NoisePoint { sigma: *sigma, quartiles: [[0.5 * v, *v, 2.0 * v]; 2] };
        NoiseFigure {
            title: "noise".into(),
            note: "a < b".into(),
            panels: ["rotation".into(), "position".into()],
            marked: (1e-4, 8e-4, "published".into()),
            curves: vec![NoiseCurve { label: "6-6".into(), points: values.iter().map(point).collect() }],
        }
    }

    #[test]
    fn proportional_errors_lie_on_a_straight_line() {
        let text = noise_chart(&figure(&[(1e-6, 1e-5), (1e-4, 1e-3), (1e-2, 1e-1)]));
        let after = |part: &str, name: &str| -> f64 {
            let rest = part.split(&format!(" {name}=\"")).nth(1).unwrap();
            rest.split('"').next().unwrap().parse().unwrap()
        };
        // the first is the legend's, then three for each panel
        let marks = text.split("<circle class=\"mark\"").skip(2).take(3);
        let numbers: Vec<f64> = marks.flat_map(|m| [after(m, "cx"), after(m, "cy")]).collect();
        assert!((numbers[2] - f64::midpoint(numbers[0], numbers[4])).abs() < 0.02);
        assert!((numbers[3] - f64::midpoint(numbers[1], numbers[5])).abs() < 0.02);
        assert!(
            text.contains("a &lt; b") && text.contains("published") && text.contains("10\u{207b}\u{2074}")
        );
    }

    #[test]
    fn what_has_no_logarithm_is_left_out() {
        for values in [vec![], vec![(0.0, 1e-14)], vec![(1e-3, 0.0)], vec![(1e-3, f64::NAN), (1e-2, 0.1)]] {
            let text = noise_chart(&figure(&values));
            assert!(!text.contains("NaN") && !text.contains("inf"), "{values:?}");
        }
    }
}
