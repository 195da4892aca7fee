//! The curves of poses on which the platform moves while all legs are locked.

use thiserror::Error;

use crate::Design;
use fk::{Completeness, FkError, FkOptions, FkRoot, ForwardKinematics, Homotopy, Reality, SolutionSet};
use platform::geom::{ComplexPose, Pose};
use platform::manipulator::{Manipulator, SquaredLegLengths};
use synthesis::singularity::{
    CriticalPoses, CurveDegree, CurveEnd, MotionCurve, MotionOptions, SelfMotion, critical_poses,
    curve_degree, rounds_to_singular, self_motion,
};

/// The start of the curves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MotionStart {
    /// A pose; its leg lengths are kept.
    Pose(Pose),
    /// Leg lengths; all their real components are searched for.
    Lengths(SquaredLegLengths),
}

/// The curves to search for.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct SelfMotionOptions {
    /// The start of the curves.
    pub start: MotionStart,
    /// Number of random sections that cut all curves over the complex numbers; 0 traces only the curves connected to
    /// the pose.
    pub sections: u64,
    /// The step sizes of tracing, and the seed.
    pub motion: MotionOptions,
}

impl SelfMotionOptions {
    /// The curves from this start, with one section.
    #[must_use]
    pub fn new(start: MotionStart) -> Self {
        Self { start, sections: 1, motion: MotionOptions::default() }
    }

    num::setters! {
        /// Number of random sections that cut all curves over the complex numbers.
        fn sections(sections: u64) = sections;
        /// The step sizes of tracing, and the seed.
        fn motion(motion: MotionOptions) = motion;
    }
}

num::words! {
    /// The origin of the first pose of a curve.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
    #[serde(rename_all = "snake_case")]
    #[schemars(rename = "OriginWord")]
    pub enum MotionOrigin as name {
        /// The given pose.
        Pose = "pose",
        /// A point on a section of the set of poses.
        Section = "section",
        /// A critical point.
        CriticalPoint = "critical_point",
        /// A search.
        Search = "search",
    }
}

/// The reason why no curve is searched for.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NoSelfMotion {
    /// The exact joints are regular, but their nearest doubles are singular.
    #[error(
        "{0} is regular, proved about the exact joints, but their doubles are singular: curves are followed in doubles, and would be those of another design"
    )]
    BeyondDoubles(String),
    /// At the pose a leg has no length.
    #[error("the leg lengths at this pose are not finite positive numbers")]
    NoLengths,
    /// Lengths without sections give no pose to start from.
    #[error("no sections leave no pose to start from: with lengths the curves are found by sections")]
    NoStart,
    /// Forward kinematics failed.
    #[error("searching for further poses: {0}")]
    Poses(#[from] FkError),
}

/// The curves of poses with constant leg lengths.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct SelfMotionReport {
    /// The given pose.
    pub start: Option<Pose>,
    /// The squared leg lengths.
    pub squares: SquaredLegLengths,
    /// The dimension of the motion through the pose, or of the set of poses with the lengths, even without real poses.
    /// `None`: undecided.
    pub dimension: Option<usize>,
    /// The curves.
    pub motion: SelfMotion,
    /// The origin of every starting pose.
    pub origins: Vec<MotionOrigin>,
    /// Real poses on surfaces and sets of higher dimension, which are not traced.
    pub real_poses: Vec<Pose>,
    /// Critical points of a distance on the curves, if they were searched for.
    pub critical: Option<CriticalPoses>,
    /// Whether every real component is accounted for, numerically; `None`: no search was made.
    pub accounted: Option<bool>,
    /// Whether all real poses with the lengths are proved to be isolated, by a list of them that is proved complete.
    pub isolated: bool,
}

impl SelfMotionReport {
    fn is_whole(&self) -> bool {
        self.motion.curves.iter().all(|c| matches!(c.end, CurveEnd::Closed | CurveEnd::Joined))
    }

    /// Whether the platform moves at the pose, or at some pose with the lengths; `None`: undecided.
    ///
    /// A motion is proved, sampled on a surface, or traced along curves of which as many are found as the degree of the
    /// set asks for. Curves traced alone leave it open.
    #[must_use]
    pub fn moves(&self) -> Option<bool> {
        let at_first = self.motion.at_pose.as_ref().and_then(|at| at.verdict.moves());
        let counted = self.dimension == Some(1)
            && self.accounted == Some(true)
            && self.is_whole()
            && !self.motion.curves.is_empty();
        let surface = self.dimension.is_some_and(|d| d > 1) && !self.origins.is_empty();
        match (at_first, self.start) {
            (Some(moves), Some(_)) => Some(moves),
            (Some(true), None) => Some(true),
            _ if counted || surface => Some(true),
            (_, None) => self.isolated.then_some(false),
            _ => None,
        }
    }

    /// The degree of each curve over the complex numbers, which takes longer to compute than the curve.
    #[must_use]
    pub fn degrees(&self, design: &Design, seed: u64) -> Vec<Option<CurveDegree>> {
        let degree = |curve: &MotionCurve| {
            let best = curve.points.iter().max_by(|x, y| x.gap.total_cmp(&y.gap))?;
            curve_degree(design.manipulator(), &self.squares, &best.pose, seed)
        };
        self.motion.curves.iter().map(degree).collect()
    }

    /// The longest curve, counted from 0.
    #[must_use]
    pub fn longest(&self) -> Option<usize> {
        let length = |k: &usize| self.motion.curves[*k].points.last().map_or(0.0, |p| p.arc);
        (0..self.motion.curves.len()).max_by(|x, y| length(x).total_cmp(&length(y)))
    }
}

impl Design {
    /// The curves of poses with constant leg lengths, through a pose or for given lengths.
    ///
    /// # Errors
    /// [`NoSelfMotion`].
    pub fn self_motions(&self, options: &SelfMotionOptions) -> Result<SelfMotionReport, NoSelfMotion> {
        let m = self.manipulator();
        if rounds_to_singular(m) {
            return Err(NoSelfMotion::BeyondDoubles(self.name.clone()));
        }
        let (start, squares) = match options.start {
            MotionStart::Pose(pose) => (Some(pose), pose.squared_lengths(m).ok_or(NoSelfMotion::NoLengths)?),
            MotionStart::Lengths(_) if options.sections == 0 => return Err(NoSelfMotion::NoStart),
            MotionStart::Lengths(squares) => (None, squares),
        };
        let seed = options.motion.seed;
        let mut starts: Vec<(Pose, MotionOrigin)> =
            start.into_iter().map(|p| (p, MotionOrigin::Pose)).collect();
        let mut motion = self_motion(m, &squares, start.as_slice(), &options.motion);
        let mut dimension = motion.dimension();
        let (mut critical, mut accounted, mut isolated) = (None, None, false);
        if options.sections > 0 && (start.is_none() || dimension == Some(1)) {
            let cut = PoseSections::of(m, &squares, options.sections, seed)?;
            dimension = if start.is_none() { Some(cut.dimension) } else { dimension };
            isolated = cut.dimension == 0 && cut.complete;
            if cut.dimension == 1 {
                starts.extend(cut.real().map(|pose| (pose, MotionOrigin::Section)));
                // whole sections have a point on every curve, and the given pose may be at a crossing
                let given = start.filter(|_| !cut.whole).into_iter().map(ComplexPose::from);
                let on: Vec<ComplexPose> = given.chain(cut.points.iter().map(|r| r.pose)).collect();
                let found = critical_poses(m, &squares, &on, seed);
                starts.extend(found.poses.iter().map(|p| (*p, MotionOrigin::CriticalPoint)));
                accounted = Some(found.is_accounted() && cut.whole);
                critical = Some(found);
            } else {
                // surfaces are not traced; one real pose of each real component found has to suffice
                starts.extend(cut.real().map(|pose| (pose, MotionOrigin::Search)));
                // no search counts the components of a surface
                let counted = cut.dimension == 0 || start.is_some();
                accounted = counted.then_some(start.is_none() && cut.whole);
            }
            let all: Vec<Pose> = starts.iter().map(|s| s.0).collect();
            motion = self_motion(m, &squares, &all, &options.motion);
        }
        let real_poses = starts.iter().filter(|s| s.1 == MotionOrigin::Search).map(|s| s.0).collect();
        let mut report = SelfMotionReport {
            origins: starts.iter().map(|s| s.1).collect(),
            start,
            squares,
            dimension,
            motion,
            real_poses,
            critical,
            accounted,
            isolated,
        };
        let followed = dimension != Some(1) || starts.is_empty() || report.motion.dimension() == Some(1);
        report.accounted = accounted.map(|a| a && report.is_whole() && followed);
        Ok(report)
    }
}

/// Points on random sections of the poses with these lengths, over the complex numbers.
struct PoseSections {
    /// The dimension of the set: 0 if it is empty or holds isolated poses only.
    dimension: usize,
    points: Vec<FkRoot>,
    /// Whether all points of every section were found: as many as the degree of the set.
    whole: bool,
    /// Whether a list of isolated poses is proved to have all real ones.
    complete: bool,
}

impl PoseSections {
    fn of(m: &Manipulator, s: &SquaredLegLengths, sections: u64, seed: u64) -> Result<Self, FkError> {
        let mut out = Self { dimension: 0, points: Vec::new(), whole: true, complete: false };
        for k in 0..sections {
            let found = Homotopy.solve(m, s, &FkOptions::new().seed(seed.wrapping_add(k)))?;
            if let SolutionSet::PositiveDimensional { witnesses, dimension, degree, .. } = &found.solution_set
            {
                out.dimension = out.dimension.max(*dimension);
                out.whole &= degree.is_some();
                out.points.extend(witnesses.iter().cloned());
            } else {
                out.whole &= found.all_accounted();
                out.complete |= matches!(
                    found.completeness,
                    Completeness::Proved { .. } | Completeness::ProvedBounded { .. }
                );
            }
        }
        Ok(out)
    }

    fn real(&self) -> impl Iterator<Item = Pose> {
        self.points.iter().filter(|r| r.reality == Reality::Real).map(|r| r.pose.real_part())
    }
}
