//! Exact proof that the cubic of two planes has no singular point, by arithmetic modulo a prime.
//!
//! Doubles are rational numbers with powers of two as denominators, so everything can be reduced modulo a prime. A rank
//! modulo a prime is never larger than the rank over the rationals: a full rank modulo a prime proves a full rank.

use super::form::{exponents, index};
use crate::manipulator::Leg;
use crate::num::modular::Field;

/// Integers modulo `2^61 - 1`.
const FIELD: Field = Field::MERSENNE;

/// The residue of a finite double.
fn residue(x: f64) -> u64 {
    FIELD.scaled(x, 0)
}

/// Reduced row echelon form; the pivot columns.
fn reduce(rows: &mut [Vec<u64>]) -> Vec<usize> {
    let width = rows.first().map_or(0, Vec::len);
    let mut pivots = Vec::new();
    for column in 0..width {
        let rank = pivots.len();
        let Some(found) = (rank..rows.len()).find(|i| rows[*i][column] != 0) else { continue };
        rows.swap(rank, found);
        let scale = FIELD.inverse(rows[rank][column]);
        rows[rank].iter_mut().for_each(|x| *x = FIELD.mul(*x, scale));
        let head = rows[rank].clone();
        for (i, row) in rows.iter_mut().enumerate().filter(|(i, r)| *i != rank && r[column] != 0) {
            debug_assert!(i != rank);
            let factor = FIELD.sub(0, row[column]);
            row.iter_mut().zip(&head).for_each(|(x, h)| *x = FIELD.add(*x, FIELD.mul(factor, *h)));
        }
        pivots.push(column);
    }
    pivots
}

/// Vectors orthogonal to all rows.
fn kernel(mut rows: Vec<Vec<u64>>, width: usize) -> Vec<Vec<u64>> {
    let pivots = reduce(&mut rows);
    let free = (0..width).filter(|c| !pivots.contains(c));
    free.map(|c| {
        let mut v = vec![0; width];
        v[c] = 1;
        for (row, p) in rows.iter().zip(&pivots) {
            v[*p] = FIELD.sub(0, row[c]);
        }
        v
    })
    .collect()
}

/// Three of the homogeneous coordinates that tell the points of the plane of these points apart.
fn plane_coordinates(points: &[[u64; 4]]) -> Option<Vec<[u64; 3]>> {
    [[0, 1, 2], [0, 1, 3], [0, 2, 3]].into_iter().find_map(|kept| {
        let projected: Vec<[u64; 3]> = points.iter().map(|p| kept.map(|k| p[k])).collect();
        let mut rows: Vec<Vec<u64>> = projected.iter().map(|p| p.to_vec()).collect();
        (reduce(&mut rows).len() == 3).then_some(projected)
    })
}

fn monomials(degree: usize) -> Vec<[usize; 3]> {
    exponents(degree).collect()
}

fn times(a: &[u64], m: usize, b: &[u64], n: usize) -> Vec<u64> {
    let mut out = vec![0; (m + n + 1) * (m + n + 2) / 2];
    for (e, x) in monomials(m).iter().zip(a) {
        for (f, y) in monomials(n).iter().zip(b) {
            let at = index([e[0] + f[0], e[1] + f[1], e[2] + f[2]]);
            out[at] = FIELD.add(out[at], FIELD.mul(*x, *y));
        }
    }
    out
}

/// Whether the cubic `det M(a)` of the base plane of six legs between two planes is proved to have no singular point over
/// the complex numbers; `false` proves nothing.
///
/// The three partial derivatives, quadrics, have no common zero exactly when their products with the six monomials of
/// degree 2 span all 15 forms of degree 4 (Macaulay 1902: a regular sequence of three quadrics contains all forms of
/// degree 4). The rank of that 18 x 15 matrix is taken modulo `2^61 - 1`.
pub(super) fn proved_smooth(legs: &[Leg]) -> bool {
    let point = |x: &nalgebra::Point3<f64>| [1, residue(x.x), residue(x.y), residue(x.z)];
    let base: Vec<[u64; 4]> = legs.iter().map(|l| point(&l.base)).collect();
    let platform: Vec<[u64; 4]> = legs.iter().map(|l| point(&l.platform)).collect();
    let Some((a, b)) = plane_coordinates(&base).zip(plane_coordinates(&platform)) else { return false };
    let product = |(a, b): (&[u64; 3], &[u64; 3])| -> Vec<u64> {
        a.iter().flat_map(|x| b.iter().map(move |y| FIELD.mul(*x, *y))).collect()
    };
    let equations = kernel(a.iter().zip(&b).map(product).collect(), 9);
    if equations.len() != 3 {
        return false;
    }
    let entry = |r: usize, q: usize| [0, 1, 2].map(|p| equations[r][p * 3 + q]);
    let mut cubic = vec![0; 10];
    for (order, odd) in [
        ([0, 1, 2], false),
        ([1, 2, 0], false),
        ([2, 0, 1], false),
        ([0, 2, 1], true),
        ([2, 1, 0], true),
        ([1, 0, 2], true),
    ] {
        let two = times(&entry(0, order[0]), 1, &entry(1, order[1]), 1);
        let three = times(&two, 2, &entry(2, order[2]), 1);
        for (c, t) in cubic.iter_mut().zip(three) {
            *c = FIELD.add(*c, if odd { FIELD.sub(0, t) } else { t });
        }
    }
    let mut rows = Vec::new();
    for variable in 0..3 {
        let mut derivative = vec![0; 6];
        for (mut e, c) in monomials(3).into_iter().zip(&cubic) {
            if e[variable] > 0 {
                let factor = e[variable] as u64;
                e[variable] -= 1;
                derivative[index(e)] = FIELD.mul(*c, factor);
            }
        }
        for k in 0..6 {
            let mut monomial = vec![0; 6];
            monomial[k] = 1;
            rows.push(times(&derivative, 2, &monomial, 2));
        }
    }
    reduce(&mut rows).len() == 15
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::Rng;
    use nalgebra::Point3;

    #[test]
    fn residues_respect_sums_and_products_that_are_exact() {
        for (x, y) in [(0.5, 3.0), (-1.25, 1e10), (1e-300, 2.0), (-0.1, -0.0)] {
            assert_eq!(residue(x + x), FIELD.add(residue(x), residue(x)));
            assert_eq!(residue(2.0 * y), FIELD.mul(2, residue(y)));
        }
        assert_eq!(FIELD.mul(residue(0.1), residue(1024.0)), residue(102.4));
        assert_eq!(FIELD.add(residue(-7.5), residue(7.5)), 0);
    }

    #[test]
    fn random_planar_designs_are_smooth_and_shared_joints_or_a_node_are_not() {
        let mut rng = Rng::new(21);
        for _ in 0..10 {
            let mut point = || Point3::new(rng.normal(), rng.normal(), 0.0);
            let mut legs: [Leg; 6] = std::array::from_fn(|_| Leg { base: point(), platform: point() });
            assert!(proved_smooth(&legs));
            legs[1].base = legs[0].base;
            assert!(!proved_smooth(&legs));
        }
    }
}
