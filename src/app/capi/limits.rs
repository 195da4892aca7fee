//! The free travel from a pose, and the nearest allowed pose.

use super::design::EqpDesign;
use super::failure::{CallFault, EqpError, EqpStatus, read, told, write};
use super::pose::EqpPose;
use ask::Error;
use machine::reach::{NearestPoseOptions, Reach, Travel};
use platform::geom::Pose;

/// The free travel of one number of a pose while the others stay fixed. The number is x, y, z in design units, or roll,
/// pitch, yaw in degrees.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EqpFreeRange {
    /// The travel towards smaller values, not negative.
    pub back: f64,
    /// The travel towards greater values, not negative.
    pub forth: f64,
    /// Whether a requirement ends the travel `back`; otherwise none does within half a turn, or ten sizes of the
    /// design.
    pub back_binds: bool,
    /// Whether a requirement ends the travel `forth`.
    pub forth_binds: bool,
}

/// The allowed pose found near a pose that is not allowed.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EqpNearest {
    /// The pose.
    pub pose: EqpPose,
    /// The distance `sqrt(|p - p'|^2 + (L angle)^2)` from the given pose, with the characteristic length `L` of the
    /// design; 0 if the given pose is allowed.
    pub distance: f64,
    /// Whether it is locally nearest, as far as margins are smooth.
    pub stationary: bool,
    /// Whether the straight path from home to the pose violates nothing.
    pub straight_from_home: bool,
}

/// The requirements of a design with a pose of the caller, which is called `name` there.
///
/// # Safety
/// `design` is null or a design that lives as long as the result; `pose` is null or points to a pose.
unsafe fn reach_and_pose<'a>(
    design: *const EqpDesign,
    pose: *const EqpPose,
    name: &str,
) -> Result<(Reach<'a>, Pose), CallFault> {
    // SAFETY: the caller's promises.
    let (design, pose) = unsafe { (read(design, "design")?, read(pose, name)?) };
    Ok((design.design.reach(&design.required), pose.checked()?))
}

/// Whether a pose meets every requirement of the design, and `det J` has the sign that it has at home.
///
/// # Safety
/// `design` is a design, `pose` points to a pose, and `allowed` to a place for the answer. The argument `error` is null
/// or points to a place for an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_allowed(
    design: *const EqpDesign,
    pose: *const EqpPose,
    allowed: *mut bool,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe {
        told(error, || {
            let (reach, pose) = reach_and_pose(design, pose, "pose")?;
            *write(allowed, "allowed")? = reach.allows(&pose);
            Ok(())
        })
    }
}

/// The free travel of x, y, z, roll, pitch and yaw from a pose, each alone; `EQP_STATUS_NO_ALLOWED_POSE` if the pose
/// itself is not allowed.
///
/// # Safety
/// `design` is a design, `pose` points to a pose, and `ranges` to places for six ranges. The argument `error` is null
/// or points to a place for an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_free_ranges(
    design: *const EqpDesign,
    pose: *const EqpPose,
    ranges: *mut EqpFreeRange,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe {
        told(error, || {
            let (reach, pose) = reach_and_pose(design, pose, "pose")?;
            let found = reach
                .free_ranges(&pose)
                .ok_or_else(|| CallFault::new(EqpStatus::NoAllowedPose, "the pose is not allowed"))?;
            *write(ranges.cast::<[EqpFreeRange; 6]>(), "ranges")? = found.map(|range| {
                let amount = |t: &Travel| if range.axis.is_turn() { t.amount.to_degrees() } else { t.amount };
                EqpFreeRange {
                    back: amount(&range.back),
                    forth: amount(&range.forth),
                    back_binds: range.back.binding.is_some(),
                    forth_binds: range.forth.binding.is_some(),
                }
            });
            Ok(())
        })
    }
}

/// A pose locally nearest to `asked` among the poses that meet every requirement; `asked` itself if it does.
///
/// # Safety
/// `design` is a design, `asked` points to a pose, and `nearest` to a place for the answer. The argument `error` is
/// null or points to a place for an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_nearest_allowed(
    design: *const EqpDesign,
    asked: *const EqpPose,
    seed: u64,
    nearest: *mut EqpNearest,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe {
        told(error, || {
            let (reach, asked) = reach_and_pose(design, asked, "asked")?;
            let options = NearestPoseOptions::default().seed(seed);
            let found = reach.nearest(&asked, &options).ok_or(Error::NoAllowedPose)?;
            *write(nearest, "nearest")? = EqpNearest {
                pose: (&found.pose).into(),
                distance: found.distance,
                stationary: found.stationary,
                straight_from_home: found.straight_from_home,
            };
            Ok(())
        })
    }
}
