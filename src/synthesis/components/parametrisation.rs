//! Explicit formulas for the legs of a family.

use nalgebra::{Point3, Vector3};

use super::spectrum::Spectrum;
use crate::manipulator::Leg;
use crate::num::linalg::LinalgError;

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
/// At the parameter `t` in `[0, 2)` the line has the direction `cos(pi t) axes_0 + sin(pi t) axes_1`; besides the
/// centre it meets the cubic in the two points with `s = (-B +- sqrt(B^2 - 4 A C)) / (2 A)`, the upper sign for `t < 1`,
/// where `A s^3 + B s^2 + C s` is the cubic at `(1, s cos + c1, s sin + c2)`. The platform point is the null vector of `M`.
#[derive(Debug, Clone, PartialEq)]
pub struct CubicPencil {
    /// Origin and axes of the base plane, design units: `a = origin + x axes_0 + y axes_1`.
    pub base_frame: [Vector3<f64>; 3],
    /// Origin and axes of the platform plane.
    pub platform_frame: [Vector3<f64>; 3],
    /// Coordinates `(1, x, y)` of the joint through which the lines go.
    pub centre: [f64; 3],
    /// The cubic of the base plane: coefficients of `1, x, y, x^2, xy, y^2, x^3, x^2 y, x y^2, y^3`.
    pub cubic: [f64; 10],
    /// `equations[r][p][q]`: `sum alpha_p beta_q equations[r][p][q] = 0` for the legs with `alpha = (1, x, y)` on the base
    /// and `beta` likewise on the platform.
    pub equations: Vec<[[f64; 3]; 3]>,
}

/// Formulas for the legs of a family.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
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

    /// The leg at the parameters; `None` where an end is at infinity, where the line through the centre meets the cubic in
    /// no further real point, or where parameters are missing.
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

    /// The platform point (homogeneous plane coordinates) that belongs to a base point of the cubic.
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
