//! Meshes of the plates with their posts as ASCII STL in millimetres.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use nalgebra::{Point2, Point3};

use super::text::{ascii, scaled};
use super::triangulate::triangulate;
use super::{Export, ExportBody, ExportedFile, Plate, Unsupported, Writer};
use machine::requirements::on_circle;

/// Number of chords in a full circle. The outline is off by less than 0.03 % of its corner radius, a hole by less than
/// 0.13 % of its radius.
const OUTLINE_CHORDS: usize = 128;
const HOLE_CHORDS: usize = 64;

/// The format `stl`.
pub(super) static WRITER: Writer = Writer {
    leaves_out: "legs and balls; circles are polygons; a post is a shell of its own that touches the plate",
    ..Writer::new(
        "meshes of both plates with their posts in the frames of their bodies (ASCII, millimetres), for 3D printing",
        files,
    )
};

fn files(export: &Export) -> Result<Vec<ExportedFile>, Unsupported> {
    let mesh = |body: &ExportBody| {
        Ok(ExportedFile::new(&format!("{}-plate.stl", body.body), mesh(export, body, body.plate()?)))
    };
    export.bodies.iter().map(mesh).collect()
}

/// Triangles of the plate and its posts in the frame of the body, design units, with their corners counter-clockwise
/// seen from outside.
fn triangles(plate: &Plate) -> Vec<[Point3<f64>; 3]> {
    let outer = plate.outline.polygon(OUTLINE_CHORDS);
    let circle = |at: &Point2<f64>, diameter: f64, turn: f64| -> Vec<Point2<f64>> {
        let step = turn / HOLE_CHORDS as f64;
        (0..HOLE_CHORDS).map(|k| on_circle(at, 0.5 * diameter, step * k as f64)).collect()
    };
    let holes: Vec<_> = plate.all_holes().map(|(at, diameter)| circle(&at, diameter, -TAU)).collect();
    let mut out = prism(plate, &outer, &holes, (0.0, plate.thickness));
    for hole in plate.holes.iter().filter(|h| h.post > 0.0) {
        let ring = circle(&hole.at, plate.post_diameter, TAU);
        out.extend(prism(plate, &ring, &[], plate.post_span(hole)));
    }
    out
}

/// The prism between two heights over a polygon with holes.
fn prism(
    plate: &Plate,
    outer: &[Point2<f64>],
    holes: &[Vec<Point2<f64>>],
    (low, high): (f64, f64),
) -> Vec<[Point3<f64>; 3]> {
    let all: Vec<Point2<f64>> = outer.iter().chain(holes.iter().flatten()).copied().collect();
    let at = |p: &Point2<f64>, w: f64| plate.to_body(&Point3::new(p.x, p.y, w));
    let mut out = Vec::new();
    for [a, b, c] in triangulate(outer, holes) {
        let [a, b, c] = [a, b, c].map(|k| &all[k]);
        out.push([at(a, high), at(b, high), at(c, high)]);
        out.push([at(a, low), at(c, low), at(b, low)]);
    }
    for ring in [outer].into_iter().chain(holes.iter().map(Vec::as_slice)) {
        for (i, p) in ring.iter().enumerate() {
            let q = &ring[(i + 1) % ring.len()];
            out.push([at(p, low), at(q, low), at(q, high)]);
            out.push([at(p, low), at(q, high), at(p, high)]);
        }
    }
    out
}

fn mesh(export: &Export, body: &ExportBody, plate: &Plate) -> String {
    let mm = export.unit.millimetres;
    let name = ascii(&export.name, |_| "?".to_string());
    let title = format!("{} plate of {name} - mm - frame of the {}", body.body, body.body);
    solid(&title, triangles(plate), mm)
}

/// ASCII STL of triangles, counter-clockwise seen from outside, with their coordinates times `factor`.
pub(super) fn solid(
    title: &str,
    triangles: impl IntoIterator<Item = [Point3<f64>; 3]>,
    factor: f64,
) -> String {
    let mut out = format!("solid {title}\n");
    for [a, b, c] in triangles {
        let normal = (b - a).cross(&(c - a)).try_normalize(0.0).unwrap_or_default();
        let _ = writeln!(out, "facet normal {}\n outer loop", scaled(&normal, 1.0, " "));
        for p in [a, b, c] {
            let _ = writeln!(out, "  vertex {}", scaled(&p.coords, factor, " "));
        }
        out.push_str(" endloop\nendfacet\n");
    }
    let _ = writeln!(out, "endsolid {title}");
    out
}
