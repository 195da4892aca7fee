//! The optional tables.

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

use super::fields::{check_keys, element_span, number, numbers, table, text};
use super::requirements::positive;
use super::search::{SEARCH_KEYS, search};
use crate::design::report::Report;
use crate::design::tree::{Entry, Node, Value, find};
use crate::design::{Code, OptimizeTable, SearchTable, Trajectory, Workspace};
use crate::geom::Pose;
use crate::requirements::Region;

pub(super) const POSE_KEYS: [&str; 4] = ["position", "rpy_deg", "quat_wxyz", "rotation"];
pub(super) const WORKSPACE_KEYS: [&str; 6] =
    ["translation", "rotation_deg", "region", "grid", "poses", "trajectory"];
/// The keys of `[optimize]` that are no search.
pub(super) const LIMIT_KEYS: [&str; 3] = ["min_joint_distance", "min_abs_det", "characteristic_length"];
const ROTATION_HELP: &str =
    "give one of rpy_deg = [roll, pitch, yaw], quat_wxyz = [w, x, y, z], rotation = [[..], [..], [..]]";

/// `[home]`.
pub(super) fn home(report: &mut Report<'_>, node: &Node) -> Option<Pose> {
    pose(report, node, "[home]")
}

fn pose(report: &mut Report<'_>, node: &Node, place: &str) -> Option<Pose> {
    let entries = table(report, node, place)?;
    check_keys(report, entries, &POSE_KEYS, place);
    let position = if let Some(e) = find(entries, "position") {
        numbers::<3>(
            report,
            &e.node,
            &format!("`position` of {place}"),
            Code::CoordinateCount,
            "coordinates x, y, z",
        )
    } else {
        let message = format!("`position` of {place} is missing");
        report.refuse(Code::MissingKey, &node.span, message, "add position = [x, y, z]");
        None
    };
    let given: Vec<&Entry> = entries.iter().filter(|e| POSE_KEYS[1..].contains(&e.key.as_str())).collect();
    let rotation = match given.as_slice() {
        [one] => rotation(report, one, place),
        [] => {
            report.refuse(Code::Rotation, &node.span, format!("{place} has no rotation"), ROTATION_HELP);
            None
        }
        [_, second, ..] => {
            let message = format!("{place} gives its rotation more than once");
            report.refuse(Code::Rotation, &second.key_span, message, ROTATION_HELP);
            None
        }
    };
    Some(Pose { rotation: rotation?, position: Vector3::from(position?) })
}

fn rotation(report: &mut Report<'_>, entry: &Entry, place: &str) -> Option<Rotation3<f64>> {
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
                report.refuse(Code::Rotation, &entry.node.span, message, "divide the quaternion by its norm");
                return None;
            }
            Some(UnitQuaternion::from_quaternion(q).to_rotation_matrix())
        }
        _ => rotation_matrix(report, &entry.node, &what),
    }
}

/// Three rows. Taken as they are, without orthonormalisation, so that a saved pose reads back exactly.
fn rotation_matrix(report: &mut Report<'_>, node: &Node, what: &str) -> Option<Rotation3<f64>> {
    let rows = match &node.value {
        Value::Array(rows) if rows.len() == 3 => rows,
        _ => {
            let message = format!("{what} is not an array of three rows");
            report.refuse(Code::WrongType, &node.span, message, ROTATION_HELP);
            return None;
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
        let message =
            format!("{what} is no rotation: R^T R differs from I by {error:e}, det R = {}", m.determinant());
        let help = "give all digits and a right-handed frame, or use quat_wxyz, which is normalised";
        report.refuse(Code::Rotation, &node.span, message, help);
        return None;
    }
    Some(Rotation3::from_matrix_unchecked(m))
}

/// `[workspace]`.
pub(super) fn workspace(report: &mut Report<'_>, top: &[Entry]) -> Workspace {
    let mut result = Workspace::default();
    let Some(entry) = find(top, "workspace") else { return result };
    let Some(entries) = table(report, &entry.node, "[workspace]") else { return result };
    check_keys(report, entries, &WORKSPACE_KEYS, "[workspace]");
    if let Some(region) = find(entries, "region").and_then(|e| region(report, e)) {
        result.region = region;
    }
    let file = find(entries, "trajectory").and_then(|e| text(report, e));
    result.trajectory = file.map(|file| Trajectory { file, poses: Vec::new() });
    if let Some(d) = half_widths(report, entries, "translation") {
        result.translation = d;
    }
    if let Some(w) = half_widths(report, entries, "rotation_deg") {
        result.rotation_deg = w;
        for k in (0..3).filter(|k| w[*k] > 180.0) {
            let span = find(entries, "rotation_deg").map_or(0..0, |e| element_span(&e.node, k));
            let message = format!("a half width of {} degrees", w[k]);
            report.refuse(Code::OutOfRange, &span, message, "stay within 180 degrees");
        }
    }
    if let Some(grid) = find(entries, "grid").and_then(|e| grid(report, &e.node)) {
        result.grid = grid;
    }
    if let Some(poses) = find(entries, "poses") {
        result.poses = single_poses(report, &poses.node);
    }
    if result.has_box() && find(top, "home").is_none() {
        let help = "add [home] with position and rpy_deg, or list single poses";
        report.refuse(
            Code::MissingHome,
            &entry.key_span,
            "the box lies around [home], which is missing",
            help,
        );
    }
    result
}

fn region(report: &mut Report<'_>, entry: &Entry) -> Option<Region> {
    match text(report, entry)?.as_str() {
        "box" => Some(Region::Box),
        "ellipsoid" => Some(Region::Ellipsoid),
        _ => {
            let help = "write \"box\" or \"ellipsoid\"";
            report.refuse(Code::WrongType, &entry.node.span, "`region` is neither box nor ellipsoid", help);
            None
        }
    }
}

fn half_widths(report: &mut Report<'_>, entries: &[Entry], key: &str) -> Option<Vector3<f64>> {
    let node = &find(entries, key)?.node;
    let w = numbers::<3>(report, node, &format!("`{key}`"), Code::CoordinateCount, "half widths")?;
    for (i, x) in w.iter().enumerate().filter(|(_, x)| **x < 0.0) {
        let message = format!("a half width of {x}");
        report.refuse(Code::NotPositive, &element_span(node, i), message, "half widths are not negative");
    }
    w.iter().all(|x| *x >= 0.0).then(|| Vector3::from(w))
}

fn grid(report: &mut Report<'_>, node: &Node) -> Option<usize> {
    let x = number(report, node, "`grid`")?;
    let found = (1..=5_u8).find(|n| (f64::from(*n) - x).abs() < f64::EPSILON);
    if found.is_none() {
        let help = "give 1 (centre), 2 (centre and corners), 3, 4 or 5 points per axis";
        report.refuse(Code::Grid, &node.span, format!("a grid of {x} points per axis"), help);
    }
    found.map(usize::from)
}

fn single_poses(report: &mut Report<'_>, node: &Node) -> Vec<Pose> {
    let Value::Array(list) = &node.value else {
        let message = format!("`poses` is {}, not an array of poses", node.value.kind());
        report.refuse(
            Code::WrongType,
            &node.span,
            message,
            "write poses = [{ position = [..], rpy_deg = [..] }]",
        );
        return Vec::new();
    };
    list.iter()
        .enumerate()
        .filter_map(|(i, e)| pose(report, e, &format!("pose {} of [workspace]", i + 1)))
        .collect()
}

/// `[optimize]`.
pub(super) fn optimize(report: &mut Report<'_>, top: &[Entry]) -> (OptimizeTable, SearchTable) {
    let place = "[optimize]";
    let entries = find(top, "optimize").and_then(|e| table(report, &e.node, place)).unwrap_or_default();
    let known: Vec<&str> = LIMIT_KEYS.into_iter().chain(SEARCH_KEYS).collect();
    check_keys(report, entries, &known, place);
    let [min_joint_distance, min_abs_det, characteristic_length] =
        LIMIT_KEYS.map(|key| positive(report, entries, key));
    let limits = OptimizeTable { min_joint_distance, min_abs_det, characteristic_length };
    (limits, search(report, entries))
}
