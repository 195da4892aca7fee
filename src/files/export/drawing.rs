//! Three views at home as SVG.

use std::f64::consts::TAU;

use nalgebra::{Point2, Point3, Vector3};

use super::text::one_line;
use super::{Export, ExportBody, ExportLeg, ExportedFile, Plate, Unsupported, Writer};
use crate::plot::{ThreeViewBody, ThreeViewFigure, three_views};
use machine::requirements::on_circle;
use platform::geom::any_across;

/// Chords in a full circle: extents are exact to 3e-6 of a radius; the picture keeps only visible corners.
const CHORDS: usize = 1440;

/// The format `svg`.
pub(super) static WRITER: Writer = Writer {
    leaves_out: "hidden lines: the silhouettes of all parts are drawn",
    ..Writer::new("drawing with three views at home, third angle, millimetres", files)
};

fn files(export: &Export) -> Result<Vec<ExportedFile>, Unsupported> {
    let mm = export.unit.millimetres;
    let [base, platform] = &export.bodies;
    let legs = export.legs.iter().map(|leg| bars(leg, mm)).collect::<Result<Vec<_>, _>>()?;
    let note = format!("Base frame, home pose, mm. One unit of the design is {mm} mm. {}.", export.program);
    let figure = ThreeViewFigure {
        title: format!("{}: three views at home", one_line(&export.name)),
        note,
        base: drawn(base, mm, &|p| *p)?,
        platform: drawn(platform, mm, &|p| export.home.transform(p))?,
        legs: export.legs.map(|l| [l.foot, l.head].map(|p| p * mm)),
        leg_bodies: legs.into_iter().flatten().collect(),
        origins: [Point3::origin(), Point3::from(Vector3::from(export.home.position * mm))],
    };
    Ok(vec![ExportedFile::new("three-views.svg", three_views(&figure))])
}

fn circle(at: &Point2<f64>, diameter: f64) -> Vec<Point2<f64>> {
    (0..CHORDS).map(|k| on_circle(at, 0.5 * diameter, TAU * k as f64 / CHORDS as f64)).collect()
}

/// Plate, posts, holes, balls and names of a body; `place` maps them to the base frame.
fn drawn(
    body: &ExportBody,
    mm: f64,
    place: &dyn Fn(&Point3<f64>) -> Point3<f64>,
) -> Result<ThreeViewBody, Unsupported> {
    let plate: &Plate = body.plate()?;
    let level = |ring: &[Point2<f64>], w: f64| -> Vec<Point3<f64>> {
        ring.iter().map(|p| place(&plate.to_body(&Point3::new(p.x, p.y, w))) * mm).collect()
    };
    let prism =
        |ring: &[Point2<f64>], (low, high): (f64, f64)| [level(ring, low), level(ring, high)].concat();
    let mut solids = vec![prism(&plate.outline.polygon(CHORDS), (0.0, plate.thickness))];
    let posts = plate.holes.iter().filter(|h| h.post > 0.0);
    solids.extend(posts.map(|h| prism(&circle(&h.at, plate.post_diameter), plate.post_span(h))));
    let face = if plate.legs_above { plate.thickness } else { 0.0 };
    let holes = plate.all_holes().map(|(at, diameter)| level(&circle(&at, diameter), face)).collect();
    let joints = body.joints.iter().map(|j| (one_line(&j.name), place(&j.at) * mm)).collect();
    Ok(ThreeViewBody { solids, holes, joints, ball: body.ball_diameter * mm })
}

/// Cylinder and rod of a leg.
fn bars(leg: &ExportLeg, mm: f64) -> Result<[Vec<Point3<f64>>; 2], Unsupported> {
    let d = leg.direction()?;
    let x = any_across(&d);
    let y = d.cross(&x);
    let bar = |from: f64, to: f64, diameter: f64| {
        let ring = circle(&Point2::origin(), diameter);
        let ends = [from, to].into_iter();
        ends.flat_map(|along| {
            ring.iter().map(move |p| (leg.foot + d * along + x * p.x + y * p.y) * mm).collect::<Vec<_>>()
        })
        .collect()
    };
    let middle = leg.cylinder.min(leg.length());
    Ok([bar(0.0, middle, leg.diameters.0), bar(middle, leg.length(), leg.diameters.1)])
}
