//! Leg lengths or poses in rows, with times.

mod columns;
mod listed;
mod matrices;
mod names;
mod pose_names;
mod upright;

use thiserror::Error;

use self::names::{ANGLE_WORDS, LENGTH_WORDS, numbered_columns, numbered_name};
use super::header::plain;
use super::listed::{Formula, is_abbreviated};
use super::sheet::{CellTable, InvalidSheet};
use super::text::decode;
use platform::geom::{InvalidPose, Pose, PoseConvention};

/// Least count of numbers in a row.
const LEAST_NUMBERS: usize = 2;
/// Greatest number of quoted bad lines.
const QUOTED: usize = 3;

/// Number of lengths in a row.
const LEGS: usize = 6;

/// The contents of the rows of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SeriesKind {
    /// Six leg lengths.
    Lengths,
    /// Six angles of cranks, degrees.
    Angles,
}

/// The kind of rows of a table.
#[derive(Debug, Clone, Copy)]
enum RowKind<'a> {
    /// Six numbers.
    Six(SeriesKind),
    /// A pose, and six leg lengths after it or none.
    Poses { stated: &'a PoseConvention, with_lengths: bool },
}

/// A row that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct SeriesRow<T> {
    /// Its line in the text, from 1.
    pub line: usize,
    /// Its time in the unit of the table, if there is a column for it.
    pub time: Option<f64>,
    /// Its value.
    pub value: T,
}

/// A table of rows.
#[derive(Debug, Clone, PartialEq)]
pub struct TimeSeries<T> {
    /// The name of the column of times.
    pub time_name: Option<String>,
    /// In the order of the text; at least one.
    pub rows: Vec<SeriesRow<T>>,
    /// The convention of its poses: what was stated, and what the names of columns say where nothing was.
    pub frames: PoseConvention,
    /// The guesses, one sentence each.
    pub guesses: Vec<String>,
}

impl<T> TimeSeries<T> {
    /// Rows that stand in no table.
    #[must_use]
    pub fn of_rows(rows: Vec<SeriesRow<T>>) -> Self {
        Self { time_name: None, rows, frames: PoseConvention::default(), guesses: Vec::new() }
    }
}

/// Reasons why a text is no such table.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum InvalidSeries {
    /// It is not a table.
    #[error("{0}")]
    Sheet(InvalidSheet),
    /// It has no row of numbers.
    #[error("there is no line of numbers")]
    Empty,
    /// The names of its angles do not determine their order.
    #[error("`{0}` may be angles in several orders, or a rotation vector: state the rotation order")]
    Order(String),
    /// Columns name each axis once, and the order turns about one of them twice.
    #[error("`{0}` names every axis once, and the rotation order {1} turns about one of them twice")]
    Twice(String, String),
    /// The unit of a column and that of the design have no known ratio.
    #[error("`{0}` is in {1}, and the unit `{2}` of the design is not a known one")]
    Unit(String, &'static str, String),
    /// Columns of travel where lengths are needed.
    #[error("`{0}` is a travel and not a length from joint centre to joint centre")]
    Travel(String),
    /// Matrices that are no poses.
    #[error("{0}")]
    Matrices(String),
    /// A printed array with rows left out.
    #[error("the array is abbreviated: `...` stands for rows or numbers that are missing")]
    Abbreviated,
    /// A list in a formula.
    #[error("this text computes its numbers, and programs are not run")]
    Computed,
    /// Rows that cannot be read, each with its line.
    #[error("{}", quoted(.0))]
    Rows(Vec<String>),
}

fn quoted(rows: &[String]) -> String {
    let shown = rows.iter().take(QUOTED).cloned().collect::<Vec<_>>().join("; ");
    if rows.len() > QUOTED { format!("{shown}; and {} more", rows.len() - QUOTED) } else { shown }
}

impl InvalidSeries {
    /// The faults, one sentence per faulty line.
    pub fn sentences(&self) -> Vec<String> {
        match self {
            Self::Rows(rows) => rows.clone(),
            other => vec![other.to_string()],
        }
    }
}

impl SeriesKind {
    /// Reads a table in any common notation; `record` reads the values of a row as decimals with points, separated by
    /// commas.
    ///
    /// A header may name a column of times and, in any order, those of the values. Without names the values are all
    /// columns except the time, in their order. Lines without numbers before the first row are titles. Lengths in
    /// another unit than `units`, as a name or a title says, are converted.
    ///
    /// # Errors
    /// [`InvalidSeries`].
    pub fn read<T>(
        self,
        bytes: &[u8],
        units: &str,
        record: impl Fn(&str) -> Result<T, String>,
    ) -> Result<TimeSeries<T>, InvalidSeries> {
        read_rows(RowKind::Six(self), bytes, units, |_, text| record(text))
    }
}

/// Reads a table of poses in a convention. Names of columns say what it leaves open: the order of `u, v, w`, that
/// `surge, sway, heave` count from home, the units of angles. Positions become those of the unit of the design.
///
/// # Errors
/// [`InvalidSeries`].
pub fn read_poses(
    bytes: &[u8],
    stated: &PoseConvention,
    home: &Pose,
    units: &str,
) -> Result<TimeSeries<Pose>, InvalidSeries> {
    read_rows(RowKind::Poses { stated, with_lengths: false }, bytes, units, |frames, text| {
        frames.read_text(text, home).map_err(|why| why.to_string())
    })
}

/// Reads a table with a pose and six leg lengths a row.
///
/// # Errors
/// [`InvalidSeries`].
pub fn read_poses_with_lengths(
    bytes: &[u8],
    stated: &PoseConvention,
    home: &Pose,
    units: &str,
) -> Result<TimeSeries<(Pose, [f64; 6])>, InvalidSeries> {
    read_rows(RowKind::Poses { stated, with_lengths: true }, bytes, units, |frames, text| {
        let fields: Vec<&str> = text.split(',').collect();
        if fields.len() < 2 * LEGS {
            return Err(format!("{} values instead of a pose and six lengths", fields.len()));
        }
        let (pose, shown) = fields.split_at(fields.len() - LEGS);
        let pose = frames.read_text(&pose.join(","), home).map_err(|why: InvalidPose| why.to_string())?;
        let mut lengths = [0.0; LEGS];
        for (leg, (length, field)) in lengths.iter_mut().zip(shown).enumerate() {
            let read = field.trim().parse().ok().filter(|x: &f64| x.is_finite());
            *length = read.ok_or_else(|| format!("length {}, `{field}`, is not a finite number", leg + 1))?;
        }
        Ok((pose, lengths))
    })
}

fn read_rows<T>(
    kind: RowKind<'_>,
    bytes: &[u8],
    units: &str,
    record: impl Fn(&PoseConvention, &str) -> Result<T, String>,
) -> Result<TimeSeries<T>, InvalidSeries> {
    let mut sheet = kind.sheet(bytes)?;
    let mut guesses = std::mem::take(&mut sheet.guesses);
    match kind {
        RowKind::Poses { .. } => matrices::to_rows(&mut sheet, &mut guesses)?,
        RowKind::Six(SeriesKind::Lengths) => upright::turn(&mut sheet, &LENGTH_WORDS, &mut guesses),
        RowKind::Six(SeriesKind::Angles) => upright::turn(&mut sheet, &ANGLE_WORDS, &mut guesses),
    }
    let header = sheet.header.clone().unwrap_or_default();
    let columns = kind.columns(&sheet, units, &mut guesses)?;
    let (mut rows, mut bad) = (Vec::new(), Vec::new());
    for row in &sheet.rows {
        let has_numbers = row.cells.iter().any(|c| sheet.number(c).is_some());
        if rows.is_empty() && bad.is_empty() && !has_numbers {
            guesses.push(format!(
                "Line {}, `{}`, has no numbers and is passed over.",
                row.line,
                row.cells.join(" ")
            ));
            continue;
        }
        match columns.read(&sheet, row, |text| record(&columns.frames, text)) {
            Ok((time, value)) => rows.push(SeriesRow { line: row.line, time, value }),
            Err(why) => bad.push(format!("line {}: {why}", row.line)),
        }
    }
    if !bad.is_empty() {
        return Err(InvalidSeries::Rows(bad));
    }
    if rows.is_empty() {
        return Err(InvalidSeries::Empty);
    }
    let time_name = columns.time.and_then(|c| header.get(c).cloned());
    Ok(TimeSeries { time_name, rows, frames: columns.frames, guesses })
}

impl RowKind<'_> {
    /// The cells of a text, which may be a list of a program too.
    fn sheet(self, bytes: &[u8]) -> Result<CellTable, InvalidSeries> {
        let numbered = |names: &[String], words| {
            let names: Vec<String> = names.iter().map(|name| plain(&numbered_name(name))).collect();
            numbered_columns(&names, words).is_some()
        };
        let text = decode(bytes).map(|decoded| decoded.text).unwrap_or_default();
        let usual = PoseConvention::default();
        let listed = match self {
            Self::Six(SeriesKind::Lengths) => {
                listed::read(&text, (&usual, &LENGTH_WORDS), &|names| numbered(names, &LENGTH_WORDS))
            }
            Self::Six(SeriesKind::Angles) => {
                listed::read(&text, (&usual, &ANGLE_WORDS), &|names| numbered(names, &ANGLE_WORDS))
            }
            Self::Poses { stated, .. } => listed::read(&text, (stated, &LENGTH_WORDS), &listed::is_pose),
        };
        match listed.map_err(|Formula| InvalidSeries::Computed)? {
            Some(_) if is_abbreviated(&text) => Err(InvalidSeries::Abbreviated),
            Some(listed) => Ok(listed),
            None => CellTable::read(bytes, LEAST_NUMBERS).map_err(|why| match why {
                InvalidSheet::NoNumbers(_) => InvalidSeries::Empty,
                why => InvalidSeries::Sheet(why),
            }),
        }
    }
}

#[cfg(test)]
mod tests;
