//! Joint offsets over cells: derivatives against differences of doubles, proved margins against samples, limits on
//! either side of the worst value.

use nalgebra::{Rotation3, Unit, Vector3};

use super::joint_offsets::JointOffsets;
use super::tests::{everything, poses_of, quick, random_platform, sampled};
use super::*;
use crate::requirements::coupled::CoupledLegs;
use crate::requirements::term::TermKind;
use crate::requirements::{
    ConeLimits, Hardware, JointAxes, LengthLimits, PlatformSpeed, PlatformStiffness, UniversalJoint,
};
use num::Rng;
use platform::geom::{ChartCell, Pose, PoseSpace, Region};

/// Kinds of joints that are not ideal: offsets at base and platform, a lead.
const SORTS: [([f64; 2], Option<f64>); 4] =
    [([0.6, 0.0], None), ([0.0, 0.5], None), ([0.7, 0.5], None), ([0.6, 0.4], Some(1.5))];

/// Universal joints with first axes about across the legs of a platform.
fn with_offsets(
    m: &Manipulator,
    home: &Pose,
    (offsets, lead): ([f64; 2], Option<f64>),
    rng: &mut Rng,
) -> Hardware {
    let mut joint = |end: usize| {
        let axes = m.legs().map(|leg| {
            let line = home.transform(&leg.platform) - leg.base;
            let aside = Vector3::from_fn(|_, _| rng.normal());
            let across = line.cross(&aside).normalize() + 0.2 * aside / aside.norm();
            Some(Unit::new_normalize(if end == 0 { across } else { home.rotation.inverse() * across }))
        });
        let limits_deg = [Some([80.0, 85.0]); 6];
        UniversalJoint { first_axes: axes, limits_deg, axes: JointAxes::Home, offset: offsets[end] }
    };
    let [base, platform] = [joint(0), joint(1)];
    Hardware {
        base_universal: Some(base),
        platform_universal: Some(platform),
        screw_lead: lead,
        ..Hardware::default()
    }
}

#[test]
fn derivatives_over_cells_are_those_of_doubles() {
    let mut rng = Rng::new(81);
    for sort in SORTS {
        let (m, home) = random_platform(&mut rng);
        let hardware = with_offsets(&m, &home, sort, &mut rng);
        let required = Requirements { hardware, ..Requirements::default() };
        let space = PoseSpace {
            translation: Vector3::repeat(1.0),
            rotation_deg: Vector3::repeat(8.0),
            ..PoseSpace::at(home)
        };
        let legs = CoupledLegs::new(&m, &hardware, &home).unwrap();
        let joints = JointOffsets::new(&m, &required, &Chart::of_pose(&home)).unwrap();
        let chart = Chart::all(&space).into_iter().find(|c| c.coordinates() == 6).unwrap();
        let lengths = |x: &[f64; 6]| legs.drives(&chart.pose(x)).unwrap();
        let h = 1e-3;
        for _ in 0..3 {
            let x: [f64; 6] = std::array::from_fn(|_| rng.uniform(-0.8, 0.8));
            let point = CellFrame::over(&chart, &ChartCell::point(x), true).with_joints(Some(&joints));
            let wide = ChartCell { lo: x.map(|a| a - 0.1), hi: x.map(|a| a + 0.1) };
            let over = CellFrame::over(&chart, &wide, true).with_joints(Some(&joints));
            for i in 0..6 {
                let at = joints.drive(&point, &m, i).unwrap();
                let all = joints.drive(&over, &m, i).unwrap();
                assert!(at.value.lo() - 1e-12 < lengths(&x)[i] && lengths(&x)[i] < at.value.hi() + 1e-12);
                assert!(at.value.hi() - at.value.lo() < 1e-11 && all.value.encloses(at.value), "{sort:?}");
                let moved = |steps: &[(usize, f64)]| {
                    let mut y = x;
                    for (k, s) in steps {
                        y[*k] += s * h;
                    }
                    lengths(&y)[i]
                };
                for k in 0..6 {
                    let slope = (moved(&[(k, 1.0)]) - moved(&[(k, -1.0)])) / (2.0 * h);
                    let (middle, radius) = at.slope(k).centre_and_radius();
                    // two offsets leave an interval even at a point
                    assert!(
                        (middle - slope).abs() <= radius + 1e-6,
                        "{sort:?} {i} {k}: {middle} {radius} {slope}"
                    );
                    assert!(radius < 0.05, "{sort:?} {radius}");
                    assert!(all.slope(k).lo() <= slope + 1e-6 && slope - 1e-6 <= all.slope(k).hi());
                    for j in 0..6 {
                        let s = |a: f64, b: f64| moved(&[(k, a), (j, b)]);
                        let curve =
                            (s(1.0, 1.0) - s(1.0, -1.0) - s(-1.0, 1.0) + s(-1.0, -1.0)) / (4.0 * h * h);
                        for jet in [&at, &all] {
                            let c = jet.curve(k, j);
                            assert!(
                                c.lo() <= curve + 1e-5 && curve - 1e-5 <= c.hi(),
                                "{sort:?} {i} {k} {j}: {c:?} {curve}"
                            );
                        }
                    }
                }
            }
        }
    }
}

/// All requirements of ideal joints, and universal joints.
#[allow(clippy::large_types_passed_by_value, reason = "it goes into the requirements")]
fn all_of(hardware: Hardware) -> Requirements {
    let all = everything();
    let hardware = Hardware {
        base_universal: hardware.base_universal,
        platform_universal: hardware.platform_universal,
        screw_lead: hardware.screw_lead,
        leg_stiffness: Some(1e4),
        base_cone_angle: None,
        platform_cone_angle: None,
        ..all.hardware
    };
    let platform_stiffness = Some(PlatformStiffness { linear: Some(1.0), ..PlatformStiffness::default() });
    Requirements { hardware, platform_stiffness, ..all }
}

#[test]
#[ignore = "evidence"]
fn no_sampled_pose_is_below_a_margin_proved_for_joints_with_offsets() {
    let mut rng = Rng::new(82);
    let (mut close, mut all) = (0, 0);
    for (k, sort) in SORTS.into_iter().enumerate().skip(1) {
        let (m, home) = random_platform(&mut rng);
        let region = if k % 2 == 0 { Region::Box } else { Region::Ellipsoid };
        let space = PoseSpace {
            region,
            translation: Vector3::repeat(1.0),
            rotation_deg: Vector3::new(6.0, 0.0, 6.0),
            ..PoseSpace::at(home)
        };
        let required = all_of(with_offsets(&m, &home, sort, &mut rng));
        let proof = prove(&m, &required, &space, &quick(), 40);
        let terms = Terms::new(&m, &required, &home);
        let least = sampled(&terms, &poses_of(&space, 300, &mut rng));
        for bound in proof.bounds.iter().filter(|b| !b.found.term.kind.is_fixed()) {
            let kind = bound.found.term.kind;
            let slack = terms.rounding(kind, bound.found.pose.as_ref());
            assert!(bound.below <= least[&kind] + slack, "{sort:?} {kind:?}: {bound:?} {}", least[&kind]);
            assert!(bound.below <= bound.found.value + slack, "{sort:?} {kind:?}: {bound:?}");
            all += 1;
            close += usize::from(bound.below > 0.7 * bound.found.value);
        }
        // a margin of every kind, not more than of ideal joints
        assert!(least.contains_key(&TermKind::LegForce) && least.contains_key(&TermKind::BaseSecondAngle));
        let regular = regular_rods(&m, &required, &space, 3000, 1).unwrap();
        assert_eq!(regular.0, RodRegularity::Regular, "{sort:?}");
    }
    assert!(close > all / 2, "{close} of {all}");
}

#[test]
#[ignore = "evidence"]
fn limits_of_drives_to_either_side_of_the_worst_length_are_decided() {
    let mut rng = Rng::new(83);
    for sort in [SORTS[2], SORTS[3]] {
        let (m, home) = random_platform(&mut rng);
        let space = PoseSpace {
            translation: Vector3::new(1.0, 0.0, 1.0),
            rotation_deg: Vector3::new(0.0, 8.0, 0.0),
            ..PoseSpace::at(home)
        };
        let offsets = with_offsets(&m, &home, sort, &mut rng);
        let with = |longest: f64, speed: f64| Requirements {
            hardware: Hardware {
                leg_length: Some(LengthLimits::Range(0.1, longest)),
                max_leg_speed: Some(speed),
                base_universal: offsets.base_universal.map(|j| UniversalJoint { limits_deg: [None; 6], ..j }),
                platform_universal: offsets
                    .platform_universal
                    .map(|j| UniversalJoint { limits_deg: [None; 6], ..j }),
                screw_lead: offsets.screw_lead,
                ..Hardware::default()
            },
            platform_speed: Some(PlatformSpeed { linear: 1.0, angular_deg: 30.0 }),
            ..Requirements::default()
        };
        let wide = with(1000.0, 1000.0);
        let found = prove(&m, &wide, &space, &quick().points(300).searches(2), 100);
        let worst =
            |kind| 1000.0 - found.bounds.iter().find(|b| b.found.term.kind == kind).unwrap().found.value;
        let (longest, fastest) = (worst(TermKind::MaxLegLength), worst(TermKind::LegSpeed));
        let met = |factor: f64| {
            prove(&m, &with(longest * factor, fastest * factor), &space, &quick(), 600).all_met()
        };
        assert_eq!(met(1.0 + 1e-4), Some(true), "{sort:?}");
        assert_eq!(met(1.0 - 1e-4), Some(false), "{sort:?}");
        // the control: ideal joints have other longest legs
        let ideal = Requirements {
            hardware: Hardware { leg_length: Some(LengthLimits::Range(0.1, 1000.0)), ..Hardware::default() },
            ..Requirements::default()
        };
        let ideal = prove(&m, &ideal, &space, &quick(), 100);
        let ideal = 1000.0
            - ideal.bounds.iter().find(|b| b.found.term.kind == TermKind::MaxLegLength).unwrap().found.value;
        assert!((ideal - longest).abs() > 1e-3 * longest, "{sort:?} {ideal} {longest}");
    }
}

/// Upright legs with offsets at the base, and the platform above moved along the first axes: lengths and angles by
/// hand.
#[test]
fn upright_legs_with_offsets_are_those_by_hand() {
    let ring: Vec<_> = (0..6)
        .map(|i| (f64::from(i) * std::f64::consts::FRAC_PI_3).sin_cos())
        .map(|(s, c)| nalgebra::Point3::new(4.0 * c, 4.0 * s, 0.0))
        .collect();
    let m = Manipulator::try_new(ring.clone(), ring, std::array::from_fn(|i| (i, i))).unwrap();
    let home = Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, 10.0) };
    let joint = |offset| UniversalJoint {
        first_axes: [Some(Vector3::x_axis()); 6],
        limits_deg: [Some([30.0, 30.0]); 6],
        axes: JointAxes::Home,
        offset,
    };
    let mut required = Requirements {
        hardware: Hardware {
            base_universal: Some(joint(1.0)),
            platform_cone_angle: Some(ConeLimits::of_all(30.0, JointAxes::Home)),
            leg_length: Some(LengthLimits::Range(8.0, 12.0)),
            ..Hardware::default()
        },
        ..Requirements::default()
    };
    // along x the second axis stays upright above the joint: |s| = |(3, 9)|, and the leg leans by `atan(3 / 9)`
    let space = PoseSpace { translation: Vector3::new(3.0, 0.0, 0.0), ..PoseSpace::at(home) };
    let proof = prove(&m, &required, &space, &quick(), 2000);
    let of = |kind: TermKind| proof.bounds.iter().find(|b| b.found.term.kind == kind).unwrap();
    let longest = 90.0_f64.sqrt();
    let lean = (3.0_f64 / 9.0).atan().to_degrees();
    for (kind, meant) in [
        (TermKind::MaxLegLength, 12.0 - longest),
        (TermKind::MinLegLength, 1.0),
        (TermKind::BaseSecondAngle, 30.0 - lean),
        (TermKind::BaseFirstAngle, 30.0),
        (TermKind::PlatformConeAngle, 30.0 - lean),
    ] {
        let bound = of(kind);
        assert!((bound.found.value - meant).abs() < 1e-9, "{kind:?}: {bound:?} {meant}");
        assert!(bound.below <= meant + 1e-9 && bound.verdict == MarginVerdict::Met, "{bound:?}");
    }
    // a leg along its first axis has no drive length: it meets no requirement
    required.hardware.leg_length = Some(LengthLimits::Range(0.0, 100.0));
    let along = Pose { position: Vector3::new(9.0, 0.0, 0.0), ..home };
    let terms = Terms::new(&m, &required, &home);
    let margins = terms.at(&along);
    assert!(margins.iter().all(|(_, margin)| *margin == f64::NEG_INFINITY), "{margins:?}");
    let mut way = PoseSpace::at(home);
    way.poses = vec![along];
    let met = prove(&m, &required, &way, &quick(), 200).all_met();
    assert_ne!(met, Some(true), "not proved: at a pose that doubles cannot tell from others nearby");
}
