//! Complex numbers side by side, one per path, in SIMD registers.
//!
//! `S` is the vector unit found at run time (`pulp`): eight lanes with AVX-512, four with AVX2, one for the
//! scalar tracker of the endgame. Real and imaginary parts are kept apart, so that a complex product is four
//! fused multiply-adds for all lanes.

use num_complex::Complex64;
use pulp::Simd;
use pulp::bytemuck::{cast_slice, cast_slice_mut};
use std::ops::{AddAssign, SubAssign};

/// Most lanes of any unit; per-lane bookkeeping is kept in arrays of this length.
pub(super) const MOST_LANES: usize = 8;

/// One real number per lane, `[x; MOST_LANES]` with the tail unused.
pub(super) type PerLane = [f64; MOST_LANES];

/// One complex number per lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lanes<S: Simd> {
    pub(super) re: S::f64s,
    pub(super) im: S::f64s,
    pub(super) simd: S,
}

/// The first lanes of `x` in a register.
#[inline(always)]
pub(super) fn load<S: Simd>(simd: S, x: &PerLane) -> S::f64s {
    let mut v = simd.splat_f64s(0.0);
    cast_slice_mut::<S::f64s, f64>(std::slice::from_mut(&mut v)).copy_from_slice(&x[..S::F64_LANES]);
    v
}

/// The lanes of a register, padded with zeros.
#[inline(always)]
pub(super) fn store<S: Simd>(v: S::f64s) -> PerLane {
    let mut x = [0.0; MOST_LANES];
    x[..S::F64_LANES].copy_from_slice(cast_slice::<S::f64s, f64>(std::slice::from_ref(&v)));
    x
}

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    pub(super) fn zero(simd: S) -> Self {
        let zero = simd.splat_f64s(0.0);
        Self { re: zero, im: zero, simd }
    }

    #[inline(always)]
    pub(super) fn splat(simd: S, z: Complex64) -> Self {
        Self { re: simd.splat_f64s(z.re), im: simd.splat_f64s(z.im), simd }
    }

    #[inline(always)]
    pub(super) fn lane(&self, l: usize) -> Complex64 {
        let part = |v: &S::f64s| cast_slice::<S::f64s, f64>(std::slice::from_ref(v))[l];
        Complex64::new(part(&self.re), part(&self.im))
    }

    #[inline(always)]
    pub(super) fn set_lane(&mut self, l: usize, z: Complex64) {
        cast_slice_mut::<S::f64s, f64>(std::slice::from_mut(&mut self.re))[l] = z.re;
        cast_slice_mut::<S::f64s, f64>(std::slice::from_mut(&mut self.im))[l] = z.im;
    }

    #[inline(always)]
    pub(super) fn conj(self) -> Self {
        Self { im: self.simd.neg_f64s(self.im), ..self }
    }

    #[inline(always)]
    pub(super) fn norm_sqr(self) -> S::f64s {
        let s = self.simd;
        s.mul_add_e_f64s(self.re, self.re, s.mul_f64s(self.im, self.im))
    }

    #[inline(always)]
    pub(super) fn scale(self, k: S::f64s) -> Self {
        let s = self.simd;
        Self { re: s.mul_f64s(self.re, k), im: s.mul_f64s(self.im, k), simd: s }
    }

    #[inline(always)]
    pub(super) fn times(self, k: f64) -> Self {
        self.scale(self.simd.splat_f64s(k))
    }

    /// `1 / z`; infinite or NaN where `z` is zero.
    #[inline(always)]
    pub(super) fn recip(self) -> Self {
        let s = self.simd;
        self.conj().scale(s.div_f64s(s.splat_f64s(1.0), self.norm_sqr()))
    }

    /// `self + a b`.
    #[inline(always)]
    pub(super) fn mul_add(self, a: Self, b: Self) -> Self {
        let s = self.simd;
        Self {
            re: s.negate_mul_add_e_f64s(a.im, b.im, s.mul_add_e_f64s(a.re, b.re, self.re)),
            im: s.mul_add_e_f64s(a.im, b.re, s.mul_add_e_f64s(a.re, b.im, self.im)),
            simd: s,
        }
    }

    /// `self - a b`.
    #[inline(always)]
    pub(super) fn mul_sub(self, a: Self, b: Self) -> Self {
        let s = self.simd;
        Self {
            re: s.mul_add_e_f64s(a.im, b.im, s.negate_mul_add_e_f64s(a.re, b.re, self.re)),
            im: s.negate_mul_add_e_f64s(a.im, b.re, s.negate_mul_add_e_f64s(a.re, b.im, self.im)),
            simd: s,
        }
    }

    /// Lane by lane `if mask { other } else { self }`.
    #[inline(always)]
    pub(super) fn select(self, mask: S::m64s, other: Self) -> Self {
        let s = self.simd;
        Self {
            re: s.select_f64s(mask, other.re, self.re),
            im: s.select_f64s(mask, other.im, self.im),
            simd: s,
        }
    }
}

num::operators! {
    [inline(always)] [S: Simd] Lanes<S>;
    Neg::neg(x) {
        let s = x.simd;
        Self { re: s.neg_f64s(x.re), im: s.neg_f64s(x.im), simd: s }
    }
    Add::add(x, y) {
        let s = x.simd;
        Self { re: s.add_f64s(x.re, y.re), im: s.add_f64s(x.im, y.im), simd: s }
    }
    Sub::sub(x, y) {
        let s = x.simd;
        Self { re: s.sub_f64s(x.re, y.re), im: s.sub_f64s(x.im, y.im), simd: s }
    }
    Mul::mul(x, y) {
        let s = x.simd;
        Self {
            re: s.negate_mul_add_e_f64s(x.im, y.im, s.mul_f64s(x.re, y.re)),
            im: s.mul_add_e_f64s(x.re, y.im, s.mul_f64s(x.im, y.re)),
            simd: s,
        }
    }
}

impl<S: Simd> AddAssign for Lanes<S> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

impl<S: Simd> SubAssign for Lanes<S> {
    #[inline(always)]
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

/// A vector of eight unknowns per lane.
pub(super) type Vec8<S> = [Lanes<S>; 8];

/// An 8 x 8 matrix per lane, by rows.
pub(super) type Matrix8<S> = [[Lanes<S>; 8]; 8];

/// Squared Euclidean norm, lane by lane.
#[inline(always)]
pub(super) fn norm_sqr<S: Simd>(x: &Vec8<S>) -> S::f64s {
    let s = x[0].simd;
    let mut sum = x[0].norm_sqr();
    for z in &x[1..] {
        sum = s.mul_add_e_f64s(z.re, z.re, s.mul_add_e_f64s(z.im, z.im, sum));
    }
    sum
}
