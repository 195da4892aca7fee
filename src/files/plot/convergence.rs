//! The best value of several methods over the time they took.

use super::style::{LINES, PixelAxis, Svg, legend, mark, ticked_frame};

/// One method.
#[derive(Debug, Clone, PartialEq)]
pub struct ConvergenceCurve {
    /// Name.
    pub label: String,
    /// Pairs of seconds and the best value from then on, by increasing time; points without a positive time are left
    /// out.
    pub points: Vec<(f64, f64)>,
}

/// The contents of the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct ConvergenceFigure {
    /// Title.
    pub title: String,
    /// The quantity of the values; larger ones are better.
    pub quantity: String,
    /// A line of text below.
    pub note: String,
    /// The curves, at most [`ConvergenceFigure::MOST_CURVES`]; the rest are not drawn.
    pub curves: Vec<ConvergenceCurve>,
}

impl ConvergenceFigure {
    /// Greatest number of curves that are distinguishable without colour.
    pub const MOST_CURVES: usize = 4;
    /// Smaller shortfalls are drawn at this value.
    pub const LEAST_SHORTFALL: f64 = 1e-10;
}

// the layout in pixels: sizes, and positions from the left and the top
const PANEL: (f64, f64) = (360.0, 300.0);
const LEFT: f64 = 74.0;
const TOP: f64 = 92.0;
const BETWEEN: f64 = 76.0;
const HEIGHT: f64 = 496.0;
/// Sizes of the marks of curves: disc, ring, square.
const MARKS: [f64; 3] = [4.0, 3.4, 3.0];

/// Two panels over the logarithm of the time: the value itself, and its relative shortfall from the best of all curves,
/// logarithmic.
#[must_use]
pub fn convergence_chart(figure: &ConvergenceFigure) -> String {
    let width = LEFT + 2.0 * PANEL.0 + BETWEEN + 24.0;
    let names: Vec<&str> = figure.curves.iter().map(|c| c.label.as_str()).collect();
    let description = format!(
        "Best {} over elapsed time, and its relative shortfall from the best of all; logarithmic time. Methods: {}.",
        figure.quantity,
        names.join(", ")
    );
    let mut svg = Svg::new(width, HEIGHT, &figure.title, &description);
    // curves have their own joins; the shared classes are for straight lines
    svg.style("polyline{fill:none;stroke-linejoin:round}");
    svg.text("title", (LEFT, 30.0), &figure.title);
    legend(&mut svg, LEFT, figure.curves.iter().map(|c| &c.label), MARKS);
    let curves: Vec<Vec<(f64, f64)>> = figure.curves.iter().take(LINES.len()).map(drawable).collect();
    let all = || curves.iter().flatten();
    let best = all().map(|p| p.1).fold(f64::NEG_INFINITY, f64::max);
    let times = range(all().map(|p| p.0.log10()));
    for panel in 0..2 {
        let left = LEFT + panel as f64 * (PANEL.0 + BETWEEN);
        let x = PixelAxis { low: times.0 - 0.2, high: times.1 + 0.2, from: left, to: left + PANEL.0 };
        let height = |value: f64| if panel == 0 { value } else { shortfall(value, best).log10() };
        let ends = range(all().map(|p| height(p.1)));
        let padding = 0.05 * (ends.1 - ends.0).max(if panel == 0 { 1e-3 * ends.1.abs() } else { 1.0 });
        let y = PixelAxis { low: ends.0 - padding, high: ends.1 + padding, from: TOP + PANEL.1, to: TOP };
        for (kind, curve) in curves.iter().enumerate() {
            let heights: Vec<(f64, f64)> = curve.iter().map(|p| (p.0.log10(), height(p.1))).collect();
            draw(&mut svg, kind, &steps(&heights, &x, &y));
        }
        frame(&mut svg, (&x, &y), panel, figure);
    }
    svg.text("note", (LEFT, HEIGHT - 16.0), &figure.note);
    svg.finish()
}

fn drawable(curve: &ConvergenceCurve) -> Vec<(f64, f64)> {
    let place = |p: &&(f64, f64)| p.0 > 0.0 && p.0.is_finite() && p.1.is_finite();
    curve.points.iter().filter(place).copied().collect()
}

fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let ends = values.fold((f64::INFINITY, f64::NEG_INFINITY), |r, v| (r.0.min(v), r.1.max(v)));
    if ends.0 <= ends.1 { ends } else { (0.0, 1.0) }
}

fn shortfall(value: f64, best: f64) -> f64 {
    let share = (best - value) / if best == 0.0 { 1.0 } else { best.abs() };
    share.max(ConvergenceFigure::LEAST_SHORTFALL)
}

/// Corners of the curve on the page: a value holds until the next one.
fn steps(points: &[(f64, f64)], x: &PixelAxis, y: &PixelAxis) -> Vec<(f64, f64)> {
    let mut out: Vec<(f64, f64)> = Vec::new();
    for p in points {
        let at = (x.at(p.0), y.at(p.1));
        if let Some(last) = out.last().copied() {
            out.push((at.0, last.1));
        }
        out.push(at);
    }
    out
}

fn draw(svg: &mut Svg, kind: usize, corners: &[(f64, f64)]) {
    svg.polyline(LINES[kind], corners);
    if let Some(end) = corners.last() {
        mark(svg, kind, *end, MARKS);
    }
}

fn frame(svg: &mut Svg, (x, y): (&PixelAxis, &PixelAxis), panel: usize, figure: &ConvergenceFigure) {
    let bottom = TOP + PANEL.1;
    let rows = if panel == 0 { y.ticks(6) } else { y.decades(10) };
    ticked_frame(svg, (x, y), (x.decades(7), rows), 20.0);
    let below_best =
        format!("relative shortfall from the best, {} or less at the bottom", "10\u{207b}\u{b9}\u{2070}");
    svg.text("", (x.from, TOP - 10.0), if panel == 0 { &figure.quantity } else { &below_best });
    svg.text("mid", (f64::midpoint(x.from, x.to), bottom + 44.0), "elapsed time, seconds");
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(points: &[(f64, f64)]) -> ConvergenceFigure {
        ConvergenceFigure {
            title: "race".into(),
            quantity: "value".into(),
            note: "a < b".into(),
            curves: vec![
                ConvergenceCurve { label: "first".into(), points: points.to_vec() },
                ConvergenceCurve { label: "second".into(), points: vec![(1.0, 0.5), (10.0, 0.75)] },
            ],
        }
    }

    fn corners(text: &str) -> Vec<Vec<(f64, f64)>> {
        let lists = text.split("<polyline").skip(1);
        let pair = |p: &str| {
            let (x, y) = p.split_once(',').unwrap();
            (x.parse().unwrap(), y.parse().unwrap())
        };
        lists
            .map(|l| {
                let points = l.split("points=\"").nth(1).unwrap().split('"').next().unwrap();
                points.split_whitespace().map(pair).collect()
            })
            .collect()
    }

    #[test]
    fn curves_are_steps_and_the_best_is_at_the_bottom_of_the_second_panel() {
        let text = convergence_chart(&figure(&[(0.1, 0.5), (1.0, 1.0)]));
        let curves = corners(&text);
        assert_eq!(curves.len(), 4);
        // a value holds until the next one
        assert!((curves[0][0].1 - curves[0][1].1).abs() < 0.02 && curves[0][1].0 > curves[0][0].0);
        assert!((curves[0][1].0 - curves[0][2].0).abs() < 0.02 && curves[0][2].1 < curves[0][1].1);
        // the first ends at the shortfall 1e-10, the second at 1/4: nine and a half decades above
        let decades = -(ConvergenceFigure::LEAST_SHORTFALL / 0.5).log10();
        let (first, second) = (&curves[2], &curves[3]);
        let unit = (first[2].1 - first[0].1) / decades;
        let expected = first[2].1 - unit * (0.25f64 / 1e-10).log10();
        assert!((second[2].1 - expected).abs() < 0.05, "{} {expected}", second[2].1);
        assert!(text.contains("a &lt; b"));
    }

    #[test]
    fn what_has_no_place_is_left_out() {
        for points in
            [vec![], vec![(0.0, 1.0)], vec![(1.0, f64::NAN)], vec![(f64::INFINITY, 1.0)], vec![(2.0, 0.0)]]
        {
            let text = convergence_chart(&figure(&points));
            assert!(!text.contains("NaN") && !text.contains("inf"), "{points:?}");
        }
    }
}
