use std::time::Instant;

use super::*;
use crate::{FkOptions, ForwardKinematics, Homotopy, PoseCounting};
use nalgebra::{Point3, Rotation3, Vector3};
use num::Rng;
use platform::geom::Pose;
use platform::manipulator::Leg;

fn rounded(x: f64, digits: i32) -> f64 {
    let scale = 10f64.powi(digits);
    if digits >= 16 { x } else { (x * scale).round() / scale }
}

fn platform(ends: &[[[f64; 3]; 2]; 6], digits: i32) -> Manipulator {
    let point = |p: [f64; 3]| Point3::from(p.map(|x| rounded(x, digits)));
    Manipulator::from_legs(ends.map(|[a, b]| Leg { base: point(a), platform: point(b) })).unwrap()
}

/// Symmetric hexagons on circles, joints spread by angles about 120 degrees.
fn hexapod(radii: [f64; 2], spreads: [f64; 2], digits: i32) -> Manipulator {
    let on = |r: f64, degrees: f64| [r * degrees.to_radians().cos(), r * degrees.to_radians().sin(), 0.0];
    let side = [-1.0, 1.0];
    let base = |k: usize| on(radii[0], 120.0 * (k / 2) as f64 + side[k % 2] * spreads[0] / 2.0);
    let plate = |k: usize| on(radii[1], 60.0 + 120.0 * (k / 2) as f64 + side[k % 2] * spreads[1] / 2.0);
    platform(&std::array::from_fn(|k| [base(k), plate((k + 5) % 6)]), digits)
}

/// Points of the edges of two triangles, joined as Griffis and Duffy do.
fn griffis_duffy(rng: &mut Rng, digits: i32) -> Manipulator {
    let mut triangle = || -> [[f64; 3]; 3] { std::array::from_fn(|_| std::array::from_fn(|_| rng.normal())) };
    let corners = [triangle(), triangle()];
    let edges = [[0, 0], [1, 0], [1, 1], [2, 1], [2, 2], [0, 2]];
    let shares: [f64; 6] = std::array::from_fn(|_| rng.uniform(0.1, 0.4));
    let ends = std::array::from_fn(|k| {
        std::array::from_fn(|body| {
            let [p, q] = [edges[k][body], edges[(k + 1) % 6][body]].map(|c| corners[body][c]);
            std::array::from_fn(|i| (1.0 - shares[k]) * p[i] + shares[k] * q[i])
        })
    });
    platform(&ends, digits)
}

fn lengths(m: &Manipulator, rng: &mut Rng) -> SquaredLegLengths {
    let mut turn = || rng.uniform(-0.4, 0.4);
    let rotation = Rotation3::from_euler_angles(turn(), turn(), turn());
    let position = Vector3::new(turn(), turn(), 1.5 + turn()) * m.size();
    Pose { rotation, position }.squared_lengths(m).unwrap()
}

fn usual_hexapod() -> (Manipulator, SquaredLegLengths) {
    let m = hexapod([500.0, 300.0], [20.0, 20.0], 12);
    let s = lengths(&m, &mut Rng::new(5));
    (m, s)
}

#[test]
fn a_hexapod_typed_in_digits_has_all_real_poses_and_twelve_far_ones() {
    let (m, s) = usual_hexapod();
    let found = Homotopy.solve(&m, &s, &FkOptions::default()).unwrap();
    let Completeness::ProvedBounded { proof } = found.completeness else { panic!("{found}") };
    assert_eq!((proof.poses, proof.far, proof.neighbour), (28, Some(12), None));
    assert!(
        proof.rotation > 1e6 && found.is_complete() && found.all_accounted() && found.missing().is_none()
    );
}

#[test]
fn a_list_without_one_of_its_poses_is_not_proved() {
    let (m, s) = usual_hexapod();
    let whole = Homotopy.solve(&m, &s, &FkOptions::default()).unwrap();
    let mut surroundings = Surroundings::new(&m, 1);
    for k in 0..whole.roots.len() {
        let mut less = whole.clone();
        less.completeness = Completeness::unproved([]);
        less.roots.remove(k);
        assert!(!surroundings.conclude(&mut less, &s).unwrap() && !less.is_complete());
    }
    let mut twice = whole.clone();
    twice.completeness = Completeness::unproved([]);
    twice.roots[3] = twice.roots[4].clone();
    assert!(!surroundings.conclude(&mut twice, &s).unwrap());
}

#[test]
fn designs_without_a_gap_between_near_and_far_poses_are_not_proved_so() {
    let mut rng = Rng::new(8);
    let ends = std::array::from_fn(|_| std::array::from_fn(|_| std::array::from_fn(|_| rng.normal())));
    let m = platform(&ends, 16);
    let s = lengths(&m, &mut rng);
    let mut found = Homotopy.solve(&m, &s, &FkOptions::default()).unwrap();
    found.completeness = Completeness::unproved([]);
    found.roots.pop();
    assert!(!Surroundings::new(&m, 1).conclude(&mut found, &s).unwrap());
}

/// Proportion proved and times: `FAR_DESIGNS=300 cargo test -p equipod-fk proportion -- --ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
#[allow(clippy::print_stdout)]
fn proportion_of_rounded_designs_proved() {
    let designs: u64 = std::env::var("FAR_DESIGNS").map_or(20, |n| n.parse().unwrap());
    let quick = FkOptions::default().pose_count(PoseCounting::Never);
    for class in ["hexapod", "griffis-duffy"] {
        for digits in [6, 12, 16] {
            let (mut proved, mut whole, mut time, mut search) = (0, 0, 0.0, 0.0);
            let mut words = std::collections::BTreeMap::<String, usize>::new();
            for k in 0..designs {
                let mut rng = Rng::stream(17, k);
                let m = match class {
                    "hexapod" => hexapod(
                        [1.0, rng.uniform(0.4, 0.9)],
                        [rng.uniform(10.0, 50.0), rng.uniform(10.0, 50.0)],
                        digits,
                    ),
                    _ => griffis_duffy(&mut rng, digits),
                };
                let s = lengths(&m, &mut rng);
                let start = Instant::now();
                let points = FarSearch::new(&m, 1).points().count();
                search += start.elapsed().as_secs_f64();
                let start = Instant::now();
                let found = Homotopy.solve(&m, &s, &quick).unwrap();
                time += start.elapsed().as_secs_f64();
                proved += usize::from(matches!(found.completeness, Completeness::ProvedBounded { .. }));
                whole += usize::from(found.completeness.is_proved());
                if !found.is_complete() {
                    *words
                        .entry(format!("{} near, {points} points", found.certified_count()))
                        .or_default() += 1;
                }
            }
            let each = |t: f64| 1e3 * t / designs as f64;
            println!(
                "{class}, {digits} digits: {proved} bounded, {whole} proved, of {designs}; {:.0} ms each, {:.0} ms of them search; others {words:?}",
                each(time),
                each(search)
            );
        }
    }
}
