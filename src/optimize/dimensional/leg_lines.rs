//! The legs at a pose: lines, lengths, rows of the Jacobian and the forces that hold a load, with gradients.

use nalgebra::{Matrix6, Rotation3, Vector3, Vector6};

use super::pull::Gradient;
use super::shape::JointEnds;
use machine::requirements::{LegsWeight, Load};
use platform::geom::Pose;

/// A pose at which the requirements are held.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HeldPose {
    /// As given, before home is lifted.
    pub pose: Pose,
    /// Whether it moves with home.
    pub follows: bool,
}

/// The six legs at a pose.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LegLines {
    pub rotation: Rotation3<f64>,
    pub position: Vector3<f64>,
    pub base: [Vector3<f64>; 6],
    /// `R b`.
    pub arm: [Vector3<f64>; 6],
    /// `R b + p - a`.
    pub line: [Vector3<f64>; 6],
    pub length: [f64; 6],
    pub direction: [Vector3<f64>; 6],
}

impl LegLines {
    pub(super) fn new(ends: &JointEnds, at: &HeldPose) -> Self {
        let rotation = at.pose.rotation;
        let position = if at.follows { at.pose.position + ends.lift } else { at.pose.position };
        let arm = ends.platform.map(|b| rotation * b);
        let line: [Vector3<f64>; 6] = std::array::from_fn(|i| arm[i] + position - ends.base[i]);
        let length = line.map(|d| d.norm());
        let direction = std::array::from_fn(|i| line[i] / length[i]);
        Self { rotation, position, base: ends.base, arm, line, length, direction }
    }

    /// A gradient with respect to the unit vector of a leg as one with respect to its line.
    fn along_line(&self, leg: usize, g: &Vector3<f64>) -> Vector3<f64> {
        let u = &self.direction[leg];
        (g - u * u.dot(g)) / self.length[leg]
    }

    /// Row `[u, (R b x u) / L]` of a leg.
    pub(super) fn row(&self, leg: usize, length: f64) -> Vector6<f64> {
        let (u, m) = (self.direction[leg], self.arm[leg].cross(&self.direction[leg]) / length);
        Vector6::new(u.x, u.y, u.z, m.x, m.y, m.z)
    }

    pub(super) fn jacobian(&self, length: f64) -> Matrix6<f64> {
        let mut j = Matrix6::zeros();
        for i in 0..6 {
            j.set_row(i, &self.row(i, length).transpose());
        }
        j
    }

    /// Adds the gradient of `g . row(leg)`.
    pub(crate) fn pull_row<P: Gradient>(&self, pull: &mut P, leg: usize, length: f64, g: &Vector6<f64>) {
        if !P::KEPT {
            return;
        }
        let (force, moment): (Vector3<f64>, Vector3<f64>) =
            (g.fixed_rows::<3>(0).into(), g.fixed_rows::<3>(3) / length);
        let (u, arm) = (&self.direction[leg], &self.arm[leg]);
        // moment . (arm x u): u x moment pulls at the arm, moment x arm at u
        pull.at_arm(leg, &u.cross(&moment));
        pull.line(leg, self.along_line(leg, &(force + moment.cross(arm))));
    }
}

/// Leg forces that hold a load, and what their derivatives need.
#[derive(Debug, Clone)]
pub(super) struct Forces<'a> {
    pub values: Vector6<f64>,
    inverse: &'a Matrix6<f64>,
    weight: Option<&'a LegsWeight>,
}

/// Inverse of the matrix with the columns `[u, (R b x u) / L]`, which the forces under all loads share; `None` at a
/// singular pose.
pub(crate) fn inverse_of_columns(l: &LegLines, length: f64) -> Option<Matrix6<f64>> {
    l.jacobian(length).transpose().try_inverse()
}

/// `sum F_i (u_i, R b_i x u_i) = -(f, t)`; `None` at a singular pose.
pub(super) fn leg_forces<'a>(
    l: &LegLines,
    inverse: Option<&'a Matrix6<f64>>,
    load: &'a Load,
    length: f64,
) -> Option<Forces<'a>> {
    let inverse = inverse?;
    let mut wrench = load.wrench_on(&l.rotation, l.arm.into_iter().zip(l.line));
    wrench.fixed_rows_mut::<3>(3).scale_mut(1.0 / length);
    let forces = -(inverse * wrench);
    let weight = load.legs.as_ref();
    forces.iter().all(|x| x.is_finite()).then_some(Forces { values: forces, inverse, weight })
}

/// Adds the gradient of `-g . (w, R b x w / L)`, `w` the weight of a leg on its platform joint.
fn pull_weight<P: Gradient>(
    pull: &mut P,
    weight: &LegsWeight,
    l: &LegLines,
    leg: usize,
    (g, length): (&Vector6<f64>, f64),
) {
    let (force, moment): (Vector3<f64>, Vector3<f64>) =
        (g.fixed_rows::<3>(0).into(), g.fixed_rows::<3>(3) / length);
    let (u, arm) = (&l.direction[leg], &l.arm[leg]);
    pull.at_arm(leg, &-weight.at_joint(&l.line[leg]).cross(&moment));
    // e . w with w = c + (k - u (u . k)) / q changes with the line by
    // (3 (e . u) (u . k) u - (e . k) u - e (u . k) - k (e . u)) / q^2
    let (e, k) = (force + moment.cross(arm), &weight.moment);
    let (on_e, on_k) = (u.dot(&e), u.dot(k));
    let by_line = (u * (3.0 * on_e * on_k - e.dot(k)) - e * on_k - k * on_e) / l.length[leg].powi(2);
    pull.line(leg, -by_line);
}

impl Forces<'_> {
    /// Force of a leg and its gradient: `dF_i = - sum_j y . (F_j d(column j) + d(weight of leg j))`, `y` row `i` of the
    /// inverse.
    pub(super) fn of<P: Gradient>(&self, l: &LegLines, leg: usize, length: f64) -> (f64, P) {
        let y: Vector6<f64> = self.inverse.row(leg).transpose();
        let mut pull = P::none();
        for j in (0..6).filter(|_| P::KEPT) {
            l.pull_row(&mut pull, j, length, &(y * -self.values[j]));
            if let Some(weight) = self.weight {
                pull_weight(&mut pull, weight, l, j, (&y, length));
            }
        }
        (self.values[leg], pull)
    }
}
