//! Tracks one real pose from lengths to lengths.

use super::design::EqpDesign;
use super::failure::{EqpError, EqpStatus, give, read, take_back, told, write};
use super::pose::EqpPose;
use ask::Tracker;
use fk::NearOutcome;

/// Tracks the pose of a machine. It belongs to one thread at a time; a step takes a few microseconds and allocates
/// nothing.
#[derive(Debug)]
pub struct EqpTracker(Tracker);

/// The outcome of a step.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EqpTrackStatus {
    /// The pose continues the last one through regular poses, so the assembly mode is the same.
    Tracked = 0,
    /// A singular pose lies on the path or at its end.
    NearSingular = 1,
    /// The pose is lost. The lengths are too far from the last ones, or rounding keeps Newton's method from the
    /// accuracy that the test needs.
    Lost = 2,
}

/// A step with its evidence.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EqpTrack {
    /// The outcome of the step.
    pub status: EqpTrackStatus,
    /// The pose for the lengths if it was tracked, otherwise the last pose on the path to them.
    pub pose: EqpPose,
    /// The fraction of the straight line of squared lengths that was covered, from 0 to 1.
    pub fraction: f64,
    /// Largest error of the leg equations at the pose divided by the squared size of the design.
    pub residual: f64,
    /// The ratio `6 / (|J| |J^-1|)` at the pose: 1 at best, 0 at a singular pose.
    pub frobenius_ratio: f64,
    /// Number of Newton steps.
    pub newton_steps: u32,
}

/// Makes a tracker that begins at a pose; it does not need the design afterwards.
///
/// # Safety
/// `design` is a design, `start` points to a pose, and `tracker` to a place for a pointer. The argument `error` is null
/// or points to a place for an error.
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

/// Continues the pose to six lengths. If tracking fails, the tracker stays at its old pose, and the call still returns
/// `EQP_STATUS_OK`: `track` holds the outcome.
///
/// # Safety
/// `tracker` is a tracker that no other thread uses meanwhile. The argument `lengths` points to six numbers, and
/// `track` to a place for the answer. The argument `error` is null or points to a place for an error.
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

/// The current pose of the platform.
///
/// # Safety
/// `tracker` is a tracker that no other thread steps meanwhile, and `pose` points to a place for a pose. The argument
/// `error` is null or points to a place for an error.
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

/// Frees a tracker; null is ignored.
///
/// # Safety
/// `tracker` is null or a tracker that was not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_tracker_free(tracker: *mut EqpTracker) {
    // SAFETY: the caller's promise.
    unsafe { take_back(tracker) }
}
