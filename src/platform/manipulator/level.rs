//! The joints for which a verdict is proved.

num::words! {
    /// The level of a verdict, with the same three words everywhere.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
    #[cfg_attr(
        feature = "serde",
        derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
        serde(rename_all = "snake_case")
    )]
    pub enum Level as words {
        /// It holds within the rounding of the joints, without a proof.
        WithinRounding = "within rounding",
        /// It is proved for the doubles as written: rational numbers, regardless of their origin.
        DoublesAsWritten = "about the doubles as written",
        /// It is proved for the exact joints, whose rounded values are the doubles.
        ExactJoints = "about the exact joints",
    }
}

impl Level {
    /// Whether it is proved.
    #[must_use]
    pub fn is_proved(self) -> bool {
        self != Self::WithinRounding
    }
}
