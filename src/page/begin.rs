//! Designs to begin with, for those who have no file: from the numbers of a data sheet, and the presets.

use std::borrow::Cow;
use std::fmt::Display;

use serde::{Deserialize, Serialize};

use super::request::Refusal;
use super::session::{InvalidStart, Session};
use crate::design::{Format, PRESETS, PointTable, Violation, parse};

/// A hexapod as makers describe it: pairs of joints on two circles, those of the platform half a turn of the threefold symmetry away from those of the base.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub(super) struct DataSheet {
    /// Of the circle through the base joints, design units.
    base_radius: f64,
    /// Of the circle through the platform joints, design units.
    platform_radius: f64,
    /// Between the two joints of a pair of the base, seen from the centre.
    base_spread_deg: f64,
    /// Between the two joints of a pair of the platform, seen from the centre.
    platform_spread_deg: f64,
    /// Of the platform joints over the base joints at home, design units.
    height: f64,
    /// Name of the length unit.
    units: Cow<'static, str>,
}

/// The hexapod of the page without a design.
const FIRST: DataSheet = DataSheet {
    base_radius: 500.0,
    platform_radius: 300.0,
    base_spread_deg: 20.0,
    platform_spread_deg: 20.0,
    height: 400.0,
    units: Cow::Borrowed("mm"),
};

/// A design file that was made.
#[derive(Debug, Serialize)]
pub(super) struct MadeRecord {
    toml: String,
    /// What was taken for granted, a sentence each.
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
    PRESETS.iter().map(|p| PresetChoice { name: p.name, class: p.class.as_str() }).collect()
}

/// The file of a preset.
pub(super) fn preset(name: &str) -> Result<MadeRecord, Refusal> {
    let found = PRESETS.iter().find(|p| p.name == name);
    let found = found.ok_or_else(|| Refusal::new("preset", format!("there is no preset `{name}`")))?;
    Ok(MadeRecord { toml: found.text.into(), guesses: Vec::new() })
}

/// The design with the joints of a table, in whatever notation ([`PointTable`]); `units` where the table names none.
pub(super) fn points(text: &str, units: &str) -> Result<MadeRecord, Refusal> {
    let refused = |e: &dyn Display| Refusal::new("points", e);
    let mut table = PointTable::read(text.as_bytes()).map_err(|e| refused(&e))?;
    let units = table.units.clone().unwrap_or_else(|| units.into());
    let design = table.design("hexapod", &units).map_err(|e| refused(&e))?;
    Ok(MadeRecord { toml: design.to_toml(), guesses: table.guesses })
}

impl DataSheet {
    /// The design as a file with constructions, so that its symmetry is exact: pairs of the base at 0, 120 and 240 degrees, those of the platform at 60, 180 and 300,
    /// each leg to the nearer joint. A spread of 0 makes the joints of a pair one.
    pub(super) fn made(&self) -> Result<MadeRecord, Refusal> {
        for (name, spread) in
            [("base spread", self.base_spread_deg), ("platform spread", self.platform_spread_deg)]
        {
            if !(0.0..120.0).contains(&spread) {
                return Err(Refusal::new(
                    "spread",
                    format!("the {name} is an angle from 0 to below 120 degrees"),
                ));
            }
        }
        let base = Circle { letter: 'A', radius: "base_radius", pair: 0, spread: self.base_spread_deg };
        let platform =
            Circle { letter: 'B', radius: "platform_radius", pair: 60, spread: self.platform_spread_deg };
        let legs: Vec<String> =
            (0..6).map(|k| format!("[\"{}\", \"{}\"]", base.of_leg(k), platform.of_leg(k))).collect();
        // a text in JSON is a text in TOML
        let units = serde_json::to_string(&self.units).map_err(|e| Refusal::new("units", e))?;
        let toml = format!(
            "name = \"hexapod\"\nunits = {units}\nlegs = [{}]\n\n[parameters]\nbase_radius = {}\nplatform_radius = {}\n\n[base]\n{}\n[platform]\n{}\n[home]\nposition = [0.0, 0.0, {:?}]\nrpy_deg = [0.0, 0.0, 0.0]\n",
            legs.join(", "),
            self.base_radius,
            self.platform_radius,
            base.joints(),
            platform.joints(),
            self.height
        );
        parse(&toml, Format::Toml).map_err(|violations| Refusal::new("design", sentences(&violations)))?;
        Ok(MadeRecord { toml, guesses: Vec::new() })
    }
}

fn sentences(violations: &[Violation]) -> String {
    violations.iter().map(|v| v.message.as_str()).collect::<Vec<_>>().join("; ")
}

/// The joints of a body on a circle.
struct Circle {
    letter: char,
    radius: &'static str,
    /// Where the middle of the first pair is seen from the centre; the base has it between legs 1 and 2, the platform between 2 and 3, degrees.
    pair: u16,
    spread: f64,
}

impl Circle {
    /// The joint of a leg.
    fn of_leg(&self, leg: usize) -> String {
        let first = usize::from(self.pair > 0);
        let number = if self.spread > 0.0 { leg } else { (leg + 6 - first) % 6 / 2 };
        format!("{}{}", self.letter, number + 1)
    }

    fn joints(&self) -> String {
        let polar = |name: &str, angle: String| {
            format!("{name} = {{ radius = \"{}\", angle_deg = \"{angle}\" }}\n", self.radius)
        };
        let half = self.spread / 2.0;
        let mut out = String::new();
        let first: Vec<usize> = if self.spread > 0.0 {
            // the joint of leg 2, and its mirror image, that of leg 1
            let second = self.of_leg(1);
            let angle = if self.pair > 0 { format!("{} - {half}", self.pair) } else { half.to_string() };
            out += &polar(&second, angle);
            out += &format!("{} = {{ mirror = \"{second}\", plane = \"xz\" }}\n", self.of_leg(0));
            vec![0, 1]
        } else {
            out += &polar(&self.of_leg(1), self.pair.to_string());
            vec![1]
        };
        for turn in 1..3 {
            for leg in &first {
                let (from, to) = (self.of_leg(*leg), self.of_leg(leg + 2 * turn));
                out += &format!("{to} = {{ turn = \"{from}\", deg = {} }}\n", 120 * turn);
            }
        }
        out
    }
}

impl Session {
    /// The session of the page that is written without a design: an ordinary hexapod, to be replaced by one's own.
    ///
    /// # Errors
    /// [`InvalidStart::Design`] when that hexapod is no design.
    pub fn without_design() -> Result<Self, InvalidStart> {
        let made = FIRST.made().map_err(|refusal| InvalidStart::Design(refusal.to_string()))?;
        let (design, _) = parse(&made.toml, Format::Toml)
            .map_err(|violations| InvalidStart::Design(sentences(&violations)))?;
        Ok(Self { without_design: true, ..Self::new(design) })
    }
}
