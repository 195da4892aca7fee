//! Numbers in options: decimals, or expressions as in design files. Lengths may have a unit behind them.

use super::failure::Failure;
use files::design::{Share, length_in};
use num::surd::Surd;

/// The double nearest to a finite number.
pub(crate) fn one(text: &str) -> Option<f64> {
    let double: Option<f64> = text.trim().parse().ok().filter(|x: &f64| x.is_finite());
    double.or_else(|| text.parse().ok().map(|x: Share| x.nearest()).filter(|x| x.is_finite()))
}

/// The value of an option that is one number.
///
/// # Errors
/// The fault of the text.
pub(crate) fn number(text: &str) -> Result<f64, String> {
    one(text).ok_or_else(|| "give a finite number: a decimal or an expression such as 12/5".to_owned())
}

/// A length as it is typed, before the design with its unit is read: `25`, `12/5 mm`, `36/19 in`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Length(String);

/// The value of an option that is one length.
///
/// # Errors
/// The fault of the text.
pub(crate) fn length(text: &str) -> Result<Length, String> {
    // in some unit it has to be a finite number; whether the design has one is not known yet
    one_length(text, "mm").map(|_| Length(text.to_owned()))
}

impl Length {
    /// In the unit of a design.
    ///
    /// # Errors
    /// A unit, where the label of the design's unit names no known length.
    pub(crate) fn of(&self, units: &str) -> Result<f64, Failure> {
        one_length(&self.0, units)
            .map_err(|why| Failure::refused("length::unit", why).with_help(WITHOUT_UNIT))
    }

    /// The same of an option that may be absent.
    ///
    /// # Errors
    /// As [`Self::of`].
    pub(crate) fn of_option(option: Option<&Self>, units: &str) -> Result<Option<f64>, Failure> {
        option.map(|length| length.of(units)).transpose()
    }
}

/// An offset as it is typed: a share, or a length along an edge with a unit.
///
/// # Errors
/// The fault of the text.
pub(crate) fn offset(text: &str) -> Result<String, String> {
    one_length(text, "mm").map(|_| text.to_owned())
}

/// The help for a unit that cannot be converted.
const WITHOUT_UNIT: &str =
    "write the number in the unit of the design, or name a unit in the design: units = \"mm\"";

/// The double nearest to a length.
fn one_length(text: &str, units: &str) -> Result<f64, String> {
    let value = length_in(text, units).map_err(|why| why.to_string())?.nearest();
    if value.is_finite() { Ok(value) } else { Err(format!("`{text}` is no finite number")) }
}

/// So many lengths separated by commas, in the unit of a design; `word` is how many.
///
/// # Errors
/// The fault of the text.
pub(crate) fn lengths<const N: usize>(text: &str, word: &str, units: &str) -> Result<[f64; N], String> {
    let fields: Vec<&str> = text.split(',').map(str::trim).collect();
    let fields: [&str; N] = fields.try_into().map_err(|f: Vec<_>| match f.len() {
        1 => format!("one value instead of {word}"),
        n => format!("{n} values instead of {word}"),
    })?;
    let mut values = [0.0; N];
    for (i, field) in fields.iter().enumerate() {
        values[i] =
            one_length(field, units).map_err(|why| format!("value {} is not a length: {why}", i + 1))?;
    }
    Ok(values)
}

/// The fault of a text that is not `count` finite numbers separated by commas.
pub(crate) fn fault(option: &str, text: &str, count: usize) -> String {
    let fields: Vec<&str> = text.split(',').collect();
    match fields.iter().find(|field| one(field).is_none()) {
        Some(field) => format!("{option}: `{}` is not a finite number", field.trim()),
        None if fields.len() == 1 => format!("{option} has one number instead of {count}"),
        None => format!("{option} has {} numbers instead of {count}", fields.len()),
    }
}

/// Finite numbers separated by commas.
pub(crate) fn parse<const N: usize>(text: &str) -> Option<[f64; N]> {
    let all: Option<Vec<f64>> = text.split(',').map(one).collect();
    all.and_then(|v| v.try_into().ok())
}

/// Exact numbers separated by commas.
///
/// # Errors
/// The fault of the text.
pub(crate) fn exact<const N: usize>(text: &str) -> Result<[Surd; N], String> {
    let one = |field: &str| {
        let number: Share = field.parse().map_err(|why: files::design::InvalidShare| why.to_string())?;
        number
            .exact()
            .cloned()
            .ok_or_else(|| format!("`{field}` has no exact value in square roots and cosines"))
    };
    let all: Vec<Surd> = text.split(',').map(one).collect::<Result<_, _>>()?;
    all.try_into().map_err(|_| format!("`{text}` is not {N} numbers"))
}
