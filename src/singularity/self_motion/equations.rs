//! Leg equations in dual quaternions, real or complex, with derivatives.

use nalgebra::{ComplexField, SMatrix, SVector, Vector3};

use crate::manipulator::{Manipulator, SquaredLegLengths};

/// `(e, g)`, `g = p e` with `p` in units of the size.
pub(super) type Point<T> = SVector<T, 8>;

/// Six leg equations and `e.g = 0`.
pub(super) const EQUATIONS: usize = 7;

/// One leg, lengths in units of the size.
#[derive(Debug, Clone, Copy)]
struct LegForm {
    /// `b - a`.
    difference: Vector3<f64>,
    /// `a + b`.
    sum: Vector3<f64>,
    squared_length: f64,
}

/// `F_i = (|g + e b - a e|^2 - s e.e) / 2`, `F_7 = e.g`.
#[derive(Debug, Clone)]
pub(super) struct LegEquations {
    legs: [LegForm; 6],
}

impl LegEquations {
    pub(super) fn new(m: &Manipulator, s: &SquaredLegLengths) -> Self {
        let unit = m.size();
        let (legs, squares) = (m.legs(), s.get());
        let form = |i: usize| {
            let (a, b) = (legs[i].base.coords / unit, legs[i].platform.coords / unit);
            LegForm { difference: b - a, sum: a + b, squared_length: squares[i] / (unit * unit) }
        };
        Self { legs: std::array::from_fn(form) }
    }

    /// `F(y)`.
    pub(super) fn values<T: ComplexField<RealField = f64> + Copy>(
        &self,
        y: &Point<T>,
    ) -> SVector<T, EQUATIONS> {
        let half = T::from_real(0.5);
        SVector::from_fn(|i, _| {
            if i == 6 {
                return (0..4).fold(T::zero(), |sum, k| sum + y[k] * y[k + 4]);
            }
            let v = self.legs[i].displacement(y);
            let s = T::from_real(self.legs[i].squared_length);
            (0..4).fold(T::zero(), |sum, k| sum + half * (v[k] * v[k] - s * y[k] * y[k]))
        })
    }

    /// `dF / dy`; it is linear in `y`, and `F(y) = F'(y) y / 2`.
    pub(super) fn jacobian<T: ComplexField<RealField = f64> + Copy>(
        &self,
        y: &Point<T>,
    ) -> SMatrix<T, EQUATIONS, 8> {
        let mut j = SMatrix::zeros();
        for (i, leg) in self.legs.iter().enumerate() {
            let v = leg.displacement(y);
            let turned = leg.skew(&v);
            let s = T::from_real(leg.squared_length);
            for k in 0..4 {
                j[(i, k)] = -turned[k] - s * y[k];
                j[(i, k + 4)] = v[k];
            }
        }
        for k in 0..4 {
            j[(6, k)] = y[k + 4];
            j[(6, k + 4)] = y[k];
        }
        j
    }
}

impl LegForm {
    /// `T x` with `T x = x b - a x`.
    fn skew<T: ComplexField<RealField = f64> + Copy>(&self, x: &[T; 4]) -> [T; 4] {
        let d = self.difference.map(T::from_real);
        let c = self.sum.map(T::from_real);
        let [w, u, v, z] = *x;
        [
            -(d.x * u + d.y * v + d.z * z),
            d.x * w - (c.y * z - c.z * v),
            d.y * w - (c.z * u - c.x * z),
            d.z * w - (c.x * v - c.y * u),
        ]
    }

    /// `g + T e`, whose norm squared is `s e.e`.
    fn displacement<T: ComplexField<RealField = f64> + Copy>(&self, y: &Point<T>) -> [T; 4] {
        let turned = self.skew(&[y[0], y[1], y[2], y[3]]);
        std::array::from_fn(|k| y[k + 4] + turned[k])
    }
}
