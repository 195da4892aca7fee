//! Cranks and rods over cells of poses, by the formulas of `requirements/cranks.rs` in jets. The least value of each
//! row's function gives the least margin.
//!
//! Directions are enclosed, so proofs hold for the unit vectors along and across the axis that the numbers of the
//! design define.

use super::force::{ForceSolver, System};
use super::frame::{CellFrame, LegOverCell};
use super::joint_offsets::JointOffsets;
use crate::requirements::cranks::{CrankedLeg, Cranks};
use crate::requirements::{PlatformSpeed, Requirements, TermKind};
use num::Purpose;
use num::interval::Interval;
use num::jet::{Jet, JetVector, dot, norm_squared};
use platform::geom::enclosed::{IntervalVector, cross as crossed, determinant, unit};
use platform::geom::{
    Bisection, Chart, ChartCell, Pose, PoseSpace, arc_cosine, cosine, degrees, radians, sine,
};
use platform::manipulator::Manipulator;

/// A crank with its directions enclosed: axis, tip at the angle 0, tip at 90 degrees.
#[derive(Debug, Clone, Copy)]
struct CrankFrame {
    directions: [IntervalVector; 3],
    length: Interval,
    rod: Interval,
    sign: Interval,
    /// Middle of the limits and half their width, degrees.
    range: Option<[Interval; 2]>,
}

impl CrankFrame {
    fn new(leg: &CrankedLeg) -> Option<Self> {
        let given = |v: &nalgebra::Vector3<f64>| -> IntervalVector { std::array::from_fn(|k| v[k].into()) };
        let n = unit(&given(&leg.axis))?;
        // n x zero has the direction of n x e
        let f = unit(&crossed(&n, &given(&leg.zero)))?;
        let half = Interval::from(0.5);
        let range = leg.limits_deg.map(|[least, most]| {
            let (a, b) = (Interval::from(least), Interval::from(most));
            [(a + b) * half, (b - a) * half]
        });
        Some(Self {
            directions: [n, crossed(&f, &n), f],
            length: leg.length.into(),
            rod: leg.rod.into(),
            sign: leg.sign().into(),
            range,
        })
    }
}

/// A crank and its rod over the poses of a frame.
struct CrankOverCell<'c> {
    crank: &'c CrankFrame,
    /// From the centre of the crank to the platform joint.
    leg: LegOverCell,
    fixed: [JetVector; 3],
    /// `d.n`.
    along: Jet,
    x: Jet,
    y: Jet,
    /// `rho^2`.
    square: Jet,
    k: Jet,
    /// `s^2 = l^2 - ((|d|^2 - r^2 - l^2) / (2 r))^2 - (d.n)^2`.
    left: Jet,
}

impl<'c> CrankOverCell<'c> {
    fn new(crank: &'c CrankFrame, m: &Manipulator, i: usize, frame: &CellFrame<'_>) -> Self {
        let leg = frame.leg(m, i);
        let fixed = crank.directions.map(|v| frame.fixed(&v));
        let [along, x, y] = fixed.map(|v| dot(&leg.line, &v));
        let square = x.square() + y.square();
        let (r, l) = (crank.length, crank.rod);
        let over = Interval::from(0.5).checked_div(r).unwrap_or(Interval::WHOLE);
        let k = (leg.square + frame.constant(r.square() - l.square())).times(over);
        // a triangle with the sides r and l: each quantity occurs once, so the enclosure is tight over wide cells
        let [rr, ll] = [r.square(), l.square()];
        let across = (leg.square - frame.constant(rr + ll)).times(over);
        let left = frame.constant(ll) - across.square() - along.square();
        Self { crank, leg, fixed, along, x, y, square, k, left }
    }

    /// Cosine and sine of the angle; `None` where the rod may not close, or the joint may be on the axis.
    fn turned(&self) -> Option<[Jet; 2]> {
        let s = self.left.root()?.times(self.crank.sign);
        let over = self.square.inverse_root()?.square();
        Some([(self.x * self.k - self.y * s) * over, (self.y * self.k + self.x * s) * over])
    }

    /// The rod as a leg on the tip.
    fn rod(&self, frame: &CellFrame<'_>) -> Option<LegOverCell> {
        let [cos, sin] = self.turned()?;
        let reach: JetVector = std::array::from_fn(|k| {
            (self.fixed[1][k] * cos + self.fixed[2][k] * sin).times(self.crank.length)
        });
        Some(LegOverCell {
            base: std::array::from_fn(|k| self.leg.base[k] + reach[k]),
            arm: self.leg.arm,
            line: std::array::from_fn(|k| self.leg.line[k] - reach[k]),
            square: frame.constant(self.crank.rod.square()),
        })
    }
}

/// All cranks of a design, enclosed.
#[derive(Debug)]
pub(super) struct CrankFrames<'a> {
    cranks: &'a Cranks,
    frames: [CrankFrame; 6],
}

impl<'a> CrankFrames<'a> {
    /// `None` where the design has no cranks, or one whose direction of the angle 0 may be along its axis.
    pub(super) fn new(required: &'a Requirements) -> Option<Self> {
        let cranks = required.cranks.as_deref()?;
        let mut frames = Vec::with_capacity(6);
        for leg in &cranks.legs {
            frames.push(CrankFrame::new(leg)?);
        }
        Some(Self { cranks, frames: frames.try_into().ok()? })
    }

    fn over(&self, m: &Manipulator, i: usize, frame: &CellFrame<'_>) -> CrankOverCell<'_> {
        CrankOverCell::new(&self.frames[i], m, i, frame)
    }

    /// The vector along a rod.
    pub(super) fn rod_line(&self, m: &Manipulator, i: usize, frame: &CellFrame<'_>) -> Option<JetVector> {
        Some(self.over(m, i, frame).rod(frame)?.line)
    }

    /// The rods as legs, and the factors `r s` that convert forces over rod lengths to torques.
    pub(super) fn rods(
        &self,
        m: &Manipulator,
        frame: &CellFrame<'_>,
    ) -> Option<([LegOverCell; 6], [Option<Jet>; 6])> {
        let (mut rods, mut arms) = (Vec::with_capacity(6), [None; 6]);
        for (i, arm) in arms.iter_mut().enumerate() {
            let crank = self.over(m, i, frame);
            rods.push(crank.rod(frame)?);
            *arm = Some(crank.left.root()?.times(crank.crank.length));
        }
        Some((rods.try_into().ok()?, arms))
    }

    /// The function of a row of a leg; `axis` is that of the platform joint, with its length.
    pub(super) fn value(
        &self,
        (kind, i): (TermKind, usize),
        m: &Manipulator,
        speed: PlatformSpeed,
        (axis, length): &(IntervalVector, Interval),
        frame: &CellFrame<'_>,
    ) -> Option<Jet> {
        let crank = self.over(m, i, frame);
        let (r, l) = (crank.crank.length, crank.crank.rod);
        let apart = |sign: f64| {
            let both = crank.square.root()?.times(Interval::from(2.0 * sign) * r);
            Some(crank.leg.square + frame.constant(r.square()) + both)
        };
        match kind {
            TermKind::MinRodLength => Some(-apart(-1.0)?),
            TermKind::MaxRodLength => apart(1.0),
            TermKind::CrankTransmission => {
                Some(crank.left.times(Interval::from(1.0).checked_div(l.square())?))
            }
            TermKind::CrankAngle => {
                let [middle, _] = crank.crank.range?;
                // cosines are known for angles of at most a turn
                let turns = (middle.centre_and_radius().0 / 360.0).round();
                let middle = degrees_to_radians(middle - Interval::from(360.0 * turns));
                let [cos, sin] = crank.turned()?;
                Some(cos.times(cosine(middle)) + sin.times(sine(middle)))
            }
            TermKind::TipAngle => Some(-crank.along.square()),
            TermKind::PlatformConeAngle => crank.rod(frame)?.cosine(&frame.turned(axis), *length),
            TermKind::CrankSpeed => {
                let turn = if speed.angular_deg == 0.0 {
                    frame.constant(Interval::ZERO)
                } else {
                    norm_squared(&crank.rod(frame)?.moment()).root()?
                };
                let ahead = speed.fastest(frame.constant(l), turn);
                let over = Interval::from(1.0).checked_div(r)?;
                Some(-(ahead * crank.left.inverse_root()?).times(over))
            }
            _ => None,
        }
    }

    /// The margin for a value of that function, increasing with it.
    pub(super) fn margin(&self, (kind, i): (TermKind, usize), value: Interval) -> Interval {
        let crank = &self.frames[i];
        let root = |x: Interval| {
            let positive = Interval::new(x.lo().max(0.0), x.hi().max(0.0)).unwrap_or(Interval::WHOLE);
            positive.sqrt().unwrap_or(Interval::WHOLE)
        };
        let limit = |deg: Option<f64>| Interval::from(deg.unwrap_or(f64::INFINITY));
        match kind {
            TermKind::MinRodLength => crank.rod - root(-value),
            TermKind::MaxRodLength => root(value) - crank.rod,
            TermKind::CrankTransmission => {
                signed_arc_sine(value) - Interval::from(self.cranks.min_transmission_angle_deg)
            }
            TermKind::CrankAngle => {
                let half = crank.range.map_or(Interval::WHOLE, |[_, half]| half);
                half - degrees(arc_cosine(value))
            }
            TermKind::TipAngle => {
                let sine = root(-value).checked_div(crank.rod).unwrap_or(Interval::WHOLE);
                limit(self.cranks.tip_angle_deg) - Interval::from(90.0) + degrees(arc_cosine(sine))
            }
            TermKind::PlatformConeAngle => {
                limit(self.cranks.platform_cone_angle_deg) - degrees(arc_cosine(value))
            }
            TermKind::CrankSpeed => limit(self.cranks.max_speed_deg) + degrees(value),
            _ => Interval::WHOLE,
        }
    }
}

fn degrees_to_radians(angle: Interval) -> Interval {
    angle * radians(1.0)
}

/// The angle whose sine has this square, degrees, odd in its argument.
fn signed_arc_sine(square: Interval) -> Interval {
    let of = |x: f64| {
        let sine = Interval::from(x.abs().min(1.0)).sqrt().unwrap_or(Interval::WHOLE);
        let angle = Interval::from(90.0) - degrees(arc_cosine(sine));
        if x < 0.0 { -angle } else { angle }
    };
    Interval::new(of(square.lo()).lo(), of(square.hi()).hi()).unwrap_or(Interval::WHOLE)
}

/// Regularity of the rods: whether their lines are independent at all poses of a workspace.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RodRegularity {
    /// Proved independent everywhere.
    Regular,
    /// Proved dependent at some pose. The determinant has opposite signs here and at home (or at the end of a step),
    /// and the rods close on the way.
    ChangesSign(Pose),
    /// Undecided, near this pose.
    Undecided(Pose),
}

/// Number of poses in each part of the workspace that are searched for a change of sign.
const POINTS: usize = 1500;

/// Cells of the way from home to a pose with the other sign.
const WAY: usize = 128;

/// The lines that push the platform if they are not legs with ideal joints.
#[derive(Clone, Copy)]
enum Pushing<'a> {
    Rods(&'a CrankFrames<'a>),
    Drives(&'a JointOffsets),
}

struct RodsOverChart<'a> {
    pushing: Pushing<'a>,
    m: &'a Manipulator,
    chart: &'a Chart,
}

impl RodsOverChart<'_> {
    fn lines(&self, cell: &ChartCell) -> Option<System> {
        let frame = CellFrame::over(self.chart, cell, false);
        match self.pushing {
            Pushing::Rods(cranks) => {
                let (rods, arms) = cranks.rods(self.m, &frame)?;
                Some(System::of_lines(&frame, self.m, &rods, &arms))
            }
            Pushing::Drives(joints) => {
                let frame = frame.with_joints(Some(joints));
                let lines = System::of_legs(&frame, self.m)?;
                // undetermined legs have unknown lines
                let known = lines.values().iter().flatten().all(|x| x.magnitude().is_finite());
                known.then_some(lines)
            }
        }
    }

    /// The proved sign of the determinant at a point.
    fn sign_at(&self, x: &[f64; 6]) -> Option<f64> {
        let d = determinant(&self.lines(&ChartCell::point(*x))?.values());
        if d.lo() > 0.0 { Some(1.0) } else { (d.hi() < 0.0).then_some(-1.0) }
    }

    /// Whether all poses of the cell are proved regular; if not, the axis to halve.
    fn is_regular(&self, cell: &ChartCell) -> Result<(), usize> {
        let n = self.chart.coordinates();
        let centre = cell.centre();
        let over = self.lines(cell);
        let weight = |k: usize| {
            let change = over
                .as_ref()
                .map_or(1.0, |over| over.slopes(k).iter().flatten().map(|x| x.magnitude()).sum());
            cell.reach(&centre, k) * if change.is_finite() { change } else { 1.0 }
        };
        let regular = over.as_ref().is_some_and(|over| {
            let at = self.lines(&ChartCell::point(centre));
            at.is_some_and(|at| ForceSolver::new(&at, over, cell, &centre, n).is_some())
        });
        if regular {
            return Ok(());
        }
        Err((0..n).fold(0, |best, k| if weight(k) > weight(best) { k } else { best }))
    }

    /// Whether the rods are proved to close on the straight path from one point to another.
    fn closes_between(&self, from: &[f64; 6], to: &[f64; 6]) -> bool {
        let at = |j: usize, k: usize| {
            if j == WAY { to[k] } else { from[k] + (to[k] - from[k]) * (j as f64 / WAY as f64) }
        };
        (0..WAY).all(|j| {
            let ends = |k: usize| (at(j, k), at(j + 1, k));
            let cell = ChartCell {
                lo: std::array::from_fn(|k| ends(k).0.min(ends(k).1)),
                hi: std::array::from_fn(|k| ends(k).0.max(ends(k).1)),
            };
            self.lines(&cell).is_some()
        })
    }
}

/// Assesses the region, the single poses, the trajectory and the ranges of a workspace, on at most `cells` cells for
/// each part, and counts them. It uses the lines of the rods, or the rates of drives with joint offsets. `None` for
/// other designs.
///
/// A cell with the lines `A` is regular if `|I - K A| <= W` entry by entry and `W u < u` for a positive vector `u`
/// (Neumaier 1990, sec. 4.1).
#[must_use]
pub fn regular_rods(
    m: &Manipulator,
    required: &Requirements,
    space: &PoseSpace,
    cells: usize,
    seed: u64,
) -> Option<(RodRegularity, usize)> {
    if required.cranks.is_none() && !required.hardware.is_coupled() {
        return None;
    }
    let cranks = CrankFrames::new(required);
    let joints = JointOffsets::new(m, required, &Chart::of_pose(&space.home));
    let rods = cranks.as_ref().map(Pushing::Rods);
    let Some(pushing) = rods.or(joints.as_ref().map(Pushing::Drives)) else {
        return Some((RodRegularity::Undecided(space.home), 0));
    };
    let (mut doubt, mut tested) = (None, 0);
    for chart in Chart::all(space) {
        let lines = RodsOverChart { pushing, m, chart: &chart };
        // the middle of a region, or an end of a step
        let starts = [[0.0; 6], chart.root.hi].map(|x| chart.pulled_inside(x));
        let Some((start, sign)) = starts.iter().find_map(|x| Some((*x, lines.sign_at(x)?))) else {
            doubt = doubt.or(Some(chart.pose(&starts[0])));
            continue;
        };
        let changes = |x: &[f64; 6]| {
            lines.sign_at(x).is_some_and(|s| s * sign < 0.0) && lines.closes_between(&start, x)
        };
        let mut rng = Purpose::BOUNDED_POSES.rng(seed);
        for _ in 0..if chart.coordinates() > 1 { POINTS } else { 0 } {
            let drawn = |k: usize| rng.uniform(0.0, 1.0) * (chart.root.hi[k] - chart.root.lo[k]);
            let shares: [f64; 6] = std::array::from_fn(drawn);
            let x = chart.pulled_inside(std::array::from_fn(|k| chart.root.lo[k] + shares[k]));
            if changes(&x) {
                return Some((RodRegularity::ChangesSign(chart.pose(&x)), tested));
            }
        }
        let (found, looked_at) = chart.bisected(cells, |cell| lines.is_regular(cell), changes);
        tested += looked_at;
        match found {
            Bisection::Settled => {}
            Bisection::Refuted(x) => return Some((RodRegularity::ChangesSign(chart.pose(&x)), tested)),
            Bisection::Open(x) => doubt = doubt.or(Some(chart.pose(&x))),
        }
    }
    Some((doubt.map_or(RodRegularity::Regular, RodRegularity::Undecided), tested))
}
