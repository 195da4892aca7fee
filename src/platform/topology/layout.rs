//! Positions of the joints of a topology in a drawing.

use std::f64::consts::TAU;

use super::graph::{Topology, each_order};

/// Angles of the joints, evenly spaced on a circle for each body, with steep legs.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// Angle of each base joint, radians.
    pub base: Vec<f64>,
    /// Angle of each platform joint, radians.
    pub platform: Vec<f64>,
}

impl Topology {
    /// An arrangement with a small sum of squared angles between the ends of the legs. It tries all orders of the base
    /// joints, with platform joints in the order of the mean direction of their base joints.
    #[must_use]
    pub fn layout(self) -> Layout {
        let n = self.base_joints();
        let mut best: Option<(f64, Layout)> = None;
        let mut order: Vec<usize> = (0..n).collect();
        // the first joint is fixed, since rotating all changes nothing
        each_order(&mut order, 1, &mut |order| {
            let mut base = vec![0.0; n];
            for (place, joint) in order.iter().enumerate() {
                base[*joint] = TAU * place as f64 / n as f64;
            }
            let (cost, platform) = self.platform_angles(&base);
            // mirror images have equal costs up to rounding
            if best.as_ref().is_none_or(|b| cost < b.0 - 1e-9) {
                best = Some((cost, Layout { base, platform }));
            }
        });
        best.map_or(Layout { base: Vec::new(), platform: Vec::new() }, |b| b.1)
    }

    /// Platform joints about the mean directions of their base joints, evenly spaced, and the cost.
    fn platform_angles(self, base: &[f64]) -> (f64, Vec<f64>) {
        let (m, legs) = (self.platform_joints(), self.legs());
        let direction = |j: usize| {
            let ends = legs.iter().filter(|l| l.1 == j).map(|l| base[l.0].sin_cos());
            let (sine, cosine) = ends.fold((0.0, 0.0), |t, u| (t.0 + u.0, t.1 + u.1));
            // opposite base joints have no mean; any place between them is valid
            if sine.hypot(cosine) < 1e-9 { 0.5 } else { sine.atan2(cosine).rem_euclid(TAU) }
        };
        let mut order: Vec<usize> = (0..m).collect();
        order.sort_by(|i, j| direction(*i).total_cmp(&direction(*j)).then(i.cmp(j)));
        let place = |joint: usize| order.iter().position(|o| *o == joint).unwrap_or(0);
        let slot = |joint: usize| TAU * place(joint) as f64 / m as f64;
        let gaps: Vec<f64> = legs.iter().map(|l| wrap(base[l.0] - slot(l.1))).collect();
        let (sine, cosine) = gaps.iter().fold((0.0, 0.0), |t, g| (t.0 + g.sin(), t.1 + g.cos()));
        let turn = sine.atan2(cosine);
        let cost = gaps.iter().map(|g| wrap(g - turn).powi(2)).sum();
        (cost, (0..m).map(|j| slot(j) + turn).collect())
    }
}

/// The angle in `(-pi, pi]`, up to rounding.
fn wrap(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_octahedral_zigzag_is_drawn_as_one() {
        let t = Topology::of_legs([0, 1, 1, 2, 2, 0], [0, 0, 1, 1, 2, 2]);
        let l = t.layout();
        for (a, b) in t.legs() {
            assert!((wrap(l.base[a] - l.platform[b]).abs() - TAU / 6.0).abs() < 1e-9);
        }
        let all = [0, 1, 2, 3, 4, 5];
        let l = Topology::of_legs(all, all).layout();
        assert!(l.base.iter().zip(&l.platform).all(|(a, b)| wrap(a - b).abs() < 1e-9));
    }
}
