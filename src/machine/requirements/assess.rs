//! Margins over all poses, with the poses where they are least.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::time::Instant;

use nalgebra::Vector6;

use super::standing::Standing;
use super::term::{Term, TermKind, Terms};
use super::{PoseSpace, Requirements};
use num::{Purpose, Rng};
use platform::geom::Pose;
use platform::manipulator::Manipulator;

/// Density of the sample of poses.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct AssessOptions {
    /// Points of a Halton sequence, and as many random ones, in the region of poses.
    pub points: usize,
    /// Steps between two poses of a trajectory.
    pub steps: usize,
    /// Local searches for the worst pose of each kind of requirement, from the worst points.
    pub searches: usize,
    /// Seed of the random points and of the searches.
    pub seed: u64,
    /// Whether proved margins come close to the least margins found; otherwise a proof ends once it decides between met
    /// and violated.
    pub close: bool,
    /// Number of cells for a kind of requirement that the usual number leaves undecided. They are used only if they
    /// exceed the usual number and no requirement is violated. 0: it stays undecided.
    pub patient_cells: usize,
    /// Threads for the proofs; `None`: as many as the process may run at the same time. The answers do not depend on
    /// it.
    pub threads: Option<NonZeroUsize>,
    /// Time at which the samples end, and proofs with their current bounds. `None`: proofs end when they decide or have
    /// used up their cells.
    pub until: Option<Instant>,
}

impl Default for AssessOptions {
    fn default() -> Self {
        Self {
            points: 5000,
            steps: 10,
            searches: 3,
            seed: 0,
            close: true,
            patient_cells: 0,
            threads: None,
            until: None,
        }
    }
}

impl AssessOptions {
    /// The defaults: 5000 points, 10 steps, 3 searches.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    num::setters! {
        /// Points of a Halton sequence, and as many random ones.
        fn points(points: usize) = points;
        /// Steps between two poses of a trajectory.
        fn steps(steps: usize) = steps;
        /// Local searches for the worst pose of each kind of requirement.
        fn searches(searches: usize) = searches;
        /// Threads for the proofs; the answers do not depend on it.
        fn threads(threads: NonZeroUsize) = Some(threads);
        /// Whether proved margins come close to the least margins found, which takes longer than the decision alone.
        fn close(close: bool) = close;
        /// Number of cells for a kind of requirement that the usual number leaves undecided; 0, the default: it stays
        /// undecided.
        fn patient_cells(cells: usize) = cells;
        /// Optional time at which samples and proofs end with their results so far; open proofs stay undecided.
        fn until(until: Option<Instant>) = until;
    }

    /// Whether the time of samples and proofs is over.
    #[must_use]
    pub fn is_late(&self) -> bool {
        self.until.is_some_and(|end| Instant::now() >= end)
    }

    /// Seed of the random points and of the searches.
    #[must_use]
    pub fn seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }
}

/// The least margin found of one kind of requirement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Margin {
    /// The requirement with the least margin (or the greatest violation).
    pub term: Term,
    /// Its margin: positive when it is met, in the unit of [`TermKind::quantity`].
    pub value: f64,
    /// The pose; `None` for requirements that do not depend on the pose.
    pub pose: Option<Pose>,
    /// The meaning of the margin within rounding.
    pub standing: Standing,
}

/// The result of an assessment.
#[derive(Debug, Clone, PartialEq)]
pub struct Assessment {
    /// The least margin of each kind of requirement the design has.
    pub margins: Vec<Margin>,
    /// Number of evaluated poses, including those of the searches.
    pub poses: usize,
}

impl Assessment {
    /// `true` if nothing is violated; a margin of zero within rounding is no violation ([`Standing::AtLimit`]).
    ///
    /// A violation found is certain. Without one, a violation between the sampled poses remains possible.
    #[must_use]
    pub fn all_met(&self) -> bool {
        self.margins.iter().all(|m| m.standing.is_met())
    }
}

/// The least margin of each kind of requirement among all that were seen, with its requirement and its place: a pose,
/// an instant, or nothing. A margin that is no number counts as the least.
#[derive(Debug, Clone)]
pub struct LeastMargins<At>(BTreeMap<TermKind, (Term, f64, At)>);

impl<At> Default for LeastMargins<At> {
    fn default() -> Self {
        Self(BTreeMap::new())
    }
}

impl<At: Copy> LeastMargins<At> {
    /// Takes the margins at a place into account.
    pub fn see(&mut self, margins: impl IntoIterator<Item = (Term, f64)>, at: At) {
        for (term, value) in margins {
            let entry = self.0.entry(term.kind).or_insert((term, value, at));
            if value < entry.1 || value.is_nan() {
                *entry = (term, value, at);
            }
        }
    }

    /// The least margin of a kind; `None`: the design does not require it.
    pub fn of(&self, kind: TermKind) -> Option<f64> {
        self.0.get(&kind).map(|found| found.1)
    }

    /// The least margin of each kind, in the order of the kinds.
    pub fn each(&self) -> impl Iterator<Item = (Term, f64, At)> + '_ {
        self.0.values().copied()
    }
}

/// A point of the region with its margin.
type RegionPoint = (f64, Vector6<f64>);

/// The least margin of a kind at a pose.
fn least(terms: &Terms<'_>, kind: TermKind, pose: &Pose) -> f64 {
    terms.of_kind(pose, kind).map(|(_, x)| x).fold(f64::INFINITY, f64::min)
}

/// Evaluates every requirement at home, densely over the region, at the listed poses, and along trajectory and ranges.
/// It then searches for worse poses near the worst ones found.
///
/// Random steps move one to all coordinates of the cube and shrink from a tenth to a millionth of its width. The search
/// needs no derivatives, since margins have kinks. Deterministic for a seed, unless [`AssessOptions::until`] ends it:
/// then the listed poses are evaluated, or one pose of the region.
#[must_use]
pub fn assess(m: &Manipulator, required: &Requirements, space: &PoseSpace, o: &AssessOptions) -> Assessment {
    let terms = Terms::new(m, required, &space.home);
    let mut rng = Purpose::ASSESSED_POSES.rng(o.seed);
    let mut found: LeastMargins<Option<Pose>> = LeastMargins::default();
    found.see(terms.fixed(), None);
    let mut poses = 0;
    for pose in space.listed(o.steps) {
        found.see(terms.at(&pose), Some(pose));
        poses += 1;
    }
    let mut worst: BTreeMap<TermKind, Vec<RegionPoint>> = BTreeMap::new();
    for x in space.cube_points(o.points, &mut rng) {
        // a kind without a margin would count as not required
        if poses > 0 && o.is_late() {
            break;
        }
        let pose = space.pose(&x);
        let mut here = LeastMargins::default();
        here.see(terms.at(&pose), ());
        for (term, value, ()) in here.each() {
            let list = worst.entry(term.kind).or_default();
            list.push((value, x));
            list.sort_by(|a, b| a.0.total_cmp(&b.0));
            list.truncate(o.searches);
            found.see([(term, value)], Some(pose));
        }
        poses += 1;
    }
    let axes = space.axes();
    if !axes.is_empty() {
        for (kind, starts) in worst {
            for start in starts {
                if o.is_late() {
                    break;
                }
                let (x, tried) = descend(&terms, kind, space, &axes, start, &mut rng);
                let pose = space.pose(&x);
                found.see(terms.at(&pose), Some(pose));
                poses += tried;
            }
        }
    }
    Assessment {
        margins: found.each().map(|(term, value, pose)| terms.margin((term, value), pose)).collect(),
        poses,
    }
}

/// A worse pose near a bad one, and the number of poses tried.
fn descend(
    terms: &Terms<'_>,
    kind: TermKind,
    space: &PoseSpace,
    axes: &[usize],
    (mut value, mut x): RegionPoint,
    rng: &mut Rng,
) -> (Vector6<f64>, usize) {
    let (mut step, mut tried) = (0.2, 0);
    while step > 2e-6 {
        let mut better = false;
        for trial in 0..2 * axes.len() {
            let mut y = x;
            for (j, k) in axes.iter().enumerate() {
                // every second trial moves one coordinate only
                if trial % 2 == 0 || j == trial / 2 {
                    y[*k] = (y[*k] + step * rng.uniform(-1.0, 1.0)).clamp(-1.0, 1.0);
                }
            }
            tried += 1;
            let there = least(terms, kind, &space.pose(&y));
            if there < value {
                (value, x, better) = (there, y, true);
            }
        }
        if !better {
            step /= 2.0;
        }
    }
    (x, tried)
}

/// Search for a violated requirement, for many platforms with the same workspace. It uses the sample of [`assess()`]
/// without the search for worse poses, and stops at the first violation.
#[derive(Debug, Clone)]
pub struct ViolationSearch {
    home: Pose,
    poses: Vec<Pose>,
}

impl ViolationSearch {
    /// Makes the poses of a space ready.
    pub fn new(space: &PoseSpace, o: &AssessOptions) -> Self {
        let mut rng = Purpose::ASSESSED_POSES.rng(o.seed);
        let mut poses = space.listed(o.steps);
        poses.extend(space.cube_points(o.points, &mut rng).iter().map(|x| space.pose(x)));
        Self { home: space.home, poses }
    }

    /// The home of the space.
    pub fn home(&self) -> &Pose {
        &self.home
    }

    /// The greatest number of sampled poses.
    pub fn poses(&self) -> usize {
        self.poses.len()
    }

    /// A violated requirement, those independent of the pose first. `None` if these poses show none, which does not
    /// exclude one between them.
    ///
    /// The pose of the violation comes first in the next call, since similar platforms are violated at the same poses.
    pub fn violated(&mut self, m: &Manipulator, required: &Requirements) -> Option<TermKind> {
        let terms = Terms::new(m, required, &self.home);
        let bad = |list: Vec<(Term, f64)>, pose: Option<&Pose>| {
            let violated = |(term, value): &(Term, f64)| !terms.standing(term.kind, *value, pose).is_met();
            list.iter().find(|t| violated(t)).map(|(term, _)| term.kind)
        };
        if let Some(kind) = bad(terms.fixed(), None) {
            return Some(kind);
        }
        let found = self.poses.iter().enumerate().find_map(|(k, p)| Some((k, bad(terms.at(p), Some(p))?)));
        found.map(|(k, kind)| {
            self.poses[..=k].rotate_right(1);
            kind
        })
    }
}
