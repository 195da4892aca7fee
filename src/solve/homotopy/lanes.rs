//! `L` complex numbers side by side, one per path, so that the compiler fills SIMD registers.
//!
//! Plain loops over arrays of constant length: no intrinsics, no `unsafe`; with `L = 1` the same code is the
//! scalar tracker.

use num_complex::Complex64;
use std::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

/// `L` real numbers, one per lane.
pub(super) type Real<const L: usize> = [f64; L];

/// `L` complex numbers, one per lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lanes<const L: usize> {
    pub(super) re: Real<L>,
    pub(super) im: Real<L>,
}

impl<const L: usize> Lanes<L> {
    pub(super) const ZERO: Self = Self { re: [0.0; L], im: [0.0; L] };

    #[inline(always)]
    pub(super) fn splat(z: Complex64) -> Self {
        Self { re: [z.re; L], im: [z.im; L] }
    }

    #[inline(always)]
    pub(super) fn lane(&self, l: usize) -> Complex64 {
        Complex64::new(self.re[l], self.im[l])
    }

    #[inline(always)]
    pub(super) fn set_lane(&mut self, l: usize, z: Complex64) {
        self.re[l] = z.re;
        self.im[l] = z.im;
    }

    #[inline(always)]
    pub(super) fn conj(self) -> Self {
        Self { re: self.re, im: self.im.map(|x| -x) }
    }

    #[inline(always)]
    pub(super) fn norm_sqr(self) -> Real<L> {
        std::array::from_fn(|l| self.re[l] * self.re[l] + self.im[l] * self.im[l])
    }

    #[inline(always)]
    pub(super) fn scale(self, k: Real<L>) -> Self {
        Self {
            re: std::array::from_fn(|l| self.re[l] * k[l]),
            im: std::array::from_fn(|l| self.im[l] * k[l]),
        }
    }

    #[inline(always)]
    pub(super) fn times(self, k: f64) -> Self {
        Self { re: self.re.map(|x| x * k), im: self.im.map(|x| x * k) }
    }

    /// `1 / z`; infinite or NaN where `z` is zero.
    #[inline(always)]
    pub(super) fn recip(self) -> Self {
        let n = self.norm_sqr();
        self.conj().scale(n.map(|x| 1.0 / x))
    }

    /// `self + a b`.
    #[inline(always)]
    pub(super) fn mul_add(self, a: Self, b: Self) -> Self {
        let mut out = self;
        for l in 0..L {
            out.re[l] += a.re[l] * b.re[l] - a.im[l] * b.im[l];
            out.im[l] += a.re[l] * b.im[l] + a.im[l] * b.re[l];
        }
        out
    }

    /// `self - a b`.
    #[inline(always)]
    pub(super) fn mul_sub(self, a: Self, b: Self) -> Self {
        let mut out = self;
        for l in 0..L {
            out.re[l] -= a.re[l] * b.re[l] - a.im[l] * b.im[l];
            out.im[l] -= a.re[l] * b.im[l] + a.im[l] * b.re[l];
        }
        out
    }

    /// Lane by lane `if mask { other } else { self }`.
    #[inline(always)]
    pub(super) fn select(self, mask: [bool; L], other: Self) -> Self {
        Self {
            re: std::array::from_fn(|l| if mask[l] { other.re[l] } else { self.re[l] }),
            im: std::array::from_fn(|l| if mask[l] { other.im[l] } else { self.im[l] }),
        }
    }
}

impl<const L: usize> Add for Lanes<L> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self {
            re: std::array::from_fn(|l| self.re[l] + o.re[l]),
            im: std::array::from_fn(|l| self.im[l] + o.im[l]),
        }
    }
}

impl<const L: usize> Sub for Lanes<L> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self {
            re: std::array::from_fn(|l| self.re[l] - o.re[l]),
            im: std::array::from_fn(|l| self.im[l] - o.im[l]),
        }
    }
}

impl<const L: usize> Mul for Lanes<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        Self {
            re: std::array::from_fn(|l| self.re[l] * o.re[l] - self.im[l] * o.im[l]),
            im: std::array::from_fn(|l| self.re[l] * o.im[l] + self.im[l] * o.re[l]),
        }
    }
}

impl<const L: usize> Neg for Lanes<L> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { re: self.re.map(|x| -x), im: self.im.map(|x| -x) }
    }
}

impl<const L: usize> AddAssign for Lanes<L> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

impl<const L: usize> SubAssign for Lanes<L> {
    #[inline(always)]
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

/// A vector of eight unknowns per lane.
pub(super) type Vec8<const L: usize> = [Lanes<L>; 8];

/// Squared Euclidean norm, lane by lane.
#[inline(always)]
pub(super) fn norm_sqr<const L: usize>(x: &Vec8<L>) -> Real<L> {
    let mut sum = [0.0; L];
    for z in x {
        let n = z.norm_sqr();
        for l in 0..L {
            sum[l] += n[l];
        }
    }
    sum
}

/// An 8 x 8 LU factorisation with partial pivoting, every lane its own row exchanges.
#[derive(Debug, Clone)]
pub(super) struct Lu<const L: usize> {
    factors: [[Lanes<L>; 8]; 8],
    inverse_pivots: [Lanes<L>; 8],
    pivot_rows: [[usize; L]; 8],
    /// Smallest over largest pivot modulus squared, a crude measure of singularity.
    pub(super) pivot_ratio: Real<L>,
}

impl<const L: usize> Lu<L> {
    /// Factorises `a` in place.
    #[inline(always)]
    pub(super) fn factorise(mut a: [[Lanes<L>; 8]; 8]) -> Self {
        let mut inverse_pivots = [Lanes::ZERO; 8];
        let mut pivot_rows = [[0; L]; 8];
        let (mut least, mut greatest) = ([f64::INFINITY; L], [0.0f64; L]);
        for k in 0..8 {
            let mut best = a[k][k].norm_sqr();
            let mut row = [k; L];
            for i in k + 1..8 {
                let n = a[i][k].norm_sqr();
                for l in 0..L {
                    let larger = n[l] > best[l];
                    best[l] = if larger { n[l] } else { best[l] };
                    row[l] = if larger { i } else { row[l] };
                }
            }
            pivot_rows[k] = row;
            for i in k + 1..8 {
                let mask: [bool; L] = row.map(|r| r == i);
                if mask.iter().any(|&m| m) {
                    for j in 0..8 {
                        let (top, here) = (a[k][j], a[i][j]);
                        a[k][j] = top.select(mask, here);
                        a[i][j] = here.select(mask, top);
                    }
                }
            }
            for l in 0..L {
                least[l] = least[l].min(best[l]);
                greatest[l] = greatest[l].max(best[l]);
            }
            let inverse = a[k][k].recip();
            inverse_pivots[k] = inverse;
            let pivot_row = a[k];
            for i in k + 1..8 {
                let factor = a[i][k] * inverse;
                a[i][k] = factor;
                for j in k + 1..8 {
                    a[i][j] = a[i][j].mul_sub(factor, pivot_row[j]);
                }
            }
        }
        let pivot_ratio = std::array::from_fn(|l| least[l] / greatest[l]);
        Self { factors: a, inverse_pivots, pivot_rows, pivot_ratio }
    }

    /// Solves `A x = b`.
    #[inline(always)]
    pub(super) fn solve(&self, mut b: Vec8<L>) -> Vec8<L> {
        for k in 0..8 {
            let row = self.pivot_rows[k];
            for i in k + 1..8 {
                let mask: [bool; L] = row.map(|r| r == i);
                if mask.iter().any(|&m| m) {
                    let (top, here) = (b[k], b[i]);
                    b[k] = top.select(mask, here);
                    b[i] = here.select(mask, top);
                }
            }
        }
        for i in 1..8 {
            for j in 0..i {
                b[i] = b[i].mul_sub(self.factors[i][j], b[j]);
            }
        }
        for i in (0..8).rev() {
            for j in i + 1..8 {
                b[i] = b[i].mul_sub(self.factors[i][j], b[j]);
            }
            b[i] = b[i] * self.inverse_pivots[i];
        }
        b
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::Rng;

    #[test]
    fn lu_solves_random_systems_in_every_lane() {
        let mut rng = Rng::new(5);
        let mut random = || {
            let mut z = Lanes::<4>::ZERO;
            for l in 0..4 {
                z.set_lane(l, Complex64::new(rng.normal(), rng.normal()));
            }
            z
        };
        for _ in 0..50 {
            let mut a: [[Lanes<4>; 8]; 8] = std::array::from_fn(|_| std::array::from_fn(|_| random()));
            a[0][0] = Lanes::ZERO; // forces an exchange
            let x: Vec8<4> = std::array::from_fn(|_| random());
            let b = a.map(|row| row.iter().zip(&x).fold(Lanes::ZERO, |s, (p, q)| s.mul_add(*p, *q)));
            let y = Lu::factorise(a).solve(b);
            for (p, q) in x.iter().zip(&y) {
                assert!((*p - *q).norm_sqr().iter().all(|n| n.sqrt() < 1e-10));
            }
        }
    }
}
