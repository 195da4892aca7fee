//! All values of a squared virtual length in the complex plane while one leg length varies.
//!
//! Values are tracked from step to step, to join values of one curve and to find meetings on the real axis. Pieces of
//! curves are joined to strokes, which keeps the document short.

use super::style::{PixelAxis, Svg, ticked_frame};

/// The contents of the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct LocusFigure {
    /// Title.
    pub title: String,
    /// A line of text below.
    pub note: String,
    /// The quantity in the plane, for the axes.
    pub quantity: String,
    /// The varying length, for the legend.
    pub parameter: String,
    /// The values, in the order of the lengths.
    pub steps: Vec<LocusStep>,
}

// the layout in pixels: sizes, and positions from the left and the top
const LEFT: f64 = 74.0;
const TOP: f64 = 116.0;
const PANEL: (f64, f64) = (470.0, 440.0);
const BETWEEN: f64 = 90.0;
const HEIGHT: f64 = TOP + PANEL.1 + 84.0;
/// Colours along the length, from dark to light, so that their order is visible without colour.
const CLASSES: usize = 8;
const STYLE: &str = "\
.along{fill:none;stroke-width:1.3;stroke-linejoin:round}.on{stroke-width:3}\
.c0{stroke:#30123b}.c1{stroke:#3b2f8f}.c2{stroke:#2c5f9e}.c3{stroke:#1f8a8c}.c4{stroke:#37a866}.c5{stroke:#8fb93b}.c6{stroke:#dba520}.c7{stroke:#f06b22}\
.zero{stroke:#1a1a1a;stroke-width:.8;stroke-dasharray:2 2}.met{fill:#fff;stroke:#b00020;stroke-width:1.6}";
/// At most one in this many values lies outside of the first panel on each side.
const OUTLIERS: usize = 50;
/// Additional range of the second panel on each side, as a share of the range of real poses.
const AROUND: f64 = 0.35;

/// The plane with one curve per value, coloured by the length. Curves are heavy where the pose is real, with hollow
/// starts, filled ends, and diamonds for double values on the axis. Two panels: nearly all values, and the
/// neighbourhood of those of real poses.
#[must_use]
pub fn locus_chart(figure: &LocusFigure) -> String {
    let steps: Vec<SidesOfAxis> = figure.steps.iter().map(sides).collect();
    let links: Vec<Links> = steps.windows(2).map(|pair| links(&pair[0], &pair[1])).collect();
    let panels = panels(&steps);
    let ends = [figure.steps.first(), figure.steps.last()].map(|s| s.map_or(0.0, |s| s.length));
    let description = format!(
        "Complex plane of {}. One curve for each pose while {} goes from {} to {}.",
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
    x: PixelAxis,
    y: PixelAxis,
}

impl Panel {
    fn new(place: usize, across: (f64, f64), high: f64) -> Self {
        let left = LEFT + place as f64 * (PANEL.0 + BETWEEN);
        Self {
            x: PixelAxis { low: across.0, high: across.1, from: left, to: left + PANEL.0 },
            y: PixelAxis { low: -high, high, from: TOP + PANEL.1, to: TOP },
        }
    }

    fn at(&self, p: (f64, f64)) -> (f64, f64) {
        (self.x.at(p.0), self.y.at(p.1))
    }

    fn holds(&self, p: (f64, f64)) -> bool {
        (self.x.low..=self.x.high).contains(&p.0) && (self.y.low..=self.y.high).contains(&p.1)
    }
}

fn points(s: &SidesOfAxis) -> Vec<(f64, f64)> {
    let above = s.above.iter().flat_map(|p| [*p, (p.0, -p.1)]);
    s.axis.iter().map(|a| (a.0, 0.0)).chain(above).collect()
}

/// A panel with all but a few values, and one of those of real poses if that range is much smaller.
fn panels(steps: &[SidesOfAxis]) -> Vec<Panel> {
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
    // greater than zero in height
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
fn curves(svg: &mut Svg, panel: &Panel, steps: &[SidesOfAxis], links: &[Links]) {
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
fn draw(
    pen: &mut Pen,
    before: &SidesOfAxis,
    after: &SidesOfAxis,
    links: &Links,
    class: usize,
    panel: &Panel,
) {
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
    ticked_frame(svg, (x, y), (x.ticks(6), y.ticks(8)), 20.0);
    svg.text("mid", (f64::midpoint(x.from, x.to), bottom + 42.0), &format!("Re {quantity}"));
    svg.turned_text("mid", (x.from - 54.0, f64::midpoint(TOP, bottom)), -90.0, &format!("Im {quantity}"));
}

/// The values at one length.
#[derive(Debug, Clone, PartialEq)]
pub struct LocusStep {
    /// The varied length, design units.
    pub length: f64,
    /// Squared virtual lengths, one per pose; those not finite are skipped.
    pub values: Vec<LocusValue>,
}

/// One squared virtual length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocusValue {
    /// Real part, design units squared.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
    /// Whether the pose is real.
    pub real: bool,
}

/// A meeting of two real values.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, schemars::JsonSchema)]
#[schemars(rename = "LocusMeetingRecord", transform = num::nullable)]
pub struct LocusMeeting {
    // they leave the real axis or arrive on it: a double root in between
    /// Row before the meeting, from 0.
    #[serde(rename = "after_step")]
    pub after: usize,
    /// Interpolated length, design units.
    pub length: f64,
    /// Interpolated value.
    pub value: f64,
}

/// Values within this share of the largest of the step are one for the picture (poses that are mirror images).
const SAME: f64 = 1e-9;
/// The nearest value is the next one on the curve if every other is this much farther.
const CLEAR: f64 = 1.5;

/// One step with its values grouped by the side of the real axis.
struct SidesOfAxis {
    length: f64,
    /// Values on the real axis, ascending, with whether a pose is real.
    axis: Vec<(f64, bool)>,
    /// Values above it; the conjugates below are left out.
    above: Vec<(f64, f64)>,
}

fn sides(step: &LocusStep) -> SidesOfAxis {
    let finite = step.values.iter().filter(|v| v.re.is_finite() && v.im.is_finite());
    let values: Vec<&LocusValue> = finite.collect();
    let scale = values.iter().map(|v| v.re.hypot(v.im)).fold(0.0, f64::max);
    let near = |d: f64| d <= SAME * scale;
    let mut out = SidesOfAxis { length: step.length, axis: Vec::new(), above: Vec::new() };
    for v in values {
        if v.real || near(v.im.abs()) {
            match out.axis.iter_mut().find(|a| near((a.0 - v.re).abs())) {
                Some(known) => known.1 |= v.real,
                None => out.axis.push((v.re, v.real)),
            }
        } else if v.im > 0.0 && !out.above.iter().any(|a| near((a.0 - v.re).hypot(a.1 - v.im))) {
            out.above.push((v.re, v.im));
        }
    }
    out.axis.sort_by(|a, b| a.0.total_cmp(&b.0));
    out
}

/// The continuation of the values between two steps.
struct Links {
    /// Indices on the axis, before and after.
    axis: Vec<(usize, usize)>,
    /// Indices above the axis.
    above: Vec<(usize, usize)>,
    /// Two on the axis, one above; `before` tells whether the two are before the meeting.
    meetings: Vec<Met>,
}

/// A meeting with the indices of its values.
struct Met {
    pair: [usize; 2],
    above: usize,
    axis_before: bool,
    length: f64,
    value: f64,
}

fn links(before: &SidesOfAxis, after: &SidesOfAxis) -> Links {
    let real = |s: &SidesOfAxis| s.axis.iter().map(|a| (a.0, 0.0)).collect::<Vec<_>>();
    let (b, a) = (real(before), real(after));
    let axis = mutual(&b, &a);
    let above = mutual(&before.above, &after.above);
    let meetings = if before.axis.len() > after.axis.len() {
        meet(before, after, &axis, &above, true)
    } else {
        meet(after, before, &turned(&axis), &turned(&above), false)
    };
    Links { axis, above, meetings }
}

fn turned(pairs: &[(usize, usize)]) -> Vec<(usize, usize)> {
    pairs.iter().map(|p| (p.1, p.0)).collect()
}

/// Pairs of values, each the other's nearest by far.
fn mutual(before: &[(f64, f64)], after: &[(f64, f64)]) -> Vec<(usize, usize)> {
    let to: Vec<Option<usize>> = before.iter().map(|p| nearest(p, after)).collect();
    let back: Vec<Option<usize>> = after.iter().map(|p| nearest(p, before)).collect();
    let pair = |(i, j): (usize, &Option<usize>)| j.filter(|j| back[*j] == Some(i)).map(|j| (i, j));
    to.iter().enumerate().filter_map(pair).collect()
}

fn nearest(p: &(f64, f64), others: &[(f64, f64)]) -> Option<usize> {
    let distance = |q: &(f64, f64)| (p.0 - q.0).hypot(p.1 - q.1);
    let best = (0..others.len()).min_by(|i, j| distance(&others[*i]).total_cmp(&distance(&others[*j])))?;
    let limit = CLEAR * distance(&others[best]);
    let clear = others.iter().enumerate().all(|(k, q)| k == best || distance(q) >= limit);
    clear.then_some(best)
}

/// Values without a partner: two neighbours on the axis of one step and one above in the other. The square of half
/// their difference is smooth through the meeting and changes sign there, so interpolation finds it.
fn meet(
    two: &SidesOfAxis,
    one: &SidesOfAxis,
    axis: &[(usize, usize)],
    above: &[(usize, usize)],
    axis_before: bool,
) -> Vec<Met> {
    let mut free: Vec<usize> = (0..two.axis.len()).filter(|i| axis.iter().all(|p| p.0 != *i)).collect();
    let mut out = Vec::new();
    for k in (0..one.above.len()).filter(|k| above.iter().all(|p| p.1 != *k)) {
        let (re, im) = one.above[k];
        let middle = |i: usize| f64::midpoint(two.axis[free[i]].0, two.axis[free[i + 1]].0);
        let off = |i: &usize| (middle(*i) - re).abs();
        let Some(i) = (0..free.len().saturating_sub(1)).min_by(|i, j| off(i).total_cmp(&off(j))) else {
            break;
        };
        let half = 0.5 * (two.axis[free[i + 1]].0 - two.axis[free[i]].0);
        // too far apart for one step, so they belong to other curves
        if off(&i) > 2.0 * (half + im) {
            continue;
        }
        let t = half * half / (half * half + im * im);
        out.push(Met {
            pair: [free[i], free[i + 1]],
            above: k,
            axis_before,
            length: two.length + t * (one.length - two.length),
            value: middle(i) + t * (re - middle(i)),
        });
        free.drain(i..i + 2);
    }
    out
}

/// Meetings of values on the real axis, by interpolation between steps; unclear ones are left out.
#[must_use]
pub fn locus_meetings(steps: &[LocusStep]) -> Vec<LocusMeeting> {
    let sides: Vec<SidesOfAxis> = steps.iter().map(sides).collect();
    let mut out = Vec::new();
    for (after, pair) in sides.windows(2).enumerate() {
        let found = links(&pair[0], &pair[1]).meetings;
        out.extend(found.iter().map(|m| LocusMeeting { after, length: m.length, value: m.value }));
    }
    out
}

/// A stroke of one class.
struct Stroke {
    class: usize,
    heavy: bool,
    points: Vec<(f64, f64)>,
}

/// Strokes in the order of their starts.
#[derive(Default)]
struct Pen {
    strokes: Vec<Stroke>,
    /// Strokes that ended at the last step and may continue, and those of this step.
    open: [Vec<usize>; 2],
}

impl Pen {
    /// Begins the next step.
    fn next_step(&mut self) {
        self.open[0] = std::mem::take(&mut self.open[1]);
    }

    /// Adds a piece to the stroke that ends at its start, or as a new one.
    fn piece(&mut self, class: usize, heavy: bool, points: &[(f64, f64)]) {
        let [first, _, ..] = points else { return };
        let same = |p: (f64, f64), q: (f64, f64)| (p.0 - q.0).abs() + (p.1 - q.1).abs() < 1e-9;
        let goes_on = |k: &usize| {
            let s = &self.strokes[*k];
            s.class == class && s.heavy == heavy && s.points.last().is_some_and(|e| same(*e, *first))
        };
        let k = if let Some(k) = self.open[0].iter().copied().find(goes_on) {
            let stroke = &mut self.strokes[k].points;
            // invisible pieces are skipped, but the end keeps its place
            if let [.., p, q] = stroke[..]
                && (p.0 - q.0).hypot(p.1 - q.1) < 0.7
            {
                stroke.pop();
            }
            stroke.extend(&points[1..]);
            k
        } else {
            self.strokes.push(Stroke { class, heavy, points: points.to_vec() });
            self.strokes.len() - 1
        };
        self.open[1].push(k);
    }

    fn draw(self, svg: &mut Svg) {
        for s in self.strokes {
            svg.polyline(&format!("along c{}{}", s.class, if s.heavy { " on" } else { "" }), &s.points);
        }
    }
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

    /// Roots of `x^2 = t` beside one that stays.
    fn step(t: f64) -> LocusStep {
        let root = t.abs().sqrt();
        let value = |re: f64, im: f64| LocusValue { re, im, real: im.to_bits() << 1 == 0 };
        let pair = if t > 0.0 {
            [value(-root, 0.0), value(root, 0.0)]
        } else {
            [value(0.0, -root), value(0.0, root)]
        };
        LocusStep { length: t, values: vec![pair[0], value(9.0, 0.0), pair[1]] }
    }

    #[test]
    fn a_double_root_is_found_between_the_steps_in_both_directions() {
        let steps: Vec<LocusStep> = (0..10).map(|k| step(f64::from(k) - 4.3)).collect();
        let back: Vec<LocusStep> = steps.iter().rev().cloned().collect();
        for (list, after) in [(steps, 4), (back, 4)] {
            let found = locus_meetings(&list);
            assert_eq!(found.len(), 1, "{found:?}");
            assert_eq!(found[0].after, after);
            assert!(found[0].length.abs() < 1e-12 && found[0].value.abs() < 1e-12);
        }
    }

    #[test]
    fn values_that_stay_on_their_side_do_not_meet() {
        let steps: Vec<LocusStep> = (1..10).map(|k| step(f64::from(k))).collect();
        assert_eq!(locus_meetings(&steps), []);
        let none = LocusStep { length: 0.0, values: Vec::new() };
        assert_eq!(locus_meetings(&[step(1.0), none, step(-1.0)]), []);
    }

    #[test]
    fn equal_values_are_one_and_unclear_ones_are_not_linked() {
        let value = |re: f64, im: f64| LocusValue { re, im, real: false };
        let twice = sides(&LocusStep {
            length: 1.0,
            values: vec![value(2.0, 1.0), value(2.0, 1.0), value(3.0, 1e-12), value(f64::NAN, 0.0)],
        });
        assert_eq!((twice.above.len(), twice.axis.as_slice()), (1, [(3.0, false)].as_slice()));
        assert_eq!(mutual(&[(0.0, 1.0)], &[(0.1, 1.0), (-0.11, 1.0)]), []);
        assert_eq!(mutual(&[(0.0, 1.0)], &[(0.1, 1.0), (-0.9, 1.0)]), [(0, 0)]);
    }
}
