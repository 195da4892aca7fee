//! `[home]`, and the poses of `[workspace]`.

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

use super::constructions::{COORDINATES, NumberKind, Places, is_constructed, three_quantities};
use super::found::{check_keys, numbers, table};
use super::kind::{KeyKind, own, quantities, unit, vector};
use super::stored::{self, StoredValue, rows};
use super::{Code, FoundKey, KeyTable, key};
use crate::design::DesignModel;
use crate::design::construction::WrittenHome;
use crate::design::tree::{Entry, Node, Value, find};
use crate::design::violation::Findings;
use platform::geom::Pose;

const QUATERNION: KeyKind = own(r##"{"$ref": "#/$defs/quaternion"}"##, unit::NONE);
const ROWS: KeyKind = own(r##"{"$ref": "#/$defs/rows"}"##, unit::NONE);
const POSITION: &str = "position of the platform origin, base frame";
const RPY: &str = "roll, pitch, yaw in degrees, `R = Rz(yaw) Ry(pitch) Rx(roll)`; give exactly one of `rpy_deg`, `quat_wxyz` and `rotation`";
const QUAT: &str = "quaternion, scalar part first, normalised; its norm is within 1e-3 of 1";
const ROTATION: &str = "rows of R, orthonormal within 1e-9 and right-handed";
const ONE_ROTATION: &str = r#"{
    "required": ["position"],
    "oneOf": [{"required": ["rpy_deg"]}, {"required": ["quat_wxyz"]}, {"required": ["rotation"]}]
}"#;

/// A pose of plain numbers.
pub(super) static POSE: KeyTable<Pose> = KeyTable {
    definition: "pose",
    keys: &[
        key!("position": vector(unit::LENGTH), |_, _| (), |of| Some(of.position.json()); POSITION),
        key!("rpy_deg": vector(unit::DEGREES); RPY),
        key!("quat_wxyz": QUATERNION; QUAT),
        key!("rotation": ROWS, |_, _| (), |of| Some(rows(of.rotation.matrix())); ROTATION),
    ],
    rules: ONE_ROTATION,
    ..KeyTable::EMPTY
};

/// The home pose, whose numbers may be expressions.
pub(super) static HOME: KeyTable<DesignModel> = KeyTable {
    definition: "home_pose",
    keys: &[
        key!("position": quantities(3, unit::LENGTH),
            |_, _| (),
            |of| Some(
            match of.written_home() {
                Some(written) => stored::quantities(&written.position),
                None => of.home?.position.json(),
            }
        );
            POSITION),
        key!("rpy_deg": quantities(3, unit::DEGREES),
            |_, _| (),
            |of| {
            of.written_home()?.rpy_deg.as_ref().map(|angles| stored::quantities(angles))
        };
            RPY),
        key!("quat_wxyz": QUATERNION; QUAT),
        key!("rotation": ROWS,
            |_, _| (),
            |of| {
            let has_angles = of.written_home().is_some_and(|written| written.rpy_deg.is_some());
            of.home.filter(|_| !has_angles).map(|home| rows(home.rotation.matrix()))
        };
            ROTATION),
    ],
    rules: ONE_ROTATION,
    ..KeyTable::EMPTY
};

const ROTATION_HELP: &str =
    "give one of rpy_deg = [roll, pitch, yaw], quat_wxyz = [w, x, y, z], rotation = [[..], [..], [..]]";

/// `[home]`, with its numbers as written if one of them is an expression. Its pose is then computed later.
pub(super) fn home(report: &mut Findings<'_>, node: &Node) -> Option<(Pose, Option<(WrittenHome, Places)>)> {
    let constructed =
        |entries: &[Entry], key: &str| find(entries, key).is_some_and(|e| is_constructed(&e.node));
    let entries = match &node.value {
        Value::Table(entries) if ["position", "rpy_deg"].iter().any(|key| constructed(entries, key)) => {
            entries
        }
        _ => return Some((pose(report, node, "[home]")?, None)),
    };
    check_keys(report, entries, &POSE.names(), "[home]");
    let position = pose_position(report, node, entries, "[home]").and_then(|e| {
        three_quantities(report, &e.node, (NumberKind::Length, "`position` of [home]"), COORDINATES)
    });
    let turned = pose_rotation(report, node, entries, "[home]");
    let (rotation, angles) = match turned? {
        e if e.key == "rpy_deg" => {
            let read = three_quantities(
                report,
                &e.node,
                (NumberKind::Plain, "`rpy_deg` of [home]"),
                ("angle", "angles in degrees"),
            )?;
            (Rotation3::identity(), Some(read))
        }
        e => (rotation(report, e, "[home]")?, None),
    };
    let (position, mut parts) = position?;
    let (rpy_deg, places) = angles.unzip();
    parts.extend(places.into_iter().flatten());
    let pose = Pose { rotation, position: Vector3::zeros() };
    Some((
        pose,
        Some((
            WrittenHome { position, rpy_deg, pose, values: Vec::new() },
            Places { whole: node.span.clone(), parts },
        )),
    ))
}

fn pose(report: &mut Findings<'_>, node: &Node, place: &str) -> Option<Pose> {
    let entries = table(report, node, place)?;
    check_keys(report, entries, &POSE.names(), place);
    let position = pose_position(report, node, entries, place).and_then(|e| {
        let what = format!("`position` of {place}");
        numbers::<3>(report, &e.node, &what, Code::CoordinateCount, "coordinates x, y, z")
    });
    let rotation = pose_rotation(report, node, entries, place).and_then(|e| rotation(report, e, place));
    Some(Pose { rotation: rotation?, position: Vector3::from(position?) })
}

/// The entry with the position of a pose.
fn pose_position<'a>(
    report: &mut Findings<'_>,
    node: &Node,
    entries: &'a [Entry],
    place: &str,
) -> Option<&'a Entry> {
    let found = find(entries, "position");
    if found.is_none() {
        let message = format!("`position` of {place} is missing");
        report.refuse(Code::MissingKey, &node.span, message, "add position = [x, y, z]");
    }
    found
}

/// The one entry with the rotation of a pose.
fn pose_rotation<'a>(
    report: &mut Findings<'_>,
    node: &Node,
    entries: &'a [Entry],
    place: &str,
) -> Option<&'a Entry> {
    let given: Vec<&Entry> = entries.iter().filter(|e| POSE.names()[1..].contains(&e.key.as_str())).collect();
    match given.as_slice() {
        [one] => Some(*one),
        [] => report.refused(Code::Rotation, &node.span, format!("{place} has no rotation"), ROTATION_HELP),
        [_, second, ..] => {
            let message = format!("{place} gives its rotation more than once");
            report.refused(Code::Rotation, &second.key_span, message, ROTATION_HELP)
        }
    }
}

fn rotation(report: &mut Findings<'_>, entry: &Entry, place: &str) -> Option<Rotation3<f64>> {
    let what = format!("`{}` of {place}", entry.key);
    match entry.key.as_str() {
        "rpy_deg" => {
            let [roll, pitch, yaw] =
                numbers::<3>(report, &entry.node, &what, Code::CoordinateCount, "angles in degrees")?
                    .map(f64::to_radians);
            Some(Rotation3::from_euler_angles(roll, pitch, yaw))
        }
        "quat_wxyz" => {
            let [w, x, y, z] = numbers::<4>(
                report,
                &entry.node,
                &what,
                Code::CoordinateCount,
                "components w, x, y, z (scalar part first)",
            )?;
            let q = Quaternion::new(w, x, y, z);
            if (q.norm() - 1.0).abs() > 1e-3 {
                let message = format!("{what} has norm {}, not 1", q.norm());
                return report.refused(
                    Code::Rotation,
                    &entry.node.span,
                    message,
                    "divide the quaternion by its norm",
                );
            }
            Some(UnitQuaternion::from_quaternion(q).to_rotation_matrix())
        }
        _ => rotation_matrix(report, &entry.node, &what),
    }
}

/// Three rows. They are not orthonormalised, so that a saved pose reads back exactly.
fn rotation_matrix(report: &mut Findings<'_>, node: &Node, what: &str) -> Option<Rotation3<f64>> {
    let rows = match &node.value {
        Value::Array(rows) if rows.len() == 3 => rows,
        _ => {
            let message = format!("{what} is not an array of three rows");
            return report.refused(Code::WrongType, &node.span, message, ROTATION_HELP);
        }
    };
    let rows: Vec<Option<[f64; 3]>> = rows
        .iter()
        .map(|row| numbers::<3>(report, row, &format!("a row of {what}"), Code::CoordinateCount, "entries"))
        .collect();
    let rows: Vec<[f64; 3]> = rows.into_iter().collect::<Option<_>>()?;
    let m = Matrix3::from_fn(|i, j| rows[i][j]);
    let error = (m.transpose() * m - Matrix3::identity()).amax();
    if error > 1e-9 || m.determinant() < 0.0 {
        let message = format!(
            "{what} is not a rotation: R^T R differs from I by {error:e}, det R = {}",
            m.determinant()
        );
        let help = "give all digits and a right-handed frame, or use quat_wxyz, which is normalised";
        return report.refused(Code::Rotation, &node.span, message, help);
    }
    Some(Rotation3::from_matrix_unchecked(m))
}

/// `poses` of `[workspace]`.
pub(super) fn poses(found: &mut FoundKey<'_, '_>) -> Vec<Pose> {
    let Value::Array(list) = &found.entry.node.value else {
        let message = format!("`poses` is {}, not an array of poses", found.entry.node.value.kind());
        found.refuse(Code::WrongType, message, "write poses = [{ position = [..], rpy_deg = [..] }]");
        return Vec::new();
    };
    let mut read = |(i, e): (usize, &Node)| pose(found.report, e, &format!("pose {} of [workspace]", i + 1));
    list.iter().enumerate().filter_map(&mut read).collect()
}
