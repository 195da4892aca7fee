//! The topologies of the class as a drawing: one small platform for each, in levels by number of joints.
//!
//! The drawing follows Rojas, Borras, Thomas, Fig. 6. In top view it shows a grey base triangle, a green platform
//! triangle rotated by 180 degrees, and the legs between them. Big dots are shared joints; dotted red lines connect
//! joints that must be collinear.

use std::fmt::Write as _;

use super::family::Family;
use super::hexagon::{HexagonPoint, JointLabel, edge};
use super::pattern::Pattern;

/// Width and height of the cell of one platform, and the margin of the page.
const CELL: (f64, f64) = (150.0, 190.0);
const MARGIN: f64 = 30.0;
/// Circumradius of the base and of the platform triangle.
const RADIUS: (f64, f64) = (56.0, 47.0);
/// Height of the drawing inside its cell; edges run in the space below.
const DRAWN: f64 = 138.0;

const STYLE: &str = "<style>\
text{font-family:sans-serif;font-size:10px;text-anchor:middle;fill:#222}\
.title{font-size:15px;font-weight:bold}\
.step{stroke:#b5b5b5;stroke-width:1;fill:none}\
.jump{stroke:#666;stroke-width:1.2;stroke-dasharray:5 4;fill:none}\
.card{fill:#fff;stroke:#d0d0d0}\
.base{fill:#eef1f5;stroke:#8a97a8;stroke-width:1}\
.platform{fill:#dfe8dd;fill-opacity:.75;stroke:#6f8a68;stroke-width:1}\
.leg{stroke:#1f4e8c;stroke-width:1.8}\
.align{stroke:#d22;stroke-width:1.6;stroke-dasharray:1.5 2.5}\
.joint{fill:#fff;stroke:#111;stroke-width:1}\
.shared{fill:#111}\
</style>";

/// Position of corner `i`, relative to the centre of the platform; y points down.
fn corner_at(i: usize) -> (f64, f64) {
    let (radius, degrees) = match i {
        0 => (RADIUS.0, 210.0),
        1 => (RADIUS.0, 90.0),
        2 => (RADIUS.0, 330.0),
        3 => (RADIUS.1, 150.0),
        4 => (RADIUS.1, 30.0),
        _ => (RADIUS.1, 270.0),
    };
    let (sin, cos) = f64::to_radians(degrees).sin_cos();
    (radius * cos, -radius * sin)
}

/// Position of a joint; a moved leg is drawn four tenths of the edge away from its original place.
fn joint_at(pattern: &Pattern, joint: JointLabel) -> (f64, f64) {
    match joint {
        JointLabel::Corner(i) => corner_at(i),
        JointLabel::OnEdge(o) => {
            let stays_at_start = pattern.legs()[o.side] == HexagonPoint::Inner(o);
            let t = if stays_at_start { 0.4 } else { 0.6 };
            let [x, y] = edge(o.side).map(corner_at);
            (x.0 + (y.0 - x.0) * t, x.1 + (y.1 - x.1) * t)
        }
    }
}

fn triangle(out: &mut String, class: &str, corners: [usize; 3]) {
    let points: Vec<String> =
        corners.iter().map(|i| corner_at(*i)).map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
    let _ = write!(out, "<polygon class=\"{class}\" points=\"{}\"/>", points.join(" "));
}

fn line(out: &mut String, class: &str, a: (f64, f64), b: (f64, f64)) {
    let _ = write!(
        out,
        "<line class=\"{class}\" x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\"/>",
        a.0, a.1, b.0, b.1
    );
}

/// One platform around the origin.
fn platform(out: &mut String, pattern: &Pattern) {
    triangle(out, "base", [0, 1, 2]);
    triangle(out, "platform", [3, 4, 5]);
    for joints in pattern.alignments() {
        if let [first, .., last] = joints.as_slice() {
            line(out, "align", joint_at(pattern, *first), joint_at(pattern, *last));
        }
    }
    for leg in pattern.legs() {
        let [a, b] = leg.joints().map(|j| joint_at(pattern, j));
        line(out, "leg", a, b);
    }
    let shared: Vec<JointLabel> = pattern.shared_joints().into_iter().map(|s| s.1).collect();
    for joint in pattern.joints().concat() {
        let (x, y) = joint_at(pattern, joint);
        let (class, r) = if shared.contains(&joint) { ("shared", 4.0) } else { ("joint", 2.4) };
        let _ = write!(out, "<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r}\"/>");
    }
}

/// Centres of the cells: levels from top to bottom, each ordered by the mean place of its predecessors.
fn layout(family: &Family) -> (Vec<(f64, f64)>, f64, f64) {
    let topologies = family.topologies();
    let level =
        |k: usize| topologies[k].topology.base_joints() + topologies[k].topology.platform_joints() - 6;
    let widest = (0..7).map(|l| (0..topologies.len()).filter(|k| level(*k) == l).count()).max().unwrap_or(1);
    let width = widest as f64 * CELL.0 + 2.0 * MARGIN;
    let mut centres = vec![(width / 2.0, 0.0); topologies.len()];
    for l in 0..7 {
        let mut row: Vec<(f64, usize)> = (0..topologies.len())
            .filter(|k| level(*k) == l)
            .map(|k| {
                let above: Vec<f64> = (0..topologies.len())
                    .filter(|j| topologies[*j].next.contains(&k))
                    .map(|j| centres[j].0)
                    .collect();
                let mean = above.iter().sum::<f64>() / above.len().max(1) as f64;
                (if above.is_empty() { width / 2.0 } else { mean }, k)
            })
            .collect();
        row.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let left = (width - row.len() as f64 * CELL.0) / 2.0;
        for (place, (_, k)) in row.iter().enumerate() {
            centres[*k] = (left + (place as f64 + 0.5) * CELL.0, 66.0 + (l as f64 + 0.5) * CELL.1);
        }
    }
    (centres, width, 66.0 + 7.0 * CELL.1 + MARGIN)
}

impl Family {
    /// The drawing as a self-contained SVG document.
    #[must_use]
    pub fn to_svg(&self) -> String {
        let (centres, width, height) = layout(self);
        let mut out = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" \
             width=\"{width:.0}\" height=\"{height:.0}\">\n{STYLE}\n<rect width=\"100%\" height=\"100%\" fill=\"#fafafa\"/>\n\
             <text class=\"title\" x=\"{:.0}\" y=\"28\">Topologies equivalent to the octahedral platform</text>\n\
             <text x=\"{:.0}\" y=\"46\">one offset more on each level; black dots are shared joints, \
             dotted red lines join joints that must be aligned</text>\n",
            width / 2.0,
            width / 2.0
        );
        let (up, down) = (-DRAWN / 2.0 - 14.0, DRAWN / 2.0 + 8.0);
        for (k, t) in self.topologies().iter().enumerate() {
            for next in &t.next {
                let (a, b) = (centres[k], centres[*next]);
                line(&mut out, "step", (a.0, a.1 + down), (b.0, b.1 + up));
                out.push('\n');
            }
            if !t.sequential {
                jump(&mut out, centres[0], centres[k], width);
            }
        }
        for (t, (x, y)) in self.topologies().iter().zip(&centres) {
            let _ = write!(out, "<g transform=\"translate({x:.1},{y:.1})\">");
            let _ = write!(
                out,
                "<rect class=\"card\" x=\"-68\" y=\"{up:.0}\" width=\"136\" height=\"{:.0}\" rx=\"6\"/>",
                down - up
            );
            out.push_str("<g transform=\"translate(0,-6)\">");
            platform(&mut out, &t.example);
            out.push_str("</g>");
            let _ = write!(out, "<text y=\"56\">{}</text>", t.example);
            let (base, top) = (t.topology.base_joints(), t.topology.platform_joints());
            let _ = writeln!(out, "<text y=\"70\">{base} + {top} joints</text></g>");
        }
        out.push_str("</svg>\n");
        out
    }
}

/// The dashed edge to the topology that no sequence of moves reaches.
fn jump(out: &mut String, from: (f64, f64), to: (f64, f64), width: f64) {
    let right = width - 12.0;
    let _ = writeln!(
        out,
        "<path class=\"jump\" d=\"M{:.1} {:.1} H{right:.1} V{:.1} H{:.1}\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\">all six offsets at once</text>",
        from.0 + 68.0,
        from.1,
        to.1,
        to.0 + 68.0,
        f64::midpoint(to.0 + 68.0, right),
        to.1 - 6.0
    );
}
