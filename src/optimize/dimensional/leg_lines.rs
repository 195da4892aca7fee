//! The legs at a pose: lines, lengths, rows of the Jacobian and forces under a load, with gradients.

use nalgebra::{Matrix6, Rotation3, Vector3, Vector6};

use super::pull::Gradient;
use super::shape::JointEnds;
use machine::requirements::{HeldLines, LegsWeight, Load};
use num::ordered::Sloped;
use platform::geom::Pose;

/// A held pose of the requirements.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HeldPose {
    /// The given pose, before home is lifted.
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

    /// The gradient by the line of a leg, from that by its unit vector.
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
        // moment . (arm x u): the gradient is u x moment at the arm, moment x arm at u
        pull.at_arm(leg, &u.cross(&moment));
        pull.line(leg, self.along_line(leg, &(force + moment.cross(arm))));
    }
}

/// The legs at a pose, factorised for loads.
pub(super) struct HeldLegs<'a> {
    legs: &'a LegLines,
    length: f64,
    lines: HeldLines,
    /// The inverse for gradients; `None` without gradients, and at a singular pose.
    inverse: Option<Matrix6<f64>>,
}

/// Leg forces in equilibrium with a load, and the data for their derivatives.
pub(super) struct Forces<'a> {
    pub values: Vector6<f64>,
    held: &'a HeldLegs<'a>,
    weight: Option<&'a LegsWeight>,
}

impl<'a> HeldLegs<'a> {
    pub(super) fn new<P: Gradient>(legs: &'a LegLines, length: f64) -> Self {
        let lines = HeldLines::new(&legs.jacobian(length), length);
        let inverse = if P::KEPT { lines.inverse() } else { None };
        Self { legs, length, lines, inverse }
    }

    /// `sum F_i (u_i, R b_i x u_i) = -(f, t)`; `None` at a singular pose.
    pub(super) fn hold(&'a self, load: &'a Load) -> Option<Forces<'a>> {
        let legs = std::array::from_fn(|i| (self.legs.arm[i], self.legs.line[i]));
        let values = self.lines.forces(&load.wrench_on(&self.legs.rotation, &legs))?;
        Some(Forces { values, held: self, weight: load.legs.as_ref() })
    }

    /// Adds the gradient of `-g . (w, R b x w / L)`, with the weight `w` of a leg on its platform joint.
    fn pull_weight<P: Gradient>(
        &self,
        pull: &mut P,
        weight: &LegsWeight,
        leg: usize,
        g: &Vector6<f64>,
    ) -> Option<()> {
        let (force, moment): (Vector3<f64>, Vector3<f64>) =
            (g.fixed_rows::<3>(0).into(), g.fixed_rows::<3>(3) / self.length);
        let arm = &self.legs.arm[leg];
        let w = weight.at_joint(&Sloped::point(&self.legs.line[leg]))?;
        pull.at_arm(leg, &moment.cross(&Vector3::from(w.map(|x| x.value))));
        let on = force + moment.cross(arm);
        pull.line(leg, -(0..3).map(|k| w[k].slope * on[k]).sum::<Vector3<f64>>());
        Some(())
    }
}

impl Forces<'_> {
    /// Force of a leg and its gradient `dF_i = - sum_j y . (F_j d(column j) + d(weight of leg j))`, with row `i` of the
    /// inverse as `y`.
    pub(super) fn of<P: Gradient>(&self, leg: usize) -> (f64, P) {
        let (mut pull, held) = (P::none(), self.held);
        if let Some(inverse) = &held.inverse {
            let y: Vector6<f64> = inverse.row(leg).transpose();
            for j in 0..6 {
                held.legs.pull_row(&mut pull, j, held.length, &(y * -self.values[j]));
                let _ = self.weight.and_then(|weight| held.pull_weight(&mut pull, weight, j, &y));
            }
        }
        (self.values[leg], pull)
    }
}
