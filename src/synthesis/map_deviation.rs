//! Bounds of the difference between the squared lengths of a platform and their values by a leg map, over a box of
//! poses.
//!
//! About the home pose `(R0, p0)`, with `x0 = R0 b0 + p0` for any point `b0` of the platform, `b~ = b - b0`,
//! `a~ = a - x0`, `R = T R0` and `y = R b0 + p - x0`,
//!
//! ```text
//! s = |y + R b~ - a~|^2 = |y|^2 + |a~|^2 + |b~|^2 + 2 y.(R b~ - a~) - 2 a~.R b~.
//! ```
//!
//! With `D[f] = f(leg i of TO) - sum_k A_ik f(leg k of FROM)`, which vanishes up to rounding for every `f` below if the
//! map is exact,
//!
//! ```text
//! s'_i - (A s + c)_i = D[1] |y|^2 + (D[|a~|^2 + |b~|^2] - c_i - 2 D[a~.R0 b~]) + 2 y.(R D[b~] - D[a~]) - 2 tr((T - 1) R0 D[b~ a~^T]),
//! |T - 1|_F = 2 sqrt 2 sin(angle / 2) <= sqrt 2 |w|,   |y| <= |d| + |w| |b0|,   R = exp([w]x) R0,  p = p0 + d.
//! ```
//!
//! The numbers are balls, so that the bound holds for the doubles of the joints and of the map.

use nalgebra::{Matrix3, Vector3};

use super::AffineLegMap;
use num::ball::{Real, UP};
use platform::geom::SamplePlan;
use platform::manipulator::{Leg, Manipulator};

/// Sums over the legs of FROM, subtracted from the terms of a leg of TO.
struct LegDeviation {
    one: Real,
    base: [Real; 3],
    platform: [Real; 3],
    products: [[Real; 3]; 3],
    squares: Real,
}

/// A leg in the frames of the module documentation.
fn terms(leg: &Leg, base_origin: &Vector3<f64>, platform_origin: &Vector3<f64>) -> LegDeviation {
    let centred = |p: &Vector3<f64>, origin: &Vector3<f64>| -> [Real; 3] {
        std::array::from_fn(|k| Real::point(p[k]) - Real::point(origin[k]))
    };
    let a = centred(&leg.base.coords, base_origin);
    let b = centred(&leg.platform.coords, platform_origin);
    let squares = a.iter().chain(&b).fold(Real::ZERO, |sum, x| sum + *x * *x);
    let products = std::array::from_fn(|i| std::array::from_fn(|j| b[i] * a[j]));
    LegDeviation { one: Real::point(1.0), base: a, platform: b, products, squares }
}

impl LegDeviation {
    fn minus_multiple(&mut self, x: f64, other: &Self) {
        let x = Real::point(x);
        let take = |mine: &mut Real, theirs: &Real| *mine = *mine - x * *theirs;
        take(&mut self.one, &other.one);
        take(&mut self.squares, &other.squares);
        for k in 0..3 {
            take(&mut self.base[k], &other.base[k]);
            take(&mut self.platform[k], &other.platform[k]);
            for l in 0..3 {
                take(&mut self.products[k][l], &other.products[k][l]);
            }
        }
    }
}

/// An upper bound of the Euclidean norm.
fn norm<'a>(list: impl IntoIterator<Item = &'a Real>) -> f64 {
    list.into_iter().map(|x| x.magnitude() * x.magnitude()).sum::<f64>().sqrt() * UP
}

impl AffineLegMap {
    /// For each leg of `to` a bound of `|s(to) - A s(from) - c|` over the box of poses of a sampling plan, units
    /// squared.
    ///
    /// It holds for the doubles of the joints, without a tolerance. It is zero up to rounding for an exact map; for
    /// rounded joints it has the size of their differences times that of the platforms.
    #[must_use]
    pub fn deviation_bounds(&self, from: &Manipulator, to: &Manipulator, plan: &SamplePlan) -> [f64; 6] {
        let b0 = to.mean_leg_ends()[1];
        let home: Matrix3<f64> = plan.home.rotation.into_inner();
        let x0 = home * b0 + plan.home.position;
        let turn = plan.rotation.norm() * UP;
        // x0 is off by a few roundings of its size
        let rounding = 16.0 * f64::EPSILON * (b0.norm() + plan.home.position.norm());
        let shift = (plan.translation.norm() + turn * b0.norm() + rounding) * UP;
        let old = from.legs().map(|leg| terms(&leg, &x0, &b0));
        let legs = to.legs();
        std::array::from_fn(|i| {
            let mut d = terms(&legs[i], &x0, &b0);
            for (k, leg) in old.iter().enumerate() {
                d.minus_multiple(self.a[(i, k)], leg);
            }
            // tr(R0 D[b a^T]) in the constant
            let mut constant = d.squares - Real::point(self.c[i]);
            for k in 0..3 {
                for l in 0..3 {
                    constant = constant - Real::point(2.0 * home[(l, k)]) * d.products[k][l];
                }
            }
            let products = norm(d.products.iter().flatten());
            let linear = norm(&d.base) + norm(&d.platform);
            let bound = d.one.magnitude() * shift * shift
                + constant.magnitude()
                + 2.0 * shift * linear
                + 2.0 * std::f64::consts::SQRT_2 * turn.min(2.0) * products;
            bound * UP
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{LegMapTolerances, leg_map};
    use nalgebra::Point3;
    use num::Rng;
    use platform::geom::{Pose, random_rotation};

    #[test]
    fn no_pose_of_the_box_is_further_from_the_map_and_the_bound_is_of_the_right_size() {
        let mut rng = Rng::new(0xdef);
        let hexagon = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
        for rounding in [1e-2, 1e-5, 0.0] {
            let mut point = || Point3::new(rng.normal(), rng.normal(), 0.1 * rng.normal());
            let (base, platform): ([_; 3], [_; 3]) =
                (std::array::from_fn(|_| point()), std::array::from_fn(|_| point()));
            let legs = hexagon.map(|(i, j)| Leg { base: base[i], platform: platform[j] });
            let octahedral = Manipulator::from_legs(legs).unwrap();
            let mut near = |p: Point3<f64>| p + Vector3::from_fn(|_, _| rng.uniform(-rounding, rounding));
            let slid: [Leg; 6] = std::array::from_fn(|i| {
                let (this, next) = (legs[i], legs[(i + 1) % 6]);
                let between = |p: Point3<f64>, q: Point3<f64>| p + (q - p) * 0.3;
                Leg {
                    base: near(between(this.base, next.base)),
                    platform: near(between(this.platform, next.platform)),
                }
            });
            let moved = Manipulator::from_legs(slid).unwrap();
            let map = leg_map(&octahedral, &moved, LegMapTolerances::default()).unwrap().closest;
            let home = Pose { rotation: random_rotation(&mut rng), position: Vector3::new(0.2, -0.3, 4.0) };
            let widths = (Vector3::new(0.3, 0.2, 0.4), Vector3::new(10.0, 20.0, 5.0));
            let plan = SamplePlan::about(&octahedral, home, widths, (400, 7));
            let bounds = map.deviation_bounds(&octahedral, &moved, &plan);
            let mut worst = [0.0_f64; 6];
            for k in 0..plan.count {
                let pose = plan.pose(k);
                let (s, t) =
                    (pose.squared_lengths(&octahedral).unwrap(), pose.squared_lengths(&moved).unwrap());
                for i in 0..6 {
                    let mapped = map.c[i] + (0..6).map(|j| map.a[(i, j)] * s.get()[j]).sum::<f64>();
                    worst[i] = worst[i].max((t.get()[i] - mapped).abs());
                }
            }
            for i in 0..6 {
                // besides the rounding of the squared lengths themselves
                assert!(worst[i] <= bounds[i] + 1e-12, "{worst:?} {bounds:?}");
                assert!(rounding == 0.0 || bounds[i] < 60.0 * rounding, "{bounds:?}");
                assert!(rounding > 0.0 || bounds[i] < 1e-11, "{bounds:?}");
                assert!(rounding == 0.0 || worst[i] > bounds[i] / 200.0, "{worst:?} {bounds:?}");
            }
        }
    }
}
