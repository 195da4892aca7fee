//! The squared lengths of a virtual leg at all poses while the length of one leg varies.

use num_complex::Complex64;
use thiserror::Error;

use crate::Design;
use files::plot::{LocusStep, LocusValue};
use fk::{FkError, FkOptions, FkSolutions, Method, PoseCounting, Reality, SolutionSet, Threads};
use platform::manipulator::{InvalidLengths, Leg, LegIndex, LegLengths, Manipulator};
use platform::topology::Topology;

/// The leg that varies, and the distance that is computed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct LocusOptions {
    /// The lengths of the other legs.
    pub lengths: LegLengths,
    /// The leg with variable length.
    pub leg: LegIndex,
    /// Its first and last length.
    pub ends: [f64; 2],
    /// Number of lengths, both ends included; at least two.
    pub steps: u32,
    /// Base joint and platform joint of the virtual leg. The default is the first one that trilateration needs, or else
    /// the first pair that no leg joins.
    pub between: Option<(usize, usize)>,
    /// The method of solution; by default the best one for the design.
    pub method: Option<Method>,
    /// The seed.
    pub seed: u64,
}

impl LocusOptions {
    /// The usual number of lengths.
    pub const STEPS: u32 = 201;

    /// A leg that varies between two lengths while the others have theirs.
    #[must_use]
    pub fn new(lengths: LegLengths, leg: LegIndex, ends: [f64; 2]) -> Self {
        Self { lengths, leg, ends, steps: Self::STEPS, between: None, method: None, seed: 1 }
    }

    num::setters! {
        /// Number of lengths, both ends included; at least two.
        fn steps(steps: u32) = steps;
        /// Base joint and platform joint of the virtual leg.
        fn between(between: impl Into<Option<(usize, usize)>>) = between.into();
        /// The method of solution.
        fn method(method: impl Into<Option<Method>>) = method.into();
        /// The seed.
        fn seed(seed: u64) = seed;
    }
}

/// The reason why there is no locus.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NoLocus {
    /// The pair of joints is a leg.
    #[error("{0} joins these joints")]
    IsLeg(LegIndex),
    /// There is no pair of joints without a leg.
    #[error("legs join all pairs of joints")]
    NoVirtualLeg,
    /// A length that the leg cannot have.
    #[error(transparent)]
    Lengths(#[from] InvalidLengths),
    /// The method does not apply to the design.
    #[error(transparent)]
    Method(FkError),
}

/// Two joints that no leg joins, with their names.
#[derive(Debug, Clone, PartialEq)]
pub struct VirtualLeg {
    /// The places of its joints.
    pub leg: Leg,
    /// Names of base joint and platform joint.
    pub names: [String; 2],
}

num::words! {
    /// The structure of the set of poses at one length.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
    #[serde(rename_all = "snake_case")]
    pub enum LocusWord as name {
        /// Isolated poses.
        Isolated = "isolated",
        /// No pose.
        Empty = "empty",
        /// Curves or surfaces.
        PositiveDimensional = "positive_dimensional",
        /// They could not be computed.
        Failed = "failed",
    }
}

/// The poses at one length.
#[derive(Debug, Clone)]
pub struct LocusPoint {
    /// The length of the variable leg.
    pub length: f64,
    /// All poses, and in the second list the squared length of the virtual leg at each, in the same order. `None` if
    /// the problem could not be solved.
    pub found: Option<(FkSolutions, Vec<Complex64>)>,
}

impl LocusPoint {
    /// The structure of the set of poses.
    #[must_use]
    pub fn word(&self) -> LocusWord {
        match self.found.as_ref().map(|f| &f.0.solution_set) {
            None => LocusWord::Failed,
            Some(SolutionSet::Isolated) => LocusWord::Isolated,
            Some(SolutionSet::Empty) => LocusWord::Empty,
            Some(SolutionSet::PositiveDimensional { .. }) => LocusWord::PositiveDimensional,
        }
    }

    /// Whether nothing failed and no pose is missing.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.found.as_ref().is_some_and(|f| f.0.all_accounted())
    }

    fn step(&self) -> LocusStep {
        let isolated = self.found.iter().filter(|f| f.0.solution_set == SolutionSet::Isolated);
        let values = isolated.flat_map(|f| f.0.roots.iter().zip(&f.1));
        let values =
            values.map(|(root, v)| LocusValue { re: v.re, im: v.im, real: root.reality == Reality::Real });
        LocusStep { length: self.length, values: values.collect() }
    }
}

/// The squared lengths of a virtual leg while the length of one leg varies.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct LocusReport {
    /// The leg with variable length.
    pub leg: LegIndex,
    /// The virtual leg.
    pub between: VirtualLeg,
    /// The points in the order of the lengths.
    pub points: Vec<LocusPoint>,
}

impl LocusReport {
    /// The values of the isolated poses, for drawing and tracing.
    #[must_use]
    pub fn steps(&self) -> Vec<LocusStep> {
        self.points.iter().map(LocusPoint::step).collect()
    }

    /// Whether no pose is missing at any length.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.points.iter().all(LocusPoint::is_complete)
    }
}

impl Design {
    /// The squared length of a virtual leg at all poses, real and complex, while the length of one leg varies.
    ///
    /// # Errors
    /// [`NoLocus`].
    pub fn locus(&self, options: &LocusOptions) -> Result<LocusReport, NoLocus> {
        let m = self.manipulator();
        let pairs = m.pairs();
        let pair = match options.between {
            Some(pair) => match LegIndex::all().find(|l| pairs[l.get()] == pair) {
                Some(leg) => return Err(NoLocus::IsLeg(leg)),
                None => pair,
            },
            None => default_pair(m).ok_or(NoLocus::NoVirtualLeg)?,
        };
        let between = VirtualLeg {
            leg: Leg { base: m.base_joints()[pair.0], platform: m.platform_joints()[pair.1] },
            names: [self.base_names()[pair.0].clone(), self.platform_names()[pair.1].clone()],
        };
        let lengths = varied(options)?;
        let squares: Vec<_> = lengths.iter().map(LegLengths::squared).collect();
        let settings = FkOptions::new().seed(options.seed).pose_count(PoseCounting::Never);
        let solver = fk::solver(options.method);
        let results = fk::solve_batch(solver.as_ref(), m, &squares, &settings, Threads::All);
        let mut points = Vec::with_capacity(results.len());
        for (l, result) in lengths.iter().zip(results) {
            let found = match result {
                Ok(solutions) => {
                    let values =
                        solutions.roots.iter().map(|r| r.pose.squared_length(&between.leg)).collect();
                    Some((solutions, values))
                }
                // the method fails for this design at any length
                Err(e @ FkError::NotApplicable { .. }) => return Err(NoLocus::Method(e)),
                Err(_) => None,
            };
            points.push(LocusPoint { length: l.get()[options.leg.get()], found });
        }
        Ok(LocusReport { leg: options.leg, between, points })
    }
}

/// All sets of leg lengths; the two ends are exact.
fn varied(options: &LocusOptions) -> Result<Vec<LegLengths>, InvalidLengths> {
    let [from, to] = options.ends;
    let last = options.steps.saturating_sub(1);
    let at = |k: u32| {
        let mut l = options.lengths.get();
        l[options.leg.get()] =
            if k == last { to } else { from + f64::from(k) / f64::from(last) * (to - from) };
        LegLengths::try_new(l)
    };
    (0..options.steps).map(at).collect()
}

/// The first virtual leg of the shortest trilateration sequence; for a design that needs none, the first pair that no
/// leg joins.
fn default_pair(m: &Manipulator) -> Option<(usize, usize)> {
    let pairs = m.pairs();
    let topology = Topology::unordered(pairs.map(|p| p.0), pairs.map(|p| p.1));
    let numbered = topology.legs();
    let virtual_leg = topology.trilateration().virtual_legs.first().copied();
    let free = || {
        let all =
            (0..topology.base_joints()).flat_map(|a| (0..topology.platform_joints()).map(move |b| (a, b)));
        all.into_iter().find(|p| !numbered.contains(p))
    };
    let (a, b) = virtual_leg.or_else(free)?;
    // joints of the topology are numbered as they appear in the legs
    let base = numbered.iter().position(|l| l.0 == a).map(|leg| pairs[leg].0);
    base.zip(numbered.iter().position(|l| l.1 == b).map(|leg| pairs[leg].1))
}
