//! Reading and writing of design values behind keys.

use nalgebra::{Matrix3, Point3, Vector3};
use serde_json::{Value as Json, json};

use super::found::FoundKey;
use super::optimize::WeighingMode;
use crate::design::construction::Spelling;
use crate::design::{WrittenNumber, construction::CoordinatePlane};
use machine::requirements::{
    BoltsFrom, ForceUnit, HolePattern, JointType, KeptSymmetry, ListedFrom, MassUnit, Objective, PlateMass,
    Region, VariableKind,
};
use machine::rotary::Elbow;
use platform::geom::{AngleUnit, FrameAxis, QuaternionOrder, UpAxis};
use platform::manipulator::Body;

/// A value behind a key.
pub(super) trait StoredValue: Sized {
    /// Reads it; `None` if it is invalid, with the reason in the report.
    fn take(found: &mut FoundKey<'_, '_>) -> Option<Self>;
    /// Writes it.
    fn json(&self) -> Json;
}

/// A field of the design: a required or an optional value.
pub(super) trait Stored {
    /// Puts the value of a key into it.
    fn fill(&mut self, found: &mut FoundKey<'_, '_>);
    /// The value of the key; `None` for an absent one.
    fn written(&self) -> Option<Json>;
}

impl<T: StoredValue> Stored for T {
    fn fill(&mut self, found: &mut FoundKey<'_, '_>) {
        if let Some(value) = T::take(found) {
            *self = value;
        }
    }

    fn written(&self) -> Option<Json> {
        Some(self.json())
    }
}

impl<T: StoredValue> Stored for Option<T> {
    fn fill(&mut self, found: &mut FoundKey<'_, '_>) {
        *self = T::take(found);
    }

    fn written(&self) -> Option<Json> {
        self.as_ref().map(T::json)
    }
}

impl StoredValue for f64 {
    fn take(found: &mut FoundKey<'_, '_>) -> Option<Self> {
        found.number()
    }

    fn json(&self) -> Json {
        json!(self)
    }
}

impl<const N: usize> StoredValue for [f64; N] {
    fn take(found: &mut FoundKey<'_, '_>) -> Option<Self> {
        found.numbers()
    }

    fn json(&self) -> Json {
        json!(self.as_slice())
    }
}

impl StoredValue for Vector3<f64> {
    fn take(found: &mut FoundKey<'_, '_>) -> Option<Self> {
        found.numbers::<3>().map(Self::from)
    }

    fn json(&self) -> Json {
        json!(self.as_slice())
    }
}

impl StoredValue for Point3<f64> {
    fn take(found: &mut FoundKey<'_, '_>) -> Option<Self> {
        found.numbers::<3>().map(Self::from)
    }

    fn json(&self) -> Json {
        self.coords.json()
    }
}

impl StoredValue for String {
    fn take(found: &mut FoundKey<'_, '_>) -> Option<Self> {
        found.text()
    }

    fn json(&self) -> Json {
        json!(self)
    }
}

/// A type whose values are words.
pub(super) trait Word: Copy + 'static {
    /// Every word.
    fn words() -> Vec<&'static str>;
    /// The value of a word.
    fn of(word: &str) -> Option<Self>;
}

macro_rules! words {
    ($($name:ty: $all:expr, $word:expr;)+) => {$(
        impl Word for $name {
            fn words() -> Vec<&'static str> {
                $all.map($word).to_vec()
            }

            fn of(word: &str) -> Option<Self> {
                num::names::named("word", word, &$all, $word).ok()
            }
        }

        impl StoredValue for $name {
            fn take(found: &mut FoundKey<'_, '_>) -> Option<Self> {
                found.word()
            }

            fn json(&self) -> Json {
                json!($word(*self))
            }
        }
    )+};
}

words! {
    AngleUnit: Self::ALL, Self::name;
    Body: Self::BOTH, Self::name;
    BoltsFrom: Self::ALL, Self::name;
    CoordinatePlane: Self::ALL, Self::name;
    FrameAxis: Self::ALL, Self::name;
    Elbow: Self::ALL, Self::name;
    ForceUnit: Self::ALL, Self::label;
    HolePattern: Self::ALL, Self::name;
    JointType: [Self::Ball, Self::Universal, Self::Flexure], Self::name;
    KeptSymmetry: Self::ALL, Self::code;
    WeighingMode: Self::ALL, Self::name;
    ListedFrom: [Self::Home, Self::Base], Self::name;
    MassUnit: Self::ALL, Self::label;
    Objective: Self::ALL, Self::code;
    PlateMass: Self::ALL, Self::name;
    QuaternionOrder: Self::ALL, Self::name;
    Region: [Self::Box, Self::Ellipsoid], Self::name;
    UpAxis: Self::ALL, Self::name;
    VariableKind: Self::ALL, Self::code;
}

/// The rows of a matrix.
pub(super) fn rows(m: &Matrix3<f64>) -> Json {
    json!([0, 1, 2].map(|i| [m[(i, 0)], m[(i, 1)], m[(i, 2)]]))
}

impl WrittenNumber {
    /// As it stands in a file.
    pub(super) fn json(&self) -> Json {
        match self.written() {
            Spelling::Number(x) => json!(x),
            Spelling::Text(text) => json!(text),
        }
    }
}

/// A list of numbers and expressions.
pub(super) fn quantities(list: &[WrittenNumber]) -> Json {
    list.iter().map(WrittenNumber::json).collect()
}
