//! What a design of real hardware is that comes with the program, as text.

use crate::design::parse_with_cranks;
use files::design::Format;

/// What a machine is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PresetClass {
    /// Small machines with drives from a catalogue.
    Bench,
    /// Moves a person or a cabin.
    #[serde(rename = "motion simulator")]
    MotionSimulator,
    /// Travels millimetres, steps by micrometres.
    #[serde(rename = "precision positioner")]
    PrecisionPositioner,
    /// Carries a spindle.
    #[serde(rename = "machine tool")]
    MachineTool,
    /// Moves a part of a robot.
    Robot,
}

impl PresetClass {
    /// Stable name, as in `equipod design presets`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Bench => "bench",
            Self::MotionSimulator => "motion simulator",
            Self::PrecisionPositioner => "precision positioner",
            Self::MachineTool => "machine tool",
            Self::Robot => "robot",
        }
    }
}

/// A design of real hardware: joints, limits, loads and workspace with their sources in the comments.
///
/// ```
/// use equipod::methods::design::{Format, PRESETS, parse};
/// let preset = PRESETS.iter().find(|p| p.name == "bench-l16").expect("a preset");
/// let (design, warnings) = parse(preset.text, Format::Toml).expect("presets are designs");
/// assert_eq!((design.hardware.max_leg_force, warnings.len()), (Some(46.0), 0)); // newtons
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Preset {
    /// Name of the file in `designs/presets`, without its extension.
    pub name: &'static str,
    /// What it is for.
    pub class: PresetClass,
    /// The design file, TOML with comments.
    pub text: &'static str,
}

impl Preset {
    /// Whether its legs are rods on cranks: such a preset is read by [`parse_with_cranks`] and refused by
    /// [`parse`](files::design::parse).
    #[must_use]
    pub fn has_cranks(&self) -> bool {
        parse_with_cranks(self.text, Format::Toml).is_ok_and(|(design, _)| design.has_cranks())
    }
}
