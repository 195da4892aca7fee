//! One leg with joint offsets, by the same formulas in doubles, intervals and jets.

use num::interval::Interval;
use num::jet::Jet;
use num::smooth::SmoothNumber;
pub use num::vector::{cross, dot, minus};

/// Number types for the formulas.
pub trait LegNumber: SmoothNumber {
    /// `None` where the divisor may be zero.
    fn over(self, divisor: Self) -> Option<Self>;
    /// `None` where it may be negative.
    fn root(self) -> Option<Self>;
}

impl LegNumber for f64 {
    fn over(self, divisor: Self) -> Option<Self> {
        (divisor != 0.0).then(|| self / divisor)
    }

    fn root(self) -> Option<Self> {
        (self >= 0.0).then(|| self.sqrt())
    }
}

impl LegNumber for Interval {
    fn over(self, divisor: Self) -> Option<Self> {
        self.checked_div(divisor)
    }

    fn root(self) -> Option<Self> {
        self.sqrt()
    }
}

impl LegNumber for Jet {
    fn over(self, divisor: Self) -> Option<Self> {
        Some(self * divisor.inverse()?)
    }

    fn root(self) -> Option<Self> {
        Jet::root(&self)
    }
}

/// A vector of numbers, gradients or intervals.
pub type Vec3<T> = [T; 3];

/// `x a`.
pub fn scaled<T: LegNumber>(a: &Vec3<T>, x: T) -> Vec3<T> {
    a.map(|y| y * x)
}

/// `a / |a|`; `None` where the norm may vanish.
pub fn unit<T: LegNumber>(a: &Vec3<T>) -> Option<Vec3<T>> {
    let length = dot(a, a).root()?;
    Some([a[0].over(length)?, a[1].over(length)?, a[2].over(length)?])
}

/// The direction of the part of `v` across an axis.
pub(super) fn across<T: LegNumber>(axis: &Vec3<T>, v: &Vec3<T>) -> Option<Vec3<T>> {
    unit(&cross(axis, &cross(v, axis)))
}

/// A leg at a pose, base frame.
#[derive(Debug, Clone, Copy)]
pub struct PlacedLeg<T> {
    /// From base joint to platform joint.
    pub line: Vec3<T>,
    /// From the platform origin to the platform joint.
    pub arm: Vec3<T>,
    /// First axes at the base and at the platform, unit vectors; arbitrary for ball joints.
    pub axes: [Vec3<T>; 2],
    /// From the first axis of a joint to its second one.
    pub offsets: [T; 2],
}

impl<T: LegNumber> PlacedLeg<T> {
    /// The direction from the first axis to the second one at an end, from base to platform: a unit vector across the
    /// first axis. `other` is the direction at the other end.
    pub fn direction(&self, end: usize, other: &Vec3<T>) -> Option<Vec3<T>> {
        let reach = scaled(other, self.offsets[1 - end]);
        across(&self.axes[end], &minus(&self.line, &reach))
    }

    /// From the second axis at the base to that at the platform.
    pub fn between(&self, ends: &[Vec3<T>; 2]) -> Vec3<T> {
        let moved = scaled(&ends[0], self.offsets[0]);
        minus(&minus(&self.line, &moved), &scaled(&ends[1], self.offsets[1]))
    }

    /// Sine and cosine of the angle about the leg from the second axis at the base to that at the platform.
    pub fn twist(&self, ends: &[Vec3<T>; 2]) -> Option<[T; 2]> {
        let u = unit(&self.between(ends))?;
        let second = self.second_axes(ends);
        Some([dot(&u, &cross(&second[0], &second[1])), dot(&second[0], &second[1])])
    }

    fn second_axes(&self, ends: &[Vec3<T>; 2]) -> [Vec3<T>; 2] {
        [0, 1].map(|k| cross(&self.axes[k], &ends[k]))
    }

    /// The rates of the distance of the second axes and of the twist, for velocities of the platform origin and angular
    /// velocities. Without first axes the twist has no rate.
    ///
    /// With the line `s` between the second axes, `u = s / |s|`, the second axes `e = a x w` and `e' = b x w'`, and the
    /// arm `m` to the second axis of the platform: `|s|' = u . (v + omega x m)`. This holds since `u` is perpendicular
    /// to both second axes. The rotations `q` and `q'` about the first axes follow from `u . e = u . e' = 0`:
    ///
    /// ```text
    /// q' (s.w + d) + d' (e.e') q'' = (v + omega x m) . e
    /// d (e.e') q' + (s.w' + d') q'' = (v + omega x m - omega x s) . e'
    /// psi' = u . omega + (u . b) q'' - (u . a) q'
    /// ```
    pub fn rates(&self, ends: &[Vec3<T>; 2], with_twist: bool) -> Option<[[T; 6]; 2]> {
        let s = self.between(ends);
        let u = unit(&s)?;
        let m = minus(&self.arm, &scaled(&ends[1], self.offsets[1]));
        let row = |force: &Vec3<T>, moment: &Vec3<T>| -> [T; 6] {
            std::array::from_fn(|k| if k < 3 { force[k] } else { moment[k - 3] })
        };
        let length = row(&u, &cross(&m, &u));
        let zero = u[0].alike(0.0);
        if !with_twist {
            return Some([length, [zero; 6]]);
        }
        let e = self.second_axes(ends);
        let [d0, d1] = self.offsets;
        let (own, other) = (dot(&s, &ends[0]) + d0, dot(&s, &ends[1]) + d1);
        let mixed = dot(&e[0], &e[1]);
        let determinant = own * other - d0 * d1 * mixed * mixed;
        let first = row(&e[0], &cross(&m, &e[0]));
        let second = row(&e[1], &cross(&minus(&m, &s), &e[1]));
        let (ua, ub) = (dot(&u, &self.axes[0]), dot(&u, &self.axes[1]));
        let mut twist = [zero; 6];
        for k in 0..6 {
            let q = (first[k] * other - second[k] * d1 * mixed).over(determinant)?;
            let q2 = (second[k] * own - first[k] * d0 * mixed).over(determinant)?;
            let direct = if k < 3 { zero } else { u[k - 3] };
            twist[k] = direct + ub * q2 - ua * q;
        }
        Some([length, twist])
    }
}
