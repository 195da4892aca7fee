//! All poses, real and complex, of a line held by five legs, from exact arithmetic.
//!
//! The squared lengths are linear in `(P, Q, p, v)` (see [`platform::pentapod`]), so that five independent legs leave
//! three unknowns `t`. `p.p = P`, `p.v = Q` and `v.v = d.d` are three quadrics in them, with at most eight common
//! zeros. A polynomial in one linear form of `t` solves them; its coefficients, and all other quantities, are rational
//! numbers. So nothing is found by iteration, and no zero can be missed.
//!
//! When the joints of the other body lie in a plane, the mirror in that plane takes poses to poses. Then a polynomial
//! of degree four, three or two in one unknown gives all pairs (Borras, Thomas 2009). Let `n` be the relation
//! `n_P + 2 mu n_Q - 2 a.n_p - 2 mu a.n_v = 0` that all joints satisfy.
//!
//! * The degree is four unless `n_p` and `n_v` are parallel.
//! * With `n_p = r n_v` it is three unless `n_v = 0` or `n_P = 2 r n_Q`.
//! * It is two in these cases. Borras, Thomas, Torras 2010 build such machines, in which `mu` is an affine function of
//!   `a`.

mod quotient;

use num_complex::Complex64;
use num_traits::{Signed, Zero};
use thiserror::Error;

use self::quotient::{ByOneForm, Quadric, Quotient};
use num::exact::{self, ExactVector, Rational, integer, kernel, nearest, primitive_integers, relations};
use num::poly::{ComplexRoot, IntPoly, complex_roots};
use platform::pentapod::{LINE_NUMBERS, LinearPentapod, RationalPoint, cross};

num::answer_words! {
    /// The equation that gives the poses of the line.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[non_exhaustive]
    pub enum LineClass as name {
        /// A quadratic equation, each root two mirror poses: joints of the other body in a plane.
        Quadratic = "quadratic",
        /// A cubic equation, each root two mirror poses: joints of the other body in a plane.
        Cubic = "cubic",
        /// A quartic equation, each root two mirror poses: joints of the other body in a plane.
        Quartic = "quartic",
        /// Three quadrics with up to eight poses: joints of the other body in no plane.
        Octic = "octic",
    }
}

impl LineClass {
    /// Poses of the line, real and complex, for generic lengths: no more than these for any.
    #[must_use]
    pub fn poses(self) -> usize {
        match self {
            Self::Quadratic => 4,
            Self::Cubic => 6,
            Self::Quartic | Self::Octic => 8,
        }
    }
}

/// Why there are no poses of the line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum NoLinePoses {
    /// One of the five lengths follows from the others, or contradicts them, whatever the pose is.
    #[error(
        "the five legs are dependent: one length follows from the others, so that they do not hold the line"
    )]
    Dependent,
    /// The poses of the line for these lengths were not seen to be finitely many.
    #[error("the poses of the line for these lengths were not found to be finitely many")]
    NotFinite,
    /// Poses lie upon each other, and no linear form tells the others apart.
    #[error("poses of the line for these lengths lie upon each other in more than one direction")]
    NotSeparated,
    /// A length is not finite or is negative.
    #[error("a leg length is negative or not a finite number")]
    Length,
}

/// A pose of the line in the frame of the other body.
#[derive(Debug, Clone, PartialEq)]
pub struct LinePose {
    /// The joint of leg 1.
    pub position: [Complex64; 3],
    /// The unit vector from the joint of leg 1 towards the one farthest from it.
    pub direction: [Complex64; 3],
    /// Whether all of them are real numbers: decided exactly.
    pub real: bool,
    /// Multiplicity of the pose.
    pub multiplicity: usize,
    /// No coordinate of the position is farther than this from its double, nor one of the direction, relative to 1.
    pub error: [f64; 2],
}

/// All poses of the line for given lengths.
#[derive(Debug, Clone, PartialEq)]
pub struct LinePoses {
    /// The poses, each counted as often as its multiplicity says: proved.
    pub counted: usize,
    /// The polynomial with integer coefficients whose roots are the values of one linear form at the poses.
    pub polynomial: IntPoly,
    /// The poses, the real ones first.
    pub poses: Vec<LinePose>,
}

/// Linear forms that are tried until one tells the poses apart.
const FORMS: [[i64; 3]; 4] = [[1, 3, 7], [5, -2, 3], [4, 9, -1], [-7, 11, 13]];
/// Bits of the roots beyond those of the coefficients.
const BITS: u64 = 128;

/// The equation that gives the poses of the line; `None` for dependent legs.
#[must_use]
pub fn line_class(p: &LinearPentapod) -> Option<LineClass> {
    let rows = p.rows();
    if !relations(&rows).is_empty() {
        return None;
    }
    if p.other_dimension() > 2 {
        return Some(LineClass::Octic);
    }
    let normal = normal(&p.others)?;
    // the plane of the joints is moved through the origin
    let first = p.others[0].clone();
    let moved = p.others.each_ref().map(|a| std::array::from_fn(|k| &a[k] - &first[k]));
    let moved = LinearPentapod { others: moved, ..p.clone() };
    let zeros = |count| vec![Rational::zero(); count];
    let mut equations = moved.rows().to_vec();
    equations.push([zeros(2), normal.to_vec(), zeros(3)].concat());
    equations.push([zeros(5), normal.to_vec()].concat());
    let [n] = <[ExactVector; 1]>::try_from(kernel(&equations)).ok()?;
    let (along, turning) = (&n[2..5], &n[5..8]);
    let crossed = |i: usize, j: usize| &along[i] * &turning[j] - &along[j] * &turning[i];
    if [(0, 1), (1, 2), (2, 0)].into_iter().any(|(i, j)| !crossed(i, j).is_zero()) {
        return Some(LineClass::Quartic);
    }
    let Some(k) = (0..3).find(|k| !turning[*k].is_zero()) else { return Some(LineClass::Quadratic) };
    let ratio = &along[k] / &turning[k];
    let cubic = &n[0] - integer(2) * ratio * &n[1];
    Some(if cubic.is_zero() { LineClass::Quadratic } else { LineClass::Cubic })
}

/// A normal of the plane of points that span one.
fn normal(points: &[RationalPoint; 5]) -> Option<RationalPoint> {
    let from_first = |i: usize| -> RationalPoint { std::array::from_fn(|k| &points[i][k] - &points[0][k]) };
    let pairs = (1..5).flat_map(|i| (i + 1..5).map(move |j| (i, j)));
    pairs.map(|(i, j)| cross(&from_first(i), &from_first(j))).find(|n| n.iter().any(|x| !x.is_zero()))
}

/// All poses of the line for these leg lengths.
///
/// # Errors
/// [`NoLinePoses`].
///
/// ```
/// # mod equipod { pub mod methods { pub use equipod_fk as fk; pub use platform::pentapod; } }
/// use equipod::methods::fk::{LineClass, line_class, line_poses};
/// use equipod::methods::pentapod::Pentapod;
/// let base = [[0., 0., 0.], [4., 0., 0.], [6., 3., 0.], [3., 6., 0.], [-1., 5., 0.]];
/// let platform = [0., 1., 3., 4., 6.].map(|x| [x, 0., 0.]);
/// let five = Pentapod::from_doubles(&base, &platform).and_then(|p| p.linear()).ok_or("no line")?;
/// assert_eq!(line_class(&five), Some(LineClass::Quartic));
/// let found = line_poses(&five, &[7.0, 6.0, 7.0, 6.0, 9.0])?;
/// assert_eq!(found.counted, 8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn line_poses(p: &LinearPentapod, lengths: &[f64; 5]) -> Result<LinePoses, NoLinePoses> {
    let squared = |l: &f64| exact::rational(*l).filter(|l| !l.is_negative()).map(|l| &l * &l);
    let squared: Option<ExactVector> = lengths.iter().map(squared).collect();
    of_squares(p, &squared.ok_or(NoLinePoses::Length)?)
}

/// The number of poses of the line, real and complex, for lengths that are drawn from the seed.
///
/// # Errors
/// [`NoLinePoses`].
pub fn count_line_poses(p: &LinearPentapod, seed: u64) -> Result<usize, NoLinePoses> {
    let mut rng = num::Rng::new(seed);
    let square = p.square();
    let squared: ExactVector =
        (0..5).map(|_| &square * integer(rng.uniform(1.0, 1000.0) as i64) / integer(16)).collect();
    Ok(quotient(p, &squared)?.1.zeros())
}

/// The eight numbers of the line as affine functions of three unknowns: value at zero, and a vector for each unknown.
struct Affine {
    at_zero: ExactVector,
    along: [ExactVector; 3],
}

fn quotient(p: &LinearPentapod, squared: &[Rational]) -> Result<(Affine, Quotient), NoLinePoses> {
    let rows = p.rows();
    if !relations(&rows).is_empty() {
        return Err(NoLinePoses::Dependent);
    }
    let along = kernel(&rows).iter().map(|x| exact::primitive(x)).collect::<Vec<_>>();
    let along: [ExactVector; 3] = along.try_into().map_err(|_| NoLinePoses::Dependent)?;
    // a solution of the inhomogeneous equations is one of the homogeneous ones in a ninth number, which is 1
    let constants = p.constants();
    let beside: Vec<ExactVector> = rows
        .iter()
        .zip(constants.iter().zip(squared))
        .map(|(row, (constant, s))| row.iter().cloned().chain([constant - s]).collect())
        .collect();
    let with_one = kernel(&beside);
    let whole = with_one.iter().find(|x| !x[LINE_NUMBERS].is_zero()).ok_or(NoLinePoses::Dependent)?;
    let at_zero = whole[..LINE_NUMBERS].iter().map(|x| x / &whole[LINE_NUMBERS]).collect();
    let affine = Affine { at_zero, along };
    let quotient = Quotient::of(&affine.quadrics(&p.square())).ok_or(NoLinePoses::NotFinite)?;
    Ok((affine, quotient))
}

impl Affine {
    /// `p.p - P`, `p.v - Q`, `v.v - d.d`.
    fn quadrics(&self, square: &Rational) -> [Quadric; 3] {
        let (p, v) = (2..5, 5..8);
        [
            self.quadric(p.clone(), p.clone(), |x| x[0].clone(), &Rational::zero()),
            self.quadric(p, v.clone(), |x| x[1].clone(), &Rational::zero()),
            self.quadric(v.clone(), v, |_| Rational::zero(), square),
        ]
    }

    fn quadric(
        &self,
        x: std::ops::Range<usize>,
        y: std::ops::Range<usize>,
        linear: impl Fn(&ExactVector) -> Rational,
        constant: &Rational,
    ) -> Quadric {
        let parts: Vec<(&ExactVector, Option<usize>)> = std::iter::once((&self.at_zero, None))
            .chain(self.along.iter().enumerate().map(|(k, part)| (part, Some(k))))
            .collect();
        let mut out = Quadric::new();
        let exponents = |factors: [Option<usize>; 2]| {
            let mut exponents = [0; 3];
            factors.into_iter().flatten().for_each(|k| exponents[k] += 1);
            exponents
        };
        for (f, i) in &parts {
            for (g, j) in &parts {
                let product = x.clone().zip(y.clone()).map(|(k, l)| &f[k] * &g[l]).sum();
                out.push((exponents([*i, *j]), product));
            }
            out.push((exponents([*i, None]), -linear(f)));
        }
        out.push(([0; 3], -constant.clone()));
        out
    }

    /// Each of the eight numbers as a polynomial in the value of the form.
    fn polynomials(&self, by: &ByOneForm) -> Vec<ExactVector> {
        let width = by.polynomial.len() - 1;
        let one = |k: usize| {
            let mut out = vec![Rational::zero(); width];
            out[0] = self.at_zero[k].clone();
            for (along, unknown) in self.along.iter().zip(&by.unknowns) {
                out.iter_mut().zip(unknown).for_each(|(x, c)| *x += &along[k] * c);
            }
            out
        };
        (0..LINE_NUMBERS).map(one).collect()
    }
}

fn of_squares(p: &LinearPentapod, squared: &[Rational]) -> Result<LinePoses, NoLinePoses> {
    let (affine, quotient) = quotient(p, squared)?;
    let counted = quotient.zeros();
    if counted == 0 {
        return Ok(LinePoses { counted, polynomial: IntPoly::from_i64(&[1]), poses: Vec::new() });
    }
    let by = FORMS.iter().find_map(|form| quotient.by(form)).ok_or(NoLinePoses::NotSeparated)?;
    let polynomials = affine.polynomials(&by);
    let polynomial = IntPoly::new(primitive_integers(&by.polynomial)).primitive();
    // a coefficient of so many bits loses as many of the root
    let size = |x: &Rational| x.numer().bits().saturating_sub(x.denom().bits());
    let bits = BITS + polynomials.iter().flatten().map(size).max().unwrap_or(0);
    let roots = complex_roots(&polynomial, bits).map_err(|_| NoLinePoses::NotSeparated)?;
    let mut poses: Vec<LinePose> = roots.iter().map(|root| pose(root, &polynomials, &p.square())).collect();
    poses.sort_by_key(|pose| !pose.real);
    Ok(LinePoses { counted, polynomial, poses })
}

/// A complex number with rational parts.
type ExactComplex = [Rational; 2];

/// The value of a polynomial, by Horner's rule.
fn value(polynomial: &[Rational], z: &ExactComplex) -> ExactComplex {
    polynomial.iter().rev().fold([Rational::zero(), Rational::zero()], |[re, im], c| {
        [&re * &z[0] - &im * &z[1] + c, re * &z[1] + im * &z[0]]
    })
}

/// The pose at one root: values at the centre of its disc, and how far they can be from those at the root.
fn pose(root: &ComplexRoot, polynomials: &[ExactVector], square: &Rational) -> LinePose {
    let z = [root.re.to_rational(), root.im.to_rational()];
    let values: Vec<ExactComplex> = polynomials.iter().map(|g| value(g, &z)).collect();
    let doubles = values.iter().map(|[re, im]| Complex64::new(nearest(re), nearest(im))).collect::<Vec<_>>();
    // |g(root) - g(centre)| <= r sum k |c_k| (|centre| + r)^(k - 1)
    let size = (root.to_complex64().norm() * (1.0 + 1e-12)).log2();
    let far = size.max(root.radius_log2) + 1.0;
    let drift = |g: &ExactVector| {
        let terms = g.iter().enumerate().skip(1).filter(|(_, c)| !c.is_zero());
        let logs = terms.map(|(k, c)| {
            let bits = c.numer().bits() as f64 - c.denom().bits() as f64 + 1.0;
            bits + (k as f64).log2() + (k as f64 - 1.0) * far
        });
        let most = logs.fold(f64::NEG_INFINITY, f64::max);
        (root.radius_log2 + most + 3.0).exp2()
    };
    let length = nearest(square).sqrt();
    let rounding = |z: &Complex64| f64::EPSILON * (z.re.abs() + z.im.abs());
    let error = |range: std::ops::Range<usize>| {
        range.map(|k| drift(&polynomials[k]) + rounding(&doubles[k])).fold(0.0, f64::max)
    };
    let at = |k: usize| [doubles[k], doubles[k + 1], doubles[k + 2]];
    let (along, turning) = (error(2..5), error(5..8));
    LinePose {
        position: at(2),
        direction: at(5).map(|x| x / length),
        real: root.is_real(),
        multiplicity: root.multiplicity,
        // the division by the length rounds as well
        error: [along, 2.0 * turning / length + 4.0 * f64::EPSILON],
    }
}

#[cfg(test)]
mod tests;
