//! One real pose followed from lengths to lengths.

use super::design::EqpDesign;
use super::failure::{EqpError, EqpStatus, give, read, take_back, told, write};
use super::pose::EqpPose;
use ask::Tracker;
use fk::NearOutcome;

/// Follows the pose of a machine. It belongs to one thread at a time; a step takes a few microseconds and allocates nothing.
#[derive(Debug)]
pub struct EqpTracker(Tracker);

/// What became of a step.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EqpTrackStatus {
    /// The pose continues the last one, joined to it by regular poses: no other assembly mode was taken.
    Tracked = 0,
    /// A singular pose lies on the way or at its end.
    NearSingular = 1,
    /// Given up: the lengths are too far from the last ones, or rounding keeps Newton's method from the accuracy that the test needs.
    Lost = 2,
}

/// A step with its evidence.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EqpTrack {
    /// What became of it.
    pub status: EqpTrackStatus,
    /// The pose for the lengths where it was tracked, else the last one on the way to them.
    pub pose: EqpPose,
    /// How far on the straight line of squared lengths, from 0 to 1.
    pub fraction: f64,
    /// Largest error of the leg equations at the pose over the squared size of the design.
    pub residual: f64,
    /// `6 / (|J| |J^-1|)` at the pose: 1 at best, 0 at a singular pose.
    pub frobenius_ratio: f64,
    /// Newton steps.
    pub newton_steps: u32,
}

/// A tracker that begins at a pose; it does not need the design afterwards.
///
/// # Safety
/// `design` is a design, `start` points to a pose, `tracker` to a place for a pointer, `error` is null or points to a place for an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_tracker_new(
    design: *const EqpDesign,
    start: *const EqpPose,
    tracker: *mut *mut EqpTracker,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe {
        told(error, || {
            let start = read(start, "start")?.checked()?;
            give(EqpTracker(read(design, "design")?.design.tracker(start)), tracker, "tracker")
        })
    }
}

/// Continues the pose to six lengths. Where it is not tracked the tracker stays where it was, and the call is `EQP_STATUS_OK` all the same: `track` says what became of it.
///
/// # Safety
/// `tracker` is a tracker that no other thread uses meanwhile, `lengths` points to six numbers, `track` to a place for the answer, `error` is null or points to a place for an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_tracker_step(
    tracker: *mut EqpTracker,
    lengths: *const f64,
    track: *mut EqpTrack,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe {
        told(error, || {
            let outcome = write(tracker, "tracker")?.0.step(*read(lengths.cast::<[f64; 6]>(), "lengths")?)?;
            let (status, fraction) = match &outcome {
                NearOutcome::Tracked { .. } => (EqpTrackStatus::Tracked, 1.0),
                NearOutcome::NearSingularity { fraction, .. } => (EqpTrackStatus::NearSingular, *fraction),
                NearOutcome::Lost { fraction, .. } => (EqpTrackStatus::Lost, *fraction),
            };
            let evidence = outcome.evidence();
            *write(track, "track")? = EqpTrack {
                status,
                pose: outcome.pose().into(),
                fraction,
                residual: evidence.residual,
                frobenius_ratio: evidence.frobenius_ratio,
                newton_steps: evidence.newton_steps,
            };
            Ok(())
        })
    }
}

/// Where the platform is.
///
/// # Safety
/// `tracker` is a tracker that no other thread steps meanwhile, `pose` points to a place for a pose, `error` is null or points to a place for an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_tracker_pose(
    tracker: *const EqpTracker,
    pose: *mut EqpPose,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe {
        told(error, || {
            let at = read(tracker, "tracker")?.0.pose();
            *write(pose, "pose")? = (&at).into();
            Ok(())
        })
    }
}

/// Frees a tracker; null is nothing.
///
/// # Safety
/// `tracker` is null or a tracker that was not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_tracker_free(tracker: *mut EqpTracker) {
    // SAFETY: the caller's promise.
    unsafe { take_back(tracker) }
}
