//! The verdict on two platforms.

use std::num::NonZeroUsize;
use std::ops::ControlFlow;

use thiserror::Error;

use super::determined::{ROUNDED, is_beyond_precision};
use super::matching::{PoseMatching, match_poses};
use super::sample::Sample;
use crate::fk::{
    FkError, FkOptions, FkSolutions, ForwardKinematics, Homotopy, PoseCounting, Threads, solver,
};
use crate::geom::{ComplexPose, SamplePlan};
use crate::manipulator::{LegIndex, Manipulator};
use crate::num::Cancel;
use crate::num::linalg::LinalgError;
use crate::num::stream::Stream;
use crate::solve::certify::RootCertificate;
use crate::synthesis::{LegMapOutcome, LegMapTolerances, NotRealizable, Relation, leg_map};

/// Two poses are the same when they are closer than this (relative to the size and to their own numbers).
///
/// Roots come out at `1e-12` or better unless they are nearly double; a joint `1e-6` of the size off its
/// place moves poses by about `1e-6`.
pub const SAME_POSE: f64 = 1e-8;
/// Longest exact number that a sentence takes.
const SHORT: usize = 24;
/// A counterexample must miss the lengths of the other platform by this many times the rounding to expect.
const CLEAR_MISS: f64 = 1e3;

/// Why platforms could not be compared at all.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum VerifyError {
    /// The leg map could not be computed.
    #[error("the leg map could not be computed: {0}")]
    LegMap(#[from] LinalgError),
    /// A forward-kinematics method broke down.
    #[error("forward kinematics of {platform} failed: {error}")]
    ForwardKinematics {
        /// `"A"` or `"B"`.
        platform: &'static str,
        /// What happened.
        error: FkError,
    },
    /// A sample pose gives lengths that overflow or that the map sends to a negative square.
    #[error("sample {sample} has no usable leg lengths{}", .why.map(|w| format!(": {w}")).unwrap_or_default())]
    Lengths {
        /// Index of the sample.
        sample: usize,
        /// The leg whose square came out negative.
        why: Option<NotRealizable>,
    },
    /// It was told to end.
    #[error("the comparison was cancelled")]
    Cancelled,
}

/// A pose that belongs to the lengths of one platform and not to those of the other.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Counterexample {
    /// Index of the sample.
    pub sample: usize,
    /// `"A"` when the pose solves A and not B, `"B"` the other way round.
    pub solves: &'static str,
    /// The pose.
    pub pose: ComplexPose,
    /// The interval certificate that proves the pose a solution of the one, where there is one.
    pub certificate: Option<RootCertificate>,
    /// The leg of the other platform that is missed most.
    pub leg: LegIndex,
    /// By how much its squared length is missed, relative to the squared size.
    pub miss: f64,
    /// Rounding to expect in this number.
    pub rounding: f64,
}

impl Counterexample {
    /// Whether the pose is proved a solution of the one.
    #[must_use]
    pub fn certified(&self) -> bool {
        self.certificate.is_some()
    }
}

/// Why no verdict was reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InconclusiveReason {
    /// The map is regular, but some sample could not be solved completely.
    SolverIncomplete,
    /// The map is regular and the poses found do not agree with it.
    Contradiction,
    /// The map holds within its tolerance, and whether it is regular is not decided.
    MapUndecided,
    /// No sample was asked for, so that nothing but the map speaks.
    NoSamples,
    /// The map holds within its tolerance, but not to rounding, and forward kinematics tells the platforms apart.
    NearlyEquivalent,
    /// There is no map, but no pose was found that tells the platforms apart either.
    NoCounterexample,
}

impl InconclusiveReason {
    /// One sentence.
    #[must_use]
    pub fn sentence(self) -> &'static str {
        match self {
            Self::SolverIncomplete => {
                "the leg map is regular, but forward kinematics may have missed poses of a sample"
            }
            Self::Contradiction => {
                "the leg map is regular, but forward kinematics of the two does not give the same poses at a sample, more than rounding of the joints explains: \
                 nothing is concluded from the samples (bodies of very different size, or nearly double poses, make poses this uncertain)"
            }
            Self::MapUndecided => {
                "the leg map holds within its tolerance, but a singular design lies within what rounding leaves open"
            }
            Self::NoSamples => "no sets of lengths were compared: forward kinematics has said nothing",
            Self::NearlyEquivalent => {
                "the leg map holds within its tolerance but not to rounding, and the poses of a sample disagree"
            }
            Self::NoCounterexample => {
                "no leg map within the tolerance, but no sampled pose tells the platforms apart clearly"
            }
        }
    }
}

/// The verdict on two platforms.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// The leg map is regular, which proves it up to the rounding of the designs' own coordinates, and
    /// independent forward kinematics agrees at every sample but for poses so far out that this rounding decides whether they exist
    /// ([`Verification::beyond_precision`]).
    Equivalent,
    /// There is no leg map, and a pose shows it.
    NotEquivalent(Box<Counterexample>),
    /// There is a leg map, but `det A = 0` (or the legs of A are dependent): one platform is
    /// architecturally singular.
    Singular,
    /// Not decided.
    Inconclusive(InconclusiveReason),
}

/// The verdict in words, with what shows it or why there is none.
impl std::fmt::Display for Verdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Equivalent => f.write_str("equivalent"),
            Self::NotEquivalent(c) => {
                let proved = if c.certified() { "proved" } else { "not proved" };
                write!(f, "not equivalent: a pose of {} ({proved}) misses {} of the other", c.solves, c.leg)
            }
            Self::Singular => f.write_str(
                "singular: there is a leg map, and one of the platforms is architecturally singular",
            ),
            Self::Inconclusive(why) => write!(f, "inconclusive: {}", why.sentence()),
        }
    }
}

impl Verdict {
    /// The word of the command line.
    #[must_use]
    pub fn as_str(&self) -> &'static str {
        match self {
            Self::Equivalent => "equivalent",
            Self::NotEquivalent(_) => "not_equivalent",
            Self::Singular => "singular",
            Self::Inconclusive(_) => "inconclusive",
        }
    }
}

/// The verdict with all its evidence.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Verification {
    /// The verdict.
    pub verdict: Verdict,
    /// The algebraic side.
    pub map: LegMapOutcome,
    /// For each leg of B a bound of how far its squared length is from `A s + c` over the box of the sample poses, units squared, for the joints as doubles; `None` where the map is
    /// proved, so that there is no difference, and where it is singular.
    pub deviation_bounds: Option<[f64; 6]>,
    /// The numerical side; empty for a singular map, where forward kinematics has nothing to compare.
    pub samples: Vec<Sample>,
}

impl Verification {
    /// Whether the map was proved: an identity of leg vectors that was checked in exact arithmetic, on exact joints.
    #[must_use]
    pub fn proved(&self) -> bool {
        self.map.exact_numbers.is_some()
    }

    /// One sentence with the numbers that decided.
    #[must_use]
    pub fn explanation(&self) -> String {
        let (v, n) = (self, self.samples.len());
        match &v.verdict {
            Verdict::Equivalent if v.proved() => format!(
                "proved: every leg vector of B is exactly a combination of those of A, and {} is not zero; forward kinematics of both, solved \
                 independently, agrees at {n} of {n} sets of lengths, {}; worst distance of matched poses {:.1e}{}",
                exact_determinant(v),
                lists_proved(v),
                v.worst_distance(),
                set_aside(v)
            ),
            Verdict::Equivalent => format!(
                "the leg map is regular (det A = {:.6}), and forward kinematics of both, solved independently, agrees \
                 at {n} of {n} sets of lengths, {}; worst distance of matched poses {:.1e}{}{}",
                v.map.determinant,
                lists_proved(v),
                v.worst_distance(),
                set_aside(v),
                deviation(v)
            ),
            Verdict::Singular => v.map.explanation(),
            Verdict::NotEquivalent(c) => {
                let other = if c.solves == "A" { "B" } else { "A" };
                format!(
                    "no leg map exists (residual {:.1e}); at sample {} a {}pose of {} misses the squared length of {} of {other} \
                     by {:.1e} of the squared size (rounding {:.1e}){}",
                    v.map.residual,
                    c.sample + 1,
                    if c.certified() { "certified " } else { "" },
                    c.solves,
                    c.leg,
                    c.miss,
                    c.rounding,
                    deviation(v)
                )
            }
            Verdict::Inconclusive(reason) => reason.sentence().to_owned(),
        }
    }

    /// The largest distance of matched poses over all samples.
    #[must_use]
    pub fn worst_distance(&self) -> f64 {
        self.samples.iter().map(|s| s.matching.worst_distance()).fold(0.0, f64::max)
    }

    /// Numbers of poses of A and of B over all samples that have no partner and were set aside: joints within the rounding of the given ones need not have them.
    #[must_use]
    pub fn beyond_precision(&self) -> [usize; 2] {
        let count = |of: fn(&Sample) -> usize| self.samples.iter().map(of).sum();
        [count(|s| s.matching.beyond_a.len()), count(|s| s.matching.beyond_b.len())]
    }
}

/// `det A` as an exact number where that is short, otherwise rounded.
fn exact_determinant(v: &Verification) -> String {
    match v.map.exact_numbers.as_ref().map(|numbers| &numbers.determinant) {
        Some(exact) if exact.len() <= SHORT => format!("det A = {exact}"),
        Some(exact) => {
            let digits = exact.chars().filter(char::is_ascii_digit).count();
            format!("det A = {:.6} (an exact number of {digits} digits)", v.map.determinant)
        }
        None => format!("det A = {:.6}", v.map.determinant),
    }
}

/// At how many sets of lengths both lists of poses are proved to be complete.
fn lists_proved(v: &Verification) -> String {
    let proved =
        |s: &&Sample| [&s.solutions_a, &s.solutions_b].iter().all(|found| found.completeness.is_proved());
    match v.samples.iter().filter(proved).count() {
        count if count == v.samples.len() => "all poses of both proved to be found".to_owned(),
        0 => "without a proof that all poses of both are found".to_owned(),
        count => format!("all poses of both proved to be found at {count} of them"),
    }
}

/// How far the squared lengths are from the map where it is not exact.
fn deviation(v: &Verification) -> String {
    let worst = v.deviation_bounds.map(|bounds| bounds.into_iter().fold(0.0, f64::max));
    worst.map_or_else(String::new, |worst| {
        format!(
            "; A s + c is the squared lengths of B up to {worst:.1e} units squared, a bound at every pose of the box about home that the samples are from (the workspace, where the design has one)"
        )
    })
}

/// What is said about poses beyond precision, after the sentence.
fn set_aside(v: &Verification) -> String {
    let [a, b] = v.beyond_precision();
    match a + b {
        0 => String::new(),
        count => format!(
            "; {count} further pose{} so far out that the rounding of the joints decides whether they exist, left out",
            if count == 1 { "" } else { "s" }
        ),
    }
}

/// Compares platforms A and B, described in the same two frames and units.
///
/// The leg map `s' = A s + c` is derived from the leg vectors alone. Then for each sample pose the forward
/// kinematics of A is solved by its best method and that of B by the general one, which knows nothing of
/// the map, and the complex poses are matched. Poses without partner that joints in double precision do not determine are set aside
/// (`docs/theory/leg-maps.md`). A regular map and perfect matchings of the others give `Equivalent`.
///
/// # Errors
/// [`VerifyError`] when a part could not be computed.
pub fn verify(
    a: &Manipulator,
    b: &Manipulator,
    plan: &SamplePlan,
    options: &FkOptions,
) -> Result<Verification, VerifyError> {
    let alone = VerifyRun { threads: Threads::Count(NonZeroUsize::MIN), cancel: Cancel::new() };
    verify_each(a, b, plan, options, &alone, &mut |_| ControlFlow::Continue(()))
}

/// How a comparison is carried out; its answer does not depend on it.
#[derive(Debug, Clone, Default)]
pub struct VerifyRun {
    /// Threads that solve samples.
    pub threads: Threads,
    /// What ends it before its time.
    pub cancel: Cancel,
}

/// As [`verify()`], with each sample shown as soon as it and those before it are solved.
///
/// # Errors
/// Those of [`verify()`]; [`VerifyError::Cancelled`] when `look` breaks or the run is cancelled.
pub fn verify_each(
    a: &Manipulator,
    b: &Manipulator,
    plan: &SamplePlan,
    options: &FkOptions,
    run: &VerifyRun,
    look: &mut dyn FnMut(&Sample) -> ControlFlow<()>,
) -> Result<Verification, VerifyError> {
    let map = leg_map(a, b, LegMapTolerances::default())?;
    let at_once = match map.relation {
        Relation::Singular => Some(Verdict::Singular),
        Relation::Undecided => Some(Verdict::Inconclusive(InconclusiveReason::MapUndecided)),
        _ if plan.count == 0 => Some(Verdict::Inconclusive(InconclusiveReason::NoSamples)),
        _ => None,
    };
    if let Some(verdict) = at_once {
        return Ok(Verification { verdict, map, deviation_bounds: None, samples: Vec::new() });
    }
    let mut samples = Vec::with_capacity(plan.count);
    let job = {
        let (a, b, plan, options, map) = (a.clone(), b.clone(), *plan, *options, map.clone());
        move |k| take_sample(&a, &b, &plan, &options, &map, k)
    };
    let workers = run.threads.count(plan.count);
    for sample in Stream::new(0..plan.count, workers, run.cancel.clone(), job) {
        let sample = sample?;
        if look(&sample).is_break() {
            return Err(VerifyError::Cancelled);
        }
        samples.push(sample);
    }
    if samples.len() < plan.count {
        return Err(VerifyError::Cancelled);
    }
    let verdict = if map.relation == Relation::Equivalent {
        if samples.iter().all(Sample::agrees) {
            Verdict::Equivalent
        } else if !samples.iter().all(Sample::is_conclusive) {
            Verdict::Inconclusive(InconclusiveReason::SolverIncomplete)
        } else if map.residual > ROUNDED {
            Verdict::Inconclusive(InconclusiveReason::NearlyEquivalent)
        } else {
            Verdict::Inconclusive(InconclusiveReason::Contradiction)
        }
    } else {
        let found = samples.iter().enumerate().find_map(|(k, s)| counterexample(a, b, k, s));
        found.map_or(Verdict::Inconclusive(InconclusiveReason::NoCounterexample), |c| {
            Verdict::NotEquivalent(Box::new(c))
        })
    };
    let deviation_bounds = Some(map.closest.deviation_bounds(a, b, plan));
    Ok(Verification { verdict, map, deviation_bounds, samples })
}

fn take_sample(
    a: &Manipulator,
    b: &Manipulator,
    plan: &SamplePlan,
    options: &FkOptions,
    map: &LegMapOutcome,
    k: usize,
) -> Result<Sample, VerifyError> {
    let pose = plan.pose(k);
    let none = VerifyError::Lengths { sample: k, why: None };
    let squares_a = pose.squared_lengths(a).ok_or_else(|| none.clone())?;
    let squares_b = match map.map() {
        Some(map) => map.apply(&squares_a).map_err(|w| VerifyError::Lengths { sample: k, why: Some(w) })?,
        None => pose.squared_lengths(b).ok_or(none)?,
    };
    let failed = |platform| move |error| VerifyError::ForwardKinematics { platform, error };
    // the two sets are compared with each other: poses that joints in double precision do not determine are set aside there, not counted
    let options = &FkOptions { pose_count: PoseCounting::Never, ..*options };
    let solutions_a = solver(None).solve(a, &squares_a, options).map_err(failed("A"))?;
    let solutions_b = Homotopy.solve(b, &squares_b, options).map_err(failed("B"))?;
    let matching = matched(&solutions_a, &solutions_b, a.size().max(b.size()));
    Ok(Sample { pose, squares_a, squares_b, solutions_a, solutions_b, matching })
}

/// The poses of both, paired; those without partner that joints in double precision do not determine are set aside.
fn matched(a: &FkSolutions, b: &FkSolutions, size: f64) -> PoseMatching {
    let poses = |s: &FkSolutions| -> Vec<ComplexPose> { s.roots.iter().map(|r| r.pose).collect() };
    let mut matching = match_poses(&poses(a), &poses(b), size, SAME_POSE);
    let beyond = |s: &FkSolutions, k: usize| is_beyond_precision(&s.roots[k], size);
    matching.set_aside(|i| beyond(a, i), |j| beyond(b, j));
    matching
}

/// The pose of the sample that misses the other platform's lengths most clearly.
fn counterexample(a: &Manipulator, b: &Manipulator, sample: usize, s: &Sample) -> Option<Counterexample> {
    let sides = [("A", &s.solutions_a, b, &s.squares_b), ("B", &s.solutions_b, a, &s.squares_a)];
    let mut best: Option<Counterexample> = None;
    for (solves, solutions, other, squares) in sides {
        let scale = other.size() * other.size();
        for root in solutions.roots.iter().filter(|r| !is_beyond_precision(r, other.size())) {
            let misses =
                other.legs().map(|leg| root.pose.squared_length(&leg)).into_iter().zip(squares.get());
            for (leg, (found, wanted)) in LegIndex::all().zip(misses) {
                let miss = (found - wanted).norm() / scale;
                let rounding =
                    root.residual.max(1e-15 * (1.0 + found.norm() / scale)) * root.condition.max(1.0);
                let clearer = best.as_ref().is_none_or(|b| miss / rounding > b.miss / b.rounding);
                if miss > CLEAR_MISS * rounding && clearer {
                    best = Some(Counterexample {
                        sample,
                        solves,
                        pose: root.pose,
                        certificate: root.certificate,
                        leg,
                        miss,
                        rounding,
                    });
                }
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Pose;
    use crate::manipulator::{Leg, Octahedral};
    use crate::synthesis::joint_free;
    use nalgebra::{Point3, Rotation3, Vector3};

    fn octahedral() -> Manipulator {
        let joint = |r: f64, turn: f64, k: u32| {
            let (s, c) = (std::f64::consts::TAU * (f64::from(k) / 3.0 + turn)).sin_cos();
            Point3::new(r * c, r * s, 0.0)
        };
        let base = (0..3).map(|k| joint(2.0, 0.0, k)).collect();
        let platform = (0..3).map(|k| joint(1.1, 0.17, k)).collect();
        Manipulator::try_new(base, platform, [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)]).unwrap()
    }

    fn plan() -> SamplePlan {
        SamplePlan {
            home: Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, 2.0) },
            translation: Vector3::repeat(0.4),
            rotation: Vector3::repeat(0.4),
            count: 3,
            seed: 5,
        }
    }

    #[test]
    fn the_joint_free_platform_is_equivalent() {
        let a = octahedral();
        let (b, _) =
            joint_free(&Octahedral::recognise(&a).unwrap(), [0.2, 0.25, 0.2, 0.3, 0.2, 0.25]).unwrap();
        let v = verify(&a, &b, &plan(), &FkOptions::default()).unwrap();
        assert_eq!(v.verdict, Verdict::Equivalent);
        assert!(v.worst_distance() < 1e-9);
        assert!(v.samples.iter().all(|s| s.matching.pairs.len() == 16));
    }

    #[test]
    fn without_samples_nothing_is_concluded_from_them() {
        let a = octahedral();
        let (b, _) = joint_free(&Octahedral::recognise(&a).unwrap(), [0.2; 6]).unwrap();
        let mut legs: [Leg; 6] = b.legs();
        legs[2].platform.z += 0.1;
        for other in [b, Manipulator::from_legs(legs).unwrap()] {
            let v = verify(&a, &other, &SamplePlan { count: 0, ..plan() }, &FkOptions::default()).unwrap();
            assert_eq!(v.verdict, Verdict::Inconclusive(InconclusiveReason::NoSamples));
        }
    }

    #[test]
    fn a_joint_off_its_line_by_a_millionth_is_not_equivalent() {
        let a = octahedral();
        let (b, _) = joint_free(&Octahedral::recognise(&a).unwrap(), [0.2; 6]).unwrap();
        let mut legs: [Leg; 6] = b.legs();
        legs[2].platform.z += 1e-6 * a.size();
        let moved = Manipulator::from_legs(legs).unwrap();
        let v = verify(&a, &moved, &plan(), &FkOptions::default()).unwrap();
        let Verdict::NotEquivalent(c) = v.verdict else { panic!("{:?}", v.verdict) };
        assert!(c.miss > 1e-9 && c.certified());
    }

    /// What `agrees` makes of a sample of an equivalent pair with one more root in B.
    fn agreement_with_another_root(stretch: f64, condition: f64) -> (bool, usize) {
        let a = octahedral();
        let (b, _) = joint_free(&Octahedral::recognise(&a).unwrap(), [0.2; 6]).unwrap();
        let mut sample = verify(&a, &b, &plan(), &FkOptions::default()).unwrap().samples.remove(0);
        let mut root = sample.solutions_b.roots[0].clone();
        root.pose.rotation *= num_complex::Complex64::new(stretch, stretch);
        root.condition = condition;
        sample.solutions_b.roots.push(root);
        sample.matching = matched(&sample.solutions_a, &sample.solutions_b, a.size());
        (sample.agrees(), sample.matching.beyond_b.len())
    }

    #[test]
    fn a_far_pose_without_partner_spoils_the_agreement_unless_rounding_decides_whether_it_exists() {
        assert_eq!(agreement_with_another_root(1e13, 1e11), (true, 1));
        assert_eq!(agreement_with_another_root(1e9, 10.0), (false, 0));
        assert_eq!(agreement_with_another_root(1.0, 1e15), (false, 0));
    }

    #[test]
    fn a_joint_off_its_line_by_less_than_the_map_tells_is_not_called_equivalent() {
        let a = octahedral();
        let (b, _) = joint_free(&Octahedral::recognise(&a).unwrap(), [0.2; 6]).unwrap();
        let mut legs: [Leg; 6] = b.legs();
        legs[2].platform.z += 3e-10 * a.size();
        let moved = Manipulator::from_legs(legs).unwrap();
        let v = verify(&a, &moved, &plan(), &FkOptions::default()).unwrap();
        assert_eq!(v.map.relation, Relation::Equivalent);
        assert_ne!(
            v.verdict,
            Verdict::Equivalent,
            "{:?}",
            v.samples.iter().map(|s| &s.matching).collect::<Vec<_>>()
        );
    }

    #[test]
    fn midpoints_are_singular_and_within_rounding_of_them_nothing_is_said() {
        let halves = |a: &Manipulator| {
            let (b, _) = joint_free(&Octahedral::recognise(a).unwrap(), [0.5; 6]).unwrap();
            verify(a, &b, &plan(), &FkOptions::default()).unwrap().verdict
        };
        let whole =
            |size: f64| vec![Point3::origin(), Point3::new(size, 0.0, 0.0), Point3::new(0.0, size, 1.0)];
        let pairs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
        assert_eq!(halves(&Manipulator::try_new(whole(8.0), whole(4.0), pairs).unwrap()), Verdict::Singular);
        // midpoints of rounded joints are rounded: the design as written is regular by less than its rounding
        let rounded = halves(&octahedral());
        assert_eq!(rounded, Verdict::Inconclusive(InconclusiveReason::MapUndecided));
    }
}
