//! Proved bounds of the least margins over all poses of a workspace.
//!
//! Each requirement of each leg, pair, keep-out and load is a function of the pose. Its margin is bounded from below over cells of the workspace ([`local`], [`gap`], [`force`], [`stiffness`]) and from above
//! at points of them; the cell with the least bound is halved next, until the bound decides or a number of cells is used up ([`branch`]). Cells in which the margin has a slope of
//! one sign across a side of a box hold no least margin but at that side. Where points of cells come out worse than those found before, a local search goes on from them.
//!
//! `docs/theory/requirements.md` has the functions and the bounds.

mod branch;
mod cone;
mod crank;
mod force;
mod frame;
mod gap;
mod hinge;
mod joint_offsets;
mod local;
mod stiffness;
#[cfg(test)]
mod offset_tests;
#[cfg(test)]
mod tests;

use std::num::NonZeroUsize;

use self::cone::{Sector, SwingCone};
use self::crank::CrankFrames;
use self::frame::{CellFrame, enclosed};
use self::hinge::{HingeFrame, HingeLimit};
use self::joint_offsets::JointOffsets;
use self::local::Bounded;
use self::stiffness::SoftestMotion;
use super::Requirements;
use super::assess::{AssessOptions, Assessment, Margin, assess};
use super::envelope::Envelope;
use super::hardware::Housing;
use super::plate::PlateSolid;
use super::standing::Standing;
use super::term::{Term, TermKind, Terms};
use crate::geom::enclosed::{IntervalVector, dot};
use crate::geom::{Chart, ChartCell, PoseSpace, arc_cosine, degrees, radians};
use crate::manipulator::{Body, Manipulator};
use crate::num::interval::Interval;
use crate::num::jet::{Jet, norm_squared};
use crate::num::parallel::parallel;

pub use crank::{RodRegularity, regular_rods};

/// What is known of the least margin of a kind of requirement over all poses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "files",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum MarginVerdict {
    /// Proved: no margin is negative.
    Met,
    /// Proved: no margin is negative by more than the rounding of its evaluation ([`Terms::rounding`]).
    AtLimit,
    /// Proved: the margin is negative at the pose given, by more than that.
    Violated,
    /// Not proved: no violation was found.
    Searched,
}

impl MarginVerdict {
    /// The word for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Met => "met",
            Self::AtLimit => "at_limit",
            Self::Violated => "violated",
            Self::Searched => "searched",
        }
    }

    /// `Some` where it is proved.
    #[must_use]
    pub fn is_met(self) -> Option<bool> {
        match self {
            Self::Met | Self::AtLimit => Some(true),
            Self::Violated => Some(false),
            Self::Searched => None,
        }
    }
}

impl std::fmt::Display for MarginVerdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// The least margin of a kind with what is proved of it.
#[derive(Debug, Clone, PartialEq)]
pub struct MarginBound {
    /// The least margin found.
    pub found: Margin,
    /// Proved: no pose of the workspace has a smaller margin; minus infinity when nothing is proved.
    pub below: f64,
    /// What follows.
    pub verdict: MarginVerdict,
    /// Cells bounded.
    pub cells: usize,
    /// The reserve on this limit and what is known of it; `None` where none is asked for.
    pub reserve: Option<ReserveBound>,
}

/// A reserve, and whether the margin keeps it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReserveBound {
    /// What has to remain, in the unit of the margin.
    pub reserve: f64,
    /// Proved either way, or `None`.
    pub kept: Option<bool>,
}

impl MarginBound {
    /// Whether nothing is left to prove of the margin and of its reserve.
    fn is_decided(&self) -> bool {
        self.verdict.is_met().is_some() && self.keeps_reserve().is_some()
    }

    /// Whether the reserve is kept; `Some(true)` where there is none.
    #[must_use]
    pub fn keeps_reserve(&self) -> Option<bool> {
        self.reserve.map_or(Some(true), |r| r.kept)
    }
}

/// The least margins of all kinds with what is proved of them.
#[derive(Debug, Clone, PartialEq)]
pub struct MarginProof {
    /// By kind.
    pub bounds: Vec<MarginBound>,
    /// Poses looked at by sampling and searches.
    pub poses: usize,
}

impl MarginProof {
    /// `Some(false)` when a requirement is violated, `Some(true)` when all are proved to be met.
    #[must_use]
    pub fn all_met(&self) -> Option<bool> {
        let each = || self.bounds.iter().map(|b| b.verdict.is_met());
        if each().any(|x| x == Some(false)) {
            return Some(false);
        }
        each().all(|x| x == Some(true)).then_some(true)
    }

    /// The same of the reserves.
    #[must_use]
    pub fn all_reserved(&self) -> Option<bool> {
        let each = || self.bounds.iter().map(MarginBound::keeps_reserve);
        if each().any(|x| x == Some(false)) {
            return Some(false);
        }
        each().all(|x| x == Some(true)).then_some(true)
    }
}

/// [`assess()`], and proved bounds of the margins it finds, by at most `cells` cells for each kind, and by [`AssessOptions::patient_cells`] more where these leave it undecided and nothing is violated.
///
/// Deterministic for a seed. Every pose of [`PoseSpace`] is covered: its region, its single poses, and the straight motions between those of its trajectory, whatever the number of steps.
#[must_use]
pub fn prove(
    m: &Manipulator,
    required: &Requirements,
    space: &PoseSpace,
    o: &AssessOptions,
    cells: usize,
) -> MarginProof {
    let Assessment { margins, poses } = assess(m, required, space, o);
    let terms = Terms::new(m, required, &space.home);
    let charts = Chart::all(space);
    let home = Chart::of_pose(&space.home);
    let cranks = CrankFrames::new(required);
    let cranks = cranks.as_ref();
    let joints = JointOffsets::new(m, required, &home);
    let joints = joints.as_ref();
    let axes = axes(m, required, cranks, joints, &home);
    // more cells are for what is undecided, and need not come close
    let patient =
        CellJudge { m, required, terms: &terms, cranks, joints, axes, charts: charts.clone(), close: false };
    let judge = CellJudge { charts, close: o.close, ..patient };
    let threads =
        o.threads.or_else(|| std::thread::available_parallelism().ok()).map_or(1, NonZeroUsize::get);
    let proved = |k: usize| judge.proved(margins[k], cells, o.seed);
    let mut bounds = parallel(margins.len(), threads, proved, &mut |_, _| ());
    // of a design that misses something no more has to be known
    let missed = |b: &MarginBound| b.verdict == MarginVerdict::Violated || b.keeps_reserve() == Some(false);
    if o.patient_cells > cells && !bounds.iter().any(missed) {
        let more = |k: usize| {
            let bound: &MarginBound = &bounds[k];
            if bound.is_decided() || bound.found.term.kind.is_fixed() {
                return bound.clone();
            }
            let more = patient.proved(bound.found, o.patient_cells, o.seed);
            MarginBound { below: more.below.max(bound.below), cells: bound.cells + more.cells, ..more }
        };
        bounds = parallel(bounds.len(), threads, more, &mut |_, _| ());
    }
    MarginProof { bounds, poses }
}

/// Axes from which swing is measured, at the base in the base frame and at the platform in the platform frame, and their lengths.
type Axes = [[(IntervalVector, Interval); 6]; 2];

fn axes(
    m: &Manipulator,
    required: &Requirements,
    cranks: Option<&CrankFrames<'_>>,
    joints: Option<&JointOffsets>,
    home: &Chart,
) -> Axes {
    use super::hardware::JointAxes;
    let frame = CellFrame::over(home, &home.root, false).with_joints(joints);
    std::array::from_fn(|body| {
        let chosen = required.hardware.axes(Body::BOTH[body]);
        std::array::from_fn(|i| {
            let axis: IntervalVector = if let Some(JointAxes::Given(axes)) = chosen {
                std::array::from_fn(|k| Interval::from(axes[i][k]))
            } else {
                let line = match &required.cranks {
                    None => Some(frame.leg(m, i).line),
                    Some(_) => cranks.and_then(|cranks| cranks.rod_line(m, i, &frame)),
                };
                let along = line.map_or([Interval::WHOLE; 3], |line| line.map(|x| x.value));
                if body == 0 {
                    along
                } else {
                    // R_0^T n
                    std::array::from_fn(|k| dot(&std::array::from_fn(|r| home.rotation[r][k]), &along))
                }
            };
            let length = dot_square(&axis).sqrt().unwrap_or(Interval::WHOLE);
            (axis, length)
        })
    })
}

fn dot_square(v: &IntervalVector) -> Interval {
    v[0].square() + v[1].square() + v[2].square()
}

/// What is bounded: one requirement, or those that are computed together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Function {
    /// Length, swing or speed of a leg.
    Leg(TermKind, usize),
    /// Two legs.
    Pair(usize, usize),
    /// A leg and a keep-out.
    Body(usize, usize),
    /// A leg and the plate of a body.
    Plate(usize, Body),
    /// A leg and the payload.
    Payload(usize),
    /// All leg forces under a load.
    Load(usize),
    /// The softest motion of the platform on its legs.
    Platform(TermKind),
    /// A side of the envelope of the machine, or its cylinder, and the joint at an end (0 base, 1 platform) of a leg.
    Joint { leg: usize, end: usize, side: Side },
}

/// A part of an envelope.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    /// The cylinder.
    Round,
    /// The side of a box with the least value of a coordinate.
    Least(usize),
    /// The side with the greatest.
    Greatest(usize),
}

impl Function {
    fn has(self, term: &Term) -> bool {
        match self {
            Self::Leg(kind, i) => term.kind == kind && term.first == i,
            Self::Pair(i, j) => term.kind == TermKind::LegClearance && (term.first, term.second) == (i, j),
            Self::Body(i, k) => term.kind == TermKind::KeepOut && (term.first, term.second) == (i, k),
            Self::Plate(i, body) => {
                term.kind == TermKind::PlateClearance && (term.first, term.second) == (i, body.index())
            }
            Self::Payload(i) => term.kind == TermKind::PayloadClearance && term.first == i,
            Self::Load(k) => {
                matches!(term.kind, TermKind::LegForce | TermKind::CrankTorque) && term.second == k
            }
            Self::Platform(kind) => term.kind == kind,
            Self::Joint { leg, end, .. } => {
                term.kind == TermKind::MachineEnvelope && (term.first, term.second) == (leg, end)
            }
        }
    }
}

struct CellJudge<'a> {
    m: &'a Manipulator,
    required: &'a Requirements,
    terms: &'a Terms<'a>,
    /// Cranks, where they could be enclosed.
    cranks: Option<&'a CrankFrames<'a>>,
    /// Joints that are not ideal, where they could be enclosed.
    joints: Option<&'a JointOffsets>,
    axes: Axes,
    charts: Vec<Chart>,
    /// Whether bounds go on when they have decided.
    close: bool,
}

/// What is known of a cell.
struct Evaluated {
    bounded: Bounded,
    /// Proved upper bound of the margin at `z`, which is a pose of the workspace.
    upper: f64,
    z: [f64; 6],
    /// The cell less what cannot hold the least margin; `None` when nothing is left.
    rest: Option<ChartCell>,
    /// By how much the width of the sector loosens the bound.
    loose_sector: f64,
}

/// What is known of a cell from one point of it.
struct AtPoint {
    bounded: Bounded,
    upper: f64,
    rest: Option<ChartCell>,
    loose_sector: f64,
    /// Slopes at the point, of a function that falls with the margin towards worse poses.
    slope: Option<[f64; 6]>,
}

impl AtPoint {
    fn nothing(cell: &ChartCell) -> Self {
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

impl CellJudge<'_> {
    fn functions(&self, kind: TermKind) -> Vec<Function> {
        let pairs = self.m.pairs();
        match kind {
            TermKind::LegClearance => (0..6)
                .flat_map(|i| (i + 1..6).map(move |j| (i, j)))
                .filter(|(i, j)| pairs[*i].0 != pairs[*j].0 && pairs[*i].1 != pairs[*j].1)
                .map(|(i, j)| Function::Pair(i, j))
                .collect(),
            TermKind::KeepOut => (0..6)
                .flat_map(|i| (0..self.required.keep_outs.len()).map(move |k| Function::Body(i, k)))
                .collect(),
            TermKind::PlateClearance => {
                let stated = Body::BOTH.into_iter().filter(|body| self.terms.plate(*body).is_some());
                stated.flat_map(|body| (0..6).map(move |i| Function::Plate(i, body))).collect()
            }
            TermKind::PayloadClearance => (0..6).map(Function::Payload).collect(),
            TermKind::LegForce | TermKind::CrankTorque => {
                (0..self.required.loads.len()).map(Function::Load).collect()
            }
            TermKind::MachineEnvelope => {
                let sides: Vec<Side> = match self.required.envelopes.machine {
                    None => Vec::new(),
                    Some(Envelope::Cylinder { .. }) => vec![Side::Round],
                    Some(Envelope::Box { .. }) => {
                        (0..3).flat_map(|k| [Side::Least(k), Side::Greatest(k)]).collect()
                    }
                };
                let ends = (0..6).flat_map(|leg| [(leg, 0), (leg, 1)]);
                ends.flat_map(|(leg, end)| {
                    sides.iter().map(move |side| Function::Joint { leg, end, side: *side })
                })
                .collect()
            }
            kind if kind.is_of_platform() => vec![Function::Platform(kind)],
            _ => (0..6).map(|i| Function::Leg(kind, i)).collect(),
        }
    }

    fn evaluate(
        &self,
        function: Function,
        c: usize,
        cell: &ChartCell,
        sector: &Sector,
        known: Option<[f64; 6]>,
    ) -> Evaluated {
        let chart = &self.charts[c];
        let held = |x: [f64; 6]| -> [f64; 6] { std::array::from_fn(|k| x[k].clamp(cell.lo[k], cell.hi[k])) };
        // where to expand: near the middle, and as near as possible to the worst point known where that is not far
        let mut points = vec![held(chart.pulled_inside(cell.centre()))];
        if let Some(x) = known {
            let near = held(x);
            let close = (0..6).all(|k| (near[k] - x[k]).abs() <= cell.hi[k] - cell.lo[k]);
            if close && (0..6).any(|k| near[k].to_bits() != points[0][k].to_bits()) {
                points.push(near);
            }
        }
        let second = !matches!(function, Function::Load(_) | Function::Platform(_));
        let over = CellFrame::over(chart, cell, second).with_joints(self.joints);
        let mut out = Evaluated {
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
            if let (Some(slope), Function::Leg(kind, i), 0) = (found.slope, function, number) {
                self.follow((kind, i), chart, slope, &mut out);
            }
        }
        out
    }

    /// Goes to the pose of the workspace where a function with the slopes of this point is least, and on from there as long as margins fall: for functions with
    /// their least values on the boundary, as lengths and angles have them, this ends at a local one after a few steps.
    fn follow(&self, (kind, i): (TermKind, usize), chart: &Chart, mut slope: [f64; 6], out: &mut Evaluated) {
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
    fn upper(&self, function: Function, at: &CellFrame<'_>) -> f64 {
        let Function::Leg(kind, i) = function else { return f64::INFINITY };
        self.leg_value(kind, i, at).map_or(f64::INFINITY, |x| self.margin((kind, i), x.value).hi())
    }

    /// A lower bound over the cell, an upper one at `z`, and what is left of the cell.
    fn at_point(
        &self,
        function: Function,
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
            Function::Leg(kind, i) => {
                let slopes = |at: &Jet| Some(std::array::from_fn(|k| at.slope(k).centre_and_radius().0));
                if let Some(hinge) = self.hinge(kind, i).filter(|h| chart.len() > 1 && h.has_sides()) {
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
            Function::Joint { leg, end, side } => {
                let value = |frame: &CellFrame<'_>| self.joint_value(leg, end, side, frame);
                let (Some(at), Some(over)) = (value(frames.0), value(frames.1)) else { return nothing };
                let mut bounded = local::below(chart, cell, z, &at, &over);
                bounded.below = self.room_left(end, side, Interval::from(bounded.below)).lo();
                let upper = self.room_left(end, side, at.value).hi();
                let slope = std::array::from_fn(|k| at.slope(k).centre_and_radius().0);
                AtPoint { bounded, upper, slope: Some(slope), ..nothing }
            }
            Function::Load(k) => {
                let of_cranks = self.required.cranks.as_ref().map(|cranks| cranks.max_torque);
                if of_cranks.is_some() && self.cranks.is_none() {
                    return nothing;
                }
                let greatest = of_cranks.unwrap_or(self.required.hardware.max_leg_force);
                let drives = (self.m, self.cranks, greatest.unwrap_or(f64::INFINITY));
                let (bounded, upper) = force::force(chart, cell, z, frames, drives, &self.required.loads[k]);
                AtPoint { bounded, upper, ..nothing }
            }
            Function::Platform(kind) => {
                let Some(softest) = SoftestMotion::new(self.m, self.required, self.terms, kind) else { return nothing };
                let (bounded, upper) = softest.bounds(chart, cell, z, frames);
                AtPoint { bounded, upper, ..nothing }
            }
            Function::Pair(i, j) => {
                let parts = |frame: &CellFrame<'_>, i: usize| self.parts(frame, i);
                let (ours, theirs) =
                    ((parts(frames.0, i), parts(frames.1, i)), (parts(frames.0, j), parts(frames.1, j)));
                self.gaps(chart, cell, z, (&ours.0, &ours.1), (&theirs.0, &theirs.1))
            }
            Function::Body(i, k) => {
                let body = &self.required.keep_outs[k];
                let ours = (self.parts(frames.0, i), self.parts(frames.1, i));
                let theirs = (vec![gap::body_part(frames.0, body)], vec![gap::body_part(frames.1, body)]);
                self.gaps(chart, cell, z, (&ours.0, &ours.1), (&theirs.0, &theirs.1))
            }
            Function::Payload(i) => {
                let Some(shape) = &self.required.payload_shape else { return nothing };
                let ours = (self.parts(frames.0, i), self.parts(frames.1, i));
                let payload = |frame: &CellFrame<'_>| vec![gap::shape_part(frame, shape, Body::Platform)];
                let theirs = (payload(frames.0), payload(frames.1));
                self.gaps(chart, cell, z, (&ours.0, &ours.1), (&theirs.0, &theirs.1))
            }
            Function::Plate(i, body) => {
                let Some(plate) = self.terms.plate(body) else { return nothing };
                self.plate_gap(chart, cell, z, frames, (i, body, plate))
            }
        }
    }

    /// The gap of a leg and a plate, less the clearance.
    fn plate_gap(
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
        let cut = self.required.hardware.joint_reach(body);
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
        // parts at a pose that are more than the leg say nothing by being near
        if !at_is_cut || at.len() != over.len() {
            out.upper = f64::INFINITY;
        }
        out
    }

    /// Cylinder and rod of a leg.
    fn parts(&self, frame: &CellFrame<'_>, i: usize) -> Vec<gap::Hull> {
        self.required.hardware.leg_body.map_or_else(Vec::new, |body| gap::leg_parts(frame, self.m, i, &body))
    }

    /// The least gap of the parts of two bodies, each given at `z` and over the cell, less the clearance.
    fn gaps(
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
        // a pose whose parts differ from those of the cell says nothing by them
        if ours.0.len() != ours.1.len() || theirs.0.len() != theirs.1.len() {
            out.upper = f64::INFINITY;
        }
        out
    }

    /// The angle of a universal joint, for the kinds that are one.
    fn hinge(&self, kind: TermKind, leg: usize) -> Option<HingeLimit<'_>> {
        let (body, angle) = kind.hinge()?;
        let limit_deg = self.required.hardware.angle_limit_deg(kind)?;
        let first = self.required.hardware.universal(body)?.first_axes[leg];
        let (axis, _) = &self.axes[body.index()][leg];
        let first: IntervalVector = std::array::from_fn(|k| Interval::from(first[k]));
        let frame = HingeFrame::new(&first, axis)?;
        Some(HingeLimit { m: self.m, leg, platform: body == Body::Platform, frame, angle, limit_deg })
    }

    /// What a function is bounded over one by one: the directions in which a leg leans, the sides of an angle.
    fn sectors(&self, function: Function, chart: &Chart) -> Vec<Sector> {
        if let Function::Leg(kind, leg) = function
            && self.hinge(kind, leg).is_some_and(|h| chart.len() > 1 && h.has_sides())
        {
            return Sector::sides();
        }
        Sector::all(self.cone(function, chart).is_some())
    }

    /// The cone in which a leg may lean, for limits below 90 degrees and regions; on single poses and steps the cosine is as good.
    fn cone(&self, function: Function, chart: &Chart) -> Option<SwingCone<'_>> {
        let Function::Leg(kind, leg) = function else { return None };
        if chart.len() < 2 {
            return None;
        }
        let (body, swing) = match kind {
            TermKind::BaseSwing => (0, self.required.hardware.base_swing?),
            TermKind::PlatformSwing => (1, self.required.hardware.platform_swing?),
            _ => return None,
        };
        let (axis, length) = &self.axes[body][leg];
        SwingCone::new(self.m, leg, body == 1, axis, *length, swing.limit_deg)
    }

    /// A function of a joint that grows with the room left to a side of the envelope: the negative square of the distance from the axis of a cylinder, the distance from a side
    /// of a box.
    fn joint_value(&self, leg: usize, end: usize, side: Side, frame: &CellFrame<'_>) -> Option<Jet> {
        let leg = frame.bare_leg(self.m, leg);
        let at = |k: usize| if end == 0 { leg.base[k] } else { leg.line[k] + leg.base[k] };
        let constant = |x: f64| frame.constant(Interval::from(x));
        Some(match (self.required.envelopes.machine?, side) {
            (Envelope::Cylinder { center, .. }, Side::Round) => {
                let (x, y) = (at(0) - constant(center[0]), at(1) - constant(center[1]));
                -(x * x + y * y)
            }
            (Envelope::Box { min, .. }, Side::Least(k)) => at(k) - constant(min[k]),
            (Envelope::Box { max, .. }, Side::Greatest(k)) => constant(max[k]) - at(k),
            _ => return None,
        })
    }

    /// The margin for a value of the function of a joint, which it increases with.
    fn room_left(&self, end: usize, side: Side, value: Interval) -> Interval {
        let housing = self.required.hardware.housing(Body::BOTH[end]);
        // the same double as in the evaluation of a pose; its rounding is part of what the housing is
        let ball = Interval::from(super::envelope::ball(housing));
        match (self.required.envelopes.machine, side) {
            (Some(Envelope::Cylinder { radius, .. }), Side::Round) => {
                let square = -value;
                let positive =
                    Interval::new(square.lo().max(0.0), square.hi().max(0.0)).unwrap_or(Interval::WHOLE);
                Interval::from(radius) - ball - positive.sqrt().unwrap_or(Interval::WHOLE)
            }
            _ => value - ball,
        }
    }

    /// The function of a leg whose least value gives the least margin ([`CellJudge::margin`]).
    fn leg_value(&self, kind: TermKind, i: usize, frame: &CellFrame<'_>) -> Option<Jet> {
        if self.required.cranks.is_some() {
            let speed = self.required.platform_speed.unwrap_or_default();
            return self.cranks?.value((kind, i), self.m, speed, &self.axes[1][i], frame);
        }
        if let Some(joints) = self.joints.filter(|joints| joints.have_lead()) {
            match kind {
                TermKind::LegTooShort => return joints.drive(frame, self.m, i),
                TermKind::LegTooLong => return Some(-joints.drive(frame, self.m, i)?),
                TermKind::LegSpeed => return self.screw_speed(joints, i, frame),
                _ => {}
            }
        }
        let leg = frame.leg(self.m, i);
        Some(match kind {
            TermKind::LegTooShort => leg.square,
            TermKind::LegTooLong => -leg.square,
            TermKind::BaseSwing => {
                let (axis, length) = &self.axes[0][i];
                leg.cosine(&frame.fixed(axis), *length)?
            }
            TermKind::PlatformSwing => {
                let (axis, length) = &self.axes[1][i];
                leg.cosine(&frame.turned(axis), *length)?
            }
            TermKind::LegSpeed => -leg.lever_squared()?,
            kind => return self.hinge(kind, i)?.plain(frame),
        })
    }

    /// Minus the greatest speed of a drive whose screw is turned by its leg: over all velocities and angular velocities up to the greatest.
    fn screw_speed(&self, joints: &JointOffsets, i: usize, frame: &CellFrame<'_>) -> Option<Jet> {
        let speed = self.required.platform_speed.unwrap_or_default();
        let [x, y, z, a, b, c] = joints.rates(frame, self.m, i)?;
        let mut fastest = frame.constant(Interval::ZERO);
        for (row, greatest) in
            [([x, y, z], Interval::from(speed.linear)), ([a, b, c], radians(speed.angular_deg))]
        {
            if greatest != Interval::ZERO {
                fastest = fastest + norm_squared(&row).root()?.times(greatest);
            }
        }
        Some(-fastest)
    }

    /// The margin for a value of the function of a leg, which it increases with.
    fn margin(&self, (kind, leg): (TermKind, usize), value: Interval) -> Interval {
        let hardware = &self.required.hardware;
        if let Some(cranks) = self.cranks {
            return cranks.margin((kind, leg), value);
        }
        if let Some(hinge) = self.hinge(kind, leg) {
            return hinge.margin(value);
        }
        let root = |x: Interval| {
            let positive = Interval::new(x.lo().max(0.0), x.hi().max(0.0)).unwrap_or(Interval::WHOLE);
            positive.sqrt().unwrap_or(Interval::WHOLE)
        };
        let limits = hardware.leg_length.map_or((Interval::WHOLE, Interval::WHOLE), |l| match l {
            super::LengthLimits::Range(a, b) => (Interval::from(a), Interval::from(b)),
            super::LengthLimits::Stroke { dead, stroke } => {
                let once = Interval::from(dead) + Interval::from(stroke);
                (once, once + Interval::from(stroke))
            }
        });
        let swing = |s: Option<super::Swing>| Interval::from(s.map_or(f64::INFINITY, |s| s.limit_deg));
        if self.joints.is_some_and(JointOffsets::have_lead) {
            let greatest = Interval::from(hardware.max_leg_speed.unwrap_or(f64::INFINITY));
            match kind {
                TermKind::LegTooShort => return value - limits.0,
                TermKind::LegTooLong => return limits.1 + value,
                TermKind::LegSpeed => return greatest + value,
                _ => {}
            }
        }
        match kind {
            TermKind::LegTooShort => root(value) - limits.0,
            TermKind::LegTooLong => limits.1 - root(-value),
            TermKind::BaseSwing => swing(hardware.base_swing) - degrees(arc_cosine(value)),
            TermKind::PlatformSwing => swing(hardware.platform_swing) - degrees(arc_cosine(value)),
            TermKind::LegSpeed => {
                let speed = self.required.platform_speed.unwrap_or_default();
                let greatest = Interval::from(hardware.max_leg_speed.unwrap_or(f64::INFINITY));
                greatest - Interval::from(speed.linear) - root(-value) * radians(speed.angular_deg)
            }
            _ => Interval::WHOLE,
        }
    }

    /// Whether a margin keeps a reserve: by what is proved of it already, else by bounds of their own.
    /// A margin and its reserve by at most so many cells for each.
    fn proved(&self, found: Margin, cells: usize, seed: u64) -> MarginBound {
        let fixed = found.term.kind.is_fixed();
        let bound = if fixed { self.fixed(found) } else { self.bound(found, cells, seed, 0.0) };
        let reserve = self.required.reserve(bound.found.term.kind);
        if reserve == 0.0 {
            return bound;
        }
        MarginBound { reserve: Some(self.reserved(&bound, reserve, cells, seed)), ..bound }
    }

    fn reserved(&self, bound: &MarginBound, reserve: f64, cells: usize, seed: u64) -> ReserveBound {
        let rounding = self.terms.rounding(bound.found.term.kind, bound.found.pose.as_ref());
        let kept = if bound.found.value < reserve - rounding {
            Some(false)
        } else if bound.below >= reserve - rounding {
            Some(true)
        } else {
            // what no pose changes is decided by its enclosure alone
            let poses = !bound.found.term.kind.is_fixed();
            (poses && self.bound(bound.found, cells, seed, reserve).below >= -rounding).then_some(true)
        };
        ReserveBound { reserve, kept }
    }

    /// Holes of a plate, whose margins are known but for rounding.
    fn holes(&self, found: Margin) -> MarginBound {
        let rounding = self.terms.rounding(found.term.kind, None);
        let verdict = match found.standing {
            Standing::Met => MarginVerdict::Met,
            Standing::AtLimit => MarginVerdict::AtLimit,
            Standing::Violated => MarginVerdict::Violated,
        };
        MarginBound { found, below: found.value - rounding, verdict, cells: 0, reserve: None }
    }

    /// Joints in the envelope of their body.
    fn joint_in_envelope(&self, found: Margin) -> MarginBound {
        let kind = found.term.kind;
        let (body, envelope) = if kind == TermKind::PlatformEnvelope {
            (Body::Platform, self.required.envelopes.platform)
        } else {
            (Body::Base, self.required.envelopes.base)
        };
        let (half, radius) = super::envelope::room(self.required.hardware.housing(body));
        let (mut below, mut upper) = (f64::INFINITY, f64::INFINITY);
        let joints = self.m.joints(body);
        for (term, _) in self.terms.fixed().iter().filter(|(t, _)| t.kind == kind) {
            let at = enclosed(&joints[term.first]);
            let margin = envelope.map_or(Interval::WHOLE, |e| room_inside(&e, &at, &half, radius));
            (below, upper) = (below.min(margin.lo()), upper.min(margin.hi()));
        }
        let verdict = verdict(below, upper, self.terms.rounding(kind, None));
        MarginBound { found, below, verdict, cells: 0, reserve: None }
    }

    /// Distances of joints, which no pose changes.
    fn fixed(&self, found: Margin) -> MarginBound {
        let kind = found.term.kind;
        if matches!(kind, TermKind::BaseEnvelope | TermKind::PlatformEnvelope) {
            return self.joint_in_envelope(found);
        }
        if kind.plate().is_some() {
            return self.holes(found);
        }
        let body = if kind == TermKind::PlatformSpacing { Body::Platform } else { Body::Base };
        let joints = body.of((self.m.base_joints(), self.m.platform_joints()));
        let housing = self.required.hardware.housing(body);
        let (mut below, mut upper) = (f64::INFINITY, f64::INFINITY);
        for (term, _) in self.terms.fixed().iter().filter(|(t, _)| t.kind == kind) {
            let (a, b) = (enclosed(&joints[term.first]), enclosed(&joints[term.second]));
            let d: IntervalVector = std::array::from_fn(|k| a[k] - b[k]);
            let norm = dot_square(&d).sqrt().unwrap_or(Interval::WHOLE);
            let centres = self.required.min_joint_distance.map(|least| norm - Interval::from(least));
            for margin in [housing.map(|h| housing_gap(&h, &d, norm)), centres].into_iter().flatten() {
                (below, upper) = (below.min(margin.lo()), upper.min(margin.hi()));
            }
        }
        let verdict = verdict(below, upper, self.terms.rounding(kind, None));
        MarginBound { found, below, verdict, cells: 0, reserve: None }
    }
}

/// The absolute values of an interval.
fn magnitudes(x: Interval) -> Interval {
    let least = if x.lo() <= 0.0 && x.hi() >= 0.0 { 0.0 } else { x.lo().abs().min(x.hi().abs()) };
    Interval::new(least, x.magnitude()).unwrap_or(Interval::WHOLE)
}

/// Room inside an envelope, enclosed: [`Envelope::margin`].
fn room_inside(
    envelope: &Envelope,
    at: &IntervalVector,
    half: &nalgebra::Vector3<f64>,
    ball: f64,
) -> Interval {
    let ball = Interval::from(ball);
    match envelope {
        Envelope::Cylinder { radius, center } => {
            let reach = |k: usize| magnitudes(at[k] - Interval::from(center[k])) + Interval::from(half[k]);
            let away = (reach(0).square() + reach(1).square()).sqrt().unwrap_or(Interval::WHOLE);
            Interval::from(*radius) - ball - away
        }
        Envelope::Box { min, max } => {
            let sides = (0..3).flat_map(|k| {
                let own = Interval::from(half[k]) + ball;
                [at[k] - Interval::from(min[k]) - own, Interval::from(max[k]) - at[k] - own]
            });
            let least = |side: fn(&Interval) -> f64, all: &[Interval]| {
                all.iter().map(side).fold(f64::INFINITY, f64::min)
            };
            let all: Vec<Interval> = sides.collect();
            Interval::new(least(|x| x.lo(), &all), least(|x| x.hi(), &all)).unwrap_or(Interval::WHOLE)
        }
    }
}

/// Where a function with given slopes is least on a chart.
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

/// Parts at a point with those over the cell; with one part over the cell all of the point belong to it.
fn matched<'h>(at: &'h [gap::Hull], over: &'h [gap::Hull]) -> Vec<(&'h gap::Hull, &'h gap::Hull)> {
    if at.len() == over.len() {
        return at.iter().zip(over).collect();
    }
    // the first part starts at the base joint, as the whole leg does; its slopes only choose a direction
    over.iter().map(|o| (o, o)).collect()
}

fn verdict(below: f64, upper: f64, rounding: f64) -> MarginVerdict {
    if upper < -rounding {
        MarginVerdict::Violated
    } else if below >= 0.0 {
        MarginVerdict::Met
    } else if below >= -rounding {
        MarginVerdict::AtLimit
    } else {
        MarginVerdict::Searched
    }
}

/// [`Housing::gap`], enclosed.
fn housing_gap(housing: &Housing, d: &IntervalVector, norm: Interval) -> Interval {
    match housing {
        Housing::Sphere(diameter) => norm - Interval::from(*diameter),
        Housing::Box(edges) => {
            let beside =
                |x: f64, edge: f64, side: fn(Interval) -> f64| side(Interval::from(x) - Interval::from(edge));
            let least = |x: Interval| {
                if x.lo() <= 0.0 && x.hi() >= 0.0 { 0.0 } else { x.lo().abs().min(x.hi().abs()) }
            };
            let end = |size: &dyn Fn(usize) -> f64, side: fn(Interval) -> f64| {
                let g: [f64; 3] = std::array::from_fn(|k| beside(size(k), edges[k], side));
                let largest = g.into_iter().fold(f64::NEG_INFINITY, f64::max);
                if largest > 0.0 {
                    let positive: IntervalVector = g.map(|x| Interval::from(x.max(0.0)));
                    dot_square(&positive).sqrt().map_or(largest, side)
                } else {
                    largest
                }
            };
            let (lo, hi) = (end(&|k| least(d[k]), Interval::lo), end(&|k| d[k].magnitude(), Interval::hi));
            Interval::new(lo, hi).unwrap_or(Interval::WHOLE)
        }
    }
}

/// What is left of a cell when sides that a positive or negative slope rules out are taken away: the least value over the workspace is at the end of a side, if that is an end of the workspace, and
/// elsewhere if not. Coordinates of balls have no such ends.
fn shrunk(chart: &Chart, cell: &ChartCell, over: &Jet) -> Option<ChartCell> {
    let mut out = *cell;
    for k in (0..chart.len()).filter(|k| !chart.balls.iter().any(|g| g.contains(k))) {
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
