//! Tables of leg lengths and poses, one record on each line.

use std::path::Path;

use super::context::Context;
use super::failure::Failure;
use super::files;
use ::files::design::{InvalidSeries, SeriesKind, TimeSeries, read_poses, read_poses_with_lengths};
use ask::PoseFrames;
use platform::geom::Pose;

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

/// Rows read by `record` from a table in any usual notation; guesses about it go to standard error. Lengths are those
/// of a design in `units`.
///
/// # Errors
/// Exit 2, naming all bad lines; a table without a record is refused too.
pub(crate) fn read<T>(
    kind: SeriesKind,
    table: TableName<'_>,
    units: &str,
    context: &Context,
    record: impl Fn(&str) -> Result<T, String>,
) -> Result<TimeSeries<T>, Failure> {
    told(kind.read(&files::read_table(table.path)?, units, record), table, context)
}

/// The table, with its guesses on standard error.
///
/// # Errors
/// Exit 2 with what is wrong with it.
fn told<T>(
    read: Result<TimeSeries<T>, InvalidSeries>,
    table: TableName<'_>,
    context: &Context,
) -> Result<TimeSeries<T>, Failure> {
    let shown = files::shown(table.path);
    let series = read.map_err(|why| {
        let message = match &why {
            InvalidSeries::Empty => format!("{shown} has no line of numbers"),
            why => format!("{shown}: {why}"),
        };
        let help = match &why {
            InvalidSeries::Order(_) => {
                "state --rotation-order, such as moving-xyz, fixed-xyz or vector, or rotation_order in [frames]".into()
            }
            InvalidSeries::Matrices(_) => {
                "write R11,R12,R13,x,R21,..,z or a 4 x 4 matrix row by row, each pose on one line or on lines of four numbers, or name the columns r11, r12, .., r33, x, y, z".into()
            }
            InvalidSeries::Computed => {
                "print the numbers in your program and read its output, or write them out".into()
            }
            InvalidSeries::Abbreviated => {
                "print the whole array, in numpy with set_printoptions(threshold=sys.maxsize), or write it with savetxt".into()
            }
            InvalidSeries::Travel(_) => "add the least length of a leg to its travel".into(),
            InvalidSeries::Unit(..) => "give the design a known unit of length, or the table the unit of the design".into(),
            _ => format!("write {}", table.form),
        };
        Failure::refused(table.code, message).with_help(help)
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
    (frames, units): (&PoseFrames, &str),
    context: &Context,
) -> Result<TimeSeries<Pose>, Failure> {
    poses_of(&files::read_table(path)?, path, code, (frames, units), context)
}

/// The poses of a table read before.
///
/// # Errors
/// As [`read`].
pub(crate) fn poses_of(
    bytes: &[u8],
    path: &Path,
    code: &'static str,
    (frames, units): (&PoseFrames, &str),
    context: &Context,
) -> Result<TimeSeries<Pose>, Failure> {
    let form = "a pose a line: x,y,z,roll_deg,pitch_deg,yaw_deg, x,y,z,qw,qx,qy,qz or a matrix R11,R12,R13,x,R21,..,z, or name the columns in the first line: t for times, x,y,z,u,v,w or surge,sway,heave,roll,pitch,yaw";
    told(read_poses(bytes, &frames.convention, &frames.home, units), TableName { path, code, form }, context)
}

/// The poses of a table with six lengths each.
///
/// # Errors
/// As [`read`].
pub(crate) fn poses_with_lengths(
    path: &Path,
    code: &'static str,
    (frames, units): (&PoseFrames, &str),
    context: &Context,
) -> Result<TimeSeries<(Pose, [f64; 6])>, Failure> {
    let form = "a pose and six lengths a line: x,y,z,roll_deg,pitch_deg,yaw_deg,l1,..,l6 or x,y,z,qw,qx,qy,qz,l1,..,l6";
    let bytes = files::read_table(path)?;
    told(
        read_poses_with_lengths(&bytes, &frames.convention, &frames.home, units),
        TableName { path, code, form },
        context,
    )
}
