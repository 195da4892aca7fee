//! Starting designs for users without a file: from the numbers of a data sheet, from twelve points, and the presets.

use std::fmt::Display;

use serde::{Deserialize, Serialize};

use super::request::Refusal;
use super::session::{InvalidStart, Session};
use crate::app::presets::PRESETS;
use ask::Design;
use ask::design::parse;
use files::design::{Format, HexapodSizes, PointTable, Violation};

/// A hexapod in the terms of makers: pairs of joints on two circles.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub(super) struct DataSheet {
    /// Radius of the circle through the base joints, design units.
    base_radius: f64,
    /// Radius of the circle through the platform joints, design units.
    platform_radius: f64,
    /// Angle between the two joints of a base pair, seen from the centre, degrees.
    base_spread_deg: f64,
    /// Angle between the two joints of a platform pair, seen from the centre, degrees.
    platform_spread_deg: f64,
    /// Height of the platform joints above the base joints at home, design units.
    height: f64,
    /// Name of the length unit.
    units: String,
}

/// The hexapod of the page without a design, millimetres.
const FIRST: HexapodSizes = HexapodSizes { radius: [500.0, 300.0], spread_deg: [20.0, 20.0], height: 400.0 };
/// The name of a new design.
const NAME: &str = "hexapod";

/// A new design file.
#[derive(Debug, Serialize)]
pub(super) struct MadeRecord {
    toml: String,
    /// Assumptions made, one sentence each.
    guesses: Vec<String>,
}

/// A preset to choose.
#[derive(Debug, Serialize)]
pub(super) struct PresetChoice {
    name: &'static str,
    class: &'static str,
}

/// The presets.
pub(super) fn presets() -> Vec<PresetChoice> {
    PRESETS.iter().map(|p| PresetChoice { name: p.name, class: p.class.name() }).collect()
}

/// The file of a preset.
pub(super) fn preset(name: &str) -> Result<MadeRecord, Refusal> {
    let found = PRESETS.iter().find(|p| p.name == name);
    let found = found.ok_or_else(|| Refusal::new("preset", format!("there is no preset `{name}`")))?;
    Ok(MadeRecord { toml: found.text.into(), guesses: Vec::new() })
}

/// The design with the joints of a table in any notation ([`PointTable`]); `units` applies if the table names none.
pub(super) fn points(text: &str, units: &str) -> Result<MadeRecord, Refusal> {
    let refused = |e: &dyn Display| Refusal::new("points", e);
    let mut table = PointTable::read(text.as_bytes()).map_err(|e| refused(&e))?;
    let units = table.units.clone().unwrap_or_else(|| units.into());
    let design = table.design(NAME, &units).map_err(|e| refused(&e))?;
    Ok(MadeRecord { toml: design.to_toml(), guesses: table.guesses })
}

/// The design with the symmetry of its joints as constructions.
pub(super) fn snapped(design: &Design) -> Result<MadeRecord, Refusal> {
    let snapped = design
        .snapped()
        .ok_or_else(|| Refusal::new("symmetry", "no further symmetry of the joints was found"))?;
    let guesses = snapped.sentences(&design.units);
    Ok(MadeRecord { toml: snapped.design.to_toml(), guesses })
}

impl DataSheet {
    /// The design as a file with constructions, so that its symmetry is exact ([`HexapodSizes`]).
    pub(super) fn made(&self) -> Result<MadeRecord, Refusal> {
        let sizes = HexapodSizes {
            radius: [self.base_radius, self.platform_radius],
            spread_deg: [self.base_spread_deg, self.platform_spread_deg],
            height: self.height,
        };
        sizes.check().map_err(|e| Refusal::new("sizes", e))?;
        let toml = sizes.to_toml(NAME, &self.units);
        let (design, _) =
            parse(&toml, Format::Toml).map_err(|violations| Refusal::new("sizes", sentences(&violations)))?;
        Ok(MadeRecord { toml, guesses: design.told_of_sizes(&sizes) })
    }
}

fn sentences(violations: &[Violation]) -> String {
    violations.iter().map(|v| v.message.as_str()).collect::<Vec<_>>().join("; ")
}

impl Session {
    /// The session of a page without a design: a typical hexapod, which the user replaces.
    ///
    /// # Errors
    /// [`InvalidStart::Design`] if this hexapod is no design.
    pub fn without_design() -> Result<Self, InvalidStart> {
        let (design, _) = parse(&FIRST.to_toml(NAME, "mm"), Format::Toml)
            .map_err(|violations| InvalidStart::Design(sentences(&violations)))?;
        Ok(Self { without_design: true, ..Self::new(design) })
    }
}
