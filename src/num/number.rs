//! Numbers that JSON may be unable to represent.

use std::borrow::Cow;

use schemars::transform::transform_subschemas;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A number that may be infinite or NaN, which JSON writes as `null` and reads back as NaN.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Number(pub f64);

impl From<f64> for Number {
    fn from(x: f64) -> Self {
        Self(x)
    }
}

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        Some(self.0).filter(|x| x.is_finite()).serialize(to)
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        Ok(Self(Option::deserialize(from)?.unwrap_or(f64::NAN)))
    }
}

impl JsonSchema for Number {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Number".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({"type": ["number", "null"]})
    }
}

/// Allows null for doubles in a schema, like [`Number`]: the transform of answers whose fields are plain doubles.
///
/// JSON needs no change: `serde_json` writes `null` for an infinite or NaN double.
pub fn nullable(schema: &mut Schema) {
    if schema.get("format").and_then(|format| format.as_str()) == Some("double") {
        schema.remove("format");
        for (key, value) in
            Number::json_schema(&mut SchemaGenerator::default()).as_object().into_iter().flatten()
        {
            schema.insert(key.clone(), value.clone());
        }
    }
    transform_subschemas(&mut nullable, schema);
}

/// Writes and reads enums by the words of their `name`, which are strings in a schema; `ALL` has every choice.
#[macro_export]
macro_rules! written_as_word {
    ($($kind:ty),+) => {$(
        impl serde::Serialize for $kind {
            fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
                to.serialize_str(self.name())
            }
        }

        impl<'de> serde::Deserialize<'de> for $kind {
            fn deserialize<D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
                let word = <String as serde::Deserialize>::deserialize(from)?;
                $crate::names::named(stringify!($kind), &word, &Self::ALL, Self::name)
                    .map_err(serde::de::Error::custom)
            }
        }

        impl schemars::JsonSchema for $kind {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> std::borrow::Cow<'static, str> {
                stringify!($kind).into()
            }

            fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
                <String as schemars::JsonSchema>::json_schema(generator)
            }
        }
    )+};
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_finite_is_null_and_every_other_number_reads_back_the_same() {
        let numbers = [0.1 + 0.2, -0.0, f64::MIN_POSITIVE, 1e300, f64::INFINITY].map(Number);
        let text = serde_json::to_string(&numbers).unwrap();
        assert!(text.starts_with("[0.30000000000000004,-0.0,") && text.ends_with(",null]"), "{text}");
        let back: [Number; 5] = serde_json::from_str(&text).unwrap();
        assert!(numbers[..4].iter().zip(&back).all(|(a, b)| a.0.to_bits() == b.0.to_bits()));
        assert!(back[4].0.is_nan());
    }

    #[test]
    fn an_answer_with_doubles_has_the_schema_of_one_with_numbers() {
        #[derive(Serialize, JsonSchema)]
        #[schemars(rename = "Answer", transform = nullable)]
        struct Doubles {
            /// The field under test.
            one: f64,
            rows: Vec<[f64; 3]>,
            other: Option<f64>,
            count: usize,
        }
        #[derive(Serialize, JsonSchema)]
        #[schemars(rename = "Answer")]
        struct Numbers {
            /// The field under test.
            one: Number,
            rows: Vec<[Number; 3]>,
            other: Option<Number>,
            count: usize,
        }
        assert_eq!(schemars::schema_for!(Doubles), schemars::schema_for!(Numbers));
        let (one, rows) = (f64::NAN, vec![[1.0, f64::INFINITY, 0.1]]);
        let doubles = Doubles { one, rows, other: Some(-f64::INFINITY), count: 2 };
        assert_eq!(
            serde_json::to_string(&doubles).unwrap(),
            r#"{"one":null,"rows":[[1.0,null,0.1]],"other":null,"count":2}"#
        );
    }
}
