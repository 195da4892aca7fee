//! Newton's method on the leg equations in the pose itself: `R <- R exp([w]x)`, `p <- p + d`, over `C`.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use num_complex::Complex64;

use crate::geom::ComplexPose;
use crate::manipulator::{Manipulator, SquaredLegLengths};

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
    for (i, (leg, target)) in m.legs().iter().zip(s.get()).enumerate() {
        let lift = |v: Vector3<f64>| v.map(|x| Complex64::new(x, 0.0));
        let arm = pose.rotation * lift(leg.platform.coords);
        let d = arm + pose.position - lift(leg.base.coords);
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
    // Cayley transform of the rotation vector: exactly orthogonal over C
    let w = Vector3::new(twist[3], twist[4], twist[5]) * Complex64::new(-0.5, 0.0);
    let n = Complex64::ONE + w.dot(&w);
    if !(n.norm() > 0.1) {
        return None;
    }
    let (two, one) = (Complex64::new(2.0, 0.0), Complex64::ONE);
    let cross = w.cross_matrix();
    let turn = (Matrix3::identity() * (one - w.dot(&w)) + (w * w.transpose()) * two + cross * two) / n;
    let shift = Vector3::new(twist[0], twist[1], twist[2]) * Complex64::new(size, 0.0);
    let rotation = reorthogonalised(&(turn * pose.rotation));
    Some(ComplexPose { rotation, position: pose.position - shift })
}

/// One step of `R <- R (3 I - R^T R) / 2`, which squares the defect of `R^T R = I` (over `C` as well).
fn reorthogonalised(r: &Matrix3<Complex64>) -> Matrix3<Complex64> {
    let gram = r.transpose() * r;
    let three = Matrix3::identity() * Complex64::new(3.0, 0.0);
    r * (three - gram) * Complex64::new(0.5, 0.0)
}

/// Newton's method; keeps the better of each step's two poses, so it never makes a residual worse.
pub(super) fn refine(m: &Manipulator, s: &SquaredLegLengths, pose: &ComplexPose) -> ComplexPose {
    let mut best = *pose;
    let mut residual = best.residual(m, s);
    for _ in 0..4 {
        let (jacobian, defect) = linearised(m, s, &best);
        let Some(twist) = jacobian.lu().solve(&defect) else { break };
        let Some(next) = displaced(&best, &twist, m.size()) else { break };
        let r = next.residual(m, s);
        if !(r < residual) {
            break;
        }
        best = next;
        residual = r;
    }
    best
}

/// The direction in which the leg equations are flattest, of norm one.
fn flattest(m: &Manipulator, s: &SquaredLegLengths, pose: &ComplexPose) -> Option<Twist> {
    let v = linearised(m, s, pose).0.try_svd(false, true, f64::EPSILON, 200)?.v_t?;
    Some(v.row(5).adjoint())
}

/// Poses at `distance` from `pose` on both sides along the flattest direction, real and imaginary: of two close roots
/// about `pose`, Newton's method reaches each from one of these.
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

/// Whether poses form a curve through `pose`, numerically: from a step along the flattest direction, Gauss-Newton
/// steps in the other directions lead back to the equations.
///
/// At an isolated multiple root they cannot: the equations are off by the square (or a higher power) of the step
/// in the direction that the Jacobian does not reach.
pub(super) fn on_a_curve(m: &Manipulator, s: &SquaredLegLengths, pose: &ComplexPose) -> bool {
    let size = m.size();
    let Some(v) = flattest(m, s, pose) else { return false };
    let Some(mut here) = displaced(pose, &(v * Complex64::new(STRIDE, 0.0)), size) else { return false };
    for _ in 0..6 {
        let (jacobian, defect) = linearised(m, s, &here);
        let Some(svd) = jacobian.try_svd(true, true, f64::EPSILON, 200) else { return false };
        let Ok(twist) = svd.solve(&defect, RANK * svd.singular_values[0]) else { return false };
        let Some(next) = displaced(&here, &twist, size) else { return false };
        here = next;
    }
    let singular = linearised(m, s, &here).0.try_svd(false, false, f64::EPSILON, 200);
    let flat = singular.is_some_and(|svd| svd.singular_values[5] < RANK * svd.singular_values[0]);
    let scale = here.position.iter().map(|z| z.norm() / size).fold(1.0, f64::max);
    flat && here.residual(m, s) < 1e-12 * scale * scale && here.distance(pose, size) > 0.1 * STRIDE
}
