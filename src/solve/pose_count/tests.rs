use super::*;
use crate::num::Rng;
use nalgebra::Point3;

type Bodies = [[[f64; 3]; 6]; 2];

fn design(joints: &Bodies) -> Manipulator {
    let leg = |i: usize| Leg { base: Point3::from(joints[0][i]), platform: Point3::from(joints[1][i]) };
    Manipulator::from_legs(std::array::from_fn(leg)).unwrap()
}

/// Multiples of 1/64 in `[-16, 16]`: what is computed from them is exact.
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

/// Numbers of monomials of theory and of other implementations: 40 in general, 16 for octahedral and Griffis-Duffy platforms.
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

/// Four legs from one joint: other lengths than those of a pose put it nowhere, those of a pose leave two equations for a rotation.
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
