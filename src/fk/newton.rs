//! Newton's method on the leg equations in the pose itself: `R <- R exp([w]x)`, `p <- p + d`, over `C`.

use nalgebra::{SMatrix, SVector, Vector3};
use num_complex::Complex64;

use num::small::{bounded_svd, singular_values};
use platform::geom::ComplexPose;
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// Singular values below this fraction of the largest count as zero on a curve of poses.
const RANK: f64 = 1e-6;
/// Length of the step along a suspected curve, in design sizes and radians.
const STRIDE: f64 = 1e-2;

/// A displacement: position over design size, rotation vector.
pub(super) type Twist = SVector<Complex64, 6>;
type Jacobian = SMatrix<Complex64, 6, 6>;

/// Derivative of the leg equations over size squared, and their values.
fn linearised(m: &Manipulator, s: &SquaredLegLengths, pose: &ComplexPose) -> (Jacobian, Twist) {
    let size = m.size();
    let mut jacobian = Jacobian::zeros();
    let mut defect = Twist::zeros();
    let (r, p) = (&pose.rotation, &pose.position);
    for (i, (leg, target)) in m.legs().iter().zip(s.get()).enumerate() {
        let (b, a) = (&leg.platform, &leg.base);
        let entry = |k: usize| r[(k, 0)] * b.x + r[(k, 1)] * b.y + r[(k, 2)] * b.z;
        let arm = Vector3::new(entry(0), entry(1), entry(2));
        let d = Vector3::new(arm.x + p.x - a.x, arm.y + p.y - a.y, arm.z + p.z - a.z);
        let moment = arm.cross(&d);
        for k in 0..3 {
            jacobian[(i, k)] = d[k] * 2.0 / size;
            jacobian[(i, 3 + k)] = moment[k] * 2.0 / (size * size);
        }
        defect[i] = (d.dot(&d) - target) / (size * size);
    }
    (jacobian, defect)
}

/// The pose displaced by `-twist`; `None` when the rotation is too large for its Cayley transform.
fn displaced(pose: &ComplexPose, twist: &Twist, size: f64) -> Option<ComplexPose> {
    let turn = Vector3::new(twist[3], twist[4], twist[5]);
    let shift = Vector3::new(twist[0], twist[1], twist[2]) * Complex64::new(size, 0.0);
    pose.less_step(&turn, &shift)
}

/// Solves `A X = B` by elimination with partial pivoting; `None` for a column of zeros or NaN.
#[inline]
pub(super) fn solve<const N: usize>(
    mut a: Jacobian,
    mut b: SMatrix<Complex64, 6, N>,
) -> Option<SMatrix<Complex64, 6, N>> {
    for k in 0..6 {
        let best = (k..6).max_by(|i, j| a[(*i, k)].norm_sqr().total_cmp(&a[(*j, k)].norm_sqr()))?;
        a.swap_rows(k, best);
        b.swap_rows(k, best);
        let inverse = a[(k, k)].inv();
        if !inverse.is_finite() {
            return None;
        }
        let mut factors = [Complex64::ZERO; 6];
        for i in k + 1..6 {
            factors[i] = a[(i, k)] * inverse;
            for c in 0..N {
                b[(i, c)] = b[(i, c)] - factors[i] * b[(k, c)];
            }
        }
        for j in k + 1..6 {
            let top = a[(k, j)];
            for i in k + 1..6 {
                a[(i, j)] -= factors[i] * top;
            }
        }
        for c in 0..N {
            b[(k, c)] *= inverse;
        }
        // the elimination needs the pivot row divided by the pivot
        for j in k + 1..6 {
            a[(k, j)] *= inverse;
        }
    }
    for k in (0..5).rev() {
        for j in k + 1..6 {
            for c in 0..N {
                b[(k, c)] = b[(k, c)] - a[(k, j)] * b[(j, c)];
            }
        }
    }
    Some(b)
}

/// Newton's method; keeps the better of each step's two poses, so it never makes a residual worse.
pub(super) fn refine(m: &Manipulator, s: &SquaredLegLengths, pose: &ComplexPose) -> ComplexPose {
    refine_to(m, s, pose, 0.0).0
}

/// [`refine`] that ends at a residual of `floor`, which is rounding; the pose and its residual.
pub(super) fn refine_to(
    m: &Manipulator,
    s: &SquaredLegLengths,
    pose: &ComplexPose,
    floor: f64,
) -> (ComplexPose, f64) {
    let mut best = *pose;
    let mut residual = best.residual(m, s);
    for _ in 0..4 {
        if residual <= floor {
            break;
        }
        let (jacobian, defect) = linearised(m, s, &best);
        let Some(twist) = solve(jacobian, defect) else { break };
        let Some(next) = displaced(&best, &twist, m.size()) else { break };
        let r = next.residual(m, s);
        if !(r < residual) {
            break;
        }
        best = next;
        residual = r;
    }
    (best, residual)
}

/// The direction in which the leg equations are flattest, of norm one.
fn flattest(m: &Manipulator, s: &SquaredLegLengths, pose: &ComplexPose) -> Option<Twist> {
    let v = bounded_svd(&linearised(m, s, pose).0)?.v_t?;
    Some(v.row(5).adjoint())
}

/// Poses at `distance` from `pose` on both sides along the flattest direction, real and imaginary. Newton's method
/// reaches each of two close roots about `pose` from one of these.
pub(super) fn beside(
    m: &Manipulator,
    s: &SquaredLegLengths,
    pose: &ComplexPose,
    distance: f64,
) -> Vec<ComplexPose> {
    let Some(v) = flattest(m, s, pose) else { return Vec::new() };
    let unit = [Complex64::ONE, -Complex64::ONE, Complex64::I, -Complex64::I];
    unit.iter().filter_map(|u| displaced(pose, &(v * (u * distance)), m.size())).collect()
}

/// Whether poses form a curve through `pose`, numerically. After a step along the flattest direction, Gauss-Newton
/// steps in the other directions lead back to the equations.
///
/// At an isolated multiple root they cannot. The equations are off by the square (or a higher power) of the step, in
/// the direction that the Jacobian does not reach.
pub(super) fn on_a_curve(m: &Manipulator, s: &SquaredLegLengths, pose: &ComplexPose) -> bool {
    let size = m.size();
    let Some(v) = flattest(m, s, pose) else { return false };
    let Some(mut here) = displaced(pose, &(v * Complex64::new(STRIDE, 0.0)), size) else { return false };
    for _ in 0..6 {
        let (jacobian, defect) = linearised(m, s, &here);
        let Some(svd) = bounded_svd(&jacobian) else { return false };
        let Ok(twist) = svd.solve(&defect, RANK * svd.singular_values[0]) else { return false };
        let Some(next) = displaced(&here, &twist, size) else { return false };
        here = next;
    }
    let singular = singular_values(&linearised(m, s, &here).0);
    let flat = singular.is_some_and(|values| values[5] < RANK * values[0]);
    let scale = here.position.iter().map(|z| z.norm() / size).fold(1.0, f64::max);
    flat && here.residual(m, s) < 1e-12 * scale * scale && here.distance(pose, size) > 0.1 * STRIDE
}
