use nalgebra::{Point3, Vector3};

use super::*;
use num::Rng;
use platform::geom::random_rotation;
use platform::manipulator::Leg;

fn motion(rng: &mut Rng) -> Pose {
    Pose { rotation: random_rotation(rng), position: Vector3::from_fn(|_, _| 3.0 * rng.normal()) }
}

fn point(rng: &mut Rng) -> Point3<f64> {
    Point3::new(rng.normal(), rng.normal(), rng.normal())
}

fn general(rng: &mut Rng) -> Manipulator {
    Manipulator::from_legs(std::array::from_fn(|_| Leg { base: point(rng), platform: point(rng) })).unwrap()
}

fn moved(m: &Manipulator, rng: &mut Rng) -> Manipulator {
    transformed(m, &motion(rng), &motion(rng)).unwrap().reordered([3, 1, 0, 5, 4, 2]).unwrap()
}

fn changed(m: &Manipulator, change: impl Fn(Leg) -> Leg) -> Manipulator {
    Manipulator::from_legs(m.legs().map(change)).unwrap()
}

fn flat(p: Point3<f64>) -> Point3<f64> {
    Point3::new(p.x, p.y, 0.3)
}

fn planar(m: &Manipulator) -> Manipulator {
    changed(m, |l| Leg { base: flat(l.base), platform: flat(l.platform) })
}

/// Number of motions and dimension of their families, each motion checked.
fn count(a: &Manipulator, b: &Manipulator) -> (usize, usize) {
    match align(a, b, 1).unwrap() {
        Alignment::Found { motions, all, freedom } => {
            assert!(all);
            assert!(motions.iter().all(|m| m.map.residual < 1e-11), "{motions:?}");
            (motions.len(), freedom)
        }
        other => panic!("{other:?}"),
    }
}

fn difference(a: &Manipulator, b: &Manipulator) -> Difference {
    match align(a, b, 1).unwrap() {
        Alignment::None { difference, .. } => difference,
        other => panic!("{other:?}"),
    }
}

#[test]
#[ignore = "evidence"]
fn a_moved_design_in_another_leg_order_is_found_whatever_its_flats() {
    for seed in 0..5 {
        let mut rng = Rng::new(seed);
        let space = general(&mut rng);
        let shared = Manipulator::try_new(
            space.base_joints().to_vec(),
            space.platform_joints().to_vec(),
            [(0, 0), (1, 1), (2, 2), (3, 3), (4, 4), (5, 4)],
        );
        let base_flat = changed(&space, |l| Leg { base: flat(l.base), ..l });
        for a in [space.clone(), shared.unwrap(), base_flat, planar(&space)] {
            assert_eq!(count(&a, &moved(&a, &mut rng)), (1, 0));
        }
    }
}

#[test]
#[ignore = "evidence"]
fn scale_and_a_small_platform_do_not_matter() {
    let mut rng = Rng::new(3);
    for (base, platform) in [(1e-6, 1e-6), (1e6, 1e6), (1e3, 1.0)] {
        let plain = planar(&general(&mut rng));
        let scaled = |l: Leg| Leg { base: l.base * base, platform: l.platform * platform };
        let b = moved(&plain, &mut rng);
        assert_eq!(count(&changed(&plain, scaled), &changed(&b, scaled)), (1, 0));
    }
}

#[test]
#[ignore = "evidence"]
fn lines_and_affinely_related_bodies_leave_families_of_motions() {
    for seed in 0..4 {
        let mut rng = Rng::new(seed);
        let a = general(&mut rng);
        let line = changed(&a, |l| Leg { base: Point3::new(l.base.x, 0.0, 0.0), ..l });
        assert_eq!(count(&line, &moved(&line, &mut rng)), (1, 1), "turns about the line");
        // all legs of the span are pairs (a, F a) of the plane, so a and F a may shift together
        let affine =
            |l: Leg| Leg { base: flat(l.base), platform: Point3::new(0.5 * l.base.x, 0.7 * l.base.y, 0.0) };
        let affine = changed(&a, affine);
        assert_eq!(count(&affine, &moved(&affine, &mut rng)), (4, 2));
        let similar = changed(&a, |l| Leg { base: flat(l.base), platform: flat(l.base) });
        assert_eq!(count(&similar, &moved(&similar, &mut rng)), (2, 3));
        let spatial = changed(&a, |l| Leg { platform: l.base * 0.5, ..l });
        assert_eq!(count(&spatial, &moved(&spatial, &mut rng)), (1, 0));
    }
}

fn triangle(radius: f64, start: f64) -> [Point3<f64>; 3] {
    std::array::from_fn(|k| {
        let (s, c) = (start + std::f64::consts::TAU * k as f64 / 3.0).sin_cos();
        Point3::new(radius * c, radius * s, 0.0)
    })
}

fn hexagon(base: [Point3<f64>; 3], platform: [Point3<f64>; 3], t: [f64; 6]) -> Manipulator {
    let ends = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)].map(|(i, j)| (base[i], platform[j]));
    let legs = std::array::from_fn(|k| {
        let (x, y) = (ends[k], ends[(k + 1) % 6]);
        Leg { base: x.0 + (y.0 - x.0) * t[k], platform: x.1 + (y.1 - x.1) * t[k] }
    });
    Manipulator::from_legs(legs).unwrap()
}

#[test]
#[ignore = "evidence"]
fn members_of_the_octahedral_class_are_matched_by_their_triangles() {
    let mut rng = Rng::new(5);
    let mut scalene = || [point(&mut rng), point(&mut rng), point(&mut rng)];
    let (first, second) = (scalene(), scalene());
    let offsets = [0.2, -0.1, 0.3, 0.15, 0.4, 0.25];
    let regular = (triangle(2.0, 0.1), triangle(1.0, 0.9));
    for (base, platform, n) in [(first, second, 1), (regular.0, regular.1, 6), (regular.0, second, 1)] {
        let a = hexagon(base, platform, [0.0; 6]);
        let b = hexagon(base, platform, offsets);
        assert_eq!(count(&a, &moved(&b, &mut rng)), (n, 0));
        assert_eq!(count(&a, &b), (n, 0), "half turns are found as well as general ones");
        assert_eq!(count(&b, &moved(&a, &mut rng)), (n, 0));
        // other triangles
        let larger = hexagon(base, platform.map(|p| p * 1.001), offsets);
        let d = difference(&a, &moved(&larger, &mut rng));
        assert!(d.gap > 1e-6 && d.bound < 1e-8, "{d:?}");
    }
}

#[test]
fn legs_from_the_cubics_of_two_planes_are_an_equivalent_platform() {
    use crate::components::{ComponentOptions, components};
    let mut rng = Rng::new(12);
    let a = planar(&general(&mut rng));
    let found = components(&a, ComponentOptions::default()).unwrap();
    let mut legs = a.legs();
    for leg in legs.iter_mut().take(4) {
        let drawn = std::iter::repeat_with(|| found.components[0].sample(&found.span, &mut rng).unwrap());
        *leg = drawn.flatten().next().unwrap().leg;
    }
    let b = Manipulator::from_legs(legs).unwrap();
    assert_eq!(count(&a, &moved(&b, &mut rng)), (1, 0));
}

#[test]
#[ignore = "evidence"]
fn a_joint_off_by_a_millionth_a_mirror_image_and_other_dimensions_are_told_apart() {
    for seed in 0..3 {
        let mut rng = Rng::new(seed);
        let a = general(&mut rng);
        for a in [a.clone(), planar(&a), changed(&a, |l| Leg { base: flat(l.base), ..l })] {
            let mut legs = a.legs();
            legs[2].base.x += 1e-6 * a.size();
            let off = Manipulator::from_legs(legs).unwrap();
            let d = difference(&a, &moved(&off, &mut rng));
            assert!(d.gap > 1e-8 && d.gap > 100.0 * d.bound, "{d:?}");
            legs[2].base.z += 1e-6 * a.size();
            let out = Manipulator::from_legs(legs).unwrap();
            let d = difference(&a, &moved(&out, &mut rng));
            assert!(d.gap > 1e-8 && d.gap > 100.0 * d.bound, "{d:?}");
        }
        let d = difference(&a, &moved(&mirrored(&a), &mut rng));
        assert_eq!(d.invariant, Invariant::CanonicalDistance);
        assert!(d.gap > 0.01);
        // two planes: the mirror image is a motion in space
        assert_eq!(count(&planar(&a), &moved(&mirrored(&planar(&a)), &mut rng)), (1, 0));
        assert_eq!(difference(&a, &planar(&a)).invariant, Invariant::JointRank);
        let mut legs = a.legs();
        legs[5] = Leg {
            base: legs[0].base,
            platform: legs[0].platform + (legs[1].platform - legs[0].platform) * 0.5,
        };
        legs[1].base = legs[0].base;
        let dependent = Manipulator::from_legs(legs).unwrap();
        assert_eq!(difference(&a, &dependent).invariant, Invariant::LegRank);
        assert_eq!(count(&dependent, &moved(&dependent, &mut rng)).0, 1);
    }
}

#[test]
#[ignore = "evidence"]
fn a_platform_upside_down_is_found_after_exchange_only() {
    let mut rng = Rng::new(9);
    let a = general(&mut rng);
    let b = moved(&exchanged(&a), &mut rng);
    assert!(matches!(align(&a, &b, 1).unwrap(), Alignment::None { .. }));
    assert_eq!(count(&a, &exchanged(&b)), (1, 0));
    assert_eq!(exchanged(&exchanged(&a)), a);
}

#[test]
#[ignore = "evidence"]
fn symmetric_hexapods_have_as_many_motions_as_symmetries() {
    let mut rng = Rng::new(4);
    let joint = |radius: f64, angle: f64| Point3::new(radius * angle.cos(), radius * angle.sin(), 0.0);
    let third = std::f64::consts::TAU / 3.0;
    let design = |mirror: bool| {
        Manipulator::from_legs(std::array::from_fn(|k| {
            let turn = third * (k / 2) as f64;
            let (x, y) = if k % 2 == 0 {
                (-0.2, -0.8)
            } else if mirror {
                (0.2, 0.8)
            } else {
                (0.3, 0.7)
            };
            let radius = if mirror || k % 2 == 0 { 3.0 } else { 3.3 };
            Leg { base: joint(radius, turn + x), platform: joint(2.0, turn + y) }
        }))
        .unwrap()
    };
    // three rotations, six with the half turns about the axes of symmetry
    assert_eq!(count(&design(false), &moved(&design(false), &mut rng)), (3, 0));
    assert_eq!(count(&design(true), &moved(&design(true), &mut rng)), (6, 0));
    // a cube on either side: no unique axes, but the search finds some of the motions
    let corners = [
        (1.0, 0.0, 0.0),
        (-1.0, 0.0, 0.0),
        (0.0, 1.0, 0.0),
        (0.0, -1.0, 0.0),
        (0.0, 0.0, 1.0),
        (0.0, 0.0, -1.0),
    ];
    let cube =
        corners.map(|(x, y, z)| Leg { base: Point3::new(x, y, z), platform: Point3::new(-x, y, z) * 0.5 });
    let cube = Manipulator::from_legs(cube).unwrap();
    match align(&cube, &moved(&cube, &mut rng), 1).unwrap() {
        Alignment::Found { motions, .. } => assert!(!motions.is_empty()),
        other => panic!("{other:?}"),
    }
}

#[test]
#[ignore = "evidence"]
fn nearly_degenerate_designs_are_never_told_apart_from_themselves() {
    let mut found = 0;
    for seed in 0..3 {
        let mut rng = Rng::new(seed);
        let a = general(&mut rng);
        for size in [1e-2, 1e-4, 1e-6, 1e-8, 1e-9, 1e-10, 1e-12] {
            let nearly = |p: Point3<f64>| Point3::new(p.x, p.y, 0.3 + size * p.z);
            let planes = changed(&a, |l| Leg { base: nearly(l.base), platform: nearly(l.platform) });
            let affine = changed(&a, |l| Leg { platform: l.base + l.platform.coords * size, ..l });
            for a in [planes, affine] {
                match align(&a, &moved(&a, &mut rng), 1).unwrap() {
                    Alignment::Found { .. } => found += 1,
                    Alignment::Undecided { .. } => {}
                    none @ Alignment::None { .. } => panic!("{size} {none:?}"),
                }
            }
        }
    }
    assert!(found > 25, "{found}");
}
