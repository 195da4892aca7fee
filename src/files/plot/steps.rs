//! The steps of a search: value and violation.

use super::style::{PixelAxis, Svg, ticked_frame};

/// A step of a search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SearchStep {
    /// Value after the step.
    pub value: f64,
    /// Largest violation after the step.
    pub violation: f64,
    /// Whether the step was taken.
    pub accepted: bool,
}

/// The contents of the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct StepsFigure {
    /// Title.
    pub title: String,
    /// The quantity of the values.
    pub quantity: String,
    /// A line of text below.
    pub note: String,
    /// The steps, in order.
    pub steps: Vec<SearchStep>,
}

/// Smaller violations are drawn at this value.
const LEAST_VIOLATION: f64 = 1e-10;
// the layout in pixels: sizes, and positions from the left and the top
const PANEL: (f64, f64) = (360.0, 280.0);
const LEFT: f64 = 74.0;
const TOP: f64 = 84.0;
const BETWEEN: f64 = 76.0;
const HEIGHT: f64 = 460.0;

/// Two panels over the number of the step: the value, and the logarithm of the violation; refused steps are hollow and
/// not joined.
#[must_use]
pub fn steps_chart(figure: &StepsFigure) -> String {
    let width = LEFT + 2.0 * PANEL.0 + BETWEEN + 24.0;
    let description = format!(
        "{} and largest violation of the requirements over {} steps of the search.",
        figure.quantity,
        figure.steps.len()
    );
    let mut svg = Svg::new(width, HEIGHT, &figure.title, &description);
    svg.text("title", (LEFT, 30.0), &figure.title);
    svg.circle("mark", (LEFT + 6.0, 50.0), 3.4);
    svg.text("", (LEFT + 16.0, 54.0), "step taken");
    svg.circle("hollow", (LEFT + 106.0, 50.0), 3.0);
    svg.text("", (LEFT + 116.0, 54.0), "step refused");
    let names = [figure.quantity.as_str(), "largest violation, relative to its scale"];
    for (panel, name) in names.into_iter().enumerate() {
        let left = LEFT + panel as f64 * (PANEL.0 + BETWEEN);
        let height =
            |s: &SearchStep| if panel == 0 { s.value } else { s.violation.max(LEAST_VIOLATION).log10() };
        draw(&mut svg, figure, panel, left, &height);
        svg.text("", (left, TOP - 10.0), name);
    }
    svg.text("note", (LEFT, HEIGHT - 16.0), &figure.note);
    svg.finish()
}

fn draw(svg: &mut Svg, figure: &StepsFigure, panel: usize, left: f64, height: &dyn Fn(&SearchStep) -> f64) {
    let drawn: Vec<(f64, f64, bool)> = figure
        .steps
        .iter()
        .enumerate()
        .map(|(k, s)| (k as f64 + 1.0, height(s), s.accepted))
        .filter(|p| p.1.is_finite())
        .collect();
    let all = || drawn.iter().map(|p| p.1);
    let (low, high) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
    let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
    let padding = (0.06 * (high - low)).max(1e-3 * high.abs()).max(1e-6);
    let last = figure.steps.len().max(2) as f64;
    let x = PixelAxis { low: 0.0, high: last + 1.0, from: left, to: left + PANEL.0 };
    let y = PixelAxis { low: low - padding, high: high + padding, from: TOP + PANEL.1, to: TOP };
    let taken: Vec<(f64, f64)> = drawn.iter().filter(|p| p.2).map(|p| (x.at(p.0), y.at(p.1))).collect();
    svg.polyline("level", &taken);
    for (at, value, accepted) in &drawn {
        let (class, radius) = if *accepted { ("mark", 3.0) } else { ("hollow", 2.6) };
        svg.circle(class, (x.at(*at), y.at(*value)), radius);
    }
    let bottom = TOP + PANEL.1;
    let whole = x.ticks(8).into_iter().filter(|t| t.0.fract().abs() < 1e-9).collect();
    let rows = if panel == 0 { y.ticks(6) } else { y.decades(10) };
    ticked_frame(svg, (&x, &y), (whole, rows), 20.0);
    svg.text("mid", (left + PANEL.0 / 2.0, bottom + 42.0), "step");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn taken_steps_are_joined_and_refused_ones_are_not() {
        let step = |value, accepted| SearchStep { value, violation: 1e-3, accepted };
        let figure = StepsFigure {
            title: "steps".into(),
            quantity: "value < 1".into(),
            note: String::new(),
            steps: vec![step(0.1, true), step(0.5, false), step(0.2, true), step(f64::NAN, false)],
        };
        let svg = steps_chart(&figure);
        let line = svg.lines().find(|l| l.contains("polyline")).unwrap_or(&svg);
        let corners = line.split("points=\"").nth(1).unwrap().split('"').next().unwrap();
        assert_eq!(corners.split_whitespace().count(), 2, "{corners}");
        assert!(svg.contains("value &lt; 1") && !svg.contains("NaN"));
        assert!(!steps_chart(&StepsFigure { steps: Vec::new(), ..figure }).contains("NaN"));
    }
}
