//! Architectural singularity: constructed instances of every case, and the same ones spoilt by `1e-9`.

use equipod::methods::geom::{Pose, random_rotation};
use equipod::methods::manipulator::{Leg, Manipulator};
use equipod::methods::num::Rng;
use equipod::methods::singularity::{Architecture, Case, PlanarMap, RankBound, nearest_singular};
use nalgebra::{Matrix6, Point3, Rotation3, Vector3};

use super::evidence::size;
use super::instances::{Instance, apart, instances};

/// Designs of the crowded kind.
const GRIDS: u64 = 240;

/// One coordinate of leg `leg` changed.
fn nudged(m: &Manipulator, leg: usize, platform: bool, by: [f64; 3]) -> Manipulator {
    let mut legs = m.legs();
    let end = if platform { &mut legs[leg].platform } else { &mut legs[leg].base };
    *end += Vector3::from(by);
    apart(&legs).unwrap()
}

#[test]
fn every_case_is_recognised_by_name_with_its_ranks() {
    for Instance { name, m, leg_rank, rank, reason, guilty } in instances() {
        let found = Architecture::of(&m);
        assert_eq!(found.is_singular(), Some(true), "{name}");
        assert_eq!((found.leg_rank, found.jacobian.rank), (leg_rank, rank), "{name}");
        let first = &found.findings[0];
        assert_eq!((first.case.name(), first.case.reason()), (name, reason), "{found:?}");
        assert_eq!(first.legs, guilty, "{name}");
        let by_lattice = matches!(found.jacobian.bound, RankBound::Lattice { .. });
        assert_eq!(by_lattice, rank < leg_rank, "{name}");
    }
}

#[test]
fn the_rank_is_that_of_doubles_at_random_poses() {
    let mut rng = Rng::new(5);
    for Instance { name, m, rank, .. } in instances() {
        for _ in 0..5 {
            let position = Vector3::from_fn(|_, _| rng.uniform(-5.0, 5.0));
            let pose = Pose { rotation: random_rotation(&mut rng), position };
            let s = equipod::methods::manipulator::plucker_matrix(&m, &pose, 1.0).singular_values();
            let numeric = s.iter().filter(|x| **x > 1e-11 * s.max()).count();
            assert_eq!(numeric, rank, "{name}: {s}");
        }
    }
}

#[test]
fn a_joint_off_by_a_billionth_makes_every_case_regular_and_the_distance_says_so() {
    for Instance { name, m, guilty, .. } in instances() {
        let legs = guilty.iter().copied().flat_map(|i| [(i, false), (i, true)]);
        let mut regular = 0;
        for (leg, platform) in legs {
            if regular == size(1, 3) {
                break; // enough of one kind
            }
            let by = [3e-10, -5e-10, 8e-10];
            let spoilt = nudged(&m, leg, platform, by);
            let found = Architecture::of(&spoilt);
            // some joints may move: the far ends of concurrent legs, or one of five legs on two lines
            if found.is_singular() == Some(true) {
                continue;
            }
            regular += 1;
            assert_eq!((found.leg_rank, found.jacobian.rank, found.findings.len()), (6, 6, 0), "{name}");
            let near = nearest_singular(&spoilt, 1).unwrap().unwrap();
            let moved = Vector3::from(by).norm();
            assert!(near.distance <= moved * 1.000_01, "{name}, leg {leg}: {}", near.distance);
            assert!(
                near.distance > 1e-3 * moved && !near.within_rounding,
                "{name}, leg {leg}: {}",
                near.distance
            );
            assert!(near.residual < 1e-14, "{name}: {}", near.residual);
        }
        assert!(regular > 0, "{name}");
    }
}

/// The law behind the search: the design it returns is singular to rounding at random poses.
#[test]
fn the_singular_design_nearby_is_singular() {
    let mut rng = Rng::new(17);
    for k in 0..12 {
        let mut point = |flat: bool| {
            let z = if flat { 0.0 } else { rng.normal() };
            Point3::new(rng.normal(), rng.normal(), z)
        };
        let legs = std::array::from_fn(|_| Leg { base: point(k % 3 > 0), platform: point(k % 3 > 1) });
        let m = Manipulator::from_legs(legs).unwrap();
        let near = nearest_singular(&m, 1).unwrap().unwrap();
        assert!(near.distance > 1e-3 && near.distance < 2.0, "{}", near.distance);
        let there = m.pairs().map(|(a, b)| (near.base[a], near.platform[b]));
        let changed = there
            .iter()
            .zip(m.legs())
            .map(|(x, l)| (x.0 - l.base).norm_squared() + (x.1 - l.platform).norm_squared());
        assert!((changed.sum::<f64>().sqrt() - near.distance).abs() < 1e-9, "no joint is shared here");
        for _ in 0..5 {
            let position = Vector3::from_fn(|_, _| rng.normal());
            let pose = Pose { rotation: random_rotation(&mut rng), position };
            let j = Matrix6::from_fn(|i, k| {
                let (a, b) = there[i];
                let d = pose.transform(&b) - a;
                if k < 3 { d[k] } else { a.coords.cross(&d)[k - 3] }
            });
            let s = j.singular_values();
            assert!(s.min() < 1e-11 * s.max(), "{} {}: {s}", near.kind, near.distance);
        }
    }
}

#[test]
fn rigid_motions_exchange_and_order_change_nothing_that_matters() {
    let quarter = Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::FRAC_PI_2);
    // exactly: a quarter turn and an integer shift keep integers
    let turn = |p: Point3<f64>| (quarter * p).map(f64::round) + Vector3::new(7.0, -3.0, 2.0);
    for Instance { name, m, leg_rank, rank, reason, .. } in instances() {
        if name == "conic" {
            continue; // its projective images are fractions
        }
        let integers =
            m.legs().iter().all(|l| l.base.iter().chain(l.platform.iter()).all(|x| x.fract().abs() <= 0.0));
        assert!(integers, "{name}");
        let legs = m.legs();
        let other: [Leg; 6] = std::array::from_fn(|i| {
            let l = legs[(5 * i + 2) % 6];
            Leg { base: turn(l.platform), platform: turn(l.base) }
        });
        let found = Architecture::of(&apart(&other).unwrap());
        assert_eq!((found.leg_rank, found.jacobian.rank), (leg_rank, rank), "{name}");
        assert_eq!((found.findings[0].case.name(), found.findings[0].case.reason()), (name, reason));
    }
}

#[test]
fn lengths_of_poses_satisfy_every_dependency() {
    let mut rng = Rng::new(3);
    for Instance { name, m, .. } in instances() {
        let found = Architecture::of(&m);
        let position = Vector3::from_fn(|_, _| rng.uniform(-5.0, 5.0));
        let pose = Pose { rotation: random_rotation(&mut rng), position };
        let s = pose.squared_lengths(&m).unwrap();
        for d in &found.dependencies {
            assert!(d.defect(&s).abs() < 1e-13, "{name}");
            let mut longer = s.get();
            longer[d.legs[0]] += 1e-3;
            let longer = equipod::methods::manipulator::SquaredLegLengths::try_new(longer).unwrap();
            assert!(d.defect(&longer).abs() > 1e-9, "{name}");
        }
    }
}

#[test]
fn similar_affine_and_projective_hexagons_on_a_conic_are_told_apart() {
    let mut maps = Vec::new();
    for m in super::instances::conics() {
        let found = Architecture::of(&m);
        let Case::Conic { map } = found.findings[0].case else { panic!("{:?}", found.findings) };
        maps.push(map);
    }
    assert_eq!(maps, [PlanarMap::Similar, PlanarMap::Affine, PlanarMap::Projective]);
}

/// Coordinates with cosines: regular as doubles, singular as meant.
#[test]
fn a_regular_hexagon_in_doubles_is_singular_within_rounding_and_named() {
    let at = |r: f64, k: usize, turn: f64| {
        let phi = std::f64::consts::TAU * k as f64 / 6.0 + turn;
        Point3::new(r * phi.cos(), r * phi.sin(), 0.0)
    };
    let legs = std::array::from_fn(|k| Leg { base: at(2.0, k, 0.1), platform: at(1.3, k, 0.7) });
    let m = Manipulator::from_legs(legs).unwrap();
    let near = nearest_singular(&m, 1).unwrap().unwrap();
    assert!(near.within_rounding && near.distance < 1e-14, "{near:?}");
    assert_eq!(near.kind, "conic");
    // one joint further round the circle stays on the conic, but the bodies are no longer similar
    let mut legs = m.legs();
    legs[0].base = at(2.0, 0, 0.2);
    let near = nearest_singular(&Manipulator::from_legs(legs).unwrap(), 1).unwrap().unwrap();
    assert!(!near.within_rounding && near.distance > 1e-2, "{near:?}");
}

#[test]
fn extreme_units_and_far_origins_are_decided_the_same() {
    for (factor, shift) in [(2f64.powi(-600), 0.0), (2f64.powi(300), 0.0), (1.0, 2f64.powi(30))] {
        for Instance { name, m, leg_rank, rank, .. } in instances() {
            let place =
                |p: Point3<f64>| Point3::from((p.coords + Vector3::new(shift, -shift, shift)) * factor);
            let legs = m.legs().map(|l| Leg { base: place(l.base), platform: place(l.platform) });
            // sizes whose squares overflow or vanish are not designs
            let Ok(m) = apart(&legs) else { continue };
            let found = Architecture::of(&m);
            assert_eq!((found.leg_rank, found.jacobian.rank), (leg_rank, rank), "{name}, {factor} {shift}");
        }
    }
}

/// Joints on a small grid make every kind of coincidence; one pose in doubles knows nothing of the exact decision.
#[test]
fn crowded_designs_are_decided_as_doubles_see_them_and_get_a_name() {
    let mut rng = Rng::new(77);
    let (mut singular, mut by_lattice) = (0, 0);
    let mut names = std::collections::BTreeMap::new();
    for k in 0..GRIDS {
        // few places for many joints, on every fourth design in a line
        let mut palette = || -> Vec<Point3<f64>> {
            let line = rng.next_u64().is_multiple_of(4);
            (0..3 + k % 3)
                .map(|_| {
                    let mut digit = || (rng.next_u64() % 4) as f64;
                    if line { Point3::new(digit(), 1.0, 2.0) } else { Point3::new(digit(), digit(), digit()) }
                })
                .collect()
        };
        let (base, platform) = (palette(), palette());
        let mut pick = |from: &[Point3<f64>]| from[(rng.next_u64() % from.len() as u64) as usize];
        let legs: [Leg; 6] = std::array::from_fn(|_| Leg { base: pick(&base), platform: pick(&platform) });
        let Ok(m) = apart(&legs) else { continue };
        let found = Architecture::of(&m);
        let numeric = (0..3).map(|_| {
            let position = Vector3::from_fn(|_, _| rng.uniform(-2.0, 2.0));
            let pose = Pose { rotation: random_rotation(&mut rng), position };
            let s = equipod::methods::manipulator::plucker_matrix(&m, &pose, 1.0).singular_values();
            s.iter().filter(|x| **x > 1e-11 * s.max()).count()
        });
        assert_eq!(numeric.max(), Some(found.jacobian.rank), "{legs:?}");
        assert!(found.jacobian.rank <= found.leg_rank);
        for d in &found.dependencies {
            assert!(d.base_dimension + d.platform_dimension + 2 <= d.legs.len(), "{legs:?} {d:?}");
        }
        let is_singular = found.is_singular().unwrap();
        assert_eq!(is_singular, !found.findings.is_empty());
        singular += usize::from(is_singular);
        by_lattice += usize::from(is_singular && found.leg_rank == 6);
        for f in found.findings.iter().take(1) {
            assert!(!matches!(f.case, Case::Unnamed), "{legs:?}");
            *names.entry(f.case.name()).or_insert(0) += 1;
        }
    }
    assert!(singular > 20 && by_lattice > 0 && names.len() > 2, "{singular} {by_lattice} {names:?}");
}
