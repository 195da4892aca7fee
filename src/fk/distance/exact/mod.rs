//! Computes closure polynomials exactly, in integers.
//!
//! Doubles are rational numbers: scaled by a power of two, joints and squared leg lengths are integers. Let `x` be the
//! squared length of the virtual leg. The closure condition of a trilateration sequence is an element of a tower of
//! square roots over `Q(x)`. Its norm to `Q(x)`, without the singular factors, is the closure polynomial. Every pose at
//! which no base of a step is singular has its `x` among the roots. Theory and figures:
//! `docs/theory/closure-polynomials.md`. Source: Porta, Thomas, sec. III.

mod strip;
#[cfg(test)]
mod tests;
mod tower;

use num_bigint::{BigInt, Sign};
use thiserror::Error;

use self::strip::{Strip, StripClosure};
use self::tower::{Divisor, ResiduePoly, Ring, STEPS};
use num::Rng;
use num::double_double::DoubleDouble;
use num::poly::{Dyadic, IntPoly, RealRoot, gcd, real_roots, squarefree_factors};
use platform::manipulator::{Manipulator, SquaredLegLengths};
use platform::topology::{JointIndex, Sequence};

/// Why there is no closure polynomial.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum ClosureError {
    /// The sequence has two or more virtual legs, or steps in an order that is not handled.
    #[error("the sequence has no closure in one unknown")]
    Unsupported,
    /// The base of a step is collinear whatever the unknown is.
    #[error("the base of step {} is collinear for every length of the virtual leg", step + 1)]
    Collinear {
        /// The unoriented step, from 0; 3 for the joints of the second body that the steps place.
        step: usize,
    },
    /// The closure holds for every length of the virtual leg: self-motions, or a sequence that does not suit the
    /// design.
    #[error("the closure polynomial vanishes identically")]
    Identity,
    /// The data need more binary places before or after the point than are allowed (600), or are not finite.
    #[error("the data need more than {} binary places", RANGE)]
    OutOfRange,
}

/// A factor of the closure condition that belongs to degenerate trilaterations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, schemars::JsonSchema),
    schemars(rename = "SingularFactorRecord")
)]
pub struct SingularFactor {
    /// Unoriented steps, from 0.
    // the base triangle of this step degenerates where the factor vanishes
    pub step: usize,
    /// Its degree.
    // of the norm of its numerator over the roots it contains, in the unknown; zero for a constant factor
    pub degree: usize,
    /// Number of removals.
    // how often this norm divides the polynomial that squaring out gives; zero for a constant factor
    pub removed: usize,
}

/// Degrees of the closure polynomial of a sequence, computed modulo `2^61 - 1`.
#[derive(Debug, Clone, PartialEq)]
pub struct ClosureDegrees {
    /// After clearing denominators and squaring out roots, nothing cancelled.
    pub before: usize,
    /// After removal of the singular factors.
    pub after: usize,
    /// Number of distinct roots.
    pub distinct: usize,
    /// The factors, one for each step the closure needs.
    pub factors: Vec<SingularFactor>,
    /// `e_t` with `P = N(f) prod_t N(A_t)^(e_t)` up to a constant. It is a fraction when `A_t` does not depend on some
    /// of the earlier steps, and zero for constant factors.
    ///
    /// * `f` is the closure (computed less known squared distance).
    /// * `A_t = -D(i, j, k)` belongs to the base of step `t`.
    /// * `N(f)` is the product over the signs of all roots of the closure (two to the number of `factors`).
    /// * `N(A_t)` is the product over the signs of the `t` earlier steps.
    pub exponents: Vec<f64>,
}

/// The closure polynomial of one problem.
#[derive(Debug, Clone)]
pub struct ClosurePolynomial {
    /// The two joints whose squared distance is the unknown: the virtual leg, or without one a pair that has no leg.
    pub unknown: [JointIndex; 2],
    /// The sequence it belongs to.
    pub sequence: Sequence,
    /// Primitive, in the unknown in design units squared.
    pub polynomial: IntPoly,
    /// Number of distinct complex roots.
    pub distinct: usize,
    /// The distinct real roots, isolated.
    pub real_roots: Vec<RealRoot>,
    /// No root is one of a singular factor, and the closure needs all three steps: there is a pose over every root.
    regular: bool,
    /// A positive multiple of the square of the height of the first joint placed over the plane of its base.
    height: IntPoly,
    /// Both bodies are planar.
    planar: bool,
}

impl ClosurePolynomial {
    /// The number of real poses over each of [`real_roots`](Self::real_roots), proved, when there are `poses` finite
    /// complex poses in all; `None` when it does not follow.
    ///
    /// There is a pose over every root at which no base is singular. So with as many distinct roots as poses there is
    /// one over each, and a pose over a real root is its own conjugate. With planar bodies and half as many roots there
    /// are a pose and its mirror image over each root. Both are real when the square of the height of the first joint
    /// over the base plane is positive; neither is when it is negative.
    #[must_use]
    pub fn real_poses(&self, poses: usize) -> Option<Vec<usize>> {
        if !self.regular {
            return None;
        }
        if self.distinct == poses {
            return Some(vec![1; self.real_roots.len()]);
        }
        let mirrored = self.planar && 2 * self.distinct == poses;
        if !mirrored || gcd(&self.polynomial, &self.height).degree() != Some(0) {
            return None;
        }
        let count = |r: &RealRoot| if r.sign_of(&self.height) == Sign::Plus { 2 } else { 0 };
        Some(self.real_roots.iter().map(count).collect())
    }
}

/// The closure polynomial of the sequence `s` of [`plans`](super::plans) for the squared lengths given, exactly.
///
/// Every double is taken as the rational number it is. The degree is that of the topology or less: lengths in special
/// position lower it. The unknown of a sequence without virtual leg is the squared distance of two joints without a
/// leg, chosen for most distinct roots.
///
/// # Errors
/// [`ClosureError`].
pub fn closure_polynomial(
    m: &Manipulator,
    squares: &SquaredLegLengths,
    s: &Sequence,
) -> Result<ClosurePolynomial, ClosureError> {
    let data = ExactData::new(m, squares)?;
    let closure = best_closure(&data, s)?;
    let found = reduced::<IntPoly>(&data, s, closure)?;
    // roots of the scaled problem are 4^scale times those in design units
    let polynomial = found.polynomial.stretched(-2 * data.scale).primitive();
    let coprime =
        |norm: &IntPoly| norm.degree() == Some(0) || gcd(&found.polynomial, norm).degree() == Some(0);
    let distinct = squarefree_factors(&polynomial).iter().filter_map(|f| f.factor.degree()).sum();
    Ok(ClosurePolynomial {
        unknown: found.unknown,
        sequence: s.clone(),
        distinct,
        real_roots: real_roots(&polynomial),
        regular: closure.steps >= STEPS && found.norms.iter().all(coprime),
        height: found.height.stretched(-2 * data.scale),
        planar: data.is_planar(),
        polynomial,
    })
}

/// Degrees for a random member of the topology of `legs` with the sequence `s`.
///
/// The member's joints and lengths are random integers. The degrees are computed modulo a prime of sixty-one bits. They
/// are those of almost all members, and wrong with a probability of about the degree over the prime.
///
/// # Errors
/// [`ClosureError`].
pub fn generic_degrees(
    legs: &[(usize, usize); 6],
    s: &Sequence,
    seed: u64,
) -> Result<ClosureDegrees, ClosureError> {
    degrees(&ExactData::random(legs, &mut Rng::new(seed)), s)
}

/// Degrees for a problem, see [`generic_degrees`]: the same computation on its own data.
///
/// # Errors
/// [`ClosureError`].
pub fn closure_degrees(
    m: &Manipulator,
    squares: &SquaredLegLengths,
    s: &Sequence,
) -> Result<ClosureDegrees, ClosureError> {
    degrees(&ExactData::new(m, squares)?, s)
}

/// The closure whose polynomial has most distinct roots, the first of equal ones; there is a choice without virtual leg
/// only.
fn best_closure(data: &ExactData, s: &Sequence) -> Result<StripClosure, ClosureError> {
    let all = strip::closures(data, s);
    if let [only] = all[..] {
        return Ok(only);
    }
    let mut best = Err(ClosureError::Unsupported);
    let mut most = 0;
    for closure in all {
        let distinct =
            reduced::<ResiduePoly>(data, s, closure).map_or(0, |r| r.polynomial.squarefree_degree());
        if distinct > most {
            (best, most) = (Ok(closure), distinct);
        }
    }
    best
}

fn degrees(data: &ExactData, s: &Sequence) -> Result<ClosureDegrees, ClosureError> {
    let closure = best_closure(data, s)?;
    let all = strip::literal::<ResiduePoly>(data, s, closure)?;
    let before = all.polynomial.degree().ok_or(ClosureError::Identity)?;
    let removal = remove_factors(&all);
    let after = removal.polynomial.degree().ok_or(ClosureError::Identity)?;
    let distinct = removal.polynomial.squarefree_degree();
    Ok(ClosureDegrees { before, after, distinct, factors: removal.factors, exponents: removal.exponents })
}

/// The polynomial that remains when the singular factors are divided out at the end, as in the paper.
struct Removal {
    polynomial: ResiduePoly,
    factors: Vec<SingularFactor>,
    exponents: Vec<f64>,
}

/// Divides by the norms of the singular factors, each without the contributions of earlier ones.
///
/// Let `D_t` be the numerator of `A_t = D_t / prod_s D_s^(a_ts)`, and `M_t = N_t prod_s N_s^(c_ts)` the norm of `D_t`
/// over the levels it is written in. Let the denominator of `N(f)` have `K_t` times `M_t`. Then the exponents of `N_t`
/// in `P / N(f)` are `K_t + sum_u c_ut K_u` less those removed. The last step is from `N_t` to `N(A_t)`.
fn remove_factors(all: &strip::Literal<ResiduePoly>) -> Removal {
    let count = all.factors.len();
    let mut polynomial = all.polynomial.clone();
    let mut norms: Vec<ResiduePoly> = Vec::new();
    let mut contained = vec![vec![0.0; count]; count];
    let mut factors = Vec::new();
    let mut powers = vec![0.0; count];
    let written = |t: usize| all.factors[t].0.element.len() as f64;
    let levels = f64::from(1i32 << all.levels);
    for (step, (factor, _)) in all.factors.iter().enumerate() {
        let mut norm = factor.norm.clone();
        for (s, earlier) in norms.iter().enumerate() {
            contained[step][s] = divide_out(&mut norm, earlier) as f64;
        }
        let removed = divide_out(&mut polynomial, &norm);
        let degree = norm.degree().unwrap_or(0);
        let own = f64::from(all.exponents[step]) * levels / written(step);
        for s in 0..step {
            powers[s] += contained[step][s] * own;
        }
        powers[step] += own - removed as f64;
        factors.push(SingularFactor { step, degree, removed });
        norms.push(norm);
    }
    let mut exponents = vec![0.0; count];
    for t in (0..count).rev().filter(|t| factors[*t].degree > 0) {
        exponents[t] = powers[t] * written(t) / f64::from(1i32 << t);
        for s in 0..t {
            let in_denominator = f64::from(all.factors[t].1[s]) * written(t) / written(s);
            powers[s] += powers[t] * (in_denominator - contained[t][s]);
        }
    }
    Removal { polynomial, factors, exponents }
}

/// Divides by a polynomial as often as possible; a constant divides nothing.
fn divide_out<R: Ring>(p: &mut R, divisor: &R) -> usize {
    let mut count = 0;
    while divisor.degree().is_some_and(|n| n > 0) && !p.is_zero() {
        let Some(quotient) = p.exact_div(divisor) else { break };
        *p = quotient;
        count += 1;
    }
    count
}

/// A closure polynomial of the problem with integer data, contents not removed.
struct Reduced<R> {
    polynomial: R,
    unknown: [JointIndex; 2],
    /// The first radicand, zero when it is not used.
    height: R,
    /// Norms of the singular factors.
    norms: Vec<R>,
}

/// The polynomial by the short way: singular factors are divided out level by level, as soon as they can be.
fn reduced<R: Ring>(
    data: &ExactData,
    s: &Sequence,
    closure: StripClosure,
) -> Result<Reduced<R>, ClosureError> {
    let mut strip = Strip::<R>::new(data, s, closure, false)?;
    let last = closure.steps.min(STEPS) - 1;
    for _ in 0..last {
        strip.place()?;
    }
    let outermost = strip.singular_factor(strip.base_of(last));
    let gram = strip.gram_determinant()?;
    let f = &strip.fractions;
    let mut factors = f.factors.clone();
    factors.push(Divisor::new(&f.tower, outermost.numerator));
    let mut element = tower::shortened(gram.numerator);
    loop {
        let level = element.len();
        for factor in factors.iter().filter(|d| d.element.len() <= level) {
            element = f.tower.divide_out(element, factor).0;
        }
        if element.len() == 1 {
            break;
        }
        element = tower::shortened(f.tower.norm_once(&element));
    }
    let mut polynomial = element.swap_remove(0);
    let mut norms: Vec<R> = Vec::new();
    for factor in &factors {
        let mut norm = factor.norm.clone();
        for earlier in &norms {
            divide_out(&mut norm, earlier);
        }
        divide_out(&mut polynomial, &norm);
        norms.push(norm);
    }
    if polynomial.is_zero() {
        return Err(ClosureError::Identity);
    }
    let height = f.tower.radicands.first().map_or_else(tower::zero, |r| r[0].clone());
    Ok(Reduced { polynomial, unknown: strip.unknown(), height, norms })
}

/// The most binary places before and after the point.
const RANGE: i64 = 600;

/// Coordinates times `2^scale` and squared lengths times `4^scale`, all integers.
struct ExactData {
    base: Vec<[BigInt; 3]>,
    platform: Vec<[BigInt; 3]>,
    legs: [(usize, usize); 6],
    squares: [BigInt; 6],
    scale: i64,
}

impl ExactData {
    /// Joints and the centres of the squares with all their digits: the numbers that the certificates are about.
    fn new(m: &Manipulator, s: &SquaredLegLengths) -> Result<Self, ClosureError> {
        let number = |x: f64| Dyadic::from_f64(x).ok_or(ClosureError::OutOfRange);
        let points = |list: &[nalgebra::Point3<f64>]| -> Result<Vec<[Dyadic; 3]>, ClosureError> {
            list.iter().map(|p| Ok([number(p.x)?, number(p.y)?, number(p.z)?])).collect()
        };
        let (base, platform) = (points(m.base_joints())?, points(m.platform_joints())?);
        let square = |s: DoubleDouble| Ok(number(s.hi())?.minus(&number(-s.lo())?));
        let squares: Vec<Dyadic> = s.middle().into_iter().map(square).collect::<Result<_, _>>()?;
        let depth = |x: &Dyadic| -x.exponent();
        let places = base.iter().chain(&platform).flatten().map(depth);
        let scale = places.chain(squares.iter().map(|s| (depth(s) + 1).div_euclid(2))).fold(0, i64::max);
        let sizes = base.iter().chain(&platform).flatten().chain(&squares).filter_map(Dyadic::log2_floor);
        if scale > RANGE || sizes.fold(0, i64::max) > RANGE {
            return Err(ClosureError::OutOfRange);
        }
        let integer = |x: &Dyadic, k: i64| {
            let x = x.shifted(k);
            x.mantissa() << x.exponent().unsigned_abs()
        };
        let scaled = |list: Vec<[Dyadic; 3]>| -> Vec<[BigInt; 3]> {
            list.iter().map(|p| [0, 1, 2].map(|i| integer(&p[i], scale))).collect()
        };
        Ok(Self {
            base: scaled(base),
            platform: scaled(platform),
            legs: m.pairs(),
            squares: std::array::from_fn(|i| integer(&squares[i], 2 * scale)),
            scale,
        })
    }

    /// A random member of the topology of these legs, all numbers between `-2^20` and `2^20`, squared lengths positive.
    fn random(legs: &[(usize, usize); 6], rng: &mut Rng) -> Self {
        let count = |joints: [usize; 6]| 1 + joints.into_iter().max().unwrap_or(0);
        let mut point = |_| [0, 1, 2].map(|_| BigInt::from(rng.uniform(-1e6, 1e6) as i64));
        let base = (0..count(legs.map(|l| l.0))).map(&mut point).collect();
        let platform = (0..count(legs.map(|l| l.1))).map(&mut point).collect();
        let squares = std::array::from_fn(|_| BigInt::from(rng.uniform(1.0, 1e12) as i64));
        Self { base, platform, legs: *legs, squares, scale: 0 }
    }

    /// Whether the joints of each body lie in a plane, exactly.
    fn is_planar(&self) -> bool {
        let flat = |points: &[[BigInt; 3]]| {
            let d: Vec<[BigInt; 3]> = points.iter().map(|p| minus(p, &points[0])).collect();
            let normals = d.iter().flat_map(|x| d.iter().map(move |y| cross(x, y)));
            let normal = normals.into_iter().find(|n| dot(n, n) != 0.into());
            normal.is_none_or(|n| d.iter().all(|x| dot(x, &n) == 0.into()))
        };
        flat(&self.base) && flat(&self.platform)
    }

    /// Coordinates in the frame of the joint's body.
    fn point(&self, joint: JointIndex) -> &[BigInt; 3] {
        match joint {
            JointIndex::Base(k) => &self.base[k],
            JointIndex::Platform(k) => &self.platform[k],
        }
    }

    /// The squared distance of two joints of one body.
    fn within(&self, x: JointIndex, y: JointIndex) -> BigInt {
        let d = minus(self.point(x), self.point(y));
        dot(&d, &d)
    }

    /// The squared length of the leg between two joints.
    fn leg(&self, x: JointIndex, y: JointIndex) -> Option<&BigInt> {
        let pair = x.across(y)?;
        self.legs.iter().position(|l| *l == pair).map(|i| &self.squares[i])
    }
}

fn minus(a: &[BigInt; 3], b: &[BigInt; 3]) -> [BigInt; 3] {
    std::array::from_fn(|i| &a[i] - &b[i])
}

fn dot(a: &[BigInt; 3], b: &[BigInt; 3]) -> BigInt {
    (0..3).map(|i| &a[i] * &b[i]).sum()
}

fn cross(a: &[BigInt; 3], b: &[BigInt; 3]) -> [BigInt; 3] {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        &a[j] * &b[k] - &a[k] * &b[j]
    })
}
