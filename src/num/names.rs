//! Names of choices, as written by people: a method, a format, a body.

use thiserror::Error;

/// Whether a character changes the direction of the text after it, by embedding, override or isolation. A program then
/// reads a text other than the displayed one (Boucher and Anderson 2021).
pub fn changes_direction(c: char) -> bool {
    matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// An unknown name.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("`{given}` is not the name of a {what}; known are {}", .known.join(", "))]
#[non_exhaustive]
pub struct UnknownName {
    /// The kind of thing to name: `"method"`.
    pub what: &'static str,
    /// The name given.
    pub given: String,
    /// The known names.
    pub known: Vec<&'static str>,
}

/// The choice of this name, ignoring case and surrounding blanks.
///
/// # Errors
/// A name outside the list, with the nearest known one.
pub fn named<T: Copy>(
    what: &'static str,
    given: &str,
    all: &[T],
    name: impl Fn(T) -> &'static str,
) -> Result<T, UnknownName> {
    let found = all.iter().copied().find(|x| name(*x).eq_ignore_ascii_case(given.trim()));
    found.ok_or_else(|| UnknownName {
        what,
        given: given.to_string(),
        known: all.iter().map(|x| name(*x)).collect(),
    })
}
