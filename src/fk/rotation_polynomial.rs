//! The polynomial whose roots are a Cayley parameter of all poses. It has degree 40 for a general platform, as the
//! final polynomial of the elimination of Lee and Shim.
//!
//! Its coefficients are elementary symmetric functions of the roots, which certificates enclose. Nothing of the
//! elimination enters, so that any method that proves all poses gives the same polynomial.

use num_complex::Complex64;
use thiserror::Error;

use super::{Completeness, FkSolutions, SolutionSet};
use num::ball::{Disc, UP};
use num::interval::Interval;
use num::poly::EnclosedRoot;

/// Moduli up to here keep the error bounds of discs valid.
const LARGEST: f64 = (1u128 << 100) as f64;

/// More than the error of a root of unity: of the angle, below 2^-50 for angles up to 7, and of its sine and cosine.
const CIRCLE: f64 = 16.0 * f64::EPSILON;

/// The monic polynomial in `c_3 = z / w` of the quaternion of the platform's rotation.
#[derive(Debug, Clone, PartialEq)]
pub struct RotationPolynomial {
    /// Enclosures of the coefficients, the constant one first; the leading one is 1.
    pub coefficients: Vec<Interval>,
    /// The real roots of the polynomial, ascending, all simple.
    pub real_roots: Vec<EnclosedRoot>,
}

/// Why there is no such polynomial.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum NoRotationPolynomial {
    /// Poses may be missing, or form curves.
    #[error("the poses found are not proved to be all poses")]
    Incomplete,
    /// A root without certificate, or a multiple one.
    #[error("a pose has no certificate of its own")]
    Uncertified,
    /// `w = 0` is not excluded.
    #[error("a pose may be a half turn, where the Cayley parameter is infinite")]
    HalfTurn,
    /// Discs of two poses meet.
    #[error("two poses have one Cayley parameter, as mirror images do")]
    SameParameter,
    /// A number became too large for the bounds.
    #[error("the coefficients are too large to be enclosed")]
    TooLarge,
}

/// The polynomial of the poses found.
///
/// # Errors
/// [`NoRotationPolynomial`].
pub fn rotation_polynomial(found: &FkSolutions) -> Result<RotationPolynomial, NoRotationPolynomial> {
    let complete = matches!(found.completeness, Completeness::Proved { .. });
    if !complete || found.solution_set != SolutionSet::Isolated {
        return Err(NoRotationPolynomial::Incomplete);
    }
    let mut roots: Vec<Disc> = Vec::new();
    for root in &found.roots {
        let certificate = root.certificate.as_ref().filter(|_| root.multiplicity == 1);
        let r = &certificate.ok_or(NoRotationPolynomial::Uncertified)?.enclosure().rotation;
        // 4 w z = N (R_10 - R_01), 4 w^2 = N (1 + trace R)
        let four_squares = Disc::point(Complex64::ONE) + r[0][0] + r[1][1] + r[2][2];
        let inverse = four_squares.reciprocal().ok_or(NoRotationPolynomial::HalfTurn)?;
        roots.push((r[1][0] - r[0][1]) * inverse);
    }
    let real_roots = real_roots(&roots)?;
    let coefficients = interpolated(&roots);
    if !coefficients.iter().all(|c| c.magnitude() < LARGEST) {
        return Err(NoRotationPolynomial::TooLarge);
    }
    let mut coefficients: Vec<Interval> = coefficients.iter().map(real_part).collect();
    coefficients.push(Interval::from(1.0));
    Ok(RotationPolynomial { coefficients, real_roots })
}

/// The coefficients of `prod (c - r_i) - c^n` from its values at roots of unity, as many as a power of two.
///
/// A product of discs at a point loses only relative accuracy. Products of polynomials with discs as coefficients lose
/// as much as the coefficients cancel.
fn interpolated(roots: &[Disc]) -> Vec<Disc> {
    let count = roots.len().next_power_of_two();
    let unity: Vec<Disc> = (0..count)
        .map(|k| {
            let (sin, cos) = (std::f64::consts::TAU * k as f64 / count as f64).sin_cos();
            Disc { centre: Complex64::new(cos, sin), radius: CIRCLE }
        })
        .collect();
    let value = |k: usize| {
        let product = roots.iter().fold(Disc::point(Complex64::ONE), |p, r| p * (unity[k] - *r));
        product - unity[k * roots.len() % count]
    };
    let values: Vec<Disc> = (0..count).map(value).collect();
    let coefficient = |power: usize| {
        let terms = values.iter().enumerate().map(|(k, v)| *v * unity[(count - k) * power % count]);
        terms.fold(Disc::point(Complex64::ZERO), |sum, term| sum + term).scaled(1.0 / count as f64)
    };
    (0..roots.len()).map(coefficient).collect()
}

fn real_part(disc: &Disc) -> Interval {
    let (x, radius) = (disc.centre.re, disc.radius * UP);
    if radius <= 0.0 {
        return Interval::from(x);
    }
    Interval::new((x - radius).next_down(), (x + radius).next_up()).unwrap_or(Interval::WHOLE)
}

/// The roots are closed under conjugation: one whose conjugate can be no other root is real.
fn real_roots(roots: &[Disc]) -> Result<Vec<EnclosedRoot>, NoRotationPolynomial> {
    let mut real = Vec::new();
    for (i, root) in roots.iter().enumerate() {
        if roots[..i].iter().any(|other| !other.is_disjoint(root)) {
            return Err(NoRotationPolynomial::SameParameter);
        }
        let mirrored = Disc { centre: root.centre.conj(), ..*root };
        let own = roots.iter().enumerate().filter(|(_, other)| !other.is_disjoint(&mirrored));
        let places: Vec<usize> = own.map(|(k, _)| k).collect();
        if places == [i] {
            let bounds = real_part(root);
            real.push(EnclosedRoot { low: bounds.lo(), high: bounds.hi(), multiplicity: 1 });
        } else if places.len() > 1 {
            return Err(NoRotationPolynomial::SameParameter);
        }
    }
    real.sort_by(|a, b| a.low.total_cmp(&b.low));
    Ok(real)
}
