//! The two ways in which poses stand in answers.

use std::borrow::Cow;

use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use num::Number;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{Pose, nearest_rotation};

/// A pose: a platform point x is at R x + p in the base frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PoseRecord {
    /// Rows of the rotation matrix.
    #[serde(rename = "R")]
    pub rotation: [[Number; 3]; 3],
    /// Position of the platform origin, base frame, design units.
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

/// The pose with the rotation next to the matrix, whose digits another program may have rounded.
impl From<&PoseRecord> for Pose {
    fn from(record: &PoseRecord) -> Self {
        let rows = Matrix3::from_fn(|i, j| record.rotation[i][j].0);
        let position = record.position.map(|x| x.0);
        Self { rotation: nearest_rotation(&rows), position: Vector3::from(position) }
    }
}

/// As a [`PoseRecord`].
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
    /// Position of the platform origin, base frame, design units.
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
    /// As of [`Serialize::serialize`].
    pub fn serialize<S: Serializer>(pose: &Pose, to: S) -> Result<S::Ok, S::Error> {
        PoseQuaternionRecord::from(pose).serialize(to)
    }

    /// Reads a pose.
    ///
    /// # Errors
    /// As of [`Deserialize::deserialize`].
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
