//! The pose error from all errors of a machine together, over its workspace.

use nalgebra::{Point3, Vector3};

use super::gauge::Gauge;
use super::joint::joints;
use super::sample::{PoseSearch, ToleranceError};
use super::sensitivity::Sensitivity;
use crate::requirements::PoseSpace;
use platform::geom::Pose;
use platform::manipulator::Manipulator;

/// Bounds of the differences between a machine and its design.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MachineErrors {
    /// Greatest position error of every joint in any direction, design units.
    pub joints: f64,
    /// Greatest length error of every leg, independent of the others, design units: homing, backlash, pitch of a screw.
    pub lengths: f64,
    /// Growth of base, platform and legs, as shares of their sizes: temperature times coefficient of expansion. All
    /// three act together, with either sign.
    pub growth: [f64; 3],
}

/// The greatest error of one kind at a pose, in total and from each cause alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorParts {
    /// All causes together.
    pub total: f64,
    /// Joints alone.
    pub joints: f64,
    /// Leg lengths alone.
    pub lengths: f64,
    /// Growth alone.
    pub growth: f64,
}

/// The greatest errors at a pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorAtPose {
    /// The pose.
    pub pose: Pose,
    /// Error of the tool point, design units.
    pub position: ErrorParts,
    /// Error of the orientation, degrees.
    pub rotation_deg: ErrorParts,
}

/// The greatest errors of the pose that a controller computes with the nominal joints and the shown lengths. They are
/// taken at the listed poses, the corners of the region and a sample of it.
///
/// To first order the pose is off by the twist `J^-1 e`. Joint errors add to `e` as in [`Sensitivity`]; a leg longer by
/// `x` than shown adds `-x`. Growth moves each joint by a share of its coordinates and each length by a share of
/// itself. Joints range over balls, lengths over intervals, and growth has either sign; local searches from seven
/// directions find the greatest norm of the sum.
///
/// # Errors
/// A singular pose.
pub fn error_map(
    m: &Manipulator,
    space: &PoseSpace,
    tool: &Point3<f64>,
    errors: &MachineErrors,
    search: &PoseSearch,
) -> Result<Vec<ErrorAtPose>, ToleranceError> {
    search
        .poses(space)
        .into_iter()
        .map(|pose| errors_at(m, &pose, tool, errors).ok_or(ToleranceError::SingularPose { pose }))
        .collect()
}

/// The greatest errors at one pose; `None` where it is singular.
#[must_use]
pub fn errors_at(
    m: &Manipulator,
    pose: &Pose,
    tool: &Point3<f64>,
    errors: &MachineErrors,
) -> Option<ErrorAtPose> {
    let s = Sensitivity::at(m, pose, tool)?;
    let [base, platform, legs] = errors.growth;
    let shifts: Vec<Vector3<f64>> = joints(m)
        .iter()
        .map(|joint| m.joints(joint.body)[joint.index].coords * joint.body.of((base, platform)))
        .collect();
    let by_joints = s.error(&shifts);
    let lengths = m.legs().map(|leg| pose.squared_length(&leg).sqrt());
    let by_lengths = s.error_of_lengths(&lengths.map(|l| -legs * l));
    let growth = (by_joints.0 + by_lengths.0, by_joints.1 + by_lengths.1);
    let parts = |balls: &[nalgebra::Matrix3<f64>], columns: &[Vector3<f64>; 6], growth: Vector3<f64>| {
        let balls: Vec<_> = balls.iter().map(|g| g * errors.joints).collect();
        let segments: Vec<_> = columns.iter().map(|c| c * errors.lengths).collect();
        let greatest = |balls: Vec<_>, segments: Vec<_>| Gauge::of(balls, segments).search().0.max(0.0);
        let all: Vec<_> = segments.iter().copied().chain([growth]).collect();
        ErrorParts {
            total: greatest(balls.clone(), all),
            joints: greatest(balls, Vec::new()),
            lengths: greatest(Vec::new(), segments),
            growth: growth.norm(),
        }
    };
    let rotation = parts(&s.rotation, &s.leg_rotation, growth.1);
    Some(ErrorAtPose {
        pose: *pose,
        position: parts(&s.position, &s.leg_position, growth.0),
        rotation_deg: ErrorParts {
            total: rotation.total.to_degrees(),
            joints: rotation.joints.to_degrees(),
            lengths: rotation.lengths.to_degrees(),
            growth: rotation.growth.to_degrees(),
        },
    })
}
