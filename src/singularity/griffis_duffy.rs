//! Platforms of Griffis-Duffy type: one joint on each side of two triangles, and when they are singular.
//!
//! Base triangle `B1 B2 B3`, platform triangle `C1 C2 C3`. Going round, the legs join
//!
//! ```text
//! B1B2 - C1,   B2 - C1C2,   B2B3 - C2,   B3 - C2C3,   B3B1 - C3,   B1 - C3C1,
//! ```
//!
//! a side standing for a point of its line at the fraction `t_k` from the first vertex. They are the inner points of the hexagon of
//! the octahedral platform: `v_k = (1 - t_k) w_k + t_k w_(k+1)` with the six octahedral leg vectors `w`. These are independent for any two
//! triangles, so that the platform is architecturally singular exactly on the surface
//!
//! ```text
//! det A = prod (1 - t_k) - prod t_k = 0.
//! ```

use nalgebra::{Point3, Vector3};

use super::dependency::{ExactLegs, dimension};
use crate::manipulator::{Manipulator, SquaredLegLengths, is_collinear};
use crate::num::exact::Rational;

/// A platform recognised as one of Griffis-Duffy type.
#[derive(Debug, Clone, PartialEq)]
pub struct GriffisDuffy {
    /// Leg (0-based) on side `k` of the hexagon.
    pub order: [usize; 6],
    /// Fraction `t_k` of the side, from the vertex of side `k` to that of side `k + 1`.
    pub t: [f64; 6],
    /// Length of the triangle side on which leg `order[k]` ends, design units.
    pub sides: [f64; 6],
    /// Largest distance of a joint from the line of its side, design units.
    pub deviation: f64,
    /// Whether the joints as written lie on the sides and satisfy `det A = 0` without any rounding.
    exactly_singular: bool,
}

/// Joints count as lying on a side within this times the size of the design.
const ON_SIDE: f64 = 1e-9;

/// `det A = prod (1 - t_k) - prod t_k`; zero exactly for the singular platforms, whatever the triangles.
#[must_use]
pub fn griffis_duffy_determinant(t: &[f64; 6]) -> f64 {
    t.iter().map(|t| 1.0 - t).product::<f64>() - t.iter().product::<f64>()
}

/// The offset `t_k` that makes a platform with the five others singular: `t_k = Q / (P + Q)`, `P = prod t_j`, `Q = prod (1 - t_j)` over
/// `j != k`.
///
/// `None` where `P + Q = 0`: either no finite `t_k` does, or (`P = Q = 0`, two coincident legs or the like) every one.
#[must_use]
pub fn griffis_duffy_singular_offset(t: &[f64; 6], k: usize) -> Option<f64> {
    let others = || t.iter().enumerate().filter(|(j, _)| *j != k).map(|(_, t)| *t);
    let (p, q) = (others().product::<f64>(), others().map(|t| 1.0 - t).product::<f64>());
    let value = q / (p + q);
    value.is_finite().then_some(value)
}

impl GriffisDuffy {
    /// Recognises the type in any order of the legs, base and platform as they stand.
    ///
    /// Joints may be off their sides by `1e-9` of the size; [`deviation`](Self::deviation) tells how far they are. Of several
    /// ways the one with the least deviation is taken.
    #[must_use]
    pub fn recognise(m: &Manipulator) -> Option<Self> {
        let limit = Self::limit(m);
        let mut best: Option<Self> = None;
        for order in orders() {
            let Some(found) = Self::along(m, order) else { continue };
            if found.deviation <= limit && best.as_ref().is_none_or(|b| found.deviation < b.deviation) {
                best = Some(found);
            }
        }
        let mut found = best?;
        found.exactly_singular = exactly_singular(&ExactLegs::of(m), found.order);
        Some(found)
    }

    /// How far a joint of `m` may be off its side, design units.
    #[must_use]
    pub fn limit(m: &Manipulator) -> f64 {
        ON_SIDE * m.size()
    }

    fn along(m: &Manipulator, order: [usize; 6]) -> Option<Self> {
        let legs = m.legs();
        let (a, b) = (order.map(|i| legs[i].base), order.map(|i| legs[i].platform));
        let (base, platform) = ([a[5], a[1], a[3]], [b[0], b[2], b[4]]);
        if is_collinear(&base) || is_collinear(&platform) {
            return None;
        }
        let (mut t, mut sides, mut deviation) = ([0.0; 6], [0.0; 6], 0.0_f64);
        for k in 0..6 {
            let (triangle, x) = if k % 2 == 0 { (&base, a[k]) } else { (&platform, b[k]) };
            let [from, to]: [Point3<f64>; 2] = [triangle[k / 2], triangle[(k / 2 + 1) % 3]];
            let side = to - from;
            sides[k] = side.norm();
            t[k] = (x - from).dot(&side) / side.norm_squared();
            let off: Vector3<f64> = x - from - side * t[k];
            deviation = deviation.max(off.norm());
        }
        Some(Self { order, t, sides, deviation, exactly_singular: false })
    }

    /// `det A`; the platform is singular where it is zero.
    #[must_use]
    pub fn determinant(&self) -> f64 {
        griffis_duffy_determinant(&self.t)
    }

    /// Whether the joints as written lie on their sides and on the surface `det A = 0` exactly.
    #[must_use]
    pub fn is_exactly_singular(&self) -> bool {
        self.exactly_singular
    }

    /// Whether `det A` is zero within `1e-7` of the two products.
    #[must_use]
    pub fn is_nearly_singular(&self) -> bool {
        let products =
            self.t.iter().map(|t| 1.0 - t).product::<f64>().abs() + self.t.iter().product::<f64>().abs();
        self.determinant().abs() <= 1e-7 * products
    }

    /// Whether every joint is at a corner of its triangle, up to rounding.
    pub(super) fn is_octahedral(&self) -> bool {
        self.t.iter().all(|t| t.abs() <= ON_SIDE || (1.0 - t).abs() <= ON_SIDE)
    }

    /// The relation `sum c_i v_i = 0` of the legs on the surface `det A = 0`, in leg order, largest modulus 1.
    ///
    /// On side `k` it is `(-1)^k prod_(j < k) t_j prod_(j > k) (1 - t_j)`, a cofactor of the matrix `A`.
    #[must_use]
    pub fn coefficients(&self) -> [f64; 6] {
        let mut c = [0.0; 6];
        for (k, leg) in self.order.into_iter().enumerate() {
            let before = self.t[..k].iter().product::<f64>();
            let after = self.t[k + 1..].iter().map(|t| 1.0 - t).product::<f64>();
            c[leg] = if k % 2 == 0 { before * after } else { -before * after };
        }
        let most = c.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        if most > 0.0 { c.map(|x| x / most) } else { c }
    }

    /// The constant of the assembly condition `sum c_i s_i = constant`, with `c` from [`coefficients`](Self::coefficients):
    /// `- sum c t (1 - t) d^2`, `d` the length of the side.
    ///
    /// Follows from `s_k = (1 - t_k) o_k + t_k o_(k+1) - t_k (1 - t_k) d_k^2` with the octahedral squared lengths `o`, which `c` cancels.
    #[must_use]
    pub fn constant(&self) -> f64 {
        let c = self.coefficients();
        let term = |k: usize| c[self.order[k]] * self.t[k] * (1.0 - self.t[k]) * self.sides[k].powi(2);
        -(0..6).map(term).sum::<f64>()
    }

    /// How far squared lengths are from the assembly condition, relative to the moduli of its terms.
    #[must_use]
    pub fn assembly_defect(&self, s: &SquaredLegLengths) -> f64 {
        let (c, constant) = (self.coefficients(), self.constant());
        let terms = c.iter().zip(s.get()).map(|(c, s)| c * s);
        let (sum, moduli) = terms.fold((0.0, constant.abs()), |(x, y), t| (x + t, y + f64::abs(t)));
        (sum - constant) / moduli
    }
}

/// Orders of the legs up to turning the hexagon by two sides and reflecting it.
fn orders() -> impl Iterator<Item = [usize; 6]> {
    (0..46656_usize).filter_map(|n| {
        let mut rest = n;
        let order: [usize; 6] = std::array::from_fn(|_| {
            let digit = rest % 6;
            rest /= 6;
            digit
        });
        let all = order.iter().fold(0u8, |set, i| set | 1 << i) == 0b11_1111;
        (all && order[0] < order[2] && order[0] < order[4] && order[1] < order[5]).then_some(order)
    })
}

fn exactly_singular(legs: &ExactLegs, order: [usize; 6]) -> bool {
    let (a, b) = (order.map(|i| &legs.base[i]), order.map(|i| &legs.platform[i]));
    let (base, platform) = ([a[5], a[1], a[3]], [b[0], b[2], b[4]]);
    let mut products = [Rational::from_integer(1.into()), Rational::from_integer(1.into())];
    for k in 0..6 {
        let (triangle, x) = if k % 2 == 0 { (&base, a[k]) } else { (&platform, b[k]) };
        let [from, to] = [triangle[k / 2], triangle[(k / 2 + 1) % 3]];
        if dimension([from, to, x]) > 1 {
            return false;
        }
        // a coordinate in which the two vertices differ
        let Some(axis) = (0..3).find(|i| from[*i] != to[*i]) else { return false };
        let t = (&x[axis] - &from[axis]) / (&to[axis] - &from[axis]);
        products[1] *= Rational::from_integer(1.into()) - &t;
        products[0] *= t;
    }
    products[0] == products[1]
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::geom::{Pose, random_rotation};
    use crate::manipulator::Leg;
    use crate::num::Rng;

    fn point(rng: &mut Rng) -> Point3<f64> {
        Point3::new(rng.normal(), rng.normal(), rng.normal())
    }

    /// Six legs on the sides of two triangles.
    pub(in crate::singularity) fn on_sides(
        base: &[Point3<f64>; 3],
        top: &[Point3<f64>; 3],
        t: &[f64; 6],
    ) -> Manipulator {
        Manipulator::from_legs(std::array::from_fn(|k| {
            let on = |p: &[Point3<f64>; 3]| p[k / 2] + (p[(k / 2 + 1) % 3] - p[k / 2]) * t[k];
            if k % 2 == 0 {
                Leg { base: on(base), platform: top[k / 2] }
            } else {
                Leg { base: base[k.div_ceil(2) % 3], platform: on(top) }
            }
        }))
        .unwrap()
    }

    /// Any two triangles in space, offsets `t`.
    fn platform(rng: &mut Rng, t: &[f64; 6]) -> Manipulator {
        let (base, top) = ([(); 3].map(|()| point(rng)), [(); 3].map(|()| point(rng)));
        on_sides(&base, &top, t)
    }

    #[test]
    fn recognised_in_any_order_with_the_determinant_of_the_leg_map() {
        let mut rng = Rng::new(8);
        for _ in 0..10 {
            let t = [(); 6].map(|()| rng.uniform(-0.5, 1.5));
            let m = platform(&mut rng, &t).reordered([2, 5, 0, 1, 4, 3]).unwrap();
            let found = GriffisDuffy::recognise(&m).unwrap();
            assert!(found.deviation < 1e-12 * m.size().max(1.0));
            assert!((found.determinant().abs() - griffis_duffy_determinant(&t).abs()).abs() < 1e-9);
        }
        let mut moved = platform(&mut rng, &[0.3; 6]).legs();
        moved[0].base.x += 1e-4;
        assert!(GriffisDuffy::recognise(&Manipulator::from_legs(moved).unwrap()).is_none());
    }

    #[test]
    fn on_the_surface_the_lengths_of_every_pose_satisfy_the_condition_and_off_it_they_do_not() {
        let mut rng = Rng::new(9);
        for trial in 0..10 {
            let mut t = [(); 6].map(|()| rng.uniform(0.1, 0.9));
            t[4] = griffis_duffy_singular_offset(&t, 4).unwrap();
            assert!(griffis_duffy_determinant(&t).abs() < 1e-14);
            if trial == 0 {
                t[4] += 0.05;
            }
            let found_in = |m: &Manipulator| GriffisDuffy::recognise(m).unwrap();
            let m = platform(&mut rng, &t).reordered([1, 0, 3, 2, 5, 4]).unwrap();
            let g = found_in(&m);
            let mut worst = 0.0_f64;
            for _ in 0..5 {
                let pose = Pose { rotation: random_rotation(&mut rng), position: point(&mut rng).coords };
                worst = worst.max(g.assembly_defect(&pose.squared_lengths(&m).unwrap()).abs());
            }
            assert_eq!(worst < 1e-12, trial > 0, "{worst}");
        }
    }

    #[test]
    fn the_offset_that_closes_the_surface_is_the_published_line_for_two_offsets() {
        // Delta1 / 12 + Delta2 / 6 = 1 (Rojas, Borras, Thomas 2010, sec. 6)
        let t = [0.3, 0.7, 0.3, 0.7, 0.3, 0.0];
        assert!((griffis_duffy_singular_offset(&t, 5).unwrap() - 0.7).abs() < 1e-14);
        assert_eq!(griffis_duffy_singular_offset(&[0.0, 1.0, 0.5, 0.5, 0.5, 0.5], 3), None);
    }
}
