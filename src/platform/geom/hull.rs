//! Convex hulls in the plane.

use nalgebra::Point2;

fn turn_of(a: &Point2<f64>, b: &Point2<f64>, c: &Point2<f64>) -> f64 {
    (b - a).perp(&(c - a))
}

/// Corners of the convex hull, counter-clockwise (monotone chain, Andrew 1979). A point within `tolerance` of the line
/// of its neighbours is not a corner.
#[must_use]
pub fn convex_hull(points: &[Point2<f64>], tolerance: f64) -> Vec<Point2<f64>> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|p, q| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)));
    let mut apart: Vec<Point2<f64>> = Vec::new();
    for p in sorted {
        // in the order of x only the last ones can be near
        let near = |q: &&Point2<f64>| p.x - q.x <= tolerance;
        if apart.iter().rev().take_while(near).all(|q| (p - q).norm() > tolerance) {
            apart.push(p);
        }
    }
    if apart.len() < 3 {
        return apart;
    }
    let chain = |points: &mut dyn Iterator<Item = Point2<f64>>| {
        let mut out: Vec<Point2<f64>> = Vec::new();
        for p in points {
            while let [.., a, b] = out[..] {
                if turn_of(&a, &b, &p) > tolerance * (p - a).norm() {
                    break;
                }
                out.pop();
            }
            out.push(p);
        }
        out.pop();
        out
    };
    let mut corners = chain(&mut apart.iter().copied());
    corners.extend(chain(&mut apart.iter().rev().copied()));
    corners
}

#[cfg(test)]
mod tests {
    use super::*;
    use num::Rng;

    /// A large point set, as for a silhouette: the corners are on one side of every edge, found without delay.
    #[test]
    fn no_point_is_outside_the_hull_of_many() {
        let mut rng = Rng::new(3);
        let points: Vec<Point2<f64>> =
            (0..20_000).map(|_| Point2::new(rng.normal(), (4.0 * rng.unit()).floor())).collect();
        let corners = convex_hull(&points, 1e-6);
        assert!((4..20).contains(&corners.len()), "{corners:?}");
        for (k, a) in corners.iter().enumerate() {
            let b = &corners[(k + 1) % corners.len()];
            assert!(points.iter().all(|p| turn_of(a, b, p) > -1e-5), "{a} {b}");
        }
    }

    #[test]
    fn corners_of_a_square_a_line_and_a_point() {
        let p = Point2::new;
        let square =
            [p(1.0, 1.0), p(0.0, 0.0), p(2.0, 2.0), p(1.0, 0.0), p(2.0, 0.0), p(0.0, 2.0), p(2.0, 2.0)];
        assert_eq!(convex_hull(&square, 1e-9), [p(0.0, 0.0), p(2.0, 0.0), p(2.0, 2.0), p(0.0, 2.0)]);
        assert_eq!(convex_hull(&[p(1.0, 1.0), p(3.0, 3.0), p(2.0, 2.0)], 1e-9), [p(1.0, 1.0), p(3.0, 3.0)]);
        assert_eq!(convex_hull(&[p(1.0, 1.0), p(1.0, 1.0)], 1e-9), [p(1.0, 1.0)]);
    }
}
