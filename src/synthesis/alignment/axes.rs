//! Axes of each body that belong to a centred span of leg vectors.
//!
//! Symmetric 3 x 3 matrices formed from the projector on the span turn with the body. Their common principal axes are the axes; where two
//! principal values agree, an angle about the third axis is left open, where all three agree, the whole rotation.

use crate::num::small::symmetric_eigen3;
use nalgebra::{Matrix3, SMatrix, Vector3};

/// Projector on a span, entry `(4 i + j, 4 k + l)`.
pub(super) type Projector = SMatrix<f64, 16, 16>;

/// Principal values closer than this (relative to the largest) count as equal. Two values that differ by less leave an angle open that
/// other parts of the projector decide, so that nothing is lost by counting them as equal.
const EQUAL: f64 = 1e-7;

/// Which rotations of a body keep the principal axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Freedom {
    /// Half turns about the three axes.
    HalfTurns,
    /// Rotations about the third axis, and half turns about axes across it.
    Axis,
    /// All rotations.
    All,
}

/// Right-handed axes (columns), and the principal values in falling order.
#[derive(Debug, Clone, Copy)]
pub(super) struct Axes {
    pub(super) frame: Matrix3<f64>,
    pub(super) values: Vector3<f64>,
    /// Which neighbouring principal values, in falling order, count as equal.
    pub(super) equal: [bool; 2],
}

impl Axes {
    /// Of the base; `equal` says which principal values count as equal, for the second of two designs that are compared.
    pub(super) fn of_base(p: &Projector, equal: Option<[bool; 2]>) -> Self {
        Self::of(|i, j, k, l| p[(4 * i + j, 4 * k + l)], equal)
    }

    /// Of the platform.
    pub(super) fn of_platform(p: &Projector, equal: Option<[bool; 2]>) -> Self {
        Self::of(|i, j, k, l| p[(4 * j + i, 4 * l + k)], equal)
    }

    /// `p(i, j, k, l)` with `i, k` for the body whose axes are wanted.
    fn of(p: impl Fn(usize, usize, usize, usize) -> f64, equal: Option<[bool; 2]>) -> Self {
        let (found, vectors) = symmetric_eigen3(&moments(&p));
        let mut order = [0, 1, 2];
        order.sort_by(|x, y| found[*y].total_cmp(&found[*x]));
        let values = order.map(|k| found[k]);
        let size = found.amax().max(f64::MIN_POSITIVE);
        let equal = equal.unwrap_or_else(|| [0, 1].map(|k| values[k] - values[k + 1] <= EQUAL * size));
        if equal == [false, true] {
            order.rotate_left(1); // the lone axis becomes the third
        }
        let mut frame = Matrix3::from_columns(&order.map(|k| vectors.column(k).into_owned()));
        if frame.determinant() < 0.0 {
            let third = -frame.column(2);
            frame.set_column(2, &third);
        }
        Self { frame, values: Vector3::from(values), equal }
    }

    /// What the axes leave open.
    pub(super) fn freedom(&self) -> Freedom {
        match self.equal {
            [false, false] => Freedom::HalfTurns,
            [true, true] => Freedom::All,
            _ => Freedom::Axis,
        }
    }
}

/// A symmetric matrix that turns with the body: a sum with fixed unequal weights of all that come to hand, so that two principal values
/// agree by symmetry only.
fn moments(p: &impl Fn(usize, usize, usize, usize) -> f64) -> Matrix3<f64> {
    let square = |m: Matrix3<f64>| m * m.transpose();
    let vector = |f: &dyn Fn(usize) -> f64| {
        let v = Vector3::from_fn(|i, _| f(i + 1));
        v * v.transpose()
    };
    let mut sum = Matrix3::from_fn(|i, k| p(i + 1, 0, k + 1, 0));
    sum += Matrix3::from_fn(|i, k| (1..4).map(|j| p(i + 1, j, k + 1, j)).sum::<f64>()) * 0.731;
    sum += vector(&|i| p(i, 0, 0, 0)) * 1.377;
    sum += vector(&|i| (1..4).map(|j| p(i, j, 0, j)).sum()) * 0.613;
    sum += square(Matrix3::from_fn(|i, j| p(i + 1, j + 1, 0, 0))) * 1.193;
    sum += square(Matrix3::from_fn(|i, j| p(i + 1, 0, 0, j + 1))) * 0.871;
    for k in 1..4 {
        sum += square(Matrix3::from_fn(|i, j| p(i + 1, j + 1, k, 0))) * 0.567;
        sum += square(Matrix3::from_fn(|i, j| p(i + 1, j + 1, 0, k))) * 1.531;
        for l in 1..4 {
            sum += square(Matrix3::from_fn(|i, m| p(i + 1, k, m + 1, l))) * 0.449;
        }
    }
    sum
}
