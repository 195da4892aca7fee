//! Poses as matrices: `(R p)` or `(R p; 0 0 0 1)`, row by row, with rounded decimals.

use nalgebra::{Matrix3, Matrix4, RowVector4, Vector3};

use crate::geom::{InvalidPose, Pose};

/// Fewest decimals of a rounded rotation matrix: with two the rotation is uncertain by half a degree.
const FEWEST_DECIMALS: i32 = 3;
/// Entries below this may have more decimals than the larger ones, because programs print significant digits.
const LARGE: f64 = 0.1;

/// Greatest difference between `R^T R` and the identity for a rotation with the decimals of this matrix; zero if it has
/// too few decimals.
///
/// If every entry is off by at most `h`, each entry of `R^T R` is off by at most `2 sqrt(3) h` and less than `4 h`.
fn rounding(r: &Matrix3<f64>) -> f64 {
    let most = r.iter().filter(|x| x.abs() >= LARGE).map(|x| decimals(*x)).max().unwrap_or(0);
    if most < FEWEST_DECIMALS { 0.0 } else { 2.0 * 10.0_f64.powi(-most) }
}

/// Decimals of the shortest notation of a number.
fn decimals(x: f64) -> i32 {
    let shown = format!("{x:e}");
    let (digits, power) = shown.split_once('e').unwrap_or((&shown, "0"));
    let behind = digits.split_once('.').map_or(0, |(_, behind)| behind.len());
    i32::try_from(behind).unwrap_or(i32::MAX) - power.parse::<i32>().unwrap_or(0)
}

fn placed(r: &Matrix3<f64>, p: &Vector3<f64>) -> Result<Pose, InvalidPose> {
    let mut m = r.to_homogeneous();
    m.fixed_view_mut::<3, 1>(0, 3).copy_from(p);
    Pose::of_matrix(&m, rounding(r))
}

/// Whether sixteen numbers are a 4 x 4 matrix column by column (`true`) or row by row; `None` if they are both, without
/// a position, or neither.
#[must_use]
pub fn is_by_columns(numbers: &[f64]) -> Option<bool> {
    if numbers.len() != 16 {
        return None;
    }
    let last = |list: [usize; 3]| list.iter().all(|k| numbers[*k].abs() <= 0.0);
    let ends = numbers[15].to_bits() == 1.0_f64.to_bits();
    match (ends && last([12, 13, 14]), ends && last([3, 7, 11])) {
        (true, false) => Some(false),
        (false, true) => Some(true),
        _ => None,
    }
}

/// The pose of a 4 x 4 matrix. A matrix column by column is known by its zeros.
pub(super) fn of_sixteen(numbers: &[f64]) -> Result<Pose, InvalidPose> {
    let mut m = Matrix4::from_row_slice(numbers);
    if is_by_columns(numbers) == Some(true) {
        m.transpose_mut();
    }
    of_rows(&m)
}

fn of_rows(m: &Matrix4<f64>) -> Result<Pose, InvalidPose> {
    let r: Matrix3<f64> = m.fixed_view::<3, 3>(0, 0).into_owned();
    Pose::of_matrix(m, rounding(&r)).map_err(|why| {
        InvalidPose::Text(format!("the numbers are read as a matrix (R p), row by row: {why}"))
    })
}

/// The pose of a 3 x 4 matrix row by row.
///
/// # Errors
/// Three numbers beside nine of a matrix: rows and columns cannot be told apart.
pub(super) fn of_twelve(numbers: &[f64]) -> Result<Pose, InvalidPose> {
    let mut m = Matrix4::identity();
    for i in 0..3 {
        m.set_row(i, &RowVector4::from_row_slice(&numbers[4 * i..4 * i + 4]));
    }
    let found = of_rows(&m);
    if found.is_ok() {
        return found;
    }
    for (at, place) in [(0, "before"), (3, "behind")] {
        let r = Matrix3::from_row_slice(&numbers[at..at + 9]);
        let p = Vector3::from_row_slice(if at == 0 { &numbers[9..] } else { &numbers[..3] });
        let Ok(pose) = placed(&r, &p) else { continue };
        if r == r.transpose() {
            return Ok(pose);
        }
        return Err(InvalidPose::Text(format!(
            "twelve numbers with a rotation matrix {place} the position do not tell rows from columns: write R11, R12, R13, x, R21, .., or name the columns r11, r12, .., r33, x, y, z"
        )));
    }
    found
}

/// The reason why nine numbers are no pose.
pub(super) fn without_position(numbers: &[f64]) -> InvalidPose {
    let r = Matrix3::from_row_slice(numbers);
    InvalidPose::Text(match placed(&r, &Vector3::zeros()) {
        Ok(_) => {
            "nine numbers are a rotation matrix without a position: write R11, R12, R13, x, R21, ..".into()
        }
        Err(why) => format!("nine numbers are no pose: {why}"),
    })
}
