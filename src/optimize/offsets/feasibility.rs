//! Margins of offsets with the sign of exact arithmetic, which judge the results of the search.
//!
//! Data and offsets are doubles taken exactly, so every limit is met or not without any tolerance. The module is
//! independent of the intervals that exclude boxes.

use nalgebra::Point3;

use super::outcome::Margins;
use super::problem::OffsetProblem;
use num::exact::{Rational, approximate, rational};
use platform::manipulator::Body;
use synthesis::{HexagonSide, sides};
use synthesis::{offset_determinant, offset_products};

/// Margins in plain arithmetic above this share of the largest number involved have the sign of the exact ones.
const CLEAR: f64 = 1e-9;

/// An edge and the place on it.
#[derive(Debug, Clone, Copy)]
struct EdgeJoint {
    start: Point3<f64>,
    end: Point3<f64>,
    t: f64,
}

impl EdgeJoint {
    fn at(vertex: Point3<f64>) -> Self {
        Self { start: vertex, end: vertex, t: 0.0 }
    }

    fn plain(&self) -> Point3<f64> {
        self.start + (self.end - self.start) * self.t
    }

    fn exact(&self) -> Option<[Rational; 3]> {
        let t = rational(self.t)?;
        let coordinate = |k: usize| {
            let (a, b) = (rational(self.start[k])?, rational(self.end[k])?);
            Some(&a + (b - &a) * &t)
        };
        Some([coordinate(0)?, coordinate(1)?, coordinate(2)?])
    }

    fn largest(&self) -> f64 {
        let coordinates = self.start.coords.amax().max(self.end.coords.amax());
        coordinates * (1.0 + 2.0 * self.t.abs())
    }
}

/// A number with the sign of an exact one and about the given size.
fn signed(exact: &Rational, size: f64) -> f64 {
    let zero = Rational::from_integer(0.into());
    match exact.cmp(&zero) {
        std::cmp::Ordering::Equal => 0.0,
        std::cmp::Ordering::Greater => size.abs().max(f64::MIN_POSITIVE),
        std::cmp::Ordering::Less => -size.abs().max(f64::MIN_POSITIVE),
    }
}

/// Distance of two joints minus the required one; `None` if a number is not finite.
fn distance_margin(a: &EdgeJoint, b: &EdgeJoint, required: f64) -> Option<f64> {
    let distance = (a.plain() - b.plain()).norm();
    let plain = distance - required;
    if plain.abs() > CLEAR * a.largest().max(b.largest()).max(required) {
        return Some(plain);
    }
    let (p, q) = (a.exact()?, b.exact()?);
    let mut excess = Rational::from_integer(0.into());
    for (x, y) in p.iter().zip(&q) {
        let gap = x - y;
        excess += &gap * &gap;
    }
    let required_exact = rational(required)?;
    excess -= &required_exact * &required_exact;
    Some(signed(&excess, approximate(&excess) / (distance + required)))
}

fn least_margin(body: Body, sides: &[HexagonSide; 6], t: &[f64; 6], required: f64) -> Option<f64> {
    let own = |i: &usize| sides[*i].sliding == body;
    let sliding = (0..6).filter(own).map(|i| EdgeJoint { start: sides[i].start, end: sides[i].end, t: t[i] });
    let vertices = (0..6).filter(own).map(|i| EdgeJoint::at(sides[i].start));
    let joints: Vec<EdgeJoint> = sliding.chain(vertices).collect();
    let mut least = f64::INFINITY;
    for (i, a) in joints.iter().enumerate() {
        for b in &joints[..i] {
            least = least.min(distance_margin(a, b, required)?);
        }
    }
    Some(least)
}

fn determinant_margin(t: &[f64; 6], plain: f64, required: f64) -> Option<f64> {
    let margin = plain.abs() - required;
    let size = t.iter().map(|x| 1.0 + x.abs()).product::<f64>().max(required);
    if margin.abs() > CLEAR * size {
        return Some(margin);
    }
    let one = Rational::from_integer(1.into());
    let exact: Option<Vec<Rational>> = t.iter().map(|x| rational(*x)).collect();
    let (rest, own) = offset_products(&one, exact?);
    let det = rest - own;
    let size = if det < Rational::from_integer(0.into()) { -det } else { det };
    let excess = size - rational(required)?;
    Some(signed(&excess, approximate(&excess)))
}

impl OffsetProblem {
    /// Distances of the offsets from the limits. The sign of each is exact; zero means exactly met. `None` if a number
    /// is not finite.
    pub fn margins(&self, t: &[f64; 6]) -> Option<Margins> {
        if !t.iter().all(|x| x.is_finite()) {
            return None;
        }
        let sides = sides(&self.octahedral, 1.0);
        let spacing = |body| least_margin(body, &sides, t, self.min_joint_distance);
        // the difference of two doubles has the sign of the exact one
        let bounds = t.iter().zip(&self.bounds).map(|(t, b)| (t - b.0).min(b.1 - t));
        Some(Margins {
            base_spacing: spacing(Body::Base)?,
            platform_spacing: spacing(Body::Platform)?,
            det: determinant_margin(t, offset_determinant(t), self.min_abs_det)?,
            bounds: bounds.fold(f64::INFINITY, f64::min),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{example, poses};
    use super::*;

    #[test]
    fn margins_are_those_of_the_built_joints_and_equality_is_met() {
        let p = OffsetProblem::with_defaults(example(), poses());
        let t = [0.2, 0.3, -0.4, 0.1, 1.2, 0.6];
        let m = p.margins(&t).unwrap();
        let (built, _) = synthesis::joint_free(&p.octahedral, t).unwrap();
        for (own, margin) in
            [(built.base_joints(), m.base_spacing), (built.platform_joints(), m.platform_spacing)]
        {
            let mut least = f64::INFINITY;
            for i in 0..6 {
                for j in 0..i {
                    least = least.min((own[i] - own[j]).norm());
                }
            }
            assert!((least - p.min_joint_distance - margin).abs() < 1e-12);
        }
        // a joint at exactly the required distance from a vertex, and one double closer
        let mut q = p.clone();
        q.min_joint_distance = 3.0;
        // the edge on the x axis is exactly 12 long
        let exact = [0.5, 0.5, 0.5, 0.5, 0.25, 0.5];
        assert!(q.margins(&exact).unwrap().base_spacing.abs() <= 0.0);
        let closer = [0.5, 0.5, 0.5, 0.5, 0.25f64.next_down(), 0.5];
        let margin = q.margins(&closer).unwrap().base_spacing;
        assert!(margin < 0.0 && margin > -1e-15, "{margin}");
        // the determinant at its limit to the last bit: 0.75^6 - 0.25^6 is a double
        let t = [0.25; 6];
        q.min_abs_det = 0.75f64.powi(6) - 0.25f64.powi(6);
        assert!(q.margins(&t).unwrap().det.abs() <= 0.0);
        q.min_abs_det = q.min_abs_det.next_up();
        assert!(q.margins(&t).unwrap().det < 0.0);
    }
}
