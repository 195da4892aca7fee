//! The columns of a table of lengths, angles or poses, and the values of a row.

use super::names::{
    ANGLE_WORDS, LENGTH_WORDS, angle_unit_of, is_time, is_travel, numbered_columns, numbered_name,
    without_angle_units,
};
use super::pose_names::named_pose;
use super::{InvalidSeries, LEGS, RowKind, SeriesKind};
use crate::design::table::header::{converted, length_unit, plain};
use crate::design::table::sheet::{CellTable, SheetRow};
use platform::geom::{AngleUnit, PoseConvention};

/// The columns of the values in a row.
pub(super) struct SeriesColumns {
    pub(super) time: Option<usize>,
    /// The columns of the values in their order; `None`: all except the time.
    pub(super) values: Option<Vec<usize>>,
    /// Columns of angles in radians that are read in degrees.
    pub(super) radians: Vec<usize>,
    /// Columns of lengths in another unit than that of the design, with their units.
    pub(super) foreign: Vec<(usize, &'static str)>,
    /// The unit of the design.
    pub(super) units: String,
    /// The convention of the poses.
    pub(super) frames: PoseConvention,
    /// The number of named columns; 0 without names.
    pub(super) named: usize,
}

impl RowKind<'_> {
    pub(super) fn columns(
        self,
        sheet: &CellTable,
        units: &str,
        guesses: &mut Vec<String>,
    ) -> Result<SeriesColumns, InvalidSeries> {
        let header: &[String] = sheet.header.as_deref().unwrap_or_default();
        let names: Vec<String> = header.iter().map(|name| plain(&numbered_name(name))).collect();
        let time = names.iter().position(|name| is_time(name));
        let mut frames = PoseConvention::default();
        let mut radians = Vec::new();
        let values = match self {
            Self::Six(SeriesKind::Lengths) => {
                let found = numbered_columns(&names, &LENGTH_WORDS);
                if let Some(travel) = found.iter().flatten().find(|c| is_travel(&names[**c])) {
                    return Err(InvalidSeries::Travel(header[*travel].clone()));
                }
                found
            }
            Self::Six(SeriesKind::Angles) => numbered_columns(&without_angle_units(&names), &ANGLE_WORDS),
            Self::Poses { stated, with_lengths } => {
                frames = *stated;
                let lengths = with_lengths.then(|| numbered_columns(&names, &LENGTH_WORDS));
                let titled = PoseConvention { angles: stated.angles.or(sheet.angle_unit), ..*stated };
                let found = named_pose(header, &names, &titled)?.filter(|_| lengths != Some(None));
                found.map(|named| {
                    frames = named.frames;
                    guesses.extend(named.guesses);
                    radians = named.radians;
                    named.columns.into_iter().chain(lengths.flatten().into_iter().flatten()).collect()
                })
            }
        };
        let width = sheet.rows.iter().map(|row| row.cells.len()).max().unwrap_or(0);
        let in_order: Vec<usize> = (0..width).filter(|c| Some(*c) != time).collect();
        let taken = values.as_ref().unwrap_or(&in_order);
        let is_in_radians = |c: &usize| {
            let named = header.get(*c).and_then(|name| angle_unit_of(name));
            named.or(sheet.angle_unit) == Some(AngleUnit::Radians)
        };
        let angles: &[usize] = match self {
            Self::Six(SeriesKind::Angles) => taken,
            // three angles, and neither a quaternion nor a matrix
            Self::Poses { .. } if self.numbers_of_pose(taken.len()) == 6 => &taken[3..6],
            Self::Six(SeriesKind::Lengths) | Self::Poses { .. } => &[],
        };
        let is_read_in_degrees = values.is_none() && frames.angles.is_none();
        if matches!(self, Self::Six(_)) || is_read_in_degrees {
            radians.extend(angles.iter().copied().filter(is_in_radians));
        }
        guesses.extend(time.map(|c| format!("The column `{}` holds times.", header[c])));
        if !angles.is_empty() && angles.iter().any(is_in_radians) {
            guesses.push("The angles are in radians, as the table says.".into());
        }
        let foreign = self.foreign_lengths(sheet, taken, units, guesses)?;
        if values.is_none() {
            guesses.extend(self.order_taken(&frames, in_order.len(), !header.is_empty()));
        }
        let unused = (0..header.len())
            .filter(|c| Some(*c) != time && values.as_ref().is_some_and(|list| !list.contains(c)));
        let unused: Vec<String> = unused.map(|c| format!("`{}`", header[c])).collect();
        if !unused.is_empty() {
            guesses.push(format!("These columns are not used: {}.", unused.join(", ")));
        }
        Ok(SeriesColumns {
            time,
            values,
            radians,
            foreign,
            units: units.to_owned(),
            frames,
            named: header.len(),
        })
    }

    /// The columns of lengths in another unit than that of the design.
    ///
    /// # Errors
    /// A unit without a known ratio to that of the design.
    fn foreign_lengths(
        self,
        sheet: &CellTable,
        taken: &[usize],
        units: &str,
        guesses: &mut Vec<String>,
    ) -> Result<Vec<(usize, &'static str)>, InvalidSeries> {
        let lengths: Vec<usize> = match self {
            Self::Six(SeriesKind::Lengths) => taken.to_vec(),
            Self::Six(SeriesKind::Angles) => Vec::new(),
            Self::Poses { .. } => {
                let after = self.numbers_of_pose(taken.len()).max(3);
                // the fourth column of a matrix, or the first three numbers
                let position = if after == 12 || after == 16 { [3, 7, 11] } else { [0, 1, 2] };
                let position = position.into_iter().filter_map(|k| taken.get(k));
                position.chain(taken.iter().skip(after)).copied().collect()
            }
        };
        let header: &[String] = sheet.header.as_deref().unwrap_or_default();
        let mut foreign = Vec::new();
        for c in lengths {
            let name = header.get(c).map_or("", String::as_str);
            let Some(unit) = length_unit(name).or(sheet.length_unit).filter(|unit| *unit != units) else {
                continue;
            };
            if converted(1.0, unit, units).is_none() {
                return Err(InvalidSeries::Unit(name.to_owned(), unit, units.to_owned()));
            }
            foreign.push((c, unit));
        }
        let mut said: Vec<&str> = foreign.iter().map(|(_, unit)| *unit).collect();
        said.dedup();
        guesses.extend(
            said.iter()
                .map(|unit| format!("Lengths in {unit}, as the table says, are converted to {units}.")),
        );
        Ok(foreign)
    }

    /// The count of the numbers of a pose in a row of this many numbers.
    fn numbers_of_pose(self, count: usize) -> usize {
        match self {
            Self::Poses { with_lengths: true, .. } => count.saturating_sub(LEGS),
            _ => count,
        }
    }

    /// The guess about columns without known names.
    fn order_taken(self, frames: &PoseConvention, count: usize, named: bool) -> Option<String> {
        let Self::Poses { .. } = self else { return None };
        let rotation = match self.numbers_of_pose(count) {
            12 | 16 => return Some("The numbers are matrices (R p), row by row.".into()),
            6 => format!("three angles of the order {}", frames.order()),
            7 => frames.quaternion_order().written(["qw", "qx", "qy", "qz"]).join(","),
            _ => return None,
        };
        let order = format!("x,y,z,{rotation}");
        // three angles without names are the usual form of a table
        match (named, count) {
            (true, _) => Some(format!(
                "The names of the columns say nothing about poses: the columns are taken in the order {order}."
            )),
            (false, 7) => Some(format!("The columns are taken in the order {order}.")),
            (false, _) => None,
        }
    }
}

impl SeriesColumns {
    pub(super) fn read<T>(
        &self,
        sheet: &CellTable,
        row: &SheetRow,
        record: impl Fn(&str) -> Result<T, String>,
    ) -> Result<(Option<f64>, T), String> {
        if self.named > 0 && row.cells.len() > self.named {
            return Err(format!("{} cells below {} names of columns", row.cells.len(), self.named));
        }
        let cell = |column: usize| row.cells.get(column).map_or("", String::as_str);
        let time = match self.time {
            None => None,
            Some(c) => Some(sheet.number(cell(c)).ok_or_else(|| format!("`{}` is not a time", cell(c)))?),
        };
        let columns: Vec<usize> = match &self.values {
            // missing cells at the end of a line are absent, not blank
            Some(list) => list.iter().copied().filter(|c| *c < row.cells.len()).collect(),
            None => (0..row.cells.len()).filter(|c| Some(*c) != self.time).collect(),
        };
        let unit = |c: usize| self.foreign.iter().find(|(column, _)| *column == c).map(|(_, unit)| *unit);
        let value = |c: usize| match (sheet.number(cell(c)), unit(c)) {
            (Some(angle), _) if self.radians.contains(&c) => format!("{:?}", angle.to_degrees()),
            (Some(length), Some(unit)) => {
                format!("{:?}", converted(length, unit, &self.units).unwrap_or(f64::NAN))
            }
            _ => sheet.with_point(cell(c)),
        };
        let values: Vec<String> = columns.into_iter().map(value).collect();
        Ok((time, record(&values.join(","))?))
    }
}
