//! Square roots adjoined one after the other to polynomials over the integers or a prime field, without asking whether
//! they are new.
//!
//! Level `k` is the algebra `B_k = B_(k-1)[t] / (t^2 - r_k)` over the ring `B_0 = R`, whatever `r_k` in `B_(k-1)` is: a
//! square, zero, or a constant. An element has `2^k` coefficients; bit `j` of an index says whether the root of
//! `r_(j+1)` is a factor. The norm to `R` is the product over both signs of every root.
//!
//! Fractions are elements of the tower over products of the singular factors.

#![allow(clippy::unused_self, reason = "all arithmetic is asked of the same value")]

use num_bigint::{BigInt, Sign};

use num::modular::Field;
use num::poly::IntPoly;

/// `Z[x]` or a quotient of it.
pub(super) trait Ring: Clone + PartialEq {
    fn constant(value: &BigInt) -> Self;
    fn unknown() -> Self;
    fn plus(&self, other: &Self) -> Self;
    fn minus(&self, other: &Self) -> Self;
    fn times(&self, other: &Self) -> Self;
    fn is_zero(&self) -> bool;
    /// The quotient when there is one.
    fn exact_div(&self, divisor: &Self) -> Option<Self>;
    /// `None` for zero.
    fn degree(&self) -> Option<usize>;
    /// The part without repeated factors.
    fn squarefree_degree(&self) -> usize;
}

impl Ring for IntPoly {
    fn constant(value: &BigInt) -> Self {
        Self::constant(value.clone())
    }

    fn unknown() -> Self {
        Self::x()
    }

    fn plus(&self, other: &Self) -> Self {
        self + other
    }

    fn minus(&self, other: &Self) -> Self {
        self - other
    }

    fn times(&self, other: &Self) -> Self {
        self * other
    }

    fn is_zero(&self) -> bool {
        self.is_zero()
    }

    fn exact_div(&self, divisor: &Self) -> Option<Self> {
        self.exact_div(divisor)
    }

    fn degree(&self) -> Option<usize> {
        self.degree()
    }

    fn squarefree_degree(&self) -> usize {
        num::poly::squarefree_factors(self).iter().filter_map(|f| f.factor.degree()).sum()
    }
}

/// The modulus `2^61 - 1`.
const P: u64 = (1 << 61) - 1;

/// The field with that many elements.
const FIELD: Field = Field::MERSENNE;

/// A polynomial over the field with `2^61 - 1` elements, the constant coefficient first, the last one not zero.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct ResiduePoly(Vec<u64>);

/// The residue by folding, quicker than the division that serves every prime.
fn reduced(x: u128) -> u64 {
    let folded = (x & u128::from(P)) as u64 + (x >> 61) as u64;
    if folded >= P { folded - P } else { folded }
}

fn product(a: u64, b: u64) -> u64 {
    reduced(u128::from(a) * u128::from(b))
}

impl ResiduePoly {
    fn new(mut c: Vec<u64>) -> Self {
        while c.last() == Some(&0) {
            c.pop();
        }
        Self(c)
    }

    fn entry(&self, k: usize) -> u64 {
        self.0.get(k).copied().unwrap_or(0)
    }

    /// Quotient and remainder by a divisor that is not zero.
    fn divided(&self, divisor: &Self) -> (Self, Self) {
        let n = divisor.0.len();
        let scale = FIELD.inverse(divisor.0[n - 1]);
        let mut rest = self.0.clone();
        let count = (rest.len() + 1).saturating_sub(n);
        let mut quotient = vec![0; count];
        for k in (0..count).rev() {
            quotient[k] = product(rest[k + n - 1], scale);
            for (r, d) in rest[k..].iter_mut().zip(&divisor.0) {
                *r = FIELD.sub(*r, product(quotient[k], *d));
            }
        }
        (Self::new(quotient), Self::new(rest))
    }
}

impl Ring for ResiduePoly {
    fn constant(value: &BigInt) -> Self {
        let residue = value.magnitude() % P;
        let r = residue.iter_u64_digits().next().unwrap_or(0);
        Self::new(vec![if value.sign() == Sign::Minus { FIELD.sub(0, r) } else { r }])
    }

    fn unknown() -> Self {
        Self(vec![0, 1])
    }

    fn plus(&self, other: &Self) -> Self {
        let n = self.0.len().max(other.0.len());
        Self::new((0..n).map(|k| reduced(u128::from(self.entry(k) + other.entry(k)))).collect())
    }

    fn minus(&self, other: &Self) -> Self {
        let n = self.0.len().max(other.0.len());
        Self::new((0..n).map(|k| FIELD.sub(self.entry(k), other.entry(k))).collect())
    }

    fn times(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self(Vec::new());
        }
        let mut out = vec![0; self.0.len() + other.0.len() - 1];
        for (k, o) in out.iter_mut().enumerate() {
            let first = k.saturating_sub(other.0.len() - 1);
            let last = k.min(self.0.len() - 1);
            // each product is below 2^122: the sum of thirty-two fits
            for block in (first..=last).step_by(32) {
                let end = (block + 31).min(last);
                let sum: u128 =
                    (block..=end).map(|i| u128::from(self.0[i]) * u128::from(other.0[k - i])).sum();
                let high = reduced(u128::from(reduced(sum >> 61)));
                *o = reduced(u128::from(*o) + u128::from(high) + (sum & u128::from(P)));
            }
        }
        Self::new(out)
    }

    fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    fn exact_div(&self, divisor: &Self) -> Option<Self> {
        if divisor.is_zero() {
            return None;
        }
        let (quotient, rest) = self.divided(divisor);
        rest.is_zero().then_some(quotient)
    }

    fn degree(&self) -> Option<usize> {
        self.0.len().checked_sub(1)
    }

    fn squarefree_degree(&self) -> usize {
        let derivative = self.0.iter().enumerate().skip(1).map(|(k, c)| product(*c, k as u64)).collect();
        let (mut a, mut b) = (self.clone(), Self::new(derivative));
        while !b.is_zero() {
            let (_, rest) = a.divided(&b);
            (a, b) = (b, rest);
        }
        self.0.len() - a.0.len()
    }
}

/// `2^k` coefficients.
pub(super) type Element<R> = Vec<R>;

/// The radicands `r_1, r_2, ..`; the `k`-th has at most `2^(k-1)` coefficients.
#[derive(Clone)]
pub(super) struct Tower<R> {
    pub(super) radicands: Vec<Element<R>>,
}

impl<R: Ring> Tower<R> {
    pub(super) fn new() -> Self {
        Self { radicands: Vec::new() }
    }

    /// The root of the last radicand.
    pub(super) fn root(&self) -> Element<R> {
        let half = 1 << (self.radicands.len() - 1);
        let mut out = vec![zero(); 2 * half];
        out[half] = R::constant(&1.into());
        out
    }

    pub(super) fn plus(&self, a: &[R], b: &[R]) -> Element<R> {
        join(a, b, R::plus)
    }

    pub(super) fn minus(&self, a: &[R], b: &[R]) -> Element<R> {
        join(a, b, R::minus)
    }

    pub(super) fn times(&self, a: &[R], b: &[R]) -> Element<R> {
        let (a, b) = if a.len() <= b.len() { (a, b) } else { (b, a) };
        if is_zero(a) {
            return vec![zero(); b.len()];
        }
        if b.len() == 1 {
            return vec![a[0].times(&b[0])];
        }
        let (b0, b1) = b.split_at(b.len() / 2);
        if a.len() < b.len() {
            let mut out = self.times(a, b0);
            out.resize(b0.len(), zero());
            out.extend(self.times(a, b1));
            return out;
        }
        let (a0, a1) = a.split_at(a.len() / 2);
        let low = self.times(a0, b0);
        let high = self.times(a1, b1);
        let mixed = self.times(&self.plus(a0, a1), &self.plus(b0, b1));
        let cross = self.minus(&self.minus(&mixed, &low), &high);
        let level = a.len().trailing_zeros() as usize;
        let mut out = self.plus(&low, &self.times(&self.radicands[level - 1], &high));
        out.extend(cross);
        out
    }

    /// The product with the outermost root negated: an element of the level below.
    pub(super) fn norm_once(&self, a: &[R]) -> Element<R> {
        let (a0, a1) = a.split_at(a.len() / 2);
        let level = a.len().trailing_zeros() as usize;
        let square = self.times(a1, a1);
        self.minus(&self.times(a0, a0), &self.times(&self.radicands[level - 1], &square))
    }

    /// The norm over the levels the element is written in.
    pub(super) fn norm(&self, a: &[R]) -> R {
        let mut a = a.to_vec();
        while a.len() > 1 {
            a = self.norm_once(&a);
        }
        a[0].clone()
    }

    /// `c` with `a c = norm(a)`.
    fn cofactor(&self, a: &[R]) -> Element<R> {
        if a.len() == 1 {
            return vec![R::constant(&1.into())];
        }
        let (a0, a1) = a.split_at(a.len() / 2);
        let mut conjugate = a0.to_vec();
        conjugate.extend(a1.iter().map(|c| zero::<R>().minus(c)));
        let rest = self.cofactor(&self.norm_once(a));
        self.times(&rest, &conjugate)
    }

    /// `c` with `b c = a` when the norm of `b` is not zero and `c` has coefficients in the ring.
    pub(super) fn exact_div(&self, a: &[R], b: &Divisor<R>) -> Option<Element<R>> {
        let product = self.times(a, &b.cofactor);
        let quotient: Option<Vec<R>> = product.iter().map(|c| c.exact_div(&b.norm)).collect();
        quotient.map(shortened)
    }

    /// `a / b` as often as possible, and how often.
    pub(super) fn divide_out(&self, mut a: Element<R>, b: &Divisor<R>) -> (Element<R>, usize) {
        let mut count = 0;
        if b.is_constant() || is_zero(&a) {
            return (a, 0);
        }
        while let Some(quotient) = self.exact_div(&a, b) {
            a = quotient;
            count += 1;
        }
        (a, count)
    }
}

/// An element with its cofactor and norm, prepared for divisions by it.
#[derive(Clone)]
pub(super) struct Divisor<R> {
    pub(super) element: Element<R>,
    cofactor: Element<R>,
    pub(super) norm: R,
}

impl<R: Ring> Divisor<R> {
    pub(super) fn new(tower: &Tower<R>, element: Element<R>) -> Self {
        let element = shortened(element);
        let (cofactor, norm) = (tower.cofactor(&element), tower.norm(&element));
        Self { element, cofactor, norm }
    }

    /// Whether the norm does not depend on the unknown: no singular position, and in a field one could divide for ever.
    fn is_constant(&self) -> bool {
        self.norm.degree().is_none_or(|n| n == 0)
    }
}

pub(super) fn zero<R: Ring>() -> R {
    R::constant(&0.into())
}

pub(super) fn is_zero<R: Ring>(a: &[R]) -> bool {
    a.iter().all(R::is_zero)
}

/// Without outer levels whose root does not occur.
pub(super) fn shortened<R: Ring>(mut a: Element<R>) -> Element<R> {
    while a.len() > 1 && is_zero(&a[a.len() / 2..]) {
        a.truncate(a.len() / 2);
    }
    a
}

fn join<R: Ring>(a: &[R], b: &[R], op: fn(&R, &R) -> R) -> Element<R> {
    let z = zero::<R>();
    let entry = |x: &[R], k: usize| x.get(k).cloned().unwrap_or_else(|| z.clone());
    (0..a.len().max(b.len())).map(|k| op(&entry(a, k), &entry(b, k))).collect()
}

/// The number of unoriented steps.
pub(super) const STEPS: usize = 3;

/// `numerator / prod D_t^exponent_t`, `D_t` the numerator of the singular factor of step `t`; exponents may be
/// negative.
#[derive(Clone)]
pub(super) struct Fraction<R> {
    pub(super) numerator: Element<R>,
    pub(super) exponents: [i32; STEPS],
}

/// Arithmetic with fractions.
pub(super) struct Fractions<R> {
    pub(super) tower: Tower<R>,
    pub(super) factors: Vec<Divisor<R>>,
    /// Whether common factors are divided out of every sum and product, or left where they are.
    cancel: bool,
}

impl<R: Ring> Fractions<R> {
    pub(super) fn new(cancel: bool) -> Self {
        Self { tower: Tower::new(), factors: Vec::new(), cancel }
    }

    pub(super) fn integer(&self, value: &BigInt) -> Fraction<R> {
        self.whole(vec![R::constant(value)])
    }

    pub(super) fn unknown(&self) -> Fraction<R> {
        self.whole(vec![R::unknown()])
    }

    pub(super) fn whole(&self, numerator: Element<R>) -> Fraction<R> {
        Fraction { numerator, exponents: [0; STEPS] }
    }

    pub(super) fn plus(&self, a: &Fraction<R>, b: &Fraction<R>) -> Fraction<R> {
        let (x, y, exponents) = self.aligned(a, b);
        self.reduced(self.tower.plus(&x, &y), exponents)
    }

    pub(super) fn minus(&self, a: &Fraction<R>, b: &Fraction<R>) -> Fraction<R> {
        let (x, y, exponents) = self.aligned(a, b);
        self.reduced(self.tower.minus(&x, &y), exponents)
    }

    pub(super) fn times(&self, a: &Fraction<R>, b: &Fraction<R>) -> Fraction<R> {
        let exponents = std::array::from_fn(|t| a.exponents[t] + b.exponents[t]);
        self.reduced(self.tower.times(&a.numerator, &b.numerator), exponents)
    }

    pub(super) fn scaled(&self, a: &Fraction<R>, factor: &BigInt) -> Fraction<R> {
        let factor = R::constant(factor);
        let numerator = a.numerator.iter().map(|c| c.times(&factor)).collect();
        Fraction { numerator, exponents: a.exponents }
    }

    pub(super) fn twice(&self, a: &Fraction<R>) -> Fraction<R> {
        self.plus(a, a)
    }

    pub(super) fn sum<'a>(&self, terms: impl IntoIterator<Item = &'a Fraction<R>>) -> Fraction<R>
    where
        R: 'a,
    {
        let start = self.whole(vec![zero()]);
        terms.into_iter().fold(start, |sum, t| self.plus(&sum, t))
    }

    /// Takes `a` as the next singular factor: its inverse.
    pub(super) fn adjoin_factor(&mut self, a: &Fraction<R>) -> Fraction<R> {
        let divisor = Divisor::new(&self.tower, a.numerator.clone());
        let mut exponents = a.exponents.map(|e| -e);
        exponents[self.factors.len()] = 1;
        self.factors.push(divisor);
        Fraction { numerator: vec![R::constant(&1.into())], exponents }
    }

    /// Adjoins the square root of `a` and returns it.
    pub(super) fn adjoin_root(&mut self, a: &Fraction<R>) -> Fraction<R> {
        let mut numerator = a.numerator.clone();
        let mut exponents = a.exponents;
        for (t, exponent) in exponents.iter_mut().enumerate() {
            if exponent.rem_euclid(2) == 1 {
                numerator = self.tower.times(&numerator, &self.factors[t].element);
                *exponent += 1;
            }
            *exponent /= 2;
        }
        self.tower.radicands.push(shortened(numerator));
        Fraction { numerator: self.tower.root(), exponents }
    }

    fn aligned(&self, a: &Fraction<R>, b: &Fraction<R>) -> (Element<R>, Element<R>, [i32; STEPS]) {
        let exponents: [i32; STEPS] = std::array::from_fn(|t| a.exponents[t].max(b.exponents[t]));
        let lift = |x: &Fraction<R>| {
            let mut numerator = x.numerator.clone();
            for t in 0..self.factors.len() {
                for _ in x.exponents[t]..exponents[t] {
                    numerator = self.tower.times(&numerator, &self.factors[t].element);
                }
            }
            numerator
        };
        (lift(a), lift(b), exponents)
    }

    /// Divides out common factors when asked to.
    fn reduced(&self, numerator: Element<R>, exponents: [i32; STEPS]) -> Fraction<R> {
        let mut out = Fraction { numerator: shortened(numerator), exponents };
        if is_zero(&out.numerator) {
            out.exponents = [0; STEPS];
        }
        if self.cancel {
            for (t, factor) in self.factors.iter().enumerate() {
                while out.exponents[t] > 0 && !factor.norm.is_zero() {
                    let Some(quotient) = self.tower.exact_div(&out.numerator, factor) else { break };
                    out.numerator = quotient;
                    out.exponents[t] -= 1;
                }
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num::Rng;
    use num::poly::IntPoly;

    #[test]
    fn the_prime_field_is_an_image_of_the_integers() {
        let mut rng = Rng::new(4);
        for case in 0..40 {
            let mut draw =
                |n: usize| IntPoly::new((0..n).map(|_| BigInt::from(rng.next_u64().cast_signed())).collect());
            let (p, q) = (draw(1 + case * 3), draw(2 + case));
            let image = |p: &IntPoly| {
                let c = p.coefficients().iter().map(|c| ResiduePoly::constant(c).entry(0));
                ResiduePoly::new(c.collect())
            };
            assert_eq!(image(&p).times(&image(&q)), image(&(&p * &q)));
            assert_eq!(image(&p).plus(&image(&q)), image(&(&p + &q)));
            assert_eq!(image(&p).minus(&image(&q)), image(&(&p - &q)));
            assert_eq!(image(&(&p * &q)).exact_div(&image(&q)), Some(image(&p)));
            assert_eq!(image(&(&(&p * &q) * &q)).squarefree_degree(), (&p * &q).degree().unwrap());
        }
        assert!(ResiduePoly::constant(&BigInt::from(P)).is_zero());
    }

    fn p(c: &[i64]) -> IntPoly {
        IntPoly::from_i64(c)
    }

    #[test]
    fn norms_are_products_over_all_signs_and_division_undoes_products() {
        // r1 = 1 + x, r2 = 2 + sqrt r1
        let mut t = Tower { radicands: vec![vec![p(&[1, 1])]] };
        t.radicands.push(vec![p(&[2]), p(&[1])]);
        let a = vec![p(&[1, 2]), p(&[0, 1]), p(&[3]), p(&[1, 1])];
        let b = vec![p(&[5]), p(&[-1, 1]), p(&[0, 0, 1]), p(&[2])];
        let ab = t.times(&a, &b);
        assert_eq!(t.norm(&ab), &t.norm(&a) * &t.norm(&b));
        let (divided, count) = t.divide_out(t.times(&ab, &b), &Divisor::new(&t, b.clone()));
        assert_eq!((divided, count), (a.clone(), 2));
        assert!(t.exact_div(&t.plus(&ab, &[p(&[1])]), &Divisor::new(&t, b)).is_none());
        // the norm of sqrt r2 - r1 is ((1+x)^2 - 2)^2 - (1 + x)
        let u = t.minus(&t.root(), &[p(&[1, 1])]);
        let square = &p(&[1, 2, 1]) - &p(&[2]);
        assert_eq!(t.norm(&u), &(&square * &square) - &p(&[1, 1]));
        assert_eq!(t.times(&a, &t.cofactor(&a))[0], t.norm(&a));
    }

    #[test]
    fn squares_and_zero_are_radicands_like_others() {
        // t^2 = x^2: (t - x)(t + x) = 0, so that t - x has norm zero and divides nothing
        let square = Tower { radicands: vec![vec![p(&[0, 0, 1])]] };
        let divisor = vec![p(&[0, -1]), p(&[1])];
        assert!(square.norm(&divisor).is_zero());
        let d = Divisor::new(&square, divisor);
        assert_eq!(square.divide_out(vec![p(&[7])], &d), (vec![p(&[7])], 0));
        let nilpotent = Tower { radicands: vec![vec![p(&[])]] };
        assert_eq!(nilpotent.norm(&[p(&[3]), p(&[5, 1])]), p(&[9]));
    }
}
