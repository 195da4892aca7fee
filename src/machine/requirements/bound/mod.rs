//! Proved bounds of the least margins over all poses of a workspace.
//!
//! Each requirement of each leg, pair, keep-out and load is a function of the pose. Its margin is bounded from below
//! over cells of the workspace ([`local`], [`gap`], [`force`], [`stiffness`]) and from above at points of them. The
//! cell with the least bound is halved next, until the bound decides or the cells are used up ([`branch`]). If the
//! slope across a side of a box has one sign over a cell, the least margin can only be at that side. Points of cells
//! that are worse than those found before start a local search.
//!
//! `docs/theory/requirements.md` has the functions and the bounds.

mod branch;
mod cell;
mod clearance;
mod cone;
mod crank;
mod fixed;
mod force;
#[cfg(test)]
mod force_tests;
mod frame;
mod function;
mod gap;
mod hinge;
mod joint_offsets;
mod leg;
mod local;
#[cfg(test)]
mod offset_tests;
mod stiffness;
#[cfg(test)]
mod tests;
mod verdict;

use std::num::NonZeroUsize;

use self::crank::CrankFrames;
use self::frame::CellFrame;
use self::joint_offsets::JointOffsets;
use self::verdict::SafetyMarginBound;
use super::Requirements;
use super::assess::{AssessOptions, Assessment, Margin, assess};
use super::term::{TermKind, Terms};
use num::interval::Interval;
use platform::geom::enclosed::{IntervalVector, dot};
use platform::geom::{Chart, PoseSpace};
use platform::manipulator::{Body, Manipulator};

pub use crank::{RodRegularity, regular_rods};
pub use verdict::{MarginBound, MarginProof, MarginVerdict};

/// [`assess()`], with proved bounds of its margins by at most `cells` cells for each kind.
/// [`AssessOptions::patient_cells`] adds more if a kind is undecided and nothing is violated.
///
/// Deterministic for a seed. Every pose of [`PoseSpace`] is covered: its region, its single poses, the straight motions
/// between those of its trajectory, and its ranges, whatever the number of steps.
#[must_use]
pub fn prove(
    m: &Manipulator,
    required: &Requirements,
    space: &PoseSpace,
    o: &AssessOptions,
    cells: usize,
) -> MarginProof {
    prove_telling(m, required, space, (o, cells), &mut |_| {})
}

/// The next stage of an assessment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum AssessStage {
    /// Searches for the worst pose of each requirement.
    Searches,
    /// Bounds the margins of a requirement over the whole workspace.
    Bounds {
        /// The requirement.
        kind: TermKind,
        /// Its number, from 1.
        number: usize,
        /// The number of requirements.
        of: usize,
    },
    /// Bounds `det J`, or the corresponding determinant of the rods.
    SingularPoses,
    /// Searches for the worst conditioning.
    Conditioning,
}

impl std::fmt::Display for AssessStage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Searches => f.write_str("searching for the worst poses"),
            Self::Bounds { kind, number, of } => {
                write!(
                    f,
                    "bounding the margin of {} over the workspace, requirement {number} of {of}",
                    kind.label()
                )
            }
            Self::SingularPoses => f.write_str("searching for singular poses in the workspace"),
            Self::Conditioning => f.write_str("searching for the worst conditioning"),
        }
    }
}

/// [`prove`] with `(options, cells)`, which also announces each stage.
pub fn prove_telling(
    m: &Manipulator,
    required: &Requirements,
    space: &PoseSpace,
    (o, cells): (&AssessOptions, usize),
    tell: &mut dyn FnMut(AssessStage),
) -> MarginProof {
    tell(AssessStage::Searches);
    let Assessment { margins, poses } = assess(m, required, space, o);
    let terms = Terms::new(m, required, &space.home);
    let charts = Chart::all(space);
    let home = Chart::of_pose(&space.home);
    let cranks = CrankFrames::new(required);
    let cranks = cranks.as_ref();
    let joints = JointOffsets::new(m, required, &home);
    let joints = joints.as_ref();
    let axes = axes(m, required, cranks, joints, &home);
    let threads =
        o.threads.or_else(|| std::thread::available_parallelism().ok()).map_or(1, NonZeroUsize::get);
    // additional cells only decide open kinds; they do not tighten bounds
    let patient = CellEvaluator {
        m,
        required,
        terms: &terms,
        cranks,
        joints,
        axes,
        charts: charts.clone(),
        threads,
        options: o,
        close: false,
    };
    let evaluator = CellEvaluator { charts, close: o.close, ..patient };
    let of = margins.len();
    let mut bounds: Vec<MarginBound> = Vec::with_capacity(of);
    for (number, margin) in (1..).zip(&margins) {
        tell(AssessStage::Bounds { kind: margin.term.kind, number, of });
        bounds.push(evaluator.proved(*margin, cells, o.seed));
    }
    // once a design misses a requirement, the rest need not be known
    let missed =
        |b: &MarginBound| b.verdict == MarginVerdict::Violated || b.keeps_safety_margin() == Some(false);
    if o.patient_cells > cells && !bounds.iter().any(missed) {
        for (number, bound) in (1..).zip(&mut bounds) {
            let kind = bound.found.term.kind;
            if bound.is_decided() || kind.is_fixed() {
                continue;
            }
            if o.is_late() {
                break;
            }
            tell(AssessStage::Bounds { kind, number, of });
            let more = patient.proved(bound.found, o.patient_cells, o.seed);
            *bound =
                MarginBound { below: more.below.max(bound.below), cells: bound.cells + more.cells, ..more };
        }
    }
    MarginProof { bounds, poses }
}

/// Axes of joint angles with their lengths: at the base in the base frame, at the platform in the platform frame.
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

struct CellEvaluator<'a> {
    m: &'a Manipulator,
    required: &'a Requirements,
    terms: &'a Terms<'a>,
    /// Cranks, if they could be enclosed.
    cranks: Option<&'a CrankFrames<'a>>,
    /// Joint offsets, if they could be enclosed.
    joints: Option<&'a JointOffsets>,
    axes: Axes,
    charts: Vec<Chart>,
    /// Threads that share the cells of a batch; the answers do not depend on it.
    threads: usize,
    options: &'a AssessOptions,
    /// Whether bounds continue after the decision.
    close: bool,
}

impl CellEvaluator<'_> {
    /// Bounds of a margin and its safety margin, by at most this many cells each.
    fn proved(&self, found: Margin, cells: usize, seed: u64) -> MarginBound {
        let safety_margin = self.required.safety_margin(found.term.kind);
        // the enclosure alone decides requirements that are independent of the pose
        if found.term.kind.is_fixed() {
            return self.with_safety_margin(self.fixed(found), safety_margin);
        }
        // if bounds need not be close, a kept safety margin decides both at once
        let may_be_kept = found.value >= safety_margin - self.rounding(&found);
        if self.close || safety_margin == 0.0 || !may_be_kept {
            let bound = self.bound(found, cells, seed, 0.0);
            let bound = self.with_safety_margin(bound, safety_margin);
            if bound.keeps_safety_margin().is_some() {
                return bound;
            }
            let more = self.bound(bound.found, cells, seed, safety_margin);
            let kept = (more.below >= -self.rounding(&more.found)).then_some(true);
            return MarginBound { safety_margin: Some(SafetyMarginBound { safety_margin, kept }), ..bound };
        }
        let more = self.bound(found, cells, seed, safety_margin);
        let rounding = self.rounding(&more.found);
        if more.below >= -rounding {
            let below = (more.below + safety_margin).next_down();
            let kept = Some(SafetyMarginBound { safety_margin, kept: Some(true) });
            return MarginBound {
                below,
                verdict: verdict::verdict(below, f64::INFINITY, rounding),
                safety_margin: kept,
                ..more
            };
        }
        let bound = self.bound(more.found, cells, seed, 0.0);
        let cells = bound.cells + more.cells;
        self.with_safety_margin(MarginBound { cells, ..bound }, safety_margin)
    }

    fn rounding(&self, found: &Margin) -> f64 {
        self.terms.rounding(found.term.kind, found.pose.as_ref())
    }

    /// The same bound with the decision about a safety margin by its own bounds.
    fn with_safety_margin(&self, bound: MarginBound, safety_margin: f64) -> MarginBound {
        if safety_margin == 0.0 {
            return bound;
        }
        let rounding = self.rounding(&bound.found);
        let kept = if bound.found.value < safety_margin - rounding {
            Some(false)
        } else {
            (bound.below >= safety_margin - rounding).then_some(true)
        };
        MarginBound { safety_margin: Some(SafetyMarginBound { safety_margin, kept }), ..bound }
    }
}
