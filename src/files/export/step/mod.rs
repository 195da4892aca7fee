//! STEP AP242 (ISO 10303-242) assembly: base and platform with plate and joints, and legs with cylinder and rod, as
//! exact solids.
//!
//! Legs of a kind are places of one part. The rod is in the bore of its cylinder at its home position; both fit over
//! the whole stroke ([`Telescope`]).

mod assembly;
mod builder;
mod solids;

use nalgebra::{Rotation3, Vector3};

use self::assembly::{Group, StepAssembly, StepPart};
use super::model::frame_along;
use super::telescope::{LegKind, Telescope, kind_suffix};
use super::text::rounded;
use super::{Export, ExportBody, ExportedFile, Plate, Unsupported, Writer};
use machine::requirements::Housing;
use platform::geom::Pose;

/// The format `step`.
pub(super) static WRITER: Writer = Writer {
    leaves_out: "joint constraints: the parts stand at home; every joint is drawn as a ball, inside its housing box if it has one, and its part name states its kind; legs at a shared ball overlap near it",
    ..Writer::new(
        "AP242 assembly at home (millimetres): plates with holes, joints, and legs with rods that run in their cylinders, as exact solids, for CAD",
        |export| Ok(vec![ExportedFile::new("platform.step", assembly(export)?)]),
    )
};

fn plate_frame(plate: &Plate) -> Pose {
    Pose { rotation: Rotation3::from_matrix_unchecked(plate.axes), position: plate.origin.coords }
}

/// Plate, joints and posts of a body in its own frame.
fn body(a: &mut StepAssembly, export: &Export, body: &ExportBody) -> Result<StepPart, Unsupported> {
    let mm = export.unit.millimetres;
    let plate = body.plate()?;
    let frame = plate_frame(plate);
    let mut group = Group::default();
    let name = format!("{} plate", body.body);
    let material = plate.material.as_deref().unwrap_or_default();
    let part = a.part((&name, material), |b| solids::plate(b, &name, plate, mm));
    a.place(&mut group, part, &name, &frame);
    let kinds = export.joint_kinds(body);
    for (k, (sort, joints)) in kinds.iter().enumerate() {
        let name = format!("{} joint of the {}{}", sort.models, body.body, kind_suffix(k, kinds.len()));
        let ball =
            a.part((&name, &sort.description(mm)), |b| solids::ball(b, &name, body.ball_diameter * mm));
        for joint in body.joints.iter().filter(|j| joints.contains(&j.name.as_str())) {
            let at = Pose::shifted(joint.at.coords);
            a.place(&mut group, ball, &joint.name, &at);
        }
        // the box that distances of joints and envelopes use, along the axes of the body
        let Some(Housing::Box(edges)) = sort.housing else { continue };
        let name = format!("housing of the {name}");
        let block = a.part((&name, ""), |b| solids::block(b, &name, &(edges * mm)));
        for joint in body.joints.iter().filter(|j| joints.contains(&j.name.as_str())) {
            let at = Pose::shifted(joint.at.coords);
            a.place(&mut group, block, &format!("housing of {}", joint.name), &at);
        }
    }
    for hole in plate.holes.iter().filter(|h| h.post > 0.0) {
        let name = format!("post of {}", hole.joints.join("/"));
        let (diameter, height) = (plate.post_diameter * mm, hole.post * mm);
        let part = a.part((&name, material), |b| solids::cylinder(b, &name, diameter, height));
        let foot = Vector3::new(hole.at.x, hole.at.y, plate.post_span(hole).0);
        let local = Pose::shifted(foot);
        a.place(&mut group, part, &name, &frame.compose(&local));
    }
    Ok(a.assembled(body.body.name(), "", &group))
}

/// The motion of a kind of leg over its stroke, for the header.
fn stroke(kind: &LegKind, t: &Telescope, mm: f64) -> String {
    let [least, greatest] = t.range.map(|l| rounded(l * mm));
    let (name, numbers, rod) = (kind.name("leg"), kind.numbers(), rounded(t.rod * mm));
    let held = match t.held() {
        x if x > 0.0 => format!("in its cylinder by {} or more", rounded(x * mm)),
        x if x < 0.0 => format!("out of its cylinder by up to {}", rounded(-x * mm)),
        _ => "just in its cylinder at the greatest length".to_owned(),
    };
    let met = if t.clearance() < 0.0 {
        format!("; the cylinder meets the platform joint by up to {}", rounded(-t.clearance() * mm))
    } else {
        String::new()
    };
    format!("Part {name} ({numbers}), {least} to {greatest} long: the rod of {rod} is {held}{met}")
}

/// Cylinders and rods, each shape once: legs of different lengths may share them.
#[derive(Default)]
struct LegParts {
    cylinder: Option<StepPart>,
    rods: Vec<(f64, StepPart)>,
}

/// A leg of a kind from the origin along the third axis.
fn leg(
    a: &mut StepAssembly,
    export: &Export,
    (kind, t): (&LegKind, &Telescope),
    (parts, rod_name): (&mut LegParts, &str),
) -> StepPart {
    let mm = export.unit.millimetres;
    let (thick, thin) = export.legs[kind.legs[0]].diameters;
    let mut group = Group::default();
    let up = |z: f64| Pose::shifted(Vector3::new(0.0, 0.0, z));
    let height = (t.mouth - t.foot) * mm;
    // without individual limits, cylinder sizes are the same for the whole machine
    let cylinder = *parts.cylinder.get_or_insert_with(|| {
        a.part(("cylinder", ""), |b| {
            if t.floor < t.mouth {
                solids::sleeve(b, "cylinder", (thick * mm, thin * mm), ((t.floor - t.foot) * mm, height))
            } else {
                solids::cylinder(b, "cylinder", thick * mm, height)
            }
        })
    });
    a.place(&mut group, cylinder, "cylinder", &up(t.foot));
    let known = parts.rods.iter().find(|(length, _)| length.total_cmp(&t.rod).is_eq()).map(|(_, part)| *part);
    let rod = known.unwrap_or_else(|| {
        let part = a.part((rod_name, ""), |b| solids::cylinder(b, rod_name, thin * mm, t.rod * mm));
        parts.rods.push((t.rod, part));
        part
    });
    a.place(&mut group, rod, "rod", &up(t.tail(kind.length)));
    a.assembled(&kind.name("leg"), "", &group)
}

fn assembly(export: &Export) -> Result<String, Unsupported> {
    let mm = export.unit.millimetres;
    let kinds: Vec<(LegKind, Telescope)> = (export.leg_kinds().into_iter())
        .map(|kind| export.telescope(&kind).map(|t| (kind, t)))
        .collect::<Result<_, _>>()?;
    let lines = kinds.iter().map(|(kind, t)| stroke(kind, t, mm)).collect();
    let mut a = StepAssembly::new(export, lines);
    let mut whole = Group::default();
    let base_frame = Pose::identity();
    for (of, placed) in export.bodies.iter().zip([base_frame, export.home]) {
        let part = body(&mut a, export, of)?;
        a.place(&mut whole, part, of.body.name(), &placed);
    }
    let mut legs: Vec<(usize, StepPart)> = Vec::new();
    let mut parts = LegParts::default();
    // different shapes have different names, since programs identify parts by their names
    let first = kinds[0].1.rod;
    let one_rod = kinds.iter().all(|(_, t)| t.rod.total_cmp(&first).is_eq());
    for (kind, t) in &kinds {
        let name = if one_rod { "rod".to_owned() } else { kind.name("rod") };
        let part = leg(&mut a, export, (kind, t), (&mut parts, &name));
        legs.extend(kind.legs.iter().map(|i| (*i, part)));
    }
    legs.sort_unstable_by_key(|(i, _)| *i);
    for (i, part) in legs {
        let of = &export.legs[i];
        a.place(
            &mut whole,
            part,
            &format!("leg {}", of.number),
            &frame_along(&of.direction()?, of.foot.coords),
        );
    }
    Ok(a.finish(&whole))
}
