//! C99 for controllers: the kinematics of one design without dependencies, allocation or recursion.
//!
//! `equipod.c` and `equipod.h` next to this file are the same for every design. They repeat the operations of
//! [`NearSolver`], so that in double the poses equal those of the library bit for bit. `equipod_vectors.h` holds
//! numbers of the library for the comparison in `equipod_selftest.c`. This module writes the numbers of the design.

mod cranks;
mod drives;
mod vectors;

use std::fmt::Write as _;

use nalgebra::{Point3, Vector3};

use super::text::{ascii, commented};
use super::{Export, ExportedFile, Unsupported, Writer};
use fk::{NearNumbers, NearSolver};
use machine::requirements::{ConeLimits, Hardware, JointAxes};
use platform::geom::{Pose, any_across};
use platform::manipulator::{Body, Manipulator};

/// The format `c`.
pub(super) static WRITER: Writer = Writer {
    leaves_out: "limits other than leg lengths, cone angles and angles of cranks; exact joints, which are doubles with a radius in the numbers of the tracker",
    takes_cranks: true,
    takes_coupled: true,
    ..Writer::new(
        "C99 for controllers, with a self-test, and LinuxCNC: inverse and tracked forward kinematics, Jacobian, limits",
        files,
    )
};

fn files(export: &Export) -> Result<Vec<ExportedFile>, Unsupported> {
    if let Some(coupled) = &export.coupled {
        return Ok(drives::files(export, coupled));
    }
    if let Some(cranks) = &export.cranks {
        return Ok(cranks::files(export, cranks));
    }
    one_cone_angle_a_body(export)?;
    let mut files = vec![
        ExportedFile::new("equipod.h", include_str!("equipod.h").to_string()),
        ExportedFile::new("equipod.c", include_str!("equipod.c").to_string()),
        ExportedFile::new("equipod_design.h", header(export)),
        ExportedFile::new("equipod_design.c", source(export)),
        ExportedFile::new("equipod_vectors.h", vectors::text(export)),
        ExportedFile::new("equipod_selftest.c", include_str!("equipod_selftest.c").to_string()),
        ExportedFile::new("CMakeLists.txt", include_str!("CMakeLists.txt").to_string()),
    ];
    files.extend(kinematics_modules());
    Ok(files)
}

/// Kinematics for `LinuxCNC`, which include the other files. They are in a separate folder, so that a C compiler takes
/// all sources of the folder above as one program. The header there is for builds with only that folder on their
/// include path.
fn kinematics_modules() -> [ExportedFile; 4] {
    [
        ExportedFile::new("equipodkins.h", "#include \"linuxcnc/equipodkins.h\"\n".to_string()),
        ExportedFile::new("linuxcnc/equipodkins.h", include_str!("linuxcnc/equipodkins.h").to_string()),
        ExportedFile::new("linuxcnc/equipodkins.c", include_str!("linuxcnc/equipodkins.c").to_string()),
        ExportedFile::new(
            "linuxcnc/equipodkins_ops.c",
            include_str!("linuxcnc/equipodkins_ops.c").to_string(),
        ),
    ]
}

/// Refuses joints of one body with different greatest angles.
fn one_cone_angle_a_body(export: &Export) -> Result<(), Unsupported> {
    let h = &export.hardware;
    let differs = |body: Body| {
        body.of((h.base_cone_angle, h.platform_cone_angle)).is_some_and(|s| s.common_deg().is_none())
    };
    Body::BOTH
        .into_iter()
        .find(|body| differs(*body))
        .map_or(Ok(()), |body| Err(Unsupported::ConeOfLegs(body)))
}

/// The octahedral platform equivalent to a design, for controllers that compute its poses.
#[derive(Debug, Clone, PartialEq)]
pub struct EquivalentOctahedral {
    /// The octahedral platform.
    pub manipulator: Manipulator,
    /// `A^-1`, which maps squared lengths of the design, minus `c`, to those of the octahedral platform.
    pub a: [[f64; 6]; 6],
    /// `-A^-1 c`.
    pub c: [f64; 6],
}

/// A double as a C literal that reads back equal.
pub(super) fn number(x: f64) -> String {
    if x.is_nan() {
        "NAN".to_string()
    } else if x.is_infinite() {
        if x > 0.0 { "HUGE_VAL".to_string() } else { "-HUGE_VAL".to_string() }
    } else {
        format!("{x:?}")
    }
}

/// `{x, y}` of numbers in the notation of `write`.
pub(super) fn braces(values: impl IntoIterator<Item = String>) -> String {
    format!("{{{}}}", values.into_iter().collect::<Vec<_>>().join(", "))
}

/// A row of numbers of the design: constants of the type `real_t`.
fn reals(values: impl IntoIterator<Item = f64>) -> String {
    braces(values.into_iter().map(|x| format!("R({})", number(x))))
}

fn matrix<const N: usize>(rows: &[[f64; N]]) -> String {
    format!("{{\n        {}\n    }}", rows.iter().map(|r| reals(*r)).collect::<Vec<_>>().join(",\n        "))
}

fn points(list: &[Point3<f64>; 6]) -> String {
    matrix(&list.map(|p| [p.x, p.y, p.z]))
}

/// The first comment of each file of the design.
fn heading(export: &Export) -> String {
    let unit = export.unit.label;
    let mut lines = vec![format!("{}: written by {}", export.name, export.program)];
    lines.extend(export.source.iter().map(|s| format!("Source of the design: {s}")));
    lines.push(format!("Lengths in {unit}, the unit of the design; squared lengths in its square."));
    // neither the beginning nor the end of a comment may occur inside one
    let plain = |line: String| ascii(&line, |_| "_".to_string()).replace("*/", "* /").replace("/*", "/ *");
    format!("/*\n{} */\n", commented(" *", lines.into_iter().map(plain)))
}

/// The additional C library of a kind of drive, the same for every design.
struct OwnLibrary {
    name: &'static str,
    header: &'static str,
    source: &'static str,
    selftest: &'static str,
}

impl OwnLibrary {
    /// Both libraries with header, source and vectors of a design.
    fn files(&self, header: String, source: String, vectors: String) -> Vec<ExportedFile> {
        let name = self.name;
        // the rules of the other library with an additional file
        let rules = include_str!("CMakeLists.txt")
            .replace("STATIC equipod.c ", &format!("STATIC equipod.c {name}.c "));
        vec![
            ExportedFile::new("equipod.h", include_str!("equipod.h").to_string()),
            ExportedFile::new("equipod.c", include_str!("equipod.c").to_string()),
            ExportedFile::new(&format!("{name}.h"), self.header.to_string()),
            ExportedFile::new(&format!("{name}.c"), self.source.to_string()),
            ExportedFile::new("equipod_design.h", header),
            ExportedFile::new("equipod_design.c", source),
            ExportedFile::new("equipod_vectors.h", vectors),
            ExportedFile::new("equipod_selftest.c", self.selftest.to_string()),
            ExportedFile::new("CMakeLists.txt", rules),
        ]
    }
}

fn header(export: &Export) -> String {
    let mut out = heading(export);
    out.push_str(
        "#ifndef EQUIPOD_DESIGN_H\n#define EQUIPOD_DESIGN_H\n\n#include \"equipod.h\"\n\n\
         #ifdef __cplusplus\nextern \"C\" {\n#endif\n\n\
         /* The design. */\nextern const equipod_legs equipod_nominal;\n\
         /* Limits of lengths and cone angles. */\nextern const equipod_limits equipod_design_limits;\n\
         /* The home pose. */\nextern const equipod_pose equipod_home;\n\
         /* Directions across each leg at home, one for both ends: in the base frame, and in the platform frame. */\n\
         extern const real_t equipod_across_base[6][3], equipod_across_platform[6][3];\n",
    );
    let _ = writeln!(
        out,
        "/* Millimetres of a unit of length. */\n#define EQUIPOD_UNIT_MILLIMETRES {}",
        number(export.unit.millimetres)
    );
    if export.leg_offsets.is_some() {
        out.push_str(
            "\n/* Leg offsets of the calibration: the distance of the joints of leg i is the length it shows less equipod_leg_offsets[i]. */\n\
             #define EQUIPOD_HAS_LEG_OFFSETS 1\nextern const real_t equipod_leg_offsets[6];\n",
        );
    }
    if export.calibration.is_some() {
        out.push_str(
            "\n/* Covariance of calibrated joints and leg offsets for equipod_pose_covariance. */\n\
             #define EQUIPOD_HAS_CALIBRATION 1\nextern const real_t equipod_calibration[42][42];\n",
        );
    }
    if export.octahedral.is_some() {
        out.push_str(
            "\n/* The octahedral platform the design is equivalent to, and the map of squared lengths to its own. */\n\
             #define EQUIPOD_HAS_OCTAHEDRAL 1\nextern const equipod_legs equipod_octahedral;\nextern const equipod_map equipod_to_octahedral;\n",
        );
    }
    out.push_str("\n#ifdef __cplusplus\n}\n#endif\n\n#endif\n");
    out
}

fn source(export: &Export) -> String {
    let mut out = heading(export);
    out.push_str("#include \"equipod_design.h\"\n\n#include <math.h>\n\n#define R(x) ((real_t)(x))\n\n");
    legs(&mut out, "equipod_nominal", &export.manipulator);
    limits(&mut out, &export.hardware, &ConeAxes::of(export));
    home(&mut out, &export.home);
    let across = across_at_home(export);
    let in_platform = across.map(|x| export.home.rotation.inverse() * x);
    for (name, list) in [("base", across), ("platform", in_platform)] {
        let _ =
            writeln!(out, "const real_t equipod_across_{name}[6][3] = {};", matrix(&list.map(Into::into)));
    }
    leg_offsets(&mut out, export);
    if let Some(found) = &export.calibration {
        let whole = found.of_legs(&export.manipulator.pairs());
        let rows = whole.row_iter().map(|row| reals(row.iter().copied())).collect::<Vec<_>>().join(",\n    ");
        let _ = writeln!(out, "\nconst real_t equipod_calibration[42][42] = {{\n    {rows}\n}};");
    }
    if let Some(octahedral) = &export.octahedral {
        out.push('\n');
        legs(&mut out, "equipod_octahedral", &octahedral.manipulator);
        let _ = writeln!(
            out,
            "const equipod_map equipod_to_octahedral = {{\n    {},\n    {}\n}};",
            matrix(&octahedral.a),
            reals(octahedral.c)
        );
    }
    out
}

fn legs(out: &mut String, name: &str, m: &Manipulator) {
    let NearNumbers { base, platform, loose, origin, centre, unit, residual_scale } =
        NearSolver::new(m).numbers();
    let ends = m.legs();
    let _ = writeln!(
        out,
        "const equipod_legs {name} = {{\n    {},\n    {},\n    {},\n    {},\n    {},\n    {},\n    {},\n    {},\n    R({}), R({})\n}};\n",
        points(&ends.map(|l| l.base)),
        points(&ends.map(|l| l.platform)),
        matrix(&base),
        matrix(&platform),
        reals(loose[0]),
        reals(loose[1]),
        reals(origin),
        reals(centre),
        number(unit),
        number(residual_scale)
    );
}

/// Axes of joint angles, unit vectors in leg order: at the base in its frame, at the platform in its own.
pub(super) struct ConeAxes {
    base: [Vector3<f64>; 6],
    platform: [Vector3<f64>; 6],
}

impl ConeAxes {
    /// The axes; those not given are along the legs at home.
    fn of(export: &Export) -> Self {
        let home: &Pose = &export.home;
        let mut at_home =
            export.manipulator.legs().map(|l| (home.transform(&l.platform) - l.base).normalize());
        if let Some(Ok(states)) = export.coupled.as_ref().map(|legs| legs.states(home)) {
            at_home = states.map(|state| state.line.normalize());
        }
        let given = |cone_angle: Option<ConeLimits>| match cone_angle.map(|s| s.axes) {
            Some(JointAxes::Given(axes)) => Some(axes.map(nalgebra::Unit::into_inner)),
            _ => None,
        };
        let hardware = &export.hardware;
        Self {
            base: given(hardware.base_cone_angle).unwrap_or(at_home),
            platform: given(hardware.platform_cone_angle)
                .unwrap_or_else(|| at_home.map(|u| home.rotation.inverse() * u)),
        }
    }
}

/// The home pose.
fn home(out: &mut String, pose: &Pose) {
    let r = pose.rotation.matrix();
    let rows: [[f64; 3]; 3] = std::array::from_fn(|i| [r[(i, 0)], r[(i, 1)], r[(i, 2)]]);
    let position = reals(pose.position.iter().copied());
    let _ =
        writeln!(out, "const equipod_pose equipod_home = {{\n    {},\n    {position}\n}};", matrix(&rows));
}

/// The leg offsets of a calibration.
fn leg_offsets(out: &mut String, export: &Export) {
    if let Some(offsets) = export.leg_offsets {
        let _ = writeln!(out, "\nconst real_t equipod_leg_offsets[6] = {};", reals(offsets));
    }
}

/// A unit vector across each leg at home, base frame: the first axis of its joints in the simulator's model.
fn across_at_home(export: &Export) -> [Vector3<f64>; 6] {
    let home = &export.home;
    export.manipulator.legs().map(|l| any_across(&(home.transform(&l.platform) - l.base).normalize()))
}

fn limits(out: &mut String, hardware: &Hardware, axes: &ConeAxes) {
    let (least, greatest) = hardware.leg_length.map_or((0.0, f64::INFINITY), |l| l.range());
    let cone_angle = |s: Option<ConeLimits>| s.map_or(180.0, |s| s.least_deg());
    let flags = [
        hardware.leg_length.is_some(),
        hardware.base_cone_angle.is_some(),
        hardware.platform_cone_angle.is_some(),
    ];
    let _ = writeln!(
        out,
        "const equipod_limits equipod_design_limits = {{\n    {},\n    {}, {}, {}, {},\n    {},\n    {}\n}};\n",
        flags.map(|f| u8::from(f).to_string()).join(", "),
        format_args!("R({})", number(least)),
        format_args!("R({})", number(greatest)),
        format_args!("R({})", number(cone_angle(hardware.base_cone_angle))),
        format_args!("R({})", number(cone_angle(hardware.platform_cone_angle))),
        matrix(&axes.base.map(Into::into)),
        matrix(&axes.platform.map(Into::into))
    );
}
