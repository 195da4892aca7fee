//! Figures of a platform over many poses, for many platforms: each is what its definition says, and poses that cannot be the worst are passed over.

use nalgebra::{Matrix6, Point3};

use crate::geom::{Pose, segment_distance};
use crate::manipulator::{Leg, Manipulator, inverse_condition, jacobian_of_legs};

/// What rounding may take from the bounds below, as a share: they are products of some tens of operations.
const ROUNDING: f64 = 1e-9;

/// The least `sigma_6 / sigma_1` of the Jacobian over the poses, and the number of the first pose that has it; `None` without poses.
///
/// `1 / (|J| |J^-1|)` in Frobenius norms is never above it and at most six times below. Poses are taken in the order of that bound, and those from the first
/// one on whose bound exceeds the least value found are passed over.
pub(super) fn worst_conditioning(
    legs: &[Leg; 6],
    poses: &[Pose],
    characteristic_length: f64,
) -> Option<(f64, usize)> {
    let bounded = |(k, pose): (usize, &Pose)| {
        let j = jacobian_of_legs(legs, pose, characteristic_length);
        (bound(&j), k)
    };
    let mut order: Vec<(f64, usize)> = poses.iter().enumerate().map(bounded).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut worst: Option<(f64, usize)> = None;
    for (bound, k) in order {
        if worst.is_some_and(|(least, _)| bound > least) {
            break;
        }
        let value = inverse_condition(&jacobian_of_legs(legs, &poses[k], characteristic_length));
        if worst.is_none_or(|(least, at)| value < least || value.to_bits() == least.to_bits() && k < at) {
            worst = Some((value, k));
        }
    }
    worst
}

/// A number that `sigma_6 / sigma_1` is not below; zero where there is none.
fn bound(j: &Matrix6<f64>) -> f64 {
    let Some(inverse) = j.try_inverse() else { return 0.0 };
    let bound = (1.0 - ROUNDING) / (j.norm() * inverse.norm());
    if bound.is_finite() { bound } else { 0.0 }
}

/// The least distance over the poses of the axes of two legs that share no joint; `None` where every two share one.
pub(super) fn least_axis_distance(m: &Manipulator, poses: &[Pose]) -> Option<f64> {
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

/// A number that the distance of two lines is not below; zero for parallel ones.
fn lines_apart([p0, p1]: [Point3<f64>; 2], [q0, q1]: [Point3<f64>; 2]) -> f64 {
    let normal = (p1 - p0).cross(&(q1 - q0));
    let square = normal.norm_squared();
    let apart = (q0 - p0).dot(&normal).abs() * (1.0 - ROUNDING);
    if square > 0.0 { apart / square.sqrt() } else { 0.0 }
}

/// Least and greatest leg length over the poses.
pub(super) fn length_range(legs: &[Leg; 6], poses: &[Pose]) -> Option<[f64; 2]> {
    let all = poses.iter().flat_map(|pose| legs.map(|l| (pose.transform(&l.platform) - l.base).norm()));
    all.fold(None, |range: Option<[f64; 2]>, l| {
        Some(range.map_or([l, l], |[least, greatest]| [least.min(l), greatest.max(l)]))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{Format, parse};
    use crate::manipulator::jacobian;

    fn case() -> (Manipulator, Vec<Pose>) {
        let text = include_str!("../../designs/presets/bench-l16.toml");
        let (design, _) = parse(text, Format::Toml).unwrap();
        let poses = design.workspace_or_default().sample(&design.home_or_default());
        (design.manipulator().clone(), poses)
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
            assert!(bound(&j) <= *value && bound(&j) >= value / 6.001);
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
