//! Tables of numbers from spreadsheets, CAD programs and scripts, and legs in models of simulators.
//!
//! Such tables do not declare their form. It is guessed from the text, and the answer shows every guess as a sentence.
//! Unreadable cells are refused; none is skipped silently.

mod drives;
mod hal;
mod header;
mod listed;
mod models;
mod placed;
mod points;
mod printed;
mod rig_sheet;
mod series;
mod sheet;
mod text;
#[cfg(feature = "workbook")]
mod workbook;

pub use drives::{DesignUnits, Drive, DriveTable, InvalidDriveTable};
pub use points::{InvalidPointTable, PointTable};
pub use rig_sheet::{InvalidRigSheet, RigSheet, SheetDialect, SheetLegs};
pub use series::{InvalidSeries, SeriesKind, SeriesRow, TimeSeries, read_poses, read_poses_with_lengths};
pub use sheet::InvalidSheet;
