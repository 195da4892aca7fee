//! The two forms of poses in answers.

use std::borrow::Cow;

use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use num::Number;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{Pose, PoseConvention, WrittenPose, nearest_rotation};

/// A pose: a platform point x is at R x + p in the base frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PoseRecord {
    /// Rows of the rotation matrix.
    #[serde(rename = "R")]
    pub rotation: [[Number; 3]; 3],
    /// Platform origin, base frame, design units.
    #[serde(rename = "p")]
    pub position: [Number; 3],
}

impl From<&Pose> for PoseRecord {
    fn from(pose: &Pose) -> Self {
        let m = pose.rotation.matrix();
        let p = &pose.position;
        Self {
            rotation: [0, 1, 2].map(|i| [0, 1, 2].map(|j| Number(m[(i, j)]))),
            position: [p.x, p.y, p.z].map(Number),
        }
    }
}

/// The pose with the rotation nearest to the matrix, whose digits another program may have rounded.
impl From<&PoseRecord> for Pose {
    fn from(record: &PoseRecord) -> Self {
        let rows = Matrix3::from_fn(|i, j| record.rotation[i][j].0);
        let position = record.position.map(|x| x.0);
        Self { rotation: nearest_rotation(&rows), position: Vector3::from(position) }
    }
}

/// A pose in the numbers of a convention.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PoseInFrames {
    /// Position of the pivot, design units.
    pub position: [Number; 3],
    /// Angles in the unit of `frames`, in the order in which they are written.
    pub angles: [Number; 3],
    /// Whether the rotation has no other angles: false near the ends of the middle angle, where only a combination of
    /// the others is determined to more than half of the digits of a double.
    pub angles_unique: bool,
    /// Unit quaternion in the order of `frames`.
    pub quaternion: [Number; 4],
}

impl From<&WrittenPose> for PoseInFrames {
    fn from(written: &WrittenPose) -> Self {
        Self {
            position: written.position.map(Number),
            angles: written.angles.map(Number),
            angles_unique: written.angles_are_unique,
            quaternion: written.quaternion.map(Number),
        }
    }
}

/// A convention for poses.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PoseConventionRecord {
    /// Order of the rotations: `fixed-xyz` and the like for fixed axes, `moving-xyz` for moving axes, or
    /// `vector` for rotation vectors.
    pub rotation_order: String,
    /// Rotation as a product of matrices of angles a, b, c in their order.
    pub formula: String,
    /// Unit of angles: `deg` or `rad`.
    pub angles: String,
    /// Order of quaternions: `wxyz` or `xyzw`.
    pub quaternion: String,
    /// Point whose position is given, platform frame, design units.
    pub pivot: [Number; 3],
    /// The origin of poses: `base` or `home`.
    pub relative_to: String,
    /// Upward axis: `z` or `y`.
    pub up: String,
    /// The convention in words.
    pub sentence: String,
}

impl From<&PoseConvention> for PoseConventionRecord {
    fn from(convention: &PoseConvention) -> Self {
        let order = convention.order();
        let pivot = convention.pivot.unwrap_or_else(Vector3::zeros);
        Self {
            rotation_order: order.to_string(),
            formula: order.formula(),
            angles: convention.angle_unit().name().into(),
            quaternion: convention.quaternion_order().name().into(),
            pivot: [pivot.x, pivot.y, pivot.z].map(Number),
            relative_to: convention.measured_from().name().into(),
            up: convention.up_axis().name().into(),
            sentence: convention.sentences(),
        }
    }
}

impl PoseConventionRecord {
    /// Whether poses are written as this program does.
    #[must_use]
    pub fn is_usual(&self) -> bool {
        *self == Self::from(&PoseConvention::default())
    }
}

/// Written as a [`PoseRecord`].
impl Serialize for Pose {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        PoseRecord::from(self).serialize(to)
    }
}

impl<'de> Deserialize<'de> for Pose {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        PoseRecord::deserialize(from).map(|record| Self::from(&record))
    }
}

impl JsonSchema for Pose {
    fn schema_name() -> Cow<'static, str> {
        PoseRecord::schema_name()
    }

    fn schema_id() -> Cow<'static, str> {
        PoseRecord::schema_id()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        PoseRecord::json_schema(generator)
    }
}

/// A pose by its quaternion: a platform point x is at R(q) x + p in the base frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PoseQuaternionRecord {
    /// Platform origin, base frame, design units.
    #[serde(rename = "p")]
    pub position: [Number; 3],
    /// Unit quaternion, scalar part first.
    #[serde(rename = "q")]
    pub quaternion: [Number; 4],
}

impl From<&PoseQuaternionRecord> for Pose {
    fn from(record: &PoseQuaternionRecord) -> Self {
        let [w, x, y, z] = record.quaternion.map(|x| x.0);
        let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).to_rotation_matrix();
        Self { rotation, position: Vector3::from(record.position.map(|x| x.0)) }
    }
}

impl From<&Pose> for PoseQuaternionRecord {
    fn from(pose: &Pose) -> Self {
        let p = &pose.position;
        Self { position: [p.x, p.y, p.z].map(Number), quaternion: pose.quaternion().map(Number) }
    }
}

/// Writes and reads the pose of a field as a [`PoseQuaternionRecord`]: `serde(with = "platform::geom::ByQuaternion")`.
#[derive(Debug)]
pub enum ByQuaternion {}

impl ByQuaternion {
    /// Writes a pose.
    ///
    /// # Errors
    /// The errors of [`Serialize::serialize`].
    pub fn serialize<S: Serializer>(pose: &Pose, to: S) -> Result<S::Ok, S::Error> {
        PoseQuaternionRecord::from(pose).serialize(to)
    }

    /// Reads a pose.
    ///
    /// # Errors
    /// The errors of [`Deserialize::deserialize`].
    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Pose, D::Error> {
        PoseQuaternionRecord::deserialize(from).map(|record| Pose::from(&record))
    }
}

impl JsonSchema for ByQuaternion {
    fn schema_name() -> Cow<'static, str> {
        PoseQuaternionRecord::schema_name()
    }

    fn schema_id() -> Cow<'static, str> {
        PoseQuaternionRecord::schema_id()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        PoseQuaternionRecord::json_schema(generator)
    }
}
