//! Numbers of the real fields `Q(sqrt 2, sqrt 3, ...)`: sums of rational multiples of square roots of integers.
//!
//! The square roots of different squarefree integers are linearly independent over `Q` (Besicovitch 1940), so that the sum with its radicands squarefree is
//! unique: it is zero only when it has no terms, and its sign is found by evaluating it to enough digits.
//! Numbers are kept small on purpose: an operation whose result would be long, and a square root that is no such sum, give `None`.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::fmt;

use num_bigint::BigInt;
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};

use super::exact::{Rational, farthest, nearest};

/// Most terms of a sum: the degree of a field with four square roots.
const MAX_TERMS: usize = 16;
/// Most bits of a numerator or of the common denominator.
const MAX_BITS: u64 = 2048;
/// Radicands are divided by the primes below this; what is left is squarefree or a square below its cube.
const TRIAL: u64 = 1 << 16;
/// Most bits of a number that is divided by them one after the other.
const MAX_FACTORED: u64 = 512;
/// How deep square roots of sums are sought under one another.
const MAX_NESTING: usize = 4;

/// `sum_r c_r sqrt(r) / d`, radicands `r >= 1` squarefree, `d > 0`, integers `c_r` that are not zero and share no factor with `d`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Surd {
    terms: BTreeMap<u64, BigInt>,
    denominator: BigInt,
}

impl Surd {
    pub(crate) fn zero() -> Self {
        Self { terms: BTreeMap::new(), denominator: BigInt::one() }
    }

    pub(crate) fn integer(x: i64) -> Self {
        Self::lowest(BTreeMap::from([(1, BigInt::from(x))]), BigInt::one()).unwrap_or_else(Self::zero)
    }

    /// `None` for a fraction that is too long.
    pub(crate) fn rational(x: &Rational) -> Option<Self> {
        Self::lowest(BTreeMap::from([(1, x.numer().clone())]), x.denom().clone())
    }

    /// In lowest terms; `None` when that is too long.
    fn lowest(terms: BTreeMap<u64, BigInt>, denominator: BigInt) -> Option<Self> {
        Self::reduced(terms, denominator).short()
    }

    /// The number itself, `None` when it is too long.
    fn short(self) -> Option<Self> {
        let short = |x: &BigInt| x.bits() <= MAX_BITS;
        let fits =
            self.terms.len() <= MAX_TERMS && short(&self.denominator) && self.terms.values().all(short);
        fits.then_some(self)
    }

    /// In lowest terms, however long.
    fn reduced(mut terms: BTreeMap<u64, BigInt>, denominator: BigInt) -> Self {
        terms.retain(|_, c| !c.is_zero());
        let mut common = denominator.clone();
        for c in terms.values() {
            if common.is_one() {
                break;
            }
            common = common.gcd(c);
        }
        let denominator = if common.is_one() { denominator } else { denominator / &common };
        if !common.is_one() {
            for c in terms.values_mut() {
                *c = &*c / &common;
            }
        }
        Self { terms, denominator }
    }

    /// A fraction, however long.
    pub(super) fn long_rational(x: &Rational) -> Self {
        Self::reduced(BTreeMap::from([(1, x.numer().clone())]), x.denom().clone())
    }

    pub(crate) fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// The number when it is rational.
    pub(crate) fn as_rational(&self) -> Option<Rational> {
        match self.terms.iter().next() {
            None => Some(Rational::zero()),
            Some((1, c)) if self.terms.len() == 1 => Some(Rational::new(c.clone(), self.denominator.clone())),
            Some(_) => None,
        }
    }

    /// The radicands of its square roots, without 1.
    pub(crate) fn radicands(&self) -> impl Iterator<Item = u64> + '_ {
        self.terms.keys().copied().filter(|r| *r > 1)
    }

    /// Radicands, squarefree and from 1 on, with the numerators that belong to them.
    pub(crate) fn terms(&self) -> impl Iterator<Item = (u64, &BigInt)> {
        self.terms.iter().map(|(r, c)| (*r, c))
    }

    /// The common denominator, positive.
    pub(crate) fn denominator(&self) -> &BigInt {
        &self.denominator
    }

    pub(crate) fn negated(&self) -> Self {
        let terms = self.terms.iter().map(|(r, c)| (*r, -c)).collect();
        Self { terms, denominator: self.denominator.clone() }
    }

    pub(crate) fn plus(&self, other: &Self) -> Option<Self> {
        self.sum(other).short()
    }

    /// The sum, however long.
    pub(super) fn sum(&self, other: &Self) -> Self {
        let common = self.denominator.lcm(&other.denominator);
        let (f, g) = (&common / &self.denominator, &common / &other.denominator);
        let mut terms: BTreeMap<u64, BigInt> = self.terms.iter().map(|(r, c)| (*r, c * &f)).collect();
        for (r, c) in &other.terms {
            *terms.entry(*r).or_default() += c * &g;
        }
        Self::reduced(terms, common)
    }

    pub(crate) fn minus(&self, other: &Self) -> Option<Self> {
        self.plus(&other.negated())
    }

    pub(crate) fn times(&self, other: &Self) -> Option<Self> {
        self.product(other)?.short()
    }

    /// The product, however long; `None` when a radicand exceeds 64 bits.
    pub(super) fn product(&self, other: &Self) -> Option<Self> {
        let mut terms: BTreeMap<u64, BigInt> = BTreeMap::new();
        for (r, c) in &self.terms {
            for (s, d) in &other.terms {
                // sqrt(r) sqrt(s) = g sqrt(r s / g^2), squarefree again
                let g = r.gcd(s);
                let radicand = (r / g).checked_mul(s / g)?;
                *terms.entry(radicand).or_default() += c * d * g;
            }
        }
        Some(Self::reduced(terms, &self.denominator * &other.denominator))
    }

    /// `a` and `b` with the number `a + b sqrt(p)`, no radicand of which `p` divides; `p` is prime.
    fn split(&self, p: u64) -> (Self, Self) {
        let (mut a, mut b) = (BTreeMap::new(), BTreeMap::new());
        for (r, c) in &self.terms {
            if r % p == 0 {
                b.insert(r / p, c.clone());
            } else {
                a.insert(*r, c.clone());
            }
        }
        let of = |terms| Self::reduced(terms, self.denominator.clone());
        (of(a), of(b))
    }

    /// A prime that divides one of the radicands.
    fn some_prime(&self) -> Option<u64> {
        let r = self.radicands().next()?;
        (2..TRIAL).take_while(|p| p * p <= r).find(|p| r % p == 0).or(Some(r))
    }

    /// `1 / x`; `None` for zero and when the result is too long.
    pub(crate) fn inverse(&self) -> Option<Self> {
        self.reciprocal()?.short()
    }

    /// `1 / x`, however long; `None` for zero and when a radicand exceeds 64 bits.
    pub(super) fn reciprocal(&self) -> Option<Self> {
        if self.is_zero() {
            return None;
        }
        let Some(p) = self.some_prime() else {
            return Some(Self::long_rational(&self.as_rational()?.recip()));
        };
        // 1 / (a + b sqrt p) = (a - b sqrt p) / (a^2 - p b^2), whose divisor has one square root less
        let (a, b) = self.split(p);
        let root = Self { terms: BTreeMap::from([(p, BigInt::one())]), denominator: BigInt::one() };
        let conjugate = a.sum(&b.product(&root)?.negated());
        conjugate.product(&self.product(&conjugate)?.reciprocal()?)
    }

    /// The square root that is not negative; `None` for negative numbers and when it is not found among these sums.
    pub(crate) fn sqrt(&self) -> Option<Self> {
        self.root(MAX_NESTING)
    }

    fn root(&self, depth: usize) -> Option<Self> {
        if self.is_zero() {
            return Some(Self::zero());
        }
        if self.sign() == Ordering::Less {
            return None;
        }
        if let Some(x) = self.as_rational() {
            return rational_root(&x);
        }
        let p = self.some_prime().filter(|_| depth > 0)?;
        // (u + v)^2 = a + b sqrt p with u^2 = (a +- c) / 2, c^2 = a^2 - p b^2, v = b sqrt p / (2 u)
        let (a, b) = self.split(p);
        let tail = self.minus(&a)?;
        let c = a.times(&a)?.minus(&b.times(&b)?.times(&Self::integer(i64::try_from(p).ok()?))?)?;
        let c = c.root(depth - 1)?;
        let half = Self::rational(&Rational::new(1.into(), 2.into()))?;
        for c in [c.clone(), c.negated()] {
            let Some(u) = a.plus(&c)?.times(&half)?.root(depth - 1).filter(|u| !u.is_zero()) else {
                continue;
            };
            let root = u.plus(&tail.times(&half)?.times(&u.inverse()?)?)?;
            if root.times(&root)? == *self {
                return Some(if root.sign() == Ordering::Less { root.negated() } else { root });
            }
        }
        None
    }

    /// Rationals below and above it (both the number when it is rational), closer together than `2^-bits` of its magnitude.
    pub(crate) fn between(&self, bits: u64) -> (Rational, Rational) {
        if let Some(x) = self.as_rational() {
            return (x.clone(), x);
        }
        let mut k = bits + 16;
        loop {
            let sum: BigInt = self.terms.iter().map(|(r, c)| scaled_root(c, *r, k)).sum();
            let error = BigInt::from(self.terms.len());
            if sum.bits() > error.bits() + bits {
                let scale = &self.denominator << k;
                return (Rational::new(&sum - &error, scale.clone()), Rational::new(sum + error, scale));
            }
            k *= 2;
        }
    }

    /// An upper bound of how far it is from a finite double; zero where it is the double.
    pub(crate) fn distance_from(&self, double: f64) -> f64 {
        let (low, high) = self.between(160);
        farthest(double, &low, &high)
    }

    /// All conjugates are below two to this power.
    pub(crate) fn magnitude_bits(&self) -> i64 {
        // a square root has at most half the bits of its radicand, rounded up
        let bits = |(r, c): (&u64, &BigInt)| c.bits() + u64::from(u64::BITS - r.leading_zeros()).div_ceil(2);
        let largest = self.terms.iter().map(bits).max().unwrap_or(0);
        let terms = self.terms.len().next_power_of_two().trailing_zeros();
        (largest + u64::from(terms) + 1).cast_signed() - self.denominator.bits().cast_signed()
    }

    /// Compared with zero.
    pub(crate) fn sign(&self) -> Ordering {
        if self.is_zero() {
            return Ordering::Equal;
        }
        // both ends have the sign of the number
        self.between(8).0.cmp(&Rational::zero())
    }

    /// The nearest double.
    pub(crate) fn nearest(&self) -> f64 {
        let mut bits = 80;
        loop {
            let (low, high) = self.between(bits);
            let (low, high) = (nearest(&low), nearest(&high));
            // an irrational number is nowhere half way between two doubles
            if low.total_cmp(&high).is_eq() {
                return low;
            }
            bits *= 2;
        }
    }
}

/// The sum of products; `None` when it becomes too long.
pub(crate) fn combination(weights: &[Surd], values: &[Surd]) -> Option<Surd> {
    weights.iter().zip(values).try_fold(Surd::zero(), |sum, (w, x)| sum.plus(&w.times(x)?))
}

/// Brings the first `width` columns to the identity above zeros as far as they go; the rank. `None` when numbers become too long.
pub(crate) fn eliminate(rows: &mut [Vec<Surd>], width: usize) -> Option<usize> {
    let mut rank = 0;
    for column in 0..width {
        let Some(pivot) = (rank..rows.len()).find(|i| !rows[*i][column].is_zero()) else { continue };
        rows.swap(rank, pivot);
        let inverse = rows[rank][column].inverse()?;
        let head: Vec<Surd> = rows[rank].iter().map(|x| x.times(&inverse)).collect::<Option<_>>()?;
        for (i, row) in rows.iter_mut().enumerate() {
            let factor = row[column].clone();
            if i != rank && !factor.is_zero() {
                for (x, h) in row.iter_mut().zip(&head) {
                    *x = x.minus(&factor.times(h)?)?;
                }
            }
        }
        rows[rank] = head;
        rank += 1;
    }
    Some(rank)
}

/// `c sqrt(r) 2^k`, rounded towards zero.
fn scaled_root(c: &BigInt, r: u64, k: u64) -> BigInt {
    let root = ((c * c * r) << (2 * k)).sqrt();
    if c.is_negative() { -root } else { root }
}

/// The square root of a positive fraction.
fn rational_root(x: &Rational) -> Option<Surd> {
    // sqrt(n / d) = sqrt(n d) / d
    let (square, radicand) = squarefree(x.numer() * x.denom())?;
    Surd::lowest(BTreeMap::from([(radicand, square)]), x.denom().clone())
}

/// `s` and squarefree `r` with `n = s^2 r`, `n` positive; `None` when `r` cannot be told to be squarefree by small primes, or is too large.
fn squarefree(mut n: BigInt) -> Option<(BigInt, u64)> {
    let (mut square, mut free) = (BigInt::one(), 1u64);
    let whole = n.sqrt();
    if &whole * &whole == n {
        return Some((whole, 1));
    }
    if n.bits() > MAX_FACTORED {
        return None;
    }
    let mut p = 2u64;
    while p < TRIAL {
        if let Ok(small) = u64::try_from(&n)
            && p * p > small
        {
            break;
        }
        let mut power = 0u32;
        loop {
            let (quotient, rest) = n.div_rem(&BigInt::from(p));
            if !rest.is_zero() {
                break;
            }
            n = quotient;
            power += 1;
        }
        square *= BigInt::from(p).pow(power / 2);
        if power % 2 == 1 {
            free = free.checked_mul(p)?;
        }
        p += if p == 2 { 1 } else { 2 };
    }
    let whole = n.sqrt();
    if &whole * &whole == n {
        return Some((square * whole, free));
    }
    // without factors below TRIAL: below its cube at most two prime factors, and not the same two
    let rest = u64::try_from(n).ok().filter(|n| *n < TRIAL.pow(3))?;
    Some((square, free.checked_mul(rest)?))
}

/// As an expression, `1/2 + 3*sqrt(2)/4` for example.
impl fmt::Display for Surd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_zero() {
            return f.write_str("0");
        }
        for (i, (r, c)) in self.terms.iter().enumerate() {
            let share = Rational::new(c.abs(), self.denominator.clone());
            let sign = match (i, c.is_negative()) {
                (0, false) => "",
                (0, true) => "-",
                (_, false) => " + ",
                (_, true) => " - ",
            };
            f.write_str(sign)?;
            match (*r, share.numer().is_one()) {
                (1, _) => write!(f, "{}", share.numer())?,
                (r, true) => write!(f, "sqrt({r})")?,
                (r, false) => write!(f, "{}*sqrt({r})", share.numer())?,
            }
            if !share.denom().is_one() {
                write!(f, "/{}", share.denom())?;
            }
        }
        Ok(())
    }
}

/// Integers whose square roots generate the same field as those of squarefree integers in ascending order: a root that is a fraction times a product of two or
/// three before it is left out.
#[cfg(feature = "files")]
pub(crate) fn generators(radicands: &[u64]) -> Vec<u64> {
    // the squarefree part of a product of squarefree integers
    let product = |a: u64, b: u64| {
        let g = a.gcd(&b);
        (a / g).checked_mul(b / g)
    };
    let mut kept: Vec<u64> = Vec::new();
    for r in radicands {
        let rest: Vec<u64> = kept.iter().filter_map(|k| product(*k, *r)).collect();
        let two = rest.iter().any(|x| kept.contains(x));
        let three =
            kept.iter().flat_map(|k| rest.iter().filter_map(|x| product(*k, *x))).any(|x| kept.contains(&x));
        if !(two || three) {
            // sqrt(6) beside sqrt(2) is as good as sqrt(3)
            kept.push(rest.into_iter().fold(*r, u64::min));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn fraction(n: i64, d: i64) -> Rational {
        Rational::new(n.into(), d.into())
    }

    fn root(r: u64) -> Surd {
        rational_root(&Rational::from_integer(r.into())).unwrap()
    }

    fn sum(parts: &[(i64, i64, u64)]) -> Surd {
        parts.iter().fold(Surd::zero(), |s, (n, d, r)| {
            s.plus(&Surd::rational(&fraction(*n, *d)).unwrap().times(&root(*r)).unwrap()).unwrap()
        })
    }

    fn value(x: &Surd) -> f64 {
        let terms =
            x.terms.iter().map(|(r, c)| nearest(&Rational::from_integer(c.clone())) * (*r as f64).sqrt());
        terms.sum::<f64>() / nearest(&Rational::from_integer(x.denominator.clone()))
    }

    fn any_sum() -> impl Strategy<Value = Surd> {
        let term = (-30i64..30, 1i64..12, prop::sample::select(vec![1u64, 2, 3, 5, 6, 10, 15, 12]));
        prop::collection::vec(term, 0..4).prop_map(|parts| sum(&parts))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]

        #[test]
        fn the_sums_are_a_field(x in any_sum(), y in any_sum(), z in any_sum()) {
            prop_assert_eq!(x.plus(&y), y.plus(&x));
            prop_assert_eq!(x.times(&y), y.times(&x));
            prop_assert_eq!(
                x.times(&y.plus(&z).unwrap()),
                x.times(&y).unwrap().plus(&x.times(&z).unwrap())
            );
            prop_assert!(x.minus(&x).unwrap().is_zero());
            if x.is_zero() {
                prop_assert_eq!(x.inverse(), None);
            } else {
                prop_assert_eq!(x.times(&x.inverse().unwrap()).unwrap(), Surd::integer(1));
            }
        }

        #[test]
        fn signs_and_doubles_are_those_of_the_value(x in any_sum()) {
            let v = value(&x);
            prop_assert!((x.nearest() - v).abs() <= 1e-12 * (1.0 + v.abs()));
            if v.abs() > 1e-9 {
                prop_assert_eq!(x.sign(), v.total_cmp(&0.0));
            }
            prop_assert_eq!(x.sign() == Ordering::Equal, x.is_zero());
        }

        #[test]
        fn a_square_has_its_root(x in any_sum()) {
            let square = x.times(&x).unwrap();
            // nested roots are found where two square roots are under the root
            if let Some(found) = square.sqrt() {
                prop_assert!(found == x || found == x.negated());
                prop_assert!(found.sign() != Ordering::Less);
            } else {
                prop_assert!(x.terms.len() > 2);
            }
        }
    }

    #[test]
    fn nested_roots_of_angles_and_edges() {
        // 8 + 4 sqrt 3 = (sqrt 6 + sqrt 2)^2
        assert_eq!(sum(&[(8, 1, 1), (4, 1, 3)]).sqrt(), Some(sum(&[(1, 1, 6), (1, 1, 2)])));
        assert_eq!(sum(&[(8, 1, 1), (-4, 1, 3)]).sqrt(), Some(sum(&[(1, 1, 6), (-1, 1, 2)])));
        assert_eq!(sum(&[(2, 1, 1), (1, 1, 2)]).sqrt(), None, "sqrt(2 + sqrt 2) is in no such field");
        assert_eq!(Surd::integer(-1).sqrt(), None);
        assert_eq!(Surd::rational(&fraction(8, 27)).unwrap().sqrt(), Some(sum(&[(2, 9, 6)])));
    }

    #[test]
    fn a_difference_of_nearly_equal_sums_has_its_sign() {
        // sqrt 2 against the convergents of its continued fraction, to numbers of 100 digits
        let (mut p, mut q) = (BigInt::one(), BigInt::one());
        for k in 0..250 {
            let near = Surd::rational(&Rational::new(p.clone(), q.clone())).unwrap();
            let expected = if k % 2 == 0 { Ordering::Greater } else { Ordering::Less };
            assert_eq!(root(2).minus(&near).unwrap().sign(), expected, "{k}");
            (p, q) = (&p + 2 * &q, p + q);
        }
    }

    #[test]
    fn radicands_that_cannot_be_factored_are_refused() {
        let (p, q) = (BigInt::from(4_294_967_291u64), BigInt::from(4_294_967_279u64));
        assert_eq!(squarefree(&p * &q), None);
        assert_eq!(squarefree(&p * &p), Some((p.clone(), 1)));
        assert_eq!(squarefree(&p * &p * 12), Some((p * 2, 3)));
        assert_eq!(squarefree(65_537u64.into()), Some((1.into(), 65_537)));
        assert_eq!(squarefree((65_537u64 * 65_539).into()), Some((1.into(), 65_537 * 65_539)));
    }

    #[test]
    fn it_is_written_as_an_expression() {
        assert_eq!(sum(&[(1, 2, 1), (-3, 4, 2), (1, 1, 6)]).to_string(), "1/2 - 3*sqrt(2)/4 + sqrt(6)");
        assert_eq!(Surd::integer(-7).to_string(), "-7");
        assert_eq!(Surd::zero().to_string(), "0");
    }
}
