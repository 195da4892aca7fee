//! Poses and legs.

use std::borrow::Cow;
use std::fmt;

use nalgebra::{Matrix3, Point3, Vector3};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::Number;
use num::shown::fixed;
use platform::geom::{Pose, nearest_rotation};
use platform::manipulator::LegIndex;

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

impl PoseQuaternionRecord {
    /// `x,y,z,qw,qx,qy,qz` with four decimals, for people.
    pub fn short(&self) -> String {
        let values = self.position.iter().chain(&self.quaternion);
        values.map(|x| fixed(x.0, 4)).collect::<Vec<_>>().join(",")
    }
}

impl From<&Pose> for PoseQuaternionRecord {
    fn from(pose: &Pose) -> Self {
        let p = &pose.position;
        Self { position: [p.x, p.y, p.z].map(Number), quaternion: pose.quaternion().map(Number) }
    }
}

/// Where a home pose or a workspace comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SourceWord {
    /// The design.
    Design,
    /// The design has none: the usual one of its size.
    Default,
}

impl SourceWord {
    /// The design where it has one.
    #[must_use]
    pub fn given(by_design: bool) -> Self {
        if by_design { Self::Design } else { Self::Default }
    }

    /// `"given"` or `"default"`, for texts.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Design => "given",
            Self::Default => "default",
        }
    }
}

/// Points by name, in an order of their own: the joints of a body.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct NamedPoints(pub Vec<(String, [Number; 3])>);

impl NamedPoints {
    /// Names with their points.
    #[must_use]
    pub fn new(names: &[String], points: &[Point3<f64>]) -> Self {
        Self(names.iter().cloned().zip(points.iter().map(|p| [p.x, p.y, p.z].map(Number))).collect())
    }
}

impl Serialize for NamedPoints {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_map(self.0.iter().map(|(name, point)| (name, point)))
    }
}

impl<'de> Deserialize<'de> for NamedPoints {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Entries;
        impl<'de> Visitor<'de> for Entries {
            type Value = NamedPoints;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("points by name")
            }

            fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<NamedPoints, M::Error> {
                let mut points = Vec::new();
                while let Some(entry) = map.next_entry()? {
                    points.push(entry);
                }
                Ok(NamedPoints(points))
            }
        }
        from.deserialize_map(Entries)
    }
}

impl JsonSchema for NamedPoints {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "NamedPoints".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let point = generator.subschema_for::<[Number; 3]>();
        json_schema!({"type": "object", "additionalProperties": point})
    }
}

/// Numbers of legs as people count, from 1, for indices from 0.
pub(super) fn leg_numbers(legs: &[usize]) -> Vec<usize> {
    legs.iter().map(|leg| leg + 1).collect()
}

/// The number of a leg as people count, from 1.
#[must_use]
pub fn leg_number(leg: LegIndex) -> usize {
    leg.get() + 1
}
