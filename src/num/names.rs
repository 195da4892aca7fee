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

/// An enumeration of words: each variant stands beside its word in files and answers.
///
/// `pub enum Name as function { Variant = "word", .. }` defines the enumeration, `ALL` with the variants in this order,
/// and `function`, which gives the word. After `as function | other` each variant has two words.
#[macro_export]
macro_rules! words {
    (
        $(#[$meta:meta])*
        $visibility:vis enum $name:ident as $function:ident {
            $($(#[$about:meta])* $variant:ident = $word:tt),+ $(,)?
        }
    ) => {
        $(#[$meta])*
        $visibility enum $name {
            $($(#[$about])* $variant),+
        }

        impl $name {
            /// All of them, in the order of their definition.
            pub const ALL: [Self; [$(stringify!($variant)),+].len()] = [$(Self::$variant),+];

            /// The word in files and answers.
            #[must_use]
            pub fn $function(self) -> &'static str {
                match self {
                    $(Self::$variant => $word),+
                }
            }
        }
    };
    (
        $(#[$meta:meta])*
        $visibility:vis enum $name:ident as $function:ident | $other:ident {
            $($(#[$about:meta])* $variant:ident = $word:tt | $label:tt),+ $(,)?
        }
    ) => {
        $crate::words! {
            $(#[$meta])*
            $visibility enum $name as $function {
                $($(#[$about])* $variant = $word),+
            }
        }

        impl $name {
            /// The words for people.
            #[must_use]
            pub fn $other(self) -> &'static str {
                match self {
                    $(Self::$variant => $label),+
                }
            }
        }
    };
}

/// `Display` by a function that gives the words.
#[macro_export]
macro_rules! displayed {
    ($kind:ident by $words:ident) => {
        impl std::fmt::Display for $kind {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(self.$words())
            }
        }
    };
}

/// [`words!`] that answers have too, with the feature `serde`. After `of Other` they are the words of the variants of
/// another enumeration, which gets the function `word`.
#[macro_export]
macro_rules! answer_words {
    (
        $(#[$meta:meta])*
        $visibility:vis enum $name:ident as $function:ident $(| $other:ident)? {
            $($(#[$about:meta])* $variant:ident = $word:tt $(| $label:tt)?),+ $(,)?
        }
    ) => {
        $crate::words! {
            #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema))]
            $(#[$meta])*
            $visibility enum $name as $function $(| $other)? {
                $($(#[$about])* #[cfg_attr(feature = "serde", serde(rename = $word))] $variant = $word $(| $label)?),+
            }
        }
    };
    (
        $(#[$meta:meta])*
        $visibility:vis enum $name:ident as $function:ident of $source:ident {
            $($(#[$about:meta])* $variant:ident = $word:tt),+ $(,)?
        }
    ) => {
        $crate::answer_words! {
            $(#[$meta])*
            #[derive(Debug, Clone, Copy, PartialEq, Eq)]
            $visibility enum $name as $function {
                $($(#[$about])* $variant = $word),+
            }
        }

        impl $source {
            /// Its word in answers.
            #[must_use]
            pub fn word(&self) -> $name {
                match self {
                    $(Self::$variant { .. } => $name::$variant),+
                }
            }
        }
    };
}
