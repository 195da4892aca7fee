//! The options that say how poses are written.

use ask::{Design, PoseFrames};
use nalgebra::Vector3;
use num::names::named;
use platform::geom::{AngleUnit, ListedFrom, PoseConvention, QuaternionOrder, RotationOrder, UpAxis};

use super::context::Context;
use super::numbers;

/// The notation of the poses that a command reads and writes; `[frames]` of the design where an option is absent.
#[derive(Debug, Clone, Copy, Default, clap::Args)]
#[command(next_help_heading = "Convention of poses (default: [frames] of the design)")]
pub(crate) struct FrameArgs {
    /// Order of rotations and angles: `fixed-xyz` (R = Rz Ry Rx), `moving-xyz` (R = Rx Ry Rz), other axes, `rpy`, `pi`,
    /// `rubin`, or `vector` for a rotation vector
    #[arg(long, value_name = "ORDER")]
    rotation_order: Option<RotationOrder>,
    /// Point of the platform whose position a pose gives, platform frame
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = point)]
    pivot: Option<Vector3<f64>>,
    /// The origin of poses: `base` or `home`
    #[arg(long, value_name = "FRAME", value_parser = |word: &str| named("frame", word, &[ListedFrom::Base, ListedFrom::Home], ListedFrom::name))]
    relative_to: Option<ListedFrom>,
    /// Axis that points up: `z` or `y`
    #[arg(long, value_name = "AXIS", value_parser = |word: &str| named("axis", word, &UpAxis::ALL, UpAxis::name))]
    up: Option<UpAxis>,
    /// Unit of angles: `deg` or `rad`
    #[arg(long, value_name = "UNIT", value_parser = |word: &str| named("unit of angles", word, &AngleUnit::ALL, AngleUnit::name))]
    angle_unit: Option<AngleUnit>,
    /// Order of quaternions: `wxyz` or `xyzw`
    #[arg(long, value_name = "ORDER", value_parser = |word: &str| named("order of quaternions", word, &QuaternionOrder::ALL, QuaternionOrder::name))]
    quaternion: Option<QuaternionOrder>,
}

fn point(text: &str) -> Result<Vector3<f64>, String> {
    numbers::parse(text).map(|point: [f64; 3]| point.into()).ok_or_else(|| "give three numbers x,y,z".into())
}

/// Tells people how poses were read where this is not the usual way.
pub(crate) fn note_frames(frames: &PoseFrames, context: &Context) {
    if !frames.convention.is_usual() {
        context.note(&frames.convention.sentences());
    }
}

impl FrameArgs {
    /// The convention of poses of a design.
    pub(crate) fn of(&self, design: &Design) -> PoseFrames {
        design.pose_frames(PoseConvention {
            rotation_order: self.rotation_order,
            angles: self.angle_unit,
            quaternion: self.quaternion,
            pivot: self.pivot,
            relative_to: self.relative_to,
            up: self.up,
        })
    }
}
