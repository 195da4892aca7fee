//! The closure condition of the last leg as a product over the poses without it.
//!
//! For `w` on the circle of the shared joint the other legs but one leave 8 poses (4 when two of them have a common base joint). The product
//! of `s_m - s` over them, `s_m` the squared length of the last leg, is a rational function of `w` that vanishes exactly where all legs fit.
//! Its poles do not depend on the last leg: they are where a triangle of the joint and two of the three legs degenerates, the
//! factors `A_ijk` of the trilaterations; multiplied with these it is a Laurent polynomial from `w^-20` to `w^20` (from -12 to 12).

use nalgebra::{Matrix3, Vector3};
use num_complex::Complex64;

use super::circle::{Circle, complex};
use super::rotations::{Angles, Arm, Setting, Three, evaluate};
use crate::num::batch::Batch;

/// Joint on a circle, three legs, and the leg left out.
#[derive(Debug, Clone)]
pub(super) struct Closure {
    pub(super) circle: Circle,
    pub(super) three: Three,
    pub(super) last: Arm,
}

/// What is kept from one evaluation to the next, to start near.
#[derive(Debug, Clone, Default)]
pub(super) struct Scratch {
    warm: Option<Batch>,
    angles: Vec<Angles>,
}

/// One pose without the last leg.
#[derive(Debug, Clone, Copy)]
pub(super) struct Placed {
    pub(super) rotation: Matrix3<Complex64>,
    /// `s_m - s`.
    pub(super) gap: Complex64,
    /// Its derivative by the angle on the circle.
    pub(super) slope: Complex64,
    /// Derivative of the logarithm of the square of the triangle of joint, common base joint and third arm.
    lever: Complex64,
}

/// The poses at one place of the joint.
#[derive(Debug, Clone)]
pub(super) struct Poses {
    /// The joint.
    pub(super) joint: Vector3<Complex64>,
    pub(super) placed: Vec<Placed>,
    /// Derivative of the logarithm of the polynomial by the angle.
    pub(super) slope: Complex64,
}

impl Poses {
    /// How far along the circle a pose is from closing, to first order.
    pub(super) fn step(&self, k: usize) -> f64 {
        (self.placed[k].gap / self.placed[k].slope).norm()
    }

    /// The pose nearest to closing.
    pub(super) fn best(&self) -> Option<usize> {
        (0..self.placed.len()).min_by(|i, j| self.step(*i).total_cmp(&self.step(*j)))
    }
}

impl Closure {
    /// Number of zeros.
    pub(super) fn degree(&self) -> usize {
        if self.three.common() { 24 } else { 40 }
    }

    /// Pairs of the three whose triangles with the joint are factors, squared.
    fn pairs(&self) -> &'static [(usize, usize)] {
        // with a common base joint two triangles are one, and the poles it has are half as many
        if self.three.common() { &[(0, 2)] } else { &[(0, 1), (0, 2), (1, 2)] }
    }

    fn setting(&self, w: Complex64, scratch: &mut Scratch) -> Option<(Vector3<Complex64>, Setting)> {
        let joint = self.circle.at(w).0;
        let setting = self.three.at(&joint)?;
        self.three.angles(&setting, &mut scratch.warm, &mut scratch.angles);
        (scratch.angles.len() == self.three.count()).then_some((joint, setting))
    }

    /// Value of the polynomial over `w^20` (`w^12`).
    pub(super) fn value(&self, w: Complex64, scratch: &mut Scratch) -> Option<Complex64> {
        let (joint, setting) = self.setting(w, scratch)?;
        let form = self.three.form(&setting, &self.last, &joint);
        let gaps = scratch.angles.iter().map(|angles| evaluate(&form, *angles) * -2.0);
        let mut value = gaps.product::<Complex64>();
        let u = self.three.arms().map(|arm| complex(&arm.base) - joint);
        for &(i, j) in self.pairs() {
            let n = u[i].cross(&u[j]);
            let area = n.dot(&n);
            value *= area * area;
        }
        if self.three.common() {
            let third = self.three.arms()[2];
            for angles in scratch.angles.iter().step_by(2) {
                let arm = self.three.rotation(&setting, *angles) * complex(&third.b);
                let n = u[0].cross(&arm);
                value *= n.dot(&n);
            }
        }
        value.is_finite().then_some(value)
    }

    /// The poses at `w`, with derivatives.
    pub(super) fn poses(&self, w: Complex64, scratch: &mut Scratch) -> Option<Poses> {
        let (joint, setting) = self.setting(w, scratch)?;
        let tangent = self.circle.at(w).1;
        let u = self.three.arms().map(|arm| complex(&arm.base) - joint);
        let place =
            |angles: &Angles| self.place(self.three.rotation(&setting, *angles), &u, &joint, &tangent);
        let placed = scratch.angles.iter().map(place).collect::<Option<Vec<Placed>>>()?;
        let mut slope: Complex64 = placed.iter().map(|p| p.slope / p.gap).sum();
        for &(i, j) in self.pairs() {
            let n = u[i].cross(&u[j]);
            let change = -(tangent.cross(&u[j]) + u[i].cross(&tangent));
            slope += n.dot(&change) * 4.0 / n.dot(&n);
        }
        if self.three.common() {
            slope += placed.iter().map(|p| p.lever * 0.5).sum::<Complex64>();
        }
        Some(Poses { joint, placed, slope })
    }

    /// Gap and derivatives of one pose: the platform turns by `omega` such that the three legs keep their lengths while the joint moves.
    fn place(
        &self,
        rotation: Matrix3<Complex64>,
        u: &[Vector3<Complex64>; 3],
        joint: &Vector3<Complex64>,
        tangent: &Vector3<Complex64>,
    ) -> Option<Placed> {
        let arms = self.three.arms().map(|arm| rotation * complex(&arm.b));
        let rows = [0, 1, 2].map(|j| arms[j].cross(&u[j]));
        let rates = [0, 1, 2].map(|j| tangent.dot(&(arms[j] - u[j])));
        let omega = cramer(&rows, rates)?;
        let arm = rotation * complex(&self.last.b);
        let d = arm + joint - complex(&self.last.base);
        let gap = d.dot(&d) - self.last.s;
        let slope = d.dot(&(omega.cross(&arm) + tangent)) * 2.0;
        let n = u[0].cross(&arms[2]);
        let change = u[0].cross(&omega.cross(&arms[2])) - tangent.cross(&arms[2]);
        Some(Placed { rotation, gap, slope, lever: n.dot(&change) * 2.0 / n.dot(&n) })
    }
}

/// Solves three equations `row . x = value`.
fn cramer(rows: &[Vector3<Complex64>; 3], values: [Complex64; 3]) -> Option<Vector3<Complex64>> {
    let minors = [rows[1].cross(&rows[2]), rows[2].cross(&rows[0]), rows[0].cross(&rows[1])];
    let inverse = rows[0].dot(&minors[0]).inv();
    let x = (minors[0] * values[0] + minors[1] * values[1] + minors[2] * values[2]) * inverse;
    x.iter().all(|z| z.is_finite()).then_some(x)
}
