//! Searches with a known answer.

use nalgebra::Point3;

use super::super::tests::{corner, octahedral};
use super::*;
use crate::components::{ComponentOptions, components};
use crate::{LegMapTolerances, leg_map};
use platform::geom::Pose;
use platform::manipulator::{Body, Leg, LegIndex, Manipulator, default_home};

/// Four legs in pairs at two platform joints, two others: only the two pairs can be moved.
fn six_four() -> Manipulator {
    let at = |x: f64, y: f64, z: f64| Point3::new(x, y, z);
    let base = [
        at(0., 0., 0.),
        at(5., 0., 1.),
        at(-2., 4., -1.),
        at(3., -1., 1.),
        at(6., -2., 2.),
        at(-3., 5., -1.),
    ];
    let platform = [at(4., 1., 4.), at(0., 3., 3.), at(4., 1., 5.), at(-4., 3., 3.)];
    let end = [0, 0, 1, 1, 2, 3];
    Manipulator::from_legs(std::array::from_fn(|k| Leg { base: base[k], platform: platform[end[k]] }))
        .unwrap()
}

fn targets(m: &Manipulator) -> Targets {
    Targets {
        no_shared_joints: false,
        spacing: 0.01 * m.size(),
        clearance: None,
        holes: Vec::new(),
        conditioning: 1e-3,
        reach: 1.5 * m.size(),
        poses: vec![default_home(m)],
        characteristic_length: m.platform_rms_radius(),
    }
}

fn hole(body: Body, point: Point3<f64>) -> Hole {
    Hole { body, point, legs: Vec::new() }
}

fn quick() -> MoveSearchOptions {
    MoveSearchOptions { samples: 6, starts: 6, evaluations: 200, ..MoveSearchOptions::default() }
}

fn asked(m: &Manipulator, targets: &Targets) -> SearchOutcome {
    let found = components(m, ComponentOptions::default()).unwrap();
    search(m, &found, targets, &quick()).unwrap()
}

/// Every candidate is equivalent, by the leg map of the platforms as written.
fn equivalent(m: &Manipulator, outcome: &SearchOutcome) {
    assert!(!outcome.candidates.is_empty());
    for c in &outcome.candidates {
        let new = c.assembled.platform.as_ref().unwrap();
        let map = leg_map(m, new, LegMapTolerances::default()).unwrap();
        assert!(map.is_regular_within_rounding());
        assert_eq!(c.fulfilled, c.worst >= 0.0 && !(outcome.targets.no_shared_joints && c.shared_joints > 0));
        for p in &c.placements {
            // its number is that of a leg it can replace
            assert!(map.closest.a[(p.leg.get(), p.leg.get())].abs() > 1e-9);
        }
    }
}

#[test]
fn a_joint_free_platform_is_found_and_has_what_it_says() {
    let m = octahedral();
    let mut w = targets(&m);
    w.no_shared_joints = true;
    w.clearance = Some(0.01 * m.size());
    let outcome = asked(&m, &w);
    assert_eq!(outcome.verdict, SearchVerdict::Found);
    assert_eq!((outcome.least_shared, outcome.complete, outcome.searched), (Some(0), true, 1));
    // the class of the octahedral platform, counted without its hexagon
    assert_eq!(outcome.patterns, 728);
    equivalent(&m, &outcome);
    let best = &outcome.candidates[0];
    let new = best.assembled.platform.as_ref().unwrap();
    assert_eq!((new.base_joints().len(), new.platform_joints().len()), (6, 6));
    let mut least = f64::MAX;
    for joints in [new.base_joints(), new.platform_joints()] {
        for i in 0..6 {
            for j in 0..i {
                least = least.min((joints[i] - joints[j]).norm());
            }
        }
    }
    let spacing = best.margins.iter().find(|x| x.target == Target::Spacing).unwrap();
    assert!((spacing.value - least).abs() < 1e-12 && least >= w.spacing);
    // the ascent is effective: the worst margin of a random platform is a fraction of it
    assert!(best.worst > 0.02, "{}", best.worst);
}

#[test]
fn where_joints_have_to_be_shared_the_least_number_is_proved() {
    let m = six_four();
    let mut w = targets(&m);
    w.no_shared_joints = true;
    let outcome = asked(&m, &w);
    assert!(outcome.complete);
    assert_eq!(outcome.verdict, SearchVerdict::Impossible(Impossibility::SharedJoints(2)));
    equivalent(&m, &outcome);
    assert!(outcome.candidates.iter().all(|c| c.shared_joints == 2 && !c.fulfilled));
}

#[test]
fn a_hole_on_an_edge_is_filled_exactly_and_one_off_it_is_proved_impossible() {
    let m = octahedral();
    let mut w = targets(&m);
    let edge = corner(2.0, 0) + (corner(2.0, 1) - corner(2.0, 0)) * 0.3;
    let other = corner(1.0, 1) + (corner(1.0, 2) - corner(1.0, 1)) * 0.6;
    w.holes = vec![hole(Body::Base, edge), hole(Body::Platform, other)];
    let outcome = asked(&m, &w);
    assert_eq!(outcome.verdict, SearchVerdict::Found, "{:?}", outcome.holes);
    equivalent(&m, &outcome);
    for c in &outcome.candidates {
        assert!(
            c.assembled.legs.iter().any(|l| l.base == edge)
                && c.assembled.legs.iter().any(|l| l.platform == other)
        );
    }
    // in the plane of the base but on no edge, and off the plane
    for point in [
        Point3::new(0.1, 0.2, 0.0),
        Point3::new(0.1, 0.2, 0.3),
        edge + nalgebra::Vector3::new(0.0, 0.0, 1e-6),
    ] {
        w.holes = vec![hole(Body::Base, point)];
        let outcome = asked(&m, &w);
        assert_eq!(outcome.verdict, SearchVerdict::Impossible(Impossibility::NoLegAtHole(0)), "{point}");
        assert_eq!(outcome.holes[0].exact, Some(0));
        assert!(outcome.candidates.is_empty() && outcome.holes[0].singular_value > 1e-8);
    }
    // the joint there already
    w.holes = vec![hole(Body::Base, corner(2.0, 1))];
    assert_eq!(asked(&m, &w).verdict, SearchVerdict::Found);
}

#[test]
fn a_named_joint_goes_to_the_hole_with_one_of_its_legs() {
    let m = octahedral();
    let mut w = targets(&m);
    let edge = corner(2.0, 0) + (corner(2.0, 1) - corner(2.0, 0)) * 0.3;
    // legs 1 and 2 belong to the edge: the new leg can replace leg 1 or leg 2
    for leg in [0, 1] {
        w.holes = vec![Hole { body: Body::Base, point: edge, legs: vec![LegIndex::new(leg).unwrap()] }];
        let outcome = asked(&m, &w);
        assert_eq!(outcome.verdict, SearchVerdict::Found);
        assert!(outcome.candidates.iter().all(|c| c.assembled.legs[leg].base == edge));
    }
    // leg 4 has no share in it
    w.holes = vec![Hole { body: Body::Base, point: edge, legs: vec![LegIndex::new(3).unwrap()] }];
    // the hole is on the edge only within rounding, so there is no proof
    assert_eq!(asked(&m, &w).verdict, SearchVerdict::Undecided);
    let whole = |size: f64| vec![Point3::origin(), Point3::new(size, 0.0, 0.0), Point3::new(0.0, size, 1.0)];
    let pairs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    let m = Manipulator::try_new(whole(8.0), whole(4.0), pairs).unwrap();
    let mut w = targets(&m);
    w.holes = vec![Hole {
        body: Body::Base,
        point: Point3::new(2.0, 0.0, 0.0),
        legs: vec![LegIndex::new(3).unwrap()],
    }];
    let outcome = asked(&m, &w);
    assert_eq!(outcome.verdict, SearchVerdict::Impossible(Impossibility::NotByThoseLegs(0)));
}

#[test]
fn nothing_is_impossible_by_a_tolerance() {
    // rotated by angles that doubles round, the families exist only within the tolerance, and the earlier proofs fail
    let mut rng = num::Rng::new(8);
    for _ in 0..6 {
        let turn = platform::geom::random_rotation(&mut rng);
        let legs = six_four().legs().map(|l| Leg { base: turn * l.base, platform: turn * l.platform });
        let m = Manipulator::from_legs(legs).unwrap();
        let mut w = targets(&m);
        w.no_shared_joints = true;
        let outcome = asked(&m, &w);
        assert!(
            !outcome.complete || outcome.verdict == SearchVerdict::Impossible(Impossibility::SharedJoints(2)),
            "{:?}",
            outcome.verdict
        );
        assert!(outcome.complete || outcome.verdict == SearchVerdict::Undecided, "{:?}", outcome.verdict);
    }
}

#[test]
fn a_hole_on_a_cubic_has_one_leg() {
    let legs: [Leg; 6] = std::array::from_fn(|k| {
        let (s, c) = (k as f64 * 1.1 + 0.2).sin_cos();
        let r = 1.0 + 0.1 * k as f64;
        Leg { base: Point3::new(2.0 * r * c, 2.0 * s, 0.0), platform: Point3::new(c, -r * s, 0.25) }
    });
    let m = Manipulator::from_legs(legs).unwrap();
    let found = components(&m, ComponentOptions::default()).unwrap();
    let leg = found.components[0].parametrisation.leg_at(&[0.37]).unwrap().unwrap();
    let mut w = targets(&m);
    (w.reach, w.conditioning) = (20.0 * m.size(), 0.0);
    w.holes = vec![hole(Body::Base, leg.base)];
    let outcome = asked(&m, &w);
    let HoleAnswer::Legs { dimension: 0, formulas } = &outcome.holes[0].answer else {
        panic!("{:?}", outcome.holes)
    };
    let there = formulas.leg_at(&[]).unwrap().unwrap();
    assert!((there.platform - leg.platform).norm() < 1e-8);
    equivalent(&m, &outcome);
    // both ends of one leg
    w.holes.push(hole(Body::Platform, there.platform));
    let outcome = asked(&m, &w);
    equivalent(&m, &outcome);
    let both = |c: &Candidate| c.placements.iter().any(|p| p.source == LegSource::Holes(0, 1));
    assert!(outcome.candidates.iter().any(both));
}

#[test]
fn legs_that_cross_are_moved_apart() {
    // legs 1 and 4 of a platform without shared joints move along the edges until they meet at home; the search starts
    // there
    let m = octahedral();
    let mut w = targets(&m);
    w.clearance = Some(0.05 * m.size());
    let flat = Pose { position: nalgebra::Vector3::new(0.0, 0.0, 0.2), ..default_home(&m) };
    w.poses = vec![flat];
    let outcome = asked(&m, &w);
    equivalent(&m, &outcome);
    let best = &outcome.candidates[0];
    let clearance = best.margins.iter().find(|x| x.target == Target::Clearance).unwrap();
    assert!(clearance.value >= w.clearance.unwrap() || outcome.verdict == SearchVerdict::Undecided);
    // more than there is space for: no claim is made
    w.clearance = Some(100.0 * m.size());
    let outcome = asked(&m, &w);
    assert_eq!(outcome.verdict, SearchVerdict::Undecided);
    assert!(outcome.candidates.iter().all(|c| !c.fulfilled));
}

#[test]
fn same_seed_same_answer_and_bad_questions_are_refused() {
    let m = octahedral();
    let mut w = targets(&m);
    w.no_shared_joints = true;
    let key = |o: &SearchOutcome| o.candidates.iter().map(|c| c.assembled.legs).collect::<Vec<_>>();
    assert_eq!(key(&asked(&m, &w)), key(&asked(&m, &w)));
    let found = components(&m, ComponentOptions::default()).unwrap();
    w.spacing = -1.0;
    assert!(matches!(search(&m, &found, &w, &quick()), Err(SearchError::Limit { what: "spacing", .. })));
    w.spacing = 0.0;
    w.poses.clear();
    assert_eq!(search(&m, &found, &w, &quick()).unwrap_err(), SearchError::NoPoses);
}
