//! The class of platforms equivalent to the octahedral one: counts, maps, negative controls.

use std::collections::BTreeSet;

use equipod::methods::geom::{Pose, random_rotation};
use equipod::methods::manipulator::{LegLengths, Manipulator, Octahedral};
use equipod::methods::num::Rng;
use equipod::methods::synthesis::{
    Family, HexagonPoint, InstantiateError, LegMapTolerances, Offset, Pattern, Relation, Symmetry,
    edge_lengths, enumerate, joint_free, leg_map, moves, reachable, representative, sliding_body,
};
use nalgebra::{Matrix6, Point3};

const HEXAGON: [(usize, usize); 6] = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];

fn random_design(rng: &mut Rng) -> Manipulator {
    let mut triangle = |r: f64| {
        (0..3).map(|_| Point3::new(rng.normal(), rng.normal(), rng.normal()) * r).collect::<Vec<_>>()
    };
    let m = Manipulator::try_new(triangle(2.0), triangle(1.0), HEXAGON).unwrap();
    m.reordered([4, 1, 0, 3, 5, 2]).unwrap()
}

fn pattern(id: &str) -> Pattern {
    id.parse().unwrap()
}

/// Rank of `A` by plain elimination on random offsets: knows nothing of factors or expansions.
fn generic_rank(vertices: [bool; 6], inner: [u8; 6], rng: &mut Rng) -> usize {
    let mut rows: Vec<[f64; 6]> = Vec::new();
    for i in 0..6 {
        if vertices[i] {
            rows.push(std::array::from_fn(|j| f64::from(u8::from(i == j))));
        }
        for _ in 0..inner[i] {
            let t = rng.uniform(0.1, 0.4);
            rows.push(std::array::from_fn(|j| {
                if j == i {
                    1.0 - t
                } else if j == (i + 1) % 6 {
                    t
                } else {
                    0.0
                }
            }));
        }
    }
    let a = Matrix6::from_fn(|i, j| rows[i][j]);
    a.singular_values().iter().filter(|s| **s > 1e-9).count()
}

#[test]
fn counts_of_the_class() {
    let family = Family::octahedral();
    let c = family.counts();
    assert_eq!((c.patterns, c.classes, c.classes_exchange), (728, 138, 74));
    assert_eq!((c.topologies, c.topologies_exchange), (20, 13));
    assert_eq!((c.sequential_topologies, c.sequential_topologies_exchange), (19, 12));
    assert_eq!((c.sequential_patterns, c.splitting_patterns), (727, 320));
    for (exchange, classes) in [(false, 59), (true, 33)] {
        let orbits: BTreeSet<Pattern> = reachable(true).iter().map(|p| representative(p, exchange)).collect();
        assert_eq!(orbits.len(), classes);
    }
}

#[test]
fn patterns_are_exactly_the_generically_independent_choices() {
    let listed: BTreeSet<String> = enumerate().iter().map(Pattern::to_string).collect();
    let mut rng = Rng::new(2);
    let mut independent = 0;
    for code in 0..64 * 729usize {
        let vertices: [bool; 6] = std::array::from_fn(|i| code >> i & 1 == 1);
        let inner: [u8; 6] = std::array::from_fn(|k| (code / 64 / 3usize.pow(k as u32) % 3) as u8);
        let points =
            vertices.iter().filter(|v| **v).count() + inner.iter().map(|m| usize::from(*m)).sum::<usize>();
        if points != 6 {
            assert_eq!(Pattern::new(vertices, inner), None);
            continue;
        }
        let full = generic_rank(vertices, inner, &mut rng) == 6;
        let p = Pattern::new(vertices, inner);
        assert_eq!(p.is_some(), full, "{vertices:?} {inner:?}");
        if let Some(p) = p {
            independent += 1;
            assert!(listed.contains(&p.to_string()));
            assert!((0..6).all(|k| p.legs().iter().filter(|x| x.is_on_side(k)).count() <= 2));
        }
    }
    assert_eq!((independent, listed.len()), (728, 728));
}

#[test]
fn orbits_agree_with_the_lemma_of_burnside() {
    let all = enumerate();
    for exchange in [false, true] {
        let group: Vec<Symmetry> = Symmetry::all().filter(|s| exchange || s.keeps_bodies()).collect();
        let fixed: usize = group.iter().map(|s| all.iter().filter(|p| s.apply(p) == **p).count()).sum();
        let orbits: BTreeSet<Pattern> = all.iter().map(|p| representative(p, exchange)).collect();
        assert_eq!(orbits.len() * group.len(), fixed);
    }
}

#[test]
fn closed_form_map_is_the_least_squares_map_for_every_pattern() {
    let mut rng = Rng::new(9);
    for p in enumerate() {
        let m = random_design(&mut rng);
        let o = Octahedral::recognise(&m).unwrap();
        let t: Vec<f64> = p.offsets().iter().map(|_| rng.uniform(-0.6, 0.45)).collect();
        let (built, map) = (p.instantiate(&o, &t).unwrap(), p.leg_map(&o, &t).unwrap());
        let outcome = leg_map(&m, &built, LegMapTolerances::default()).unwrap();
        assert!(outcome.residual < 1e-12, "{p}");
        assert!((outcome.closest.a - map.a).norm() < 1e-8, "{p}");
        assert!((outcome.closest.c - map.c).norm() < 1e-8 * (1.0 + map.c.norm()), "{p}");
        let det = p.determinant(&t).unwrap();
        assert!((map.determinant() - det).abs() < 1e-12, "{p}: {} {det}", map.determinant());
        let pose =
            Pose { rotation: random_rotation(&mut rng), position: nalgebra::Vector3::new(0.3, -0.4, 6.0) };
        let want = pose.squared_lengths(&built).unwrap().get();
        let got = map.apply(&pose.squared_lengths(&m).unwrap()).unwrap().get();
        assert!(want.iter().zip(got).all(|(x, y)| (x - y).abs() < 1e-10 * (1.0 + x)), "{p}");
    }
}

#[test]
fn on_every_zero_of_the_determinant_the_platform_is_singular() {
    let mut rng = Rng::new(12);
    for (id, t) in [
        ("V23456S1", vec![1.0]),
        ("V13456S1", vec![0.0]),
        ("V3456S11", vec![0.3, 0.3]),
        ("V6S12345", vec![0.2, 0.3, 1.0, 0.1, 0.4]),
        ("S123456", vec![0.5; 6]),
        ("S123456", vec![0.2, 0.8, 0.3, 0.7, 0.6, 0.4]),
    ] {
        let m = random_design(&mut rng);
        let o = Octahedral::recognise(&m).unwrap();
        let p = pattern(id);
        assert!(p.determinant(&t).unwrap().abs() < 1e-15, "{id}");
        let built = p.instantiate(&o, &t).unwrap();
        let outcome = leg_map(&m, &built, LegMapTolerances::default()).unwrap();
        // joints that an edge does not hold exactly leave it open
        assert!(
            matches!(outcome.relation, Relation::Singular | Relation::Undecided),
            "{id}: {:?}",
            outcome.relation
        );
        let off: Vec<f64> =
            t.iter().enumerate().map(|(i, x)| if i == 0 { x + 0.01 } else { x * 0.9 }).collect();
        let outcome = leg_map(&m, &p.instantiate(&o, &off).unwrap(), LegMapTolerances::default()).unwrap();
        assert!(outcome.is_regular_within_rounding(), "{id}");
    }
}

#[test]
fn the_platform_without_shared_joints_is_the_only_one_that_needs_all_offsets_at_once() {
    let reached = reachable(false);
    let missing: Vec<String> =
        enumerate().iter().filter(|p| !reached.contains(p)).map(Pattern::to_string).collect();
    assert_eq!(missing, ["S123456"]);
    let free: Vec<String> =
        enumerate().iter().filter(|p| p.shared_joints().is_empty()).map(Pattern::to_string).collect();
    assert_eq!(free, ["S123456"]);
    // nothing leads into it by one move, from any pattern
    assert!(enumerate().iter().flat_map(moves).all(|step| step.to.to_string() != "S123456"));
}

#[test]
fn moves_change_the_topology_exactly_when_they_split_a_joint() {
    for p in enumerate().iter().filter(|p| p.inner().iter().sum::<u8>() < 4) {
        for step in moves(p) {
            let joints = |q: &Pattern| q.joints().iter().map(Vec::len).sum::<usize>();
            assert_eq!(joints(&step.to), joints(p) + usize::from(step.splits));
            assert_eq!(step.to.topology() != p.topology(), step.splits, "{p} to {}", step.to);
        }
    }
    // both legs of a pair, one after the other
    assert!(moves(&pattern("V23456S1")).iter().any(|s| s.to == pattern("V3456S11") && s.splits));
}

/// Two counts come out as twenty, and are different things; see the theory page.
#[test]
fn what_can_be_twenty() {
    let family = Family::octahedral();
    assert_eq!(family.topologies().len(), 20);
    let mut front = vec![pattern("V123456")];
    let mut simple: BTreeSet<Pattern> = front.iter().cloned().collect();
    while let Some(p) = front.pop() {
        for step in moves(&p) {
            if step.splits && step.to.inner().iter().all(|m| *m < 2) && simple.insert(step.to.clone()) {
                front.push(step.to);
            }
        }
    }
    let classes: BTreeSet<Pattern> = simple.iter().map(|p| representative(p, true)).collect();
    assert_eq!((simple.len(), classes.len() - 1), (197, 20));
}

#[test]
fn joint_free_reproduces_the_published_example_in_any_leg_order() {
    let h = 108f64.sqrt();
    let base = vec![Point3::new(0.0, 0.0, 0.0), Point3::new(6.0, h, 0.0), Point3::new(12.0, 0.0, 0.0)];
    let platform =
        vec![Point3::new(0.0, 0.0, 0.0), Point3::new(3.0, h / 2.0, 0.0), Point3::new(6.0, 0.0, 0.0)];
    let m = Manipulator::try_new(base, platform, HEXAGON).unwrap();
    let o = Octahedral::recognise(&m).unwrap();
    assert!(
        edge_lengths(&o).iter().zip([12.0, 6.0, 12.0, 6.0, 12.0, 6.0]).all(|(x, y)| (x - y).abs() < 1e-14)
    );
    // the offsets are distances: 2.4 on every base edge and 1.2 on every platform edge
    let edges = edge_lengths(&o);
    let t: [f64; 6] = std::array::from_fn(|k| sliding_body(k).of((2.4, 1.2)) / edges[k]);
    let (six_six, map) = joint_free(&o, t).unwrap();
    assert_eq!((six_six.base_joints().len(), six_six.platform_joints().len()), (6, 6));
    let l = LegLengths::try_new([19.8, 18.0, 18.0, 17.0, 14.9, 17.8]).unwrap();
    let got = map.apply(&l.squared()).unwrap().lengths().get();
    let published = [
        18.851_843_411_189_265,
        17.839_282_496_782_207,
        17.145_261_736_118_233,
        16.426_868_234_694_037,
        14.762_655_587_664_439,
        18.058_792_872_171_72,
    ];
    assert!(got.iter().zip(published).all(|(x, y)| (x - y).abs() < 1e-12 * y), "{got:?}");
    // legs in another order: the same platform, rows and columns follow the design
    let order = [0, 5, 4, 3, 2, 1];
    let other = m.reordered(order).unwrap();
    let (again, map2) = joint_free(&Octahedral::recognise(&other).unwrap(), t).unwrap();
    let direct = leg_map(&other, &again, LegMapTolerances::default()).unwrap();
    assert!((direct.closest.a - map2.a).norm() < 1e-12);
    assert_eq!(again.legs()[1].base, six_six.legs()[5].base);
}

#[test]
fn alignments_and_shared_joints_of_some_patterns() {
    let names = |p: &Pattern| {
        p.alignments()
            .iter()
            .map(|line| line.iter().map(ToString::to_string).collect::<Vec<_>>().join(" "))
            .collect::<Vec<_>>()
    };
    let octahedral = pattern("V123456");
    assert_eq!((octahedral.shared_joints().len(), names(&octahedral).len()), (6, 0));
    assert_eq!(names(&pattern("V23456S1")), ["P1 Q1 P2"]);
    // both legs of the pair moved: each corner still carries a leg
    assert_eq!(names(&pattern("V3456S11")), ["P1 Q1 Q1b P2"]);
    assert_eq!(names(&pattern("S123456")).len(), 6);
    assert!(pattern("V3456S11").legs().contains(&HexagonPoint::Inner(Offset { side: 0, second: true })));
}

#[test]
fn identifiers_read_back_and_nonsense_is_refused() {
    for p in enumerate() {
        assert_eq!(pattern(&p.to_string()), p);
    }
    for bad in ["", "V12345", "V123456S1", "V1234567", "S123455V6", "VV", "x", "V12S11122", "V1S112"] {
        assert!(bad.parse::<Pattern>().is_err(), "{bad}");
    }
    let o = Octahedral::recognise(&random_design(&mut Rng::new(1))).unwrap();
    let p = pattern("V23456S1");
    assert!(matches!(p.instantiate(&o, &[]), Err(InstantiateError::OffsetCount { expected: 1, given: 0 })));
    assert!(matches!(p.leg_map(&o, &[f64::NAN]), Err(InstantiateError::NotFinite { .. })));
}
