//! Geometry shared by all crates: poses, quaternions, distances, and their enclosures in intervals.

mod across;
mod chart;
mod convention;
mod draw;
pub mod enclosed;
mod hull;
mod line;
mod pose;
mod pose_forms;
mod pose_set;
#[cfg(feature = "serde")]
mod pose_written;
mod quaternion;
mod rotation_vector;
mod segment;
mod trilateration;
mod turn;

pub use across::any_across;
pub use chart::{Bisection, Chart, ChartCell, Covered, combination};
pub use convention::{
    AngleUnit, FrameAxis, PoseConvention, QuaternionOrder, RotationOrder, TurnAxes, UnknownOrder, UpAxis,
    WrittenAngles, WrittenPose, is_by_columns,
};
pub use draw::{CentredPoses, any_pose};
pub use draw::{SamplePlan, random_rotation};
pub use hull::convex_hull;
pub use line::BestLine;
pub use num::interval::radians;
pub use pose::{ComplexPose, Pose};
pub use pose::{nearest_rotation, reorthogonalised};
pub use pose_forms::{Angles, InvalidPose};
pub use pose_set::{CoordinateRange, ListedFrom, PoseSpace, Region};
#[cfg(feature = "serde")]
pub use pose_written::{ByQuaternion, PoseConventionRecord, PoseInFrames, PoseQuaternionRecord, PoseRecord};
pub use quaternion::rotation_from_quaternion;
pub use rotation_vector::{rotation_vector, turn_between};
pub use segment::{LinePair, segment_box_nearest, segment_distance};
pub use trilateration::trilaterate;
pub use turn::{TurnCoefficients, arc_cosine, cosine, degrees, sine, turn, turn_slope};
