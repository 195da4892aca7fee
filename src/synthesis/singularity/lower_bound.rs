//! A lower bound of the distance to the nearest singular design, from one well-conditioned pose.
//!
//! An architecturally singular design has dependent lines at every pose, including the chosen one. With `e = R b + p`
//! and moments about a point `o` in units of `L` the row of a leg is `(e - a, (a - o) x (e - o) / L)`. When its ends
//! move by `da` and `db`, `|da|^2 + |db|^2 = d^2`, it changes by at most
//!
//! ```text
//! sqrt(2 d^2 + ((g + d / 2) d / L)^2),   g^2 = |a - o|^2 + |e - o|^2,
//! ```
//!
//! and the matrix, in Frobenius norm, by at most `sqrt(k) D sqrt(2 + (G + D / 2)^2 / L^2)` for a change `D` of all
//! joints. Here `k` is the greatest number of legs at one joint and `G` the largest `g`. As long as this is below the
//! smallest singular value the lines stay independent (Weyl). Doubles choose the pose; intervals compute the bound
//! there, with the joints and the quaternion as exact numbers.

use nalgebra::{Matrix6, Vector3, Vector6};

use num::Rng;
use num::interval::Interval;
use num::small::singular_values;
use platform::geom::enclosed::{IntervalMatrix, IntervalVector, apply, cross, exact_rotation, times};
use platform::geom::{CentredPoses, Pose};
use platform::manipulator::Manipulator;

/// Number of random poses.
const POSES: usize = 300;
/// Number of random steps from the best of them.
const CLIMB: usize = 300;

/// Proved distance, rounding included, within which no design is architecturally singular: norm of the change of all
/// joints, design units. It is 0 without a proof.
#[must_use]
pub fn singular_distance_at_least(m: &Manipulator, seed: u64) -> f64 {
    let mut rng = Rng::new(seed);
    let centred = CentredPoses::new(m);
    let mut best = (0.0, centred.pose(nalgebra::Rotation3::identity(), Vector3::zeros()), Vector3::zeros());
    for _ in 0..POSES {
        let (rotation, offset) = centred.draw(&mut rng);
        let pose = centred.pose(rotation, offset);
        let bound = at_pose(m, &pose);
        if bound > best.0 {
            best = (bound, pose, offset);
        }
    }
    for k in 0..CLIMB {
        let reach = 0.5 * (1.0 - k as f64 / CLIMB as f64);
        let turn = nalgebra::Rotation3::new(Vector3::from_fn(|_, _| reach * rng.normal()));
        let offset = best.2 + Vector3::from_fn(|_, _| reach * m.size() * rng.normal());
        let pose = centred.pose(turn * best.1.rotation, offset);
        let bound = at_pose(m, &pose);
        if bound > best.0 {
            best = (bound, pose, offset);
        }
    }
    proved_at_pose(m, &best.1)
}

/// The bound from one pose in doubles, which chooses the pose and proves nothing.
fn at_pose(m: &Manipulator, pose: &Pose) -> f64 {
    let ends = m.legs().map(|l| (l.base.coords, pose.transform(&l.platform).coords));
    let middle = middle(&ends);
    let ends = ends.map(|(a, e)| (a - middle, e - middle));
    let reach = ends.iter().map(|(a, e)| (a.norm_squared() + e.norm_squared()).sqrt()).fold(0.0, f64::max);
    let unit = reach / std::f64::consts::SQRT_2;
    let rows = ends.map(|(a, e)| {
        let (n, moment) = (e - a, a.cross(&e) / unit);
        Vector6::new(n.x, n.y, n.z, moment.x, moment.y, moment.z).transpose()
    });
    // change(d) is nearly linear over the relevant distances
    singular_values(&Matrix6::from_rows(&rows)).map_or(0.0, |s| s.min())
        / (2.0 * most_legs_at_a_joint(m)).sqrt()
}

fn middle(ends: &[(Vector3<f64>, Vector3<f64>); 6]) -> Vector3<f64> {
    ends.iter().map(|(a, e)| a + e).sum::<Vector3<f64>>() / 12.0
}

fn most_legs_at_a_joint(m: &Manipulator) -> f64 {
    let pairs = m.pairs();
    let at = |same: &dyn Fn(usize) -> bool| (0..6).filter(|j| same(*j)).count();
    let most = |i: usize| at(&|j| pairs[j].0 == pairs[i].0).max(at(&|j| pairs[j].1 == pairs[i].1));
    (0..6).map(most).max().unwrap_or(6) as f64
}

/// The proved bound from one pose: every step encloses its result. It is 0 without a proof.
pub(super) fn proved_at_pose(m: &Manipulator, pose: &Pose) -> f64 {
    let rotation = exact_rotation(pose);
    let point = |v: &Vector3<f64>| -> IntervalVector { std::array::from_fn(|k| Interval::from(v[k])) };
    let place = point(&pose.position);
    // any double is valid as the origin of moments, and as their unit
    let origin = middle(&m.legs().map(|l| (l.base.coords, pose.transform(&l.platform).coords)));
    let origin = point(&origin);
    let from_origin = |v: IntervalVector| -> IntervalVector { std::array::from_fn(|k| v[k] - origin[k]) };
    let ends: [(IntervalVector, IntervalVector); 6] = std::array::from_fn(|i| {
        let [base, platform] = m.enclosed_ends(i);
        let turned = apply(&rotation, &platform);
        (from_origin(base), from_origin(std::array::from_fn(|k| turned[k] + place[k])))
    });
    let square = |v: &IntervalVector| v[0].square() + v[1].square() + v[2].square();
    let reach = ends.iter().map(|(a, e)| (square(a) + square(e)).hi()).fold(0.0, f64::max).sqrt().next_up();
    let unit = reach / std::f64::consts::SQRT_2;
    if !(unit > 0.0 && unit.is_finite()) {
        return 0.0;
    }
    let lines = ends.map(|(a, e)| {
        let moment = cross(&a, &e);
        std::array::from_fn(|k| {
            if k < 3 {
                e[k] - a[k]
            } else {
                moment[k - 3].checked_div(Interval::from(unit)).unwrap_or(Interval::WHOLE)
            }
        })
    });
    let Some(allowed) = smallest_singular_value(&lines) else { return 0.0 };
    let (reach, unit) = (Interval::from(reach), Interval::from(unit));
    let most = Interval::from(most_legs_at_a_joint(m));
    let change = |d: f64| -> Option<f64> {
        let d = Interval::from(d);
        let lever = (reach + d * Interval::from(0.5)).checked_div(unit)?;
        Some((most.sqrt()? * d * (Interval::from(2.0) + lever.square()).sqrt()?).hi())
    };
    // increasing in d: the largest d known to satisfy change(d) <= allowed
    let (mut low, mut high) = (0.0, allowed);
    for _ in 0..80 {
        let d = f64::midpoint(low, high);
        if change(d).is_some_and(|c| c <= allowed) { low = d } else { high = d }
    }
    low
}

/// A lower bound of the smallest singular value of every matrix in `j`. With `B` near the inverse and
/// `|I - B j| <= e < 1`, `|1 / j| <= |B| / (1 - e)`. `|B|^2 < x` holds if `x I - B^T B` is positive definite.
fn smallest_singular_value(j: &IntervalMatrix) -> Option<f64> {
    let inverse = Matrix6::from_fn(|r, c| j[r][c].centre_and_radius().0).try_inverse()?;
    let one = Interval::from(1.0);
    let mut defect = Interval::ZERO;
    for (r, row) in times(&inverse, j).iter().enumerate() {
        for (c, x) in row.iter().enumerate() {
            defect = defect + (if r == c { *x - one } else { *x }).square();
        }
    }
    let shrink = one - defect.sqrt()?;
    let bound = singular_values(&inverse)?.max() * (1.0 + 1e-9);
    let exact = inverse.map(Interval::from);
    let square = Interval::from(bound).square();
    let gap: IntervalMatrix = std::array::from_fn(|r| {
        std::array::from_fn(|c| {
            let product = (0..6).fold(Interval::ZERO, |s, k| s + exact[(k, r)] * exact[(k, c)]);
            (if r == c { square } else { Interval::ZERO }) - product
        })
    });
    (shrink.lo() > 0.0 && is_positive_definite(gap)).then_some(())?;
    Some(shrink.checked_div(Interval::from(bound))?.lo())
}

/// Whether all pivots of the elimination are proved to be positive.
fn is_positive_definite(mut m: IntervalMatrix) -> bool {
    for k in 0..6 {
        if m[k][k].lo() <= 0.0 {
            return false;
        }
        for r in k + 1..6 {
            let Some(factor) = m[r][k].checked_div(m[k][k]) else { return false };
            let head = m[k];
            for (x, h) in m[r].iter_mut().zip(head).skip(k) {
                *x = *x - factor * h;
            }
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::singularity::nearest_singular;
    use nalgebra::Point3;
    use platform::manipulator::Leg;

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
    fn the_enclosed_singular_value_is_just_below_the_computed_one() {
        let mut rng = Rng::new(33);
        for k in 0..8 {
            // the last row nearly the sum of two others
            let mut j = Matrix6::from_fn(|_, _| rng.normal());
            let spoilt = j.row(0) + j.row(1) + j.row(5) * 10f64.powi(-k);
            j.set_row(5, &spoilt);
            let points: IntervalMatrix =
                std::array::from_fn(|r| std::array::from_fn(|c| Interval::from(j[(r, c)])));
            let (low, s) = (smallest_singular_value(&points).unwrap(), j.singular_values().min());
            assert!(low < s * (1.0 + 1e-7) && low > s * (1.0 - 1e-6), "{k}: {low} {s}");
        }
        let zero: IntervalMatrix =
            std::array::from_fn(|r| std::array::from_fn(|c| Interval::from((r * c) as f64)));
        assert_eq!(smallest_singular_value(&zero), None);
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
