//! What is wrong with a design file, and where.

use std::fmt;

/// What kind of violation; the name in [`Code::as_str`] is stable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Code {
    /// The text is not TOML or not JSON.
    Syntax,
    /// There is nothing in the file.
    Empty,
    /// A key stands twice in one table.
    DuplicateKey,
    /// Values are nested deeper than any design needs.
    NestingTooDeep,
    /// A key no version of the format knows.
    UnknownKey,
    /// A required key is absent.
    MissingKey,
    /// A value of another kind than the key takes.
    WrongType,
    /// A name, unit or joint name without a character.
    EmptyName,
    /// A point or vector with other than three coordinates.
    CoordinateCount,
    /// NaN or infinite.
    NonFinite,
    /// So large or so small that squares leave the range of doubles.
    OutOfRange,
    /// Other than six legs.
    LegCount,
    /// A leg that is not a pair of joint names.
    LegShape,
    /// A leg names a joint that does not exist.
    MissingJoint,
    /// Two legs join the same pair of joints.
    IdenticalLegs,
    /// A body with exactly three joints in use has them on one line.
    CollinearTriangle,
    /// All joints of each body coincide.
    NoSize,
    /// Other than six leg lengths.
    LengthCount,
    /// A leg length below zero.
    NegativeLength,
    /// A quantity that must be above zero (or not below) is not.
    NotPositive,
    /// None or several of `rpy_deg`, `quat_wxyz`, `rotation`, or numbers that are no rotation.
    Rotation,
    /// A workspace box without the `[home]` it lies around.
    MissingHome,
    /// Two keys that say the same thing in different ways.
    ConflictingKeys,
    /// A grid with other than 1 to 5 points an axis.
    Grid,
    /// More violations than are worth listing.
    TooMany,
}

impl Code {
    /// The stable name, `design::unknown_key` for example.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Syntax => "design::syntax",
            Self::Empty => "design::empty",
            Self::DuplicateKey => "design::duplicate_key",
            Self::NestingTooDeep => "design::nesting_too_deep",
            Self::UnknownKey => "design::unknown_key",
            Self::MissingKey => "design::missing_key",
            Self::WrongType => "design::wrong_type",
            Self::EmptyName => "design::empty_name",
            Self::CoordinateCount => "design::coordinate_count",
            Self::NonFinite => "design::non_finite",
            Self::OutOfRange => "design::out_of_range",
            Self::LegCount => "design::leg_count",
            Self::LegShape => "design::leg_shape",
            Self::MissingJoint => "design::missing_joint",
            Self::IdenticalLegs => "design::identical_legs",
            Self::CollinearTriangle => "design::collinear_triangle",
            Self::NoSize => "design::no_size",
            Self::LengthCount => "design::length_count",
            Self::NegativeLength => "design::negative_length",
            Self::NotPositive => "design::not_positive",
            Self::Rotation => "design::rotation",
            Self::MissingHome => "design::missing_home",
            Self::ConflictingKeys => "design::conflicting_keys",
            Self::Grid => "design::grid",
            Self::TooMany => "design::too_many",
        }
    }
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

/// One thing wrong with a design file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Violation {
    /// What kind.
    pub code: Code,
    /// Line, 1-based.
    pub line: usize,
    /// Column in characters, 1-based.
    pub column: usize,
    /// Number of characters of the text at fault on that line, at least 1.
    pub width: usize,
    /// What is wrong.
    pub message: String,
    /// What to do about it.
    pub help: String,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}: {} ({})", self.line, self.column, self.code, self.message, self.help)
    }
}

/// Something that is allowed but is often a slip.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Warning {
    /// A joint no leg is attached to.
    UnusedJoint {
        /// `"base"` or `"platform"`.
        body: &'static str,
        /// Its name.
        name: String,
        /// Line, 1-based.
        line: usize,
    },
    /// Two names at exactly the same coordinates.
    CoincidentJoints {
        /// `"base"` or `"platform"`.
        body: &'static str,
        /// The name that comes first.
        first: String,
        /// The name that comes later.
        second: String,
        /// Line of the later one, 1-based.
        line: usize,
    },
    /// `legs` was written below a table header, so that TOML counts it to that table.
    LegsInsideTable {
        /// The table.
        table: &'static str,
        /// Line, 1-based.
        line: usize,
    },
}

impl Warning {
    /// The stable name.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::UnusedJoint { .. } => "design::unused_joint",
            Self::CoincidentJoints { .. } => "design::coincident_joints",
            Self::LegsInsideTable { .. } => "design::legs_inside_table",
        }
    }

    /// The line it is about, 1-based.
    #[must_use]
    pub fn line(&self) -> usize {
        match self {
            Self::UnusedJoint { line, .. }
            | Self::CoincidentJoints { line, .. }
            | Self::LegsInsideTable { line, .. } => *line,
        }
    }

    /// What to do about it.
    #[must_use]
    pub fn advice(&self) -> String {
        match self {
            Self::UnusedJoint { name, .. } => format!("attach a leg to {name} or remove it"),
            Self::CoincidentJoints { first, second, .. } => format!(
                "if the legs share one joint there, name {first} in all of them; {first} and {second} count as two joints"
            ),
            Self::LegsInsideTable { .. } => {
                "move `legs` above the first [table] of the file; it is read as a top-level key".into()
            }
        }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnusedJoint { body, name, .. } => write!(f, "{body} joint {name} carries no leg"),
            Self::CoincidentJoints { body, first, second, .. } => {
                write!(f, "{body} joints {first} and {second} have the same coordinates")
            }
            Self::LegsInsideTable { table, .. } => write!(f, "`legs` stands inside [{table}]"),
        }
    }
}
