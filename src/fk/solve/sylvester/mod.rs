//! Six leg equations by a 15 x 15 Sylvester matrix in one Cayley parameter.
//!
//! Lee, Shim, Elimination-based solution method for the forward kinematics of the general Stewart-Gough platform. With
//! leg 1 between the origins and `q = R^T p` the legs 2..6 are linear in `(q, p)` and leave a line
//! `(q, p) = u + lambda n`. Then `(I + C) q = (I - C) p` gives three quartics `Theta` in the Cayley parameters, and
//! `p.p = L_1` gives six sextics `Phi`. The quartics lower every power of degree five and six in `c_1, c_2`. Fifteen
//! combinations are linear in the fifteen monomials of degree at most four in `c_1, c_2`, with coefficients in `c_3`.
//! The determinant of that matrix is a polynomial of degree 40.
//!
//! Here nothing is expanded in `c_3`. The matrix is built at 48 points of the unit circle, in double-double arithmetic,
//! and the determinants are interpolated. These are eight points more than a polynomial of degree 40 needs, so that the
//! degree is checked and not assumed. Roots are found in double-double arithmetic by Ehrlich-Aberth iteration,
//! `c_1, c_2` from the null vector of the matrix at a root.

mod bivariate;
mod elimination;
mod equations;
mod univariate;

use nalgebra::Vector3;
use num_complex::Complex64;
use thiserror::Error;

use super::generic_frame::{GenericProblem, RawCandidate};
use elimination::Triangularised;
use equations::ReducedEquations;
use num::double_double::{ComplexDoubleDouble as Number, DoubleDouble};
use platform::geom::ComplexPose;

/// Degree of the eliminant.
const DEGREE: usize = 40;
/// Interpolation points.
const POINTS: usize = 48;
/// Coefficients above degree 40 beyond this, relative to the largest, are not rounding.
const EXCESS_LIMIT: f64 = 1e-14;

/// Why the elimination does not work on a platform.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SylvesterError {
    /// The five equations linear in `(q, p)` are dependent.
    #[error(
        "the leg equations linear in the position are dependent (pivot ratio {pivot_ratio:.1e}), as for planar base \
         and platform or too few distinct joints"
    )]
    DependentLegs {
        /// Smallest pivot over largest.
        pivot_ratio: f64,
    },
    /// The cubics that lower the degree have a common root.
    #[error("monomials of degree five cannot be eliminated (pivot ratio {pivot_ratio:.1e})")]
    CommonFactor {
        /// Smallest pivot over largest.
        pivot_ratio: f64,
    },
    /// The determinant vanishes identically or is not a polynomial of degree 40 to rounding.
    #[error(
        "the determinant is not a polynomial of degree 40 (excess coefficients {excess:.1e} of the largest)"
    )]
    NotDegree40 {
        /// Largest coefficient above degree 40 relative to the largest of all.
        excess: f64,
    },
}

/// The degree-40 polynomial in `c_3` of a problem.
#[derive(Debug, Clone)]
pub struct Eliminant {
    equations: ReducedEquations,
    coefficients: Vec<DoubleDouble>,
    /// Largest interpolated coefficient above degree 40 relative to the largest of all: the noise.
    pub excess: f64,
}

impl Eliminant {
    /// Rows and columns of the matrix.
    pub const MATRIX: usize = 15;
    /// Degree of the determinant, and number of candidates.
    pub const DEGREE: usize = DEGREE;
    /// Values of `c_3` at which the determinant is taken.
    pub const POINTS: usize = POINTS;

    /// Eliminates all unknowns but `c_3`.
    ///
    /// # Errors
    /// [`SylvesterError`] when the elimination degenerates.
    pub fn of(problem: &GenericProblem) -> Result<Self, SylvesterError> {
        Self::with(ReducedEquations::of(problem)?, |_, _| {})
    }

    /// The eliminant of the matrices after a change `touch(c_3, matrix)`, which only tests make.
    fn with(
        equations: ReducedEquations,
        touch: impl Fn(Number, &mut [Vec<Number>]),
    ) -> Result<Self, SylvesterError> {
        let values: Result<Vec<Number>, SylvesterError> = (0..=POINTS / 2)
            .map(|k| {
                let c3 = univariate::root_of_unity(k, POINTS);
                let mut matrix = equations.slice(c3).matrix(c3)?;
                touch(c3, &mut matrix);
                Ok(Triangularised::new(matrix, Self::MATRIX).determinant())
            })
            .collect();
        let mut coefficients = univariate::interpolate(&values?, POINTS);
        let largest = |c: &[DoubleDouble]| c.iter().map(|x| x.hi().abs()).fold(0.0, f64::max);
        let excess = largest(&coefficients[DEGREE + 1..]) / largest(&coefficients);
        coefficients.truncate(DEGREE + 1);
        if !(excess < EXCESS_LIMIT) {
            return Err(SylvesterError::NotDegree40 { excess });
        }
        Ok(Self { equations, coefficients, excess })
    }

    /// Coefficients, constant first, rounded to doubles.
    #[must_use]
    pub fn coefficients(&self) -> Vec<f64> {
        self.coefficients.iter().map(|c| c.hi()).collect()
    }

    /// The values of `c_3`; none where the iteration fails.
    #[must_use]
    pub fn roots(&self) -> Vec<Number> {
        univariate::roots(&self.coefficients).unwrap_or_default()
    }

    /// The roots and the pose of each in the design's frames, not checked; `None` where no finite pose results.
    #[must_use]
    pub fn poses(&self, problem: &GenericProblem) -> Vec<Option<ComplexPose>> {
        self.roots().into_iter().map(|c3| problem.pose(&self.candidate(c3)?)).collect()
    }

    /// Back substitution of a root; `None` where the powers of `c_1, c_2` do not follow.
    #[must_use]
    pub fn candidate(&self, c3: Number) -> Option<RawCandidate> {
        let slice = self.equations.slice(c3);
        let w = Triangularised::new(slice.matrix(c3).ok()?, Self::MATRIX).null_vector();
        let (c1, c2) = (w[1] / w[0], w[2] / w[0]);
        let value = |p: &bivariate::Bivariate| p.value(c1, c2);
        let denominators = slice.denominators.each_ref().map(value);
        // of the three expressions for the position the one with the largest denominator
        let best =
            (0..3).max_by(|&i, &j| denominators[i].hi().norm().total_cmp(&denominators[j].hi().norm()))?;
        let p = slice.numerators[best].each_ref().map(|n| (value(n) / denominators[best]).hi());
        Some(RawCandidate {
            quaternion: [Complex64::ONE, c1.hi(), c2.hi(), c3.hi()],
            position: Vector3::from(p),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;
    use num::Rng;
    use platform::manipulator::{Leg, Manipulator, SquaredLegLengths};

    fn problem() -> (Manipulator, SquaredLegLengths, GenericProblem) {
        let mut rng = Rng::new(17);
        let legs = std::array::from_fn(|_| {
            let mut p = || Point3::from(Vector3::from_fn(|_, _| rng.uniform(-2.0, 2.0)));
            Leg { base: p(), platform: p() }
        });
        let m = Manipulator::from_legs(legs).unwrap();
        let s = SquaredLegLengths::try_new([1.4, 0.8, 2.6, 1.9, 0.6, 2.2]).unwrap();
        let problem = GenericProblem::draw(&m, &s, &mut rng);
        (m, s, problem)
    }

    #[test]
    fn the_determinant_has_degree_forty_and_its_roots_are_poses() {
        let (m, s, problem) = problem();
        let eliminant = Eliminant::of(&problem).unwrap();
        assert!(eliminant.excess < 1e-24, "{}", eliminant.excess);
        let c = eliminant.coefficients();
        assert_eq!(c.len(), 41);
        assert!(c[40].abs() > 1e3 * eliminant.excess * c.iter().map(|x| x.abs()).fold(0.0, f64::max));
        let residuals = eliminant.poses(&problem).into_iter().map(|p| p.unwrap().residual(&m, &s));
        assert!(residuals.fold(0.0, f64::max) < 1e-6, "before any refinement");
    }

    #[test]
    fn a_determinant_of_another_degree_is_noticed() {
        let equations = ReducedEquations::of(&problem().2).unwrap();
        let wrong = Eliminant::with(equations, |c3, rows| rows[4].iter_mut().for_each(|z| *z = *z * c3));
        assert!(matches!(wrong, Err(SylvesterError::NotDegree40 { excess }) if excess > 1e-10));
    }
}
