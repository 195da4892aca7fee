//! Platforms of Griffis-Duffy type: one joint on each side of two triangles, and their singular cases.
//!
//! Base triangle `B1 B2 B3`, platform triangle `C1 C2 C3`. Going round, the legs join
//!
//! ```text
//! B1B2 - C1,   B2 - C1C2,   B2B3 - C2,   B3 - C2C3,   B3B1 - C3,   B1 - C3C1,
//! ```
//!
//! where a side stands for the point of its line at the fraction `t_k` from the first vertex. They are the inner points
//! of the hexagon of the octahedral platform: `v_k = (1 - t_k) w_k + t_k w_(k+1)` with the six octahedral leg vectors
//! `w`. These are independent for any two triangles, so the platform is architecturally singular exactly on the surface
//!
//! ```text
//! det A = prod (1 - t_k) - prod t_k = 0.
//! ```
//!
//! [`assembly`] determines the leg lengths with which a singular platform of this type can be assembled. On the surface
//! `det A = 0` the octahedral squared lengths `o` satisfy `A o = s + k` with `k_i = t_i (1 - t_i) d_i^2`. If the
//! squared lengths `s` satisfy the single affine condition, they determine `o` up to one parameter: `o = o_0 + x n`
//! with `A n = 0`. Each `x` whose octahedral platform has a real pose gives one pose; they form curves. A real pose
//! needs six closed triangles, each of two consecutive legs and the side between their ends. The condition is
//! `16 area^2 = 4 o_k d_k^2 - (o_k + d_k^2 - o_(k+1))^2 >= 0`. It is concave in `x` and thus gives an interval.

use nalgebra::{Matrix3, Point3, Rotation3, Vector3};

use crate::{hexagon_orders, offset_determinant, offset_products};
use num::algebraic::Algebraic;
use num::linalg::{LinalgError, svd};
use platform::geom::Pose;
use platform::manipulator::{ExactLegs, Manipulator, SquaredLegLengths, flat_dimension, is_collinear};

/// A platform of Griffis-Duffy type.
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
    /// Whether the joints as written lie exactly on the sides and satisfy `det A = 0` exactly.
    exactly_singular: bool,
}

/// Joints within this times the size of the design of a side count as lying on it.
const ON_SIDE: f64 = 1e-9;

impl GriffisDuffy {
    /// Recognises the type in any order of the legs, with fixed roles of base and platform.
    ///
    /// Joints may be off their sides by `1e-9` of the size; [`deviation`](Self::deviation) is their greatest distance.
    /// If several ways exist, the one with the least deviation is taken.
    #[must_use]
    pub fn recognise(m: &Manipulator) -> Option<Self> {
        let limit = Self::limit(m);
        let mut best: Option<Self> = None;
        for order in hexagon_orders() {
            let Some(found) = Self::along(m, order) else { continue };
            if found.deviation <= limit && best.as_ref().is_none_or(|b| found.deviation < b.deviation) {
                best = Some(found);
            }
        }
        let mut found = best?;
        found.exactly_singular = ExactLegs::of(m).is_some_and(|legs| exactly_singular(&legs, found.order));
        Some(found)
    }

    /// Greatest allowed distance of a joint of `m` from its side, design units.
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

    /// `det A`; the platform is singular if it is zero.
    #[must_use]
    pub fn determinant(&self) -> f64 {
        offset_determinant(&self.t)
    }

    /// Whether the joints as written are exactly on their sides and on the surface `det A = 0`.
    #[must_use]
    pub fn is_exactly_singular(&self) -> bool {
        self.exactly_singular
    }

    /// Whether `det A` is zero within `1e-7` of the two products.
    #[must_use]
    pub fn is_nearly_singular(&self) -> bool {
        let (rest, own) = offset_products(&1.0, self.t);
        (rest - own).abs() <= 1e-7 * (rest.abs() + own.abs())
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

    /// The constant of the assembly condition `sum c_i s_i = constant`, with `c` from
    /// [`coefficients`](Self::coefficients): `- sum c t (1 - t) d^2`, `d` the length of the side.
    ///
    /// It follows from `s_k = (1 - t_k) o_k + t_k o_(k+1) - t_k (1 - t_k) d_k^2` with the octahedral squared lengths
    /// `o`, which `c` cancels.
    #[must_use]
    pub fn constant(&self) -> f64 {
        let c = self.coefficients();
        let term = |k: usize| c[self.order[k]] * self.t[k] * (1.0 - self.t[k]) * self.sides[k].powi(2);
        -(0..6).map(term).sum::<f64>()
    }

    /// Violation of the assembly condition by squared lengths, relative to the moduli of its terms.
    #[must_use]
    pub fn assembly_defect(&self, s: &SquaredLegLengths) -> f64 {
        let (c, constant) = (self.coefficients(), self.constant());
        let terms = c.iter().zip(s.get()).map(|(c, s)| c * s);
        let (sum, moduli) = terms.fold((0.0, constant.abs()), |(x, y), t| (x + t, y + f64::abs(t)));
        (sum - constant) / moduli
    }
}

fn exactly_singular(legs: &ExactLegs, order: [usize; 6]) -> bool {
    let (a, b) = (order.map(|i| &legs.base[i]), order.map(|i| &legs.platform[i]));
    let (base, platform) = ([a[5], a[1], a[3]], [b[0], b[2], b[4]]);
    let mut offsets = Vec::new();
    for k in 0..6 {
        let (triangle, x) = if k % 2 == 0 { (&base, a[k]) } else { (&platform, b[k]) };
        let [from, to] = [triangle[k / 2], triangle[(k / 2 + 1) % 3]];
        if flat_dimension([from, to, x]) > 1 {
            return false;
        }
        // a coordinate in which the two vertices differ
        let Some(axis) = (1..4).find(|i| from[*i] != to[*i]) else { return false };
        offsets.push(&(&x[axis] - &from[axis]) / &(&to[axis] - &from[axis]));
    }
    let (rest, own) = offset_products(&Algebraic::integer(1), offsets);
    rest == own
}

/// Whether a singular platform can be assembled.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema), serde(tag = "verdict", rename_all = "snake_case"), schemars(rename = "AssemblyRecord", transform = num::nullable))]
pub enum Assembly {
    /// The lengths violate the condition, proved in exact arithmetic.
    // by more than rounding: there is no pose, real or complex
    Incompatible {
        /// The relative violation.
        defect: f64,
    },
    /// The triangles of the legs do not close, by far more than rounding.
    // the condition holds within rounding, and there is no real pose
    NoRealPose {},
    /// No real pose found.
    Undecided {
        /// Squared lengths of the octahedral platforms.
        #[cfg_attr(feature = "serde", serde(rename = "octahedral_squared_lengths"))]
        corners: CornerLengths,
    },
    /// A real pose was found, and almost every pose has a self-motion.
    Real {
        /// The pose.
        pose: Pose,
        /// Its residual.
        // the largest error of its squared lengths over the squared size
        residual: f64,
        /// Squared lengths of the octahedral platforms.
        #[cfg_attr(feature = "serde", serde(rename = "octahedral_squared_lengths"))]
        corners: CornerLengths,
    },
}

/// Squared lengths origin + x direction with x in the interval.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema), schemars(rename = "CornerLengthsRecord", transform = num::nullable))]
pub struct CornerLengths {
    // of the octahedral platforms, in the order of the hexagon
    /// The origin at x = 0.
    // the shortest solution, design units squared
    pub origin: [f64; 6],
    /// The direction of x.
    // a unit vector with `A direction = 0`
    pub direction: [f64; 6],
    /// The interval of x.
    // there all six triangles close
    pub interval: [f64; 2],
}

/// By this share of their terms times the condition number of the equations, triangles that do not close must fail to
/// close: 5,000 units of rounding.
const OPEN: f64 = 1e-12;
/// Number of values of the parameter `x` in the search.
const PARAMETERS: usize = 48;
/// Number of platform angles at each of them.
const ANGLES: usize = 120;
/// Steps of bisection between two of them, down to rounding.
const BISECTIONS: usize = 60;

/// Searches for a real pose of a platform on the surface `det A = 0`, with lengths that satisfy the condition. The
/// caller has proved both in exact arithmetic.
///
/// # Errors
/// When a singular value decomposition does not converge.
pub fn assembly(g: &GriffisDuffy, m: &Manipulator, s: &SquaredLegLengths) -> Result<Assembly, LinalgError> {
    let Some(corners) = corner_lengths(g, s, 0.0)? else {
        let within_rounding = corner_lengths(g, s, OPEN)?;
        return Ok(within_rounding.map_or(Assembly::NoRealPose {}, |corners| Assembly::Undecided { corners }));
    };
    let frame = TriangleFrame::of(g, m);
    let [low, high] = corners.interval;
    for k in 0..PARAMETERS {
        // the middle first: the ends are flat poses
        let part = (k as f64 + 0.5) / PARAMETERS as f64;
        let x = low + (high - low) * (0.5 + if k % 2 == 0 { 0.5 * part } else { -0.5 * part });
        let o = std::array::from_fn(|i| corners.origin[i] + x * corners.direction[i]);
        if let Some(pose) = frame.search(&o) {
            let size = m.size() * m.size();
            let error =
                |(leg, s): (&platform::manipulator::Leg, f64)| (pose.squared_length(leg) - s).abs() / size;
            let residual = m.legs().iter().zip(s.get()).map(error).fold(0.0, f64::max);
            return Ok(Assembly::Real { pose, residual, corners });
        }
    }
    Ok(Assembly::Undecided { corners })
}

/// The family of octahedral lengths; `None` if the triangles do not close for any parameter, by `open` times the
/// condition number.
fn corner_lengths(
    g: &GriffisDuffy,
    s: &SquaredLegLengths,
    open: f64,
) -> Result<Option<CornerLengths>, LinalgError> {
    let mut rows = vec![vec![0.0; 6]; 6];
    let mut right = [0.0; 6];
    for k in 0..6 {
        rows[k][k] = 1.0 - g.t[k];
        rows[k][(k + 1) % 6] = g.t[k];
        right[k] = s.get()[g.order[k]] + g.t[k] * (1.0 - g.t[k]) * g.sides[k].powi(2);
    }
    let d = svd(&rows)?;
    let direction: [f64; 6] = std::array::from_fn(|i| d.v[i][5]);
    let along: Vec<f64> =
        (0..5).map(|k| (0..6).map(|i| d.u[i][k] * right[i]).sum::<f64>() / d.s[k]).collect();
    let origin: [f64; 6] = std::array::from_fn(|i| (0..5).map(|k| d.v[i][k] * along[k]).sum());
    let mut interval = [f64::NEG_INFINITY, f64::INFINITY];
    let open = open * d.s[0] / d.s[4];
    for k in 0..6 {
        let (next, square) = ((k + 1) % 6, g.sides[k].powi(2));
        let (p, q) = (origin[k] + square - origin[next], direction[k] - direction[next]);
        // 4 (o + x n) d^2 - (p + x q)^2 = c + b x - a x^2
        let (a, b, c) = (q * q, 4.0 * direction[k] * square - 2.0 * p * q, 4.0 * origin[k] * square - p * p);
        let moduli = origin[k].abs() + square + origin[next].abs();
        let c = c + open * moduli * moduli;
        let Some([low, high]) = where_positive(a, b, c) else { return Ok(None) };
        interval = [interval[0].max(low), interval[1].min(high)];
    }
    Ok((interval[0] <= interval[1]).then_some(CornerLengths { origin, direction, interval }))
}

/// The interval with `c + b x - a x^2 >= 0`, `a >= 0`.
fn where_positive(a: f64, b: f64, c: f64) -> Option<[f64; 2]> {
    let root = (b * b + 4.0 * a * c).sqrt();
    if root.is_nan() {
        return None;
    }
    // the two roots without cancellation; for a = 0 one is at infinity
    let q = 0.5 * (b + if b < 0.0 { -root } else { root });
    if q.abs() <= 0.0 {
        // b = 0, and a = 0 or c = 0
        let everywhere = [f64::NEG_INFINITY, f64::INFINITY];
        return (c >= 0.0).then_some(if a > 0.0 { [0.0, 0.0] } else { everywhere });
    }
    let (x, y) = (q / a, -c / q);
    Some([x.min(y), x.max(y)])
}

/// The base triangle, a normal, and the sides of the platform triangle.
struct TriangleFrame {
    base: [Vector3<f64>; 3],
    normal: Vector3<f64>,
    platform: [Point3<f64>; 3],
    /// Squared `C1 C2`, `C2 C3`, `C3 C1`.
    sides: [f64; 3],
}

/// A circle about a side of the base.
struct SideCircle {
    centre: Vector3<f64>,
    across: Vector3<f64>,
    normal: Vector3<f64>,
}

impl SideCircle {
    fn at(&self, angle: f64) -> Vector3<f64> {
        self.centre + self.across * angle.cos() + self.normal * angle.sin()
    }

    /// The two angles at which the point has the given squared distance from `p`.
    fn at_distance(&self, p: &Vector3<f64>, square: f64) -> Option<[f64; 2]> {
        let w = self.centre - p;
        let (x, y) = (2.0 * w.dot(&self.across), 2.0 * w.dot(&self.normal));
        let z = square - w.norm_squared() - self.across.norm_squared();
        let turn = (z / x.hypot(y)).acos();
        (!turn.is_nan()).then(|| [y.atan2(x) + turn, y.atan2(x) - turn])
    }
}

impl TriangleFrame {
    fn of(g: &GriffisDuffy, m: &Manipulator) -> Self {
        let legs = m.legs();
        let base = [5, 1, 3].map(|k| legs[g.order[k]].base.coords);
        let platform = [0, 2, 4].map(|k| legs[g.order[k]].platform);
        let normal = (base[1] - base[0]).cross(&(base[2] - base[0])).normalize();
        Self { base, normal, platform, sides: [1, 3, 5].map(|k| g.sides[k].powi(2)) }
    }

    /// The possible places of corner `k` of the platform.
    fn circle(&self, k: usize, o: &[f64; 6]) -> Option<SideCircle> {
        let (from, to) = (self.base[k], self.base[(k + 1) % 3]);
        let side = to - from;
        let part = (o[2 * k] - o[2 * k + 1] + side.norm_squared()) / (2.0 * side.norm_squared());
        let square = o[2 * k] - part * part * side.norm_squared();
        let radius = square.sqrt();
        let across = side.cross(&self.normal).normalize() * radius;
        (!radius.is_nan()).then(|| SideCircle {
            centre: from + side * part,
            across,
            normal: self.normal * radius,
        })
    }

    /// The corners with the first at `angle`, and the others on the branches in the bits of `branch`.
    fn corners(&self, circles: &[SideCircle; 3], angle: f64, branch: usize) -> Option<[Vector3<f64>; 3]> {
        let first = circles[0].at(angle);
        let second = circles[1].at_distance(&first, self.sides[0])?[branch % 2];
        let third = circles[2].at_distance(&first, self.sides[2])?[branch / 2];
        Some([first, circles[1].at(second), circles[2].at(third)])
    }

    /// A real pose of the octahedral platform with squared lengths `o`, from changes of sign of the last side.
    ///
    /// The first corner runs over half a circle; the other half has the mirror images.
    fn search(&self, o: &[f64; 6]) -> Option<Pose> {
        let circles = [self.circle(0, o)?, self.circle(1, o)?, self.circle(2, o)?];
        for branch in 0..4 {
            let gap = |angle: f64| {
                let c = self.corners(&circles, angle, branch)?;
                Some((c[1] - c[2]).norm_squared() - self.sides[1])
            };
            let at = |i: usize| std::f64::consts::PI * i as f64 / ANGLES as f64;
            for i in 0..ANGLES {
                let (Some(left), Some(right)) = (gap(at(i)), gap(at(i + 1))) else { continue };
                if left.signum() * right.signum() > 0.0 {
                    continue;
                }
                let (mut low, mut high) = (at(i), at(i + 1));
                for _ in 0..BISECTIONS {
                    let middle = f64::midpoint(low, high);
                    let same = gap(middle).is_none_or(|v| v.signum() * left.signum() > 0.0);
                    if same { low = middle } else { high = middle }
                }
                let tolerance = 1e-9 * self.sides[1];
                if gap(low).is_some_and(|v| v.abs() < tolerance) {
                    return self.pose(&self.corners(&circles, low, branch)?);
                }
            }
        }
        None
    }

    /// The pose that maps the platform triangle to `corners`.
    fn pose(&self, corners: &[Vector3<f64>; 3]) -> Option<Pose> {
        let axes = |p: [Vector3<f64>; 3]| {
            let x = (p[1] - p[0]).normalize();
            let z = (p[1] - p[0]).cross(&(p[2] - p[0])).normalize();
            Matrix3::from_columns(&[x, z.cross(&x), z])
        };
        let own = self.platform.map(|p| p.coords);
        let rotation = Rotation3::from_matrix_unchecked(axes(*corners) * axes(own).transpose());
        let position = corners[0] - rotation * own[0];
        rotation
            .matrix()
            .iter()
            .chain(position.iter())
            .all(|x| x.is_finite())
            .then_some(Pose { rotation, position })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num::Rng;
    use platform::geom::{Pose, random_rotation};
    use platform::manipulator::Leg;

    fn point(rng: &mut Rng) -> Point3<f64> {
        Point3::new(rng.normal(), rng.normal(), rng.normal())
    }

    /// The offset `t_k` with `det A = 0`, which is an affine function of it; `None`: no finite one, or every one.
    fn singular_offset(t: &[f64; 6], k: usize) -> Option<f64> {
        let [at_0, at_1] = [0.0, 1.0].map(|x| {
            let mut t = *t;
            t[k] = x;
            offset_determinant(&t)
        });
        Some(at_0 / (at_0 - at_1)).filter(|x| x.is_finite())
    }

    /// Six legs on the sides of two triangles.
    fn on_sides(base: &[Point3<f64>; 3], top: &[Point3<f64>; 3], t: &[f64; 6]) -> Manipulator {
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
            assert!((found.determinant().abs() - offset_determinant(&t).abs()).abs() < 1e-9);
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
            t[4] = singular_offset(&t, 4).unwrap();
            assert!(offset_determinant(&t).abs() < 1e-14);
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
        assert!((singular_offset(&t, 5).unwrap() - 0.7).abs() < 1e-14);
        assert_eq!(singular_offset(&[0.0, 1.0, 0.5, 0.5, 0.5, 0.5], 3), None);
    }

    fn singular_platform(rng: &mut Rng) -> Manipulator {
        let mut point =
            || Point3::new(rng.uniform(-3.0, 3.0), rng.uniform(-3.0, 3.0), rng.uniform(-0.5, 0.5));
        let (base, top) = ([point(), point(), point()], [point(), point(), point()]);
        let mut t = [(); 6].map(|()| rng.uniform(0.2, 0.8));
        t[2] = singular_offset(&t, 2).unwrap();
        on_sides(&base, &top, &t)
    }

    #[test]
    fn lengths_of_poses_are_assembled_again_spoilt_and_short_ones_are_not() {
        let mut rng = Rng::new(21);
        let (mut real, mut flat) = (0, 0);
        for _ in 0..20 {
            let m = singular_platform(&mut rng);
            let g = GriffisDuffy::recognise(&m).unwrap();
            let position = Vector3::from_fn(|_, _| rng.uniform(-4.0, 4.0));
            let pose = Pose { rotation: random_rotation(&mut rng), position };
            let s = pose.squared_lengths(&m).unwrap();
            match assembly(&g, &m, &s).unwrap() {
                Assembly::Real { residual, corners, .. } => {
                    assert!(residual < 1e-9, "{residual}");
                    assert!(corners.interval[0] < corners.interval[1]);
                    real += 1;
                }
                other => assert!(matches!(other, Assembly::Undecided { .. }), "{other:?}"),
            }
            let spoilt = SquaredLegLengths::try_new(std::array::from_fn(|i| {
                s.get()[i] + if i == 3 { 1e-6 } else { 0.0 }
            }));
            assert!(g.assembly_defect(&spoilt.unwrap()).abs() > 1e-12);
            // one leg of the length that satisfies the condition, five of length zero
            let c = g.coefficients();
            let leg = (0..6).find(|i| g.constant() / c[*i] > 0.0).unwrap();
            let short = std::array::from_fn(|i| if i == leg { g.constant() / c[i] } else { 0.0 });
            let short = assembly(&g, &m, &SquaredLegLengths::try_new(short).unwrap()).unwrap();
            assert!(matches!(short, Assembly::NoRealPose {} | Assembly::Undecided { .. }), "{short:?}");
            flat += usize::from(short == Assembly::NoRealPose {});
        }
        assert!(real >= 18, "{real} of 20 found by the search");
        assert!(flat > 0);
    }

    /// Flat triangles close within rounding only; this pose with them is exact.
    #[test]
    fn lengths_of_a_flat_pose_are_not_said_to_have_no_pose() {
        let base = [[0.0, 0.0], [4.0, 5.0], [8.0, 0.0]].map(|[x, y]| Point3::new(x, y, 0.0));
        let top = [[0.0, 0.0], [4.0, 0.0], [2.0, -2.5]].map(|[x, y]| Point3::new(x, y, 0.0));
        let m = on_sides(&base, &top, &[0.5; 6]);
        let pose = Pose { rotation: Rotation3::identity(), position: Vector3::new(2.0, 2.5, 0.0) };
        let s = pose.squared_lengths(&m).unwrap();
        assert_eq!(s.get().map(|s| format!("{}", 16.0 * s)), ["0", "100", "0", "169", "0", "169"]);
        let found = assembly(&GriffisDuffy::recognise(&m).unwrap(), &m, &s).unwrap();
        assert_ne!(found, Assembly::NoRealPose {});
    }

    #[test]
    fn intervals_of_a_quadratic() {
        assert_eq!(where_positive(1.0, 0.0, 4.0), Some([-2.0, 2.0]));
        assert_eq!(where_positive(1.0, 0.0, -1.0), None);
        assert_eq!(where_positive(0.0, 2.0, 6.0), Some([-3.0, f64::INFINITY]));
        assert_eq!(where_positive(0.0, -2.0, 6.0), Some([f64::NEG_INFINITY, 3.0]));
        assert_eq!(where_positive(0.0, 0.0, 1.0), Some([f64::NEG_INFINITY, f64::INFINITY]));
        assert_eq!(where_positive(0.0, 0.0, -1.0), None);
    }
}
