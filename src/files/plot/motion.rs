//! A self-motion as a picture: base, platform and legs in oblique projection, animated along a curve of poses.

use super::oblique::{Extent, oblique, outlines};
use super::style::{Svg, px};
use platform::geom::Pose;
use platform::manipulator::Manipulator;

/// The contents of the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionFigure {
    /// Title.
    pub title: String,
    /// A line of text below the picture.
    pub note: String,
    /// Poses with their length along the curve, not decreasing.
    pub poses: Vec<(f64, Pose)>,
    /// Whether the last pose is followed by the first; otherwise the motion goes back and forth.
    pub closed: bool,
}

// the layout in pixels: sizes, and positions from the left and the top
const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 520.0;
const MARGIN: f64 = 40.0;
/// Number of pictures per run.
const FRAMES: usize = 120;
/// Seconds of one run.
const SECONDS: usize = 12;

/// Poses at equal lengths along the curve, the nearest given ones.
fn frames(figure: &MotionFigure) -> Vec<Pose> {
    let total = figure.poses.last().map_or(0.0, |p| p.0);
    let count = FRAMES.min(figure.poses.len());
    let at = |k: usize| {
        let arc = total * k as f64 / count.saturating_sub(1).max(1) as f64;
        let place = figure.poses.partition_point(|p| p.0 < arc).min(figure.poses.len() - 1);
        figure.poses[place].1
    };
    let mut out: Vec<Pose> = (0..count).map(at).collect();
    if figure.closed {
        out.extend(out.first().copied());
    } else {
        out.extend(out.clone().into_iter().rev());
    }
    out
}

/// An animated picture. Viewers without animation, and readers who ask for less motion, see the first pose and faint
/// others.
#[must_use]
pub fn motion(m: &Manipulator, figure: &MotionFigure) -> String {
    let frames = frames(figure);
    let pairs = m.pairs();
    let [base, platform] = outlines(m);
    let tip = |pose: &Pose, j: usize| oblique(&pose.transform(&m.platform_joints()[j]).coords);
    let foot = |j: usize| oblique(&m.base_joints()[j].coords);
    let tips = frames.iter().flat_map(|f| platform.iter().map(move |j| tip(f, *j)));
    let extent = Extent::of(tips.chain(base.iter().map(|j| foot(*j))));
    let scale = extent.scale((WIDTH - 2.0 * MARGIN, HEIGHT - 2.0 * MARGIN - 50.0));
    let page = |p: (f64, f64)| {
        (
            WIDTH / 2.0 + (p.0 - f64::midpoint(extent.across.0, extent.across.1)) * scale,
            HEIGHT - MARGIN - 20.0 - (p.1 - extent.up.0) * scale,
        )
    };
    let description = format!("Base, platform and six legs in oblique projection, moving. {}", figure.note);
    let mut svg = Svg::new(WIDTH, HEIGHT, &figure.title, &description);
    svg.text("title", (MARGIN, 30.0), &figure.title);
    svg.polygon("base", &base.iter().map(|j| page(foot(*j))).collect::<Vec<_>>());
    // traces of the platform joints
    for j in &platform {
        svg.polyline("edge", &frames.iter().map(|f| page(tip(f, *j))).collect::<Vec<_>>());
    }
    let Some(first) = frames.first() else {
        svg.text("", (MARGIN, 60.0), "no pose");
        return svg.finish();
    };
    for (leg, (a, b)) in pairs.iter().enumerate() {
        let ends: Vec<(f64, f64)> = frames.iter().map(|f| page(tip(f, *b))).collect();
        let (x, y): (Vec<String>, Vec<String>) = ends.iter().map(|e| (px(e.0), px(e.1))).unzip();
        let class = if leg == 0 { "first" } else { "leg" };
        svg.moving_line(class, (page(foot(*a)), page(tip(first, *b))), (&x.join(";"), &y.join(";")), SECONDS);
    }
    let corners = |f: &Pose| -> Vec<(f64, f64)> { platform.iter().map(|j| page(tip(f, *j))).collect() };
    let moving: Vec<Vec<(f64, f64)>> = frames.iter().map(corners).collect();
    svg.moving_polygon("platform", &moving, SECONDS);
    svg.text("note", (MARGIN, HEIGHT - 16.0), &figure.note);
    svg.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Point3, Rotation3, Vector3};
    use platform::manipulator::Leg;

    #[test]
    fn every_leg_and_the_platform_move_through_all_frames() {
        let ring = |r: f64, k: usize| {
            let (s, c) = (k as f64).sin_cos();
            Point3::new(r * c, r * s, 0.0)
        };
        let legs = std::array::from_fn(|k| Leg { base: ring(2.0, k), platform: ring(1.0, k) });
        let m = Manipulator::from_legs(legs).unwrap();
        let pose = |z: f64| Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, z) };
        let poses: Vec<(f64, Pose)> = (0..10).map(|k| (f64::from(k), pose(1.0 + f64::from(k)))).collect();
        let figure = MotionFigure { title: "a <b>".into(), note: "n".into(), poses, closed: true };
        let text = motion(&m, &figure);
        assert_eq!(text.matches("<animate ").count(), 2 * 6 + 1);
        assert!(text.contains("a &lt;b&gt;") && !text.contains("NaN"));
        let values = text.split("values=\"").nth(1).unwrap().split('"').next().unwrap();
        assert_eq!(values.split(';').count(), 11);
        let still = MotionFigure { poses: Vec::new(), ..figure };
        assert!(motion(&m, &still).contains("no pose"));
    }
}
