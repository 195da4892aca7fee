//! Laws of forward kinematics, the same for every method: legs renamed, frames moved, units changed, mirror images.

use equipod::methods::fk::{FkOptions, FkSolutions, ForwardKinematics, Homotopy, Method, solver};
use equipod::methods::geom::{ComplexPose, Pose, random_rotation};
use equipod::methods::manipulator::{Leg, Manipulator, SquaredLegLengths};
use equipod::methods::num::Rng;
use nalgebra::{Matrix3, Point3, Rotation3, Vector3};
use num_complex::Complex64;

/// A design, lengths it can have, and its poses by the method under test.
struct Problem {
    manipulator: Manipulator,
    s: SquaredLegLengths,
    found: FkSolutions,
}

/// The designs that a method is tried on.
#[derive(Clone, Copy)]
enum Kind {
    Octahedral,
    General,
    PlanarBase,
}

fn design(kind: Kind, rng: &mut Rng) -> Manipulator {
    let mut joints = |n: usize, size: f64, planar: bool| -> Vec<Point3<f64>> {
        let z = if planar { 0.0 } else { size };
        (0..n).map(|_| Point3::new(size * rng.normal(), size * rng.normal(), z * rng.normal())).collect()
    };
    let six = std::array::from_fn(|i| (i, i));
    let hexagon = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    match kind {
        Kind::Octahedral => Manipulator::try_new(joints(3, 2.0, false), joints(3, 1.0, false), hexagon),
        Kind::General => Manipulator::try_new(joints(6, 2.0, false), joints(6, 1.0, false), six),
        Kind::PlanarBase => Manipulator::try_new(joints(6, 2.0, true), joints(6, 1.0, false), six),
    }
    .unwrap()
}

fn problem(method: &dyn ForwardKinematics, kind: Kind, seed: u64) -> Problem {
    let mut rng = Rng::stream(seed, 7);
    let manipulator = design(kind, &mut rng);
    let position = Vector3::new(rng.normal(), rng.normal(), 2.0 + rng.normal());
    let pose = Pose { rotation: random_rotation(&mut rng), position };
    let s = pose.squared_lengths(&manipulator).unwrap();
    let found = solved(method, &manipulator, &s);
    let truth = ComplexPose::from(pose);
    assert!(gap(&[truth], &found, manipulator.size()) < 1e-8, "the pose the lengths come from is found");
    Problem { manipulator, s, found }
}

fn solved(method: &dyn ForwardKinematics, m: &Manipulator, s: &SquaredLegLengths) -> FkSolutions {
    let found = method.solve(m, s, &FkOptions::default()).unwrap();
    assert!(found.all_accounted(), "{:?}", found.completeness);
    found
}

/// The largest distance of an expected pose from the nearest found one, relative to the pose's own numbers.
fn gap(expected: &[ComplexPose], found: &FkSolutions, size: f64) -> f64 {
    let scale = |p: &ComplexPose| {
        let r = p.rotation.iter().map(|z| z.norm()).fold(1.0, f64::max);
        p.position.iter().map(|z| z.norm() / size).fold(r, f64::max)
    };
    let nearest = |p: &ComplexPose| {
        found.roots.iter().map(|q| q.pose.distance(p, size)).fold(f64::INFINITY, f64::min) / scale(p)
    };
    expected.iter().map(nearest).fold(0.0, f64::max)
}

/// The law: the problem after `change` has exactly the poses `map` makes of the old ones.
fn poses_follow(
    method: &dyn ForwardKinematics,
    old: &Problem,
    new: (&Manipulator, &SquaredLegLengths),
    map: &dyn Fn(&ComplexPose) -> ComplexPose,
) -> Result<(), String> {
    let (m, s) = new;
    let found = solved(method, m, s);
    let expected: Vec<ComplexPose> = old.found.roots.iter().map(|r| map(&r.pose)).collect();
    if found.roots.len() != expected.len() {
        return Err(format!("{} poses instead of {}", found.roots.len(), expected.len()));
    }
    let real = (old.found.assembly_modes().count(), found.assembly_modes().count());
    if real.0 != real.1 {
        return Err(format!("{} real poses instead of {}", real.1, real.0));
    }
    let gap = gap(&expected, &found, m.size());
    if gap < 1e-7 { Ok(()) } else { Err(format!("a pose is off by {gap:e}")) }
}

fn complex(m: &Matrix3<f64>) -> Matrix3<Complex64> {
    m.map(Complex64::from)
}

fn legs_in_another_order(method: &dyn ForwardKinematics, p: &Problem, _: &mut Rng) -> Result<(), String> {
    let order = [3, 5, 0, 2, 4, 1];
    let m = p.manipulator.reordered(order).unwrap();
    let s = SquaredLegLengths::try_new(order.map(|i| p.s.get()[i])).unwrap();
    poses_follow(method, p, (&m, &s), &|pose| *pose)
}

/// `a -> U a + u`, `b -> V b + v` gives `R' = U R V^T`, `p' = U p + u - R' v`.
fn both_frames_moved(method: &dyn ForwardKinematics, p: &Problem, rng: &mut Rng) -> Result<(), String> {
    let size = p.manipulator.size();
    let (turn, twist): (Rotation3<f64>, Rotation3<f64>) = (random_rotation(rng), random_rotation(rng));
    let u = Vector3::from_fn(|_, _| size * rng.normal());
    let v = Vector3::from_fn(|_, _| size * rng.normal());
    let legs = p.manipulator.legs();
    let legs = legs.map(|l| Leg { base: turn * l.base + u, platform: twist * l.platform + v });
    let m = moved(&p.manipulator, &legs);
    poses_follow(method, p, (&m, &p.s), &|pose| {
        let rotation = complex(turn.matrix()) * pose.rotation * complex(twist.inverse().matrix());
        let position = complex(turn.matrix()) * pose.position + u.map(Complex64::from)
            - rotation * v.map(Complex64::from);
        ComplexPose { rotation, position }
    })
}

fn another_unit(method: &dyn ForwardKinematics, p: &Problem, _: &mut Rng) -> Result<(), String> {
    for k in [1e-6, 1e-3, 1e6] {
        let legs = p.manipulator.legs().map(|l| Leg { base: l.base * k, platform: l.platform * k });
        let s = SquaredLegLengths::try_new(p.s.get().map(|s| s * k * k)).unwrap();
        poses_follow(method, p, (&moved(&p.manipulator, &legs), &s), &|pose| ComplexPose {
            position: pose.position * Complex64::from(k),
            ..*pose
        })?;
    }
    Ok(())
}

/// Both bodies reflected (`S = diag(1, 1, -1)`): the poses are `S R S`, `S p`.
fn reflected(method: &dyn ForwardKinematics, p: &Problem, _: &mut Rng) -> Result<(), String> {
    let mirror = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, -1.0));
    let image = |x: Point3<f64>| Point3::from(mirror * x.coords);
    let legs = p.manipulator.legs().map(|l| Leg { base: image(l.base), platform: image(l.platform) });
    let s = complex(&mirror);
    poses_follow(method, p, (&moved(&p.manipulator, &legs), &p.s), &|pose| ComplexPose {
        rotation: s * pose.rotation * s,
        position: s * pose.position,
    })
}

/// The same joints and pairs with other coordinates.
fn moved(m: &Manipulator, legs: &[Leg; 6]) -> Manipulator {
    let (mut base, mut platform) = (m.base_joints().to_vec(), m.platform_joints().to_vec());
    for ((i, j), leg) in m.pairs().into_iter().zip(legs) {
        base[i] = leg.base;
        platform[j] = leg.platform;
    }
    Manipulator::try_new(base, platform, m.pairs()).unwrap()
}

type Law = fn(&dyn ForwardKinematics, &Problem, &mut Rng) -> Result<(), String>;

const LAWS: [(&str, Law); 4] = [
    ("legs in another order", legs_in_another_order),
    ("both frames moved", both_frames_moved),
    ("another unit", another_unit),
    ("reflected", reflected),
];

fn laws_hold(method: &dyn ForwardKinematics, kinds: &[Kind]) {
    for (k, &kind) in kinds.iter().enumerate() {
        for seed in 0..3 {
            let p = problem(method, kind, seed);
            for (name, law) in LAWS {
                let mut rng = Rng::stream(seed, 99);
                law(method, &p, &mut rng).unwrap_or_else(|e| panic!("{name}, kind {k}, seed {seed}: {e}"));
            }
        }
    }
}

#[test]
fn the_automatic_choice_obeys_the_laws() {
    laws_hold(&*solver(None), &[Kind::Octahedral, Kind::General]);
}

#[test]
fn the_homotopy_obeys_the_laws() {
    laws_hold(&Homotopy, &[Kind::Octahedral, Kind::General, Kind::PlanarBase]);
}

#[test]
fn the_eliminations_obey_the_laws() {
    for method in [Method::Template, Method::Sylvester] {
        laws_hold(&*solver(Some(method)), &[Kind::General]);
    }
}

#[test]
fn the_octic_obeys_the_laws() {
    laws_hold(&*solver(Some(Method::Octic)), &[Kind::Octahedral]);
}

/// `S = diag(1, 1, -1)` leaves both planar bodies as they are, so with `(R, p)` the pose `(S R S, S p)` has the same
/// lengths.
#[test]
fn planar_bodies_have_their_poses_in_mirror_pairs() {
    for seed in 0..3 {
        let mut rng = Rng::stream(seed, 3);
        let mut ring =
            |r: f64| (0..6).map(|_| Point3::new(r * rng.normal(), r * rng.normal(), 0.0)).collect::<Vec<_>>();
        let (base, platform) = (ring(2.0), ring(1.0));
        let m = Manipulator::try_new(base, platform, std::array::from_fn(|i| (i, i))).unwrap();
        let pose = Pose { rotation: random_rotation(&mut rng), position: Vector3::new(0.3, -0.2, 2.0) };
        let found = solved(&Homotopy, &m, &pose.squared_lengths(&m).unwrap());
        let s = complex(&Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, -1.0)));
        let partners: Vec<ComplexPose> = found
            .roots
            .iter()
            .map(|r| ComplexPose { rotation: s * r.pose.rotation * s, position: s * r.pose.position })
            .collect();
        assert!(gap(&partners, &found, m.size()) < 1e-7);
        assert_eq!(found.roots.len() % 2, 0);
    }
}

/// A method that drops a pose, and one whose poses depend on the order of the legs, must not pass.
#[test]
fn methods_that_break_a_law_are_found() {
    struct Forgetful;
    impl ForwardKinematics for Forgetful {
        fn method(&self) -> Method {
            Method::Homotopy
        }
        fn solve(
            &self,
            m: &Manipulator,
            s: &SquaredLegLengths,
            o: &FkOptions,
        ) -> Result<FkSolutions, equipod::methods::fk::FkError> {
            let mut found = Homotopy.solve(m, s, o)?;
            if m.legs()[0].base.z > 0.0 {
                found.roots.pop();
            } else {
                found.roots[0].pose.position.x += m.size() * 1e-5;
            }
            Ok(found)
        }
    }
    let mut rejected = 0;
    for seed in 0..3 {
        // solved by the honest method, then compared with the dishonest one
        let p = problem(&Homotopy, Kind::General, seed);
        for (_, law) in LAWS {
            rejected += usize::from(law(&Forgetful, &p, &mut Rng::new(seed)).is_err());
        }
    }
    assert_eq!(rejected, 12);
}
