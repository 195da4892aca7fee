//! A lower bound of the distance to the nearest singular design, from one well conditioned pose.
//!
//! An architecturally singular design has dependent lines at every pose, also at the one looked at. With `e = R b + p` and moments about
//! a point `o` in units of `L` the row of a leg is `(e - a, (a - o) x (e - o) / L)`. When its ends move by `da` and `db`, `|da|^2 + |db|^2 = d^2`, it
//! changes by at most
//!
//! ```text
//! sqrt(2 d^2 + ((g + d / 2) d / L)^2),   g^2 = |a - o|^2 + |e - o|^2,
//! ```
//!
//! and the matrix, in Frobenius norm, by at most `sqrt(k) D sqrt(2 + (G + D / 2)^2 / L^2)` for a change `D` of all joints, `k` the most legs at one joint and
//! `G` the largest `g`. As long as this is below the smallest singular value the lines stay independent (Weyl). The singular value is computed in doubles;
//! `1e-13` of the largest one, and of the largest coordinate, is taken off.

use nalgebra::{Matrix6, Vector3, Vector6};

use crate::geom::{Pose, random_rotation};
use crate::manipulator::{Leg, Manipulator};
use crate::num::Rng;

/// Random poses, and random steps from the best of them.
const POSES: usize = 300;
const CLIMB: usize = 300;
const MARGIN: f64 = 1e-13;

/// No design within this distance of `m` (norm of the change of all joints, design units) is architecturally singular; 0 where nothing was found.
#[must_use]
pub fn singular_distance_at_least(m: &Manipulator, seed: u64) -> f64 {
    let mut rng = Rng::new(seed);
    let legs = m.legs();
    let mean = |pick: fn(&Leg) -> Vector3<f64>| legs.iter().map(pick).sum::<Vector3<f64>>() / 6.0;
    let (base, platform) = (mean(|l| l.base.coords), mean(|l| l.platform.coords));
    let centred =
        |rotation, offset: Vector3<f64>| Pose { rotation, position: base + offset - rotation * platform };
    let mut best = (0.0, centred(nalgebra::Rotation3::identity(), Vector3::zeros()), Vector3::zeros());
    for _ in 0..POSES {
        let rotation = random_rotation(&mut rng);
        let offset = Vector3::from_fn(|_, _| rng.uniform(-m.size(), m.size()));
        let pose = centred(rotation, offset);
        let bound = at_pose(m, &pose);
        if bound > best.0 {
            best = (bound, pose, offset);
        }
    }
    for k in 0..CLIMB {
        let reach = 0.5 * (1.0 - k as f64 / CLIMB as f64);
        let turn = nalgebra::Rotation3::new(Vector3::from_fn(|_, _| reach * rng.normal()));
        let offset = best.2 + Vector3::from_fn(|_, _| reach * m.size() * rng.normal());
        let pose = centred(turn * best.1.rotation, offset);
        let bound = at_pose(m, &pose);
        if bound > best.0 {
            best = (bound, pose, offset);
        }
    }
    best.0
}

/// The bound from one pose.
fn at_pose(m: &Manipulator, pose: &Pose) -> f64 {
    let legs = m.legs();
    let ends = legs.map(|l| (l.base.coords, pose.transform(&l.platform).coords));
    // coordinates that cancel lose digits
    let far = ends.iter().map(|(a, e)| a.amax().max(e.amax())).fold(pose.position.amax(), f64::max);
    let middle = ends.iter().map(|(a, e)| a + e).sum::<Vector3<f64>>() / 12.0;
    let ends = ends.map(|(a, e)| (a - middle, e - middle));
    let reach = ends.iter().map(|(a, e)| (a.norm_squared() + e.norm_squared()).sqrt()).fold(0.0, f64::max);
    let unit = reach / std::f64::consts::SQRT_2;
    let rows = ends.map(|(a, e)| {
        let (n, moment) = (e - a, a.cross(&e) / unit);
        Vector6::new(n.x, n.y, n.z, moment.x, moment.y, moment.z).transpose()
    });
    let s = Matrix6::from_rows(&rows).singular_values();
    let allowed = s.min() - MARGIN * (s.max() + far);
    let legs_at_joint = (0..6).map(|i| {
        let pairs = m.pairs();
        let at = |same: &dyn Fn(usize) -> bool| (0..6).filter(|j| same(*j)).count();
        at(&|j| pairs[j].0 == pairs[i].0).max(at(&|j| pairs[j].1 == pairs[i].1))
    });
    let most = legs_at_joint.max().unwrap_or(6) as f64;
    let change = |d: f64| most.sqrt() * d * (2.0 + ((reach + d / 2.0) / unit).powi(2)).sqrt();
    // increasing in d: the largest d with change(d) <= allowed, from below
    let (mut low, mut high) = (0.0, allowed.max(0.0));
    for _ in 0..80 {
        let d = f64::midpoint(low, high);
        if change(d) <= allowed { low = d } else { high = d }
    }
    low
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::singularity::nearest_singular;
    use nalgebra::Point3;

    #[test]
    fn below_the_upper_bound_and_within_a_decade_or_two() {
        let mut rng = Rng::new(31);
        for k in 0..6 {
            let mut point = || Point3::new(rng.normal(), rng.normal(), rng.normal());
            let mut legs: [Leg; 6] = std::array::from_fn(|_| Leg { base: point(), platform: point() });
            if k > 2 {
                // nearly four legs at one point
                for i in 1..4 {
                    legs[i].base = legs[0].base + Vector3::from_fn(|_, _| 1e-6 * rng.normal());
                }
            }
            let m = Manipulator::from_legs(legs).unwrap();
            let low = singular_distance_at_least(&m, 1);
            let high = nearest_singular(&m, 1).unwrap().unwrap().distance;
            assert!(low < high && high < 200.0 * low, "{low} {high}");
        }
    }

    #[test]
    fn zero_for_a_singular_design() {
        let mut rng = Rng::new(32);
        let mut point = || Point3::new(rng.normal(), rng.normal(), rng.normal());
        let mut legs: [Leg; 6] = std::array::from_fn(|_| Leg { base: point(), platform: point() });
        for i in 1..4 {
            legs[i].base = legs[0].base;
        }
        let m = Manipulator::from_legs(legs).unwrap();
        assert!(singular_distance_at_least(&m, 1) <= 0.0);
    }
}
