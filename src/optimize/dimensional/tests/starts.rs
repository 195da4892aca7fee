//! The starts of the climbs: a population keeps members in small feasible regions.

use nalgebra::{Point3, Rotation3, Vector3};

use super::super::search::population;
use super::super::*;
use super::{Model, everything};
use crate::offsets::{Branch, Zone};
use machine::requirements::{
    ConeLimits, JointAxes, KeptSymmetry, LegBody, LengthLimits, Load, Objective, PlatformSpeed, PoseSpace,
    Region, Requirements, VariableKind,
};
use platform::geom::Pose;
use platform::manipulator::{Body, Manipulator};

/// The search of `designs/worked/bench-octahedral.toml`, with three-fold symmetry. Feasible offsets fill 0.8 % of the
/// box inside the sides, and 0.06 % beyond the corners, where the best optimum is.
fn bench() -> DimensionalProblem {
    let joint = |radius: f64, deg: f64| {
        let (s, c) = deg.to_radians().sin_cos();
        Point3::new(radius * c, radius * s, 0.0)
    };
    let base = (0..3).map(|k| joint(150.0, 90.0 + 120.0 * f64::from(k))).collect();
    let platform = (0..3).map(|k| joint(90.0, 150.0 + 120.0 * f64::from(k))).collect();
    let m = Manipulator::try_new(base, platform, [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)]).unwrap();
    let home = Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, 210.0) };
    let load = |x: f64| Load {
        name: String::new(),
        force: Vector3::new(x, 0.0, -20.0),
        torque: Vector3::zeros(),
        at: Point3::new(0.0, 0.0, 60.0),
        fixed_to: Body::Base,
        legs: None,
    };
    let mut requirements = Requirements { min_joint_distance: Some(4.5), ..Requirements::default() };
    let h = &mut requirements.hardware;
    h.leg_length = Some(LengthLimits::Range(198.0, 298.0));
    h.leg_body = Some(LegBody { diameter: 20.0, rod: Some((160.0, 9.0)) });
    h.joint_diameter = Some(24.0);
    h.leg_clearance = Some(2.0);
    h.base_cone_angle = Some(ConeLimits::of_all(35.0, JointAxes::Home));
    h.platform_cone_angle = h.base_cone_angle;
    h.max_leg_force = Some(46.0);
    h.max_leg_speed = Some(10.0);
    requirements.platform_speed = Some(PlatformSpeed { linear: 5.0, angular_deg: 2.0 });
    requirements.loads = vec![load(0.0), load(5.0)];
    requirements.safety_margins.all = Some(5.0);
    let space = PoseSpace {
        translation: Vector3::new(25.0, 25.0, 20.0),
        rotation_deg: Vector3::repeat(8.0),
        region: Region::Ellipsoid,
        ..PoseSpace::at(home)
    };
    let mut variables = Variables::of(&[VariableKind::Offsets, VariableKind::HomeHeight]);
    variables.symmetry = KeptSymmetry::ThreeFold;
    variables.offset_bounds = [(-0.3, 1.3); 6];
    DimensionalProblem {
        characteristic_length: m.platform_rms_radius(),
        manipulator: m,
        requirements,
        space,
        variables,
        objectives: vec![(Objective::WorstConditioning, 1.0)],
        mode: Mode::Weighted,
        min_abs_det: 0.05,
    }
}

/// Without niches the members of most populations gather in the larger region within 15 generations.
#[test]
fn every_population_has_a_start_in_the_small_region() {
    let p = bench();
    let (model, task) = (Model::new(&p).unwrap(), everything(1));
    for seed in 1..=4 {
        let options = ShapeSearchOptions { seed, ..ShapeSearchOptions::default() };
        let starts = population(&model, &task, &[], 0, &options);
        assert!((2..=options.starts).contains(&starts.len()), "{seed}");
        let is_outside = |zone: Zone| {
            starts.iter().any(|s| Branch::of(&model.shape.offsets(&s.x).unwrap()) == Branch([zone; 6]))
        };
        assert!(is_outside(Zone::Before) || is_outside(Zone::Beyond), "{seed}");
        assert!(is_outside(Zone::Inside), "{seed}");
    }
}
