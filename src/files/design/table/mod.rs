//! Tables of numbers as people have them: exports of spreadsheets, of CAD programs and of scripts; and legs in models
//! of `MuJoCo`.
//!
//! Nothing says how such a table is written, so that its form is guessed from its text, and every guess is a sentence
//! that the reader of the answer sees. What cannot be read is refused; no cell is passed over without a word.

mod drives;
mod hal;
mod header;
mod mjcf;
mod placed;
mod points;
mod rig_sheet;
mod series;
mod sheet;
mod text;

pub use drives::{DesignUnits, Drive, DriveTable, InvalidDriveTable};
pub use points::{InvalidPointTable, PointTable};
pub use rig_sheet::{InvalidRigSheet, RigSheet, SheetDialect, SheetLegs};
pub use series::{InvalidSeries, SeriesKind, SeriesRow, TimeSeries, read_poses, read_poses_with_lengths};
pub use sheet::InvalidSheet;
