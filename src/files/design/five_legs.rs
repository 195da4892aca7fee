//! A design of five legs.

use super::violation::Findings;
use super::{Format, Violation, Warning, keys, tree};
use platform::pentapod::Pentapod;

/// The contents of a design file with five legs.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct FiveLegs {
    /// The name.
    pub name: String,
    /// The label of the length unit.
    pub units: String,
    /// The source of the numbers.
    pub source: Option<String>,
    /// Free text.
    pub description: Option<String>,
    /// Leg lengths in leg order.
    pub lengths: Option<[f64; 5]>,
    /// The ends of the legs.
    pub pentapod: Pentapod,
    /// The base joint and the platform joint of each leg.
    pub leg_names: [[String; 2]; 5],
    /// Whether a joint is not a fraction and was rounded to its nearest doubles.
    pub rounded: bool,
}

/// A design of five legs with its warnings, or all violations of its text.
pub type FiveLegsOrViolations = Result<(FiveLegs, Vec<Warning>), Vec<Violation>>;

/// Reads a design of five legs; `None` if the text lists another number of legs or cannot be read.
///
/// ```
/// # mod equipod { pub mod methods { pub use equipod_files::design; } }
/// use equipod::methods::design::{Format, parse_five_legs};
/// let text = r#"{ "name": "five", "units": "m", "legs": [["A", "a"], ["B", "b"], ["C", "c"], ["D", "d"], ["E", "e"]],
///   "base": { "A": [0, 0, 0], "B": [4, 0, 0], "C": [6, 3, 0], "D": [3, 6, 0], "E": [-1, 5, 0] },
///   "platform": { "a": [0, 0, 0], "b": [1, 0, 0], "c": [3, 0, 0], "d": [4, 0, 0], "e": [6, 0, 0] } }"#;
/// let (five, _) = parse_five_legs(text, Format::Json).ok_or("other legs")?.map_err(|why| why[0].to_string())?;
/// assert!(five.pentapod.linear().is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn parse_five_legs(text: &str, format: Format) -> Option<FiveLegsOrViolations> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut report = Findings::new(text);
    let root = tree::read(text, format, &mut report)?;
    keys::has_five_legs(&root).then(|| match keys::five_legs(&root, &mut report) {
        Some(design) if report.is_clean() => Ok((design, report.into_warnings())),
        _ => Err(report.into_violations()),
    })
}
