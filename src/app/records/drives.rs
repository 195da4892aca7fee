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
    /// Whether some drive fits: true and false are proved; null: undecided.
    pub met: Option<bool>,
    /// Name of the chosen drive: the cheapest that is proved to fit, the lightest of equally cheap ones; null: there is
    /// none.
    pub chosen: Option<String>,
    /// Drives, fitting ones first, then undecided and unfit ones; within each group by price, then mass.
    pub drives: Vec<DriveRecord>,
    /// Currency of prices; null: the table names none.
    pub currency: Option<String>,
    /// The unit of lengths; speeds are in this unit per second.
    pub length_unit: String,
    /// The unit of forces.
    pub force_unit: String,
    /// The unit of masses.
    pub mass_unit: String,
    /// Values assumed, one sentence each.
    pub assumptions: Vec<String>,
    /// The design with the chosen drive; null: none fits.
    pub design: Option<DesignRecord>,
    /// The file written.
    pub output: Option<String>,
}

view! {
    /// A drive of the table, in the units of the design.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct DriveRecord {
        /// The name of the drive.
        pub name: String = drive.name.clone(),
        /// Line of the table, from 1.
        pub line: usize = drive.line,
        /// Whether it fits: true and false are proved; null: undecided.
        pub fits: Option<bool> = fit.fits(),
        /// Whether all safety margins are kept too: true and false are proved; null: undecided.
        pub safety_margin_kept: Option<bool> = fit.keeps_safety_margin(),
        /// The travel, design units.
        pub stroke: Number = Number(drive.stroke),
        /// Least and greatest joint distance, design units.
        pub leg_length: [Number; 2] = [Number(least), Number(greatest)],
        /// Greatest force; null: not in the table.
        pub force: Option<Number> = drive.force.map(Number),
        /// Greatest speed; null: not in the table.
        pub speed: Option<Number> = drive.speed.map(Number),
        /// Mass; null: not in the table.
        pub mass: Option<Number> = drive.mass.map(Number),
        /// Stiffness along the drive; null: not in the table.
        pub stiffness: Option<Number> = drive.stiffness.map(Number),
        /// Price; null: not in the table.
        pub price: Option<Number> = drive.price.map(Number),
        /// Source of its numbers; null: not in the table.
        pub source: Option<String> = drive.source.clone(),
        /// Result of `assess`.
        pub assessment: AssessAnswer = AssessAnswer::new(design, &fit.assessed).without_assumptions(),
        /// Results along requested motions.
        pub motions: Vec<MotionRunRecord> =
            along.map(|(name, found)| MotionRunRecord::new(design, name.clone(), found)).collect(),
    }
    /// The record of a drive; `motions` are the names of the motions.
    pub fn new(fit: &DriveFit, motions: &[String]) {
        let (drive, design) = (&fit.drive, &fit.design);
        let (least, greatest) = drive.lengths.range();
        let along = motions.iter().zip(&fit.motions);
    }
}

view! {
    /// The lightest drive of the table with which the requirements of a design are met.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct LightestDriveRecord {
        /// The name of the drive; null: no drive is proved to suffice.
        pub name: Option<String> = found.drive.map(|d| d.name.clone()),
        /// Drive mass; null: the table has none, or no drive is proved to suffice.
        pub mass: Option<Number> = found.drive.and_then(|d| d.mass).map(Number),
        /// The unit of the mass.
        pub mass_unit: String = mass_unit.to_owned(),
        /// Undecided lighter drives; all undecided drives if none is proved to suffice.
        pub undecided: Vec<String> = undecided,
        /// Result in words.
        pub message: String = message,
    }
    /// The record of the lightest drive.
    pub fn new(found: &LightestDrive<'_>, mass_unit: &str) {
        let undecided: Vec<String> = found.undecided.iter().map(|d| d.name.clone()).collect();
        let message = match (found.drive, found.rest) {
            (_, Some(false)) => {
                "no drive of the table suffices: a requirement is violated that does not depend on the drive"
                    .to_owned()
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
    }
}
