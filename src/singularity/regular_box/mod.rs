//! Sets of poses in which the Jacobian is proved to be regular: the largest box about a pose, and a workspace.
//!
//! Poses are those of a workspace, `R = exp([w]x) R_0`, `p = p_0 + d`, and the set of scale `t` is `|d_k| <= t D_k`, `|w_k| <= t theta_k`, or the two ellipsoids with
//! these half axes. From below: cells in which `det J != 0` is proved by interval arithmetic ([`enclosure`]), shell by shell. From above: a pose at which `det J` has the
//! other sign; the segment in `(d, w)` from home to it stays in the set and holds a singular pose ([`rays`]).
//!
//! `J` is the matrix of leg lines that are not divided by the leg lengths, so that for a leg map `det J' = det A det J` at every pose: the
//! sets are those of all equivalent platforms.

mod enclosure;
mod rays;

use nalgebra::Vector3;

use crate::geom::{Cell, Chart, Covered, Pose, PoseSpace, Region};
use crate::manipulator::Manipulator;
use enclosure::Lines;

/// What set is sought, and how hard.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoxOptions {
    /// A box, or ellipsoids with the half widths as half axes.
    pub region: Region,
    /// Half widths `D_k` of the translations at `t = 1`, base frame, design units; not negative.
    pub translation: [f64; 3],
    /// Half widths `theta_k` of the components of the rotation vector at `t = 1`, base frame, degrees; not negative.
    pub rotation_deg: [f64; 3],
    /// Most cells to test.
    pub regions: usize,
    /// Stop when the proved scale is at least this part of the refuted one, below 1.
    pub enough: f64,
    /// Seed of the search for singular poses.
    pub seed: u64,
}

/// The largest set found.
#[derive(Debug, Clone, PartialEq)]
pub struct RegularBox {
    /// Proved: no singular pose for scales up to this; 0 when not even home is proved regular.
    pub proved: f64,
    /// Proved: a singular pose at this scale or below; `None` when none was found up to [`RegularBox::searched`].
    pub refuted: Option<SingularSegment>,
    /// Scale up to which singular poses were looked for: where a component of the rotation vector is a half-turn, or a translation 16 times the size.
    pub searched: f64,
    /// Cells tested.
    pub regions: usize,
}

/// A segment of poses with a singular one on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SingularSegment {
    /// Scale of the smallest set that holds the segment, rounded up.
    pub scale: f64,
    /// The pose of the far end, rounded; home is the other end, `det J` has opposite signs at the two.
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
        ..PoseSpace::at(*home)
    };
    let chart = Chart::of_region(&space);
    let lines = Lines::new(m, &chart);
    let searched = largest_scale(m.size(), &space);
    let regular_home = lines.is_regular(&Cell::point([0.0; 6])).is_ok();
    let Some(sign) = lines.sign_at(&[0.0; 6]).filter(|_| regular_home) else {
        return RegularBox { proved: 0.0, refuted: None, searched, regions: 1 };
    };
    let refuted = rays::nearest_change(&lines, sign, searched, options.seed);
    let mut state = Search { lines: &lines, sign, left: options.regions, searched, refuted };
    let mut proved = 0.0;
    // shells thin out towards the singular pose, where cells get small
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
    /// Proved: `det J` vanishes at some pose. It has opposite signs at the home pose and at this one, of the same connected part of the workspace.
    ChangesSign(Pose),
    /// The leg lines at this pose are not proved to be independent, or cells ran out near it.
    Undecided(Pose),
}

/// Judges the region, the single poses and the trajectory of a workspace on at most `cells` cells for each of its parts, and counts them.
#[must_use]
pub fn regular_workspace(m: &Manipulator, space: &PoseSpace, cells: usize, seed: u64) -> (Regularity, usize) {
    let (mut doubt, mut tested) = (None, 0);
    for chart in Chart::all(space) {
        let lines = Lines::new(m, &chart);
        // home, or an end of a step
        let starts = [[0.0; 6], chart.root.hi].map(|x| chart.pulled_inside(x));
        let Some(sign) = starts.iter().find_map(|x| lines.sign_at(x)) else {
            doubt = doubt.or(Some(chart.pose(&starts[0])));
            continue;
        };
        // shallow changes of sign are found by rays, where cells would have to be small
        let whole = chart.root.lo.iter().any(|x| *x < 0.0);
        let refuted = if whole { rays::nearest_change(&lines, sign, 1.0, seed) } else { None };
        if let Some((_, x)) = refuted {
            return (Regularity::ChangesSign(chart.pose(&x)), tested);
        }
        let mut waiting = vec![chart.root];
        let mut left = cells;
        while let Some(cell) = waiting.pop() {
            if chart.covers(&cell, 1.0) == Covered::Outside {
                continue;
            }
            let inside = chart.pulled_inside(cell.centre());
            if left == 0 {
                doubt = doubt.or(Some(chart.pose(&inside)));
                break;
            }
            left -= 1;
            let Err(axis) = lines.is_regular(&cell) else { continue };
            if lines.sign_at(&inside).is_some_and(|s| s * sign < 0.0) {
                return (Regularity::ChangesSign(chart.pose(&inside)), tested + cells - left);
            }
            let Some(parts) = cell.halves(axis) else {
                doubt = doubt.or(Some(chart.pose(&inside)));
                break;
            };
            waiting.extend(parts);
        }
        tested += cells - left;
    }
    (doubt.map_or(Regularity::Regular, Regularity::Undecided), tested)
}

/// Scale up to which singular poses are looked for.
fn largest_scale(size: f64, space: &PoseSpace) -> f64 {
    let ratio = |limit: f64, widths: &Vector3<f64>| limit / widths.amax();
    ratio(16.0 * size, &space.translation).min(ratio(180.0, &space.rotation_deg))
}

enum Shell {
    Regular,
    /// A cell has a pose with the other sign: the limit is lower now.
    Singular,
    Undecided,
}

struct Search<'a> {
    lines: &'a Lines<'a>,
    /// Of `det J` at home.
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

    /// Decides the set of scale `to` less that of scale `from`, by slabs and halving.
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

/// The scale of the smallest set that holds a cell, rounded up.
fn reach(chart: &Chart, cell: &Cell) -> f64 {
    let corner: [f64; 6] = std::array::from_fn(|k| cell.side(k).magnitude());
    chart.scale_of(&corner)
}

/// Twelve cells that cover the outer box less the inner one, fewer where axes have no width; one that covers it all where the sets are no boxes.
fn slabs(chart: &Chart, inner: f64, outer: f64) -> Vec<Cell> {
    let axes = chart.len();
    let cube = |half: f64| {
        let mut cell = Cell::point([0.0; 6]);
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

#[cfg(test)]
mod tests;
