//! Polynomials whose roots are the values of a number at all poses. The number is a Cayley parameter of the rotation,
//! as in the elimination of Lee and Shim, or the squared distance of two joints. For a general platform the degree is
//! 40, and half as much for a distance between planar bodies.
//!
//! The coefficients are elementary symmetric functions of the roots, which certificates enclose. Nothing of an
//! elimination enters, so that any method that proves all poses gives the same polynomial.

use num_complex::Complex64;
use thiserror::Error;

use super::{Completeness, FkRoot, FkSolutions, SolutionSet};
use crate::solve::certify::PoseEnclosure;
use num::ball::{Disc, UP};
use num::interval::Interval;
use num::poly::EnclosedRoot;
use platform::manipulator::{Body, Manipulator, dimension_of_ends};

/// Moduli up to here keep the error bounds of discs valid.
const LARGEST: f64 = (1u128 << 100) as f64;

/// Circles on which a polynomial is evaluated, about this many. A coefficient is enclosed best on the circle on which
/// its term is largest.
const CIRCLES: i32 = 24;

/// More than the error of a root of unity: of the angle, below 2^-50 for angles up to 7, and of its sine and cosine.
const CIRCLE: f64 = 16.0 * f64::EPSILON;

/// A monic polynomial whose roots are the values of a number at all poses.
#[derive(Debug, Clone, PartialEq)]
pub struct PosePolynomial {
    /// Enclosures of the coefficients, the constant one first; the leading one is 1.
    pub coefficients: Vec<Interval>,
    /// The real roots of the polynomial, ascending, all simple.
    pub real_roots: Vec<EnclosedRoot>,
}

/// Why there is no such polynomial.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum NoPosePolynomial {
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
    #[error("two poses have one value of the unknown, as mirror images may")]
    SameValue,
    /// A leg joins the two joints.
    #[error("a leg joins these joints: their distance is given")]
    Leg,
    /// A joint has no leg.
    #[error("no leg ends at one of these joints")]
    Unused,
    /// A number became too large for the bounds.
    #[error("the coefficients are too large to be enclosed")]
    TooLarge,
}

/// The polynomial in `c_3 = z / w` of the quaternion of the platform's rotation.
///
/// # Errors
/// [`NoPosePolynomial`].
pub fn rotation_polynomial(found: &FkSolutions) -> Result<PosePolynomial, NoPosePolynomial> {
    let parameter = |e: &PoseEnclosure| {
        let r = &e.rotation;
        // 4 w z = N (R_10 - R_01), 4 w^2 = N (1 + trace R)
        let four_squares = Disc::point(Complex64::ONE) + r[0][0] + r[1][1] + r[2][2];
        let inverse = four_squares.reciprocal().ok_or(NoPosePolynomial::HalfTurn)?;
        Ok((r[1][0] - r[0][1]) * inverse)
    };
    PosePolynomial::of(&values(found, parameter)?)
}

/// The polynomial in the squared distance of a base joint and a platform joint that no leg joins, by their numbers.
///
/// Between planar bodies, poses come in pairs of mirror images with equal distances: each pair has one root. A pose
/// that is its own mirror image has both bodies in one plane, so that its legs are dependent and it has no certificate
/// of its own.
///
/// # Errors
/// [`NoPosePolynomial`].
pub fn distance_polynomial(
    m: &Manipulator,
    found: &FkSolutions,
    (base, platform): (usize, usize),
) -> Result<PosePolynomial, NoPosePolynomial> {
    if m.pairs().contains(&(base, platform)) {
        return Err(NoPosePolynomial::Leg);
    }
    let joint = |body: Body, joint: usize| -> Result<[Disc; 3], NoPosePolynomial> {
        let leg = m.pairs().iter().position(|pair| body.of(*pair) == joint);
        let radius = m.end_radius(leg.ok_or(NoPosePolynomial::Unused)?, body);
        let place: [f64; 3] = m.joints(body)[joint].coords.into();
        Ok(place.map(|x| Disc { centre: Complex64::from(x), radius }))
    };
    let (a, b) = (joint(Body::Base, base)?, joint(Body::Platform, platform)?);
    let square = |e: &PoseEnclosure| {
        let along = |i: usize| {
            let moved = (0..3).fold(e.position[i] - a[i], |sum, k| sum + e.rotation[i][k] * b[k]);
            moved * moved
        };
        Ok(along(0) + along(1) + along(2))
    };
    let squares = values(found, square)?;
    let partner = |(i, own): (usize, &Disc)| {
        let meets: Vec<usize> = (0..squares.len()).filter(|k| !own.is_disjoint(&squares[*k])).collect();
        if let [x, y] = meets[..] { Some(x + y - i) } else { None }
    };
    let partners: Option<Vec<usize>> = squares.iter().enumerate().map(partner).collect();
    match partners {
        Some(other) if is_planar(m) => {
            let each_once: Vec<Disc> =
                squares.iter().zip(0..).filter(|(_, i)| *i < other[*i]).map(|(x, _)| *x).collect();
            PosePolynomial::of(&each_once)
        }
        _ => PosePolynomial::of(&squares),
    }
}

/// Whether the joints of either body lie in a plane, exactly; `false` for numbers that are too long.
fn is_planar(m: &Manipulator) -> bool {
    let in_plane = |ends: &_, body| dimension_of_ends(ends, body).is_some_and(|dimension| dimension <= 2);
    m.exact_ends().is_some_and(|ends| Body::BOTH.into_iter().all(|body| in_plane(&ends, body)))
}

/// The values of a number at all poses.
fn values(
    found: &FkSolutions,
    of: impl Fn(&PoseEnclosure) -> Result<Disc, NoPosePolynomial>,
) -> Result<Vec<Disc>, NoPosePolynomial> {
    let complete = matches!(found.completeness, Completeness::Proved { .. });
    if !complete || found.solution_set != SolutionSet::Isolated {
        return Err(NoPosePolynomial::Incomplete);
    }
    let one = |root: &FkRoot| {
        let certificate = root.certificate.as_ref().filter(|_| root.multiplicity == 1);
        of(certificate.ok_or(NoPosePolynomial::Uncertified)?.enclosure())
    };
    found.roots.iter().map(one).collect()
}

impl PosePolynomial {
    /// The polynomial with these roots, which are closed under conjugation.
    fn of(roots: &[Disc]) -> Result<Self, NoPosePolynomial> {
        let real_roots = real_roots(roots)?;
        let sizes = roots.iter().map(|root| root.centre.norm().log2().round());
        let sizes: Vec<i32> = sizes.filter(|size| size.is_finite()).map(|size| size as i32).collect();
        let (least, most) =
            (sizes.iter().min().copied().unwrap_or(0), sizes.iter().max().copied().unwrap_or(0));
        let step = usize::try_from((most - least) / CIRCLES).unwrap_or(0).max(1);
        let mut found: Vec<Option<Interval>> = vec![None; roots.len()];
        for exponent in (least..=most).step_by(step) {
            // on a circle of the size of some roots
            let shrunk: Vec<Disc> = roots.iter().map(|root| root.scaled(2f64.powi(-exponent))).collect();
            let scaled = interpolated(&shrunk);
            if !scaled.iter().all(|c| c.magnitude() < LARGEST) {
                continue;
            }
            for (k, (best, c)) in found.iter_mut().zip(&scaled).enumerate() {
                let below = i32::try_from(roots.len() - k).unwrap_or(i32::MAX);
                let unit = 2f64.powi(exponent.saturating_mul(below));
                let bounds = real_part(c) * Interval::from(unit);
                let is_finite = unit.is_normal() && bounds.lo().is_finite() && bounds.hi().is_finite();
                if is_finite && best.is_none_or(|b| bounds.hi() - bounds.lo() < b.hi() - b.lo()) {
                    *best = Some(bounds);
                }
            }
        }
        let coefficients: Option<Vec<Interval>> = found.into_iter().collect();
        let mut coefficients = coefficients.ok_or(NoPosePolynomial::TooLarge)?;
        coefficients.push(Interval::from(1.0));
        Ok(Self { coefficients, real_roots })
    }
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
fn real_roots(roots: &[Disc]) -> Result<Vec<EnclosedRoot>, NoPosePolynomial> {
    let mut real = Vec::new();
    for (i, root) in roots.iter().enumerate() {
        if roots[..i].iter().any(|other| !other.is_disjoint(root)) {
            return Err(NoPosePolynomial::SameValue);
        }
        let mirrored = Disc { centre: root.centre.conj(), ..*root };
        let own = roots.iter().enumerate().filter(|(_, other)| !other.is_disjoint(&mirrored));
        let places: Vec<usize> = own.map(|(k, _)| k).collect();
        if places == [i] {
            let bounds = real_part(root);
            real.push(EnclosedRoot { low: bounds.lo(), high: bounds.hi(), multiplicity: 1 });
        } else if places.len() > 1 {
            return Err(NoPosePolynomial::SameValue);
        }
    }
    real.sort_by(|a, b| a.low.total_cmp(&b.low));
    Ok(real)
}

#[cfg(test)]
mod tests {
    use nalgebra::{Point3, Vector3};

    use super::*;
    use crate::{FkOptions, ForwardKinematics, Homotopy};
    use num::Rng;
    use platform::geom::{Pose, random_rotation};
    use platform::manipulator::Leg;

    /// T06 with 24 poses, joints in space and in planes.
    #[test]
    fn distances_at_all_poses_are_roots_and_mirror_images_share_theirs() {
        let legs = [(0, 0), (0, 1), (1, 2), (2, 2), (3, 3), (4, 4)];
        for (height, degree) in [(1.0, 24), (0.0, 12)] {
            let mut rng = Rng::new(5);
            let mut points = |count: usize| -> Vec<Point3<f64>> {
                let mut point = |_| {
                    let [x, y, z] = [0; 3].map(|_| rng.uniform(-2.0, 2.0));
                    Point3::new(x, y, height * z)
                };
                (0..count).map(&mut point).collect()
            };
            let m = Manipulator::try_new(points(5), points(5), legs).unwrap();
            let rotation = random_rotation(&mut rng);
            let pose = Pose { rotation, position: Vector3::new(0.3, 0.2, 2.5) };
            let found =
                Homotopy.solve(&m, &pose.squared_lengths(&m).unwrap(), &FkOptions::default()).unwrap();
            let p = distance_polynomial(&m, &found, (1, 3)).unwrap();
            assert_eq!(p.coefficients.len(), degree + 1);
            let leg = Leg { base: m.base_joints()[1], platform: m.platform_joints()[3] };
            let own = (pose.transform(&leg.platform) - leg.base).norm_squared();
            let over = p.real_roots.iter().filter(|r| r.low - 1e-9 <= own && own <= r.high + 1e-9);
            assert_eq!(over.count(), 1, "{own}: {:?}", p.real_roots);
            // the sum of the roots, each of a pair counted once
            let sum: Complex64 = found.roots.iter().map(|r| r.pose.squared_length(&leg)).sum();
            let sum = sum.re * degree as f64 / found.roots.len() as f64;
            let last = p.coefficients[degree - 1];
            let error = 1e-9 * sum.abs();
            assert!(last.lo() - error <= -sum && -sum <= last.hi() + error, "{last:?}, {sum}");
            assert!(last.hi() - last.lo() < 1e-3 * sum.abs(), "{last:?}");
            assert_eq!(distance_polynomial(&m, &found, (0, 0)), Err(NoPosePolynomial::Leg));
        }
    }
}
