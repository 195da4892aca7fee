//! Spheres and cylinders of a representation, and placements.

use std::collections::HashSet;

use nalgebra::{Matrix3, Point3, Rotation3, Vector3};

use super::part21::{ExchangeFile, StepRecord};
use crate::geom::{Pose, any_across};

/// A cylinder, millimetres.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Cylinder {
    pub(super) on_axis: Point3<f64>,
    pub(super) axis: Vector3<f64>,
    /// The middle of its faces on the axis, where they have corners.
    pub(super) middle: Option<Point3<f64>>,
}

/// What a part has of both kinds, in the frame of its representation, millimetres.
#[derive(Debug, Clone, Default)]
pub(super) struct PartShape {
    pub(super) spheres: Vec<Point3<f64>>,
    pub(super) cylinders: Vec<Cylinder>,
}

/// Three coordinates of a point or a direction; a plane point has two.
fn triple(file: &ExchangeFile, id: u64, name: &str) -> Option<Vector3<f64>> {
    let values = file.record(id, name)?.values.get(1)?.list();
    let x = |k: usize| values.get(k).map_or(Some(0.0), super::part21::StepValue::number);
    if values.len() < 2 { None } else { Some(Vector3::new(x(0)?, x(1)?, x(2)?)) }
}

/// The frame of an `AXIS2_PLACEMENT_3D`, lengths times `scale`.
///
/// # Errors
/// A sentence that names the entity.
pub(super) fn placement(file: &ExchangeFile, id: u64, scale: f64) -> Result<Pose, String> {
    let frame = || {
        let record = file.record(id, "AXIS2_PLACEMENT_3D")?;
        let position = triple(file, record.reference(1)?, "CARTESIAN_POINT")? * scale;
        let direction = |k: usize| match record.reference(k) {
            Some(id) => triple(file, id, "DIRECTION")?.try_normalize(0.0).map(Some),
            None => Some(None),
        };
        let z = direction(2)?.unwrap_or_else(Vector3::z);
        let x = direction(3)?.unwrap_or_else(Vector3::x);
        // a first axis along the third says nothing
        let x = (x - z * x.dot(&z)).try_normalize(1e-9).unwrap_or_else(|| any_across(&z));
        let axes = Matrix3::from_columns(&[x, z.cross(&x), z]);
        Some(Pose { rotation: Rotation3::from_matrix_unchecked(axes), position })
    };
    frame().ok_or_else(|| format!("entity #{id} is no placement with an axis and a direction"))
}

/// Entities that belong to other representations or to colours.
fn is_border(records: &[StepRecord]) -> bool {
    records.iter().any(|r| {
        r.name.ends_with("REPRESENTATION")
            || r.name.ends_with("STYLED_ITEM")
            || r.name.ends_with("CONTEXT")
            || r.name == "MAPPED_ITEM"
            || r.name == "REPRESENTATION_MAP"
    })
}

impl PartShape {
    /// What can be reached from the items of a representation.
    ///
    /// # Errors
    /// Surfaces without a placement.
    pub(super) fn of(file: &ExchangeFile, items: &[u64], scale: f64) -> Result<Self, String> {
        let mut shape = Self::default();
        let mut open: Vec<u64> = items.iter().rev().copied().collect();
        let mut seen: HashSet<u64> = HashSet::new();
        while let Some(id) = open.pop() {
            let Some(records) = file.entities.get(&id) else { continue };
            if is_border(records) || !seen.insert(id) {
                continue;
            }
            let mut next = Vec::new();
            for record in records {
                match record.name.as_str() {
                    "SPHERICAL_SURFACE" => {
                        let frame = placement(file, record.reference(1).unwrap_or(0), scale)?;
                        shape.spheres.push(Point3::from(frame.position));
                    }
                    "CYLINDRICAL_SURFACE" => shape.cylinder(file, record, None, scale)?,
                    "ADVANCED_FACE" | "FACE_SURFACE" => {
                        let surface = record.reference(2).unwrap_or(0);
                        if let Some(cylinder) = file.record(surface, "CYLINDRICAL_SURFACE") {
                            seen.insert(surface);
                            shape.cylinder(file, cylinder, record.values.get(1), scale)?;
                        }
                        record.values.iter().for_each(|v| v.references(&mut next));
                    }
                    _ => record.values.iter().for_each(|v| v.references(&mut next)),
                }
            }
            open.extend(next.into_iter().rev());
        }
        Ok(shape)
    }

    fn cylinder(
        &mut self,
        file: &ExchangeFile,
        surface: &StepRecord,
        bounds: Option<&super::part21::StepValue>,
        scale: f64,
    ) -> Result<(), String> {
        let frame = placement(file, surface.reference(1).unwrap_or(0), scale)?;
        let (origin, axis) = (frame.position, frame.rotation * Vector3::z());
        let corners = bounds.map_or_else(Vec::new, |bounds| corners(file, bounds));
        let along = corners.iter().map(|p| (p * scale - origin).dot(&axis));
        let (least, most) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        let middle = (least < most).then(|| Point3::from(origin + axis * (0.5 * (least + most))));
        self.cylinders.push(Cylinder { on_axis: Point3::from(origin), axis, middle });
        Ok(())
    }
}

/// Points of the vertices of a face, in the unit of the file.
fn corners(file: &ExchangeFile, bounds: &super::part21::StepValue) -> Vec<Vector3<f64>> {
    let mut open = Vec::new();
    bounds.references(&mut open);
    let mut seen: HashSet<u64> = HashSet::new();
    let mut found = Vec::new();
    while let Some(id) = open.pop() {
        if !seen.insert(id) {
            continue;
        }
        for record in file.entities.get(&id).map_or(&[][..], Vec::as_slice) {
            match record.name.as_str() {
                "VERTEX_POINT" => {
                    found.extend(record.reference(1).and_then(|p| triple(file, p, "CARTESIAN_POINT")));
                }
                // only what leads from a face to its vertices
                "FACE_BOUND" | "FACE_OUTER_BOUND" | "EDGE_LOOP" | "ORIENTED_EDGE" | "EDGE_CURVE"
                | "VERTEX_LOOP" | "SUBEDGE" | "POLY_LOOP" => {
                    record.values.iter().for_each(|v| v.references(&mut open));
                }
                _ => {}
            }
        }
    }
    found
}
