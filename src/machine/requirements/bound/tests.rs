//! Proved margins against dense sampling by separate formulas, planted violations, and margins known by hand.

use nalgebra::{Point3, Rotation3, Unit, Vector3, Vector6};

use super::frame::enclosed;
use super::*;
use platform::manipulator::Body;
use std::collections::BTreeMap;

use crate::requirements::hardware::Housing;
use crate::requirements::term::TermKind;
use crate::requirements::{
    ConeLimits, CoordinateRange, Envelope, Envelopes, Hardware, HingeAngle, JointAxes, KeepOut, KeepOutShape,
    LegBody, LegMasses, LegPart, LegsWeight, LengthLimits, Load, MovingBodies, PlatformSpeed,
    PlatformStiffness, SafetyMargin, SafetyMargins, UniversalJoint, VibratingMasses,
};
use num::Rng;
use platform::geom::{ChartCell, Pose, Region};

pub(super) fn random_platform(rng: &mut Rng) -> (Manipulator, Pose) {
    let mut joints = |r: f64, turn: f64| -> Vec<Point3<f64>> {
        let mut joint = |i: usize| {
            let side = if i.is_multiple_of(2) { -0.35 } else { 0.35 };
            let angle = (i / 2) as f64 * std::f64::consts::TAU / 3.0 + side + turn + rng.uniform(-0.15, 0.15);
            Point3::new(r * angle.cos(), r * angle.sin(), rng.uniform(-0.1, 0.1))
        };
        (0..6).map(&mut joint).collect()
    };
    let (base, platform) = (joints(10.0, 0.0), joints(6.0, std::f64::consts::PI / 3.0));
    let m = Manipulator::try_new(base, platform, [(0, 5), (1, 0), (2, 1), (3, 2), (4, 3), (5, 4)]).unwrap();
    let rotation =
        Rotation3::from_euler_angles(rng.uniform(-0.1, 0.1), rng.uniform(-0.1, 0.1), rng.uniform(-0.1, 0.1));
    (m, Pose { rotation, position: Vector3::new(0.3, -0.2, rng.uniform(10.0, 14.0)) })
}

pub(super) fn random_space(home: Pose, rng: &mut Rng, region: Region) -> PoseSpace {
    let mut half = |most: f64| {
        Vector3::from_fn(|_, _| if rng.unit() < 0.2 { 0.0 } else { rng.uniform(0.2, 1.0) * most })
    };
    PoseSpace { region, translation: half(2.0), rotation_deg: half(18.0), ..PoseSpace::at(home) }
}

/// Poses of a region, by separate formulas; every other one on the boundary.
pub(super) fn poses_of(space: &PoseSpace, count: usize, rng: &mut Rng) -> Vec<Pose> {
    let mut draw = |k: usize, half: &Vector3<f64>| {
        let used = half.map(|h| if h > 0.0 { 1.0 } else { 0.0 });
        let u = Vector3::from_fn(|_, _| rng.uniform(-1.0, 1.0)).component_mul(&used);
        let norm = u.norm().max(1e-300);
        let reached = match (space.region, k % 2) {
            (Region::Box, 0) => u,
            (Region::Box, _) => u.map(|x| if rng.unit() < 0.7 { x.signum() } else { x }),
            (Region::Ellipsoid, 0) => u / norm.max(1.0),
            (Region::Ellipsoid, _) => u / norm,
        };
        reached.component_mul(half)
    };
    let pose = |k: usize| {
        let middle = |from: usize| Vector3::from_fn(|k, _| space.middle[from + k]);
        let d = middle(0) + draw(k, &space.translation);
        let w = (middle(3) + draw(k, &space.rotation_deg)).map(f64::to_radians);
        let turn = if w.norm() > 0.0 {
            Rotation3::from_axis_angle(&Unit::new_normalize(w), w.norm())
        } else {
            Rotation3::identity()
        };
        let rotation = turn * space.home.rotation;
        let pivot = space.home.transform(&Point3::from(space.pivot)).coords + d;
        Pose { rotation, position: pivot - rotation * space.pivot }
    };
    (0..count).map(pose).collect()
}

/// Every kind of requirement, with limits that nothing violates.
pub(super) fn everything() -> Requirements {
    let hardware = Hardware {
        leg_length: Some(LengthLimits::Range(0.5, 60.0)),
        base_cone_angle: Some(ConeLimits::of_all(100.0, JointAxes::Home)),
        platform_cone_angle: Some(ConeLimits::of_all(100.0, JointAxes::Home)),
        leg_body: Some(LegBody { diameter: 0.3, rod: Some((6.0, 0.2)) }),
        leg_clearance: Some(0.05),
        joint_diameter: Some(0.4),
        max_leg_force: Some(1e4),
        max_leg_speed: Some(100.0),
        ..Hardware::default()
    };
    let post = KeepOutShape::Capsule {
        from: Point3::new(0.0, 0.0, -1.0),
        to: Point3::new(0.0, 0.0, 4.0),
        diameter: 1.0,
    };
    let tool = KeepOutShape::Sphere { center: Point3::new(0.0, 0.0, -3.0), diameter: 1.0 };
    let table = KeepOutShape::Box { center: Point3::new(0.0, 1.0, 2.0), size: Vector3::new(2.0, 1.0, 0.5) };
    let body = |name: &str, fixed_to, shape| KeepOut { name: name.into(), fixed_to, shape };
    let load = |fixed_to| Load {
        name: "load".into(),
        force: Vector3::new(2.0, 1.0, -20.0),
        torque: Vector3::new(3.0, 0.0, 1.0),
        at: Point3::new(0.5, 0.0, 2.0),
        fixed_to,
        // one load includes the weight of the legs
        legs: (fixed_to == Body::Base).then_some(LegsWeight {
            rod: Vector3::new(0.0, 0.3, -2.0),
            moment: Vector3::new(1.0, 0.0, -9.0),
        }),
    };
    Requirements {
        hardware,
        keep_outs: vec![
            body("post", Body::Base, post),
            body("tool", Body::Platform, tool),
            body("table", Body::Base, table),
        ],
        loads: vec![load(Body::Base), load(Body::Platform)],
        platform_speed: Some(PlatformSpeed { linear: 3.0, angular_deg: 60.0 }),
        min_joint_distance: Some(0.1),
        envelopes: Envelopes {
            machine: Some(Envelope::Cylinder { radius: 15.0, center: [0.1, -0.2] }),
            ..Envelopes::default()
        },
        ..Requirements::default()
    }
}

pub(super) fn quick() -> AssessOptions {
    AssessOptions::new().points(30).searches(1)
}

/// The least margin of every kind over many poses, in doubles.
pub(super) fn sampled(terms: &Terms<'_>, poses: &[Pose]) -> BTreeMap<TermKind, f64> {
    let mut out = BTreeMap::new();
    for pose in poses {
        for (term, value) in terms.at(pose) {
            let least: &mut f64 = out.entry(term.kind).or_insert(value);
            *least = least.min(value);
        }
    }
    out
}

#[test]
#[ignore = "evidence"]
fn no_sampled_pose_is_below_a_proved_margin_and_bounds_come_close() {
    let mut rng = Rng::new(31);
    let (mut close, mut all) = (0, 0);
    for k in 0..6 {
        let (m, home) = random_platform(&mut rng);
        let region = if k % 2 == 0 { Region::Box } else { Region::Ellipsoid };
        let space = random_space(home, &mut rng, region);
        let required = everything();
        let proof = prove(&m, &required, &space, &quick(), 150);
        let terms = Terms::new(&m, &required, &home);
        let least = sampled(&terms, &poses_of(&space, 1500, &mut rng));
        for bound in proof.bounds.iter().filter(|b| !b.found.term.kind.is_fixed()) {
            let kind = bound.found.term.kind;
            let slack = terms.rounding(kind, bound.found.pose.as_ref());
            assert!(bound.below <= least[&kind] + slack, "{k} {kind:?}: {bound:?} {}", least[&kind]);
            assert!(bound.below <= bound.found.value + slack, "{k} {kind:?}");
            assert!(
                bound.found.value <= least[&kind] + 0.02 * least[&kind].abs(),
                "{k} {kind:?}: {bound:?} {}",
                least[&kind]
            );
            all += 1;
            close += usize::from(bound.below > 0.7 * bound.found.value);
        }
        assert_eq!(proof.bounds.len(), 11);
    }
    assert!(close > all * 3 / 4, "{close} of {all}");
}

/// A region to one side of home, rotated about a pivot, and ranges of single coordinates.
fn one_sided_space(home: Pose, rng: &mut Rng, region: Region) -> PoseSpace {
    let mut space = random_space(home, rng, region);
    let half = |k: usize| if k < 3 { space.translation[k] } else { space.rotation_deg[k - 3] };
    let middle = Vector6::from_fn(|k, _| 0.5 * half(k) * rng.uniform(-1.0, 1.0));
    (space.middle, space.pivot) = (middle, Vector3::new(0.5, -1.0, 4.0));
    space.ranges[0] = CoordinateRange { min: -3.0, max: 1.0 };
    space.ranges[4] = CoordinateRange { min: 0.0, max: 20.0 };
    space
}

#[test]
fn no_pose_about_a_pivot_or_along_a_range_is_below_a_proved_margin() {
    let mut rng = Rng::new(41);
    for region in [Region::Box, Region::Ellipsoid] {
        let (m, home) = random_platform(&mut rng);
        let space = one_sided_space(home, &mut rng, region);
        let required = everything();
        let proof = prove(&m, &required, &space, &quick(), 40);
        let terms = Terms::new(&m, &required, &home);
        let mut poses = poses_of(&space, 1000, &mut rng);
        poses.extend(space.along_ranges(200));
        let least = sampled(&terms, &poses);
        let mut finite = 0;
        for bound in proof.bounds.iter().filter(|b| !b.found.term.kind.is_fixed()) {
            let kind = bound.found.term.kind;
            let slack = terms.rounding(kind, bound.found.pose.as_ref());
            assert!(bound.below <= least[&kind] + slack, "{kind:?}: {bound:?} {}", least[&kind]);
            assert!(bound.found.value <= least[&kind] + 0.02 * least[&kind].abs(), "{kind:?}: {bound:?}");
            finite += usize::from(bound.below > 0.0);
        }
        assert!(finite >= 5, "{finite}");
        // the negative control: the same region about the origin has other least margins
        let about_origin = PoseSpace { pivot: Vector3::zeros(), ..space };
        let other = sampled(&terms, &poses_of(&about_origin, 1000, &mut rng));
        let is_other = |(kind, value): (&TermKind, &f64)| (other[kind] - value).abs() > 0.05 * value.abs();
        assert!(least.iter().any(is_other), "{least:?} {other:?}");
    }
}

/// The platform frame moved to the pivot makes a region without pivot.
#[test]
fn a_pivot_is_the_origin_of_a_moved_platform_frame() {
    let mut rng = Rng::new(42);
    for region in [Region::Box, Region::Ellipsoid] {
        let (m, home) = random_platform(&mut rng);
        let space = one_sided_space(home, &mut rng, region);
        let q = space.pivot;
        let platform = m.joints(Body::Platform).iter().map(|b| b - q).collect();
        let moved = Manipulator::try_new(m.joints(Body::Base).to_vec(), platform, m.pairs()).unwrap();
        let there = PoseSpace {
            home: Pose { position: home.position + home.rotation * q, ..home },
            pivot: Vector3::zeros(),
            ..space.clone()
        };
        // loads and speeds are about the origin of the platform
        let everything = everything();
        let keep_outs = everything.keep_outs[..1].to_vec();
        let hardware = Hardware { max_leg_force: None, max_leg_speed: None, ..everything.hardware };
        let required = Requirements { hardware, keep_outs, ..Requirements::default() };
        let [own, other] = [(&m, &space), (&moved, &there)]
            .map(|(m, space)| prove(m, &required, space, &quick(), 60).bounds);
        assert_eq!(own.len(), other.len());
        for (a, b) in own.iter().zip(&other) {
            let kind = a.found.term.kind;
            assert_eq!(kind, b.found.term.kind);
            assert!((a.below - b.below).abs() < 1e-6 * (1.0 + a.below.abs()), "{kind:?}: {a:?} {b:?}");
            assert!((a.found.value - b.found.value).abs() < 1e-6 * (1.0 + a.below.abs()), "{kind:?}");
        }
    }
}

/// A proof without time samples at most one pose of the region and bounds hardly any cell. It is no stronger than the
/// whole one.
#[test]
fn proofs_end_when_their_time_is_over() {
    let mut rng = Rng::new(31);
    let (m, home) = random_platform(&mut rng);
    let space = random_space(home, &mut rng, Region::Box);
    let required = everything();
    let proved = |options: AssessOptions| prove(&m, &required, &space, &options.patient_cells(400), 150);
    let (whole, ended) = (proved(quick()), proved(quick().until(Some(std::time::Instant::now()))));
    assert_eq!(ended.poses, space.listed(quick().steps).len().max(1));
    let (whole, ended) = (whole.bounds, ended.bounds);
    assert_eq!(whole.len(), ended.len(), "every requirement has a margin");
    let cells = |bounds: &[MarginBound]| bounds.iter().map(|b| b.cells).sum::<usize>();
    assert!(cells(&ended) < cells(&whole) / 4, "{} of {}", cells(&ended), cells(&whole));
    for (a, b) in whole.iter().zip(&ended) {
        assert!(b.below <= a.below && (!b.is_decided() || a.verdict == b.verdict), "{a:?} {b:?}");
    }
}

/// Limits slightly short of the worst value are proved violated from poses of cells, or at least never called met.
/// Limits slightly beyond it are never called violated, and a few cells prove lengths to be met, in boxes and
/// ellipsoids.
#[test]
#[ignore = "evidence"]
fn limits_to_either_side_of_the_worst_value_are_decided() {
    let mut rng = Rng::new(32);
    let (mut proved, mut planted, mut found) = (0, 0, 0);
    for k in 0..6 {
        let (m, home) = random_platform(&mut rng);
        let region = if k % 2 == 0 { Region::Box } else { Region::Ellipsoid };
        let space = random_space(home, &mut rng, region);
        let with = |length: f64, cone_angle: f64, speed: f64| {
            let hardware = Hardware {
                leg_length: Some(LengthLimits::Range(0.1, length)),
                platform_cone_angle: Some(ConeLimits::of_all(cone_angle, JointAxes::Home)),
                max_leg_speed: Some(speed),
                ..Hardware::default()
            };
            let platform_speed = Some(PlatformSpeed { linear: 1.0, angular_deg: 40.0 });
            Requirements { hardware, platform_speed, ..Requirements::default() }
        };
        let kinds = [TermKind::MaxLegLength, TermKind::PlatformConeAngle, TermKind::LegSpeed];
        let wide = [100.0, 170.0, 100.0];
        let first = prove(&m, &with(wide[0], wide[1], wide[2]), &space, &quick().points(400), 60);
        let worst: [f64; 3] = std::array::from_fn(|i| {
            wide[i] - first.bounds.iter().find(|b| b.found.term.kind == kinds[i]).unwrap().found.value
        });
        for depth in [1e-2, 1e-3] {
            let [a, b, c] = worst.map(|x| x * (1.0 - depth));
            // no sampling at all: cells have to find it
            let none = quick().points(0).searches(0);
            let short = prove(&m, &with(a, b, c), &space, &none, 1500);
            for bound in short.bounds.iter().filter(|b| kinds.contains(&b.found.term.kind)) {
                assert!(
                    matches!(bound.verdict, MarginVerdict::Violated | MarginVerdict::Searched),
                    "{k} {depth}: {bound:?}"
                );
                planted += 1;
                if bound.verdict == MarginVerdict::Violated {
                    found += 1;
                    let pose = bound.found.pose.unwrap();
                    let terms = with(a, b, c);
                    let there = Terms::new(&m, &terms, &home).at(&pose);
                    assert!(there.iter().any(|(t, v)| *t == bound.found.term && *v < 0.0));
                }
            }
            assert_ne!(short.all_met(), Some(true));
            let [a, b, c] = worst.map(|x| x * (1.0 + depth));
            let beyond = prove(&m, &with(a, b, c), &space, &quick(), 1500);
            assert!(beyond.all_met() != Some(false), "{k} {depth}: {beyond:?}");
            proved += beyond.bounds.iter().filter(|b| b.verdict == MarginVerdict::Met).count();
        }
    }
    assert!(proved >= 24 && found * 10 >= planted * 9, "{proved} of 48 proved, {found} of {planted} found");
}

/// More cells decide the requirements and safety margins that a few cells leave undecided, and change nothing else.
#[test]
fn patient_cells_are_for_what_is_undecided() {
    let mut rng = Rng::new(33);
    let (m, home) = random_platform(&mut rng);
    let space = PoseSpace {
        translation: Vector3::repeat(3.0),
        rotation_deg: Vector3::repeat(25.0),
        ..random_space(home, &mut rng, Region::Box)
    };
    let with = |length: f64| Requirements {
        hardware: Hardware { leg_length: Some(LengthLimits::Range(0.1, length)), ..Hardware::default() },
        ..Requirements::default()
    };
    let longest = |p: &MarginProof| {
        p.bounds.iter().find(|b| b.found.term.kind == TermKind::MaxLegLength).cloned().unwrap()
    };
    let sampled = prove(&m, &with(100.0), &space, &quick(), 1);
    let worst = 100.0 - longest(&sampled).found.value;
    let patient = quick().patient_cells(2000);
    let beyond = with(1.0001 * worst);
    let few = longest(&prove(&m, &beyond, &space, &quick(), 1));
    let more = longest(&prove(&m, &beyond, &space, &patient, 1));
    assert_eq!((few.verdict, more.verdict), (MarginVerdict::Searched, MarginVerdict::Met));
    assert!(more.cells > few.cells && more.below >= few.below);
    // a margin that is met keeps its safety margin only where that is proved
    let safety_margin = (TermKind::MaxLegLength, SafetyMargin::Amount(0.00005 * worst));
    let safety_margins = SafetyMargins { kinds: BTreeMap::from([safety_margin]), ..SafetyMargins::default() };
    let reserved = Requirements { safety_margins, ..with(1.0001 * worst) };
    assert_eq!(longest(&prove(&m, &reserved, &space, &patient, 1)).keeps_safety_margin(), Some(true));
    // and no number of cells proves a false statement
    let short = longest(&prove(&m, &with(0.999 * worst), &space, &patient, 1));
    assert_eq!(short.verdict, MarginVerdict::Violated);
}

/// Six vertical legs over a hexagon: lengths and gaps are known.
#[test]
fn bounds_of_upright_legs_are_those_by_hand() {
    let ring = || -> Vec<Point3<f64>> {
        let at = |i: usize| (i as f64 * std::f64::consts::FRAC_PI_3).sin_cos();
        (0..6).map(|i| Point3::new(4.0 * at(i).1, 4.0 * at(i).0, 0.0)).collect()
    };
    let m = Manipulator::try_new(ring(), ring(), std::array::from_fn(|i| (i, i))).unwrap();
    let home = Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, 10.0) };
    let mut r = Requirements::default();
    r.hardware.leg_length = Some(LengthLimits::Range(7.5, 13.5));
    r.hardware.leg_body = Some(LegBody { diameter: 1.0, rod: None });
    let space = PoseSpace { translation: Vector3::new(3.0, 4.0, 2.0), ..PoseSpace::at(home) };
    let proof = prove(&m, &r, &space, &quick(), 4000);
    let of = |kind: TermKind| proof.bounds.iter().find(|b| b.found.term.kind == kind).unwrap();
    let short = of(TermKind::MinLegLength);
    assert!(
        short.verdict == MarginVerdict::Met && short.below > 0.4 && short.below <= 0.5 + 1e-12,
        "{short:?}"
    );
    let long = of(TermKind::MaxLegLength);
    assert!(long.verdict == MarginVerdict::Met && (long.found.value - 0.5).abs() < 1e-12, "{long:?}");
    // parallel legs, 4 apart along x or 4 at 60 degrees: translation by (3, 4, z) leans them over
    let gap = of(TermKind::LegClearance);
    assert!(gap.below <= gap.found.value && gap.verdict == MarginVerdict::Met, "{gap:?}");
    // the limit itself: reached at a corner, not passed
    r.hardware.leg_length = Some(LengthLimits::Range(8.0, 13.0));
    r.hardware.leg_body = None;
    let proof = prove(&m, &r, &space, &quick(), 4000);
    assert_eq!(proof.all_met(), Some(true), "{proof:?}");
    assert!(proof.bounds.iter().all(|b| b.found.value.abs() < 1e-9 && b.below > -1e-12));
    r.hardware.leg_length = Some(LengthLimits::Range(8.0 + 1e-9, 13.0));
    assert_eq!(prove(&m, &r, &space, &quick(), 4000).all_met(), Some(false));
}

#[test]
fn a_trajectory_is_proved_between_its_poses() {
    let mut rng = Rng::new(33);
    let (m, home) = random_platform(&mut rng);
    let at = |x: f64, turn: f64| Pose {
        position: home.position + Vector3::new(x, 0.0, -1.0),
        rotation: Rotation3::new(Vector3::z() * turn) * home.rotation,
    };
    let mut space = PoseSpace::at(home);
    space.trajectory = vec![at(-6.0, 0.2), at(6.0, -0.2)];
    let with = |least: f64| {
        let hardware = Hardware { leg_length: Some(LengthLimits::Range(least, 40.0)), ..Hardware::default() };
        Requirements { hardware, ..Requirements::default() }
    };
    let many = space.listed(20_000);
    let shortest = sampled(&Terms::new(&m, &with(0.0), &home), &many)[&TermKind::MinLegLength];
    let one_step = quick().steps(1);
    assert_eq!(prove(&m, &with(shortest * (1.0 - 1e-6)), &space, &one_step, 2000).all_met(), Some(true));
    assert_eq!(prove(&m, &with(shortest * (1.0 + 1e-6)), &space, &one_step, 2000).all_met(), Some(false));
}

/// Housings as boxes and spheres: margins of joints that stand apart, touch, and overlap.
#[test]
fn gaps_of_housings_are_enclosed() {
    let mut rng = Rng::new(34);
    for _ in 0..200 {
        let d = Vector3::from_fn(|_, _| rng.uniform(-3.0, 3.0));
        let enclosed: IntervalVector = std::array::from_fn(|k| Interval::from(d[k]));
        let edges = Vector3::from_fn(|_, _| rng.uniform(0.1, 3.0));
        let (ball, block) = (Housing::Sphere(1.0), Housing::Box(edges));
        let wider = Housing::Sphere(1.7);
        for (housing, other) in [(ball, ball), (ball, wider), (block, block), (block, ball), (wider, block)] {
            let (gap, found) = (housing.gap(&other, d.into()), housing.gap(&other, enclosed));
            assert!(
                found.lo() - 1e-14 <= gap && gap <= found.hi() + 1e-14 && found.hi() - found.lo() < 1e-13
            );
        }
    }
}

/// Six vertical legs: their platform joints sweep a box, and safety margins move the limits.
#[test]
fn envelopes_and_safety_margins_of_upright_legs_are_those_by_hand() {
    let ring = || -> Vec<Point3<f64>> {
        let at = |i: usize| (i as f64 * std::f64::consts::FRAC_PI_3).sin_cos();
        (0..6).map(|i| Point3::new(4.0 * at(i).1, 4.0 * at(i).0, 0.0)).collect()
    };
    let m = Manipulator::try_new(ring(), ring(), std::array::from_fn(|i| (i, i))).unwrap();
    let home = Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, 10.0) };
    let space = PoseSpace { translation: Vector3::new(3.0, 0.0, 2.0), ..PoseSpace::at(home) };
    let mut r = Requirements::default();
    r.hardware.joint_diameter = Some(1.0);
    let of = |r: &Requirements, kind: TermKind| {
        let proof = prove(&m, r, &space, &quick(), 4000);
        proof.bounds.into_iter().find(|b| b.found.term.kind == kind).unwrap()
    };
    r.envelopes.base = Some(Envelope::Cylinder { radius: 5.0, center: [0.0, 0.0] });
    let base = of(&r, TermKind::BaseEnvelope);
    assert!(base.verdict == MarginVerdict::Met && (base.found.value - 0.5).abs() < 1e-12, "{base:?}");
    // the joint at (4, 0) goes 3 along x, and half a housing with it
    r.envelopes.machine = Some(Envelope::Cylinder { radius: 8.0, center: [0.0, 0.0] });
    let round = of(&r, TermKind::MachineEnvelope);
    assert!(round.verdict == MarginVerdict::Met && (round.found.value - 0.5).abs() < 1e-9, "{round:?}");
    assert!(round.below > 0.0 && round.below <= 0.5 + 1e-12);
    assert_eq!(round.found.term.second, 1, "at the platform");
    let mut upright = |least: f64, greatest: f64| {
        let (min, max) = (Point3::new(-9.0, -9.0, least), Point3::new(9.0, 9.0, greatest));
        r.envelopes.machine = Some(Envelope::Box { min, max });
        of(&r, TermKind::MachineEnvelope)
    };
    let high = upright(-1.0, 12.6);
    assert!(high.verdict == MarginVerdict::Met && (high.found.value - 0.1).abs() < 1e-9, "{high:?}");
    assert_eq!(upright(-1.0, 12.4).verdict, MarginVerdict::Violated);
    let low = upright(-0.4, 13.0);
    assert!(low.verdict == MarginVerdict::Violated && low.found.term.second == 0, "at the base: {low:?}");
    // lengths from 8 to sqrt(12^2 + 3^2)
    let longest = 153f64.sqrt();
    r.hardware.leg_length = Some(LengthLimits::Range(7.0, longest + 1.0));
    let kept = |r: &Requirements, kind| of(r, kind).keeps_safety_margin();
    assert_eq!(kept(&r, TermKind::MaxLegLength), Some(true), "none is asked for");
    for (amount, expected) in [(0.9, Some(true)), (1.1, Some(false))] {
        for kind in [TermKind::MinLegLength, TermKind::MaxLegLength] {
            r.safety_margins.kinds.insert(kind, crate::requirements::SafetyMargin::Amount(amount));
            let bound = of(&r, kind);
            assert_eq!(
                (bound.verdict, bound.keeps_safety_margin()),
                (MarginVerdict::Met, expected),
                "{bound:?}"
            );
        }
    }
}

/// One wide joint among narrow ones determines spacing, envelopes and the start of its leg beside a plate, and the
/// proof agrees.
#[test]
fn the_housing_of_a_single_joint_counts_for_that_joint() {
    let ring = || -> Vec<Point3<f64>> {
        let at = |i: usize| (i as f64 * std::f64::consts::FRAC_PI_3).sin_cos();
        (0..6).map(|i| Point3::new(4.0 * at(i).1, 4.0 * at(i).0, 0.0)).collect()
    };
    let m = Manipulator::try_new(ring(), ring(), std::array::from_fn(|i| (i, i))).unwrap();
    let home = Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, 10.0) };
    let space = PoseSpace::at(home);
    let mut r = Requirements::default();
    r.hardware.joint_diameter = Some(1.0);
    let circle = |radius: f64| Some(Envelope::Cylinder { radius, center: [0.0, 0.0] });
    (r.envelopes.base, r.envelopes.platform) = (circle(5.5), circle(5.5));
    r.envelopes.machine = circle(6.0);
    let of = |r: &Requirements, kind: TermKind| {
        let proof = prove(&m, r, &space, &quick(), 4000);
        let bound = proof.bounds.into_iter().find(|b| b.found.term.kind == kind).unwrap();
        assert!(bound.verdict == MarginVerdict::Met && bound.found.value - bound.below < 1e-9, "{bound:?}");
        bound.found
    };
    let near = |found: crate::requirements::Margin, value: f64| {
        assert!((found.value - value).abs() < 1e-12, "{value}: {found:?}");
        found.term
    };
    let all = [
        (TermKind::BaseSpacing, 3.0, 2.5),
        (TermKind::PlatformSpacing, 3.0, 3.0),
        (TermKind::BaseEnvelope, 1.0, 0.5),
        (TermKind::PlatformEnvelope, 1.0, 1.0),
        (TermKind::MachineEnvelope, 1.5, 1.0),
    ];
    for (kind, narrow, _) in all {
        near(of(&r, kind), narrow);
    }
    r.hardware.base_joint_housing[2] = Some(Housing::Sphere(2.0));
    for (kind, _, wide) in all {
        let term = near(of(&r, kind), wide);
        if wide < 2.0 && kind == TermKind::BaseEnvelope {
            assert_eq!(term.first, 2);
        }
    }
    let reaches: [f64; 6] = std::array::from_fn(|leg| r.hardware.joint_reach(Body::Base, leg));
    assert_eq!(reaches.map(f64::to_bits), [0.5, 0.5, 1.0, 0.5, 0.5, 0.5].map(f64::to_bits));
    assert!(r.safety_margin(TermKind::BaseSpacing).abs() < 1e-15);
    r.safety_margins.all = Some(10.0);
    assert!((r.safety_margin(TermKind::BaseSpacing) - 0.2).abs() < 1e-15, "of the widest");
}

/// Distances of joints inside round and square envelopes, enclosed.
#[test]
fn rooms_inside_envelopes_are_enclosed() {
    let mut rng = Rng::new(35);
    for _ in 0..200 {
        let at = Point3::from(Vector3::from_fn(|_, _| rng.uniform(-3.0, 3.0)));
        let half = Vector3::from_fn(|_, _| rng.uniform(0.0, 1.0));
        let shapes = [
            Envelope::Cylinder { radius: 4.0, center: [0.5, -0.2] },
            Envelope::Box { min: Point3::new(-2.0, -3.0, -1.0), max: Point3::new(3.0, 2.0, 2.0) },
        ];
        for shape in shapes {
            let (margin, found) =
                (shape.margin(at.coords.into(), &half, 0.3), shape.margin(enclosed(&at), &half, 0.3));
            assert!(
                found.lo() - 1e-14 <= margin
                    && margin <= found.hi() + 1e-14
                    && found.hi() - found.lo() < 1e-13
            );
        }
    }
}

/// A stiffness and a frequency on legs that weigh as much as the platform.
fn elastic(linear: f64, angular: f64, natural_frequency: f64) -> Requirements {
    let part = |mass, center, inertia| LegPart { mass, center, inertia };
    let leg = LegMasses { cylinder: part(1.5, 4.0, 8.0), rod: part(0.8, 3.0, 2.0), reflected: 0.7 };
    let bodies = MovingBodies {
        mass: 9.0,
        center: Point3::new(0.4, -0.3, 1.5),
        inertia: nalgebra::Matrix3::new(20.0, 1.0, 0.5, 1.0, 25.0, -2.0, 0.5, -2.0, 30.0),
        leg,
        gravity: Vector3::zeros(),
        metres: 1.0,
    };
    Requirements {
        hardware: Hardware { leg_stiffness: Some(500.0), ..Hardware::default() },
        platform_stiffness: Some(PlatformStiffness {
            linear: Some(linear),
            angular: Some(angular),
            natural_frequency: Some(natural_frequency),
        }),
        vibrating: Some(VibratingMasses { bodies, leg: 500.0 }),
        ..Requirements::default()
    }
}

/// A small region: no pose is below a bound, and a few cells decide limits on either side of the least value.
#[test]
fn stiffness_is_bounded_where_it_varies_little() {
    let mut rng = Rng::new(43);
    let (m, home) = random_platform(&mut rng);
    let space = PoseSpace {
        translation: Vector3::new(0.1, 0.0, 0.1),
        rotation_deg: Vector3::new(0.0, 1.0, 0.0),
        ..PoseSpace::at(home)
    };
    let with = |worst: [f64; 3], factor: f64| {
        let limits = worst.map(|x| x * factor);
        prove(&m, &elastic(limits[0], limits[1], limits[2]), &space, &quick(), 100)
    };
    let loose = with([1.0; 3], 1e-3);
    let required = elastic(1e-3, 1e-3, 1e-3);
    let least = sampled(&Terms::new(&m, &required, &home), &poses_of(&space, 200, &mut rng));
    for bound in &loose.bounds {
        assert!(bound.below <= least[&bound.found.term.kind] * (1.0 + 1e-9), "{bound:?} {least:?}");
    }
    let worst = std::array::from_fn(|i| loose.bounds[i].found.value + 1e-3);
    assert_eq!(with(worst, 0.95).all_met(), Some(true));
    assert!(with(worst, 1.05).bounds.iter().all(|b| b.verdict == MarginVerdict::Violated));
}

/// Values found and bounds enclose those at many poses, over regions of several sizes. A limit slightly below the least
/// value is proved met, one slightly above is violated.
#[test]
#[ignore = "evidence"]
fn stiffness_and_frequency_are_bounded_and_decided() {
    let mut rng = Rng::new(41);
    let limits =
        |worst: &[f64; 3], factor: f64| elastic(worst[0] * factor, worst[1] * factor, worst[2] * factor);
    for (k, size) in [0.1, 0.12, 1.0].into_iter().enumerate() {
        let (m, home) = random_platform(&mut rng);
        let region = if k == 1 { Region::Ellipsoid } else { Region::Box };
        let wide = random_space(home, &mut rng, region);
        let space = PoseSpace {
            translation: wide.translation * size,
            rotation_deg: wide.rotation_deg * size,
            ..wide
        };
        let small = limits(&[1.0; 3], 1e-3);
        let proof = prove(&m, &small, &space, &quick().points(300), 40);
        let terms = Terms::new(&m, &small, &home);
        let least = sampled(&terms, &poses_of(&space, 1500, &mut rng));
        let worst: [f64; 3] = std::array::from_fn(|i| proof.bounds[i].found.value + 1e-3);
        for bound in &proof.bounds {
            let at_poses = least[&bound.found.term.kind];
            assert!(
                bound.below <= at_poses.min(bound.found.value) * (1.0 + 1e-9),
                "{k}: {bound:?} {at_poses}"
            );
            assert!(bound.found.value <= 1.01 * at_poses, "{k}: {bound:?} {at_poses}");
        }
        if k == 2 {
            // too large for few cells
            continue;
        }
        let none = AssessOptions::new().points(0).searches(0).close(false);
        let met = prove(&m, &limits(&worst, 0.96), &space, &none, 1500);
        assert_eq!(met.all_met(), Some(true), "{k}: {met:?}");
        let missed = prove(&m, &limits(&worst, 1.02), &space, &none, 1500);
        assert!(missed.bounds.iter().all(|b| b.verdict == MarginVerdict::Violated), "{k}: {missed:?}");
        // a safety margin that only just remains, and one that does not
        let mut reserved = limits(&worst, 0.8);
        reserved.safety_margins.all = Some(18.0);
        assert_eq!(prove(&m, &reserved, &space, &none, 1500).all_keep_safety_margin(), Some(true), "{k}");
        reserved.safety_margins.all = Some(30.0);
        assert_eq!(prove(&m, &reserved, &space, &none, 1500).all_keep_safety_margin(), Some(false), "{k}");
    }
}

fn universal(first_axes: [Vector3<f64>; 6], limits_deg: [f64; 2]) -> UniversalJoint {
    let first_axes = first_axes.map(|a| Some(Unit::new_normalize(a)));
    UniversalJoint { first_axes, limits_deg: [Some(limits_deg); 6], axes: JointAxes::Home, offset: 0.0 }
}

/// The kinds of the angles, with the least margins found and proved.
#[allow(clippy::large_types_passed_by_value, reason = "tests make it on the spot")]
fn angles_of(m: &Manipulator, space: &PoseSpace, hardware: Hardware, cells: usize) -> Vec<MarginBound> {
    let required = Requirements { hardware, ..Requirements::default() };
    prove(m, &required, space, &quick(), cells).bounds
}

#[test]
#[ignore = "evidence"]
fn angles_of_upright_legs_in_universal_joints_are_those_by_hand() {
    let ring = || -> Vec<Point3<f64>> {
        let at = |i: usize| (i as f64 * std::f64::consts::FRAC_PI_3).sin_cos();
        (0..6).map(|i| Point3::new(4.0 * at(i).1, 4.0 * at(i).0, 0.0)).collect()
    };
    let m = Manipulator::try_new(ring(), ring(), std::array::from_fn(|i| (i, i))).unwrap();
    let home = Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, 10.0) };
    let space = PoseSpace { translation: Vector3::new(3.0, 4.0, 2.0), ..PoseSpace::at(home) };
    // about y the legs lean by their shares of x and z, about the second axis by y over the rest
    let worst = [3f64.atan2(8.0), 4f64.atan2(8.0)].map(f64::to_degrees);
    for (share, met) in [(1.3, true), (1.0 + 1e-6, true), (1.0 - 1e-6, false)] {
        let joint = universal([Vector3::y(); 6], worst.map(|x| x * share));
        let hardware =
            Hardware { base_universal: Some(joint), platform_universal: Some(joint), ..Hardware::default() };
        let bounds = angles_of(&m, &space, hardware, 4000);
        assert_eq!(bounds.len(), 4);
        for bound in bounds {
            let (_, angle) = bound.found.term.kind.hinge().unwrap();
            let by_hand = worst[usize::from(angle == HingeAngle::Second)] * (share - 1.0);
            assert!((bound.found.value - by_hand).abs() < 1e-9 && bound.below <= by_hand + 1e-9, "{bound:?}");
            assert_eq!(bound.verdict.is_met(), Some(met), "{bound:?}");
        }
    }
    // first axes along the legs at home: singular there, which violates every limit and gives no invalid number
    let joint = universal([Vector3::z(); 6], [179.0, 89.0]);
    let bounds = angles_of(&m, &space, Hardware { base_universal: Some(joint), ..Hardware::default() }, 200);
    for bound in bounds {
        assert!(bound.found.value < 0.0 && bound.verdict.is_met() != Some(true), "{bound:?}");
        let second = bound.found.term.kind == TermKind::BaseSecondAngle;
        assert!(!second || bound.verdict == MarginVerdict::Violated, "{bound:?}");
    }
}

/// Both angles from the definitions: rotations about the two axes that map the leg at rest to the leg, without the
/// formulas of the margins.
#[test]
fn no_sampled_pose_has_greater_angles_than_the_proof_allows() {
    let mut rng = Rng::new(36);
    for k in 0..3 {
        let (m, home) = random_platform(&mut rng);
        let region = if k == 1 { Region::Ellipsoid } else { Region::Box };
        let space = random_space(home, &mut rng, region);
        let mut across = || -> [Vector3<f64>; 6] {
            std::array::from_fn(|_| Vector3::new(rng.normal(), rng.normal(), 0.3 * rng.normal()))
        };
        let axes = [across(), across()];
        // a limit on either side of a right angle
        let limits = if k == 2 { [100.0, 85.0] } else { [70.0, 80.0] };
        let hardware = Hardware {
            base_universal: Some(universal(axes[0], limits)),
            platform_universal: Some(universal(axes[1], limits)),
            ..Hardware::default()
        };
        let bounds = angles_of(&m, &space, hardware, 300);
        let angle = |pose: &Pose, body: Body, leg: usize| {
            let l = m.legs()[leg];
            let line = |p: &Pose| p.transform(&l.platform) - l.base;
            let inside = |p: &Pose| if body == Body::Base { line(p) } else { p.rotation.inverse() * line(p) };
            let first = axes[body.index()][leg].normalize();
            // across the first axis both lines have a direction, and the first rotation is between them
            let plane = |v: Vector3<f64>| v - first * v.dot(&first);
            let (rest, there) = (plane(inside(&home)), plane(inside(pose)));
            let second = inside(pose).angle(&there).to_degrees();
            [rest.angle(&there).to_degrees(), second]
        };
        let mut least: BTreeMap<TermKind, f64> = BTreeMap::new();
        for pose in poses_of(&space, 600, &mut rng) {
            for kind in TermKind::HINGES {
                let (body, which) = kind.hinge().unwrap();
                let which = usize::from(which == HingeAngle::Second);
                for leg in 0..6 {
                    let margin = limits[which] - angle(&pose, body, leg)[which];
                    let at = least.entry(kind).or_insert(margin);
                    *at = at.min(margin);
                }
            }
        }
        for bound in bounds {
            let found = least[&bound.found.term.kind];
            assert!(bound.below <= found + 1e-6 && bound.found.value <= found + 0.3, "{bound:?} {found}");
            assert!(
                bound.below > bound.found.value.min(0.0) - 15.0,
                "a bound that says something: {bound:?}"
            );
            if bound.verdict == MarginVerdict::Violated {
                let pose = bound.found.pose.unwrap();
                let (body, which) = bound.found.term.kind.hinge().unwrap();
                let which = usize::from(which == HingeAngle::Second);
                assert!(limits[which] < angle(&pose, body, bound.found.term.first)[which]);
            }
        }
    }
}

/// The gap of the first parts of two legs over random cells is nowhere below its bound. The legs cross, or are nearest
/// at an end of a part. Halving a cell brings bound and least value four times nearer, as for second order.
#[test]
fn gaps_of_legs_are_bounded_to_second_order() {
    let mut rng = Rng::new(17);
    let body = LegBody { diameter: 0.3, rod: Some((6.0, 0.2)) };
    let (mut halved, mut looked_at, mut tight) = (0, 0, 0);
    for k in 0..60 {
        let (m, home) = random_platform(&mut rng);
        // turned about the axis until legs cross
        let turn = Rotation3::from_euler_angles(0.0, 0.0, rng.uniform(-1.2, 1.2));
        let home = Pose { rotation: turn * home.rotation, ..home };
        let region = if k % 2 == 0 { Region::Box } else { Region::Ellipsoid };
        let chart = Chart::of_region(&random_space(home, &mut rng, region));
        let (i, j) = [(0, 1), (1, 2), (0, 3), (5, 0)][k % 4];
        let (part, other) = [(0, 0), (0, 1), (1, 0), (1, 1)][k / 4 % 4];
        let middle: [f64; 6] =
            std::array::from_fn(|c| if c < chart.coordinates() { 0.5 * rng.uniform(-1.0, 1.0) } else { 0.0 });
        // the loss over cells of two sizes about one point
        let lost = [0.2, 0.1].map(|half| {
            let mut cell = chart.root;
            for c in 0..chart.coordinates() {
                (cell.lo[c], cell.hi[c]) = (middle[c] - half, middle[c] + half);
            }
            let z = cell.centre();
            let frames = [ChartCell::point(z), cell].map(|c| CellFrame::over(&chart, &c, c.lo[0] < c.hi[0]));
            let parts = |frame: &CellFrame<'_>, leg: usize| gap::leg_parts(frame, &m, leg, &body);
            let [ours, theirs] = [(i, part), (j, other)]
                .map(|(leg, part)| [&frames[0], &frames[1]].map(|frame| parts(frame, leg).swap_remove(part)));
            let (bounded, upper) =
                gap::gap(&chart, &cell, &z, (&ours[0], &theirs[0]), (&ours[1], &theirs[1]));
            let apart = |x: &[f64; 6]| {
                let pose = chart.pose(x);
                let segment = |leg: usize, part: usize| {
                    let ends = m.legs()[leg];
                    let end = pose.transform(&ends.platform);
                    let top = ends.base + (end - ends.base).normalize() * 6.0;
                    [[ends.base, top], [top, end]][part]
                };
                let radius = |part: usize| [0.15, 0.1][part];
                platform::geom::segment_distance(segment(i, part), segment(j, other))
                    - radius(part)
                    - radius(other)
            };
            // an upper bound, with the accuracy of the iterated nearest points
            let above = upper - apart(&z);
            assert!((-1e-12..1e-6).contains(&above), "{k}: {above}");
            let mut least = f64::INFINITY;
            for s in 0..200 {
                let side =
                    |c: usize, t: f64| if s % 2 == 0 { t } else { t.signum() }.mul_add(half, middle[c]);
                let q = std::array::from_fn(|c| {
                    if c < chart.coordinates() { side(c, rng.uniform(-1.0, 1.0)) } else { 0.0 }
                });
                if chart.scale_of(&q) <= 1.0 {
                    least = least.min(apart(&q));
                }
            }
            assert!(bounded.below <= least, "{k}: {} {least}", bounded.below);
            looked_at += 1;
            // a bound raised by a tenth of the variation over the cell fails where it is tight
            tight += usize::from(bounded.below + 0.1 * (upper - bounded.below) > least);
            upper - bounded.below - (upper - least)
        });
        halved += usize::from(lost[1] < 0.4 * lost[0] || lost[1] < 1e-3);
    }
    assert_eq!(looked_at, 120);
    assert!(halved > 45, "{halved}");
    assert!(tight > 20, "{tight}");
}
