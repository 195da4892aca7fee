//! Inverse condition number of the platform without shared joints over the poses, with analytic derivatives.
//!
//! Row `i` of the Jacobian depends only on offset `t_i`. So `dJ/dt_i` has one row, and every derivative of a singular
//! value is a product of two numbers.

use nalgebra::{Matrix6, Vector3, Vector6};

use num::small::bounded_svd;
use platform::geom::Pose;
use platform::manipulator::Body;
use synthesis::HexagonSide;

/// One leg at one pose: `arm = R b` and `line = R b + p - a` are affine in the offset.
#[derive(Debug, Clone, Copy)]
struct LegLine {
    arm: Vector3<f64>,
    arm_rate: Vector3<f64>,
    line: Vector3<f64>,
    line_rate: Vector3<f64>,
}

/// The six legs at one pose, lengths relative to the scale of the problem.
#[derive(Debug, Clone)]
pub(crate) struct PoseLegs {
    legs: [LegLine; 6],
    /// 1 / characteristic length.
    moment_scale: f64,
}

/// Rows of `J` and of `dJ/dt`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JacobianRows {
    pub value: Matrix6<f64>,
    pub rate: Matrix6<f64>,
}

/// Singular value decomposition at a pose together with `(dJ/dt) V`.
#[derive(Debug, Clone)]
pub(crate) struct PoseSpectrum {
    /// Singular values, largest first.
    pub sigma: [f64; 6],
    u: Matrix6<f64>,
    rate: Matrix6<f64>,
}

fn stack(force: Vector3<f64>, moment: Vector3<f64>) -> Vector6<f64> {
    Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
}

impl LegLine {
    fn row(&self, t: f64, moment_scale: f64) -> Vector6<f64> {
        let (arm, line) = (self.arm + self.arm_rate * t, self.line + self.line_rate * t);
        let u = line / line.norm();
        stack(u, arm.cross(&u) * moment_scale)
    }

    /// `u = c/|c|`, `u' = (c' - u (u.c'))/|c|`.
    fn row_with_rate(&self, t: f64, moment_scale: f64) -> [Vector6<f64>; 2] {
        let (arm, line) = (self.arm + self.arm_rate * t, self.line + self.line_rate * t);
        let length = line.norm();
        let u = line / length;
        let rate = (self.line_rate - u * u.dot(&self.line_rate)) / length;
        let (moment, moment_rate) = (arm.cross(&u), self.arm_rate.cross(&u) + arm.cross(&rate));
        [stack(u, moment * moment_scale), stack(rate, moment_rate * moment_scale)]
    }
}

impl PoseLegs {
    /// `sides` and `characteristic_length` are already divided by `scale`; the pose is not.
    pub(super) fn new(sides: &[HexagonSide; 6], pose: &Pose, characteristic_length: f64, scale: f64) -> Self {
        let position = pose.position / scale;
        let legs = sides.map(|side| {
            let leg = side.leg(0.0);
            let (base_rate, platform_rate) = match side.sliding {
                Body::Base => (side.edge(), Vector3::zeros()),
                Body::Platform => (Vector3::zeros(), side.edge()),
            };
            let (arm, arm_rate) = (pose.rotation * leg.platform.coords, pose.rotation * platform_rate);
            LegLine { arm, arm_rate, line: arm + position - leg.base.coords, line_rate: arm_rate - base_rate }
        });
        Self { legs, moment_scale: 1.0 / characteristic_length }
    }

    pub(super) fn jacobian(&self, t: &[f64; 6]) -> Matrix6<f64> {
        let mut j = Matrix6::zeros();
        for i in 0..6 {
            j.set_row(i, &self.legs[i].row(t[i], self.moment_scale).transpose());
        }
        j
    }

    /// `sigma_6 / sigma_1`; 0 if a leg has no length.
    pub(super) fn inverse_condition(&self, t: &[f64; 6]) -> f64 {
        platform::manipulator::inverse_condition(&self.jacobian(t))
    }

    pub(super) fn rows(&self, t: &[f64; 6]) -> JacobianRows {
        let mut rows = JacobianRows { value: Matrix6::zeros(), rate: Matrix6::zeros() };
        for i in 0..6 {
            let [row, rate] = self.legs[i].row_with_rate(t[i], self.moment_scale);
            rows.value.set_row(i, &row.transpose());
            rows.rate.set_row(i, &rate.transpose());
        }
        rows
    }

    /// `None` if an entry is not finite or the decomposition does not converge.
    pub(super) fn spectrum(&self, t: &[f64; 6]) -> Option<PoseSpectrum> {
        let rows = self.rows(t);
        if rows.rate.iter().any(|x| !x.is_finite()) {
            return None; // the entries themselves are tested below
        }
        let svd = bounded_svd(&rows.value)?;
        let (u, v_t) = (svd.u?, svd.v_t?);
        let v = v_t.transpose();
        let sigma = std::array::from_fn(|k| svd.singular_values[k]);
        Some(PoseSpectrum { sigma, u, rate: rows.rate * v })
    }
}

impl PoseSpectrum {
    pub(super) fn inverse_condition(&self) -> f64 {
        if self.sigma[0] > 0.0 { self.sigma[5] / self.sigma[0] } else { 0.0 }
    }

    /// First derivative of entry `(a, b)` of the symmetric part of `U^T J V`, singular vectors frozen.
    ///
    /// For `a = b` it is the gradient of `sigma_a`. For a cluster of equal singular values, the eigenvalues of these
    /// blocks along a direction are the directional derivatives.
    pub(crate) fn block_gradient(&self, a: usize, b: usize) -> [f64; 6] {
        std::array::from_fn(|j| {
            0.5 * (self.u[(j, a)] * self.rate[(j, b)] + self.u[(j, b)] * self.rate[(j, a)])
        })
    }
}

/// Smallest inverse condition number over the poses and the pose where it occurs (the first of equals).
pub(crate) fn worst_case(poses: &[PoseLegs], t: &[f64; 6]) -> (f64, usize) {
    let mut worst = (f64::INFINITY, 0);
    for (k, pose) in poses.iter().enumerate() {
        let value = pose.inverse_condition(t);
        if value < worst.0 {
            worst = (value, k);
        }
    }
    worst
}

/// [`worst_case`], stopped at the first pose whose value is not above `floor`; `hint` is tried first.
pub(crate) fn worst_case_above(
    poses: &[PoseLegs],
    t: &[f64; 6],
    floor: f64,
    hint: usize,
) -> Result<(f64, usize), (f64, usize)> {
    let mut worst = (f64::INFINITY, 0);
    let others = (0..poses.len()).filter(|&k| k != hint);
    for k in std::iter::once(hint).chain(others) {
        let value = poses[k].inverse_condition(t);
        if value < worst.0 {
            worst = (value, k);
        }
        if worst.0 <= floor {
            return Err(worst);
        }
    }
    Ok(worst)
}

#[cfg(test)]
mod tests {
    use super::super::tests::{example, poses};
    use super::*;
    use platform::manipulator;
    use synthesis::sides;

    const T: [f64; 6] = [0.3, -0.4, 0.2, 1.3, 0.6, 0.8];
    const SCALE: f64 = 7.0;

    fn legs(k: usize) -> PoseLegs {
        PoseLegs::new(&sides(&example(), SCALE), &poses()[k], 3.0 / SCALE, SCALE)
    }

    #[test]
    fn rows_are_those_of_the_manipulator_module() {
        let (m, _) = synthesis::joint_free(&example(), T).unwrap();
        for (k, pose) in poses().iter().enumerate() {
            let j = manipulator::jacobian(&m, pose, 3.0);
            assert!((j - legs(k).jacobian(&T)).norm() < 1e-13);
            assert!((j - legs(k).rows(&T).value).norm() < 1e-13);
        }
    }

    fn moved(j: usize, h: f64) -> [f64; 6] {
        let mut t = T;
        t[j] += h;
        t
    }

    #[test]
    fn row_derivatives_match_finite_differences() {
        let (p, h) = (legs(3), 1e-5);
        let at = p.rows(&T);
        for j in 0..6 {
            let (a, b) = (p.rows(&moved(j, h)), p.rows(&moved(j, -h)));
            let rate = (a.value - b.value) / (2.0 * h);
            assert!((rate.row(j) - at.rate.row(j)).norm() < 1e-8);
            let others: f64 = (0..6).filter(|&i| i != j).map(|i| rate.row(i).norm()).sum();
            assert!(others < 1e-14, "row {j} alone depends on offset {j}");
        }
    }

    #[test]
    fn the_gradient_of_the_ratio_matches_finite_differences() {
        let (p, h) = (legs(2), 1e-5);
        let s = p.spectrum(&T).unwrap();
        let (low, top) = (s.block_gradient(5, 5), s.block_gradient(0, 0));
        for j in 0..6 {
            let value = |x: f64| p.inverse_condition(&moved(j, x));
            let gradient = (low[j] - s.inverse_condition() * top[j]) / s.sigma[0];
            assert!(((value(h) - value(-h)) / (2.0 * h) - gradient).abs() < 1e-8);
        }
    }
}
