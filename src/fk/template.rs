//! Forward kinematics by the elimination template.

use super::counted::compared_with_count;
use super::elimination::PoseCandidates;
use super::{FkError, FkOptions, FkSolutions, ForwardKinematics, LibraryCalls, Method};
use crate::solve::generic_frame::GenericProblem;
use crate::solve::template::TemplateLayout;
use num::Purpose;
use platform::geom::ComplexPose;
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// Eliminations in different frames while fewer than 40 poses are proved.
const ATTEMPTS: usize = 3;

/// The legs and bodies of a design in another arrangement, which has the same poses.
#[derive(Debug, Clone, Copy)]
struct Arrangement {
    /// Number of legs moved from the end of the list to its beginning.
    shift: usize,
    /// Base and platform are exchanged.
    exchanged: bool,
}

/// The arrangements in the order of trial. The template treats legs 5 and 6 and the bodies differently; with one joint
/// outside the plane of its body it keeps its rank if this joint is a platform joint of legs 1 to 4.
const ARRANGEMENTS: [Arrangement; 4] = [
    Arrangement { shift: 0, exchanged: false },
    Arrangement { shift: 2, exchanged: false },
    Arrangement { shift: 0, exchanged: true },
    Arrangement { shift: 2, exchanged: true },
];

impl Arrangement {
    fn of(self, m: &Manipulator, s: &SquaredLegLengths) -> Option<(Manipulator, SquaredLegLengths)> {
        let order: [usize; 6] = std::array::from_fn(|i| (i + 6 - self.shift) % 6);
        let bodies = if self.exchanged { m.exchanged() } else { m.clone() };
        let squares = SquaredLegLengths::try_new(order.map(|i| s.get()[i])).ok()?;
        Some((bodies.reordered(order).ok()?, squares))
    }

    /// The pose of the design that belongs to a pose in this arrangement.
    fn pose(self, found: ComplexPose) -> ComplexPose {
        if !self.exchanged {
            return found;
        }
        let rotation = found.rotation.transpose();
        ComplexPose { rotation, position: -(rotation * found.position) }
    }
}

/// Forward kinematics of a general platform by the elimination template of Martyushev.
///
/// Every one of the 69 eigenvectors is refined, and a pose counts when it satisfies the leg equations. The set is
/// complete only when 40 distinct poses are certified. Special platforms (6-5, planar base) are covered as long as
/// they have 40 poses. Other orders of the legs and exchanged bodies are tried if the template loses rank.
/// Platforms with fewer finite poses get [`FkError::NotApplicable`] or an answer that says roots may be missing.
/// The same holds for platforms on which the template loses rank in every arrangement, as with planar base and
/// planar platform.
#[derive(Debug, Clone, Copy, Default)]
pub struct Template;

impl ForwardKinematics for Template {
    fn method(&self) -> Method {
        Method::Template
    }

    fn solve(&self, m: &Manipulator, s: &SquaredLegLengths, o: &FkOptions) -> Result<FkSolutions, FkError> {
        let layout = TemplateLayout::shipped().map_err(|e| FkError::Breakdown { what: e.to_string() })?;
        compared_with_count(solve_with(layout, m, s, o)?, m, s, o)
    }
}

fn solve_with(
    layout: &TemplateLayout,
    m: &Manipulator,
    s: &SquaredLegLengths,
    o: &FkOptions,
) -> Result<FkSolutions, FkError> {
    let mut candidates = PoseCandidates::default();
    let (mut best, mut eliminations, mut eigenproblems) = (0.0f64, 0, 0);
    for arrangement in ARRANGEMENTS {
        let Some((legs, squares)) = arrangement.of(m, s) else { continue };
        while eigenproblems < ATTEMPTS {
            let rng = &mut Purpose::GENERIC_FRAMES.item(o.seed, eliminations);
            let problem = GenericProblem::draw(&legs, &squares, rng);
            let eliminated = layout.fill(&problem).eliminate();
            eliminations += 1;
            best = best.max(eliminated.pivot_ratio);
            if !eliminated.has_rank() {
                break;
            }
            let pairs = eliminated.eigenpairs().map_err(|e| FkError::Breakdown { what: e.to_string() })?;
            let poses = pairs.iter().map(|pair| layout.pose(&problem, pair));
            candidates.add(poses.map(|pose| pose.map(|pose| arrangement.pose(pose))));
            eigenproblems += 1;
            let mut found = candidates.solutions(Method::Template, m, s, o)?;
            if eigenproblems == ATTEMPTS || found.completeness.is_proved() {
                found.library_calls = library_calls(layout, eliminations, eigenproblems);
                return Ok(found);
            }
        }
    }
    if candidates.is_empty() {
        let reason = format!(
            "the elimination template loses rank on this platform in every arrangement of legs and bodies (pivot ratio \
             {best:.1e}), as it does when base and platform are planar or share joints as in a 6-4"
        );
        return Err(FkError::NotApplicable { method: Method::Template, reason });
    }
    let mut found = candidates.solutions(Method::Template, m, s, o)?;
    found.library_calls = library_calls(layout, eliminations, eigenproblems);
    Ok(found)
}

/// The computations of faer: a factorisation for each elimination, and an eigenproblem for each that kept its rank.
fn library_calls(layout: &TemplateLayout, eliminations: u64, eigenproblems: usize) -> Vec<LibraryCalls> {
    let call = |computation, size, calls| LibraryCalls { library: "faer", computation, size, calls };
    let factors = usize::try_from(eliminations).unwrap_or(usize::MAX);
    vec![call("plu", layout.size(), factors), call("qz", [layout.candidates(); 2], eigenproblems)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Point3, Vector3};
    use num::Rng;
    use platform::manipulator::{Body, Leg};

    /// One joint outside the plane of its body: on either body, at the first and at the last leg.
    #[test]
    fn almost_planar_platforms_are_solved_in_another_arrangement() {
        let mut rng = Rng::new(3);
        let s = SquaredLegLengths::try_new([0.7, 1.1, 2.0, 0.9, 2.9, 1.5]).unwrap();
        for outside in [None, Some((Body::Base, 0)), Some((Body::Base, 5)), Some((Body::Platform, 5))] {
            let legs = std::array::from_fn(|i| {
                let mut point = |body: Body| {
                    let z = if outside == Some((body, i)) { 1.0 } else { 0.0 };
                    Point3::new(rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0), z)
                };
                Leg { base: point(Body::Base), platform: point(Body::Platform) }
            });
            let found = Template.solve(&Manipulator::from_legs(legs).unwrap(), &s, &FkOptions::default());
            match outside {
                None => assert!(matches!(found, Err(FkError::NotApplicable { .. })), "planar bodies"),
                Some(_) => assert!(found.unwrap().completeness.is_proved(), "{outside:?}"),
            }
        }
    }

    #[test]
    #[ignore = "evidence"]
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
        assert!(right.completeness.is_proved());
        assert_eq!(right.rejected.len(), 29, "69 candidates, 40 poses, the others with a reason");
        let shipped = TemplateLayout::shipped().unwrap();
        let problem = GenericProblem::draw(&m, &s, &mut Rng::stream(o.seed, 0));
        let good = |layout: &TemplateLayout| {
            let pairs = layout.fill(&problem).eliminate().eigenpairs().unwrap();
            let poses = pairs.iter().filter_map(|p| layout.pose(&problem, p));
            poses.filter(|pose| pose.residual(&m, &s) < 1e-4).count()
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
