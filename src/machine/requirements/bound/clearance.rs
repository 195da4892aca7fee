//! Gaps between legs, bodies and plates over a cell.

use super::CellEvaluator;
use super::cell::AtPoint;
use super::frame::CellFrame;
use super::gap;
use super::local::Bounded;
use crate::requirements::plate::PlateSolid;
use num::interval::Interval;
use platform::geom::{Chart, ChartCell};
use platform::manipulator::Body;

impl CellEvaluator<'_> {
    /// The gap of a leg and a plate, minus the clearance.
    pub(super) fn plate_gap(
        &self,
        chart: &Chart,
        cell: &ChartCell,
        z: &[f64; 6],
        frames: (&CellFrame<'_>, &CellFrame<'_>),
        (i, body, plate): (usize, Body, &PlateSolid),
    ) -> AtPoint {
        let mut out = AtPoint::nothing(cell);
        let Some(leg) = &self.required.hardware.leg_body else { return out };
        let clearance = Interval::from(self.required.hardware.leg_clearance.unwrap_or(0.0));
        let cut = self.required.hardware.joint_reach(body, i);
        let free = |frame: &CellFrame<'_>| {
            gap::without_end(frame, self.m, i, leg, gap::leg_parts(frame, self.m, i, leg), (body, cut))
        };
        let ((at, at_is_cut), (over, _)) = (free(frames.0), free(frames.1));
        let mut least: Option<Bounded> = None;
        for (at, over) in matched(&at, &over) {
            let (bounded, upper) = gap::plate_gap(chart, cell, z, frames, (at, over), (plate, body));
            least = Some(least.map_or(bounded, |l| l.min(bounded)));
            out.upper = out.upper.min((Interval::from(upper) - clearance).hi());
        }
        if let Some(mut bounded) = least {
            bounded.below = (Interval::from(bounded.below) - clearance).lo();
            out.bounded = bounded;
        }
        // parts at a pose that are larger than the leg give no upper bound
        if !at_is_cut || at.len() != over.len() {
            out.upper = f64::INFINITY;
        }
        out
    }

    /// Cylinder and rod of a leg.
    pub(super) fn parts(&self, frame: &CellFrame<'_>, i: usize) -> Vec<gap::Hull> {
        self.required.hardware.leg_body.map_or_else(Vec::new, |body| gap::leg_parts(frame, self.m, i, &body))
    }

    /// The least gap of the parts of two bodies, each given at `z` and over the cell, minus the clearance.
    pub(super) fn gaps(
        &self,
        chart: &Chart,
        cell: &ChartCell,
        z: &[f64; 6],
        ours: (&[gap::Hull], &[gap::Hull]),
        theirs: (&[gap::Hull], &[gap::Hull]),
    ) -> AtPoint {
        let clearance = Interval::from(self.required.hardware.leg_clearance.unwrap_or(0.0));
        let mut out = AtPoint::nothing(cell);
        let mut least: Option<Bounded> = None;
        for (a, over_a) in matched(ours.0, ours.1) {
            for (b, over_b) in matched(theirs.0, theirs.1) {
                let (bounded, upper) = gap::gap(chart, cell, z, (a, b), (over_a, over_b));
                least = Some(least.map_or(bounded, |l| l.min(bounded)));
                out.upper = out.upper.min((Interval::from(upper) - clearance).hi());
            }
        }
        if let Some(mut bounded) = least {
            if bounded.below.is_finite() {
                bounded.below = (Interval::from(bounded.below) - clearance).lo();
            }
            out.bounded = bounded;
        }
        // a pose whose parts differ from those of the cell gives no upper bound
        if ours.0.len() != ours.1.len() || theirs.0.len() != theirs.1.len() {
            out.upper = f64::INFINITY;
        }
        out
    }
}

/// Parts at a point paired with those over the cell; a single part over the cell contains all parts of the point.
fn matched<'h>(at: &'h [gap::Hull], over: &'h [gap::Hull]) -> Vec<(&'h gap::Hull, &'h gap::Hull)> {
    if at.len() == over.len() {
        return at.iter().zip(over).collect();
    }
    // the first part starts at the base joint, as the whole leg does; its slopes only choose a direction
    over.iter().map(|o| (o, o)).collect()
}
