//! Numbers in sheets, which are rounded where the sheet is shown.

use std::borrow::Cow;

use num::shown::rounded;

/// Significant digits of a number unless another count is asked for.
pub const DIGITS: u8 = 3;

/// Characters of the private use area around a number; no answer has them for something else.
const MARKS: [char; 2] = ['\u{e000}', '\u{e001}'];

/// A number for a line or a cell of a sheet.
pub(crate) fn figure(x: f64) -> String {
    format!("{}{x:?}{}", MARKS[0], MARKS[1])
}

/// A length with its unit; designs without a unit have the label `1`.
pub(crate) fn length(x: f64, units: &str) -> String {
    if units == "1" { figure(x) } else { format!("{} {units}", figure(x)) }
}

/// The text with its numbers rounded to so many digits.
pub(crate) fn rounded_in(text: &str, digits: usize) -> Cow<'_, str> {
    if !text.contains(MARKS[0]) {
        return text.into();
    }
    let mut parts = text.split(MARKS[0]);
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (number, rest) = part.split_once(MARKS[1]).unwrap_or((part, ""));
        match number.parse() {
            Ok(x) => out.push_str(&rounded(x, digits)),
            Err(_) => out.push_str(number),
        }
        out.push_str(rest);
    }
    out.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_marked_numbers_are_rounded() {
        let text = format!("{} of 1.23456 mm, {}", figure(9.876_54), figure(f64::INFINITY));
        assert_eq!(rounded_in(&text, 3), "9.88 of 1.23456 mm, inf");
        assert_eq!(rounded_in(&text, 6), "9.87654 of 1.23456 mm, inf");
        assert_eq!(rounded_in("plain", 3), "plain");
    }
}
