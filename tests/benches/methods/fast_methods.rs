//! Medians of the two methods made for control loops. Run with `cargo bench --package equipod-benches --bench
//! fast_methods`.
//!
//! Each problem is solved in batches. A batch's mean is one sample, and the best of its samples is the problem's time.
//! The median over the problems is printed. One thread.

use std::hint::black_box;
use std::time::Instant;

use equipod::methods::bench::{Class, LengthsFrom, problem};
use equipod::methods::distance::{Evaluator, plans};
use equipod::methods::fk::{FkOptions, ForwardKinematics, NearSolver, Octic, OcticSolver, Trilateration};
use equipod::methods::geom::{ComplexPose, Pose, random_rotation};
use equipod::methods::manipulator::{Leg, Manipulator, Octahedral, default_home};
use equipod::methods::manufacture::{Controller, displaced, joints};
use equipod::methods::num::Rng;
use equipod::methods::solve::certify::Certifier;
use equipod::methods::synthesis::joint_free;
use nalgebra::{Point3, Rotation3, Vector3};
use num_complex::Complex64;

const PROBLEMS: u64 = 300;
const SAMPLES: u32 = 15;

fn nanoseconds(runs: u32, mut work: impl FnMut()) -> f64 {
    let sample = |_| {
        let start = Instant::now();
        (0..runs).for_each(|_| work());
        start.elapsed().as_nanos() as f64 / f64::from(runs)
    };
    (0..SAMPLES).map(sample).fold(f64::MAX, f64::min)
}

#[allow(clippy::print_stdout, reason = "a table for people")]
fn report(what: &str, mut times: Vec<f64>) {
    times.sort_by(f64::total_cmp);
    let at = |q: usize| times[(times.len() * q / 100).min(times.len() - 1)];
    println!("{what:<58} {:>8.0} ns   90 %: {:>8.0} ns   n = {}", at(50), at(90), times.len());
}

fn octahedral(k: u64) -> Result<(Manipulator, Pose), Box<dyn std::error::Error>> {
    let mut rng = Rng::stream(21, k);
    let mut triangle =
        || (0..3).map(|_| Point3::from(Vector3::from_fn(|_, _| rng.uniform(-1.0, 1.0)))).collect();
    let legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    let m = Manipulator::try_new(triangle(), triangle(), legs)?;
    let position = Vector3::from_fn(|_, _| rng.normal());
    Ok((m, Pose { rotation: random_rotation(&mut rng), position }))
}

/// Trilateration of each topology that needs at most one virtual leg, for a prepared design.
fn trilateration() -> Result<(), Box<dyn std::error::Error>> {
    let method = Trilateration::default();
    for class in Class::topologies() {
        let [mut bare, mut checked, mut certified] = [const { Vec::new() }; 3];
        for k in 0..PROBLEMS / 10 {
            let p = problem(class, LengthsFrom::Pose, 4, k)?;
            let Some(prepared) = method.prepare(&p.manipulator, &FkOptions::default()) else { continue };
            let list = plans(&p.manipulator, 1)?;
            let evaluator = list.iter().find_map(|s| {
                let e = Evaluator::new(&p.manipulator, s, &[], s.closures.first().copied())?;
                e.shape().is_simple().then_some(e)
            });
            let evaluator = evaluator.ok_or("no sequence")?;
            let squares = p.squares.get().map(Complex64::from);
            bare.push(nanoseconds(10, || {
                black_box(evaluator.configurations(black_box(&squares), 1.0));
            }));
            checked.push(nanoseconds(10, || {
                let found = evaluator.configurations(black_box(&squares), 1.0).found;
                black_box(
                    found.iter().map(|c| c.pose.residual(&p.manipulator, &p.squares)).fold(0.0, f64::max),
                );
            }));
            certified.push(nanoseconds(10, || {
                let _ = black_box(prepared.solve(black_box(&p.squares), &FkOptions::default()));
            }));
        }
        if !bare.is_empty() {
            let name = class.name();
            report(&format!("{name}: trilateration, all poses"), bare);
            report(&format!("{name}: with the residuals of all six legs"), checked);
            report(&format!("{name}: refined, certified, with records"), certified);
        }
    }
    Ok(())
}

/// The pose by the octahedral formula of a joint-free machine, and Newton steps on its calibrated joints.
fn correction() -> Result<(), Box<dyn std::error::Error>> {
    let [mut formula, mut one, mut two] = [const { Vec::new() }; 3];
    for k in 0..PROBLEMS {
        let (o, truth) = octahedral(k)?;
        let (m, _) = joint_free(&Octahedral::recognise(&o)?, [-0.2, 0.3, -0.2, 1.2, 0.2, -0.3])?;
        let mut rng = Rng::stream(23, k);
        let errors: Vec<_> =
            joints(&m).iter().map(|_| Vector3::from_fn(|_, _| 1e-4 * rng.normal())).collect();
        let built = displaced(&m, &errors)?;
        let controller = Controller::new(&o, &m, &built)?;
        let s = truth.squared_lengths(&built).ok_or("overflow")?;
        let Some(pose) = controller.formula(&s, &truth) else { continue };
        formula.push(nanoseconds(20, || {
            black_box(controller.formula(black_box(&s), &truth));
        }));
        for (times, steps) in [(&mut one, 1), (&mut two, 2)] {
            times.push(nanoseconds(50, || {
                black_box(controller.corrected(black_box(&s), &pose, steps));
            }));
        }
    }
    report("controller: octahedral formula, pose nearest to the last", formula);
    report("controller: one Newton step on the calibrated joints", one);
    report("controller: two Newton steps", two);
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    correction()?;
    trilateration()?;
    let [mut prepared, mut fast, mut pairs, mut certificates, mut whole] = [const { Vec::new() }; 5];
    let mut complete = 0;
    for k in 0..PROBLEMS {
        let (m, pose) = octahedral(k)?;
        let s = pose.squared_lengths(&m).ok_or("overflow")?;
        let solver = OcticSolver::new(&m)?;
        prepared.push(nanoseconds(20, || {
            let _ = black_box(OcticSolver::new(black_box(&m)));
        }));
        if let Some(found) = solver.solve(&s) {
            fast.push(nanoseconds(20, || {
                black_box(solver.solve(black_box(&s)));
            }));
            complete += usize::from(solver.certify(&s, &found).complete);
            pairs.push(nanoseconds(20, || {
                black_box(solver.certify(black_box(&s), black_box(&found)));
            }));
            let certifier = Certifier::new(&m, &s).map_err(|e| e.to_string())?;
            certificates.push(nanoseconds(5, || {
                for p in &found.poses {
                    black_box(certifier.certify(black_box(p)));
                }
            }));
        }
        whole.push(nanoseconds(2, || {
            let _ = black_box(Octic.solve(&m, black_box(&s), &FkOptions::default()));
        }));
    }
    report("octic, preparation of a design (OcticSolver::new)", prepared);
    report("octic, 16 poses (OcticSolver::solve)", fast);
    report(&format!("certificates of 8 pairs ({complete} sets complete)"), pairs);
    report("general certificates of these 16 poses", certificates);
    report("octic with records and certificates (Octic)", whole);

    for step in [1e-5, 1e-4, 1e-3, 1e-2] {
        let (mut times, mut segments, mut certified) = (Vec::new(), 0.0, Vec::new());
        for k in 0..PROBLEMS {
            let mut rng = Rng::stream(22, k);
            let mut point = |r: f64| Point3::new(r * rng.normal(), r * rng.normal(), 0.3 * rng.normal());
            let legs = std::array::from_fn(|_| Leg { base: point(2.0), platform: point(1.0) });
            let m = Manipulator::from_legs(legs)?;
            let home = default_home(&m);
            let turn = Vector3::from_fn(|_, _| step * rng.normal());
            let position = home.position + Vector3::from_fn(|_, _| step * rng.normal());
            let goal = Pose { rotation: Rotation3::new(turn) * home.rotation, position };
            let s = goal.squared_lengths(&m).ok_or("overflow")?;
            let solver = NearSolver::new(&m);
            let outcome = solver.solve(&s, &home);
            let Some(found) = outcome.tracked() else { continue };
            segments += f64::from(outcome.evidence().segments);
            times.push(nanoseconds(50, || {
                black_box(solver.solve(black_box(&s), &home));
            }));
            let found = ComplexPose::from(*found);
            certified.push(nanoseconds(20, || {
                let certifier = Certifier::new(&m, black_box(&s));
                let _ = black_box(certifier.map(|c| c.certify(&found)));
            }));
        }
        let mean = segments / times.len() as f64;
        report(&format!("near, move of {step:e}, {mean:.2} segments in the mean"), times);
        if step < 2e-5 {
            report("certificate of the tracked pose", certified);
        }
    }
    Ok(())
}
