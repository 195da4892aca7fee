//! Poses from the command line.

use super::context::Context;
use super::failure::Failure;
use ask::{Design, PoseFrames};
use files::design::Workspace;
use machine::requirements::PoseSpace;
use platform::geom::{Pose, PoseConvention};

/// The form of a pose in an option.
pub(super) const FORM: &str = "give `home`, x,y,z,roll_deg,pitch_deg,yaw_deg, x,y,z,qw,qx,qy,qz or a matrix R11,R12,R13,x,R21,..,z; options such as --rotation-order change this order, and `base:` before the numbers restores it";

/// The home pose of the design, or the default one.
pub(crate) fn home(design: &Design) -> Pose {
    design.home_or_default()
}

/// The workspace of the design, or a box about home; and whether it comes from the design.
pub(crate) fn workspace(design: &Design) -> (Workspace, bool) {
    (design.workspace_or_default(), !design.workspace.is_empty())
}

/// All poses that the design has to reach, and whether they come from its file.
pub(crate) fn space(design: &Design) -> (PoseSpace, bool) {
    let (workspace, given) = workspace(design);
    (workspace.space(&home(design)), given)
}

/// The names of the seven fields in which [`csv_fields`] writes a pose.
pub(crate) fn csv_names(frames: &PoseFrames) -> [&'static str; 7] {
    names(&frames.convention)
}

/// The names of the seven numbers of a pose with a quaternion.
fn names(convention: &PoseConvention) -> [&'static str; 7] {
    let [a, b, c, d] = convention.quaternion_order().written(["qw", "qx", "qy", "qz"]);
    ["x", "y", "z", a, b, c, d]
}

/// Tells in which order seven numbers were read, because programs write quaternions in two orders.
pub(crate) fn note_order(text: &str, frames: &PoseFrames, option: &str, context: &Context) {
    let (convention, numbers) = frames.convention_of(text);
    if numbers.split(',').count() == 7 {
        context.note_once(format!(
            "The seven numbers of {option} were read as {}.",
            names(&convention).join(", ")
        ));
    }
}

/// A pose of a CSV file in the convention: position and quaternion.
pub(crate) fn csv_fields(frames: &PoseFrames, pose: &Pose) -> String {
    let written = frames.write(pose);
    let numbers = written.position.into_iter().chain(written.quaternion);
    numbers.map(|x| x.to_string()).collect::<Vec<_>>().join(",")
}

/// An exact pose: `home`, or six or seven numbers, which may be expressions; the quaternion has any nonzero norm. If an
/// angle has no exact half-angle cosine, the nearest double is used.
///
/// # Errors
/// Exit 2 with the code given.
pub(crate) fn parse(
    text: &str,
    frames: &PoseFrames,
    (option, code): (&str, &str),
    context: &Context,
) -> Result<Pose, Failure> {
    let pose = frames
        .read(text)
        .map_err(|why| Failure::refused(code, format!("{option}: {why}")).with_help(FORM))?;
    note_order(text, frames, option, context);
    Ok(pose)
}
