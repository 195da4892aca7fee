//! Homogeneous polynomials in three variables: curves of a plane in the coordinates `(1, xi_1, xi_2)`.

use super::spectrum::{Spectrum, dot, least_squares, norm, orthonormal};
use crate::num::Rng;
use crate::num::linalg::LinalgError;

/// `sum c_ijk x0^i x1^j x2^k` with `i + j + k = degree`; `i` falls first, then `j`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Form {
    pub(super) degree: usize,
    pub(super) coefficients: Vec<f64>,
}

/// Exponents in the order of the coefficients.
pub(super) fn exponents(degree: usize) -> impl Iterator<Item = [usize; 3]> {
    (0..=degree).rev().flat_map(move |i| (0..=degree - i).rev().map(move |j| [i, j, degree - i - j]))
}

/// Place of an exponent: `(degree - i)` rows of growing length come before, then `j` falls.
pub(super) fn index(e: [usize; 3]) -> usize {
    let rest = e[1] + e[2];
    rest * (rest + 1) / 2 + e[2]
}

/// `x^n`.
pub(super) fn power(x: f64, n: usize) -> f64 {
    std::iter::repeat_n(x, n).product()
}

fn factorial(n: usize) -> f64 {
    (1..=n).map(|k| k as f64).product()
}

impl Form {
    pub(super) fn zero(degree: usize) -> Self {
        Self { degree, coefficients: vec![0.0; (degree + 1) * (degree + 2) / 2] }
    }

    pub(super) fn constant(c: f64) -> Self {
        Self { degree: 0, coefficients: vec![c] }
    }

    pub(super) fn linear(c: &[f64]) -> Self {
        Self { degree: 1, coefficients: c.to_vec() }
    }

    pub(super) fn value(&self, x: &[f64]) -> f64 {
        let terms = exponents(self.degree).zip(&self.coefficients);
        terms.map(|(e, c)| c * power(x[0], e[0]) * power(x[1], e[1]) * power(x[2], e[2])).sum()
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        let mut out = Self::zero(self.degree + other.degree);
        for (e, a) in exponents(self.degree).zip(&self.coefficients) {
            for (f, b) in exponents(other.degree).zip(&other.coefficients) {
                out.coefficients[index([e[0] + f[0], e[1] + f[1], e[2] + f[2]])] += a * b;
            }
        }
        out
    }

    pub(super) fn add_scaled(&mut self, other: &Self, factor: f64) {
        self.coefficients.iter_mut().zip(&other.coefficients).for_each(|(a, b)| *a += factor * b);
    }

    pub(super) fn derivative(&self, variable: usize) -> Self {
        let mut out = Self::zero(self.degree.saturating_sub(1));
        for (mut e, c) in exponents(self.degree).zip(&self.coefficients) {
            if e[variable] > 0 {
                let factor = e[variable] as f64;
                e[variable] -= 1;
                out.coefficients[index(e)] += factor * c;
            }
        }
        out
    }

    pub(super) fn gradient(&self) -> [Self; 3] {
        [0, 1, 2].map(|k| self.derivative(k))
    }

    /// The norm of Bombieri, which rotations of the three variables leave unchanged.
    pub(super) fn norm(&self) -> f64 {
        let weight =
            |e: [usize; 3]| factorial(e[0]) * factorial(e[1]) * factorial(e[2]) / factorial(self.degree);
        exponents(self.degree).zip(&self.coefficients).map(|(e, c)| weight(e) * c * c).sum::<f64>().sqrt()
    }

    /// The form of norm 1 whose largest coefficient is positive; zero stays zero.
    pub(super) fn normalised(&self) -> Self {
        let n = self.norm();
        if n <= 0.0 {
            return self.clone();
        }
        let largest = self.coefficients.iter().fold(0.0f64, |m, x| if x.abs() > m.abs() { *x } else { m });
        let factor = largest.signum() / n;
        Self { degree: self.degree, coefficients: self.coefficients.iter().map(|c| c * factor).collect() }
    }

    /// Coefficients in `s` of the form at `p + s q`.
    pub(super) fn on_line(&self, p: &[f64], q: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; self.degree + 1];
        for (e, c) in exponents(self.degree).zip(&self.coefficients) {
            let mut term = vec![*c];
            for (k, n) in e.iter().enumerate() {
                for _ in 0..*n {
                    term = convolve(&term, &[p[k], q[k]]);
                }
            }
            out.iter_mut().zip(term).for_each(|(o, t)| *o += t);
        }
        out
    }

    /// Norm of the form on a line (given by its linear form) over its own norm: zero when it contains the line.
    pub(super) fn residual_on_line(&self, line: &[f64]) -> f64 {
        let [p, q] = line_basis(line);
        let binary = self.on_line(&p, &q);
        let n = self.degree;
        let weight = |k: usize| factorial(k) * factorial(n - k) / factorial(n);
        let size = binary.iter().enumerate().map(|(k, c)| weight(k) * c * c).sum::<f64>().sqrt();
        size / self.norm()
    }

    /// The quotient by `divisor` in the sense of least squares, and the relative remainder.
    pub(super) fn divided(&self, divisor: &Self) -> Result<(Self, f64), LinalgError> {
        let degree = self.degree - divisor.degree;
        let columns: Vec<Vec<f64>> = shifts(divisor, degree);
        let (coefficients, rest) = least_squares(&columns, &self.coefficients)?;
        Ok((Self { degree, coefficients }, rest))
    }
}

/// Products of a form with all monomials of a degree.
fn shifts(form: &Form, degree: usize) -> Vec<Vec<f64>> {
    let monomial = |e: [usize; 3]| {
        let mut m = Form::zero(degree);
        m.coefficients[index(e)] = 1.0;
        form.times(&m).coefficients
    };
    exponents(degree).map(monomial).collect()
}

/// Product of two polynomials in one unknown.
pub(super) fn convolve(a: &[f64], b: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            out[i + j] += x * y;
        }
    }
    out
}

/// Cross product of two vectors of length three.
pub(super) fn cross(a: &[f64], b: &[f64]) -> Vec<f64> {
    vec![a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Two orthonormal points of a line.
pub(super) fn line_basis(line: &[f64]) -> [Vec<f64>; 2] {
    let units = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut all = vec![line.to_vec()];
    all.extend(units.map(|u| u.to_vec()));
    let mut basis = orthonormal(&all, 0.3);
    let q = basis.pop().unwrap_or_default();
    let p = if basis.len() > 1 { basis.swap_remove(1) } else { Vec::new() };
    [p, q]
}

/// Determinant of a square matrix of forms of one degree.
pub(super) fn determinant(matrix: &[Vec<Form>]) -> Form {
    let add = |out: &mut Form, term: &Form, sign: i32| out.add_scaled(term, f64::from(sign));
    laplace(matrix, &Form::times, &add).unwrap_or_else(|| Form::constant(1.0))
}

/// Determinant by expansion along the first row; `add` adds a term or subtracts it. `None` for no rows.
pub(super) fn laplace<F: Clone>(
    matrix: &[Vec<F>],
    times: &impl Fn(&F, &F) -> F,
    add: &impl Fn(&mut F, &F, i32),
) -> Option<F> {
    if matrix.len() == 1 {
        return Some(matrix[0][0].clone());
    }
    let mut out: Option<F> = None;
    for k in 0..matrix.len() {
        let minor: Vec<Vec<F>> = matrix[1..]
            .iter()
            .map(|row| row.iter().enumerate().filter(|(j, _)| *j != k).map(|(_, f)| f.clone()).collect())
            .collect();
        let term = times(&matrix[0][k], &laplace(&minor, times, add)?);
        match &mut out {
            // the first term has the sign plus
            None => out = Some(term),
            Some(out) => add(out, &term, if k % 2 == 0 { 1 } else { -1 }),
        }
    }
    out
}

/// The greatest common divisor of two forms of equal degree, with the singular values on both sides of the decision.
///
/// `g f1 = h f2` has a solution with `deg g = deg h = e` exactly when the divisor has at least degree `deg f - e`.
pub(super) fn common_factor(
    f1: &Form,
    f2: &Form,
    tolerance: f64,
) -> Result<(Form, Option<f64>, Option<f64>), LinalgError> {
    let (f1, f2) = (f1.normalised(), f2.normalised());
    let mut above = None;
    for e in 0..f1.degree {
        let mut columns = shifts(&f1, e);
        columns.extend(shifts(&f2, e));
        let rows: Vec<Vec<f64>> =
            (0..columns[0].len()).map(|i| columns.iter().map(|c| c[i]).collect()).collect();
        let n = columns.len();
        let s = Spectrum::of(&rows, n)?;
        let relative = s.values[n - 1] / s.values[0];
        if relative <= tolerance {
            // -h is the second half; the divisor is f1 / h
            let h = Form { degree: e, coefficients: s.vectors[n - 1][n / 2..].to_vec() };
            return Ok((f1.divided(&h)?.0.normalised(), above, Some(relative)));
        }
        above = Some(relative);
    }
    Ok((Form::constant(1.0), above, None))
}

/// The determinant of `order` random combinations of rows and columns of a matrix of linear forms: a general combination of its minors of that order.
pub(super) fn random_minor(m: &[Vec<Form>], order: usize, rng: &mut Rng) -> Form {
    let (height, width) = (m.len(), m.first().map_or(0, Vec::len));
    let left: Vec<Vec<f64>> = (0..order).map(|_| random_vector(rng, height)).collect();
    let right: Vec<Vec<f64>> = (0..order).map(|_| random_vector(rng, width)).collect();
    let entry = |l: &Vec<f64>, r: &Vec<f64>| {
        let mut sum = Form::zero(1);
        for (row, x) in m.iter().zip(l) {
            for (f, y) in row.iter().zip(r) {
                sum.add_scaled(f, x * y);
            }
        }
        sum
    };
    let rows: Vec<Vec<Form>> = left.iter().map(|l| right.iter().map(|r| entry(l, r)).collect()).collect();
    determinant(&rows)
}

/// A form with random coefficients for tests and generic combinations.
pub(super) fn random_vector(rng: &mut Rng, n: usize) -> Vec<f64> {
    let v: Vec<f64> = (0..n).map(|_| rng.normal()).collect();
    let size = norm(&v);
    v.iter().map(|x| x / size).collect()
}

/// The value of a linear form.
pub(super) fn incidence(line: &[f64], point: &[f64]) -> f64 {
    dot(line, point) / (norm(line) * norm(point))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random_form(rng: &mut Rng, degree: usize) -> Form {
        Form { degree, coefficients: random_vector(rng, (degree + 1) * (degree + 2) / 2) }
    }

    #[test]
    fn order_of_the_monomials_and_ring_operations_agree_with_values() {
        for (k, e) in exponents(4).enumerate() {
            assert_eq!(index(e), k);
        }
        let mut rng = Rng::new(5);
        let (f, g) = (random_form(&mut rng, 2), random_form(&mut rng, 3));
        let x = [0.3, -1.2, 0.7];
        let h = f.times(&g);
        assert!((h.value(&x) - f.value(&x) * g.value(&x)).abs() < 1e-14);
        // Euler: sum x_k dh/dx_k = 5 h
        let euler: f64 = h.gradient().iter().zip(x).map(|(d, x)| d.value(&[0.3, -1.2, 0.7]) * x).sum();
        assert!((euler - 5.0 * h.value(&x)).abs() < 1e-13);
        let (q, rest) = h.divided(&f).unwrap();
        assert!(rest < 1e-13);
        assert!(q.coefficients.iter().zip(&g.coefficients).all(|(a, b)| (a - b).abs() < 1e-12));
        assert!(h.divided(&random_form(&mut rng, 2)).unwrap().1 > 1e-3);
        let (p, q) = ([1.0, 0.2, 0.4], [0.0, 1.0, -2.0]);
        let at: f64 = h.on_line(&p, &q).iter().enumerate().map(|(k, c)| c * power(0.6, k)).sum();
        assert!((at - h.value(&[1.0, 0.8, -0.8])).abs() < 1e-13);
    }

    #[test]
    fn common_factors_have_the_degree_they_were_given() {
        let mut rng = Rng::new(6);
        for degree in 0..=3 {
            let g = random_form(&mut rng, degree);
            let (f1, f2) =
                (g.times(&random_form(&mut rng, 3 - degree)), g.times(&random_form(&mut rng, 3 - degree)));
            let (found, above, below) = common_factor(&f1, &f2, 1e-9).unwrap();
            assert_eq!(found.degree, degree);
            assert!(below.is_none_or(|b| b < 1e-13) && above.is_none_or(|a| a > 1e-4), "{above:?} {below:?}");
            let (quotient, rest) = found.divided(&g).unwrap();
            assert!(degree == 0 || (rest < 1e-9 && quotient.degree == 0));
        }
    }

    #[test]
    fn a_line_of_a_product_is_seen_and_another_is_not() {
        let mut rng = Rng::new(7);
        let line = [0.4, 1.0, -0.3];
        let f = Form::linear(&line).times(&random_form(&mut rng, 2));
        assert!(f.residual_on_line(&line) < 1e-15);
        assert!(f.residual_on_line(&[0.4, 1.0, -0.30001]) > 1e-8);
    }
}
