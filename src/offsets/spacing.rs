//! Distance of two sliding joints of one body: a convex quadratic of two offsets, bounded from below.

use nalgebra::Vector3;

use super::hexagon::Side;

/// Two edge joints that slide on edges with a common vertex: sides `first` and `second = first + 2`.
///
/// `q(x, y) = |w + x e - y f|^2` with `x = t_first`, `y = t_second`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pair {
    pub(crate) first: usize,
    pub(crate) second: usize,
    w: Vector3<f64>,
    e: Vector3<f64>,
    f: Vector3<f64>,
}

pub(crate) type Box2 = [(f64, f64); 2];

impl Pair {
    /// The six pairs, three on each body.
    pub(crate) fn all(sides: &[Side; 6]) -> [Self; 6] {
        std::array::from_fn(|first| {
            let second = (first + 2) % 6;
            let (a, b) = (&sides[first], &sides[second]);
            Self { first, second, w: a.start - b.start, e: a.edge(), f: b.edge() }
        })
    }

    fn gap(&self, x: f64, y: f64) -> Vector3<f64> {
        self.w + self.e * x - self.f * y
    }

    pub(crate) fn squared(&self, t: &[f64; 6]) -> f64 {
        self.gap(t[self.first], t[self.second]).norm_squared()
    }

    /// Derivatives by `t_first` and `t_second`.
    pub(crate) fn gradient(&self, t: &[f64; 6]) -> [f64; 2] {
        let gap = self.gap(t[self.first], t[self.second]);
        [2.0 * gap.dot(&self.e), -2.0 * gap.dot(&self.f)]
    }

    /// Second derivatives: by first twice, mixed, by second twice. Constant.
    pub(crate) fn hessian(&self) -> [f64; 3] {
        [2.0 * self.e.norm_squared(), -2.0 * self.e.dot(&self.f), 2.0 * self.f.norm_squared()]
    }

    pub(crate) fn edges(&self) -> (f64, f64) {
        (self.e.norm(), self.f.norm())
    }

    pub(crate) fn box_of(&self, bounds: &[(f64, f64); 6]) -> Box2 {
        [bounds[self.first], bounds[self.second]]
    }

    /// Least value on a box: at the common vertex `(1, 0)` when inside, else on one of the four edges.
    pub(crate) fn least(&self, [x, y]: Box2) -> f64 {
        if x.0 <= 1.0 && 1.0 <= x.1 && y.0 <= 0.0 && 0.0 <= y.1 {
            return 0.0;
        }
        let (ee, ff) = (self.e.norm_squared(), self.f.norm_squared());
        let along_x = |y: f64| (-self.e.dot(&self.gap(0.0, y)) / ee).clamp(x.0, x.1);
        let along_y = |x: f64| (self.f.dot(&self.gap(x, 0.0)) / ff).clamp(y.0, y.1);
        let candidates = [(along_x(y.0), y.0), (along_x(y.1), y.1), (x.0, along_y(x.0)), (x.1, along_y(x.1))];
        candidates.iter().map(|&(x, y)| self.gap(x, y).norm_squared()).fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::super::hexagon::sides;
    use super::super::tests::example;
    use super::*;
    use crate::num::Rng;

    #[test]
    fn the_least_value_on_a_box_is_that_of_samples() {
        let mut rng = Rng::new(11);
        for pair in Pair::all(&sides(&example(), 5.0)) {
            for _ in 0..40 {
                let mut side = || {
                    let (a, b) = (rng.uniform(-1.0, 2.0), rng.uniform(-1.0, 2.0));
                    (a.min(b), a.max(b))
                };
                let b2 = [side(), side()];
                let mut found = f64::INFINITY;
                for k in 0..=20 {
                    for l in 0..=20 {
                        let at = |b: (f64, f64), k: i32| b.0 + (b.1 - b.0) * f64::from(k) / 20.0;
                        let mut t = [0.0; 6];
                        (t[pair.first], t[pair.second]) = (at(b2[0], k), at(b2[1], l));
                        found = found.min(pair.squared(&t));
                    }
                }
                let low = pair.least(b2);
                assert!(low <= found + 1e-12 && found - low < 0.3, "{low} {found}");
            }
        }
    }

    #[test]
    fn joints_at_the_common_vertex_have_distance_zero() {
        for pair in Pair::all(&sides(&example(), 1.0)) {
            let mut t = [0.3; 6];
            (t[pair.first], t[pair.second]) = (1.0, 0.0);
            assert!(pair.squared(&t) < 1e-24);
        }
    }
}
