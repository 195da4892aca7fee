//! The user's tables of linear drives: one drive per line, with its price and its limits.

use thiserror::Error;

use super::sheet::{CellTable, InvalidSheet, SheetRow};
use crate::design::{micrometres, nearest_word};
use machine::requirements::{ForceUnit, LengthLimits, MassUnit};

/// A linear drive, in the units of a design.
#[derive(Debug, Clone, PartialEq)]
pub struct Drive {
    /// Line in the table, from 1.
    pub line: usize,
    /// Its name; its number in the table if there is no column of names.
    pub name: String,
    /// Travel.
    pub stroke: f64,
    /// From joint centre to joint centre.
    pub lengths: LengthLimits,
    /// Greatest force, push or pull.
    pub force: Option<f64>,
    /// Greatest speed.
    pub speed: Option<f64>,
    /// Mass of the whole drive.
    pub mass: Option<f64>,
    /// Stiffness along its line.
    pub stiffness: Option<f64>,
    /// Price in the currency of the table.
    pub price: Option<f64>,
    /// The source of the numbers.
    pub source: Option<String>,
}

/// A table of drives.
#[derive(Debug, Clone, PartialEq)]
pub struct DriveTable {
    /// The drives, in the order of the table.
    pub drives: Vec<Drive>,
    /// The currency, from the header after `price`.
    pub currency: Option<String>,
    /// Guesses about the table and unused columns, one sentence each.
    pub guesses: Vec<String>,
}

/// The units of a design.
#[derive(Debug, Clone, Copy)]
pub struct DesignUnits<'a> {
    /// The label of its lengths.
    pub length: &'a str,
    /// The unit of its forces.
    pub force: ForceUnit,
    /// The unit of its masses.
    pub mass: MassUnit,
}

/// Reasons why a table holds no drives.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum InvalidDriveTable {
    /// It is not a table.
    #[error(transparent)]
    Sheet(#[from] InvalidSheet),
    /// No header names its columns.
    #[error("the first line does not name the columns")]
    NoHeader,
    /// A required column is missing.
    #[error("no column is named `{0}`")]
    NoColumn(&'static str),
    /// Two columns have the same meaning.
    #[error("two columns are named `{0}`")]
    TwoColumns(&'static str),
    /// Two columns give the least length.
    #[error("`dead_length` and `retracted_length` say the same thing in two ways")]
    TwoLengths,
    /// A unit that is unknown, or of another kind.
    #[error("`{unit}` of the column `{column}` is no unit of {quantity}")]
    Unit {
        /// The column as named in the header.
        column: String,
        /// The text after the name.
        unit: String,
        /// The quantity of the column.
        quantity: &'static str,
    },
    /// Units of the table cannot be converted to those of the design.
    #[error("the column `{column}` has a unit, and the unit `{units}` of the design is not a known one")]
    DesignUnit {
        /// The column as named in the header.
        column: String,
        /// The label of the design.
        units: String,
    },
    /// Invalid cells, one sentence each.
    #[error("{}", .0.join("; "))]
    Cells(Vec<String>),
    /// Two drives have the same name, but the drive is chosen by name.
    #[error("two drives are named `{0}`")]
    TwoDrives(String),
    /// There is no row.
    #[error("it has no line with a drive")]
    Empty,
}

num::words! {
    /// The meaning of a column.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    enum DriveColumn as name {
        Name = "name",
        Stroke = "stroke",
        DeadLength = "dead_length",
        RetractedLength = "retracted_length",
        Force = "force",
        Speed = "speed",
        Mass = "mass",
        Stiffness = "stiffness",
        Price = "price",
        Source = "source",
    }
}

impl DriveColumn {
    fn quantity(self) -> &'static str {
        match self {
            Self::Stroke | Self::DeadLength | Self::RetractedLength => "length",
            Self::Force => "force",
            Self::Speed => "speed, a length per s",
            Self::Mass => "mass",
            Self::Stiffness => "stiffness, a force per length",
            Self::Name | Self::Price | Self::Source => "anything",
        }
    }

    /// The column of a cell of the header, and its unit: `stroke_mm`, `stroke [mm]`, `Stroke (mm)`.
    fn of(cell: &str) -> Option<(Self, String)> {
        let plain: String = cell.trim().replace(['[', '(', ' '], "_").replace([']', ')'], "");
        let lower = plain.to_lowercase();
        let found = Self::ALL.into_iter().find_map(|column| {
            let rest = lower.strip_prefix(column.name())?;
            (rest.is_empty() || rest.starts_with('_')).then_some((column, rest.len()))
        });
        let (column, rest) = found?;
        let unit = plain.get(plain.len() - rest..)?.trim_matches('_').replace("_per_", "/").replace('_', "/");
        Some((column, unit))
    }

    /// Size of the table's unit in the unit of the design; 1 without a unit. `None` for a unit of another kind.
    fn factor(self, unit: &str, of: &DesignUnits<'_>) -> Option<UnitRatio> {
        if unit.is_empty() {
            return Some(UnitRatio::Known(1.0));
        }
        let length = |label: &str| micrometres(label).map(|x| x as f64);
        let own = length(of.length);
        let in_own = |x: f64| own.map_or(UnitRatio::Unknown, |own| UnitRatio::Known(x / own));
        let force = |label: &str| ForceUnit::ALL.into_iter().find(|u| u.label() == label);
        match self {
            Self::Stroke | Self::DeadLength | Self::RetractedLength => length(unit).map(in_own),
            Self::Speed => length(unit.strip_suffix("/s")?).map(in_own),
            Self::Force => force(unit).map(|u| UnitRatio::Known(u.newtons() / of.force.newtons())),
            Self::Mass => {
                let found = MassUnit::ALL.into_iter().find(|u| u.label() == unit)?;
                Some(UnitRatio::Known(found.kilograms() / of.mass.kilograms()))
            }
            Self::Stiffness => {
                let (above, below) = unit.split_once('/')?;
                let (above, below) = (force(above)?, length(below)?);
                let force = above.newtons() / of.force.newtons();
                Some(own.map_or(UnitRatio::Unknown, |own| UnitRatio::Known(force * own / below)))
            }
            Self::Name | Self::Price | Self::Source => Some(UnitRatio::Known(1.0)),
        }
    }
}

/// Conversion from the unit of a column to that of the design.
enum UnitRatio {
    Known(f64),
    /// The size of the design's unit is unknown.
    Unknown,
}

/// Least similarity of a misspelt column name.
const NEAR: f64 = 0.7;

impl DriveTable {
    /// Reads a table whose first line names the columns, with their units: `stroke_mm`, `force_N`, `speed_mm/s`,
    /// `mass_kg`, `stiffness_N/mm`. A column without a unit is in the units of the design. `stroke` is required, with
    /// either `dead_length` (least length minus the stroke) or `retracted_length` (least length). Empty cells of other
    /// columns are unknown values.
    ///
    /// # Errors
    /// [`InvalidDriveTable`].
    pub fn read(bytes: &[u8], units: &DesignUnits<'_>) -> Result<Self, InvalidDriveTable> {
        let sheet = CellTable::read(bytes, 2)?;
        let header = sheet.header.clone().ok_or(InvalidDriveTable::NoHeader)?;
        let mut guesses = sheet.guesses.clone();
        let mut columns: Vec<(DriveColumn, usize, f64)> = Vec::new();
        let mut currency = None;
        for (k, cell) in header.iter().enumerate() {
            let Some((column, unit)) = DriveColumn::of(cell) else {
                let near = nearest_word(cell, &DriveColumn::ALL.map(DriveColumn::name), NEAR);
                let help = near.map_or(String::new(), |near| format!("; is it `{near}`?"));
                guesses.push(format!("The column `{cell}` is not used{help}."));
                continue;
            };
            if columns.iter().any(|c| c.0 == column) {
                return Err(InvalidDriveTable::TwoColumns(column.name()));
            }
            let factor = match column.factor(&unit, units) {
                Some(UnitRatio::Known(factor)) => factor,
                Some(UnitRatio::Unknown) => {
                    let (column, units) = (cell.clone(), units.length.to_owned());
                    return Err(InvalidDriveTable::DesignUnit { column, units });
                }
                None => {
                    let quantity = column.quantity();
                    return Err(InvalidDriveTable::Unit { column: cell.clone(), unit, quantity });
                }
            };
            if column == DriveColumn::Price && !unit.is_empty() {
                currency = Some(unit);
            }
            columns.push((column, k, factor));
        }
        let has = |column| columns.iter().any(|c| c.0 == column);
        if !has(DriveColumn::Stroke) {
            return Err(InvalidDriveTable::NoColumn(DriveColumn::Stroke.name()));
        }
        match (has(DriveColumn::DeadLength), has(DriveColumn::RetractedLength)) {
            (true, true) => return Err(InvalidDriveTable::TwoLengths),
            (false, false) => return Err(InvalidDriveTable::NoColumn(DriveColumn::DeadLength.name())),
            _ => (),
        }
        let mut faults = Vec::new();
        let mut drives = Vec::new();
        for row in &sheet.rows {
            if row.cells.iter().all(|c| c.trim().is_empty()) {
                continue;
            }
            let reader = RowReader { sheet: &sheet, row, columns: &columns };
            let number = drives.len() + 1;
            drives.extend(reader.drive(number, &mut faults));
        }
        if !faults.is_empty() {
            return Err(InvalidDriveTable::Cells(faults));
        }
        if drives.is_empty() {
            return Err(InvalidDriveTable::Empty);
        }
        Ok(Self { drives, currency, guesses })
    }
}

struct RowReader<'a> {
    sheet: &'a CellTable,
    row: &'a SheetRow,
    columns: &'a [(DriveColumn, usize, f64)],
}

impl RowReader<'_> {
    fn cell(&self, column: DriveColumn) -> Option<(&str, f64)> {
        let (_, k, factor) = self.columns.iter().find(|c| c.0 == column)?;
        let cell = self.row.cells.get(*k)?.trim();
        (!cell.is_empty()).then_some((cell, *factor))
    }

    /// A number of at least 0, or above 0 unless `zero` is allowed.
    fn number(&self, column: DriveColumn, zero: bool, faults: &mut Vec<String>) -> Option<f64> {
        let (cell, factor) = self.cell(column)?;
        let x = self.sheet.number(cell);
        if !x.is_some_and(|x| x > 0.0 || (zero && x >= 0.0)) {
            let range = if zero { "a number of 0 or more" } else { "a positive number" };
            faults.push(format!("line {}: `{}` is `{cell}`, not {range}", self.row.line, column.name()));
        }
        x.map(|x| x * factor)
    }

    fn needed(&self, column: DriveColumn, zero: bool, faults: &mut Vec<String>) -> Option<f64> {
        if self.cell(column).is_none() {
            faults.push(format!("line {}: `{}` is empty", self.row.line, column.name()));
        }
        self.number(column, zero, faults)
    }

    fn drive(&self, number: usize, faults: &mut Vec<String>) -> Option<Drive> {
        let text = |column| self.cell(column).map(|(cell, _)| cell.to_owned());
        let stroke = self.needed(DriveColumn::Stroke, false, faults);
        let retracted = self.columns.iter().any(|c| c.0 == DriveColumn::RetractedLength);
        let least = if retracted { DriveColumn::RetractedLength } else { DriveColumn::DeadLength };
        let least = self.needed(least, !retracted, faults);
        let mut other = |column| self.number(column, false, faults);
        let (force, speed) = (other(DriveColumn::Force), other(DriveColumn::Speed));
        let (mass, stiffness) = (other(DriveColumn::Mass), other(DriveColumn::Stiffness));
        let price = self.number(DriveColumn::Price, true, faults);
        let (stroke, least) = (stroke?, least?);
        let lengths = if retracted {
            LengthLimits::Range(least, least + stroke)
        } else {
            LengthLimits::Stroke { dead: least, stroke }
        };
        Some(Drive {
            line: self.row.line,
            name: text(DriveColumn::Name).unwrap_or_else(|| format!("drive {number}")),
            stroke,
            lengths,
            force,
            speed,
            mass,
            stiffness,
            price,
            source: text(DriveColumn::Source),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MM: DesignUnits<'_> =
        DesignUnits { length: "mm", force: ForceUnit::Newton, mass: MassUnit::Kilogram };

    fn read(text: &str) -> Result<DriveTable, InvalidDriveTable> {
        DriveTable::read(text.as_bytes(), &MM)
    }

    #[test]
    fn units_of_the_header_become_those_of_the_design() {
        let text = "name,stroke_mm,dead_length [cm],force_kN,Speed (m/s),mass_kg,stiffness_N/um,price_EUR,source\n\
                    A 4,600,25,4,0.5,22,30,980,catalogue p. 12\nB,500,25,,,,,,\n";
        let table = read(text).unwrap();
        assert_eq!(table.currency.as_deref(), Some("EUR"));
        let a = &table.drives[0];
        assert_eq!((a.name.as_str(), a.line, a.source.as_deref()), ("A 4", 2, Some("catalogue p. 12")));
        assert_eq!(a.lengths, LengthLimits::Stroke { dead: 250.0, stroke: 600.0 });
        let near = |x: Option<f64>, y: f64| (x.unwrap() / y - 1.0).abs() < 1e-14;
        assert!(near(a.force, 4000.0) && near(a.speed, 500.0) && near(a.stiffness, 30_000.0));
        assert!(near(a.mass, 22.0) && near(a.price, 980.0));
        let b = &table.drives[1];
        assert_eq!((b.force, b.speed, b.mass, b.stiffness, b.price), (None, None, None, None, None));
        // the same in metres, kilonewtons and grams
        let other = DesignUnits { length: "m", force: ForceUnit::Kilonewton, mass: MassUnit::Gram };
        let a = &DriveTable::read(text.as_bytes(), &other).unwrap().drives[0];
        assert!(near(Some(a.stroke), 0.6) && near(a.force, 4.0) && near(a.mass, 22_000.0));
        assert!(near(a.stiffness, 30_000.0), "newtons per millimetre are kilonewtons per metre");
    }

    #[test]
    fn columns_without_units_are_in_those_of_the_design_and_lengths_may_be_retracted_ones() {
        let table = read("stroke;retracted_length;colour\n600;850;1\n500,5;750;2\n").unwrap();
        assert_eq!(table.drives[0].lengths, LengthLimits::Range(850.0, 1450.0));
        assert_eq!((table.drives[1].name.as_str(), table.drives[1].stroke), ("drive 2", 500.5));
        assert!(table.guesses.iter().any(|g| g.contains("`colour` is not used")), "{:?}", table.guesses);
    }

    #[test]
    fn what_cannot_be_used_is_refused() {
        let refused = |text: &str| read(text).unwrap_err();
        assert_eq!(refused("600,250\n500,250\n"), InvalidDriveTable::NoHeader);
        assert_eq!(refused("name,dead_length,force\na,250,4000\n"), InvalidDriveTable::NoColumn("stroke"));
        assert_eq!(refused("name,stroke,force\na,250,4000\n"), InvalidDriveTable::NoColumn("dead_length"));
        assert_eq!(
            refused("name,stroke,dead_length,retracted_length\na,1,2,3\n"),
            InvalidDriveTable::TwoLengths
        );
        assert_eq!(
            refused("name,stroke,stroke_mm,dead_length\na,1,2,3\n"),
            InvalidDriveTable::TwoColumns("stroke")
        );
        assert!(matches!(
            refused("name,stroke_N,dead_length\na,1,2\n"),
            InvalidDriveTable::Unit { quantity: "length", .. }
        ));
        let InvalidDriveTable::Cells(faults) =
            refused("name,stroke,dead_length,force\na,-1,2,3\nb,1,2,strong\nc,4,,5\n")
        else {
            panic!("not the cells")
        };
        assert_eq!(faults.len(), 3, "{faults:?}");
        let unknown = DesignUnits { length: "1", ..MM };
        let found = DriveTable::read(b"name,stroke_mm,dead_length\na,1,2\n", &unknown);
        assert!(matches!(found, Err(InvalidDriveTable::DesignUnit { .. })));
        assert!(DriveTable::read(b"name,stroke,dead_length\na,1,2\n", &unknown).is_ok());
    }
}
