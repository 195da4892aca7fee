//! Objectives of a finished platform over many poses, by code that the search does not use.

use super::problem::{DimensionalProblem, Objective};
use crate::geom::Pose;
use crate::manipulator::{Manipulator, inverse_condition, jacobian};
use crate::num::Rng;
use crate::num::linalg::svd;
use crate::requirements::{Hardware, PoseSpace, Requirements, TermKind, Terms, leg_forces};
use crate::synthesis::{Normalisation, leg_vector};

/// Every objective of a platform, in the order of the problem and in its unit (see the theory page).
///
/// `space` has the home of the platform. `points` Halton points and as many random ones are looked at besides home, corners and listed poses; the mean is that over all of
/// them. `also` are poses of the space at which the worst case is looked for besides, those of a search for instance. NaN where the platform has no value (forces at a singular pose).
#[must_use]
pub fn evaluate(
    p: &DimensionalProblem,
    m: &Manipulator,
    space: &PoseSpace,
    also: &[Pose],
    points: usize,
    seed: u64,
) -> Vec<f64> {
    let mut poses = also.to_vec();
    poses.extend(space.listed(10));
    let cube = space.cube_points(points, &mut Rng::stream(seed, 0x6576));
    poses.extend(cube.iter().map(|x| space.pose(x)));
    p.objectives.iter().map(|(o, _)| value(p, m, (&poses, also.len()), *o)).collect()
}

/// The first poses, as many as told, are not in the mean.
fn value(p: &DimensionalProblem, m: &Manipulator, (poses, apart): (&[Pose], usize), o: Objective) -> f64 {
    let length = p.characteristic_length;
    let over = |f: &dyn Fn(&Pose) -> f64| poses.iter().map(f).fold(f64::INFINITY, f64::min);
    let conditioning = |pose: &Pose| inverse_condition(&jacobian(m, pose, length));
    let least_singular = |pose: &Pose| {
        let j = jacobian(m, pose, length);
        let rows: Vec<Vec<f64>> = j.row_iter().map(|r| r.iter().copied().collect()).collect();
        svd(&rows).map_or(f64::NAN, |d| d.s[5])
    };
    match o {
        Objective::WorstConditioning => over(&conditioning),
        Objective::MeanConditioning => {
            let sample = &poses[apart..];
            sample.iter().map(conditioning).sum::<f64>() / sample.len() as f64
        }
        Objective::SmallestSingularValue => over(&least_singular),
        Objective::Stiffness => {
            let k = p.requirements.hardware.leg_stiffness.unwrap_or(f64::NAN);
            k * over(&|pose| least_singular(pose).powi(2))
        }
        Objective::LegForce => -over(&|pose| {
            let loads = p.requirements.loads.iter();
            let worst = loads.map(|load| {
                leg_forces(m, pose, &load.wrench(pose), m.size()).map_or(f64::INFINITY, |f| f.amax())
            });
            -worst.fold(0.0, f64::max)
        }),
        Objective::JointSpacing => spacing(m),
        Objective::LegClearance => {
            let hardware = Hardware { leg_body: p.requirements.hardware.leg_body, ..Hardware::default() };
            let alone = Requirements { hardware, ..Requirements::default() };
            over(&|pose| {
                let margins = Terms::new(m, &alone, pose).at(pose);
                let own = margins.into_iter().filter(|t| t.0.kind == TermKind::LegClearance);
                own.map(|t| t.1).fold(f64::INFINITY, f64::min)
            })
        }
        Objective::Stroke => {
            let lengths = || poses.iter().flat_map(|pose| m.legs().map(|l| pose.squared_length(&l).sqrt()));
            lengths().fold(0.0, f64::max) - lengths().fold(f64::INFINITY, f64::min)
        }
        Objective::SingularityDistance => {
            let n = Normalisation::of(&p.manipulator);
            let rows: Vec<Vec<f64>> = m.legs().iter().map(|l| leg_vector(&n.apply(l)).to_vec()).collect();
            svd(&rows).map_or(f64::NAN, |d| d.s[5])
        }
    }
}

/// Least distance of two joint centres of a body that carry legs.
fn spacing(m: &Manipulator) -> f64 {
    let mut least = f64::INFINITY;
    let bodies = [(m.base_joints(), m.pairs().map(|p| p.0)), (m.platform_joints(), m.pairs().map(|p| p.1))];
    for (joints, used) in bodies {
        for (k, i) in used.iter().enumerate() {
            for j in used[..k].iter().filter(|j| *j != i) {
                least = least.min((joints[*i] - joints[*j]).norm());
            }
        }
    }
    least
}
