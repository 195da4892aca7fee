//! The verdict on two platforms.

use std::num::NonZeroUsize;
use std::ops::ControlFlow;

use thiserror::Error;

use super::decision::decide_map;
use super::determined::is_beyond_precision;
use super::matching::{PoseMatching, match_poses};
use super::sample::Sample;
use fk::solve::certify::RootCertificate;
use fk::{FkError, FkOptions, FkSolutions, ForwardKinematics, Homotopy, PoseCounting, Threads, solver};
use num::Cancel;
use num::linalg::LinalgError;
use num::shown::rounded;
use num::stream::Stream;
use platform::geom::{ComplexPose, SamplePlan};
use platform::manipulator::{LegIndex, Manipulator};
use synthesis::{LegMapOutcome, NotRealizable, Relation};

/// Two poses count as equal if they are closer than this (relative to the size and to their own numbers).
///
/// Roots are accurate to `1e-12` or better unless they are nearly double. A joint displaced by `1e-6` of the size moves
/// poses by about `1e-6`.
pub const SAME_POSE: f64 = 1e-8;
/// Greatest length of an exact number in a sentence.
const SHORT: usize = 24;
/// Least ratio of a counterexample's miss of the other platform's lengths to the expected rounding.
const CLEAR_MISS: f64 = 1e3;

/// The reason why platforms could not be compared at all.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum VerifyError {
    /// The leg map could not be computed.
    #[error("the leg map could not be computed: {0}")]
    LegMap(#[from] LinalgError),
    /// A forward-kinematics method failed.
    #[error("forward kinematics of {platform} failed: {error}")]
    ForwardKinematics {
        /// `"A"` or `"B"`.
        platform: &'static str,
        /// The error.
        error: FkError,
    },
    /// A sample pose has lengths that overflow or that the map sends to a negative square.
    #[error("sample {sample} has no usable leg lengths{}", .why.map(|w| format!(": {w}")).unwrap_or_default())]
    Lengths {
        /// Index of the sample.
        sample: usize,
        /// The leg with the negative square.
        why: Option<NotRealizable>,
    },
    /// Two proofs contradict each other.
    #[error(
        "sample {}: the platforms are proved equivalent, and proved to have {} and {} poses: one of the proofs is wrong, please report both designs", .sample + 1, .poses[0], .poses[1]
    )]
    Contradiction {
        /// Index of the sample.
        sample: usize,
        /// Numbers of poses of A and of B, both proved complete.
        poses: [usize; 2],
    },
    /// The comparison was cancelled.
    #[error("the comparison was cancelled")]
    Cancelled,
}

/// A pose for the lengths of one platform that does not fit those of the other.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Counterexample {
    /// Index of the sample.
    pub sample: usize,
    /// `"A"` if the pose solves A and not B, `"B"` for the reverse.
    pub solves: &'static str,
    /// The pose.
    pub pose: ComplexPose,
    /// The interval certificate that proves the pose a solution of the one platform, if there is one.
    pub certificate: Option<RootCertificate>,
    /// The leg of the other platform with the greatest miss.
    pub leg: LegIndex,
    /// The miss of its squared length, relative to the squared size.
    pub miss: f64,
    /// Expected rounding of this number.
    pub rounding: f64,
}

impl Counterexample {
    /// Whether the pose is proved to solve the one platform.
    #[must_use]
    pub fn certified(&self) -> bool {
        self.certificate.is_some()
    }
}

num::words! {
    /// The reason for an undecided verdict.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[non_exhaustive]
    pub enum InconclusiveReason as sentence {
        /// The map holds within rounding, but some sample could not be solved completely.
        SolverIncomplete =
            "the leg map holds within rounding, but forward kinematics may have missed poses of a sample",
        /// The map holds within rounding, but the poses found contradict it.
        Contradiction =
            "the leg map holds within rounding, but at a sample the poses of the two differ by more than rounding of the joints explains. The samples decide nothing: bodies of very different size, or nearly double poses, make poses this uncertain",
        /// The map holds within its tolerance, but its regularity is undecided.
        MapUndecided = "the leg map is not decided: a singular platform is within rounding of one of the two",
        /// No samples were requested, so only the map decides.
        NoSamples = "no sets of lengths were compared by forward kinematics",
        /// The map holds within rounding of the joints, and the poses agree: nothing is proved.
        WithinRounding =
            "the platforms are equivalent within rounding, not proved: the leg map holds as far as the joints are known, and forward kinematics agrees",
        /// There is no map, but no pose was found that distinguishes the platforms.
        NoCounterexample =
            "there is no leg map within the tolerance, but no sampled pose clearly distinguishes the platforms",
    }
}

/// The verdict on two platforms.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// Proved: there is a regular leg map between the joints as given. Independently solved forward kinematics of both
    /// at the samples is additional evidence ([`Verification::agreeing`]).
    Equivalent,
    /// There is no leg map, by proof or by a pose; the pose if a sample has one.
    NotEquivalent(Option<Box<Counterexample>>),
    /// One platform is architecturally singular: proved.
    Singular,
    /// Undecided.
    Inconclusive(InconclusiveReason),
}

/// The verdict in words, with its evidence or the reason for none.
impl std::fmt::Display for Verdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Equivalent => f.write_str("equivalent"),
            Self::NotEquivalent(None) => f.write_str("not equivalent: there is no leg map"),
            Self::NotEquivalent(Some(c)) => {
                let proved = if c.certified() { "proved" } else { "not proved" };
                write!(f, "not equivalent: a pose of {} ({proved}) misses {} of the other", c.solves, c.leg)
            }
            Self::Singular => f.write_str("singular: one of the platforms is architecturally singular"),
            Self::Inconclusive(why) => write!(f, "inconclusive: {}", why.sentence()),
        }
    }
}

impl Verdict {
    /// The word of the command line.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.word().name()
    }
}

num::answer_words! {
    /// Whether two designs are kinematically equivalent.
    pub enum VerdictWord as name of Verdict {
        /// They are equivalent.
        Equivalent = "equivalent",
        /// They are not equivalent.
        NotEquivalent = "not_equivalent",
        /// One of them is architecturally singular.
        Singular = "singular",
        /// Undecided.
        Inconclusive = "inconclusive",
    }
}

/// The verdict with all its evidence.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Verification {
    /// The verdict.
    pub verdict: Verdict,
    /// The algebraic evidence.
    pub map: LegMapOutcome,
    /// Bounds of `|s(B) - A s - c|` for each leg of B over the box of the sample poses, units squared, for the joints
    /// as doubles. `None` for a proved map, which has no difference, and for a singular one.
    pub deviation_bounds: Option<[f64; 6]>,
    /// The numerical evidence; empty for a singular map, for which forward kinematics gives no comparison.
    pub samples: Vec<Sample>,
}

impl Verification {
    /// Whether the verdict is proved: by an identity of leg vectors in exact arithmetic, or by the proof that there is
    /// none.
    #[must_use]
    pub fn proved(&self) -> bool {
        self.map.level.is_proved() && self.map.relation != Relation::Undecided
    }

    /// Number of samples with agreeing, independently solved forward kinematics.
    #[must_use]
    pub fn agreeing(&self) -> usize {
        self.samples.iter().filter(|s| s.agrees()).count()
    }

    /// The deciding numbers in sentences that can follow a colon, without the last full stop.
    #[must_use]
    pub fn explanation(&self) -> String {
        let (v, n) = (self, self.samples.len());
        match &v.verdict {
            Verdict::Equivalent => format!(
                "proved {}: every leg vector of B is exactly a combination of those of A, and {} is not zero. {}{}",
                v.map.level.words(),
                exact_determinant(v),
                agreement(v),
                beyond_in_words(v)
            ),
            Verdict::Singular
            | Verdict::NotEquivalent(None)
            | Verdict::Inconclusive(InconclusiveReason::MapUndecided) => v.map.explanation(),
            Verdict::NotEquivalent(Some(c)) => {
                let other = if c.solves == "A" { "B" } else { "A" };
                format!(
                    "{}. At sample {} a {}pose of {} misses the squared length of {} of {other} by {:.1e} of the squared size (rounding {:.1e}){}",
                    v.map.explanation(),
                    c.sample + 1,
                    if c.certified() { "certified " } else { "" },
                    c.solves,
                    c.leg,
                    c.miss,
                    c.rounding,
                    deviation(v)
                )
            }
            Verdict::Inconclusive(reason @ InconclusiveReason::WithinRounding) => format!(
                "{} at {n} of {n} sets of lengths. Leg map: {}{}{}",
                reason.sentence(),
                v.map.explanation().trim_start_matches("within rounding, not proved: "),
                beyond_in_words(v),
                deviation(v)
            ),
            Verdict::Inconclusive(reason) => reason.sentence().to_owned(),
        }
    }

    /// The largest distance of matched poses over all samples.
    #[must_use]
    pub fn worst_distance(&self) -> f64 {
        self.samples.iter().map(|s| s.matching.worst_distance()).fold(0.0, f64::max)
    }

    /// Numbers of excluded poses of A and of B without partner over all samples. Joints within the rounding of the
    /// given ones may lack these poses.
    #[must_use]
    pub fn beyond_precision(&self) -> [usize; 2] {
        let count = |of: fn(&Sample) -> usize| self.samples.iter().map(of).sum();
        [count(|s| s.matching.beyond_a.len()), count(|s| s.matching.beyond_b.len())]
    }
}

/// `det A` as an exact number if that is short, otherwise rounded.
fn exact_determinant(v: &Verification) -> String {
    match v.map.exact_numbers.as_ref().map(|numbers| &numbers.determinant) {
        Some(exact) if exact.len() <= SHORT => format!("det A = {exact}"),
        Some(exact) => {
            let digits = exact.chars().filter(char::is_ascii_digit).count();
            format!("det A = {} (an exact number of {digits} digits)", rounded(v.map.determinant, 3))
        }
        None => format!("det A = {}", rounded(v.map.determinant, 3)),
    }
}

/// The agreement of the independent forward kinematics of equivalent platforms.
fn agreement(v: &Verification) -> String {
    const UNKNOWN: &str = "doubles of the joints do not determine the poses";
    match (v.agreeing(), v.samples.len()) {
        (0, 0) => format!("Forward kinematics gives no comparison: {UNKNOWN}"),
        (0, n) => format!("Forward kinematics agrees at none of {n} sets of lengths: {UNKNOWN}"),
        (agreeing, n) => format!(
            "Forward kinematics of both, solved independently, agrees at {agreeing} of {n} sets of lengths, {}. \
             The worst relative distance of matched poses is {:.1e}{}",
            lists_proved(v),
            v.worst_distance(),
            if agreeing < n { format!(". At the other sets, {UNKNOWN}") } else { String::new() }
        ),
    }
}

/// Number of length sets with both lists of poses proved complete, in words.
fn lists_proved(v: &Verification) -> String {
    let proved =
        |s: &&Sample| [&s.solutions_a, &s.solutions_b].iter().all(|found| found.completeness.is_proved());
    match v.samples.iter().filter(proved).count() {
        count if count == v.samples.len() => "all poses of both proved to be found".to_owned(),
        0 => "without a proof that all poses of both are found".to_owned(),
        count => format!("all poses of both proved to be found at {count} of them"),
    }
}

/// The deviation of the squared lengths from an inexact map, in words.
fn deviation(v: &Verification) -> String {
    let worst = v.deviation_bounds.map(|bounds| bounds.into_iter().fold(0.0, f64::max));
    worst.map_or_else(String::new, |worst| {
        format!(
            ". A s + c differs from the squared lengths of B by at most {worst:.1e} square units in the box of the sample poses"
        )
    })
}

/// The poses beyond precision in words, a sentence for the end.
fn beyond_in_words(v: &Verification) -> String {
    let [a, b] = v.beyond_precision();
    match a + b {
        0 => String::new(),
        count => format!(
            ". {count} further pose{} left out: so far away, the rounding of the joints decides whether a pose exists",
            if count == 1 { " is" } else { "s are" }
        ),
    }
}

/// Compares platforms A and B, described in the same two frames and units.
///
/// The leg map `s' = A s + c` is derived from the leg vectors alone. At each sample pose the best method solves the
/// forward kinematics of A. The general method, which does not use the map, solves it for B. The complex poses are
/// then matched. Poses without partner that joints in double precision do not determine are excluded
/// (`docs/theory/leg-maps.md`). A regular map and perfect matchings of the other poses give `Equivalent`.
///
/// # Errors
/// [`VerifyError`] if a part could not be computed.
pub fn verify(
    a: &Manipulator,
    b: &Manipulator,
    plan: &SamplePlan,
    options: &FkOptions,
) -> Result<Verification, VerifyError> {
    let alone = VerifyRun { threads: Threads::Count(NonZeroUsize::MIN), cancel: Cancel::new() };
    verify_each(a, b, plan, options, &alone, &mut |_| ControlFlow::Continue(()))
}

/// The execution of a comparison, which does not influence its answer.
#[derive(Debug, Clone, Default)]
pub struct VerifyRun {
    /// Threads that solve samples.
    pub threads: Threads,
    /// The cancellation switch.
    pub cancel: Cancel,
}

/// [`verify()`], with each sample passed on as soon as it and the earlier ones are solved.
///
/// # Errors
/// The errors of [`verify()`]; [`VerifyError::Cancelled`] if `observe` breaks or the run is cancelled.
pub fn verify_each(
    a: &Manipulator,
    b: &Manipulator,
    plan: &SamplePlan,
    options: &FkOptions,
    run: &VerifyRun,
    observe: &mut dyn FnMut(&Sample) -> ControlFlow<()>,
) -> Result<Verification, VerifyError> {
    verified(a, b, decide_map(a, b)?, plan, options, run, observe)
}

/// [`verify()`] for a known map.
///
/// # Errors
/// The errors of [`verify()`].
pub fn verify_mapped(
    a: &Manipulator,
    b: &Manipulator,
    map: LegMapOutcome,
    plan: &SamplePlan,
    options: &FkOptions,
) -> Result<Verification, VerifyError> {
    let alone = VerifyRun { threads: Threads::Count(NonZeroUsize::MIN), cancel: Cancel::new() };
    verified(a, b, map, plan, options, &alone, &mut |_| ControlFlow::Continue(()))
}

fn verified(
    a: &Manipulator,
    b: &Manipulator,
    map: LegMapOutcome,
    plan: &SamplePlan,
    options: &FkOptions,
    run: &VerifyRun,
    observe: &mut dyn FnMut(&Sample) -> ControlFlow<()>,
) -> Result<Verification, VerifyError> {
    let undecided = map.relation == Relation::Undecided;
    let at_once = match map.relation {
        Relation::Singular => Some(Verdict::Singular),
        _ if undecided && !map.is_regular_within_rounding() => {
            Some(Verdict::Inconclusive(InconclusiveReason::MapUndecided))
        }
        _ if plan.count > 0 => None,
        Relation::Equivalent => Some(Verdict::Equivalent),
        Relation::Unrelated if map.level.is_proved() => Some(Verdict::NotEquivalent(None)),
        _ => Some(Verdict::Inconclusive(InconclusiveReason::NoSamples)),
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
    let proved = map.relation == Relation::Equivalent;
    let mut solved = 0;
    for sample in Stream::new(0..plan.count, workers, run.cancel.clone(), job) {
        solved += 1;
        let sample = match sample {
            // a proof holds even if doubles cannot solve the illustrating length sets
            Err(VerifyError::Lengths { .. } | VerifyError::ForwardKinematics { .. }) if proved => continue,
            other => other?,
        };
        if observe(&sample).is_break() {
            return Err(VerifyError::Cancelled);
        }
        samples.push(sample);
    }
    if solved < plan.count {
        return Err(VerifyError::Cancelled);
    }
    let verdict = match map.relation {
        Relation::Equivalent => contradiction(&samples).map_or(Ok(Verdict::Equivalent), Err)?,
        Relation::Unrelated => {
            let found = samples.iter().enumerate().find_map(|(k, s)| counterexample(a, b, k, s));
            if found.is_some() || map.level.is_proved() {
                Verdict::NotEquivalent(found.map(Box::new))
            } else {
                Verdict::Inconclusive(InconclusiveReason::NoCounterexample)
            }
        }
        _ => Verdict::Inconclusive(if samples.iter().all(Sample::agrees) {
            InconclusiveReason::WithinRounding
        } else if !samples.iter().all(Sample::is_conclusive) {
            InconclusiveReason::SolverIncomplete
        } else {
            InconclusiveReason::Contradiction
        }),
    };
    let deviation_bounds =
        (map.relation != Relation::Equivalent).then(|| map.closest.deviation_bounds(a, b, plan));
    Ok(Verification { verdict, map, deviation_bounds, samples })
}

/// Complete lists of poses of platforms that are proved equivalent have equal lengths.
fn contradiction(samples: &[Sample]) -> Option<VerifyError> {
    samples.iter().enumerate().find_map(|(sample, s)| {
        let lists = [&s.solutions_a, &s.solutions_b];
        let poses = lists.map(|found| found.roots.len());
        let proved = lists.iter().all(|found| found.completeness.is_proved());
        (proved && poses[0] != poses[1]).then_some(VerifyError::Contradiction { sample, poses })
    })
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
    // the two sets are compared with each other: poses that joints in double precision do not determine are excluded
    // there, and not counted
    let options = &options.pose_count(PoseCounting::Never);
    let solutions_a = solver(None).solve(a, &squares_a, options).map_err(failed("A"))?;
    let solutions_b = Homotopy.solve(b, &squares_b, options).map_err(failed("B"))?;
    let matching = matched(&solutions_a, &solutions_b, a.size().max(b.size()));
    Ok(Sample { pose, squares_a, squares_b, solutions_a, solutions_b, matching })
}

/// The poses of both, paired; excluded are those without partner that joints in double precision do not determine.
fn matched(a: &FkSolutions, b: &FkSolutions, size: f64) -> PoseMatching {
    let poses = |s: &FkSolutions| -> Vec<ComplexPose> { s.roots.iter().map(|r| r.pose).collect() };
    let mut matching = match_poses(&poses(a), &poses(b), size, SAME_POSE);
    let beyond = |s: &FkSolutions, k: usize| is_beyond_precision(&s.roots[k], size);
    matching.set_aside(|i| beyond(a, i), |j| beyond(b, j));
    matching
}

/// The pose of the sample with the clearest miss of the other platform's lengths.
fn counterexample(a: &Manipulator, b: &Manipulator, sample: usize, s: &Sample) -> Option<Counterexample> {
    let sides = [("A", &s.solutions_a, b, &s.squares_b), ("B", &s.solutions_b, a, &s.squares_a)];
    let mut best: Option<Counterexample> = None;
    for (solves, solutions, other, squares) in sides {
        let scale = other.size() * other.size();
        for root in solutions.roots.iter().filter(|r| !is_beyond_precision(r, other.size())) {
            let misses =
                other.legs().map(|leg| root.pose.squared_length(&leg)).into_iter().zip(squares.get());
            for (leg, (found, expected)) in LegIndex::all().zip(misses) {
                let miss = (found - expected).norm() / scale;
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
    use nalgebra::{Point3, Rotation3, Vector3};
    use platform::geom::Pose;
    use platform::manipulator::{Leg, Octahedral};
    use synthesis::joint_free;

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
        // offsets in doubles put joints off their lines by rounding
        assert_eq!(v.verdict, Verdict::Inconclusive(InconclusiveReason::WithinRounding));
        assert!(v.worst_distance() < 1e-9);
        assert!(v.samples.iter().all(|s| s.matching.pairs.len() == 16));
    }

    #[test]
    fn without_samples_nothing_is_concluded_from_them() {
        let a = octahedral();
        let (b, _) = joint_free(&Octahedral::recognise(&a).unwrap(), [0.2; 6]).unwrap();
        let mut legs: [Leg; 6] = b.legs();
        legs[2].platform.z += 0.1;
        let of = |other: &Manipulator| {
            verify(&a, other, &SamplePlan { count: 0, ..plan() }, &FkOptions::default()).unwrap().verdict
        };
        // joints in doubles: within rounding only poses could add evidence, and a joint off its line is proved as such
        assert_eq!(of(&b), Verdict::Inconclusive(InconclusiveReason::NoSamples));
        assert_eq!(of(&Manipulator::from_legs(legs).unwrap()), Verdict::NotEquivalent(None));
        assert_eq!(of(&a), Verdict::Equivalent);
    }

    #[test]
    fn a_joint_off_its_line_by_a_millionth_is_not_equivalent() {
        let a = octahedral();
        let (b, _) = joint_free(&Octahedral::recognise(&a).unwrap(), [0.2; 6]).unwrap();
        let mut legs: [Leg; 6] = b.legs();
        legs[2].platform.z += 1e-6 * a.size();
        let moved = Manipulator::from_legs(legs).unwrap();
        let v = verify(&a, &moved, &plan(), &FkOptions::default()).unwrap();
        let Verdict::NotEquivalent(Some(c)) = v.verdict else { panic!("{:?}", v.verdict) };
        assert!(c.miss > 1e-9 && c.certified());
    }

    /// The agreement of a sample of an equivalent pair with an additional root in B.
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
    fn a_joint_off_its_line_by_more_than_rounding_is_proved_not_equivalent() {
        let a = octahedral();
        let (b, _) = joint_free(&Octahedral::recognise(&a).unwrap(), [0.2; 6]).unwrap();
        let mut legs: [Leg; 6] = b.legs();
        legs[2].platform.z += 3e-10 * a.size();
        let moved = Manipulator::from_legs(legs).unwrap();
        let v = verify(&a, &moved, &plan(), &FkOptions::default()).unwrap();
        assert_eq!(v.map.relation, Relation::Unrelated);
        assert!(matches!(v.verdict, Verdict::NotEquivalent(_)), "{:?}", v.verdict);
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
