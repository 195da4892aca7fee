//! From enclosed `(x, y)` to the platform triangle in the frame of the base triangle, and to its axes.
//!
//! Every step is a formula for the root itself, evaluated on discs, so that the results hold the pose of the root. They stay finite only
//! where `P4` and `P5` are proved to lie off the base plane and `P1 P3 P4 P5` to be no flat tetrahedron, which the theorem asks for.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use super::ball::{Ball, Triangle};
use super::lanes::{Discs, Reals};

pub(super) type Points = [Discs; 3];

/// One of the two mirror images.
pub(super) struct Placed {
    /// `P4`, in the frame of the base triangle with `P1` in the origin.
    pub(super) p4: Points,
    /// Columns: axes of the platform triangle's frame in that of the base triangle.
    pub(super) frame: [Points; 3],
    /// Squared height of `P4`; excludes zero where the radii are finite.
    pub(super) squared_height: Discs,
}

#[inline(always)]
fn cross(a: &Points, b: &Points) -> Points {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn dot(a: &Points, b: &Points) -> Discs {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Design and lengths, in cyclic order `s14 s24 s25 s35 s36 s16`; the platform triangle is `P4 P5 P6`.
pub(super) struct Data<'a> {
    pub(super) base: &'a Triangle,
    pub(super) platform: &'a Triangle,
    pub(super) s: &'a [Ball; 6],
}

/// Corners as functions of `x` and `y` over discs: `P4` of `y` and `P5` of `x` alone, by square roots, `P6` of both.
struct Corners {
    p4: Points,
    p5: Points,
    p6: Points,
    squared_height: Discs,
    /// `P5 x P3`, `P3 x P4`, and one over `det(P3, P4, P5)`.
    from5: Points,
    from4: Points,
    inverse: Discs,
}

impl Data<'_> {
    /// The signs of both heights are those for which their product is `w`, proved where the radii stay finite.
    #[inline(always)]
    fn corners(&self, x: Discs, y: Discs) -> Corners {
        let (base, platform, s) = (self.base, self.platform, self.s);
        let half = |z: Ball| z.scaled(0.5);
        let (along, up) = (base.len.reciprocal(), base.v.reciprocal());
        let p4x = half(s[0] + base.bb - s[1]) * along;
        let p4y = (-y).halved().plus(half(s[0] + base.cc) - base.u * p4x).times(up);
        let p5x = x.plus(base.bb - s[2]).halved().times(along);
        let p5y = (x.plus(base.cc - s[3]).halved() - p5x.times(base.u)).times(up);
        let squared_height = Discs::real(s[0] - p4x * p4x) - p4y * p4y;
        let z4 = squared_height.sqrt();
        let z5 = (x - p5x * p5x - p5y * p5y).sqrt();
        let product = x.plus(s[0] - platform.bb).halved() - p5x.times(p4x) - p4y * p5y;
        let z5 = z5.with_product(z4, product);
        let p4 = [Discs::real(p4x), p4y, z4];
        let p5 = [p5x, p5y, z5];
        // P6 from its products with P3, P4, P5 (origin P1): three linear equations
        let k3 = half(s[5] + base.cc - s[4]);
        let k4 = half(s[5] + s[0] - platform.cc);
        let k5 = x.plus(s[5] - platform.opposite).halved();
        let normal = cross(&p4, &p5);
        let (u, v) = (base.u, base.v);
        // P3 = (u, v, 0)
        let from5 = [-p5[2].times(v), p5[2].times(u), p5[0].times(v) - p5[1].times(u)];
        let from4 = [p4[2].times(v), -p4[2].times(u), p4[1].times(u) - p4[0].times(v)];
        let inverse = (normal[0].times(u) + normal[1].times(v)).reciprocal();
        let mut p6 = [Discs::ZERO; 3];
        for k in 0..3 {
            p6[k] = (normal[k].times(k3) + from5[k].times(k4) + from4[k] * k5) * inverse;
        }
        Corners { p4, p5, p6, squared_height, from5, from4, inverse }
    }

    /// The pose over the discs, by the mean value theorem: corners at the centres, and derivatives over the discs times their radii.
    ///
    /// With `'` for the derivative by the one variable, `P4' = (0, -1/(2 v), p4y / (2 v z4))`, `P5' = (1/(2 len), (1 - u/len) / (2 v), ..)` with
    /// `2 z5 z5' = 1 - 2 p5x p5x' - 2 p5y p5y'`, and from `P6.P3 = k3`, `P6.P4 = k4`, `P6.P5 = k5`, `|P6|^2` not being used,
    /// `P6_x = (P3 x P4) (1/2 - P5'.P6) / det`, `P6_y = -(P5 x P3) (P4'.P6) / det`.
    #[inline(always)]
    pub(super) fn place(&self, x: Discs, y: Discs) -> Placed {
        let (base, t) = (self.base, self.platform);
        let wide = self.corners(x, y);
        let mut tight = self.corners(Discs::point(x.c), Discs::point(y.c));
        let (along, up) = (base.len.reciprocal(), base.v.reciprocal());
        let half = Ball::exact(0.5);
        let by_y = Discs::real(-(half * up));
        let d4 = [by_y, -(wide.p4[1] * by_y) * wide.p4[2].reciprocal()];
        let (ax, ay) = (half * along, half * (Ball::exact(1.0) - base.u * along) * up);
        let rise = (-(wide.p5[0].times(ax) + wide.p5[1].times(ay))).plus(half);
        let d5 = [Discs::real(ax), Discs::real(ay), rise * wide.p5[2].reciprocal()];
        let along6 = (-dot(&d5, &wide.p6)).plus(half) * wide.inverse;
        let across6 = (d4[0] * wide.p6[1] + d4[1] * wide.p6[2]) * wide.inverse;
        let (rx, ry) = (x.r, y.r);
        for k in 0..2 {
            tight.p4[k + 1].widen(d4[k].magnitude() * ry);
        }
        for k in 0..3 {
            tight.p5[k].widen(d5[k].magnitude() * rx);
            let (sx, sy) = (wide.from4[k] * along6, wide.from5[k] * across6);
            tight.p6[k].widen(sx.magnitude() * rx + sy.magnitude() * ry);
        }
        let Corners { p4, p5, p6, .. } = tight;
        let (side, height) = (t.len.reciprocal(), t.v.reciprocal());
        let (mut ax, mut ay) = ([Discs::ZERO; 3], [Discs::ZERO; 3]);
        for k in 0..3 {
            ax[k] = (p5[k] - p4[k]).times(side);
            ay[k] = (p6[k] - p4[k] - ax[k].times(t.u)).times(height);
        }
        let az = cross(&ax, &ay);
        Placed { p4, frame: [ax, ay, az], squared_height: wide.squared_height }
    }
}

/// The larger of both radii and moduli over some discs.
#[inline(always)]
pub(super) fn extremes(points: &[Points]) -> (Reals, Reals) {
    let (mut radius, mut modulus) = (Reals::ZERO, Reals::ZERO);
    for d in points.iter().flatten() {
        radius = radius.largest(d.r);
        modulus = modulus.largest(d.magnitude());
    }
    (radius, modulus)
}
