//! Two planes: the curve of each and the correspondence between them.

use nalgebra::{Point3, Vector3};

use super::curves::{PartKind, SingularKind, on_line, same_point, singular_kind, singular_point};
use super::decision::{Decision, Question};
use super::exact_curve::{ExactCurve, NoExactCurve};
use super::form::Form;
use super::pairs::ClosedPair;
use super::planes::PlaneSide;
use super::product::Product;
use super::shape::frame;
use super::spectrum::{Spectrum, norm, unit};
use crate::num::Rng;
use crate::num::linalg::LinalgError;
use crate::synthesis::hexagon::Body;
use crate::synthesis::leg_vector::Normalisation;

/// A part of the curve in a plane.
#[derive(Debug, Clone, PartialEq)]
pub struct CurvePart {
    /// Line, conic or what does not split.
    pub kind: PartKind,
    /// Coefficients in the order of [`PlaneCurve::coefficients`], of the part's own degree.
    pub coefficients: Vec<f64>,
    /// How often it divides the curve.
    pub multiplicity: usize,
    /// The number that decided: residual of the curve on a line, ratio of eigenvalues of a conic.
    pub measure: f64,
}

/// A singular point of the curve in a plane.
#[derive(Debug, Clone, PartialEq)]
pub struct SingularPoint {
    /// Homogeneous plane coordinates, of norm 1.
    pub coordinates: [f64; 3],
    /// The point, `None` at infinity.
    pub point: Option<Point3<f64>>,
    /// What the curve looks like there.
    pub kind: SingularKind,
    /// Norm of the gradient there over the norm of the form.
    pub gradient: f64,
    /// Whether a whole line of the other plane corresponds to it: `M` has rank 1 there.
    pub line_of_partners: bool,
}

/// The points of one plane that carry replaceable legs.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneCurve {
    /// The body.
    pub body: Body,
    /// Origin of the plane coordinates, design units, frame of the body.
    pub origin: Point3<f64>,
    /// Axes: the point `(x, y)` is `origin + x axes_0 + y axes_1`. Orthogonal, as long as the joints reach.
    pub axes: [Vector3<f64>; 2],
    /// Degree of the curve; 0 when there is none, or when the whole plane carries replaceable legs.
    pub degree: usize,
    /// Coefficients of `1, x, y, x^2, x y, y^2, ..` (norm of Bombieri 1, the largest positive).
    pub coefficients: Vec<f64>,
    /// Rank of `M` at a generic point of the plane: below 3 every point carries a replaceable leg.
    pub generic_rank: usize,
    /// Lines, conics and the rest.
    pub parts: Vec<CurvePart>,
    /// Singular points found.
    pub singular_points: Vec<SingularPoint>,
    /// The numbers that decided.
    pub decisions: Vec<Decision>,
    /// The same curve for the joints as rational numbers, with its splitting over the complex numbers.
    pub exact: Result<ExactCurve, NoExactCurve>,
}

/// Two planes, with the correspondence of their points.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanePair {
    /// Index of the pair of flats.
    pub pair: usize,
    /// Base plane.
    pub base: PlaneCurve,
    /// Platform plane.
    pub platform: PlaneCurve,
    /// `sum_pq equations[r][p][q] alpha_p beta_q = 0` for the legs, `alpha = (1, x, y)` on the base and `beta` on the platform.
    pub equations: Vec<[[f64; 3]; 3]>,
    /// `Some(true)`: the cubic of the base plane of the exact data is proved to have no singular point, so that it does
    /// not split; `Some(false)`: it has one; `None`: there is no exact cubic, or its numbers are too long.
    pub smooth: Option<bool>,
}

/// What corresponds to a point.
#[derive(Debug, Clone, PartialEq)]
pub enum Partners {
    /// None: the point is not on the curve.
    None,
    /// One point, homogeneous plane coordinates.
    Point([f64; 3]),
    /// A line, spanned by two points.
    Line([[f64; 3]; 2]),
    /// The whole plane.
    Plane,
}

impl PlanePair {
    /// The points of the other plane that make a replaceable leg with a point of the plane of `body`; singular values of `M`
    /// not above `limit` (unit equations, unit point) count as zero.
    ///
    /// # Errors
    /// When the decomposition does not converge.
    pub fn partners(&self, body: Body, point: [f64; 3], limit: f64) -> Result<Partners, LinalgError> {
        let x = unit(&point);
        let entry = |n: &[[f64; 3]; 3], k: usize| -> f64 {
            (0..3).map(|p| x[p] * if body == Body::Base { n[p][k] } else { n[k][p] }).sum()
        };
        let rows: Vec<Vec<f64>> =
            self.equations.iter().map(|n| (0..3).map(|k| entry(n, k)).collect()).collect();
        let s = Spectrum::of(&rows, 3)?;
        let vector = |k: usize| [0, 1, 2].map(|i| s.vectors[k][i]);
        Ok(match s.rank(limit) {
            3 => Partners::None,
            2 => Partners::Point(vector(2)),
            1 => Partners::Line([vector(1), vector(2)]),
            _ => Partners::Plane,
        })
    }
}

/// The record of a closed pair of planes.
pub(super) fn plane_pair(
    index: usize,
    pair: &ClosedPair,
    sides: (&PlaneSide, &PlaneSide),
    n: &Normalisation,
    tolerance: f64,
    rng: &mut Rng,
) -> Result<PlanePair, LinalgError> {
    let frames = [
        frame(&pair.product.base, n.base_centre.coords, n.base_unit),
        frame(&pair.product.platform, n.platform_centre.coords, n.platform_unit),
    ];
    let turned = pair.product.exchanged();
    let matrix = |e: &Vec<f64>| [0, 1, 2].map(|p| [0, 1, 2].map(|q| e[p * 3 + q]));
    Ok(PlanePair {
        pair: index,
        base: curve(Body::Base, frames[0], sides.0, &pair.product, tolerance, rng)?,
        platform: curve(Body::Platform, frames[1], sides.1, &turned, tolerance, rng)?,
        equations: pair.product.equations.iter().map(matrix).collect(),
        smooth: sides.0.exact.as_ref().ok().and_then(|c| c.smooth),
    })
}

fn curve(
    body: Body,
    frame: [Vector3<f64>; 3],
    side: &PlaneSide,
    product: &Product,
    tolerance: f64,
    rng: &mut Rng,
) -> Result<PlaneCurve, LinalgError> {
    let (points, gap) = singular_points(side, tolerance, rng)?;
    let mut singular = Vec::new();
    for p in points {
        let s = product.spectrum(&p)?;
        let affine = frame[0] + frame[1] * (p[1] / p[0]) + frame[2] * (p[2] / p[0]);
        let gradient: Vec<f64> = side.form.gradient().iter().map(|d| d.value(&p)).collect();
        singular.push(SingularPoint {
            coordinates: [p[0], p[1], p[2]],
            point: (p[0].abs() > 1e-9).then(|| Point3::from(affine)),
            kind: singular_kind(&side.form, &p),
            gradient: norm(&gradient) / side.form.norm(),
            line_of_partners: s.rank((10.0 * tolerance).max(1e-7)) < 2,
        });
    }
    let mut decisions = side.decisions.clone();
    decisions.extend(gap);
    let part = |p: &super::curves::Part| CurvePart {
        kind: p.kind,
        coefficients: p.form.coefficients.clone(),
        multiplicity: p.multiplicity,
        measure: p.measure,
    };
    Ok(PlaneCurve {
        body,
        origin: Point3::from(frame[0]),
        axes: [frame[1], frame[2]],
        degree: side.form.degree,
        coefficients: side.form.coefficients.clone(),
        generic_rank: side.rank,
        parts: side.split.parts.iter().map(part).collect(),
        singular_points: singular,
        decisions,
        exact: side.exact.clone(),
    })
}

/// Real singular points: where parts meet, and those of a part that does not split.
fn singular_points(
    side: &PlaneSide,
    tolerance: f64,
    rng: &mut Rng,
) -> Result<(Vec<Vec<f64>>, Option<Decision>), LinalgError> {
    let mut out: Vec<Vec<f64>> = Vec::new();
    let mut add = |p: Vec<f64>| {
        // a line that touches a conic meets it in a double root, known to the square root of rounding
        if !out.iter().any(|q| same_point(q, &p, 1e-6)) {
            out.push(p);
        }
    };
    let parts = &side.split.parts;
    for (k, line) in parts.iter().enumerate().filter(|(_, p)| p.kind == PartKind::Line) {
        for other in parts.iter().enumerate().filter(|(l, p)| *l > k || p.kind != PartKind::Line) {
            for p in on_line(&line.form, &other.1.form)? {
                add(p);
            }
        }
    }
    let mut decision = None;
    for part in parts.iter().filter(|p| matches!(p.kind, PartKind::Cubic | PartKind::ComplexLines)) {
        let (p, size) = singular_point(&part.form, rng)?;
        let limit = (10.0 * tolerance).max(1e-12);
        if part.kind == PartKind::Cubic {
            let is = usize::from(size <= limit);
            decision = Some(Decision {
                question: Question::SingularPoint,
                value: is,
                numerical: is,
                exact: None,
                above: (size > limit).then_some(size),
                below: (size <= limit).then_some(size),
                tolerance: limit,
            });
        }
        if size <= limit {
            add(p);
        }
    }
    Ok((out, decision))
}

/// The value of a form at a homogeneous point of unit norm over the form's norm.
#[must_use]
pub fn curve_value(curve: &PlaneCurve, point: [f64; 3]) -> f64 {
    let form = Form { degree: curve.degree, coefficients: curve.coefficients.clone() };
    form.value(&unit(&point)) / form.norm()
}
