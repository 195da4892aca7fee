//! Forward kinematics by the elimination template.

use super::collect::{Candidate, collect};
use super::evidence::{GENERAL, attach};
use super::{
    Completeness, FkError, FkOptions, FkSolutions, ForwardKinematics, Method, Rejected, RejectionReason,
};
use crate::manipulator::{Manipulator, SquaredLegLengths};
use crate::num::Rng;
use crate::solve::template::{Candidate as Found, GenericProblem, Layout};

/// Times the elimination is made anew, in other frames, while fewer than 40 poses are proved.
const ATTEMPTS: u64 = 3;

/// A template whose smallest pivot is below this, relative to the largest, has lost rank to rounding.
const PIVOT_LIMIT: f64 = 1e-13;

/// Forward kinematics of a general platform by the elimination template of Martyushev.
///
/// Every one of the 69 eigenvectors is refined, and a pose counts when it satisfies the leg equations; the set
/// is complete only when 40 distinct poses are certified. Special platforms (6-5, planar base) are covered as
/// long as they have 40 poses; platforms with fewer finite poses, and those on which the template loses rank
/// (planar base and planar platform), get [`FkError::NotApplicable`] or an answer that says roots may be missing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Template;

impl ForwardKinematics for Template {
    fn method(&self) -> Method {
        Method::Template
    }

    fn solve(&self, m: &Manipulator, s: &SquaredLegLengths, o: &FkOptions) -> Result<FkSolutions, FkError> {
        let layout = Layout::shipped().map_err(|e| FkError::Breakdown { what: e.to_string() })?;
        solve_with(layout, m, s, o)
    }
}

fn solve_with(
    layout: &Layout,
    m: &Manipulator,
    s: &SquaredLegLengths,
    o: &FkOptions,
) -> Result<FkSolutions, FkError> {
    let mut candidates: Vec<Candidate> = Vec::new();
    let mut infinite = 0;
    let mut best = 0.0f64;
    for attempt in 0..ATTEMPTS {
        let problem = GenericProblem::draw(m, s, &mut Rng::stream(o.seed, attempt));
        let eliminated = layout.fill(&problem).eliminate();
        best = best.max(eliminated.pivot_ratio);
        if !(eliminated.pivot_ratio > PIVOT_LIMIT) {
            continue;
        }
        let pairs = eliminated.eigenpairs().map_err(|e| FkError::Breakdown { what: e.to_string() })?;
        for (k, pair) in pairs.iter().enumerate() {
            match layout.candidate(&problem, pair) {
                Found::Pose(pose) => {
                    let source = attempt as usize * pairs.len() + k;
                    candidates.push(Candidate { pose, singular: false, condition: 1.0, source });
                }
                Found::Infinite => infinite += 1,
            }
        }
        let found = assemble(m, s, o, &candidates, infinite, attempt + 1);
        if attempt + 1 == ATTEMPTS || matches!(found.completeness, Completeness::Proved { .. }) {
            return Ok(found);
        }
    }
    if candidates.is_empty() {
        let reason = format!(
            "the elimination template loses rank on this platform (pivot ratio {best:.1e}), as it does when base \
             and platform are planar or share joints as in a 6-4"
        );
        return Err(FkError::NotApplicable { method: Method::Template, reason });
    }
    Ok(assemble(m, s, o, &candidates, infinite, ATTEMPTS))
}

fn assemble(
    m: &Manipulator,
    s: &SquaredLegLengths,
    o: &FkOptions,
    candidates: &[Candidate],
    infinite: usize,
    attempts: u64,
) -> FkSolutions {
    let collected = collect(m, s, &o.tolerances, candidates);
    let mut rejected = collected.rejected;
    let at_infinity = Rejected { reason: RejectionReason::NotFinite, residual: f64::INFINITY };
    rejected.extend(std::iter::repeat_n(at_infinity, infinite));
    let reason = format!(
        "{} eigenvectors of {attempts} elimination(s) gave {} distinct poses, fewer than the 40 of a general \
         platform or not all of them certified; roots may be missing",
        candidates.len() + infinite,
        collected.roots.len(),
    );
    let mut solutions = FkSolutions {
        method: Method::Template,
        roots: collected.roots,
        completeness: Completeness::Unproved { reason, all_paths_accounted: false },
        paths: Vec::new(),
        rejected,
        seed: o.seed,
    };
    attach(&mut solutions, m, s, GENERAL);
    solutions
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::manipulator::Leg;
    use nalgebra::{Point3, Vector3};

    #[test]
    fn a_corrupted_entry_gives_no_complete_set_and_no_false_root() {
        let mut rng = Rng::new(5);
        let legs = std::array::from_fn(|_| {
            let mut p = || Point3::from(Vector3::from_fn(|_, _| rng.uniform(-2.0, 2.0)));
            Leg { base: p(), platform: p() }
        });
        let m = Manipulator::from_legs(legs).unwrap();
        let s = SquaredLegLengths::try_new([0.7, 1.1, 2.0, 0.9, 2.9, 1.5]).unwrap();
        let o = FkOptions::default();
        let right = Template.solve(&m, &s, &o).unwrap();
        assert!(matches!(right.completeness, Completeness::Proved { .. }));
        assert_eq!(right.rejected.len(), 29, "69 candidates, 40 poses, the others with a reason");
        let shipped = Layout::shipped().unwrap();
        let problem = GenericProblem::draw(&m, &s, &mut Rng::stream(o.seed, 0));
        let good = |layout: &Layout| {
            let pairs = layout.fill(&problem).eliminate().eigenpairs().unwrap();
            let residual = |found: Found| match found {
                Found::Pose(pose) => pose.residual(&m, &s),
                Found::Infinite => f64::INFINITY,
            };
            pairs.iter().filter(|p| residual(layout.candidate(&problem, p)) < 1e-4).count()
        };
        assert_eq!(good(shipped), 40);
        // not every entry matters to the result, but most do
        let mut spoilt = 0;
        for k in 0..8 {
            let index = k * shipped.contributions() / 8;
            let corrupted = shipped.corrupted(index);
            let wrong = solve_with(&corrupted, &m, &s, &o).unwrap();
            if good(&corrupted) < 40 {
                spoilt += 1;
                assert!(!wrong.all_accounted() && wrong.roots.len() < 40, "{}", wrong.roots.len());
            }
            for r in &wrong.roots {
                let near = right.roots.iter().map(|q| q.pose.distance(&r.pose, m.size()));
                assert!(near.fold(f64::MAX, f64::min) < 1e-8);
            }
        }
        assert!(spoilt >= 5, "{spoilt} of 8");
    }
}
