//! Poses and legs.

use std::borrow::Cow;

use nalgebra::Point3;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::Number;
pub use platform::geom::{PoseConventionRecord, PoseInFrames, PoseQuaternionRecord, PoseRecord};
use platform::manipulator::LegIndex;

/// The source of a home pose or a workspace.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SourceWord {
    /// The design.
    Design,
    /// The usual one of the design's size, because the design has none.
    Default,
}

impl SourceWord {
    /// [`SourceWord::Design`] if the design states it.
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

/// Points by name, in a fixed order: the joints of a body.
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
        // a map of JSON keeps the order of its keys
        let points = serde_json::Map::deserialize(from)?;
        let point = |(name, place)| serde_json::from_value(place).map(|place| (name, place));
        points.into_iter().map(point).collect::<Result<_, _>>().map(Self).map_err(serde::de::Error::custom)
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

/// Numbers of legs from 1, for indices from 0.
pub(super) fn leg_numbers(legs: &[usize]) -> Vec<usize> {
    legs.iter().map(|leg| leg + 1).collect()
}

/// The number of a leg, from 1.
#[must_use]
pub fn leg_number(leg: LegIndex) -> usize {
    leg.get() + 1
}
