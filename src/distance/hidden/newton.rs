//! Newton's method on six legs, and how the pose changes with one of the lengths.

use nalgebra::{SMatrix, Vector3};
use num_complex::Complex64;

use super::circle::complex;
use super::legs::HiddenLeg;
use crate::geom::ComplexPose;

/// Steps at most.
const STEPS: usize = 8;
/// After a step below this, of the rotation and relative to the position, the next would be rounding.
const SMALL: f64 = 1e-8;

/// Steps below this that do not become smaller are rounding.
const ROUNDED: f64 = 1e-4;

/// Rotation about three axes, shift, by unit changes: the columns are right-hand sides.
type Columns = SMatrix<Complex64, 6, 2>;
type Jacobian = SMatrix<Complex64, 6, 6>;

/// A pose with its derivative.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moving {
    pub(super) pose: ComplexPose,
    /// Rotation vector and shift when the squared length of the chosen leg grows by one.
    rate: [Vector3<Complex64>; 2],
}

impl Moving {
    /// Squared length of a leg less its own, and the derivative.
    pub(super) fn gap(&self, leg: &HiddenLeg) -> (Complex64, Complex64) {
        let (arm, d) = arm_and_leg(&self.pose, leg);
        (d.dot(&d) - leg.s, d.dot(&(self.rate[0].cross(&arm) + self.rate[1])) * 2.0)
    }
}

/// The solution near a pose; `None` where the Jacobian is singular or the steps do not become small.
pub(super) fn refined(legs: &[HiddenLeg; 6], pose: ComplexPose, grows: usize) -> Option<Moving> {
    let mut pose = pose;
    let mut before = f64::INFINITY;
    for _ in 0..STEPS {
        let mut jacobian = Jacobian::zeros();
        let mut right = Columns::zeros();
        for (i, leg) in legs.iter().enumerate() {
            let (arm, d) = arm_and_leg(&pose, leg);
            let moment = arm.cross(&d);
            for c in 0..3 {
                jacobian[(i, c)] = moment[c] * 2.0;
                jacobian[(i, 3 + c)] = d[c] * 2.0;
            }
            right[(i, 0)] = d.dot(&d) - leg.s;
        }
        right[(grows, 1)] = Complex64::ONE;
        let x = solved(jacobian, right)?;
        let column = |c: usize| [0, 3].map(|r| Vector3::new(x[(r, c)], x[(r + 1, c)], x[(r + 2, c)]));
        let step = column(0);
        let norm = |v: &Vector3<Complex64>| v.iter().map(Complex64::norm_sqr).sum::<f64>().sqrt();
        let size = norm(&step[0]).max(norm(&step[1]) / (1.0 + norm(&pose.position)));
        pose = pose.less_step(&step[0], &step[1])?;
        // the numbers of poses far out cancel: their steps end at the rounding of those
        if size < SMALL || (size < ROUNDED && size > 0.3 * before) {
            return Some(Moving { pose, rate: column(1) });
        }
        before = size;
    }
    None
}

fn arm_and_leg(pose: &ComplexPose, leg: &HiddenLeg) -> (Vector3<Complex64>, Vector3<Complex64>) {
    let arm = pose.rotation * complex(&leg.platform);
    (arm, arm + pose.position - complex(&leg.base))
}

/// Elimination with partial pivoting; `None` for a singular matrix.
fn solved(mut a: Jacobian, mut b: Columns) -> Option<Columns> {
    for k in 0..6 {
        let best = (k..6).max_by(|i, j| a[(*i, k)].norm_sqr().total_cmp(&a[(*j, k)].norm_sqr()))?;
        a.swap_rows(k, best);
        b.swap_rows(k, best);
        let inverse = a[(k, k)].inv();
        if !inverse.is_finite() {
            return None;
        }
        for i in (0..6).filter(|i| *i != k) {
            let factor = a[(i, k)] * inverse;
            for j in k + 1..6 {
                let top = a[(k, j)];
                a[(i, j)] -= factor * top;
            }
            for j in 0..2 {
                let top = b[(k, j)];
                b[(i, j)] -= factor * top;
            }
        }
    }
    for k in 0..6 {
        for j in 0..2 {
            b[(k, j)] /= a[(k, k)];
        }
    }
    b.iter().all(|z| z.is_finite()).then_some(b)
}
