//! Homogeneous polynomials in three variables: curves of a plane in the coordinates `(1, xi_1, xi_2)`.
//!
//! A curve is split into lines, conics and the rest; its singular points are found and classified.

use std::ops::{AddAssign, Mul, Sub};

use nalgebra::Matrix3;

use super::spectrum::{SAME, Spectrum, dot, least_squares, norm, orthonormal, real_roots, unit, without};
use num::Rng;
use num::linalg::LinalgError;
use num::small::symmetric_eigen3;

/// `sum c_ijk x0^i x1^j x2^k` with `i + j + k = degree`; `i` falls first, then `j`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct TernaryForm<T> {
    pub(super) degree: usize,
    pub(super) coefficients: Vec<T>,
}

/// A form with coefficients in doubles.
pub(super) type Form = TernaryForm<f64>;

/// Exponents in the order of the coefficients.
pub(super) fn exponents(degree: usize) -> impl Iterator<Item = [usize; 3]> {
    (0..=degree).rev().flat_map(move |i| (0..=degree - i).rev().map(move |j| [i, j, degree - i - j]))
}

/// Index of an exponent: `(degree - i)` rows of growing length come before, then `j` falls.
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

impl<T> TernaryForm<T>
where
    T: Clone + PartialEq + Default + From<i32> + AddAssign,
    for<'a> &'a T: Mul<&'a T, Output = T>,
{
    pub(super) fn zero(degree: usize) -> Self {
        Self { degree, coefficients: vec![T::default(); (degree + 1) * (degree + 2) / 2] }
    }

    pub(super) fn constant(c: T) -> Self {
        Self { degree: 0, coefficients: vec![c] }
    }

    pub(super) fn linear(c: &[T]) -> Self {
        Self { degree: 1, coefficients: c.to_vec() }
    }

    fn terms(&self) -> impl Iterator<Item = ([usize; 3], &T)> {
        let zero = T::default();
        exponents(self.degree).zip(&self.coefficients).filter(move |(_, c)| **c != zero)
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        let mut out = Self::zero(self.degree + other.degree);
        for (e, a) in self.terms() {
            for (f, b) in other.terms() {
                out.coefficients[index([e[0] + f[0], e[1] + f[1], e[2] + f[2]])] += a * b;
            }
        }
        out
    }

    /// Adds a multiple.
    pub(super) fn add_scaled(&mut self, other: &Self, factor: &T) {
        self.coefficients.iter_mut().zip(&other.coefficients).for_each(|(a, b)| *a += factor * b);
    }

    pub(super) fn gradient(&self) -> [Self; 3] {
        [0, 1, 2].map(|variable| {
            let mut out = Self::zero(self.degree.saturating_sub(1));
            for (mut e, c) in self.terms().filter(|(e, _)| e[variable] > 0) {
                let factor = T::from(i32::try_from(e[variable]).unwrap_or(i32::MAX));
                e[variable] -= 1;
                out.coefficients[index(e)] += &factor * c;
            }
            out
        })
    }

    /// Coefficients in `s` of the form at `p + s q`.
    pub(super) fn on_line(&self, p: &[T], q: &[T]) -> Vec<T> {
        let mut out = vec![T::default(); self.degree + 1];
        for (e, c) in self.terms() {
            let mut term = vec![c.clone()];
            for (k, n) in e.iter().enumerate() {
                for _ in 0..*n {
                    let mut next = vec![T::default(); term.len() + 1];
                    for (i, t) in term.iter().enumerate() {
                        next[i] += t * &p[k];
                        next[i + 1] += t * &q[k];
                    }
                    term = next;
                }
            }
            out.iter_mut().zip(term).for_each(|(o, t)| *o += t);
        }
        out
    }

    /// Coefficients of the products with all monomials of a degree.
    pub(super) fn shifts(&self, degree: usize) -> Vec<Vec<T>> {
        let shifted = |e: [usize; 3]| {
            let mut monomial = Self::zero(degree);
            monomial.coefficients[index(e)] = T::from(1);
            self.times(&monomial).coefficients
        };
        exponents(degree).map(shifted).collect()
    }

    /// Determinant of a square matrix of forms of one degree, by expansion along the first row.
    pub(super) fn determinant(matrix: &[Vec<Self>]) -> Self {
        let mut out: Option<Self> = None;
        for k in 0..matrix.len() {
            let without = |row: &Vec<Self>| [&row[..k], &row[k + 1..]].concat();
            let minor: Vec<Vec<Self>> = matrix[1..].iter().map(without).collect();
            let cofactor = Self::determinant(&minor);
            let term = if minor.is_empty() { matrix[0][k].clone() } else { matrix[0][k].times(&cofactor) };
            match &mut out {
                // the first term has the sign plus
                None => out = Some(term),
                Some(out) => out.add_scaled(&term, &T::from(if k % 2 == 0 { 1 } else { -1 })),
            }
        }
        out.unwrap_or_else(|| Self::constant(T::from(1)))
    }
}

/// Cross product of two vectors of length three.
pub(super) fn cross<T: Sub<Output = T>>(a: &[T], b: &[T]) -> [T; 3]
where
    for<'a> &'a T: Mul<&'a T, Output = T>,
{
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &a[i] * &b[j] - &a[j] * &b[i])
}

impl Form {
    pub(super) fn value(&self, x: &[f64]) -> f64 {
        let terms = exponents(self.degree).zip(&self.coefficients);
        terms.map(|(e, c)| c * power(x[0], e[0]) * power(x[1], e[1]) * power(x[2], e[2])).sum()
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

    /// Norm of the form on a line (given as a linear form) over its own norm: zero if it contains the line.
    fn residual_on_line(&self, line: &[f64]) -> f64 {
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
        let columns = divisor.shifts(degree);
        let (coefficients, rest) = least_squares(&columns, &self.coefficients)?;
        Ok((Self { degree, coefficients }, rest))
    }
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

/// The greatest common divisor of two forms of equal degree, with the singular values on either side of the decision.
///
/// `g f1 = h f2` has a solution with `deg g = deg h = e` exactly if the divisor has at least degree `deg f - e`.
pub(super) fn common_factor(
    f1: &Form,
    f2: &Form,
    tolerance: f64,
) -> Result<(Form, Option<f64>, Option<f64>), LinalgError> {
    let (f1, f2) = (f1.normalised(), f2.normalised());
    let mut above = None;
    for e in 0..f1.degree {
        let mut columns = f1.shifts(e);
        columns.extend(f2.shifts(e));
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

/// The determinant of `order` random combinations of rows and columns of a matrix of linear forms: a general
/// combination of its minors of that order.
pub(super) fn random_minor(m: &[Vec<Form>], order: usize, rng: &mut Rng) -> Form {
    let (height, width) = (m.len(), m.first().map_or(0, Vec::len));
    let left: Vec<Vec<f64>> = (0..order).map(|_| random_vector(rng, height)).collect();
    let right: Vec<Vec<f64>> = (0..order).map(|_| random_vector(rng, width)).collect();
    let entry = |l: &Vec<f64>, r: &Vec<f64>| {
        let mut sum = Form::zero(1);
        for (row, x) in m.iter().zip(l) {
            for (f, y) in row.iter().zip(r) {
                sum.add_scaled(f, &(x * y));
            }
        }
        sum
    };
    let rows: Vec<Vec<Form>> = left.iter().map(|l| right.iter().map(|r| entry(l, r)).collect()).collect();
    Form::determinant(&rows)
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

/// A part of a plane curve that is irreducible over the reals.
#[derive(Debug, Clone)]
pub(super) struct RealPart {
    pub(super) form: Form,
    pub(super) kind: PartKind,
    /// Its multiplicity.
    pub(super) multiplicity: usize,
    /// Residual of the curve on the line, or the eigenvalue ratio of the conic nearest to a decision.
    pub(super) measure: f64,
}

num::words! {
    /// Kinds of parts.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[non_exhaustive]
    pub enum PartKind as name {
        /// A real line.
        Line = "line",
        /// A conic with real points.
        Conic = "conic",
        /// A conic without real points.
        EmptyConic = "conic_without_real_points",
        /// Two conjugate complex lines: one real point.
        ComplexLines = "conjugate_lines",
        /// A cubic that contains no real line.
        Cubic = "cubic",
        /// A curve of higher degree that contains no real line.
        Higher = "higher",
    }
}

#[cfg(feature = "serde")]
num::written_as_word!(PartKind);

/// A curve in parts.
#[derive(Debug, Clone, Default)]
pub(super) struct SplitCurve {
    pub(super) parts: Vec<RealPart>,
    /// The smallest residual of a rejected line.
    pub(super) rejected: Option<f64>,
}

/// Splits a form into real lines, conics and the rest. Lines through two of the known `points` on it are tried first,
/// since they are the most accurate.
pub(super) fn split(
    form: &Form,
    points: &[Vec<f64>],
    tolerance: f64,
    rng: &mut Rng,
) -> Result<SplitCurve, LinalgError> {
    let mut out = SplitCurve::default();
    let mut rest = form.normalised();
    while rest.degree > 0 {
        let (best, measure) = best_line(&rest, points, tolerance, rng)?;
        if rest.degree == 1 || measure <= tolerance {
            let line = if rest.degree == 1 { rest.clone() } else { Form::linear(&best) };
            push(
                &mut out,
                RealPart { form: line.normalised(), kind: PartKind::Line, multiplicity: 1, measure },
            );
            rest = rest.divided(&line)?.0.normalised();
            continue;
        }
        out.rejected = Some(out.rejected.map_or(measure, |r: f64| r.min(measure)));
        let (kind, measure) = match rest.degree {
            2 => conic_kind(&rest, tolerance),
            3 => (PartKind::Cubic, measure),
            _ => (PartKind::Higher, measure),
        };
        out.parts.push(RealPart { form: rest.clone(), kind, multiplicity: 1, measure });
        break;
    }
    Ok(out)
}

fn push(out: &mut SplitCurve, part: RealPart) {
    let same = |p: &&mut RealPart| {
        p.kind == PartKind::Line
            && norm(&cross(&unit(&p.form.coefficients), &unit(&part.form.coefficients))) < SAME
    };
    match out.parts.iter_mut().find(same) {
        Some(old) => old.multiplicity += 1,
        None => out.parts.push(part),
    }
}

/// The line with the smallest residual of the form. Candidates pass through two known points, or through intersections
/// with two random lines, which every line of the curve meets in two of them.
fn best_line(
    form: &Form,
    points: &[Vec<f64>],
    tolerance: f64,
    rng: &mut Rng,
) -> Result<(Vec<f64>, f64), LinalgError> {
    let mut best = (vec![1.0, 0.0, 0.0], f64::MAX);
    let consider = |best: &mut (Vec<f64>, f64), line: Vec<f64>| {
        if norm(&line) > 1e-9 {
            let residual = form.residual_on_line(&unit(&line));
            if residual < best.1 {
                *best = (unit(&line), residual);
            }
        }
    };
    for (k, p) in points.iter().enumerate() {
        for q in &points[..k] {
            consider(&mut best, cross(&unit(p), &unit(q)).to_vec());
        }
    }
    // a nearby, less accurate line must not replace a fitting line through two known points
    if best.1 <= tolerance {
        return Ok(best);
    }
    let mut sections: Vec<Vec<Vec<f64>>> = Vec::new();
    for _ in 0..2 {
        let [p, q] = line_basis(&random_vector(rng, 3));
        let roots = real_roots(&form.on_line(&p, &q))?;
        sections.push(roots.iter().map(|s| p.iter().zip(&q).map(|(x, y)| x + s * y).collect()).collect());
    }
    for p in &sections[0] {
        for q in &sections[1] {
            consider(&mut best, cross(&unit(p), &unit(q)).to_vec());
        }
    }
    Ok(best)
}

/// Eigenvalues, those of largest modulus first, and eigenvectors of the symmetric matrix of a conic.
fn eigen(form: &Form) -> Vec<(f64, Vec<f64>)> {
    let c = &form.coefficients;
    let (xy, xz, yz) = (c[1] / 2.0, c[2] / 2.0, c[4] / 2.0);
    let (values, vectors) = symmetric_eigen3(&Matrix3::new(c[0], xy, xz, xy, c[3], yz, xz, yz, c[5]));
    let vector = |k: usize| vectors.column(k).iter().copied().collect::<Vec<f64>>();
    let mut pairs: Vec<(f64, Vec<f64>)> = (0..3).map(|k| (values[k], vector(k))).collect();
    pairs.sort_by(|x, y| y.0.abs().total_cmp(&x.0.abs()));
    pairs
}

fn conic_kind(form: &Form, tolerance: f64) -> (PartKind, f64) {
    let e = eigen(form);
    let ratio = (e[2].0 / e[0].0).abs();
    if ratio <= tolerance {
        return (PartKind::ComplexLines, ratio);
    }
    let one_sign = e.iter().all(|x| x.0 > 0.0) || e.iter().all(|x| x.0 < 0.0);
    (if one_sign { PartKind::EmptyConic } else { PartKind::Conic }, ratio)
}

/// Columns `x, y, z` with the conic `{ (1 - t^2) x + 2 t y + (1 + t^2) z }`.
pub(super) fn conic_frame(form: &Form) -> [Vec<f64>; 3] {
    let e = eigen(form);
    let positive = e.iter().filter(|x| x.0 > 0.0).count();
    // the one eigenvalue of its sign belongs to z
    let alone = |x: &(f64, Vec<f64>)| if positive == 1 { x.0 > 0.0 } else { x.0 < 0.0 };
    let scale = |(value, v): &(f64, Vec<f64>)| v.iter().map(|c| c / value.abs().sqrt()).collect::<Vec<f64>>();
    let z = e.iter().find(|x| alone(x)).map(scale).unwrap_or_default();
    let mut others = e.iter().filter(|x| !alone(x)).map(scale);
    let x = others.next().unwrap_or_default();
    [x, others.next().unwrap_or_default(), z]
}

num::words! {
    /// The kind of a singular point of a curve.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[non_exhaustive]
    pub enum SingularKind as name {
        /// Two real branches cross.
        Crossing = "crossing",
        /// An isolated real point: two complex branches.
        Isolated = "isolated",
        /// The two branches share a tangent: a cusp, or touching parts.
        Cusp = "cusp",
        /// Three branches or a multiple part.
        Triple = "triple",
    }
}

#[cfg(feature = "serde")]
num::written_as_word!(SingularKind);

/// Kind of the singular point `p` of `form`, from the second derivatives along the tangent plane at `p`.
pub(super) fn singular_kind(form: &Form, p: &[f64]) -> SingularKind {
    let p = unit(p);
    let [u, v] = line_basis(&p);
    let second = |x: &[f64], y: &[f64]| -> f64 {
        let mut sum = 0.0;
        for (i, d) in form.gradient().iter().enumerate() {
            for (j, dd) in d.gradient().iter().enumerate() {
                sum += x[i] * y[j] * dd.value(&p);
            }
        }
        sum / form.norm()
    };
    let (a, b, c) = (second(&u, &u), second(&u, &v), second(&v, &v));
    let size = a.abs() + 2.0 * b.abs() + c.abs();
    let discriminant = b * b - a * c;
    if size < 1e-6 {
        SingularKind::Triple
    } else if discriminant.abs() < 1e-6 * size * size {
        SingularKind::Cusp
    } else if discriminant > 0.0 {
        SingularKind::Crossing
    } else {
        SingularKind::Isolated
    }
}

/// The real singular point of a form without real lines, with the size of the gradient there. Gauss-Newton steps on the
/// gradient from many starts find it; an irreducible cubic has at most one.
pub(super) fn singular_point(form: &Form, rng: &mut Rng) -> Result<(Vec<f64>, f64), LinalgError> {
    let f = form.normalised();
    let g = f.gradient();
    let hessian: Vec<[Form; 3]> = g.iter().map(Form::gradient).collect();
    let size = |x: &[f64]| g.iter().map(|d| d.value(x).powi(2)).sum::<f64>().sqrt();
    let mut best = (vec![1.0, 0.0, 0.0], f64::MAX);
    for _ in 0..24 {
        let mut x = random_vector(rng, 3);
        for _ in 0..60 {
            let rhs: Vec<f64> = g.iter().map(|d| -d.value(&x)).chain(std::iter::once(0.0)).collect();
            // three equations, and one that keeps the step across x
            let columns: Vec<Vec<f64>> = (0..3)
                .map(|k| hessian.iter().map(|h| h[k].value(&x)).chain(std::iter::once(x[k])).collect())
                .collect();
            let (mut step, _) = least_squares(&columns, &rhs)?;
            let length = norm(&step);
            if length > 0.3 {
                for s in &mut step {
                    *s *= 0.3 / length;
                }
            }
            x = unit(&x.iter().zip(&step).map(|(a, b)| a + b).collect::<Vec<f64>>());
            if length < 1e-15 {
                break;
            }
        }
        let value = size(&x);
        if value < best.1 {
            best = (x, value);
        }
    }
    Ok(best)
}

/// Intersections of a line with another part, on the line.
pub(super) fn on_line(line: &Form, other: &Form) -> Result<Vec<Vec<f64>>, LinalgError> {
    let [p, q] = line_basis(&line.coefficients);
    // a rotation of the two points avoids a root at the infinite end of the parameter
    let (sin, cos) = 0.7f64.sin_cos();
    let turned: Vec<f64> = p.iter().zip(&q).map(|(x, y)| cos * x + sin * y).collect();
    let across: Vec<f64> = p.iter().zip(&q).map(|(x, y)| cos * y - sin * x).collect();
    let roots = real_roots(&other.on_line(&turned, &across))?;
    Ok(roots
        .iter()
        .map(|s| unit(&turned.iter().zip(&across).map(|(x, y)| x + s * y).collect::<Vec<_>>()))
        .collect())
}

/// Whether two homogeneous points agree up to `limit`.
pub(super) fn same_point(p: &[f64], q: &[f64], limit: f64) -> bool {
    norm(&without(&unit(p), &[unit(q)])) < limit
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
