//! Straight paths in all directions from a pose, and the part of the surrounding space that they reach.

use nalgebra::Vector3;

use super::{FARTHEST, Reach, StraightPath};
use crate::requirements::Limit;
use platform::geom::Pose;

/// A path in one direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeRay {
    /// Unit vector, base frame.
    pub direction: Vector3<f64>,
    /// Free travel in this direction: design units, or radians of a rotation about it.
    pub free: f64,
    /// The requirement that ends it; `None` if nothing binds within ten sizes, or half a turn.
    pub binding: Option<Limit>,
}

/// Unit vectors spread evenly over the sphere: points of a spiral at equal steps of height, each rotated by the golden
/// angle (Swinbank, Purser 2006).
fn spread(count: usize) -> impl Iterator<Item = Vector3<f64>> {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..count).map(move |k| {
        let z = 1.0 - (2 * k + 1) as f64 / count as f64;
        let (s, c) = (golden * k as f64).sin_cos();
        let r = (1.0 - z * z).max(0.0).sqrt();
        Vector3::new(r * c, r * s, z)
    })
}

/// Steps of each half width of a box in a search for the largest one, and rounds in which they become finer.
const BOX_STEPS: (usize, usize) = (24, 4);

impl Reach<'_> {
    /// Paths from a pose at its orientation, in `count` directions spread evenly; where the pose is not allowed all of
    /// them end at once.
    #[must_use]
    pub fn shifts(&self, from: &Pose, count: usize) -> Vec<FreeRay> {
        spread(count).map(|d| self.ray(from, &d, false)).collect()
    }

    /// Rotations at the position of a pose, about `count` axes spread evenly.
    #[must_use]
    pub fn turns(&self, from: &Pose, count: usize) -> Vec<FreeRay> {
        spread(count).map(|d| self.ray(from, &d, true)).collect()
    }

    /// The straight path from a pose along a unit vector, or the rotation about it.
    #[must_use]
    pub fn ray(&self, from: &Pose, direction: &Vector3<f64>, is_turn: bool) -> FreeRay {
        let (velocity, turn) =
            if is_turn { (Vector3::zeros(), *direction) } else { (*direction, Vector3::zeros()) };
        let most = if is_turn { std::f64::consts::PI } else { FARTHEST * self.size };
        let found = self.along(&StraightPath { start: *from, velocity, turn, pivot: Vector3::zeros() }, most);
        FreeRay { direction: *direction, free: found.amount, binding: found.binding }
    }
}

/// The volume that evenly spread rays reach, `4 pi / 3` times the mean of the cubes of their lengths. The second value
/// is the difference between the results of even and odd rays, as a share.
#[must_use]
pub fn volume_of_rays(rays: &[FreeRay]) -> (f64, f64) {
    let cubes = |from: usize, by: usize| {
        let own: Vec<f64> = rays.iter().skip(from).step_by(by).map(|r| r.free.powi(3)).collect();
        own.iter().sum::<f64>() / own.len().max(1) as f64
    };
    let (mean, halves) = (cubes(0, 1), [cubes(0, 2), cubes(1, 2)]);
    let doubt = if mean > 0.0 { (halves[0] - halves[1]).abs() / mean } else { 0.0 };
    (4.0 / 3.0 * std::f64::consts::PI * mean, doubt)
}

/// Half widths of the box of greatest volume about the pose, along the axes of the base frame, that contains no end of
/// a ray. The search refines a grid.
#[must_use]
pub fn largest_box_within(rays: &[FreeRay]) -> [f64; 3] {
    let reached = |k: usize| rays.iter().map(|r| (r.free * r.direction[k]).abs()).fold(0.0, f64::max);
    let most = [0, 1, 2].map(reached);
    // the greatest third half width for the other two
    let third = |a: f64, b: f64| {
        let blocks = |r: &&FreeRay| {
            let d = r.direction.abs();
            a > r.free * d.x && b > r.free * d.y
        };
        rays.iter().filter(blocks).map(|r| r.free * r.direction.z.abs()).fold(most[2], f64::min)
    };
    let mut best = [0.0; 3];
    let (mut low, mut high) = ([0.0; 2], [most[0], most[1]]);
    for _ in 0..BOX_STEPS.1 {
        let step: [f64; 2] = std::array::from_fn(|k| (high[k] - low[k]) / BOX_STEPS.0 as f64);
        for i in 1..=BOX_STEPS.0 {
            for j in 1..=BOX_STEPS.0 {
                let (a, b) = (low[0] + step[0] * i as f64, low[1] + step[1] * j as f64);
                let c = third(a, b);
                if a * b * c > best.iter().product() {
                    best = [a, b, c];
                }
            }
        }
        for k in 0..2 {
            (low[k], high[k]) = ((best[k] - step[k]).max(0.0), (best[k] + step[k]).min(most[k]));
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rays(free: impl Fn(&Vector3<f64>) -> f64, count: usize) -> Vec<FreeRay> {
        spread(count).map(|d| FreeRay { direction: d, free: free(&d), binding: None }).collect()
    }

    #[test]
    fn volumes_and_boxes_of_known_bodies_are_found() {
        let ball = rays(|_| 2.0, 6000);
        let (volume, doubt) = volume_of_rays(&ball);
        assert!((volume / (32.0 / 3.0 * std::f64::consts::PI) - 1.0).abs() < 1e-12 && doubt < 1e-12);
        // the largest box in a ball is a cube with its corners on the sphere
        let cube = largest_box_within(&ball);
        assert!(cube.iter().all(|h| (h * 3.0_f64.sqrt() / 2.0 - 1.0).abs() < 0.08), "{cube:?}");
        // a box of rays is its own largest box
        let half = [3.0, 1.0, 2.0];
        let block = rays(|d| (0..3).map(|k| half[k] / d[k].abs()).fold(f64::INFINITY, f64::min), 4000);
        let found = largest_box_within(&block);
        assert!((0..3).all(|k| (found[k] / half[k] - 1.0).abs() < 0.08), "{found:?}");
        let (volume, doubt) = volume_of_rays(&block);
        assert!((volume / 48.0 - 1.0).abs() < 0.01 && doubt < 0.02, "{volume} {doubt}");
        assert!(largest_box_within(&rays(|_| 0.0, 50)).iter().all(|half| half.to_bits() == 0));
    }
}
