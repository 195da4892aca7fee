//! Elements of the tower over products of the singular factors.

#![allow(clippy::unused_self, reason = "all arithmetic is asked of the same value")]

use num_bigint::BigInt;

use super::ring::Ring;
use super::tower::{Divisor, Element, Tower, is_zero, shortened, zero};

/// The number of unoriented steps.
pub(super) const STEPS: usize = 3;

/// `numerator / prod D_t^exponent_t`, `D_t` the numerator of the singular factor of step `t`; exponents may be negative.
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
    pub(super) cancel: bool,
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
