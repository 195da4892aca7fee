//! Distances of straight segments in space: from each other, from boxes.

use nalgebra::{Point3, Vector3};

/// Two lines `p + s e` and `q + t f` by the products of `p - q`, `e` and `f`, which are common to all their segments.
#[derive(Debug, Clone, Copy)]
pub struct LinePair {
    /// `p - q`.
    pub apart: Vector3<f64>,
    ee: f64,
    ff: f64,
    ef: f64,
    ew: f64,
    fw: f64,
}

impl LinePair {
    /// The pair from `p - q` and the directions.
    #[must_use]
    #[inline]
    pub fn new(apart: Vector3<f64>, e: &Vector3<f64>, f: &Vector3<f64>) -> Self {
        let (ew, fw) = (e.dot(&apart), f.dot(&apart));
        Self { apart, ee: e.norm_squared(), ff: f.norm_squared(), ef: e.dot(f), ew, fw }
    }

    /// Parameters `s` and `t`, each within a range, at which the lines are closest.
    ///
    /// `|p - q + s e - t f|^2` is convex in `(s, t)`. One round of projections from the zero of the gradient, cut to
    /// its range, ends at the least value. Parallel lines may start anywhere.
    #[must_use]
    #[inline]
    pub fn closest(&self, first: (f64, f64), second: (f64, f64)) -> (f64, f64) {
        let Self { ee, ff, ef, ew, fw, .. } = *self;
        let on_second =
            |s: f64| if ff > 0.0 { ((fw + s * ef) / ff).clamp(second.0, second.1) } else { second.0 };
        let on_first = |t: f64| if ee > 0.0 { ((t * ef - ew) / ee).clamp(first.0, first.1) } else { first.0 };
        let det = ee * ff - ef * ef;
        let s =
            if det > 1e-14 * ee * ff { ((ef * fw - ff * ew) / det).clamp(first.0, first.1) } else { first.0 };
        let t = on_second(s);
        let s = on_first(t);
        (s, on_second(s))
    }
}

/// The distance of the segments `p0 p1` and `q0 q1`; a segment may be a point.
///
/// ```
/// # mod equipod { pub mod methods { pub use equipod_platform::{geom, manipulator, topology}; } pub mod prelude { pub use equipod_platform::geom::*; } }
/// use equipod::methods::geom::segment_distance;
/// use nalgebra::Point3;
/// let at = |x: f64, y: f64, z: f64| Point3::new(x, y, z);
/// let crossing = segment_distance([at(-1.0, 0.0, 0.0), at(1.0, 0.0, 0.0)], [at(0.0, -1.0, 0.5), at(0.0, 1.0, 0.5)]);
/// assert!((crossing - 0.5).abs() < 1e-15);
/// ```
#[must_use]
pub fn segment_distance([p0, p1]: [Point3<f64>; 2], [q0, q1]: [Point3<f64>; 2]) -> f64 {
    let (e, f, w) = (p1 - p0, q1 - q0, p0 - q0);
    let (s, t) = LinePair::new(w, &e, &f).closest((0.0, 1.0), (0.0, 1.0));
    (w + e * s - f * t).norm()
}

/// The nearest point of a segment to the box `|x_k - center_k| <= half_k`: its share, and the vector from the box, zero
/// if they meet.
///
/// The squared distance of the point `x + t (y - x)` from the box is convex in `t`. Between the parameters at which a
/// coordinate crosses a face it is quadratic, with its least value in closed form.
#[must_use]
pub fn segment_box_nearest(
    [x, y]: [Point3<f64>; 2],
    center: &Point3<f64>,
    half: &Vector3<f64>,
) -> (f64, Vector3<f64>) {
    let (start, d) = (x - center, y - x);
    let mut cuts = vec![0.0, 1.0];
    for k in 0..3 {
        let crossings = [-half[k], half[k]].map(|face| (face - start[k]) / d[k]);
        cuts.extend(crossings.into_iter().filter(|t| *t > 0.0 && *t < 1.0));
    }
    cuts.sort_by(f64::total_cmp);
    let outside = |t: f64| {
        let q = start + d * t;
        Vector3::from_fn(|k, _| q[k] - q[k].clamp(-half[k], half[k]))
    };
    let piece = |w: &[f64]| {
        let middle = outside(f64::midpoint(w[0], w[1]));
        // coordinates outside in the middle of the piece are outside along all of it
        let moving = Vector3::from_fn(|k, _| if middle[k] == 0.0 { 0.0 } else { d[k] });
        let (rate, square) = (middle.dot(&moving), moving.norm_squared());
        let t = if square > 0.0 { f64::midpoint(w[0], w[1]) - rate / square } else { w[0] };
        let t = t.clamp(w[0], w[1]);
        (t, outside(t))
    };
    let nearest = cuts.windows(2).map(piece).min_by(|a, b| a.1.norm_squared().total_cmp(&b.1.norm_squared()));
    nearest.unwrap_or_else(|| (0.0, outside(0.0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use num::Rng;

    fn segment_box_distance(segment: [Point3<f64>; 2], center: &Point3<f64>, half: &Vector3<f64>) -> f64 {
        segment_box_nearest(segment, center, half).1.norm()
    }

    fn point(rng: &mut Rng) -> Point3<f64> {
        Point3::new(rng.normal(), rng.normal(), rng.normal())
    }

    #[test]
    fn no_pair_of_points_is_nearer_and_a_fine_grid_comes_close() {
        let mut rng = Rng::new(5);
        for k in 0..60 {
            let p = [point(&mut rng), point(&mut rng)];
            let mut q = [point(&mut rng), point(&mut rng)];
            match k % 4 {
                1 => q[1] = q[0] + (p[1] - p[0]) * 0.7, // parallel
                2 => q[1] = q[0],                       // a point
                _ => {}
            }
            let found = segment_distance(p, q);
            assert!((found - segment_distance(q, [p[1], p[0]])).abs() < 1e-12);
            let (mut least, n) = (f64::MAX, 200);
            for i in 0..=n {
                for j in 0..=n {
                    let (x, y) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
                    let d = (p[0] + (p[1] - p[0]) * x - (q[0] + (q[1] - q[0]) * y)).norm();
                    assert!(d >= found - 1e-12);
                    least = least.min(d);
                }
            }
            assert!(least < found + 0.05, "{least} {found}");
        }
    }

    #[test]
    fn segments_that_meet_touch_or_overlap_have_distance_zero() {
        let at = |x: f64, y: f64| Point3::new(x, y, 0.0);
        let line = [at(-1.0, 0.0), at(1.0, 0.0)];
        for other in
            [[at(0.3, -1.0), at(0.3, 2.0)], [at(1.0, 0.0), at(2.0, 5.0)], [at(0.5, 0.0), at(3.0, 0.0)]]
        {
            assert!(segment_distance(line, other) < 1e-15);
        }
        assert!((segment_distance(line, [at(2.0, 0.0), at(3.0, 0.0)]) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn distance_from_a_box_is_that_of_the_nearest_point_of_a_fine_grid() {
        let mut rng = Rng::new(7);
        for _ in 0..100 {
            let [p, q, center] = std::array::from_fn(|_| point(&mut rng));
            let half = point(&mut rng).coords.abs() * 0.5;
            let exact = segment_box_distance([p, q], &center, &half);
            let at = |t: f64| {
                let d = p + (q - p) * t - center;
                Vector3::from_fn(|k, _| (d[k].abs() - half[k]).max(0.0)).norm()
            };
            let grid = (0..=2000).map(|k| at(f64::from(k) / 2000.0)).fold(f64::INFINITY, f64::min);
            assert!(exact <= grid + 1e-14 && exact > grid - 5e-3, "{exact} {grid}");
        }
        let at = |x: f64, y: f64| Point3::new(x, y, 0.0);
        let (center, half) = (Point3::origin(), Vector3::new(1.0, 1.0, 1.0));
        assert!(segment_box_distance([at(-9.0, 0.1), at(9.0, 0.1)], &center, &half) < 1e-15);
        assert!((segment_box_distance([at(3.0, 0.0), at(3.0, 5.0)], &center, &half) - 2.0).abs() < 1e-15);
        assert!((segment_box_distance([at(4.0, 5.0), at(4.0, 5.0)], &center, &half) - 5.0).abs() < 1e-15);
    }
}
