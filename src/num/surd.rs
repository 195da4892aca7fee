//! Numbers of the real fields `Q(sqrt 2, sqrt 3, .., cos 11.25, cos 18, cos 40)`: sums of rational multiples of
//! square roots of integers, and of these times cosines.
//!
//! The square roots of different squarefree integers are linearly independent over `Q` (Besicovitch 1940), and so are
//! their products with the cosines of [`FieldRoot`]. The sum is therefore unique: it is zero only without terms, and
//! its sign follows from an evaluation to enough digits. Numbers are kept short on purpose: operations with a long
//! result, and square roots that are no such sum, give `None`.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::fmt;

use num_bigint::BigInt;
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};

use super::cosine::{FieldRoot, Generator};
use super::exact::{Rational, common_divisor, farthest, nearest};

/// Greatest number of terms of a sum. It is the degree of a field with four square roots, or of the cosines of 3, 3.75,
/// 4.5 and 5.625 degrees.
const MAX_TERMS: usize = 16;
/// Greatest number of bits of a numerator or of the common denominator.
const MAX_BITS: u64 = 2048;
/// Radicands are divided by the primes below this; the rest is squarefree or a square below its cube.
pub(super) const TRIAL: u64 = 1 << 16;
/// Greatest number of bits for trial division.
const MAX_FACTORED: u64 = 512;
/// Greatest nesting depth of square roots of sums.
const MAX_NESTING: usize = 4;

/// `sum_r c_r r / d` over some of the [`FieldRoot`]s, with `d > 0` and nonzero integers `c_r` without a common factor
/// with `d`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Surd {
    terms: BTreeMap<FieldRoot, BigInt>,
    denominator: BigInt,
}

impl Surd {
    /// Zero.
    pub fn zero() -> Self {
        Self { terms: BTreeMap::new(), denominator: BigInt::one() }
    }

    /// A whole number.
    pub fn integer(x: i64) -> Self {
        Self::lowest(BTreeMap::from([(FieldRoot::ONE, BigInt::from(x))]), BigInt::one())
            .unwrap_or_else(Self::zero)
    }

    /// `None` for a fraction that is too long.
    pub fn rational(x: &Rational) -> Option<Self> {
        Self::lowest(BTreeMap::from([(FieldRoot::ONE, x.numer().clone())]), x.denom().clone())
    }

    /// The number in lowest terms; `None` if it is too long.
    fn lowest(terms: BTreeMap<FieldRoot, BigInt>, denominator: BigInt) -> Option<Self> {
        Self::reduced(terms, denominator).short()
    }

    /// The number itself; `None` if it is too long.
    fn short(self) -> Option<Self> {
        let short = |x: &BigInt| x.bits() <= MAX_BITS;
        let fits =
            self.terms.len() <= MAX_TERMS && short(&self.denominator) && self.terms.values().all(short);
        fits.then_some(self)
    }

    /// The number in lowest terms, of any length.
    fn reduced(mut terms: BTreeMap<FieldRoot, BigInt>, denominator: BigInt) -> Self {
        terms.retain(|_, c| !c.is_zero());
        let mut common = denominator.clone();
        for c in terms.values() {
            if common.is_one() {
                break;
            }
            common = common_divisor(&common, c);
        }
        let denominator = if common.is_one() { denominator } else { denominator / &common };
        if !common.is_one() {
            for c in terms.values_mut() {
                *c = &*c / &common;
            }
        }
        Self { terms, denominator }
    }

    /// A fraction of any length.
    pub(super) fn long_rational(x: &Rational) -> Self {
        Self::reduced(BTreeMap::from([(FieldRoot::ONE, x.numer().clone())]), x.denom().clone())
    }

    /// Whether it is zero.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// The number if it is rational.
    pub fn as_rational(&self) -> Option<Rational> {
        match self.terms.iter().next() {
            None => Some(Rational::zero()),
            Some((&FieldRoot::ONE, c)) if self.terms.len() == 1 => {
                Some(Rational::new_raw(c.clone(), self.denominator.clone()))
            }
            Some(_) => None,
        }
    }

    /// The radicands of its square roots, without 1.
    pub fn radicands(&self) -> impl Iterator<Item = u64> + '_ {
        self.terms.keys().map(|r| r.radicand()).filter(|r| *r > 1)
    }

    /// Numbers `n` such that the field of its cosines has `cos(360 / n)` degrees: 16, 32, 20 or 9.
    pub fn divisions(&self) -> impl Iterator<Item = u32> + '_ {
        self.terms.keys().flat_map(|r| r.cosines()).map(|(n, _)| n)
    }

    /// The terms with their numerators.
    pub fn terms(&self) -> impl Iterator<Item = (FieldRoot, &BigInt)> {
        self.terms.iter().map(|(r, c)| (*r, c))
    }

    /// The common denominator, positive.
    pub fn denominator(&self) -> &BigInt {
        &self.denominator
    }

    /// `-x`.
    pub fn negated(&self) -> Self {
        let terms = self.terms.iter().map(|(r, c)| (*r, -c)).collect();
        Self { terms, denominator: self.denominator.clone() }
    }

    /// The sum; `None` if the field of both is too large.
    pub fn plus(&self, other: &Self) -> Option<Self> {
        self.sum(other).short()
    }

    /// The sum, of any length.
    pub(super) fn sum(&self, other: &Self) -> Self {
        let common =
            &self.denominator / common_divisor(&self.denominator, &other.denominator) * &other.denominator;
        let (f, g) = (&common / &self.denominator, &common / &other.denominator);
        let mut terms: BTreeMap<FieldRoot, BigInt> = self.terms.iter().map(|(r, c)| (*r, c * &f)).collect();
        for (r, c) in &other.terms {
            *terms.entry(*r).or_default() += c * &g;
        }
        Self::reduced(terms, common)
    }

    /// The difference; `None` if the field of both is too large.
    pub fn minus(&self, other: &Self) -> Option<Self> {
        self.plus(&other.negated())
    }

    /// The product; `None` if the field of both is too large.
    pub fn times(&self, other: &Self) -> Option<Self> {
        self.product(other)?.short()
    }

    /// The product, of any length; `None` if a radicand exceeds 64 bits.
    pub(super) fn product(&self, other: &Self) -> Option<Self> {
        let mut terms: BTreeMap<FieldRoot, BigInt> = BTreeMap::new();
        let doubled = [self, other].iter().all(|x| x.terms.keys().any(|r| r.has_twentieth()));
        for (r, c) in &self.terms {
            for (s, d) in &other.terms {
                let product = c * d;
                for (root, factor) in r.times(*s, doubled)? {
                    *terms.entry(root).or_default() += &product * factor;
                }
            }
        }
        let denominator = &self.denominator * &other.denominator;
        Some(Self::reduced(terms, if doubled { denominator << 1u32 } else { denominator }))
    }

    /// A generator of its field over a smaller one; `None` for fractions.
    fn generator(&self) -> Option<Generator> {
        self.terms.keys().filter_map(|r| r.generator()).min()
    }

    /// The image under the automorphism that moves the generator and none of the later ones.
    fn image(&self, generator: Generator) -> Self {
        let mut terms: BTreeMap<FieldRoot, BigInt> = BTreeMap::new();
        for (r, c) in &self.terms {
            for (root, factor) in r.image(generator) {
                *terms.entry(root).or_default() += c * factor;
            }
        }
        Self::reduced(terms, self.denominator.clone())
    }

    /// `1 / x`; `None` for zero and for a result that is too long.
    pub fn inverse(&self) -> Option<Self> {
        self.reciprocal()?.short()
    }

    /// `1 / x`, of any length; `None` for zero and if a radicand exceeds 64 bits.
    pub(super) fn reciprocal(&self) -> Option<Self> {
        if self.is_zero() {
            return None;
        }
        let Some(generator) = self.generator() else {
            return Some(Self::long_rational(&self.as_rational()?.recip()));
        };
        // the product of all images under the automorphism is a number of the smaller field
        let mut others = self.image(generator);
        if generator == Generator::Ninth {
            others = others.product(&others.image(generator))?;
        }
        others.product(&self.product(&others)?.reciprocal()?)
    }

    /// The non-negative square root; `None` for negative numbers and if it is not among these sums.
    pub fn sqrt(&self) -> Option<Self> {
        if let Some(root) = self.root(MAX_NESTING) {
            return Some(root);
        }
        // sqrt(2 + sqrt 2) = 2cos 22.5, for example: the quotient by the square of a cosine may have a root
        let divisions: Vec<u32> = self.divisions().collect();
        let cosine = |over: u64, division: u32, tower: usize, k: u32| {
            let asked = self.radicands().any(|r| r.is_multiple_of(over)) || divisions.contains(&division);
            asked.then(|| Self::twice_cosine(tower, k)).flatten()
        };
        [cosine(2, 16, 0, 2), cosine(5, 20, 1, 1), cosine(0, 16, 0, 1)].into_iter().flatten().find_map(|c| {
            let quotient = self.times(&c.times(&c)?.inverse()?)?;
            let root = quotient.root(MAX_NESTING)?.times(&c)?;
            (root.times(&root)? == *self).then_some(root)
        })
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
        let generator = self.generator().filter(|g| depth > 0 && *g != Generator::Ninth)?;
        // (u + v)^2 = a + b, and a - b is the image of a + b: u^2 = (a +- c) / 2, c^2 = (a + b)(a - b), v = b / (2 u)
        let half = Self::rational(&Rational::new(1.into(), 2.into()))?;
        let image = self.image(generator);
        let (a, tail) = (self.plus(&image)?.times(&half)?, self.minus(&image)?.times(&half)?);
        let c = self.times(&image)?.root(depth - 1)?;
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

    /// `2cos(k 360 / n)` degrees of the tower with this index.
    fn twice_cosine(tower: usize, k: u32) -> Option<Self> {
        let terms = FieldRoot::four_cosines(tower, k).into_iter().map(|(r, c)| (r, BigInt::from(c)));
        Self::lowest(terms.collect(), BigInt::from(2))
    }

    /// Cosine and sine of `degrees`, if they are in the field. They are at multiples of a quarter of a degree whose
    /// cosine has a degree of at most 16.
    pub fn turn(degrees: &Rational) -> Option<(Self, Self)> {
        let quarters = degrees * Rational::from_integer(4.into());
        if !quarters.is_integer() {
            return None;
        }
        // a / 1440 = i / 32 + j / 5 + k / 9 of a turn
        let a = u32::try_from(quarters.to_integer().mod_floor(&1440.into())).ok()?;
        let (i, j, k) = (5 * a % 32, 2 * a % 5, 4 * a % 9);
        if degree(a) > MAX_TERMS {
            return None;
        }
        let over = |x: Self, d: i64| x.times(&Self::integer(d).inverse()?);
        let cosine = |tower: usize, k: u32| over(Self::twice_cosine(tower, k)?, 2);
        let first = [cosine(0, i)?, cosine(0, i + 24)?];
        let second = [cosine(1, 4 * j)?, cosine(1, 4 * j + 15)?];
        // sqrt(3) 2sin t = 2cos(t - 120) - 2cos(t + 120)
        let sine = Self::twice_cosine(2, k + 6)?.minus(&Self::twice_cosine(2, k + 3)?)?;
        let third = [cosine(2, k)?, over(sine.times(&Self::integer(3).sqrt()?)?, 6)?];
        let sum = |[c, s]: &[Self; 2], [d, t]: &[Self; 2]| {
            Some([c.times(d)?.minus(&s.times(t)?)?, s.times(d)?.plus(&c.times(t)?)?])
        };
        let [cosine, sine] = sum(&sum(&first, &second)?, &third)?;
        Some((cosine, sine))
    }

    /// Rationals below and above it, closer together than `2^-bits` of its magnitude; both are the number if it is
    /// rational.
    pub fn between(&self, bits: u64) -> (Rational, Rational) {
        if let Some(x) = self.as_rational() {
            return (x.clone(), x);
        }
        let mut k = bits + 16;
        loop {
            let sum: BigInt = self.terms.iter().map(|(r, c)| r.scaled(c, k)).sum();
            let error = BigInt::from(2 * self.terms.len());
            if sum.bits() > error.bits() + bits {
                let scale = &self.denominator << k;
                // bounds need not be in lowest terms
                return (
                    Rational::new_raw(&sum - &error, scale.clone()),
                    Rational::new_raw(sum + error, scale),
                );
            }
            k *= 2;
        }
    }

    /// An upper bound of its distance from a finite double; zero if it is the double.
    pub fn distance_from(&self, double: f64) -> f64 {
        let (low, high) = self.between(160);
        farthest(double, &low, &high)
    }

    /// The exponent of a power of two above all conjugates.
    pub fn magnitude_bits(&self) -> i64 {
        let bits = |(r, c): (&FieldRoot, &BigInt)| c.bits() + r.magnitude_bits();
        let largest = self.terms.iter().map(bits).max().unwrap_or(0);
        let terms = self.terms.len().next_power_of_two().trailing_zeros();
        (largest + u64::from(terms) + 1).cast_signed() - self.denominator.bits().cast_signed()
    }

    /// The comparison with zero.
    pub fn sign(&self) -> Ordering {
        if self.is_zero() {
            return Ordering::Equal;
        }
        // both ends have the sign of the number
        self.between(8).0.cmp(&Rational::zero())
    }

    /// The nearest double.
    pub fn nearest(&self) -> f64 {
        let mut bits = 80;
        loop {
            let (low, high) = self.between(bits);
            let (low, high) = (nearest(&low), nearest(&high));
            // an irrational number is never half way between two doubles
            if low.total_cmp(&high).is_eq() {
                return low;
            }
            bits *= 2;
        }
    }
}

/// The sum of products; `None` if it becomes too long.
pub fn combination(weights: &[Surd], values: &[Surd]) -> Option<Surd> {
    weights.iter().zip(values).try_fold(Surd::zero(), |sum, (w, x)| sum.plus(&w.times(x)?))
}

/// Degree of the field of cosine and sine of `a / 1440` of a turn: of `2cos(360 / n)` with `n` a multiple of four.
fn degree(a: u32) -> usize {
    let n = (1440 / a.gcd(&1440)).lcm(&4);
    // Euler's function, for numbers with only these prime factors
    let units =
        [2, 3, 5].into_iter().filter(|p| n.is_multiple_of(*p)).fold(n, |units, p| units / p * (p - 1));
    (units / 2).max(1) as usize
}

/// The square root of a positive fraction.
fn rational_root(x: &Rational) -> Option<Surd> {
    // sqrt(n / d) = sqrt(n d) / d
    let (square, radicand) = squarefree(x.numer() * x.denom())?;
    Surd::lowest(BTreeMap::from([(FieldRoot::of(radicand), square)]), x.denom().clone())
}

/// `s` and squarefree `r` with `n = s^2 r`, `n` positive; `None` if small primes cannot prove `r` squarefree, or if it
/// is too large.
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
    // no factors below TRIAL: below its cube at most two prime factors, and these differ
    let rest = u64::try_from(n).ok().filter(|n| *n < TRIAL.pow(3))?;
    Some((square, free.checked_mul(rest)?))
}

/// The number as an expression, for example `1/2 + 3*sqrt(2)/4` or `sqrt(3)*cos_deg(40)/2`.
impl fmt::Display for Surd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_zero() {
            return f.write_str("0");
        }
        for (i, (r, c)) in self.terms.iter().enumerate() {
            // twice a cosine each
            let twos = r.cosines().count();
            let share = Rational::new(c.abs() << twos, self.denominator.clone());
            let sign = match (i, c.is_negative()) {
                (0, false) => "",
                (0, true) => "-",
                (_, false) => " + ",
                (_, true) => " - ",
            };
            f.write_str(sign)?;
            let number = (*r == FieldRoot::ONE || !share.numer().is_one()).then(|| share.numer().to_string());
            let root = (r.radicand() > 1).then(|| format!("sqrt({})", r.radicand()));
            let cosines =
                r.cosines().map(|(n, k)| format!("cos_deg({})", 360.0 * f64::from(k) / f64::from(n)));
            let factors: Vec<String> = number.into_iter().chain(root).chain(cosines).collect();
            f.write_str(&factors.join("*"))?;
            if !share.denom().is_one() {
                write!(f, "/{}", share.denom())?;
            }
        }
        Ok(())
    }
}

/// Integers whose square roots generate the same field, together with the cosines of these divisions. The squarefree
/// radicands are ascending. A root is left out if it is a fraction times a product of two or three earlier ones. A
/// cosine is left out if its double is present.
pub fn generators(radicands: &[u64], divisions: &mut Vec<u32>) -> Vec<u64> {
    if divisions.contains(&32) {
        divisions.retain(|n| *n != 16);
    }
    // sqrt(2) is in the field of cos(22.5), sqrt(5) in that of cos(18)
    let known: Vec<u64> = [(16, 2), (32, 2), (20, 5)]
        .into_iter()
        .filter(|(n, _)| divisions.contains(n))
        .map(|(_, r)| r)
        .collect();
    // the squarefree part of a product of squarefree integers
    let product = |a: u64, b: u64| {
        let g = a.gcd(&b);
        (a / g).checked_mul(b / g)
    };
    let mut kept: Vec<u64> = known.clone();
    for r in radicands {
        let rest: Vec<u64> = kept.iter().filter_map(|k| product(*k, *r)).collect();
        let two = rest.iter().any(|x| kept.contains(x));
        let three =
            kept.iter().flat_map(|k| rest.iter().filter_map(|x| product(*k, *x))).any(|x| kept.contains(&x));
        if !(two || three) {
            // with sqrt(2), sqrt(6) is equivalent to sqrt(3)
            kept.push(rest.into_iter().fold(*r, u64::min));
        }
    }
    kept.split_off(known.len())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn fraction(n: i64, d: i64) -> Rational {
        Rational::new(n.into(), d.into())
    }

    fn degrees(n: i64, d: i64) -> (Surd, Surd) {
        Surd::turn(&fraction(n, d)).unwrap()
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
        let double = |x: &BigInt| nearest(&Rational::from_integer(x.clone()));
        let cosine = |(n, k): (u32, u32)| 2.0 * (f64::from(360 * k) / f64::from(n)).to_radians().cos();
        let root = |r: &FieldRoot| (r.radicand() as f64).sqrt() * r.cosines().map(cosine).product::<f64>();
        x.terms.iter().map(|(r, c)| double(c) * root(r)).sum::<f64>() / double(&x.denominator)
    }

    fn any_sum() -> impl Strategy<Value = Surd> {
        let term = (-30i64..30, 1i64..12, prop::sample::select(vec![1u64, 2, 3, 5, 6, 10, 15, 12]));
        prop::collection::vec(term, 0..4).prop_map(|parts| sum(&parts))
    }

    /// Sums with cosines of one field, whose degree is at most 16.
    fn any_cosines() -> impl Strategy<Value = [Surd; 3]> {
        let fields = vec![(16i64, 3u64), (32, 3), (20, 3), (9, 3), (36, 5), (60, 2), (80, 7), (72, 2)];
        let term = (-9i64..9, 1i64..5, 0i64..80, any::<bool>());
        let list = prop::collection::vec(prop::collection::vec(term, 0..4), 3);
        (prop::sample::select(fields), list).prop_map(|((n, r), list)| {
            let one = |parts: Vec<(i64, i64, i64, bool)>| {
                parts.into_iter().fold(Surd::zero(), |s, (c, d, k, with)| {
                    let (cosine, sine) = degrees(360 * k, n);
                    let share = sum(&[(c, d, if with { r } else { 1 })]);
                    let x = if c % 2 == 0 { cosine } else { sine };
                    s.plus(&share.times(&x).unwrap()).unwrap()
                })
            };
            let [x, y, z] = <[_; 3]>::try_from(list).unwrap();
            [one(x), one(y), one(z)]
        })
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
        fn sums_with_cosines_are_a_field([x, y, z] in any_cosines()) {
            let v = value(&x);
            prop_assert!((x.nearest() - v).abs() <= 1e-12 * (1.0 + v.abs()));
            if v.abs() > 1e-9 {
                prop_assert_eq!(x.sign(), v.total_cmp(&0.0));
            }
            let product = x.times(&y);
            prop_assert_eq!(&product, &y.times(&x));
            if let (Some(xy), Some(yz)) = (product, y.times(&z)) {
                prop_assert!((value(&xy) - v * value(&y)).abs() <= 1e-11 * (1.0 + (v * value(&y)).abs()));
                if let (Some(a), Some(b)) = (xy.times(&z), x.times(&yz)) {
                    prop_assert_eq!(a, b);
                }
            }
            if let Some(inverse) = x.inverse() {
                prop_assert_eq!(x.times(&inverse), Some(Surd::integer(1)));
            }
            if let Some(found) = x.times(&x).and_then(|s| s.sqrt()) {
                prop_assert!(found == x || found == x.negated());
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
            // nested roots are found for two square roots under the root
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
        assert_eq!(sum(&[(3, 1, 1), (1, 1, 2)]).sqrt(), None, "sqrt(3 + sqrt 2) is in no such field");
        let eight = |n: i64, d: i64| degrees(n, d).0.times(&Surd::integer(8)).unwrap();
        for (under, degrees) in [
            (sum(&[(32, 1, 1), (16, 1, 2)]), (45, 2)),
            (sum(&[(32, 1, 1), (-16, 1, 2)]), (135, 2)),
            (sum(&[(40, 1, 1), (8, 1, 5)]), (18, 1)),
            (sum(&[(40, 1, 1), (-8, 1, 5)]), (54, 1)),
            (eight(45, 2).plus(&Surd::integer(8)).unwrap().times(&Surd::integer(4)).unwrap(), (45, 4)),
        ] {
            assert_eq!(under.sqrt(), Some(eight(degrees.0, degrees.1)), "{under}");
        }
        assert_eq!(Surd::integer(-1).sqrt(), None);
        assert_eq!(Surd::rational(&fraction(8, 27)).unwrap().sqrt(), Some(sum(&[(2, 9, 6)])));
    }

    #[test]
    fn angles_are_exact_where_their_field_is_small() {
        let mut exact = 0;
        for quarters in -1440..2880 {
            let angle = fraction(quarters, 4);
            let Some((c, s)) = Surd::turn(&angle) else {
                assert_ne!(quarters % 15, 0, "every multiple of 3.75 degrees");
                assert_ne!(quarters % 20, 0, "every multiple of 5 degrees");
                assert_ne!(quarters % 12, 0, "every multiple of 3 degrees");
                assert_ne!(quarters % 45, 0, "every multiple of 11.25 degrees");
                continue;
            };
            exact += 1;
            let radians = nearest(&angle).to_radians();
            assert!((value(&c) - radians.cos()).abs() < 1e-13, "{quarters}");
            assert!((value(&s) - radians.sin()).abs() < 1e-13, "{quarters}");
            if quarters % 15 == 0 {
                let one = c.times(&c).unwrap().plus(&s.times(&s).unwrap()).unwrap();
                assert_eq!(one, Surd::integer(1), "{quarters}");
            }
        }
        assert!((800..2000).contains(&exact), "{exact}");
        assert_eq!(Surd::turn(&fraction(1, 7)), None);
        assert_eq!(Surd::turn(&fraction(1, 1)), None, "of degree 48");
        // the ratio of diagonal and side of a pentagon, and a heptagon as the negative control
        let golden = degrees(54, 1).1.times(&degrees(18, 1).1.inverse().unwrap()).unwrap();
        assert_eq!(golden, sum(&[(3, 2, 1), (1, 2, 5)]));
        assert_eq!(degrees(15, 1).0, sum(&[(1, 4, 6), (1, 4, 2)]));
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
        assert_eq!(degrees(80, 1).0.to_string(), "cos_deg(80)");
        let both = degrees(45, 2).0.times(&degrees(54, 1).0).unwrap();
        assert_eq!(
            both.times(&sum(&[(3, 4, 3)])).unwrap().to_string(),
            "3*sqrt(3)*cos_deg(22.5)*cos_deg(54)/4"
        );
        assert_eq!(Surd::integer(-7).to_string(), "-7");
        assert_eq!(Surd::zero().to_string(), "0");
    }
}
