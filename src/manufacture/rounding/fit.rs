//! Where to lay a grid so that given holes come nearest to given places.

use nalgebra::{Rotation2, Vector2};

use super::grid::Cell;

/// Points within this much of the radius beyond it count as inside a circle.
const SLIP: f64 = 1e-12;
/// Golden sections of the range of turns: what is left of it is its `1e-9`th part.
const SECTIONS: usize = 44;

/// Centre and radius of the smallest circle that holds the points (incremental, Welzl 1991); radius 0 for no points.
pub(super) fn smallest_circle(points: &[Vector2<f64>]) -> (Vector2<f64>, f64) {
    let mut circle = (points.first().copied().unwrap_or_default(), 0.0);
    let outside = |circle: &(Vector2<f64>, f64), p: &Vector2<f64>| {
        (p - circle.0).norm() > circle.1 * (1.0 + SLIP) + f64::MIN_POSITIVE
    };
    for i in 1..points.len() {
        if !outside(&circle, &points[i]) {
            continue;
        }
        circle = (points[i], 0.0);
        for j in 0..i {
            if !outside(&circle, &points[j]) {
                continue;
            }
            circle = of_two(&points[i], &points[j]);
            for k in 0..j {
                if outside(&circle, &points[k]) {
                    circle = of_three(&points[i], &points[j], &points[k]);
                }
            }
        }
    }
    let radius = points.iter().map(|p| (p - circle.0).norm()).fold(0.0, f64::max);
    (circle.0, radius)
}

fn of_two(p: &Vector2<f64>, q: &Vector2<f64>) -> (Vector2<f64>, f64) {
    ((p + q) / 2.0, (p - q).norm() / 2.0)
}

/// The circle through three points; where they are on a line, that of the two farthest apart.
fn of_three(p: &Vector2<f64>, q: &Vector2<f64>, r: &Vector2<f64>) -> (Vector2<f64>, f64) {
    let (a, b) = (q - p, r - p);
    let doubled = 2.0 * a.perp(&b);
    let offset = Vector2::new(
        b.y * a.norm_squared() - a.y * b.norm_squared(),
        a.x * b.norm_squared() - b.x * a.norm_squared(),
    );
    let centre = offset / doubled;
    if centre.iter().all(|x| x.is_finite()) {
        return (p + centre, centre.norm());
    }
    let pairs = [of_two(p, q), of_two(p, r), of_two(q, r)];
    pairs.into_iter().fold((*p, 0.0), |best, c| if c.1 > best.1 { c } else { best })
}

/// A grid in a plane: its turn (radians), a hole (in pitches, axes that are not turned), and the greatest distance of what was fitted (pitches).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Laid {
    pub(super) angle: f64,
    pub(super) origin: Vector2<f64>,
    pub(super) worst: f64,
}

/// Lays the grid so that the greatest distance of the cells from their places is least: the best shift for every turn is the centre of a smallest
/// circle, the turn is sought within `half` of `angle`, where that distance is nearly convex.
pub(super) fn fit(places: &[Vector2<f64>], cells: &[Cell], angle: f64, half: f64) -> Laid {
    let at = |angle: f64| {
        let turn = Rotation2::new(angle);
        let off = |(p, c): (&Vector2<f64>, &Cell)| p - turn * Vector2::new(c[0] as f64, c[1] as f64);
        let offsets: Vec<Vector2<f64>> = places.iter().zip(cells).map(off).collect();
        let (origin, worst) = smallest_circle(&offsets);
        Laid { angle, origin, worst }
    };
    let ratio = (5f64.sqrt() - 1.0) / 2.0;
    let (mut low, mut high) = (angle - half, angle + half);
    let (mut left, mut right) = (at(high - ratio * (high - low)), at(low + ratio * (high - low)));
    for _ in 0..SECTIONS {
        if left.worst <= right.worst {
            (high, right) = (right.angle, left);
            left = at(high - ratio * (high - low));
        } else {
            (low, left) = (left.angle, right);
            right = at(low + ratio * (high - low));
        }
    }
    let start = at(angle);
    [start, left, right].into_iter().fold(start, |best, l| if l.worst < best.worst { l } else { best })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::Rng;

    #[test]
    fn the_smallest_circle_holds_all_points_and_none_smaller_does() {
        let mut rng = Rng::new(3);
        for n in 1..=6 {
            for round in 0..200 {
                let mut points: Vec<Vector2<f64>> =
                    (0..n).map(|_| Vector2::new(rng.normal(), rng.normal())).collect();
                if round % 3 == 0 {
                    // on a line, some of them at one place
                    for p in &mut points {
                        *p = Vector2::new(p.x.round(), 2.0 * p.x.round());
                    }
                }
                let (centre, radius) = smallest_circle(&points);
                let worst = |c: Vector2<f64>| points.iter().map(|p| (p - c).norm()).fold(0.0, f64::max);
                assert!((worst(centre) - radius).abs() < 1e-12);
                for k in 0..8 {
                    let step = Rotation2::new(f64::from(k)) * Vector2::new(1e-4, 0.0);
                    assert!(worst(centre + step) >= radius - 1e-12, "{points:?}");
                }
            }
        }
    }

    #[test]
    fn a_turned_and_shifted_grid_is_found_again() {
        let cells = [[0, 0], [31, 4], [12, 27], [5, 9], [-8, 3]];
        let (turn, shift) = (Rotation2::new(0.3), Vector2::new(0.31, -0.2));
        let places = cells.map(|c| turn * Vector2::new(c[0] as f64, c[1] as f64) + shift);
        let laid = fit(&places, &cells, 0.31, 0.02);
        assert!(laid.worst < 1e-7 && (laid.angle - 0.3).abs() < 1e-8, "{laid:?}");
        assert!((laid.origin - shift).norm() < 1e-7);
    }
}
