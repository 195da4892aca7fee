//! Numbers that JSON may have no word for.

use std::borrow::Cow;

use num_complex::Complex64;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A number that may be infinite or not a number, which JSON cannot say: `null` then, read back as NaN.
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

/// Complex numbers in some arrangement: real and imaginary parts, each in that arrangement.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ComplexRecord<T> {
    /// Real parts.
    pub re: T,
    /// Imaginary parts.
    pub im: T,
}

impl<const N: usize> From<[Complex64; N]> for ComplexRecord<[Number; N]> {
    fn from(z: [Complex64; N]) -> Self {
        Self { re: z.map(|z| Number(z.re)), im: z.map(|z| Number(z.im)) }
    }
}

impl<const N: usize, const M: usize> From<[[Complex64; N]; M]> for ComplexRecord<[[Number; N]; M]> {
    fn from(z: [[Complex64; N]; M]) -> Self {
        Self { re: z.map(|row| row.map(|z| Number(z.re))), im: z.map(|row| row.map(|z| Number(z.im))) }
    }
}

/// The fields of a record that stand among those of another: all of them or none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum AllOrNone<T> {
    /// There is one.
    All(T),
    /// There is none.
    #[schemars(extend("properties" = {}))]
    None {},
}

impl<T> AllOrNone<T> {
    /// The record, where its fields are there.
    #[must_use]
    pub fn as_option(&self) -> Option<&T> {
        match self {
            Self::All(record) => Some(record),
            Self::None {} => None,
        }
    }
}

impl<T> From<Option<T>> for AllOrNone<T> {
    fn from(record: Option<T>) -> Self {
        record.map_or(Self::None {}, Self::All)
    }
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
}
