//! The greatest norm of a sum of vectors, each free in an ellipsoid or a segment.
//!
//! `max |sum_j B_j x_j + sum_k s_k y_k|` over `|x_j| <= 1`, `|y_k| <= 1` is the greatest value on the unit sphere of
//!
//! ```text
//! f(n) = sum_j |B_j^T n| + sum_k |s_k . n|,
//! ```
//!
//! which is convex and homogeneous, so that it has several local maxima.

use nalgebra::{Matrix3, Vector3};

/// Local searches end when a step gains less than this share.
const GAIN: f64 = 1e-13;
/// Greatest number of triangles of the sphere on one level of subdivision.
const TRIANGLES: usize = 4000;
/// Levels of subdivision, at most: triangles of a thousandth of a degree.
const LEVELS: usize = 16;

/// The function `f`.
#[derive(Debug, Clone, Default)]
pub(crate) struct Gauge {
    balls: Vec<Matrix3<f64>>,
    segments: Vec<Vector3<f64>>,
}

/// Bounds of the greatest value of `f`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bracket {
    /// A value of `f`, reached in `direction`.
    pub least: f64,
    /// No value is greater.
    pub most: f64,
    pub direction: Vector3<f64>,
}

impl Gauge {
    /// One ellipsoid a matrix, and segments.
    pub(super) fn of(balls: Vec<Matrix3<f64>>, segments: Vec<Vector3<f64>>) -> Self {
        Self { balls, segments }
    }

    /// One ellipsoid a matrix.
    pub(super) fn balls(blocks: &[Matrix3<f64>], radius: f64) -> Self {
        Self { balls: blocks.iter().map(|b| b * radius).collect(), segments: Vec::new() }
    }

    /// Three segments a matrix: its columns, times the half widths.
    pub(super) fn boxes(blocks: &[Matrix3<f64>], half: &[Vector3<f64>]) -> Self {
        let columns = |(b, h): (&Matrix3<f64>, &Vector3<f64>)| -> Vec<Vector3<f64>> {
            (0..3).map(|k| b.column(k) * h[k]).collect()
        };
        Self { balls: Vec::new(), segments: blocks.iter().zip(half).flat_map(columns).collect() }
    }

    fn value(&self, n: &Vector3<f64>) -> f64 {
        let balls = self.balls.iter().map(|b| b.tr_mul(n).norm()).sum::<f64>();
        balls + self.segments.iter().map(|s| s.dot(n).abs()).sum::<f64>()
    }

    /// A subgradient at `n`: the sum with every part as far in direction `n` as possible.
    fn farthest(&self, n: &Vector3<f64>) -> Vector3<f64> {
        let mut out = Vector3::zeros();
        for b in &self.balls {
            let x = b.tr_mul(n);
            let norm = x.norm();
            if norm > 0.0 {
                out += b * (x / norm);
            }
        }
        for s in &self.segments {
            out += if s.dot(n) < 0.0 { -s } else { *s };
        }
        out
    }

    /// A local maximum: `n <- farthest(n)`, normalised, never lowers `f` (generalised power method).
    fn climb(&self, start: Vector3<f64>) -> (f64, Vector3<f64>) {
        let (mut n, mut best) = (start, self.value(&start));
        for _ in 0..200 {
            let far = self.farthest(&n);
            let norm = far.norm();
            if !(norm > 0.0) {
                break;
            }
            let next = far / norm;
            let value = self.value(&next);
            let enough = value > best * (1.0 + GAIN);
            if value > best {
                (n, best) = (next, value);
            }
            if !enough {
                break;
            }
        }
        (best, n)
    }

    /// The best local maximum from the axes and the diagonals of the octants: a value that `f` takes.
    pub(super) fn search(&self) -> (f64, Vector3<f64>) {
        let d = 1.0 / 3f64.sqrt();
        let starts = [
            Vector3::x(),
            Vector3::y(),
            Vector3::z(),
            Vector3::new(d, d, d),
            Vector3::new(-d, d, d),
            Vector3::new(d, -d, d),
            Vector3::new(d, d, -d),
        ];
        let found = starts.map(|s| self.climb(s));
        found.into_iter().fold((-1.0, Vector3::z()), |best, next| if next.0 > best.0 { next } else { best })
    }

    /// Both bounds, within the relative gap where the number of triangles allows it.
    ///
    /// A point of a spherical triangle is `x / |x|` with `x` in the flat one. `f(x)` is at most its greatest value at
    /// the corners, and `|x|` at least the distance of the plane from the origin. Their quotient bounds `f`. Triangles
    /// whose bound is below a value found are dropped, the others divided in four.
    pub(super) fn bracket(&self, gap: f64) -> Bracket {
        let (mut least, mut direction) = self.search();
        let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
        let mut open: Vec<[Vector3<f64>; 3]> = vec![[x, y, z], [y, -x, z], [-x, -y, z], [-y, x, z]];
        let bound = |t: &[Vector3<f64>; 3]| {
            let normal = (t[1] - t[0]).cross(&(t[2] - t[0]));
            let height = (t[0].dot(&normal) / normal.norm()).abs();
            t.iter().map(|n| self.value(n)).fold(0.0, f64::max) / height
        };
        let mut most = least;
        for _ in 0..LEVELS {
            open.retain(|t| bound(t) > least * (1.0 + gap));
            most = least * (1.0 + gap);
            if open.is_empty() || open.len() > TRIANGLES {
                break;
            }
            let mut next = Vec::with_capacity(4 * open.len());
            for [a, b, c] in &open {
                let [ab, bc, ca] = [(a + b).normalize(), (b + c).normalize(), (c + a).normalize()];
                for n in [ab, bc, ca] {
                    let value = self.value(&n);
                    if value > least {
                        (least, direction) = self.climb(n);
                    }
                }
                next.extend([[*a, ab, ca], [ab, *b, bc], [ca, bc, *c], [ab, bc, ca]]);
            }
            open = next;
        }
        let most = open.iter().map(bound).fold(most.max(least), f64::max);
        Bracket { least, most, direction }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num::Rng;

    fn random(rng: &mut Rng) -> Gauge {
        let mut block = || Matrix3::from_fn(|_, _| rng.normal());
        let balls = (0..5).map(|_| block()).collect();
        let segments = (0..4).map(|_| block().column(0).into()).collect();
        Gauge { balls, segments }
    }

    #[test]
    fn no_direction_exceeds_the_bracket_and_some_choice_reaches_it() {
        let mut rng = Rng::new(3);
        for _ in 0..20 {
            let g = random(&mut rng);
            let found = g.bracket(1e-6);
            assert!(found.most <= found.least * (1.0 + 2e-6), "{found:?}");
            for _ in 0..2000 {
                let n = Vector3::from_fn(|_, _| rng.normal()).normalize();
                assert!(g.value(&n) <= found.most);
                // any choice of the parts gives a vector no longer than that
                assert!(g.farthest(&n).norm() <= found.most * (1.0 + 1e-12));
            }
            let reached = g.farthest(&found.direction).norm();
            assert!((reached - found.least).abs() < 1e-9 * reached, "{reached} {found:?}");
        }
    }

    #[test]
    fn segments_are_worst_at_a_vertex_of_their_box() {
        let mut rng = Rng::new(5);
        for _ in 0..20 {
            let segments: Vec<Vector3<f64>> = (0..8).map(|_| Vector3::from_fn(|_, _| rng.normal())).collect();
            let vertex = |c: usize| -> f64 {
                let signed = |(k, s): (usize, &Vector3<f64>)| if c >> k & 1 == 0 { *s } else { -s };
                segments.iter().enumerate().map(signed).sum::<Vector3<f64>>().norm()
            };
            let most = (0..256).map(vertex).fold(0.0, f64::max);
            let found = Gauge { balls: Vec::new(), segments: segments.clone() }.bracket(1e-6);
            assert!((found.least - most).abs() < 1e-9 * most, "{} {most}", found.least);
        }
    }

    #[test]
    fn one_search_alone_can_miss_the_maximum() {
        // negative control: y is a stationary direction of an ellipsoid with the half axes 2, 1, 0
        let flat = Matrix3::from_diagonal(&Vector3::new(2.0, 1.0, 0.0));
        let g = Gauge::balls(&[flat], 1.0);
        assert!((g.climb(Vector3::y()).0 - 1.0).abs() < 1e-12);
        assert!((g.bracket(1e-6).least - 2.0).abs() < 1e-9);
    }
}
