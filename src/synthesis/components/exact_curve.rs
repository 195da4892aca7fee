//! The curve of a plane over which `M` loses rank, in rational numbers.

use nalgebra::Vector3;
use num_bigint::BigInt;

use super::exact_form::{
    CubicPoint, ExactForm, ExactKind, Place, RationalPart, bits, cubic_point, rationals, split,
};
use super::form::{SingularKind, cross, exponents, power};
use num::exact::{ExactVector, kernel, primitive_integers, rank, rank_modulo, relations};
use platform::manipulator::{AlgebraicVector, Body, ExactLegs};

/// Bits of coefficients up to which greatest common divisors of minors are computed.
const LONG: u64 = 300;

/// A part of an exact curve.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    schemars(rename = "ExactPartRecord")
)]
pub struct ExactPart {
    // it does not split over the rational numbers
    /// Kind.
    #[cfg_attr(feature = "serde", schemars(extend("enum" = [
        "line", "two_conjugate_real_lines", "two_conjugate_complex_lines", "three_conjugate_real_lines",
        "three_conjugate_lines_one_real", "conic", "conic_without_real_points", "cubic", "undecided"
    ])))]
    pub kind: ExactKind,
    /// Its degree.
    pub degree: usize,
    /// Coprime integers as text.
    // in the order of [`ExactCurve::coefficients`]
    pub coefficients: Vec<String>,
    /// Its multiplicity.
    pub multiplicity: usize,
}

/// A rational point.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    schemars(rename = "ExactPointRecord")
)]
pub struct ExactPoint {
    // the singular point of a cubic that is irreducible over the complex numbers
    /// Homogeneous coordinates (w, x, y), integers as text.
    pub coordinates: [String; 3],
    /// Type of the point.
    #[cfg_attr(feature = "serde", schemars(extend("enum" = ["crossing", "isolated", "cusp", "triple"])))]
    pub kind: SingularKind,
}

/// The curve of one plane, with the doubles of the joints as rational numbers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExactCurve {
    /// The two coordinates of the body (0: x, 1: y, 2: z) that serve as the coordinates `x, y` of the plane.
    pub axes: [usize; 2],
    /// Rank of `M` at a generic point of the plane.
    pub generic_rank: usize,
    /// Degree; 0 without a curve.
    pub degree: usize,
    /// Coprime integers in decimal notation: coefficients of `1, x, y, x^2, x y, y^2, ..`, design units.
    pub coefficients: Vec<String>,
    /// The parts.
    pub parts: Vec<ExactPart>,
    /// The singular point of a cubic that is irreducible over the complex numbers, if it has one.
    pub singular_point: Option<ExactPoint>,
    /// Whether a cubic has no singular point over the complex numbers; `None` for other degrees, and if the numbers are
    /// too long to decide.
    pub smooth: Option<bool>,
    forms: Vec<RationalPart>,
}

/// Reasons why there is no exact curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum NoExactCurve {
    /// The exact joints do not have these flats: the pair exists only within the tolerance.
    OtherFlats,
    /// Coordinates are not fractions.
    Irrational,
    /// The minors have coefficients too long for their greatest common divisor.
    TooLong {
        /// Bits of the longest coefficient.
        bits: u64,
    },
}

impl std::fmt::Display for NoExactCurve {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::OtherFlats => write!(f, "as written the joints do not have these flats"),
            Self::Irrational => {
                write!(f, "coordinates of the joints have square roots, and exact factors need fractions")
            }
            Self::TooLong { bits } => {
                write!(
                    f,
                    "minors with coefficients of {bits} bits: their common divisor is not computed beyond {LONG}"
                )
            }
        }
    }
}

/// Three (four) homogeneous coordinates that distinguish the points of their flat.
fn coordinates(points: &[ExactVector], dimension: usize) -> Option<(Vec<usize>, Vec<ExactVector>)> {
    let choices: [&[usize]; 4] = [&[0, 1, 2], &[0, 1, 3], &[0, 2, 3], &[0, 1, 2, 3]];
    choices.into_iter().filter(|c| c.len() == dimension + 1).find_map(|kept| {
        let projected: Vec<ExactVector> =
            points.iter().map(|p| kept.iter().map(|k| p[*k].clone()).collect()).collect();
        (rank(&projected) == dimension + 1).then(|| (kept.to_vec(), projected))
    })
}

/// The bilinear equations of the legs between a plane (`near`) and a plane or space, as `M` with linear forms as
/// entries.
fn matrix(near: &[ExactVector], far: &[ExactVector]) -> Vec<Vec<ExactForm>> {
    let width = far[0].len();
    let rows: Vec<ExactVector> = near
        .iter()
        .zip(far)
        .map(|(x, y)| x.iter().flat_map(|x| y.iter().map(move |y| x * y)).collect())
        .collect();
    let entry = |n: &[BigInt], q: usize| ExactForm {
        degree: 1,
        coefficients: (0..3).map(|p| n[p * width + q].clone()).collect(),
    };
    let equations = kernel(&rows);
    let equations = equations.iter().map(|n| primitive_integers(n));
    equations.map(|n| (0..width).map(|q| entry(&n, q)).collect()).collect()
}

/// The generic rank of the matrix. The tested points are such that a minor of order 4 that vanishes at all of them
/// vanishes everywhere.
fn generic_rank(m: &[Vec<ExactForm>]) -> usize {
    let most = m.len().min(m.first().map_or(0, Vec::len));
    let mut best = 0;
    for (x, y) in (0..5i32).flat_map(|x| (0..5 - x).map(move |y| (x, y))) {
        let p: Place = [4 - x - y, x, y].map(BigInt::from);
        let rows: Vec<Vec<BigInt>> = m.iter().map(|r| r.iter().map(|f| f.value(&p)).collect()).collect();
        let lower = rank_modulo(&rows);
        let exactly = || rank(&rows.iter().map(|r| rationals(r)).collect::<Vec<_>>());
        best = best.max(if lower < most { exactly() } else { lower });
        if best == most {
            break;
        }
    }
    best
}

fn subsets(count: usize, size: usize) -> impl Iterator<Item = Vec<usize>> {
    (0..1usize << count)
        .filter(move |mask| mask.count_ones() as usize == size)
        .map(move |mask| (0..count).filter(|i| mask >> i & 1 == 1).collect())
}

/// The greatest common divisor of the minors of order `order`.
fn common_minor(m: &[Vec<ExactForm>], order: usize) -> Result<ExactForm, NoExactCurve> {
    let width = m.first().map_or(0, Vec::len);
    let mut divisor: Option<ExactForm> = None;
    for rows in subsets(m.len(), order) {
        for columns in subsets(width, order) {
            let part: Vec<Vec<ExactForm>> =
                rows.iter().map(|r| columns.iter().map(|c| m[*r][*c].clone()).collect()).collect();
            let minor = ExactForm::determinant(&part).primitive();
            if minor.is_zero() {
                continue;
            }
            let long = bits(&minor.coefficients);
            divisor = Some(match divisor {
                None => minor,
                Some(d) if minor.divided(&d).is_some() => d,
                Some(d) => {
                    let next = d.common_factor(&minor, LONG).ok_or(NoExactCurve::TooLong { bits: long })?;
                    if next.degree == 0 {
                        return Ok(next);
                    }
                    next
                }
            });
        }
    }
    Ok(divisor.unwrap_or_else(ExactForm::one))
}

impl ExactCurve {
    /// The curve over the plane of the ends of legs on a body.
    pub(super) fn of(exact: &ExactLegs, legs: &[usize], body: Body) -> Result<Self, NoExactCurve> {
        let fractions = |p: &AlgebraicVector| p.iter().map(|x| x.as_rational().cloned()).collect();
        let ends = |body: Body| -> Option<Vec<ExactVector>> {
            legs.iter().map(|i| fractions(&exact.ends(body)[*i])).collect()
        };
        let (near, far) = ends(body).zip(ends(body.other())).ok_or(NoExactCurve::Irrational)?;
        let width = exact.dimension(body.other(), legs);
        let chosen = coordinates(&near, 2).zip(coordinates(&far, width));
        let Some(((kept, near), (_, far))) = chosen else { return Err(NoExactCurve::OtherFlats) };
        let m = matrix(&near, &far);
        let generic_rank = generic_rank(&m);
        let form = common_minor(&m, generic_rank)?;
        let joints: Vec<Vec<BigInt>> = near.iter().map(|p| primitive_integers(p)).collect();
        let mut lines: Vec<ExactForm> = Vec::new();
        for (k, p) in joints.iter().enumerate() {
            for q in joints[..k].iter().filter(|q| *q != p) {
                lines.push(ExactForm { degree: 1, coefficients: cross(p, q).to_vec() }.primitive());
            }
        }
        let parts = split(&form, &lines);
        let cubic = parts.iter().find(|p| p.kind == ExactKind::Cubic).map(|p| cubic_point(&p.form));
        let smooth = match &cubic {
            _ if form.degree != 3 => None,
            Some(CubicPoint::None) => Some(true),
            Some(CubicPoint::TooLong) => None,
            _ => Some(false),
        };
        let singular_point = match cubic {
            Some(CubicPoint::At { coordinates, cusp, isolated }) => Some(ExactPoint {
                coordinates: coordinates.each_ref().map(BigInt::to_string),
                kind: match (cusp, isolated) {
                    (true, _) => SingularKind::Cusp,
                    (_, true) => SingularKind::Isolated,
                    _ => SingularKind::Crossing,
                },
            }),
            _ => None,
        };
        let text = |f: &ExactForm| f.coefficients.iter().map(BigInt::to_string).collect::<Vec<String>>();
        let part = |p: &RationalPart| ExactPart {
            kind: p.kind,
            degree: p.form.degree,
            coefficients: text(&p.form),
            multiplicity: p.multiplicity,
        };
        Ok(Self {
            axes: [kept[1] - 1, kept[2] - 1],
            generic_rank,
            degree: form.degree,
            coefficients: text(&form),
            parts: parts.iter().map(part).collect(),
            singular_point,
            smooth,
            forms: parts,
        })
    }

    /// Whether it has a part of this kind.
    pub(super) fn has(&self, kind: ExactKind) -> bool {
        self.forms.iter().any(|p| p.kind == kind)
    }

    /// Whether a part of one of these kinds passes through points near the body (design coordinates). `None` if the
    /// exact parts are not all known.
    pub(super) fn has_part(
        &self,
        kinds: impl Fn(ExactKind) -> bool,
        points: &[Vector3<f64>],
    ) -> Option<bool> {
        let passes = |p: &RationalPart| {
            let c = p.form.approximate();
            points.iter().all(|x| {
                let at = [1.0, x[self.axes[0]], x[self.axes[1]]];
                let terms = exponents(p.form.degree)
                    .zip(&c)
                    .map(|(e, c)| c * (0..3).map(|k| power(at[k], e[k])).product::<f64>());
                let (sum, moduli) = terms.fold((0.0, 0.0), |(s, m): (f64, f64), t| (s + t, m + t.abs()));
                sum.abs() <= 1e-6 * moduli
            })
        };
        if self.forms.iter().any(|p| kinds(p.kind) && passes(p)) {
            return Some(true);
        }
        (!self.forms.iter().any(|p| p.kind == ExactKind::Undecided)).then_some(false)
    }
}

/// The exact intersection of the lines through two pairs of points of a plane, homogeneous; `None` if they do not
/// intersect in one point.
pub(super) fn meeting(lines: [[&AlgebraicVector; 2]; 2]) -> Option<AlgebraicVector> {
    let rows: Vec<AlgebraicVector> = lines.iter().flatten().map(|p| (*p).clone()).collect();
    let [relation] = <[AlgebraicVector; 1]>::try_from(relations(&rows)).ok()?;
    let point: AlgebraicVector =
        (0..4).map(|k| &(&relation[0] * &rows[0][k]) + &(&relation[1] * &rows[1][k])).collect();
    point.iter().any(|x| !x.is_zero()).then_some(point)
}

/// The double nearest to a point, for comparison; `None` at infinity.
pub(super) fn place(point: &AlgebraicVector) -> Option<Vector3<f64>> {
    (!point[0].is_zero()).then(|| Vector3::from_fn(|k, _| (&point[k + 1] / &point[0]).approximate()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;
    use num::Rng;
    use platform::manipulator::Leg;

    fn base(legs: &[Leg; 6]) -> ExactCurve {
        ExactCurve::of(&ExactLegs::of_doubles(legs).unwrap(), &[0, 1, 2, 3, 4, 5], Body::Base).unwrap()
    }

    #[test]
    fn random_planar_designs_are_smooth_and_shared_joints_split_a_line_off() {
        let mut rng = Rng::new(21);
        for _ in 0..3 {
            let mut point = || Point3::new(rng.normal(), rng.normal(), 0.0);
            let mut legs: [Leg; 6] = std::array::from_fn(|_| Leg { base: point(), platform: point() });
            assert_eq!(base(&legs).smooth, Some(true));
            legs[1].platform = legs[0].platform;
            let c = base(&legs);
            let kinds: Vec<ExactKind> = c.parts.iter().map(|p| p.kind).collect();
            assert_eq!((c.smooth, kinds), (Some(false), vec![ExactKind::Line, ExactKind::Conic]));
        }
    }

    #[test]
    fn the_coefficients_vanish_at_the_joints_exactly() {
        let mut rng = Rng::new(22);
        let mut point = || Point3::new(rng.normal(), rng.normal(), rng.normal()).map(|x| (8.0 * x).round());
        let (a, b) = ([point(), point(), point()], [point(), point(), point()]);
        let at = |p: &[Point3<f64>; 3], x: f64, y: f64| p[0] + (p[1] - p[0]) * x + (p[2] - p[0]) * y;
        let places = [(0.0, 1.0), (2.0, -1.0), (3.0, 5.0), (-4.0, 2.0), (1.0, 1.0), (-1.0, -3.0)];
        let legs: [Leg; 6] = std::array::from_fn(|k| Leg {
            base: at(&a, places[k].0, places[k].1),
            platform: at(&b, places[(k + 2) % 6].1, places[k].0 + places[k].1),
        });
        let c = base(&legs);
        assert_eq!((c.degree, c.generic_rank, c.forms.len()), (3, 3, 1));
        for l in &legs {
            let p = [1.0, l.base[c.axes[0]], l.base[c.axes[1]]].map(|x| BigInt::from(x as i64));
            assert_eq!(c.forms[0].form.value(&p), BigInt::ZERO);
        }
    }
}
