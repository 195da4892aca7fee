//! Inverse condition number of the platform without shared joints over the poses, with analytic derivatives.
//!
//! Row `i` of the Jacobian depends on offset `t_i` alone, so `dJ/dt_i` has one row and every derivative of a
//! singular value is a product of two numbers.

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

/// Rows of `J`, of `dJ/dt` and of `d2J/dt2`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JacobianRows {
    pub value: Matrix6<f64>,
    pub rate: Matrix6<f64>,
    pub bend: Matrix6<f64>,
}

/// Singular value decomposition at a pose together with `B = (dJ/dt) V` and `F = (d2J/dt2) V`.
#[derive(Debug, Clone)]
pub(crate) struct PoseSpectrum {
    /// Singular values, largest first.
    pub sigma: [f64; 6],
    u: Matrix6<f64>,
    rate: Matrix6<f64>,
    bend: Matrix6<f64>,
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

    /// `u = c/|c|`, `u' = (c' - k u)/|c|`, `u'' = -(2 k u' + k' u)/|c|` with `k = u.c'`, `k' = u'.c'`.
    fn row_with_derivatives(&self, t: f64, moment_scale: f64) -> [Vector6<f64>; 3] {
        let (arm, line) = (self.arm + self.arm_rate * t, self.line + self.line_rate * t);
        let length = line.norm();
        let u = line / length;
        let k = u.dot(&self.line_rate);
        let u1 = (self.line_rate - u * k) / length;
        let u2 = -(u1 * (2.0 * k) + u * u1.dot(&self.line_rate)) / length;
        let m = arm.cross(&u);
        let m1 = self.arm_rate.cross(&u) + arm.cross(&u1);
        let m2 = self.arm_rate.cross(&u1) * 2.0 + arm.cross(&u2);
        [stack(u, m * moment_scale), stack(u1, m1 * moment_scale), stack(u2, m2 * moment_scale)]
    }
}

impl PoseLegs {
    /// `sides` and `characteristic_length` are already divided by `scale`, the pose is not.
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

    /// `sigma_6 / sigma_1`; 0 where a leg has no length.
    pub(super) fn inverse_condition(&self, t: &[f64; 6]) -> f64 {
        platform::manipulator::inverse_condition(&self.jacobian(t))
    }

    pub(super) fn rows(&self, t: &[f64; 6]) -> JacobianRows {
        let mut rows =
            JacobianRows { value: Matrix6::zeros(), rate: Matrix6::zeros(), bend: Matrix6::zeros() };
        for i in 0..6 {
            let [r, r1, r2] = self.legs[i].row_with_derivatives(t[i], self.moment_scale);
            rows.value.set_row(i, &r.transpose());
            rows.rate.set_row(i, &r1.transpose());
            rows.bend.set_row(i, &r2.transpose());
        }
        rows
    }

    /// `None` when an entry is not finite or the decomposition does not converge.
    pub(super) fn spectrum(&self, t: &[f64; 6]) -> Option<PoseSpectrum> {
        let rows = self.rows(t);
        if rows.rate.iter().any(|x| !x.is_finite()) {
            return None; // the entries themselves are looked at below
        }
        let svd = bounded_svd(&rows.value)?;
        let (u, v_t) = (svd.u?, svd.v_t?);
        let v = v_t.transpose();
        let sigma = std::array::from_fn(|k| svd.singular_values[k]);
        Some(PoseSpectrum { sigma, u, rate: rows.rate * v, bend: rows.bend * v })
    }
}

impl PoseSpectrum {
    pub(super) fn inverse_condition(&self) -> f64 {
        if self.sigma[0] > 0.0 { self.sigma[5] / self.sigma[0] } else { 0.0 }
    }

    /// First derivative of entry `(a, b)` of the symmetric part of `U^T J V`, singular vectors frozen.
    ///
    /// For `a = b` it is the gradient of `sigma_a`; for a cluster of equal singular values the eigenvalues
    /// of these blocks along a direction are the directional derivatives of the cluster.
    pub(crate) fn block_gradient(&self, a: usize, b: usize) -> [f64; 6] {
        std::array::from_fn(|j| {
            0.5 * (self.u[(j, a)] * self.rate[(j, b)] + self.u[(j, b)] * self.rate[(j, a)])
        })
    }

    /// Hessian of `sigma_k` without the coupling to the singular values in `cluster`, whose curvature the
    /// second-order cones of the subproblem carry exactly.
    ///
    /// Second-order perturbation of the symmetric matrix `[0 J; J^T 0]`:
    /// `u^T J'' v + sum_o ((alpha+beta)^2 / (sigma_k - sigma_o) + (alpha-beta)^2 / (sigma_k + sigma_o)) / 2`,
    /// `alpha = u_o^T J' v_k`, `beta = u_k^T J' v_o`.
    fn smooth_hessian(&self, k: usize, cluster: &[usize]) -> Matrix6<f64> {
        let mut h = Matrix6::from_fn(|j, l| if j == l { self.u[(j, k)] * self.bend[(j, k)] } else { 0.0 });
        for o in (0..6).filter(|&o| o != k) {
            let alpha = Vector6::from_fn(|j, _| self.u[(j, o)] * self.rate[(j, k)]);
            let beta = Vector6::from_fn(|j, _| self.u[(j, k)] * self.rate[(j, o)]);
            let (plus, minus) = (alpha + beta, alpha - beta);
            let sum = self.sigma[k] + self.sigma[o];
            if sum > 0.0 {
                h += minus * minus.transpose() * (0.5 / sum);
            }
            let gap = self.sigma[k] - self.sigma[o];
            if !cluster.contains(&o) && gap != 0.0 {
                h += plus * plus.transpose() * (0.5 / gap);
            }
        }
        h
    }

    /// Hessian of `g = sigma_6 / sigma_1`, couplings inside the two clusters left out:
    /// `(H_6 - g H_1 - grad g grad sigma_1^T - grad sigma_1 grad g^T) / sigma_1`.
    pub(crate) fn smooth_ratio_hessian(&self, low: &[usize], high: &[usize]) -> Matrix6<f64> {
        let (g, top) = (self.inverse_condition(), self.sigma[0]);
        let d_low = Vector6::from(self.block_gradient(5, 5));
        let d_top = Vector6::from(self.block_gradient(0, 0));
        let d_g = (d_low - d_top * g) / top;
        let cross = d_g * d_top.transpose();
        (self.smooth_hessian(5, low) - self.smooth_hessian(0, high) * g - cross - cross.transpose()) / top
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

/// As [`worst_case`], given up at the first pose whose value is not above `floor`; `hint` is tried first.
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
            let bend = (a.rate - b.rate) / (2.0 * h);
            assert!((rate.row(j) - at.rate.row(j)).norm() < 1e-8);
            assert!((bend.row(j) - at.bend.row(j)).norm() < 1e-8);
            let others: f64 = (0..6).filter(|&i| i != j).map(|i| rate.row(i).norm()).sum();
            assert!(others < 1e-14, "row {j} alone depends on offset {j}");
        }
    }

    #[test]
    fn gradient_and_hessian_of_the_ratio_match_finite_differences() {
        let (p, h) = (legs(2), 1e-5);
        let ratio_gradient = |t: &[f64; 6]| {
            let s = p.spectrum(t).unwrap();
            let (low, top) = (s.block_gradient(5, 5), s.block_gradient(0, 0));
            Vector6::from_fn(|j, _| (low[j] - s.inverse_condition() * top[j]) / s.sigma[0])
        };
        let gradient = ratio_gradient(&T);
        let hessian = p.spectrum(&T).unwrap().smooth_ratio_hessian(&[], &[]);
        for j in 0..6 {
            let value = |x: f64| p.inverse_condition(&moved(j, x));
            assert!(((value(h) - value(-h)) / (2.0 * h) - gradient[j]).abs() < 1e-8);
            let column = (ratio_gradient(&moved(j, h)) - ratio_gradient(&moved(j, -h))) / (2.0 * h);
            assert!((column - hessian.column(j)).norm() < 1e-6 * hessian.norm(), "column {j}");
        }
    }
}
