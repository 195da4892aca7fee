//! The point of a polyhedron nearest to a given one.

use nalgebra::Vector6;

/// Sweeps over the half spaces at most.
const SWEEPS: usize = 2000;

/// `row . x >= bound`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HalfSpace {
    pub(super) row: Vector6<f64>,
    pub(super) bound: f64,
}

/// Projects `point` on the intersection of half spaces by Hildreth's method (1957). It is coordinate ascent on the dual
/// problem, with the point `x = point + sum m_k row_k` and `m_k >= 0`. It ends when no multiplier moves `x` by more
/// than `tolerance`, or after 2000 sweeps; the result may then be inaccurate.
pub(super) fn project(point: &Vector6<f64>, spaces: &[HalfSpace], tolerance: f64) -> Vector6<f64> {
    let scaled: Vec<HalfSpace> = spaces
        .iter()
        .filter_map(|s| {
            let norm = s.row.norm();
            (norm > 0.0).then(|| HalfSpace { row: s.row / norm, bound: s.bound / norm })
        })
        .collect();
    let mut multipliers = vec![0.0_f64; scaled.len()];
    let mut x = *point;
    for _ in 0..SWEEPS {
        let mut moved = 0.0_f64;
        for (space, m) in scaled.iter().zip(&mut multipliers) {
            let multiplier = (*m + space.bound - space.row.dot(&x)).max(0.0);
            x += space.row * (multiplier - *m);
            moved = moved.max((multiplier - *m).abs());
            *m = multiplier;
        }
        if !(moved > tolerance) {
            break;
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    use num::Rng;

    #[test]
    fn corners_faces_and_inner_points_are_found() {
        let at = |k: usize, sign: f64, bound: f64| HalfSpace { row: Vector6::ith(k, sign), bound };
        let corner = [at(0, 1.0, 1.0), at(1, 1.0, 2.0)];
        let found = project(&Vector6::zeros(), &corner, 1e-15);
        assert!((found - Vector6::new(1.0, 2.0, 0.0, 0.0, 0.0, 0.0)).norm() < 1e-14);
        let inside = Vector6::new(3.0, 3.0, -1.0, 0.0, 0.0, 0.0);
        assert_eq!(project(&inside, &corner, 1e-15), inside);
        let slanted = HalfSpace { row: Vector6::new(2.0, 2.0, 0.0, 0.0, 0.0, 0.0), bound: 4.0 };
        let found = project(&Vector6::zeros(), &[slanted], 1e-15);
        assert!((found - Vector6::new(1.0, 1.0, 0.0, 0.0, 0.0, 0.0)).norm() < 1e-14);
    }

    #[test]
    fn no_point_of_the_polyhedron_is_nearer() {
        let mut rng = Rng::new(3);
        for _ in 0..20 {
            let mut vector = || Vector6::from_fn(|_, _| rng.normal());
            let (point, inner) = (vector() * 3.0, vector());
            let rows: Vec<Vector6<f64>> = (0..8).map(|_| vector()).collect();
            let spaces: Vec<HalfSpace> =
                rows.iter().map(|row| HalfSpace { row: *row, bound: row.dot(&inner) - 0.3 }).collect();
            let found = project(&point, &spaces, 1e-14);
            assert!(spaces.iter().all(|s| s.row.dot(&found) >= s.bound - 1e-9));
            // the angle at a projection is right or obtuse towards every point of a convex body
            for _ in 0..200 {
                let other = inner + Vector6::from_fn(|_, _| rng.normal());
                if spaces.iter().all(|s| s.row.dot(&other) >= s.bound) {
                    assert!((point - found).dot(&(other - found)) < 1e-6);
                }
            }
        }
    }
}
