//! Real points of sets of poses of positive dimension, from many starts: a search, not a proof.
//!
//! From random real poses the Levenberg-Marquardt method leads to nearby zeros of the leg equations. A zero is on a set
//! of positive dimension when a small step in the flat directions of the equations leads to another zero. Zeros are on
//! one component when a walk of small steps leads from one to the other.

use nalgebra::{Matrix6, Rotation3, SVector, Vector3, Vector6};

use num::small::bounded_svd;
use num::{Purpose, Rng};
use platform::geom::{Pose, nearest_rotation, random_rotation, turn_between};
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// Random poses from which zeros are searched for.
const STARTS: u64 = 24;
/// Iterations of the search; on sets of multiplicity the error is halved in each.
const ITERATIONS: usize = 80;
/// Largest error of a zero in the leg equations over size squared, relative to the square of the pose's own numbers.
const RESIDUAL: f64 = 1e-13;
/// Directions with singular values below this times the largest are flat: zeros of multiplicity are known to the root
/// of rounding only.
const FLAT: f64 = 1e-5;
/// Length of the steps that tell a set from an isolated pose, radians and design sizes.
const STRIDE: f64 = 1e-2;
/// Steps of the walk between two zeros.
const STEPS: usize = 24;

/// The leg equations at real poses.
struct RealLegEquations<'a> {
    m: &'a Manipulator,
    squares: [f64; 6],
    size: f64,
}

/// One real pose on each real component of positive dimension that the search met.
pub(super) fn real_points(m: &Manipulator, s: &SquaredLegLengths, seed: u64) -> Vec<Pose> {
    let equations = RealLegEquations { m, squares: s.get(), size: m.size() };
    let mut found: Vec<Pose> = Vec::new();
    for k in 0..STARTS {
        let mut rng = Purpose::REAL_POINTS.item(seed, k);
        let Some(zero) = equations.zero_from(&equations.start(&mut rng)) else { continue };
        if equations.moves(&zero, &mut rng) && !found.iter().any(|f| equations.are_joined(f, &zero)) {
            found.push(zero);
        }
    }
    found
}

impl RealLegEquations<'_> {
    /// A random rotation, one leg of its length in a random direction.
    fn start(&self, rng: &mut Rng) -> Pose {
        let rotation = random_rotation(rng);
        let k = (rng.next_u64() % 6) as usize;
        let leg = &self.m.legs()[k];
        let along = Vector3::from_fn(|_, _| rng.normal()).normalize() * self.squares[k].sqrt();
        Pose { rotation, position: leg.base.coords + along - rotation * leg.platform.coords }
    }

    /// `(|R b + p - a|^2 - s) / size^2`, and the derivatives by position over size and rotation vector.
    fn linearised(&self, pose: &Pose) -> (Vector6<f64>, Matrix6<f64>) {
        let square = self.size * self.size;
        let (mut values, mut jacobian) = (Vector6::zeros(), Matrix6::zeros());
        for (i, leg) in self.m.legs().iter().enumerate() {
            let arm = pose.rotation * leg.platform.coords;
            let d = arm + pose.position - leg.base.coords;
            let moment = arm.cross(&d);
            values[i] = (d.norm_squared() - self.squares[i]) / square;
            for k in 0..3 {
                jacobian[(i, k)] = 2.0 * d[k] / self.size;
                jacobian[(i, 3 + k)] = 2.0 * moment[k] / square;
            }
        }
        (values, jacobian)
    }

    fn displaced(&self, pose: &Pose, step: &Vector6<f64>) -> Pose {
        let turn = Rotation3::new(Vector3::new(step[3], step[4], step[5]));
        let shift = Vector3::new(step[0], step[1], step[2]) * self.size;
        Pose { rotation: nearest_rotation((turn * pose.rotation).matrix()), position: pose.position + shift }
    }

    /// The step from one pose to another.
    fn step(&self, from: &Pose, to: &Pose) -> Vector6<f64> {
        let turn = turn_between(&from.rotation, &to.rotation);
        let shift = (to.position - from.position) / self.size;
        Vector6::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z)
    }

    fn is_zero(&self, pose: &Pose, values: &Vector6<f64>) -> bool {
        let reach = 1.0 + pose.position.norm() / self.size;
        values.amax() <= RESIDUAL * reach * reach
    }

    /// Levenberg-Marquardt with the residual as damping (Fan, Yuan 2005): it converges also where zeros form a set.
    fn zero_from(&self, start: &Pose) -> Option<Pose> {
        let mut pose = *start;
        let (mut values, mut jacobian) = self.linearised(&pose);
        let mut damping = 1.0;
        for _ in 0..ITERATIONS {
            let normal = jacobian.transpose() * jacobian;
            let shift = Matrix6::identity() * (damping * values.norm());
            let Some(factor) = (normal + shift).cholesky() else { break };
            let next = self.displaced(&pose, &-factor.solve(&(jacobian.transpose() * values)));
            let (there, derivatives) = self.linearised(&next);
            if there.norm() < values.norm() {
                (pose, values, jacobian) = (next, there, derivatives);
                damping = (damping * 0.3).max(1e-3);
            } else if self.is_zero(&pose, &values) {
                break;
            } else {
                damping *= 8.0;
            }
        }
        self.is_zero(&pose, &values).then_some(pose)
    }

    /// Whether another zero is a small step away.
    fn moves(&self, zero: &Pose, rng: &mut Rng) -> bool {
        let Some(svd) = bounded_svd(&self.linearised(zero).1) else { return false };
        let Some(directions) = svd.v_t else { return false };
        let flat = |k: &usize| svd.singular_values[*k] <= FLAT * svd.singular_values.max();
        let flat: Vec<usize> = (0..6).filter(flat).collect();
        !flat.is_empty()
            && (0..4).any(|_| {
                let mut step: Vector6<f64> = SVector::zeros();
                for k in &flat {
                    step += directions.row(*k).transpose() * rng.normal();
                }
                let step = step.normalize() * STRIDE;
                let other = self.zero_from(&self.displaced(zero, &step));
                other.is_some_and(|o| {
                    let distance = self.step(zero, &o).norm();
                    distance > 0.1 * STRIDE && distance < 4.0 * STRIDE
                })
            })
    }

    /// Whether a walk of small steps leads from one zero to another.
    fn are_joined(&self, from: &Pose, to: &Pose) -> bool {
        let mut here = *from;
        for left in (1..=STEPS).rev() {
            let whole = self.step(&here, to);
            let Some(next) = self.zero_from(&self.displaced(&here, &(whole / left as f64))) else {
                return false;
            };
            if self.step(&here, &next).norm() > 3.0 * whole.norm() / left as f64 + STRIDE {
                return false;
            }
            here = next;
        }
        self.step(&here, to).norm() < STRIDE
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;
    use platform::manipulator::{Leg, LegLengths};

    use platform::geom::rotation_vector;

    fn bodies(seed: u64) -> [[Point3<f64>; 6]; 2] {
        let mut rng = Rng::new(seed);
        std::array::from_fn(|_| {
            std::array::from_fn(|_| Point3::from(Vector3::from_fn(|_, _| rng.uniform(-2.0, 2.0))))
        })
    }

    fn design(joints: &[[Point3<f64>; 6]; 2]) -> Manipulator {
        let leg = |i: usize| Leg { base: joints[0][i], platform: joints[1][i] };
        Manipulator::from_legs(std::array::from_fn(leg)).unwrap()
    }

    #[test]
    fn congruent_bodies_have_one_sphere_and_other_lengths_nothing() {
        for seed in 0..4 {
            let [base, _] = bodies(seed);
            let m = design(&[base, base]);
            let s = LegLengths::try_new([3.0; 6]).unwrap().squared();
            let found = real_points(&m, &s, seed);
            assert!(found.iter().any(
                |p| rotation_vector(&p.rotation).norm() < 1e-6 && (p.position.norm() - 3.0).abs() < 1e-6
            ));
            let s = LegLengths::try_new([3.0, 3.0, 3.0, 3.0, 3.0, 3.1]).unwrap().squared();
            assert!(real_points(&m, &s, seed).is_empty());
        }
    }

    #[test]
    fn a_body_on_a_line_turns_and_a_general_one_does_not() {
        let [base, mut platform] = bodies(7);
        let pose = Pose {
            rotation: Rotation3::new(Vector3::new(0.3, 0.2, -0.4)),
            position: Vector3::new(0.3, 0.1, 3.0),
        };
        let general = design(&[base, platform]);
        assert!(real_points(&general, &pose.squared_lengths(&general).unwrap(), 1).is_empty());
        for (k, p) in platform.iter_mut().enumerate() {
            *p = Point3::from(Vector3::new(1.0, -0.5, 0.3) * (k as f64 - 2.4));
        }
        let m = design(&[base, platform]);
        assert!(!real_points(&m, &pose.squared_lengths(&m).unwrap(), 1).is_empty());
    }
}
