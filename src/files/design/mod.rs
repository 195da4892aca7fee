//! Reads and writes design files: a manipulator with its joint names, home pose, workspace and options, as TOML or
//! JSON.
//!
//! The module does no input or output: it maps text to a [`DesignModel`] or a list of [`Violation`]s, and back to text.
//! The format is described key by key in `docs/design-files.md`.

mod construction;
mod edit;
mod five_legs;
#[cfg(test)]
mod fixtures;
mod json_text;
mod keys;
mod likeness;
mod masses;
mod model;
mod outline;
#[cfg(test)]
mod requirements_tests;
mod scale;
mod snap;
pub mod spanned;
mod table;
#[cfg(test)]
mod tests;
mod toml_text;
mod tree;
mod violation;
mod workspace;

use construction::{Constructions, WrittenNumber};
pub use construction::{CrankLimits, DesignExactness, ExactJoint, Exactness};
pub use construction::{InvalidShare, Origin, Share, length_in};
pub use edit::{JointError, Written};
pub use five_legs::{FiveLegs, FiveLegsOrViolations};
pub use keys::SCHEMA;
pub use likeness::{likeness, nearest_word};
pub use masses::AssessedForces;
pub use model::{
    CalibratedNumber, CalibrationTable, Combination, Correlations, DesignModel, NameCount, OptimizeTable,
    SearchTable,
};
pub use outline::{
    HexapodSizes, InvalidOutline, InvalidServoSizes, ServoHexapod, ServoHome, ServoSizes, octahedral_toml,
    with_lengths,
};
pub use scale::{NotScaled, micrometres, unit_of_millimetres};
pub use snap::{FoundRelation, JointRelation, SnappedDesign};
pub use table::{
    DesignUnits, Drive, DriveTable, InvalidDriveTable, InvalidPointTable, InvalidRigSheet, InvalidSeries,
    InvalidSheet, PointTable, RigSheet, SeriesKind, SeriesRow, SheetDialect, SheetLegs, TimeSeries,
    read_poses, read_poses_with_lengths,
};
pub use violation::{Code, Violation, Warning};
pub use workspace::{Trajectory, Workspace};

use platform::geom::PoseConvention;

num::words! {
    /// The two notations of the same structure.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
    #[serde(rename_all = "snake_case")]
    pub enum Format as name, Display, FromStr("notation") {
        /// TOML 1.
        Toml = "toml",
        /// JSON as in RFC 8259: no comments, no trailing commas.
        Json = "json",
    }
}

impl Format {
    /// The format of a file name: `.json` in any case is JSON, everything else TOML.
    #[must_use]
    pub fn of_path(path: &std::path::Path) -> Self {
        match path.extension() {
            Some(ext) if ext.eq_ignore_ascii_case("json") => Self::Json,
            _ => Self::Toml,
        }
    }
}

/// Reads a design from text.
///
/// ```
/// # mod equipod { pub mod methods { pub use equipod_files::design; } }
/// use equipod::methods::design::{parse, Code, Format};
/// let violations = parse("name = 'x'\nunit = 'mm'\n", Format::Toml).unwrap_err();
/// assert_eq!(violations[0].code, Code::MissingKey);
/// let slip = violations.iter().find(|v| v.code == Code::UnknownKey).unwrap();
/// assert_eq!((slip.line, slip.help.contains("`units`")), (2, true));
/// ```
///
/// # Errors
/// All violations found, in the order of the text: a text with syntax errors is not examined further. Rods on cranks
/// are a violation ([`Code::Rotary`]), since results for legs of variable length do not apply; [`parse_with_cranks`]
/// reads such designs. Joint offsets are also a violation ([`Code::NotIdeal`]).
pub fn parse(text: &str, format: Format) -> Result<(DesignModel, Vec<Warning>), Vec<Violation>> {
    read(text, format, Accepts::Legs)
}

/// Reads a design from text, including rods on cranks (`drive = "rotary"`) and joint offsets. With offsets
/// ([`Hardware::is_coupled`](machine::requirements::Hardware::is_coupled)) the drive lengths differ from the distances
/// of the joints.
///
/// The base joints of such a design are the centres of its cranks. [`DesignModel::manipulator`] joins them to the
/// platform without the rods. [`DesignModel::rotary`] has the cranks and rods.
///
/// # Errors
/// All violations found.
pub fn parse_with_cranks(text: &str, format: Format) -> Result<(DesignModel, Vec<Warning>), Vec<Violation>> {
    read(text, format, Accepts::CranksAndOffsets)
}

/// Reads a design with ideal joints, whose legs are drives or rods on cranks.
///
/// # Errors
/// All violations found; joint offsets are one ([`Code::NotIdeal`]).
pub fn parse_ideal(text: &str, format: Format) -> Result<(DesignModel, Vec<Warning>), Vec<Violation>> {
    read(text, format, Accepts::Cranks)
}

/// The designs that a question takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Accepts {
    /// Legs of variable length with ideal joints, as [`parse`].
    Legs,
    /// Rods on cranks too, as [`parse_ideal`].
    Cranks,
    /// Rods on cranks and joint offsets too, as [`parse_with_cranks`].
    CranksAndOffsets,
}

/// A design by the number of its legs.
#[derive(Debug)]
pub enum SixOrFive<D> {
    /// Six legs.
    Six(Box<D>),
    /// Five legs.
    Five(Box<FiveLegs>),
}

/// Reads a design of six or of five legs.
///
/// # Errors
/// All violations found.
pub fn parse_six_or_five(
    text: &str,
    format: Format,
    accepts: Accepts,
) -> Result<(SixOrFive<DesignModel>, Vec<Warning>), Vec<Violation>> {
    let opened = OpenedText::of(text, format)?;
    if opened.lists_five_legs() {
        opened.five_legs().map(|(five, warnings)| (SixOrFive::Five(Box::new(five)), warnings))
    } else {
        opened.six_legs(accepts).map(|(six, warnings)| (SixOrFive::Six(Box::new(six)), warnings))
    }
}

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
    let opened = OpenedText::of(text, format).ok()?;
    opened.lists_five_legs().then(|| opened.five_legs())
}

/// Reads the keys of a `[frames]` table (TOML), for poses in another convention than that of the design.
///
/// # Errors
/// All violations found.
pub fn parse_frames(text: &str) -> Result<PoseConvention, Vec<Violation>> {
    let mut report = violation::Findings::new(text);
    let root = tree::read(text, Format::Toml, &mut report);
    let convention = root.map(|root| keys::frames(&root, &mut report));
    convention.filter(|_| report.is_clean()).ok_or_else(|| report.into_violations())
}

fn read(text: &str, format: Format, accepts: Accepts) -> Result<(DesignModel, Vec<Warning>), Vec<Violation>> {
    OpenedText::of(text, format)?.six_legs(accepts)
}

/// The tree of a text, with the findings so far.
struct OpenedText<'t> {
    format: Format,
    root: tree::Node,
    report: violation::Findings<'t>,
}

impl<'t> OpenedText<'t> {
    /// # Errors
    /// An empty text; the faults of its syntax.
    fn of(text: &'t str, format: Format) -> Result<Self, Vec<Violation>> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut report = violation::Findings::new(text);
        if text.trim().is_empty() {
            let help = "a design needs name, units, legs, [base] and [platform]; `designs/` has examples";
            report.refuse(Code::Empty, &(0..0), "the file is empty", help);
            return Err(report.into_violations());
        }
        match tree::read(text, format, &mut report) {
            Some(root) => Ok(Self { format, root, report }),
            None => Err(report.into_violations()),
        }
    }

    /// The design of six legs.
    fn six_legs(mut self, accepts: Accepts) -> Result<(DesignModel, Vec<Warning>), Vec<Violation>> {
        keys::give_new_names(&mut self.report, &mut self.root, keys::FILE);
        match keys::design(&self.root, &mut self.report, accepts) {
            Some(mut design) if self.report.is_clean() => {
                let text = self.report.text_with_new_names();
                let warnings = self.report.into_warnings();
                design.written = Written::new(&text, self.format, &warnings);
                Ok((design, warnings))
            }
            _ => Err(self.report.into_violations()),
        }
    }

    fn lists_five_legs(&self) -> bool {
        keys::has_five_legs(&self.root)
    }

    /// The design of five legs.
    fn five_legs(mut self) -> FiveLegsOrViolations {
        match keys::five_legs(&self.root, &mut self.report) {
            Some(design) if self.report.is_clean() => Ok((design, self.report.into_warnings())),
            _ => Err(self.report.into_violations()),
        }
    }
}
