//! Answers about the drives of a table.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{AssessAnswer, DesignRecord, MotionRunRecord, Number};
use ask::driving::{DriveFit, LightestDrive};

/// The answer of `build drives`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DrivesAnswer {
    /// The name of the design.
    pub name: String,
    /// True: a drive is proved to fit; false: every drive is proved not to; null: neither.
    pub met: Option<bool>,
    /// The name of the drive to take: the cheapest that is proved to fit, the lightest of equally cheap ones; null:
    /// there is none.
    pub chosen: Option<String>,
    /// All drives: those that fit, those that are undecided, those that do not; each by price, then mass.
    pub drives: Vec<DriveRecord>,
    /// Of prices, as the table names it; null: it does not.
    pub currency: Option<String>,
    /// Of lengths; speeds are in it per second.
    pub length_unit: String,
    /// Of forces.
    pub force_unit: String,
    /// Of masses.
    pub mass_unit: String,
    /// What neither the file nor the table says and was taken instead, a sentence each.
    pub assumptions: Vec<String>,
    /// The design with the chosen drive; null: none fits.
    pub design: Option<DesignRecord>,
    /// The file written.
    pub output: Option<String>,
}

/// A drive of the table, in the units of the design.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DriveRecord {
    /// Its name.
    pub name: String,
    /// Line of the table, from 1.
    pub line: usize,
    /// It is proved to fit, proved not to, or neither (null).
    pub fits: Option<bool>,
    /// The reserve on every limit is kept too, likewise.
    pub reserve_kept: Option<bool>,
    /// The travel.
    pub stroke: Number,
    /// Least and greatest length from joint centre to joint centre.
    pub leg_length: [Number; 2],
    /// Greatest force; null: the table does not say it.
    pub force: Option<Number>,
    /// Greatest speed; null: the table does not say it.
    pub speed: Option<Number>,
    /// Mass; null: the table does not say it.
    pub mass: Option<Number>,
    /// Stiffness along the drive; null: the table does not say it.
    pub stiffness: Option<Number>,
    /// Price; null: the table does not say it.
    pub price: Option<Number>,
    /// Where the numbers are from; null: the table does not say it.
    pub source: Option<String>,
    /// What `assess` says of the design with the drive.
    pub assessment: AssessAnswer,
    /// Along the motions asked for.
    pub motions: Vec<MotionRunRecord>,
}

impl DriveRecord {
    /// What was found of a drive; `motions` are the names of the motions.
    #[must_use]
    pub fn new(fit: &DriveFit, motions: &[String]) -> Self {
        let (drive, design) = (&fit.drive, &fit.design);
        let (least, greatest) = drive.lengths.range();
        let along = motions.iter().zip(&fit.motions);
        Self {
            name: drive.name.clone(),
            line: drive.line,
            fits: fit.fits(),
            reserve_kept: fit.keeps_reserve(),
            stroke: Number(drive.stroke),
            leg_length: [Number(least), Number(greatest)],
            force: drive.force.map(Number),
            speed: drive.speed.map(Number),
            mass: drive.mass.map(Number),
            stiffness: drive.stiffness.map(Number),
            price: drive.price.map(Number),
            source: drive.source.clone(),
            assessment: AssessAnswer::new(design, &fit.assessed).without_assumptions(),
            motions: along.map(|(name, found)| MotionRunRecord::new(design, name.clone(), found)).collect(),
        }
    }
}

/// The lightest drive of the table that a design names with which its requirements are met.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LightestDriveRecord {
    /// Its name; null: none is proved to suffice.
    pub name: Option<String>,
    /// Its mass; null: the table has none, or there is no such drive.
    pub mass: Option<Number>,
    /// Of the mass.
    pub mass_unit: String,
    /// Drives that are lighter, or all where none is proved to suffice, of which neither is proved.
    pub undecided: Vec<String>,
    /// One sentence.
    pub message: String,
}

impl LightestDriveRecord {
    /// What was found.
    #[must_use]
    pub fn new(found: &LightestDrive<'_>, mass_unit: &str) -> Self {
        let undecided: Vec<String> = found.undecided.iter().map(|d| d.name.clone()).collect();
        let message = match (found.drive, found.rest) {
            (_, Some(false)) => {
                "no drive of the table suffices: a requirement that no drive changes is violated".to_owned()
            }
            (Some(d), _) => match d.mass {
                Some(mass) => format!(
                    "the lightest drive of the table that suffices is {} with {mass} {mass_unit}",
                    d.name
                ),
                None => format!("the first drive of the table that suffices is {}; it has no mass", d.name),
            },
            (None, _) if undecided.is_empty() => "no drive of the table suffices".to_owned(),
            (None, _) => "no drive of the table is proved to suffice".to_owned(),
        };
        Self {
            name: found.drive.map(|d| d.name.clone()),
            mass: found.drive.and_then(|d| d.mass).map(Number),
            mass_unit: mass_unit.to_owned(),
            undecided,
            message,
        }
    }
}
