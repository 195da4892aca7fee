//! The leg lines over a box of poses, and the test that they are independent at all of them.
//!
//! With `K` near the inverse of `J` at the centre and `J_k` an enclosure of `dJ / dq_k` over the box, the mean value theorem gives
//!
//! ```text
//! |I - K J(q)| <= W = |I - K J(centre)| + sum_k |K J_k| half_k      entry by entry, for every q of the box.
//! ```
//!
//! When `W u < u` for some positive vector `u` the spectral radius of `I - K J(q)` is below 1 and `J(q)` is regular (Neumaier, Interval methods for systems of equations, 1990,
//! sec. 4.1). Rows are `[n, a x n]`, `n = R b + p - a`, about the mean base joint, in units of the size.

use nalgebra::{Matrix6, Vector3};

use crate::geom::enclosed::{Matrix, Vector, apply, contraction, cross, dot, times};
use crate::geom::{Cell, Chart, combination, turn, turn_slope};
use crate::manipulator::{Manipulator, leg_determinant};
use crate::num::interval::Interval;

/// The legs of a manipulator over the poses of a chart.
#[derive(Debug)]
pub(super) struct Lines<'a> {
    pub(super) chart: &'a Chart,
    manipulator: &'a Manipulator,
    /// Base joints, from their mean.
    base: [Vector; 6],
    /// `R_0 b`.
    arm: [Vector; 6],
    /// `p_0` less the mean base joint.
    home: Vector,
    /// Columns of the chart, lengths over the size.
    columns: Vec<[Interval; 6]>,
}

impl<'a> Lines<'a> {
    pub(super) fn new(manipulator: &'a Manipulator, chart: &'a Chart) -> Self {
        let legs = manipulator.legs();
        let mean = legs.iter().map(|l| l.base.coords).sum::<Vector3<f64>>() / 6.0;
        let unit = Interval::from(manipulator.size());
        // rounded away before anything is proved: the origin of moments is free
        let over = |x: Interval| x.checked_div(unit).unwrap_or(Interval::WHOLE);
        let scaled = |x: f64, from: f64| over(Interval::from(x) - Interval::from(from));
        let base = legs.map(|l| std::array::from_fn(|k| scaled(l.base[k], mean[k])));
        let arm = legs.map(|l| apply(&chart.rotation, &std::array::from_fn(|k| scaled(l.platform[k], 0.0))));
        let home = std::array::from_fn(|k| over(chart.position[k] - Interval::from(mean[k])));
        let column = |c: &[Interval; 6]| std::array::from_fn(|k| if k < 3 { over(c[k]) } else { c[k] });
        let columns = chart.columns.iter().map(column).collect();
        Self { chart, manipulator, base, arm, home, columns }
    }

    /// `det J` of rounded numbers.
    pub(super) fn determinant(&self, x: &[f64; 6]) -> f64 {
        leg_determinant(self.manipulator, &self.chart.pose(x))
    }

    /// Rows `[n_i, a_i x n_i]`.
    fn rows(&self, n: impl Fn(usize) -> Vector) -> Matrix {
        std::array::from_fn(|i| {
            let direction = n(i);
            let moment = cross(&self.base[i], &direction);
            std::array::from_fn(|k| if k < 3 { direction[k] } else { moment[k - 3] })
        })
    }

    /// Encloses `J` over a cell.
    fn over(&self, cell: &Cell) -> Matrix {
        let q = combination(&self.columns, cell);
        let r = turn(&[q[3], q[4], q[5]]);
        self.rows(|i| {
            let arm = apply(&r, &self.arm[i]);
            std::array::from_fn(|k| arm[k] + self.home[k] + q[k] - self.base[i][k])
        })
    }

    /// Enclosures of `dJ / dx_k` over the cell, by coordinate.
    fn slopes(&self, cell: &Cell) -> Vec<Matrix> {
        let q = combination(&self.columns, cell);
        let turning = |c: &[Interval; 6]| c[3..].iter().any(|x| *x != Interval::ZERO);
        let needed = self.columns.iter().any(turning);
        let turns: Vec<_> =
            (0..if needed { 3 } else { 0 }).map(|k| turn_slope(&[q[3], q[4], q[5]], k)).collect();
        let slope = |column: &[Interval; 6]| {
            self.rows(|i| {
                let mut step: Vector = std::array::from_fn(|k| column[k]);
                for (k, turned) in turns.iter().enumerate().filter(|(k, _)| column[k + 3] != Interval::ZERO) {
                    let moved = apply(turned, &self.arm[i]);
                    step = std::array::from_fn(|l| step[l] + column[k + 3] * moved[l]);
                }
                step
            })
        };
        self.columns.iter().map(slope).collect()
    }

    /// Whether all poses of the cell are proved regular; if not, the axis along which `J` changes most over it.
    pub(super) fn is_regular(&self, cell: &Cell) -> Result<(), usize> {
        let centre = cell.centre();
        let slopes = self.slopes(cell);
        let reach = |k: usize| cell.reach(&centre, k);
        let steepest = |changes: &[Matrix]| {
            let weight = |k: usize| {
                let sum: f64 = changes[k].iter().flatten().map(|x| x.magnitude()).sum();
                reach(k) * if sum.is_finite() { sum } else { 1.0 }
            };
            (0..changes.len()).fold(0, |best, k| if weight(k) > weight(best) { k } else { best })
        };
        let there = self.over(&Cell::point(centre));
        let plain = Matrix6::from_fn(|i, k| there[i][k].centre_and_radius().0);
        // a centre that is singular itself: the axis is found without an inverse
        let Some(inverse) = plain.try_inverse() else { return Err(steepest(&slopes)) };
        let changes: Vec<Matrix> = slopes.iter().map(|s| times(&inverse, s)).collect();
        let mut w = times(&inverse, &there);
        for (i, row) in w.iter_mut().enumerate() {
            row[i] = row[i] - Interval::from(1.0);
        }
        let mut w = w.map(|row| row.map(|x| Interval::from(x.magnitude())));
        for (k, change) in changes.iter().enumerate() {
            let half = Interval::from(reach(k));
            for (row, extra) in w.iter_mut().zip(change) {
                for (x, e) in row.iter_mut().zip(extra) {
                    *x = *x + Interval::from(e.magnitude()) * half;
                }
            }
        }
        if contraction(&w).is_some() { Ok(()) } else { Err(steepest(&changes)) }
    }

    /// The proved sign of `det J` at a point of the chart.
    pub(super) fn sign_at(&self, x: &[f64; 6]) -> Option<f64> {
        let d = determinant(&self.over(&Cell::point(*x)));
        if d.lo() > 0.0 { Some(1.0) } else { (d.hi() < 0.0).then_some(-1.0) }
    }
}

/// Encloses the determinant: Laplace expansion by complementary minors of the first three rows.
fn determinant(m: &Matrix) -> Interval {
    let minor = |rows: [usize; 3], c: [usize; 3]| {
        let r = rows.map(|r| c.map(|k| m[r][k]));
        dot(&r[0], &cross(&r[1], &r[2]))
    };
    let mut sum = Interval::ZERO;
    for i in 0..6 {
        for j in i + 1..6 {
            for k in j + 1..6 {
                let mut others = (0..6).filter(|x| ![i, j, k].contains(x));
                let rest: [usize; 3] = std::array::from_fn(|_| others.next().unwrap_or(0));
                let term = minor([0, 1, 2], [i, j, k]) * minor([3, 4, 5], rest);
                // sign of moving columns i, j, k to the front: i + j + k - (0 + 1 + 2)
                sum = if (i + j + k) % 2 == 1 { sum + term } else { sum - term };
            }
        }
    }
    sum
}
