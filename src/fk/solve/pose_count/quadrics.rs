//! The quadrics of the group `SE(3)` in sixteen coordinates, cut by linear equations.
//!
//! Coordinates of a pose `(R, p)`: `M = R` (nine, by rows), `y = p`, `x = -R^T p`, `r = |p|^2` (Gallet, Nawratil,
//! Schicho 2014). The equations `M M^T = 1` and `cof M = M` define `SO(3)`, `x = -M^T y` and `r = y.y` give the rest;
//! the others hold on the group as well and save degrees.

use super::quotient::{Monomial, Polynomial, UNIT, variable};
use num::modular::Field;

/// Homogeneous coordinates of a pose: the sixteen, and `h`.
pub(super) const COORDINATES: usize = 17;

/// A linear equation: coefficients of the coordinates, then the constant.
pub(super) type Linear = [u64; COORDINATES + 1];

/// Entries of `M`.
pub(super) const M: std::ops::Range<usize> = 0..9;
/// The coordinate that is one for poses and zero at infinity.
pub(super) const H: usize = 16;

const Y: usize = 9;
const X: usize = 12;
const R: usize = 15;

fn m(i: usize, j: usize) -> usize {
    3 * i + j
}

/// Terms of a quadric: coefficient and two coordinates.
type QuadricTerms = Vec<(i64, Vec<usize>)>;

/// The sign of the permutation `(i, j, k)`, 0 when two are equal.
fn sign(i: usize, j: usize, k: usize) -> i64 {
    match ((j + 3 - i) % 3, (k + 3 - j) % 3) {
        (1, 1) => 1,
        (2, 2) => -1,
        _ => 0,
    }
}

/// `M M^T = h^2`, `M^T M = h^2`, `cof M = h M`, `M^T y = -h x`, `M x = -h y`, `y.y = h r`, `x.x = h r`,
/// `[y]_x M = -M [x]_x`: integer coefficients, at most 2 in absolute value.
pub(super) fn quadrics() -> Vec<QuadricTerms> {
    let mut out: Vec<QuadricTerms> = Vec::new();
    for i in 0..3 {
        for j in i..3 {
            let one = |mut t: QuadricTerms| {
                if i == j {
                    t.push((-1, vec![H, H]));
                }
                t
            };
            out.push(one((0..3).map(|k| (1, vec![m(i, k), m(j, k)])).collect()));
            out.push(one((0..3).map(|k| (1, vec![m(k, i), m(k, j)])).collect()));
        }
        for j in 0..3 {
            let ((i1, i2), (j1, j2)) = (((i + 1) % 3, (i + 2) % 3), ((j + 1) % 3, (j + 2) % 3));
            let cofactor = [(1, vec![m(i1, j1), m(i2, j2)]), (-1, vec![m(i1, j2), m(i2, j1)])];
            out.push(cofactor.into_iter().chain([(-1, vec![H, m(i, j)])]).collect());
            // (y x M)_ij + (M [x])_ij
            let mut turned = Vec::new();
            for k in 0..3 {
                for l in 0..3 {
                    turned.push((sign(i, l, k), vec![Y + l, m(k, j)]));
                    turned.push((sign(k, l, j), vec![m(i, k), X + l]));
                }
            }
            turned.retain(|t| t.0 != 0);
            out.push(turned);
        }
        out.push((0..3).map(|k| (1, vec![m(k, i), Y + k])).chain([(1, vec![H, X + i])]).collect());
        out.push((0..3).map(|k| (1, vec![m(i, k), X + k])).chain([(1, vec![H, Y + i])]).collect());
    }
    for first in [Y, X] {
        out.push((0..3).map(|k| (1, vec![first + k, first + k])).chain([(-1, vec![H, R])]).collect());
    }
    out
}

/// The part of the sixteen coordinates that linear equations leave.
pub(super) enum Cut {
    /// The equations contradict each other.
    Empty,
    /// The quadrics in the coordinates that are left.
    Quadrics {
        /// Coordinates left.
        unknowns: usize,
        /// Quadrics in them.
        polynomials: Vec<Polynomial>,
    },
}

/// Solves the linear equations and puts the solution into the quadrics. One of the equations is not homogeneous: its
/// linear form equals one, `h` for finite poses.
pub(super) fn cut(field: Field, equations: &[Linear]) -> Cut {
    let (mut rows, mut pivots): (Vec<Linear>, Vec<usize>) = (equations.to_vec(), Vec::new());
    // h is known or depends on the others; then r, which has the coefficient one in every leg
    for column in (0..COORDINATES).rev() {
        let rank = pivots.len();
        let Some(at) = (rank..rows.len()).find(|i| rows[*i][column] != 0) else { continue };
        rows.swap(rank, at);
        let inverse = field.inverse(rows[rank][column]);
        rows[rank] = rows[rank].map(|x| field.mul(x, inverse));
        let head = rows[rank];
        for (_, row) in rows.iter_mut().enumerate().filter(|(i, row)| *i != rank && row[column] != 0) {
            let factor = row[column];
            *row = std::array::from_fn(|k| field.sub(row[k], field.mul(factor, head[k])));
        }
        pivots.push(column);
    }
    if rows[pivots.len()..].iter().any(|row| row[COORDINATES] != 0) {
        return Cut::Empty;
    }
    let left: Vec<usize> = (0..COORDINATES).filter(|c| !pivots.contains(c)).collect();
    // every coordinate as an affine form in those left
    let form = |c: usize| -> Polynomial {
        let Some(row) = pivots.iter().position(|p| *p == c).map(|i| &rows[i]) else {
            let place = left.iter().position(|l| *l == c).unwrap_or(0);
            return vec![(variable(place), 1)];
        };
        let entries = left.iter().enumerate().map(|(place, l)| (variable(place), row[*l]));
        let terms = entries.chain([(UNIT, row[COORDINATES])]).filter(|t| t.1 != 0);
        terms.map(|(monomial, x)| (monomial, field.sub(0, x))).collect()
    };
    let forms: Vec<Polynomial> = (0..COORDINATES).map(form).collect();
    let polynomials = quadrics().iter().map(|terms| substituted(field, terms, &forms)).collect();
    Cut::Quadrics { unknowns: left.len(), polynomials }
}

fn substituted(field: Field, terms: &QuadricTerms, forms: &[Polynomial]) -> Polynomial {
    let mut sum: Vec<(Monomial, u64)> = Vec::new();
    for (coefficient, factors) in terms {
        let mut product = vec![(UNIT, field.integer(*coefficient))];
        for f in factors {
            let pairs = product.iter().flat_map(|(m, x)| forms[*f].iter().map(move |(n, y)| (m + n, *x, *y)));
            product = pairs.map(|(monomial, x, y)| (monomial, field.mul(x, y))).collect();
        }
        sum.extend(product);
    }
    sum.sort_unstable_by_key(|t| t.0);
    let mut out: Polynomial = Vec::new();
    for (monomial, x) in sum {
        match out.last_mut() {
            Some(last) if last.0 == monomial => last.1 = field.add(last.1, x),
            _ => out.push((monomial, x)),
        }
    }
    out.retain(|t| t.1 != 0);
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use num::Rng;
    use platform::geom::random_rotation;

    #[test]
    fn quadrics_vanish_on_poses_and_not_on_mirror_images() {
        let mut rng = Rng::new(2);
        for _ in 0..20 {
            let r = random_rotation(&mut rng);
            let p = nalgebra::Vector3::from_fn(|_, _| rng.uniform(-2.0, 2.0));
            let x = -(r.inverse() * p);
            let coordinates = |s: f64| -> Vec<f64> {
                let turned = (0..9).map(|k| s * r.matrix()[(k / 3, k % 3)]);
                turned
                    .chain(p.iter().copied())
                    .chain(x.iter().copied())
                    .chain([p.norm_squared(), 1.0])
                    .collect()
            };
            let value = |c: &[f64]| {
                let term = |t: &(i64, Vec<usize>)| t.0 as f64 * t.1.iter().map(|k| c[*k]).product::<f64>();
                quadrics().iter().map(|q| q.iter().map(term).sum::<f64>().abs()).fold(0.0, f64::max)
            };
            assert!(value(&coordinates(1.0)) < 1e-13);
            assert!(value(&coordinates(-1.0)) > 0.1);
        }
    }
}
