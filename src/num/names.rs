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

/// Gives the choices of an enum the words that people write for them, each beside its choice.
///
/// `Name as function` has the word of a choice as `function` and every choice in order as `ALL`.
/// After `as function | other` each choice has two words. A comma adds:
/// * `Display`: by the word.
/// * `FromStr("what")`: the choice of a word by [`named`].
///
/// # Examples
/// ```
/// equipod_num::words! {
///     /// A side of a plane.
///     #[derive(Debug, Clone, Copy, PartialEq)]
///     pub enum Side as name, Display, FromStr("side") {
///         /// Above it.
///         Above = "above",
///         /// Below it.
///         Below = "below",
///     }
/// }
/// assert_eq!(Side::ALL.map(Side::name), ["above", "below"]);
/// assert_eq!("Above".parse(), Ok(Side::Above));
/// ```
#[macro_export]
macro_rules! words {
    (
        $(#[$meta:meta])*
        $visibility:vis enum $name:ident as $function:ident | $other:ident $(, $made:ident $(($what:literal))?)* {
            $($(#[$about:meta])* $variant:ident = $word:tt | $label:tt),+ $(,)?
        }
    ) => {
        $crate::words! {
            $(#[$meta])*
            $visibility enum $name as $function $(, $made $(($what))?)* {
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
    (
        $(#[$meta:meta])*
        $visibility:vis enum $name:ident as $function:ident $(, $made:ident $(($what:literal))?)* {
            $($(#[$about:meta])* $variant:ident = $word:tt),+ $(,)?
        }
    ) => {
        $(#[$meta])*
        $visibility enum $name {
            $($(#[$about])* $variant),+
        }

        impl $name {
            /// Every choice, in order.
            $visibility const ALL: [Self; [$($word),+].len()] = [$(Self::$variant),+];

            /// The word of the choice, as files and answers write it.
            #[must_use]
            $visibility fn $function(self) -> &'static str {
                match self {
                    $(Self::$variant => $word),+
                }
            }
        }

        $($crate::words!(@$made $(($what))? $name $function);)*
    };
    (@Display $name:ident $function:ident) => {
        $crate::displayed!($name by $function);
    };
    (@FromStr($what:literal) $name:ident $function:ident) => {
        impl std::str::FromStr for $name {
            type Err = $crate::names::UnknownName;

            fn from_str(text: &str) -> Result<Self, $crate::names::UnknownName> {
                $crate::names::named($what, text, &Self::ALL, Self::$function)
            }
        }
    };
}

/// Writes methods that set one field of a value and return it, such as the options of a question.
///
/// The field has the name of its method, or the name that stands before `=`.
///
/// # Examples
/// ```
/// #[derive(Debug, Default)]
/// struct Options {
///     seed: u64,
///     gap: Option<f64>,
/// }
/// impl Options {
///     equipod_num::setters! {
///         /// The seed of the random numbers.
///         fn seed(seed: u64) = seed;
///         /// The gap at which the search ends.
///         fn gap(gap: f64) = Some(gap);
///     }
/// }
/// assert_eq!(Options::default().seed(3).gap(0.1).gap, Some(0.1));
/// ```
#[macro_export]
macro_rules! setters {
    ($($(#[$about:meta])* fn $set:ident($given:ident: $kind:ty) $($($field:ident).+)? = $value:expr;)+) => {$(
        $(#[$about])*
        #[must_use]
        pub fn $set(mut self, $given: $kind) -> Self {
            $crate::setters!(@field self $set $($($field).+)?) = $value;
            self
        }
    )+};
    (@field $options:ident $set:ident) => { $options.$set };
    (@field $options:ident $set:ident $($field:ident).+) => { $options.$($field).+ };
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
        $visibility:vis enum $name:ident as $function:ident $(| $other:ident)? $(, $made:ident $(($what:literal))?)* {
            $($(#[$about:meta])* $variant:ident = $word:tt $(| $label:tt)?),+ $(,)?
        }
    ) => {
        $crate::words! {
            #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema))]
            $(#[$meta])*
            $visibility enum $name as $function $(| $other)? $(, $made $(($what))?)* {
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
