//! The joints that a judgement is proved about.

/// How far a judgement goes: the same three words everywhere.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum Level {
    /// It holds within the rounding of the joints, and nothing is proved.
    WithinRounding,
    /// It is proved about the doubles as written: rational numbers, whatever was rounded to them.
    DoublesAsWritten,
    /// It is proved about the exact joints, of which doubles are rounded values.
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
