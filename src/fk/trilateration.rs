//! Forward kinematics by trilateration.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use num_complex::Complex64;

use super::bounds::class_bound;
use super::closure_candidates;
use super::counted::compared_with_count;
use super::dependent::related;
use super::evidence::attach;
use super::harvest::{Harvest, HarvestEnd, harvest};
use super::{
    Completeness, FkError, FkOptions, FkRoot, FkSolutions, ForwardKinematics, Method, PreparedDesign, Reason,
    Rejected, RejectionReason, SolutionSet, Theorem, Tried, hidden,
};
use crate::distance::{Evaluator, GenericDegrees, NoPlan, fit};
use crate::solve::certify::dual_quaternion;
use crate::solve::dependence;
use platform::geom::ComplexPose;
use platform::manipulator::{Manipulator, SquaredLegLengths};
use platform::topology::{JointIndex, Nesting, Sequence, sequences};

/// Sequences kept for the legs of a design.
const KEPT: usize = 6;
/// Evaluations after which poses are taken for missing.
const ATTEMPTS: usize = 9;
/// Radii of the circles on which closure polynomials are sampled, in the order in which they are tried.
const RADII: [f64; 3] = [1.0, 16.0, 1.0 / 16.0];

/// Forward kinematics by trilateration in floating point: all finite poses, refined on the leg equations and certified.
///
/// Platforms that need two or three virtual legs have one length hidden, see `docs/theory/hidden-lengths.md`. The
/// others (30 of the 34 joint-sharing topologies) follow a trilateration sequence. The sequence depends on the pattern
/// of shared joints; it is worked out once for the legs of a design and kept in the value. The answer is complete when
/// as many distinct poses are certified as the topology can have. Other sequences are tried before the method gives up.
/// The last resort is the exact closure polynomial ([`closure_candidates`]), which takes milliseconds and more.
/// [`FkError::NotApplicable`] when legs are shared otherwise than in these topologies, or triangles that have to be
/// proper are collinear.
#[derive(Debug, Default)]
pub struct Trilateration {
    known: Mutex<BTreeMap<Legs, Arc<Ranked>>>,
}

/// Base and platform joint of each leg.
type Legs = [(usize, usize); 6];

/// Sequences for six legs with their degrees, or the number of virtual legs when that is too large.
type Ranked = Result<Vec<(Sequence, GenericDegrees)>, NoPlan>;

/// [`Trilateration`] for one design.
#[derive(Debug)]
pub(super) struct Prepared {
    manipulator: Manipulator,
    evaluators: Vec<Evaluator>,
    /// The bound of the design's class: working it out takes as long as a pose.
    theorem: Theorem,
}

impl Trilateration {
    fn ranked(&self, m: &Manipulator) -> Arc<Ranked> {
        let key = m.pairs();
        let known = self.known.lock().unwrap_or_else(PoisonError::into_inner).get(&key).cloned();
        known.unwrap_or_else(|| {
            // outside the lock: two threads may do it twice, with one result
            let ranked = Arc::new(rank(m));
            let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
            known.insert(key, Arc::clone(&ranked));
            ranked
        })
    }

    /// Makes all evaluations in floating point, without the exact polynomial.
    pub(super) fn evaluate(
        &self,
        m: &Manipulator,
        s: &SquaredLegLengths,
        o: &FkOptions,
    ) -> Result<Evaluation, FkError> {
        if let Some(found) = hidden::solve(m, s, o) {
            return Ok(Evaluation::Hidden(found?));
        }
        let design = self.prepared(m)?;
        let evaluated = design.evaluated(s, o)?;
        Ok(Evaluation::Sequences(Box::new(design), evaluated))
    }

    /// The sequences of a design. Joints in one place are one joint, as for the bounds of the classes.
    pub(super) fn prepared(&self, m: &Manipulator) -> Result<Prepared, FkError> {
        let m = m.with_merged_joints();
        let refuse =
            |why: NoPlan| FkError::NotApplicable { method: Method::Trilateration, reason: why.to_string() };
        let ranked = self.ranked(&m);
        let ranked = ranked.as_ref().as_ref().map_err(|why| refuse(*why))?;
        let fitted =
            ranked.iter().filter_map(|(s, shape)| fit(&m, s).map(|(fatness, s)| (fatness, s, *shape)));
        let mut fitted: Vec<(Nesting, f64, Sequence, GenericDegrees)> =
            fitted.map(|(f, s, shape)| (Nesting::of(&m.pairs(), &s), f, s, shape)).collect();
        fitted.sort_by(|x, y| x.0.cmp(&y.0).then(y.1.total_cmp(&x.1)));
        let evaluator = |(_, _, s, shape): &(Nesting, f64, Sequence, GenericDegrees)| {
            Evaluator::with_shape(&m, s, &[], s.closures.first().copied(), *shape)
        };
        let evaluators: Vec<Evaluator> = fitted.iter().filter_map(evaluator).collect();
        if evaluators.is_empty() {
            return Err(refuse(NoPlan::Collinear));
        }
        let theorem = class_bound(&m).unwrap_or(Theorem::SixLegs);
        Ok(Prepared { manipulator: m, evaluators, theorem })
    }
}

/// The best sequences for the legs of a design, those with simple zeros first.
fn rank(m: &Manipulator) -> Ranked {
    let legs = m.pairs();
    let found = (0..=3).map(|count| (count, sequences(&legs, count))).find(|(_, list)| !list.is_empty());
    let (needed, list) = found.unwrap_or((4, Vec::new()));
    if needed > 1 {
        return Err(NoPlan::TooManyVirtualLegs { needed, allowed: 1 });
    }
    let mut seen = Vec::new();
    let mut ranked: Vec<(Sequence, GenericDegrees)> = Vec::new();
    for s in list {
        let key = essence(&s);
        if seen.contains(&key) {
            continue;
        }
        seen.push(key);
        let Some(shape) = GenericDegrees::measure(m, &s, &[], s.closures.first().copied()) else { continue };
        ranked.push((s, shape));
        if ranked.iter().filter(|r| r.1.is_simple()).count() == KEPT {
            break;
        }
    }
    if ranked.iter().any(|r| r.1.is_simple()) {
        ranked.retain(|r| r.1.is_simple());
    }
    // a sequence that generically loses poses is none
    let most = ranked.iter().map(|r| r.1.expected()).max();
    ranked.retain(|r| Some(r.1.expected()) == most);
    Ok(ranked)
}

/// The data that the numerical evaluation depends on; the end of the virtual leg on the first body does not matter.
fn essence(s: &Sequence) -> Vec<Vec<JointIndex>> {
    let known = |x: JointIndex, y: JointIndex| x.across(y).is_none_or(|p| !s.virtual_legs.contains(&p));
    let step = |place: JointIndex, from: [JointIndex; 3]| {
        std::iter::once(place).chain(from.into_iter().filter(|f| known(*f, place))).collect::<Vec<_>>()
    };
    let steps = s.unoriented().map(|t| step(t.place, t.from));
    steps.chain(s.closures.iter().map(|c| c.to_vec())).collect()
}

impl ForwardKinematics for Trilateration {
    fn method(&self) -> Method {
        Method::Trilateration
    }

    fn solve(&self, m: &Manipulator, s: &SquaredLegLengths, o: &FkOptions) -> Result<FkSolutions, FkError> {
        self.evaluate(m, s, o)?.finished(m, s, o)
    }

    fn prepare(&self, m: &Manipulator, _: &FkOptions) -> Option<Box<dyn PreparedDesign>> {
        Some(Box::new(self.prepared(m).ok()?))
    }
}

impl Prepared {
    fn with_evidence(
        &self,
        s: &SquaredLegLengths,
        o: &FkOptions,
        ends: &[HarvestEnd],
        expected: usize,
        tried: Tried,
    ) -> Result<FkSolutions, FkError> {
        with_evidence(&self.manipulator, s, o, ends, expected, tried, self.theorem)
    }
}

/// The evaluations of one problem, kept so that none is made twice.
pub(super) enum Evaluation {
    /// One length is hidden.
    Hidden(FkSolutions),
    /// The sequences of a design.
    Sequences(Box<Prepared>, Evaluated),
}

impl Evaluation {
    /// The answer if the evaluations prove it, otherwise the evaluations.
    pub(super) fn proved(self) -> Result<FkSolutions, Box<Self>> {
        match self {
            Self::Hidden(found) | Self::Sequences(_, Evaluated { found, .. })
                if found.completeness.is_proved() =>
            {
                Ok(found)
            }
            unproved => Err(Box::new(unproved)),
        }
    }

    /// The answer, for unproved evaluations after all further steps of trilateration.
    pub(super) fn finished(
        self,
        m: &Manipulator,
        s: &SquaredLegLengths,
        o: &FkOptions,
    ) -> Result<FkSolutions, FkError> {
        match self {
            Self::Hidden(found) => compared_with_count(found, m, s, o),
            Self::Sequences(design, evaluated) => design.finished(evaluated, s, o),
        }
    }
}

/// All evaluations on the sequences, of which the last may be proved to be complete.
pub(super) struct Evaluated {
    found: FkSolutions,
    ends: Vec<HarvestEnd>,
    expected: usize,
    attempts: usize,
}

impl Prepared {
    /// Evaluations on sequence after sequence, until one is proved to be complete.
    fn evaluated(&self, s: &SquaredLegLengths, o: &FkOptions) -> Result<Evaluated, FkError> {
        let squares = s.get().map(Complex64::from);
        let mut ends: Vec<HarvestEnd> = Vec::new();
        let mut answer = None;
        let attempts = self.evaluators.iter().flat_map(|e| RADII.map(|r| (e, r)));
        for (attempt, (evaluator, radius)) in attempts.take(ATTEMPTS).enumerate() {
            // without a closure there is no circle
            if attempt > 0 && !evaluator.has_closure() && radius.to_bits() != RADII[0].to_bits() {
                continue;
            }
            let configurations = evaluator.configurations(&squares, radius);
            ends.extend(ends_at(configurations.found.iter().map(|c| c.pose)));
            let tried = Tried::Evaluations(attempt + 1);
            let found = self.with_evidence(s, o, &ends, configurations.expected, tried)?;
            let proved = found.completeness.is_proved();
            answer = Some((found, configurations.expected, attempt + 1));
            if proved {
                break;
            }
        }
        let (found, expected, attempts) =
            answer.ok_or_else(|| FkError::Breakdown { what: "no sequence could be evaluated".to_owned() })?;
        Ok(Evaluated { found, ends, expected, attempts })
    }

    /// The answer if evaluations in floating point prove it.
    pub(super) fn proved(&self, s: &SquaredLegLengths, o: &FkOptions) -> Option<FkSolutions> {
        Some(self.evaluated(s, o).ok()?.found).filter(|found| found.completeness.is_proved())
    }

    /// The answer; the exact polynomial and the count of poses follow evaluations that prove nothing.
    fn finished(
        &self,
        evaluated: Evaluated,
        s: &SquaredLegLengths,
        o: &FkOptions,
    ) -> Result<FkSolutions, FkError> {
        let Evaluated { mut found, mut ends, expected, attempts } = evaluated;
        if !found.completeness.is_proved() {
            let legs = dependence(&self.manipulator, s);
            if let Some(dependent) = related(legs, &self.manipulator, s, o) {
                return dependent;
            }
            // doubles did not find them all: the exact polynomial, where there is one
            let exact = closure_candidates(&self.manipulator, s);
            if !exact.is_empty() {
                ends.extend(ends_at(exact));
                found = self.with_evidence(s, o, &ends, expected, Tried::Evaluations(attempts + 1))?;
            }
        }
        compared_with_count(found, &self.manipulator, s, o)
    }
}

impl PreparedDesign for Prepared {
    fn solve(&self, s: &SquaredLegLengths, o: &FkOptions) -> Result<FkSolutions, FkError> {
        self.finished(self.evaluated(s, o)?, s, o)
    }
}

/// Poses as points to be refined; those without a dual quaternion (`R^T R` far from one) are left out.
pub(super) fn ends_at(poses: impl IntoIterator<Item = ComplexPose>) -> impl Iterator<Item = HarvestEnd> {
    let points = poses.into_iter().enumerate().filter_map(|(source, p)| Some((source, dual_quaternion(&p)?)));
    points.map(|(source, point)| HarvestEnd {
        point,
        singular: false,
        doubtful: false,
        split: None,
        condition: 1.0,
        source,
    })
}

/// Refines, merges and certifies the ends of all that was `tried`; `theorem` bounds their number. Ends without a
/// certificate are not roots: with other distances the same lengths give other poses far out by rounding.
pub(super) fn with_evidence(
    m: &Manipulator,
    s: &SquaredLegLengths,
    o: &FkOptions,
    ends: &[HarvestEnd],
    expected: usize,
    tried: Tried,
    theorem: Theorem,
) -> Result<FkSolutions, FkError> {
    let Harvest { collected, certificates } = harvest(m, s, &o.tolerances, ends, &[]);
    let mut rejected = collected.rejected;
    let mut roots = collected.roots;
    let reason = RejectionReason::NotCertified;
    let others = roots.iter().filter(|r| !r.certified());
    rejected.extend(others.map(|r| Rejected { reason, residual: r.residual }));
    roots.retain(FkRoot::certified);
    let found =
        Reason::Trilaterated { certified: roots.len(), configurations: ends.len(), tried, usual: expected };
    let mut solutions = FkSolutions {
        method: Method::Trilateration,
        roots,
        solution_set: SolutionSet::Isolated,
        completeness: Completeness::unproved([found]),
        paths: Vec::new(),
        rejected,
        pose_count: None,
        library_calls: Vec::new(),
        unproved: Vec::new(),
        seed: o.seed,
    };
    attach(&mut solutions, m, s, theorem, certificates)?;
    Ok(solutions)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PoseCounting;
    use nalgebra::Point3;
    use platform::topology::catalogue;

    /// A member of a topology with general joints.
    fn member(number: usize) -> Manipulator {
        let t = catalogue()[number - 1].topology();
        let place = |k: usize| {
            let k = k as f64;
            Point3::new((1.3 * k).cos() + 0.1 * k, (1.7 * k).sin(), (5.0 * k).sin())
        };
        let base = (0..t.base_joints()).map(place).collect();
        let platform = (0..t.platform_joints()).map(|k| place(k + 7)).collect();
        Manipulator::try_new(base, platform, t.legs()).unwrap()
    }

    /// Evaluations that prove nothing are handed on: the exact polynomial follows without another evaluation, which
    /// would fail here for want of a sequence.
    #[test]
    fn evaluations_are_made_once() {
        let o = FkOptions { pose_count: PoseCounting::Never, ..FkOptions::default() };
        let s = SquaredLegLengths::try_new([3.1, 2.9, 3.3, 2.7, 3.0, 3.2]).unwrap();
        for number in [7, 22] {
            let m = member(number);
            let Evaluation::Sequences(mut design, mut evaluated) =
                Trilateration::default().evaluate(&m, &s, &o).unwrap()
            else {
                panic!("T{number:02}")
            };
            let count = evaluated.found.roots.len();
            assert!(evaluated.found.completeness.is_proved() && count > 0);
            evaluated.found.completeness = Completeness::unproved([]);
            evaluated.found.roots.clear();
            evaluated.ends.clear();
            design.evaluators.clear();
            assert!(design.solve(&s, &o).is_err());
            let finished = Evaluation::Sequences(design, evaluated).finished(&m, &s, &o).unwrap();
            assert_eq!((finished.roots.len(), finished.is_complete()), (count, true), "T{number:02}");
        }
    }

    /// Joints in one place are one joint, whichever door asks.
    #[test]
    fn joints_in_one_place_are_merged_at_every_door() {
        let (o, method) = (FkOptions::default(), Trilateration::default());
        let s = SquaredLegLengths::try_new([3.1, 2.9, 3.3, 2.7, 3.0, 3.2]).unwrap();
        for number in [7, 6] {
            let m = member(number);
            let legs = m.legs();
            let apart = Manipulator::from_legs(legs).unwrap();
            let expected = method.solve(&m, &s, &o).unwrap();
            assert!(expected.completeness.is_proved());
            assert_eq!(method.solve(&apart, &s, &o).unwrap().roots.len(), expected.roots.len());
            if let Some(design) = method.prepare(&m, &o) {
                let prepared = method.prepare(&apart, &o).unwrap();
                let count = |d: &dyn PreparedDesign| d.solve(&s, &o).unwrap().roots.len();
                assert_eq!(count(prepared.as_ref()), count(design.as_ref()));
            }
        }
    }
}
