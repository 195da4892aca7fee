//! Forces, small motions and stiffness at one pose, about any point of the platform.
//!
//! Drives (legs or cranks) have the rates `q' = J x` for the twist `x = (v, w)` of the platform at a point. Their
//! efforts `e` (forces of legs, torques of cranks) hold a wrench `(f, t)` about that point if no small
//! motion does work:
//!
//! ```text
//! e . q' + (f, t) . x = 0 for every x,   that is   J^T e = -(f, t).
//! ```
//!
//! The same matrix gives the wrench for measured efforts, and `x = J^-1 q'` the motion for small steps of the drives.
//! Drives of stiffness `k` hold the platform with `K = J^T diag(k) J`. At another point, `r` away from the origin of
//! the platform (base frame), the row `[u, m]` of a drive is `[u, m + u x r]`.

#[cfg(test)]
mod tests;

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

use crate::requirements::{HeldLines, LeastStiffness, least_stiffness};

/// The drives of a platform at a pose, about a point of the platform.
#[derive(Debug, Clone)]
pub struct PoseStatics {
    /// `J` at the point.
    rows: Matrix6<f64>,
    held: HeldLines,
    /// `J^-1`; `None` at a singular pose.
    inverse: Option<Matrix6<f64>>,
    length: f64,
}

/// A turn times the length over the shift, below which a motion is a shift.
const ROUNDED: f64 = 1e-12;

/// A small motion as a turn about an axis with a shift along it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Screw {
    /// Unit vector of the axis; of the shift where the platform does not turn.
    pub direction: Vector3<f64>,
    /// The point of the axis nearest to the point of the statics, from there; zero where the platform does not turn.
    pub point: Vector3<f64>,
    /// Shift along the axis for a turn of one radian, design units; `None` for a shift without a turn.
    pub pitch: Option<f64>,
}

impl PoseStatics {
    /// From the rates of the drives by the twist of the platform origin, and the arm `R c` of a point `c` of the
    /// platform. `length` makes moments comparable with forces while systems are solved; no answer depends on it.
    #[must_use]
    pub fn new(about_origin: &Matrix6<f64>, arm: &Vector3<f64>, length: f64) -> Self {
        let mut rows = *about_origin;
        let mut scaled = rows;
        for i in 0..6 {
            let direction: Vector3<f64> = rows.fixed_view::<1, 3>(i, 0).transpose();
            let moment: Vector3<f64> = rows.fixed_view::<1, 3>(i, 3).transpose() + direction.cross(arm);
            rows.fixed_view_mut::<1, 3>(i, 3).copy_from(&moment.transpose());
            scaled.fixed_view_mut::<1, 3>(i, 0).copy_from(&direction.transpose());
            scaled.fixed_view_mut::<1, 3>(i, 3).copy_from(&(moment / length).transpose());
        }
        // moments over the length: the inverse has turns times it
        let inverse = scaled.try_inverse().filter(|m| m.iter().all(|x| x.is_finite())).map(|mut inverse| {
            inverse.fixed_rows_mut::<3>(3).scale_mut(1.0 / length);
            inverse
        });
        Self { rows, held: HeldLines::new(&scaled, length), inverse, length }
    }

    /// Rates of the drives for the twist of the point, by rows.
    #[must_use]
    pub fn rates(&self) -> &Matrix6<f64> {
        &self.rows
    }

    /// The efforts that hold a wrench about the point; positive ones push the platform. `None` at a singular pose.
    #[must_use]
    pub fn efforts(&self, wrench: &Vector6<f64>) -> Option<Vector6<f64>> {
        self.held.forces(wrench)
    }

    /// The wrench about the point that these efforts hold.
    #[must_use]
    pub fn wrench(&self, efforts: &Vector6<f64>) -> Vector6<f64> {
        -(self.rows.transpose() * efforts)
    }

    /// Twists of the point for unit steps of single drives, by columns; `None` at a singular pose.
    #[must_use]
    pub fn motions(&self) -> Option<&Matrix6<f64>> {
        self.inverse.as_ref()
    }

    /// The stiffness at the point: force and torque for a shift of it and a small turn.
    #[must_use]
    pub fn stiffness(&self, drives: &[f64; 6]) -> Matrix6<f64> {
        let diagonal = Matrix6::from_diagonal(&Vector6::from(*drives));
        self.rows.transpose() * diagonal * self.rows
    }

    /// Least stiffness at the point; `None` at a singular pose.
    #[must_use]
    pub fn least_stiffness(&self, drives: &[f64; 6]) -> Option<LeastStiffness> {
        self.inverse?;
        least_stiffness(&self.stiffness(drives))
    }

    /// The motion that one drive alone makes: the one that is lost when it is stuck, and the only one left when it is
    /// free and the others hold. `None` at a singular pose.
    #[must_use]
    pub fn screw(&self, drive: usize) -> Option<Screw> {
        self.inverse.map(|inverse| Screw::of(&inverse.column(drive).into_owned(), self.length))
    }
}

impl Screw {
    /// The screw of a twist; a turn that rounding of the shift would make at this length is none.
    #[must_use]
    pub fn of(twist: &Vector6<f64>, length: f64) -> Self {
        let velocity: Vector3<f64> = twist.fixed_rows::<3>(0).into();
        let turn: Vector3<f64> = twist.fixed_rows::<3>(3).into();
        let square = turn.norm_squared();
        let pitch = turn.dot(&velocity) / square;
        let point = turn.cross(&velocity) / square;
        if !(turn.norm() * length > ROUNDED * velocity.norm()) {
            return Self { direction: velocity.normalize(), point: Vector3::zeros(), pitch: None };
        }
        Self { direction: turn.normalize(), point, pitch: Some(pitch) }
    }
}

/// A matrix that maps twists to wrenches, or wrenches to twists, with both in other axes: `B` has the new axes as
/// columns.
#[must_use]
pub fn in_axes(matrix: &Matrix6<f64>, axes: &Matrix3<f64>) -> Matrix6<f64> {
    let both = both_in(axes);
    both.transpose() * matrix * both
}

/// Six-vectors of new axes in old ones: both halves by the same matrix.
#[must_use]
pub fn both_in(axes: &Matrix3<f64>) -> Matrix6<f64> {
    let mut out = Matrix6::zeros();
    out.fixed_view_mut::<3, 3>(0, 0).copy_from(axes);
    out.fixed_view_mut::<3, 3>(3, 3).copy_from(axes);
    out
}
