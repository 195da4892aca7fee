//! The optional tables, with those of the requirements: `[hardware]`, `[speed]`, `[[loads]]` and `[[keep_out]]`.

use nalgebra::{Matrix3, Point3, Quaternion, Rotation3, Unit, UnitQuaternion, Vector3};

use super::constructions::{Places, is_constructed, three_quantities};
use super::joint_models as joints;
use super::joints::NamedJoints;
use super::search::{SEARCH_KEYS, search};
use super::{check_keys, element_span, number, numbers, shown, table, text};
use crate::design::construction::WrittenHome;
use crate::design::tree::{Entry, Node, Value, find};
use crate::design::violation::Findings;
use crate::design::{Code, OptimizeTable, SearchTable, Trajectory, Workspace};
use machine::requirements::{
    Hardware, Housing, JointAxes, KeepOut, KeepOutShape, LegBody, LegMasses, LegPart, LengthLimits,
    ListedFrom, Load, PlatformSpeed, PlatformStiffness, Region, Swing,
};
use platform::geom::Pose;
use platform::manipulator::Body;

pub(super) const POSE_KEYS: [&str; 4] = ["position", "rpy_deg", "quat_wxyz", "rotation"];
pub(super) const WORKSPACE_KEYS: [&str; 7] =
    ["translation", "rotation_deg", "region", "grid", "poses", "trajectory", "relative_to"];
/// The keys of `[optimize]` that are not a search.
pub(super) const LIMIT_KEYS: [&str; 3] = ["min_joint_distance", "min_abs_det", "characteristic_length"];
const ROTATION_HELP: &str =
    "give one of rpy_deg = [roll, pitch, yaw], quat_wxyz = [w, x, y, z], rotation = [[..], [..], [..]]";

/// `[home]`, and how its numbers are written where one of them is an expression. Its pose then follows later.
pub(super) fn home(report: &mut Findings<'_>, node: &Node) -> Option<(Pose, Option<(WrittenHome, Places)>)> {
    let constructed =
        |entries: &[Entry], key: &str| find(entries, key).is_some_and(|e| is_constructed(&e.node));
    let entries = match &node.value {
        Value::Table(entries) if ["position", "rpy_deg"].iter().any(|key| constructed(entries, key)) => {
            entries
        }
        _ => return Some((pose(report, node, "[home]")?, None)),
    };
    check_keys(report, entries, &POSE_KEYS, "[home]");
    let position = pose_position(report, node, entries, "[home]").and_then(|e| {
        three_quantities(report, &e.node, "`position` of [home]", ("coordinate", "coordinates x, y, z"))
    });
    let turned = pose_rotation(report, node, entries, "[home]");
    let (rotation, angles) = match turned? {
        e if e.key == "rpy_deg" => {
            let read =
                three_quantities(report, &e.node, "`rpy_deg` of [home]", ("angle", "angles in degrees"))?;
            (Rotation3::identity(), Some(read))
        }
        e => (rotation(report, e, "[home]")?, None),
    };
    let (position, mut parts) = position?;
    let (rpy_deg, places) = angles.unzip();
    parts.extend(places.into_iter().flatten());
    let pose = Pose { rotation, position: Vector3::zeros() };
    Some((pose, Some((WrittenHome { position, rpy_deg, pose }, Places { whole: node.span.clone(), parts }))))
}

fn pose(report: &mut Findings<'_>, node: &Node, place: &str) -> Option<Pose> {
    let entries = table(report, node, place)?;
    check_keys(report, entries, &POSE_KEYS, place);
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
    let given: Vec<&Entry> = entries.iter().filter(|e| POSE_KEYS[1..].contains(&e.key.as_str())).collect();
    match given.as_slice() {
        [one] => Some(*one),
        [] => {
            report.refuse(Code::Rotation, &node.span, format!("{place} has no rotation"), ROTATION_HELP);
            None
        }
        [_, second, ..] => {
            let message = format!("{place} gives its rotation more than once");
            report.refuse(Code::Rotation, &second.key_span, message, ROTATION_HELP);
            None
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
                report.refuse(Code::Rotation, &entry.node.span, message, "divide the quaternion by its norm");
                return None;
            }
            Some(UnitQuaternion::from_quaternion(q).to_rotation_matrix())
        }
        _ => rotation_matrix(report, &entry.node, &what),
    }
}

/// Three rows. Taken as they are, without orthonormalisation, so that a saved pose reads back exactly.
fn rotation_matrix(report: &mut Findings<'_>, node: &Node, what: &str) -> Option<Rotation3<f64>> {
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
        let message = format!(
            "{what} is not a rotation: R^T R differs from I by {error:e}, det R = {}",
            m.determinant()
        );
        let help = "give all digits and a right-handed frame, or use quat_wxyz, which is normalised";
        report.refuse(Code::Rotation, &node.span, message, help);
        return None;
    }
    Some(Rotation3::from_matrix_unchecked(m))
}

/// `[workspace]`.
pub(super) fn workspace(report: &mut Findings<'_>, top: &[Entry]) -> Workspace {
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
    if let Some(relative) = find(entries, "relative_to") {
        result.listed_from = listed_from(report, relative).unwrap_or_default();
        if result.poses.is_empty() && result.trajectory.is_none() {
            let help =
                "list `poses` or name a `trajectory`, or remove `relative_to`: the box is always around home";
            let message = "`relative_to` says what listed poses are measured from, and none are listed";
            report.refuse(Code::MissingKey, &relative.key_span, message, help);
        }
        if result.listed_from == ListedFrom::Home && find(top, "home").is_none() {
            let help = "add [home] with position and rpy_deg, or write relative_to = \"base\"";
            let message = "the poses are measured from [home], which is missing";
            report.refuse(Code::MissingHome, &relative.key_span, message, help);
        }
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

fn listed_from(report: &mut Findings<'_>, entry: &Entry) -> Option<ListedFrom> {
    let word = text(report, entry)?;
    let known = [ListedFrom::Base, ListedFrom::Home].into_iter().find(|from| from.name() == word);
    if known.is_none() {
        let message = format!("`relative_to` is \"{}\"", shown(&word));
        report.refuse(Code::WrongType, &entry.node.span, message, "write \"home\" or \"base\"");
    }
    known
}

fn region(report: &mut Findings<'_>, entry: &Entry) -> Option<Region> {
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

fn half_widths(report: &mut Findings<'_>, entries: &[Entry], key: &str) -> Option<Vector3<f64>> {
    let node = &find(entries, key)?.node;
    let w = numbers::<3>(report, node, &format!("`{key}`"), Code::CoordinateCount, "half widths")?;
    for (i, x) in w.iter().enumerate().filter(|(_, x)| **x < 0.0) {
        let message = format!("a half width of {x}");
        report.refuse(Code::NotPositive, &element_span(node, i), message, "half widths are not negative");
    }
    w.iter().all(|x| *x >= 0.0).then(|| Vector3::from(w))
}

fn grid(report: &mut Findings<'_>, node: &Node) -> Option<usize> {
    let x = number(report, node, "`grid`")?;
    let found = (1..=5_u8).find(|n| (f64::from(*n) - x).abs() < f64::EPSILON);
    if found.is_none() {
        let help = "give 1 (centre), 2 (centre and corners), 3, 4 or 5 points per axis";
        report.refuse(Code::Grid, &node.span, format!("a grid of {x} points per axis"), help);
    }
    found.map(usize::from)
}

fn single_poses(report: &mut Findings<'_>, node: &Node) -> Vec<Pose> {
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
pub(super) fn optimize(
    report: &mut Findings<'_>,
    top: &[Entry],
    bodies: [Option<&NamedJoints>; 2],
) -> (OptimizeTable, SearchTable) {
    let place = "[optimize]";
    let entries = find(top, "optimize").and_then(|e| table(report, &e.node, place)).unwrap_or_default();
    let known: Vec<&str> = LIMIT_KEYS.into_iter().chain(SEARCH_KEYS).collect();
    check_keys(report, entries, &known, place);
    let [min_joint_distance, min_abs_det, characteristic_length] =
        LIMIT_KEYS.map(|key| positive(report, entries, key));
    let limits = OptimizeTable { min_joint_distance, min_abs_det, characteristic_length };
    (limits, search(report, entries, bodies))
}

pub(super) const HARDWARE_KEYS: [&str; 28] = [
    "joint_diameter",
    "base_housing",
    "platform_housing",
    "leg_diameter",
    "rod_diameter",
    "cylinder_length",
    "leg_clearance",
    "leg_length",
    "dead_length",
    "stroke",
    "base_swing_deg",
    "platform_swing_deg",
    "base_axes",
    "platform_axes",
    "base_joint",
    "platform_joint",
    "screw_lead",
    "max_leg_force",
    "max_leg_speed",
    "leg_stiffness",
    "cylinder_mass",
    "cylinder_center",
    "cylinder_inertia",
    "rod_mass",
    "rod_center",
    "rod_inertia",
    "reflected_mass",
    "drives",
];

/// A positive number of a table.
pub(super) fn positive(report: &mut Findings<'_>, entries: &[Entry], key: &str) -> Option<f64> {
    let node = &find(entries, key)?.node;
    let x = number(report, node, &format!("`{key}`"))?;
    if x <= 0.0 {
        report.refuse(Code::NotPositive, &node.span, format!("`{key}` is {x}"), "give a positive number");
    }
    Some(x)
}

/// A number of a table that is not negative.
pub(super) fn not_negative(report: &mut Findings<'_>, entries: &[Entry], key: &str) -> Option<f64> {
    let node = &find(entries, key)?.node;
    let x = number(report, node, &format!("`{key}`"))?;
    if x < 0.0 {
        report.refuse(Code::NotPositive, &node.span, format!("`{key}` is {x}"), "give 0 or more");
    }
    Some(x)
}

/// Three numbers of a table.
pub(super) fn vector(report: &mut Findings<'_>, entries: &[Entry], key: &str) -> Option<Vector3<f64>> {
    let node = &find(entries, key)?.node;
    numbers::<3>(report, node, &format!("`{key}`"), Code::CoordinateCount, "coordinates x, y, z")
        .map(Vector3::from)
}

/// Three positive numbers of a node.
fn edges(report: &mut Findings<'_>, node: &Node, key: &str) -> Option<Vector3<f64>> {
    let e = numbers::<3>(report, node, &format!("`{key}`"), Code::CoordinateCount, "edge lengths")?;
    for (i, x) in e.iter().enumerate().filter(|(_, x)| **x <= 0.0) {
        let message = format!("an edge length of {x}");
        report.refuse(Code::NotPositive, &element_span(node, i), message, "give positive edge lengths");
    }
    Some(Vector3::from(e))
}

/// A key that asks for another one.
fn needs(report: &mut Findings<'_>, entries: &[Entry], key: &str, other: &str) {
    if let (Some(e), None) = (find(entries, key), find(entries, other)) {
        let message = format!("`{key}` without `{other}`");
        report.refuse(Code::MissingKey, &e.key_span, message, format!("add `{other}`, or remove `{key}`"));
    }
}

/// `drives` of `[hardware]`: the name of a table, which is read where a drive is chosen from it.
pub(super) fn drive_table(report: &mut Findings<'_>, top: &[Entry]) -> Option<String> {
    let Value::Table(entries) = &find(top, "hardware")?.node.value else { return None };
    find(entries, "drives").and_then(|e| text(report, e))
}

/// `[hardware]`.
pub(super) fn hardware(report: &mut Findings<'_>, top: &[Entry]) -> Hardware {
    let place = "[hardware]";
    let entries = find(top, "hardware").and_then(|e| table(report, &e.node, place)).unwrap_or_default();
    check_keys(report, entries, &HARDWARE_KEYS, place);
    let rod = positive(report, entries, "rod_diameter");
    let cylinder = positive(report, entries, "cylinder_length");
    for (key, other) in [
        ("rod_diameter", "cylinder_length"),
        ("cylinder_length", "rod_diameter"),
        ("rod_diameter", "leg_diameter"),
        ("leg_clearance", "leg_diameter"),
        ("dead_length", "stroke"),
        ("stroke", "dead_length"),
        ("cylinder_mass", "cylinder_center"),
        ("cylinder_center", "cylinder_mass"),
        ("cylinder_inertia", "cylinder_mass"),
        ("rod_mass", "rod_center"),
        ("rod_center", "rod_mass"),
        ("rod_inertia", "rod_mass"),
    ] {
        needs(report, entries, key, other);
    }
    let body = positive(report, entries, "leg_diameter");
    let [base_joint, platform_joint] = Body::BOTH.map(|body| joints::joint_model(report, entries, body));
    let screw_lead = joints::screw_lead(report, entries, [&base_joint, &platform_joint]);
    Hardware {
        base_housing: housing(report, entries, "base_housing"),
        platform_housing: housing(report, entries, "platform_housing"),
        base_joint_housing: base_joint.housing,
        platform_joint_housing: platform_joint.housing,
        joint_diameter: positive(report, entries, "joint_diameter"),
        leg_body: body.map(|diameter| LegBody { diameter, rod: cylinder.zip(rod) }),
        leg_clearance: not_negative(report, entries, "leg_clearance"),
        leg_length: length_limits(report, entries),
        base_swing: swing(report, entries, ["base_swing_deg", "base_axes"], &base_joint.swing_deg),
        platform_swing: swing(
            report,
            entries,
            ["platform_swing_deg", "platform_axes"],
            &platform_joint.swing_deg,
        ),
        base_universal: base_joint.universal,
        platform_universal: platform_joint.universal,
        base_bending: base_joint.bending,
        platform_bending: platform_joint.bending,
        screw_lead,
        max_leg_force: positive(report, entries, "max_leg_force"),
        max_leg_speed: positive(report, entries, "max_leg_speed"),
        leg_stiffness: positive(report, entries, "leg_stiffness"),
        leg_masses: leg_masses(report, entries),
    }
}

/// Masses of cylinder, rod and drive.
fn leg_masses(report: &mut Findings<'_>, entries: &[Entry]) -> Option<LegMasses> {
    let mut part = |[mass, center, inertia]: [&str; 3]| {
        let mass = positive(report, entries, mass);
        let center = not_negative(report, entries, center).unwrap_or_default();
        let inertia = not_negative(report, entries, inertia);
        mass.map(|mass| LegPart {
            mass,
            center,
            inertia: inertia.unwrap_or_else(|| LegPart::uniform_inertia(mass, center)),
        })
    };
    let cylinder = part(["cylinder_mass", "cylinder_center", "cylinder_inertia"]);
    let rod = part(["rod_mass", "rod_center", "rod_inertia"]);
    let reflected = positive(report, entries, "reflected_mass");
    if cylinder.is_none() && rod.is_none() && reflected.is_none() {
        return None;
    }
    Some(LegMasses {
        cylinder: cylinder.unwrap_or_default(),
        rod: rod.unwrap_or_default(),
        reflected: reflected.unwrap_or_default(),
    })
}

/// A diameter, or the edges of a box.
pub(super) fn housing(report: &mut Findings<'_>, entries: &[Entry], key: &str) -> Option<Housing> {
    let node = &find(entries, key)?.node;
    if matches!(node.value, Value::Array(_)) {
        return edges(report, node, key).map(Housing::Box);
    }
    positive(report, entries, key).map(Housing::Sphere)
}

fn length_limits(report: &mut Findings<'_>, entries: &[Entry]) -> Option<LengthLimits> {
    let dead = not_negative(report, entries, "dead_length");
    let stroke = positive(report, entries, "stroke");
    let Some(entry) = find(entries, "leg_length") else {
        return dead.zip(stroke).map(|(dead, stroke)| LengthLimits::Stroke { dead, stroke });
    };
    if stroke.is_some() {
        let help = "keep `leg_length`, or `dead_length` with `stroke`";
        report.refuse(Code::ConflictingKeys, &entry.key_span, "leg lengths are limited twice", help);
    }
    let what = "lengths, least and greatest";
    let [least, greatest] = numbers::<2>(report, &entry.node, "`leg_length`", Code::CoordinateCount, what)?;
    if !(least >= 0.0 && greatest > least) {
        let message = format!("leg lengths from {least} to {greatest}");
        report.refuse(
            Code::OutOfRange,
            &entry.node.span,
            message,
            "give [least, greatest], the least not negative",
        );
    }
    Some(LengthLimits::Range(least, greatest))
}

/// The limit of the body for all legs whose joints have none of their own.
fn swing(
    report: &mut Findings<'_>,
    entries: &[Entry],
    [limit, axes]: [&str; 2],
    own: &[Option<f64>; 6],
) -> Option<Swing> {
    let axes = find(entries, axes).and_then(|e| joint_axes(report, e)).unwrap_or_default();
    let of_body = angle_to_half_turn(report, entries, limit);
    let is_limited = of_body.is_some() || own.iter().any(Option::is_some);
    is_limited.then(|| Swing { limits_deg: own.map(|deg| deg.or(of_body).unwrap_or(180.0)), axes })
}

/// An angle above 0 and at most 180 degrees.
pub(super) fn angle_to_half_turn(report: &mut Findings<'_>, entries: &[Entry], key: &str) -> Option<f64> {
    let angle = positive(report, entries, key)?;
    if angle > 180.0 {
        let span = find(entries, key).map_or(0..0, |e| e.node.span.clone());
        report.refuse(Code::OutOfRange, &span, format!("`{key}` is {angle}"), "stay within 180 degrees");
    }
    Some(angle)
}

/// The word for the normal of the plane of the joints.
const NORMAL: &str = "normal";
/// Stands for a normal until the joints are known.
const NOT_YET: Unit<Vector3<f64>> = Unit::new_unchecked(Vector3::new(0.0, 0.0, 1.0));

/// Whether an axis is the normal of the plane of the joints.
pub(super) fn is_normal(node: &Node) -> bool {
    matches!(&node.value, Value::Text(t) if t == NORMAL)
}

/// The axes that a key says. Normals are put in where the joints are known ([`super::axes::turn_to_normals`]).
pub(super) fn joint_axes(report: &mut Findings<'_>, entry: &Entry) -> Option<JointAxes> {
    let help = "write \"home\", \"normal\", \"optimize\", one vector for all joints, or six in leg order, each a vector or \"normal\"";
    match &entry.node.value {
        Value::Text(t) if t == "home" => Some(JointAxes::Home),
        Value::Text(t) if t == "optimize" => Some(JointAxes::Optimize),
        Value::Text(t) if t == NORMAL => Some(JointAxes::Given([NOT_YET; 6])),
        Value::Array(list) if list.iter().all(|node| matches!(node.value, Value::Number(_))) => {
            axis(report, &entry.node, &entry.key).map(|axis| JointAxes::Given([axis; 6]))
        }
        Value::Array(list) if list.len() == 6 => {
            let one =
                |node: &Node| if is_normal(node) { Some(NOT_YET) } else { axis(report, node, &entry.key) };
            let axes: Vec<_> = list.iter().map(one).collect();
            let axes: Vec<_> = axes.into_iter().collect::<Option<_>>()?;
            axes.try_into().ok().map(JointAxes::Given)
        }
        _ => {
            let message = format!("`{}` is not a choice of axes", entry.key);
            report.refuse(Code::WrongType, &entry.node.span, message, help);
            None
        }
    }
}

pub(super) fn axis(report: &mut Findings<'_>, node: &Node, key: &str) -> Option<Unit<Vector3<f64>>> {
    let what = format!("an axis of `{key}`");
    let v = numbers::<3>(report, node, &what, Code::CoordinateCount, "components").map(Vector3::from)?;
    // a vector that is a unit vector already is kept to the bit, so that a saved design reads back equal
    let unit = if (v.norm_squared() - 1.0).abs() < 1e-15 {
        Some(Unit::new_unchecked(v))
    } else {
        Unit::try_new(v, 0.0)
    };
    if unit.is_none() {
        report.refuse(Code::NotPositive, &node.span, format!("{what} is zero"), "give a direction");
    }
    unit
}

/// `[speed]`.
pub(super) fn speed(report: &mut Findings<'_>, top: &[Entry]) -> Option<PlatformSpeed> {
    let entries = table(report, &find(top, "speed")?.node, "[speed]")?;
    check_keys(report, entries, &["linear", "angular_deg"], "[speed]");
    Some(PlatformSpeed {
        linear: not_negative(report, entries, "linear").unwrap_or_default(),
        angular_deg: not_negative(report, entries, "angular_deg").unwrap_or_default(),
    })
}

pub(super) const STIFFNESS_KEYS: [&str; 3] = ["linear", "angular", "natural_frequency"];

/// `[stiffness]`, which is about legs whose stiffness is known.
pub(super) fn stiffness(
    report: &mut Findings<'_>,
    top: &[Entry],
    hardware: &Hardware,
) -> Option<PlatformStiffness> {
    let entry = find(top, "stiffness")?;
    let entries = table(report, &entry.node, "[stiffness]")?;
    check_keys(report, entries, &STIFFNESS_KEYS, "[stiffness]");
    if hardware.leg_stiffness.is_none() {
        let message = "[stiffness] needs the stiffness of a leg";
        let help = "add `leg_stiffness` to [hardware], force units per design unit";
        report.refuse(Code::MissingKey, &entry.key_span, message, help);
    }
    let [linear, angular, natural_frequency] = STIFFNESS_KEYS.map(|key| positive(report, entries, key));
    Some(PlatformStiffness { linear, angular, natural_frequency })
}

/// The tables of an array of tables.
fn tables<'a>(report: &mut Findings<'_>, top: &'a [Entry], key: &str) -> Vec<&'a [Entry]> {
    let Some(entry) = find(top, key) else { return Vec::new() };
    let Value::Array(list) = &entry.node.value else {
        let message = format!("`{key}` is {}, not a list of tables", entry.node.value.kind());
        report.refuse(Code::WrongType, &entry.node.span, message, format!("write [[{key}]] above each"));
        return Vec::new();
    };
    list.iter().filter_map(|node| table(report, node, &format!("[[{key}]]"))).collect()
}

fn fixed_to(report: &mut Findings<'_>, entries: &[Entry]) -> Option<Body> {
    let entry = find(entries, "fixed_to")?;
    let word = text(report, entry)?;
    let body = word.parse().ok();
    if body.is_none() {
        let message = format!("`fixed_to` is \"{}\"", shown(&word));
        report.refuse(Code::WrongType, &entry.node.span, message, "write \"base\" or \"platform\"");
    }
    body
}

fn name(report: &mut Findings<'_>, entries: &[Entry], default: String) -> String {
    find(entries, "name").and_then(|e| text(report, e)).unwrap_or(default)
}

/// `[[loads]]`.
pub(super) fn loads(report: &mut Findings<'_>, top: &[Entry]) -> Vec<Load> {
    let list = tables(report, top, "loads");
    let read = |(i, entries): (usize, &&[Entry])| {
        check_keys(report, entries, &["name", "force", "torque", "at", "fixed_to"], "[[loads]]");
        Load {
            name: name(report, entries, format!("load {}", i + 1)),
            force: vector(report, entries, "force").unwrap_or_default(),
            torque: vector(report, entries, "torque").unwrap_or_default(),
            at: Point3::from(vector(report, entries, "at").unwrap_or_default()),
            fixed_to: fixed_to(report, entries).unwrap_or(Body::Base),
            legs: None,
        }
    };
    list.iter().enumerate().map(read).collect()
}

/// `[[keep_out]]`.
pub(super) fn keep_outs(report: &mut Findings<'_>, top: &[Entry]) -> Vec<KeepOut> {
    let list = tables(report, top, "keep_out");
    let mut out = Vec::new();
    for (i, entries) in list.into_iter().enumerate() {
        check_keys(report, entries, &["name", "fixed_to", "box", "sphere", "capsule"], "[[keep_out]]");
        let name = name(report, entries, format!("keep-out {}", i + 1));
        let fixed_to = fixed_to(report, entries).unwrap_or(Body::Base);
        let shapes: Vec<&Entry> =
            entries.iter().filter(|e| ["box", "sphere", "capsule"].contains(&e.key.as_str())).collect();
        let [entry] = shapes[..] else {
            let span = find(top, "keep_out").map_or(0..0, |e| e.key_span.clone());
            let message = format!("{} has {} shapes", shown(&name), shapes.len());
            let help = "give one of box = { center, size }, sphere = { center, diameter }, capsule = { from, to, diameter }";
            report.refuse(Code::MissingKey, &span, message, help);
            continue;
        };
        if let Some(shape) = shape(report, entry) {
            out.push(KeepOut { name, fixed_to, shape });
        }
    }
    out
}

pub(super) fn shape(report: &mut Findings<'_>, entry: &Entry) -> Option<KeepOutShape> {
    let place = format!("`{}`", entry.key);
    let entries = table(report, &entry.node, &place)?;
    let keys: &[&str] = match entry.key.as_str() {
        "box" => &["center", "size"],
        "sphere" => &["center", "diameter"],
        _ => &["from", "to", "diameter"],
    };
    check_keys(report, entries, keys, &place);
    for key in keys.iter().filter(|k| find(entries, k).is_none()) {
        let message = format!("`{key}` of {place} is missing");
        report.refuse(
            Code::MissingKey,
            &entry.node.span,
            message,
            format!("{place} takes {}", keys.join(", ")),
        );
    }
    let mut point = |key| vector(report, entries, key).map(Point3::from);
    Some(match entry.key.as_str() {
        "box" => {
            let center = point("center")?;
            KeepOutShape::Box {
                center,
                size: find(entries, "size").and_then(|e| edges(report, &e.node, "size"))?,
            }
        }
        "sphere" => KeepOutShape::Sphere {
            center: point("center")?,
            diameter: positive(report, entries, "diameter")?,
        },
        _ => {
            let (from, to) = (point("from")?, point("to")?);
            KeepOutShape::Capsule { from, to, diameter: positive(report, entries, "diameter")? }
        }
    })
}
