//! Square roots adjoined one after the other, without asking whether they are new.
//!
//! Level `k` is the algebra `B_k = B_(k-1)[t] / (t^2 - r_k)` over the ring `B_0 = R`, whatever `r_k` in `B_(k-1)` is: a square, zero, or a
//! constant. An element has `2^k` coefficients; bit `j` of an index says whether the root of `r_(j+1)` is a factor. The norm to `R` is the
//! product over both signs of every root.

#![allow(clippy::unused_self, reason = "all arithmetic is asked of the same value")]

use super::ring::Ring;

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
    pub(super) fn cofactor(&self, a: &[R]) -> Element<R> {
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

/// What is needed to divide by an element.
#[derive(Clone)]
pub(super) struct Divisor<R> {
    pub(super) element: Element<R>,
    pub(super) cofactor: Element<R>,
    pub(super) norm: R,
}

impl<R: Ring> Divisor<R> {
    pub(super) fn new(tower: &Tower<R>, element: Element<R>) -> Self {
        let element = shortened(element);
        let (cofactor, norm) = (tower.cofactor(&element), tower.norm(&element));
        Self { element, cofactor, norm }
    }

    /// Whether the norm does not depend on the unknown: no singular position, and in a field one could divide for ever.
    pub(super) fn is_constant(&self) -> bool {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::poly::IntPoly;

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
