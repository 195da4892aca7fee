use super::*;
use nalgebra::Point3;
use num::Rng;
use platform::manipulator::{Leg, Manipulator};

fn problem(seed: u64) -> (NearSolver, ScaledPose, [f64; 6]) {
    let mut rng = Rng::new(seed);
    let legs = std::array::from_fn(|_| {
        let mut p = || Point3::new(rng.normal(), rng.normal(), rng.normal());
        Leg { base: p(), platform: p() }
    });
    let m = Manipulator::from_legs(legs).unwrap();
    let rotation = platform::geom::random_rotation(&mut rng);
    let pose = platform::geom::Pose { rotation, position: nalgebra::Vector3::from_fn(|_, _| rng.normal()) };
    let solver = NearSolver::new(&m);
    let place = solver.place_of(&pose);
    (solver, place, std::array::from_fn(|_| rng.uniform(0.5, 3.0)))
}

/// `f + J x + Q(x, x)` is the leg equation times `e.e`, to rounding: the expansion is exact.
#[test]
fn the_expansion_is_exact() {
    for seed in 0..20 {
        let (solver, place, target) = problem(seed);
        let here = LegDefects::at(&solver, &place, &target);
        let mut rng = Rng::new(seed + 100);
        let step: [f64; 6] = std::array::from_fn(|_| rng.uniform(-0.7, 0.7));
        let newton = Newton { step };
        let (h, w) = newton.parts();
        let moved = LegDefects::at(&solver, &newton.applied_to(&place), &target);
        let g0 = -dot(&w, &h);
        let j = here.jacobian();
        for i in 0..6 {
            let (a, b, d) = (here.a[i], here.b[i], here.d[i]);
            let c: Vector = std::array::from_fn(|k| a[k] + b[k]);
            let q = 0.5 * g0 * g0 - g0 * dot(&d, &w)
                + 0.5 * dot(&h, &h)
                + dot(&w, &cross(&c, &h))
                + 2.0 * dot(&a, &b) * dot(&w, &w)
                - 2.0 * dot(&a, &w) * dot(&b, &w)
                + here.f[i] * dot(&w, &w);
            let value = here.f[i] + (0..6).map(|k| j[i][k] * step[k]).sum::<f64>() + q;
            let exact = moved.f[i] * (1.0 + dot(&w, &w));
            assert!((value - exact).abs() < 1e-12 * (1.0 + exact.abs()), "{seed}: {value} {exact}");
        }
    }
}

/// The bound is above `|Y Q(x, x)|` on random unit vectors, and not absurdly so.
#[test]
fn the_second_order_bound_holds_and_is_not_idle() {
    let mut sharpest = 0.0_f64;
    for seed in 0..20 {
        let (solver, place, _) = problem(seed);
        let own = LegDefects::at(&solver, &place, &[0.0; 6]).squares;
        let here = LegDefects::at(&solver, &place, &own);
        let start = SegmentStart::of(&here, &Blur::of(&solver, &place, &here, &[0.0; 6])).unwrap();
        let mut y = [[0.0; 6]; 6];
        (0..6).for_each(|i| y[i][i] = 1.0);
        invert(&mut here.jacobian(), &mut y).unwrap();
        let mut rng = Rng::new(seed);
        for _ in 0..300 {
            let mut unit = || {
                let v: Vector = std::array::from_fn(|_| rng.normal());
                let n = norm(&v);
                v.map(|x| x / n)
            };
            let (h, w) = (unit(), unit());
            let g0 = start.epsilon * if rng.uniform(-1.0, 1.0) > 0.0 { 1.0 } else { -1.0 };
            let q: [f64; 6] = std::array::from_fn(|i| {
                let (a, b, d) = (here.a[i], here.b[i], here.d[i]);
                let c: Vector = std::array::from_fn(|k| a[k] + b[k]);
                0.5 * g0 * g0 - g0 * dot(&d, &w) + 0.5 + dot(&w, &cross(&c, &h)) + 2.0 * dot(&a, &b)
                    - 2.0 * dot(&a, &w) * dot(&b, &w)
            });
            let yq: [f64; 6] = std::array::from_fn(|k| (0..6).map(|i| y[k][i] * q[i]).sum());
            let size = Newton { step: yq }.size().max(dot(&w, &h).abs() / start.epsilon);
            assert!(size <= start.beta * (1.0 + 1e-12), "{seed}: {size} above {}", start.beta);
            sharpest = sharpest.max(size / start.beta);
        }
    }
    assert!(sharpest > 0.3, "{sharpest}");
}

#[test]
fn distance_is_that_of_the_step_and_infinite_for_half_a_turn() {
    let (_, place, _) = problem(3);
    let newton = Newton { step: [0.1, -0.2, 0.05, 0.3, 0.1, -0.2] };
    let there = newton.applied_to(&place);
    let (h, w) = newton.parts();
    let expected = norm(&h).max(norm(&w)).max(dot(&h, &w).abs() / 0.5);
    assert!((distance(&place, &there, 0.5) - expected).abs() < 1e-13);
    let (angle, shift) = motion(&place, &there);
    assert!((angle - 2.0 * norm(&w).atan()).abs() < 1e-12 && shift > 0.0);
    let half = ScaledPose {
        rotation: [place.rotation[0], place.rotation[1].map(|x| -x), place.rotation[2].map(|x| -x)],
        ..place
    };
    // a half turn about an axis of the platform's rows
    assert!(distance(&place, &half, 0.5) > 1e6);
}

#[test]
fn what_is_no_rotation_is_refused() {
    let (_, place, _) = problem(4);
    assert!(orthonormal(&place).is_some());
    let mirrored = ScaledPose { rotation: place.rotation.map(|r| r.map(|x| -x)), ..place };
    assert!(orthonormal(&mirrored).is_none());
    let stretched = ScaledPose { rotation: place.rotation.map(|r| r.map(|x| 1.001 * x)), ..place };
    assert!(orthonormal(&stretched).is_none());
    let mut far = place;
    far.position[1] = f64::INFINITY;
    assert!(orthonormal(&far).is_none());
    far.position[1] = f64::NAN;
    assert!(orthonormal(&far).is_none());
}

/// The numbers of the exact problem, over the rationals, are within the bounds of those computed; and the bounds are of
/// use.
#[test]
fn the_exact_problem_is_within_the_blur() {
    use num_rational::BigRational;
    type Exact = BigRational;
    let exact = |x: f64| Exact::from_float(x).unwrap();
    for seed in 0..20 {
        let mut rng = Rng::new(seed + 900);
        let far = if seed % 2 == 0 { 0.0 } else { 50.0 };
        let legs: [Leg; 6] = std::array::from_fn(|_| {
            let mut p = || Point3::new(rng.normal() + far, rng.normal(), rng.normal());
            Leg { base: p(), platform: p() }
        });
        let m = Manipulator::from_legs(legs).unwrap();
        // joints that are not the doubles but somewhere near them
        let loose = if seed % 3 == 0 { 2f64.powi(-30) } else { 0.0 };
        let solver = NearSolver::new(&if loose > 0.0 { m.enclosed_within(loose) } else { m });
        let legs = legs.map(|l| {
            let mut moved = |p: Point3<f64>| p.map(|x| x + 0.999 * rng.uniform(-loose, loose));
            Leg { base: moved(l.base), platform: moved(l.platform) }
        });
        // a rational rotation, rounded
        let q: [Exact; 4] = std::array::from_fn(|_| exact((rng.normal() * 64.0).round()));
        let [w, x, y, z] = &q;
        let n = w * w + x * x + y * y + z * z;
        let two = exact(2.0);
        let turn: [[Exact; 3]; 3] = [
            [(w * w + x * x - y * y - z * z) / &n, &two * (x * y - w * z) / &n, &two * (x * z + w * y) / &n],
            [&two * (x * y + w * z) / &n, (w * w - x * x + y * y - z * z) / &n, &two * (y * z - w * x) / &n],
            [&two * (x * z - w * y) / &n, &two * (y * z + w * x) / &n, (w * w - x * x - y * y + z * z) / &n],
        ];
        let double = |x: &Exact| num_traits::ToPrimitive::to_f64(x).unwrap();
        let rotation = std::array::from_fn(|i| std::array::from_fn(|j| double(&turn[i][j])));
        let place = ScaledPose { rotation, position: std::array::from_fn(|_| rng.normal()) };
        let l =
            platform::manipulator::LegLengths::try_new(std::array::from_fn(|_| rng.uniform(1.0, 4.0) + far))
                .unwrap();
        let s = l.squared();
        let (target, error) = solver.target(&s);
        let here = LegDefects::at(&solver, &place, &target);
        let blur = Blur::of(&solver, &place, &here, &error);
        let unit = exact(solver.unit);
        let within = |gap: [Exact; 3], bound: f64| {
            let square: Exact = gap.iter().map(|x| x * x).sum();
            square <= exact(bound) * exact(bound)
        };
        for i in 0..6 {
            let local = |p: &Point3<f64>, o: &nalgebra::Vector3<f64>| -> [Exact; 3] {
                std::array::from_fn(|k| (exact(p[k]) - exact(o[k])) / &unit)
            };
            let (a, b) = (local(&legs[i].base, &solver.origin), local(&legs[i].platform, &solver.centre));
            let b: [Exact; 3] = std::array::from_fn(|k| (0..3).map(|j| &turn[k][j] * &b[j]).sum());
            let a: [Exact; 3] = std::array::from_fn(|k| &a[k] - exact(place.position[k]));
            let d: [Exact; 3] = std::array::from_fn(|k| &b[k] - &a[k]);
            let gap =
                |x: &[Exact; 3], y: &Vector| -> [Exact; 3] { std::array::from_fn(|k| &x[k] - exact(y[k])) };
            assert!(within(gap(&a, &here.a[i]), blur.a[i]) && within(gap(&b, &here.b[i]), blur.b[i]));
            assert!(within(gap(&d, &here.d[i]), blur.d[i]));
            let square: Exact = d.iter().map(|x| x * x).sum();
            let given = exact(l.get()[i]) * exact(l.get()[i]) / (&unit * &unit);
            let f = (square - given) / exact(2.0);
            assert!(within([f - exact(here.f[i]), exact(0.0), exact(0.0)], blur.f[i]), "{seed} {i}");
            assert!(
                blur.f[i] < (1e-13 + 10.0 * loose) * (1.0 + far) * (1.0 + target[i]),
                "the bound is of use: {:e}",
                blur.f[i]
            );
        }
    }
}
