//! Products of a square root and of cosines of fractions of a turn. They are a basis, over the fractions, of a real
//! field closed under products.
//!
//! Besides the square roots of integers there are three towers: `2 cos(k 360/32)`, `2 cos(k 360/20)` and
//! `2 cos(k 360/9)` degrees. Their fields have the degrees 8, 4 and 3. The first contains `sqrt(2)`, the second
//! `sqrt(5)`, and any two of them share only the fractions. Square roots of integers without the factors 2 and 5 are
//! independent of all three. The reason is that only the primes 2, 3 and 5 ramify there, and `sqrt(3)` is in none of
//! them. So each number of the compositum is one sum of fractions times the [`FieldRoot`]s (Washington 1997, chapter 2,
//! for the fields and their intersections).

use num_bigint::BigInt;
use num_integer::Integer as _;
use num_traits::{One, Zero};

/// The towers: cosines of multiples of a turn divided by these numbers.
const TOWERS: [u32; 3] = [32, 20, 9];
/// Index of `sqrt(2)` in the first tower.
const SQRT_2: u8 = 4;
/// Additional bits of the fixed-point values.
const GUARD: u64 = 16;

/// `sqrt(r) 2cos(i 360/32) 2cos(j 360/20) 2cos(k 360/9)` with `r` squarefree; an index 0 omits its cosine.
///
/// For `i` 1, 2, 3, 5, 6 or 7, `r` is odd. For `j` 1 or 3, 5 does not divide `r`. `k` is 1 or 2.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct FieldRoot {
    radicand: u64,
    cosines: [u8; 3],
}

/// An automorphism over the largest subfield without the given generator.
///
/// The first in this order are eliminated first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Generator {
    /// `2cos 40`, of degree three.
    Ninth,
    /// `2cos 11.25` over `2cos 22.5`.
    ThirtySecond,
    /// `2cos 22.5` over `sqrt 2`.
    Sixteenth,
    /// `2cos 18` over `sqrt 5`.
    Twentieth,
    /// The square root of a prime.
    Prime(u64),
}

impl FieldRoot {
    pub(super) const ONE: Self = Self { radicand: 1, cosines: [0; 3] };

    /// The square root of a squarefree number.
    pub(super) fn of(radicand: u64) -> Self {
        Self { radicand, ..Self::ONE }
    }

    /// The terms that sum up to `4cos(k 360 / n)` for the tower `n = 32, 20, 9`.
    pub(super) fn four_cosines(tower: usize, k: u32) -> Vec<(Self, i64)> {
        let n = TOWERS[tower];
        // from 0 to half a turn
        let k = (k % n).min(n - k % n) as u8;
        let cosine = |k: u8| {
            let mut cosines = [0; 3];
            cosines[tower] = k;
            Self { radicand: 1, cosines }
        };
        let minus = |k: u8| -> Vec<_> {
            Self::four_cosines(tower, u32::from(k)).into_iter().map(|(r, c)| (r, -c)).collect()
        };
        match (tower, k) {
            (_, 0) => vec![(Self::ONE, 4)],
            (0, 8) | (1, 5) => Vec::new(),
            (0, 9..) => minus(16 - k),
            (0, SQRT_2) => vec![(Self::of(2), 2)],
            (1, 6..) => minus(10 - k),
            (1, 2) => vec![(Self::ONE, 1), (Self::of(5), 1)],
            (1, 4) => vec![(Self::ONE, -1), (Self::of(5), 1)],
            (2, 3) => vec![(Self::ONE, -2)],
            (2, 4) => vec![(cosine(1), -2), (cosine(2), -2)],
            _ => vec![(cosine(k), 2)],
        }
    }

    pub(super) fn radicand(self) -> u64 {
        self.radicand
    }

    /// Whether it is a square root alone.
    pub(super) fn is_plain(self) -> bool {
        self.cosines == [0; 3]
    }

    /// Its cosines, as numbers `n` and `k` without a common factor: `2cos(k 360 / n)` degrees.
    pub(super) fn cosines(self) -> impl Iterator<Item = (u32, u32)> {
        let cosines = TOWERS.into_iter().zip(self.cosines.map(u32::from)).filter(|(_, k)| *k > 0);
        cosines.map(|(n, k)| (n / n.gcd(&k), k / n.gcd(&k)))
    }

    /// Whether it has a cosine whose square is half of an integer of the basis.
    pub(super) fn has_twentieth(self) -> bool {
        self.cosines[1] > 0
    }

    /// The numbers that sum up to the product of two, or to twice the product if `doubled`; two numbers with
    /// [`Self::has_twentieth`] require that.
    ///
    /// `None` if a radicand is too large.
    pub(super) fn times(self, other: Self, doubled: bool) -> Option<Vec<(Self, i64)>> {
        let two = if doubled { 2 } else { 1 };
        let (r, s) = (self.coprime_part(), other.coprime_part());
        // sqrt(r) sqrt(s) = g sqrt(r s / g^2)
        let g = r.gcd(&s);
        let radicand = (r / g).checked_mul(s / g)?;
        let common = i64::try_from(g).ok()?;
        let thirty_seconds = of_thirty_seconds(self.thirty_second(), other.thirty_second());
        let (twentieths, halved) = of_twentieths(self.twentieth(), other.twentieth());
        let ninths = of_ninths(self.cosines[2], other.cosines[2]);
        let mut out = Vec::with_capacity(thirty_seconds.len() * twentieths.len() * ninths.len());
        for (i, a) in &thirty_seconds {
            for (j, b) in &twentieths {
                for (k, c) in &ninths {
                    let two_part = if *i == SQRT_2 { 2 } else { 1 };
                    let five_part = if *j == Twentieth::Sqrt5 { 5 } else { 1 };
                    let root = Self {
                        radicand: radicand.checked_mul(two_part * five_part)?,
                        cosines: [if *i == SQRT_2 { 0 } else { *i }, j.index(), *k],
                    };
                    let factor = common.checked_mul(a * b * c * if halved { 1 } else { two })?;
                    out.push((root, factor));
                }
            }
        }
        Some(out)
    }

    /// The radicand without 2 and 5.
    fn coprime_part(self) -> u64 {
        let odd = if self.radicand.is_multiple_of(2) { self.radicand / 2 } else { self.radicand };
        if odd.is_multiple_of(5) { odd / 5 } else { odd }
    }

    fn thirty_second(self) -> u8 {
        if self.radicand.is_multiple_of(2) { SQRT_2 } else { self.cosines[0] }
    }

    fn twentieth(self) -> Twentieth {
        match self.cosines[1] {
            1 => Twentieth::Cos18,
            3 => Twentieth::Cos54,
            _ if self.radicand.is_multiple_of(5) => Twentieth::Sqrt5,
            _ => Twentieth::One,
        }
    }

    /// Its generator that is eliminated first.
    pub(super) fn generator(self) -> Option<Generator> {
        match self.cosines {
            [0, 0, 0] => some_prime(self.radicand).map(Generator::Prime),
            [0, _, 0] => Some(Generator::Twentieth),
            [i, _, 0] if i % 2 == 0 => Some(Generator::Sixteenth),
            [_, _, 0] => Some(Generator::ThirtySecond),
            _ => Some(Generator::Ninth),
        }
    }

    /// The numbers that sum up to its image under the automorphism.
    pub(super) fn image(self, generator: Generator) -> Vec<(Self, i64)> {
        let negated = match generator {
            Generator::Ninth => {
                // 40 -> 80 -> 160 degrees
                let rest = Self { cosines: [self.cosines[0], self.cosines[1], 0], ..self };
                let image = |k: u8| Self { cosines: [rest.cosines[0], rest.cosines[1], k], ..rest };
                return match self.cosines[2] {
                    0 => vec![(self, 1)],
                    1 => vec![(image(2), 1)],
                    _ => vec![(image(1), -1), (image(2), -1)],
                };
            }
            Generator::ThirtySecond => self.cosines[0] % 2 == 1,
            Generator::Sixteenth => self.cosines[0] > 0,
            Generator::Twentieth => self.cosines[1] > 0,
            Generator::Prime(p) => self.radicand.is_multiple_of(p),
        };
        vec![(self, if negated { -1 } else { 1 })]
    }

    /// The exponent of a power of two above it and all its conjugates.
    pub(super) fn magnitude_bits(self) -> u64 {
        // a square root has at most half the bits of its radicand, rounded up
        let root = u64::from(u64::BITS - self.radicand.leading_zeros()).div_ceil(2);
        root + self.cosines().count() as u64
    }

    /// `c` times it times `2^k`, with an error below two.
    pub(super) fn scaled(self, c: &BigInt, k: u64) -> BigInt {
        if self.is_plain() {
            let root = ((c * c * self.radicand) << (2 * k)).sqrt();
            return if c.sign() == num_bigint::Sign::Minus { -root } else { root };
        }
        // errors of 2^-bits in factors whose product is below 2^magnitude; four of them are together below
        // 2^(magnitude + 3 - bits)
        let bits = k + c.bits() + self.magnitude_bits() + GUARD;
        let root = (BigInt::from(self.radicand) << (2 * bits)).sqrt();
        let product = self.cosines().fold(root, |x, (n, i)| (x * twice_cosine(n, i, bits)) >> bits);
        (product * c) >> (bits - k)
    }
}

/// An element of the second tower, with `sqrt(5) = 4 cos(36) - 1`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Twentieth {
    One,
    Sqrt5,
    Cos18,
    Cos54,
}

impl Twentieth {
    fn index(self) -> u8 {
        match self {
            Self::One | Self::Sqrt5 => 0,
            Self::Cos18 => 1,
            Self::Cos54 => 3,
        }
    }
}

/// `2cos a 2cos b = 2cos(a + b) + 2cos(a - b)` for multiples of 11.25 degrees; the index 0 is the number one.
fn of_thirty_seconds(i: u8, j: u8) -> Vec<(u8, i64)> {
    if i == 0 || j == 0 {
        return vec![(i + j, 1)];
    }
    let one = |k: u8| match k {
        0 => Some((0, 2)),
        1..8 => Some((k, 1)),
        8 => None,
        _ => Some((16 - k, -1)),
    };
    [one(i + j), one(i.abs_diff(j))].into_iter().flatten().collect()
}

/// The product, and whether twice the product.
fn of_twentieths(x: Twentieth, y: Twentieth) -> (Vec<(Twentieth, i64)>, bool) {
    use Twentieth::{Cos18, Cos54, One, Sqrt5};
    match (x, y) {
        (One, z) | (z, One) => (vec![(z, 1)], false),
        (Sqrt5, Sqrt5) => (vec![(One, 5)], false),
        (Sqrt5, Cos18) | (Cos18, Sqrt5) => (vec![(Cos54, 2), (Cos18, 1)], false),
        (Sqrt5, Cos54) | (Cos54, Sqrt5) => (vec![(Cos18, 2), (Cos54, -1)], false),
        (Cos18, Cos54) | (Cos54, Cos18) => (vec![(Sqrt5, 1)], false),
        (Cos18, Cos18) => (vec![(One, 5), (Sqrt5, 1)], true),
        (Cos54, Cos54) => (vec![(One, 5), (Sqrt5, -1)], true),
    }
}

/// The same as for the first tower, with `2cos 160 = -2cos 40 - 2cos 80` and `2cos 120 = -1`.
fn of_ninths(i: u8, j: u8) -> Vec<(u8, i64)> {
    match (i, j) {
        (0, k) | (k, 0) => vec![(k, 1)],
        (1, 1) => vec![(0, 2), (2, 1)],
        (2, 2) => vec![(0, 2), (1, -1), (2, -1)],
        _ => vec![(0, -1), (1, 1)],
    }
}

/// A prime that divides a squarefree number above 1.
fn some_prime(r: u64) -> Option<u64> {
    if r == 1 {
        return None;
    }
    (2..super::surd::TRIAL).take_while(|p| p * p <= r).find(|p| r.is_multiple_of(*p)).or(Some(r))
}

/// `2cos(k 360 / n) 2^bits` with an error below one, for a cosine of the basis.
fn twice_cosine(n: u32, k: u32, bits: u64) -> BigInt {
    let fixed = bits + GUARD;
    let value = match n {
        32 => halved(k, fixed),
        16 => halved(2 * k, fixed),
        20 => {
            // 2cos 36 = (1 + sqrt 5) / 2, 2cos 108 = (1 - sqrt 5) / 2, and half of these angles
            let root = (BigInt::from(5) << (2 * fixed)).sqrt();
            let double = ((BigInt::one() << fixed) + if k == 1 { root } else { -root }) >> 1;
            half_angle(&double, fixed)
        }
        _ => of_cubic(k, fixed),
    };
    value >> GUARD
}

/// `2cos(t / 2) = sqrt(2 + 2cos t)` for `t` up to half a turn, as fixed-point numbers.
fn half_angle(twice_cosine: &BigInt, fixed: u64) -> BigInt {
    (((BigInt::from(2) << fixed) + twice_cosine) << fixed).sqrt()
}

/// `2cos(k 11.25 degrees)`, `k` at most 16: the angle is doubled until its cosine is known.
fn halved(k: u32, fixed: u64) -> BigInt {
    match k {
        0 => BigInt::from(2) << fixed,
        8 => BigInt::zero(),
        9.. => -halved(16 - k, fixed),
        _ => half_angle(&halved(2 * k, fixed), fixed),
    }
}

/// `2cos 40` and `2cos 80` by Newton's method, as zeros of `x^3 - 3x + 1`: `2cos 3t = x^3 - 3x` is -1 at 120 and 240
/// degrees.
fn of_cubic(k: u32, fixed: u64) -> BigInt {
    let start = 2.0 * f64::from(40 * k).to_radians().cos();
    let mut x = (BigInt::from((start * 2f64.powi(50)) as i64) << fixed) >> 50u32;
    let one = BigInt::one() << fixed;
    loop {
        let square = (&x * &x) >> fixed;
        let value = ((&square * &x) >> fixed) - 3 * &x + &one;
        let step = (value << fixed) / (3 * (square - &one));
        x -= &step;
        if step.bits() <= 2 {
            return x;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(root: FieldRoot) -> f64 {
        root.cosines().fold((root.radicand as f64).sqrt(), |x, (n, k)| {
            x * 2.0 * (f64::from(k) * std::f64::consts::TAU / f64::from(n)).cos()
        })
    }

    fn basis() -> Vec<FieldRoot> {
        let mut all = Vec::new();
        for radicand in [1u64, 2, 3, 5, 6, 10, 30] {
            for i in [0u8, 1, 2, 3, 5, 6, 7].into_iter().filter(|i| *i == 0 || radicand % 2 == 1) {
                for j in [0u8, 1, 3].into_iter().filter(|j| *j == 0 || radicand % 5 != 0) {
                    all.extend([0, 1, 2].map(|k| FieldRoot { radicand, cosines: [i, j, k] }));
                }
            }
        }
        all
    }

    #[test]
    fn cosines_of_all_towers_are_sums_of_the_basis() {
        for (tower, n) in TOWERS.into_iter().enumerate() {
            for k in 0..2 * n {
                let sum: f64 =
                    FieldRoot::four_cosines(tower, k).iter().map(|(r, c)| *c as f64 * value(*r)).sum();
                let expected = 4.0 * (f64::from(k) * std::f64::consts::TAU / f64::from(n)).cos();
                assert!((sum - expected).abs() < 1e-13, "{n} {k}");
            }
        }
    }

    #[test]
    fn products_of_the_basis_are_in_its_span() {
        let basis = basis();
        for x in &basis {
            for y in &basis {
                let doubled = x.has_twentieth() && y.has_twentieth();
                let product = x.times(*y, doubled).unwrap();
                let sum: f64 = product.iter().map(|(r, c)| *c as f64 * value(*r)).sum();
                let expected = value(*x) * value(*y) * if doubled { 2.0 } else { 1.0 };
                assert!((sum - expected).abs() < 1e-12 * (1.0 + expected), "{x:?} {y:?}");
                assert!(product.iter().all(|(r, _)| basis.contains(r) || r.radicand == 15), "{product:?}");
            }
        }
    }

    #[test]
    fn images_respect_products() {
        let generators = [Generator::Ninth, Generator::ThirtySecond, Generator::Twentieth];
        let image = |sum: &[(FieldRoot, i64)], g: Generator| {
            let mut out = std::collections::BTreeMap::new();
            for (r, c) in sum {
                for (s, d) in r.image(g) {
                    *out.entry(s).or_insert(0) += c * d;
                }
            }
            out.retain(|_, c| *c != 0);
            out
        };
        for g in generators {
            for x in basis() {
                for y in basis() {
                    let of_product = image(&x.times(y, true).unwrap(), g);
                    let mut product = Vec::new();
                    for (r, c) in x.image(g) {
                        for (s, d) in y.image(g) {
                            product
                                .extend(r.times(s, true).unwrap().into_iter().map(|(t, e)| (t, c * d * e)));
                        }
                    }
                    let product =
                        product.iter().fold(std::collections::BTreeMap::new(), |mut sum, (r, c)| {
                            *sum.entry(*r).or_insert(0) += c;
                            sum
                        });
                    let product: std::collections::BTreeMap<_, _> =
                        product.into_iter().filter(|(_, c)| *c != 0).collect();
                    assert_eq!(of_product, product, "{g:?} {x:?} {y:?}");
                }
            }
        }
    }

    #[test]
    fn fixed_point_values_are_those_of_the_cosines() {
        for root in basis() {
            let scaled = root.scaled(&BigInt::from(-3), 40);
            let expected = -3.0 * value(root) * 2f64.powi(40);
            assert!((scaled.to_string().parse::<f64>().unwrap() - expected).abs() < 2.1, "{root:?}");
            // the same to more digits, cut off
            let longer: BigInt = root.scaled(&BigInt::from(-3), 900) >> 860u32;
            assert!((longer - scaled).bits() <= 2, "{root:?}");
        }
        // 2cos 40 solves its cubic to a thousand bits, and a neighbour does not
        let x = twice_cosine(9, 1, 1000);
        let cubic = |x: &BigInt| -> BigInt { x * x * x - ((3 * x) << 2000u32) + (BigInt::one() << 3000u32) };
        assert!(cubic(&x).bits() < 2004);
        assert!(cubic(&(&x + (1 << 20))).bits() > 2015);
    }
}
