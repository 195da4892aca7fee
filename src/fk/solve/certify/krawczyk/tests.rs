use super::super::refine::refine_study;
use super::*;
use crate::solve::certify::coordinates::study_of;
use nalgebra::{Point3, Vector3};
use num::Rng;
use platform::geom::{ComplexPose, Pose, random_rotation};
use platform::manipulator::{Leg, Manipulator};

/// A system with a real root, and the root.
fn random_problem(rng: &mut Rng) -> (LegSystem, Study<f64>) {
    let mut point = || Point3::new(rng.normal(), rng.normal(), rng.normal());
    let legs = std::array::from_fn(|_| Leg { base: point(), platform: point() });
    let m = Manipulator::from_legs(legs).unwrap();
    let pose = Pose { position: Vector3::from_fn(|_, _| rng.normal()), rotation: random_rotation(rng) };
    let system = LegSystem::new(&m, &(&pose.squared_lengths(&m).unwrap()).into()).unwrap();
    let x = study_of(&ComplexPose::from(pose), system.unit()).unwrap();
    (system, x)
}

fn distance(a: &Study<DoubleDouble>, b: &Study<f64>) -> f64 {
    let gap = |k: usize| (a.re[k] - b.re[k].into()).hi().hypot((a.im[k] - b.im[k].into()).hi());
    (0..8).map(gap).fold(0.0, f64::max)
}

#[test]
fn whatever_ball_contracts_holds_a_root_even_far_from_the_centre() {
    // no limit on the accuracy of the centre here: the proof alone must be right
    let mut rng = Rng::new(91);
    let (mut proved, mut refused) = (0, 0);
    for k in 0..600 {
        let (system, root) = random_problem(&mut rng);
        let size = 10f64.powi(-(k % 8));
        let mut x = root;
        for j in (0..8).filter(|j| *j != root.patch) {
            x.re[j] += size * rng.normal();
            x.im[j] += size * rng.normal();
        }
        let centre = Centre { hi: &x, full: None };
        match bounds(&system, &centre).and_then(|b| holds_one_root(&b, f64::INFINITY)) {
            Ok(c) => {
                proved += 1;
                let end = refine_study(&system, &x, f64::INFINITY).unwrap();
                let d = distance(&end.x, &x);
                assert!(d <= c.radius, "root at {d:e}, proved within {:e}", c.radius);
                assert!(d > c.radius * 1e-3, "the radius is no idle bound: {d:e} {:e}", c.radius);
                let known = distance(&root.lifted(), &x);
                let same = distance(&end.x, &root) < 1e-9;
                assert!(
                    same || known > c.uniqueness_radius * (1.0 - 1e-9),
                    "two roots in the uniqueness ball"
                );
            }
            Err(_) => refused += 1,
        }
    }
    assert!(proved > 200 && refused > 100, "{proved} {refused}");
}

#[test]
fn radii_solve_the_quadratic_inequality_and_nan_proves_nothing() {
    let b = |eta, kappa, beta| {
        radii(&KrawczykBounds { eta_centre: eta, eta, kappa, beta, step: [Complex64::ZERO; 8] })
    };
    let c = b(1e-3, 0.1, 10.0).unwrap();
    assert!(1e-3 + 0.1 * c.radius + 10.0 * c.radius * c.radius <= c.radius);
    assert!(c.lipschitz < 1.0 && 0.1 + 10.0 * (c.radius + c.uniqueness_radius) < 1.0);
    assert!(b(0.0203, 0.1, 10.0).is_err(), "beyond (1 - kappa)^2 / (4 beta)");
    assert!(b(1e-3, 1.0, 10.0).is_err());
    for bad in [f64::NAN, f64::INFINITY] {
        assert!(b(bad, 0.1, 10.0).is_err() && b(1e-3, bad, 10.0).is_err() && b(1e-3, 0.1, bad).is_err());
    }
}
