//! STEP AP242 (ISO 10303-242) assembly: plates, balls, cylinders and rods as exact solids.

mod assembly;
mod builder;
mod solids;

use nalgebra::{Matrix3, Point3, Rotation3, Vector3};

use self::assembly::StepAssembly;
use super::{Export, ExportedFile, Plate, Unsupported, Writer};
use crate::geom::{Pose, any_across};

/// The format `step`.
#[derive(Debug)]
pub(super) struct StepFile;

impl Writer for StepFile {
    fn name(&self) -> &'static str {
        "step"
    }

    fn purpose(&self) -> &'static str {
        "AP242 assembly at home (millimetres): plates with holes, balls, cylinders and rods as exact solids, for CAD"
    }

    fn leaves_out(&self) -> &'static str {
        "joints as constraints: the parts stand at home; legs that share a ball run into each other near it"
    }

    fn files(&self, export: &Export) -> Result<Vec<ExportedFile>, Unsupported> {
        Ok(vec![ExportedFile::new("platform.step", assembly(export)?)])
    }
}

/// The frame with its third axis along `d`.
fn along(origin: &Point3<f64>, d: &Vector3<f64>) -> Pose {
    let x = any_across(d);
    let axes = Matrix3::from_columns(&[x, d.cross(&x), *d]);
    Pose { rotation: Rotation3::from_matrix_unchecked(axes), position: origin.coords }
}

/// `inner` seen from outside `outer`.
fn within(outer: &Pose, inner: &Pose) -> Pose {
    Pose {
        rotation: outer.rotation * inner.rotation,
        position: outer.rotation * inner.position + outer.position,
    }
}

fn plate_frame(plate: &Plate) -> Pose {
    Pose { rotation: Rotation3::from_matrix_unchecked(plate.axes), position: plate.origin.coords }
}

fn assembly(export: &Export) -> Result<String, Unsupported> {
    let mm = export.unit.millimetres;
    let mut a = StepAssembly::new(export);
    let base_frame = Pose { rotation: Rotation3::identity(), position: Vector3::zeros() };
    for (body, placed) in export.bodies.iter().zip([base_frame, export.home]) {
        let plate = body.plate()?;
        let frame = within(&placed, &plate_frame(plate));
        let name = format!("{} plate", body.body);
        let part = a.part(&name, |b| solids::plate(b, &name, plate, mm));
        a.place(part, &name, &frame);
        let name = format!("ball of the {}", body.body);
        let ball = a.part(&name, |b| solids::ball(b, &name, body.ball_diameter * mm));
        for joint in &body.joints {
            let at = Pose { rotation: placed.rotation, position: placed.transform(&joint.at).coords };
            a.place(ball, &joint.name, &at);
        }
        for hole in plate.holes.iter().filter(|h| h.post > 0.0) {
            let name = format!("post of {}", hole.joints.join("/"));
            let part =
                a.part(&name, |b| solids::cylinder(b, &name, plate.post_diameter * mm, hole.post * mm));
            let foot = Vector3::new(hole.at.x, hole.at.y, plate.post_span(hole).0);
            let local = Pose { rotation: Rotation3::identity(), position: foot };
            a.place(part, &name, &within(&frame, &local));
        }
    }
    let radii = [0, 1].map(|k: usize| 0.5 * export.bodies[k].ball_diameter);
    for leg in &export.legs {
        let (d, length) = (leg.direction()?, leg.length());
        let (foot, head) = (radii[0], length - radii[1]);
        if !(foot < leg.cylinder && leg.cylinder < head) {
            let taken = foot.max(leg.cylinder) + radii[1];
            return Err(Unsupported::LegTooShort { leg: leg.number, length, taken });
        }
        let pieces =
            [("cylinder", foot, leg.cylinder, leg.diameters.0), ("rod", leg.cylinder, head, leg.diameters.1)];
        for (what, from, to, diameter) in pieces {
            let name = format!("{what} {}", leg.number);
            let part = a.part(&name, |b| solids::cylinder(b, &name, diameter * mm, (to - from) * mm));
            a.place(part, &name, &along(&(leg.foot + d * from), &d));
        }
    }
    Ok(a.finish())
}
