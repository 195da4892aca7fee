//! The smallest cap of the sphere that holds given directions: the joint axis from which a leg leans least.

use nalgebra::Vector3;

/// Directions within this angle cosine count as inside; about 1e-7 degrees at 45 degrees.
const SLIP: f64 = 1e-14;

#[derive(Debug, Clone, Copy)]
struct Cap {
    axis: Vector3<f64>,
    cos: f64,
}

impl Cap {
    fn holds(&self, u: &Vector3<f64>) -> bool {
        self.axis.dot(u) >= self.cos - SLIP
    }

    fn of_two(u: &Vector3<f64>, v: &Vector3<f64>) -> Option<Self> {
        let axis = (u + v).try_normalize(1e-9)?;
        Some(Self { axis, cos: axis.dot(u).min(axis.dot(v)) })
    }

    /// The cap whose rim passes through three directions.
    fn of_three(u: &Vector3<f64>, v: &Vector3<f64>, w: &Vector3<f64>) -> Option<Self> {
        let n = (v - u).cross(&(w - u)).try_normalize(1e-300)?;
        let axis = if n.dot(u) < 0.0 { -n } else { n };
        Some(Self { axis, cos: axis.dot(u).min(axis.dot(v)).min(axis.dot(w)) })
    }
}

/// Axis (unit vector) that minimises the greatest angle to the directions, and the cosine of that angle.
///
/// `max_c min_k u_k . c` over `|c| <= 1`; at the optimum two or three directions are on the rim, and the incremental algorithm of
/// Welzl (1991) finds them. `None` for no direction, or when no open half space holds all.
pub(crate) fn smallest_cap(directions: &[Vector3<f64>]) -> Option<(Vector3<f64>, f64)> {
    let first = directions.first()?;
    let mut cap = Cap { axis: *first, cos: 1.0 };
    for i in 1..directions.len() {
        if cap.holds(&directions[i]) {
            continue;
        }
        cap = Cap { axis: directions[i], cos: 1.0 };
        for j in 0..i {
            if cap.holds(&directions[j]) {
                continue;
            }
            cap = Cap::of_two(&directions[i], &directions[j])?;
            for k in 0..j {
                if !cap.holds(&directions[k]) {
                    cap = Cap::of_three(&directions[i], &directions[j], &directions[k])?;
                }
            }
        }
    }
    (cap.cos > 0.0 && directions.iter().all(|u| cap.axis.dot(u) >= cap.cos - 1e-9))
        .then_some((cap.axis, cap.cos))
}
