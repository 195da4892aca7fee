//! A leg as a vector of `R^16`, and the span of six of them.
//!
//! With `v(a, b) = (1, a) (x) (1, b)` (Kronecker product) the squared length of a leg at the pose `(R, p)` is
//!
//! ```text
//! s(a, b) = <v(a, b), W(R, p)> + |a|^2 + |b|^2,
//! ```
//!
//! where `W` has the entries `|p|^2`, `-2p`, `2 R^T p`, `-2R` and depends on the pose only. The sixteen entries of `W`,
//! together with 1, are linearly independent functions of the pose for combinations with coefficient sum 1. So a leg is
//! an affine function of six others exactly if its vector lies in their span.

use nalgebra::{Point3, Vector3};

use num::algebraic::RoundedBasis;
use num::linalg::{LinalgError, svd};
use platform::manipulator::{Leg, Manipulator};

/// `v(a, b) = (1, a) (x) (1, b)`: entry `4 i + j` is `(1, a)_i (1, b)_j`.
#[must_use]
pub fn leg_vector(leg: &Leg) -> [f64; 16] {
    let a = [1.0, leg.base.x, leg.base.y, leg.base.z];
    let b = [1.0, leg.platform.x, leg.platform.y, leg.platform.z];
    std::array::from_fn(|k| a[k / 4] * b[k % 4])
}

/// The shift and the unit of the joints of each body before ranks are decided.
///
/// Writing `a = o + L x` maps `(1, a)` to `M (1, x)` with an invertible `M`. Every leg vector is thus multiplied by one
/// invertible 16 x 16 matrix, which keeps spans, ranks and the coefficients `A` of a leg map. For each body, `o` is the
/// centroid of the leg ends and `L` their greatest distance from it. The entries of `v` are then of order one in any
/// unit, for bodies of different sizes, and for frames with distant origins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Normalisation {
    /// Centroid of the base ends of the legs, base frame.
    pub base_centre: Point3<f64>,
    /// Centroid of the platform ends of the legs, platform frame.
    pub platform_centre: Point3<f64>,
    /// Unit of the base, design units; positive.
    pub base_unit: f64,
    /// Unit of the platform, design units; positive.
    pub platform_unit: f64,
}

impl Normalisation {
    /// Centre and unit of the two bodies of `m`. A body with coincident leg ends takes the unit of the other.
    #[must_use]
    pub fn of(m: &Manipulator) -> Self {
        let legs = m.legs();
        let (base_centre, base) = centre_and_reach(&legs.map(|l| l.base));
        let (platform_centre, platform) = centre_and_reach(&legs.map(|l| l.platform));
        let positive = |unit: f64, other: f64| if unit > 0.0 { unit } else { other };
        Self {
            base_centre,
            platform_centre,
            base_unit: positive(base, platform),
            platform_unit: positive(platform, base),
        }
    }

    /// The leg in the normalised, dimensionless coordinates.
    #[must_use]
    pub fn apply(&self, leg: &Leg) -> Leg {
        Leg {
            base: Point3::from((leg.base - self.base_centre) / self.base_unit),
            platform: Point3::from((leg.platform - self.platform_centre) / self.platform_unit),
        }
    }
}

fn centre_and_reach(points: &[Point3<f64>; 6]) -> (Point3<f64>, f64) {
    // differences from the first point first, so a distant origin loses no digits
    let mean = points.iter().map(|p| p - points[0]).sum::<Vector3<f64>>() / 6.0;
    let centre = points[0] + mean;
    (centre, points.iter().map(|p| (p - centre).norm()).fold(0.0, f64::max))
}

/// Ratio of singular values below which vectors in doubles lose more than three digits of their span.
const FEW_DIGITS: f64 = 1e-3;

/// Whether vectors with these least and largest singular values keep the digits of their span in doubles.
pub(super) fn keeps_digits(least: f64, largest: f64) -> bool {
    least > FEW_DIGITS * largest
}

/// The span of the six leg vectors of a manipulator, by a singular value decomposition.
#[derive(Debug, Clone)]
pub struct LegSpan {
    normalisation: Normalisation,
    rank: usize,
    singular_values: [f64; 6],
    u: Vec<Vec<f64>>,
    v: Vec<Vec<f64>>,
    /// `dual[i] . w` is the coefficient of leg `i` in the projection of `w` on the span.
    dual: [[f64; 16]; 6],
}

impl LegSpan {
    /// Decomposes the normalised leg vectors; singular values not above `rank_tolerance` times the largest
    /// count as zero.
    ///
    /// # Errors
    /// When the decomposition does not converge.
    pub fn of(m: &Manipulator, rank_tolerance: f64) -> Result<Self, LinalgError> {
        let normalisation = Normalisation::of(m);
        let rows: Vec<Vec<f64>> =
            m.legs().iter().map(|leg| leg_vector(&normalisation.apply(leg)).to_vec()).collect();
        let d = svd(&rows)?;
        let singular_values: [f64; 6] = std::array::from_fn(|k| d.s[k]);
        let rank = singular_values.iter().filter(|s| **s > rank_tolerance * singular_values[0]).count();
        let quotient = |i: usize, c: usize| -> f64 {
            (0..rank).map(|k| d.u[i][k] * d.v[c][k] / singular_values[k]).sum()
        };
        let dual = std::array::from_fn(|i| std::array::from_fn(|c| quotient(i, c)));
        Ok(Self { normalisation, rank, singular_values, u: d.u, v: d.v, dual })
    }

    /// The same legs with the span of their exact vectors, whose basis is given in normalised coordinates.
    ///
    /// Rounded vectors that are nearly dependent span another space. The singular values remain those of the rounded
    /// vectors.
    pub(super) fn with_basis(self, basis: &RoundedBasis) -> Result<Self, LinalgError> {
        let rank = basis.vectors.len();
        let d = svd(&basis.vectors)?;
        // the coefficients in the basis, by the pseudo-inverse, times those of the legs in the basis
        let along = |k: usize, c: usize| -> f64 { (0..rank).map(|j| d.u[k][j] * d.v[c][j] / d.s[j]).sum() };
        let quotient =
            |i: usize, c: usize| -> f64 { (0..rank).map(|k| basis.coefficients[k][i] * along(k, c)).sum() };
        let dual = std::array::from_fn(|i| std::array::from_fn(|c| quotient(i, c)));
        Ok(Self { rank, v: d.v, dual, ..self })
    }

    /// Whether doubles keep the span: its smallest singular value loses at most three digits.
    pub(super) fn is_well_conditioned(&self, rank: usize) -> bool {
        self.rank >= rank
            && (rank == 0 || keeps_digits(self.singular_values[rank - 1], self.singular_values[0]))
    }

    /// Dimension of the span, 6 for independent legs.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.rank
    }

    /// Singular values of the six normalised leg vectors, largest first.
    #[must_use]
    pub fn singular_values(&self) -> [f64; 6] {
        self.singular_values
    }

    /// The smallest singular value over the largest, in `[0, 1]`.
    #[must_use]
    pub fn inverse_condition(&self) -> f64 {
        self.singular_values[5] / self.singular_values[0]
    }

    /// The normalised coordinates of the comparison.
    #[must_use]
    pub fn normalisation(&self) -> Normalisation {
        self.normalisation
    }

    /// Distance of the vector of `leg` from the span over its length, in `[0, 1]`, in normalised coordinates.
    ///
    /// The squared length of `leg` is an affine function of the six exactly if this is zero.
    #[must_use]
    pub fn distance(&self, leg: &Leg) -> f64 {
        let w = leg_vector(&self.normalisation.apply(leg));
        let norm = w.iter().map(|x| x * x).sum::<f64>().sqrt();
        // the part along the orthogonal complement, which avoids differences of nearly equal numbers
        let across: f64 = (self.rank..16).map(|k| self.along(k, &w).powi(2)).sum();
        across.sqrt() / norm
    }

    /// Coefficients of the projection of the vector of `leg` on the span. When the rank is below six they are the
    /// shortest ones, or those of a basis among the legs.
    #[must_use]
    pub fn coefficients(&self, leg: &Leg) -> [f64; 6] {
        let w = leg_vector(&self.normalisation.apply(leg));
        self.dual.map(|row| row.iter().zip(&w).map(|(d, x)| d * x).sum())
    }

    /// A unit vector `n` with `sum n_i v_i = 0` for each missing dimension of the span. The vectors are in normalised
    /// coordinates; the dependency itself is independent of coordinates. Empty for independent legs.
    #[must_use]
    pub fn dependencies(&self) -> Vec<[f64; 6]> {
        (self.rank..6).map(|k| std::array::from_fn(|i| self.u[i][k])).collect()
    }

    /// An orthonormal basis of the complement of the span in `R^16`, normalised coordinates.
    pub(super) fn complement(&self) -> Vec<[f64; 16]> {
        (self.rank..16).map(|k| std::array::from_fn(|i| self.v[i][k])).collect()
    }

    fn along(&self, k: usize, w: &[f64; 16]) -> f64 {
        (0..16).map(|i| self.v[i][k] * w[i]).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num::Rng;
    use platform::geom::{Pose, random_rotation};

    fn point(rng: &mut Rng) -> Point3<f64> {
        Point3::new(rng.normal(), rng.normal(), rng.normal())
    }

    #[test]
    fn squared_length_is_linear_in_the_leg_vector() {
        let mut rng = Rng::new(11);
        for _ in 0..20 {
            let leg = Leg { base: point(&mut rng), platform: point(&mut rng) };
            let pose = Pose { rotation: random_rotation(&mut rng), position: point(&mut rng).coords };
            let (r, p) = (pose.rotation.matrix(), pose.position);
            let rp = r.transpose() * p;
            let w: [f64; 16] = std::array::from_fn(|k| match (k / 4, k % 4) {
                (0, 0) => p.norm_squared(),
                (i, 0) => -2.0 * p[i - 1],
                (0, j) => 2.0 * rp[j - 1],
                (i, j) => -2.0 * r[(i - 1, j - 1)],
            });
            let v = leg_vector(&leg);
            let linear: f64 = v.iter().zip(w).map(|(x, y)| x * y).sum();
            let s = linear + leg.base.coords.norm_squared() + leg.platform.coords.norm_squared();
            assert!((s - pose.squared_length(&leg)).abs() < 1e-12);
        }
    }

    #[test]
    fn four_legs_on_a_line_of_legs_lower_the_rank_to_the_right_number() {
        // two legs span a line that contains all further legs from the same platform joint to that line
        let mut rng = Rng::new(3);
        let (a, b, p) = (point(&mut rng), point(&mut rng), point(&mut rng));
        let mut legs: [Leg; 6] =
            std::array::from_fn(|_| Leg { base: point(&mut rng), platform: point(&mut rng) });
        for (leg, t) in legs.iter_mut().zip([0.0, 0.4, 1.0]) {
            *leg = Leg { base: a + (b - a) * t, platform: p };
        }
        let m = Manipulator::from_legs(legs).unwrap();
        let span = LegSpan::of(&m, 1e-9).unwrap();
        assert_eq!(span.rank(), 5);
        let n = span.dependencies();
        assert_eq!(n.len(), 1);
        // the dependency holds between the first three legs: 0.6 v1 - v2 + 0.4 v3 = 0
        assert!((n[0][0] / n[0][1] + 0.6).abs() < 1e-12 && n[0][4].abs() < 1e-12);
    }
}
