//! The conditions for keeping a row: a column, a comparison, a value.

use crate::column::{ColumnKind, SweepCell, SweepColumn};

/// A comparison.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum KeepComparison {
    Less,
    AtMost,
    Equal,
    Unequal,
    AtLeast,
    Greater,
}

/// The signs; longer ones first, so that `<=` is not read as `<`.
const SIGNS: [(&str, KeepComparison); 6] = [
    ("<=", KeepComparison::AtMost),
    (">=", KeepComparison::AtLeast),
    ("==", KeepComparison::Equal),
    ("!=", KeepComparison::Unequal),
    ("<", KeepComparison::Less),
    (">", KeepComparison::Greater),
];

/// A condition such as `conditioning >= 0.1`; a row is kept if all conditions hold. An empty cell satisfies none.
#[derive(Debug, Clone, PartialEq)]
pub struct KeepCondition {
    /// Index of the column.
    pub column: usize,
    comparison: KeepComparison,
    value: SweepCell,
}

/// The form of a condition, for messages.
const FORM: &str = "write a column, one of < <= == != >= >, and a value: \"conditioning >= 0.1\"";

impl KeepCondition {
    /// A condition as column, comparison and value.
    ///
    /// # Errors
    /// A missing comparison, with the remedy.
    pub fn parts(text: &str) -> Result<(&str, KeepComparison, &str), (String, String)> {
        let place = SIGNS.iter().filter_map(|sign| Some((text.find(sign.0)?, sign)));
        // among signs at one place the longer one, which comes first
        let Some((at, (sign, comparison))) = place.min_by_key(|(at, _)| *at) else {
            return Err((format!("`{text}` compares nothing"), FORM.into()));
        };
        Ok((text[..at].trim(), *comparison, text[at + sign.len()..].trim()))
    }

    /// Reads a condition about one of these columns.
    ///
    /// # Errors
    /// The fault of the condition, with the remedy.
    pub fn read(text: &str, columns: &[SweepColumn]) -> Result<Self, (String, String)> {
        let (name, comparison, value) = Self::parts(text)?;
        let Some(column) = columns.iter().position(|c| c.name == name) else {
            let names: Vec<&str> = columns.iter().map(|c| c.name.as_str()).collect();
            let help = files::design::spanned::nearest_help("columns of this plan", name, &names);
            return Err((format!("`{name}` is not a column of this plan"), help));
        };
        let kind = columns[column].kind;
        let read = match kind {
            ColumnKind::Number | ColumnKind::Integer => {
                value.parse().ok().filter(|x: &f64| x.is_finite()).map(SweepCell::Number)
            }
            ColumnKind::Truth => value.parse().ok().map(SweepCell::Truth),
            ColumnKind::Text => Some(SweepCell::Text(value.trim_matches(['"', '\'']).to_owned())),
        };
        let Some(value) = read else {
            return Err((
                format!("`{value}` is not a {} to compare `{name}` with", kind.name()),
                FORM.into(),
            ));
        };
        let ordered = !matches!(comparison, KeepComparison::Equal | KeepComparison::Unequal);
        if ordered && matches!(kind, ColumnKind::Truth | ColumnKind::Text) {
            return Err((format!("`{name}` has no order: compare it with == or !="), FORM.into()));
        }
        Ok(Self { column, comparison, value })
    }

    /// Whether a row satisfies the condition; its cells up to this column must be known.
    pub fn holds(&self, row: &[SweepCell]) -> bool {
        let cell = &row[self.column];
        match (cell, &self.value) {
            (SweepCell::Empty, _) => false,
            (SweepCell::Text(_) | SweepCell::Truth(_), value) => match self.comparison {
                KeepComparison::Equal => cell == value,
                _ => cell != value,
            },
            _ => {
                let (Some(x), Some(y)) = (cell.as_number(), self.value.as_number()) else { return false };
                match self.comparison {
                    KeepComparison::Less => x < y,
                    KeepComparison::AtMost => x <= y,
                    KeepComparison::Equal => x.partial_cmp(&y).is_some_and(std::cmp::Ordering::is_eq),
                    KeepComparison::Unequal => x.partial_cmp(&y).is_some_and(std::cmp::Ordering::is_ne),
                    KeepComparison::AtLeast => x >= y,
                    KeepComparison::Greater => x > y,
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns() -> Vec<SweepColumn> {
        vec![
            SweepColumn::number("x", None, ""),
            SweepColumn::new("met", ColumnKind::Truth, None, ""),
            SweepColumn::new("word", ColumnKind::Text, None, ""),
            SweepColumn::new("n", ColumnKind::Integer, None, ""),
        ]
    }

    #[test]
    fn conditions_compare_as_they_are_written() {
        let row = [
            SweepCell::Number(0.5),
            SweepCell::Truth(true),
            SweepCell::Text("proved".into()),
            SweepCell::Integer(40),
        ];
        let holds = |text: &str| KeepCondition::read(text, &columns()).unwrap().holds(&row);
        for yes in [
            "x >= 0.5",
            "x<=0.5",
            "x == 0.5",
            "x > -1e3",
            "met == true",
            "met != false",
            "word == proved",
            "word == \"proved\"",
            "word != modular",
            "n == 40",
            "n > 39.5",
        ] {
            assert!(holds(yes), "{yes}");
        }
        for no in ["x > 0.5", "x < 0.5", "x != 0.5", "met == false", "word == modular", "n < 40"] {
            assert!(!holds(no), "{no}");
        }
        let empty = [SweepCell::Empty, SweepCell::Empty, SweepCell::Empty, SweepCell::Empty];
        for text in ["x < 1", "x != 1", "met != true", "word != a"] {
            assert!(!KeepCondition::read(text, &columns()).unwrap().holds(&empty), "{text}");
        }
        assert!(!KeepCondition::read("x < 1", &columns()).unwrap().holds(&[SweepCell::Number(f64::NAN)]));
    }

    #[test]
    fn what_is_no_condition_is_refused_with_what_was_meant() {
        let refused = |text: &str| KeepCondition::read(text, &columns()).unwrap_err();
        assert!(refused("x").0.contains("compares nothing"));
        assert!(refused("wort == a").1.contains("did you mean `word`?"));
        assert!(refused("x > high").0.contains("not a number"));
        assert!(refused("met == 1").0.contains("not a truth"));
        assert!(refused("met > true").0.contains("no order"));
        assert!(refused("x > inf").0.contains("not a number"));
    }
}
