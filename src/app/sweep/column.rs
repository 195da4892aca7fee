//! Columns of the table of a sweep, and the types of their cells.

/// The first column: the numbers of the candidates.
pub(crate) const CANDIDATE: &str = "candidate";

num::words! {
    /// The type of the cells of a column.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum ColumnKind as name {
        /// Doubles.
        Number = "number",
        /// Integers of 64 bits.
        Integer = "integer",
        /// Truth values.
        Truth = "truth",
        /// Texts.
        Text = "text",
    }
}

/// A column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SweepColumn {
    /// The name of the column.
    pub name: String,
    /// The type of its cells.
    pub kind: ColumnKind,
    /// The unit; `None` for pure numbers, texts and truth values.
    pub unit: Option<String>,
    /// The meaning of the column, in words.
    pub meaning: String,
}

impl SweepColumn {
    pub(crate) fn new(name: &str, kind: ColumnKind, unit: Option<&str>, meaning: &str) -> Self {
        Self { name: name.into(), kind, unit: unit.map(Into::into), meaning: meaning.into() }
    }

    /// A column of doubles.
    pub fn number(name: &str, unit: Option<&str>, meaning: &str) -> Self {
        Self::new(name, ColumnKind::Number, unit, meaning)
    }
}

/// The value of a cell.
#[derive(Debug, Clone, PartialEq)]
pub enum SweepCell {
    /// Empty: not decided, not computed, or not applicable.
    Empty,
    /// A double.
    Number(f64),
    /// An integer.
    Integer(i64),
    /// Yes or no.
    Truth(bool),
    /// Words.
    Text(String),
}

impl SweepCell {
    /// A count as an integer cell.
    pub fn count(n: usize) -> Self {
        i64::try_from(n).map_or(Self::Empty, Self::Integer)
    }

    /// A number, or an empty cell.
    pub fn number(x: Option<f64>) -> Self {
        x.map_or(Self::Empty, Self::Number)
    }

    /// A truth value, or an empty cell if undecided.
    pub fn truth(x: Option<bool>) -> Self {
        x.map_or(Self::Empty, Self::Truth)
    }

    /// A text, or an empty cell.
    pub fn text(x: Option<&str>) -> Self {
        x.map_or(Self::Empty, |x| Self::Text(x.into()))
    }

    /// The value as a double, for comparisons and pictures.
    pub fn as_number(&self) -> Option<f64> {
        match self {
            Self::Number(x) => Some(*x),
            Self::Integer(n) => Some(*n as f64),
            Self::Truth(b) => Some(f64::from(u8::from(*b))),
            Self::Empty | Self::Text(_) => None,
        }
    }

    /// Whether two cells hold the same bits; a NaN equals itself.
    pub fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Number(a), Self::Number(b)) => a.to_bits() == b.to_bits(),
            (a, b) => a == b,
        }
    }
}

/// The cell as text for people.
impl std::fmt::Display for SweepCell {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Empty => Ok(()),
            Self::Number(x) => write!(f, "{x}"),
            Self::Integer(n) => write!(f, "{n}"),
            Self::Truth(b) => write!(f, "{b}"),
            Self::Text(text) => f.write_str(text),
        }
    }
}
