//! Whether corresponding points of two planes are images under a projectivity, exactly.

use super::dependency::{dimension, rank};
use crate::num::exact::{Rational, relations};

/// What takes one planar set of points to another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlanarMap {
    /// A similarity: all distances in one ratio.
    Similar,
    /// An affine map.
    Affine,
    /// A projectivity.
    Projective,
}

impl std::fmt::Display for PlanarMap {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Similar => "similar images",
            Self::Affine => "affine images",
            Self::Projective => "projective images",
        })
    }
}

/// The most special regular map with `b_i` the image of `a_i`; both sets span planes.
pub(super) fn planar_map(a: &[[Rational; 3]], b: &[[Rational; 3]]) -> Option<PlanarMap> {
    if similar(a, b) {
        return Some(PlanarMap::Similar);
    }
    let one = || Rational::from_integer(1.into());
    let affine = |x: &[[Rational; 3]], y: &[[Rational; 3]]| {
        let rows =
            x.iter().zip(y).map(|(x, y)| [one()].into_iter().chain(x.iter().chain(y).cloned()).collect());
        // the graph of an affine map of a plane is a plane
        rank(&rows.collect::<Vec<_>>()) == 3
    };
    if affine(a, b) {
        return Some(PlanarMap::Affine);
    }
    projective(&in_plane(a)?, &in_plane(b)?).then_some(PlanarMap::Projective)
}

fn squared_distance(x: &[Rational; 3], y: &[Rational; 3]) -> Rational {
    x.iter().zip(y).map(|(x, y)| (x - y) * (x - y)).sum()
}

fn similar(a: &[[Rational; 3]], b: &[[Rational; 3]]) -> bool {
    let pairs = || (0..a.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    let zero = Rational::from_integer(0.into());
    let from = |list: &[[Rational; 3]], (i, j): (usize, usize)| squared_distance(&list[i], &list[j]);
    let Some(unit) = pairs().find(|p| from(a, *p) != zero) else { return false };
    let (u, v) = (from(a, unit), from(b, unit));
    v != zero && pairs().all(|p| from(a, p) * &v == from(b, p) * &u)
}

/// Homogeneous coordinates in the plane: two coordinates in which the points still span a plane.
fn in_plane(points: &[[Rational; 3]]) -> Option<Vec<[Rational; 3]>> {
    let one = || Rational::from_integer(1.into());
    let zero = || Rational::from_integer(0.into());
    let [x, y] = [[0, 1], [1, 2], [2, 0]].into_iter().find(|[i, j]| {
        dimension(&points.iter().map(|p| [p[*i].clone(), p[*j].clone(), zero()]).collect::<Vec<_>>()) == 2
    })?;
    Some(points.iter().map(|p| [one(), p[x].clone(), p[y].clone()]).collect())
}

/// Whether a regular 3 x 3 matrix `T` with `T a_i` a multiple of `b_i` exists: `b_i x T a_i = 0` is linear in `T`.
fn projective(a: &[[Rational; 3]], b: &[[Rational; 3]]) -> bool {
    let zero = || Rational::from_integer(0.into());
    // one row an entry T_kl, one column an equation
    let equations = |k: usize, l: usize| -> Vec<Rational> {
        a.iter()
            .zip(b)
            .flat_map(|(a, b)| {
                let (mut e, next, last) = ([zero(), zero(), zero()], (k + 1) % 3, (k + 2) % 3);
                e[next] = -(&b[last] * &a[l]);
                e[last] = &b[next] * &a[l];
                e
            })
            .collect()
    };
    let rows: Vec<_> = (0..9).map(|i| equations(i / 3, i % 3)).collect();
    let solutions = relations(&rows);
    let [t] = solutions.as_slice() else { return false };
    let minor = |i: usize, j: usize, k: usize| &t[i] * (&t[3 + j] * &t[6 + k] - &t[3 + k] * &t[6 + j]);
    minor(0, 1, 2) + minor(1, 2, 0) + minor(2, 0, 1) != zero()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::exact::rational;

    fn points(list: &[[f64; 3]]) -> Vec<[Rational; 3]> {
        list.iter().map(|p| p.map(|x| rational(x).unwrap())).collect()
    }

    #[test]
    fn maps_are_told_apart() {
        let plane = [[0.0, 0.0], [3.0, 1.0], [5.0, 2.0], [4.0, 6.0], [1.0, 7.0], [-2.0, 3.0]];
        let image = |f: &dyn Fn(f64, f64) -> [f64; 3]| points(&plane.map(|[x, y]| f(x, y)));
        let a = image(&|x, y| [x, 1.0, y]);
        // turned by the angle of the triangle 3, 4, 5 and scaled
        assert_eq!(
            planar_map(&a, &image(&|x, y| [3.0 * x - 4.0 * y, 4.0 * x + 3.0 * y, 2.0])),
            Some(PlanarMap::Similar)
        );
        assert_eq!(planar_map(&a, &image(&|x, y| [x + y, 2.0 * y, x])), Some(PlanarMap::Affine));
        // z = 8 / (8 + x): powers of two keep the quotients exact
        let b = image(&|x, y| [x, y, 0.0]);
        let homogeneous: Vec<[Rational; 3]> = b
            .iter()
            .map(|p| {
                let w = rational(8.0).unwrap() + &p[0];
                [&p[0] / &w, &p[1] / &w, p[2].clone()]
            })
            .collect();
        assert_eq!(planar_map(&a, &homogeneous), Some(PlanarMap::Projective));
        let mut spoilt = homogeneous;
        spoilt[4][1] += rational(1e-30).unwrap();
        assert_eq!(planar_map(&a, &spoilt), None);
    }
}
