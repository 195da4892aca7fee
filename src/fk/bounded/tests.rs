use super::*;
use crate::solve::certify::far::{C, D, PATCH};
use crate::{FkOptions, ForwardKinematics, Homotopy, Reality};
use nalgebra::{Matrix3, Point3, Rotation3, Vector3};
use num::Rng;
use num_complex::Complex64;
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

/// Whether one of both proofs succeeds.
fn concludes(m: &Manipulator, found: &mut FkSolutions, s: &SquaredLegLengths) -> bool {
    Surroundings::new(m, 1).conclude(found, s, PoseCounting::Never).unwrap()
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
    let Completeness::ProvedBounded { proof } = &found.completeness else { panic!("{found}") };
    assert_eq!((proof.poses, proof.far, proof.neighbour), (28, Some(12), None));
    assert!(
        proof.rotation.unwrap() > 1e6
            && found.is_complete()
            && found.all_accounted()
            && found.missing().is_none()
    );
}

#[test]
fn a_list_without_one_of_its_poses_is_not_proved() {
    let (m, s) = usual_hexapod();
    let whole = Homotopy.solve(&m, &s, &FkOptions::default()).unwrap();
    for k in 0..whole.roots.len() {
        let mut less = whole.clone();
        less.completeness = Completeness::unproved([]);
        less.roots.remove(k);
        assert!(!concludes(&m, &mut less, &s) && !less.is_complete());
    }
    let mut twice = whole.clone();
    twice.completeness = Completeness::unproved([]);
    twice.roots[3] = twice.roots[4].clone();
    assert!(!concludes(&m, &mut twice, &s));
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
    assert!(!concludes(&m, &mut found, &s));
}

#[test]
fn far_poses_that_are_listed_as_well_are_counted_once() {
    // with three digits some far poses are near enough to be certified as others are
    let mut counted = 0;
    for spread in [14.0, 17.0, 23.0, 31.0] {
        let m = hexapod([1.0, 0.6], [20.0, spread], 3);
        let s = lengths(&m, &mut Rng::new(5));
        let mut found = Homotopy.solve(&m, &s, &FkOptions::default()).unwrap();
        let listed = found.certified_count();
        found.completeness = Completeness::unproved([]);
        let search = &mut FarSearch::new(&m, 1);
        if conclude_far(&mut found, &m, &s, search.points()).unwrap() {
            let Completeness::ProvedBounded { proof } = &found.completeness else { panic!("{found}") };
            assert_eq!(proof.poses + proof.far.unwrap(), 40);
            counted += usize::from(listed > proof.poses);
        }
    }
    assert!(counted > 0, "no list has far poses");
}

/// The coordinates of `certify::far` at a listed pose.
fn far_point(root: &FkRoot, unit: f64) -> FarPoint {
    let x = root.dual_quaternion.unwrap();
    let patch: Complex64 = (0..4).map(|k| x[k] * PATCH[k]).sum();
    let e: [Complex64; 4] = std::array::from_fn(|k| x[k] / patch);
    let h: Complex64 = e.iter().map(|z| z * z).sum();
    let [c, d] = [C, D].map(|v| Vector3::from(v).map(Complex64::from));
    let turned = root.pose.rotation * c;
    let frame = Matrix3::from_columns(&[turned, d, turned.cross(&d)]);
    let shares = frame.try_inverse().unwrap() * root.pose.position / Complex64::from(unit);
    let gamma = shares[2];
    [e[0], e[1], e[2], e[3], shares[0], shares[1], gamma, gamma * gamma / h]
}

#[test]
fn a_search_that_finds_listed_poses_hides_no_others() {
    let (m, s) = usual_hexapod();
    let mut found = Homotopy.solve(&m, &s, &FkOptions::default()).unwrap();
    let unit = 2f64.powi(m.size().log2().floor() as i32);
    let system = FarSystem::new(&m, &SquareData::from(&s)).unwrap();
    let strays: Vec<FarPoint> = found
        .roots
        .iter()
        .map(|root| far_point(root, unit))
        .filter(|point| system.roots_near(point).iter().any(|far| far.rotation < 1e3))
        .collect();
    assert!(!strays.is_empty(), "no listed pose is a far one too");
    found.completeness = Completeness::unproved([]);
    let search = &mut FarSearch::new(&m, 1);
    assert!(conclude_far(&mut found, &m, &s, strays.into_iter().chain(search.points())).unwrap());
    let Completeness::ProvedBounded { proof } = &found.completeness else { panic!("{found}") };
    assert_eq!((proof.poses, proof.far, proof.others.len()), (28, Some(12), 12));
}

#[test]
fn pairs_of_far_poses_are_proved_together() {
    for digits in [16, 8] {
        let m = griffis_duffy(&mut Rng::new(3), digits);
        let s = lengths(&m, &mut Rng::new(4));
        let found = Homotopy.solve(&m, &s, &FkOptions::default()).unwrap();
        let Completeness::ProvedBounded { proof } = &found.completeness else { panic!("{digits}: {found}") };
        assert_eq!((proof.poses, proof.far), (16, Some(24)));
        let (pairs, first) = (proof.others.iter().filter(|o| o.poses == 2).count(), &proof.others[0]);
        assert!(pairs == 12 || digits < 16, "{pairs} pairs");
        assert!(
            Some(first.rotation) == proof.rotation
                && proof.others.is_sorted_by(|x, y| x.rotation <= y.rotation)
        );
        let reach = proof.rotation.unwrap();
        let mut controls = 0;
        for k in (0..found.roots.len()).step_by(if digits == 16 { 1 } else { 5 }) {
            let mut less = found.clone();
            less.completeness = Completeness::unproved([]);
            // one that is listed and far is found again as a far one
            let is_near = size(&less.roots.remove(k)).unwrap().0 < reach;
            assert_eq!(concludes(&m, &mut less, &s), !is_near, "pose {k}");
            if is_near {
                let said = less.completeness.to_string();
                assert!(said.contains("15 near and 24 far poses are certified"), "{said}");
                controls += 1;
            }
        }
        assert!(controls == 16 || digits < 16, "{controls} controls");
    }
}

/// Planar bodies whose joints are affine images of each other, rounded; not in coordinate planes.
fn affine_hexagons(rng: &mut Rng, digits: i32) -> Manipulator {
    let plane: [[f64; 3]; 6] = std::array::from_fn(|_| std::array::from_fn(|_| rng.normal()));
    let ends = std::array::from_fn(|_| {
        let (x, y) = (rng.normal(), rng.normal());
        let at = |first: usize| {
            std::array::from_fn(|k| plane[first][k] + x * plane[first + 1][k] + y * plane[first + 2][k])
        };
        [at(0), at(3)]
    });
    platform(&ends, digits)
}

#[test]
fn rounded_affine_hexagons_have_all_real_poses_next_to_those_of_their_neighbour() {
    for digits in [16, 9] {
        let m = affine_hexagons(&mut Rng::new(6), digits);
        let s = lengths(&m, &mut Rng::new(7));
        let mut found = Homotopy.solve(&m, &s, &FkOptions::default()).unwrap();
        let proves = |found: &mut FkSolutions| {
            found.completeness = Completeness::unproved([]);
            concludes(&m, found, &s)
        };
        // all 40 need no proof: the farthest is left out
        found.roots.sort_by(|a, b| size(a).unwrap().0.total_cmp(&size(b).unwrap().0));
        found.roots.truncate(39);
        assert!(proves(&mut found), "{digits}: {found}");
        // the 24 far poses may be listed as well: the proof needs the 16 near ones, and each of them
        for k in (0..found.roots.len()).rev() {
            let mut less = found.clone();
            less.roots.remove(k);
            if proves(&mut less) {
                found.roots.remove(k);
            }
        }
        assert_eq!(found.roots.len(), 16);
        for k in 0..found.roots.len() {
            let mut less = found.clone();
            less.roots.remove(k);
            assert!(!proves(&mut less), "without pose {k}");
        }
        assert!(proves(&mut found));
        let Completeness::ProvedBounded { proof } = &found.completeness else { panic!("{digits}: {found}") };
        assert_eq!((proof.poses, proof.far, proof.rotation), (16, None, None));
        assert!(proof.neighbour.unwrap() < 10f64.powi(1 - digits.min(14)) && found.is_complete());
        let mut twice = found.clone();
        twice.roots[3] = twice.roots[4].clone();
        assert!(!proves(&mut twice));
    }
}

#[test]
fn prepared_affine_hexagons_follow_only_the_poses_next_to_those_of_their_neighbour() {
    let mut rng = Rng::new(9);
    let ends = std::array::from_fn(|_| {
        let (x, y) = (rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0));
        [[x, y, 0.0], [0.6 * x + 0.2 * y, 0.7 * y - 0.1 * x, 0.0]]
    });
    let m = platform(&ends, 12);
    let options = FkOptions::default();
    let prepared = Homotopy.prepare(&m, &options).unwrap();
    let mut followed = 0;
    for _ in 0..8 {
        let s = lengths(&m, &mut rng);
        let (found, fresh) =
            (prepared.solve(&s, &options).unwrap(), Homotopy.solve(&m, &s, &options).unwrap());
        assert!(found.is_complete(), "{found}");
        let real = |f: &FkSolutions| f.roots.iter().filter(|r| r.reality == Reality::Real).count();
        assert_eq!(real(&found), real(&fresh));
        // each path stands for its mirror image as well
        if found.paths.len() < 20 {
            let Completeness::ProvedBounded { proof } = &found.completeness else { panic!("{found}") };
            assert_eq!((found.paths.len(), found.roots.len(), proof.poses), (8, 16, 16));
            assert!(proof.neighbour.is_some());
            followed += 1;
        }
    }
    assert!(followed >= 6, "{followed} of 8");
}

/// Times on this machine: `cargo test -p equipod-fk --features lab,serde --lib bounded -- --ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
#[allow(clippy::print_stdout)]
fn times_of_rounded_designs() {
    let mut rng = Rng::new(3);
    let designs = [
        ("hexapod", hexapod([500.0, 300.0], [20.0, 30.0], 12)),
        ("griffis-duffy", griffis_duffy(&mut rng, 16)),
        ("affine", affine_hexagons(&mut rng, 12)),
    ];
    let options = FkOptions::default();
    let time = |f: &mut dyn FnMut()| {
        let once = |f: &mut dyn FnMut()| {
            let start = std::time::Instant::now();
            f();
            start.elapsed().as_secs_f64() * 1e3
        };
        (0..5).map(|_| once(f)).fold(f64::INFINITY, f64::min)
    };
    for (name, m) in designs {
        let rows: Vec<SquaredLegLengths> = (0..20).map(|_| lengths(&m, &mut rng)).collect();
        let fresh = time(&mut || drop(Homotopy.solve(&m, &rows[0], &options).unwrap()));
        let far = time(&mut || {
            let mut found = Homotopy.solve(&m, &rows[0], &options).unwrap();
            found.completeness = Completeness::unproved([]);
            let start = std::time::Instant::now();
            assert!(concludes(&m, &mut found, &rows[0]));
            println!("  proof alone {:.1} ms", start.elapsed().as_secs_f64() * 1e3);
        });
        let prepared = Homotopy.prepare(&m, &options).unwrap();
        let mut proved = 0;
        let all = time(&mut || {
            let is_proved = |s: &&SquaredLegLengths| prepared.solve(s, &options).unwrap().is_complete();
            proved = rows.iter().filter(is_proved).count();
        });
        println!(
            "{name}: fresh {fresh:.1} ms ({far:.1}), further {:.2} ms, {proved} of 20 proved",
            all / 20.0
        );
    }
}
