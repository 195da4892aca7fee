//! The leg hexagon of an octahedral manipulator and the joint-free platform with one leg on each side.

use nalgebra::{Matrix6, Point3, Vector3};

use crate::manipulator::{Leg, Octahedral};

/// One of the two bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Body {
    /// The fixed body.
    Base,
    /// The moving body.
    Platform,
}

impl std::fmt::Display for Body {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Base => "base",
            Self::Platform => "platform",
        })
    }
}

/// Side `i` of the hexagon: all legs on the line through legs `i` and `i + 1` (cyclic, 0-based).
///
/// Even sides share a platform joint, so the base end slides; odd sides share a base joint.
/// The leg at offset `t` joins `fixed` to `start + t (end - start)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Side {
    pub(crate) sliding: Body,
    pub(crate) fixed: Point3<f64>,
    pub(crate) start: Point3<f64>,
    pub(crate) end: Point3<f64>,
    /// The vertex of the sliding triangle that is not on the edge.
    pub(crate) opposite: Point3<f64>,
}

impl Side {
    pub(crate) fn edge(&self) -> Vector3<f64> {
        self.end - self.start
    }

    pub(crate) fn edge_length(&self) -> f64 {
        self.edge().norm()
    }

    /// The sliding joint at offset `t`.
    pub(crate) fn joint(&self, t: f64) -> Point3<f64> {
        self.start + self.edge() * t
    }

    pub(crate) fn leg(&self, t: f64) -> Leg {
        let (slid, fixed) = (self.joint(t), self.fixed);
        match self.sliding {
            Body::Base => Leg { base: slid, platform: fixed },
            Body::Platform => Leg { base: fixed, platform: slid },
        }
    }
}

/// Which body carries the sliding joint of side `i`: the base for even `i` (0-based, cyclic order).
#[must_use]
pub fn sliding_joint_body(i: usize) -> Body {
    if i.is_multiple_of(2) { Body::Base } else { Body::Platform }
}

/// The six sides in cyclic order, lengths divided by `scale`.
pub(crate) fn sides(o: &Octahedral, scale: f64) -> [Side; 6] {
    let shrink = |p: Point3<f64>| Point3::from(p.coords / scale);
    let (base, platform) = (o.base().map(shrink), o.platform().map(shrink));
    std::array::from_fn(|i| {
        let k = i / 2;
        let (next, opposite) = ((k + 1) % 3, (k + 2) % 3);
        let (sliding, triangle, fixed) = if i % 2 == 0 {
            (Body::Base, &base, platform[k])
        } else {
            (Body::Platform, &platform, base[next])
        };
        Side { sliding, fixed, start: triangle[k], end: triangle[next], opposite: triangle[opposite] }
    })
}

/// `det A = prod(1 - t_i) - prod(t_i)` of the map from the octahedral to the joint-free platform.
///
/// Source: expansion of the cyclic bidiagonal matrix of the six one-offset relations (Rojas, Borras,
/// Thomas, sec. 6, for two distinct values of `t`).
#[must_use]
pub fn offset_determinant(t: &[f64; 6]) -> f64 {
    t.iter().map(|x| 1.0 - x).product::<f64>() - t.iter().product::<f64>()
}

/// Gradient of [`offset_determinant`]; products without the own factor, so zeros do no harm.
pub(crate) fn determinant_gradient(t: &[f64; 6]) -> [f64; 6] {
    std::array::from_fn(|j| {
        let others = || (0..6).filter(move |&i| i != j);
        -others().map(|i| 1.0 - t[i]).product::<f64>() - others().map(|i| t[i]).product::<f64>()
    })
}

/// Hessian of [`offset_determinant`]: zero diagonal, since every product is affine in each offset.
pub(crate) fn determinant_hessian(t: &[f64; 6]) -> Matrix6<f64> {
    Matrix6::from_fn(|j, k| {
        let others = || (0..6).filter(move |&i| i != j && i != k);
        if j == k {
            return 0.0;
        }
        others().map(|i| 1.0 - t[i]).product::<f64>() - others().map(|i| t[i]).product::<f64>()
    })
}

#[cfg(test)]
mod tests {
    use super::super::tests::example;
    use super::*;
    use crate::geom::Pose;
    use crate::manipulator::SquaredLegLengths;
    use crate::synthesis::joint_free;
    use nalgebra::Rotation3;

    const T: [f64; 6] = [0.3, -0.4, 0.2, 1.3, 0.6, 0.8];

    #[test]
    fn legs_are_those_of_the_leg_map_module() {
        let o = example();
        let (m, map) = joint_free(&o, T).unwrap();
        let old = sides(&o, 1.0);
        let pose = Pose {
            rotation: Rotation3::from_euler_angles(0.2, 0.3, -0.5),
            position: Vector3::new(4.0, 1.0, 13.0),
        };
        let s: [f64; 6] = std::array::from_fn(|i| pose.squared_length(&old[i].leg(0.0)));
        let mapped = map.apply(&SquaredLegLengths::try_new(s).unwrap()).unwrap().get();
        for i in 0..6 {
            assert!((m.legs()[i].base - old[i].leg(T[i]).base).norm() < 1e-13);
            assert!((m.legs()[i].platform - old[i].leg(T[i]).platform).norm() < 1e-13);
            assert!((mapped[i] - pose.squared_length(&old[i].leg(T[i]))).abs() < 1e-9);
        }
    }

    #[test]
    fn side_ends_are_the_consecutive_legs_of_the_cycle() {
        let s = sides(&example(), 1.0);
        for i in 0..6 {
            assert_eq!(s[i].leg(1.0), s[(i + 1) % 6].leg(0.0));
        }
    }

    #[test]
    fn determinant_formula_matrix_and_derivatives_agree() {
        assert!((offset_determinant(&T) - joint_free(&example(), T).unwrap().1.determinant()).abs() < 1e-13);
        let (g, hess, h) = (determinant_gradient(&T), determinant_hessian(&T), 1e-6);
        for j in 0..6 {
            let moved = |x: f64| {
                let mut t = T;
                t[j] += x;
                t
            };
            let slope = (offset_determinant(&moved(h)) - offset_determinant(&moved(-h))) / (2.0 * h);
            assert!((slope - g[j]).abs() < 1e-9);
            for k in 0..6 {
                let bend =
                    (determinant_gradient(&moved(h))[k] - determinant_gradient(&moved(-h))[k]) / (2.0 * h);
                assert!((bend - hess[(j, k)]).abs() < 1e-9);
            }
        }
        // Griffis-Duffy: all midpoints
        assert!(offset_determinant(&[0.5; 6]).abs() < 1e-16);
    }
}
