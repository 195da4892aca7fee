//! Two platforms at one pose, side by side: equivalence in one picture.

use std::collections::BTreeMap;

use super::oblique::{BaseFrame, Bodies, Extent};
use super::style::Svg;
use platform::geom::Pose;
use platform::manipulator::Manipulator;

/// The contents of the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct PairFigure {
    /// Title.
    pub title: String,
    /// Names of the platforms.
    pub names: [String; 2],
    /// Lines between them, for instance the leg map.
    pub between: Vec<String>,
    /// A line of text below.
    pub note: String,
    /// The pose of both.
    pub pose: Pose,
}

/// Greatest width and height of a platform on the page, pixels.
const PANEL: (f64, f64) = (330.0, 330.0);
const MARGIN: f64 = 28.0;
/// Width of the space for the lines of text between the platforms.
const MIDDLE: f64 = 190.0;
const TOP: f64 = 92.0;

/// Both platforms in oblique projection in the base frame of the first, to the same scale. Joints shared by legs are
/// rings.
#[must_use]
pub fn platform_pair(platforms: [&Manipulator; 2], figure: &PairFigure) -> String {
    let frame = BaseFrame::of(platforms[0]);
    let drawn = platforms.map(|m| DrawnPlatform::new(m, &figure.pose, &frame));
    let extent = Extent::of(drawn.iter().flat_map(|d| d.bodies.corners()));
    let (across, up, scale) = (extent.across, extent.up, extent.scale(PANEL));
    let (wide, high) = ((across.1 - across.0) * scale, (up.1 - up.0) * scale);
    let width = 2.0 * MARGIN + 2.0 * wide + MIDDLE;
    let height = TOP + high + 74.0;
    let description = format!(
        "{} and {} at the same pose. {} {}",
        figure.names[0],
        figure.names[1],
        figure.between.join("; "),
        figure.note
    );
    let mut svg = Svg::new(width, height, &figure.title, &description);
    svg.style(".arrow{stroke:#2b5c94;stroke-width:2;fill:none}.tip{fill:#2b5c94}.law{font-size:14px;text-anchor:middle;fill:#2b5c94}.shared{fill:#fff;stroke:#b00020;stroke-width:2.4}");
    svg.text("title", (MARGIN, 32.0), &figure.title);
    for (k, d) in drawn.iter().enumerate() {
        let left = MARGIN + k as f64 * (wide + MIDDLE);
        svg.text("mid", (left + wide / 2.0, 66.0), &figure.names[k]);
        d.draw(&mut svg, |p| (left + (p.0 - across.0) * scale, TOP + (up.1 - p.1) * scale));
    }
    let (from, to) = (MARGIN + wide + 34.0, MARGIN + wide + MIDDLE - 34.0);
    let level = TOP + high / 2.0;
    svg.line("arrow", (from, level), (to, level));
    svg.polygon("tip", &[(to + 12.0, level), (to, level - 6.0), (to, level + 6.0)]);
    svg.polygon("tip", &[(from - 12.0, level), (from, level - 6.0), (from, level + 6.0)]);
    for (k, line) in figure.between.iter().enumerate() {
        let below = if k == 0 { -14.0 } else { 4.0 + 20.0 * k as f64 };
        svg.text("law", (f64::midpoint(from, to), level + below), line);
    }
    legend(&mut svg, height - 40.0);
    svg.text("note", (MARGIN, height - 14.0), &figure.note);
    svg.finish()
}

/// A joint on the page, and the number of legs that end there.
type DrawnJoint = ((f64, f64), usize);

/// A platform on the page, right and up, design units.
#[derive(Debug)]
struct DrawnPlatform {
    bodies: Bodies,
    joints: Vec<DrawnJoint>,
}

impl DrawnPlatform {
    fn new(m: &Manipulator, pose: &Pose, frame: &BaseFrame) -> Self {
        let pairs = m.pairs();
        let count = |joints: [usize; 6]| {
            let mut count = BTreeMap::new();
            for k in joints {
                *count.entry(k).or_insert(0usize) += 1;
            }
            count
        };
        let below = count(pairs.map(|p| p.0)).into_iter();
        let below = below.map(|(k, legs)| (frame.on_page(&m.base_joints()[k]), legs));
        let above = count(pairs.map(|p| p.1)).into_iter();
        let above = above.map(|(k, legs)| (frame.on_page(&pose.transform(&m.platform_joints()[k])), legs));
        Self { bodies: Bodies::new(m, pose, frame), joints: below.chain(above).collect() }
    }

    fn draw(&self, svg: &mut Svg, at: impl Fn((f64, f64)) -> (f64, f64)) {
        self.bodies.draw(svg, "leg", &at);
        for (p, legs) in &self.joints {
            if *legs > 1 {
                svg.circle("shared", at(*p), 6.0);
            } else {
                svg.circle("hollow", at(*p), 3.4);
            }
        }
    }
}

fn legend(svg: &mut Svg, y: f64) {
    svg.circle("shared", (MARGIN + 7.0, y - 4.0), 6.0);
    svg.text("", (MARGIN + 22.0, y), "joint that legs share");
    svg.circle("hollow", (MARGIN + 183.0, y - 4.0), 3.4);
    svg.text("", (MARGIN + 196.0, y), "joint of one leg");
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;
    use platform::manipulator::{Leg, default_home};

    #[test]
    fn shared_joints_are_rings_on_the_left_and_none_on_the_right() {
        let t = |r: f64| vec![Point3::new(r, 0.0, 0.0), Point3::new(-r, r, 0.0), Point3::new(-r, -r, 0.0)];
        let octahedral =
            Manipulator::try_new(t(2.0), t(1.0), [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)]).unwrap();
        let apart = Manipulator::from_legs(std::array::from_fn(|k| Leg {
            base: Point3::new(k as f64, (k * k) as f64, 0.0),
            platform: Point3::new((k * k) as f64, k as f64, 0.0),
        }))
        .unwrap();
        let figure = PairFigure {
            title: "t".into(),
            names: ["a".into(), "b".into()],
            between: vec!["s' = A s + c".into(), "det A = 2".into()],
            note: "n".into(),
            pose: default_home(&octahedral),
        };
        // one ring and one small circle in the legend
        let count = |text: &str, class: &str| text.matches(&format!("class=\"{class}\" cx")).count() - 1;
        let text = platform_pair([&octahedral, &apart], &figure);
        assert_eq!((count(&text, "shared"), count(&text, "hollow")), (6, 12));
        assert!(text.contains(">s' = A s + c</text>") && text.contains(">det A = 2</text>"));
        let both = platform_pair([&apart, &apart], &figure);
        assert_eq!((count(&both, "shared"), count(&both, "hollow")), (0, 24));
    }
}
