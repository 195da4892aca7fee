//! The space that plates and machine may occupy, including the housings of the joints.

use nalgebra::{Point3, Vector3};

use super::hardware::Housing;
use num::ordered::OrderedNumber;

/// A region that contains the joints with their housings, in the frame of the body, or in the base frame for the whole
/// machine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Envelope {
    /// Everything within this radius of a line along the z axis.
    Cylinder {
        /// Radius, design units.
        radius: f64,
        /// Point where the line passes the xy plane, design units.
        center: [f64; 2],
    },
    /// A box along the axes of the frame.
    Box {
        /// Its corner with the least coordinates.
        min: Point3<f64>,
        /// The opposite corner.
        max: Point3<f64>,
    },
}

/// The envelopes of a design. Absent entries limit nothing.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Envelopes {
    /// Envelope of the base joints, base frame.
    pub base: Option<Envelope>,
    /// Envelope of the platform joints, platform frame.
    pub platform: Option<Envelope>,
    /// Envelope of all joints at every pose of the workspace, base frame.
    pub machine: Option<Envelope>,
}

impl Envelope {
    /// The radius, or half the shortest edge.
    #[must_use]
    pub fn half_width(&self) -> f64 {
        match self {
            Self::Cylinder { radius, .. } => *radius,
            Self::Box { min, max } => 0.5 * (max - min).min(),
        }
    }

    /// Distances of a joint inside the sides; negative outside.
    ///
    /// The joint has half extents `half` along the axes (a box), and `ball` in every direction. A cylinder has one
    /// side, a box six; `see` gets the number of each side and its margin. Cylinder:
    /// `radius - |(|x - c| + half_x, |y - c| + half_y)| - ball`, the farthest corner of the joint's box. Box: the
    /// distance of the centre from the side, minus `half_k + ball`.
    pub fn sides<N: OrderedNumber>(
        &self,
        at: [N; 3],
        (half, ball): (&Vector3<f64>, f64),
        see: &mut impl FnMut(usize, N),
    ) {
        let ball = N::from(ball);
        match self {
            Self::Cylinder { radius, center } => {
                let reach = |k: usize| (at[k] - N::from(center[k])).abs() + N::from(half[k]);
                see(0, N::from(*radius) - N::norm([reach(0), reach(1), N::from(0.0)]) - ball);
            }
            Self::Box { min, max } => {
                for k in 0..3 {
                    let own = N::from(half[k]) + ball;
                    see(2 * k, at[k] - N::from(min[k]) - own);
                    see(2 * k + 1, N::from(max[k]) - at[k] - own);
                }
            }
        }
    }

    /// The least margin of the [`sides`](Self::sides).
    #[must_use]
    pub fn margin<N: OrderedNumber>(&self, at: [N; 3], half: &Vector3<f64>, ball: f64) -> N {
        let mut least = N::from(f64::MAX);
        self.sides(at, (half, ball), &mut |_, margin| least = least.min(margin));
        least
    }
}

/// Half extents of the space of a joint along the axes of its body's frame, and its radius; one of them is 0.
#[must_use]
pub fn extent(housing: Option<Housing>) -> (Vector3<f64>, f64) {
    match housing {
        None => (Vector3::zeros(), 0.0),
        Some(Housing::Sphere(diameter)) => (Vector3::zeros(), 0.5 * diameter),
        Some(Housing::Box(edges)) => (0.5 * edges, 0.0),
    }
}

/// Radius of the ball that contains the space of a joint in every orientation.
#[must_use]
pub fn ball(housing: Option<Housing>) -> f64 {
    let (half, radius) = extent(housing);
    half.norm() + radius
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn margins_of_cylinders_and_boxes_by_hand() {
        let circle = Envelope::Cylinder { radius: 10.0, center: [1.0, 0.0] };
        let at = [4.0, 4.0, 99.0];
        let none = Vector3::zeros();
        assert!((circle.margin(at, &none, 0.0) - 5.0).abs() < 1e-15, "3, 4, 5");
        assert!((circle.margin(at, &none, 2.0) - 3.0).abs() < 1e-15);
        // the corner of a housing 4 by 8: (3 + 2, 4 + 4)
        let corner = circle.margin(at, &Vector3::new(2.0, 4.0, 1.0), 0.0);
        assert!((corner - (10.0 - 89f64.sqrt())).abs() < 1e-14);
        let inside = Envelope::Box { min: Point3::new(0.0, 0.0, 0.0), max: Point3::new(5.0, 9.0, 100.0) };
        assert!((inside.margin(at, &none, 0.0) - 1.0).abs() < 1e-15);
        assert!((inside.margin(at, &none, 1.5) + 0.5).abs() < 1e-15, "outside is negative");
    }
}
