//! Bounds of leg forces over a cell.
//!
//! With lines that are not divided by the leg lengths, `A G = -(f, t)`, `A = [n_i; R b_i x n_i]` by columns and
//! `F_i = G_i |n_i|`. `K` near the inverse of `A` at the middle gives `G = K b + (I - K A) G`. Let `|I - K A| <= W`
//! with `W u <= c u`, `c < 1`, `u > 0`. Then the norm `max |G_i| / u_i` is at most that of `K b` over `1 - c` (Neumaier
//! 1990, sec. 4.1). The slopes solve the same system with the right side `b_k - A_k G`.
//!
//! The remainder beside the tangent at `z` is `R(h) = G(z + h) - G(z) - sum G_k h_k`. It solves `A R = r` with
//! `r = b - A (G(z) + sum G_k h_k)`. Both `r` and its slopes vanish at `z`, since `G(z)` and `G_k` are the solution and
//! its slopes there. So `K r = (h^T C h) / 2` with `C_kl = K (b_kl - A_kl (G(z) + sum G_j h_j) - A_k G_l - A_l G_k)` at
//! a point of the cell (Taylor). `|R - K r|` is at most `W u` times the norm of `K r` over `1 - c`, which is of third
//! order. Only `A` and `b` over the cell are needed, no solution.

use nalgebra::Matrix6;

use super::crank::CrankFrames;
use super::frame::{CellFrame, LegOverCell};
use super::local::{self, Bounded};
use crate::requirements::load::Load;
use num::interval::Interval;
use num::jet::{Jet, JetVector};
use platform::geom::enclosed::{IntervalMatrix, IntervalVector, contraction, times};
use platform::geom::{Chart, ChartCell};
use platform::manipulator::Manipulator;

type Column = [Jet; 6];

/// `A` by rows and `-(f, t)`, moments over the size.
pub(super) struct System {
    rows: [Column; 6],
    right: Column,
    /// The leg lengths; for cranks, the factors that convert forces over the rod lengths to torques.
    factors: [Option<Jet>; 6],
}

/// One over the size, which moments are in units of.
fn unit_of(m: &Manipulator) -> Interval {
    Interval::from(1.0).checked_div(Interval::from(m.size())).unwrap_or(Interval::WHOLE)
}

impl System {
    /// The lines of legs, without a load; `factors` convert the solution to forces or torques.
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

    /// Rates of drives by columns, without a load: the effect of drive forces on the platform.
    pub(super) fn of_rates(frame: &CellFrame<'_>, m: &Manipulator, rates: &[[Jet; 6]; 6]) -> Self {
        let unit = unit_of(m);
        let rows = std::array::from_fn(|r| {
            std::array::from_fn(|i| if r < 3 { rates[i][r] } else { rates[i][r].times(unit) })
        });
        let one = Some(frame.constant(Interval::from(1.0)));
        Self { rows, right: [frame.constant(Interval::ZERO); 6], factors: [one; 6] }
    }

    /// The lines of the legs of a frame, or the rates of their drives if screws couple rotation and length. `None`
    /// where these may be undetermined.
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
        let coordinates = |v: &nalgebra::Vector3<f64>| -> IntervalVector { [0, 1, 2].map(|k| v[k].into()) };
        let wrench = load.wrench_of(
            |v| frame.fixed(&coordinates(v)),
            |v| frame.turned(&coordinates(v)),
            |i| {
                let leg = frame.bare_leg(m, i);
                (leg.arm, leg.line)
            },
        )?;
        let right = std::array::from_fn(|r| if r < 3 { -wrench[r] } else { -wrench[r].times(unit) });
        Some(Self { right, ..lines })
    }

    pub(super) fn values(&self) -> IntervalMatrix {
        std::array::from_fn(|r| std::array::from_fn(|i| self.rows[r][i].value))
    }

    pub(super) fn slopes(&self, k: usize) -> IntervalMatrix {
        std::array::from_fn(|r| std::array::from_fn(|i| self.rows[r][i].slope(k)))
    }

    fn is_second_order(&self) -> bool {
        self.right[0].is_second_order()
    }
}

/// A bound of `|I - K A|` and the approximate inverse `K` that solves systems with it.
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
        let off = self.beside(&start)?;
        Some(std::array::from_fn(|i| start[i] + Interval::about_zero(off[i])))
    }

    /// Bounds of `|G - K b|`, from `K b`.
    fn beside(&self, start: &[Interval; 6]) -> Option<[f64; 6]> {
        let gap = Interval::from(1.0) - Interval::from(self.factor);
        let mut norm = 0.0_f64;
        for (x, u) in start.iter().zip(&self.weights) {
            norm = norm.max(Interval::from(x.magnitude()).checked_div(Interval::from(*u) * gap)?.hi());
        }
        let norm = Interval::from(norm);
        Some(std::array::from_fn(|i| {
            let sum =
                (0..6).fold(Interval::ZERO, |s, k| s + self.defect[i][k] * Interval::from(self.weights[k]));
            (sum * norm).magnitude()
        }))
    }

    /// The solution of the force system, with slopes, for all enclosed matrices.
    fn solution(&self, system: &System, variables: usize) -> Option<SolvedForces> {
        let value = self.solve(&std::array::from_fn(|r| system.right[r].value))?;
        let mut slopes = Vec::with_capacity(variables);
        for k in 0..variables {
            let a = system.slopes(k);
            let right =
                std::array::from_fn(|r| (0..6).fold(system.right[r].slope(k), |s, i| s - a[r][i] * value[i]));
            slopes.push(self.solve(&right)?);
        }
        Some(SolvedForces { value, slopes })
    }

    /// Distance of the solution over a cell from its tangent at `z`; `here` is the solution there.
    fn bend(&self, here: &SolvedForces, over: &System, cell: &ChartCell, z: &[f64; 6]) -> Option<Bend> {
        let n = here.slopes.len();
        let steps: Vec<Interval> = (0..n).map(|k| cell.side(k) - Interval::from(z[k])).collect();
        let tangent: [Interval; 6] = std::array::from_fn(|i| {
            here.slopes.iter().zip(&steps).fold(here.value[i], |s, (slope, h)| s + slope[i] * *h)
        });
        let changes: Vec<IntervalMatrix> = (0..n).map(|k| over.slopes(k)).collect();
        let mut curves = Vec::new();
        let mut rest = [Interval::ZERO; 6];
        for k in 0..n {
            for l in k..n {
                let right = std::array::from_fn(|r| {
                    (0..6).fold(over.right[r].curve(k, l), |s, i| {
                        let crossed =
                            changes[k][r][i] * here.slopes[l][i] + changes[l][r][i] * here.slopes[k][i];
                        s - over.rows[r][i].curve(k, l) * tangent[i] - crossed
                    })
                });
                let curve = apply(&self.inverse, &right);
                // half the quadratic form, in which a product of two steps occurs twice
                let both = if k == l { steps[k].square().scaled(0.5) } else { steps[k] * steps[l] };
                rest = std::array::from_fn(|i| rest[i] + curve[i] * both);
                curves.push(curve);
            }
        }
        let off = self.beside(&rest)?;
        let value = std::array::from_fn(|i| tangent[i] + rest[i] + Interval::about_zero(off[i]));
        Some(Bend { tangent, curves, off, value })
    }
}

/// `G` and its slopes, by variable: at a point, or over a cell.
struct SolvedForces {
    value: [Interval; 6],
    slopes: Vec<[Interval; 6]>,
}

impl SolvedForces {
    /// The forces, with slopes.
    fn forces(&self, system: &System) -> Option<[Jet; 6]> {
        let n = self.slopes.len();
        let mut out = system.right;
        for (i, x) in out.iter_mut().enumerate() {
            let slopes = std::array::from_fn(|k| self.slopes.get(k).map_or(Interval::ZERO, |s| s[i]));
            *x = Jet::linear(self.value[i], slopes, n, false) * system.factors[i]?;
        }
        Some(out)
    }
}

/// `G(z + h) = G(z) + sum G_k h_k + (h^T C h) / 2 + e` over a cell.
struct Bend {
    /// Values of `G(z) + sum G_k h_k`.
    tangent: [Interval; 6],
    /// `C_kl`, `k <= l`, by rows.
    curves: Vec<[Interval; 6]>,
    /// Bounds of `|e|`.
    off: [f64; 6],
    /// Values of `G`.
    value: [Interval; 6],
}

impl Bend {
    /// `F = G s` in the same way, with the factor `s` of a force at `z` and over the cell. It returns value and
    /// second-order form over the cell, and the remainder of `F` beside its tangent with that form.
    fn force(&self, i: usize, here: &SolvedForces, at: &Jet, over: &Jet) -> (Jet, f64) {
        let n = here.slopes.len();
        let mut out = over.alike(self.value[i] * over.value);
        let mut curves = self.curves.iter();
        for k in 0..n {
            for l in k..n {
                let crossed = here.slopes[k][i] * at.slope(l) + here.slopes[l][i] * at.slope(k);
                let own = curves.next().map_or(Interval::WHOLE, |c| c[i]);
                out.set_curve(k, l, own * over.value + self.tangent[i] * over.curve(k, l) + crossed);
            }
        }
        (out, (Interval::from(self.off[i]) * over.value).magnitude())
    }
}

/// A force may push or pull.
const SIGNS: [f64; 2] = [1.0, -1.0];

/// A lower bound of `greatest - |F_i|` over a cell for all legs, or of the torque margin of each crank. Also an upper
/// bound of the least value at `z`.
///
/// The bound is of second order if the frame over the cell is; otherwise it uses the mean value theorem.
pub(super) fn force(
    chart: &Chart,
    cell: &ChartCell,
    z: &[f64; 6],
    frames: (&CellFrame<'_>, &CellFrame<'_>),
    (m, cranks, greatest): (&Manipulator, Option<&CrankFrames<'_>>, f64),
    load: &Load,
) -> (Bounded, f64) {
    let (n, nothing) = (chart.coordinates(), Bounded::nothing(cell));
    let here = System::over(frames.0, m, cranks, load).and_then(|at| {
        let solution = ForceSolver::new(&at, &at, &ChartCell::point(*z), z, n)?.solution(&at, n)?;
        let forces = solution.forces(&at)?;
        Some((at, solution, forces))
    });
    let Some((at, solution, forces)) = here else { return (nothing, f64::INFINITY) };
    let left = |f: &Jet, sign: f64| f.alike(Interval::from(greatest)) - f.times(Interval::from(sign));
    let all_left = |f: &Jet| SIGNS.map(|sign| left(f, sign));
    let upper = forces.iter().flat_map(all_left).map(|x| x.value.hi()).fold(f64::INFINITY, f64::min);
    let below = || {
        let over = System::over(frames.1, m, cranks, load)?;
        let solver = ForceSolver::new(&at, &over, cell, z, n)?;
        if !over.is_second_order() {
            let all = solver.solution(&over, n)?.forces(&over)?;
            let pairs = forces.iter().flat_map(all_left).zip(all.iter().flat_map(all_left));
            return pairs.map(|(p, o)| local::below_first_order(chart, cell, z, &p, &o)).reduce(Bounded::min);
        }
        let bend = solver.bend(&solution, &over, cell, z)?;
        let mut parts = Vec::with_capacity(12);
        for (i, f) in forces.iter().enumerate() {
            let (near, off) = bend.force(i, &solution, &at.factors[i]?, &over.factors[i]?);
            parts.extend(SIGNS.map(|sign| (left(f, sign), left(&near, sign), off)));
        }
        // skip the quadratic form if the values alone show a lesser part
        parts.sort_by(|a, b| a.1.value.lo().total_cmp(&b.1.value.lo()));
        let mut least: Option<Bounded> = None;
        for (p, o, off) in &parts {
            if least.is_some_and(|least| least.below <= o.value.lo()) {
                break;
            }
            let mut own = local::below(chart, cell, z, p, o);
            own.below = (Interval::from(own.below) - Interval::from(*off)).lo().max(o.value.lo());
            least = Some(least.map_or(own, |least| least.min(own)));
        }
        least
    };
    (below().unwrap_or(nothing), upper)
}
