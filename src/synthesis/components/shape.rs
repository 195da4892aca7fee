//! The irreducible families as sets: how far a leg is from one, and its formulas.

use nalgebra::Vector3;

use super::flat::Flat;
use super::form::{Form, exponents, power};
use super::kernel::{Polynomial, value};
use super::pairs::Ends;
use super::parametrisation::{CubicPencil, MovingPoint, Parametrisation};
use super::product::Product;
use super::spectrum::{dot, norm, orthonormal, unit, without};
use crate::synthesis::leg_vector::Normalisation;

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

    /// Parameter `num / den` of the point of the curve near `alpha`, and how far `alpha` is from it.
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
pub(super) enum Shape {
    /// All legs between two flats.
    Product { base: Flat, platform: Flat, base_points: Vec<Vector3<f64>>, platform_points: Vec<Vector3<f64>> },
    /// A flat of partners for every point of a curve of one body.
    Over { over_platform: bool, curve: Curve, carrier: Flat, other: Flat, fibre: Vec<Polynomial> },
    /// One partner for every point of a plane: a vector of forms of the given degree.
    Graph { over_platform: bool, carrier: Flat, other: Flat, degree: usize, map: Polynomial },
    /// A plane cubic and its partner; `platform` is the platform's curve, `centre` a joint on `base`.
    Cubic { product: Box<Product>, base: Form, platform: Option<Form>, centre: Vec<f64> },
}

/// Sine of the angle between a vector and a span.
fn off_span(v: &[f64], span: &[Vec<f64>]) -> f64 {
    norm(&without(&unit(v), &orthonormal(span, 1e-12)))
}

impl Shape {
    /// Dimension of the family.
    pub(super) fn dimension(&self) -> usize {
        match self {
            Self::Product { base, platform, .. } => base.dimension() + platform.dimension(),
            Self::Over { fibre, .. } => fibre.len(),
            Self::Graph { .. } => 2,
            Self::Cubic { .. } => 1,
        }
    }

    /// How far a leg (normalised ends) is from the family: distances over the sizes of the bodies, sines of angles.
    pub(super) fn distance(&self, a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
        match self {
            Self::Product { base, platform, .. } => base.distance(a).max(platform.distance(b)),
            Self::Over { over_platform, curve, carrier, other, fibre } => {
                let (x, y) = if *over_platform { (b, a) } else { (a, b) };
                let (num, den, off) = curve.locate(&carrier.local(x));
                let span: Vec<Vec<f64>> = fibre.iter().map(|p| value(p, num, den)).collect();
                let fibre_off = off_span(&other.local(y), &span);
                carrier.distance(x).max(other.distance(y)).max(off).max(fibre_off)
            }
            Self::Graph { over_platform, carrier, other, degree, map } => {
                let (x, y) = if *over_platform { (b, a) } else { (a, b) };
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
    pub(super) fn parametrisation(&self, ends: &Ends, n: &Normalisation) -> Parametrisation {
        match self {
            Self::Product { base_points, platform_points, .. } => {
                let first = base_points.len() - 1;
                let place = |platform: bool, points: &[Vector3<f64>]| -> Vec<Vector3<f64>> {
                    points.iter().map(|p| ends.design_point(platform, p, n)).collect()
                };
                Parametrisation::Rational {
                    parameters: first + platform_points.len() - 1,
                    base: affine(&place(false, base_points), 0),
                    platform: affine(&place(true, platform_points), first),
                }
            }
            Self::Over { over_platform, curve, carrier, other, fibre } => {
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
                two_sides(*over_platform, fibre.len(), (carrier, &moving), (other, &partner), n)
            }
            Self::Graph { over_platform, carrier, other, degree, map } => {
                let basis = |k: usize| (0..3).map(|i| if i == k { 1.0 } else { 0.0 }).collect::<Vec<f64>>();
                let moving = vec![([0, 0, 0], basis(0)), ([1, 0, 0], basis(1)), ([0, 1, 0], basis(2))];
                let partner: Vec<([u8; 3], Vec<f64>)> = exponents(*degree)
                    .zip(map)
                    .map(|(e, c)| ([e[1] as u8, e[2] as u8, 0], c.clone()))
                    .collect();
                two_sides(*over_platform, 2, (carrier, &moving), (other, &partner), n)
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

type Terms = [([u8; 3], Vec<f64>)];

fn two_sides(
    over_platform: bool,
    parameters: usize,
    moving: (&Flat, &Terms),
    partner: (&Flat, &Terms),
    n: &Normalisation,
) -> Parametrisation {
    let point = |(flat, terms): (&Flat, &Terms), on_platform: bool| MovingPoint {
        terms: terms
            .iter()
            .map(|(e, c)| {
                let h = flat.place(c);
                (*e, if on_platform { platform_place(n, h) } else { base_place(n, h) })
            })
            .collect(),
    };
    let (base, platform) = if over_platform {
        (point(partner, false), point(moving, true))
    } else {
        (point(moving, false), point(partner, true))
    };
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

fn pencil(product: &Product, base: &Form, centre: &[f64], n: &Normalisation) -> CubicPencil {
    let matrix = |e: &Vec<f64>| [0, 1, 2].map(|p| [0, 1, 2].map(|q| e[p * 3 + q]));
    CubicPencil {
        base_frame: frame(&product.base, n.base_centre.coords, n.base_unit),
        platform_frame: frame(&product.platform, n.platform_centre.coords, n.platform_unit),
        centre: [centre[0], centre[1], centre[2]],
        cubic: std::array::from_fn(|k| base.coefficients[k]),
        equations: product.equations.iter().map(matrix).collect(),
    }
}
