//! Names of choices: what a person writes for a method, a format, a body.

use thiserror::Error;

/// Whether a character changes the direction of the text after it: embeddings, overrides and isolates. A program then
/// reads another text than the one shown (Boucher and Anderson 2021).
pub fn changes_direction(c: char) -> bool {
    matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// A name that is none of those known.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("`{given}` is not the name of a {what}; known are {}", .known.join(", "))]
#[non_exhaustive]
pub struct UnknownName {
    /// What was to be named: `"method"`.
    pub what: &'static str,
    /// The name given.
    pub given: String,
    /// The names there are.
    pub known: Vec<&'static str>,
}

/// The choice of this name, upper and lower case and blanks around it apart.
///
/// # Errors
/// A name that is none of the list, with the one that it is nearest to.
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
