//! The accuracy of a set of roots in the measure of Martyushev (2025), eqs. (18) and (19).

use num_complex::Complex64;

use fk::solve::generic_frame::{GenericProblem, RawCandidate};
use platform::geom::ComplexPose;
use platform::manipulator::{Manipulator, SquaredLegLengths};

const QUADRATICS: usize = 10;
/// Quadratic monomials times `1, t_1, t_2, t_3`, then squares of `e` times squares of `t`.
const MONOMIALS: usize = 4 * QUADRATICS + 12;

type Quadratic = [f64; QUADRATICS];

/// Place of `e_i e_j`, `i <= j`, among the quadratic monomials.
fn place(i: usize, j: usize) -> usize {
    let (i, j) = (i.min(j), i.max(j));
    [0, 4, 7, 9][i] + j - i
}

/// `e.e` and the entries of `(e.e) R` as quadratic forms.
fn forms() -> (Quadratic, [[Quadratic; 3]; 3]) {
    let form = |terms: &[(f64, usize, usize)]| {
        let mut q = [0.0; QUADRATICS];
        for (c, i, j) in terms {
            q[place(*i, *j)] += c;
        }
        q
    };
    let squares = |signs: [f64; 4]| form(&[0, 1, 2, 3].map(|i| (signs[i], i, i)));
    let pair = |i, j, sign: f64, k| form(&[(2.0, i, j), (2.0 * sign, 0, k)]);
    let r = [
        [squares([1.0, 1.0, -1.0, -1.0]), pair(1, 2, -1.0, 3), pair(1, 3, 1.0, 2)],
        [pair(1, 2, 1.0, 3), squares([1.0, -1.0, 1.0, -1.0]), pair(2, 3, -1.0, 1)],
        [pair(1, 3, -1.0, 2), pair(2, 3, 1.0, 1), squares([1.0, -1.0, -1.0, 1.0])],
    ];
    (squares([1.0; 4]), r)
}

/// Coefficients of the polynomials `f_1, .., f_6` of a problem, each divided by its norm.
fn normalised_rows(problem: &GenericProblem) -> [[f64; MONOMIALS]; 6] {
    let (n, r) = forms();
    std::array::from_fn(|i| {
        let mut row = [0.0; MONOMIALS];
        if i == 0 {
            // f_1 = |t|^2 - L_1 has no denominator: times e_0^2, which is 1 in Cayley coordinates
            row[place(0, 0)] = -problem.first;
            (0..3).for_each(|k| row[4 * QUADRATICS + k] = 1.0);
        } else {
            let (a, b) = (problem.base[i - 1], problem.platform[i - 1]);
            let constant = a.norm_squared() + b.norm_squared() - problem.others[i - 1];
            for q in 0..QUADRATICS {
                let turned = [0, 1, 2].map(|k| (0..3).map(|j| r[k][j][q] * b[j]).sum::<f64>());
                let base: f64 = (0..3).map(|k| a[k] * turned[k]).sum();
                row[q] = n[q] * constant - 2.0 * base;
                for k in 0..3 {
                    row[(k + 1) * QUADRATICS + q] = 2.0 * (turned[k] - n[q] * a[k]);
                }
            }
            (0..12).for_each(|k| row[4 * QUADRATICS + k] = 1.0);
        }
        let norm = row.iter().map(|x| x * x).sum::<f64>().sqrt();
        row.map(|x| x / norm)
    })
}

/// A quaternion of `R`, up to a factor: the row of `4 e e^T` (times a factor) with the largest diagonal entry.
fn quaternion(pose: &ComplexPose) -> [Complex64; 4] {
    let r = &pose.rotation;
    let one = Complex64::ONE;
    let trace = r[(0, 0)] + r[(1, 1)] + r[(2, 2)];
    let diagonal = |k: usize| one + r[(k, k)] * 2.0 - trace;
    let (x, y, z) = (r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]);
    let (xy, xz, yz) = (r[(0, 1)] + r[(1, 0)], r[(0, 2)] + r[(2, 0)], r[(1, 2)] + r[(2, 1)]);
    let rows = [
        [one + trace, x, y, z],
        [x, diagonal(0), xy, xz],
        [y, xy, diagonal(1), yz],
        [z, xz, yz, diagonal(2)],
    ];
    let best = (0..4).max_by(|&i, &j| rows[i][i].norm().total_cmp(&rows[j][j].norm())).unwrap_or(0);
    rows[best]
}

/// The polynomials of a problem in the form of eq. (18): the Macaulay matrix `M` with rows of norm one.
#[derive(Debug, Clone)]
pub(super) struct MacaulayMatrix {
    rows: [[f64; MONOMIALS]; 6],
    /// The support `U_F` (eqs. 2 and 3): monomials with a coefficient in some polynomial.
    occurs: [bool; MONOMIALS],
}

impl MacaulayMatrix {
    pub(super) fn of(problem: &GenericProblem) -> Self {
        let rows = normalised_rows(problem);
        Self { rows, occurs: std::array::from_fn(|k| rows.iter().any(|row| row[k] != 0.0)) }
    }

    /// `eps_i = |M z_i| / |z_i|`, eq. (18), infinite for candidates at infinity. `z_i` is the monomial vector in the
    /// Cayley vector and `t`. It is written homogeneously, so that it includes half turns.
    pub(super) fn residual(&self, candidate: &RawCandidate) -> f64 {
        let (e, t) = (&candidate.quaternion, &candidate.position);
        let mut z = [Complex64::ZERO; MONOMIALS];
        for (i, j) in (0..4).flat_map(|i| (i..4).map(move |j| (i, j))) {
            let q = e[i] * e[j];
            z[place(i, j)] = q;
            (0..3).for_each(|k| z[(k + 1) * QUADRATICS + place(i, j)] = q * t[k]);
        }
        for i in 0..4 {
            (0..3).for_each(|k| z[4 * QUADRATICS + 3 * i + k] = e[i] * e[i] * t[k] * t[k]);
        }
        let size: f64 =
            z.iter().zip(self.occurs).filter(|(_, occurs)| *occurs).map(|(z, _)| z.norm_sqr()).sum();
        let values = self.rows.iter().map(|row| row.iter().zip(&z).map(|(c, z)| z * c).sum::<Complex64>());
        let residual = (values.map(|v| v.norm_sqr()).sum::<f64>() / size).sqrt();
        if residual.is_finite() { residual } else { f64::INFINITY }
    }
}

/// `1/2 log10 sum_i eps_i^2`, eq. (19); `-inf` for no residuals.
pub(super) fn epsilon(residuals: impl Iterator<Item = f64>) -> f64 {
    0.5 * residuals.map(|e| e * e).sum::<f64>().log10()
}

/// The measure of Martyushev for a set of poses.
#[must_use]
pub fn error_metric(m: &Manipulator, s: &SquaredLegLengths, roots: &[ComplexPose]) -> f64 {
    let legs = m.legs();
    let lift = |v: nalgebra::Vector3<f64>| v.map(Complex64::from);
    let matrix = MacaulayMatrix::of(&GenericProblem::as_given(m, s));
    epsilon(roots.iter().map(|pose| {
        let position =
            pose.position + pose.rotation * lift(legs[0].platform.coords) - lift(legs[0].base.coords);
        matrix.residual(&RawCandidate { quaternion: quaternion(pose), position })
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{Class, LengthsFrom, problem};

    #[test]
    fn vanishes_at_a_root_and_grows_with_the_error() {
        for k in 0..20 {
            let p = problem(Class::General, LengthsFrom::Pose, 3, k).unwrap();
            let exact = ComplexPose::from(p.pose.unwrap());
            let mut wrong = exact;
            wrong.position.x += 1e-6;
            let at = |pose| error_metric(&p.manipulator, &p.squares, &[pose]);
            assert!(at(exact) < -14.5, "{k}: {}", at(exact));
            assert!((-8.5..-5.0).contains(&at(wrong)), "{k}: {}", at(wrong));
        }
    }

    /// The polynomials of a general platform have 46 monomials, as in the published code.
    #[test]
    fn the_support_is_that_of_the_published_code() {
        let p = problem(Class::General, LengthsFrom::Pose, 3, 0).unwrap();
        let matrix = MacaulayMatrix::of(&GenericProblem::as_given(&p.manipulator, &p.squares));
        assert_eq!(matrix.occurs.iter().filter(|occurs| **occurs).count(), 46);
    }
}
