//! Vectors of intervals.

use nalgebra::Vector3;

use crate::num::interval::Interval;

/// An enclosure of one double. Infinite data never get here: the problem was validated.
pub(super) fn point(x: f64) -> Interval {
    Interval::from(x)
}

pub(super) type Vector = [Interval; 3];

pub(super) fn vector(v: &Vector3<f64>) -> Vector {
    [0, 1, 2].map(|k| point(v[k]))
}

pub(super) fn plus(a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|k| a[k] + b[k])
}

pub(super) fn minus(a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|k| a[k] - b[k])
}

pub(super) fn times(a: &Vector, x: Interval) -> Vector {
    a.map(|c| c * x)
}

pub(super) fn dot(a: &Vector, b: &Vector) -> Interval {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The sum of the squares, each of them not below zero.
pub(super) fn norm_squared(a: &Vector) -> Interval {
    a[0].square() + a[1].square() + a[2].square()
}

pub(super) fn cross(a: &Vector, b: &Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
