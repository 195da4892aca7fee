//! Poses from the command line.

use nalgebra::{Quaternion, Rotation3, UnitQuaternion, Vector3};

use super::failure::Failure;
use crate::design::{Design, Workspace};
use crate::geom::Pose;
use crate::requirements::PoseSpace;

const FORM: &str = "give `home`, x,y,z,roll_deg,pitch_deg,yaw_deg or x,y,z,qw,qx,qy,qz";

/// The home pose of the design, the default one where it gives none.
pub(crate) fn home(design: &Design) -> Pose {
    design.home_or_default()
}

/// The workspace of the design, or a box about home where it has none; and whether it is the design's.
pub(crate) fn workspace(design: &Design) -> (Workspace, bool) {
    (design.workspace_or_default(), !design.workspace.is_empty())
}

/// All poses the design has to reach, and whether its file says so.
pub(crate) fn space(design: &Design) -> (PoseSpace, bool) {
    let (workspace, given) = workspace(design);
    (workspace.space(&home(design)), given)
}

/// The poses of the grid of that workspace, home first.
pub(crate) fn judged(design: &Design) -> Vec<Pose> {
    workspace(design).0.sample(Some(&home(design)))
}

/// `home`, six or seven numbers, as the value of `option`.
///
/// # Errors
/// Exit 2 with the code given.
pub(crate) fn parse(text: &str, design: &Design, option: &str, code: &str) -> Result<Pose, Failure> {
    if text == "home" {
        return Ok(home(design));
    }
    numbers(text).map_err(|m| Failure::refused(code, format!("{option}: {m}")).with_help(FORM))
}

/// A pose from six or seven numbers separated by commas, or what is wrong with them.
pub(crate) fn numbers(text: &str) -> Result<Pose, String> {
    let mut values = Vec::with_capacity(7);
    for (i, field) in text.split(',').map(str::trim).enumerate() {
        match field.parse::<f64>() {
            Ok(x) if x.is_finite() => values.push(x),
            _ => return Err(format!("value {}, `{field}`, is not a finite number", i + 1)),
        }
    }
    let rotation = match values[..] {
        [_, _, _, roll, pitch, yaw] => {
            Rotation3::from_euler_angles(roll.to_radians(), pitch.to_radians(), yaw.to_radians())
        }
        [_, _, _, w, x, y, z] => {
            let q = Quaternion::new(w, x, y, z);
            if !((q.norm() - 1.0).abs() <= 1e-3) {
                return Err(format!("the quaternion has norm {}, not 1", q.norm()));
            }
            UnitQuaternion::from_quaternion(q).to_rotation_matrix()
        }
        _ => return Err(format!("{} values instead of six or seven", values.len())),
    };
    Ok(Pose { rotation, position: Vector3::new(values[0], values[1], values[2]) })
}
