//! Tables of numbers: one record a line.

use super::failure::Failure;

/// At most so many bad lines are quoted.
const SHOWN: usize = 20;

/// What a table is called when it is refused.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Table<'a> {
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
    table: Table<'_>,
    record: impl Fn(&str) -> Result<T, String>,
) -> Result<Vec<(usize, T)>, Failure> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let (mut rows, mut bad) = (Vec::new(), Vec::new());
    let content = text.lines().enumerate().filter(|(_, l)| !l.trim().is_empty() && !l.starts_with('#'));
    for (position, (i, line)) in content.enumerate() {
        let is_header = position == 0 && line.split(',').all(|f| f.trim().parse::<f64>().is_err());
        if is_header {
            continue;
        }
        match record(line) {
            Ok(value) => rows.push((i + 1, value)),
            Err(message) => bad.push(format!("line {}: {message}", i + 1)),
        }
    }
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
