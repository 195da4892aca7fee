use super::*;
use nalgebra::Point3;
use num::Rng;
use num::surd::Surd;
use platform::manipulator::{ExactEnds, Leg, SurdPoint};

type Bodies = [[[f64; 3]; 6]; 2];

fn design(joints: &Bodies) -> Manipulator {
    let leg = |i: usize| Leg { base: Point3::from(joints[0][i]), platform: Point3::from(joints[1][i]) };
    Manipulator::from_legs(std::array::from_fn(leg)).unwrap()
}

/// Multiples of 1/64 in `[-16, 16]`: results computed from them are exact.
fn small(rng: &mut Rng) -> f64 {
    ((rng.next_u64() % 2049) as f64 - 1024.0) / 64.0
}

/// Six joints, in a plane when `z` is zero.
fn body(rng: &mut Rng, z: f64) -> [[f64; 3]; 6] {
    std::array::from_fn(|_| [small(rng), small(rng), z * small(rng)])
}

fn bodies(rng: &mut Rng, planar: bool) -> Bodies {
    let z = if planar { 0.0 } else { 1.0 };
    [body(rng, z), body(rng, z)]
}

/// Squared lengths at `R = 1` and an integer position.
fn at_home(joints: &Bodies, p: [f64; 3]) -> ExactSquares {
    std::array::from_fn(|i| {
        let square = (0..3).map(|k| (joints[1][i][k] + p[k] - joints[0][i][k]).powi(2)).sum();
        [square, 0.0]
    })
}

fn integer_squares(rng: &mut Rng) -> ExactSquares {
    std::array::from_fn(|_| [(100 + rng.next_u64() % 200) as f64, 0.0])
}

fn set(joints: &Bodies, squares: &ExactSquares, seed: u64) -> PoseSet {
    count_poses(&design(joints), squares, &CountOptions { seed, primes: 1 }).set
}

fn finite(joints: &Bodies, squares: &ExactSquares, seed: u64) -> Option<usize> {
    match set(joints, squares, seed) {
        PoseSet::Finite { count, .. } => Some(count),
        _ => None,
    }
}

fn dimension(joints: &Bodies, squares: &ExactSquares, seed: u64) -> usize {
    match set(joints, squares, seed) {
        PoseSet::PositiveDimensional { dimension, .. } => dimension,
        PoseSet::Finite { .. } => 0,
        PoseSet::Undecided { why } => panic!("{why:?}"),
    }
}

const HEXAGON: [[usize; 6]; 2] = [[0, 1, 1, 2, 2, 0], [0, 0, 1, 1, 2, 2]];

fn octahedral(rng: &mut Rng) -> Bodies {
    let corners = bodies(rng, false);
    std::array::from_fn(|k| HEXAGON[k].map(|i| corners[k][i]))
}

/// Each joint slid along the side of its triangle to the next one of its body.
fn griffis_duffy(octahedral: &Bodies, t: [f64; 6]) -> Bodies {
    std::array::from_fn(|k| {
        std::array::from_fn(|i| {
            let (u, v) = (octahedral[k][i], octahedral[k][(i + 1) % 6]);
            std::array::from_fn(|c| u[c] + t[i] * (v[c] - u[c]))
        })
    })
}

/// Numbers of monomials of theory and of other implementations: 40 in general, 16 for octahedral and Griffis-Duffy
/// platforms.
#[test]
fn counts_of_known_classes() {
    let mut rng = Rng::new(1);
    for seed in 0..4 {
        let s = integer_squares(&mut rng);
        let general = PoseSet::Finite { count: 40, by_degree: vec![1, 10, 18, 10, 1] };
        assert_eq!(set(&bodies(&mut rng, seed % 2 == 0), &s, seed), general);
        let sixteen = PoseSet::Finite { count: 16, by_degree: vec![1, 10, 5] };
        let shared = octahedral(&mut rng);
        assert_eq!(set(&shared, &s, seed), sixteen);
        let mut moved = griffis_duffy(&shared, [0.25, 0.5, 0.125, 0.375, 0.75, 0.625]);
        assert_eq!(set(&moved, &s, seed), sixteen);
        // the last digits of all joints make it a general platform, with 24 more poses far out
        moved[0][2][0] = moved[0][2][0].next_up();
        assert_eq!(finite(&moved, &s, seed), Some(24));
        moved = moved.map(|body| body.map(|p| p.map(|x| x * (1.0 + 1e-15 * small(&mut rng)))));
        assert_eq!(finite(&moved, &s, seed), Some(40));
    }
}

#[test]
fn generic_lengths_have_the_count_of_the_class() {
    let mut rng = Rng::new(2);
    let options = CountOptions { seed: 3, primes: 1 };
    let count = |joints: &Bodies| count_generic_poses(&design(joints), &options).finite();
    assert_eq!(count(&bodies(&mut rng, false)), Some(40));
    assert_eq!(count(&octahedral(&mut rng)), Some(16));
    // similar bodies: half of the poses go to infinity
    let mut similar = bodies(&mut rng, true);
    similar[1] = similar[0].map(|p| p.map(|x| 2.0 * x));
    assert_eq!(count(&similar), Some(16));
}

/// Nothing is lost without being counted: 40 points, and those of octahedral platforms that are no poses have an
/// isotropic quaternion (butterflies). Similar planar bodies have curves of points with `M = 0`, so that these have no
/// number.
#[test]
fn common_points_are_finite_isotropic_or_at_infinity() {
    let mut rng = Rng::new(11);
    let options = CountOptions { seed: 5, primes: 1 };
    let common = |joints: &Bodies| {
        let m = design(joints);
        count_common_points(&m, &count_generic_poses(&m, &options), &options).unwrap()
    };
    let split = |joints: &Bodies| {
        let p = common(joints);
        assert!(p.error_probability < 1e-2, "{p:?}");
        (p.finite, p.isotropic, p.at_infinity)
    };
    assert_eq!(split(&bodies(&mut rng, false)), (40, Some(0), Some(0)));
    assert_eq!(split(&bodies(&mut rng, true)), (40, Some(0), Some(0)));
    let shared = octahedral(&mut rng);
    assert_eq!(split(&shared), (16, Some(24), Some(0)));
    assert_eq!(
        split(&griffis_duffy(&shared, [0.25, 0.5, 0.125, 0.375, 0.75, 0.625])),
        (16, Some(24), Some(0))
    );
    let mut similar = bodies(&mut rng, true);
    similar[1] = similar[0].map(|p| p.map(|x| 2.0 * x));
    let (finite, _, at_infinity) = split(&similar);
    assert_eq!((finite, at_infinity), (16, None));
    // the legs of a singular platform depend on each other: no pose for generic lengths
    let singular = griffis_duffy(&shared, [0.5; 6]);
    let lost = common(&singular);
    assert_eq!((lost.finite, lost.isotropic, lost.at_infinity), (0, None, None));
}

/// Parallel legs of equal length: the platform may be anywhere on a sphere.
#[test]
fn congruent_bodies_with_equal_lengths_have_a_surface_of_poses() {
    let mut rng = Rng::new(4);
    for seed in 0..12 {
        let mut joints = bodies(&mut rng, seed % 2 == 0);
        joints[1] = joints[0];
        let l = 1.0 + (rng.next_u64() % 20) as f64;
        let mut s = [[l * l, 0.0]; 6];
        assert_eq!(dimension(&joints, &s, seed), 2, "{joints:?}");
        // the last digit of a squared length, and less
        let control = (seed % 6) as usize;
        s[control][0] = (l * l).next_up();
        let isolated = finite(&joints, &s, seed);
        assert!(
            isolated.is_some_and(|n| n > 0 && n <= 40),
            "{:?} {joints:?}",
            count_poses(&design(&joints), &s, &CountOptions { seed, primes: 1 })
        );
        s[control] = [l * l, 1e-30];
        assert_eq!(finite(&joints, &s, seed), isolated);
    }
}

/// All joints of a body on a line: it turns about the line, whatever the lengths.
#[test]
fn a_body_of_collinear_joints_turns_freely() {
    let mut rng = Rng::new(5);
    for seed in 0..6 {
        let mut joints = bodies(&mut rng, false);
        let (u, v) = ([1.0, 2.0, -1.0], [small(&mut rng), 3.0, 2.0]);
        for i in 0..6 {
            let t = [-3.0, -1.0, 0.0, 2.0, 5.0, 7.0][i];
            joints[seed as usize % 2][i] = std::array::from_fn(|k| u[k] + t * v[k]);
        }
        let s = at_home(&joints, [1.0, 2.0, 15.0]);
        assert_eq!(dimension(&joints, &s, seed), 1);
    }
}

/// Four legs from one joint: other lengths than those of a pose put it nowhere, those of a pose leave two equations for
/// a rotation.
#[test]
fn four_concurrent_legs_move_or_do_not_fit() {
    let mut rng = Rng::new(6);
    for seed in 0..6 {
        let mut joints = bodies(&mut rng, false);
        for i in 1..4 {
            joints[1][i] = joints[1][0];
        }
        let s = at_home(&joints, [3.0, -2.0, 15.0]);
        assert_eq!(dimension(&joints, &s, seed), 1);
        let mut longer = s;
        longer[0][0] += 1.0;
        assert_eq!(finite(&joints, &longer, seed), Some(0));
    }
}

/// All midpoints of two triangles: architecturally singular, with motions for lengths of poses.
#[test]
fn a_singular_griffis_duffy_platform_moves() {
    let mut rng = Rng::new(8);
    for seed in 0..4 {
        let doubled = octahedral(&mut rng).map(|body| body.map(|p| p.map(|x| 2.0 * x)));
        let joints = griffis_duffy(&doubled, [0.5; 6]);
        let s = at_home(&joints, [3.0, -2.0, 15.0]);
        assert_eq!(dimension(&joints, &s, seed), 1);
        let mut longer = s;
        longer[3][0] += 1.0;
        assert_eq!(finite(&joints, &longer, seed), Some(0));
    }
}

/// Complex lines of poses of two similar hexagons, one twice the other, all lengths 5.
#[test]
fn similar_bodies_with_special_lengths_have_lines_of_poses() {
    let base = [[2.0, 0.0], [-1.0, 2.0], [0.0, 1.0], [-1.0, -1.0], [0.0, -1.0], [0.0, -2.0]];
    let joints: Bodies = [1.0, 2.0].map(|c| base.map(|p| [c * p[0], c * p[1], 0.0]));
    assert_eq!(dimension(&joints, &[[25.0, 0.0]; 6], 1), 1);
    let others = [25.0, 36.0, 25.0, 49.0, 36.0, 25.0].map(|s| [s, 0.0]);
    assert_eq!(finite(&joints, &others, 1), Some(16));
}

#[test]
fn the_answer_does_not_depend_on_the_prime_and_its_probability_of_error_is_small() {
    let mut rng = Rng::new(9);
    let joints = bodies(&mut rng, false);
    let s = integer_squares(&mut rng);
    let one = count_poses(&design(&joints), &s, &CountOptions { seed: 1, primes: 1 });
    let three = count_poses(&design(&joints), &s, &CountOptions { seed: 2, primes: 3 });
    assert_eq!(one.set, three.set);
    assert_eq!((one.primes.len(), three.primes.len()), (1, 3));
    assert!(three.error_probability < one.error_probability && one.error_probability < 1e-9);
    // the same seed, the same answer
    assert_eq!(one, count_poses(&design(&joints), &s, &CountOptions { seed: 1, primes: 1 }));
    // numbers of very different size have more digits, and so larger minors
    let mut wide = joints;
    wide[0][0][0] = 1e-300;
    let wide = count_poses(&design(&wide), &s, &CountOptions { seed: 1, primes: 1 });
    assert_eq!(wide.finite(), Some(40));
    assert!(wide.error_probability > one.error_probability);
}

/// A pose of multiplicity counts as often: platform in the plane of the base, where poses and their mirror images meet.
#[test]
fn multiple_poses_count_with_their_multiplicity() {
    let mut rng = Rng::new(10);
    let joints = bodies(&mut rng, true);
    assert_eq!(finite(&joints, &at_home(&joints, [2.0, 1.0, 0.0]), 1), Some(40));
}

fn surd(n: i64, d: i64) -> Surd {
    Surd::integer(n).times(&Surd::integer(d).inverse().unwrap()).unwrap()
}

fn root(n: i64) -> Surd {
    Surd::integer(n).sqrt().unwrap()
}

/// `x u + y v`.
fn mixed(x: &Surd, u: &SurdPoint, y: &Surd, v: &SurdPoint) -> SurdPoint {
    [0, 1, 2].map(|k| x.times(&u[k]).unwrap().plus(&y.times(&v[k]).unwrap()).unwrap())
}

/// The octahedral platform with equilateral base of edge 12 and platform of edge 6. Each joint is slid along the side
/// towards the next by its part.
fn slid(parts: &[Surd; 6]) -> [ExactEnds; 6] {
    let h = root(3);
    let point = |x: i64, y: i64| [Surd::integer(x), h.times(&Surd::integer(y)).unwrap(), Surd::zero()];
    let corners = [[point(0, 0), point(6, 6), point(12, 0)], [point(0, 0), point(6, 0), point(3, -3)]];
    let one = Surd::integer(1);
    std::array::from_fn(|i| {
        let (t, rest) = (&parts[i], one.minus(&parts[i]).unwrap());
        let end = |k: usize| {
            let next = HEXAGON[k][(i + 1) % 6];
            mixed(&rest, &corners[k][HEXAGON[k][i]], t, &corners[k][next])
        };
        [end(0), end(1)]
    })
}

fn exact(ends: &[ExactEnds; 6]) -> Manipulator {
    Manipulator::from_exact_ends(ends).unwrap()
}

/// The same doubles, taken as they are.
fn rounded(m: &Manipulator) -> Manipulator {
    Manipulator::from_legs(m.legs()).unwrap()
}

const SQUARES: ExactSquares =
    [[250.0, 0.0], [260.0, 0.0], [240.0, 0.0], [255.0, 0.0], [245.0, 0.0], [270.0, 0.0]];

/// A Griffis-Duffy platform with irrational joints has sixteen poses; the one with rounded joints has more.
#[test]
fn exact_joints_are_counted_as_they_are_and_rounded_ones_as_others() {
    let options = CountOptions::default();
    let thirds = [1, 2, 3, 1, 2, 4].map(|n| surd(n, 7));
    let mut odd = thirds.clone();
    // half the diagonal of a square, a number that is in no field of the others
    odd[2] = root(2).times(&surd(1, 2)).unwrap();
    for parts in [std::array::from_fn(|_| Surd::zero()), thirds, odd] {
        let m = exact(&slid(&parts));
        let given = count_poses(&m, &SQUARES, &options);
        assert_eq!(given.set, PoseSet::Finite { count: 16, by_degree: vec![1, 10, 5] });
        assert!(given.error_probability < 1e-11 && given.error_probability > 1e-20, "{given:?}");
        let generic = count_generic_poses(&m, &options);
        assert_eq!((generic.finite(), generic.lengths), (Some(16), CountedLengths::Generic));
        let shared = m.base_joints().len() == 3;
        let other = count_poses(&rounded(&m), &SQUARES, &options).finite();
        // joints with coordinates that are doubles stay on their side
        assert!(other.is_some_and(|n| if shared { n == 16 } else { n >= 24 }), "{other:?}");
    }
}

/// Two mirror-symmetric hexagons with a threefold axis: 28 poses, rounded more.
#[test]
fn an_exact_symmetric_hexapod_has_28_poses() {
    let (half, h) = (surd(1, 2), root(3).times(&surd(1, 2)).unwrap());
    let turned = |p: &SurdPoint, times: usize| {
        (0..times).fold(p.clone(), |[x, y, z], _| {
            let by = |a: &Surd, u: &Surd, b: &Surd, v: &Surd| {
                a.times(u).unwrap().plus(&b.times(v).unwrap()).unwrap()
            };
            let back = half.negated();
            [by(&back, &x, &h.negated(), &y), by(&h, &x, &back, &y), z]
        })
    };
    let point = |x: i64, y: i64| [Surd::integer(x), Surd::integer(y), Surd::zero()];
    let ends: [ExactEnds; 6] = std::array::from_fn(|i| {
        let side = if i % 2 == 0 { 1 } else { -1 };
        [turned(&point(9, 2 * side), i / 2), turned(&point(4, 3 * side), i / 2)]
    });
    let m = exact(&ends);
    assert_eq!(count_generic_poses(&m, &CountOptions::default()).finite(), Some(28));
    assert!(count_generic_poses(&rounded(&m), &CountOptions::default()).finite().is_some_and(|n| n > 28));
}

/// Thirds and fifths need no square roots.
#[test]
fn fractions_are_counted_as_doubles_are() {
    let mut rng = Rng::new(12);
    let mut point = || {
        [0, 1, 2].map(|k| if k == 2 { Surd::zero() } else { surd((rng.next_u64() % 90).cast_signed(), 15) })
    };
    let base: [SurdPoint; 6] = std::array::from_fn(|_| point());
    let two = Surd::integer(2);
    let m = exact(&base.map(|p| [p.clone(), mixed(&two, &p, &Surd::zero(), &p)]));
    let count = count_poses(&m, &SQUARES, &CountOptions::default());
    assert_eq!(count.finite(), Some(16));
    assert_eq!(count.finite(), count_poses(&rounded(&m), &SQUARES, &CountOptions::default()).finite());
    assert!(count.error_probability < 1e-17);
}

#[test]
fn joints_known_between_bounds_and_in_too_large_fields_are_not_counted() {
    let m = exact(&slid(&[1, 2, 3, 1, 2, 4].map(|n| surd(n, 7))));
    let undecided = |m: &Manipulator| match count_generic_poses(m, &CountOptions::default()).set {
        PoseSet::Undecided { why } => Some(why),
        _ => None,
    };
    assert_eq!(undecided(&m), None);
    assert_eq!(undecided(&rounded(&m).enclosed_within(1e-15)), Some(CountUndecided::JointsNotExact));
    let mut wide = slid(&[1, 2, 3, 1, 2, 4].map(|n| surd(n, 7)));
    let primes = [2, 5, 7, 11, 13, 17, 19, 23, 29];
    for (k, p) in primes.into_iter().enumerate() {
        let x = &mut wide[k % 6][k / 6][0];
        *x = x.plus(&root(p)).unwrap();
    }
    assert_eq!(undecided(&exact(&wide)), Some(CountUndecided::NoPrimeDrawn));
}
