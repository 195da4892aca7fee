//! Decisions that no tolerance may take: singular or regular, by exact arithmetic or not at all.

use equipod::methods::manipulator::{Leg, Manipulator, Octahedral};
use equipod::methods::num::Rng;
use equipod::methods::singularity::{Architecture, nearest_singular};
use equipod::methods::synthesis::{LegMapTolerances, Relation, joint_free, leg_map};
use nalgebra::Point3;

use super::evidence::size;
use crate::cli_frame::{document, equipod};

fn relation(from: &Manipulator, to: &Manipulator) -> Relation {
    leg_map(from, to, LegMapTolerances::default()).unwrap().relation
}

/// An octahedral platform with whole coordinates, triangles of some area.
fn whole_octahedral(rng: &mut Rng) -> Manipulator {
    let mut triangle = || loop {
        let p: Vec<Point3<f64>> =
            (0..3).map(|_| Point3::from([(); 3].map(|()| rng.uniform(-20.0, 20.0).round()))).collect();
        if (p[1] - p[0]).cross(&(p[2] - p[0])).norm() > 100.0 {
            return p;
        }
    };
    let (base, platform) = (triangle(), triangle());
    Manipulator::try_new(base, platform, [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)]).unwrap()
}

fn offset(m: &Manipulator, t: [f64; 6]) -> Manipulator {
    joint_free(&Octahedral::recognise(m).unwrap(), t).unwrap().0
}

#[test]
fn singular_is_said_of_designs_that_are_singular_as_the_numbers_they_are() {
    let mut rng = Rng::new(31);
    for _ in 0..20 {
        let m = whole_octahedral(&mut rng);
        // quarters of whole edges are exact; prod t = prod (1 - t)
        let t = if rng.uniform(0.0, 1.0) < 0.5 { [0.5; 6] } else { [0.25, 0.75, 0.5, 0.25, 0.75, 0.5] };
        let singular = offset(&m, t);
        assert_eq!(Architecture::of(&singular).is_singular(), Some(true));
        assert_eq!(relation(&m, &singular), Relation::Singular);
        assert_eq!(relation(&singular, &m), Relation::Singular);
    }
}

#[test]
fn regular_designs_near_the_singular_ones_are_not_called_singular() {
    let mut rng = Rng::new(32);
    let (mut equivalent, mut undecided) = (0, 0);
    for k in 0..60_usize {
        let m = whole_octahedral(&mut rng);
        let mut t = [0.5; 6];
        let power = 20 + i32::try_from(k).unwrap() / 2;
        t[k % 6] += 2f64.powi(-power);
        let near = offset(&m, t);
        assert_eq!(Architecture::of(&near).is_singular(), Some(false), "2^-{power}");
        match relation(&m, &near) {
            Relation::Equivalent => equivalent += 1,
            Relation::Undecided => undecided += 1,
            other => panic!("2^-{power}: {other:?}"),
        }
        // 1e-9 off the surface is a thousand times the possible rounding
        assert!(power > 32 || relation(&m, &near) == Relation::Equivalent, "2^-{power}");
    }
    assert!(equivalent >= 30, "{equivalent} equivalent, {undecided} undecided");
}

/// Joints of both bodies on two scales: three far apart, three within `small` of a point.
fn mixed_scales(rng: &mut Rng, small: f64) -> Manipulator {
    let centre: [[f64; 3]; 2] =
        [[(); 3].map(|()| rng.uniform(-1.0, 1.0)), [(); 3].map(|()| rng.uniform(-1.0, 1.0))];
    let mut leg = |k: usize| {
        let mut point = |body: usize| {
            let scale = if k < 3 { 1.0 } else { small };
            Point3::from(std::array::from_fn::<f64, 3, _>(|i| {
                let at = if k < 3 { 0.0 } else { centre[body][i] };
                at + scale * rng.uniform(-1.0, 1.0)
            }))
        };
        Leg { base: point(0), platform: point(1) }
    };
    Manipulator::from_legs(std::array::from_fn(&mut leg)).unwrap()
}

#[test]
fn a_design_of_mixed_scales_is_related_to_itself_regularly() {
    let mut rng = Rng::new(33);
    for k in 0..30 {
        let small = 10f64.powi(-3 - k / 3);
        let m = mixed_scales(&mut rng, small);
        assert_eq!(Architecture::of(&m).is_singular(), Some(false), "{small:e}");
        let found = leg_map(&m, &m, LegMapTolerances::default()).unwrap();
        assert_eq!((found.relation, found.leg_rank), (Relation::Equivalent, 6), "{small:e}");
        assert!((found.determinant - 1.0).abs() < 1e-6, "{small:e}: det {}", found.determinant);
        // a leg moved by a tenth of the size is another platform, whatever the scales
        let mut legs = m.legs();
        legs[0].base.x += 0.1;
        let moved = Manipulator::from_legs(legs).unwrap();
        assert_ne!(relation(&m, &moved), Relation::Equivalent, "{small:e}");
        assert_ne!(relation(&m, &moved), Relation::Singular, "{small:e}");
    }
}

/// Whole coordinates of flat bodies, with numbers far beyond or below them in some places. Four legs meet at one point
/// when the platform has to be singular.
fn extreme(rng: &mut Rng, others: &[f64], singular: bool) -> Manipulator {
    let places = 1 + (rng.next_u64() % 6) as usize;
    let mut legs: [Leg; 6] = std::array::from_fn(|_| {
        let mut point = || Point3::new(rng.uniform(-9.0, 9.0).round(), rng.uniform(-9.0, 9.0).round(), 0.0);
        Leg { base: point(), platform: point() }
    });
    for _ in 0..places {
        let (leg, axis) = ((rng.next_u64() % 6) as usize, (rng.next_u64() % 3) as usize);
        let value = others[(rng.next_u64() % others.len() as u64) as usize];
        let end = if rng.uniform(0.0, 1.0) < 0.5 { &mut legs[leg].base } else { &mut legs[leg].platform };
        end[axis] = value;
    }
    if singular {
        let point = legs[0].base;
        for (k, leg) in legs[1..4].iter_mut().enumerate() {
            leg.base = point;
            leg.platform.z += 1.0 + f64::from(u8::try_from(k).unwrap()); // no two legs become one
        }
    }
    Manipulator::from_legs(legs).unwrap()
}

#[test]
fn coordinates_of_any_magnitude_are_decided() {
    let mut rng = Rng::new(34);
    let mut singular = 0;
    let count = size(6, 24);
    for k in 0..count {
        let others: &[f64] = match k % 3 {
            0 => &[5e-324],
            1 => &[1e-300, 5e-324, 3e-310, 1e-17],
            _ => &[1e60, 1e-300, 7.3e59, 5e-324],
        };
        let m = extreme(&mut rng, others, k % 2 == 0);
        let found = Architecture::of(&m).is_singular().unwrap();
        assert!(found || k % 2 != 0, "four legs at one point: {m:?}");
        singular += usize::from(found);
    }
    assert!((count / 2..count).contains(&singular), "{singular} singular of {count}");
}

#[test]
fn the_design_with_long_numbers_is_decided() {
    let text = std::fs::read_to_string("tests/fixtures/adversarial/REP_checkslow.toml").unwrap();
    let (design, _) = equipod::methods::design::parse(&text, equipod::methods::design::Format::Toml).unwrap();
    assert_eq!(Architecture::of(design.manipulator()).is_singular(), Some(false));
    let found = nearest_singular(design.manipulator(), 1).unwrap();
    assert!(found.is_none_or(|n| n.distance.is_finite()));
}

/// Iterations over matrices with entries next to nothing have to end: `check` went on for minutes, or without end.
#[test]
fn check_ends_whatever_the_magnitudes() {
    let text = std::fs::read_to_string("tests/fixtures/adversarial/REP_checkslow.toml").unwrap();
    let folder = tempfile::tempdir().unwrap();
    let mut rng = Rng::new(35);
    for k in 0..size(6, 30) {
        // the zeros of the design become numbers of these magnitudes as well
        let tiny = ["5e-324", "2.5e-321", "1e-310", "3e-308", "1e-200", "1e-160"][k % 6];
        let mut drawn = String::new();
        for part in text.split_inclusive("0.0") {
            let replaced = part.ends_with("0.0") && rng.unit() < 0.3;
            drawn += &if replaced { part.replace("0.0", tiny) } else { part.to_owned() };
        }
        let path = folder.path().join(format!("{k}.toml"));
        std::fs::write(&path, drawn.replace("5e-324", tiny)).unwrap();
        let out = equipod(&["check", path.to_str().unwrap(), "--json"]);
        let code = out.status.code();
        assert!(matches!(code, Some(0 | 1 | 3)), "{k}: {out:?}");
        assert_eq!(
            document(&out)["architecturally_singular"].as_bool(),
            [Some(false), Some(true), None][[0, 1, 3].iter().position(|c| Some(*c) == code).unwrap()]
        );
    }
}
