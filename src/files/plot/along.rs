//! A signed quantity along a path, with the pieces of proved sign.

use super::style::{PixelAxis, Svg, ticked_frame};

/// One straight part of the path.
#[derive(Debug, Clone, PartialEq)]
pub struct AlongPart {
    /// Parameter in `[0, 1]` and value, in order.
    pub values: Vec<(f64, f64)>,
    /// Pieces `(from, to, sign)`: `+1`, `-1`, or 0 without a proved sign.
    pub pieces: Vec<(f64, f64, i8)>,
}

/// The contents of the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct AlongFigure {
    /// Title.
    pub title: String,
    /// A line of text below.
    pub note: String,
    /// Label of the vertical axis.
    pub quantity: String,
    /// The parts, one after the other.
    pub parts: Vec<AlongPart>,
}

// the layout in pixels: sizes, and positions from the left and the top
const PANEL: (f64, f64) = (720.0, 340.0);
const LEFT: f64 = 84.0;
const TOP: f64 = 60.0;
const HEIGHT: f64 = 480.0;

/// The quantity over the path: a curve on backgrounds that show its proved sign, with a line for pieces without one.
#[must_use]
pub fn sign_along(figure: &AlongFigure) -> String {
    let parts = figure.parts.len().max(1) as f64;
    let all = || figure.parts.iter().flat_map(|p| &p.values).map(|v| v.1).filter(|v| v.is_finite());
    let (low, high) = all().fold((0.0f64, 0.0f64), |r, v| (r.0.min(v), r.1.max(v)));
    let margin = if high > low { 0.06 * (high - low) } else { 1.0 };
    let x = PixelAxis { low: 0.0, high: parts, from: LEFT, to: LEFT + PANEL.0 };
    let y = PixelAxis { low: low - margin, high: high + margin, from: TOP + PANEL.1, to: TOP };
    let description = format!("{} over the parameter of the path, with its proved sign.", figure.quantity);
    let mut svg = Svg::new(LEFT + PANEL.0 + 24.0, HEIGHT, &figure.title, &description);
    svg.text("title", (LEFT, 30.0), &figure.title);
    for (k, part) in figure.parts.iter().enumerate() {
        for (from, to, sign) in &part.pieces {
            let (a, b) = (x.at(k as f64 + from), x.at(k as f64 + to));
            match sign {
                1 => svg.rect("positive", (a, TOP), (b - a, PANEL.1)),
                -1 => svg.rect("negative", (a, TOP), (b - a, PANEL.1)),
                _ => svg.line("singular", (f64::midpoint(a, b), TOP), (f64::midpoint(a, b), TOP + PANEL.1)),
            }
        }
    }
    svg.line("tick", (x.from, y.at(0.0)), (x.to, y.at(0.0)));
    for (k, part) in figure.parts.iter().enumerate() {
        let finite = part.values.iter().filter(|v| v.1.is_finite());
        let points: Vec<(f64, f64)> = finite.map(|(u, v)| (x.at(k as f64 + u), y.at(*v))).collect();
        svg.polyline("level", &points);
    }
    frame(&mut svg, &x, &y, figure);
    svg.finish()
}

fn frame(svg: &mut Svg, x: &PixelAxis, y: &PixelAxis, figure: &AlongFigure) {
    let bottom = TOP + PANEL.1;
    // powers of ten go into the label, since det J of small platforms is tiny
    let power = y.high.abs().max(y.low.abs()).log10().floor();
    let scaled = PixelAxis { low: y.low / 10f64.powf(power), high: y.high / 10f64.powf(power), ..*y };
    ticked_frame(svg, (x, &scaled), (x.ticks(10), scaled.ticks(8)), 20.0);
    svg.text("", (x.from, TOP - 10.0), &format!("{} / 1e{power}", figure.quantity));
    svg.text("mid", (f64::midpoint(x.from, x.to), bottom + 42.0), "parameter of the path");
    svg.text("note", (LEFT, HEIGHT - 12.0), &figure.note);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn proved_signs_are_grounds_and_open_pieces_are_lines() {
        let part = AlongPart {
            values: vec![(0.0, 1e-7), (0.5, 0.0), (1.0, -2e-7)],
            pieces: vec![(0.0, 0.499, 1), (0.499, 0.501, 0), (0.501, 1.0, -1)],
        };
        let figure = AlongFigure {
            title: "a < b".into(),
            note: "note".into(),
            quantity: "det J".into(),
            parts: vec![part.clone(), part],
        };
        let text = sign_along(&figure);
        assert_eq!(text.matches("class=\"positive\"").count(), 2);
        assert_eq!(text.matches("class=\"negative\"").count(), 2);
        assert_eq!(text.matches("class=\"singular\"").count(), 2);
        assert!(text.contains("a &lt; b") && text.contains("det J / 1e-7"));
        let empty = sign_along(&AlongFigure { parts: Vec::new(), ..figure });
        assert!(!empty.contains("NaN") && !empty.contains("inf"), "{empty}");
    }
}
