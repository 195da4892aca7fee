//! Joint-sharing topologies as diagrams: base polygon below, platform polygon above, legs, virtual legs dashed.
//!
//! The diagrams follow the tables of Porta and Thomas. Joints are evenly spaced on two circles in oblique view, in the
//! order of [`Topology::layout`]; only the graph is shown.

use super::style::Svg;
use platform::topology::{NamedTopology, Topology};

/// A topology and its caption.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TopologyFigure {
    /// The topology.
    pub topology: NamedTopology,
    /// One line.
    pub caption: String,
}

// the layout in pixels: sizes, and positions from the left and the top
const CELL: (f64, f64) = (168.0, 200.0);
const COLUMNS: usize = 6;
const MARGIN: f64 = 20.0;
const TOP: f64 = 70.0;
/// Least width, for the sentence below the title.
const LEAST_WIDTH: f64 = 640.0;
/// Half axes of the drawn circles, and the distances of their centres above and below the middle.
const BASE: (f64, f64) = (62.0, 20.0);
const PLATFORM: (f64, f64) = (46.0, 15.0);
const RISE: f64 = 40.0;
/// Number of rotations about the vertical, of which the clearest is taken.
const TURNS: u32 = 72;

/// Places of the joints of one body, and of their labels outside the polygon.
struct PolygonPlaces {
    joints: Vec<(f64, f64)>,
    labels: Vec<(f64, f64)>,
}

fn drawn(angles: &[f64], centre: (f64, f64), axes: (f64, f64), turn: f64) -> PolygonPlaces {
    let at = |angle: &f64, out: f64| {
        let (sine, cosine) = (angle + turn).sin_cos();
        (centre.0 + (axes.0 + out) * sine, centre.1 + (axes.1 + out) * cosine)
    };
    PolygonPlaces {
        joints: angles.iter().map(|a| at(a, 0.0)).collect(),
        labels: angles.iter().map(|a| at(a, 11.0)).map(|(x, y)| (x, y + 3.5)).collect(),
    }
}

/// The corners in their order on the circle.
fn outline(d: &PolygonPlaces, angles: &[f64]) -> Vec<(f64, f64)> {
    let turn = |i: &usize| angles[*i].rem_euclid(std::f64::consts::TAU);
    let mut order: Vec<usize> = (0..angles.len()).collect();
    order.sort_by(|i, j| turn(i).total_cmp(&turn(j)));
    order.into_iter().map(|i| d.joints[i]).collect()
}

/// The least of the sines of the angles between lines that share a joint, and of the distances of joints of one body.
fn clearness(base: &PolygonPlaces, platform: &PolygonPlaces, lines: &[(usize, usize)]) -> f64 {
    let mut least = f64::INFINITY;
    let direction = |(a, b): (usize, usize)| {
        let (from, to) = (base.joints[a], platform.joints[b]);
        let (x, y) = (to.0 - from.0, to.1 - from.1);
        (x / x.hypot(y), y / x.hypot(y))
    };
    for (i, one) in lines.iter().enumerate() {
        for other in lines[..i].iter().filter(|l| l.0 == one.0 || l.1 == one.1) {
            let (d, e) = (direction(*one), direction(*other));
            least = least.min((d.0 * e.1 - d.1 * e.0).abs());
        }
    }
    for body in [base, platform] {
        for (i, p) in body.joints.iter().enumerate() {
            for q in &body.joints[..i] {
                least = least.min((p.0 - q.0).hypot(p.1 - q.1) / 60.0);
            }
        }
    }
    least
}

fn diagram(svg: &mut Svg, t: Topology, centre: (f64, f64)) {
    let (layout, virtual_legs) = (t.layout(), t.trilateration().virtual_legs);
    let at = |turn: f64| {
        let base = drawn(&layout.base, (centre.0, centre.1 + RISE), BASE, turn);
        (base, drawn(&layout.platform, (centre.0, centre.1 - RISE), PLATFORM, turn))
    };
    let lines: Vec<(usize, usize)> = t.legs().into_iter().chain(virtual_legs.iter().copied()).collect();
    let turns = (0..TURNS).map(|k| std::f64::consts::TAU * f64::from(k) / f64::from(TURNS));
    let clearest = turns.map(at).map(|(b, p)| (clearness(&b, &p, &lines), b, p));
    // of equally clear ones the first, regardless of rounding
    let best = clearest.reduce(|x, y| if y.0 > x.0 + 1e-9 { y } else { x });
    let (base, platform) = best.map_or_else(|| at(0.0), |(_, b, p)| (b, p));
    svg.polygon("base", &outline(&base, &layout.base));
    for (a, b) in virtual_legs {
        svg.line("virtual", base.joints[a], platform.joints[b]);
    }
    for (a, b) in t.legs() {
        svg.line("leg", base.joints[a], platform.joints[b]);
    }
    svg.polygon("platform", &outline(&platform, &layout.platform));
    joints(svg, &base, 'A', t.legs().map(|l| l.0));
    joints(svg, &platform, 'B', t.legs().map(|l| l.1));
}

/// Dots and labels of one body; `ends` is the joint of each leg.
fn joints(svg: &mut Svg, body: &PolygonPlaces, letter: char, ends: [usize; 6]) {
    for (k, (joint, label)) in body.joints.iter().zip(&body.labels).enumerate() {
        let shared = ends.iter().filter(|end| **end == k).count() > 1;
        let (class, radius) = if shared { ("mark", 4.6) } else { ("hollow", 2.6) };
        svg.circle(class, *joint, radius);
        svg.text("small mid halo", *label, &format!("{letter}{}", k + 1));
    }
}

fn cell(svg: &mut Svg, figure: &TopologyFigure, corner: (f64, f64)) {
    let middle = corner.0 + CELL.0 / 2.0;
    svg.rect("pair", (corner.0 + 4.0, corner.1 + 4.0), (CELL.0 - 8.0, CELL.1 - 8.0));
    let name = format!("{}  {}", figure.topology.id(), figure.topology.name());
    svg.text("mid", (middle, corner.1 + 21.0), &name);
    diagram(svg, figure.topology.topology(), (middle, corner.1 + 101.0));
    svg.text("note mid", (middle, corner.1 + CELL.1 - 14.0), &figure.caption);
}

/// One topology.
#[must_use]
pub fn topology_diagram(figure: &TopologyFigure) -> String {
    let title = format!("Topology {}", figure.topology.id());
    let mut svg = Svg::new(
        CELL.0,
        CELL.1,
        &title,
        "platform above base; dots are shared joints, dashed lines virtual legs",
    );
    cell(&mut svg, figure, (0.0, 0.0));
    svg.finish()
}

/// Several topologies on one page.
#[must_use]
pub fn topology_sheet(title: &str, figures: &[TopologyFigure]) -> String {
    let note = "platform above base; dots are shared joints, dashed red lines the virtual legs of one trilateration sequence";
    let columns = figures.len().clamp(1, COLUMNS);
    let rows = figures.len().div_ceil(columns);
    let cells = columns as f64 * CELL.0;
    let (width, height) = ((cells + 2.0 * MARGIN).max(LEAST_WIDTH), TOP + rows as f64 * CELL.1 + MARGIN);
    let left = (width - cells) / 2.0;
    let mut svg = Svg::new(width, height, title, note);
    svg.text("title mid", (width / 2.0, 30.0), title);
    svg.text("note mid", (width / 2.0, 52.0), note);
    for (k, figure) in figures.iter().enumerate() {
        let (column, row) = (k % columns, k / columns);
        cell(&mut svg, figure, (left + column as f64 * CELL.0, TOP + row as f64 * CELL.1));
    }
    svg.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use platform::topology::catalogue;

    #[test]
    fn a_sheet_has_six_legs_and_every_joint_of_every_topology() {
        let list = catalogue();
        let figure = |t: &NamedTopology| TopologyFigure { topology: *t, caption: "a < b".into() };
        let figures: Vec<_> = list.iter().map(figure).collect();
        let sheet = topology_sheet("all", &figures);
        let joints: usize =
            list.iter().map(|t| t.topology().base_joints() + t.topology().platform_joints()).sum();
        assert_eq!(sheet.matches("class=\"leg\"").count(), 6 * 34);
        assert_eq!(sheet.matches("<circle").count(), joints);
        // 20 topologies with one virtual leg, three with two, one with three
        assert_eq!(sheet.matches("class=\"virtual\"").count(), 20 + 6 + 3);
        // a single one is centred, on a sheet as wide as its text
        let alone = topology_sheet("one", &figures[..1]);
        assert!(sheet.contains("viewBox=\"0 0 1048.00") && alone.contains("viewBox=\"0 0 640.00"));
        assert!(sheet.contains("a &lt; b") && topology_diagram(&figures[3]).contains("T04"));
    }
}
