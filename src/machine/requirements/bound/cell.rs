//! Bounds of a function over a cell, from points of it.

use super::cone::Sector;
use super::frame::CellFrame;
use super::function::BoundedFunction;
use super::local::{self, Bounded};
use super::stiffness::SoftestMotion;
use super::{CellEvaluator, force, gap};
use crate::requirements::TermKind;
use num::interval::Interval;
use num::jet::Jet;
use platform::geom::{Chart, ChartCell};
use platform::manipulator::Body;

/// Bounds of a cell.
pub(super) struct CellBounds {
    pub(super) bounded: Bounded,
    /// Proved upper bound of the margin at `z`, which is a pose of the workspace.
    pub(super) upper: f64,
    pub(super) z: [f64; 6],
    /// The part of the cell that can contain the least margin; `None` if nothing is left.
    pub(super) rest: Option<ChartCell>,
    /// Amount by which the width of the sector loosens the bound.
    pub(super) loose_sector: f64,
}

/// Bounds of a cell from one of its points.
pub(super) struct AtPoint {
    pub(super) bounded: Bounded,
    pub(super) upper: f64,
    pub(super) rest: Option<ChartCell>,
    pub(super) loose_sector: f64,
    /// Slopes at the point, of a function that falls with the margin towards worse poses.
    pub(super) slope: Option<[f64; 6]>,
}

impl AtPoint {
    pub(super) fn nothing(cell: &ChartCell) -> Self {
        Self {
            bounded: Bounded::nothing(cell),
            upper: f64::INFINITY,
            rest: Some(*cell),
            loose_sector: 0.0,
            slope: None,
        }
    }
}

/// Steps along the slopes from a point of each cell.
const STEPS: usize = 6;

impl CellEvaluator<'_> {
    pub(super) fn evaluate(
        &self,
        function: BoundedFunction,
        c: usize,
        cell: &ChartCell,
        sector: &Sector,
        known: Option<[f64; 6]>,
    ) -> CellBounds {
        let chart = &self.charts[c];
        let held = |x: [f64; 6]| -> [f64; 6] { std::array::from_fn(|k| x[k].clamp(cell.lo[k], cell.hi[k])) };
        // expansion points: near the middle, and as near as possible to the worst known point if that is not far
        let mut points = vec![held(chart.pulled_inside(cell.centre()))];
        if let Some(x) = known {
            let near = held(x);
            let close = (0..6).all(|k| (near[k] - x[k]).abs() <= cell.hi[k] - cell.lo[k]);
            if close && (0..6).any(|k| near[k].to_bits() != points[0][k].to_bits()) {
                points.push(near);
            }
        }
        // for joints with offsets the rates have first derivatives only
        let second = match function {
            BoundedFunction::Load(_) | BoundedFunction::Platform(_) => self.joints.is_none(),
            _ => true,
        };
        let over = CellFrame::over(chart, cell, second).with_joints(self.joints);
        let mut out = CellBounds {
            bounded: Bounded { below: f64::NEG_INFINITY, ..Bounded::nothing(cell) },
            upper: f64::INFINITY,
            z: points[0],
            rest: Some(*cell),
            loose_sector: 0.0,
        };
        for (number, z) in points.into_iter().enumerate() {
            let at = CellFrame::over(chart, &ChartCell::point(z), false).with_joints(self.joints);
            let found = self.at_point(function, chart, cell, sector, &z, (&at, &over));
            if number == 0 {
                (out.bounded, out.rest, out.loose_sector) = (found.bounded, found.rest, found.loose_sector);
            } else {
                out.bounded = out.bounded.max(found.bounded);
            }
            // only points of the workspace count
            if chart.scale_of(&z) <= 1.0 && found.upper < out.upper {
                (out.upper, out.z) = (found.upper, z);
            }
            if let (Some(slope), BoundedFunction::Leg(kind, i), 0) = (found.slope, function, number) {
                self.follow((kind, i), chart, slope, &mut out);
            }
        }
        out
    }

    /// Goes to the pose of the workspace where a function with the slopes at this point is least, and repeats while
    /// margins fall. Functions with boundary minima, such as lengths and angles, reach a local minimum after a few
    /// steps.
    fn follow(&self, (kind, i): (TermKind, usize), chart: &Chart, mut slope: [f64; 6], out: &mut CellBounds) {
        for _ in 0..STEPS {
            let y = farthest(chart, &slope);
            let there = CellFrame::over(chart, &ChartCell::point(y), false).with_joints(self.joints);
            let Some(value) = self.leg_value(kind, i, &there) else { return };
            let upper = self.margin((kind, i), value.value).hi();
            if !(chart.scale_of(&y) <= 1.0 && upper < out.upper) {
                return;
            }
            (out.upper, out.z) = (upper, y);
            slope = std::array::from_fn(|k| value.slope(k).centre_and_radius().0);
        }
    }

    /// An upper bound of the margin at a point, for the functions of one leg.
    fn upper(&self, function: BoundedFunction, at: &CellFrame<'_>) -> f64 {
        let BoundedFunction::Leg(kind, i) = function else { return f64::INFINITY };
        self.leg_value(kind, i, at).map_or(f64::INFINITY, |x| self.margin((kind, i), x.value).hi())
    }

    /// A lower bound over the cell, an upper one at `z`, and the rest of the cell.
    fn at_point(
        &self,
        function: BoundedFunction,
        chart: &Chart,
        cell: &ChartCell,
        sector: &Sector,
        z: &[f64; 6],
        frames: (&CellFrame<'_>, &CellFrame<'_>),
    ) -> AtPoint {
        let nothing = AtPoint::nothing(cell);
        if self.required.hardware.is_coupled() && self.joints.is_none() {
            return nothing;
        }
        match function {
            BoundedFunction::Leg(kind, i) => {
                let slopes = |at: &Jet| Some(std::array::from_fn(|k| at.slope(k).centre_and_radius().0));
                if let Some(hinge) = self.hinge(kind, i).filter(|h| chart.coordinates() > 1 && h.has_sides())
                {
                    let (Some(at), Some(over)) =
                        (hinge.value(frames.0, sector), hinge.value(frames.1, sector))
                    else {
                        return nothing;
                    };
                    let mut bounded = local::below(chart, cell, z, &at.value, &over.value);
                    bounded.below = hinge.side_margin(bounded.below, &over);
                    let upper = self.upper(function, frames.0);
                    return AtPoint { bounded, upper, slope: slopes(&at.value), ..nothing };
                }
                if let Some(cone) = self.cone(function, chart) {
                    let (Some(at), Some(over)) = (cone.value(frames.0, sector), cone.value(frames.1, sector))
                    else {
                        return nothing;
                    };
                    let mut bounded = local::below(chart, cell, z, &at.value, &over.value);
                    bounded.below = cone.margin(bounded.below, &over);
                    let loose_sector = over.loose;
                    let upper = self.upper(function, frames.0);
                    return AtPoint { bounded, upper, loose_sector, slope: slopes(&at.value), ..nothing };
                }
                let value = |frame: &CellFrame<'_>| self.leg_value(kind, i, frame);
                let (Some(at), Some(over)) = (value(frames.0), value(frames.1)) else { return nothing };
                let mut bounded = local::below(chart, cell, z, &at, &over);
                bounded.below = self.margin((kind, i), Interval::from(bounded.below)).lo();
                let (upper, rest) = (self.margin((kind, i), at.value).hi(), shrunk(chart, cell, &over));
                AtPoint { bounded, upper, rest, slope: slopes(&at), ..nothing }
            }
            BoundedFunction::Joint { leg, end, side } => {
                let value = |frame: &CellFrame<'_>| self.joint_value(leg, end, side, frame);
                let (Some(at), Some(over)) = (value(frames.0), value(frames.1)) else { return nothing };
                let mut bounded = local::below(chart, cell, z, &at, &over);
                bounded.below = self.envelope_margin(leg, end, side, Interval::from(bounded.below)).lo();
                let upper = self.envelope_margin(leg, end, side, at.value).hi();
                let slope = std::array::from_fn(|k| at.slope(k).centre_and_radius().0);
                AtPoint { bounded, upper, slope: Some(slope), ..nothing }
            }
            BoundedFunction::Load(k) => {
                let of_cranks = self.required.cranks.as_ref().map(|cranks| cranks.max_torque);
                if of_cranks.is_some() && self.cranks.is_none() {
                    return nothing;
                }
                let greatest = of_cranks.unwrap_or(self.required.hardware.drive_limit(TermKind::LegForce));
                let drives = (self.m, self.cranks, greatest.unwrap_or(f64::INFINITY));
                let (bounded, upper) = force::force(chart, cell, z, frames, drives, &self.required.loads[k]);
                AtPoint { bounded, upper, ..nothing }
            }
            BoundedFunction::Platform(kind) => {
                let Some(softest) = SoftestMotion::new(self.m, self.required, self.terms, kind) else {
                    return nothing;
                };
                let (bounded, upper) = softest.bounds(chart, cell, z, frames);
                AtPoint { bounded, upper, ..nothing }
            }
            BoundedFunction::Pair(i, j) => {
                let parts = |frame: &CellFrame<'_>, i: usize| self.parts(frame, i);
                let (ours, theirs) =
                    ((parts(frames.0, i), parts(frames.1, i)), (parts(frames.0, j), parts(frames.1, j)));
                self.gaps(chart, cell, z, (&ours.0, &ours.1), (&theirs.0, &theirs.1))
            }
            BoundedFunction::Body(i, k) => {
                let body = &self.required.keep_outs[k];
                let ours = (self.parts(frames.0, i), self.parts(frames.1, i));
                let theirs = (vec![gap::body_part(frames.0, body)], vec![gap::body_part(frames.1, body)]);
                self.gaps(chart, cell, z, (&ours.0, &ours.1), (&theirs.0, &theirs.1))
            }
            BoundedFunction::Payload(i) => {
                let Some(shape) = &self.required.payload_shape else { return nothing };
                let ours = (self.parts(frames.0, i), self.parts(frames.1, i));
                let payload = |frame: &CellFrame<'_>| vec![gap::shape_part(frame, shape, Body::Platform)];
                let theirs = (payload(frames.0), payload(frames.1));
                self.gaps(chart, cell, z, (&ours.0, &ours.1), (&theirs.0, &theirs.1))
            }
            BoundedFunction::Plate(i, body) => {
                let Some(plate) = self.terms.plate(body) else { return nothing };
                self.plate_gap(chart, cell, z, frames, (i, body, plate))
            }
        }
    }
}

/// The minimum of a linear function with given slopes on a chart.
fn farthest(chart: &Chart, slope: &[f64; 6]) -> [f64; 6] {
    let root = &chart.root;
    let mut out: [f64; 6] = std::array::from_fn(|k| if slope[k] > 0.0 { root.lo[k] } else { root.hi[k] });
    for group in &chart.balls {
        let norm = group.iter().map(|k| slope[*k] * slope[*k]).sum::<f64>().sqrt();
        if norm > 0.0 {
            for k in group {
                out[*k] = -slope[*k] / norm * (1.0 - 4.0 * f64::EPSILON);
            }
        }
    }
    out
}

/// The rest of a cell after removing sides that a slope of constant sign excludes. The least value over the workspace
/// lies at the end of a side only if that is an end of the workspace. Coordinates of balls have no such ends.
fn shrunk(chart: &Chart, cell: &ChartCell, over: &Jet) -> Option<ChartCell> {
    let mut out = *cell;
    for k in (0..chart.coordinates()).filter(|k| !chart.balls.iter().any(|g| g.contains(k))) {
        let slope = over.slope(k);
        if cell.lo[k] >= cell.hi[k] {
            continue;
        }
        if slope.lo() > 0.0 {
            if cell.lo[k] > chart.root.lo[k] {
                return None;
            }
            out.hi[k] = out.lo[k];
        } else if slope.hi() < 0.0 {
            if cell.hi[k] < chart.root.hi[k] {
                return None;
            }
            out.lo[k] = out.hi[k];
        }
    }
    Some(out)
}
