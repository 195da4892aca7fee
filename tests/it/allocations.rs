//! Functions for control loops allocate nothing; the others allocate for their results.

use allocation_counter::measure;
use equipod::methods::bench::{Class, LengthsFrom, Problem, problem};
use equipod::methods::fk::{FkOptions, ForwardKinematics, Homotopy, NearSolver, OcticSolver};
use equipod::methods::geom::Pose;
use equipod::methods::manufacture::{Controller, displaced, joints};
use nalgebra::{Rotation3, Vector3};

/// Allocations of one 6-6 problem by the homotopy with certificates, at most.
const HOMOTOPY: u64 = 115;

fn problems(class: Class, from: LengthsFrom, count: u64) -> impl Iterator<Item = Problem> {
    (0..count).map(move |k| problem(class, from, 1, k).unwrap())
}

#[test]
fn the_octic_and_its_certificates_allocate_nothing() {
    let mut solved = 0;
    for p in problems(Class::Octahedral, LengthsFrom::Pose, 60) {
        let solver = OcticSolver::new(&p.manipulator).unwrap();
        let counted = measure(|| {
            if let Some(found) = solver.solve(&p.squares) {
                solved += 1;
                std::hint::black_box(solver.certify(&p.squares, &found));
            }
        });
        assert_eq!(counted.count_total, 0);
    }
    assert!(solved > 40, "{solved}");
}

#[test]
fn following_a_pose_allocates_nothing() {
    let (mut one, mut many) = (0, 0);
    for p in problems(Class::General, LengthsFrom::Pose, 60) {
        let (solver, start) = (NearSolver::new(&p.manipulator), p.pose.unwrap());
        for step in [1e-5, 0.05] {
            let rotation = Rotation3::new(Vector3::new(step, -step, step)) * start.rotation;
            let goal = Pose { rotation, position: start.position + Vector3::new(step, step, -step) };
            let s = goal.squared_lengths(&p.manipulator).unwrap();
            let mut segments = 0;
            let counted = measure(|| segments = solver.solve(&s, &start).evidence().segments);
            assert_eq!(counted.count_total, 0);
            one += u32::from(segments == 1);
            many += u32::from(segments > 5);
        }
    }
    assert!(one > 30 && many > 10, "{one} {many}");
}

#[test]
fn the_correction_of_a_controller_allocates_nothing() {
    let mut corrected = 0;
    for p in problems(Class::Octahedral, LengthsFrom::Pose, 40) {
        let (m, truth) = (&p.manipulator, p.pose.unwrap());
        let errors: Vec<_> = joints(m).iter().map(|_| Vector3::new(1e-5, -2e-5, 1e-5)).collect();
        let built = displaced(m, &errors).unwrap();
        let controller = Controller::new(m, m, &built).unwrap();
        let s = truth.squared_lengths(&built).unwrap();
        let mut found = None;
        let counted = measure(|| {
            found = controller.formula(&s, &truth).and_then(|pose| controller.corrected(&s, &pose, 2));
        });
        assert_eq!(counted.count_total, 0);
        let near = |pose: &Pose| (pose.position - truth.position).norm() < 1e-8;
        corrected += u32::from(found.as_ref().is_some_and(near));
    }
    assert!(corrected > 30, "{corrected}");
}

#[test]
fn the_homotopy_allocates_for_its_results_not_for_its_steps() {
    // data that is read once a process is not counted
    let first = problems(Class::General, LengthsFrom::Uniform, 1).next().unwrap();
    Homotopy.solve(&first.manipulator, &first.squares, &FkOptions::default()).unwrap();
    let mut seen = Vec::new();
    for p in problems(Class::General, LengthsFrom::Uniform, 30) {
        let mut found = None;
        let counted = measure(|| {
            found = Homotopy.solve(&p.manipulator, &p.squares, &FkOptions::default()).ok();
        });
        let paths = found.unwrap().paths;
        // a path that is ended or repaired with care has lists of its own
        if paths.iter().all(|p| p.retracked == 0 && p.winding <= 1) {
            seen.push((paths.iter().map(|p| p.steps).sum::<u32>(), counted.count_total));
        }
    }
    seen.sort_unstable();
    let (easy, hard) = (seen[0], seen[seen.len() - 1]);
    assert!(seen.len() > 15 && 5 * hard.0 > 6 * easy.0, "all take the same number of steps: {seen:?}");
    let (least, most) = seen.iter().fold((u64::MAX, 0), |r, (_, n)| (r.0.min(*n), r.1.max(*n)));
    assert!(most <= HOMOTOPY && most - least <= 10, "{seen:?}");
}

/// Negative control: the counter counts.
#[test]
fn a_list_is_counted() {
    assert_eq!(measure(|| drop(std::hint::black_box(vec![1.0]))).count_total, 1);
}
