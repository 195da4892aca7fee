//! Families of designs made to have them.

use nalgebra::{Point3, Rotation3, Vector3};

use super::form::Form;
use super::spectrum::unit;
use super::*;
use crate::{LegMapTolerances, leg_map};
use num::exact::{Rational, integer};
use num::surd::Surd;
use platform::manipulator::Leg;

/// A multiple of 1/64: sums and products of a few of them are exact.
fn dyadic(x: f64) -> f64 {
    (64.0 * x).round() / 64.0
}

fn p(rng: &mut Rng) -> Vector3<f64> {
    Vector3::new(rng.normal(), rng.normal(), rng.normal()).map(dyadic)
}

fn flat_point(origin: Vector3<f64>, axes: &[Vector3<f64>], rng: &mut Rng) -> Vector3<f64> {
    axes.iter().fold(origin, |x, e| x + e * dyadic(rng.uniform(-1.0, 1.0)))
}

/// Six legs, the first `count` of them exactly between flats of the given dimensions.
fn design(base: usize, platform: usize, count: usize, rng: &mut Rng) -> [Leg; 6] {
    let (o, q) = (p(rng), p(rng));
    let axes: [Vec<Vector3<f64>>; 2] = [base, platform].map(|d| (0..d).map(|_| p(rng)).collect());
    std::array::from_fn(|k| {
        if k < count {
            let (a, b) = (flat_point(o, &axes[0], rng), flat_point(q, &axes[1], rng));
            Leg { base: Point3::from(a), platform: Point3::from(b) }
        } else {
            Leg { base: Point3::from(p(rng)), platform: Point3::from(p(rng)) }
        }
    })
}

fn found(legs: &[Leg; 6]) -> Components {
    within(legs, 1e-9)
}

fn within(legs: &[Leg; 6], tolerance: f64) -> Components {
    let m = Manipulator::from_legs(*legs).unwrap();
    components(&m, ComponentOptions { tolerance, seed: 1 }).unwrap()
}

/// Type, kind, dimension and legs (from 1) of every family.
fn list(c: &Components) -> Vec<(String, &'static str, usize, Vec<usize>)> {
    let legs = |c: &Component| c.legs.iter().map(|l| l.get() + 1).collect();
    c.components.iter().map(|c| (c.type_name(), c.kind.name(), c.dimension, legs(c))).collect()
}

/// Draws legs of every family and checks them against the span, and their formulas against the design's legs.
fn check_samples(c: &Components, limit: f64) {
    let mut rng = Rng::new(77);
    for family in &c.components {
        for _ in 0..6 {
            let s = family.sample(&c.span, &mut rng).unwrap().expect("a leg of the family");
            assert!(s.residual < limit, "{} {}: {:e}", family.type_name(), family.kind.name(), s.residual);
            if c.leg_rank.value == 6 && limit < 1e-8 {
                let sum: f64 = s.coefficients.iter().sum();
                let size = s.coefficients.iter().fold(1.0f64, |m, c| m.max(c.abs()));
                assert!((sum - 1.0).abs() < 1e-8 * size, "{sum}");
            }
        }
    }
}

fn one(c: &Components, kind: &str, of: &str, dimension: usize, legs: &[usize]) {
    assert_eq!(
        list(c),
        [(
            of.to_string(),
            match kind {
                "all_pairs" => "all_pairs",
                "over_line" => "over_line",
                "over_conic" => "over_conic",
                "over_plane" => "over_plane",
                _ => "over_cubic",
            },
            dimension,
            legs.to_vec()
        )]
    );
    assert!(c.doubts.is_empty(), "{:?}", c.doubts);
    check_samples(c, 1e-9);
}

/// The test of `one`, confirmed by exact arithmetic.
fn one_exactly(c: &Components, kind: &str, of: &str, dimension: usize, legs: &[usize]) {
    one(c, kind, of, dimension, legs);
    assert_eq!(c.components[0].exact, Some(true));
    assert!(c.components[0].decisions.iter().all(|d| d.agrees() != Some(false)));
    assert!(c.pairs.iter().all(|p| p.reading == Reading::Both));
}

#[test]
fn a_general_design_has_none() {
    let c = found(&design(3, 3, 6, &mut Rng::new(1)));
    assert!(c.components.is_empty() && c.doubts.is_empty() && c.leg_rank.value == 6);
    // space and plane: none either, and this is proved
    let c = found(&design(2, 3, 6, &mut Rng::new(2)));
    assert!(c.components.is_empty() && c.doubts.is_empty(), "{:?} {:?}", list(&c), c.doubts);
    let c = found(&design(3, 2, 6, &mut Rng::new(3)));
    assert!(c.components.is_empty() && c.doubts.is_empty(), "{:?} {:?}", list(&c), c.doubts);
}

#[test]
fn shared_joints_carry_lines_planes_and_space() {
    let mut rng = Rng::new(4);
    for (count, of) in [(2, "point-line"), (3, "point-plane"), (4, "point-space")] {
        let legs = design(0, 3, count, &mut rng);
        let c = found(&legs);
        let all: Vec<usize> = (1..=count).collect();
        // with four legs at a joint the other legs gain families of their own: every platform point pairs with the
        // joint
        let top = c.components.iter().max_by_key(|x| x.dimension).unwrap();
        assert_eq!((top.type_name().as_str(), top.dimension, top.base_span), (of, count - 1, 0));
        assert_eq!(top.legs.iter().map(|l| l.get() + 1).collect::<Vec<_>>(), all);
        assert_eq!(top.exact, Some(true));
        let inside = c.components.iter().filter(|x| !x.contained_in.is_empty()).count();
        assert_eq!(inside, [0, 3, 10][count - 2], "{:?}", list(&c));
        check_samples(&c, 1e-12);
        // the two first legs are at t = 0 and t = 1
        let line = &c.components[0];
        let at = |t: f64| line.parametrisation.leg_at(&[t]).unwrap().unwrap();
        for (t, k) in [(0.0, line.legs[0]), (1.0, line.legs[1])] {
            assert!((at(t).platform - legs[k.get()].platform).norm() < 1e-12);
        }
    }
}

/// Four legs at one point, and three at a point with two more from a line through it: the common zeros of the minors
/// coincide there, and an exact bound excludes others.
#[test]
fn legs_at_one_point_leave_nothing_undecided() {
    let mut rng = Rng::new(19);
    let four = design(0, 3, 4, &mut rng);
    let mut star = design(0, 3, 3, &mut rng);
    let direction = p(&mut rng);
    for (k, t) in [(3, 1.5), (4, -0.75)] {
        star[k] = Leg { base: star[0].base + direction * t, platform: star[5].platform + direction };
    }
    let exchanged = |legs: [Leg; 6]| legs.map(|leg| Leg { base: leg.platform, platform: leg.base });
    for legs in [four, exchanged(four), star, exchanged(star)] {
        let c = found(&legs);
        assert!(c.doubts.is_empty(), "{:?}", c.doubts);
        assert!(c.components.iter().all(|family| family.exact == Some(true)));
        // all legs at the point, and a line of legs at each of two joints of the other body
        let largest: Vec<_> =
            c.components.iter().filter(|x| x.contained_in.is_empty()).map(|x| x.dimension).collect();
        assert_eq!(largest, [1, 1, 3], "{:?}", list(&c));
    }
}

#[test]
fn flats_of_every_pair_of_dimensions() {
    let mut rng = Rng::new(5);
    let legs = design(1, 1, 3, &mut rng);
    one_exactly(&found(&legs), "over_line", "line-line", 1, &[1, 2, 3]);
    one_exactly(&found(&design(1, 1, 4, &mut rng)), "all_pairs", "line-line", 2, &[1, 2, 3, 4]);
    one_exactly(&found(&design(1, 2, 4, &mut rng)), "over_line", "line-plane", 1, &[1, 2, 3, 4]);
    one_exactly(&found(&design(2, 1, 4, &mut rng)), "over_line", "line-plane", 1, &[1, 2, 3, 4]);
    one_exactly(&found(&design(1, 2, 5, &mut rng)), "over_line", "line-plane", 2, &[1, 2, 3, 4, 5]);
    one_exactly(&found(&design(1, 2, 6, &mut rng)), "all_pairs", "line-plane", 3, &[1, 2, 3, 4, 5, 6]);
    one_exactly(&found(&design(1, 3, 5, &mut rng)), "over_line", "line-space", 1, &[1, 2, 3, 4, 5]);
    one_exactly(&found(&design(3, 1, 6, &mut rng)), "over_line", "line-space", 2, &[1, 2, 3, 4, 5, 6]);
    one_exactly(&found(&design(2, 2, 6, &mut rng)), "over_cubic", "plane-plane", 1, &[1, 2, 3, 4, 5, 6]);
    // five legs between planes: a sixth point, no family
    assert!(found(&design(2, 2, 5, &mut rng)).components.is_empty());
}

#[test]
fn degrees_of_the_formulas() {
    let mut rng = Rng::new(6);
    for (i, j, count, degrees) in [(1, 1, 3, (1, 1)), (1, 2, 4, (1, 2)), (1, 3, 5, (1, 3))] {
        let c = found(&design(i, j, count, &mut rng));
        let Parametrisation::Rational { base, platform, .. } = &c.components[0].parametrisation else {
            panic!()
        };
        assert_eq!((base.degree(), platform.degree()), degrees);
    }
}

#[test]
fn a_pairing_of_rank_one_is_two_point_line_families() {
    let mut rng = Rng::new(8);
    let mut legs = design(1, 1, 3, &mut rng);
    legs[1].base = legs[0].base;
    let c = found(&legs);
    let all = list(&c);
    assert_eq!(all.len(), 2);
    assert_eq!(all[0], ("point-line".into(), "all_pairs", 1, vec![1, 2]));
    // its platform joint is that of leg 3 only, and its other leg does not belong to the design
    assert_eq!(all[1], ("point-line".into(), "all_pairs", 1, vec![3]));
    assert_eq!(c.components[1].support.len(), 3);
    check_samples(&c, 1e-12);
}

#[test]
fn affinely_related_hexagons_have_a_surface() {
    let mut rng = Rng::new(9);
    let mut legs = design(2, 2, 6, &mut rng);
    let (r, s) = (p(&mut rng), p(&mut rng));
    for leg in &mut legs {
        let d = leg.base - legs_origin();
        leg.platform = Point3::from(r * d.x + s * d.y + Vector3::new(0.25, 0.125, -0.5));
    }
    let c = found(&legs);
    one_exactly(&c, "over_plane", "plane-plane", 2, &[1, 2, 3, 4, 5, 6]);
    assert_eq!((c.planes[0].base.generic_rank, c.planes[0].platform.generic_rank), (2, 2));
}

fn legs_origin() -> Point3<f64> {
    Point3::new(0.125, 0.25, 0.375)
}

#[test]
fn conics_and_twisted_cubics_that_no_count_of_dimensions_announces() {
    let mut rng = Rng::new(10);
    let t = [-1.3, -0.7, -0.2, 0.4, 0.9, 1.6];
    // five legs between projectively related pentagons
    let mut legs = design(3, 3, 0, &mut rng);
    for (leg, t) in legs.iter_mut().zip(&t[..5]) {
        let w = 2.0 + 0.3 * t;
        leg.base = Point3::new(*t, t * t, 0.0);
        leg.platform = Point3::new((1.0 + t) / w, (t * t - t) / w, 0.5);
    }
    one(&found(&legs), "over_conic", "plane-plane", 1, &[1, 2, 3, 4, 5]);
    // another fifth joint: no family
    legs[4].platform.x += 0.1;
    assert!(found(&legs).components.is_empty());
    // a conic and a twisted cubic
    for (leg, t) in legs.iter_mut().zip(&t) {
        leg.base = Point3::new(*t, t * t, 0.2 * t);
        leg.platform = Point3::new(*t, t * t, t * t * t);
    }
    one(&found(&legs), "over_conic", "plane-space", 1, &[1, 2, 3, 4, 5, 6]);
    legs[4].platform.x += 0.1;
    assert!(found(&legs).components.is_empty());
}

#[test]
fn two_pairings_whose_base_lines_meet_carry_a_third_family_over_no_joint() {
    let mut rng = Rng::new(11);
    let (o, d, e) = (p(&mut rng), p(&mut rng), p(&mut rng));
    let mut legs = design(3, 3, 6, &mut rng);
    let lines = [p(&mut rng), p(&mut rng), p(&mut rng), p(&mut rng)];
    for k in 0..6 {
        let s = dyadic(rng.uniform(0.5, 2.0));
        let t = dyadic(rng.uniform(-1.0, 1.0));
        legs[k].base = Point3::from(o + if k < 3 { d } else { e } * s);
        let (q, f) = if k < 3 { (lines[0], lines[1]) } else { (lines[2], lines[3]) };
        legs[k].platform = Point3::from(q + f * t);
    }
    let c = found(&legs);
    let all = list(&c);
    assert_eq!(all.len(), 3, "{all:?}");
    assert_eq!(all[0], ("point-line".into(), "all_pairs", 1, vec![]));
    assert!(c.components.iter().all(|x| x.exact == Some(true)));
    assert_eq!(all[1], ("line-line".into(), "over_line", 1, vec![1, 2, 3]));
    assert_eq!(all[2], ("line-line".into(), "over_line", 1, vec![4, 5, 6]));
    let s = c.components[0].sample(&c.span, &mut rng).unwrap().unwrap();
    assert!((s.leg.base.coords - o).norm() < 1e-9 && c.components[0].support.len() == 6);
    assert!(c.doubts.is_empty(), "{:?}", c.doubts);
    check_samples(&c, 1e-9);
}

#[test]
fn six_sampled_legs_are_an_equivalent_platform_and_a_point_off_the_cubic_is_not_replaceable() {
    let mut rng = Rng::new(12);
    let legs = design(2, 2, 6, &mut rng);
    let c = found(&legs);
    assert_eq!(c.planes[0].smooth, Some(true));
    let family = &c.components[0];
    let new: Vec<Leg> = (0..6).map(|_| family.sample(&c.span, &mut rng).unwrap().unwrap().leg).collect();
    let from = Manipulator::from_legs(legs).unwrap();
    let to = Manipulator::from_legs(std::array::from_fn(|k| new[k])).unwrap();
    let map = leg_map(&from, &to, LegMapTolerances::default()).unwrap();
    assert!(map.is_regular_within_rounding());
    assert!(map.residual < 1e-10 && map.determinant.abs() > 1e-9);
    // at 1e-3 of the size off the cubic no platform point is a partner
    let planes = &c.planes[0];
    let mut off = new[0];
    off.base += planes.base.axes[0] * 1e-3;
    assert!(c.span.distance(&off) > 1e-6);
    let d = off.base - planes.base.origin;
    let x = planes.base.axes.map(|a| a.dot(&d) / a.norm_squared());
    let cubic = Form { degree: planes.base.degree, coefficients: planes.base.coefficients.clone() };
    assert!(cubic.value(&unit(&[1.0, x[0], x[1]])).abs() > 1e-6 * cubic.norm());
    let partners = planes.partners(platform::manipulator::Body::Base, [1.0, x[0], x[1]], 1e-8).unwrap();
    assert_eq!(partners, Partners::None);
    // and on the cubic the partner is the platform end
    let d = new[0].base - planes.base.origin;
    let x = planes.base.axes.map(|a| a.dot(&d) / a.norm_squared());
    let Partners::Point(b) =
        planes.partners(platform::manipulator::Body::Base, [1.0, x[0], x[1]], 1e-8).unwrap()
    else {
        panic!("a point")
    };
    let place = planes.platform.origin
        + planes.platform.axes[0] * (b[1] / b[0])
        + planes.platform.axes[1] * (b[2] / b[0]);
    assert!((place - new[0].platform).norm() < 1e-8);
}

#[test]
fn a_joint_off_by_a_millionth_keeps_the_family_within_the_tolerance_only() {
    let corner = |r: f64, k: usize| {
        let (s, c) = (std::f64::consts::TAU * k as f64 / 3.0).sin_cos();
        Point3::new(r * c, r * s, 0.0)
    };
    let hexagon = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    let mut legs = hexagon.map(|(i, j)| Leg { base: corner(2.0, i), platform: corner(1.0, j) });
    let six = |c: &Components, exact| {
        c.components.iter().filter(|x| x.exact == exact && x.type_name() == "point-line").count()
    };
    assert_eq!(six(&found(&legs), Some(true)), 6);
    // along an edge the new joint gives another member of the class: the sixth side is over the intersection of edges
    let mut slid = legs;
    slid[0].base += (legs[1].base - legs[0].base) * 1e-6;
    assert_eq!(list(&found(&slid)).len(), 6);
    // out of the plane, the line of partners of the shared corner disappears
    legs[0].base.z += 2e-6;
    let strict = found(&legs);
    assert_eq!((six(&strict, Some(true)), six(&strict, Some(false))), (5, 0), "{:?}", list(&strict));
    let loose = within(&legs, 1e-5);
    assert_eq!((six(&loose, Some(true)), six(&loose, Some(false))), (5, 1), "{:?}", list(&loose));
    let near = loose.components.iter().find(|x| x.exact == Some(false)).unwrap();
    let decided: Vec<&Decision> = near.decisions.iter().filter(|d| d.agrees() == Some(false)).collect();
    let gap = decided.iter().all(|d| d.below.is_some_and(|b| (1e-8..1e-5).contains(&b)));
    assert!(gap && !decided.is_empty(), "{:?}", near.decisions);
    check_samples(&loose, 1e-3);
}

#[test]
fn frames_order_unit_and_exchange_of_the_bodies_do_not_matter() {
    let mut rng = Rng::new(13);
    for (i, j, count) in [(1, 2, 4), (2, 2, 6), (0, 3, 3), (1, 3, 6)] {
        let legs = design(i, j, count, &mut rng);
        let plain = found(&legs);
        let (r, q) = (Rotation3::new(p(&mut rng)), Rotation3::new(p(&mut rng)));
        let (u, v) = (p(&mut rng), p(&mut rng) * 10.0);
        // rotations round the joints, so flats hold to 1e-15
        let moved = legs.map(|l| Leg { base: r * l.base + u, platform: q * l.platform + v });
        let key = |c: &Components| {
            c.components.iter().map(|x| (x.type_name(), x.kind.name(), x.dimension)).collect::<Vec<_>>()
        };
        let flats =
            |c: &Components| c.components.iter().map(|x| (x.base_span, x.platform_span)).collect::<Vec<_>>();
        assert_eq!(key(&plain), key(&found(&moved)));
        let scaled = legs.map(|l| Leg { base: l.base * 1024.0, platform: l.platform * 1024.0 });
        assert_eq!(key(&plain), key(&found(&scaled)));
        assert_eq!(key(&plain), key(&found(&[4, 2, 0, 5, 1, 3].map(|k: usize| legs[k]))));
        let turned = found(&legs.map(|l| Leg { base: l.platform, platform: l.base }));
        let mut exchanged: Vec<(usize, usize)> = flats(&turned).iter().map(|(a, b)| (*b, *a)).collect();
        let mut spans = flats(&plain);
        exchanged.sort_unstable();
        spans.sort_unstable();
        assert_eq!((key(&plain), spans), (key(&turned), exchanged));
    }
}

#[test]
fn joints_nearly_on_a_line_and_nearly_in_a_plane_are_told_from_those_that_are() {
    let mut rng = Rng::new(14);
    // a plane 2^-20 wide: as good as any other plane, exactly and in numbers
    let mut legs = design(2, 2, 6, &mut rng);
    for leg in &mut legs {
        leg.base = Point3::new(leg.base.x, leg.base.y / 1_048_576.0, 0.0);
    }
    let c = found(&legs);
    one_exactly(&c, "over_cubic", "plane-plane", 1, &[1, 2, 3, 4, 5, 6]);
    assert_eq!(c.planes[0].smooth, Some(true));
    // within 1e-4 the base is a line, and then every pair of points is replaceable
    let c = within(&legs, 1e-4);
    let kinds: Vec<_> = c.components.iter().map(|x| (x.type_name(), x.dimension, x.exact)).collect();
    let line = ("line-plane".to_string(), 3, Some(false));
    assert!(
        kinds.contains(&line) && kinds.contains(&("plane-plane".to_string(), 1, Some(true))),
        "{kinds:?}"
    );
    let pair = c.pairs.iter().find(|p| p.base == 1).unwrap();
    assert_eq!((pair.reading, pair.rank), (Reading::ToleranceOnly, 6));
    let d = pair.decisions.iter().find(|d| d.question == Question::BaseDimension).unwrap();
    assert!(d.agrees() == Some(false) && d.below.unwrap() < 1e-5 && d.above.unwrap() > 0.1);
}

#[test]
fn dependent_legs_are_said_to_be_dependent() {
    let mut rng = Rng::new(15);
    let mut legs = design(3, 3, 6, &mut rng);
    (legs[1].base, legs[2].base) = (legs[0].base, legs[0].base);
    legs[2].platform = nalgebra::center(&legs[0].platform, &legs[1].platform);
    let c = found(&legs);
    assert_eq!((c.leg_rank.value, c.leg_rank.exact), (5, Some(5)));
    one(&c, "all_pairs", "point-line", 1, &[1, 2, 3]);
    assert_eq!(c.components[0].exact, Some(true));
    // with rounding errors the three are independent as doubles, which decides the rank, and a plane of legs is exact
    legs[2].platform.x += 1e-15;
    let c = found(&legs);
    assert_eq!((c.leg_rank.value, c.leg_rank.numerical, c.leg_rank.exact), (6, 5, Some(6)));
    assert!(
        c.doubts.iter().any(|doubt| doubt.contains("rank 6, of rank 5 within the tolerance")),
        "{:?}",
        c.doubts
    );
    let kinds: Vec<_> = c.components.iter().map(|x| (x.type_name(), x.exact)).collect();
    assert!(kinds.contains(&("point-plane".to_string(), Some(true))), "{kinds:?}");
}

/// The member of the class of two fixed triangles with offsets `t` on the sides of the leg hexagon, exactly. The legs
/// are in the order `order`.
fn member(t: &[Rational; 6], order: [usize; 6]) -> Manipulator {
    let corner = |x: i64, y: i64| [integer(x), integer(y), integer(0)];
    let base = [corner(0, 0), corner(16, 0), corner(4, 12)];
    let platform = [corner(0, 0), corner(8, 4), corner(-4, 8)];
    let hexagon = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    let between = |p: &[Rational; 3], q: &[Rational; 3], t: &Rational| {
        [0, 1, 2].map(|k| Surd::rational(&(&p[k] + (&q[k] - &p[k]) * t)).unwrap())
    };
    let ends = order.map(|k| {
        let ((i, j), (l, n)) = (hexagon[k], hexagon[(k + 1) % 6]);
        [between(&base[i], &base[l], &t[k]), between(&platform[j], &platform[n], &t[k])]
    });
    Manipulator::from_exact_ends(&ends).unwrap()
}

/// All members of a class have the families of its octahedral platform, however near to a singular one they are: then
/// their doubles are singular, and have others.
#[test]
fn exact_joints_have_the_families_of_their_class_next_to_singular_members() {
    let half = || Rational::new(1.into(), 2.into());
    let trace = |digits: u32| Rational::new(1.into(), num_bigint::BigInt::from(10).pow(digits));
    for (digits, order) in [
        (6, [0, 1, 2, 3, 4, 5]),
        (10, [3, 5, 1, 0, 2, 4]),
        (13, [5, 4, 3, 2, 1, 0]),
        (30, [2, 0, 4, 1, 5, 3]),
    ] {
        let offsets: [Rational; 6] =
            std::array::from_fn(|k| if k == 5 { half() + trace(digits) } else { half() });
        let c = components(&member(&offsets, order), ComponentOptions::default()).unwrap();
        assert!(c.doubts.is_empty(), "{digits}: {:?}", c.doubts);
        assert_eq!((c.leg_rank.value, c.planes.len()), (6, 1), "{digits}");
        let six =
            |of: &str| c.components.iter().filter(|x| x.type_name() == of && x.exact == Some(true)).count();
        assert_eq!((six("point-line"), c.components.len()), (6, 6), "{digits}: {:?}", list(&c));
        assert!(c.components.iter().all(|x| x.support.len() == 6), "{digits}");
        check_samples(&c, 1e-12);
        // both curves are the sides of the triangles, in numbers as well as exactly
        for curve in [&c.planes[0].base, &c.planes[0].platform] {
            let lines = curve.parts.iter().filter(|p| p.kind == PartKind::Line).count();
            let exact =
                curve.exact.as_ref().unwrap().parts.iter().filter(|p| p.kind == ExactKind::Line).count();
            assert_eq!((lines, exact), (3, 3), "{digits}: {:?}", curve.parts);
        }
    }
}

/// Exact joints are not rounded: families that they have within the tolerance only are not theirs.
#[test]
fn exact_joints_have_no_families_within_the_tolerance() {
    let offsets: [Rational; 6] = [2, 3, 4, 5, 6, 7].map(|k: i64| Rational::new(k.into(), 10.into()));
    let m = member(&offsets, [0, 1, 2, 3, 4, 5]);
    let mut ends = m.exact_ends().unwrap();
    let trace = Surd::rational(&Rational::new(1.into(), num_bigint::BigInt::from(10).pow(12))).unwrap();
    // one joint leaves its edge: the six lines are five and a cubic, or a line and a conic
    ends[0][0][1] = ends[0][0][1].plus(&trace).unwrap();
    let c = components(&Manipulator::from_exact_ends(&ends).unwrap(), ComponentOptions::default()).unwrap();
    assert!(c.components.iter().all(|x| x.exact != Some(false)), "{:?}", list(&c));
    assert!(c.pairs.iter().all(|p| p.reading != Reading::ToleranceOnly));
}

/// Two families over the ends `(sqrt 2, ..)` and `(-sqrt 2, ..)` of a base line, with conjugate platform lines through
/// a common joint.
#[test]
fn conjugate_lines_without_joints_are_exact() {
    let base = [(0, 0), (3, 0), (3, 3), (-3, 3), (-2, 1), (1, 2)];
    let platform = [(0, 0), (0, 0), (1, -3), (-3, -3), (3, -3), (0, -3)];
    let at = |p: (i32, i32)| Point3::new(f64::from(p.0), f64::from(p.1), 0.0);
    let legs: [Leg; 6] = std::array::from_fn(|k| Leg { base: at(base[k]), platform: at(platform[k]) });
    let c = found(&legs);
    let kinds =
        |curve: &PlaneCurve| curve.exact.as_ref().unwrap().parts.iter().map(|p| p.kind).collect::<Vec<_>>();
    assert_eq!(kinds(&c.planes[0].platform), [ExactKind::Line, ExactKind::RealLines]);
    assert_eq!(kinds(&c.planes[0].base), [ExactKind::Line, ExactKind::Conic]);
    let over_no_joints: Vec<&Component> =
        c.components.iter().filter(|x| x.legs.is_empty() && x.type_name() == "point-line").collect();
    assert_eq!(over_no_joints.len(), 2, "{:?}", list(&c));
    assert!(c.components.iter().all(|x| x.exact == Some(true)), "{:?}", list(&c));
    assert!(c.doubts.is_empty(), "{:?}", c.doubts);
    check_samples(&c, 1e-9);
}

#[test]
fn conics_are_exact_or_denied() {
    let t = [-1.25, -0.75, -0.25, 0.5, 1.0, 1.5];
    let mut legs = design(3, 3, 0, &mut Rng::new(10));
    for (leg, t) in legs.iter_mut().zip(&t[..5]) {
        leg.base = Point3::new(*t, t * t, 0.0);
        leg.platform = Point3::new(2.0 * t + t * t, t - 3.0 * t * t, 0.5);
    }
    one_exactly(&found(&legs), "over_conic", "plane-plane", 1, &[1, 2, 3, 4, 5]);
    let mut twisted = legs;
    for (leg, t) in twisted.iter_mut().zip(&t) {
        leg.base = Point3::new(*t, t * t, 0.5 * t);
        leg.platform = Point3::new(*t, t * t, t * t * t);
    }
    one_exactly(&found(&twisted), "over_conic", "plane-space", 1, &[1, 2, 3, 4, 5, 6]);
    // disturbed by more than rounding and less than the tolerance
    legs[4].platform.x += 1e-12;
    let c = found(&legs);
    assert_eq!(list(&c).len(), 1);
    assert_eq!(c.components[0].exact, Some(false));
}
