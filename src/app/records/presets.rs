//! Answers of `design presets`.

use schemars::JsonSchema;
use serde::Serialize;

use ask::Design;
use ask::presets::{Preset, PresetClass};

/// The answer of `design presets`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum PresetsAnswer {
    /// All presets.
    List {
        /// The presets by class and name.
        presets: Vec<PresetRecord>,
    },
    /// One preset.
    One(PresetAnswer),
}

/// One preset, with its design file or the path of that file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct PresetAnswer {
    /// The preset.
    #[serde(flatten)]
    pub preset: PresetRecord,
    /// The design file of the preset.
    #[serde(flatten)]
    pub file: PresetFile,
}

/// The design file of a preset.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum PresetFile {
    /// File in the answer.
    Given {
        /// The design file.
        text: String,
    },
    /// The file was written.
    Written {
        /// The file written.
        output: String,
    },
}

view! {
    /// A design of real hardware.
    #[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
    pub struct PresetRecord {
        /// Preset.
        pub preset: String = preset.name.into(),
        /// Purpose.
        pub class: PresetClass = preset.class,
        /// The name of the design.
        pub name: String = design.name.clone(),
        /// Unit of lengths.
        pub units: String = design.units.clone(),
        /// Source of its numbers.
        pub source: Option<String> = design.source.clone(),
        /// Description in the design file.
        pub description: Option<String> = design.description.clone(),
    }
    /// The record of a preset with its design.
    pub fn new(preset: &Preset, design: &Design) {}
}
