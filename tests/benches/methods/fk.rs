//! The times that the figures of `docs/benchmarks.md` are compared by, with two eigenvalue problems as units.
//!
//! Run with `cargo bench --package equipod-benches --features divan --bench fk`.

use divan::Bencher;
use equipod::methods::bench::{Class, LengthsFrom, Problem, problem};
use equipod::methods::fk::{FkOptions, ForwardKinematics, Homotopy, Octic};
use equipod::methods::geom::{Angles, Pose};
use equipod::methods::num::Rng;
use equipod::methods::num::dense::{eigenvalues, generalized_eigenpairs};
use equipod::methods::solve::certify::Certifier;
use nalgebra::Matrix4;

fn main() {
    divan::main();
}

/// Different problems in turn, so that no one lucky path is measured.
const PROBLEMS: u64 = 16;

fn problems(class: Class) -> Vec<Problem> {
    let lengths = if class.allows_uniform_lengths() { LengthsFrom::Uniform } else { LengthsFrom::Pose };
    (0..PROBLEMS).filter_map(|k| problem(class, lengths, 1, k).ok()).collect()
}

fn solving(bencher: Bencher, class: Class, method: &dyn ForwardKinematics) {
    let problems = problems(class);
    let mut next = problems.iter().cycle();
    bencher
        .bench_local(|| next.next().map(|p| method.solve(&p.manipulator, &p.squares, &FkOptions::default())));
}

#[divan::bench]
fn general_6_6(bencher: Bencher) {
    solving(bencher, Class::General, &Homotopy);
}

#[divan::bench]
fn doubly_planar(bencher: Bencher) {
    solving(bencher, Class::BothPlanar, &Homotopy);
}

#[divan::bench]
fn octahedral_by_octic(bencher: Bencher) {
    solving(bencher, Class::Octahedral, &Octic);
}

#[divan::bench]
fn griffis_duffy_by_homotopy(bencher: Bencher) {
    solving(bencher, Class::GriffisDuffy, &Homotopy);
}

#[divan::bench]
fn certify_40_roots(bencher: Bencher) {
    let all = problems(Class::General);
    let solved: Vec<_> = all
        .iter()
        .filter_map(|p| {
            let found = Homotopy.solve(&p.manipulator, &p.squares, &FkOptions::default()).ok()?;
            let certifier = Certifier::new(&p.manipulator, &p.squares).ok()?;
            (found.roots.len() == 40).then_some((certifier, found.roots))
        })
        .collect();
    let mut next = solved.iter().cycle();
    bencher.bench_local(|| {
        next.next().map(|(certifier, roots)| {
            roots.iter().filter(|r| certifier.certify(&r.pose).certificate().is_some()).count()
        })
    });
}

/// The yardstick of the batches of `ik` from Python: leg lengths of 1,000 matrices, each checked.
#[divan::bench]
fn lengths_of_1000_matrices(bencher: Bencher) {
    let all = problems(Class::Octahedral);
    let legs = all[0].manipulator.legs();
    let mut rng = Rng::new(1);
    let matrices: Vec<Matrix4<f64>> = (0..1000)
        .map(|_| {
            let angles = std::array::from_fn(|_| 0.2 * rng.normal());
            Pose::new([rng.normal(), rng.normal(), 3.0 + rng.normal()], Angles::from_radians(angles)).matrix()
        })
        .collect();
    bencher.bench_local(|| {
        matrices
            .iter()
            .filter_map(|m| Pose::try_from(*m).ok()?.lengths_of(&legs))
            .map(|lengths| lengths.get())
            .collect::<Vec<_>>()
    });
}

fn random_matrix(n: usize, rng: &mut Rng) -> Vec<Vec<f64>> {
    (0..n).map(|_| (0..n).map(|_| rng.normal()).collect()).collect()
}

#[divan::bench]
fn reference_qz_69(bencher: Bencher) {
    let mut rng = Rng::new(69);
    let (a, b) = (random_matrix(69, &mut rng), random_matrix(69, &mut rng));
    bencher.bench_local(|| generalized_eigenpairs(&a, &b));
}

#[divan::bench]
fn reference_eigenvalues_40(bencher: Bencher) {
    let a = random_matrix(40, &mut Rng::new(40));
    bencher.bench_local(|| eigenvalues(&a));
}
