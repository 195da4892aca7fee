//! The violations of a design file, collected with their line and column.

use std::fmt;

use super::tree::{Node, Span};
use platform::manipulator::Body;

num::words! {
    /// The kind of a violation; the name in [`Code::name`] is stable.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
    #[non_exhaustive]
    pub enum Code as name, Display {
        /// The text is not TOML or not JSON.
        Syntax = "design::syntax",
        /// The file is empty.
        Empty = "design::empty",
        /// A key occurs twice in one table.
        DuplicateKey = "design::duplicate_key",
        /// Values are nested deeper than any design needs.
        NestingTooDeep = "design::nesting_too_deep",
        /// A key that no version of the format has.
        UnknownKey = "design::unknown_key",
        /// A required key is absent.
        MissingKey = "design::missing_key",
        /// A value of another kind than the key requires.
        WrongType = "design::wrong_type",
        /// A name, unit or joint name without a character.
        EmptyName = "design::empty_name",
        /// A text with characters that change the direction of text.
        TextDirection = "design::text_direction",
        /// A point or vector with other than three coordinates.
        CoordinateCount = "design::coordinate_count",
        /// NaN or infinite.
        NonFinite = "design::non_finite",
        /// The number or its square is outside the range of doubles.
        OutOfRange = "design::out_of_range",
        /// Other than six legs.
        LegCount = "design::leg_count",
        /// A leg that is not a pair of joint names.
        LegShape = "design::leg_shape",
        /// A leg names a joint that does not exist.
        MissingJoint = "design::missing_joint",
        /// Two legs join the same pair of joints.
        IdenticalLegs = "design::identical_legs",
        /// A body with exactly three joints in use, all on one line.
        CollinearTriangle = "design::collinear_triangle",
        /// All joints of each body coincide.
        NoSize = "design::no_size",
        /// Other than six leg lengths.
        LengthCount = "design::length_count",
        /// A leg length below zero.
        NegativeLength = "design::negative_length",
        /// A quantity with the wrong sign: it must be positive, or not negative.
        NotPositive = "design::not_positive",
        /// None or several of `rpy_deg`, `quat_wxyz`, `rotation`, or invalid numbers of a rotation.
        Rotation = "design::rotation",
        /// A workspace box without the `[home]` at its centre.
        MissingHome = "design::missing_home",
        /// Two keys that state the same thing in different ways.
        ConflictingKeys = "design::conflicting_keys",
        /// A grid with other than 1 to 5 points an axis.
        Grid = "design::grid",
        /// A text that is not an arithmetic expression.
        Expression = "design::expression",
        /// An expression or a construction names something that does not exist.
        UnknownName = "design::unknown_name",
        /// Parameters or joints with circular dependencies.
        Cycle = "design::cycle",
        /// An expression divides by zero, or by a value indistinguishable from it.
        DivisionByZero = "design::division_by_zero",
        /// A square root of a number that is or may be negative.
        NegativeRoot = "design::negative_root",
        /// The line through two joints that are the same point.
        NoLine = "design::no_line",
        /// Rods on cranks, where the command needs legs of variable length.
        Rotary = "design::rotary",
        /// Joint offsets, where the command takes the length of a drive for the distance of its joints.
        NotIdeal = "design::not_ideal",
        /// Expressions or constructions longer or more than any design needs.
        TooComplex = "design::too_complex",
        /// More violations than the list holds.
        TooMany = "design::too_many",
    }
}

/// A violation of the format in a design file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Violation {
    /// The kind.
    pub code: Code,
    /// Line, 1-based.
    pub line: usize,
    /// Column in characters, 1-based.
    pub column: usize,
    /// Number of characters of the text at fault on that line, at least 1.
    pub width: usize,
    /// The description of the fault.
    pub message: String,
    /// The remedy.
    pub help: String,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}: {} ({})", self.line, self.column, self.code, self.message, self.help)
    }
}

/// A valid entry that is often a mistake.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Warning {
    /// A joint without a leg.
    UnusedJoint {
        /// The body.
        body: Body,
        /// Its name.
        name: String,
        /// Line, 1-based.
        line: usize,
    },
    /// Two names at exactly the same coordinates.
    CoincidentJoints {
        /// The body.
        body: Body,
        /// The first name.
        first: String,
        /// The later name.
        second: String,
        /// Line of the later one, 1-based.
        line: usize,
    },
    /// Two legs between the same two points, under one name or two.
    CoincidentLegs {
        /// The legs, counted from 1.
        legs: [usize; 2],
        /// Line of the later one, 1-based.
        line: usize,
    },
    /// `legs` below a table header, so that TOML assigns it to that table.
    LegsInsideTable {
        /// The table.
        table: &'static str,
        /// Line, 1-based.
        line: usize,
    },
    /// A key under the name that it had in the last release.
    RenamedKey {
        /// The name in the text.
        old: String,
        /// The name of the key.
        new: &'static str,
        /// Line, 1-based.
        line: usize,
    },
}

/// The version that no longer reads the old names of keys.
const WITHOUT_OLD_NAMES: &str = "0.3";

impl Warning {
    /// The stable name.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::UnusedJoint { .. } => "design::unused_joint",
            Self::CoincidentJoints { .. } => "design::coincident_joints",
            Self::CoincidentLegs { .. } => "design::coincident_legs",
            Self::LegsInsideTable { .. } => "design::legs_inside_table",
            Self::RenamedKey { .. } => "design::renamed_key",
        }
    }

    /// The line of the warning, 1-based.
    #[must_use]
    pub fn line(&self) -> usize {
        match self {
            Self::UnusedJoint { line, .. }
            | Self::CoincidentJoints { line, .. }
            | Self::CoincidentLegs { line, .. }
            | Self::LegsInsideTable { line, .. }
            | Self::RenamedKey { line, .. } => *line,
        }
    }

    /// The remedy.
    #[must_use]
    pub fn advice(&self) -> String {
        match self {
            Self::UnusedJoint { name, .. } => format!("attach a leg to {name} or remove it"),
            Self::CoincidentJoints { first, second, .. } => format!(
                "if the legs share one joint, name {first} in all of them: {first} and {second} count as two joints"
            ),
            Self::CoincidentLegs { .. } => {
                "give each leg its own pair of joints: two legs on one line hold the platform like one leg"
                    .into()
            }
            Self::LegsInsideTable { .. } => {
                "move `legs` above the first [table] of the file; it is read as a top-level key".into()
            }
            Self::RenamedKey { new, .. } => {
                format!("write `{new}`: the old key is read until version {WITHOUT_OLD_NAMES}")
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
            Self::CoincidentLegs { legs: [a, b], .. } => {
                write!(f, "legs {a} and {b} join the same two points")
            }
            Self::LegsInsideTable { table, .. } => write!(f, "`legs` is a key of [{table}] here"),
            Self::RenamedKey { old, new, .. } => write!(f, "`{old}` is now `{new}`"),
        }
    }
}

/// Greatest number of listed violations; the rest is only counted.
const MAX_VIOLATIONS: usize = 100;

/// Violations and warnings found so far in one text.
#[derive(Debug)]
pub struct Findings<'t> {
    text: &'t str,
    line_starts: Vec<usize>,
    violations: Vec<Violation>,
    warnings: Vec<Warning>,
    unlisted: usize,
    /// The places of old names of keys, with their new names.
    renamed: Vec<(Span, &'static str)>,
    /// Micrometres of the unit of the design, where its label names a known length.
    pub(crate) length_unit: Option<u64>,
}

impl<'t> Findings<'t> {
    /// No findings yet in a text.
    pub fn new(text: &'t str) -> Self {
        let starts = text.bytes().enumerate().filter(|(_, b)| *b == b'\n').map(|(i, _)| i + 1);
        let line_starts = std::iter::once(0).chain(starts).collect();
        Self {
            text,
            line_starts,
            violations: Vec::new(),
            warnings: Vec::new(),
            unlisted: 0,
            renamed: Vec::new(),
            length_unit: None,
        }
    }

    /// Line of a byte offset, 1-based.
    pub fn line(&self, offset: usize) -> usize {
        self.line_starts.partition_point(|&start| start <= offset).max(1)
    }

    /// Text of a line, 1-based, with its end of line.
    pub(crate) fn line_text(&self, line: usize) -> &'t str {
        let start = self.line_starts.get(line - 1).copied().unwrap_or(self.text.len());
        let end = self.line_starts.get(line).copied().unwrap_or(self.text.len());
        &self.text[start..end]
    }

    /// Adds a violation at a place.
    pub fn refuse(&mut self, code: Code, span: &Span, message: impl Into<String>, help: impl Into<String>) {
        if self.is_full() {
            self.unlisted += 1;
            return;
        }
        let (line, column, width) = self.locate(span);
        let (message, help) = (message.into(), help.into());
        self.violations.push(Violation { code, line, column, width, message, help });
    }

    /// Adds a violation at a place whose value cannot be used: there is none.
    pub fn refused<T>(
        &mut self,
        code: Code,
        span: &Span,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Option<T> {
        self.refuse(code, span, message, help);
        None
    }

    /// Adds a violation at a value of a wrong type: `what` is not what was `wanted`, such as `an array`.
    pub fn not_a<T>(&mut self, node: &Node, what: &str, wanted: &str, help: impl Into<String>) -> Option<T> {
        let message = format!("{what} is {}, not {wanted}", node.value.kind());
        self.refused(Code::WrongType, &node.span, message, help)
    }

    pub(crate) fn warn(&mut self, warning: Warning) {
        if self.warnings.len() < MAX_VIOLATIONS {
            self.warnings.push(warning);
        }
    }

    /// Notes that the key at a place has a new name.
    pub(crate) fn rename(&mut self, span: &Span, old: &str, new: &'static str) {
        let line = self.line(span.start);
        self.warn(Warning::RenamedKey { old: old.to_owned(), new, line });
        // a key that is spelt with escapes stays: the design is then written anew when it is saved
        if self.source(span).trim_matches(['"', '\'']) == old {
            self.renamed.push((span.clone(), new));
        }
    }

    /// The text with the new names of its keys.
    pub(crate) fn text_with_new_names(&self) -> String {
        let mut text = self.text.to_owned();
        let mut renamed = self.renamed.clone();
        // from the last to the first, so that the places of the others stay
        renamed.sort_by_key(|(span, _)| std::cmp::Reverse(span.start));
        for (span, new) in renamed {
            text.replace_range(span, new);
        }
        text
    }

    /// The text at a place.
    pub fn source(&self, span: &Span) -> &'t str {
        self.text.get(span.clone()).unwrap_or_default()
    }

    /// Whether further violations are only counted.
    pub(crate) fn is_full(&self) -> bool {
        self.violations.len() >= MAX_VIOLATIONS
    }

    /// The number of violations so far.
    pub fn count(&self) -> usize {
        self.violations.len() + self.unlisted
    }

    /// Whether there is no violation so far.
    pub fn is_clean(&self) -> bool {
        self.violations.is_empty()
    }

    /// The violations in the order of the text, closed by a count of those not listed.
    pub fn into_violations(mut self) -> Vec<Violation> {
        self.violations.sort_by_key(|v| (v.line, v.column));
        if self.unlisted > 0 {
            self.violations.push(Violation {
                code: Code::TooMany,
                line: self.line_starts.len(),
                column: 1,
                width: 1,
                message: format!("{} more violations are not listed", self.unlisted),
                help: "correct the listed ones first".into(),
            });
        }
        self.violations
    }

    pub(crate) fn into_warnings(mut self) -> Vec<Warning> {
        self.warnings.sort_by_key(Warning::line);
        self.warnings
    }

    /// Line, column and width on that line, all in characters.
    fn locate(&self, span: &Span) -> (usize, usize, usize) {
        let line = self.line(span.start.min(self.text.len()));
        let start = self.line_starts[line - 1];
        let end = self.line_starts.get(line).map_or(self.text.len(), |next| next - 1);
        let chars = |from: usize, to: usize| self.text.get(from..to).map_or(0, |s| s.chars().count());
        let column = chars(start, span.start.min(self.text.len())) + 1;
        let width = chars(span.start.min(end), span.end.min(end)).max(1);
        (line, column, width)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_counted_in_characters() {
        let text = "a\n\u{e9}\u{e9} = x\r\n";
        let mut report = Findings::new(text);
        let at = text.find('x').unwrap();
        report.refuse(Code::Syntax, &(at..at + 1), "m", "h");
        report.refuse(Code::Syntax, &(text.len()..text.len()), "m", "h");
        let found: Vec<_> = report.into_violations().iter().map(|v| (v.line, v.column, v.width)).collect();
        assert_eq!(found, [(2, 6, 1), (3, 1, 1)]);
    }

    #[test]
    fn endless_violations_end_in_a_count() {
        let mut report = Findings::new("x");
        for _ in 0..250 {
            report.refuse(Code::UnknownKey, &(0..1), "m", "h");
        }
        let violations = report.into_violations();
        assert_eq!(violations.len(), 101);
        assert_eq!(violations[100].code, Code::TooMany);
        assert!(violations[100].message.starts_with("150 more"));
    }
}
