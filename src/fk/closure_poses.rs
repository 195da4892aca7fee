//! Poses from the exact roots of the closure polynomial.

use nalgebra::{Matrix3, Vector3};
use num_complex::Complex64;

use crate::distance::{closure_polynomial, plans};
use num::poly::complex_roots;
use platform::geom::{ComplexPose, trilaterate};
use platform::manipulator::{Manipulator, SquaredLegLengths};
use platform::topology::{JointIndex, Sequence};

/// Bits to which roots are enclosed before they are rounded.
const BITS: u64 = 60;
/// Residual below which an orientation is taken besides the best one.
const CLOSE: f64 = 1e-6;

/// Candidates for all finite poses, from the roots of the exact closure polynomial.
///
/// The first sequence that has a polynomial gives it. Each root gives the places of the joints with that length. Kept
/// are the orientation of the steps that closes best and all others that close to a millionth (mirror images).
/// Candidates are neither refined nor proved. The list is empty when more than one virtual leg is needed, or no
/// sequence has a polynomial.
///
/// Takes milliseconds to tenths of a second: for problems on which floating point fails because roots are close
/// together or coefficients range widely.
#[must_use]
pub fn closure_candidates(m: &Manipulator, s: &SquaredLegLengths) -> Vec<ComplexPose> {
    let list = plans(m, 1).unwrap_or_default();
    let first = list.iter().find_map(|plan| closure_polynomial(m, s, plan).ok());
    let Some(closure) = first else { return Vec::new() };
    let Ok(roots) = complex_roots(&closure.polynomial, BITS) else { return Vec::new() };
    let mut out = Vec::new();
    for root in roots {
        let mut poses = over(m, s, &closure.sequence, root.to_complex64());
        poses.sort_by(|x, y| x.0.total_cmp(&y.0));
        let taken = poses.iter().enumerate().filter(|(k, p)| *k == 0 || p.0 < CLOSE);
        out.extend(taken.map(|(_, p)| p.1));
    }
    out
}

/// The poses of all eight orientations with their residuals, fewer where a base is singular.
fn over(m: &Manipulator, s: &SquaredLegLengths, plan: &Sequence, x: Complex64) -> Vec<(f64, ComplexPose)> {
    let virtual_leg = plan.virtual_legs.first().copied();
    let squared = |a: JointIndex, b: JointIndex| match a.across(b) {
        None => Some(Complex64::from((a.point(m) - b.point(m)).norm_squared())),
        pair if pair == virtual_leg => Some(x),
        Some(pair) => m.pairs().iter().position(|l| *l == pair).map(|i| Complex64::from(s.get()[i])),
    };
    let mut partial: Vec<Vec<(JointIndex, Vector3<Complex64>)>> = vec![Vec::new()];
    for step in plan.unoriented() {
        let mut next = Vec::new();
        for placed in &partial {
            let position = |j: JointIndex| {
                let moved = placed.iter().find(|p| p.0 == j).map(|p| p.1);
                moved.unwrap_or_else(|| j.point(m).coords.map(Complex64::from))
            };
            let [Some(a), Some(b), Some(c)] = step.from.map(|j| squared(j, step.place)) else { continue };
            let both = trilaterate(&step.from.map(position), [a, b, c]).into_iter().flatten();
            next.extend(both.map(|p| placed.iter().copied().chain([(step.place, p)]).collect::<Vec<_>>()));
        }
        partial = next;
    }
    let poses = partial.iter().filter_map(|placed| pose(m, placed));
    poses.map(|p| (p.residual(m, s), p)).filter(|p| p.0.is_finite()).collect()
}

/// The pose that takes three joints of one body to their places in the frame of the other.
fn pose(m: &Manipulator, placed: &[(JointIndex, Vector3<Complex64>)]) -> Option<ComplexPose> {
    let [(a, pa), (b, pb), (c, pc)] = placed else { return None };
    let frame = |u: Vector3<Complex64>, v: Vector3<Complex64>| Matrix3::from_columns(&[u, v, u.cross(&v)]);
    let own = |j: &JointIndex| j.point(m).coords.map(Complex64::from);
    let from = frame(own(b) - own(a), own(c) - own(a));
    let rotation = frame(pb - pa, pc - pa) * from.try_inverse()?;
    let position = pa - rotation * own(a);
    Some(match a {
        JointIndex::Platform(_) => ComplexPose { rotation, position },
        // the base was placed in the platform's frame
        JointIndex::Base(_) => {
            let back = rotation.transpose();
            ComplexPose { rotation: back, position: -(back * position) }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FkOptions, ForwardKinematics, Homotopy};
    use nalgebra::Point3;
    use platform::topology::catalogue;

    #[test]
    fn candidates_from_exact_roots_are_the_poses() {
        // trilaterable, decoupled, coupled, both bodies planar
        for number in [7, 3, 22, 34] {
            let t = catalogue()[number - 1].topology();
            let place = |k: usize, flat: bool| {
                let k = k as f64;
                let z = if flat { 0.0 } else { (5.0 * k).sin() };
                Point3::new((1.3 * k).cos() + 0.1 * k, (1.7 * k).sin(), z)
            };
            let flat = number == 34;
            let base = (0..t.base_joints()).map(|k| place(k, flat)).collect();
            let platform = (0..t.platform_joints()).map(|k| place(k + 7, flat)).collect();
            let m = Manipulator::try_new(base, platform, t.legs()).unwrap();
            let s = SquaredLegLengths::try_new([3.1, 2.9, 3.3, 2.7, 3.0, 3.2]).unwrap();
            let found = Homotopy.solve(&m, &s, &FkOptions::default()).unwrap();
            let candidates = closure_candidates(&m, &s);
            assert!(candidates.len() >= found.roots.len(), "T{number:02}: {}", candidates.len());
            let apart = |p: &ComplexPose, q: &ComplexPose| {
                (p.rotation - q.rotation).map(Complex64::norm).amax()
                    + (p.position - q.position).map(Complex64::norm).amax()
            };
            for r in &found.roots {
                let scale =
                    r.pose.position.map(Complex64::norm).amax() + r.pose.rotation.map(Complex64::norm).amax();
                let near = candidates.iter().map(|c| apart(c, &r.pose)).fold(f64::INFINITY, f64::min);
                assert!(near < 1e-5 * scale, "T{number:02}: {near}");
            }
        }
    }

    #[test]
    fn without_a_sequence_there_are_none() {
        let joint = |k: usize| Point3::new((k as f64).cos(), (2.0 * k as f64).sin(), (3.0 * k as f64).cos());
        let (base, platform) = ((0..6).map(joint).collect(), (7..13).map(joint).collect());
        let m = Manipulator::try_new(base, platform, std::array::from_fn(|i| (i, i))).unwrap();
        let s = SquaredLegLengths::try_new([2.0; 6]).unwrap();
        assert!(closure_candidates(&m, &s).is_empty());
    }
}
