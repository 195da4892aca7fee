//! Which joint is a corner of a triangle, and which lies on a side.

use nalgebra::{Point3, Vector3};

use super::place;
use crate::manipulator::{Manipulator, Octahedral};
use crate::manufacture::joint::{Joint, joints};
use crate::singularity::{GriffisDuffy, griffis_duffy_determinant};
use crate::synthesis::Body;

/// The triangles of base and platform.
#[derive(Debug, Clone)]
pub(super) struct Roles {
    /// Corners by body.
    pub(super) corners: [[Joint; 3]; 2],
    /// Joints on the sides by body: `inner[b][k]` on the side from corner `k` to corner `k + 1`. Absent for the octahedral platform.
    pub(super) inner: Option<[[Joint; 3]; 2]>,
    /// The legs round the hexagon, for a platform with joints on the sides.
    pub(super) found: Option<GriffisDuffy>,
}

impl Roles {
    /// `None` for a design that is neither octahedral nor has six joints on each body, one on each side of two triangles.
    pub(super) fn of(m: &Manipulator) -> Option<Self> {
        let of = |body| move |index| Joint { body, index };
        if let Ok(o) = Octahedral::recognise(m) {
            let corners =
                [o.base_indices().map(of(Body::Base)), o.platform_indices().map(of(Body::Platform))];
            return Some(Self { corners, inner: None, found: None });
        }
        if joints(m).len() != 12 {
            return None;
        }
        let found = GriffisDuffy::recognise(m)?;
        let pairs = m.pairs();
        let base = |legs: [usize; 3]| legs.map(|k| of(Body::Base)(pairs[found.order[k]].0));
        let platform = |legs: [usize; 3]| legs.map(|k| of(Body::Platform)(pairs[found.order[k]].1));
        Some(Self {
            corners: [base([5, 1, 3]), platform([0, 2, 4])],
            inner: Some([base([0, 2, 4]), platform([1, 3, 5])]),
            found: Some(found),
        })
    }

    /// `det A` of a platform with these roles: 1 for the octahedral one.
    pub(super) fn determinant(&self, m: &Manipulator) -> f64 {
        let Some(inner) = &self.inner else { return 1.0 };
        let t = |k: usize| {
            let (corners, joint) = (&self.corners[k % 2], inner[k % 2][k / 2]);
            let (from, to) = (place(m, corners[k / 2]), place(m, corners[(k / 2 + 1) % 3]));
            let side = to - from;
            (place(m, joint) - from).dot(&side) / side.norm_squared()
        };
        griffis_duffy_determinant(&std::array::from_fn(t))
    }

    /// Distance of a joint on a side from the line of the side, on `m`; `at` is where the joint is.
    pub(super) fn off_line(&self, m: &Manipulator, joint: Joint, at: &Point3<f64>) -> Option<f64> {
        for (corners, inner) in self.corners.iter().zip(self.inner.as_ref()?) {
            if let Some(k) = inner.iter().position(|j| *j == joint) {
                let from = place(m, corners[k]);
                let along: Vector3<f64> = (place(m, corners[(k + 1) % 3]) - from).normalize();
                return Some((at - from).cross(&along).norm());
            }
        }
        None
    }
}
