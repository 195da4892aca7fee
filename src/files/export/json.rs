//! Everything as one JSON document, lengths in millimetres.

use serde::Serialize;

use super::{
    DrilledHole, Export, ExportBody, ExportCalibration, ExportLeg, ExportedFile, LengthUnit, Plate,
    SizeChoice, Unsupported, Writer,
};
use platform::geom::Pose;

/// The format `json`.
pub(super) static WRITER: Writer =
    Writer::new("joints, plates, legs, poses and lengths in one document, for scripts", files);

// all formats have one signature, and others can fail
#[allow(clippy::unnecessary_wraps)]
fn files(export: &Export) -> Result<Vec<ExportedFile>, Unsupported> {
    // texts, numbers, lists and fields always serialise
    let mut text = serde_json::to_string(&ExportedDocument::of(export)).unwrap_or_default();
    text.push('\n');
    Ok(vec![ExportedFile::new("platform.json", text)])
}

/// The frames of the numbers.
const FRAMES: &str = "right-handed; a pose (R, p) takes platform to base coordinates: x_base = R x_platform + p; quat_wxyz is R, scalar first";
/// The frame of the numbers of a plate.
const PLATE_FRAME: &str = "plate coordinates (u, v, w) are origin + u*axes[0] + v*axes[1] + w*axes[2] in the frame of the body; the plate is 0 <= w <= thickness";

#[derive(Debug, Serialize)]
struct ExportedDocument<'a> {
    schema_version: u32,
    name: &'a str,
    source: Option<&'a str>,
    program: &'a str,
    units: &'static str,
    design_unit: LengthUnit,
    frames: &'static str,
    home: ExportedPose,
    base: BodyRecord<'a>,
    platform: BodyRecord<'a>,
    legs: Vec<ExportedLeg<'a>>,
    /// Absent if the design has no standard deviations of a calibration.
    #[serde(skip_serializing_if = "Option::is_none")]
    calibration: Option<UncertaintyRecord<'a>>,
    workspace: Vec<LengthsRecord>,
    trajectory: Vec<LengthsRecord>,
    choices: &'a [SizeChoice],
}

#[derive(Debug, Serialize)]
struct ExportedPose {
    position: [f64; 3],
    quat_wxyz: [f64; 4],
}

#[derive(Debug, Serialize)]
struct LengthsRecord {
    #[serde(flatten)]
    pose: ExportedPose,
    lengths: [f64; 6],
}

#[derive(Debug, Serialize)]
struct BodyRecord<'a> {
    ball_diameter: f64,
    joints: Vec<JointRecord<'a>>,
    /// Null if its holes overlap.
    plate: Option<PlateRecord<'a>>,
}

#[derive(Debug, Serialize)]
struct JointRecord<'a> {
    name: &'a str,
    at: [f64; 3],
}

#[derive(Debug, Serialize)]
struct PlateRecord<'a> {
    frame: &'static str,
    origin: [f64; 3],
    axes: [[f64; 3]; 3],
    legs_on_upper_side: bool,
    thickness: f64,
    margin: f64,
    hole_diameter: f64,
    volume: f64,
    /// Null if the design names no material.
    material: Option<&'a str>,
    /// Kilograms; null if the density is unknown.
    mass: Option<f64>,
    /// 0 without bolts.
    bolt_hole_diameter: f64,
    holes: Vec<ExportedHole<'a>>,
}

#[derive(Debug, Serialize)]
struct ExportedHole<'a> {
    joints: &'a [String],
    at: [f64; 2],
    post: f64,
    bolts: Vec<[f64; 2]>,
}

#[derive(Debug, Serialize)]
struct ExportedLeg<'a> {
    leg: usize,
    base_joint: &'a str,
    platform_joint: &'a str,
    home_length: f64,
    /// Shown length minus distance of the joints, millimetres; absent without a calibration.
    #[serde(skip_serializing_if = "Option::is_none")]
    offset: Option<f64>,
    cylinder_diameter: f64,
    rod_diameter: f64,
    cylinder_length: f64,
    /// Null if the cylinder leaves no space for the rod at home.
    rod_length: Option<f64>,
}

/// Uncertainty of calibrated joints and leg offsets. Two numbers with deviations `d`, `e` and correlation `r` have the
/// covariance `r d e`.
#[derive(Debug, Serialize)]
struct UncertaintyRecord<'a> {
    unknowns: &'a [String],
    values: Vec<f64>,
    deviations: Vec<f64>,
    /// Lower triangle with the diagonal.
    correlations: Vec<Vec<f64>>,
}

impl<'a> UncertaintyRecord<'a> {
    fn of(found: &'a ExportCalibration, mm: f64) -> Self {
        let scaled = |list: &[f64]| list.iter().map(|x| x * mm).collect();
        let row = |i: usize| (0..=i).map(|j| found.correlations[(i, j)]).collect();
        Self {
            unknowns: &found.names,
            values: scaled(&found.values),
            deviations: scaled(&found.deviations),
            correlations: (0..found.names.len()).map(row).collect(),
        }
    }
}

impl<'a> ExportedDocument<'a> {
    fn of(export: &'a Export) -> Self {
        let mm = export.unit.millimetres;
        let kinds = export.leg_kinds();
        let rod = |leg: &ExportLeg| {
            let kind = kinds.iter().find(|kind| kind.legs.contains(&(leg.number - 1)))?;
            Some(export.telescope(kind).ok()?.rod * mm)
        };
        let leg = |leg: &'a ExportLeg| {
            let (a, b) = export.ends_of(leg);
            ExportedLeg {
                leg: leg.number,
                base_joint: a,
                platform_joint: b,
                home_length: leg.length() * mm,
                offset: export.leg_offsets.map(|offsets| offsets[leg.number - 1] * mm),
                cylinder_diameter: leg.diameters.0 * mm,
                rod_diameter: leg.diameters.1 * mm,
                cylinder_length: leg.cylinder * mm,
                rod_length: rod(leg),
            }
        };
        Self {
            schema_version: 1,
            name: &export.name,
            source: export.source.as_deref(),
            program: &export.program,
            units: "mm",
            design_unit: export.unit,
            frames: FRAMES,
            home: ExportedPose::of(&export.home, mm),
            base: BodyRecord::of(&export.bodies[0], mm),
            platform: BodyRecord::of(&export.bodies[1], mm),
            legs: export.legs.iter().map(leg).collect(),
            calibration: export.calibration.as_ref().map(|found| UncertaintyRecord::of(found, mm)),
            workspace: lengths(export, &export.workspace),
            trajectory: lengths(export, &export.trajectory),
            choices: &export.choices,
        }
    }
}

impl ExportedPose {
    fn of(pose: &Pose, mm: f64) -> Self {
        Self { position: (pose.position * mm).into(), quat_wxyz: pose.quaternion() }
    }
}

fn lengths(export: &Export, poses: &[Pose]) -> Vec<LengthsRecord> {
    let mm = export.unit.millimetres;
    let record = |pose: &Pose| LengthsRecord {
        pose: ExportedPose::of(pose, mm),
        lengths: export.shown_at(pose).map(|l| l * mm),
    };
    poses.iter().map(record).collect()
}

impl<'a> BodyRecord<'a> {
    fn of(body: &'a ExportBody, mm: f64) -> Self {
        Self {
            ball_diameter: body.ball_diameter * mm,
            joints: body
                .joints
                .iter()
                .map(|j| JointRecord { name: &j.name, at: (j.at.coords * mm).into() })
                .collect(),
            plate: body.plate().ok().map(|plate| PlateRecord::of(plate, mm)),
        }
    }
}

impl<'a> PlateRecord<'a> {
    fn of(plate: &'a Plate, mm: f64) -> Self {
        let hole = |h: &'a DrilledHole| ExportedHole {
            joints: &h.joints,
            at: [h.at.x * mm, h.at.y * mm],
            post: h.post * mm,
            bolts: h.bolts.iter().map(|p| [p.x * mm, p.y * mm]).collect(),
        };
        Self {
            frame: PLATE_FRAME,
            origin: (plate.origin.coords * mm).into(),
            axes: [0, 1, 2].map(|k| plate.axes.column(k).into_owned().into()),
            legs_on_upper_side: plate.legs_above,
            thickness: plate.thickness * mm,
            margin: plate.outline.margin * mm,
            hole_diameter: plate.hole_diameter * mm,
            volume: plate.volume() * mm.powi(3),
            material: plate.material.as_deref(),
            mass: plate.mass(mm * 1e-3),
            bolt_hole_diameter: plate.bolt_diameter * mm,
            holes: plate.holes.iter().map(hole).collect(),
        }
    }
}
