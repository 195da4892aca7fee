//! The two bodies at the ends of the legs.

use std::str::FromStr;

use thiserror::Error;

/// One of the two bodies.
///
/// ```
/// # mod equipod { pub mod methods { pub use equipod_platform::{geom, manipulator, topology}; } pub mod prelude { pub use equipod_platform::geom::*; } }
/// use equipod::methods::manipulator::Body;
/// assert_eq!("base".parse(), Ok(Body::Base));
/// assert_eq!(Body::Base.other().to_string(), "platform");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum Body {
    /// The fixed body.
    Base,
    /// The moving body.
    Platform,
}

/// A word that names neither body.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("`{0}` is not a body: base or platform")]
pub struct NoSuchBody(pub String);

impl Body {
    /// The base, then the platform: the order of every pair of values of the bodies.
    pub const BOTH: [Self; 2] = [Self::Base, Self::Platform];

    /// The body at the other end of a leg.
    #[must_use]
    pub fn other(self) -> Self {
        self.of((Self::Platform, Self::Base))
    }

    /// The value of this body, from a pair for the base and for the platform.
    #[must_use]
    pub fn of<T>(self, (base, platform): (T, T)) -> T {
        match self {
            Self::Base => base,
            Self::Platform => platform,
        }
    }

    /// 0 for the base, 1 for the platform: the place of this body in [`Body::BOTH`].
    #[must_use]
    pub fn index(self) -> usize {
        self.of((0, 1))
    }

    /// `base` or `platform`, as in files and answers.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.of(("base", "platform"))
    }
}

num::displayed!(Body by name);

impl FromStr for Body {
    type Err = NoSuchBody;

    fn from_str(word: &str) -> Result<Self, NoSuchBody> {
        Self::BOTH.into_iter().find(|b| b.name() == word).ok_or_else(|| NoSuchBody(word.into()))
    }
}
