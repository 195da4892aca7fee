//! Exact rational arithmetic on doubles, for decisions independent of rounding.
//!
//! Every finite double is a rational number, so linear relations between data given as doubles are true or false
//! without any tolerance.

use std::ops::{Div, Mul, Neg, Sub};

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::float::FloatCore;
use num_traits::{Signed, Zero};

use super::modular::Field;

/// A rational number of any size.
pub type Rational = BigRational;

/// Numbers of a field with a method for linear relations between rows.
pub trait ExactNumber: Clone {
    /// The product of two.
    fn product(&self, other: &Self) -> Self;

    /// Whether it is zero.
    fn vanishes(&self) -> bool;

    /// A basis of the linear relations between the rows, as in [`relations`].
    fn relations(rows: &[Vec<Self>]) -> Vec<Vec<Self>>;
}

impl ExactNumber for Rational {
    fn product(&self, other: &Self) -> Self {
        self * other
    }

    fn vanishes(&self) -> bool {
        self.is_zero()
    }

    fn relations(rows: &[ExactVector]) -> Vec<ExactVector> {
        relations_of_fractions(rows)
    }
}

/// A vector of rational numbers.
pub type ExactVector = Vec<Rational>;

/// The value of a double, in lowest terms; `None` for NaN and infinities.
pub fn rational(x: f64) -> Option<Rational> {
    if !x.is_finite() {
        return None;
    }
    let (mantissa, exponent, sign) = x.integer_decode();
    if mantissa == 0 {
        return Some(Rational::zero());
    }
    let twos = mantissa.trailing_zeros();
    let numerator = BigInt::from(mantissa >> twos) * sign;
    let exponent = i64::from(exponent) + i64::from(twos);
    let power = exponent.unsigned_abs();
    Some(if exponent < 0 {
        // an odd number over a power of two
        Rational::new_raw(numerator, BigInt::from(1) << power)
    } else {
        Rational::from_integer(numerator << power)
    })
}

/// The greatest common divisor. Powers of two are taken out first, since most denominators are powers of two.
pub(crate) fn common_divisor(a: &BigInt, b: &BigInt) -> BigInt {
    let (Some(m), Some(n)) = (a.trailing_zeros(), b.trailing_zeros()) else { return a.gcd(b) };
    let is_power = |x: &BigInt, twos: u64| x.bits() == twos + 1;
    if is_power(a, m) || is_power(b, n) { BigInt::from(1) << m.min(n) } else { a.gcd(b) }
}

/// An integer as a fraction.
pub fn integer(x: i64) -> Rational {
    Rational::from_integer(x.into())
}

/// A basis of the linear relations between the rows: vectors `c` with `sum_i c_i row_i = 0`, exactly.
pub fn relations<N: ExactNumber>(rows: &[Vec<N>]) -> Vec<Vec<N>> {
    N::relations(rows)
}

/// [`relations`] between rows of fractions.
///
/// It uses fraction-free elimination (Bareiss 1968) of integer rows next to an identity. Row `i` of the result has
/// `rows.len()` entries; the entry of its original row is 1. The rank is the number of rows minus the number of
/// relations.
///
/// Relations between rows are invariant under multiplication of a column, so every column is first scaled to integers
/// without a common power of two. Numbers of a thousand digits next to ones keep their length, since no fraction is
/// reduced on the way.
fn relations_of_fractions(rows: &[ExactVector]) -> Vec<ExactVector> {
    let count = rows.len();
    let width = rows.first().map_or(0, Vec::len);
    let mut work = integers(rows);
    if rank_modulo(&work) == count {
        return Vec::new(); // a minor that is nonzero modulo a prime is nonzero
    }
    for (i, row) in work.iter_mut().enumerate() {
        row.extend((0..count).map(|j| BigInt::from(u8::from(i == j))));
    }
    let (mut rank, mut last) = (0, BigInt::from(1));
    let mut made_of: Vec<usize> = (0..count).collect();
    for column in 0..width {
        let Some(pivot) = (rank..count).find(|i| work[*i][column] != BigInt::ZERO) else { continue };
        work.swap(rank, pivot);
        made_of.swap(rank, pivot);
        let (top, below) = work.split_at_mut(rank + 1);
        let head = &top[rank];
        for row in below.iter_mut() {
            let factor = std::mem::take(&mut row[column]);
            for (x, h) in row.iter_mut().zip(head).skip(column + 1) {
                // the quotient is a minor of the rows: an integer
                *x = (&*x * &head[column] - &factor * h) / &last;
            }
        }
        last.clone_from(&head[column]);
        rank += 1;
        if rank == count {
            break;
        }
    }
    let own = work.into_iter().zip(made_of).skip(rank);
    own.map(|(row, i)| {
        row[width..].iter().map(|x| Rational::new(x.clone(), row[width + i].clone())).collect()
    })
    .collect()
}

/// Rank of a list of rows.
pub fn rank<N: ExactNumber>(rows: &[Vec<N>]) -> usize {
    rows.len() - relations(rows).len()
}

/// `a (x) b`, entry by entry.
pub fn product<N: ExactNumber>(a: &[N], b: &[N]) -> Vec<N> {
    a.iter().flat_map(|x| b.iter().map(move |y| x.product(y))).collect()
}

/// The rows with every column scaled to integers without a common power of two.
fn integers(rows: &[Vec<Rational>]) -> Vec<Vec<BigInt>> {
    let width = rows.first().map_or(0, Vec::len);
    let mut out: Vec<Vec<BigInt>> = rows.iter().map(|_| Vec::with_capacity(width)).collect();
    for column in 0..width {
        let denominators = rows.iter().map(|row| row[column].denom());
        let common =
            denominators.fold(BigInt::from(1), |l, d| if (&l % d) == BigInt::ZERO { l } else { l.lcm(d) });
        let scaled = |x: &Rational| x.numer() * (&common / x.denom());
        let column: Vec<BigInt> = rows.iter().map(|row| scaled(&row[column])).collect();
        let twos = column.iter().filter_map(BigInt::trailing_zeros).min().unwrap_or(0);
        out.iter_mut().zip(column).for_each(|(row, x)| row.push(x >> twos));
    }
    out
}

/// The rank of rows of integers modulo a prime, at most their rank.
pub fn rank_modulo(rows: &[Vec<BigInt>]) -> usize {
    let field = Field::MERSENNE;
    field.rank(rows.iter().map(|row| row.iter().map(|x| field.residue(x)).collect::<Vec<_>>()).collect())
}

/// Subtracts multiples of a row from those below it, whose entries in the column become zero.
pub(crate) fn clear_below<N: ExactNumber>(rows: &mut [Vec<N>], pivot: usize, column: usize)
where
    for<'a> &'a N: Sub<&'a N, Output = N> + Mul<&'a N, Output = N> + Div<&'a N, Output = N>,
{
    let (above, below) = rows.split_at_mut(pivot + 1);
    let head = &above[pivot];
    for row in below.iter_mut().filter(|row| !row[column].vanishes()) {
        let factor = &row[column] / &head[column];
        for (x, h) in row.iter_mut().zip(head).skip(column).filter(|(_, h)| !h.vanishes()) {
            *x = &*x - &(&factor * h);
        }
    }
}

/// The determinant of a square matrix by rows, at least one.
pub fn determinant<N: ExactNumber>(mut rows: Vec<Vec<N>>) -> N
where
    for<'a> &'a N: Sub<&'a N, Output = N> + Mul<&'a N, Output = N> + Div<&'a N, Output = N> + Neg<Output = N>,
{
    let mut product: Option<N> = None;
    for column in 0..rows.len() {
        let Some(pivot) = (column..rows.len()).find(|i| !rows[*i][column].vanishes()) else {
            return rows[column][column].clone();
        };
        rows.swap(pivot, column);
        let head = &rows[column][column];
        let next = product.map_or_else(|| head.clone(), |product| &product * head);
        product = Some(if pivot == column { next } else { -&next });
        clear_below(&mut rows, column, column);
    }
    product.unwrap_or_else(|| unreachable!("a matrix has rows"))
}

/// A basis of the vectors that all rows annul.
pub fn kernel(rows: &[ExactVector]) -> Vec<ExactVector> {
    let width = rows.first().map_or(0, Vec::len);
    let column = |j: usize| rows.iter().map(|row| row[j].clone()).collect();
    relations(&(0..width).map(column).collect::<Vec<_>>())
}

/// The multiple of a list that consists of integers without a common factor, with a positive first nonzero entry; zeros
/// stay zeros.
pub fn primitive(list: &[Rational]) -> Vec<Rational> {
    let Some(first) = list.iter().find(|x| !x.is_zero()) else { return list.to_vec() };
    let denominator = list.iter().fold(BigInt::from(1), |l, x| l.lcm(x.denom()));
    let divisor = list.iter().fold(BigInt::ZERO, |g, x| g.gcd(&(x.numer() * (&denominator / x.denom()))));
    let factor = Rational::new(denominator, if first.is_negative() { -divisor } else { divisor });
    list.iter().map(|x| x * &factor).collect()
}

/// The numerators of the [`primitive`] multiple.
pub fn primitive_integers(list: &[Rational]) -> Vec<BigInt> {
    primitive(list).iter().map(|x| x.numer().clone()).collect()
}

/// `digits * 10^exponent`; `None` for texts other than digits, and exponents above a thousand.
pub fn decimal(digits: &str, exponent: i64) -> Option<Rational> {
    let digits: BigInt = digits.parse().ok()?;
    let power = u32::try_from(exponent.unsigned_abs()).ok().filter(|n| *n <= 1000)?;
    let power = BigInt::from(10).pow(power);
    Some(if exponent < 0 { Rational::new(digits, power) } else { Rational::from(digits * power) })
}

/// The nearest double, ties to even; overflow gives an infinity, and values below the smallest normal double may be
/// rounded twice.
pub fn nearest(x: &Rational) -> f64 {
    let (n, d) = (x.numer(), x.denom());
    // 64 or 65 leading bits of the quotient, and one that indicates a remainder
    let shift = 64 + d.bits().cast_signed() - n.bits().cast_signed();
    let (n, d) = if shift >= 0 { (n << shift, d.clone()) } else { (n.clone(), d << -shift) };
    let (quotient, rest) = n.div_rem(&d);
    let (_, digits) = quotient.to_u64_digits();
    let leading = digits.iter().rev().fold(0u128, |sum, digit| (sum << 64) | u128::from(*digit));
    let rounded = ((leading << 1) | u128::from(rest != BigInt::ZERO)) as f64;
    let exponent = (-shift - 1).clamp(-4000, 4000) as i32;
    let half = exponent / 2;
    let scaled = rounded * 2f64.powi(half) * 2f64.powi(exponent - half);
    if x.is_negative() { -scaled } else { scaled }
}

/// An upper bound of the distance of a double from the numbers between `low` and `high`; zero if they are the double.
pub fn farthest(double: f64, low: &Rational, high: &Rational) -> f64 {
    let Some(double) = rational(double) else { return f64::INFINITY };
    // a difference in lowest terms would be the slowest step
    let off = |x: &Rational| {
        let difference = double.numer() * x.denom() - x.numer() * double.denom();
        if difference == BigInt::ZERO {
            return 0.0;
        }
        // the approximation is off by at most one unit in the last place
        let far = approximate(&Rational::new_raw(difference, double.denom() * x.denom())).abs();
        far.next_up().next_up()
    };
    off(low).max(off(high))
}

/// The value as a double, within one unit in the last place; overflow gives an infinity, underflow zero.
pub fn approximate(x: &Rational) -> f64 {
    let (n, d) = (x.numer(), x.denom());
    // 64 or 65 leading bits of the quotient
    let shift = 64 + d.bits().cast_signed() - n.bits().cast_signed();
    let quotient = if shift >= 0 { (n << shift) / d } else { n / (d << -shift) };
    let (_, digits) = quotient.to_u64_digits();
    let leading = digits.iter().rev().fold(0.0, |sum, digit| sum * 2f64.powi(64) + *digit as f64);
    let exponent = (-shift).clamp(-4000, 4000) as i32;
    let half = exponent / 2;
    let scaled = leading * 2f64.powi(half) * 2f64.powi(exponent - half);
    if x.is_negative() { -scaled } else { scaled }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(x: &[f64]) -> Vec<Rational> {
        x.iter().map(|x| rational(*x).unwrap()).collect()
    }

    #[test]
    fn approximations_are_the_doubles_themselves_and_nearest_quotients() {
        for x in [0.0, 1.0, -0.1, 1e300, -1e-300, 5e-324, f64::MAX] {
            assert!((approximate(&rational(x).unwrap()) - x).abs() <= 0.0, "{x}");
        }
        let third = rational(1.0).unwrap() / rational(3.0).unwrap();
        assert!((approximate(&third) - 1.0 / 3.0).abs() <= f64::EPSILON / 3.0);
        let huge = rational(1e200).unwrap();
        assert!(approximate(&(&huge * &huge)).is_infinite());
    }

    #[test]
    fn nearest_doubles_are_those_that_decimals_are_read_to() {
        let ten = |n: u32| BigInt::from(10).pow(n);
        for (digits, scale) in
            [(1i64, 1), (15, 1), (173_205_080_756_887_729, 17), (123_456_789_012_345_678, 3)]
        {
            for sign in [1, -1] {
                let x = Rational::new((sign * digits).into(), ten(scale));
                let read: f64 = format!("{}e-{scale}", sign * digits).parse().unwrap();
                assert_eq!(nearest(&x).to_bits(), read.to_bits(), "{x}");
            }
        }
        // half way between two doubles, and a trace above
        let one = rational(1.0).unwrap();
        let half = rational(f64::EPSILON / 2.0).unwrap();
        assert_eq!(nearest(&(&one + &half)).to_bits(), 1f64.to_bits());
        let trace = rational(1e-300).unwrap();
        assert_eq!(nearest(&(one + half + trace)).to_bits(), (1.0 + f64::EPSILON).to_bits());
        for x in [0.0, 1e300, -2.5e-308, f64::MAX] {
            assert!((nearest(&rational(x).unwrap()) - x).abs() <= 0.0, "{x}");
        }
    }

    #[test]
    fn coprime_multiples() {
        let x = row(&[0.0, -0.75, 1.5, 4.5]);
        assert_eq!(primitive(&x), row(&[0.0, 1.0, -2.0, -6.0]));
    }

    #[test]
    fn a_relation_between_doubles_is_found_exactly_and_a_spoilt_one_is_not() {
        // the third row is the sum of the others, decimals as they are rounded
        let (a, b) = ([0.1, 0.2, 0.3, 1e-30], [1e20, 3.0, -0.7, 0.5]);
        let exact: Vec<Rational> = row(&a).iter().zip(row(&b)).map(|(x, y)| x + y).collect();
        let found = relations(&[row(&a), row(&b), exact.clone()]);
        assert_eq!(found.len(), 1);
        let c = &found[0];
        assert!(c[0] == c[1] && &c[0] + &c[2] == integer(0) && c[2] != integer(0));
        let rounded = row(&[0.1 + 1e20, 0.2 + 3.0, 0.3 - 0.7, 0.5]);
        assert!(rounded != exact && relations(&[row(&a), row(&b), rounded]).is_empty());
    }
}
