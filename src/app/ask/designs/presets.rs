//! The designs of real hardware that come with the program, as text.

use crate::design::parse_with_cranks;
use files::design::Format;

num::words! {
    /// The purpose of a machine.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
    #[serde(rename_all = "snake_case")]
    pub enum PresetClass as name {
        /// Small machines with drives from a catalogue.
        Bench = "bench",
        /// Machines that move a person or a cabin.
        #[serde(rename = "motion simulator")]
        MotionSimulator = "motion simulator",
        /// Machines with a travel of millimetres and micrometre steps.
        #[serde(rename = "precision positioner")]
        PrecisionPositioner = "precision positioner",
        /// Machines that carry a spindle.
        #[serde(rename = "machine tool")]
        MachineTool = "machine tool",
        /// Machines that move a part of a robot.
        Robot = "robot",
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
    /// The purpose of the machine.
    pub class: PresetClass,
    /// The design file, TOML with comments.
    pub text: &'static str,
}

impl Preset {
    /// Whether its legs are rods on cranks. Such a preset is read by [`parse_with_cranks`];
    /// [`parse`](files::design::parse) refuses it.
    #[must_use]
    pub fn has_cranks(&self) -> bool {
        parse_with_cranks(self.text, Format::Toml).is_ok_and(|(design, _)| design.has_cranks())
    }
}
