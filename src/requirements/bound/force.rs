//! Enclosures of leg forces over a cell, with their slopes.
//!
//! With lines that are not divided by the leg lengths, `A G = -(f, t)`, `A = [n_i; R b_i x n_i]` by columns and `F_i = G_i |n_i|`. `K` near the inverse of `A` at the
//! middle gives `G = K b + (I - K A) G`; where `|I - K A| <= W` with `W u <= c u`, `c < 1`, `u > 0`, the norm `max |G_i| / u_i` is at most that of `K b` over `1 - c`
//! (Neumaier 1990, sec. 4.1). The slopes solve the same system with `b_k - A_k G` to the right.

use nalgebra::Matrix6;

use super::crank::CrankFrames;
use super::frame::{CellFrame, LegOverCell, enclosed};
use super::local::{self, Bounded};
use crate::geom::enclosed::{IntervalMatrix, IntervalVector, contraction, times};
use crate::geom::{Chart, ChartCell};
use crate::manipulator::{Body, Manipulator};
use crate::num::interval::Interval;
use crate::num::jet::{Jet, JetVector, cross};
use crate::requirements::load::Load;

type Column = [Jet; 6];

/// `A` by rows and `-(f, t)`, moments over the size.
pub(super) struct System {
    rows: [Column; 6],
    right: Column,
    /// The leg lengths, or for cranks what makes torques of forces over the rod lengths.
    factors: [Option<Jet>; 6],
}

/// One over the size, which moments are in units of.
fn unit_of(m: &Manipulator) -> Interval {
    Interval::from(1.0).checked_div(Interval::from(m.size())).unwrap_or(Interval::WHOLE)
}

impl System {
    /// The lines of legs, without a load; `factors` make the answers of them.
    pub(super) fn of_lines(
        frame: &CellFrame<'_>,
        m: &Manipulator,
        legs: &[LegOverCell; 6],
        factors: &[Option<Jet>; 6],
    ) -> Self {
        let unit = unit_of(m);
        let moments: [JetVector; 6] = std::array::from_fn(|i| legs[i].moment());
        let rows = std::array::from_fn(|r| {
            std::array::from_fn(|i| if r < 3 { legs[i].line[r] } else { moments[i][r - 3].times(unit) })
        });
        Self { rows, right: [frame.constant(Interval::ZERO); 6], factors: *factors }
    }

    /// Rates of drives by columns, without a load: what forces along the drives do to the platform.
    pub(super) fn of_rates(frame: &CellFrame<'_>, m: &Manipulator, rates: &[[Jet; 6]; 6]) -> Self {
        let unit = unit_of(m);
        let rows = std::array::from_fn(|r| {
            std::array::from_fn(|i| if r < 3 { rates[i][r] } else { rates[i][r].times(unit) })
        });
        let one = Some(frame.constant(Interval::from(1.0)));
        Self { rows, right: [frame.constant(Interval::ZERO); 6], factors: [one; 6] }
    }

    /// The lines of the legs of a frame, or the rates of their drives where screws couple turns to lengths; `None` where those may not be determined.
    pub(super) fn of_legs(frame: &CellFrame<'_>, m: &Manipulator) -> Option<Self> {
        if let Some(joints) = frame.joints().filter(|joints| joints.have_lead()) {
            let mut rates = Vec::with_capacity(6);
            for i in 0..6 {
                rates.push(joints.rates(frame, m, i)?);
            }
            return Some(Self::of_rates(frame, m, &rates.try_into().ok()?));
        }
        let legs: [LegOverCell; 6] = std::array::from_fn(|i| frame.leg(m, i));
        let factors = std::array::from_fn(|i| legs[i].square.root());
        Some(Self::of_lines(frame, m, &legs, &factors))
    }

    /// Legs, or rods on cranks; `None` where a rod may not close.
    fn over(
        frame: &CellFrame<'_>,
        m: &Manipulator,
        cranks: Option<&CrankFrames<'_>>,
        load: &Load,
    ) -> Option<Self> {
        let unit = unit_of(m);
        let lines = if let Some(cranks) = cranks {
            let (rods, factors) = cranks.rods(m, frame)?;
            Self::of_lines(frame, m, &rods, &factors)
        } else {
            Self::of_legs(frame, m)?
        };
        let turned = |v: &nalgebra::Vector3<f64>| {
            let v: IntervalVector = std::array::from_fn(|k| Interval::from(v[k]));
            match load.fixed_to {
                Body::Base => frame.fixed(&v),
                Body::Platform => frame.turned(&v),
            }
        };
        let (force, torque) = (turned(&load.force), turned(&load.torque));
        let lever = cross(&frame.turned(&enclosed(&load.at)), &force);
        let right =
            std::array::from_fn(
                |r| {
                    if r < 3 { -force[r] } else { -(torque[r - 3] + lever[r - 3]).times(unit) }
                },
            );
        Some(Self { right, ..lines })
    }

    pub(super) fn values(&self) -> IntervalMatrix {
        std::array::from_fn(|r| std::array::from_fn(|i| self.rows[r][i].value))
    }

    pub(super) fn slopes(&self, k: usize) -> IntervalMatrix {
        std::array::from_fn(|r| std::array::from_fn(|i| self.rows[r][i].slope(k)))
    }
}

/// A bound of `|I - K A|` with what solves systems by it.
pub(super) struct ForceSolver {
    inverse: Matrix6<f64>,
    defect: IntervalMatrix,
    weights: [f64; 6],
    factor: f64,
}

fn apply(k: &Matrix6<f64>, b: &[Interval; 6]) -> [Interval; 6] {
    std::array::from_fn(|i| (0..6).fold(Interval::ZERO, |s, j| s + b[j].scaled(k[(i, j)])))
}

impl ForceSolver {
    /// For `A` at `z` and all over a cell.
    pub(super) fn new(
        at: &System,
        over: &System,
        cell: &ChartCell,
        z: &[f64; 6],
        variables: usize,
    ) -> Option<Self> {
        let there = at.values();
        let inverse = Matrix6::from_fn(|i, k| there[i][k].centre_and_radius().0).try_inverse()?;
        let mut defect = times(&inverse, &there);
        for (i, row) in defect.iter_mut().enumerate() {
            row[i] = row[i] - Interval::from(1.0);
        }
        let mut defect = defect.map(|row| row.map(|x| Interval::from(x.magnitude())));
        for k in 0..variables {
            let reach = Interval::from(cell.reach(z, k));
            let change = times(&inverse, &over.slopes(k));
            for (row, extra) in defect.iter_mut().zip(&change) {
                for (x, e) in row.iter_mut().zip(extra) {
                    *x = *x + Interval::from(e.magnitude()) * reach;
                }
            }
        }
        let (weights, factor) = contraction(&defect)?;
        Some(Self { inverse, defect, weights, factor })
    }

    fn solve(&self, right: &[Interval; 6]) -> Option<[Interval; 6]> {
        let start = apply(&self.inverse, right);
        let room = Interval::from(1.0) - Interval::from(self.factor);
        let mut norm = 0.0_f64;
        for (x, u) in start.iter().zip(&self.weights) {
            norm = norm.max(Interval::from(x.magnitude()).checked_div(Interval::from(*u) * room)?.hi());
        }
        let norm = Interval::from(norm);
        Some(std::array::from_fn(|i| {
            let sum =
                (0..6).fold(Interval::ZERO, |s, k| s + self.defect[i][k] * Interval::from(self.weights[k]));
            let off = (sum * norm).magnitude();
            start[i] + Interval::about_zero(off)
        }))
    }

    /// The forces of a system, with slopes.
    fn forces(&self, system: &System, variables: usize) -> Option<[Jet; 6]> {
        let value = self.solve(&std::array::from_fn(|r| system.right[r].value))?;
        let mut slopes = [[Interval::ZERO; 6]; 6];
        for k in 0..variables {
            let a = system.slopes(k);
            let right =
                std::array::from_fn(|r| (0..6).fold(system.right[r].slope(k), |s, i| s - a[r][i] * value[i]));
            for (row, x) in slopes.iter_mut().zip(self.solve(&right)?) {
                row[k] = x;
            }
        }
        let mut out = system.right;
        for (i, x) in out.iter_mut().enumerate() {
            *x = Jet::linear(value[i], slopes[i], variables, false) * system.factors[i]?;
        }
        Some(out)
    }
}

/// A lower bound of `greatest - |F_i|` over a cell for all legs, or of the greatest torque less that of each crank, and an upper bound of the least one at `z`.
pub(super) fn force(
    chart: &Chart,
    cell: &ChartCell,
    z: &[f64; 6],
    frames: (&CellFrame<'_>, &CellFrame<'_>),
    (m, cranks, greatest): (&Manipulator, Option<&CrankFrames<'_>>, f64),
    load: &Load,
) -> (Bounded, f64) {
    let n = chart.len();
    let Some(at) = System::over(frames.0, m, cranks, load) else {
        return (Bounded::nothing(cell), f64::INFINITY);
    };
    let over = System::over(frames.1, m, cranks, load);
    let point = ChartCell::point(*z);
    let Some(here) = ForceSolver::new(&at, &at, &point, z, n).and_then(|s| s.forces(&at, n)) else {
        return (Bounded::nothing(cell), f64::INFINITY);
    };
    let room = |f: &Jet, sign: f64| {
        Jet::constant(Interval::from(greatest), n, false) - f.times(Interval::from(sign))
    };
    let both = |f: &[Jet; 6]| -> Vec<Jet> { f.iter().flat_map(|f| [room(f, 1.0), room(f, -1.0)]).collect() };
    let points = both(&here);
    let upper = points.iter().map(|x| x.value.hi()).fold(f64::INFINITY, f64::min);
    let all = over.and_then(|over| ForceSolver::new(&at, &over, cell, z, n)?.forces(&over, n));
    let Some(all) = all else {
        return (Bounded::nothing(cell), upper);
    };
    let bounds = points.iter().zip(both(&all)).map(|(p, o)| local::below_first_order(chart, cell, z, p, &o));
    (bounds.reduce(Bounded::min).unwrap_or_else(|| Bounded::nothing(cell)), upper)
}
