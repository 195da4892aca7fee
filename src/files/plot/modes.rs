//! Assembly modes as small multiples: base, platform, six legs, one oblique projection.

use nalgebra::Vector3;

use super::oblique::{BaseFrame, Bodies, Extent};
use super::style::Svg;
use platform::geom::Pose;
use platform::manipulator::Manipulator;

/// The contents of the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct ModesFigure {
    /// Title.
    pub title: String,
    /// A line of text below the panels.
    pub note: String,
    /// Poses with their numbers.
    pub poses: Vec<(usize, Pose)>,
    /// Two poses are mirror images if their joints agree within this, design units.
    pub tolerance: f64,
}

/// Greatest width and height of a drawn platform in a panel, pixels.
const PANEL: (f64, f64) = (112.0, 250.0);
const GAP: f64 = 10.0;
const MARGIN: f64 = 24.0;
const TOP: f64 = 66.0;
const CAPTION: f64 = 22.0;
/// Mirror pairs per row, and poses per row if none has a mirror image.
const PAIRS: usize = 3;
const SINGLES: usize = 6;

/// One pose on the page, relative to the centre of the base.
#[derive(Debug, Clone)]
struct DrawnPose {
    number: usize,
    bodies: Bodies,
}

/// Panels in pairs: a pose and its mirror image in the base plane, the one above the base first; a pose without
/// partner alone.
fn pairs(joints: &[[Vector3<f64>; 6]], tolerance: f64) -> Vec<Vec<usize>> {
    let gap = |a: usize, b: usize| {
        let difference = |k: usize| {
            let (p, q) = (joints[a][k], joints[b][k]);
            Vector3::new(p.x - q.x, p.y - q.y, p.z + q.z).norm()
        };
        (0..6).map(difference).fold(0.0, f64::max)
    };
    let height = |k: usize| joints[k].iter().map(|p| p.z).sum::<f64>();
    let mut free: Vec<usize> = (0..joints.len()).collect();
    let mut out = Vec::new();
    while !free.is_empty() {
        let first = free.remove(0);
        let partner = (0..free.len()).min_by(|a, b| gap(first, free[*a]).total_cmp(&gap(first, free[*b])));
        match partner.filter(|k| gap(first, free[*k]) <= tolerance) {
            Some(k) => {
                let second = free.remove(k);
                let upper_first = height(first) >= height(second);
                out.push(if upper_first { vec![first, second] } else { vec![second, first] });
            }
            None => out.push(vec![first]),
        }
    }
    out
}

/// All given poses as panels of the same scale, mirror images side by side.
///
/// The projection is oblique: the base plane runs to the right and, foreshortened by one half, into the depth; its
/// normal points up.
#[must_use]
pub fn assembly_modes(m: &Manipulator, figure: &ModesFigure) -> String {
    let frame = BaseFrame::of(m);
    let drawn =
        |(number, pose): &(usize, Pose)| DrawnPose { number: *number, bodies: Bodies::new(m, pose, &frame) };
    let drawn: Vec<DrawnPose> = figure.poses.iter().map(drawn).collect();
    let joints: Vec<[Vector3<f64>; 6]> = figure
        .poses
        .iter()
        .map(|(_, pose)| m.legs().map(|l| frame.coordinates(&pose.transform(&l.platform))))
        .collect();
    layout(figure, &drawn, &pairs(&joints, figure.tolerance))
}

fn layout(figure: &ModesFigure, drawn: &[DrawnPose], pairs: &[Vec<usize>]) -> String {
    let extent = Extent::of(drawn.iter().flat_map(|d| d.bodies.corners()));
    let (across, up, scale) = (extent.across, extent.up, extent.scale(PANEL));
    let (panel_width, panel_height) =
        if drawn.is_empty() { (PANEL.0, 40.0) } else { (PANEL.0, (up.1 - up.0) * scale + CAPTION) };
    let is_paired = pairs.is_empty() || pairs.iter().any(|p| p.len() > 1);
    let (columns, in_box) = if is_paired { (PAIRS, 2.0) } else { (SINGLES, 1.0) };
    let cell = in_box * panel_width + (in_box + 1.0) * GAP;
    let rows = pairs.len().div_ceil(columns).max(1);
    let width = 2.0 * MARGIN + columns as f64 * cell + (columns as f64 - 1.0) * GAP;
    let row_height = panel_height + 3.0 * GAP;
    let height = TOP + rows as f64 * row_height + 62.0;
    let description = format!(
        "{} real poses in oblique projection, mirror images in the base plane side by side. {}",
        drawn.len(),
        figure.note
    );
    let mut svg = Svg::new(width, height, &figure.title, &description);
    svg.text("title", (MARGIN, 30.0), &figure.title);
    if drawn.is_empty() {
        svg.text("", (MARGIN, TOP + 20.0), "no real pose has these leg lengths");
    }
    for (k, pair) in pairs.iter().enumerate() {
        let (column, row) = ((k % columns) as f64, (k / columns) as f64);
        let corner = (MARGIN + column * (cell + GAP), TOP - 16.0 + row * row_height);
        svg.rect("pair", corner, (cell, panel_height + 2.0 * GAP));
        for (j, &index) in pair.iter().enumerate() {
            let left = corner.0 + GAP + j as f64 * (panel_width + GAP);
            let middle = f64::midpoint(across.0, across.1);
            let at = |p: (f64, f64)| {
                (
                    left + panel_width / 2.0 + (p.0 - middle) * scale,
                    corner.1 + CAPTION + GAP + (up.1 - p.1) * scale,
                )
            };
            panel(&mut svg, &drawn[index].bodies, at);
            let caption = format!("pose {}", drawn[index].number);
            svg.text("mid", (left + panel_width / 2.0, corner.1 + 17.0), &caption);
        }
    }
    legend(&mut svg, height - 44.0);
    svg.text("note", (MARGIN, height - 16.0), &figure.note);
    svg.finish()
}

fn panel(svg: &mut Svg, bodies: &Bodies, at: impl Fn((f64, f64)) -> (f64, f64)) {
    bodies.draw(svg, "first", &at);
    for p in bodies.corners() {
        svg.circle("hollow", at(p), 2.2);
    }
}

fn legend(svg: &mut Svg, y: f64) {
    let swatch = |x: f64| [(x, y), (x + 22.0, y), (x + 11.0, y - 12.0)];
    let mut x = MARGIN;
    svg.polygon("base", &swatch(x));
    svg.text("", (x + 30.0, y), "base");
    x += 90.0;
    svg.polygon("platform", &swatch(x));
    svg.text("", (x + 30.0, y), "platform");
    x += 112.0;
    svg.line("leg", (x, y - 4.0), (x + 26.0, y - 4.0));
    svg.text("", (x + 34.0, y), "leg");
    x += 82.0;
    svg.line("first", (x, y - 4.0), (x + 26.0, y - 4.0));
    svg.text("", (x + 34.0, y), "leg 1");
    x += 116.0;
    svg.rect("pair", (x, y - 13.0), (26.0, 14.0));
    svg.text("", (x + 34.0, y), "mirror images in the base plane share a box");
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Point3, Rotation3};

    fn octahedral() -> Manipulator {
        let t = |r: f64| vec![Point3::new(r, 0.0, 0.0), Point3::new(-r, r, 0.0), Point3::new(-r, -r, 0.0)];
        let m = Manipulator::try_new(t(2.0), t(1.0), [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)]);
        m.unwrap()
    }

    fn figure(heights: &[f64]) -> ModesFigure {
        let pose = |z: f64| Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, z) };
        let poses = heights.iter().enumerate().map(|(k, z)| (k + 1, pose(*z))).collect();
        ModesFigure { title: "modes".into(), note: "note".into(), poses, tolerance: 1e-6 }
    }

    #[test]
    fn mirror_images_share_a_box_and_the_upper_one_comes_first() {
        let text = assembly_modes(&octahedral(), &figure(&[-3.0, 1.0, 3.0]));
        let order: Vec<usize> =
            [3, 1, 2].iter().map(|k| text.find(&format!(">pose {k}<")).unwrap()).collect();
        assert!(order.is_sorted());
        // one box in the legend
        assert_eq!(text.matches("class=\"pair\"").count(), 2 + 1);
        assert_eq!(text.matches("class=\"platform\"").count(), 3 + 1);
    }

    #[test]
    fn bodies_without_shared_joints_are_hexagons() {
        let at = |k: usize, r: f64, off: f64| {
            let (y, x) = (1.047 * k as f64 + off).sin_cos();
            Point3::new(r * x, r * y, 0.0)
        };
        // platform joints in another order than around the body: the outline has no crossings
        let m = Manipulator::from_legs(std::array::from_fn(|k| platform::manipulator::Leg {
            base: at(k, 2.0, 0.0),
            platform: at((k + 3) % 6, 1.0, 0.2),
        }));
        let text = assembly_modes(&m.unwrap(), &figure(&[1.0]));
        let outline = text.split("class=\"platform\" points=\"").nth(1).unwrap().split('"').next().unwrap();
        assert_eq!(outline.split(' ').count(), 6);
    }

    #[test]
    fn without_a_real_pose_the_picture_says_so() {
        let text = assembly_modes(&octahedral(), &figure(&[]));
        assert!(text.contains("no real pose") && !text.contains("NaN") && !text.contains("inf"));
    }
}
