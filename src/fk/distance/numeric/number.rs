//! Complex numbers one at a time or side by side, and vectors of them.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use num_complex::Complex64;

use num::batch::ComplexBatch;
pub(super) use num::vector::{RingNumber, cross, dot, minus};

/// One complex number, or those of a [`ComplexBatch`].
pub(super) trait LaneNumber: RingNumber {
    /// The same number everywhere.
    fn constant(z: Complex64) -> Self;
    /// Not a number where it is zero.
    fn reciprocal(self) -> Self;
    /// A square root.
    fn root(self) -> Self;
    /// `c z` for a real `c`.
    fn times(self, c: f64) -> Self;
}

impl LaneNumber for Complex64 {
    #[inline(always)]
    fn constant(z: Complex64) -> Self {
        z
    }

    #[inline(always)]
    fn reciprocal(self) -> Self {
        let n = 1.0 / self.norm_sqr();
        Self::new(self.re * n, -self.im * n)
    }

    #[inline(always)]
    fn root(self) -> Self {
        // without the care for overflow of the library, and several times as fast
        let modulus = self.norm_sqr().sqrt();
        let large = (0.5 * (modulus + self.re.abs())).sqrt();
        let small = 0.5 * self.im / large.max(f64::MIN_POSITIVE);
        if self.re >= 0.0 { Self::new(large, small) } else { Self::new(small.abs(), large.copysign(self.im)) }
    }

    #[inline(always)]
    fn times(self, c: f64) -> Self {
        self * c
    }
}

impl LaneNumber for ComplexBatch {
    #[inline(always)]
    fn constant(z: Complex64) -> Self {
        Self::all(z)
    }

    #[inline(always)]
    fn reciprocal(self) -> Self {
        Self::reciprocal(self)
    }

    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn times(self, c: f64) -> Self {
        Self::times(self, c)
    }
}

/// A point or vector.
pub(super) type Vector<T> = [T; 3];

/// `x + c y`.
#[inline(always)]
pub(super) fn along<T: LaneNumber>(x: &Vector<T>, c: T, y: &Vector<T>) -> Vector<T> {
    [x[0] + c * y[0], x[1] + c * y[1], x[2] + c * y[2]]
}

/// `|x - y|^2`, bilinear.
#[inline(always)]
pub(super) fn squared_distance<T: LaneNumber>(x: &Vector<T>, y: &Vector<T>) -> T {
    let d = minus(x, y);
    dot(&d, &d)
}

/// The two places of a point with squared distances `s` to three points, and `|u x v|^2 = A / 4` of their triangle.
pub(super) struct TrilateratedPlaces<T> {
    pub(super) gram: T,
    /// Foot on the plane of the triangle.
    foot: Vector<T>,
    normal: Vector<T>,
    /// Height over the plane in normals: its sign is the orientation.
    pub(super) height: T,
}

impl<T: LaneNumber> TrilateratedPlaces<T> {
    /// Trilateration in matrix form with the coordinates of the triangle at hand.
    #[inline(always)]
    pub(super) fn of(p: [&Vector<T>; 3], s: [T; 3]) -> Self {
        let (u, v) = (minus(p[1], p[0]), minus(p[2], p[0]));
        let normal = cross(&u, &v);
        let (uu, uv, vv) = (dot(&u, &u), dot(&u, &v), dot(&v, &v));
        let gram = dot(&normal, &normal);
        let inverse = gram.reciprocal();
        let (f, g) = ((s[0] + uu - s[1]).times(0.5), (s[0] + vv - s[2]).times(0.5));
        let beta = (vv * f - uv * g) * inverse;
        let gamma = (uu * g - uv * f) * inverse;
        // the squared length of the foot is beta f + gamma g
        let height = ((s[0] - (beta * f + gamma * g)) * inverse).root();
        let foot = along(&along(p[0], beta, &u), gamma, &v);
        Self { gram, foot, normal, height }
    }

    /// The two places: with and against the normal.
    #[inline(always)]
    pub(super) fn both(&self) -> [Vector<T>; 2] {
        [self.at_height(self.height), self.at_height(self.height.times(-1.0))]
    }

    /// The place with this height, one of the two with either sign of [`height`](Self::height).
    #[inline(always)]
    pub(super) fn at_height(&self, height: T) -> Vector<T> {
        along(&self.foot, height, &self.normal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num::Rng;

    #[test]
    fn both_places_have_the_distances_and_the_height_is_the_volume() {
        let rng = &mut Rng::new(5);
        let mut number = || Complex64::new(rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0));
        for _ in 0..50 {
            let p: [Vector<Complex64>; 3] = std::array::from_fn(|_| std::array::from_fn(|_| number()));
            let s = [number(), number(), number()];
            let places = TrilateratedPlaces::of([&p[0], &p[1], &p[2]], s);
            let limit = 1e-9 / places.gram.norm().powi(2).min(1.0);
            let normal = cross(&minus(&p[1], &p[0]), &minus(&p[2], &p[0]));
            for (q, sign) in places.both().into_iter().zip([1.0, -1.0]) {
                for k in 0..3 {
                    assert!((squared_distance(&q, &p[k]) - s[k]).norm() < limit);
                }
                // six times the volume of the tetrahedron, with its orientation
                let volume = dot(&normal, &minus(&q, &p[0]));
                assert!((volume - (places.height * places.gram).times(sign)).norm() < limit);
            }
        }
        for z in
            [Complex64::new(-4.0, 0.0), Complex64::new(-3.0, -4.0), Complex64::new(3.0, 4.0), Complex64::ZERO]
        {
            assert!((z.root() * z.root() - z).norm() < 1e-14);
        }
    }
}
