//! Poses from the command line.

use super::failure::Failure;
use ask::Design;
use files::design::Workspace;
use machine::requirements::PoseSpace;
use platform::geom::{InvalidPose, Pose};

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

/// The seven fields of a CSV file in which a pose is written: position and quaternion, scalar part first.
pub(crate) fn csv_fields(pose: &Pose) -> String {
    let numbers = pose.position.iter().copied().chain(pose.quaternion());
    numbers.map(|x| x.to_string()).collect::<Vec<_>>().join(",")
}

/// `home`, six or seven numbers, as the value of `option`.
///
/// # Errors
/// Exit 2 with the code given.
pub(crate) fn parse(text: &str, design: &Design, option: &str, code: &str) -> Result<Pose, Failure> {
    if text == "home" {
        return Ok(home(design));
    }
    text.parse().map_err(|m: InvalidPose| Failure::refused(code, format!("{option}: {m}")).with_help(FORM))
}
