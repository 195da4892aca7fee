//! Origin and angle of a grid, chosen so that holes come near the joints.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Rotation2, Vector2};

use super::grid::{BodyGrid, GridHole, TargetPlaces, pool};
use crate::requirements::Grid;

/// Points beyond a circle by at most this share of its radius count as inside.
const SLIP: f64 = 1e-12;
/// Golden-section steps over the range of rotations; they leave `1e-9` of the range.
const SECTIONS: usize = 44;

/// Centre and radius of the smallest circle that holds the points (incremental, Welzl 1991); radius 0 for no points.
fn smallest_circle(points: &[Vector2<f64>]) -> (Vector2<f64>, f64) {
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

/// The circle through three points; for collinear points, the circle on the two farthest apart as diameter.
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

/// A grid in a plane: its rotation (radians), the position of a hole (pitches, axes without rotation), and the greatest
/// fitting distance (pitches).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Laid {
    pub(super) angle: f64,
    pub(super) origin: Vector2<f64>,
    pub(super) worst: f64,
}

/// Places the grid so that the greatest distance of the cells from their places is least. The best shift for a rotation
/// is the centre of a smallest circle. The rotation is sought within `half` of `angle`, where the distance is nearly
/// convex.
fn fit(places: &[Vector2<f64>], cells: &[GridHole], angle: f64, half: f64) -> Laid {
    let at = |angle: f64| {
        let turn = Rotation2::new(angle);
        let off = |(p, c): (&Vector2<f64>, &GridHole)| p - turn * Vector2::new(c[0] as f64, c[1] as f64);
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

/// Greatest number of tried rotations.
const TURNS: u32 = 10_000;
/// The same limit where every rotation needs a pool of triangles.
const TURNS_OF_POOLS: u32 = 240;
/// Number of rotations and cells fitted after the ranking of all rotations.
const FITTED: usize = 64;
/// Triangles of every pool, at least, and how many of them are fitted.
const TRIANGLES: (usize, usize) = (8, 40);
/// Number of refinements of the centre of the smallest circle on the torus of shifts.
const WRAPS: usize = 3;
/// Grids of a body that are kept.
const KEPT: usize = 3;
/// Grids whose greatest distances differ by less (pitches) count as the same.
const SAME: f64 = 1e-9;

type Place = Vector2<f64>;

fn place(x: [f64; 2]) -> Place {
    Vector2::new(x[0], x[1])
}

/// Rotations within a quarter turn, `share` pitches apart at the place farthest from the centre, at most `most`.
fn turns(places: &[Place], centre: &Place, share: f64, most: u32) -> Vec<f64> {
    let reach = places.iter().map(|p| (p - centre).norm()).fold(0.0, f64::max);
    let target = (FRAC_PI_2 * reach / share).ceil();
    let count = (1..most).find(|n| f64::from(*n) >= target).unwrap_or(most);
    (0..count).map(|k| FRAC_PI_2 * f64::from(k) / f64::from(count)).collect()
}

/// The best distinct grids, best first.
fn best(mut found: Vec<Laid>) -> Vec<Laid> {
    found.sort_by(|a, b| a.worst.total_cmp(&b.worst).then(a.angle.total_cmp(&b.angle)));
    found.dedup_by(|a, b| (a.worst - b.worst).abs() < SAME);
    found.truncate(KEPT);
    found
}

/// The shift of a grid without rotation with the least greatest distance of the places from holes, and that distance.
fn shift(places: &[Place]) -> (Place, f64) {
    let mut best = (Place::zeros(), f64::INFINITY);
    for first in places {
        let mut origin = *first;
        for _ in 0..WRAPS {
            let near: Vec<Place> =
                places.iter().map(|p| origin + (p - origin).map(|x| x - x.round())).collect();
            let (centre, radius) = smallest_circle(&near);
            if radius < best.1 {
                best = (centre, radius);
            }
            origin = centre;
        }
    }
    best
}

/// Grids with the least greatest distance of the joints from holes.
pub(super) fn near_holes(places: &[[f64; 2]]) -> Vec<Laid> {
    let places: Vec<Place> = places.iter().map(|p| place(*p)).collect();
    let centre = places.iter().sum::<Place>() / places.len().max(1) as f64;
    let angles = turns(&places, &centre, 0.5, TURNS);
    let step = FRAC_PI_2 / angles.len() as f64;
    let mut ranked: Vec<(f64, f64, Vec<GridHole>)> = Vec::with_capacity(angles.len());
    for angle in angles {
        let turned: Vec<Place> = places.iter().map(|p| Rotation2::new(-angle) * (p - centre)).collect();
        let (origin, worst) = shift(&turned);
        let cell = |p: &Place| [(p.x - origin.x).round() as i64, (p.y - origin.y).round() as i64];
        ranked.push((worst, angle, turned.iter().map(cell).collect()));
    }
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    best(ranked.iter().take(FITTED).map(|(_, angle, cells)| fit(&places, cells, *angle, step)).collect())
}

/// Grids that minimise the greatest distance of the joints from the corners of a triangle of holes and from holes on
/// its sides. `limit` is the greatest reach (pitches).
pub(super) fn near_triangles(target: &TargetPlaces, limit: f64) -> Vec<Laid> {
    let all = target.corners.iter().chain(target.inner.iter().flatten());
    let places: Vec<Place> = all.map(|p| place(*p)).collect();
    let first = places[0];
    let angles = turns(&places, &first, 1.0, TURNS_OF_POOLS);
    let step = FRAC_PI_2 / angles.len() as f64;
    let mut found = Vec::new();
    for angle in angles {
        // a corner on a hole; the fit shifts it
        let turned = |p: [f64; 2]| -> [f64; 2] { (Rotation2::new(-angle) * (place(p) - first)).into() };
        let (corners, inner) = (target.corners.map(turned), target.inner.map(|i| i.map(turned)));
        let turned = TargetPlaces { corners, inner, skew: 0.0 };
        for t in pool(&turned, TRIANGLES.0, limit).triangles.iter().take(TRIANGLES.1) {
            let mut cells = t.corners.to_vec();
            if target.inner.is_some() {
                cells.extend((0..3).map(|k| t.joint(k)));
            }
            found.push(fit(&places, &cells, angle, step));
        }
    }
    best(found)
}

/// The grid as the user states it: the hole nearest to the foot of the frame's origin, and a rotation within an eighth
/// turn. `plain` is the grid of this pitch without shift and rotation.
pub(super) fn as_grid(laid: &Laid, plain: &BodyGrid) -> Grid {
    let mut angle = laid.angle.rem_euclid(FRAC_PI_2);
    if angle > FRAC_PI_2 / 2.0 {
        angle -= FRAC_PI_2;
    }
    let turn = Rotation2::new(angle);
    let holes = (turn.inverse() * laid.origin).map(f64::round);
    let origin = (laid.origin - turn * holes) * plain.pitch();
    Grid { origin: origin.into(), angle_deg: angle.to_degrees(), ..Grid::square(plain.pitch()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num::Rng;

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

    fn distance(places: &[[f64; 2]], angle: f64, origin: Place) -> f64 {
        let off =
            |p: &[f64; 2]| (Rotation2::new(-angle) * (place(*p) - origin)).map(|x| x - x.round()).norm();
        places.iter().map(off).fold(0.0, f64::max)
    }

    #[test]
    fn random_grids_are_never_nearer() {
        let mut rng = Rng::new(5);
        for n in [3, 6] {
            let places: Vec<[f64; 2]> =
                (0..n).map(|_| [rng.uniform(-20.0, 20.0), rng.uniform(-20.0, 20.0)]).collect();
            let found = near_holes(&places)[0];
            assert!((distance(&places, found.angle, found.origin) - found.worst).abs() < 1e-9);
            for _ in 0..50_000 {
                let origin = Place::new(rng.unit(), rng.unit());
                assert!(distance(&places, rng.uniform(0.0, FRAC_PI_2), origin) >= found.worst);
            }
        }
    }

    #[test]
    fn places_on_a_turned_grid_are_found_to_be_on_one() {
        let turn = Rotation2::new(1.1);
        let holes = [[3.0, -7.0], [24.0, 5.0], [-11.0, 16.0], [2.0, 9.0], [17.0, -20.0], [-4.0, 1.0]];
        let places = holes.map(|h| (turn * place(h) + Place::new(0.4, 0.23)).into());
        let found = near_holes(&places);
        assert!(found[0].worst < 1e-7 && (found[0].angle - 1.1).abs() < 1e-7, "{found:?}");
        assert!(found.len() > 1 && found[1].worst > 1e-3, "{found:?}");
    }

    #[test]
    fn a_triangle_of_holes_with_holes_on_its_sides_is_found_again() {
        let (turn, shift) = (Rotation2::new(0.83), Place::new(-0.3, 0.11));
        let to = |h: [f64; 2]| -> [f64; 2] { (turn * place(h) + shift).into() };
        let on = |joint: [f64; 2]| TargetPlaces {
            corners: [[0.0, 0.0], [24.0, 8.0], [6.0, 26.0]].map(to),
            inner: Some([[6.0, 2.0], joint, [3.0, 13.0]].map(to)),
            skew: 0.0,
        };
        let found = near_triangles(&on([19.0, 13.0]), 8.0)[0];
        assert!(found.worst < 1e-7 && (found.angle - 0.83).abs() < 1e-7, "{found:?}");
        // half a pitch off the hole, along the side: no grid has all six
        let found = near_triangles(&on([19.35, 12.65]), 8.0)[0];
        assert!(found.worst > 1e-3, "{found:?}");
    }
}
