//! Polynomials with coefficients in a field of square roots, and the real roots of those.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_traits::{Signed, Zero};

use super::{Dyadic, IntPoly, RealRoot, real_roots};
use crate::algebraic::Algebraic;
use crate::exact::{Rational, primitive};

/// Relative width of the enclosure of a root, as a power of two.
const ROOT_BITS: u32 = 60;

/// A real root between two doubles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EnclosedRoot {
    /// The lower bound.
    pub low: f64,
    /// The upper bound, equal to the lower one if the root is a double.
    pub high: f64,
    /// Its multiplicity.
    pub multiplicity: usize,
}

impl From<&RealRoot> for EnclosedRoot {
    fn from(root: &RealRoot) -> Self {
        let mut root = root.clone();
        root.refine_relative(ROOT_BITS);
        Self::between(root.low(), root.high(), root.multiplicity())
    }
}

impl EnclosedRoot {
    fn between(low: &Dyadic, high: &Dyadic, multiplicity: usize) -> Self {
        let [lower, upper] = [low, high].map(Dyadic::to_f64);
        let exact = low == high && Dyadic::from_f64(lower).as_ref() == Some(low);
        let (low, high) = if exact { (lower, upper) } else { (lower.next_down(), upper.next_up()) };
        Self { low, high, multiplicity }
    }
}

/// `c_0 + c_1 x + .. + c_n x^n` over a field of square roots, `c_n != 0`; zero has no coefficients.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldPoly(Vec<Algebraic>);

/// The real roots of a polynomial.
#[derive(Debug, Clone, PartialEq)]
pub struct RootCount {
    /// Different complex roots.
    pub distinct: usize,
    /// Different real roots, by Sturm's theorem over the whole line.
    pub sturm: usize,
    /// The real roots, ascending.
    pub real: Vec<EnclosedRoot>,
}

impl From<&IntPoly> for RootCount {
    /// The enclosures by Descartes' rule, which is independent of the count.
    fn from(p: &IntPoly) -> Self {
        let repeated = super::gcd(p, &p.derivative()).degree().unwrap_or(0);
        Self {
            distinct: p.degree().unwrap_or(0) - repeated,
            sturm: super::sturm_count_of_line(p),
            real: real_roots(p).iter().map(EnclosedRoot::from).collect(),
        }
    }
}

impl FieldPoly {
    /// From coefficients, the constant one first; zeros at the end are dropped.
    #[must_use]
    pub fn new(mut coefficients: Vec<Algebraic>) -> Self {
        while coefficients.last().is_some_and(Algebraic::is_zero) {
            coefficients.pop();
        }
        Self(coefficients)
    }

    /// The coefficients, the constant one first.
    #[must_use]
    pub fn coefficients(&self) -> &[Algebraic] {
        &self.0
    }

    /// The degree; `None` for zero.
    #[must_use]
    pub fn degree(&self) -> Option<usize> {
        self.0.len().checked_sub(1)
    }

    /// A multiple with integer coefficients without a common factor, if there is one.
    #[must_use]
    pub fn integers(&self) -> Option<IntPoly> {
        let scaled = without_common_factor(&self.0, self.0.last());
        let whole: Option<Vec<BigInt>> =
            scaled.iter().map(|c| c.as_rational().map(Rational::to_integer)).collect();
        whole.map(IntPoly::new)
    }

    /// Quotient and remainder; the divisor must be nonzero.
    #[must_use]
    pub fn divided(&self, divisor: &Self) -> (Self, Self) {
        let mut rest = self.0.clone();
        let n = divisor.0.len();
        let Some(lead) = divisor.0.last() else { return (Self(Vec::new()), self.clone()) };
        let mut quotient = Vec::new();
        while rest.len() >= n {
            let top = rest.pop().unwrap_or_else(|| Algebraic::integer(0));
            let factor = &top / lead;
            let shift = rest.len() + 1 - n;
            for (k, d) in divisor.0[..n - 1].iter().enumerate() {
                rest[shift + k] = &rest[shift + k] - &(&factor * d);
            }
            quotient.push(factor);
        }
        quotient.reverse();
        (Self::new(quotient), Self::new(rest))
    }

    /// The roots. Sturm's theorem counts and isolates them; multiplicities come from common divisors with derivatives.
    #[must_use]
    pub fn roots(&self) -> RootCount {
        if let Some(integers) = self.integers() {
            return (&integers).into();
        }
        let mut parts = vec![self.square_free()];
        let mut rest = self.divided(&parts[0]).0;
        while rest.degree() > Some(0) {
            parts.push(rest.square_free());
            rest = rest.divided(&parts[parts.len() - 1]).0;
        }
        let chains: Vec<Sturm> = parts.iter().map(Sturm::of).collect();
        let bound = parts[0].root_bound();
        let ends = [Dyadic::new((-1).into(), bound), Dyadic::new(1.into(), bound)];
        let mut real = Vec::new();
        chains[0].isolate(&ends[0], &ends[1], &mut real);
        let enclosed = |(low, high): &(Dyadic, Dyadic)| {
            let times = chains.iter().filter(|c| c.between(low, high) > 0).count();
            let (low, high) = parts[0].refined(low, high);
            EnclosedRoot::between(&low, &high, times)
        };
        RootCount {
            distinct: parts[0].degree().unwrap_or(0),
            sturm: chains[0].changes_far(-1).saturating_sub(chains[0].changes_far(1)),
            real: real.iter().map(enclosed).collect(),
        }
    }

    fn monic(&self) -> Self {
        let Some(lead) = self.0.last() else { return self.clone() };
        Self(self.0.iter().map(|c| c / lead).collect())
    }

    fn derivative(&self) -> Self {
        let terms = (1..).zip(self.0.iter().skip(1));
        Self::new(terms.map(|(k, c)| c * &Algebraic::integer(k)).collect())
    }

    fn square_free(&self) -> Self {
        let (mut a, mut b) = (self.clone(), self.derivative());
        while b.degree().is_some() {
            let rest = a.divided(&b).1.monic();
            (a, b) = (b, rest);
        }
        self.divided(&a).0.monic()
    }

    fn sign_at(&self, x: &Dyadic) -> Ordering {
        let x = Algebraic::Rational(x.to_rational());
        let value = self.0.iter().rev().fold(Algebraic::integer(0), |sum, c| &(&sum * &x) + c);
        value.surd().sign()
    }

    /// All real roots are between `-2^k` and `2^k` (Cauchy).
    fn root_bound(&self) -> i64 {
        let monic = self.monic();
        monic.0.iter().map(|c| c.surd().magnitude_bits()).max().unwrap_or(0).max(0) + 1
    }

    /// The root of a square-free polynomial with `low < x <= high`, refined.
    fn refined(&self, low: &Dyadic, high: &Dyadic) -> (Dyadic, Dyadic) {
        let (mut low, mut high) = (low.clone(), high.clone());
        let above = self.sign_at(&high);
        if above == Ordering::Equal {
            return (high.clone(), high);
        }
        loop {
            let width = high.minus(&low).log2_floor();
            let size = low.log2_floor().min(high.log2_floor());
            if width.zip(size).is_some_and(|(width, size)| width < size - i64::from(ROOT_BITS)) {
                return (low, high);
            }
            let middle = low.midpoint(&high);
            match self.sign_at(&middle) {
                Ordering::Equal => return (middle.clone(), middle),
                sign if sign == above => high = middle,
                _ => low = middle,
            }
        }
    }
}

/// Numbers divided by the leading one. If all ratios are fractions, they become integers without a common factor, with
/// a positive leading one.
#[must_use]
pub fn without_common_factor(numbers: &[Algebraic], lead: Option<&Algebraic>) -> Vec<Algebraic> {
    let Some(lead) = lead else { return numbers.to_vec() };
    let ratios: Vec<Algebraic> = numbers.iter().map(|x| x / lead).collect();
    let fractions: Option<Vec<Rational>> = ratios.iter().map(|x| x.as_rational().cloned()).collect();
    let Some(list) = fractions else { return ratios };
    // the first nonzero number is positive there
    let backwards = list.iter().find(|x| !x.is_zero()).is_some_and(Signed::is_negative);
    let whole = primitive(&list).into_iter().map(|x| if backwards { -x } else { x });
    whole.map(Algebraic::Rational).collect()
}

/// The Sturm chain of a square-free polynomial.
struct Sturm(Vec<FieldPoly>);

impl Sturm {
    fn of(p: &FieldPoly) -> Self {
        let mut chain = vec![p.clone(), p.derivative()];
        while let [.., a, b] = chain.as_slice() {
            if b.degree().is_none() {
                chain.pop();
                break;
            }
            let rest = a.divided(b).1;
            chain.push(FieldPoly(rest.0.iter().map(|c| -c).collect()));
        }
        Self(chain)
    }

    /// Changes of sign at minus (`side` -1) or plus infinity (1).
    fn changes_far(&self, side: i8) -> usize {
        let sign = |p: &FieldPoly| {
            let lead = p.0.last().map_or(Ordering::Equal, |c| c.surd().sign());
            if side < 0 && p.0.len().is_multiple_of(2) { lead.reverse() } else { lead }
        };
        changes(self.0.iter().map(sign))
    }

    fn changes_at(&self, x: &Dyadic) -> usize {
        changes(self.0.iter().map(|p| p.sign_at(x)))
    }

    /// Roots with `low < x <= high`.
    fn between(&self, low: &Dyadic, high: &Dyadic) -> usize {
        self.changes_at(low).saturating_sub(self.changes_at(high))
    }

    fn isolate(&self, low: &Dyadic, high: &Dyadic, found: &mut Vec<(Dyadic, Dyadic)>) {
        match self.between(low, high) {
            0 => {}
            1 => found.push((low.clone(), high.clone())),
            _ => {
                let middle = low.midpoint(high);
                self.isolate(low, &middle, found);
                self.isolate(&middle, high, found);
            }
        }
    }
}

fn changes(signs: impl Iterator<Item = Ordering>) -> usize {
    let signs: Vec<Ordering> = signs.filter(|s| *s != Ordering::Equal).collect();
    signs.windows(2).filter(|w| w[0] != w[1]).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surd::Surd;

    fn product(a: &FieldPoly, b: &FieldPoly) -> FieldPoly {
        let mut out = vec![Algebraic::integer(0); a.0.len() + b.0.len() - 1];
        for (i, x) in a.0.iter().enumerate() {
            for (j, y) in b.0.iter().enumerate() {
                out[i + j] = &out[i + j] + &(x * y);
            }
        }
        FieldPoly::new(out)
    }

    #[test]
    fn roots_over_a_field_have_their_enclosures_and_multiplicities() {
        let root = Algebraic::all(&[&Surd::integer(2).sqrt().unwrap()]).unwrap().remove(0);
        let one = Algebraic::integer(1);
        // (x - sqrt(2))^2 (x - 1) (x^2 + sqrt(2))
        let near = FieldPoly::new(vec![-&root, one.clone()]);
        let other = FieldPoly::new(vec![Algebraic::integer(-1), one.clone()]);
        let complex = FieldPoly::new(vec![root, Algebraic::integer(0), one]);
        let p = [&near, &other, &complex].into_iter().fold(near.clone(), |p, q| product(&p, q));
        assert_eq!(p.integers(), None);
        let found = p.roots();
        assert_eq!((found.distinct, found.sturm), (4, 2));
        assert_eq!(found.real.iter().map(|r| r.multiplicity).collect::<Vec<_>>(), [1, 2]);
        assert!([found.real[0].low, found.real[0].high].iter().all(|x| (x - 1.0).abs() <= 0.0));
        assert!(found.real[1].low < 2f64.sqrt() && 2f64.sqrt() < found.real[1].high);
        // a multiple of an integer polynomial is recognised as one
        let scaled = FieldPoly::new(vec![-&near.0[0], near.0[0].clone()]);
        assert_eq!(scaled.integers(), Some(IntPoly::from_i64(&[-1, 1])));
    }
}
