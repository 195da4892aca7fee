//! Legs with complex squared lengths that close on the circle of a joint shared by two of them. The closure condition
//! of the last leg is a product over the poses without it.
//!
//! With `w` on the circle of the shared joint, all other legs but one leave 8 poses. They leave 4 when two share a base
//! joint. `s_m` is the squared length of the last leg at such a pose. The product of `s_m - s` over the poses is a
//! rational function of `w` that vanishes exactly where all legs fit. Its poles do not depend on the last leg. They are
//! the points where a triangle of the joint and two of the three legs degenerates, a factor `A_ijk` of the
//! trilaterations. Multiplied with these factors the function is a Laurent polynomial from `w^-20` to `w^20` (from -12
//! to 12).

use nalgebra::{Matrix3, Vector3};
use num_complex::Complex64;

use super::rotations::{Arm, ComplexAngles, Setting, Three, evaluate};
use num::batch::ComplexBatch;
use platform::geom::ComplexPose;
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// The points with given squared distances to two fixed points, `c + r (cos t e1 + sin t e2)` with `w = exp(i t)`.
///
/// The squared distance of such a point from a third fixed point, a virtual leg, is `x0 + x1 w + x2 / w`. Each value of
/// it belongs to two points, one for each sign of the radical of a trilateration. So `w` takes the place of the length
/// and the sign.
#[derive(Debug, Clone, Copy)]
pub(super) struct HiddenCircle {
    centre: Vector3<Complex64>,
    across: [Vector3<Complex64>; 2],
}

impl HiddenCircle {
    /// `None` when the two fixed points coincide.
    pub(super) fn new(feet: [Vector3<f64>; 2], s: [Complex64; 2]) -> Option<Self> {
        let axis = feet[1] - feet[0];
        let d = axis.norm();
        let axis = axis / d;
        if !axis.iter().all(|x| x.is_finite()) {
            return None;
        }
        let along = (s[0] - s[1] + d * d) / (2.0 * d);
        let radius = (s[0] - along * along).sqrt();
        let e1 = perpendicular(&axis);
        let e2 = axis.cross(&e1);
        let centre = complex(&feet[0]) + complex(&axis) * along;
        Some(Self { centre, across: [complex(&e1) * radius, complex(&e2) * radius] })
    }

    /// The point and its derivative by the angle.
    pub(super) fn at(&self, w: Complex64) -> (Vector3<Complex64>, Vector3<Complex64>) {
        let inverse = w.inv();
        let (cosine, sine) = ((w + inverse) * 0.5, (w - inverse) * Complex64::new(0.0, -0.5));
        let [e1, e2] = &self.across;
        (self.centre + e1 * cosine + e2 * sine, e2 * cosine - e1 * sine)
    }
}

/// A unit vector at right angles to a unit vector.
pub(super) fn perpendicular(axis: &Vector3<f64>) -> Vector3<f64> {
    let least = axis.iamin();
    let mut other = Vector3::zeros();
    other[least] = 1.0;
    axis.cross(&other).normalize()
}

pub(super) fn complex(v: &Vector3<f64>) -> Vector3<Complex64> {
    v.map(Complex64::from)
}

/// One leg, lengths in units of the design's size.
#[derive(Debug, Clone, Copy)]
pub(super) struct HiddenLeg {
    pub(super) base: Vector3<f64>,
    pub(super) platform: Vector3<f64>,
    pub(super) s: Complex64,
}

/// The legs of a design in units of its size.
pub(super) fn scaled(m: &Manipulator, s: &SquaredLegLengths) -> [HiddenLeg; 6] {
    let size = m.size();
    let (legs, s) = (m.legs(), s.get());
    std::array::from_fn(|i| HiddenLeg {
        base: legs[i].base.coords / size,
        platform: legs[i].platform.coords / size,
        s: Complex64::from(s[i] / (size * size)),
    })
}

/// A pose in units of the size as one of the design.
pub(super) fn unscaled(pose: &ComplexPose, m: &Manipulator) -> ComplexPose {
    ComplexPose { rotation: pose.rotation, position: pose.position * Complex64::from(m.size()) }
}

/// The roles of the legs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct LegRoles {
    /// The joint is one of the base: the platform is taken for fixed.
    pub(super) exchanged: bool,
    /// Two legs that share it.
    pub(super) pair: [usize; 2],
    /// Three legs for the rotation; those with a common joint on the other body first.
    pub(super) three: [usize; 3],
    /// The leg whose length closes.
    pub(super) last: usize,
}

impl LegRoles {
    /// All ways, those with four rotations first. Empty unless each body has at most one shared joint, of two legs: two
    /// virtual legs.
    pub(super) fn of(pairs: &[(usize, usize); 6]) -> Vec<Self> {
        let base = shared(pairs.map(|p| p.0));
        let platform = shared(pairs.map(|p| p.1));
        if base.len() > 1 || platform.len() > 1 || base.iter().chain(&platform).any(|legs| legs.len() > 2) {
            return Vec::new();
        }
        let mut out = Vec::new();
        for (exchanged, own, other) in [(false, &platform, &base), (true, &base, &platform)] {
            let Some([i, j]) = own.first().map(Vec::as_slice) else { continue };
            let rest: Vec<usize> = (0..6).filter(|k| k != i && k != j).collect();
            let common = other.first().filter(|c| c.iter().all(|k| rest.contains(k)));
            for last in rest.iter().copied().filter(|k| common.is_none_or(|c| !c.contains(k))) {
                let mut three: Vec<usize> = rest.iter().copied().filter(|k| *k != last).collect();
                three.sort_by_key(|k| !common.is_some_and(|c| c.contains(k)));
                out.push(Self { exchanged, pair: [*i, *j], three: [three[0], three[1], three[2]], last });
            }
        }
        out
    }

    /// `None` when joints coincide that must not.
    pub(super) fn closure(&self, legs: &[HiddenLeg; 6]) -> Option<HiddenClosure> {
        let ends = |i: usize| {
            let l = &legs[i];
            if self.exchanged { (l.platform, l.base) } else { (l.base, l.platform) }
        };
        let [i, j] = self.pair;
        let joint = ends(i).1;
        let circle = HiddenCircle::new([ends(i).0, ends(j).0], [legs[i].s, legs[j].s])?;
        let arm = |k: usize| Arm { base: ends(k).0, b: ends(k).1 - joint, s: legs[k].s };
        Some(HiddenClosure { circle, three: Three::new(self.three.map(arm))?, last: arm(self.last) })
    }

    /// The pose with the joint at `at`.
    pub(super) fn pose(
        &self,
        legs: &[HiddenLeg; 6],
        at: &Vector3<Complex64>,
        placed: &FiveLegPose,
    ) -> ComplexPose {
        let leg = &legs[self.pair[0]];
        let r = placed.rotation;
        if self.exchanged {
            // found is the pose of the base in the platform's frame: x_platform = r x_base + q
            let q = at - r * complex(&leg.base);
            ComplexPose { rotation: r.transpose(), position: -(r.tr_mul(&q)) }
        } else {
            ComplexPose { rotation: r, position: at - r * complex(&leg.platform) }
        }
    }
}

/// The legs of each joint that has several.
fn shared(joint: [usize; 6]) -> Vec<Vec<usize>> {
    let of = |j: usize| (0..6).filter(|k| joint[*k] == j).collect::<Vec<usize>>();
    let first = (0..6).filter(|k| joint[..*k].iter().all(|j| *j != joint[*k]));
    first.map(|k| of(joint[k])).filter(|legs| legs.len() > 1).collect()
}

/// Joint on a circle, three legs, and the leg left out.
#[derive(Debug, Clone)]
pub(super) struct HiddenClosure {
    pub(super) circle: HiddenCircle,
    pub(super) three: Three,
    pub(super) last: Arm,
}

/// Data kept from one evaluation to the next, so that it starts near.
#[derive(Debug, Clone, Default)]
pub(super) struct Scratch {
    warm: Option<ComplexBatch>,
    angles: Vec<ComplexAngles>,
}

/// One pose without the last leg.
#[derive(Debug, Clone, Copy)]
pub(super) struct FiveLegPose {
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
pub(super) struct PosesOfJoint {
    /// The joint.
    pub(super) joint: Vector3<Complex64>,
    pub(super) placed: Vec<FiveLegPose>,
    /// Derivative of the logarithm of the polynomial by the angle.
    pub(super) slope: Complex64,
}

impl PosesOfJoint {
    /// Distance of a pose from closing, along the circle, to first order.
    pub(super) fn step(&self, k: usize) -> f64 {
        (self.placed[k].gap / self.placed[k].slope).norm()
    }

    /// The pose nearest to closing.
    pub(super) fn best(&self) -> Option<usize> {
        (0..self.placed.len()).min_by(|i, j| self.step(*i).total_cmp(&self.step(*j)))
    }
}

impl HiddenClosure {
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
    pub(super) fn poses(&self, w: Complex64, scratch: &mut Scratch) -> Option<PosesOfJoint> {
        let (joint, setting) = self.setting(w, scratch)?;
        let tangent = self.circle.at(w).1;
        let u = self.three.arms().map(|arm| complex(&arm.base) - joint);
        let place =
            |angles: &ComplexAngles| self.place(self.three.rotation(&setting, *angles), &u, &joint, &tangent);
        let placed = scratch.angles.iter().map(place).collect::<Option<Vec<FiveLegPose>>>()?;
        let mut slope: Complex64 = placed.iter().map(|p| p.slope / p.gap).sum();
        for &(i, j) in self.pairs() {
            let n = u[i].cross(&u[j]);
            let change = -(tangent.cross(&u[j]) + u[i].cross(&tangent));
            slope += n.dot(&change) * 4.0 / n.dot(&n);
        }
        if self.three.common() {
            slope += placed.iter().map(|p| p.lever * 0.5).sum::<Complex64>();
        }
        Some(PosesOfJoint { joint, placed, slope })
    }

    /// Gap and derivatives of one pose: the platform turns by `omega` such that the three legs keep their lengths while
    /// the joint moves.
    fn place(
        &self,
        rotation: Matrix3<Complex64>,
        u: &[Vector3<Complex64>; 3],
        joint: &Vector3<Complex64>,
        tangent: &Vector3<Complex64>,
    ) -> Option<FiveLegPose> {
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
        Some(FiveLegPose { rotation, gap, slope, lever: n.dot(&change) * 2.0 / n.dot(&n) })
    }
}

/// Solves three equations `row . x = value`.
fn cramer(rows: &[Vector3<Complex64>; 3], values: [Complex64; 3]) -> Option<Vector3<Complex64>> {
    let minors = [rows[1].cross(&rows[2]), rows[2].cross(&rows[0]), rows[0].cross(&rows[1])];
    let inverse = rows[0].dot(&minors[0]).inv();
    let x = (minors[0] * values[0] + minors[1] * values[1] + minors[2] * values[2]) * inverse;
    x.iter().all(|z| z.is_finite()).then_some(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_topologies_with_two_virtual_legs_have_ways_and_no_others() {
        use platform::topology::catalogue;
        for n in catalogue() {
            let t = n.topology();
            for legs in [t.legs(), t.legs().map(|l| (l.1, l.0))] {
                let ways = LegRoles::of(&legs);
                assert_eq!(ways.is_empty(), t.trilateration().virtual_legs.len() != 2, "{}", n.id());
                let count = match n.id().as_str() {
                    "T02" | "T06" => 4,
                    "T05" => 8,
                    _ => 0,
                };
                assert_eq!(ways.len(), count, "{}", n.id());
            }
        }
    }
}
