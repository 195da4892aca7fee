//! The joints for which a verdict is proved.

/// The level of a verdict, with the same three words everywhere.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum Level {
    /// It holds within the rounding of the joints, without a proof.
    WithinRounding,
    /// It is proved for the doubles as written: rational numbers, regardless of their origin.
    DoublesAsWritten,
    /// It is proved for the exact joints, whose rounded values are the doubles.
    ExactJoints,
}

impl Level {
    /// The words: `"within rounding"`, `"about the doubles as written"` or `"about the exact joints"`.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::WithinRounding => "within rounding",
            Self::DoublesAsWritten => "about the doubles as written",
            Self::ExactJoints => "about the exact joints",
        }
    }

    /// Whether it is proved.
    #[must_use]
    pub fn is_proved(self) -> bool {
        self != Self::WithinRounding
    }
}
