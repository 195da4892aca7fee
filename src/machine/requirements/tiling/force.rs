//! Leg forces on a cell of a tiling.
//!
//! Forces `f_i = phi_i |n_i|` hold a load with the wrench `w` if `B phi = -w`. The columns of `B` are
//! `(n_i, R b_i x n_i / unit)`. With `K` near the inverse of `B` at the middle of the cell, and `|I - K B| <= q < 1` in
//! the row-sum norm,
//!
//! ```text
//! phi = c + (I - K B) phi,    c = -K w,    max |phi| <= max |c| / (1 - q).
//! ```
//!
//! The slopes along the coordinates are enclosed in the same way, by `B phi_k = -w_k - B_k phi`.

use nalgebra::{Matrix6, Vector3};

use num::interval::Interval;
use num::jet::{Jet, JetVector, norm_squared};
use platform::geom::enclosed::{IntervalMatrix, apply, times};

use super::pair::constant;
use super::{CONTRACTION, Cell, Ends, Function, Split, TiledRegion, widest};
use crate::requirements::Load;

/// The entries of an equation of the legs.
type Six = [Interval; 6];

fn transposed(m: &IntervalMatrix) -> IntervalMatrix {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}

/// `|m|`, rounded up.
fn row_sum_norm(m: &IntervalMatrix) -> f64 {
    let row = |row: &Six| row.iter().fold(Interval::ZERO, |sum, x| sum + Interval::from(x.magnitude())).hi();
    m.iter().map(row).fold(0.0, f64::max)
}

fn dot_six(u: impl IntoIterator<Item = Interval>, v: &Six) -> Interval {
    u.into_iter().zip(v).fold(Interval::ZERO, |sum, (x, y)| sum + x * *y)
}

/// Equations `B x = y` with `K` and an enclosure of `I - K B`.
struct Equations {
    inverse: Matrix6<f64>,
    rest: IntervalMatrix,
}

impl Equations {
    /// `None` without a bound below 1 of the norm of the rest.
    fn solve(&self, right: &Six) -> Option<Six> {
        let norm = row_sum_norm(&self.rest);
        let start: Six = std::array::from_fn(|i| dot_six((0..6).map(|j| self.inverse[(i, j)].into()), right));
        let largest = Interval::from(start.iter().map(|x| x.magnitude()).fold(0.0, f64::max));
        let within = largest.checked_div(Interval::from(1.0) - Interval::from(norm))?;
        let ball = [Interval::about_zero(within.hi()); 6];
        (norm < CONTRACTION).then(|| std::array::from_fn(|i| start[i] + dot_six(self.rest[i], &ball)))
    }
}

impl TiledRegion {
    /// A tiling that proves every leg force under a load to be at most this at every pose of the region.
    #[must_use]
    pub fn force_tiling(&self, load: &Load, greatest: f64) -> Option<String> {
        let load = Load { at: load.at - self.pivot, ..load.clone() };
        self.tiling(&mut |ends| self.force_cell(&load, greatest, ends))
    }

    fn force_cell(&self, load: &Load, greatest: f64, ends: &Ends) -> Split {
        let (at, over) = (self.cell(&ends.middle()), self.cell(ends));
        let longest = || Some(widest(&|k| ends.half(k)));
        let lines = transposed(&self.lines(&at));
        let middle = Matrix6::from_fn(|i, j| lines[i][j].centre_and_radius().0);
        let Some(inverse) = middle.try_inverse() else { return longest() };
        let changes: [IntervalMatrix; 6] = std::array::from_fn(|k| transposed(&self.changes(&over, k)));
        let solved_changes = changes.map(|change| times(&inverse, &change));
        let start = times(&inverse, &lines);
        let identity = |i, j| if i == j { Interval::from(1.0) } else { Interval::ZERO };
        let rest_at: IntervalMatrix =
            std::array::from_fn(|i| std::array::from_fn(|j| identity(i, j) - start[i][j]));
        let rest_over: IntervalMatrix = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                (0..6).fold(rest_at[i][j], |sum, k| {
                    sum + solved_changes[k][i][j] * Interval::about_zero(ends.half(k))
                })
            })
        });
        let (here, there) = (Equations { inverse, rest: rest_at }, Equations { inverse, rest: rest_over });
        let size = |k: usize| row_sum_norm(&solved_changes[k]) * ends.half(k);
        let (Some(w_at), Some(w_over)) = (self.wrench(load, &at), self.wrench(load, &over)) else {
            return longest();
        };
        let [right_at, right_over] = [&w_at, &w_over].map(|w| w.map(|x| -x.value));
        let (Some(phi_at), Some(phi)) = (here.solve(&right_at), there.solve(&right_over)) else {
            return Some(widest(&size));
        };
        let slopes = [0, 1, 2, 3, 4, 5].map(|k: usize| {
            let right = std::array::from_fn(|j| -w_over[j].slope(k) - dot_six(changes[k][j], &phi));
            there.solve(&right)
        });
        for (leg, phi_of_leg) in phi_at.iter().enumerate() {
            let lengths = [&at, &over].map(|cell| norm_squared(&self.line_jet(leg, cell)).root());
            let [Some(length_at), Some(length)] = lengths else { return longest() };
            let force = *phi_of_leg * length_at.value;
            let along = |k: usize| {
                slopes[k]
                    .map_or(Interval::WHOLE, |phi_k| phi_k[leg] * length.value + phi[leg] * length.slope(k))
            };
            let along: Six = std::array::from_fn(along);
            for (value, slopes) in [(-force, along.map(|x| -x)), (force, along)] {
                let f = Function { value: Interval::from(greatest) + value, slopes, rest: [0.0; 6] };
                if let Some(axis) = self.split(&f, ends) {
                    return Some(axis);
                }
            }
        }
        None
    }

    /// Force and torque about the pivot, the torque over the unit.
    fn wrench(&self, load: &Load, cell: &Cell) -> Option<[Jet; 6]> {
        let fixed = |v: &Vector3<f64>| [v.x, v.y, v.z].map(|x| constant(Interval::from(x)));
        let turned = |v: &Vector3<f64>| {
            let at_home = apply(&self.home, &[v.x, v.y, v.z].map(Interval::from));
            self.turned_jet(&at_home, cell)
        };
        let leg = |i: usize| (self.turned_jet(&self.platform[i], cell), self.line_jet(i, cell));
        let wrench = load.wrench_of(fixed, turned, leg)?;
        let scale = Interval::from(self.unit.recip());
        Some(std::array::from_fn(|j| if j < 3 { wrench[j] } else { wrench[j].times(scale) }))
    }

    /// A vector that rotates from home.
    fn turned_jet(&self, at_home: &[Interval; 3], cell: &Cell) -> JetVector {
        let values = apply(&cell.rotation, at_home);
        let slopes: [[Interval; 3]; 3] =
            std::array::from_fn(|k| apply(&cell.slopes[k], at_home).map(|x| x * self.widths[k + 3]));
        std::array::from_fn(|j| {
            let along = std::array::from_fn(|k| if k < 3 { Interval::ZERO } else { slopes[k - 3][j] });
            Jet::linear(values[j], along, 6, false)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{aside, hexapod, space};
    use super::*;
    use crate::requirements::{LegsWeight, PoseSpace, Region, leg_forces};
    use nalgebra::Point3;
    use num::Rng;
    use platform::manipulator::Body;

    fn loads() -> [Load; 2] {
        let weight = Load {
            name: "weight".to_owned(),
            force: Vector3::new(3.0, 0.0, -100.0),
            torque: Vector3::new(0.0, 500.0, 0.0),
            at: Point3::new(10.0, -5.0, 40.0),
            fixed_to: Body::Base,
            legs: None,
        };
        let legs = LegsWeight { rod: Vector3::new(0.0, 0.0, -9.0), moment: Vector3::new(0.0, 0.0, -300.0) };
        let cut = Load { fixed_to: Body::Platform, legs: Some(legs), ..weight.clone() };
        [weight, cut]
    }

    /// The greatest force over sampled poses.
    fn sampled(load: &Load, space: &PoseSpace) -> f64 {
        let m = hexapod();
        let poses = space.cube_points(300, &mut Rng::new(1)).into_iter().map(|x| space.pose(&x));
        let greatest =
            poses.map(|pose| leg_forces(&m, &pose, &load.wrench(&m, &pose), 200.0).unwrap().amax());
        greatest.fold(0.0, f64::max)
    }

    #[test]
    fn forces_with_room_are_tiled_and_others_are_not() {
        for space in [space(Region::Box, 0.5), space(Region::Ellipsoid, 0.5), aside(Region::Ellipsoid)] {
            let tiled = TiledRegion::new(&hexapod(), &space).unwrap();
            for load in loads() {
                let greatest = sampled(&load, &space);
                let tree = tiled.force_tiling(&load, 1.3 * greatest).unwrap();
                assert!(tree.contains('.'));
                assert_eq!(tiled.force_tiling(&load, 0.99 * greatest), None);
            }
        }
    }
}
