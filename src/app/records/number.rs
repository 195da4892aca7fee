//! Complex numbers, fields that are all there or none, and fields that are not read back.

use num_complex::Complex64;
use schemars::JsonSchema;
use serde::de::IgnoredAny;
use serde::{Deserialize, Deserializer, Serialize};

use num::Number;

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

/// The fields of a record among the fields of another one: all of them or none.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum AllOrNone<T> {
    /// The record is present.
    All(T),
    /// The record is absent.
    #[schemars(extend("properties" = {}))]
    None {},
}

impl<T> From<Option<T>> for AllOrNone<T> {
    fn from(record: Option<T>) -> Self {
        record.map_or(Self::None {}, Self::All)
    }
}

/// Reads over a field that no sheet shows.
pub(crate) fn left_out<'de, D: Deserializer<'de>, T: Default>(from: D) -> Result<T, D::Error> {
    IgnoredAny::deserialize(from).map(|_| T::default())
}
