//! Counts the finite poses of a design and lengths exactly as written without finding them, by linear algebra modulo a
//! prime.
//!
//! In the sixteen coordinates of the group a leg is a linear equation (`quadrics.rs`). So the finite poses are the
//! zeros of quadrics in ten unknowns. Their algebra is built degree by degree (`quotient.rs`), modulo a random prime of
//! 61 bits. Squared lengths enter as the dyadic numbers they are, joints as the dyadic or algebraic numbers they are
//! (`joints.rs`). The method shares nothing with those that find poses, nor with their certificates. Theorem, bound on
//! the probability of error and sources: `docs/theory/pose-count.md`.

mod infinity;
mod joints;
mod quadrics;
mod quotient;

pub(crate) use infinity::are_points_at_infinity_finite;
use joints::{CountedJoints, DrawnPrime, EndResidues};
use num::modular::Field;
use platform::manipulator::{Manipulator, SquaredLegLengths};
use quadrics::{COORDINATES, Cut, H, Linear, M, cut};
use quotient::{QuotientOutcome, close};

/// Squared lengths, each the exact sum of two doubles.
pub type ExactSquares = [[f64; 2]; 6];

/// Squared lengths as sums of two doubles; `None` when they are known within a radius only.
#[must_use]
pub fn exact_squares(s: &SquaredLegLengths) -> Option<ExactSquares> {
    s.is_exact().then(|| s.middle().map(|x| [x.hi(), x.lo()]))
}

/// Highest degree of the spaces. Four is enough for sets of poses whose closure is finite (see the documentation); more
/// costs little where few monomials are left over.
const DEGREE: usize = 6;

/// Bits of random coefficients of linear sections.
const SECTION_BITS: f64 = 64.0;

/// Options of the count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CountOptions {
    /// Seed of the primes and of the random linear sections, which follow from it and from a hash of the joints and
    /// lengths.
    pub seed: u64,
    /// Number of primes that have to agree.
    pub primes: usize,
}

impl Default for CountOptions {
    fn default() -> Self {
        Self { seed: 1, primes: 2 }
    }
}

/// The finite poses, real and complex, as a set.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum PoseSet {
    /// Isolated poses only.
    Finite {
        /// Their number, each counted with its multiplicity.
        count: usize,
        /// Standard monomials by degree, from 0 on; their sum is the number.
        by_degree: Vec<usize>,
    },
    /// Curves, surfaces or more; isolated poses beside them are not counted.
    PositiveDimensional {
        /// Dimension of the components of highest dimension.
        dimension: usize,
        /// Their degree in the sixteen coordinates: points on as many random linear sections as the dimension, with
        /// multiplicity.
        degree: usize,
    },
    /// The computation does not tell.
    Undecided {
        /// Why.
        why: CountUndecided,
    },
}

num::answer_words! {
    /// Why the poses were not counted.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[non_exhaustive]
    pub enum CountUndecided as name {
        /// Neither the set nor random linear sections of it close at the highest degree computed.
        DegreeTooLow = "degree_too_low",
        /// The primes disagree: one of them at least divides a number it should not.
        PrimesDisagree = "primes_disagree",
        /// Joints are known between bounds only.
        JointsNotExact = "joints_not_exact",
        /// The joints are made of square roots and cosines, and none of the primes drawn has these.
        NoPrimeDrawn = "no_prime_drawn",
    }
}

/// The squared lengths for which poses are counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum CountedLengths {
    /// The given lengths as written.
    Given,
    /// Generic ones: no lengths have more isolated poses, multiplicity included.
    Generic,
}

/// The set and its evidence.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseCount {
    /// The set.
    pub set: PoseSet,
    /// Whether it is the set of the lengths given.
    pub lengths: CountedLengths,
    /// The primes, drawn uniformly from those between `2^60` and `2^61`. Joints made of square roots and cosines take
    /// the first of several draws that has these.
    pub primes: Vec<u64>,
    /// Bound on the probability that primes drawn so lead to another set than exact arithmetic does; zero when the set
    /// is undecided.
    pub error_probability: f64,
}

impl PoseCount {
    /// No count.
    #[must_use]
    pub fn undecided(why: CountUndecided) -> Self {
        Self {
            set: PoseSet::Undecided { why },
            lengths: CountedLengths::Given,
            primes: Vec::new(),
            error_probability: 0.0,
        }
    }

    /// The number of finite poses with multiplicity, where there are finitely many.
    #[must_use]
    pub fn finite(&self) -> Option<usize> {
        match &self.set {
            PoseSet::Finite { count, .. } => Some(*count),
            _ => None,
        }
    }
}

/// Common points of six legs in the closure of the group, each with its multiplicity, counted modulo random primes.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    schemars(rename = "CommonPointsRecord")
)]
pub struct CommonPoints {
    // In the coordinates `(M, y, x, r, h)` a pose has `h = e.e` and `M = h R` with its quaternion `e`; `h` and `M`
    // vanish where `e` does. There are forty points where all are isolated.
    /// Finite poses.
    pub finite: usize,
    /// Limits of poses with isotropic quaternion e: e.e = 0, e not 0. Null: not isolated, or not counted.
    pub isotropic: Option<usize>,
    /// Limits of poses with e = 0: the position goes to infinity. Null: points at infinity are not isolated, or not
    /// counted.
    pub at_infinity: Option<usize>,
    /// Bound on the probability of a wrong count.
    pub error_probability: f64,
}

/// Counts the common points of the legs of `m` for generic lengths beside `poses`, which [`count_generic_poses`]
/// counted with the same options; `None` when these are not isolated or not counted.
#[must_use]
pub fn count_common_points(
    m: &Manipulator,
    poses: &PoseCount,
    options: &CountOptions,
) -> Option<CommonPoints> {
    let finite = poses.finite()?;
    let mut error_probability = poses.error_probability;
    let mut count = |chart| {
        let found = counted_in(m, Lengths::Generic, chart, options);
        error_probability += found.error_probability;
        found.finite()
    };
    let rotating = count(CountedChart::Rotating);
    let all = rotating.and_then(|_| count(CountedChart::All));
    Some(CommonPoints {
        finite,
        isotropic: rotating.and_then(|n| n.checked_sub(finite)),
        at_infinity: all.zip(rotating).and_then(|(n, m)| n.checked_sub(m)),
        error_probability: error_probability.min(1.0),
    })
}

/// Counts the finite poses of `m` with the squared lengths given, both exactly as they are. Joints that a design gives
/// exactly are used, not the doubles next to them.
#[must_use]
pub fn count_poses(m: &Manipulator, squares: &ExactSquares, options: &CountOptions) -> PoseCount {
    counted(m, Lengths::Given(squares), options)
}

/// Counts the finite poses of `m` for generic squared lengths: no lengths have more isolated poses, counted with
/// multiplicity (Sommese, Wampler 2005, theorem 7.1.1).
///
/// The lengths are random integers below `2^60`; the bound on the probability of error includes that they are special.
/// Source: Schwartz 1980, lemma 1. The minors that decide are polynomials in the squared lengths, of degree one in each
/// row.
#[must_use]
pub fn count_generic_poses(m: &Manipulator, options: &CountOptions) -> PoseCount {
    counted(m, Lengths::Generic, options)
}

#[derive(Debug, Clone, Copy)]
enum Lengths<'a> {
    Given(&'a ExactSquares),
    Generic,
}

/// The form that equals one in the affine coordinates of the count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum CountedChart {
    /// `h`: poses.
    Finite,
    /// A random linear form of `M` and `h`: all points where these are not all zero.
    Rotating,
    /// A random linear form of all coordinates: all points.
    All,
}

/// Random coefficients, the same for all primes: squared lengths of generic legs, linear sections, and the form of the
/// chart.
struct Draws {
    squares: [i64; 6],
    sections: [[i64; COORDINATES]; 6],
    chart: CountedChart,
    form: [i64; COORDINATES],
}

fn counted(m: &Manipulator, lengths: Lengths<'_>, options: &CountOptions) -> PoseCount {
    counted_in(m, lengths, CountedChart::Finite, options)
}

fn counted_in(
    m: &Manipulator,
    lengths: Lengths<'_>,
    chart: CountedChart,
    options: &CountOptions,
) -> PoseCount {
    let joints = match CountedJoints::of(m) {
        Ok(joints) => joints,
        Err(why) => return PoseCount::undecided(why),
    };
    let mut rng = joints.rng(lengths, options.seed);
    let mut integer = || (rng.next_u64() >> 4).cast_signed();
    let draws = Draws {
        squares: std::array::from_fn(|_| integer()),
        sections: std::array::from_fn(|_| std::array::from_fn(|_| integer())),
        chart,
        form: match chart {
            CountedChart::Finite => std::array::from_fn(|k| i64::from(k == H)),
            CountedChart::Rotating => {
                std::array::from_fn(|k| if k == H || M.contains(&k) { integer() } else { 0 })
            }
            CountedChart::All => std::array::from_fn(|_| integer()),
        },
    };
    let mut out: Option<PoseCount> = None;
    // that lengths or sections drawn at random are special, the same for all primes
    let mut special: f64 = 0.0;
    for _ in 0..options.primes.max(1) {
        let Some(prime) = joints.drawn(&mut rng) else {
            return PoseCount::undecided(CountUndecided::NoPrimeDrawn);
        };
        let SetModulo { set, depth, sections } = set_modulo(prime.field, &prime.ends, lengths, &draws);
        let error = error_probability(&joints, &prime, lengths, (chart, depth));
        if sections > 0 || matches!(lengths, Lengths::Generic) {
            special = special.max(minors(chart, depth) / 2f64.powi(60));
        }
        let count = out.get_or_insert_with(|| PoseCount {
            set: set.clone(),
            lengths: match lengths {
                Lengths::Given(_) => CountedLengths::Given,
                Lengths::Generic => CountedLengths::Generic,
            },
            primes: Vec::new(),
            error_probability: 1.0,
        });
        count.primes.push(prime.field.prime());
        count.error_probability *= error;
        if count.set != set {
            count.set = PoseSet::Undecided { why: CountUndecided::PrimesDisagree };
        }
        if matches!(count.set, PoseSet::Undecided { .. }) {
            count.error_probability = 0.0;
            break;
        }
    }
    let mut count = out.unwrap_or(PoseCount::undecided(CountUndecided::DegreeTooLow));
    if !matches!(count.set, PoseSet::Undecided { .. }) {
        count.error_probability += special;
    }
    count
}

/// The set modulo one prime.
struct SetModulo {
    set: PoseSet,
    /// Degree of the multiples used.
    depth: usize,
    /// Random linear equations that the set was cut with.
    sections: usize,
}

fn set_modulo(field: Field, ends: &EndResidues, lengths: Lengths<'_>, draws: &Draws) -> SetModulo {
    let undecided = PoseSet::Undecided { why: CountUndecided::DegreeTooLow };
    let mut equations: Vec<Linear> = (0..6)
        .map(|i| {
            let square = match lengths {
                Lengths::Given(squares) => {
                    squares[i].iter().fold(0, |sum, x| field.add(sum, field.scaled(*x, 0)))
                }
                Lengths::Generic => field.integer(draws.squares[i]),
            };
            leg_equation(field, &ends[i], square)
        })
        .collect();
    let relations =
        6 - field.rank(equations.iter().map(|e| std::array::from_fn::<_, H, _>(|k| e[k])).collect());
    if relations > 0 && draws.chart != CountedChart::Finite {
        // points at infinity need not form sets of the dimension that the relations give the poses
        return SetModulo { set: undecided, depth: 2, sections: 0 };
    }
    let form = |coefficients: &[i64; COORDINATES], value: u64| -> Linear {
        std::array::from_fn(|k| coefficients.get(k).map_or(value, |x| field.integer(*x)))
    };
    let section = |k: usize| form(&draws.sections[k], 0);
    equations.push(form(&draws.form, field.integer(-1)));
    equations.extend((0..relations).map(section));
    let mut deepest = 2;
    // every component has at least the dimension of the relations
    for dimension in relations..=6 {
        if dimension > relations {
            equations.push(section(dimension - 1));
        }
        let (unknowns, polynomials) = match cut(field, &equations) {
            Cut::Empty => {
                // later sections that contradict the legs say nothing of the set
                let none = PoseSet::Finite { count: 0, by_degree: Vec::new() };
                let set = if dimension == relations { none } else { undecided };
                return SetModulo { set, depth: deepest, sections: dimension };
            }
            Cut::Quadrics { unknowns, polynomials } => (unknowns, polynomials),
        };
        if let QuotientOutcome::Closed { by_degree, depth } = close(field, unknowns, polynomials, DEGREE) {
            deepest = deepest.max(depth);
            let count = by_degree.iter().sum();
            let set = if dimension == 0 || (count == 0 && dimension == relations) {
                PoseSet::Finite { count, by_degree }
            } else if count == 0 {
                undecided
            } else {
                PoseSet::PositiveDimensional { dimension, degree: count }
            };
            return SetModulo { set, depth: deepest, sections: dimension };
        }
    }
    SetModulo { set: undecided, depth: deepest, sections: 6 }
}

/// `r - 2 a.y - 2 b.x - 2 a.(M b) + (|a|^2 + |b|^2 - s) h = 0`.
fn leg_equation(field: Field, [a, b]: &[[u64; 3]; 2], square: u64) -> Linear {
    let minus_two = field.integer(-2);
    let mut row = [0; COORDINATES + 1];
    for i in 0..3 {
        let doubled = field.mul(minus_two, a[i]);
        for j in 0..3 {
            row[3 * i + j] = field.mul(doubled, b[j]);
        }
        row[9 + i] = doubled;
        row[12 + i] = field.mul(minus_two, b[i]);
    }
    row[15] = 1;
    let squares = a.iter().chain(b).fold(0, |sum, x| field.add(sum, field.mul(*x, *x)));
    row[H] = field.sub(squares, square);
    row
}

/// Bound on the probability that a prime is bad: see "The probability of error" in `docs/theory/pose-count.md`.
///
/// A bad prime divides a nonzero minor of the integer matrix of all multiples of some degree `<= depth + 1` of the
/// quadrics and linear equations. Or it divides a minor of the matrix's columns above one of the degrees `0..=DEGREE`.
/// There are sixteen unknowns in the chart `h = 1`, seventeen in the others.
///
/// Hadamard: a minor is at most the product of the norms of its rows. The number of its prime factors above `2^60` is
/// at most its bits over sixty. There are more than `3 2^60 / (5 ln 2^60)` primes between `2^60` and `2^61` (Rosser,
/// Schoenfeld 1962, (3.9)). Joints made of square roots and cosines have algebraic integers as minors. A bad prime
/// divides their norm, and any of the primes drawn may be bad.
fn error_probability(
    joints: &CountedJoints,
    prime: &DrawnPrime,
    lengths: Lengths<'_>,
    (chart, depth): (CountedChart, usize),
) -> f64 {
    let bits = joints.bits(lengths).max(SECTION_BITS);
    let primes = 3.0 * 2f64.powi(60) / (5.0 * 60.0 * std::f64::consts::LN_2);
    (minors(chart, depth) * bits / 60.0 / primes * prime.chances).min(1.0)
}

/// Upper bound on the rows of all minors that decide, for all depths up to the one that was needed. That depth is not
/// known before the prime is drawn.
fn minors(chart: CountedChart, depth: usize) -> f64 {
    let unknowns = if chart == CountedChart::Finite { H } else { COORDINATES };
    (1..=depth + 1).map(|t| (DEGREE + 2) as f64 * monomials(unknowns, t)).sum()
}

/// Number of monomials of degree `t` or less.
fn monomials(unknowns: usize, t: usize) -> f64 {
    (1..=t).map(|k| (unknowns + k) as f64 / k as f64).product()
}

#[cfg(test)]
mod tests;
