//! Length units by label.

use thiserror::Error;

/// A length unit.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, schemars::JsonSchema)]
#[schemars(rename = "LengthUnitRecord")]
pub struct LengthUnit {
    /// Its label.
    pub label: &'static str,
    /// Metres per unit.
    #[serde(skip)]
    pub metres: f64,
    /// Millimetres.
    // beside the metres, so that a millimetre is one exactly
    #[serde(rename = "mm")]
    pub millimetres: f64,
}

/// A label that is not a known length unit.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("`{label}` is not a known unit of length; the known units are {}", LengthUnit::labels())]
pub struct UnknownUnit {
    /// The label.
    pub label: String,
}

const fn unit(label: &'static str, metres: f64, millimetres: f64) -> LengthUnit {
    LengthUnit { label, metres, millimetres }
}

/// The inch is 25.4 mm exactly.
const KNOWN: [LengthUnit; 6] = [
    unit("um", 1e-6, 1e-3),
    unit("mm", 1e-3, 1.0),
    unit("cm", 1e-2, 10.0),
    unit("m", 1.0, 1000.0),
    unit("in", 0.0254, 25.4),
    unit("ft", 0.3048, 304.8),
];

impl LengthUnit {
    /// The unit of a label: `um`, `mm`, `cm`, `m`, `in` or `ft`.
    ///
    /// # Errors
    /// [`UnknownUnit`] for every other label, `1` for instance.
    pub fn of(label: &str) -> Result<Self, UnknownUnit> {
        let found = KNOWN.into_iter().find(|u| u.label == label.trim());
        found.ok_or_else(|| UnknownUnit { label: label.to_string() })
    }

    /// The labels known, separated by commas.
    #[must_use]
    pub fn labels() -> String {
        KNOWN.map(|u| u.label).join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::micrometres;

    #[test]
    fn files_and_designs_know_the_same_units() {
        for unit in KNOWN {
            let whole = micrometres(unit.label).unwrap() as f64;
            assert!((whole - 1000.0 * unit.millimetres).abs() < 1e-9, "{}", unit.label);
        }
    }
}
