//! Tables of numbers as people have them: exports of spreadsheets, of CAD programs and of scripts; and legs in models of `MuJoCo`.
//!
//! Nothing says how such a table is written, so that its form is guessed from its text, and every guess is a sentence that the reader of the answer sees.
//! What cannot be read is refused; no cell is passed over without a word.

mod drives;
mod hal;
mod header;
mod mjcf;
mod placed;
mod points;
#[cfg(feature = "cli")]
mod rig_sheet;
mod series;
mod sheet;
mod text;

pub(crate) use drives::{DesignUnits, Drive, DriveTable, InvalidDriveTable};
#[cfg(feature = "cli")]
pub(crate) use points::InvalidPointTable;
pub(crate) use points::PointTable;
#[cfg(feature = "cli")]
pub(crate) use rig_sheet::{RigSheet, SheetDialect};
pub(crate) use series::{InvalidSeries, SeriesKind, SeriesRow, TimeSeries};
