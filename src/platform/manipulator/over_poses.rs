//! Figures of a platform over many poses, for many platforms. Each follows its definition, but poses that cannot be the
//! worst are skipped.

use nalgebra::{Matrix6, Point3};

use super::{Leg, Manipulator, inverse_condition, jacobian_of_legs};
use crate::geom::{Pose, segment_distance};

/// The rounding error allowed in the bounds below, as a share. They are products of some tens of operations, of
/// matrices with condition numbers below `1 / ILL`.
const ROUNDING: f64 = 1e-9;
/// Below this inverse condition number the inverse has too few digits for a bound.
const ILL: f64 = 1e-6;

/// The least `sigma_6 / sigma_1` of the Jacobian over the poses, with the index of the first pose that has it; `None`
/// without poses.
///
/// With the Frobenius norm `|.|`, `1 / (|J| |J^-1|)` is a lower bound, at most six times smaller. The second bound
/// `1 / (|(J^T J)^4| |(J J^T)^-4|)^(1/8)` is at most 1.26 times smaller. Poses are taken in the order of the first
/// bound. They are skipped from the first one on whose bound exceeds the least value found. Any other pose is skipped
/// if its second bound exceeds this value.
#[must_use]
pub fn worst_conditioning(
    legs: &[Leg; 6],
    poses: &[Pose],
    characteristic_length: f64,
) -> Option<(f64, usize)> {
    let bounded = |(k, pose): (usize, &Pose)| {
        let j = jacobian_of_legs(legs, pose, characteristic_length);
        let inverse = j.try_inverse();
        let bound = inverse.map_or(0.0, |inverse| (1.0 - ROUNDING) / (j.norm() * inverse.norm()));
        if bound >= ILL { (bound, k, j, inverse) } else { (0.0, k, j, None) }
    };
    let bounds: Vec<_> = poses.iter().enumerate().map(bounded).collect();
    let mut order: Vec<usize> = (0..poses.len()).collect();
    order.sort_by(|&a, &b| bounds[a].0.total_cmp(&bounds[b].0).then(a.cmp(&b)));
    let mut worst: Option<(f64, usize)> = None;
    for (bound, k, j, inverse) in order.into_iter().map(|k| &bounds[k]) {
        let passed_over = |least: f64| inverse.is_some_and(|inverse| close_bound(j, &inverse) > least);
        match worst {
            Some((least, _)) if *bound > least => break,
            Some((least, _)) if passed_over(least) => continue,
            _ => {}
        }
        let value = inverse_condition(j);
        if worst.is_none_or(|(least, at)| value < least || value.to_bits() == least.to_bits() && *k < at) {
            worst = Some((value, *k));
        }
    }
    worst
}

/// A lower bound of `sigma_6 / sigma_1`, at most `6^(1/8)` times smaller; zero if there is none.
fn close_bound(j: &Matrix6<f64>, inverse: &Matrix6<f64>) -> f64 {
    // the sixteenth root of the sum of the sixteenth powers of the singular values is at least the largest one
    let largest = |m: &Matrix6<f64>| {
        let scale = m.norm();
        let gram = m.tr_mul(m) / (scale * scale);
        let square = gram * gram;
        scale * (square * square).norm().sqrt().sqrt().sqrt()
    };
    let bound = (1.0 - ROUNDING) / (largest(j) * largest(inverse));
    if bound.is_finite() { bound } else { 0.0 }
}

/// The least distance, over the poses, of the axes of two legs that share no joint; `None` if every two share one.
#[must_use]
pub fn least_axis_distance(m: &Manipulator, poses: &[Pose]) -> Option<f64> {
    let (legs, pairs) = (m.legs(), m.pairs());
    let apart: Vec<(usize, usize)> = (0..6)
        .flat_map(|i| (i + 1..6).map(move |j| (i, j)))
        .filter(|&(i, j)| pairs[i].0 != pairs[j].0 && pairs[i].1 != pairs[j].1)
        .collect();
    let mut least: Option<f64> = None;
    for pose in poses {
        let ends: [[Point3<f64>; 2]; 6] = legs.map(|l| [l.base, pose.transform(&l.platform)]);
        for &(i, j) in &apart {
            // segments are no nearer to each other than their lines
            if least.is_none_or(|d| lines_apart(ends[i], ends[j]) <= d) {
                let d = segment_distance(ends[i], ends[j]);
                least = Some(least.map_or(d, |known| known.min(d)));
            }
        }
    }
    least
}

/// A lower bound of the distance of two lines; zero for parallel ones.
fn lines_apart([p0, p1]: [Point3<f64>; 2], [q0, q1]: [Point3<f64>; 2]) -> f64 {
    let normal = (p1 - p0).cross(&(q1 - q0));
    let square = normal.norm_squared();
    let apart = (q0 - p0).dot(&normal).abs() * (1.0 - ROUNDING);
    if square > 0.0 { apart / square.sqrt() } else { 0.0 }
}

/// Least and greatest leg length over the poses.
#[must_use]
pub fn length_range(legs: &[Leg; 6], poses: &[Pose]) -> Option<[f64; 2]> {
    let all = poses.iter().flat_map(|pose| legs.map(|l| (pose.transform(&l.platform) - l.base).norm()));
    all.fold(None, |range: Option<[f64; 2]>, l| {
        Some(range.map_or([l, l], |[least, greatest]| [least.min(l), greatest.max(l)]))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::manipulator::jacobian;
    use nalgebra::{Rotation3, Vector3};

    fn case() -> (Manipulator, Vec<Pose>) {
        let leg = |i: usize| {
            let t = i as f64;
            Leg {
                base: Point3::new(2.0 * t.cos(), 2.0 * t.sin(), 0.1 * t),
                platform: Point3::new((1.3 * t).sin(), (0.7 * t).cos(), 0.2),
            }
        };
        let at = |k: u32| {
            let x = |step: f64| (f64::from(k) * step).sin() / 4.0;
            Pose {
                rotation: Rotation3::from_euler_angles(x(1.0), x(2.0), x(3.0)),
                position: Vector3::new(x(1.4), x(1.9), 3.0 + x(2.6)),
            }
        };
        (Manipulator::from_legs(std::array::from_fn(leg)).unwrap(), (0..60).map(at).collect())
    }

    #[test]
    fn passing_over_poses_changes_nothing() {
        let (m, poses) = case();
        assert!(poses.len() > 10);
        let length = m.platform_rms_radius();
        let all: Vec<f64> = poses.iter().map(|p| inverse_condition(&jacobian(&m, p, length))).collect();
        let least = all.iter().copied().fold(f64::INFINITY, f64::min);
        let (value, k) = worst_conditioning(&m.legs(), &poses, length).unwrap();
        assert_eq!((value.to_bits(), all[k].to_bits()), (least.to_bits(), least.to_bits()));
        for (pose, value) in poses.iter().zip(&all) {
            let j = jacobian(&m, pose, length);
            let bound = close_bound(&j, &j.try_inverse().unwrap());
            assert!(bound <= *value && bound >= value / 1.26);
        }
        assert!(worst_conditioning(&m.legs(), &[], length).is_none());
        let shared = |i: usize, j: usize| {
            let (a, b) = (m.pairs()[i], m.pairs()[j]);
            a.0 == b.0 || a.1 == b.1
        };
        let pairs = |pose: &Pose| {
            let ends = m.legs().map(|l| [l.base, pose.transform(&l.platform)]);
            (0..6)
                .flat_map(|i| (i + 1..6).map(move |j| (i, j)))
                .filter(|(i, j)| !shared(*i, *j))
                .map(|(i, j)| segment_distance(ends[i], ends[j]))
                .fold(f64::INFINITY, f64::min)
        };
        let least = poses.iter().map(pairs).fold(f64::INFINITY, f64::min);
        assert_eq!(least_axis_distance(&m, &poses).map(f64::to_bits), Some(least.to_bits()));
    }
}
