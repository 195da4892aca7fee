//! `det A` of the platform without shared joints over the two offsets of equal-offset platforms.

use super::contour::ValueGrid;
use super::style::{PixelAxis, Svg};

/// One axis: an offset as a fraction `t` of the edge, shown as `t * scale`.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneAxis {
    /// Label, with the unit.
    pub label: String,
    /// Length of the edge in the unit of the axis; 1 shows fractions.
    pub scale: f64,
}

/// A point to mark, in fractions of the edges.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanePoint {
    /// Offset on the base edge.
    pub base: f64,
    /// Offset on the platform edge.
    pub platform: f64,
    /// The label beside the mark.
    pub label: String,
}

/// The contents of the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct OffsetPlane {
    /// Title.
    pub title: String,
    /// A line of text below the plot.
    pub note: String,
    /// Offsets on the base edges, to the right.
    pub base: PlaneAxis,
    /// Offsets on the platform edges, upwards.
    pub platform: PlaneAxis,
    /// Words for the singular line, for instance `Delta1 / 12 + Delta2 / 6 = 1`.
    pub singular_label: String,
    /// Marked points.
    pub points: Vec<PlanePoint>,
}

// the layout in pixels: sizes, and positions from the left and the top
const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 640.0;
const LEFT: f64 = 80.0;
const RIGHT: f64 = 700.0;
const TOP: f64 = 78.0;
const BOTTOM: f64 = 536.0;
/// Grid points per side for the contour lines.
const GRID: usize = 141;
const LEVELS: [f64; 9] = [0.01, 0.05, 0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 20.0];
/// Distance of labels from the frame, from each other and from marks, pixels.
const CLEARANCE: f64 = 30.0;

/// Contour lines of `det A = (1 - t1)^3 (1 - t2)^3 - t1^3 t2^3`, with the line `t1 + t2 = 1` of its zeros. The offsets
/// are `t1` on the three base edges and `t2` on the three platform edges, as fractions of the edges.
///
/// The zero set is only this line: the two cubes are equal if `(1 - t1)(1 - t2) = t1 t2`. The range includes the edges
/// and all marked points. Source: Rojas, Borras, Thomas (2010), Fig. 8.
#[must_use]
pub fn determinant_plane(plane: &OffsetPlane) -> String {
    let (x, y) = ranges(&plane.points);
    let description = format!(
        "Contour lines of det A. It is zero on the line {}. Horizontal axis: {}. Vertical axis: {}.",
        plane.singular_label, plane.base.label, plane.platform.label
    );
    let mut svg = Svg::new(WIDTH, HEIGHT, &plane.title, &description);
    svg.text("title", (LEFT, 30.0), &plane.title);
    svg.text(
        "note",
        (LEFT, 50.0),
        "solid: det A > 0, dashed: det A < 0, dotted: ends of the edges, heavy line: det A = 0",
    );
    let line = singular_ends(&x, &y);
    regions(&mut svg, line, &x, &y);
    let placed_marks: Vec<(f64, f64)> =
        plane.points.iter().map(|p| (x.at(p.base), y.at(p.platform))).collect();
    edges(&mut svg, &x, &y);
    let obstacles = singular_obstacles(line, &placed_marks);
    contours(&mut svg, &x, &y, obstacles);
    if let Some([a, b]) = line {
        svg.named_line("singular-line", "singular", a, b);
        let degrees = (b.1 - a.1).atan2(b.0 - a.0).to_degrees();
        let at = (a.0 + 0.62 * (b.0 - a.0), a.1 + 0.62 * (b.1 - a.1));
        // a little above the line, across its direction
        let length = (b.0 - a.0).hypot(b.1 - a.1);
        let lift = ((b.1 - a.1) / length * 9.0, -(b.0 - a.0) / length * 9.0);
        let label = format!("det A = 0: {}", plane.singular_label);
        svg.turned_text("mid halo", (at.0 + lift.0, at.1 + lift.1), degrees, &label);
    }
    marks(&mut svg, &plane.points, &placed_marks);
    frame(&mut svg, &x, &y, plane);
    svg.text("note", (LEFT, HEIGHT - 22.0), &plane.note);
    svg.finish()
}

/// Both axes in fractions: the edges and all points, with a margin, rounded outwards to tenths.
fn ranges(points: &[PlanePoint]) -> (PixelAxis, PixelAxis) {
    let range = |pick: fn(&PlanePoint) -> f64| {
        let values = points.iter().map(pick).filter(|v| v.is_finite());
        let (low, high) = values.fold((0.0f64, 1.0f64), |r, v| (r.0.min(v), r.1.max(v)));
        let out = |x: f64, edge: bool| if edge { 0.0 } else { x };
        (
            ((low - out(0.08, low >= 0.0)) * 10.0).floor() / 10.0,
            ((high + out(0.08, high <= 1.0)) * 10.0).ceil() / 10.0,
        )
    };
    let (bx, by) = (range(|p| p.base), range(|p| p.platform));
    (
        PixelAxis { low: bx.0, high: bx.1, from: LEFT, to: RIGHT },
        PixelAxis { low: by.0, high: by.1, from: BOTTOM, to: TOP },
    )
}

/// Intersections of `t1 + t2 = 1` with the frame, from left to right on the page.
fn singular_ends(x: &PixelAxis, y: &PixelAxis) -> Option<[(f64, f64); 2]> {
    let (from, to) = (x.low.max(1.0 - y.high), x.high.min(1.0 - y.low));
    (from < to).then(|| [from, to].map(|t| (x.at(t), y.at(1.0 - t))))
}

/// Tints: `det A > 0` below the singular line, `< 0` above it.
fn regions(svg: &mut Svg, line: Option<[(f64, f64); 2]>, x: &PixelAxis, y: &PixelAxis) {
    svg.rect("negative", (LEFT, TOP), (RIGHT - LEFT, BOTTOM - TOP));
    let Some([a, b]) = line else { return };
    let mut corners = vec![a, b];
    if x.high + y.low < 1.0 {
        corners.push((RIGHT, BOTTOM));
    }
    corners.push((LEFT, BOTTOM));
    if a.0 > LEFT {
        corners.push((LEFT, TOP));
    }
    corners.dedup();
    svg.polygon("positive", &corners);
}

fn edges(svg: &mut Svg, x: &PixelAxis, y: &PixelAxis) {
    for t in [0.0, 1.0] {
        if x.low < t && t < x.high {
            svg.line("edge", (x.at(t), TOP), (x.at(t), BOTTOM));
        }
        if y.low < t && t < y.high {
            svg.line("edge", (LEFT, y.at(t)), (RIGHT, y.at(t)));
        }
    }
}

/// Points that labels avoid: the marks with their labels, and the label of the singular line.
fn singular_obstacles(line: Option<[(f64, f64); 2]>, marks: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut out: Vec<(f64, f64)> =
        marks.iter().flat_map(|m| (-5..=5).map(|k| (m.0 + 30.0 * f64::from(k), m.1))).collect();
    if let Some([a, b]) = line {
        out.extend(
            (0..=40).map(|k| f64::from(k) / 40.0).map(|s| (a.0 + s * (b.0 - a.0), a.1 + s * (b.1 - a.1))),
        );
    }
    out
}

fn contours(svg: &mut Svg, x: &PixelAxis, y: &PixelAxis, mut taken: Vec<(f64, f64)>) {
    let place = |axis: &PixelAxis, k: f64| axis.low + k / (GRID as f64 - 1.0) * (axis.high - axis.low);
    let det = |t1: f64, t2: f64| ((1.0 - t1) * (1.0 - t2)).powi(3) - (t1 * t2).powi(3);
    let values =
        (0..GRID * GRID).map(|k| det(place(x, (k % GRID) as f64), place(y, (k / GRID) as f64))).collect();
    let grid = ValueGrid { columns: GRID, rows: GRID, values };
    let mut labels = Vec::new();
    for level in LEVELS.iter().flat_map(|l| [*l, -l]) {
        let lines: Vec<Vec<(f64, f64)>> = grid
            .contour(level)
            .into_iter()
            .map(|line| line.into_iter().map(|(i, j)| (x.at(place(x, i)), y.at(place(y, j)))).collect())
            .collect();
        for line in &lines {
            svg.polyline(if level > 0.0 { "level" } else { "below" }, line);
        }
        if let Some(at) = free_place(&lines, &taken) {
            taken.push(at);
            labels.push((at, format!("{level}").replace('-', "\u{2212}")));
        }
    }
    for (at, label) in labels {
        let width = 7.0 * label.chars().count() as f64 + 4.0;
        svg.rect("plate", (at.0 - width / 2.0, at.1 - 7.0), (width, 14.0));
        svg.text("mid note", (at.0, at.1 + 4.0), &label);
    }
}

/// The vertex of the lines that is farthest from all taken points; none if all are too close.
fn free_place(lines: &[Vec<(f64, f64)>], taken: &[(f64, f64)]) -> Option<(f64, f64)> {
    let clearance = |p: &(f64, f64)| {
        let frame = (p.0 - LEFT).min(RIGHT - p.0).min((p.1 - TOP).min(BOTTOM - p.1) * 1.6);
        taken.iter().map(|q| (p.0 - q.0).hypot(p.1 - q.1)).fold(frame, f64::min)
    };
    let best = lines.iter().flatten().max_by(|a, b| clearance(a).total_cmp(&clearance(b)))?;
    (clearance(best) >= CLEARANCE).then_some(*best)
}

fn marks(svg: &mut Svg, points: &[PlanePoint], places: &[(f64, f64)]) {
    let mut labels: Vec<(f64, f64)> = Vec::new();
    let mut downwards: Vec<_> = points.iter().zip(places).collect();
    downwards.sort_by(|a, b| a.1.1.total_cmp(&b.1.1));
    for (p, at) in downwards {
        svg.circle("mark", *at, 5.0);
        let right = at.0 < RIGHT - 150.0;
        let mut y = at.1 + 4.0;
        // marks close together: their labels move down, one line each
        while labels.iter().any(|l| (l.0 - at.0).abs() < 140.0 && (l.1 - y).abs() < 14.0) {
            y += 15.0;
        }
        labels.push((at.0, y));
        let (class, x) = if right { ("halo", at.0 + 10.0) } else { ("halo end", at.0 - 10.0) };
        svg.text(class, (x, y), &p.label);
    }
}

fn frame(svg: &mut Svg, x: &PixelAxis, y: &PixelAxis, plane: &OffsetPlane) {
    let shown =
        |axis: &PixelAxis, scale: f64| PixelAxis { low: axis.low * scale, high: axis.high * scale, ..*axis };
    let (sx, sy) = (shown(x, plane.base.scale), shown(y, plane.platform.scale));
    super::style::frame(svg, &sx, &sy, (8, 8));
    svg.text("mid", (f64::midpoint(LEFT, RIGHT), BOTTOM + 44.0), &plane.base.label);
    svg.turned_text("mid", (26.0, f64::midpoint(TOP, BOTTOM)), -90.0, &plane.platform.label);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane(points: Vec<PlanePoint>) -> OffsetPlane {
        OffsetPlane {
            title: "det A".into(),
            note: "a < b".into(),
            base: PlaneAxis { label: "x [mm]".into(), scale: 12.0 },
            platform: PlaneAxis { label: "y [mm]".into(), scale: 6.0 },
            singular_label: "line".into(),
            points,
        }
    }

    #[test]
    fn the_singular_line_runs_from_corner_to_corner_of_the_unit_square() {
        let text = determinant_plane(&plane(Vec::new()));
        assert!(text.contains(&format!(
            "id=\"singular-line\" class=\"singular\" x1=\"{LEFT:.2}\" y1=\"{TOP:.2}\" x2=\"{RIGHT:.2}\" y2=\"{BOTTOM:.2}\""
        )));
        assert!(text.contains("a &lt; b") && text.contains(">12</text>") && text.contains(">6</text>"));
        assert_eq!(text, determinant_plane(&plane(Vec::new())));
    }

    #[test]
    fn the_range_holds_points_outside_the_edges() {
        let far = PlanePoint { base: -0.7, platform: 1.66, label: "here".into() };
        let (x, y) = ranges(std::slice::from_ref(&far));
        assert!((x.low + 0.8).abs() < 1e-9 && (y.high - 1.8).abs() < 1e-9);
        let text = determinant_plane(&plane(vec![far]));
        assert!(text.contains("singular-line") && text.contains(">here</text>"));
    }
}
