//! All values of a squared virtual length in the complex plane while one leg length varies.

mod follow;
mod pen;

pub use self::follow::{LocusMeeting, LocusStep, LocusValue, locus_meetings};

use self::follow::{Links, Sides, links, sides};
use self::pen::Pen;
use super::axis::Axis;
use super::style::Svg;

/// What the picture shows.
#[derive(Debug, Clone, PartialEq)]
pub struct LocusFigure {
    /// Title.
    pub title: String,
    /// A line of text below.
    pub note: String,
    /// The quantity in the plane, for the axes.
    pub quantity: String,
    /// The length that varies, for the legend.
    pub parameter: String,
    /// The values, in the order of the lengths.
    pub steps: Vec<LocusStep>,
}

const LEFT: f64 = 74.0;
const TOP: f64 = 116.0;
const PANEL: (f64, f64) = (470.0, 440.0);
const BETWEEN: f64 = 90.0;
const HEIGHT: f64 = TOP + PANEL.1 + 84.0;
/// Colours along the length; dark to light, so that their order shows without colour too.
const CLASSES: usize = 8;
const STYLE: &str = "\
.along{fill:none;stroke-width:1.3;stroke-linejoin:round}.on{stroke-width:3}\
.c0{stroke:#30123b}.c1{stroke:#3b2f8f}.c2{stroke:#2c5f9e}.c3{stroke:#1f8a8c}.c4{stroke:#37a866}.c5{stroke:#8fb93b}.c6{stroke:#dba520}.c7{stroke:#f06b22}\
.zero{stroke:#1a1a1a;stroke-width:.8;stroke-dasharray:2 2}.met{fill:#fff;stroke:#b00020;stroke-width:1.6}";
/// One in so many values may lie outside of the first panel on each side.
const OUTLIERS: usize = 50;
/// The second panel is wider by this part of the range of real poses on each side.
const AROUND: f64 = 0.35;

/// The plane with one curve a value, coloured by the length: heavy where the pose is real, start hollow, end filled, double values on the
/// axis as diamonds. Two panels: nearly all values, and the neighbourhood of those of real poses.
#[must_use]
pub fn locus_chart(figure: &LocusFigure) -> String {
    let steps: Vec<Sides> = figure.steps.iter().map(sides).collect();
    let links: Vec<Links> = steps.windows(2).map(|pair| links(&pair[0], &pair[1])).collect();
    let panels = panels(&steps);
    let ends = [figure.steps.first(), figure.steps.last()].map(|s| s.map_or(0.0, |s| s.length));
    let description = format!(
        "Complex plane of {}. One curve a pose while {} goes from {} to {}.",
        figure.quantity, figure.parameter, ends[0], ends[1]
    );
    let width = LEFT
        + 24.0
        + panels.iter().map(|p| p.x.to - p.x.from).sum::<f64>()
        + BETWEEN * (panels.len() - 1) as f64;
    let mut svg = Svg::new(width, HEIGHT, &figure.title, &description);
    svg.style(STYLE);
    svg.text("title", (LEFT, 30.0), &figure.title);
    legend(&mut svg, figure, ends);
    for (panel, title) in panels.iter().zip(["", "near the real poses"]) {
        svg.text("note", (panel.x.from, TOP - 8.0), title);
        curves(&mut svg, panel, &steps, &links);
        frame(&mut svg, panel, &figure.quantity);
    }
    let outside = steps.iter().flat_map(points).filter(|p| !panels[0].holds(*p)).count();
    let note = if outside > 0 {
        format!("{}; {outside} values lie outside", figure.note)
    } else {
        figure.note.clone()
    };
    svg.text("note", (LEFT, HEIGHT - 14.0), &note);
    svg.finish()
}

/// A part of the plane and its place on the page.
struct Panel {
    x: Axis,
    y: Axis,
}

impl Panel {
    fn new(place: usize, across: (f64, f64), high: f64) -> Self {
        let left = LEFT + place as f64 * (PANEL.0 + BETWEEN);
        Self {
            x: Axis { low: across.0, high: across.1, from: left, to: left + PANEL.0 },
            y: Axis { low: -high, high, from: TOP + PANEL.1, to: TOP },
        }
    }

    fn at(&self, p: (f64, f64)) -> (f64, f64) {
        (self.x.at(p.0), self.y.at(p.1))
    }

    fn holds(&self, p: (f64, f64)) -> bool {
        (self.x.low..=self.x.high).contains(&p.0) && (self.y.low..=self.y.high).contains(&p.1)
    }
}

fn points(s: &Sides) -> Vec<(f64, f64)> {
    let above = s.above.iter().flat_map(|p| [*p, (p.0, -p.1)]);
    s.axis.iter().map(|a| (a.0, 0.0)).chain(above).collect()
}

/// One that holds all but a few values; one about those of real poses, when that is much less.
fn panels(steps: &[Sides]) -> Vec<Panel> {
    let all: Vec<(f64, f64)> = steps.iter().flat_map(points).collect();
    let real: Vec<f64> = steps.iter().flat_map(|s| &s.axis).filter(|a| a.1).map(|a| a.0).collect();
    let middle = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        let most = values.len().saturating_sub(1);
        let off = most / OUTLIERS;
        (values.get(off).copied().unwrap_or(-1.0), values.get(most - off).copied().unwrap_or(1.0))
    };
    let wider = |r: (f64, f64), part: f64| {
        let margin = (part * (r.1 - r.0)).max(1e-9 * r.0.abs().max(r.1.abs())).max(f64::MIN_POSITIVE);
        (r.0 - margin, r.1 + margin)
    };
    let across = wider(
        real.iter().fold(middle(all.iter().map(|p| p.0).collect()), |r, v| (r.0.min(*v), r.1.max(*v))),
        0.06,
    );
    let up = wider(middle(all.iter().map(|p| p.1).collect()), 0.06);
    // never flat
    let high = |up: f64, across: (f64, f64)| up.max(0.02 * (across.1 - across.0));
    let mut out = vec![Panel::new(0, across, high(up.1.max(-up.0), across))];
    let ends = real.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |r, v| (r.0.min(*v), r.1.max(*v)));
    let close = wider(ends, AROUND);
    if ends.0 < ends.1 && close.1 - close.0 < 0.5 * (across.1 - across.0) {
        let beside = all.iter().filter(|p| close.0 < p.0 && p.0 < close.1).map(|p| p.1.abs());
        let limit = 0.5 * (close.1 - close.0);
        let up = beside.filter(|y| *y < limit).fold(0.0, f64::max);
        out.push(Panel::new(1, close, high(1.1 * up, close)));
    }
    out
}

/// All curves and marks of one panel.
fn curves(svg: &mut Svg, panel: &Panel, steps: &[Sides], links: &[Links]) {
    if panel.y.low < 0.0 && panel.y.high > 0.0 {
        svg.line("zero", (panel.x.from, panel.y.at(0.0)), (panel.x.to, panel.y.at(0.0)));
    }
    let mut pen = Pen::default();
    for (k, (pair, links)) in steps.windows(2).zip(links).enumerate() {
        pen.next_step();
        draw(&mut pen, &pair[0], &pair[1], links, k * CLASSES / (steps.len() - 1), panel);
    }
    pen.draw(svg);
    for met in links.iter().flat_map(|l| &l.meetings).filter(|m| panel.holds((m.value, 0.0))) {
        diamond(svg, panel.at((met.value, 0.0)));
    }
    for (step, class, radius) in [(steps.first(), "hollow", 3.4), (steps.last(), "mark", 3.0)] {
        for p in step.iter().flat_map(|s| points(s)).filter(|p| panel.holds(*p)) {
            svg.circle(class, panel.at(p), radius);
        }
    }
}

/// The pieces of all curves between two steps.
fn draw(pen: &mut Pen, before: &Sides, after: &Sides, links: &Links, class: usize, panel: &Panel) {
    let mut piece = |on: bool, list: &[(f64, f64)]| {
        if list.iter().all(|p| panel.holds(*p)) {
            let list: Vec<(f64, f64)> = list.iter().map(|p| panel.at(*p)).collect();
            pen.piece(class, on, &list);
        }
    };
    for &(i, j) in &links.axis {
        let (p, q) = (before.axis[i], after.axis[j]);
        piece(p.1 && q.1, &[(p.0, 0.0), (q.0, 0.0)]);
    }
    for &(i, j) in &links.above {
        let (p, q) = (before.above[i], after.above[j]);
        piece(false, &[p, q]);
        piece(false, &[(p.0, -p.1), (q.0, -q.1)]);
    }
    for met in &links.meetings {
        let (two, one) = if met.axis_before { (before, after) } else { (after, before) };
        let at = (met.value, 0.0);
        let upper = one.above[met.above];
        for i in met.pair {
            let end = (two.axis[i].0, 0.0);
            piece(two.axis[i].1, &if met.axis_before { [end, at] } else { [at, end] });
        }
        for end in [upper, (upper.0, -upper.1)] {
            piece(false, &if met.axis_before { [at, end] } else { [end, at] });
        }
    }
}

fn diamond(svg: &mut Svg, at: (f64, f64)) {
    svg.polygon("met", &[(at.0, at.1 - 5.0), (at.0 + 5.0, at.1), (at.0, at.1 + 5.0), (at.0 - 5.0, at.1)]);
}

fn legend(svg: &mut Svg, figure: &LocusFigure, ends: [f64; 2]) {
    let y = 56.0;
    svg.text("note", (LEFT, y + 4.0), &format!("{} = {}", figure.parameter, round(ends[0])));
    let mut x =
        LEFT + 14.0 + 5.6 * (figure.parameter.chars().count() + 3 + round(ends[0]).chars().count()) as f64;
    for class in 0..CLASSES {
        svg.polyline(&format!("along on c{class}"), &[(x, y), (x + 18.0, y)]);
        x += 18.0;
    }
    svg.text("note", (x + 8.0, y + 4.0), &round(ends[1]));
    let x = LEFT;
    let y = 76.0;
    svg.circle("hollow", (x + 4.0, y), 3.4);
    svg.text("note", (x + 14.0, y + 4.0), "start");
    svg.circle("mark", (x + 60.0, y), 3.0);
    svg.text("note", (x + 70.0, y + 4.0), "end");
    diamond(svg, (x + 112.0, y));
    svg.text("note", (x + 124.0, y + 4.0), "double value on the real axis; heavy: the pose is real");
}

/// A number with at most six digits.
fn round(x: f64) -> String {
    let text = format!("{x:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    text.replace('-', "\u{2212}")
}

fn frame(svg: &mut Svg, panel: &Panel, quantity: &str) {
    let (x, y) = (&panel.x, &panel.y);
    let bottom = TOP + PANEL.1;
    svg.rect("frame", (x.from, TOP), PANEL);
    for (value, label) in x.ticks(6) {
        svg.line("tick", (x.at(value), bottom), (x.at(value), bottom + 5.0));
        svg.text("mid", (x.at(value), bottom + 20.0), &label);
    }
    for (value, label) in y.ticks(8) {
        svg.line("tick", (x.from - 5.0, y.at(value)), (x.from, y.at(value)));
        svg.text("end", (x.from - 9.0, y.at(value) + 4.0), &label);
    }
    svg.text("mid", (f64::midpoint(x.from, x.to), bottom + 42.0), &format!("Re {quantity}"));
    svg.turned_text("mid", (x.from - 54.0, f64::midpoint(TOP, bottom)), -90.0, &format!("Im {quantity}"));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(steps: Vec<LocusStep>) -> LocusFigure {
        LocusFigure {
            title: "locus".into(),
            note: "a < b".into(),
            quantity: "|b e|\u{b2}".into(),
            parameter: "leg 6".into(),
            steps,
        }
    }

    #[test]
    fn a_meeting_is_drawn_with_both_branches() {
        let value = |re: f64, im: f64| LocusValue { re, im, real: im.to_bits() << 1 == 0 };
        let first = LocusStep { length: 1.0, values: vec![value(-1.0, 0.0), value(1.0, 0.0)] };
        let second = LocusStep { length: 2.0, values: vec![value(0.0, -1.0), value(0.0, 1.0)] };
        let text = locus_chart(&figure(vec![first, second]));
        assert_eq!(text.matches("class=\"met\"").count(), 2, "one in the legend");
        assert_eq!(text.matches("class=\"along c0 on\"").count(), 2, "two on the axis");
        assert_eq!(text.matches("class=\"along c0\"").count(), 2, "two pieces off the axis");
        assert!(text.contains("a &lt; b") && !text.contains("outside"));
    }

    #[test]
    fn pictures_without_values_are_pictures() {
        let none = |length: f64| LocusStep { length, values: Vec::new() };
        for steps in [vec![], vec![none(1.0)], vec![none(1.0), none(2.0)]] {
            let text = locus_chart(&figure(steps));
            assert!(!text.contains("NaN") && !text.contains("inf"));
        }
        let far = LocusValue { re: f64::MAX, im: f64::INFINITY, real: false };
        let one = LocusStep { length: 1.0, values: vec![far, LocusValue { re: 3.0, im: 0.0, real: true }] };
        assert!(!locus_chart(&figure(vec![one.clone(), one])).contains("NaN"));
    }
}
