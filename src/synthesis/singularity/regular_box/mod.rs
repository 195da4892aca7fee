//! Sets of poses with a Jacobian proved to be regular: the largest box about a pose, and a workspace.
//!
//! Poses are those of a workspace, `R = exp([w]x) R_0`, `p = p_0 + d`, and the set of scale `t` is `|d_k| <= t D_k`,
//! `|w_k| <= t theta_k`, or the two ellipsoids with these half axes. From below: cells in which `det J != 0` is proved
//! by interval arithmetic, shell by shell. From above: a pose with the other sign of `det J`. The segment in `(d, w)`
//! from home to it stays in the set and contains a singular pose. With a pivot `q`, `p = p_0 + d + R_0 q - R q`.
//!
//! `J` is the matrix of leg lines without division by the leg lengths. For a leg map, `det J' = det A det J` at every
//! pose, so the sets are those of all equivalent platforms.
//!
//! This test shows that the leg lines are independent at all poses of a box. With `K` near the inverse of `J` at the
//! centre and `J_k` an enclosure of `dJ / dq_k` over the box, the mean value theorem gives
//!
//! ```text
//! |I - K J(q)| <= W = |I - K J(centre)| + sum_k |K J_k| half_k      entry by entry, for every q of the box.
//! ```
//!
//! If `W u < u` for some positive vector `u`, the spectral radius of `I - K J(q)` is below 1 and `J(q)` is regular.
//! Source: Neumaier, *Interval methods for systems of equations*, 1990, sec. 4.1. Rows are `[n, a x n]`,
//! `n = R b + p - a`, about the mean base joint, in units of the size.

#[cfg(test)]
mod tests;

use nalgebra::{Matrix6, Vector3};

use num::Rng;
use num::interval::Interval;
use platform::geom::enclosed::{
    IntervalMatrix, IntervalVector, apply, contraction, cross, determinant, times,
};
use platform::geom::{
    Bisection, Chart, ChartCell, Covered, Pose, PoseSpace, Region, combination, turn, turn_slope,
};
use platform::manipulator::{Manipulator, leg_determinant};

/// Shape of the set, and effort of the search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoxOptions {
    /// A box, or ellipsoids with the half widths as half axes.
    pub region: Region,
    /// Half widths `D_k` of the translations at `t = 1`, base frame, design units; not negative.
    pub translation: [f64; 3],
    /// Half widths `theta_k` of the components of the rotation vector at `t = 1`, base frame, degrees; not negative.
    pub rotation_deg: [f64; 3],
    /// The point of the platform about which it rotates, platform frame; the origin keeps `p` apart from `R`.
    pub pivot: [f64; 3],
    /// Greatest number of tested cells.
    pub regions: usize,
    /// The search stops if the proved scale is at least this share of the refuted one, below 1.
    pub enough: f64,
    /// Seed of the search for singular poses.
    pub seed: u64,
}

/// The largest set found.
#[derive(Debug, Clone, PartialEq)]
pub struct RegularBox {
    /// Proved: no singular pose for scales up to this; 0 if not even home is proved regular.
    pub proved: f64,
    /// Proved: a singular pose at this scale or below; `None` if none was found up to [`RegularBox::searched`].
    pub refuted: Option<SingularSegment>,
    /// Greatest scale of the search for singular poses: a component of the rotation vector is a half-turn, or a
    /// translation 16 times the size.
    pub searched: f64,
    /// Cells tested.
    pub regions: usize,
}

/// A segment of poses that contains a singular one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SingularSegment {
    /// Scale of the smallest set that contains the segment, rounded up.
    pub scale: f64,
    /// The pose of the far end, rounded; home is the other end, and `det J` has opposite signs at the two.
    pub pose: Pose,
}

/// The largest regular set of the shape given by `options` about `home`.
///
/// The answer brackets the largest scale: `proved <= t <= refuted.scale`.
#[must_use]
pub fn regular_box(m: &Manipulator, home: &Pose, options: &BoxOptions) -> RegularBox {
    let space = PoseSpace {
        region: options.region,
        translation: options.translation.into(),
        rotation_deg: options.rotation_deg.into(),
        pivot: options.pivot.into(),
        ..PoseSpace::at(*home)
    };
    let chart = Chart::of_region(&space);
    let lines = LegsOverChart::new(m, &chart);
    let searched = largest_scale(m.size(), &space);
    let regular_home = lines.is_regular(&ChartCell::point([0.0; 6])).is_ok();
    let Some(sign) = lines.sign_at(&[0.0; 6]).filter(|_| regular_home) else {
        return RegularBox { proved: 0.0, refuted: None, searched, regions: 1 };
    };
    let refuted = nearest_change(&lines, sign, searched, options.seed);
    let mut state = Search { lines: &lines, sign, left: options.regions, searched, refuted };
    let mut proved = 0.0;
    // shells become thinner towards the singular pose, where cells are small
    let mut part = 0.5;
    while part < 1.0 && proved < options.enough * state.limit() {
        let next = part * state.limit();
        if next > proved {
            match state.shell(proved, next) {
                Shell::Regular => proved = next,
                Shell::Singular => continue,
                Shell::Undecided => break,
            }
        }
        part = 1.0 - 0.7 * (1.0 - part);
    }
    let refuted = state.refuted.map(|(scale, x)| SingularSegment { scale, pose: chart.pose(&x) });
    RegularBox { proved, refuted, searched, regions: options.regions - state.left }
}

/// Whether the leg lines are independent at all poses of a workspace.
#[derive(Debug, Clone, PartialEq)]
pub enum Regularity {
    /// Proved: `det J` vanishes at no pose.
    Regular,
    /// Proved: `det J` vanishes at some pose. It has opposite signs at this one and at another one of the same
    /// connected part of the workspace.
    ChangesSign(Pose),
    /// The independence of the leg lines at this pose is unproved, or cells ran out near it.
    Undecided(Pose),
}

num::answer_words! {
    /// The sign of det J over the poses, as a word.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum RegularityWord as name {
        /// It vanishes at no pose.
        Proved = "proved",
        /// It vanishes at some pose.
        ChangesSign = "changes_sign",
        /// Neither is proved.
        Undecided = "undecided",
    }
}

impl Regularity {
    /// The result as a word.
    #[must_use]
    pub fn word(&self) -> RegularityWord {
        match self {
            Self::Regular => RegularityWord::Proved,
            Self::ChangesSign(_) => RegularityWord::ChangesSign,
            Self::Undecided(_) => RegularityWord::Undecided,
        }
    }

    /// The pose with the other sign, or the undecided one.
    #[must_use]
    pub fn pose(&self) -> Option<&Pose> {
        match self {
            Self::Regular => None,
            Self::ChangesSign(pose) | Self::Undecided(pose) => Some(pose),
        }
    }

    /// `Some` if proved.
    #[must_use]
    pub fn is_regular(&self) -> Option<bool> {
        match self {
            Self::Regular => Some(true),
            Self::ChangesSign(_) => Some(false),
            Self::Undecided(_) => None,
        }
    }
}

/// Assesses the region, the single poses, the trajectory and the ranges of a workspace, on at most `cells` cells for
/// each part, and counts them.
#[must_use]
pub fn regular_workspace(m: &Manipulator, space: &PoseSpace, cells: usize, seed: u64) -> (Regularity, usize) {
    let (mut doubt, mut tested) = (None, 0);
    for chart in Chart::all(space) {
        let lines = LegsOverChart::new(m, &chart);
        // the middle of a region, or an end of a step
        let starts = [[0.0; 6], chart.root.hi].map(|x| chart.pulled_inside(x));
        let Some(sign) = starts.iter().find_map(|x| lines.sign_at(x)) else {
            doubt = doubt.or(Some(chart.pose(&starts[0])));
            continue;
        };
        // rays find shallow changes of sign, for which cells would have to be small
        let whole = chart.root.lo.iter().any(|x| *x < 0.0);
        let refuted = if whole { nearest_change(&lines, sign, 1.0, seed) } else { None };
        if let Some((_, x)) = refuted {
            return (Regularity::ChangesSign(chart.pose(&x)), tested);
        }
        let (found, looked_at) = chart.bisected(
            cells,
            |cell| lines.is_regular(cell),
            |x| lines.sign_at(x).is_some_and(|s| s * sign < 0.0),
        );
        tested += looked_at;
        match found {
            Bisection::Settled => {}
            Bisection::Refuted(x) => return (Regularity::ChangesSign(chart.pose(&x)), tested),
            Bisection::Open(x) => doubt = doubt.or(Some(chart.pose(&x))),
        }
    }
    (doubt.map_or(Regularity::Regular, Regularity::Undecided), tested)
}

/// Greatest scale of the search for singular poses.
fn largest_scale(size: f64, space: &PoseSpace) -> f64 {
    let ratio = |limit: f64, widths: &Vector3<f64>| limit / widths.amax();
    ratio(16.0 * size, &space.translation).min(ratio(180.0, &space.rotation_deg))
}

enum Shell {
    Regular,
    /// A cell has a pose with the other sign, so the limit is lower.
    Singular,
    Undecided,
}

struct Search<'a> {
    lines: &'a LegsOverChart<'a>,
    /// Sign of `det J` at home.
    sign: f64,
    left: usize,
    searched: f64,
    /// Scale and end of the segment.
    refuted: Option<(f64, [f64; 6])>,
}

impl Search<'_> {
    fn limit(&self) -> f64 {
        self.refuted.map_or(self.searched, |r| r.0)
    }

    /// Decides the set of scale `to` minus that of scale `from`, by slabs and halving.
    fn shell(&mut self, from: f64, to: f64) -> Shell {
        let chart = self.lines.chart;
        let mut waiting = slabs(chart, from, to);
        while let Some(cell) = waiting.pop() {
            let beyond = chart.covers(&cell, to) == Covered::Outside;
            let before = !chart.balls.is_empty() && reach(chart, &cell) <= from;
            if beyond || before {
                continue;
            }
            if self.left == 0 {
                return Shell::Undecided;
            }
            self.left -= 1;
            let Err(axis) = self.lines.is_regular(&cell) else { continue };
            let centre = cell.centre();
            let scale = chart.scale_of(&centre);
            if scale < self.limit() && self.lines.sign_at(&centre).is_some_and(|s| s * self.sign < 0.0) {
                self.refuted = Some((scale, centre));
                return Shell::Singular;
            }
            match cell.halves(axis) {
                Some(parts) => waiting.extend(parts),
                None => return Shell::Undecided,
            }
        }
        Shell::Regular
    }
}

/// The scale of the smallest set that contains a cell, rounded up.
fn reach(chart: &Chart, cell: &ChartCell) -> f64 {
    let corner: [f64; 6] = std::array::from_fn(|k| cell.side(k).magnitude());
    chart.scale_of(&corner)
}

/// Twelve cells that cover the outer box minus the inner one, fewer for axes without width. If the sets are no boxes,
/// it is one cell that covers all.
fn slabs(chart: &Chart, inner: f64, outer: f64) -> Vec<ChartCell> {
    let axes = chart.coordinates();
    let cube = |half: f64| {
        let mut cell = ChartCell::point([0.0; 6]);
        for k in 0..axes {
            (cell.lo[k], cell.hi[k]) = (-half, half);
        }
        cell
    };
    if inner == 0.0 || !chart.balls.is_empty() {
        return vec![cube(outer)];
    }
    let mut out = Vec::new();
    for axis in 0..axes {
        for side in [-1.0, 1.0] {
            // axes before this one stay inside, those after it are free
            let mut cell = cube(outer);
            for k in 0..axis {
                (cell.lo[k], cell.hi[k]) = (-inner, inner);
            }
            let ends = [side * inner, side * outer];
            (cell.lo[axis], cell.hi[axis]) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
            out.push(cell);
        }
    }
    out
}

/// The legs of a manipulator over the poses of a chart.
#[derive(Debug)]
struct LegsOverChart<'a> {
    chart: &'a Chart,
    manipulator: &'a Manipulator,
    /// Base joints, from their mean.
    base: [IntervalVector; 6],
    /// `R_0 (b - q)` with the pivot `q`.
    arm: [IntervalVector; 6],
    /// `p_0` minus the mean base joint.
    home: IntervalVector,
    /// Middle and columns of the chart, lengths over the size.
    middle: [Interval; 6],
    columns: Vec<[Interval; 6]>,
}

impl<'a> LegsOverChart<'a> {
    fn new(manipulator: &'a Manipulator, chart: &'a Chart) -> Self {
        let [mean, _] = manipulator.mean_leg_ends();
        let unit = Interval::from(manipulator.size());
        // rounding here precedes every proof: the origin of moments is arbitrary
        let over = |x: Interval| x.checked_div(unit).unwrap_or(Interval::WHOLE);
        let ends: [[IntervalVector; 2]; 6] = std::array::from_fn(|i| manipulator.enclosed_ends(i));
        let base = ends.map(|[a, _]| std::array::from_fn(|k| over(a[k] - Interval::from(mean[k]))));
        let arm = ends.map(|[_, b]| apply(&chart.rotation, &chart.relative_to_pivot(&b).map(over)));
        let home = std::array::from_fn(|k| over(chart.position[k] - Interval::from(mean[k])));
        let column = |c: &[Interval; 6]| std::array::from_fn(|k| if k < 3 { over(c[k]) } else { c[k] });
        let (middle, columns) = (column(&chart.middle), chart.columns.iter().map(column).collect());
        Self { chart, manipulator, base, arm, home, middle, columns }
    }

    /// `det J` of rounded numbers.
    fn determinant(&self, x: &[f64; 6]) -> f64 {
        leg_determinant(self.manipulator, &self.chart.pose(x))
    }

    /// Rows `[n_i, a_i x n_i]`.
    fn rows(&self, n: impl Fn(usize) -> IntervalVector) -> IntervalMatrix {
        std::array::from_fn(|i| {
            let direction = n(i);
            let moment = cross(&self.base[i], &direction);
            std::array::from_fn(|k| if k < 3 { direction[k] } else { moment[k - 3] })
        })
    }

    /// Encloses `J` over a cell.
    fn over(&self, cell: &ChartCell) -> IntervalMatrix {
        let q = combination(&self.middle, &self.columns, cell);
        let r = turn(&[q[3], q[4], q[5]]);
        self.rows(|i| {
            let arm = apply(&r, &self.arm[i]);
            std::array::from_fn(|k| arm[k] + self.home[k] + q[k] - self.base[i][k])
        })
    }

    /// Enclosures of `dJ / dx_k` over the cell, by coordinate.
    fn slopes(&self, cell: &ChartCell) -> Vec<IntervalMatrix> {
        let q = combination(&self.middle, &self.columns, cell);
        let turning = |c: &[Interval; 6]| c[3..].iter().any(|x| *x != Interval::ZERO);
        let needed = self.columns.iter().any(turning);
        let turns: Vec<_> =
            (0..if needed { 3 } else { 0 }).map(|k| turn_slope(&[q[3], q[4], q[5]], k)).collect();
        let slope = |column: &[Interval; 6]| {
            self.rows(|i| {
                let mut step: IntervalVector = std::array::from_fn(|k| column[k]);
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
    fn is_regular(&self, cell: &ChartCell) -> Result<(), usize> {
        let centre = cell.centre();
        let slopes = self.slopes(cell);
        let reach = |k: usize| cell.reach(&centre, k);
        let steepest = |changes: &[IntervalMatrix]| {
            let weight = |k: usize| {
                let sum: f64 = changes[k].iter().flatten().map(|x| x.magnitude()).sum();
                reach(k) * if sum.is_finite() { sum } else { 1.0 }
            };
            (0..changes.len()).fold(0, |best, k| if weight(k) > weight(best) { k } else { best })
        };
        let there = self.over(&ChartCell::point(centre));
        let plain = Matrix6::from_fn(|i, k| there[i][k].centre_and_radius().0);
        // a singular centre: the axis is found without an inverse
        let Some(inverse) = plain.try_inverse() else { return Err(steepest(&slopes)) };
        let changes: Vec<IntervalMatrix> = slopes.iter().map(|s| times(&inverse, s)).collect();
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
    fn sign_at(&self, x: &[f64; 6]) -> Option<f64> {
        let d = determinant(&self.over(&ChartCell::point(*x)));
        if d.lo() > 0.0 { Some(1.0) } else { (d.hi() < 0.0).then_some(-1.0) }
    }
}

/// Number of random rays.
const RAYS: usize = 1500;

/// Steps of a ray up to the nearest change found so far.
const STEPS: usize = 60;

/// Number of rays that improve the best ones.
const IMPROVEMENTS: usize = 1500;

/// The smallest scale found up to `limit`, and the point there, with a proved change of sign between home and it.
///
/// A negative result proves nothing.
fn nearest_change(
    lines: &LegsOverChart<'_>,
    sign: f64,
    mut limit: f64,
    seed: u64,
) -> Option<(f64, [f64; 6])> {
    let mut rng = Rng::new(seed);
    let chart = lines.chart;
    let most = limit;
    let mut best: Option<(f64, [f64; 6])> = None;
    let mut direction_of = None;
    for k in 0..RAYS + IMPROVEMENTS {
        let mut direction = [0.0; 6];
        for x in direction.iter_mut().take(chart.coordinates()) {
            *x = rng.uniform(-1.0, 1.0);
        }
        if k >= RAYS {
            let Some(u) = direction_of else { break };
            // shrinking steps, since the nearest point is usually on edges of the box
            let width = 0.5 * (1.0 - (k - RAYS) as f64 / IMPROVEMENTS as f64).powi(2) + 1e-3;
            let near: [f64; 6] = u;
            for (x, y) in direction.iter_mut().zip(near).take(chart.coordinates()) {
                *x = (y + width * rng.normal()).clamp(-1.0, 1.0);
            }
        }
        let scale = chart.scale_of(&direction);
        if !(scale > 0.0) {
            continue;
        }
        let u = direction.map(|x| x / scale);
        if let Some(t) = change_along(lines, &u, limit) {
            let point = u.map(|x| x * t);
            let scale = chart.scale_of(&point);
            if scale <= most && lines.sign_at(&point).is_some_and(|s| s * sign < 0.0) {
                limit = t;
                direction_of = Some(u);
                best = Some((scale, point));
            }
        }
    }
    best
}

/// The first change of sign found along a ray, a little beyond it so that the sign there is clear.
fn change_along(lines: &LegsOverChart<'_>, u: &[f64; 6], limit: f64) -> Option<f64> {
    let value = |t: f64| lines.determinant(&u.map(|x| x * t));
    let home = value(0.0);
    let step = limit / STEPS as f64;
    let mut hit = (1..=STEPS).map(|k| k as f64 * step).find(|t| value(*t) * home < 0.0)?;
    let mut clear = hit - step;
    while hit - clear > 1e-6 * hit {
        let middle = 0.5 * (hit + clear);
        if value(middle) * home < 0.0 {
            hit = middle;
        } else {
            clear = middle;
        }
    }
    (hit < limit).then_some(hit)
}
