//! The singular pose nearest to a given one.
//!
//! Poses are `y = (d, L w)` from the given one: shift `d` of the platform origin and rotation vector `w` in the base
//! frame, a radian counted as a length `L`. The singular poses are the zeros of `F(y) = det J`, and the nearest one is
//! sought by `y <- g (g . y - F) / |g|^2` with the gradient `g` of `F`: the foot of the given pose on the tangent plane
//! of the level of `F` (Rackwitz, Fiessler 1978). It starts from the first changes of sign on straight paths in many
//! directions. The answer is a local minimum of the distance.

use nalgebra::{Rotation3, Vector3, Vector6};

use super::path::{SignsAlong, signs_along};
use num::Rng;
use platform::geom::{Pose, turn_between};
use platform::manipulator::{Manipulator, leg_determinant};

/// Options of the search for the nearest singular pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearestPoseSearch {
    /// A radian counts as this length.
    pub length: f64,
    /// Directions of straight paths, besides those along the twelve axes.
    pub directions: usize,
    /// The seed.
    pub seed: u64,
}

/// A singular pose near a given one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearestSingularPose {
    /// The pose.
    pub pose: Pose,
    /// `sqrt(|p - p'|^2 + (L angle)^2)`.
    pub distance: f64,
    /// No small step on singular poses leads nearer, to rounding.
    pub is_stationary: bool,
    /// A pose at which `det J = 0` is proved to be within this distance of the pose; `None`: not proved.
    pub proved_within: Option<f64>,
}

/// Ways are followed up to so many sizes of the design, and half a turn.
const FARTHEST: f64 = 3.0;
/// Values of `det J` on each way.
const STEPS: usize = 60;
/// Halvings between two values of opposite signs.
const HALVINGS: usize = 30;
/// Steps to the foot of the given pose.
const ROUNDS: usize = 100;
/// Starts from which the foot is sought, those nearest to the given pose.
const STARTS: usize = 12;
/// Share of the size by which poses differ in difference quotients.
const DIFFERENCE: f64 = 1e-6;
/// A foot is found when it moves by less than this share of the size.
const SETTLED: f64 = 1e-11;
/// The sine of the angle between the way back and the gradient, at a nearest pose.
const STATIONARY: f64 = 1e-5;

/// The singular pose nearest to `from` of those that a search finds; `None` where no way meets one.
#[must_use]
pub fn nearest_singular_pose(
    m: &Manipulator,
    from: &Pose,
    search: &NearestPoseSearch,
) -> Option<NearestSingularPose> {
    let prove = |from: &Pose, to: &Pose| {
        let along: SignsAlong = signs_along(m, from, to);
        along.changes().next().is_some()
    };
    nearest_zero(&|pose| leg_determinant(m, pose), Some(&prove), m.size(), from, search)
}

/// Whether a function is proved to change its sign between two poses.
pub type ChangeOfSign<'a> = &'a dyn Fn(&Pose, &Pose) -> bool;

/// The nearest zero of any function of poses that vanishes at the singular ones. Paths end where it is not finite. A
/// pose is proved only if `prove` finds a change of sign.
#[must_use]
pub fn nearest_zero(
    value: &dyn Fn(&Pose) -> f64,
    prove: Option<ChangeOfSign<'_>>,
    size: f64,
    from: &Pose,
    search: &NearestPoseSearch,
) -> Option<NearestSingularPose> {
    let around = Around { of: value, prove, size, from, length: search.length };
    let mut starts: Vec<Vector6<f64>> =
        directions(search).into_iter().filter_map(|direction| around.first_zero(&direction)).collect();
    starts.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
    let found = starts.into_iter().take(STARTS).map(|start| around.foot(start));
    found.min_by(|a, b| a.distance.total_cmp(&b.distance))
}

/// Unit vectors along the axes and random ones.
fn directions(search: &NearestPoseSearch) -> Vec<Vector6<f64>> {
    let axes = (0..12).map(|k| Vector6::ith(k / 2, if k % 2 == 0 { 1.0 } else { -1.0 }));
    let mut rng = Rng::new(search.seed);
    let random = (0..search.directions).map(|_| Vector6::from_fn(|_, _| rng.normal()).normalize());
    axes.chain(random.collect::<Vec<_>>()).collect()
}

/// Poses around the given one.
struct Around<'a> {
    of: &'a dyn Fn(&Pose) -> f64,
    prove: Option<ChangeOfSign<'a>>,
    /// The size of the design.
    size: f64,
    from: &'a Pose,
    length: f64,
}

impl Around<'_> {
    fn pose(&self, y: &Vector6<f64>) -> Pose {
        let turn: Vector3<f64> = y.fixed_rows::<3>(3) / self.length;
        let shift: Vector3<f64> = y.fixed_rows::<3>(0).into();
        Pose { rotation: Rotation3::new(turn) * self.from.rotation, position: self.from.position + shift }
    }

    fn value(&self, y: &Vector6<f64>) -> f64 {
        (self.of)(&self.pose(y))
    }

    fn gradient(&self, y: &Vector6<f64>) -> Vector6<f64> {
        let step = DIFFERENCE * self.size;
        Vector6::from_fn(|k, _| {
            let h = Vector6::ith(k, step);
            (self.value(&(y + h)) - self.value(&(y - h))) / (2.0 * step)
        })
    }

    /// The first change of sign in a direction.
    fn first_zero(&self, direction: &Vector6<f64>) -> Option<Vector6<f64>> {
        let turning = direction.fixed_rows::<3>(3).norm() / self.length;
        let most = (FARTHEST * self.size).min(std::f64::consts::PI / turning.max(f64::MIN_POSITIVE));
        let at = |k: usize| direction * (most * k as f64 / STEPS as f64);
        let mut before = self.value(&at(0));
        for k in 1..=STEPS {
            let after = self.value(&at(k));
            if !after.is_finite() {
                return None;
            }
            // at a singular pose the sign is none
            if before * after <= 0.0 {
                let (mut low, mut high) = (at(k - 1), at(k));
                for _ in 0..HALVINGS {
                    let middle = (low + high) * 0.5;
                    let value = self.value(&middle);
                    if !value.is_finite() {
                        return None;
                    }
                    if value * before > 0.0 { low = middle } else { high = middle }
                }
                return Some((low + high) * 0.5);
            }
            before = after;
        }
        None
    }

    /// Follows the singular poses from one of them towards the given pose.
    fn foot(&self, start: Vector6<f64>) -> NearestSingularPose {
        let size = self.size;
        // heavier than the multiplier of det J = 0, so that a step towards the foot makes the merit less
        let weight = 2.0 * (size + start.norm());
        let mut y = start;
        for _ in 0..ROUNDS {
            let g = self.gradient(&y);
            let square = g.norm_squared();
            let aim = g * ((g.dot(&y) - self.value(&y)) / square);
            if !aim.iter().all(|x| x.is_finite()) {
                break;
            }
            // half steps as long as the merit grows
            let merit =
                |y: &Vector6<f64>| 0.5 * y.norm_squared() + weight * self.value(y).abs() / square.sqrt();
            let (now, mut share) = (merit(&y), 1.0);
            let has_grown = |share: f64| {
                let then = merit(&(y + (aim - y) * share));
                // beyond the poses with a value
                !then.is_finite() || then > now
            };
            while share > 1e-3 && has_grown(share) {
                share *= 0.5;
            }
            let moved = (aim - y) * share;
            if !merit(&(y + moved)).is_finite() {
                break;
            }
            y += moved;
            if moved.norm() < SETTLED * size {
                break;
            }
        }
        let g = self.gradient(&y);
        // back onto det J = 0 along the gradient
        for _ in 0..3 {
            let correction = g * (self.value(&y) / g.norm_squared());
            if self.value(&(y - correction)).is_finite() {
                y -= correction;
            }
        }
        let pose = self.pose(&y);
        let across = (y - g * (g.dot(&y) / g.norm_squared())).norm();
        let turned = turn_between(&self.from.rotation, &pose.rotation).norm() * self.length;
        NearestSingularPose {
            pose,
            distance: (pose.position - self.from.position).norm().hypot(turned),
            is_stationary: across <= STATIONARY * y.norm().max(SETTLED * size),
            proved_within: self.proved_within(&y, &g),
        }
    }

    /// Half the length of a straight path across the pose on which `det J` is proved to change its sign.
    fn proved_within(&self, y: &Vector6<f64>, g: &Vector6<f64>) -> Option<f64> {
        let prove = self.prove?;
        let normal = g.normalize();
        let half = [1e-10, 1e-8, 1e-6, 1e-4].map(|share| share * self.size);
        half.into_iter().find(|half| {
            let ends = [-1.0, 1.0].map(|sign| self.pose(&(y + normal * (sign * half))));
            prove(&ends[0], &ends[1])
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;
    use platform::manipulator::Leg;

    fn hexapod(ratio: f64) -> Manipulator {
        let ring = |radius: f64, degrees: f64| {
            let t = degrees.to_radians();
            Point3::new(radius * t.cos(), radius * t.sin(), 0.0)
        };
        let base = [-10.0, 10.0, 110.0, 130.0, 230.0, 250.0];
        let platform = [-50.0, 50.0, 70.0, 170.0, 190.0, 290.0];
        Manipulator::from_legs(std::array::from_fn(|i| Leg {
            base: ring(1.0, base[i]),
            platform: ring(ratio, platform[i]),
        }))
        .unwrap()
    }

    #[test]
    fn no_pose_nearer_than_the_one_found_has_the_other_sign() {
        let m = hexapod(0.6);
        let mut rng = Rng::new(4);
        for k in 0..4 {
            let rotation = Rotation3::from_euler_angles(0.1 * f64::from(k), -0.1, 0.2);
            let from = Pose { rotation, position: Vector3::new(0.1, 0.0, 1.2) };
            let search = NearestPoseSearch { length: 0.6, directions: 100, seed: 3 };
            let found = nearest_singular_pose(&m, &from, &search).unwrap();
            assert!(found.is_stationary && found.proved_within.unwrap() < 1e-5, "{found:?}");
            assert!(leg_determinant(&m, &found.pose).abs() < 1e-9);
            let of = |pose: &Pose| leg_determinant(&m, pose);
            let around = Around { of: &of, prove: None, size: m.size(), from: &from, length: 0.6 };
            let sign = leg_determinant(&m, &from).signum();
            for _ in 0..20_000 {
                let direction = Vector6::from_fn(|_, _| rng.normal()).normalize();
                let y = direction * (found.distance * 0.999 * rng.unit().powf(1.0 / 6.0));
                assert!(around.value(&y) * sign > 0.0, "a nearer singular pose");
            }
        }
    }

    #[test]
    fn level_hexagons_with_parallel_planes_are_singular_a_quarter_turn_from_home() {
        // with a rotation counted as almost nothing the nearest singular pose is the turn about z by 90 degrees
        // (Fichter 1986)
        let m = hexapod(0.6);
        let from = Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, 5.0) };
        let search = NearestPoseSearch { length: 1e-3, directions: 50, seed: 1 };
        let found = nearest_singular_pose(&m, &from, &search).unwrap();
        let quarter = 1e-3 * std::f64::consts::FRAC_PI_2;
        assert!(found.distance <= quarter * (1.0 + 1e-6), "{} {quarter}", found.distance);
    }
}
