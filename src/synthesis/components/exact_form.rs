//! Plane curves with integer coefficients of any length, and their exact factors over the complex numbers.
//!
//! If a cubic consists of a line and an irreducible conic, every conjugation maps the line to itself, so its
//! coefficients are rational. A cubic without rational line is therefore irreducible over the complex numbers or
//! consists of three lines. It consists of lines exactly if it divides the determinant of its second derivatives.

use num_bigint::BigInt;

use super::form::{TernaryForm, cross, exponents, index};
use num::exact::{
    ExactVector, Rational, approximate, integer, kernel, primitive_integers, rank, rank_modulo, relations,
};
use num::poly::{IntPoly, real_roots};

/// A form with coefficients of any length.
pub(super) type ExactForm = TernaryForm<BigInt>;

/// Homogeneous coordinates in a plane.
pub(super) type Place = [BigInt; 3];

pub(super) fn rationals(list: &[BigInt]) -> ExactVector {
    list.iter().map(|x| Rational::from_integer(x.clone())).collect()
}

fn integer_relations(rows: &[Vec<BigInt>]) -> Vec<ExactVector> {
    relations(&rows.iter().map(|row| rationals(row)).collect::<Vec<_>>())
}

/// Bits of the longest number.
pub(super) fn bits(list: &[BigInt]) -> u64 {
    list.iter().map(BigInt::bits).max().unwrap_or(0)
}

impl ExactForm {
    pub(super) fn one() -> Self {
        Self::constant(1.into())
    }

    /// The multiple with coprime coefficients.
    pub(super) fn primitive(&self) -> Self {
        Self { degree: self.degree, coefficients: primitive_integers(&rationals(&self.coefficients)) }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.coefficients.iter().all(|c| *c == BigInt::ZERO)
    }

    pub(super) fn value(&self, p: &Place) -> BigInt {
        self.on_line(p, &[BigInt::ZERO; 3]).swap_remove(0)
    }

    /// Whether the form vanishes on a line, given as a linear form.
    pub(super) fn contains(&self, line: &Self) -> bool {
        let units: [Place; 3] = [0, 1, 2].map(|k| [0, 1, 2].map(|i| BigInt::from(i32::from(i == k))));
        let points: Vec<Place> = units.iter().map(|u| cross(&line.coefficients, u)).collect();
        // two of the line's three intersections with the coordinate axes differ
        let differ =
            |(i, j): &(usize, usize)| cross(&points[*i], &points[*j]).iter().any(|x| *x != BigInt::ZERO);
        let pair = [(0, 1), (0, 2), (1, 2)].into_iter().find(differ);
        pair.is_some_and(|(i, j)| self.on_line(&points[i], &points[j]).iter().all(|c| *c == BigInt::ZERO))
    }

    /// The quotient with coprime coefficients, if the divisor divides the form.
    pub(super) fn divided(&self, divisor: &Self) -> Option<Self> {
        let degree = self.degree.checked_sub(divisor.degree)?;
        let mut rows = divisor.shifts(degree);
        rows.push(self.coefficients.clone());
        // products of a form with the monomials are independent: one relation at most
        let mut relation = integer_relations(&rows).pop()?;
        relation.pop()?;
        Some(Self { degree, coefficients: primitive_integers(&relation) })
    }

    /// The greatest common divisor of two nonzero forms; `None` if elimination needs numbers of more than `longest`
    /// bits.
    ///
    /// `g self = h other` has a solution with `deg h = deg self - k` exactly if the divisor has at least degree `k`.
    /// Full rank of the products modulo a prime excludes a solution without long numbers.
    pub(super) fn common_factor(&self, other: &Self, longest: u64) -> Option<Self> {
        for k in (1..=self.degree.min(other.degree)).rev() {
            let (g, h) = (other.degree - k, self.degree - k);
            let mut rows = self.shifts(g);
            let first = rows.len();
            rows.extend(other.shifts(h));
            if rank_modulo(&rows) == rows.len() {
                continue;
            }
            if bits(&self.coefficients).max(bits(&other.coefficients)) > longest {
                return None;
            }
            let Some(relation) = integer_relations(&rows).pop() else { continue };
            let cofactor = Self { degree: h, coefficients: primitive_integers(&relation[first..]) };
            if let Some(divisor) = self.divided(&cofactor) {
                return Some(divisor);
            }
        }
        Some(Self::one())
    }

    /// The coefficients as doubles, the largest of modulus 1.
    pub(super) fn approximate(&self) -> Vec<f64> {
        let Some(most) =
            self.coefficients.iter().max_by_key(|c| c.magnitude()).filter(|c| **c != BigInt::ZERO)
        else {
            return vec![0.0; self.coefficients.len()];
        };
        self.coefficients.iter().map(|c| approximate(&Rational::new(c.clone(), most.clone()))).collect()
    }
}

/// The products of the partial derivatives with the monomials of degree `2 deg - 4` (for a cubic: 18 quartics).
fn jacobian_products(form: &ExactForm) -> Vec<Vec<BigInt>> {
    form.gradient().iter().flat_map(|d| d.shifts((2 * form.degree).saturating_sub(4))).collect()
}

/// Whether two lists are proportional (the zero list is proportional to every list).
fn proportional(a: &[BigInt], b: &[BigInt]) -> bool {
    let Some(k) = a.iter().position(|x| *x != BigInt::ZERO) else { return true };
    a.iter().zip(b).all(|(x, y)| x * &b[k] == y * &a[k])
}

/// Bits of a coefficient up to which long eliminations are done.
const LONG: u64 = 1000;

/// The kind of a part of an exact curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ExactKind {
    /// A line with rational coefficients.
    Line,
    /// Two real lines, conjugate over a real quadratic field.
    RealLines,
    /// Two complex conjugate lines with one real point.
    ComplexLines,
    /// Three lines, conjugate over a cubic field.
    ThreeLines {
        /// Number of real ones: 1 or 3.
        real: usize,
    },
    /// A conic with real points, irreducible over the complex numbers.
    Conic,
    /// A conic without real points, irreducible over the complex numbers.
    EmptyConic,
    /// A cubic that is irreducible over the complex numbers.
    Cubic,
    /// A curve without rational lines, of a degree that this module cannot decide.
    Undecided,
}

#[cfg(feature = "serde")]
num::written_as_word!(ExactKind);

impl ExactKind {
    /// Every kind.
    pub const ALL: [Self; 9] = [
        Self::Line,
        Self::RealLines,
        Self::ComplexLines,
        Self::ThreeLines { real: 3 },
        Self::ThreeLines { real: 1 },
        Self::Conic,
        Self::EmptyConic,
        Self::Cubic,
        Self::Undecided,
    ];

    /// The name used in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Line => "line",
            Self::RealLines => "two_conjugate_real_lines",
            Self::ComplexLines => "two_conjugate_complex_lines",
            Self::ThreeLines { real: 3 } => "three_conjugate_real_lines",
            Self::ThreeLines { .. } => "three_conjugate_lines_one_real",
            Self::Conic => "conic",
            Self::EmptyConic => "conic_without_real_points",
            Self::Cubic => "cubic",
            Self::Undecided => "undecided",
        }
    }
}

/// A part that is irreducible over the rational numbers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct RationalPart {
    pub(super) kind: ExactKind,
    pub(super) form: ExactForm,
    pub(super) multiplicity: usize,
}

/// The kind of the real singular point of an irreducible cubic; the point is rational.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum CubicPoint {
    /// No singular point over the complex numbers.
    None,
    /// Two real branches cross, or two complex ones (`isolated`), or the branches share a tangent (`cusp`).
    At { coordinates: Place, cusp: bool, isolated: bool },
    /// The coefficients are too long.
    TooLong,
}

/// All parts. `lines` are tried first.
pub(super) fn split(form: &ExactForm, lines: &[ExactForm]) -> Vec<RationalPart> {
    let mut parts: Vec<RationalPart> = Vec::new();
    let mut rest = form.primitive();
    while rest.degree > 0 && !rest.is_zero() {
        let kind = match rest.degree {
            1 => ExactKind::Line,
            2 => conic_kind(&rest),
            3 if is_smooth(&rest) => ExactKind::Cubic,
            _ => match rational_line(&rest, lines) {
                Some(_) => ExactKind::Line,
                None if rest.degree == 3 => cubic_kind(&rest),
                None => ExactKind::Undecided,
            },
        };
        let line =
            (kind == ExactKind::Line && rest.degree > 1).then(|| rational_line(&rest, lines)).flatten();
        let Some(line) = line else {
            push(&mut parts, kind, rest);
            break;
        };
        rest = rest.divided(&line).unwrap_or_else(ExactForm::one);
        push(&mut parts, ExactKind::Line, line);
    }
    parts
}

fn push(parts: &mut Vec<RationalPart>, kind: ExactKind, form: ExactForm) {
    match parts.iter_mut().find(|p| p.form == form) {
        Some(same) => same.multiplicity += 1,
        None => parts.push(RationalPart { kind, form, multiplicity: 1 }),
    }
}

/// A line with rational coefficients that divides the form: one of `lines`, or a line through rational points on two
/// given lines.
fn rational_line(form: &ExactForm, lines: &[ExactForm]) -> Option<ExactForm> {
    if let Some(found) = lines.iter().find(|l| form.contains(l)) {
        return Some(found.clone());
    }
    // a line that divides the form meets three lines that do not in rational points; if the three are not concurrent,
    // two points differ
    let mut sections: Vec<(Place, Vec<Place>)> = Vec::new();
    for (p, q) in transversals() {
        let binary = form.on_line(&p, &q);
        let across = cross(&p, &q);
        let concurrent = match sections.as_slice() {
            [first, second] => dot(&across, &cross(&first.0, &second.0)) == BigInt::ZERO,
            [first] => proportional(&across, &first.0),
            _ => false,
        };
        // no root at infinity; a transversal in the curve also has no leading coefficient
        if concurrent || binary[form.degree] == BigInt::ZERO {
            continue;
        }
        let at = |(n, d): &(BigInt, BigInt)| [0, 1, 2].map(|i| d * &p[i] + n * &q[i]);
        let points: Vec<Place> = rational_roots(&binary).iter().map(at).collect();
        if points.is_empty() {
            return None;
        }
        sections.push((across, points));
        if sections.len() == 3 {
            break;
        }
    }
    let [first, second, third] = <[_; 3]>::try_from(sections).ok()?;
    let others = second.1.iter().chain(&third.1);
    let pairs = others.flat_map(|q| first.1.iter().map(move |p| (p, q)));
    pairs
        .filter(|(p, q)| !proportional(*p, *q))
        .map(|(p, q)| ExactForm { degree: 1, coefficients: cross(p, q).to_vec() }.primitive())
        .find(|line| form.contains(line))
}

fn dot(a: &Place, b: &Place) -> BigInt {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Lines, each by two points; the second points are a grid on which no form of degree 4 vanishes.
fn transversals() -> impl Iterator<Item = (Place, Place)> {
    (0..49i64).map(|k| ([2, 2 * k + 1, k * k + 3].map(BigInt::from), [1, k % 7, k / 7].map(BigInt::from)))
}

/// Rational roots of a polynomial, each once, as numerator and denominator: a root times the leading coefficient is an
/// integer.
fn rational_roots(c: &[BigInt]) -> Vec<(BigInt, BigInt)> {
    let polynomial = IntPoly::new(c.to_vec()).primitive();
    let leading = polynomial.leading();
    let width = leading.bits().cast_signed() + 2;
    let mut out = Vec::new();
    for mut root in real_roots(&polynomial) {
        root.refine_to_width(-width);
        let middle = root.low().midpoint(root.high());
        // floor(2 leading middle + 1) / 2: the nearest integer
        let twice = middle.mantissa() * &leading * 2;
        let e = middle.exponent();
        let twice: BigInt = if e < 0 { twice >> e.unsigned_abs() } else { twice << e.unsigned_abs() };
        let numerator: BigInt = (twice + 1) >> 1u32;
        // sum c_k n^k d^(n - k)
        let mut value = BigInt::ZERO;
        let mut power = BigInt::from(1);
        for c in polynomial.coefficients().iter().rev() {
            value = value * &numerator + c * &power;
            power *= &leading;
        }
        if value == BigInt::ZERO {
            out.push((numerator, leading.clone()));
        }
    }
    out
}

/// The symmetric matrix of a quadratic form, twice.
fn symmetric(form: &ExactForm) -> [Place; 3] {
    let gradient = form.gradient();
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| gradient[i].coefficients[j].clone()))
}

fn principal_minors(m: &[Place; 3]) -> [BigInt; 3] {
    [(0, 1), (0, 2), (1, 2)].map(|(i, j)| &m[i][i] * &m[j][j] - &m[i][j] * &m[j][i])
}

fn conic_kind(form: &ExactForm) -> ExactKind {
    let m = symmetric(form);
    let minors = principal_minors(&m);
    let whole = dot(&m[0], &cross(&m[1], &m[2]));
    if whole != BigInt::ZERO {
        // definite: all principal minors of order 2 are positive, and the diagonal has the sign of the determinant
        let definite = minors.iter().all(|x| *x > BigInt::ZERO) && &m[0][0] * &whole > BigInt::ZERO;
        return if definite { ExactKind::EmptyConic } else { ExactKind::Conic };
    }
    match minors.into_iter().find(|x| *x != BigInt::ZERO).map(|d| -d) {
        // rank 1: a double line
        None => ExactKind::Line,
        Some(d) if d < BigInt::ZERO => ExactKind::ComplexLines,
        Some(d) if d.sqrt().pow(2) == d => ExactKind::Line,
        Some(_) => ExactKind::RealLines,
    }
}

/// Whether the cubic is proved to be smooth over the complex numbers, modulo a prime; `false` proves nothing.
///
/// The partial derivatives are three quadrics. They have no common zero exactly if their products with the six
/// monomials of degree 2 span all 15 forms of degree 4. (Macaulay 1902: a regular sequence of three quadrics contains
/// all forms of degree 4.) Full rank modulo a prime implies full rank over the rationals.
fn is_smooth(form: &ExactForm) -> bool {
    form.degree == 3 && rank_modulo(&jacobian_products(form)) == 15
}

/// A cubic without rational lines.
fn cubic_kind(form: &ExactForm) -> ExactKind {
    let rows: Vec<Vec<ExactForm>> = form.gradient().iter().map(|d| d.gradient().to_vec()).collect();
    let hessian = ExactForm::determinant(&rows);
    if !proportional(&hessian.coefficients, &form.coefficients) {
        return ExactKind::Cubic;
    }
    // a line meets three lines in as many real points as there are real lines, unless it passes an intersection
    let discriminant = transversals().find_map(|(p, q)| {
        let d = cubic_discriminant(&form.on_line(&p, &q));
        (d != BigInt::ZERO).then_some(d)
    });
    let three = discriminant.is_some_and(|d| d > BigInt::ZERO);
    ExactKind::ThreeLines { real: if three { 3 } else { 1 } }
}

fn cubic_discriminant(c: &[BigInt]) -> BigInt {
    let [d, c, b, a] = [0, 1, 2, 3].map(|k| &c[k]);
    b * b * c * c - a * c * c * c * 4 - b * b * b * d * 4 - a * a * d * d * 27 + a * b * c * d * 18
}

/// The singular point of an irreducible cubic over the complex numbers: at most one, hence rational.
///
/// The forms of degree 4 modulo the derivatives have dimension 1 at a node and 2 at a cusp. Multiplication with
/// `x_k / l` on them has the single eigenvalue `p_k / l(p)`.
pub(super) fn cubic_point(form: &ExactForm) -> CubicPoint {
    if is_smooth(form) {
        return CubicPoint::None;
    }
    if bits(&form.coefficients) > LONG {
        return CubicPoint::TooLong;
    }
    let products: Vec<ExactVector> = jacobian_products(form).iter().map(|row| rationals(row)).collect();
    let dual = kernel(&products);
    if dual.is_empty() {
        return CubicPoint::None;
    }
    // five lines, no three through one point: the point is on two at most
    let Some(point) = (0..5).find_map(|k| eigenvalues(&dual, [1, k, k * k])) else {
        return CubicPoint::TooLong;
    };
    let coordinates: Place = point;
    let second = form.gradient().each_ref().map(|d| d.gradient().each_ref().map(|x| x.value(&coordinates)));
    // rank 2 with the point in its kernel: the sum of the principal minors has the sign of the product of the two
    // eigenvalues
    let sum: BigInt = principal_minors(&second).iter().sum();
    CubicPoint::At { coordinates, cusp: sum == BigInt::ZERO, isolated: sum > BigInt::ZERO }
}

/// The point from the functionals on quartics that vanish on the products of the derivatives; `None` where `l` vanishes
/// at it.
fn eigenvalues(dual: &[ExactVector], l: [i32; 3]) -> Option<Place> {
    // functionals on cubics, by multiplication with a linear form
    let times = |d: &ExactVector, l: [i32; 3]| -> ExactVector {
        let at = |e: [usize; 3], k: usize| {
            let mut up = e;
            up[k] += 1;
            &d[index(up)] * Rational::from_integer(l[k].into())
        };
        exponents(3).map(|e| (0..3).map(|k| at(e, k)).sum()).collect()
    };
    let with_l: Vec<ExactVector> = dual.iter().map(|d| times(d, l)).collect();
    if rank(&with_l) < dual.len() {
        return None;
    }
    let mut traces = [0; 3].map(integer);
    for (k, trace) in traces.iter_mut().enumerate() {
        for (i, d) in dual.iter().enumerate() {
            let mut rows = with_l.clone();
            rows.push(times(d, [0, 1, 2].map(|j| i32::from(j == k))));
            // x_k d_i = sum_j n_ij l d_j
            let mut relation = relations(&rows).pop()?;
            let own = -relation.pop()?;
            *trace += &relation[i] / &own;
        }
    }
    primitive_integers(&traces).try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn form(degree: usize, c: &[i64]) -> ExactForm {
        ExactForm { degree, coefficients: c.iter().map(|x| BigInt::from(*x)).collect() }
    }

    #[test]
    fn products_divide_and_share_their_factors() {
        let (line, conic) = (form(1, &[3, -2, 5]), form(2, &[1, 0, -4, 2, 7, -1]));
        let other = form(2, &[0, 1, 1, -3, 0, 2]);
        let (f, g) = (line.times(&conic), line.times(&other));
        assert_eq!(f.divided(&line), Some(conic.clone()));
        assert_eq!(f.divided(&other), None);
        assert!(f.contains(&line) && !conic.contains(&line) && !f.contains(&form(1, &[3, -2, 6])));
        assert!(form(1, &[0, 0, 2]).contains(&form(1, &[0, 0, 1])));
        assert_eq!(f.common_factor(&g, 100).as_ref(), Some(&line));
        assert_eq!(f.common_factor(&g, 1), None);
        assert_eq!(f.common_factor(&conic.times(&conic), 100).as_ref(), Some(&conic));
        assert_eq!(conic.common_factor(&other, 1).map(|c| c.degree), Some(0));
        let at = [2, 1, -1].map(BigInt::from);
        assert_eq!(f.value(&at), line.value(&at) * conic.value(&at));
        // Euler: sum x_k df/dx_k = 3 f
        let euler: BigInt = f.gradient().iter().zip(&at).map(|(d, x)| d.value(&at) * x).sum();
        assert_eq!(euler, f.value(&at) * 3);
        assert!(proportional(&f.coefficients, &f.times(&form(0, &[-7])).coefficients));
        assert!(!proportional(&f.coefficients, &g.coefficients));
    }

    #[test]
    fn the_rank_modulo_a_prime_is_that_of_integer_rows() {
        let rows = [[1, 2, 3], [4, 5, 6], [7, 8, -9]].map(|r| r.map(BigInt::from).to_vec());
        assert_eq!((rank_modulo(&rows), rank_modulo(&rows[..2])), (3, 2));
        let dependent = [[1, 2, -3], [-2, -4, 6]].map(|r| r.map(BigInt::from).to_vec());
        assert_eq!(rank_modulo(&dependent), 1);
    }

    fn kinds(f: &ExactForm) -> Vec<(ExactKind, usize)> {
        split(f, &[]).iter().map(|p| (p.kind, p.multiplicity)).collect()
    }

    // w^2, wx, wy, x^2, xy, y^2
    const CIRCLE: [i64; 6] = [-5, 0, 0, 1, 0, 1];
    const NOTHING: [i64; 6] = [5, 0, 0, 1, 0, 1];
    const REAL: [i64; 6] = [-2, 0, 0, 1, 0, 0];
    const COMPLEX: [i64; 6] = [0, 0, 0, 1, 0, 3];

    #[test]
    fn lines_and_conics_of_every_kind() {
        let (l, m) = (form(1, &[3, -2, 5]), form(1, &[1, 1, 7]));
        for (conic, kind) in [
            (CIRCLE, ExactKind::Conic),
            (NOTHING, ExactKind::EmptyConic),
            (REAL, ExactKind::RealLines),
            (COMPLEX, ExactKind::ComplexLines),
        ] {
            let conic = form(2, &conic);
            assert_eq!(kinds(&conic), [(kind, 1)]);
            assert_eq!(kinds(&l.times(&conic)), [(ExactKind::Line, 1), (kind, 1)]);
        }
        assert_eq!(kinds(&l.times(&l)), [(ExactKind::Line, 2)]);
        assert_eq!(kinds(&l.times(&l).times(&l)), [(ExactKind::Line, 3)]);
        assert_eq!(kinds(&l.times(&m).times(&l)).iter().map(|k| k.1).sum::<usize>(), 3);
        // a tangent line
        let tangent = form(1, &[-5, 1, 2]);
        assert_eq!(kinds(&tangent.times(&form(2, &CIRCLE))), [(ExactKind::Line, 1), (ExactKind::Conic, 1)]);
    }

    /// `w^3, w^2 x, w^2 y, w x^2, w x y, w y^2, x^3, x^2 y, x y^2, y^3`.
    #[test]
    fn cubics_of_every_kind() {
        // the norm of w + 2^(1/3) x + 4^(1/3) y; three lines through one point: x^3 - 3 x y^2 + y^3 has three real
        // roots
        let norm = form(3, &[1, 0, 0, 0, -6, 0, 2, 0, 0, 4]);
        assert_eq!(kinds(&norm), [(ExactKind::ThreeLines { real: 1 }, 1)]);
        let pencil = form(3, &[0, 0, 0, 0, 0, 0, 1, 0, -3, 1]);
        assert_eq!(kinds(&pencil), [(ExactKind::ThreeLines { real: 3 }, 1)]);
        // y^2 w = x^3 + ..: smooth, cusp, node, isolated point; moved to the point (1, 2, 3)
        let moved = |c: [i64; 10]| {
            let (w, x, y) = (form(1, &[1, 0, 0]), form(1, &[-2, 1, 0]), form(1, &[-3, 0, 1]));
            let mut out = ExactForm::zero(3);
            for (e, c) in exponents(3).zip(c) {
                let mut term = form(0, &[c]);
                for (v, n) in [&w, &x, &y].into_iter().zip(e) {
                    for _ in 0..n {
                        term = term.times(v);
                    }
                }
                out.add_scaled(&term, &BigInt::from(1));
            }
            out
        };
        let smooth = moved([1, 0, 0, 0, 0, -1, 1, 0, 0, 0]);
        assert_eq!((kinds(&smooth), cubic_point(&smooth)), (vec![(ExactKind::Cubic, 1)], CubicPoint::None));
        for (square, cusp, isolated) in [(0, true, false), (1, false, false), (-1, false, true)] {
            let f = moved([0, 0, 0, square, 0, -1, 1, 0, 0, 0]);
            assert_eq!(kinds(&f), [(ExactKind::Cubic, 1)]);
            let CubicPoint::At { coordinates: c, cusp: k, isolated: i } = cubic_point(&f) else { panic!() };
            assert_eq!((c, k, i), ([1, 2, 3].map(BigInt::from), cusp, isolated));
        }
    }
}
