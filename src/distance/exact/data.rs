//! The data of one problem as integers.

use num_bigint::BigInt;

use super::ClosureError;
use crate::manipulator::{Manipulator, SquaredLegLengths};
use crate::num::Rng;
use crate::poly::Dyadic;
use crate::topology::Joint;

/// The most binary places before and after the point.
pub(super) const RANGE: i64 = 600;

/// Coordinates times `2^scale` and squared lengths times `4^scale`, all integers.
pub(super) struct ExactData {
    base: Vec<[BigInt; 3]>,
    platform: Vec<[BigInt; 3]>,
    legs: [(usize, usize); 6],
    squares: [BigInt; 6],
    pub(super) scale: i64,
}

impl ExactData {
    /// Doubles as they are: the numbers solved for are those the certificates are about.
    pub(super) fn new(m: &Manipulator, s: &SquaredLegLengths) -> Result<Self, ClosureError> {
        let number = |x: f64| Dyadic::from_f64(x).ok_or(ClosureError::OutOfRange);
        let points = |list: &[nalgebra::Point3<f64>]| -> Result<Vec<[Dyadic; 3]>, ClosureError> {
            list.iter().map(|p| Ok([number(p.x)?, number(p.y)?, number(p.z)?])).collect()
        };
        let (base, platform) = (points(m.base_joints())?, points(m.platform_joints())?);
        let squares: Vec<Dyadic> = s.get().into_iter().map(number).collect::<Result<_, _>>()?;
        let depth = |x: &Dyadic| -x.exponent();
        let places = base.iter().chain(&platform).flatten().map(depth);
        let scale = places.chain(squares.iter().map(|s| (depth(s) + 1).div_euclid(2))).fold(0, i64::max);
        let sizes = base.iter().chain(&platform).flatten().chain(&squares).filter_map(Dyadic::log2_floor);
        if scale > RANGE || sizes.fold(0, i64::max) > RANGE {
            return Err(ClosureError::OutOfRange);
        }
        let integer = |x: &Dyadic, k: i64| {
            let x = x.shifted(k);
            x.mantissa() << x.exponent().unsigned_abs()
        };
        let scaled = |list: Vec<[Dyadic; 3]>| -> Vec<[BigInt; 3]> {
            list.iter().map(|p| [0, 1, 2].map(|i| integer(&p[i], scale))).collect()
        };
        Ok(Self {
            base: scaled(base),
            platform: scaled(platform),
            legs: m.pairs(),
            squares: std::array::from_fn(|i| integer(&squares[i], 2 * scale)),
            scale,
        })
    }

    /// A random member of the topology of these legs, all numbers between `-2^20` and `2^20`, squared lengths positive.
    pub(super) fn random(legs: &[(usize, usize); 6], rng: &mut Rng) -> Self {
        let count = |joints: [usize; 6]| 1 + joints.into_iter().max().unwrap_or(0);
        let mut point = |_| [0, 1, 2].map(|_| BigInt::from(rng.uniform(-1e6, 1e6) as i64));
        let base = (0..count(legs.map(|l| l.0))).map(&mut point).collect();
        let platform = (0..count(legs.map(|l| l.1))).map(&mut point).collect();
        let squares = std::array::from_fn(|_| BigInt::from(rng.uniform(1.0, 1e12) as i64));
        Self { base, platform, legs: *legs, squares, scale: 0 }
    }

    /// Whether the joints of each body lie in a plane, exactly.
    pub(super) fn is_planar(&self) -> bool {
        let flat = |points: &[[BigInt; 3]]| {
            let d: Vec<[BigInt; 3]> = points.iter().map(|p| minus(p, &points[0])).collect();
            let normals = d.iter().flat_map(|x| d.iter().map(move |y| cross(x, y)));
            let normal = normals.into_iter().find(|n| dot(n, n) != 0.into());
            normal.is_none_or(|n| d.iter().all(|x| dot(x, &n) == 0.into()))
        };
        flat(&self.base) && flat(&self.platform)
    }

    /// Coordinates in the frame of the joint's body.
    pub(super) fn point(&self, joint: Joint) -> &[BigInt; 3] {
        match joint {
            Joint::Base(k) => &self.base[k],
            Joint::Platform(k) => &self.platform[k],
        }
    }

    /// The squared distance of two joints of one body.
    pub(super) fn within(&self, x: Joint, y: Joint) -> BigInt {
        let d = minus(self.point(x), self.point(y));
        dot(&d, &d)
    }

    /// The squared length of the leg between two joints.
    pub(super) fn leg(&self, x: Joint, y: Joint) -> Option<&BigInt> {
        let pair = x.across(y)?;
        self.legs.iter().position(|l| *l == pair).map(|i| &self.squares[i])
    }
}

pub(super) fn minus(a: &[BigInt; 3], b: &[BigInt; 3]) -> [BigInt; 3] {
    std::array::from_fn(|i| &a[i] - &b[i])
}

pub(super) fn dot(a: &[BigInt; 3], b: &[BigInt; 3]) -> BigInt {
    (0..3).map(|i| &a[i] * &b[i]).sum()
}

pub(super) fn cross(a: &[BigInt; 3], b: &[BigInt; 3]) -> [BigInt; 3] {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        &a[j] * &b[k] - &a[k] * &b[j]
    })
}
