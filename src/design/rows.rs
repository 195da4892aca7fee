//! Tables of numbers: one record a line.

/// Lines read by `record`, with their numbers from 1. A first line without any number is a header; blank lines and lines that
/// begin with `#` are passed over.
///
/// # Errors
/// What is wrong with each bad line.
pub(crate) fn table_rows<T>(
    text: &str,
    record: impl Fn(&str) -> Result<T, String>,
) -> Result<Vec<(usize, T)>, Vec<String>> {
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
    if bad.is_empty() { Ok(rows) } else { Err(bad) }
}
