//! Poses from the command line.

use super::failure::Failure;
use super::numbers;
use ask::Design;
use files::design::{Share, Workspace};
use machine::requirements::PoseSpace;
use num::exact::Rational;
use num::surd::Surd;
use platform::geom::{Angles, InvalidPose, Pose};
use synthesis::singularity::ExactPose;

const FORM: &str = "give `home`, x,y,z,roll_deg,pitch_deg,yaw_deg or x,y,z,qw,qx,qy,qz";

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

/// The seven fields of a pose in a CSV file: position and quaternion, scalar part first.
pub(crate) fn csv_fields(pose: &Pose) -> String {
    let numbers = pose.position.iter().copied().chain(pose.quaternion());
    numbers.map(|x| x.to_string()).collect::<Vec<_>>().join(",")
}

/// An exact pose: `home`, or six or seven numbers, which may be expressions; the quaternion has any nonzero norm. If an
/// angle has no exact half-angle cosine, the nearest double is used.
///
/// # Errors
/// Exit 2 with the code given.
pub(crate) fn exact(text: &str, design: &Design, option: &str, code: &str) -> Result<ExactPose, Failure> {
    let refuse = |message: String| Failure::refused(code, format!("{option}: {message}")).with_help(FORM);
    let fields = text.split(',').count();
    if text != "home" && fields == 7 {
        let [x, y, z, quaternion @ ..] = numbers::exact::<7>(text).map_err(refuse)?;
        if quaternion.iter().all(Surd::is_zero) {
            return Err(refuse("the quaternion is zero".to_owned()));
        }
        return Ok(ExactPose { position: [x, y, z], quaternion });
    }
    let (position, angles) = if text == "home" {
        design.exact_home().map_or((None, None), |(position, angles)| (Some(position), angles))
    } else {
        let [x, y, z, angles @ ..] = numbers::exact::<6>(text).map_err(refuse)?;
        (Some([x, y, z]), Some(angles))
    };
    let quaternion = angles.as_ref().and_then(exact_quaternion);
    let pose = match (&position, &angles) {
        (Some(p), Some(a)) if text != "home" => {
            let [p, a] = [p, a].map(|list| list.each_ref().map(Surd::nearest));
            Pose::new(p, Angles::from_degrees(a))
        }
        _ => home(design),
    };
    let double = |x: f64| Share::shortest(x).and_then(|x| x.exact().cloned()).unwrap_or_else(Surd::zero);
    Ok(ExactPose {
        position: position.unwrap_or_else(|| [pose.position.x, pose.position.y, pose.position.z].map(double)),
        quaternion: quaternion.unwrap_or_else(|| pose.quaternion().map(double)),
    })
}

/// The quaternion of `Rz(yaw) Ry(pitch) Rx(roll)`, angles in degrees; `None` if no exact one exists.
fn exact_quaternion(angles: &[Surd; 3]) -> Option<[Surd; 4]> {
    let half = |angle: &Surd| Surd::turn(&(angle.as_rational()? / Rational::from_integer(2.into())));
    let [(cr, sr), (cp, sp), (cy, sy)] = [half(&angles[0])?, half(&angles[1])?, half(&angles[2])?];
    let both = |x: [&Surd; 3], y: [&Surd; 3], minus: bool| {
        let [x, y] = [x, y].map(|[a, b, c]| a.times(b)?.times(c));
        if minus { x?.minus(&y?) } else { x?.plus(&y?) }
    };
    Some([
        both([&cr, &cp, &cy], [&sr, &sp, &sy], false)?,
        both([&sr, &cp, &cy], [&cr, &sp, &sy], true)?,
        both([&cr, &sp, &cy], [&sr, &cp, &sy], false)?,
        both([&cr, &cp, &sy], [&sr, &sp, &cy], true)?,
    ])
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
