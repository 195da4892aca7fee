//! Tables of leg lengths and poses, one record on each line.

use std::path::Path;

use super::context::Context;
use super::failure::Failure;
use super::files;
use ::files::design::{InvalidSeries, SeriesKind, TimeSeries};
use platform::geom::{InvalidPose, Pose};

/// The description of a table for refusals.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TableName<'a> {
    /// Its file.
    pub(crate) path: &'a Path,
    /// Code of the refusal.
    pub(crate) code: &'static str,
    /// The form of a line: "six lengths a line: l1,..".
    pub(crate) form: &'static str,
}

/// Rows read by `record` from a table in any usual notation; guesses about it go to standard error.
///
/// # Errors
/// Exit 2, naming all bad lines; a table without a record is refused too.
pub(crate) fn read<T>(
    kind: SeriesKind,
    table: TableName<'_>,
    context: &Context,
    record: impl Fn(&str) -> Result<T, String>,
) -> Result<TimeSeries<T>, Failure> {
    read_bytes(kind, table, &files::read_table(table.path)?, context, record)
}

fn read_bytes<T>(
    kind: SeriesKind,
    table: TableName<'_>,
    bytes: &[u8],
    context: &Context,
    record: impl Fn(&str) -> Result<T, String>,
) -> Result<TimeSeries<T>, Failure> {
    let shown = files::shown(table.path);
    let series = kind.read(bytes, record).map_err(|why| {
        let message = match why {
            InvalidSeries::Empty => format!("{shown} has no line of numbers"),
            why => format!("{shown}: {why}"),
        };
        Failure::refused(table.code, message).with_help(format!("write {}", table.form))
    })?;
    context.note_guesses(&shown, &series.guesses);
    Ok(series)
}

/// The poses of a table.
///
/// # Errors
/// As [`read`].
pub(crate) fn poses(
    path: &Path,
    code: &'static str,
    home: &Pose,
    context: &Context,
) -> Result<TimeSeries<Pose>, Failure> {
    poses_of(&files::read_table(path)?, path, code, home, context)
}

/// The poses of a table read before.
///
/// # Errors
/// As [`read`].
pub(crate) fn poses_of(
    bytes: &[u8],
    path: &Path,
    code: &'static str,
    home: &Pose,
    context: &Context,
) -> Result<TimeSeries<Pose>, Failure> {
    let form = "a pose a line: x,y,z,roll_deg,pitch_deg,yaw_deg or x,y,z,qw,qx,qy,qz, or name the columns x,y,z,u,v,w or surge,sway,heave,roll,pitch,yaw";
    let series = read_bytes(SeriesKind::Poses, TableName { path, code, form }, bytes, context, |line| {
        line.parse().map_err(|e: InvalidPose| e.to_string())
    })?;
    Ok(series.with_home(home))
}
