//! Tables of numbers: one record a line.

use super::failure::Failure;
use crate::design::table_rows;

/// At most so many bad lines are quoted.
const SHOWN: usize = 20;

/// What a table is called when it is refused.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TableName<'a> {
    /// Its file.
    pub(crate) path: &'a str,
    /// Code of the refusal.
    pub(crate) code: &'static str,
    /// What a line holds: "six lengths a line: l1,..".
    pub(crate) form: &'static str,
}

/// Lines read by `record`, with their numbers from 1. A first line without any number is a header; blank lines and lines that
/// begin with `#` are passed over.
///
/// # Errors
/// Exit 2: all bad lines are named; a table without a record is refused too.
pub(crate) fn read<T>(
    text: &str,
    table: TableName<'_>,
    record: impl Fn(&str) -> Result<T, String>,
) -> Result<Vec<(usize, T)>, Failure> {
    let (rows, bad) = match table_rows(text, record) {
        Ok(rows) => (rows, Vec::new()),
        Err(bad) => (Vec::new(), bad),
    };
    let path = table.path;
    let refused = |message: String| {
        Err(Failure::refused(table.code, message).with_help(format!("write {}", table.form)))
    };
    if !bad.is_empty() {
        let shown = bad.iter().take(SHOWN).cloned().collect::<Vec<_>>().join("; ");
        let more =
            if bad.len() > SHOWN { format!("; and {} more", bad.len() - SHOWN) } else { String::new() };
        return refused(format!("{path}: {shown}{more}"));
    }
    if rows.is_empty() {
        return refused(format!("{path} has no line of numbers"));
    }
    Ok(rows)
}
