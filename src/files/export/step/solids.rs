//! Boundary representations of plates, cylinders and balls, each in a separate frame.

use nalgebra::{Point2, Point3, Vector3};

use super::builder::{Builder, Id};
use crate::export::Plate;
use crate::export::text::step_real;
use machine::requirements::{OutlinePart, on_circle};

fn at(p: &Point2<f64>, z: f64) -> Point3<f64> {
    Point3::new(p.x, p.y, z)
}

/// A full cylinder surface about the direction of z: lower and upper circle and the seam between them.
#[derive(Debug)]
struct Tube {
    below: Id,
    above: Id,
    seam: Id,
    surface: Id,
}

impl Tube {
    fn new(b: &mut Builder, centre: &Point2<f64>, radius: f64, (from, to): (f64, f64)) -> Self {
        let start = on_circle(centre, radius, 0.0);
        let (low, high) = (at(&start, from), at(&start, to));
        let (v, w) = (b.vertex(&low), b.vertex(&high));
        Self {
            below: b.round((v, v), &at(centre, from), radius),
            above: b.round((w, w), &at(centre, to), radius),
            seam: b.straight((v, w), &low, &high),
            surface: b.cylinder(&at(centre, from), radius),
        }
    }

    /// Its face: around a solid, or around a hole.
    fn face(&self, b: &mut Builder, hole: bool) -> Id {
        let (below, above, seam) = (self.below, self.above, self.seam);
        let edges = if hole {
            [(seam, true), (above, true), (seam, false), (below, false)]
        } else {
            [(below, true), (seam, true), (above, false), (seam, false)]
        };
        let around = b.edge_loop(&edges);
        b.face(around, &[], self.surface, !hole)
    }
}

/// The plate in its frame, millimetres.
pub(super) fn plate(b: &mut Builder, name: &str, plate: &Plate, mm: f64) -> Id {
    let height = plate.thickness * mm;
    let scaled = |p: &Point2<f64>| Point2::from(p.coords * mm);
    let parts = plate.outline.parts();
    let n = parts.len();
    let start = |part: &OutlinePart| match *part {
        OutlinePart::Line { from, .. } => scaled(&from),
        OutlinePart::Arc { centre, radius, start, .. } => scaled(&on_circle(&centre, radius, start)),
    };
    let corners: Vec<Point2<f64>> = parts.iter().map(start).collect();
    let low: Vec<Id> = corners.iter().map(|c| b.vertex(&at(c, 0.0))).collect();
    let high: Vec<Id> = corners.iter().map(|c| b.vertex(&at(c, height))).collect();
    let upright: Vec<Id> = (0..n)
        .map(|i| b.straight((low[i], high[i]), &at(&corners[i], 0.0), &at(&corners[i], height)))
        .collect();
    let (mut below, mut above, mut faces) = (Vec::new(), Vec::new(), Vec::new());
    for (i, part) in parts.iter().enumerate() {
        let j = (i + 1) % n;
        let surface = match part {
            OutlinePart::Line { .. } => {
                let (from, to) = (&corners[i], &corners[j]);
                below.push(b.straight((low[i], low[j]), &at(from, 0.0), &at(to, 0.0)));
                above.push(b.straight((high[i], high[j]), &at(from, height), &at(to, height)));
                let d = (to - from).normalize();
                b.plane(&at(from, 0.0), &Vector3::new(d.y, -d.x, 0.0), &Vector3::new(d.x, d.y, 0.0))
            }
            OutlinePart::Arc { centre, radius, .. } => {
                let (centre, radius) = (scaled(centre), radius * mm);
                below.push(b.round((low[i], low[j]), &at(&centre, 0.0), radius));
                above.push(b.round((high[i], high[j]), &at(&centre, height), radius));
                b.cylinder(&at(&centre, 0.0), radius)
            }
        };
        let edges = [(below[i], true), (upright[j], true), (above[i], false), (upright[i], false)];
        let around = b.edge_loop(&edges);
        faces.push(b.face(around, &[], surface, true));
    }
    let holes: Vec<Tube> = plate
        .all_holes()
        .map(|(at, diameter)| Tube::new(b, &scaled(&at), 0.5 * diameter * mm, (0.0, height)))
        .collect();
    faces.extend(holes.iter().map(|h| h.face(b, true)).collect::<Vec<_>>());
    let up: Vec<(Id, bool)> = above.iter().map(|e| (*e, true)).collect();
    let down: Vec<(Id, bool)> = below.iter().rev().map(|e| (*e, false)).collect();
    let openings = |b: &mut Builder, upper: bool| -> Vec<Id> {
        holes.iter().map(|h| b.edge_loop(&[if upper { (h.above, false) } else { (h.below, true) }])).collect()
    };
    let (outer, inner) = (b.edge_loop(&up), openings(b, true));
    let surface = b.plane(&Point3::new(0.0, 0.0, height), &Vector3::z(), &Vector3::x());
    faces.push(b.face(outer, &inner, surface, true));
    let (outer, inner) = (b.edge_loop(&down), openings(b, false));
    let surface = b.plane(&Point3::origin(), &-Vector3::z(), &Vector3::x());
    faces.push(b.face(outer, &inner, surface, true));
    b.solid(name, &faces)
}

/// A cylinder on the origin along z, millimetres.
pub(super) fn cylinder(b: &mut Builder, name: &str, diameter: f64, height: f64) -> Id {
    let tube = Tube::new(b, &Point2::origin(), 0.5 * diameter, (0.0, height));
    let side = tube.face(b, false);
    let top = b.edge_loop(&[(tube.above, true)]);
    let surface = b.plane(&Point3::new(0.0, 0.0, height), &Vector3::z(), &Vector3::x());
    let top = b.face(top, &[], surface, true);
    let bottom = b.edge_loop(&[(tube.below, false)]);
    let surface = b.plane(&Point3::origin(), &-Vector3::z(), &Vector3::x());
    let bottom = b.face(bottom, &[], surface, true);
    b.solid(name, &[side, top, bottom])
}

/// A cylinder on the origin along z, millimetres, with a bore of another diameter from `floor` to the open top.
pub(super) fn sleeve(
    b: &mut Builder,
    name: &str,
    (diameter, bore): (f64, f64),
    (floor, height): (f64, f64),
) -> Id {
    let centre = Point2::origin();
    let (outer, inner) = (
        Tube::new(b, &centre, 0.5 * diameter, (0.0, height)),
        Tube::new(b, &centre, 0.5 * bore, (floor, height)),
    );
    let sides = [outer.face(b, false), inner.face(b, true)];
    let (rim, opening) = (b.edge_loop(&[(outer.above, true)]), b.edge_loop(&[(inner.above, false)]));
    let surface = b.plane(&Point3::new(0.0, 0.0, height), &Vector3::z(), &Vector3::x());
    let top = b.face(rim, &[opening], surface, true);
    let around = b.edge_loop(&[(inner.below, true)]);
    let surface = b.plane(&Point3::new(0.0, 0.0, floor), &Vector3::z(), &Vector3::x());
    let ground = b.face(around, &[], surface, true);
    let around = b.edge_loop(&[(outer.below, false)]);
    let surface = b.plane(&Point3::origin(), &-Vector3::z(), &Vector3::x());
    let bottom = b.face(around, &[], surface, true);
    b.solid(name, &[sides[0], sides[1], top, ground, bottom])
}

/// A box about the origin with edges along the axes, millimetres.
pub(super) fn block(b: &mut Builder, name: &str, edges: &Vector3<f64>) -> Id {
    let corner =
        |c: usize| Point3::from(Vector3::from_fn(|k, _| if c >> k & 1 == 0 { -0.5 } else { 0.5 } * edges[k]));
    let corners: Vec<Id> = (0..8).map(|c| b.vertex(&corner(c))).collect();
    // the edge along an axis from each corner that is below it
    let mut along = [[None; 8]; 3];
    for (k, row) in along.iter_mut().enumerate() {
        for c in (0..8).filter(|c| c >> k & 1 == 0) {
            let d = c | 1 << k;
            row[c] = Some(b.straight((corners[c], corners[d]), &corner(c), &corner(d)));
        }
    }
    let mut faces = Vec::new();
    for k in 0..3 {
        // the two other axes in the order that makes the loop turn about axis k
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        for upper in [true, false] {
            let c = if upper { 1 << k } else { 0 };
            let around = [(i, c, true), (j, c | 1 << i, true), (i, c | 1 << j, false), (j, c, false)];
            let mut edges: Vec<(Id, bool)> = around
                .iter()
                .filter_map(|(axis, from, forwards)| along[*axis][*from].map(|edge| (edge, *forwards)))
                .collect();
            if !upper {
                edges.reverse();
                for (_, forwards) in &mut edges {
                    *forwards = !*forwards;
                }
            }
            let around = b.edge_loop(&edges);
            let axis = |k: usize| Vector3::from_fn(|r, _| if r == k { 1.0 } else { 0.0 });
            let normal = if upper { axis(k) } else { -axis(k) };
            let surface = b.plane(&corner(c), &normal, &axis(i));
            faces.push(b.face(around, &[], surface, true));
        }
    }
    b.solid(name, &faces)
}

/// A ball about the origin, two half spheres, millimetres.
pub(super) fn ball(b: &mut Builder, name: &str, diameter: f64) -> Id {
    let radius = 0.5 * diameter;
    let v = b.vertex(&Point3::new(radius, 0.0, 0.0));
    let equator = b.round((v, v), &Point3::origin(), radius);
    let frame = b.frame(&Point3::origin(), &Vector3::z(), &Vector3::x());
    let surface = b.add(&format!("SPHERICAL_SURFACE('',{frame},{})", step_real(radius)));
    let faces = [true, false].map(|upper| {
        let around = b.edge_loop(&[(equator, upper)]);
        b.face(around, &[], surface, true)
    });
    b.solid(name, &faces)
}
