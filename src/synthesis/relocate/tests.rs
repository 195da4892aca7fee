//! Laws of moves, published moves, and moves that must fail.

use nalgebra::{Point3, Rotation3, Vector3};

use super::*;
use crate::components::{ComponentOptions, components};
use crate::{AffineLegMap, Relation, joint_free, leg_map};
use num::Rng;
use platform::geom::{Pose, random_rotation};
use platform::manipulator::Octahedral;

pub(super) fn corner(r: f64, k: usize) -> Point3<f64> {
    let (s, c) = (std::f64::consts::TAU * k as f64 / 3.0).sin_cos();
    Point3::new(r * c, r * s, 0.0)
}

pub(super) fn octahedral() -> Manipulator {
    let hexagon = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    Manipulator::from_legs(hexagon.map(|(i, j)| Leg { base: corner(2.0, i), platform: corner(1.0, j) }))
        .unwrap()
}

/// Multiples of 1/64: exact arithmetic on them is quick.
fn short(x: f64) -> f64 {
    (64.0 * x).round() / 64.0
}

fn p(rng: &mut Rng) -> Vector3<f64> {
    Vector3::new(rng.normal(), rng.normal(), rng.normal()).map(short)
}

/// The design of Rojas, Borras and Thomas, sec. 6: triangles of edge 12 and 6.
fn published() -> Manipulator {
    let h = 108f64.sqrt();
    let base = [Point3::origin(), Point3::new(6.0, h, 0.0), Point3::new(12.0, 0.0, 0.0)];
    let platform = [Point3::origin(), Point3::new(6.0, 0.0, 0.0), Point3::new(3.0, -h / 2.0, 0.0)];
    let hexagon = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    Manipulator::from_legs(hexagon.map(|(i, j)| Leg { base: base[i], platform: platform[j] })).unwrap()
}

/// Three legs between two lines, two at a platform joint, one anywhere.
fn mixed(rng: &mut Rng) -> Manipulator {
    let (o, d, q, e) = (p(rng), p(rng), p(rng), p(rng));
    let shared = p(rng);
    let legs: [Leg; 6] = std::array::from_fn(|k| match k {
        0..=2 => Leg {
            base: Point3::from(o + d * short(rng.uniform(-1.0, 1.0))),
            platform: Point3::from(q + e * short(rng.uniform(-1.0, 1.0))),
        },
        3 | 4 => Leg { base: Point3::from(p(rng)), platform: Point3::from(shared) },
        _ => Leg { base: Point3::from(p(rng)), platform: Point3::from(p(rng)) },
    });
    Manipulator::from_legs(legs).unwrap()
}

/// Joints of both bodies in planes.
fn planar(rng: &mut Rng) -> Manipulator {
    let mut flat = |z: f64| Point3::new(short(rng.normal()), short(rng.normal()), z);
    let legs: [Leg; 6] = std::array::from_fn(|_| Leg { base: flat(0.0), platform: flat(0.5) });
    Manipulator::from_legs(legs).unwrap()
}

fn families(m: &Manipulator) -> Components {
    components(m, ComponentOptions::default()).unwrap()
}

fn limits() -> LegMapTolerances {
    LegMapTolerances::default()
}

fn index(k: usize) -> LegIndex {
    LegIndex::new(k).unwrap()
}

fn single(
    m: &Manipulator,
    leg: usize,
    family: usize,
    parameters: &[f64],
) -> Result<Relocation, RelocateError> {
    within(m, &families(m), leg, family, parameters)
}

fn within(
    m: &Manipulator,
    found: &Components,
    leg: usize,
    family: usize,
    parameters: &[f64],
) -> Result<Relocation, RelocateError> {
    let step = LegMove { leg: index(leg), family, parameters: parameters.to_vec(), formulas: None };
    relocate(m, found, &[step], limits())
}

/// Whether `s' = A s + c` at random poses, by inverse kinematics alone.
fn holds(map: &AffineLegMap, from: &Manipulator, to: &Manipulator, rng: &mut Rng) -> bool {
    let unit = from.size().powi(2) * (1.0 + map.a.abs().max());
    (0..10).all(|_| {
        let pose = Pose { rotation: random_rotation(rng), position: p(rng) * from.size() };
        let s = pose.squared_lengths(from).unwrap();
        let expected = pose.squared_lengths(to).unwrap();
        let image = map.apply(&s).unwrap();
        image.get().iter().zip(expected.get()).all(|(x, y)| (x - y).abs() < 1e-9 * unit)
    })
}

/// The family over side `k` of the published hexagon, identified by places that never change.
fn side(octahedral: &Manipulator, current: &Manipulator, found: &Components, k: usize) -> usize {
    let legs = octahedral.legs();
    let (x, y) = (legs[k], legs[(k + 1) % 6]);
    let found = if k.is_multiple_of(2) {
        family_between(current, found, &[x.base, y.base], &[x.platform])
    } else {
        family_between(current, found, &[x.base], &[x.platform, y.platform])
    }
    .unwrap();
    assert_eq!(found.len(), 1);
    found[0]
}

#[test]
fn the_determinant_is_the_coefficient_of_the_leg_replaced_and_the_map_holds_at_all_poses() {
    let mut rng = Rng::new(3);
    let mut seen = 0;
    for m in [mixed(&mut rng), planar(&mut rng), published()] {
        let found = families(&m);
        for (k, family) in found.components.iter().enumerate() {
            let x = family.sample(&found.span, &mut rng).unwrap().unwrap().parameters;
            for leg in &family.support {
                let done = within(&m, &found, leg.get(), k, &x).unwrap();
                let moved = &done.moved[0];
                let c = moved.coefficients[leg.get()];
                assert!((done.map.determinant - c).abs() < 1e-10 * (1.0 + c.abs()));
                assert!(moved.residual < 1e-10);
                if !done.is_regular() {
                    continue;
                }
                let new = done.assembled.platform.as_ref().unwrap();
                assert!(holds(&done.map.closest, &m, new, &mut rng));
                let others =
                    LegIndex::all().filter(|l| l != leg).all(|l| new.legs()[l.get()] == m.legs()[l.get()]);
                assert!(others);
                seen += 1;
            }
        }
    }
    assert!(seen > 15, "{seen}");
}

#[test]
fn one_offset_is_the_published_formula() {
    let m = published();
    let found = families(&m);
    for (k, t) in [(0, 0.2), (1, -0.5), (2, 0.75), (5, 1.5)] {
        let family = side(&m, &m, &found, k);
        let done = within(
            &m,
            &found,
            k,
            family,
            &[if found.components[family].legs[0].get() == k { t } else { 1.0 - t }],
        );
        let done = done.unwrap();
        let d: f64 = if k % 2 == 0 { 12.0 } else { 6.0 };
        let (row, next) = (done.map.closest.a.row(k).into_owned(), (k + 1) % 6);
        // s' = (1 - t) s_k + t s_(k+1) - t (1 - t) d^2
        assert!((row[k] - (1.0 - t)).abs() < 1e-12 && (row[next] - t).abs() < 1e-12, "{row}");
        assert!((done.map.closest.c[k] + t * (1.0 - t) * d * d).abs() < 1e-11);
        assert!((done.map.determinant - (1.0 - t)).abs() < 1e-12);
    }
}

#[test]
fn all_six_together_are_the_joint_free_platform_of_the_paper() {
    let m = published();
    let found = families(&m);
    let together = |base: f64, platform: f64| {
        let moves: Vec<LegMove> = (0..6)
            .map(|k| {
                let family = side(&m, &m, &found, k);
                let t = if k % 2 == 0 { base } else { platform };
                let first = found.components[family].legs[0].get() == k;
                LegMove {
                    leg: index(k),
                    family,
                    parameters: vec![if first { t } else { 1.0 - t }],
                    formulas: None,
                }
            })
            .collect();
        relocate(&m, &found, &moves, limits()).unwrap()
    };
    // Delta1 = 12/5, Delta2 = 6/5
    let done = together(0.2, 0.2);
    assert!((done.map.determinant - (0.8f64.powi(6) - 0.2f64.powi(6))).abs() < 1e-12);
    let s =
        platform::manipulator::LegLengths::try_new([19.8, 18.0, 18.0, 17.0, 14.9, 17.8]).unwrap().squared();
    let l = done.map.closest.apply(&s).unwrap().lengths().get();
    let published = [
        18.851843411189265,
        17.839282496782207,
        17.145261736118233,
        16.426868234694037,
        14.762655587664439,
        18.05879287217172,
    ];
    assert!(l.iter().zip(published).all(|(x, y)| (x - y).abs() < 1e-12), "{l:?}");
    // the same matrix as by the pattern of six inner points
    let o = Octahedral::recognise(&m).unwrap();
    let (_, known) = joint_free(&o, [0.2; 6]).unwrap();
    assert!((done.map.closest.a - known.a).abs().max() < 1e-12);
    let new = done.assembled.platform.unwrap();
    assert_eq!((new.base_joints().len(), new.platform_joints().len()), (6, 6));
    // Delta1 + 2 Delta2 = 12: singular at all midpoints and at another pair, and regular slightly off
    for (base, platform) in [(0.5, 0.5), (0.25, 0.75)] {
        let done = together(base, platform);
        assert_eq!(done.map.relation, Relation::Singular);
        assert!(done.assembled.platform.is_ok());
        for moved in &done.moved {
            let SingularParameters::At(list) = &moved.singular else { panic!() };
            let here = moved.request.parameters[0];
            assert!(list.len() == 1 && (list[0] - here).abs() < 1e-9, "{list:?} {here}");
        }
        assert!(together(base, platform + 1e-4).is_regular());
    }
}

#[test]
fn one_after_another_reaches_it_too_but_the_last_move_has_no_second_leg_at_its_joint() {
    let m = published();
    let mut current = m.clone();
    let mut steps: Vec<Relocation> = Vec::new();
    for k in 0..6 {
        let found = families(&current);
        let sides = found.components.iter().filter(|c| c.type_name() == "point-line").count();
        assert_eq!(sides, 6, "the families are those of the first platform");
        let family = side(&m, &current, &found, k);
        // a move of the paper needs a second leg at the fixed joint; the sixth has none, and uses all six legs
        let (on_it, used) = (&found.components[family].legs, found.components[family].support.len());
        assert_eq!((on_it.len(), used), if k < 5 { (2, 2) } else { (1, 6) }, "{on_it:?}");
        // a fifth of the edge, counted from the places of the legs in the first platform
        let ends = [k, (k + 1) % 6].map(|l| m.legs()[l]);
        let (base, platform) = if k.is_multiple_of(2) { (2, 1) } else { (1, 2) };
        let formulas = counted_from(
            &found.components[family].parametrisation,
            &ends.map(|l| l.base)[..base],
            &ends.map(|l| l.platform)[..platform],
        );
        assert!(formulas.is_some());
        let step = LegMove { leg: index(k), family, parameters: vec![0.2], formulas };
        let done = relocate(&current, &found, &[step], limits()).unwrap();
        assert!(done.is_regular());
        current = done.assembled.platform.clone().unwrap();
        steps.push(done);
    }
    let chain = Chain::of(&m, &steps, limits()).unwrap();
    assert!(chain.disagreement < 1e-12, "{:e}", chain.disagreement);
    assert!((chain.composed.determinant() - 0.26208).abs() < 1e-12);
    // det A of the last step: the whole determinant over those of the first five, 0.8^5
    assert!((steps[5].map.determinant - 0.26208 / 0.8f64.powi(5)).abs() < 1e-12);
    let o = Octahedral::recognise(&m).unwrap();
    let (known, _) = joint_free(&o, [0.2; 6]).unwrap();
    let same = leg_map(&known, &current, limits()).unwrap();
    assert!((same.closest.a - nalgebra::Matrix6::identity()).abs().max() < 1e-12);
}

#[test]
fn a_move_and_its_inverse_give_the_design_back() {
    let mut rng = Rng::new(8);
    let m = mixed(&mut rng);
    let found = families(&m);
    let conic = found.components.iter().position(|c| c.type_name() == "line-line").unwrap();
    let there = single(&m, 1, conic, &[0.4]).unwrap();
    let moved = there.assembled.platform.clone().unwrap();
    let back = families(&moved);
    let family = back.components.iter().position(|c| c.type_name() == "line-line").unwrap();
    // the parameter of the old leg: its base end on the line, where t is affine
    let line = &back.components[family].parametrisation;
    let [x, y] = [0.0, 1.0].map(|t| line.leg_at(&[t]).unwrap().unwrap());
    let d = y.base - x.base;
    let t = (m.legs()[1].base - x.base).dot(&d) / d.norm_squared();
    let home = single(&moved, 1, family, &[t]).unwrap();
    let old = home.assembled.platform.clone().unwrap();
    for (a, b) in old.legs().iter().zip(m.legs()) {
        assert!((a.base - b.base).norm().max((a.platform - b.platform).norm()) < 1e-11);
    }
    let chain = Chain::of(&m, &[there, home], limits()).unwrap();
    assert!((chain.composed.a - nalgebra::Matrix6::identity()).abs().max() < 1e-10);
    assert!(chain.composed.c.abs().max() < 1e-10);
}

#[test]
fn frames_and_units_do_not_matter() {
    let mut rng = Rng::new(9);
    let m = mixed(&mut rng);
    let (r, q) = (Rotation3::new(p(&mut rng)), Rotation3::new(p(&mut rng)));
    let (u, v) = (p(&mut rng), p(&mut rng) * 5.0);
    let there = m.legs().map(|l| Leg {
        base: Point3::from((r * l.base + u).coords * 250.0),
        platform: Point3::from((q * l.platform + v).coords * 250.0),
    });
    let other = Manipulator::from_legs(there).unwrap();
    for leg in 0..5 {
        let of = |m: &Manipulator| {
            let found = families(m);
            let family = found.components.iter().position(|c| c.legs.contains(&index(leg))).unwrap();
            single(m, leg, family, &[0.3]).unwrap()
        };
        let (one, two) = (of(&m), of(&other));
        assert!((one.map.closest.a - two.map.closest.a).abs().max() < 1e-9);
        let (x, y) = (one.moved[0].to, two.moved[0].to);
        assert!(((r * x.base + u).coords * 250.0 - y.base.coords).norm() < 1e-9 * 250.0);
        let at = |s: &SingularParameters| match s {
            SingularParameters::At(list) => list.clone(),
            SingularParameters::Everywhere => panic!(),
        };
        let (a, b) = (at(&one.moved[0].singular), at(&two.moved[0].singular));
        assert!(a.len() == b.len() && a.iter().zip(&b).all(|(x, y)| (x - y).abs() < 1e-7), "{a:?} {b:?}");
    }
}

#[test]
fn at_singular_parameters_the_leg_depends_on_the_others() {
    let mut rng = Rng::new(10);
    for m in [mixed(&mut rng), planar(&mut rng)] {
        let found = families(&m);
        for (k, family) in found.components.iter().enumerate() {
            let leg = family.legs[0];
            let x = family.sample(&found.span, &mut rng).unwrap().unwrap().parameters;
            let SingularParameters::At(list) =
                within(&m, &found, leg.get(), k, &x).unwrap().moved[0].singular.clone()
            else {
                panic!("{}", family.type_name())
            };
            // on the two other legs of the family at least; on a cubic on all five others except a centre
            let least = if family.kind.name() == "over_cubic" { 4 } else { family.legs.len() - 1 };
            assert!(list.len() >= least, "{} {list:?}", family.type_name());
            for t in list {
                let done = within(&m, &found, leg.get(), k, &[t]).unwrap();
                assert!(!done.is_regular() || done.map.determinant.abs() < 1e-6, "{t}");
                assert!(within(&m, &found, leg.get(), k, &[t + 1e-3]).unwrap().is_regular());
            }
        }
    }
    // onto the place of another leg: singular
    let m = published();
    let found = families(&m);
    let done = within(&m, &found, 0, side(&m, &m, &found, 0), &[1.0]).unwrap();
    assert_eq!(done.map.relation, Relation::Singular);
    assert!(done.map.determinant.abs() < 1e-15);
}

#[test]
fn what_cannot_be_done_is_refused() {
    let mut rng = Rng::new(11);
    let m = mixed(&mut rng);
    let found = families(&m);
    let line = found.components.iter().position(|c| c.type_name() == "line-line").unwrap();
    let count = found.components.len();
    assert_eq!(within(&m, &found, 0, 99, &[0.5]), Err(RelocateError::NoSuchFamily { index: 99, count }));
    assert_eq!(
        within(&m, &found, 0, line, &[]),
        Err(RelocateError::ParameterCount { family: line, expected: 1, given: 0 })
    );
    // leg 6 belongs to no family
    assert_eq!(
        within(&m, &found, 5, line, &[0.5]),
        Err(RelocateError::NotCarried { leg: index(5), family: line })
    );
    let step = LegMove { leg: index(0), family: line, parameters: vec![0.5], formulas: None };
    assert_eq!(relocate(&m, &found, &[step.clone(), step], limits()), Err(RelocateError::Twice(index(0))));
    // the projective pairing has one leg with its platform end at infinity
    let pole = found.components[line].at_infinity[0];
    match within(&m, &found, 0, line, &[pole]) {
        Err(RelocateError::NoLeg { .. }) => {}
        Ok(far) => assert!(far.moved[0].to.platform.coords.norm() > 1e8), // the pole is rounded
        Err(e) => panic!("{e}"),
    }
}

#[test]
fn dyadic_joints_are_exact_and_rounded_ones_are_not() {
    let at = |x: f64, y: f64, z: f64| Point3::new(x, y, z);
    let legs = [
        Leg { base: at(0.0, 0.0, 0.0), platform: at(0.0, 0.0, 1.0) },
        Leg { base: at(3.0, 1.0, 0.0), platform: at(0.0, 0.0, 1.0) },
        Leg { base: at(1.0, 5.0, 2.0), platform: at(2.0, 0.5, 0.0) },
        Leg { base: at(-2.0, 3.0, 1.0), platform: at(-1.0, 2.0, 0.25) },
        Leg { base: at(-4.0, -1.0, 0.0), platform: at(1.0, -3.0, 0.5) },
        Leg { base: at(2.0, -3.0, 1.5), platform: at(-2.0, -1.0, 1.75) },
    ];
    let m = Manipulator::from_legs(legs).unwrap();
    let half = single(&m, 0, 0, &[0.5]).unwrap();
    assert!(half.moved[0].exact && half.moved[0].residual < 1e-15);
    let third = single(&m, 0, 0, &[1.0 / 3.0]).unwrap();
    assert!(!third.moved[0].exact && third.moved[0].residual < 1e-15);
}

#[test]
fn families_are_named_by_the_joints_that_span_them() {
    let m = published();
    let found = families(&m);
    for k in 0..6 {
        let family = side(&m, &m, &found, k);
        let [base, platform] = spanning_joints(&m, &found, family).unwrap().unwrap();
        assert_eq!((base.len(), platform.len()), if k % 2 == 0 { (2, 1) } else { (1, 2) });
    }
    let off = [Point3::new(1.0, 2.0, 3.0)];
    assert!(family_between(&m, &found, &off, &[m.legs()[0].platform]).unwrap().is_empty());
    assert!(family_between(&m, &found, &[], &[]).unwrap().is_empty());
}

#[test]
fn a_leg_that_leaves_a_shared_joint_splits_it_and_the_last_one_displaces_it() {
    let m = octahedral();
    let there = Leg { base: Point3::new(0.1, 0.2, 0.0), platform: corner(1.0, 0) };
    let one = Assembled::of(&m, &[Some(there), None, None, None, None, None]);
    assert_eq!(one.base[3], JointOrigin::Split(0));
    assert_eq!(one.platform_joints, [0, 1, 2].map(JointOrigin::Kept));
    assert_eq!(one.legs[0], there);
    // leg 6 was the other one at that base joint
    let mut legs = [Some(there), None, None, None, None, None];
    legs[5] = Some(Leg { base: Point3::new(-0.1, 0.2, 0.0), platform: corner(1.0, 2) });
    let both = Assembled::of(&m, &legs);
    assert_eq!(
        both.base,
        [JointOrigin::Displaced(0), JointOrigin::Kept(1), JointOrigin::Kept(2), JointOrigin::Split(0)]
    );
    assert_eq!(both.legs[5], legs[5].unwrap());
    // onto another joint, up to rounding: shared
    let shared = Leg { base: corner(2.0, 2) + Vector3::new(1e-14, 0.0, 0.0), platform: corner(1.0, 0) };
    let third = Assembled::of(&m, &[Some(shared), None, None, None, None, None]);
    assert_eq!(third.base.len(), 3);
    assert_eq!(third.legs[0].base, corner(2.0, 2));
    assert!(third.platform.is_ok());
    // onto another leg: two coincident legs
    let same = Leg { base: corner(2.0, 1), platform: corner(1.0, 0) };
    let twice = Assembled::of(&m, &[Some(same), None, None, None, None, None]).platform.unwrap();
    assert!((1..6).any(|leg| twice.pairs()[leg] == twice.pairs()[0]));
}
