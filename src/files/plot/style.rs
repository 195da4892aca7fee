//! The common style of all pictures, and axes with round numbers.

use std::fmt::Write as _;

use num::names::changes_direction;

/// Classes used by the pictures. The palette is safe for colour-blind readers and differs in lightness.
const CSS: &str = "\
text{font-family:Helvetica,Arial,'Liberation Sans','DejaVu Sans',sans-serif;font-size:12px;fill:#1a1a1a}\
.title{font-size:15px;font-weight:bold}\
.note{font-size:11px;fill:#444}\
.mid{text-anchor:middle}\
.end{text-anchor:end}\
.frame{fill:none;stroke:#1a1a1a;stroke-width:1}\
.tick{stroke:#1a1a1a;stroke-width:1}\
.edge{stroke:#8a8a8a;stroke-width:0.8;stroke-dasharray:1 3;fill:none}\
.positive{fill:#e3eef9}\
.negative{fill:#fbeadb}\
.level{fill:none;stroke:#2b5c94;stroke-width:1.1}\
.below{fill:none;stroke:#a85a16;stroke-width:1.1;stroke-dasharray:6 3}\
.singular{fill:none;stroke:#b00020;stroke-width:2.6}\
.mark{fill:#1a1a1a;stroke:#fff;stroke-width:1.2}\
.hollow{fill:#fff;stroke:#1a1a1a;stroke-width:1.5}\
.base{fill:#d5d5d5;fill-opacity:.75;stroke:#555;stroke-width:1.1;stroke-linejoin:round}\
.platform{fill:#8fb8de;fill-opacity:.75;stroke:#1d4f82;stroke-width:1.3;stroke-linejoin:round}\
.leg{stroke:#1a1a1a;stroke-width:1;stroke-linecap:round}\
.virtual{stroke:#b00020;stroke-width:1.4;stroke-dasharray:5 3}\
.small{font-size:9px;fill:#444}\
.first{stroke:#b00020;stroke-width:2.4;stroke-linecap:round}\
.plate{fill:#fff;fill-opacity:.9}\
.pair{fill:none;stroke:#c4c4c4;stroke-width:1}\
text.halo{fill:#fff;stroke:#fff;stroke-width:4px;stroke-linejoin:round}";

/// The class of text on a white outline of itself.
const HALO: &str = "halo";

/// Fill colours of the limits of a workspace, one for each kind, by its code: the same in every picture. Pale tones
/// after a palette for colour-blind readers (P. Tol, 2021). Dark and light tones alternate, so that neighbours differ
/// in grey print too.
pub const LIMIT_FILLS: [(&str, &str); 34] = [
    ("min_leg_length", "#4477aa"),
    ("max_leg_length", "#ee9988"),
    ("base_cone_angle", "#228833"),
    ("platform_cone_angle", "#e8d98a"),
    ("base_first_angle", "#116644"),
    ("base_second_angle", "#c6dba0"),
    ("platform_first_angle", "#887711"),
    ("platform_second_angle", "#f2dfb5"),
    ("leg_clearance", "#aa3377"),
    ("keep_out", "#bfe3ee"),
    ("leg_force", "#cc6611"),
    ("leg_speed", "#d5b8d8"),
    ("base_spacing", "#667722"),
    ("platform_spacing", "#cbb9a0"),
    ("base_envelope", "#335566"),
    ("platform_envelope", "#99bbcc"),
    ("machine_envelope", "#117755"),
    ("base_hole_edge", "#553388"),
    ("platform_hole_edge", "#b7a6dd"),
    ("base_hole_gap", "#994455"),
    ("platform_hole_gap", "#eeaabb"),
    ("plate_clearance", "#225588"),
    ("payload_clearance", "#aaccee"),
    ("linear_stiffness", "#88ccaa"),
    ("angular_stiffness", "#773322"),
    ("natural_frequency", "#ddaa55"),
    ("min_rod_length", "#334488"),
    ("max_rod_length", "#f4c2b0"),
    ("crank_transmission", "#2a6b50"),
    ("crank_angle", "#e6cf70"),
    ("tip_angle", "#885577"),
    ("crank_torque", "#b5d6c0"),
    ("crank_speed", "#994411"),
    ("singular", "#777777"),
];

/// Text of an XML node or attribute; every foreign text in a picture passes through it.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in visible(text).chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c => out.push(c),
        }
    }
    out
}

/// The text as displayed: characters that XML 1.0 forbids, or that change the direction of a text, are replaced.
pub fn visible(text: &str) -> String {
    let hides = |c: char| c.is_control() && !matches!(c, '\t' | '\n' | '\r') || changes_direction(c);
    text.chars().map(|c| if hides(c) { '\u{fffd}' } else { c }).collect()
}

/// A coordinate with two decimals, never `-0.00`.
pub(super) fn px(x: f64) -> String {
    format!("{:.2}", (x * 100.0).round() / 100.0 + 0.0)
}

/// A document under construction.
#[derive(Debug)]
pub(super) struct Svg {
    out: String,
}

impl Svg {
    /// Opens a document of the given size with the title and description that screen readers use.
    pub(super) fn new(width: f64, height: f64, title: &str, description: &str) -> Self {
        let (w, h) = (px(width), px(height));
        let mut out = String::new();
        let _ = writeln!(
            out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" \
             role=\"img\" aria-labelledby=\"title desc\">\n<title id=\"title\">{}</title>\n\
             <desc id=\"desc\">{}</desc>\n<style>{CSS}</style>\n<rect width=\"{w}\" height=\"{h}\" fill=\"#fff\"/>",
            escape(title),
            escape(description)
        );
        Self { out }
    }

    /// Adds the classes of one kind of picture.
    pub(super) fn style(&mut self, css: &str) {
        let _ = writeln!(self.out, "<style>{css}</style>");
    }

    /// Text. The class `halo` draws a white outline as a separate text below it, since some viewers do not know
    /// `paint-order`.
    pub(super) fn text(&mut self, class: &str, at: (f64, f64), text: &str) {
        self.placed_text(class, at, "", text);
    }

    fn placed_text(&mut self, class: &str, at: (f64, f64), transform: &str, text: &str) {
        let (x, y, text) = (px(at.0), px(at.1), escape(text));
        let without: Vec<&str> = class.split(' ').filter(|c| *c != HALO).collect();
        let outline = format!("{class}\" aria-hidden=\"true");
        let classes = [class.split(' ').any(|c| c == HALO).then_some(outline), Some(without.join(" "))];
        for class in classes.into_iter().flatten() {
            let _ =
                writeln!(self.out, "<text class=\"{class}\" x=\"{x}\" y=\"{y}\"{transform}>{text}</text>");
        }
    }

    /// Text rotated by `degrees` about its anchor, clockwise on the page.
    pub(super) fn turned_text(&mut self, class: &str, at: (f64, f64), degrees: f64, text: &str) {
        let turn = format!(" transform=\"rotate({} {} {})\"", px(degrees), px(at.0), px(at.1));
        self.placed_text(class, at, &turn, text);
    }

    /// An element as given, with its texts escaped.
    pub(super) fn raw(&mut self, element: &str) {
        let _ = writeln!(self.out, "{element}");
    }

    pub(super) fn line(&mut self, class: &str, a: (f64, f64), b: (f64, f64)) {
        let _ = writeln!(
            self.out,
            "<line class=\"{class}\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>",
            px(a.0),
            px(a.1),
            px(b.0),
            px(b.1)
        );
    }

    pub(super) fn circle(&mut self, class: &str, at: (f64, f64), r: f64) {
        let (x, y) = (px(at.0), px(at.1));
        let _ = writeln!(self.out, "<circle class=\"{class}\" cx=\"{x}\" cy=\"{y}\" r=\"{}\"/>", px(r));
    }

    pub(super) fn rect(&mut self, class: &str, at: (f64, f64), size: (f64, f64)) {
        let _ = writeln!(
            self.out,
            "<rect class=\"{class}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>",
            px(at.0),
            px(at.1),
            px(size.0),
            px(size.1)
        );
    }

    pub(super) fn polygon(&mut self, class: &str, points: &[(f64, f64)]) {
        let _ = writeln!(self.out, "<polygon class=\"{class}\" points=\"{}\"/>", list(points));
    }

    pub(super) fn polyline(&mut self, class: &str, points: &[(f64, f64)]) {
        let _ = writeln!(self.out, "<polyline class=\"{class}\" points=\"{}\"/>", list(points));
    }

    /// A line with an id for programs.
    pub(super) fn named_line(&mut self, id: &str, class: &str, a: (f64, f64), b: (f64, f64)) {
        let _ = writeln!(
            self.out,
            "<line id=\"{id}\" class=\"{class}\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>",
            px(a.0),
            px(a.1),
            px(b.0),
            px(b.1)
        );
    }

    /// A line whose second end runs through `x` and `y`, lists separated by semicolons.
    pub(super) fn moving_line(
        &mut self,
        class: &str,
        (a, b): ((f64, f64), (f64, f64)),
        (x, y): (&str, &str),
        seconds: usize,
    ) {
        let _ = writeln!(
            self.out,
            "<line class=\"{class}\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\">\
             <animate attributeName=\"x2\" dur=\"{seconds}s\" repeatCount=\"indefinite\" values=\"{x}\"/>\
             <animate attributeName=\"y2\" dur=\"{seconds}s\" repeatCount=\"indefinite\" values=\"{y}\"/></line>",
            px(a.0),
            px(a.1),
            px(b.0),
            px(b.1)
        );
    }

    /// A polygon that runs through the given ones, all with the same number of corners.
    pub(super) fn moving_polygon(&mut self, class: &str, frames: &[Vec<(f64, f64)>], seconds: usize) {
        let first = frames.first().map_or(String::new(), |f| list(f));
        let values: Vec<String> = frames.iter().map(|f| list(f)).collect();
        let _ = writeln!(
            self.out,
            "<polygon class=\"{class}\" points=\"{first}\"><animate attributeName=\"points\" dur=\"{seconds}s\" \
             repeatCount=\"indefinite\" values=\"{}\"/></polygon>",
            values.join(";")
        );
    }

    pub(super) fn finish(mut self) -> String {
        self.out.push_str("</svg>\n");
        self.out
    }
}

fn list(points: &[(f64, f64)]) -> String {
    points.iter().map(|p| format!("{},{}", px(p.0), px(p.1))).collect::<Vec<_>>().join(" ")
}

/// A value on an axis, with its label.
pub(super) type Tick = (f64, String);

/// A linear axis: values `low..high` on pixels `from..to`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PixelAxis {
    pub(super) low: f64,
    pub(super) high: f64,
    pub(super) from: f64,
    pub(super) to: f64,
}

impl PixelAxis {
    /// Position of `value` on the page, pixels.
    pub(super) fn at(&self, value: f64) -> f64 {
        self.from + (value - self.low) / (self.high - self.low) * (self.to - self.from)
    }

    /// Distance of ticks: 1, 2 or 5 times a power of ten, at most `count` of them.
    pub(super) fn step(&self, count: usize) -> f64 {
        let rough = (self.high - self.low) / count.max(1) as f64;
        let power = 10f64.powf(rough.log10().floor());
        [1.0, 2.0, 5.0].into_iter().map(|m| m * power).find(|s| *s >= rough).unwrap_or(10.0 * power)
    }

    /// Tick values and labels, about `count` of them.
    pub(super) fn ticks(&self, count: usize) -> Vec<Tick> {
        let step = self.step(count);
        let decimals = (0..12usize).find(|k| step * 10f64.powf(*k as f64) > 0.999).unwrap_or(12);
        // slightly beyond the ends, so that rounding loses no tick there
        let (first, last) =
            ((self.low / step - 1e-9).ceil() as i64, (self.high / step + 1e-9).floor() as i64);
        (first..=last)
            .map(|k| {
                let value = k as f64 * step;
                (value, format!("{value:.decimals$}").replace('-', "\u{2212}"))
            })
            .collect()
    }

    /// Ticks of an axis of common logarithms: powers of ten, at most about `count` of them.
    pub(super) fn decades(&self, count: i64) -> Vec<Tick> {
        let (first, last) = (self.low.ceil() as i64, self.high.floor() as i64);
        let stride = (last - first).max(0) / count.max(1) + 1;
        // multiples of the stride, so that the exponents are the same on neighbouring pictures
        let on_grid = (first..=last).filter(|k| k.rem_euclid(stride) == 0);
        on_grid.map(|k| (k as f64, format!("10{}", superscript(k)))).collect()
    }
}

/// The frame of a plot with about this many ticks on either axis; `x` runs to the right, `y` upwards.
pub(super) fn frame(svg: &mut Svg, x: &PixelAxis, y: &PixelAxis, (across, up): (usize, usize)) {
    ticked_frame(svg, (x, y), (x.ticks(across), y.ticks(up)), 19.0);
}

/// A frame with these ticks at the bottom and on the left, the labels at the bottom this far below it.
pub(super) fn ticked_frame(
    svg: &mut Svg,
    (x, y): (&PixelAxis, &PixelAxis),
    (across, up): (Vec<Tick>, Vec<Tick>),
    below: f64,
) {
    svg.rect("frame", (x.from, y.to), (x.to - x.from, y.from - y.to));
    for (value, label) in across {
        svg.line("tick", (x.at(value), y.from), (x.at(value), y.from + 5.0));
        svg.text("mid", (x.at(value), y.from + below), &label);
    }
    for (value, label) in up {
        svg.line("tick", (x.from - 5.0, y.at(value)), (x.from, y.at(value)));
        svg.text("end", (x.from - 9.0, y.at(value) + 4.0), &label);
    }
}

/// The lines of the curves of a chart, in order.
pub(super) const LINES: [&str; 4] = ["level", "below", "virtual", "leg"];

/// Marks points of the curve with this number; the sizes are those of disc, ring and square.
pub(super) fn mark(svg: &mut Svg, kind: usize, at: (f64, f64), [disc, ring, square]: [f64; 3]) {
    match kind {
        0 => svg.circle("mark", at, disc),
        1 => svg.circle("hollow", at, ring),
        2 => svg.rect("hollow", (at.0 - square, at.1 - square), (2.0 * square, 2.0 * square)),
        _ => svg.polygon(
            "mark",
            &[(at.0, at.1 - 4.6), (at.0 + 4.6, at.1), (at.0, at.1 + 4.6), (at.0 - 4.6, at.1)],
        ),
    }
}

/// Names the curves in a row from the left; returns the end of the row.
pub(super) fn legend<'a>(
    svg: &mut Svg,
    left: f64,
    labels: impl Iterator<Item = &'a String>,
    sizes: [f64; 3],
) -> f64 {
    let mut x = left;
    for (kind, label) in labels.take(LINES.len()).enumerate() {
        svg.line(LINES[kind], (x, 50.0), (x + 34.0, 50.0));
        mark(svg, kind, (x + 17.0, 50.0), sizes);
        svg.text("", (x + 42.0, 54.0), label);
        x += 70.0 + 7.5 * label.chars().count() as f64;
    }
    x
}

fn superscript(k: i64) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |c: char| c.to_digit(10).map_or('⁻', |d| DIGITS[d as usize]);
    k.to_string().chars().map(digit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_cannot_break_out_of_the_document() {
        assert_eq!(escape("a<b> & \"c\"\u{1}"), "a&lt;b&gt; &amp; &quot;c&quot;\u{fffd}");
        assert_eq!((px(-0.001), px(1.005)), ("0.00".into(), "1.00".into()));
    }

    #[test]
    fn a_halo_is_a_text_below_the_text_in_any_viewer() {
        let mut svg = Svg::new(10.0, 10.0, "t", "d");
        svg.turned_text("small halo mid", (1.0, 2.0), 30.0, "home");
        svg.text("small", (1.0, 2.0), "plain");
        let text = svg.finish();
        let lines: Vec<&str> = text.lines().filter(|l| l.starts_with("<text")).collect();
        assert_eq!(
            lines[..2],
            [
                "<text class=\"small halo mid\" aria-hidden=\"true\" x=\"1.00\" y=\"2.00\" transform=\"rotate(30.00 1.00 2.00)\">home</text>",
                "<text class=\"small mid\" x=\"1.00\" y=\"2.00\" transform=\"rotate(30.00 1.00 2.00)\">home</text>"
            ]
        );
        assert_eq!(lines.len(), 3, "no halo, one text");
        assert!(!text.contains("paint-order"));
    }

    #[test]
    fn every_limit_has_a_colour_of_its_own() {
        for (k, (code, fill)) in LIMIT_FILLS.iter().enumerate() {
            assert!(LIMIT_FILLS[..k].iter().all(|(c, f)| c != code && f != fill), "{code}");
        }
    }

    #[test]
    fn decades_are_powers_of_ten() {
        let axis = PixelAxis { low: -12.5, high: 0.5, from: 0.0, to: 1.0 };
        let labels: Vec<String> = axis.decades(7).into_iter().map(|t| t.1).collect();
        assert_eq!(labels, ["10⁻¹²", "10⁻¹⁰", "10⁻⁸", "10⁻⁶", "10⁻⁴", "10⁻²", "10⁰"]);
        assert_eq!(PixelAxis { low: 0.2, high: 0.4, ..axis }.decades(7), []);
    }

    #[test]
    fn ticks_are_round_and_reach_the_ends() {
        let axis = PixelAxis { low: -0.3, high: 1.2, from: 0.0, to: 150.0 };
        let labels: Vec<String> = axis.ticks(8).into_iter().map(|t| t.1).collect();
        assert_eq!(labels, ["\u{2212}0.2", "0.0", "0.2", "0.4", "0.6", "0.8", "1.0", "1.2"]);
        assert!((axis.at(0.0) - 30.0).abs() < 1e-12);
        let axis = PixelAxis { low: 0.0, high: 12.0, from: 0.0, to: 1.0 };
        assert_eq!(axis.ticks(6).last().map(|t| t.1.clone()), Some("12".into()));
    }
}
