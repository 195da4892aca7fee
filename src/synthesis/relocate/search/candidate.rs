//! A platform from the search: its margins, and the ascent of the worst of them.
//!
//! The worst margin is not smooth where two margins are equal.

use nalgebra::Matrix6;

use super::pool::{JointPattern, LegPool, shared};
use super::targets::{Target, TargetMargin, Targets};
use crate::components::Components;
use crate::leg_map::{LegMapOutcome, LegMapTolerances, leg_map_to_legs};
use crate::relocate::{Assembled, assemble};
use num::Rng;
use num::linalg::LinalgError;
use platform::geom::{Pose, segment_distance};
use platform::manipulator::{Leg, LegIndex, Manipulator, inverse_condition, jacobian_of_legs};

/// Margins of the platforms of one pattern.
pub(super) struct Scorer<'a> {
    pub(super) pool: &'a LegPool<'a>,
    pub(super) found: &'a Components,
    pub(super) m: &'a Manipulator,
    pub(super) targets: &'a Targets,
    pub(super) pattern: &'a JointPattern,
}

impl Scorer<'_> {
    /// The smallest slack at the parameters; `-infinity` if a leg does not exist.
    pub(super) fn worst(&self, x: &[f64]) -> Result<f64, LinalgError> {
        let Some(legs) = self.pool.legs(self.pattern, x)? else { return Ok(f64::NEG_INFINITY) };
        Ok(worst(&self.margins(&legs)))
    }

    /// All margins of six legs of the pattern, in its order.
    pub(super) fn margins(&self, legs: &[Leg; 6]) -> Vec<TargetMargin> {
        let (w, size) = (self.targets, self.m.size());
        let above = |target, value: f64, required: f64, unit: f64| TargetMargin {
            target,
            value,
            required,
            slack: if value.is_finite() { (value - required) / unit } else { f64::NEG_INFINITY },
        };
        let mut out = vec![
            above(Target::Spacing, self.spacing(legs), w.spacing, size),
            above(Target::Conditioning, self.conditioning(legs), w.conditioning, 1.0),
        ];
        if let Some(d) = w.clearance {
            out.push(above(Target::Clearance, self.clearance(legs), d, size));
        }
        let reach = self.reach(legs);
        let slack = (w.reach - reach) / size;
        out.push(TargetMargin { target: Target::Reach, value: reach, required: w.reach, slack });
        out
    }

    fn pairs() -> impl Iterator<Item = (usize, usize)> {
        (0..6).flat_map(|j| (0..j).map(move |i| (i, j)))
    }

    /// Smallest distance of two joints of one body. Joints shared in the whole pattern are left out unless sharing is
    /// forbidden.
    fn spacing(&self, legs: &[Leg; 6]) -> f64 {
        let all = self.targets.no_shared_joints && self.pattern.shared == 0;
        let mut least = f64::MAX;
        for (i, j) in Self::pairs() {
            if all || !self.pattern.same_base[i][j] {
                least = least.min((legs[i].base - legs[j].base).norm());
            }
            if all || !self.pattern.same_platform[i][j] {
                least = least.min((legs[i].platform - legs[j].platform).norm());
            }
        }
        least
    }

    /// Smallest distance of two legs without a shared joint, at all poses.
    fn clearance(&self, legs: &[Leg; 6]) -> f64 {
        let mut least = f64::MAX;
        for pose in &self.targets.poses {
            let segments = legs.map(|l| [l.base, pose.transform(&l.platform)]);
            for (i, j) in Self::pairs() {
                if !self.pattern.same_base[i][j] && !self.pattern.same_platform[i][j] {
                    least = least.min(segment_distance(segments[i], segments[j]));
                }
            }
        }
        least
    }

    fn conditioning(&self, legs: &[Leg; 6]) -> f64 {
        let at = |pose: &Pose| -> f64 {
            let j: Matrix6<f64> = jacobian_of_legs(legs, pose, self.targets.characteristic_length);
            inverse_condition(&j)
        };
        self.targets.poses.iter().map(at).fold(f64::MAX, f64::min)
    }

    fn reach(&self, legs: &[Leg; 6]) -> f64 {
        let n = self.found.span.normalisation();
        let far = |l: &Leg| (l.base - n.base_centre).norm().max((l.platform - n.platform_centre).norm());
        legs.iter().map(far).fold(0.0, f64::max)
    }
}

/// The smallest slack. The reach is a limit and not an objective: it counts only if it is exceeded.
pub(super) fn worst(margins: &[TargetMargin]) -> f64 {
    let counts = |m: &&TargetMargin| m.target != Target::Reach || m.slack < 0.0;
    margins.iter().filter(counts).map(|m| m.slack).fold(f64::INFINITY, f64::min)
}

/// First step in every parameter; the families are parametrised so that joints are at the parameters 0 and 1.
const FIRST_STEP: f64 = 0.25;
/// The climb ends below this step.
const LAST_STEP: f64 = 1e-6;

/// Compass search: steps along the parameters and along random directions, halved if none improves the value. The value
/// never falls.
pub(super) fn climb(
    scorer: &Scorer,
    start: Vec<f64>,
    evaluations: usize,
    rng: &mut Rng,
) -> Result<(f64, Vec<f64>), LinalgError> {
    let n = start.len();
    let mut best = (scorer.worst(&start)?, start);
    let (mut used, mut step) = (1, FIRST_STEP);
    while n > 0 && used < evaluations && step > LAST_STEP {
        let mut better = false;
        for k in 0..2 * n {
            let direction: Vec<f64> = if k < n {
                (0..n).map(|i| if i == k { 1.0 } else { 0.0 }).collect()
            } else {
                // at a ridge of two equal margins, steps in single parameters do not improve the worst one
                (0..n).map(|_| rng.normal() / (n as f64).sqrt()).collect()
            };
            for sign in [1.0, -1.0] {
                let x: Vec<f64> = best.1.iter().zip(&direction).map(|(x, d)| x + sign * step * d).collect();
                let value = scorer.worst(&x)?;
                used += 1;
                if value > best.0 {
                    best = (value, x);
                    better = true;
                    break;
                }
            }
        }
        if !better {
            step *= 0.5;
        }
    }
    Ok(best)
}

/// The origin of a leg.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LegSource {
    /// It is a leg of the given platform.
    Kept(LegIndex),
    /// It belongs to a family (index).
    Family(usize),
    /// One end is in a hole (index).
    Hole(usize),
    /// Its base end is in a hole, its platform end in another.
    Holes(usize, usize),
}

/// A leg of the new platform.
#[derive(Debug, Clone, PartialEq)]
pub struct Placement {
    /// The leg it replaces, whose number it has.
    pub leg: LegIndex,
    /// Its origin; never `Kept`.
    pub source: LegSource,
    /// Its parameters there.
    pub parameters: Vec<f64>,
}

/// A platform equivalent to the given one.
#[derive(Debug, Clone)]
pub struct Candidate {
    /// Joints and legs.
    pub assembled: Assembled,
    /// The map from the given platform.
    pub map: LegMapOutcome,
    /// The legs at other places.
    pub placements: Vec<Placement>,
    /// Every requirement with its number, recomputed on the joints as written.
    pub margins: Vec<TargetMargin>,
    /// The smallest slack.
    pub worst: f64,
    /// Whether every requirement is met.
    pub fulfilled: bool,
    /// Joints that carry two legs or more.
    pub shared_joints: usize,
}

impl Candidate {
    /// Whether the other platform repeats this one: it has the same legs within a thousandth of the size. Without holes
    /// that distinguish the places of a body, equal distances between joints and equal home lengths suffice (a symmetry
    /// of the design).
    pub(super) fn repeats(&self, other: &Self, targets: &Targets, size: f64) -> bool {
        let limit = 1e-3 * size;
        let near = |a: &Leg, b: &Leg| (a.base - b.base).norm().max((a.platform - b.platform).norm()) <= limit;
        let same_legs = self.assembled.legs.iter().all(|a| other.assembled.legs.iter().any(|b| near(a, b)));
        let distances = |c: &Self| distances(&c.assembled.legs, &targets.poses[0]);
        let congruent =
            || distances(self).into_iter().zip(distances(other)).all(|(x, y)| (x - y).abs() <= limit);
        same_legs || (targets.holes.is_empty() && congruent())
    }
}

/// Distances of the base joints, of the platform joints, and leg lengths at the pose, each in order of size.
fn distances(legs: &[Leg; 6], pose: &Pose) -> Vec<f64> {
    let mut lists = [Vec::new(), Vec::new(), legs.iter().map(|l| pose.squared_length(l).sqrt()).collect()];
    for (i, a) in legs.iter().enumerate() {
        for b in &legs[..i] {
            lists[0].push((a.base - b.base).norm());
            lists[1].push((a.platform - b.platform).norm());
        }
    }
    for list in &mut lists {
        list.sort_by(f64::total_cmp);
    }
    lists.concat()
}

/// The platform at the parameters; `None` if it does not exist or is singular.
pub(super) fn candidate(scorer: &Scorer, x: &[f64]) -> Result<Option<Candidate>, LinalgError> {
    let Some(legs) = scorer.pool.legs(scorer.pattern, x)? else { return Ok(None) };
    let rows = legs.map(|l| scorer.found.span.coefficients(&l));
    let a = Matrix6::from_fn(|i, j| rows[i][j]);
    let Some(order) = numbering(scorer, &a) else { return Ok(None) };
    let (mut new, mut placements) = ([None; 6], Vec::new());
    let mut at = 0;
    for (row, k) in scorer.pattern.places.iter().enumerate() {
        let place = &scorer.pool.places[*k];
        let n = place.formulas.parameters();
        if !matches!(place.source, LegSource::Kept(_)) {
            new[order[row].get()] = Some(legs[row]);
            let parameters = x[at..at + n].to_vec();
            placements.push(Placement { leg: order[row], source: place.source, parameters });
        }
        at += n;
    }
    placements.sort_by_key(|p| p.leg);
    let assembled = assemble(scorer.m, &new);
    let map = leg_map_to_legs(scorer.m, &assembled.legs, LegMapTolerances::default())?;
    if !map.is_regular_within_rounding() {
        return Ok(None);
    }
    let Ok(platform) = &assembled.platform else { return Ok(None) };
    let pairs = platform.pairs();
    let same = |f: &dyn Fn((usize, usize)) -> usize| -> [[bool; 6]; 6] {
        std::array::from_fn(|i| std::array::from_fn(|j| i != j && f(pairs[i]) == f(pairs[j])))
    };
    let shared_joints = shared(&same(&|p| p.0)) + shared(&same(&|p| p.1));
    let final_legs: [Leg; 6] = std::array::from_fn(|row| assembled.legs[order[row].get()]);
    let margins = scorer.margins(&final_legs);
    let least = worst(&margins);
    let fulfilled = least >= 0.0 && !(scorer.targets.no_shared_joints && shared_joints > 0);
    Ok(Some(Candidate { assembled, map, placements, margins, worst: least, fulfilled, shared_joints }))
}

/// A number for each row. Kept legs have theirs; the others get those with the greatest product of `|A_ri|`, and legs
/// for named joints choose among theirs. A regular matrix has a nonzero product (Leibniz' formula), so each leg can
/// replace the one with its number.
fn numbering(scorer: &Scorer, a: &Matrix6<f64>) -> Option<[LegIndex; 6]> {
    let allowed = |row: usize, leg: LegIndex| match scorer.pool.places[scorer.pattern.places[row]].source {
        LegSource::Kept(own) => own == leg,
        LegSource::Family(_) => true,
        LegSource::Hole(h) => allows(scorer, h, leg),
        LegSource::Holes(h, l) => allows(scorer, h, leg) && allows(scorer, l, leg),
    };
    let mut best: (f64, Option<[LegIndex; 6]>) = (0.0, None);
    let all: Vec<LegIndex> = LegIndex::all().collect();
    let mut stack: Vec<(f64, Vec<LegIndex>)> = vec![(1.0, Vec::new())];
    while let Some((product, taken)) = stack.pop() {
        let row = taken.len();
        if row == 6 {
            if product > best.0 {
                best = (product, <[LegIndex; 6]>::try_from(taken).ok());
            }
            continue;
        }
        for leg in all.iter().filter(|l| !taken.contains(l) && allowed(row, **l)) {
            let factor = a[(row, leg.get())].abs();
            if factor > 1e-9 {
                let mut next = taken.clone();
                next.push(*leg);
                stack.push((product * factor, next));
            }
        }
    }
    best.1
}

fn allows(scorer: &Scorer, hole: usize, leg: LegIndex) -> bool {
    let legs = &scorer.targets.holes[hole].legs;
    legs.is_empty() || legs.contains(&leg)
}
