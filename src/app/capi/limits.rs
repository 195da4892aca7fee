//! How far from a pose, and the nearest allowed pose.

use super::design::EqpDesign;
use super::failure::{CallFault, EqpError, EqpStatus, read, told, write};
use super::pose::EqpPose;
use ask::Error;
use machine::reach::{NearestPoseOptions, Reach, Travel};
use platform::geom::Pose;

/// How far one of the six numbers of a pose (x, y, z in design units; roll, pitch, yaw in degrees) may move while the others stay.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EqpFreeRange {
    /// Towards smaller values, not negative.
    pub back: f64,
    /// Towards greater ones.
    pub forth: f64,
    /// Whether something binds there; else nothing does within half a turn, or ten sizes of the design.
    pub back_binds: bool,
    /// The same of the greater values.
    pub forth_binds: bool,
}

/// An allowed pose near one that may not be.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EqpNearest {
    /// The pose.
    pub pose: EqpPose,
    /// `sqrt(|p - p'|^2 + (L angle)^2)` from the one asked for, `L` the characteristic length of the design; 0 where that one is allowed.
    pub distance: f64,
    /// Whether it is locally nearest, as far as margins are smooth.
    pub stationary: bool,
    /// Whether the straight way from home to it violates nothing.
    pub straight_from_home: bool,
}

/// The requirements of a design about a pose of the caller, called `name` there.
///
/// # Safety
/// `design` is null or a design, which lives as long as what is given back; `pose` is null or points to a pose.
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
/// `design` is a design, `pose` points to a pose, `allowed` to a place for the answer, `error` is null or points to a place for an error.
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

/// How far x, y, z, roll, pitch and yaw of a pose may move, each alone; `EQP_STATUS_NO_ALLOWED_POSE` where the pose itself is not allowed.
///
/// # Safety
/// `design` is a design, `pose` points to a pose, `ranges` to places for six ranges, `error` is null or points to a place for an error.
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

/// A pose locally nearest to `asked` among those that meet every requirement; `asked` itself where it does.
///
/// # Safety
/// `design` is a design, `asked` points to a pose, `nearest` to a place for the answer, `error` is null or points to a place for an error.
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
            let options = NearestPoseOptions { seed, ..NearestPoseOptions::default() };
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
