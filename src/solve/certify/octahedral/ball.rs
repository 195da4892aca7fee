//! Real numbers with an error radius, and what a triangle contributes to the proof.
//!
//! As for discs (`num::disc`): a computed sum, product, quotient or root is off by at most `u` times its modulus, radii are
//! sums of products of non-negative numbers, and [`UP`] and [`TINY`] take up their own rounding and underflow.

use std::ops::{Add, Mul, Neg, Sub};

use crate::num::disc::{TINY, UP};

const U: f64 = f64::EPSILON / 2.0;

/// All reals within `r` of `c`; an infinite or NaN radius says nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ball {
    pub(super) c: f64,
    pub(super) r: f64,
}

impl Ball {
    pub(super) const ZERO: Self = Self { c: 0.0, r: 0.0 };

    /// The number itself.
    pub(super) fn exact(c: f64) -> Self {
        Self { c, r: 0.0 }
    }

    /// The difference of two doubles.
    pub(super) fn difference(a: f64, b: f64) -> Self {
        let c = a - b;
        Self { c, r: (U * c.abs() + TINY) * UP }
    }

    /// Upper bound of the moduli.
    pub(super) fn magnitude(self) -> f64 {
        (self.c.abs() + self.r) * UP
    }

    /// Product with a power of two, exact barring underflow.
    pub(super) fn scaled(self, power_of_two: f64) -> Self {
        Self { c: self.c * power_of_two, r: self.r * power_of_two }
    }

    /// Encloses `1 / z`; the radius is infinite when the ball may hold zero.
    pub(super) fn reciprocal(self) -> Self {
        let c = self.c.recip();
        let low = (self.c.abs() - self.r * UP) * (2.0 - UP);
        if low > TINY {
            return Self { c, r: (self.r / (self.c.abs() * low) + 2.0 * U * c.abs() + TINY) * UP };
        }
        Self { c, r: f64::INFINITY }
    }

    /// Encloses the positive root; the radius is infinite when the ball may hold zero or less.
    ///
    /// `|sqrt z - sqrt c| <= |z - c| / sqrt c`.
    pub(super) fn sqrt(self) -> Self {
        let c = self.c.sqrt();
        if self.c > self.r * UP && c > TINY {
            return Self { c, r: (self.r / c + 2.0 * U * c + TINY) * UP };
        }
        Self { c, r: f64::INFINITY }
    }
}

impl Neg for Ball {
    type Output = Self;
    fn neg(self) -> Self {
        Self { c: -self.c, r: self.r }
    }
}

impl Add for Ball {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let c = self.c + other.c;
        Self { c, r: (self.r + other.r + U * c.abs() + TINY) * UP }
    }
}

impl Sub for Ball {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Ball {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let c = self.c * other.c;
        let r = self.c.abs() * other.r + self.r * (other.c.abs() + other.r) + U * c.abs() + TINY;
        Self { c, r: r * UP }
    }
}

type Vector = [Ball; 3];

fn dot(a: &Vector, b: &Vector) -> Ball {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// A triangle `A, B, C`: products of `b = B - A`, `c = C - A`, and a frame with `B = (len, 0)`, `C = (u, v)`.
#[derive(Debug, Clone)]
pub(super) struct Triangle {
    pub(super) bb: Ball,
    pub(super) bc: Ball,
    pub(super) cc: Ball,
    /// `|b - c|^2`.
    pub(super) opposite: Ball,
    /// `bb cc - bc^2 = |b x c|^2`.
    pub(super) area: Ball,
    pub(super) len: Ball,
    pub(super) u: Ball,
    pub(super) v: Ball,
    /// Rows: along `b`, in the plane towards `C`, normal.
    pub(super) axes: [Vector; 3],
}

impl Triangle {
    /// From exact corners.
    pub(super) fn of(p: [[f64; 3]; 3]) -> Self {
        let side = |i: usize, j: usize| -> Vector { [0, 1, 2].map(|k| Ball::difference(p[i][k], p[j][k])) };
        let (b, c, a) = (side(1, 0), side(2, 0), side(2, 1));
        let normal = cross(&b, &c);
        let (bb, bc, area) = (dot(&b, &b), dot(&b, &c), dot(&normal, &normal));
        let (len, height) = (bb.sqrt(), area.sqrt());
        let (inverse, across) = (len.reciprocal(), height.reciprocal());
        let x = b.map(|z| z * inverse);
        let z = normal.map(|z| z * across);
        let axes = [x, cross(&z, &x), z];
        let (u, v) = (bc * inverse, height * inverse);
        Self { bb, bc, cc: dot(&c, &c), opposite: dot(&a, &a), area, len, u, v, axes }
    }

    /// Largest radius of an entry of the frame.
    pub(super) fn axes_radius(&self) -> f64 {
        self.axes.iter().flatten().fold(0.0, |m, z| if z.r <= m { m } else { z.r })
    }
}
