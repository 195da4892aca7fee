//! STEP files (ISO 10303-21): legs and home out of an assembly, as `export --to step` and CAD programs write them.
//!
//! A leg is a cylinder whose axis passes through the centres of two spheres, one at either end. The parts of the assembly need no particular names.

mod assembly;
mod legs;
mod part21;
mod shape;
#[cfg(test)]
mod tests;

use nalgebra::{Quaternion, Rotation3, UnitQuaternion, Vector3};

use self::assembly::PartAssembly;
use self::legs::StepLegs;
use self::part21::{ExchangeFile, StepValue};
use super::placed::{FileUnit, PlacedLegs, number_between};
use super::points::PointTable;
use crate::design::unit_of_millimetres;
use crate::geom::Pose;

/// Centres and axes nearer to each other than this times the size are the same: CAD programs are exact to some 1e-7.
const SAME: f64 = 1e-6;

/// Whether a text is an exchange file.
pub(super) fn is_step(text: &str) -> bool {
    text.trim_start_matches('\u{feff}').trim_start().starts_with("ISO-10303-21")
}

/// Reads an assembly.
///
/// # Errors
/// A sentence: broken grammar, placements that are not read, no six legs, bodies that cannot be told apart.
pub(super) fn read(text: &str) -> Result<PointTable, String> {
    let file = ExchangeFile::read(text)?;
    let header = header(&file);
    let own = Own::of(&header);
    let assembly = PartAssembly::of(&file)?;
    let found = StepLegs::of(&assembly, own.home)?;
    let mut guesses = vec![
        "A STEP file: legs are cylinders whose axes pass through the centres of two spheres.".to_string(),
    ];
    guesses.extend(found.guesses);
    let written = own.unit.and_then(unit_of_millimetres);
    let unit = if let Some((label, millimetres)) = written {
        guesses.push(format!(
            "The lengths are converted to {label}, the unit of the design that the header names."
        ));
        FileUnit { label, per: millimetres }
    } else {
        match assembly.unit.map(unit_of_millimetres) {
            Some(Some((label, millimetres))) => {
                guesses.push(format!("The lengths are in {label}, as the file says."));
                FileUnit { label, per: millimetres }
            }
            Some(None) => {
                guesses.push("The lengths are converted to mm from a unit that designs do not have.".into());
                FileUnit { label: "mm", per: 1.0 }
            }
            None => {
                guesses.push("The file names no unit of length: mm is taken.".into());
                FileUnit { label: "mm", per: 1.0 }
            }
        }
    };
    let placed = PlacedLegs { ends: found.ends, home: found.home, tolerance: SAME };
    let table =
        placed.table(&unit, guesses).ok_or_else(|| "the coordinates of the joints overflow".to_string())?;
    Ok(match found.names {
        Some(names) if own.unit.is_some() => table.named(&names),
        _ => table,
    })
}

/// The lines of the description in the header.
fn header(file: &ExchangeFile) -> Vec<&str> {
    let description = file.header.iter().find(|r| r.name == "FILE_DESCRIPTION");
    let lines = description.and_then(|r| r.values.first()).map_or(&[][..], StepValue::list);
    lines.iter().filter_map(StepValue::text).collect()
}

/// What this program's own exports say in their header.
struct Own {
    /// Millimetres of a unit of the design.
    unit: Option<f64>,
    /// The platform frame at home, millimetres.
    home: Option<Pose>,
}

impl Own {
    fn of(header: &[&str]) -> Self {
        let unit =
            header.iter().find_map(|l| number_between(l, "Lengths in mm; one unit of the design is ", " mm"));
        let home = header.iter().find_map(|line| {
            let numbers = line.strip_prefix("Platform frame at home: ")?.split_whitespace().map(str::parse);
            let numbers: Vec<f64> = numbers.collect::<Result<_, _>>().ok()?;
            let [x, y, z, qw, qx, qy, qz] = numbers[..] else { return None };
            let turn = UnitQuaternion::try_new(Quaternion::new(qw, qx, qy, qz), 0.0)?;
            let rotation: Rotation3<f64> = turn.to_rotation_matrix();
            Some(Pose { rotation, position: Vector3::new(x, y, z) })
        });
        Self { unit, home: unit.and(home) }
    }
}
