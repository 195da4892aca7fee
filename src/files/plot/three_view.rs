//! Top, front and side of a platform, third angle.

use nalgebra::{Point2, Point3};

use super::labels::{Labels, PageBox, centred_text_box, text_box};
use super::style::Svg;
use platform::geom::convex_hull;

/// Base or platform in the drawing; points in the base frame, millimetres.
#[derive(Debug, Clone, PartialEq)]
pub struct ThreeViewBody {
    /// Points whose convex hulls are the parts: plate, posts.
    pub solids: Vec<Vec<Point3<f64>>>,
    /// Edges of the holes.
    pub holes: Vec<Vec<Point3<f64>>>,
    /// Names and centres of the joints.
    pub joints: Vec<(String, Point3<f64>)>,
    /// Diameter of the balls of the joints.
    pub ball: f64,
}

/// The contents of the drawing; points in the base frame, millimetres.
#[derive(Debug, Clone, PartialEq)]
pub struct ThreeViewFigure {
    /// Title.
    pub title: String,
    /// A line of text below.
    pub note: String,
    /// The base.
    pub base: ThreeViewBody,
    /// The platform.
    pub platform: ThreeViewBody,
    /// Ends of the legs: base joint, platform joint.
    pub legs: [[Point3<f64>; 2]; 6],
    /// Points whose convex hulls are the cylinders and rods.
    pub leg_bodies: Vec<Vec<Point3<f64>>>,
    /// Origins of the base and the platform frame.
    pub origins: [Point3<f64>; 2],
}

/// Width and height of the largest view, pixels.
const VIEW: f64 = 320.0;
// the layout in pixels: sizes, and positions from the left and the top
const MARGIN: f64 = 60.0;
const TOP: f64 = 70.0;
const CSS: &str = "\
.post{fill:#fff;fill-opacity:.5;stroke:#555;stroke-width:.7}\
.hole{fill:#fff;stroke:#555;stroke-width:.7}\
.bar{fill:#e8e4da;fill-opacity:.7;stroke:#6b6350;stroke-width:.7}\
.ball{fill:#fff;fill-opacity:.6;stroke:#1a1a1a;stroke-width:.8}\
.axis{stroke:#1a1a1a;stroke-width:.5;stroke-dasharray:7 2 1.5 2}\
.leader{stroke:#444;stroke-width:.5}";
/// Sizes of the fonts of labels, notes and title, as in the style.
const SMALL: f64 = 9.0;
const TITLE: f64 = 15.0;
const NOTE: f64 = 11.0;
/// Possible places of its number along a leg: on the rod, on the cylinder, towards the ends.
const ALONG: [f64; 9] = [0.5, 0.6, 0.4, 0.7, 0.3, 0.8, 0.2, 0.55, 0.45];

/// Axes of the three views: right and up. The top view is above the front view, the view from the right beside it.
const VIEWS: [(&str, usize, usize); 3] =
    [("top (x right, y up)", 0, 1), ("front (x right, z up)", 0, 2), ("right (y right, z up)", 1, 2)];

/// Least and greatest coordinates of all drawn parts.
fn bounds(figure: &ThreeViewFigure) -> [(f64, f64); 3] {
    let bodies = [&figure.base, &figure.platform];
    let solids = bodies.into_iter().flat_map(|b| &b.solids).chain(&figure.leg_bodies).flatten();
    let joints = bodies.into_iter().flat_map(|b| &b.joints).map(|j| &j.1);
    let mut out = [(f64::INFINITY, f64::NEG_INFINITY); 3];
    for p in solids.chain(joints).chain(&figure.origins) {
        for k in 0..3 {
            out[k] = (out[k].0.min(p[k]), out[k].1.max(p[k]));
        }
    }
    out
}

/// The drawing: silhouettes of all parts, one over the other. All views have the same scale and show the overall
/// dimensions. Joints, origins and legs have their names and numbers beside them, without overlaps if the page has
/// enough space.
#[must_use]
pub fn three_views(figure: &ThreeViewFigure) -> String {
    let bounds = bounds(figure);
    let extent = bounds.map(|b| b.1 - b.0);
    let scale = VIEW / extent.iter().fold(f64::MIN_POSITIVE, |m, x| m.max(*x));
    let [wide, deep, high] = extent.map(|x| x * scale);
    let (second_column, second_row) = (MARGIN + wide + MARGIN, TOP + deep + MARGIN + 20.0);
    let (width, height) = (second_column + deep + MARGIN, second_row + high + MARGIN + 20.0);
    let width = width.max(420.0);
    let mut svg = Svg::new(width, height, &figure.title, &figure.note);
    let mut labels = Labels::on((width, height), SMALL);
    svg.style(CSS);
    let title = (MARGIN, 28.0);
    svg.text("title", title, &figure.title);
    labels.keep(text_box(title, &figure.title, TITLE));
    let corners = [(MARGIN, TOP), (MARGIN, second_row), (second_column, second_row)];
    let mut named: Vec<((f64, f64), f64, &str)> = Vec::new();
    let mut numbered: Vec<Vec<(f64, f64)>> = Vec::new();
    for ((name, across, up), corner) in VIEWS.into_iter().zip(corners) {
        let place = |p: &Point3<f64>| {
            let (right, rise) = (p[across] - bounds[across].0, bounds[up].1 - p[up]);
            (corner.0 + right * scale, corner.1 + rise * scale)
        };
        svg.text("note", (corner.0, corner.1 - 10.0), name);
        labels.keep(text_box((corner.0, corner.1 - 10.0), name, NOTE));
        let silhouette = |points: &[Point3<f64>]| -> Vec<(f64, f64)> {
            let on_page: Vec<Point2<f64>> =
                points.iter().map(|p| Point2::from(<[f64; 2]>::from(place(p)))).collect();
            convex_hull(&on_page, 1e-3).iter().map(|p| (p.x, p.y)).collect()
        };
        for (class, body) in [("base", &figure.base), ("platform", &figure.platform)] {
            for (k, solid) in body.solids.iter().enumerate() {
                svg.polygon(if k == 0 { class } else { "post" }, &silhouette(solid));
            }
            for hole in &body.holes {
                svg.polygon("hole", &silhouette(hole));
            }
        }
        for bar in &figure.leg_bodies {
            svg.polygon("bar", &silhouette(bar));
        }
        for [a, b] in &figure.legs {
            let (from, to) = (place(a), place(b));
            svg.line("axis", from, to);
            let at = |share: f64| (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1));
            numbered.push(ALONG.map(at).to_vec());
        }
        for body in [&figure.base, &figure.platform] {
            for (label, p) in &body.joints {
                let at = place(p);
                let radius = 0.5 * body.ball * scale;
                svg.circle("ball", at, radius);
                labels.mark(at, radius);
                named.push((at, radius, label));
            }
        }
        for (label, origin) in ["O base", "O platform"].into_iter().zip(&figure.origins) {
            let (x, y) = place(origin);
            svg.line("tick", (x - 6.0, y), (x + 6.0, y));
            svg.line("tick", (x, y - 6.0), (x, y + 6.0));
            labels.mark((x, y), 6.0);
            named.push(((x, y), 6.0, label));
        }
        let (w, h) = (extent[across] * scale, extent[up] * scale);
        let below = corner.1 + h + 14.0;
        svg.line("tick", (corner.0, below), (corner.0 + w, below));
        let dimension = format!("{:.3}", extent[across]);
        svg.text("note mid", (corner.0 + 0.5 * w, below + 13.0), &dimension);
        labels.keep(centred_text_box((corner.0 + 0.5 * w, below + 13.0), &dimension, NOTE));
        let left = corner.0 - 14.0;
        svg.line("tick", (left, corner.1), (left, corner.1 + h));
        let dimension = format!("{:.3}", extent[up]);
        svg.turned_text("note mid", (left - 5.0, corner.1 + 0.5 * h), -90.0, &dimension);
        // rotated by a quarter: along the page is across the text
        let its = centred_text_box((corner.1 + 0.5 * h, left - 5.0), &dimension, NOTE);
        labels.keep(PageBox { left: its.top, right: its.bottom, top: its.left, bottom: its.right });
    }
    let note = (MARGIN, height - 12.0);
    svg.text("note", note, &figure.note);
    labels.keep(text_box(note, &figure.note, NOTE));
    // above all drawn parts
    for (at, radius, label) in named {
        labels.put_beside(at, radius, label);
    }
    for (k, points) in numbered.iter().enumerate() {
        labels.put_on(points, &(k % figure.legs.len() + 1).to_string());
    }
    for label in labels.finish() {
        if let Some([from, to]) = label.leader {
            svg.line("leader", from, to);
        }
        svg.text("small halo", label.at, &label.text);
    }
    svg.finish()
}
