//! Everything as one JSON document, lengths in millimetres.

use serde_json::{Value, json};

use super::{Export, ExportBody, File, Unsupported, Writer};
use crate::geom::Pose;

/// The format `json`.
#[derive(Debug)]
pub(super) struct Json;

impl Writer for Json {
    fn name(&self) -> &'static str {
        "json"
    }

    fn purpose(&self) -> &'static str {
        "joints, plates, legs, poses and lengths in one document, for scripts"
    }

    fn files(&self, export: &Export) -> Result<Vec<File>, Unsupported> {
        let mut text = document(export).to_string();
        text.push('\n');
        Ok(vec![File::new("platform.json", text)])
    }
}

fn document(export: &Export) -> Value {
    let mm = export.unit.millimetres;
    json!({
        "schema_version": 1,
        "name": export.name,
        "source": export.source,
        "program": export.program,
        "units": "mm",
        "design_unit": { "label": export.unit.label, "mm": mm },
        "frames": "right-handed; a pose (R, p) takes platform to base coordinates: x_base = R x_platform + p; quat_wxyz is R, scalar first",
        "home": pose_record(&export.home, mm),
        "base": body_record(&export.bodies[0], mm),
        "platform": body_record(&export.bodies[1], mm),
        "legs": export.legs.iter().map(|leg| {
            let (a, b) = export.ends_of(leg);
            json!({
                "leg": leg.number, "base_joint": a, "platform_joint": b, "home_length": leg.length() * mm,
                "cylinder_diameter": leg.diameters.0 * mm, "rod_diameter": leg.diameters.1 * mm,
                "cylinder_length": leg.cylinder * mm,
            })
        }).collect::<Vec<_>>(),
        "workspace": lengths(export, &export.workspace),
        "trajectory": lengths(export, &export.trajectory),
        "choices": export.choices.iter().map(|c| {
            json!({ "what": c.what, "value": c.value, "unit": c.unit, "from": c.from })
        }).collect::<Vec<_>>(),
    })
}

fn pose_record(pose: &Pose, mm: f64) -> Value {
    json!({ "position": (pose.position * mm).as_slice(), "quat_wxyz": pose.quaternion() })
}

fn lengths(export: &Export, poses: &[Pose]) -> Vec<Value> {
    let mm = export.unit.millimetres;
    let record = |pose: &Pose| {
        let mut record = pose_record(pose, mm);
        record["lengths"] = json!(export.lengths_at(pose).map(|l| l * mm));
        record
    };
    poses.iter().map(record).collect()
}

/// `plate` is null where its holes overlap.
fn body_record(body: &ExportBody, mm: f64) -> Value {
    let joints: Vec<Value> =
        body.joints.iter().map(|j| json!({ "name": j.name, "at": (j.at.coords * mm).as_slice() })).collect();
    let plate = body.plate().map_or(Value::Null, |plate| {
        json!({
            "frame": "plate coordinates (u, v, w) are origin + u*axes[0] + v*axes[1] + w*axes[2] in the frame of the body; the plate is 0 <= w <= thickness",
            "origin": (plate.origin.coords * mm).as_slice(),
            "axes": plate.axes.column_iter().map(|c| json!([c[0], c[1], c[2]])).collect::<Vec<_>>(),
            "legs_on_upper_side": plate.legs_above,
            "thickness": plate.thickness * mm,
            "margin": plate.outline.margin * mm,
            "hole_diameter": plate.hole_diameter * mm,
            "volume": plate.volume() * mm.powi(3),
            "holes": plate.holes.iter().map(|h| json!({
                "joints": h.joints, "at": [h.at.x * mm, h.at.y * mm], "post": h.post * mm,
            })).collect::<Vec<_>>(),
        })
    });
    json!({ "ball_diameter": body.ball_diameter * mm, "joints": joints, "plate": plate })
}
