//! Ranks modulo primes, for exact decisions about matrices with integer entries of many digits.
//!
//! Arithmetic modulo `p` is exact and of fixed size. A minor that is nonzero modulo one prime is nonzero. A minor that
//! is zero modulo primes whose product exceeds its absolute value is zero.

use num_bigint::{BigInt, Sign};

use super::Rng;

/// The field of integers modulo a prime below `2^61`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Field {
    prime: u64,
    /// `floor(2^124 / p)`, below `2^64`, for primes between `2^60` and `2^61`; otherwise zero.
    reciprocal: u64,
}

/// Guaranteed bits of every prime of [`fields`]: all are above `2^60`.
pub const PRIME_BITS: u32 = 60;

/// Prime fields below `2^61`, largest first, practically without end; the first is [`Field::MERSENNE`].
pub(crate) fn all_fields() -> impl Iterator<Item = Field> {
    (1u64..).map(|k| (1u64 << 61) + 1 - 2 * k).filter(|n| is_prime(*n)).map(Field::modulo)
}

/// The `count` first of `all_fields`.
pub fn fields(count: usize) -> Vec<Field> {
    all_fields().take(count).collect()
}

impl Field {
    /// The field of the Mersenne prime `2^61 - 1`.
    pub const MERSENNE: Self = Self::modulo((1 << 61) - 1);

    /// The integers modulo any number.
    pub(crate) const fn modulo(prime: u64) -> Self {
        let reciprocal = if prime >> PRIME_BITS == 1 { ((1u128 << 124) / prime as u128) as u64 } else { 0 };
        Self { prime, reciprocal }
    }

    /// The field of a prime drawn uniformly from those between `2^60` and `2^61`.
    pub fn drawn(rng: &mut Rng) -> Self {
        loop {
            let n = (1 << 60) | (rng.next_u64() >> 4) | 1;
            if is_prime(n) {
                return Self::modulo(n);
            }
        }
    }

    /// The prime.
    pub fn prime(self) -> u64 {
        self.prime
    }

    /// The residue of an integer of any size.
    pub fn residue(self, x: &BigInt) -> u64 {
        let p = u128::from(self.prime);
        let digits = x.magnitude().iter_u64_digits().rev();
        let r = digits.fold(0u128, |r, d| ((r << 64) | u128::from(d)) % p) as u64;
        if x.sign() == Sign::Minus { self.sub(0, r) } else { r }
    }

    /// The residue of an integer.
    pub fn integer(self, x: i64) -> u64 {
        let r = x.unsigned_abs() % self.prime;
        if x < 0 { self.sub(0, r) } else { r }
    }

    /// The residue of `x 2^shift` for a finite double, also for a fraction (2 has an inverse).
    pub fn scaled(self, x: f64, shift: i32) -> u64 {
        let (mantissa, exponent) = mantissa_and_exponent(x);
        self.mul(self.integer(mantissa), self.power_of_two(exponent + shift))
    }

    fn power_of_two(self, exponent: i32) -> u64 {
        // (p + 1) / 2 is the inverse of 2
        let base = if exponent < 0 { self.prime.div_ceil(2) } else { 2 };
        self.pow(base, u64::from(exponent.unsigned_abs()))
    }

    /// `x + y`.
    #[inline]
    pub fn add(self, x: u64, y: u64) -> u64 {
        let sum = x + y;
        if sum >= self.prime { sum - self.prime } else { sum }
    }

    /// `x - y`.
    #[inline]
    pub fn sub(self, x: u64, y: u64) -> u64 {
        if x >= y { x - y } else { x + self.prime - y }
    }

    /// `x y`.
    #[inline]
    pub fn mul(self, x: u64, y: u64) -> u64 {
        self.reduced(u128::from(x) * u128::from(y))
    }

    /// The residue of a number below `2^124` (Barrett 1986).
    #[inline]
    pub(crate) fn reduced(self, x: u128) -> u64 {
        if self.reciprocal == 0 {
            return (x % u128::from(self.prime)) as u64;
        }
        let quotient = (((x >> PRIME_BITS) * u128::from(self.reciprocal)) >> 64) as u64;
        // the quotient is too small by at most two
        let mut rest = (x - u128::from(quotient) * u128::from(self.prime)) as u64;
        while rest >= self.prime {
            rest -= self.prime;
        }
        rest
    }

    /// `base` to the power `exponent`.
    pub fn pow(self, mut base: u64, mut exponent: u64) -> u64 {
        let mut result = 1;
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = self.mul(result, base);
            }
            base = self.mul(base, base);
            exponent >>= 1;
        }
        result
    }

    /// The inverse of a nonzero number.
    pub fn inverse(self, x: u64) -> u64 {
        self.pow(x, self.prime - 2)
    }

    /// A square root, if there is one (Tonelli 1891, Shanks 1973).
    pub(crate) fn square_root(self, x: u64) -> Option<u64> {
        let p = self.prime;
        if x == 0 {
            return Some(0);
        }
        let is_square = |x: u64| self.pow(x, (p - 1) / 2) == 1;
        if !is_square(x) {
            return None;
        }
        let twos = (p - 1).trailing_zeros();
        let odd = (p - 1) >> twos;
        let other = (2..p).find(|z| !is_square(*z))?;
        // root^2 = x rest, and the order of rest is a power of two below 2^order
        let (mut root, mut rest) = (self.pow(x, odd.div_ceil(2)), self.pow(x, odd));
        let (mut generator, mut order) = (self.pow(other, odd), twos);
        while rest != 1 {
            let (mut k, mut square) = (0, rest);
            while square != 1 {
                square = self.mul(square, square);
                k += 1;
            }
            for _ in 0..order - k - 1 {
                generator = self.mul(generator, generator);
            }
            root = self.mul(root, generator);
            generator = self.mul(generator, generator);
            rest = self.mul(rest, generator);
            order = k;
        }
        Some(root)
    }

    /// An element of this order, a product of twos, threes and fives, if there is one.
    pub(crate) fn element_of_order(self, n: u64) -> Option<u64> {
        let p = self.prime;
        if !(p - 1).is_multiple_of(n) {
            return None;
        }
        let primes: Vec<u64> = [2, 3, 5].into_iter().filter(|q| n.is_multiple_of(*q)).collect();
        (2..p).map(|x| self.pow(x, (p - 1) / n)).find(|z| primes.iter().all(|q| self.pow(*z, n / q) != 1))
    }

    /// Determinant by expansion along the first row: for tests, independent of [`rank`](Self::rank).
    pub fn determinant<const N: usize>(self, rows: &[[u64; N]]) -> u64 {
        fn expand<const N: usize>(field: Field, rows: &[[u64; N]], columns: &[usize]) -> u64 {
            let Some((head, rest)) = rows.split_first() else { return 1 };
            (0..columns.len()).fold(0, |sum, k| {
                let others: Vec<usize> = columns.iter().copied().filter(|c| *c != columns[k]).collect();
                let term = field.mul(head[columns[k]], expand(field, rest, &others));
                if k % 2 == 0 { field.add(sum, term) } else { field.sub(sum, term) }
            })
        }
        expand(self, rows, &(0..N).collect::<Vec<_>>())
    }

    /// Rank of the rows, by elimination with cross-multiplication (no inverses).
    pub fn rank<R: AsRef<[u64]> + AsMut<[u64]>>(self, mut rows: Vec<R>) -> usize {
        let mut rank = 0;
        for column in 0..rows.first().map_or(0, |row| row.as_ref().len()) {
            let Some(pivot) = (rank..rows.len()).find(|r| rows[*r].as_ref()[column] != 0) else { continue };
            rows.swap(rank, pivot);
            let (top, below) = rows.split_at_mut(rank + 1);
            let head = top[rank].as_ref();
            for row in below.iter_mut().map(AsMut::as_mut) {
                let factor = row[column];
                if factor == 0 {
                    continue;
                }
                for (x, h) in row.iter_mut().zip(head).skip(column) {
                    *x = self.sub(self.mul(*x, head[column]), self.mul(factor, *h));
                }
            }
            rank += 1;
        }
        rank
    }
}

/// `x = m 2^e` with an odd integer `m`, `|m| < 2^53`; zero is `(0, 0)`.
pub fn mantissa_and_exponent(x: f64) -> (i64, i32) {
    let bits = x.to_bits();
    let field = ((bits >> 52) & 0x7ff) as i32;
    let fraction = (bits & ((1 << 52) - 1)).cast_signed();
    let (mantissa, exponent) =
        if field == 0 { (fraction, -1074) } else { (fraction | 1 << 52, field - 1075) };
    if mantissa == 0 {
        return (0, 0);
    }
    let zeros = mantissa.trailing_zeros();
    let odd = mantissa >> zeros;
    (if x < 0.0 { -odd } else { odd }, exponent + zeros.cast_signed())
}

/// Miller-Rabin with the bases that decide every 64-bit number (Sinclair 2011).
pub(crate) fn is_prime(n: u64) -> bool {
    if n < 4 {
        return n > 1;
    }
    if n.is_multiple_of(2) {
        return false;
    }
    let field = Field::modulo(n);
    let twos = (n - 1).trailing_zeros();
    [2, 325, 9375, 28178, 450775, 9780504, 1795265022].into_iter().all(|base| {
        let base = base % n;
        let mut x = field.pow(base, (n - 1) >> twos);
        if base == 0 || x == 1 || x == n - 1 {
            return true;
        }
        (1..twos).any(|_| {
            x = field.mul(x, x);
            x == n - 1
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn primes_are_those_known() {
        let below = |n: u64| (2..n).filter(|k| is_prime(*k)).collect::<Vec<_>>();
        assert_eq!(below(50), [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47]);
        // strong pseudoprimes to base 2, a Carmichael number, squares
        assert!(
            [2047, 3277, 561, 3_215_031_751, 4_294_967_291 * 4_294_967_291].into_iter().all(|n| !is_prime(n))
        );
        let found = fields(3).into_iter().map(|f| (1u64 << 61) - f.prime()).collect::<Vec<_>>();
        assert_eq!(found, [1, 31, 45]); // 2^61 - 1, - 31, - 45 (Caldwell's list of primes just below powers of two)
    }

    #[test]
    fn square_roots_are_found_where_they_exist() {
        let mut rng = Rng::new(4);
        for field in fields(5).into_iter().chain((0..5).map(|_| Field::drawn(&mut rng))) {
            let mut squares = 0;
            for x in 1..60u64 {
                let y = field.mul(x, x);
                assert!([x, field.prime() - x].contains(&field.square_root(y).unwrap()));
                if let Some(root) = field.square_root(x) {
                    assert_eq!(field.mul(root, root), x);
                    squares += 1;
                }
            }
            assert!((10..59).contains(&squares));
        }
        assert_eq!(Field::MERSENNE.square_root(0), Some(0));
    }

    #[test]
    fn elements_have_the_order_asked_for() {
        let mut rng = Rng::new(7);
        let mut found = 0;
        for field in (0..60).map(|_| Field::drawn(&mut rng)) {
            for n in [2, 9, 16, 20, 32] {
                let Some(z) = field.element_of_order(n) else {
                    assert_ne!(field.prime() % n, 1);
                    continue;
                };
                found += 1;
                assert_eq!((1..=n).find(|k| field.pow(z, *k) == 1), Some(n));
            }
        }
        assert!(found > 60);
    }

    #[test]
    fn doubles_are_taken_apart_and_put_together() {
        for x in [0.0, 1.0, -0.1, 1e300, 5e-324, f64::MIN_POSITIVE, -12.5, 10.392_304_845_413_264] {
            let (m, e) = mantissa_and_exponent(x);
            assert!(x == 0.0 || m % 2 != 0);
            let half = 2f64.powi(e / 2);
            assert!((m as f64 * half * 2f64.powi(e - e / 2) - x).abs() <= 0.0, "{x}");
        }
        let f = fields(2)[1];
        assert_eq!(f.scaled(-0.75, 2), f.prime() - 3);
        // 0.1 is m / 2^55: times 2^55 it is m, for any split of the power
        let (m, e) = mantissa_and_exponent(0.1);
        assert_eq!(f.scaled(0.1, -e), m.cast_unsigned());
        assert_eq!(f.mul(f.scaled(0.1, 0), f.scaled(1.0, -e)), m.cast_unsigned());
    }

    #[test]
    fn drawn_primes_are_primes_of_61_bits_and_differ() {
        let mut rng = Rng::new(5);
        let drawn: Vec<u64> = (0..20).map(|_| Field::drawn(&mut rng).prime()).collect();
        assert!(drawn.iter().all(|p| is_prime(*p) && p >> 60 == 1));
        assert!((1..20).all(|k| !drawn[..k].contains(&drawn[k])));
    }

    #[test]
    fn products_by_a_reciprocal_are_those_by_division() {
        let mut state = 1_u64;
        for field in fields(40).into_iter().chain([
            Field::modulo(7),
            Field::modulo((1 << 61) - (1 << 31) - 1),
            Field::modulo(u64::MAX >> 1),
        ]) {
            let edge = [0, 1, field.prime / 2, field.prime - 2, field.prime - 1];
            let drawn = (0..200).map(|_| {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                state % field.prime
            });
            let list: Vec<u64> = edge.into_iter().chain(drawn).collect();
            for (x, y) in list.iter().flat_map(|x| edge.iter().chain(list.last()).map(move |y| (*x, *y))) {
                assert_eq!(
                    u128::from(field.mul(x, y)),
                    u128::from(x) * u128::from(y) % u128::from(field.prime)
                );
            }
            if field.reciprocal > 0 {
                let p = u128::from(field.prime);
                for x in [p, p + 1, 2 * p, p << 62, (p << 62) - 1].into_iter().filter(|x| x >> 124 == 0) {
                    assert_eq!(u128::from(field.reduced(x)), x % p);
                }
            }
        }
    }

    #[test]
    fn rank_of_a_matrix_with_a_relation_is_lower_and_of_one_spoilt_in_one_entry_full() {
        let f = fields(1)[0];
        let row = |x: [i64; 4]| x.map(|v| f.integer(v));
        let rows = vec![row([3, -1, 4, 1]), row([-5, 9, 2, 6]), row([-2, 8, 6, 7])];
        assert_eq!(f.rank(rows.clone()), 2);
        let mut spoilt = rows;
        spoilt[2][3] = f.add(spoilt[2][3], 1);
        assert_eq!(f.rank(spoilt), 3);
        assert_eq!(f.rank(vec![[0u64; 4]; 3]), 0);
    }
}
