//! Arithmetic of the proof: real numbers with an error radius, eight discs of complex numbers side by side, and the
//! coefficients from a triangle.
//!
//! A computed sum, product, quotient or root is off by at most `u` times its modulus, as for discs (`num::ball`). Radii
//! are sums of products of non-negative numbers; [`UP`] and [`TINY`] take up their own rounding and underflow.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use num::ball::{Real, TINY, UP};
use num::batch::{ComplexBatch, LANES};

const U: f64 = f64::EPSILON / 2.0;

/// Encloses `1 / x`; the radius is infinite when the ball may hold zero.
pub(in crate::solve::certify) fn reciprocal(x: Real) -> Real {
    x.reciprocal().unwrap_or(Real { centre: x.centre.recip(), radius: f64::INFINITY })
}

/// Encloses the positive root; the radius is infinite when the ball may hold zero or less.
pub(in crate::solve::certify) fn root(x: Real) -> Real {
    x.sqrt().unwrap_or(Real { centre: x.centre.sqrt(), radius: f64::INFINITY })
}

/// Eight reals.
#[derive(Debug, Clone, Copy)]
pub(in crate::solve::certify) struct Reals(pub(in crate::solve::certify) [f64; LANES]);

impl Reals {
    pub(in crate::solve::certify) const ZERO: Self = Self([0.0; LANES]);

    #[inline(always)]
    pub(in crate::solve::certify) fn all(x: f64) -> Self {
        Self([x; LANES])
    }

    #[inline(always)]
    pub(in crate::solve::certify) fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut out = Self::ZERO;
        for k in 0..LANES {
            out.0[k] = f(self.0[k], other.0[k]);
        }
        out
    }

    #[inline(always)]
    pub(in crate::solve::certify) fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut out = Self::ZERO;
        for k in 0..LANES {
            out.0[k] = f(self.0[k]);
        }
        out
    }

    /// The larger, or NaN where one is NaN.
    #[inline(always)]
    pub(in crate::solve::certify) fn largest(self, other: Self) -> Self {
        self.zip(other, |a, b| if a >= b { a } else { b + 0.0 * a })
    }

    #[inline(always)]
    pub(in crate::solve::certify) fn times(self, c: f64) -> Self {
        self.map(|x| x * c)
    }

    #[inline(always)]
    pub(in crate::solve::certify) fn plus(self, c: f64) -> Self {
        self.map(|x| x + c)
    }

    /// Makes a bound computed in fewer than a thousand operations on non-negative numbers an upper bound.
    #[inline(always)]
    pub(in crate::solve::certify) fn up(self) -> Self {
        self.map(|x| (x + TINY) * UP)
    }
}

num::operators! {
    [inline(always)] [] Reals;
    Add::add(x, y) {
        x.zip(y, |a, b| a + b)
    }
    Mul::mul(x, y) {
        x.zip(y, |a, b| a * b)
    }
}

/// `|re| + |im|`, at least the modulus.
#[inline(always)]
pub(in crate::solve::certify) fn sizes(z: &ComplexBatch) -> Reals {
    let mut out = Reals::ZERO;
    for k in 0..LANES {
        out.0[k] = z.re[k].abs() + z.im[k].abs();
    }
    out
}

/// The larger of `|re|` and `|im|`, at most the modulus.
#[inline(always)]
pub(in crate::solve::certify) fn parts(z: &ComplexBatch) -> Reals {
    let mut out = Reals::ZERO;
    for k in 0..LANES {
        let (re, im) = (z.re[k].abs(), z.im[k].abs());
        out.0[k] = if re > im { re } else { im };
    }
    out
}

/// Eight discs; an infinite or NaN radius says nothing.
#[derive(Debug, Clone, Copy)]
pub(in crate::solve::certify) struct Discs {
    pub(in crate::solve::certify) c: ComplexBatch,
    pub(in crate::solve::certify) r: Reals,
}

impl Discs {
    pub(in crate::solve::certify) const ZERO: Self = Self { c: ComplexBatch::ZERO, r: Reals::ZERO };

    /// Upper bounds of the moduli.
    #[inline(always)]
    pub(in crate::solve::certify) fn magnitude(&self) -> Reals {
        (sizes(&self.c) + self.r).up()
    }

    #[inline(always)]
    pub(in crate::solve::certify) fn plus(self, x: Real) -> Self {
        let c = self.c.plus(x.centre);
        Self { c, r: (self.r.plus(x.radius) + sizes(&c).times(U)).up() }
    }

    /// Product with a real ball: two roundings less than a complex product.
    #[inline(always)]
    pub(in crate::solve::certify) fn times(self, x: Real) -> Self {
        let z = sizes(&self.c);
        let (size, rest) = (x.centre.abs(), x.radius);
        let r = z.times(rest + 2.0 * U * size) + self.r.times(size + rest);
        Self { c: self.c.times(x.centre), r: r.up() }
    }

    #[inline(always)]
    pub(in crate::solve::certify) fn widen(&mut self, by: Reals) {
        self.r = (self.r + by).up();
    }

    /// Encloses `1 / z`; infinite or NaN radius where the disc may hold zero. See `Disc::reciprocal`.
    #[inline(always)]
    pub(in crate::solve::certify) fn reciprocal(self) -> Self {
        let c = self.c.reciprocal();
        let mut r = Reals::ZERO;
        for k in 0..LANES {
            let square = self.c.re[k] * self.c.re[k] + self.c.im[k] * self.c.im[k];
            let modulus = square.sqrt() * (2.0 - UP);
            let low = (modulus - self.r.0[k] * UP) * (2.0 - UP);
            let size = c.re[k].abs() + c.im[k].abs();
            let radius = (self.r.0[k] / (modulus * low) + 10.0 * U * size + TINY) * UP;
            // squares that may have underflowed, or a disc about zero, prove nothing
            r.0[k] = if low > TINY && square > TINY { radius } else { f64::INFINITY };
        }
        Self { c, r }
    }
}

num::operators! {
    [inline(always)] [] Discs;
    Neg::neg(x) {
        Self { c: x.c.times(-1.0), r: x.r }
    }
    Add::add(x, y) {
        let c = x.c + y.c;
        Self { c, r: (x.r + y.r + sizes(&c).times(U)).up() }
    }
    Sub::sub(x, y) {
        let c = x.c - y.c;
        Self { c, r: (x.r + y.r + sizes(&c).times(U)).up() }
    }
    Mul::mul(x, y) {
        let (z, w) = (sizes(&x.c), sizes(&y.c));
        let r = z * y.r + x.r * (w + y.r) + (z * w).times(3.0 * U);
        Self { c: x.c * y.c, r: r.up() }
    }
}

/// A point or vector, coordinate by coordinate.
pub(in crate::solve::certify) type RealVector = [Real; 3];

fn dot(a: &RealVector, b: &RealVector) -> Real {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: &RealVector, b: &RealVector) -> RealVector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// A triangle `A, B, C`: products of `b = B - A`, `c = C - A`, and a frame with `B = (len, 0)`, `C = (u, v)`.
#[derive(Debug, Clone)]
pub(in crate::solve::certify) struct CertifiedTriangle {
    pub(in crate::solve::certify) bb: Real,
    pub(in crate::solve::certify) cc: Real,
    /// `|b - c|^2`.
    pub(in crate::solve::certify) opposite: Real,
    pub(in crate::solve::certify) len: Real,
    pub(in crate::solve::certify) u: Real,
    pub(in crate::solve::certify) v: Real,
    /// Rows: along `b`, in the plane towards `C`, normal.
    pub(in crate::solve::certify) axes: [RealVector; 3],
}

impl CertifiedTriangle {
    /// The triangle from its enclosed corners.
    pub(in crate::solve::certify) fn of(p: [RealVector; 3]) -> Self {
        let side = |i: usize, j: usize| -> RealVector { [0, 1, 2].map(|k| p[i][k] - p[j][k]) };
        let (b, c, a) = (side(1, 0), side(2, 0), side(2, 1));
        let normal = cross(&b, &c);
        let bb = dot(&b, &b);
        let (len, height) = (root(bb), root(dot(&normal, &normal)));
        let (inverse, across) = (reciprocal(len), reciprocal(height));
        let x = b.map(|z| z * inverse);
        let z = normal.map(|z| z * across);
        let axes = [x, cross(&z, &x), z];
        let (u, v) = (dot(&b, &c) * inverse, height * inverse);
        Self { bb, cc: dot(&c, &c), opposite: dot(&a, &a), len, u, v, axes }
    }

    /// Largest radius of an entry of the frame.
    pub(in crate::solve::certify) fn axes_radius(&self) -> f64 {
        self.axes.iter().flatten().fold(0.0, |m, z| if z.radius <= m { m } else { z.radius })
    }
}
