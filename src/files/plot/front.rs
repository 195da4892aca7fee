//! Platforms of which none is better than another in every objective.

use super::style::{PixelAxis, Svg, frame};

/// One objective.
#[derive(Debug, Clone, PartialEq)]
pub struct FrontAxis {
    /// Label, with the unit.
    pub label: String,
    /// Whether large values are better.
    pub is_gain: bool,
}

/// The contents of the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct FrontFigure {
    /// Title.
    pub title: String,
    /// A line of text below the plot.
    pub note: String,
    /// Two or three objectives.
    pub axes: Vec<FrontAxis>,
    /// Values of the members in the order of the axes.
    pub members: Vec<Vec<f64>>,
}

// the layout in pixels: sizes, and positions from the left and the top
const SIDE: f64 = 400.0;
const LEFT: f64 = 84.0;
const TOP: f64 = 62.0;
const GAP: f64 = 110.0;
const BELOW: f64 = 92.0;

/// One panel for each pair of objectives, members numbered from 1 in their order. The arrows at the axes point to
/// better values; a stepped line bounds the region that the members of a front of two objectives dominate.
#[must_use]
pub fn pareto_front(figure: &FrontFigure) -> String {
    let n = figure.axes.len();
    let pairs: Vec<(usize, usize)> = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))).collect();
    let width = LEFT + pairs.len() as f64 * (SIDE + GAP) - GAP + 40.0;
    let height = TOP + SIDE + BELOW;
    let names: Vec<&str> = figure.axes.iter().map(|a| a.label.as_str()).collect();
    let description = format!(
        "{} platforms, none better than another in every objective: {}. {}",
        figure.members.len(),
        names.join(", "),
        figure.note
    );
    let mut svg = Svg::new(width, height, &figure.title, &description);
    svg.style(".dominated{fill:none;stroke:#8a8a8a;stroke-width:1.2;stroke-dasharray:4 3}");
    svg.text("title", (LEFT, 32.0), &figure.title);
    for (k, pair) in pairs.iter().enumerate() {
        panel(&mut svg, figure, *pair, LEFT + k as f64 * (SIDE + GAP));
    }
    svg.text("note", (LEFT, height - 16.0), &figure.note);
    svg.finish()
}

/// The range of the values with a margin, also around a single value.
fn range(figure: &FrontFigure, k: usize) -> (f64, f64) {
    let values = figure.members.iter().map(|m| m[k]).filter(|x| x.is_finite());
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |r, x| (r.0.min(x), r.1.max(x)));
    if !low.is_finite() {
        return (0.0, 1.0);
    }
    let spread = high - low;
    let padding = if spread > 1e-9 * high.abs() { 0.08 * spread } else { 0.1 * high.abs().max(1e-9) };
    (low - padding, high + padding)
}

/// The label with an arrow towards better values; rotated labels run upwards.
fn directed(axis: &FrontAxis) -> String {
    if axis.is_gain {
        format!("{}, better \u{2192}", axis.label)
    } else {
        format!("\u{2190} better, {}", axis.label)
    }
}

fn panel(svg: &mut Svg, figure: &FrontFigure, (i, j): (usize, usize), left: f64) {
    let (rx, ry) = (range(figure, i), range(figure, j));
    let x = PixelAxis { low: rx.0, high: rx.1, from: left, to: left + SIDE };
    let y = PixelAxis { low: ry.0, high: ry.1, from: TOP + SIDE, to: TOP };
    frame(svg, &x, &y, (5, 6));
    let (ax, ay) = (&figure.axes[i], &figure.axes[j]);
    svg.text("mid", (left + SIDE / 2.0, TOP + SIDE + 42.0), &directed(ax));
    svg.turned_text("mid", (left - 62.0, TOP + SIDE / 2.0), -90.0, &directed(ay));
    if figure.axes.len() == 2 {
        steps(svg, figure, &x, &y);
    }
    for (k, m) in figure.members.iter().enumerate().filter(|(_, m)| m[i].is_finite() && m[j].is_finite()) {
        let at = (x.at(m[i]), y.at(m[j]));
        svg.circle("mark", at, 5.0);
        svg.text("halo", (at.0 + 8.0, at.1 - 6.0), &(k + 1).to_string());
    }
}

/// From member to member along the axes, over the corner that both dominate.
fn steps(svg: &mut Svg, figure: &FrontFigure, x: &PixelAxis, y: &PixelAxis) {
    let mut members: Vec<(f64, f64)> =
        figure.members.iter().map(|m| (m[0], m[1])).filter(|m| m.0.is_finite() && m.1.is_finite()).collect();
    members.sort_by(|a, b| a.0.total_cmp(&b.0));
    let worse = |a: f64, b: f64, is_gain: bool| if is_gain { a.min(b) } else { a.max(b) };
    let mut line = Vec::new();
    for (k, m) in members.iter().enumerate() {
        if let Some(before) = k.checked_sub(1).map(|k| members[k]) {
            line.push((
                worse(before.0, m.0, figure.axes[0].is_gain),
                worse(before.1, m.1, figure.axes[1].is_gain),
            ));
        }
        line.push(*m);
    }
    let line: Vec<(f64, f64)> = line.into_iter().map(|p| (x.at(p.0), y.at(p.1))).collect();
    svg.polyline("dominated", &line);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(objectives: usize) -> FrontFigure {
        let axis = |k: usize| FrontAxis { label: format!("objective {k}"), is_gain: k != 1 };
        FrontFigure {
            title: "t".into(),
            note: "n".into(),
            axes: (0..objectives).map(axis).collect(),
            members: (0..4).map(|m| (0..objectives).map(|k| (m * (k + 1)) as f64).collect()).collect(),
        }
    }

    #[test]
    fn every_pair_of_objectives_has_its_panel() {
        let two = pareto_front(&figure(2));
        assert_eq!((two.matches("class=\"frame\"").count(), two.matches("class=\"mark\"").count()), (1, 4));
        // three corners between four members, each where the worse values of both meet
        let line = two.split("class=\"dominated\" points=\"").nth(1).unwrap().split('"').next().unwrap();
        assert_eq!(line.split(' ').count(), 7);
        let three = pareto_front(&figure(3));
        assert_eq!(
            (three.matches("class=\"frame\"").count(), three.matches("class=\"mark\"").count()),
            (3, 12)
        );
        assert!(!three.contains("<polyline"));
    }

    #[test]
    fn one_member_has_padding_around_it() {
        let one = FrontFigure { members: vec![vec![2.0, 0.0]], ..figure(2) };
        assert!(!pareto_front(&one).contains("NaN"));
    }
}
