//! Numbers of one field of square roots, of any length, for decisions that are independent of rounding and length.
//!
//! [`Surd`] refuses long results, because designs are written and printed with it. Sums, products and quotients always
//! exist here: [`Algebraic::all`] admits only numbers of one field whose radicands stay below `2^63`.

use num_traits::Zero;

use super::exact::{self, ExactNumber, Rational, clear_below};
use super::split::{SplitField, degree_of};
use super::surd::Surd;

/// A number of the field of square roots of a design.
#[derive(Debug, Clone, PartialEq)]
pub enum Algebraic {
    /// A fraction.
    Rational(Rational),
    /// A sum of square roots that is not a fraction.
    Irrational(Surd),
}

impl Algebraic {
    /// The numbers, in their order; `None` if they have too many independent square roots.
    pub fn all(numbers: &[&Surd]) -> Option<Vec<Self>> {
        degree_of(numbers.iter().copied())?;
        Some(numbers.iter().map(|x| Self::of((*x).clone())).collect())
    }

    fn of(x: Surd) -> Self {
        x.as_rational().map_or(Self::Irrational(x), Self::Rational)
    }

    /// A small integer.
    pub fn integer(x: i64) -> Self {
        Self::Rational(Rational::from_integer(x.into()))
    }

    /// Whether it is zero.
    pub fn is_zero(&self) -> bool {
        matches!(self, Self::Rational(x) if x.is_zero())
    }

    /// The number if it is a fraction.
    pub fn as_rational(&self) -> Option<&Rational> {
        match self {
            Self::Rational(x) => Some(x),
            Self::Irrational(_) => None,
        }
    }

    /// The number as a sum of square roots.
    pub fn surd(&self) -> Surd {
        match self {
            Self::Rational(x) => Surd::long_rational(x),
            Self::Irrational(x) => x.clone(),
        }
    }

    /// The value as a double, within one unit in the last place.
    pub fn approximate(&self) -> f64 {
        match self {
            Self::Rational(x) => exact::approximate(x),
            Self::Irrational(x) => x.nearest(),
        }
    }

    /// Bits of the longest of its integers: numerators and the denominator.
    pub fn bits(&self) -> u64 {
        match self {
            Self::Rational(x) => x.numer().bits().max(x.denom().bits()),
            Self::Irrational(x) => x.terms().map(|(_, c)| c.bits()).fold(x.denominator().bits(), u64::max),
        }
    }

    fn with(&self, other: &Self, of: impl FnOnce(&Surd, &Surd) -> Option<Surd>) -> Self {
        let found = of(&self.surd(), &other.surd());
        Self::of(found.unwrap_or_else(|| unreachable!("the radicands of one field stay below 2^63")))
    }
}

impl From<Rational> for Algebraic {
    fn from(x: Rational) -> Self {
        Self::Rational(x)
    }
}

crate::operators! {
    [inline] [] &Algebraic => Algebraic;
    Add::add(x, y) {
        match (x, y) {
            (Algebraic::Rational(x), Algebraic::Rational(y)) => Algebraic::Rational(x + y),
            _ => x.with(y, |x, y| Some(x.sum(y))),
        }
    }
    Sub::sub(x, y) {
        match (x, y) {
            (Algebraic::Rational(x), Algebraic::Rational(y)) => Algebraic::Rational(x - y),
            _ => x.with(y, |x, y| Some(x.sum(&y.negated()))),
        }
    }
    Mul::mul(x, y) {
        match (x, y) {
            (Algebraic::Rational(x), Algebraic::Rational(y)) => Algebraic::Rational(x * y),
            _ => x.with(y, Surd::product),
        }
    }
    // the divisor is not zero
    Div::div(x, y) {
        match (x, y) {
            (Algebraic::Rational(x), Algebraic::Rational(y)) => Algebraic::Rational(x / y),
            _ => x.with(y, |x, y| x.product(&y.reciprocal()?)),
        }
    }
    Neg::neg(x) {
        match x {
            Algebraic::Rational(x) => Algebraic::Rational(-x),
            Algebraic::Irrational(x) => Algebraic::Irrational(x.negated()),
        }
    }
}

crate::operators! {
    [inline] [] Algebraic;
    Mul::mul(x, y) {
        &x * &y
    }
    Sub::sub(x, y) {
        &x - &y
    }
}

impl std::iter::Sum for Algebraic {
    fn sum<I: Iterator<Item = Self>>(numbers: I) -> Self {
        numbers.fold(Self::integer(0), |sum, x| &sum + &x)
    }
}

impl ExactNumber for Algebraic {
    fn product(&self, other: &Self) -> Self {
        self * other
    }

    fn vanishes(&self) -> bool {
        self.is_zero()
    }

    /// Rows of fractions are eliminated as such. Other rows are eliminated in the field, unless they are independent
    /// modulo a prime, which proves independence.
    fn relations(rows: &[Vec<Self>]) -> Vec<Vec<Self>> {
        let rational = rows.iter().map(|row| row.iter().map(|x| x.as_rational().cloned()).collect());
        if let Some(rows) = rational.collect::<Option<Vec<Vec<Rational>>>>() {
            let found = Rational::relations(&rows);
            return found.into_iter().map(|c| c.into_iter().map(Self::Rational).collect()).collect();
        }
        if independent_modulo_a_prime(rows) { Vec::new() } else { eliminated(rows) }
    }
}

fn independent_modulo_a_prime(rows: &[Vec<Algebraic>]) -> bool {
    let surds: Vec<Vec<Surd>> = rows.iter().map(|row| row.iter().map(Algebraic::surd).collect()).collect();
    let Some(field) = SplitField::all(surds.iter().flatten()).and_then(|mut all| all.next()) else {
        return false;
    };
    let residues: Option<Vec<Vec<u64>>> =
        surds.iter().map(|row| row.iter().map(|x| field.residue(x)).collect()).collect();
    residues.is_some_and(|rows| {
        let count = rows.len();
        field.field().rank(rows) == count
    })
}

/// The relations by elimination in the field; the relation of a row has a one at the row's own place.
fn eliminated(rows: &[Vec<Algebraic>]) -> Vec<Vec<Algebraic>> {
    let (count, width) = (rows.len(), rows.first().map_or(0, Vec::len));
    let mut work = rows.to_vec();
    for (i, row) in work.iter_mut().enumerate() {
        row.extend((0..count).map(|j| Algebraic::integer(i64::from(i == j))));
    }
    let mut rank = 0;
    for column in 0..width {
        let Some(pivot) = (rank..count).find(|i| !work[*i][column].is_zero()) else { continue };
        work.swap(rank, pivot);
        clear_below(&mut work, rank, column);
        rank += 1;
    }
    work.split_off(rank).into_iter().map(|row| row[width..].to_vec()).collect()
}

/// A basis of the span of exact rows in doubles, as accurate for nearly dependent rows as for any others.
#[derive(Debug, Clone, PartialEq)]
pub struct RoundedBasis {
    /// The vectors. Each has the entry 1 at a place where the others have 0, which keeps them apart.
    pub vectors: Vec<Vec<f64>>,
    /// The coefficients of the rows in every vector; they are large for nearly dependent rows.
    pub coefficients: Vec<Vec<f64>>,
}

impl RoundedBasis {
    /// The basis by exact elimination. The pivot of a row is its largest entry after the earlier rows are subtracted.
    pub fn of(rows: &[Vec<Algebraic>]) -> Self {
        let (count, width) = (rows.len(), rows.first().map_or(0, Vec::len));
        let mut kept: Vec<(usize, Vec<Algebraic>)> = Vec::new();
        for (i, row) in rows.iter().enumerate() {
            let own = (0..count).map(|j| Algebraic::integer(i64::from(i == j)));
            let mut row: Vec<Algebraic> = row.iter().cloned().chain(own).collect();
            for (pivot, known) in &kept {
                subtract(&mut row, known, *pivot);
            }
            let Some(pivot) = largest(&row[..width]) else { continue };
            let head = row[pivot].clone();
            row.iter_mut().filter(|x| !x.is_zero()).for_each(|x| *x = &*x / &head);
            for (_, known) in &mut kept {
                subtract(known, &row, pivot);
            }
            kept.push((pivot, row));
        }
        let rounded = |part: &[Algebraic]| part.iter().map(Algebraic::approximate).collect();
        let (vectors, coefficients) =
            kept.iter().map(|(_, row)| (rounded(&row[..width]), rounded(&row[width..]))).unzip();
        Self { vectors, coefficients }
    }
}

/// Subtracts the multiple of `known`, whose entry at `pivot` is 1, that clears this entry of `row`.
fn subtract(row: &mut [Algebraic], known: &[Algebraic], pivot: usize) {
    let factor = row[pivot].clone();
    if !factor.is_zero() {
        for (x, k) in row.iter_mut().zip(known).filter(|(_, k)| !k.is_zero()) {
            *x = &*x - &(&factor * k);
        }
    }
}

/// The place of the largest entry, or of the first nonzero one if doubles cannot tell them from zero.
fn largest(row: &[Algebraic]) -> Option<usize> {
    let nonzero = (0..row.len()).filter(|k| !row[*k].is_zero());
    let size = |k: &usize| row[*k].approximate().abs();
    // the last of equal maxima wins, so the order is reversed for the first
    nonzero.rev().max_by(|i, j| size(i).total_cmp(&size(j)))
}

/// As an expression.
impl std::fmt::Display for Algebraic {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.surd().fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `sum c_k sqrt(r_k)`, from surds.
    fn all(parts: &[&[(i64, i64)]]) -> Vec<Algebraic> {
        let surd = |parts: &&[(i64, i64)]| {
            parts.iter().fold(Surd::zero(), |sum, (c, r)| {
                let root = Surd::integer(*r).sqrt().unwrap();
                sum.plus(&root.times(&Surd::integer(*c)).unwrap()).unwrap()
            })
        };
        let surds: Vec<Surd> = parts.iter().map(surd).collect();
        Algebraic::all(&surds.iter().collect::<Vec<_>>()).unwrap()
    }

    #[test]
    fn relations_between_rows_of_square_roots_are_found_and_spoilt_ones_are_not() {
        let numbers =
            all(&[&[(1, 2)], &[(3, 1)], &[(1, 6), (-1, 1)], &[(2, 3)], &[(1, 5), (1, 2)], &[(7, 1)]]);
        let (first, second) = (numbers[..3].to_vec(), numbers[3..].to_vec());
        let factors = all(&[&[(1, 3), (2, 1)], &[(-1, 10)]]);
        let third: Vec<Algebraic> =
            first.iter().zip(&second).map(|(x, y)| &(x * &factors[0]) + &(y * &factors[1])).collect();
        let rows = [first, second, third];
        let found = Algebraic::relations(&rows);
        assert_eq!(found.len(), 1);
        for k in 0..3 {
            let sum: Algebraic = found[0].iter().zip(&rows).map(|(c, row)| c * &row[k]).sum();
            assert!(sum.is_zero() && !found[0][k].is_zero());
        }
        let mut spoilt = rows;
        let trace = Rational::new(1.into(), num_bigint::BigInt::from(10).pow(400));
        spoilt[2][1] = &spoilt[2][1] + &trace.into();
        assert!(Algebraic::relations(&spoilt).is_empty());
        // elimination alone gives the same, without the prime
        assert!(eliminated(&spoilt).is_empty());
    }

    #[test]
    fn sums_that_become_fractions_are_fractions() {
        let x = all(&[&[(1, 2), (1, 3)], &[(-1, 2), (1, 3)]]);
        assert_eq!(&x[0] * &x[1], Algebraic::integer(1));
        assert_eq!(&x[0] / &x[0], Algebraic::integer(1));
        assert!((&x[0] - &x[0]).is_zero());
        assert_eq!((&x[0] / &x[1]).to_string(), "5 + 2*sqrt(6)");
    }

    #[test]
    fn nearly_dependent_rows_have_a_basis_to_the_last_place() {
        let numbers = all(&[&[(1, 2)], &[(3, 1)], &[(1, 6)], &[(2, 3)], &[(1, 2)], &[(7, 1)]]);
        let (first, second) = (numbers[..3].to_vec(), numbers[3..].to_vec());
        // the third row leaves the plane of the first two by 1e-40, far below the accuracy of doubles
        let mut third: Vec<Algebraic> = first.iter().zip(&second).map(|(x, y)| x + y).collect();
        let trace = Rational::new(1.into(), num_bigint::BigInt::from(10).pow(40));
        third[1] = &third[1] + &trace.into();
        let space = RoundedBasis::of(&[first.clone(), second.clone(), third]);
        let unit = |k: usize| (0..3).map(|i| f64::from(u8::from(i == k))).collect::<Vec<f64>>();
        assert!((0..3).all(|k| space.vectors.contains(&unit(k))), "{:?}", space.vectors);
        let largest = space.coefficients.iter().flatten().fold(0.0f64, |m, c| m.max(c.abs()));
        // the first two span the plane of the normal (21 - 2 sqrt 3, -sqrt 2, 2 - 6 sqrt 3)
        let expected = 1e40 * (21.0 - 2.0 * 3f64.sqrt()) / 2f64.sqrt();
        assert!((largest / expected - 1.0).abs() < 1e-14, "{largest:e}");
        // without the trace there are two vectors, with the coefficients of the rows they come from
        let sum: Vec<Algebraic> = first.iter().zip(&second).map(|(x, y)| x + y).collect();
        let rows = [first, second, sum];
        let plane = RoundedBasis::of(&rows);
        assert_eq!(plane.vectors.len(), 2);
        for (v, c) in plane.vectors.iter().zip(&plane.coefficients) {
            for k in 0..3 {
                let combined: f64 = (0..3).map(|i| c[i] * rows[i][k].approximate()).sum();
                assert!((combined - v[k]).abs() < 1e-13, "{v:?} {c:?}");
            }
        }
    }

    #[test]
    fn fields_of_too_many_square_roots_are_refused() {
        let roots: Vec<Surd> =
            [2, 3, 5, 7, 11, 13, 17, 19, 23].map(|p| Surd::integer(p).sqrt().unwrap()).to_vec();
        assert!(Algebraic::all(&roots[..8].iter().collect::<Vec<_>>()).is_some());
        assert!(Algebraic::all(&roots.iter().collect::<Vec<_>>()).is_none());
    }
}
