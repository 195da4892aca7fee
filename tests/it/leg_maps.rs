//! Leg maps: published numbers, laws, and negative controls.

use equipod::methods::geom::{Pose, random_rotation};
use equipod::methods::manipulator::{Leg, LegIndex, LegLengths, Level, Manipulator};
use equipod::methods::num::Rng;
use equipod::methods::synthesis::{AffineLegMap, LegMapTolerances, LegSpan, Relation, leg_map};
use nalgebra::{Matrix6, Point3, Rotation3, Vector3, Vector6};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

const HEXAGON: [(usize, usize); 6] = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];

fn map(from: &Manipulator, to: &Manipulator) -> equipod::methods::synthesis::LegMapOutcome {
    leg_map(from, to, LegMapTolerances::default()).unwrap()
}

/// The octahedral platform of Rojas, Borras, Thomas, sec. 6.
fn rbt_octahedral() -> Manipulator {
    let h = 108f64.sqrt();
    let base = vec![Point3::new(0.0, 0.0, 0.0), Point3::new(6.0, h, 0.0), Point3::new(12.0, 0.0, 0.0)];
    let platform =
        vec![Point3::new(0.0, 0.0, 0.0), Point3::new(3.0, h / 2.0, 0.0), Point3::new(6.0, 0.0, 0.0)];
    Manipulator::try_new(base, platform, HEXAGON).unwrap()
}

/// Its 6-6 platform: leg `i` slides towards leg `i + 1` by `d1` on the base and `d2` on the platform.
fn rbt_six_six(d1: f64, d2: f64) -> Manipulator {
    let legs = rbt_octahedral().legs();
    let moved = std::array::from_fn(|i| {
        let (x, y) = (legs[i], legs[(i + 1) % 6]);
        Leg {
            base: x.base + (y.base - x.base) * (d1 / 12.0),
            platform: x.platform + (y.platform - x.platform) * (d2 / 6.0),
        }
    });
    Manipulator::from_legs(moved).unwrap()
}

fn point(rng: &mut Rng, scale: f64) -> Point3<f64> {
    Point3::new(rng.normal(), rng.normal(), rng.normal()) * scale
}

fn random_octahedral(rng: &mut Rng) -> Manipulator {
    let mut triangle = |s: f64| (0..3).map(|_| point(rng, s)).collect::<Vec<_>>();
    Manipulator::try_new(triangle(2.0), triangle(1.0), HEXAGON).unwrap()
}

/// An equivalent platform: every leg slides towards its successor by its own fraction.
fn slid(m: &Manipulator, t: [f64; 6]) -> Manipulator {
    let legs = m.legs();
    let moved = std::array::from_fn(|i| {
        let (x, y) = (legs[i], legs[(i + 1) % 6]);
        Leg {
            base: x.base + (y.base - x.base) * t[i],
            platform: x.platform + (y.platform - x.platform) * t[i],
        }
    });
    Manipulator::from_legs(moved).unwrap()
}

fn pose(rng: &mut Rng) -> Pose {
    Pose { rotation: random_rotation(rng), position: point(rng, 3.0).coords }
}

fn close(x: &Matrix6<f64>, y: &Matrix6<f64>, tolerance: f64) -> bool {
    (x - y).norm() <= tolerance * y.norm()
}

#[test]
fn published_leg_lengths_of_the_joint_free_platform() {
    let l = LegLengths::try_new([19.8, 18.0, 18.0, 17.0, 14.9, 17.8]).unwrap();
    let outcome = map(&rbt_octahedral(), &rbt_six_six(2.4, 1.2));
    assert!(outcome.is_regular_within_rounding());
    let m = outcome.closest.apply(&l.squared()).unwrap().lengths().get();
    let published = [
        18.851_843_411_189_265,
        17.839_282_496_782_207,
        17.145_261_736_118_233,
        16.426_868_234_694_037,
        14.762_655_587_664_439,
        18.058_792_872_171_72,
    ];
    for (x, y) in m.iter().zip(published) {
        assert!((x - y).abs() < 1e-12 * y, "{x} {y}");
    }
    let det = 0.8f64.powi(6) - 0.2f64.powi(6);
    assert!((outcome.determinant - det).abs() < 1e-13, "{}", outcome.determinant);
}

#[test]
fn the_singular_line_and_the_midpoints() {
    let o = rbt_octahedral();
    for d2 in [0.6, 1.0, 3.0, 4.5, 7.2] {
        let d1 = 12.0 - 2.0 * d2; // Delta1 / 12 + Delta2 / 6 = 1
        let outcome = map(&o, &rbt_six_six(d1, d2));
        // singular as the numbers they are, or within rounding of it, which is not a verdict; 0.1.0 said singular by a
        // tolerance
        let undecided = matches!(outcome.relation, Relation::Singular | Relation::Undecided);
        assert!(undecided, "{d1} {d2}: {outcome:?}");
        assert!(outcome.inverse_condition < 1e-13 && outcome.determinant.abs() < 1e-13);
        // off the line by a ten-thousandth it is regular again
        assert!(map(&o, &rbt_six_six(d1 + 1e-4, d2)).is_regular_within_rounding());
    }
    // the line printed in the paper, Delta1 + Delta2 = 12, is not singular
    assert!(map(&o, &rbt_six_six(9.0, 3.0)).is_regular_within_rounding());
}

#[test]
fn the_map_is_inverse_kinematics_at_random_poses() {
    let mut rng = Rng::new(42);
    for _ in 0..50 {
        let from = random_octahedral(&mut rng);
        let to = slid(&from, std::array::from_fn(|_| rng.uniform(-0.4, 0.4)));
        // joints in doubles are off their edges by rounding, which is no proof
        let outcome = map(&from, &to);
        assert!(outcome.is_regular_within_rounding() && outcome.level == Level::WithinRounding);
        for _ in 0..5 {
            let pose = pose(&mut rng);
            let (s, want) = (pose.squared_lengths(&from).unwrap(), pose.squared_lengths(&to).unwrap());
            let got = outcome.closest.apply(&s).unwrap().get();
            for (x, y) in got.iter().zip(want.get()) {
                assert!((x - y).abs() < 1e-9 * (1.0 + y), "{x} {y}");
            }
        }
    }
}

#[test]
fn a_general_hexapod_relates_only_to_itself() {
    let mut rng = Rng::new(5);
    for _ in 0..30 {
        let legs =
            std::array::from_fn(|_| Leg { base: point(&mut rng, 2.0), platform: point(&mut rng, 1.0) });
        let m = Manipulator::from_legs(legs).unwrap();
        let own = map(&m, &m);
        assert_eq!(own.relation, Relation::Equivalent);
        assert!(close(&own.closest.a, &Matrix6::identity(), 1e-11) && own.closest.c.norm() < 1e-10);
        let other =
            std::array::from_fn(|_| Leg { base: point(&mut rng, 2.0), platform: point(&mut rng, 1.0) });
        let outcome = map(&m, &Manipulator::from_legs(other).unwrap());
        assert_eq!(outcome.relation, Relation::Unrelated);
        assert!(outcome.residuals.iter().all(|r| *r > 1e-3), "{:?}", outcome.residuals);
        assert!(outcome.map().is_none() && outcome.legs_off().count() == 6);
    }
}

#[test]
fn a_joint_off_its_line_by_a_millionth_is_seen_and_rounding_is_not() {
    let mut rng = Rng::new(8);
    let mut smallest = f64::INFINITY;
    for _ in 0..50 {
        let from = random_octahedral(&mut rng);
        let to = slid(&from, [0.2, 0.3, 0.25, 0.15, 0.35, 0.2]);
        let exact = map(&from, &to);
        assert!(exact.is_regular_within_rounding() && exact.residual < 1e-14, "{}", exact.residual);
        let mut legs = to.legs();
        let edge = from.legs()[1].base - from.legs()[0].base;
        let across = edge.cross(&Vector3::new(0.3, -0.5, 0.9)).normalize();
        legs[0].base += across * (1e-6 * from.size());
        let outcome = map(&from, &Manipulator::from_legs(legs).unwrap());
        assert_eq!(outcome.relation, Relation::Unrelated);
        assert_eq!(outcome.legs_off().map(LegIndex::get).collect::<Vec<_>>(), [0]);
        smallest = smallest.min(outcome.residual);
    }
    assert!(smallest > 1e-8, "{smallest}");
}

#[test]
fn dependent_legs_of_the_first_platform_are_reported() {
    let singular = rbt_six_six(6.0, 3.0);
    let own = map(&singular, &singular);
    assert_eq!((own.relation, own.leg_rank), (Relation::Singular, 5));
    // the octahedral platform cannot be had from it, whatever its own legs are
    let back = map(&singular, &rbt_octahedral());
    assert_eq!((back.relation, back.leg_rank), (Relation::Singular, 5));
}

#[test]
fn frames_units_and_leg_order_do_not_matter() {
    let mut rng = Rng::new(17);
    for scale in [1e-6, 1.0, 1e6] {
        for _ in 0..10 {
            let from = random_octahedral(&mut rng);
            let to = slid(&from, std::array::from_fn(|_| rng.uniform(-0.3, 0.4)));
            let reference = map(&from, &to);
            let (rb, rp) = (random_rotation(&mut rng), random_rotation(&mut rng));
            let (ub, up) = (point(&mut rng, 1e3).coords, point(&mut rng, 1e3).coords);
            let place = |r: &Rotation3<f64>, u: Vector3<f64>, p: Point3<f64>| (r * p + u) * scale;
            let move_legs = |m: &Manipulator| {
                let legs = m
                    .legs()
                    .map(|l| Leg { base: place(&rb, ub, l.base), platform: place(&rp, up, l.platform) });
                Manipulator::try_new(
                    legs.map(|l| l.base).to_vec(),
                    legs.map(|l| l.platform).to_vec(),
                    std::array::from_fn(|i| (i, i)),
                )
                .unwrap()
            };
            let moved = map(&move_legs(&from), &move_legs(&to));
            assert!(moved.is_regular_within_rounding(), "{moved:?}");
            assert!(close(&moved.closest.a, &reference.closest.a, 1e-9));
            let c = moved.closest.c / (scale * scale);
            assert!((c - reference.closest.c).norm() < 1e-9 * (1.0 + reference.closest.c.norm()));
            let order = [3, 0, 5, 2, 4, 1];
            let relabelled = map(&from, &to.reordered(order).unwrap());
            for i in 0..6 {
                assert!((relabelled.closest.a.row(i) - reference.closest.a.row(order[i])).norm() < 1e-12);
            }
        }
    }
}

#[test]
fn points_of_the_hexagon_are_in_the_span_and_random_legs_never() {
    let mut rng = Rng::new(23);
    let mut nearest = f64::INFINITY;
    for _ in 0..40 {
        let m = random_octahedral(&mut rng);
        let span = LegSpan::of(&m, 1e-9).unwrap();
        let legs = m.legs();
        for k in 0..6 {
            let t = rng.uniform(-2.0, 3.0);
            let (x, y) = (legs[k], legs[(k + 1) % 6]);
            let on = Leg {
                base: x.base + (y.base - x.base) * t,
                platform: x.platform + (y.platform - x.platform) * t,
            };
            assert!(span.distance(&on) < 1e-13, "{}", span.distance(&on));
        }
        for _ in 0..50 {
            // points of the two joint planes: possible joints of a planar platform
            let mix = |p: [Point3<f64>; 3], u: f64, v: f64| p[0] + (p[1] - p[0]) * u + (p[2] - p[0]) * v;
            let base = [legs[0].base, legs[1].base, legs[3].base];
            let platform = [legs[0].platform, legs[2].platform, legs[4].platform];
            let off = Leg {
                base: mix(base, rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0)),
                platform: mix(platform, rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0)),
            };
            nearest = nearest.min(span.distance(&off));
        }
    }
    assert!(nearest > 1e-5, "{nearest}");
}

proptest! {
    // PROPTEST_CASES and PROPTEST_RNG_SEED take other numbers
    #![proptest_config(ProptestConfig {
        cases: 64,
        rng_seed: RngSeed::Fixed(1),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn maps_compose_invert_and_their_determinants_multiply(
        seed in 0u64..1_000_000,
        t in prop::array::uniform6(-0.35f64..0.4),
        u in prop::array::uniform6(-0.35f64..0.4),
    ) {
        let mut rng = Rng::new(seed);
        let first = random_octahedral(&mut rng);
        let (second, third) = (slid(&first, t), slid(&first, u));
        let (ab, bc, ac) = (map(&first, &second), map(&second, &third), map(&first, &third));
        prop_assume!(LegSpan::of(&first, 1e-9).unwrap().inverse_condition() > 1e-5);
        prop_assume!(ab.inverse_condition > 1e-3);
        let both = ab.closest.then(&bc.closest);
        let scale = 1.0 + ac.closest.c.norm();
        prop_assert!(close(&both.a, &ac.closest.a, 1e-7));
        prop_assert!((both.c - ac.closest.c).norm() < 1e-7 * scale);
        prop_assert!((ab.determinant * bc.determinant - ac.determinant).abs() < 1e-7);
        let back = map(&second, &first);
        let inverse = ab.closest.invert().unwrap();
        prop_assert!(close(&inverse.a, &back.closest.a, 1e-7));
        let round = ab.closest.then(&inverse);
        prop_assert!(close(&round.a, &AffineLegMap::identity().a, 1e-10));
        prop_assert!((round.c - Vector6::zeros()).norm() < 1e-9 * scale);
    }
}
