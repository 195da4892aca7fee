//! An irreducible family as a set: distances of legs from it, and explicit formulas for its legs.

use nalgebra::{Point3, Vector3};

use super::flats::{BothReadings, Flat, FlatProduct};
use super::form::{Form, exponents, power};
use super::found::{Polynomial, value};
use super::spectrum::{Spectrum, dot, norm, orthonormal, unit, without};
use crate::leg_vector::Normalisation;
use num::linalg::LinalgError;
use platform::manipulator::{Body, Leg};

/// A curve in a flat, given by its parametrisation in homogeneous local coordinates.
#[derive(Debug, Clone)]
pub(super) enum Curve {
    /// `p + t (q - p)`, both with first coordinate 1.
    Line { p: Vec<f64>, q: Vec<f64> },
    /// `frame (1 - t^2, 2 t, 1 + t^2)`, the columns of `frame` given; `form` vanishes on it.
    Conic { frame: [Vec<f64>; 3], form: Form },
}

impl Curve {
    /// The coefficients of `1, t, t^2` in local coordinates.
    pub(super) fn polynomial(&self) -> Polynomial {
        match self {
            Self::Line { p, q } => vec![p.clone(), q.iter().zip(p).map(|(x, y)| x - y).collect()],
            Self::Conic { frame: [x, y, z], .. } => vec![
                x.iter().zip(z).map(|(x, z)| x + z).collect(),
                y.iter().map(|y| 2.0 * y).collect(),
                x.iter().zip(z).map(|(x, z)| z - x).collect(),
            ],
        }
    }

    /// Parameter `num / den` of the point of the curve near `alpha`, and the distance of `alpha` from it.
    fn locate(&self, alpha: &[f64]) -> (f64, f64, f64) {
        match self {
            Self::Line { p, q } => {
                let affine: Vec<f64> = alpha.iter().map(|x| x / alpha[0]).collect();
                let d: Vec<f64> = q.iter().zip(p).map(|(x, y)| x - y).collect();
                let r: Vec<f64> = affine.iter().zip(p).map(|(x, y)| x - y).collect();
                let t = dot(&r, &d) / dot(&d, &d);
                let off: Vec<f64> = r.iter().zip(&d).map(|(x, y)| x - t * y).collect();
                (t, 1.0, norm(&off))
            }
            Self::Conic { frame, form } => {
                // columns of the frame are orthogonal
                let y: Vec<f64> = frame.iter().map(|c| dot(c, alpha) / dot(c, c)).collect();
                let off = form.value(&unit(alpha)).abs() / form.norm();
                // (1 - t^2, 2t, 1 + t^2): t = y1 / (y0 + y2) = (y2 - y0) / y1
                let (u, v) = if (y[0] + y[2]).abs() > (y[2] - y[0]).abs() {
                    (y[1], y[0] + y[2])
                } else {
                    (y[2] - y[0], y[1])
                };
                (u, v, off)
            }
        }
    }
}

/// One irreducible family.
#[derive(Debug, Clone)]
pub(super) enum FamilyShape {
    /// All legs between two flats.
    Product { base: Flat, platform: Flat, base_points: Vec<Vector3<f64>>, platform_points: Vec<Vector3<f64>> },
    /// A flat of partners for every point of a curve of one body.
    Over { carrying: Body, curve: Curve, carrier: Flat, other: Flat, fibre: Vec<Polynomial> },
    /// One partner for every point of a plane: a vector of forms of the given degree.
    Graph { carrying: Body, carrier: Flat, other: Flat, degree: usize, map: Polynomial },
    /// A plane cubic and its partner; `platform` is the platform's curve, `centre` a joint on `base`.
    Cubic { product: Box<FlatProduct>, base: Form, platform: Option<Form>, centre: Vec<f64> },
}

/// Sine of the angle between a vector and a span.
fn off_span(v: &[f64], span: &[Vec<f64>]) -> f64 {
    norm(&without(&unit(v), &orthonormal(span, 1e-12)))
}

impl FamilyShape {
    /// Dimension of the family.
    pub(super) fn dimension(&self) -> usize {
        match self {
            Self::Product { base, platform, .. } => base.dimension() + platform.dimension(),
            Self::Over { fibre, .. } => fibre.len(),
            Self::Graph { .. } => 2,
            Self::Cubic { .. } => 1,
        }
    }

    /// Distance of a leg (normalised ends) from the family: distances over the sizes of the bodies, sines of angles.
    pub(super) fn distance(&self, a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
        match self {
            Self::Product { base, platform, .. } => base.distance(a).max(platform.distance(b)),
            Self::Over { carrying, curve, carrier, other, fibre } => {
                let (x, y) = carrying.of(((a, b), (b, a)));
                let (num, den, off) = curve.locate(&carrier.local(x));
                let span: Vec<Vec<f64>> = fibre.iter().map(|p| value(p, num, den)).collect();
                let fibre_off = off_span(&other.local(y), &span);
                carrier.distance(x).max(other.distance(y)).max(off).max(fibre_off)
            }
            Self::Graph { carrying, carrier, other, degree, map } => {
                let (x, y) = carrying.of(((a, b), (b, a)));
                let image = image(*degree, map, &carrier.local(x));
                let off = off_span(&other.local(y), &[image]);
                carrier.distance(x).max(other.distance(y)).max(off)
            }
            Self::Cubic { product, base, platform, .. } => {
                let (alpha, beta) = (unit(&product.base.local(a)), unit(&product.platform.local(b)));
                let mut off = product.base.distance(a).max(product.platform.distance(b));
                off = off.max(base.value(&alpha).abs() / base.norm());
                if let Some(form) = platform {
                    off = off.max(form.value(&beta).abs() / form.norm());
                }
                let rows = product.matrix(&alpha);
                rows.iter().fold(off, |m, row| m.max(dot(row, &beta).abs()))
            }
        }
    }

    /// The formulas, in design coordinates.
    pub(super) fn parametrisation(&self, ends: &BothReadings, n: &Normalisation) -> Parametrisation {
        match self {
            Self::Product { base_points, platform_points, .. } => {
                let first = base_points.len() - 1;
                let place = |body: Body, points: &[Vector3<f64>]| -> Vec<Vector3<f64>> {
                    points.iter().map(|p| ends.design_point(body, p, n)).collect()
                };
                Parametrisation::Rational {
                    parameters: first + platform_points.len() - 1,
                    base: affine(&place(Body::Base, base_points), 0),
                    platform: affine(&place(Body::Platform, platform_points), first),
                }
            }
            Self::Over { carrying, curve, carrier, other, fibre } => {
                let moving = single(&curve.polynomial());
                let mut partner: Vec<([u8; 3], Vec<f64>)> = Vec::new();
                for (l, p) in fibre.iter().enumerate() {
                    for (e, c) in p.iter().enumerate() {
                        let mut exponent = [e as u8, 0, 0];
                        if l > 0 {
                            exponent[l.min(2)] = 1;
                        }
                        partner.push((exponent, c.clone()));
                    }
                }
                two_sides(*carrying, fibre.len(), (carrier, &moving), (other, &partner), n)
            }
            Self::Graph { carrying, carrier, other, degree, map } => {
                let basis = |k: usize| (0..3).map(|i| if i == k { 1.0 } else { 0.0 }).collect::<Vec<f64>>();
                let moving = vec![([0, 0, 0], basis(0)), ([1, 0, 0], basis(1)), ([0, 1, 0], basis(2))];
                let partner: Vec<([u8; 3], Vec<f64>)> = exponents(*degree)
                    .zip(map)
                    .map(|(e, c)| ([e[1] as u8, e[2] as u8, 0], c.clone()))
                    .collect();
                two_sides(*carrying, 2, (carrier, &moving), (other, &partner), n)
            }
            Self::Cubic { product, base, centre, .. } => {
                Parametrisation::Cubic(Box::new(pencil(product, base, centre, n)))
            }
        }
    }
}

fn image(degree: usize, map: &Polynomial, alpha: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; map[0].len()];
    for (e, c) in exponents(degree).zip(map) {
        let factor: f64 = e.iter().zip(alpha).map(|(n, x)| power(*x, *n)).product();
        out.iter_mut().zip(c).for_each(|(o, x)| *o += factor * x);
    }
    out
}

fn base_place(n: &Normalisation, h: [f64; 4]) -> [f64; 4] {
    denormalised(h, &n.base_centre.coords, n.base_unit)
}

fn platform_place(n: &Normalisation, h: [f64; 4]) -> [f64; 4] {
    denormalised(h, &n.platform_centre.coords, n.platform_unit)
}

fn denormalised(h: [f64; 4], centre: &Vector3<f64>, unit: f64) -> [f64; 4] {
    [h[0], h[0] * centre.x + unit * h[1], h[0] * centre.y + unit * h[2], h[0] * centre.z + unit * h[3]]
}

fn single(p: &Polynomial) -> Vec<([u8; 3], Vec<f64>)> {
    p.iter().enumerate().map(|(e, c)| ([e as u8, 0, 0], c.clone())).collect()
}

type PolynomialTerms = [([u8; 3], Vec<f64>)];

fn two_sides(
    carrying: Body,
    parameters: usize,
    moving: (&Flat, &PolynomialTerms),
    partner: (&Flat, &PolynomialTerms),
    n: &Normalisation,
) -> Parametrisation {
    let point = |(flat, terms): (&Flat, &PolynomialTerms), body: Body| MovingPoint {
        terms: terms
            .iter()
            .map(|(e, c)| {
                let h = flat.place(c);
                (
                    *e,
                    match body {
                        Body::Base => base_place(n, h),
                        Body::Platform => platform_place(n, h),
                    },
                )
            })
            .collect(),
    };
    let (base, platform) = carrying.of(((moving, partner), (partner, moving)));
    let (base, platform) = (point(base, Body::Base), point(platform, Body::Platform));
    Parametrisation::Rational { parameters, base, platform }
}

/// `points_0 + sum_k t_(first + k) (points_k - points_0)`.
fn affine(points: &[Vector3<f64>], first: usize) -> MovingPoint {
    let mut terms = Vec::new();
    for (k, p) in points.iter().enumerate() {
        let mut exponent = [0; 3];
        let (w, x) = if k == 0 { (1.0, *p) } else { (0.0, p - points[0]) };
        if k > 0 {
            exponent[first + k - 1] = 1;
        }
        terms.push((exponent, [w, x.x, x.y, x.z]));
    }
    MovingPoint { terms }
}

/// Origin and axes of a plane in design units.
pub(super) fn frame(flat: &Flat, centre: Vector3<f64>, scale: f64) -> [Vector3<f64>; 3] {
    let axis = |k: usize| flat.axes.get(k).copied().unwrap_or_default() * scale;
    [centre + flat.origin * scale, axis(0), axis(1)]
}

fn pencil(product: &FlatProduct, base: &Form, centre: &[f64], n: &Normalisation) -> CubicPencil {
    let matrix = |e: &Vec<f64>| [0, 1, 2].map(|p| [0, 1, 2].map(|q| e[p * 3 + q]));
    CubicPencil {
        base_frame: frame(&product.base, n.base_centre.coords, n.base_unit),
        platform_frame: frame(&product.platform, n.platform_centre.coords, n.platform_unit),
        centre: [centre[0], centre[1], centre[2]],
        cubic: std::array::from_fn(|k| base.coefficients[k]),
        equations: product.equations.iter().map(matrix).collect(),
    }
}

/// A moving point in homogeneous coordinates, `sum_k terms_k` with `terms_k = coefficient * t^e1 u^e2 w^e3`.
///
/// The coefficient `(c0, c1, c2, c3)` belongs to the point `(c1, c2, c3) / c0`, design units and the frame of the body.
#[derive(Debug, Clone, PartialEq)]
pub struct MovingPoint {
    /// Exponents of the parameters and coefficients.
    pub terms: Vec<([u8; 3], [f64; 4])>,
}

impl MovingPoint {
    /// Homogeneous coordinates at the parameters; missing ones count as zero.
    #[must_use]
    pub fn homogeneous(&self, parameters: &[f64]) -> [f64; 4] {
        let mut out = [0.0; 4];
        for (e, c) in &self.terms {
            let power = |k: usize| parameters.get(k).copied().unwrap_or(0.0).powi(i32::from(e[k]));
            let factor = power(0) * power(1) * power(2);
            out.iter_mut().zip(c).for_each(|(o, x)| *o += factor * x);
        }
        out
    }

    /// Coefficients of the denominator `c0` in the first parameter, the other parameters zero.
    #[must_use]
    pub fn denominator(&self) -> Vec<f64> {
        let mut out = Vec::new();
        for (e, c) in self.terms.iter().filter(|(e, _)| e[1] == 0 && e[2] == 0) {
            let k = usize::from(e[0]);
            if out.len() <= k {
                out.resize(k + 1, 0.0);
            }
            out[k] += c[0];
        }
        out
    }

    /// Highest degree in the parameters together.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.terms.iter().map(|(e, _)| e.iter().map(|x| usize::from(*x)).sum()).max().unwrap_or(0)
    }
}

/// The legs of a plane cubic and its partner, by the lines through one base joint on the cubic.
///
/// At the parameter `t` in `[0, 2)` the line has the direction `cos(pi t) axes_0 + sin(pi t) axes_1`. Besides the
/// centre it meets the cubic in the two points `s = (-B +- sqrt(B^2 - 4 A C)) / (2 A)`, with the upper sign for
/// `t < 1`. `A s^3 + B s^2 + C s` is the cubic at `(1, s cos + c1, s sin + c2)`. The platform point is the null vector
/// of `M`.
#[derive(Debug, Clone, PartialEq)]
pub struct CubicPencil {
    /// Origin and axes of the base plane, design units: `a = origin + x axes_0 + y axes_1`.
    pub base_frame: [Vector3<f64>; 3],
    /// Origin and axes of the platform plane.
    pub platform_frame: [Vector3<f64>; 3],
    /// Coordinates `(1, x, y)` of the common joint of the lines.
    pub centre: [f64; 3],
    /// The cubic of the base plane: coefficients of `1, x, y, x^2, xy, y^2, x^3, x^2 y, x y^2, y^3`.
    pub cubic: [f64; 10],
    /// `equations[r][p][q]`: `sum alpha_p beta_q equations[r][p][q] = 0` for the legs, with `alpha = (1, x, y)` on the
    /// base and `beta` in the same form on the platform.
    pub equations: Vec<[[f64; 3]; 3]>,
}

/// Formulas for the legs of a family.
#[derive(Debug, Clone, PartialEq)]
pub enum Parametrisation {
    /// Both ends are rational functions of the parameters.
    Rational {
        /// Number of parameters, the dimension of the family.
        parameters: usize,
        /// Base end.
        base: MovingPoint,
        /// Platform end.
        platform: MovingPoint,
    },
    /// A plane cubic, which has no rational parametrisation in general.
    Cubic(Box<CubicPencil>),
}

impl Parametrisation {
    /// Number of parameters.
    #[must_use]
    pub fn parameters(&self) -> usize {
        match self {
            Self::Rational { parameters, .. } => *parameters,
            Self::Cubic(_) => 1,
        }
    }

    /// The leg at the parameters. `None` if an end is at infinity, the line through the centre has no further real
    /// point of the cubic, or parameters are missing.
    ///
    /// # Errors
    /// When a singular value decomposition does not converge.
    pub fn leg_at(&self, parameters: &[f64]) -> Result<Option<Leg>, LinalgError> {
        if parameters.len() < self.parameters() {
            return Ok(None);
        }
        match self {
            Self::Rational { base, platform, .. } => {
                let (a, b) = (finite(base.homogeneous(parameters)), finite(platform.homogeneous(parameters)));
                Ok(a.zip(b).map(|(base, platform)| Leg { base, platform }))
            }
            Self::Cubic(pencil) => pencil.leg_at(parameters[0]),
        }
    }
}

fn finite(h: [f64; 4]) -> Option<Point3<f64>> {
    let p = Point3::new(h[1] / h[0], h[2] / h[0], h[3] / h[0]);
    p.iter().all(|x| x.is_finite()).then_some(p)
}

impl CubicPencil {
    /// The cubic along `centre + s (cos, sin)`: coefficients of `1, s, s^2, s^3`.
    fn along(&self, direction: [f64; 2]) -> [f64; 4] {
        const EXPONENTS: [(usize, usize); 10] =
            [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2), (3, 0), (2, 1), (1, 2), (0, 3)];
        let mut out = [0.0; 4];
        for (c, (j, k)) in self.cubic.iter().zip(EXPONENTS) {
            let mut term = [*c, 0.0, 0.0, 0.0];
            let factors = std::iter::repeat_n(0, j).chain(std::iter::repeat_n(1, k));
            for f in factors {
                let (p, q) = (self.centre[f + 1], direction[f]);
                term = [
                    p * term[0],
                    p * term[1] + q * term[0],
                    p * term[2] + q * term[1],
                    p * term[3] + q * term[2],
                ];
            }
            out.iter_mut().zip(term).for_each(|(o, x)| *o += x);
        }
        out
    }

    /// The base point in plane coordinates at the parameter.
    fn base_point(&self, t: f64) -> Option<[f64; 3]> {
        let (sin, cos) = (std::f64::consts::PI * t).sin_cos();
        let [_, c, b, a] = self.along([cos, sin]);
        let root = (b * b - 4.0 * a * c).sqrt();
        if !root.is_finite() {
            return None;
        }
        let sign = if t.rem_euclid(2.0) < 1.0 { 1.0 } else { -1.0 };
        // the form of the quadratic formula without cancellation
        let s = if sign * b < 0.0 { (-b + sign * root) / (2.0 * a) } else { 2.0 * c / (-b - sign * root) };
        s.is_finite().then(|| [1.0, self.centre[1] + s * cos, self.centre[2] + s * sin])
    }

    /// The platform point (homogeneous plane coordinates) of a base point of the cubic.
    ///
    /// # Errors
    /// When a singular value decomposition does not converge.
    pub fn partner(&self, alpha: [f64; 3]) -> Result<[f64; 3], LinalgError> {
        let rows: Vec<Vec<f64>> = self
            .equations
            .iter()
            .map(|n| (0..3).map(|q| (0..3).map(|p| alpha[p] * n[p][q]).sum()).collect())
            .collect();
        let s = Spectrum::of(&rows, 3)?;
        Ok([0, 1, 2].map(|k| s.vectors[2][k]))
    }

    fn leg_at(&self, t: f64) -> Result<Option<Leg>, LinalgError> {
        let Some(alpha) = self.base_point(t) else { return Ok(None) };
        let beta = self.partner(alpha)?;
        let point = |frame: &[Vector3<f64>; 3], x: [f64; 3]| {
            let p = frame[0] + frame[1] * (x[1] / x[0]) + frame[2] * (x[2] / x[0]);
            p.iter().all(|x| x.is_finite()).then(|| Point3::from(p))
        };
        let ends = point(&self.base_frame, alpha).zip(point(&self.platform_frame, beta));
        Ok(ends.map(|(base, platform)| Leg { base, platform }))
    }
}
