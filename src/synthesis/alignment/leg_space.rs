//! The span of leg vectors as a subspace of `R^4 (x) R^4`, and what translations of the two bodies do to it.

use nalgebra::{Matrix3, SMatrix, Vector3};

use super::super::components::spectrum::{Spectrum, unit, without};
use super::super::leg_vector::{Normalisation, leg_vector};
use super::TOLERANCE;
use crate::manipulator::{Leg, Manipulator};
use crate::num::linalg::{LinalgError, svd};

/// Where the entries `1, a, b` of an element stand.
const HEAD: [usize; 7] = [0, 4, 8, 12, 1, 2, 3];

/// Coordinates for two designs that are compared: the units of the first for both, each about the centroids of its own legs.
pub(super) fn coordinates(of: &Manipulator, units: &Normalisation) -> Normalisation {
    let own = Normalisation::of(of);
    Normalisation { base_unit: units.base_unit, platform_unit: units.platform_unit, ..own }
}

/// A subspace `L` of `R^4 (x) R^4` with an orthonormal basis of 4 x 4 arrays (entry `4 i + j`).
#[derive(Debug, Clone)]
pub(super) struct LegSpace {
    pub(super) basis: Vec<Vec<f64>>,
    /// The singular values on both sides of the decision on the dimension: smallest kept, largest dropped.
    pub(super) gap: (f64, f64),
}

impl LegSpace {
    /// The span of legs written in normalised coordinates.
    pub(super) fn of(legs: &[Leg]) -> Result<Self, LinalgError> {
        let rows: Vec<Vec<f64>> = legs.iter().map(|leg| unit(&leg_vector(leg))).collect();
        let s = Spectrum::of(&rows, 16)?;
        let rank = s.rank(TOLERANCE * s.values[0]);
        let gap = (s.values[rank - 1] / s.values[0], s.values.get(rank).map_or(0.0, |x| x / s.values[0]));
        Ok(Self { basis: s.image(rank).to_vec(), gap })
    }

    pub(super) fn dimension(&self) -> usize {
        self.basis.len()
    }

    /// The same legs after the shift of the base by `s` and of the platform by `t`.
    pub(super) fn shifted(&self, s: &Vector3<f64>, t: &Vector3<f64>) -> Result<Self, LinalgError> {
        let s = [1.0, s.x, s.y, s.z];
        let t = [1.0, t.x, t.y, t.z];
        let move_one = |v: &Vec<f64>| {
            let mut w = v.clone();
            for i in 1..4 {
                for j in 0..4 {
                    w[4 * i + j] += s[i] * v[j];
                }
            }
            for i in 0..4 {
                let first = w[4 * i];
                for j in 1..4 {
                    w[4 * i + j] += t[j] * first;
                }
            }
            w
        };
        let moved: Vec<Vec<f64>> = self.basis.iter().map(move_one).collect();
        let image = Spectrum::of(&moved, 16)?.image(self.dimension()).to_vec();
        Ok(Self { basis: image, gap: self.gap })
    }

    /// The orthogonal projector on `L`.
    pub(super) fn projector(&self) -> SMatrix<f64, 16, 16> {
        SMatrix::from_fn(|i, j| self.basis.iter().map(|v| v[i] * v[j]).sum())
    }

    /// `L` over the entries `1, a, b`.
    pub(super) fn head(&self) -> Result<Head, LinalgError> {
        let rows: Vec<Vec<f64>> = self.basis.iter().map(|v| HEAD.map(|i| v[i]).to_vec()).collect();
        let d = svd(&rows)?;
        let rank = d.s.iter().filter(|s| **s > TOLERANCE).count();
        let gap = (d.s[rank - 1], d.s.get(rank).copied().unwrap_or(0.0));
        let tail = |k: usize, factor: f64| -> Vec<f64> {
            let entry =
                |i: usize| self.basis.iter().enumerate().map(|(l, v)| d.u[l][k] * v[i]).sum::<f64>() * factor;
            (0..9).map(|i| entry(4 * (i / 3 + 1) + i % 3 + 1)).collect()
        };
        let moments: Vec<Vec<f64>> = (rank..self.dimension()).map(|k| tail(k, 1.0)).collect();
        let image: Vec<Vec<f64>> = (0..rank).map(|k| (0..7).map(|i| d.v[i][k]).collect()).collect();
        let tails = (0..rank).map(|k| without(&tail(k, 1.0 / d.s[k]), &moments)).collect();
        Ok(Head { image, tails, moments, gap })
    }
}

/// `L` as a linear map from its entries `(x_0, a, b)` to its 3 x 3 block `C`, up to the elements that have nothing but `C`.
#[derive(Debug, Clone)]
pub(super) struct Head {
    /// Orthonormal basis of the possible `(x_0, a, b)`.
    image: Vec<Vec<f64>>,
    /// `C` of each, orthogonal to `moments`.
    tails: Vec<Vec<f64>>,
    /// Orthonormal basis of the elements `(0, 0, 0, C)`.
    pub(super) moments: Vec<Vec<f64>>,
    /// Singular values on both sides of the decision on the dimension.
    pub(super) gap: (f64, f64),
}

impl Head {
    pub(super) fn dimension(&self) -> usize {
        self.image.len()
    }

    /// `C` of the element with this head, orthogonal to the moments.
    pub(super) fn tail(&self, head: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; 9];
        for (e, c) in self.image.iter().zip(&self.tails) {
            let along: f64 = e.iter().zip(head).map(|(x, y)| x * y).sum();
            out.iter_mut().zip(c).for_each(|(o, x)| *o += along * x);
        }
        out
    }

    /// `x y^T` without its part along the moments.
    pub(super) fn product(&self, x: &Vector3<f64>, y: &Vector3<f64>) -> Vec<f64> {
        let m: Matrix3<f64> = x * y.transpose();
        let flat: Vec<f64> = (0..9).map(|i| m[(i / 3, i % 3)]).collect();
        without(&flat, &self.moments)
    }

    /// The head `(1, a, b)` orthogonal to all heads `(0, a, b)`, and an orthonormal basis of the latter.
    pub(super) fn split(&self) -> Result<(Vec<f64>, Vec<Vec<f64>>), LinalgError> {
        let mut first = vec![0.0; 7];
        for e in &self.image {
            first.iter_mut().zip(e).for_each(|(f, x)| *f += e[0] * x);
        }
        let along = [unit(&first)];
        let rest: Vec<Vec<f64>> = self.image.iter().map(|e| without(e, &along)).collect();
        let mut level = Spectrum::of(&rest, 7)?.image(self.dimension() - 1).to_vec();
        for d in &mut level {
            d[0] = 0.0;
        }
        let scale = first[0];
        Ok((first.iter().map(|x| x / scale).collect(), level))
    }
}

/// The parts `a` and `b` of a head, or `s` and `t` of a pair of shifts.
pub(super) fn pair(v: &[f64]) -> (Vector3<f64>, Vector3<f64>) {
    (Vector3::new(v[0], v[1], v[2]), Vector3::new(v[3], v[4], v[5]))
}
