//! A lower bound of a smooth function over a cell, from its derivatives.
//!
//! Let `z` be a point of the cell with the slopes `g`, and `H` the second derivatives over the cell. Taylor's theorem
//! gives for all `q` of the cell
//!
//! ```text
//! f(q) >= f(z) + g . (q - z) + (q - z)^T H (q - z) / 2.
//! ```
//!
//! If `q` lies in the unit ball of some coordinates, `f + m (|q|^2 - 1) / 2` with `m >= 0` may replace `f`, since it is
//! no larger there (Lagrange). With `m = -g . z / |z|^2` the slopes nearly vanish at a worst pose on the sphere, and
//! the curvature gains `m`. The quadratic form is at least `-sum s_k` if the elimination of `D H D + diag(s)` has
//! positive pivots for all matrices of the interval matrix. `D` holds the half widths of the cell. Gershgorin's circles
//! give the other bound.

use num::interval::Interval;
use num::jet::Jet;
use platform::geom::{Chart, ChartCell};

/// A bound, and the amount by which each coordinate loosens it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounded {
    pub(super) below: f64,
    pub(super) loose: [f64; 6],
}

impl Bounded {
    /// The trivial bound.
    pub(super) fn nothing(cell: &ChartCell) -> Self {
        Self { below: f64::NEG_INFINITY, loose: std::array::from_fn(|k| cell.hi[k] - cell.lo[k]) }
    }

    /// The lower one of two bounds.
    pub(super) fn min(self, other: Self) -> Self {
        if other.below < self.below { other } else { self }
    }

    /// The higher one of two bounds.
    pub(super) fn max(self, other: Self) -> Self {
        if other.below > self.below { other } else { self }
    }
}

fn sum(terms: impl Iterator<Item = Interval>) -> Interval {
    terms.fold(Interval::ZERO, |s, x| s + x)
}

/// The multipliers of the balls at `z`; zero for balls that contain the whole cell.
fn multipliers(chart: &Chart, cell: &ChartCell, at: &Jet, z: &[f64; 6]) -> Vec<f64> {
    let of = |group: &Vec<usize>| {
        if !(cell.norm_squared(group).hi() > 1.0) {
            return 0.0;
        }
        let square: f64 = group.iter().map(|k| z[*k] * z[*k]).sum();
        let along: f64 = group.iter().map(|k| z[*k] * at.slope(*k).centre_and_radius().0).sum();
        let m = -along / square;
        if m.is_finite() { m.max(0.0) } else { 0.0 }
    };
    chart.balls.iter().map(of).collect()
}

/// The multiplier of each coordinate.
fn by_coordinate(chart: &Chart, multipliers: &[f64]) -> [f64; 6] {
    let mut out = [0.0; 6];
    for (group, m) in chart.balls.iter().zip(multipliers) {
        for k in group {
            out[*k] = *m;
        }
    }
    out
}

/// `f(z) + sum m (|z|^2 - 1) / 2`.
fn constant(chart: &Chart, at: &Jet, z: &[f64; 6], multipliers: &[f64]) -> Interval {
    let point = ChartCell::point(*z);
    let terms = chart
        .balls
        .iter()
        .zip(multipliers)
        .map(|(group, m)| Interval::from(0.5 * m) * (point.norm_squared(group) - Interval::from(1.0)));
    at.value + sum(terms)
}

/// Lower bound from values and derivatives at the point `z` (`at`, first order) and over the cell (`over`, second
/// order).
pub(super) fn below(chart: &Chart, cell: &ChartCell, z: &[f64; 6], at: &Jet, over: &Jet) -> Bounded {
    let best = multipliers(chart, cell, at, z);
    let plain = with(chart, cell, z, at, over, &vec![0.0; best.len()]);
    let found =
        if best.iter().any(|m| *m > 0.0) { plain.max(with(chart, cell, z, at, over, &best)) } else { plain };
    Bounded { below: found.below.max(over.value.lo()), ..found }
}

fn with(chart: &Chart, cell: &ChartCell, z: &[f64; 6], at: &Jet, over: &Jet, multipliers: &[f64]) -> Bounded {
    let n = chart.coordinates();
    let extra = by_coordinate(chart, multipliers);
    let reach: [f64; 6] = std::array::from_fn(|k| cell.reach(z, k));
    let mut loose = [0.0; 6];
    let linear = sum((0..n).map(|k| {
        let slope = at.slope(k) + Interval::from(extra[k]) * Interval::from(z[k]);
        let least = (slope * (cell.side(k) - Interval::from(z[k]))).lo().min(0.0);
        loose[k] += -0.2 * least;
        Interval::from(least)
    }));
    let scaled = |i: usize, j: usize| {
        let added = if i == j { Interval::from(extra[i]) } else { Interval::ZERO };
        (over.curve(i, j) + added) * Interval::from(reach[i]) * Interval::from(reach[j])
    };
    let form: Vec<Vec<Interval>> = (0..n).map(|i| (0..n).map(|j| scaled(i, j)).collect()).collect();
    for (row, l) in form.iter().zip(&mut loose) {
        *l += row.iter().map(|x| x.magnitude()).sum::<f64>();
    }
    let bend = Interval::from(form_below(form));
    let all = constant(chart, at, z, multipliers) + linear + bend;
    let below = if all.lo().is_nan() { f64::NEG_INFINITY } else { all.lo() };
    Bounded { below, loose }
}

/// Lower bound from values and slopes at `z` and slopes over the cell (`over`): the mean value theorem.
pub(super) fn below_first_order(
    chart: &Chart,
    cell: &ChartCell,
    z: &[f64; 6],
    at: &Jet,
    over: &Jet,
) -> Bounded {
    let n = chart.coordinates();
    let mut best = Bounded { below: over.value.lo(), loose: [0.0; 6] };
    for k in 0..n {
        let s = over.slope(k);
        best.loose[k] = cell.reach(z, k) * (0.2 * s.magnitude() + (s.hi() - s.lo()));
    }
    let chosen = multipliers(chart, cell, at, z);
    for m in [vec![0.0; chosen.len()], chosen] {
        let extra = by_coordinate(chart, &m);
        let linear = sum((0..n).map(|k| {
            let slope = over.slope(k) + Interval::from(extra[k]) * cell.side(k);
            Interval::from((slope * (cell.side(k) - Interval::from(z[k]))).lo())
        }));
        best.below = best.below.max((constant(chart, at, z, &m) + linear).lo());
    }
    best
}

/// Half the least value of a symmetric form over the cube `|x_k| <= 1`, bounded from below by a non-positive number.
fn form_below(form: Vec<Vec<Interval>>) -> f64 {
    let n = form.len();
    let circles = sum((0..n).map(|k| {
        let others = sum((0..n).filter(|j| *j != k).map(|j| Interval::from(form[k][j].magnitude())));
        Interval::from((others - form[k][k]).hi().max(0.0))
    }));
    let shifts = shifts(form);
    let least = shifts.hi().min(circles.hi());
    if least.is_finite() { -0.5 * least } else { f64::NEG_INFINITY }
}

/// The sum of shifts of the diagonal that make all pivots positive.
fn shifts(mut form: Vec<Vec<Interval>>) -> Interval {
    let n = form.len();
    let mut total = Interval::ZERO;
    for k in 0..n {
        let beside = (k + 1..n).map(|j| form[k][j].magnitude()).fold(0.0, f64::max);
        let lowest = form[k][k].lo();
        let mut pivot = form[k][k];
        if !(lowest >= 0.1 * beside) {
            // a pivot as large as the rest of its row keeps the rest of the elimination small
            let shift = Interval::from(beside) - Interval::from(lowest);
            let shift = Interval::from(shift.hi().max(0.0));
            total = total + shift;
            pivot = pivot + shift;
        }
        if beside == 0.0 {
            continue;
        }
        for i in k + 1..n {
            let Some(factor) = form[k][i].checked_div(pivot) else { return Interval::WHOLE };
            for j in i..n {
                let lost = if i == j {
                    // a square over a positive pivot
                    form[k][i].square().checked_div(pivot).unwrap_or(Interval::WHOLE)
                } else {
                    factor * form[k][j]
                };
                let left = form[i][j] - lost;
                (form[i][j], form[j][i]) = (left, left);
            }
        }
    }
    total
}

#[cfg(test)]
mod tests {
    use super::*;
    use num::Rng;

    /// No point of the cube is below the bound, and definite forms are recognised.
    #[test]
    fn quadratic_forms_are_nowhere_below_their_bound() {
        let mut rng = Rng::new(9);
        let mut definite = 0;
        for k in 0..60 {
            let n = 2 + k % 5;
            let mut a = vec![vec![0.0; n]; n];
            for i in 0..n {
                for j in 0..=i {
                    let x = rng.normal() + if i == j { 2.0 * rng.unit() * n as f64 } else { 0.0 };
                    (a[i][j], a[j][i]) = (x, x);
                }
            }
            let form: Vec<Vec<Interval>> = a
                .iter()
                .map(|r| r.iter().map(|x| Interval::new(x - 0.01, x + 0.01).unwrap()).collect())
                .collect();
            let least = form_below(form);
            definite += usize::from(least == 0.0);
            for _ in 0..400 {
                let x: Vec<f64> = (0..n).map(|_| rng.uniform(-1.0, 1.0).signum() * rng.unit()).collect();
                let value: f64 = (0..n).map(|i| (0..n).map(|j| a[i][j] * x[i] * x[j]).sum::<f64>()).sum();
                assert!(0.5 * value >= least, "{value} {least}");
            }
        }
        assert!(definite > 10, "{definite}");
    }
}
