//! Numbers with few digits near measured ones.

use serde_json::{Value as Json, json};

/// Slopes of lines at 15, 30, 60 and 75 degrees, and at 22.5 and 67.5, beside those that are decimals.
const SURDS: [(f64, &str); 6] = [
    (0.577_350_269_189_625_8, "sqrt(3)/3"),
    (1.732_050_807_568_877_2, "sqrt(3)"),
    (0.267_949_192_431_122_7, "2 - sqrt(3)"),
    (3.732_050_807_568_877, "2 + sqrt(3)"),
    (0.414_213_562_373_095_03, "sqrt(2) - 1"),
    (2.414_213_562_373_095, "sqrt(2) + 1"),
];

/// A number as it is written.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ShortNumber {
    pub(super) value: f64,
    pub(super) text: String,
}

impl ShortNumber {
    pub(super) fn whole(n: i32) -> Self {
        Self { value: n.into(), text: n.to_string() }
    }

    /// The decimal or surd with the fewest digits within a distance.
    pub(super) fn near(x: f64, distance: f64) -> Self {
        for digits in 0..=15 {
            // a surd is shorter than its fourth decimal
            if digits == 4
                && let Some((value, text)) =
                    SURDS.iter().find(|(value, _)| (x.abs() - value).abs() <= distance)
            {
                return if x < 0.0 {
                    Self { value: -value, text: format!("-({text})") }
                } else {
                    Self { value: *value, text: (*text).to_owned() }
                };
            }
            let text = format!("{x:.digits$}");
            if let Ok(value) = text.parse::<f64>()
                && (value - x).abs() <= distance
            {
                return Self::decimal(value);
            }
        }
        Self::decimal(x)
    }

    /// A double with its shortest digits.
    pub(super) fn decimal(x: f64) -> Self {
        // no negative zero
        let value = x + 0.0;
        Self { value, text: format!("{value:?}").trim_end_matches(".0").to_owned() }
    }

    pub(super) fn json(&self) -> Json {
        if self.text.parse::<f64>().is_ok() { json!(self.value) } else { json!(self.text) }
    }
}
